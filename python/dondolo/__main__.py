"""Commands of the shell: ``python -m dondolo``. Analyses are run by the executable."""

from __future__ import annotations

import argparse
import gc
import importlib.metadata
import os
import platform
import re
import sys
import warnings
from collections.abc import Callable
from pathlib import Path
from typing import Any, NoReturn

import dondolo as dd
from dondolo._fortran.files import whole_file
from dondolo._fortran.origins import check_replaced
from dondolo._fortran.records import catalogue_table
from dondolo.analysis.request import progress_bar
from dondolo.errors import silent, visible
from dondolo.exchange.differences import differences
from dondolo.exchange.exposure import functions_of
from dondolo.figures.saving import mark_end, save_figure
from dondolo.hazard.openquake import is_of_openquake
from dondolo.records.catalogues import build_catalogue
from dondolo.reporting.language import Language
from dondolo.reporting.writers.pdf import check_printer

_VERSION = f"dondolo {dd.__version__} ({dd.Solver.variant()})"
# An animation: frames per second, and the longest film [s]
_FRAMES, _FILM = 15, 30.0


def main(arguments: list[str] | None = None) -> int:
    """Run a command and return its exit code: 0 success, 1 failure while running, 2 invalid input."""
    if sorted(sys.argv[1:] if arguments is None else arguments) == ["--verbose", "--version"]:
        _print_versions()
        return 0
    options = _parser().parse_args(arguments)
    # A warning, or a note on how a table was read, is one line, as the executable's.
    warnings.showwarning = lambda message, *rest: _tell(
        f"{'note' if getattr(message, 'code', '') == 'note' else 'warning'}: {message}"
    )
    try:
        options.run(options)
        sys.stdout.flush()
    except BrokenPipeError:
        # Who reads the output has read enough, as head does; nothing may be flushed into the pipe at the end
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
    except dd.errors.InputError as error:
        _tell(error)
        return 2
    except (dd.errors.DondoloError, MemoryError) as error:
        _tell(error if isinstance(error, dd.errors.DondoloError) else "not enough memory")
        return 1
    except OSError as error:
        # The library gives errors of its own: this one is of standard output, which may not be flushed again either.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        print(f"dondolo: standard output: cannot be written: {error.strerror}", file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        print("dondolo: interrupted", file=sys.stderr)
        return 1
    return 0


def _print_versions() -> None:
    """Print the version, and those of all that may explain a difference between two computers."""
    print(_VERSION, f"Python: {' '.join(sys.version.split())}", f"system: {platform.platform()}", sep="\n")
    for name in ("numpy", "scipy", "matplotlib", "pandas", "python-docx", "XlsxWriter", "starlette", "uvicorn"):
        try:
            print(f"{name}: {importlib.metadata.version(name)}")
        except importlib.metadata.PackageNotFoundError:
            print(f"{name}: not installed")


def _tell(message: object) -> None:
    """Print a message on stderr, one line for each sentence."""
    for line in str(message).split("\n"):
        print(f"dondolo: {visible(line)}", file=sys.stderr)


def _report_done(what: str, path: str, more: str = "") -> None:
    """Print which file was made."""
    print(f"{what}: {visible(path)}{more}")


class _Parser(argparse.ArgumentParser):
    """Parser whose messages quote arguments safely."""

    def error(self, message: str) -> NoReturn:
        super().error(visible(message))


def _parser() -> argparse.ArgumentParser:
    parser = _Parser(
        # The executable hands its commands over by -c.
        prog="dondolo" if sys.argv[0] == "-c" else "python -m dondolo",
        description="dondolo: fragility of masonry walls that rock and overturn in earthquakes. "
        "Analyses are run by the executable, dondolo --help, or in Python.",
    )
    parser.add_argument(
        "--version",
        action="version",
        version=_VERSION,
        help="print the version and end; with --verbose also those of Python and its packages, for an issue",
    )
    commands = parser.add_subparsers(title="commands", required=True, metavar="COMMAND")
    plot = commands.add_parser(
        "plot",
        help="draw the figures of runs",
        description="Draw the figures of one or several runs from their CSV files, those of the executable or of "
        "Typology.write_results: the histories, the curve and the damage states of a wall, the curves of a population, "
        "or a motion and the wall at its peak.",
    )
    plot.add_argument(
        "prefixes",
        nargs="+",
        help="prefix of the result files, for example out/parapet",
        metavar="PREFIX",
    )
    plot.add_argument(
        "--format",
        default="png",
        help="png (default), pdf, svg or another format of Matplotlib",
        metavar="FORMAT",
    )
    plot.add_argument(
        "--dpi", type=float, help="dots per inch of pictures, 110 by default, 600 with --width", metavar="N"
    )
    plot.add_argument(
        "--width",
        type=float,
        help="width of the figures, in the style of journals: 88 for a column, 180 for a page",
        metavar="MM",
    )
    plot.add_argument("--lang", help="en or it; DONDOLO_LANG by default, or en", metavar="LANGUAGE")
    plot.add_argument(
        "--animate", action="store_true", help="also write an animation (GIF) of a time history, of 30 s at most"
    )
    plot.set_defaults(run=_plot)
    report = commands.add_parser(
        "report",
        help="write a report of a run: Word, HTML or PDF",
        description="Write a report of a run from its CSV files, those of the executable or of "
        "Typology.write_results: figures, tables, inputs, checks and versions in one file, HTML that opens offline, "
        "Word or PDF.",
    )
    report.add_argument("prefix", help="prefix of the result files, for example out/parapet", metavar="PREFIX")
    report.add_argument(
        "-o",
        "--output",
        help="path of the report, .docx, .html or .pdf; PREFIX_report.html by default",
        metavar="FILE",
    )
    report.add_argument(
        "--hazard",
        help="hazard curve of the site, for the annual frequency of collapse: a CSV table of the levels, titled with "
        "their intensity measure or 'ag (g)', and annual_frequency, return_period, or poe and investigation_time; or "
        "hazard curves that OpenQuake has exported",
        metavar="FILE",
    )
    report.add_argument(
        "--site",
        help="longitude and latitude [degrees] of the site, LON,LAT, in a file of OpenQuake with several sites",
        metavar="LON,LAT",
    )
    report.set_defaults(run=_report)
    report.add_argument("--pdf", action="store_true", help="write PREFIX_report.pdf instead, by Chromium or WeasyPrint")
    report.add_argument("--lang", help="en or it; DONDOLO_LANG by default, or en", metavar="LANGUAGE")
    relazione = commands.add_parser(
        "relazione",
        help="write a calculation report of checks by NTC 2018: Word, HTML or PDF",
        description="Write the calculation report (relazione di calcolo) of runs with a group &check: a wall as it "
        "stands and its designs, the designs of a case, or one facade. Passages that only the engineer can write are "
        "marked [TO BE COMPLETED: ...] or [DA COMPLETARE: ...].",
    )
    relazione.add_argument(
        "prefixes", nargs="+", help="prefix of the result files; as it stands first", metavar="PREFIX"
    )
    relazione.add_argument(
        "-o",
        "--output",
        help="path of the document, .docx, .html or .pdf; PREFIX_relazione.html by default",
        metavar="FILE",
    )
    relazione.add_argument(
        "--mechanisms",
        action="store_true",
        help="the runs are several mechanisms of one building, and not a wall and its designs",
    )
    relazione.add_argument("--lang", help="en or it; DONDOLO_LANG by default, or en", metavar="LANGUAGE")
    relazione.add_argument("--data", help="TOML file of the project: title page and texts", metavar="FILE")
    relazione.add_argument("--template", help="Word file with the styles of the office, for .docx", metavar="FILE")
    relazione.set_defaults(run=_relazione)
    workbook = commands.add_parser(
        "xlsx",
        help="write the tables of a run into a workbook",
        description="Write all tables of a run into one workbook of Excel or LibreOffice: one sheet per table, and one "
        "of the case. Needs XlsxWriter.",
    )
    workbook.add_argument("prefix", help="prefix of the result files, for example out/parapet", metavar="PREFIX")
    workbook.add_argument("-o", "--output", help="path of the workbook, PREFIX_tables.xlsx by default", metavar="FILE")
    workbook.add_argument("--lang", help="en or it; DONDOLO_LANG by default, or en", metavar="LANGUAGE")
    workbook.set_defaults(run=_workbook)
    nrml = commands.add_parser(
        "nrml",
        help="write the curves of a run for OpenQuake",
        description="Write the fragility curves of a run, read from its CSV files, as a fragility model of OpenQuake, "
        "NRML 0.5: of a population the mean curves, one function per group and mechanism, with its damage states; of a "
        "wall, a facade and each design its curve. If a mean curve had to be raised, a message on stderr reports it.",
    )
    nrml.add_argument("prefix", help="prefix of the result files, for example out/population", metavar="PREFIX")
    nrml.add_argument("-o", "--output", help="path of the model, PREFIX_fragility.xml by default", metavar="FILE")
    nrml.add_argument(
        "--no-damage-limit",
        type=float,
        help="intensity up to which there is no damage, in the unit of the levels; by default just below the first",
        metavar="X",
    )
    nrml.add_argument(
        "--imt", help="OpenQuake's measure of curves against saavg(T1:T2): AvgSA, or AvgSA(T)", metavar="NAME"
    )
    nrml.set_defaults(run=_nrml)
    openquake = commands.add_parser(
        "openquake",
        help="write a job of OpenQuake for the walls of a run",
        description="Write the inputs with which OpenQuake computes damage and losses of the walls of a run: exposure, "
        "taxonomy mapping, fragility, vulnerability, consequences and jobs. Columns x_lon, x_lat, x_value and "
        "x_occupants of the table of walls are those of the assets. Shares are STATE=SHARE, separated by commas.",
    )
    openquake.add_argument("prefix", help="prefix of the result files, for example out/population", metavar="PREFIX")
    openquake.add_argument("folder", help="a new or empty folder, or one of an earlier job", metavar="FOLDER")
    openquake.add_argument("--site", help="longitude and latitude of all walls [degrees]", metavar="LON,LAT")
    openquake.add_argument(
        "--hazard", help="hazard of the town: a table of dondolo or hazard curves of OpenQuake", metavar="FILE"
    )
    openquake.add_argument("--ratios", help="share of the value lost in each state", metavar="SHARES")
    openquake.add_argument("--fatalities", help="share of the occupants that die in each state", metavar="SHARES")
    openquake.add_argument(
        "--motion",
        nargs=2,
        help="motion of a scenario: tables of ground-motion fields and of sites, or grid.xml and uncertainty.xml of a "
        "ShakeMap",
        metavar="FILE",
    )
    openquake.add_argument(
        "--imt", help="OpenQuake's measure of curves against saavg(T1:T2): AvgSA, or AvgSA(T)", metavar="NAME"
    )
    openquake.set_defaults(run=_openquake)
    diff = commands.add_parser(
        "diff",
        help="compare two runs, and say which change of dondolo explains it",
        description="Compare two runs, or the runs of the same names in two folders: settings, inputs and every table, "
        "row by row, by their names. Where two versions, or two builds of one, wrote them, the rows of Results that "
        "change in CHANGELOG.md between them are printed that name what the runs have.",
    )
    diff.add_argument("old", help="prefix of the result files, their _run.json, or a folder", metavar="OLD")
    diff.add_argument("new", help="the same of the other run", metavar="NEW")
    diff.set_defaults(run=_diff)
    records = commands.add_parser(
        "records",
        help="print a table of the records of a catalogue",
        description="Print a table of the records of a catalogue, as the executable's --check does: peaks, duration, "
        "time step and suspected problems.",
    )
    records.add_argument("catalogue", help="a CSV table with the column file", metavar="CATALOGUE")
    records.set_defaults(run=_records)
    catalogue = commands.add_parser(
        "catalogue",
        help="make a catalogue of a folder of accelerogram files",
        description="Write a catalogue of all accelerogram files in a folder and the folders in it, one row a "
        "channel. Files that cannot be read are listed on stderr with the reason, and so are vertical components, "
        "which are left out.",
    )
    catalogue.add_argument("folder", help="folder of the files", metavar="FOLDER")
    catalogue.add_argument(
        "-o", "--output", help="path of the catalogue, by default FOLDER/catalogue.csv", metavar="FILE"
    )
    catalogue.add_argument("--dt", type=float, help="time step [s] of files that do not state it", metavar="SECONDS")
    catalogue.add_argument("--units", help="units of files that do not state them, for example g", metavar="UNITS")
    catalogue.add_argument(
        "--columns",
        help="what the columns of plain files are that do not say so: time, acceleration or other for each, separated "
        "by commas, or rows for values along the rows",
        metavar="WORDS",
    )
    catalogue.add_argument("--vertical", action="store_true", help="keep vertical components")
    catalogue.set_defaults(run=_catalogue)
    serve = commands.add_parser(
        "serve",
        help="show a wall in the browser: its curve moves with the sliders",
        description="Show a wall in the browser: its fragility curve, its checks by NTC 2018 and its motion follow the "
        "sliders. The page is for this computer only, needs no network, and ends with Ctrl-C. Needs starlette and "
        "uvicorn (dondolo[serve]).",
    )
    serve.add_argument("case", nargs="?", help="a case of one wall to begin with", metavar="CASE")
    serve.add_argument(
        "--records", help="catalogue of the accelerograms, instead of that of the case", metavar="CATALOGUE"
    )
    serve.add_argument("--port", type=int, default=0, help="where to listen; a free port by default", metavar="N")
    serve.add_argument("--no-browser", action="store_true", help="print the address and open nothing")
    serve.add_argument("--threads", type=int, default=0, help="number of threads; all by default", metavar="N")
    serve.add_argument("--lang", help="en or it; DONDOLO_LANG by default, or en", metavar="LANGUAGE")
    serve.set_defaults(run=_serve)
    return parser


def _serve(options: argparse.Namespace) -> None:
    """Serve the page."""
    try:
        from dondolo.serve.server import serve
    except ModuleNotFoundError as error:
        raise dd.errors.DondoloError(f"serve needs {error.name}: pip install starlette uvicorn") from None
    lang = Language(options.lang).code
    serve(options.case, options.records, options.port, not options.no_browser, options.threads, lang)


def _diff(options: argparse.Namespace) -> None:
    """Print what differs between two runs."""
    for line in differences(options.old, options.new):
        print(visible(line))


def _records(options: argparse.Namespace) -> None:
    """Print the table of a catalogue."""
    print("\n".join(catalogue_table(options.catalogue)))


def _catalogue(options: argparse.Namespace) -> None:
    """Make a catalogue of a folder."""
    made = build_catalogue(options.folder, options.output, options.dt, options.units, options.vertical, options.columns)
    for problem in made.problems:
        _tell(f"left out: {problem}")
    if several := made.contradictions:
        beyond = f" ({len(several)} files)" if len(several) > 1 else ""
        _tell(f"{several[0]}, which counts, not what is given for files that do not state it{beyond}")
    _report_done("written", str(made.path), f" ({made.records} records)")


def _import_matplotlib() -> None:
    """Import Matplotlib for files. What is imported stays, so that garbage collections need not look at it."""
    import matplotlib

    matplotlib.use("agg")
    importlib.import_module("matplotlib.pyplot")
    gc.freeze()


def _make_folder(path: str) -> None:
    """Make the folder of a document, as the executable makes that of its results."""
    folder = Path(path).parent
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise dd.errors.DondoloError(f"{folder}: cannot be made: {error.strerror}") from None


def _report(options: argparse.Namespace) -> None:
    """Write the report of a run."""
    path = options.output or f"{options.prefix}_report.{'pdf' if options.pdf else 'html'}"
    if options.pdf and not path.lower().endswith(".pdf"):
        raise dd.errors.InputError(f"--output {path}: must end in .pdf with --pdf")
    if path.lower().endswith(".pdf"):
        check_printer()
    _import_matplotlib()
    hazard = _hazard(options.hazard, options.site)
    results = dd.read_results(options.prefix)
    _make_folder(path)
    dd.report(results, path, hazard=hazard, lang=options.lang)
    _report_done("written", path)


def _hazard(path: str | None, site: str | None) -> dd.HazardCurve | None:
    """The hazard curve of a file, of dondolo or of OpenQuake, at a site."""
    if path is None:
        if site is not None:
            raise dd.errors.InputError("--site: must be given with --hazard")
        return None
    if not is_of_openquake(path):
        if site is not None:
            raise dd.errors.InputError(f"--site: {path} is not of OpenQuake: its curve is that of one site")
        return dd.HazardCurve.from_csv(path)
    return dd.HazardCurve.from_openquake(path, site=None if site is None else _coordinates("--site", site))


def _coordinates(option: str, text: str) -> tuple[float, float]:
    """Longitude and latitude of an option."""
    try:
        longitude, latitude = map(float, text.split(","))
    except ValueError:
        raise dd.errors.InputError(f"{option} {text}: must be LON,LAT in degrees, such as 13.4,42.35") from None
    return longitude, latitude


def _relazione(options: argparse.Namespace) -> None:
    """Write the calculation report of runs."""
    path = options.output or f"{options.prefixes[0]}_relazione.html"
    if path.lower().endswith(".pdf"):
        check_printer()
    _import_matplotlib()
    results = [dd.read_results(prefix) for prefix in options.prefixes]
    _make_folder(path)
    given = {
        "lang": options.lang,
        "project": options.data,
        "template": options.template,
        "mechanisms": options.mechanisms,
    }
    left = dd.calculation_report(results, path, **given)
    _report_done("written", path)
    if left:
        print(f"{len(left)} field{'s' if len(left) > 1 else ''} to be completed by the engineer: {', '.join(left)}")


def _workbook(options: argparse.Namespace) -> None:
    """Write the tables of a run into a workbook."""
    path = options.output or f"{options.prefix}_tables.xlsx"
    _make_folder(path)
    dd.write_workbook(options.prefix, path, lang=options.lang)
    _report_done("written", path)


def _nrml(options: argparse.Namespace) -> None:
    """Write the curves of a run for OpenQuake."""
    path = options.output or f"{options.prefix}_fragility.xml"
    results = dd.read_results(options.prefix)
    _make_folder(path)
    try:
        functions, sentences = functions_of(results)
    except dd.errors.InputError as error:
        raise error.placed(options.prefix) from None
    except dd.errors.DondoloError as error:
        raise dd.errors.DondoloError(f"{options.prefix}: {error}") from None
    for sentence in sentences:
        _tell(sentence)
    name = re.sub("[^A-Za-z0-9_-]", "_", Path(options.prefix).name)[:100]
    dd.write_nrml(
        path, functions, id=name, no_damage_limit=options.no_damage_limit, imt=options.imt, run=results.run.run
    )
    _report_done("written", path, f" ({len(functions)} function{'s' if len(functions) > 1 else ''})")


def _openquake(options: argparse.Namespace) -> None:
    """Write a job of OpenQuake."""
    results = dd.read_results(options.prefix)
    files = dd.write_openquake(
        results,
        options.folder,
        site=None if options.site is None else _coordinates("--site", options.site),
        hazard=options.hazard,
        ratios=_shares("--ratios", options.ratios),
        fatalities=_shares("--fatalities", options.fatalities),
        motion=options.motion,
        imt=options.imt,
    )
    for file in files:
        _report_done("written", file)


def _shares(option: str, text: str | None) -> dict[str, float] | None:
    """Shares of states in an option: STATE=SHARE,STATE=SHARE."""
    if text is None:
        return None
    try:
        pairs = [word.split("=") for word in text.split(",")]
        return {state: float(share) for state, share in pairs}
    except ValueError:
        raise dd.errors.InputError(f"{option} {text}: must be STATE=SHARE, separated by commas") from None


def _plot(options: argparse.Namespace) -> None:
    """Draw whatever the result files of runs hold, beside them."""
    _import_matplotlib()
    if options.dpi is not None and not 10.0 <= options.dpi <= 2400.0:
        raise dd.errors.InputError(f"--dpi {options.dpi:g}: must lie between 10 and 2400")
    name = "screen" if options.width is None else "journal"
    with dd.style(name, width=options.width, language=Language(options.lang).code):
        for prefix in options.prefixes:
            _plot_run(prefix, options)


def _plot_run(prefix: str, options: argparse.Namespace) -> None:
    """Draw whatever the result files of a run hold."""
    kind = options.format

    def save(name: str, draw: Callable[[], Any]) -> None:
        _save(f"{prefix}_{name}.{kind}", options, results.run.run, draw)

    results = dd.read_results(prefix)
    if results.response is not None:
        motion = results.response
        save("history", motion.plot)
        save("wall", motion.plot_peak)
        if options.animate:
            _film(f"{prefix}_motion.gif", motion, results.run.run)
    if results.stripes is not None and results.fragility is not None:
        stripes = results.stripes
        save("stripes", stripes.plot)
        save("fragility", results.fragility.plot)
        if results.edp_thresholds:
            how: dict[str, Any] = {"edp_thresholds": results.edp_thresholds, "states": results.states}
            save("damage_states", lambda: stripes.plot_damage_states(**how))
    if results.designs is not None:
        _plot_designs(results.designs, results.population, save)
    elif results.typology is not None:
        _plot_walls(results, results.typology, save)


def _plot_designs(
    designs: dd.results.DesignComparison, walls: dd.Population, save: Callable[[str, Callable[[], Any]], None]
) -> None:
    """Draw designs beside each other, and each of them: they are alternatives, and have no curve in common."""
    save("designs", designs.plot)
    for number, wall in enumerate(walls, 1):
        save(f"design_{number}", wall.plot)


def _plot_walls(
    results: dd.results.Results, people: dd.results.Typology, save: Callable[[str, Callable[[], Any]], None]
) -> None:
    """Draw the curves of a population, or of one facade."""
    save("typology", people.plot)
    if (uncertain := results.uncertain) is not None:
        save("uncertainty", uncertain.plot)
    is_facade = bool(people.facade) and people.knows_unions
    if len(people.groups) > 1 and not is_facade:
        save("combination", people.plot_combination)
        for of in people.groups:
            if of.mechanism != "all" and not of.group:
                save(f"typology_{of.mechanism}", people[of.mechanism].plot)
    if any(of.group for of in people.groups) and not is_facade:
        save("groups", people.plot_groups)
    if len(people.edp_thresholds) > 1:
        save("damage_states", people.plot_damage_states)


def _film(path: str, motion: dd.results.Response, run: str) -> None:
    """Write an animation of a motion; one that is long is shown faster, so that the film does not take minutes."""
    from dondolo.analysis.plots_response import motion_span

    check_replaced(path, "film")
    first, last = motion_span(motion)
    span = last - first
    speed = max(1.0, span / _FILM)
    animation = motion.animate(frames_per_second=_FRAMES, speed=speed)
    with whole_file(path) as part, progress_bar(int(span / speed * _FRAMES) + 1, True, "animation", "frame") as bar:
        # Pillow chooses the format by the name.
        image = part.with_name(part.name + ".gif")
        try:
            animation.save(image, writer="pillow", progress_callback=lambda *_: bar.update(1))
            image.replace(part)
            mark_end(part, "film", run)
        finally:
            image.unlink(missing_ok=True)
    _report_done("drawn", path, f" ({speed:.3g} times as fast as the motion)" if speed > 1.0 else "")


def _save(path: str, options: argparse.Namespace, run: str, draw: Callable[[], Any]) -> None:
    """Draw a figure into a file, which appears whole or not at all."""
    import matplotlib.pyplot as plt

    # Figures show which curves have no fit, and the run has warned of them.
    with silent():
        figure = draw().figure
    try:
        save_figure(figure, path, options.format, run, options.dpi)
    except dd.errors.InputError:
        raise
    except ValueError as error:
        raise dd.errors.InputError(f"--format {options.format}: {str(error).splitlines()[0]}") from None
    finally:
        plt.close(figure)
    _report_done("drawn", path)


if __name__ == "__main__":
    sys.exit(main())
