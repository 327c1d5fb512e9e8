"""Readers of the Python package, many files in one process: answers lines `FAMILY PATH` of standard input.

python results.py attack | samples FOLDER
"""

from __future__ import annotations

import contextlib
import dataclasses
import gc
import hashlib
import io
import resource
import sys
import warnings
import zipfile
from pathlib import Path
from typing import Any

import numpy as np

import dondolo as dd
import dondolo.__main__

# Address space of the process: what is more than any small file needs [bytes]
LARGEST = 6_000_000_000
# Commands of the shell that read result sets, and the ends of what they write
COMMANDS = ("report", "plot", "xlsx", "curves")
SUFFIXES = {"report": ".html", "xlsx": ".xlsx", "curves": ".xml"}
# Intensities at which curves are evaluated
GRID = np.append(0.0, np.geomspace(1e-3, 100.0, 200))


def samples(folder: Path) -> None:
    """Save results of many kinds."""
    wall = dd.TwoBlockWall(3.0, 0.3, name="a")
    t = 0.01 * np.arange(400)
    records = [
        dd.Record((1.0 + i) * np.sin((4.0 + i) * t) * np.exp(-((t - 2.0) ** 2)), 0.01, name=f"r{i}") for i in range(4)
    ]
    levels = [0.1, 0.3, 0.5, 0.8]
    stripes = dd.multiple_stripe(wall, records, levels=levels, progress=False)
    curve = dd.fit_fragility([0.2, 0.4, 0.6], [1, 5, 9], [10, 10, 10])
    made = [stripes, curve, dd.simulate(wall, records[0], scale=0.5)]
    hazard = dd.HazardCurve([0.1, 0.2, 0.4], [0.01, 0.002, 0.0003])
    made += [hazard, curve.risk(hazard)]
    for i, one in enumerate(made):
        one.save(folder / f"{i}.npz")


def unsound(value: Any) -> str:
    """What cannot be in a result: arrays of Python objects, a repr that fails, flags that are none."""
    repr(value)
    if isinstance(value, dd.results.FragilityModel):
        for curves in value.functions.values():
            for state, curve in curves.items():
                p = curve(GRID)
                if not (np.all((p >= 0.0) & (p <= 1.0)) and np.all(np.diff(p) >= -1e-12)):
                    return f"{state}: is not a curve of probabilities"
    if dataclasses.is_dataclass(value):
        for field in dataclasses.fields(value):
            inner = getattr(value, field.name)
            if field.name == "edp" and hasattr(value, "ran"):
                # Histories that were not run have none.
                inner = inner[value.ran]
            if isinstance(inner, np.ndarray) and inner.dtype.hasobject:
                return f"{field.name}: objects"
            if (
                isinstance(inner, np.ndarray)
                and field.name in ("edp", "levels", "acceleration")
                and not np.isfinite(inner).all()
            ):
                return f"{field.name}: not finite"
    return ""


def read_template(path: str) -> str:
    """Open a template of Word; what comes along must run nothing and name no other file."""
    from dondolo.reporting.writers.template import open_template

    made = io.BytesIO()
    open_template(path)[0].save(made)
    with zipfile.ZipFile(made) as archive:
        whole = b"".join(archive.read(name) for name in archive.namelist())
    found = [word for word in (b'TargetMode="External"', b"vbaProject", b"macroEnabled", b"<!DOCTYPE") if word in whole]
    return f"UNSOUND: {found}" if found else "read 1"


def digest(stored: dd.results.Results) -> str:
    """A digest of all that makes one study another: walls, settings, and what came of the histories."""
    parts = [(wall.name, wall.height, wall.thickness) for wall in stored.population.walls]
    settings = [stored.run.setting("job", "title", ""), stored.run.settings.get("stripes", {})]
    numbers = [
        one.tobytes()
        for one in (getattr(stored.response, "rotation", None), getattr(stored.stripes, "edp", None))
        if one is not None
    ]
    if stored.typology is not None:
        numbers += [stored.typology.collapses.tobytes(), stored.typology.levels.tobytes()]
    return hashlib.sha256(repr((parts, settings, numbers)).encode()).hexdigest()[:16]


def run_command(command: str, prefix: str) -> str:
    """Run a command of the shell on a result set; whatever it says beside one sentence is a failure."""
    output = Path(prefix).with_name("made")
    options = {"plot": []}.get(command, ["-o", f"{output}{SUFFIXES.get(command, '')}"])
    said = io.StringIO()
    unraisable: list[str] = []
    sys.unraisablehook = lambda event: unraisable.append(f"{event.err_msg}: {event.exc_value!r}")
    with contextlib.redirect_stderr(said), contextlib.redirect_stdout(io.StringIO()):
        code = dondolo.__main__.main([{"curves": "nrml"}.get(command, command), prefix, *options])
        gc.collect()
    sys.unraisablehook = sys.__unraisablehook__
    lines = [line for line in said.getvalue().splitlines() if not line.startswith("dondolo: warning: ")]
    lines = [line.removeprefix("dondolo: ") if line.startswith("dondolo: ") else f"UNCLEAR {line}" for line in lines]
    if unraisable or any(line.startswith("UNCLEAR") for line in lines):
        return f"UNCLEAR {unraisable} {lines}"
    if code == 0:
        return "read 1"
    return f"refused {'|'.join(lines)}" if code in (1, 2) and len(lines) == 1 else f"ENDS with {code}: {lines}"


def answer(family: str, path: str) -> str:
    """Read a file and say what came of it."""
    try:
        if family in COMMANDS:
            return run_command(family, path)
        if family == "template":
            return read_template(path)
        if family == "archive":
            results = [dd.load(path)]
        elif family == "hazard":
            results = [dd.HazardCurve.from_csv(path)]
        elif family == "openquake":
            results = [dd.HazardCurve.from_openquake(path)]
        elif family == "nrml":
            results = [dd.read_nrml(path)]
        elif family == "set":
            return f"read {digest(dd.read_results(path))}"
        else:
            stored = dd.read_results(path)
            results = [stored, stored.population, stored.response, stored.stripes, stored.fragility, stored.typology]
        wrong = [text for one in results if one is not None and (text := unsound(one))]
    except dd.errors.MissingFileError:
        return "read none"
    except dd.errors.DondoloError as error:
        return f"refused {str(error).replace(chr(10), '|')}"
    except Exception as error:
        place = error.__traceback__
        while place is not None and place.tb_next is not None:
            place = place.tb_next
        where = f"{Path(place.tb_frame.f_code.co_filename).name}:{place.tb_lineno}" if place else ""
        return f"RAISES {type(error).__name__}: {str(error)[:200]!r} at {where}"
    return f"UNSOUND {wrong}" if wrong else "read 1"


def attack() -> None:
    """Answer all lines; a warning of NumPy is a failure, one of dondolo is none."""
    resource.setrlimit(resource.RLIMIT_AS, (LARGEST, LARGEST))
    warnings.simplefilter("error")
    warnings.simplefilter("ignore", dd.errors.DondoloWarning)
    sys.stdout.reconfigure(encoding="utf-8", errors="surrogateescape")
    for line in sys.stdin:
        family, _, path = line.rstrip("\n").partition(" ")
        print(answer(family, path).replace("\n", "\\n"), flush=True)


if __name__ == "__main__":
    warnings.simplefilter("ignore", dd.errors.DondoloWarning)
    if sys.argv[1] == "samples":
        samples(Path(sys.argv[2]))
    else:
        attack()
