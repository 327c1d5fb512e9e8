"""Checks by NTC 2018 of walls that are tables: those of dondolo's own walls, given as tables, are the same."""

import csv
import dataclasses
import math
import re
import subprocess

import matplotlib
import numpy as np
import pytest
from test_tabulated import as_table

import dondolo as dd

matplotlib.use("agg")

SITE = dd.Site((0.104, 0.261, 0.334), (2.332, 2.364, 2.4), (0.281, 0.347, 0.364), soil="B")
FLOOR = dd.Building(period=0.3, participation=1.2)
LOADS = [dd.Load(8e3, depth=0.4, height=3.0, inertia="both"), dd.Load(5e3, depth=0.35, height=6.0, inertia="vertical")]
WALLS = {
    "bare": dd.OneSidedWall(3.0, 0.25, name="bare"),
    "floor": dd.OneSidedWall(3.0, 0.25, building=FLOOR, name="floor"),
    "facade": dd.OneSidedWall(
        6.0, 0.5, density=1900, hinge_depth=0.02, loads=LOADS, thrusts=[dd.Thrust(900.0, depth=0.4, height=5.5)],
        inertial_masses=[dd.InertialMass(300.0, depth=0.2, height=4.0)], name="facade",
    ),
    "strip": dd.TwoBlockWall(3.0, 0.25, hinge=0.9, name="strip"),
    "loaded strip": dd.TwoBlockWall(
        3.2, 0.28, overburden=15e3, overburden_inertia=1.0, eccentricity=-0.03, name="loaded strip"
    ),
    "strip with a floor": dd.TwoBlockWall(
        6.4, 0.45, overburden=20e3, overburden_inertia=0.0, eccentricity=-0.1, name="strip with a floor",
        loads=[dd.Load(12e3, depth=0.375, height=3.2, inertia="both")],
    ),
}  # fmt: skip


def bodies_of(wall):
    """Weights, and how far they move outwards for a unit of rotation; at what depth and height behind the hinge."""
    items = [one for one in dd.check_ntc(wall, SITE).items if not math.isnan(one.force_lever2) and one.lever]
    return np.array([one.force for one in items]), np.array([one.lever for one in items]), items


def of_block(wall):
    """What a check of a wall that turns about its base knows besides its terms."""
    weight, height, items = bodies_of(wall)
    depth = np.array([one.depth for one in items]) - wall.base_hinge_depth
    first, second = weight @ height, weight @ height**2
    return {
        "weight": weight,
        "displacement": height,
        "travel": lambda q: second / first * np.sin(q),
        "weighted_lever": lambda q: first * np.cos(q) + weight @ depth * np.sin(q),
    }


def of_strip(wall):
    """The same of a strip at the hinge that it has, from positions of its blocks, by hand."""
    r, tall, w = wall.hinge, wall.height, wall.thickness / 2
    low, up = r * tall, (1 - r) * tall
    weight, lever, _ = bodies_of(wall)
    share = np.hypot(2 * w, up)

    def upper(q):
        """Rotation of the upper block, whose top hinge keeps its place sideways, and how fast it turns."""
        moved = w - 2 * w * np.cos(q) + low * np.sin(q)
        speed = 2 * w * np.sin(q) + low * np.cos(q)
        turn = np.arccos((w - moved) / share) - np.arccos(2 * w / share)
        return turn, speed / (2 * w * np.sin(turn) + up * np.cos(turn))

    def rates(q):
        """How fast each weight moves outwards: two blocks, and a load in the lower one."""
        turn, ratio = upper(q)
        found = [
            low / 2 * np.cos(q) + w * np.sin(q),
            (up / 2 * np.cos(turn) + w * np.sin(turn)) * ratio,
        ]
        for load in wall.loads:
            assert load.height < low
            found.append(load.height * np.cos(q) + (load.depth - 0 * q) * np.sin(q))
        return found

    def weighted(q):
        return sum(one * rate for one, rate in zip(weight, rates(q), strict=True))

    first, second = weight @ lever, weight @ lever**2
    radius, alpha = np.hypot(w, low / 2), np.arctan2(w, low / 2)
    d = lambda q: radius * (np.sin(alpha) - np.sin(alpha - q)) * second / (low / 2 * first)  # noqa: E731
    return {"weight": weight, "displacement": lever, "travel": d, "weighted_lever": weighted}


def table_of(name, **more):
    wall = WALLS[name]
    own = of_strip(wall) if isinstance(wall, dd.TwoBlockWall) else of_block(wall)
    return as_table(wall, building=wall.building, **own | more)


@pytest.mark.parametrize("name", WALLS)
def test_a_wall_and_its_table_have_the_same_check(name):
    wall, table = WALLS[name], table_of(name)
    expected, found = (dd.check_ntc(one, SITE, knowledge_factor=1.2) for one in (wall, table))
    compared = 0
    for row in expected.rows:
        if row.method == "assigned" or row.quantity in (
            "hinge", "weakest_hinge", "weakest_alpha_0", "lowest_hinge", "highest_hinge", "upper_moment", "floor_top",
            "floor_base", "friction_needed", "least_zeta", "least_zeta_hinge", "level",
        ):  # fmt: skip
            continue
        same = [
            one.value
            for one in found.rows
            if (one.method, one.limit_state, one.quantity, one.item)
            == (row.method, row.limit_state, row.quantity, row.item)
        ]
        assert same == [pytest.approx(row.value, rel=1e-10)], row
        compared += 1
    assert compared > 60
    assert {note.code for note in found.notes} >= {"knowledge_raised", "sliding_unknown"}
    # Numbers of the sheet follow from the items
    first = sum(one.force_lever for one in found.items if not math.isnan(one.force_lever))
    moment = next(one.stabilising for one in found.items if one.item == "moment")
    assert found.value("mechanism", "", "alpha_0") == pytest.approx(moment / first, rel=1e-12)


def test_gravity_times_the_lever_of_a_wall_that_carries_nothing():
    with_lever, without = (dd.check_ntc(table_of("bare", **more), SITE) for more in ({}, {"weighted_lever": None}))
    for row in with_lever.rows:
        assert without.value(row.method, row.limit_state, row.quantity) == pytest.approx(row.value, rel=1e-12)


@pytest.mark.parametrize(
    ("name", "more", "words"),
    [
        ("bare", {"weight": None, "displacement": None, "travel": None, "weighted_lever": None},
         "weight: must be given for the kinematic check of mechanism = 'tabulated': the lists weight"),
        ("facade", {"weighted_lever": None}, "weighted_lever: must be given: at rest the sum of weight times"),
        ("facade", {"weighted_lever": 1e5}, "weighted_lever: is 100000 N m/m at rest, must be"),
        ("bare", {"travel": None}, "travel: must be given for checks, which need weight, displacement and travel"),
        ("bare", {"travel": lambda q: 3.0 * np.sin(q)},
         "travel: begins with 3 m for a unit of rotation, must begin with 1.5"),
        ("bare", {"travel": lambda q: 0.01 + 1.5 * np.sin(q)}, "travel: begins at 0.01 m, must begin at 0"),
        ("bare", {"displacement": [1.5, 1.5]}, "displacement: has 2 values, must have 1 as weight"),
        ("bare", {"weight": [-1.0]}, "weight = -1: must be positive"),
    ],
)  # fmt: skip
def test_refusals(name, more, words):
    with pytest.raises(dd.errors.InputError) as caught:
        dd.check_ntc(table_of(name, **more), SITE)
    assert words in str(caught.value)


@pytest.mark.parametrize("by_file", [True, False])
def test_by_the_executable(by_file, executable, root, tmp_path):
    """Lists in the case, or columns of its table in other units; and a row of a table of walls with its own weight."""
    wall = table_of("facade")
    lists = {name: np.asarray(getattr(wall, name)).tolist() for name in ("weight", "displacement")}
    names = ("rotation", "inertia", "lever", "moment", "travel", "weighted_lever")
    columns = {name: np.asarray(getattr(wall, name)).tolist() for name in names}
    if by_file:
        units = {"rotation": "mrad", "inertia": "kg m2/m", "lever": "kg m/m", "moment": "kN m/m", "travel": "mm"}
        units["weighted_lever"] = "kN m/m"
        scales = {"mrad": 1e3, "mm": 1e3, "kN m/m": 1e-3}
        rows = zip(*(np.multiply(columns[name], scales.get(units[name], 1.0)).tolist() for name in names), strict=True)
        head = ",".join(f"{name} [{units[name]}]" for name in names)
        (tmp_path / "own.csv").write_text("\n".join([head, *(",".join(map(repr, row)) for row in rows)]) + "\n")
        terms = {"table": "'own.csv'"}
    else:
        terms = {name: ", ".join(map(repr, values)) for name, values in columns.items()}
    terms |= {name: ", ".join(map(repr, values)) for name, values in lists.items()}
    given = ",\n   ".join(f"{name} = {text}" for name, text in terms.items())
    group = (
        f"&records catalogue = '{root}/data/records/synthetic44.csv' /\n&stripes levels = 0.2, 0.8 /\n"
        "&check ag = 0.104, 0.261, 0.334, f0 = 2.332, 2.364, 2.4, tc_star = 0.281, 0.347, 0.364, soil = 'B' /\n"
    )
    (tmp_path / "case.nml").write_text(
        f"&job task = 'stripes', output = 'out' /\n&wall mechanism = 'tabulated', height = 6, sides = 1, "
        f"restitution_value = 0.4,\n   {given} /\n{group}"
    )
    subprocess.run([executable, "--quiet", "case.nml"], cwd=tmp_path, check=True)
    expected = dd.check_ntc(WALLS["facade"], SITE)
    lines = [line for line in (tmp_path / "out_check.csv").read_text().splitlines() if not line.startswith("#")]
    found = {(row["method"], row["limit_state"], row["quantity"]): float(row["value"]) for row in csv.DictReader(lines)}
    for key in (("mechanism", "", "alpha_0"), ("mechanism", "", "d_0"), ("nonlinear", "SLV", "zeta_e")):
        assert found[key] == pytest.approx(expected.value(*key), rel=1e-9)
    stored = dd.read_results(tmp_path / "out").check
    assert stored.wall.weight == pytest.approx(lists["weight"])
    dd.report(dd.read_results(tmp_path / "out"), tmp_path / "report.html", lang="it")
    if not by_file:
        return
    names = [f"{name}{i}" for name, values in lists.items() for i in range(1, len(values) + 1)]
    numbers = [repr(value) for values in lists.values() for value in values]
    (tmp_path / "walls.csv").write_text(
        f"name,mechanism,height,sides,restitution_value,table,weight,{','.join(names)}\n"
        f"a,tabulated,6,1,0.4,own.csv,3,{','.join(numbers)}\n"
        f"b,one_sided,3,,,,2{',' * len(names)}\n".replace("b,one_sided,3,", "b,one_sided,3,", 1)
    )
    text = (tmp_path / "walls.csv").read_text().replace("mechanism,height,sides", "mechanism,height,thickness,sides")
    text = text.replace("a,tabulated,6,", "a,tabulated,6,,").replace("b,one_sided,3,", "b,one_sided,3,0.25,")
    (tmp_path / "walls.csv").write_text(text)
    (tmp_path / "people.nml").write_text(
        f"&job task = 'typology', output = 'people' /\n&population file = 'walls.csv' /\n{group}"
    )
    subprocess.run([executable, "--quiet", "people.nml"], cwd=tmp_path, check=True)
    lines = [line for line in (tmp_path / "people_checks.csv").read_text().splitlines() if not line.startswith("#")]
    rows = list(csv.DictReader(lines))
    assert [row["note"] for row in rows] == ["", ""]
    assert float(rows[0]["zeta_e"]) == pytest.approx(expected.zeta_e, rel=1e-9)
    people = dd.read_results(tmp_path / "people")
    assert people.population.weights.tolist() == [3.0, 2.0]
    assert people.population[0].weight == pytest.approx(lists["weight"])


def documented(wall, tmp_path, executable, root):
    """Results of a run of a wall with its check."""
    study = dd.Study(dd.read_catalogue(root / "data/records/synthetic44.csv"), [0.2, 0.8])
    check = dd.check_ntc(wall, SITE)
    catalogue = root / "data/records/synthetic44.csv"
    dd.write_case(tmp_path / "case.nml", wall, study, catalogue=catalogue, output="out", check=check)
    subprocess.run([executable, "--quiet", "case.nml"], cwd=tmp_path, check=True, capture_output=True)
    return dd.read_results(tmp_path / "out")


def cells_of(page, caption):
    """The rows of the table of a page with a caption, as numbers where they are such."""
    (found,) = (table for table in re.findall(r"<table.*?</table>", page, re.DOTALL) if caption in table)
    rows = [re.findall(r"<t[hd].*?</t[hd]>", row, re.DOTALL) for row in re.findall(r"<tr.*?</tr>", found, re.DOTALL)]
    plain = [
        [re.sub(r"<.*?>|\s|\u202f", "", cell).replace("\u2212", "-").replace("\u00d710", "e") for cell in row]
        for row in rows
    ]
    return {row[0]: row[1:] for row in plain}


@pytest.mark.parametrize("name", ["facade", "loaded strip", "strip with a floor"])
def test_the_calculation_report_gives_the_numbers_of_the_check(name, executable, root, tmp_path):
    """alpha(d_C) = M/S and a(d_C) from the columns that the document prints, and the multiplier from its items."""
    results = documented(table_of(name), tmp_path, executable, root)
    check = results.check
    dd.calculation_report(results, tmp_path / "en.html", lang="en")
    page = (tmp_path / "en.html").read_text(encoding="utf-8")
    steps = cells_of(page, "Terms of the table")
    numbers = {head: [float(value) for value in row] for head, row in steps.items() if head != "quantity"}
    d, theta, moment, lever, alpha, a = numbers.values()
    expected = [check.value("nonlinear", state, "acceleration") for state in ("SLV", "SLC")]
    assert a == pytest.approx([0.0, *expected], rel=1e-5)
    assert d[0] == pytest.approx(check.value("mechanism", "SLV", "d_0"), rel=1e-5)
    assert alpha[1:] == pytest.approx(np.divide(moment, lever)[1:], rel=2e-5)
    # A reader between the rows of the printed table, by a spline of his own
    rows = [[float(value) for value in (head, *row)] for head, row in cells_of(page, "The table of the wall").items()
            if "[" not in head]  # fmt: skip
    rotation, moments, levers, travels = np.array(rows).T
    for place in (1, 2):
        near = np.argsort(np.abs(rotation - theta[place]))[:5]
        for column, value in ((moments, moment), (levers, lever), (travels, d)):
            spline = np.polynomial.Polynomial.fit(rotation[near], column[near], 4)
            assert float(spline(theta[place])) == pytest.approx(value[place], rel=1e-4)
    items = cells_of(page, "Calculation of the multiplier")
    total = [float(value) for value in items["sum"] if re.fullmatch(r"[\d.]+", value)]
    assert total[0] / total[1] == pytest.approx(check.value("mechanism", "", "alpha_0"), rel=1e-4)


def test_calculation_reports_in_both_languages_and_formats(executable, root, tmp_path):
    results = documented(table_of("facade"), tmp_path, executable, root)
    pytest.importorskip("docx")
    for lang, words in (("it", "cinematismo tabellato, altezza"), ("en", "tabulated, height")):
        left = dd.calculation_report(results, tmp_path / f"{lang}.html", lang=lang)
        assert dd.calculation_report(results, tmp_path / f"{lang}.docx", lang=lang) == left
        text = re.sub(r"<[^>]+>", "", (tmp_path / f"{lang}.html").read_text(encoding="utf-8"))
        assert words in " ".join(text.split())
        counts = {"it": "osservazioni sulle verifiche: {} (", "en": "remarks on the checks: {} ("}[lang]
        assert counts.format(len(results.check.notes)) in text
        assert len(results.check.notes) != len(results.run.warnings)
        assert not re.search(r"\bnan\b", text, re.IGNORECASE)


def test_rows_that_are_typed_have_steps_or_a_sentence(executable, root, tmp_path):
    """Eleven rows with five digits: a polynomial through them is about that of the check, and never a crash."""
    wall = WALLS["facade"]
    q = np.linspace(0.0, wall.capacity_angle, 11)
    table = table_of("facade")
    more = {"rotation": q}
    for name in ("inertia", "lever", "moment", "travel", "weighted_lever", "vertical_lever"):
        values = np.polynomial.Chebyshev.fit(table.rotation, np.asarray(getattr(table, name)), 12)(q)
        more[name] = np.array([float(f"{value:.6g}") for value in values])
    typed = dd.TabulatedWall(
        wall.height, sides=1, restitution_value=0.4, weight=table.weight, displacement=table.displacement, **more
    )
    results = documented(typed, tmp_path, executable, root)
    dd.calculation_report(results, tmp_path / "en.html", lang="en")
    text = " ".join(re.sub(r"<[^>]+>", "", (tmp_path / "en.html").read_text(encoding="utf-8")).split())
    assert ("Terms of the table, multiplier" in text) != ("differ from those of the calculation" in text)


def test_saved_and_changed(tmp_path):
    check = dd.check_ntc(table_of("facade"), SITE)
    check.save(tmp_path / "check.npz")
    again = dd.load(tmp_path / "check.npz")
    assert again.rows == check.rows
    heavier = dataclasses.replace(check.wall, name="other")
    assert dd.check_ntc(heavier, SITE).value("mechanism", "", "alpha_0") == check.value("mechanism", "", "alpha_0")
