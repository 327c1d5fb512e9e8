"""`dondolo diff`: what differs between two runs, and which change explains it."""

import json
import re

import numpy as np
import pytest

import dondolo as dd
from dondolo.exchange.changelog import all_changes, changes_between
from dondolo.exchange.differences import _change, differences

LEVELS = [0.4, 0.6, 0.8, 1.0, 1.2]


@pytest.fixture(scope="module")
def runs(records, tmp_path_factory):
    """Folders of runs: the same twice, a thicker wall, one record less."""
    folder = tmp_path_factory.mktemp("runs")
    walls = {"old": 0.25, "same": 0.25, "thicker": 0.28, "fewer": 0.25}
    for name, thickness in walls.items():
        wall = dd.OneSidedWall(1.5, thickness, name="parapet")
        some = records[1:] if name == "fewer" else records
        (folder / name).mkdir()
        dd.multiple_stripe(wall, some, LEVELS, progress=False).write_results(folder / name / "parapet")
    return folder


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ("0.4", "0.41", "0.4 -> 0.41 (+2.5 %)"),
        ("2.0", "2.36", "2 -> 2.36 (+18 %)"),
        ("0.5", "0.0", "0.5 -> 0 (-100 %)"),
        ("0.5", "10.0", "0.5 -> 10 (+1900 %)"),
        ("2e-15", "0.5", "2e-15 -> 0.5 (+2.5e+16 %)"),
    ],
)
def test_shares_are_short(old, new, words):
    assert _change(old, new) == words


def test_the_same(runs):
    found = list(differences(runs / "old", runs / "same" / "parapet"))
    assert found[1:] == ["  the tables have the same numbers"]
    assert dd.__version__ in found[0]


def test_another_wall(runs):
    """Numbers of the curves are those of the results; both builds are one."""
    found = list(differences(runs / "old" / "parapet_run.json", runs / "thicker"))
    curves = [dd.read_results(runs / name / "parapet").fragility for name in ("old", "thicker")]
    (line,) = [one for one in found if one.startswith("  fragility: parapet")]
    share = 100.0 * (curves[1].theta / curves[0].theta - 1.0)
    assert f"theta {curves[0].theta:.6g} -> {curves[1].theta:.6g} ({share:+.2g} %)" in line
    (walls,) = [one for one in found if one.startswith("  walls: ")]
    assert "thickness_m 0.25 -> 0.28 (+12 %)" in walls
    # Of many rows each column has its largest change
    edp = [one for one in found if one.startswith("  histories: edp in ")]
    old, new = (dd.read_results(runs / name / "parapet").stripes for name in ("old", "thicker"))
    assert int(re.search(r"in (\d+) rows", edp[0])[1]) == np.count_nonzero(old.edp != new.edp)
    flags = [one for one in found if one.startswith("  histories: collapsed in ")]
    assert int(re.search(r"in (\d+) rows", flags[0])[1]) == np.count_nonzero(old.collapsed != new.collapsed)
    assert found[-1] == "Settings, inputs or walls differ, which may explain all of this."


def test_other_records(runs, records):
    found = list(differences(runs / "old", runs / "fewer"))
    assert f"  records only in the old run: 1, such as {records[0].name}" in found
    assert f"  histories: {len(LEVELS)} rows only in the old run" in " ".join(found)
    assert found[-1] == "Settings, inputs or walls differ, which may explain all of this."


def test_folders(runs, tmp_path):
    for name in ("parapet", "other"):
        dd.multiple_stripe(dd.OneSidedWall(1.5, 0.25), dd.example_records()[:4], LEVELS, progress=False).write_results(
            tmp_path / "two" / name
        )
    found = list(differences(runs / "old", tmp_path / "two"))
    assert f"other: only in {tmp_path / 'two'}" in found
    assert any("records only in the old run" in line for line in found)
    (tmp_path / "none").mkdir()
    with pytest.raises(dd.errors.InputError, match="has no file"):
        list(differences(tmp_path / "none", runs / "old"))
    with pytest.raises(dd.errors.InputError, match="no run has the same name"):
        list(differences(tmp_path / "two", runs.parent / runs.name / "thicker" / ".." / "old" / ".." / "nothing"))


def of_version(runs, tmp_path, version):
    """The old run as another version would have written it."""
    prefix = tmp_path / version / "parapet"
    prefix.parent.mkdir()
    for file in (runs / "old").iterdir():
        text = file.read_text(encoding="utf-8")
        if file.name.endswith("_run.json"):
            content = json.loads(text) | {"version": version, "commit": "1234567"}
            text = json.dumps(content)
        (prefix.parent / file.name).write_text(text, encoding="utf-8")
    return prefix


def test_changes_that_explain_it(runs, tmp_path):
    """Of versions before: rows that name what the runs have; of later ones none."""
    found = list(differences(of_version(runs, tmp_path, "0.0.9"), runs / "thicker" / "parapet"))
    (head,) = [line for line in found if line.startswith("Results that change (CHANGELOG.md, 0.0.9 to ")]
    listed = found[found.index(head) + 1 :]
    count, whole = map(int, re.search(r"(\d+) of (\d+) name", head).groups())
    assert len(listed) == count < whole
    assert listed
    assert all(re.search(r"`&?[a-z]\w+`", line) for line in listed)
    assert any("`one_sided` and `two_block` with a `&building`" in line for line in listed)
    later = list(differences(of_version(runs, tmp_path, "99.1"), of_version(runs, tmp_path, "99.2")))
    assert later[1:] == ["  the tables have the same numbers"]


def test_the_changelog_is_read(root):
    """Every row of its tables, with the version of its section."""
    text = (root / "CHANGELOG.md").read_text(encoding="utf-8")
    rows = all_changes()
    assert len(rows) > 40
    assert {row.version for row in rows} <= set(re.findall(r"(?m)^## ([\d.]+)", text))
    for row in rows:
        assert f"| {row.what} | {row.by_how_much} | {row.who} |" in text
    assert changes_between("0.0.1", "0.1.0") == changes_between("0.1.0", "0.0.1") == rows
    assert changes_between("0.1.0", "0.1.0.dev3") == rows
    assert changes_between("0.1.1", "0.3") == []


def test_command(run, runs):
    done = run("diff", runs / "old", runs / "thicker")
    assert done.returncode == 0, done.stderr
    assert "thickness_m 0.25 -> 0.28" in done.stdout
    wrong = run("diff", runs / "old", "nothing")
    assert (wrong.returncode, wrong.stdout) == (2, "")
    assert "nothing_run.json" in wrong.stderr
