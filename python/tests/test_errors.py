"""Errors for programs: what is wrong, of which variable, and where."""

import ast
import math
import pickle
import re
import typing

import numpy as np
import pytest

import dondolo as dd

CODES = typing.get_args(dd.errors.Code)
CASE = """&job task = 'stripes', output = 'out' /
&wall mechanism = 'one_sided', height = 1.5, thickness = 0.25 /
&records catalogue = 'records.csv' /
&stripes im = 'pga', levels = 0.5, 0.9 /
"""


def raised(call):
    """What is wrong, and the message, after a way through a pickle."""
    with pytest.raises(dd.errors.InputError) as caught:
        call()
    error = pickle.loads(pickle.dumps(caught.value))
    assert type(error) is type(caught.value)
    assert str(error) == str(caught.value)
    assert error.errors == caught.value.errors
    return error


def wall(**properties):
    return dd.OneSidedWall(**{"height": 1.5, "thickness": 0.25} | properties)


OF_WALLS = [
    (lambda: wall(height=-1.0), "out_of_range", "height"),
    (lambda: wall(height=None), "not_given", "height"),
    (lambda: wall(restitution="bouncy"), "not_a_word", "restitution"),
    (lambda: wall(name="a\nb"), "not_a_string", "name"),
    (lambda: wall(mass=100.0, centroid_height=None), "not_given", "centroid_depth"),
    (lambda: wall(hinge_depth=0.01, compressive_strength=1e6), "not_together", "hinge_depth"),
    (lambda: wall(thrusts=[dd.Thrust(1e6, height=1.0)]), "not_at_rest", "thrusts"),
    (lambda: wall(loads=[dd.Load(-5.0, depth=0.1, height=1.0, inertia="both")]), "out_of_range", "loads[0].force"),
    (lambda: wall(gravity=-1.0), "out_of_range", "gravity"),
]

# Changes of the case: what takes the place of what, code, variable and line
OF_CASES = [
    ("height", "hight", "unknown_name", "hight", 2),
    ("thickness = 0.25", "thickness = 'thin'", "not_a_number", "thickness", 2),
    ("height = 1.5", "height = 1.5, 2.0", "wrong_length", "height", 2),
    (", thickness = 0.25", "", "not_given", "thickness", 2),
    ("'pga'", "pga", "not_a_string", "im", 4),
    ("0.5, 0.9", "0.9, 0.5", "not_increasing", "levels", 4),
    ("'out' ", "'out', histories = maybe ", "not_a_flag", "histories", 1),
    ("'out' ", "'out', threads = 1.5 ", "not_an_integer", "threads", 1),
    ("'out' ", "'out', histories = .true. ", "not_together", "histories", 1),
    ("'records.csv'", "'nowhere.csv'", "no_such_file", "catalogue", 3),
    ("levels = 0.5, 0.9", "", "not_given", "levels", 4),
    ("0.9", "0.9, first = 0.1, last = 0.05, count = 3", "out_of_range", "last", 4),
]


@pytest.mark.parametrize(("call", "code", "variable"), OF_WALLS)
def test_walls(call, code, variable):
    error = raised(call)
    assert (error.errors[0].code, error.errors[0].variable, error.errors[0].place) == (code, variable, "")
    assert [one.message for one in error.errors] == str(error).split("\n")


@pytest.mark.parametrize(("old", "new", "code", "variable", "line"), OF_CASES)
def test_cases(tmp_path, catalogue, old, new, code, variable, line):
    text = CASE.replace("records.csv", str(catalogue))
    assert old in CASE
    old = old.replace("records.csv", str(catalogue))
    path = tmp_path / "case.nml"
    path.write_text(text.replace(old, new))
    (one,) = raised(lambda: dd.read_case(path)).errors
    group = ("job", "wall", "records", "stripes")[line - 1]
    assert (one.code, one.variable, one.place) == (code, variable, f"{path}: &{group} (line {line})")
    assert one.message.startswith(f"{path}: &{group}: {variable}")


@pytest.fixture
def catalogue(few, tmp_path):
    path = tmp_path / "records.csv"
    dd.RecordSet(few).to_catalogue(path)
    return path


def test_tables(tmp_path):
    """Each wrong cell with its row and column."""
    path = tmp_path / "walls.csv"
    path.write_text("mechanism,height,thickness\none_sided,1.5,0.25\none_sided,tall,0.25\n")
    (one,) = raised(lambda: dd.Population.from_csv(path)).errors
    assert one[1:] == ("not_a_number", "height", f"{path}: line 3")
    path.write_text("mechanism,height,thickness\none_sided,-1,0\n")
    error = raised(lambda: dd.Population.from_csv(path))
    assert [one[1:] for one in error.errors] == [
        ("out_of_range", "height", f"{path}: line 2"),
        ("out_of_range", "thickness", f"{path}: line 2"),
    ]
    path.write_text("mechanism,height,width\none_sided,1.5,0.25\n")
    (one,) = raised(lambda: dd.Population.from_csv(path)).errors
    assert one[1:] == ("unknown_name", "width", str(path))
    (one,) = raised(lambda: dd.Population.from_csv(tmp_path / "none.csv")).errors
    assert one.code == "no_such_file"


def test_what_has_no_room():
    """A message ends by how many more there are; what is counted is not listed."""
    levels = [float(i % 7) for i in range(2000)]
    error = raised(lambda: wall(hinge_level=levels, height=10.0))
    assert str(error).endswith("more")
    assert len(error.errors) == len(str(error).split("\n")) - 1
    assert {(one.code, one.variable) for one in error.errors} == {("out_of_range", "hinge_level")}


def test_places_are_added(tmp_path):
    """By Python too, to the sentence and to its place."""
    error = dd.errors.InputError(
        "x = 1: must be 2", errors=[dd.errors.Problem("x = 1: must be 2", "out_of_range", "x")]
    )
    again = error.placed("row 2").placed("a.csv")
    assert str(again) == "a.csv: row 2: x = 1: must be 2"
    assert again.errors == (dd.errors.Problem(str(again), "out_of_range", "x", "a.csv: row 2"),)
    assert dd.errors.InputError("no").errors == (dd.errors.Problem("no"),)
    assert dd.errors.MissingFileError("x: none").errors == (dd.errors.Problem("x: none", "no_such_file"),)


def test_list_of_codes(root):
    """The library's, Python's and those of the documentation are the same; each is raised by a test."""
    source = (root / "src/core/base/text/error.f90").read_text()
    library = re.findall(r"(\w+) = '\1'", source)
    (listed,) = re.findall(r"error_codes\(\*\) = \[character\(len=\d+\) :: ([^]]*)\]", source)
    assert re.findall(r"\w+", listed) == library
    of_python = {"wrong_type", "not_numbers", "not_a_probability"}
    assert set(library) == set(CODES) - of_python
    page = (root / "docs/files.md").read_text().partition("### Errors")[2].partition("### Warnings")[0]
    rows = [line.split("|")[1] for line in page.split("\n") if line.startswith("| `")]
    assert sorted(re.findall(r"`(\w+)`", " ".join(rows))) == sorted(CODES)
    tested = {row[1] for row in OF_WALLS} | {row[2] for row in OF_CASES}
    assert set(library) == tested


# Errors of Python that are raised without a code: it may only fall
WITHOUT_CODE = 171


def test_errors_without_a_code_become_fewer(root):
    """Errors of arguments come from helpers that take a code."""
    calls = [
        call
        for path in (root / "python/dondolo").rglob("*.py")
        for call in ast.walk(ast.parse(path.read_text(encoding="utf-8")))
        if isinstance(call, ast.Call) and getattr(call.func, "id", "") == "InputError"
    ]
    bare = [call for call in calls if all(given.arg != "errors" for given in call.keywords)]
    assert len(bare) == WITHOUT_CODE


@pytest.mark.parametrize(
    ("call", "code", "variable"),
    [
        (lambda: dd.HazardCurve([0.1, 0.2], [-1.0, 0.1]), "out_of_range", "annual_frequency"),
        (lambda: dd.fit_fragility([0.2, 0.4], [1, 2]), "not_given", "histories"),
        (lambda: dd.fit_fragility([0.2, 0.4], [1, 2], 4, records=["a"]), "not_together", "records"),
        (lambda: dd.fit_fragility([0.2, 0.4], [[1, 2, 3]]), "wrong_length", "collapses"),
        (lambda: dd.DiscreteFragility([0.1, 0.2], [0.5, 1.5]), "not_a_probability", "probability"),
        (lambda: dd.DiscreteFragility([0.1, 0.2], [0.5, 0.4]), "not_increasing", "probability"),
        (lambda: dd.compare_designs([], dd.example_records(), [0.5, 0.9]), "wrong_type", "designs"),
        (lambda: dd.multiple_stripe(wall(), [], [0.5]), "not_given", "records"),
        (lambda: dd.pulses.ricker("1", 1.0), "not_a_number", "amplitude"),
        (lambda: dd.write_nrml("x.xml", {}), "wrong_type", "functions"),
        (lambda: dd.HazardCurve([0.1, 0.2], [0.1, 0.01]).to_csv(3), "wrong_type", "path"),
    ],
)
def test_arguments_of_python(call, code, variable):
    error = raised(call)
    assert [(one.code, one.variable, one.message) for one in error.errors] == [(code, variable, str(error))]
    assert str(error).startswith(variable)


def test_what_is_no_number_is_refused_alike():
    curve = dd.DiscreteFragility([0.2, 0.4, 0.6], [0.1, 0.6, 0.9])
    for wrong in ("0.5", True, ["0.5"], [True], np.array([0.5, "x"], dtype=object)):
        with pytest.raises(dd.errors.InputError, match="x: must be numbers"):
            curve(wrong)
    with pytest.raises(dd.errors.InputError, match="x = nan: must be a number"):
        curve([0.5, math.nan])
    for wrong in ("6", True, np.True_):
        with pytest.raises(dd.errors.InputError, match=r"height = .*: must be a number"):
            dd.OneSidedWall(wrong, 0.3)
    with pytest.raises(dd.errors.InputError, match="prefix = a list: must be the path of a file"):
        dd.read_results([curve] * 50)


def test_a_record_is_found_by_its_number(few):
    with pytest.raises(dd.errors.InputError, match=r"is the name of a record, not of a column: records\[1\]"):
        dd.RecordSet(few)[few[1].name]
