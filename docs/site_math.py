"""Formulas of the site as MathML, which browsers show without a script and without a network."""

from __future__ import annotations

import re
from typing import Any

from docutils import nodes
from latex2mathml.converter import convert


def mathml(formula: str, display: str = "inline") -> str:
    """Convert a formula of LaTeX.

    Parameters
    ----------
    formula : str
        As GitHub shows it too.
    display : str, default 'inline'
        Or 'block'.

    Returns
    -------
    str

    Raises
    ------
    ValueError
        If a command or a mark of alignment would be printed instead of followed.
    """
    # The environment that the converter knows, within a formula the same; primes beside a power and above an index
    known = re.sub(r"('+)(?:\^(\w|\{[^}]*\}))?", _primes, formula.replace("{aligned}", "{align*}"))
    made = convert(known, display=display)
    left = re.findall(r"<m[a-z]+>(?:&amp;|&|\\\w+)</m[a-z]+>", made)
    if left:
        raise ValueError(f"{formula}: is not understood: {', '.join(left)}")
    return made


def _primes(found: re.Match[str]) -> str:
    """Primes as one mark, with the power that follows them."""
    mark = ("\u2032", "\u2033", "\u2034")[len(found[1]) - 1]
    power = (found[2] or "").strip("{}")
    return f"^{{{mark}{power}}}"


def _inline(translator: Any, node: nodes.Element) -> None:
    translator.body.append(mathml(node.astext()))
    raise nodes.SkipNode


def _block(translator: Any, node: nodes.Element) -> None:
    # A wide formula scrolls within its line, on telephones too.
    translator.body.append(f'<div class="formula">{mathml(node.astext(), "block")}</div>\n')
    raise nodes.SkipNode


def setup(app: Any) -> dict[str, bool]:
    """Offer `mathml` as a renderer of formulas."""
    app.add_html_math_renderer("mathml", (_inline, None), (_block, None))
    return {"parallel_read_safe": True, "parallel_write_safe": True}
