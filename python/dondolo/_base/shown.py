"""How results show themselves: their facts in a line, or as a table in a notebook."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from dondolo._base.wording import say

# Dispersions below this are rounding
_ROUNDING = 1e-6


def shown_dispersion(value: float) -> float:
    """A dispersion to be shown: 0 where it is rounding alone, as between walls that are alike."""
    return 0.0 if abs(value) < _ROUNDING else value


def span(counts: NDArray[np.integer]) -> str:
    """Counts in words: one number, or the least and the most."""
    few, many = int(counts.min()), int(counts.max())
    return str(few) if few == many else say("{few} to {many}", few=few, many=many)


class Shown:
    """What has facts to show, name and text."""

    _separator = ", "

    def _facts(self) -> list[tuple[str, str]]:
        raise NotImplementedError

    def __repr__(self) -> str:
        return f"<{type(self).__name__}: {self._separator.join(f'{what} {text}' for what, text in self._facts())}>"

    def _repr_html_(self) -> str:
        return html_of(type(self).__name__, self._facts())


def html_of(title: str, facts: Sequence[tuple[str, str]]) -> str:
    """A small table for notebooks."""
    import html

    rows = "".join(f"<tr><th>{html.escape(what)}</th><td>{html.escape(text)}</td></tr>" for what, text in facts)
    return f"<table><caption>{html.escape(title)}</caption>{rows}</table>"
