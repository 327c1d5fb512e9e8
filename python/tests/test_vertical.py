"""Vertical ground motion: an independent integration, both engines, records that carry it, results that say so."""

import os
import subprocess
import warnings
from pathlib import Path

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import dondolo as dd

ITALY = Path(os.environ.get("DONDOLO_RECORDS", "")) / "italy"
LEVELS = [0.2, 0.5, 0.8, 1.1]


@pytest.fixture(scope="module")
def records():
    horizontal = dd.synthetic_records(magnitude=6.0, distance=15.0, site="rock", n_records=4, seed=7)
    vertical = dd.synthetic_records(magnitude=6.0, distance=15.0, site="rock", n_records=4, seed=8)
    length = min(len(record) for record in (*horizontal, *vertical))
    return [
        dd.Record(one.acceleration[:length], one.dt, one.name, vertical=0.8 * two.acceleration[:length])
        for one, two in zip(horizontal, vertical, strict=True)
    ]


@pytest.fixture(scope="module")
def recorded():
    """Recorded motions with their vertical components."""
    if not ITALY.is_dir():
        pytest.skip("DONDOLO_RECORDS is not set")
    found = []
    for path in sorted(ITALY.glob("*_UD.acc"))[::3]:
        vertical = dd.read_record(path, dt=0.005, units="m/s2")
        for name in ("NS", "WE", "EW"):
            other = path.with_name(path.name.replace("_UD", f"_{name}"))
            if other.exists():
                found.append(dd.read_record(other, dt=0.005, units="m/s2").with_vertical(vertical))
    return found


def test_first_motion_by_scipy():
    """The way out from rest, by another integrator and the equation as the theory has it."""
    t = np.linspace(0.0, 1.0, 101)
    record = dd.Record(-1.6 * np.sin(np.pi * t) ** 2, 0.01, vertical=3.0 * np.cos(9.0 * t))
    wall = dd.OneSidedWall(3.0, 0.25)
    alpha, radius = np.arctan2(0.25, 3.0), 0.5 * np.hypot(3.0, 0.25)

    def acceleration(t, q):
        u, v = (np.interp(t, record.time, one) for one in (record.acceleration, record.vertical))
        return -0.75 / radius * ((9.81 + v) * np.sin(alpha - q) + u * np.cos(alpha - q))

    ticks = np.linspace(0.0, 1.0, 1000001)
    start = ticks[np.argmax(acceleration(ticks, 0.0) > 0.0)]
    response = dd.simulate(wall, record)
    end = np.searchsorted(response.time, 0.7)
    found = solve_ivp(
        lambda t, y: [y[1], acceleration(t, y[0])],
        (start, response.time[end]),
        [0.0, 0.0],
        rtol=1e-10,
        atol=1e-13,
        max_step=0.002,
    )
    assert response.impacts == 0 or response.time[np.argmax(response.after_impact)] > response.time[end]
    assert response.rotation[end] == pytest.approx(found.y[0, -1], rel=1e-4)
    without = dd.simulate(wall, record.with_vertical(None))
    assert abs(np.interp(response.time[end], without.time, without.rotation) / response.rotation[end] - 1.0) > 0.02


@pytest.mark.parametrize(
    "wall",
    [
        dd.OneSidedWall(3.0, 0.25),
        dd.OneSidedWall(9.0, 0.5),
        dd.FreeStandingWall(3.0, 0.25),
        dd.TwoBlockWall(3.0, 0.25, hinge=0.6),
        dd.TwoBlockWall(3.0, 0.25, hinge=0.6, overburden=8e3, overburden_inertia=1.0),
        dd.OneSidedWall(3.0, 0.25, loads=[dd.Load(10000.0, depth=0.175, height=3.0, inertia="none")]),
        dd.OneSidedWall(3.0, 0.25, loads=[dd.Load(10000.0, depth=0.175, height=3.0, inertia="vertical")]),
        dd.OneSidedWall(1.5, 0.25, building=dd.Building(0.3, participation=1.2)),
    ],
)
def test_engines_agree(recorded, wall):
    """Two engines on recorded motions: all histories but those that either of them calls ill-conditioned."""
    lanes, rk45 = (
        dd.multiple_stripe(
            wall,
            recorded,
            LEVELS,
            polarity="both",
            estimate_error=True,
            progress=False,
            solver=dd.Solver(engine=engine, rtol=1e-11, atol=1e-13),
        )
        for engine in ("lanes", "rk45")
    )
    sure = np.maximum(lanes.edp_error, rk45.edp_error) < 1e-8
    assert sure.mean() > 0.9
    assert np.array_equal(lanes.collapsed[sure], rk45.collapsed[sure])
    assert np.abs(lanes.edp - rk45.edp)[sure].max() < 1e-6
    assert lanes.collapsed.any()
    assert lanes.work.intervals == rk45.work.intervals
    assert np.array_equal(lanes.uplift, rk45.uplift)


def test_stripes(records):
    wall = dd.OneSidedWall(3.0, 0.25)
    with pytest.warns(dd.errors.DondoloWarning, match="the ground accelerates downwards by more than g in"):
        stripes = dd.multiple_stripe(wall, records, [0.2, 3.0], polarity="both", progress=False)
    still = [one.with_vertical(None) for one in records]
    bare = dd.multiple_stripe(wall, still, [0.3], polarity="both", progress=False)
    assert bare.uplift is None
    falls = np.array([-record.vertical.min() for record in records] * 2)
    assert np.array_equal(stripes.uplift, stripes.scale * falls >= 9.81)
    assert stripes.uplift.any()
    assert not stripes.uplift[0].any()
    alone = dd.simulate(wall, records[1], stripes.scale[0, 1])
    assert stripes.edp[0, 1] == pytest.approx(alone.edp, rel=1e-6)
    assert alone.edp != dd.simulate(wall, records[1].with_vertical(None), stripes.scale[0, 1]).edp
    assert stripes[:1].uplift.shape == (1, 8)
    # Stripes of other motions are not joined with them.
    with pytest.raises(dd.errors.InputError, match="only one has vertical motion"):
        stripes + bare


def test_uplift_in_tables(records, run, tmp_path):
    """Histories with uplift, one by one and of each stripe: the same in the tables of Python and of the executable."""
    rows = ["file,dt_s,units,vertical"]
    for k, record in enumerate(records):
        for name, samples in (("h", record.acceleration), ("v", record.vertical)):
            (tmp_path / f"{name}{k}.txt").write_text("\n".join(map(repr, samples.tolist())), encoding="utf-8")
        rows.append(f"h{k}.txt,{record.dt!r},m/s2,v{k}.txt")
    (tmp_path / "records.csv").write_text("\n".join(rows) + "\n", encoding="utf-8")
    case = tmp_path / "case.nml"
    text = (
        f"&job task = 'stripes' output = '{tmp_path}/VERTICAL' /\n&wall mechanism = 'one_sided' height = 3.0 "
        "thickness = 0.25 name = 'wall' /\n"
        "&records catalogue = 'records.csv' polarity = 'both' vertical = 'VERTICAL' /\n"
        "&stripes levels = 0.2, 1.0, 1.5, 3.0 edp_thresholds = 0.4, 1.0 /\n"
    )
    for vertical in ("recorded", "none"):
        case.write_text(text.replace("VERTICAL", vertical), encoding="utf-8")
        run(case)
    wall = dd.OneSidedWall(3.0, 0.25, name="wall")
    read = dd.read_catalogue(tmp_path / "records.csv", vertical="recorded")
    mine = dd.multiple_stripe(wall, read, [0.2, 1.0, 1.5, 3.0], polarity="both", progress=False)
    theirs = dd.read_results(tmp_path / "recorded").stripes
    assert np.array_equal(theirs.uplift, mine.uplift)
    assert mine.uplifts.tolist() == mine.uplift.sum(axis=1).tolist()
    assert mine.uplifts[0] == 0 < mine.uplifts[1] < mine.uplifts[-1]

    def lines(path):
        return [line for line in path.read_text(encoding="utf-8").splitlines() if line[0] != "#"]

    for table in ("histories", "stripes"):
        mine.to_csv(tmp_path / "mine.csv", table)
        found = lines(tmp_path / f"recorded_{table}.csv")
        # Python's stripes have the last state alone.
        kept = [line for line in found if table == "histories" or not line.split(",")[-2].startswith("4.0")]
        assert kept == lines(tmp_path / "mine.csv")
        assert found[0].endswith(",uplift")
        assert "uplift" not in lines(tmp_path / f"none_{table}.csv")[0]
    counts = [int(line.split(",")[-1]) for line in lines(tmp_path / "recorded_stripes.csv")[1:]]
    assert counts == 2 * mine.uplifts.tolist()
    still = dd.read_results(tmp_path / "none").stripes
    assert still.uplift is None
    assert still.uplifts is None


def test_uplift_is_no_collapse():
    """Falling ground for an instant, in a record that hardly moves the wall."""
    record = dd.Record([0.0, -0.5, 0.5, 0.0, 0.0], 0.01, vertical=[0.0, 0.0, -5.0, 0.0, 0.0])
    wall = dd.OneSidedWall(3.0, 0.25)
    assert not dd.simulate(wall, record).uplift
    with pytest.warns(
        dd.errors.DondoloWarning, match=r"downwards by more than g \(record 'record'\): it leaves the wall"
    ):
        response = dd.simulate(wall, record, 2.0)
    assert response.uplift
    assert not response.collapsed


@pytest.mark.parametrize("wall", [dd.OneSidedWall(3.0, 0.25), dd.FreeStandingWall(2.0, 0.4)])
def test_base_forces(records, wall):
    """The momentum of the centroid, by differences of its place."""
    response = dd.simulate(wall, records[0], 4.0)
    normal, shear = response.base_forces()
    mass, radius, alpha = 1800.0 * wall.height * wall.thickness, wall.radius, wall.slenderness_angle
    upwards = 4.0 * np.interp(response.time, records[0].time, records[0].vertical, right=0.0)
    q, side = np.abs(response.rotation), response.side
    x, y = -side * radius * np.sin(alpha - q), radius * np.cos(alpha - q)
    even = np.flatnonzero(np.diff(response.time) > 0.999 * records[0].dt)
    inner = [i for i in even[1:] if i - 1 in even and q[i - 1] * q[i] * q[i + 1] > 0.0]
    assert len(inner) > 100
    inner = np.array(inner)
    step = records[0].dt ** 2
    second = [(one[inner + 1] - 2.0 * one[inner] + one[inner - 1]) / step for one in (x, y)]
    scale = mass * 9.81
    # Differences see the mean over two steps of a motion whose acceleration has corners at samples.
    assert np.abs(normal[inner] - mass * (9.81 + upwards[inner] + second[1])).mean() < 0.003 * scale
    assert np.abs(shear[inner] - mass * (response.ground_acceleration[inner] + second[0])).mean() < 0.02 * scale
    # A block that only rests has its weight.
    rests = (q == 0.0) & (response.velocity == 0.0)
    assert normal[rests] == pytest.approx(mass * (9.81 + upwards[rests]), rel=1e-12)


@pytest.mark.parametrize("wall", [dd.OneSidedWall(3.0, 0.25), dd.FreeStandingWall(2.0, 0.4)])
def test_friction_demand(records, wall):
    """That of every history by its own forces; a block that only just starts needs no more than it did to start."""
    start = np.tan(wall.slenderness_angle)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", dd.errors.DondoloWarning)
        stripes = dd.multiple_stripe(wall, records[:3], [0.01, 0.3, 0.6], progress=False)
        demand = stripes.friction_demand(records[:3], progress=False)
        assert demand.shape == stripes.edp.shape
        assert (demand[0] == 0.0).all()
        for level, history in np.argwhere(stripes.edp > 0.0):
            factor = stripes.scale[level, history] * stripes.polarity[history]
            response = dd.simulate(wall, records[history % 3], factor)
            assert response.edp == stripes.edp[level, history]
            normal, shear = response.base_forces()
            moves = (response.rotation != 0.0) | (response.velocity != 0.0)
            rocking = np.max((abs(shear) / normal)[moves], initial=start)
            least = np.inf if normal[moves].min() <= 0.0 else rocking
            assert demand[level, history] == pytest.approx(least, rel=1e-12)
        just = dd.Record(np.array([0.0, -1.001, 0.0]) * start * 9.81, 0.02)
        assert dd.simulate(wall, just).friction_demand() == pytest.approx(start, rel=5e-3)
        two = dd.multiple_stripe(dd.TwoBlockWall(3.0, 0.25), records[:1], [0.8], progress=False)
    with pytest.raises(dd.errors.InputError, match="must be one rectangular block"):
        two.friction_demand(records[:1], progress=False)
    with pytest.raises(dd.errors.InputError, match="is missing"):
        stripes.friction_demand(records[1:2], progress=False)


def test_base_forces_refusals(records):
    for wall in (dd.TwoBlockWall(3.0, 0.25), dd.OneSidedWall(3.0, 0.25, hinge_depth=0.02)):
        response = dd.simulate(wall, records[0], 0.5)
        with pytest.raises(dd.errors.InputError, match="must be one rectangular block"):
            response.base_forces()
    with pytest.raises(dd.errors.DondoloError, match="no time history"):
        dd.simulate(dd.OneSidedWall(3.0, 0.25), records[0], history=False).base_forces()


def test_processing(records):
    """Both components take the same steps, and stay as long as each other."""
    record = records[0]
    filtered = record.band_pass(0.2, 20.0)
    alone = dd.Record(record.vertical, record.dt).band_pass(0.2, 20.0)
    assert np.array_equal(filtered.vertical, alone.acceleration)
    line = record.correct_baseline("linear").vertical - record.vertical
    assert np.ptp(np.diff(line)) < 1e-12
    finer = record.resample(record.dt / 2)
    assert np.array_equal(finer.vertical[::2], record.vertical)
    trimmed = record.trim()
    assert len(trimmed.vertical) == len(trimmed)
    start = np.flatnonzero(record.acceleration == trimmed.acceleration[0])[0]
    assert np.array_equal(trimmed.vertical, record.vertical[start : start + len(trimmed)])
    assert np.array_equal(record.reverse().vertical, record.vertical)
    floor = record.on_floor(dd.Building(0.3, participation=1.2))
    parts = round(record.dt / floor.dt)
    assert np.allclose(floor.vertical[::parts][: len(record)], record.vertical, rtol=0.0, atol=1e-12)
    turned = record.rotate(dd.Record(records[1].acceleration, record.dt, vertical=record.vertical), 30.0)
    assert np.array_equal(turned.vertical, record.vertical)
    assert record.rotate(records[1], 30.0).vertical is None


def test_record(records, tmp_path):
    record = records[0]
    assert not record.vertical.flags.writeable
    assert "vertical PGA" in repr(record)
    bare = record.with_vertical(None)
    assert bare.vertical is None
    assert bare.largest_fall == 0.0
    assert bare.checksum != record.checksum
    again = bare.with_vertical(dd.Record(record.vertical, record.dt), factor=-2.0)
    assert np.array_equal(again.vertical, -2.0 * record.vertical)
    with pytest.raises(dd.errors.InputError, match="vertical: has 3 samples, must have"):
        dd.Record(record.acceleration, record.dt, vertical=[1.0, 2.0, 3.0])
    with pytest.raises(dd.errors.InputError, match=r"vertical: lasts .* s, must last .* s as the record"):
        record.with_vertical(dd.Record(record.vertical, 0.5))
    with pytest.raises(dd.errors.InputError, match=r"vertical: has a time step of 0\.00\d+ s, whose ratio to 0\.005 s"):
        bare.with_vertical(dd.Record(record.vertical, record.dt * 1.0001))
    # On the samples of both, each is the function of time that it was.
    up = dd.Record(np.cos(np.arange(int(record.duration / 0.004) + 1)), 0.004)
    joined = bare.with_vertical(up, factor=-2.0)
    assert joined.dt == pytest.approx(0.001, rel=1e-12)
    assert np.array_equal(joined.acceleration[::5], record.acceleration)
    times = joined.dt * np.arange(len(joined.acceleration))
    assert joined.acceleration == pytest.approx(
        np.interp(times, record.dt * np.arange(len(record.acceleration)), record.acceleration), abs=1e-12
    )
    inside = times <= up.duration
    assert joined.vertical[inside] == pytest.approx(
        -2.0 * np.interp(times[inside], 0.004 * np.arange(len(up.acceleration)), up.acceleration), abs=1e-9
    )
    assert not joined.vertical[~inside].any()
    assert joined.peak_acceleration == record.peak_acceleration
    assert joined.processing[-1] == "samples every 0.001 s, with those of a vertical component of 0.004 s"
    with pytest.raises(dd.errors.InputError, match="vertical: must be given"):
        dd.Record(record.acceleration, record.dt, vertical=[])
    with pytest.raises(dd.errors.InputError, match="vertical: sample 2 = NaN m/s2: must be a number"):
        dd.Record([1.0, 2.0], record.dt, vertical=[1.0, np.nan])
    response = dd.simulate(dd.OneSidedWall(3.0, 0.25), record)
    response.save(tmp_path / "response.npz")
    assert np.array_equal(dd.load(tmp_path / "response.npz").record.vertical, record.vertical)


def test_catalogue(records, tmp_path):
    written = dd.RecordSet([*records[:2], records[2].with_vertical(None)])
    written[:2].to_catalogue(tmp_path / "sets.csv")
    assert all(one.vertical is None for one in dd.read_catalogue(tmp_path / "sets.csv"))
    read = dd.read_catalogue(tmp_path / "sets.csv", vertical="recorded", vertical_factor=0.5)
    assert all(np.array_equal(one.vertical, 0.5 * two.vertical) for one, two in zip(read, written, strict=False))
    written.to_catalogue(tmp_path / "some.csv")
    with pytest.raises(dd.errors.InputError, match=r"some\.csv: line 6: vertical is empty"):
        dd.read_catalogue(tmp_path / "some.csv", vertical="recorded")
    with pytest.raises(dd.errors.InputError, match="vertical = 'both'"):
        dd.read_catalogue(tmp_path / "some.csv", vertical="both")


def test_case(records, executable, tmp_path):
    """The executable and Python: the same counts, a sentence in summary and report, inputs with their checksums."""
    dd.RecordSet(records).to_catalogue(tmp_path / "records.csv")
    case = tmp_path / "case.nml"
    case.write_text(
        "&job output = 'out' /\n&wall mechanism = 'one_sided', height = 3.0, thickness = 0.25 /\n"
        "&records catalogue = 'records.csv', vertical = 'recorded', vertical_factor = 0.5 /\n"
        "&stripes levels = 0.2, 0.4, 0.6, 0.8 /\n"
    )
    done = subprocess.run([executable, case], cwd=tmp_path, check=True, capture_output=True, text=True)
    assert "vertical ground motion is applied: the recorded components" in done.stdout
    assert "scaled as their records, times 0.5\n" in done.stdout
    results = dd.read_results(tmp_path / "out")
    run = dd.run_case(case, progress=False)
    assert np.array_equal(run.stripes.edp, results.stripes.edp)
    halved = [one.with_vertical(dd.Record(one.vertical, one.dt), factor=0.5) for one in records]
    alone = dd.multiple_stripe(dd.OneSidedWall(3.0, 0.25), halved, [0.2, 0.4, 0.6, 0.8], progress=False)
    assert np.array_equal(run.stripes.edp, alone.edp)
    assert run.stripes.checksums == results.stripes.checksums == alone.checksums
    text = (tmp_path / "out_run.json").read_text()
    assert text.count('"vertical"') >= len(records)
    for shown in (results, run):
        page = _page(shown, tmp_path)
        assert "vertical motion" in page
        assert "no vertical ground motion" not in page
    bare = [one.with_vertical(None) for one in records]
    alone = dd.multiple_stripe(dd.OneSidedWall(3.0, 0.25), bare, [0.2, 0.4, 0.6, 0.8], progress=False)
    assert "no vertical ground motion" in _page(alone, tmp_path)
    population = dd.typology(dd.Population([dd.OneSidedWall(3.0, 0.25)]), records, [0.2, 0.6], progress=False)
    page = _page(population, tmp_path)
    assert "no vertical ground motion" not in page
    assert "only if the records have vertical components" in page


def _page(results, folder):
    dd.report(results, folder / "report.html")
    return (folder / "report.html").read_text()


def test_factor_alone(run, tmp_path):
    (tmp_path / "case.nml").write_text(
        "&job /\n&wall mechanism = 'one_sided', height = 3.0, thickness = 0.25 /\n"
        "&records catalogue = 'records.csv', vertical_factor = 0.5 /\n&stripes levels = 0.2 /\n"
    )
    done = run("case.nml")
    assert done.returncode != 0
    assert "vertical_factor = 0.5: only with vertical = 'recorded'" in done.stderr


def test_population(records, tmp_path):
    """Another vertical component is another study, whose checkpoint is not taken."""
    walls = dd.Population([dd.OneSidedWall(3.0, 0.25, name=str(i)) for i in range(3)])
    given = {"levels": [0.3, 0.6], "progress": False, "checkpoint": tmp_path / "part.counts"}
    curves = dd.typology(walls, records, **given)
    alone = dd.multiple_stripe(walls[0], records, [0.3, 0.6], progress=False)
    assert np.array_equal(curves.collapses[:, 0], alone.collapses)
    with pytest.raises(dd.errors.InputError, match="belongs to another study: other records"):
        dd.typology(walls, [one.with_vertical(None) for one in records], **given)
