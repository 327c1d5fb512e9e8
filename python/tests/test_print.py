"""Figures for print: every result in axes that are given, at the widths of a column and of a page, by geometry."""

import itertools
import re
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import matplotlib

matplotlib.use("agg")

import matplotlib as mpl
import matplotlib.pyplot as plt
import numpy as np
import pytest
from matplotlib.colors import to_hex, to_rgb
from matplotlib.text import Text

import dondolo as dd
from dondolo.figures import style
from dondolo.figures.options import PARTS, Options
from dondolo.figures.wording import say
from dondolo.reporting.language import Language

LEVELS = np.linspace(0.1, 1.2, 12)
# Panels of those that have several; letters and legends of these need more height without a layout engine
PANELS = {"record": 2, "walls": 2, "history": 2, "intensities": 2, "designs": 2, "uncertain": 2, "risk": 3}
LONG = ("check", "combination", "groups", "designs", "uncertain", "intensities")
SCALED = ("one block", "two blocks", "tied wall", "peak")
# Parts that figures have besides legend and title, which all have
HAVE = {
    "record": ("band", "points"),
    "spectra": ("band",),
    "selection": ("band",),
    "history": ("points",),
    "stripes": ("counts",),
    "damage states": ("points",),
    "fragility": ("band", "bars", "points"),
    "discrete": ("points",),
    "incremental": ("points",),
    "cloud": ("band",),
    "intensities": ("bars", "points"),
    "check": ("band", "bars", "points"),
    "hazard": ("points", "band"),
    "risk": ("points",),
    "risk uncertainty": ("band", "points"),
    "typology": ("band", "points"),
    "mean of one mechanism": ("band", "points"),
    "combination": ("band",),
    "states of a population": ("points",),
    "union": ("points",),
    "designs": ("bars", "points"),
    "uncertain": ("band", "bars"),
    "hinges": ("band",),
}
NAMES = (
    *("record", "spectrum", "spectra", "selection", "floor", "one block", "two blocks", "tied wall", "walls"),
    *("history", "peak", "stripes", "damage states", "fragility", "discrete", "incremental", "cloud", "intensities"),
    *(
        "overturning",
        "check",
        "hazard",
        "risk",
        "deaggregation",
        "risk uncertainty",
        "typology",
        "mean of one mechanism",
    ),
    *("combination", "groups", "states of a population", "union", "designs", "uncertain", "hinges"),
)


@pytest.fixture(autouse=True)
def closed_figures():
    yield
    plt.close("all")
    dd.style("screen")


@pytest.fixture(scope="module")
def curve(wall, records):
    return dd.multiple_stripe(wall, records, levels=LEVELS, progress=False).fit()


@pytest.fixture(scope="module")
def drawings(wall, records):
    """The methods that draw, by the name of their result."""
    some = records[::4]
    strip = dd.TwoBlockWall(height=3.0, thickness=0.25, hinge=0.6, name="strip")
    stripes = dd.multiple_stripe(wall, records, levels=LEVELS, polarity="both", progress=False)
    curve, motion = stripes.fit(), dd.simulate(wall, records[6], scale=2.2)
    walls = [dd.OneSidedWall(h, t, name=f"wall {h} {t}") for h in (1.2, 1.8, 2.4) for t in (0.2, 0.3)]
    walls += [strip, dd.FreeStandingWall(2.0, 0.3)]
    people = dd.Population(walls, group_names=["low", "low", "high", "high", "low", "high", "towers", "towers"])
    levels = [0.2, 0.4, 0.6, 0.8, 1.0, 1.5, 2.0]
    typology = dd.typology(people, some, levels=levels, edp_thresholds=[0.1, 0.4], progress=False)
    both = dd.Population([wall, dd.TwoBlockWall(1.5, 0.25, hinge=0.6, name="parapet")])
    union = dd.typology(both, some, levels=levels, progress=False)
    mean = np.array([2e-2, 8e-3, 2e-3, 4e-4, 5e-5, 4e-6])
    fractiles = {0.16: 0.5 * mean, 0.84: 1.5 * mean}
    hazard = dd.HazardCurve([0.05, 0.1, 0.2, 0.4, 0.8, 1.6], mean, im="pga", fractiles=fractiles)
    risk = curve.risk(hazard)
    site = dd.Site(ag=0.2, f0=2.5, tc_star=0.35, soil="B")
    facade = dd.OneSidedWall(9.0, 0.5, name="facade")
    ties = [dd.Tie(h, area=2.8e-5, length=8.0, strength=1.8e8) for h in (3.0, 6.0, 8.5)]
    tied = dd.OneSidedWall(9.0, 0.5, ties=ties, name="tied facade")
    choice = {"as it stands": facade, "three ties, strain 2 %": tied}
    sources = {
        "restitution_factor": "graziotti_2016",
        "hinge": dd.distributions.Triangular(0.5, 0.6, 0.75),
        "hinge_depth": dd.distributions.Lognormal(0.01, 0.4, high=0.05),
    }
    wide = np.linspace(0.2, 3.0, 10)
    block = dd.FreeStandingWall(2.0, 0.4, name="block")
    spectrum = dd.overturning_spectrum(
        block, dd.pulses.one_sine, frequencies=np.linspace(0.2, 2.0, 12), amplitudes=np.linspace(0.1, 2.0, 12)
    )
    code = site.spectrum(periods=np.geomspace(0.1, 2.0, 20))
    target = dd.TargetSpectrum(code.periods, code.sa, dispersion=0.6)
    chosen = dd.RecordSet(records).select(target.conditional(0.3, 0.6), 15, max_factor=40.0)
    measures = ["pga", "pgv", "pgd", "cav", "sa(0.2)", "sa(1)", "saavg(0.2:2)"]
    methods = [
        records[6].plot,
        records[6].spectrum(np.geomspace(0.05, 3.0, 50)).plot,
        lambda ax=None, **more: dd.RecordSet(some).plot(ax, target=target, **more),
        chosen.plot,
        lambda ax=None, **more: dd.Building([0.3, 0.1], participation=[1.2, -0.2]).plot(
            ax, records=some, site=site, periods=np.geomspace(0.05, 2.0, 20), **more
        ),
        *(wall.plot, strip.plot, tied.plot, people.plot, motion.plot, motion.plot_peak, stripes.plot),
        lambda ax=None, **more: stripes.plot_damage_states(ax, edp_thresholds=[0.1, 0.4, 1.0], **more),
        curve.plot,
        dd.DiscreteFragility([0.2, 0.4, 0.8], [0.1, 0.6, 0.9]).plot,
        stripes.incremental().plot,
        dd.cloud(wall, records).plot,
        dd.compare_intensities(wall, some, measures, n_resamples=20, progress=False).plot,
        spectrum.plot,
        lambda ax=None, **more: dd.check_ntc(wall, site).plot(ax, curve=curve, **more),
        *(hazard.plot, risk.plot, risk.plot_deaggregation, risk.uncertainty(n_draws=200).plot),
        *(typology.plot, typology["one_sided"].plot, typology.plot_combination, typology.plot_groups),
        typology.plot_damage_states,
        union.plot_union,
        dd.compare_designs(choice, some, [0.2, 0.3, 0.4, 0.5, 0.7, 1.0, 1.5, 2.0], site=site).plot,
        dd.propagate_uncertainty(strip, some, wide, sources=sources, n_variants=40, progress=False).plot,
        dd.weakest_hinge(strip, some, wide).plot,
    ]
    return dict(zip(NAMES, methods, strict=True))


def given_axes(name, width, engine):
    """Axes of a user: one below another in a column, side by side on a page; without a layout engine with margins."""
    count = PANELS.get(name, 1)
    rows, columns = (count, 1) if width == 88 or count == 3 else (1, count)
    high = 110.0 if name in SCALED else {1: 66.0, 2: 110.0, 3: 150.0}[rows]
    if engine is None and name in LONG:
        high += 40.0
    figure, axes = plt.subplots(rows, columns, figsize=(width / 25.4, high / 25.4), layout=engine)
    if engine is None:
        left = 0.4 if name == "designs" and width == 88 else 0.25 if name == "designs" or width == 88 else 0.13
        top, bottom = (0.84, 0.17) if rows == 1 else (0.9, 0.13)
        right, between = 0.84 if width == 88 else 0.91, 0.7 if name == "designs" else 0.5
        figure.subplots_adjust(left=left, right=right, bottom=bottom, top=top, hspace=0.5, wspace=between)
    return figure, axes


def words_in(figure):
    """Texts that are seen, with their boxes in pixels."""
    figure.canvas.draw()
    axes = [*figure.axes, *(child for ax in figure.axes for child in ax.child_axes)]
    hidden = set()
    for axis in (axis for ax in axes for axis in (ax.xaxis, ax.yaxis)):
        ticks = axis.get_major_ticks() + axis.get_minor_ticks()
        seen = axis._update_ticks() if axis.get_visible() else []
        hidden |= {id(text) for tick in ticks if tick not in seen for text in (tick.label1, tick.label2)}
        hidden |= set() if axis.get_visible() else {id(text) for text in axis.findobj(Text)}
    texts = {
        id(text): text for ax in axes for text in ax.findobj(Text) if text.get_text().strip() and text.get_visible()
    }
    boxes = {text: text.get_window_extent() for key, text in texts.items() if key not in hidden}
    return {text: box for text, box in boxes.items() if box.width > 0.0}


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore::dondolo.errors.DondoloWarning")
@pytest.mark.parametrize("name", NAMES)
def test_texts_are_inside_and_apart(name, drawings):
    """Whatever lays the figure out, no text is cut off and none lies on another."""
    for width, engine in itertools.product((88, 180), ("constrained", "tight", None)):
        with dd.style("journal", width=width):
            figure, axes = given_axes(name, width, engine)
            figure.set_dpi(100)
            ax = drawings[name](axes)
            assert ax is np.ravel(axes)[0]
            words, whole = words_in(figure), figure.bbox
        assert len(words) > 8
        for text, box in words.items():
            inside = whole.x0 - 1 < box.x0 and box.x1 < whole.x1 + 1 and whole.y0 - 1 < box.y0 and box.y1 < whole.y1 + 1
            assert inside, (width, engine, text.get_text())
        for (one, a), (other, b) in itertools.combinations(words.items(), 2):
            across, up = min(a.x1, b.x1) - max(a.x0, b.x0), min(a.y1, b.y1) - max(a.y0, b.y0)
            assert min(across, up) < 1.5, (width, engine, one.get_text(), other.get_text())
        plt.close(figure)


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore::dondolo.errors.DondoloWarning")
@pytest.mark.parametrize("name", NAMES)
def test_one_vocabulary(name, drawings):
    """Legend and title of every figure can be left out, and so can the parts it has; others are refused by name."""
    draw = drawings[name]
    ax = draw(legend=False, title="mine")
    assert isinstance(ax, mpl.axes.Axes)
    assert all(one.get_legend() is None for one in ax.figure.axes)
    assert ax.get_title(loc="left").endswith("mine")
    assert all(not one.get_title(loc="left") for one in draw(title=False).figure.axes)
    whole = len(draw(legend=False).figure.findobj())
    known = ["legend", "title", *HAVE.get(name, ())]
    for part in ("band", "bars", "points", "counts"):
        if part not in known:
            said = f"^{part}: this figure has none; its parts are {', '.join(known)}"
            with pytest.raises(dd.errors.InputError, match=said):
                draw(**{part: False})
        else:
            assert len(draw(legend=False, **{part: False}).figure.findobj()) < whole
        plt.close("all")
    with pytest.raises(dd.errors.InputError, match="legend = 'best': must be True or False"):
        draw(legend="best")
    with pytest.raises(AttributeError, match="colur"):
        draw(colur="red")


def test_parts_are_documented(root):
    page = (root / "docs/printing.md").read_text()
    assert all(f"`{part}`" in page for part in PARTS)


def test_keywords_pass_to_matplotlib(curve, stripes, wall):
    (line,) = (one for one in curve.plot(lw=3.5, alpha=0.5, color="k").lines if "θ" in str(one.get_label()))
    assert (line.get_linewidth(), line.get_alpha(), line.get_color()) == (3.5, 0.5, "k")
    marks = next(one for one in stripes.plot(marker="x", ms=9).lines if one.get_label() == "survives")
    assert (marks.get_marker(), marks.get_markersize()) == ("x", 9)
    assert any(patch.get_facecolor()[:3] == to_rgb("g") for patch in wall.plot(facecolor="g").patches)
    assert Options({"lw": 2.0}).look(linewidth=1.0, color="r") == {"linewidth": 2.0, "color": "r"}


def test_two_results_in_one_axes_are_told_apart(curve, stripes, wall, records):
    ax = curve.plot()
    curve.plot(ax)
    dd.DiscreteFragility([0.2, 0.4], [0.1, 0.6]).plot(ax, label="another")
    looks = [(line.get_color(), line.get_linestyle()) for line in style.mains(ax)]
    assert len({color for color, _ in looks}) == len({dashes for _, dashes in looks}) == 3
    # A user's choice counts, and a figure that is cleared is new.
    curve.plot(ax, color="#0072B2", linestyle="-")
    assert len(style.mains(ax)) == 4
    ax.clear()
    assert style.mains(ax) == []
    # Their counts are in rows of their own.
    ax = stripes.plot()
    dd.multiple_stripe(wall, records[:8], levels=stripes.levels, progress=False).plot(ax)
    with_counts = [(text.get_position()[0], text.xy) for text in ax.texts]
    assert len({xy for _, xy in with_counts}) == len(with_counts)
    boxes = [text.get_window_extent() for text in words_in(ax.figure) if text in ax.texts]
    assert not any(a.overlaps(b) for a, b in itertools.combinations(boxes, 2))


@pytest.mark.parametrize("count", [12, 25, 60])
def test_counts_never_overprint(count, wall, records):
    levels = np.linspace(0.3, 3.0, count)
    stripes = dd.multiple_stripe(wall, records, levels=levels, polarity="both", progress=False)
    with dd.style("journal", width=88):
        ax = stripes.plot()
    words = words_in(ax.figure)
    counts = [text for text in words if text in ax.texts]
    assert 8 < len(counts) <= count
    assert not any(words[a].overlaps(words[b]) for a, b in itertools.combinations(counts, 2))
    # What is shown is right.
    collapses = dict(zip(stripes.levels.tolist(), stripes.collapses.tolist(), strict=True))
    assert all(collapses[text.xy[0]] == int(text.get_text()) for text in counts)


def test_a_mechanism_has_one_colour(records):
    strip = dd.TwoBlockWall(3.0, 0.25, hinge=0.6, name="strip")
    walls = dd.Population([dd.OneSidedWall(2.0, 0.3), strip])
    few = records[::6]
    typology = dd.typology(walls, few, levels=[0.4, 0.8, 1.2, 2.0, 3.0], progress=False)
    for mechanism in ("one_sided", "two_block"):
        color = style.mechanism_look(mechanism)["color"]
        drawn = {line.get_label().split(":")[0]: line for line in typology.plot_combination().lines}
        assert drawn[style.mechanism_name(mechanism)].get_color() == color
        assert style.mains(typology[mechanism].plot(label="mean"))[0].get_color() == color
        wall = next(one for one in walls if one.mechanism == mechanism)
        curve = dd.multiple_stripe(wall, few, [0.4, 0.8, 1.2, 2.0, 3.0], progress=False).fit()
        assert style.mains(curve.plot())[0].get_color() == color
        patches = walls.plot().figure.axes[1].patches
        assert color in [to_hex(patch.get_edgecolor()).upper() for patch in patches]
    # In grey, dashes tell them apart.
    assert len({str(dashes) for _, dashes in style.MECHANISMS.values()}) == len(style.MECHANISMS)


def test_the_mean_of_a_typology_is_seen(records):
    """Over the mean lie a dashed line a third as wide, and marks without a face; the band hides what is behind it."""
    walls = dd.Population([dd.OneSidedWall(h, 0.3, name=f"{h:.3f}") for h in np.linspace(1.5, 3.0, 80)])
    ax = dd.typology(walls, records[::6], levels=[0.2, 0.4, 0.6, 0.8, 1.0, 1.5], progress=False).plot()
    drawn = {str(line.get_label()): line for line in ax.lines}
    mean, fitted = drawn["weighted mean"], next(line for text, line in drawn.items() if text.startswith("lognormal"))
    assert mean.get_color() == style.RED
    assert fitted.get_linewidth() < 0.4 * mean.get_linewidth()
    assert fitted.get_linestyle() == "--"
    assert drawn["weighted fractions"].get_markerfacecolor() == "none"
    (band,) = (one for one in ax.collections if one.get_label() == "16 to 84 % of the walls")
    assert band.get_alpha() is None
    assert band.get_facecolor()[0, 3] == 1.0
    (thin,) = (one for one in ax.collections if len(one.get_paths()) == 60)
    assert band.get_zorder() < thin.get_zorder() < min(mean.get_zorder(), fitted.get_zorder())


def test_fonts_of_journals_are_embedded_as_truetype(curve, tmp_path):
    with dd.style("journal"):
        figure = curve.plot().figure
        figure.savefig(tmp_path / "curve.pdf")
        figure.savefig(tmp_path / "curve.ps")
    text = (tmp_path / "curve.pdf").read_bytes()
    assert b"/FontFile2" in text
    assert b"/CIDFontType2" in text
    assert b"/Type3" not in text
    assert b"/FontType 42" in (tmp_path / "curve.ps").read_bytes()
    box = re.search(rb"/MediaBox \[ 0 0 ([\d.]+) ([\d.]+) \]", text)
    assert float(box[1]) == pytest.approx(88.0 / 25.4 * 72.0, abs=0.1)


def test_a_style_ends_with_its_block(curve):
    with mpl.rc_context({"font.size": 13.0}):
        with dd.style("journal", width=180):
            assert (mpl.rcParams["pdf.fonttype"], mpl.rcParams["font.size"]) == (42, 8.0)
            assert curve.plot().figure.get_figwidth() == pytest.approx(180.0 / 25.4)
            with dd.style("journal", width=60):
                assert curve.plot().figure.get_figwidth() == pytest.approx(60.0 / 25.4)
            assert curve.plot().figure.get_figwidth() == pytest.approx(180.0 / 25.4)
        assert (mpl.rcParams["pdf.fonttype"], mpl.rcParams["font.size"]) == (3, 13.0)
        # Without a block it holds until the next call.
        dd.style("journal")
        dd.style("journal", width=180)
        assert mpl.rcParams["font.size"] == 8.0
        dd.style("screen")
        assert mpl.rcParams["font.size"] == 13.0
        assert curve.plot().figure.get_figwidth() == 6.0
    for wrong, message in (({"name": "poster"}, "style = 'poster'"), ({"width": 3.0}, "width = 3: must lie between")):
        with pytest.raises(dd.errors.InputError, match=message):
            dd.style(**wrong)


def test_panels_have_letters(wall, records, curve):
    motion = dd.simulate(wall, records[6], scale=2.2)
    assert motion.plot().get_title(loc="left").startswith("parapet")
    with dd.style("journal", width=180):
        titles = [ax.get_title(loc="left") for ax in motion.plot().figure.axes]
        assert titles[0].startswith("(a) parapet, record")
        assert titles[1:] == ["(b)"]
        _, axes = plt.subplots(1, 3, layout="constrained")
        for ax in axes:
            curve.plot(ax, title=False)
        assert [ax.get_title(loc="left") for ax in axes] == ["(a)", "(b)", "(c)"]
        assert curve.plot().get_title(loc="left") == "parapet"


def test_a_history_ends_where_the_motion_does():
    quiet = np.zeros(500)
    record = dd.Record(np.concatenate([quiet, 4.0 * np.sin(np.linspace(0.0, 2.0 * np.pi, 100)), quiet, quiet]), 0.01)
    motion = dd.simulate(dd.FreeStandingWall(0.5, 0.4), record, 2.1)
    last = motion.time[np.flatnonzero(motion.rotation)[-1]]
    above, below = motion.plot().figure.axes
    assert last < below.get_xlim()[1] < last + 1.1 < motion.time[-1]
    assert above.get_xlim() == below.get_xlim()


def texts(drawn):
    """All words and numbers of a figure."""
    figure = drawn.figure
    figure.canvas.draw()
    return [text.get_text() for text in figure.findobj(Text) if text.get_text()]


@pytest.mark.parametrize("name", NAMES)
def test_figures_in_italian(drawings, name):
    """By the style the same words and decimal marks as in a report, and English again behind its block."""
    draw = drawings[name]
    english = texts(draw())
    with Language("it").in_force():
        report = texts(draw())
    with dd.style(language="it"):
        assert texts(draw()) == report
        with Language("en").in_force():
            assert texts(draw()) == english
    assert texts(draw()) == english
    # Spectra of records have no Italian in reports either.
    assert (report == english) == (name in ("spectra", "selection", "floor"))


def test_the_language_of_a_style_is_that_of_figures_alone(wall, few, curve, tmp_path):
    stripes = dd.multiple_stripe(wall, few, [0.4, 0.8], progress=False)
    facts, shown = repr(stripes), few[0]._repr_html_()
    with dd.style(language="it"):
        assert (repr(stripes), few[0]._repr_html_()) == (facts, shown)
        assert curve.plot().get_ylabel() == "probabilità di collasso"
        assert any("," in label.get_text() for label in curve.plot().get_yticklabels())
        # The style of another thread is the same.
        with ThreadPoolExecutor(1) as pool:
            assert pool.submit(say, "probability").result() == say("probability") != "probability"
    with pytest.raises(dd.errors.InputError, match="language = 'fr': must be one of 'en', 'it'"):
        dd.style(language="fr")


@pytest.mark.parametrize("how", ["option", "environment"])
def test_figures_of_the_shell_in_italian(run, root, tmp_path, monkeypatch, how):
    case = (root / "data/cases/parapet.nml").read_text(encoding="utf-8")
    (tmp_path / "case.nml").write_text(case.replace("../records/", f"{root}/data/records/"), encoding="utf-8")
    assert run("case.nml").returncode == 0
    prefix = next(tmp_path.glob("**/*_run.json")).as_posix().removesuffix("_run.json")
    if how == "environment":
        monkeypatch.setenv("DONDOLO_LANG", "it")
    done = run("plot", prefix, "--format", "svg", *(["--lang", "it"] if how == "option" else []))
    assert done.returncode == 0, done.stderr
    # Letters of an SVG are drawn, and named in comments.
    assert "probabilità di collasso" in Path(f"{prefix}_fragility.svg").read_text(encoding="utf-8")
