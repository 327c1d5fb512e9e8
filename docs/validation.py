"""Run the main job on recorded accelerograms and write docs/validation.md from what came out.

usage: validation.py EXECUTABLE RECORDS

EXECUTABLE is dondolo, RECORDS the folder that holds italy44.csv (44 recorded Italian components).
Only the standard library is needed.
"""

import csv
import platform
import re
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

WALLS = {
    "one-sided wall, H = 3 m, t = 0.25 m": "mechanism = 'one_sided' height = 3.0 thickness = 0.25",
    "two-block wall, H = 3 m, t = 0.25 m, hinge 0.6, restitution factor 0.87": (
        "mechanism = 'two_block' height = 3.0 thickness = 0.25 hinge = 0.6 restitution_factor = 0.87"
    ),
}
TOLERANCES = ((1e-6, 1e-8), (1e-8, 1e-10), (1e-10, 1e-12))
REPEATS = 5

HEAD = """# Validation: the main job on recorded accelerograms

44 horizontal components recorded in Italy from 1976 to 2016 (22 stations of the collection of Kallioras, Graziotti and
Magenes 2025, CC BY 4.0; not part of this repository), each scaled to 20 levels of peak ground acceleration from 0.05 to
1.00 g: 880 histories a wall. Every number below was written by `./run validation`, which runs the executable at three
tolerances (rtol; atol = rtol/100) with the engine rk45 on one thread. Times are medians of {repeats} runs on
{machine}, without the reading of files, and inform only.

How far these results are from the exact motion is the subject of the verification; here they are compared with
themselves at the tightest of the three tolerances.
"""


def table(path):
    """Rows of one of dondolo's result files."""
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(line for line in file if not line.startswith("#")))


def run(executable, records, wall, rtol, atol, folder):
    """Results and seconds of one case."""
    case = folder / "case.nml"
    case.write_text(
        f"&job task = 'stripes' output = '{folder}/result' threads = 1 /\n"
        f"&wall {wall} /\n"
        f"&records catalogue = '{records.resolve()}/italy44.csv' /\n"
        "&stripes first = 0.05 last = 1.0 count = 20 /\n"
        f"&solver rtol = {rtol} atol = {atol} /\n",
        encoding="utf-8",
    )
    seconds = []
    for _ in range(REPEATS):
        output = subprocess.run([executable, case], check=True, capture_output=True, text=True).stdout
        seconds.append(float(re.search(r"histories in +([0-9.]+) s", output).group(1)))
    return {
        "histories": table(folder / "result_histories.csv"),
        "stripes": table(folder / "result_stripes.csv"),
        "fragility": table(folder / "result_fragility.csv")[0],
        "seconds": statistics.median(seconds),
    }


def differences(results, reference):
    """How far one run is from another: largest EDP difference, how many above 1e-6, flags that differ."""
    pairs = list(zip(results["histories"], reference["histories"], strict=True))
    gaps = [abs(float(a["edp"]) - float(b["edp"])) for a, b in pairs]
    flags = sum(a["collapsed"] != b["collapsed"] for a, b in pairs)
    worst = max(range(len(gaps)), key=gaps.__getitem__)
    return gaps[worst], pairs[worst][0], sum(gap > 1e-6 for gap in gaps), flags


def section(name, runs):
    """The page's part on one wall."""
    lines = [f"## {name[0].upper()}{name[1:]}", ""]
    lines += ["| rtol | θ, g | standard error of ln θ | β | standard error of β | status | collapses | seconds |"]
    lines += ["|---|---|---|---|---|---|---|---|"]
    for rtol, result in runs.items():
        fit = result["fragility"]
        total = sum(int(row["collapses"]) for row in result["stripes"])
        lines.append(
            f"| {rtol:.0e} | {float(fit['theta']):.9f} | {float(fit['se_ln_theta']):.6f} | {float(fit['beta']):.9f} "
            f"| {float(fit['se_beta']):.6f} | {fit['status']} | {total} | {result['seconds']:.2f} |"
        )
    tightest = runs[min(runs)]
    lines += ["", "| rtol | largest difference of EDP from the tightest | in | above 1e-6 | flags that differ |"]
    lines += ["|---|---|---|---|---|"]
    for rtol in sorted(runs, reverse=True)[:-1]:
        gap, row, many, flags = differences(runs[rtol], tightest)
        where = f"{row['record']} at {float(row['im_level']):.2f} g, EDP {float(row['edp']):.4f}" if gap > 0.0 else "-"
        lines.append(f"| {rtol:.0e} | {gap:.1e} | {where} | {many} of {len(tightest['histories'])} | {flags} |")
    lines += ["", "Collapses of 44, the same at " + same_collapses(runs) + ":", ""]
    for half in (tightest["stripes"][:10], tightest["stripes"][10:]):
        lines.append("| PGA, g | " + " | ".join(f"{float(row['im_level']):.2f}" for row in half) + " |")
        lines.append("|---|" + "---|" * len(half))
        lines.append("| collapses | " + " | ".join(row["collapses"] for row in half) + " |")
        lines.append("")
    return lines


def same_collapses(runs):
    """Say at which tolerances the counts agree; stop if they do not, since the page is written for agreement."""
    counts = {tuple(row["collapses"] for row in result["stripes"]) for result in runs.values()}
    if len(counts) != 1:
        sys.exit("validation: the collapses depend on the tolerance; the page must be rewritten")
    return "all three tolerances"


def main():
    """Run everything and write the page."""
    executable, records = sys.argv[1], Path(sys.argv[2])
    if not (records / "italy44.csv").is_file():
        sys.exit(f"validation: {records / 'italy44.csv'} is not there; DONDOLO_RECORDS names its folder")
    lines = [HEAD.format(repeats=REPEATS, machine=f"a shared {platform.machine()} machine")]
    for name, wall in WALLS.items():
        runs = {}
        for rtol, atol in TOLERANCES:
            with tempfile.TemporaryDirectory() as folder:
                runs[rtol] = run(executable, records, wall, rtol, atol, Path(folder))
            print(f"{name}: rtol = {rtol:.0e}, {runs[rtol]['seconds']:.2f} s", file=sys.stderr)
        lines += section(name, runs)
    page = Path(__file__).with_name("validation.md")
    page.write_text("\n".join(lines).rstrip() + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
