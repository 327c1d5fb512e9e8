"""Two runs side by side: what differs in settings, inputs and tables, and which change explains it."""

from __future__ import annotations

import math
import os
from collections import Counter
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Any

from dondolo._fortran.files import RUN_FILE
from dondolo._fortran.walls import WALL_PROPERTIES
from dondolo._storage.run_file import RunFile, read_run_file
from dondolo.errors import InputError
from dondolo.exchange.changelog import changes_between
from dondolo.exchange.result_file import ResultFile

# Columns that name a row, in any table
_KEYS = (
    *("wall", "facade", "group", "mechanism", "design", "tie", "record", "polarity", "im", "im_level", "edp_threshold"),
    *("limit_state", "item", "quantity", "symbol", "source", "time_s"),
)
# Most rows of a table that are listed one by one
_LISTED = 12

Rows = dict[tuple[str, ...], dict[str, str]]


def differences(old: str | os.PathLike[str], new: str | os.PathLike[str]) -> Iterator[str]:
    """Lines on what differs between two runs, or between the runs of the same names in two folders.

    Parameters
    ----------
    old, new : path
        A prefix of result files, the file ``PREFIX_run.json``, or a folder.

    Raises
    ------
    InputError
        There is no run, or no name of one in both folders; a file that is no result.
    """
    before, after = _runs(old), _runs(new)
    if len(before) == len(after) == 1:
        pairs = [(*before.values(), *after.values())]
    else:
        pairs = [(before[name], after[name]) for name in before if name in after]
        for name in sorted(before.keys() ^ after.keys()):
            yield f"{name}: only in {os.fspath(old) if name in before else os.fspath(new)}"
    if not pairs:
        raise InputError(f"{os.fspath(old)}, {os.fspath(new)}: no run has the same name in both")
    for one, other in pairs:
        yield from _of_pair(one, other)


def _runs(path: str | os.PathLike[str]) -> dict[str, str]:
    """Prefixes of runs by their names."""
    given = os.fspath(path)
    if Path(given).is_dir():
        found = {file.name.removesuffix(RUN_FILE): str(file) for file in sorted(Path(given).glob(f"*{RUN_FILE}"))}
        if not found:
            raise InputError(f"{given}: has no file *{RUN_FILE}: must be a folder of results, or the prefix of a run")
        return {name: file.removesuffix(RUN_FILE) for name, file in found.items()}
    prefix = given.removesuffix(RUN_FILE)
    return {Path(prefix).name: prefix}


def _of_pair(one: str, other: str) -> Iterator[str]:
    old, new = read_run_file(one + RUN_FILE), read_run_file(other + RUN_FILE)
    yield f"{one} by {_build(old)}, {other} by {_build(new)}"
    given = [*_of_settings(old, new), *_of_inputs(old, new)]
    yield from given
    is_other = bool(given)
    names: set[str] = set()
    found = []
    tables = dict.fromkeys(file.name for run in (old, new) for file in run.files)
    for name in tables:
        sides = [{file.name: file for file in run.files}.get(name) for run in (old, new)]
        label = name.removeprefix("_").removesuffix(".csv")
        if sides[0] is None or sides[1] is None:
            found.append(f"  {label}: only in the {'new' if sides[0] is None else 'old'} run")
            continue
        files = [ResultFile(prefix + name, run) for prefix, run in ((one, old), (other, new))]
        if name == "_walls.csv":
            names |= {_variable(column) for column in files[1] if any(files[1].texts(column))}
            names |= set(files[1].texts("mechanism"))
            is_other |= any(
                row.column in files[0]
                and row.column in files[1]
                and files[0].texts(row.column) != files[1].texts(row.column)
                for row in WALL_PROPERTIES
            )
        found += [f"  {label}: {line}" for line in _of_tables(*files)]
    if not found:
        yield "  the tables have the same numbers"
        return
    yield from found
    names |= set(new.settings) | set(old.settings)
    yield from _explained(old, new, names, is_other)


def _build(run: RunFile) -> str:
    """Version and commit that wrote a run."""
    return f"dondolo {run.version} ({run.commit})"


def _variable(column: str) -> str:
    """A variable of a wall by its column: without unit and number, as far as names in sentences need."""
    head, _, rest = column.partition("_")
    return f"{head.rstrip('0123456789')}_{rest}" if rest else head


def _of_settings(old: RunFile, new: RunFile) -> Iterator[str]:
    for group in dict.fromkeys((*old.settings, *new.settings)):
        before, after = old.settings.get(group, {}), new.settings.get(group, {})
        for name in dict.fromkeys((*before, *after)):
            if group == "job" and name in ("output", "threads", "title"):
                continue
            if before.get(name) != after.get(name):
                yield f"  setting {name} of &{group}: {_shown(before.get(name))} -> {_shown(after.get(name))}"


def _of_inputs(old: RunFile, new: RunFile) -> Iterator[str]:
    """Records and files that are not the same."""
    before, after = ({one["name"]: one["checksum"] for one in run.records} for run in (old, new))
    for sentence, names in (
        ("only in the old run", [name for name in before if name not in after]),
        ("only in the new run", [name for name in after if name not in before]),
        ("with other samples", [name for name in before if after.get(name, before[name]) != before[name]]),
    ):
        if names:
            yield f"  records {sentence}: {len(names)}, such as {names[0]}"
    sums = [
        {(one["role"], Path(one["path"]).name): one["crc32"] for one in run.inputs if one["role"] != "record"}
        for run in (old, new)
    ]
    for role, name in sums[0]:
        key = role, name
        if role != "case" and key in sums[1] and sums[0][key] != sums[1][key]:
            yield f"  {role} {name}: another file"


def _of_tables(old: ResultFile, new: ResultFile) -> Iterator[str]:
    """Rows of the same names whose cells differ."""
    before, after = _rows(old), _rows(new)
    for sentence, columns in (
        ("columns only in the old run", [name for name in old if name not in new]),
        ("columns only in the new run", [name for name in new if name not in old]),
    ):
        if columns:
            yield f"{sentence}: {', '.join(columns)}"
    for which, rows in (("old", before.keys() - after.keys()), ("new", after.keys() - before.keys())):
        if rows:
            example = next(key for key in (before if which == "old" else after) if key in rows)
            yield f"{len(rows)} rows only in the {which} run, such as {_label(example)}"
    common = [name for name in old if name in new and name not in _KEYS]
    changed = {
        key: {name: (row[name], after[key][name]) for name in common if row[name] != after[key][name]}
        for key, row in before.items()
        if key in after
    }
    changed = {key: cells for key, cells in changed.items() if cells}
    both = len(before.keys() & after.keys())
    if len(changed) <= _LISTED:
        for key, cells in changed.items():
            yield f"{_label(key)}: {', '.join(f'{name} {_change(*pair)}' for name, pair in cells.items())}"
        return
    yield f"{len(changed)} of {both} rows differ"
    for name in common:
        rows_of = {key: cells[name] for key, cells in changed.items() if name in cells}
        if rows_of:
            worst = max(rows_of, key=lambda key: _size(*rows_of[key]))
            yield f"{name} in {len(rows_of)} rows, most in {_label(worst)}: {_change(*rows_of[worst])}"


def _rows(table: ResultFile) -> Rows:
    """Rows by the cells that name them; those that have the same names are numbered."""
    keys = [name for name in _KEYS if name in table]
    columns = {name: table.texts(name) for name in table}
    rows: Rows = {}
    seen: Counter[tuple[str, ...]] = Counter()
    for i in range(len(table)):
        key = tuple(_plain(columns[name][i]) for name in keys)
        seen[key] += 1
        rows[(*key, "") if seen[key] == 1 else (*key, f"no. {seen[key]}")] = {
            name: columns[name][i] for name in columns
        }
    return rows


def _label(key: Iterable[str]) -> str:
    return " ".join(part for part in key if part) or "the row"


def _plain(cell: str) -> str:
    """A cell for people: a number with the digits that tell levels apart."""
    number = _number(cell)
    return cell if number is None or cell.isdigit() else f"{number:.6g}"


def _number(cell: str) -> float | None:
    try:
        return float(cell) if cell else None
    except ValueError:
        return None


def _size(old: str, new: str) -> float:
    """How much a cell changed; texts and what is missing come first."""
    before, after = _number(old), _number(new)
    return math.inf if before is None or after is None else abs(after - before)


def _change(old: str, new: str) -> str:
    before, after = _number(old), _number(new)
    if before is None or after is None:
        return f"{old or 'nothing'} -> {new or 'nothing'}"
    share = f" ({_share(after / before - 1.0)} %)" if before and old != new and not old.isdigit() else ""
    digits = next((n for n in (6, 9, 12) if f"{before:.{n}g}" != f"{after:.{n}g}"), 17)
    return f"{before:.{digits}g} -> {after:.{digits}g}{share}"


def _share(change: float) -> str:
    """A change over what was before [%]: with a power of ten only where that was next to nothing."""
    percent = 100.0 * change
    return f"{percent:+.0f}" if 10.0 <= abs(percent) < 1e6 else f"{percent:+.2g}"


def _shown(value: Any) -> str:
    if value is None:
        return "not given"
    if isinstance(value, list):
        words = " ".join(_shown(one) for one in value[:6])
        return words + (f" ... ({len(value)} values)" if len(value) > 6 else "")
    return f"{value:.6g}" if isinstance(value, float) else str(value)


def _explained(old: RunFile, new: RunFile, names: set[str], is_other: bool) -> Iterator[str]:
    """Which rows of "Results that change" may explain the differences."""
    if is_other:
        yield "Settings, inputs or walls differ, which may explain all of this."
    if (old.version, old.commit) == (new.version, new.commit):
        if not is_other:
            yield "Both were written by one build, with the settings, records and walls that the files name."
        return
    rows = changes_between(old.version, new.version)
    if not rows:
        yield f'No row of "Results that change" in CHANGELOG.md is between {old.version} and {new.version}.'
        return
    own = [row for row in rows if row.concerns(names)]
    span = new.version if old.version == new.version else f"{old.version} to {new.version}"
    yield f"Results that change (CHANGELOG.md, {span}): {len(own)} of {len(rows)} name what these runs have"
    for row in own:
        yield f"  {row.version}: {row.what}; {row.by_how_much}; {row.who}"
