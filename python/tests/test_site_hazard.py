"""The hazard of a site from its coordinates: Python, executable, files, calculation report, and the rules by hand."""

import csv
import json
import math
import re
import subprocess
import sys

import numpy as np
import pytest

import dondolo as dd
from dondolo._storage.run_file import RunFile
from dondolo.exchange.case_checks import site_of

# WGS84, and a_g [g], F_0 and T_C* [s] of SLV for V_R 50 years, by an independent program with more digits than the
# decree prints
SLV = {
    (42.3498, 13.3999): (0.260658083233, 2.363514892764, 0.346501218909),
    (44.8378, 11.6199): (0.131547694328, 2.595564212544, 0.274033321541),
    (41.9028, 12.4964): (0.120207284381, 2.620191608673, 0.297137070176),
    (45.4642, 9.1900): (0.049773229719, 2.654919386971, 0.279603779098),
    (40.8518, 14.2681): (0.167564738882, 2.373150652870, 0.338186235852),
    (37.5027, 15.0873): (0.206386418932, 2.456826215669, 0.358112455224),
}
# What the last printed digit hides
LAST_DIGIT = (5e-5, 5e-4, 5e-4)
CASE = """&job output = 'out/wall' /
&wall mechanism = 'one_sided', height = 3.0, thickness = 0.3 /
&records catalogue = '{root}/data/records/synthetic44.csv', polarity = 'both' /
&stripes levels = 0.2, 0.4, 0.8 /
&check latitude = 41.12, longitude = 14.78, nominal_life = {life}, use_class = '{use}', soil = 'C' /
"""


@pytest.mark.parametrize("place", SLV)
def test_places(place):
    hazard = dd.Site(latitude=place[0], longitude=place[1], nominal_life=50).hazard
    found = (hazard.ag[1], hazard.f0[1], hazard.tc_star[1])
    for value, expected, most in zip(found, SLV[place], LAST_DIGIT, strict=True):
        assert abs(value - expected) < most


def by_hand(latitude, longitude, years, mesh):
    """The rules, from the nodes alone: datum by Bowring's closed form, spherical law of cosines."""
    a, f = 6378137.0, 1.0 / 298.257223563
    p, q = math.radians(latitude), math.radians(longitude)
    n = a / math.sqrt(1.0 - f * (2.0 - f) * math.sin(p) ** 2)
    x, y = (n * math.cos(p) * of(q) + shift for of, shift in ((math.cos, 87.0), (math.sin, 98.0)))
    z = n * (1.0 - f) ** 2 * math.sin(p) + 121.0
    a, f = 6378388.0, 1.0 / 297.0
    e2, r = f * (2.0 - f), math.hypot(x, y)
    u = math.atan2(z, r * (1.0 - f))
    p = math.atan2(z + e2 / (1.0 - e2) * a * (1.0 - f) * math.sin(u) ** 3, r - e2 * a * math.cos(u) ** 3)
    q = math.atan2(y, x)
    weights = []
    for lat, lon in zip(np.radians(mesh.latitudes), np.radians(mesh.longitudes), strict=True):
        chord = math.hypot(
            math.cos(lat) * math.cos(lon) - math.cos(p) * math.cos(q),
            math.cos(lat) * math.sin(lon) - math.cos(p) * math.sin(q),
            math.sin(lat) - math.sin(p),
        )
        weights.append(1.0 / math.asin(0.5 * chord))
    values = np.average(mesh.values, axis=0, weights=weights)
    logs = [np.interp(math.log(years), np.log(mesh.grid_years), np.log(column)) for column in values.T]
    return math.degrees(p), math.degrees(q), np.exp(logs)


def test_rules_by_another_program():
    """Random places, lives and classes; numpy.interp holds return periods at the ends of the grid."""
    rng = np.random.default_rng(7)
    found = 0
    while found < 60:
        latitude, longitude = rng.uniform(36.7, 47.0), rng.uniform(6.7, 18.5)
        life, use = float(rng.choice([5.0, 10.0, 50.0, 100.0, 300.0])), rng.choice(["I", "II", "III", "IV"])
        try:
            site = dd.Site(latitude=latitude, longitude=longitude, nominal_life=life, use_class=str(use))
        except dd.errors.InputError:
            continue
        found += 1
        hazard, mesh = site.hazard, site.hazard.mesh
        assert hazard.reference_life == pytest.approx(life * {"I": 0.7, "II": 1.0, "III": 1.5, "IV": 2.0}[use])
        assert np.array_equal(mesh.ids - mesh.ids[0], [0, 1, 223, 222])
        assert mesh.latitudes.min() - 0.01 <= mesh.latitude <= mesh.latitudes.max() + 0.01
        for i, chance in enumerate((0.63, 0.1, 0.05)):
            years = -hazard.reference_life / math.log(1.0 - chance)
            lat, lon, values = by_hand(latitude, longitude, years, mesh)
            assert (lat, lon) == pytest.approx((mesh.latitude, mesh.longitude), abs=1e-10)
            assert (hazard.ag[i], hazard.f0[i], hazard.tc_star[i]) == pytest.approx(tuple(values), rel=1e-8)
            assert hazard.return_periods[i] == pytest.approx(min(max(years, 30.0), 2475.0), rel=1e-12)
        assert 0.0008 < hazard.ag[0] <= hazard.ag[1] <= hazard.ag[2] < 0.7


def test_every_route_has_one_answer(root, executable, tmp_path):
    """Executable, its files, Python's objects, and the same case written and read back."""
    (tmp_path / "wall.nml").write_text(CASE.format(root=root, life=50, use="III"))
    subprocess.run([executable, "--quiet", "wall.nml"], cwd=tmp_path, check=True)
    site = dd.Site(latitude=41.12, longitude=14.78, nominal_life=50, use_class="III", soil="C")
    stored = dd.read_results(tmp_path / "out/wall")
    assert stored.check.site == site == dd.read_case(tmp_path / "wall.nml").site
    check = dd.check_ntc(stored.stripes.wall, site)
    kinematic = [
        row for row in stored.check.rows if not row.quantity.startswith("probability") and row.method != "dynamic"
    ]
    assert kinematic == list(check.rows)
    again = dd.run_case(tmp_path / "wall.nml", progress=False)
    assert again.check.rows == stored.check.rows
    # The same as its values given
    hazard = site.hazard
    years = {"reference_life": hazard.reference_life, "exceedance": hazard.exceedance}
    given = dd.Site(hazard.ag, hazard.f0, hazard.tc_star, soil="C", **years)
    assert dd.check_ntc(stored.stripes.wall, given).capacities == check.capacities
    study = dd.Study(dd.read_catalogue(root / "data/records/synthetic44.csv"), [0.2, 0.4, 0.8], polarity="both")
    catalogue = root / "data/records/synthetic44.csv"
    dd.write_case(tmp_path / "again.nml", stored.stripes.wall, study, catalogue=catalogue, check=check)
    text = (tmp_path / "again.nml").read_text()
    assert "latitude = 41.12" in text
    assert "tc_star =" not in text
    assert dd.read_case(tmp_path / "again.nml").site == site
    # Facts of the run, and of the sheet
    run = json.loads((tmp_path / "out/wall_run.json").read_text())
    assert run["settings"]["check"]["use_class"] == "III"
    assert "ag" not in run["settings"]["check"]
    facts = run["hazard"]
    assert facts["nodes"] == hazard.mesh.ids.tolist()
    assert facts["distances_km"] == pytest.approx(hazard.mesh.distances)
    assert (tuple(facts["ag_g"]), tuple(facts["f0"]), tuple(facts["tc_star_s"])) == hazard[:3]
    assert facts["reference_life_year"] == 75.0
    assert check.value("site", "", "longitude_ed50") == facts["longitude_ed50"] == hazard.mesh.longitude
    node = f"node {hazard.mesh.ids[2]}"
    assert check.value("site", "", "latitude_ed50", item=node) == hazard.mesh.latitudes[2]
    assert check.value("site", "", "distance", item=node) == hazard.mesh.distances[2]
    for row in check.rows:
        if row.method == "site" and row.numbers and row.quantity in ("ag", "f0", "tc_star", "reference_life"):
            formula = re.sub(r"\bln\b", "math.log", row.numbers.replace("^", "**").replace("[", "(").replace("]", ")"))
            assert eval(formula) == pytest.approx(row.value, rel=1e-6)


def test_the_source_is_that_of_the_published_grid(root, tmp_path):
    published = root.parent / "shared/data/ntc_grid/ntc08_annex_b.txt.xz"
    if not published.exists():
        pytest.skip(f"the published grid is not there: {published}")
    command = [sys.executable, root / "packaging/hazard_grid.py", published, tmp_path / "data.c"]
    subprocess.run(command, check=True)
    assert (tmp_path / "data.c").read_bytes() == (root / "src/core/check/hazard_data.c").read_bytes()


def test_a_population_has_the_hazard_of_its_place(root, executable, tmp_path):
    (tmp_path / "walls.csv").write_text("name,mechanism,height,thickness\na,one_sided,3.0,0.25\nb,one_sided,1.5,0.25\n")
    text = CASE.format(root=root, life=50, use="II").replace("output", "task = 'typology', output")
    text = re.sub("(?m)^&wall.*$", "&population file = 'walls.csv' /", text)
    (tmp_path / "walls.nml").write_text(text)
    subprocess.run([executable, "--quiet", "walls.nml"], cwd=tmp_path, check=True)
    lines = [line for line in (tmp_path / "out/wall_checks.csv").read_text().splitlines() if line[0] != "#"]
    site = dd.Site(latitude=41.12, longitude=14.78, nominal_life=50, soil="C")
    stored = dd.read_results(tmp_path / "out/wall")
    for row, wall in zip(csv.DictReader(lines), stored.population, strict=True):
        ratio = dd.check_ntc(wall, site).value("nonlinear", "SLV", "ratio")
        assert float(row["nonlinear_slv_ratio"]) == pytest.approx(ratio, rel=1e-14)
    assert "hazard" in json.loads((tmp_path / "out/wall_run.json").read_text())


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ({"latitude": 39.22, "longitude": 9.12, "nominal_life": 50}, "without Sardinia"),
        ({"latitude": 42.8, "longitude": 10.3, "nominal_life": 50}, "the Tuscan"),
        ({"latitude": 38.48, "longitude": 14.95, "nominal_life": 50}, "Aeolian"),
        ({"latitude": 46.05, "longitude": 14.51, "nominal_life": 50}, "outside the grid of hazard"),
        ({"latitude": 13.4, "longitude": 42.35, "nominal_life": 50}, "is it the longitude?"),
        ({"latitude": 42.35, "longitude": 42.35, "nominal_life": 50}, "is it the latitude?"),
        ({"latitude": math.nan, "longitude": 13.4, "nominal_life": 50}, "latitude"),
        ({"latitude": 42.35, "longitude": 13.4}, "nominal_life: must be given"),
        ({"latitude": 42.35, "nominal_life": 50}, "longitude: must be given"),
        ({"longitude": 13.4, "nominal_life": 50}, "latitude: must be given"),
        ({"latitude": 42.35, "longitude": 13.4, "nominal_life": 0}, "nominal_life = 0"),
        ({"latitude": 42.35, "longitude": 13.4, "nominal_life": 50, "use_class": "V"}, "must be one of 'I', 'II'"),
        ({"latitude": 42.35, "longitude": 13.4, "nominal_life": 50, "tc_star": 0.3}, "tc_star: not with latitude"),
        (
            {"latitude": 42.35, "longitude": 13.4, "nominal_life": 50, "reference_life": 50.0},
            "reference_life: not with",
        ),
        ({"ag": 0.2, "f0": 2.5, "tc_star": 0.35, "nominal_life": 50}, "nominal_life: only with latitude and longitude"),
        ({"ag": 0.2, "f0": 2.5}, "tc_star: must be given, or latitude and longitude"),
        ({}, "ag: must be given, or latitude and longitude"),
    ],
)
def test_refused(given, words):
    with pytest.raises(dd.errors.InputError) as caught:
        dd.Site(**given)
    assert words in str(caught.value)
    assert len(str(caught.value).splitlines()) == len(caught.value.errors)


def test_class_of_use_without_coordinates(root, tmp_path):
    site = dd.Site(0.2, 2.5, 0.35, use_class="IV")
    assert site.hazard.mesh is None
    assert site.hazard.return_periods == ()
    (tmp_path / "wall.nml").write_text(
        re.sub("latitude.*?use", "ag = 0.2, f0 = 2.5, tc_star = 0.35, use", CASE).format(root=root, use="iv")
    )
    case = dd.read_case(tmp_path / "wall.nml")
    assert (case.site.use_class, case.settings["check"]["use_class"]) == ("IV", "IV")
    # Runs of before have none
    settings = {"check": {"ag": [0.2], "f0": [2.5], "tc_star": [0.35], "soil": "A", "topography": "T1"}}
    assert site_of(RunFile(version="", settings=settings)) == dd.Site(0.2, 2.5, 0.35)


def held_of(check):
    """Notes on return periods that the grid does not have."""
    return [note for note in check.notes if note.code == "return_period_held"]


def test_a_return_period_beyond_the_grid_is_noted(root, run, tmp_path):
    """Above 2475 years the hazard is less than what is asked for."""
    wall = dd.OneSidedWall(3.0, 0.3)
    site = dd.Site(latitude=42.35, longitude=13.4, nominal_life=100, use_class="IV")
    (note,) = held_of(dd.check_ntc(wall, site))
    asked = -200.0 / math.log(0.95)
    assert (note.code, dict(note.subject)) == ("return_period_held", {"limit_state": "SLC"})
    assert dict(note.numbers) == pytest.approx({"return_period_year": asked, "held_year": 2475.0})
    assert str(note).endswith("the hazard is that of 2475 years, which is less")
    low = dd.check_ntc(wall, dd.Site(latitude=42.35, longitude=13.4, nominal_life=20))
    assert [note.subject["limit_state"] for note in held_of(low)] == ["SLD"]
    assert low.value("site", "SLD", "return_period_demand") == 30.0
    (tmp_path / "wall.nml").write_text(CASE.format(root=root, life=100, use="IV"))
    done = run("--check", tmp_path / "wall.nml")
    assert "note: the return period of SLC, 3899 years, is beyond those of the grid of hazard" in done.stdout
    assert re.search(
        r"(?m)^site 41.12, 14.78 \(ED50 .*\), between nodes \d+, \d+, \d+, \d+ of the grid of hazard", done.stdout
    )
    assert re.search(r"(?m)^hazard of SLC: a_g .* T_R 2475 years$", done.stdout)


def test_calculation_report(root, executable, tmp_path):
    """Both pairs of coordinates, the nodes with their values, the rules, and the return periods."""
    (tmp_path / "wall.nml").write_text(CASE.format(root=root, life=50, use="III"))
    subprocess.run([executable, "--quiet", "wall.nml"], cwd=tmp_path, check=True)
    results = dd.read_results(tmp_path / "out/wall")
    mesh = results.check.site.hazard.mesh
    for lang, mark in (("en", "."), ("it", ",")):
        dd.calculation_report(results, tmp_path / f"{lang}.html", lang=lang)
        page = re.sub(r"<[^>]*>", " ", (tmp_path / f"{lang}.html").read_text())
        page = " ".join(page.split())
        for node in mesh.ids:
            assert re.search(rf"\b(node|nodo) {node}\b", page)
        for value in (41.12, 14.78, mesh.latitude, mesh.longitude, *mesh.longitudes):
            assert f"{value:.9g}".replace(".", mark) in page
        for value in mesh.values[:, [2, 3, 6, 7, 8]].ravel():
            assert f"{value:.4g}".replace(".", mark) in page
        assert "ED50" in page
        assert "712" in page
    dd.report(results, tmp_path / "report.html", lang="it")
    assert "41,12; 14,78" in (tmp_path / "report.html").read_text()
    (tmp_path / "project.toml").write_text("[project]\nlatitude = 41.2\n")
    with pytest.raises(dd.errors.InputError, match=r"latitude = 41.2: must be 41.12, that of the check"):
        dd.calculation_report(results, tmp_path / "other.html", project=tmp_path / "project.toml")
    (tmp_path / "project.toml").write_text("[project]\nnominal_life = 50\nuse_coefficient = 1.5\n")
    dd.calculation_report(results, tmp_path / "other.html", project=tmp_path / "project.toml")
