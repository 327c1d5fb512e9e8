"""What holds for every number, column and word that is shown: it is the result's, in the unit that its head says.

Units are computed from their names, and words are compared by their keys, so that no exchange goes unseen.
"""

import dataclasses
import html
import math
import re
import statistics
import warnings
from pathlib import Path

import matplotlib

matplotlib.use("agg")

import matplotlib.pyplot as plt
import numpy as np
import pytest

import dondolo as dd
from dondolo.checks.plots import check_name
from dondolo.reporting import columns, numerals, run, statuses, typology, words
from dondolo.reporting import wall as wall_facts
from dondolo.reporting.blocks import CaptionedTable, Cards, Paragraph
from dondolo.reporting.content import Symbol
from dondolo.reporting.language import Language
from dondolo.reporting.relazione import outcome, project, site_grid
from dondolo.reporting.relazione.document import Document
from dondolo.reporting.relazione.subjects import Subject, Subjects
from dondolo.reporting.risk import risk_chapter
from dondolo.reporting.units import CENTIMETRES, UNITS
from dondolo.reporting.wall import numbers as numbers_of_a_wall
from dondolo.reporting.wall import summary
from dondolo.serve.pictures import picture

ITALIAN = Language("it")

# --- Numbers


def read(numeral):
    """Value and half a unit of the last digit of a numeral."""
    text = numeral.text.replace("\N{MINUS SIGN}", "-").replace("\N{NARROW NO-BREAK SPACE}", "").removesuffix("%")
    power = 10.0 ** float((numeral.power or "0").replace("\N{MINUS SIGN}", "-"))
    digits = len(text.strip().partition(".")[2])
    return float(text) * power, 0.5 * 10.0**-digits * power


VALUES = [
    sign * digit * 10.0**power for power in range(-9, 9) for digit in (1.0, 2.345678, 9.99949, 5.0) for sign in (1, -1)
]


@pytest.mark.parametrize("value", [*VALUES, 0.0, 12345.0, 1e6])
def test_numerals_say_their_values(value):
    """To the figures that they show, with their sign and power of ten."""
    for figures in (2, 3, 4, 6):
        got, _half = read(numerals.number(value, figures))
        assert got == pytest.approx(value, rel=5.001 * 10.0**-figures, abs=0.0)
    assert read(numerals.parameter(value))[0] == pytest.approx(value, rel=5.001e-4)
    assert read(numerals.whole(round(value)))[0] == round(value)


@pytest.mark.parametrize("share", [1e-6, 4e-4, 6e-4, 1e-3, 2e-3, 4.9e-3, 5.1e-3, 0.0123, 0.5, 0.99949, 1.0, 0.0])
def test_shares_say_their_values(share):
    """In per cent with three figures, or less than a tenth of a per cent where that is so."""
    shown = numerals.percent(share)
    if shown.text.startswith("<"):
        assert shown.text == "<0.1 %"
        assert 0.0 < share < 0.001
    else:
        assert shown.unit == " %"
        assert read(shown)[0] == pytest.approx(100.0 * share, rel=5.001e-3)


@pytest.mark.parametrize("p", [0.0, 1e-7, 4e-5, 6e-5, 1.23e-3, 0.25, 0.99993, 0.99997, 1.0])
def test_probabilities_say_their_values(p):
    text = numerals.probability(p).text
    if text[0] in "<>":
        assert eval(f"{p!r} {text}")
        assert 0.0 < p < 1.0
    else:
        assert float(text) == pytest.approx(p, abs=5.001e-5)


# --- Units

SIZES = {"": 1.0, "m": 1.0, "s": 1.0, "kg": 1.0, "N": 1.0, "Pa": 1.0, "J": 1.0, "rad": 1.0, "g": 9.80665, "t": 1e3,
         "cm": 1e-2, "mm": 1e-3, "km": 1e3, "kN": 1e3, "MPa": 1e6, "year": 1.0, "years": 1.0, "1": 1.0}  # fmt: skip


def size(unit):
    """How many units of the SI a unit is, by its name: 'kNm²/m', 'cm²/m', 'N m/m'."""
    total = 1.0
    for place, part in enumerate(unit.replace("²", "2").replace("³", "3").split("/")):
        for word in re.sub(r"^(k?N)m", r"\1 m", part).split(" "):
            name, power = re.fullmatch(r"([A-Za-z]*|1)(\d?)", word).groups()
            total *= SIZES[name] ** ((-1) ** place * int(power or 1))
    return total


def dimension(unit):
    """The same without the size: which base units in what power."""
    found = {}
    plain = {"kN": "N", "MPa": "Pa", "cm": "m", "mm": "m", "km": "m", "t": "kg", "years": "year"}
    for place, part in enumerate(unit.replace("²", "2").replace("³", "3").split("/")):
        for word in re.sub(r"^(k?N)m", r"\1 m", part).split(" "):
            name, power = re.fullmatch(r"([A-Za-z]*|1)(\d?)", word).groups()
            if name not in ("", "1"):
                name = plain.get(name, name)
                found[name] = found.get(name, 0) + (-1) ** place * int(power or 1)
    return {name: power for name, power in found.items() if power}


def test_factors_of_units_are_those_of_their_names():
    for name, unit in {**UNITS, "m ": CENTIMETRES}.items():
        assert dimension(unit.name) == dimension(name.strip()), name
        assert unit.factor * size(unit.name) == pytest.approx(size(name.strip()), rel=1e-12), name


def unit_of_ending(ending):
    """The unit that the end of a column's name says: '_nm_m' is 'N m/m'."""
    first, *rest = ending.strip("_").split("_")
    words = {"n": "N", "nm": "N m", "nm2": "N m2", "j": "J", "pa": "Pa"}
    return "/".join([words.get(first, first), *rest])


def head_text(head, im="pga"):
    """A head as text."""
    head = head(im) if callable(head) else head
    if isinstance(head, tuple):
        return "".join(head_text(part) for part in head)
    return f"{head.letter}{head.index}{head.mark}" if isinstance(head, Symbol) else str(head)


# Columns whose unit the end of their names does not say
OTHER_UNITS = {
    "height": "m", "thickness": "m", "density": "kg/m3", "overburden": "kN/m", "eccentricity": "m", "trigger": "g",
    "return_period": "years", "return_period_change": "years", "theta": "g", "theta_5": "g", "theta_95": "g",
    "im_level": "g",
}  # fmt: skip
ENDINGS = ("_kg_m3", "_m_s2", "_rad_s", "_kg_m", "_rad", "_g", "_n_m", "_m")


def test_heads_of_columns_have_their_units():
    """Those that the names of the columns end with, and no others."""
    for name, shown in columns._COLUMNS.items():
        found = re.search(r"\[(.+)\]", head_text(shown.head))
        ending = next((one for one in ENDINGS if name.endswith(one)), "")
        unit = OTHER_UNITS.get(name, unit_of_ending(ending))
        assert (found[1] if found else "").replace("²", "2").replace("³", "3") == unit, name


def test_italian_heads_have_the_units_of_the_names():
    for ending in words.UNITS:
        with ITALIAN.in_force():
            found = re.fullmatch(r".+ \[(.+)\]", words.heading(f"wall{ending}"))
        assert found[1].replace("²", "2").replace("³", "3").replace("°", "deg") == unit_of_ending(ending), ending
    # The longest ending first, or part of a unit is taken for a word
    names = list(words.UNITS)
    assert all(not two.endswith(one) for place, one in enumerate(names) for two in names[place + 1 :])


@pytest.mark.parametrize(
    ("name", "head"),
    [
        ("wing_angle_deg", "angolo delle lesioni del cantonale [°]"),
        ("load2_total_n", "carico intero del cantonale 2 [N]"),
        ("elevation12_z_m", "quota del vertice del prospetto 12 [m]"),
        ("wedge1_angle_deg", "angolo della lesione del cuneo 1 [°]"),
        ("opening1_width_m", "larghezza dell'apertura 1 [m]"),
        ("load1_n_m", "carico 1 [N/m]"),
    ],
)
def test_italian_heads_of_parts(name, head):
    with ITALIAN.in_force():
        assert words.heading(name) == head
    assert words.heading(name) == name


# --- Words by their keys

# What the Italian of a key must say, and what only it may say
SAYS = {
    "ok": "determinata", "extrapolated": "fuori dai livelli", "nearly_flat": "non significativa",
    "no_collapse": "nessun collasso", "all_collapse": "collasso in tutte", "separated": "sovrapposizione",
    "single_level": "un solo livello", "decreasing": "non crescenti", "not_converged": "non convergente",
}  # fmt: skip
FITTED = ("ok", "extrapolated", "nearly_flat")


def test_statuses_by_their_keys():
    """In all vocabularies: a status that has no curve says so, and no other does."""
    italian = ITALIAN.all_named("status")
    assert set(statuses.STATUSES) == set(italian) == set(SAYS)
    for name, said in SAYS.items():
        assert [key for key, text in italian.items() if said in text] == [name]
        assert ("nessuna curva" in italian[name]) == (name not in FITTED)
        assert ("a curve" in statuses.STATUSES[name]) == (name in FITTED)
        assert statuses.status_meaning(name) == statuses.STATUSES[name]
        with ITALIAN.in_force():
            assert words.in_words("status", name) == statuses.status_meaning(name) == italian[name]
    with ITALIAN.in_force():
        for name, said in {"no_collapse": "nessun collasso", "all_collapse": "tutt"}.items():
            assert said in statuses.short_status(name), name


PAIRS = {
    ("mechanism", "one_sided"): "ribaltamento semplice", ("mechanism", "free_standing"): "due lati",
    ("mechanism", "two_block"): "flessione verticale", ("method", "linear"): "lineare",
    ("method", "nonlinear"): "non lineare", ("method", "dynamic"): "dinamica", ("method", "site"): "sito",
    ("method", "tie"): "catena", ("polarity", "as_recorded"): "come registrato", ("polarity", "reversed"): "invertito",
    ("errors", "clustered"): "per terremoto", ("errors", "naive"): "indipendenti", ("errors", "none"): "nessuno",
    ("expression", "where ties break"): "catene", ("expression", "where a seat is lost"): "appoggio",
    ("occurrence", "exclusive"): "esclusivi", ("occurrence", "independent"): "indipendenti",
    ("load_inertia", "both"): "orizzontale e verticale", ("load_inertia", "vertical"): "verticale",
    ("load_inertia", "none"): "nessuna", ("item", "tie 2"): "catena 2", ("item", "load 1"): "carico 1",
    ("item", "thrust 3"): "spinta 3", ("item", "section 1"): "tratto 1", ("item", "lower block"): "inferiore",
    ("item", "upper block"): "superiore", ("item", "friction 1"): "attrito", ("item", "mass 2"): "massa",
}  # fmt: skip


@pytest.mark.parametrize(("column", "value"), PAIRS)
def test_words_of_cells_by_their_keys(column, value):
    with ITALIAN.in_force():
        found = words.in_words(column, value)
    assert PAIRS[column, value] in found
    if column == "method" and value == "linear":
        assert not found.startswith("non")


def test_forces_in_italian_warnings_are_in_the_unit_that_they_say():
    numbers = {"anchor_force_per_m": 12340.0, "bar_force_per_m": 45670.0}
    told = dd.errors.DondoloWarning("sentence", "anchor_before_bar", {"item": "tie 2"}, numbers)
    said = words.warning(ITALIAN, told)
    assert re.search(r"catena 2 cede a 12,34\s+kN/m, .* 45,67\s+kN/m", said), said
    for code, text in ITALIAN.all_named("warning").items():
        for name, unit in re.findall(r"\{(\w*_force\w*)\}\s+(\S+?)[,;. ]", text):
            # Of whole bodies a sentence of forces per metre leaves the metre out.
            assert unit in (("kN/m", "kN{per}") if name.endswith("_per_m") else ("kN",)), code


VERDICTS = {
    "verified": ("soddisfatta", r"\bsatisfied$"),
    "not verified": ("NON soddisfatta", "NOT satisfied"),
    "verified if its ties are": ("catene", "ties"),
    "verified if no hinge slides": ("cerniera", "hinge"),
    "not applicable": ("non applicabile", "not applicable"),
}


def test_verdicts_by_their_keys():
    from dondolo.reporting.relazione.checks import _OUTCOMES

    assert set(_OUTCOMES) == set(VERDICTS)
    for name, (italian, english) in VERDICTS.items():
        assert re.search(english, _OUTCOMES[name])
        assert italian in Language("it").text(_OUTCOMES[name])
    assert Language("it").text(_OUTCOMES["verified"]) == "soddisfatta"
    with Language("it").in_force():
        assert {name: check_name(name, "SLV") for name in ("linear", "nonlinear")} == {
            "linear": "SLV lineare", "nonlinear": "SLV non lineare"
        } or {name: "non" in check_name(name, "SLV") for name in ("linear", "nonlinear")} == {
            "linear": False, "nonlinear": True
        }  # fmt: skip


def stems(text):
    """Beginnings of the words of a text that mean something."""
    return {word[:5] for word in re.findall(r"[a-zà-ù]{4,}", text.lower())} - {
        "della",
        "delle",
        "dello",
        "degli",
        "ogni",
    }


def test_heads_of_properties_mean_what_the_properties_mean():
    """Heads and meanings word a property from a stem that both have."""
    heads, meanings = (ITALIAN.all_named(what) for what in ("head of a column", "property of a case"))
    apart = {"alpha", "capacity", "hinge", "level", "side", "mechanism", "load_inertia", "hinge_depth", "histories",
             "restitution", "restitution_value", "thrust", "tie_depth"}  # fmt: skip
    both = [name for name in heads if name in meanings and name not in apart]
    assert len(both) > 40
    for name in both:
        assert stems(heads[name]) & stems(meanings[name]), (name, heads[name], meanings[name])


def test_heads_of_a_sheet_mean_what_its_quantities_mean():
    """Symbols and words of the columns of checks of many walls are those of the sheet of one."""
    heads, meanings = (ITALIAN.all_named(what) for what in ("head of a column", "quantity of a check"))
    for name in ("mass_ratio",):
        assert stems(heads[name]) & stems(meanings[name]), name
    ends = {"linear_sld": ("SLD", "lineare"), "linear_slv": ("SLV", "lineare"), "nonlinear_slv": ("SLV", "non lineare"),
            "nonlinear_slc": ("SLC", "non lineare")}  # fmt: skip
    for name, (state, method) in ends.items():
        assert heads[name] == f"capacità a_g S, {state} {method}"
        assert heads[f"{name}_ratio"] == f"capacità/domanda, {state} {method}"
    for name in ("theta", "beta", "ratio", "first", "total"):
        for end, word in (("low", "inizio"), ("high", "fine")):
            text = heads[f"{name}_{end}"]
            assert word in text, name
    for share in (16, 50, 84):
        assert str(share) in heads[f"fractile_{share}"]
    for name in ("value", "theta"):
        for share in (5, 95):
            assert f"{share} %" in heads[f"{name}_{share}"]


# --- Columns of reports


@pytest.fixture(scope="module")
def population(few):
    """Walls of two kinds under a few records, with their results."""
    walls = [
        dd.OneSidedWall(1.6, 0.27, density=1750.0, name="a"),
        dd.TwoBlockWall(2.9, 0.24, density=1900.0, overburden=9e3, overburden_inertia=0.4, eccentricity=0.03, name="b"),
        dd.FreeStandingWall(1.1, 0.2, name="c"),
    ]
    with pytest.warns(dd.errors.DondoloWarning):
        return dd.typology(walls, few, [0.15, 0.3, 0.5, 0.9], progress=False)


def tables_of(path):
    """Tables of a report: caption -> head -> cells."""
    found = {}
    for caption, body in re.findall(r"<table[^>]*><caption>(.*?)</caption>(.*?)</table>", path.read_text(), flags=re.S):
        cells = [re.findall(r"<t[hd]\b[^>]*>(.*?)</t[hd]>", row, re.S) for row in re.findall("<tr.*?</tr>", body, re.S)]
        rows = [[html.unescape(re.sub(r"<[^>]+>", "", cell)).strip() for cell in row] for row in cells]
        found[" ".join(caption.split())] = {
            head: [row[place] for row in rows[1:]] for place, head in enumerate(rows[0])
        }
    return found


def to_number(text):
    text = text.replace("\N{MINUS SIGN}", "-").replace("\N{NARROW NO-BREAK SPACE}", "").replace(",", ".")
    text = text.replace("∞", "inf")
    return float("nan") if text in ("\N{EN DASH}", "") else float(text)


def test_columns_of_a_report_are_those_of_the_frame(population, tmp_path):
    """Times what the unit of the head is of the unit that the name of the frame's column ends with."""
    pytest.importorskip("pandas")
    frame = population.population.to_frame()
    dd.report(population, tmp_path / "report.html", lang="en")
    tables = tables_of(tmp_path / "report.html")
    main = next(table for caption, table in tables.items() if caption.startswith("Walls and mechanisms"))
    statics = next(table for caption, table in tables.items() if caption.startswith("Statics"))
    seen = 0
    for heads in (main, statics):
        for head, cells in heads.items():
            words, _blank, unit = head.removesuffix("]").partition(" [")
            name = {"p": "p", "a0": "trigger_acceleration", "hinge / height": "hinge", "ecc.": "eccentricity",
                    "of it lifted": "overburden_inertia", "restitution e": "restitution"}.get(words, words)  # fmt: skip
            own = [
                one for one in frame.columns if re.fullmatch(rf"{name}(_(kg_m3|m_s2|rad_s|n_m|kg_m|rad|m|g|pa))?", one)
            ]
            if not own or words in ("wall", "mechanism"):
                continue
            (column,) = own
            base = unit_of_ending(column.removeprefix(name))
            assert dimension(unit.replace("g", "m/s2") if unit == "g" else unit) == dimension(base), head
            gravity = 9.81 / 9.80665 if unit == "g" else 1.0
            factor = size(base) / (size(unit) * gravity)
            shown = np.array([to_number(cell) for cell in cells])
            assert shown == pytest.approx(factor * frame[column].to_numpy(float), rel=1e-3, nan_ok=True), head
            seen += 1
    assert seen >= 9
    assert main["wall"] == list(frame["wall"] if "wall" in frame else frame["name"])


@pytest.fixture(scope="module")
def uneven(few, wall):
    """Stripes of which not all levels have all records."""
    return dd.multiple_stripe(wall, {0.45: few[:4], 0.7: few, 1.1: few[:7]}, [0.45, 0.7, 1.1], progress=False)


def cards_of(blocks):
    """Cards by their names: values, and what is said of them."""
    (cards,) = (one for one in blocks if isinstance(one, Cards))
    return {texts(name): (texts(value), texts(note)) for name, value, note in cards.entries}


def tables_in(blocks):
    return [one.table for one in blocks if isinstance(one, CaptionedTable)]


def texts(pieces):
    if isinstance(pieces, tuple):
        return "".join(map(texts, pieces))
    return (
        getattr(pieces, "text", None) + pieces.unit
        if hasattr(pieces, "unit")
        else str(getattr(pieces, "letter", pieces))
    )


def test_shares_of_a_wall_are_of_the_histories_that_ran(uneven):
    """Not of the cells of a table; medians are those of the levels."""
    assert not uneven.ran.all()
    cards = cards_of(summary(uneven, uneven.fit()))
    assert cards["histories"][0] == str(int(uneven.histories.sum()))
    share = 100.0 * uneven.collapses.sum() / uneven.histories.sum()
    assert float(cards["collapses"][1].partition(" %")[0]) == pytest.approx(share, rel=5e-3)
    table = tables_in(numbers_of_a_wall(uneven, [uneven.fit()]))[-1]
    cells = {texts(column.head): [texts(one) for one in column.cells] for column in table.columns}
    assert [float(one) for one in cells["fraction"]] == pytest.approx(uneven.collapses / uneven.histories, abs=1e-4)


def test_medians_of_stripes_are_medians(few, wall):
    stripes = dd.multiple_stripe(wall, few, [0.3, 0.6], progress=False)
    table = tables_in(numbers_of_a_wall(stripes, [stripes.fit()]))[-1]
    (cells,) = [column.cells for column in table.columns if column.head == "median EDP"]
    assert [float(one.text) for one in cells] == pytest.approx(
        [statistics.median(row) for row in stripes.edp], rel=5e-3
    )


def test_a_hazard_that_is_too_short_is_told_from_one_per_cent_on(few, wall):
    """Each curve whose bounds differ by more, and no other."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        stripes = dd.multiple_stripe(wall, few, [0.3, 0.5, 0.7, 0.9, 1.2], progress=False)
        curve = stripes.fit()
        for end in np.geomspace(0.6, 3.0, 25):
            levels = np.geomspace(0.01, end, 12)
            hazard = dd.HazardCurve(levels, 1e-4 * levels**-2.2)
            risk = curve.risk(hazard)
            low, high = risk.bounds
            assert risk.return_period_bounds == (1.0 / high, 1.0 / low)
            assert risk.return_period_bounds[0] <= risk.return_period_bounds[1]
            _blocks, found = risk_chapter(run.run_of(stripes), hazard, Language("en"))
            told = [one for one in found if "too short" in one]
            differs = high / low - 1.0
            if differs > 0.0102:
                assert told, (end, differs)
                assert told[0].endswith("collapse"), told
                assert "1 %" in told[0]
            elif differs < 0.0098:
                assert not told, (end, differs)


# --- Sets of records and figures


def test_dispersion_of_a_selection_is_that_of_a_sample(records):
    periods = np.array([0.1, 0.3, 0.8])
    found = dd.RecordSet(records).select(dd.TargetSpectrum.ec8(0.3, soil="B", periods=periods), 5)
    for place in range(len(periods)):
        logarithms = [float(np.log(row[place])) for row in found.sa]
        assert found.dispersion[place] == pytest.approx(statistics.stdev(logarithms), rel=1e-12)
        assert found.median[place] == pytest.approx(np.exp(statistics.fmean(logarithms)), rel=1e-12)


# EN 1998-1, tables 3.2 and 3.3: S, T_B, T_C, T_D of grounds A to E
GROUNDS = {
    1: (
        (1.0, 0.15, 0.4, 2.0),
        (1.2, 0.15, 0.5, 2.0),
        (1.15, 0.2, 0.6, 2.0),
        (1.35, 0.2, 0.8, 2.0),
        (1.4, 0.15, 0.5, 2.0),
    ),
    2: (
        (1.0, 0.05, 0.25, 1.2),
        (1.35, 0.05, 0.25, 1.2),
        (1.5, 0.1, 0.25, 1.2),
        (1.8, 0.1, 0.3, 1.2),
        (1.6, 0.05, 0.25, 1.2),
    ),
}


@pytest.mark.parametrize("kind", GROUNDS)
def test_spectra_of_eurocode_8(kind):
    """Four points of the spectrum of each ground, 3.2.2.2."""
    for soil, (factor, tb, tc, td) in zip("ABCDE", GROUNDS[kind], strict=True):
        found = dd.TargetSpectrum.ec8(0.2, soil=soil, kind=kind, periods=[0.5 * tb, tb, tc, td, 2.0 * td])
        shape = [1.75, 2.5, 2.5, 2.5 * tc / td, 2.5 * tc / (4.0 * td)]
        assert found.sa == pytest.approx(0.2 * factor * np.array(shape), rel=1e-12), soil


@pytest.mark.parametrize("confidence", [0.5, 0.68, 0.9, 0.95, 0.99])
def test_labels_of_a_band_and_of_bars_say_their_confidence(confidence):
    """And both are drawn with it."""
    from scipy import stats

    curve = dd.fit_fragility([0.2, 0.4, 0.6], [3, 11, 18], 20, im="pga")
    ax = curve.plot(confidence=confidence)
    labels = [text.get_text() for text in ax.get_legend().get_texts()]
    share = f"{100.0 * confidence:.4g} %"
    (band,) = [text for text in labels if text.startswith("band")]
    (bars,) = [text for text in labels if "fractions" in text]
    assert share in band
    assert share in bars
    assert sum("%" in text for text in labels) == 2
    (area,) = [one for one in ax.collections if type(one).__name__ in ("PolyCollection", "FillBetweenPolyCollection")]
    points = area.get_paths()[0].vertices
    x = 0.4
    low, high = curve.interval([x], confidence=confidence)
    at = points[np.abs(points[:, 0] - points[np.argmin(np.abs(points[:, 0] - x)), 0]) < 1e-12, 1]
    assert (at.min(), at.max()) == pytest.approx((float(low[0]), float(high[0])), abs=0.01)
    (container,) = ax.containers
    segments = np.array(container[2][0].get_segments())
    tail = 0.5 - 0.5 * confidence
    for (_x, bottom), (_same, top), z in zip(segments[:, 0], segments[:, 1], (3, 11, 18), strict=True):
        assert bottom == pytest.approx(stats.beta.ppf(tail, z, 21 - z), rel=1e-9)
        assert top == pytest.approx(stats.beta.ppf(1.0 - tail, z + 1, 20 - z), rel=1e-9)
    plt.close(ax.figure)


# --- What the page draws and says


def walls_to_draw():
    tie = dd.Tie(5.2, depth=0.1, area=5e-5, length=8.0, strength=2e8)
    yield dd.OneSidedWall(
        6.0,
        0.5,
        loads=[
            dd.Load(7e3, depth=0.15, height=5.5, inertia="both"),
            dd.Load(3e3, depth=0.4, height=3.0, inertia="none"),
        ],
        thrusts=[dd.Thrust(2e3, height=5.0, depth=0.45), dd.Thrust(1e3, height=4.0, depth=0.2)],
        ties=[tie],
        name="drawn",
    )
    yield dd.OneSidedWall(
        sections=[dd.Section(3.0, 0.6), dd.Section(2.5, 0.45)], thrusts=[dd.Thrust(9e2, height=4.6)], name="storeys"
    )


@pytest.mark.parametrize("wall", walls_to_draw(), ids=lambda one: one.name)
def test_forces_are_drawn_where_the_calculation_has_them(wall):
    """Loads, thrusts and ties of the page: depth, height and force are those of the items of the check."""
    drawn = picture(wall)
    items = dd.check_ntc(wall, dd.Site(0.2, 2.5, 0.35, soil="B")).items
    for word, places in (("load", drawn["loads"]), ("thrust", drawn["thrusts"]), ("tie", drawn["ties"])):
        own = [item for item in items if item.item.startswith(f"{word} ")]
        assert len(own) == len(places), word
        for item, (x, y, *rest) in zip(own, places, strict=True):
            assert x == pytest.approx(wall.thickness - item.depth, abs=1e-12), item.item
            assert y == pytest.approx(item.lever), item.item
            if word != "tie":
                assert rest[0] == pytest.approx(item.force), item.item


STATE = {
    "job": {"task": "stripes"},
    "wall": {"mechanism": "one_sided", "height": 5.0, "thickness": 0.45, "density": 1800.0,
             "load": [9e3], "load_height": [5.0], "load_depth": [0.15], "load_inertia": "both",
             "tie_height": [4.7], "tie_area": [4e-5], "tie_length": [7.0], "tie_anchor_force": [5e3]},
    "records": {"polarity": "both"},
    "stripes": {"im": "pga", "levels": [0.2, 0.4, 0.6, 0.9]},
    "check": {"ag": [0.09, 0.22, 0.29], "f0": [2.4, 2.4, 2.5], "tc_star": [0.28, 0.33, 0.36], "soil": "C",
              "topography": "T2", "knowledge_factor": 1.2},
}  # fmt: skip


@pytest.mark.parametrize("lang", ["en", "it"])
def test_every_number_of_the_page_is_the_library_s(lang, root):
    """Of the curve, of the wall and of its check, at the peak acceleration of the site with its soil."""
    from dondolo.serve.bench import Bench

    bench = Bench(root / "data/records/synthetic44.csv")
    answer = bench.curve({"settings": STATE, "lang": lang})
    case = dd.results.Case.from_text(answer["text"], bench.records)
    wall = case.population.walls[0]
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        stripes = dd.multiple_stripe(
            wall, bench.records, case.levels, im=case.im, polarity=case.polarity, progress=False
        )
        curve = stripes.fit()
        check = dd.check_ntc(wall, case.site, knowledge_factor=case.knowledge_factor)
    assert (answer["theta"], answer["beta"], answer["status"]) == (curve.theta, curve.beta, curve.status)
    assert answer["sentence"] == Language(lang).named("status", curve.status, statuses.STATUSES[curve.status])
    assert answer["interval"] == list(curve.parameter_interval()["theta"])
    assert answer["p"] == curve(np.array(answer["x"])).tolist()
    low, high = curve.interval(answer["x"][1:])
    assert answer["band"] == [[0.0, *low.tolist()], [0.0, *high.tolist()]]
    assert answer["stripes"] == [list(case.levels), stripes.collapses.tolist(), stripes.histories.tolist()]
    assert answer["histories"] == stripes.histories.sum()
    assert answer["trigger"] == wall.trigger_acceleration / wall.gravity
    assert answer["greatest"] == wall.greatest_acceleration / wall.gravity
    found = answer["check"]
    pga = check.value("site", "SLV", "pga")
    assert pga > 1.3 * check.value("site", "SLV", "ag")
    assert found["pga"] == pga
    assert found["probability"] == float(curve(pga))
    assert found["alpha_0"] == check.value("mechanism", "", "alpha_0")
    expected = {(row.method, row.limit_state): row.value for row in check.rows if row.quantity == "capacity_pga"}
    void = {(row.method, row.limit_state) for row in check.rows if row.quantity == "applicable" and row.value == 0.0}
    assert void == {("linear", "SLV")}
    assert {(method, state): value for method, state, value in found["capacities"]} == {
        key: value for key, value in expected.items() if key not in void
    }
    for method, state, verdict, required in found["verdicts"]:
        assert required == ((method, state) == ("nonlinear", "SLV"))
        holds = check.value(method, state, "verified") == 1.0
        if (method, state) in void:
            assert verdict == "not applicable"
        else:
            assert verdict == ("verified if its ties are" if holds else "not verified")
    assert found["notes"] == [words.warning(Language(lang), note) for note in check.notes]


# --- What a calculation report says of the code


@pytest.mark.parametrize(("lang", "least", "classes"), [("en", "at least 0.6 for schools", "raised by at least 0.1"),
                                                        ("it", "0,6", "0,1")])  # fmt: skip
def test_what_improvement_asks_for(lang, least, classes):
    """NTC 2018, 8.4.2: 0.6 for schools of class III and class IV, 0.1 more for others; 8.4.3: 1.0, or 0.80."""
    document, (first, second) = two_states(lang)
    tables = [block.table for block in outcome.summary(document) if hasattr(block, "table")]
    (asked,) = [table for table in tables if "NTC 8.3" in table.columns[-1].cells]
    _work, conditions, places = asked.columns
    assert list(places.cells) == ["NTC 8.3", "NTC 8.4.1, C8.4.1", "NTC 8.4.2", "NTC 8.4.3"]
    words = "; ".join(map(document.language.plain, conditions.cells))
    numbers = re.findall(r"(?<![\w.])\d[.,]\d+(?![.\d])", words)
    assert [float(one.replace(",", ".")) for one in numbers] == [0.6, 0.1, 1.0, 0.8]
    assert least in words
    assert classes in words
    (differences,) = [block.table for block in outcome._differences(document) if hasattr(block, "table")]
    cells = [to_number(cell.text) for cell in differences.columns[1].cells]
    keys = [
        ("mechanism", "", "alpha_0"),
        ("mechanism", "", "a_0"),
        ("linear", "SLV", "zeta_e"),
        ("nonlinear", "SLV", "zeta_e"),
    ]
    for key, cell in zip(keys, cells, strict=False):
        assert cell == pytest.approx(second.value(*key) - first.value(*key), rel=1e-3), key


def two_states(lang):
    site = dd.Site((0.09, 0.24, 0.31), 2.45, 0.33, soil="C")
    tie = dd.Tie(4.6, area=2e-5, length=6.0, strength=2e8, anchor_force=1e6)
    walls = [dd.OneSidedWall(5.0, 0.45, name="now"), dd.OneSidedWall(5.0, 0.45, ties=[tie], name="then")]
    made = [dd.check_ntc(wall, site) for wall in walls]
    subjects = Subjects(tuple(Subject(check.wall, check, None, None) for check in made))
    return Document(Language(lang), project.Project(), subjects), made


# --- Words of the page


def test_labels_of_the_page_mean_what_the_properties_mean():
    """In both languages a label has a word of the meaning of its property, or of its name or head."""
    from dondolo._fortran.library import properties

    page = (Path(dd.__file__).parent / "serve/page/words.js").read_text()
    english = dict(re.findall(r'^  (\w+): "(.*)",$', page.partition("const LABELS")[2], re.M))
    rows = [
        row
        for group in ("job", "wall", "building", "records", "stripes", "solver", "check")
        for row in properties(group)
    ]
    italian, heads, meanings = (
        ITALIAN.all_named(what) for what in ("label of the page", "head of a column", "property of a case")
    )
    # Symbols, and labels that say it in other words
    apart = {"section_offset", "load_x", "inertia_x", "thrust_x", "polarity", "ag", "f0", "tc_star"}
    apart_in_italian = {"title", "thrust_decay", "masonry_knowledge_factor", "table", "weight", "sides", "catalogue",
                        "certify", "soil"}  # fmt: skip
    assert {row.name for row in rows} == set(english)
    for row in rows:
        name = row.name
        if name in italian and name not in apart_in_italian:
            assert stems(italian[name]) & stems(f"{meanings[name]} {heads.get(name, '')}"), (name, italian[name])
        if name not in apart:
            assert stems(english[name]) & stems(f"{row.meaning} {name.replace('_', ' ')}"), (name, english[name])


# What the Italian of a bound, and of a size of the wall, must say
BOUNDS = {
    "at least": "almeno", "at most": "al più", "more than 0": "maggiore di 0", "less than": "minore di",
    "positive": "positivo", "within height": "altezza", "within depth": "facce",
}  # fmt: skip


def test_refusals_say_their_bounds():
    found = ITALIAN.all_named("refusal of the page")
    for name, said in BOUNDS.items():
        assert [one for one in BOUNDS if said in found[one]] == [name]
    assert all("{h}" in text for text in found.values() if "altezza della parete, {" in text)
    assert all(
        "{t}" in text for text in found.values() if "spessore, {" in text or "facce della parete, da 0 a {" in text
    )


def test_places_of_italian_warnings_are_in_order():
    """From the first to the last, from the lower to the upper, from what is said of all to what is said of some."""
    pairs = [("first_level", "last_level"), ("shortest_s", "longest_s"), ("less_sld", "tied_sld"),
             ("records_beyond", "records"), ("histories_beyond", "histories"), ("curves", "of_curves"),
             ("factors_beyond", "factors")]  # fmt: skip
    for code, text in ITALIAN.all_named("warning").items():
        for first, last in pairs:
            if f"{{{first}}}" in text and f"{{{last}}}" in text:
                assert text.index(f"{{{first}}}") < text.index(f"{{{last}}}"), (code, first, last)


# --- Numbers of reports


@pytest.fixture(scope="module")
def judged(wall, few):
    """A wall under a few records, whose histories are certified, with its hazard."""
    levels = np.geomspace(0.02, 2.0, 10)
    hazard = dd.HazardCurve(
        levels, 1e-4 * levels**-2.2, fractiles={0.16: 5e-5 * levels**-2.2, 0.84: 2e-4 * levels**-2.2}
    )
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        stripes = dd.multiple_stripe(wall, few, [0.3, 0.5, 0.7, 0.9, 1.2], certify=True, progress=False)
        return stripes, stripes.fit(), hazard


def column_of(table, head):
    """Cells of a column of a report's table, as text."""
    (cells,) = [column.cells for column in table.columns if texts(column.head) == head]
    return [texts(one) for one in cells]


def numbers_in(text):
    return [to_number(one) for one in re.findall(r"\d+(?:\.\d+)?", text)]


def test_what_is_said_of_a_wall_is_of_its_curve(judged):
    """Cards and intervals, each beside what the library has."""
    stripes, curve, _hazard = judged
    cards = cards_of(summary(stripes, curve))
    for name, value, error in (("median", curve.theta, curve.se_ln_theta), ("dispersion", curve.beta, curve.se_beta)):
        (found,) = [card for head, card in cards.items() if head.startswith(name)]
        assert [numbers_in(part)[-1 if place else 0] for place, part in enumerate(found)] == pytest.approx(
            [value, error], rel=5e-3
        )
    (intervals,) = tables_in(wall_facts.uncertainty(curve))
    for name, letter in (("theta", "θ"), ("beta", "β")):
        for place, end in enumerate(("from", "to")):
            shown = column_of(intervals, f"{letter} {end}")
            assert to_number(shown[0]) == pytest.approx(curve.parameter_interval()[name][place], rel=5e-4)


def test_what_is_said_of_the_risk_is_the_hazard_s(judged):
    stripes, curve, hazard = judged
    blocks, _found = risk_chapter(run.run_of(stripes), hazard, Language("en"))
    table, risk = tables_in(blocks)[-1], curve.risk(hazard)
    ends = [[to_number(one) for one in column_of(table, head)] for head in ("pga from [g]", "to [g]")]
    assert ends[0] == pytest.approx(hazard.levels[:-1], rel=5e-4)
    assert ends[1] == pytest.approx(hazard.levels[1:], rel=5e-4)
    exceeded = [read(one)[0] for one in next(one.cells for one in table.columns if "exceeded" in texts(one.head))]
    assert exceeded == pytest.approx(hazard.annual_frequency[:-1], rel=5e-3)
    *_more, on_tails = (one for one in blocks if isinstance(one, Paragraph))
    (tails,) = on_tails.pieces
    shown = [read(one)[0] for one in tails if isinstance(one, numerals.Numeral)]
    assert shown == pytest.approx([*risk.above, risk.below[1]], rel=5e-3)


NUMBER = r"\d+(?:\.\d+)?(?: \N{MULTIPLICATION SIGN} 10\N{MINUS SIGN}?\d+)?"


def in_figures(text):
    """A number of a page, perhaps with a power of ten."""
    digits, _, power = text.replace("\N{MINUS SIGN}", "-").partition(" \N{MULTIPLICATION SIGN} 10")
    return float(digits) * 10.0 ** float(power or 0)


def test_ranges_of_reports_ascend(judged, population, tmp_path):
    """Of every sentence and cell 'between a and b' and 'a to b', and of every pair of columns 'from' and 'to'."""
    stripes, _curve, hazard = judged
    found = 0
    for name, results in (("wall", stripes), ("people", population)):
        path = tmp_path / f"{name}.html"
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            dd.report(results, path, hazard=hazard)
        page = re.sub(r"<style>.*?</style>|<pre>.*?</pre>", "", path.read_text(), flags=re.S)
        text = " ".join(html.unescape(re.sub(r"</?t[dhr][^>]*>", " | ", page)).split())
        text = re.sub(r"<[^>]*>", "", text)
        for between in (
            rf"\b(?:between|from) ({NUMBER})[\w ]{{0,4}} (?:and|to) ({NUMBER})",
            rf"({NUMBER}) to ({NUMBER})",
        ):
            for low, high in re.findall(between, text):
                found += 1
                assert in_figures(low) <= in_figures(high), (low, high)
        for caption, table in tables_of(path).items():
            for head in [one for one in table if one == "from" or one.endswith(" from")]:
                other = head.removesuffix("from") + "to"
                for low, high in zip(table[head], table.get(other, []), strict=False):
                    found += 1
                    assert not to_number(low) > to_number(high), (caption, head)
    assert found > 20


def test_histories_that_are_not_computable_widen_bounds(judged):
    """Fractions and medians of certified histories are between those of none and of all of them."""
    stripes, curve, _hazard = judged
    lowest, highest, status = stripes.edp.copy(), stripes.edp.copy(), stripes.status.copy()
    doubtful = np.flatnonzero(~stripes.collapsed[2])[:4]
    highest[2, doubtful], status[2, doubtful] = 1.0, dd.results.Certified.NOT_COMPUTABLE
    bounded = dataclasses.replace(stripes, edp_lowest=lowest, edp_highest=highest, status=status)
    ends = bounded.exceedance_bounds(1.0)
    assert np.any(ends[0] < ends[1])
    told = wall_facts.certificates(bounded, [curve], "separate")
    medians, levels = tables_in(told)
    (cells,) = [one.cells for one in levels.columns if "fraction" in texts(one.head)]
    for cell, low, high, n in zip(cells, *ends, bounded.histories, strict=True):
        assert numbers_in(texts(cell)) == pytest.approx([low / n] if low == high else [low / n, high / n], abs=1e-4)
    ((low, high),) = bounded.state_bounds([1.0], states="separate")
    for name, value in (("lowest", low), ("greatest", high)):
        (cells,) = [one.cells for one in medians.columns if name in texts(one.head)]
        assert to_number(texts(cells[0])) == pytest.approx(value, rel=5e-4)


def test_shares_of_a_population_are_those_at_their_levels(population):
    *_cards, told = typology.summary(population)
    shares = [part[:3:2] for part in told.pieces if isinstance(part, tuple)]
    assert len(shares) > 1
    curve = dict(zip((f"{level:g}" for level in population.levels), population["all"].mean_curve, strict=True))
    for share, level in shares:
        expected = curve[texts(level).removesuffix(" g")]
        assert texts(share) == texts(numerals.percent(expected))


def test_curves_of_a_calculation_report(judged):
    """Median, its interval, dispersion and the probability at a_g S of the ultimate state."""
    _stripes, curve, _hazard = judged
    check = dd.check_ntc(dd.OneSidedWall(5.0, 0.45), dd.Site((0.3, 0.6, 0.8), 2.45, 0.33, soil="C"))
    document = Document(Language("en"), project.Project(), Subjects((Subject(check.wall, check, curve, None),)))
    (table,) = [block.table for block in outcome.fragility(document) if hasattr(block, "table")]
    low, high = curve.parameter_interval()["theta"]
    expected = {
        "median θ [g]": curve.theta, "95 % interval from": low, "to": high, "dispersion β": curve.beta,
        "probability at ag S": float(curve(check.pga)),
    }  # fmt: skip
    for head, value in expected.items():
        (cell,) = next(one.cells for one in table.columns if document.language.plain(one.head).replace("_", "") == head)
        assert to_number(cell.text) == pytest.approx(value, rel=1e-3), head


def test_nodes_of_a_site_are_where_their_distances_say():
    """On a sphere, to 1 %: latitudes are no longitudes, and places are those of the datum of the grid."""
    site = dd.Site(latitude=42.35, longitude=13.4, nominal_life=50)
    mesh = site.hazard.mesh
    columns = site_grid._nodes(Document(Language("en"), project.Project(), None), mesh)
    numbers = [[to_number(one.text) for one in cells] for cells in list(columns.values())[1:]]
    for latitude, longitude, distance in zip(*numbers, strict=True):
        north, east = (math.radians(one) for one in (latitude - mesh.latitude, longitude - mesh.longitude))
        assert math.hypot(north, east * math.cos(math.radians(latitude))) * 6371.0 == pytest.approx(distance, rel=0.01)
