"""What a check by NTC 2018 assumes and concludes: its confidence factor, required rows, verdict, and sliding hinges."""

import re
import subprocess

import matplotlib
import pytest

import dondolo as dd

matplotlib.use("agg")

AQUILA = dd.Site(
    ag=(0.104, 0.261, 0.334), f0=(2.332, 2.364, 2.4), tc_star=(0.281, 0.347, 0.364), soil="B"
)  # fmt: skip
CASE = """&job task = 'stripes', output = 'out/wall' /
&wall name = 'w', mechanism = 'one_sided', {wall}, density = 1900 /
&records catalogue = '{root}/data/records/synthetic44.csv' /
&stripes levels = 0.2, 0.4 /
&check ag = 0.104, 0.261, 0.334, f0 = 2.332, 2.364, 2.4, tc_star = 0.281, 0.347, 0.364, soil = 'B' {check} /
"""


def codes(check):
    return [note.code for note in check.notes]


@pytest.fixture
def solve(tmp_path, executable, root):
    """Runs a case: what the console says, and its results."""

    def run(wall="height = 6.0, thickness = 0.6", check=""):
        (tmp_path / "wall.nml").write_text(CASE.format(root=root, wall=wall, check=check))
        done = subprocess.run([executable, "wall.nml"], cwd=tmp_path, check=True, capture_output=True, text=True)
        return done.stdout, dd.read_results(tmp_path / "out/wall")

    return run


def documents(results, folder):
    """Report and calculation report in both languages."""
    found = {}
    for lang in ("en", "it"):
        dd.report(results, folder / "report.html", lang=lang)
        dd.calculation_report(results, folder / "relazione.html", lang=lang)
        found[lang] = tuple((folder / f"{name}.html").read_text() for name in ("report", "relazione"))
    return found


# --- Confidence factor


@pytest.mark.parametrize("more", [{}, {"hinge_depth": 0.0}])
def test_without_a_compressive_strength_the_factor_is_that_of_lc1(more):
    """A depth of the hinge alone does not count."""
    wall = dd.OneSidedWall(6.0, 0.6, density=1900.0, **more)
    full = dd.check_ntc(wall, AQUILA)
    for given in (1.0, 1.2):
        check = dd.check_ntc(wall, AQUILA, knowledge_factor=given)
        assert check.value("mechanism", "", "knowledge_factor") == 1.35
        assert check.value("mechanism", "", "knowledge_given") == given
        assert check.value("mechanism", "", "a_0") == pytest.approx(0.726666666666667, rel=1e-12)
        assert check.value("nonlinear", "SLV", "ratio") == pytest.approx(0.617409401206005, rel=1e-12)
        assert check.verified == full.verified
        (note,) = (one for one in check.notes if one.code == "knowledge_raised")
        assert note.numbers == {"knowledge_given": given, "knowledge_factor": 1.35}
        # Written and read back, the case asks for the same
        assert check._settings()[0]["knowledge_factor"] == given
    assert not full._has("mechanism", "", "knowledge_given")
    assert "knowledge_raised" not in codes(full)


@pytest.mark.parametrize("wall", [dd.OneSidedWall, dd.FreeStandingWall, dd.TwoBlockWall])
def test_with_a_compressive_strength_the_factor_is_as_given(wall):
    check = dd.check_ntc(wall(3.0, 0.3, compressive_strength=2e6), AQUILA, knowledge_factor=1.2)
    assert check.value("mechanism", "", "knowledge_factor") == 1.2
    assert "knowledge_raised" not in codes(check)
    bare = dd.check_ntc(wall(3.0, 0.3), AQUILA, knowledge_factor=1.2)
    assert bare.value("mechanism", "", "knowledge_factor") == 1.35


def test_every_document_says_which_factor_the_check_has(solve, tmp_path):
    said, results = solve(check=", knowledge_factor = 1.2")
    assert "note: the confidence factor of the check is 1.35, that of LC1, in place of 1.2" in said
    assert results.check.value("mechanism", "", "knowledge_given") == 1.2
    found = documents(results, tmp_path)
    for page in found["en"]:
        assert "the confidence factor of the check is 1.35, that of LC1, in place of 1.2" in page
    for page in found["it"]:
        assert "fattore di confidenza della verifica 1,35, quello del livello LC1, al posto di 1,2" in page


# --- The verdict


def facade(height, thickness, loads=(), ties=(), thrusts=(), density=1900.0):
    """A wall with loads (weight, depth, height), thrusts (force, depth, height) and ties (force, height, strain)."""
    return dd.OneSidedWall(
        height,
        thickness,
        density=density,
        loads=[dd.Load(load, depth=depth, height=at, inertia="both") for load, depth, at in loads],
        thrusts=[dd.Thrust(force, depth=depth, height=at) for force, depth, at in thrusts],
        ties=[
            dd.Tie(at, depth=0.0, area=force / 2e8, strength=2e8, length=10.0, strain=strain, anchor_force=2.0 * force)
            for force, at, strain in ties
        ],
    )


LOADS = [(8000.0, 0.4, 3.0), (8000.0, 0.4, 6.0), (5000.0, 0.4, 9.0)]
HELD = facade(9.0, 0.6, LOADS, [(2e4, 6.0, 0.02), (1e4, 9.0, 0.02)], density=1800.0)
WEAK = facade(
    6.0, 0.5, [(5000.0, 0.35, 6.0)], [(6000.0, 5.0, 0.045)], [(1000.0, 0.5, 5.0)], density=2000.0
)  # fmt: skip


@pytest.mark.parametrize("use_class", ["I", "II", "III", "IV"])
@pytest.mark.parametrize(("wall", "zeta", "holds"), [(HELD, 1.33421530646542, True), (WEAK, 0.837369695191886, False)])
def test_the_verdict_rests_on_the_ultimate_state(wall, zeta, holds, use_class):
    check = dd.check_ntc(wall, dd.Site(AQUILA.ag, AQUILA.f0, AQUILA.tc_star, soil="B", use_class=use_class))
    assert check.zeta_e == pytest.approx(zeta, rel=1e-12)
    assert check.satisfied == holds
    needed = (("linear", "SLD"), ("nonlinear", "SLV")) if use_class == "IV" else (("nonlinear", "SLV"),)
    assert check.required == needed
    for key in check.capacities:
        assert check.value(*key, "required") == float(key in needed)
    assert ("serviceability" in codes(check)) == (use_class == "IV")


def test_damage_counts_for_class_iv_alone():
    """A stocky wall that slides little in displacement, but starts early."""
    site = {"ag": (0.2, 0.2, 0.2), "f0": 2.5, "tc_star": 0.35, "soil": "B"}
    wall = dd.OneSidedWall(9.0, 1.2)
    ratio = dd.check_ntc(wall, dd.Site(**site)).value("linear", "SLD", "ratio")
    assert ratio < 1.0 < dd.check_ntc(wall, dd.Site(**site)).zeta_e
    assert dd.check_ntc(wall, dd.Site(**site)).satisfied
    assert not dd.check_ntc(wall, dd.Site(**site, use_class="IV")).satisfied


def test_no_wall_is_refused_for_what_is_information():
    """Bare walls with a ratio of the ultimate state of at least 1 are satisfied, and no others."""
    refused = 0
    for height in (1.0, 1.6, 2.5, 4.0, 6.5, 9.5, 13.0):
        for slenderness in (2.0, 3.0, 4.0, 5.5, 7.0, 9.0, 12.0):
            for state in ("SLV", "SLC"):
                check = dd.check_ntc(dd.OneSidedWall(height, height / slenderness), AQUILA, ultimate_state=state)
                assert check.ultimate_state == state
                assert check.zeta_e == check.value("nonlinear", state, "ratio")
                assert check.satisfied == (check.zeta_e >= 1.0)
                refused += check.satisfied and not all(check.verified.values())
    assert refused > 10


def test_slc_needs_its_own_hazard():
    with pytest.raises(dd.errors.InputError, match=r"ultimate_state = 'SLC': needs the hazard of SLC: give ag of SLD"):
        dd.check_ntc(HELD, dd.Site(0.2, 2.5, 0.35), ultimate_state="SLC")
    with pytest.raises(dd.errors.InputError, match="ultimate_state = 'sld': must be one of 'SLV', 'SLC'"):
        dd.check_ntc(HELD, AQUILA, ultimate_state="SLD")


@pytest.mark.parametrize(
    ("wall", "check", "which", "holds"),
    [
        ("height = 6.0, thickness = 0.6", "", "nonlinear SLV", False),
        ("height = 14, thickness = 2", "", "nonlinear SLV", True),
        ("height = 14, thickness = 2", ", use_class = 'IV'", "linear SLD and nonlinear SLV", False),
        ("height = 14, thickness = 2", ", ultimate_state = 'SLC'", "nonlinear SLC", True),
    ],
)
def test_all_documents_have_the_same_verdict(solve, tmp_path, wall, check, which, holds):
    said, results = solve(wall, check)
    found = results.check
    again = dd.check_ntc(found.wall, found.site, **found_options(results))
    assert again.rows == tuple(
        row for row in found.rows if row.method != "dynamic" and not row.quantity.startswith("probability")
    )
    assert f"verdict: {'' if holds else 'not '}satisfied ({which}, NTC 8.3" in said
    assert found.satisfied == holds
    pages = documents(results, tmp_path)
    report, relazione = pages["en"]
    comma = which.replace(" and ", ", ")
    assert (f"Satisfied by NTC 2018: all that the verdict rests on ({comma})" in report) == holds
    assert ("Not satisfied by NTC 2018: " in report) != holds
    assert (f": satisfied ({comma})" in relazione) == holds
    assert (f"NOT satisfied ({comma})" in relazione) != holds
    assert "What NTC 2018 ask of interventions." in relazione
    assert "Che cosa le NTC 2018 chiedono agli interventi." in pages["it"][1]
    assert (": soddisfatta (" if holds else "NON soddisfatta (") in pages["it"][1]


def found_options(results):
    given = results.run.settings["check"]
    return {
        name: given[name] for name in ("knowledge_factor", "behaviour", "ultimate_state", "friction") if name in given
    }


# --- Sliding


LIGHT = facade(3.5, 0.6, [(6000.0, 0.4, 3.5)])
BARE = facade(6.0, 0.5, [(5000.0, 0.35, 6.0)], thrusts=[(1000.0, 0.5, 5.0)], density=2000.0)


@pytest.mark.parametrize(
    ("wall", "needed"),
    [
        (dd.OneSidedWall(6.0, 0.6, density=1900.0), 0.1),
        (dd.OneSidedWall(0.9, 0.9, density=1900.0), 1.0),
        (LIGHT, 0.158020499266327),
        (BARE, 0.0711583348789438),
    ],
)
def test_friction_that_a_hinge_needs(wall, needed):
    check = dd.check_ntc(wall, AQUILA)
    assert check.value("mechanism", "", "friction_needed", item="base hinge") == pytest.approx(needed, rel=1e-12)
    assert not check._has("mechanism", "", "sliding_alpha")
    assert ("friction_not_given" in codes(check)) == (needed > 0.4)
    alpha = check.value("mechanism", "", "alpha_0")
    for factor in (0.5, 0.999, 1.0, 1.001, 1.5):
        given = dd.check_ntc(wall, AQUILA, friction=factor * needed)
        assert "friction_not_given" not in codes(given)
        assert (given.value("mechanism", "", "sliding_alpha") < alpha) == (factor < 1.0 - 1e-9) or factor == 1.0
        assert (given.sliding == ("base hinge",)) == ("slides_first" in codes(given)) == (factor < 1.0)
        # Nothing else depends on it
        for key, ratio in check._of("ratio").items():
            assert given.value(*key, "ratio") == ratio


def test_a_stocky_wall_slides():
    """Of 0.9 m by 0.9 m it slides at 0.4 with a friction of 0.4, and a great ratio is not enough."""
    check = dd.check_ntc(dd.OneSidedWall(0.9, 0.9, density=1900.0), AQUILA, friction=0.4)
    assert check.value("mechanism", "", "sliding_alpha") == pytest.approx(0.4, rel=1e-12)
    assert check.zeta_e == pytest.approx(2.46105711668943, rel=1e-12)
    assert not check.satisfied
    assert "base hinge slides before it turns" in str(check)
    assert check._settings()[0]["friction"] == 0.4


def test_hinges_of_a_strip():
    strip = dd.TwoBlockWall(3.0, 0.25, hinge=0.6, overburden=2e4, overburden_inertia=0.0, eccentricity=0.02)
    needed = {
        row.item: row.value
        for row in dd.check_ntc(strip, AQUILA).rows
        if (row.method, row.quantity) == ("mechanism", "friction_needed")
    }
    assert needed.keys() == {"base hinge", "middle hinge", "top hinge"}
    middle = sorted(needed.values())[1]
    check = dd.check_ntc(strip, AQUILA, friction=1.001 * middle)
    assert check.sliding == (max(needed, key=needed.get),)
    assert not check._has("mechanism", "", "sliding_alpha")


def test_every_document_says_that_a_hinge_slides(solve, tmp_path):
    said, results = solve("height = 0.9, thickness = 0.9", ", friction = 0.4")
    assert "note: the base hinge slides before it turns: friction = 0.4, and it needs 1 " in said
    assert "verdict: satisfied if no hinge slides (nonlinear SLV" in said
    pages = documents(results, tmp_path)
    for page in pages["en"]:
        assert "the base hinge slides before it turns: friction = 0.4" in page
    for page in pages["it"]:
        assert "cerniera alla base: scorre prima di ruotare, perché con un attrito 0,4" in page
    assert "a hinge slides before it turns: base hinge" in pages["en"][0]
    assert "una cerniera scorre prima di ruotare." in pages["it"][1]
    assert "note-fine" not in pages["en"][1]


TOGETHER = {
    "independent": "house,one_sided,6.8,0.5,1900,0.05,independent\nhouse,two_block,3.2,0.3,1900,0.5,independent\n",
    "exclusive": "house,one_sided,6.8,0.5,1900,0.4,exclusive\nhouse,two_block,3.2,0.3,1900,0.6,exclusive\n",
}


@pytest.mark.filterwarnings("ignore::dondolo.errors.DondoloWarning")
@pytest.mark.parametrize("occurrence", TOGETHER)
def test_the_probability_of_several_mechanisms_at_the_site(root, tmp_path, executable, occurrence):
    """By the curve of the wall, but not less than that of a mechanism times its probability: in report and console."""
    rows = "name,mechanism,height,thickness,density,p_occ,occurrence\n" + TOGETHER[occurrence]
    (tmp_path / "walls.csv").write_text(rows)
    case = tmp_path / "case.nml"
    case.write_text(
        f"&job task = 'typology' output = '{tmp_path}/result' /\n&population file = '{tmp_path}/walls.csv' /\n"
        f"&records catalogue = '{root}/data/records/synthetic44.csv' /\n&stripes first = 0.1 last = 1.5 count = 8 /\n"
        "&check ag = 0.104, 0.261, 0.334 f0 = 2.332, 2.364, 2.4 tc_star = 0.281, 0.347, 0.364 soil = 'B' /\n"
    )
    printed = subprocess.run([executable, case], check=True, capture_output=True, text=True).stdout
    results = dd.read_results(tmp_path / "result")
    people = results.typology
    (pga,) = {check.pga for check in results.checks}
    alone = [p * float(curve(pga)) for p, curve in zip(people.population.p_occ, people.curves, strict=True)]
    expected = max(float(people.unions["house"](pga)), *alone)
    ((found, more),) = re.findall(r"'house': probability of collapse at a_g S = \S+ g: ([\d.]+)(;.*)?\n", printed)
    assert float(found) == pytest.approx(expected, rel=2e-3)
    # Alternatives of one mechanism are their mixture: no other number stands beside it.
    assert ("taken as independent" in more) == (occurrence == "independent")
    dd.report(results, tmp_path / "report.html")
    text = " ".join((tmp_path / "report.html").read_text(encoding="utf-8").split())
    (shown,) = re.findall(r"Probability of collapse by any mechanism that occurs.*?same histories: ([\d.]+\d)", text)
    assert float(shown) == pytest.approx(expected, abs=6e-4)
    assert ("One of the mechanisms, or of their alternatives, occurs" in text) == (occurrence == "exclusive")
    # Rows of one wall are told apart by their mechanisms.
    for mechanism in ("one_sided", "two_block"):
        assert re.search(rf"(?m)^house, {mechanism} ", printed)
