"""Standard errors that stand in result files of a population: which record brings which wall down does not."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from dondolo._base.arguments import one_of
from dondolo._fortran.library import constants
from dondolo.curves.clusters import Errors, no_errors
from dondolo.curves.table import ERRORS
from dondolo.exchange.result_file import ResultFile
from dondolo.populations.errors import KeptErrors
from dondolo.populations.typology import Typology


def kept_errors(typology: Typology, curves: ResultFile, groups: ResultFile | None) -> KeptErrors:
    """Standard errors of all curves of a typology in all its damage states.

    Parameters
    ----------
    typology : Typology
        Without them.
    curves, groups : ResultFile
        ``_fragility.csv``, of each row all states; ``_typology.csv``, of each state all curves, of these all levels,
        None for designs.

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
    if groups is None:
        return KeptErrors.of(of_rows)
    with groups.reading():
        _check_rows(groups, several * states * levels, "one for each curve, damage state and level")
        of_groups = [[errors_of_row(groups, (k * several + i) * levels) for i in range(several)] for k in range(states)]
    return KeptErrors.of([[*own, *others] for own, others in zip(of_rows, of_groups, strict=True)])


def _check_rows(table: ResultFile, number: int, what: str) -> None:
    if len(table) != number:
        raise ValueError(f"{len(table)} rows: must be {number}, {what}")


def errors_of_row(table: ResultFile, row: int) -> Errors:
    """The standard errors of a row; a curve without a fit has none."""
    kind = table.texts("errors")[row]
    if not kind:
        return no_errors("", 0)
    try:
        one_of("errors", kind, constants().errors[1:])
    except ValueError as error:
        raise ValueError(f"{table.place(row)}: {error}") from error
    clusters = table.count("clusters", row)
    if kind != "clustered":
        return no_errors(kind, clusters)
    of_theta, of_beta, both, degrees = _numbers(table, row, (*ERRORS[:3], ERRORS[-1]))
    return Errors(np.array([[of_theta**2, both], [both, of_beta**2]]), kind, clusters, degrees)


def _numbers(table: ResultFile, row: int, names: Sequence[str]) -> list[float]:
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
