"""Figure of a check: its lines on a fragility curve."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

from dondolo._fortran.library import shown_probability
from dondolo.curves.fragility import Fragility
from dondolo.figures import curves, style
from dondolo.figures.options import Options
from dondolo.figures.themes import theme
from dondolo.figures.wording import decimal, say

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from dondolo.checks.ntc import CodeCheck

# What sentences that are said elsewhere are marked by for the catalogues
_ = str
_CHECKS = {
    "linear": _("linear {state}"),
    "nonlinear": _("nonlinear {state}"),
    "dynamic": _("dynamic {state}"),
}


# What keeps a number clear of the lines behind it
_CLEAR = {"facecolor": "white", "edgecolor": "none", "pad": 0.3}


def check_name(method: str, state: str) -> str:
    """A check in words."""
    return say(_CHECKS[method], state=state)


def draw_check(check: CodeCheck, curve: Fragility, ax: Axes | None, given: dict[str, Any]) -> Axes:
    """Draw a curve, the peak acceleration of the site, and the capacity of the wall by each formula."""
    options = Options(given, "band", "bars", "points")
    chances = {key: value for key, value in check.probabilities(curve).items() if key not in check.not_applicable}
    ax = curve.plot(curves.axes(ax), **given | {"legend": False})
    right = max(
        ax.get_xlim()[1],
        1.05 * max(check.pga, *(check.value(*key, "capacity_pga") for key in chances if key[0] != "site")),
    )
    for i, ((method, state), chance) in enumerate(chances.items()):
        level = check.value(method, state, "pga" if method == "site" else "capacity_pga")
        numbers = {"level": level, "chance": decimal(shown_probability(chance))}
        if method == "site":
            site = say("a_g S of the site {state}", state=state).strip()
            label = say("{site}: {level:.3g} g, P = {chance}", site=site, **numbers)
        else:
            label = say("{check} withstands {level:.3g} g, P = {chance}", check=check_name(method, state), **numbers)
        look = (
            {"color": style.BLACK, "linewidth": 1.8}
            if method == "site"
            else {
                "color": style.RED if method == "nonlinear" else style.GREY,
                "linewidth": 1.2,
                "linestyle": style.LINES[i % len(style.LINES)],
            }
        )
        ax.axvline(level, label=style.in_math(label), gid=style.FORMULA, zorder=1, **look)
        ax.plot(level, chance, marker="x", markersize=6, color=look["color"], zorder=4)
    ax.set_xlim(0.0, right)
    style.legend(ax, options)
    return ax


def draw_safety(
    ax: Axes,
    names: Sequence[str],
    checks: Sequence[CodeCheck],
    words: Mapping[tuple[str, str], str],
    decimal: Callable[[str], str],
    colours: Sequence[str],
) -> None:
    """Draw the safety indices of walls as bars, those of a wall beside each other; 1 is a line.

    Parameters
    ----------
    ax : Axes
        Where to draw.
    names, checks : sequence
        Of the walls, the first on top.
    words : mapping
        (method, limit state): what it is called.
    decimal : callable
        Sets the decimal mark of the language.
    colours : sequence of str
        Of the checks.
    """
    thick = 0.8 / len(words)
    for place, ((key, word), colour) in enumerate(zip(words.items(), colours, strict=True)):
        # A check that is not for the wall has no index, and no bar.
        found = [(row, one.value) for row, check in enumerate(checks) if (one := check._row(*key, "zeta_e"))]
        at = [row - 0.4 + (place + 0.5) * thick for row, _index in found]
        ax.barh(
            at, [index for _row, index in found], thick, color=colour, edgecolor=style.BLACK, linewidth=0.6, label=word
        )
        for height, (_row, index) in zip(at, found, strict=True):
            ax.annotate(decimal(f"{index:.3g}"), (index, height), (3, 0), textcoords="offset points", va="center",
                        fontsize=theme().note, bbox=_CLEAR)  # fmt: skip
    # Lines at the names would strike through the numbers.
    ax.grid(visible=False, axis="y")
    ax.axvline(1.0, color=style.BLACK, linewidth=1.0, linestyle="--")
    ax.set_yticks(range(len(names)), [style.in_lines(style.label(name), ax, 0.4) for name in names], parse_math=False)
    ax.invert_yaxis()
    ax.set_xlim(0.0, 1.12 * max(1.0, *ax.get_xlim()))
    ax.set_xlabel(style.in_math("ζ_E"))
