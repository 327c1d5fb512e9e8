"""Every note on a check reaches the console, the run's file, the report and the calculation report."""

import json
import subprocess

import pytest
from test_side_by_side import text_of
from test_tabulated_checks import table_of

import dondolo as dd
from dondolo.reporting.language import Language
from dondolo.reporting.words import warning

pytestmark = pytest.mark.filterwarnings("ignore::dondolo.errors.DondoloWarning")

HAZARD = ((0.104, 0.261, 0.334), (2.332, 2.364, 2.4), (0.281, 0.347, 0.364))
SITE = dd.Site(*HAZARD, soil="B")
HOUSE = {"period": 0.3, "storeys": 3, "building_height": 9.6}
TIE = {"length": 9.0, "strength": 2.4e8, "modulus": 2.05e11}
MASONRY = {"masonry_compression": 1e6, "masonry_shear": 3e4, "masonry_tension": 4e4, "masonry_friction": 0.4}
PLATE = {"bar": 0.02, "spacing": 2.0, "plate_width": 0.2, "plate_height": 0.2, "plate_thickness": 5e-3}
LOAD = {"overburden": 8e3, "overburden_inertia": 1.0}

#: Codes of notes; the wall, its site, and what else the check is given
CASES = [
    (["knowledge_raised", "modulus_missing"], dd.FreeStandingWall(1.7, 0.3), SITE, {"knowledge_factor": 1.2}),
    (["serviceability", "free_behaviour", "period_between"],
     dd.FreeStandingWall(1.7, 0.3, young_modulus=(4e8, 8e8)), dd.Site(*HAZARD, soil="B", use_class="IV"), {}),
    (["friction_not_given"], dd.FreeStandingWall(0.5, 0.4, young_modulus=1e9), SITE, {}),
    (["slides_first"], dd.FreeStandingWall(0.5, 0.4, young_modulus=1e9), SITE, {"friction": 0.4}),
    (["hinge_above_usual", "top_without_load"], dd.TwoBlockWall(3.0, 0.14), SITE, {}),
    (["hinge_not_weakest", "diaphragm_not_in_demand", "building_softened"],
     dd.TwoBlockWall(3.2, 0.3, hinge=0.6, **LOAD, building=dd.Building(**HOUSE, level=3.2, diaphragm_period=0.4)),
     SITE, {}),
    (["plate_too_thin", "anchor_before_bar", "anchor_factor_differs", "ties_counted"],
     dd.OneSidedWall(8.0, 0.6, ties=[dd.Tie(7.4, **PLATE, compression=1e5, strain=0.01, **TIE)], **MASONRY,
                     masonry_knowledge_factor=1.0), SITE, {}),
    (["anchor_not_checked"], dd.OneSidedWall(8.0, 0.6, ties=[dd.Tie(7.4, area=1e-5, strain=2e-3, **TIE)]), SITE, {}),
    (["floor_not_given"], dd.OneSidedWall(2.0, 0.3, base_level=8.0), SITE, {}),
    (["perhaps_free", "ground_governs"],
     dd.OneSidedWall(3.0, 0.25, building=dd.Building(**HOUSE, level=0.05)), SITE, {}),
    (["period_beyond_spectrum"], dd.OneSidedWall(60.0, 6.0), SITE, {}),
    (["hinge_below_usual"], dd.TwoBlockWall(3.0, 0.25, hinge_range=(0.8, 0.9), overburden=2e4, overburden_inertia=0.0),
     SITE, {}),
    (["least_elsewhere"],
     dd.TwoBlockWall(6.4, 0.45, density=1800, overburden=2e4, overburden_inertia=0.0, eccentricity=-0.1,
                     loads=[dd.Load(12e3, depth=0.375, height=3.2, inertia="vertical")]), SITE, {}),
    (["sliding_unknown"], table_of("facade"), SITE, {}),
    (["ties_left_out"],
     dd.OneSidedWall(11.7, 0.88, density=1900.0,
                     ties=[dd.Tie(10.5, depth=0.0, area=4.5e-5, strength=2e8, strain=0.01, length=8.0)]), SITE, {}),
    (["return_period_held"], dd.OneSidedWall(6.0, 0.5),
     dd.Site(latitude=37.5, longitude=13.0, nominal_life=10, use_class="I"), {}),
]  # fmt: skip


@pytest.mark.slow
@pytest.mark.parametrize(("codes", "wall", "site", "given"), CASES, ids=[case[0][0] for case in CASES])
def test_a_note_reaches_every_reader(codes, wall, site, given, executable, root, records, tmp_path):
    check = dd.check_ntc(wall, site, **given)
    assert {note.code for note in check.notes} >= set(codes)
    study = dd.Study(records, [0.05, 0.3, 0.8, 2.0])
    catalogue = root / "data/records/synthetic44.csv"
    dd.write_case(tmp_path / "wall.nml", wall, study, catalogue=catalogue, output="wall", check=check)
    run = subprocess.run([executable, "wall.nml"], cwd=tmp_path, check=True, capture_output=True, text=True)
    stored = json.loads((tmp_path / "wall_run.json").read_text())["check_notes"]
    assert [note["code"] for note in stored] == [note.code for note in check.notes]
    results = dd.read_results(tmp_path / "wall")
    dd.report(results, tmp_path / "report.html", lang="en")
    dd.calculation_report(results, tmp_path / "relazione.html", lang="en")
    count = f"remarks on the checks: {len(check.notes)} (chapter 16)"
    assert count in text_of(tmp_path / "relazione.html")
    dd.calculation_report(results, tmp_path / "it.html", lang="it")
    italian = text_of(tmp_path / "it.html")
    for note in check.notes:
        sentence = warning(Language("it"), note)
        assert sentence[:40] in italian, note.code
        assert sentence[-25:] in italian, note.code
    documents = [run.stdout, text_of(tmp_path / "report.html"), text_of(tmp_path / "relazione.html")]
    documents = [" ".join(text.split()) for text in documents]
    for note, other in zip(check.notes, stored, strict=True):
        sentence = str(note)
        assert other["sentence"] == sentence
        for place, text in zip(("console", "report", "calculation report"), documents, strict=True):
            # Documents write some symbols of a sentence in another way: its beginning and its end are enough.
            assert sentence[:40] in text, (place, note.code)
            assert sentence[-25:] in text, (place, note.code)
