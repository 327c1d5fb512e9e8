"""A wall whose model is uncertain: sample, dispersions, Sobol indices, ends, and what is refused."""

import dataclasses
import itertools
import pickle
import re

import numpy as np
import pytest
from scipy import stats

import dondolo as dd
from dondolo._fortran.uncertainty import published_factors, sensitivity
from dondolo.populations.uncertain_wall import _numbers

LEVELS = np.arange(0.2, 2.6, 0.2)
SOURCES = {
    "restitution_factor": "graziotti_2016",
    "hinge": dd.distributions.Triangular(0.5, 0.6, 0.75),
    "hinge_depth": dd.distributions.Uniform(0.005, 0.02),
}

SOFT = {"density": dd.distributions.Uniform(1600.0, 2000.0)}


@pytest.fixture(scope="module")
def motions():
    return dd.synthetic_records(magnitude=6.5, distance=10.0, site="shallow", n_records=20)


@pytest.fixture(scope="module")
def wall():
    return dd.TwoBlockWall(3.0, 0.25, hinge=0.6, restitution_factor=0.87, name="strip")


@pytest.fixture(scope="module")
def found(wall, motions):
    return dd.propagate_uncertainty(wall, motions, LEVELS, sources=SOURCES, n_variants=80, progress=False)


def test_sample(found):
    """A Latin hypercube within the distributions; what is no source stays."""
    assert len(found.sample) == 80
    factors = np.array([one.restitution_factor for one in found.sample])
    hinges = np.array([one.hinge for one in found.sample])
    parts = np.floor((factors - 0.84) / 0.06 * 80).astype(int)
    assert sorted(parts) == list(range(80))
    assert 0.5 <= hinges.min() < hinges.max() <= 0.75
    assert abs(np.corrcoef(factors, hinges)[0, 1]) < 0.03
    assert {(one.height, one.thickness, one.density, one.overburden) for one in found.sample} == {
        (3.0, 0.25, 1800.0, 0.0)
    }
    assert found.sample[3].name == "strip 0004"


def test_common_random_numbers(found, wall, motions):
    """The variants run under the same records, as each would alone."""
    for i in (0, 41, 79):
        own = dd.multiple_stripe(found.sample[i], motions, LEVELS, progress=False)
        assert np.array_equal(own.collapses, found.typology.collapses[:, i])
        assert own.fit().theta == found.thetas[i]
    assert found.as_given.theta == dd.multiple_stripe(wall, motions, LEVELS, progress=False).fit().theta


def test_dispersions(found):
    thetas = np.array([curve.theta for curve in found.typology.curves[:80]])
    betas = np.array([curve.beta for curve in found.typology.curves[:80]])
    assert found.theta == pytest.approx(stats.gmean(thetas), rel=1e-12)
    assert found.beta_model == pytest.approx(np.log(thetas).std(), rel=1e-12)
    assert found.beta_records == pytest.approx(np.sqrt((betas**2).mean()), rel=1e-12)
    assert found.beta_total == pytest.approx(np.hypot(found.beta_model, found.beta_records), rel=1e-15)
    grid = np.array([0.5, 1.0])
    assert found.curve(grid) == pytest.approx([stats.norm.cdf(np.log(x / thetas) / betas).mean() for x in grid])


def test_ends(found, wall, motions):
    """One source at its ends, the others at their medians."""
    assert found.values[0] == pytest.approx([0.843, 0.87, 0.897], rel=1e-12)
    hinge, depth = (SOURCES[what].ppf(np.array([0.05, 0.5, 0.95])) for what in ("hinge", "hinge_depth"))
    assert np.array_equal(found.values[1:], [hinge, depth])
    walls = [
        dd.TwoBlockWall(3.0, 0.25, hinge=h, hinge_depth=d, restitution_factor=f)
        for f, h, d in [(0.87, hinge[1], depth[1]), (0.87, hinge[0], depth[1]), (0.87, hinge[2], depth[1])]
    ]
    middle, low, high = (dd.multiple_stripe(one, motions, LEVELS, progress=False).fit() for one in walls)
    assert found.at_medians.theta == middle.theta
    assert [curve.theta for curve in found.ends[1]] == [low.theta, high.theta]
    # Lower restitution takes energy out, and a deeper hinge makes the wall more slender
    assert found.ends[0][0].theta > found.ends[0][1].theta
    assert found.ends[2][0].theta > found.ends[2][1].theta


def test_numbers(found):
    """Synthetic histories of this wall are not in doubt: the estimated error moves nothing."""
    assert found.numbers == (found.at_medians.theta, found.at_medians.theta)


def test_histories_in_doubt(wall, motions):
    """Twice the estimated error up to the limit: a history that may collapse, or a collapse that may be none."""
    levels = [0.6, 0.8, 1.0, 1.2]
    stripes = dd.multiple_stripe(wall, motions, levels, estimate_error=True, progress=False)
    error = np.zeros_like(stripes.edp)
    stays = int(np.flatnonzero(~stripes.collapsed[1])[0])
    falls = int(np.flatnonzero(stripes.collapsed[2])[0])
    error[1, stays] = 0.51 * (1.0 - stripes.edp[1, stays])
    error[2, falls] = 1e-9
    low, high = _numbers(dataclasses.replace(stripes, edp_error=error))
    most, least = stripes.collapses.copy(), stripes.collapses.copy()
    most[1] += 1
    least[2] -= 1
    assert low == dd.fit_fragility(levels, most, 20).theta
    assert high == dd.fit_fragility(levels, least, 20).theta
    assert low < stripes.fit().theta < high
    # A small error far below the limit is no doubt, a large one is, wherever the EDP is
    for given, expected in ((0.009, stripes.fit().theta), (0.011, low)):
        calm = np.zeros_like(stripes.edp)
        calm[1, int(np.argmin(stripes.edp[1]))] = given
        assert _numbers(dataclasses.replace(stripes, edp_error=calm))[0] == expected


def test_indices_sum_up(found):
    """Hinge, restitution and depth act nearly one by one."""
    assert found.first.sum() + found.rest == pytest.approx(1.0, abs=0.05)
    assert (found.first <= found.total).all()
    assert (found.first_interval[:, 0] <= found.first).all()
    assert (found.first <= found.first_interval[:, 1]).all()


def additive(x):
    """A polynomial whose indices are known: variances 4/12, 1/12 and 1/180 of linear, linear and square terms."""
    return 2.0 * x[:, 0] + x[:, 1] + (x[:, 2] ** 2 - x[:, 2])


def test_indices_of_a_sum():
    x = stats.qmc.LatinHypercube(3, seed=4).random(400)
    found = sensitivity(x, additive(x))
    parts = np.array([4 / 12, 1 / 12, 1 / 180])
    assert found.first == pytest.approx(parts / parts.sum(), abs=0.01)
    assert found.total == pytest.approx(found.first, abs=1e-12)
    # Ranks are not quite the numbers
    assert found.rest == pytest.approx(0.0, abs=1e-4)


def test_indices_of_a_product():
    """Y = x1 (1 + x2): each alone 27/12 and 3/12 of 4/12 12, the product 1 / 144."""
    x = stats.qmc.LatinHypercube(2, seed=5).random(500)
    found = sensitivity(x, x[:, 0] * (1.0 + x[:, 1]))
    parts = np.array([1.5**2 / 12, 0.5**2 / 12, 1 / 144])
    first, total = parts[:2] / parts.sum(), (parts[:2] + parts[2]) / parts.sum()
    assert found.first == pytest.approx(first, abs=0.01)
    assert found.total == pytest.approx(total, abs=0.01)


def test_indices_do_not_ask_for_the_scale():
    x = stats.qmc.LatinHypercube(3, seed=6).random(200)
    noise = 0.1 * np.random.default_rng(1).standard_normal(200)
    plain = sensitivity(x, additive(x) + noise)
    scaled = sensitivity(np.exp(3.0 * x) * [1.0, 1e6, 1e-6], additive(x) + noise)
    assert scaled == tuple(pytest.approx(part, rel=1e-10) for part in plain)


def test_noise_is_no_source():
    """A quantity without influence has an index whose interval holds zero, and the noise is what is left."""
    inside = []
    for seed in range(60):
        x = stats.qmc.LatinHypercube(3, seed=seed).random(120)
        noise = 0.5 * np.random.default_rng(seed).standard_normal(120)
        found = sensitivity(x, x[:, 0] + noise)
        share = (1 / 12) / (1 / 12 + 0.25)
        inside.append(found.first_interval[0][0] <= share <= found.first_interval[0][1])
        assert found.first[1] < 0.25
    assert np.mean(inside) > 0.85


def test_indices_of_few_values():
    """A choice of two has one polynomial."""
    x = np.array(list(itertools.product([0.0, 1.0], np.arange(40))), dtype=float)
    found = sensitivity(x, 3.0 * x[:, 0] + x[:, 1] / 40.0)
    variance = np.array([9.0 / 4.0, (40.0**2 - 1.0) / 12.0 / 40.0**2])
    assert found.first == pytest.approx(variance / variance.sum(), rel=1e-10)


def test_published():
    """Values as published; every name is a distribution of factors."""
    published = published_factors()
    assert published["graziotti_2016"][:3] == ("uniform", 0.84, 0.90)
    assert published["elgawady_2010"][:3] == ("uniform", 0.90, 1.00)
    assert published["colombo_2025"][:3] == ("normal", 0.990, 0.018)
    assert "limestone" in published["colombo_2025"].source
    assert "concrete" in published["elgawady_2010"].source
    assert all(name.split("_")[1] in one.source for name, one in published.items())


def test_one_sided_with_sections(motions):
    """What a wall has beside numbers goes on: storeys, loads, words, gravity."""
    whole = dd.OneSidedWall(
        sections=[dd.Section(1.0, 0.4), dd.Section(0.8, 0.3)],
        loads=[
            dd.Load(2000.0, depth=0.2, height=1.0, inertia="both"),
            dd.Load(1000.0, depth=0.2, height=1.8, inertia="none"),
        ],
        gravity=9.8,
        name="front",
    )
    found = dd.propagate_uncertainty(whole, motions, LEVELS, sources=SOFT, n_variants=20, progress=False)
    one = found.sample[7]
    assert (one.sections, one.loads, one.gravity) == (whole.sections, whole.loads, 9.8)
    assert found.at_medians.theta == found.as_given.theta
    assert found.first[0] + found.rest == pytest.approx(1.0, abs=0.05)


def test_variants_without_a_fit(wall, motions, found):
    """The levels end below the medians of some: it is said of how many variants theta and indices are."""
    sources = {"thickness": dd.distributions.Uniform(0.15, 0.45)}
    levels = [0.3, 0.5, 0.7, 0.9]
    with pytest.warns(dd.errors.DondoloWarning, match="variants that have a fit") as caught:
        few = dd.propagate_uncertainty(wall, motions, levels, sources=sources, n_variants=40, progress=False)
    (told,) = (one.message for one in caught if one.message.code == "variants_without_fit")
    fitted = int(np.isfinite(few.thetas).sum())
    assert 8 <= fitted < 40
    assert told.numbers == {"fitted": fitted, "variants": 40}
    assert f"{fitted} of 40" in str(told)
    assert f"{fitted} of 40" in repr(few)
    assert "variants with a fit" not in repr(found)


def test_files(found, tmp_path):
    found.save(tmp_path / "strip.npz")
    again = dd.load(tmp_path / "strip.npz")
    assert again.theta == found.theta
    assert again.numbers == found.numbers
    assert np.array_equal(again.total_interval, found.total_interval)
    found.to_csv(tmp_path / "strip.csv")
    text = (tmp_path / "strip.csv").read_text()
    assert "\n# unit of theta: g\n# theta: " in text
    assert '\nhinge,"Triangular(low=0.5, mode=0.6, high=0.75)",' in text
    assert "restitution_factor" in repr(found)


def test_plot(found):
    left, right = found.plot().figure.axes
    assert left.get_ylabel() == "probability of collapse"
    rows = {text.get_text().split(",")[0] for text in right.texts if not text.get_text().endswith("%")}
    words = {"restitution_factor": "ratio of restitution", "hinge": "height of the hinge"}
    named = {words.get(name, name) for name in SOURCES} - {"hinge_depth"} | {"depth of the hinge"}
    assert rows - {"records"} == named | {"numerical error"}
    # Bars begin at the median with all sources at their medians, wherever their ends are.
    middle = found.at_medians.theta
    bars = [drawn for drawn in right.lines if len(drawn.get_xdata()) == 2 and drawn.get_linewidth() == 3.0]
    assert len(bars) == len(SOURCES) + 2
    assert all(min(bar.get_xdata()) <= middle <= max(bar.get_xdata()) for bar in bars)
    # What the shares do not sum to is said.
    (said,) = (label for label in right.get_legend_handles_labels()[1] if "shares" in label)
    assert f"{100.0 * np.nansum(found.total):.0f}\u00a0%" in said
    assert f"another {100.0 * found.rest:.0f}\u00a0%" in said
    assert "[g]" in right.get_xlabel()
    with pytest.raises(dd.errors.InputError, match="ax: must be 2 Axes"):
        found.plot([left])


@pytest.mark.parametrize(
    ("sources", "message"),
    [
        ({}, "sources: must be a mapping"),
        ([("hinge", dd.distributions.Uniform(0.4, 0.6))], "sources: must be a mapping"),
        ({"name": dd.distributions.Uniform(0.4, 0.6)}, "'name': must be one of height, thickness, density"),
        ({"tie_area": dd.distributions.Uniform(0.4, 0.6)}, "'tie_area': must be one of"),
        ({"hinge": 0.5}, "hinge = 0.5: must be a distribution"),
        (
            {"hinge": "graziotti_2016"},
            "hinge = 'graziotti_2016': must be a distribution; names are for",
        ),
        ({"restitution_factor": "nobody"}, "'nobody': must be a distribution; .*'graziotti_2016', 'elgawady_2010'"),
        ({"hinge": dd.distributions.Uniform(0.5, 1.5)}, "wall 'strip 00.*: hinge = .*: must lie between 0.01 and 0.99"),
        (
            {"hinge": dd.distributions.Uniform(0.5, 0.6), "density": dd.distributions.Uniform(1.6e3, 2e3)},
            "n_variants = 12: must be an integer, between 16",
        ),
    ],
)
def test_refused(wall, motions, sources, message):
    with pytest.raises(dd.errors.DondoloError, match=message):
        dd.propagate_uncertainty(wall, motions, LEVELS, sources=sources, n_variants=12, progress=False)


@pytest.mark.parametrize(
    ("given", "told"),
    [
        ("uniform(0.5, 0.6)", r"dd.distributions.Uniform\(0.5, 0.6\)"),
        ("Triangular(0.5, 0.6, 0.75)", r"dd.distributions.Triangular\(0.5, 0.6, 0.75\)"),
        ("lognormal(0.5, 0.1, 0.4, 0.7)", r"dd.distributions.Lognormal\(0.5, 0.1, low=0.4, high=0.7\)"),
    ],
)
def test_texts_of_cases_are_refused_with_what_to_write(given, told):
    with pytest.raises(dd.errors.InputError, match=f"must be a distribution, here {told}; such texts are for cases"):
        dd.propagate_uncertainty(dd.TwoBlockWall(3.0, 0.25), [], [0.5], sources={"hinge": given})


@pytest.mark.parametrize(
    ("wall", "name", "message"),
    [
        (dd.OneSidedWall(1.5, 0.25), "graziotti_2016", "is of tests of mechanism = 'two_block'"),
        # Of a block that bounces off a transverse wall equation (2) is no ratio to Housner's value, and (4) is none.
        (dd.OneSidedWall(1.5, 0.25), "elgawady_2010", "is of tests of mechanism = 'free_standing'"),
        (dd.OneSidedWall(1.5, 0.25), "colombo_2025", "is of tests of mechanism = 'free_standing'"),
        (dd.TwoBlockWall(2.7, 0.24), "elgawady_2010", "is of tests of mechanism = 'free_standing'"),
        (
            dd.TwoBlockWall(2.7, 0.24, restitution="impulse"),
            "graziotti_2016",
            r"is a ratio to restitution = 'sorrentino', must be .* for 'impulse'; the same speeds are uniform\(",
        ),
        (
            dd.TwoBlockWall(2.7, 0.24, restitution_value=0.8),
            "graziotti_2016",
            "is a ratio to restitution = 'sorrentino', must be a range or distribution for restitution_value$",
        ),
        # The default of a wall that lifts a mass is 'impulse'.
        (
            dd.TwoBlockWall(2.7, 0.24, overburden=6e3, overburden_inertia=0.5),
            "graziotti_2016",
            "for 'impulse', the model of a wall that lifts the mass of its overburden",
        ),
        (
            dd.FreeStandingWall(2.0, 0.3, restitution_value=0.8),
            "elgawady_2010",
            "is a ratio to restitution = 'impulse', must be a range or distribution for restitution_value",
        ),
    ],
)
def test_a_published_range_is_of_its_model(wall, name, message):
    with pytest.raises(dd.errors.InputError, match=message):
        dd.propagate_uncertainty(wall, [], [0.5], sources={"restitution_factor": name}, n_variants=8)


def test_an_uncertain_load_changes_the_model():
    """The wall as given lifts nothing, all its variants do."""
    wall = dd.TwoBlockWall(2.7, 0.24, overburden_inertia=1.0)
    sources = {"restitution_factor": "graziotti_2016", "overburden": dd.distributions.Uniform(4e3, 8e3)}
    with pytest.raises(dd.errors.InputError, match="for 'impulse', the model of a wall that lifts"):
        dd.propagate_uncertainty(wall, [], [0.5], sources=sources, n_variants=16)


def test_the_rescaled_range_gives_the_same_speeds():
    """Of the range that is named in place of the refused one."""
    wall = dd.TwoBlockWall(2.7, 0.24, hinge=0.62, restitution="impulse")
    with pytest.raises(dd.errors.InputError) as caught:
        dd.propagate_uncertainty(wall, [], [0.5], sources={"restitution_factor": "graziotti_2016"}, n_variants=8)
    low, high = map(float, re.search(r"uniform\((\S+), (\S+)\)", str(caught.value)).groups())
    for factor, measured in ((low, 0.84), (high, 0.90)):
        speeds = [
            dd.TwoBlockWall(2.7, 0.24, hinge=0.62, restitution=model, restitution_factor=by).restitution_coefficient
            for model, by in (("impulse", factor), ("sorrentino", measured))
        ]
        assert speeds[0] == pytest.approx(speeds[1], rel=1e-3)
    # A ratio to impulse is larger: with 0.84 to 0.90 of it the wall would seem too strong.
    assert low > 0.90


def test_free_standing_blocks_have_a_range(motions):
    wall = dd.FreeStandingWall(2.0, 0.3)
    sources = {"restitution_factor": "elgawady_2010"}
    found = dd.propagate_uncertainty(wall, motions, [0.2, 0.4, 0.8, 1.6], sources=sources, n_variants=8, progress=False)
    assert found.values[0, 1] == pytest.approx(0.95)


@pytest.mark.parametrize(
    ("height", "sources", "sd"),
    [(1.0, {}, 0.018), (3.6, {}, 0.0105), (2.7, {"height": dd.distributions.Uniform(2.0, 3.6)}, 0.0105)],
)
def test_restitution_of_stone(motions, height, sources, sd):
    """The mean is kept, and no speed ratio reaches 1, however slender the most slender variant is."""
    wall = dd.FreeStandingWall(height, 0.3)
    sources = {"restitution_factor": "colombo_2025", **sources}
    levels = [0.1, 0.2, 0.4, 0.8, 1.6]
    found = dd.propagate_uncertainty(wall, motions, levels, sources=sources, n_variants=40, progress=False)
    factors = np.array([one.restitution_factor for one in found.sample])
    assert found.values[0, 1] == pytest.approx(0.990)
    assert factors.mean() == pytest.approx(0.990, abs=1e-3)
    assert factors.std() == pytest.approx(sd, rel=0.15)
    assert max(one.restitution_coefficient for one in found.sample) < 1.0
    assert "Normal(mean=0.99, sd=0.018, low=" in found.distributions[0]


def test_stripes_name_the_range_of_their_model(motions):
    def said(**more):
        stripes = dd.multiple_stripe(dd.TwoBlockWall(2.7, 0.24, **more), motions, [0.5, 1.0], progress=False)
        return dict(stripes._facts()).get("restitution", "")

    assert said().startswith("1 times that of the model; tests on two-block walls gave 0.84 to 0.9 times it")
    assert "times that of 'sorrentino', which for this wall is" in said(restitution="impulse")
    lifted = said(overburden=6e3, overburden_inertia=1.0)
    assert lifted.endswith("which has no mass of an overburden: they do not apply to this wall")
    assert said(restitution_value=0.8) == ""


def test_too_small_a_sample_is_refused_before_it_runs():
    wall = dd.TwoBlockWall(3.0, 0.25)
    sources = {"hinge": dd.distributions.Uniform(0.5, 0.6), "density": dd.distributions.Normal(1800.0, 90.0)}
    with pytest.raises(dd.errors.InputError, match="n_variants = 15: must be an integer, between 16 and 10000"):
        dd.propagate_uncertainty(wall, [], [0.5], sources=sources, n_variants=15)


def test_ends_must_be_named():
    with pytest.raises(dd.errors.InputError, match=r"must be named: low=0\.001, high=0\.05"):
        dd.distributions.Lognormal(0.01, 0.4, 0.001, 0.05)
    whole = dd.distributions.Lognormal(0.01, 0.4, low=0.001, high=0.05)
    assert pickle.loads(pickle.dumps(whole)) == whole == dataclasses.replace(whole)


def test_texts_are_no_flags(few, wall):
    """Even 'no' would be true."""

    def refused(name):
        return pytest.raises(dd.errors.InputError, match=f"{name} = 'no': must be True or False")

    for name in ("certify", "estimate_error", "progress"):
        with refused(name):
            dd.multiple_stripe(wall, few, [0.4], **{name: "no"})
    for name in ("history", "estimate_error"):
        with refused(name):
            dd.simulate(wall, few[0], **{name: "no"})
    with refused("progress"):
        dd.typology(dd.Population((wall,)), few, [0.2, 0.4], progress="no")
    with refused("descending"):
        dd.RecordSet(few).sort("pga", descending="no")
