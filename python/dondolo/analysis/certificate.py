"""Certified stripes: histories that double precision may not decide, rerun in 33 digits."""

from __future__ import annotations

import dataclasses
import enum
import threading
from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from dondolo._base.arguments import FloatArray, argument_error, as_flag
from dondolo._base.interrupts import as_event, deferred
from dondolo._fortran import _core
from dondolo._fortran.handles import Handle
from dondolo._fortran.histories import is_doubtful, warnings_of_errors
from dondolo._fortran.library import Stoppable, check, warn
from dondolo.analysis.request import check_threads, progress_bar
from dondolo.errors import DondoloError, DondoloWarning, InputError, Interrupted
from dondolo.records.level_rows import records_at_levels
from dondolo.records.record import Record
from dondolo.records.suite import upload
from dondolo.walls.wall import upload as upload_walls

if TYPE_CHECKING:
    from dondolo.analysis.stripes import Stripes


# Codes of the warnings of estimated errors
_OF_ERRORS = ("ill_conditioned", "collapse_in_doubt")
# What a run in 33 digits replaces, in the order in which Fortran gives it
_REPLACED = ("edp", "collapsed", "impacts", "time_of_peak", "edp_error")
_BLOCK = 16


class Certified(enum.IntEnum):
    """How a history is certified."""

    #: Its estimated error leaves no doubt.
    DOUBLE = 1
    #: Two runs in 33 digits agree, and the last digit of the input changes nothing.
    QUADRUPLE = 2
    #: The last digit of the input decides what happens.
    NOT_COMPUTABLE = 3


def certify(
    stripes: Stripes,
    records: Record | Iterable[Record] | Mapping[float, Record | Iterable[Record]],
    *,
    threads: int = 0,
    progress: bool = True,
    stop: threading.Event | None = None,
) -> Stripes:
    """Stripes with certificates: see `Stripes.certify`."""
    if stripes.edp_error is None:
        raise argument_error(
            "not_together", "stripes", ": have no estimated errors: must be run with estimate_error = True"
        )
    team = check_threads(threads)
    as_flag("progress", progress)
    with deferred(as_event(stop)):
        return run_again(stripes, records_of(stripes, records), team, progress)


def run_again(stripes: Stripes, records: Sequence[Record], threads: int, progress: bool) -> Stripes:
    """The same of the records themselves, in the order of the stripes."""
    assert stripes.edp_error is not None
    ran = stripes.ran
    fields: dict[str, Any] = {name: getattr(stripes, name).copy() for name in _REPLACED}
    if stripes.status is None or stripes.edp_lowest is None or stripes.edp_highest is None:
        doubt = ran & is_doubtful(stripes.edp, stripes.edp_error, stripes.edp_limit)
        status = np.where(ran & ~doubt, np.int32(Certified.DOUBLE), np.int32(0)).astype(np.int32)
        lowest, highest = stripes.edp.copy(), stripes.edp.copy()
    else:
        doubt = ran & (stripes.status == 0)
        status, lowest, highest = stripes.status.copy(), stripes.edp_lowest.copy(), stripes.edp_highest.copy()
    rounded = np.full(ran.shape, np.nan) if stripes.edp_rounded is None else stripes.edp_rounded.copy()
    numbers = np.broadcast_to(stripes.record_index + 1, ran.shape).astype(np.int32)
    factors = stripes.scale * stripes.polarity
    # Kept until Fortran has returned
    wall, suite = upload_walls((stripes.wall,)), upload(tuple(records))
    places = np.argwhere(doubt)

    def so_far() -> Stripes:
        found = fields | {"status": status, "edp_lowest": lowest, "edp_highest": highest, "edp_rounded": rounded}
        for value in found.values():
            value.flags.writeable = False
        return warned(dataclasses.replace(stripes, **found), stripes.warnings)

    done = 0
    # A few at a time, so that Ctrl-C and the bar are heard
    with deferred() as interrupts, progress_bar(len(places), progress, "certificates", "history") as bar:
        try:
            if np.isnan(rounded[ran]).all():
                rounded[ran] = _within_rounding(stripes, (wall, suite), numbers[ran], factors[ran], threads)
            while done < len(places) and not interrupts.requested:
                here = slice(done, done + _BLOCK)
                rows = tuple(places[here].T)
                with Stoppable():
                    kind, *values, low, high, failure = _core.histories.certify(
                        wall.number,
                        suite.number,
                        numbers[rows],
                        factors[rows],
                        stripes.edp[rows],
                        stripes.edp_limit,
                        threads,
                    )
                check(failure)
                lowest[rows], highest[rows] = low, high
                for name, value in zip(_REPLACED, values, strict=True):
                    fields[name][rows] = value
                # Last: what has a status is whole.
                status[rows] = kind
                done += len(places[here])
                bar.update(len(places[here]))
            is_stopped = interrupts.requested
        except KeyboardInterrupt:
            # Of a handler of the user's
            is_stopped = True
        except DondoloError:
            # Fortran has broken the block off.
            is_stopped = interrupts.signalled
            if not is_stopped:
                raise
        if is_stopped:
            raise Interrupted(f"interrupted: {done} of {len(places)} histories in doubt are certified", so_far())
    return so_far()


def _within_rounding(
    stripes: Stripes, handles: tuple[Handle, Handle], numbers: Any, factors: FloatArray, threads: int
) -> FloatArray:
    """EDPs of histories of records, numbered from 1, moved within the rounding of their print; NaN: not known."""
    wall, suite = handles
    with Stoppable():
        edp, failure = _core.histories.run_rounded(
            wall.number,
            suite.number,
            numbers,
            factors,
            stripes.engine,
            threads,
            stripes.rtol,
            stripes.atol,
            stripes.edp_limit,
        )
    check(failure)
    return np.where(edp < 0.0, np.nan, edp)


def warned(stripes: Stripes, others: Iterable[DondoloWarning]) -> Stripes:
    """Stripes with these warnings, but of estimated errors with those of the errors that they have."""
    found = [one for one in others if one.code not in _OF_ERRORS]
    if stripes.edp_error is not None:
        level, history = np.unravel_index(np.nanargmax(stripes.edp_error), stripes.edp_error.shape)
        found += warnings_of_errors(
            stripes.edp[stripes.ran],
            stripes.edp_error[stripes.ran],
            stripes.edp_limit,
            stripes.record_names[history],
            float(stripes.levels[level]),
        )
    return dataclasses.replace(stripes, warnings=tuple(found))


def warn_of_errors(stripes: Stripes) -> None:
    """Warn of estimated errors, as the executable does after the run."""
    warn(one for one in stripes.warnings if one.code in _OF_ERRORS)


def records_of(stripes: Stripes, records: Any) -> list[Record]:
    """The records that stripes were run with, in their order."""
    found = {(record.name, record.checksum): record for record in records_at_levels(records, stripes.levels)[0]}
    several = []
    for key in zip(stripes.record_names[: stripes.n_records], stripes.checksums, strict=True):
        if key not in found:
            raise InputError(f"records: '{key[0]}' is missing, or differs from the one in the stripes")
        several.append(found[key])
    return several
