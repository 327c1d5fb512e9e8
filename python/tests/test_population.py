"""Populations: groups, mechanisms of one wall, tables, and size."""

import csv
import gc
import math
import pickle
import subprocess
import sys
import tracemalloc

import numpy as np
import pytest
from costs import growth
from hypothesis import given
from hypothesis import strategies as st

import dondolo as dd

ROWS = [
    dd.OneSidedWall(6.4, 0.38, name="a"),
    dd.TwoBlockWall(
        3.2,
        0.38,
        hinge=0.6,
        overburden=4000.0,
        overburden_inertia=0.0,
        eccentricity=0.05,
        restitution_factor=0.87,
        name="a",
    ),
    dd.FreeStandingWall(1.8, 0.4, restitution_value=0.7, density=2000.0, name='b, "the" #2'),
    dd.OneSidedWall(1.0, 0.25, name="c"),
]
PEOPLE = dd.Population(
    ROWS, [2.0, 2.0, 5.0, 0.0], group_names=["low", "low", "high, free", ""], p_occ=[0.4, 0.6, 1.0, 0.0]
)


def same(one, other):
    """Are all walls and all that is said of them the same to the bit?"""
    return (
        one.walls == other.walls
        and [type(wall) for wall in one] == [type(wall) for wall in other]
        and one.group_names == other.group_names
        and np.array_equal(one.weights, other.weights)
        and np.array_equal(one.p_occ, other.p_occ)
    )


def test_defaults():
    people = dd.Population([dd.OneSidedWall(3.0, 0.25), dd.OneSidedWall(3.5, 0.25)])
    assert people.group_names == ("", "")
    assert people.weights.tolist() == people.p_occ.tolist() == [1.0, 1.0]
    assert [wall.name for wall in people] == ["wall 1", "wall 2"]
    assert people.origin == ()
    assert dd.Population(dd.OneSidedWall(3.0, 0.25))[0].name == "wall"


def test_an_unnamed_wall_takes_the_name_of_no_other():
    people = dd.Population([dd.OneSidedWall(3.0, 0.3, name="wall 2"), dd.TwoBlockWall(3.0, 0.3)])
    assert [wall.name for wall in people] == ["wall 2", "wall 3"]
    assert "walls 2, mechanisms 2" in repr(people)
    unnamed = dd.OneSidedWall(3.0, 0.3)
    several = [unnamed, unnamed, dd.OneSidedWall(3.0, 0.3, name="wall 1"), unnamed, unnamed]
    assert [wall.name for wall in dd.Population(several)] == ["wall 2", "wall 3", "wall 1", "wall 4", "wall 5"]


def test_where_each_wall_begins():
    assert PEOPLE.first_rows.tolist() == [0, 2, 3]
    assert PEOPLE[1:].first_rows.tolist() == [0, 1, 2]
    assert not PEOPLE.first_rows.flags.writeable


def test_rows_and_parts():
    assert len(PEOPLE) == 4
    assert PEOPLE[1] is ROWS[1]
    assert PEOPLE[-1] is ROWS[3]
    part = PEOPLE[1:3]
    assert isinstance(part, dd.Population)
    assert part.walls == tuple(ROWS[1:3])
    assert part.group_names == ("low", "high, free")
    assert part.weights.tolist() == [2.0, 5.0]
    assert part.p_occ.tolist() == [0.6, 1.0]
    assert [wall.name for wall in PEOPLE[::-1]] == ["c", 'b, "the" #2', "a", "a"]
    assert same(PEOPLE.group("low"), PEOPLE[:2])
    with pytest.raises(dd.errors.InputError, match="group = 'none': must be one of 'low', 'high, free', ''"):
        PEOPLE.group("none")
    with pytest.raises(dd.errors.InputError, match="walls: must be given"):
        PEOPLE[4:]
    assert same(PEOPLE[PEOPLE.weights > 1.0], PEOPLE[np.flatnonzero(PEOPLE.weights > 1.0)])
    assert [wall.name for wall in PEOPLE[[3, 0]]] == ["c", "a"]
    assert PEOPLE[np.int64(1)] is ROWS[1]
    for which in ("low", None, [True, False], [4], 1.5):
        with pytest.raises(dd.errors.InputError, match="must be a number, a slice, or numbers or a mask of 4 rows"):
            PEOPLE[which]
    assert not PEOPLE.p_occ.flags.writeable
    assert same(pickle.loads(pickle.dumps(PEOPLE)), PEOPLE)


def test_joined():
    other = dd.Population(
        [dd.OneSidedWall(2.0, 0.3, name="d")], [3.0], group_names=["low"], p_occ=[0.5], origin=["walls of the east"]
    )
    both = PEOPLE + other
    assert len(both) == 5
    assert same(both[:4], PEOPLE)
    assert both.group_names[4] == "low"
    assert (both.weights[4], both.p_occ[4]) == (3.0, 0.5)
    assert both.origin == ("walls of the east",)
    assert len(both.group("low")) == 3
    with pytest.raises(dd.errors.InputError, match="name = 'd': both populations have a wall of this name"):
        both + other
    unnamed = dd.Population(dd.OneSidedWall(3.0, 0.25)) + dd.Population(dd.TwoBlockWall(3.0, 0.25))
    assert [wall.name for wall in unnamed] == ["wall 1", "wall 2"]
    with pytest.raises(TypeError):
        both + ROWS


def test_shown():
    for text in (repr(PEOPLE), PEOPLE._repr_html_()):
        for word in ("walls", "mechanisms", "sum of the weights", "low", "high, free"):
            assert word in text
    assert "walls 3, mechanisms 4, sum of the weights 7" in repr(PEOPLE)
    assert "groups" not in repr(dd.Population(ROWS[:1]))
    assert "1 to 6.4 m" in PEOPLE._repr_html_()


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        ({"p_occ": [0.4, 1.2, 1.0, 1.0]}, "wall 'a': p_occ = 1.2: must lie between 0 and 1"),
        ({"p_occ": [0.4, 0.6, -0.1, 1.0]}, "wall 'b, \"the\" #2': p_occ = -0.1: must lie between 0 and 1"),
        ({"p_occ": [0.4, 0.6, math.nan, 1.0]}, "wall 'b, \"the\" #2': p_occ = nan: must lie between 0 and 1"),
        ({"p_occ": [0.4]}, "4 walls, 1 values of p_occ: must be as many"),
        ({"weights": [2.0, 2.0, 1.0, -1.0]}, "wall 'c': weight = -1.0: must not be negative"),
        ({"weights": [2.0, 2.0, 1.0, math.inf]}, "wall 'c': weight = inf: must not be negative"),
        ({"weights": [0.0] * 4}, "weight: must be positive for at least one wall"),
        ({"weights": [1.0, 2.0, 1.0, 1.0]}, "name = 'a': mechanisms of one wall must have the same weight and group"),
        ({"group_names": ["x", "y", "", ""]}, "name = 'a': mechanisms of one wall must have the same weight and group"),
        (
            {"group_names": ["x", "x", "a\nb", ""]},
            "wall 'b, \"the\" #2': group = 'a\\nb': must be one line without control characters and marks of direction",
        ),
        ({"group_names": ["x", "x", 3, ""]}, "wall 'b, \"the\" #2': group = 3: must be a string"),
        ({"group_names": ["x"]}, "4 walls, 1 group_names: must be as many"),
        ({"group_names": 5}, "group_names = 5: must be a name for each wall"),
        ({"group_names": "abcd"}, "group_names = 'abcd': must be a name for each wall"),
        (
            {"origin": ["two\nlines"]},
            "origin = 'two\\nlines': must be one line without control characters and marks of direction",
        ),
        ({"origin": "hello"}, "origin = 'hello': must be lines"),
    ],
)
def test_errors(arguments, sentence):
    with pytest.raises(dd.errors.InputError) as caught:
        dd.Population(ROWS, **arguments)
    assert str(caught.value) == sentence


@pytest.mark.parametrize(
    ("walls", "sentence"),
    [(3, "walls = 3: must be walls"), ("ab", "walls = 'ab': must be walls"), ([3], "walls: must be a Wall, not int")],
)
def test_no_walls(walls, sentence):
    with pytest.raises(dd.errors.InputError) as caught:
        dd.Population(walls)
    assert str(caught.value) == sentence


@pytest.mark.parametrize(
    ("order", "sentence"),
    [
        ([0, 2, 1], "name = 'a': another wall has this name; mechanisms of one wall must be on consecutive rows"),
        ([0, 0], "name = 'a': another wall of this name has the same mechanism"),
        ([0, 1, 0], "name = 'a': another wall of this name has the same mechanism"),
    ],
)
def test_names(order, sentence):
    with pytest.raises(dd.errors.InputError) as caught:
        dd.Population([ROWS[i] for i in order])
    assert str(caught.value) == sentence


@pytest.mark.filterwarnings("ignore::dondolo.errors.DondoloWarning")
def test_mechanisms_of_one_wall_run(few):
    people = dd.Population(ROWS[:2], p_occ=[0.4, 0.6])
    together = dd.typology(people, few, [0.5, 1.0], progress=False)
    for i, wall in enumerate(ROWS[:2]):
        alone = dd.multiple_stripe(wall, few, [0.5, 1.0], polarity="as_recorded", progress=False)
        assert together.collapses[:, i].tolist() == alone.collapsed.sum(axis=1).tolist()


def test_table(tmp_path):
    named = dd.Population(
        PEOPLE.walls, PEOPLE.weights, group_names=PEOPLE.group_names, p_occ=PEOPLE.p_occ, origin=["surveyed in spring"]
    )
    named.to_csv(tmp_path / "walls.csv")
    lines = (tmp_path / "walls.csv").read_text().splitlines()
    assert lines[0] == "# surveyed in spring"
    assert lines[1] == (
        "name,mechanism,height,thickness,density,hinge,restitution,restitution_value,restitution_factor,"
        "overburden,overburden_inertia,eccentricity,weight,group,p_occ"
    )
    assert lines[2] == "a,one_sided,6.4,0.38,1800,,default,,1,,,,2,low,0.4"
    assert lines[4] == '"b, ""the"" #2",free_standing,1.8,0.4,2000,,default,0.7,1,,,,5,"high, free",1'
    back = dd.Population.from_csv(tmp_path / "walls.csv")
    assert same(back, PEOPLE)
    assert back.origin == ("read from walls.csv",)
    with pytest.raises(dd.errors.DondoloError, match="cannot be written"):
        PEOPLE.to_csv(tmp_path / "nowhere" / "walls.csv")


NAMES = st.text(st.characters(exclude_categories=("C", "Z")) | st.sampled_from(' ,"#;'), min_size=1, max_size=12)


@given(
    numbers=st.lists(st.floats(0.05, 1.0), min_size=4, max_size=4),
    eccentricity=st.sampled_from([0.0, -0.0]) | st.floats(-1e-3, 1e-3),
    weight=st.floats(1e-300, 1e12),
    p_occ=st.floats(0.0, 1.0),
    name=NAMES,
    group=NAMES,
)
def test_tables_are_read_back_to_the_bit(tmp_path_factory, numbers, eccentricity, weight, p_occ, name, group):
    height, thickness, hinge, load = numbers
    wall = dd.TwoBlockWall(
        10.0 * height,
        thickness,
        hinge=0.9 * hinge,
        overburden=1e5 * load,
        overburden_inertia=0.0,
        eccentricity=eccentricity,
        name=name,
    )
    people = dd.Population([wall], [weight], group_names=[group], p_occ=[p_occ])
    path = tmp_path_factory.mktemp("tables") / "walls.csv"
    people.to_csv(path)
    back = dd.Population.from_csv(path)
    assert same(back, people)
    assert math.copysign(1.0, back[0].eccentricity) == math.copysign(1.0, eccentricity)


SPREADSHEET = "Rilievo, 2024;;;;\r\nname;mechanism;height;thickness;\r\nunità;ONE_SIDED;3,5;0,25;\r\n;;;;\r\n"


@pytest.mark.parametrize(
    ("encoding", "end"), [("utf-8-sig", "\r\n"), ("utf-16", "\r\n"), ("utf-8", "\r"), ("utf-16", "\r")]
)
def test_table_of_a_spreadsheet(encoding, end, tmp_path):
    path = tmp_path / "walls.csv"
    path.write_text(SPREADSHEET.replace("\r\n", end), encoding=encoding, newline="")
    with pytest.warns(dd.errors.DondoloWarning) as caught:
        (wall,) = dd.Population.from_csv(path)
    note = "read with columns separated by semicolons, decimal commas, line 1 is a title"
    assert [str(warning.message) for warning in caught] == [f"{path}: {note}"]
    assert (wall.name, wall.mechanism, wall.height, wall.thickness) == ("unità", "one_sided", 3.5, 0.25)


@pytest.mark.parametrize("encoding", ["cp1252", "utf-16-le"])
def test_table_that_is_no_utf8(encoding, tmp_path):
    path = tmp_path / "walls.csv"
    path.write_text(SPREADSHEET, encoding=encoding)
    with pytest.raises(
        dd.errors.InputError, match=r"line \d: byte \d.* is .*: save it as UTF-8 \(Excel: Save As, CSV UTF-8; Notepad: "
    ) as caught:
        dd.Population.from_csv(path)
    assert "\n" not in str(caught.value)


def test_blanks_of_names_are_kept(tmp_path):
    people = dd.Population(ROWS[3:], group_names=[" north"])
    people += dd.Population([dd.OneSidedWall(1.0, 0.25, name="  d")], group_names=["south "])
    people.to_csv(tmp_path / "walls.csv")
    back = dd.Population.from_csv(tmp_path / "walls.csv")
    assert [wall.name for wall in back] == ["c", "  d"]
    assert back.group_names == (" north", "south ")


def test_the_executable_reads_it(run, root, tmp_path):
    PEOPLE.to_csv(tmp_path / "walls.csv")
    (tmp_path / "case.nml").write_text(
        "&job task = 'typology' output = 'x' /\n&population file = 'walls.csv' /\n"
        f"&records catalogue = '{root}/data/records/synthetic44.csv' /\n&stripes levels = 0.5 /\n"
    )
    done = run("--check", "case.nml")
    assert done.returncode == 0, done.stderr
    case = dd.read_case(tmp_path / "case.nml")
    assert same(case.population, PEOPLE)


@pytest.mark.slow
def test_many_walls_take_linear_time(tmp_path):
    """Eight times as many cost about eight times as much, and not 64 times."""

    def work(count):
        people = dd.Population.from_csv(tmp_path / f"{count}.csv")
        assert (people[-1].name, people.group_names[-1]) == (f"wall {count - 1}", f"g{(count - 1) % 7}")
        again = people + dd.Population([dd.OneSidedWall(3.0, 0.25, name="last")])
        again.to_csv(tmp_path / "again.csv")
        assert len(again) == count + 1

    sizes = (1500, 12_000)
    for count in sizes:
        rows = (f"wall {i},one_sided,{2.0 + i / count!r},0.25,g{i % 7}\n" for i in range(count))
        path = tmp_path / f"{count}.csv"
        path.write_text("name,mechanism,height,thickness,group\n" + "".join(rows))
    assert growth(work, *sizes) < 24.0
    text = path.read_text()
    path.write_text(text + "wall 17,one_sided,3,0.25,\n")
    with pytest.raises(dd.errors.InputError, match=f"line {count + 2}: name = 'wall 17': another wall has this name"):
        dd.Population.from_csv(path)


def test_figure(tmp_path):
    for by in ("mechanism", "group"):
        above, below = PEOPLE.plot(by=by).figure.axes
        labels = above.get_legend_handles_labels()[1]
        expected = {
            "mechanism": ["one_sided (2)", "two_block (1)", "free_standing (1)"],
            "group": ["low (2)", "high, free (1)", "no group (1)"],
        }
        assert labels == expected[by]
        values = [patch.get_data().values for patch in below.patches]
        sums = {"mechanism": [2.0, 2.0, 5.0], "group": [4.0, 5.0, 0.0]}
        assert [value.sum() for value in values] == sums[by]
        above.figure.savefig(tmp_path / "figure.png")
    first = PEOPLE[:1].plot()
    assert PEOPLE.plot(first.figure.axes) is first
    with pytest.raises(dd.errors.InputError, match="by = 'colour'"):
        PEOPLE.plot(by="colour")


def test_a_data_frame_is_read_as_its_file_is(tmp_path):
    pd = pytest.importorskip("pandas")
    storeys = [dd.Section(3.0, 0.5), dd.Section(2.5, 0.3)]
    walls = [
        dd.OneSidedWall(2.4, 0.3, name="=a, b"),
        dd.TwoBlockWall(3.0, 0.25, name="c", hinge=0.6),
        dd.OneSidedWall(sections=storeys, name="d"),
    ]
    population = dd.Population(walls, [1.5, 2.0, 1.0 / 3.0], group_names=["x", "", "y"], p_occ=[0.2, 1.0, 0.5])
    population.to_csv(tmp_path / "walls.csv")
    frame = pd.read_csv(tmp_path / "walls.csv", comment="#")
    again = dd.Population.from_frame(frame)
    assert again.walls == population.walls
    assert (again.weights == population.weights).all()
    assert (again.p_occ == population.p_occ).all()
    assert (again.group_names, again.occurrence) == (population.group_names, population.occurrence)
    with pytest.raises(dd.errors.InputError, match=r"Population\.from_frame makes them of a data frame"):
        dd.Population(frame)
    with pytest.raises(dd.errors.InputError, match="must be a pandas DataFrame"):
        dd.Population.from_frame("walls.csv")
    frame["height"] = [2.4, -1.0, float("nan")]
    with pytest.raises(dd.errors.InputError, match=r"^frame\.iloc\[1\]: .*height = -1") as caught:
        dd.Population.from_frame(frame)
    assert caught.value.errors[0].place.startswith("frame.iloc[1]")
    with pytest.raises(dd.errors.InputError, match=r"^frame: column 'hight': no such column; did you mean 'height'"):
        dd.Population.from_frame(frame.rename(columns={"height": "hight"}))
    with pytest.raises(
        dd.errors.InputError, match=r"frame\.iloc\[0\]: thickness = \[1\]: must be a number or a string"
    ):
        dd.Population.from_frame(pd.DataFrame({"thickness": [[1]]}))


SURVEY = (
    "name,mechanism,height,thickness,group,x_Indirizzo,p_occ,Note 2,x_date\n"
    '"1.1",one_sided,2.4,0.3,a,"via Roma 3, interno ""B""",0.5,=1+1,2026-03-01\n'
    '"1.1",two_block,2.4,0.3,a,,1,crepa # 2,\n'
    "b,one_sided,3.0,0.3,,12,1,,-\n"
)
NOTES = {
    "x_Indirizzo": ('via Roma 3, interno "B"', "", "12"),
    "Note 2": ("=1+1", "crepa # 2", ""),
    "x_date": ("2026-03-01", "", "-"),
}


@pytest.mark.filterwarnings("ignore::dondolo.errors.DondoloWarning")
def test_notes_are_kept_by_every_route(executable, root, tmp_path):
    """Executable, Population, frames, results read, written again, saved, and parts of a population."""
    (tmp_path / "walls.csv").write_text(SURVEY)
    (tmp_path / "case.nml").write_text(
        "&job task = 'typology', output = 'out' / &population file = 'walls.csv' /\n"
        f"&records catalogue = '{root}/data/records/synthetic44.csv' / &stripes levels = 0.4, 0.6, 0.8 /\n"
    )
    subprocess.run([executable, "--quiet", "case.nml"], cwd=tmp_path, check=True, capture_output=True)
    people = dd.Population.from_csv(tmp_path / "walls.csv")
    assert people.notes == NOTES
    people.to_csv(tmp_path / "again.csv")
    assert dd.Population.from_csv(tmp_path / "again.csv").notes == NOTES
    read, ran = dd.read_results(tmp_path / "out"), dd.run_case(tmp_path / "case.nml", progress=False)
    assert read.population.notes == ran.population.notes == NOTES
    assert dd.read_case(tmp_path / "case.nml").population.notes == NOTES
    read.write_results(tmp_path / "copy")
    ran.typology.write_results(tmp_path / "python")
    tables = [(tmp_path / f"{one}_walls.csv").read_text() for one in ("out", "copy", "python")]
    bodies = ["".join(line for line in table.splitlines(True) if not line.startswith("# ")) for table in tables]
    assert bodies[0] == bodies[1] == bodies[2]
    assert bodies[0].splitlines()[0].endswith(",p_occ,x_Indirizzo,Note 2,x_date")
    # Nothing depends on them
    bare = "\n".join(",".join([*row[:5], row[6]]) for row in csv.reader(SURVEY.splitlines()))
    (tmp_path / "bare.csv").write_text(bare + "\n")
    how = dd.example_records(), [0.4, 0.6, 0.8]
    other = dd.typology(dd.Population.from_csv(tmp_path / "bare.csv"), *how, progress=False)
    mine = dd.typology(people, *how, progress=False)
    assert np.array_equal(other.exceedances, mine.exceedances)
    mine.save(tmp_path / "saved.npz")
    assert dd.load(tmp_path / "saved.npz").population.notes == NOTES
    assert pickle.loads(pickle.dumps(people)).notes == NOTES
    assert people[[2]].notes == {name: texts[2:] for name, texts in NOTES.items()}
    more = people + dd.Population([dd.OneSidedWall(2.0, 0.3, name="c")], notes={"note_2": ["new"]})
    assert more.notes == {name: (*texts, "") for name, texts in NOTES.items()} | {"note_2": ("", "", "", "new")}
    page = (tmp_path / "page.html", dd.report(mine, tmp_path / "page.html"))[0].read_text()
    assert "via Roma 3, interno" in page
    assert "x_Indirizzo" in page
    openpyxl = pytest.importorskip("openpyxl")
    for lang in ("en", "it"):
        dd.write_workbook(tmp_path / "out", tmp_path / f"{lang}.xlsx", lang=lang)
        head, *rows = openpyxl.load_workbook(tmp_path / f"{lang}.xlsx").worksheets[1].iter_rows()
        at = [cell.value for cell in head].index("x_Indirizzo")
        cells = [[(cell.value, cell.data_type) for cell in row[at : at + 3] if cell.value is not None] for row in rows]
        expected = [[(one, "s") for one in own if one] for own in zip(*NOTES.values(), strict=True)]
        assert cells == expected


def test_notes_of_frames():
    pandas = pytest.importorskip("pandas")
    days = pandas.to_datetime(["2026-03-01", None])
    frame = pandas.DataFrame(
        {"mechanism": "one_sided", "height": [2.4, 3.0], "thickness": 0.3, "x_day": days, "note": ["a", None], "x_n": 1}
    )
    people = dd.Population.from_frame(frame)
    assert people.notes == {"x_day": ("2026-03-01 00:00:00", ""), "note": ("a", ""), "x_n": ("1", "1")}
    assert people.to_frame()["note"].tolist() == ["a", ""]


@pytest.mark.parametrize(
    ("notes", "message"),
    [
        ({"address": ["a", "b"]}, "notes: 'address': must begin with x_ or note"),
        ({"x_a": ["a"]}, "2 walls, 1 x_a: must be as many"),
        ({"x_a": ["a", 3]}, "x_a = 3: must be a string"),
        ({"x_a": ["a", "b\nc"]}, "wall 'w2': x_a = .*: must be one line"),
        ({"x_a": ["a", "b"], "X_A": ["a", "b"]}, "'x_a' is there twice"),
        (["x_a"], "notes = .*: must be a mapping"),
    ],
)
def test_wrong_notes(notes, message):
    walls = [dd.OneSidedWall(2.0, 0.3, name=f"w{i}") for i in (1, 2)]
    with pytest.raises(dd.errors.InputError, match=message):
        dd.Population(walls, notes=notes)


def test_other_columns_are_refused_with_what_to_write(tmp_path):
    for column in ("address", "date", "surveyor", "indirizzo"):
        (tmp_path / "walls.csv").write_text(f"name,mechanism,height,thickness,{column}\na,one_sided,2.4,0.3,x\n")
        with pytest.raises(dd.errors.InputError, match=f"column '{column}': no such column.* begins with x_ or note$"):
            dd.Population.from_csv(tmp_path / "walls.csv")
    (tmp_path / "walls.csv").write_text('name,mechanism,height,thickness,note\na,one_sided,2.4,0.3,"two\nlines"\n')
    with pytest.raises(dd.errors.InputError, match=r"line 2: note = 'two\\nlines': must be one line"):
        dd.Population.from_csv(tmp_path / "walls.csv")


def test_walls_are_columns(tmp_path):
    """A wall of many takes at most 400 bytes beyond its texts, and is the same wall whenever it is asked for."""
    n = 4000
    rows = "".join(
        f"row houses {i // 2},{kind},{2.0 + 0.0005 * i:g},0.38,{rest},12,row houses,0.5\n"
        for i in range(n)
        for kind, rest in [(("one_sided", ",,"), ("two_block", "0.56,1300,0"))[i % 2]]
    )
    head = "name,mechanism,height,thickness,hinge,overburden,overburden_inertia,weight,group,p_occ\n"
    (tmp_path / "walls.csv").write_text(head + rows)
    dd.Population.from_csv(tmp_path / "walls.csv")
    gc.collect()
    tracemalloc.start()
    try:
        before = tracemalloc.get_traced_memory()[0]
        people = dd.Population.from_csv(tmp_path / "walls.csv")
        people.wholes, people.first_rows, people.alternative_numbers  # noqa: B018
        gc.collect()
        taken = tracemalloc.get_traced_memory()[0] - before
    finally:
        tracemalloc.stop()
    texts = sum(sys.getsizeof(wall.name) for wall in people)
    assert taken - texts / 2 < 400 * n
    # As objects they are alike, in the memory of Fortran too
    again = dd.Population(tuple(people.walls), people.weights, group_names=people.group_names, p_occ=people.p_occ)
    assert again.walls == people.walls == tuple(people)
    assert repr(again) == repr(people)
    for name, column in people._table().items():
        assert list(map(repr, column.values)) == list(map(repr, again._table()[name].values)), name
    assert pickle.loads(pickle.dumps(people)).walls == people.walls
    wall = people[17]
    assert wall is people[17]
    assert people[10:20][7] == wall
    assert (people.walls[-1], people.walls[5:3:-1]) == (people[n - 1], (people[5], people[4]))
    with pytest.raises(IndexError):
        people[n]


def test_walls_with_parts_are_columns():
    """Lists, words, buildings and tables come back as they were given."""
    house = dd.Building(0.3, storeys=3, level=9.0, building_height=9.0)
    storeys = [dd.Section(4.0, 0.6), dd.Section(3.5, 0.45)]
    loads = [dd.Load(9e3, depth=0.1, height=3.0, inertia="both"), dd.Load(4e3, depth=0.2, height=7.0, inertia="both")]
    q = np.linspace(0.0, 0.3, 9)
    walls = [
        dd.OneSidedWall(3.0, 0.25, name="plain"),
        dd.OneSidedWall(sections=storeys, loads=loads, name="storeys", gravity=9.5),
        dd.OneSidedWall(3.0, 0.3, ties=[dd.Tie(height=2.5, strength=4000.0, length=6.0, area=1e-4)], name="tied"),
        dd.FreeStandingWall(1.5, 0.25, building=house, name="roof"),
        dd.TwoBlockWall(3.0, 0.25, overburden=8e3, overburden_inertia=0.0, bearing="inner", bearing_distance=0.06),
        dd.TabulatedWall(2.0, rotation=q, inertia=900.0, lever=800.0 + q, moment=300.0 - 1000.0 * q, sides=1,
                         restitution_value=0.8, name="table"),
    ]  # fmt: skip
    people = dd.Population(walls)
    alone = [dd.Population([wall]).walls[0] for wall in walls]
    parts = pickle.loads(pickle.dumps(people)).walls
    for wall, own, part in zip(walls, alone, parts, strict=True):
        assert own is wall
        named = wall if wall.name != "wall" else wall._renamed("wall 5")
        assert part == named
        assert repr(part) == repr(named)
        for mine, its in zip(part._flat, named._flat, strict=True):
            assert np.array_equal(mine, its)
    table = dd.Population([wall._renamed(f"w{i}") for i, wall in enumerate(walls)])._table()
    for name, column in dd.Population(pickle.loads(pickle.dumps(people)).walls)._table().items():
        if name != "wall":
            assert list(map(repr, column.values)) == list(map(repr, table[name].values)), name
