"""Draw the figures of the README and of docs into docs/figures, or into a folder: python figures.py [FOLDER].

The accelerograms are the embedded synthetic ones. One figure compares them with recorded ones, and is drawn only if
these are available in the folder DONDOLO_RECORDS.
"""

import itertools
import os
import shutil
import subprocess
import sys
import tempfile
from dataclasses import replace
from pathlib import Path

import matplotlib

matplotlib.use("agg")

import matplotlib.pyplot as plt
import numpy as np
import rooms

import dondolo as dd
from dondolo.figures import style
from dondolo.figures.options import Options
from dondolo.figures.themes import theme
from dondolo.walls.shape import shape

root = Path(__file__).resolve().parents[1]
records = dd.read_catalogue(root / "data/records/synthetic44.csv")
figures = Path(sys.argv[1]) if len(sys.argv) > 1 else root / "docs/figures"

# The model of the synthetic records, as implemented in the tests
sys.path.insert(0, str(root / "python/tests"))
from sabetta_pugliese import Model, mean_frequency  # noqa: E402


def main() -> None:
    """Draw all figures."""
    figures.mkdir(parents=True, exist_ok=True)
    front()
    quick_start()
    report()
    intensities()
    mechanisms()
    symbols()
    supports()
    bearing()
    ties()
    anchor()
    interlocking()
    compound()
    corner()
    panel()
    six_mechanisms()
    processing()
    pulses()
    overturning()
    free_rocking()
    statistics()
    spectra()
    rooms.draw(figures / "rooms.png")


def new_axes(rows, columns, size, **options):
    """Create a figure of several axes in the style of dondolo."""
    with plt.rc_context(dict(theme().rc)):
        return plt.subplots(rows, columns, figsize=size, layout="constrained", **options)


def front():
    """Draw the README's first picture: a wall that rocks, one of its time histories, and its fragility curve."""
    wall = dd.OneSidedWall(height=1.5, thickness=0.25, name="parapet")
    response = dd.simulate(wall, next(r for r in records if r.name == "22_norcia_2016_m6.5_b"), 1.134)
    stripes = dd.multiple_stripe(wall, records, levels=np.linspace(0.1, 1.2, 12), polarity="both")
    with plt.rc_context(dict(theme().rc)):
        figure = plt.figure(figsize=(11.0, 4.4), layout="constrained")
        grid = figure.add_gridspec(2, 3, width_ratios=[0.7, 1.3, 1.3])
        drawing, ground, rotation, curve = (
            figure.add_subplot(place) for place in (grid[:, 0], grid[0, 1], grid[1, 1], grid[:, 2])
        )
    ground.sharex(rotation)
    response.plot_peak(drawing)
    response.plot([ground, rotation])
    stripes.fit().plot(curve)
    for ax, title in ((drawing, "A wall rocks"), (ground, "under each record"), (curve, "How likely is it to fall?")):
        ax.set_title(title, loc="left")
    figure.savefig(figures / "front.png", dpi=110)


def quick_start():
    """Draw stripes and curve of the README's first example."""
    wall = dd.OneSidedWall(height=1.5, thickness=0.25, name="parapet")
    stripes = dd.multiple_stripe(wall, records, levels=np.linspace(0.1, 1.2, 12), polarity="both")
    figure, axes = new_axes(1, 2, (9.6, 4.4))
    stripes.plot(axes[0])
    stripes.fit().plot(axes[1])
    figure.savefig(figures / "quick_start.png", dpi=100)


def report():
    """Draw the beginning of the report of the README's first command, as a browser shows it."""
    chromium = shutil.which("chromium") or shutil.which("google-chrome")
    if chromium is None:
        print("skipped: the picture of a report needs Chromium")
        return
    dondolo = Path(sys.executable).with_name("dondolo")
    with tempfile.TemporaryDirectory() as folder:
        case = subprocess.run([dondolo, "--example", "parapet"], capture_output=True, text=True, check=True).stdout
        (Path(folder) / "parapet.nml").write_text(case, encoding="utf-8")
        subprocess.run([dondolo, "--quiet", "parapet.nml"], cwd=folder, check=True)
        subprocess.run([dondolo, "report", "out/parapet"], cwd=folder, check=True)
        options = ["--headless", "--no-sandbox", "--no-first-run", "--disable-gpu", "--hide-scrollbars"]
        options += [
            f"--user-data-dir={folder}/profile",
            "--window-size=1000,1250",
            f"--screenshot={figures}/report.png",
        ]
        subprocess.run([chromium, *options, f"file://{folder}/out/parapet_report.html"], check=True)


def intensities():
    """Draw the comparison of intensity measures."""
    wall = dd.OneSidedWall(height=1.5, thickness=0.25, name="parapet")
    ims = ["pga", "pgv", "pgd", "arias", "cav", "hi", "sa(0.2)", "sa(0.5)", "sa(1)", "saavg(0.2:2)"]
    ax = dd.compare_intensities(wall, records, ims).plot()
    ax.figure.savefig(figures / "intensity_measures.png", dpi=100)


def mechanisms():
    """Draw three rotated walls."""
    walls = [
        (dd.OneSidedWall(height=1.5, thickness=0.25, name="one_sided"), 0.6),
        (dd.FreeStandingWall(height=1.8, thickness=0.45, name="free_standing"), -0.6),
        (dd.TwoBlockWall(height=3.0, thickness=0.25, hinge=0.6, name="two_block"), 0.8),
    ]
    figure, axes = new_axes(1, 3, (9.6, 4.0))
    for ax, (shown, part) in zip(axes, walls, strict=True):
        shown.plot(ax, rotation=part * shown.capacity_angle)
        ax.set_title(shown.name, loc="left", family="monospace")
    figure.savefig(figures / "mechanisms.png", dpi=100)


def symbols():
    """Draw what the symbols of equations (1) to (4) mean, on a block and on two, thicker than walls are."""
    block = dd.OneSidedWall(height=3.0, thickness=0.9)
    strip = dd.TwoBlockWall(height=3.0, thickness=0.7, hinge=0.55)
    figure, axes = new_axes(1, 2, (8.4, 5.6))
    moved, apart = shape(block, 0.5 * block.capacity_angle), shape(strip, 0.45 * strip.capacity_angle)
    for ax, now in zip(axes, (moved, apart), strict=True):
        for corners in now.blocks:
            ax.fill(*corners.T, facecolor=style.BRICK, edgecolor=style.BLACK, linewidth=1.0, alpha=0.6)
        ax.plot(*now.hinges.T, "o", color=style.RED, markersize=6, zorder=5)
        ax.set_aspect("equal")
        ax.axis("off")
    one_block(axes[0], moved)
    two_blocks(axes[1], apart)
    figure.savefig(figures / "symbols.png", dpi=100)


def one_block(ax, now):
    """Draw the symbols of equations (1) and (2) on a block that has turned about O."""
    (toe,), (corners,) = now.hinges, now.blocks
    centre = corners.mean(axis=0)
    edge = far_end(corners, toe, 3.0)
    ax.plot([-0.5, 2.2], [0.0, 0.0], color=style.BLACK, linewidth=1.4)
    ax.fill_betweenx([0.0, 3.0], -0.5, 0.0, facecolor=style.LIGHT, hatch="//", edgecolor="white", linewidth=0.0)
    ax.text(-0.25, 1.5, "transverse wall", rotation=90, ha="center", va="center", fontsize=8.5)
    radius(ax, toe, centre, "$R$")
    vertical(ax, toe, 2.1)
    angle(ax, toe, 1.35, np.array([0.0, 1.0]), edge - toe, "$\\theta$")
    angle(ax, toe, 0.75, edge - toe, centre - toe, "$\\alpha$")
    ax.plot(*centre, "o", color=style.BLACK, markersize=4)
    ax.annotate("", np.add(centre, (0.0, -0.55)), centre, arrowprops={"arrowstyle": "-|>", "color": style.BLACK})
    ax.text(*np.add(centre, (-0.06, -0.62)), "$M_b\\,g$", ha="right")
    ax.text(*np.add(toe, (0.05, -0.06)), "$O$, hinge", color=style.RED, va="top")
    span(ax, toe, far_end(corners, toe, 0.9), "$t = 2b$", 0.16)
    span(ax, toe, edge, "$H = 2h$", -0.16)
    ax.annotate("", (1.9, -0.28), (1.2, -0.28), arrowprops={"arrowstyle": "<|-|>", "color": style.BLUE})
    ax.text(1.95, -0.28, "$\\ddot{u}_g$", color=style.BLUE, va="center")
    ax.set_title("(a) equations (1) and (2)", loc="left")
    ax.set(xlim=(-0.7, 2.6), ylim=(-0.5, 3.6))


def two_blocks(ax, now):
    """Draw the symbols of equations (3) and (4) on two blocks."""
    (base, middle, top), (lower, upper) = now.hinges, now.blocks
    ax.plot([-0.6, 2.0], [0.0, 0.0], color=style.BLACK, linewidth=1.4)
    up = np.array([0.0, 1.0])
    for start, end, name in ((base, middle, "1"), (middle, top, "2")):
        centre = 0.5 * (start + end)
        ax.plot(*np.array([start, end]).T, color=style.BLACK, linewidth=0.8, linestyle=":")
        radius(ax, start, centre, f"$R_{name}$")
        ax.plot(*centre, "o", color=style.BLACK, markersize=4)
        vertical(ax, start, 1.25)
        angle(ax, start, 0.85, up, end - start, f"$\\beta_{name}$")
    edge, side = far_end(lower, base, 1.65), far_end(upper, middle, 1.35)
    angle(ax, base, 1.2, up, edge - base, "$\\varphi$")
    angle(ax, base, 0.38, edge - base, middle - base, "$\\alpha_1$")
    angle(ax, middle, 1.2, up, side - middle, "$\\psi$")
    angle(ax, middle, 0.38, side - middle, top - middle, "$\\alpha_2$")
    for at, name, shift in (
        (base, "$O_1$", (0.06, -0.16)),
        (middle, "$O_2$", (-0.25, -0.02)),
        (top, "hinge", (0.08, 0.0)),
    ):
        ax.text(*np.add(at, shift), name, color=style.RED)
    corner = far_end(upper, top, 0.7)
    centre = 0.5 * (top + corner)
    load = centre + (top - centre) * 0.5
    ax.annotate(
        "", load, np.add(load, (0.0, 0.5)), arrowprops={"arrowstyle": "-|>", "color": style.BLUE, "linewidth": 1.6}
    )
    ax.text(*np.add(load, (0.05, 0.4)), "$N$", color=style.BLUE)
    span(ax, centre, load, "$e$", -0.1)
    span(ax, far_end(lower, base, 0.7), base, "$2b$", -0.16)
    outer = 1.25
    for low, high, words in ((0.0, 1.65, "$2h_1 = rH$"), (1.65, 3.0, "$2h_2 = (1 - r)H$")):
        ax.annotate("", (outer, low), (outer, high), arrowprops={"arrowstyle": "<->", "linewidth": 0.8})
        ax.text(outer + 0.06, 0.5 * (low + high), words, va="center")
    ax.set_title("(b) equations (3) and (4)", loc="left")
    ax.set(xlim=(-0.8, 2.5), ylim=(-0.5, 3.9))


def far_end(corners, start, length):
    """The corner of a block at the other end of the side of a length that begins at a corner."""
    away = np.abs(np.linalg.norm(corners - start, axis=1) - length)
    return corners[np.argmin(away)]


def radius(ax, start, end, name):
    """Draw a radius from a hinge to a centroid."""
    ax.annotate("", end, start, arrowprops={"arrowstyle": "-|>", "color": style.BLACK, "linewidth": 1.2, "shrinkA": 0})
    side = np.sign(end[0] - start[0])
    ax.text(*(start + 0.45 * (end - start) + np.array([0.06 * side, 0.0])), name, ha="left" if side > 0.0 else "right")


def vertical(ax, start, length):
    """Draw a vertical from which angles count."""
    ax.plot([start[0]] * 2, [start[1], start[1] + length], color=style.GREY, linewidth=0.8, linestyle="--")


def angle(ax, at, size, first, second, name):
    """Draw an angle between two directions, named outside of its arc."""
    ends = np.unwrap([np.arctan2(first[1], first[0]), np.arctan2(second[1], second[0])])
    turn = np.linspace(*ends, 40)
    arc = at[:, None] + size * np.array([np.cos(turn), np.sin(turn)])
    ax.plot(*arc, color=style.BLUE, linewidth=1.1)
    middle = 0.5 * ends.sum()
    ax.text(
        *(at + (size + 0.09) * np.array([np.cos(middle), np.sin(middle)])),
        name,
        color=style.BLUE,
        ha="center",
        va="center",
    )


def span(ax, start, end, words, away):
    """Draw a dimension beside a side."""
    along = (end - start) / np.linalg.norm(end - start)
    shift = away * np.array([-along[1], along[0]])
    ax.annotate(
        "", end + shift, start + shift, arrowprops={"arrowstyle": "<->", "linewidth": 0.8, "shrinkA": 0, "shrinkB": 0}
    )
    ax.text(
        *(0.5 * (start + end) + 2.1 * shift),
        words,
        ha="center" if away > 0.0 or words == "$e$" else "left",
        va="center",
    )


def supports():
    """Draw what moves seven walls: the supports of each, and the building as it leans."""
    # Levels of the base and of what holds the wall, height of the wall and of the building, two blocks or one
    walls = {
        "(a) strip": (6.0, 9.0, 3.0, 9.0, True),
        "(b) facade": (0.0, 9.0, 9.0, 9.0, False),
        "(c) above a hinge": (4.0, 9.0, 5.0, 9.0, False),
        "(d) parapet": (9.0, 9.0, 1.5, 9.0, False),
        "(e) gable": (6.0, 7.5, 3.0, 7.5, False),
        "(f) free-standing": (9.0, 9.0, 1.8, 9.0, False),
        "(g) held by nothing": (0.0, 0.0, 9.0, 9.0, False),
    }
    lean, thickness = 0.08, 0.5
    figure, axes = new_axes(1, len(walls), (11.0, 4.2), sharey=True)
    arrow = {"color": style.BLUE, "linewidth": 1.4}
    for ax, (name, (base, top, height, house, folds)) in zip(axes, walls.items(), strict=True):
        ax.plot([0, 0, -2.6, -2.6], [0, house, house, 0], color=style.GREY, linewidth=0.8)
        ax.plot(
            [0, lean * house, lean * house - 2.6, -2.6],
            [0, house, house, 0],
            color=style.GREY,
            linestyle="--",
            linewidth=0.8,
        )
        feet = lean * base
        turned = lean if top > base else 0.0
        opening = 0.16 if folds else 0.07 if top > base else 0.13
        if folds:
            middle = feet + turned * 0.6 * height + opening * 0.6 * height
            outline = [(feet, base), (middle, base + 0.6 * height), (feet + turned * height, base + height)]
            outline += [(x + thickness, y) for x, y in reversed(outline)]
        else:
            end = feet + (turned + opening) * height
            outline = [(feet, base), (end, base + height), (end + thickness, base + height), (feet + thickness, base)]
        ax.fill(*zip(*outline, strict=True), facecolor=style.BRICK, edgecolor=style.BLACK, linewidth=0.8)
        ax.annotate("", (feet - 0.1, base), (feet - 1.5, base), arrowprops={"arrowstyle": "-|>", **arrow})
        if top > base:
            held = lean * top
            ax.annotate("", (held - 0.1, top), (held - 1.5, top), arrowprops={"arrowstyle": "->", **arrow})
            if not folds:
                ax.plot([feet, held], [base, top], color=style.BLUE, linewidth=1.6)
        ax.axhline(0.0, color=style.BLACK, linewidth=0.8)
        ax.set_title(name, loc="left", fontsize=9.0)
        ax.set(xlim=(-2.9, 3.0), ylim=(-0.3, 12.0), xticks=[])
        ax.grid(visible=False)
        ax.spines["bottom"].set_visible(False)
    axes[0].set_ylabel("height above the ground [m]")
    figure.savefig(figures / "supports.png", dpi=100)


def bearing():
    """Draw joists on a wall that folds outwards, about the outer edge of its top, and on one that folds inwards."""
    load = {"overburden": 8000.0, "overburden_inertia": 0.0, "bearing": "inner", "bearing_distance": 0.06}
    wall = dd.TwoBlockWall(height=1.2, thickness=0.25, hinge=0.6, **load)
    figure, axes = new_axes(1, 2, (8.4, 4.6))
    joists = {"color": style.GREY, "linewidth": 7.0, "alpha": 0.55, "solid_capstyle": "butt", "zorder": 3}
    arrow = {"arrowstyle": "-|>", "color": style.BLUE, "linewidth": 1.6}
    for ax, part, title in zip(axes, (0.35, -0.35), ("outwards", "inwards"), strict=True):
        wall.plot(ax, rotation=part * wall.capacity_angle)
        _, _, outer, inner = shape(wall, part * wall.capacity_angle).blocks[1]
        if part < 0.0:
            # A mirrored block is drawn clockwise
            outer, inner = inner, outer
        x, y = inner + (outer - inner) * 0.06 / wall.thickness
        ax.plot([-0.35, inner[0] + 0.12], [y + 0.045, y + 0.045], **joists)
        ax.annotate("", (x, y), (x, y + 0.3), arrowprops=arrow, zorder=5)
        ax.annotate("N", (x, y + 0.3), (5, 0), textcoords="offset points", va="top", color=style.BLUE)
        ax.annotate("inner", (-0.07, 0.4), ha="right", fontsize=8.5)
        ax.annotate("outer", (0.34, 0.4), fontsize=8.5)
        ax.set_ylim(-0.05, 1.62)
        ax.set_title(title, loc="left")
    figure.savefig(figures / "bearing.png", dpi=100)


def ties():
    """Draw a facade with two ties, and their forces as it moves out, back, and out again."""
    wall = dd.OneSidedWall(
        9.0,
        0.5,
        ties=[dd.Tie(height, area=5e-5, length=8.0, preload=3e7) for height in (8.5, 5.5)],
        name="facade",
    )
    figure, axes = new_axes(1, 2, (9.0, 4.4), width_ratios=(1.0, 1.5))
    wall.plot(axes[0], rotation=0.5 * wall.capacity_angle)
    axes[0].set_title("ties, drawn with their plates", loc="left")
    stiffness, strength, preload = 2.06e11 * 5e-5 / 8.0, 9e3, 1.5e3
    yields, breaks, turns = (strength - preload) / stiffness, 0.02 * 8.0 - preload / stiffness, 0.09
    slack = turns - yields - preload / stiffness
    path = [(0.0, preload), (yields, strength), (turns, strength), (slack, 0.0), (0.0, 0.0), (slack, 0.0)]
    path += [(turns, strength), (breaks, strength), (breaks, 0.0)]
    travel, force = np.array(path).T
    axes[1].plot(1e3 * travel, force / 1e3, color=style.BLUE, linewidth=1.8)
    places = {"yields": (yields, strength), "turns": (turns, strength), "slack": (slack, 0.0)}
    places["breaks"] = (breaks, strength)
    for word, (x, y) in places.items():
        axes[1].annotate(word, (1e3 * x, y / 1e3), (0, 5), textcoords="offset points", ha="center")
    axes[1].set(xlabel="elongation from rest D [mm]", ylabel="force T [kN/m]", ylim=(-0.4, 10.5))
    axes[1].set_title("one of them: out, back, and out again", loc="left")
    figure.savefig(figures / "ties.png", dpi=100)


def anchor():
    """Draw a wall with a tie, its plate, and the frustum of masonry that it would pull out."""
    plate = {"plate_width": 0.35, "plate_height": 0.35, "plate_thickness": 0.02}
    wall = dd.OneSidedWall(
        7.2,
        0.55,
        ties=[dd.Tie(4.0, bar=0.024, spacing=2.5, length=10.0, strength=235e6 / 1.05, **plate)],
        masonry_compression=2e6,
        masonry_shear=4e4,
        masonry_tension=5e4,
        name="wall",
    )
    figure, axes = new_axes(1, 1, (4.6, 4.6))
    wall.plot(axes)
    figure.savefig(figures / "anchor.png", dpi=100)


def interlocking():
    """Draw a wall that interlocks with transverse walls, and its restoring moment the first time and later."""
    bare = dd.OneSidedWall(3.0, 0.25, name="bare")
    wall = dd.OneSidedWall(
        3.0,
        0.25,
        interlock=dd.Interlock(overlap=0.12, course=0.1, thickness=0.25, spacing=5.0),
        name="interlocking wall",
    )
    figure, axes = new_axes(1, 2, (9.0, 4.4), width_ratios=(1.0, 1.5))
    wall.plot(axes[0], rotation=0.02)
    axes[0].set_title("rotated by 0.02 rad", loc="left")
    q = np.linspace(0.0, wall.capacity_angle, 200)
    moments = [one.terms(q).restoring_moment - one.terms(q).load_force for one in (wall, bare)]
    axes[1].plot(q, moments[0] / 1e3, color=style.BLUE, linewidth=1.8, label="the first time")
    axes[1].plot(q, moments[1] / 1e3, color=style.BLACK, linewidth=1.0, linestyle=":", label="without friction")
    turns = 0.02
    first, later = (np.interp(turns, q, each) / 1e3 for each in moments)
    back = q < turns
    axes[1].plot(
        [*q[back], turns, turns],
        [*moments[1][back] / 1e3, later, first],
        color=style.RED,
        linewidth=1.6,
        linestyle="--",
        label="back from 0.02 rad, and out again",
    )
    axes[1].set(xlabel="rotation q [rad]", ylabel="restoring moment [kN m/m]", xlim=(0.0, None), ylim=(0.0, None))
    axes[1].legend(loc="upper right")
    figure.savefig(figures / "interlocking.png", dpi=100)


def compound():
    """Draw a facade that takes a wedge of a transverse wall along, and its multiplier over the angle of the crack."""
    wedge = dd.Wedge(thickness=0.45, angle=20.0, bottom=0.0, top=7.0, length=9.0)
    loads = [dd.Load(force, depth=d, height=z, inertia="both") for force, d, z in ((8e3, 0.4, 3.5), (4e3, 0.35, 7.0))]

    def facade(angle):
        wedges = [replace(wedge, angle=angle)] * 2
        return dd.OneSidedWall(
            *(7.0, 0.55), density=1900.0, hinge_depth=0.02, facade_length=6.0, wedges=wedges, loads=loads, name="facade"
        )

    figure, axes = new_axes(1, 2, (9.0, 4.6), width_ratios=(1.0, 1.4))
    facade(20.0).plot(axes[0], rotation=0.06)
    axes[0].set_title("rotated by 0.06 rad", loc="left")
    angles = np.linspace(0.0, 35.0, 71)
    # Loads go with the wall, so that alpha_0 is its trigger acceleration in g
    axes[1].plot(angles, [facade(a).trigger_acceleration / 9.81 for a in angles], color=style.BLUE, linewidth=1.8)
    axes[1].set(xlabel="angle of the crack [degrees]", ylabel="multiplier", xlim=(0.0, 35.0), ylim=(0.0, None))
    figure.savefig(figures / "compound.png", dpi=100)


def corner():
    """Draw a corner on its bisector, and its multiplier over the angle of the cracks."""
    load = dd.Load(total=6e3, depth=0.45, height=3.2, inertia="both")
    thrust = dd.Thrust(total=1e3, depth=0.45, height=3.2)

    def cracked(angle):
        return dd.Corner(
            *(3.2, 0.5), density=1900.0, hinge_depth=0.03, wing_angle=angle, wing_length=1.0, loads=[load],
            thrusts=[thrust], name="corner",
        )  # fmt: skip

    figure, axes = new_axes(1, 2, (9.0, 4.6), width_ratios=(1.0, 1.4))
    cracked(20.0).plot(axes[0], rotation=0.1)
    axes[0].set_title("rotated by 0.1 rad", loc="left")
    angles = np.linspace(0.0, 35.0, 71)
    # Loads go with the corner, so that alpha_0 is its trigger acceleration in g
    axes[1].plot(angles, [cracked(a).trigger_acceleration / 9.81 for a in angles], color=style.BLUE, linewidth=1.8)
    axes[1].set(xlabel="angle of the cracks [degrees]", ylabel="multiplier", xlim=(0.0, 35.0), ylim=(0.0, None))
    figure.savefig(figures / "corner.png", dpi=100)


def panel():
    """Draw the elevation of a facade whose part above an inclined crack turns, and this panel in its section."""
    wall = dd.OneSidedWall(
        thickness=0.5, density=1900.0, facade_length=6.0, hinge_depth=0.02, elevation_x=[0.0, 6.0, 6.0, 0.0],
        elevation_z=[0.0, 0.0, 6.5, 6.5], axis_x=[0.0, 6.0], axis_z=[5.0, 3.4], name="panel",
        openings=[dd.Opening(x=x, z=4.0, width=0.9, height=1.4) for x in (0.8, 4.3)],
        loads=[dd.Load(1e3, x=5.0, depth=0.3, height=6.4, inertia="both")],
    )  # fmt: skip
    figure, axes = new_axes(1, 2, (9.0, 4.4), width_ratios=(1.6, 1.0))
    wall.plot_elevation(axes[0])
    wall.plot(axes[1], rotation=0.08)
    axes[1].set_title("rotated by 0.08 rad", loc="left")
    figure.savefig(figures / "panel.png", dpi=100)


def six_mechanisms():
    """Draw the mechanisms that are usual in practice beside each other."""
    wedge = dd.Wedge(thickness=0.45, angle=20.0, bottom=0.0, top=6.0, length=9.0)
    band = dd.horizontal_bending(4.0, 0.5, 1900.0, thrust=25e3, hinge_depth=0.02, sides=2, restitution_value=0.7)
    portal = dd.arch(1.75, 0.5, 180.0, voussoirs=8, pier=(1.0, 3.5), density=1900.0, sides=2, restitution_value=0.8)
    drawn = {
        "simple overturning": (dd.OneSidedWall(6.0, 0.5, hinge_depth=0.02), 0.05),
        "compound overturning": (
            dd.OneSidedWall(6.0, 0.5, hinge_depth=0.02, facade_length=6.0, wedges=[wedge, wedge]), 0.05
        ),
        "corner, on its bisector": (dd.Corner(3.2, 0.5, wing_angle=20.0, hinge_depth=0.03), 0.08),
        "vertical bending": (dd.TwoBlockWall(3.2, 0.3, hinge=0.6), 0.08),
        "horizontal bending (plan)": (band, 0.08),
        "arch on piers": (portal, 0.08),
    }  # fmt: skip
    figure, axes = new_axes(2, 3, (9.0, 7.4))
    for ax, (title, (wall, rotation)) in zip(axes.flat, drawn.items(), strict=True):
        wall.plot(ax, rotation=rotation)
        ax.set_title(title, loc="left")
        if wall is band:
            ax.set(xlim=(-2.0, 1.5), ylim=(-0.4, 5.2), ylabel="along the wall [m]")
    figure.savefig(figures / "six_mechanisms.png", dpi=100)


def processing():
    """Draw a record with an offset and long-period noise, before and after processing."""
    clean = next(record for record in records if "friuli_1976_sep_15" in record.name)
    time = clean.time
    noise = 0.01 + 0.03 * np.sin(2.0 * np.pi * 0.04 * time)
    given = clean.processed(clean.acceleration + noise, "0.01 m/s2 and 0.03 m/s2 of 0.04 Hz added")
    mean = given.correct_baseline()
    curves = [
        (given, style.GREY, "-", "as given"),
        (mean, style.BLUE, "--", "mean taken off"),
        (mean.band_pass(0.1, 25.0, keep_padding=True), style.RED, "-", "and band-pass 0.1-25 Hz, pads kept"),
    ]
    figure, axes = new_axes(3, 1, (8.4, 6.0), sharex=True)
    for record, color, line, label in curves:
        # Pads are shown before time 0 and after the end
        shift = 0.5 * (record.duration - clean.duration)
        speed = record.velocity
        way = np.append(0.0, np.cumsum(0.5 * record.dt * (speed[1:] + speed[:-1])))
        for ax, values in zip(axes, (record.acceleration, speed, way), strict=True):
            ax.plot(record.time - shift, values, color=color, linestyle=line, linewidth=1.0, label=label)
    for ax, label in zip(axes, ("acceleration\n[m/s²]", "velocity\n[m/s]", "displacement\n[m]"), strict=True):
        ax.set_ylabel(label)
    axes[0].set_xlim(-10.0, clean.duration + 10.0)
    axes[2].set_xlabel("time [s]")
    axes[0].set_title(f"{clean.name} (synthetic) with noise added", loc="left")
    style.legend(axes[2], Options({}))
    figure.savefig(figures / "processing.png", dpi=100)


def pulses():
    """Draw acceleration and velocity of the four pulses."""
    shown = [
        (dd.pulses.one_sine(1.0 / 9.81, 1.0), "one_sine"),
        (dd.pulses.one_cosine(1.0 / 9.81, 1.0), "one_cosine"),
        (dd.pulses.ricker(1.0 / 9.81, 1.0), "ricker"),
        (dd.pulses.mavroeidis_papageorgiou(1.0 / (2.0 * np.pi), 1.0, phase=90.0, gamma=2.5), "mavroeidis_papageorgiou"),
    ]
    figure, axes = new_axes(2, 4, (9.6, 3.8), sharey="row", sharex="col")
    for column, (record, name) in zip(axes.T, shown, strict=True):
        time = np.concatenate([[-0.2, 0.0], record.time, record.duration + np.array([0.0, 0.2])])
        for ax, values in zip(column, (record.acceleration, 2.0 * np.pi * record.velocity), strict=True):
            end = values[-1] if ax is column[1] else 0.0
            ax.plot(time, np.concatenate([[0.0, 0.0], values, [end, end]]), color=style.BLUE)
        column[0].set_title(name, loc="left", family="monospace", fontsize=8.5)
        column[1].set_xlabel("time in periods of the pulse")
    axes[0, 0].set_ylabel("acceleration / $a_p$")
    axes[1, 0].set_ylabel("velocity / $(a_p / \\omega_p)$")
    figure.savefig(figures / "pulses.png", dpi=100)


def free_rocking():
    """Draw the decay of a wall that is released, and the closed form of its amplitudes."""
    wall = dd.FreeStandingWall(2.0, 0.4, name="released wall")
    still = dd.Record([0.0, 0.0], 0.01, name="still ground")
    motion = dd.simulate(wall, still, initial_rotation=0.8 * wall.capacity_angle)
    figure, ax = new_axes(1, 1, (7.2, 2.8))
    ax.plot(motion.time, motion.rotation / wall.capacity_angle, color=style.BLUE, label="rotation")
    alpha, impacts = wall.capacity_angle, motion.time[motion.after_impact]
    energy = np.cos(0.2 * alpha) - np.cos(alpha)
    for number, (start, end) in enumerate(itertools.pairwise(impacts[:12]), 1):
        left = wall.restitution_coefficient ** (2 * number) * energy
        amplitude = (1.0 - np.arccos(np.cos(alpha) + left) / alpha) * (-1.0) ** number
        ax.plot([start, end], [amplitude, amplitude], color=style.RED, label="closed form" if number == 1 else None)
    ax.set(xlabel="time [s]", ylabel="rotation / capacity", xlim=(0.0, impacts[11]))
    ax.axhline(0.0, color=style.GREY, linewidth=0.6)
    style.legend(ax, Options({}))
    figure.savefig(figures / "free_rocking.png", dpi=100)


def overturning():
    """Draw overturning spectra of Zhang and Makris' block under a sine and under a Ricker wavelet."""
    radius, alpha, p = 0.75 * 9.81 / 2.14**2, 0.25, 2.14
    wall = dd.FreeStandingWall(
        height=2.0 * radius * np.cos(alpha),
        thickness=2.0 * radius * np.sin(alpha),
        restitution_value=0.9,
        name="alpha = 0.25, p = 2.14/s, restitution 0.9",
    )
    figure, axes = new_axes(1, 2, (10.4, 4.8), sharey=True)
    for ax, pulse in zip(axes, (dd.pulses.one_sine, dd.pulses.ricker), strict=True):
        ratio, height = np.linspace(0.1, 8.0, 159), np.linspace(0.1, 12.0, 120)
        spectrum = dd.overturning_spectrum(
            wall, pulse, frequencies=ratio * p / (2.0 * np.pi), amplitudes=height * np.tan(alpha)
        )
        spectrum.plot(ax, legend=False)
        ax.set_title(pulse.__name__, loc="left", family="monospace")
    axes[1].set_ylabel("")
    # Zhang and Makris (2001), figures 7 and 8, linear block: overturns from, safe from, without impact from
    published = np.array([3.005, 6.325, 7.175])
    axes[0].plot(
        np.full(3, 5.0),
        published * alpha / np.tan(alpha),
        linestyle="none",
        marker="D",
        markersize=5,
        markerfacecolor="white",
        markeredgecolor=style.BLACK,
        label="published, linear block",
    )
    figure.legend(*axes[0].get_legend_handles_labels(), loc="outside lower center", ncols=3, frameon=False)
    figure.savefig(figures / "overturning_spectrum.png", dpi=100)


def statistics():
    """Draw the statistics of 200 realisations against the model."""
    scenario = (6.0, 10.0, "rock")
    made, model = dd.synthetic_records(*scenario, n_records=200, seed=2024), Model(*scenario)
    time, step = made[0].time, made[0].dt
    squares = np.array([record.acceleration**2 for record in made])
    figure, axes = new_axes(1, 3, (10.4, 3.6))
    width = round(0.5 / step)
    smooth = np.convolve(squares.mean(axis=0), np.ones(width) / width, mode="same")
    axes[0].plot(time, smooth, color=style.BLUE, label="mean of 200, over 0.5 s")
    axes[0].plot(time, model.power(time), color=style.BLACK, linestyle="--", label="model")
    axes[0].set_ylabel("squared acceleration [m²/s⁴]")
    energy = step * np.cumsum(squares, axis=1)
    low, high = np.percentile(energy, [5.0, 95.0], axis=0)
    axes[1].fill_between(time, low, high, color=style.BLUE, alpha=0.2, linewidth=0.0, label="90 % of 200")
    axes[1].plot(time, energy.mean(axis=0), color=style.BLUE, label="mean of 200")
    axes[1].plot(time, model.energy * model.husid(time), color=style.BLACK, linestyle="--", label="model")
    axes[1].set_ylabel("integral of squared acceleration [m²/s³]")
    middle = np.arange(1.0, model.length - 1.5, 0.5)
    measured = [mean_frequency(made, t, 1.5) for t in middle]
    axes[2].plot(
        middle, measured, color=style.BLUE, marker="o", markersize=3, linestyle="none", label="200, over 1.5 s"
    )
    axes[2].plot(time, model.frequency(time), color=style.BLACK, linestyle="--", label="model")
    axes[2].set_ylabel("central frequency [Hz]")
    axes[2].set_ylim(0.0, None)
    for ax in axes:
        ax.set_xlabel("time [s]")
        ax.legend(frameon=False, fontsize=8.5)
    axes[0].set_title("magnitude {:g}, {:g} km, {}".format(*scenario), loc="left")
    figure.savefig(figures / "synthetic_statistics.png", dpi=100)
    total, spread = energy[:, -1].mean(), energy[:, -1].std()
    print(f"mean energy {total:.5g}, model {model.energy:.5g}, coefficient of variation {spread / total:.3f}")


def spectra():
    """Draw response spectra of the synthetic suite and of recorded Italian accelerograms."""
    folder = Path(os.environ.get("DONDOLO_RECORDS", "none"))
    if not (folder / "italy44.csv").is_file():
        print("synthetic_spectra.png: not drawn, no recorded accelerograms found (set DONDOLO_RECORDS to their folder)")
        return
    periods = np.geomspace(0.04, 4.0, 60)
    sets = [
        ("synthetic44", records, style.BLUE, "-"),
        ("recorded", dd.read_catalogue(folder / "italy44.csv"), style.RED, "--"),
    ]
    figure, axes = new_axes(1, 3, (10.4, 3.8))
    for name, several, color, line in sets:
        logs = np.log([record.spectrum(periods).pseudo_acceleration / 9.81 for record in several])
        pga = np.log([record.peak_acceleration / 9.81 for record in several])
        shape = logs - pga[:, None]
        for ax, values in zip(axes[:2], (logs, shape), strict=True):
            low, median, high = np.exp(np.percentile(values, [16.0, 50.0, 84.0], axis=0))
            ax.fill_between(periods, low, high, color=color, alpha=0.2, linewidth=0.0)
            ax.plot(periods, median, color=color, linestyle=line, label=f"{name}: median, 16-84 %")
        axes[2].plot(periods, shape.std(axis=0, ddof=1), color=color, linestyle=line, label=name)
        at = [0.1, 0.3, 1.0, 2.0, 4.0]
        print(
            f"{name}: median PGA {np.exp(np.median(pga)):.3f} g, {np.exp(pga.min()):.3f} to {np.exp(pga.max()):.3f};",
            *(
                f"T = {t}: Sa/PGA {np.exp(np.median([np.interp(t, periods, row) for row in shape])):.3f},"
                f" std of ln {np.interp(t, periods, shape.std(axis=0, ddof=1)):.2f};"
                for t in at
            ),
        )
    for ax in axes:
        ax.set_xscale("log")
        ax.set_xlabel("period [s]")
        ax.set_xticks([0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 4.0], ["0.05", "0.1", "0.2", "0.5", "1", "2", "4"])
        ax.minorticks_off()
    axes[0].set_yscale("log")
    axes[0].set_ylabel("spectral acceleration, 5 % damping [g]")
    axes[1].set_yscale("log")
    axes[1].set_ylabel("spectral acceleration / PGA")
    axes[2].set_ylabel("standard deviation of ln(Sa/PGA)")
    axes[2].set_ylim(0.0, None)
    for ax in axes:
        style.legend(ax, Options({}))
    figure.savefig(figures / "synthetic_spectra.png", dpi=100)


if __name__ == "__main__":
    main()
