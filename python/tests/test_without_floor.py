"""Walls whose base is above the ground, on a building that is not given: no spectrum, and no ratio of a check."""

import csv
import subprocess
from dataclasses import replace

import pytest

import dondolo as dd
from dondolo._fortran.checks import dynamic_sheet
from dondolo.errors import InputError
from dondolo.walls.wall import upload

SITE = dd.Site(ag=(0.104, 0.261, 0.334), f0=(2.332, 2.364, 2.4), tc_star=(0.281, 0.347, 0.364), soil="B")
FACADE = {"height": 12.0, "thickness": 0.7, "density": 1900.0}
# a_Z of SLV, ratio of SLD and zeta_E of the floor, by the height of the hinge
FLOORS = {
    4.0: (0.30646149249246, 0.517067512160336, 0.721148182297692),
    8.0: (0.61292298498492, 0.517067512160336, 0.838715345982628),
    10.0: (0.76615373123115, 0.827308019456537, 1.01587960353284),
}


def building(level):
    return dd.Building(0.05 * 12.0**0.75, damping=0.05, storeys=3, level=level, building_height=12.0)


@pytest.mark.parametrize("level", FLOORS)
def test_a_hinge_above_the_ground(level):
    wall = dd.OneSidedWall(**FACADE, hinge_level=level)
    assert wall.base_level == level
    check = dd.check_ntc(wall, SITE)
    assert check.verified is None
    assert check.capacities == {}
    assert not check.satisfied
    assert not [row for row in check.rows if row.quantity in ("ratio", "zeta_e", "verified", "capacity_ag")]
    found = {(row.method, row.limit_state): row for row in check.rows if row.quantity == "applicable"}
    assert list(found) == [("linear", "SLD"), ("linear", "SLV"), ("nonlinear", "SLV"), ("nonlinear", "SLC")]
    assert {row.value for row in found.values()} == {0.0}
    assert found["linear", "SLD"].formula == "C8.7.1.2.1.5"
    assert found["nonlinear", "SLV"].formula == "C8.7.1.2.1.8"
    (note,) = (note for note in check.notes if note.code == "floor_not_given")
    assert note.numbers["level_m"] == level
    assert note.numbers["building_period_s"] == pytest.approx(0.322370979547063, rel=1e-12)
    assert "period = 0.322, building_height = 12, storeys = 3" in str(note)
    assert f"level = {level:g}" in str(note)
    # The numbers of the mechanism are those of the wall on a floor that is given
    on_floor = dd.check_ntc(dd.OneSidedWall(**FACADE, hinge_level=level, building=building(0.0)), SITE,
                          building_period=0.05 * 12.0**0.75)  # fmt: skip
    for quantity in ("alpha_0", "a_0", "d_0"):
        assert check.value("mechanism", "", quantity) == on_floor.value("mechanism", "", quantity)
    values = [
        on_floor.value("site", "SLV", "floor_pga"),
        on_floor.value("linear", "SLD", "ratio"),
        on_floor.value("nonlinear", "SLV", "zeta_e"),
    ]
    assert values == pytest.approx(FLOORS[level], rel=1e-12)
    assert on_floor.verified is not None
    # Neither do histories verify it
    assert [row.quantity for row in dynamic_sheet(upload((wall,)), "SLV", 0.3, 1, [0.1])] == ["applicable"]


def test_a_strip_above_the_ground():
    strip = dd.TwoBlockWall(3.0, 0.25, overburden=2e4, overburden_inertia=1.0, restitution="impulse", base_level=3.5)
    assert dd.check_ntc(strip, SITE).verified is None
    assert dd.check_ntc(replace(strip, base_level=None), SITE).verified is not None
    with pytest.raises(InputError, match=r"base_level = 3\.5: not on a building that is given"):
        replace(strip, building=building(3.5))


def test_histories_are_the_same():
    """The level is a statement for checks; it changes no history."""
    wall = dd.OneSidedWall(**FACADE, hinge_level=8.0)
    ground = replace(wall, base_level=None)
    assert (wall.trigger_acceleration, wall.capacity_angle, wall.radius) == (
        ground.trigger_acceleration, ground.capacity_angle, ground.radius
    )  # fmt: skip
    assert dd.OneSidedWall(**FACADE, hinge_level=0.0).base_level in (None, 0.0)
    assert dd.check_ntc(dd.OneSidedWall(**FACADE, hinge_level=0.0), SITE).verified is not None


def test_executable_and_python(executable, root, tmp_path):
    """The run and its curve go on, and the console and the tables say that no check is possible."""
    (tmp_path / "case.nml").write_text(
        "&job task = 'stripes', output = 'out' /\n"
        "&wall mechanism = 'one_sided', height = 12, thickness = 0.7, density = 1900, hinge_level = 8 /\n"
        "&check ag = 0.104, 0.261, 0.334, f0 = 2.332, 2.364, 2.4, tc_star = 0.281, 0.347, 0.364, soil = 'B' /\n"
        f"&records catalogue = '{root / 'data/records/synthetic44.csv'}' /\n&stripes levels = 0.3, 0.6, 1.2 /\n"
    )
    done = subprocess.run([executable, "case.nml"], cwd=tmp_path, capture_output=True, text=True, check=True)
    assert "verdict: none, there is no spectrum at the level of the wall" in done.stdout
    assert done.stdout.count("not applicable: no spectrum at the level of the wall") == 4
    assert "the base of the wall is 8 m above the ground" in done.stdout
    with (tmp_path / "out_check.csv").open(encoding="utf-8") as file:
        rows = list(csv.reader(line for line in file if not line.startswith("#")))
    quantities = {row[rows[0].index("quantity")] for row in rows[1:]}
    assert "applicable" in quantities
    assert not quantities & {"ratio", "zeta_e", "verified"}
    read = dd.read_results(tmp_path / "out")
    assert read.check.verified is None
    ran = dd.run_case(tmp_path / "case.nml")
    assert [tuple(row) for row in ran.check.rows] == [tuple(row) for row in read.check.rows]
    # Documents say so on their first page, and give no index
    for lang, words in (("it", "verifica non eseguibile: la base è a"), ("en", "check NOT feasible: the base is")):
        dd.calculation_report(read, tmp_path / f"{lang}.html", lang=lang)
        page = (tmp_path / f"{lang}.html").read_text(encoding="utf-8")
        cover = page.partition("<main>")[2].partition("<h2")[0]
        assert words in cover
        assert "satisfied" not in cover
        assert "soddisfatta" not in cover
    dd.report(read, tmp_path / "report.html")
    assert "no spectrum at the level of the wall" in (tmp_path / "report.html").read_text(encoding="utf-8")
