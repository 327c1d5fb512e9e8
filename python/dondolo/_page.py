"""Pieces of a page in HTML that needs nothing but itself: tables, figures, foldable parts, the sheet of styles.

A piece is a `Markup`; every other text is escaped where it enters a piece.
"""

from __future__ import annotations

import base64
import html
import io
import re
from collections.abc import Iterable, Sequence
from string import Template
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Callable

# Typography, by name: they look like others
DASH, MINUS, TIMES = "\N{EN DASH}", "\N{MINUS SIGN}", "\N{MULTIPLICATION SIGN}"

# Rows of a table that are written; what is left out is said
ROWS = 500
# A drawing is embedded as SVG up to this size, and as pixels beyond: many thin curves make large drawings
_SVG_BYTES = 600_000
_DOTS_PER_INCH = 180


class Markup(str):
    """A text that is HTML already."""


def escaped(text: Any) -> Markup:
    """A text as HTML; a piece stays as it is."""
    return text if isinstance(text, Markup) else Markup(html.escape(str(text)))


def joined(*pieces: Any) -> Markup:
    """Pieces and texts, one after the other."""
    return Markup("".join(escaped(piece) for piece in pieces))


def tag(name: str, *content: Any, **attributes: Any) -> Markup:
    """An element; a trailing _ of an attribute's name is dropped, other _ are hyphens."""
    names = {what: what.removesuffix("_").replace("_", "-") for what in attributes}
    head = "".join(f' {names[what]}="{html.escape(str(value))}"' for what, value in attributes.items())
    return Markup(f"<{name}{head}>{joined(*content)}</{name}>")


def paragraph(*content: Any, class_: str | None = None) -> Markup:
    """A paragraph."""
    return tag("p", *content, **({"class_": class_} if class_ else {}))


def symbol(letter: str, index: str = "") -> Markup:
    """A quantity: an italic letter, and an upright index below."""
    below = tag("sub", index) if index else ""
    return joined(tag("i", letter), below)


def number(value: float | None, figures: int = 4) -> Markup:
    """A number with so many significant figures; a dash for none."""
    if value is None or np.isnan(value):
        return Markup(f'<span title="none">{DASH}</span>')
    if np.isinf(value):
        return Markup("∞" if value > 0.0 else f"{MINUS}∞")
    if value == round(value) and abs(value) < 1e15:
        return Markup(whole(int(value)) if abs(value) >= 10**figures else str(int(value)).replace("-", MINUS))
    mantissa, _, power = f"{value:.{figures}g}".partition("e")
    if power and 0 < int(power) < 6:
        return whole(float(f"{value:.{figures}g}"))
    text = mantissa.replace("-", MINUS)
    return Markup(text + (f" {TIMES} 10<sup>{str(int(power)).replace('-', MINUS)}</sup>" if power else ""))


def parameter(value: float) -> Markup:
    """A number with four significant figures, also where they are zeros: for columns of a kind."""
    text = f"{value:#.4g}".removesuffix(".")
    return number(value) if "e" in text or not np.isfinite(value) else Markup(text.replace("-", MINUS))


def whole(value: float) -> Markup:
    """A count, with thin blanks between thousands."""
    return Markup(f"{int(value):,}".replace(",", "\u202f"))


def probability(value: float) -> Markup:
    """A probability with four decimals; what is not quite 0 or 1 is told from it."""
    if np.isnan(value):
        return number(value)
    if 0.0 < value < 5e-5:
        return Markup("&lt;0.0001")
    if 0.99995 <= value < 1.0:
        return Markup("&gt;0.9999")
    return Markup(f"{value:.4f}" if 0.0 < value < 1.0 else f"{value:.0f}")


def percent(share: float) -> Markup:
    """A share in per cent."""
    if 0.0 < share < 0.0005:
        return Markup("&lt;0.1 %")
    return joined(number(100.0 * share, 3), " %")


def table(caption: Any, columns: dict[Any, Sequence[Any]], texts: Iterable[str] = (), rows: int = ROWS) -> Markup:
    """A table in a box that scrolls; the first column heads its rows.

    Parameters
    ----------
    caption : str
        What the table shows.
    columns : dict
        Head -> cells, texts or pieces.
    texts : iterable of str
        Heads of columns that hold words, which are set flush left.
    rows : int
        Rows that are written at most.
    """
    words = {next(iter(columns)), *texts}
    head = joined(*(tag("th", name, scope="col", class_="text" if name in words else "num") for name in columns))
    total = len(next(iter(columns.values())))
    body = []
    for row in zip(*(cells[:rows] for cells in columns.values()), strict=True):
        first, *others = zip(columns, row, strict=True)
        cells = [tag("td", cell, class_="text" if name in words else "num") for name, cell in others]
        body.append(joined(Markup("<tr>"), tag("th", first[1], scope="row"), *cells, Markup("</tr>\n")))
    note = f" First {rows} of {total} rows; all are in the result files." if total > rows else ""
    content = joined(tag("caption", caption, note), tag("thead", tag("tr", head)), Markup("\n"), tag("tbody", *body))
    label = re.sub("<[^>]*>", "", str(escaped(caption)))
    box = f'<div class="scroll" role="region" tabindex="0" aria-label="{html.escape(html.unescape(label))}">'
    return joined(Markup(box), tag("table", content), Markup("</div>\n"))


def facts(pairs: Iterable[tuple[Any, Any]]) -> Markup:
    """Names and what they are, as a list of two columns."""
    return tag("dl", *(tag("div", tag("dt", what), tag("dd", text)) for what, text in pairs), class_="facts")


def cards(entries: Iterable[tuple[Any, Any, Any]]) -> Markup:
    """The main numbers: name, value, and a word on it."""
    boxes = (
        tag("div", tag("dt", what), tag("dd", value), tag("dd", note, class_="note")) for what, value, note in entries
    )
    return tag("dl", *boxes, class_="cards")


def details(summary: Any, *content: Any) -> Markup:
    """A part that unfolds."""
    return joined(tag("details", tag("summary", summary), *content), Markup("\n"))


def section(key: str, title: str, *content: Any) -> Markup:
    """A chapter of the page, with an id to link to."""
    return joined(tag("section", tag("h2", title), *content, id=key, aria_label=title), Markup("\n"))


def figure(draw: Callable[[], Any], alt: str, caption: Any) -> Markup:
    """A drawing, embedded: as SVG, or as PNG where that would be large.

    Parameters
    ----------
    draw : callable
        Gives Matplotlib axes, or several of one figure.
    alt : str
        What there is to see, for who cannot.
    caption : str
        What stands below.
    """
    import matplotlib as mpl
    import matplotlib.pyplot as plt

    axes = draw()
    drawing = (axes if hasattr(axes, "figure") else axes[0]).figure
    try:
        # The same bytes every time: no date, and names in the drawing by a fixed salt.
        with mpl.rc_context({"svg.hashsalt": "dondolo", "savefig.bbox": "tight"}):
            stream = io.BytesIO()
            drawing.savefig(stream, format="svg", metadata={"Date": None})
            kind = "svg+xml"
            if stream.tell() > _SVG_BYTES:
                stream, kind = io.BytesIO(), "png"
                drawing.savefig(stream, format="png", dpi=_DOTS_PER_INCH)
    finally:
        plt.close(drawing)
    data = base64.b64encode(stream.getvalue()).decode()
    image = Markup(f'<img src="data:image/{kind};base64,{data}" alt="{html.escape(alt)}">')
    return joined(tag("figure", image, tag("figcaption", caption)), Markup("\n"))


def page(title: str, generator: str, head: Markup, parts: Iterable[tuple[str, str, Markup]], foot: Markup) -> str:
    """The whole page.

    Parameters
    ----------
    title : str
        Of the page.
    generator : str
        The program and its version.
    head : Markup
        What stands above the contents.
    parts : iterable of (id, title, content)
        The chapters.
    foot : Markup
        What stands at the end.
    """
    chapters = list(parts)
    links = (tag("li", tag("a", name, href=f"#{key}")) for key, name, _ in chapters)
    return _PAGE.substitute(
        title=escaped(title),
        generator=escaped(generator),
        style=_STYLE,
        head=head,
        contents=tag("nav", tag("ol", *links), aria_label="Contents"),
        body=joined(*(section(key, name, content) for key, name, content in chapters)),
        foot=foot,
    )


# Nothing may be loaded: the policy makes a browser refuse what the page does not ask for anyway.
_PAGE = Template("""<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="generator" content="$generator">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; img-src data:; style-src 'unsafe-inline'">
<title>$title</title>
<link rel="icon" href="data:,">
<style>$style</style>
</head>
<body>
<header>
$head
</header>
$contents
<main>
$body</main>
<footer>
$foot
</footer>
</body>
</html>
""")

# Colours as in the figures: those of Okabe and Ito; each text stands out from its ground by 4.5 to 1 at least.
_STYLE = """
:root { color-scheme: light; --ink: #1b1f24; --soft: #57606a; --line: #d5dae0; --wash: #f5f7f9; --blue: #005a8e;
  --amber: #8a4a00; --amber-wash: #fff6e5; }
* { box-sizing: border-box; }
html { -webkit-text-size-adjust: 100%; text-size-adjust: 100%; }
body { margin: 0 auto; padding: 2.5rem 1.5rem 3rem; max-width: 60rem; background: #fff; color: var(--ink);
  font: 1rem/1.55 system-ui, -apple-system, "Segoe UI", Roboto, "Helvetica Neue", "DejaVu Sans", Arial, sans-serif; }
header { border-bottom: 3px solid var(--blue); padding-bottom: 1.1rem; }
.kicker { margin: 0; color: var(--blue); font-size: .8rem; font-weight: 600; letter-spacing: .06em;
  text-transform: uppercase; }
h1 { margin: .25rem 0 .4rem; font-size: 1.95rem; line-height: 1.2; overflow-wrap: anywhere; }
.lead { margin: 0; max-width: none; color: var(--soft); }
h2 { margin: 2.8rem 0 .8rem; padding-top: .3rem; font-size: 1.35rem; line-height: 1.25; }
h3 { margin: 1.8rem 0 .5rem; font-size: 1.05rem; }
p { margin: .6rem 0; max-width: 46rem; }
a { color: var(--blue); }
nav ol { display: flex; flex-wrap: wrap; gap: .2rem 1.4rem; margin: 1rem 0 0; padding: 0; list-style: none;
  font-size: .9rem; }
.cards { display: grid; grid-template-columns: repeat(auto-fit, minmax(10.5rem, 1fr)); gap: .8rem; margin: 1.2rem 0; }
.cards > div { padding: .7rem .9rem .6rem; border: 1px solid var(--line); border-top: 3px solid var(--blue);
  border-radius: 3px; background: var(--wash); }
.cards dt { color: var(--soft); font-size: .82rem; }
.cards dd { margin: 0; font-size: 1.5rem; font-weight: 600; line-height: 1.3; }
.cards dd.note { color: var(--soft); font-size: .8rem; font-weight: 400; }
.facts { margin: .8rem 0; max-width: 46rem; font-size: .92rem; }
.facts > div { display: grid; grid-template-columns: 14rem 1fr; gap: 0 1rem; padding: .3rem 0;
  border-bottom: 1px solid var(--line); }
.facts dt { color: var(--soft); }
.facts dd { margin: 0; overflow-wrap: anywhere; }
.warnings { margin: 1.2rem 0; padding: .8rem 1.1rem; border: 1px solid #e0b56b; border-left: 5px solid #d9820f;
  border-radius: 3px; background: var(--amber-wash); }
.warnings h2 { margin: 0 0 .3rem; padding: 0; color: var(--amber); font-size: 1.05rem; }
.warnings ul { margin: 0; padding-left: 1.2rem; overflow-wrap: anywhere; }
.warnings.fine h2 { margin: 0; color: #1f5f3a; }
.fine { border-color: #9cc5a9; border-left-color: #2e7d4f; background: #f1f9f4; }
sub, sup { line-height: 0; }
figure { margin: 1.2rem 0; }
figure img { display: block; width: 40rem; max-width: 100%; height: auto; max-height: 38rem; margin: 0 auto;
  object-fit: contain; }
figcaption { margin: .5rem auto 0; max-width: 42rem; color: var(--soft); font-size: .88rem; }
.scroll { margin: 1rem 0; overflow-x: auto; }
.scroll:focus-visible, summary:focus-visible { outline: 2px solid var(--blue); outline-offset: 2px; }
table { min-width: 24rem; border-collapse: collapse; font-size: .84rem; line-height: 1.35;
  font-variant-numeric: tabular-nums; }
caption { padding: 0 0 .45rem; color: var(--soft); font-size: .88rem; text-align: left; }
th, td { padding: .26rem .7rem .26rem 0; border-bottom: 1px solid var(--line); vertical-align: top; }
thead th { border-bottom: 2px solid var(--ink); font-weight: 600; vertical-align: bottom; }
tbody th { font-weight: 400; text-align: left; }
th.num, td.num { padding-left: .5rem; text-align: right; white-space: nowrap; }
th.num { white-space: normal; }
.text { text-align: left; }
td.text { padding-left: .3rem; }
tbody tr:hover { background: var(--wash); }
tr.strong > * { font-weight: 600; }
details { margin: .8rem 0; padding: .1rem 0 .1rem .9rem; border-left: 3px solid var(--line); }
summary { padding: .3rem 0; color: var(--blue); cursor: pointer; font-weight: 600; }
pre { margin: .8rem 0; padding: .9rem 1rem; border: 1px solid var(--line); border-radius: 3px; background: var(--wash);
  font: .8rem/1.5 ui-monospace, "SF Mono", Menlo, Consolas, "DejaVu Sans Mono", monospace; white-space: pre-wrap;
  overflow-wrap: anywhere; }
footer { margin-top: 3rem; padding-top: .8rem; border-top: 1px solid var(--line); color: var(--soft);
  font-size: .82rem; }
@media (max-width: 40rem) {
  body { padding: 1.2rem 1rem 2rem; }
  h1 { font-size: 1.5rem; }
  .cards { grid-template-columns: repeat(auto-fit, minmax(8.5rem, 1fr)); }
  .facts > div { grid-template-columns: 1fr; }
}
@page { size: A4; margin: 16mm 15mm 18mm; }
@media print {
  html { font-size: 9.5pt; }
  body { max-width: none; padding: 0; }
  nav { display: none; }
  h1 { font-size: 20pt; } h2 { margin-top: 1.6rem; break-after: avoid; } h3 { break-after: avoid; }
  a { color: inherit; text-decoration: none; }
  .scroll { overflow: visible; }
  table { font-size: 7.5pt; } th, td { padding-right: .4rem; } th.num, td.num { padding-left: .2rem; }
  thead { display: table-header-group; }
  tr, figure, .cards, .cards > div, .warnings, .facts > div { break-inside: avoid; }
  figure img { max-height: 90mm; }
  .cards > div, .warnings, pre { -webkit-print-color-adjust: exact; print-color-adjust: exact; }
}
"""
