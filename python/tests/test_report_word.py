"""Reports in Word: the chapters, tables, figures and sentences of the page, of which both are views."""

import html
import re
import subprocess
import sys

import matplotlib
import numpy as np
import pytest

import dondolo as dd

matplotlib.use("agg")
docx = pytest.importorskip("docx")
pytestmark = pytest.mark.slow

HAZARD = dd.HazardCurve([0.02, 0.1, 0.5, 2.5], [0.1, 0.01, 3e-4, 2e-6])


@pytest.fixture(scope="module")
def results(stripes, wall, few, records):
    """What reports are of, by a name."""
    walls = [dd.OneSidedWall(1.5 + 0.1 * i, 0.25, name=f"wall {i}") for i in range(4)]
    population = dd.Population(walls, group_names=["low", "low", "high", "high"])
    people = dd.typology(population, few, [0.3, 0.5, 0.7, 0.9, 1.2], edp_thresholds=[0.3], progress=False)
    return {"typology": people, "stripes": stripes, "history": dd.simulate(wall, records[6])}


@pytest.fixture(scope="module")
def pairs(results, wall, tmp_path_factory):
    """The page and the file of Word of each, in both languages."""
    folder, made = tmp_path_factory.mktemp("word"), {}
    for name, one in results.items():
        given = {} if name == "history" else {"hazard": HAZARD}
        if name == "stripes":
            given["check"] = dd.check_ntc(one.wall, dd.Site(0.2, 2.5, 0.35))
        for lang in ("en", "it"):
            for suffix in ("html", "docx"):
                dd.report(one, folder / f"{name}_{lang}.{suffix}", lang=lang, title="A <title>", **given)
            page = (folder / f"{name}_{lang}.html").read_text(encoding="utf-8")
            made[name, lang] = page, docx.Document(str(folder / f"{name}_{lang}.docx"))
    return made


KINDS = [(name, lang) for name in ("typology", "stripes", "history") for lang in ("en", "it")]


def plain(text):
    """Words of HTML or of Word, without marks and blanks."""
    text = html.unescape(re.sub(r"<[^>]+>", "", text)).replace("\N{ZERO WIDTH SPACE}", "")
    return "".join(text.split())


def rows_of(page):
    """Cells of all tables with captions."""
    tables = (re.findall("<tr.*?</tr>", one, re.S) for one in re.findall("<table.*?</table>", page, re.S))
    return [[[plain(cell) for cell in re.findall("<t[hd].*?</t[hd]>", row, re.S)] for row in one] for one in tables]


@pytest.mark.parametrize("kind", KINDS)
def test_tables_are_those_of_the_page(kind, pairs):
    page, file = pairs[kind]
    shown = [[[plain(cell.text) for cell in row.cells] for row in table.rows] for table in file.tables]
    expected = rows_of(page)
    assert len(expected) > 4 or kind[0] == "history"
    captioned = [table for table in shown if table in expected]
    assert captioned == expected
    # What has no caption: facts and cards, whose terms the page has too
    text = plain(page)
    for table in shown:
        assert all(cell in text for row in table for cell in row)


@pytest.mark.parametrize("kind", KINDS)
def test_chapters_sentences_and_figures_are_those_of_the_page(kind, pairs):
    page, file = pairs[kind]
    # The foot of each has the minute in which it was written.
    body = page.partition("<body>")[2].partition("<footer>")[0]
    assert f"dondolo {dd.__version__}" in file.paragraphs[-1].text
    heads = [one.text.partition(". ")[2] for one in file.paragraphs if one.style.name == "Heading 1"]
    assert heads == [html.unescape(one) for one in re.findall("<h2>(.*?)</h2>", body)]
    folded = [one.text for one in file.paragraphs if one.style.name == "Heading 3"]
    assert folded == [html.unescape(one) for one in re.findall("<summary>(.*?)</summary>", body)]
    words = plain(" ".join(one.text for one in file.paragraphs))
    for sentence in re.findall(r"<(?:p|li|h3|figcaption|caption)\b[^>]*>(?!<a )(.*?)</", body, re.S):
        assert plain(re.split("<", sentence)[0]) in words
    xml = file.element.xml
    alts = [html.unescape(one) for one in re.findall(r'<wp:docPr [^>]*descr="([^"]*)"', xml)]
    assert alts == [html.unescape(one) for one in re.findall(r'<img [^>]*alt="([^"]*)"', body)]
    assert len(file.inline_shapes) == len(alts) > 0


def test_letters_beside_numbers_and_titles_are_plain(pairs):
    """No markup reaches Word, and the title is what was given."""
    for _page, file in pairs.values():
        assert file.paragraphs[1].text == "A <title>"
        assert file.core_properties.title == "A <title>"
        assert not re.search(r"</?(?:p|sub|sup|i|span)\b", " ".join(one.text for one in file.paragraphs))


def test_decimal_marks_are_those_of_the_language(pairs):
    for (name, lang), (_page, file) in pairs.items():
        cells = [cell.text for table in file.tables for row in table.rows for cell in row.cells[1:]]
        numbers = [one for one in cells if re.fullmatch(r"\d+[.,]\d+", one)]
        assert len(numbers) > 2, name
        assert all(("," in one) == (lang == "it") for one in numbers), (name, lang)


def test_word_needs_python_docx(stripes, monkeypatch, tmp_path):
    monkeypatch.setitem(sys.modules, "docx", None)
    monkeypatch.setattr("dondolo.reporting.page.gather", lambda *rest: pytest.fail("has begun"))
    with pytest.raises(dd.errors.DondoloError, match="python-docx is not installed"):
        dd.report(stripes, tmp_path / "report.docx")
    assert not list(tmp_path.iterdir())


def test_only_reports_are_replaced(stripes, tmp_path):
    path = tmp_path / "report.docx"
    path.write_bytes(b"PK\3\4")
    with pytest.raises(dd.errors.InputError, match="exists, and is not a report of dondolo"):
        dd.report(stripes, path)
    path.unlink()
    dd.report(stripes, path)
    dd.report(stripes, path, title="again")
    assert docx.Document(str(path)).core_properties.title == "again"


def test_command(executable, root, tmp_path):
    subprocess.run([executable, "--quiet", root / "data/cases/parapet.nml"], cwd=tmp_path, check=True)
    command = [sys.executable, "-m", "dondolo", "report", "out/parapet", "-o", "r.docx", "--lang", "it"]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=True)
    assert done.stdout == "written: r.docx\n"
    file = docx.Document(str(tmp_path / "r.docx"))
    curve = dd.read_results(tmp_path / "out/parapet").fragility
    cells = [cell.text for table in file.tables for row in table.rows for cell in row.cells]
    assert f"{curve.theta:#.4g}".replace(".", ",") in cells
    assert np.isfinite(curve.theta)
