"""Files that Python writes: whole or not at all, and read back."""

import dataclasses
import os
import subprocess
import sys

import numpy as np
import pytest
from dondolo._files import whole_file

import dondolo as dd
from dondolo import _binding, tables

pytestmark = pytest.mark.filterwarnings("ignore::dondolo.errors.DondoloWarning")


def half(path, error):
    """Begin to write a file, and fail."""
    with whole_file(path) as part:
        part.write_text("half")
        raise error


def test_a_file_appears_whole_or_not_at_all(tmp_path):
    path = tmp_path / "table.csv"
    path.write_text("before")
    for error in (RuntimeError, KeyboardInterrupt):
        with pytest.raises(error):
            half(path, error)
    with pytest.raises(dd.DondoloError, match="cannot be written: No space left"):
        half(path, OSError(28, "No space left on device"))
    # What cannot be encoded leaves nothing behind either.
    with pytest.raises(UnicodeEncodeError):
        tables.write_lines(path, ["a\udc80b"])
    assert (path.read_text(), os.listdir(tmp_path)) == ("before", ["table.csv"])
    with whole_file(path) as part:
        part.write_text("after")
    assert (path.read_text(), os.listdir(tmp_path)) == ("after", ["table.csv"])


@pytest.fixture(scope="module")
def people(few):
    walls = [
        dd.OneSidedWall(1.5, 0.25, name="a", gravity=9.7),
        dd.TwoBlockWall(3.0, 0.25, name="a", gravity=9.7),
        dd.OneSidedWall(2.0, 0.30, name="b, with a comma", gravity=9.7),
    ]
    population = dd.Population(walls, [2.0, 2.0, 1.0], ["low", "low", "high"], [0.6, 0.5, 1.0])
    levels = [0.2, 0.4, 0.6, 0.8, 1.0, 1.2]
    return dd.typology(population, few, levels, polarity="both", edp_thresholds=[0.3], progress=False)


def test_a_typology_is_saved_and_read_back(people, tmp_path):
    prefix = tmp_path / "city"
    people.save(prefix)
    assert sorted(os.listdir(tmp_path)) == [
        f"city_{name}.csv" for name in ("fragility", "stripes", "typology", "walls")
    ]
    stored = dd.read_results(prefix)
    again = stored.typology
    assert again.population.walls == people.population.walls
    assert np.array_equal(again.exceedances, people.exceedances)
    assert np.array_equal(again.mean_curve, people.mean_curve)
    assert [curve.fit.theta for curve in again.groups] == [curve.fit.theta for curve in people.groups]
    assert (again.work, again.warnings) == (people.work, people.warnings)
    assert people.warnings
    for command, made in (("nrml", "fragility.xml"), ("report", "report.html"), ("plot", "typology.png")):
        done = subprocess.run(
            [sys.executable, "-m", "dondolo", command, str(prefix)], capture_output=True, text=True, check=False
        )
        assert done.returncode == 0, done.stderr
        assert (tmp_path / f"city_{made}").is_file()
    assert people.warnings[0] in (tmp_path / "city_report.html").read_text().replace("&#x27;", "'")


def test_nothing_of_an_earlier_run_is_left(people, tmp_path):
    for name in ("histories", "history", "typology"):
        (tmp_path / f"city_{name}.csv").write_text("# dondolo 0.0.1\nwall\n")
    (tmp_path / "cities_history.csv").write_text("# dondolo 0.0.1\nwall\n")
    people.save(tmp_path / "city")
    kept = [f"city_{name}.csv" for name in ("fragility", "stripes", "typology", "walls")]
    assert sorted(os.listdir(tmp_path)) == ["cities_history.csv", *kept]
    # What dondolo did not write is not its own to remove.
    (tmp_path / "city_history.csv").write_text("The history of the city\n")
    people.save(tmp_path / "city")
    assert (tmp_path / "city_history.csv").read_text() == "The history of the city\n"
    # A table that cannot be written leaves the others as they were.
    before = (tmp_path / "city_typology.csv").read_bytes()
    (tmp_path / "city_walls.csv").unlink()
    (tmp_path / "city_walls.csv").mkdir()
    changed = dataclasses.replace(people, warnings=("other",))
    with pytest.raises(dd.DondoloError, match=r"city_walls\.csv: cannot be written"):
        changed.save(tmp_path / "city")
    assert (tmp_path / "city_typology.csv").read_bytes() == before
    assert not list(tmp_path.glob("*.part"))


def test_files_have_the_names_and_columns_of_the_executable(run, root, tmp_path):
    case = root / "data/cases/population.nml"
    assert run("--quiet", case).returncode == 0
    # The same build variant, so that digits agree
    assert _binding.build_variant() in run("--version").stdout
    dd.run_case(case, progress=False).typology.save(tmp_path / "mine")
    for table in ("walls", "stripes", "fragility", "typology"):
        rows = [
            [line for line in (tmp_path / name).read_text().splitlines() if not line.startswith("#")]
            for name in (f"mine_{table}.csv", f"out/population_{table}.csv")
        ]
        assert rows[0] == rows[1]


def test_what_cannot_be_saved(people, few, tmp_path):
    walls = [dd.OneSidedWall(1.5, 0.25, name="a", gravity=9.7), dd.OneSidedWall(1.5, 0.25, name="b")]
    uneven = dd.typology(walls, few, [0.4, 0.8], progress=False)
    with pytest.raises(dd.InputError, match=r"gravity = 9\.7 and 9\.81: must be the same for all walls"):
        uneven.save(tmp_path / "city")
    assert not os.listdir(tmp_path)
    with pytest.raises(dd.InputError, match="prefix = 5: must be the path of a file"):
        people.save(5)
    with pytest.raises(dd.InputError, match=r"prefix = '.*/': must be the path of a file"):
        people.save(f"{tmp_path}/")
