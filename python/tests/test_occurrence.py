"""Mechanisms that exclude each other: against all that can occur, drawn and one by one, and by every route."""

import dataclasses
import itertools
import subprocess

import numpy as np
import pytest
from scipy.integrate import quad
from study import same_tables
from test_routes import NOT_IN_FILES, WRITTEN_ALONE, differences

import dondolo as dd
from dondolo.curves.bootstrap import draw_records
from dondolo.populations.combination import combine_rows

pytestmark = pytest.mark.filterwarnings("ignore::dondolo.errors.DondoloWarning")

LEVELS = np.array([0.3, 0.5, 0.7, 0.9, 1.1, 1.4])
ALL_LEVELS = np.arange(1, 21) / 10.0
STATES = [0.4]
DRAWS = 4000

# Walls that overturn or fold, with a rest in which nothing can occur; that have one of three hinges; that both overturn
# and fold where the connection is poor; whose mechanisms are independent; of one mechanism; and hinges of one facade
TABLE = """\
name,mechanism,height,thickness,hinge,weight,group,p_occ,occurrence,alternative,facade
a,one_sided,2.2,0.25,,3,low,0.3,exclusive,,
a,two_block,3.0,0.25,,3,low,0.6,exclusive,,
b,two_block,2.8,0.25,0.5,1,low,0.2,exclusive,,
b,two_block,2.8,0.25,0.6,1,low,0.5,exclusive,,
b,two_block,2.8,0.25,0.75,1,low,0.3,exclusive,,
c,one_sided,1.8,0.3,,2,low,0.25,exclusive,poor,
c,two_block,2.4,0.25,,2,low,0.25,exclusive,poor,
c,free_standing,1.6,0.3,,2,low,0.7,exclusive,good,
d,one_sided,2.0,0.25,,2,high,0.7,,,
d,two_block,2.6,0.25,,2,high,0.5,independent,,
e,one_sided,1.6,0.25,,1,high,0.9,exclusive,,
f low,two_block,3.0,0.3,0.5,1.5,high,0.4,exclusive,,f
f high,two_block,3.0,0.3,0.7,1.5,high,0.6,exclusive,,f
"""
CASE = """\
&job task = 'typology', output = '{folder}/results' /
&population file = 'walls.csv' /
&records catalogue = '{root}/data/records/synthetic44.csv', polarity = 'both' /
&stripes im = 'pga', levels = 0.3, 0.5, 0.7, 0.9, 1.1, 1.4, edp_thresholds = 0.4 /
"""
# Of each wall its rows; of what can occur in it, probabilities and rows
WALLS = {
    "a": [(0.3, [0]), (0.6, [1])],
    "b": [(0.2, [2]), (0.5, [3]), (0.3, [4])],
    "c": [(0.25, [5, 6]), (0.7, [7])],
    "d": [(0.7 * 0.5, [8, 9]), (0.7 * 0.5, [8]), (0.3 * 0.5, [9])],
    "e": [(0.9, [10])],
    "f": [(0.4, [11]), (0.6, [12])],
}


@pytest.fixture(scope="module")
def table(tmp_path_factory):
    path = tmp_path_factory.mktemp("occurrence") / "walls.csv"
    path.write_text(TABLE)
    return path


@pytest.fixture(scope="module")
def people(table):
    return dd.Population.from_csv(table)


@pytest.fixture(scope="module")
def found(people, records):
    return dd.typology(people, records, LEVELS, polarity="both", edp_thresholds=STATES, progress=False)


def collapses(typology, row):
    """Whether each history of a row collapses (levels, histories), in both polarities."""
    flags = typology.flags.of([row])[0, -1]
    return np.tile(flags, 2) if flags.shape[1] == typology.flags.records else flags


def fractions(typology):
    """Mean fractions of each wall and state by all that can occur in it, in the same histories and as independent."""
    same, product = {}, {}
    for name, ways in WALLS.items():
        flags = [(p, np.array([collapses(typology, row) for row in rows])) for p, rows in ways]
        same[name] = sum(p * of.any(axis=0).mean(axis=-1) for p, of in flags)
        product[name] = sum(p * (1.0 - (1.0 - of.mean(axis=-1)).prod(axis=0)) for p, of in flags)
    return same, product


def test_exact(people, found):
    """By the sum over all that can occur."""
    same, product = fractions(found)
    weights = people.weights[people.first_rows]
    for name, fraction in same.items():
        wall = found.combined[name]
        assert np.allclose(wall.upper_asymptote * wall.collapses / wall.histories, product[name], rtol=0, atol=1e-14)
        assert wall.upper_asymptote == pytest.approx(sum(p for p, _ in WALLS[name]), abs=1e-15)
        if name != "e":
            union = found.unions[name]
            assert np.allclose(union.upper_asymptote * union.collapses / union.histories, fraction, rtol=0, atol=1e-14)
    mean = np.average(list(product.values()), axis=0, weights=weights)
    assert np.allclose(found["all"].mean_fraction, mean, rtol=0, atol=1e-14)
    assert found["all"].upper_asymptote == pytest.approx(
        np.average([sum(p for p, _ in ways) for ways in WALLS.values()], weights=weights), abs=1e-15
    )
    union = found.group_unions[""]
    mean = np.average(list(same.values()), axis=0, weights=weights)
    assert np.allclose(union.upper_asymptote * union.collapses / union.histories, mean, rtol=0, atol=1e-14)
    # Fractiles are those of six walls, none of a row
    chances = [
        sum(p * (1.0 - np.prod([1.0 - found.curves[row](0.8) for row in rows])) for p, rows in ways)
        for ways in WALLS.values()
    ]
    assert np.allclose(found["all"].probabilities(0.8), chances, rtol=0, atol=1e-13)
    assert found["all"](0.8) == pytest.approx(np.average(chances, weights=weights), abs=1e-13)


def test_curve_of_a_mechanism(people, found):
    """The mean over what it occurs in, each hinge with its probability."""
    rows = [i for i, wall in enumerate(people) if wall.mechanism == "two_block"]
    weights = (people.weights * people.p_occ)[rows]
    mean = np.average([found.curves[row](0.8) for row in rows], weights=weights)
    assert found["two_block"](0.8) == pytest.approx(mean, abs=1e-14)


@pytest.mark.parametrize("exclusive", [True, False])
def test_monte_carlo(found, exclusive):
    """Which mechanism occurs is drawn wall by wall, and collapses are counted from flags."""
    rng = np.random.default_rng(3)
    names = list(WALLS)
    if not exclusive:
        # Hinges of one wall are alternatives only.
        names.remove("b")
        found = of_rows(found, [i for i, name in enumerate(found.population.wholes) if name != "b"], independent=True)
    people = found.population
    for name in names:
        rows = [i for i, whole in enumerate(people.wholes) if whole == name]
        flags = np.array([collapses(found, row) for row in rows])
        records = rng.integers(flags.shape[-1], size=DRAWS)
        counted = flags[:, :, records]
        if exclusive and name != "d":
            ways = WALLS[name]
            drawn = rng.choice(len(ways) + 1, size=DRAWS, p=[*(p for p, _ in ways), 1.0 - sum(p for p, _ in ways)])
            occurs = np.array([[row in (*ways, (0.0, []))[one][1] for one in drawn] for row in rows])
        else:
            occurs = rng.random((len(rows), DRAWS)) < people.p_occ[rows, None]
        collapsed = (counted & occurs[:, None]).any(axis=0)
        curve = found.unions[name] if name in found.unions else found.combined[name]
        expected = curve.upper_asymptote * curve.collapses / curve.histories
        error = np.sqrt(np.maximum(expected * (1.0 - expected), 1e-12) / DRAWS)
        assert np.all(np.abs(collapsed.mean(axis=-1) - expected) <= 4.0 * error), name


def of_rows(found, rows, *, independent=False):
    """The results of some walls only, their mechanisms as they are or independent."""
    people, index = found.population[rows], np.array(rows)
    if independent:
        people = dataclasses.replace(people, occurrence="independent", alternatives=None)
    return combine_rows(
        people,
        found.im,
        found.levels,
        found.edp_thresholds,
        found.exceedances[:, :, index],
        found.histories[:, index],
        found.work,
        found.flags.chosen(index),
    )


def test_alike_alternatives_are_one_wall(records):
    """Two alternatives that are the same mechanism are that mechanism: mean, errors, fractiles, risk, bootstrap."""
    sizes = [(2.2, 0.25), (2.6, 0.25), (3.0, 0.3), (2.4, 0.25), (2.0, 0.25)]
    plain = [dd.TwoBlockWall(h, b, name=f"{i}") for i, (h, b) in enumerate(sizes)]
    weights = [1.0, 2.0, 1.5, 0.5, 1.0]
    double = dd.Population(
        [wall for wall in plain for _ in range(2)],
        np.repeat(weights, 2),
        p_occ=[0.25, 0.75] * len(plain),
        occurrence="exclusive",
    )
    arguments = {"levels": LEVELS, "edp_thresholds": STATES, "progress": False}
    one = dd.typology(dd.Population(plain, weights), records, **arguments)
    two = dd.typology(double, records, **arguments)
    hazard = dd.HazardCurve.power_law(1e-3, 2.5)
    for state in (STATES[0], 1.0):
        mine = one.at(state)["all"]
        for theirs in (two.at(state)["all"], two.at(state)["two_block"]):
            assert np.allclose(mine(LEVELS), theirs(LEVELS), rtol=0, atol=1e-13)
            for name in ("theta", "beta", "se_ln_theta", "se_beta", "degrees_of_freedom"):
                assert getattr(theirs.fit, name) == pytest.approx(getattr(mine.fit, name), rel=1e-9), name
            assert {part.kind: len(part.changes) for part in theirs.fit.parts} == {
                part.kind: len(part.changes) for part in mine.fit.parts
            }
            again = theirs.bootstrap(n_resamples=50, rng=1)
            assert np.allclose(again.theta, mine.bootstrap(n_resamples=50, rng=1).theta, rtol=1e-6)
            risk, expected = theirs.risk(hazard), mine.risk(hazard)
            assert risk.annual_frequency == pytest.approx(expected.annual_frequency, rel=1e-9)
            assert risk.probability(50) == pytest.approx(expected.probability(50), rel=1e-9)
            for kind, changes in mine.changes(LEVELS, np.ones(len(LEVELS))).items():
                theirs_too = theirs.changes(LEVELS, np.ones(len(LEVELS)))[kind]
                assert np.allclose(theirs_too, changes, rtol=1e-8, atol=1e-12), kind
        whole = two.at(state)["all"]
        assert np.allclose(whole.level_fractiles, mine.level_fractiles, rtol=0, atol=1e-13)
        assert whole.beta_walls == pytest.approx(mine.beta_walls, rel=1e-9)
        assert whole.beta_records == pytest.approx(mine.beta_records, rel=1e-9)


def test_errors_by_leaving_out(people, found):
    """Changes if a wall is left out are those of the population without it, to first order, in the union too."""
    whole = found["all"]
    for fit in (whole.fit, found.group_unions[""]):
        walls = next(part for part in fit.parts if part.kind == "walls")
        assert len(walls.changes) == len(WALLS)
        for change, name in zip(walls.changes, WALLS, strict=True):
            rest = [i for i, own in enumerate(people.wholes) if own != name]
            without = of_rows(found, rest)
            other = (without["all"].fit if fit is whole.fit else without.group_unions[""]).theta
            assert np.log(other / fit.theta) == pytest.approx(change[0], abs=0.25 * abs(change[0]) + 0.02), name


@pytest.mark.parametrize("group", ["", "low", "high"])
def test_bootstrap_by_brute_force(people, found, group):
    """Wall by wall and sample by sample, records and walls drawn with the same random numbers."""
    names = [name for name in WALLS if group in ("", people.group_names[WALLS[name][0][1][0]])]
    samples, labels = 20, found.flags.labels
    boot = found["all", group].bootstrap(n_resamples=samples, rng=5)
    generator = np.random.default_rng(5)
    drawn = draw_records(found.flags.clusters, samples, generator)
    assert len(labels) > 2
    for sample in range(samples):
        times = np.bincount(generator.integers(len(names), size=len(names)), minlength=len(names))
        total, weight = 0.0, 0.0
        for name, often in zip(names, times, strict=True):
            ways = []
            for p, rows in WALLS[name]:
                of = np.array([collapses(found, row).reshape(len(LEVELS), 2, -1).mean(axis=1) for row in rows])
                share = (of @ drawn[sample]) / drawn[sample].sum()
                ways.append(p * (1.0 - (1.0 - share).prod(axis=0)))
            own = often * people.weights[people.wholes.index(name)]
            total, weight = total + own * sum(ways), weight + own
        assert np.allclose(boot.mean_fraction[sample], total / weight, rtol=0, atol=1e-12)


def test_risk_by_enumeration(people, found):
    """A wall is for all earthquakes what it is: the sum over all that can occur of 1 - exp(-frequency t)."""
    hazard = dd.HazardCurve.power_law(1e-3, 2.5)
    share = people.weights[people.first_rows] / people.weights[people.first_rows].sum()
    expected, mean = 0.0, 0.0
    for weight, ways in zip(share, WALLS.values(), strict=True):
        for p, rows in ways:

            def density(u, rows=rows):
                curves = [found.curves[row](np.exp(u)) for row in rows]
                return (1.0 - np.prod(1.0 - np.array(curves))) * 2.5e-3 * np.exp(-2.5 * u)

            frequency = quad(density, np.log(0.02), np.log(1e4), epsabs=0, epsrel=1e-10, limit=500)[0]
            expected += weight * p * -np.expm1(-frequency * 475.0)
            mean += weight * p * frequency
    risk = found["all"].risk(hazard)
    assert risk.annual_frequency == pytest.approx(mean, rel=1e-6)
    assert risk.probability(475) == pytest.approx(expected, rel=1e-6)


@pytest.fixture(scope="module")
def ran(executable, root, table, tmp_path_factory):
    """The case, run by the executable."""
    folder = tmp_path_factory.mktemp("case")
    (folder / "walls.csv").write_text(TABLE)
    (folder / "case.nml").write_text(CASE.format(root=root, folder=folder))
    subprocess.run([executable, "--quiet", folder / "case.nml"], cwd=folder, capture_output=True, check=True)
    return folder


def test_routes(ran, found, tmp_path):
    """The executable's files, `run_case`, `dd.typology`, files and archives that Python writes."""
    files = dd.read_results(ran / "results")
    case = dd.run_case(ran / "case.nml", progress=False)
    assert [*differences(case, files, "case", NOT_IN_FILES)] == []
    assert [*differences(case.typology.at(0.4), files.typology.at(0.4), "state", NOT_IN_FILES)] == []
    ignored = NOT_IN_FILES | {"Typology.warnings", "Population.origin", "Typology.work"}
    assert [*differences(found, case.typology, "typology", ignored)] == []
    assert {warning.code for warning in found.warnings} == {warning.code for warning in case.typology.warnings}
    found.write_results(tmp_path / "written")
    for end in ("walls", "typology", "unions", "fragility", "stripes"):
        mine = [line for line in (tmp_path / f"written_{end}.csv").read_text().splitlines() if line[0] != "#"]
        theirs = [line for line in (ran / f"results_{end}.csv").read_text().splitlines() if line[0] != "#"]
        assert same_tables(end, mine, theirs), end
    again = dd.read_results(tmp_path / "written").typology
    assert [*differences(again, files.typology, "again", ignored | WRITTEN_ALONE)] == []
    found.save(tmp_path / "saved.npz")
    assert [*differences(dd.load(tmp_path / "saved.npz"), found, "saved", {"StoredCurves"})] == []
    found.population.to_csv(tmp_path / "table.csv")
    back = dd.Population.from_csv(tmp_path / "table.csv")
    assert [*differences(back, found.population, "table", {"Population.origin"})] == []
    # Read back, the bootstrap over walls and the risk are those of memory
    hazard = dd.HazardCurve.power_law(1e-3, 2.5)
    assert again["all"].risk(hazard).probability(50) == found["all"].risk(hazard).probability(50)
    walls = [one["all"].bootstrap(n_resamples=20, over="walls").theta for one in (again, found)]
    assert np.array_equal(*walls)


def test_case_without_a_column(ran, root, tmp_path):
    """&population occurrence is that of all walls, in the results too; the store of counts is the same."""
    lines = [",".join(line.split(",")[:8]) for line in TABLE.splitlines() if line.split(",")[0] in ("name", "a", "e")]
    (tmp_path / "walls.csv").write_text("\n".join(lines) + "\n")
    text = CASE.format(root=root, folder=tmp_path)
    results = {}
    for word in ("independent", "exclusive"):
        (tmp_path / "case.nml").write_text(text.replace("'walls.csv'", f"'walls.csv', occurrence = '{word}'"))
        results[word] = dd.run_case(tmp_path / "case.nml", progress=False)
        assert results[word].run.settings["population"]["occurrence"] == word
        assert results[word].typology.population.occurrence == (word,) * 3
    assert results["exclusive"].typology["all"].upper_asymptote == pytest.approx((3 * 0.9 + 0.9) / 4)
    assert results["independent"].typology["all"].upper_asymptote == pytest.approx((3 * 0.72 + 0.9) / 4)
    people = dd.Population.from_csv(tmp_path / "walls.csv", occurrence="exclusive")
    assert people.occurrence == ("exclusive",) * 3


def test_checkpoint(people, few, tmp_path):
    """Histories do not depend on what can occur: a checkpoint serves both."""
    arguments = {"levels": LEVELS, "checkpoint": tmp_path / "counts", "progress": False}
    people = people[[i for i, name in enumerate(people.wholes) if name != "b"]]
    one = dd.typology(people, few, **arguments)
    before = (tmp_path / "counts").read_bytes()
    other = dd.typology(dataclasses.replace(people, occurrence=None, alternatives=None), few, **arguments)
    assert (tmp_path / "counts").read_bytes() == before
    assert np.array_equal(one.exceedances, other.exceedances)
    assert not np.allclose(one["all"].mean_fraction, other["all"].mean_fraction)


def test_nrml_and_report(found, tmp_path):
    """Functions are those of the mean curves; the report shows which mechanisms exclude each other."""
    functions, _ = found.nrml_functions()
    curve = functions["population/all"]["collapse"]
    assert curve(0.8) == pytest.approx(found["all"](0.8), rel=5e-3)
    dd.report(found, tmp_path / "report.html")
    text = (tmp_path / "report.html").read_text()
    assert "of exclusive alternatives" in text
    assert ">exclusive<" in text


WORKED = {
    "independent": ("recorded", [0.286, 0.577, 0.741, 0.785]),
    "exclusive": ("recorded", [0.299, 0.654, 0.910, 0.998]),
}


@pytest.mark.parametrize("occurrence", WORKED)
def test_worked_example(occurrence, recordings, root):
    """Thirty walls that overturn (p) or fold (1 - p), on recorded components: docs/city.md."""
    people = dd.Population.from_csv(root / "data/walls/alternatives.csv", occurrence=occurrence)
    records = dd.read_catalogue(recordings / "italy44.csv")
    found = dd.typology(people, records, ALL_LEVELS, polarity="both", progress=False)
    assert np.round(found["all"]([0.5, 1.0, 2.0, 5.0]), 3).tolist() == WORKED[occurrence][1]
    assert len(found.combined) == found["all"].n_walls == 30
    codes = [warning.code for warning in found.warnings]
    assert ("probabilities_sum_to_one" in codes) == (occurrence == "independent")


def test_the_detour_has_the_same_mean(records, root):
    """A row for each alternative with weight p has the same mean, but counts alternatives as walls."""
    people = dd.Population.from_csv(root / "data/walls/alternatives.csv", occurrence="exclusive")
    rows = [dataclasses.replace(wall, name=f"{i}") for i, wall in enumerate(people)]
    detour = dd.Population(rows, people.weights * people.p_occ)
    one, two = (dd.typology(walls, records, ALL_LEVELS, progress=False)["all"] for walls in (people, detour))
    assert np.allclose(one(ALL_LEVELS), two(ALL_LEVELS), rtol=0, atol=1e-14)
    assert (one.n_walls, two.n_walls) == (30, 60)
    # Alternatives of one wall are no walls: fractiles of rows are wider than those of walls
    spread = [np.diff(curve.fractiles(1.0, [0.16, 0.84]).ravel())[0] for curve in (one, two)]
    assert spread[0] < spread[1]


def test_note(few):
    """Probabilities that add up to 1 ask; the executable's sentence."""
    walls = [dd.OneSidedWall(2.0, 0.25, name="a"), dd.TwoBlockWall(2.6, 0.25, name="a")]
    for p_occ, occurrence, asked in (
        ([0.3, 0.7], "independent", True),
        ([0.3, 0.6999995], "independent", True),
        ([0.3, 0.6], "independent", False),
        ([1.0, 0.0], "independent", False),
        ([0.3, 0.7], "exclusive", False),
    ):
        people = dd.Population(walls, p_occ=p_occ, occurrence=occurrence)
        codes = [warning.code for warning in dd.typology(people, few, LEVELS, progress=False).warnings]
        assert ("probabilities_sum_to_one" in codes) == asked


@pytest.mark.parametrize(
    ("changes", "sentence"),
    [
        ({"p_occ": [0.5, 0.6, 0.1]}, "wall 'a': the probabilities p_occ of its exclusive alternatives add up to 1.1"),
        ({"occurrence": "either"}, "occurrence = 'either': must be one of 'independent', 'exclusive'"),
        ({"occurrence": ["exclusive"]}, "3 walls, 1 words of occurrence: must be as many"),
        (
            {"occurrence": ["exclusive", "independent", "exclusive"]},
            "name = 'a': mechanisms of one wall must have the same occurrence",
        ),
        ({"alternatives": ["x", "y", "x"]}, "wall 'a': alternative = 'x': its rows must be consecutive"),
        ({"alternatives": ["x", "x", "y"]}, "wall 'a': mechanisms of one alternative, 'x', must have the same p_occ"),
        (
            {"occurrence": "independent", "alternatives": ["x", "", ""]},
            "wall 'a': alternative = 'x': only for occurrence = 'exclusive'",
        ),
    ],
)
def test_refused(changes, sentence):
    walls = [
        dd.OneSidedWall(2.0, 0.25, name="a"),
        dd.TwoBlockWall(2.6, 0.25, name="a"),
        dd.FreeStandingWall(2.0, 0.25, name="a"),
    ]
    given = {"p_occ": [0.2, 0.3, 0.4], "occurrence": "exclusive"} | changes
    with pytest.raises(dd.errors.InputError) as caught:
        dd.Population(walls, **given)
    assert str(caught.value).startswith(sentence)


def test_one_mechanism_twice():
    """Alternatives may have a mechanism in common, independent mechanisms and those of one alternative may not."""
    walls = [dd.TwoBlockWall(2.6, 0.25, hinge=hinge, name="a") for hinge in (0.5, 0.7)]
    people = dd.Population(walls, p_occ=[0.4, 0.6], occurrence="exclusive")
    assert people.alternative_numbers.tolist() == [1, 2]
    for changes in ({}, {"occurrence": "exclusive", "alternatives": ["x", "x"]}):
        with pytest.raises(dd.errors.InputError, match="another wall of this name has the same mechanism"):
            dd.Population(walls, p_occ=[0.4, 0.4], **changes)


def test_populations_together(people):
    """Parts, groups and sums keep what excludes what."""
    again = people.group("low") + people.group("high")
    assert again.occurrence == people.occurrence
    assert again.alternatives == people.alternatives
    assert again.alternative_numbers.tolist() == people.alternative_numbers.tolist()


def test_connection(few):
    """A mechanism whose probability depends on the connection of the wall, which is known, unknown, or sampled."""
    chance = {"poor": 0.8, "fair": 0.35, "good": 0.05}
    survey = [("a", "poor"), ("b", "good"), ("c", "fair")]
    walls = [kind(2.4, 0.25, name=name) for name, _ in survey for kind in (dd.OneSidedWall, dd.TwoBlockWall)]
    p_occ = [p for _, connection in survey for p in (chance[connection], 1.0 - chance[connection])]
    known = dd.typology(dd.Population(walls, p_occ=p_occ, occurrence="exclusive"), few, LEVELS, progress=False)
    # Nobody knows the connection: the mean of the three, which is exact for mechanisms that exclude each other
    mean = np.mean(list(chance.values()))
    walls = walls[:2]
    unknown = dd.Population(walls, p_occ=[mean, 1.0 - mean], occurrence="exclusive")
    assert dd.typology(unknown, few, LEVELS, progress=False)["all"](0.8) == pytest.approx(known["all"](0.8), abs=1e-14)

    def overturns(sample):
        return np.array(list(chance.values()))[sample["connection"].astype(int)]

    sampled = dd.Population.sample(
        {"one_sided": {"p_occ": overturns}, "two_block": {"p_occ": lambda sample: 1.0 - overturns(sample)}},
        n_walls=60,
        seed=1,
        variables={"connection": dd.distributions.Choice((0, 1, 2), (0.5, 0.3, 0.2))},
        occurrence="exclusive",
        height=2.4,
        thickness=0.25,
    )
    assert sampled.occurrence == ("exclusive",) * 120
    assert sampled.p_occ[::2].mean() == pytest.approx(0.5 * 0.8 + 0.3 * 0.35 + 0.2 * 0.05)


def test_all_sets_of_a_wall_are_alternatives(few):
    """Independent mechanisms as alternatives, one for each set of those that occur: the same to rounding."""
    kinds = [dd.OneSidedWall(2.0, 0.25), dd.TwoBlockWall(2.6, 0.25), dd.FreeStandingWall(1.8, 0.3)]
    chances = [0.3, 0.6, 0.45]
    rows, p_occ, names = [], [], []
    for occurs in itertools.product([True, False], repeat=3):
        share = np.prod([p if there else 1.0 - p for p, there in zip(chances, occurs, strict=True)])
        chosen = [kind for kind, there in zip(kinds, occurs, strict=True) if there]
        rows += [dataclasses.replace(kind, name="a") for kind in chosen]
        p_occ += [share] * len(chosen)
        names += ["".join("01"[there] for there in occurs)] * len(chosen)
    sets = dd.Population(rows, p_occ=p_occ, occurrence="exclusive", alternatives=names)
    plain = dd.Population([dataclasses.replace(kind, name="a") for kind in kinds], p_occ=chances)
    one, two = (dd.typology(walls, few, LEVELS, polarity="both", progress=False) for walls in (plain, sets))
    assert np.allclose(one["all"].mean_fraction, two["all"].mean_fraction, rtol=0, atol=1e-14)
    mine, theirs = one.unions["a"], two.unions["a"]
    assert np.allclose(mine.collapses, theirs.collapses, rtol=0, atol=1e-11)
    for name in ("theta", "beta", "se_ln_theta", "se_beta"):
        assert getattr(theirs, name) == pytest.approx(getattr(mine, name), rel=1e-9)
    hazard = dd.HazardCurve.power_law(1e-3, 2.5)
    assert two["all"].risk(hazard).probability(475) == pytest.approx(one["all"].risk(hazard).probability(475), rel=1e-9)
