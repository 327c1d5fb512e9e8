"""Intensity measures against SciPy, their table, their units, and the comparison of their efficiency."""

import re

import numpy as np
import pytest
from scipy import integrate, signal

import dondolo as dd

GRAVITY = 9.81
PARTS = 40


@pytest.fixture(scope="module")
def record(records):
    """One of the embedded accelerograms."""
    return records[16]


@pytest.fixture(scope="module")
def lines(record):
    """Its straight lines, finely: times and accelerations."""
    time = np.linspace(0.0, record.duration, PARTS * (len(record) - 1) + 1)
    return time, np.interp(time, record.time, record.acceleration)


def quadrature(function, record):
    """Integral over the record: Gauss and Legendre's rule with five points in every half of a step."""
    nodes, weights = np.polynomial.legendre.leggauss(5)
    starts = 0.5 * record.dt * np.arange(2 * (len(record) - 1))
    times = starts[:, None] + 0.25 * record.dt * (nodes + 1.0)
    values = function(np.interp(times, record.time, record.acceleration))
    return 0.25 * record.dt * float((values * weights).sum())


def test_peaks(record, lines):
    time, a = lines
    velocity = integrate.cumulative_trapezoid(a, time, initial=0.0)
    displacement = integrate.cumulative_simpson(velocity, x=time, initial=0.0)
    assert record.intensity("pga") == pytest.approx(record.peak_acceleration / GRAVITY, rel=1e-15)
    assert record.intensity("pgv") == pytest.approx(np.abs(velocity).max(), rel=1e-4)
    assert record.intensity("pgv") >= np.abs(velocity).max() * (1.0 - 1e-12)
    assert record.intensity("pgd") == pytest.approx(np.abs(displacement).max(), rel=1e-5)


def test_energies(record, lines):
    time, a = lines
    energy = quadrature(np.square, record)
    assert record.intensity("arias") == pytest.approx(0.5 * np.pi / GRAVITY * energy, rel=1e-12)
    by_rule = np.trapezoid(record.acceleration**2, dx=record.dt)
    assert record.intensity("arias-trapz") == pytest.approx(0.5 * np.pi / GRAVITY * by_rule, rel=1e-12)
    assert record.intensity("cav-trapz") == pytest.approx(
        np.trapezoid(np.abs(record.acceleration), dx=record.dt), rel=1e-12
    )
    assert record.intensity("arias", gravity=9.0) == pytest.approx(0.5 * np.pi / 9.0 * energy, rel=1e-12)
    assert record.intensity("cav") == pytest.approx(quadrature(np.abs, record), rel=1e-4)
    growth = integrate.cumulative_simpson(a**2, x=time, initial=0.0) / energy
    times = np.interp([0.05, 0.75, 0.95], growth, time)
    assert record.intensity("d5-75") == pytest.approx(times[1] - times[0], abs=1e-5)
    assert record.intensity("d5-95") == pytest.approx(times[2] - times[0], abs=1e-5)


@pytest.mark.parametrize("damping", [0.0, 0.05, 0.3])
@pytest.mark.parametrize("period", [0.02, 0.1, 0.47, 2.0, 9.0])
def test_spectrum_against_lsim(record, lines, period, damping):
    time, a = lines
    omega = 2.0 * np.pi / period
    # A period of still ground after the record, after one fine step in which the acceleration ends
    step = time[1]
    quiet = np.zeros(int(np.ceil(period / step)) + 2)
    a = np.append(a, quiet)
    system = signal.StateSpace(
        [[0.0, 1.0], [-(omega**2), -2.0 * damping * omega]], [[0.0], [-1.0]], [[1.0, 0.0]], [[0.0]]
    )
    _, motion, _ = signal.lsim(system, a, step * np.arange(len(a)))
    spectrum = record.spectrum([period], damping=damping)
    assert spectrum.displacement[0] == pytest.approx(np.abs(motion).max(), rel=2e-4)
    assert spectrum.displacement[0] >= np.abs(motion).max() * (1.0 - 1e-6)


def test_spectrum_against_solve_ivp():
    acceleration = np.array([0.0, 2.0, -3.0, 1.0, 4.0, -4.0, 0.5, 0.0])
    record = dd.Record(acceleration, 0.1)
    period, damping = 0.35, 0.05
    omega = 2.0 * np.pi / period
    solution = integrate.solve_ivp(
        lambda t, y: [
            y[1],
            -np.interp(t, record.time, acceleration, right=0.0) - 2.0 * damping * omega * y[1] - omega**2 * y[0],
        ],
        (0.0, 1.5),
        [0.0, 0.0],
        max_step=0.01,
        rtol=1e-11,
        atol=1e-13,
        dense_output=True,
    )
    peak = np.abs(solution.sol(np.linspace(0.0, 1.5, 150001))[0]).max()
    assert record.spectrum([period], damping=damping).displacement[0] == pytest.approx(peak, rel=1e-8)


def test_spectrum(record):
    periods = np.geomspace(0.01, 20.0, 60)
    spectrum = record.spectrum(periods)
    assert spectrum.pseudo_acceleration == pytest.approx(
        (2.0 * np.pi / periods) ** 2 * spectrum.displacement, rel=1e-14
    )
    assert spectrum.pseudo_velocity == pytest.approx(2.0 * np.pi / periods * spectrum.displacement, rel=1e-14)
    assert spectrum.pseudo_acceleration[0] == pytest.approx(record.peak_acceleration, rel=0.01)
    assert record.intensity("sa(0.5)") == record.spectrum(0.5 * np.ones(1)).pseudo_acceleration[0] / GRAVITY
    assert "60 periods" in repr(spectrum)
    assert list(spectrum.to_frame().columns) == [
        "period [s]",
        "displacement [m]",
        "pseudo_velocity [m/s]",
        "pseudo_acceleration [m/s2]",
    ]
    assert not spectrum.displacement.flags.writeable


def test_averages(record):
    fine = np.linspace(0.1, 2.5, 961)
    velocity = record.spectrum(fine).pseudo_velocity
    assert record.intensity("hi") == pytest.approx(integrate.trapezoid(velocity, fine), rel=1e-3)
    some = record.spectrum(np.linspace(0.2, 2.0, 20)).pseudo_acceleration / GRAVITY
    assert record.intensity("saavg(0.2:2)") == pytest.approx(np.exp(np.log(some).mean()), rel=1e-12)


@pytest.mark.parametrize(
    ("periods", "damping", "sentence"),
    [
        ([0.005], 0.05, "periods = 0.005: must lie between 0.01 and 20 s"),
        ([1.0, np.nan], 0.05, "periods = NaN: must lie between"),
        ([], 0.05, "periods: must be given"),
        ([1.0], 1.0, "damping = 1: must be at least 0 and below 1"),
        ([1.0], -0.1, "damping = -0.1: must be at least 0"),
    ],
)
def test_wrong_spectra(record, periods, damping, sentence):
    with pytest.raises(dd.errors.InputError, match=sentence.replace("(", r"\(")):
        record.spectrum(periods, damping=damping)


def test_wrong_measures(record, wall):
    with pytest.raises(dd.errors.InputError, match=r"im = 'sa\(T\)': must be one of 'pga', .*'sa\(0.5\)'"):
        record.intensity("sa(T)")
    with pytest.raises(dd.errors.InputError, match="im = 'pga/a0': must be one of"):
        record.intensity("pga/a0")
    with pytest.raises(dd.errors.InputError, match="gravity = 0: must be positive"):
        record.intensity("pga", gravity=0.0)
    with pytest.raises(dd.errors.InputError, match="im = 'd5-95': a duration does not change"):
        dd.multiple_stripe(wall, record, [1.0], im="d5-95")


def test_table(few):
    table = dd.RecordSet(few).intensity_table()
    assert list(table["record"]) == [record.name for record in few]
    assert "arias [m/s]" in table.columns
    assert table["pgv [m/s]"].iloc[3] == few[3].intensity("pgv")
    assert list(dd.RecordSet(few[0]).intensity_table(["sa(0.50)"]).columns) == ["record", "sa(0.5) [g]"]
    # A text is one measure, not its letters
    assert list(dd.RecordSet(few).intensity_table("pga").columns) == ["record", "pga [g]"]
    with pytest.raises(dd.errors.InputError, match="ims = 3: must be names"):
        dd.RecordSet(few).intensity_table(3)


@pytest.mark.parametrize(
    "im", ["pgv", "pgd", "arias", "cav", "arias-trapz", "cav-trapz", "hi", "sa(0.5)", "saavg(0.2:2)"]
)
def test_stripes_reach_their_levels(few, im):
    wall = dd.OneSidedWall(height=1.5, thickness=0.25)
    stripes = dd.multiple_stripe(wall, few, [0.05, 0.1], im=im, progress=False)
    assert stripes.im == im
    for level, scales in zip(stripes.levels, stripes.scale, strict=True):
        for record, scale in zip(few, scales, strict=True):
            scaled = dd.Record(scale * record.acceleration, record.dt)
            assert scaled.intensity(im) == pytest.approx(level, rel=1e-12)


@pytest.mark.filterwarnings("ignore::dondolo.errors.DondoloWarning")
def test_measures_of_a_wall(few):
    walls = [dd.OneSidedWall(height=h, thickness=0.25) for h in (1.0, 2.0, 3.0)]
    for wall in walls:
        stripes = dd.multiple_stripe(wall, few, [1.5], im="p*pgv/a0", progress=False)
        want = 1.5 * wall.trigger_acceleration / wall.frequency_parameter
        assert stripes.scale[0] == pytest.approx([want / record.intensity("pgv") for record in few], rel=1e-12)
    # In a population every wall has scales of its own
    people = dd.typology(walls, few, [1.5, 3.0, 6.0], im="pga/a0", progress=False)
    for i, wall in enumerate(walls):
        levels = np.array([1.5, 3.0, 6.0]) * wall.trigger_acceleration / GRAVITY
        alone = dd.multiple_stripe(wall, few, levels, progress=False)
        assert np.array_equal(people.collapses[:, i], alone.collapses)


@pytest.mark.filterwarnings("ignore::dondolo.errors.DondoloWarning")
def test_units_everywhere(records, wall, tmp_path):
    stripes = dd.multiple_stripe(wall, records[::2], [0.4, 0.5, 0.6, 0.7], im="pgv", progress=False)
    curve = stripes.fit()
    assert "0.4 to 0.7 m/s" in repr(stripes)
    assert " m/s (standard error" in repr(curve)
    assert stripes.plot().get_xlabel() == "peak ground velocity [m/s]"
    ax = curve.plot()
    assert ax.get_xlabel() == "peak ground velocity [m/s]"
    assert any("m/s, β" in text.get_text() for text in ax.get_legend().get_texts())
    stripes.to_csv(tmp_path / "stripes.csv", "stripes")
    assert "# unit of im_level: m/s\n" in (tmp_path / "stripes.csv").read_text()
    curve.to_csv(tmp_path / "curve.csv")
    assert "# unit of theta: m/s\n" in (tmp_path / "curve.csv").read_text()
    assert dd.multiple_stripe(wall, records[0], [2.0], im="pga/a0").plot().get_xlabel().endswith("[-]")


def test_files_of_the_executable(run, root, tmp_path):
    text = (root / "data/cases/parapet.nml").read_text()
    text = text.replace("im = 'pga'", "im = 'saavg(0.20:2.0)'").replace("../records", str(root / "data/records"))
    (tmp_path / "case.nml").write_text(text)
    assert re.search(r"PGV +saavg\(0.2:2\) .*problems", run("--check", "case.nml").stdout)
    assert run("case.nml").returncode == 0
    prefix = tmp_path / dd.read_case(tmp_path / "case.nml").output
    stored = dd.read_results(prefix)
    assert stored.stripes.im == stored.fragility.im == dd.read_case(tmp_path / "case.nml").im == "saavg(0.2:2)"
    assert stored.stripes.plot().get_xlabel() == "average spectral acceleration, 0.2 to 2 s [g]"


@pytest.fixture(scope="module")
def comparison(wall, records):
    """Two names of one measure, an energy and a poor measure."""
    with pytest.warns(dd.errors.DondoloWarning):
        return dd.compare_intensities(wall, records, ["pga", "pga/a0", "arias", "pgd"], n_resamples=100, progress=False)


def test_comparison(comparison, wall):
    pga, ratio, arias, _ = comparison.curves
    # The same scales by another name, and levels that lie alike
    assert ratio.beta == pytest.approx(pga.beta, rel=1e-6)
    assert ratio.theta == pytest.approx(pga.theta * wall.gravity / wall.trigger_acceleration, rel=1e-6)
    assert comparison.dispersion[2] == 0.5 * arias.beta
    assert comparison.dispersion[0] == pga.beta
    assert comparison.best == comparison.ims[int(np.argmin(comparison.dispersion))]
    assert comparison.ratio.min() == 1.0
    assert np.all(comparison.ratio_interval[:, 0] <= comparison.ratio + 1e-12)
    assert np.all(comparison.ratio_interval[:, 1] >= comparison.ratio - 1e-12)
    for stripes in comparison.stripes:
        assert stripes.fraction[0] < 0.1
        assert stripes.fraction[-1] > 0.9
    assert len(comparison.to_frame()) == 4
    assert str(comparison).count("\n") == 4
    left, right = comparison.plot().figure.axes
    assert right.get_yticklabels()[0].get_text() == comparison.best
    assert sum(len(drawn.get_xdata()) > 100 for drawn in left.get_lines()) == 4
    # Few have names and colours of their own: the ends, and PGA.
    labels = left.get_legend_handles_labels()[1]
    assert {comparison.best, "pga"} <= set(labels)
    assert len(labels) <= 4


@pytest.mark.filterwarnings("ignore::dondolo.errors.DondoloWarning")
def test_one_measure_is_a_comparison(wall, records):
    assert dd.compare_intensities(wall, records, "pga", n_levels=5, n_resamples=20, progress=False).ims == ("pga",)


def test_two_records_are_compared_and_drawn_without_intervals(wall, few):
    comparison = dd.compare_intensities(wall, few[:2], ["pga", "pgv"], n_resamples=20, progress=False)
    assert [curve.errors for curve in comparison.curves] == ["few_clusters"] * 2
    assert np.isnan(comparison.ratio_interval).all()
    assert "(nan" not in str(comparison) + repr(comparison._facts())
    _, right = comparison.plot().figure.axes
    assert not [drawn for drawn in right.containers if drawn.has_xerr]


@pytest.mark.filterwarnings("ignore::dondolo.errors.DondoloWarning")
def test_comparison_draws_events_together(wall, records):
    """Two copies of each record, labelled as one event, give the intervals of one copy."""
    some = records[::3]
    twice = [record for record in some for _ in range(2)]
    once, paired = (
        dd.compare_intensities(
            wall, several, ["pga", "pgv"], n_levels=6, n_resamples=200, rng=3, events=events, progress=False
        ).ratio_interval
        for several, events in ((some, None), (twice, [i // 2 for i in range(len(twice))]))
    )
    assert np.ptp(once, axis=1).max() > 0.1
    assert paired == pytest.approx(once, rel=1e-9)


def test_wrong_comparisons(wall, few):
    with pytest.raises(dd.errors.InputError, match="ims: must be given, and differ"):
        dd.compare_intensities(wall, few, ["sa(0.5)", "sa(0.50)"])
    with pytest.raises(dd.errors.InputError, match="im = 'x': must be one of"):
        dd.compare_intensities(wall, few, ["x"])
    with pytest.raises(dd.errors.InputError, match="must be a string"):
        dd.compare_intensities(wall, few, [["pga"]])
    with pytest.raises(dd.errors.InputError, match="levels = 1: must be"):
        dd.compare_intensities(wall, few, ["pga"], n_levels=1)
    with pytest.raises(dd.errors.InputError, match="record 'flat': has no motion"):
        dd.compare_intensities(wall, [*few, dd.Record(np.zeros(10), 0.01, "flat")], ["pga"])
