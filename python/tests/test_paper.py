"""The page that goes through the paper: its script in its small form, its numbers, and the sources that it names."""

import os
import re
import subprocess
import sys

import pytest


@pytest.fixture(scope="module")
def printed(root, tmp_path_factory):
    """What the script prints, and the folder of its figures."""
    folder = tmp_path_factory.mktemp("paper")
    command = [sys.executable, root / "docs/examples/paper.py", "--small"]
    environment = {**os.environ, "MPLBACKEND": "agg", "PYTHONWARNINGS": "ignore"}
    done = subprocess.run(command, cwd=folder, env=environment, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return done.stdout, folder / "out/examples"


def test_equations_are_those_of_the_paper(printed):
    """Terms of equation (1) and the coefficient (2) to 15 digits; (4) as printed creates energy, and is repaired."""
    text, _ = printed
    apart = [float(value) for value in re.findall(r"equation \(1\): .* differs by (\S+)", text)]
    assert len(apart) == 3
    assert max(map(abs, apart)) < 1e-14
    eta, ratio = map(float, re.search(r"equation \(2\): eta = (\S+), restitution e (\S+)", text).groups())
    assert -eta == pytest.approx(ratio, rel=1e-14)
    as_printed, repaired, here = map(
        float, re.search(r"as printed (\S+), repaired (\S+), dondolo (\S+)", text).groups()
    )
    assert as_printed > 1.0 > repaired
    assert here == pytest.approx(repaired, rel=1e-14)


def test_both_engines_give_the_same(printed):
    found = re.search(
        r"engines: (\d+) of (\d+) flags differ; EDPs of (\d+) .* by (\S+) in the median, (\S+) at", printed[0]
    )
    differ, flags, survivors = map(int, found.groups()[:3])
    assert (differ, flags) == (0, 264)
    assert survivors > 40
    assert float(found[4]) < 1e-13
    assert float(found[5]) < 1e-8


def test_figures_are_drawn(printed):
    text, folder = printed
    for name in ("paper_figures_2_3.png", "paper_figure_4.png", "paper_figure_5.png"):
        assert (folder / name).stat().st_size > 10_000
    # The finding of section 3.4, with other walls and records
    medians = re.findall(r"figure 5, \w+: theta (\S+) g", text)
    assert float(medians[0]) < float(medians[1])


def test_the_page_names_sources_that_exist(root):
    """Files and folders of the sources, and the procedures in them."""
    page = (root / "docs/paper.md").read_text()
    rows = re.findall(r"(?m)^\| [\d(].*\| (.*) \|$", page)
    named = [row for row in rows if "src/" in row]
    assert len(named) > 10
    for row in named:
        (place,) = re.findall(r"`(src/[^`]+)`", row)
        assert (root / place).exists(), place
        for name in re.findall(r"^`(\w+)` in", row):
            assert re.search(rf"\b{name}\b", (root / place).read_text()), name
