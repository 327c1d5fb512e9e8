"""Facades: the walls above their hinges, and their union of the same histories."""

import csv
import dataclasses
import html
import itertools
import re
import subprocess

import numpy as np
import pytest

import dondolo as dd

BUILDING = dd.Building(0.3, storeys=3, level=0.0, building_height=10.5)
STOREYS = {"sections": [dd.Section(4.0, 0.60), dd.Section(3.5, 0.45), dd.Section(3.0, 0.30)], "name": "front"}
FLOORS = [
    dd.Load(12e3, depth=0.5, height=4.0, inertia="both"),
    dd.Load(12e3, depth=0.35, height=7.5, inertia="both"),
    dd.Load(6e3, depth=0.2, height=10.5, inertia="both"),
]
CASE = """&job task = 'typology', output = 'out', histories = .true. /
&wall name = 'front', mechanism = 'one_sided', section_height = 4.0, 3.5, 3.0, section_thickness = 0.6, 0.45, 0.3,
   load = 12e3, 12e3, 6e3, load_height = 4.0, 7.5, 10.5, load_depth = 0.5, 0.35, 0.2, load_inertia = 'both',
   hinge_at = 'storeys' /
&building period = 0.3, storeys = 3, level = 0.0, building_height = 10.5 /
&records catalogue = '{catalogue}', polarity = 'both' /
&stripes levels = 0.15, 0.2, 0.25, 0.3, 0.4, 0.5, edp_thresholds = 0.3 /
&check ag = 0.2, f0 = 2.5, tc_star = 0.35, soil = 'B' /
"""
TABLE = """name,mechanism,height,thickness,hinge1_level,hinge2_level,p_occ,weight
a,one_sided,6,0.5,0,3,1,2
b,one_sided,3,0.25,,,0.8,1
b,two_block,3,0.25,,,0.5,1
c,one_sided,3,0.3,,,1,1
"""


def whole(**more):
    return dd.OneSidedWall(**STOREYS, loads=FLOORS, building=BUILDING, **more)


def rows(path):
    """Rows of a table of results."""
    with path.open() as file:
        return list(csv.DictReader(line for line in file if not line.startswith("#")))


def test_levels():
    """Section 7 of the mechanics: trigger with the masses, and capacity, at three hinges."""
    found = dd.Population.of_facade(whole())
    assert [wall.name for wall in found] == ["front at 0 m", "front at 4 m", "front at 7.5 m"]
    assert found.wholes == ("front",) * 3
    assert list(found.first_rows) == [0]
    triggers = [wall.trigger_acceleration / wall.gravity for wall in found]
    assert triggers == pytest.approx([0.0556394616924816, 0.0671416144998685, 0.0856590731458974], rel=1e-12)
    capacities = [wall.capacity_angle for wall in found]
    assert capacities == pytest.approx([0.0555821528209993, 0.0670409951295991, 0.0854504835372323], rel=1e-12)
    assert [wall.building.level for wall in found] == [0.0, 4.0, 7.5]
    assert [load.force for load in found[2].loads] == [6e3]
    assert found[0].terms(0.01) == whole().terms(0.01)


def test_one_hinge():
    wall = whole(hinge_level=7.5)
    assert (wall.name, wall.height, wall.thickness, wall.building.level) == ("front", 3.0, 0.3, 7.5)
    assert wall.terms(0.01) == dd.Population.of_facade(whole(), hinge_level=[7.5])[0].terms(0.01)


def test_leaves():
    wall = dd.OneSidedWall(3.0, 0.25, leaves=2)
    assert wall.slenderness_angle == pytest.approx(0.0416425790985884, rel=1e-12)
    assert wall.thickness == 0.25
    ax = wall.plot()
    assert len(ax.patches) == 4
    assert "leaves=2" in repr(wall)


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (
            lambda: dd.Population.of_facade(dd.FreeStandingWall(3.0, 0.5)),
            "must be a OneSidedWall or a Corner, not FreeStandingWall",
        ),
        (lambda: dd.Population.of_facade(dd.OneSidedWall(3.0, 0.5)), "only with sections"),
        (lambda: dd.Population.of_facade(whole(), hinge_level="floors"), "must be heights or 'storeys'"),
        (lambda: dd.Population.of_facade(whole(), hinge_level=[]), "must be given"),
        (lambda: dd.Population.of_facade(whole(), hinge_level=[4.0, 4.0]), "must increase"),
        (
            lambda: dd.Population.of_facade(whole(), hinge_level=[12.0]),
            "must be less than the height of the wall, 10.5 m",
        ),
        (lambda: whole(hinge_level=[0.0, 4.0]), "hinge_level: has 2 values"),
        (lambda: whole(leaves=2), "loads: not with leaves = 2"),
        (
            lambda: dd.Population(tuple(dd.Population.of_facade(whole())), facades=("f", "", "f")),
            "facade = 'f': another facade",
        ),
        (
            lambda: dd.Population.of_facade(whole()) + dd.Population.of_facade(whole(), hinge_level=[1.0]),
            "both populations have a facade of this name",
        ),
        (
            lambda: dd.Population(tuple(dd.Population.of_facade(whole())), [1, 2, 1], facades=("f",) * 3),
            "of one facade must have",
        ),
    ],
)
def test_wrong(make, message):
    with pytest.raises(dd.errors.InputError, match=message.replace("(", r"\(")):
        make()


@pytest.fixture(scope="module")
def ran(executable, root, tmp_path_factory):
    """Folder of the executable's results of the case, and what it printed."""
    folder = tmp_path_factory.mktemp("facade")
    (folder / "case.nml").write_text(CASE.format(catalogue=root / "data/records/synthetic44.csv"))
    done = subprocess.run([executable, "case.nml"], cwd=folder, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return folder, done.stdout


def test_union_of_histories(ran):
    """A history of the table counts once if any hinge collapses in it."""
    folder, printed = ran
    histories = rows(folder / "out_histories.csv")
    for threshold in (0.3, 1.0):
        reached = {}
        for row in histories:
            key = float(row["im_level"]), row["record"], row["polarity"]
            reached[key] = max(reached.get(key, 0.0), float(row["edp"]))
        unions = [row for row in rows(folder / "out_unions.csv") if float(row["edp_threshold"]) == threshold]
        assert len(unions) == 6
        for row in unions:
            level = float(row["im_level"])
            own = [edp >= threshold for key, edp in reached.items() if key[0] == level]
            assert (int(row["histories"]), float(row["collapses"])) == (88, sum(own))
            parts = [
                np.mean([float(one["edp"]) >= threshold for one in histories if (one["wall"], one["im_level"]) == pair])
                for pair in itertools.product(sorted({one["wall"] for one in histories}), [row["im_level"]])
            ]
            assert float(row["independent_fraction"]) == pytest.approx(1.0 - np.prod(1.0 - np.array(parts)), rel=1e-12)
            assert float(row["fraction"]) <= float(row["independent_fraction"]) + 1e-12
    assert "'front', 3 mechanisms in series" in printed
    assert "'front': probability of collapse at a_g S = 0.24 g" in printed


def test_executable_and_python(ran, root):
    folder, _ = ran
    result = dd.run_case(folder / "case.nml", progress=False).typology
    stored = dd.read_results(folder / "out")
    assert stored.population.facades == ("front",) * 3
    assert [wall.building.level for wall in stored.population] == [0.0, 4.0, 7.5]
    assert stored.typology.combined["front"].theta == pytest.approx(result.combined["front"].theta, rel=1e-12)
    for threshold in (0.3, 1.0):
        curve, again = (one.at(threshold).unions["front"] for one in (result, stored.typology))
        assert again.theta == pytest.approx(curve.theta, rel=1e-9)
        assert again.covariance == pytest.approx(curve.covariance, rel=1e-6)
        assert (again.errors, again.clusters) == ("clustered", curve.clusters)
        assert again.degrees_of_freedom == curve.degrees_of_freedom
        assert again.collapses == pytest.approx(curve.collapses, rel=1e-12)
        row = next(row for row in rows(folder / "out_unions.csv") if float(row["edp_threshold"]) == threshold)
        product = result.at(threshold).combined["front"].theta
        found = [curve.theta, curve.beta, curve.se_ln_theta, curve.se_beta, product]
        names = ["theta", "beta", "se_ln_theta", "se_beta", "independent_theta"]
        assert found == pytest.approx([float(row[name]) for name in names], rel=1e-9)


def test_population_of_facades(run, root, tmp_path, records):
    """Hinges as columns, mechanisms that may not occur, and walls of one mechanism, in the executable and in Python."""
    (tmp_path / "walls.csv").write_text(TABLE)
    people = dd.Population.from_csv(tmp_path / "walls.csv")
    assert people.wholes == ("a", "a", "b", "b", "c")
    people.to_csv(tmp_path / "again.csv")
    again = dd.Population.from_csv(tmp_path / "again.csv")
    assert again.facades == ("a", "a", "", "", "")
    assert [wall.height for wall in again] == [6.0, 3.0, 3.0, 3.0, 3.0]
    levels = [0.2, 0.4, 0.6, 0.8, 1.2, 1.6]
    result = dd.typology(people, records, levels, polarity="both", progress=False)
    assert list(result.unions) == ["a", "b"]
    assert list(result.combined) == ["a", "b", "c"]
    flags = result.flags
    union, own = result.unions["b"], [flags.of([i])[0, -1] for i in (2, 3)]
    expected = 1.0 - (1.0 - 0.8 * own[0]) * (1.0 - 0.5 * np.tile(own[1], 2))
    assert union.upper_asymptote == pytest.approx(0.9)
    assert union.collapses * union.upper_asymptote == pytest.approx(expected.sum(axis=1), rel=1e-12)
    (tmp_path / "case.nml").write_text(
        "&job task = 'typology', output = 'out' /\n&population file = 'walls.csv' /\n"
        f"&records catalogue = '{root / 'data/records/synthetic44.csv'}', polarity = 'both' /\n"
        f"&stripes levels = {', '.join(map(str, levels))} /\n"
    )
    done = run("case.nml")
    assert done.returncode == 0, done.stderr
    table = rows(tmp_path / "out_unions.csv")
    assert list(dict.fromkeys(row["wall"] for row in table)) == ["a", "b", ""]
    for name in ("a", "b"):
        first = next(row for row in table if row["wall"] == name)
        assert float(first["theta"]) == pytest.approx(result.unions[name].theta, rel=1e-9)
    mean = result.group_unions[""]
    assert list(result.group_unions) == [""]
    means = [float(row["fraction"]) for row in table if not row["wall"]]
    assert mean.upper_asymptote * mean.collapses / mean.histories == pytest.approx(means, rel=1e-12)
    first = next(row for row in table if not row["wall"])
    assert (mean.theta, mean.beta) == pytest.approx((float(first["theta"]), float(first["beta"])), rel=1e-9)
    # Over records and walls, as the mean of independent mechanisms, whose walls scatter alike
    assert mean.errors == "clustered"
    assert mean.se_ln_theta == pytest.approx(result["all"].fit.se_ln_theta, rel=0.35)
    stored = dd.read_results(tmp_path / "out").typology
    assert stored.group_unions[""].theta == pytest.approx(mean.theta, rel=1e-9)
    assert stored.group_unions[""].covariance == pytest.approx(mean.covariance, rel=1e-9)
    fractions = {
        name: curve.upper_asymptote * curve.collapses / curve.histories for name, curve in result.unions.items()
    }
    alone = result.combined["c"].collapses / result.combined["c"].histories
    assert means == pytest.approx((2 * fractions["a"] + fractions["b"] + alone) / 4.0, rel=1e-9)
    assert "a: theta = " in done.stdout
    assert re.search(r"^population, same histories \(can occur: [\d.]+ %\): theta = ", done.stdout, re.MULTILINE)


def test_unions_of_files(ran, tmp_path):
    """Read back, saved and loaded; files that Python writes have none."""
    stored = dd.read_results(ran[0] / "out").typology
    assert list(stored.unions) == ["front"]
    stored.plot_union()
    stored.save(tmp_path / "stored.npz")
    assert dd.load(tmp_path / "stored.npz").at(0.3).unions["front"].theta == stored.at(0.3).unions["front"].theta
    # Files that Python writes have them too: no route shows the product in their place.
    stored.write_results(tmp_path / "written")
    again = dd.read_results(tmp_path / "written").typology
    for threshold in (0.3, 1.0):
        union, other = (one.at(threshold).unions["front"] for one in (stored, again))
        assert (other.theta, other.beta) == pytest.approx((union.theta, union.beta), rel=1e-12)
        assert other.covariance == pytest.approx(union.covariance, rel=1e-9)
    with pytest.raises(dd.errors.InputError, match="read back from files without"):
        dataclasses.replace(stored, union_curves=None).unions  # noqa: B018


def test_saved(tmp_path, few):
    result = dd.typology(dd.Population.of_facade(whole()), few, [0.2, 0.3, 0.5], progress=False)
    result.save(tmp_path / "facade.npz")
    again = dd.load(tmp_path / "facade.npz")
    assert again.population.facades == ("front",) * 3
    assert again.unions["front"].theta == result.unions["front"].theta


def test_plot(ran, few):
    result = dd.run_case(ran[0] / "case.nml", progress=False).typology
    ax = result.plot_union()
    words = [text.get_text() for text in ax.get_legend().get_texts()]
    assert words[0] == "front at 0 m, one-sided"
    assert any(word.startswith("same histories: θ = ") for word in words)
    with pytest.raises(dd.errors.InputError, match="name = 'back'"):
        result.plot_union(name="back")
    with pytest.raises(dd.errors.InputError, match="unions: there are none"):
        dd.typology([dd.OneSidedWall(1.5, 0.25)], few, [0.4, 0.8], progress=False).plot_union()


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("hinge_at = 'storeys'", "hinge_level = 0.0, 11.0", "case.nml: &wall: hinge_level = 11: must be less than"),
        ("hinge_at = 'storeys'", "density = 1800", "&population: must be given for task = 'typology'"),
        ("task = 'typology'", "task = 'stripes'", "case.nml: &wall: hinge_level: has 3 values"),
        ("hinge_at = 'storeys'", "hinge_at = 'floors'", "hinge_at = 'floors': must be one of 'storeys'"),
        ("section_thickness = 0.6, 0.45, 0.3", "section_thickness = 0.6, 0.45", "section_thickness: has 2 values"),
    ],
)
def test_wrong_case(run, root, tmp_path, old, new, message):
    text = CASE.format(catalogue=root / "data/records/synthetic44.csv").replace(", histories = .true.", "")
    assert old in text
    (tmp_path / "case.nml").write_text(text.replace(old, new))
    done = run("case.nml")
    assert done.returncode != 0
    assert message in done.stderr
    assert len(done.stderr.splitlines()) == 1


def words_of(path):
    """The words of a report, without its figures."""
    page = re.sub(r"data:image[^\"]*|<style>.*?</style>|<pre>.*?</pre>", "", path.read_text(), flags=re.DOTALL)
    return html.unescape(re.sub(r"<[^>]+>", " ", page)).replace("\N{NO-BREAK SPACE}", " ")


@pytest.mark.parametrize("route", ["files", "case", "typology"])
def test_report(ran, tmp_path, route):
    """Whatever a report is made of: the union is its number, the product a footnote, and nothing is of a population."""
    case = dd.run_case(ran[0] / "case.nml", progress=False)
    source = {"files": dd.read_results(ran[0] / "out"), "case": case, "typology": case.typology}[route]
    dd.report(source, tmp_path / "report.html")
    words = words_of(tmp_path / "report.html")
    union, product = case.typology.unions["front"], case.typology.combined["front"]
    assert f"{union.theta:.3g}" != f"{product.theta:.3g}"
    # Behind the title in the list of contents, and that of the chapter
    cards = words.split("Summary")[2].partition("Fragility curves")[0]
    assert f"{union.theta:.3g} g" in cards
    assert f"{product.theta:.3g} g" not in cards
    assert words.count(f"{product.theta:.3g} g") == 1
    assert "Footnote. Independent mechanisms would give" in words
    for word in ("opulation", "share of the walls", "ractile", "ypological", "weighted"):
        assert word not in words, word
    assert "front at 4 m: at rest (dashed)" in words


def test_console(ran):
    """The stripes are those of the union, and nothing is of a population."""
    _, printed = ran
    union = dd.read_results(ran[0] / "out").typology.unions["front"]
    assert f"collapse: theta = {union.theta:.4g} g" in printed
    for word in ("population", "mean fraction", "mean curve"):
        assert word not in printed
    assert len(re.findall("independent mechanisms would give theta", printed)) == 1


def test_nrml_and_figures(ran, executable, root, tmp_path):
    """Of two states the functions of the union; of collapse alone its lognormal; the first figure draws the union."""
    found = dd.read_results(ran[0] / "out").typology
    functions, _ = found.nrml_functions()
    assert list(functions) == ["front"]
    dd.write_nrml(tmp_path / "front.xml", functions)
    for threshold, state in ((0.3, "edp_0p3"), (1.0, "collapse")):
        curve = functions["front"][state]
        union = found.at(threshold).unions["front"]
        assert np.interp(union.theta, curve.levels, curve.probability) == pytest.approx(0.5, abs=0.01)
    for curve in (found.plot(), found.plot_damage_states()):
        texts = [text.get_text() for text in curve.get_legend().get_texts()]
        assert any(f"θ = {found.unions['front'].theta:.3g} g" in text for text in texts)
    text = (ran[0] / "case.nml").read_text().replace(", edp_thresholds = 0.3", "").replace(", histories = .true.", "")
    (tmp_path / "case.nml").write_text(text)
    subprocess.run([executable, "case.nml"], cwd=tmp_path, capture_output=True, check=True)
    found = dd.read_results(tmp_path / "out").typology
    functions, _ = found.nrml_functions()
    assert functions == {"front": {"collapse": found.unions["front"]}}
    assert functions["front"]["collapse"].theta == found.unions["front"].theta


def test_one_wall_with_two_mechanisms(few, tmp_path):
    """One wall that overturns or folds, neither for certain: its number is the union too, times what can occur."""
    walls = dd.OneSidedWall(3.0, 0.25, name="b"), dd.TwoBlockWall(3.0, 0.25, name="b")
    people = dd.Population(walls, p_occ=[0.8, 0.5])
    result = dd.typology(people, few, [0.2, 0.4, 0.6, 0.8, 1.2, 1.6], progress=False)
    assert result.facade == "b"
    assert result.unions["b"].upper_asymptote == pytest.approx(0.9)
    dd.report(result, tmp_path / "report.html")
    words = words_of(tmp_path / "report.html")
    assert "if one can occur (90 %)" in words
    assert "opulation" not in words
    functions, _ = result.nrml_functions()
    assert functions["b"]["collapse"].probability[-1] == pytest.approx(0.9, abs=0.005)


def test_a_union_beyond_the_levels_is_warned_of(executable, root, tmp_path):
    """The executable, its files and Python say it of the union, and nothing of a population."""
    text = CASE.format(catalogue=root / "data/records/synthetic44.csv").replace(
        "0.15, 0.2, 0.25, 0.3, 0.4, 0.5", "0.15, 0.2"
    )
    (tmp_path / "case.nml").write_text(text)
    done = subprocess.run([executable, "case.nml"], cwd=tmp_path, capture_output=True, text=True, check=True)
    said = "the median of the mechanisms of 'front' in the same histories, "
    assert said in done.stderr
    assert "the population" not in done.stderr
    theirs = dd.read_results(tmp_path / "out").typology.warnings
    with pytest.warns(dd.errors.DondoloWarning, match=said) as caught:
        mine = dd.run_case(tmp_path / "case.nml", progress=False).typology
    assert not any("the population" in str(one.message) for one in caught)
    (own,) = (one for one in mine.warnings if one.code == "union_extrapolated")
    assert str(own) in map(str, theirs)
    assert own.numbers["theta"] == pytest.approx(mine.unions["front"].theta)


def test_hazard(ran, tmp_path):
    """The annual frequency of the report is that of the union."""
    found = dd.read_results(ran[0] / "out")
    hazard = dd.HazardCurve([0.02, 0.05, 0.1, 0.2, 0.4, 0.8, 1.6], [0.05, 0.02, 0.008, 0.003, 0.0009, 0.0002, 3e-5])
    dd.report(found, tmp_path / "report.html", hazard=hazard)
    words = words_of(tmp_path / "report.html")
    risk = found.typology.unions["front"].risk(hazard)
    assert "lost a year" not in words
    assert f"It is {risk.bounds[0]:.3g} a year" in words


def test_check_says_leaves(run, root, tmp_path):
    (tmp_path / "case.nml").write_text(
        "&job task = 'stripes', output = 'out' /\n"
        "&wall mechanism = 'one_sided', height = 3, thickness = 0.25, leaves = 2 /\n"
        f"&records catalogue = '{root / 'data/records/synthetic44.csv'}' /\n&stripes levels = 0.1, 0.2, 0.4 /\n"
    )
    assert "2 leaves of 0.125 m, one of which rocks" in run("--check", "case.nml").stdout
    done = run("case.nml")
    assert "2 leaves of 0.125 m" in done.stdout
    (row,) = rows(tmp_path / "out_walls.csv")
    assert float(row["leaves"]) == 2.0
    assert float(row["alpha_rad"]) == pytest.approx(0.0416425790985884, rel=1e-12)
    assert dd.read_results(tmp_path / "out").stripes.wall.leaves == 2.0


def test_ties_above_a_hinge():
    """Those below it, and at it, hold nothing of what is above."""
    given = ((2.5, 8.0, 0.02), (4.0, 8.0, 0.02), (8.5, 6.0, 0.05))
    ties = [dd.Tie(height, area=5e-5, length=length, depth=0.0, strain=strain) for height, length, strain in given]
    above = dd.OneSidedWall(9.0, 0.5, ties=ties, hinge_level=4.0)
    alone = dd.OneSidedWall(5.0, 0.5, ties=[dd.Tie(4.5, area=5e-05, length=6.0, depth=0.0, strain=0.05)])
    assert above.trigger_acceleration == pytest.approx(alone.trigger_acceleration, rel=1e-12)
    pulse = dd.pulses.ricker(4.0 / 9.81, 0.8)
    motions = [dd.simulate(wall, pulse, scale=1.0) for wall in (above, alone)]
    assert motions[0].edp == pytest.approx(motions[1].edp, rel=1e-9)
    assert 0.0 < motions[0].edp < 1.0
    none = dd.OneSidedWall(9.0, 0.5, ties=[dd.Tie(2.5, area=5e-05, length=8.0)], hinge_level=4.0)
    assert none.trigger_acceleration == dd.OneSidedWall(5.0, 0.5).trigger_acceleration


def test_a_facade_is_as_likely_to_collapse_as_its_hinges(run, root, tmp_path):
    """At a_g S, which lies below most of the levels."""
    text = (root / "data/cases/facades.nml").read_text().replace("'../", f"'{root}/data/")
    (tmp_path / "facades.nml").write_text(text + "&check ag = 0.2, f0 = 2.5, tc_star = 0.35 /\n")
    done = run("facades.nml")
    assert done.returncode == 0, done.stderr
    checked = done.stdout.partition("capacity / demand")[2]
    found = re.findall(r"(?m)^'(.+)': probability of collapse at a_g S = 0\.2 g: (\S+); .* (\S+)$", checked)
    assert len(found) == 6
    for name, same, independent in found:
        hinges = re.findall(rf"(?m)^{re.escape(name)} at \S+ m .*? (?:< )?(\S+)$", checked)
        assert len(hinges) > 1
        assert min(float(same), float(independent)) >= max(map(float, hinges)), name
