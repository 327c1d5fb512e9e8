"""How uncertain an annual frequency is: draws of a curve's parameters, and clusters left out of a population."""

import warnings
from dataclasses import replace

import matplotlib

matplotlib.use("agg")

import matplotlib.pyplot as plt
import numpy as np
import pytest
from refusals import refused
from scipy import optimize, stats

import dondolo as dd
from dondolo.curves.risk_uncertainty import _parameters
from dondolo.hazard.integrals import nodes

LEVELS = np.array([0.02, 0.05, 0.1, 0.2, 0.4, 0.8, 1.6, 3.2, 6.4])
MEAN = np.array([0.1, 0.03, 0.01, 2.5e-3, 4e-4, 5e-5, 4e-6, 2e-7, 5e-9])


@pytest.fixture(scope="module")
def hazard():
    return dd.HazardCurve(LEVELS, MEAN, fractiles={0.16: 0.4 * MEAN, 0.84: 1.6 * MEAN})


def curve_of(covariance, degrees=np.inf, **more):
    """A curve with standard errors of one's choice."""
    step = 0.4 * stats.norm.ppf(0.75)
    curve = dd.fit_fragility([0.6 * np.exp(-step), 0.6 * np.exp(step)], [250, 750], 1000, im="pga")
    kind = {} if np.isinf(degrees) else {"errors": "clustered", "clusters": int(degrees) + 1}
    return replace(curve, covariance=np.array(covariance), degrees_of_freedom=degrees, **kind, **more)


def test_closed_form():
    """Of a power law ln lambda is normal where ln theta is, and its variance is k^2 times as large."""
    k, se = 2.5, 0.1
    risk = curve_of([[se**2, 0.0], [0.0, 0.0]]).risk(dd.HazardCurve.power_law(1e-4, k))
    found = risk.uncertainty(n_draws=40_000, rng=3)
    ln = np.log(found.annual_frequency / risk.annual_frequency)
    assert stats.kstest(ln, stats.norm(0.0, k * se).cdf).pvalue > 0.01
    assert found.interval() == pytest.approx(risk.annual_frequency * np.exp([-1.96 * k * se, 1.96 * k * se]), rel=0.01)
    assert found.fractiles == {}
    few = curve_of([[se**2, 0.0], [0.0, 0.0]], 5.0).risk(risk.hazard).uncertainty(n_draws=40_000)
    ln = np.log(few.annual_frequency / risk.annual_frequency) / (k * se)
    assert stats.kstest(ln, stats.t(5.0).cdf).pvalue > 0.01


def test_the_slope_is_drawn_as_its_interval_says(hazard):
    """The draws of theta and beta have the intervals of the parameters."""
    curve = curve_of([[4e-3, 1e-3], [1e-3, 2e-3]], 12.0)
    theta, beta = _parameters(curve, 200_000, np.random.default_rng(1))
    ends = curve.parameter_interval()
    np.testing.assert_allclose(np.quantile(theta, [0.025, 0.975]), ends["theta"], rtol=0.01)
    np.testing.assert_allclose(np.quantile(beta, [0.025, 0.975]), ends["beta"], rtol=0.01)
    correlation = np.corrcoef(np.log(theta), -1.0 / beta)[0, 1]
    assert correlation == pytest.approx(1e-3 / np.sqrt(8e-6), abs=0.02)
    found = curve.risk(hazard).uncertainty()
    again = curve.risk(hazard).uncertainty()
    np.testing.assert_array_equal(found.annual_frequency, again.annual_frequency)
    other = curve.risk(hazard).uncertainty(rng=1)
    assert found.interval() != other.interval()
    np.testing.assert_allclose(found.interval(), other.interval(), rtol=0.05)


def test_beside_the_fractiles_of_the_hazard(hazard, tmp_path):
    curve = curve_of([[4e-3, 1e-3], [1e-3, 2e-3]], 12.0)
    risk = curve.risk(hazard)
    found = risk.uncertainty(n_draws=1000)
    table = found.table()
    assert table["hazard"] == ["mean", "0.16", "0.84"]
    np.testing.assert_allclose(found.fractiles[0.84], 1.6 * found.annual_frequency, rtol=1e-12)
    assert found.estimates[0.16] == pytest.approx(0.4 * risk.annual_frequency, rel=1e-12)
    assert found.interval(hazard=0.84, confidence=0.5)[1] < table["high"][2]
    assert list(found.to_frame().columns) == ["hazard", "annual_frequency", "low", "high"]
    with refused("not_a_number", "confidence"):
        found.to_csv("never.csv", confidence="high")
    shown = repr(found)
    assert f"95 % interval {found.interval()[0]:.4g} to {found.interval()[1]:.4g}" in shown
    assert "13 clusters of records" in shown
    found.save(tmp_path / "risk.npz")
    assert dd.load(tmp_path / "risk.npz").table() == table
    ax = found.plot()
    assert len(ax.lines) == 6
    plt.close(ax.figure)
    with pytest.raises(dd.errors.InputError, match=r"q = 0.5: must be one of the fractiles"):
        found.interval(hazard=0.5)
    with pytest.raises(dd.errors.InputError, match=r"confidence = 1.0"):
        found.interval(confidence=1.0)


def test_curves_that_are_open(hazard):
    """A slope that may be nothing: no bound but that of the hazard."""
    curve = curve_of([[4e-3, 0.0], [0.0, 0.5]])
    found = curve.risk(hazard).uncertainty(n_draws=1000)
    # Level at 1/2, the limit of ever larger dispersions
    assert found.annual_frequency.max() == 0.5 * MEAN[0]
    wide = replace(curve, beta=1e7)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        assert wide.risk(hazard).annual_frequency == pytest.approx(0.5 * MEAN[0], rel=1e-5)
    endless = curve.risk(dd.HazardCurve.power_law(1e-4, 2.5)).uncertainty(n_draws=1000)
    assert endless.interval()[1] == np.inf
    half = replace(curve, upper_asymptote=0.5).risk(hazard).uncertainty(n_draws=1000)
    np.testing.assert_array_equal(half.annual_frequency, 0.5 * found.annual_frequency)


@pytest.mark.filterwarnings("ignore::dondolo.errors.DondoloWarning")
def test_intervals_cover_what_the_hazard_may_be_beyond_its_levels(people, records):
    short = dd.HazardCurve([0.1, 0.2, 0.3], [0.01, 2e-3, 8e-4])
    curve = curve_of([[4e-3, 1e-3], [1e-3, 2e-3]])
    for risk in (curve.risk(short), people(records[::4])["all"].risk(short)):
        low, high = risk.bounds
        assert high > 1.5 * low
        found = risk.uncertainty(n_draws=2000)
        assert found.interval()[0] < low < high < found.interval()[1]
        assert np.median(found.annual_frequency) == pytest.approx(low, rel=0.1)
        assert np.median(found.upper) == pytest.approx(high, rel=0.1)
        assert f"between {low:.4g} and {high:.4g} a year" in repr(found)


def test_what_has_no_uncertainty(hazard):
    for curve, message in (
        (replace(curve_of(np.full((2, 2), np.nan)), errors="few_clusters"), "no standard errors: fewer than three"),
        (dd.FunctionFragility(lambda x: np.minimum(x, 1.0)), "no standard errors are known of this curve"),
    ):
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            risk = curve.risk(hazard)
        with pytest.raises(dd.errors.DondoloError, match=message):
            risk.uncertainty()
    with pytest.raises(dd.errors.InputError, match="n_draws = 10: must be an integer, at least 100"):
        curve_of(np.eye(2)).risk(hazard).uncertainty(n_draws=10)


def test_the_level_that_contributes_most(hazard):
    risk = curve_of(np.eye(2)).risk(hazard)
    parts = risk.deaggregate(np.geomspace(0.02, 6.4, 61))
    middle = np.sqrt(np.geomspace(0.02, 6.4, 61)[:-1] * np.geomspace(0.02, 6.4, 61)[1:])
    # The kinks of the power laws move it by no more than a step.
    assert risk.dominant_level == pytest.approx(middle[np.argmax(parts)], rel=0.2)
    endless = curve_of(np.eye(2)).risk(dd.HazardCurve.power_law(1e-4, 2.5))
    # Where Phi(z) exp(-k beta z) is largest, k beta = 1
    z = optimize.brentq(lambda z: stats.norm.pdf(z) - stats.norm.cdf(z), -3.0, 3.0)
    assert endless.dominant_level == pytest.approx(0.6 * np.exp(0.4 * z), rel=0.02)
    ax = risk.plot_deaggregation(n_bins=12)
    assert len(ax.patches) == 12
    heights = sum(patch.get_height() for patch in ax.patches)
    assert heights == pytest.approx(100.0, abs=0.2)
    assert "contributes most" in ax.get_legend().get_texts()[0].get_text()
    plt.close(ax.figure)
    with pytest.warns(dd.errors.DondoloWarning):
        never = dd.FunctionFragility(lambda x: np.zeros_like(x)).risk(hazard)
    assert np.isnan(never.dominant_level)
    plt.close(never.plot_deaggregation().figure)


@pytest.fixture(scope="module")
def people(records):
    """Walls with one or two mechanisms, one without a fit."""
    walls = [
        dd.OneSidedWall(1.5, 0.25, name="a"),
        dd.OneSidedWall(2.0, 0.25, name="b"),
        dd.TwoBlockWall(2.0, 0.12, hinge=0.5, name="b"),
        dd.OneSidedWall(3.0, 0.25, name="c"),
        dd.OneSidedWall(1.5, 0.9, name="d"),
    ]
    population = dd.Population(walls, [1.0, 2.0, 2.0, 1.5, 0.5], p_occ=[1.0, 0.6, 0.5, 0.8, 1.0])
    return lambda chosen: dd.typology(population, chosen, [0.2, 0.3, 0.4, 0.6, 0.8, 1.0, 1.3, 1.6], progress=False)


@pytest.mark.filterwarnings("ignore::dondolo.errors.DondoloWarning")
def test_records_left_out_of_a_population(people, records, hazard):
    """The change to first order is close to that of the analysis without the records of an event."""
    whole = people(records)
    assert {curve.status for curve in whole.curves} >= {"ok", "no_collapse"}
    for key in ("all", "one_sided"):
        curve = whole[key]
        risk = curve.risk(hazard)
        u, weights = nodes(hazard, curve.reach)
        assert weights @ curve(np.exp(u)) == pytest.approx(risk.annual_frequency, rel=1e-6)
        changes = curve.changes(np.exp(u), weights)
        found = changes["clusters of records"]
        labels = tuple(dict.fromkeys(whole.flags.clusters))
        assert len(found) == len(labels) == 22
        exact = []
        for label in labels[:4]:
            kept = [record for record, own in zip(records, whole.flags.clusters, strict=True) if own != label]
            exact.append(people(kept)[key].risk(hazard).annual_frequency - risk.annual_frequency)
        np.testing.assert_allclose(found[:4], exact, atol=0.15 * np.abs(found).max())
        assert np.corrcoef(found[:4], exact)[0, 1] > 0.98


@pytest.mark.filterwarnings("ignore::dondolo.errors.DondoloWarning")
def test_walls_left_out_of_a_population(people, records, hazard):
    """Exact: the mean of the others."""
    curve = people(records[::4])["all"]
    risk = curve.risk(hazard)
    u, weights = nodes(hazard, curve.reach)
    found = curve.changes(np.exp(u), weights)["walls"]
    each = curve.probabilities(np.exp(u)) @ weights
    share = np.array([1.0, 2.0, 1.5, 0.5])
    for i in range(4):
        others = np.delete(each, i) @ np.delete(share, i) / np.delete(share, i).sum()
        assert found[i] == pytest.approx(others - risk.annual_frequency, rel=1e-6)
    spread = risk.uncertainty(n_draws=2000)
    assert spread.interval()[0] < risk.annual_frequency < spread.interval()[1]
    assert spread.kind == "11 clusters of records and 4 walls"
    assert 3.0 < spread.degrees_of_freedom < 13.0
    np.testing.assert_allclose(spread.fractiles[0.84], 1.6 * spread.annual_frequency, rtol=1e-6)
    endless = curve.risk(dd.HazardCurve.power_law(1e-4, 2.5))
    u, weights = nodes(endless.hazard, curve.reach)
    assert weights @ curve(np.exp(u)) == pytest.approx(endless.annual_frequency, rel=1e-5)


@pytest.mark.filterwarnings("ignore::dondolo.errors.DondoloWarning")
def test_populations_without_standard_errors(people, records, hazard):
    some = people(records[::4])
    exact = some["all"].risk(hazard).uncertainty(n_draws=4000)
    # Read back: by the lognormal fitted to the mean, which the curve is not far from
    back = replace(some, flags=None)["all"].risk(hazard).uncertainty(n_draws=4000)
    assert back.kind.endswith(" 4 walls, by the lognormal fitted to the mean")
    assert back.risk.bounds == exact.risk.bounds
    # Four walls leave long tails, which are those of ln lambda here and of ln theta and 1/beta there.
    ends = [np.log(one.interval(confidence=0.5)) for one in (back, exact)]
    np.testing.assert_allclose(*ends, atol=0.5)
    by_fit = some["all"].fit.risk(hazard).uncertainty(n_draws=4000)
    for end, draws, of_fit in zip(
        (0, 1), (back.annual_frequency, back.upper), (by_fit.annual_frequency, by_fit.upper), strict=True
    ):
        np.testing.assert_allclose(draws, of_fit * back.risk.bounds[end] / by_fit.risk.bounds[end], rtol=1e-12)
    assert list(back.fractiles) == list(exact.fractiles)
    few = people(records[:2])["all"].risk(hazard)
    with pytest.raises(dd.errors.DondoloError, match="fewer than 3 clusters of records"):
        few.uncertainty()
    walls = [dd.OneSidedWall(1.5, 0.25, name="a"), dd.OneSidedWall(1.8, 0.25, name="b")]
    two = dd.typology(walls, records, [0.2, 0.4, 0.6, 0.8, 1.0, 1.3], progress=False)["all"]
    assert two.fit.errors == "few_walls"
    with pytest.raises(dd.errors.DondoloError, match="two walls: at least three are needed"):
        two.risk(hazard).uncertainty()


def test_fractiles_that_are_hardly_exceeded():
    """A fractile that is exceeded at one level is no curve, and does not keep the others from theirs."""
    levels, mean = [0.1, 0.2, 0.4, 0.8], np.array([1e-2, 1e-3, 1e-4, 1e-5])
    hazard = dd.HazardCurve(levels, mean, fractiles={0.05: [1e-3, 0.0, 0.0, 0.0], 0.84: 2.0 * mean})
    with pytest.raises(dd.errors.InputError, match=r"fractile 0\.05 of the hazard curve: must be exceeded at 2 levels"):
        hazard.fractile(0.05)
    risk = curve_of([[0.01, 0.0], [0.0, 0.001]]).risk(hazard)
    found = risk.uncertainty(n_draws=200)
    assert list(found.fractiles) == [0.84]
    for axes in (risk.plot().figure.axes[-1], found.plot()):
        texts = [text.get_text() for text in axes.get_legend().get_texts()]
        assert sum("0.84" in text for text in texts) == 1
        assert not any("0.05" in text for text in texts)
    plt.close("all")


def test_many_fractiles_are_all_drawn():
    shares = (0.02, 0.05, 0.16, 0.5, 0.84, 0.95, 0.98, 0.99)
    hazard = dd.HazardCurve(LEVELS, MEAN, fractiles={q: (0.5 + q) * MEAN for q in shares})
    risk = curve_of([[0.01, 0.0], [0.0, 0.001]]).risk(hazard)
    for axes in (risk.plot().figure.axes[-1], risk.uncertainty(n_draws=200).plot()):
        assert len(axes.get_legend().get_texts()) >= 1 + len(shares)
    plt.close("all")
