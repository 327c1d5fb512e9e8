"""Pages: what they quote, run and name exists, and so do the pages and the files that they link to."""

import ast
import builtins
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

import dondolo as dd

METHODS = {
    "record": dd.Record,
    "records": dd.RecordSet,
    "stripes": dd.results.Stripes,
    "curve": dd.Fragility,
    "typology": dd.results.Typology,
    "study": dd.Study,
}


@pytest.fixture(scope="module")
def sources(root):
    """All sources that write messages, with literals on several lines joined."""
    files = [file for folder in ("src", "app") for file in root.glob(f"{folder}/**/*.[fF]90")]
    fortran = "\n".join(file.read_text(encoding="utf-8") for file in files)
    fortran = re.sub(r"'\s*//\s*&\s*\n\s*&?\s*'", "", fortran).replace("''", "'")
    files = list(root.glob("python/dondolo/**/*.py"))
    assert len(files) > 50
    python = "\n".join(file.read_text(encoding="utf-8") for file in files)
    return fortran + re.sub(r'"\s*\n\s*f?"', "", python)


def quoted(root):
    """Messages in the headings of the page."""
    page = (root / "docs/troubleshooting.md").read_text(encoding="utf-8")
    return [message for heading in re.findall(r"(?m)^### (.*)$", page) for message in re.findall(r"`([^`]+)`", heading)]


def test_messages_are_those_of_the_sources(root, sources):
    messages = quoted(root)
    assert len(messages) >= 25
    for message in messages:
        parts = [part.strip(" ,;:") for part in message.split("...")]
        parts = [part for part in parts if len(part) > 3]
        assert parts, message
        assert [part for part in parts if part not in sources] == [], message


@pytest.mark.slow
@pytest.mark.skipif(shutil.which("octave-cli") is None, reason="needs Octave")
def test_the_script_for_matlab(root, tmp_path):
    """The script of docs/matlab_excel.md writes a case, runs it and reads its results."""
    script = re.search(r"```matlab\n(.*?)```", (root / "docs/matlab_excel.md").read_text(encoding="utf-8"), re.S)[1]
    (tmp_path / "script.m").write_text(script + "disp(run.format)\n", encoding="utf-8")
    path = f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}"
    done = subprocess.run(
        ["octave-cli", "--no-gui", "--norc", "script.m"],
        cwd=tmp_path, env={**os.environ, "PATH": path}, capture_output=True, text=True, check=False,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    assert "dondolo run" in done.stdout
    assert (tmp_path / "out/wall_fragility.csv").is_file()


def test_overview_names_what_exists(root):
    """The page of one screen names every public function and class, and no other."""
    page = (root / "docs/python.md").read_text(encoding="utf-8")
    named = set(re.findall(r"dd\.(\w+)", page))
    public = {name for name in dd.__all__ if not name.startswith("_")}
    assert public - named == set()
    assert named - public == set()
    assert [path for path in re.findall(r"`(\w+)\.\w+\(", page) if path not in METHODS] == []
    for thing, method in re.findall(r"`(\w+)\.(\w+)\(", page):
        assert hasattr(METHODS[thing], method), f"{thing}.{method}"


def pages(root):
    """All pages for users, and their texts."""
    found = [*root.glob("docs/**/*.md"), *root.glob("*.md")]
    found = [one for one in found if "generated" not in one.parts]
    assert len(found) > 50
    return {one: one.read_text(encoding="utf-8") for one in found}


def test_links_lead_to_what_a_clone_has(root):
    """No link of a page leads to one that only a build makes; docs/site is read in the site."""
    broken = []
    for page, text in pages(root).items():
        plain = re.sub(r"(?s)```.*?```|`[^`\n]*`", "", text)
        if page.name == "reference.md":
            made = text.split("## Pages that a build makes")[1]
            assert re.findall(r"(?m)^generated/(\w+)$", made) == ["variables", "columns", "command_line", "api"]
        for link in re.findall(r"\]\(([^)#\s]+)[^)]*\)", plain):
            is_far = re.match(r"\w+:", link) or "site" in page.relative_to(root).parts
            if not is_far and not (page.parent / link).exists():
                broken.append(f"{page.relative_to(root)}: {link}")
    assert broken == []


def undefined(code, known):
    """Names of a piece of Python that no line of it, or of what was before, defines; what it defines is added."""
    tree = ast.parse(code)
    nodes = list(ast.walk(tree))
    for node in nodes:
        if isinstance(node, (ast.Import, ast.ImportFrom)):
            known |= {(alias.asname or alias.name).split(".")[0] for alias in node.names}
        elif isinstance(node, (ast.FunctionDef, ast.ClassDef)):
            known.add(node.name)
        elif isinstance(node, ast.arg):
            known.add(node.arg)
        elif isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store):
            known.add(node.id)
    return sorted({node.id for node in nodes if isinstance(node, ast.Name)} - known)


def test_snippets_define_their_names(root):
    """A reader who runs the snippets of a page from its top on meets no name that none of them defines."""
    assert undefined("a = b", set()) == ["b"]
    missing = {}
    for page, text in pages(root).items():
        known = set(dir(builtins))
        for code in re.findall(r"(?s)```python\n(.*?)```", text):
            names = undefined(code, known)
            if names:
                missing[str(page.relative_to(root))] = names
    assert missing == {}


def test_the_misfit_that_a_page_states(root):
    """That of the table of docs/own_mechanism.md, to its digit but for rounding."""
    text = (root / "docs/own_mechanism.md").read_text(encoding="utf-8")
    code = re.search(r"(?s)```python\n(.*?wall\.misfit  # (\S+)\n)", text)
    names = {}
    exec(code[1], names)
    assert 0.2 * float(code[2]) < names["wall"].misfit < 5.0 * float(code[2])
