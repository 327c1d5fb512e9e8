"""Designs of a wall compared on the same records."""

import csv
import dataclasses
import html
import re

import matplotlib

matplotlib.use("agg")

import numpy as np
import pytest

import dondolo as dd

LEVELS = [0.2, 0.4, 0.6, 0.8, 1.0, 1.2]


@pytest.fixture(scope="module")
def designs():
    return {
        "as it stands": dd.OneSidedWall(1.5, 0.25),
        "thicker $t$": dd.OneSidedWall(1.5, 0.30),
        "the same": dd.OneSidedWall(1.5, 0.25),
    }


@pytest.fixture(scope="module")
def found(designs, records):
    return dd.compare_designs(designs, records, LEVELS, steel={"as it stands": 0.0, "thicker $t$": 4.0}, progress=False)


def test_each_is_compared_with_the_first(found, designs, records):
    fits = [dd.multiple_stripe(wall, records, LEVELS, progress=False).fit() for wall in designs.values()]
    assert [curve.theta for curve in found.curves] == [curve.theta for curve in fits]
    expected = fits[1].compare(fits[0])
    assert found.comparisons[1] == expected
    assert expected.pairing == "paired"
    assert found.ratio[1] == fits[1].theta / fits[0].theta
    # The same records: the ratio is known better than either median.
    alone = np.hypot(fits[0].se_ln_theta, fits[1].se_ln_theta)
    assert np.diff(np.log(found.ratio_interval[1]))[0] < 2.0 * alone
    for same in (0, 2):
        assert found.ratio[same] == 1.0
        assert found.ratio_interval[same].tolist() == [1.0, 1.0]


def test_steel_and_forces(found, designs):
    trigger = [wall.trigger_acceleration / wall.gravity for wall in designs.values()]
    np.testing.assert_array_equal(found.alpha_0, trigger)
    np.testing.assert_array_equal(found.static_ratio, np.divide(trigger, trigger[0]))
    assert found.gain_per_kg[1] == (found.ratio[1] - 1.0) / 4.0
    assert np.isnan(found.gain_per_kg[[0, 2]]).all()
    assert found.steel.tolist() == [0.0, 4.0, 0.0]
    table = found.to_frame()
    assert table.design.tolist() == list(designs)
    assert table.alpha_0_g.tolist() == trigger


def test_ties(few):
    """Steel of ties: area x length x density; static acceleration with all of them at yield."""
    ties = [dd.Tie(height, area=2e-5, length=length, strength=1.8e8) for height, length in ((2.8, 8.0), (1.5, 6.0))]
    designs = {"bare": dd.OneSidedWall(3.0, 0.25), "tied": dd.OneSidedWall(3.0, 0.25, ties=ties)}
    found = dd.compare_designs(designs, few, LEVELS, progress=False)
    assert found.steel[1] == pytest.approx(7850.0 * 2e-5 * 14.0, rel=1e-12)
    wall = designs["bare"]
    weight = wall.density * wall.height * wall.thickness * wall.gravity
    held = wall.trigger_acceleration / wall.gravity + 1.8e8 * 2e-5 * 4.3 / (0.5 * weight * wall.height)
    assert found.alpha_0[1] == pytest.approx(held, rel=1e-9)
    assert found.ratio[1] > 1.0


def test_checks_beside(designs, few, tmp_path):
    site = dd.Site(ag=0.2, f0=2.5, tc_star=0.35, soil="B")
    found = dd.compare_designs(designs, few, LEVELS, site=site, progress=False)
    for wall, check in zip(designs.values(), found.checks, strict=True):
        assert check.rows == dd.check_ntc(wall, site).rows
    table = found.to_frame()
    assert table.nonlinear_slv.tolist() == [check.capacities["nonlinear", "SLV"] for check in found.checks]
    assert table.linear_slv[1] > table.linear_slv[0]
    # A check that is not applicable has no capacity: here the anchors give way before the bars yield.
    row = found.checks[1]._row("linear", "SLV", "verified")._replace(quantity="applicable", value=0.0)
    brittle = dataclasses.replace(found.checks[1], rows=(*found.checks[1].rows, row))
    table = dataclasses.replace(found, checks=(found.checks[0], brittle, *found.checks[2:])).to_frame()
    assert np.isnan(table.linear_slv[1])
    assert "as it stands, check" in repr(found)
    left, _ = found.plot().figure.axes
    marks = [line for line in left.lines if line.get_marker() == "v"]
    assert [line.get_xdata()[0] for line in marks] == table.nonlinear_slv.tolist()
    found.save(tmp_path / "designs.npz")
    assert dd.load(tmp_path / "designs.npz").checks[1].rows == found.checks[1].rows
    assert dd.compare_designs(designs, few, LEVELS, progress=False).checks == ()


def test_shown_drawn_and_saved(found, tmp_path):
    assert "thicker $t$ theta" in repr(found)
    assert "steel 4 kg/m" in repr(found)
    left, right = found.plot().figure.axes
    assert [line.get_label() for line in left.lines if not line.get_label().startswith("_")] == list(found.names)
    assert right.get_xlabel() == "ratio to 'as it stands'"
    diamonds = next(line for line in right.lines if line.get_marker() == "D")
    np.testing.assert_array_equal(diamonds.get_xdata(), found.static_ratio)
    found.save(tmp_path / "designs.npz")
    again = dd.load(tmp_path / "designs.npz")
    assert again.to_frame().equals(found.to_frame())


def test_levels_of_their_own(designs, records):
    few = {name: designs[name] for name in ("as it stands", "thicker $t$")}
    levels = {"as it stands": LEVELS, "thicker $t$": [0.5, 0.8, 1.1, 1.5]}
    own = dd.compare_designs(few, records, levels, progress=False)
    assert own.stripes[1].levels.tolist() == levels["thicker $t$"]
    assert own.comparisons[1].pairing == "paired"


def test_a_design_without_a_curve(designs, few):
    both = {"as it stands": designs["as it stands"], "hardly": dd.OneSidedWall(1.5, 1.4)}
    with pytest.warns(dd.errors.DondoloWarning, match="no collapse at levels 0.2 to 1.2, no curve is fitted"):
        found = dd.compare_designs(both, few, LEVELS, progress=False)
    assert found.comparisons[1] is None
    assert np.isnan(found.ratio[1])
    assert "hardly no curve (no_collapse)" in repr(found)
    assert "hardly" not in [line.get_label() for line in found.plot().lines]


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"designs": {}}, "designs: must be a mapping of names to walls, at least one"),
        ({"designs": {"a": 3}}, r"designs\['a'\]"),
        ({"steel": {"b": 1.0}}, "steel: 'b' is not a design"),
        ({"steel": {"a": -1.0}}, r"steel\['a'\] = -1: must not be negative"),
        ({"levels": {"b": [1.0]}}, "levels: none for the design 'a'"),
        ({"levels": {"a": [1.0], "b": [1.0]}}, "levels: 'b' is not a design"),
        ({"confidence": 1.5}, "confidence"),
    ],
)
def test_what_cannot_be_compared(few, change, message):
    given = {"designs": {"a": dd.OneSidedWall(1.5, 0.25)}, "records": few, "levels": [0.5, 1.0]} | change
    with pytest.raises(dd.errors.InputError, match=message):
        dd.compare_designs(given.pop("designs"), given.pop("records"), given.pop("levels"), progress=False, **given)


def test_the_executable_compares(root, run, tmp_path):
    """The same ratios and intervals as those of `compare_designs`, from the same table of walls."""
    case = tmp_path / "case.nml"
    text = (root / "data/cases/designs.nml").read_text().replace("'../", f"'{root}/data/")
    case.write_text(text.replace("out/designs'", f"{tmp_path}/out'"))
    summary = run(case)
    assert summary.returncode == 0, summary.stderr
    with (tmp_path / "out_designs.csv").open() as file:
        rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
    walls = dd.Population.from_csv(root / "data/walls/designs.csv").walls
    records = dd.read_catalogue(root / "data/records/synthetic44.csv")
    levels = [0.2, 0.4, 0.6, 0.8, 1.0, 1.2, 1.5, 2.0]
    found = dd.compare_designs({wall.name: wall for wall in walls}, records, levels, progress=False)
    assert [row["design"] for row in rows] == list(found.names)
    expected = {
        "theta": [curve.theta for curve in found.curves],
        "se_ln_theta": [curve.se_ln_theta for curve in found.curves],
        "ratio": found.ratio,
        "ratio_low": found.ratio_interval[:, 0],
        "ratio_high": found.ratio_interval[:, 1],
        "p_value": [one.p_value for one in found.comparisons],
        "steel_kg_m": found.steel,
        "alpha_0_g": found.alpha_0,
        "static_ratio": found.static_ratio,
    }
    for name, values in expected.items():
        assert [float(row[name]) for row in rows] == pytest.approx(list(values), rel=1e-8, abs=1e-12), name
    assert [row["gain_per_kg"] == "" for row in rows] == np.isnan(found.gain_per_kg).tolist()
    assert [float(row["gain_per_kg"]) for row in rows[1:]] == pytest.approx(list(found.gain_per_kg[1:]), rel=1e-8)
    assert found.ratio[3] > found.ratio[2] > 1.0
    assert "designs against 'as it stands', with 95 % intervals from paired records:" in summary.stdout
    assert f"   strain 2 %: median x {found.ratio[2]:.4g} (" in summary.stdout
    stored = dd.read_results(tmp_path / "out").designs
    np.testing.assert_allclose(stored.ratio_interval, found.ratio_interval, rtol=1e-8)
    np.testing.assert_allclose(stored.gain_per_kg, found.gain_per_kg, rtol=1e-8)
    with (tmp_path / "out_checks.csv").open() as file:
        checked = list(csv.DictReader(line for line in file if not line.startswith("#")))
    # The checks of the designs, each beside the first: those that Python makes of the same walls.
    for place, (row, check) in enumerate(zip(rows, stored.checks, strict=True)):
        numbers = check._safety()
        for name, value in zip(("a_0_m_s2", "alpha_0", "zeta_e_linear", "zeta_e"), numbers, strict=False):
            assert row[name] == "" if np.isnan(value) else float(row[name]) == value, (place, name)
        first = stored.checks[0].value("nonlinear", "SLV", "zeta_e")
        assert float(row["zeta_e_change"]) == numbers[3] - first
    assert [row["zeta_e_linear"] == "" for row in rows] == [bool(check.not_applicable) for check in stored.checks]
    assert [row["return_period_capacity"] for row in rows] == [""] * len(rows)
    assert f"zeta_E {float(rows[2]['zeta_e']):.4g} (+{float(rows[2]['zeta_e_change']):.4g}), linear" in summary.stdout
    for kind in ("linear", "nonlinear"):
        stood = [float(row[f"{kind}_slv_g"] or "nan") for row in checked]
        assert stored.to_frame()[f"{kind}_slv"].tolist() == pytest.approx(stood, rel=1e-9, nan_ok=True)
    results = dd.read_results(tmp_path / "out")
    for kind, state in (("linear", "sld"), ("linear", "slv"), ("nonlinear", "slv"), ("nonlinear", "slc")):
        for check, row in zip(results.checks, checked, strict=True):
            key = kind, state.upper()
            if key in check.not_applicable:
                assert row[f"{kind}_{state}_g"] == row[f"{kind}_{state}_ratio"] == ""
                continue
            assert check.capacities[key] == pytest.approx(float(row[f"{kind}_{state}_g"]), rel=1e-9)
            assert check.value(*key, "ratio") == pytest.approx(float(row[f"{kind}_{state}_ratio"]), rel=1e-9)
    left, _ = stored.plot().figure.axes
    assert [line.get_label() for line in left.lines if not line.get_label().startswith("_")][:4] == list(found.names)
    stored.save(tmp_path / "designs.npz")
    assert dd.load(tmp_path / "designs.npz").to_frame().equals(stored.to_frame())
    dd.report(results, tmp_path / "report.html")
    page = html.unescape((tmp_path / "report.html").read_text())
    assert "Designs beside the first, 'as it stands': ratios of the medians with 95 % intervals" in page
    assert f"<dd>{found.ratio[2]:.3g} times</dd>" in page.replace("\N{NO-BREAK SPACE}", " ")
    verified = sum(check.verified["linear", "SLV"] and not check.open_ties for check in results.checks)
    assert f"linear, SLV: {verified} of 4" in page
    # Alternatives have no mean: on the console, among the files, in the report, in functions and figures.
    assert results.typology.are_alternatives
    assert not (tmp_path / "out_typology.csv").exists()
    for word in ("population", "mean fraction", "mean curve"):
        assert word not in summary.stdout
    text = re.sub(r"data:image[^\"]*|<style>.*?</style>|<pre>.*?</pre>", "", page, flags=re.DOTALL)
    for word in ("Typological", "typological", "ractile", "hole population", "eighted", "share of the walls"):
        assert word not in text, word
    for wall in walls:
        assert f"{wall.name}: at rest (dashed)" in text
        assert f"Calculation sheet of {wall.name}." in text
    with pytest.raises(dd.errors.InputError, match="alternatives with no curve in common"):
        results.typology["all"]
    with pytest.raises(dd.errors.InputError, match="alternatives"):
        results.typology.plot()
    functions, _ = results.typology.nrml_functions()
    assert [one["collapse"].theta for one in functions.values()] == [curve.theta for curve in found.curves]
    dd.write_workbook(tmp_path / "out", tmp_path / "out.xlsx")
    openpyxl = pytest.importorskip("openpyxl")
    assert "typology" not in openpyxl.load_workbook(tmp_path / "out.xlsx").sheetnames
    # Written and read again they are still alternatives.
    results.typology.write_results(tmp_path / "again")
    again = dd.read_results(tmp_path / "again")
    assert again.typology.are_alternatives
    assert [curve.theta for curve in again.typology.curves] == [curve.theta for curve in results.typology.curves]
    results.typology.save(tmp_path / "alternatives.npz")
    assert dd.load(tmp_path / "alternatives.npz").are_alternatives
    case.write_text(case.read_text().replace("walls/designs.csv", "walls/facades.csv"))
    refused = run("--check", case)
    assert refused.returncode != 0
    assert "designs = .true. needs two designs at least, each a wall of one row" in refused.stderr


def test_a_case_of_designs_in_python(root, run, tmp_path):
    """`run_case` has the comparison and the checks of the executable, and nothing over the designs."""
    case = tmp_path / "case.nml"
    text = (root / "data/cases/designs.nml").read_text().replace("'../", f"'{root}/data/")
    case.write_text(text.replace("out/designs'", f"{tmp_path}/out'"))
    assert run(case).returncode == 0
    mine, theirs = dd.run_case(case, progress=False), dd.read_results(tmp_path / "out")
    assert mine.case.designs
    np.testing.assert_allclose(mine.designs.ratio_interval, theirs.designs.ratio_interval, rtol=1e-8)
    assert [check.rows for check in mine.checks] == [check.rows for check in theirs.checks]
    assert [check.rows for check in mine.designs.checks] == [check.rows for check in theirs.checks]
    assert mine.typology.are_alternatives
    assert "population" not in repr(mine.typology)
    dd.report(mine, tmp_path / "report.html")
    assert "Designs beside the first" in html.unescape((tmp_path / "report.html").read_text())


def test_damage_states_and_hazard_of_designs(root, run, tmp_path):
    """Each design in each state; the annual frequency of each."""
    (tmp_path / "walls.csv").write_text(
        "name,mechanism,height,thickness\nas found,one_sided,1.5,0.25\nthicker,one_sided,1.5,0.32\n"
    )
    (tmp_path / "case.nml").write_text(
        "&job task = 'typology', output = 'out' /\n&population file = 'walls.csv', designs = .true. /\n"
        f"&records catalogue = '{root / 'data/records/synthetic44.csv'}' /\n"
        "&stripes levels = 0.2, 0.4, 0.6, 0.8, 1.0, 1.4, edp_thresholds = 0.4 /\n"
    )
    done = run("case.nml")
    assert done.returncode == 0, done.stderr
    results = dd.read_results(tmp_path / "out")
    assert results.typology.at(0.4).are_alternatives
    assert results.typology.at(0.4).curves[0].theta < results.typology.curves[0].theta
    hazard = dd.HazardCurve([0.02, 0.05, 0.1, 0.2, 0.4, 0.8, 1.6], [0.05, 0.02, 0.008, 0.003, 0.0009, 0.0002, 3e-5])
    dd.report(results, tmp_path / "report.html", hazard=hazard)
    page = html.unescape((tmp_path / "report.html").read_text())
    assert "Damage state EDP ≥ 0.4: parameters of each design" in page
    assert "Deaggregation of the frequency of collapse, as found" in page
    assert "thicker, collapse" in page
    functions, _ = results.typology.nrml_functions()
    assert {name: list(states) for name, states in functions.items()} == {
        "as found": ["edp_0p4", "collapse"],
        "thicker": ["edp_0p4", "collapse"],
    }
