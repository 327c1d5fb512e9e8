"""Computed against measured: the campaigns, the statistics against other implementations, and the page."""

import copy
import importlib
import json
import re
import subprocess
import sys
import zipfile

import numpy as np
import pytest

import dondolo as dd

pytestmark = pytest.mark.filterwarnings("ignore::dondolo.errors.DondoloWarning")
NAMES = ("campaigns", "scores", "values", "motions", "workbook", "boulders", "strips", "chapters", "page", "run")


@pytest.fixture(scope="module")
def scripts(root):
    """The modules of docs/experiments, by their names."""
    folder = str(root / "docs/experiments")
    before = {name: sys.modules.pop(name, None) for name in NAMES}
    sys.path.insert(0, folder)
    try:
        yield {name: importlib.import_module(name) for name in NAMES}
    finally:
        sys.path.remove(folder)
        for name in NAMES:
            sys.modules.pop(name, None)
            if before[name] is not None:
                sys.modules[name] = before[name]


@pytest.fixture(scope="module")
def statistics(scripts):
    """Statistics of the campaigns whose numbers are in the repository."""
    runners = scripts["values"].RUNNERS
    return {name: run(scripts["campaigns"].read(name))[0] for name, run in runners.items()}


def test_page_and_statistics_are_the_stored_ones(root):
    """Without raw data, to the byte; the command says what it skips."""
    command = [sys.executable, root / "docs/experiments/run.py", "--check"]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    assert "granite: skipped, 490 motions are not here" in done.stdout
    assert "shakebot: not used" in done.stdout
    lines = (root / "out/experiments/experiments.csv").read_text().splitlines()
    assert lines[0].startswith("campaign,test,specimen,quantity,measured,computed")
    assert len(lines) == 1 + 314 + 3 + 15 + 34


def test_a_change_of_statistics_is_found(scripts):
    kept = scripts["campaigns"].stored()
    differences = scripts["campaigns"].differences
    assert differences(kept, kept) == []
    changed = copy.deepcopy(kept)
    changed["limestone"]["first_impact"]["bias"] += 2e-6
    assert len(differences(changed, kept)) == 1
    changed = copy.deepcopy(kept)
    changed["granite"]["specimens"]["1"]["test"]["misses"] += 10
    assert differences(changed, kept, counts=10) == []
    changed["granite"]["specimens"]["1"]["test"]["misses"] += 1
    assert len(differences(changed, kept, counts=10)) == 1
    del changed["granite"]["specimens"]["2"]["curve"]
    assert any("curve" in line for line in differences(changed, kept, counts=10))


def test_schema(scripts):
    """Every campaign has citation, licence, split and a reason if it is not used."""
    campaigns = scripts["campaigns"]
    for name in campaigns.NAMES:
        campaign = campaigns.read(name)
        assert campaign.facts["citation"]
        assert campaign.facts["licence"]
        assert campaign.is_used == (name != "shakebot")
    assert sorted(path.name for path in campaigns.FOLDER.iterdir() if path.is_dir()) == sorted(campaigns.NAMES)
    wrong = copy.deepcopy(campaigns.read("sin01"))
    wrong.facts["use"] = "no"
    wrong.tests[0]["quantity"] = "colour"
    wrong.tests[1]["measured"] = "0.5"
    wrong.tests[3]["test"] = wrong.tests[2]["test"]
    assert len(campaigns.problems(wrong)) == 4


def test_nothing_of_the_boulders_but_statistics(root, scripts):
    """Their table, their motions and counts by intensity are not ours to pass on."""
    assert [path.name for path in (root / "data/experiments/granite").iterdir()] == ["campaign.json"]
    assert scripts["campaigns"].read("granite").tests == []

    def longest(value):
        if isinstance(value, dict):
            return max((longest(one) for one in value.values()), default=0)
        return max(len(value), *(longest(one) for one in value)) if isinstance(value, list) else 0

    assert longest(scripts["campaigns"].stored()["granite"]) == 0


def test_limestone(statistics):
    """Against an independent program: means, scatter within and between, coverage, ten impacts."""
    first, ten = statistics["limestone"]["first_impact"], statistics["limestone"]["ten_impacts"]
    known = {
        "n": 134, "mean_ratio": 0.989527, "sd_ratio": 0.039048, "bias": -0.011307, "sd": 0.039699,
        "within_ratio": 0.035072, "between_ratio": 0.017879, "ratios_above_1": 51, "measured_above_1": 22,
        "mean_ratio_squat": 1.0000, "mean_ratio_slender": 0.9860, "slope_per_slenderness": -0.00244,
        "se_slope": 0.00096,
    }  # fmt: skip
    digits = {"mean_ratio_squat": 4, "mean_ratio_slender": 4, "slope_per_slenderness": 5, "se_slope": 5}
    assert {name: round(first[name], digits.get(name, 6)) for name in known} == known
    assert list(first["coverage"].values()) == [121, 80, 73]
    shapes = {shape: round(one["bias"], 6) for shape, one in ten["by_slenderness"].items() if shape != "13"}
    assert shapes == {"4": 0.040596, "6": -0.004210, "8": 0.012714, "15": -0.041131}
    assert (ten["n"], round(ten["bias"], 6), round(ten["sd"], 6)) == (20, -0.001046, 0.042204)
    assert round(ten["by_slenderness"]["4"]["measured"], 3) == 0.950


def test_housner(scripts):
    for slenderness, e in ((4, 0.911765), (6, 0.959459), (8, 0.976923), (13, 0.991176), (15, 0.993363)):
        row = {"height": f"{0.05 * slenderness}", "thickness": "0.05", "density": "2200"}
        assert round(scripts["values"]._speed_ratio(row), 6) == e


@pytest.mark.parametrize(
    ("height", "thickness", "density", "load", "hinge", "trigger"),
    [
        (2.764, 0.102, 1835.0, 10200.0, 0.5, 0.592623),
        (2.764, 0.102, 1835.0, 10200.0, 0.6, 0.555659),
        (2.58, 0.21, 1884.0, 21000.0, 0.6, 1.267060),
        (2.58, 0.21, 1884.0, 21000.0, 0.72, 1.309899),
    ],
)
def test_triggers(scripts, height, thickness, density, load, hinge, trigger):
    """Against virtual work of a strip with a central load."""
    weight, k = density * 9.81 * height * thickness, hinge / (1.0 - hinge)
    moment = weight * (hinge / 2.0 + (1.0 - hinge) * (1.0 + k / 2.0)) + load * (1.0 + k / 2.0)
    assert round(thickness * moment / (weight * hinge * height / 2.0), 6) == trigger
    row = {"height": height, "thickness": thickness, "density": density, "overburden": load, "hinge": hinge}
    found = scripts["values"].triggers({name: str(value) for name, value in row.items()})
    assert [round(found[end], 6) for end in ("least", "largest")] == [trigger, trigger]


def test_strips_are_computed_at_rest(statistics):
    assert statistics["safego"]["computed_zero"] == statistics["safego"]["runs_with_pga"] == 24
    assert statistics["sin01"]["stood"] == 14


def test_fit_is_that_of_the_library(scripts):
    """A probit of single outcomes has the parameters of a fit to their counts."""
    rng = np.random.default_rng(3)
    levels = np.array([0.2, 0.4, 0.6, 0.8])
    x = np.repeat(levels, 40)
    falls = rng.random(160) < np.repeat([0.1, 0.3, 0.55, 0.85], 40)
    found = scripts["scores"].fit_lognormal(x, falls)
    counts = [int(falls[x == level].sum()) for level in levels]
    known = dd.fit_fragility(levels, counts, 40)
    assert found.theta == pytest.approx(known.theta, rel=1e-6)
    assert found.beta == pytest.approx(known.beta, rel=1e-6)
    weights = np.where(np.arange(160) % 2, 2.0, 0.0)
    doubled = scripts["scores"].fit_lognormal(np.repeat(x[1::2], 2), np.repeat(falls[1::2], 2))
    assert scripts["scores"].fit_lognormal(x, falls, weights).theta == pytest.approx(doubled.theta, rel=1e-9)
    assert np.isnan(scripts["scores"].fit_lognormal([1.0, 2.0], [False, True]).theta)


def test_random_effects(scripts):
    """Scatter that is put in comes out: within, between, and as the error of the model."""
    rng = np.random.default_rng(5)
    groups = np.repeat(np.arange(400), 6)
    x = 0.3 * rng.standard_normal(400)[groups] + 0.1 * rng.standard_normal(2400)
    found = scripts["scores"].within_and_between(x, groups)
    assert found["within"] == pytest.approx(0.1, rel=0.05)
    assert found["between"] == pytest.approx(0.3, rel=0.1)
    se = np.full(4000, 0.2)
    error = scripts["scores"].model_error(0.15 * rng.standard_normal(4000) + se * rng.standard_normal(4000), se)
    assert error["tau"] == pytest.approx(0.15, rel=0.1)
    assert error["enough"]
    few = scripts["scores"].model_error([0.1, 0.3], [0.05, 0.05])
    assert not few["enough"]
    assert few["tau"] == pytest.approx((0.02 - 0.0025) ** 0.5)
    assert few["beta"] == pytest.approx(few["tau"] * 1.5**0.5)


def test_bootstrap_draws_groups(scripts):
    """The standard error of a mean is that of the groups, not of the tests."""
    groups = np.repeat(np.arange(50), 8)
    x = np.random.default_rng(2).standard_normal(50)[groups]
    se = scripts["scores"].bootstrap(groups, lambda w: [np.average(x, weights=w)])[0]
    assert se == pytest.approx(x.std() / 50**0.5, rel=0.1)


def test_yardsticks(scripts):
    """A threshold is found on other tests: one that each group needs for itself is of no use to the others."""
    scores = scripts["scores"]
    x, falls = np.array([1.0, 2.0, 3.0, 4.0]), np.array([False, False, True, True])
    assert scores.best_threshold(x, falls) == pytest.approx(6.0**0.5)
    assert scores.best_threshold(x, np.zeros(4, bool)) > 4.0
    apart = scores.threshold_across(np.r_[x, 10.0 * x], np.r_[falls, falls], np.repeat(["a", "b"], 4))
    assert apart.tolist() == [False] * 4 + [False] + [True] * 3 or apart.tolist() == [False] * 4 + [True] * 4
    found = scores.rightness([True, True, False, False], [True, False, True, False])
    assert (found["right"], found["always_stands"], found["false_alarms"], found["misses"]) == (0.5, 0.5, 1, 1)


def test_zeros_are_counted(scripts):
    x, zeros = scripts["scores"].log_ratios([1.0, 2.0, 3.0], [1.0, 0.0, 3.0])
    assert (x.tolist(), zeros) == ([0.0, 0.0], 1)


def test_reliability(scripts):
    rng = np.random.default_rng(1)
    p = rng.random(4000)
    good = scripts["scores"].reliability(p, rng.random(4000) < p)
    assert good["bins_within"] >= 6
    assert good["brier"] == pytest.approx(1.0 / 6.0, abs=0.01)
    assert scripts["scores"].reliability(p, rng.random(4000) < p**3)["bins_within"] <= 3


def test_motion_of_a_table(scripts, tmp_path):
    """What a table does between the corners stays; offset, drift and noise go."""
    t = np.arange(0.0, 40.0, 1.0 / 800.0)
    wave = 0.2 * np.sin(2.0 * np.pi * 2.0 * t) * np.exp(-(((t - 20.0) / 5.0) ** 2))
    noise = 0.1 * np.sin(2.0 * np.pi * 120.0 * t)
    acceleration, dt = scripts["motions"].table_motion(wave + 0.03 + 1e-4 * t)
    assert dt == 0.005
    assert np.abs(acceleration - 9.81 * wave[::4]).max() < 1e-3
    noisy, _ = scripts["motions"].table_motion(wave + noise)
    assert np.abs(noisy - 9.81 * wave[::4])[2000:-2000].max() < 0.02
    lines = [f"{a:.6g}\t{b:.6g}\t{a:.6g}\t9\t" for a, b in zip(t[:50], wave[:50], strict=True)]
    (tmp_path / "Test001.txt").write_text("Time\tAmplitude\tTime\tAmplitude\t\r\n" + "\r\n".join(lines) + "\r\n")
    column = scripts["motions"].second_column(tmp_path / "Test001.txt")
    assert np.allclose(column, wave[:50], rtol=1e-5)


def test_workbook(scripts, tmp_path):
    """Cells by their places, shared strings and empty cells too."""
    names = 'xmlns="http://schemas.openxmlformats.org/spreadsheetml/2006/main"'
    sheet = (
        f'<worksheet {names}><sheetData><row r="1"><c r="A1" t="s"><v>0</v></c><c r="C1" t="s"><v>1</v></c></row>'
        '<row r="2"><c r="B2"><v>2.5</v></c><c r="AA2" t="inlineStr"><is><t>far</t></is></c></row>'
        "</sheetData></worksheet>"
    )
    with zipfile.ZipFile(tmp_path / "book.xlsx", "w") as archive:
        archive.writestr("xl/worksheets/sheet1.xml", sheet)
        archive.writestr("xl/sharedStrings.xml", f"<sst {names}><si><t>Test</t></si><si><t>fell</t></si></sst>")
    rows = scripts["workbook"].rows(tmp_path / "book.xlsx")
    assert rows[0] == ["Test", "", "fell"]
    assert (rows[1][1], rows[1][26], len(rows[1])) == ("2.5", "far", 27)


def test_slenderness_is_identified_by_counts(scripts):
    """Halfway between the first and the last that fit; counts decide, not which tests they are."""
    boulders = scripts["boulders"]
    computed = np.arange(100)[None, :] < np.arange(100, 0, -1)[:, None]
    index, fits = boulders.identified(computed, np.arange(100) >= 40)
    assert computed[fits].sum(axis=1).tolist() == [62, 61, 60, 59, 58]
    assert computed[index].sum() == 60
    block = boulders.block(0.12)
    assert block.frequency_parameter == pytest.approx(boulders.FREQUENCY, rel=1e-6)
    assert block.restitution_coefficient == pytest.approx(1.0 - 1.5 * np.sin(0.12) ** 2, rel=1e-9)


def test_smallest_factors_bracket_the_flags(scripts):
    """At the smallest factor the block falls, and 4 % below it stands."""
    boulders = scripts["boulders"]
    records = list(dd.example_records())[:3]
    for record, factor in zip(records, boulders.smallest_factors(records, 0.12), strict=True):
        wall = boulders.block(0.12)
        assert dd.simulate(wall, record, factor, history=False).collapsed
        assert not dd.simulate(wall, record, factor / 1.04, history=False).collapsed


def test_motions_of_a_strip(scripts, tmp_path, capsys, monkeypatch):
    """Velocities become accelerations; a table at rest overturns nothing, one that reverses fast overturns all."""
    strips, campaign = scripts["strips"], scripts["campaigns"].read("sin01")
    t = np.arange(0.0, 3.0, 1.0 / 256.0)
    for row in campaign.tests:
        speed = 6.0 * np.sin(2.0 * np.pi * 0.5 * t) if row["test"] == "15" else 1e-3 * np.sin(2.0 * np.pi * 2.0 * t)
        lines = [f"{time:.4f}0000,{one:.16f}" for time, one in zip(t, speed, strict=True)]
        (tmp_path / f"{row['motion']}{strips.ENDING}").write_text("velocity of the table\n" + "\n".join(lines) + "\n")
    acceleration, dt = strips.table_velocity(tmp_path / f"Gr_2_200{strips.ENDING}")
    assert dt == pytest.approx(1.0 / 256.0, rel=1e-4)
    assert np.abs(acceleration).max() == pytest.approx(6.0 * np.pi, rel=1e-3)
    monkeypatch.setattr(strips, "WALLS", 12)
    run = scripts["run"]
    found, rows = run.strip(campaign, run._options(["sin01", "--raw", str(tmp_path)]), {}, [])
    shares = list(found["motions"]["share_that_falls"].values())
    assert shares == [0.0] * 14 + [1.0]
    assert len(rows) == 15
    one = found["motions"]["by_hinge"]["0.6"]
    assert (one["n"], one["right"], one["always_stands"]) == (14, 1.0, 1.0)
    assert "sha256 of its motions" in capsys.readouterr().out
    walls = strips.sample(campaign.tests[0])
    assert all(0.5 <= wall.hinge <= 0.65 and 0.84 <= wall.restitution_factor <= 0.90 for wall in walls)
    page = "\n".join(scripts["page"]._outcomes(found["motions"]))
    assert "always stands" in page
    kept = {"motions": {"known": 1}}
    assert run.strip(campaign, run._options([]), kept, [])[0] == kept


@pytest.fixture(scope="module")
def pretended(scripts):
    """Tests whose outcomes are those of two blocks: what is identified and compared must be found to agree."""
    boulders = scripts["boulders"]
    records = list(dd.example_records())
    scales = [0.6, 1.0, 1.5, 2.2]
    motions = [(scale * record.acceleration, record.dt) for scale in scales for record in records]
    pgv = np.array([scale * record.intensity("pgv") for scale in scales for record in records])
    n, near = len(motions), np.arange(len(motions)) % 3 == 0
    tests = boulders.Tests(
        names=[f"Test{i}" for i in range(n)],
        fell={},
        simulated={name: np.zeros((2, n), bool) for name in "12"},
        pgv=pgv,
        pace=np.where(near, 0.1, 0.05),
        waveforms=np.array([record.name for _ in scales for record in records]),
        dates=np.where(np.arange(n) < n // 2, "20210701", "20210801"),
        motions=motions,
    )
    shaken = boulders.records_of(tests)
    for name, alpha in (("1", 0.12), ("2", 0.18)):
        tests.fell[name] = boulders.flags(shaken, [alpha])[0]
    return tests, shaken


def test_a_campaign_of_blocks_is_computed_without_error(scripts, pretended, monkeypatch):
    """If the specimens were blocks, every flag would be right, the bias 0 and the curves as wide as each other."""
    boulders, (tests, records) = scripts["boulders"], pretended
    monkeypatch.setattr(boulders, "ALPHAS", np.array([0.10, 0.11, 0.12, 0.13, 0.18, 0.19]))
    monkeypatch.setattr(boulders, "ALIKE", 0)
    monkeypatch.setattr(boulders, "PEAKS", 0.03 * 1.04 ** np.arange(180))
    found = boulders.statistics(tests, records, n_resamples=4)
    for name, alpha in (("1", 0.12), ("2", 0.18)):
        one = found[name]
        assert one["alpha"] == alpha
        assert one["all"]["right"] == one["test"]["right"] == 1.0
        assert one["yardsticks"]["always_stands"] < 0.9
        assert one["curve"]["bias"] == pytest.approx(0.0, abs=1e-9)
        assert one["curve"]["beta_ratio"] == pytest.approx(1.0, abs=1e-9)
        single = one["single_motion"]
        assert single["bias"] == single["bias_of_computed_outcomes"]
        assert single["beta_single"] == single["beta_of_computed_outcomes"]
        assert 0.0 < single["bias"] < 0.3
        assert one["splits"]["waveforms"]["n"] == one["splits"]["waveforms"]["all_right"]
    effect = boulders.processing_effect(tests, {"unchanged": records, "the same": records}, found)
    assert effect["2"]["the same"] == {"flags_changed": 0, "right": 1.0, "bias": pytest.approx(0.0, abs=1e-9)}


def test_the_blind_half_has_bands(scripts, pretended):
    """A right model is inside all of them, one of another slenderness is not."""
    boulders, (tests, _) = scripts["boulders"], pretended
    found = boulders.hold(tests, {"1": 0.12, "2": 0.18})
    assert {what: one["band"] for what, one in found.items()} == {
        "1, nearly_static": 0.85, "1, others": 0.65, "2, nearly_static": 0.85, "2, others": 0.75,
    }  # fmt: skip
    assert all(one["inside"] for one in found.values())
    assert not all(one["inside"] for one in boulders.hold(tests, {"1": 0.03, "2": 0.03}).values())


def test_raw_data_of_another_commit_are_skipped(scripts, tmp_path, capsys):
    run = scripts["run"]
    campaign = scripts["campaigns"].read("granite")
    for name in scripts["boulders"].TABLES:
        (tmp_path / name).write_bytes(b"another")
    assert run.granite(campaign, run._options(["granite", "--raw", str(tmp_path)]), {}) == ({}, [])
    assert "not those of the commit" in capsys.readouterr().out
    run.granite(campaign, run._options(["granite", "--raw", str(tmp_path), "--hold"]), {})
    assert "the blind half is not run, 0 of its 92 motions are here" in capsys.readouterr().out


def test_no_share_without_its_yardsticks(scripts):
    """Every column of right flags has the guess that nothing falls beside it, and the sentence has all yardsticks."""
    stored = scripts["campaigns"].stored()
    sentence = scripts["chapters"].granite_sentence(stored["granite"]["specimens"])
    for words in (
        'always "stands"',
        "one threshold on PGV",
        "nearly static",
        "testing authors' own simulations",
        "s.e.",
    ):
        assert words in sentence
    for name, one in stored["granite"]["specimens"].items():
        assert {"always_stands", "best_simulation_of_the_authors"} <= set(one["yardsticks"]), name
        for part in ("test", "all", "identified_on"):
            assert "always_stands" in one[part]
    worse = copy.deepcopy(stored["granite"]["specimens"])
    worse["2"]["curve"]["bias"], worse["2"]["curve"]["beta_ratio"] = 0.2, 1.2
    changed = scripts["chapters"].granite_sentence(worse)
    assert "18 % too low, on the safe side, for one" in changed
    assert "wider" not in changed


def test_numbers_that_are_quoted(root, scripts):
    """The README and the documentation of simulate have the numbers of the page, with its yardsticks."""
    specimens = scripts["campaigns"].stored()["granite"]["specimens"]
    line = re.search(r"(?s)\*\*Compared with tests\.\*\*.*?\n- ", (root / "README.md").read_text(encoding="utf-8"))[0]
    shares = [int(one) for pair in re.findall(r"(\d+) and (\d+) %", line) for one in pair]
    yardsticks = ("always_stands", "one_pgv_threshold_of_other_waveforms")
    wanted = [specimens[name]["test"]["right"] for name in "21"]
    wanted += [specimens[name]["yardsticks"][key] for key in yardsticks for name in "21"]
    assert shares == [round(100.0 * one) for one in wanted]
    scatter = sorted(f"{specimens[name]['single_motion']['beta_single']:.2f}" for name in "12")
    assert "standard deviation of {} and {}".format(*scatter) in " ".join(dd.simulate.__doc__.split())


def test_boulders_are_within_the_tolerance_of_another_program(scripts):
    """Falls of 119 and of 371 at the identified slendernesses, as found by two other integrators."""
    specimens = scripts["campaigns"].stored()["granite"]["specimens"]
    assert [specimens[name]["alpha"] for name in "12"] == [0.078, 0.12]
    assert [specimens[name]["identified_on"]["fell"] for name in "12"] == [70, 48]
    assert [specimens[name]["test"]["fell"] for name in "12"] == [117, 105]
    right = [specimens[name]["test"]["right"] * 371 for name in "12"]
    assert np.abs(np.array(right) - [0.849 * 371, 0.898 * 371]).max() <= 10.0
    assert abs(specimens["2"]["identified_on"]["computed_to_fall"] - 47) <= 2
    assert abs(specimens["2"]["test"]["computed_to_fall"] - 101) <= 3


def test_figures_in_both_widths(scripts, root, tmp_path):
    """Each has a file in the documents, and is drawn in a column and across a page."""
    drawings = importlib.import_module("drawings")
    campaigns = scripts["campaigns"]
    known = {name: campaigns.read(name) for name in campaigns.NAMES}
    pages = [root / "docs/experiments.md", root / "docs/studies/experiments.md"]
    page = "\n".join(path.read_text(encoding="utf-8") for path in pages)
    for width in (88.0, 180.0):
        with dd.style("journal", width=width):
            drawn = drawings.draw(known, campaigns.stored(), tmp_path / str(width), width / 25.4)
        assert [path.name for path in drawn if f"figures/{path.name}" not in page] == []
        assert all((root / "docs/figures" / path.name).is_file() for path in drawn)
    assert len(re.findall(r"!\[", page)) == len(drawn) == 3


def test_reports_say_how_often_a_mechanism_was_tested(scripts):
    """With the numbers of the page, and nothing about tests of other mechanisms."""
    from dondolo.reporting.tested import TESTED, sentences

    specimens = scripts["campaigns"].stored()["granite"]["specimens"]
    biases = [specimens[name]["curve"]["bias"] for name in "12"]
    one = TESTED["free_standing"]
    assert one == (2, round(float(np.mean(biases)), 2), round(float(np.std(biases, ddof=1)), 2))
    strips = {row["specimen"] for name in ("sin01", "safego") for row in scripts["campaigns"].read(name).tests}
    assert TESTED["two_block"] == (len(strips), None, None)
    assert set(TESTED) == {"free_standing", "two_block"}
    said = [
        words.format(**values)
        for words, values in sentences(["one_sided", "free_standing", "one_sided"], str, lambda digits: digits)
    ]
    assert said[0] == "One_sided: no test of this mechanism is in the program."
    assert "2 specimens, bias +0.09, standard deviation 0.33" in said[1]
    assert len(said) == 2


def test_inputs_have_checksums(root):
    found = json.loads((root / "out/experiments/experiments.json").read_text(encoding="utf-8"))
    assert len(found["sha256"]["limestone/tests.csv"]) == 64
    assert found["versions"]["dondolo"] == dd.__version__
