"""Risk: hazard curves, the mean annual frequency of collapse, its bounds and its deaggregation."""

import functools
import itertools
import warnings
from dataclasses import replace

import matplotlib

matplotlib.use("agg")

import matplotlib.pyplot as plt
import numpy as np
import pytest
from refusals import refused
from scipy import integrate, stats

import dondolo as dd
from dondolo.curves.risk_of_walls import WallFrequencies
from dondolo.hazard import integrals as integrals_module

LEVELS = [0.02, 0.05, 0.1, 0.2, 0.4, 0.8, 1.6, 3.2, 6.4]
FREQUENCY = [0.1, 0.03, 0.01, 2.5e-3, 4e-4, 5e-5, 4e-6, 2e-7, 5e-9]


def lognormal(theta, beta, im="pga"):
    """A fitted curve of these parameters: two stripes at 25 and 75 % have it in closed form."""
    step = beta * stats.norm.ppf(0.75)
    curve = dd.fit_fragility([theta * np.exp(-step), theta * np.exp(step)], [250, 750], 1000, im=im)
    assert (curve.theta, curve.beta) == pytest.approx((theta, beta), rel=1e-9)
    return curve


@pytest.fixture(scope="module")
def hazard():
    return dd.HazardCurve(LEVELS, FREQUENCY)


@pytest.fixture(scope="module")
def curve():
    return lognormal(0.6, 0.4)


def trapezoid(probability, hazard, points):
    """The integral by the trapezoidal rule in H itself, step by step of the curve."""
    total = 0.0
    for low, high in zip(hazard.levels[:-1], hazard.levels[1:], strict=True):
        x = np.geomspace(low, high, points)
        total += integrate.trapezoid(probability(x), -hazard(np.clip(x, low, high)))
    return total


def test_curve_is_straight_on_logarithmic_axes(hazard):
    np.testing.assert_allclose(hazard(LEVELS), FREQUENCY, rtol=1e-14)
    middle = np.sqrt(np.array(LEVELS[:-1]) * LEVELS[1:])
    np.testing.assert_allclose(hazard(middle), np.sqrt(np.array(FREQUENCY[:-1]) * FREQUENCY[1:]), rtol=1e-12)
    assert np.isnan(hazard([0.0, 0.019, 6.5])).all()
    assert isinstance(hazard(0.3), float)
    assert hazard(np.full((2, 3), 0.3)).shape == (2, 3)
    assert not hazard.levels.flags.writeable


def test_a_level_step_has_no_sign(curve):
    hazard = dd.HazardCurve([0.1, 0.2, 0.4, 0.8], [1e-2, 1e-3, 1e-3, 1e-4])
    with pytest.warns(dd.errors.DondoloWarning, match="too short"):
        risk = curve.risk(hazard)
    density = risk.density([0.25, 0.3])
    assert density.tolist() == [0.0, 0.0]
    assert not np.signbit(density).any()


def test_power_law():
    hazard = dd.HazardCurve.power_law(3e-4, 2.2, im="pgv")
    x = np.array([1e-6, 0.1, 1.0, 30.0, 1e5])
    np.testing.assert_allclose(hazard(x), 3e-4 * x**-2.2, rtol=1e-12)
    assert hazard.endless
    assert hazard.im == "pgv"
    for k0, k in ((0.0, 2.0), (1e-4, -1.0), (np.nan, 2.0)):
        with pytest.raises(dd.errors.InputError, match="must be positive"):
            dd.HazardCurve.power_law(k0, k)


@pytest.mark.parametrize("theta", [1e-3, 0.6, 500.0])
@pytest.mark.parametrize("beta", [0.01, 0.35, 1.2])
@pytest.mark.parametrize("k", [0.3, 2.5, 4.0])
def test_closed_form(theta, beta, k):
    """Cornell (1996)."""
    risk = lognormal(theta, beta).risk(dd.HazardCurve.power_law(1e-4, k))
    exact = 1e-4 * theta**-k * np.exp(0.5 * k**2 * beta**2)
    assert risk.annual_frequency == pytest.approx(exact, rel=1e-11)
    assert risk.error == 0.0
    assert risk.bounds == (risk.annual_frequency, risk.annual_frequency)
    # The same curve as a function, which is integrated by Gauss's rule
    curve = lognormal(theta, beta)
    risk = dd.FunctionFragility(lambda x: curve(x)).risk(dd.HazardCurve.power_law(1e-4, k))
    assert risk.annual_frequency == pytest.approx(exact, rel=1e-7)
    assert risk.error < 1e-7 * exact


def test_trapezoids_converge_to_it(hazard, curve):
    risk = curve.risk(hazard)
    off = [abs(trapezoid(curve, hazard, points) - risk.inside) for points in (101, 201, 401)]
    # Their error falls fourfold with each halving, to what is left of a right value.
    assert off[0] / off[1] == pytest.approx(4.0, rel=0.02)
    assert off[1] / off[2] == pytest.approx(4.0, rel=0.02)
    assert off[2] < 1e-4 * risk.inside
    gauss = dd.FunctionFragility(lambda x: curve(x)).risk(hazard)
    assert abs(gauss.inside - risk.inside) < 1e-8 * risk.inside
    assert gauss.error < 1e-8 * risk.inside


def test_the_same_in_closed_form_step_by_step(hazard, curve):
    """Between levels: integral of Phi k H d(ln x), by completing the square."""
    u, h = np.log(LEVELS), np.array(FREQUENCY)
    k = -np.diff(np.log(h)) / np.diff(u)
    mean, beta, total = np.log(curve.theta), curve.beta, 0.0
    for i in range(len(k)):
        ends = u[i : i + 2]
        shifted = stats.norm.cdf((ends - mean) / beta + k[i] * beta)
        part = np.exp(-k[i] * (mean - u[i]) + 0.5 * (k[i] * beta) ** 2) * np.diff(shifted)[0]
        total += h[i] * part - np.diff(h[i : i + 2] * stats.norm.cdf((ends - mean) / beta))[0]
    for fragility in (curve, dd.FunctionFragility(lambda x: curve(x))):
        assert fragility.risk(hazard).inside == pytest.approx(total, rel=1e-9)


@pytest.mark.parametrize(("theta", "beta"), [(0.6, 0.4), (0.05, 0.9), (20.0, 0.3), (0.6, 0.01), (0.6, 3.0)])
def test_closed_form_keeps_its_digits_in_the_tails(hazard, theta, beta):
    """Bin by bin from far below the median to far above it, against Gauss's rule with 40 points in each."""
    curve = replace(lognormal(theta, beta), upper_asymptote=0.7)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", dd.errors.DondoloWarning)
        risk = curve.risk(hazard)
    edges = np.unique(np.append(np.geomspace(LEVELS[0], LEVELS[-1], 401), LEVELS))
    node, weight = np.polynomial.legendre.leggauss(40)
    u = np.log(edges)
    half = 0.5 * np.diff(u)[:, None]
    points = (u[:-1, None] + half) + half * node
    exact = (risk.density(np.exp(points)) * half) @ weight
    seen = exact > 1e-200
    assert seen.sum() > 100
    np.testing.assert_allclose(risk.deaggregate(edges)[seen], exact[seen], rtol=1e-9, atol=1e-14 * exact.max())
    assert risk.inside == pytest.approx(exact.sum(), rel=1e-11)
    assert np.all(risk.deaggregate(edges) >= 0.0)


@pytest.mark.filterwarnings("ignore::dondolo.errors.DondoloWarning")
@pytest.mark.parametrize(
    "beta", [*(10.0**-n for n in (0, 1, 2, 3, 4, 6, 7, 8, 9, 10, 12, 16, 50, 154, 200, 300)), 5e-324]
)
def test_small_dispersions(beta):
    """The step between two levels by its own closed form, whose limit is H(theta)."""
    low, high, theta, k = 0.1, 0.2, 0.15, np.log2(10.0)
    curve = dd.Fragility.of_parameters(theta, beta, im="pga")
    risk = curve.risk(dd.HazardCurve([low, high], [1e-2, 1e-3]))
    with np.errstate(over="ignore"):
        ends = np.clip(np.log(np.array([low, high]) / theta) / beta, -1e150, 1e150)
    inside = 1e-2 * 1.5**-k * np.exp(0.5 * (k * beta) ** 2) * np.diff(stats.norm.cdf(ends + k * beta))[0]
    inside += 1e-2 * stats.norm.cdf(ends[0]) - 1e-3 * stats.norm.cdf(ends[1])
    assert risk.inside == pytest.approx(inside, rel=1e-12)
    assert risk.above[0] == pytest.approx(1e-3 * stats.norm.cdf(ends[1]), rel=1e-12)
    if beta <= 1e-8:
        assert sum(risk.bounds) / 2.0 == pytest.approx(1e-2 * 1.5**-k, rel=1e-12)


@pytest.mark.parametrize("beta", [1e-3, 1e-4, 1e-5, 1e-7, 1e-10, 1e-12])
@pytest.mark.parametrize("z", [-0.5, -2.0, -6.0])
def test_small_dispersions_at_the_end_of_a_step(beta, z):
    """To the second order in k beta: k H beta times the integrals of Phi, and of Phi times the distance to the end."""
    k, theta = np.log2(10.0), 0.2 * np.exp(-z * beta)
    cut = np.log(np.array([0.1, 0.2]))
    found = integrals_module.lognormal_integrals(
        np.array(theta), np.array(beta), dd.HazardCurve([0.1, 0.2], [1e-2, 1e-3]), cut
    )
    # theta has its own rounding, a part of z
    z = (cut[1] - np.log(theta)) / beta
    first, _ = integrate.quad(stats.norm.cdf, z - 30.0, z, epsabs=0.0, epsrel=1e-12)
    second, _ = integrate.quad(lambda t: stats.norm.cdf(t) * (z - t), z - 30.0, z, epsabs=0.0, epsrel=1e-12)
    exact = 1e-3 * k * beta * (first + k * beta * second)
    assert found[0] == pytest.approx(exact, rel=(k * beta) ** 2 + 1e-11, abs=0.0)


@pytest.mark.parametrize("beta", [0.4, 1.0])
@pytest.mark.parametrize("k", [15.0, 25.0, 80.0])
def test_steep_hazard(beta, k):
    """The power law of the first step overflows far below it."""
    curve = lognormal(0.6, beta)
    steep = dd.HazardCurve([0.1, 0.2, 0.4, 1.0], [0.01, *(0.01 * 2.0 ** -(k + i) for i in range(3))])
    with pytest.warns(dd.errors.DondoloWarning, match="too short"):
        risk = curve.risk(steep)
    with pytest.warns(dd.errors.DondoloWarning, match="too short"):
        gauss = dd.FunctionFragility(lambda x: curve(x)).risk(steep)
    assert gauss.inside == pytest.approx(risk.inside, rel=1e-8)
    # By parts, the bound below the lowest level is -P H there and a normal integral, here in logarithms
    z = np.log(0.1 / 0.6) / beta
    log_normal = -k * np.log(0.6 / 0.1) + 0.5 * (k * beta) ** 2 + stats.norm.logcdf(z + k * beta)
    exact = 0.01 * (np.exp(log_normal) - stats.norm.cdf(z)) if log_normal < 700.0 else np.inf
    assert risk.below[1] == pytest.approx(exact, rel=1e-9)
    assert gauss.below[1] == pytest.approx(exact, rel=1e-6) or np.isinf(gauss.below[1])
    assert np.isfinite(gauss.below[1]) or k * beta > 20.0
    if exact < np.inf:
        whole = curve.risk(dd.HazardCurve.power_law(1e-4, k))
        assert whole.annual_frequency == pytest.approx(1e-4 * np.exp(0.5 * (k * beta) ** 2) * 0.6**-k, rel=1e-10)
    with pytest.raises(dd.errors.DondoloError, match="is not finite"):
        dd.FunctionFragility(lambda x: np.minimum(x, 1.0) ** 0.5).risk(dd.HazardCurve.power_law(1e-4, k))


def test_a_function_that_is_too_rough(hazard, monkeypatch):
    monkeypatch.setattr(integrals_module, "_MOST_PANELS", 2000)
    random = np.random.default_rng(5)
    with pytest.raises(dd.errors.DondoloError, match="too rough"):
        dd.FunctionFragility(lambda x: 0.5 + 0.004 * random.random(x.shape)).risk(hazard)


def test_bounds_hold_the_truth(curve):
    """A power law of which only a part is given."""
    whole = curve.risk(dd.HazardCurve.power_law(1e-4, 2.5)).annual_frequency
    for levels in ([0.3, 0.6, 1.2], [0.3, 10.0], [0.01, 0.6], [0.6, 0.7]):
        cut = dd.HazardCurve(levels, 1e-4 * np.array(levels) ** -2.5)
        with pytest.warns(dd.errors.DondoloWarning, match="is too short: the mean annual frequency of collapse"):
            risk = curve.risk(cut)
        assert risk.bounds[0] < whole < risk.bounds[1] * (1.0 + 1e-9)
        assert risk.inside < risk.annual_frequency == risk.bounds[0]
        # Below the first level the bound is the power law itself; above the last, P is between its value there and 1.
        u = np.linspace(np.log(levels[0]) - 12.0, np.log(levels[0]), 200_001)
        below = integrate.simpson(curve(np.exp(u)) * 2.5 * 1e-4 * np.exp(-2.5 * u), x=u)
        assert risk.below == (0.0, pytest.approx(below, rel=1e-7))
        assert risk.above == pytest.approx((curve(levels[-1]) * cut(levels[-1]), cut(levels[-1])), rel=1e-12)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        curve.risk(dd.HazardCurve([0.01, 100.0], 1e-4 * np.array([0.01, 100.0]) ** -2.5))


def test_bounds_end_at_the_saturation(curve):
    """All contributions are those of the walls that can collapse, those beyond the hazard curve too."""
    hazard = dd.HazardCurve([0.3, 0.6], [4e-3, 1e-3])
    with pytest.warns(dd.errors.DondoloWarning, match="too short"):
        some, every = (replace(curve, upper_asymptote=share).risk(hazard) for share in (0.7, 1.0))
    for part in ("inside", "below", "above", "bounds"):
        assert getattr(some, part) == pytest.approx(0.7 * np.array(getattr(every, part)), rel=1e-12), part
    assert some.above[1] == pytest.approx(7e-4, rel=1e-12)


def test_a_step_is_the_hazard_itself(hazard):
    """Everything collapses above 0.33 and nothing below: the frequency is that of 0.33."""
    risk = dd.FunctionFragility(lambda x: (x > 0.33).astype(float)).risk(hazard)
    assert risk.annual_frequency == pytest.approx(hazard(0.33), rel=1e-8)
    assert abs(risk.annual_frequency - hazard(0.33)) <= max(risk.error, 1e-10 * risk.annual_frequency)


@pytest.mark.filterwarnings("ignore:the curve is a function:dondolo.errors.DondoloWarning")
def test_degenerate_curves(hazard):
    with pytest.warns(dd.errors.DondoloWarning, match="lies between 0 and 5e-09"):
        never = dd.FunctionFragility(lambda x: np.zeros_like(x)).risk(hazard)
    assert never.annual_frequency == 0.0
    assert never.return_period == np.inf
    assert never.bounds[1] == FREQUENCY[-1]
    assert never.probability(50.0) == 0.0
    with pytest.warns(dd.errors.DondoloWarning, match="too short"):
        always = dd.FunctionFragility(lambda x: np.ones_like(x)).risk(hazard)
    assert always.inside == pytest.approx(FREQUENCY[0] - FREQUENCY[-1], rel=1e-9)
    assert always.bounds == (pytest.approx(FREQUENCY[0], rel=1e-9), np.inf)
    flat = dd.HazardCurve([0.1, 0.2, 0.4], [0.01, 0.01, 0.01])
    with pytest.warns(dd.errors.DondoloWarning):
        risk = lognormal(0.2, 0.3).risk(flat)
    assert risk.inside == 0.0
    assert risk.bounds == pytest.approx((0.01 * lognormal(0.2, 0.3)(0.4), 0.01))


def test_a_frequency_that_is_not_finite():
    with pytest.raises(dd.errors.DondoloError, match="is not finite"):
        dd.FunctionFragility(lambda x: np.minimum(x, 1.0)).risk(dd.HazardCurve.power_law(1e-4, 2.5))
    risk = dd.FunctionFragility(lambda x: np.minimum(x, 1.0) ** 3).risk(dd.HazardCurve.power_law(1e-4, 2.0))
    # Integral of 2 x^3 x^-3 from 0 to 1, and 1
    assert risk.annual_frequency == pytest.approx(3e-4, rel=1e-7)


def test_time(hazard, curve):
    risk = curve.risk(hazard)
    assert risk.return_period == pytest.approx(1.0 / risk.annual_frequency)
    assert risk.probability(50.0) == pytest.approx(1.0 - np.exp(-50.0 * risk.annual_frequency), rel=1e-12)
    assert risk.probability(0.0) == 0.0
    # As many collapses as a Poisson process has
    counts = np.random.default_rng(3).poisson(risk.annual_frequency * 2000.0, 100_000)
    assert risk.probability(2000.0) == pytest.approx((counts > 0).mean(), abs=0.005)
    for wrong in (-1.0, np.nan, np.inf):
        with pytest.raises(dd.errors.InputError, match="must be finite and not negative"):
            risk.probability(wrong)


@pytest.mark.filterwarnings("ignore:the curve is a function:dondolo.errors.DondoloWarning")
def test_both_ends_are_told(curve):
    """A hazard curve that is too short: the lower end alone would look safer than it is."""
    with pytest.warns(dd.errors.DondoloWarning, match="too short"):
        risk = curve.risk(dd.HazardCurve([0.01, 0.4], [0.1, 0.005]))
    low, high = risk.bounds
    assert 0.0 < 1.1 * low < high < np.inf
    assert risk.return_period_bounds == (1.0 / high, 1.0 / low)
    assert risk.return_period == 1.0 / low
    assert risk.probability_bounds(50.0) == pytest.approx((1.0 - np.exp(-50.0 * low), 1.0 - np.exp(-50.0 * high)))
    assert risk.probability(50.0) == risk.probability_bounds(50.0)[0]
    shown = repr(risk)
    assert f"between {low:.4g} and {high:.4g} a year" in shown
    assert f"return period between {1.0 / high:.4g} and {1.0 / low:.4g} years" in shown
    assert f"probability in 50 years between {risk.probability(50.0):.4g} and {1 - np.exp(-50 * high):.4g}" in shown
    with pytest.warns(dd.errors.DondoloWarning, match="too short"):
        open_end = dd.FunctionFragility(lambda x: np.ones_like(x)).risk(dd.HazardCurve([0.1, 0.4], [0.1, 0.005]))
    assert open_end.return_period_bounds == (0.0, pytest.approx(10.0))
    assert open_end.probability_bounds(1.0) == (pytest.approx(-np.expm1(-0.1)), 1.0)
    assert open_end.probability_bounds(0.0) == (0.0, 0.0)
    assert "return period of one wall between 0 and 10 years" in repr(open_end)


@pytest.fixture(scope="module")
def people(records):
    """Walls with a mechanism that cannot occur, with two that may or may not, and without a fit."""
    walls = [
        dd.OneSidedWall(1.5, 0.25, name="a"),
        dd.OneSidedWall(1.5, 0.25, name="b"),
        dd.OneSidedWall(2.0, 0.25, name="c"),
        dd.TwoBlockWall(2.0, 0.12, hinge=0.5, name="c"),
        dd.FreeStandingWall(2.0, 0.3, name="c"),
        dd.OneSidedWall(1.5, 0.8, name="d"),
        dd.OneSidedWall(6.0, 0.5, name="e"),
        dd.TwoBlockWall(3.0, 0.6, hinge=0.5, name="e"),
    ]
    p_occ, groups = [1.0, 0.0, 0.5, 0.3, 0.2, 1.0, 0.25, 1.0], ["low"] * 6 + ["high"] * 2
    weights = [1.0, 1.0, 2.0, 2.0, 2.0, 0.5, 3.0, 3.0]
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", dd.errors.DondoloWarning)
        levels = [0.1, 0.2, 0.4, 0.6, 0.8, 1.0, 1.2, 1.6]
        population = dd.Population(walls, weights, group_names=groups, p_occ=p_occ)
        made = dd.typology(population, records[::4], levels, progress=False)
    assert {"no_collapse", "ok"} < {curve.status for curve in made.curves}
    return made


def losses(people, hazard, years, group=""):
    """Bounds of the share lost in some years: walls, and combinations of what can occur in them, one by one."""
    walls, rows = {}, people.population
    for i, wall in enumerate(rows):
        if group in ("", rows.group_names[i]):
            walls.setdefault(wall.name, []).append(i)
    weight, sums = 0.0, np.zeros(2)
    for one in walls.values():
        weight += rows.weights[one[0]]
        for occurs in itertools.product((False, True), repeat=len(one)):
            share = rows.weights[one[0]] * np.prod(np.where(occurs, rows.p_occ[one], 1.0 - rows.p_occ[one]))
            if share == 0.0 or not any(occurs):
                continue

            def probability(x, one=one, occurs=occurs):
                stands = np.ones_like(x)
                for i in itertools.compress(one, occurs):
                    curve, counts = people.curves[i], people.collapses[:, i] / people.histories[:, i]
                    stands *= 1.0 - (curve(x) if curve.has_fit else np.interp(x, people.levels, counts))
                return 1.0 - stands

            low, high = dd.FunctionFragility(probability).risk(hazard).bounds
            sums -= share * np.expm1(-years * np.array([low, high]))
    return sums / weight


@pytest.mark.parametrize("group", ["", "high"])
@pytest.mark.parametrize("endless", [False, True])
@pytest.mark.filterwarnings("ignore::dondolo.errors.DondoloWarning")
def test_time_of_a_population(people, hazard, endless, group):
    """Each wall has its own frequency, and where a mechanism may not occur, several."""
    hazard = dd.HazardCurve.power_law(2e-3, 2.5) if endless else dd.HazardCurve(LEVELS[:6], FREQUENCY[:6])
    risk = people["all", group].risk(hazard)
    for years in (1e-3, 50.0, 475.0, 1e5):
        bounds = risk.probability_bounds(years)
        np.testing.assert_allclose(bounds, losses(people, hazard, years, group), rtol=1e-6)
        # No more than if all walls were alike
        for end, frequency in zip(bounds, risk.bounds, strict=True):
            assert end <= -np.expm1(-years * frequency)
    # Walls in which nothing can occur add nothing above the levels either.
    shares, low, high = risk._walls
    np.testing.assert_allclose(risk.bounds, (shares @ low, shares @ high), rtol=1e-6)
    assert risk.probability(1e-3) == pytest.approx(1e-3 * risk.annual_frequency, rel=1e-3)
    assert "return period" not in repr(risk)
    assert f"probability in 50 years {'between ' * (not endless)}{risk.probability(50.0):.4g}" in repr(risk)


def test_any_function_is_taken_for_one_wall(people):
    """What matters is the curve, and not which function gives its values."""
    hazard, high = dd.HazardCurve.power_law(2e-3, 2.5), people["all", "high"]

    def fractile(x):
        return high.fractiles(x, 0.84)

    risks = [dd.FunctionFragility(f).risk(hazard) for f in (functools.partial(high.fractiles, q=0.84), fractile)]
    assert risks[0].bounds == risks[1].bounds
    for risk in risks:
        with pytest.warns(dd.errors.DondoloWarning, match="the curve is a function"):
            assert risk.probability(50.0) == -np.expm1(-50.0 * risk.annual_frequency)
        assert "return period of one wall" in repr(risk)


def test_the_curve_of_a_population_knows_its_walls(people):
    """A function does not, be it the mean itself or one around it: the probability is then higher, and told."""
    hazard, curve = dd.HazardCurve.power_law(2e-3, 2.5), people["all"]
    risk = curve.risk(hazard)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        share = risk.probability(475.0)
        assert f"probability in 50 years {risk.probability(50.0):.4g}" in repr(risk)
    for function in (curve, lambda x: curve(x)):
        other = dd.FunctionFragility(function).risk(hazard)
        assert other.annual_frequency == pytest.approx(risk.annual_frequency, rel=1e-9)
        assert "probability in 50 years of one wall" in repr(other)
        assert other.probability(0.0) == 0.0
        with pytest.warns(dd.errors.DondoloWarning, match="function, taken for that of one wall"):
            assert other.probability(475.0) > 1.05 * share


def test_shares_may_add_up_to_more_than_one_by_rounding():
    ends = np.full(2, 1.0)
    assert WallFrequencies(np.array([0.5, 0.5 + 2e-16]), ends, ends).probability(1e9) == (1.0, 1.0)


@pytest.mark.filterwarnings("ignore::dondolo.errors.DondoloWarning")
def test_time_ends_at_the_saturation(people, records):
    """Walls that never collapse take no part, however long the time is."""
    hazard = dd.HazardCurve.power_law(8e-3, 2.5)
    walls = [dd.OneSidedWall(1.5, 0.25, name="a"), dd.OneSidedWall(1.5, 0.25, name="b")]
    two = dd.typology(dd.Population(walls, p_occ=[1.0, 0.0]), records[::4], people.levels, progress=False)
    risk, one = (curve.risk(hazard) for curve in (two["all"], two.combined["a"]))
    assert risk.annual_frequency == pytest.approx(0.5 * one.annual_frequency, rel=1e-7)
    assert risk.probability(200.0) == pytest.approx(0.5 * one.probability(200.0), rel=1e-7)
    assert risk.probability(200.0) < 0.5 < 1.0 - np.exp(-200.0 * risk.annual_frequency)
    assert risk.probability(1e6) == pytest.approx(0.5)
    never = dd.typology(dd.Population(walls, p_occ=[0.0, 0.0]), records[::4], people.levels, progress=False)
    assert never["all"].risk(hazard).probability_bounds(50.0) == (0.0, 0.0)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert never["all"].risk(dd.HazardCurve(LEVELS, FREQUENCY)).bounds == (0.0, 0.0)
    # The fit knows the share that can collapse at all, and a mechanism alone those in which it can occur
    fit = two["all"].fit.risk(hazard)
    assert two["all"].fit.upper_asymptote == 0.5
    assert fit.probability(200.0) == pytest.approx(0.5 * one.probability(200.0), rel=0.01)
    assert fit.probability(1e6) == pytest.approx(0.5)
    alone = two["one_sided"].risk(hazard)
    assert alone.probability(200.0) == pytest.approx(one.probability(200.0), rel=1e-7)


@pytest.mark.slow
def test_deaggregation(hazard, curve):
    risk = curve.risk(hazard)
    edges = np.array([0.001, 0.1, 0.3, 0.5, 0.7, 1.0, 9.0])
    parts = risk.deaggregate(edges)
    assert parts.sum() == pytest.approx(risk.inside, rel=1e-9)
    for low, high, part in zip(edges[:-1], edges[1:], parts, strict=True):
        u = np.log(np.geomspace(max(low, LEVELS[0]), min(high, LEVELS[-1]), 400_001)[1:-1])
        assert part == pytest.approx(integrate.trapezoid(risk.density(np.exp(u)), u), rel=1e-3)
    assert risk.deaggregate([0.001, 0.01]).tolist() == [0.0]
    assert risk.deaggregate([7.0, 8.0, 9.0]).tolist() == [0.0, 0.0]
    assert risk.density(0.01) == risk.density(7.0) == 0.0
    k = np.log(FREQUENCY[4] / FREQUENCY[5]) / np.log(2.0)
    assert risk.density(0.5) == pytest.approx(curve(0.5) * k * hazard(0.5), rel=1e-12)
    whole = curve.risk(dd.HazardCurve.power_law(1e-4, 2.5))
    assert whole.deaggregate([1e-9, 1e9])[0] == pytest.approx(whole.annual_frequency, rel=1e-9)
    # Half of it comes from above the median of the lognormal that the integrand is
    assert whole.deaggregate([1e-9, 0.6 * np.exp(-2.5 * 0.4**2), 1e9])[0] < whole.annual_frequency
    for wrong, sentence in (
        ([0.1], "edges: must be at least two"),
        ([0.2, 0.1], r"edges = 0.2, 0.1: must increase strictly"),
        ([0.0, 1.0], "edges = 0: must be positive"),
        ([0.1, np.inf], "edges = inf: must be positive"),
    ):
        with pytest.raises(dd.errors.InputError, match=sentence):
            risk.deaggregate(wrong)
    with pytest.raises(dd.errors.InputError, match="x: must be positive"):
        risk.density([0.0])


def test_measures_must_agree(hazard, curve, few):
    walls = [dd.OneSidedWall(1.2, 0.25, name="a"), dd.OneSidedWall(1.8, 0.25, name="b")]
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        people = dd.typology(walls, few, [0.3, 0.6, 0.9, 1.2], progress=False)
        pgv = dd.HazardCurve(LEVELS, FREQUENCY, im="pgv")
        for fragility in (people["all"], lognormal(0.6, 0.4), people["all"].fit):
            with pytest.raises(
                dd.errors.InputError, match="im = 'pga' of the fragility and 'pgv' of the hazard: must be"
            ):
                fragility.risk(pgv)
        risk = people["all"].risk(hazard)
        assert risk.inside == pytest.approx(trapezoid(people["all"], hazard, 3001), rel=1e-5)
        assert dd.FunctionFragility(curve, im="pgv").risk(pgv).annual_frequency > 0.0


def test_refused(hazard, curve):
    nothing = dd.fit_fragility([0.2, 0.4], [0, 0], 44, im="pga")
    with pytest.raises(dd.errors.DondoloError, match="no curve was fitted"):
        nothing.risk(hazard)
    for wrong, sentence in (
        (lambda x: x, "must lie between 0 and 1"),
        (lambda x: np.full_like(x, np.nan), "fragility = nan: must lie"),
        (lambda x: 0.5, "gives an array of shape"),
        (lambda x: np.full(x.shape, "much"), "fragility: must give numbers"),
        (lambda x: np.exp(-x), r"fragility = 0\.\d+ at \S+, 0\.\d+ below: must not fall with the intensity"),
        (0.3, "function: must be a function, not float"),
    ):
        with pytest.raises(dd.errors.InputError, match=sentence):
            dd.FunctionFragility(wrong).risk(hazard)
    with refused("wrong_type", "hazard"):
        curve.risk([1.0])
    for levels, frequency, sentence in (
        ([0.1, 0.2], [0.01], "2 levels, 1 annual_frequency: must be as many"),
        ([0.1], [0.01], "levels: must be at least two.*an integral over a hazard curve"),
        ([0.0, 0.1], [0.02, 0.01], "levels = 0: must be positive"),
        ([0.1, 0.2], [0.01, 0.0], "annual_frequency = 0: must be positive; leave out"),
        ([0.1, 0.2], [0.01, np.nan], "annual_frequency = nan: must be positive"),
        ([0.2, 0.2], [0.02, 0.01], "levels = 0.2, 0.2: must increase strictly"),
        ([0.1, 0.2], [0.01, 0.02], "annual_frequency = 0.01, 0.02: must not increase"),
    ):
        with pytest.raises(dd.errors.InputError, match=sentence):
            dd.HazardCurve(levels, frequency)
    with pytest.raises(dd.errors.InputError, match="im = 'pgx'"):
        dd.HazardCurve([0.1, 0.2], [0.02, 0.01], im="pgx")


def test_files(hazard, tmp_path):
    hazard.to_csv(tmp_path / "hazard.csv")
    again = dd.HazardCurve.from_csv(tmp_path / "hazard.csv")
    np.testing.assert_array_equal(again.levels, hazard.levels)
    np.testing.assert_array_equal(again.annual_frequency, hazard.annual_frequency)
    assert again.im == "pga"
    (tmp_path / "own.csv").write_text('# a site\n  # indented\n"sa(0.5)", annual_frequency\n0.1,0.01\n\n0.3,0.001\n')
    own = dd.HazardCurve.from_csv(tmp_path / "own.csv")
    assert (own.im, own(0.3)) == ("sa(0.5)", pytest.approx(0.001))
    for text, sentence in (
        ("", "the file is empty"),
        ("0.1,0.01\n", "column '0.1': must be an intensity measure"),
        ("pga,annual_frequency\n0.1,0.01\n0.2,x\n", "line 3: annual_frequency = 'x': must be a number"),
        ("pga,annual_frequency\n0.1,0.01\n0.2\n", "line 3: 1 cells: must be 2"),
        ("pga,annual_frequency\n0.1,0.01,1\n0.2,1,1\n", "line 2: 3 cells: must be 2"),
        ("pga,annual_frequency\n0,1,0,01\n", r"line 2: 4 cells: .*commas need decimal points"),
        ("pga,annual_frequency\n0.1,0.01\n0.2,1_0e-4\n", "line 3: annual_frequency = '1_0e-4': must be a number"),
        ("# a\n\npga,annual_frequency\n  # b\n0.1,0.01\n\n0.2,?\n", r"line 7: annual_frequency = '\?': must be"),
        ("pga,annual_frequency\n", "own.csv: levels: must be given"),
        ("pga,annual_frequency\n0.1,0.01\n0.2,0.02\n", "own.csv: annual_frequency = 0.01, 0.02"),
    ):
        (tmp_path / "own.csv").write_text(text)
        with pytest.raises(dd.errors.InputError, match=sentence):
            dd.HazardCurve.from_csv(tmp_path / "own.csv")
    (tmp_path / "long.csv").write_text("pga,annual_frequency\n0.1," + "1" * 200000 + "\n")
    with pytest.raises(dd.errors.InputError, match=r"long\.csv: line 2: annual_frequency = "):
        dd.HazardCurve.from_csv(tmp_path / "long.csv")
    with pytest.raises(dd.errors.MissingFileError, match="no such file"):
        dd.HazardCurve.from_csv(tmp_path / "none.csv")
    with pytest.raises(dd.errors.InputError, match=r"path = 3\.5: must be the path of a file"):
        dd.HazardCurve.from_csv(3.5)


RIGID = "ag is taken for the PGA; that of rigid ground must be multiplied by the factors of soil and topography"
NTC = "TR [anni];ag [g];F0 [-];TC* [s]\n30;0,05;2,4;0,28\n475;0,2;2,5;0,33\n"


@pytest.mark.parametrize(
    ("content", "warned"),
    [
        ("pga,annual_frequency\n0.05,0.03333333333333333\n0.2,0.002105263157894737\n", ()),
        ("return_period,pga\n30,0.05\n475,0.2\n", ()),
        ("Return_Period (years),ag (g/10)\n30,0.5\n475,2\n", (RIGID,)),
        ("tr,ag (m/s²)\n30,0.4905\n475,1.962\n", (RIGID,)),
        ("PGA [cm/s^2],TR\n49.05,30\n196.2,475\n", ()),
        (NTC, ("semicolons, decimal commas", "columns that are not used: F0 [-], TC* [s]", RIGID)),
        ("\ufeffFerrara, 2024;;;\n" + NTC + ";;;\n", ("line 1 is a title", "not used", RIGID)),
        # 1 - exp(-50/30), and of another time in each row
        ("poe,investigation_time,pga\n0.8111243971624382,50,0.05\n0.1,50.04624493746748,0.2\n", ()),
    ],
)
def test_published_hazard(content, warned, tmp_path):
    path = tmp_path / "hazard.csv"
    path.write_text(content, encoding="utf-8")
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        curve = dd.HazardCurve.from_csv(path)
    assert curve.im == "pga"
    np.testing.assert_allclose(curve.levels, [0.05, 0.2], rtol=1e-12)
    np.testing.assert_allclose(curve.annual_frequency, [1 / 30, 1 / 475], rtol=1e-6)
    assert len(caught) == len(warned)
    for warning, words in zip(caught, warned, strict=True):
        assert words in str(warning.message)
        assert warning.filename == __file__


@pytest.mark.parametrize(
    ("content", "sentence"),
    [
        ("TR;ag\n30;0,05\n475;0,2\n", r"column 'ag': the unit must follow the name: 'ag \(g\)'"),
        ("TR,ag (t)\n30,0.05\n475,0.2\n", r"column 'ag \(t\)': the unit must be one of 'g', 'g/10', 'm/s2'"),
        ("TR (days),pga\n30,0.05\n", r"column 'TR \(days\)': return_period must be in years"),
        ("TR,pga\n0,0.05\n475,0.2\n", "return_period = 0: must be positive, in years"),
        ("poe,pga\n0.1,0.05\n", "poe and investigation_time .* belong together"),
        ("TR,investigation_time,pga\n30,50,0.05\n", "poe and investigation_time .* belong together"),
        ("poe,investigation_time,pga\n81,50,0.05\n10,50,0.2\n", "poe = 81: must lie between 0 and 1"),
        ("poe (%),investigation_time,pga\n81,50,0.05\n", "poe must be a probability between 0 and 1"),
        ("poe,investigation_time,pga\n0.8,0,0.05\n0.1,0,0.2\n", "investigation_time = 0: must be positive"),
        ("poe,TR,pga\n0.1,475,0.05\n", "one column must be .* there is return_period, poe"),
        ("TR,return_period,pga\n30,30,0.05\n", "return_period is a duplicate"),
        ("TR,pga,pgv\n30,0.05,0.05\n", "one column must be the levels of a measure, .* there is 'pga', 'pgv'"),
        ("TR,F0\n30,2.4\n", "one column must be the levels of a measure, .* there is none"),
        ("pga,remark\n0.1,2\n", "column 'remark': must be an intensity measure, ag, annual_frequency"),
        ("pga;TR\n0.100;30\n1.200;475\n", None),
        ("pga;TR\n1.100;30\n1.200;475\n", "line 2: pga = '1.100': may be thousands or decimals"),
    ],
)
def test_published_hazard_that_is_wrong(content, sentence, tmp_path):
    path = tmp_path / "hazard.csv"
    path.write_text(content)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", dd.errors.DondoloWarning)
        if sentence is None:
            assert dd.HazardCurve.from_csv(path).levels[1] == 1.2
        else:
            with pytest.raises(dd.errors.InputError, match=sentence) as caught:
                dd.HazardCurve.from_csv(path)
            assert str(caught.value).startswith(f"{path}: ")


def test_hazard_that_is_no_utf8(tmp_path):
    path = tmp_path / "hazard.csv"
    table = "# città\npga,annual_frequency\n0.1,0.01\n0.2,0.001\n"
    path.write_text(table, encoding="cp1252")
    with pytest.raises(
        dd.errors.InputError, match=r"line 1: byte 7 \(E0\) is .*: save it as UTF-8 \(Excel: Save As, CSV UTF-8; "
    ):
        dd.HazardCurve.from_csv(path)
    path.write_text(table, encoding="utf-16")
    assert dd.HazardCurve.from_csv(path).levels[1] == 0.2


def test_shown(hazard, curve):
    assert repr(hazard) == "<HazardCurve: levels 9 of pga, 0.02 to 6.4 g, annual frequency 0.1 to 5e-09>"
    assert repr(dd.HazardCurve.power_law(1e-4, 2.5)) == "<HazardCurve: power law 0.0001 pga^-2.5 a year>"
    assert "return period" in repr(curve.risk(hazard))
    assert "<table>" in curve.risk(hazard)._repr_html_()
    assert list(hazard.to_frame()["pga"]) == LEVELS


@pytest.mark.slow
@pytest.mark.parametrize("endless", [False, True])
def test_figure(hazard, curve, endless):
    hazard = dd.HazardCurve.power_law(1e-4, 2.5) if endless else dd.HazardCurve(LEVELS[:6], FREQUENCY[:6])
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", dd.errors.DondoloWarning)
        risk = curve.risk(hazard)
    above, middle, below = risk.plot().figure.axes
    drawn = above.get_lines()[0 if endless else 1]
    assert np.all(np.isin(hazard.levels, drawn.get_xdata())) or endless
    np.testing.assert_allclose(drawn.get_ydata(), hazard(drawn.get_xdata()))
    x = middle.get_lines()[0].get_xdata()
    smooth = hazard.smoothed()
    np.testing.assert_allclose(middle.get_lines()[0].get_ydata(), curve(x))
    share = below.get_lines()[0]
    density = replace(risk, hazard=smooth).density(x)
    # The exponent of the smooth curve is that of its steps, joined by lines.
    np.testing.assert_allclose(share.get_ydata(), density / risk.inside, atol=0.03 * density.max() / risk.inside)
    assert integrate.trapezoid(share.get_ydata(), np.log(x)) == pytest.approx(1.0, abs=0.04)
    assert below.get_xlabel() == "peak ground acceleration [g]"
    text = f"{risk.annual_frequency:.3g}" if endless else "between {:.3g} and {:.3g}".format(*risk.bounds)
    assert f"{text} a year" in above.get_title(loc="left")
    above.figure.draw_without_rendering()
    title = next(text for text in above.findobj(matplotlib.text.Text) if "frequency of collapse" in text.get_text())
    assert title.get_window_extent().x1 <= above.figure.bbox.x1
    plt.close("all")
