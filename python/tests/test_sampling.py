"""Sampled populations: distributions, the Latin hypercube, correlation, and what is refused."""

import math

import numpy as np
import pytest
from costs import growth
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy import stats

import dondolo as dd

HEIGHT = dd.distributions.Lognormal(3.2, 0.15, low=2.4, high=4.5)
BRICKS = dd.distributions.Choice((0.25, 0.38, 0.51), (0.2, 0.5, 0.3))


def sample(n=200, seed=1, **changes):
    """Walls with two mechanisms."""
    arguments = {
        "mechanisms": {
            "one_sided": {"p_occ": 0.6},
            "two_block": {
                "p_occ": 0.4,
                "hinge": dd.distributions.Triangular(0.5, 0.6, 0.75),
                "overburden": dd.distributions.Uniform(0.0, 9e3),
                "overburden_inertia": 0.0,
            },
        },
        "height": HEIGHT,
        "thickness": BRICKS,
        "density": dd.distributions.Normal(1800.0, 100.0),
        "group": "facades",
    }
    return dd.Population.sample(n_walls=n, seed=seed, **{**arguments, **changes})


def column(population, what, mechanism="one_sided"):
    """A property of all walls of a mechanism."""
    return np.array([getattr(wall, what) for wall in population if wall.mechanism == mechanism])


def cut(distribution, low, high):
    """Distribution function of what lies between two ends."""

    def probability(x):
        below, above = distribution.cdf(low), distribution.cdf(high)
        return (distribution.cdf(x) - below) / (above - below)

    return probability


# Distributions and, written down independently, their distribution functions
DISTRIBUTIONS = [
    (dd.distributions.Uniform(2.0, 5.0), lambda x: (x - 2.0) / 3.0),
    (
        dd.distributions.Triangular(1.0, 2.0, 4.0),
        lambda x: np.where(x < 2.0, (x - 1.0) ** 2 / 3.0, 1.0 - (4.0 - x) ** 2 / 6.0),
    ),
    (dd.distributions.Triangular(1.0, 1.0, 4.0), lambda x: 1.0 - (4.0 - x) ** 2 / 9.0),
    (dd.distributions.Normal(3.0, 0.5), stats.norm(3.0, 0.5).cdf),
    (dd.distributions.Normal(3.0, 0.5, low=2.9, high=4.5), cut(stats.norm(3.0, 0.5), 2.9, 4.5)),
    (dd.distributions.Normal(3.0, 0.5, high=2.0), cut(stats.norm(3.0, 0.5), -9.0, 2.0)),
    (dd.distributions.Lognormal(3.0, 0.2), lambda x: stats.norm.cdf(np.log(x / 3.0) / 0.2)),
    (dd.distributions.Lognormal(3.0, 0.2, low=2.8), cut(stats.lognorm(0.2, scale=3.0), 2.8, 99.0)),
    (dd.distributions.Lognormal(3.0, 0.2, low=2.8, high=3.1), cut(stats.lognorm(0.2, scale=3.0), 2.8, 3.1)),
]


@pytest.mark.parametrize(("distribution", "function"), DISTRIBUTIONS, ids=[repr(one) for one, _ in DISTRIBUTIONS])
def test_quantiles(distribution, function):
    """Also where a distribution is cut off: no samples gather at the ends."""
    p = np.linspace(0.0005, 0.9995, 1000)
    assert function(distribution.ppf(p)) == pytest.approx(p, abs=1e-11)


def test_choice():
    p = np.array([1e-9, 0.2, 0.2000001, 0.7, 0.7000001, 1.0])
    assert BRICKS.ppf(p).tolist() == [0.25, 0.25, 0.38, 0.38, 0.51, 0.51]
    assert dd.distributions.Choice((1.0, 2.0), (0.0, 1.0)).ppf(np.array([1e-300, 1.0])).tolist() == [2.0, 2.0]
    assert dd.distributions.Choice([1, 2, 4]).probabilities == pytest.approx((1 / 3,) * 3)
    assert dd.distributions.Choice((5.0,)).ppf(p).tolist() == [5.0] * 6


@pytest.mark.parametrize(
    "distribution",
    [
        dd.distributions.Uniform(1.0, 3.0),
        dd.distributions.Triangular(1.0, 2.0, 3.0),
        dd.distributions.Normal(2.0, 0.5, low=1.0, high=3.0),
        dd.distributions.Lognormal(2.0, 0.2),
        dd.distributions.Choice((1.0, 2.0, 3.0)),
    ],
    ids=lambda one: type(one).__name__,
)
def test_quantiles_of_anything_like_an_array(distribution):
    """Of a number, a list and a table in its shape; what is no probability has no quantile."""
    p = np.array([[0.1, 0.5], [0.9, 0.2]])
    table = distribution.ppf(p)
    assert table.shape == p.shape
    assert np.array_equal(distribution.ppf(p.tolist()), table)
    assert np.array_equal(distribution.ppf(tuple(p[0])), table[0])
    assert np.ndim(distribution.ppf(0.5)) == 0
    assert distribution.ppf(0.5) == table[0, 1]
    assert np.isnan(distribution.ppf([-0.1, 1.1, np.nan])).all()


class Stuck:
    """An object of one's own that has quantiles, of whatever shape."""

    def __init__(self, answer):
        self.answer = answer

    def ppf(self, q):
        return self.answer if self.answer is not None else 2.0 + q


def test_anything_with_quantiles_is_a_distribution():
    mine = dd.Population.sample("one_sided", 20, 1, height=dd.distributions.Normal(3.0, 0.2), thickness=0.3)
    scipys = dd.Population.sample("one_sided", 20, 1, height=stats.norm(3.0, 0.2), thickness=0.3)
    assert [wall.height for wall in scipys.walls] == pytest.approx([wall.height for wall in mine.walls], rel=1e-14)
    assert "height = norm(3.0, 0.2)" in scipys.origin[0]
    own = dd.Population.sample("one_sided", 20, 1, height=Stuck(None), thickness=0.3)
    assert all(2.0 < wall.height < 3.0 for wall in own.walls)
    for wrong in (1.0, np.full(20, np.nan), np.ones(19)):
        with pytest.raises(dd.errors.InputError, match="height: its ppf must return 20 finite numbers"):
            dd.Population.sample("one_sided", 20, 1, height=Stuck(wrong), thickness=0.3)


@pytest.mark.parametrize(
    ("make", "sentence"),
    [
        (lambda: dd.distributions.Uniform(2.0, 2.0), "high = 2: must be greater than low = 2"),
        (lambda: dd.distributions.Uniform("2", 3.0), "low = '2': must be a number"),
        (lambda: dd.distributions.Uniform(2.0, math.inf), "high = inf: must be finite"),
        (lambda: dd.distributions.Triangular(1.0, 5.0, 4.0), "mode = 5: must lie between 1 and 4"),
        (lambda: dd.distributions.Normal(1.0, 0.0), "sd = 0: must be positive"),
        (lambda: dd.distributions.Normal(1.0, 1.0, low=2.0, high=1.0), "high = 1: must be greater than low = 2"),
        (
            lambda: dd.distributions.Normal(1.0, 0.1, low=2.0),
            "low, high: leave 0 of the distribution between them, must leave 1e-06 at least",
        ),
        (
            lambda: dd.distributions.Lognormal(1.0, 0.1, high=0.5),
            "low, high: leave 2.08e-12 of the distribution between them, must leave 1e-06 at least",
        ),
        (lambda: dd.distributions.Lognormal(-1.0, 0.2), "theta = -1: must be positive"),
        (lambda: dd.distributions.Lognormal(1.0, -0.2), "beta = -0.2: must be positive"),
        (lambda: dd.distributions.Lognormal(1.0, 0.2, low=0.0), "low = 0: must be positive"),
        (lambda: dd.distributions.Choice((1.0, 2.0), (0.5,)), "2 values, 1 probabilities: must be as many"),
        (
            lambda: dd.distributions.Choice((1.0, 2.0), (0.5, 0.6)),
            "probabilities: must not be negative and have the sum 1, not 1.1",
        ),
        (
            lambda: dd.distributions.Choice((1.0, 2.0), (1.5, -0.5)),
            "probabilities: must not be negative and have the sum 1, not 1",
        ),
        (lambda: dd.distributions.Choice((2.0, 1.0)), "values: must rise from one to the next"),
        (lambda: dd.distributions.Choice(()), "values: must be given"),
        (lambda: dd.distributions.Choice((1, 2), 0.5), "2 values, 1 probabilities: must be as many"),
        (lambda: dd.distributions.Choice((1, 2), ()), "probabilities: must be given"),
    ],
)
def test_wrong_distributions(make, sentence):
    with pytest.raises(dd.errors.InputError) as caught:
        make()
    assert str(caught.value) == sentence


def test_walls_and_their_mechanisms():
    people = sample(n=50, weight=7.0)
    assert len(people) == 100
    assert [wall.name for wall in people[:4]] == ["facades 0001", "facades 0001", "facades 0002", "facades 0002"]
    assert [wall.mechanism for wall in people[:4]] == ["one_sided", "two_block", "one_sided", "two_block"]
    assert people.p_occ[:4].tolist() == [0.6, 0.4, 0.6, 0.4]
    assert set(people.group_names) == {"facades"}
    assert (people.weights == 7.0).all()
    for what in ("height", "thickness", "density"):
        assert np.array_equal(column(people, what), column(people, what, "two_block"))
    hinge = column(people, "hinge", "two_block")
    assert ((hinge > 0.5) & (hinge < 0.75)).all()
    assert len(set(hinge)) == 50
    alone = dd.Population.sample("two_block", 12345, 3, height=3.0, thickness=0.25, gravity=9.80665, name="strip")
    assert (alone[0].name, alone[-1].name, alone[0].gravity) == ("strip 00001", "strip 12345", 9.80665)
    assert alone.group_names[0] == ""
    both = dd.Population.sample(["free_standing", "one_sided"], 1, 3, height=3.0, thickness=0.5)
    assert [wall.mechanism for wall in both] == ["free_standing", "one_sided"]


def test_the_same_seed_gives_the_same_walls():
    correlation = {("height", "thickness"): 0.5}
    one, same, other = (sample(seed=seed, correlation=correlation) for seed in (1, 1, 2))
    assert one.walls == same.walls
    assert one.origin == same.origin
    assert one.walls != other.walls


@pytest.mark.parametrize("correlation", [{}, {("height", "thickness"): 0.5, ("two_block.hinge", "height"): -0.7}])
@pytest.mark.parametrize("n", [7, 100, 1000])
def test_every_margin_is_stratified(correlation, n):
    """One sample in each of n parts of equal probability, whatever the correlation."""
    people = sample(n=n, correlation=correlation)
    parts = {
        "height": cut(stats.norm(math.log(3.2), 0.15), math.log(2.4), math.log(4.5))(np.log(column(people, "height"))),
        "density": stats.norm(1800.0, 100.0).cdf(column(people, "density")),
        "overburden": column(people, "overburden", "two_block") / 9e3,
    }
    for probability in parts.values():
        assert sorted(np.floor(probability * n).astype(int)) == list(range(n))
    counts = np.array([np.isclose(column(people, "thickness"), value).sum() for value in BRICKS.values])
    assert np.abs(counts - n * np.array(BRICKS.probabilities)).max() <= 1.0


def test_correlation():
    """Of the normal scores: the logarithm of a lognormal height is one, the density another."""
    wanted = {("height", "density"): 0.6, ("height", "two_block.overburden"): -0.4}
    people = sample(n=2000, correlation=wanted, height=dd.distributions.Lognormal(3.2, 0.15))
    scores = np.array(
        [
            np.log(column(people, "height")),
            column(people, "density"),
            stats.norm.ppf(column(people, "overburden", "two_block") / 9e3),
            column(people, "hinge", "two_block"),
        ]
    )
    expected = np.eye(4)
    expected[0, 1] = expected[1, 0] = 0.6
    expected[0, 2] = expected[2, 0] = -0.4
    # By chance 0.02, one over the root of n
    assert np.corrcoef(scores) == pytest.approx(expected, abs=3e-3)
    rank = stats.spearmanr(scores[0], scores[1]).statistic
    assert rank == pytest.approx(6.0 / math.pi * math.asin(0.3), abs=0.02)


def scores_of(people):
    """Normal scores of the ranks of what `sample` samples, thickness left out."""
    columns = [column(people, what) for what in ("height", "density")]
    columns += [column(people, what, "two_block") for what in ("hinge", "overburden")]
    return stats.norm.ppf(stats.rankdata(columns, axis=1) / (len(columns[0]) + 1.0))


@pytest.mark.parametrize(("n", "off"), [(30, 0.1), (100, 0.03), (1000, 3e-3)])
@pytest.mark.parametrize("correlation", [{}, {("height", "density"): 0.6}])
@pytest.mark.parametrize("seed", [1, 2, 3])
def test_pairs_that_are_not_named_have_no_correlation(correlation, n, off, seed):
    """By chance it would be one over the root of n, and twice that in the worst of the pairs."""
    expected = np.eye(4)
    expected[0, 1] = expected[1, 0] = 0.6 if correlation else 0.0
    found = np.corrcoef(scores_of(sample(n=n, seed=seed, correlation=correlation)))
    assert np.abs(found - expected).max() < off


@pytest.mark.parametrize("seed", range(20))
def test_few_walls(seed):
    """What three numbers can have is -1, -1/2, 1/2 and 1; the draws that give no choice are drawn again."""
    few = {"height": dd.distributions.Normal(3.0, 0.1), "thickness": dd.distributions.Normal(0.3, 0.01)}
    people = dd.Population.sample("one_sided", 3, seed, **few, correlation={("height", "thickness"): 0.4})
    ranks = stats.rankdata([column(people, what) for what in few], axis=1)
    assert np.corrcoef(ranks)[0, 1] == pytest.approx(0.5)
    for n in (1, 2):
        assert len(dd.Population.sample("one_sided", n, seed, **few)) == n


@pytest.mark.slow
@settings(deadline=None)
@given(rho=st.floats(-0.99, 0.99), n=st.integers(100, 500), seed=st.integers(0, 1000))
def test_any_correlation(rho, n, seed):
    """The error falls with the number of walls: its standard deviation over seeds is 1.4 / n at most."""
    people = dd.Population.sample(
        "one_sided",
        n,
        seed,
        height=dd.distributions.Normal(3.0, 0.1),
        thickness=dd.distributions.Normal(0.3, 0.01),
        correlation={("thickness", "height"): rho},
    )
    found = stats.pearsonr(column(people, "height"), column(people, "thickness")).statistic
    assert found == pytest.approx(rho, abs=10.0 / n)


def test_functions():
    """Of variables and of each other, in their order; numbers for all walls are welcome."""
    people = dd.Population.sample(
        {"one_sided": {"height": lambda s: s["storeys"] * s["storey"]}, "two_block": {"height": lambda s: s["storey"]}},
        40,
        5,
        variables={
            "storeys": dd.distributions.Choice((2, 3)),
            "storey": dd.distributions.Uniform(2.8, 3.6),
            "tied": dd.distributions.Choice((0, 1)),
        },
        correlation={("storeys", "thickness"): 0.5},
        thickness=BRICKS,
        density=lambda s: 1900.0,
        weight=lambda s: 3.0 + s["storeys"],
        p_occ=lambda s: np.where(s["tied"] == 1, 0.2, s["density"] / 2000.0),
    )
    ratio = column(people, "height") / column(people, "height", "two_block")
    assert set(ratio.round(9)) == {2.0, 3.0}
    assert people.weights[::2] == pytest.approx(3.0 + ratio)
    assert set(people.p_occ) == {0.2, 0.95}
    assert (column(people, "density") == 1900.0).all()


def test_functions_do_not_change_what_they_get():
    def a_tenth(samples):
        samples["height"] *= 0.1
        return samples["height"]

    for height in (3.0, dd.distributions.Uniform(2.0, 3.0), lambda samples: 3.0):
        with pytest.raises(ValueError, match="read-only"):
            dd.Population.sample("one_sided", 4, 1, height=height, thickness=a_tenth)


def test_origin(tmp_path):
    def half_brick(samples):
        return np.full(20, 0.12)

    people = dd.Population.sample(
        {"two_block": {"hinge": dd.distributions.Uniform(0.5, 0.6)}},
        20,
        9,
        variables={"storey": dd.distributions.Uniform(2.0, 3.0)},
        correlation={("storey", "density"): 0.25},
        height=2.5,
        thickness=half_brick,
        density=dd.distributions.Normal(1800.0, 50.0),
        weight=lambda samples: samples["density"],
        restitution="impulse",
    )
    text = " ".join(people.origin)
    for word in (
        "wall: 20 walls, a Latin hypercube of the seed 9",
        "storey = Uniform(low=2.0, high=3.0)",
        "height = 2.5",
        "thickness computed by half_brick",
        "density = Normal(mean=1800.0, sd=50.0, low=None, high=None)",
        "weight computed; restitution = 'impulse'",
        "two_block.hinge = Uniform(low=0.5, high=0.6)",
        "correlation of storey and density = 0.25",
    ):
        assert word in text
    assert max(map(len, people.origin)) <= 110
    people.to_csv(tmp_path / "walls.csv")
    assert (tmp_path / "walls.csv").read_text().startswith("# wall: 20 walls")
    assert dd.Population.from_csv(tmp_path / "walls.csv").walls == people.walls


@pytest.mark.parametrize(
    ("changes", "sentence"),
    [
        ({"mechanisms": "sliding"}, "mechanism = 'sliding': must be one of 'one_sided', 'free_standing', 'two_block'"),
        ({"mechanisms": []}, "mechanisms: must be given"),
        ({"mechanisms": None}, "mechanisms = None: must be names of mechanisms"),
        ({"mechanisms": [["one_sided"]]}, "mechanism = ['one_sided']: must be one of 'one_sided', "),
        ({"mechanisms": ["one_sided", "one_sided"]}, "mechanisms: 'one_sided' is given twice"),
        ({"mechanisms": {"one_sided": None}}, "one_sided = None: must be a mapping, properties by their names"),
        ({"n": 0}, "n_walls = 0: must be an integer, at least 1"),
        ({"n": 1.5}, "n_walls = 1.5: must be an integer, at least 1"),
        ({"seed": -1}, "seed = -1: must be an integer, at least 0"),
        ({"hinge": 0.6}, "hinge: one_sided walls have none; give it to the mechanism that has it"),
        ({"mechanisms": {"one_sided": {"weight": 2.0}}}, "weight: belongs to the wall, not to one of its mechanisms"),
        ({"height": "tall"}, "height = 'tall': must be a number"),
        ({"height": None}, "height = None: must be a number"),
        ({"restitution": 0.9}, "restitution = 0.9: must be a string"),
        ({"variables": {"height": HEIGHT}}, "variables: 'height' is a property of the walls, to be given as one"),
        ({"variables": {"storeys": 2}}, "storeys = 2: must be a distribution"),
        ({"variables": {2: HEIGHT}}, "variables = 2: must be a string"),
        ({"variables": [1]}, "variables = [1]: must be a mapping, distributions by their names"),
        ({"variables": 3}, "variables = 3: must be a mapping, distributions by their names"),
        ({"height": lambda s: s["storeys"] * 3.0}, "height: its function asks for 'storeys'; known before it are: 'th"),
        ({"thickness": lambda s: np.ones(3)}, "thickness: its function must return 200 numbers or one"),
        ({"thickness": lambda s: "thick"}, "thickness: its function must return 200 numbers or one"),
        ({"density": dd.distributions.Uniform(-2.0, -1.0)}, "must be positive"),
        ({"name": "a\nb"}, r"name = 'a\nb': must be one line"),
        ({"group": "a\nb"}, r"group = 'a\nb': must be one line"),
        ({"name": 3}, "name = 3: must be a string"),
        ({"group": 3}, "group = 3: must be a string"),
        ({"p_occ": dd.distributions.Uniform(1.5, 2.0), "mechanisms": "one_sided"}, "wall 'facades 0001': p_occ = "),
        ({"weight": dd.distributions.Uniform(-2.0, -1.0)}, "wall 'facades 0001': weight = -"),
        ({"correlation": {("height", "colour"): 0.5}}, "correlation: 'colour' is not sampled; these are: 'height', "),
        ({"correlation": {("height", "height"): 0.5}}, "correlation: ('height', 'height'): must be two names"),
        ({"correlation": {"height": 0.5}}, "correlation: 'height': must be two names"),
        ({"correlation": {3: 0.5}}, "correlation: 3: must be two names"),
        ({"correlation": [0.5]}, "correlation = [0.5]: must be a mapping, numbers by pairs of names"),
        ({"correlation": {("height", "density"): 1.0}}, "correlation of height and density = 1: must lie between -1"),
        ({"correlation": {("height", "density"): "0.5"}}, "correlation = '0.5': must be a number"),
        (
            {"correlation": {("height", "density"): 0.5, ("density", "height"): 0.5}},
            "correlation of height and density: is given twice",
        ),
        (
            {
                "correlation": {
                    ("height", "density"): 0.9,
                    ("density", "thickness"): 0.9,
                    ("height", "thickness"): -0.9,
                }
            },
            "correlation: no quantities can be correlated like this: the smallest eigenvalue of the matrix is -0.8",
        ),
        *(
            (
                {"n": n, "correlation": {("height", "density"): 0.5}},
                f"n_walls = {n}: must be at least 6 for correlations, more than are sampled: height, thickness, "
                f"density, "
                "two_block.hinge, two_block.overburden",
            )
            for n in (1, 2, 5)
        ),
    ],
)
def test_errors(changes, sentence):
    with pytest.raises(dd.errors.InputError) as caught:
        sample(**changes)
    assert sentence in str(caught.value)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    ("own", "sentence"),
    [
        (
            {"eccentricity": dd.distributions.Uniform(0.2, 0.3)},
            r"wall 'facades \d+': eccentricity = 0.2\d*: must lie between -0.125",
        ),
        (
            {"hinge": dd.distributions.Uniform(0.9, 1.1)},
            r"wall 'facades \d+': hinge = [01].\d*: must lie between 0.01 and 0.99",
        ),
        (
            {"restitution_value": dd.distributions.Uniform(0.9, 1.1)},
            r"wall 'facades \d+': restitution_value = 1.0\d*: must be",
        ),
        (
            {"restitution_factor": dd.distributions.Uniform(1.0, 2.0)},
            r"wall 'facades \d+': restitution_factor = 1.*restitution e",
        ),
    ],
)
def test_samples_that_no_wall_can_have(own, sentence):
    with pytest.raises(dd.errors.InputError, match=sentence):
        sample(mechanisms={"two_block": own}, thickness=0.25)


def test_a_bearing_follows_the_thickness():
    own = {"overburden": 5000.0, "overburden_inertia": 0.0, "bearing": "inner", "bearing_distance": 0.06}
    walls = sample(mechanisms={"two_block": own}, thickness=dd.distributions.Uniform(0.25, 0.5))
    assert [wall.eccentricity for wall in walls] == pytest.approx([0.06 - 0.5 * wall.thickness for wall in walls])
    with pytest.raises(dd.errors.InputError, match="bearing: one_sided walls have none"):
        sample(mechanisms=("one_sided", "two_block"), bearing="centre")


def test_a_misspelt_property():
    with pytest.raises(
        dd.errors.InputError, match="'thicknes': no such property of walls; there are height, thickness, "
    ):
        sample(thicknes=0.3)


@pytest.mark.slow
def test_many_walls():
    """Eight times as many cost about eight times as much, and not 64 times."""
    correlation = {("height", "thickness"): 0.5}
    assert growth(lambda n: sample(n=n, correlation=correlation), 1500, 12_000) < 24.0


def test_historic_centre(root, tmp_path):
    """The table is what its script makes, to the byte."""
    import runpy

    script = runpy.run_path(str(root / "data/walls/historic_centre.py"))
    script["centre"]().to_csv(tmp_path / "historic_centre.csv")
    there = (root / "data/walls/historic_centre.csv").read_bytes()
    assert (tmp_path / "historic_centre.csv").read_bytes() == there
    assert b"ILLUSTRATIVE" in there.splitlines()[0]


def test_what_the_historic_centre_is_made_of(root):
    people = dd.read_case(root / "data/cases/historic_centre.nml").population
    walls = len({wall.name for wall in people})
    assert 200 <= walls <= 300
    assert set(people.group_names) == {"row houses", "town houses", "palaces", "gables", "parapets"}
    assert set(column(people, "thickness")) == {0.12, 0.25, 0.38, 0.51}
    storeys = column(people, "height", "two_block")
    assert ((storeys >= 2.8) & (storeys <= 4.5)).all()
    factor = column(people, "restitution_factor", "two_block")
    assert ((factor >= 0.84) & (factor <= 0.9)).all()
    facades = [(one, two) for one, two in zip(people.walls, people.walls[1:], strict=False) if one.name == two.name]
    assert len(facades) == 180
    for one, two in facades:
        assert one.height / two.height == pytest.approx(round(one.height / two.height), abs=1e-2)
        assert 2 <= round(one.height / two.height) <= 4
        assert one.trigger_acceleration < 0.5 * two.trigger_acceleration
    parapets = people.group("parapets")
    assert all(wall.height <= 1.5 for wall in parapets)
    assert {wall.thickness for wall in parapets} == {0.12, 0.25}
    assert all(wall.thickness > 0.2 for wall in people if wall.name.split()[0] != "parapets")


def test_the_historic_centre_is_sensible(root, few):
    """Facades that overturn as a whole are more vulnerable than strips that fold."""
    import warnings

    people = dd.Population.from_csv(root / "data/walls/historic_centre.csv").group("row houses")
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", dd.errors.DondoloWarning)
        both = dd.typology(people, few, [0.3, 0.6, 0.9, 1.2, 1.6, 2.0], progress=False)
    assert both["one_sided"].fit.theta < 0.6 * both["two_block"].fit.theta
