"""What offices work with: tables with decimal commas, workbooks, reports as PDF; installed examples and commands."""

import re
import shutil
import subprocess
import sys

import numpy as np
import pytest
from browsers import needs_browser

import dondolo as dd

RECORD = "tempo (s);acc (m/s2)\n" + "".join(
    f"{0.01 * i:.2f};{3.0 * np.sin(0.2 * i):.6f}\n".replace(".", ",") for i in range(400)
)
TABLES = {
    "records.csv": "file;dt_s;units\nr.csv;0,01;m/s2\n",
    "r.csv": RECORD,
    "walls.csv": "name;mechanism;height;thickness\nsommità;one_sided;3,25;0,25\npiano terra;one_sided;1;0,5\n",
    "hazard.csv": "ag (g);return_period\n0,05;30\n0,1;100\n0,25;475\n0,5;2475\n",
}


def as_excel(text, encoding):
    """A file as a spreadsheet saves it: CRLF, and a byte order mark where the encoding has one."""
    return text.replace("\n", "\r\n").encode(encoding)


@pytest.mark.parametrize("encoding", ["utf-8-sig", "utf-16"])
def test_tables_with_decimal_commas(encoding, tmp_path):
    for name, text in TABLES.items():
        (tmp_path / name).write_bytes(as_excel(text, encoding))
    with pytest.warns(dd.errors.DondoloWarning, match="semicolons, decimal commas"):
        (record,) = dd.read_catalogue(tmp_path / "records.csv")
    assert record.dt == 0.01
    assert np.allclose(record.acceleration, 3.0 * np.sin(0.2 * np.arange(400)), atol=1e-6, rtol=0.0)
    with pytest.warns(dd.errors.DondoloWarning, match="semicolons, decimal commas"):
        population = dd.Population.from_csv(tmp_path / "walls.csv")
    first, second = population.walls
    assert (first.name, first.height, first.thickness) == ("sommità", 3.25, 0.25)
    assert (second.height, second.thickness) == (1.0, 0.5)
    with pytest.warns(dd.errors.DondoloWarning, match="ag is taken for the PGA|semicolons, decimal commas"):
        hazard = dd.HazardCurve.from_csv(tmp_path / "hazard.csv")
    assert np.allclose(hazard.annual_frequency, 1.0 / np.array([30.0, 100.0, 475.0, 2475.0]), rtol=1e-12)


def test_what_is_ambiguous_is_refused(tmp_path):
    table = tmp_path / "walls.csv"
    table.write_text("name;mechanism;height;thickness\na;one_sided;1.800;1,800\n")
    with pytest.raises(dd.errors.InputError, match="height"):
        dd.Population.from_csv(table)
    # One thousand, or one?
    table.write_text("name;mechanism;height;thickness\na;one_sided;1.000;0,5\n")
    with pytest.raises(dd.errors.InputError, match="with a decimal comma as elsewhere in the table and no point"):
        dd.Population.from_csv(table)
    table.write_bytes("name;mechanism;height;thickness\nà;one_sided;3;0,25\n".encode("cp1252"))
    with pytest.raises(dd.errors.InputError, match="save it as UTF-8"):
        dd.Population.from_csv(table)


@pytest.fixture
def run(executable, tmp_path, root):
    """Result files of a wall whose name looks like a formula."""
    (tmp_path / "case.nml").write_text(
        "&job output = 'wall' / &wall name = '=1+1' mechanism = 'one_sided' height = 1.5 thickness = 0.25 /\n"
        f"&records catalogue = '{root}/data/records/synthetic44.csv' / &stripes levels = 0.6, 0.8, 1.0, 1.2 /\n"
    )
    subprocess.run([executable, "--quiet", "case.nml"], cwd=tmp_path, check=True, capture_output=True)
    return tmp_path / "wall"


def test_workbook(run):
    openpyxl = pytest.importorskip("openpyxl")
    path = run.with_name("wall_tables.xlsx")
    dd.write_workbook(run, path)
    book = openpyxl.load_workbook(path)
    stored = dd.read_results(run)
    assert book.sheetnames == ["case", *(name.name[1:].removesuffix(".csv") for name in stored.run.files)]
    titles, *rows = book["histories"].iter_rows(values_only=True)
    column = titles.index("edp")
    assert [row[column] for row in rows] == pytest.approx(stored.stripes.edp.ravel().tolist(), rel=1e-15)
    # A name is no formula, and no number in a text
    cell = next(cell for row in book["walls"].iter_rows() for cell in row if cell.value == "=1+1")
    assert cell.data_type == "s"
    first = path.read_bytes()
    dd.write_workbook(run, path)
    assert path.read_bytes() == first
    path.write_text("notes of the office")
    with pytest.raises(dd.errors.InputError, match="is not a workbook of dondolo"):
        dd.write_workbook(run, path)


# What no sheet of an Italian workbook may have
ENGLISH = (
    "the of and with from wall walls check not is are tie load section hinge record records year years mass level unit"
    " value histories collapse collapses at by for on yes height thickness weight status mechanism median"
)


@pytest.mark.parametrize("case", ["tied_facade", "uncertain_strip", "designs", "facade_hinges", "history"])
def test_an_italian_workbook(case, executable, root, tmp_path):
    """The same numbers under Italian heads: no word is left in English but names, identifiers and messages."""
    openpyxl = pytest.importorskip("openpyxl")
    text = (root / f"data/cases/{case}.nml").read_text()
    (tmp_path / "case.nml").write_text(re.sub("'\\.\\./", f"'{root}/data/", text).replace(f"'out/{case}'", "'out'"))
    subprocess.run([executable, "--quiet", "case.nml"], cwd=tmp_path, check=True, capture_output=True)
    books = []
    for lang in ("en", "it"):
        dd.write_workbook(tmp_path / "out", tmp_path / f"{lang}.xlsx", lang=lang)
        books.append(openpyxl.load_workbook(tmp_path / f"{lang}.xlsx"))
    english, italian = books
    assert len(english.sheetnames) == len(italian.sheetnames)
    # Excel's own name for changes
    assert "history" not in map(str.lower, english.sheetnames)
    assert not set(italian.sheetnames) & set(english.sheetnames)
    for name, its in zip(english.sheetnames, italian.sheetnames, strict=True):
        names, *rows = english[name].iter_rows(values_only=True)
        heads, *theirs = italian[its].iter_rows(values_only=True)
        assert [head for head, one in zip(heads, names, strict=True) if "_" in head.replace("_E", "").replace("_R", "")
                .replace("a_g", "")] == []  # fmt: skip
        numbers = [[[x for x in row if isinstance(x, int | float)] for row in some] for some in (rows, theirs)]
        assert numbers[0] == numbers[1]
        words = set(re.findall(r"(?<![\w./-])[a-z]+(?![\w./-])", " ".join(heads).lower()))
        if "item" in names or "meaning" in names:
            cells = [row[i] for row in theirs for i, one in enumerate(names) if one in ("item", "meaning", "method")]
            words |= set(re.findall(r"(?<![\w./-])[a-z]+(?![\w./-])", " ".join(map(str, cells)).lower()))
        assert words & set(ENGLISH.split()) == set()
    sheet = italian[italian.sheetnames[1]]
    assert all(column.width >= 9 for column in sheet.column_dimensions.values())
    assert any(cell.number_format != "General" for row in sheet.iter_rows(min_row=2) for cell in row)


@pytest.mark.parametrize("name", ["<r>b</r>", "<r></r>", "<r>a & b", '"<&>"', "=SUM(A1)", "{=1}", "https://x.org"])
def test_names_in_a_workbook_are_texts(name, few, tmp_path):
    """Neither tags nor formulas nor links."""
    openpyxl = pytest.importorskip("openpyxl")
    wall = dd.OneSidedWall(1.5, 0.25, name=name)
    dd.multiple_stripe(wall, few, [0.6, 1.0], progress=False).write_results(tmp_path / "out")
    dd.write_workbook(tmp_path / "out", tmp_path / "out.xlsx")
    cell = openpyxl.load_workbook(tmp_path / "out.xlsx")["stripes"]["A2"]
    assert (cell.value, cell.data_type, cell.hyperlink) == (name, "s", None)


def test_a_workbook_has_its_suffix(run):
    pytest.importorskip("xlsxwriter")
    with pytest.raises(dd.errors.InputError, match=r"path = .*wall.xls': must end in .xlsx"):
        dd.write_workbook(run, run.with_name("wall.xls"))


@pytest.mark.skipif(sys.platform == "win32", reason="limits of POSIX")
@pytest.mark.parametrize("share", [0.3, 0.9])
def test_a_workbook_without_room_is_one_line(share, run, tmp_path):
    """Files that may not be as long as the workbook: nothing is written, and nothing else is said."""
    pytest.importorskip("xlsxwriter")
    dd.write_workbook(run, tmp_path / "whole.xlsx")
    size = int(share * (tmp_path / "whole.xlsx").stat().st_size / 1024.0)
    limited = ["bash", "-c", f'ulimit -f {size}; exec "$@"', "bash", sys.executable, "-m", "dondolo", "xlsx", run]
    done = subprocess.run([*limited, "-o", tmp_path / "a.xlsx"], capture_output=True, text=True, check=False)
    (line,) = done.stderr.splitlines()
    assert done.returncode == 1
    assert re.fullmatch(r"dondolo: .*a\.xlsx: .*cannot be written.*: File too large", line)
    assert [path.name for path in tmp_path.glob("*.xlsx*")] == ["whole.xlsx"]


def test_a_full_disk_leaves_no_workbook(run, tmp_path, monkeypatch):
    """The disk is full when the workbook takes its place: what packs it has nothing half open."""
    pytest.importorskip("xlsxwriter")
    from pathlib import Path

    def full(self, content):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(Path, "write_bytes", full)
    unraisable = []
    monkeypatch.setattr(sys, "unraisablehook", unraisable.append)
    with pytest.raises(dd.errors.DondoloError, match=r"a\.xlsx: cannot be written: No space left on device"):
        dd.write_workbook(run, tmp_path / "a.xlsx")
    assert (list(tmp_path.glob("*.xlsx*")), unraisable) == ([], [])


def test_no_xlsxwriter(run, monkeypatch):
    monkeypatch.setitem(sys.modules, "xlsxwriter", None)
    with pytest.raises(dd.errors.DondoloError, match="XlsxWriter is not installed"):
        dd.write_workbook(run, run.with_name("wall.xlsx"))


def test_report_as_pdf_needs_a_printer(run, monkeypatch):
    monkeypatch.setattr(shutil, "which", lambda name: None)
    monkeypatch.setitem(sys.modules, "weasyprint", None)
    path = run.with_name("report.pdf")
    with pytest.raises(dd.errors.DondoloError, match="needs Chromium or WeasyPrint"):
        dd.report(dd.read_results(run), path)
    assert list(run.parent.glob("report*")) == []


@pytest.mark.slow
@needs_browser
def test_report_as_pdf(run):
    path = run.with_name("report.pdf")
    dd.report(dd.read_results(run), path)
    data = path.read_bytes()
    assert data.startswith(b"%PDF")
    run_name = dd.read_results(run).run.run
    assert data.rstrip().endswith(f"% dondolo report {dd.__version__} of run {run_name}".encode())
    # An earlier report is replaced, another PDF is not.
    dd.report(dd.read_results(run), path)
    if shutil.which("pdftotext") is not None:
        text = subprocess.run(["pdftotext", path, "-"], capture_output=True, text=True, check=True).stdout
        pages, text = text.count("\f"), text.replace(" ", "")
        assert [f"{page}/{pages}" in text for page in range(1, pages + 1)] == [True] * pages
    path.write_bytes(b"%PDF-1.4 of somebody else")
    with pytest.raises(dd.errors.InputError, match="is not a report of dondolo"):
        dd.report(dd.read_results(run), path)


def test_example_records(records):
    installed = dd.example_records()
    assert [one.name for one in installed] == [one.name for one in records]
    assert all(np.array_equal(a.acceleration, b.acceleration) for a, b in zip(installed, records, strict=True))


def test_commands_are_those_of_the_executable(executable):
    """The executable hands over every command of `python -m dondolo`, and no other."""
    script = subprocess.run([executable, "--completion", "bash"], capture_output=True, text=True, check=True).stdout
    line = next(line for line in script.splitlines() if '" run ' in line)
    offered = line.split('" run ')[1].split('"')[0].split()
    from dondolo.__main__ import _parser

    (commands,) = (action.choices for action in _parser()._actions if action.choices)
    assert sorted(offered) == sorted(commands)


NAMES = ["1.1", "1.10", "1.2", "2E1", "007", "-0.5", "1e400"]


def _table(path):
    groups = ["1", "1.0", "01", "1", "1.0", "01", "1"]
    rows = "".join(f"{name},{group},one_sided,{1.5 + 0.1 * i},0.25\n" for i, (name, group) in enumerate(
        zip(NAMES, groups, strict=True)))  # fmt: skip
    path.write_text("name,group,mechanism,height,thickness\n" + rows)
    return groups


@pytest.mark.filterwarnings("ignore::dondolo.errors.DondoloWarning")
@pytest.mark.parametrize("lang", ["en", "it"])
def test_names_that_look_like_numbers(lang, executable, root, tmp_path):
    """Texts stay texts by every route: workbook, frames, results read and written again."""
    openpyxl = pytest.importorskip("openpyxl")
    groups = _table(tmp_path / "walls.csv")
    (tmp_path / "case.nml").write_text(
        "&job task = 'typology', output = 'out' / &population file = 'walls.csv' /\n"
        f"&records catalogue = '{root}/data/records/synthetic44.csv' / &stripes levels = 0.6, 0.8, 1.0, 1.2 /\n"
    )
    subprocess.run([executable, "--quiet", "case.nml"], cwd=tmp_path, check=True, capture_output=True)
    found = dd.read_results(tmp_path / "out")
    found.write_results(tmp_path / "again")
    for prefix in ("out", "again"):
        dd.write_workbook(tmp_path / prefix, tmp_path / f"{prefix}.xlsx", lang=lang)
        book = openpyxl.load_workbook(tmp_path / f"{prefix}.xlsx")
        sheet = book["pareti" if lang == "it" else "walls"]
        head, *rows = sheet.iter_rows()
        for title, expected in (("wall", NAMES), ("group", groups)):
            italian = {"wall": "parete", "group": "gruppo"}[title]
            at = [cell.value for cell in head].index(italian if lang == "it" else title)
            assert [(row[at].value, row[at].data_type) for row in rows] == [(one, "s") for one in expected]
        heights = [row[2].value for row in rows]
        assert all(isinstance(one, int | float) for one in heights)
    pandas = pytest.importorskip("pandas")
    assert found.population.to_frame()["wall"].tolist() == NAMES
    assert found.typology.to_frame("fragility")["wall"].tolist() == NAMES
    # As the page says
    kinds = {"wall": str, "group": str}
    frame = pandas.read_csv(tmp_path / "out_walls.csv", comment="#", dtype=kinds)
    assert (frame["wall"].tolist(), frame["group"].tolist()) == (NAMES, groups)


def test_a_frame_with_names_that_are_floats(tmp_path):
    """Pandas reads 1.10 as 1.1: a float is no name."""
    pandas = pytest.importorskip("pandas")
    _table(tmp_path / "walls.csv")
    frame = pandas.read_csv(tmp_path / "walls.csv", dtype={"name": str, "group": str})
    assert [wall.name for wall in dd.Population.from_frame(frame).walls] == NAMES
    for column in ("name", "group"):
        wrong = frame.assign(**{column: [0.1 * i for i in range(len(frame))]})
        message = rf"frame\.iloc\[0\]: {column} = 0\.0: must be a string .*dtype=\{{'{column}': str\}}"
        with pytest.raises(dd.errors.InputError, match=message):
            dd.Population.from_frame(wrong)
    # Whole numbers have one form
    assert dd.Population.from_frame(frame.assign(name=range(len(frame))))[3].name == "3"
