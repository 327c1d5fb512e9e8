"""Certified histories, and whether estimated errors find those that double precision does not tell."""

import csv
import json
import re
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import dondolo as dd
from dondolo._fortran import histories as _histories

ROOT = Path(__file__).resolve().parents[2]
TABLES = ROOT / "test" / "reference"
WALLS = {"one_sided": dd.OneSidedWall, "free_standing": dd.FreeStandingWall, "two_block": dd.TwoBlockWall}
TEXTS = ("restitution",)


def hard(name):
    """Hard histories of a table: wall, name of the record, factor on it, EDP with its bounds, status."""
    with open(TABLES / f"hard_{name}.csv", newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
    histories = []
    for row in rows:
        said = {what: row[what] for what in list(row)[1 : list(row).index("record")] if row[what]}
        wall = WALLS[row["mechanism"]](
            **{what: value if what in TEXTS else float(value) for what, value in said.items()}
        )
        bounds = [float(row[what]) for what in ("edp", "edp_lowest", "edp_highest")]
        histories.append((wall, row["record"], float(row["scale"]), *bounds, row["status"]))
    return histories


@pytest.fixture(scope="module")
def synthetic():
    return {record.name: record for record in dd.read_catalogue(ROOT / "data" / "records" / "synthetic44.csv")}


def check_estimates(records, table, engine):
    """Errors above 1e-6 are estimated to a tenth at least or doubted, and no collapse is wrong without a doubt."""
    off = unnoticed = 0
    for wall, name, scale, edp, lowest, highest, status in table:
        told = dd.simulate(
            wall, records[name], scale, history=False, solver=dd.Solver(engine=engine), estimate_error=True
        )
        error = abs(told.edp - edp)
        off += error > 1e-6
        doubt = _histories.is_doubtful(np.array([told.edp]), np.array([told.edp_error]), 1.0)[0]
        assert doubt or error <= 1e-6, (engine, wall, name, scale)
        assert doubt or told.collapsed == (edp >= 1.0), (engine, wall, name, scale)
        if status == "not_computable" and highest - lowest > 1e-5:
            unnoticed += not doubt
    # Right by luck: EDP and flag are those of the table, but the last digit of the factor turns them.
    assert unnoticed <= 1
    return off


@pytest.mark.filterwarnings("ignore::dondolo.errors.DondoloWarning")
@pytest.mark.parametrize("engine", ["lanes", "rk45"])
def test_estimates_find_hard_histories(synthetic, engine):
    assert check_estimates(synthetic, hard("synthetic"), engine) >= 5


@pytest.mark.filterwarnings("ignore::dondolo.errors.DondoloWarning")
@pytest.mark.parametrize("engine", ["lanes", "rk45"])
def test_estimates_find_hard_recorded_histories(recorded, engine):
    check_estimates(recorded, hard("recorded"), engine)


def further(name):
    """Histories of a table of further walls, as `hard`."""

    def rows(path):
        with open(path, newline="", encoding="utf-8") as file:
            return list(csv.DictReader(line for line in file if not line.startswith("#")))

    walls = {}
    for row in rows(TABLES / "walls.csv"):
        one, kind = row.pop("name"), WALLS[row.pop("mechanism")]
        said = {what: text if what in TEXTS else float(text) for what, text in row.items() if text}
        walls[one] = kind(**said, name=one)
    histories = []
    for row in rows(TABLES / f"walls_{name}.csv"):
        numbers = (float(row[what]) for what in ("scale", "edp", "edp_lowest", "edp_highest"))
        histories.append((walls[row["wall"]], row["record"], *numbers, row["status"]))
    return histories


@pytest.mark.filterwarnings("ignore::dondolo.errors.DondoloWarning")
@pytest.mark.parametrize(("engine", "least"), [("lanes", 1), ("rk45", 5)])
def test_further_walls(synthetic, engine, least):
    """Twelve walls: what is off is doubted. Every third history, and those that the last digit decides."""
    table = further("synthetic")
    assert len({wall for wall, *_ in table}) == 12
    sample = [row for k, row in enumerate(table) if k % 3 == 0 or row[-1] == "not_computable"]
    assert check_estimates(synthetic, sample, engine) >= least


@pytest.mark.filterwarnings("ignore::dondolo.errors.DondoloWarning")
@pytest.mark.parametrize("engine", ["lanes", "rk45"])
def test_further_walls_under_recorded_motions(recorded, engine):
    check_estimates(recorded, further("recorded")[::3], engine)


@pytest.mark.filterwarnings("ignore::dondolo.errors.DondoloWarning")
@pytest.mark.parametrize("engine", ["lanes", "rk45"])
def test_two_ties_under_recorded_motions(recorded, engine):
    """A facade with two ties, all of whose histories are in 33 digits: every third, and those not computable."""
    with open(TABLES / "two_ties_recorded.csv", newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
    ties = [dd.Tie(height, area=5e-5, length=8.0, preload=3e7) for height in (8.5, 5.5)]
    wall = dd.OneSidedWall(9.0, 0.5, ties=ties)
    assert len(rows) % 44 == 0 < len(rows)
    assert sum(float(row["edp"]) >= 1.0 for row in rows) > len(rows) // 10
    sample = {"quadruple": [], "not_computable": []}
    for k, row in enumerate(rows):
        if k % 3 == 0 or row["status"] == "not_computable":
            numbers = (float(row[what]) for what in ("scale", "edp", "edp_lowest", "edp_highest"))
            sample[row["status"]].append((wall, row["record"], *numbers, row["status"]))
    assert 100 * check_estimates(recorded, sample["quadruple"], engine) <= len(sample["quadruple"])
    check_estimates(recorded, sample["not_computable"], engine)


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore::dondolo.errors.DondoloWarning")
def test_certificates_are_those_of_the_table(synthetic):
    """Of the hard histories that 33 digits settle: the EDP of the table, whatever double precision says."""
    table = [row for row in hard("synthetic") if row[-1] == "quadruple" and row[3] < 1.0]
    assert len(table) > 10
    for wall, name, scale, edp, *_ in table[:3]:
        stripes = one_history(wall, synthetic[name], scale)
        certified = stripes.certify(synthetic[name], progress=False)
        assert certified.status == dd.results.Certified.QUADRUPLE
        assert certified.edp[0, 0] == pytest.approx(edp, abs=1e-6)
        assert certified.edp_lowest == certified.edp_highest == certified.edp
        assert certified.edp_error < 1e-7
        assert certified.scale == stripes.scale


def one_history(wall, record, scale):
    """A stripe of one history, its EDP spoilt and doubted."""
    stripes = dd.multiple_stripe(
        wall,
        record,
        [abs(scale) * record.peak_acceleration / wall.gravity],
        polarity="reversed" if scale < 0.0 else "as_recorded",
        estimate_error=True,
        progress=False,
    )
    return replace(stripes, edp=0.5 * stripes.edp, edp_error=np.full((1, 1), 0.1))


def test_calm_histories_stay(wall, few):
    """Histories without a doubt keep every bit, and theta has no bounds but itself."""
    plain = dd.multiple_stripe(wall, few, [0.2, 0.4, 0.8], progress=False)
    told = dd.multiple_stripe(wall, few, [0.2, 0.4, 0.8], certify=True, progress=False)
    assert plain.status is None
    assert "status" not in plain.to_frame()
    assert (told.status == dd.results.Certified.DOUBLE).all()
    assert np.array_equal(told.edp, plain.edp)
    assert np.array_equal(told.time_of_peak, plain.time_of_peak)
    assert list(told.to_frame()["status"]) == ["double"] * told.edp.size
    with pytest.raises(dd.errors.InputError, match="theta_bounds: only of certified stripes"):
        _ = plain.theta_bounds


def test_outcomes_that_the_last_digit_decides(wall, records):
    """They widen theta by a fit with all of them collapsed, and one with none."""
    told = dd.multiple_stripe(wall, records, [0.5, 0.8, 1.2], certify=True, progress=False)
    theta = told.fit().theta
    assert told.theta_bounds == (theta, theta)
    highest = told.edp.copy()
    highest[1, int(np.flatnonzero(~told.collapsed[1])[0])] = 1.0
    low, high = replace(told, edp_highest=highest).theta_bounds
    assert high == theta
    counts = told.collapses + np.array([0, 1, 0])
    assert low == dd.fit_fragility(told.levels, counts, told.histories, im="pga").theta < theta


def test_the_example_of_the_page_has_bounds(root, capsys):
    text = (root / "docs/reading_a_curve.md").read_text()
    names = {}
    exec(re.search(r"```python\n([^`]*certify=True[^`]*)```", text).group(1), names)
    assert np.isfinite(names["stripes"].theta_bounds).all()
    assert str(names["stripes"].theta_bounds) in capsys.readouterr().out


def rounded_to(record, unit):
    """The same record, its samples whole multiples of a unit [m/s2]."""
    return dd.Record(np.round(record.acceleration / unit) * unit, record.dt, name=record.name)


@pytest.mark.filterwarnings("ignore::dondolo.errors.DondoloWarning")
def test_what_hangs_on_printed_digits(records):
    """EDPs move with the size of the unit that samples are printed in, and outcomes that they turn are counted."""
    strong = [record for record in records if record.peak_acceleration > 2.0][:8]
    apart = []
    for unit in (1e-5, 1e-3, 1e-2):
        printed = [rounded_to(record, unit) for record in strong]
        told = dd.multiple_stripe(
            dd.OneSidedWall(3.0, 0.25), printed, np.linspace(0.5, 1.5, 9), certify=True, progress=False
        )
        assert np.isfinite(told.edp_rounded).all()
        both = (told.edp < 1.0) & (told.edp_rounded < 1.0)
        apart.append(np.median(np.abs(told.edp_rounded - told.edp)[both & (told.edp > 0.0)]))
        assert (told.edp_rounded[told.edp_rounded > 1.0] == 1.0).all()
        assert told.rounding_changes() == ((told.collapsed != (told.edp_rounded >= 1.0)).sum(), told.edp.size)
        of_state = (told.edp >= 0.3) != (told.edp_rounded >= 0.3)
        assert told.rounding_changes(0.3) == (of_state.sum(), told.edp.size)
    # In proportion to the unit
    assert 20.0 < apart[1] / apart[0] < 500.0
    assert 2.0 < apart[2] / apart[1] < 50.0
    turned = told.edp_rounded.copy()
    turned[2, :3] = np.where(told.collapsed[2, :3], 0.9, 1.0)
    turned[3, 0] = np.nan
    expected = (told.collapsed != (turned >= 1.0)) & ~np.isnan(turned)
    assert replace(told, edp_rounded=turned).rounding_changes() == (expected.sum(), told.edp.size - 1)
    assert expected.sum() >= 3


@pytest.mark.filterwarnings("ignore::dondolo.errors.DondoloWarning")
def test_records_without_printed_digits(wall, few):
    """Samples that were computed have none, and their histories do not count; those of other records do."""
    computed = dd.Record(0.3 * few[0].acceleration / 7.0, few[0].dt, name="computed")
    told = dd.multiple_stripe(wall, [computed, *few[1:]], [0.3, 0.5], certify=True, progress=False)
    assert np.isnan(told.edp_rounded[:, 0]).all()
    assert np.isfinite(told.edp_rounded[:, 1:]).all()
    assert told.rounding_changes()[1] == told.edp.size - 2
    alone = dd.multiple_stripe(wall, computed, [0.3, 0.5], certify=True, progress=False)
    assert alone.rounding_changes() == (0, 0)
    assert "rounding of records" in repr(alone)
    assert "not known" in repr(alone)
    # What a record comes to does not depend on the records beside it.
    some = dd.multiple_stripe(wall, few[1:], [0.3, 0.5], certify=True, progress=False)
    assert np.array_equal(some.edp_rounded, told.edp_rounded[:, 1:])


@pytest.mark.filterwarnings("ignore::dondolo.errors.DondoloWarning")
def test_files_of_records_without_printed_digits(few, run, tmp_path):
    """Their cells are empty, by the executable as by Python, and both read them."""
    computed = dd.Record(0.3 * few[0].acceleration / 7.0, few[0].dt, name="computed")
    dd.RecordSet([computed, *few[1:3]]).to_catalogue(tmp_path / "records.csv")
    case = tmp_path / "case.nml"
    case.write_text(
        f"&job task = 'stripes' output = '{tmp_path}/result' /\n"
        "&wall mechanism = 'one_sided' height = 3.0 thickness = 0.25 /\n"
        f"&records catalogue = '{tmp_path}/records.csv' /\n&stripes levels = 0.3, 0.5, 0.8 /\n"
        "&solver certify = .true. /\n",
        encoding="utf-8",
    )
    mine = dd.run_case(case, progress=False).stripes
    assert run(case).returncode == 0
    theirs = dd.read_results(tmp_path / "result").stripes
    mine.write_results(tmp_path / "mine")
    for stripes in (mine, theirs, dd.read_results(tmp_path / "mine").stripes):
        assert np.isnan(stripes.edp_rounded[:, 0]).all()
        assert np.array_equal(stripes.edp_rounded[:, 1:], mine.edp_rounded[:, 1:])
        assert stripes.rounding_changes()[1] == 6
    # Results of earlier builds have no such column.
    table = tmp_path / "result_histories.csv"
    lines = table.read_text(encoding="utf-8").splitlines()
    (head,) = [line for line in lines if "edp_rounded" in line]
    place = head.split(",").index("edp_rounded")
    kept = [
        line if line.startswith("#") else ",".join(cell for i, cell in enumerate(line.split(",")) if i != place)
        for line in lines
    ]
    table.write_text("\n".join(kept) + "\n", encoding="utf-8")
    run_file = tmp_path / "result_run.json"
    content = json.loads(run_file.read_text(encoding="utf-8"))
    content["files"] = [one for one in content["files"] if one["name"] != "_histories.csv"]
    run_file.write_text(json.dumps(content), encoding="utf-8")
    assert dd.read_results(tmp_path / "result").stripes.edp_rounded is None


def test_the_report_says_what_the_rounding_changes(undecided, tmp_path):
    changed, known = undecided.rounding_changes()
    dd.report(undecided, tmp_path / "rounded.html")
    text = (tmp_path / "rounded.html").read_text(encoding="utf-8")
    assert f"{changed} of {known}" in text


def test_refusals(wall, few):
    plain = dd.multiple_stripe(wall, few, [0.4], progress=False)
    with pytest.raises(dd.errors.InputError, match="rounding_changes: only of certified stripes"):
        plain.rounding_changes()
    with pytest.raises(dd.errors.InputError, match="have no estimated errors"):
        plain.certify(few)
    told = dd.multiple_stripe(wall, few, [0.4], estimate_error=True, progress=False)
    with pytest.raises(dd.errors.InputError, match="is missing, or differs from the one in the stripes"):
        told.certify(few[:1])
    with pytest.raises(dd.errors.InputError, match="only one is certified"):
        _ = told + told.certify(few, progress=False)


@pytest.mark.filterwarnings("ignore::dondolo.errors.DondoloWarning")
def test_only_stripes_are_certified(wall, few, run, tmp_path):
    """Populations and single histories are refused, by Python and by the executable."""
    others = dd.typology([wall], few, [0.2, 0.4], progress=False), dd.simulate(wall, few[0], estimate_error=True)
    assert not any(hasattr(other, "certify") for other in others)
    shared = f"&records catalogue = '{ROOT}/data/records/synthetic44.csv' /\n&solver certify = .true. /\n"
    tasks = {
        "typology": f"&population file = '{ROOT}/data/walls/population.csv' /\n&stripes levels = 0.2, 0.4 /\n",
        "history": "&wall mechanism = 'one_sided' height = 3.0 thickness = 0.25 /\n"
        "&history record = '06_valnerina_1979_m5.8_a' scale = 1.0 /\n",
    }
    for task, own in tasks.items():
        case = tmp_path / f"{task}.nml"
        case.write_text(f"&job task = '{task}' output = '{tmp_path}/result' /\n{own}{shared}", encoding="utf-8")
        told = run(case)
        assert told.returncode == 2
        rest = "only for task = 'stripes': populations and single histories are not certified"
        assert f"&solver: certify = .true.: {rest}" in told.stderr
        assert not list(tmp_path.glob("result*"))


def test_executable(tmp_path, records):
    """The executable writes the certificates that Python reads and computes."""
    case = tmp_path / "case.nml"
    case.write_text(
        f"&job task = 'stripes' output = '{tmp_path}/result' /\n"
        "&wall mechanism = 'one_sided' height = 3.0 thickness = 0.25 /\n"
        f"&records catalogue = '{ROOT}/data/records/synthetic44.csv' /\n"
        "&stripes levels = 0.3, 0.5, 0.8 /\n&solver certify = .true. /\n",
        encoding="utf-8",
    )
    executable = Path(sys.executable).parent / "dondolo"
    printed = subprocess.run([executable, case], check=True, capture_output=True, text=True).stdout
    assert "certified: " in printed
    theirs = dd.read_results(tmp_path / "result").stripes
    mine = dd.run_case(case, progress=False).stripes
    for name in ("status", "edp", "edp_lowest", "edp_highest", "edp_rounded", "edp_error"):
        assert np.array_equal(getattr(mine, name), getattr(theirs, name)), name
    stored = json.loads((tmp_path / "result_run.json").read_text(encoding="utf-8"))["certified"]
    assert (stored["changed"], stored["rounded"]) == mine.rounding_changes()
    assert stored["rounded"] == mine.edp.size
    assert f"records, {stored['changed']} of {stored['rounded']} outcomes change" in printed
    (state,) = stored["states"]
    assert state["changed"] == stored["changed"]
    assert (state["theta_lowest"], state["theta_highest"]) == mine.theta_bounds
    assert [state["fewest"], state["most"]] == [
        each.tolist() for each in mine.exceedance_bounds(state["edp_threshold"])
    ]
    assert set(np.unique(theirs.status)) <= set(dd.results.Certified)


@pytest.fixture(scope="module")
def undecided(wall, records):
    """Certified stripes, two of whose histories are made such that the last digit decides them."""
    told = dd.multiple_stripe(wall, records, [0.5, 0.8, 1.2], certify=True, progress=False)
    lowest, highest, status = told.edp.copy(), told.edp.copy(), told.status.copy()
    survivor, other = np.flatnonzero(~told.collapsed[1] & (told.edp[1] < 0.4))[:2]
    highest[1, survivor] = 1.0
    highest[1, other] = 0.5
    status[1, [survivor, other]] = dd.results.Certified.NOT_COMPUTABLE
    return replace(told, edp_lowest=lowest, edp_highest=highest, status=status)


@pytest.mark.parametrize("states", ["separate", "ordinal"])
def test_bounds_of_damage_states(undecided, states):
    """They are those of stripes with all histories in a state that may be, and with none."""
    thresholds = [0.4, 1.0]
    bounds = undecided.state_bounds(thresholds, states=states)
    for edp, place in ((undecided.edp_highest, 0), (undecided.edp_lowest, 1)):
        one = replace(undecided, edp=edp, collapsed=edp >= 1.0)
        assert [each[place] for each in bounds] == [
            curve.theta for curve in one.fit_damage_states(thresholds, states=states)
        ]
    assert all(low < high for low, high in bounds)
    if states == "separate":
        assert bounds[-1] == undecided.theta_bounds
    for threshold, more in ((0.4, 2), (1.0, 1)):
        fewest, most = undecided.exceedance_bounds(threshold)
        assert fewest.tolist() == undecided.exceedances(threshold).tolist()
        assert (most - fewest).tolist() == [0, more, 0]


def test_bounds_need_certificates(wall, few):
    plain = dd.multiple_stripe(wall, few, [0.4], progress=False)
    with pytest.raises(dd.errors.InputError, match="state_bounds: only of certified stripes"):
        plain.state_bounds()
    with pytest.raises(dd.errors.InputError, match="exceedance_bounds: only of certified stripes"):
        plain.exceedance_bounds(0.4)


def test_the_plot_shows_the_bounds(undecided):
    texts = [text.get_text() for text in undecided.plot().get_legend().get_texts()]
    low, high = undecided.theta_bounds
    assert "not computable (2): between these" in texts
    assert f"certified: θ from {low:.5g} to {high:.5g} g" in texts


def test_the_report_tells_how_histories_are_certified(undecided, tmp_path):
    dd.report(undecided, tmp_path / "certified.html")
    text = (tmp_path / "certified.html").read_text(encoding="utf-8")
    assert "Certified histories" in text
    assert "not_computable" in text
    for value in undecided.theta_bounds:
        assert f"{value:#.4g}" in text
    counts = undecided.exceedance_bounds(1.0)
    assert all(f"{each[1] / undecided.histories[1]:.3f}" in text for each in counts)


def test_an_interrupted_run_goes_on(wall, few, replace_procedure, monkeypatch):
    """Ctrl-C in 33 digits keeps what is certified, and certify runs the rest alone."""
    told = dd.multiple_stripe(wall, few, [0.3, 0.4], estimate_error=True, progress=False)
    doubted = replace(told, edp_error=np.where(told.collapsed, 0.0, 0.1))
    whole = doubted.certify(few, progress=False)
    monkeypatch.setattr("dondolo.analysis.certificate._BLOCK", 3)
    true, calls = dd._fortran._core.histories.certify, []

    def certify(*arguments):
        calls.append(len(arguments[2]))
        if len(calls) == 3:
            raise KeyboardInterrupt
        return true(*arguments)

    replace_procedure("histories.certify", certify)
    number = int((~told.collapsed).sum())
    assert number > 6
    with pytest.raises(
        dd.errors.Interrupted, match=f"interrupted: 6 of {number} histories in doubt are certified"
    ) as caught:
        doubted.certify(few, progress=False)
    partial = caught.value.partial
    assert (partial.status == 0).sum() == number - 6
    assert list(partial.to_frame()["status"]).count("") == number - 6
    again = partial.certify(few, progress=False)
    assert sum(calls[3:]) == number - 6
    for name in ("status", "edp", "edp_lowest", "edp_highest", "edp_rounded", "edp_error"):
        assert np.array_equal(getattr(again, name), getattr(whole, name)), name
