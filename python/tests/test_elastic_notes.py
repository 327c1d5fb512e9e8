"""What is noted of strips whose joints bend before they open: by every route, in both languages; rows of the check."""

import html
import json
import re
import subprocess
import warnings

import numpy as np
import pytest

import dondolo as dd
from dondolo.reporting.language import Language
from dondolo.reporting.words import warning as in_words

STRIP = {"height": 2.85, "thickness": 0.21, "density": 1884.0, "hinge": 0.72, "overburden": 21e3}
HOUSE = {"storeys": 2, "level": 3.0, "building_height": 6.0}
CHECK = {"ag": 0.2, "f0": 2.5, "tc_star": 0.3, "soil": "A"}
CODES = {
    "opening_above_usual": ("bends rather than rocks", "si inflette più che oscillare"),
    "lifted_while_closed": ("is not lifted while the joints are closed", "non è sollevata finché i giunti sono chiusi"),
    "floor_without_period": ("list the second mode (about 0.1 s)", "secondo modo"),
    "record_coarse": ("is more than a sixth of elastic_period", "un sesto del periodo elastico"),
    "threshold_while_closed": ("is reached while the joints are closed", "raggiunto con i giunti chiusi"),
}


def strip(period, **more):
    return dd.TwoBlockWall(**STRIP | {"overburden_inertia": 0.0} | more, elastic_period=period)


def heard(call):
    """Warnings of a call, by their codes."""
    with warnings.catch_warnings(record=True) as found:
        warnings.simplefilter("always", dd.errors.DondoloWarning)
        call()
    return {one.message.code: one.message for one in found if one.message.code in CODES}


def pulse(dt):
    return dd.Record(np.round(3.0 * np.sin(2 * np.pi * np.arange(41) * dt / 0.4), 6), dt, name="pulse")


def test_of_walls():
    """Each has its own condition, and none is said of a strip that is within all."""
    fine, record = strip(0.1), pulse(0.01)
    quiet = dd.Building(0.3, **HOUSE)
    both = dd.Building([0.3, 0.1], participation=[0.6, -0.3], participation_top=[1.2, 0.2])
    assert heard(lambda: dd.multiple_stripe(fine, record, [0.5], progress=False)) == {}
    for wall, code in (
        (strip(0.21), "opening_above_usual"),
        (strip(0.1, overburden_inertia=1.0), "lifted_while_closed"),
        (strip(0.1, building=quiet), "floor_without_period"),
    ):
        assert set(heard(lambda wall=wall: dd.multiple_stripe(wall, record, [0.5], progress=False))) == {code}
        assert set(heard(lambda wall=wall: dd.simulate(wall, record))) == {code}
    assert heard(lambda: dd.multiple_stripe(strip(0.1, building=both), record, [0.5], progress=False)) == {}
    # A house that is stiffer than the wall: there is no second mode near the period.
    stiff = strip(0.1, building=dd.Building(0.08, **HOUSE))
    assert heard(lambda: dd.multiple_stripe(stiff, record, [0.5], progress=False)) == {}
    late = heard(lambda: dd.simulate(strip(0.21), record))["opening_above_usual"]
    assert late.numbers["opening_edp"] == pytest.approx(strip(0.21).opening_edp, rel=1e-12)
    assert strip(0.2).opening_edp < 0.1 < strip(0.21).opening_edp


def test_of_records():
    """A step of a sixth of the period is not noted, a longer one is, once for all records."""
    records = [pulse(0.01), pulse(0.02), pulse(0.0201)]
    assert heard(lambda: dd.multiple_stripe(strip(0.12), records[:2], [0.5], progress=False)) == {}
    found = heard(lambda: dd.multiple_stripe(strip(0.12), records, [0.5], progress=False))
    (one,) = found.values()
    assert one.numbers == {
        "dt_s": 0.0201, "limit_s": pytest.approx(0.02), "elastic_period_s": 0.12, "records_beyond": 1, "records": 3
    }  # fmt: skip
    assert set(heard(lambda: dd.simulate(strip(0.12), records[2]))) == {"record_coarse"}
    assert heard(lambda: dd.simulate(dd.TwoBlockWall(**STRIP, overburden_inertia=0.0), records[2])) == {}


def test_of_states(few):
    """Thresholds below the opening, of stripes and of populations."""
    wall, levels = strip(0.1), np.linspace(0.3, 1.2, 4)
    stripes = dd.multiple_stripe(wall, few, levels, progress=False)
    assert wall.opening_edp == pytest.approx(0.0258, abs=1e-4)
    found = heard(lambda: stripes.fit(0.02))
    assert found["threshold_while_closed"].numbers == {
        "edp_threshold": 0.02, "opening_edp": pytest.approx(wall.opening_edp)
    }  # fmt: skip
    assert "threshold_while_closed" not in heard(lambda: stripes.fit(0.03))
    assert "threshold_while_closed" not in heard(stripes.fit)
    people = (wall, dd.TwoBlockWall(**STRIP, overburden_inertia=0.0))
    for states, count in (([0.02], 1), ([0.03], 0)):
        told = heard(lambda states=states: dd.typology(people, few, levels, edp_thresholds=states, progress=False))
        assert len(told) == count


@pytest.fixture(scope="module")
def run(tmp_path_factory, executable, root):
    """Folder with a run that has all five."""
    folder = tmp_path_factory.mktemp("notes")
    (folder / "pulse.txt").write_text("\n".join(str(value) for value in pulse(0.05).acceleration))
    (folder / "coarse.csv").write_text("file,dt_s,units\npulse.txt,0.05,m/s2\n")
    given = ", ".join(f"{name} = {value!r}" for name, value in STRIP.items())
    site = ", ".join(f"{name} = {value!r}" for name, value in CHECK.items())
    (folder / "all.nml").write_text(
        f"&job task = 'stripes', output = 'all' /\n&wall name = 'fascia', mechanism = 'two_block', {given},\n"
        "overburden_inertia = 1.0, elastic_period = 0.25 /\n&records catalogue = 'coarse.csv' /\n"
        f"&building period = 0.3, storeys = 2, level = 3.0, building_height = 6.0 /\n&check {site} /\n"
        "&stripes levels = 0.1, 0.5, 1.0, 2.0, edp_thresholds = 0.05 /\n"
    )
    done = subprocess.run([executable, "all.nml"], cwd=folder, capture_output=True, text=True, check=True)
    (folder / "said").write_text(done.stdout + done.stderr)
    done = subprocess.run([executable, "--check", "all.nml"], cwd=folder, capture_output=True, text=True, check=True)
    (folder / "planned").write_text(done.stdout + done.stderr)
    return folder


def test_console_and_file_of_the_run(run):
    told = [one["code"] for one in json.loads((run / "all_run.json").read_text())["warnings"]]
    for code, (words, _) in CODES.items():
        assert told.count(code) == 1, code
        for name in ("said", "planned"):
            assert (run / name).read_text().count(words) == 1, (code, name)


@pytest.mark.parametrize("lang", ["en", "it"])
def test_reports(run, lang, tmp_path):
    results = dd.read_results(run / "all")
    dd.report(results, tmp_path / "report.html", lang=lang)
    dd.calculation_report(results, tmp_path / "relazione.html", lang=lang)
    for path in (tmp_path / "report.html", tmp_path / "relazione.html"):
        text = html.unescape(re.sub(r"<[^>]+>", " ", path.read_text(encoding="utf-8")))
        for words in CODES.values():
            assert words[lang == "it"] in text, (path, words)
    for one in results.run.warnings:
        if one.code in CODES:
            assert CODES[one.code][1] in in_words(Language("it"), one)


def test_rows_of_the_check(run):
    """a_y against S_e(T, xi), by hand; information, which changes no verdict."""
    wall = strip(0.1, elastic_damping=0.02)
    check = dd.check_ntc(wall, dd.Site(**CHECK))
    assert check.value("mechanism", "", "elastic_period") == 0.1
    assert check.value("mechanism", "", "elastic_damping") == 0.02
    rigid = dd.check_ntc(dd.TwoBlockWall(**STRIP, overburden_inertia=0.0), dd.Site(**CHECK))
    names = {(one.method, one.limit_state, one.quantity) for one in check.rows}
    new = names - {(one.method, one.limit_state, one.quantity) for one in rigid.rows}
    assert new == {
        ("mechanism", "", "elastic_period"), ("mechanism", "", "elastic_damping"),
        ("mechanism", "", "opening_acceleration"), ("linear", "SLD", "opening_demand"),
        ("linear", "SLD", "opening_ratio"),
    }  # fmt: skip
    assert check.verified == rigid.verified
    # Soil A: S = 1, T_C = T_C* = 0.3 s, T_B = 0.1 s, where the plateau begins
    demand = 0.2 * 2.5 * np.sqrt(10.0 / 7.0)
    assert check.value("linear", "SLD", "opening_demand") == pytest.approx(demand, rel=1e-9)
    opening = check.value("mechanism", "", "opening_acceleration")
    factor = check.value("mechanism", "", "knowledge_factor")
    assert check.value("linear", "SLD", "opening_ratio") == pytest.approx(opening / (9.81 * factor * demand), rel=1e-9)
    # The check is at the weakest hinge, where the strip opens at another acceleration than at the given one.
    moved = check.value("mechanism", "", "weakest_hinge")
    assert moved != pytest.approx(0.72, abs=0.01)
    there = dd.TwoBlockWall(
        **STRIP | {"hinge": moved, "overburden_inertia": 0.0}, elastic_period=0.1, elastic_damping=0.02
    )
    assert opening == pytest.approx(there.opening_acceleration, rel=1e-6)
