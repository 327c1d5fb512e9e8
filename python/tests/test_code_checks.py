"""Checks by NTC 2018: values, histories at the level of the site, figure, files and report.

The formulas are held against worked numbers in test/test_code_check.f90.
"""

import csv
import re
import subprocess
from dataclasses import replace

import matplotlib
import numpy as np
import pytest

import dondolo as dd

matplotlib.use("agg")

SITE = dd.Site(ag=0.2, f0=2.5, tc_star=0.35, soil="B")
WALL = dd.OneSidedWall(3.0, 0.25)


@pytest.fixture(scope="module")
def records(root):
    return dd.read_catalogue(root / "data/records/synthetic44.csv")[:6]


@pytest.fixture(scope="module")
def stripes(records):
    return dd.multiple_stripe(WALL, records, levels=[0.24, 0.4, 0.6, 0.8, 1.0], polarity="both", progress=False)


def test_numbers_of_a_wall():
    check = dd.check_ntc(WALL, SITE)
    assert check.pga == pytest.approx(0.24, rel=1e-14)
    assert check.value("mechanism", "", "d_0") == pytest.approx(0.124568219781, rel=1e-11)
    assert check.capacities["linear", "SLV"] == pytest.approx(1.2 * 0.1028806584, rel=1e-9)
    assert check.verified == {
        ("linear", "SLD"): False, ("linear", "SLV"): False, ("nonlinear", "SLV"): False, ("nonlinear", "SLC"): False,
    }  # fmt: skip
    with pytest.raises(dd.errors.InputError, match="quantity = 'capacity': the check has none"):
        check.value("linear", "SLV", "capacity")


def test_ties():
    """Ties hold with their yield force up to their fracture, where d_SLV ends if they carry more than half."""
    tie = dd.Tie(8.5, area=5e-5, length=8.0, preload=3e7)
    wall = dd.OneSidedWall(9.0, 0.5, ties=[tie])
    check = dd.check_ntc(wall, SITE)
    expected = {
        ("mechanism", "alpha_0"): 0.269496985943,
        ("mechanism", "mass_ratio"): 1.0,
        ("mechanism", "d_0"): 0.249615088301,
        ("mechanism", "tie_fracture"): 0.0840890919475,
        ("nonlinear", "displacement"): 0.0840890919475,
        ("nonlinear", "period"): 1.13427057916,
        ("nonlinear", "demand"): 0.0704453989486,
        ("nonlinear", "capacity_ag"): 0.238735512,
        ("linear", "capacity_ag"): 0.3327123283,
    }
    for (method, quantity), value in expected.items():
        assert check.value(method, "SLV", quantity) == pytest.approx(
            value, rel=1e-9 if quantity == "capacity_ag" else 1e-11
        )
    bare = dd.check_ntc(dd.OneSidedWall(9.0, 0.5), SITE)
    # The tie is broken by then.
    assert check.value("nonlinear", "SLC", "acceleration") == pytest.approx(
        bare.value("nonlinear", "SLC", "acceleration"), rel=1e-12
    )
    # One of three that carry a third each does not end it, and those that hold beyond 0.4 d_0 do not either.
    weak = [replace(tie, strain=strain) for strain in (0.005, 0.1, 0.1)]
    several = dd.check_ntc(dd.OneSidedWall(9.0, 0.5, ties=weak), SITE)
    assert several.value("nonlinear", "SLV", "displacement") == pytest.approx(
        0.4 * expected["mechanism", "d_0"], rel=1e-11
    )
    with pytest.raises(dd.errors.InputError, match="the check has none"):
        several.value("mechanism", "", "tie_fracture")
    with pytest.raises(dd.errors.InputError, match="the check has none"):
        bare.value("mechanism", "", "tie_fracture")


def test_interlocking():
    """Friction F (1 - D/l) of transverse walls at a third of the height."""
    wall = dd.OneSidedWall(3.0, 0.25, interlock=dd.Interlock(overlap=0.2, course=0.1, thickness=0.3, spacing=4.0))
    check = dd.check_ntc(wall, SITE)
    weight = 1800.0 * 9.81
    force = 0.4 * 30 * 31 * 0.1 * 0.2 * 0.577 * 0.3 * weight / 4.0
    moved = 0.75 * weight * 1.5
    assert check.value("mechanism", "", "alpha_0") == pytest.approx(0.25 / 3.0 + force / moved, rel=1e-12)
    q = np.arcsin(check.value("nonlinear", "SLV", "displacement") / 1.5)
    slid = np.sin(q) + 0.25 * (1.0 - np.cos(q))
    lever = 1.5 * np.cos(q) + 0.125 * np.sin(q)
    alpha = (0.125 * np.cos(q) - 1.5 * np.sin(q)) / lever + force * (1.0 - slid / 0.2) * (
        np.cos(q) + 0.25 * np.sin(q)
    ) / (0.75 * weight * lever)
    assert check.value("nonlinear", "SLV", "acceleration") == pytest.approx(alpha * 9.81 / 1.35, rel=1e-11)
    assert check.value("mechanism", "", "d_0") == pytest.approx(dd.check_ntc(WALL, SITE).value("mechanism", "", "d_0"))


def test_a_building():
    building = dd.Building(period=0.3, damping=0.05, participation=9.0 / 7.0)
    check = dd.check_ntc(dd.OneSidedWall(1.5, 0.25, building=building), SITE, building_period=0.3)
    assert check.value("site", "SLV", "floor_pga") == pytest.approx(0.7752761193436115, rel=1e-12)
    assert check.value("nonlinear", "SLV", "capacity_ag") == pytest.approx(0.08916273855, rel=1e-9)


def test_spectrum_of_a_site():
    several = dd.Site((0.08, 0.2, 0.26), 2.5, (0.3, 0.35, 0.36), soil="C", topography="T2")
    for state, ag, tc in (("SLD", 0.08, 0.3), ("SLV", 0.2, 0.35), ("SLC", 0.26, 0.36)):
        alone = dd.Site(ag, 2.5, tc, soil="C", topography="T2").spectrum()
        np.testing.assert_array_equal(several.spectrum(limit_state=state).sa, alone.sa)


def test_histories_at_the_level_of_the_site(stripes, records):
    check = dd.check_ntc(WALL, SITE).dynamic(stripes)
    edp = stripes.edp[0]
    mean = np.mean(1.5 * np.sin(np.minimum(edp, 1.0) * WALL.capacity_angle))
    assert check.value("dynamic", "SLV", "mean_displacement") == pytest.approx(mean, rel=1e-12)
    assert check.value("dynamic", "SLV", "histories") == 12
    assert check.value("dynamic", "SLC", "records") == 6
    assert check.value("dynamic", "SLV", "beyond") == stripes.collapses[0]
    assert check.verified["dynamic", "SLV"] == (stripes.collapses[0] == 0 and mean <= 0.4 * 0.124568219781)
    # Records of their own: one stripe more
    assert check.dynamic(records, polarity="both").rows == check.rows
    assert "in one direction" not in repr(check)
    assert "of 6 histories of 6 records in one direction beyond d_0*" in repr(check.dynamic(records))
    free = dd.check_ntc(dd.FreeStandingWall(3.0, 0.25), SITE)
    assert "of 6 histories of 6 records beyond d_0*" in repr(free.dynamic(records))
    # Histories that end early do not tell what is beyond d_0*; those that are run for the check do not end early.
    early = dd.Solver(edp_limit=0.5)
    assert check.dynamic(records, polarity="both", solver=early).rows == check.rows
    with pytest.raises(dd.errors.InputError, match=r"edp_limit = 0\.5: must be at least 1"):
        check.dynamic(dd.multiple_stripe(WALL, records, [0.24], solver=early))
    with pytest.raises(dd.errors.InputError, match=r"no level of 0\.24 g"):
        check.dynamic(stripes[1:])
    with pytest.raises(dd.errors.InputError, match="of the wall of the check"):
        dd.check_ntc(dd.OneSidedWall(2.0, 0.25), SITE).dynamic(stripes)


def test_histories_of_a_wall_that_leans_on_a_building(records):
    """They have the motion that the wall feels: base and support, at the level of the ground."""
    facade = dd.OneSidedWall(9.0, 0.5)
    house = dd.Building(period=0.3, storeys=3, level=0.0, building_height=9.0)
    leaning = replace(facade, building=house)
    found = dd.check_ntc(leaning, SITE).dynamic(records)
    # The same wall, by hand under the records that it feels, each scaled as that of the ground is
    scales = [0.24 * 9.81 / np.abs(record.acceleration).max() for record in records]
    edp = [
        dd.simulate(facade, record.under(leaning), scale, history=False).edp
        for record, scale in zip(records, scales, strict=True)
    ]
    mean = np.mean(4.5 * np.sin(np.minimum(edp, 1.0) * facade.capacity_angle))
    assert found.value("dynamic", "SLV", "mean_displacement") == pytest.approx(mean, rel=1e-9)
    still = dd.check_ntc(facade, SITE).dynamic(records)
    assert mean > 1.5 * still.value("dynamic", "SLV", "mean_displacement")


def test_lines_on_the_curve(stripes, tmp_path):
    check, curve = dd.check_ntc(WALL, SITE), stripes.fit()
    chances = check.probabilities(curve)
    assert chances["site", ""] == curve(check.pga)
    assert chances["nonlinear", "SLV"] == curve(check.capacities["nonlinear", "SLV"])
    ax = check.plot(curve=curve)
    labels = [text.get_text() for text in ax.get_legend().get_texts()]
    assert sum("withstands " in label for label in labels) == 4
    other = dd.fit_fragility([0.2, 0.4, 0.6], [1, 5, 9], 10, im="pgv")
    with pytest.raises(dd.errors.InputError, match="its measure is 'pgv'"):
        check.probabilities(other)
    check.save(tmp_path / "check.npz")
    assert dd.load(tmp_path / "check.npz").rows == check.rows


@pytest.mark.parametrize(
    ("make", "words"),
    [
        (lambda: dd.Site(2.0, 2.5, 0.35), r"ag = 2: must lie between 0\.001 and 1 g"),
        (lambda: dd.Site((0.1, 0.2), 2.5, 0.35), "ag: has 2 values, must have one, or three"),
        (lambda: dd.Site(0.2, 2.5, 0.35, soil="F"), "soil = 'f': must be one of 'A', 'B', 'C', 'D', 'E'"),
        (
            lambda: dd.check_ntc(WALL, SITE, knowledge_factor=1.5),
            r"knowledge_factor = 1\.5: must lie between 1 and 1\.35",
        ),
        (lambda: dd.check_ntc(WALL, 0.2), "site: must be a Site, not float"),
    ],
)
def test_wrong_input(make, words):
    with pytest.raises(dd.errors.InputError, match=words) as caught:
        make()
    assert "\n" not in str(caught.value)


CASE = """&job output = 'out/wall' /
&wall mechanism = 'one_sided', height = 3.0, thickness = 0.25 /
&records catalogue = '{root}/data/records/synthetic44.csv' /
&stripes levels = 0.2, 0.4, 0.6, 0.8 /
&check ag = 0.2, f0 = 2.5, tc_star = 0.35, soil = 'b' /
"""


def test_case_and_report(root, executable, tmp_path):
    (tmp_path / "wall.nml").write_text(CASE.format(root=root))
    subprocess.run([executable, "wall.nml"], cwd=tmp_path, check=True, capture_output=True)
    stored = dd.read_results(tmp_path / "out/wall")
    check = dd.check_ntc(stored.stripes.wall, SITE)
    assert stored.check.site == SITE
    assert [
        row for row in stored.check.rows if not row.quantity.startswith("probability") and row.method != "dynamic"
    ] == [*check.rows]
    # No stripe stands at the level of the site: the executable has run one more
    more = check.dynamic(dd.read_catalogue(root / "data/records/synthetic44.csv"))
    assert stored.check.value("dynamic", "SLV", "mean_displacement") == pytest.approx(
        more.value("dynamic", "SLV", "mean_displacement"), rel=1e-12
    )
    assert stored.check.value("site", "", "probability") == pytest.approx(stored.fragility(0.24), rel=1e-9)
    again = dd.run_case(tmp_path / "wall.nml", progress=False)
    # Nor is it another one where collapse is less than the capacity
    early = CASE.format(root=root).replace("out/wall", "early").replace("0.4,", "0.24,") + "&solver edp_limit = 0.1 /\n"
    (tmp_path / "early.nml").write_text(early)
    subprocess.run([executable, "early.nml"], cwd=tmp_path, check=True, capture_output=True)
    rows = dd.read_results(tmp_path / "early").check.rows
    assert [row for row in rows if row.method == "dynamic"] == [row for row in more.rows if row.method == "dynamic"]
    assert again.check.rows == stored.check.rows
    dd.report(stored, tmp_path / "report.html")
    page = (tmp_path / "report.html").read_text()
    assert "Check by NTC 2018" in page
    assert "C8.7.1.12" not in page
    assert f"{check.value('nonlinear', 'SLV', 'period'):.6g}" in page
    wrong = CASE.format(root=root).replace("'b'", "'F'")
    (tmp_path / "wrong.nml").write_text(wrong)
    run = subprocess.run([executable, "wrong.nml"], cwd=tmp_path, check=False, capture_output=True, text=True)
    assert run.returncode == 2
    assert "wrong.nml: &check: soil = 'f': must be one of" in run.stderr


def test_hazard_of_rigid_ground(root, executable, tmp_path):
    """A hazard curve in ag is refused beside a check whose soil amplifies it."""
    rock = tmp_path / "rock.csv"
    rock.write_text("ag (g),return_period\n0.04,30\n0.1,140\n0.18,475\n0.3,2475\n")
    (tmp_path / "wall.nml").write_text(CASE.format(root=root).replace("soil = 'b'", "soil = 'D'"))
    subprocess.run([executable, "--quiet", "wall.nml"], cwd=tmp_path, check=True, capture_output=True)
    stored = dd.read_results(tmp_path / "out/wall")
    with pytest.warns(dd.errors.DondoloWarning, match="rigid ground"):
        hazard = dd.HazardCurve.from_csv(rock)
    hazard.to_csv(tmp_path / "again.csv")
    with pytest.warns(dd.errors.DondoloWarning, match="rigid ground"):
        again = dd.HazardCurve.from_csv(tmp_path / "again.csv")
    hazard.save(tmp_path / "hazard.npz")
    for one in (hazard, hazard.smoothed(), again, dd.load(tmp_path / "hazard.npz")):
        assert one.rigid_ground
        with pytest.raises(
            dd.errors.InputError, match="ag, of rigid, level ground, and the check has soil D, topography T1"
        ):
            dd.report(stored, tmp_path / "report.html", hazard=one)
        assert not (tmp_path / "report.html").exists()
    # S = 2.4 - 1.5 F0 a_g, between 0.9 and 1.8, of class D
    surface = np.clip(2.4 - 1.5 * 2.5 * hazard.levels, 0.9, 1.8) * hazard.levels
    dd.report(stored, tmp_path / "report.html", hazard=dd.HazardCurve(surface, hazard.annual_frequency))
    command = [executable, "report", "out/wall", "--hazard", "rock.csv"]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True)
    assert done.returncode == 2
    assert "the check has soil D" in done.stderr
    # On rock the factors are 1
    (tmp_path / "wall.nml").write_text(CASE.format(root=root).replace("soil = 'b'", "soil = 'A'"))
    subprocess.run([executable, "--quiet", "wall.nml"], cwd=tmp_path, check=True, capture_output=True)
    dd.report(dd.read_results(tmp_path / "out/wall"), tmp_path / "rock.html", hazard=hazard)


def test_population(root, executable, tmp_path):
    """The rows of the executable are the checks of the walls, each with its own curve."""
    (tmp_path / "walls.csv").write_text(
        "name,mechanism,height,thickness,period1,damping1,participation1,load1,load1_depth,load1_height,load1_inertia,"
        "young_modulus1\n"
        "a,one_sided,3.0,0.25,,,,,,,,\nb,one_sided,1.5,0.25,0.3,,1.2,,,,,\nc,one_sided,3.0,0.25,0.3,0,1.2,,,,,\n"
        "d,free_standing,2.0,0.4,,,,1e3,0.2,2.0,both,1e9\ne,two_block,3.0,0.25,,,,,,,,\n"
    )
    (tmp_path / "case.nml").write_text(
        "&job task = 'typology', output = 'out' /\n&population file = 'walls.csv' /\n"
        f"&records catalogue = '{root}/data/records/synthetic44.csv' /\n&stripes levels = 0.2, 0.4, 0.8 /\n"
        "&check ag = 0.08, 0.2, 0.26, f0 = 2.5, tc_star = 0.35, soil = 'B', knowledge_factor = 1.2 /\n"
    )
    subprocess.run([executable, "--quiet", "case.nml"], cwd=tmp_path, check=True)
    lines = [line for line in (tmp_path / "out_checks.csv").read_text().splitlines() if not line.startswith("#")]
    rows = list(csv.DictReader(lines))
    stored = dd.read_results(tmp_path / "out")
    site = dd.Site((0.08, 0.2, 0.26), 2.5, 0.35, soil="B")
    assert [row["wall"] for row in rows] == ["a", "b", "c", "d", "e"]
    assert [bool(row["note"]) for row in rows] == [False, False, True, False, False]
    assert rows[2]["note"].startswith("damping = 0: must be positive for the spectrum of a floor of the code")
    assert not rows[2]["alpha_0"]
    for row, wall, curve in zip(rows, stored.population, stored.typology.curves, strict=True):
        if row["note"]:
            continue
        check = dd.check_ntc(wall, site, knowledge_factor=1.2)
        for method, state in check.capacities:
            for quantity, unit in (("capacity_pga", "g"), ("ratio", "ratio")):
                value = check.value(method, state, quantity)
                assert float(row[f"{method}_{state.lower()}_{unit}"]) == pytest.approx(value, rel=1e-14)
        if curve.has_fit:
            assert float(row["probability_site"]) == pytest.approx(curve(check.pga), rel=1e-9)


def test_a_wall_in_another_unit_is_warned_of():
    """As stripes warn of it, and once where both are run."""
    wall = dd.OneSidedWall(300.0, 25.0, name="in cm")
    records = dd.synthetic_records(6.5, 10.0, "shallow", n_records=2)
    with pytest.warns(dd.errors.DondoloWarning) as caught:
        dd.check_ntc(wall, SITE)
    with pytest.warns(dd.errors.DondoloWarning) as said:
        dd.multiple_stripe(wall, records, [0.1, 0.2], progress=False)
    found = [one.message for one in caught]
    assert {one.code for one in found} == {"value_above_usual"}
    assert found == [one.message for one in said if one.message.code == "value_above_usual"]
    with pytest.warns(dd.errors.DondoloWarning) as both:
        dd.compare_designs({"one": wall}, records, [0.1, 0.2], site=SITE, progress=False)
    assert [one.message for one in both if one.message.code == "value_above_usual"] == found


def test_check_without_a_run(run, root):
    """`--check` prints the kinematic check of one wall, and none of a population."""
    for case, shown in (("facade", True), ("facade_hinges", False)):
        done = run("--check", root / f"data/cases/{case}.nml")
        assert (done.returncode, bool(re.search(r"(?m)^kinematic +capacity", done.stdout))) == (0, shown)


def total(items, name):
    """Sum of what the items have."""
    values = [getattr(item, name) for item in items]
    return sum(value for value in values if value == value)


@pytest.mark.parametrize("tied", [False, True])
def test_sums_by_hand(tied):
    """A facade of two storeys with loads, a thrust and a tie, whose sums were made by hand."""
    ties = [dd.Tie(6.6, area=1e-4, length=10.0, strength=235e6, preload=50e6, strain=0.02, modulus=2.06e11)]
    wall = dd.OneSidedWall(
        sections=[dd.Section(3.8, 0.70), dd.Section(3.4, 0.55)],
        density=2000.0,
        loads=[
            dd.Load(9e3, depth=0.55, height=3.8, inertia="both"),
            dd.Load(7e3, depth=0.40, height=7.2, inertia="both"),
        ],
        thrusts=[dd.Thrust(2.5e3, height=6.6)],
        compressive_strength=1e6,
        ties=ties if tied else [],
    )
    check = dd.check_ntc(wall, SITE)
    items = {item.item: item for item in check.items}
    expected = {
        "section 1": (52189.2, 0.288306705882353, 1.9, 15046.4963346353, 99159.48),
        "section 2": (36689.4, 0.213306705882353, 5.5, 7826.0950548, 201791.7),
        "load 1": (9000.0, 0.488306705882353, 3.8, 4394.76035294118, 34200.0),
        "load 2": (7000.0, 0.338306705882353, 7.2, 2368.14694117647, 50400.0),
    }
    for name, (force, arm, lever, stabilising, first) in expected.items():
        found = items[name]
        assert (found.force, found.arm, found.lever) == pytest.approx((force, arm, lever), rel=1e-13)
        assert (found.stabilising, found.force_lever) == pytest.approx((stabilising, first), rel=1e-12)
    assert items["thrust 1"].overturning == pytest.approx(16500.0, rel=1e-14)
    assert (items["masonry"].depth, items["masonry"].lever) == pytest.approx(
        (0.319039735099338, 3.38609271523179), rel=1e-13
    )
    if tied:
        assert items["tie 1"].stabilising == pytest.approx(155100.0, rel=1e-14)
    first, second = (total(items.values(), name) for name in ("force_lever", "force_lever2"))
    assert second == pytest.approx(1511888.59823841, rel=1e-13)
    alpha = (total(items.values(), "stabilising") - total(items.values(), "overturning")) / first
    assert alpha == pytest.approx(0.436350625832744 if tied else 0.034069403402041, rel=1e-12)
    assert alpha == pytest.approx(check.value("mechanism", "", "alpha_0"), rel=1e-14)
    mass = first**2 / second / 9.81
    assert mass == pytest.approx(10022.481748554, rel=1e-12)
    assert mass == pytest.approx(check.value("mechanism", "", "mass"), rel=1e-14)


@pytest.mark.parametrize(
    "wall",
    [
        dd.OneSidedWall(3.0, 0.25, hinge_depth=0.02, inertial_masses=[dd.InertialMass(200.0, height=2.0, depth=0.1)]),
        dd.FreeStandingWall(2.0, 0.4),
        dd.TwoBlockWall(
            3.0, 0.25, hinge=0.6, overburden=20e3, overburden_inertia=0, eccentricity=-0.065, hinge_depth=0.01
        ),
        dd.OneSidedWall(3.0, 0.25, interlock=dd.Interlock(overlap=0.12, course=0.10, thickness=0.25, spacing=5.0)),
    ],
    ids=["pushed", "free_standing", "strip", "friction"],
)
def test_sums_of_any_wall(wall):
    check = dd.check_ntc(wall, SITE)
    first, second = (total(check.items, name) for name in ("force_lever", "force_lever2"))
    alpha = (total(check.items, "stabilising") - total(check.items, "overturning")) / first
    assert alpha == pytest.approx(check.value("mechanism", "", "alpha_0"), rel=1e-13)
    assert first**2 / second / 9.81 == pytest.approx(check.value("mechanism", "", "mass"), rel=1e-13)


def test_sums_in_files(root, executable, tmp_path):
    """Ten lines without dondolo make alpha_0 and M* of the sheet out of the table."""
    (tmp_path / "wall.nml").write_text(CASE.format(root=root))
    subprocess.run([executable, "--quiet", "wall.nml"], cwd=tmp_path, check=True)
    tables = []
    for name in ("calculation", "check"):
        lines = (tmp_path / f"out/wall_{name}.csv").read_text().splitlines()
        tables.append(list(csv.DictReader(line for line in lines if not line.startswith("#"))))
    items, sheet = tables
    names = ("stabilising_nm_m", "overturning_nm_m", "force_lever_nm_m", "force_lever2_nm2_m")
    against, along, first, second = (sum(float(row[name] or 0) for row in items) for name in names)
    value = {row["quantity"]: float(row["value"]) for row in sheet if row["method"] == "mechanism"}
    assert (against - along) / first == pytest.approx(value["alpha_0"], rel=1e-14)
    assert first**2 / second / 9.81 == pytest.approx(value["mass"], rel=1e-14)


def test_notes():
    """What the numbers of a sheet do not say is a note: a diaphragm, a hinge that is not the weakest, a long period."""

    def notes(wall):
        return " ".join(map(str, dd.check_ntc(wall, SITE, building_period=0.3).notes))

    house = {"period": 0.3, "damping": 0.05, "storeys": 3, "level": 3.0, "level_top": 6.0, "building_height": 9.0}
    loaded = {"hinge": 0.63, "overburden": 20e3, "overburden_inertia": 0, "eccentricity": 0.02}
    assert notes(dd.TwoBlockWall(3.0, 0.25, **loaded, building=dd.Building(**house))) == ""
    soft = dd.TwoBlockWall(3.0, 0.25, **loaded, building=dd.Building(**house, diaphragm_period=0.4))
    assert "diaphragm at the top moves the strip" in notes(soft)
    assert dd.check_ntc(soft, SITE).value("mechanism", "", "diaphragm_period") == 0.4
    assert "the check is at the weakest hinge" in notes(dd.TwoBlockWall(3.0, 0.25, **{**loaded, "hinge": 0.8}))
    assert "decreases with the height of the hinge" in notes(dd.TwoBlockWall(3.0, 0.25))
    assert "beyond T_E" in notes(dd.OneSidedWall(20.0, 0.4))


def test_levels_that_are_not_those_of_the_site_are_told(records):
    site = dd.Site(ag=[0.08, 0.2, 0.26], f0=[2.5, 2.5, 2.5], tc_star=[0.3, 0.35, 0.36], soil="B")
    check = dd.check_ntc(dd.OneSidedWall(9.0, 0.5), site)
    stripes = dd.multiple_stripe(check.wall, records[:3], [0.1, check.pga], progress=False)
    with pytest.raises(dd.errors.InputError, match=r"of SLC: levels must have check.site.pga\(limit_state='SLC'\)"):
        check.dynamic(stripes)
    levels = [check.pga, site.pga(limit_state="SLC")]
    assert "dynamic" in {row.method for row in check.dynamic(dd.multiple_stripe(check.wall, records[:3], levels)).rows}


NEAR = dd.Building(0.3, storeys=3, level=0.1, building_height=9.6)
THREE = dd.Site((0.08, 0.2, 0.26), 2.5, (0.3, 0.35, 0.36), soil="B")


def test_a_floor_asks_for_no_less_than_the_ground():
    """Near the ground the sum over modes vanishes; every route takes the ground instead, and says so."""
    for level in (0.02, 0.1, 0.5, 1.5, 4.0, 9.0):
        house = dd.Building(0.3, storeys=3, level=level, building_height=9.6)
        for state in ("SLD", "SLV", "SLC"):
            ground, floor = (THREE.spectrum(limit_state=state, **more) for more in ({}, {"building": house}))
            np.testing.assert_array_less(ground.sa * (1.0 - 1e-14), floor.sa)
        near, on = (dd.check_ntc(dd.OneSidedWall(3.0, 0.25, **more), THREE) for more in ({"building": house}, {}))
        for key in near.capacities:
            assert near.value(*key, "ratio") <= on.value(*key, "ratio") * (1.0 + 1e-12), (level, key)
        a_z = near.value("site", "SLV", "floor_pga")
        notes = [note for note in near.notes if note.code == "ground_governs"]
        if near._row("site", "SLV", "modal_pga") is None:
            assert a_z > near.pga
            assert near._row("site", "SLD", "modal_pga") is None or notes
        else:
            (note,) = notes
            assert a_z == near.pga
            assert near.value("site", "SLV", "modal_pga") < near.pga
            assert "by analogy with [C7.2.11]" in str(note)
            assert note.numbers["modal_g"] < note.numbers["ground_g"]


def test_stiff_strips_and_the_ground():
    """At T < T_1 the spectrum of modes is less than that of the ground although a_Z is more; the ground's counts."""
    house = dd.Building(1.0, participation=0.9, participation_top=0.9)
    strip = dd.TwoBlockWall(2.5, 0.45, hinge=0.6, overburden=3e5, overburden_inertia=0.0, building=house)
    check = dd.check_ntc(strip, dd.Site(0.1, 2.5, 0.5, soil="A"))
    period = check.value("nonlinear", "SLV", "period")
    assert period < 1.0
    assert check._row("site", "SLV", "modal_pga") is None
    ground = dd.Site(0.1, 2.5, 0.5, soil="A").spectrum(periods=[period, 5.0], damping=0.08).sa[0]
    assert check.value("nonlinear", "SLV", "modal_demand") < ground
    assert check.value("nonlinear", "SLV", "spectral_demand") == pytest.approx(ground, rel=1e-12)
    (note,) = (note for note in check.notes if note.code == "ground_governs")
    assert note.subject["quantity"] == "S_eZ"


def test_documents_say_that_the_ground_governs(root, executable, tmp_path):
    """Console, report and calculation report in both languages; a population has the numbers of its walls."""
    house = "&building period = 0.3, storeys = 3, level = 0.1, building_height = 9.6 /\n"
    (tmp_path / "wall.nml").write_text(CASE.format(root=root) + house)
    done = subprocess.run([executable, "wall.nml"], cwd=tmp_path, check=True, capture_output=True, text=True)
    assert "note: the modes of the building give a_Z = " in done.stdout
    results = dd.read_results(tmp_path / "out/wall")
    for lang, words, chapter in (
        ("en", "of the ground, which governs", "give less than the ground itself, which then governs"),
        ("it", "del suolo, che governa", "danno meno del suolo stesso, che allora governa"),
    ):
        dd.report(results, tmp_path / "report.html", lang=lang)
        dd.calculation_report(results, tmp_path / "relazione.html", lang=lang)
        assert words in (tmp_path / "report.html").read_text()
        assert words in (tmp_path / "relazione.html").read_text()
        assert chapter in (tmp_path / "relazione.html").read_text()
