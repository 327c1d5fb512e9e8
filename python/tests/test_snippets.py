"""Snippets of pages: every block of Python runs, in order on its page, and the executable reads every block of a case.

A comment above a block changes how it runs: `<!-- file: NAME -->` writes it to a file that later blocks import,
`<!-- script -->` runs it by itself, and `<!-- not run: REASON -->` leaves it to the reader.
"""

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
BLOCK = re.compile(r"(?ms)^(?:<!-- (file|script|not run)(?:: ([^\n]+?))? -->\n)?```python\n(.*?)^```$")
# What a page shows right below a block is what the block prints
PRINTED = re.compile(r"(?ms)^```python\n[^`]*^```\n\n```text\n(.*?)^```$")
# One needs a cluster, the other MPI that starts Python
MOST_NOT_RUN = 2


def snippets(page):
    """Blocks of Python of a page: how each runs, with the name or the reason, and its lines."""
    return BLOCK.findall(page.read_text(encoding="utf-8"))


def pages():
    """Pages with Python, by their paths in the repository."""
    found = [*ROOT.glob("docs/**/*.md"), *ROOT.glob("*.md")]
    names = [str(page.relative_to(ROOT)) for page in found if "generated" not in page.parts and snippets(page)]
    assert len(names) > 20
    return sorted(names)


def test_every_block_is_found():
    """None is indented or fenced in a way that the pattern passes over, and few are not run."""
    left = []
    for name in pages():
        text = (ROOT / name).read_text(encoding="utf-8")
        assert len(snippets(ROOT / name)) == text.count("```python"), name
        assert text.count("<!-- not run") == sum(how == "not run" for how, _, _ in snippets(ROOT / name)), name
        left += [(name, reason) for how, reason, _ in snippets(ROOT / name) if how == "not run"]
    assert len(left) <= MOST_NOT_RUN
    assert all(len(reason) > 10 for _, reason in left)


@pytest.fixture
def folder(tmp_path, records, executable):
    """A folder with what the snippets of all pages read: the data of a clone, a reader's files and results of runs."""
    (tmp_path / "data").symlink_to(ROOT / "data", target_is_directory=True)
    header = ["# Sampling Freq(Hz), 200", "# Time, N-S(gal), U-D(gal)"]
    strong = sorted(records, key=lambda record: -record.peak_acceleration)
    for i in range(9):
        both = [100.0 * record.acceleration for record in strong[2 * i : 2 * i + 2]]
        rows = [f"{0.005 * j:.3f},{x:.6f},{y:.6f}" for j, (x, y) in enumerate(zip(*both, strict=False))]
        (tmp_path / f"KMM00{i + 1}.csv").write_text("\n".join([f"# Station Code, KMM00{i + 1}", *header, *rows]) + "\n")
    lines = "".join(f"KMM00{i}.csv,N-S,U-D\n" for i in range(1, 10))
    (tmp_path / "records.csv").write_text(f"file,channel,vertical\n{lines}")
    one = records[0].acceleration
    values = "\n".join(f"{x / 9.81:.9f}" for x in one)
    (tmp_path / "motion.txt").write_text(f"a motion\n{len(one)} 0.005\n{values}\n")
    values = "\n".join(f"{100.0 * x:.6f}" for x in one)
    (tmp_path / "AQV.dat").write_text(f"dt: 0.005\nunits: cm/s2\n{values}\n")
    table = (ROOT / "data/walls/alternatives.csv").read_text(encoding="utf-8")
    (tmp_path / "walls.csv").write_text("".join(line for line in table.splitlines(True) if not line.startswith("#")))
    (tmp_path / "out/openquake").mkdir(parents=True)
    return tmp_path


def run(command, folder):
    """What a command prints that runs in a folder."""
    environment = {**os.environ, "MPLBACKEND": "agg", "PYTHONPATH": str(folder)}
    done = subprocess.run(command, cwd=folder, env=environment, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout[-2000:] + done.stderr[-3000:]
    return done.stdout.splitlines()


@pytest.mark.slow
@pytest.mark.parametrize("name", pages())
def test_snippets_run(name, folder, executable):
    """In one process and in their order, but for those with a mark."""
    if "files.md" in name:
        for case in ("parapet", "population"):
            run([executable, "--quiet", f"data/cases/{case}.nml"], folder)
    together = []
    for i, (how, detail, code) in enumerate(snippets(ROOT / name)):
        if how == "file":
            (folder / detail).write_text(code, encoding="utf-8")
        elif how == "script":
            (folder / f"script{i}.py").write_text(code, encoding="utf-8")
            run([sys.executable, f"script{i}.py"], folder)
        elif how != "not run":
            together.append(code)
    (folder / "page.py").write_text("\n".join(together), encoding="utf-8")
    printed = run([sys.executable, "page.py"], folder)
    for shown in PRINTED.findall((ROOT / name).read_text(encoding="utf-8")):
        assert [line for line in shown.splitlines() if line not in printed] == []


# Groups that a page assumes beside those that it shows
GROUPS = {
    "job": "&job task = 'stripes', output = 'out/page' /",
    "wall": "&wall mechanism = 'one_sided', height = 3.0, thickness = 0.25 /",
    "records": "&records catalogue = 'data/records/synthetic44.csv', polarity = 'both' /",
    "stripes": "&stripes levels = 0.2, 0.4, 0.6, 0.8 /",
}
TYPOLOGY = {"job": "&job task = 'typology', output = 'out/page' /"}
STRIP = {"wall": "&wall mechanism = 'two_block', height = 3.0, thickness = 0.25, hinge = 0.6 /"}
HOUSE = {"building": "&building period = 0.3, storeys = 3, level = 0.0, building_height = 9.0 /"}
ASSUMED = {"docs/bending.md": STRIP, "docs/mechanisms.md": TYPOLOGY}
# Of a page with several blocks, by the first group of each
ASSUMED_BY_BLOCK = {
    ("docs/buildings.md", "building"): STRIP,
    ("docs/buildings.md", "uncertainty"): HOUSE,
}


def cases():
    """Blocks of namelist groups in pages, fenced or indented, each with the name of its page."""
    found = []
    for page in sorted(ROOT.glob("docs/**/*.md")):
        if "generated" in page.parts:
            continue
        text = page.read_text(encoding="utf-8")
        fenced = [block for block in re.findall(r"(?ms)^```fortran\n(.*?)^```$", text) if block.startswith("&")]
        plain = re.sub(r"(?ms)^```.*?^```$", "", text)
        indented = re.findall(r"(?m)^    &.*\n(?:^    .*\n)*", plain)
        found += [(str(page.relative_to(ROOT)), block) for block in (*fenced, *indented)]
    assert len(found) > 10
    return found


@pytest.mark.parametrize(("name", "block"), cases())
def test_cases_are_read(name, block, folder, executable):
    """With the groups that the block leaves out, which its page assumes."""
    given = re.findall(r"(?m)^\s*&(\w+)", block)
    groups = GROUPS | (TYPOLOGY if "uncertainty" in given else {})
    groups |= ASSUMED.get(name, {}) | ASSUMED_BY_BLOCK.get((name, given[0]), {})
    lines = [group for key, group in groups.items() if key not in given]
    (folder / "case.nml").write_text("\n".join([*lines, block]), encoding="utf-8")
    run([executable, "--check", "case.nml"], folder)
