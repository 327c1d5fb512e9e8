"""Period and damping of the building in each limit state of a check: given, or the worst between T and 2 T.

Expected numbers are those of an independent program of 40 digits (finite kinematics; strips by brute force).
"""

import csv
import dataclasses
import subprocess

import pytest

import dondolo as dd
from dondolo.errors import InputError
from dondolo.reporting.language import Language
from dondolo.reporting.relazione.floors import modes_in
from dondolo.reporting.relazione.subjects import Subject
from dondolo.reporting.words import warning

AQUILA = {"ag": (0.104, 0.261, 0.334), "f0": (2.332, 2.364, 2.4), "tc_star": (0.281, 0.347, 0.364)}
LOW = {"ag": (0.04, 0.10, 0.13), "f0": (2.5, 2.55, 2.6), "tc_star": (0.27, 0.29, 0.30)}


def on(period, participation):
    return dd.Building(period, damping=0.05, participation=participation)


def strip(height, thickness, density, hinge, load, eccentricity, building):
    return dd.TwoBlockWall(
        height, thickness, density=density, hinge=hinge, overburden=load, overburden_inertia=0.0,
        eccentricity=eccentricity, building=building,
    )  # fmt: skip


# Wall, site, period; zeta_E of SLV as given, at 1.5 T with 10 %, at 2 T with 20 %; taken, and at which period / T
WALLS = {
    "D1": (
        dd.OneSidedWall(1.2, 0.40, density=1800.0, building=on(0.28, 9 / 7)), dd.Site(**AQUILA, soil="B"), 0.28,
        0.684310316958439, 0.417326147765334, 0.387431962974075, 0.376549007263092, 1.7,
    ),
    "D2": (
        dd.OneSidedWall(3.5, 0.60, density=1900.0, loads=[dd.Load(6000.0, depth=0.40, height=3.5, inertia="both")],
                        building=on(0.26, 1.0)), dd.Site(**AQUILA, soil="B"), 0.26,
        0.823149602388048, 0.750949598170647, 0.590839515138589, 0.590839515138589, 2.0,
    ),
    "D3": (
        strip(3.3, 0.30, 1800.0, 0.65, 15000.0, -0.05, on(0.28, 0.9)), dd.Site(**AQUILA, soil="B"), 0.28,
        0.769224219576059, 0.769224219576059, 0.769224219576059, 0.769224219576059, 1.0,
    ),
    "D4": (
        strip(3.0, 0.14, 1500.0, 0.75, 1800.0, -0.025, on(0.35, 1.1)), dd.Site(**LOW, soil="C"), 0.35,
        0.342716900185212, 0.342716900185212, 0.342716900185212, 0.342716900185212, 1.0,
    ),
}  # fmt: skip

pytestmark = pytest.mark.filterwarnings("ignore::dondolo.errors.DondoloWarning")


def index_of(check):
    """zeta_E of SLV at the hinge that is given."""
    return check.value("assigned" if check._has("assigned", "SLV", "zeta_e") else "nonlinear", "SLV", "zeta_e")


@pytest.mark.parametrize("name", WALLS)
def test_numbers(name):
    wall, site, period, given, middle, last, taken, at = WALLS[name]
    assert index_of(dd.check_ntc(wall, site, building_period=period)) == pytest.approx(given, rel=1e-12)
    for factor, damping, expected in ((1.5, 0.10, middle), (2.0, 0.20, last)):
        check = dd.check_ntc(
            wall, site, building_period=(period, factor * period, factor * period),
            building_damping=(0.05, damping, damping),
        )  # fmt: skip
        assert index_of(check) == pytest.approx(expected, rel=1e-12)
    check = dd.check_ntc(wall, site)
    assert index_of(check) == pytest.approx(taken, rel=1e-12)
    if name in ("D1", "D2"):
        assert check.zeta_e == index_of(check)
        shown = [check.value("nonlinear", "SLV", "building_zeta", item=item) for item in ("T_1", "1.5 T_1", "2 T_1")]
        assert shown == pytest.approx([given, middle, last], rel=1e-12)
        lower = dd.check_ntc(
            wall, site, building_period=(period, 2 * period, 2 * period), building_damping=(0.05, 0.1, 0.1)
        )
        assert check.value("nonlinear", "SLV", "building_zeta", item="2 T_1, 10 %") == pytest.approx(
            lower.zeta_e, rel=1e-12
        )
        assert lower.zeta_e < taken
        assert check.value("nonlinear", "SLV", "building_period") == pytest.approx(at * period, rel=1e-12)


def test_other_modes_keep_their_ratio_and_one_value_is_of_all_states():
    both = dd.Building((0.30, 0.11), damping=(0.05, 0.07), participation=(1.2, -0.4))
    wall = dd.OneSidedWall(3.0, 0.5, building=both)
    site = dd.Site(**AQUILA, soil="C")
    longer = dd.OneSidedWall(
        3.0, 0.5, building=dd.Building((0.60, 0.22), damping=(0.05, 0.07), participation=(1.2, -0.4))
    )
    one, three = (dd.check_ntc(wall, site, building_period=period) for period in (0.6, (0.6, 0.6, 0.6)))
    same = dd.check_ntc(longer, site, building_period=0.6)
    for method, state in (("linear", "SLD"), ("nonlinear", "SLV"), ("nonlinear", "SLC")):
        assert one.value(method, state, "ratio") == three.value(method, state, "ratio")
        assert one.value(method, state, "ratio") == pytest.approx(same.value(method, state, "ratio"), rel=1e-12)
    # SLD and the linear check have the building as it is given, whatever SLV has
    searched, given = dd.check_ntc(wall, site), dd.check_ntc(wall, site, building_period=0.30)
    for state in ("SLD", "SLV"):
        assert searched.value("linear", state, "ratio") == given.value("linear", state, "ratio")
    assert searched.zeta_e <= given.zeta_e


def test_on_the_ground_nothing_changes():
    wall, site = dd.OneSidedWall(3.0, 0.5), dd.Site(**AQUILA, soil="B")
    check = dd.check_ntc(wall, site)
    assert not check._has("nonlinear", "SLV", "building_period")
    assert dd.check_ntc(wall, site, building_period=0.9).zeta_e == check.zeta_e
    assert not any(note.code == "building_softened" for note in check.notes)


def test_note():
    wall, site, *_, taken, _at = WALLS["D1"]
    check = dd.check_ntc(wall, site)
    (note,) = (note for note in check.notes if note.code == "building_softened")
    assert note.subject == {"limit_state": "SLV"}
    assert note.numbers["zeta_e"] == pytest.approx(taken, rel=1e-12)
    assert note.numbers["building_period_s"] == pytest.approx(0.476, rel=1e-12)
    assert note.numbers["building_damping"] == pytest.approx(0.14, rel=1e-12)
    assert "allo SLV il periodo dell'edificio è assunto 0,476 s" in warning(Language("it"), note)
    assert not any(note.code == "building_softened" for note in dd.check_ntc(wall, site, building_period=0.28).notes)


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"building_period": (0.3, 0.4)}, "building_period: has 2 values, must have one, or three"),
        ({"building_damping": 0.1}, "building_damping: only with building_period"),
        ({"building_period": 0.3, "building_damping": (0.1, 0.1)}, "building_damping: has 2 values"),
    ],
)
def test_refused(options, message):
    with pytest.raises(InputError, match=message):
        dd.check_ntc(dd.OneSidedWall(3.0, 0.5, building=on(0.3, 1.2)), dd.Site(**AQUILA), **options)


def test_executable(executable, root, tmp_path):
    """The executable has the same numbers, reads given periods, and prints the note."""
    lists = {name: ", ".join(map(str, values)) for name, values in AQUILA.items()}
    for name, more, expected in (
        ("free", "", 0.376549007263092),
        ("given", ", building_period = 0.28", 0.684310316958439),
    ):
        (tmp_path / f"{name}.nml").write_text(
            f"&job task = 'stripes', output = '{name}' /\n"
            "&wall mechanism = 'one_sided', height = 1.2, thickness = 0.40, density = 1800 /\n"
            f"&building period = 0.28, damping = 0.05, participation = {9 / 7} /\n"
            f"&check ag = {lists['ag']}, f0 = {lists['f0']}, tc_star = {lists['tc_star']}, soil = 'B'{more} /\n"
            f"&records catalogue = '{root / 'data/records/synthetic44.csv'}' /\n&stripes levels = 0.3, 0.6 /\n"
        )
        done = subprocess.run([executable, f"{name}.nml"], cwd=tmp_path, capture_output=True, text=True, check=True)
        assert ("the period of the building is taken as 0.476 s" in done.stdout) == (name == "free")
        with (tmp_path / f"{name}_check.csv").open(encoding="utf-8") as file:
            rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
        (found,) = (
            float(row["value"]) for row in rows
            if (row["method"], row["limit_state"], row["quantity"]) == ("nonlinear", "SLV", "zeta_e")
        )  # fmt: skip
        assert found == pytest.approx(expected, rel=1e-12)
        read = dd.read_results(tmp_path / name)
        assert read.check.zeta_e == pytest.approx(expected, rel=1e-12)
        # Written again by Python, it is the same check
        settings, _site = read.check._settings()
        assert settings.get("building_period") == ([0.28] * 3 if name == "given" else None)


def test_period_is_proposed(tmp_path, executable):
    """A building without a period is refused, with a first approximation for its height."""
    (tmp_path / "case.nml").write_text(
        "&job task = 'stripes', output = 'out' /\n&wall mechanism = 'one_sided', height = 3, thickness = 0.4 /\n"
        "&building storeys = 3, level = 3, building_height = 9 /\n&records catalogue = 'no.csv' /\n"
    )
    done = subprocess.run([executable, "case.nml"], cwd=tmp_path, capture_output=True, text=True, check=False)
    assert done.returncode != 0
    assert "period: must be given of a building" in done.stderr
    assert "0.05 H^(3/4) = 0.2598 s" in done.stderr


def test_period_of_the_displacement_of_the_top(tmp_path, executable, root):
    """T_1 = 2 sqrt(d): the check is that of a building with this period, by the executable too; documents have d."""
    house = {"storeys": 3, "level": 3.0, "building_height": 9.0}
    building = dd.Building(top_displacement=0.02, **house)
    assert building.periods == pytest.approx([0.282842712474619], rel=1e-12)
    given = dd.Building(building.periods, **house)
    wall, same = (dd.OneSidedWall(3.0, 0.4, building=one) for one in (building, given))
    site = dd.Site(**AQUILA, soil="B")
    check = dd.check_ntc(wall, site)
    assert check.rows == dd.check_ntc(same, site).rows
    assert dataclasses.replace(building, level=6.0).periods == building.periods
    with pytest.raises(InputError, match=r"period: not with top_displacement = 0.02, whose period 2 sqrt"):
        dd.Building(0.3, top_displacement=0.02, **house)
    study = dd.Study(dd.read_catalogue(root / "data/records/synthetic44.csv"), [0.3, 0.6])
    catalogue = root / "data/records/synthetic44.csv"
    dd.write_case(tmp_path / "case.nml", wall, study, catalogue=catalogue, output="out", check=check)
    text = (tmp_path / "case.nml").read_text()
    assert "top_displacement = 0.02" in text
    assert " period = " not in text
    subprocess.run([executable, "--quiet", "case.nml"], cwd=tmp_path, check=True)
    results = dd.read_results(tmp_path / "out")
    assert results.check.zeta_e == check.zeta_e
    assert results.check.wall.building == building
    for lang, words in (("it", "assegnato dal progettista (NTC 7.3.3.2"), ("en", "given by the designer (NTC 7.3.3.2")):
        dd.calculation_report(results, tmp_path / f"{lang}.html", lang=lang)
        assert words in " ".join((tmp_path / f"{lang}.html").read_text(encoding="utf-8").split())


def test_document(tmp_path, executable, root):
    """The calculation report has the steps from the modes to the spectrum of the floor, and its figure."""
    site = ", ".join(f"{name} = {', '.join(map(str, values))}" for name, values in AQUILA.items())
    (tmp_path / "case.nml").write_text(
        "&job task = 'stripes', output = 'out' /\n"
        "&wall mechanism = 'one_sided', height = 1.2, thickness = 0.40, density = 1800 /\n"
        "&building period = 0.28, storeys = 3, level = 9, building_height = 9 /\n"
        f"&check {site}, soil = 'B' /\n"
        f"&records catalogue = '{root / 'data/records/synthetic44.csv'}' /\n&stripes levels = 0.3, 0.6 /\n"
    )
    subprocess.run([executable, "--quiet", "case.nml"], cwd=tmp_path, capture_output=True, check=True)
    results = dd.read_results(tmp_path / "out")
    one = Subject(results.check.wall, results.check, None, results)
    # D1: steps that give the numbers of the check, to the last step of the row
    (mode,) = modes_in(one, "SLV", "nonlinear")
    assert (mode.period, mode.damping, mode.shape) == pytest.approx((0.476, 0.14, 9 / 7), rel=1e-12)
    check = results.check
    wall = [check.value("nonlinear", "SLV", name) for name in ("period", "damping")]
    assert mode.peak * mode.resonance(*wall) == pytest.approx(check.value("nonlinear", "SLV", "spectral_demand"))
    (given,) = modes_in(one, "SLD")
    assert given.peak == pytest.approx(check.value("linear", "SLD", "floor_pga"), rel=1e-12)
    for lang, words in (
        ("it", ("Spettro di piano allo SLV", "Accelerazione di picco di piano, SLD", "al periodo dello SLC", "0,476")),
        ("en", ("Spectrum of the floor at SLV", "Peak acceleration of the floor, SLD", "the period of SLC", "0.476")),
    ):
        dd.calculation_report(results, tmp_path / f"{lang}.html", lang=lang)
        page = (tmp_path / f"{lang}.html").read_text(encoding="utf-8")
        assert [sentence for sentence in words if sentence not in page] == [], lang
