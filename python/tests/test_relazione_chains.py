"""Calculation reports of chains of rigid bodies and of facades with wedges: units, words, tables and steps."""

import re

import matplotlib
import matplotlib.pyplot
import numpy as np
import pytest
from test_relazione import CHECK, ENGLISH, of_page, run_in
from test_rigid_chains import CHAINS

import dondolo as dd
from dondolo.reporting.relazione import chains
from dondolo.reporting.relazione.subjects import subjects_of
from dondolo.reporting.relazione.sums import sums_of
from dondolo.reporting.relazione.tabulated import Terms

matplotlib.use("agg")


@pytest.fixture(scope="module")
def strip(tmp_path_factory, executable, root):
    """A strip over two storeys with a load that is held, a mass and a thrust, of a case."""
    folder = tmp_path_factory.mktemp("chains")
    own = CHAINS["strip"]["actions"]
    extra = [dd.PointMass(1, (-0.25, 2.0), 300.0), dd.PointThrust(2, (-0.39, 5.0), 500.0)]
    chain = dd.Chain(**{**CHAINS["strip"], "sides": 1, "actions": [*own, *extra]})
    chain.write_tables(folder / "strip")
    files = ", ".join(f"{what} = 'strip_{what}.csv'" for what in ("bodies", "joints", "actions"))
    wall = f"name = 'fascia', mechanism = 'chain', height = 6.8, sides = 1, restitution_value = 0.9, {files}"
    return run_in(folder, executable, root, "out", wall)


@pytest.fixture(scope="module")
def pages(strip, tmp_path_factory):
    folder = tmp_path_factory.mktemp("pages")
    found = {}
    for lang in ("en", "it"):
        left = dd.calculation_report(strip, folder / f"{lang}.html", lang=lang)
        assert "chain_hinges" in left
        assert "inward_rotation" not in left
        found[lang] = of_page(folder / f"{lang}.html")
    return found


def test_forces_of_a_chain_are_those_of_the_whole(pages):
    for lang, words in (
        ("en", "Forces are those of the whole chain"),
        ("it", "Le forze sono quelle dell'intera catena cinematica"),
    ):
        text = pages[lang]
        assert words in text
        assert "kN/m" not in text
        assert "kNm/m" not in text
        assert "t/m" not in text.replace("t/m³", "")
        assert ("per metre of wall" if lang == "en" else "per metro di parete") not in text
        assert re.search(r"P, H, T \[kN\]", text)
        # What is said of corners, which are whole as well
        assert ("corner" if lang == "en" else "cantonale") not in text


def test_an_italian_report_of_a_chain_has_no_english(pages):
    text = pages["it"]
    words = set(re.findall(r"(?<![\w./-])[a-z]+(?![\w./-])", re.sub(r"\S*[_/]\S*", " ", text.lower())))
    assert words & set(ENGLISH.split()) == set()
    for part in ("massa trascinata", "trattenuto in orizzontale", "cerniera", "guida", "spinta a 0°"):
        assert part in text


def test_the_items_give_the_multiplier(strip):
    """Bodies, loads, the mass and the thrust have their parts; a load that is held counts in the moment alone."""
    items = {item.item: item for item in strip.check.items}
    assert list(items) == ["body 1", "body 2", "load 1", "load 2", "mass 1", "thrust 1"]
    assert np.isnan(items["load 2"].force_lever)
    assert np.isnan(items["mass 1"].stabilising)
    assert items["mass 1"].force == pytest.approx(300.0 * 9.81, rel=1e-12)
    sums = sums_of(strip.check.items)
    assert sums["alpha_0"] == pytest.approx(strip.check.value("mechanism", "", "alpha_0"), rel=1e-12)
    assert strip.check._row("mechanism", "", "mass").unit == "kg"
    assert strip.check._row("mechanism", "", "friction_needed") is None
    assert "sliding_unknown" in {note.code for note in strip.check.notes}


def test_the_steps_from_the_positions_give_the_check(strip):
    """M, S and d at d_0* and at d_C follow from the positions of the bodies."""
    one = subjects_of([strip]).several[0]
    terms = Terms(one)
    d0 = strip.check.value("mechanism", "", "d_0")
    assert terms.at("d", strip.stripes.wall.capacity_angle) == pytest.approx(d0, rel=1e-9)
    dc = strip.check.value("nonlinear", "SLV", "displacement")
    q = terms.rotation_of(dc)
    ratio, factor = (strip.check.value("mechanism", "SLV", name) for name in ("mass_ratio", "knowledge_factor"))
    a = terms.at("M", q) / terms.at("S", q) * 9.81 / (ratio * factor)
    assert a == pytest.approx(strip.check.value("nonlinear", "SLV", "acceleration"), rel=1e-7)


def test_masonry_that_stands_still(executable, root, tmp_path):
    """An arch on piers of which one stands still; its impact has an upper bound."""
    chain = dd.arch(1.75, 0.5, 180.0, voussoirs=8, pier=(1.0, 3.5), density=1900.0, sides=1, restitution_value=0.7)
    chain.write_tables(tmp_path / "arch")
    wall = (
        "name = 'arch', mechanism = 'chain', height = 5.5, sides = 1, restitution_value = 0.7,"
        " bodies = 'arch_bodies.csv', joints = 'arch_joints.csv'"
    )
    found = run_in(tmp_path, executable, root, "out", wall, CHECK)
    dd.calculation_report(found, tmp_path / "page.html", lang="en")
    text = of_page(tmp_path / "page.html")
    assert "Positions of the bodies do not give" not in text
    assert "ground, or masonry that stands still" in text
    assert "The chain moves outwards alone." in text
    assert "0.8267, an upper bound" in text


def test_the_drawing_of_a_chain(strip):
    """Both parts have one scale, all bodies and hinges, and loads with their letters."""
    from dondolo.reporting.language import Language
    from dondolo.reporting.relazione.document import Document
    from dondolo.reporting.relazione.project import Project

    subjects = subjects_of([strip])
    document = Document(Language("it"), Project(), subjects)
    ax = chains.draw_chain(document, subjects.several[0])
    rest, moved = ax.figure.axes
    assert rest.get_xlim() == moved.get_xlim()
    words = [one.get_text() for one in rest.texts]
    assert {"1", "2", "N1 = 12 kN", "N2 = 8 kN", "Q1 = 2,943 kN", "H1 = 0,5 kN"} <= set(words)
    assert len(moved.patches) == 2 * len(rest.patches) == 6
    matplotlib.pyplot.close(ax.figure)


def test_a_facade_with_wedges_overturns_compoundly(executable, root, tmp_path):
    wall = (
        "name = 'facciata', mechanism = 'one_sided', height = 7, thickness = 0.55, density = 1900,"
        " facade_length = 6, wedge_thickness = 0.45, 0.45, wedge_angle = 20, wedge_bottom = 0, wedge_top = 7,"
        " wedge_length = 2.2, 9"
    )
    found = run_in(tmp_path, executable, root, "out", wall)
    for lang, words in (("en", "compound overturning"), ("it", "ribaltamento composto")):
        dd.calculation_report(found, tmp_path / "page.html", lang=lang)
        assert words in of_page(tmp_path / "page.html")
        dd.report(found, tmp_path / "report.html", lang=lang)
        assert f"facciata: {words}" in (tmp_path / "report.html").read_text()
