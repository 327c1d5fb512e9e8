"""Cases as text: groups of variables in the notation of namelists."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from dondolo._fortran.library import Property, properties

#: Groups of a case: names and values of their variables
Settings = Mapping[str, Mapping[str, Any]]

# What follows from another variable, and is left out beside it: sums of decimals are not as short as these
_FOLLOWS = {
    "height": "section_height",
    "thickness": "section_thickness",
    "density": "mass",
    "restitution": "restitution_value",
}
# Longest line of a commented case
_WIDTH = 118


def case_text(settings: Settings, *, commented: bool = False, meanings: Mapping[str, str] | None = None) -> str:
    """Settings in the notation of a case file, each variable on a line; commented: with its unit and its meaning.

    `meanings` are those of another language, by name.
    """
    lines = []
    for group, variables in settings.items():
        # A list without values is one that was not given
        known = {name: value for name, value in variables.items() if not isinstance(value, (list, tuple)) or len(value)}
        given = {name: value for name, value in known.items() if _FOLLOWS.get(name) not in known}
        parts = [f"{name} = {_value(value)}" for name, value in given.items()]
        if not commented:
            lines += [f"&{group} {parts[0] if parts else ''}", *(f"   {part}" for part in parts[1:])]
            lines[-1] += " /"
            continue
        table = {row.name: row for row in properties(group)}
        margin = max(map(len, parts), default=0) + 3
        lines.append(f"&{group}")
        for name, part in zip(given, parts, strict=True):
            comment = _comment(table[name], meanings or {}) if name in table else ""
            line = f"   {part:{margin}}! {comment}" if comment else f"   {part}"
            # What does not fit is left out: a line is read as a whole
            lines.append(line if len(line) <= _WIDTH else f"   {part}   ! {table[name].unit}".rstrip(" !"))
        lines.append("/")
    return "\n".join(lines)


def _comment(row: Property, meanings: Mapping[str, str]) -> str:
    """Unit and meaning of a variable."""
    meaning = meanings.get(row.name, row.meaning)
    return f"{row.unit}: {meaning}" if row.unit else meaning


def _value(value: Any) -> str:
    """A value in the notation of namelists."""
    if isinstance(value, bool):
        return ".true." if value else ".false."
    if isinstance(value, str):
        return "'" + value.replace("'", "''") + "'"
    if isinstance(value, (list, tuple)):
        return ", ".join(map(_value, value))
    mantissa, _, power = repr(value).partition("e")
    return mantissa.removesuffix(".0") + (f"e{int(power)}" if power else "")
