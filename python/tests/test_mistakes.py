"""Mistakes in cases, tables and commands: each message names what is wrong, and --check shows what was understood."""

from __future__ import annotations

import re

import numpy as np
import pytest

import dondolo as dd
from dondolo._fortran import _core

WALL = {"mechanism": "'one_sided'", "height": "2.4", "thickness": "0.3"}
PARTS = {"wall": "", "records": "catalogue = 'records.csv'", "stripes": "levels = 0.3, 0.5, 0.7"}
TIE = "tie_height = 2.3, tie_length = 5.0"


@pytest.fixture
def folder(tmp_path):
    """A folder with three short records and a catalogue."""
    rng = np.random.default_rng(3)
    for i in range(3):
        np.savetxt(tmp_path / f"r{i}.txt", rng.normal(0.0, 1.5, 400), fmt="%.5f")
    rows = "".join(f"r{i}.txt,0.01,m/s2\n" for i in range(3))
    (tmp_path / "records.csv").write_text("file,dt_s,units\n" + rows)
    return tmp_path


def case(more: str = "", **groups: str) -> str:
    """A case with other contents of its groups, and more variables of the wall."""
    wall = ", ".join(f"{name} = {value}" for name, value in WALL.items())
    wall = groups.pop("wall", wall + (", " + more if more else ""))
    parts = {"job": "output = 'out/wall'"} | PARTS | {"wall": wall} | groups
    return "".join(f"&{name} {text} /\n" for name, text in parts.items())


@pytest.mark.parametrize(
    ("text", "message"),
    [
        # Loads share depths, never heights
        (
            case("load = 8e3, 5e3, load_height = 2.4, load_depth = 0.1, load_inertia = 'both'"),
            "load_height = 2.4: is one ",
        ),
        (
            case("thrust = 300.0, 200.0, thrust_height = 2.4"),
            "thrust_height = 2.4: is one value for 2 values of thrust",
        ),
        # Units
        (case(wall="mechanism = 'one_sided', height = 2400, thickness = 0.3"), "is it in millimetres?"),
        (case(f"{TIE}, tie_area = 201.0"), "is it in mm2 per metre of wall?"),
        (case(f"{TIE}, tie_area = 2.01"), "is it in cm2 per metre of wall?"),
        (case(f"{TIE}, tie_area = 2e-5, tie_modulus = 205e3"), "is it in MPa?"),
        (case("load = 8e3, load_height = 2400, load_depth = 0.1, load_inertia = 'both'"), "is it in millimetres?"),
        (case("load = 8e3, load_height = 2.4, load_depth = 120, load_inertia = 'both'"), "is it in millimetres?"),
        (case(f"{TIE}, tie_area = 2e-5".replace("2.3", "2300")), "is it in millimetres?"),
        (case("restitution_factor = 88"), "must be less than 1: is it in per cent?"),
        (case("compressive_strength = 1800.0"), "is it in kPa?"),
        (case(check="ag = 1.9, f0 = 2.4, tc_star = 0.3"), "is it in m/s2?"),
        (case(check="ag = 19, f0 = 2.4, tc_star = 0.3"), "is it in per cent of g?"),
        (case(building="period = 250, participation = 1.2"), "is it in milliseconds?"),
        (case(building="period = 0.25, participation = 1.2, damping = 3"), "is it in per cent?"),
        # Numbers that are not written as here
        (case(stripes="levels = 0,3; 0,5"), "a comma separates values, a point decimals"),
        (
            case(f"{TIE}, tie_area = 2e-5".replace("2.3", "2,3")),
            "tie_height = 2,3: a decimal comma, or several values? Write 2.3, or 2, 3 with",
        ),
        (case(stripes="levels = 1,5, 2,5"), "levels = 1,5, 2,5: a decimal comma, or several values"),
        (case(stripes="levels = 0.5, 1,5"), "levels = 0.5, 1,5: a decimal comma, or several values"),
        (case(stripes="levels = 0.3; 0.5"), "a comma separates values, a point decimals"),
        (case(stripes="levels = linspace(0.3, 0.7, 3)"), "first, last and count give equally spaced levels"),
        (case(stripes="levels = 0.3:0.2:0.7"), "first, last and count give equally spaced levels"),
        (case(stripes="levels = [0.3, 0.5]"), "a list has no brackets"),
        (case(wall="mechanism = 'one_sided', height = 2.4m, thickness = 0.3"), "must be a number without a unit"),
        (case(wall="mechanism = 'one_sided', height = 2.4 m, thickness = 0.3"), "must be a number without a unit"),
        (case(building="period = 0.25, participation = 1.2, damping = 3%"), "without a per cent sign"),
        (case(stripes="im = 'sa(0,3)', levels = 0.3, 0.5"), "it must have a decimal point: 'sa(0.3)'"),
        (
            case(stripes="im = 'saavg(0,2:1,5)', levels = 0.3, 0.5"),
            "it must have a decimal point: 'saavg(0.2:1.5)'",
        ),
        # Characters of print
        (case(wall="mechanism = 'one_sided', height\u00a0= 2.4, thickness = 0.3"), "a no-break space (U+00A0)"),
        (case(wall="mechanism = 'one_sided', height = 2.4,\u202fthickness = 0.3"), "a no-break space (U+202F)"),
        (case(wall="mechanism = 'one_sided', \u200bheight = 2.4, thickness = 0.3"), "an invisible character (U+200B)"),
        (case(wall="mechanism = 'one_sided\u00a0', height = 2.4, thickness = 0.3"), "it has a no-break space (U+00A0)"),
        (case(stripes="im = 'pga\u00a0', levels = 0.3, 0.5"), "it has a no-break space (U+00A0)"),
        (case("edge_radius = \u22120.02"), "a dash that is not an ordinary - (U+2212)"),
        (
            case(wall="mechanism = 'one_sided'\u00a0, height = 2.4, thickness = 0.3"),
            "a no-break space (U+00A0) right after 'one_sided': must be an ordinary character of the keyboard",
        ),
        # Names of other variables
        (
            case("restitution = 0.9"),
            "restitution = 0.9: must be text in quotes; a number is given as restitution_value = 0.9",
        ),
        # Only what was typed, not what is left without it
        (case(f"{TIE}, tie_area = 2e-5, tie_strength = 1,8e8"), "tie_strength"),
        # Comments of other languages
        ("# a wall\n" + case(), "# is no comment: comments begin with !"),
        ("// a wall\n" + case(), "// is no comment: comments begin with !"),
    ],
)
def test_message(folder, run, text, message):
    (folder / "wall.nml").write_text(text, encoding="utf-8")
    done = run("--check", "wall.nml")
    assert done.returncode == 2
    assert message in done.stderr
    assert len(done.stderr.splitlines()) == 1


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (case(stripes="levels = 0.5"), "only one level: no curve can be fitted, at least two are needed"),
        (case(stripes="levels = 0.002, 0.004"), "every history stays below the trigger"),
        (case(stripes="im = 'pgd', levels = 5, 20"), "more than 5 m: are they in cm?"),
        (case(stripes="levels = 15, 30"), "are they in m/s2, cm/s2 or per cent of g?"),
        (case("spring = 40.0, spring_height = 2.4, spring_depth = 0.0"), "is it in kN/m2?"),
        (
            case(building="period = 4.0, participation = 1.2"),
            "period = 4 s is more than 2 s: is it in Hz, a frequency?",
        ),
    ],
)
def test_warning(folder, run, text, message):
    (folder / "wall.nml").write_text(text, encoding="utf-8")
    done = run("--check", "wall.nml")
    assert done.returncode == 0
    assert message in done.stdout


def test_ties_are_counted(folder, run):
    ties = "tie_height = 2.3, 1.5, tie_length = 5.0, tie_area = 2e-5"
    (folder / "wall.nml").write_text(case(ties))
    shown = run("--check", "wall.nml").stdout
    assert "1, 2.3 m above the hinge: stiffness" in shown
    assert "2, 1.5 m above the hinge: stiffness" in shown


def test_records_that_are_too_few(folder, run):
    catalogue = folder / "records.csv"
    (folder / "wall.nml").write_text(case())
    lines = catalogue.read_text().splitlines(keepends=True)
    assert "standard errors need" not in run("--check", "wall.nml").stdout
    catalogue.write_text("".join(lines[:3]))
    assert "warning: only 2 clusters of 2 records: standard errors need at least 3" in run("--check", "wall.nml").stdout
    catalogue.write_text("".join(lines[:2]))
    assert "warning: only one record: the curve does not cover other earthquakes" in run("--check", "wall.nml").stdout


def test_building(folder, run):
    (folder / "wall.nml").write_text(
        case(building="period = 0.4, 0.125, participation = 1.3, -0.25, damping = 0.04, 0.1")
    )
    shown = run("--check", "wall.nml").stdout
    assert "building: mode 1, period 0.4 s (2.5 Hz), damping 0.04, participation 1.3" in shown
    assert "building: mode 2, period 0.125 s (8 Hz), damping 0.1, participation -0.25" in shown
    assert "(refine = 0: as many as the shortest period needs)" in shown
    (folder / "wall.nml").write_text(case(building="period = 0.4, participation = 1.3, damping = 0.05, refine = 3"))
    shown = run("--check", "wall.nml").stdout
    # Free vibration down to 1e-4 of its amplitude
    tail = -np.log(1e-4) * 0.4 / (2.0 * np.pi * 0.05)
    assert "each step of a record in 3 parts (refine = 3)" in shown
    assert f"after each record {tail:.4g} s of free vibration" in shown
    assert f"the longest motion lasts {3.99 + tail:.4g} s" in shown


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (
            "file,dt_s\nr0.txt,0.01\n",
            "units must be given, such as 'g' or 'm/s2'; in a catalogue they are the column units",
        ),
        (
            "file,dt_s,unit\nr0.txt,0.01,g\n",
            "column 'unit': the units of the accelerations must be in the column units",
        ),
        ("file,dt_s,units\nr0.txt,0.01\u00a0,g\n", "must be a number, has a no-break space (U+00A0)"),
        ("file,dt_s,units\nr0.txt,0.01,g\u00a0\n", "it has a no-break space (U+00A0)"),
        ("file,dt_s,units\nr0.txt\u200b,0.01,g\n", "no such file; its name has an invisible character (U+200B)"),
        ("file,dt_s,units\u00a0\nr0.txt,0.01,g\n", "has a no-break space (U+00A0)"),
        (
            "PK\x03\x04 docProps xl/workbook.xml\n",
            "seems to be a workbook of a spreadsheet (xlsx), not a text: save its table as CSV",
        ),
        ("file,dt_s,units\nr0.txt,1%,g\n", "without a per cent sign"),
    ],
)
def test_catalogue(folder, run, content, message):
    (folder / "wall.nml").write_text(case())
    (folder / "records.csv").write_text(content, encoding="utf-8")
    done = run("--check", "wall.nml")
    assert done.returncode == 2
    assert message in done.stderr


def test_a_unit_in_the_title_of_a_column(folder, run):
    (folder / "walls.csv").write_text("mechanism,height (m),thickness\none_sided,2.4,0.3\n")
    groups = {"population": "file = 'walls.csv'", "job": "task = 'typology', output = 'out'"}
    (folder / "walls.nml").write_text("".join(f"&{name} {text} /\n" for name, text in (PARTS | groups).items() if text))
    assert "column 'height (m)': no such column; did you mean 'height'?" in run("--check", "walls.nml").stderr
    assert "records.csv: must be a case, a file of groups &name ... /" in run("--check", "records.csv").stderr


def test_everything_wrong_with_the_groups_is_reported_at_once(folder, run):
    text = case(job="output = 'out/wall', titel = 'x', thread = 2, histories = 3", stripes="levls = 0.3, count = 3.5")
    (folder / "wall.nml").write_text(text + "&solvr rtol = 1e-6 /\n&buildng period = 0.3 /\n")
    lines = [line.removeprefix("dondolo: wall.nml: ") for line in run("--check", "wall.nml").stderr.splitlines()]
    parts = [
        ("&solvr (line 5): no such group; there are &job, &wall,",),
        ("&buildng (line 6): no such group",),
        ("&job: titel (line 1): no such variable; there are 'task', ", "; did you mean 'title'?"),
        ("&job: thread (line 1): no such variable; did you mean 'threads'?",),
        ("&job: histories = 3: must be .true. or .false.",),
        ("&stripes: levls (line 4): no such variable; there are 'im', ", "; did you mean 'levels'?"),
        ("&stripes: count = 3.5: must be an integer (line 4)",),
    ]
    assert len(lines) == len(parts)
    for line, (start, *end) in zip(lines, parts, strict=True):
        assert line.startswith(start)
        assert line.endswith(end[0] if end else line)


def test_values_of_several_groups_are_refused_at_once(folder):
    wall = "mechanism = 'one_sided', height = -2.4, thickness = 0.0"
    text = case(wall=wall, stripes="levels = 0.5, 0.3", records="catalogue = 'records.csv', polarity = 'x'")
    (folder / "wall.nml").write_text(text)
    with pytest.raises(dd.errors.InputError) as caught:
        dd.read_case(folder / "wall.nml")
    assert [(one.code, one.variable, one.place[-7:]) for one in caught.value.errors] == [
        ("not_increasing", "levels", "line 4)"),
        ("not_a_word", "polarity", "line 3)"),
        ("out_of_range", "height", "line 2)"),
        ("out_of_range", "thickness", "line 2)"),
    ]
    # A missing file alone remains one
    (folder / "wall.nml").write_text(case(wall="mechanism = 'tabulated', table = 'none.csv'"))
    with pytest.raises(dd.errors.MissingFileError):
        dd.read_case(folder / "wall.nml")


def test_all_headings_that_are_wrong_are_named(folder, run):
    (folder / "walls.csv").write_text("mechansm,height,thicknes,colour\none_sided,2.4,0.3,red\n")
    groups = {"population": "file = 'walls.csv'", "job": "task = 'typology', output = 'out'"}
    (folder / "walls.nml").write_text("".join(f"&{name} {text} /\n" for name, text in (PARTS | groups).items() if text))
    assert run("--check", "walls.nml").stderr.splitlines() == [
        "dondolo: walls.csv: column 'mechansm': no such column; did you mean 'mechanism'? dondolo --template typology"
        " lists all; one that is only kept begins with x_ or note",
        "dondolo: walls.csv: column 'thicknes': no such column; did you mean 'thickness'?",
        "dondolo: walls.csv: column 'colour': no such column",
    ]
    (folder / "walls.csv").write_text("name,density\na,1800\n")
    missing = [line.split("'")[1] for line in run("--check", "walls.nml").stderr.splitlines()]
    assert missing == ["mechanism", "height", "thickness"]
    (folder / "records.csv").write_text("path,dt,unit\nr0.txt,0.01,g\n")
    (folder / "wall.nml").write_text(case())
    said = run("--check", "wall.nml").stderr
    assert [words in said for words in ("no column 'file'", "column 'dt'", "column 'unit'")] == [True] * 3


@pytest.mark.parametrize("word", ["check", "status", "template", "help", "chek"])
def test_options_without_dashes(folder, run, word):
    (folder / "wall.nml").write_text(case())
    done = run(word, "wall.nml")
    assert done.returncode == 2
    assert f"dondolo --{word}" in done.stderr if word != "chek" else "did you mean '--check'?" in done.stderr
    assert not (folder / "out").exists()


def test_a_case_in_the_place_of_results(folder, monkeypatch):
    monkeypatch.chdir(folder)
    (folder / "wall.nml").write_text(case())
    with pytest.raises(
        dd.errors.InputError, match=r"is a case, .* 'out/wall'; there are none yet, dondolo wall.nml writes them"
    ):
        dd.read_results("wall.nml")
    with pytest.raises(dd.errors.InputError, match=r"'records.csv': is a file, must be the prefix of result files"):
        dd.read_results("records.csv")


def test_prefixes_that_are_nearly_right(folder, run, monkeypatch):
    monkeypatch.chdir(folder)
    (folder / "wall.nml").write_text(case())
    assert run("wall.nml").returncode == 0
    with pytest.raises(dd.errors.InputError, match=r"is a case, must be the prefix of its result files, 'out/wall'$"):
        dd.read_results("wall.nml")
    with pytest.raises(dd.errors.InputError, match=r"'out': is a folder, .* such as 'out/wall'$"):
        dd.read_results("out")
    with pytest.raises(dd.errors.InputError, match=r"must be the prefix of result files, 'out/wall'$"):
        dd.read_results("out/wall_")
    for name in ("out/wall.nml", "out/wall.txt"):
        with pytest.raises(dd.errors.InputError, match=r"must be the prefix of result files, such as 'out/wall'$"):
            dd.read_results(name)
    assert dd.read_results("out/wall").stripes is not None


def test_levels_are_the_same_numbers(folder, run, monkeypatch):
    """numpy.linspace and first, last, count give the same stripes to the last bit, and short decimals."""
    monkeypatch.chdir(folder)
    wall = dd.OneSidedWall(2.4, 0.3, name="wall")
    for first, last, count in ((0.1, 1.3, 13), (0.15, 0.9, 8), (0.2, 1.1, 6), (0.07, 0.91, 4)):
        (folder / "wall.nml").write_text(case(stripes=f"first = {first}, last = {last}, count = {count}"))
        assert run("wall.nml").returncode == 0
        of_case = dd.read_results("out/wall").stripes
        ours = dd.multiple_stripe(
            wall, dd.read_catalogue("records.csv"), np.linspace(first, last, count), progress=False
        )
        assert ours.levels.tobytes() == of_case.levels.tobytes()
        assert ours.edp.tobytes() == of_case.edp.tobytes()
    tenths = [0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8]
    records = dd.read_catalogue("records.csv")
    for levels in (np.linspace(0.1, 0.8, 8), np.arange(0.1, 0.85, 0.1), tenths):
        assert dd.multiple_stripe(wall, records, levels, progress=False).levels.tolist() == tenths
    uneven = np.geomspace(0.1, 0.8, 4)
    assert dd.multiple_stripe(wall, records, uneven, progress=False).levels.tobytes() == uneven.tobytes()


def test_levels_are_the_nearest_short_numbers():
    """As printed with 14 digits and read again, of any size."""
    drawn = np.random.default_rng(5)
    for size in (1e-9, 1e-3, 1.0, 10.0, 1e5, 1e13):
        for _ in range(100):
            count = int(drawn.integers(3, 40))
            first, step = (float(f"{size * x:.3g}") for x in drawn.uniform(0.01, 1.0, 2))
            levels = np.linspace(first, first + step * (count - 1), count)
            a, b = (float(f"{x:.13e}") for x in levels[[0, -1]])
            between = [((count - 1 - i) * a + i * b) / (count - 1) for i in range(1, count - 1)]
            expected = [a, *(float(f"{x:.13e}") for x in between), b]
            assert _core.stripes.settle(levels).tolist() == expected


def test_all_rows_of_a_catalogue_that_are_wrong_are_reported(folder, run):
    (folder / "wall.nml").write_text(case())
    rows = ["none.txt,0.01,g", "r0.txt,0.01,m/s2", "other.txt,0.01,g", "r1.txt,abc,g", "r2.txt,0.01,m/s2"]
    (folder / "records.csv").write_text("file,dt_s,units\n" + "\n".join(rows) + "\n")
    told = run("--check", "wall.nml").stderr.splitlines()
    assert ["line 2" in told[0], "line 4" in told[1], "line 5" in told[2], len(told)] == [True, True, True, 3]
    assert ["no such file" in line for line in told] == [True, True, False]
    # Many are counted, and files that are missing alone remain so
    many = "".join(f"none{i}.txt,0.01,g\n" for i in range(100))
    (folder / "records.csv").write_text("file,dt_s,units\n" + many)
    with pytest.raises(dd.errors.MissingFileError) as caught:
        dd.read_catalogue(folder / "records.csv")
    *lines, last = str(caught.value).splitlines()
    assert len(lines) > 3
    assert all("no such file" in line for line in lines)
    assert last == f"and {100 - len(lines)} more"


def test_rows_of_a_part_begin_at_one(folder, run):
    assert "counted from 1, such as --walls 1:500" in run("--walls", "0:10", "walls.nml").stderr


def test_a_merge_that_fails_replaces_nothing(folder, run):
    (folder / "walls.csv").write_text("mechanism,height,thickness\none_sided,2.4,0.3\none_sided,3.0,0.3\n")
    groups = {"population": "file = 'walls.csv'", "job": "task = 'typology', output = 'out/x'"}
    (folder / "walls.nml").write_text("".join(f"&{name} {text} /\n" for name, text in (PARTS | groups).items() if text))
    assert run("walls.nml").returncode == 0
    published = set(folder.glob("out/*"))
    for rows in ("1:1", "2:2"):
        assert "replaces the results" not in run("--walls", rows, "walls.nml").stderr
    parts = sorted(map(str, set(folder.glob("out/*")) - published))
    failed = run("--merge", "walls.nml", parts[0])
    assert failed.returncode == 2
    assert "row 2 of 2 is missing" in failed.stderr
    assert "replaces the results" not in failed.stderr
    assert "replaces the results" in run("--merge", "walls.nml", *parts).stderr


def test_a_return_period_beyond_the_hazards_is_said_to_be_extrapolated(folder, run):
    hazards = "ag = 0.08, 0.2, 0.26, f0 = 2.5, 2.5, 2.5, tc_star = 0.3, 0.35, 0.36, soil = 'B'"
    hazards += ", reference_life = 50, exceedance = 0.63, 0.1, 0.05"
    shown = {}
    for thickness in ("0.5", "1.5"):
        wall = f"mechanism = 'one_sided', height = 6.0, thickness = {thickness}"
        (folder / "wall.nml").write_text(case(wall=wall, check=hazards))
        (shown[thickness],) = re.findall("(?m)^return period .*$", run("--check", "wall.nml").stdout)
    assert shown["0.5"].endswith("of the hazard 474.6 years")
    assert shown["1.5"].endswith(
        "> 2475 years, of the hazard 474.6 years; extrapolated beyond the hazards of the limit states"
    )
