"""What comes in and goes out: encodings, line ends, limits of sizes, and names that spreadsheets take for formulas."""

import contextlib
import csv
import dataclasses
import io
import json
import zipfile
from html.parser import HTMLParser
from xml.etree import ElementTree

import numpy as np
import pytest
from costs import growth

import dondolo as dd
from dondolo._base.shown import html_of
from dondolo._storage.run_file import described
from dondolo.reporting import content
from dondolo.reporting.blocks import Heading
from dondolo.reporting.language import Language
from dondolo.reporting.parts import captioned
from dondolo.reporting.writers.imprint import Imprint
from dondolo.reporting.writers.web import page as page_of

SAMPLES = "0.0\n1.5\n-2.0\n0.5\n"


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "utf-16", "latin-1"])
@pytest.mark.parametrize("end", ["\n", "\r\n", "\r", "\r\r\n"])
def test_a_record_in_any_encoding(encoding, end, tmp_path):
    path = tmp_path / "record.txt"
    text = "# station: Trévi\n# units: m/s2\n# dt: 0.01\n" + SAMPLES
    path.write_bytes(text.replace("\n", end).encode(encoding))
    record = dd.read_record(path)
    assert record.acceleration.tolist() == [0.0, 1.5, -2.0, 0.5]
    assert record.metadata["station"] == "Trévi"


@pytest.mark.parametrize("encoding", ["utf-16-le", "utf-16-be"])
def test_a_record_without_its_mark(encoding, tmp_path):
    path = tmp_path / "record.txt"
    path.write_bytes(SAMPLES.encode(encoding))
    with pytest.raises(dd.errors.InputError, match=r"record\.txt: line 1: byte \d is NUL"):
        dd.read_record(path, dt=0.01, units="g")


def test_characters_that_two_parts_of_a_file_share(tmp_path):
    """Tables are read in parts, whose ends cut characters of several bytes and line ends."""
    names = [f"{'wàll 🏛' * (1 + i % 7)} {i}" for i in range(12_000)]
    rows = "".join(f"{name},one_sided,3,0.25\n" for name in names)
    for encoding, end in (("utf-8", "\n"), ("utf-16", "\r\n"), ("utf-8", "\r")):
        text = f"name,mechanism,height,thickness\n{rows}".replace("\n", end)
        (tmp_path / "walls.csv").write_bytes(text.encode(encoding))
        assert [wall.name for wall in dd.Population.from_csv(tmp_path / "walls.csv").walls] == names


@pytest.mark.parametrize(
    ("table", "content", "sentence"),
    [
        ("walls.csv", "name,mechanism\n" + "x" * 2**20 + ",one_sided\n", "line 2: longer than 1048576 bytes"),
        ("walls.csv", "name" + ",name" * 10_000, "line 1: more than 10000 cells"),
        (
            "walls.csv",
            f"name,mechanism,height,thickness\n{'é' * 501},one_sided,3,0.3\n",
            "line 2: name = 'é{30}...': must have at most 1000 bytes",
        ),
        ("hazard.csv", "pga,annual_frequency\n" + "1,1\n" * 500_001, "line 500002: more than 1000000 numbers"),
        ("records.csv", "file\n" + "x\n" * 100_001, "more than 100000 records"),
        ("case.nml", "&job\n" + "!" * 2**20, "has 1048581 bytes: must be at most 1048576"),
        ("case.nml", "&job a = " + "1 " * 250_000, "line 1: a case may have at most 200000 words, values and signs"),
        ("case.nml", f"&job title = '{'x' * 1001}' /", "title = 'x{59}...: must have at most 1000 bytes"),
    ],
)
def test_limits(table, content, sentence, tmp_path):
    path = tmp_path / table
    path.write_text(content)
    readers = {
        "walls.csv": dd.Population.from_csv,
        "hazard.csv": dd.HazardCurve.from_csv,
        "records.csv": dd.read_catalogue,
        "case.nml": dd.read_case,
    }
    with pytest.raises(dd.errors.InputError, match=sentence) as caught:
        readers[table](path)
    assert str(caught.value).startswith(f"{path}: ")
    # Other things that are wrong have lines of their own
    assert all(len(line) < len(str(path)) + 200 for line in str(caught.value).splitlines())


def test_limits_of_records(tmp_path):
    with pytest.raises(dd.errors.InputError, match="number of samples = 10000001: must be at most 10000000"):
        dd.Record(np.zeros(10_000_001), 0.01)
    with pytest.raises(dd.errors.InputError, match=r"name = 'x{60}\.\.\.': must have at most 1000 bytes"):
        dd.Record([0.0, 1.0], 0.01, name="x" * 1001)
    # A file of 1 GiB and a byte, of which nothing is on the disk
    path = tmp_path / "huge.txt"
    with path.open("wb") as file:
        file.truncate(2**30 + 1)
    with pytest.raises(dd.errors.InputError, match=r"huge\.txt: has 1073741825 bytes: must be at most 1073741824"):
        dd.read_record(path, dt=0.01, units="g")


@pytest.mark.parametrize("encoding", ["latin-1", "utf-16"])
def test_records_take_linear_time(encoding, tmp_path):
    for count in (4000, 32_000):
        text = "# station: Trévi\r" + "0.5\r-0.5\r" * count
        (tmp_path / f"{count}.txt").write_bytes(text.encode(encoding))
    assert growth(lambda n: dd.read_record(tmp_path / f"{n}.txt", dt=0.01, units="g"), 4000, 32_000) < 24.0


FORMULAS = ["=1+1", "+39", "-5", "@SUM(A1)", "'=x", "''", "'s Hertogenbosch", "plain", '=HYPERLINK("a,b")']


def test_names_that_spreadsheets_take_for_formulas(tmp_path):
    walls = [
        dd.TwoBlockWall(3.0, 0.3, name=name, overburden=1e4, overburden_inertia=0.0, eccentricity=-0.05)
        for name in FORMULAS
    ]
    people = dd.Population(walls, group_names=FORMULAS)
    for safe in (False, True):
        people.to_csv(tmp_path / "walls.csv", spreadsheet_safe=safe)
        back = dd.Population.from_csv(tmp_path / "walls.csv")
        assert [wall.name for wall in back.walls] == FORMULAS
        assert list(back.group_names) == FORMULAS
        assert back.walls == people.walls
        rows = list(csv.DictReader(io.StringIO((tmp_path / "walls.csv").read_text())))
        assert [row["eccentricity"] for row in rows] == ["-0.05"] * len(FORMULAS)
        if safe:
            assert not any(row["name"].startswith(("=", "+", "-", "@")) for row in rows)


def test_results_that_spreadsheets_open(run, few, tmp_path):
    """The executable writes the same cells as Python does, and both are read back as they were."""
    rows = "".join(f'"{name.replace(chr(34), 2 * chr(34))}",one_sided,3,0.3\n' for name in FORMULAS[:4])
    (tmp_path / "walls.csv").write_text("name,mechanism,height,thickness\n" + rows)
    (tmp_path / "=r.txt").write_text(SAMPLES)
    (tmp_path / "records.csv").write_text("file,dt_s,units\n=r.txt,0.1,m/s2\n")
    (tmp_path / "case.nml").write_text(
        "&job task = 'typology' output = 'x' histories = .true. spreadsheet_safe = .true. /\n"
        "&population file = 'walls.csv' /\n&records catalogue = 'records.csv' /\n&stripes levels = 0.2, 0.4 /\n"
    )
    done = run("--quiet", "case.nml")
    assert done.returncode == 0, done.stderr
    for table in ("walls", "histories", "stripes", "fragility"):
        lines = (line for line in (tmp_path / f"x_{table}.csv").read_text().splitlines() if line[0] != "#")
        cells = list(csv.DictReader(lines))
        assert {row["wall"] for row in cells} == {f"'{name}" for name in FORMULAS[:4]}
        assert {row.get("record") for row in cells} <= {None, "'=r"}
    stored = dd.read_results(tmp_path / "x")
    assert [wall.name for wall in stored.typology.population.walls] == FORMULAS[:4]
    stored.typology.write_results(tmp_path / "y", spreadsheet_safe=True)
    assert [wall.name for wall in dd.read_results(tmp_path / "y").typology.population.walls] == FORMULAS[:4]


def test_what_a_spreadsheet_saves_is_read(few, tmp_path):
    """Results that were opened and saved: a byte order mark, CRLF, UTF-16."""
    dd.typology([dd.OneSidedWall(3.0, 0.3, name="é")], few, [0.2, 0.4], progress=False).write_results(tmp_path / "x")
    path = tmp_path / "x_walls.csv"
    text = path.read_text(encoding="utf-8")
    for encoding in ("utf-8-sig", "utf-16"):
        path.write_bytes(text.replace("\n", "\r\n").encode(encoding))
        assert dd.read_results(tmp_path / "x").typology.population[0].name == "é"
    path.write_bytes(text.encode("latin-1"))
    with pytest.raises(dd.errors.InputError, match=r"x_walls\.csv: line \d+: byte \d+ is not UTF-8: save it as UTF-8"):
        dd.read_results(tmp_path / "x")


def test_hints(tmp_path):
    path = tmp_path / "hazard.csv"
    path.write_text("Sa(0,5);annual_frequency\n0,1;0,01\n0,2;0,001\n")
    with pytest.warns(dd.errors.DondoloWarning, match="decimal commas"):
        assert dd.HazardCurve.from_csv(path).im == "sa(0.5)"
    (tmp_path / "r.txt").write_text(SAMPLES)
    catalogue = tmp_path / "records.csv"
    catalogue.write_text("file,dt,units\nr.txt,0.01,g\n")
    with pytest.raises(dd.errors.InputError, match="column 'dt': the time step must be in the column dt_s"):
        dd.read_catalogue(catalogue)
    catalogue.write_text("file,units\nr.txt,g\n")
    with pytest.raises(dd.errors.InputError, match="dt must be given, dt_s in a catalogue"):
        dd.read_catalogue(catalogue)
    with pytest.raises(dd.errors.InputError, match=r"eccentricity = 1: must lie between -0\.15 and 0\.15 \(half"):
        dd.TwoBlockWall(3.0, 0.1 + 0.2, overburden=1.0, overburden_inertia=0.0, eccentricity=1.0)


def interlocked(overlap, **sizes):
    """A wall whose stones overlap those of transverse walls by so much."""
    sizes = sizes or {"height": 3.0, "thickness": 0.25}
    return dd.OneSidedWall(**sizes, interlock=dd.Interlock(overlap=overlap, course=0.1, thickness=0.25, spacing=5.0))


def heavy(mass, height=3.0, thickness=0.25):
    """A wall of a given mass."""
    inertia = mass * (height**2 + thickness**2) / 3.0
    where = {"centroid_depth": 0.5 * thickness, "centroid_height": 0.5 * height}
    return dd.OneSidedWall(height, thickness, mass=mass, hinge_inertia=inertia, **where)


def filled(shares, **more):
    """A wall of two storeys of which parts are masonry."""
    storeys = [dd.Section(height, 0.3, fill=share) for height, share in zip((2.0, 1.0), shares, strict=True)]
    return dd.OneSidedWall(sections=storeys, **more)


@pytest.mark.parametrize(
    ("make", "levels", "code"),
    [
        (lambda: dd.OneSidedWall(0.25, 3.0), [0.2], "height_below_thickness"),
        (lambda: dd.TwoBlockWall(3.0, 0.3, eccentricity=0.1), [0.2], "load_place_without_load"),
        (lambda: interlocked(0.3), [0.2], "overlap_above_thickness"),
        (
            lambda: interlocked(0.46, sections=[dd.Section(2.0, 0.45), dd.Section(1.0, 0.3)]),
            [0.2],
            "overlap_above_thickness",
        ),
        (lambda: heavy(1.35), [0.2], "mass_beside_size"),  # tonnes
        (lambda: heavy(13.5), [0.2], "mass_beside_size"),  # kilonewtons
        (lambda: heavy(6e4), [0.2], "mass_beside_size"),  # more than of steel
        (lambda: filled([0.6, 1.0]), [0.2], "restitution_of_solid"),
        (lambda: dd.OneSidedWall(3.0, 0.25), [1.0, 5.0], "levels_above_usual"),
    ],
)
def test_slips_are_warned_of(make, levels, code, few):
    with pytest.warns(dd.errors.DondoloWarning) as caught:
        dd.multiple_stripe(make(), few, levels, progress=False)
    assert code in [warning.message.code for warning in caught]


@pytest.mark.parametrize(
    "wall",
    [
        interlocked(0.25),
        interlocked(0.44, sections=[dd.Section(2.0, 0.3), dd.Section(1.0, 0.45)]),
        heavy(1350.0),
        heavy(8 * 1350.0),  # of a facade, not of a metre of it
        filled([0.8, 0.8]),  # a block that is lighter throughout
        filled([0.6, 1.0], restitution="impulse"),
        filled([0.6, 1.0], restitution_value=0.4),
    ],
)
def test_what_is_usual_is_not_warned_of(wall, few, recwarn):
    dd.multiple_stripe(wall, few, [0.2], progress=False)
    codes = [getattr(found.message, "code", "") for found in recwarn]
    assert not {
        "restitution_of_solid",
        "overlap_above_thickness",
        "mass_beside_size",
        "value_above_usual",
        "value_below_usual",
    } & set(codes)


# Names that formats and terminals could take for their own signs, and those that stand for steps of the cursor
SIGNS = ['<b>&amp;"it\'s"</b>', "=1+1", "+39", "-5", "@x", "a,b;c", "]]>", "--><i>", "\\u0041", "a\u200bb", "naïve 🏛"]
STEERING = ["\x1b[2Jx", "a\nb", "a\tb", "a\x00b", "a\x7fb", "a\x9bb", "a\u202eb", "a\u2066b", "a\u2028b"]


def texts_of(page):
    """Texts of HTML; None for each element that no template sets."""
    found = []
    parser = HTMLParser()
    parser.handle_data = found.append
    parser.handle_starttag = lambda tag, _: found.append(None) if tag in ("b", "i") else None
    parser.feed(page)
    return [text and text.strip() for text in found]


def in_html(name, _, __):
    assert texts_of(html_of(name, [(name, name)])) == [name] * 3
    table = content.Table.of({"wall": [name]})
    blocks = [Heading(name, 0), captioned(table, name)]
    page = texts_of(page_of(blocks, Imprint(Language("en"), name, name), formulas=True))
    assert page.count(name) >= 2
    assert None not in page


def in_an_archive(name, _, folder):
    record = dd.Record([0.0, 3.0, 0.0], 0.1, name=name)
    dd.simulate(dd.OneSidedWall(3.0, 0.25, name=name), record).save(folder / "response.npz")
    back = dd.load(folder / "response.npz")
    assert (back.wall.name, back.record.name) == (name, name)


def in_a_table(name, _, folder):
    people = dd.Population([dd.OneSidedWall(3.0, 0.25, name=name)], group_names=[name])
    for safe in (False, True):
        people.to_csv(folder / "walls.csv", spreadsheet_safe=safe)
        (row,) = csv.DictReader((folder / "walls.csv").read_text(encoding="utf-8").splitlines())
        guard = "'" if safe and name.startswith(tuple("=+-@")) else ""
        assert row["name"] == row["group"] == guard + name


def in_nrml(name, _, folder):
    curves = {"collapse": dd.fit_fragility([0.2, 0.4, 0.6], [1, 5, 9], [10, 10, 10], im="pga")}
    if not name.isprintable():
        with pytest.raises(dd.errors.InputError, match="printable"):
            dd.write_nrml(folder / "model.xml", {"a": curves}, description=name)
        return
    dd.write_nrml(folder / "model.xml", {"a": curves}, description=name)
    texts = [one.text for one in ElementTree.parse(folder / "model.xml").iter() if one.tag.endswith("description")]
    assert texts == [name]


def in_files_of_the_executable(name, run, folder):
    """JSON and CSV of Fortran."""
    quoted = name.replace("'", "''")
    (folder / "r.txt").write_text(SAMPLES)
    (folder / "records.csv").write_text("file,dt_s,units\nr.txt,0.1,m/s2\n")
    (folder / "case.nml").write_text(
        f"&job task = 'stripes' output = 'x' title = '{quoted}' spreadsheet_safe = .true. /\n"
        f"&wall name = '{quoted}' mechanism = 'one_sided' height = 3 thickness = 0.3 /\n"
        "&records catalogue = 'records.csv' /\n&stripes levels = 0.2, 0.4 /\n",
        encoding="utf-8",
    )
    done = run("--quiet", "case.nml")
    assert done.returncode == 0, done.stderr
    assert json.loads((folder / "x_run.json").read_text(encoding="utf-8"))["settings"]["job"]["title"] == name
    lines = (folder / "x_walls.csv").read_text(encoding="utf-8").splitlines()
    (row,) = csv.DictReader(line for line in lines if line[0] != "#")
    assert row["wall"] == ("'" if name.startswith(tuple("=+-@")) else "") + name
    results = dd.read_results(folder / "x")
    assert results.population[0].name == name
    assert any("no collapse" in str(warning) for warning in results.run.warnings)


def on_a_terminal(name, run, _):
    path = name.replace("/", ":")
    said = run("--check", f"./{path}")
    assert said.returncode == 2
    assert path in said.stderr


@pytest.mark.parametrize(
    "leave", [in_html, in_an_archive, in_a_table, in_nrml, in_files_of_the_executable, on_a_terminal]
)
@pytest.mark.parametrize("name", SIGNS)
def test_names_leave_as_they_came(leave, name, run, tmp_path):
    leave(name, run, tmp_path)


@pytest.mark.parametrize("name", STEERING)
def test_names_that_steer_a_terminal(name, run, tmp_path):
    """Python and the executable refuse them, and show them, and paths that have them, by their escapes in one line."""
    said = []
    for make in (
        lambda: dd.OneSidedWall(3.0, 0.25, name=name),
        lambda: dd.Record([0.0, 1.0], 0.01, name=name),
        lambda: dd.read_case(tmp_path / f"{name}.nml"),
    ):
        with pytest.raises(dd.errors.InputError) as caught:
            make()
        said.append(str(caught.value))
    (tmp_path / "case.nml").write_bytes(f"&job title = '{name}' /\n".encode())
    for path in ["case.nml"] if "\0" in name else ["case.nml", f"{name}.nml"]:
        done = run("--check", path)
        assert done.returncode == 2
        said.extend(done.stderr.splitlines())
    assert all(map(str.isprintable, said)), said


@pytest.mark.parametrize(
    ("member", "value"), [("theta", 10**400), ("log_likelihood", -(10**400)), ("covariance", -1.0)]
)
def test_archives_of_numbers_that_cannot_be(member, value, tmp_path):
    """They are refused, not met later; an integer of JSON can be larger than any float."""
    curve = dd.fit_fragility([0.2, 0.4, 0.6], [1, 5, 9], [10, 10, 10])
    dataclasses.replace(curve, **{member: np.full((2, 2), value) if member == "covariance" else value}).save(
        tmp_path / "curve.npz"
    )
    with pytest.raises(
        dd.errors.InputError, match=r"curve\.npz: was saved by dondolo .*: (int too large|invalid value)"
    ):
        dd.load(tmp_path / "curve.npz")


def test_archives_of_arrays_that_do_not_belong_together(stripes, tmp_path):
    stripes.save(tmp_path / "stripes.npz")
    with zipfile.ZipFile(tmp_path / "stripes.npz") as archive:
        members = {name: archive.read(name) for name in archive.namelist()}
    tree = json.loads(members["dondolo.json"])
    parts = tree["result"]["Stripes"]
    parts["edp"] = parts["levels"]
    members["dondolo.json"] = json.dumps(tree).encode()
    with zipfile.ZipFile(tmp_path / "stripes.npz", "w") as archive:
        for name, content in members.items():
            archive.writestr(name, content)
    with pytest.raises(dd.errors.InputError, match=r"edp: must have the shape of ran, \(6, 44\)"):
        dd.load(tmp_path / "stripes.npz")


@pytest.mark.parametrize("column", ["return_period", "investigation_time"])
def test_frequencies_beyond_all_bounds(column, tmp_path):
    rows = {"return_period": "1e-310,", "investigation_time": "1e-310,0.1"}[column]
    path = tmp_path / "hazard.csv"
    head = "pga,return_period" if column == "return_period" else "pga,investigation_time,poe"
    path.write_text(f"{head}\n0.1,{rows.strip(',')}\n0.2,{rows.strip(',')}\n")
    with pytest.raises(dd.errors.InputError, match="inf"):
        dd.HazardCurve.from_csv(path)


@pytest.mark.parametrize(("column", "value"), [("side", "1e300"), ("time_s", "1e308")])
def test_histories_beyond_all_bounds(column, value, wall, sine, run, tmp_path):
    """Cells that no integer or quotient can hold; the check sum is made right, so that they are read."""
    (tmp_path / "r.txt").write_text(SAMPLES)
    (tmp_path / "records.csv").write_text("file,dt_s,units\nr.txt,0.1,m/s2\n")
    (tmp_path / "case.nml").write_text(
        "&job task = 'history' output = 'x' /\n&wall mechanism = 'one_sided' height = 3 thickness = 0.3 /\n"
        "&records catalogue = 'records.csv' /\n&history record = 1 im_level = 0.4 /\n"
    )
    assert run("--quiet", "case.nml").returncode == 0
    path, described_by = tmp_path / "x_history.csv", tmp_path / "x_run.json"
    lines = path.read_text().splitlines()
    first = next(i for i, line in enumerate(lines) if line[0] != "#")
    cells = lines[-1].split(",")
    cells[lines[first].split(",").index(column)] = value
    path.write_text("\n".join([*lines[:-1], ",".join(cells)]) + "\n")
    told = json.loads(described_by.read_text())
    for one in told["files"]:
        if one["name"] == "_history.csv":
            one |= described("_history.csv", path.read_text())._asdict()
    described_by.write_text(json.dumps(told))
    with pytest.raises(dd.errors.InputError, match=r"x_history\.csv") if column == "side" else contextlib.nullcontext():
        dd.read_results(tmp_path / "x")
