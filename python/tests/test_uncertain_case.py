"""The group &uncertainty: its sample, its table, what is refused, and Python on the same sample."""

import csv
import html
import subprocess
import sys

import numpy as np
import pytest

import dondolo as dd
from dondolo._fortran.uncertainty import sensitivity

CASE = """&job task = 'typology', output = 'out' /
&wall name = 'strip', mechanism = 'two_block', height = 3.0, thickness = 0.25, hinge = 0.6 /
&uncertainty variants = 60, seed = 3, {sources} /
&records catalogue = '{catalogue}' /
&stripes first = 0.2, last = 3.0, count = 15 /
"""
SOURCES = """restitution_factor = 'graziotti_2016', hinge = 'Triangular(0.5, 0.6, 0.75)',
   hinge_depth = 'lognormal(0.01, 0.4, 0.004, 0.03)', density = 'normal(1800, 90)'"""
SAME = {
    "restitution_factor": dd.distributions.Uniform(0.84, 0.90),
    "hinge": dd.distributions.Triangular(0.5, 0.6, 0.75),
    "hinge_depth": dd.distributions.Lognormal(0.01, 0.4, low=0.004, high=0.03),
    "density": dd.distributions.Normal(1800.0, 90.0),
}


def run(executable, root, folder, sources, change=lambda text: text):
    """Run the case with some sources."""
    text = CASE.format(catalogue=root / "data/records/synthetic44.csv", sources=sources)
    (folder / "case.nml").write_text(change(text))
    return subprocess.run([executable, "case.nml"], cwd=folder, capture_output=True, text=True, check=False)


@pytest.fixture(scope="module")
def ran(executable, root, tmp_path_factory):
    """Folder of the results, and what was printed."""
    folder = tmp_path_factory.mktemp("uncertain")
    done = run(executable, root, folder, SOURCES)
    assert done.returncode == 0, done.stderr
    return folder, done.stdout


def table(path):
    with path.open() as file:
        return list(csv.DictReader(line for line in file if not line.startswith("#")))


def test_sample(ran):
    """Each part of equal probability of each source holds one wall; the order of one says nothing of another."""
    walls = table(ran[0] / "out_walls.csv")[:60]
    for what, column in (
        ("hinge", "hinge"),
        ("density", "density_kg_m3"),
        ("restitution_factor", "restitution_factor"),
    ):
        values = np.sort([float(row[column]) for row in walls])
        ends = SAME[what].ppf(np.arange(61) / 60.0)
        assert (ends[:-1] <= values).all()
        assert (values <= ends[1:]).all()
    hinges, densities = (np.array([float(row[what]) for row in walls]) for what in ("hinge", "density_kg_m3"))
    assert abs(np.corrcoef(hinges, densities)[0, 1]) < 0.4


def test_quantiles(ran):
    """Fractiles of the distributions, against SciPy."""
    for row in table(ran[0] / "out_sources.csv"):
        values = [float(row[f"value_{share}"]) for share in (5, 50, 95)]
        expected = SAME[row["source"]].ppf(np.array([0.05, 0.5, 0.95]))
        assert values == pytest.approx(expected, rel=1e-12)


def test_python_on_the_same_sample(ran):
    """Counts, curves, dispersions and indices are those of Python for the walls of the case."""
    folder, printed = ran
    case = dd.read_case(folder / "case.nml")
    assert case.population.weights.tolist() == [1.0] * 60 + [0.0] * 10
    assert [wall.name for wall in case.population][59:64] == [
        "strip 0060", "strip", "strip, medians", "strip, restitution_factor at 5%", "strip, restitution_factor at 95%",
    ]  # fmt: skip
    found = dd.typology(case.population, case.records, case.levels, progress=False)
    stored = table(folder / "out_fragility.csv")
    assert [float(row["theta"]) for row in stored] == [curve.theta for curve in found.curves]
    (whole,) = table(folder / "out_typology.csv")[:1]
    assert float(whole["beta_walls"]) == pytest.approx(found["all"].beta_walls, rel=1e-12)
    rows = table(folder / "out_sources.csv")
    values = np.array([[getattr(wall, row["source"]) for row in rows] for wall in case.population.walls[:60]])
    indices = sensitivity(values, np.log([curve.theta for curve in found.curves[:60]]))
    for k, row in enumerate(rows):
        assert float(row["theta_5"]) == found.curves[62 + 2 * k].theta
        assert float(row["theta_95"]) == found.curves[63 + 2 * k].theta
        assert float(row["first"]) == pytest.approx(indices.first[k], abs=1e-12)
        assert float(row["total_high"]) == pytest.approx(indices.total_interval[k, 1], abs=1e-12)
    given = dd.TwoBlockWall(3.0, 0.25, hinge=0.6, name="strip")
    assert found.walls[60] == given
    assert f"theta of the wall as given {found.curves[60].theta:.4g}" in printed


def test_results_read_back(ran):
    """What the curve owes to each source, read back, drawn and reported."""
    folder, _ = ran
    rows = table(folder / "out_sources.csv")
    found = dd.read_results(folder / "out").uncertain
    assert found.sources == tuple(SAME)
    for k, row in enumerate(rows):
        assert found.distributions[k] == row["distribution"]
        assert found.values[k].tolist() == [float(row[f"value_{share}"]) for share in (5, 50, 95)]
        assert [curve.theta for curve in found.ends[k]] == [float(row["theta_5"]), float(row["theta_95"])]
        assert (found.first[k], found.total[k]) == (float(row["first"]), float(row["total"]))
        assert found.total_interval[k].tolist() == [float(row["total_low"]), float(row["total_high"])]
    assert len(found.sample) == 60
    assert found.as_given.theta == dd.read_results(folder / "out").typology.curves[60].theta
    _, right = found.plot().figure.axes
    labels = [text.get_text().split(",")[0] for text in right.texts if not text.get_text().endswith("%")]
    assert "records" in labels
    assert "numerical error" not in labels
    assert len(labels) == len(found.sources) + 1
    command = [sys.executable, "-m", "dondolo"]
    done = subprocess.run([*command, "plot", "out"], cwd=folder, capture_output=True, text=True, check=True)
    assert "drawn: out_uncertainty.png" in done.stdout
    subprocess.run([*command, "report", "out"], cwd=folder, capture_output=True, check=True)
    page = (folder / "out_report.html").read_text(encoding="utf-8")
    assert "Uncertainty of the model" in page
    for row in rows:
        assert row["distribution"] in html.unescape(page)
        assert f"{float(row['theta_5']):#.4g}" in page
    assert f"{found.beta_model:.3g}" in page


def test_results_without_indices_read_back(executable, root, tmp_path):
    run(executable, root, tmp_path, SOURCES, lambda text: text.replace("0.2, last = 3.0", "0.01, last = 0.1"))
    found = dd.read_results(tmp_path / "out").uncertain
    assert np.isnan(found.first).all()
    dd.report(dd.read_results(tmp_path / "out"), tmp_path / "page.html")
    assert "There are no indices" in (tmp_path / "page.html").read_text(encoding="utf-8")


def test_same_bytes(ran, executable, root, tmp_path):
    """The same seed gives the same results, on one thread too; another seed another sample."""

    def bodies(folder):
        return [(folder / f"out_{what}.csv").read_text().split("\n", 2)[2] for what in ("fragility", "sources")]

    one = run(executable, root, tmp_path, SOURCES, lambda text: text.replace("&job", "&job threads = 1,"))
    assert one.returncode == 0
    first, sources = bodies(ran[0])
    assert bodies(tmp_path)[0].split("\nwall")[1:] == first.split("\nwall")[1:]
    assert bodies(tmp_path)[1].split("\nsource,")[1] == sources.split("\nsource,")[1]
    run(executable, root, tmp_path, SOURCES, lambda text: text.replace("seed = 3", "seed = 4"))
    assert bodies(tmp_path)[1].split("\nsource,")[1] != sources.split("\nsource,")[1]


def test_parts(ran, executable, root, tmp_path):
    """Parts of the sample taken together give the tables of one run, indices included."""
    text = CASE.format(catalogue=root / "data/records/synthetic44.csv", sources=SOURCES)
    (tmp_path / "case.nml").write_text(text)
    for rows in ("1:33", "34:70"):
        part = subprocess.run([executable, "--walls", rows, "case.nml"], cwd=tmp_path, capture_output=True, check=False)
        assert part.returncode == 0
    parts = sorted(path.name for path in tmp_path.glob("out_walls_*.counts"))
    assert len(parts) == 2
    done = subprocess.run([executable, "--merge", "case.nml", *parts], cwd=tmp_path, capture_output=True, check=False)
    assert done.returncode == 0
    assert table(tmp_path / "out_sources.csv") == table(ran[0] / "out_sources.csv")


def test_levels_without_medians(executable, root, tmp_path):
    """Where too few variants have a curve there are no indices, and the summary says why."""
    done = run(executable, root, tmp_path, SOURCES, lambda text: text.replace("0.2, last = 3.0", "0.01, last = 0.1"))
    assert done.returncode == 0, done.stderr
    assert "no indices: 0 samples with a curve: must be at least 38 for indices of 4 quantities" in done.stdout
    assert {row["first"] for row in table(tmp_path / "out_sources.csv")} == {""}


@pytest.mark.parametrize(
    ("sources", "change", "message"),
    [
        ("hinge = 'uniform(0.5)'", None, "hinge = 'uniform(0.5)': must be 'uniform(low, high)'"),
        ("hinge = 'uniform(0.6, 0.5)'", None, "hinge = 'uniform(0.6, 0.5)': must be"),
        ("hinge = 'beta(2, 3)'", None, "hinge = 'beta(2, 3)': must be"),
        ("hinge = 'normal(0.6, 0.1'", None, "hinge = 'normal(0.6, 0.1': must be"),
        ("hinge = 'normal(0.6, x)'", None, "hinge = 'normal(0.6, x)': must be"),
        ("hinge = 'graziotti_2016'", None, "hinge = 'graziotti_2016': must be"),
        (
            "restitution_factor = 'graziotti_2016'",
            lambda text: text.replace("'two_block'", "'one_sided'").replace(", hinge = 0.6", ""),
            "restitution_factor = 'graziotti_2016': is of tests of mechanism = 'two_block'",
        ),
        (
            "restitution_factor = 'elgawady_2010'",
            None,
            "restitution_factor = 'elgawady_2010': is of tests of mechanism = 'free_standing'",
        ),
        (
            "restitution_factor = 'Graziotti_2016'",
            lambda text: text.replace("hinge = 0.6 /", "hinge = 0.55, restitution = 'impulse' /"),
            "is a ratio to restitution = 'sorrentino', must be a range or distribution for 'impulse'; the same speeds",
        ),
        (
            "restitution_factor = 'graziotti_2016', overburden = 'uniform(3e3, 6e3)'",
            lambda text: text.replace("hinge = 0.6 /", "hinge = 0.55, overburden_inertia = 1 /"),
            "for 'impulse', the model of a wall that lifts the mass of its overburden",
        ),
        ("restitution_factor = 'nobody'", None, "or a published range: 'graziotti_2016', 'elgawady_2010'"),
        ("hinge = 'normal(nan, 0.1)'", None, "hinge = 'normal(nan, 0.1)': must be"),
        ("", lambda text: text.replace("seed = 3, ", "seed = 3"), "a property must have a distribution"),
        ("hinge = 'uniform(0.9, 1.2)'", None, "&uncertainty: variant 'strip 00"),
        ("thick = 'uniform(0.9, 1.2)'", None, "thick"),
        (SOURCES, lambda text: text.replace("variants = 60", "variants = 20"), "variants = 20: must be at least 38"),
        (
            SOURCES,
            lambda text: text.replace("'typology'", "'stripes'"),
            "&uncertainty (line 3): only for task = 'typology'",
        ),
        (
            SOURCES,
            lambda text: text + "&population file = 'walls.csv' /\n",
            "&uncertainty (line 3): takes &wall in place of &population",
        ),
        (
            SOURCES,
            lambda text: text.replace("'two_block'", "'one_sided', hinge_level = 0.0, 1.0").replace(
                ", hinge = 0.6 /", " /"
            ),
            "not with hinge_level",
        ),
    ],
)
def test_refused(executable, root, tmp_path, sources, change, message):
    done = run(executable, root, tmp_path, sources, change or (lambda text: text))
    assert done.returncode != 0
    assert message in done.stderr
    assert not list(tmp_path.glob("out*"))
