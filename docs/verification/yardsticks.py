"""Python's side of the independent program on walls between two supports, docs/verification/supports.

The program shares no code, number or method with dondolo: a mode of a building and a diaphragm are power series within
each sample interval, the two blocks of a strip move by their Lagrangian with both ends prescribed, a facade rocks on
either edge of its base before a surface that it cannot enter, with a tie anchored to the building; the pair of Cash and
Karp follows them with local errors below 1e-12 of the capacity, and Newton steps on its own steps find the events.
"""

import subprocess
import tempfile
from dataclasses import asdict, dataclass
from pathlib import Path

import numpy as np

G = 9.81
SOURCES = [
    Path(__file__).parent / "supports" / f"{name}.f90"
    for name in ("support_motion", "rocking_wall", "strip", "facade", "stepper", "two_supports")
]
TOLERANCE = 1e-12  # local errors of rotations over the capacity, and of their speeds over the capacity each second
AFTER = 8.0  # free vibration of the building behind each record, s


@dataclass(frozen=True)
class House:
    """One mode, its participation at base and top, and a diaphragm in series with the top (period in s; 0: none)."""

    period: float
    base: float
    top: float
    damping: float = 0.05
    diaphragm: float = 0.0
    diaphragm_damping: float = 0.05
    share: float = 1.3  # participation of the diaphragm


@dataclass(frozen=True)
class Strip:
    """Two blocks between two supports."""

    height: float
    thickness: float
    hinge: float
    ratio: float = 0.0  # of speeds at impacts; 0: by the balance of angular momentum, times `factor`
    factor: float = 1.0
    load: float = 0.0  # N/m
    lifted: float = 0.0  # part of the load whose mass moves
    eccentricity: float = 0.0
    depth: float = 0.0  # of the hinges behind the faces
    density: float = 1800.0

    kind = "strip"
    ways = (1.0,)  # it has no front


@dataclass(frozen=True)
class Tie:
    """An elastic, perfectly plastic tie that cannot push; the building holds its other end."""

    height: float
    stiffness: float  # N/m, for each m of wall
    preload: float  # N
    strength: float  # N
    longest: float  # elongation at which it breaks, m


@dataclass(frozen=True)
class Facade:
    """A block on either edge of its base, before a surface that turns with the building."""

    height: float
    thickness: float
    span: float  # height over which the building turns, m
    tie: Tie | None = None
    density: float = 1800.0

    kind = "facade"
    ways = (1.0, -1.0)


@dataclass
class Found:
    """Results of the program: of each history, but for limit and drift."""

    limit: float  # rotation at which the wall collapses
    drift: np.ndarray  # largest drift of each record's supports, over the limit
    peak: np.ndarray  # of the rotation, over the limit; 1 for collapse
    start: np.ndarray  # s, -1 for none
    turn: np.ndarray  # time of the peak, s
    given_up: int


def written(value):
    """Value of a namelist."""
    if isinstance(value, bool):
        return ".true." if value else ".false."
    return f"'{value}'" if isinstance(value, str) else repr(value)


class Program:
    """The compiled program, in a folder that it keeps to itself."""

    def __init__(self):
        self.folder = tempfile.TemporaryDirectory(prefix="two_supports")
        self.file = Path(self.folder.name) / "two_supports"
        options = ["-O3", "-flto", "-fimplicit-none", "-J", self.folder.name]
        subprocess.run(["gfortran", *options, *map(str, SOURCES), "-o", str(self.file)], check=True)

    def call(self, wall, house, ground, dt, histories=()):
        """Numbers that it writes; `house` is None for supports whose accelerations are given."""
        case = {"kind": "motion", "h": float(dt), "after": AFTER, "tolerance": TOLERANCE, "given": house is None}
        case |= {"records": len(ground), "samples": ground.shape[1]}
        if house is not None:
            case |= asdict(house)
        if wall is not None:
            case |= asdict(wall) | {"kind": wall.kind}
            tie = case.pop("tie", None)
            case |= {f"tie_{name}": value for name, value in (tie or {}).items()}
        with tempfile.TemporaryDirectory(dir=self.folder.name) as name:
            folder = Path(name)
            text = ", ".join(f"{name} = {written(value)}" for name, value in case.items())
            (folder / "case.nml").write_text(f"&case {text} /\n", encoding="ascii")
            np.ascontiguousarray(ground, float).tofile(folder / "ground.bin")
            np.ascontiguousarray(histories, float).tofile(folder / "scales.bin")
            subprocess.run([self.file, folder], check=True)
            return np.fromfile(folder / "results.bin")

    def follow(self, wall, house, ground, dt, which, scale):
        """Histories: `scale` times the motion of the record `which`, counted from 0; `ground` is (records, samples)."""
        numbers = self.call(wall, house, ground, dt, np.stack([np.asarray(which) + 1.0, scale], axis=1))
        motions = 1 if house is None else len(ground)
        peak, start, turn, given_up = numbers[1 + motions :].reshape(-1, 4).T
        return Found(numbers[0], numbers[1 : 1 + motions], peak, start, turn, int(given_up.sum()))

    def motions(self, house, ground, dt):
        """Motions of the supports, (records, samples, channels).

        Channels are the acceleration of the base, the displacement of the top relative to it, and its two derivatives.
        """
        return self.call(None, house, ground, dt).reshape(len(ground), -1, 4)
