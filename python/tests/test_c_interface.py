"""The interface for C: a program that is compiled against the header, and every function by ctypes."""

import ctypes
import math
import os
import re
import shutil
import subprocess
import sys
import threading

import numpy as np
import pytest

import dondolo as dd

PLACES = {
    "facade": (dd.OneSidedWall(6.0, 0.5), {"mechanism": "one_sided", "height": 6.0, "thickness": 0.5}),
    "block": (
        dd.FreeStandingWall(2.0, 0.3, restitution_value=0.9, gravity=9.8),
        {
            "mechanism": "free_standing",
            "height": 2.0,
            "thickness": 0.3,
            "restitution_value": 0.9,
            "gravity": 9.8,
        },
    ),
    "strip": (
        dd.TwoBlockWall(3.0, 0.25, overburden=5000.0, overburden_inertia=1.0, eccentricity=0.05),
        {
            "mechanism": "two_block",
            "height": 3.0,
            "thickness": 0.25,
            "overburden": 5000.0,
            "overburden_inertia": 1.0,
            "eccentricity": 0.05,
        },
    ),
    "tied": (
        dd.OneSidedWall(
            6.0,
            0.5,
            ties=[dd.Tie(3.0, area=5e-5, length=8.0), dd.Tie(5.5, area=4e-5, length=6.0)],
            loads=[
                dd.Load(10e3, depth=0.2, height=3.0, inertia="vertical"),
                dd.Load(5e3, depth=0.3, height=5.0, inertia="both"),
            ],
        ),
        {
            "mechanism": "one_sided",
            "height": 6.0,
            "thickness": 0.5,
            "tie_height": [3.0, 5.5],
            "tie_area": [5e-5, 4e-5],
            "tie_length": [8.0, 6.0],
            "load": [10e3, 5e3],
            "load_depth": [0.2, 0.3],
            "load_height": [3.0, 5.0],
            "load_inertia": "vertical, both",
        },
    ),
    "on a floor": (
        dd.OneSidedWall(3.0, 0.3, building=dd.Building(period=[0.3, 0.1], participation=[1.3, -0.4], damping=0.04)),
        {
            "mechanism": "one_sided",
            "height": 3.0,
            "thickness": 0.3,
            "period": [0.3, 0.1],
            "participation": [1.3, -0.4],
            "damping": 0.04,
        },
    ),
}
LEVELS = [0.3, 0.6, 0.9]

# Where each of these walls has a curve
WHERE = {"facade": LEVELS, "block": LEVELS, "strip": [0.6, 1.0, 1.6], "tied": [0.8, 1.2, 2.0]}
WHERE |= {"on a floor": [0.1, 0.2, 0.4]}


@pytest.fixture(scope="session")
def built(root):
    """The library that the build made."""
    found = sorted(root.glob("build-python/libdondolo.so")) + sorted(root.glob("build-python/libdondolo.dylib"))
    if not found:
        pytest.skip("needs the build of ./run setup")
    return found[0]


class Library:
    """The library as a program of another language calls it, with the types of the header."""

    def __init__(self, path, header):
        self.library = ctypes.CDLL(str(path))
        types = {"int": ctypes.c_int, "double": ctypes.c_double, "void": None, "const char *": ctypes.c_char_p}
        text = re.sub(r"/\*.*?\*/", "", header, flags=re.S)
        self.names = []
        for result, name, arguments in re.findall(r"^([\w ]+[ *])(dondolo_\w+)\(([^)]*)\);", text, re.M):
            function = getattr(self.library, name)
            function.restype = types.get(result.strip(), ctypes.c_void_p)
            given = [one.rsplit(" ", 1)[0].strip() for one in arguments.split(",") if one != "void"]
            pointers = ["*" in one for one in arguments.split(",") if one != "void"]
            function.argtypes = [
                ctypes.c_char_p if one == "const char" and pointer else ctypes.c_void_p if pointer else types[one]
                for one, pointer in zip(given, pointers, strict=True)
            ]
            self.names.append(name)

    def __getattr__(self, name):
        return getattr(self.library, f"dondolo_{name}")


@pytest.fixture(scope="session")
def c(built, root):
    return Library(built, (root / "include/dondolo.h").read_text())


@pytest.fixture
def error(c):
    handle = c.new_error()
    yield handle
    c.free(handle)


@pytest.fixture(scope="session")
def catalogue(root):
    return str(root / "data/records/synthetic44.csv").encode()


def settings(c, error, group, values):
    made = c.new_settings(error, group.encode())
    for name, value in values.items():
        if isinstance(value, str):
            c.set_text(error, made, name.encode(), value.encode())
        elif isinstance(value, (list, tuple)):
            c.set_list(error, made, name.encode(), (ctypes.c_double * len(value))(*value), len(value))
        else:
            c.set_number(error, made, name.encode(), float(value))
    return made


def numbers(c, error, handle, name):
    count = c.count(error, handle, name.encode())
    assert count >= 0, c.message(error)
    values = np.empty(count)
    assert c.get_numbers(error, handle, name.encode(), values.ctypes.data, count) == 0, c.message(error)
    return values


def text(c, error, handle, name):
    room = ctypes.create_string_buffer(5000)
    length = c.get_text(error, handle, name.encode(), room, len(room))
    assert length == len(room.value), c.message(error)
    return room.value.decode()


def run(c, error, values, catalogue, *, threads=0, solver=None, vertical=0.0, **how):
    """Stripes of a wall, its handle and that of the records."""
    wall = c.new_wall(error, settings(c, error, "wall", values))
    records = c.read_records(error, catalogue, vertical)
    study = settings(c, error, "stripes", {"levels": LEVELS} | how)
    return c.run_stripes(error, wall, records, study, solver, threads), wall, records


def test_the_header_names_what_the_library_exports(c, built, root):
    """And the map that hides all else."""
    assert len(c.names) > 20
    listed = re.findall(r"^ +(dondolo_\w+);", (root / "src/dondolo.map").read_text(), re.M)
    assert sorted(c.names) == sorted(listed)
    done = subprocess.run(["nm", "-D", "--defined-only", built], capture_output=True, text=True, check=False)
    if done.returncode == 0 and sys.platform == "linux":
        assert sorted(line.split()[-1] for line in done.stdout.splitlines()) == sorted(c.names)


def test_no_function_has_the_name_of_a_module(c, root):
    """Both are global names of a Fortran program, and gfortran takes one for the other without a word."""
    modules = {
        name.lower()
        for path in root.glob("src/**/*.[fF]90")
        for name in re.findall(r"(?m)^module (\w+)", path.read_text())
    }
    assert len(modules) > 100
    assert modules & set(c.names) == set()


def test_version(c):
    assert c.get_version().decode() == dd.__version__


@pytest.mark.parametrize("place", PLACES)
def test_stripes_are_those_of_python(c, error, records, catalogue, place):
    wall, values = PLACES[place]
    levels = WHERE[place]
    stripes, handle, _ = run(c, error, values, catalogue, im="pga", polarity="both", levels=levels)
    assert c.status(error) == 0, c.message(error)
    expected = dd.multiple_stripe(wall, records, levels, polarity="both", progress=False)
    for name in ("edp", "collapsed", "impacts", "time_of_peak", "scale"):
        found = numbers(c, error, stripes, name).reshape(len(levels), -1)
        assert np.array_equal(found, getattr(expected, name)), name
    assert np.array_equal(numbers(c, error, stripes, "collapses"), expected.collapses)
    assert np.array_equal(numbers(c, error, stripes, "histories"), np.broadcast_to(expected.histories, len(LEVELS)))
    assert 0 < expected.collapses.sum() < expected.edp.size
    curve = c.fit_stripes(error, stripes, 0.0)
    fitted = expected.fit()
    for name in ("theta", "beta", "se_ln_theta", "se_beta"):
        assert c.get_number(error, curve, name.encode()) == getattr(fitted, name), name
    assert text(c, error, curve, "status") == fitted.status
    assert text(c, error, curve, "errors") == fitted.errors == "clustered"
    for name in ("radius", "slenderness_angle", "trigger_acceleration", "capacity_angle", "restitution_coefficient"):
        assert c.get_number(error, handle, name.encode()) == getattr(wall, name), name
    assert c.get_number(error, handle, b"two_sided") == wall.two_sided


@pytest.mark.parametrize("threads", [1, 2, 5])
def test_any_number_of_threads_gives_the_same_bits(c, error, records, catalogue, threads):
    stripes, _, _ = run(c, error, PLACES["facade"][1], catalogue, im="sa(0.5)", threads=threads)
    expected = dd.multiple_stripe(PLACES["facade"][0], records, LEVELS, im="sa(0.5)", threads=3, progress=False)
    assert np.array_equal(numbers(c, error, stripes, "edp").reshape(len(LEVELS), -1), expected.edp)


def test_threads_of_the_program_share_what_was_made(c, records, catalogue):
    """Each with its own errors; walls and records are those of all."""
    error = c.new_error()
    wall = c.new_wall(error, settings(c, error, "wall", PLACES["strip"][1]))
    handle = c.read_records(error, catalogue, 0.0)
    expected = dd.multiple_stripe(PLACES["strip"][0], records, LEVELS, im="pgv", progress=False)
    wrong = []

    def work():
        own = c.new_error()
        for _ in range(5):
            how = settings(c, own, "stripes", {"im": "pgv", "levels": LEVELS})
            stripes = c.run_stripes(own, wall, handle, how, None, 1)
            if not np.array_equal(numbers(c, own, stripes, "edp").reshape(len(LEVELS), -1), expected.edp):
                wrong.append(c.message(own))
            for one in (stripes, how):
                c.free(one)
        c.free(own)

    team = [threading.Thread(target=work) for _ in range(4)]
    for member in team:
        member.start()
    for member in team:
        member.join()
    assert wrong == []


def test_solver(c, error, records, catalogue):
    solver = settings(
        c, error, "solver", {"engine": "rk45", "rtol": 1e-9, "atol": 1e-11, "edp_limit": 0.8, "estimate_error": 1}
    )
    stripes, _, _ = run(c, error, PLACES["facade"][1], catalogue, solver=solver)
    how = dd.Solver(engine="rk45", rtol=1e-9, atol=1e-11, edp_limit=0.8)
    expected = dd.multiple_stripe(PLACES["facade"][0], records, LEVELS, solver=how, estimate_error=True, progress=False)
    for name in ("edp", "edp_error"):
        assert np.array_equal(numbers(c, error, stripes, name).reshape(len(LEVELS), -1), getattr(expected, name))
    assert c.get_number(error, stripes, b"edp_limit") == 0.8
    curve = c.fit_stripes(error, stripes, 0.2)
    assert c.get_number(error, curve, b"theta") == expected.fit(0.2).theta
    assert c.fit_stripes(error, stripes, 0.9) is None
    assert b"edp_thresholds = 0.9: must be positive and at most edp_limit = 0.8" in c.message(error)


@pytest.mark.parametrize("place", ["facade", "tied", "on a floor"])
def test_simulate(c, error, records, catalogue, place):
    wall, values = PLACES[place]
    handle = c.new_wall(error, settings(c, error, "wall", values))
    record = c.read_records(error, catalogue, 0.0)
    history = c.run_history(error, handle, record, 6, -1.5, 0.0, 0.0, None)
    expected = dd.simulate(wall, records[6], -1.5)
    assert c.get_number(error, history, b"edp") == expected.edp > 0.0
    assert c.get_number(error, history, b"collapsed") == expected.collapsed
    assert c.get_number(error, history, b"impacts") == expected.impacts
    assert c.get_number(error, history, b"time_of_peak") == expected.time_of_peak
    columns = {
        "time": expected.time,
        "acceleration": expected.ground_acceleration,
        "rotation": expected.rotation,
        "velocity": expected.velocity,
        "side": expected.side,
        "after_impact": expected.after_impact,
    }
    for name, column in columns.items():
        assert np.array_equal(numbers(c, error, history, name), column), name
    # The trace of a handle is a list
    assert math.isnan(c.get_number(error, history, b"time"))
    assert b"time: has" in c.message(error)


@pytest.mark.parametrize("start", [(0.4, 0.0), (0.0, 0.3), (-0.2, 0.5)])
def test_simulate_from_an_initial_state(c, error, records, catalogue, start):
    """As Python does it, to the bit, with the ground at rest and moving."""
    wall, values = PLACES["block"]
    handle = c.new_wall(error, settings(c, error, "wall", values))
    record = c.read_records(error, catalogue, 0.0)
    rotation, velocity = np.array(start) * wall.capacity_angle * np.array([1.0, wall.frequency_parameter])
    for scale in (0.0, 1.0):
        history = c.run_history(error, handle, record, 6, scale, rotation, velocity, None)
        expected = dd.simulate(wall, records[6], scale, initial_rotation=rotation, initial_velocity=velocity)
        assert c.get_number(error, history, b"edp") == expected.edp > 0.0
        assert np.array_equal(numbers(c, error, history, "rotation"), expected.rotation)
        assert np.array_equal(numbers(c, error, history, "velocity"), expected.velocity)
    assert c.run_history(error, handle, record, 6, 1.0, 1.5 * wall.capacity_angle, 0.0, None) is None
    assert b"initial_rotation" in c.message(error)
    assert c.status(error) == 2


def test_records_of_arrays(c, error, few):
    samples = np.concatenate([record.acceleration for record in few])
    lengths = (ctypes.c_int * len(few))(*(len(record.acceleration) for record in few))
    dt = (ctypes.c_double * len(few))(*(record.dt for record in few))
    names = (ctypes.c_char_p * len(few))(*(record.name.encode() for record in few))
    handle = c.new_records(error, len(few), lengths, dt, samples.ctypes.data, names)
    assert text(c, error, handle, "names").split("\n") == [record.name for record in few]
    assert np.array_equal(numbers(c, error, handle, "pga"), [record.peak_acceleration for record in few])
    unnamed = c.new_records(error, len(few), lengths, dt, samples.ctypes.data, None)
    assert text(c, error, unnamed, "names").split("\n") == [str(i + 1) for i in range(len(few))]
    wall = c.new_wall(error, settings(c, error, "wall", PLACES["facade"][1]))
    how = settings(c, error, "stripes", {"im": "pga", "levels": LEVELS})
    plain = [dd.Record(record.acceleration, record.dt, record.name) for record in few]
    expected = dd.multiple_stripe(PLACES["facade"][0], plain, LEVELS, progress=False)
    stripes = c.run_stripes(error, wall, handle, how, None, 0)
    assert np.array_equal(numbers(c, error, stripes, "edp").reshape(len(LEVELS), -1), expected.edp)


def test_records_of_files(c, error, root, tmp_path):
    path = tmp_path / "column.txt"
    np.savetxt(path, 100.0 * np.sin(np.arange(500.0)))
    handle = c.read_record(error, str(path).encode(), 0.02, b"cm/s2")
    expected = dd.read_record(path, dt=0.02, units="cm/s2")
    assert c.get_number(error, handle, b"samples") == 500
    assert c.get_number(error, handle, b"pga") == expected.peak_acceleration
    assert c.read_record(error, str(path).encode(), 0.0, None) is None
    assert c.status(error) == 2
    assert b"column.txt" in c.message(error)


def test_levels_of_a_catalogue(c, error, root, tmp_path):
    """A record that its catalogue has at some levels runs at these alone."""
    folder = root / "data/records"
    head, *rows = (folder / "synthetic44.csv").read_text().splitlines()[1:11]
    rows = [f"{folder}/{row},{LEVELS[i % 3]}" for i, row in enumerate(rows)]
    path = tmp_path / "levels.csv"
    path.write_text("\n".join([f"{head},level", *rows]) + "\n")
    stripes, _, _ = run(c, error, PLACES["facade"][1], str(path).encode())
    assert c.status(error) == 0, c.message(error)
    ran = numbers(c, error, stripes, "ran").reshape(len(LEVELS), -1)
    assert ran.sum() == 9
    assert np.array_equal(numbers(c, error, stripes, "histories"), [3, 3, 3])
    assert [LEVELS[k] for k in np.argmax(ran, axis=0)] == [LEVELS[i % 3] for i in range(9)]


def test_fit_of_counts(c, error):
    levels, collapses, histories = ((ctypes.c_double * 3)(*row) for row in ([0.2, 0.4, 0.6], [1, 5, 9], [10, 10, 10]))
    curve = c.fit_counts(error, 3, levels, collapses, histories)
    expected = dd.fit_fragility([0.2, 0.4, 0.6], [1, 5, 9], [10, 10, 10])
    for name in ("theta", "beta", "se_ln_theta", "se_beta", "log_likelihood"):
        assert c.get_number(error, curve, name.encode()) == getattr(expected, name), name
    none = c.fit_counts(error, 3, levels, (ctypes.c_double * 3)(), histories)
    assert text(c, error, none, "status") == "no_collapse"
    assert c.get_number(error, none, b"has_curve") == 0.0
    assert math.isnan(c.get_number(error, none, b"theta"))
    assert c.status(error) == 0
    assert c.fit_counts(error, 3, levels, histories, collapses) is None
    assert c.status(error) == 2
    c.clear_error(error)
    assert c.fit_counts(error, 3, levels, (ctypes.c_double * 3)(0.1, 0.5, 0.9), histories) is None
    assert b"look like fractions of the histories" in c.message(error)


def test_warnings(c, error, catalogue, records):
    stripes, _, _ = run(c, error, PLACES["facade"][1] | {"height": 0.4}, catalogue, levels=[0.3, 6.0])
    with pytest.warns(dd.errors.DondoloWarning) as caught:
        expected = dd.multiple_stripe(dd.OneSidedWall(0.4, 0.5), records, [0.3, 6.0], progress=False)
    assert sorted(text(c, error, stripes, "warnings").split("\n")) == sorted(str(one.message) for one in caught)
    assert "are they swapped" in text(c, error, stripes, "warnings")
    curve = c.fit_stripes(error, stripes, 0.0)
    with pytest.warns(dd.errors.DondoloWarning) as caught:
        expected.fit()
    assert text(c, error, curve, "warnings") == str(caught[0].message)


@pytest.mark.parametrize(
    ("group", "values", "sentence"),
    [
        ("walls", {}, "group = 'walls': must be one of 'wall', 'stripes', 'solver'"),
        ("wall", {"thicknes": 1.0}, "wall: thicknes: no such variable; did you mean 'thickness'?"),
        ("wall", {"": 1.0}, "no such variable"),
        ("wall", {100_000 * "height": 1.0}, "heightheight"),
        (
            "stripes",
            {"edp_thresholds": [0.1]},
            "stripes: edp_thresholds: no such variable; there are 'im', 'levels', 'polarity'",
        ),
        (
            "solver",
            {"certify": 1},
            "there are 'engine', 'rtol', 'atol', 'edp_limit', 'estimate_error'",
        ),
        ("wall", {"height": math.nan}, "height = NaN: must be a number"),
        ("wall", {"load": [1.0, math.inf]}, "load = Infinity: must be a number"),
        ("wall", {"height": "6"}, "height = '6': must be a number"),
        ("wall", {"mechanism": 1.0}, "mechanism = 1: must be a string"),
        ("wall", {"height": [1.0, 2.0]}, "height: has 2 values, must have 1"),
        ("wall", {"storeys": 1.5}, "storeys = 1.5: must be an integer"),
        ("solver", {"estimate_error": 2}, "estimate_error = 2: must be 0 or 1"),
    ],
)
def test_settings_that_cannot_be(c, error, group, values, sentence):
    settings(c, error, group, values)
    assert c.status(error) == 2
    assert sentence in c.message(error).decode()


@pytest.mark.parametrize(
    "values",
    [
        {"mechanism": "one_sided", "height": -6.0, "thickness": 0.5},
        {"mechanism": "one_side", "height": 6.0, "thickness": 0.5},
        {"mechanism": "one_sided", "thickness": 0.5},
        {"mechanism": "one_sided", "height": 6.0, "thickness": 0.5, "overburden": 5.0},
        {"mechanism": "two_block", "height": 6.0, "thickness": 0.5, "overburden": 5e3, "eccentricity": 3.0},
        {"mechanism": "one_sided", "height": 6.0, "thickness": 0.5, "gravity": -9.81},
    ],
)
def test_walls_that_cannot_be(c, error, values):
    """With the sentence of every other way to make them."""
    assert c.new_wall(error, settings(c, error, "wall", values)) is None
    classes = {"two_block": dd.TwoBlockWall}
    if "height" in values and values["mechanism"] != "one_side":
        own = {name: value for name, value in values.items() if name not in ("mechanism", "overburden")}
        if values["mechanism"] == "two_block":
            own["overburden"] = values["overburden"]
        if values.get("overburden") != 5.0:
            with pytest.raises(dd.errors.InputError) as refused:
                classes.get(values["mechanism"], dd.OneSidedWall)(**own)
            assert c.message(error).decode() == str(refused.value)
    assert c.status(error) == 2
    assert re.search(r"(height|mechanism|overburden|gravity)", c.message(error).decode())


@pytest.mark.parametrize(
    ("how", "solver", "threads", "sentence"),
    [
        ({"im": "pgaa"}, {}, 0, "pgaa"),
        ({"levels": [0.2, 0.1]}, {}, 0, "levels = 0.2, 0.1: must increase strictly"),
        ({"polarity": "up"}, {}, 0, "polarity = 'up': must be one of 'as_recorded', 'reversed', 'both'"),
        ({}, {"rtol": 1.0}, 0, "rtol = 1: must lie between"),
        ({}, {"engine": "euler"}, 0, "engine = 'euler': must be one of"),
        ({}, {"edp_limit": 100.0}, 0, "edp_limit = 100: must be less than"),
        ({}, {}, -1, "threads = -1: must lie between 0 (all) and 1024"),
    ],
)
def test_stripes_that_cannot_be(c, error, catalogue, how, solver, threads, sentence):
    chosen = settings(c, error, "solver", solver) if solver else None
    stripes, _, _ = run(c, error, PLACES["facade"][1], catalogue, solver=chosen, threads=threads, **how)
    assert stripes is None
    assert c.status(error) == 2
    assert sentence in c.message(error).decode()
    c.clear_error(error)
    wall = c.new_wall(error, settings(c, error, "wall", PLACES["facade"][1]))
    records, nothing = c.read_records(error, catalogue, 0.0), settings(c, error, "stripes", {})
    assert c.run_stripes(error, wall, records, nothing, None, 0) is None
    assert b"levels: must be given" in c.message(error)


def test_records_that_cannot_be(c, error):
    zeros = (ctypes.c_double * 4)()
    one, dt = (ctypes.c_int * 1)(4), (ctypes.c_double * 1)(0.01)
    for given, sentence in [
        ((0, one, dt, zeros, None), "dt: has 0 values, must have 1 at least"),
        ((1, None, dt, zeros, None), "lengths: must be numbers, not NULL"),
        ((1, one, None, zeros, None), "dt: must be numbers, not NULL"),
        ((1, one, dt, None, None), "samples: must be numbers, not NULL"),
        ((1, (ctypes.c_int * 1)(-1), dt, zeros, None), "lengths = -1: must not be negative"),
        ((1, (ctypes.c_int * 1)(1), dt, zeros, None), "record '1': number of samples = 1: must be at least 2"),
        ((1, one, (ctypes.c_double * 1)(math.nan), zeros, None), "record '1': time step dt = NaN: must lie"),
        ((1, one, dt, (ctypes.c_double * 4)(0.0, math.nan), None), "record '1': sample 2 = NaN"),
        ((2, (ctypes.c_int * 2)(2**31 - 1, 2**31 - 1), (ctypes.c_double * 2)(), zeros, None), "lengths: records of"),
        ((1, one, dt, zeros, (ctypes.c_char_p * 1)(None)), "names: must be a string, not NULL"),
    ]:
        assert c.new_records(error, *given) is None
        assert sentence in c.message(error).decode()
        c.clear_error(error)
    assert c.read_records(error, b"no_such.csv", 0.0) is None
    assert c.status(error) == 3
    c.clear_error(error)
    assert c.read_records(error, None, 0.0) is None
    assert c.message(error) == b"path: must be a string, not NULL"


def test_handles_that_cannot_be(c, error, catalogue):
    """NULL, one that was freed, one of something else, and numbers that never were handles."""
    properties = settings(c, error, "wall", PLACES["facade"][1])
    stripes, wall, records = run(c, error, PLACES["facade"][1], catalogue)
    how = settings(c, error, "stripes", {"levels": LEVELS})
    assert c.status(error) == 0
    freed = c.new_wall(error, properties)
    c.free(freed)
    c.free(freed)
    c.free(None)
    again = c.new_wall(error, properties)
    assert again != freed
    for wrong in (None, freed, records, stripes, error, 1, 2**40, 2**62):
        calls = [
            (c.run_stripes, (error, wrong, records, how, None, 0), "walls: handle is not valid"),
            (c.run_history, (error, wrong, records, 0, 1.0, 0.0, 0.0, None), "walls: handle is not valid"),
            (c.fit_stripes, (error, wrong if wrong != stripes else wall, 0.0), "stripes: handle is not valid"),
            (c.new_wall, (error, wrong), "settings: handle is not valid"),
            (c.set_number, (error, wrong, b"height", 1.0), "settings: handle is not valid"),
            (
                c.get_number,
                (error, wrong if wrong not in (records, stripes) else error, b"edp"),
                "records, wall, stripes, curve or history: handle is not valid",
            ),
            (c.run_stripes, (error, wall, wrong if wrong != records else wall, how, None, 0), "records: handle is not"),
            (c.run_stripes, (error, wall, records, wrong, None, 0), "settings: handle is not valid"),
        ]
        for function, given, sentence in calls:
            assert function(*given) != 0
            assert sentence in c.message(error).decode(), (wrong, function)
            assert c.status(error) == 2
            c.clear_error(error)
    assert c.run_stripes(error, wall, records, properties, None, 0) is None
    assert c.message(error) == b"settings: belong to the group 'wall', must belong to 'stripes'"


@pytest.mark.parametrize("wrong", [None, 12345])
def test_without_a_handle_of_errors(c, catalogue, wrong):
    """Nothing is done, and no call crashes."""
    assert c.status(wrong) == 2
    assert c.message(wrong) == b"error: handle is not valid, see dondolo_new_error"
    assert c.new_settings(wrong, b"wall") is None
    assert c.set_number(wrong, None, b"height", 1.0) == 2
    assert c.set_list(wrong, None, b"levels", None, 0) == 2
    assert c.set_text(wrong, None, b"im", b"pga") == 2
    assert c.new_wall(wrong, None) is None
    assert c.read_records(wrong, catalogue, 0.0) is None
    assert c.read_record(wrong, catalogue, 0.0, None) is None
    assert c.new_records(wrong, 0, None, None, None, None) is None
    assert c.run_stripes(wrong, None, None, None, None, 0) is None
    assert c.fit_stripes(wrong, None, 0.0) is None
    assert c.fit_counts(wrong, 0, None, None, None) is None
    assert c.run_history(wrong, None, None, 0, 1.0, 0.0, 0.0, None) is None
    assert c.count(wrong, None, b"edp") == -1
    assert math.isnan(c.get_number(wrong, None, b"edp"))
    assert c.get_numbers(wrong, None, b"edp", None, 0) == 2
    assert c.get_text(wrong, None, b"status", None, 0) == -1
    c.clear_error(wrong)


def test_the_first_error_stays(c, error):
    assert c.new_settings(error, b"none") is None
    first = c.message(error)
    assert c.new_settings(error, b"wall") is None
    assert c.new_settings(error, None) is None
    assert c.message(error) == first
    c.clear_error(error)
    assert (c.status(error), c.message(error)) == (0, b"")
    assert c.new_settings(error, b"wall") is not None


def test_names_of_results(c, error, catalogue):
    stripes, _, records = run(c, error, PLACES["facade"][1], catalogue)
    assert c.count(error, stripes, b"edps") == -1
    assert "stripes: edps: no such number; there are 'edp_limit', 'levels'" in c.message(error).decode()
    assert "did you mean 'edp'?" in c.message(error).decode()
    c.clear_error(error)
    assert c.count(error, stripes, 100_000 * b"edp") == -1
    assert len(c.message(error)) < 1000
    c.clear_error(error)
    room = ctypes.create_string_buffer(b"left", 5)
    assert c.get_text(error, records, b"title", room, 5) == -1
    assert room.value == b""
    assert "records: title: no such text; there are 'names', 'warnings'" in c.message(error).decode()
    c.clear_error(error)
    values = np.full(3, 7.0)
    assert c.get_numbers(error, stripes, b"edp", values.ctypes.data, 3) == 2
    assert b"edp: has 132 values, there is room for 3" in c.message(error)
    assert np.array_equal(values, [7.0, 7.0, 7.0])
    c.clear_error(error)
    # A text that is cut is as long as it says
    short = ctypes.create_string_buffer(4)
    assert c.get_text(error, stripes, b"im", short, 3) == 3
    assert short.value == b"pg"
    known = text(c, error, settings(c, error, "wall", {}), "variables").split("\n")
    assert {"height", "period", "gravity"} <= set(known)


INTERRUPTED = """
import ctypes, os, signal, sys, threading, time
sys.path.insert(0, {tests!r})
from test_c_interface import LEVELS, Library, settings
c = Library({built!r}, open({header!r}).read())
listens = {listens}
# A handler of C's own, in the place of Python's, which would be called by the interpreter alone
libc = ctypes.CDLL(None)
heard = []
handler = ctypes.CFUNCTYPE(None, ctypes.c_int)(lambda number: heard.append(number))
libc.signal(signal.SIGINT, handler)
error = c.new_error()
wall = c.new_wall(error, settings(c, error, "wall", dict(mechanism="free_standing", height=6.0, thickness=0.8)))
records = c.read_records(error, {catalogue!r}, 0.0)
how = settings(c, error, "stripes", dict(levels=[0.3 + 1e-4 * i for i in range(900)]))
threading.Thread(target=lambda: (time.sleep(0.1), os.kill(os.getpid(), signal.SIGINT))).start()
if listens:
    c.listen()
stripes = c.run_stripes(error, wall, records, how, None, 1)
c.end_listening()
print(len(heard), stripes is None, c.status(error), c.message(error).decode())
"""


@pytest.mark.slow
@pytest.mark.parametrize("listens", [True, False])
def test_interrupt(built, root, catalogue, listens):
    program = INTERRUPTED.format(
        tests=str(root / "python/tests"),
        built=str(built),
        header=str(root / "include/dondolo.h"),
        catalogue=catalogue,
        listens=listens,
    )
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    assert done.stdout == ("1 True 1 interrupted\n" if listens else "1 False 0 \n"), done.stderr


def compiled(root, built, folder, source, *options):
    compiler = shutil.which("cc") or shutil.which("gcc")
    if compiler is None:
        pytest.skip("needs a compiler of C")
    program = folder / source.stem
    strict = ["-std=c11", "-Wall", "-Wextra", "-Wpedantic", "-Werror"]
    place = [f"-I{root / 'include'}", f"-L{built.parent}", f"-Wl,-rpath,{built.parent}", "-lm"]
    command = [compiler, *strict, *options, source, *place, "-ldondolo", "-lm", "-o", program]
    subprocess.run(command, check=True)
    return program


def test_program(root, built, records, tmp_path, catalogue):
    """The program of docs/c.md says what the page says, and what Python computes."""
    program = compiled(root, built, tmp_path, root / "docs/examples/c_program.c")
    said = subprocess.run([program, catalogue], capture_output=True, text=True, check=True)
    assert said.stdout in (root / "docs/c.md").read_text()
    stripes = dd.multiple_stripe(dd.OneSidedWall(3.0, 0.25), records, [0.4, 0.6, 0.8, 1.0, 1.2], progress=False)
    curve = stripes.fit()
    assert f"theta = {curve.theta:.3f} g, beta = {curve.beta:.3f} ({curve.status})" in said.stdout
    assert re.findall(r"(\d+) collapses", said.stdout) == [str(one) for one in stripes.collapses]
    none = subprocess.run([program, "none.csv"], capture_output=True, text=True, check=False)
    assert (none.returncode, none.stdout, none.stderr) == (3, "", "none.csv: no such file\n")


@pytest.mark.slow
@pytest.mark.skipif(shutil.which("valgrind") is None, reason="needs valgrind")
def test_memory(root, built, tmp_path, catalogue):
    """Every function, its errors, and handles that were freed: valgrind finds nothing lost or used after that."""
    program = compiled(root, built, tmp_path, root / "python/tests/c_interface.c", "-g")
    valgrind = [
        "valgrind",
        "-q",
        "--error-exitcode=9",
        "--leak-check=full",
        "--errors-for-leak-kinds=definite,indirect",
    ]
    environment = {**os.environ, "DONDOLO_VARIANT": "baseline", "OMP_NUM_THREADS": "2"}
    done = subprocess.run([*valgrind, program, catalogue], capture_output=True, text=True, check=False, env=environment)
    assert done.returncode == 0, done.stdout + done.stderr
    assert done.stdout == "48 errors as expected, 0 others\n"


@pytest.mark.slow
@pytest.mark.skipif(shutil.which("mkoctfile") is None, reason="needs mkoctfile, in Debian of liboctave-dev")
def test_octave(root, built, records, tmp_path, catalogue):
    """The MEX file of docs/c.md gives Octave what Python computes."""
    options = ["-Wall", "-Werror", f"-I{root / 'include'}", f"-L{built.parent}", "-ldondolo"]
    source = root / "docs/examples/c_mex.c"
    subprocess.run(["mkoctfile", "--mex", "-o", tmp_path / "fragility.mex", source, *options], check=True, cwd=tmp_path)
    script = tmp_path / "script.m"
    script.write_text(f"""
wall = struct("mechanism", "one_sided", "height", 3, "thickness", 0.25);
[theta, beta, edp] = fragility(wall, "{catalogue.decode()}", "pga", [0.4 0.6 0.8 1.0 1.2]);
printf("%.17g\\n", theta, beta, edp);
try, fragility(setfield(wall, "thicknes", 1), "none", "pga", 1), catch e, disp(e.message), end
try, fragility(1), catch e, disp(e.message), end
""")
    environment = {**os.environ, "LD_LIBRARY_PATH": str(built.parent)}
    done = subprocess.run(
        ["octave-cli", "--no-gui", "--norc", script],
        cwd=tmp_path, env=environment, capture_output=True, text=True, check=True,
    )  # fmt: skip
    *found, unknown, usage = done.stdout.splitlines()
    stripes = dd.multiple_stripe(dd.OneSidedWall(3.0, 0.25), records, [0.4, 0.6, 0.8, 1.0, 1.2], progress=False)
    curve = stripes.fit()
    assert [float(one) for one in found] == [curve.theta, curve.beta, *stripes.edp.ravel()]
    assert "thicknes: no such variable; did you mean 'thickness'?" in unknown
    assert "usage: " in usage


@pytest.mark.slow
@pytest.mark.skipif(shutil.which("pkg-config") is None, reason="needs pkg-config")
def test_installation(root, built, tmp_path, catalogue):
    """What meson installs is what a program is compiled with by pkg-config."""
    meson = [sys.executable, "-m", "mesonbuild.mesonmain", "install", "-C", built.parent, "--no-rebuild"]
    subprocess.run([*meson, "--tags", "devel", "--destdir", tmp_path], check=True, capture_output=True)
    description = next(tmp_path.glob("**/dondolo.pc"))
    environment = {**os.environ, "PKG_CONFIG_PATH": str(description.parent), "PKG_CONFIG_SYSROOT_DIR": str(tmp_path)}
    options = subprocess.run(
        ["pkg-config", "--cflags", "--libs", "dondolo"], env=environment, capture_output=True, text=True, check=True
    ).stdout.split()
    program = tmp_path / "program"
    subprocess.run(["cc", root / "docs/examples/c_program.c", *options, "-o", program], check=True)
    place = {**os.environ, "LD_LIBRARY_PATH": str(description.parent.parent)}
    said = subprocess.run([program, catalogue], capture_output=True, text=True, check=True, env=place)
    assert said.stdout in (root / "docs/c.md").read_text()
    assert said.stdout


def test_the_header_is_that_of_cpp(root, tmp_path):
    if shutil.which("g++") is None:
        pytest.skip("needs g++")
    source = tmp_path / "program.cpp"
    source.write_text("#include <dondolo.h>\nint main() { return dondolo_status(0) - DONDOLO_INPUT; }\n")
    command = ["g++", "-Wall", "-Wextra", "-Werror", "-fsyntax-only", f"-I{root / 'include'}", source]
    subprocess.run(command, check=True)
