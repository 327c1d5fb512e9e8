"""Cases as text: written with comments, read from memory, and the same to the bit."""

from __future__ import annotations

import numpy as np
import pytest

import dondolo as dd
from dondolo.exchange.case_text import case_text

# Circolare 7/2019 takes each record in one direction in some of them
pytestmark = pytest.mark.filterwarnings("ignore:&check")

READY = ("facade", "facade_strip", "gable", "garden_wall", "history", "parapet", "parapet_on_building", "pinnacle")
ALL = (
    *(*READY, "compound", "corner", "elevation", "panel", "tied_facade", "two_block", "facade_hinges"),
    *("elastic_strip", "uncertain_strip"),
)


@pytest.fixture(scope="module")
def catalogue(root):
    """The synthetic accelerograms."""
    return root / "data/records/synthetic44.csv"


@pytest.mark.parametrize("name", ALL)
def test_settings_make_the_same_case(name, root, records):
    """The groups of a case, written with comments and read from memory, are the case: every wall to the bit."""
    path = root / f"data/cases/{name}.nml"
    with_files = dd.read_case(path)
    again = dd.results.Case.from_text(path.read_text(), records, name=f"{name}.nml")
    written = dd.results.Case.from_text(case_text(with_files.settings, commented=True), records)
    for other in (again, written):
        assert other.settings == with_files.settings
        for one, two in zip(other.population, with_files.population, strict=True):
            assert one._properties() == two._properties()
            assert one._statics == two._statics
    assert [record.checksum for record in with_files.records] == [record.checksum for record in records]


@pytest.mark.parametrize("name", ["designs", "facades", "historic_centre", "population"])
def test_files_of_a_text_are_not_opened(name, root, records):
    """A case from memory opens no file: neither its table of walls nor its catalogue."""
    text = (root / f"data/cases/{name}.nml").read_text()
    with pytest.raises(dd.errors.InputError, match=r"^case\.nml: &population: file = .*: no file is read"):
        dd.results.Case.from_text(text, records)


def test_texts_that_are_refused(records, sine):
    """What is wrong with a text is said with its name, its line, and what is allowed."""
    wall = "&wall mechanism = 'one_sided', height = 1.5, thickness = 0.25 /\n"
    end = "&stripes levels = 0.5, 1 /\n"
    given = "&records catalogue = '/etc/passwd' /\n"
    assert dd.results.Case.from_text(wall + given + end, records).levels.tolist() == [0.5, 1.0]
    for text, match in {
        "": r"case\.nml: the file is empty",
        "\0": r"case\.nml: ",
        wall.replace("1.5", "-1") + given + end: r"case\.nml: &wall: height = -1.*line 1",
        wall.replace("one_sided', h", "tabulated', table = '/etc/passwd', h") + given + end: "no file is read",
        wall + given.replace(" /\n", ", vertical = 'recorded' /\n") + end: "given have no vertical components",
        " " * 2**20 + wall: "must be at most 1048576",
    }.items():
        with pytest.raises(dd.errors.InputError, match=match):
            dd.results.Case.from_text(text, records)
    with pytest.raises(dd.errors.InputError, match="levels of their own"):
        dd.results.Case.from_text(wall + given + end, dd.RecordSet([sine], level=[0.5]))
    with pytest.raises(dd.errors.InputError, match="text: must be a string") as error:
        dd.results.Case.from_text(b"", records)
    assert error.value.errors[0][1:] == ("wrong_type", "text", "")


def _random_wall(rng: np.random.Generator) -> dd.Wall:
    """A wall of any kind, with numbers of many digits."""
    height, thickness = rng.uniform(1.5, 8.0), rng.uniform(0.2, 0.8)
    common = {"density": rng.uniform(1500.0, 2200.0), "name": f"l'angolo {rng.integers(100)}"}
    kind = rng.integers(4)
    if kind == 0:
        bearing = {"overburden": rng.uniform(1e3, 2e4), "eccentricity": rng.uniform(-0.1, 0.1) * thickness}
        own = {"hinge": rng.uniform(0.4, 0.7), "overburden_inertia": 0.5, **bearing}
        return dd.TwoBlockWall(height, thickness, **own, **common)
    if kind == 1:
        return dd.FreeStandingWall(height, thickness, restitution_value=rng.uniform(0.8, 0.95), **common)
    loads = [dd.Load(rng.uniform(1e3, 2e4), depth=0.6 * thickness, height=0.9 * height, inertia="both")]
    if kind == 2:
        sections = [dd.Section(rng.uniform(2.0, 3.0), thickness), dd.Section(rng.uniform(2.0, 3.0), 0.7 * thickness)]
        building = dd.Building(rng.uniform(0.1, 0.6), storeys=2, level=0.0, building_height=6.0)
        return dd.OneSidedWall(sections=sections, building=building, **common)
    ties = [dd.Tie(height=rng.uniform(0.5, 0.9) * height, area=rng.uniform(1e-5, 1e-4), length=rng.uniform(3.0, 9.0))]
    return dd.OneSidedWall(height, thickness, loads=loads, ties=ties, compressive_strength=2e6, **common)


@pytest.mark.parametrize("seed", range(40))
def test_walls_are_written_to_the_bit(seed, catalogue, records, tmp_path):
    """A random wall and study, written as a case and read again, are the same to the bit."""
    rng = np.random.default_rng(seed)
    wall = _random_wall(rng)
    solver = dd.Solver(rtol=rng.uniform(1e-9, 1e-7), edp_limit=float(rng.choice([0.5, 1.0])))
    study = dd.Study(
        records,
        np.sort(rng.uniform(0.1, 2.0, 5)),
        im="sa(0.5)",
        polarity=rng.choice(["both", "reversed"]),
        solver=solver,
    )
    dd.write_case(tmp_path / "case.nml", wall, study, catalogue=catalogue)
    case = dd.read_case(tmp_path / "case.nml")
    assert case.population[0]._properties() == wall._properties()
    assert np.array_equal(case.levels, study.levels)
    assert (case.im, case.rtol, case.edp_limit) == ("sa(0.5)", solver.rtol, solver.edp_limit)


def test_a_written_case_runs_to_the_same_curve(catalogue, records, tmp_path):
    """The executable's run of a written case has the curve of the study, and the check its site."""
    wall = dd.OneSidedWall(3.0, 0.3)
    study = dd.Study(records, [0.2, 0.3, 0.45, 0.6, 0.9])
    years = {"reference_life": 50.0, "exceedance": (0.63, 0.1, 0.05)}
    site = dd.Site(ag=[0.08, 0.2, 0.26], f0=[2.4, 2.5, 2.5], tc_star=[0.28, 0.35, 0.36], soil="B", **years)
    check = dd.check_ntc(wall, site, knowledge_factor=1.2)
    dd.write_case(tmp_path / "wall.nml", wall, study, catalogue=catalogue, title="A wall", check=check)
    results = dd.run_case(tmp_path / "wall.nml", progress=False)
    curve = study.run(wall, progress=False).fit()
    assert (results.fragility.theta, results.fragility.beta) == (curve.theta, curve.beta)
    assert results.check.capacities == check.capacities
    assert results.check.site == site
    assert "height = 3" in (tmp_path / "wall.nml").read_text()
    assert "! m: height of the wall" in (tmp_path / "wall.nml").read_text()


ELEVATION = {"elevation_x": [0.0, 6.0, 6.0, 3.0, 0.0], "elevation_z": [0.0, 0.0, 6.0, 7.5, 6.0]}


@pytest.mark.parametrize(
    "wall",
    [
        dd.arch(1.75, 0.5, 180.0, voussoirs=8, density=1900.0, sides=1, restitution_value=0.7),
        dd.horizontal_bending(4.0, 0.45, 1900.0, thrust=25e3, hinge_depth=0.01, sides=2, restitution_value=0.7),
        dd.OneSidedWall(thickness=0.5, facade_length=6.0, restitution_value=0.5, hinge_depth=0.02, **ELEVATION),
        dd.Corner(3.2, 0.5, wing_angle=20.0, hinge_depth=0.03),
    ],
    ids=lambda wall: wall.mechanism,
)
def test_tables_and_polygons_are_written(wall, catalogue, records, tmp_path):
    """Lists of whole numbers that begin with 0 are read as they are written."""
    study = dd.Study(records, [0.2, 0.4], im="pga")
    dd.write_case(tmp_path / "case.nml", wall, study, catalogue=catalogue)
    assert dd.read_case(tmp_path / "case.nml").population[0]._properties() == wall._properties()


def test_what_a_case_cannot_say_is_refused(catalogue, records, wall, tmp_path):
    """Nothing is written where the case would say something else, nor over a file."""
    study = dd.Study(records, [0.5, 1.0])
    path = tmp_path / "case.nml"
    for other, match in {
        dd.Study(records[:-1], [0.5, 1.0]): "catalogue: has 44 records, others than the 43",
        dd.Study({0.5: records[:9], 1.0: records}): "levels of their own",
    }.items():
        with pytest.raises(dd.errors.InputError, match=match):
            dd.write_case(path, wall, other, catalogue=catalogue)
    with pytest.raises(dd.errors.InputError, match=r"case\.nml: &records: catalogue"):
        dd.write_case(path, wall, study, catalogue="nowhere.csv")
    assert list(tmp_path.iterdir()) == []
    path.write_text("a case")
    with pytest.raises(dd.errors.InputError, match="already exists"):
        dd.write_case(path, wall, study, catalogue=catalogue)
    assert path.read_text() == "a case"
