"""What newcomers get wrong in Python: an error that names the argument, or a warning that names the likely cause."""

import pickle
import warnings
from fnmatch import fnmatch

import numpy as np
import pytest

import dondolo as dd

LEVELS = [0.6, 0.8, 1.0, 1.2]
WALL = dd.OneSidedWall(1.5, 0.25, name="parapet")
RECORDS = dd.synthetic_records(6.5, 10.0, "shallow", n_records=12)


def run(wall=WALL, records=RECORDS, levels=LEVELS, **more):
    return dd.multiple_stripe(wall, records, levels, progress=False, **more)


def times(factor, dt=None):
    """The records in another unit."""
    return [dd.Record(factor * one.acceleration, dt or one.dt, one.name) for one in RECORDS]


def cut():
    """The records from the middle of their motion on."""
    return [dd.Record(one.acceleration[np.abs(one.acceleration).argmax() :], one.dt, one.name) for one in RECORDS]


def upright():
    """The records as if they were vertical components."""
    return [dd.Record(one.acceleration, one.dt, one.name, metadata={"component": "BHZ00"}) for one in RECORDS]


@pytest.mark.parametrize(
    ("call", "code", "words"),
    [
        # Walls
        (lambda: run(dd.OneSidedWall(3.0, 25.0)), "value_above_usual", "thickness = 25 m * is it in centimetres?"),
        (lambda: run(dd.OneSidedWall(3.0, 250.0)), "value_above_usual", "thickness = 250 m * is it in millimetres?"),
        (lambda: run(dd.OneSidedWall(0.25, 3.0)), "height_below_thickness", "are they swapped?"),
        (lambda: run(dd.OneSidedWall(3.0, 0.25, density=18.0)), "value_below_usual", "is it in kN/m3 or t/m3?"),
        # Levels
        (lambda: run(levels=[3.0, 6.0, 9.0]), "levels_above_usual", "are they in m/s2 or cm/s2?"),
        (lambda: run(levels=[0.01, 0.02]).fit(), "no_motion", "the wall begins to rock at a PGA of 0.1667 g"),
        (lambda: run(levels=[0.8]).fit(), "single_level", "at least two are needed"),
        # Records: in g instead of m/s2, in cm/s2, with a rate instead of a step, one alone
        (lambda: run(records=times(1.0 / 9.81)), "scale_factors_large", "above 10 in 48 of 48 histories"),
        (lambda: run(records=times(100.0)), "record_pga", "more than 3 g: wrong units?"),
        (lambda: run(records=times(1.0, 1.0)), "record_pgv_pga", "wrong time step"),
        (
            lambda: run(records=times(1.0, 0.001)),
            "records_pgv_pga",
            "of 12 records = * time step too small, 0.001 s of",
        ),
        (lambda: run(records=cut()), "record_start", "begins at * % of its PGA: triggered late, or cut? (12 of 12"),
        (
            lambda: run(records=upright()),
            "record_vertical",
            "by 'BHZ00', and moves the wall as if * (12 of 12 records)",
        ),
        (lambda: dd.simulate(WALL, upright()[0]), "record_vertical", "is a vertical component, by 'BHZ00'"),
        (lambda: run(records=RECORDS[0]).fit(), "separated", "no curve is fitted"),
        (lambda: run().fit_damage_states([0.02, 0.05]), "all_collapse", "damage state 0.02 in place of collapse"),
    ],
)
def test_warnings(call, code, words):
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always", dd.errors.DondoloWarning)
        call()
    said = [str(one.message) for one in caught if one.message.code == code]
    assert said
    assert fnmatch(said[0], f"*{words}*")


@pytest.mark.parametrize(
    ("call", "words"),
    [
        (lambda: dd.OneSidedWall(3000.0, 250.0), "height = 3000: .* is it in millimetres?"),
        (lambda: dd.OneSidedWall("3,0", 0.25), "height = '3,0': must be a number"),
        (
            lambda: dd.OneSidedWall(3.0, 0.25, ties=[dd.Tie(2.8, area=200.0, length=5.0)]),
            r"ties\[0\].area = 200: .*in mm2 per metre",
        ),
        (lambda: run([WALL, WALL]), "wall: must be a Wall, not list"),
        (lambda: run(levels=[0.6, 0.4, 0.8]), "levels = 0.6, 0.4: must increase strictly"),
        (lambda: run(levels="auto"), "levels: must be numbers, not str .adaptive_stripes chooses levels"),
        (lambda: run(levels="0.2:0.2:1.0"), "levels: must be numbers, not str"),
        (lambda: run(levels=["0.2"]), "levels: must be numbers"),
        (lambda: run(records="records.csv"), "records: must be a Record or several, not str .read_catalogue reads"),
        (lambda: run(polarity="+"), "polarity = '.': must be one of 'as_recorded', 'reversed', 'both'"),
        (lambda: run(im="sa"), "im = 'sa': must be one of 'pga', .* such as 'sa"),
        (lambda: dd.simulate(RECORDS[0], WALL), "wall: must be a Wall, not Record"),
        (lambda: dd.simulate(WALL, RECORDS), "record: must be a Record, not list"),
        (lambda: dd.simulate(WALL, dd.Record(RECORDS[0].acceleration, 200.0)), "dt = 200: must lie between"),
        (lambda: dd.Record(np.zeros((100, 2)), 0.01), "acceleration: must be one row of numbers"),
        (lambda: dd.read_catalogue("recrods.csv"), "recrods.csv: no such file"),
        (lambda: dd.HazardCurve([0.05, 0.2, 0.5], [30.0, 475.0, 2475.0]), "are these return periods?"),
        (lambda: run().fit_damage_states([10.0, 40.0]), "edp_threshold = 10: must be positive and at most edp_limit"),
        (lambda: dd.report("out/parapet", "p.html"), "results: must be results of an analysis, such as Stripes"),
    ],
)
@pytest.mark.filterwarnings("ignore::dondolo.errors.DondoloWarning")
def test_errors(call, words):
    with pytest.raises(dd.errors.InputError, match=words):
        call()


@pytest.mark.parametrize(
    ("call", "code", "variable", "sentence"),
    [
        (lambda: run(None), "wrong_type", "wall", "wall: must be a Wall, not NoneType"),
        (lambda: run(levels=[[0.6]]), "not_numbers", "levels", "levels: must be one row of numbers"),
        (lambda: run(levels=[]), "not_given", "levels", "levels: must be given"),
        (lambda: run(certify="yes"), "not_a_flag", "certify", "certify = 'yes': must be True or False"),
        (
            lambda: dd.HazardCurve.power_law("a", 2.5),
            "not_a_number",
            "k0",
            "k0 = 'a': must be a number",
        ),
        (
            lambda: dd.adaptive_stripes(WALL, RECORDS, 1.5, progress=False),
            "not_an_integer",
            "budget",
            "budget = 1.5: must be an integer, at least 1",
        ),
        (
            lambda: run().to_csv("x.csv", "walks"),
            "not_a_word",
            "table",
            "table = 'walks': must be one of 'histories', 'stripes', 'walls'",
        ),
        (
            lambda: dd.HazardCurve([0.2, 0.1], [1e-2, 1e-3]),
            "not_increasing",
            "levels",
            "levels = 0.2, 0.1: must increase strictly",
        ),
        (
            lambda: dd.Fragility.of_parameters(0.8, 0.4).ppf(50.0),
            "not_a_probability",
            "p",
            "p = 50: must lie between 0 and 1",
        ),
    ],
)
def test_codes(call, code, variable, sentence):
    """What is wrong with an argument, for programs; the sentence of each code."""
    with pytest.raises(dd.errors.InputError) as caught:
        call()
    error = pickle.loads(pickle.dumps(caught.value))
    assert error.errors == (dd.errors.Problem(str(error), code, variable),)
    assert str(error).startswith(sentence)


@pytest.mark.parametrize("polarity", ["as_recorded", "both"])
def test_one_record(polarity, tmp_path):
    """More levels do not help with one record: neither a case nor a fit in Python asks for them."""
    dd.RecordSet(RECORDS[:1]).to_catalogue(tmp_path / "one.csv")
    (tmp_path / "case.nml").write_text(
        "&job task='stripes' output='out/one' /\n&wall name='w' mechanism='one_sided' height=1.5 thickness=0.25 /\n"
        f"&records catalogue='one.csv' polarity='{polarity}' /\n&stripes levels=0.2,2.0,4.0,8.0 /\n"
    )
    with pytest.warns(dd.errors.DondoloWarning, match="one record gives one threshold, whatever the levels") as caught:
        stripes = dd.run_case(tmp_path / "case.nml", progress=False).stripes
    (of_case,) = [one.message for one in caught if one.message.code == "separated"]
    with pytest.warns(dd.errors.DondoloWarning) as caught:
        stripes.fit()
    assert [one.message for one in caught] == [of_case]


class Quantity(np.ndarray):
    """An array with a unit, as packages of units have it."""

    def __new__(cls, values, unit):
        made = np.asarray(values, dtype=float).view(cls)
        made.unit = unit
        return made

    def __array_finalize__(self, other):
        self.unit = getattr(other, "unit", None)


class Scalar(float):
    """A number with a unit of another package."""

    units = "millisecond"


@pytest.mark.parametrize(
    "call",
    [
        lambda: dd.Record(Quantity([0.0, 150.0, -90.0], "cm / s2"), 0.01),
        lambda: dd.Record([0.0, 1.5, -0.9], Scalar(10.0)),
        lambda: dd.Record([0.0, 1.5, -0.9], Quantity(10.0, "ms")),
        lambda: dd.Record([0.0, 1.5, -0.9], 0.01, vertical=Quantity([0.0, 15.0, -9.0], "cm / s2")),
        lambda: dd.read_records("never.txt", dt=Scalar(10.0)),
        lambda: dd.OneSidedWall(Quantity(300.0, "cm"), 0.25),
        lambda: dd.OneSidedWall(3.0, Scalar(25.0)),
        lambda: dd.TwoBlockWall(3.0, 0.25, overburden=Quantity(5.0, "kN / m")),
        lambda: run(levels=Quantity([1.0, 2.0], "m / s2")),
        lambda: run(levels=[Scalar(0.5), Scalar(0.9)]),
        lambda: dd.HazardCurve(Quantity([0.1, 0.5], "m / s2"), [1e-2, 1e-3]),
        lambda: dd.Site(Quantity(0.2, "m / s2"), 2.4, 0.3),
        lambda: RECORDS[0].spectrum(Quantity([100.0, 500.0], "ms")),
        lambda: RECORDS[0].resample(Scalar(5.0)),
        lambda: RECORDS[0].with_vertical(RECORDS[0], factor=Quantity(50.0, "%")),
        lambda: dd.fit_fragility(Quantity([1.0, 2.0, 3.0], "m / s2"), [0, 5, 10], 10),
        lambda: dd.distributions.Normal(Quantity(3.0, "m"), 0.1),
        lambda: dd.Building(Scalar(300.0), storeys=3, level=6.0, building_height=9.0),
    ],
)
def test_units_are_not_stripped(call):
    """One rule for numbers and arrays: what has a unit is refused, with what to write."""
    with pytest.raises(dd.errors.InputError, match=r"has the unit '.*': must be plain numbers .*to_value\(unit\)"):
        call()


def test_numbers_without_a_unit_are_plain():
    """As ratios of quantities are, and the columns of a table that has one of the name unit."""
    plain = dd.Record(Quantity([0.0, 1.5, -0.9], ""), Quantity(0.01, "dimensionless"))
    assert plain.peak_acceleration == 1.5
    pandas = pytest.importorskip("pandas")
    assert dd.Record(pandas.Series([0.5, 1.0], index=["unit", "units"]), 0.01).peak_acceleration == 1.0
