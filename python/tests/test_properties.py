"""Names, defaults, units and meanings of parameters have one home, the tables of the library: Python says the same."""

import dataclasses
import importlib.util
import inspect
import re
import typing

import pytest
from parts import with_parts

import dondolo as dd
from dondolo._fortran.library import properties
from dondolo._fortran.walls import WALL_EXTRAS, WALL_LISTS
from dondolo.walls.chains import TABLES
from dondolo.walls.mechanisms import MECHANISMS
from dondolo.walls.parts import KINDS, PLACES
from dondolo.walls.table import numbered
from dondolo.walls.tabulated import CHECK_TERMS, TERMS

WALL = properties("wall")
(GRAVITY,) = (row for row in properties("solver") if row.name == "gravity")


def entries(kind):
    """Type and description of each parameter in a docstring, those of the parent class included."""
    found = {}
    for owner in (dd.OneSidedWall, kind):
        text = inspect.getdoc(owner)
        section = re.search(r"Parameters\n-+\n(.*?)(?:\n\n[A-Z]\w+\n-+\n|\Z)", text, re.S)
        for name, what, body in re.findall(
            r"^(\w+) : (.*)\n((?:    .*\n?)+)", section[1] + "\n" if section else "", re.M
        ):
            found[name] = what, " ".join(body.split())
    return found


def sentence(row):
    """How a docstring begins to describe a property."""
    text = row.meaning[0].upper() + row.meaning[1:]
    if row.unit:
        text += f" [{row.unit}]"
    if row.default in ("required", "optional", ""):
        return text
    default = repr(row.default) if row.kind == "text" else f"{float(row.default):g}"
    return f"{text}, {default} if left out"


def test_mechanisms():
    (row,) = (row for row in WALL if row.name == "mechanism")
    assert row.choices == tuple(MECHANISMS)
    assert all(set(row.owners) <= set(MECHANISMS) for row in WALL)
    assert all(kind.__name__ in dd.__all__ for kind in MECHANISMS.values())


@pytest.mark.parametrize("kind", MECHANISMS.values(), ids=MECHANISMS)
def test_walls(kind):
    rows = [row for row in WALL if row.name != "mechanism" and (not row.owners or kind.mechanism in row.owners)]
    rows.append(GRAVITY)
    parameters = inspect.signature(kind).parameters
    # What lists of tables have is in parts
    of_parts = {PLACES[row.name][0] for row in rows if row.name in PLACES}
    rows = [row for row in rows if row.name not in PLACES]
    assert set(parameters) == {row.name for row in rows} | of_parts | {"building"}
    said = entries(kind)
    assert of_parts <= set(said)
    for row in rows:
        required = row.default == "required"
        # Sections give a height and a thickness too: they are asked for by Fortran
        assert parameters[row.name].default is None, row.name
        what, description = said[row.name]
        assert description.startswith(sentence(row)), (description, sentence(row))
        kinds = (
            "sequence of float"
            if row.name
            in {
                *("hinge_range", "weight", "displacement", "elevation_x", "elevation_z", "axis_x", "axis_z"),
                *("push", "push_x", *TABLES),
            }
            else "{"
            if row.choices
            else "str"
            if row.kind == "text"
            else "array_like"
            if row.name in (*TERMS, *CHECK_TERMS)
            else "bool"
            if row.kind == "logical"
            else "float"
        )
        assert what.startswith(kinds), row.name
        assert what.endswith(", optional") != required, row.name
        if row.choices and row.name != "restitution":
            assert what.startswith("{" + ", ".join(map(repr, row.choices)) + "}")


# Tabulated walls and chains have no defaults of their own, corners have wings that must be given, horizontal bending a
# thrust
@pytest.mark.parametrize(
    "kind",
    [kind for kind in MECHANISMS.values() if kind not in (dd.Corner, dd.TabulatedWall, dd.Chain, dd.HorizontalBending)],
)
def test_defaults_of_walls(kind):
    wall = kind(3.0, 0.25)
    assert wall.building is None
    for field in dataclasses.fields(wall):
        if field.name in KINDS:
            assert not getattr(wall, field.name)
        if field.name in ("building", *KINDS):
            continue
        (row,) = (row for row in (*WALL, GRAVITY) if row.name == field.name)
        value = getattr(wall, row.name)
        if row.name == "hinge":
            # That of the least multiplier: of a bare strip the highest of the range
            assert value == 0.9
        elif row.default == "optional":
            assert value is None
        elif row.kind == "text":
            assert value == row.default
        elif row.default != "required":
            assert value == float(row.default)


def test_parts():
    """Every list of a table, and what goes with it, is the field of a part, in the order of the table."""
    words = "|".join(kind.word for kind in KINDS.values())
    own = [row.name for row in WALL if re.match(rf"({words})(_|$)", row.name) and row.name not in {*TERMS, *TABLES}]
    assert own == list(PLACES)
    for kind in KINDS.values():
        assert kind.__name__ in dd.__all__
        said = entries(kind)
        for name, row in kind._rows().items():
            assert said[name][1].startswith(row.meaning[0].upper() + row.meaning[1:].split(" if not given")[0])
            assert row.unit == "" or f"[{row.unit}]" in said[name][1]


@pytest.mark.parametrize("kind", KINDS.values(), ids=KINDS)
def test_parts_keep_what_they_are_given(kind):
    """Values of my own, one a field: as given, in words that make the same part again, and changed one by one."""
    values = {name: row.choices[-1] if row.choices else 1.5 + i for i, (name, row) in enumerate(kind._rows().items())}
    part = kind(**values)
    assert {name: getattr(part, name) for name in values} == values
    assert eval(repr(part), {one.__name__: one for one in KINDS.values()}) == part
    for name, value in values.items():
        other = dataclasses.replace(
            part, **{name: values.get("inertia") and "none" if name == "inertia" else value + 1}
        )
        assert other != part
        assert dataclasses.replace(other, **{name: value}) == part


@pytest.mark.parametrize(
    ("make", "sentence"),
    [
        (lambda: dd.OneSidedWall(3.0, 0.25, ties=dd.Tie(2.0, area=1e-5, length=3.0)), "must be a list of dondolo.Tie"),
        (
            lambda: dd.OneSidedWall(3.0, 0.25, ties=[dd.Thrust(1.0, height=2.0)]),
            r"ties\[0\] = Thrust.*: must be a dondolo.Tie",
        ),
        (lambda: dd.Tie("high", area=1e-5, length=3.0), "height = 'high': must be a number"),
        (
            lambda: dd.OneSidedWall(
                3.0, 0.25, loads=[dd.Load(1.0, depth=0.1, height=2.0, inertia=i) for i in ("both", None)]
            ),
            r"loads\[1\]\.inertia: must be given, as loads\[0\] has one",
        ),
        (
            lambda: dd.OneSidedWall(3.0, 0.25, loads=[dd.Load(1.0, depth=0.1, height=2.0)]),
            "loads: inertia: must be given",
        ),
        (
            lambda: dd.OneSidedWall(
                3.0, 0.25, hinge_depth=0.11, loads=[dd.Load(1.0, depth=0.1, height=2.0, inertia="none")]
            ),
            r"must be less deep than loads\[0\]\.depth = 0\.1",
        ),
    ],
)
def test_messages_name_parts(make, sentence):
    with pytest.raises(dd.errors.InputError, match=sentence):
        make()


def test_buildings():
    """`dd.Building` has what the table of buildings has, and says the same of it."""
    said = entries(dd.Building)
    rows = properties("building")
    assert [row.name for row in rows] == [field.name for field in dataclasses.fields(dd.Building)]
    for row in rows:
        assert said[row.name][1].startswith(sentence(row)), row.name


def test_solver():
    """`dd.Solver` has what the table of the solver has, but for what analyses and walls have themselves."""
    rows = {row.name: row for row in properties("solver")}
    fields = {field.name: field for field in dataclasses.fields(dd.Solver)}
    assert set(fields) | {"estimate_error", "certify", "gravity"} == set(rows)
    assert {"estimate_error", "certify"} <= set(inspect.signature(dd.multiple_stripe).parameters)
    assert set(typing.get_args(typing.get_type_hints(dd.Solver)["engine"])) == set(rows["engine"].choices)
    assert fields["engine"].default == rows["engine"].default
    text = inspect.getdoc(dd.Solver)
    for name in ("rtol", "atol", "edp_limit"):
        assert fields[name].default is None
        assert re.search(rf"\b{float(rows[name].default):g}\b".replace("e-0", "e-"), text), name


def test_columns():
    wall = dd.TwoBlockWall(3.0, 0.25, overburden=1000.0, overburden_inertia=0.0)
    population = dd.Population([wall])
    columns = list(population.to_frame().columns)
    own = [
        row.column for row in WALL if row.column and (row.name not in WALL_EXTRAS or row.name == "overburden_inertia")
    ]
    assert columns[: len(own)] == own
    loaded = dd.OneSidedWall(
        3.0,
        0.25,
        loads=[
            dd.Load(10000.0, depth=0.1, height=2.0, inertia="both"),
            dd.Load(20000.0, depth=0.1, height=3.0, inertia="both"),
        ],
    )
    columns = list(dd.Population([wall, loaded]).to_frame().columns)
    assert [name for name in columns if name.startswith("load")] == [
        "load1_n_m",
        "load2_n_m",
        "load1_depth_m",
        "load2_depth_m",
        "load1_height_m",
        "load2_height_m",
        "load1_inertia",
    ]


def test_page_of_variables(root):
    spec = importlib.util.spec_from_file_location("variables", root / "docs/variables.py")
    variables = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(variables)
    groups = dict(re.findall(r"(?ms)^## &?(\w+)\n(.*?)(?=^## |\Z)", variables.page()))
    assert list(groups) == ["Columns" if group == "row" else group for group in variables.TITLES]
    for group in variables.TITLES:
        rows = re.findall(r"(?m)^\| `(\w+)` \| ([^|]*) \|", groups["Columns" if group == "row" else group])
        assert rows == [(row.name, row.unit) for row in properties(group)]


_PLATE = {"height": 3.0, "thickness": 0.25, "tie_height": 2.6, "tie_bar": 0.012, "tie_spacing": 3.0, "tie_length": 4.0}
_PLATE |= {"tie_plate_width": 0.3, "tie_plate_height": 0.3, "tie_plate_thickness": 0.01}
BASES = {
    "section": {"section_height": [1.5, 1.5], "section_thickness": [0.3, 0.25]},
    "tie": {"height": 3.0, "thickness": 0.25, "tie_height": 2.8, "tie_area": 2e-5, "tie_length": 4.0},
    "interlock": {"height": 3.0, "thickness": 0.25, "interlock_overlap": 0.1, "interlock_course": 0.1}
    | {"interlock_thickness": 0.25, "interlock_spacing": 5.0},
    "restitution": {"height": 3.0, "thickness": 0.25, "restitution_sd": 0.02},
    "stress": {"height": 3.0, "thickness": 0.25, "compressive_strength": 1e6},
    # Strong masonry that is sheared, and weak masonry that is crushed
    "masonry": _PLATE | {"masonry_compression": 2e6, "masonry_shear": 4e3, "masonry_tension": 1e5},
    "bearing": _PLATE
    | {
        "tie_plate_width": 0.1,
        "tie_plate_height": 0.1,
        "masonry_compression": 2e5,
        "masonry_shear": 1e5,
        "masonry_tension": 1e5,
    },
}


def test_what_is_not_given(records):
    """What meanings say of a number that is left out is what is computed with."""
    shown = {row.name: re.search(r" (\d[\d.e]*) if not given", row.meaning) for row in WALL}
    # Those of strips have tests of their own, in test_strips.py and test_elastic.py
    of_strips = {"hinge_range", "elastic_damping"}
    numbers = {name: float(found[1]) for name, found in shown.items() if found and name not in of_strips}
    assert {name.split("_")[0] for name in numbers} == set(BASES)
    others = {"section_offset": 0.05, "tie_depth": 0.1, "tie_preload": 5e7, "masonry_knowledge_factor": 1.0}
    others["restitution_seed"] = 2.0
    for name, number in numbers.items():
        stem, other = name.split("_")[0], others.get(name, 0.7 * number)
        values = (number, [number, other] if stem == "section" else other)
        walls = [
            dd.OneSidedWall(**with_parts(**BASES[stem] | more)) for more in ({}, *({name: value} for value in values))
        ]
        scale = 2.4 if stem == "tie" else 1.0
        said, given, changed = (dd.simulate(wall, records[6], scale, history=False).edp for wall in walls)
        assert said == given != changed, (name, said, given, changed)


# What a template's variable says where another one is missing, or takes its place
TOGETHER = re.compile(
    r"only with|only for|must be given|give either|belong together|must be above|instead of"
    r"|not with latitude and longitude|must be less than the height of the wall"
    r"|the sum of section_height|that of the lowest section|that of the highest corner"
    r"|a property must have a distribution"
)


@pytest.mark.slow
@pytest.mark.parametrize("task", ["stripes", "history", "typology"])
def test_template_uncommented(run, root, tmp_path, task):
    """Every variable of a template is read as it is shown, once its exclamation mark is taken away."""
    text = run("--template", task).stdout.replace("'data/", f"'{root}/data/")
    if task == "typology":
        # The wall of one case alone can be uncertain
        wall = "&wall mechanism = 'two_block', height = 3.0, thickness = 0.25\n"
        wall += "overburden = 5.0e3, overburden_inertia = 0.0 /"
        text = re.sub(r"(?s)&population\n.*?\n/", wall, text)
    elif task == "history":
        text = text.replace("\n   scale = ", "\n   ! scale = ")
    lines, number = text.splitlines(), 0
    group = ""
    for i, line in enumerate(lines):
        group = match[1] if (match := re.match(r"(?:! )?&(\w+)$", line)) else group
        variable = re.match(r" *! +(\w+ = .*)", line)
        if variable is None or (task == "history" and group not in ("history", "building")):
            continue
        number += 1
        case = [*lines[:i], variable[1], *lines[i + 1 :]]
        if f"! &{group}" in lines:
            case = [one[2:] if one in (f"! &{group}", "! /") else one for one in case]
        (tmp_path / "case.nml").write_text("\n".join(case) + "\n")
        done = run("--check", "case.nml")
        said = [one for one in done.stderr.splitlines() if "warning" not in one and "note" not in one]
        assert done.returncode in (0, 2), done.stderr
        assert all(TOGETHER.search(one) for one in said), said
    assert number >= {"stripes": 70, "history": 7, "typology": 9}[task]


def test_template_has_every_property(run, tmp_path):
    for task, groups in {
        "stripes": ("job", "wall", "building", "records", "stripes", "solver"),
        "history": ("job", "wall", "building", "records", "stripes", "solver", "history"),
        "typology": ("job", "population", "wall", "building", "row", "records", "stripes", "solver"),
    }.items():
        text = run("--template", task).stdout
        for group in groups:
            for row in properties(group):
                if {"history", "stripes", "typology"} & set(row.owners) and task not in row.owners:
                    continue
                # In a table of walls a list has a column for each of its values.
                is_list = task == "typology" and row.name in WALL_LISTS
                name = numbered(row.name, 1) if is_list else row.name
                # The comment of a long path stands below it.
                assert re.search(rf"^[ !]*{name}\b.*\s+! ", text, re.M), (task, name)


def test_columns_of_the_template_are_read(run, tmp_path):
    text = run("--template", "typology").stdout
    start, end = (re.search(words, text).start() for words in ("! Columns of the table", "! Rows with one name"))
    names = re.findall(r"^! (\w+) +! ", text[start:end], re.M)
    assert len(names) > 60
    given = {"name": "a", "mechanism": "one_sided", "height": "1.5", "thickness": "0.25"}
    row = ",".join(given.get(name, "") for name in names)
    (tmp_path / "walls.csv").write_text(f"{','.join(names)}\n{row}\n")
    assert dd.Population.from_csv(tmp_path / "walls.csv")[0] == dd.OneSidedWall(1.5, 0.25, name="a")


def test_parts_by_every_route(few, tmp_path):
    """The same parts in memory, in a table, in an archive and in the files of results; bits of properties too."""
    wall = dd.OneSidedWall(
        sections=[dd.Section(3.1, 0.52, fill=0.8), dd.Section(2.7, 0.41, fill=1.0)],
        loads=[dd.Load(7e3, depth=0.3, height=z, lifted=1.0, pushed=part) for z, part in ((3.1, 0.25), (5.8, 0.0))],
        inertial_masses=[dd.InertialMass(130.0, depth=0.2, height=3.0)],
        thrusts=[dd.Thrust(150.0, height=5.7, decay=0.3)],
        springs=[dd.Spring(900.0, depth=0.4, height=2.0)],
        distributed_springs=[dd.DistributedSpring(70.0, depth=0.4, bottom=0.5, top=2.5)],
        ties=[dd.Tie(5.5, area=3e-5, length=6.0), dd.Tie(3.0, area=2e-5, length=7.0, strain=0.05)],
        interlock=dd.Interlock(overlap=0.1, course=0.2, thickness=0.4, spacing=6.0),
        name="all",
    )
    wedges = [dd.Wedge(thickness=0.4, angle=a, bottom=b, top=5.8, length=2.0) for a, b in ((18.0, 0.0), (25.0, 2.7))]
    wedged = dataclasses.replace(wall, interlock=None, facade_length=5.0, wedges=wedges, name="wedged")
    # What one tie gives and the other leaves out is the usual number
    assert [tie.strain for tie in wall.ties] == [0.02, 0.05]
    population = dd.Population([wall, wedged, dd.OneSidedWall(3.0, 0.25, name="bare")])
    population.to_csv(tmp_path / "walls.csv")
    curves = dd.typology(population, few, [0.2, 0.4], progress=False)
    curves.save(tmp_path / "walls.npz")
    curves.write_results(tmp_path / "set")
    for place, given in enumerate((wall, wedged)):
        others = [
            dd.Population.from_csv(tmp_path / "walls.csv")[place],
            dd.load(tmp_path / "walls.npz").population[place],
            dd.read_results(tmp_path / "set").population[place],
            dataclasses.replace(given),
        ]
        for other in others:
            assert other == given
            assert {of: getattr(other, of) for of in KINDS} == {of: getattr(given, of) for of in KINDS}
            assert other._properties() == given._properties()
    assert not any(getattr(dd.Population.from_csv(tmp_path / "walls.csv")[2], of) for of in KINDS)
