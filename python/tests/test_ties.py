"""Ties of walls: statics and histories against values computed elsewhere, tables, populations, refusals."""

import json
import re
from dataclasses import replace

import matplotlib
import numpy as np
import pytest

import dondolo as dd
from dondolo.reporting.ties import ties as told

matplotlib.use("Agg")

TIE = dd.Tie(8.5, area=5e-5, length=8.0, preload=3e7)
SHAKING = np.array([0.0, -3.5, -3.5, -3.5, -1.0, 2.0, 2.0, 0.0, 0.0, 0.0, 0.0, 0.0])


@pytest.fixture(scope="module")
def facade():
    return dd.OneSidedWall(9.0, 0.5, ties=[TIE], name="facade")


@pytest.fixture(scope="module")
def record():
    return dd.Record(SHAKING, 0.1, name="shaking")


def test_statics(facade):
    g = facade.gravity
    assert facade.trigger_acceleration / g == pytest.approx(0.0912124606200946, rel=1e-12)
    assert facade.greatest_acceleration / g == pytest.approx(0.268801428900375, rel=1e-12)
    assert facade.plastic_acceleration / g == pytest.approx(0.26949698594279, rel=1e-12)
    bare = dd.OneSidedWall(9.0, 0.5)
    assert bare.greatest_acceleration == bare.plastic_acceleration == bare.trigger_acceleration
    assert facade.capacity_angle == pytest.approx(bare.capacity_angle, rel=1e-12)
    assert facade.frequency_parameter == pytest.approx(bare.frequency_parameter, rel=1e-12)


def test_a_history(facade, record, tmp_path):
    response = dd.simulate(facade, record)
    assert response.edp * facade.capacity_angle == pytest.approx(0.012578250461766, rel=1e-9)
    assert response.ties.plastic_elongation == pytest.approx([0.101087067012615], rel=1e-9)
    assert response.ties.energy == pytest.approx([9000.0 * 0.101087067012615], rel=1e-9)
    assert not response.ties.broken.any()
    assert response.tie_times[0, 0] == pytest.approx(0.120984878596056, rel=1e-9)
    assert np.isnan(response.tie_times[0, 1])
    assert "tie 1 stretched for good" in repr(response)
    path = tmp_path / "history.csv"
    response.to_csv(path)
    (line,) = (line for line in path.read_text().splitlines() if line.startswith("# tie 1"))
    assert "time_of_yield_s" in line
    assert "time_of_fracture_s" not in line
    response.save(tmp_path / "response.npz")
    again = dd.load(tmp_path / "response.npz")
    assert np.array_equal(again.tie_times, response.tie_times, equal_nan=True)
    assert again.ties.energy == response.ties.energy
    alone = dd.simulate(facade, record, history=False)
    assert alone.edp == response.edp
    assert alone.tie_times is None
    assert alone.ties.energy == response.ties.energy
    bare = dd.simulate(dd.OneSidedWall(9.0, 0.5), record)
    assert bare.tie_times is None
    assert bare.ties.energy.shape == (0,)


def test_stripes(record):
    wall = dd.OneSidedWall(9.0, 0.5, ties=[TIE, replace(TIE, height=4.0)])
    stripes = dd.multiple_stripe(wall, [record], [0.1, 0.3, 0.6, 1.2], polarity="both", progress=False)
    assert stripes.broken_ties.shape == (4, 2)
    for i, level in enumerate(stripes.levels):
        ends = [dd.simulate(wall, record, sign * level * 9.81 / 3.5).ties.broken for sign in (1, -1)]
        assert stripes.broken_ties[i] == pytest.approx(np.mean(ends, axis=0))
    assert stripes.broken_ties[0].max() == 0.0
    assert stripes.broken_ties[-1].min() > 0.0
    assert np.all(np.diff(stripes.broken_ties[:, 0]) >= 0.0)


def test_default_tolerances_are_enough(records):
    """rk45 at its defaults against tight tolerances: walls on ties enlarge errors, so that their steps are tighter."""
    wall = dd.OneSidedWall(
        9.0,
        0.5,
        ties=[
            dd.Tie(8.5, area=5e-05, length=8.0, preload=20000000.0),
            dd.Tie(4.5, area=5e-05, length=8.0, preload=20000000.0),
        ],
    )
    levels = [0.2, 0.5, 0.8]
    usual = dd.multiple_stripe(wall, records, levels, polarity="both", progress=False)
    tight = dd.multiple_stripe(
        wall, records, levels, polarity="both", progress=False, solver=dd.Solver(rtol=1e-13, atol=1e-15)
    )
    assert np.array_equal(usual.collapsed, tight.collapsed)
    assert np.mean(np.abs(usual.edp - tight.edp) > 1e-6) <= 0.01


def test_population(facade, record, tmp_path):
    other = dd.OneSidedWall(3.0, 0.25, name="other")
    two = dd.OneSidedWall(9.0, 0.5, ties=[replace(TIE, strain=0.02), replace(TIE, height=4.0, strain=0.1)], name="two")
    population = dd.Population([other, facade, two])
    frame = population.to_frame()
    assert list(frame["tie2_height_m"].fillna(0.0)) == [0.0, 0.0, 4.0]
    path = tmp_path / "walls.csv"
    population.to_csv(path)
    again = dd.Population.from_csv(path)
    assert again.walls[2].ties == two.ties
    assert again.walls[1].ties == (TIE,)
    curves = dd.typology(population, [record], [0.2, 0.5], progress=False)
    alone = dd.multiple_stripe(facade, [record], [0.2, 0.5], progress=False)
    assert np.array_equal(curves.curves[1].collapses, alone.collapses)


def test_broken_ties_of_populations(run, tmp_path, facade, record):
    two = dd.OneSidedWall(
        9.0, 0.5, ties=[replace(TIE, height=height, strain=0.005) for height in (8.5, 5.5)], name="two ties"
    )
    walls = [facade, dd.OneSidedWall(9.0, 0.5, name="bare"), two]
    levels = [0.2, 0.5, 0.8]
    arguments = {"polarity": "both", "progress": False}
    curves = dd.typology(walls, [record], levels, checkpoint=tmp_path / "rows", edp_thresholds=[0.2], **arguments)
    alone = [dd.multiple_stripe(wall, [record], levels, **arguments) for wall in walls]
    shares = [stripes.broken_ties for stripes in alone]
    assert [each.shape for each in curves.broken_ties] == [(3, 1), (3, 0), (3, 2)]
    assert all(np.array_equal(*both) for both in zip(curves.broken_ties, shares, strict=True))
    assert curves.broken_ties[0].max() > 0.0
    assert np.unique(curves.broken_ties[2]).size > 1
    alone = dd.typology(walls, [record], levels, **arguments)
    assert all(np.array_equal(*both) for both in zip(alone.broken_ties, shares, strict=True))
    again = dd.typology(walls, [record], levels, checkpoint=tmp_path / "rows", edp_thresholds=[0.2], **arguments)
    again.save(tmp_path / "curves.npz")
    for other in (again, dd.load(tmp_path / "curves.npz"), curves.at(0.2), curves.at(1.0)):
        assert all(np.array_equal(*both) for both in zip(other.broken_ties, shares, strict=True))
    # The executable, for each wall of a table as for the wall alone
    (tmp_path / "shaking.txt").write_text("\n".join(map(str, SHAKING)))
    (tmp_path / "records.csv").write_text("file,dt_s,units\nshaking.txt,0.1,m/s2\n")
    dd.Population(walls).to_csv(tmp_path / "walls.csv")
    rest = "&records catalogue = 'records.csv' polarity = 'both' /\n&stripes levels = 0.2, 0.5, 0.8 /\n"
    case = tmp_path / "case.nml"
    case.write_text(f"&job task = 'typology' output = '{tmp_path}/all' /\n&population file = 'walls.csv' /\n{rest}")
    run(case)
    found = [line for line in (tmp_path / "all_ties.csv").read_text().splitlines() if line[0] != "#"]
    expected = []
    ties = "tie_area = 5e-5 tie_length = 8.0 tie_preload = 3e7"
    for wall in ("'facade' tie_height = 8.5", "'two ties' tie_height = 8.5, 5.5 tie_strain = 0.005"):
        one = f"mechanism = 'one_sided' height = 9.0 thickness = 0.5 {ties} name = {wall}"
        case.write_text(f"&job task = 'stripes' output = '{tmp_path}/one' /\n&wall {one} /\n{rest}")
        run(case)
        expected += [line for line in (tmp_path / "one_ties.csv").read_text().splitlines() if line[0] != "#"][1:]
    assert found[1:] == expected
    # Python's tables, of a run and of one that was saved
    assert len(expected) == 9
    for k, one in enumerate((curves, dd.load(tmp_path / "curves.npz"))):
        one.write_results(tmp_path / f"python{k}")
        mine = (tmp_path / f"python{k}_ties.csv").read_text().splitlines()
        assert [line for line in mine if line[0] != "#"] == found
    assert list(curves.to_frame("ties")["broken"]) == [int(line.split(",")[7]) for line in expected]
    read = dd.read_results(tmp_path / "all")
    assert read.typology.to_frame("ties").equals(curves.to_frame("ties"))
    read.typology.write_results(tmp_path / "again")
    mine = (tmp_path / "again_ties.csv").read_text().splitlines()
    assert [line for line in mine if line[0] != "#"] == found
    dd.typology([walls[1]], [record], levels, progress=False).write_results(tmp_path / "bare")
    assert not (tmp_path / "bare_ties.csv").exists()
    bare = dd.read_results(tmp_path / "bare").typology
    assert [one.shape for one in bare.broken_ties] == [(len(levels), 0)]
    assert told(bare) == []
    of_run, of_files = (told(one) for one in (curves, read.typology))
    assert of_run == of_files
    assert [one.table.total for one in of_run[1:]] == [sum(one.broken.shape[1] for one in curves.ties)] * 2
    dd.report(read.typology, tmp_path / "report.html")
    assert "Share of the histories that break each tie, levels" in (tmp_path / "report.html").read_text()
    for mine, theirs in zip(read.typology.broken_ties, curves.broken_ties, strict=True):
        np.testing.assert_array_equal(mine, theirs)


def test_what_the_executable_says(run, tmp_path, facade, record):
    catalogue = tmp_path / "records.csv"
    (tmp_path / "shaking.txt").write_text("\n".join(map(str, SHAKING)))
    catalogue.write_text("file,dt_s,units\nshaking.txt,0.1,m/s2\n")
    wall = "mechanism = 'one_sided', height = 9.0, thickness = 0.5, name = 'facade', tie_height = 8.5, tie_area = 5e-5,"
    wall += " tie_length = 8.0, tie_preload = 3e7"
    case = tmp_path / "case.nml"
    case.write_text(
        f"&job task = 'stripes' output = '{tmp_path}/out' /\n&wall {wall} /\n&records catalogue = 'records.csv' /\n"
        "&stripes levels = 0.2, 0.6 /\n"
    )
    plan = run("--check", case).stdout
    assert "first motion at 0.09121 g, greatest static acceleration 0.2688 g, rigid-plastic 0.2695 g" in plan
    ran = run(case)
    assert "engine lanes" in ran.stdout
    lines = [line for line in (tmp_path / "out_ties.csv").read_text().splitlines() if not line.startswith("#")]
    assert lines[0].split(",")[3:8] == ["im_level", "tie", "histories", "yielded", "broken"]
    assert [line.split(",")[6:8] for line in lines[1:]] == [["1", "0"], ["1", "1"]]
    results = dd.read_results(tmp_path / "out")
    assert results.stripes.broken_ties.tolist() == [[0.0], [1.0]]
    (tie,) = results.stripes.wall.ties
    _on_ties, *tables = told(results.stripes)
    for one, shares in zip(tables, (["100 %", "100 %"], ["0 %", "100 %"]), strict=True):
        assert one.table.columns[0].cells == [f"facade, tie 1 at {tie.height:g} m"]
        assert [column.cells[0].text + column.cells[0].unit for column in one.table.columns[1:]] == shares
    case.write_text(
        f"&job task = 'history' output = '{tmp_path}/one' /\n&wall {wall} /\n&records catalogue = 'records.csv' /\n"
        "&history record = 1, scale = 1.0 /\n"
    )
    assert "tie 1: yields at 0.121 s, stretches by 0.1011 m for good and dissipates 909.8 J/m" in run(case).stdout
    (tie,) = json.loads((tmp_path / "one_run.json").read_text())["history"]["ties"]
    assert tie["broken"] is False
    assert "time_of_fracture_s" not in tie
    assert np.isnan(dd.read_results(tmp_path / "one").response.tie_times[0, 1])


@pytest.mark.parametrize(
    ("change", "sentence"),
    [
        ({"preload": 1.8e8}, "preload = 180000000: must be less than its strength"),
        ({"height": 0.0}, "height = 0: must be above the hinge"),
        ({"height": 9.1}, "height = 9.1: must be above the hinge, 0 m, and at most 9 m"),
        ({"depth": 0.51}, "depth = 0.51: must lie between -0.1 and 0.5 m"),
        ({"area": -1.0}, "area = -1: must lie between 0"),
        ({"strain": 1e-5}, "strain = 1e-5: must be more than 0.0008738, at which it yields"),
    ],
)
def test_refusals(change, sentence):
    with pytest.raises(dd.errors.InputError, match=re.escape(f"ties[1].{sentence}")):
        dd.OneSidedWall(9.0, 0.5, ties=[TIE, replace(TIE, **change)])


@pytest.mark.parametrize("engine", ["rk45", "lanes"])
def test_a_start_at_the_very_end_peaks_there(engine):
    """Its kinetic energy is lost in the rounding of the potential: no more time than the wall has is made of it."""
    wall = dd.OneSidedWall(3.0, 0.25, ties=[dd.Tie(2.8, area=5e-05, length=8.0)])
    for over in (1e-1, 1e-2, 1e-3, 1e-4, 1e-5):
        record = dd.Record(-wall.trigger_acceleration * np.array([0.0, 0.0, 0.5, 1.0 + over]), 0.001)
        motion = dd.simulate(wall, record, solver=dd.Solver(engine=engine))
        assert 0.003 <= motion.time_of_peak < 0.0031
        assert 0.0 < motion.edp < 1e-8


def test_engines_agree(records):
    """Taylor steps in lanes against tight Runge-Kutta steps: two integrators that share no formula of a step."""
    wall = dd.OneSidedWall(
        9.0,
        0.5,
        ties=[dd.Tie(8.5, area=5e-05, length=8.0, strain=0.02), dd.Tie(4.5, area=5e-05, length=8.0, strain=0.1)],
    )
    levels = [0.3, 0.6, 0.9]
    runs = [
        dd.multiple_stripe(wall, records, levels, polarity="both", progress=False, solver=solver)
        for solver in (dd.Solver(engine="lanes"), dd.Solver(engine="rk45", rtol=1e-13, atol=1e-15))
    ]
    assert np.array_equal(runs[0].collapsed, runs[1].collapsed)
    assert np.mean(np.abs(runs[0].edp - runs[1].edp) > 1e-6) <= 0.01
    assert np.array_equal(runs[0].broken_ties, runs[1].broken_ties)


def test_drawing(facade):
    axes = facade.plot()
    assert any("tie 0.5" in text.get_text() for text in axes.texts)
