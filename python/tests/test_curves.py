"""What every fragility curve can do: the same questions to curves of every origin."""

import numpy as np
import pytest
from refusals import refused
from scipy import integrate, stats

import dondolo as dd

LEVELS = [0.4, 0.6, 0.8, 1.0, 1.3, 1.7]
FREQUENCIES = [0.02, 0.1, 0.5, 2.5], [0.2, 1.5e-2, 4e-4, 3e-6]


@pytest.fixture(scope="module")
def curves(wall, few, records, tmp_path_factory):
    """One of each kind."""
    stripes = dd.multiple_stripe(wall, few, LEVELS, polarity="both", progress=False)
    fitted = stripes.fit()
    walls = [wall, *(dd.OneSidedWall(h, 0.25, name=f"{h} m") for h in (1.7, 1.9))]
    people = dd.typology(walls, few, LEVELS, progress=False)
    path = tmp_path_factory.mktemp("curves") / "model.xml"
    dd.write_nrml(path, {"walls": {"collapse": fitted}})
    # Against the PGA the motions that rock and those that do not leave a gap
    cloud = dd.cloud(wall, records, scale=3.0, polarity="both").against("pgv")
    return {
        "fitted": fitted,
        "first collapse": stripes.incremental().fit(),
        "given": dd.Fragility.of_parameters(0.7, 0.35, im="pga"),
        "of a model": dd.read_nrml(path).functions["walls"]["collapse"],
        "discrete": dd.DiscreteFragility([0.3, 0.7, 1.5], [0.02, 0.5, 0.98]),
        "population": people["all"],
        "cloud": cloud.fit(0.4),
        "logistic": cloud.collapse,
        "function": dd.FunctionFragility(lambda x: stats.gamma.cdf(x, 5.0, scale=0.15)),
    }


KINDS = (
    "fitted",
    "first collapse",
    "given",
    "of a model",
    "discrete",
    "population",
    "cloud",
    "logistic",
    "function",
)


@pytest.mark.parametrize("kind", KINDS)
def test_inverse(curves, kind):
    """Probabilities rise from 0, in the shape of the levels, and levels of probabilities are those of the curve."""
    curve = curves[kind]
    assert isinstance(curve, dd.results.Curve)
    assert curve.im == ("pgv" if kind in ("cloud", "logistic") else "pga")
    x = np.linspace(0.05, 2.0, 40).reshape(8, 5)
    p = curve(x)
    assert p.shape == x.shape
    assert np.all(np.diff(p.ravel()) >= 0.0)
    assert isinstance(curve(0.7), float)
    assert curve(0.0) == 0.0
    q = np.array([[0.1, 0.3], [0.5, 0.8]])
    levels = curve.ppf(q)
    assert levels.shape == q.shape
    assert curve(levels) == pytest.approx(q, abs=1e-9)
    assert curve(curve.ppf(0.0)) == 0.0
    with pytest.raises(dd.errors.InputError, match="must lie between 0 and 1"):
        curve.ppf(1.1)


@pytest.mark.parametrize("kind", KINDS)
def test_risk(curves, kind):
    """Against the trapezoidal rule on intensities drawn from the hazard."""
    curve = curves[kind]
    hazard = dd.HazardCurve(*FREQUENCIES, im=curve.im)
    risk = curve.risk(hazard)
    levels = np.unique(np.append(np.geomspace(0.02, 2.5, 40_001), hazard.levels))
    expected = -integrate.trapezoid(curve(levels), hazard(levels))
    assert risk.inside == pytest.approx(expected, rel=1e-6)
    assert risk.fragility is curve
    with pytest.raises(dd.errors.InputError, match=f"im = '{curve.im}' of the fragility and 'arias' of the hazard"):
        curve.risk(dd.HazardCurve([0.1, 1.0], [0.1, 1e-3], im="arias"))


@pytest.mark.parametrize("kind", KINDS)
def test_nrml(curves, kind, tmp_path):
    """What is read back is the curve, within what straight lines may differ from it."""
    curve = curves[kind]
    curve.to_nrml(tmp_path / "one.xml", taxonomy="mine", state="gone", id="model")
    model = dd.read_nrml(tmp_path / "one.xml")
    assert model.id == "model"
    again = model.functions["mine"]["gone"]
    x = np.linspace(0.1, 2.0, 77)
    assert again(x) == pytest.approx(curve(x), abs=0.009)
    hazard = dd.HazardCurve(*FREQUENCIES, im=curve.im)
    assert again.risk(hazard).inside == pytest.approx(curve.risk(hazard).inside, rel=0.005)


@pytest.mark.parametrize("kind", KINDS)
def test_drawing(curves, kind):
    axes = curves[kind].plot()
    (line, *_) = axes.lines
    x, y = (np.asarray(values, dtype=float) for values in line.get_data())
    if kind not in ("population", "fitted", "first collapse"):
        assert y[y > 0.0] == pytest.approx(curves[kind](x[y > 0.0]), abs=1e-12)
    assert "peak ground" in axes.get_xlabel()


@pytest.mark.parametrize("kind", KINDS)
def test_drawing_with_a_name(curves, kind):
    """Beside others: the curve itself, by its name, in the look that is asked for."""
    axes = curves["discrete"].plot(label="first")
    assert curves[kind].plot(axes, label="mine", color="black", linestyle=":") is axes
    (line,) = (one for one in axes.lines if one.get_label() == "mine")
    assert (line.get_color(), line.get_linestyle()) == ("black", ":")
    x, y = (np.asarray(values, dtype=float) for values in line.get_data())
    assert y[y > 0.0] == pytest.approx(curves[kind](x[y > 0.0]), abs=1e-12)
    assert {"first", "mine"} <= {text.get_text() for text in axes.get_legend().get_texts()}


def test_comparison(curves):
    """Only where there are standard errors; of a population those of the lognormal fitted to its mean."""
    found = curves["fitted"].compare(curves["population"])
    assert found.ratio == curves["fitted"].theta / curves["population"].fit.theta
    assert found.pairing == "paired"
    back = curves["population"].compare(curves["fitted"])
    assert back.ratio * found.ratio == pytest.approx(1.0, rel=1e-14)
    for kind in ("discrete", "logistic", "function", "cloud"):
        with pytest.raises(dd.errors.InputError, match="no standard errors are known of a"):
            curves["fitted"].compare(curves[kind])
    with pytest.raises(dd.errors.DondoloError, match="no standard errors: the parameters were given"):
        curves["fitted"].compare(curves["given"])
    with refused("wrong_type", "other"):
        curves["fitted"].compare(0.5)


def test_the_end_of_a_mean_is_not_passed(few):
    """A wall whose mechanism occurs with probability 0.4 in all: levels of more are infinite."""
    population = dd.Population([dd.OneSidedWall(1.5, 0.25, name="a")], p_occ=[0.4])
    curve = dd.typology(population, few, LEVELS, progress=False)["all"]
    assert np.isfinite(curve.ppf(0.39))
    assert curve(curve.ppf(0.39)) == pytest.approx(0.39, abs=1e-9)
    assert curve.ppf(0.41) == np.inf


def test_logistic_without_a_curve():
    common = {"b0": np.nan, "b1": np.nan, "histories": 4, "count": 2, "im": "pga"}
    apart = dd.results.Logistic(**common, status="separated", bracket=(0.2, 0.3))
    assert np.isnan(apart.ppf(0.5))
    assert (apart.ppf(0.0), apart.ppf(1.0)) == (0.0, 0.3)
    assert dd.results.Logistic(**common, status="none", bracket=(0.0, np.inf)).ppf(0.5) == np.inf
    with pytest.raises(dd.errors.DondoloError, match="no curve was fitted"):
        apart.risk(dd.HazardCurve(*FREQUENCIES))
