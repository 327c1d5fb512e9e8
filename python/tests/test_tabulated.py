"""Walls whose terms are a table: against the walls of dondolo, and against an arch that dondolo does not have."""

import json
import subprocess
import sys
import zlib
from pathlib import Path

import numpy as np
import pytest

import dondolo as dd

WALLS = {
    "one_sided": dd.OneSidedWall(3.0, 0.25),
    "free_standing": dd.FreeStandingWall(3.0, 0.25),
    "two_block": dd.TwoBlockWall(3.0, 0.25, hinge=0.6),
    "loaded": dd.TwoBlockWall(
        3.0, 0.25, hinge=0.6, overburden=8e3, overburden_inertia=0.5, eccentricity=-0.05, name="loaded"
    ),
}
LEVELS = (0.15, 0.3, 0.45, 0.6, 0.9, 1.2)


def as_table(wall, *, far=1.0, **more):
    """A wall as the table of its own terms, up to some multiple of its capacity."""

    def term(of):
        return lambda q: of(wall.terms(q))

    said = {
        "rotation": far * wall.capacity_angle,
        "inertia": term(lambda terms: terms.inertia),
        "lever": term(lambda terms: terms.excitation_lever),
        "moment": term(lambda terms: terms.restoring_moment - terms.load_force),
        "vertical_lever": term(lambda terms: terms.restoring_moment / wall.gravity),
        "sides": 2 if wall.two_sided else 1,
        "restitution_value": wall.restitution_coefficient,
        "name": wall.name,
    }
    return dd.TabulatedWall(wall.height, **(said | more))


def write_table(path, wall):
    """The table of a wall in a file, in other units."""
    columns = np.array([wall.rotation, wall.inertia, wall.lever, wall.moment, wall.vertical_lever]).T
    rows = [",".join(map(repr, row)) for row in (columns * [1e3, 1e-3, 1.0, 1e-3, 1e-3]).tolist()]
    head = "rotation [mrad],inertia [t m2/m],lever (kg m/m),moment [kN m/m],vertical_lever [t m/m]"
    path.write_text("\n".join([head, *rows]) + "\n")


@pytest.fixture(scope="module")
def motions():
    return dd.synthetic_records(6.5, 10.0, "shallow", n_records=12)


@pytest.mark.parametrize("far", [1.0, 1.3])
@pytest.mark.parametrize("engine", ["lanes", "rk45"])
@pytest.mark.parametrize("name", WALLS)
def test_a_table_of_a_wall_is_the_wall(motions, name, engine, far):
    """Flags are the same, EDPs within 1e-9, or within a hundredth of what the engine itself may be wrong by."""
    wall, solver = WALLS[name], dd.Solver(engine=engine)
    table = as_table(wall, far=far)
    assert table.misfit < 5e-15
    for what in ("capacity_angle", "trigger_acceleration", "frequency_parameter", "restitution_coefficient"):
        assert getattr(table, what) == pytest.approx(getattr(wall, what), rel=1e-14)
    expected, found = (
        dd.multiple_stripe(one, motions, LEVELS, polarity="both", solver=solver, estimate_error=True, progress=False)
        for one in (wall, table)
    )
    assert 0 < expected.collapsed.sum() < expected.collapsed.size
    np.testing.assert_array_equal(found.collapsed, expected.collapsed)
    assert expected.edp_error is not None
    assert np.all(np.abs(found.edp - expected.edp) < np.maximum(1e-9, 0.01 * expected.edp_error))


@pytest.mark.parametrize("name", WALLS)
def test_terms_and_potential(name):
    wall = WALLS[name]
    table, q = as_table(wall), np.linspace(0.0, wall.capacity_angle, 101)
    for found, expected in zip(table.terms(q), wall.terms(q), strict=True):
        np.testing.assert_allclose(found, expected, rtol=0.0, atol=2e-12 * wall.terms(0.0).inertia)
    energy = wall.potential(q) - wall.potential(0.0)
    np.testing.assert_allclose(table.potential(q), energy, rtol=0.0, atol=1e-12 * energy.max())


def test_vertical_motion(motions):
    wall, record = WALLS["loaded"], motions[0]
    shaken = dd.Record(
        record.acceleration, record.dt, vertical=0.6 * motions[1].acceleration[: len(record.acceleration)]
    )
    expected = dd.simulate(wall, shaken, scale=1.4)
    assert 0.0 < expected.edp < 1.0
    assert dd.simulate(as_table(wall), shaken, scale=1.4).edp == pytest.approx(expected.edp, abs=1e-9)
    for run in (dd.simulate, lambda one, two: dd.multiple_stripe(one, two, [0.5], progress=False)):
        with pytest.raises(
            dd.errors.InputError, match=r"^vertical_lever: must be given for records with vertical motion"
        ):
            run(as_table(wall, vertical_lever=None), shaken)


def test_between_two_floors(motions):
    """The k and tau of a strip, given by number."""
    house = dd.Building(period=0.3, storeys=3, level=3.0, building_height=9.0)
    strip = dd.TwoBlockWall(3.0, 0.25, hinge=0.6, building=house)
    table = as_table(strip, top_share=strip.support_share, top_tilt=strip.support_tilt, building=house)
    assert table.support_share == pytest.approx(strip.support_share, rel=1e-15)
    assert table.support_tilt == pytest.approx(strip.support_tilt, rel=1e-15)
    edp = [dd.multiple_stripe(wall, motions, LEVELS, progress=False).edp for wall in (strip, table)]
    np.testing.assert_allclose(edp[1], edp[0], rtol=0.0, atol=1e-9)
    based = dd.multiple_stripe(as_table(strip, building=house), motions, LEVELS, progress=False).edp
    assert np.abs(based - edp[0]).max() > 0.01


def test_certified(motions):
    """In 33 digits the table is the same double precision numbers."""
    stripes = dd.multiple_stripe(as_table(WALLS["two_block"]), motions[:6], LEVELS[:4], certify=True, progress=False)
    assert set(np.unique(stripes.status)) <= {dd.results.Certified.DOUBLE, dd.results.Certified.QUADRUPLE}


def test_energy_of_the_arch():
    """Without ground motion 1/2 J q'^2 + V is constant: the terms of the example belong together."""
    record = dd.Record(np.r_[np.full(40, -6.0), np.zeros(400)], 0.005)
    wall = example()["wall"]
    response = dd.simulate(wall, record, history=True)
    time, q, v = (np.asarray(getattr(response, what)) for what in ("time", "rotation", "velocity"))
    free = (time > 0.21) & (time < time[np.argmax(np.asarray(response.after_impact))] - 0.01)
    energy = 0.5 * wall.terms(np.abs(q[free])).inertia * v[free] ** 2 + wall.potential(np.abs(q[free]))
    assert free.sum() > 50
    assert np.ptp(energy) < 1e-6 * energy.mean()


def example():
    """The arch of the documentation, up to its wall."""
    script = Path(__file__).resolve().parents[2] / "docs/examples/own_mechanism.py"
    text = script.read_text(encoding="utf-8").split("# %% From here on")[0]
    found: dict = {}
    exec(compile(text, str(script), "exec"), found)
    return found


def test_the_arch_of_oppenheim():
    """It begins to rock at 0.37 g; the table between its nodes is the arch, and C half the slope of its J."""
    found = example()
    wall, arch, least = found["wall"], found["arch"], found["least"]
    assert wall.trigger_acceleration / wall.gravity == pytest.approx(0.37, abs=5e-4)
    assert wall.misfit < 1e-13
    q, step = np.linspace(0.001, 0.06, 7), 1e-6
    slopes = (arch(*least, q + step)[0] - arch(*least, q - step)[0]) / (2.0 * step)
    np.testing.assert_allclose(wall.terms(q).inertia_rate, 0.5 * slopes, rtol=1e-6)
    np.testing.assert_allclose(wall.terms(q).excitation_lever, arch(*least, q)[1], rtol=1e-13)


def test_files(tmp_path, motions, monkeypatch):
    """A table of walls names files beside it; results and archives have the content."""
    wall = as_table(WALLS["two_block"], name="a")
    (tmp_path / "tables").mkdir()
    write_table(tmp_path / "tables/two.csv", wall)
    rows = f"a,tabulated,3.0,,tables/two.csv,2,{wall.restitution_coefficient!r}\nb,two_block,3.0,0.25,,,\n"
    (tmp_path / "walls.csv").write_text("name,mechanism,height,thickness,table,sides,restitution_value\n" + rows)
    population = dd.Population.from_csv(tmp_path / "walls.csv")
    monkeypatch.chdir(tmp_path)
    assert population.walls[0] == dd.TabulatedWall(
        3.0, table="tables/two.csv", sides=2, restitution_value=wall.restitution_coefficient, name="a"
    )
    np.testing.assert_allclose(population.walls[0].moment, wall.moment, rtol=1e-14, atol=1e-11)
    typology = dd.typology(population, motions, LEVELS, progress=False)
    typology.write_results("out/t")
    assert dd.read_results("out/t").typology.population.walls[0] == population.walls[0]
    typology.save("t.npz")
    assert dd.load("t.npz").population.walls[0] == population.walls[0]
    dd.report(typology, "report.html")
    assert "misfit of its table" in (tmp_path / "report.html").read_text(encoding="utf-8")
    # The identity of a study is that of the content of the file
    (tmp_path / "tables/two.csv").write_text((tmp_path / "tables/two.csv").read_text().replace("0.0,", "0,", 1))
    assert dd.Population.from_csv("walls.csv").walls[0] == population.walls[0]


def test_the_file_is_an_input_of_the_run(tmp_path, monkeypatch):
    """By its role and checksum; results do not overwrite it. A population notes the largest misfit."""
    monkeypatch.chdir(tmp_path)
    wall = as_table(WALLS["two_block"], name="a")
    write_table(tmp_path / "out_walls.csv", wall)
    dd.RecordSet(dd.synthetic_records(6.5, 10.0, "shallow", n_records=3)).to_catalogue("records.csv")
    own = f"tabulated,3.0,out_walls.csv,2,{wall.restitution_coefficient!r}"
    Path("walls.csv").write_text(f"name,mechanism,height,table,sides,restitution_value\na,{own}\nb,{own}\n")
    described = "mechanism = 'tabulated', height = 3.0, table = 'out_walls.csv', sides = 2, restitution_value = {}"
    common = "&records catalogue = 'records.csv' /\n&stripes levels = 0.5, 1.0 /\n"
    walls = {
        "stripes": f"&wall {described.format(wall.restitution_coefficient)} /\n",
        "typology": "&population file = 'walls.csv' /\n",
    }
    executable = Path(sys.executable).with_name("dondolo")
    for task, group in walls.items():
        Path("case.nml").write_text(f"&job task = '{task}', output = 'results/{task}' /\n{group}{common}")
        ran = subprocess.run([executable, "case.nml"], check=True, capture_output=True, text=True)
        run = json.loads(Path(f"results/{task}_run.json").read_text())
        (found,) = (one for one in run["inputs"] if one["role"] == "table")
        content = Path("out_walls.csv").read_bytes()
        assert (found["bytes"], found["crc32"]) == (len(content), f"{zlib.crc32(content):08x}")
        assert Path(found["path"]).samefile("out_walls.csv")
        checked = subprocess.run([executable, "--check", "case.nml"], check=True, capture_output=True, text=True)
        assert "polynomials miss" in checked.stdout + checked.stderr
        for noted in (checked.stderr, ran.stderr):
            assert ("2 of 2 rows are tabulated: polynomials miss" in noted) == (task == "typology")
        assert any("2 of 2 rows are tabulated" in note for note in run["notes"]) == (task == "typology")
        # Changed in a comment or in a digit, the run is known to be of another file
        Path("out_walls.csv").write_bytes(content + b"\n")
        assert f"{zlib.crc32(Path('out_walls.csv').read_bytes()):08x}" != found["crc32"]
        Path("out_walls.csv").write_bytes(content)
        Path("case.nml").write_text(f"&job task = '{task}', output = 'out' /\n{group}{common}")
        refused = subprocess.run([executable, "case.nml"], check=False, capture_output=True, text=True)
        assert refused.returncode != 0
        assert Path("out_walls.csv").read_bytes() == content


def test_powers(tmp_path):
    """Polynomials by their coefficients."""
    (tmp_path / "powers.csv").write_text(
        "power,inertia [kg m2/m],lever [kg m/m],moment [N m/m]\n0,1000,500,800\n1,50,0,-8000\n3,0,7,0\n"
    )
    wall = dd.TabulatedWall(2.0, table=tmp_path / "powers.csv", rotation=0.12, sides=1, restitution_value=0.5)
    assert wall.capacity_angle == pytest.approx(0.1, rel=1e-14)
    terms = wall.terms(0.05)
    assert terms.inertia == pytest.approx(1002.5, rel=1e-14)
    assert terms.inertia_rate == pytest.approx(25.0, rel=1e-10)
    assert terms.excitation_lever == pytest.approx(500.0 + 7.0 * 0.05**3, rel=1e-14)


@pytest.mark.parametrize("rows", [12, 25, 60, 400])
def test_evenly_spaced_rows(rows):
    """Equal steps do not swing between the rows (Runge)."""
    wall = WALLS["two_block"]
    table = as_table(wall, rotation=np.linspace(0.0, 1.2 * wall.capacity_angle, rows))
    q = np.linspace(0.0, wall.capacity_angle, 777)
    found, expected = table.terms(q), wall.terms(q)
    for one, other in zip(found, expected, strict=True):
        np.testing.assert_allclose(one, other, rtol=0.0, atol=2e-6 * np.abs(expected.inertia).max())


def test_printed_digits(motions):
    """Of a table of four digits the EDPs are right to about four digits."""
    wall = WALLS["one_sided"]
    q = np.linspace(0.0, 1.1 * wall.capacity_angle, 40)
    terms = wall.terms(q)
    rounded = {
        what: [float(f"{value:.4g}") for value in values]
        for what, values in (
            ("inertia", terms.inertia),
            ("lever", terms.excitation_lever),
            ("moment", terms.restoring_moment),
        )
    }
    table = as_table(wall, rotation=q, vertical_lever=None, **rounded)
    assert 1e-6 < table.misfit < 5e-4
    edp = [dd.multiple_stripe(one, motions, [0.15, 0.2], progress=False).edp for one in (wall, table)]
    np.testing.assert_allclose(edp[1], edp[0], rtol=0.0, atol=5e-3)


def linear(**more):
    said = {
        "rotation": np.linspace(0.0, 0.1, 21),
        "inertia": 1000.0,
        "lever": 500.0,
        "moment": 900.0 - 1e4 * np.linspace(0.0, 0.1, 21),
        "sides": 1,
        "restitution_value": 0.5,
    }
    return dd.TabulatedWall(2.0, **(said | more))


CORNER = np.interp(np.linspace(0.0, 0.1, 21), [0.0, 0.04, 0.09, 0.1], [900.0, 900.0, 0.0, -180.0])


@pytest.mark.parametrize(
    ("more", "message"),
    [
        ({"sides": None}, "^sides: must be given with mechanism = 'tabulated': 1 "),
        ({"sides": 1.5}, "^sides = 1.5: must be an integer$"),
        ({"restitution_value": None}, "^restitution_value: must be given, the mechanism has no model"),
        ({"restitution": "impulse"}, "^restitution_value = 0.5: give either it or restitution"),
        ({"moment": None}, "^moment: must be given with mechanism = 'tabulated'"),
        ({"moment": [1.0, 2.0]}, "^moment: has 2 values, must have 21 as rotation"),
        ({"rotation": [0.0, 0.1], "moment": [1.0, -1.0]}, "^rotation: has 2 values, must have 5 at least"),
        ({"rotation": np.linspace(0.01, 0.1, 21)}, "^rotation: begins at 0.01, must begin at 0"),
        ({"rotation": np.linspace(0.0, 0.1, 21)[::-1]}, "^rotation: begins at 0.1, must begin at 0"),
        ({"rotation": np.r_[0.0, 0.0, np.linspace(0.01, 0.1, 19)]}, "^rotation: 0 follows 0, each must be more"),
        ({"moment": -900.0}, r"^moment: is -900 N m at rotation 0, must be positive"),
        ({"moment": 900.0}, r"^moment: is 900 N m at the last rotation, 0.1 rad, must fall to 0"),
        ({"moment": lambda q: 900.0 * np.cos(60.0 * q)}, "^moment: vanishes at 0.02618 rad and is positive again at"),
        (
            {"moment": CORNER},
            "^moment: the smooth curve through its values misses them by up to .* must be within 0.1 %",
        ),
        ({"inertia": -1.0}, "^inertia = -1, .*: must be positive"),
        ({"inertia": lambda q: 1.0 + 1e3 * (q - 0.0525) ** 2 - 1.001}, "^inertia: must be positive, is not at"),
        (
            {"lever": lambda q: 500.0 - 7e3 * q},
            "^lever: must be positive up to the rotation at which the moment vanishes",
        ),
        ({"top_share": 0.5}, "^top_tilt: must be given with top_share"),
        ({"table": "nowhere.csv"}, "^inertia: give either it or table"),
    ],
)
def test_refused(more, message):
    with pytest.raises(dd.errors.InputError, match=message):
        linear(**more)


@pytest.mark.parametrize(
    ("head", "message"),
    [
        (
            "rotation,inertia [kg m2],lever [kg m],moment [N m]",
            r"column 'rotation': must have its unit in brackets, rotation \[rad\]",
        ),
        (
            "rotation [rad],inertia [kg m2],lever [kg m],moment [lb ft]",
            r"column 'moment \[lb ft\]': must have its unit",
        ),
        ("rotation [rad],inertia [kg m2],lever [kg m],force [N]", r"column 'force \[N\]': must be one of 'rotation'"),
        (
            "rotation [rad],inertia [kg m2],lever [kg m],lever [t m]",
            r"column 'lever \[t m\]': the table has lever twice",
        ),
        ("rotation [rad],power,lever [kg m],moment [N m]", "columns rotation and power: the table must have one"),
        (
            "rotation [rad],inertia [kg m2],lever [kg m],vertical_lever [kg m]",
            r"column 'moment \[N m/m\]': must be given",
        ),
        ("power,inertia [kg m2],lever [kg m],moment [N m]", "rotation: must be given with a table of powers"),
    ],
)
def test_refused_files(tmp_path, head, message):
    file = tmp_path / "table.csv"
    file.write_text(head + "\n0,1000,500,900\n1,1000,500,-900\n")
    with pytest.raises(dd.errors.InputError, match=r"^table: .*table\.csv: " + message):
        dd.TabulatedWall(2.0, table=file, sides=1, restitution_value=0.5)
    with pytest.raises(dd.errors.InputError, match=r"^table: .*none\.csv: no such file"):
        dd.TabulatedWall(2.0, table=tmp_path / "none.csv", sides=1, restitution_value=0.5)


def test_limits(motions):
    """Beyond its table a wall is not known; without masses there is no kinematic check, without a shape no film."""
    wall = linear()
    with pytest.raises(dd.errors.InputError, match=r"^edp_limit = 1.2: must be less than 1.11.*, where the geometry"):
        dd.simulate(wall, motions[0], solver=dd.Solver(edp_limit=1.2))
    site = dd.Site(ag=0.2, f0=2.5, tc_star=0.35, soil="B")
    with pytest.raises(dd.errors.InputError, match="weight: must be given for the kinematic check"):
        dd.check_ntc(wall, site)
    with pytest.raises(dd.errors.InputError, match="has no shape to draw"):
        dd.simulate(wall, motions[0], history=True).animate()


def test_shown():
    wall = linear(name="own")
    assert "table=21 rotations up to 0.1 rad, misfit" in repr(wall)
    assert "restitution=" not in repr(wall)
    assert wall.plot().get_ylabel() == "restoring moment [kN m per metre]"
    assert wall == linear(name="own")
    assert hash(wall) == hash(linear(name="own"))
    assert dd.Population([wall]).plot().get_ylabel() == "thickness [m]"
