"""The cases solved by hand in docs/studies/cases_by_hand.md and docs/studies/casi_prova.md, against the executable."""

import csv
import re
import subprocess

import pytest

CASES = ("facade", "strip", "tie", "weakest", "parapet", "left_out")
# Files whose rows begin with their names in the part of another
OTHERS = ("tied",)
PAGES = ("docs/studies/cases_by_hand.md", "docs/studies/casi_prova.md")


def rows_of(text):
    """Rows of the tables of a page."""
    return [[cell.strip() for cell in line.strip("|").split("|")] for line in text.splitlines() if line[:1] == "|"]


def table(path):
    """A table of results."""
    return list(csv.DictReader(line for line in path.read_text().splitlines() if not line.startswith("#")))


@pytest.fixture(scope="module")
def results(root, executable, tmp_path_factory):
    """Sheets and items of the cases."""
    folder = tmp_path_factory.mktemp("hand")
    for case in (*CASES, *OTHERS):
        subprocess.run([executable, "--quiet", root / f"docs/casi_prova/{case}.nml"], cwd=folder, check=True)
    return {
        case: [table(folder / f"out/{case}_by_hand_{name}.csv") for name in ("check", "calculation")]
        for case in (*CASES, *OTHERS)
    }


@pytest.mark.parametrize("page", PAGES)
def test_pages(root, results, page):
    """Every number of a page is the program's."""
    parts = re.split(r"(?m)^## ", (root / page).read_text(encoding="utf-8"))[1:]
    assert len(parts) == len(CASES)
    for case, part in zip(CASES, parts, strict=True):
        sheet, items = results[case]
        known = {(row["method"], row["limit_state"], row["quantity"]): float(row["value"]) for row in sheet}
        for other in OTHERS:
            known |= {
                (f"{other} {row['method']}", row["limit_state"], row["quantity"]): float(row["value"])
                for row in results[other][0]
            }
        compared = 0
        for cells in rows_of(part):
            if not (found := re.fullmatch(r"`((?:tied )?\w+)(?: (SL[DVC]))? (\w+)`", cells[0])):
                continue
            value = known[found[1], found[2] or "", found[3]]
            assert float(cells[-1]) == pytest.approx(value, rel=1e-11), (case, cells[0])
            compared += 1
        assert compared >= 7
        if case not in ("facade", "strip", "weakest"):
            continue
        # The items, in the order of the program, before the row of the sums
        mine = [cells for cells in rows_of(part) if len(cells) in (6, 9)][2:-1]
        names = ("force_n_m", "depth_m", "arm_m", "lever_m", "stabilising_nm_m", "overturning_nm_m")
        names += ("force_lever_nm_m", "force_lever2_nm2_m")
        if case in ("strip", "weakest"):
            names = ("force_n_m", "arm_m", "stabilising_nm_m", "lever_m", "force_lever_nm_m")
        order = ["section 1", "section 2", "load 1", "load 2", "thrust 1", "masonry"]
        order = ["lower block", "upper block", "load on top"] if case in ("strip", "weakest") else order
        item_of = {item["item"]: item for item in items}
        for name, cells in zip(order, mine, strict=True):
            for column, cell in zip(names, cells[1:], strict=True):
                if cell:
                    assert float(cell) == pytest.approx(float(item_of[name][column]), rel=1e-11), (name, column)


def test_both_languages_have_the_same_numbers(root):
    numbers = [re.findall(r"\d+\.\d{8,}", (root / page).read_text(encoding="utf-8")) for page in PAGES]
    assert sorted(numbers[0]) == sorted(numbers[1])
    assert len(numbers[0]) > 60
