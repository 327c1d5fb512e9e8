"""Results as a notebook shows them: tables of names and texts, with units."""

import html.parser
import inspect

import matplotlib

matplotlib.use("agg")

import numpy as np
import pytest
from public import public_things

import dondolo as dd
from dondolo._fortran.library import shown_probability


@pytest.mark.parametrize(
    ("value", "text"),
    [
        (0.0, "0"),
        (4.9e-5, "< 0.0001"),
        (5e-5, "0.0001"),
        (0.25, "0.2500"),
        (0.99994, "0.9999"),
        (0.99996, "> 0.9999"),
        (1.0, "1"),
    ],
)
def test_probabilities(value, text):
    """What is not quite 0 or 1 is distinguished from it."""
    assert shown_probability(value) == text


class Rows(html.parser.HTMLParser):
    """The rows of a table, name and text; tags that are not closed are errors."""

    def __init__(self, text):
        super().__init__()
        self.caption, self.rows, self.open = "", {}, []
        self.feed(text)
        assert self.open == []

    def handle_starttag(self, tag, attrs):
        self.open.append(tag)
        if tag == "th":
            self.name = ""
        elif tag == "td":
            self.rows[self.name] = ""

    def handle_endtag(self, tag):
        assert self.open.pop() == tag

    def handle_data(self, data):
        if self.open[-1] == "caption":
            self.caption += data
        elif self.open[-1] == "th":
            self.name += data
        else:
            self.rows[self.name] += data


@pytest.fixture(scope="module")
def things(wall, stripes, few, records, root, tmp_path_factory):
    """An object of each kind."""
    other, quiet = dd.OneSidedWall(height=1.8, thickness=0.25, name="other"), {"progress": False}
    levels = [0.4, 0.6, 0.8, 1.0, 1.2]
    people = dd.typology([wall, other], few, levels, **quiet)
    curve, ida = stripes.fit(), stripes.incremental()
    site = dd.Site(ag=0.2, f0=2.5, tc_star=0.35, soil="B")
    hazard = dd.HazardCurve([0.05, 0.5, 3.0], [0.05, 0.001, 1e-7])
    risk = curve.risk(hazard)
    two_block, corner = dd.TwoBlockWall(3.0, 0.25), dd.Corner(3.2, 0.5, wing_angle=20.0, hinge_depth=0.03)
    band = dd.HorizontalBending(
        length=4.0, thickness=0.45, end_thrust=25e3, hinge_depth=0.01, sides=1, restitution_value=0.7
    )
    arch = dd.TabulatedWall(2.0, table=root / "data/walls/arch.csv", sides=1, restitution_value=0.9)
    moving = {"joints": [dd.Pin(1, 0, (0.0, 0.0))], "sides": 1, "restitution_value": 0.9}
    body = dd.Body([dd.Part([(0.0, 0.0), (-0.3, 0.0), (-0.3, 2.0), (0.0, 2.0)], width=1.0, density=1800.0)])
    chain = dd.Chain(height=2.0, bodies=[body], **moving)
    pulses = {"frequencies": [1.0, 2.0], "amplitudes": [0.2, 0.6]}
    target = dd.TargetSpectrum.ec8(0.25, soil="C", periods=[0.1, 0.2, 0.5, 1.0, 2.0])
    prefix = tmp_path_factory.mktemp("results") / "people"
    people.write_results(prefix)
    nrml = prefix.with_suffix(".xml")
    dd.write_nrml(nrml, {"walls": {"collapse": curve}})
    path = root / "data/cases/parapet.nml"
    case = dd.read_case(path)
    house = dd.Building(0.3, storeys=3, level=9.0, building_height=9.0)
    found = [
        wall, dd.FreeStandingWall(1.5, 0.25), two_block, corner, band, arch, chain, dd.Population([wall, other]), house,
        records[0], dd.RecordSet(few), dd.RecordSet(records).select(target, 5), records[0].spectrum([0.1, 1.0]), site,
        target, stripes, curve, curve.bootstrap(n_resamples=20), curve.goodness_of_fit(), ida, ida.fit(),
        curve.with_model_error(-0.1, 0.3),
        dd.cloud(wall, records), curve.logit(),
        curve.compare(dd.multiple_stripe(other, records, levels, **quiet).fit()), people, people["all"],
        people["all"].bootstrap(n_resamples=20), hazard, risk, risk.uncertainty(n_draws=100),
        dd.simulate(wall, few[0]), case, dd.run_case(path, progress=False), dd.check_ntc(wall, site),
        dd.compare_designs({"now": wall, "thicker": dd.OneSidedWall(1.5, 0.3)}, records, levels, **quiet),
        dd.compare_intensities(wall, records, ["pga", "pgv"], n_levels=6, n_resamples=20, **quiet),
        dd.overturning_spectrum(wall, dd.pulses.one_sine, **pulses, **quiet),
        dd.weakest_hinge(two_block, few, levels, hinges=[0.5, 0.7], **quiet),
        dd.propagate_uncertainty(
            two_block, few, levels, sources={"hinge": dd.distributions.Uniform(0.5, 0.7)}, n_variants=10, **quiet
        ),
        dd.read_nrml(nrml), dd.cloud(wall, records, scale=3.0).fit(), dd.FunctionFragility(curve),
        dd.Study(few, levels), dd.DiscreteFragility([0.1, 0.2], [0.0, 0.25]),
        dd.read_results(prefix), dd.read_site_hazards(hazard.to_openquake(prefix.parent, site=(11.6, 44.8))),
    ]  # fmt: skip
    return {type(one).__name__: one for one in found}


def rows(thing):
    return Rows(thing._repr_html_()).rows


def test_every_result_is_a_table(things):
    """Of what analyses and readers return; values that are plain numbers, tuples or options have none."""
    plain = {
        "Body", "Boundary", "Certified", "Choice", "Curve", "DistributedSpring", "GivenMass", "Group",
        "Guide", "InertialMass", "Interlock", "Load", "Lognormal", "Normal", "Opening", "Part", "Pin",
        "PointLoad", "PointMass", "PointThrust", "PointTie", "Problem", "Regression", "RotD", "Section", "Sector",
        "Solver", "Spring", "State", "Terms", "Thrust", "Tie", "Triangular", "Uniform", "Wall", "Wedge",
        "Window", "Work",
    }  # fmt: skip
    kinds = {
        name for name, one in public_things().items() if inspect.isclass(one) and not issubclass(one, BaseException)
    }
    assert kinds - plain - {"DondoloWarning"} == set(things)
    for name, thing in things.items():
        shown = Rows(thing._repr_html_())
        assert name in shown.caption, name
        assert shown.rows, name
        assert all(what and text for what, text in shown.rows.items()), name
        assert len(repr(thing)) < 2500, name


@pytest.mark.parametrize(
    ("name", "row", "text"),
    [
        ("OneSidedWall", "height", "1.5 m"),
        ("OneSidedWall", "density", " kg/m3"),
        ("Building", "period", "0.3 s"),
        ("Spectrum", "largest displacement", " m"),
        ("Fragility", "theta", " g ("),
        ("PopulationCurve", "theta", " g"),
        ("PopulationCurve", "walls", "2"),
        ("IntensityComparison", "pgv", " m/s, dispersion"),
        ("Case", "levels", " g"),
        ("Bootstrap", "theta, 95 % interval", " to "),
        ("TypologyBootstrap", "drawn", "records and walls"),
        ("Comparison", "pairing", "paired, 22 clusters shared"),
        ("CodeCheck", "a_0", " m/s2"),
    ],
)
def test_units(things, name, row, text):
    shown = next(value for what, value in rows(things[name]).items() if what.startswith(row))
    assert text in shown


def test_curves_show_their_numbers(things, stripes):
    people, curve = things["PopulationCurve"], things["Fragility"]
    assert f"theta {people.fit.theta:.6g} g, beta {people.fit.beta:.6g}>" in repr(people)
    assert repr(curve).startswith(f"<Fragility: wall {curve.wall.name}, measure pga, EDP threshold 1, theta ")
    measure = dd.fit_fragility([0.2, 0.4, 0.6], [1, 5, 9], 10, im="pgv")
    assert repr(measure).startswith("<Fragility: measure pgv, theta ")


def test_directions_are_not_listed(records):
    found = records[0].rotd(records[1])
    assert repr(found) == (
        f"<RotD: rotd50={found.rotd50:.6g}, rotd100={found.rotd100:.6g}, angle={found.angle:g}, 180 directions>"
    )


def test_a_certificate_is_shown(wall, few):
    sure = dd.multiple_stripe(wall, few, [0.5, 0.9], certify=True, progress=False)
    counts = [int(word) for word in rows(sure)["certified"].replace(",", "").split() if word.isdigit()]
    assert sum(counts) == sure.edp.size
    assert counts[0] == np.count_nonzero(sure.status == dd.results.Certified.DOUBLE)


def test_properties_are_there_or_are_not(things):
    """What inspects an object, as hasattr, meets no other error than that of an attribute that is not there."""
    looked = 0
    for thing in things.values():
        for name in dir(thing):
            hasattr(thing, name)
            looked += 1
    assert looked > 1000
    assert not hasattr(things["Stripes"], "theta_bounds")
    with pytest.raises(dd.errors.NotKnownError, match="theta_bounds: only of certified stripes"):
        _ = things["Stripes"].theta_bounds
    inspect.getmembers(things["Stripes"])


def test_everything_is_equal_to_itself_and_has_a_hash(things, stripes):
    """Arrays in a result decide neither."""
    for name, thing in things.items():
        assert (thing == thing) is True, name
        assert (thing == things["Site"]) is (name == "Site"), name
        if name not in ("TabulatedWall", "Chain"):
            hash(thing)
    one, other = stripes.fit().logit(), stripes.fit().logit()
    assert one != other
    assert len({one, other, one}) == 2


def test_a_logistic_curve_shows_its_numbers(stripes):
    curve = stripes.fit().logit()
    shown = rows(curve)
    assert shown["theta"] == f"{curve.theta:.6g} g"
    assert shown["b1"].startswith(f"{curve.b1:.6g} (standard error ")
    assert repr(curve).startswith("<Logistic: measure pga, histories ")
    none = dd.cloud(dd.OneSidedWall(1.5, 0.25), [dd.Record(np.sin(np.arange(99.0)), 0.01, "weak")], scale=0.1).collapse
    assert rows(none)["status"] == "none"
