"""Facts of a report on designs of a wall."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from dondolo.reporting.content import BETA, THETA, Piece, Symbol, Table, figure, level, level_unit
from dondolo.reporting.numerals import number, parameter, percent
from dondolo.retrofit.designs import DesignComparison

# Designs whose main numbers stand at the beginning
_CARDS = 8


def summary(found: DesignComparison) -> dict[str, Any]:
    """The main numbers: the median of the first, and what the others make of it."""
    first = found.curves[0]
    median = level(first.theta, found.im) if first.has_fit else "none"
    cards: list[tuple[Piece, Piece, Piece]] = [(("median ", THETA, f", {found.names[0]}"), median, "of collapse")]
    for name, ratio, (low, high) in list(zip(found.names, found.ratio, found.ratio_interval, strict=True))[1:_CARDS]:
        text = number(ratio, 3, " times") if np.isfinite(ratio) else "no ratio"
        interval = f"{low:.3g} to {high:.3g} times the median of the first" if np.isfinite(ratio) else "of medians"
        cards.append((name, text, interval))
    return {"cards": cards, "shares": []}


def designs(found: DesignComparison) -> dict[str, Any]:
    """What each design gains against the first."""
    low, high = found.ratio_interval.T
    p_values = [np.nan if one is None else one.p_value for one in found.comparisons]
    columns: dict[Piece, Sequence[Piece]] = {
        "design": list(found.names),
        (THETA, f" [{level_unit(found.im)}]"): [parameter(curve.theta) for curve in found.curves],
        BETA: [parameter(curve.beta) for curve in found.curves],
        "ratio of medians": [number(ratio, 3) for ratio in found.ratio],
        "from": [number(value, 3) for value in low],
        "to": [number(value, 3) for value in high],
        "p of no difference": [number(value, 2) for value in p_values],
        "steel [kg/m]": [number(mass, 3) for mass in found.steel],
        "gain per kg/m": [percent(gain) if np.isfinite(gain) else number(gain) for gain in found.gain_per_kg],
        (Symbol("α", "0"), " [g]"): [number(value) for value in found.alpha_0],  # noqa: RUF001
        "its ratio": [number(ratio, 3) for ratio in found.static_ratio],
    }
    pairs = zip(found.names, found.ratio, low, high, strict=True)
    words = "; ".join(f"{name}: {ratio:.3g} ({least:.3g} to {most:.3g})" for name, ratio, least, most in pairs)
    alt = f"Fragility curves of the designs, and the ratios of their medians to that of the first. {words}."
    return {
        "first": found.names[0],
        "confidence": f"{100.0 * found.confidence:.4g}",
        "figure": figure(found.plot, alt),
        "table": Table.of(columns),
        "has_checks": bool(found.checks) and found.im == "pga",
    }
