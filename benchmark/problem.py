"""The problem that all programs solve: histories of one wall under a set of accelerograms, as a file for the peers."""

import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path

import numpy as np

import dondolo as dd

ROOT = Path(__file__).resolve().parents[1]

# The histories, their reference and the count of errors are those of docs/verification; modules of this folder have
# priority, and both before installed packages of the same name.
sys.path.insert(1, str(ROOT / "docs" / "verification"))

from cases import TABLES, Motions, motions, read_table, write_case  # noqa: E402
from histories import Errors, Histories  # noqa: E402

SINGLE_BLOCKS = ("one_sided", "free_standing")  # walls that the peers support


@dataclass(frozen=True)
class Problem:
    """The histories of a wall under a set of accelerograms, level by level as in test/reference."""

    wall: str
    motions: Motions
    name: str  # name of the set of accelerograms
    exact: Histories

    def __len__(self):
        return len(self.exact)

    @property
    def stride(self):
        """Stride that selects 55 histories."""
        return len(self) // 55

    def part(self, every):
        """Every n-th of the exact histories."""
        exact = self.exact
        return Histories(
            exact.record[::every], exact.level[::every], exact.edp[::every], exact.collapsed[::every], None
        )

    def errors(self, every, edp, collapsed):
        """Errors of the results of a peer relative to the reference."""
        exact = self.part(every)
        return Errors(Histories(exact.record, exact.level, edp, collapsed, None), exact)

    def write(self, path):
        """Write the file, float64 throughout.

        It contains the wall, the numbers of records and histories, time step and number of samples of each record,
        all samples [m/s2], and record (from 0) and scale of each history.
        """
        case = self.case()
        wall, records = case.population[0], case.records
        largest = np.array([np.abs(record.acceleration).max() for record in records])
        scales = case.levels[:, None] * wall.gravity / largest
        numbers = [
            [wall.capacity_angle, wall.frequency_parameter**2, wall.gravity, wall.restitution_coefficient],
            [wall.two_sided, len(records), scales.size],
            *([record.dt, len(record.acceleration)] for record in records),
            *(record.acceleration for record in records),
            np.column_stack([np.tile(np.arange(len(records)), len(case.levels)), scales.ravel()]).ravel(),
        ]
        np.concatenate([np.asarray(part, dtype=np.float64) for part in numbers]).tofile(path)

    def case(self):
        """The case of all histories, read by dondolo."""
        with tempfile.TemporaryDirectory() as folder:
            return dd.read_case(write_case(folder, self.wall, self.motions, 1e-8))


def problem(wall, records):
    """Histories of a wall under the recorded accelerograms if available, else under the synthetic ones."""
    name, chosen = next(iter(motions(records).items()))
    return Problem(wall, chosen, name, Histories.of(read_table(Path(TABLES) / f"{wall}_{name}.csv")))
