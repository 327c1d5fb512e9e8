"""docs/openquake.md, run word for word: its commands and scripts; and the table of docs/studies/openquake.md.

Usage: docs/openquake_page.py ENGINE [--quick], the folder of the engine's environment. With --quick the study stays as
it is, the table goes into out/openquake/numbers.md, and the runs of many levels and of 10 000 assets are left out.
"""

import csv
import json
import os
import re
import subprocess
import sys
import time
import warnings
from pathlib import Path

import numpy as np

import dondolo as dd
from dondolo.exchange.exposure import assets_of, functions_of
from dondolo.exchange.openquake_job import _write_exposure

ROOT = Path(__file__).resolve().parents[1]
PAGE = ROOT / "docs/openquake.md"
STUDY = ROOT / "docs/studies/openquake.md"
OUT = ROOT / "out/openquake"
RATIOS = {"edp_0p1": 0.05, "edp_0p4": 0.2, "collapse": 1.0}
MEDIAN, DISPERSION = 0.3, 0.6
# Hazard of data/hazard/illustrative.csv
LAW = dd.HazardCurve.power_law(2e-5, 2.5)
MARKS = "<!-- numbers -->\n", "<!-- end of numbers -->\n"


def environment(engine):
    """The engine and dondolo in PATH, one process, data beside the results."""
    (OUT / "data").mkdir(parents=True, exist_ok=True)
    path = os.pathsep.join([str(Path(sys.executable).parent), str(engine / "bin"), os.environ["PATH"]])
    return os.environ | {"PATH": path, "OQ_DATADIR": str(OUT / "data"), "OQ_DISTRIBUTE": "no"}


def run_page(engine):
    """Run the blocks of the page, in their order."""
    for kind, block in re.findall(r"^```(console|python)\n(.*?)^```", PAGE.read_text(encoding="utf-8"), re.M | re.S):
        if kind == "python":
            command = [sys.executable, "-c", block]
        else:
            lines = [line.removeprefix("$ ") for line in block.splitlines() if line.startswith("$ ")]
            print("\n".join(lines), flush=True)
            command = ["bash", "-ec", "\n".join(lines)]
        done = subprocess.run(command, cwd=ROOT, env=environment(engine), capture_output=True, text=True, check=False)
        if done.returncode:
            sys.exit(f"docs/openquake.md: fails: {block}\n{done.stdout[-2000:]}\n{done.stderr[-2000:]}")


def run_job(engine, job):
    """Run a job beside its folder's others; its seconds."""
    start = time.perf_counter()
    command = ["oq", "engine", "--run", job.name, "--exports", "csv"]
    subprocess.run(command, cwd=job.parent, env=environment(engine), capture_output=True, check=True)
    return time.perf_counter() - start


def rows_of(folder, name):
    """Rows of the newest table of a name."""
    path = max(folder.glob(f"{name}*.csv"), key=lambda one: one.stat().st_mtime)
    with path.open(encoding="utf-8") as file:
        return list(csv.DictReader(line for line in file if not line.startswith("#")))


def first_of_classes(folder, name):
    """Class -> the row of its first asset, with the number of walls."""
    numbers = {row["id"]: float(row["number"]) for row in rows_of(folder, "exposure")}
    found = {}
    for row in rows_of(folder, name):
        found.setdefault(row["taxonomy"], (row, numbers[row["asset_id"]]))
    return found


def widest(pairs):
    """Largest deviation of the first numbers from the second, with its sign."""
    return max((one / other - 1.0 for one, other in pairs), key=abs)


def collapse_frequencies(folder, risks):
    """Pairs of annual frequencies of collapse: of the engine and of dondolo."""
    rows = first_of_classes(folder, "damages-rlz")
    return [(float(row["structural-collapse"]) / number, risks[name]) for name, (row, number) in rows.items()]


def with_levels(engine, results, levels, name):
    """Folder of a job whose hazard, the power law that the table is of, has these levels."""
    folder = OUT / name
    curve = dd.HazardCurve(levels, LAW(levels))
    (file,) = curve.to_openquake(OUT, site=(13.4, 42.35))
    dd.write_openquake(results, folder, site=(13.4, 42.35), hazard=file)
    run_job(engine, folder / "job_damage.ini")
    return folder


def of_reader(engine, functions, fragility):
    """Largest difference of probabilities by the engine's reader from those of `read_nrml`."""
    model = dd.read_nrml(fragility)
    levels = {
        name: np.concatenate([states["collapse"].levels, np.geomspace(0.01, 8.0, 500)]).tolist()
        for name, states in model.functions.items()
    }
    (OUT / "levels.json").write_text(json.dumps(levels), encoding="utf-8")
    command = [engine / "bin/python", ROOT / "docs/openquake_reader.py", fragility, OUT / "levels.json"]
    done = subprocess.run(command, env=environment(engine), capture_output=True, text=True, check=True)
    theirs = json.loads(done.stdout)
    assert set(theirs) == set(functions)
    return max(
        float(np.abs(np.array(theirs[name][state]) - curve(levels[name])).max())
        for name, states in model.functions.items()
        for state, curve in states.items()
    )


def of_many_assets(engine, results, functions):
    """Seconds that dondolo takes to write 10 000 assets, and the engine to compute them."""
    folder = OUT / "many"
    dd.write_openquake(results, folder, site=(13.4, 42.35), hazard=ROOT / "data/hazard/illustrative.csv")
    few = assets_of(results, functions, (13.4, 42.35))
    chosen = np.arange(10_000) % len(few.ids)
    many = few._replace(
        ids=[f"wall_{i}" for i in range(len(chosen))],
        names=[few.names[i] for i in chosen],
        taxonomies=[few.taxonomies[i] for i in chosen],
        places=few.places[chosen],
        numbers=few.numbers[chosen],
        values=few.values[chosen],
    )
    start = time.perf_counter()
    _write_exposure(folder / "exposure.xml", folder / "exposure.csv", many)
    return time.perf_counter() - start, run_job(engine, folder / "job_damage.ini")


def measure(engine, quick):
    """Rows of the table: what, dondolo's or a bound, and how far the engine is from it."""
    results = dd.read_results(ROOT / "out/historic_centre")
    functions, _ = functions_of(results)
    hazard = dd.HazardCurve.from_csv(ROOT / "data/hazard/illustrative.csv")
    names = {name.partition("/")[0]: name for name in functions if not name.startswith("population/")}
    curves = {group: results.typology[name.partition("/")[2], group] for group, name in names.items()}
    risks = {group: curve.risk(hazard).annual_frequency for group, curve in curves.items()}
    job = OUT / "job"
    used = {name: functions[name] for name in names.values()}
    rows = [
        ("probabilities of all states, by the engine's reader", f"{of_reader(engine, used, job / 'fragility.xml'):.1g}")
    ]

    def row(what, pairs):
        rows.append((what, f"{100.0 * widest(pairs):+.2f} %"))

    row("annual frequency of collapse, levels of the job", collapse_frequencies(job, risks))
    risks = {group: curve.risk(LAW).annual_frequency for group, curve in curves.items()}
    states = {group: functions[name] for group, name in names.items()}
    ends = [(one["collapse"].levels[0], one["collapse"].levels[-1]) for one in states.values()]
    low, high = min(low for low, _ in ends), max(high for _, high in ends)
    for what, levels in (
        ("20 levels that the engine suggests", np.geomspace(low, high, 20)),
        ("60 levels", np.geomspace(low, high, 60)),
        ("300 levels", np.geomspace(low, 6.0 * high, 300)),
    ):
        if not quick or len(levels) < 100:
            row(
                f"the same, {what}",
                collapse_frequencies(with_levels(engine, results, levels, f"job_{len(levels)}"), risks),
            )
    alone = []
    for group, (first, last) in zip(states, ends, strict=True):
        folder = with_levels(engine, results, np.geomspace(first, last, 20), "job_20")
        row_of, number = first_of_classes(folder, "damages-rlz")[group]
        alone.append((float(row_of["structural-collapse"]) / number, risks[group]))
    row("the same, 20 levels that it suggests for one group alone", alone)
    losses = {}
    for group, of in states.items():
        shares = np.diff([0.0, *RATIOS.values()])
        frequencies = [of[state].risk(hazard).annual_frequency for state in RATIOS]
        losses[group] = float(shares @ frequencies)
    found = first_of_classes(job, "avg_losses")
    row(
        "mean annual loss, classical_risk",
        [(float(one["structural"]) / n, losses[group]) for group, (one, n) in found.items()],
    )
    scenario = first_of_classes(OUT / "scenario", "avg_damages")
    expected = {group: states[group]["collapse"].scenario(MEDIAN, DISPERSION) for group in states}
    row(
        "collapse in the scenario",
        [(float(one["structural-collapse"]) / n, expected[group]) for group, (one, n) in scenario.items()],
    )
    if not quick:
        ours, theirs = of_many_assets(engine, results, functions)
        rows.append(("10 000 assets: seconds to write the exposure, and of the engine", f"{ours:.1f}, {theirs:.0f}"))
    return rows


def main():
    engine, quick = Path(sys.argv[1]).resolve(), "--quick" in sys.argv[2:]
    warnings.simplefilter("ignore", dd.errors.DondoloWarning)
    run_page(engine)
    lines = ["| | engine minus dondolo |\n", "|---|---|\n"]
    lines += [f"| {what} | {number} |\n" for what, number in measure(engine, quick)]
    print("".join(lines))
    if quick:
        (OUT / "numbers.md").write_text("".join(lines), encoding="utf-8")
        return
    head, _, rest = STUDY.read_text(encoding="utf-8").partition(MARKS[0])
    tail = rest.partition(MARKS[1])[2]
    STUDY.write_text("".join([head, MARKS[0], *lines, MARKS[1], tail]), encoding="utf-8")


if __name__ == "__main__":
    main()
