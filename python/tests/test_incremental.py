"""Incremental dynamic analysis: curves of records, first collapses, fractiles and the fit to them."""

from dataclasses import replace
from fractions import Fraction

import matplotlib

matplotlib.use("agg")

import matplotlib.pyplot as plt
import numpy as np
import pytest
from dondolo.incremental import SHARES, _censored, fractiles
from scipy import optimize, stats

import dondolo as dd

LEVELS = np.array([0.2, 0.4, 0.6, 0.8, 1.0])


@pytest.fixture(scope="module")
def stripes(wall, records):
    """Stripes that end before all histories collapse."""
    return dd.multiple_stripe(wall, records, LEVELS, polarity="both", progress=False)


def made(stripes, collapsed, edp=None):
    """Stripes that collapse where a table, written level by level from the lowest, says so."""
    collapsed = np.array([[mark == "x" for mark in row] for row in collapsed])
    edp = np.where(collapsed, 1.0, 0.5) if edp is None else np.where(collapsed, 1.0, edp)
    n = collapsed.shape[1]
    names = tuple(f"r{i}" for i in range(n))
    levels = LEVELS[: len(collapsed)]
    return replace(
        stripes, levels=levels, collapsed=collapsed, edp=edp, record_names=names, polarity=np.ones(n, dtype=np.int32)
    )


def test_first_collapses_and_resurrections(stripes):
    table = ["...x.", ".x.x.", ".....", ".xxx.", "..xx."]
    ida = dd.incremental(made(stripes, table))
    np.testing.assert_array_equal(ida.first_collapse, [np.inf, 0.4, 0.8, 0.2, np.inf])
    np.testing.assert_array_equal(ida.last_survival, [1.0, 1.0, 0.6, 0.6, 1.0])
    assert ida.resurrected.tolist() == [False, True, False, True, False]
    assert ida.counted.tolist() == [1, 2, 2, 3, 3]
    np.testing.assert_array_equal(ida.fraction, np.array([1, 2, 2, 3, 3]) / 5)
    np.testing.assert_array_equal(ida.level_fractiles, [0.2, 0.8, np.inf])
    assert dd.incremental(made(stripes, ["x", "x"])).last_survival.tolist() == [0.0]


def test_every_history(stripes):
    ida = dd.incremental(stripes)
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


def test_moments(stripes):
    ida = dd.incremental(made(stripes, ["x....", "xx...", "xxxx.", "xxxxx"]))
    curve = ida.fit()
    ln = np.log([0.2, 0.4, 0.6, 0.6, 0.8])
    assert curve.status == "ok"
    assert curve.theta == pytest.approx(np.exp(ln.mean()), rel=1e-13)
    assert curve.beta == pytest.approx(ln.std(ddof=1), rel=1e-13)
    assert curve.se_ln_theta == pytest.approx(curve.beta / np.sqrt(5), rel=1e-13)
    assert curve.se_beta == pytest.approx(curve.beta / np.sqrt(2.0 * 4.0), rel=1e-13)
    assert curve.bracket == (0.4, 0.6)
    assert dd.incremental(made(stripes, ["x....", "xxx.."])).fit().bracket == (0.2, 0.4)
    assert dd.incremental(made(stripes, ["xxx..", "xxx.."])).fit().bracket == (0.0, 0.2)
    assert dd.incremental(made(stripes, [".....", "x...."])).fit().bracket == (0.4, np.inf)
    assert curve.collapses.tolist() == [1, 2, 4, 5]
    assert curve(curve.theta) == pytest.approx(0.5)
    low, high = curve.interval(0.5)
    assert low < curve(0.5) < high


def test_censored_likelihood(stripes):
    curve = dd.incremental(stripes).fit()
    first = dd.incremental(stripes).first_collapse
    x, m = np.log(first[np.isfinite(first)]), np.isinf(first).sum()
    assert 5 < m < len(first) - 5

    def cost(p):
        z = (np.log(LEVELS[-1]) - p[0]) / p[1]
        return -(stats.norm.logpdf(x, *p).sum() + m * stats.norm.logsf(z))

    best = optimize.minimize(
        cost, [x.mean(), x.std()], method="Nelder-Mead", options={"xatol": 1e-10, "fatol": 1e-13, "maxiter": 4000}
    )
    assert [np.log(curve.theta), curve.beta] == pytest.approx(best.x, abs=1e-7)
    # Curvature of the likelihood by differences
    h = 1e-4
    bend = np.empty((2, 2))
    for i in range(2):
        for j in range(2):
            ei, ej = h * np.eye(2)[i], h * np.eye(2)[j]
            bend[i, j] = sum(a * b * cost(best.x + a * ei + b * ej) for a in (1, -1) for b in (1, -1)) / (4.0 * h**2)
    np.testing.assert_allclose(curve.covariance, np.linalg.inv(bend), rtol=1e-4)
    assert stripes.fit().theta != curve.theta


def test_censoring_is_put_right():
    """A sample cut at the top keeps its parameters; its moments alone would not."""
    random = np.random.default_rng(4)
    for cut in (0.0, -0.5, 1.0):
        sample = random.normal(-0.5, 0.4, size=20_000)
        top = -0.5 + 0.4 * cut
        mean, deviation, covariance = _censored(sample[sample <= top], top, int((sample > top).sum()))
        errors = np.sqrt(np.diag(covariance))
        assert abs(mean + 0.5) < 3.0 * errors[0] < 0.05
        assert abs(deviation - 0.4) < 3.0 * errors[1] < 0.05
        assert abs(sample[sample <= top].mean() + 0.5) > 0.05


@pytest.mark.parametrize(
    ("table", "status"),
    [
        (["...", "..."], "no_collapse"),
        (["..x"], "single_level"),
        (["xxx", "xxx"], "all_collapse"),
        (["...", "xxx"], "separated"),
        (["...", "..x"], "separated"),
        (["...", "..x", "..x", "..x"], "extrapolated"),
        (["..x", ".xx", "xxx"], "ok"),
    ],
)
def test_status(stripes, table, status):
    curve = dd.incremental(made(stripes, table)).fit()
    assert curve.status == status
    assert curve.has_fit == np.isfinite(curve.theta) == np.isfinite(curve.beta)


def test_what_the_curve_cannot_do(stripes):
    curve = dd.incremental(stripes).fit()
    with pytest.raises(dd.DondoloError, match="first collapses"):
        curve.interval(0.5, method="profile")
    with pytest.raises(dd.DondoloError, match="needs the stripes"):
        curve.bootstrap()
    with pytest.raises(dd.DondoloError, match="not to first collapses"):
        dd.compare(curve, stripes.fit())
    with pytest.raises(dd.InputError, match="list are no stripes"):
        dd.incremental([])


def test_tables(stripes, tmp_path):
    ida = dd.incremental(stripes)
    table = ida.to_frame()
    assert list(table["record"]) == list(stripes.record_names)
    assert table["first_collapse"].isna().sum() == np.isinf(ida.first_collapse).sum()
    assert table["resurrected"].sum() == ida.resurrected.sum()
    assert list(ida.to_frame("fractiles")["collapsed_once"]) == list(ida.counted)
    ida.to_csv(tmp_path / "records.csv")
    assert len((tmp_path / "records.csv").read_text().splitlines()) == 4 + stripes.edp.shape[1]
    with pytest.raises(dd.InputError, match="table = 'x'"):
        ida.to_frame("x")
    assert f"survive a higher level later {ida.resurrected.sum()}" in repr(ida)
    assert "<table>" in ida._repr_html_()


def test_figure(stripes):
    ida = dd.incremental(stripes)
    ax = dd.plot_incremental(ida)
    lines = ax.get_lines()
    n = len(ida.first_collapse)
    flat = sum(line.get_ydata()[-1] == line.get_ydata()[-2] and line.get_xdata()[-1] > 1.0 for line in lines[:n])
    assert flat == np.isfinite(ida.first_collapse).sum()
    for line, first in zip(lines[:n], ida.first_collapse, strict=False):
        assert line.get_xydata()[0].tolist() == [0.0, 0.0]
        assert line.get_ydata()[-1] == (first if np.isfinite(first) else LEVELS[-1])
        assert line.get_xdata()[-2] < 1.0
    texts = [text.get_text() for text in ax.get_legend().get_texts()]
    assert "50 % fractile" in texts
    bold = next(line for line in lines if line.get_label() == "50 % fractile")
    alive = np.isfinite(ida.edp_fractiles[1])
    np.testing.assert_array_equal(bold.get_xdata()[1 : 1 + alive.sum()], ida.edp_fractiles[1][alive])
    circles = next(line for line in lines if "survive above" in str(line.get_label()))
    assert len(circles.get_xdata()) == (~stripes.collapsed & (LEVELS[:, None] > ida.first_collapse)).sum()
    assert ax.get_xlabel() == "EDP = largest rotation / capacity"
    assert ax.get_ylabel() == "peak ground acceleration [g]"
    plt.close("all")
