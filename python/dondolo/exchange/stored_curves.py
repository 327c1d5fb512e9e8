"""Curves of a population as they stand in result files: standard errors and unions, which counts do not tell."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from dondolo._base.arguments import one_of
from dondolo._fortran.curves import fit_curves
from dondolo._fortran.library import constants
from dondolo._storage.columns import Columns
from dondolo.curves.clusters import Errors, errors_of_table, no_errors
from dondolo.curves.fitting import curve_of, with_errors
from dondolo.curves.fragility import Fragility
from dondolo.curves.occurrence import saturations
from dondolo.populations.curve import Group
from dondolo.populations.stored_curves import StoredCurves
from dondolo.populations.typology import Typology
from dondolo.populations.unions import grouped, mean_curve

# Numbers that standard errors are made of
_ERRORS = ("se_ln_theta", "se_beta", "cov_ln_theta_beta", "degrees_of_freedom")


def stored_curves(typology: Typology, curves: Columns, groups: Columns | None, unions: Columns | None) -> StoredCurves:
    """What is known of all curves of a typology in all its damage states.

    Parameters
    ----------
    typology : Typology
        Without them.
    curves, groups, unions : Columns
        ``_fragility.csv``, of each row all states; ``_typology.csv``, of each state all curves, of these all levels,
        None for designs; ``_unions.csv``, of each facade or wall with several mechanisms, and then of each mean, all
        states, of these all levels, None if there is none.

    Returns
    -------
    StoredCurves

    Raises
    ------
    InputError
        The tables do not fit the walls, or no standard errors stand there.
    """
    states, levels = len(typology.edp_thresholds), len(typology.levels)
    rows, several = len(typology.curves), len(typology.groups)
    with curves.reading():
        _check_rows(curves, rows * states, "one for each wall and damage state")
        of_rows = [[errors_of_row(curves, row * states + k) for row in range(rows)] for k in range(states)]
    of_groups: list[list[Errors]] = [[] for _ in range(states)]
    if groups is not None:
        with groups.reading():
            _check_rows(groups, several * states * levels, "one for each curve, damage state and level")
            of_groups = [
                [errors_of_row(groups, (k * several + i) * levels) for i in range(several)] for k in range(states)
            ]
    of_walls = [_of_walls(typology, own, unions, k) for k, own in enumerate(of_rows)]
    of_states = zip(of_rows, of_groups, of_walls, strict=True)
    found = StoredCurves.of([[*own, *others, *more] for own, others, more in of_states])
    if unions is not None:
        return _with_unions(found, typology, unions)
    if len(typology.combined) < len(typology.walls):
        return found
    # No wall has several mechanisms.
    return replace(found, unions=({},) * states, group_unions=({},) * states, counts=({},) * states)


def _with_unions(stored: StoredCurves, typology: Typology, table: Columns) -> StoredCurves:
    """With the curve of each facade or wall with several mechanisms, and of each mean over walls, in each state."""
    names = [name for name, rows in Counter(typology.population.wholes).items() if rows > 1]
    groups = grouped(typology)
    states, levels = len(typology.edp_thresholds), len(typology.levels)
    with table.reading():
        found = table.texts("wall")
        if [name for name in dict.fromkeys(found) if name] != names or len(found) % (states * levels):
            raise ValueError("wall: must be those of several mechanisms, in the order of the population")
        means = table.texts("group")[len(names) * states * levels :: states * levels]
        if means != [one.group for one in groups]:
            raise ValueError("group: must be those of walls with several mechanisms, in the order of the population")

        def place(number: int, state: int) -> int:
            return (number * states + state) * levels

        unions, group_unions, counts = [], [], []
        for k in range(states):
            walls = [(name, place(i, k)) for i, name in enumerate(names)]
            of_groups = [(one, place(len(names) + i, k)) for i, one in enumerate(groups)]
            unions.append(_unions(typology, table, walls))
            group_unions.append({one.group: _mean(typology, table, one, first) for one, first in of_groups})
            counts.append(
                {f"wall {name}": table.numbers("collapses", first, levels) for name, first in walls}
                | {f"group {one.group}": table.numbers("fraction", first, levels) for one, first in of_groups}
            )
    return replace(stored, unions=tuple(unions), group_unions=tuple(group_unions), counts=tuple(counts))


def _mean(typology: Typology, table: Columns, group: Group, first: int) -> Fragility:
    """A mean over walls, fitted again."""
    fraction = table.numbers("fraction", first, len(typology.levels))
    curve = replace(mean_curve(typology, group, fraction), edp_threshold=table.number("edp_threshold", first))
    return with_errors(curve, errors_of_row(table, first)) if curve.has_fit else curve


def _unions(typology: Typology, table: Columns, walls: Sequence[tuple[str, int]]) -> dict[str, Fragility]:
    """Curves of walls whose rows begin at some places, fitted again."""
    people, levels = typology.population, len(typology.levels)
    whole = saturations(people.p_occ, people.alternative_numbers, people.first_rows).tolist()
    ends = dict(zip((people.wholes[i] for i in people.first_rows.tolist()), whole, strict=True))
    histories = np.array([table.numbers("histories", first, levels) for _, first in walls])
    collapses = np.array([table.numbers("collapses", first, levels) for _, first in walls])
    share = np.array([ends[name] or 1.0 for name, _ in walls])
    reached = np.minimum(collapses / share[:, None], histories)
    curves = {}
    for i, ((name, first), data) in enumerate(zip(walls, fit_curves(typology.levels, reached, histories), strict=True)):
        edp = table.number("edp_threshold", first)
        origin = {"im": typology.im, "edp_threshold": edp, "upper_asymptote": ends[name]}
        curve = curve_of(data, typology.levels, reached[i], histories[i], **origin)
        curves[name] = with_errors(curve, errors_of_row(table, first)) if curve.has_fit else curve
    return curves


def _of_walls(typology: Typology, rows: Sequence[Errors], unions: Columns | None, state: int) -> list[Errors]:
    """Standard errors of the walls that have not the curve of a row, in a damage state."""
    people, found, place = typology.population, [], 0
    first, states = people.first_rows.tolist(), len(typology.edp_thresholds)
    numbers = np.diff(first, append=len(people)).tolist()
    for row, number, is_row in zip(first, numbers, people._has_curve_of_row.tolist(), strict=True):
        if is_row:
            continue
        if number == 1:
            # One mechanism that may not occur has the curve of its row, and an upper asymptote.
            found.append(rows[row])
        elif unions is None or "independent_errors" not in unions:
            found.append(no_errors("given", 0))
        else:
            with unions.reading():
                found.append(errors_of_row(unions, (place * states + state) * len(typology.levels), "independent_"))
        place += number > 1
    return found


def _check_rows(table: Columns, number: int, what: str) -> None:
    if len(table) != number:
        raise ValueError(f"{len(table)} rows: must be {number}, {what}")


def errors_of_row(table: Columns, row: int, prefix: str = "") -> Errors:
    """The standard errors of a row, in columns whose names begin with a prefix; a curve without a fit has none."""
    kind = table.texts(prefix + "errors")[row]
    if not kind:
        return no_errors("given", 0)
    if kind not in constants().errors[1:]:
        try:
            one_of(prefix + "errors", kind, constants().errors[1:])
        except ValueError as error:
            raise ValueError(f"{table.place(row)}: {error}") from error
    clusters = table.count(prefix + "clusters", row)
    if kind != "clustered":
        return no_errors(kind, clusters)
    of_theta, of_beta, both, degrees = _numbers(table, row, [prefix + name for name in _ERRORS])
    return errors_of_table(of_theta, of_beta, both, clusters, degrees)


def _numbers(table: Columns, row: int, names: Sequence[str]) -> list[float]:
    """Standard errors, covariance and degrees of freedom."""
    values = [table.number(name, row) for name in names]
    of_theta, of_beta, both, degrees = values
    allowed = (
        0.0 <= of_theta < 1e100,
        0.0 <= of_beta < 1e100,
        abs(both) <= of_theta * of_beta * (1.0 + 1e-9),
        degrees > 0.0,
    )
    if not all(allowed):
        wrong = allowed.index(False)
        raise ValueError(f"{table.place(row)}: {names[wrong]} = {values[wrong]:g}: is not possible")
    return values
