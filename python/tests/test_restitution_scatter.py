"""A speed ratio that varies from impact to impact: its distribution, its energy, and the same draws by every route."""

import csv
import json
import subprocess
from dataclasses import replace

import numpy as np
import pytest
from scipy import stats

import dondolo as dd
from dondolo.results import Certified

STILL = dd.Record(np.zeros(2), 0.01, name="still")
LEVELS = [0.3, 0.6, 0.9]
RK45 = dd.Solver(engine="rk45")
WALLS = {
    "one_sided": (dd.OneSidedWall(3.0, 0.25, name="facade"), 0.05),
    "free_standing": (dd.FreeStandingWall(2.0, 0.3, name="block"), 0.01),
    "two_block": (dd.TwoBlockWall(3.0, 0.25, hinge=0.5, name="strip"), 0.02),
    "tied": (dd.OneSidedWall(6.0, 0.5, ties=[dd.Tie(5.5, area=4e-5, length=6.0)], name="tied"), 0.05),
}


@pytest.fixture(params=WALLS)
def varying(request):
    """A wall without and with scatter."""
    wall, sd = WALLS[request.param]
    return wall, replace(wall, restitution_sd=sd)


def ratios(motion):
    """Speed after each impact / speed before it."""
    after = np.flatnonzero(motion.after_impact)
    return np.abs(motion.velocity[after] / motion.velocity[after - 1])


def stripes_of(wall, records, **more):
    return dd.multiple_stripe(wall, records, LEVELS, progress=False, **more)


def test_without_scatter_nothing_changes(varying, few):
    """A standard deviation of 0 has the results of a wall without one, to the bit, by both engines."""
    wall, _ = varying
    none = replace(wall, restitution_sd=0.0)
    assert none.restitution_seed == 1
    for solver in (dd.Solver(), RK45):
        one, other = (stripes_of(each, few, solver=solver) for each in (wall, none))
        for name in ("edp", "collapsed", "impacts", "time_of_peak"):
            assert np.array_equal(getattr(one, name), getattr(other, name))
        assert one.work == other.work
        first, second = (dd.simulate(each, few[3], 0.9, solver=solver) for each in (wall, none))
        assert np.array_equal(first.rotation, second.rotation)


def test_mean_and_standard_deviation():
    """Ratios are uniform about the model's, with the standard deviation that was asked for."""
    sd = 0.004
    wall = dd.FreeStandingWall(2.0, 0.2, restitution_sd=sd)
    mean = wall.restitution_coefficient
    assert mean == dd.FreeStandingWall(2.0, 0.2).restitution_coefficient
    start = 0.7 * wall.capacity_angle
    long = dd.Record(np.zeros(8000), 0.01)
    found = np.concatenate(
        [
            ratios(dd.simulate(wall, replace_name(long, f"test {number}"), initial_rotation=start))[:60]
            for number in range(100)
        ]
    )
    count = len(found)
    assert count == 6000
    assert np.abs(found - mean).max() <= np.sqrt(3.0) * sd * (1.0 + 1e-9)
    assert np.mean(found) == pytest.approx(mean, abs=3.0 * sd / np.sqrt(count))
    assert np.std(found) == pytest.approx(sd, rel=3.0 * np.sqrt(0.2 / count))
    half = np.sqrt(3.0) * sd
    assert stats.kstest(found, stats.uniform(mean - half, 2.0 * half).cdf).pvalue > 0.01
    # One impact says nothing of the next, nor a record of another
    each = found.reshape(100, 60) - mean
    assert abs(np.corrcoef(each[:, :-1].ravel(), each[:, 1:].ravel())[0, 1]) < 4.0 / np.sqrt(count)
    assert abs(np.corrcoef(each[:-1].ravel(), each[1:].ravel())[0, 1]) < 4.0 / np.sqrt(count)


def replace_name(record, name):
    """The same record by another name."""
    return dd.Record(record.acceleration, record.dt, name)


def test_energy_of_free_rocking():
    """Heights between impacts follow from the energy that the drawn ratios leave."""
    wall = dd.FreeStandingWall(2.0, 0.4, restitution_sd=0.02, restitution_seed=7)
    alpha, q = wall.capacity_angle, 0.8 * wall.capacity_angle
    tight = dd.Solver(rtol=1e-12, atol=1e-14)
    motion = dd.simulate(wall, STILL, initial_rotation=q, solver=tight)
    drawn, ends = ratios(motion), np.flatnonzero(motion.after_impact)
    assert np.ptp(drawn[:8]) > 0.02
    energy = np.cos(alpha - q) - np.cos(alpha)
    for number in range(8):
        speed = wall.frequency_parameter * np.sqrt(2.0 * energy)
        assert abs(motion.velocity[ends[number] - 1]) == pytest.approx(speed, rel=1e-8)
        energy *= drawn[number] ** 2


def test_draws_belong_to_seed_record_polarity_and_impact(few):
    """Not to the level, the wall, its name, the other records, or the initial state."""
    wall = dd.OneSidedWall(3.0, 0.25, restitution_sd=0.02)
    record = few[2]

    def draws(wall, record, scale=1.0, **more):
        motion = dd.simulate(wall, record, scale, **more)
        return ((ratios(motion) - wall.restitution_coefficient) / wall.restitution_sd)[:5]

    own = draws(wall, record)
    assert len(own) == 5
    same = [
        draws(wall, record, 1.1),
        draws(replace(wall, name="other"), record),
        draws(dd.FreeStandingWall(2.0, 0.3, restitution_sd=0.003), record),
        draws(wall, record, 0.0, initial_rotation=0.5 * wall.capacity_angle),
        draws(wall, replace_name(few[4], record.name), 1.0),
    ]
    for other in same:
        assert other == pytest.approx(own[: len(other)], abs=1e-6)
    different = [
        draws(replace(wall, restitution_seed=2), record),
        draws(wall, replace_name(record, "another"), 1.0),
        draws(wall, record, -1.0),
    ]
    for other in different:
        assert np.all(np.abs(other - own[: len(other)]) > 1e-3)


def test_a_mirrored_record_mirrors_a_two_sided_wall(few):
    wall = dd.FreeStandingWall(2.0, 0.3, restitution_sd=0.01)
    there, back = (dd.simulate(wall, few[1], sign * 0.8) for sign in (1.0, -1.0))
    assert np.array_equal(there.rotation, -back.rotation)


def test_the_same_by_threads_parts_and_single_motions(varying, few):
    _, wall = varying
    whole = stripes_of(wall, few, polarity="both", threads=1)
    assert np.array_equal(whole.edp, stripes_of(wall, few, polarity="both", threads=4).edp)
    assert np.array_equal(whole[:, 2:].edp, stripes_of(wall, few[2:], polarity="both").edp)
    assert not np.array_equal(whole.edp, stripes_of(replace(wall, restitution_seed=5), few, polarity="both").edp)
    level, history = 1, 3
    motion = dd.simulate(wall, few[3], whole.scale[level, history])
    assert (motion.edp, motion.impacts) == (whole.edp[level, history], whole.impacts[level, history])
    assert np.all(np.abs(ratios(motion) - wall.restitution_coefficient) <= 1.7321 * wall.restitution_sd)


def test_the_executable_has_the_same_motions(root, executable, tmp_path):
    """A wall, the same as a row of a population, and a history: files, `run_case` and objects."""
    catalogue = root / "data/records/synthetic44.csv"
    wall = dd.TwoBlockWall(3.0, 0.25, hinge=0.5, restitution_sd=0.02, restitution_seed=4, name="strip")
    columns = "mechanism = 'two_block', height = 3.0, thickness = 0.25, hinge = 0.5"
    columns += ", restitution_sd = 0.02, restitution_seed = 4"
    (tmp_path / "walls.csv").write_text(
        "name,mechanism,height,thickness,hinge,restitution_sd,restitution_seed\nstrip,two_block,3.0,0.25,0.5,0.02,4\n"
        "plain,two_block,3.0,0.25,0.5,,\n"
    )
    common = f"&records catalogue = '{catalogue}' /\n&stripes im = 'pga', levels = 0.3, 0.6, 0.9 /\n"
    cases = {
        "stripes": f"&wall name = 'strip', {columns} /\n" + common,
        "typology": "&population file = 'walls.csv' /\n" + common,
        "history": f"&wall name = 'strip', {columns} /\n&records catalogue = '{catalogue}' /\n"
        "&history record = 5, scale = 3.0 /\n",
    }
    for task, text in cases.items():
        (tmp_path / f"{task}.nml").write_text(f"&job task = '{task}', output = 'out/{task}' /\n{text}")
        done = subprocess.run([executable, f"{task}.nml"], cwd=tmp_path, capture_output=True, text=True, check=False)
        assert done.returncode == 0, done.stderr
    records = dd.read_catalogue(catalogue)
    expected = stripes_of(wall, records)
    read = dd.read_results(tmp_path / "out/stripes")
    assert np.array_equal(read.stripes.edp, expected.edp)
    assert read.population.walls[0] == wall
    assert np.array_equal(dd.run_case(tmp_path / "stripes.nml", progress=False).stripes.edp, expected.edp)
    lines = (tmp_path / "out/typology_walls.csv").read_text().splitlines()
    rows = list(csv.DictReader(line for line in lines if line[0] != "#"))
    assert [row["restitution_sd"] for row in rows] == ["2.0000000000000000E-02", ""]
    assert [row["restitution_seed"] for row in rows] == ["4.0000000000000000E+00", ""]
    counts = dd.read_results(tmp_path / "out/typology").typology.exceedances[-1].T
    plain = stripes_of(dd.TwoBlockWall(3.0, 0.25, hinge=0.5), records)
    assert counts.tolist() == [expected.collapses.tolist(), plain.collapses.tolist()]
    motion = dd.simulate(wall, records[4], 3.0)
    assert np.array_equal(dd.read_results(tmp_path / "out/history").response.rotation, motion.rotation)
    run = json.loads((tmp_path / "out/stripes_run.json").read_text())
    assert run["settings"]["wall"]["restitution_sd"] == 0.02
    assert run["engine"].startswith("lanes")


def test_certified_motions_have_the_same_draws(few):
    """In 33 digits the same ratios are drawn: a history that is run again comes nearer to one with tight tolerances."""
    wall = dd.FreeStandingWall(2.0, 0.3, restitution_sd=0.01, restitution_seed=23)
    options = {"levels": [0.9], "progress": False}
    once, certified, exact = (
        dd.multiple_stripe(wall, few[3:4], **options, **more)
        for more in ({"solver": RK45}, {"solver": RK45, "certify": True}, {"solver": dd.Solver(rtol=1e-12, atol=1e-14)})
    )
    assert certified.status.tolist() == [[Certified.QUADRUPLE]]
    assert not certified.collapsed.any()
    assert abs(once.edp - exact.edp) > 1e-7
    assert certified.edp == pytest.approx(exact.edp, abs=1e-8)


@pytest.mark.parametrize(
    ("given", "sentence"),
    [
        ({"restitution_sd": -0.01}, "restitution_sd = -0.01: must be at least 0 and less than 0.5"),
        ({"restitution_sd": 0.05}, "restitution_sd = 0.05: must be at most 0.01905.* so that all values"),
        (
            {"restitution_value": 0.02, "restitution_sd": 0.02},
            "must be at most 0.0115.* about 0.02 lie between 0 and 1",
        ),
        ({"restitution_value": 0.0, "restitution_sd": 0.001}, "must be at most 0, so that all values"),
        ({"restitution_seed": 3}, "restitution_seed: only with restitution_sd"),
        ({"restitution_sd": 0.01, "restitution_seed": 0}, "restitution_seed = 0: must lie between 1 and 1e6"),
        ({"restitution_sd": 0.01, "restitution_seed": 1.5}, "restitution_seed = 1.5: must be an integer"),
    ],
)
def test_what_cannot_be(given, sentence):
    with pytest.raises(dd.errors.InputError, match=sentence):
        dd.FreeStandingWall(2.0, 0.3, **given)


def test_both_engines_agree(varying, few):
    """Every impact has the same ratio by either: so have outcomes, counts of impacts and EDPs, but for rounding."""
    plain, wall = varying
    levels = [0.2, 0.4, 0.6, 0.8, 1.0, 1.2]

    def both(wall):
        options = {"polarity": "both", "progress": False}
        return tuple(
            dd.multiple_stripe(wall, few, levels, solver=dd.Solver(engine=engine, rtol=1e-9, atol=1e-11), **options)
            for engine in ("lanes", "rk45")
        )

    lanes, rk45 = both(wall)
    assert lanes.work.evaluations == lanes.work.steps
    assert rk45.work.evaluations > rk45.work.steps
    assert np.array_equal(lanes.collapsed, rk45.collapsed)
    assert np.count_nonzero(lanes.impacts != rk45.impacts) <= 0.02 * lanes.edp.size
    assert np.count_nonzero(np.abs(lanes.edp - rk45.edp) > 1e-6) <= 0.02 * lanes.edp.size
    without, _ = both(plain)
    assert np.count_nonzero(np.abs(lanes.edp - without.edp) > 1e-3) > 0.1 * lanes.edp.size


def test_the_ratio_of_an_impact_is_the_same_by_both_engines(few):
    """In a motion by lanes too, with the impact after the record, which decides of how far a wall swings then."""
    wall = dd.FreeStandingWall(2.0, 0.3, restitution_sd=0.01, restitution_seed=3)
    for record in few[:4]:
        scale = 3.0 * wall.trigger_acceleration / record.peak_acceleration
        drawn = [
            ratios(dd.simulate(wall, record, scale, solver=dd.Solver(engine=engine))) for engine in ("lanes", "rk45")
        ]
        count = min(map(len, drawn))
        assert count > 3
        assert drawn[0][:count] == pytest.approx(drawn[1][:count], abs=1e-6)
    # A pulse that ends while the wall is away from its base: the only impacts come afterwards
    strong = 1.3 * wall.trigger_acceleration
    for name in "abcdef":
        pulse = dd.Record(np.concatenate([np.zeros(3), np.full(40, strong), np.full(38, -0.9 * strong)]), 0.01, name)
        lanes, rk45 = (
            dd.multiple_stripe(wall, [pulse], [strong / wall.gravity], solver=dd.Solver(engine=engine), progress=False)
            for engine in ("lanes", "rk45")
        )
        assert lanes.edp == pytest.approx(rk45.edp, abs=1e-7)
        assert lanes.impacts.tolist() == rk45.impacts.tolist()


def test_saved_and_written(tmp_path, few):
    wall = dd.OneSidedWall(3.0, 0.25, restitution_sd=0.02, restitution_seed=9)
    stripes = stripes_of(wall, few)
    stripes.save(tmp_path / "stripes.npz")
    assert dd.load(tmp_path / "stripes.npz").wall == wall
    stripes.write_results(tmp_path / "stripes")
    assert dd.read_results(tmp_path / "stripes").stripes.wall == wall
    dd.Population([wall]).to_csv(tmp_path / "walls.csv")
    assert dd.Population.from_csv(tmp_path / "walls.csv").walls[0] == wall
    dd.report(stripes, tmp_path / "report.html")
    page = (tmp_path / "report.html").read_text()
    assert "restitution sd" in page
