"""Figures, by what they hold: labels, data, geometry; and the shell command that draws them."""

import inspect
import subprocess
import sys
from dataclasses import replace

import matplotlib

matplotlib.use("agg")

import matplotlib.pyplot as plt
import numpy as np
import pytest
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.image import imread
from PIL import Image
from public import public_things
from scipy import stats

import dondolo as dd
from dondolo.analysis.plots_response import motion_span
from dondolo.figures.layout import lay_out
from dondolo.walls.shape import shape

LEVELS = [0.2, 0.4, 0.6, 0.8, 1.0]


@pytest.fixture(autouse=True)
def closed_figures():
    yield
    plt.close("all")


@pytest.fixture(scope="module")
def wall():
    return dd.OneSidedWall(height=1.5, thickness=0.25, name="parapet")


@pytest.fixture(scope="module")
def motion(wall, records):
    return dd.simulate(wall, records[6], scale=2.2)


@pytest.fixture(scope="module")
def stripes(wall, records):
    return dd.multiple_stripe(wall, records, levels=LEVELS, progress=False)


def line(ax, label):
    """The line of a label."""
    return next(drawn for drawn in ax.get_lines() if label in str(drawn.get_label()))


def test_history_shows_the_motion(motion):
    above, below = motion.plot().figure.axes
    np.testing.assert_array_equal(above.get_lines()[0].get_ydata(), motion.ground_acceleration / 9.81)
    np.testing.assert_array_equal(line(below, "rotation").get_ydata(), motion.rotation / motion.wall.capacity_angle)
    np.testing.assert_array_equal(line(below, "impacts").get_xdata(), motion.time[motion.after_impact])
    assert 0 < motion.impacts == motion.after_impact.sum()
    assert line(below, "impacts").get_label() == f"impacts ({motion.impacts})"
    assert line(below, "EDP").get_ydata()[0] == motion.edp
    assert line(below, "EDP").get_xdata()[0] == motion.time_of_peak
    assert below.get_xlabel() == "time [s]"
    assert "[g]" in above.get_ylabel()


def test_history_counts_the_impacts_after_the_record_apart(sine):
    motion = dd.simulate(dd.FreeStandingWall(height=6.0, thickness=0.9), sine, 2.0)
    later = int((motion.after_impact & (motion.time > sine.duration)).sum())
    drawn = line(motion.plot().figure.axes[1], "impacts")
    assert later > 0
    assert drawn.get_label() == f"impacts ({motion.impacts}, and {later} after the record)"


def test_history_draws_into_given_axes(motion):
    _, axes = plt.subplots(2)
    assert motion.plot(axes) is axes[0]
    assert all(one.lines for one in axes)


def test_history_needs_a_history(wall, records):
    with pytest.raises(dd.errors.DondoloError, match="history=True"):
        dd.simulate(wall, records[0], history=False).plot()


def test_stripes_set_collapses_apart(stripes):
    ax = stripes.plot()
    assert len(line(ax, "survives").get_ydata()) == (~stripes.collapsed).sum()
    assert (line(ax, "survives").get_ydata() < 1.0).all()
    reached = stripes.collapses > 0
    np.testing.assert_array_equal(line(ax, "collapses").get_xdata(), stripes.levels[reached])
    assert (line(ax, "collapses").get_ydata() > 1.0).all()
    assert [text.get_text() for text in ax.texts] == [str(count) for count in stripes.collapses[reached]]
    assert ax.get_xlabel() == "peak ground acceleration [g]"
    assert ax.get_title(loc="left") == "parapet"


def test_fragility_shows_fractions_curve_and_band(stripes):
    curve = stripes.fit()
    ax = curve.plot()
    drawn = line(ax, "θ")
    np.testing.assert_allclose(drawn.get_ydata(), curve(drawn.get_xdata()))
    container = ax.containers[0]
    np.testing.assert_allclose(container.lines[0].get_ydata(), stripes.fraction)
    # Clopper and Pearson's interval of no collapse among n ends at 1 - (tail)^(1/n).
    empty = int(np.flatnonzero(stripes.collapses == 0)[0])
    segment = container.lines[2][0].get_segments()[empty]
    np.testing.assert_allclose(segment[:, 1], [0.0, 1.0 - 0.025 ** (1.0 / stripes.histories[empty])])
    band = ax.collections[0].get_paths()[0].vertices
    assert band[:, 1].max() <= 1.0
    assert band[:, 1].min() >= 0.0


def test_bars_end_at_the_saturation():
    """Exact binomial intervals of the walls that can collapse, times their share of the population."""
    collapses, share = [0, 8, 20, 41, 44], 0.5
    curve = replace(dd.fit_fragility(LEVELS, collapses, 44), upper_asymptote=share)
    ax = curve.plot(confidence=0.9)
    container = ax.containers[0]
    np.testing.assert_allclose(container.lines[0].get_ydata(), np.array(collapses) / 88, rtol=1e-12)
    exact = [stats.binomtest(count, 44).proportion_ci(0.9, method="exact") for count in collapses]
    segments = np.array(container.lines[2][0].get_segments())
    np.testing.assert_allclose(segments[:, :, 1], share * np.array(exact), rtol=1e-9, atol=1e-15)
    drawn = line(ax, "θ")
    expected = stats.lognorm(curve.beta, scale=curve.theta).cdf(drawn.get_xdata())
    np.testing.assert_allclose(drawn.get_ydata(), share * expected, rtol=1e-12)
    assert ax.collections[0].get_paths()[0].vertices[:, 1].max() < share


def test_fragility_without_a_fit_shows_the_bracket():
    curve = dd.fit_fragility([0.2, 0.4, 0.6], [0, 5, 44], [44, 44, 44])
    ax = curve.plot()
    texts = [text.get_text() for text in ax.get_legend().get_texts()]
    assert any("separated" in text for text in texts)
    assert not any("θ" in text for text in texts)


def test_fragility_refuses_a_confidence_of_one(stripes):
    with pytest.raises(dd.errors.InputError, match="confidence"):
        stripes.fit().plot(confidence=1.0)


def test_typology_shows_every_wall_and_the_mean(records):
    walls = [dd.OneSidedWall(height=height, thickness=0.25) for height in (1.2, 1.8, 2.4)]
    people = dd.typology(dd.Population(walls), records, levels=LEVELS, progress=False)
    ax = people.plot()
    mean = line(ax, "weighted mean")
    np.testing.assert_allclose(mean.get_ydata(), people["all"](mean.get_xdata()))
    grid = mean.get_xdata()
    smooth = [drawn for drawn in ax.get_lines() if len(drawn.get_xdata()) == len(grid)]
    # Edges of the band and median, mean, lognormal
    assert len(smooth) == 3 + 1 + people["all"].fit.has_fit
    (thin,) = (drawn for drawn in ax.collections if isinstance(drawn, LineCollection))
    assert len(thin.get_segments()) == 3
    for corners, curve in zip(thin.get_segments(), people["all"].probabilities(grid), strict=True):
        assert corners[[0, -1], 0].tolist() == [grid[0], grid[-1]]
        np.testing.assert_allclose(np.interp(grid, *corners.T), curve, rtol=0.0, atol=1e-3)
    np.testing.assert_array_equal(line(ax, "fractions").get_ydata(), people["all"].mean_fraction)
    assert people["one_sided"].plot().get_title(loc="left") == "one-sided"
    with pytest.raises(dd.errors.InputError, match="must be one of"):
        people["two_block"].plot()


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_two_blocks_stay_on_one_vertical_and_on_their_hinges(sign):
    wall = dd.TwoBlockWall(height=3.0, thickness=0.25, hinge=0.6)
    moved = shape(wall, sign * 0.05)
    base, middle, top = moved.hinges
    assert base[0] == pytest.approx(top[0]) == pytest.approx(0.25 if sign > 0 else 0.0)
    lower, upper = moved.blocks
    for block, height in ((lower, 1.8), (upper, 1.2)):
        sides = np.linalg.norm(np.roll(block, -1, axis=0) - block, axis=1)
        np.testing.assert_allclose(sides, [0.25, height, 0.25, height])
    for hinge, block in ((base, lower), (middle, lower), (middle, upper), (top, upper)):
        assert np.linalg.norm(block - hinge, axis=1).min() == pytest.approx(0.0, abs=1e-12)
    # The strip folds out to the side of its rotation, and its top comes up before it goes down.
    assert np.sign(np.mean(np.vstack(moved.blocks)[:, 0]) - 0.125) == sign
    assert top[1] > 3.0


def test_potential_energy_is_what_the_drawing_lifts():
    """The centroids of the drawn blocks rise as the restoring moment of the library says."""
    wall = dd.TwoBlockWall(height=3.0, thickness=0.25, hinge=0.6)

    def lift(q):
        lower, upper = shape(wall, q).blocks
        return 9.81 * 1800.0 * 0.25 * (1.8 * lower[:, 1].mean() + 1.2 * upper[:, 1].mean())

    q, step = 0.5 * wall.capacity_angle, 1e-5
    moment = (lift(q + step) - lift(q - step)) / (2.0 * step)
    # G at half the capacity, docs/theory.md, section 2
    assert moment == pytest.approx(1655.01450775168, rel=1e-8)
    assert lift(wall.capacity_angle) > lift(1.01 * wall.capacity_angle)
    assert lift(wall.capacity_angle) > lift(0.99 * wall.capacity_angle)


@pytest.mark.parametrize(
    "wall",
    [
        dd.TwoBlockWall(3.0, 0.25, hinge=0.6, hinge_depth=0.02),
        dd.OneSidedWall(3.0, 0.25, compressive_strength=1e6),
        dd.OneSidedWall(3.0, 0.25, edge_radius=0.03),
        dd.OneSidedWall(sections=[dd.Section(2.0, 0.5, offset=0.0), dd.Section(1.5, 0.3, offset=0.1)]),
    ],
    ids=["two-block", "strength", "edge", "sections"],
)
def test_drawn_storeys_rise_as_the_moment_says(wall):
    """Each block as drawn weighs what its area does; hinges lie behind the face."""

    def lift(q):
        blocks = shape(wall, q).blocks
        areas = [np.linalg.norm(b[1] - b[0]) * np.linalg.norm(b[2] - b[1]) for b in blocks]
        return 9.81 * 1800.0 * sum(area * b[:, 1].mean() for area, b in zip(areas, blocks, strict=True))

    q, step = 0.5 * wall.capacity_angle, 1e-5
    moment = (lift(q + step) - lift(q - step)) / (2.0 * step)
    assert moment == pytest.approx(float(wall.terms(q).restoring_moment), rel=1e-8)
    assert shape(wall, 0.0).hinges[0, 0] == pytest.approx(wall.thickness - wall.base_hinge_depth)


def test_what_a_wall_carries_is_drawn_with_its_value():
    facade = dd.OneSidedWall(
        sections=[dd.Section(4.0, 0.6), dd.Section(3.5, 0.45)],
        loads=[
            dd.Load(12000.0, depth=0.5, height=4.0, inertia="both"),
            dd.Load(6000.0, depth=0.35, height=7.5, inertia="none"),
        ],
        inertial_masses=[dd.InertialMass(500.0, depth=0.2, height=6.0)],
        thrusts=[dd.Thrust(800.0, height=7.5)],
        springs=[dd.Spring(20000.0, depth=0.6, height=4.0)],
        hinge_depth=0.015,
    )
    ax = facade.plot(rotation=0.0)
    texts = {text.get_text(): text.xy for text in ax.texts if text.get_text()}
    assert {"12 kN/m lifted, pushed", "6 kN/m dead", "500 kg/m pushed", "800 N/m thrust", "20 kN/m²"} <= set(texts)
    assert "hinge, 15 mm deep" in texts
    # Outwards is to the right: depth 0.5 of 0.6 m is 0.1 m from the left
    assert texts["12 kN/m lifted, pushed"][0] == pytest.approx(0.1)
    assert texts["500 kg/m pushed"] == pytest.approx((0.4, 6.0))
    # Without its depth the thrust acts at the inner face of the upper storey
    tail = texts["800 N/m thrust"]
    assert tail[0] < 0.15
    assert tail[1] == pytest.approx(7.5)
    strip = dd.TwoBlockWall(3.0, 0.25, overburden=2e4, overburden_inertia=0.5, eccentricity=-0.05)
    for rotation, place in ((0.0, 0.075), (-1e-9, 0.175)):
        (at,) = (t.xy for t in strip.plot(rotation=rotation).texts if t.get_text() == "20 kN/m 50 % lifted")
        assert at[0] == pytest.approx(place, abs=1e-6)


def test_ties_are_told_with_what_is_usual():
    wall = dd.OneSidedWall(
        9.0,
        0.5,
        ties=[
            dd.Tie(4.5, area=5e-05, length=8.0, anchor_force=6000.0),
            dd.Tie(8.0, area=0.0001, length=8.0, anchor_force=6000.0),
        ],
    )
    usual = {"modulus": 2.06e11, "strength": 1.8e8, "preload": 0.0, "strain": 0.02, "depth": 0.0}
    assert wall.ties[0].modulus is None
    given = replace(wall, ties=[replace(tie, **usual) for tie in wall.ties])
    assert repr(wall) == repr(given)
    assert "area 5\N{MULTIPLICATION SIGN}10⁻⁵ m2/m" in wall._repr_html_()
    assert wall.greatest_acceleration == given.greatest_acceleration
    assert "modulus" not in repr(dd.OneSidedWall(9.0, 0.5))
    ax = wall.plot(rotation=0.0)
    (below,) = (text.get_text() for text in ax.texts if text.get_text().startswith("Ties"))
    words = "Ties: length 8 m; modulus 206 GPa; yield stress 180 MPa; preload 0 MPa; breaks at a strain of 0.02; anchor"
    assert below.replace("\n", " ") == f"{words} gives way at 6 kN/m"
    # No label lies on another
    ax.figure.draw_without_rendering()
    boxes = {text.get_text(): text.get_window_extent() for text in ax.texts if text.get_text()}
    for label in ("tie 0.5 cm²/m", "tie 1 cm²/m"):
        assert not boxes[label].overlaps(boxes["transverse\nwall"])


def test_friction_is_told_with_what_is_usual():
    wall = dd.OneSidedWall(6.0, 0.4, interlock=dd.Interlock(overlap=0.12, course=0.1, thickness=0.25, spacing=5.0))
    assert "friction=0.577" in repr(wall)
    assert any("coefficient 0.577" in text.get_text() for text in wall.plot().texts)


def test_one_block_turns_about_its_toe():
    wall = dd.FreeStandingWall(height=2.0, thickness=0.5)
    for q in (0.2, -0.2):
        moved = shape(wall, q)
        toe = [0.5, 0.0] if q > 0 else [0.0, 0.0]
        np.testing.assert_allclose(moved.hinges, [toe])
        assert moved.blocks[0][:, 1].min() == pytest.approx(0.0, abs=1e-12)
        assert np.sign(moved.blocks[0][2, 0] - 0.5) == np.sign(q)


def test_wall_is_drawn_at_its_peak(motion):
    ax = motion.plot_peak()
    np.testing.assert_allclose(line(ax, "hinge").get_xydata(), shape(motion.wall, motion.peak_rotation).hinges)
    assert ax.get_aspect() == 1.0
    assert f"EDP = {motion.edp:.3g}" in ax.get_title(loc="left")


def test_one_sided_walls_do_not_turn_inwards(wall):
    with pytest.raises(dd.errors.InputError, match="must not be negative"):
        wall.plot(rotation=-0.01)


def test_a_wall_on_a_building_is_moved_by_its_floor(motion, records):
    house = dd.Building(0.3, storeys=3, level=9.0, building_height=9.0)
    above, _ = dd.simulate(dd.OneSidedWall(1.5, 0.25, building=house), records[0], 0.3).plot().figure.axes
    assert above.get_ylabel() == "floor\nacceleration [g]"
    assert motion.plot().get_ylabel() == "ground\nacceleration [g]"


def test_a_film_shows_the_time_of_the_motion():
    wall = dd.FreeStandingWall(0.5, 0.4)
    quiet = np.zeros(500)
    record = dd.Record(np.concatenate([quiet, 4.0 * np.sin(np.linspace(0.0, 2.0 * np.pi, 100)), quiet, quiet]), 0.01)
    moved = dd.simulate(wall, record, 2.1)
    moves = moved.time[moved.rotation != 0.0]
    assert 5.0 < moves[0] < moves[-1] < 10.0
    first, last = motion_span(moved)
    assert moves[0] - 0.55 < first < moves[0] - 0.45
    assert moves[-1] + 0.95 < last < moves[-1] + 1.05
    still = dd.simulate(wall, record, 1e-3)
    assert motion_span(still) == (still.time[0], still.time[-1])


def test_a_frame_is_drawn_once(motion, tmp_path, monkeypatch):
    animation = motion.animate(frames_per_second=2, speed=4.0)
    figure, drawn = animation._fig, []
    original = type(figure).draw
    monkeypatch.setattr(type(figure), "draw", lambda self, renderer: drawn.append(self) or original(self, renderer))
    animation.save(tmp_path / "motion.gif", writer="pillow")
    with Image.open(tmp_path / "motion.gif") as film:
        assert len(drawn) == film.n_frames > 3


@pytest.mark.slow
def test_animation_follows_the_motion(motion, tmp_path):
    animation = motion.animate(frames_per_second=2, speed=4.0)
    animation.save(tmp_path / "motion.gif", writer="pillow")
    assert (tmp_path / "motion.gif").stat().st_size > 10_000
    with pytest.raises(dd.errors.InputError, match="must be positive"):
        motion.animate(speed=0.0)


def test_a_figure_that_is_laid_out_is_drawn_once(motion, tmp_path, monkeypatch):
    figure = motion.plot().figure
    drawn = []
    original = Axes.draw
    monkeypatch.setattr(Axes, "draw", lambda self, renderer: drawn.append(self) or original(self, renderer))
    lay_out(figure)
    assert drawn == []
    figure.savefig(tmp_path / "history.png")
    assert len(drawn) == len(figure.axes) == 2
    # The same figure as one that savefig lays out
    other = motion.plot().figure
    other.savefig(tmp_path / "other.png")
    np.testing.assert_array_equal(imread(tmp_path / "history.png"), imread(tmp_path / "other.png"))


def command(*arguments, folder):
    return subprocess.run(
        [sys.executable, "-m", "dondolo", *map(str, arguments)], cwd=folder, capture_output=True, text=True, check=False
    )


def test_results_draw_themselves():
    """One way to draw: methods, of which the axes come first and the options are named."""
    assert [name for name in dd.__all__ if name.startswith(("plot", "draw", "animate"))] == []
    methods = {
        (name, method): getattr(thing, method)
        for name, thing in public_things().items()
        if isinstance(thing, type)
        for method in dir(thing)
        if method.startswith("plot")
    }
    drawn = {name for name, _ in methods}
    assert drawn >= {"Cloud", "Fragility", "Incremental", "IntensityComparison", "OverturningSpectrum", "Population"}
    assert drawn >= {"HazardCurve", "Record", "Spectrum"}
    assert drawn >= {"PopulationCurve", "Response", "Risk", "Stripes", "Typology", "OneSidedWall"}
    for method in methods.values():
        signature = inspect.signature(method)
        _, ax, *options, others = signature.parameters.values()
        assert (ax.name, ax.default) == ("ax", None)
        assert all(option.kind is option.KEYWORD_ONLY for option in options)
        assert (others.name, others.kind) == ("options", others.VAR_KEYWORD)
        assert signature.return_annotation == "Axes"
        assert "docs/printing.md" in method.__doc__


def test_records_and_spectra(records):
    record = records[0]
    above, below = record.plot().figure.axes
    peak = line(above, "PGA")
    assert abs(peak.get_ydata()[0]) == record.peak_acceleration
    low, high = record.significant_times()
    assert above.patches[0].get_extents().transformed(above.transData.inverted()).intervalx == pytest.approx(
        [low, high]
    )
    np.testing.assert_array_equal(line(below, "PGV").get_ydata(), record.velocity)
    still, _ = dd.Record([0.0, 0.0], 0.01).plot().figure.axes
    assert not still.patches
    shaken, _ = replace(record, vertical=0.5 * record.acceleration).plot().figure.axes
    np.testing.assert_array_equal(line(shaken, "vertical").get_ydata(), 0.5 * record.acceleration)
    spectrum = record.spectrum([1.0, 0.2, 0.5])
    ax = spectrum.plot()
    assert line(ax, "damping 5 %").get_xdata().tolist() == [0.2, 0.5, 1.0]
    assert line(ax, "damping 5 %").get_ydata()[2] == spectrum.pseudo_acceleration[0]


def test_hazard_curve():
    hazard = dd.HazardCurve([0.1, 0.2, 0.4], [0.01, 0.002, 0.0002], fractiles={0.84: [0.02, 0.004, 0.0005]})
    ax = hazard.plot()
    mean = line(ax, "mean")
    assert mean.get_ydata()[[0, -1]] == pytest.approx([0.01, 0.0002])
    assert line(ax, "fractile").get_ydata()[-1] == 0.0005
    (periods,) = ax.child_axes
    assert periods.get_ylabel() == "return period [years]"
    assert dd.HazardCurve.power_law(1e-4, 2.0).plot().get_xlabel() == "peak ground acceleration [g]"


@pytest.mark.parametrize("ax", ["mine", 3, [], [None, None], "panels"])
def test_wrong_axes(ax, wall, motion, stripes):
    if ax == "panels":
        ax = plt.subplots(3)[1]
    for draw in (wall.plot, motion.plot_peak, stripes.plot, stripes.fit().plot, stripes.plot_damage_states):
        with pytest.raises(dd.errors.InputError, match=r"^ax: must be an Axes of Matplotlib$"):
            draw(ax)
    for draw in (motion.plot, dd.Population([wall]).plot):
        with pytest.raises(dd.errors.InputError, match=r"^ax: must be 2 Axes of Matplotlib$"):
            draw(ax)


def test_axes_are_returned(wall, motion, stripes):
    _, ax = plt.subplots()
    for draw in (wall.plot, motion.plot_peak, stripes.plot, stripes.fit().plot, stripes.plot_damage_states):
        assert draw(ax) is ax
    _, axes = plt.subplots(1, 2, squeeze=False)
    assert dd.Population([wall]).plot(axes) is axes[0, 0]


@pytest.mark.parametrize(
    ("draw", "message"),
    [
        (lambda wall, motion, stripes: wall.plot(rotation="wide"), "rotation = 'wide': must be a number"),
        (lambda wall, motion, stripes: wall.plot(rotation=4.0), "rotation"),
        (lambda wall, motion, stripes: wall.plot(rotation=np.nan), "rotation"),
        (lambda wall, motion, stripes: motion.animate(speed="fast"), "speed = 'fast': must be a number"),
        (lambda wall, motion, stripes: stripes.fit().plot(confidence="most"), "confidence = 'most': must be a number"),
        (
            lambda wall, motion, stripes: stripes.plot_damage_states(edp_thresholds="low"),
            "edp_thresholds: must be numbers",
        ),
        (
            lambda wall, motion, stripes: stripes.plot_damage_states(edp_thresholds=[2.0]),
            "edp_threshold = 2: must be positive and at most",
        ),
    ],
)
def test_wrong_options(draw, message, wall, motion, stripes):
    with pytest.raises(dd.errors.InputError, match=message):
        draw(wall, motion, stripes)


def test_bars_and_band_are_said_to_differ(stripes):
    """Bars are of one stripe, its histories independent, the band is of the curve, clustered: the legend says so."""

    def words(ax):
        return [text.get_text() for text in ax.get_legend().get_texts()]

    curve = stripes.fit()
    alone = words(curve.plot(confidence=0.9))
    assert "fractions; bars: 90 % of one stripe, exact binomial" in alone
    assert "band: 90 % of the curve, clustered by records" in alone
    naive = dd.fit_fragility(curve.levels, curve.collapses, curve.histories, im="pga")
    assert "band: 95 % of the curve, histories independent" in words(naive.plot())
    # Several in one figure: each explanation once, behind the curves.
    ax = curve.plot(label="one")
    several = words(curve.plot(ax, label="two"))
    assert several == [
        "one",
        "two",
        "bars: 95 % of one stripe, exact binomial",
        "band: 95 % of the curve, clustered by records",
    ]


def test_titles_of_curves(stripes):
    assert stripes.fit().plot().get_title(loc="left") == "parapet"
    assert stripes.fit().plot(label="one of several").get_title(loc="left") == ""


@pytest.mark.slow
@pytest.mark.parametrize(
    ("case", "figures"),
    [
        ("parapet", ("stripes", "fragility")),
        ("history", ("history", "wall")),
        ("population", ("typology",)),
    ],
)
def test_command_draws_the_executables_files(case, figures, executable, root, tmp_path):
    subprocess.run([executable, "--quiet", root / "data/cases" / f"{case}.nml"], cwd=tmp_path, check=True)
    done = command("plot", f"out/{case}", folder=tmp_path)
    assert done.returncode == 0, done.stderr
    for figure in figures:
        picture = imread(tmp_path / "out" / f"{case}_{figure}.png")
        assert picture.shape[0] > 300
        assert np.ptp(picture) > 0.5


@pytest.mark.slow
def test_command_animates(executable, root, tmp_path):
    """A long motion is shown faster: the film takes half a minute at most."""
    wall = dd.FreeStandingWall(0.5, 0.4)
    pulse = 4.0 * np.sin(2.0 * np.pi * np.arange(50) / 50.0)
    for rest, faster in ((50, ""), (4450, " (3 times as fast as the motion)")):
        np.savetxt(tmp_path / "long.txt", np.append(pulse, np.zeros(rest + 1)))
        (tmp_path / "records.csv").write_text("file,dt_s,units\nlong.txt,0.02,m/s2\n")
        (tmp_path / "case.nml").write_text(
            "&job task = 'history', output = 'out' /\n"
            f"&wall mechanism = 'free_standing', height = {wall.height}, thickness = {wall.thickness} /\n"
            "&records catalogue = 'records.csv' /\n&history scale = 1.0 /\n"
        )
        done = subprocess.run([executable, "--quiet", "case.nml"], cwd=tmp_path, capture_output=True, text=True)
        assert done.returncode == 0, done.stderr
        done = command("plot", "out", "--animate", folder=tmp_path)
        assert done.returncode == 0, done.stderr
        assert done.stdout.splitlines()[-1] == f"drawn: out_motion.gif{faster}"
        with Image.open(tmp_path / "out_motion.gif") as film:
            assert film.n_frames <= 30 * 15 + 1


@pytest.mark.slow
def test_command_draws_the_damage_states_of_a_wall(executable, root, tmp_path):
    case = (root / "data/cases/parapet.nml").read_text().replace("../records", str(root / "data/records"))
    (tmp_path / "case.nml").write_text(case.replace("&stripes", "&stripes edp_thresholds = 0.1, 0.4"))
    subprocess.run([executable, "--quiet", "case.nml"], cwd=tmp_path, check=True)
    assert dd.read_results(tmp_path / "out/parapet").edp_thresholds == [0.1, 0.4, 1.0]
    done = command("plot", "out/parapet", folder=tmp_path)
    assert done.stdout == "".join(
        f"drawn: out/parapet_{name}.png\n" for name in ("stripes", "fragility", "damage_states")
    )


def test_results_read_back_are_those_of_a_run(executable, root, tmp_path):
    case = root / "data/cases/parapet.nml"
    subprocess.run([executable, "--quiet", case], cwd=tmp_path, check=True)
    stored, run = dd.read_results(tmp_path / "out/parapet"), dd.run_case(case, progress=False)
    np.testing.assert_array_equal(stored.stripes.edp, run.stripes.edp)
    np.testing.assert_array_equal(stored.stripes.levels, run.stripes.levels)
    assert stored.fragility.theta == run.fragility.theta
    assert stored.population[0] == run.case.population[0]


def test_command_says_what_is_wrong(tmp_path):
    done = command("plot", "nothing", folder=tmp_path)
    assert done.returncode == 2
    assert done.stderr == "dondolo: nothing_run.json: cannot be read: No such file or directory\n"
    (tmp_path / "bad_run.json").write_text("[1, 2]\n")
    done = command("plot", "bad", folder=tmp_path)
    assert done.returncode == 2
    assert done.stderr.count("\n") == 1


def test_help_lists_the_commands(tmp_path):
    done = command("--help", folder=tmp_path)
    assert done.returncode == 0
    assert "plot" in done.stdout


def test_plots_of_names_that_look_like_formulas(records, tmp_path):
    wall = dd.OneSidedWall(height=1.5, thickness=0.25, name="cost $x_{$")
    figure = dd.simulate(wall, records[6]).plot().figure
    figure.savefig(tmp_path / "history.png")


def test_the_collapse_limit_is_where_it_was_set(wall, records):
    stripes = dd.multiple_stripe(wall, records[:3], [0.1], solver=dd.Solver(edp_limit=0.3), progress=False)
    assert line(stripes.plot(), "collapse limit").get_ydata()[0] == 0.3


def test_results_do_not_believe_the_title(executable, root, tmp_path):
    case = (root / "data/cases/history.nml").read_text().replace("../records", str(root / "data/records"))
    title = "edp_limit = 0.2, gravity = 5 and scale = 3, edp = 7"
    case = "\n".join(f"title = '{title}'" if "title =" in row else row for row in case.splitlines())
    (tmp_path / "case.nml").write_text(case + "\n")
    subprocess.run([executable, "--quiet", "case.nml"], cwd=tmp_path, check=True)
    stored, run = dd.read_results(tmp_path / "out/history").response, dd.run_case(tmp_path / "case.nml").response
    assert (stored.scale, stored.edp, stored.edp_limit) == (run.scale, run.edp, run.edp_limit)
    assert stored.wall == run.wall
    for column in ("time", "side", "after_impact"):
        assert np.array_equal(getattr(stored, column), getattr(run, column)), column
    # Files of another task with the same beginning are not mixed up.
    stripes = (root / "data/cases/parapet.nml").read_text().replace("../records", str(root / "data/records"))
    (tmp_path / "case.nml").write_text(stripes.replace("out/parapet", "out/history"))
    subprocess.run([executable, "--quiet", "case.nml"], cwd=tmp_path, check=True)
    assert dd.read_results(tmp_path / "out/history").response is None
    assert dd.read_results(tmp_path / "out/history").stripes is not None
