"""Fits and their intervals, against SciPy and statsmodels."""

import dataclasses
import warnings

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from refusals import refused
from scipy import optimize, stats

import dondolo as dd
from dondolo._fortran.curves import student_quantile
from dondolo.curves.bootstrap import draw_records

PUBLIC = (
    [0.178, 0.274, 0.444, 0.56, 0.652, 0.79, 0.982, 1.246, 1.564, 2.014, 2.417, 3.021, 3.625, 4.028, 4.431, 5.035],
    [0, 0, 0, 0, 0, 4, 13, 23, 38, 41, 44, 45, 45, 45, 45, 45],
    45,
)


def scipy_fit(levels, collapses, histories):
    """The same maximum by a simplex and Newton's method in SciPy."""

    def cost(parameters):
        p = stats.norm.cdf((np.log(levels) - parameters[0]) / np.exp(parameters[1]))
        return -stats.binom.logpmf(collapses, histories, np.clip(p, 1e-300, 1.0 - 1e-16)).sum()

    options = {"xatol": 1e-11, "fatol": 1e-13, "maxiter": 10000, "maxfev": 10000}
    start = [np.log(np.median(levels)), np.log(0.4)]
    found = optimize.minimize(cost, start, method="Nelder-Mead", options=options)
    return np.exp(found.x), found.fun


def statsmodels_fit(levels, collapses, histories):
    """Probit regression; standard errors of ln theta and beta by the delta method."""
    api = pytest.importorskip("statsmodels.api")
    counts = np.column_stack([collapses, np.asarray(histories) - collapses])
    design = api.add_constant(np.log(levels))
    model = api.GLM(counts, design, family=api.families.Binomial(link=api.families.links.Probit()))
    result = model.fit(tol=1e-14, maxiter=300)
    b0, b1 = result.params
    jacobian = np.array([[-1.0 / b1, b0 / b1**2], [0.0, -1.0 / b1**2]])
    errors = np.sqrt(np.diag(jacobian @ result.cov_params() @ jacobian.T))
    return np.exp(-b0 / b1), 1.0 / b1, *errors


def test_public_data():
    curve = dd.fit_fragility(*PUBLIC)
    assert curve.theta == pytest.approx(1.2194475, abs=1e-7)
    assert curve.beta == pytest.approx(0.3100660, abs=1e-7)
    assert curve.log_likelihood == pytest.approx(-12.8704444, abs=1e-7)
    assert curve.se_ln_theta == pytest.approx(0.02926, abs=5e-6)
    assert curve.se_beta == pytest.approx(0.02532, abs=5e-6)
    assert curve.status == "ok"


def test_two_stripes_in_closed_form():
    curve = dd.fit_fragility([0.2, 0.4], [11, 33], 44)
    assert curve.theta == pytest.approx(np.sqrt(0.08), rel=1e-12)
    assert curve.beta == pytest.approx(np.log(2.0) / (2.0 * stats.norm.ppf(0.75)), rel=1e-12)


def test_extrapolation_warns():
    with pytest.warns(
        dd.errors.DondoloWarning, match=r"5.86 lies outside the levels 1 to 2: the fit extrapolates, higher levels are"
    ):
        curve = dd.fit_fragility([1.0, 1.5, 2.0], [0, 2, 2], [59, 50, 44])
    assert curve.status == "extrapolated"
    assert (curve.theta, curve.beta) == (pytest.approx(5.85981, abs=1e-5), pytest.approx(0.684495, abs=1e-6))


def test_counts_that_hardly_rise_warn():
    with pytest.warns(dd.errors.DondoloWarning, match="collapses hardly become more frequent with the level") as caught:
        curve = dd.fit_fragility([0.15, 0.3, 0.45, 0.6, 0.75], [14, 16, 15, 14, 17], 30)
    assert (curve.status, curve.has_fit) == ("nearly_flat", True)
    assert curve.beta > 5.0
    warning = caught[0].message
    assert (warning.code, warning.numbers["beta"], warning.subject) == ("nearly_flat", curve.beta, {})
    # The curve is the one of maximum likelihood, whatever its status
    peak = stats.binom.logpmf([14, 16, 15, 14, 17], 30, curve(curve.levels)).sum()
    assert curve.log_likelihood == pytest.approx(peak, abs=1e-9)
    ratio = 2.0 * (peak - stats.binom.logpmf([14, 16, 15, 14, 17], 30, 76 / 150).sum())
    assert ratio < stats.chi2.ppf(0.95, 1)
    assert dd.fit_fragility([0.15, 0.3, 0.45, 0.6, 0.75], [8, 12, 15, 18, 22], 30).status == "ok"


def test_fractions_in_place_of_counts_are_refused():
    with pytest.raises(dd.errors.InputError, match="collapses: look like fractions of the histories") as caught:
        dd.fit_fragility([0.2, 0.4, 0.6], [0.1, 0.5, 1.0], 44)
    assert [(one.code, one.variable) for one in caught.value.errors] == [("out_of_range", "collapses")]
    counted = dd.fit_fragility([0.2, 0.4, 0.6], [4.4, 22.0, 40.5], 44)
    assert counted.has_fit
    weighted = dd.fit_fragility([0.2, 0.4, 0.6], counted.collapses / 44.0, 1.0)
    assert weighted.theta == pytest.approx(counted.theta, rel=1e-9)


@pytest.mark.parametrize(
    ("collapses", "status", "bracket"),
    [
        ([0, 0, 0], "no_collapse", (3.0, np.inf)),
        ([44, 44, 44], "all_collapse", (0.0, 1.0)),
        ([0, 0, 44], "separated", (2.0, 3.0)),
        ([0, 5, 44], "separated", (2.0, 3.0)),
        ([0, 0, 5], "separated", (3.0, np.inf)),
        ([30, 20, 10], "decreasing", (3.0, 1.0)),
    ],
)
def test_no_fit(collapses, status, bracket):
    curve = dd.fit_fragility([1.0, 2.0, 3.0], collapses, 44)
    assert (curve.status, curve.bracket, curve.has_fit) == (status, bracket, False)
    assert np.isnan([curve.theta, curve.beta, curve.log_likelihood, curve.se_beta]).all()
    for use in (lambda: curve(1.0), lambda: curve.interval(1.0), curve.parameter_interval, curve.bootstrap):
        with pytest.raises(dd.errors.DondoloError, match=f"no curve was fitted .status '{status}'."):
            use()
    assert status in repr(curve)


@pytest.mark.parametrize(
    ("levels", "collapses", "histories", "words"),
    [
        ([], [], [], "levels"),
        ([0.1, 0.2], [1], 4, "2 levels, 1 collapses, 2 histories"),
        ([0.1, 0.2], [1, 5], 4, "collapses = 5: must lie between 0 and the histories, 4"),
        ([-0.1, 0.2], [1, 2], 4, "levels = -0.1: must be positive"),
        ([0.1, 0.2], [1, np.nan], 4, "collapses = NaN"),
    ],
)
def test_wrong_counts(levels, collapses, histories, words):
    with pytest.raises(dd.errors.InputError, match=words):
        dd.fit_fragility(levels, collapses, histories)


@settings(max_examples=40, deadline=None)
@given(
    theta=st.floats(0.05, 5.0),
    beta=st.floats(0.2, 0.8),
    number=st.integers(4, 12),
    histories=st.integers(20, 200),
    seed=st.integers(0, 2**32 - 1),
)
def test_random_stripes(theta, beta, number, histories, seed):
    levels = theta * np.exp(beta * np.linspace(-1.8, 1.8, number))
    p = stats.norm.cdf(np.log(levels / theta) / beta)
    collapses = np.random.default_rng(seed).binomial(histories, p)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", dd.errors.DondoloWarning)
        curve = dd.fit_fragility(levels, collapses, histories)
    if not curve.has_fit:
        return
    expected = statsmodels_fit(levels, collapses, np.full(number, histories))
    assert (curve.theta, curve.beta, curve.se_ln_theta, curve.se_beta) == pytest.approx(expected, rel=1e-6)
    found, height = scipy_fit(levels, collapses, histories)
    assert (curve.theta, curve.beta) == pytest.approx(found, rel=1e-6)
    assert curve.log_likelihood == pytest.approx(-height, abs=1e-8)


def test_public_data_against_statsmodels():
    curve = dd.fit_fragility(*PUBLIC)
    expected = statsmodels_fit(np.array(PUBLIC[0]), np.array(PUBLIC[1]), np.full(16, 45))
    assert (curve.theta, curve.beta, curve.se_ln_theta, curve.se_beta) == pytest.approx(expected, rel=1e-6)


def test_probability():
    curve = dd.fit_fragility(*PUBLIC)
    x = np.array([[0.0, 0.5], [curve.theta, 9.0]])
    with np.errstate(divide="ignore"):
        expected = stats.norm.cdf(np.log(x / curve.theta) / curve.beta)
    assert curve(x) == pytest.approx(expected, rel=1e-13)
    assert curve(x).shape == (2, 2)
    assert isinstance(curve(1.0), float)
    for wrong in (-1.0, np.nan, "high"):
        with pytest.raises(dd.errors.InputError):
            curve(wrong)


def test_intervals_from_counts():
    curve = dd.fit_fragility(*PUBLIC)
    low, high = curve.interval(curve.theta, confidence=0.95)
    half = stats.norm.ppf(0.975) * curve.se_ln_theta / curve.beta
    assert (low, high) == pytest.approx((stats.norm.cdf(-half), stats.norm.cdf(half)), rel=1e-12)
    ends = curve.parameter_interval()["theta"]
    assert np.log(ends[1] / ends[0]) == pytest.approx(2.0 * stats.norm.ppf(0.975) * curve.se_ln_theta, rel=1e-12)
    x = np.array([0.5, 1.0, 2.0])
    low, high = curve.interval(x)
    assert np.all(low < curve(x))
    assert np.all(curve(x) < high)
    # That of beta is symmetric in the slope of the regression.
    low, high = curve.parameter_interval()["beta"]
    assert (1.0 / low + 1.0 / high) / 2.0 == pytest.approx(1.0 / curve.beta, rel=1e-12)
    assert 1.0 / low - 1.0 / high == pytest.approx(
        2.0 * stats.norm.ppf(0.975) * curve.se_beta / curve.beta**2, rel=1e-12
    )
    assert (curve.errors, curve.clusters, curve.degrees_of_freedom) == ("naive", 0, np.inf)
    assert "as if all histories were independent" in repr(curve)


@pytest.mark.parametrize("level", [0.5, 0.95])
def test_delta_interval_is_that_of_a_probit_regression(level):
    """Also far from the median, where the covariance of theta and beta matters."""
    api = pytest.importorskip("statsmodels.api")
    levels, collapses = np.array([0.2, 0.3, 0.5, 0.8]), np.array([1, 2, 4, 17])
    curve = dd.fit_fragility(levels, collapses, 20)
    correlation = curve.covariance[0, 1] / (curve.se_ln_theta * curve.se_beta)
    assert abs(correlation) > 0.2
    family = api.families.Binomial(link=api.families.links.Probit())
    model = api.GLM(np.column_stack([collapses, 20 - collapses]), api.add_constant(np.log(levels)), family=family)
    x = np.array([0.05, 0.2, 0.6, 3.0])
    predicted = model.fit(tol=1e-14, maxiter=300).get_prediction(api.add_constant(np.log(x)))
    found = np.transpose(curve.interval(x, confidence=level))
    assert found == pytest.approx(predicted.conf_int(alpha=1.0 - level), rel=1e-6)


@pytest.mark.parametrize("degrees", [1.0, 2.0, 21.0, 859.0])
@pytest.mark.parametrize("level", [0.5, 0.9, 0.95, 0.99])
def test_quantiles_of_students_t(degrees, level):
    upper = 0.5 + 0.5 * level
    # SciPy 1.15 is off by 6e-11 where a closed form exists.
    closed = {
        1.0: np.tan(0.5 * np.pi * level),
        2.0: level / np.sqrt(2.0 * upper * (1.0 - upper)),
    }
    expected = closed.get(degrees) or stats.t.ppf(upper, degrees)
    assert student_quantile(upper, degrees) == pytest.approx(expected, rel=1e-11)


def test_confidence_next_to_certainty():
    """An interval, not an error, for the largest number below 1."""
    curve = dd.fit_fragility([1.0, 2.0, 3.0], [4, 9, 16], 20)
    low, high = curve.parameter_interval(confidence=np.nextafter(1.0, 0.0))["theta"]
    assert 0.0 < low < curve.parameter_interval(confidence=0.999999)["theta"][0] < high < np.inf


def test_weak_data_leave_beta_open():
    curve = dd.fit_fragility([1.0, 2.0, 3.0], [4, 5, 6], 10)
    assert curve.parameter_interval()["beta"][1] == np.inf


@pytest.mark.parametrize("level", [0.0, 1.0, -0.1, np.nan])
def test_wrong_confidence(level):
    with pytest.raises(dd.errors.InputError, match="confidence"):
        dd.fit_fragility(*PUBLIC).interval(1.0, confidence=level)


def test_bootstrap(stripes):
    curve = stripes.fit(events=range(44))
    boot = curve.bootstrap(n_resamples=4000, rng=1)
    again = curve.bootstrap(n_resamples=4000, rng=1)
    assert np.array_equal(boot.theta, again.theta, equal_nan=True)
    assert not np.array_equal(boot.theta, curve.bootstrap(n_resamples=4000, rng=2).theta, equal_nan=True)
    assert boot.without_fit < 0.01
    low, high = boot.parameter_interval(confidence=0.95)["theta"]
    assert low < curve.theta < high
    ends = boot.interval(np.array([0.5, curve.theta]))
    assert ends[0].shape == (2,)
    assert ends[0][1] < 0.5 < ends[1][1]
    # One sample by hand
    random = np.random.default_rng(1)
    times = random.multinomial(44, np.full(44, 1.0 / 44.0), size=4000)[7]
    by_hand = dd.fit_fragility(stripes.levels, stripes.collapsed @ times, 44)
    assert boot.theta[7] == pytest.approx(by_hand.theta, rel=1e-12)


def test_bootstrap_needs_stripes():
    with pytest.raises(dd.errors.DondoloError, match="needs the stripes"):
        dd.fit_fragility(*PUBLIC).bootstrap()


def jackknife(stripes, events):
    """Covariance of ln theta and beta from the sum over fits that leave out one event each."""
    whole = stripes.fit()
    changes = []
    for event in dict.fromkeys(events):
        kept = np.array([own != event for own in events])[stripes.record_index]
        one = dd.fit_fragility(stripes.levels, stripes.collapsed[:, kept].sum(axis=1), kept.sum())
        changes.append([np.log(one.theta / whole.theta), one.beta - whole.beta])
    return np.transpose(changes) @ np.array(changes)


@pytest.mark.parametrize("polarity", ["as_recorded", "both"])
def test_clustered_covariance_is_that_of_fits_without_each_event(wall, records, polarity):
    """To first order; the records know their events, and labels of one's own take their place."""
    stripes = dd.multiple_stripe(wall, records, [0.4, 0.5, 0.65, 0.8, 1.0], polarity=polarity, progress=False)
    curve = stripes.fit()
    events = [record.event for record in records]
    assert (curve.errors, curve.clusters, curve.degrees_of_freedom) == ("clustered", 22, 21.0)
    assert np.diag(curve.covariance) == pytest.approx(np.diag(jackknife(stripes, events)), rel=0.25)
    labels = [i % 11 for i in range(44)]
    other = stripes.fit(events=labels)
    assert (other.clusters, other.theta, other.beta) == (11, curve.theta, curve.beta)
    assert np.diag(other.covariance) == pytest.approx(np.diag(jackknife(stripes, labels)), rel=0.35)
    assert curve.naive_covariance == pytest.approx(other.naive_covariance)
    assert "22 clusters of records" in repr(curve)
    # Student's quantile, not the normal one
    ends = curve.parameter_interval()["theta"]
    assert np.log(ends[1] / ends[0]) == pytest.approx(2.0 * stats.t(21).ppf(0.975) * curve.se_ln_theta, rel=1e-10)
    _, high = curve.interval(curve.theta)
    assert stats.norm.ppf(high) == pytest.approx(stats.t(21).ppf(0.975) * curve.se_ln_theta / curve.beta, rel=1e-10)


def test_clustered_covariance_agrees_with_statsmodels(stripes):
    """Up to the correction, which of clusters of one size is the factor (g/(g - 1))^2."""
    api = pytest.importorskip("statsmodels.api")
    curve = stripes.fit()
    flags = stripes.collapsed.T.ravel().astype(float)
    groups = np.repeat(np.arange(44) // 2, len(stripes.levels))
    design = api.add_constant(np.tile(np.log(stripes.levels), 44))
    family = api.families.Binomial(link=api.families.links.Probit())
    correction = {"groups": groups, "use_correction": False}
    fit = api.GLM(flags, design, family=family).fit(tol=1e-14, maxiter=300, cov_type="cluster", cov_kwds=correction)
    b0, b1 = fit.params
    jacobian = np.array([[-1.0 / b1, b0 / b1**2], [0.0, -1.0 / b1**2]])
    expected = jacobian @ fit.cov_params() @ jacobian.T * (22.0 / 21.0) ** 2
    # Its sandwich has the observed information, ours the expected one.
    assert curve.covariance == pytest.approx(expected, rel=0.1)


def test_too_few_clusters_have_no_standard_errors(stripes):
    curve = stripes.fit(events=[i % 2 for i in range(44)])
    assert (curve.errors, curve.clusters) == ("few_clusters", 2)
    assert np.isnan(curve.covariance).all()
    assert np.isfinite(curve.naive_covariance).all()
    assert "fewer than three clusters" in repr(curve)
    assert "nan" not in repr(curve)
    for use in (lambda: curve.interval(1.0), curve.parameter_interval, lambda: curve.compare(curve)):
        with pytest.raises(dd.errors.DondoloError, match="no standard errors: fewer than three clusters of records"):
            use()
    assert curve.to_frame().loc[0, ["se_ln_theta", "theta_low"]].isna().all()


def test_paired_comparison(stripes, wall, records):
    """Curves on the same records: the variance of the difference, not the sum of variances."""
    curve = stripes.fit()
    same = curve.compare(curve)
    assert (same.pairing, same.shared, same.ratio, same.p_value, same.curves_p_value) == ("paired", 22, 1.0, 1.0, 1.0)
    other = dd.multiple_stripe(dd.OneSidedWall(2.5, 0.25), records, stripes.levels, progress=False).fit()
    pair = curve.compare(other, confidence=0.9)
    changes = [one.parts[0].changes / [1.0, one.beta] for one in (curve, other)]
    difference = changes[0] - changes[1]
    covariance = difference.T @ difference
    value = np.log([curve.theta / other.theta, curve.beta / other.beta])
    spread = stats.t(21)
    assert pair.ratio_interval == pytest.approx(
        np.exp(value[0] + np.array(spread.interval(0.9)) * covariance[0, 0] ** 0.5)
    )
    assert pair.p_value == pytest.approx(2.0 * spread.sf(abs(value[0]) / covariance[0, 0] ** 0.5))
    assert pair.beta_p_value == pytest.approx(2.0 * spread.sf(abs(value[1]) / covariance[1, 1] ** 0.5))
    squared = value @ np.linalg.inv(covariance) @ value
    assert pair.curves_p_value == pytest.approx(stats.f(2, 20).sf(squared * 20.0 / 42.0))
    # Nothing depends on the order of the records, and less on chance than curves of other records do.
    turned = dd.multiple_stripe(wall, records[::-1], stripes.levels, progress=False).fit()
    assert turned.compare(other, confidence=0.9) == dataclasses.replace(
        pair, **{name: pytest.approx(getattr(pair, name), rel=1e-9) for name in NUMBERS}
    )
    apart = stripes.fit(events=range(44)).compare(other)
    assert (apart.pairing, apart.shared) == ("unpaired", 0)
    width = [np.log(one.ratio_interval[1] / one.ratio_interval[0]) for one in (curve.compare(other), apart)]
    assert width[0] < 0.8 * width[1]


NUMBERS = ("ratio", "ratio_interval", "p_value", "beta_ratio", "beta_interval", "beta_p_value", "curves_p_value")


def test_records_are_recognised_by_their_content(wall, records):
    """Not by their names; of records without events each is one."""
    plain = [dd.Record(record.acceleration, record.dt, name=f"{i}") for i, record in enumerate(records)]
    named = [dd.Record(record.acceleration, record.dt) for record in plain]
    levels = [0.4, 0.6, 0.8, 1.0, 1.2]
    several = plain, named[::-1], plain[:30], plain[14:]
    curves = [dd.multiple_stripe(wall, some, levels, progress=False).fit() for some in several]
    for pair, pairing, shared in (((0, 1), "paired", 44), ((2, 3), "partly", 16), ((0, 2), "partly", 30)):
        found = curves[pair[0]].compare(curves[pair[1]])
        assert (found.pairing, found.shared) == (pairing, shared)
    halves = [dd.multiple_stripe(wall, some, levels, progress=False).fit() for some in (plain[:22], plain[22:])]
    apart = halves[0].compare(halves[1])
    assert (apart.pairing, apart.shared) == ("unpaired", 0)
    # Welch and Satterthwaite
    variances = np.array([half.se_ln_theta**2 for half in halves])
    degrees = variances.sum() ** 2 / (variances**2 / 21.0).sum()
    assert apart.degrees_of_freedom == pytest.approx(degrees)
    ends = np.exp(np.log(apart.ratio) + np.array(stats.t(degrees).interval(0.95)) * variances.sum() ** 0.5)
    assert apart.ratio_interval == pytest.approx(ends)


def test_wrong_comparisons(stripes):
    curve, counts = stripes.fit(), dd.fit_fragility(*PUBLIC, im="pga")
    with pytest.raises(dd.errors.InputError, match="standard errors: clustered and naive: both must be of one kind"):
        curve.compare(counts)
    with refused("wrong_type", "other"):
        curve.compare("curve")
    with pytest.raises(dd.errors.InputError, match="im = 'pga' and '': must be the same"):
        counts.compare(dd.fit_fragility(*PUBLIC))


def test_comparison_of_counts():
    """The variances of ln theta of independent curves add up."""
    one, other = ([0.2, 0.4, 0.8], [3, 20, 38], 44), ([0.2, 0.4, 0.8], [1, 7, 15], 20)
    pair = dd.fit_fragility(*one).compare(dd.fit_fragility(*other), confidence=0.9)
    fits = [statsmodels_fit(np.array(x), np.array(z), np.full(3, n)) for x, z, n in (one, other)]
    ratio = stats.norm(np.log(fits[0][0] / fits[1][0]), np.sqrt(fits[0][2] ** 2 + fits[1][2] ** 2))
    assert (pair.pairing, pair.degrees_of_freedom) == ("naive", np.inf)
    assert pair.ratio == pytest.approx(np.exp(ratio.mean()), rel=1e-6)
    assert pair.ratio_interval == pytest.approx(np.exp(ratio.interval(0.9)), rel=1e-6)


def test_bootstrap_of_events_of_unequal_size(stripes):
    """Each sample has both of two events or one of them twice, so that it has one of three curves."""
    parts = [slice(None), slice(30), slice(30, None)]
    fits = []
    for part in parts:
        collapsed = stripes.collapsed[:, part]
        fits.append(statsmodels_fit(stripes.levels, collapsed.sum(axis=1), np.full(6, collapsed.shape[1]))[:2])
    boot = stripes.fit().bootstrap(n_resamples=400, rng=3, events=[0] * 30 + [1] * 14)
    found = np.column_stack([boot.theta, boot.beta])
    off = np.abs(found[:, None] / np.array(fits) - 1.0).max(axis=2)
    assert off.min(axis=1).max() < 1e-6
    often = np.bincount(off.argmin(axis=1), minlength=3)
    assert stats.chisquare(often, [200, 100, 100]).pvalue > 0.01


def test_bootstrap_goes_by_records_and_not_by_names(wall, few):
    """Records without names of their own are still different records."""
    levels = [0.4, 0.6, 0.8, 1.0, 1.2]
    few = [dd.Record(record.acceleration, record.dt, name=record.name) for record in few]
    nameless = [dd.Record(record.acceleration, record.dt) for record in few]
    curves = [
        dd.multiple_stripe(wall, records, levels, polarity="both", progress=False).fit() for records in (few, nameless)
    ]
    named, unnamed = (curve.bootstrap(n_resamples=200, rng=3) for curve in curves)
    np.testing.assert_array_equal(named.theta, unnamed.theta)
    assert np.nanstd(unnamed.theta) > 0.0


@pytest.mark.parametrize("polarity", ["as_recorded", "both"])
def test_events_are_drawn_together(wall, few, polarity):
    """Records told twice are no more evidence than told once, unless it is said that they do not belong together."""
    levels = [0.4, 0.6, 0.8, 1.0, 1.2]
    # Without their events
    few = [dd.Record(record.acceleration, record.dt, name=record.name) for record in few]
    twice = [record for record in few for _ in range(2)]
    once, doubled = (
        dd.multiple_stripe(wall, records, levels, polarity=polarity, progress=False).fit() for records in (few, twice)
    )
    plain, known = once.bootstrap(n_resamples=300, rng=3), doubled.bootstrap(n_resamples=300, rng=3)
    together = doubled.bootstrap(n_resamples=300, rng=3, events=[i // 2 for i in range(len(twice))])
    alone = doubled.bootstrap(n_resamples=300, rng=3, events=range(len(twice)))
    np.testing.assert_allclose(together.theta, plain.theta, rtol=1e-12)
    np.testing.assert_allclose(known.theta, plain.theta, rtol=1e-12)
    np.testing.assert_allclose(doubled.covariance, once.covariance, rtol=1e-9)
    assert (doubled.clusters, doubled.errors) == (once.clusters, once.errors)
    assert np.nanstd(np.log(alone.theta)) < 0.8 * np.nanstd(np.log(plain.theta))
    own_names = once.bootstrap(n_resamples=300, rng=3, events=[f"event {i}" for i in range(len(few))])
    np.testing.assert_array_equal(own_names.theta, plain.theta)
    with pytest.raises(dd.errors.InputError, match=f"events: 1 labels for {len(few)} records: must be as many"):
        once.bootstrap(n_resamples=5, events=["a"])


@pytest.mark.parametrize(
    ("events", "sentence"),
    [
        (lambda n: [0] * n, "events: at least two are needed to draw from, there is 1"),
        (lambda n: ["a"] * (n - 1) + [""], "= '': must be a name or a number"),
        (lambda n: [None] * n, "events: label 1 = None: must be a name or a number"),
        (lambda n: [float("nan")] * n, "events: label 1 = nan: must be a name or a number"),
        (lambda n: [[1]] * n, r"events: label 1 = \[1\]: must be a name or a number"),
        (lambda n: 3, "events = 3: must be labels, one for each record"),
        (lambda n: "a" * n, "must be labels, one for each record"),
    ],
)
def test_wrong_events(stripes, events, sentence):
    """Labels that are missing would make one event of their records."""
    with pytest.raises(dd.errors.InputError, match=sentence):
        stripes.fit().bootstrap(n_resamples=5, events=events(stripes.n_records))


def test_one_record_cannot_be_drawn_from():
    with pytest.raises(dd.errors.InputError, match="records: at least two are needed to draw from, there is 1"):
        draw_records(["alone"], 5, 0)


@pytest.mark.parametrize("seed", [-1, "lucky", 1.5])
def test_wrong_seeds(stripes, seed):
    with pytest.raises(dd.errors.InputError, match=r"rng = .*: must be an integer, at least 0, a Generator or None"):
        stripes.fit().bootstrap(n_resamples=5, rng=seed)
    with pytest.raises(dd.errors.InputError, match=r"n_resamples = 0: must be an integer, at least 1"):
        stripes.fit().bootstrap(n_resamples=0)


def test_a_curve_keeps_its_counts():
    levels, collapses = np.array([0.1, 0.2, 0.3]), np.array([1.0, 4.0, 8.0])
    curve = dd.fit_fragility(levels, collapses, 10, im="pga")
    collapses[:] = 0.0
    assert curve.collapses.tolist() == [1.0, 4.0, 8.0]
    assert curve.im == "pga"
    for array in (curve.levels, curve.collapses, curve.histories, curve.covariance):
        assert not array.flags.writeable


def test_names_of_measures():
    """As hazard curves and stripes have them; a measure that dondolo does not know stays as it is."""
    assert dd.fit_fragility([0.2, 0.4], [11, 33], 44, im="SA(0.50)").im == "sa(0.5)"
    assert dd.Fragility.of_parameters(0.5, 0.4, im="PGA").im == "pga"
    assert dd.Fragility.of_parameters(0.5, 0.4, im="my measure").im == "my measure"
    assert dd.Fragility.of_parameters(0.5, 0.4).im == ""
    with pytest.raises(dd.errors.InputError, match="im = 5: must be a string"):
        dd.fit_fragility([0.2, 0.4], [11, 33], 44, im=5)


def test_fractions_that_fall_tell_no_median():
    curve = dd.fit_fragility([0.2, 0.4], [9, 3], 10)
    with pytest.raises(dd.errors.DondoloError, match=r"no curve was fitted \(status 'decreasing'\)$"):
        curve(0.3)
    assert "median" not in repr(curve)
    drawn = curve.plot().get_legend()
    assert drawn is None or not any("median" in text.get_text() for text in drawn.get_texts())
    with pytest.raises(dd.errors.DondoloError, match=r"the median lies between 0\.4 and inf"):
        dd.fit_fragility([0.2, 0.4], [0, 0], 10)(0.3)


def test_inverse():
    """Against the curve itself; its interval is that of theta at one half, and that of the delta method elsewhere."""
    curve = dd.fit_fragility([0.2, 0.4, 0.6, 0.8], [1, 8, 14, 19], 20, im="pga")
    p = np.array([[0.05, 0.5], [0.84, 0.99]])
    np.testing.assert_allclose(curve(curve.ppf(p)), p, rtol=1e-12)
    assert curve.ppf(0.5) == pytest.approx(curve.theta, rel=1e-15)
    assert (curve.ppf(0.0), curve.ppf(1.0)) == (0.0, np.inf)
    assert curve.ppf_interval(0.5, confidence=0.9) == pytest.approx(curve.parameter_interval(confidence=0.9)["theta"])
    low, high = curve.ppf_interval(p)
    assert low.shape == p.shape
    probit = stats.norm.ppf(p)
    (a, b), (_, c) = curve.covariance
    np.testing.assert_allclose(
        np.log(high / low), 2.0 * stats.norm.ppf(0.975) * np.sqrt(a + 2.0 * b * probit + c * probit**2), rtol=1e-9
    )
    np.testing.assert_allclose(np.sqrt(low * high), curve.ppf(p), rtol=1e-12)
    part = dataclasses.replace(curve, upper_asymptote=0.8)
    assert part.ppf(0.4) == pytest.approx(curve.theta, rel=1e-15)
    assert part.ppf([0.8, 0.9]).tolist() == [np.inf, np.inf]
    for wrong in (-0.1, 1.1, np.nan, "half"):
        with pytest.raises(dd.errors.InputError, match=r"p = .*must lie between 0 and 1|p: must be numbers"):
            curve.ppf(wrong)
    for wrong in (0.0, 0.8, 1.0):
        with pytest.raises(dd.errors.InputError, match=r"p = .*: must be greater than 0 and less than 0.8"):
            part.ppf_interval(wrong)
    with pytest.raises(dd.errors.DondoloError, match="no standard errors"):
        dd.Fragility.of_parameters(0.5, 0.4).ppf_interval(0.5)
    with pytest.raises(dd.errors.DondoloError, match="no curve was fitted"):
        dd.fit_fragility([0.2, 0.4], [0, 0], 20).ppf(0.5)


@pytest.mark.parametrize("polarity", ["as_recorded", "both"])
def test_outcomes_of_any_program(wall, records, polarity):
    """The flags of stripes, as another program would give them, make the curve of the stripes: errors and draws too."""
    stripes = dd.multiple_stripe(wall, records, [0.4, 0.6, 0.8, 1.0, 1.3], polarity=polarity, progress=False)
    curve = stripes.fit()
    own = [records[i] for i in stripes.record_index]
    for whose, events in ((own, None), ([one.name for one in own], [one.event for one in own])):
        told = dd.fit_fragility(stripes.levels, stripes.collapsed, im="pga", records=whose, events=events)
        assert (told.theta, told.beta, told.errors, told.clusters) == (curve.theta, curve.beta, "clustered", 22)
        assert np.array_equal(told.covariance, curve.covariance)
        drawn, expected = (one.bootstrap(n_resamples=50, rng=3) for one in (told, curve))
        assert np.array_equal(drawn.theta, expected.theta, equal_nan=True)
    again = dd.fit_fragility(stripes.levels, stripes.collapsed, im="pga", records=own)
    assert again.compare(curve).pairing == "paired"
    assert again.compare(curve).ratio_interval == (1.0, 1.0)


def test_outcomes_that_were_not_run():
    """A history that is missing at some levels counts at the others; without records each stands for itself."""
    gap = np.nan
    outcomes = np.array([[0, 0, 1, 1], [0, gap, 0, 1], [0, 1, 1, gap], [0, 0, 1, 1], [1, 0, 0, 1], [0, 0, 0, 1.0]]).T
    curve = dd.fit_fragility([0.2, 0.4, 0.6, 0.9], outcomes)
    counts = dd.fit_fragility([0.2, 0.4, 0.6, 0.9], [1, 1, 3, 5], [6, 5, 6, 5])
    assert (curve.theta, curve.beta) == (counts.theta, counts.beta)
    assert (curve.errors, curve.clusters, counts.errors) == ("clustered", 6, "naive")
    pairs = dd.fit_fragility([0.2, 0.4, 0.6, 0.9], outcomes, events=[1, 1, 2, 2, 3, 3])
    assert pairs.clusters == 3
    # One of three left out, refitted: what a sandwich of three clusters estimates
    assert pairs.se_ln_theta != curve.se_ln_theta


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"collapses": [[0, 0], [1, 2], [1, 1]]}, "collapses = 2: the outcome of a history must be 0, 1 or NaN"),
        ({"collapses": [[0, 1, 1, 1]]}, r"\(1, 4\) for 3 levels: must be \(levels, histories\), one row for each leve"),
        ({"collapses": [[0, 1, 1], [0, 0, 1]]}, r"shape \(2, 3\) for 3 levels: .*one row for each level; transpose it"),
        ({"histories": 3}, "histories: only with counts of collapses"),
        ({"records": ["a"]}, "records: 1 for 2 histories: must be as many"),
        ({"records": ["a", 3]}, "records: 3: must be a Record or a name"),
        ({"events": ["a"]}, "events: 1 labels for 2 histories: must be as many"),
        ({"records": ["a", "a"], "events": [1, 2]}, "events: 'event 2' and 'event 1' for one record, 'a'"),
        ({"collapses": [1, 2]}, "histories: must be given with counts of collapses"),
        ({"collapses": [1, 2], "histories": 3, "records": ["a"]}, r"records: only with the outcomes of histories"),
    ],
)
def test_wrong_outcomes(given, message):
    with pytest.raises(dd.errors.InputError, match=message):
        dd.fit_fragility(**{"levels": [0.2, 0.4, 0.6], "collapses": [[0, 0], [0, 1], [1, 1]]} | given)


def test_as_many_outcomes_as_levels():
    """A square of outcomes is levels first, and refused where it may as well be the other way round."""
    levels = np.array([0.3, 0.5, 0.8, 1.2])
    outcomes = np.array([[0, 0, 0, 0], [0, 1, 0, 0], [1, 1, 0, 0], [1, 1, 0, 1]])
    names = ["a", "b", "c", "d"]
    curve = dd.fit_fragility(levels, outcomes, records=names)
    counts = dd.fit_fragility(levels, [0, 1, 2, 3], 4)
    assert (curve.theta, curve.beta, curve.clusters) == (counts.theta, counts.beta, 4)
    # Levels in another order are the same, with their rows
    again = dd.fit_fragility(levels[::-1], outcomes[::-1], records=names)
    assert again.theta == pytest.approx(curve.theta, rel=1e-6)
    # One level more, or a history: the shape tells
    assert dd.fit_fragility(levels, np.column_stack([outcomes, outcomes[:, 0]])).clusters == 5
    # Histories in the order of their strength rise both ways
    ordered = np.array([[0, 0, 0, 0], [0, 0, 0, 1], [0, 0, 1, 1], [0, 0, 1, 1]])
    for turned in (outcomes.T, ordered, ordered.T):
        message = r"\(4, 4\) for 4 levels, \(levels, histories\): .*transpose it .*levels\[:, None\]"
        with pytest.raises(dd.errors.InputError, match=message):
            dd.fit_fragility(levels, turned, records=names)
    told = dd.fit_fragility(levels[:, None], ordered, records=names)
    assert told.theta == dd.fit_fragility(levels, [0, 1, 2, 2], 4).theta
    # The same either way
    same = np.array([[0, 0, 0, 0], [0, 0, 0, 1], [0, 0, 1, 1], [0, 1, 1, 1]])
    assert dd.fit_fragility(levels, same).theta == dd.fit_fragility(levels, [0, 1, 2, 3], 4).theta
