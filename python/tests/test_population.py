"""Populations: groups, mechanisms of one wall, tables, and size."""

import math
import pickle

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
PEOPLE = dd.Population(ROWS, [2.0, 2.0, 5.0, 0.0], groups=["low", "low", "high, free", ""], p_occ=[0.4, 0.6, 1.0, 0.0])


def same(one, other):
    """Are all walls and all that is said of them the same to the bit?"""
    return (
        one.walls == other.walls
        and [type(wall) for wall in one] == [type(wall) for wall in other]
        and one.groups == other.groups
        and np.array_equal(one.weights, other.weights)
        and np.array_equal(one.p_occ, other.p_occ)
    )


def test_defaults():
    people = dd.Population([dd.OneSidedWall(3.0, 0.25), dd.OneSidedWall(3.5, 0.25)])
    assert people.groups == ("", "")
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
    assert part.groups == ("low", "high, free")
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
        [dd.OneSidedWall(2.0, 0.3, name="d")], [3.0], groups=["low"], p_occ=[0.5], origin=["walls of the east"]
    )
    both = PEOPLE + other
    assert len(both) == 5
    assert same(both[:4], PEOPLE)
    assert both.groups[4] == "low"
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
        ({"groups": ["x", "y", "", ""]}, "name = 'a': mechanisms of one wall must have the same weight and group"),
        (
            {"groups": ["x", "x", "a\nb", ""]},
            "wall 'b, \"the\" #2': group = 'a\\nb': must be one line without control characters and marks of direction",
        ),
        ({"groups": ["x", "x", 3, ""]}, "wall 'b, \"the\" #2': group = 3: must be a string"),
        ({"groups": ["x"]}, "4 walls, 1 groups: must be as many"),
        ({"groups": 5}, "groups = 5: must be a name for each wall"),
        ({"groups": "abcd"}, "groups = 'abcd': must be a name for each wall"),
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
        PEOPLE.walls, PEOPLE.weights, groups=PEOPLE.groups, p_occ=PEOPLE.p_occ, origin=["surveyed in spring"]
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
    people = dd.Population([wall], [weight], groups=[group], p_occ=[p_occ])
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
        dd.errors.InputError, match=r"line \d: byte \d.* is .*: save it as UTF-8 \(in Excel: CSV UTF-8\)"
    ) as caught:
        dd.Population.from_csv(path)
    assert "\n" not in str(caught.value)


def test_blanks_of_names_are_kept(tmp_path):
    people = dd.Population(ROWS[3:], groups=[" north"])
    people += dd.Population([dd.OneSidedWall(1.0, 0.25, name="  d")], groups=["south "])
    people.to_csv(tmp_path / "walls.csv")
    back = dd.Population.from_csv(tmp_path / "walls.csv")
    assert [wall.name for wall in back] == ["c", "  d"]
    assert back.groups == (" north", "south ")


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
        assert (people[-1].name, people.groups[-1]) == (f"wall {count - 1}", f"g{(count - 1) % 7}")
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
    population = dd.Population(walls, [1.5, 2.0, 1.0 / 3.0], groups=["x", "", "y"], p_occ=[0.2, 1.0, 0.5])
    population.to_csv(tmp_path / "walls.csv")
    frame = pd.read_csv(tmp_path / "walls.csv", comment="#")
    again = dd.Population.from_frame(frame)
    assert again.walls == population.walls
    assert (again.weights == population.weights).all()
    assert (again.p_occ == population.p_occ).all()
    assert (again.groups, again.occurrence) == (population.groups, population.occurrence)
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
