"""Histories of one run or one table of test/reference, and the differences between the two."""

import warnings
from dataclasses import dataclass

import numpy as np

import dondolo as dd


@dataclass(frozen=True)
class Histories:
    """EDP and collapse of every history of a wall under a set of accelerograms."""

    record: list
    level: np.ndarray
    edp: np.ndarray
    collapsed: np.ndarray
    spread: np.ndarray | None  # estimated error of a run, or change of a reference with its tolerance

    @classmethod
    def of(cls, rows):
        """Histories from the rows of a table."""
        numbers = {name: np.array([float(row[name]) for row in rows]) for name in ("im_level", "edp")}
        spread = next((name for name in ("edp_error", "edp_change") if name in rows[0]), None)
        return cls(
            record=[row["record"] for row in rows],
            level=numbers["im_level"],
            edp=numbers["edp"],
            collapsed=np.array([row["collapsed"] == "1" for row in rows]),
            spread=np.array([abs(float(row[spread])) for row in rows]) if spread else None,
        )

    def __len__(self):
        return len(self.record)

    def collapses(self):
        """Levels, and collapses and histories at each."""
        levels = np.unique(np.round(self.level, 12))
        stripe = [np.isclose(self.level, level) for level in levels]
        return levels, [int(self.collapsed[here].sum()) for here in stripe], [int(here.sum()) for here in stripe]

    def fit(self):
        """Fragility curve."""
        with warnings.catch_warnings():
            # The page itself reports extrapolated curves.
            warnings.simplefilter("ignore", dd.errors.DondoloWarning)
            return dd.fit_fragility(*self.collapses(), im="pga")


class Errors:
    """Errors of the histories of a run relative to the reference."""

    def __init__(self, run, exact):
        if run.record != exact.record or not np.allclose(run.level, exact.level):
            raise SystemExit("verification: a table of test/reference has different histories; run ./run reference")
        self.edp = np.abs(run.edp - exact.edp)
        self.wrong_flag = run.collapsed != exact.collapsed
        # The others have an EDP of 0, or the limit in both, without any error.
        self.moving = (exact.edp > 0.0) & ~(exact.collapsed & run.collapsed)

    def above(self, size):
        """Number of histories with a larger error."""
        return int((self.edp > size).sum())

    def worst(self):
        """Largest error."""
        return self.edp.max()

    def quantile(self, part):
        """Quantile of the errors of the histories that rock and do not collapse."""
        return np.quantile(self.edp[self.moving], part)

    def flags(self):
        """Number of wrong flags."""
        return int(self.wrong_flag.sum())
