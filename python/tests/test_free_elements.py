"""Free elements in a check by NTC 2018 (Circolare 7/2019, C8.7.1.2.1.3 and .5), against values of another program."""

import csv
import re
import subprocess

import matplotlib
import numpy as np
import pytest

import dondolo as dd

matplotlib.use("agg")

PARAPET = {"ag": (0.04, 0.10, 0.13), "f0": (2.5, 2.55, 2.6), "tc_star": (0.27, 0.29, 0.30), "soil": "B"}
AQUILA = {"ag": (0.104, 0.261, 0.334), "f0": (2.332, 2.364, 2.4), "tc_star": (0.281, 0.347, 0.364)}
# Height, thickness, density, E, period and participation of the building, site; T_0, a_Z, S_eZ(T_0), ratio of SLD,
# linear ratio of SLV, zeta_E, d_y
CASES = {
    "B1": (
        (1.8, 0.40, 1800, 750e6), ([0.20], [1.2]), PARAPET,
        (0.0778004894586146, 0.144718208944141, 0.369031432807559, 0.302912781547209, 0.772427592945382,
         0.54342062641648, 0.426212256012925, 1.9069936330739, 0.000247265696183557),
    ),
    "B2": (
        (2.5, 0.45, 1800, 750e6), ([0.25], [9 / 7]), {**AQUILA, "soil": "B"},
        (0.1334027597027, 0.376052333344335, 0.91938447747738, 1.10465048027208, 2.70068395951193,
         0.120701828962672, 0.0987404193398693, 0.681642628567343, 0.000588036588046671),
    ),
    "B3": (
        (3.0, 0.50, 1900, 435e6), ([0.30, 0.11], [1.2, -0.4]), {**AQUILA, "soil": "C"},
        (0.233236419939526, 0.455959090385846, 1.02336183413305, 2.13477471491408, 4.81350672709367,
         0.0578312967925638, 0.0512959873634573, 0.548143202287876, 0.00165747919369073),
    ),
    "B4": (
        (2.4, 0.38, 1700, 600e6), None, {**AQUILA, "soil": "A"},
        (0.15819014050824, 0.104, 0.261, 0.242528, 0.617004,
         0.483589320067307, 0.380172415794011, 0.92296411401113, 0.00072644275811484),
    ),
}  # fmt: skip
ROWS = (
    ("mechanism", "", "t0"), ("linear", "SLD", "floor_pga"), ("linear", "SLV", "floor_pga"),
    ("linear", "SLD", "floor_t0"), ("linear", "SLV", "floor_t0"), ("linear", "SLD", "ratio"),
    ("linear", "SLV", "ratio"), ("nonlinear", "SLV", "zeta_e"), ("mechanism", "", "yield_displacement"),
)  # fmt: skip
WALL = "&wall mechanism = '{mechanism}', height = {0}, thickness = {1}, density = {2}, young_modulus = {3} /\n"
SITE = dd.Site(**PARAPET)
GABLE = dd.Section(2.0, 0.3, base_width=1.0, top_width=0.0)


def wall_of(name, kind=dd.OneSidedWall, **more):
    (height, thickness, density, modulus), modes, _, _ = CASES[name]
    if modes:
        more["building"] = dd.Building(period=modes[0], participation=modes[1])
    return kind(height, thickness, density=density, **{"young_modulus": modulus} | more)


def codes(check):
    return [note.code for note in check.notes]


@pytest.mark.parametrize("kind", [dd.OneSidedWall, dd.FreeStandingWall])
@pytest.mark.parametrize("name", CASES)
def test_published_parapets(name, kind):
    wall = wall_of(name, kind)
    # The building of all limit states as it is given
    period = {} if wall.building is None else {"building_period": np.max(wall.building.period)}
    check = dd.check_ntc(wall, dd.Site(**CASES[name][2]), **period)
    assert [check.value(*row) for row in ROWS] == pytest.approx(CASES[name][3], rel=1e-12)
    assert check.value("mechanism", "", "yield_acceleration") < check.value("mechanism", "", "a_0")
    assert check.not_applicable == ()
    assert "free_behaviour" in codes(check)
    assert "free_behaviour" not in codes(dd.check_ntc(check.wall, check.site, behaviour=1.0))


@pytest.mark.parametrize("name", CASES)
def test_published_parapets_by_the_executable(name, executable, root, tmp_path):
    given, modes, site, expected = CASES[name]
    lists = [", ".join(map(repr, values)) for values in modes or ((), ())]
    building = f"&building period = {lists[0]}, participation = {lists[1]} /\n"
    (tmp_path / "case.nml").write_text(
        "&job task = 'stripes', output = 'out' /\n"
        + WALL.format(*given, mechanism="free_standing" if name == "B4" else "one_sided")
        + (building if modes else "")
        + f"&records catalogue = '{root}/data/records/synthetic44.csv' /\n&stripes levels = 0.2, 0.8 /\n&check "
        + ", ".join(f"{what} = {', '.join(map(repr, np.atleast_1d(values).tolist()))}" for what, values in site.items())
        + (f", building_period = {max(modes[0])!r}" if modes else "")
        + " /\n"
    )
    done = subprocess.run([executable, "case.nml"], cwd=tmp_path, check=True, capture_output=True, text=True)
    lines = [line for line in (tmp_path / "out_check.csv").read_text().splitlines() if not line.startswith("#")]
    rows = {(row["method"], row["limit_state"], row["quantity"]): float(row["value"]) for row in csv.DictReader(lines)}
    assert [rows[row] for row in ROWS] == pytest.approx(expected, rel=1e-12)
    assert (
        "note: the behaviour factor of the linear check of SLV is 2; for parapets Table C7.2.I has q_a = 1"
        in done.stdout
    )
    stored = dd.read_results(tmp_path / "out")
    assert stored.check.wall.young_modulus == (given[3],)
    again = dd.check_ntc(wall_of(name), dd.Site(**site), **({"building_period": max(modes[0])} if modes else {}))
    assert [note.code for note in stored.check.notes] == codes(again)


@pytest.mark.parametrize(
    ("kind", "more"), [(dd.FreeStandingWall, {}), (dd.OneSidedWall, {"free": True})], ids=["free_standing", "one_sided"]
)
def test_without_young_modulus(kind, more):
    """What starts it is not known, so that displacements alone count, and class IV is not verified."""
    known = dd.check_ntc(kind(0.4, 0.5, young_modulus=1e11), SITE)
    check = dd.check_ntc(kind(0.4, 0.5, **more), SITE)
    assert check.not_applicable == (("linear", "SLD"), ("linear", "SLV"))
    assert check._row("linear", "SLD", "applicable").formula == "C8.7.1.2.1.5"
    assert codes(check)[0] == "modulus_missing"
    assert "linear SLD not applicable" in str(check)
    for state in ("SLV", "SLC"):
        of_displacements = check.value("nonlinear", state, "displacement") / check.value("nonlinear", state, "demand")
        assert check.value("nonlinear", state, "ratio") == pytest.approx(of_displacements, rel=1e-14)
        # A stiff wall starts at a_Z, which governs for so stocky a one
        assert known.value("nonlinear", state, "ratio") > 1.2 * of_displacements
    assert check.satisfied
    fourth = dd.check_ntc(check.wall, dd.Site(**PARAPET, use_class="IV"))
    assert not fourth.verified["linear", "SLD"]
    assert not fourth.satisfied


def test_a_stiff_element_starts_at_the_peak():
    """S_eZ tends to a_Z with the period."""
    stiff = dd.check_ntc(wall_of("B1", young_modulus=1e12), SITE)
    held = dd.check_ntc(wall_of("B1", young_modulus=None), SITE)
    for state in ("SLD", "SLV"):
        assert stiff.value("linear", state, "ratio") == pytest.approx(held.value("linear", state, "ratio"), rel=0.1)
        assert stiff.value("linear", state, "ratio") < held.value("linear", state, "ratio")


def test_the_greatest_demand_of_a_range():
    """By a grid of single values, through resonance with one mode and between two."""
    site = dd.Site(**AQUILA, soil="C")
    for period, participation in (([0.15], [1.2]), ([0.34, 0.16], [1.0, -0.9]), ([0.30, 0.11], [1.2, -0.4])):
        building = dd.Building(period=period, participation=participation)
        wide = dd.OneSidedWall(3.0, 0.5, density=1900, young_modulus=(1.5e8, 2.5e9), building=building)
        check = dd.check_ntc(wide, site)
        assert "period_between" in codes(check)
        assert check.value("mechanism", "", "t0") == check.value("mechanism", "", "shortest_t0")
        single = [
            dd.check_ntc(dd.OneSidedWall(3.0, 0.5, density=1900, young_modulus=one, building=building), site)
            for one in np.geomspace(1.5e8, 2.5e9, 200)
        ]
        assert check.value("mechanism", "", "longest_t0") == pytest.approx(
            single[0].value("mechanism", "", "t0"), rel=1e-14
        )
        for state in ("SLD", "SLV"):
            demands = [one.value("linear", state, "floor_t0") for one in single]
            assert check.value("linear", state, "floor_t0") == pytest.approx(max(demands), rel=1e-3)
            assert check.value("linear", state, "floor_t0") >= max(demands)


def test_elements_that_the_formula_is_not_for():
    """Sections that differ, masses and springs give ranges that hold the period, here that of finite elements."""
    heights, thicknesses = (1.0, 1.4), (0.5, 0.3)
    sections = [dd.Section(*one) for one in zip(heights, thicknesses, strict=True)]
    loads = [dd.Load(3e3, depth=0.2, height=2.4, inertia="both")]
    stepped = dd.check_ntc(dd.OneSidedWall(sections=sections, young_modulus=9e8), SITE)
    loaded = dd.check_ntc(dd.OneSidedWall(sections=sections, loads=loads, young_modulus=9e8), SITE)
    sprung = dd.check_ntc(
        dd.OneSidedWall(2.4, 0.4, young_modulus=9e8, springs=[dd.Spring(1e3, depth=0.0, height=2.4)]), SITE
    )
    for check, mass in ((stepped, 0.0), (loaded, 3e3 / 9.81)):
        period = beam_period(heights, thicknesses, 9e8, 1800.0, mass)
        assert check.value("mechanism", "", "shortest_t0") < period < check.value("mechanism", "", "longest_t0")
    assert sprung.value("mechanism", "", "shortest_t0") == 0.0
    # The formula itself, of a uniform beam
    assert beam_period((2.0,), (0.4,), 9e8, 1800.0, 0.0) == pytest.approx(
        6.1904 / 6.2 * 6.2 * 10 * (1800 / 9e8) ** 0.5, rel=1e-4
    )


def beam_period(heights, thicknesses, modulus, density, mass):
    """First period of a cantilever with a mass at its end, by Euler-Bernoulli elements."""
    parts = 40
    size = [height / parts for height in heights for _ in range(parts)]
    thick = [one for one in thicknesses for _ in range(parts)]
    n = 2 * (len(size) + 1)
    stiff, inert = np.zeros((n, n)), np.zeros((n, n))
    for i, (h, t) in enumerate(zip(size, thick, strict=True)):
        where = slice(2 * i, 2 * i + 4)
        stiff[where, where] += (modulus * t**3 / 12 / h**3) * np.array(
            [[12, 6 * h, -12, 6 * h], [6 * h, 4 * h**2, -6 * h, 2 * h**2], [-12, -6 * h, 12, -6 * h],
             [6 * h, 2 * h**2, -6 * h, 4 * h**2]]
        )  # fmt: skip
        inert[where, where] += (density * t * h / 420) * np.array(
            [[156, 22 * h, 54, -13 * h], [22 * h, 4 * h**2, 13 * h, -3 * h**2], [54, 13 * h, 156, -22 * h],
             [-13 * h, -3 * h**2, -22 * h, 4 * h**2]]
        )  # fmt: skip
    inert[-2, -2] += mass
    squares = np.linalg.eigvals(np.linalg.solve(inert[2:, 2:], stiff[2:, 2:])).real
    return 2 * np.pi / np.sqrt(squares.min())


@pytest.mark.parametrize(
    ("more", "words"),
    [
        ({"young_modulus": 1e6}, "young_modulus = 1000000: too small for this wall: its elastic branch"),
        ({"young_modulus": [1e9, 2e9, 3e9]}, "young_modulus: has 3 values, must have one, or two, the ends of a range"),
        ({"young_modulus": 1e9, "free": False}, "free = .false.: not with young_modulus"),
        ({"free": 1.0}, "free = 1.0: must be True or False"),
        (
            {"free": True, "interlock": dd.Interlock(overlap=0.1, course=0.1, thickness=0.3, spacing=5.0)},
            "free: not with overlaps of interlock, by which transverse walls hold the wall",
        ),
        (
            {"young_modulus": 1e9, "height": None, "thickness": None, "sections": [GABLE]},
            "young_modulus: not with a section that ends in a point",
        ),
        ({"young_modulus": -1.0}, "young_modulus = -1: must be positive"),
    ],
)  # fmt: skip
def test_refusals(more, words):
    with pytest.raises(dd.errors.InputError) as caught:
        dd.check_ntc(dd.OneSidedWall(**{"height": 3.0, "thickness": 0.5} | more), SITE)
    assert words in str(caught.value)


def test_refused_before_anything_runs(run, root, tmp_path):
    (tmp_path / "case.nml").write_text(
        "&job task = 'stripes', output = 'out' /\n&wall mechanism = 'one_sided', height = 3, thickness = 0.5, "
        f"young_modulus = 1e6 /\n&records catalogue = '{root}/data/records/synthetic44.csv' /\n"
        "&stripes levels = 0.2 /\n&check ag = 0.2, f0 = 2.5, tc_star = 0.35 /\n"
    )
    done = run("--check", "case.nml")
    assert done.returncode == 2
    assert "meets the curve of capacity at d_y = " in done.stderr


@pytest.mark.parametrize(
    ("level", "height", "more", "is_asked"),
    [
        (0.0, 3.0, {}, False),
        (9.0, 1.5, {}, True),
        (6.0, 3.0, {}, True),
        (0.0, 10.0, {}, True),
        (6.0, 3.0, {"free": False}, False),
        (6.0, 3.0, {"ties": [dd.Tie(2.5, area=5e-5, length=5.0)]}, False),
        (6.0, 3.0, {"interlock": dd.Interlock(overlap=0.1, course=0.1, thickness=0.3, spacing=5.0)}, False),
        (0.0, 9.0, {"hinge_level": 7.0}, True),
    ],
)
def test_a_wall_that_may_be_free_is_asked(level, height, more, is_asked):
    building = dd.Building(period=0.3, storeys=3, level=level, building_height=9.0)
    check = dd.check_ntc(dd.OneSidedWall(height, 0.5, building=building, **more), SITE)
    assert ("perhaps_free" in codes(check)) == is_asked
    assert check.not_applicable == ()


def test_histories_do_not_know_of_it():
    """The wall stays the bare block that it is, to the bit."""
    records = dd.synthetic_records(6.5, 10.0, "shallow", n_records=3)
    bare = dd.multiple_stripe(dd.FreeStandingWall(1.5, 0.3), records, [0.5, 1.0], progress=False)
    known = dd.multiple_stripe(dd.FreeStandingWall(1.5, 0.3, young_modulus=1e9), records, [0.5, 1.0], progress=False)
    assert np.array_equal(bare.edp, known.edp)


def test_documents(root, executable, tmp_path):
    """Notes and rows in every document and language."""
    (tmp_path / "case.nml").write_text(
        "&job task = 'stripes', output = 'out' /\n&wall mechanism = 'one_sided', height = 1.8, thickness = 0.4, "
        "young_modulus = 0.5e9, 1e9 /\n&building period = 0.2, participation = 1.2 /\n"
        f"&records catalogue = '{root}/data/records/synthetic44.csv' /\n&stripes levels = 0.2, 0.8 /\n"
        "&check ag = 0.04, 0.1, 0.13, f0 = 2.5, tc_star = 0.28, soil = 'B' /\n"
    )
    subprocess.run([executable, "--quiet", "case.nml"], cwd=tmp_path, check=True, capture_output=True)
    known = dd.read_results(tmp_path / "out")
    text = (tmp_path / "case.nml").read_text().replace("young_modulus = 0.5e9, 1e9", "free = .true.")
    (tmp_path / "other.nml").write_text(text.replace("'out'", "'other'"))
    done = subprocess.run([executable, "other.nml"], cwd=tmp_path, check=True, capture_output=True, text=True)
    assert done.stdout.count("not applicable: a free element without young_modulus") == 2
    unknown = dd.read_results(tmp_path / "other")
    assert unknown.check.wall.free is True
    words = {
        "en": (
            "Table C7.2.I has q_a = 1", "the elastic period of the free element lies", "young_modulus is not given"
        ),
        "it": (
            "la Tabella C7.2.I ha q_a = 1", "il periodo elastico dell'elemento libero è", "manca E: per un elemento"
        ),
    }  # fmt: skip
    for lang, (behaviour, between, missing) in words.items():
        for results, expected in ((known, (behaviour, between)), (unknown, (missing,))):
            dd.report(results, tmp_path / "report.html", lang=lang)
            dd.calculation_report(results, tmp_path / "relazione.html", lang=lang)
            for name in ("report", "relazione"):
                page = (tmp_path / f"{name}.html").read_text().replace("&#39;", "'").replace("\u2019", "'")
                for one in expected:
                    assert one.lower() in page.lower(), (lang, name, one)
    page = (tmp_path / "relazione.html").read_text()
    assert "elemento libero" in page
    assert "sono assunti dal progettista" in page


def test_rows_of_the_table_of_the_circolare(root, executable):
    """The help, the live page and the documentation have the same, and the proposal is the mean and half of it."""
    page = (root / "docs/code_checks.md").read_text()
    rows = re.findall(r"(?m)^\| .+ \| (\d+)-(\d+) \| (\d+)-(\d+) \|$", page)
    table = [tuple(map(int, row)) for row in rows]
    assert len(table) == 8
    for low, high, half, mean in table:
        assert (half, mean) == ((low + high) / 4, (low + high) / 2)
    pairs = {row[:2] for row in table}
    said = subprocess.run([executable, "--help"], capture_output=True, text=True, check=True).stdout
    assert {tuple(map(int, pair)) for pair in re.findall(r" (\d{3,4})-(\d{4})\b", said)} == pairs
    script = (root / "python/dondolo/serve/page/form.js").read_text()
    script = script[script.index("const MASONRY") :].partition("];")[0]
    assert {tuple(map(int, pair)) for pair in re.findall(r", (\d+), (\d+)\]", script)} == pairs
