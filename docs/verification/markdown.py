"""Tables and numbers as Markdown."""

import math
import textwrap


def table(head, rows):
    """Lines of a table, followed by an empty one."""
    lines = ["| " + " | ".join(map(str, row)) + " |" for row in (head, *rows)]
    return [lines[0], "|---" * len(head) + "|", *lines[1:], ""]


def paragraph(text, indent=""):
    """Lines of a paragraph, followed by an empty one."""
    options = {"width": 118, "break_long_words": False, "break_on_hyphens": False}
    return [*textwrap.wrap(text, subsequent_indent=indent, **options), ""]


def bullets(points):
    """Lines of a list, followed by an empty one."""
    return [line for point in points for line in paragraph(f"- {point}", indent="  ")[:-1]] + [""]


def small(x):
    """Format a small number with two digits, as 1.3e-2; no error is 0."""
    if x == 0.0:
        return "0"
    digits, exponent = f"{x:.1e}".split("e")
    return f"{digits}e{int(exponent)}"


def power(x):
    """Format a power of ten, as 1e-8."""
    return f"1e{round(math.log10(x))}"


def percent(ratio):
    """Format a ratio as a percentage of change with a sign."""
    return f"{100.0 * (ratio - 1.0):+.0f} %"


def many(number, noun):
    """Format a number and its noun: 1 history, 2 histories."""
    plural = noun[:-1] + "ies" if noun.endswith("y") else noun + "s"
    return f"{number} {noun if number == 1 else plural}"
