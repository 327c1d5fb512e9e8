"""How well a lognormal fits: deviance by every route, its bootstrap, fits to fewer levels, and the logistic curve."""

import numpy as np
import pytest
from scipy.stats import chi2, norm

import dondolo as dd
from dondolo.curves.goodness import _true_outcomes

LEVELS = np.array([0.2, 0.3, 0.4, 0.6, 0.8])
COLLAPSES = np.array([3, 8, 20, 31, 41])


def stripes_of(rng, n_clusters, levels, *, two_modes=False, noise=0.1):
    """Outcomes of two histories of each cluster: capacities about 1 with beta 0.4, or of two kinds of records."""
    between, within = rng.standard_normal((n_clusters, 1)), rng.standard_normal((n_clusters, 2))
    capacity = np.sqrt(0.5) * (between + within)
    if two_modes:
        capacity = 0.35 * capacity + np.where(rng.random((n_clusters, 1)) < 0.5, -1.0, 1.0)
    blurred = np.sqrt(1.0 - noise) * capacity.reshape(-1, 1) + np.sqrt(noise) * rng.standard_normal(
        (2 * n_clusters, len(levels))
    )
    return (0.4 * blurred <= np.log(levels)).astype(float)


def curve_of(outcomes, levels):
    records = [f"record {i // 2}" for i in range(len(outcomes))]
    return dd.fit_fragility(levels, outcomes.T, records=records)


def regression(levels, collapses, histories, link):
    sm = pytest.importorskip("statsmodels.api")
    family = sm.families.Binomial(link=getattr(sm.families.links, link)())
    counts = np.column_stack([collapses, histories - collapses])
    return sm.GLM(counts, sm.add_constant(np.log(levels)), family=family).fit(tol=1e-14)


def test_deviance_is_that_of_a_probit_regression():
    curve = dd.fit_fragility(LEVELS, COLLAPSES, 44)
    found = regression(LEVELS, COLLAPSES, 44, "Probit")
    assert curve.deviance == pytest.approx(found.deviance, rel=1e-9)
    assert curve.deviance_dof == found.df_resid == 3
    fit = curve.goodness_of_fit()
    assert fit.independent_p_value == pytest.approx(chi2.sf(found.deviance, 3), rel=1e-9)
    assert fit.residuals == pytest.approx(found.resid_pearson, rel=1e-7)
    assert np.isnan(fit.p_value)
    # Levels at which nothing ran take no part.
    more = dd.fit_fragility([*LEVELS, 1.0], [*COLLAPSES, 0], [44] * 5 + [0])
    assert (more.deviance, more.deviance_dof) == (curve.deviance, 3)
    assert len(more.goodness_of_fit().residuals) == 5


def test_logistic_curve_is_that_of_statsmodels():
    """Parameters, naive errors, deviance; standard errors by clusters against the definition, cluster by cluster."""
    curve = dd.fit_fragility(LEVELS, COLLAPSES, 44).logit()
    found = regression(LEVELS, COLLAPSES, 44, "Logit")
    assert [curve.b0, curve.b1] == pytest.approx(found.params, rel=1e-9)
    assert [curve.se_b0, curve.se_b1] == pytest.approx(found.bse, rel=1e-8)
    assert curve.deviance == pytest.approx(found.deviance, rel=1e-8)
    assert (curve.errors, curve.degrees_of_freedom) == ("naive", np.inf)
    assert curve.theta == pytest.approx(curve.ppf(0.5), rel=1e-12)
    low, high = curve.interval(curve.theta)
    assert low < 0.5 < high

    outcomes = stripes_of(np.random.default_rng(1), 22, LEVELS * 2.5)
    logit = curve_of(outcomes, LEVELS * 2.5).logit()
    design = np.stack([np.ones(5), np.log(LEVELS * 2.5)])
    p = logit(LEVELS * 2.5)
    parts = [2 * (design * (p * (1 - p))) @ design.T for _ in range(22)]
    whole, covariance = sum(parts), np.zeros((2, 2))
    for i in range(22):
        score = design @ (outcomes[2 * i : 2 * i + 2] - p).sum(axis=0)
        change = np.linalg.solve(whole - parts[i], score)
        covariance += np.outer(change, change)
    assert logit.covariance == pytest.approx(covariance, rel=1e-9)
    assert (logit.errors, logit.degrees_of_freedom) == ("clustered", 21)


@pytest.mark.parametrize(
    ("collapses", "status"),
    [([0, 0, 0], "none"), ([9, 9, 9], "all"), ([0, 0, 9], "separated"), ([6, 4, 2], "decreasing")],
)
def test_a_logistic_curve_that_is_none(collapses, status):
    curve = dd.fit_fragility([0.2, 0.4, 0.6], collapses, 9).logit()
    assert curve.status == status
    assert np.isnan(curve.b1)


def test_every_route_has_the_deviance(root, tmp_path):
    """Tables of the executable, results in memory and read back, and what Python writes."""
    results = dd.run_case(root / "data/cases/parapet.nml", progress=False)
    results.write_results(tmp_path / "parapet")
    back = dd.read_results(tmp_path / "parapet")
    frame = (tmp_path / "parapet_fragility.csv").read_text().splitlines()
    head, row = frame[-2].split(","), frame[-1].split(",")
    cells = dict(zip(head, row, strict=True))
    for curve in (results.fragility, back.fragility, results.stripes.fit()):
        assert curve.deviance == float(cells["deviance"])
        assert curve.deviance_dof == int(cells["deviance_dof"]) == len(results.stripes.levels) - 2
    results.fragility.to_csv(tmp_path / "one.csv")
    assert (tmp_path / "one.csv").read_text().splitlines()[-1].split(",")[-2:] == row[-2:]


def test_ordinal_states_share_a_deviance():
    """That of the multinomial of all states: against its definition."""
    stripes = dd.multiple_stripe(dd.OneSidedWall(1.5, 0.25), dd.example_records(), [0.6, 0.8, 1.0, 1.2], progress=False)
    curves = stripes.fit_damage_states([0.3, 1.0], states="ordinal")
    reached = np.array([stripes.exceedances(0.3), stripes.collapses])
    n = stripes.histories
    fractions = np.array([n - reached[0], reached[0] - reached[1], reached[1]]) / n
    chance = np.array([1 - curves[0](stripes.levels), curves[0](stripes.levels) - curves[1](stripes.levels)])
    chance = np.vstack([chance, curves[1](stripes.levels)])
    with np.errstate(divide="ignore", invalid="ignore"):
        expected = 2 * np.nansum(n * fractions * np.log(fractions / chance))
    assert [one.deviance for one in curves] == pytest.approx([expected] * 2, rel=1e-7)
    assert {one.deviance_dof for one in curves} == {2 * 4 - 3}
    with pytest.raises(dd.errors.DondoloError, match="fitted together"):
        curves[0].goodness_of_fit(n_resamples=10)


def test_histories_of_which_the_curve_is_true():
    """The fractions are the curve's, as few outcomes as that takes are changed, and none of one that did not run."""
    levels = np.linspace(0.5, 1.8, 8)
    outcomes = stripes_of(np.random.default_rng(3), 22, levels)
    outcomes[::7, :3] = np.nan
    curve = curve_of(outcomes, levels)
    ran, fitted = curve.sample.ran, curve(levels)
    chance = _true_outcomes(curve.sample, fitted, np.random.default_rng(0))
    assert (chance * ran).sum(axis=1) / ran.sum(axis=1) == pytest.approx(fitted, abs=1e-12)
    assert np.all(chance[~ran] == 0.0)
    assert np.all((chance >= 0.0) & (chance <= 1.0))
    assert np.all(((chance > 0.0) & (chance < 1.0)).sum(axis=1) <= 1)
    changed = np.abs(chance - curve.sample.collapsed)[ran].sum()
    assert changed == pytest.approx(np.abs(curve.collapses - fitted * curve.histories).sum(), abs=1e-9)


def test_bootstrap_of_the_deviance():
    levels = np.linspace(0.5, 1.8, 10)
    rng = np.random.default_rng(5)
    good = curve_of(stripes_of(rng, 44, levels), levels)
    first, again = (good.goodness_of_fit(n_resamples=199) for _ in range(2))
    assert first.p_value == again.p_value
    assert first.p_value > 0.05
    assert (first.resampled, first.n_resamples) == ("clusters", 199)
    bad = curve_of(stripes_of(rng, 44, levels, two_modes=True), levels).goodness_of_fit(n_resamples=199)
    assert bad.p_value < 0.02
    counts = dd.fit_fragility(LEVELS, COLLAPSES, 44).goodness_of_fit(n_resamples=999)
    assert counts.resampled == "histories"
    # Counts are independent: chi-square is nearly right.
    assert counts.p_value == pytest.approx(counts.independent_p_value, abs=0.08)
    with pytest.raises(dd.errors.DondoloError, match="weighted counts"):
        dd.fit_fragility(LEVELS, COLLAPSES + 0.5, 44).goodness_of_fit(n_resamples=9)
    with pytest.raises(dd.errors.DondoloError, match="not fitted"):
        dd.Fragility.of_parameters(0.8, 0.4).goodness_of_fit()


@pytest.mark.slow
def test_p_values_are_uniform_under_a_lognormal():
    """One in ten is below 0.1, within three standard errors; by chi-square none is, and a wrong curve is not found."""
    levels = np.exp(0.4 * np.linspace(-1.6, 1.6, 10))
    rng = np.random.default_rng(11)
    found = []
    for _ in range(150):
        fit = curve_of(stripes_of(rng, 22, levels), levels).goodness_of_fit(n_resamples=99, rng=rng)
        found.append((fit.p_value, fit.independent_p_value))
    p, independent = np.array(found).T
    assert abs(np.mean(p <= 0.1) - 0.1) < 3.0 * np.sqrt(0.09 / 150)
    assert abs(np.mean(p) - 0.5) < 0.1
    assert np.mean(independent) > 0.7
    assert np.mean(independent < 0.1) < 0.03


def test_fits_to_a_range_of_levels():
    outcomes = stripes_of(np.random.default_rng(7), 22, LEVELS * 2.5)
    curve = curve_of(outcomes, LEVELS * 2.5)
    part = curve.refit(low=0.6, high=1.6)
    direct = curve_of(outcomes[:, 1:4], LEVELS[1:4] * 2.5)
    assert (part.theta, part.beta, part.clusters) == (direct.theta, direct.beta, 22)
    assert np.array_equal(part.covariance, direct.covariance)
    assert curve.refit().theta == curve.theta
    assert norm.cdf(np.log(1.0 / part.theta) / part.beta) == pytest.approx(part(1.0))
    with pytest.raises(dd.errors.InputError, match="no levels between"):
        curve.refit(low=9.0)
