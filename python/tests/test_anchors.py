"""Anchors of ties: bar, masonry round the plate, plate, and what they are for checks, curves and results.

Numbers are worked by hand (docs/ties.md); near the top of a wall points of a grid are counted.
"""

import csv
import dataclasses
import re
import subprocess

import matplotlib
import numpy as np
import pytest

import dondolo as dd
from dondolo.reporting.language import Language
from dondolo.reporting.words import warning

matplotlib.use("agg")

F_YD = 235e6 / 1.05
MASONRY = {"masonry_compression": 2e6, "masonry_shear": 4e4, "masonry_tension": 5e4}
PLATE = {"plate_width": 0.35, "plate_height": 0.35, "plate_thickness": 0.02}
SITE = dd.Site(ag=(0.104, 0.261, 0.334), f0=(2.332, 2.364, 2.400), tc_star=(0.281, 0.347, 0.364), soil="B")


def tie(**changes):
    given = {"bar": 0.024, "spacing": 2.5, "length": 10.0, "strength": F_YD, **PLATE} | changes
    height = given.pop("height", 4.0)
    return dd.Tie(height, **{name: value for name, value in given.items() if value is not None})


def wall(*ties, height=7.2, thickness=0.55, **more):
    return dd.OneSidedWall(height, thickness, density=2000.0, ties=ties or [tie()], **MASONRY | more)


def values(one, item="tie 1"):
    return {row.quantity: row.value for row in dd.check_ntc(one, SITE).rows if row.item == item}


def test_forces_by_hand():
    found = values(wall())
    expected = {
        "bar_force": 101249.043235694,
        "bearing_force": 90740.7407407407,
        "shear_force": 29333.3333333333,
        "cone_force": 36666.6666666667,
        "anchor_force": 29333.3333333333,
        "tie_force_per_m": 11733.3333333333,
        "plate_needed": 0.0162420957317356,
    }
    for name, value in expected.items():
        assert found[name] == pytest.approx(value, rel=1e-12), name
    assert (found["hierarchy"], found["plate_verified"], found["anchor_checked"]) == (0.0, 1.0, 1.0)
    rubbed = values(wall(tie(compression=5e4), masonry_friction=0.4))
    assert rubbed["shear_force"] == pytest.approx(49133.3333333333, rel=1e-12)
    # Master Magazine 7, p. 75: a circular plate, 2.79 kN
    small = tie(plate_width=None, plate_height=None, plate_diameter=0.1)
    round_one = values(wall(small, thickness=0.3, masonry_shear=2e4, masonry_tension=2e4))
    assert round_one["shear_force"] == pytest.approx(2792.52680319093, rel=1e-12)
    assert round_one["cone_force"] == pytest.approx(2792.52680319093, rel=1e-12)


@pytest.mark.parametrize(("above", "part"), [(2.0, 1.0), (0.4, 1.0), (0.1, None)])
def test_plate_near_the_top(above, part):
    """The frustum is no larger than what points in it say, and the upper face is missing where the top is near."""
    t, a, b, height = 0.55, 0.35, 0.25, 7.2
    plate = tie(height=height - above - 0.5 * b, plate_width=a, plate_height=b)
    found = values(wall(plate))
    full = 2.0 * t * (a + b + 2.0 * t)
    shear = full if part else t * (a + t) + 2.0 * t * (b + 0.5 * t + above)
    assert found["shear_force"] == pytest.approx(shear * 4e4 / 2.7, rel=1e-12)
    # Points of the inner face whose way back to the plate at 45 degrees stays in the wall
    x, z = np.meshgrid(np.linspace(-t - 0.5 * a, t + 0.5 * a, 1201), np.linspace(-t - 0.5 * b, t + 0.5 * b, 1201))
    inside = (np.abs(x) > 0.5 * a) | (np.abs(z) > 0.5 * b)
    area = np.mean(inside & (z < 0.5 * b + above)) * (a + 2.0 * t) * (b + 2.0 * t)
    cone = found["cone_force"] * 2.7 / 5e4
    assert cone <= area * 1.005
    if part:
        assert cone == pytest.approx(area, rel=5e-3)


def test_a_thinner_leaf_and_neighbours():
    assert values(wall(tie(leaf=0.25)))["masonry_thickness"] == 0.25
    # Where storeys meet behind the plate it is the thinner one
    storeys = dd.OneSidedWall(sections=[dd.Section(4.0, 0.7), dd.Section(3.2, 0.55)], ties=[tie(height=3.9)], **MASONRY)
    assert values(storeys)["masonry_thickness"] == 0.55
    # And where the frustum of the thicker one would reach the thinner: 0.175 + 0.7 m above the tie
    for height, thickness in ((3.13, 0.55), (3.12, 0.70)):
        storeys = dd.OneSidedWall(
            sections=[dd.Section(4.0, 0.7), dd.Section(3.2, 0.55)], ties=[tie(height=height)], **MASONRY
        )
        assert values(storeys)["masonry_thickness"] == thickness
    near = values(wall(tie(spacing=0.8)))
    assert near["band_force"] == pytest.approx(2.0 * 0.55 * 0.8 * 4e4 / 2.7, rel=1e-12) == near["anchor_force"]
    assert "band_force" not in values(wall())
    # Up to a + b + 2 t, 1.8 m, also where the frusta of the plates, of a + 2 t, do not meet
    apart = values(wall(tie(spacing=1.79)))
    assert apart["band_force"] == apart["anchor_force"] < apart["shear_force"]
    assert "band_force" not in values(wall(tie(spacing=1.81)))


def test_the_same_wall_by_its_force(root):
    """A plate and the force at which it gives way are one wall, history by history."""
    records = dd.read_catalogue(root / "data/records/synthetic44.csv")[:8]
    plate = wall()
    force = values(plate)["anchor_force_per_m"]
    bare = {"plate_width": None, "plate_height": None, "plate_thickness": None}
    given = dd.OneSidedWall(7.2, 0.55, density=2000.0, ties=[tie(**bare, anchor_force=force)])
    area = dd.OneSidedWall(
        7.2, 0.55, density=2000.0,
        ties=[tie(**bare, bar=None, spacing=None, area=np.pi * 0.024**2 / 4.0 / 2.5, anchor_force=force)],
    )  # fmt: skip
    runs = [dd.multiple_stripe(one, records, [0.2, 0.4, 0.8], progress=False) for one in (plate, given, area)]
    for run in runs[1:]:
        assert np.array_equal(run.edp, runs[0].edp)
        assert np.array_equal(run.broken_ties, runs[0].broken_ties)
    sheets = [dd.check_ntc(one, SITE) for one in (plate, given, area)]
    for sheet in sheets[1:]:
        for row in sheets[0].rows:
            if row.method != "tie":
                assert sheet.value(row.method, row.limit_state, row.quantity) == row.value


def test_the_design_of_the_facade():
    """A brittle anchor ends the linear check with q, and the sheet says so."""

    def facade(**how):
        return dd.OneSidedWall(
            sections=[dd.Section(3.8, 0.70), dd.Section(3.4, 0.55)],
            density=2000.0,
            loads=[
                dd.Load(9e3, depth=0.55, height=3.8, inertia="both"),
                dd.Load(7e3, depth=0.40, height=7.2, inertia="both"),
            ],
            thrusts=[dd.Thrust(2.5e3, height=6.6)],
            compressive_strength=1e6,
            ties=[
                dd.Tie(6.6, area=1e-4, length=10.0, strength=235e6, preload=50e6, strain=0.02, modulus=2.06e11, **how)
            ],
        )

    bar, anchored = (dd.check_ntc(facade(**how), SITE) for how in ({}, {"anchor_force": 11733.3333333333}))
    assert bar.value("mechanism", "", "alpha_0") == pytest.approx(0.436350625832744, rel=1e-12)
    assert anchored.value("mechanism", "", "alpha_0") == pytest.approx(0.234924708785881, rel=1e-12)
    assert anchored.value("nonlinear", "SLV", "displacement") == pytest.approx(1.94203798095088e-3, rel=1e-6)
    assert anchored.value("linear", "SLV", "ratio") == pytest.approx(1.23345407991995, rel=1e-6)
    assert anchored.value("nonlinear", "SLV", "ratio") == pytest.approx(0.616727039959977, rel=1e-6)
    assert not anchored.verified["linear", "SLV"]
    assert anchored.not_applicable == (("linear", "SLV"),)
    assert anchored.open_ties == {"tie 1": ("hierarchy",)}
    # By displacements the wall is better without the tie, which d_C ends where it breaks
    assert anchored.value("nonlinear", "SLV", "tied_zeta") == pytest.approx(0.616727039959977, rel=1e-6)
    note, other = anchored.notes
    assert other.code in ("ties_left_out", "ties_counted")
    assert (note.code, note.subject) == ("anchor_before_bar", {"item": "tie 1"})
    assert note.numbers["anchor_force_per_m"] == 11733.3333333333 < note.numbers["bar_force_per_m"]
    assert "hierarchy of strengths not respected" in str(note)
    # Italian documents have forces in kN/m.
    bar_force = f"{1e-3 * note.numbers['bar_force_per_m']:.4g}".replace(".", ",")
    assert f"cede a 11,73 kN/m, prima dello snervamento della barra a {bar_force} kN/m" in warning(Language("it"), note)
    assert "not applicable" in str(anchored)
    elastic = dd.check_ntc(anchored.wall, SITE, behaviour=1.0)
    assert elastic.not_applicable == ()
    # Without data of the anchor the sheet says that it is not checked
    assert bar.not_applicable == ()
    assert bar.open_ties == {"tie 1": ("anchor_checked",)}
    assert [(note.code, note.subject) for note in bar.notes][:1] == [("anchor_not_checked", {"item": "tie 1"})]
    assert [note.code for note in bar.notes][1:] == ["ties_counted"]
    assert "the anchor of tie 1 is not checked" in str(bar.notes[0])
    assert bar.verified["nonlinear", "SLV"]
    assert "nonlinear SLV verified if its ties are, a_g S up to" in str(bar)
    assert not re.search(r"SL[DVC] verified,", str(bar))


def test_a_wall_with_open_ties_is_not_satisfied(executable, root, tmp_path):
    """Neither in the report's verdict nor in the counts of a population, by the executable and by Python."""
    (tmp_path / "walls.csv").write_text(
        "name,mechanism,height,thickness,tie1_height,tie1_area,tie1_length,tie1_anchor_force\n"
        "bare,one_sided,3,0.6,,,,\nopen,one_sided,3,0.6,2.5,1e-4,5,\ngiven,one_sided,3,0.6,2.5,1e-4,5,1e5\n"
        "brittle,one_sided,3,0.6,2.5,1e-4,5,1e3\n"
    )
    (tmp_path / "case.nml").write_text(
        "&job task = 'typology', output = 'out' /\n&population file = 'walls.csv' /\n"
        "&check ag = 0.05, f0 = 2.5, tc_star = 0.3 /\n"
        f"&records catalogue = '{root / 'data/records/synthetic44.csv'}' /\n&stripes levels = 0.2, 0.6, 1.2 /\n"
    )
    done = subprocess.run([executable, "case.nml"], cwd=tmp_path, capture_output=True, text=True, check=True)
    lines = done.stdout.splitlines()
    place = next(i for i, line in enumerate(lines) if line.startswith("kinematic"))
    assert [line.split()[3] for line in lines[place + 1 : place + 5]] == ["2"] * 4
    assert lines[place + 5] == "satisfied where the verdict rests on it (nonlinear SLV): 2 rows"
    assert lines[place + 6].startswith("ties open (anchor not checked or weaker than the bar, plate too thin): 2 rows")
    with (tmp_path / "out_checks.csv").open() as file:
        rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
    void = {row["wall"]: row["linear_slv_g"] + row["linear_slv_ratio"] for row in rows}
    assert [name for name, text in void.items() if not text] == ["brittle"]
    results = dd.read_results(tmp_path / "out")
    dd.report(results, tmp_path / "report.html")
    page = " ".join(re.sub(r"<[^>]+>", "", (tmp_path / "report.html").read_text()).split())
    assert "linear, SLD: 2 of 4" in page
    assert "Of 2 something of the ties is open" in page
    assert "Open: anchors of the ties not checked" in page
    assert "no check by NTC 2018 fails that the verdict rests on (nonlinear SLV); ζ_E" in page
    assert "Satisfied by NTC 2018" not in page


def test_confidence_factor_of_the_check():
    """The curve knows that of the wall; a greater one in the check leaves the anchor unchecked."""
    low = wall(masonry_knowledge_factor=1.2)
    assert values(low)["bearing_force"] == pytest.approx(2e6 / 2.4 * 0.35**2, rel=1e-12)
    check = dd.check_ntc(low, SITE)
    assert "anchor_checked" in check.open_ties["tie 1"]
    assert {note.code: note.numbers for note in check.notes}["anchor_factor_differs"] == {"anchor_knowledge": 1.2}
    assert "anchor_checked" not in dd.check_ntc(low, SITE, knowledge_factor=1.2).open_ties["tie 1"]


def test_a_thin_plate():
    check = dd.check_ntc(wall(tie(plate_thickness=0.012)), SITE)
    assert "plate_verified" in check.open_ties["tie 1"]
    (note,) = (note for note in check.notes if note.code == "plate_too_thin")
    assert "the plate of tie 1 is too thin" in str(note)
    assert note.numbers["plate_thickness"] == 0.012 < note.numbers["plate_needed"]


@pytest.mark.parametrize(
    ("changes", "more", "words"),
    [
        ({"area": 1e-4}, {}, "give either .*area or .*bar"),
        ({"spacing": None}, {}, "spacing: must be given for tie 1 with"),
        ({"plate_height": None}, {}, "plate_height: must be given for tie 1"),
        ({"plate_diameter": 0.3}, {}, "give either a width and a height or a diameter"),
        ({"plate_thickness": None}, {}, "plate_thickness: must be given for tie 1 with its plate"),
        ({"anchor_force": 1e4}, {}, "anchor_force: tie 1 has a plate, give either"),
        ({"bar": None, "spacing": None, "area": 1e-4}, {}, "bar: must be given for tie 1 with its plate"),
        ({"bar": 0.4}, {}, "bar = 0.4: must be less than the plate"),
        ({"spacing": 0.3}, {}, "spacing = 0.3: must be more than the plate"),
        ({"height": 7.1}, {}, r"ties\[0\].height = 7.1: must be at least 0.175 m, half its plate"),
        ({"leaf": 0.6}, {}, r"ties\[0\].leaf = 0.6: must be at most 0.55 m"),
        ({"compression": 5e4}, {}, "masonry_friction: goes with"),
        ({}, {"masonry_shear": None}, "masonry_shear: must be given with the plates"),
        ({}, {"masonry_compression": None}, "masonry_compression: must be given with the plates"),
        (
            {"plate_width": None, "plate_height": None, "plate_thickness": None}, {},
            "masonry_shear: only with the plates of ties",
        ),
    ],
)  # fmt: skip
def test_what_is_refused(changes, more, words):
    with pytest.raises(dd.errors.InputError, match=words):
        wall(tie(**changes), **more)


def test_a_facade_keeps_the_plates_above_a_hinge():
    """What is above a hinge has the plates that are there, and no strengths where there are none."""
    ties = [tie(height=3.0), tie(height=6.6)]
    parts = dd.Population.of_facade(wall(*ties), hinge_level=(0.0, 3.5, 6.8))
    assert [len(part.ties) for part in parts] == [2, 1, 0]
    assert values(parts[1])["bearing_force"] == values(parts[0])["bearing_force"]
    assert parts[2].masonry_shear is None


CASE = """&job output = 'out' /
&wall mechanism = 'one_sided', height = 7.2, thickness = 0.55, density = 2000.0
   tie_height = 4.0, tie_bar = 0.024, tie_spacing = 2.5, tie_length = 10.0, tie_strength = {f_yd!r}
   tie_plate_width = 0.35, tie_plate_height = 0.35, tie_plate_thickness = 0.02
   masonry_compression = 2.0e6, masonry_shear = 4.0e4, masonry_tension = 5.0e4 /
&records catalogue = '{root}/data/records/synthetic44.csv' /
&stripes levels = 0.2, 0.4, 0.6, 0.8 /
&check ag = 0.104, 0.261, 0.334, f0 = 2.332, 2.364, 2.400, tc_star = 0.281, 0.347, 0.364, soil = 'B' /
"""


def test_case_files_and_archives(root, executable, tmp_path):
    """One sheet from a case, from memory, from files and from an archive."""
    (tmp_path / "wall.nml").write_text(CASE.format(root=root, f_yd=F_YD))
    done = subprocess.run([executable, "wall.nml"], cwd=tmp_path, check=True, capture_output=True, text=True)
    assert re.search(r"tie 1: holds 11730 N/m, by its shear: bar 101200 N", done.stdout)
    assert re.search(r"linear +SLV .* not applicable", done.stdout)
    assert "hierarchy of strengths not respected" in done.stdout
    check = dd.check_ntc(wall(), SITE)
    stored = dd.read_results(tmp_path / "out")
    again = dd.run_case(tmp_path / "wall.nml", progress=False)
    for found in (stored.check, again.check):
        rows = [row for row in found.rows if row.method != "dynamic" and not row.quantity.startswith("probability")]
        assert rows == [*check.rows]
        assert found.open_ties == check.open_ties
    assert stored.stripes.wall.ties == check.wall.ties
    check.save(tmp_path / "check.npz")
    assert dd.load(tmp_path / "check.npz").rows == check.rows
    ax = stored.stripes.wall.plot()
    assert sum(line.get_linestyle() == ":" for line in ax.lines) == 2
    dd.report(stored, tmp_path / "report.html")
    page = (tmp_path / "report.html").read_text()
    assert "not applicable" in page
    assert "hierarchy of strengths not respected" in page


def test_populations(root, executable, tmp_path):
    """Columns of a table; the checks of its rows, and which anchors are open."""
    columns = [
        "name",
        "mechanism",
        "height",
        "thickness",
        "density",
        "tie1_height",
        "tie1_bar",
        "tie1_spacing",
        "tie1_area",
    ]
    columns += ["tie1_length", "tie1_strength", "tie1_plate_width", "tie1_plate_height", "tie1_plate_thickness"]
    columns += [*MASONRY]
    plate = ["a", "one_sided", 7.2, 0.55, 2000.0, 4.0, 0.024, 2.5, "", 10.0, F_YD, 0.35, 0.35, 0.02, 2e6, 4e4, 5e4]
    rod = ["b", "one_sided", 7.2, 0.55, 2000.0, 4.0, "", "", 1e-4, 10.0, F_YD, "", "", "", "", "", ""]
    none = ["c", "one_sided", 7.2, 0.55, 2000.0, *[""] * 12]
    with open(tmp_path / "walls.csv", "w", newline="") as file:
        csv.writer(file).writerows([columns, plate, rod, none])
    (tmp_path / "case.nml").write_text(
        "&job task = 'typology', output = 'out' /\n&population file = 'walls.csv' /\n"
        f"&records catalogue = '{root}/data/records/synthetic44.csv' /\n&stripes levels = 0.2, 0.4, 0.8 /\n"
        "&check ag = 0.104, 0.261, 0.334, f0 = 2.332, 2.364, 2.400, tc_star = 0.281, 0.347, 0.364, soil = 'B' /\n"
    )
    done = subprocess.run([executable, "case.nml"], cwd=tmp_path, check=True, capture_output=True, text=True)
    assert re.search(r"(?m)^a .* not applicable", done.stdout)
    lines = [line for line in (tmp_path / "out_checks.csv").read_text().splitlines() if not line.startswith("#")]
    rows = list(csv.DictReader(lines))
    open_ones = [(row["anchors_checked"], row["hierarchy"], row["plates_verified"]) for row in rows]
    assert open_ones == [("1", "0", "1"), ("0", "", ""), ("", "", "")]
    check = dd.check_ntc(wall(), SITE)
    assert float(rows[0]["alpha_0"]) == check.value("mechanism", "", "alpha_0")
    assert dd.read_results(tmp_path / "out").population[0].ties == check.wall.ties


def of_facade(*ties):
    """The facade of docs/studies/cases_by_hand.md."""
    return dd.OneSidedWall(
        sections=[dd.Section(3.8, 0.70), dd.Section(3.4, 0.55)],
        density=2000.0,
        loads=[
            dd.Load(9e3, depth=0.55, height=3.8, inertia="both"),
            dd.Load(7e3, depth=0.40, height=7.2, inertia="both"),
        ],
        thrusts=[dd.Thrust(2.5e3, height=6.6)],
        compressive_strength=1e6,
        ties=ties,
    )


LIFE = dd.Site(
    ag=(0.104, 0.261, 0.334),
    f0=(2.332, 2.364, 2.400),
    tc_star=(0.281, 0.347, 0.364),
    soil="B",
    reference_life=50.0,
    exceedance=(0.63, 0.10, 0.05),
)


def computed(text):
    """A formula with numbers, computed without dondolo."""
    return eval(
        text.replace("^", "**").replace("ln(", "log("),
        {"pi": np.pi, "sqrt": np.sqrt, "log": np.log, "max": max, "min": min},
    )


@pytest.mark.parametrize("site", [LIFE, dd.Site(0.2, 2.5, 0.35, soil="B")])
@pytest.mark.parametrize(
    "one",
    [
        of_facade(),
        of_facade(dd.Tie(6.6, area=1e-4, length=10.0, strength=235e6, modulus=2.06e11)),
        dd.OneSidedWall(3.0, 0.25, hinge_depth=0.02),
        dd.TwoBlockWall(3.0, 0.25, hinge=0.6, overburden=20e3, overburden_inertia=0, eccentricity=0.02),
        dd.TwoBlockWall(3.0, 0.25, hinge=0.6, overburden=1.0, overburden_inertia=0, eccentricity=0.02),
    ],
    ids=["facade", "tied", "set_back", "strip", "nearly_bare"],
)
def test_formulas_with_numbers(one, site):
    """What a row shows with numbers in place of symbols gives its value."""
    rows = [row for row in dd.check_ntc(one, site).rows if row.numbers]
    assert {"a_0", "period", "demand", "zeta_e", "mass_ratio", "spectral_demand"} <= {row.quantity for row in rows}
    for row in rows:
        assert computed(row.numbers) == pytest.approx(row.value, rel=2e-6), row


@pytest.mark.parametrize("above", [2.0, 0.4, 0.1])
@pytest.mark.parametrize("rubs", [False, True])
@pytest.mark.parametrize("is_round", [False, True])
@pytest.mark.parametrize("spacing", [2.5, 0.5])
def test_formulas_of_an_anchor(above, rubs, is_round, spacing):
    """All of its forces have formulas, near the top of the wall too, where the top leaves less of the surfaces."""
    size = {"plate_width": None, "plate_height": None, "plate_diameter": 0.35} if is_round else {"plate_width": 0.3}
    friction = {"compression": 5e4} if rubs else {}
    plate = tie(height=7.2 - above - 0.175, spacing=spacing, **size, **friction)
    check = dd.check_ntc(wall(plate, **({"masonry_friction": 0.4} if rubs else {})), SITE)
    rows = {row.quantity: row for row in check.rows if row.item == "tie 1"}
    forces = {name for name in rows if name.endswith("_force")}
    assert forces >= {"bar_force", "bearing_force", "shear_force", "cone_force", "anchor_force"}
    assert ("band_force" in forces) == (spacing == 0.5)
    letters = {"pi": np.pi, "min": min, "t": 0.55, "a": 0.3, "b": 0.35, "c": above, "D": 0.35, "s": spacing}
    letters |= {"f_v0d": 4e4 / 2.7, "f_td": 5e4 / 2.7, "mu": 0.4, "sigma_0": 5e4}
    for name in forces:
        row = rows[name]
        assert row.expression, name
        assert computed(row.numbers) == pytest.approx(row.value, rel=2e-6), row
        if name in ("shear_force", "cone_force", "band_force"):
            # Symbols side by side, or beside brackets, are multiplied.
            text = re.sub(r"(?<=[\w)]) (?=[\w(])", "*", row.expression.replace("[", "(").replace("]", ")"))
            assert eval(text, letters) == pytest.approx(row.value, rel=1e-12), row


def test_return_periods():
    """Along straight lines in the logarithms of a_g and T_R, flagged where they are prolonged."""
    bare, tied = (
        dd.check_ntc(one, LIFE)
        for one in (of_facade(), of_facade(dd.Tie(6.6, area=1e-4, length=10.0, strength=235e6, preload=50e6)))
    )
    found = [bare.value("site", state, "return_period_demand") for state in ("SLD", "SLV", "SLC")]
    assert found == pytest.approx([50.2890476999767, 474.561079051495, 974.786287311184], rel=1e-12)
    assert bare.value("nonlinear", "SLV", "ratio") == pytest.approx(0.275290807164503, rel=1e-12)
    assert bare.value("nonlinear", "SLV", "zeta_e") == bare.value("nonlinear", "SLV", "ratio")
    assert bare.value("nonlinear", "SLC", "zeta_e") == pytest.approx(0.316164261537535, rel=1e-12)
    # Below 30 years only a bound is given, in every route; a longer reference life shows what lies behind it.
    assert (bare._row("nonlinear", "SLV", "return_period_capacity")[4], bare._safety()[-2:]) == (30.0, (30.0, -1.0))
    assert bare._row("nonlinear", "SLV", "return_period_capacity").bound == "<"
    longer = dd.check_ntc(bare.wall, dataclasses.replace(LIFE, reference_life=100.0))
    assert longer.value("nonlinear", "SLV", "return_period_capacity") == pytest.approx(2 * 20.4031023757149, rel=1e-11)
    assert longer._row("nonlinear", "SLV", "return_period_capacity").bound == ""
    longest = dd.check_ntc(tied.wall, dataclasses.replace(LIFE, reference_life=250.0))
    assert longest.value("nonlinear", "SLV", "return_period_capacity") == 2475.0
    assert longest._row("nonlinear", "SLV", "return_period_capacity").bound == ">"
    assert bare.value("nonlinear", "SLV", "extrapolated") == 1.0
    assert tied.value("nonlinear", "SLV", "return_period_capacity") == pytest.approx(705.503287278482, rel=1e-9)
    assert tied._row("nonlinear", "SLV", "return_period_capacity").bound == ""
    assert tied.value("nonlinear", "SLV", "extrapolated") == 0.0
    one = dd.check_ntc(
        of_facade(), dd.Site(0.261, 2.364, 0.347, soil="B", reference_life=75.0, exceedance=(0.63, 0.1, 0.05))
    )
    assert not any(row.quantity.startswith("return_period") for row in one.rows)
    with pytest.raises(dd.errors.InputError, match="exceedance: must decrease"):
        dd.Site(0.2, 2.5, 0.35, reference_life=50.0, exceedance=(0.05, 0.1, 0.63))
    with pytest.raises(dd.errors.InputError, match="reference_life: must be given with exceedance"):
        dd.Site(0.2, 2.5, 0.35, reference_life=50.0)


def test_what_any_wall_must_have():
    """alpha_0 g is the trigger, d_SLV at most 0.4 d_0, and a vanishing load on top leaves the bare strip."""
    house = dd.Building(period=0.3, damping=0.05, storeys=3, level=3.0, level_top=6.0, building_height=9.0)
    bare = dd.TwoBlockWall(3.0, 0.25, hinge_depth=0.015, building=house)
    strips = [
        dd.TwoBlockWall(
            3.0,
            0.25,
            hinge_depth=0.015,
            building=house,
            overburden=load,
            overburden_inertia=0,
            eccentricity=-0.06,
        )
        for load in (8e3, 1e-6)
    ]
    for one in (bare, *strips, dd.OneSidedWall(5.0, 0.4, hinge_depth=0.03)):
        check = dd.check_ntc(one, LIFE)
        # A hinge that is given is that of the trigger
        method = "assigned" if check._has("assigned", "", "alpha_0") else "mechanism"
        alpha = check.value(method, "", "alpha_0")
        assert alpha * one.gravity == pytest.approx(one.trigger_acceleration, rel=1e-14)
        assert check.value("nonlinear", "SLV", "displacement") <= 0.4 * check.value("mechanism", "", "d_0") * (
            1 + 1e-15
        )
    for quantity in ("alpha_0", "d_0", "a_0"):
        values = [dd.check_ntc(one, LIFE).value("mechanism", "", quantity) for one in (bare, strips[1])]
        assert values[1] == pytest.approx(values[0], rel=1e-8)
