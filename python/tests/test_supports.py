"""Walls between moving supports: what they feel, by every route, and the medians of the full two-support models."""

import os
from pathlib import Path

import numpy as np
import pytest

import dondolo as dd

RECORDS = os.environ.get("DONDOLO_RECORDS")


def house(level: float, **more: object) -> dd.Building:
    """A house of three storeys and 9 m."""
    return dd.Building(0.3, storeys=3, level=level, building_height=9.0, **more)


def strip(building: dd.Building | None) -> dd.TwoBlockWall:
    """A strip of an upper storey."""
    return dd.TwoBlockWall(
        3.0, 0.25, hinge=0.6, overburden=5e3, overburden_inertia=0.0, restitution_factor=0.87, building=building
    )


def facade(building: dd.Building | None) -> dd.OneSidedWall:
    """A facade as tall as the house."""
    return dd.OneSidedWall(9.0, 0.5, building=building)


def test_share_and_tilt():
    wall = dd.TwoBlockWall(3.0, 0.25, hinge=0.6, building=house(6.0))
    assert wall.support_share == pytest.approx(0.544907407407407, rel=1e-12)
    assert wall.support_tilt == pytest.approx(3.175381944444444, rel=1e-12)
    assert facade(house(0.0)).support_share == pytest.approx(6.018518518518519 / 9.0, rel=1e-12)
    assert facade(None).support_share == facade(None).support_tilt == 0.0
    assert facade(house(0.0, level_top=0.0)).support_share == 0.0
    assert dd.FreeStandingWall(1.0, 0.3, building=house(9.0)).support_share == 0.0


@pytest.mark.parametrize("engine", ["rk45", "lanes"])
@pytest.mark.parametrize("wall", [strip, facade], ids=["strip", "facade"])
@pytest.mark.parametrize("more", [{}, {"diaphragm_period": 0.4}], ids=["rigid", "diaphragm"])
def test_a_wall_on_a_building_is_a_wall_under_what_it_feels(engine, wall, more):
    if more and wall is facade:
        pytest.skip("a facade leans on transverse walls")
    level = 6.0 if wall is strip else 0.0
    on_building = wall(house(level, **more))
    for record in dd.example_records()[:3]:
        for scale in (1.0, -2.0):
            one = dd.simulate(on_building, record, scale=scale, solver=dd.Solver(engine=engine), history=False)
            other = dd.simulate(
                wall(None), record.under(on_building), scale=scale, solver=dd.Solver(engine=engine), history=False
            )
            assert (one.edp, one.collapsed, one.impacts) == (other.edp, other.collapsed, other.impacts)


def test_motions_of_the_supports():
    record = dd.example_records()[0]
    wall = strip(house(6.0))
    base, top, felt = (record.under(wall, at=place) for place in ("base", "top", "felt"))
    floor = record.on_floor(dd.Building(0.3, participation=6 / 7, refine=round(record.dt / base.dt)))
    assert base.acceleration == pytest.approx(floor.acceleration, abs=1e-12)
    roof = record.on_floor(dd.Building(0.3, participation=9 / 7, refine=round(record.dt / base.dt)))
    assert top.acceleration == pytest.approx(roof.acceleration, abs=1e-12)
    # What is left is the tilt times the relative displacement: its second differences are the relative acceleration
    mixed = base.acceleration + wall.support_share * (top.acceleration - base.acceleration)
    drift = (mixed - felt.acceleration) / wall.support_tilt
    relative = (top.acceleration - base.acceleration)[1:-1]
    # Of the record itself: behind it the ground stops at once
    inside = slice(0, (len(record.acceleration) - 2) * round(record.dt / base.dt))
    differences = np.diff(drift, 2)[inside] / base.dt**2
    assert differences == pytest.approx(relative[inside], abs=0.02 * np.abs(relative).max())


def test_a_cut_facade_keeps_its_top():
    whole = dd.OneSidedWall(
        sections=[dd.Section(4.0, 0.6), dd.Section(3.5, 0.45), dd.Section(3.0, 0.3)], building=house(0.0)
    )
    parts = dd.Population.of_facade(whole, hinge_level=[0.0, 4.0]).walls
    assert [part.building.level for part in parts] == [0.0, 4.0]
    above = dd.OneSidedWall(sections=[dd.Section(3.5, 0.45), dd.Section(3.0, 0.3)], building=house(4.0))
    # The building ends at 9 m: the upper part leans on 5 m of it
    assert parts[1].support_share == pytest.approx(above.support_share, rel=1e-12)
    assert parts[0].support_share == whole.support_share
    held = dd.OneSidedWall(
        sections=[dd.Section(4.0, 0.6), dd.Section(3.5, 0.45), dd.Section(3.0, 0.3)], building=house(0.0, level_top=0.0)
    )
    assert [part.support_share for part in dd.Population.of_facade(held, hinge_level=[0.0, 4.0]).walls] == [0.0, 0.0]


def test_tables_name_what_walls_feel():
    frame = strip(house(6.0)).to_frame()
    assert frame["support_share"][0] == strip(house(6.0)).support_share
    assert frame["support_tilt_1_s2"][0] == strip(house(6.0)).support_tilt
    assert "support_share" not in strip(None).to_frame()


def test_drifts_are_counted():
    records = dd.example_records()[:4]
    soft = dd.multiple_stripe(strip(house(6.0, diaphragm_period=0.8)), records, [0.3, 0.6], progress=False)
    rigid = dd.multiple_stripe(strip(house(6.0)), records, [0.01], progress=False)
    assert soft.work.drifted > 0
    assert rigid.work.drifted == 0
    with pytest.raises(dd.errors.InputError, match="wall: must be a wall with a building"):
        records[0].under(strip(None))
    with pytest.raises(dd.errors.InputError, match="at = 'roof': must be one of"):
        records[0].under(strip(house(6.0)), at="roof")


NOTES = {
    "one floor": ("participation = 1.1", ["both supports", "give participation_top", "to the building"]),
    "two supports": ("participation = 0.1, participation_top = 1.3", ["both supports", "to the building"]),
    "held by nothing": (
        "storeys = 3, level = 0.0, level_top = 0.0, building_height = 8.0",
        ["moves the base of the wall", "what the base of the wall stands on"],
    ),
}


@pytest.mark.parametrize(("building", "words"), NOTES.values(), ids=NOTES)
def test_python_and_the_executable_give_the_same_notes(building, words, run, tmp_path):
    case = tmp_path / "case.nml"
    case.write_text(
        f"""&job task = 'stripes', output = 'case' /
&wall mechanism = 'one_sided', height = 8.0, thickness = 0.45, tie_height = 7.0, tie_area = 6e-5, tie_length = 7.5 /
&building period = 0.35, {building} /
&records catalogue = '{Path(__file__).parents[2] / "data/records/synthetic44.csv"}' /
&stripes levels = 0.1, 0.3, 0.9 /
"""
    )
    stripes = dd.run_case(case, progress=False).stripes
    notes = [text for name, text in stripes._facts() if name == "note"]
    assert len(notes) - len(words) == (stripes.work.drifted > 0)
    assert all(word in note for word, note in zip(words, notes, strict=False))
    printed = [line.removeprefix("note: ") for line in run(case).stdout.splitlines() if line.startswith("note: ")]
    assert printed == notes
    motion = dd.simulate(stripes.wall, dd.example_records()[0], history=False)
    assert [text for name, text in motion._facts() if name == "note"] == notes[: len(words)]


def test_notes_count_the_walls_of_a_population():
    leaning = dd.OneSidedWall(8.0, 0.45, building=dd.Building(0.3, participation=1.1))
    found = dd.typology(
        dd.Population((leaning, facade(house(0.0)), facade(None))), dd.example_records()[:3], [0.3, 0.6], progress=False
    )
    notes = [text for name, text in found._facts() if name == "note"]
    assert "linear buildings move the walls on them" in notes[0]
    assert notes[1].startswith("both ends of 1 wall move with one floor; give participation_top")
    assert len(notes) == 2 + (found.work.drifted > 0)


def test_the_share_of_histories_that_drift_apart_is_said():
    stripes = dd.multiple_stripe(
        strip(house(6.0, diaphragm_period=0.8)), dd.example_records()[:4], [0.3, 0.6], progress=False
    )
    drifted, histories = stripes.work.drifted, stripes.work.histories
    note = dict(stripes._facts())["note"]
    assert (
        f"by more than 0.2 of the capacity rotation in {100 * drifted / histories:.1f} %, {drifted} of {histories}"
        in note
    )


def tied(building: dd.Building | None) -> dd.OneSidedWall:
    """The facade with a tie, which the building holds."""
    return dd.OneSidedWall(9.0, 0.5, ties=[dd.Tie(8.5, area=5e-5, length=8.0, preload=3e7)], building=building)


@pytest.mark.parametrize(
    ("wall", "levels"),
    [(strip, np.geomspace(0.2, 1.2, 8)), (facade, [0.2, 0.35, 0.6, 1.0]), (tied, [0.25, 0.45, 0.7, 1.1])],
    ids=["strip", "facade", "facade with a tie"],
)
def test_engines_agree_on_buildings(wall, levels):
    """Lanes and Runge-Kutta steps in 352 histories: flags, and EDPs where neither is ill-conditioned."""
    records = dd.read_catalogue(Path(__file__).resolve().parents[2] / "data/records/synthetic44.csv")
    on_building = wall(house(6.0, diaphragm_period=0.4) if wall is strip else house(0.0))
    lanes, rk45 = (
        dd.multiple_stripe(
            on_building,
            records,
            levels,
            polarity="both",
            estimate_error=True,
            progress=False,
            solver=dd.Solver(engine=engine, rtol=1e-11, atol=1e-13),
        )
        for engine in ("lanes", "rk45")
    )
    assert lanes.edp.size == 352
    sure = np.maximum(lanes.edp_error, rk45.edp_error) < 1e-8
    assert sure.mean() > 0.9
    assert 0.2 < lanes.collapsed.mean() < 0.9
    assert np.array_equal(lanes.collapsed[sure], rk45.collapsed[sure])
    assert np.abs(lanes.edp - rk45.edp)[sure].max() < 1e-6
    assert np.array_equal(lanes.work.drifted, rk45.work.drifted)


# Medians of the full two-support Lagrangian and of the unilateral facade, by an independent program
FULL = [
    (strip, 6.0, {}, 0.552),
    (strip, 3.0, {}, 0.659),
    (strip, 0.0, {}, 0.830),
    (strip, 6.0, {"diaphragm_period": 0.2, "diaphragm_participation": 1.3}, 0.432),
    (strip, 6.0, {"diaphragm_period": 0.4, "diaphragm_participation": 1.3}, 0.310),
    (strip, 6.0, {"diaphragm_period": 0.8, "diaphragm_participation": 1.3}, 0.489),
    (facade, 0.0, {}, 0.319),
]


@pytest.mark.skipif(RECORDS is None, reason="DONDOLO_RECORDS is not set")
@pytest.mark.parametrize(("wall", "level", "more", "theta"), FULL)
def test_medians_of_the_full_models(wall, level, more, theta):
    records = dd.read_catalogue(Path(RECORDS or "") / "italy44.csv")
    levels = np.r_[np.arange(0.05, 0.6, 0.05), np.arange(0.6, 2.01, 0.1)]
    stripes = dd.multiple_stripe(wall(house(level, **more)), records, levels, polarity="both", progress=False)
    assert stripes.fit().theta == pytest.approx(theta, rel=0.05)


def test_the_building_may_be_uncertain():
    """Period and damping of the building are sources: every variant moves with its own, to the bit."""
    wall = facade(house(0.0))
    records, levels = dd.example_records()[::4], np.arange(0.1, 1.01, 0.1)
    sources = {
        "period": dd.distributions.Uniform(0.3, 0.45),
        "damping": dd.distributions.Uniform(0.05, 0.15),
        "level_top": dd.distributions.Uniform(6.0, 9.0),
    }
    found = dd.propagate_uncertainty(wall, records, levels, sources=sources, n_variants=30, progress=False)
    variants = found.typology.walls
    assert len({variant.building.period for variant in variants[:30]}) == 30
    assert len({variant.support_share for variant in variants[:30]}) == 30
    for number in (0, 17, 29):
        house_of_variant = variants[number].building
        alone = facade(
            dd.Building(
                house_of_variant.period,
                damping=house_of_variant.damping,
                storeys=3,
                level=0.0,
                building_height=9.0,
                level_top=house_of_variant.level_top,
            )
        )
        stripes = dd.multiple_stripe(alone, records, levels, progress=False)
        assert np.array_equal(stripes.collapses, found.typology.exceedances[-1, :, number])
    with pytest.raises(dd.errors.InputError, match="'period': must be one of height"):
        dd.propagate_uncertainty(
            facade(None), records, levels, sources={"period": dd.distributions.Uniform(0.3, 0.45)}, n_variants=8
        )


def test_a_cracked_building_pushes_less():
    """The longer period and the heavier damping of the cracked state, under the embedded records."""
    levels = np.arange(0.05, 1.46, 0.05)
    thetas = {}
    for name, building in {
        "intact": house(0.0),
        "cracked": dd.Building(0.45, damping=0.15, storeys=3, level=0.0, building_height=9.0),
        "at rest": None,
    }.items():
        stripes = dd.multiple_stripe(facade(building), dd.example_records(), levels, polarity="both", progress=False)
        thetas[name] = stripes.fit().theta
    assert thetas == pytest.approx({"intact": 0.3348, "cracked": 0.4182, "at rest": 0.6677}, rel=2e-3)


def test_an_uncertain_building_in_a_case(run, tmp_path):
    """The executable and Python make the same of sources that are properties of the building."""
    (tmp_path / "case.nml").write_text(
        f"""&job task = 'typology', output = 'case' /
&wall name = 'front', mechanism = 'one_sided', height = 9.0, thickness = 0.5 /
&building period = 0.3, storeys = 3, level = 0.0, building_height = 9.0 /
&uncertainty period = 'uniform(0.30, 0.45)', damping = 'uniform(0.05, 0.15)', variants = 24 /
&records catalogue = '{Path(__file__).parents[2] / "data/records/synthetic44.csv"}' /
&stripes first = 0.1, last = 1.0, count = 10 /
"""
    )
    done = run("case.nml")
    assert done.returncode == 0, done.stderr
    found = dd.read_results(tmp_path / "case").typology
    ends = {wall.name: wall for wall in found.walls}
    for what, low, high in (("period", 0.3075, 0.4425), ("damping", 0.055, 0.145)):
        values = [np.ravel(getattr(ends[f"front, {what} at {end}%"].building, what))[0] for end in (5, 95)]
        assert values == pytest.approx([low, high], rel=1e-12)
    row = next(i for i, wall in enumerate(found.walls) if wall.name == "front, period at 95%")
    alone = dd.multiple_stripe(found.walls[row], dd.example_records(), found.levels, progress=False)
    assert np.array_equal(alone.collapses, found.exceedances[-1, :, row])


def test_an_ordinary_facade_is_drawn(records, tmp_path):
    """Three storeys, three ties with plates, a building: what moves it has a name that a record may have."""
    wall = dd.OneSidedWall(
        sections=[dd.Section(3.2, 0.55), dd.Section(3.1, 0.45), dd.Section(2.9, 0.4)],
        loads=[dd.Load(9e3, height=z, depth=0.15, inertia="both") for z in (3.2, 6.3)],
        ties=[
            dd.Tie(height=z, bar=0.02, spacing=2.5, length=9.0, plate_width=0.3, plate_height=0.3, plate_thickness=0.02)
            for z in (3.0, 6.1, 8.9)
        ],
        masonry_compression=2e6,
        masonry_shear=4e4,
        masonry_tension=5e4,
        building=dd.Building(0.35, storeys=3, level=0.0, level_top=9.2, building_height=9.2),
        name="prospetto sud",
    )
    assert len(repr(wall)) > 1000
    felt = records[0].under(wall)
    assert felt.processing[-1] == "felt by wall 'prospetto sud'"
    dd.simulate(wall, records[0], 1.5).plot().figure.savefig(tmp_path / "motion.png")


def test_texts_made_of_long_names_are_shortened(records):
    """Names of 1000 bytes are names; what is made of them is cut in its middle, and says which records it is of."""
    wall = dd.OneSidedWall(3.0, 0.25, name="é" * 500, building=house(6.0))
    one, other = (
        dd.Record(records[k].acceleration[:400], records[k].dt, 999 * word + "!") for k, word in enumerate("ab")
    )
    several = dd.Building(
        [0.3 + 0.003 * i for i in range(60)], damping=0.05, participation=[1.0 / (i + 1.7) for i in range(60)]
    )
    turned = one.rotate(other, 33.0)
    for text in (*one.under(wall).processing, turned.name, *turned.processing, *one.on_floor(several).processing):
        assert len(text.encode()) <= 1000
        assert " ... " in text
    assert turned.name.endswith("! at 33 degrees")
    assert turned.processing[0].startswith("component at 33 degrees from 'a")
