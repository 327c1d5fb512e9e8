"""Jobs for the OpenQuake engine: what the files have, and with an engine (DONDOLO_OPENQUAKE) what it makes of them."""

import csv
import os
import re
import subprocess
import sys
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest

import dondolo as dd

pytestmark = pytest.mark.filterwarnings("ignore::dondolo.errors.DondoloWarning")

SPACE = "{http://openquake.org/xmlns/nrml/0.5}"
RATIOS = {"edp_0p4": 0.1, "collapse": 1.0}
WALLS = """name,mechanism,height,thickness,weight,group,p_occ,x_lon,x_lat,x_value,x_occupants,x_street
a è,one_sided,1.2,0.25,3,città vecchia,1,11.1,44.2,300,6,Via Po
b,one_sided,1.5,0.25,1,città vecchia,0.8,11.2,44.3,50,0,Via Po
b,two_block,3.0,0.25,1,città vecchia,0.5,11.2,44.3,50,0,Via Po
c,one_sided,1.8,0.25,2,new,1,11.1,44.2,120.5,4,
d,one_sided,1.8,0.25,0,new,1,11.1,44.2,1,1,
"""


@pytest.fixture(scope="module")
def town(records, tmp_path_factory):
    """Prefix of a run."""
    folder = tmp_path_factory.mktemp("town")
    (folder / "walls.csv").write_text(WALLS, encoding="utf-8")
    people = dd.Population.from_csv(folder / "walls.csv")
    found = dd.typology(people, records[:8], [0.3, 0.5, 0.7, 0.9, 1.2, 1.6], edp_thresholds=[0.4], progress=False)
    found.write_results(folder / "town")
    return folder / "town"


@pytest.fixture
def results(town):
    return dd.read_results(town)


def rows_of(path):
    with Path(path).open(newline="", encoding="utf-8") as file:
        return list(csv.DictReader(line for line in file if not line.startswith("#")))


def test_assets_are_the_walls(results, tmp_path):
    files = dd.write_openquake(results, tmp_path / "job")
    names = [Path(file).name for file in files]
    assert names == ["exposure.xml", "exposure.csv", "taxonomy_mapping.csv", "fragility.xml", "job_damage.ini"]
    rows = rows_of(tmp_path / "job/exposure.csv")
    # A wall is one asset, whatever its mechanisms; one of no weight is none.
    assert [row["id"] for row in rows] == ["a__", "b", "c"]
    assert all(re.fullmatch(r"[\w:-]{1,50}", row["id"], re.ASCII) for row in rows)
    assert [row["taxonomy"] for row in rows] == ["città vecchia", "città vecchia", "new"]
    numbers = [[float(row[what]) for what in ("lon", "lat", "number", "structural", "night")] for row in rows]
    assert numbers == [[11.1, 44.2, 3, 300, 6], [11.2, 44.3, 1, 50, 0], [11.1, 44.2, 2, 120.5, 4]]
    model = ElementTree.parse(tmp_path / "job/exposure.xml").getroot()[0]
    assert model.find(f"{SPACE}assets").text == "exposure.csv"
    assert model.find(f"{SPACE}occupancyPeriods").text == "night"
    mapping = rows_of(tmp_path / "job/taxonomy_mapping.csv")
    assert {row["taxonomy"]: row["risk_id"] for row in mapping} == {
        "città vecchia": "città vecchia/all",
        "new": "new/one_sided",
    }
    found = dd.read_nrml(tmp_path / "job/fragility.xml").functions
    assert list(found) == ["città vecchia/all", "new/one_sided"]
    assert all(12 <= len(curve["collapse"].levels) <= 40 for curve in found.values())


def test_jobs(results, tmp_path):
    hazard = dd.HazardCurve.power_law(1e-4, 2.5)
    for name in ("gmf.csv", "sites.csv"):
        (tmp_path / name).write_text(name)
    motion = (tmp_path / "gmf.csv", tmp_path / "sites.csv")
    how = {"hazard": hazard, "ratios": RATIOS, "fatalities": {"edp_0p4": 0.0, "collapse": 0.1}, "motion": motion}
    dd.write_openquake(results, tmp_path / "job", **how)
    damage, risk, scenario = (
        (tmp_path / f"job/job_{name}.ini").read_text(encoding="utf-8") for name in ("damage", "risk", "scenario")
    )
    assert "calculation_mode = classical_damage" in damage
    assert "calculation_mode = classical_risk" in risk
    assert "calculation_mode = scenario_damage" in scenario
    for job in (damage, risk):
        assert "risk_investigation_time = 1\n" in job
        assert int(re.search(r"logscale\(.*, (\d+)\)", job).group(1)) >= 60
        assert "hazard_curves_csv = hazard_curves.csv" in job
    for job in (damage, risk, scenario):
        for line in job.splitlines():
            value = line.partition(" = ")[2]
            if re.search(r"\.(csv|xml)$", value) and not line.startswith("#"):
                assert (tmp_path / "job" / value).is_file(), line
    assert "means per event, not per year" in re.sub(r"\n# ", " ", damage)
    assert "consequence_file" not in damage
    assert "consequence_file = {'taxonomy': 'consequences.csv'}" in scenario
    assert {row["consequence"] for row in rows_of(tmp_path / "job/consequences.csv")} == {"losses", "fatalities"}
    assert (tmp_path / "job/gmfs.csv").read_text() == "gmf.csv"
    # The hazard is the given one, with probabilities that single precision resolves.
    read = dd.HazardCurve.from_openquake(tmp_path / "job/hazard_curves.csv")
    assert len(read.levels) >= 60
    np.testing.assert_allclose(read.annual_frequency, 1e-4 * read.levels**-2.5, rtol=1e-6)
    # A last level, which is never exceeded, makes the engine count what is above the others.
    text = (tmp_path / "job/hazard_curves.csv").read_text(encoding="utf-8")
    last = float(text.splitlines()[1].rpartition("poe-")[2])
    assert read.levels[-1] < last < 1.01 * read.levels[-1]
    assert text.splitlines()[2].rpartition(",")[2] == "0.0"


def test_hazard_of_others(results, tmp_path):
    other = dd.HazardCurve([0.05, 0.5, 3.0], [0.05, 1e-3, 1e-7])
    (file,) = other.to_openquake(tmp_path, site=(11.15, 44.25), investigation_time=30.0)
    dd.write_openquake(results, tmp_path / "job", hazard=file)
    job = (tmp_path / "job/job_damage.ini").read_text(encoding="utf-8")
    assert "investigation_time = 30.0" in job
    # The farthest wall is 0.05 degrees away in both directions, 6.8 km.
    assert 7.0 <= float(re.search(r"asset_hazard_distance = (\S+)", job).group(1)) <= 8.0
    with pytest.raises(dd.errors.InputError, match=r"hazard: is of 'sa\(0\.5\)': must be of 'pga'"):
        dd.write_openquake(results, tmp_path / "other", hazard=dd.HazardCurve.power_law(1e-4, 2.5, im="sa(0.5)"))


def test_folders_of_others_are_refused(results, tmp_path):
    dd.write_openquake(results, tmp_path / "job")
    dd.write_openquake(results, tmp_path / "job", ratios=RATIOS)
    (tmp_path / "mine").mkdir()
    (tmp_path / "mine/job_damage.ini").write_text("[general]\n")
    with pytest.raises(dd.errors.InputError, match="mine: has other files: must be a new or empty folder"):
        dd.write_openquake(results, tmp_path / "mine")
    assert (tmp_path / "mine/job_damage.ini").read_text() == "[general]\n"


def test_refusals(results, stripes, tmp_path):
    stripes.write_results(tmp_path / "wall")
    wall = dd.read_results(tmp_path / "wall")
    with pytest.raises(dd.errors.InputError, match=r"site: must be given \(lon, lat\)"):
        dd.write_openquake(wall, tmp_path / "job")
    with pytest.raises(dd.errors.InputError, match="fatalities: must not be given without a column x_occupants"):
        dd.write_openquake(wall, tmp_path / "job", site=(11.0, 44.0), fatalities={"collapse": 0.1})
    with pytest.raises(dd.errors.InputError, match="motion: must be two files"):
        dd.write_openquake(results, tmp_path / "job", motion=["one.csv"])
    dd.write_openquake(wall, tmp_path / "one", site=(11.0, 44.0))
    assert rows_of(tmp_path / "one/exposure.csv")[0]["structural"] == "1"


def test_command(town, tmp_path):
    def run(*words):
        command = [sys.executable, "-m", "dondolo", "openquake", str(town), *map(str, words)]
        return subprocess.run(command, capture_output=True, text=True, check=False)

    done = run(tmp_path / "job", "--ratios", "edp_0p4=0.1,collapse=1")
    assert done.returncode == 0, done.stderr
    assert done.stdout.splitlines()[-1] == f"written: {tmp_path}/job/job_damage.ini"
    assert (tmp_path / "job/job_risk.ini").is_file()
    for words, sentence in (
        (("--ratios", "collapse"), "--ratios collapse: must be STATE=SHARE, separated by commas"),
        (("--ratios", "collapse=1"), "ratios = collapse: must be a number for each of edp_0p4, collapse"),
        (("--site", "11"), "--site 11: must be LON,LAT"),
    ):
        done = run(tmp_path / "job", *words)
        assert done.returncode == 2
        assert sentence in done.stderr


@pytest.mark.slow
@pytest.mark.skipif("DONDOLO_OPENQUAKE" not in os.environ, reason="DONDOLO_OPENQUAKE is not the path of an engine's oq")
def test_the_engine_agrees(results, tmp_path):
    """Frequencies of collapse by the engine, run as a program, are those of the mean curves."""
    hazard = dd.HazardCurve.power_law(1e-4, 2.5)
    dd.write_openquake(results, tmp_path / "job", hazard=hazard)
    (tmp_path / "data").mkdir()
    environment = os.environ | {"OQ_DATADIR": str(tmp_path / "data"), "OQ_DISTRIBUTE": "no"}
    command = [os.environ["DONDOLO_OPENQUAKE"], "engine", "--run", "job_damage.ini", "--exports", "csv"]
    subprocess.run(command, cwd=tmp_path / "job", env=environment, check=True, capture_output=True, timeout=300)
    (file,) = (tmp_path / "job").glob("damages-rlz*.csv")
    walls = {row["id"]: float(row["number"]) for row in rows_of(tmp_path / "job/exposure.csv")}
    names = {"città vecchia": "all", "new": "one_sided"}
    for row in rows_of(file):
        curve = results.typology[names[row["taxonomy"]], row["taxonomy"]]
        found = float(row["structural-collapse"]) / walls[row["asset_id"]]
        assert found == pytest.approx(curve.risk(hazard).annual_frequency, rel=0.01)
