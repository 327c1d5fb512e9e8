"""Curves of damage states with one dispersion: against other fits, and that they never cross."""

import csv
import warnings
from itertools import pairwise

import numpy as np
import pytest
from scipy.optimize import minimize
from scipy.special import ndtr

import dondolo as dd
from dondolo.curves.damage_states import fit_states
from dondolo.curves.fitting import fit
from dondolo.curves.sample import Sample

STATES = [0.1, 0.4, 1.0]


@pytest.fixture(scope="module")
def analysis(wall, few):
    """Stripes in which every state begins and ends."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", dd.errors.DondoloWarning)
        return dd.multiple_stripe(wall, few, np.linspace(0.1, 1.5, 8), polarity="both", progress=False)


def samples(states, levels):
    """Samples of the states (levels, records) that records are in, each record a cluster."""
    names = tuple(f"record {i}" for i in range(states.shape[1]))
    same = {"levels": levels, "ran": np.ones(states.shape, dtype=bool), "record_index": np.arange(len(names))}
    return [
        Sample(collapsed=states >= k, record_names=names, clusters=names, **same) for k in range(1, states.max() + 1)
    ]


def probabilities(parameters, levels):
    """Probability of each state at each level (states + 1, levels), from ln theta of each and ln beta."""
    *log_theta, log_beta = parameters
    reach = ndtr((np.log(levels) - np.array(log_theta)[:, None]) / np.exp(log_beta))
    return -np.diff(np.vstack([np.ones(len(levels)), reach, np.zeros(len(levels))]), axis=0)


def test_maximum_of_the_likelihood(analysis):
    """As SciPy finds it, in parameters of its own."""
    curves = analysis.fit_damage_states(STATES, states="ordinal")
    reached = np.array([analysis.histories, *map(analysis.exceedances, STATES), 0 * analysis.histories])
    counts = -np.diff(reached, axis=0)

    def misfit(parameters):
        with np.errstate(divide="ignore", invalid="ignore"):
            terms = np.where(counts > 0, counts * np.log(probabilities(parameters, analysis.levels)), 0.0)
        return -terms.sum() if not np.isnan(terms).any() else np.inf

    start = [-1.0, -0.7, -0.4, -1.0]
    found = minimize(misfit, start, method="Nelder-Mead", options={"xatol": 1e-9, "fatol": 1e-12, "maxfev": 20000})
    assert [curve.theta for curve in curves] == pytest.approx(np.exp(found.x[:3]), rel=1e-6)
    assert [curve.beta for curve in curves] == pytest.approx([np.exp(found.x[3])] * 3, rel=1e-6)
    assert all(curve.errors == "clustered" and curve.clusters == len(analysis.events) for curve in curves)
    assert [curve.edp_threshold for curve in curves] == STATES


def test_naive_covariance_and_changes():
    """Against derivatives of the likelihood by differences, and against fits without each cluster."""
    levels = np.array([0.2, 0.35, 0.6, 0.9])
    rng = np.random.default_rng(4)
    capacity = np.array([0.3, 0.45])[:, None] * np.exp(0.45 * rng.normal(size=300))
    states = (
        (levels[:, None, None] >= capacity * np.exp(0.2 * rng.normal(size=(4, 2, 300)))).cumprod(axis=1).sum(axis=1)
    )
    curves = fit_states(samples(states, levels), [0.4, 1.0])
    at = np.array([np.log(curves[0].theta), np.log(curves[1].theta), np.log(curves[0].beta)])
    step = 1e-5
    slopes = [
        (probabilities(at + step * unit, levels) - probabilities(at - step * unit, levels)) / (2.0 * step)
        for unit in np.eye(3)
    ]
    information = 300.0 * np.einsum("akj,bkj,kj->ab", slopes, slopes, 1.0 / probabilities(at, levels))
    covariance = np.linalg.inv(information)
    scale = np.array([1.0, curves[0].beta])
    for k, curve in enumerate(curves):
        pair = np.ix_([k, 2], [k, 2])
        assert curve.naive_covariance == pytest.approx(covariance[pair] * np.outer(scale, scale), rel=1e-6)
        assert curve.covariance[0, 0] > 1.5 * curve.naive_covariance[0, 0]
    for i in (0, 150, 299):
        others = fit_states(samples(np.delete(states, i, axis=1), levels), [0.4, 1.0])
        for curve, other in zip(curves, others, strict=True):
            change = np.log(other.theta / curve.theta), other.beta - curve.beta
            assert curve.parts[0].changes[i] == pytest.approx(change, rel=0.05, abs=5e-5)


def test_curves_never_cross():
    """Whatever the counts are, where curves of their own do cross."""
    rng = np.random.default_rng(2)
    levels = np.array([0.1, 0.2, 0.4, 0.8])
    crossed = fitted = 0
    x = np.geomspace(1e-4, 1e2, 200)
    for _ in range(60):
        states = rng.integers(0, 4, size=(4, 6))
        if states.max() < 3:
            continue
        several = samples(states, levels)
        own = [fit(levels, one.collapsed.sum(axis=1), np.full(4, 6.0)) for one in several]
        curves = [one for one in fit_states(several, STATES) if one.has_fit]
        assert all(np.isfinite([one.theta, one.beta, one.log_likelihood]).all() for one in curves)
        fitted += len(curves)
        for low, high in pairwise(curves):
            assert low.beta == high.beta
            assert np.all(low(x) >= high(x))
        if all(one.has_fit for one in own):
            crossed += any(np.any(low(x) < high(x)) for low, high in pairwise(own))
    assert fitted > 60
    assert crossed > 5


def test_states_without_a_curve_of_their_own():
    levels = np.array([0.2, 0.4, 0.8])
    # Of ten records, how many are in states 0 to 4: all reach the first, none the last, the third and fourth are one
    states = np.array([[1] * 6 + [2] * 4, [1] * 3 + [2] * 4 + [4] * 3, [2] * 2 + [4] * 8])
    several = samples(np.vstack([states]), levels)
    none = Sample(**(vars(several[0]) | {"collapsed": np.zeros_like(several[0].collapsed)}))
    curves = fit_states([*several, none], [0.1, 0.2, 0.3, 0.4, 1.0])
    assert [curve.status for curve in curves] == ["all_collapse", "ok", "ok", "ok", "no_collapse"]
    assert curves[0].bracket == (0.0, 0.2)
    assert curves[4].bracket == (0.8, np.inf)
    assert curves[2].theta == curves[3].theta > curves[1].theta
    assert np.array_equal(curves[2].covariance, curves[3].covariance)
    # One state alone is the fit alone; and one that is separated takes the slope of the others.
    alone = fit_states([several[1]], [0.2])[0]
    own = dd.fit_fragility(levels, several[1].collapsed.sum(axis=1), 10)
    assert (alone.theta, alone.beta) == (own.theta, own.beta)
    steep = np.array([[0] * 6 + [1] * 4, [0] * 3 + [1] * 7, [2] * 10])
    both = fit_states(samples(steep, levels), [0.4, 1.0])
    assert [curve.status for curve in both] == ["ok", "ok"]
    assert dd.fit_fragility(levels, [0, 0, 10], 10).status == "separated"
    apart = fit_states(samples(np.array([[0] * 5, [1] * 5, [2] * 5]), levels), [0.4, 1.0])
    assert [curve.status for curve in apart] == ["separated"] * 2
    falling = fit_states(samples(np.array([[2, 2, 1, 0], [2, 1, 1, 0], [1, 0, 0, 0]]), levels), [0.4, 1.0])
    assert [curve.status for curve in falling] == ["decreasing"] * 2
    few = fit_states(samples(np.array([[0, 1], [1, 2], [0, 2]]), levels), [0.4, 1.0])
    assert {curve.errors for curve in few} == {"few_clusters"}
    with pytest.raises(dd.errors.DondoloError, match="fewer than three clusters"):
        few[0].parameter_interval()


def test_stripes(analysis):
    one = analysis.fit_damage_states([1.0], states="ordinal")[0]
    own = analysis.fit()
    assert (one.theta, one.beta) == (own.theta, own.beta)
    assert np.array_equal(one.covariance, own.covariance)
    separate = analysis.fit_damage_states(STATES)
    assert [curve.theta for curve in separate] == [analysis.fit(edp).theta for edp in STATES]
    low, _, high = analysis.fit_damage_states(STATES, states="ordinal")
    compared = low.compare(high)
    assert (compared.pairing, compared.beta_ratio, compared.beta_p_value) == ("paired", 1.0, 1.0)
    with pytest.raises(dd.errors.DondoloError, match="bootstrap: needs the stripes"):
        low.bootstrap()
    with pytest.raises(dd.errors.InputError, match=r"edp_thresholds = 0\.4, 0\.1: must increase strictly"):
        analysis.fit_damage_states([0.4, 0.1])
    with pytest.raises(dd.errors.InputError, match="states = 'both'"):
        analysis.fit_damage_states(STATES, states="both")
    with pytest.raises(dd.errors.InputError, match="edp_thresholds: must be given"):
        analysis.fit_damage_states([])
    ax = analysis.plot_damage_states(edp_thresholds=STATES, states="ordinal")
    assert sum(f"β = {low.beta:.3g}" in text.get_text() for text in ax.get_legend().get_texts()) == 3


def test_executable(run, root, tmp_path):
    """The same curves as a case, read back, and in its table; not for a population."""
    text = (root / "data/cases/parapet.nml").read_text().replace("../records", str(root / "data/records"))
    case = tmp_path / "case.nml"
    case.write_text(
        text.replace("levels = 0.15, ", "edp_thresholds = 0.1, 0.4\n   states = 'ordinal'\n   levels = 0.15, ")
    )
    finished = run(case)
    assert finished.returncode == 0, finished.stderr
    results = dd.run_case(case, progress=False)
    stored = dd.read_results(tmp_path / "out/parapet")
    curves = results.stripes.fit_damage_states(STATES, states="ordinal")
    with (tmp_path / "out/parapet_fragility.csv").open() as file:
        table = list(csv.DictReader(line for line in file if not line.startswith("#")))
    for row, curve in zip(table, curves, strict=True):
        for name in ("theta", "beta", "se_ln_theta", "se_beta", "log_likelihood"):
            assert float(row[name]) == pytest.approx(getattr(curve, name), rel=1e-13)
        assert row["errors"] == "clustered"
    assert len({row["beta"] for row in table}) == 1
    assert stored.states == results.case.states == "ordinal"
    assert stored.fragility.theta == results.fragility.theta == curves[-1].theta != results.stripes.fit().theta
    report = tmp_path / "report.html"
    dd.report(stored, report)
    assert report.read_text().count(f"{curves[0].beta:.4g}") >= 3
    text = (root / "data/cases/population.nml").read_text().replace("../", f"{root}/data/")
    case.write_text(text.replace("levels =", "states = 'ordinal'\n   levels ="))
    wrong = run("--check", case)
    assert wrong.returncode == 2
    assert "states = 'ordinal': must be 'separate' for task = 'typology'" in wrong.stderr
