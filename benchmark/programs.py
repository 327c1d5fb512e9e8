"""The programs compared (dondolo's engines and the peers), their settings, and functions to run them."""

import csv
import re
import statistics
import subprocess
import sys
import tempfile
import time
from dataclasses import asdict, dataclass, fields, replace
from pathlib import Path

import numpy as np
from problem import write_case
from progress import say

import dondolo as dd

FOLDER = Path(__file__).resolve().parent
BUILD, ENVIRONMENT = FOLDER / "build", FOLDER / ".venv"
PYTHON = ENVIRONMENT / "bin" / "python"
PATIENCE = 150  # seconds for one setting of a peer: more than any needs on a quiet machine
LARGE = 1e-6  # EDPs with larger errors are counted


@dataclass(frozen=True)
class Peer:
    """A program other than dondolo.

    Its command is called with PROBLEM METHOD SETTING REPEATS EVERY and prints its version, the seconds of the
    integration of each repeat, and EDP, collapse and impacts of every history. With 0 repeats it runs once for each
    line of its standard input, if it waits.
    """

    name: str
    command: tuple
    methods: dict  # {method: settings, the cheapest first}
    needs: str  # requirements, for the message if it is missing
    part: int = 1  # part of the histories: 1, all; 16, every 16th of 880
    repeats: int = 3
    expected: float = 3.0  # seconds of one setting, start and compilation included, on a quiet machine
    takes_case: bool = False  # a case of dondolo in place of the problem
    waits: bool = True  # takes turns: runs once for each line of its standard input with 0 repeats

    def quick(self):
        """The same peer with one setting per method, run once."""
        middle = {method: settings[len(settings) // 2 :][:1] for method, settings in self.methods.items()}
        return replace(self, methods=middle, repeats=1)


TOLERANCES = (1e-6, 1e-8, 1e-10, 1e-12)
FEW = (1e-6, 1e-9, 1e-12)

DONDOLO = Peer(
    "dondolo",
    (sys.executable, "-W", "ignore", FOLDER / "peers" / "dondolo_stripes.py"),
    {"rk45": TOLERANCES, "lanes": TOLERANCES},
    "the installed package",
    repeats=5,
    expected=2.0,
    takes_case=True,
)

PEERS = [
    Peer("C++ by hand", (BUILD / "rkn4",), {"RKN4, steps a sample": (1, 2, 4, 8, 32, 64)}, "g++"),
    Peer("Boost.odeint", (BUILD / "odeint",), {"cut": (*TOLERANCES, 3e-14), "free": TOLERANCES}, "g++, libboost-dev"),
    Peer(
        "SUNDIALS",
        (BUILD / "sundials",),
        {"dopri5": FEW},
        "g++, libsundials-dev",
        repeats=1,
    ),
    Peer(
        "SUNDIALS",
        (BUILD / "sundials",),
        {"adams": (1e-10, 1e-12), "adams_free": (1e-11,)},
        "g++, libsundials-dev",
        part=4,
        repeats=1,
        expected=4.0,
    ),
    Peer(
        "heyoka",
        (PYTHON, FOLDER / "peers" / "heyoka_taylor.py"),
        {"scalar": (1e-9, 1e-15), "batch": (1e-9, 1e-15)},
        "heyoka from PyPI, for this processor and Python",
        repeats=2,
        expected=8.0,
    ),
    Peer(
        "numbalsoda",
        (PYTHON, FOLDER / "peers" / "numbalsoda_ivp.py"),
        {"dop853": FEW, "lsoda": FEW},
        "numbalsoda from PyPI",
        repeats=2,
        expected=15.0,
    ),
    Peer(
        "SciPy",
        (PYTHON, FOLDER / "peers" / "scipy_ivp.py"),
        {
            "RK45": (1e-6, 1e-9),
            "DOP853": (1e-6, 1e-9),
            # At 1e-8 solve_ivp fails to locate an event of LSODA
            "LSODA": (1e-6,),
            "RK45/record": (1e-6, 1e-9),
        },
        "scipy and numba from PyPI",
        part=16,
        repeats=1,
        expected=14.0,
    ),
    Peer(
        "GNU Octave",
        ("octave", "--no-gui", "--no-window-system", "--quiet", FOLDER / "peers" / "octave_ode45.m"),
        {"ode45": (1e-6, 1e-8), "ode45/sample": (1e-6,)},
        "octave",
        part=80,
        repeats=1,
        expected=28.0,
        waits=False,
    ),
]


@dataclass(frozen=True)
class Result:
    """Result of one program at one setting."""

    wall: str
    accelerograms: str
    program: str
    version: str
    method: str
    setting: float
    histories: int
    seconds: float  # median of the repeats
    own: float  # seconds within the steps of a library that is called from Python; 0: not known
    ms: float  # per history
    ms_of_all: float  # per history, estimated for all histories; see `weights`
    flags: int  # number of wrong flags
    above: int  # EDPs with an error above LARGE
    worst: float
    median: float  # of the histories that rock and do not collapse
    most: float  # 99 % quantile of their errors

    @property
    def share(self):
        """Share of the histories with an error of the EDP above LARGE."""
        return self.above / self.histories

    @property
    def name(self):
        """Program and method."""
        return f"{self.program}, {self.method}"


def result(problem, every, weight, program, version, method, setting, seconds, own, edp, collapsed):
    """Result of a run, with its errors counted."""
    errors = problem.errors(every, edp, collapsed)
    median = statistics.median(seconds)
    own = statistics.median(own) if own else 0.0
    ms = 1e3 * median / len(edp)
    found = Result(
        *(problem.wall, problem.name, program, version, method, setting, len(edp), median, own, ms, ms / weight),
        *(errors.flags(), errors.above(LARGE), errors.worst(), errors.quantile(0.5), errors.quantile(0.99)),
    )
    say(
        f"{found.name}, {setting:g}: {ms:.4g} ms per history, wrong flags {found.flags}, "
        f"errors above 1e-6 {found.above} of {len(edp)}, worst {found.worst:.1e}, median {found.median:.1e}"
    )
    return found


def peer_of(result):
    """Peer that a result is of."""
    return next(peer for peer in (DONDOLO, *PEERS) if peer.name == result.program and result.method in peer.methods)


def stride(peer, problem):
    """Stride of the part of the histories that a peer runs."""
    return len(problem) * peer.part // 880 or 1


def command_of(peer, path, method, setting, repeats, problem):
    """Words of the command of a peer."""
    words = [*peer.command, path, method.split(",")[0], setting, repeats, stride(peer, problem)]
    return [str(word) for word in words]


def run_peer(peer, problem, path, weights):
    """Run all settings of a peer on the file of the problem; those that cannot run are skipped with a message."""
    found = []
    every = stride(peer, problem)
    for method, settings in peer.methods.items():
        for setting in settings:
            command = command_of(peer, path, method, setting, peer.repeats, problem)
            try:
                done = subprocess.run(command, capture_output=True, text=True, timeout=PATIENCE)
            except OSError:
                say(f"{peer.name} is skipped: not found; it needs {peer.needs}")
                return found
            except subprocess.TimeoutExpired:
                say(f"{peer.name}, {method}, {setting:g} is skipped: not finished after {PATIENCE} s")
                continue
            if done.returncode:
                why = " ".join(done.stderr.strip().splitlines()[-1:])
                say(f"{peer.name}, {method}, {setting:g} is skipped: failed with '{why}'; it needs {peer.needs}")
                continue
            version, seconds, own, outcomes = parse(done.stdout)
            weight = weights[every]
            arguments = (seconds, own, outcomes[:, 0], outcomes[:, 1] == 1.0)
            found.append(result(problem, every, weight, peer.name, version, method, setting, *arguments))
    return found


def parse(printed):
    """Version, seconds of each repeat, those of its own steps if printed, and the rows of the histories."""
    version, seconds, own, rows = "", [], [], []
    for line in printed.splitlines():
        first, _, rest = line.partition(" ")
        if first == "version":
            version = rest
        elif first == "seconds":
            seconds.append(float(rest))
        elif first == "own":
            own.append(float(rest))
        else:
            rows.append([float(word) for word in line.split()])
    return version, seconds, own, np.array(rows)


def run_dondolo(executable, wall, motions, rtol, engine, repeats):
    """Seconds of the whole command and of its histories, of each repeat, a new process of the executable each time."""
    whole, histories = [], []
    with tempfile.TemporaryDirectory() as folder:
        case = write_case(folder, wall, motions, rtol, threads=1, solver=f"engine = '{engine}'")
        for _ in range(repeats):
            start = time.perf_counter()
            done = subprocess.run([executable, case], check=True, capture_output=True, text=True)
            whole.append(time.perf_counter() - start)
            histories.append(float(re.search(r"histories in +(\S+) s", done.stdout).group(1)))
        return whole, histories


def weights(problem):
    """Ratio of the work of every n-th history to that of all, per history, as {n: ratio}.

    It is counted, not timed, so that it is the same in every run: evaluations of rk45, which runs history by history.
    """
    strides = {stride(peer, problem) for peer in PEERS}
    of_all = evaluations(problem, range(len(problem))) / len(problem)
    found = {1: 1.0}
    for every in sorted(strides - {1}):
        chosen = range(0, len(problem), every)
        found[every] = evaluations(problem, chosen) / len(chosen) / of_all
        say(f"every {every}th history takes {found[every]:.3f} of the mean work of all")
    return found


def evaluations(problem, chosen):
    """Evaluations of the equation of motion that some histories take rk45."""
    case, exact = problem.case(), problem.exact
    records = {record.name: record for record in case.records}
    by_level = {}
    for i in chosen:
        by_level.setdefault(exact.level[i], []).append(records[exact.record[i]])
    solver = dd.Solver(rtol=1e-8, atol=1e-10, engine="rk45")
    return dd.multiple_stripe(case.population[0], by_level, solver=solver, progress=False).work.evaluations


def write_results(path, results):
    """Write a table of results."""
    with open(path, "w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, [field.name for field in fields(Result)])
        writer.writeheader()
        writer.writerows(asdict(each) for each in results)


def read_results(path):
    """Read a table of results."""
    with open(path, newline="", encoding="utf-8") as file:
        return [Result(**{f.name: f.type(row[f.name]) for f in fields(Result)}) for row in csv.DictReader(file)]
