"""Walls of tests whose parts are written in the words of cases and tables."""

from dondolo.walls.parts import KINDS, PLACES, parts_from


def with_parts(**words):
    """The arguments of a wall: what tables have as lists as parts."""
    lists = {name: words.pop(name) for name in PLACES if name in words}
    several = {name: [value] if isinstance(value, (float, int, str)) else value for name, value in lists.items()}
    found = parts_from({name: lists[name] if name.startswith("interlock") else several[name] for name in lists})
    return words | {of: parts for of, parts in found.items() if of in KINDS and parts}
