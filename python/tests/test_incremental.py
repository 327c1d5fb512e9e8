"""Incremental dynamic analysis: curves of records, first collapses, fractiles and the fit to them."""

from dataclasses import replace
from fractions import Fraction

import matplotlib

matplotlib.use("agg")

import warnings

import matplotlib.pyplot as plt
import numpy as np
import pytest
from scipy import optimize, stats

import dondolo as dd
from dondolo.analysis.incremental import SHARES, fractiles

LEVELS = np.array([0.2, 0.4, 0.6, 0.8, 1.0])


@pytest.fixture(scope="module")
def stripes(wall, records):
    """Stripes that end before all histories collapse."""
    return dd.multiple_stripe(wall, records, LEVELS, polarity="both", progress=False)


def with_outcomes(stripes, collapsed, edp, **plain):
    """Stripes of other histories, all of which ran."""
    rest = {"ran": np.ones_like(collapsed), "impacts": np.zeros_like(collapsed, dtype=np.int32)}
    rest |= {"time_of_peak": np.zeros_like(edp), "scale": np.ones_like(edp)}
    return replace(stripes, collapsed=collapsed, edp=edp, **rest, **plain)


def made(stripes, collapsed, edp=None):
    """Stripes that collapse where a table, written level by level from the lowest, says so."""
    collapsed = np.array([[mark == "x" for mark in row] for row in collapsed])
    edp = np.where(collapsed, 1.0, 0.5) if edp is None else np.where(collapsed, 1.0, edp)
    n = collapsed.shape[1]
    names = tuple(f"r{i}" for i in range(n))
    levels = LEVELS[: len(collapsed)]
    plain = {"levels": levels, "record_names": names, "polarity": np.ones(n, dtype=np.int32)}
    return with_outcomes(stripes, collapsed, edp, events=(), checksums=(), **plain)


def test_first_collapses_and_resurrections(stripes):
    table = ["...x.", ".x.x.", ".....", ".xxx.", "..xx."]
    ida = made(stripes, table).incremental()
    np.testing.assert_array_equal(ida.first_collapse, [np.inf, 0.4, 0.8, 0.2, np.inf])
    np.testing.assert_array_equal(ida.last_survival, [1.0, 1.0, 0.6, 0.6, 1.0])
    assert ida.resurrected.tolist() == [False, True, False, True, False]
    assert ida.counted.tolist() == [1, 2, 2, 3, 3]
    np.testing.assert_array_equal(ida.fraction, np.array([1, 2, 2, 3, 3]) / 5)
    np.testing.assert_array_equal(ida.level_fractiles, [0.2, 0.8, np.inf])
    assert made(stripes, ["x", "x"]).incremental().last_survival.tolist() == [0.0]


def test_every_history(stripes):
    ida = stripes.incremental()
    assert ida.resurrected.any()
    for i in range(stripes.edp.shape[1]):
        falls = [level for level, gone in zip(LEVELS, stripes.collapsed[:, i], strict=True) if gone]
        stands = [level for level, gone in zip(LEVELS, stripes.collapsed[:, i], strict=True) if not gone]
        assert ida.first_collapse[i] == min(falls, default=np.inf)
        assert ida.last_survival[i] == max(stands, default=0.0)
        assert ida.resurrected[i] == any(level > min(falls, default=np.inf) for level in stands)
    for j, level in enumerate(LEVELS):
        assert ida.counted[j] == sum(first <= level for first in ida.first_collapse)
        edp = sorted(np.where(stripes.collapsed[j], np.inf, stripes.edp[j]))
        for row, share in zip(ida.edp_fractiles, SHARES, strict=True):
            assert row[j] == next(value for i, value in enumerate(edp) if (i + 1) >= share * len(edp))
    assert not ida.first_collapse.flags.writeable


def test_fractiles_are_exact():
    """The smallest value that at least the share does not exceed, whatever the number of values."""
    for n in range(1, 401):
        found = fractiles(np.arange(1.0, n + 1.0))
        for value, share in zip(found, (Fraction(16, 100), Fraction(1, 2), Fraction(84, 100)), strict=True):
            assert value == -((-share * n) // 1)


def capacities(stripes, values, levels):
    """Stripes of histories that collapse at their capacity and above."""
    levels = np.asarray(levels)
    collapsed = levels[:, None] >= values
    edp, names = np.where(collapsed, 1.0, 0.5), tuple(f"r{i}" for i in range(len(values)))
    polarity = np.ones(len(values), dtype=np.int32)
    plain = {"levels": levels, "record_names": names, "polarity": polarity, "events": (), "checksums": ()}
    return with_outcomes(stripes, collapsed, edp, **plain)


def cost_of(first, levels):
    """Minus the logarithm of the likelihood of (mean, deviation), history by history."""
    below = np.append(0.0, levels)[np.searchsorted(levels, first)]

    def cost(p):
        with np.errstate(divide="ignore"):
            ends = [(np.log(value) - p[0]) / p[1] for value in (below, first)]
        return -np.log(stats.norm.cdf(ends[1]) - stats.norm.cdf(ends[0])).sum()

    return cost


def test_counts_behind_the_curve(stripes):
    curve = made(stripes, ["x....", "xx...", "xxxx.", "xxxxx"]).incremental().fit()
    assert curve.status == "ok"
    assert curve.bracket == (0.4, 0.6)
    assert made(stripes, ["x....", "xxx.."]).incremental().fit().bracket == (0.2, 0.4)
    assert made(stripes, ["xxx..", "xxx.."]).incremental().fit().bracket == (0.0, 0.2)
    assert made(stripes, [".....", "x...."]).incremental().fit().bracket == (0.4, np.inf)
    assert curve.collapses.tolist() == [1, 2, 4, 5]
    assert curve(curve.theta) == pytest.approx(0.5)
    low, high = curve.interval(0.5)
    assert low < curve(0.5) < high


def test_two_points_in_closed_form(stripes):
    """Two levels with some of each: the curve goes through both shares."""
    values = np.repeat([0.3, 0.5, 2.0], [3, 4, 5])
    curve = capacities(stripes, values, [0.4, 0.9]).incremental().fit()
    assert curve([0.4, 0.9]) == pytest.approx([3 / 12, 7 / 12], abs=1e-12)


@pytest.mark.parametrize("levels", [LEVELS, [*LEVELS, 1.5, 2.0, 3.0, 9.0]])
def test_likelihood(wall, records, levels):
    """The maximum and its curvature, where the levels end before all histories collapse, and where they do not."""
    levels = np.array(levels)
    stripes = dd.multiple_stripe(wall, records, levels, polarity="both", progress=False)
    ida = stripes.incremental()
    assert np.isinf(ida.first_collapse).any() == (levels[-1] < 5.0)
    curve, cost = ida.fit(), cost_of(ida.first_collapse, levels)
    best = optimize.minimize(
        cost,
        [np.log(curve.theta) + 0.05, 1.1 * curve.beta],
        method="Nelder-Mead",
        options={"xatol": 1e-10, "fatol": 1e-13, "maxiter": 4000},
    )
    assert [np.log(curve.theta), curve.beta] == pytest.approx(best.x, abs=1e-7)
    # Curvature of the likelihood by differences
    h = 1e-4
    bend = np.empty((2, 2))
    for i in range(2):
        for j in range(2):
            ei, ej = h * np.eye(2)[i], h * np.eye(2)[j]
            bend[i, j] = sum(a * b * cost(best.x + a * ei + b * ej) for a in (1, -1) for b in (1, -1)) / (4.0 * h**2)
    np.testing.assert_allclose(curve.naive_covariance, np.linalg.inv(bend), rtol=1e-4)
    # To first order the clustered covariance is the sum over fits that leave out an event each
    assert (curve.errors, curve.clusters) == ("clustered", 22)
    changes = []
    for event in dict.fromkeys(stripes.events):
        kept = np.array([own != event for own in stripes.events])[stripes.record_index]
        one = optimize.minimize(cost_of(ida.first_collapse[kept], levels), best.x, method="Nelder-Mead").x
        changes.append(one - best.x)
    expected = np.transpose(changes) @ np.array(changes)
    np.testing.assert_allclose(np.diag(curve.covariance), np.diag(expected), rtol=0.2)
    assert stripes.fit().theta != curve.theta


@pytest.mark.parametrize(("step", "number"), [(0.3, 2), (0.3, 10), (0.1, 4), (0.1, 30), (0.02, 20), (0.02, 150)])
def test_neither_the_step_nor_the_top_is_an_error(stripes, step, number):
    """A sample of capacities that is seen on a grid keeps its parameters; the levels of first collapse do not."""
    values = np.exp(np.random.default_rng(4).normal(np.log(0.5), 0.4, size=20_000))
    levels = step * np.arange(1, number + 1)
    ida = capacities(stripes, values, levels).incremental()
    curve = ida.fit()
    assert abs(np.log(curve.theta / 0.5)) < 3.0 * curve.se_ln_theta < 0.05
    assert abs(curve.beta - 0.4) < 3.0 * curve.se_beta < 0.06
    ends = np.log(ida.first_collapse[np.isfinite(ida.first_collapse)])
    assert abs(np.mean(ends) - np.log(0.5)) > 0.015


@pytest.mark.parametrize(
    ("table", "status"),
    [
        (["...", "..."], "no_collapse"),
        (["..x"], "single_level"),
        (["..."], "no_collapse"),
        (["xxx"], "all_collapse"),
        (["xxx", "xxx"], "all_collapse"),
        (["...", "xxx"], "separated"),
        (["...", "..x"], "separated"),
        (["x..", "xxx"], "separated"),
        (["..x", "..x"], "decreasing"),
        (["...", "..x", "..x", "..x"], "extrapolated"),
        (["..x", ".xx", "xxx"], "ok"),
    ],
)
def test_status(stripes, table, status):
    with warnings.catch_warnings(record=True) as told:
        warnings.simplefilter("always")
        curve = made(stripes, table).incremental().fit()
    sentences = {"ok": [], "extrapolated": [f"theta = {curve.theta:.4g} lies outside the levels"]}
    expected = sentences.get(status, [f"no curve of first collapses is fitted (status '{status}')"])
    assert [str(one.message)[: len(part)] for one, part in zip(told, expected, strict=True)] == expected
    assert curve.status == status
    assert curve.has_fit == np.isfinite(curve.theta) == np.isfinite(curve.beta)


def test_what_the_curve_cannot_do(stripes):
    curve = stripes.incremental().fit()
    with pytest.raises(dd.errors.DondoloError, match="needs the stripes"):
        curve.bootstrap()
    # The same records make both curves
    assert curve.compare(stripes.fit()).pairing == "paired"


def test_tables(stripes, tmp_path):
    ida = stripes.incremental()
    table = ida.to_frame()
    assert list(table["record"]) == list(stripes.record_names)
    assert table["first_collapse"].isna().sum() == np.isinf(ida.first_collapse).sum()
    assert table["resurrected"].sum() == ida.resurrected.sum()
    assert list(ida.to_frame("fractiles")["collapsed_once"]) == list(ida.counted)
    ida.to_csv(tmp_path / "records.csv")
    assert len((tmp_path / "records.csv").read_text().splitlines()) == 4 + stripes.edp.shape[1]
    with pytest.raises(dd.errors.InputError, match="table = 'x'"):
        ida.to_frame("x")
    assert f"survive a higher level later {ida.resurrected.sum()}" in repr(ida)
    assert "<table>" in ida._repr_html_()


def test_figure(stripes):
    ida = stripes.incremental()
    ax = ida.plot()
    lines = ax.get_lines()
    n = len(ida.first_collapse)
    flat = sum(line.get_ydata()[-1] == line.get_ydata()[-2] and line.get_xdata()[-1] > 1.0 for line in lines[:n])
    assert flat == np.isfinite(ida.first_collapse).sum()
    for line, first in zip(lines[:n], ida.first_collapse, strict=False):
        assert line.get_xydata()[0].tolist() == [0.0, 0.0]
        assert line.get_ydata()[-1] == (first if np.isfinite(first) else LEVELS[-1])
        assert line.get_xdata()[-2] < 1.0
    texts = [text.get_text() for text in ax.get_legend().get_texts()]
    assert "50 % fractile of the EDP" in texts
    bold = next(line for line in lines if line.get_label() == "50 % fractile of the EDP")
    alive = np.isfinite(ida.edp_fractiles[1])
    np.testing.assert_array_equal(bold.get_xdata()[1 : 1 + alive.sum()], ida.edp_fractiles[1][alive])
    circles = next(line for line in lines if "survive above" in str(line.get_label()))
    assert len(circles.get_xdata()) == (~stripes.collapsed & (LEVELS[:, None] > ida.first_collapse)).sum()
    assert ax.get_xlabel() == "EDP = largest rotation / capacity"
    assert ax.get_ylabel() == "peak ground acceleration [g]"
    plt.close("all")
