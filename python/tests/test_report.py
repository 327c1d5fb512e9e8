"""The report of a run: a page that is well formed, needs nothing else, and repeats the results' numbers."""

import dataclasses
import functools
import html
import html.parser
import http.server
import os
import re
import shutil
import subprocess
import sys
import threading
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import matplotlib
import numpy as np
import pytest
from refusals import refused

import dondolo as dd
from dondolo.reporting import content, numerals
from dondolo.reporting.blocks import Heading, Paragraph
from dondolo.reporting.language import Language
from dondolo.reporting.parts import ROWS, captioned
from dondolo.reporting.run import run_of
from dondolo.reporting.writers.imprint import Imprint
from dondolo.reporting.writers.web import page as page_of

pytestmark = pytest.mark.slow

matplotlib.use("agg")

VOID = {"meta", "link", "img", "br", "hr", "input"}
NASTY = "<b>\"x\" & 'y'</b>"


class Page(html.parser.HTMLParser):
    """A page read: its text, ids, links and tables; tags that do not fit are errors."""

    def __init__(self, text):
        super().__init__(convert_charrefs=True)
        self.open, self.ids, self.links, self.tables, self.images = [], [], [], {}, []
        self.words, self.errors, self.heads = [], [], []
        self.cell = None
        self.feed(text)
        self.close()
        self.errors += [f"<{name}> stays open" for name in self.open]
        self.text = " ".join("".join(self.words).split())

    def handle_starttag(self, tag, attributes):
        known = dict(attributes)
        if len(known) < len(attributes):
            self.errors.append(f"<{tag}> has an attribute twice")
        if "id" in known:
            self.ids.append(known["id"])
        self.links += [known[name] for name in ("href", "src", "srcset", "action", "data") if name in known]
        if tag == "img":
            self.images.append(known)
        if tag == "th":
            self.heads.append(known.get("scope"))
        if tag == "table":
            self.rows, self.caption = [], ""
        if tag == "tr":
            self.rows.append([])
        if tag in ("th", "td", "caption"):
            self.cell = []
        if tag not in VOID:
            self.open.append(tag)

    def handle_endtag(self, tag):
        if not self.open or self.open.pop() != tag:
            self.errors.append(f"</{tag}> closes nothing, at {self.getpos()}")
        if tag in ("th", "td"):
            self.rows[-1].append("".join(self.cell))
        if tag == "caption":
            self.caption = "".join(self.cell)
        if tag == "table":
            self.tables[self.caption] = self.rows
        if tag in ("th", "td", "caption"):
            self.cell = None

    def handle_data(self, data):
        if not self.open or self.open[-1] != "style":
            self.words.append(data)
        if self.cell is not None:
            self.cell.append(data)

    def table(self, start):
        """Columns of the table whose caption begins so."""
        (rows,) = (rows for caption, rows in self.tables.items() if caption.startswith(start))
        head, *body = rows
        return {name: [row[i] for row in body] for i, name in enumerate(head)}


def read(path):
    text = Path(path).read_text(encoding="utf-8")
    page = Page(text)
    page.source = text
    return page


def four(values):
    """Numbers as the columns of parameters show them."""
    return ["–" if np.isnan(value) else f"{value:#.4g}" for value in values]  # noqa: RUF001


def chances(values):
    return [numerals.probability(value).text for value in values]


@pytest.fixture(scope="module")
def people(few):
    walls = [
        dd.OneSidedWall(1.5, 0.25, name="a"),
        dd.TwoBlockWall(3.0, 0.25, hinge=0.5, name="a"),
        dd.OneSidedWall(2.0, 0.30, name="b"),
        dd.OneSidedWall(0.5, 1.0, name="never"),
    ]
    population = dd.Population(
        walls, [2.0, 2.0, 1.0, 0.5], group_names=["low", "low", "high", "high"], p_occ=[0.6, 0.5, 1.0, 1.0]
    )
    levels = [0.2, 0.4, 0.6, 0.8, 1.0, 1.2]
    with pytest.warns(dd.errors.DondoloWarning):
        return dd.typology(population, few, levels, edp_thresholds=[0.3], progress=False)


@pytest.fixture(scope="module")
def hazard():
    fractiles = {0.16: [0.05, 5e-3, 1e-4, 5e-7], 0.84: [0.2, 0.02, 6e-4, 6e-6]}
    return dd.HazardCurve([0.02, 0.1, 0.5, 2.5], [0.1, 0.01, 3e-4, 2e-6], fractiles=fractiles)


@pytest.fixture(scope="module")
def runs(executable, root, tmp_path_factory):
    """Prefixes of runs of the executable."""
    folder = tmp_path_factory.mktemp("runs")
    for case in ("two_block", "history", "population"):
        subprocess.run([executable, "--quiet", root / "data/cases" / f"{case}.nml"], cwd=folder, check=True)
    return folder / "out"


@pytest.fixture(scope="module")
def pages(people, stripes, wall, records, hazard, tmp_path_factory):
    """Reports of everything that there is in memory."""
    folder = tmp_path_factory.mktemp("pages")
    dd.report(people, folder / "typology.html", hazard=hazard)
    dd.report(stripes, folder / "stripes.html", hazard=hazard)
    dd.report(dd.simulate(wall, records[6]), folder / "history.html")
    return folder


KINDS = ("typology", "stripes", "history")


def test_median_of_a_population_is_of_the_walls_that_can_collapse(people, pages):
    """Its card has the level at which half of all walls collapse, which is above it."""
    fit = people["all"].fit
    assert 0.5 < fit.upper_asymptote < 1.0
    half = numerals.number(float(fit.ppf(0.5)), 3).text
    assert float(fit.ppf(0.5)) > fit.theta
    assert f"of the population that can collapse; half of all at {half}" in read(pages / "typology.html").text


@pytest.mark.parametrize("kind", KINDS)
def test_page_is_well_formed_and_needs_nothing_else(kind, pages):
    page = read(pages / f"{kind}.html")
    assert page.errors == []
    assert len(page.ids) == len(set(page.ids)) > 5
    assert all(link.startswith(("#", "data:")) for link in page.links)
    assert {link[1:] for link in page.links if link.startswith("#")} == set(page.ids)
    assert not re.search(r"https?://|@import|url\(|<script|\son\w+=", re.sub(r'"data:[^"]*"', "", page.source))
    assert page.source.startswith('<!DOCTYPE html>\n<html lang="en">')
    assert re.search("<title>[^<]+</title>", page.source)
    assert page.images
    assert all(len(image["alt"]) > 20 for image in page.images)
    assert set(page.heads) <= {"col", "row"}
    assert len(page.source) < 1_000_000


@pytest.mark.parametrize("kind", KINDS)
def test_page_is_html5(kind, pages):
    html5lib = pytest.importorskip("html5lib")
    html5lib.HTMLParser(strict=True).parse(read(pages / f"{kind}.html").source)


def test_numbers_are_those_of_the_results(people, pages):
    page = read(pages / "typology.html")
    table = page.table("Collapse: parameters")
    assert table["group"] == [curve.group or "whole population" for curve in people.groups]
    assert table["walls"] == [str(curve.n_walls) for curve in people.groups]
    assert table["θ [g]"] == four(curve.fit.theta for curve in people.groups)
    assert table["β"] == four(curve.fit.beta for curve in people.groups)
    errors = [numerals.number(curve.fit.se_ln_theta, 3).text for curve in people.groups]
    assert table["standard error of ln θ"] == errors
    assert table["βwalls"] == four(curve.beta_walls for curve in people.groups)
    assert table["βrecords"] == four(curve.beta_records for curve in people.groups)
    assert table["status"] == [curve.fit.status for curve in people.groups]
    with pytest.warns(dd.errors.DondoloWarning):
        state = dataclasses.replace(people, _states={}).at(0.3)
    table = page.table("Damage state EDP ≥ 0.3")
    assert table["θ [g]"] == four(curve.fit.theta for curve in state.groups)
    table, curve = page.table("Whole population, collapse"), people["all"]
    assert table["mean of curves"] == chances(curve.mean_curve)
    assert table["16 % fractile"] == chances(curve.level_fractiles[0])
    assert table["84 % fractile"] == chances(curve.level_fractiles[2])
    table = page.table("high, one-sided, collapse")
    assert table["50 % fractile"] == chances(people["one_sided", "high"].level_fractiles[1])
    table = page.table("Walls and mechanisms with their main properties")
    assert table["wall"] == ["a", "a", "b", "never"]
    assert table["height [m]"] == [numerals.number(wall.height).text for wall in people.walls]
    table = page.table("Statics of the walls")
    assert table["wall"] == ["a", "a", "b", "never"]
    assert table["θ [g]"] == four(curve.theta for curve in people.curves)
    assert table["status"] == [curve.status for curve in people.curves]
    assert people["all"].fit.has_errors
    ends = people["all"].fit.parameter_interval()
    table = page.table("95 % intervals of the parameters, whole population, by the covariance of the fit")
    assert table["from"] == four(ends[name][0] for name in ("theta", "beta"))
    assert table["to"] == four(ends[name][1] for name in ("theta", "beta"))
    samples = people["all"].bootstrap(n_resamples=500).parameter_interval()
    table = page.table("95 % intervals of the parameters, by drawing")
    assert table["from"] == four(samples[name][0] for name in ("theta", "beta"))
    assert table["to"] == four(samples[name][1] for name in ("theta", "beta"))


def test_further_properties_stand_in_tables_as_wide_as_a_page(few, tmp_path):
    """Of the walls that have any: loads, ties and floors, words as well as numbers."""
    floors = [
        dd.Load(8e3, depth=0.2, height=1.0, inertia="both"),
        dd.Load(4e3, depth=0.1, height=2.9, inertia="none"),
    ]
    tie = dd.Tie(2.8, area=2e-5, length=8.0, strength=1.8e8, strain=0.02)
    walls = [
        dd.OneSidedWall(3.0, 0.3, name="bare"),
        dd.OneSidedWall(3.0, 0.3, name="loaded", loads=floors),
        dd.OneSidedWall(3.0, 0.3, name="tied", ties=[tie]),
    ]
    dd.report(dd.typology(walls, few, [0.2, 0.4], progress=False), tmp_path / "report.html")
    page = read(tmp_path / "report.html")
    first, second = (page.table(f"Further properties of the walls that have them, part {i} of 2.") for i in (1, 2))
    assert first["wall"] == second["wall"] == ["loaded", "tied"]
    assert first["load [kN/m]"] == ["8, 4", ""]
    assert first["load inertia"] == ["both, none", ""]
    assert first["tie height [m]"] == ["", "2.8"]
    assert second["tie strain"] == ["", "0.02"]
    assert len(first) == 9


def test_statuses_are_counted(people, pages):
    table = read(pages / "typology.html").table("Fits of the single walls")
    assert dict(zip(table["status"], table["collapse"], strict=True)) == {"ok": "3", "no_collapse": "1"}


def test_numbers_of_a_wall(stripes, pages):
    page, curve = read(pages / "stripes.html"), stripes.fit()
    table = page.table("Curves of the damage states")
    assert table["damage state"] == ["EDP ≥ 0.1", "EDP ≥ 0.4", "collapse"]
    assert table["θ [g]"] == four(stripes.fit(edp).theta for edp in (0.1, 0.4, 1.0))
    table = page.table("Stripes")
    assert table["collapses"] == [str(z) for z in stripes.collapses]
    assert table["fitted curve"] == chances(curve(stripes.levels))
    table = page.table("95 % intervals")
    assert table["θ from"][0] == four([curve.parameter_interval()["theta"][0]])[0]
    table = page.table("Records, and collapses")
    assert table["record"] == list(stripes.record_names)
    # The intensity of a record is a level over its factor.
    assert table["pga unscaled [g]"][0] == f"{stripes.levels[2] / stripes.scale[2, 0]:.4g}"
    large = 100.0 * np.mean(stripes.scale > 10.0)
    assert f"{large:.3g} % of the histories, the largest {stripes.scale.max():.4g}" in page.text


def test_large_scale_factors_are_warned_of_in_the_words_of_the_run(wall, few):
    """A report of stripes has the warning that their run gave, record and level included."""
    with pytest.warns(dd.errors.DondoloWarning, match="scale factors above 10") as caught:
        stripes = dd.multiple_stripe(wall, few, levels=[0.1, 40.0], progress=False)
    (given,) = [one.message for one in caught if getattr(one.message, "code", "") == "scale_factors_large"]
    run = run_of(stripes)
    assert given in run.warnings
    assert (run.scales.many, run.scales.largest) == (np.sum(stripes.scale > 10.0), stripes.scale.max())


def test_risk_is_that_of_the_curves(people, stripes, hazard, pages):
    page = read(pages / "typology.html")
    risk = people["all"].risk(hazard)
    table = page.table("Mean annual frequencies")
    shown = dict(zip(table["curve"], table["annual frequency [1/year]"], strict=True))

    def value(text):
        mantissa, _, power = text.partition(" \N{MULTIPLICATION SIGN} 10")
        mantissa = mantissa.replace("\N{NARROW NO-BREAK SPACE}", "")
        return float(mantissa) * 10.0 ** int(power.replace("\N{MINUS SIGN}", "-") or 0)

    assert list(shown) == [
        "whole population, EDP ≥ 0.3",
        *(f"{who}, collapse" for who in ("whole population", "low", "high")),
    ]

    def ends(text):
        return [value(part) for part in text.split(" to ")]

    def expected(low, high):
        """One number where both are the same to three digits."""
        same = f"{low:.3g}" == f"{high:.3g}"
        return pytest.approx([low] if same else [low, high], rel=5e-3)

    assert ends(shown["whole population, collapse"]) == expected(*risk.bounds)
    high = people["all", "high"].risk(hazard)
    assert ends(shown["high, collapse"]) == expected(*high.bounds)
    parts = [value(text) for text in page.table("Deaggregation")["contribution [1/year]"]]
    np.testing.assert_allclose(parts, risk.deaggregate(hazard.levels), rtol=5e-3)
    # A population has no return period; what it loses in some years comes from its walls.
    interval = "95 % interval [1/year]"
    assert list(table) == ["curve", "annual frequency [1/year]", interval, "probability in 50 years"]
    assert ends(table[interval][1]) == expected(*risk.uncertainty().interval())
    assert ends(table["probability in 50 years"][1]) == expected(*risk.probability_bounds(50.0))
    page = read(pages / "stripes.html")
    table = page.table("Mean annual frequencies")
    one = stripes.fit().risk(hazard)
    bounds = {
        "annual frequency [1/year]": one.bounds,
        interval: one.uncertainty().interval(),
        "return period [years]": one.return_period_bounds,
        "probability in 50 years": one.probability_bounds(50.0),
    }
    assert list(table) == ["curve", *bounds]
    assert {name: ends(table[name][0]) for name in bounds} == {name: expected(*pair) for name, pair in bounds.items()}
    assert f"that of the curve's uncertainty ({one.uncertainty().kind})" in page.text
    fractiles = page.table("Annual frequency of collapse for the mean hazard")
    uncertain = one.uncertainty().table()
    assert fractiles["hazard"] == ["mean", "0.16", "0.84"]
    for row in range(3):
        assert ends(fractiles[interval][row]) == expected(uncertain["low"][row], uncertain["high"][row])


def test_a_hazard_in_another_unit_is_warned_of(stripes, tmp_path):
    levels = np.array([0.5, 1.0, 2.0, 5.0])
    dd.report(stripes, tmp_path / "report.html", hazard=dd.HazardCurve(levels, 1e-3 * np.power(levels, -2.5)))
    text = (tmp_path / "report.html").read_text()
    assert "hazard: levels up to 5 of pga, more than 4 g: are they in m/s2 or cm/s2?" in text
    assert "as given, from 0.5 g to 5 g" in " ".join(text.split())


def test_the_source_of_the_hazard_is_told(stripes, hazard, tmp_path):
    told = dataclasses.replace(hazard, source=("site <1>.csv (CRC-32 0123abcd)", "ag is taken for the PGA"))
    dd.report(stripes, tmp_path / "report.html", hazard=told)
    text = " ".join((tmp_path / "report.html").read_text().split())
    assert "Its source: site &lt;1&gt;.csv (CRC-32 0123abcd); ag is taken for the PGA." in text
    dd.report(stripes, tmp_path / "report.html", hazard=hazard)
    assert "Its source" not in (tmp_path / "report.html").read_text()


def test_a_curve_without_standard_errors_has_no_interval_of_the_risk(wall, few, hazard, tmp_path):
    levels = [0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0, 1.2, 1.4]
    curve = dd.multiple_stripe(wall, few[:2], levels, progress=False)
    assert curve.fit().errors == "few_clusters"
    dd.report(curve, tmp_path / "report.html", hazard=hazard)
    page = read(tmp_path / "report.html")
    assert page.table("Mean annual frequencies")["95 % interval [1/year]"] == [""]
    assert "the frequency no confidence interval" in page.text


def test_bounds_of_the_risk_are_two_numbers_only_where_they_differ(stripes, tmp_path):
    shown = []
    for levels in (np.geomspace(0.005, 20.0, 12), [0.05, 0.4]):
        dd.report(stripes, tmp_path / "report.html", hazard=dd.HazardCurve(levels, 1e-4 * np.power(levels, -2.5)))
        table = read(tmp_path / "report.html").table("Mean annual frequencies")
        shown.append(["to" in table[name][0] for name in table if name not in ("curve", "95 % interval [1/year]")])
    assert shown == [[False] * 3, [True] * 3]


@pytest.mark.parametrize("case", ["two_block", "history", "population"])
def test_files_tell_the_run(case, runs, tmp_path):
    stored = dd.read_results(runs / case)
    dd.report(stored, tmp_path / "report.html")
    page = read(tmp_path / "report.html")
    assert page.errors == []
    warned = [str(warning) for warning in stored.run.warnings]
    found = re.search('<aside class="warnings.*?</aside>', page.source, re.S)
    assert bool(found) == bool(warned) != ("No warnings on the calculation." in page.text)
    shown = found.group(0) if found else "<aside/>"
    assert [item.text for item in ElementTree.fromstring(shown).iter("li")] == warned
    assert bool(warned) == (case != "history")
    title = stored.run.settings["job"]["title"]
    assert f"<title>{title}</title>" in page.source
    assert f"{stored.run.written.day}\N{NO-BREAK SPACE}{stored.run.written:%B}" in page.source
    assert stored.run.compiler in page.text
    assert stored.run.engine in page.text
    for one in stored.run.inputs:
        assert f"{one['path']}{one['role']}" in page.text.replace(" ", "")
        assert one["crc32"] in page.text
    # The case is shown as it may be given again.
    with open(f"{runs / case}_walls.csv", encoding="utf-8") as file:
        head = [line[1:].strip() for line in file if line.startswith("#")]
    first = next(i for i, line in enumerate(head) if line.startswith("&"))
    echo = " ".join(head[first : max(i for i, line in enumerate(head) if line.endswith("/")) + 1])
    shown = re.search("<pre>(.*?)</pre>", page.source, re.S).group(1)
    assert " ".join(html.unescape(shown).split()) == echo.replace(", atol", " atol")


def test_report_of_a_population_imports_no_scipy(runs, tmp_path):
    """That takes longer than two of its figures."""
    program = (
        "import sys, dondolo as dd; dd.report(dd.read_results(sys.argv[1]), sys.argv[2]); "
        "print([name for name in sys.modules if name.startswith('scipy')])"
    )
    command = [sys.executable, "-W", "ignore", "-c", program, runs / "population", tmp_path / "report.html"]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"


def test_a_case_run_in_python_knows_its_records(root, tmp_path):
    run = dd.run_case(root / "data/cases/two_block.nml", progress=False)
    dd.report(run, tmp_path / "report.html", title="Mine")
    page = read(tmp_path / "report.html")
    assert "<title>Mine</title>" in page.source
    assert "scale factors above 10 in 123 of 396 histories" in page.text
    history = dd.run_case(root / "data/cases/history.nml", progress=False)
    dd.report(history, tmp_path / "report.html")
    assert history.case.title in read(tmp_path / "report.html").text


def test_texts_are_escaped(few, tmp_path):
    names = [NASTY, "$_{1}$ and $", "_under", "100 %"]
    walls = [dd.OneSidedWall(1.5, 0.25 + 0.01 * i, name=name) for i, name in enumerate(names)]
    population = dd.Population(walls, group_names=names)
    people = dd.typology(population, few, [0.3, 0.5, 0.7, 0.9], edp_thresholds=[0.4], progress=False)
    stripes = dd.multiple_stripe(walls[0], few, [0.3, 0.5, 0.7, 0.9], progress=False)
    record = dd.Record(few[0].acceleration, few[0].dt, name=NASTY)
    for results in (people, stripes, dd.simulate(walls[0], record, 3.0)):
        dd.report(results, tmp_path / "report.html", title=NASTY)
        page = read(tmp_path / "report.html")
        assert page.errors == []
        assert NASTY in page.text
        assert "<b>" not in page.source


def written(*blocks):
    """A page of a few blocks."""
    return page_of([Heading("title", 0), *blocks], Imprint(Language("en"), "mark", "report"), formulas=True)


def test_long_tables_are_cut_and_say_so():
    table = content.Table.of({"number": [str(i) for i in range(ROWS + 7)]})
    page = Page(written(captioned(table, "Much.")))
    (rows,) = page.tables.values()
    assert len(rows) == ROWS + 1
    assert f"Much. First {ROWS} of {ROWS + 7} rows" in page.text


def test_tables_fit_printed_pages():
    """Wide ones have small letters, short ones stay on one page."""
    for columns, rows, wide, short in ((11, 15, False, False), (12, 14, True, True)):
        shown = written(captioned(content.Table.of({f"{i}": ["x"] * rows for i in range(columns)}), "Caption."))
        assert ('<table class="wide">' in shown) == wide
        assert ('class="scroll short"' in shown) == short


def test_numbers_are_shown_as_people_write_them():
    def plain(numeral):
        return numeral.text + (f" \N{MULTIPLICATION SIGN} 10{numeral.power}" if numeral.power else "") + numeral.unit

    assert plain(numerals.number(4.5e-7)) == "4.5 \N{MULTIPLICATION SIGN} 10\N{MINUS SIGN}7"
    assert plain(numerals.number(-0.25)) == "\N{MINUS SIGN}0.25"
    assert plain(numerals.number(5725.29, 3)) == "5\u202f730"
    assert plain(numerals.number(np.inf)) == "∞"
    assert plain(numerals.number(None, unit=" s")) == "\N{EN DASH} s"
    assert plain(numerals.percent(1e-5)) == "<0.1 %"
    assert plain(numerals.parameter(0.373)) == "0.3730"
    assert chances([0.0, 1e-9, 0.5, 1.0 - 1e-9, 1.0]) == ["0", "< 0.0001", "0.5000", "> 0.9999", "1"]
    # The writer sets the power of ten, and says that there is none.
    page = written(Paragraph((numerals.number(4.5e-7),)), Paragraph((numerals.NONE,)))
    assert "<p>4.5 \N{MULTIPLICATION SIGN} 10<sup>\N{MINUS SIGN}7</sup></p>" in page
    assert '<p><span title="none">\N{EN DASH}</span></p>' in page


def test_report_appears_whole_or_not_at_all(stripes, tmp_path, monkeypatch):
    path = tmp_path / "report.html"
    dd.report(stripes, path)
    before = path.read_bytes()

    def full(self, *_, **__):
        raise OSError(28, "No space left on device")

    def lost(self, *_, **__):
        self.unlink()

    for write, words in ((full, "No space left"), (lost, "No such file")):
        with monkeypatch.context() as patch:
            patch.setattr(Path, "write_text", write)
            with pytest.raises(dd.errors.DondoloError, match=f"cannot be written: {words}"):
                dd.report(stripes, path, title="Another")
        assert path.read_bytes() == before
        assert os.listdir(tmp_path) == ["report.html"]
    dd.report(stripes, path, title="Another")
    assert "<title>Another</title>" in path.read_text()


def test_only_reports_are_replaced(stripes, tmp_path):
    path = tmp_path / "walls.html"
    path.write_text("wall\n")
    with pytest.raises(dd.errors.InputError, match=r"walls\.html: exists, and is not a report of dondolo"):
        dd.report(stripes, path)
    assert path.read_text() == "wall\n"
    with pytest.raises(dd.errors.DondoloError, match="cannot be written"):
        dd.report(stripes, tmp_path / "nowhere" / "report.html")
    with pytest.raises(dd.errors.DondoloError, match="cannot be written: Not a directory"):
        dd.report(stripes, path / "report.html")
    folder = tmp_path / "folder.html"
    folder.mkdir()
    with pytest.raises(dd.errors.DondoloError, match="cannot be written"):
        dd.report(stripes, folder)


def test_wrong_input(stripes, wall, sine, hazard, tmp_path):
    path = tmp_path / "report.html"
    with pytest.raises(dd.errors.InputError, match="results: must be results of an analysis"):
        dd.report("out/parapet", path)
    for title, sentence in (
        (5, "title = 5: must be a string"),
        ("a\udc80b", r"title = 'a\\udc80b': must be a string"),
        ("a\0b", r"title = 'a\\x00b': must be one line"),
    ):
        with pytest.raises(dd.errors.InputError, match=sentence):
            dd.report(stripes, path, title=title)
    for wrong in (3, None, "", "a\0b", "\ud800"):
        with pytest.raises(dd.errors.InputError, match=r"path = .*: must be the path of a file"):
            dd.report(stripes, wrong)
        with pytest.raises(dd.errors.InputError, match=r"prefix = .*: must be the path of a file"):
            dd.read_results(wrong)
    for name in ("a.doc", "a"):
        with pytest.raises(dd.errors.InputError, match=r"path = .*: must end in .docx or .html or .htm or .pdf"):
            dd.report(stripes, tmp_path / name)
    assert not list(tmp_path.iterdir())
    with refused("wrong_type", "hazard"):
        dd.report(stripes, path, hazard=0.1)
    with pytest.raises(dd.errors.InputError, match="hazard: must be left out"):
        dd.report(dd.simulate(wall, sine), path, hazard=hazard)
    with pytest.raises(dd.errors.InputError, match="must be the same"):
        dd.report(stripes, path, hazard=dd.HazardCurve([0.1, 1.0], [0.1, 0.001], im="pgv"))
    assert not path.exists()


def test_a_wall_without_a_fit(records, tmp_path):
    stripes = dd.multiple_stripe(dd.OneSidedWall(0.5, 1.0), records[:3], [0.1, 0.2], progress=False)
    dd.report(stripes, tmp_path / "report.html")
    page = read(tmp_path / "report.html")
    assert "no_collapse" in page.text
    assert page.errors == []
    with pytest.raises(dd.errors.DondoloError, match="no curve"):
        dd.report(stripes, tmp_path / "risk.html", hazard=dd.HazardCurve([0.1, 1.0], [0.1, 0.001]))


def test_bootstrap_over_walls_needs_counts_only(people):
    counts = dataclasses.replace(people, flags=None)
    expected, found = (
        people["all"].bootstrap(n_resamples=50, over="walls"),
        counts["all"].bootstrap(n_resamples=50, over="walls"),
    )
    np.testing.assert_array_equal(found.theta, expected.theta)
    np.testing.assert_array_equal(found.mean_fraction, expected.mean_fraction)
    with pytest.raises(dd.errors.DondoloError, match="must be 'walls'"):
        counts["all"].bootstrap(n_resamples=50)


def test_damage_states_that_cross_are_told(few, tmp_path):
    """Where, and by how much; elsewhere nothing is said."""
    levels = [0.2, 0.4, 0.6, 0.8, 1.0, 1.2]
    walls = [
        dd.TwoBlockWall(
            3.0, 0.38, hinge=0.5, overburden=1600.0, overburden_inertia=0.0, restitution_factor=0.88, name="folds"
        )
    ]
    people = dd.typology(walls, few, levels, edp_thresholds=[0.1, 0.4], progress=False)
    dd.report(people, tmp_path / "report.html")
    table = read(tmp_path / "report.html").table("Damage states that cross")
    assert "dondolo nrml takes it" in read(tmp_path / "report.html").text
    x = np.linspace(0.0, 1.2, 201)[1:]
    gap = people.at(0.4)["all"](x) - people.at(0.1)["all"](x)
    assert gap.max() > 1e-3
    assert table["curve"] == ["whole population, two-block"]
    assert (table["more probable is"], table["than"]) == (["EDP ≥ 0.4"], ["EDP ≥ 0.1"])
    assert float(table["by up to"][0]) == pytest.approx(gap.max(), rel=0.05)
    assert float(table["at pga [g]"][0]) == pytest.approx(x[np.argmax(gap)], rel=1e-3)
    stripes = dd.multiple_stripe(walls[0], few, levels, progress=False)
    dd.report(stripes, tmp_path / "report.html")
    page = read(tmp_path / "report.html")
    assert page.table("Damage states that cross")["by up to"] == table["by up to"]
    # What the advice leads to
    assert "With states = 'ordinal'" in page.text
    low, high = stripes.fit_damage_states([0.1, 0.4], states="ordinal")
    assert (low(x) >= high(x)).all()


def test_no_state_is_said_to_cross(pages):
    for kind in KINDS:
        assert "states that cross" not in read(pages / f"{kind}.html").text


def test_an_uncertain_wall_is_one_wall(few, tmp_path):
    wall = dd.OneSidedWall(1.5, 0.25, name="parapet")
    sources = {"restitution_factor": dd.distributions.Uniform(0.95, 1.0)}
    found = dd.propagate_uncertainty(
        wall, few, [0.3, 0.5, 0.7, 0.9, 1.2], sources=sources, n_variants=12, progress=False
    )
    dd.report(found, tmp_path / "report.html")
    page = read(tmp_path / "report.html")
    assert "parapet: one-sided, its restitution factor uncertain; 12 variants, and 4 beside them;" in page.text
    assert "Uncertainty of the mean curve of the variants" in page.text
    assert page.table("Collapse: parameters")["group"] == ["all variants"]
    for words in ("population", "of weight 0", "typological", "single walls,"):
        assert words not in page.text


def test_histories_are_counted_once(wall, few, tmp_path):
    dd.report(dd.multiple_stripe(wall, few, [0.4, 0.8], estimate_error=True, progress=False), tmp_path / "report.html")
    page = read(tmp_path / "report.html")
    assert f"{2 * len(few)} histories, each run 3 times." in page.text
    assert f"histories{2 * len(few)} of these never move" in page.text


def test_the_motion_of_a_floor_is_called_so(few, tmp_path):
    house = dd.Building(0.3, storeys=3, level=9.0, building_height=9.0)
    for building, words, limit in (
        (house, "Acceleration of the floor that the wall stands on under", "Each wall is moved by its floor"),
        (None, "Ground acceleration of", "A wall of an upper storey needs the motion of its floor."),
    ):
        dd.report(dd.simulate(dd.OneSidedWall(1.5, 0.25, building=building), few[0]), tmp_path / "report.html")
        text = read(tmp_path / "report.html").text
        assert words in text
        assert limit in text
        assert ("Each wall is moved" in text) == (building is not None)


def test_ties_are_told_whole(few, tmp_path):
    """Defaults too, in units in which they are easily read; and the one wall is drawn."""
    wall = dd.OneSidedWall(3.0, 0.3, ties=[dd.Tie(2.8, area=5e-05, length=8.0)])
    dd.report(dd.multiple_stripe(wall, few, [0.4, 0.8], progress=False), tmp_path / "report.html")
    page = read(tmp_path / "report.html")
    for words in ("tie area0.5 cm²/m", "tie strength180 MPa", "tie strain0.02", "tie preload0 MPa"):
        assert words in page.text
    assert any("half of its capacity" in image["alt"] for image in page.images)


def test_walls_that_are_alike_have_no_dispersion(few, tmp_path):
    walls = [dd.OneSidedWall(3.0, 0.25, name=name) for name in "abcdefg"]
    people = dd.typology(walls, few, [0.3, 0.5, 0.7], progress=False)
    (curve,) = people.groups
    people = dataclasses.replace(people, groups=(dataclasses.replace(curve, beta_walls=8.9e-11),))
    dd.report(people, tmp_path / "report.html")
    assert read(tmp_path / "report.html").table("Collapse: parameters")["βwalls"] == ["0.000"]
    assert "0 between walls" in people["all"]._repr_html_()


def test_walls_of_no_weight_are_told(few, tmp_path):
    walls = [dd.OneSidedWall(1.5, 0.25, name=name) for name in "abc"]
    people = dd.typology(dd.Population(walls, [1.0, 0.0, 2.0]), few, [0.3, 0.5, 0.7, 0.9], progress=False)
    dd.report(people, tmp_path / "report.html")
    page = read(tmp_path / "report.html")
    assert "3 walls, 1 of them of weight 0 and in no curve of the population;" in page.text
    assert page.table("Collapse: parameters")["walls"] == ["2"]


def test_the_total_dispersion_is_what_the_parts_add_up_to(people, pages):
    table = read(pages / "typology.html").table("Collapse: parameters")
    assert table["βtotal"] == four(curve.beta_total for curve in people.groups)
    assert table["βtotal"] != table["β"]


def test_scale_factors_of_a_population_are_known(people, records, tmp_path):
    """From objects as from files: they are among what was warned of."""
    walls = [dd.OneSidedWall(1.5, 0.25, name="a")]
    with pytest.warns(dd.errors.DondoloWarning) as caught:
        large = dd.typology(walls, records, [0.4, 0.8, 1.2, 1.6], progress=False)
    assert list(large.warnings) == [one.message for one in caught]
    dd.report(large, tmp_path / "report.html")
    page = read(tmp_path / "report.html")
    many, histories, most = re.search(r"above 10 in (\d+) of (\d+) histories, the largest (\S+)", page.text).groups()
    share = f"{100.0 * int(many) / int(histories):.3g}"
    assert f"scale factors above 10{share} % of the histories, the largest {most}" in page.text
    small = dd.typology(walls, records, [0.02, 0.05], progress=False)
    dd.report(small, tmp_path / "report.html")
    assert "scale factors above 10none" in read(tmp_path / "report.html").text


def command(*arguments):
    return subprocess.run(
        [sys.executable, "-m", "dondolo", *map(str, arguments)], capture_output=True, text=True, check=False
    )


def test_command_report(runs, hazard, tmp_path):
    done = command("report", runs / "two_block")
    assert (done.returncode, done.stdout) == (0, f"written: {runs}/two_block_report.html\n")
    hazard.to_csv(tmp_path / "hazard.csv")
    done = command("report", runs / "population", "-o", tmp_path / "r.html", "--hazard", tmp_path / "hazard.csv")
    assert done.returncode == 0, done.stderr
    assert "Annual frequency of collapse" in read(tmp_path / "r.html").text
    done = command("report", runs / "nothing")
    assert done.returncode == 2
    assert done.stderr.count("\n") == 1


def test_a_full_disk_behind_standard_output_is_told(root):
    if not os.path.exists("/dev/full"):
        pytest.skip("no /dev/full here")
    with open("/dev/full", "w") as full:
        arguments = [sys.executable, "-m", "dondolo", "records", root / "data/records/synthetic44.csv"]
        done = subprocess.run(arguments, stdout=full, stderr=subprocess.PIPE, text=True, check=False)
    assert done.returncode == 1
    assert done.stderr == "dondolo: standard output: cannot be written: No space left on device\n"


def test_command_nrml(runs):
    done = command("nrml", runs / "two_block")
    assert done.returncode == 0, done.stderr
    path = runs / "two_block_fragility.xml"
    assert done.stdout == f"written: {path} (1 function)\n"
    params = ElementTree.parse(path).getroot().find(".//{*}params")
    curve = dd.read_results(runs / "two_block").fragility
    assert float(params.get("mean")) == pytest.approx(curve.theta * np.exp(curve.beta**2 / 2), rel=1e-12)
    # Again, but over no other file
    assert command("nrml", runs / "two_block").returncode == 0
    survey = runs / "survey.csv"
    survey.write_text("name,height\n")
    done = command("nrml", runs / "two_block", "-o", survey)
    assert done.returncode == 2
    assert done.stderr == f"dondolo: {survey}: exists, and is not a fragility model of dondolo\n"
    assert survey.read_text() == "name,height\n"
    done = command("nrml", runs / "history")
    assert done.returncode == 2
    assert "single motion" in done.stderr


# --- In a browser


@pytest.fixture(scope="module")
def browser():
    names = ("chromium", "chromium-browser", "google-chrome", "chrome")
    found = [path for path in map(shutil.which, names) if path]
    found += map(str, Path.home().glob(".cache/ms-playwright/chromium*/chrome-linux*/*chrome*"))
    found = [path for path in found if os.access(path, os.X_OK) and Path(path).is_file()]
    if not found and "GITHUB_ACTIONS" not in os.environ:
        pytest.skip("no browser: looked for chromium, chromium-browser, google-chrome and Playwright's")
    return found[0]


@pytest.fixture
def served(tmp_path):
    """A folder that is served, its address, and what is asked for."""
    asked = []

    class Handler(http.server.SimpleHTTPRequestHandler):
        def log_message(self, *_):
            asked.append(self.path)

    server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), functools.partial(Handler, directory=tmp_path))
    threading.Thread(target=server.serve_forever, daemon=True).start()
    yield tmp_path, f"http://127.0.0.1:{server.server_port}", asked
    server.shutdown()
    server.server_close()


# A phone in a frame: a window of a browser is not made as narrow
FRAME = """<!DOCTYPE html><title>frame</title>
<iframe id="f" src="report.html" style="width:390px;height:800px"></iframe>
<script>onload = () => { const d = document.getElementById("f").contentDocument;
document.title = [d.documentElement.scrollWidth, d.documentElement.scrollHeight, d.images.length,
[...d.images].every(i => i.complete && i.naturalWidth > 100), d.body.innerText.includes("Limits of the models")]; };
</script>"""


def browse(browser, folder, *arguments):
    options = ["--headless", "--no-sandbox", "--disable-gpu", "--disable-background-networking", "--no-first-run"]
    options += [f"--user-data-dir={folder}/profile", "--enable-logging=stderr", "--virtual-time-budget=10000"]
    done = subprocess.run([browser, *options, *arguments], capture_output=True, text=True, timeout=120, check=True)
    return done.stdout, [line for line in done.stderr.splitlines() if "CONSOLE" in line]


@pytest.mark.parametrize("kind", KINDS)
def test_in_a_browser(kind, browser, served, pages):
    folder, address, asked = served
    shutil.copy(pages / f"{kind}.html", folder / "report.html")
    (folder / "frame.html").write_text(FRAME)
    dom, console = browse(browser, folder, "--dump-dom", f"{address}/frame.html")
    assert console == []
    assert [path for path in asked if path not in ("/favicon.ico", "/frame.html")] == ["/report.html"]
    width, height, images, drawn, text = re.search("<title>(.*?)</title>", dom).group(1).split(",")
    assert int(width) <= 390
    assert int(height) > 3000
    assert int(images) == len(read(pages / f"{kind}.html").images)
    assert (drawn, text) == ("true", "true")
    browse(browser, folder, f"--print-to-pdf={folder}/report.pdf", f"{address}/report.html")
    assert (folder / "report.pdf").read_bytes().startswith(b"%PDF")


def test_the_browser_would_see_a_request(browser, served, pages):
    folder, address, _ = served
    text = (pages / "stripes.html").read_text().replace("<main>", '<main><img src="more.png" alt="more">')
    (folder / "report.html").write_text(text)
    _, console = browse(browser, folder, "--dump-dom", f"{address}/report.html")
    assert len(console) == 1
    assert "Content Security Policy" in console[0]


# --- What fails, and what paper shows


def verdict(path):
    """Tone and words of the verdict of a page."""
    return re.search(r'<aside class="verdict (\w+)"><h3>(.*?)</h3>', path.read_text(encoding="utf-8")).groups()


def test_the_verdict_comes_first_and_in_words(records, tmp_path):
    """A wall that fails a check is red without warnings too; one whose anchors are not checked is not green."""
    weak, firm = (dd.OneSidedWall(1.5, thickness, name="front") for thickness in (0.18, 1.6))
    site = dd.Site(ag=0.25, f0=2.5, tc_star=0.35)
    strong = [record for record in records if record.intensity("pga") > 0.1]
    stripes = dd.multiple_stripe(weak, strong, [0.2, 0.3, 0.4, 0.5, 0.6, 0.8, 1.0], progress=False)
    check = dd.check_ntc(weak, site)
    missed = [key for key, holds in check.verified.items() if not holds]
    assert ("linear", "SLV") in missed
    page, index = tmp_path / "page.html", check.value("nonlinear", "SLV", "ratio")
    dd.report(stripes, page, check=check)
    words = (
        "Not satisfied by NTC 2018: the check that the verdict rests on (nonlinear SLV);"
        f" ζ_E {index:.3g}"
    )  # fmt: skip
    assert verdict(page) == ("failed", words)
    assert f"nonlinear SLV, capacity / demand {index:.3g}" in read(page).text
    assert "No warnings on the calculation." in read(page).text
    dd.report(stripes, page)
    assert 'class="verdict' not in page.read_text()
    dd.report(stripes, page, hazard=dd.HazardCurve([0.1, 1.0], [1e-2, 1e-4], rigid_ground=True))
    assert verdict(page)[0] == "doubt"

    for wall, tone in ((firm, "fine"), (tied(firm), "doubt"), (tied(firm, anchor_force=9e3), "fine")):
        check = dd.check_ntc(wall, site)
        assert all(check.verified.values())
        dd.report(dd.multiple_stripe(wall, records, [0.4, 0.8, 1.2], progress=False), page, check=check)
        assert verdict(page)[0] == tone
        assert verdict(page)[1].startswith("Satisfied by NTC 2018: all that") == (tone == "fine")
        assert ("no check by NTC 2018 fails that the verdict rests on (nonlinear SLV)" in verdict(page)[1]) == (
            tone == "doubt"
        )
        assert ("anchors of the ties not checked" in verdict(page)[1]) == (tone == "doubt")


def tied(wall, **anchor):
    """A wall with a tie."""
    return dataclasses.replace(wall, ties=[dd.Tie(1.4, area=5e-5, length=8.0, **anchor)])


def test_failing_walls_of_a_population_are_named(root, executable, tmp_path):
    rows = [f"wall {i},one_sided,{3.0 + 0.1 * i},0.25" for i in range(6)] + ["firm,one_sided,1.0,0.9"]
    (tmp_path / "walls.csv").write_text("\n".join(["name,mechanism,height,thickness", *rows]) + "\n")
    (tmp_path / "case.nml").write_text(
        "&job task = 'typology', output = 'out' /\n&population file = 'walls.csv' /\n"
        f"&records catalogue = '{root / 'data/records/synthetic44.csv'}' /\n"
        "&stripes levels = 0.2, 0.4, 0.8 /\n&check ag = 0.2, f0 = 2.5, tc_star = 0.35 /\n"
    )
    subprocess.run([executable, "--quiet", "case.nml"], cwd=tmp_path, capture_output=True, check=True)
    found = dd.read_results(tmp_path / "out")
    dd.report(found, tmp_path / "page.html")
    ratios = [check.value("nonlinear", "SLV", "ratio") for check in found.checks]
    page = read(tmp_path / "page.html").text
    assert f"nonlinear SLV, least capacity / demand {min(ratios):.3g}: 6 of 7 walls" in page


def test_the_records_of_a_run_are_described(executable, root, tmp_path):
    """Event, date, magnitude, station, component, from the catalogue by way of the executable, and in Python."""
    (tmp_path / "a.txt").write_text("\n".join(f"{np.sin(0.2 * i):.6f}" for i in range(400)) + "\n")
    (tmp_path / "b.txt").write_text("\n".join(f"{np.cos(0.3 * i):.6f}" for i in range(400)) + "\n")
    (tmp_path / "catalogue.csv").write_text(
        "file,dt_s,units,event,date,magnitude,station,component\n"
        "a.txt,0.01,m/s2,Lakeside,2019-05-04,6.1,QQX,N\nb.txt,0.01,m/s2,Lakeside,2019-05-04,6.1,QQX,E\n"
    )
    (tmp_path / "case.nml").write_text(
        "&job task = 'stripes', output = 'out' /\n&wall mechanism = 'one_sided', height = 2, thickness = 0.3 /\n"
        "&records catalogue = 'catalogue.csv' /\n&stripes levels = 0.1, 0.3, 0.6 /\n"
    )
    subprocess.run([executable, "--quiet", "case.nml"], cwd=tmp_path, capture_output=True, check=True)
    found = dd.read_results(tmp_path / "out")
    described = {"date": "2019-05-04", "magnitude": "6.1", "station": "QQX"}
    assert described.items() <= found.run.records[0].items()
    for source in (found, dd.run_case(tmp_path / "case.nml", progress=False)):
        dd.report(source, tmp_path / "page.html")
        table = read(tmp_path / "page.html").table("Records, as their headers")
        assert table["event"] == ["Lakeside", "Lakeside"]
        assert table["magnitude"] == ["6.1", "6.1"]
        assert (table["station"][1], table["component"][1], table["date"][1]) == ("QQX", "E", "2019-05-04")
    assert read(tmp_path / "page.html").table("Records, and collapses")["factor from"]
    (tmp_path / "catalogue.csv").write_text("file,dt_s,units\na.txt,0.01,m/s2\nb.txt,0.01,m/s2\n")
    dd.report(dd.run_case(tmp_path / "case.nml", progress=False), tmp_path / "page.html")
    table = read(tmp_path / "page.html").table("Records, as their headers")
    assert {*table["event"], *table["magnitude"], *table["station"]} == {"not given"}


def test_paper_shows_what_is_folded_up(browser, pages, tmp_path):
    """A page printed by a browser, and the report as PDF, have every table of the page."""
    if not shutil.which("pdftotext"):
        pytest.skip("pdftotext is not installed")
    page = pages / "stripes.html"
    names = next(iter(read(page).table("Records, and collapses").values()))
    browse(browser, tmp_path, f"--print-to-pdf={tmp_path}/page.pdf", page.as_uri())
    words = subprocess.run(["pdftotext", tmp_path / "page.pdf", "-"], capture_output=True, text=True, check=True).stdout
    words = "".join(words.partition("Table of the histories of a stripe")[2].split())
    assert [name for name in names if "".join(name.split()) not in words] == []


def test_pdf_has_every_record_and_file(browser, executable, root, tmp_path):
    if not shutil.which("pdftotext"):
        pytest.skip("pdftotext is not installed")
    case = root / "data/cases/parapet.nml"
    subprocess.run([executable, "--quiet", case], cwd=tmp_path, capture_output=True, check=True)
    found = dd.read_results(tmp_path / "out/parapet")
    dd.report(found, tmp_path / "page.pdf")
    words = subprocess.run(["pdftotext", tmp_path / "page.pdf", "-"], capture_output=True, text=True, check=True).stdout
    words = "".join(words.split())
    files = [Path(one["path"]).name for one in found.run.inputs]
    names = [*(one["name"] for one in found.run.records), *files]
    assert len(files) > 44
    assert [name for name in names if "".join(name.split()) not in words] == []


def test_pdf_is_printed_unfolded(monkeypatch, stripes, tmp_path):
    """Whatever browser prints it."""
    printed = []

    def run(command, **_):
        source = Path(command[-1].removeprefix("file://"))
        printed.append(source.read_text(encoding="utf-8"))
        Path(next(one for one in command if one.startswith("--print-to-pdf=")).partition("=")[2]).write_bytes(
            b"%PDF-1.7\n"
        )

    monkeypatch.setattr(shutil, "which", lambda name: f"/usr/bin/{name}")
    monkeypatch.setattr(subprocess, "run", run)
    dd.report(stripes, tmp_path / "page.pdf")
    assert "<details open>" in printed[0]
    assert "<details>" not in printed[0]
