"""Probability under an uncertain ground motion, against samples, quadrature and a convolution of two lognormals."""

from itertools import pairwise

import numpy as np
import pytest
from scipy import integrate, stats

import dondolo as dd


def mean_of(function, median, sigma, corners=()):
    """E[F(X)] by adaptive quadrature over ln x, split at corners."""
    ends = sorted({-9.0, 9.0, *((np.log(x / median)) / sigma for x in corners if x > 0.0)})
    ends = [end for end in ends if -9.0 <= end <= 9.0]
    pieces = (
        integrate.quad(lambda z: function(median * np.exp(sigma * z)) * stats.norm.pdf(z), *pair, epsabs=1e-13)[0]
        for pair in pairwise(ends)
    )
    return sum(pieces)


def test_a_lognormal_curve_is_a_convolution():
    """The probability that the intensity exceeds a lognormal capacity: of two million pairs."""
    curve = dd.Fragility.of_parameters(0.8, 0.4, im="pga")
    draws = np.random.default_rng(5).normal(size=(2, 2_000_000))
    share = np.mean(0.4 * np.exp(0.6 * draws[0]) > 0.8 * np.exp(0.4 * draws[1]))
    assert curve.scenario(0.4, 0.6) == pytest.approx(share, abs=1e-3)
    assert curve.scenario(0.4, 0.6) == pytest.approx(mean_of(curve, 0.4, 0.6), rel=1e-10)
    found = curve.scenario([[0.0, 0.2], [0.4, 1.6]], 0.6)
    assert found.shape == (2, 2)
    assert found[0, 0] == 0.0
    assert found[1, 0] == curve.scenario(0.4, 0.6)


@pytest.mark.parametrize("limit", [None, 0.15, 0.25])
def test_straight_lines(limit):
    curve = dd.DiscreteFragility([0.2, 0.4, 0.9], [0.1, 0.5, 0.8], no_damage_limit=limit)
    corners = [*curve.levels, *([limit] if limit else [])]
    for median in (0.05, 0.3, 2.0):
        expected = mean_of(curve, median, 0.5, corners)
        assert curve.scenario(median, 0.5) == pytest.approx(expected, rel=1e-9)


def test_other_curves(path_of_limits):
    limited = dd.read_nrml(path_of_limits).functions["W"]["collapse"]
    corners = [limit for limit in limited.limits if limit is not None]
    assert limited.scenario(0.35, 0.5) == pytest.approx(mean_of(limited, 0.35, 0.5, corners), rel=1e-9)
    smooth = dd.FunctionFragility(lambda x: 0.7 * x**3 / (x**3 + 0.2), im="pga")
    assert smooth.scenario(0.6, 0.5) == pytest.approx(mean_of(smooth, 0.6, 0.5), rel=1e-9)


@pytest.fixture
def path_of_limits(tmp_path):
    path = tmp_path / "model.xml"
    dd.write_nrml(
        path,
        {"W": {"collapse": dd.Fragility.of_parameters(0.5, 0.6, im="pga")}},
        no_damage_limit=0.3,
        min_iml=0.3,
        max_iml=2.0,
    )
    return path


def test_populations(people):
    """By the curve itself at many points of the distribution, for many sites at once."""
    curve = people["all"]
    medians = np.geomspace(0.1, 3.0, 200)
    found = curve.scenario(medians, 0.5)
    z = stats.norm.ppf((np.arange(4000) + 0.5) / 4000)
    for number in (0, 60, 120, 199):
        assert found[number] == pytest.approx(curve(medians[number] * np.exp(0.5 * z)).mean(), abs=2e-4)
    assert np.all(np.diff(found) > 0.0)


@pytest.fixture
def people(few):
    walls = [dd.OneSidedWall(1.2, 0.25, name="a"), dd.OneSidedWall(1.8, 0.25, name="b")]
    return dd.typology(walls, few, [0.3, 0.5, 0.7, 0.9, 1.2, 1.6], progress=False)


def test_certain_motion_is_the_curve():
    for curve in (dd.Fragility.of_parameters(0.8, 0.4, im="pga"), dd.DiscreteFragility([0.2, 0.6], [0.1, 0.7])):
        assert curve.scenario(0.5, 0.0) == curve(0.5)
        assert curve.scenario(0.5, 1e-6) == pytest.approx(curve(0.5), rel=1e-6)


def test_refusals():
    curve = dd.Fragility.of_parameters(0.8, 0.4, im="pga")
    for median, dispersion, sentence in (
        (-0.1, 0.5, "must be levels of intensity, not negative"),
        (np.inf, 0.5, "median = inf: must be finite"),
        (0.4, -0.1, "dispersion = -0.1: must lie between 0 and 3"),
        (0.4, np.nan, "dispersion = nan"),
        (0.4, 6.0, "dispersion = 6"),
    ):
        with pytest.raises(dd.errors.InputError, match=sentence):
            curve.scenario(median, dispersion)
    with pytest.raises(dd.errors.DondoloError, match="no curve"):
        dd.fit_fragility([0.2, 0.4], [0, 0], 44, im="pga").scenario(0.4, 0.5)
