"""Ties that are left out of a check: the better of the curves with all ties and without those that break first.

Expected numbers are those of an independent program of 40 digits (finite kinematics).
"""

import subprocess
from dataclasses import replace

import numpy as np
import pytest

import dondolo as dd
from dondolo._fortran.checks import dynamic_sheet
from dondolo.checks.side_by_side import side_by_side, ties_not_counted
from dondolo.errors import InputError
from dondolo.reporting.language import Language
from dondolo.reporting.relazione.subjects import Subject
from dondolo.reporting.relazione.sums import ties_left_out
from dondolo.reporting.words import warning
from dondolo.walls.wall import upload

MASONRY = ("masonry_compression", "masonry_shear", "masonry_tension")
SITE = dd.Site(ag=(0.104, 0.261, 0.334), f0=(2.332, 2.364, 2.4), tc_star=(0.281, 0.347, 0.364), soil="B")


def tie(force, height, strain, length):
    """A tie that acts at the face of the wall with a force, up to a strain."""
    return dd.Tie(height, depth=0.0, area=force / 2e8, strength=2e8, strain=strain, length=length)


def load(force, depth, height):
    return dd.Load(force, depth=depth, height=height, inertia="both")


EARLY = dd.OneSidedWall(11.7, 0.88, density=1900.0, ties=[tie(9000.0, 10.5, 0.01, 8.0)])
TWO = dd.OneSidedWall(
    9.0,
    0.6,
    density=1800.0,
    loads=[load(8000.0, 0.4, 3.0), load(8000.0, 0.4, 6.0), load(5000.0, 0.4, 9.0)],
    ties=[tie(20000.0, 6.0, 0.02, 10.0), tie(10000.0, 9.0, 0.02, 10.0)],
)
LATE = dd.OneSidedWall(
    6.0,
    0.5,
    density=2000.0,
    loads=[load(5000.0, 0.35, 6.0)],
    thrusts=[dd.Thrust(1000.0, depth=0.5, height=5.0)],
    ties=[tie(6000.0, 5.0, 0.05, 9.0)],
)
# alpha_0 with all ties and without any, d_SLV and zeta_E with all, without the first that breaks, and without any;
# zeta_E that is taken, SLV and SLC
WALLS = {
    "early": (
        EARLY, 0.159388999889687, 0.0752136752136752, 0.0445714285714286, 0.574141644034379,
        0.907486943671255, 0.907486943671255, 0.907486943671255, 1.04222491973489,
    ),
    "two": (
        TWO, 0.452317807304079, 0.0677653878650639, 0.133509888349153, 1.33421530646542,
        1.33421530646542, 0.69034488552915, 1.33421530646542, 0.977579574630595,
    ),
    "late": (
        LATE, 0.200721270210088, 0.0554990802594636, 0.0759700306503648, 0.837369695191886,
        0.392821256623459, 0.392821256623459, 0.837369695191886, 0.908968878750181,
    ),
}  # fmt: skip


@pytest.mark.parametrize("name", WALLS)
def test_numbers(name):
    wall, *expected, first, last, slv, slc = WALLS[name]
    check = dd.check_ntc(wall, SITE)
    bare = dd.check_ntc(replace(wall, ties=[]), SITE)
    found = [
        check.value("mechanism", "", "alpha_0"),
        bare.value("mechanism", "", "alpha_0"),
        check.value("nonlinear", "SLV", "displacement"),
        check.value("nonlinear", "SLV", "tied_zeta"),
        check.value("nonlinear", "SLV", "less_zeta"),
        bare.value("nonlinear", "SLV", "zeta_e"),
        check.value("nonlinear", "SLV", "zeta_e"),
        check.value("nonlinear", "SLC", "zeta_e"),
    ]
    assert found == pytest.approx([*expected, first, last, slv, slc], rel=1e-12)
    if len(wall.ties) == 1:
        # Without its tie it is the wall that has none, to the last bit
        for state in ("SLV", "SLC"):
            assert check.value("nonlinear", state, "less_zeta") == bare.value("nonlinear", state, "zeta_e")
            assert check.value("nonlinear", state, "less_sld") == bare.value("linear", "SLD", "ratio")
    assert not bare._has("nonlinear", "SLV", "tied_zeta")


def left_out(wall):
    """The ties without which zeta_E of SLV is greatest."""
    return check_of(wall)._row("nonlinear", "SLV", "less_zeta").item


def check_of(wall):
    return dd.check_ntc(wall, SITE)


def test_order_of_fracture():
    """The ties that break first are left out first, whatever their order in the wall."""
    assert left_out(TWO) == "tie 2"
    turned = replace(TWO, ties=list(reversed(TWO.ties)))
    assert left_out(turned) == "tie 1"
    assert check_of(turned).value("nonlinear", "SLV", "zeta_e") == pytest.approx(
        check_of(TWO).value("nonlinear", "SLV", "zeta_e"), rel=1e-14
    )
    # Names of many ties have no room
    many = left_out(replace(EARLY, ties=[tie(600.0, 9.0 + 0.1 * i, 0.01, 8.0) for i in range(14)]))
    assert many.startswith("tie")
    assert len(many) <= 24


def test_a_wall_that_only_its_ties_hold():
    with pytest.raises(InputError, match="not stable at rest without its ties"):
        dd.OneSidedWall(
            6.0, 0.45, density=1900.0, loads=[load(6000.0, 0.3, 6.0)],
            thrusts=[dd.Thrust(4500.0, depth=0.45, height=5.2)], ties=[tie(9000.0, 5.2, 0.5, 9.0)],
        )  # fmt: skip


def _random_wall(draw):
    """A wall or a strip with ties, loads, perhaps a building, and the same without the ties."""
    height, thickness = draw.uniform(2.5, 12.0), draw.uniform(0.25, 0.9)
    ties = [
        tie(draw.uniform(500.0, 20000.0), draw.uniform(0.3, 1.0) * height, draw.uniform(0.001, 0.02),
            draw.uniform(3.0, 12.0))
        for _ in range(draw.integers(1, 5))
    ]  # fmt: skip
    building = (
        dd.Building(draw.uniform(0.1, 0.6), storeys=3, building_height=20.0, level=draw.uniform(0.1, 20.0 - height))
        if draw.random() < 0.3
        else None
    )
    common = {"density": draw.uniform(1500.0, 2200.0), "ties": ties, "building": building}
    if draw.random() < 0.3:
        if draw.random() < 0.5:
            common["hinge"] = draw.uniform(0.2, 0.8)
        return dd.TwoBlockWall(
            height, thickness, overburden=draw.uniform(1000.0, 20000.0), overburden_inertia=1.0, restitution="impulse",
            eccentricity=draw.uniform(-0.4, 0.4) * thickness, **common,
        )  # fmt: skip
    loads = [load(draw.uniform(500.0, 9000.0), draw.uniform(0.3, 1.0) * thickness, draw.uniform(0.2, 1.0) * height)
             for _ in range(draw.integers(0, 3))]  # fmt: skip
    return dd.OneSidedWall(height, thickness, loads=loads, **common)


@pytest.mark.filterwarnings("ignore::dondolo.errors.DondoloWarning")
def test_ties_never_make_a_wall_worse():
    """zeta_E of 800 random walls with ties is not less than that of the same without."""
    draw = np.random.default_rng(64)
    counts = {"left out": 0, "strips": 0}
    for _ in range(800):
        wall = _random_wall(draw)
        tied = dd.check_ntc(wall, SITE)
        bare = dd.check_ntc(replace(wall, ties=[]), SITE)
        for state in ("SLV", "SLC"):
            assert tied.value("nonlinear", state, "zeta_e") >= bare.value("nonlinear", state, "zeta_e"), (wall, state)
            both = [tied.value("nonlinear", state, name) for name in ("less_zeta", "tied_zeta")]
            assert tied.value("nonlinear", state, "zeta_e") == max(both)
        counts["left out"] += any(note.code == "ties_left_out" for note in tied.notes)
        counts["strips"] += wall.mechanism == "two_block"
        assert {note.code for note in tied.notes} & {"ties_left_out", "ties_counted"}
    assert counts["left out"] > 40
    assert counts["strips"] > 100


def test_note():
    """Both indices are said, and which is taken."""
    (note,) = (note for note in dd.check_ntc(EARLY, SITE).notes if note.code == "ties_left_out")
    assert note.subject == {"item": "tie 1"}
    expected = {"tied_zeta": 0.574141644034379, "less_zeta": 0.907486943671255}
    assert {name: note.numbers[name] for name in expected} == pytest.approx(expected, rel=1e-12)
    assert [note.numbers[name] for name in ("less_sld", "tied_sld")] == pytest.approx([0.446, 0.946], abs=5e-4)
    assert "0.574" in str(note)
    assert "0.907" in str(note)
    italian = warning(Language("it"), note)
    assert "senza contare la catena 1: 0,907" in italian
    assert "passa da 0,446" in italian
    assert warning(Language("en"), note) == str(note)
    (note,) = (note for note in dd.check_ntc(LATE, SITE).notes if note.code == "ties_counted")
    assert "si assume 0,837" in warning(Language("it"), note)
    (note,) = (note for note in dd.check_ntc(TWO, SITE).notes if note.code == "ties_counted")
    assert note.subject == {"item": "tie 2"}


def test_histories():
    """Where the mean fails only with ties that break, both displacements are given, and the verdict is with ties."""
    check = dd.check_ntc(EARLY, SITE)
    d0 = check.value("mechanism", "", "d_0")
    allowed = check.value("nonlinear", "SLV", "displacement")
    assert allowed < 0.15 * d0
    # Largest rotation / capacity, and whether the wall would be allowed that without its tie
    for edp, would_be in ((0.05, False), (0.25, True), (0.6, False)):
        rows = {row.quantity: row.value for row in dynamic_sheet(upload((EARLY,)), "SLV", 0.3, 2, np.full(4, edp))}
        assert ("untied_displacement" in rows) == would_be
        if would_be:
            assert rows["displacement"] == allowed < rows["mean_displacement"] <= rows["untied_displacement"]
            assert rows["untied_displacement"] == pytest.approx(0.4 * d0, rel=1e-14)
            assert rows["verified"] == 0.0


def test_steps_of_the_curve_that_is_taken():
    """The sheet has them as method 'untied' where that curve is taken: those of the wall without the ties."""
    check, bare = dd.check_ntc(EARLY, SITE), dd.check_ntc(replace(EARLY, ties=[]), SITE)
    for quantity in ("displacement", "acceleration", "period", "spectral_demand", "demand"):
        assert check.value("untied", "SLV", quantity) == bare.value("nonlinear", "SLV", quantity)
    assert check.value("untied", "SLV", "a_0") == bare.value("mechanism", "", "a_0")
    assert {row.item for row in check.rows if row.method == "untied"} == {"tie 1"}
    assert check.value("nonlinear", "SLV", "ratio") == check.value("nonlinear", "SLV", "zeta_e") == check.zeta_e
    for wall in (TWO, LATE):
        assert not dd.check_ntc(wall, SITE)._has("untied", "SLV", "displacement")


def test_documents(executable, root, tmp_path):
    """Console, calculation report and its figure say which ties the index does not count, and show its steps."""
    (tmp_path / "case.nml").write_text(
        "&job task = 'stripes', output = 'out' /\n"
        "&wall mechanism = 'one_sided', height = 11.7, thickness = 0.88, density = 1900, tie_height = 10.5,"
        " tie_depth = 0, tie_area = 4.5e-5, tie_strength = 2e8, tie_strain = 0.01, tie_length = 8 /\n"
        "&check ag = 0.104, 0.261, 0.334, f0 = 2.332, 2.364, 2.4, tc_star = 0.281, 0.347, 0.364, soil = 'B' /\n"
        f"&records catalogue = '{root / 'data/records/synthetic44.csv'}' /\n&stripes levels = 0.3, 0.6, 1.2 /\n"
    )
    done = subprocess.run([executable, "case.nml"], cwd=tmp_path, capture_output=True, text=True, check=True)
    assert "without counting tie 1 it is 0.9075; 0.9075 is taken" in done.stdout
    results = dd.read_results(tmp_path / "out")
    assert results.check.zeta_e == pytest.approx(0.907486943671255, rel=1e-12)
    for lang, words in (
        ("it", ("spostamento, senza la catena 1", "SLV, senza contare la catena 1:", "curva senza alcune catene")),
        ("en", ("displacement, without tie 1", "SLV, without counting tie 1:", "curve without some ties")),
    ):
        dd.calculation_report(results, tmp_path / f"{lang}.html", lang=lang)
        page = (tmp_path / f"{lang}.html").read_text(encoding="utf-8")
        assert all(sentence in page for sentence in words), lang


def test_names_of_ties_left_out():
    """Curves are named by their ties, or by how many break first."""
    many = replace(EARLY, ties=[tie(600.0, 9.0 + 0.1 * i, 0.01, 20.0 - i) for i in range(14)])
    one = Subject(many, dd.check_ntc(many, SITE), None, None)
    assert ties_left_out(one, "tie 2") == {"tie 2"}
    assert ties_left_out(one, "ties 1, 3") == {"tie 1", "tie 3"}
    assert ties_left_out(one, "") == frozenset()
    assert ties_left_out(one, "ties (2)") == {"tie 13", "tie 14"}


WEAK = """
&job task = 'stripes' output = 'result' /
&wall name = 'facade' mechanism = 'one_sided' section_height = 3.6, 3.2 section_thickness = 0.6, 0.45 density = 1900.0
  hinge_depth = 0.03 load = 9.0e3, 5.0e3 load_height = 3.6, 6.8 load_depth = 0.5, 0.32 load_inertia = 'both'
  thrust = 0.4e3 thrust_height = 6.8 tie_height = 6.5 tie_bar = 0.02 tie_spacing = 3.0 tie_length = 8.0
  tie_strength = 1.8e8 tie_strain = 0.02 tie_plate_width = 0.4 tie_plate_height = 0.4 tie_plate_thickness = 0.02
  masonry_compression = 2.0e6 masonry_shear = 3.5e4 masonry_tension = 5.2e4 /
&building period = 0.22 storeys = 2 level = 0.0 building_height = 6.8 /
&records catalogue = '{catalogue}' /
&check ag = 0.104, 0.261, 0.334 f0 = 2.332, 2.364, 2.4 tc_star = 0.281, 0.347, 0.364 soil = 'B' /
&stripes levels = 0.2, 0.4, 0.6 /
"""


@pytest.fixture
def weak(root, tmp_path, monkeypatch):
    """A case whose one tie gives way by its anchor, and is not counted."""
    monkeypatch.chdir(tmp_path)
    case = tmp_path / "case.nml"
    case.write_text(WEAK.format(catalogue=root / "data/records/synthetic44.csv"), encoding="utf-8")
    return case


@pytest.mark.filterwarnings("ignore::dondolo.errors.DondoloWarning")
def test_the_calculation_report_of_a_plate_that_does_not_count(weak):
    """Its capacity curve is drawn without the tie too, and so without the strengths behind its plate."""
    run = dd.run_case(weak, progress=False)
    assert ties_not_counted(run.check, "SLV") == "tie 1"
    dd.calculation_report([run], "relazione.html")
    assert (weak.parent / "relazione.html").stat().st_size > 10000


@pytest.mark.filterwarnings("ignore::dondolo.errors.DondoloWarning")
def test_capacity_and_demand_are_of_the_curve_that_the_ratio_is_of(weak, executable):
    """On the console as in reports: their quotient is the ratio, or a line says that it is of accelerations."""
    check = dd.run_case(weak, progress=False).check
    bare = dd.check_ntc(replace(check.wall, ties=[], **dict.fromkeys(MASONRY)), check.site)
    printed = subprocess.run([executable, weak], capture_output=True, text=True, check=True).stdout
    for line in side_by_side(check, None):
        if line.method != "nonlinear":
            continue
        left_out = ties_not_counted(check, line.limit_state)
        assert left_out == ("tie 1" if line.limit_state == "SLV" else "")
        taken = bare if left_out else check
        assert line.capacity == pytest.approx(taken.value("nonlinear", line.limit_state, "displacement"), rel=1e-12)
        assert line.demand == pytest.approx(taken.value("nonlinear", line.limit_state, "demand"), rel=1e-12)
        words = next(row for row in printed.splitlines() if row.startswith(f"nonlinear {line.limit_state} ")).split()
        capacity, demand, ratio = float(words[2]), float(words[4]), float(words[6])
        assert capacity == pytest.approx(line.capacity, rel=1e-3)
        assert ratio == pytest.approx(line.ratio, rel=1e-3)
        of_activation = f"nonlinear {line.limit_state}: the ratio is that of accelerations at activation" in printed
        assert of_activation == (ratio > 1.002 * capacity / demand)
        assert (f"nonlinear {line.limit_state}: without the ties" in printed) == bool(left_out)
