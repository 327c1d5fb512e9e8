"""Fragility models for OpenQuake, checked by the rules of its manual and of its reader."""

import os
import re
from unittest import mock
from xml.etree import ElementTree

import matplotlib

matplotlib.use("agg")

import numpy as np
import pytest
from scipy import stats

import dondolo as dd
from dondolo import DiscreteFragility

SPACE = "{http://openquake.org/xmlns/nrml/0.5}"


def lognormal(theta, beta, im="pga"):
    """A fitted curve of these parameters."""
    step = beta * stats.norm.ppf(0.75)
    return dd.fit_fragility([theta * np.exp(-step), theta * np.exp(step)], [250, 750], 1000, im=im)


def check(path):
    """The rules of the manual of the OpenQuake engine, chapter "Fragility Models", element by element.

    Returns functions of the intensity for each taxonomy and state, as the engine evaluates them.
    """
    root = ElementTree.parse(path).getroot()
    assert root.tag == SPACE + "nrml"
    (model,) = root
    assert model.tag == SPACE + "fragilityModel"
    assert set(model.attrib) == {"id", "assetCategory", "lossCategory"}
    assert re.fullmatch(r"[A-Za-z0-9_-]{1,100}", model.get("id"))
    assert model.get("lossCategory") in ("structural", "nonstructural", "contents", "business_interruption")
    description, states, *functions = model
    assert description.tag == SPACE + "description"
    assert description.text.strip()
    assert states.tag == SPACE + "limitStates"
    names = states.text.split()
    assert names
    assert len(set(names)) == len(names)
    assert all(re.fullmatch(r"[A-Za-z0-9_-]+", name) for name in names)
    assert functions
    found = {}
    for function in functions:
        assert function.tag == SPACE + "fragilityFunction"
        assert function.get("id") not in found
        imls, *curves = function
        assert imls.tag == SPACE + "imls"
        assert re.fullmatch(r"PGA|PGV|SA\(\d+\.\d+\)", imls.get("imt"))
        assert [curve.get("ls") for curve in curves] == names
        none = float(imls.get("noDamageLimit", "0"))
        if function.get("format") == "continuous":
            assert set(function.attrib) == {"id", "format", "shape"}
            assert function.get("shape") == "logncdf"
            assert set(imls.attrib) == {"imt", "noDamageLimit", "minIML", "maxIML"}
            assert imls.text is None
            assert all(curve.tag == SPACE + "params" for curve in curves)
            assert all(set(curve.attrib) == {"ls", "mean", "stddev"} for curve in curves)
            low, high = float(imls.get("minIML")), float(imls.get("maxIML"))
            assert 0.0 < low < high
            assert none < high

            def continuous(x, curve, low=low, high=high, none=none):
                mean, deviation = float(curve.get("mean")), float(curve.get("stddev"))
                sigma = np.sqrt(np.log(1.0 + (deviation / mean) ** 2))
                median = mean**2 / np.sqrt(deviation**2 + mean**2)
                x = np.clip(x, low, high)
                return np.where(x <= none, 0.0, stats.lognorm.cdf(x, sigma, scale=median))

            evaluate, grid = continuous, np.geomspace(low, high, 2001)
        else:
            assert function.attrib == {"id": function.get("id"), "format": "discrete"}
            assert set(imls.attrib) <= {"imt", "noDamageLimit"}
            levels = np.array(imls.text.split(), dtype=float)
            assert np.all(np.diff(levels) > 0.0)
            assert none < levels[0]
            for curve in curves:
                assert curve.tag == SPACE + "poes"
                assert set(curve.attrib) == {"ls"}
                poes = np.array(curve.text.split(), dtype=float)
                assert len(poes) == len(levels)
                assert np.all((poes >= 0.0) & (poes <= 1.0))
                assert np.all(np.diff(poes) >= 0.0)

            def discrete(x, curve, levels=levels, none=none):
                return np.interp(x, np.append(none, levels), np.append(0.0, np.array(curve.text.split(), dtype=float)))

            evaluate, grid = discrete, levels
        values = np.array([evaluate(grid, curve) for curve in curves])
        assert np.all(np.diff(values, axis=0) <= 1e-12), "states cross"
        found[function.get("id")] = (
            imls.get("imt"),
            {name: lambda x, f=evaluate, c=curve: f(x, c) for name, curve in zip(names, curves, strict=True)},
        )
    return found


@pytest.fixture
def path(tmp_path):
    return tmp_path / "model.xml"


def test_continuous(path):
    curves = {"damage": lognormal(0.3, 0.35), "collapse": lognormal(0.6, 0.4)}
    dd.write_nrml(path, {"MUR+CLBRS/LWAL+DNO/H:2": curves, "parapets": curves}, id="centre")
    found = check(path)
    assert list(found) == ["MUR+CLBRS/LWAL+DNO/H:2", "parapets"]
    imt, functions = found["parapets"]
    assert imt == "PGA"
    x = np.geomspace(0.12, 1.9, 50)
    for state, curve in curves.items():
        np.testing.assert_allclose(functions[state](x), curve(x), rtol=1e-9)
    # Nothing below the range, and a constant above
    assert functions["damage"](0.3 * np.exp(-6.001 * 0.35)) == 0.0
    assert functions["damage"](0.3 * np.exp(-5.999 * 0.35)) > 0.0
    assert functions["collapse"](50.0) == pytest.approx(stats.norm.cdf(3.0))


def test_parameters_are_those_of_the_intensity(path):
    """Mean and standard deviation of a large sample of the lognormal."""
    dd.write_nrml(path, {"a": {"collapse": lognormal(0.6, 0.4)}})
    params = ElementTree.parse(path).getroot().find(f".//{SPACE}params")
    sample = np.exp(np.log(0.6) + 0.4 * np.random.default_rng(1).normal(size=1_000_000))
    assert float(params.get("mean")) == pytest.approx(sample.mean(), rel=2e-3)
    assert float(params.get("stddev")) == pytest.approx(sample.std(), rel=5e-3)


def test_units(path):
    functions = {
        "v": {"collapse": lognormal(0.4, 0.3, "pgv")},
        "s": {"collapse": lognormal(0.4, 0.3, "sa(0.5)")},
        "one": {"collapse": lognormal(0.4, 0.3, "sa(1)")},
        "d": {"collapse": DiscreteFragility([0.2, 0.5], [0.1, 0.7], im="pgv")},
    }
    dd.write_nrml(path, functions)
    found = check(path)
    assert [imt for imt, _ in found.values()] == ["PGV", "SA(0.5)", "SA(1.0)", "PGV"]
    # 40 cm/s
    assert found["v"][1]["collapse"](40.0) == pytest.approx(0.5)
    assert found["s"][1]["collapse"](0.4) == pytest.approx(0.5)
    np.testing.assert_allclose(found["d"][1]["collapse"]([20.0, 35.0, 50.0]), [0.1, 0.4, 0.7])
    for im in ("arias", "cav", "hi", "pgd", "pga/a0", ""):
        with pytest.raises(
            dd.errors.InputError, match=re.escape(f"im = '{im}': must be 'pga', 'pgv' or 'sa(T)' for OpenQuake")
        ):
            dd.write_nrml(path, {"a": {"collapse": lognormal(0.4, 0.3, im)}})


def test_levels_in_other_units_are_exact(path):
    """1.1 m/s are 110 cm/s, not 110.00000000000001."""
    dd.write_nrml(
        path, {"a": {"c": DiscreteFragility([0.07, 0.29, 1.1], [0.1, 0.2, 0.3], im="pgv")}}, no_damage_limit=0.01
    )
    imls = ElementTree.parse(path).getroot().find(f".//{SPACE}imls")
    assert (imls.get("noDamageLimit"), imls.text) == ("1.0", "7.0 29.0 110.0")


def test_only_models_of_dondolo_are_replaced(path):
    functions = {"a": {"collapse": lognormal(0.4, 0.3)}}
    dd.write_nrml(path, functions)
    dd.write_nrml(path, functions, id="again")
    text = path.read_text()
    assert 'id="again"' in text
    other = text.replace("<!-- dondolo ", "<!-- another ")
    path.write_text(other)
    with pytest.raises(dd.errors.InputError, match=r"model\.xml: exists, and is not a fragility model of dondolo"):
        dd.write_nrml(path, functions)
    assert path.read_text() == other


def test_range(path):
    curves = {"collapse": lognormal(0.6, 0.4, "pgv")}
    dd.write_nrml(path, {"a": curves}, min_iml=0.1, max_iml=2.0, no_damage_limit=0.15)
    imls = ElementTree.parse(path).getroot().find(f".//{SPACE}imls")
    assert (imls.get("noDamageLimit"), imls.get("minIML"), imls.get("maxIML")) == ("15.0", "10.0", "200.0")
    dd.write_nrml(path, {"a": {"collapse": DiscreteFragility([0.2, 0.4], [0.1, 0.6])}}, no_damage_limit=0.1)
    assert ElementTree.parse(path).getroot().find(f".//{SPACE}imls").get("noDamageLimit") == "0.1"
    for options, sentence in (
        ({"min_iml": 2.0, "max_iml": 1.0}, "min_iml = 2, max_iml = 1: must increase"),
        ({"min_iml": 0.0}, "min_iml = 0: must be positive"),
        ({"max_iml": np.inf}, "max_iml = inf: must be positive"),
        ({"no_damage_limit": 5.0}, "no_damage_limit = 5: must be below max_iml"),
    ):
        with pytest.raises(dd.errors.InputError, match=sentence):
            dd.write_nrml(path, {"a": curves}, **options)
    with pytest.raises(dd.errors.InputError, match=r"no_damage_limit = 0.3: must be below the lowest level, 0.2"):
        dd.write_nrml(path, {"a": {"c": DiscreteFragility([0.2, 0.4], [0.1, 0.6])}}, no_damage_limit=0.3)


def suggested(path):
    """Levels of the hazard that the engine suggests for a model of one function: 20 between the first and the last."""
    imls = ElementTree.parse(path).getroot().find(f".//{SPACE}imls")
    levels = [float(word) for word in imls.text.split()]
    # Of 0, and of no limit, the engine makes 1e-10.
    return np.geomspace(min(levels[0], float(imls.get("noDamageLimit", 0.0)) or 1e-10) or 1e-10, levels[-1], 20)


def risk_at(levels, curve, k=2.5):
    """The damage frequency as the engine sums it: of each interval of hazard x^-k the probability at its middle."""
    hazard = 1e-4 * np.asarray(levels) ** -k
    middle = 0.5 * (hazard[1:] + hazard[:-1])
    occurrence = -np.diff(np.concatenate([[hazard[0]], middle, [hazard[-1]]]))
    return float(occurrence @ curve(levels))


def test_discrete_functions_begin_at_next_to_no_damage(path):
    """At 1e-9 or less, the limit just below it, so that the engine's levels lie where the curve is."""
    truth = lognormal(0.55, 0.37)
    levels = np.geomspace(0.05, 3.0, 60)
    curve = DiscreteFragility(levels, truth(levels))
    curve.to_nrml(path, taxonomy="w")
    imls = ElementTree.parse(path).getroot().find(f".//{SPACE}imls")
    first, limit = float(imls.text.split()[0]), float(imls.get("noDamageLimit"))
    assert first == levels[0]
    assert 0.99 * first < limit < first
    fine = risk_at(np.geomspace(0.05, 3.0, 4000), truth)
    assert risk_at(suggested(path), truth) == pytest.approx(fine, rel=0.35)
    assert risk_at(np.geomspace(1e-10, 3.0, 20), truth) > 1.7 * fine
    again = dd.read_nrml(path).functions["w"]["collapse"]
    np.testing.assert_array_equal(again.levels, levels)
    x = np.linspace(0.0, 4.0, 900)
    np.testing.assert_allclose(again(x), curve(x), rtol=0, atol=1e-9)


@pytest.mark.parametrize("beta", [0.3, 0.4, 0.45])
def test_levels_that_the_engine_suggests(path, beta):
    """Frequencies by its 20 levels are within 6 %, and by 60 within 1 %."""
    truth = dd.Fragility.of_parameters(0.6, beta, im="pga")
    dd.FunctionFragility(truth).to_nrml(path)
    found = dd.read_nrml(path).functions["walls"]["collapse"]
    levels = suggested(path)
    fine = np.geomspace(levels[0], levels[-1], 20_000)
    exact = risk_at(fine, truth)
    assert risk_at(levels, found) == pytest.approx(exact, rel=0.06)
    assert risk_at(np.geomspace(levels[0], levels[-1], 60), found) == pytest.approx(exact, rel=0.01)
    assert risk_at(np.geomspace(levels[0], levels[-1], 300), found) == pytest.approx(exact, rel=0.003)


@pytest.mark.parametrize("zero", [False, True])
def test_a_line_from_no_intensity_is_said(zero, path):
    """It reaches 1e-9 far below the other levels, where the engine's are too far apart; a limit is the remedy."""
    levels, p = ([0.0, 0.2, 0.4], [0.0, 0.1, 0.6]) if zero else ([0.2, 0.4], [0.1, 0.6])
    curve = DiscreteFragility(levels, p, im="pgv")
    with pytest.warns(
        dd.errors.DondoloWarning, match=r"taxonomy 'c': has a probability of 0\.1 .*: give no_damage_limit"
    ) as w:
        dd.write_nrml(path, {"c": {"light": curve, "heavy": DiscreteFragility(levels, 0.5 * np.array(p), im="pgv")}})
    assert w[0].message.code == "begins_at_no_intensity"
    found = dd.read_nrml(path).functions["c"]
    x = np.linspace(0.0, 0.5, 101)
    np.testing.assert_allclose(found["light"](x), curve(x), rtol=0, atol=1e-9)
    assert found["light"].levels.tolist() == [pytest.approx(2e-9), 0.2, 0.4]
    assert found["light"].probability[0] <= 1e-9
    # With a limit that is given, or that the curve has, nothing is added.
    for curves, given in ((curve, 0.1), (DiscreteFragility(levels[-2:], p[-2:], im="pgv", no_damage_limit=0.1), None)):
        if not zero:
            dd.write_nrml(path, {"c": {"light": curves}}, no_damage_limit=given)
            assert dd.read_nrml(path).functions["c"]["light"].levels.tolist() == levels
            assert dd.read_nrml(path).limits["c"] == (0.1, None, None)


def test_zeros_of_others_are_no_limits(path):
    """What the engine takes for 1e-10 is written again as the curve is."""
    truth = lognormal(0.5, 0.4)
    levels = np.append(0.0, np.geomspace(0.04, 2.0, 40))
    curve = DiscreteFragility(levels, np.append(0.0, truth(levels[1:])), no_damage_limit=0.0)
    curve.to_nrml(path, taxonomy="w")
    found = dd.read_nrml(path).functions["w"]["collapse"]
    assert found.levels[0] > 0.03
    assert 0.03 < found.no_damage_limit < found.levels[0]
    text = path.read_text()
    assert 'noDamageLimit="0.0"' not in text


def test_wide_curves_of_populations_begin_low_enough(path):
    """A dispersion of 1.3: 1e-9 is at 4e-4 of the median, below a thousandth of the lowest level."""
    from dondolo.curves.straight_lines import straight_lines

    wide = dd.Fragility.of_parameters(0.8, 1.3, im="pga")
    levels, p = straight_lines(lambda x: np.array([wide(x)]), np.array([1.0, 2.0]))
    assert p[0, 0] <= 1e-9
    x = np.geomspace(levels[0], 20.0, 500)
    np.testing.assert_allclose(np.interp(x, levels, p[0]), wide(x), rtol=0.006, atol=2e-9)


@pytest.mark.filterwarnings("ignore::dondolo.errors.DondoloWarning")
def test_typology_and_stripes(path, stripes, few):
    walls = [dd.OneSidedWall(1.2, 0.25, name="a"), dd.OneSidedWall(1.8, 0.25, name="b")]
    people = dd.typology(walls, few, [0.3, 0.5, 0.7, 0.9, 1.2, 1.6], progress=False)
    mean = DiscreteFragility(people.levels, people["all"].mean_curve, im=people.im)
    dd.write_nrml(path, {"centre": {"collapse": mean}, "parapet": {"collapse": stripes.fit()}})
    found = check(path)
    np.testing.assert_allclose(found["centre"][1]["collapse"](people.levels), people["all"](people.levels))
    assert found["parapet"][1]["collapse"](0.8) == pytest.approx(stripes.fit()(0.8))


def test_crossing_curves(path):
    """Probits are straight lines of ln x: these meet at one intensity."""
    light, heavy = lognormal(0.3, 0.2), lognormal(0.5, 0.6)
    cross = np.exp((np.log(0.3) / 0.2 - np.log(0.5) / 0.6) / (1.0 / 0.2 - 1.0 / 0.6))
    assert light(cross) == pytest.approx(heavy(cross))
    with pytest.raises(
        dd.errors.InputError, match=rf"'heavy' is more probable than 'light' below {cross:.4g}, .* min_iml"
    ):
        dd.write_nrml(path, {"a": {"light": light, "heavy": heavy}})
    assert not path.exists()
    dd.write_nrml(path, {"a": {"light": light, "heavy": heavy}}, min_iml=1.001 * cross)
    check(path)
    with pytest.raises(dd.errors.InputError, match="cross"):
        dd.write_nrml(path, {"a": {"light": light, "heavy": heavy}}, min_iml=0.999 * cross)
    light, heavy = lognormal(0.3, 0.6), lognormal(0.5, 0.2)
    cross = np.exp((np.log(0.3) / 0.6 - np.log(0.5) / 0.2) / (1.0 / 0.6 - 1.0 / 0.2))
    with pytest.raises(dd.errors.InputError, match=rf"above {cross:.4g}, .* max_iml"):
        dd.write_nrml(path, {"a": {"light": light, "heavy": heavy}})
    dd.write_nrml(path, {"a": {"light": light, "heavy": heavy}}, max_iml=0.999 * cross)
    check(path)
    with pytest.raises(dd.errors.InputError, match="from the lightest to the heaviest"):
        dd.write_nrml(path, {"a": {"heavy": lognormal(0.5, 0.4), "light": lognormal(0.3, 0.4)}})
    dd.write_nrml(path, {"a": {"light": lognormal(0.5, 0.4), "heavy": lognormal(0.5, 0.4)}})


def test_a_range_ends_where_curves_cross_unseen(path):
    """At a probability of 1e-4 or 0.9999, that is; what is given is not moved."""
    for betas, seldom in (((0.2, 0.25), 1e-4), ((0.25, 0.2), 1.0 - 1e-4)):
        cross = 0.3 * np.exp(betas[0] * stats.norm.ppf(seldom))
        second = cross * np.exp(-betas[1] * stats.norm.ppf(seldom))
        curves = {"a": lognormal(0.3, betas[0]), "b": lognormal(second, betas[1])}
        dd.write_nrml(path, {"walls": curves})
        check(path)
        imls = ElementTree.parse(path).getroot().find(f".//{SPACE}imls")
        # Three dispersions above the medians are below the upper crossing.
        ends = (
            {"minIML": cross}
            if seldom < 0.5
            else {"maxIML": max(0.3 * np.exp(3.0 * betas[0]), second * np.exp(3.0 * betas[1]))}
        )
        for what, end in ends.items():
            assert float(imls.get(what)) == pytest.approx(end, rel=1e-6)
        with pytest.raises(dd.errors.InputError, match="cross"):
            dd.write_nrml(path, {"walls": curves}, min_iml=0.01, max_iml=9.0)


def test_an_unseen_crossing_cuts_nothing_of_other_states(path):
    """A function of three states, two of which cross at 1e-4 or 0.9999 where the third has a probability to lose."""
    for betas, seldom in (((0.2, 0.25), 1e-4), ((0.25, 0.2), 1.0 - 1e-4)):
        cross = 0.3 * np.exp(betas[0] * stats.norm.ppf(seldom))
        second = cross * np.exp(-betas[1] * stats.norm.ppf(seldom))
        curves = {"b": lognormal(0.3, betas[0]), "c": lognormal(second, betas[1])}
        curves = {"a": lognormal(0.15, 0.3), **curves} if seldom < 0.5 else {**curves, "d": lognormal(1.0, betas[1])}
        dd.write_nrml(path, {"walls": curves})
        check(path)
        found = dd.read_nrml(path).functions["walls"]
        x = np.geomspace(0.05, 3.0, 400)
        for state, curve in curves.items():
            assert isinstance(found[state], DiscreteFragility)
            lift = np.interp(x, np.append(0.0, found[state].levels), np.append(0.0, found[state].probability)) - curve(
                x
            )
            assert np.abs(lift).max() < 0.008


def test_crossing_probabilities(path):
    light, heavy = DiscreteFragility([0.2, 0.4], [0.1, 0.6]), DiscreteFragility([0.2, 0.4], [0.05, 0.7])
    with pytest.raises(dd.errors.InputError, match=r"'heavy' is more probable than 'light' at 0.4"):
        dd.write_nrml(path, {"a": {"light": light, "heavy": heavy}})
    with pytest.raises(dd.errors.InputError, match="must have the same levels"):
        dd.write_nrml(path, {"a": {"light": light, "heavy": DiscreteFragility([0.2, 0.5], [0.05, 0.1])}})


def test_names(path):
    curve = lognormal(0.6, 0.4)
    good = {"a": {"collapse": curve}}
    for options, sentence in (
        ({"id": "a b"}, "id = 'a b'"),
        ({"id": ""}, "id = ''"),
        ({"id": 101 * "a"}, "id = "),
        ({"description": " "}, "description"),
        ({"description": "a\x01b"}, r"description = 'a\\x01b': must be a string of printable characters"),
        ({"description": None}, "description = None: must be a string of printable characters"),
        ({"asset_category": "a\x08b"}, r"asset_category = 'a\\x08b': must be a string of printable characters"),
        ({"id": 5}, "id = 5: must be of letters"),
        ({"asset_category": ""}, "asset_category"),
        ({"loss_category": "walls"}, "loss_category = 'walls': must be one of 'structural', 'nonstructural'"),
    ):
        with pytest.raises(dd.errors.InputError, match=sentence):
            dd.write_nrml(path, good, **options)
    for functions, sentence in (
        ({}, "functions: must be a mapping"),
        ({" a": {"collapse": curve}}, "taxonomy ' a'"),
        ({"a\tb": {"collapse": curve}}, r"taxonomy 'a\\tb'"),
        ({"a'b": {"collapse": curve}}, 'taxonomy "a\'b"'),
        ({"": {"collapse": curve}}, "taxonomy ''"),
        ({"a#b": {"collapse": curve}}, "taxonomy 'a#b'"),
        ({"a": {}}, "must be a mapping of limit states"),
        ({"a": curve}, "must be a mapping of limit states"),
        ({"a": {"near collapse": curve}}, "limit state 'near collapse'"),
        ({"a": {"no_damage": curve}}, "limit state 'no_damage'"),
        ({"a": {76 * "x": curve}}, "at most 75"),
        ({"a": {"metà": curve}}, "limit state 'metà'"),
        ({"a": {"x": curve}, "b": {"y": curve}}, "taxonomy 'b': has the limit states y: must be x"),
        ({"a": {"x": curve, "y": curve}, "b": {"y": curve, "x": curve}}, "has the limit states y, x: must be x, y"),
        ({"a": {"x": curve, "y": DiscreteFragility([0.1, 0.2], [0, 1])}}, "must be all Fragility or all"),
        ({"a": {"x": 0.3}}, "must be all Fragility or all"),
        ({"a": {"x": curve, "y": lognormal(0.9, 0.4, "pgv")}}, "must be of one intensity measure"),
    ):
        with pytest.raises(dd.errors.InputError, match=sentence):
            dd.write_nrml(path, functions)
    assert not path.exists()
    dd.write_nrml(path, {"<&>": {"collapse": curve}}, description="walls < 3 m & parapets")
    assert list(check(path)) == ["<&>"]
    # Accents and blanks, which the engine takes
    dd.write_nrml(path, {"città vecchia/Nähe": {"collapse": curve}}, description="metà della città")
    assert list(check(path)) == ["città vecchia/Nähe"]
    found = dd.read_nrml(path)
    assert list(found.functions) == ["città vecchia/Nähe"]
    assert found.description == "metà della città"


def test_average_accelerations_are_named(path):
    """OpenQuake's name has no periods: the file keeps them in a comment, and another's file needs them."""
    curve = lognormal(0.4, 0.3, "saavg(0.2:2)")
    other = {"a": {"collapse": curve}, "b": {"collapse": lognormal(0.5, 0.3)}}
    with pytest.raises(dd.errors.InputError, match=r"imt is not given: must be 'AvgSA' or 'AvgSA\(T\)' for saavg"):
        dd.write_nrml(path, other)
    with pytest.raises(dd.errors.InputError, match="imt = 'PGA': must be 'AvgSA'"):
        dd.write_nrml(path, other, imt="PGA")
    with pytest.raises(dd.errors.InputError, match="imt = 'AvgSA': must be left out"):
        dd.write_nrml(path, {"b": other["b"]}, imt="AvgSA")
    for imt in ("AvgSA", "AvgSA(0.5)"):
        dd.write_nrml(path, other, imt=imt)
        imls = [one.get("imt") for one in ElementTree.parse(path).getroot().iter(f"{SPACE}imls")]
        assert imls == [imt, "PGA"]
        found = dd.read_nrml(path)
        assert [one["collapse"].im for one in found.functions.values()] == ["saavg(0.2:2)", "pga"]
        found.write(path)
        assert dd.read_nrml(path).imts == {"a": imt}
    path.write_text(re.sub("<!-- AvgSA.*?-->", "", path.read_text()))
    with pytest.raises(dd.errors.InputError, match=r"im of AvgSA\(0.5\): must be given as 'saavg\(T1:T2\)'"):
        dd.read_nrml(path)
    assert dd.read_nrml(path, im="saavg(0.3:1)").functions["a"]["collapse"].im == "saavg(0.3:1)"


@pytest.mark.parametrize("beta", [0.2, 0.35, 0.6, 1.0])
def test_few_levels_give_the_frequencies(beta):
    """12 to 40 levels, close to the curve where its risk comes from: frequencies by quadrature over ln x."""
    from dondolo.curves.straight_lines import few_straight_lines

    states = [dd.Fragility.of_parameters(theta, beta, im="pga") for theta in (0.4, 0.7)]
    levels, p = few_straight_lines(lambda x: np.array([one(x) for one in states]), np.array([0.4, 0.6, 0.8]))
    assert 12 <= len(levels) <= 40
    assert p[:, 0].max() <= 1e-9
    x = np.geomspace(levels[0], levels[-1], 40001)
    for state, found in zip(states, p, strict=True):
        lines = np.interp(x, levels, found)
        assert np.abs(lines - state(x)).max() < 0.03
        for k in (1.0, 2.0, 2.5):
            weight = x**-k
            share = np.trapezoid(lines * weight, np.log(x)) / np.trapezoid(state(x) * weight, np.log(x))
            assert share == pytest.approx(1.0, abs=0.004 if beta < 0.7 else 0.015)


def test_without_a_fit(path, tmp_path):
    nothing = dd.fit_fragility([0.2, 0.4], [0, 0], 44, im="pga")
    with pytest.raises(dd.errors.DondoloError, match=r"limit state 'collapse': has no curve \(status 'no_collapse'\)"):
        dd.write_nrml(path, {"a": {"collapse": nothing}})
    with pytest.raises(dd.errors.DondoloError, match="cannot be written"):
        dd.write_nrml(tmp_path / "none" / "model.xml", {"a": {"collapse": lognormal(0.6, 0.4)}})


def test_probabilities():
    for levels, p, sentence in (
        ([0.1], [0.1], "levels: must be at least two"),
        ([0.2, 0.1], [0.1, 0.2], "levels = 0.2, 0.1: must increase strictly"),
        ([-0.1, 0.1], [0.1, 0.2], "levels = -0.1: must not be negative"),
        ([0.0, 0.1], [0.1, 0.2], "probability = 0.1 at the level 0: must be 0"),
        ([0.1, 0.2], [0.1], "2 levels, 1 probabilities"),
        ([0.1, 0.2], [0.1, 1.2], "probability = 1.2: must lie between 0 and 1"),
        ([0.1, 0.2], [0.1, np.nan], "probability = nan"),
        ([0.1, 0.2], [0.3, 0.2], "probability = 0.3, 0.2: must not decrease"),
    ):
        with pytest.raises(dd.errors.InputError, match=sentence):
            DiscreteFragility(levels, p)


def test_a_function_shows_itself_in_a_line():
    curve = DiscreteFragility(np.geomspace(0.01, 2.0, 500), np.linspace(0.0, 0.75, 500))
    assert repr(curve) == "<DiscreteFragility: levels 500 of pga, 0.01 to 2 g, probability 0 to 0.75>"


# As the engine's own tests have them: blanks and lines anywhere, limits left out, a shape of a discrete function
FOREIGN = """<?xml version="1.0" encoding="utf-8"?>
<nrml
xmlns="http://openquake.org/xmlns/nrml/0.5" xmlns:gml="http://www.opengis.net/gml">
    <fragilityModel assetCategory="building" id="fm_12" lossCategory="structural">
        <description>
            Fragility model
        </description>
        <limitStates>
            LS1 LS2
        </limitStates>
        <!-- theta = 9.0, beta = 9.0 -->
        <fragilityFunction format="discrete" id="RC" shape="logncdf">
            <imls imt="PGA" noDamageLimit="0">
                0.1 0.2 0.3 0.5
            </imls>
            <poes ls="LS1"> 0.0073 0.35 0.74 0.99 </poes>
            <poes ls="LS2"> 0.001 0.02
            0.25 0.72 </poes>
        </fragilityFunction>
        <fragilityFunction id="UNM/C_LR/GOV2" format="continuous" shape="logncdf">
            <imls imt="SA(0.30)" minIML="0.05" maxIML="15"/>
            <!-- theta = 9.0, beta = 9.0 -->
            <params ls="LS1" mean="0.15" stddev="0.39"/>
            <params ls="LS2" mean="0.22" stddev="0.41"/>
        </fragilityFunction>
    </fragilityModel>
</nrml>
"""


def same(one, other):
    """Models equal to the bit."""
    assert list(one.functions) == list(other.functions)
    assert one.limits == other.limits
    for name in ("id", "description", "asset_category", "loss_category"):
        assert getattr(one, name) == getattr(other, name)
    for taxonomy, curves in one.functions.items():
        assert list(curves) == list(other.functions[taxonomy])
        for state, curve in curves.items():
            twin = other.functions[taxonomy][state]
            assert (type(curve), curve.im) == (type(twin), twin.im)
            for name in ("theta", "beta") if isinstance(curve, dd.Fragility) else ("levels", "probability"):
                np.testing.assert_array_equal(getattr(curve, name), getattr(twin, name))


@pytest.mark.filterwarnings("ignore::dondolo.errors.DondoloWarning")
def test_round_trip(path, tmp_path):
    """What is read is what was written, to the bit, in other units too; and is written as the same bytes.

    Lines from no intensity have one level more, at which they have 1e-9.
    """
    rng = np.random.default_rng(2)
    functions = {
        f"{im}-{i}": {"c": dd.Fragility.of_parameters(*np.exp(rng.normal(size=2) - 1.0), im=im)}
        for im in ("pga", "pgv", "sa(0.3)")
        for i in range(20)
    }
    functions["fitted"] = {"c": lognormal(0.6, 0.4)}
    for im in ("pga", "pgv"):
        levels = np.cumsum(rng.random(20))
        functions[f"levels-{im}"] = {"c": DiscreteFragility(levels, np.sort(rng.random(20)), im=im)}
    dd.write_nrml(path, functions, id="centre", description="a < b", loss_category="contents")
    model = dd.read_nrml(path)
    for taxonomy, curves in functions.items():
        for name in ("theta", "beta") if isinstance(curves["c"], dd.Fragility) else ("levels", "probability"):
            given, found = getattr(curves["c"], name), getattr(model.functions[taxonomy]["c"], name)
            np.testing.assert_array_equal(found[1:] if name == "levels" or name == "probability" else found, given)
    before = path.read_bytes()
    model.write(tmp_path / "again.xml")
    assert (tmp_path / "again.xml").read_bytes() == before
    model.save(tmp_path / "model.npz")
    same(model, dd.load(tmp_path / "model.npz"))
    assert repr(model) == "<FragilityModel: id centre, functions 63, limit states c>"


def test_models_of_others(path, tmp_path):
    """Also such as write_nrml would refuse, with a warning: these curves cross."""
    path.write_text(FOREIGN)
    with pytest.warns(
        dd.errors.DondoloWarning, match=r"'LS2' is more probable than 'LS1' above 5\.06: the curves cross"
    ):
        model = dd.read_nrml(path)
    assert list(model.functions) == ["RC", "UNM/C_LR/GOV2"]
    assert model.description == "Fragility model"
    np.testing.assert_array_equal(model.functions["RC"]["LS2"].probability, [0.001, 0.02, 0.25, 0.72])
    assert model.limits == {"RC": (0.0, None, None), "UNM/C_LR/GOV2": (None, 0.05, 15.0)}
    curve = model.functions["UNM/C_LR/GOV2"]["LS1"]
    assert curve.im == "sa(0.3)"
    # As openquake.risklib.scientific has them; the comment, which does not fit, is not believed
    assert curve.theta == pytest.approx(0.15**2 / np.sqrt(0.39**2 + 0.15**2), rel=1e-14)
    assert curve.beta == pytest.approx(np.sqrt(np.log(1.0 + (0.39 / 0.15) ** 2)), rel=1e-14)
    model.write(tmp_path / "again.xml")
    with pytest.warns(dd.errors.DondoloWarning, match="the curves cross"):
        same(model, dd.read_nrml(tmp_path / "again.xml"))
    with pytest.raises(dd.errors.InputError, match="exists, and is not a fragility model of dondolo"):
        model.write(path)


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("<nrml", "<nrm", "is not XML"),
        ("nrml/0.5", "nrml/0.4", "is NRML 0.4: must be 0.5, into which 'oq upgrade_nrml' turns it"),
        ("http://openquake.org", "http://example.org", "is not NRML"),
        ("fragilityModel", "vulnerabilityModel", "must have one fragilityModel, there are 0"),
        ("limitStates", "states", "must have limitStates"),
        ("LS1 LS2\n", "LS1 LS1\n", "limitStates: must be names, each once"),
        ('id="UNM/C_LR/GOV2"', 'id="RC"', "fragilityFunction 'RC': is a duplicate"),
        ('format="discrete"', 'format="tabular"', "format = 'tabular': must be continuous or discrete"),
        ('imt="PGA"', 'imt="MMI"', "fragilityFunction 'RC': imt = 'MMI': must be PGA, PGV, SA"),
        ('<poes ls="LS1">', '<poes ls="LS3">', "has the limit states LS3 LS2: must be LS1 LS2"),
        ("0.74 0.99", "0.74", "limit state 'LS1': 4 levels, 3 probabilities"),
        ("0.74 0.99", "0.99 0.74", "probability = 0.99, 0.74: must not decrease"),
        ("0.74 0.99", "0.74 x", "poes = 'x': must be a number, not negative"),
        ("0.1 0.2 0.3 0.5", "0.1 0.3 0.2 0.5", r"levels = 0.3, 0.2: must increase"),
        ('maxIML="15"', "", "imls: must have minIML and maxIML"),
        ('stddev="0.39"', 'stddev="0"', "mean = 0.15, stddev = 0: must be positive"),
        ('stddev="0.39"', "", "params: must have stddev"),
    ],
)
def test_models_that_are_refused(path, old, new, message):
    path.write_text(FOREIGN.replace(old, new))
    with pytest.raises(dd.errors.InputError, match=message) as error:
        dd.read_nrml(path)
    assert str(error.value).startswith(str(path))
    assert "\n" not in str(error.value)


def test_the_engine_reads_it(path):
    """OpenQuake itself, where it is installed."""
    # Its import sets variables of the environment.
    with mock.patch.dict(os.environ):
        nrml = pytest.importorskip("openquake.hazardlib.nrml", reason="openquake.engine is not installed")
        pytest.importorskip("openquake.risklib.read_nrml", reason="openquake.engine is not installed")
    curves = {"damage": lognormal(0.3, 0.35), "collapse": lognormal(0.6, 0.4)}
    steps = {
        name: DiscreteFragility([0.1, 0.4, 0.9], p)
        for name, p in (("damage", [0, 0.5, 1]), ("collapse", [0, 0.1, 0.8]))
    }
    dd.write_nrml(path, {"lognormal": curves, "steps": steps})
    model = nrml.to_python(str(path))
    assert model.limitStates == list(curves)
    x = np.array([0.05, 0.1, 0.25, 0.4, 0.6, 0.9])
    expected = [curve(x) for curve in curves.values()]
    found = [curve(x) for curve in model["PGA", "lognormal"].build(model.limitStates, 0, 0)]
    np.testing.assert_allclose(found, expected, rtol=1e-12)
    for curve, ours in zip(model["PGA", "steps"].build(model.limitStates, 0, 0), steps.values(), strict=True):
        np.testing.assert_array_equal(curve(ours.levels), ours.probability)


def test_a_curve_of_parameters(tmp_path):
    curve = dd.Fragility.of_parameters(0.6, 0.4, im="pga")
    assert curve(0.6) == 0.5
    assert "standard errors none: the parameters were given" in repr(curve)
    with pytest.raises(dd.errors.DondoloError, match="no standard errors: the parameters were given"):
        curve.interval(0.6)
    line = curve.plot().lines[0]
    assert line.get_xdata()[-1] > 0.6 * np.exp(3 * 0.4)
    for wrong in ((0.0, 0.4), (0.6, np.nan), (0.6, "x")):
        with pytest.raises(dd.errors.InputError, match="must be"):
            dd.Fragility.of_parameters(*wrong)
