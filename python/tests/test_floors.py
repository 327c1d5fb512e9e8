"""Walls on buildings: motions of floors against SciPy, one set of columns from population to results, refusals."""

import subprocess

import numpy as np
import pytest
from scipy import signal

import dondolo as dd

HOUSE = {"storeys": 3, "level": 9.0, "building_height": 9.0}


@pytest.fixture(scope="module")
def records():
    return dd.synthetic_records(magnitude=6.0, distance=15.0, site="rock", n_records=3, seed=7)


def by_scipy(record, period, damping, participation, parts):
    """The floor by SciPy: the transfer function from ground to floor, held linear between refined samples."""
    omega, dt = 2.0 * np.pi / period, record.dt / parts
    samples = len(record.acceleration)
    time = dt * np.arange((samples - 1) * parts + 1)
    ground = np.interp(time, record.time, record.acceleration)
    oscillator = signal.StateSpace(
        [[0.0, 1.0], [-(omega**2), -2.0 * damping * omega]],
        [[0.0], [-1.0]],
        [[-(omega**2), -2.0 * damping * omega]],
        [[-1.0]],
    )
    _, relative, _ = signal.lsim(oscillator, ground, time, interp=True)
    return ground + participation * relative


@pytest.mark.parametrize(
    ("period", "damping", "refine"), [(0.3, 0.05, 0), (0.11, 0.02, 3), (1.7, 0.15, 1), (0.004, 0.5, 1)]
)
def test_against_scipy(records, period, damping, refine):
    record = records[0]
    building = dd.Building(period, damping=damping, participation=1.3, refine=refine)
    floor = record.on_floor(building)
    parts = round(record.dt / floor.dt)
    assert parts == (refine or int(np.ceil(2.0 * np.pi * record.dt / period / np.sqrt(8e-3))))
    expected = by_scipy(record, period, damping, 1.3, parts)
    assert np.allclose(floor.acceleration[: len(expected)], expected, rtol=0.0, atol=1e-11 * np.abs(expected).max())
    left = floor.acceleration[len(expected) :]
    assert abs(len(left) * floor.dt - building.free_vibration) <= floor.dt * 1.000001
    assert floor.processing[-1].startswith("on a floor of <Building: ")


@pytest.mark.parametrize("level", [0.0, 3.0])
def test_walls_are_followed_as_long_as_their_building_vibrates(records, level):
    """A facade on the ground too, whose base does not move: the building that it leans on does."""
    house = dd.Building(0.3, damping=0.05, storeys=3, level=level, building_height=9.0)
    record, wall = records[0], dd.OneSidedWall(6.0, 0.5, building=house)
    felt = record.under(wall)
    assert house.free_vibration == pytest.approx(0.3 * np.log(1e4) / (2.0 * np.pi * 0.05), rel=1e-12)
    assert abs(felt.duration - record.duration - house.free_vibration) <= 1.000001 * felt.dt
    if level == 0.0:
        assert record.on_floor(house).duration == pytest.approx(record.duration)


def test_participation():
    assert dd.Building(0.3, **HOUSE).participations == pytest.approx((9.0 / 7.0,), rel=1e-15)
    several = dd.Building([0.3, 0.1], participation=[1.2, -0.3], damping=0.1)
    assert several.damping == (0.1, 0.1)
    assert several.participations == several.participation == (1.2, -0.3)
    assert several == dd.Building([0.3, 0.1], participation=(1.2, -0.3), damping=[0.1, 0.1])


def test_scaling_commutes(records):
    """Measures are those of the ground, and a wall on a floor is one on the ground under the motion of the floor."""
    house = dd.Building(0.25, **HOUSE)
    wall = dd.OneSidedWall(1.5, 0.25, building=house)
    stripes = dd.multiple_stripe(wall, records, levels=[0.2, 0.4], progress=False)
    bare = dd.OneSidedWall(1.5, 0.25)
    for i, record in enumerate(records):
        scale = 0.4 * 9.81 / record.peak_acceleration
        alone = dd.simulate(bare, record.on_floor(house), scale=scale)
        assert stripes.edp[1, i] == pytest.approx(alone.edp, rel=1e-5)
        assert dd.simulate(wall, record, scale=scale).edp == alone.edp
    cloud = dd.cloud(wall, records, scale=2.0)
    alone = [dd.simulate(wall, record, scale=2.0).edp for record in records]
    assert cloud.edp == pytest.approx(np.array(alone), rel=1e-5)
    assert not np.array_equal(stripes.edp, dd.multiple_stripe(bare, records, levels=[0.2, 0.4], progress=False).edp)


def test_no_participation_is_the_ground(records):
    still = dd.Building(0.3, participation=0.0)
    on_floor, on_ground = (
        dd.multiple_stripe(dd.OneSidedWall(1.5, 0.25, building=base), records, levels=[0.4, 0.8], progress=False)
        for base in (still, None)
    )
    assert np.array_equal(on_floor.edp, on_ground.edp)


def test_population(records, executable, tmp_path):
    """Each wall on its floor: from a table, by the executable and by Python, and back from the results."""
    table = tmp_path / "walls.csv"
    table.write_text(
        "name,mechanism,height,thickness,period1,damping1,period2,participation1,participation2,storeys,level,building_height\n"
        "a,one_sided,1.5,0.25,0.3,,,,,3,9,9\n"
        "b,one_sided,1.5,0.25,,,,,,,,\n"
        "c,one_sided,1.5,0.25,0.3,,,,,3,9,9\n"
        "d,one_sided,1.5,0.25,0.3,0.05,0.1,1.2,-0.2,,,\n"
    )
    people = dd.Population.from_csv(table)
    assert people[0].building == people[2].building == dd.Building(0.3, **HOUSE)
    assert people[1].building is None
    assert people[3].building == dd.Building([0.3, 0.1], participation=[1.2, -0.2])
    curves = dd.typology(people, records, levels=[0.15, 0.3, 0.45], progress=False)
    alone = dd.multiple_stripe(people[3], records, levels=[0.15, 0.3, 0.45], progress=False)
    counts = curves.collapses
    assert np.array_equal(counts[:, 0], counts[:, 2])
    assert not np.array_equal(counts[:, 0], counts[:, 1])
    assert np.array_equal(counts[:, 3], alone.collapses)

    catalogue = ["file,dt_s,units"]
    for i, record in enumerate(records):
        np.savetxt(tmp_path / f"{i}.txt", record.acceleration, fmt="%.17g")
        catalogue.append(f"{i}.txt,{record.dt!r},m/s2")
    (tmp_path / "records.csv").write_text("\n".join(catalogue) + "\n")
    case = tmp_path / "case.nml"
    case.write_text(
        "&job task = 'typology', output = 'out' /\n&population file = 'walls.csv' /\n"
        "&records catalogue = 'records.csv' /\n&stripes levels = 0.15, 0.3, 0.45 /\n"
    )
    subprocess.run([executable, "--quiet", case], cwd=tmp_path, check=True)
    results = dd.read_results(tmp_path / "out")
    assert [wall.building for wall in results.population] == [wall.building for wall in people]
    assert np.array_equal(results.typology.collapses, counts)
    people.to_csv(tmp_path / "again.csv")
    assert [wall.building for wall in dd.Population.from_csv(tmp_path / "again.csv")] == [
        wall.building for wall in people
    ]


@pytest.mark.parametrize(
    ("given", "sentence"),
    [
        ({"period": -0.3}, "period = -0.3: must be positive"),
        ({"period": 0.3, "damping": 1.0, "participation": 1.0}, "damping = 1: must be at least 0 and less than 1"),
        ({"period": 0.3, **HOUSE, "level": 9.5}, "level = 9.5: must be at most building_height = 9"),
        ({"period": [0.3, 0.1], "participation": 1.0}, "participation: has 1 values, must have 2 as period"),
        (
            {"period": [0.3, 0.1], "participation": [1, 1], "damping": [0.1] * 3},
            "damping: has 3 values, must have 2 as",
        ),
        ({"period": [0.3, 0.1], **HOUSE}, "participation: must be given of 2 modes"),
        ({"period": 0.3}, "participation: must be given, or storeys, level and building_height in its place"),
        ({"period": 0.3, "storeys": 3, "level": 9.0}, "building_height: must be given, storeys, level and"),
        (
            {"period": 0.3, "participation": 1.0, "level": 9.0},
            "participation: give either participation or storeys, level, building_height and level_top",
        ),
        ({"period": 0.3, **HOUSE, "storeys": 2.5}, "storeys = 2.5: must be an integer"),
    ],
)
def test_refusals(given, sentence):
    with pytest.raises(dd.errors.InputError) as caught:
        dd.Building(**given)
    assert str(caught.value).startswith(sentence)
    assert "\n" not in str(caught.value)


def test_refused_by_the_executable(root, executable, tmp_path):
    text = (root / "data/cases/parapet_on_building.nml").read_text()
    text = text.replace("'../records", f"'{root}/data/records")
    for old, new, sentence in [
        ("level = 9.0 ", "level = 9.5 ", "&building: level = 9.5: must be at most building_height = 9 (line "),
        ("period = 0.3 ", "period = 0.3, 0.1 ", "&building: participation: must be given of 2 modes"),
        ("density = 1800.0", "period = 0.3", "&wall: period (line "),
        ("task = 'stripes'", "task = 'typology'", "&population: must be given for task = 'typology'"),
    ]:
        case = tmp_path / "case.nml"
        case.write_text(text.replace(old, new))
        run = subprocess.run([executable, "--check", case], cwd=tmp_path, capture_output=True, text=True, check=False)
        assert run.returncode == 2
        assert sentence in run.stderr, run.stderr


def test_plot(records):
    ax = dd.Building([0.3, 0.1], participation=[1.2, -0.2]).plot(records=records, periods=np.geomspace(0.05, 2.0, 12))
    floor, ground = (line.get_ydata() for line in ax.lines[len(records) : len(records) + 2])
    expected = [record.spectrum(ax.lines[0].get_xdata()).pseudo_acceleration / 9.81 for record in records]
    assert np.allclose(ground, np.exp(np.log(expected).mean(axis=0)))
    assert floor[6] > 2.0 * ground[6]
    assert len(ax.lines) == len(records) + 4


def test_spectrum_of_the_code(records):
    """Values of an independent computation; the same beside those of the records."""
    site, house = dd.Site(0.2, 2.5, 0.35, soil="B"), dd.Building(0.3, **HOUSE)
    code = site.spectrum(periods=[0.1, 0.3, 0.6, 1.0], damping=0.08, building=house)
    expected = [1.3941798041402019, 3.3449714361931694, 0.92781245815397021, 0.38212923131786948]
    assert code.sa == pytest.approx(expected, rel=1e-12)
    ax = house.plot(records=records, periods=[0.1, 0.3, 0.6, 1.0], damping=0.08, site=site)
    assert np.array_equal(ax.lines[-2].get_ydata(), code.sa)
    with pytest.raises(dd.errors.InputError, match="damping = 0: must be positive"):
        site.spectrum(building=dd.Building(0.3, participation=1.0, damping=0.0))
