"""Python's side of the independent program on joints that bend before they open, docs/verification/joints.

The program shares no code, number or method with dondolo: the strip is a Lagrangian of complex numbers, both branches
are followed by extrapolated midpoint steps where dondolo has a closed form and Runge-Kutta steps, and regula falsi on
whole steps finds the events.
"""

import os
import subprocess
import tempfile
from dataclasses import dataclass
from pathlib import Path

import numpy as np

import dondolo as dd

SOURCES = [Path(__file__).parent / "joints" / f"{name}.f90" for name in ("bent_strip", "extrapolation", "joints")]
AFTER = 2.0  # followed after each record, s


@dataclass(frozen=True)
class Strip:
    """A strip with the speed ratio of its impacts, its period and its damping before the joints open."""

    height: float
    thickness: float
    density: float
    hinge: float
    overburden: float
    overburden_inertia: float
    eccentricity: float
    restitution_value: float
    elastic_period: float
    elastic_damping: float = 0.05
    gravity: float = 9.81

    def wall(self):
        """The strip as a wall of dondolo."""
        given = vars(self) | {"overburden_inertia": self.overburden_inertia if self.overburden else None}
        return dd.TwoBlockWall(**given)


@dataclass
class Found:
    """Results: of each strip capacity, q_y, e_0, L_y/J_y and k; of each history the other five."""

    joints: np.ndarray
    peak: np.ndarray  # rad, with its sign
    time: np.ndarray  # s
    collapsed: np.ndarray
    openings: np.ndarray
    passages: np.ndarray


class Program:
    """The compiled program, in a folder that it keeps to itself."""

    def __init__(self):
        self.folder = tempfile.TemporaryDirectory(prefix="joints")
        self.file = Path(self.folder.name) / "joints"
        options = ["-O3", "-flto", "-fopenmp", "-fimplicit-none", "-J", self.folder.name]
        subprocess.run(["gfortran", *options, *map(str, SOURCES), "-o", str(self.file)], check=True)

    def follow(self, strips, records, histories, after=AFTER):
        """Follow histories, each a strip and a record, both by number, and a factor; records are "
        "(accelerations, step).
        """
        starts = np.cumsum([1, *(len(motion) for motion, _ in records)])
        rows = [
            [wall + 1, starts[record], len(records[record][0]), records[record][1], factor, after, 1.0]
            for wall, record, factor in histories
        ]
        with tempfile.TemporaryDirectory(dir=self.folder.name) as name:
            folder = Path(name)
            np.array([list(vars(strip).values()) for strip in strips], float).tofile(folder / "walls.bin")
            np.concatenate([motion for motion, _ in records]).astype(float).tofile(folder / "ground.bin")
            np.array(rows, float).tofile(folder / "histories.bin")
            subprocess.run([self.file, folder], check=True, env=os.environ | {"OMP_WAIT_POLICY": "passive"})
            joints = np.fromfile(folder / "joints.bin").reshape(-1, 5)
            peak, time, collapsed, openings, passages = np.fromfile(folder / "peaks.bin").reshape(-1, 5).T
        return Found(joints, peak, time, collapsed == 1.0, openings, passages)
