"""Rows of a workbook of Excel (.xlsx), by the standard library: numbers and texts, nothing else."""

import re
import zipfile
from pathlib import Path
from xml.etree import ElementTree

NAMES = "{http://schemas.openxmlformats.org/spreadsheetml/2006/main}"


def rows(path: Path) -> list[list[str]]:
    """Cells of the first sheet, row by row, as text; empty cells are empty strings.

    Parameters
    ----------
    path : Path
        The workbook.

    Returns
    -------
    list of list of str
        Rows that have a cell, from column A on.
    """
    with zipfile.ZipFile(path) as archive:
        shared = _shared_strings(archive)
        sheets = sorted(
            (name for name in archive.namelist() if re.fullmatch(r"xl/worksheets/sheet\d+\.xml", name)),
            key=lambda name: int(re.findall(r"\d+", name)[0]),
        )
        tree = ElementTree.fromstring(archive.read(sheets[0]))
    found = []
    for row in tree.iter(NAMES + "row"):
        cells: dict[int, str] = {}
        for cell in row.iter(NAMES + "c"):
            text = _text(cell, shared)
            if text is not None:
                cells[_column(cell.attrib["r"])] = text
        if cells:
            found.append([cells.get(i, "") for i in range(max(cells) + 1)])
    return found


def _shared_strings(archive: zipfile.ZipFile) -> list[str]:
    """Texts that cells refer to by number."""
    if "xl/sharedStrings.xml" not in archive.namelist():
        return []
    tree = ElementTree.fromstring(archive.read("xl/sharedStrings.xml"))
    return ["".join(part.text or "" for part in item.iter(NAMES + "t")) for item in tree.iter(NAMES + "si")]


def _text(cell: ElementTree.Element, shared: list[str]) -> str | None:
    """Content of a cell, None if it is empty."""
    value = cell.find(NAMES + "v")
    if value is not None and value.text is not None:
        return shared[int(value.text)] if cell.get("t") == "s" else value.text
    inline = cell.find(NAMES + "is")
    return None if inline is None else "".join(part.text or "" for part in inline.iter(NAMES + "t"))


def _column(reference: str) -> int:
    """Number of the column of a cell such as AB12, from 0."""
    number = 0
    for letter in re.match(r"[A-Z]+", reference)[0]:
        number = 26 * number + ord(letter) - ord("A") + 1
    return number - 1
