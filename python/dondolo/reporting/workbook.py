"""The tables of a run as a workbook of Excel or LibreOffice, where numbers are numbers whatever the decimal mark."""

from __future__ import annotations

import io
import math
import os
import re
import tempfile
import zipfile
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from dondolo._base.files import as_file
from dondolo._base.wording import named, say
from dondolo._fortran.files import REAL, RUN_FILE, TEXT, Column, whole_file
from dondolo._fortran.origins import check_replaced, derived_mark
from dondolo._fortran.walls import is_note
from dondolo._storage.run_file import RunFile, read_run_file
from dondolo._storage.tables import digits
from dondolo.errors import DondoloError, InputError, visible
from dondolo.exchange.result_file import ResultFile
from dondolo.reporting.language import Language
from dondolo.reporting.words import heading, in_words, warning

# Rows that a sheet of Excel has
_MOST_ROWS = 2**20

# What a sheet can be called
_SHEET = re.compile(r"[A-Za-z0-9_-]{1,31}")
# Numbers and characters that a cell can have
_LARGEST = 9.99999999999999e307
_LONGEST = 32767

# A sheet of Excel cannot be called History, which is its own name for changes.
_OTHERWISE = {"history": "time_history"}

# Pixels of a letter in the font of workbooks
_LETTER = 7

# Narrowest and widest column, in letters, rows that its width is made for, and letters of a line of a title
_WIDTHS, _LOOKED_AT, _HEAD = (9, 48), 200, 18

# Titles and columns
_Sheet = tuple[list[str], Sequence[Sequence[Any]]]


def write_workbook(prefix: str | os.PathLike[str], path: str | os.PathLike[str], *, lang: str | None = None) -> None:
    """Write all tables of a run into one workbook: one sheet per table, and one of the case.

    Parameters
    ----------
    prefix : path
        Prefix of the result files, for example ``out/parapet``.
    path : path
        The workbook, ``*.xlsx``. An earlier workbook of dondolo is replaced unless another program has saved it
        since; any other file is not.
    lang : {'en', 'it'}, optional
        Language of sheets, titles and words; that of the environment variable ``DONDOLO_LANG`` if left out, or English,
        which has the names of the files. Names, identifiers of the case and messages of the library are not translated.
        Numbers are those of the files, in units of the SI, in both languages.

    Raises
    ------
    InputError
        Another suffix; the tables are not those of a run; one has more rows than a sheet; another file has the name of
        the workbook.
    DondoloError
        XlsxWriter is not installed; the workbook cannot be written.

    Examples
    --------
    >>> import dondolo as dd
    >>> walls = dd.Population([dd.OneSidedWall(1.5, 0.25, name="a"), dd.OneSidedWall(1.8, 0.25, name="b")])
    >>> records = dd.synthetic_records(6.5, 10.0, "shallow", n_records=10)
    >>> dd.typology(walls, records, [0.6, 0.8, 1.0], progress=False).write_results("parapets")
    >>> dd.write_workbook("parapets", "parapets.xlsx")
    """
    try:
        import xlsxwriter  # noqa: F401
    except ImportError:
        raise DondoloError(
            "XlsxWriter is not installed: pip install XlsxWriter; spreadsheets open the CSV files too"
        ) from None
    language = Language(lang)
    target = as_file("path", path, ".xlsx")
    check_replaced(target, "workbook")
    as_file("prefix", prefix)
    run = read_run_file(os.fspath(prefix) + RUN_FILE)
    with language.in_force():
        case = [list(column) for column in zip(*_case(run, language), strict=True)]
    sheets: dict[str, _Sheet] = {"case": (["group", "variable", "value"], case)}
    for written in run.files:
        table = ResultFile(os.fspath(prefix) + written.name, run)
        table.check()
        if len(table) >= _MOST_ROWS:
            raise InputError(f"{table.path}: has {len(table)} rows, more than a sheet of a workbook can have")
        columns = [_values(table.column(column)) for column in table]
        name = written.name.removeprefix("_").removesuffix(".csv")
        # To spreadsheets Walls is walls.
        if not _SHEET.fullmatch(name) or name.lower() in map(str.lower, sheets):
            raise InputError(f"{run.path}: files: '{written.name}' is not the name of a table")
        sheets[name] = (list(table), columns)
    with language.in_force():
        content = _packed(sheets, run, target)
    with whole_file(target) as part:
        part.write_bytes(content)


def _packed(sheets: dict[str, _Sheet], run: RunFile, target: Path) -> bytes:
    """A workbook, packed in memory: XlsxWriter leaves a file half open that a full disk has no room for."""
    from xlsxwriter import Workbook
    from xlsxwriter.exceptions import FileCreateError

    packed = io.BytesIO()
    try:
        with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as folder:
            # One row at a time is in memory.
            book = Workbook(packed, {"constant_memory": True, "tmpdir": folder, "use_zip64": True})
            # The same bytes for the same run: the date is that of the run, with which its name begins.
            book.set_properties({"author": "dondolo", "created": run.begun})
            for name, (titles, cells) in sheets.items():
                title = named("name of a sheet", name, _OTHERWISE.get(name, name))
                _add_sheet(book, title, [heading(one) for one in titles], _in_words(titles, cells))
            book.close()
    except (OSError, FileCreateError) as error:
        reason = error if isinstance(error, OSError) else error.args[0]
        raise DondoloError(
            f"{target}: its temporary files cannot be written in {tempfile.gettempdir()}: {reason.strerror}"
        ) from None
    with zipfile.ZipFile(packed, "a") as archive:
        # Spreadsheets drop it when they save the workbook, which is the user's own from then on.
        archive.comment = derived_mark("workbook", run.run).encode()
    return packed.getvalue()


def _in_words(titles: list[str], columns: Sequence[Sequence[Any]]) -> Sequence[Sequence[Any]]:
    """Columns whose words are those of the language in force."""
    known = dict(zip(titles, columns, strict=True))
    made: list[Sequence[Any]] = []
    for title, cells in known.items():
        if title == "meaning":
            cells = [named("quantity of a check", *pair) for pair in zip(known["quantity"], cells, strict=True)]
        elif title not in ("wall", "group", "value") and not is_note(title):
            cells = [in_words(title, one) if isinstance(one, str) else one for one in cells]
        made.append(cells)
    return made


def _case(run: RunFile, language: Language) -> list[list[Any]]:
    """Rows of the case: version, settings and warnings."""
    rows: list[list[Any]] = [["", "dondolo", run.version]]
    for group, settings in run.settings.items():
        for name, value in settings.items():
            if isinstance(value, (list, tuple)):
                value = " ".join(map(str, value))
            is_plain = value is None or isinstance(value, (bool, str)) or _is_number(value)
            rows.append([group, name, value if is_plain else str(value)])
    return rows + [["", say("warning"), warning(language, one)] for one in run.warnings]


def _values(column: Column) -> Sequence[Any]:
    """Cells of a column: texts, or numbers with None where there is none; one that no cell can have is a text."""
    if column.kind == TEXT:
        return list(column.values)
    cells: list[Any] = []
    for one in np.asarray(column.values).tolist():
        if one != one:
            cells.append(None)
        elif column.kind != REAL and one.is_integer():
            cells.append(int(one))
        else:
            cells.append(one if _is_number(one) else digits(one))
    return cells


def _is_number(value: Any) -> bool:
    """Whether a value is a number that a cell can have."""
    return isinstance(value, (int, float)) and abs(value) < _LARGEST


def _format(cells: Sequence[Any]) -> str:
    """How the numbers of a column are shown: alike, the greatest with four figures; what cells hold has all of them."""
    numbers = [abs(one) for one in cells if isinstance(one, float) and math.isfinite(one) and one]
    if not numbers:
        return "General"
    power = math.floor(math.log10(max(numbers)))
    # Numbers of very different sizes, as fits of tails are, have powers of ten
    if not -4 <= power <= 8 or min(numbers) < 1e-3 * 10.0 ** min(power, 0):
        return "General" if -4 <= power <= 8 else "0.000E+00"
    return "0" if power >= 4 else f"0.{'0' * max(1, 3 - power)}"


def _width(title: str, cells: Sequence[Any], shown: str) -> int:
    """Width of a column: its cells, and its title in lines, fit."""
    texts = [
        len(one) if isinstance(one, str) else 11 if isinstance(one, float) and shown == "General" else 9
        for one in cells[:_LOOKED_AT]
        if one is not None
    ]
    words = [*map(len, title.split()), min(len(title), _HEAD)]
    return 2 + min(_WIDTHS[1], max(_WIDTHS[0], *words, *texts))


def _add_sheet(book: Any, name: str, titles: list[str], columns: Sequence[Sequence[Any]]) -> None:
    """Add a sheet, whose titles stay in sight; columns are as wide as what they hold, numbers are numbers."""
    sheet = book.add_worksheet(name)
    sheet.freeze_panes(1, 0)
    head = book.add_format({"bold": True, "text_wrap": True, "valign": "top"})
    formats = [_format(cells) for cells in columns]
    for place, (title, cells, shown) in enumerate(zip(titles, columns, formats, strict=True)):
        sheet.set_column_pixels(place, place, _LETTER * _width(title, cells, shown))
        _write_text(sheet, 0, place, title, head)
    looks = [None if shown == "General" else book.add_format({"num_format": shown}) for shown in formats]
    write_number = sheet.write_number
    for place, row in enumerate(zip(*columns, strict=True), 1):
        for column, value in enumerate(row):
            if isinstance(value, float):
                write_number(place, column, value, looks[column])
            elif isinstance(value, str):
                if value:
                    _write_text(sheet, place, column, value)
            elif isinstance(value, bool):
                sheet.write_boolean(place, column, value)
            elif value is not None:
                write_number(place, column, value)


def _write_text(sheet: Any, row: int, column: int, text: str, *look: Any) -> None:
    """Write a text as such: a name that begins with = is no formula, and one in tags no part of the workbook."""
    text = visible(text)[:_LONGEST]
    if text.startswith("<r>") and text.endswith("</r>"):
        # XlsxWriter takes it for text of several fonts that has been written before: it is given as such.
        from xlsxwriter.format import Format

        sheet.write_rich_string(row, column, text[:1], Format(), text[1:], *look)
    else:
        sheet.write_string(row, column, text, *look)
