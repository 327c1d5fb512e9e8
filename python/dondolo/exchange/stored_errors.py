"""Standard errors that stand in result files of a population: which record brings which wall down does not."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from dondolo._base.arguments import one_of
from dondolo._fortran.library import constants
from dondolo._storage.columns import Columns
from dondolo.curves.clusters import Errors, no_errors
from dondolo.curves.table import ERRORS
from dondolo.populations.errors import KeptErrors
from dondolo.populations.rows import has_curve_of_row
from dondolo.populations.typology import Typology


def kept_errors(typology: Typology, curves: Columns, groups: Columns | None, unions: Columns | None) -> KeptErrors:
    """Standard errors of all curves of a typology in all its damage states: rows, groups, walls that are no row.

    Parameters
    ----------
    typology : Typology
        Without them.
    curves, groups, unions : Columns
        ``_fragility.csv``, of each row all states; ``_typology.csv``, of each state all curves, of these all levels,
        None for designs; ``_unions.csv``, as `kept_unions` reads it, None if there is none.

    Returns
    -------
    KeptErrors

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
    return KeptErrors.of([[*own, *others, *more] for own, others, more in of_states])


def _of_walls(typology: Typology, rows: Sequence[Errors], unions: Columns | None, state: int) -> list[Errors]:
    """Standard errors of the walls that have not the curve of a row, in a damage state."""
    people, found, place = typology.population, [], 0
    first, states = people.first_rows.tolist(), len(typology.edp_thresholds)
    numbers = np.diff(first, append=len(people)).tolist()
    for row, number, is_row in zip(first, numbers, has_curve_of_row(people).tolist(), strict=True):
        if is_row:
            continue
        if number == 1:
            # One mechanism that may not occur has the curve of its row, and a saturation.
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
        return no_errors("", 0)
    try:
        one_of(prefix + "errors", kind, constants().errors[1:])
    except ValueError as error:
        raise ValueError(f"{table.place(row)}: {error}") from error
    clusters = table.count(prefix + "clusters", row)
    if kind != "clustered":
        return no_errors(kind, clusters)
    of_theta, of_beta, both, degrees = _numbers(table, row, [prefix + name for name in (*ERRORS[:3], ERRORS[-1])])
    return Errors(np.array([[of_theta**2, both], [both, of_beta**2]]), kind, clusters, degrees)


def _numbers(table: Columns, row: int, names: Sequence[str]) -> list[float]:
    """Standard errors, covariance and degrees of freedom."""
    values = [table.number(name, row) for name in names]
    of_theta, of_beta, both, degrees = values
    for name, value, is_allowed in zip(
        names,
        values,
        (
            0.0 <= of_theta < 1e100,
            0.0 <= of_beta < 1e100,
            abs(both) <= of_theta * of_beta * (1.0 + 1e-9),
            degrees > 0.0,
        ),
        strict=True,
    ):
        if not is_allowed:
            raise ValueError(f"{table.place(row)}: {name} = {value:g}: is not possible")
    return values
