"""What can be done from the shell with Python: ``python -m dondolo``. Analyses are the executable's."""

from __future__ import annotations

import argparse
import os
import sys
import warnings
from collections.abc import Callable
from pathlib import Path
from typing import Any

import dondolo as dd


def main(arguments: list[str] | None = None) -> int:
    """Run a command and return its exit code: 0 done, 1 failed while running, 2 wrong input."""
    options = _parser().parse_args(arguments)
    # A warning is one line, as the executable's.
    warnings.showwarning = lambda message, *rest: print(f"dondolo: warning: {message}", file=sys.stderr)
    try:
        options.run(options)
    except dd.InputError as error:
        print(f"dondolo: {error}", file=sys.stderr)
        return 2
    except dd.DondoloError as error:
        print(f"dondolo: {error}", file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        print("dondolo: interrupted", file=sys.stderr)
        return 1
    return 0


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="python -m dondolo",
        description="dondolo: fragility of masonry walls that rock and overturn in earthquakes. "
        "Analyses are run by the executable, dondolo --help, or in Python.",
    )
    parser.add_argument("--version", action="version", version=f"dondolo {dd.__version__}")
    commands = parser.add_subparsers(title="commands", required=True, metavar="COMMAND")
    plot = commands.add_parser(
        "plot",
        help="draw the figures of a run of the executable",
        description="Draw the figures of a run of the executable from its CSV files: the histories and the curve "
        "of a wall, the curves of a population, or a motion and the wall at its peak.",
    )
    plot.add_argument("prefix", help="what the names of the result files begin with, for example out/parapet")
    plot.add_argument(
        "--format", default="png", help="png (default), pdf, svg, or any other that Matplotlib writes", metavar="FORMAT"
    )
    plot.add_argument("--animate", action="store_true", help="of a motion, also write an animation (GIF)")
    plot.set_defaults(run=_plot)
    return parser


def _plot(options: argparse.Namespace) -> None:
    """Draw whatever the result files hold, beside them."""
    import matplotlib

    matplotlib.use("agg")
    results = dd.read_results(options.prefix)
    if results.response is not None:
        motion = results.response
        _save(options, "history", lambda: dd.plot_history(motion)[0])
        _save(options, "wall", lambda: dd.plot_wall(motion))
        if options.animate:
            path = f"{options.prefix}_motion.gif"
            dd.animate_history(motion, frames_per_second=20).save(path, writer="pillow")
            print(f"drawn: {path}")
    if results.stripes is not None and results.fragility is not None:
        stripes, curve = results.stripes, results.fragility
        _save(options, "stripes", lambda: dd.plot_stripes(stripes))
        _save(options, "fragility", lambda: dd.plot_fragility(curve, stripes))
    if results.typology is not None:
        people = results.typology
        _save(options, "typology", lambda: dd.plot_typology(people))
        if len(people.groups) > 1:
            for group in people.groups[:-1]:
                name = group.mechanism
                _save(options, f"typology_{name}", lambda name=name: dd.plot_typology(people, mechanism=name))


def _save(options: argparse.Namespace, name: str, draw: Callable[[], Any]) -> None:
    """Draw a figure into a file, which appears whole or not at all."""
    import matplotlib.pyplot as plt

    figure = draw().figure
    path = Path(f"{options.prefix}_{name}.{options.format}")
    part = path.with_name(f"{path.name}.part")
    try:
        figure.savefig(part, format=options.format)
        part.replace(path)
    except ValueError as error:
        raise dd.InputError(f"--format {options.format}: {str(error).splitlines()[0]}") from None
    except OSError as error:
        raise dd.DondoloError(f"{path}: cannot be written: {error.strerror}") from error
    finally:
        plt.close(figure)
        if part.exists():
            os.unlink(part)
    print(f"drawn: {path}")


if __name__ == "__main__":
    sys.exit(main())
