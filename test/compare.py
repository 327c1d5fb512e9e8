"""Compare two installations of dondolo: python compare.py OLD NEW, the folders that hold bin/dondolo and bin/python.

Every number in the result files of the histories of test/reference and of data/cases must be the same to the bit, in
the columns that both have. Then both are timed in alternating pairs: the ratios are of CPU time, new over old.
"""

import os
import resource
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "docs" / "verification"))

from cases import WALLS, motions, read_table, write_case  # noqa: E402

CASES = sorted(path.stem for path in (ROOT / "data" / "cases").glob("*.nml"))
PAIRS = 11

# Walls of the timed population; a name, sizes that vary, and every third with a second mechanism
POPULATION = 1000

PYTHON = """
import resource, sys, warnings, numpy, dondolo as dd
warnings.simplefilter("ignore")
records = dd.read_catalogue(sys.argv[1])
walls = [dd.OneSidedWall(3.0, 0.25), dd.TwoBlockWall(3.0, 0.25, hinge=0.6, restitution_factor=0.87)]
dd.multiple_stripe(walls[0], records, levels=[0.5], threads=1, progress=False)
spent = lambda: resource.getrusage(resource.RUSAGE_SELF).ru_utime
start = spent()
for _ in range(5):
    for wall in walls:
        dd.multiple_stripe(wall, records, levels=numpy.linspace(0.05, 1.0, 20), threads=1, progress=False)
print(spent() - start)
"""


def run(installation, case, folder):
    """Run a case in a folder, and return the CPU time in seconds; None where this installation cannot read it."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run(
        [installation / "bin" / "dondolo", "--quiet", case], cwd=folder, capture_output=True, text=True
    )
    if done.returncode == 2:
        print(done.stderr.strip())
        return None
    done.check_returncode()
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def tables(folder):
    """The result tables in a folder and below it."""
    return {path.relative_to(folder): read_table(path) for path in sorted(folder.rglob("*.csv"))}


def differences(old, new):
    """Yield the differences between the tables of two runs, and lines on what only one of them has."""
    for name in sorted(old.keys() | new.keys()):
        if name not in old or name not in new:
            yield f"{name}: only in the {'old' if name in old else 'new'} results"
            continue
        first, second = old[name], new[name]
        if len(first) != len(second):
            yield f"{name}: {len(first)} and {len(second)} rows"
            continue
        for column in first[0].keys() & second[0].keys() if first else ():
            pairs = enumerate(zip(first, second, strict=True))
            changed = [i for i, (before, after) in pairs if before[column] != after[column]]
            if changed:
                i = changed[0]
                yield (
                    f"{name}: {column} differs in {len(changed)} of {len(first)} rows, "
                    f"first in row {i + 1}: {first[i][column]} and {second[i][column]}"
                )


def population(path):
    """Write the walls that are timed."""
    lines = ["name,mechanism,height,thickness,hinge"]
    for i in range(POPULATION):
        sizes = f"{2.5 + 1.5 * (i * 0.618034 % 1.0):.4f},{0.2 + 0.3 * (i * 0.414214 % 1.0):.4f}"
        lines.append(f"w{i},one_sided,{sizes},")
        if i % 3 == 0:
            lines.append(f"w{i},two_block,{sizes},0.6")
    path.write_text("\n".join(lines) + "\n")


def cases(folder, sets):
    """Write every case that is compared; their paths by name."""
    paths = {f"data/cases/{name}.nml": ROOT / "data" / "cases" / f"{name}.nml" for name in CASES}
    for name, each in sets.items():
        for wall in WALLS:
            for engine in ("lanes", "rk45"):
                place = folder / f"{wall}_{name}_{engine}"
                place.mkdir()
                path = write_case(place, wall, each, 1e-8, solver=f"engine = '{engine}'")
                path.write_text(path.read_text().replace(f"'{place}/result'", "'result'"))
                paths[place.name] = path
    return paths


def compare(old, new, folder, paths):
    """Compare the results of every case; the number of differences."""
    count = 0
    for name, case in paths.items():
        results = []
        for which, installation in enumerate((old, new)):
            place = folder / f"{which}_{case.parent.name}_{case.stem}"
            place.mkdir()
            if run(installation, case, place) is not None:
                results.append(tables(place))
        if len(results) < 2:
            print(f"{name}: not compared", flush=True)
            continue
        found = list(differences(*results))
        count += len(found)
        rows = sum(map(len, results[0].values()))
        print(f"{name}: {rows} rows, {'the same to the bit' if not found else f'{len(found)} differences'}", flush=True)
        for line in found:
            print(f"   {line}")
    return count


def ratio(name, times):
    """Print the ratio of the CPU times of alternating pairs."""
    pairs = [new / old for old, new in times]
    print(
        f"{name}: new/old = {statistics.median(pairs):.3f} (from {min(pairs):.3f} to {max(pairs):.3f} in {len(pairs)}"
        f" pairs), old {statistics.median(old for old, _ in times):.3f} s"
    )


def alternate(work):
    """Times of pairs, every second one in the other order."""
    for pair in range(PAIRS):
        order = (0, 1) if pair % 2 == 0 else (1, 0)
        times = {which: work(which) for which in order}
        yield times[0], times[1]


def measure(installations, folder, paths, catalogue):
    """Time the executable on one wall and on a population, and the Python package on two walls."""
    os.environ["OMP_NUM_THREADS"] = "1"
    population(folder / "walls.csv")
    (folder / "population.nml").write_text(
        "&job task = 'typology' output = 'result' /\n&population file = 'walls.csv' /\n"
        f"&records catalogue = '{catalogue}' /\n&stripes first = 0.2, last = 1.2, count = 6 /\n"
    )
    name = next(name for name in paths if name.startswith("one_sided") and name.endswith("lanes"))
    for title, case in ((f"executable, {name}", paths[name]), ("executable, population", folder / "population.nml")):
        ratio(title, list(alternate(lambda which, case=case: run(installations[which], case, folder))))

    def python(which):
        command = [installations[which] / "bin" / "python", "-c", PYTHON, catalogue]
        return float(subprocess.run(command, cwd=folder, check=True, capture_output=True, text=True).stdout)

    ratio("Python, multiple_stripe of two walls", list(alternate(python)))


def main():
    """Compare, then measure."""
    old, new = (Path(path).resolve() for path in sys.argv[1:3])
    sets = motions(os.environ.get("DONDOLO_RECORDS", "none"))
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        paths = cases(folder, sets)
        count = compare(old, new, folder, paths)
        measure((old, new), folder, paths, next(iter(sets.values())).catalogue)
    print(f"{count} differences")
    return min(count, 1)


if __name__ == "__main__":
    sys.exit(main())
