"""Counts of the work that an analysis did and skipped."""

from __future__ import annotations

import zlib
from collections.abc import Iterable
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from dondolo._base.wording import in_english, say
from dondolo._fortran.buildings import drift_note
from dondolo._fortran.library import constants
from dondolo._storage.saved import part_of_results


@part_of_results
class Work(NamedTuple):
    """Counts of the work done and skipped: only what a result needs is integrated.

    They do not depend on the number of threads. With estimated errors every history is run and counts three times;
    after Ctrl-C they are those of all that was computed.

    Attributes
    ----------
    histories : int
    still : int
        Histories that never move: no sample reaches the trigger, and nothing is integrated.
    intervals : int
        Sample intervals of the records of all histories.
    rocked : int
        Those of them in which the wall rocks; the others take no steps.
    steps : int
        Steps taken.
    evaluations : int
        Evaluations of the terms of the equation of motion.
    impacts : int
        Impacts that were located.
    drifted : int
        Histories in which the supports of a wall on a building drift apart by more than 0.2 of its capacity rotation:
        the motion that it feels is approximate there (docs/theory.md, section 1).

    Examples
    --------
    >>> import dondolo as dd
    >>> records = dd.synthetic_records(6.5, 10.0, "shallow", n_records=10)
    >>> stripes = dd.multiple_stripe(dd.OneSidedWall(1.5, 0.25), records, [0.6, 0.8], progress=False)
    >>> stripes.work.histories
    20
    """

    histories: int = 0
    still: int = 0
    intervals: int = 0
    rocked: int = 0
    steps: int = 0
    evaluations: int = 0
    impacts: int = 0
    drifted: int = 0

    @classmethod
    def total(cls, parts: Iterable[Work]) -> Work:
        """The sum of counts.

        Examples
        --------
        >>> import dondolo as dd
        >>> dd.results.Work.total([dd.results.Work(histories=2), dd.results.Work(histories=3)]).histories
        5
        """
        return cls(*map(sum, zip(cls(), *parts, strict=True)))

    @classmethod
    def _of_counts(cls, counts: NDArray[np.int64]) -> Work:
        """The counts that the library sends, under its names of them."""
        return cls(**dict(zip(constants().work, counts.tolist(), strict=True)))

    def _of_run(self, *contents: Any) -> dict[str, Work]:
        """The work of a run under a checksum of its contents, arrays and texts."""
        crc = 0
        for content in contents:
            crc = zlib.crc32(np.asarray(content).tobytes(), crc)
        return {f"{crc:08x}": self}

    def _notes(self) -> list[tuple[str, str]]:
        """What there is to say of supports that drift apart, as facts."""
        note = drift_note(self.drifted, self.histories)
        if note and not in_english():
            note = say(
                "supports drift apart in {drifted} of {histories} histories",
                drifted=self.drifted,
                histories=self.histories,
            )
        return [(say("note"), note)] if note else []

    def __str__(self) -> str:
        return (
            f"{self.still} of {self.histories} histories never move, the wall rocks in {self.rocked} of"
            f" {self.intervals} sample intervals; {self.steps} steps"
        )
