"""Pages of the site that follow from the program: command line, variables, columns, Python interface, examples.

They are written into docs/generated when the site is built, and only if they changed, so that a second build is quick.
"""

from __future__ import annotations

import ast
import inspect
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import columns
import variables

import dondolo as dd

# Rooms of the package, in the order in which a study meets them
ROOMS = {
    "walls": "Walls and populations",
    "records": "Records",
    "analysis": "Analyses",
    "figures": "Figures for print",
    "curves": "Fragility curves and risk",
    "hazard": "Hazard",
    "checks": "Building codes",
    "retrofit": "Retrofit",
    "populations": "Typological curves",
    "exchange": "Cases, result files, OpenQuake",
    "reporting": "Reports",
    "_storage": "Saved results",
    "errors": "Errors and warnings",
}


def write_pages(source: Path) -> None:
    """Write every page that follows from the program."""
    folder = source / "generated"
    folder.mkdir(exist_ok=True)
    _write(folder / "command_line.md", _command_line())
    _write(folder / "variables.md", variables.page())
    _write(folder / "columns.md", columns.page())
    _write(folder / "api.md", _api())
    _write_examples(source / "examples", folder / "examples")


def _write(path: Path, text: str) -> None:
    if not path.exists() or path.read_text(encoding="utf-8") != text:
        path.write_text(text, encoding="utf-8")


def _command_line() -> str:
    """What the executable and the package say of themselves."""
    executable = Path(sys.executable).with_name("dondolo")
    lines = ["# Command line", "", "## dondolo", "", *_printed([executable, "--help"])]
    commands = ("plot", "report", "xlsx", "nrml", "openquake", "records", "catalogue", "serve")
    for command in commands:
        lines += [f"## dondolo {command}", "", *_printed([executable, command, "--help"])]
    return "\n".join(lines)


def _printed(command: list[str | Path]) -> list[str]:
    """What a command prints, as a block."""
    done = subprocess.run(
        command,
        capture_output=True,
        text=True,
        check=True,
        stdin=subprocess.DEVNULL,
        env={**os.environ, "COLUMNS": "100"},
    )
    return ["```text", done.stdout.rstrip(), "```", ""]


def _api() -> str:
    """Every public name, by its room."""
    rooms: dict[str, list[str]] = {room: [] for room in ROOMS}
    for place in (dd, dd.results):
        for name in place.__all__:
            of = getattr(place, name)
            if inspect.isclass(of) or inspect.isfunction(of):
                rooms[of.__module__.split(".")[1]].append(f"{place.__name__}.{name}".removeprefix("dondolo."))
    lines = [
        "# Python interface",
        "",
        "`import dondolo as dd` gives all of these names; what begins with `results` are the types of what analyses",
        "and readers return. Angles are in radians, accelerations in g where they scale",
        "records and in m/s2 where they are those of a motion; each page states its units. `dd.pulses` and",
        "`dd.distributions` are described in [their](#pulses) [modules](#distributions).",
        "",
    ]
    for room, names in rooms.items():
        lines += [f"## {ROOMS[room]}", "", "```{eval-rst}", ".. currentmodule:: dondolo", "", ".. autosummary::"]
        lines += ["   :toctree: api", "   :nosignatures:", "", *(f"   {name}" for name in names), "```", ""]
    for module, title in ((dd.pulses, "Pulses"), (dd.distributions, "Distributions")):
        lines += [f"({title.lower()})=", f"## {title}", "", "```{eval-rst}", f".. automodule:: {module.__name__}"]
        lines += ["   :members:", "```", ""]
    return "\n".join(lines)


def _write_examples(scripts: Path, folder: Path) -> None:
    """Run each example and write its page: the script, what it prints, and its figures."""
    folder.mkdir(exist_ok=True)
    for script in sorted(scripts.glob("*.py")):
        page = folder / f"{script.stem}.md"
        # A page is newer than the package and the script that it comes from, or is made again.
        newest = max(script.stat().st_mtime, Path(dd.Solver.variant.__code__.co_filename).stat().st_mtime)
        if page.exists() and page.stat().st_mtime > newest:
            continue
        _write(page, _example(script, folder))


def _example(script: Path, folder: Path) -> str:
    """The page of an example."""
    about = (ast.get_docstring(ast.parse(script.read_text(encoding="utf-8"))) or "").split("\n\n")[0]
    title, _, rest = " ".join(about.split()).partition(":")
    lines = [f"# {title.rstrip('.')}", ""]
    if rest:
        lines += [rest.strip()[0].upper() + rest.strip()[1:], ""]
    lines += [f"```{{literalinclude}} ../../examples/{script.name}", ":language: python", "```", ""]
    with tempfile.TemporaryDirectory() as work:
        done = subprocess.run(
            [sys.executable, "-W", "ignore", script],
            cwd=work,
            env={**os.environ, "MPLBACKEND": "agg"},
            capture_output=True,
            text=True,
            check=False,
            stdin=subprocess.DEVNULL,
        )
        if done.returncode != 0:
            raise RuntimeError(f"{script.name} failed: {done.stderr}")
        if done.stdout:
            lines += ["It prints", "", "```text", done.stdout.rstrip(), "```", ""]
        for figure in sorted(Path(work).glob("out/examples/*.png")):
            name = f"{script.stem}_{figure.name}"
            shutil.copy(figure, folder / name)
            lines += [f"![figure {figure.stem.replace('_', ' ')} of this example]({name})", ""]
    return "\n".join(lines)
