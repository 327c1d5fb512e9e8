"""The picture of docs/developing/architecture.md: the rooms of the library and what each imports, read from sources."""

import re
from collections import Counter
from pathlib import Path

import matplotlib.pyplot as plt

from dondolo.figures.themes import theme

ROOT = Path(__file__).resolve().parents[1]

#: Rooms in their order, from what needs nothing to what needs all
HALVES = {
    "core": ["base", "record", "building", "wall", "motion", "fragility", "check"],
    "study": ["files", "records", "population", "case", "interface"],
}


def imports():
    """Number of files of each room, and how many modules each takes from each other.

    Returns
    -------
    files : Counter
        Number of files by room.
    uses : Counter
        Number of imported modules by (room, room that they are taken from).
    """
    sources = {path: path.relative_to(ROOT / "src").parts[1] for path in (ROOT / "src").glob("*/**/*.[fF]90")}
    homes = {}
    for path, room in sources.items():
        homes |= dict.fromkeys(re.findall(r"^module (\w+)", path.read_text(), re.M), room)
    uses = Counter()
    for room in dict.fromkeys(sources.values()):
        text = "".join(path.read_text() for path, other in sources.items() if other == room)
        taken = {re.sub("_(avx2|avx512)$", "", name) for name in re.findall(r"^\s+use (dondolo_\w+)", text, re.M)}
        uses.update((room, homes[name]) for name in taken if homes[name] != room)
    return Counter(sources.values()), uses


def draw(path):
    """Draw the rooms as boxes, each above those it imports, and the imports as arcs, as wide as the modules they carry.

    Parameters
    ----------
    path : Path
        File of the picture.
    """
    files, uses = imports()
    with plt.rc_context(dict(theme().rc)):
        figure, ax = plt.subplots(figsize=(7.6, 6.2), layout="constrained")
    rooms = [room for half in HALVES.values() for room in half]
    assert set(rooms) == set(files), "a room that the picture does not know"
    # A gap between the halves
    places = {room: i + (0.6 if room in HALVES["study"] else 0.0) for i, room in enumerate(rooms)}
    for (room, other), modules in uses.items():
        # All use it.
        if other == "base":
            continue
        upper, lower = places[room], places[other]
        side = 1 if room in HALVES["core"] else -1
        ax.annotate(
            "",
            (0.85 * side, lower),
            (0.85 * side, upper),
            arrowprops={
                "arrowstyle": "-|>",
                "linewidth": 0.5 + 0.25 * modules,
                "color": "0.35" if side > 0 else "0.6",
                "connectionstyle": f"arc3,rad={-side * 0.55}",
                "shrinkA": 0,
                "shrinkB": 0,
                "mutation_scale": 8,
            },
        )
    for room, y in places.items():
        grey = "0.86" if room in HALVES["core"] else "1.0"
        ax.add_patch(plt.Rectangle((-0.85, y - 0.32), 1.7, 0.64, facecolor=grey, edgecolor="0.2", linewidth=0.9))
        ax.text(
            0.0,
            y,
            f"{room} ({files[room]})" if room != "base" else f"base ({files[room]}): used by all",
            ha="center",
            va="center",
            fontsize=9,
        )
    for half, (side, text) in {"core": (1, "computes"), "study": (-1, "reads, writes and words")}.items():
        middle = sum(places[room] for room in HALVES[half]) / len(HALVES[half])
        count = sum(files[room] for room in HALVES[half])
        ax.text(
            2.6 * side,
            middle,
            f"src/{half}\n{text}\n{count} files",
            ha="left" if side > 0 else "right",
            va="center",
            fontsize=10,
        )
    ax.set(xlim=(-4.9, 4.2), ylim=(-0.6, max(places.values()) + 0.6))
    ax.axis("off")
    figure.savefig(path, dpi=120)
    plt.close(figure)
