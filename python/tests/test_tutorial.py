"""Pages for newcomers, followed word by word: what they say is printed is what the commands and scripts print."""

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

pytestmark = pytest.mark.slow


def blocks(page, language):
    """Blocks of a page in one language, in their order."""
    return re.findall(rf"(?ms)^```{language}\n(.*?)^```$", page)


def commands(page):
    """Commands of the consoles of a page, without those that install."""
    lines = [line[2:] for block in blocks(page, "console") for line in block.splitlines() if line.startswith("$ ")]
    return [line for line in lines if not re.search(r"\bvenv\b|^pip ", line)]


def shell(line, folder, executable):
    """What a command prints in a folder, where it finds the executable and Python."""
    path = os.pathsep.join([str(Path(executable).parent), str(Path(sys.executable).parent), os.environ["PATH"]])
    done = subprocess.run(
        ["bash", "-c", line],
        cwd=folder,
        env={**os.environ, "PATH": path, "MPLBACKEND": "agg"},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, f"{line}: {done.stderr}"
    return done.stdout.splitlines()


@pytest.mark.parametrize("name", ["first_wall", "prima_parete"])
def test_tutorial(name, root, executable, tmp_path):
    page = (root / f"docs/tutorial/{name}.md").read_text(encoding="utf-8")
    (tmp_path / "script.py").write_text("".join(blocks(page, "python")))
    lines = commands(page)
    assert len(lines) >= 6
    said = [said for line in [*lines, f"{sys.executable} script.py"] for said in shell(line, tmp_path, executable)]
    shown = [line for block in blocks(page, "text") for line in block.splitlines()]
    assert len(shown) >= 6
    assert [line for line in shown if line not in said] == []
    for written in ("out/parapet_fragility.png", "out/parapet_report.html", "out/thin_fragility.csv", "stripes.png"):
        assert (tmp_path / written).stat().st_size > 500


def test_both_languages_show_the_same(root):
    pages = [(root / f"docs/tutorial/{name}.md").read_text(encoding="utf-8") for name in ("first_wall", "prima_parete")]
    for language in ("console", "python", "text"):
        assert blocks(pages[0], language) == [block.replace(" --lang it", "") for block in blocks(pages[1], language)]


def test_readme(root, executable, tmp_path):
    page = (root / "README.md").read_text(encoding="utf-8")
    assert len(page.splitlines()) <= 110
    lines = [line.split("  #")[0].strip() for line in commands(page) if line.startswith("dondolo")]
    assert len(lines) == 3
    said = [said for line in lines for said in shell(line, tmp_path, executable)]
    summary = next(block for block in blocks(page, "text"))
    assert [line for line in summary.splitlines() if line not in said] == []
    (tmp_path / "script.py").write_text("".join(blocks(page, "python")))
    assert shell(f"{sys.executable} script.py", tmp_path, executable)
    for written in ("out/parapet_report.html", "stripes.png", "fragility.png"):
        assert (tmp_path / written).stat().st_size > 500


def test_reading_a_curve(root, executable, tmp_path):
    page = (root / "docs/reading_a_curve.md").read_text(encoding="utf-8")
    said = shell("dondolo --example parapet >parapet.nml && dondolo parapet.nml", tmp_path, executable)
    shown = [line for block in blocks(page, "text") for line in block.splitlines()]
    assert len(shown) == 4
    assert [line for line in shown if line not in said] == []


def test_cases(root, executable, tmp_path):
    page = (root / "docs/cases.md").read_text(encoding="utf-8")
    (tmp_path / "data").symlink_to(root / "data")
    case = next(block for block in blocks(page, "fortran") if block.startswith("&job"))
    (tmp_path / "parapet.nml").write_text(case)
    for line in commands(page):
        shell(line, tmp_path, executable)
    assert (tmp_path / "out/parapet_run.json").is_file()
    message = next(block for block in blocks(page, "text"))
    (tmp_path / "parapet.nml").write_text(case.replace("thickness = 0.25 ", "thickness = -0.25 "))
    assert shell("dondolo parapet.nml 2>&1 || true", tmp_path, executable) == message.splitlines()
    table = page[page.index("| name |") : page.index("The walls of the populations")]
    ready = {case.stem for case in (root / "data/cases").glob("*.nml")}
    assert set(re.findall(r"`(\w+)`", table)) == ready
