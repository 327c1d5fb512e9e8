"""Cloud analysis: points, fits against statsmodels and known parameters, total probability."""

import matplotlib

matplotlib.use("agg")

import warnings
from dataclasses import replace

import matplotlib.pyplot as plt
import numpy as np
import pytest
from refusals import refused
from scipy import stats

import dondolo as dd
from dondolo._fortran import _core
from dondolo.analysis.cloud import fit

FACTOR = 2.5


@pytest.fixture(scope="module")
def cloud(wall, records):
    """A cloud with all that may happen: walls that do not move, rock and collapse."""
    return dd.cloud(wall, records, scale=FACTOR, polarity="both", progress=False)


def simulated(seed=1, n=40_000):
    """A cloud of known parameters: intensity, EDP, collapsed."""
    random = np.random.default_rng(seed)
    x = np.exp(random.normal(-1.0, 0.6, size=n))
    collapsed = random.random(n) < 1.0 / (1.0 + np.exp(-(1.0 + 4.0 * np.log(x))))
    rocks = random.random(n) < 1.0 / (1.0 + np.exp(-(6.0 + 3.5 * np.log(x))))
    edp = np.exp(-0.7 + 1.8 * np.log(x) + 0.5 * random.normal(size=n)) * rocks
    return x, np.where(collapsed, 1.0, np.minimum(edp, 0.999)), collapsed


def put_in(cloud, x, edp, collapsed):
    """A cloud of other points."""
    return replace(cloud, intensity=x, edp=edp, collapsed=collapsed, **fit(x, edp, collapsed, cloud.im))


def test_every_point_is_the_motion_it_stands_for(cloud, wall, records):
    assert len(cloud.edp) == 2 * len(records)
    for k in range(0, len(cloud.edp), 5):
        record = records[cloud.record_index[k]]
        motion = dd.simulate(wall, record, FACTOR * cloud.polarity[k], solver=dd.Solver(engine="lanes"), history=False)
        assert motion.edp == cloud.edp[k]
        assert motion.collapsed == cloud.collapsed[k]
        assert cloud.intensity[k] == pytest.approx(FACTOR * record.peak_acceleration / 9.81, rel=1e-14)
    assert cloud.polarity.tolist() == [1] * len(records) + [-1] * len(records)
    assert not cloud.edp.flags.writeable


@pytest.mark.parametrize("im", ["pgv", "sa(0.5)", "arias", "cav", "hi", "saavg(0.2:2)", "pgd"])
def test_other_measures(cloud, records, im):
    other = cloud.against(im)
    power = 2.0 if im == "arias" else 1.0
    expected = [FACTOR**power * record.intensity(im) for record in records]
    assert other.intensity == pytest.approx(2 * expected, rel=1e-12)
    assert other.im == im
    assert other.edp is cloud.edp
    assert other.slope != cloud.slope


def test_measures_of_the_wall(cloud, wall, records):
    assert cloud.against("pga/a0").intensity == pytest.approx(
        cloud.intensity * 9.81 / wall.trigger_acceleration, rel=1e-12
    )
    pgv = np.array([record.intensity("pgv") for record in records])
    expected = FACTOR * pgv * wall.frequency_parameter / wall.trigger_acceleration
    assert cloud.against("p*pgv/a0").intensity == pytest.approx(np.tile(expected, 2), rel=1e-12)


def test_it_is_one_call_for_many_records(wall, records, replace_procedure):
    """No loop over histories in Python."""
    calls = []
    run_block = _core.stripes.run_block
    replace_procedure("stripes.run_block", lambda *given: calls.append(given) or run_block(*given))
    many = [
        dd.Record(record.acceleration[:400], record.dt, f"{record.name}_{i}") for i in range(5) for record in records
    ]
    assert len(dd.cloud(wall, many, progress=False).edp) == 220
    assert len(calls) <= 3


@pytest.mark.slow
def test_fits_against_statsmodels(cloud):
    api = pytest.importorskip("statsmodels.api")
    x = np.log(cloud.intensity)
    stands = ~cloud.collapsed
    rocks = stands & (cloud.edp > 0.0)
    assert min(rocks.sum(), cloud.collapsed.sum(), (cloud.edp == 0.0).sum()) > 5
    line = api.OLS(np.log(cloud.edp[rocks]), api.add_constant(x[rocks])).fit()
    assert [cloud.intercept, cloud.slope] == pytest.approx(line.params, rel=1e-10)
    assert cloud.sigma == pytest.approx(np.sqrt(line.scale), rel=1e-12)
    assert cloud.r2 == pytest.approx(line.rsquared, rel=1e-12)
    assert cloud.regression.se_slope == pytest.approx(line.bse[1], rel=1e-10)
    assert cloud.regression.histories == rocks.sum()
    for model, kind, at in ((cloud.collapse, cloud.collapsed, x), (cloud.rocking, rocks[stands], x[stands])):
        logit = api.Logit(kind.astype(float), api.add_constant(at)).fit(disp=0, tol=1e-12, maxiter=100)
        assert [model.b0, model.b1] == pytest.approx(logit.params, rel=1e-7)
        assert (model.histories, model.count, model.status) == (len(kind), kind.sum(), "ok")
        assert model(np.exp(at)) == pytest.approx(logit.predict(), rel=1e-6)


def test_known_parameters(cloud):
    x, edp, collapsed = simulated()
    models = fit(x, edp, collapsed, "pga")
    line, rocking, collapse = (models[what] for what in ("regression", "rocking", "collapse"))
    assert abs(line.slope - 1.8) < 3.0 * line.se_slope < 0.05
    assert line.intercept == pytest.approx(-0.7, abs=0.02)
    assert line.sigma == pytest.approx(0.5, abs=0.01)
    assert (rocking.b0, rocking.b1) == pytest.approx((6.0, 3.5), abs=0.25)
    assert (collapse.b0, collapse.b1) == pytest.approx((1.0, 4.0), abs=0.1)
    # Total probability is what is counted in narrow bands of the intensity.
    made = put_in(cloud, x, edp, collapsed)
    for level in (0.2, 0.35, 0.6, 1.0):
        near = np.abs(np.log(x / level)) < 0.04
        for threshold in (0.1, 0.3):
            counted = (edp[near] > threshold).mean()
            error = np.sqrt(counted * (1.0 - counted) / near.sum()) + 1e-3
            assert abs(made.fit(threshold)(level) - counted) < 4.0 * error


def test_total_probability(cloud):
    x = np.array([[0.0, 0.3], [0.6, 1.2]])
    found = cloud.fit(0.4)(x)
    assert found.shape == x.shape
    assert found[0, 0] == 0.0
    assert isinstance(cloud.fit()(0.6), float)
    line = stats.norm.cdf((cloud.intercept + cloud.slope * np.log(0.6) - np.log(0.4)) / cloud.sigma)
    p = cloud.collapse(0.6)
    assert found[1, 0] == pytest.approx(p + (1.0 - p) * cloud.rocking(0.6) * line, rel=1e-13)
    grid = np.linspace(0.01, 3.0, 200)
    assert np.all(np.diff(cloud.fit(0.4)(grid)) >= 0.0)
    assert np.all(cloud.fit(0.2)(grid) >= cloud.fit(0.4)(grid))
    for threshold in (0.0, 1.2, np.nan):
        with pytest.raises(dd.errors.InputError, match="must be positive and at most edp_limit = 1"):
            cloud.fit(threshold)(0.5)


def test_lognormal_in_closed_form(cloud):
    random = np.random.default_rng(2)
    x = np.exp(random.normal(-2.0, 0.5, size=500))
    edp = np.exp(-0.7 + 1.8 * np.log(x) + 0.3 * random.normal(size=500))
    made = put_in(cloud, x, edp, np.zeros(500, dtype=bool))
    assert (made.collapse.status, made.rocking.status) == ("none", "all")
    fitted = made.fit(0.1)
    theta, beta = fitted.theta, fitted.beta
    assert theta == pytest.approx(np.exp((np.log(0.1) - made.intercept) / made.slope), rel=1e-13)
    assert beta == pytest.approx(made.sigma / made.slope, rel=1e-13)
    grid = np.linspace(0.01, 1.0, 50)
    assert made.fit(0.1)(grid) == pytest.approx(stats.norm.cdf(np.log(grid / theta) / beta), rel=1e-9, abs=1e-15)


def test_equivalent_lognormal(cloud):
    fitted = cloud.fit(0.4)
    theta, beta = fitted.theta, fitted.beta
    assert cloud.fit(0.4)(theta) == pytest.approx(0.5, abs=1e-9)
    grid = np.geomspace(0.01, 10.0, 400_001)
    curve = cloud.fit(0.4)(grid)
    low, high = np.interp([0.16, 0.84], curve, np.log(grid))
    assert beta == pytest.approx(0.5 * (high - low), abs=1e-6)


def test_a_gap_is_no_step_made_up(cloud):
    """All walls above some intensity rock, all below do not: nothing is said in between."""
    x = np.array([0.1, 0.15, 0.2, 0.3, 0.4, 0.5, 0.7, 0.9])
    edp = np.array([0.0, 0.0, 0.0, 0.02, 0.05, 0.06, 0.3, 0.5])
    made = put_in(cloud, x, edp, np.zeros(8, dtype=bool))
    assert made.rocking.status == "separated"
    assert made.rocking.bracket == (0.2, 0.3)
    np.testing.assert_array_equal(made.rocking([0.0, 0.2, 0.25, 0.3, 1.0]), [0.0, 0.0, np.nan, 1.0, 1.0])
    np.testing.assert_array_equal(np.isnan(made.fit(0.1)([0.2, 0.25, 0.3])), [False, True, False])
    # 16, 50 and 84 % of a large threshold lie beyond the gap, those of a small one in it.
    fitted = made.fit(0.3)
    theta, beta = fitted.theta, fitted.beta
    assert beta == pytest.approx(made.sigma / made.slope, rel=0.01)
    assert made.fit(0.3)(theta) == pytest.approx(0.5)
    assert np.isnan(made.fit(0.001).theta)


def test_touching_samples_have_no_gap(cloud):
    model = put_in(cloud, np.array([0.1, 0.2, 0.2, 0.4]), np.array([0.0, 0.0, 0.1, 0.2]), np.zeros(4, dtype=bool))
    assert model.rocking.status == "separated"
    np.testing.assert_array_equal(model.rocking([0.1, 0.2, 0.4]), [0.0, 1.0, 1.0])


@pytest.mark.parametrize(
    ("collapsed", "status"),
    [
        ("....", "none"),
        ("xxxx", "all"),
        ("..xx", "separated"),
        ("xx..", "decreasing"),
        (".x.x", "ok"),
        ("x.x.", "decreasing"),
    ],
)
def test_status(collapsed, status):
    kind = np.array([mark == "x" for mark in collapsed])
    x = np.array([0.1, 0.2, 0.3, 0.4])
    model = fit(x, np.where(kind, 1.0, 0.1 * x), kind, "pga")["collapse"]
    assert model.status == status
    assert (model.histories, model.count) == (4, kind.sum())
    assert np.isfinite(model.b1) == (status == "ok")
    expected = {"none": 0.0, "all": 1.0, "decreasing": np.nan}
    if status in expected:
        np.testing.assert_array_equal(model([0.1, 5.0]), [expected[status]] * 2)


def test_without_a_line(cloud):
    made = put_in(cloud, np.array([0.1, 0.2, 0.3]), np.array([0.0, 0.1, 1.0]), np.array([False, False, True]))
    assert made.regression.status == "too_few"
    with pytest.raises(dd.errors.DondoloError, match="1 histories rock without collapse"):
        made.fit()
    same = put_in(cloud, np.full(4, 0.2), np.array([0.1, 0.2, 0.3, 0.4]), np.zeros(4, dtype=bool))
    assert same.regression.status == "too_few"
    assert (
        fit(np.full(4, 0.2), np.array([0.1, 0.2, 1.0, 1.0]), np.arange(4) > 1, "pga")["collapse"].status == "decreasing"
    )


def test_two_sided_walls_rock_by_the_pga(records):
    """The trigger of a symmetric wall is a PGA: below nothing moves, above all do."""
    wall = dd.FreeStandingWall(height=2.0, thickness=0.5)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        cloud = dd.cloud(wall, records, scale=2.0, polarity="both", progress=False)
    assert len(cloud.edp) == len(records)
    low, high = cloud.rocking.bracket
    assert cloud.rocking.status == "separated"
    assert low < wall.trigger_acceleration / 9.81 < high


def test_errors(wall, records):
    for scale in (0.0, -1.0, np.inf, np.nan):
        with pytest.raises(dd.errors.InputError, match=r"scale = .*: must be positive"):
            dd.cloud(wall, records, scale=scale)
    with pytest.raises(dd.errors.InputError, match="record 'flat': has no motion"):
        dd.cloud(wall, [*records[:2], dd.Record(np.zeros(10), 0.01, "flat")])
    with refused("wrong_type", "wall"):
        dd.cloud("wall", records)
    with pytest.raises(dd.errors.InputError, match="im = 'pgx'"):
        dd.cloud(wall, records, im="pgx")
    with pytest.raises(dd.errors.InputError, match="polarity = 'x'"):
        dd.cloud(wall, records, polarity="x")


def test_interruption(wall, records, replace_procedure):
    def stop(*arguments):
        raise KeyboardInterrupt

    replace_procedure("stripes.run_block", stop)
    with pytest.raises(dd.errors.Interrupted, match="interrupted: 0 of 44 histories"):
        dd.cloud(wall, records, progress=False)


def test_tables(cloud, tmp_path):
    table = cloud.to_frame()
    assert list(table["edp"]) == list(cloud.edp)
    assert list(table["polarity"][:2]) == ["as_recorded"] * 2
    cloud.to_csv(tmp_path / "cloud.csv")
    text = (tmp_path / "cloud.csv").read_text()
    assert "# line: ln EDP = " in text
    assert len([row for row in text.splitlines() if row[0] != "#"]) == 1 + len(cloud.edp)
    assert f"collapse {cloud.collapsed.sum()} of {len(cloud.edp)}" in repr(cloud)
    assert "<table>" in cloud._repr_html_()


def test_figure(cloud):
    ax = cloud.plot()
    drawn = {str(line.get_label()).split(" (")[0]: line for line in ax.get_lines()}
    rocks = ~cloud.collapsed & (cloud.edp > 0.0)
    np.testing.assert_array_equal(drawn["rocks"].get_ydata(), cloud.edp[rocks])
    assert (drawn["collapses"].get_ydata() > 1.0).all()
    assert len(drawn["does not move"].get_xdata()) == (cloud.edp == 0.0).sum()
    median = next(line for text, line in drawn.items() if text.startswith("median"))
    x = median.get_xdata()
    np.testing.assert_allclose(median.get_ydata(), np.exp(cloud.intercept + cloud.slope * np.log(x)))
    assert ax.get_xscale() == ax.get_yscale() == "log"
    ax.figure.draw_without_rendering()
    assert {"0.1", "1"} <= {label.get_text() for label in ax.get_yticklabels()}
    right = next(other for other in ax.figure.axes if other is not ax)
    np.testing.assert_allclose(right.get_lines()[0].get_ydata(), cloud.collapse(x))
    assert ax.get_ylim()[0] < drawn["does not move"].get_ydata()[0] < cloud.edp[rocks].min()
    plt.close("all")
