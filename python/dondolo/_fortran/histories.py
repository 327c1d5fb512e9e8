"""Settings of the integration, and what is odd about histories."""

from __future__ import annotations

from collections.abc import Iterable
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from dondolo._base.arguments import FloatArray, as_flag, as_number
from dondolo._fortran import _core
from dondolo._fortran.handles import Handle
from dondolo._fortran.library import as_text, check, constants, receive, text_lines, unpack_warnings
from dondolo.errors import DondoloWarning


class Settings(NamedTuple):
    """Numbers of the solver, under the names of the arguments of Fortran (as_solver)."""

    rtol: float
    atol: float
    edp_limit: float
    estimate_error: bool
    collapses_only: bool


def settings(
    rtol: float | None,
    atol: float | None,
    edp_limit: float | None,
    estimate_error: bool = False,
    collapses_only: bool = False,
) -> Settings:
    """Settings with Fortran's own defaults where there is None."""
    default = constants()
    return Settings(
        rtol=default.rtol if rtol is None else as_number("rtol", rtol),
        atol=default.atol if atol is None else as_number("atol", atol),
        edp_limit=default.edp_limit if edp_limit is None else as_number("edp_limit", edp_limit),
        estimate_error=as_flag("estimate_error", estimate_error),
        collapses_only=bool(collapses_only),
    )


def check_settings(engine: str, given: Settings) -> None:
    """Refuse settings that the executable would refuse of any wall."""
    check(_core.histories.check_settings(as_text("engine", engine), given.rtol, given.atol, given.edp_limit))


def is_doubtful(edp: FloatArray, edp_error: FloatArray, edp_limit: float) -> NDArray[np.bool_]:
    """Whether estimated errors leave a doubt about EDPs, or about collapses."""
    doubt, failure = _core.histories.is_doubtful(edp.ravel(), edp_error.ravel(), edp_limit)
    check(failure)
    return np.asarray(doubt == 1).reshape(edp.shape)


def warnings_of_motion(wall: Handle, record: tuple[int, int], scale: float, moves: bool) -> list[DondoloWarning]:
    """What the executable would warn of, of a wall and a record times a factor, before it runs one motion.

    The record is the handle of a suite and the number in it from 1. A wall that moves at the start may rock freely.
    """
    return unpack_warnings(receive(_core.histories.warn_of_motion(wall.number, *record, scale, int(moves))).lines)


def warnings_of_levels(im: str, levels: FloatArray) -> list[DondoloWarning]:
    """What the executable would warn of, of levels of a measure."""
    return unpack_warnings(receive(_core.histories.warn_of_levels(im.encode(), levels)).lines)


def warnings_of_scales(levels: FloatArray, scale: FloatArray, names: Iterable[str]) -> list[DondoloWarning]:
    """What the executable would warn of, of factors (levels, histories) on records, NaN where one does not run."""
    factors = np.nan_to_num(scale, nan=0.0)
    return unpack_warnings(receive(_core.histories.warn_of_scales(levels, factors.T, text_lines(names))).lines)


def warnings_of_errors(
    edp: FloatArray, edp_error: FloatArray, edp_limit: float, record: str = "", level: float = 0.0
) -> list[DondoloWarning]:
    """What the executable would warn of, of estimated errors; record and level are those of the largest.

    Without a record it is one history.
    """
    parcel = receive(_core.histories.warn_of_errors(edp.ravel(), edp_error.ravel(), edp_limit, record.encode(), level))
    return unpack_warnings(parcel.lines)
