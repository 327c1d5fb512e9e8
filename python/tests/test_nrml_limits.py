"""Fragility models: limits that are applied, discrete functions as curves, and files that must not be believed."""

import itertools
import re
import tracemalloc

import matplotlib

matplotlib.use("agg")

import numpy as np
import pytest
from scipy import integrate, stats

import dondolo as dd

# Damage of a shed: a lognormal with limits, and one of levels
MODEL = """<?xml version="1.0" encoding="utf-8"?>
<nrml xmlns="http://openquake.org/xmlns/nrml/0.5">
  <fragilityModel id="sheds" assetCategory="buildings" lossCategory="structural">
    <description>sheds</description>
    <limitStates>crack fall</limitStates>
    <fragilityFunction id="smooth" format="continuous" shape="logncdf">
      <imls imt="PGA" noDamageLimit="0.12" minIML="0.08" maxIML="1.5"/>
      <params ls="crack" mean="0.35" stddev="0.21"/>
      <params ls="fall" mean="0.7" stddev="0.42"/>
    </fragilityFunction>
    <fragilityFunction id="steps" format="discrete">
      <imls imt="PGV" noDamageLimit="2.5">5 20 <!-- cm/s -->60 90</imls>
      <poes ls="crack">0.1 0.5 0.8 0.9</poes>
      <poes ls="fall">0.0 0.1 0.5 0.6</poes>
    </fragilityFunction>
  </fragilityModel>
</nrml>
"""
K0, K = 3e-4, 2.0


@pytest.fixture
def path(tmp_path):
    return tmp_path / "model.xml"


def model_of(path, *changes):
    """The model of a changed file."""
    text = MODEL
    for old, new in changes:
        assert old in text
        text = text.replace(old, new)
    path.write_text(text, encoding="utf-8")
    return dd.read_nrml(path)


def frequency(curve, corners):
    """Annual frequency of collapse under K0 x^-K, by quadrature between the corners of a curve."""
    return (
        sum(
            integrate.quad(lambda x: curve(x) * K0 * K * x ** (-K - 1.0), low, high, epsabs=1e-16, epsrel=1e-11)[0]
            for low, high in itertools.pairwise(corners)
        )
        + curve(corners[-1]) * K0 * corners[-1] ** -K
    )


def lognormal(x, mean, deviation):
    beta = np.sqrt(np.log(1.0 + (deviation / mean) ** 2))
    return stats.norm.cdf(np.log(x / (mean * np.exp(-0.5 * beta**2))) / beta)


def test_limits_are_applied(path):
    fall = model_of(path).functions["smooth"]["fall"]
    x = np.array([0.0, 0.05, 0.12, 0.1201, 0.4, 1.5, 1.6, 30.0])
    p = lognormal(np.minimum(np.maximum(x, 0.08), 1.5), 0.7, 0.42)
    np.testing.assert_allclose(fall(x), np.where(x <= 0.12, 0.0, p), rtol=1e-12)
    assert fall(0.4) == pytest.approx(lognormal(0.4, 0.7, 0.42))
    hazard = dd.HazardCurve.power_law(K0, K)
    expected = frequency(lambda x: lognormal(x, 0.7, 0.42), [0.12, 0.7, 1.5])
    assert fall.risk(hazard).annual_frequency == pytest.approx(expected, rel=1e-8)
    # Constant below minIML where no limit of damage is given: the frequency of a power law has no bound
    open_below = model_of(path, ('noDamageLimit="0.12" ', "")).functions["smooth"]["fall"]
    assert open_below(0.001) == open_below(0.08) == pytest.approx(lognormal(0.08, 0.7, 0.42))
    with pytest.raises(dd.errors.DondoloError, match="is not finite"):
        open_below.risk(hazard)


def test_a_limited_curve_is_inverted(path):
    fall = model_of(path).functions["smooth"]["fall"]
    p = np.array([0.0, 0.5 * fall(0.13), fall(0.3), fall(1.5), 0.9999])
    np.testing.assert_allclose(fall.ppf(p), [0.12, 0.12, 0.3, 1.5, np.inf])
    with pytest.raises(dd.errors.DondoloError, match="no standard errors: the parameters were given"):
        fall.interval(0.3)


def test_the_risk_of_a_limited_curve_under_levels(path):
    """All that a risk shows is of the same curve; its bounds end where the curve does."""
    fall = model_of(path).functions["smooth"]["fall"]
    levels = np.geomspace(0.05, 1.0, 12)
    with pytest.warns(dd.errors.DondoloWarning, match="is too short"):
        risk = fall.risk(dd.HazardCurve(levels, K0 * levels**-K))
    inside = frequency(fall, [0.12, 0.4, 1.0]) - fall(1.0) * K0
    assert risk.inside == pytest.approx(inside, rel=1e-8)
    assert risk.bounds == pytest.approx((inside + fall(1.0) * K0, inside + fall(1.5) * K0), rel=1e-8)
    parts = risk.deaggregate([0.05, 0.11, 0.3, 1.0])
    assert parts[0] == 0.0
    assert parts.sum() == pytest.approx(inside, rel=1e-8)
    assert risk.density(0.11) == 0.0
    risk.plot()
    risk.plot_deaggregation()


def test_discrete_functions_are_curves(path):
    """Straight lines, from 0 at the limit of damage, constant above; levels of PGV are in m/s."""
    crack = model_of(path).functions["steps"]["crack"]
    x = np.array([0.0, 0.025, 0.0375, 0.05, 0.4, 0.9, 5.0])
    np.testing.assert_allclose(crack(x), [0.0, 0.0, 0.05, 0.1, 0.65, 0.9, 0.9], rtol=1e-14)
    assert isinstance(crack(0.4), float)
    np.testing.assert_allclose(crack.ppf([0.0, 0.05, 0.65, 0.9, 0.95]), [0.0, 0.0375, 0.4, 0.9, np.inf])
    hazard = dd.HazardCurve.power_law(K0, K, im="pgv")
    expected = frequency(crack, [0.025, 0.05, 0.2, 0.6, 0.9])
    assert crack.risk(hazard).annual_frequency == pytest.approx(expected, rel=1e-9)
    ax = crack.plot(label="crack")
    np.testing.assert_allclose(ax.lines[0].get_ydata(), crack(ax.lines[0].get_xdata()))
    assert ax.get_legend().get_texts()[0].get_text() == "crack"
    for wrong in (-0.1, np.nan, "x"):
        with pytest.raises(dd.errors.InputError, match=r"^x.*: must be"):
            crack(wrong)
    for wrong in (-0.1, np.nan, "x"):
        with pytest.raises(dd.errors.InputError, match="no_damage_limit"):
            dd.DiscreteFragility([0.1, 0.2], [0.0, 1.0], no_damage_limit=wrong)


def test_without_a_limit_a_line_begins_at_no_intensity():
    """As OpenQuake has it; under a power law that is steep it has no finite frequency, which is not passed over."""
    curve = dd.DiscreteFragility([0.2, 0.4], [0.1, 0.6])
    assert curve(0.1) == pytest.approx(0.05)
    with pytest.raises(dd.errors.DondoloError, match="is not finite"):
        curve.risk(dd.HazardCurve.power_law(K0, K))
    gentle = curve.risk(dd.HazardCurve.power_law(K0, 0.25)).annual_frequency
    # Of H = K0 x^-0.25 and P = x/2 up to x_1: K0 x_1^0.75/6
    rest = integrate.quad(lambda x: curve(x) * K0 * 0.25 * x**-1.25, 0.2, 0.4, epsabs=1e-16)[0]
    assert gentle == pytest.approx(K0 * 0.2**0.75 / 6.0 + rest + 0.6 * K0 * 0.4**-0.25, rel=1e-8)


def test_a_level_of_zero(path):
    changes = ('noDamageLimit="2.5">5', ">0 5"), ('"crack">0.1', '"crack">0 0.1'), ('"fall">0.0', '"fall">0 0')
    crack = model_of(path, *changes).functions["steps"]["crack"]
    np.testing.assert_array_equal(crack.levels, [0.0, 0.05, 0.2, 0.6, 0.9])
    assert (crack(0.0), crack(0.025)) == (0.0, pytest.approx(0.05))


def test_limits_are_kept_when_a_model_is_written_again(path, tmp_path):
    model = model_of(path)
    again = tmp_path / "again.xml"
    dd.write_nrml(again, model.functions)
    found = dd.read_nrml(again)
    assert found.limits == model.limits == {"smooth": (0.12, 0.08, 1.5), "steps": (0.025, None, None)}
    x = np.linspace(0.0, 2.0, 300)
    for taxonomy, curves in model.functions.items():
        for state, curve in curves.items():
            np.testing.assert_array_equal(found.functions[taxonomy][state](x), curve(x))
    again.unlink()
    dd.write_nrml(again, {"smooth": model.functions["smooth"]}, no_damage_limit=0.2)
    assert dd.read_nrml(again).limits == {"smooth": (0.2, 0.08, 1.5)}
    plain = {"crack": dd.Fragility.of_parameters(0.3, 0.4, im="pga"), "fall": model.functions["smooth"]["fall"]}
    with pytest.raises(dd.errors.InputError, match="its curves must have the same limits"):
        dd.write_nrml(again, {"smooth": plain})


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ([('minIML="0.08"', 'minIML="1.5"')], "'smooth': minIML = 1.5, maxIML = 1.5: must increase"),
        ([('noDamageLimit="0.12"', 'noDamageLimit="2"')], "noDamageLimit = 2: must be below maxIML = 1.5"),
        ([('mean="0.35"', 'mean="0.9"'), ('stddev="0.21"', 'stddev="0.54"')], "'fall' is more probable than 'crack'"),
        ([("0.0 0.1 0.5 0.6", "0.1 0.5 0.9 0.9")], "'steps': 'fall' is more probable than 'crack': limit states must"),
        ([("0.1 0.5 0.8 0.9", "0.1 0.5 0.8 1_0e-1")], "poes = '1_0e-1': must be a number, not negative"),
        (
            [('noDamageLimit="2.5"', 'noDamageLimit="2.5" maxIML="80"')],
            "imls = 0.9: must not be beyond minIML and maxIML",
        ),
        ([('stddev="0.42"', 'stddev="1e200"')], "must be"),
        ([('imt="PGV"', 'imt="PGV" minIML="1e-99999999999999999999"'), ("60 90", "60 6")], "levels = 0.6, 0.06: must"),
    ],
)
def test_models_that_contradict_themselves(path, changes, message):
    with pytest.raises(dd.errors.InputError, match=rf"model\.xml: .*{re.escape(message)}") as error:
        model_of(path, *changes)
    assert "\n" not in str(error.value)


@pytest.mark.parametrize(
    ("change", "message", "code"),
    [
        (
            ("0.0 0.1 0.5 0.6", "0.0 0.1 0.5 0.95"),
            "'steps': 'fall' is more probable than 'crack' at 0.9: the curves cross, the larger",
            "limit_states_cross",
        ),
        (
            ('stddev="0.42"', 'stddev="1.2"'),
            "'smooth': 'fall' is more probable than 'crack' below 0.2595: the curves cross, the larger",
            "limit_states_cross",
        ),
        (
            ('noDamageLimit="2.5"', 'noDamageLimit="10"'),
            "noDamageLimit = 0.1 is not below the lowest level, 0.05: the probabilities of 'crack' up to it are taken",
            "levels_below_no_damage_limit",
        ),
    ],
)
def test_models_that_are_doubtful(path, change, message, code):
    with pytest.warns(dd.errors.DondoloWarning, match=re.escape(message)) as caught:
        found = model_of(path, change)
    assert [one.message.code for one in caught] == [code]
    if "noDamage" in message:
        crack = found.functions["steps"]["crack"]
        assert (crack(0.1), crack(0.1001)) == (0.0, pytest.approx(0.1 + 0.4 * 0.0501 / 0.15))


def laughs(depth):
    """Entities, each of which is ten of the one before."""
    lines = ['<!ENTITY a0 "ha">', *(f'<!ENTITY a{i} "{f"&a{i - 1};" * 10}">' for i in range(1, depth))]
    return f"<!DOCTYPE nrml [{''.join(lines)}]>", f"&a{depth - 1};"


@pytest.mark.parametrize(
    ("declaration", "text"),
    [
        laughs(9),
        (f'<!DOCTYPE nrml [<!ENTITY a "{"x" * 100_000}">]>', "&a;" * 1000),
        ('<!DOCTYPE nrml [<!ENTITY a SYSTEM "file:///etc/hostname">]>', "&a;"),
        ('<!DOCTYPE nrml SYSTEM "http://localhost/nrml.dtd">', "walls"),
    ],
    ids=["entities of entities", "a long entity", "a file", "a definition elsewhere"],
)
def test_entities_are_refused(path, declaration, text):
    tracemalloc.start()
    with pytest.raises(dd.errors.InputError, match=r"has a document type declaration \(DOCTYPE\)"):
        model_of(path, ('"utf-8"?>', f'"utf-8"?>{declaration}'), (">sheds</", f">{text}</"))
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert peak < 5_000_000


def test_depth_is_limited(path):
    with pytest.raises(dd.errors.InputError, match="is nested more than 100 elements deep"):
        model_of(path, (">sheds</", f">{'<a>' * 200_000}</"))
