"""The calculation report: three formats of the same numbers, two languages, and what only the engineer writes."""

import dataclasses
import datetime
import html
import io
import math
import re
import shutil
import subprocess
import sys
import zipfile
from pathlib import Path

import matplotlib
import matplotlib.pyplot
import numpy as np
import pytest

import dondolo as dd
from dondolo.__main__ import main
from dondolo.reporting import words
from dondolo.reporting.blocks import Fraction, linear, symbol_of
from dondolo.reporting.content import Symbol
from dondolo.reporting.language import Language
from dondolo.reporting.numerals import Numeral
from dondolo.reporting.relazione import drawings, project
from dondolo.reporting.relazione.document import Document
from dondolo.reporting.relazione.drawings import draw_anchor
from dondolo.reporting.relazione.subjects import subjects_of
from dondolo.reporting.relazione.sums import sums_of
from dondolo.reporting.statuses import STATUSES
from dondolo.reporting.units import CENTIMETRES, UNITS, quantity

WALL = (
    "name = '{name}', mechanism = 'one_sided', section_height = 3.8, 3.4, section_thickness = 0.70, 0.55,"
    " density = 2000\n"
    "load = 9e3, 7e3, load_height = 3.8, 7.2, load_depth = 0.55, 0.40, load_inertia = 'both',"
    " compressive_strength = 1e6\n"
    "thrust = 2.5e3, thrust_height = 6.6, thrust_depth = 0.55 {tie}"
)
TIE = (
    "\ntie_height = 6.6, tie_area = 1e-4, tie_length = 10, tie_strength = 235e6, tie_preload = 50e6, tie_strain"
    " = 0.02,"
    " tie_modulus = 2.06e11"
)
CHECK = "&check ag = 0.104, 0.261, 0.334, f0 = 2.332, 2.364, 2.4, tc_star = 0.281, 0.347, 0.364, soil = 'B' /\n"
STRIP = (
    "name = 'fascia', mechanism = 'two_block', height = 3, thickness = 0.25, overburden = 2e4, overburden_inertia = 1,"
    " eccentricity = 0.02"
)
# What no Italian document may have
ENGLISH = (
    "the of and with from wall walls check checks not is are tie ties load loads section hinge records record"
    " year years mass"
    " satisfied capacity displacement level unit value table figure warning warnings histories collapse at by for on"
)


def run_in(folder, executable, root, name, wall, check=CHECK):
    """Results of a case."""
    catalogue = root / "data/records/synthetic44.csv"
    (folder / f"{name}.nml").write_text(
        f"&job task = 'stripes', output = '{name}' /\n&wall\n{wall}\n/\n"
        f"&records catalogue = '{catalogue}' /\n{check}&stripes levels = 0.1, 0.2, 0.3, 0.5, 0.8, 1.2 /\n"
    )
    subprocess.run([executable, "--quiet", f"{name}.nml"], cwd=folder, capture_output=True, check=True)
    return dd.read_results(folder / name)


@pytest.fixture(scope="module")
def folder(tmp_path_factory, executable, root):
    """Runs of a facade as it stands and with a tie: the example of the design page."""
    place = tmp_path_factory.mktemp("relazione")
    run_in(place, executable, root, "fatto", WALL.format(name="facciata", tie=""))
    run_in(place, executable, root, "progetto", WALL.format(name="facciata con catena", tie=TIE))
    return place


@pytest.fixture(scope="module")
def both(folder):
    return [dd.read_results(folder / name) for name in ("fatto", "progetto")]


@pytest.fixture(scope="module")
def written(folder, both):
    """Documents by language and suffix."""
    made = {}
    suffixes = [".html"]
    if "docx" in sys.modules or __import__("importlib.util").util.find_spec("docx"):
        suffixes.append(".docx")
    if shutil.which("chromium"):
        suffixes.append(".pdf")
    for lang in ("en", "it"):
        for suffix in suffixes:
            made[lang, suffix] = folder / f"{lang}{suffix}"
            dd.calculation_report(both, made[lang, suffix], lang=lang)
    return made


def of_page(path):
    """Lines of text of a page: a line for each block, parts of formulas apart."""
    text = path.read_text(encoding="utf-8").partition("<main>")[2]
    text = re.sub(r"<math.*?</math>", lambda found: re.sub(r"<[^>]+>", " ", found[0]), text, flags=re.S)
    text = re.sub(r"<pre>.*?</pre>", "", text, flags=re.S)
    text = re.sub(r"</?(p|h\d|div|d[dt]|t[hdr]|caption|figcaption|thead|tbody|table|figure|img)\b[^>]*>", "\n", text)
    return html.unescape(re.sub(r"<[^>]+>", "", text))


def of_word(path):
    """The same of a file of Word, but for its contents, which the others lack."""
    import docx

    lines = []
    is_contents = False
    for paragraph in docx.Document(path).element.body.iter("{*}p"):
        runs = [*paragraph.iter("{*}t")]
        is_contents = is_contents or 'w:fldCharType="begin"' in paragraph.xml
        if is_contents:
            is_contents = 'w:fldCharType="end"' not in paragraph.xml
            continue
        if "Courier New" in paragraph.xml:
            continue
        is_math = paragraph.find(".//{*}oMath") is not None
        lines.append((" " if is_math else "").join(one.text for one in runs))
    # Long names may go on in the next line after these
    return "\n".join(lines).replace("\N{ZERO WIDTH SPACE}", "").replace("\N{NO-BREAK SPACE}", " ")


def of_pdf(path):
    return subprocess.run(["pdftotext", path, "-"], capture_output=True, text=True, check=True).stdout


def numbers(text):
    """All numbers of a text, in its order."""
    return re.findall(r"(?<!\w)\d+(?:[.,]\d+)?", text.replace("\N{NARROW NO-BREAK SPACE}", " "))


# --- The same in three formats and two languages


@pytest.mark.slow
@pytest.mark.parametrize("lang", ["en", "it"])
def test_three_formats_have_the_same_numbers(lang, written):
    pytest.importorskip("docx")
    page = numbers(of_page(written[lang, ".html"]))
    assert len(page) > 600
    assert numbers(of_word(written[lang, ".docx"])) == page
    if (lang, ".pdf") in written and shutil.which("pdftotext"):
        text = of_pdf(written[lang, ".pdf"])
        pages = {str(number) for number in range(1, text.count("\f") + 1)}
        # Names of files are broken at the ends of lines, and annexes have the case too.
        body = of_page(written[lang, ".html"]).partition({"en": "Annexes", "it": "Allegati"}[lang])[0]
        assert set(numbers(body)) - set(numbers(text)) == set()
        text = text.partition({"en": "Annexes\n", "it": "Allegati\n"}[lang])[0]
        assert set(numbers(text)) - set(numbers(body)) - pages == set()


def test_both_languages_have_the_same_numbers(written):
    found = [[one.replace(",", ".") for one in numbers(of_page(written[lang, ".html"]))] for lang in ("en", "it")]
    assert sorted(found[0]) == sorted(found[1])
    assert "0,2753" in of_page(written["it", ".html"])
    assert not re.search(r"(?<![.\d])\d+\.\d{3,}", of_page(written["it", ".html"]))


def test_no_english_in_an_italian_document(written):
    text = of_page(written["it", ".html"])
    # Names of files and records are not prose.
    words = set(re.findall(r"(?<![\w./-])[a-z]+(?![\w./-])", re.sub(r"\S*[_/]\S*", " ", text.lower())))
    assert words & set(ENGLISH.split()) == set()
    assert '<html lang="it">' in written["it", ".html"].read_text()
    assert "[DA COMPLETARE: " in text
    assert "NON soddisfatta (non lineare SLV)" in text
    # The anchors of the design are not checked: nothing is called satisfied, and nothing is green.
    assert "catene da verificare, nessuna verifica su cui si fonda il giudizio (non lineare SLV)" in text
    assert ": soddisfatta (" not in text
    assert 'class="note fine"' not in written["it", ".html"].read_text()


def test_the_numbers_are_those_of_the_check(written, both):
    """alpha_0, a_0* and zeta_E of both states follow from the table of items with a calculator."""
    expected = [
        (0.034069403402041, 0.264084169029353, 0.275290807164503),
        (0.436350625832744, 3.38231025265253, 1.14551266763424),
    ]
    text = of_page(written["en", ".html"])
    for results, values in zip(both, expected, strict=True):
        check = results.check
        sums = sums_of(check.items)
        assert sums["alpha_0"] == pytest.approx(values[0], rel=1e-12)
        found = (
            *(check.value("mechanism", "SLV", name) for name in ("alpha_0", "a_0")),
            check.value("nonlinear", "SLV", "ratio"),
        )
        assert found == pytest.approx(values, rel=1e-12)
        for value in values:
            assert f"{value:.6g}" in text
        mass = sums["force_lever"] ** 2 / (9.81 * sums["force_lever2"])
        assert mass == pytest.approx(check.value("mechanism", "SLV", "mass"), rel=1e-12)
    assert math.isclose(expected[1][2] - expected[0][2], 0.87022186, rel_tol=1e-6)
    assert "0.8702" in text


def by_hand(text, place):
    """alpha_0, a_0*, d_0*, a(d_C) and the ratio of SLV of a wall, from the numbers of an Italian document."""

    def number(word):
        return float(word.replace(",", ".")) if word else 0.0

    hazard = text.partition("Tabella 1.")[2].partition("SLV\n")[2].split("\n")[:8]
    pga, f0, tb, tc, td = (number(hazard[i]) for i in (7, 1, 4, 5, 6))
    section = text.split("Calcolo del moltiplicatore, elemento per elemento")[place]
    cells = section.partition("P z² [kNm²/m]\n")[2].split("\n")
    rows = [cells[first : first + 9] for first in range(0, 9 * cells[::9].index("somma"), 9)]
    depth = number(re.search(r"con u = ([\d,]+) m", section)[1])
    weights = [row for row in rows if row[7]]
    thrusts, ties = ([row for row in rows if row[0].startswith(word)] for word in ("spinta", "catena"))

    def add(some, *columns):
        return math.fsum(math.prod(number(row[i]) for i in columns) for row in some)

    first, second = add(weights, 1, 4), add(rows, 8)
    held, pushed, arms = add(weights, 1, 3), add(thrusts, 1, 4), add(weights, 1, 3)
    off = {name: add(some, 1, 2) - depth * add(some, 1) for name, some in (("H", thrusts), ("T", ties))}
    alpha = (held + add(ties, 1, 4) - pushed) / first
    ratio = first**2 / (add(weights, 1) * second)
    a0 = alpha * 9.81 / (ratio * 1.35)
    d0 = math.sin(math.atan((held - pushed) / (first + off["H"]))) * second / first
    d = 0.4 * d0
    angle = math.asin(d * first / second)
    moment = (held + add(ties, 1, 4) - pushed) * math.cos(angle) - (first + off["H"] - off["T"]) * math.sin(angle)
    a = moment / (first * math.cos(angle) + arms * math.sin(angle)) * 9.81 / (ratio * 1.35)
    period = 1.68 * math.pi * math.sqrt(d / a)
    shape = 1.0 if tb < period < tc else tc / period if period < td else tc * td / period**2
    demand = pga * math.sqrt(10 / 13) * f0 * shape * 9.81 * (period / (2 * math.pi)) ** 2
    return alpha, a0, d0, a, max(d / demand, a0 / (pga * 9.81))


def test_a_calculator_and_the_document_are_enough(written, both):
    """All that the checks of both states need is in the text, to its six figures; the hazard has four."""
    pytest.importorskip("docx")
    text = of_word(written["it", ".docx"])
    for place, results in enumerate(both, 1):
        check = results.check
        expected = [check.value("mechanism", "SLV", name) for name in ("alpha_0", "a_0", "d_0")]
        expected += [check.value("nonlinear", "SLV", name) for name in ("acceleration", "ratio")]
        assert by_hand(text, place) == pytest.approx(expected, rel=1e-4)


def test_why_the_displacement_is_what_it_is(brittle, both):
    """Shares of d_0*, the fracture of ties with its elongation, and all steps that lead to a(d_C)."""
    place, results = brittle
    pages = {}
    for name, found in (("brittle", results), ("both", both)):
        dd.calculation_report(found, place / f"{name}.html", lang="en")
        pages[name] = " ".join(of_page(place / f"{name}.html").split())
    assert "there ties break that give more than half of the greatest resistance" in pages["brittle"]
    assert "there ties break" not in pages["both"]
    check = results[1].check
    broken = check.value("nonlinear", "SLV", "displacement")
    assert f"{broken:.6g} m, less than 0.4 d0*" in pages["brittle"]
    # The anchor gives way at T/A less the preload, over E, times the length
    tie = results[1].check.wall.ties[0]
    elongation = (check.items[-1].force / tie.section - 50e6) / 2.06e11 * 10
    assert f"{elongation:.6g} m" in pages["brittle"]
    for found in both:
        assert f"{found.check.value('nonlinear', 'SLC', 'acceleration'):.6g} m/s²" in pages["both"]
    assert "the return period of the capacity is not given: the check has no reference life" in pages["both"].lower()
    assert "is not given" not in pages["brittle"]


def test_plate_and_frustum(brittle):
    """The figure has the sizes and the forces of the sheet, in greys."""
    place, results = brittle
    dd.calculation_report(results, place / "plate.html", lang="it")
    page = (place / "plate.html").read_text()
    assert page.count("tronco di piramide di muratura che essa estrae") == 1
    subjects = subjects_of(results)
    drawn = draw_anchor(Document(Language("it"), project.Project(), subjects), subjects.several[1], "tie 1")
    texts = [one.get_text() for one in drawn.figure.findobj(matplotlib.text.Text)]
    check = results[1].check
    for force in ("bar_force", "bearing_force", "shear_force", "cone_force"):
        value = f"{1e-3 * check.value('tie', '', force):.4g}".replace(".", ",")
        assert any(value in text for text in texts), force
    assert {"a = 35", "b = 35", "t = 55"} <= set(texts)
    colours = [one.get_facecolor() for one in drawn.figure.findobj(matplotlib.patches.Polygon)]
    assert all(len(set(colour[:3])) == 1 for colour in colours)
    matplotlib.pyplot.close(drawn.figure)


def test_figures_keep_their_words_apart(brittle):
    """Nothing crosses the dimensions, reactions are clear of the hinge, and curves end together, dashed beyond."""
    subjects = subjects_of(brittle[1])
    document = Document(Language("it"), project.Project(), subjects)
    rest, moved = drawings.draw_wall(document, subjects.several[1]).figure.axes
    at = min(note.xy[0] for note in rest.texts if note.get_text() in ("340", "380"))
    reach = [min(line.get_xdata()) for line in rest.lines if len(line.get_xdata()) > 1]
    assert at < min(reach)
    (reaction,) = (note for note in moved.texts if note.get_text().startswith("H = "))
    assert reaction.xy[1] < 0.0
    curve = dd.fit_fragility([0.1, 0.2, 0.3], [1, 8, 20], 40, im="pga")
    several = tuple(dataclasses.replace(one, curve=curve) for one in subjects.several)
    ax = drawings.draw_fragility(dataclasses.replace(document, subjects=dataclasses.replace(subjects, several=several)))
    curves = [line for line in ax.lines if len(line.get_xdata()) > 2]
    ends = {float(line.get_xdata()[-1]) for line in curves}
    assert ends == {0.3, ax.get_xlim()[1]}
    labels = [text.get_text() for text in ax.get_legend().get_texts()]
    assert labels.count("oltre il livello massimo") == 1
    shown = drawings.draw_spectra(document)
    indices = drawings.draw_indices(document)
    for text in (*labels, shown.get_ylabel(), indices.get_xlabel()):
        assert "_" not in re.sub(r"\$[^$]*\$", "", text), text
    assert not any(line.get_visible() for line in indices.get_ygridlines())
    for drawn in (rest, ax, shown, indices):
        matplotlib.pyplot.close(drawn.figure)


@pytest.mark.parametrize(("height", "is_cut", "is_open"), [(4.0, False, False), (6.6, True, False), (7.0, True, True)])
@pytest.mark.parametrize("is_round", [False, True])
def test_plates_near_the_top(height, is_cut, is_open, is_round, brittle):
    """The top of the wall and its distance where it decides, and the surface at t/2 where shear governs."""
    size = {"plate_diameter": 0.3} if is_round else {"plate_width": 0.3, "plate_height": 0.3}
    tie = dd.Tie(height, bar=0.024, spacing=2.5, length=10.0, strength=2.2e8, plate_thickness=0.02, **size)
    strengths = {"masonry_compression": 2e6, "masonry_shear": 4e4, "masonry_tension": 5e4}
    wall = dd.OneSidedWall(7.2, 0.55, density=2000.0, ties=[tie], **strengths)
    subjects = subjects_of(brittle[1])
    one = dataclasses.replace(subjects.several[1], wall=wall, check=dd.check_ntc(wall, subjects.several[1].check.site))
    section = draw_anchor(Document(Language("it"), project.Project(), subjects), one, "tie 1")
    _section, front = section.figure.axes
    texts = [text.get_text() for text in section.texts]
    above = 7.2 - height - 0.15
    assert ("sommità della parete" in texts, f"c = {100 * above:.4g}".replace(".", ",") in texts) == (is_cut, is_cut)
    dotted = [line for line in section.lines if line.get_linestyle() == ":"]
    if is_round and is_cut and not is_open:
        # The frustum, of which half is left, governs.
        assert not dotted
        return
    assert len(dotted) == (1 if is_open else 2)
    (round_it,) = (line for line in front.lines if line.get_linestyle() == ":")
    top = float(round_it.get_ydata().max())
    expected = (0.0 if is_round else 0.15 + above) if is_open else 0.15 + 0.275
    assert top == pytest.approx(expected)
    # Both panels have one scale, so that their titles have one height.
    assert np.ptp(section.get_xlim()) == pytest.approx(np.ptp(front.get_xlim()))
    assert section.get_ylim() == front.get_ylim()
    matplotlib.pyplot.close(section.figure)


ONE_HAZARD = "&check ag = 0.2, f0 = 2.5, tc_star = 0.35, soil = 'B', knowledge_factor = 1.2 /\n"


@pytest.fixture(scope="module")
def one_hazard(tmp_path_factory, executable, root):
    """The same walls with one hazard, another confidence factor than that at the plate, and names of their states."""
    place = tmp_path_factory.mktemp("one_hazard")
    walls = {"fatto": WALL.format(name="stato di fatto", tie=""), "progetto": WALL.format(name="catena", tie=PLATE)}
    walls["progetto"] = walls["progetto"].replace("tie_preload = 50e6, ", "")
    results = [run_in(place, executable, root, name, wall, ONE_HAZARD) for name, wall in walls.items()]
    pages = {}
    for lang in ("en", "it"):
        dd.calculation_report(results, place / f"{lang}.html", lang=lang)
        pages[lang] = " ".join(of_page(place / f"{lang}.html").split())
    return results, pages


def test_what_governs_a_nonlinear_check(one_hazard):
    """Both ratios are rows, which is the greater is said, and activation by ties that are not yet taut is in doubt."""
    results, pages = one_hazard
    check = results[1].check
    displacement = check.value("nonlinear", "SLV", "displacement") / check.value("nonlinear", "SLV", "demand")
    activation = check.value("mechanism", "SLV", "a_0") / (9.81 * check.pga)
    assert check.value("nonlinear", "SLV", "ratio") == pytest.approx(max(displacement, activation), rel=1e-12)
    assert activation > displacement
    page = pages["en"]
    assert "(activation)" in page
    assert re.search(rf"ratio of displacements nonlinear SLV .*?{displacement:.5g}", page)
    assert re.search(rf"ratio at activation nonlinear SLV .*?{activation:.5g}", page)
    assert "For SLV it is the Circolare, C8.7.1.2.1.8, that takes the acceleration of activation" in page
    assert f"By displacements alone the ratio is {displacement:.4g}." in page
    assert "(attivazione)" in pages["it"]
    assert "(spostamento)" in pages["it"]


def test_a_hazard_that_is_not_of_slc(one_hazard, brittle):
    place, results = brittle
    assert "not results of SLC at this site" in one_hazard[1]["en"]
    assert "SLC con l'unica pericolosità assegnata" in one_hazard[1]["it"]
    assert "non lineare SLC (pericolosità non propria), esito" in one_hazard[1]["it"]
    dd.calculation_report(results, place / "three.html", lang="it")
    assert "pericolosità non propria" not in of_page(place / "three.html")


def test_strengths_with_their_factors_and_origins(one_hazard):
    results, pages = one_hazard
    wall, check = results[1].check.wall, results[1].check
    assert "masonry_knowledge_factor \N{EN DASH} 1,35 (predefinito)" in pages["it"]
    assert "bearing_factor \N{EN DASH} 1 (predefinito)" in pages["it"]
    assert re.search("C8.7.1\\) \N{GREEK SMALL LETTER GAMMA}M \N{EN DASH} \N{EN DASH} 2 ", pages["it"])
    assert "due fattori di confidenza, 1,35 per la muratura alle piastre" in pages["it"]
    for name in ("masonry_shear", "masonry_tension", "masonry_compression", "tie_strength", "tie_preload"):
        assert f" {name} " in pages["it"]
    # The depth of the hinge with f_m/FC, by a wall whose strength is that
    weaker = dataclasses.replace(wall, compressive_strength=wall.compressive_strength / 1.2, masonry_compression=2e6)
    found = dd.check_ntc(weaker, check.site, knowledge_factor=1.2).value("mechanism", "SLV", "alpha_0")
    assert f"= {found:.4g} instead of {check.value('mechanism', 'SLV', 'alpha_0'):.4g}" in pages["en"]
    strengths = {row.quantity: row for row in check.rows if row.method == "tie"}
    for name, expression in (("bearing_strength", "k f_m"), ("shear_strength", "f_v0"), ("tensile_strength", "f_t")):
        row = strengths[name]
        assert row.expression == f"{expression}/(FC gamma_M)"
        assert eval(row.numbers) == pytest.approx(row.value, rel=1e-7)


def test_forces_at_rest_and_at_activation(one_hazard):
    """A tie without preload holds nothing at rest; what the base holds, and how far the anchor moves until it does."""
    results, pages = one_hazard
    check = results[1].check
    sums = sums_of(check.items)
    tie, force = check.wall.ties[0], sums["held"]
    table = pages["en"].partition("force on the base [kN/m]")[2]
    assert re.search(r"without earthquake, outwards, ΣH - Σ σ₀ A 2\.5 2\.5 ", table)
    activated = 1e-3 * (sums["thrust"] + sums["alpha_0"] * sums["weight"] - force)
    assert f"{activated:.5g}".replace("-", "\N{MINUS SIGN}") in table
    travel = 100 * force / tie.section / 2.06e11 * 10
    assert f"design (catena), tie 1: {travel:.4g} cm." in pages["en"]
    assert "as it stands (stato di fatto)" in pages["en"]
    assert "stato di fatto (stato di fatto)" not in pages["it"]


def test_the_weights_alone_at_the_control_point_of_the_check(one_hazard):
    """d_0* of the weights alone is that of a check of the wall without its thrust."""
    results, pages = one_hazard
    bare = dd.check_ntc(dataclasses.replace(results[0].check.wall, thrusts=()), results[0].check.site)
    d0 = bare.value("mechanism", "SLV", "d_0")
    assert f"{100 * d0:.6g}" in pages["en"].partition("Reasoned judgement")[2]
    assert f"{d0:.6g} m" in pages["en"].partition("same control point")[2]


# --- What the engineer writes


def test_what_is_not_written_is_seen_and_counted(both, written, folder):
    left = dd.calculation_report(both, folder / "left.html")
    # Why the hinges of a chain are the weakest is asked of chains alone, the thrust of horizontal bending of it alone.
    asked = set(project.TEXTS) - {"chain_hinges", "end_thrust"}
    assert set(left) == asked | (set(project.WORDS) - {"revision"}) | set(project.NUMBERS)
    page = written["en", ".html"].read_text()
    assert page.count("<mark>[TO BE COMPLETED: ") == len(left)
    data = folder / "project.toml"
    lines = ["[project]", *(f"{name} = 'written {name}, LC1'" for name in project.WORDS)]
    lines += [f"{name} = 42" for name in project.NUMBERS] + ["[texts]"]
    data.write_text(
        "\n".join([*lines, *(f"{name} = 'first {name}\\n\\nsecond'" for name in project.TEXTS)]).replace("'", '"')
    )
    assert dd.calculation_report(both, folder / "left.html", project=data) == ()
    text = of_page(folder / "left.html")
    assert "TO BE COMPLETED" not in text
    assert [name for name in asked if f"first {name}" not in text] == []
    assert "42 (value assumed by the designer)" in " ".join(text.split())
    assert "1764" in text.replace("\N{NARROW NO-BREAK SPACE}", "")


@pytest.mark.parametrize(
    ("content", "words"),
    [
        ("[project", "project.toml: "),
        ("[projekt]\nwork = 'a'", "must be one of the groups"),
        ("[project]\nwerk = 'a'", "werk: must be one of work, place"),
        ("[project]\nwork = 1", "work: must be a string"),
        ("[project]\nnominal_life = '50'", "nominal_life: must be a number"),
        ("[texts]\njudgment = 'a'", "judgment: must be one of description"),
        ('[project]\nwork = "Casa\\u000BBianca"', r"[project] work: has \x0b after 'Casa': must be without control"),
        ('[project]\nclient = "\\u0000"', r"[project] client: has \x00 after ''"),
        ('[texts]\nsurvey = "a\\n\\nb\\u001Fc"', r"[texts] survey: has \x1f after 'a\n\nb'"),
        ('[texts]\nanchors = "a\\u202Eb"', r"[texts] anchors: has \u202e after 'a'"),
        ('[texts]\nanchors = "a\\uFFFFb"', r"[texts] anchors: has \uffff after 'a'"),
        ("[project]\nlatitude = nan", "[project] latitude: must be a number"),
        (f"[project]\nnominal_life = 1{400 * '0'}", "[project] nominal_life: must be a number"),
    ],
)
def test_wrong_data(content, words, both, tmp_path):
    (tmp_path / "project.toml").write_text(content)
    with pytest.raises(dd.errors.InputError, match=re.escape(words)):
        dd.calculation_report(both, tmp_path / "a.html", project=tmp_path / "project.toml")


def test_wrong_input(both, tmp_path, stripes_of):
    target = tmp_path / "a.html"
    with pytest.raises(dd.errors.InputError, match="has no check"):
        dd.calculation_report(stripes_of(""), target)
    with pytest.raises(dd.errors.InputError, match="the site of its check is another"):
        dd.calculation_report([both[0], stripes_of(CHECK.replace("'B'", "'C'"))], target)
    with pytest.raises(dd.errors.InputError, match="template = "):
        dd.calculation_report(both, target, template="a.docx")
    with pytest.raises(dd.errors.InputError, match="lang = 'de': must be one of 'en', 'it'"):
        dd.calculation_report(both, target, lang="de")
    with pytest.raises(dd.errors.InputError, match="must end in"):
        dd.calculation_report(both, tmp_path / "a.odt")
    with pytest.raises(dd.errors.InputError, match="at least one"):
        dd.calculation_report([], target)
    with pytest.raises(dd.errors.InputError, match="is given twice: a wall as it stands and its design are two runs"):
        dd.calculation_report([both[0], both[0]], target)
    target.write_text("notes of the office")
    with pytest.raises(dd.errors.InputError, match="is not a report of dondolo"):
        dd.calculation_report(both, target)


@pytest.fixture
def stripes_of(tmp_path, executable, root):
    return lambda check: run_in(tmp_path, executable, root, "other", WALL.format(name="a", tie=""), check)


def test_language_of_the_environment(both, tmp_path, monkeypatch):
    monkeypatch.setenv("DONDOLO_LANG", "it")
    monkeypatch.setenv("LANG", "de_DE.UTF-8")
    dd.calculation_report(both[0], tmp_path / "a.html")
    assert "Relazione di calcolo" in of_page(tmp_path / "a.html")
    monkeypatch.setenv("DONDOLO_LANG", "fr")
    with pytest.raises(dd.errors.InputError, match="DONDOLO_LANG = 'fr'"):
        dd.calculation_report(both[0], tmp_path / "a.html")


# --- Word


def test_word(written, both, folder):
    docx = pytest.importorskip("docx")
    path = written["it", ".docx"]
    file = docx.Document(path)
    assert file.core_properties.comments == zipfile.ZipFile(path).comment.decode()
    assert file.core_properties.comments.endswith(f"of run {both[0].run.run}")
    assert next(one.text for one in file.paragraphs if one.style.name == "Heading 1") == "1. Descrizione dell'opera"
    xml = file.element.xml
    assert xml.count("<w:tblHeader") == sum(one.text.startswith("Tabella") for one in file.paragraphs)
    assert "SEQ Tabella \\* ARABIC" in xml
    assert 'w:val="it-IT"' in file.styles["Normal"].element.xml
    assert re.findall(r'<wp:docPr [^>]*descr="([^"]+)"', xml)
    assert all("descr" in one for one in re.findall(r"<wp:docPr [^>]*>", xml))
    marked = list(file.element.iter("{*}highlight"))
    assert len(marked) == xml.count("[DA COMPLETARE: ")
    # The office's own template, with its header
    office = docx.Document()
    office.sections[0].header.paragraphs[0].text = "Studio Bianchi"
    office.save(folder / "office.docx")
    dd.calculation_report(both[0], folder / "own.docx", template=folder / "office.docx")
    assert docx.Document(folder / "own.docx").sections[0].header.paragraphs[0].text == "Studio Bianchi"
    (folder / "no.docx").write_text("no file of Word")
    with pytest.raises(dd.errors.InputError, match="is not a file of Word"):
        dd.calculation_report(both[0], folder / "own.docx", template=folder / "no.docx")


def test_characters_that_documents_have(both, tmp_path):
    """Blanks of fixed width, accents and lines are no control characters; a designer of 300 letters fits."""
    docx = pytest.importorskip("docx")
    (tmp_path / "project.toml").write_text(
        f'[project]\ndesigner = "ing. {300 * "d"}"\n[texts]\nsurvey = "3\\u00A0m,\\tgià\\nvisto"\n', encoding="utf-8"
    )
    dd.calculation_report(both[0], tmp_path / "a.docx", project=tmp_path / "project.toml")
    file = docx.Document(tmp_path / "a.docx")
    assert any("3\N{NO-BREAK SPACE}m,\tgià\nvisto" in one.text for one in file.paragraphs)
    assert len(file.core_properties.author) == 255


OFFICE = "http://schemas.openxmlformats.org/officeDocument/2006/relationships"


def template(path, kind="", relations="", body="", parts=()):
    """A template of an office: its main type, relationships of the document beside its own, and XML of its body."""
    docx = pytest.importorskip("docx")
    made = io.BytesIO()
    file = docx.Document()
    file.sections[0].header.paragraphs[0].text = "Studio Verdi"
    file.save(made)
    with zipfile.ZipFile(made) as archive, zipfile.ZipFile(path, "w") as changed:
        for name in archive.namelist():
            content = archive.read(name).decode("latin-1")
            if name == "[Content_Types].xml" and kind:
                content = content.replace("vnd.openxmlformats-officedocument.wordprocessingml.document.main+xml", kind)
                binary = '<Default Extension="bin" ContentType="application/vnd.ms-office.vbaProject"/>'
                content = content.replace("<Override ", f"{binary}<Override ", 1)
            if name == "word/_rels/document.xml.rels":
                content = content.replace("</Relationships>", f"{relations}</Relationships>")
            if name == "word/document.xml":
                content = content.replace("<w:body>", f"<w:body>{body}")
            changed.writestr(name, content.encode("latin-1"))
        for name, content in dict(parts).items():
            changed.writestr(name, content)
    return path


@pytest.mark.parametrize(
    "kind",
    [
        "",
        "vnd.openxmlformats-officedocument.wordprocessingml.template.main+xml",
        "vnd.ms-word.document.macroEnabled.main+xml",
        "vnd.ms-word.template.macroEnabledTemplate.main+xml",
    ],
)
def test_templates_run_nothing(kind, both, tmp_path):
    """Macros, links to other files and fields that look into them stay in the office; its header comes along."""
    relations = "".join(
        f'<Relationship Id="x{i}" Type="{of}" Target="{target}"{more}/>'
        for i, (of, target, more) in enumerate(
            [
                ("http://schemas.microsoft.com/office/2006/relationships/vbaProject", "vbaProject.bin", ""),
                (f"{OFFICE}/hyperlink", "https://example.org/studio", ' TargetMode="External"'),
                (f"{OFFICE}/attachedTemplate", "file:///server/normal.dotm", ' TargetMode="External"'),
                (f"{OFFICE}/oleObject", "embeddings/table.bin", ""),
            ]
        )
    )

    def field(*words):
        sign = '<w:r><w:fldChar w:fldCharType="{}"/></w:r>'.format
        inside = "".join(f"<w:r><w:instrText>{word}</w:instrText></w:r>" for word in words)
        result = f"<w:r><w:t>shown by {words[0]}</w:t></w:r>"
        return f"<w:p>{sign('begin')}{inside}{sign('separate')}{result}{sign('end')}</w:p>"

    body = (
        f'<w:p><w:hyperlink xmlns:q="{OFFICE}" q:id="x1"><w:r><w:t>our page</w:t></w:r></w:hyperlink></w:p>'
        f'<w:p><w:r><w:object xmlns:q="{OFFICE}"><w:control q:id="x3"/></w:object></w:r></w:p>'
        '<w:p><w:fldSimple w:instr=" INCLUDEPICTURE &quot;http://example.org/p.png&quot; "><w:r><w:t>logo</w:t></w:r>'
        "</w:fldSimple></w:p>" + field(" DDE", "AUTO c:\\\\x.exe") + field(" NUMPAGES ")
    )
    parts = {"word/vbaProject.bin": b"Sub AutoOpen()", "word/embeddings/table.bin": b"inside"}
    given = template(tmp_path / "office.docx", kind, relations, body, parts)
    out = tmp_path / "own.docx"
    with pytest.warns(dd.errors.DondoloWarning) as told:
        dd.calculation_report(both[0], out, template=given)
    # Older versions of other packages have warnings of their own
    ours = [one for one in told if isinstance(one.message, dd.errors.DondoloWarning)]
    assert [str(one.message).partition(": ")[2] for one in ours] == [
        "left out of the document: embedded files, fields, links, macros"
    ]
    with zipfile.ZipFile(out) as archive:
        everything = {name: archive.read(name) for name in archive.namelist()}
    assert not [name for name in everything if name.endswith(".bin")]
    whole = b"".join(everything.values())
    for word in (
        b"External",
        b"example.org",
        b"AutoOpen",
        b"macroEnabled",
        b"INCLUDEPICTURE",
        b"AUTO c:",
        b"template.main",
    ):
        assert word not in whole
    import docx

    file = docx.Document(out)
    words = "\n".join(one.text for one in file.paragraphs)
    assert "our page" in words
    assert "logo" in words
    assert "shown by  DDE" in words
    assert b"NUMPAGES" in whole
    assert file.sections[0].header.paragraphs[0].text == "Studio Verdi"


def test_a_plain_template_comes_whole(both, tmp_path, recwarn):
    dd.calculation_report(both[0], tmp_path / "own.docx", template=template(tmp_path / "office.docx"))
    assert [str(one.message) for one in recwarn if "left out" in str(one.message)] == []


@pytest.mark.parametrize(
    ("parts", "words"),
    [
        ({"word/big.xml": b"<a>" + bytes(40 * 2**20) + b"</a>"}, "MB of XML: must have at most"),
        ({"word/media/big.png": bytes(300 * 2**20)}, "301 MB once unpacked"),
        ({f"word/{i}.txt": b"" for i in range(5100)}, "parts and"),
        ({"word/a.xml": b'<!DOCTYPE a [<!ENTITY b "cc">]><a>&b;</a>'}, "word/a.xml has a document type declaration"),
        ({"word/a.xml": '<?xml version="1.0" encoding="UTF-16"?><!DOCTYPE a><a/>'.encode("utf-16")}, "document type"),
        ({"word/a.xml": b"<a><b></a>"}, "is not a file of Word: "),
        ({"word/a.xml": b""}, "is not a file of Word: "),
    ],
)
def test_templates_that_exhaust(parts, words, both, tmp_path):
    """Each is one line that names the template, and nothing is written."""
    given = tmp_path / "office.docx"
    template(given)
    with zipfile.ZipFile(given, "a", zipfile.ZIP_DEFLATED) as archive:
        for name, content in parts.items():
            archive.writestr(name, content)
    with pytest.raises(dd.errors.InputError, match=re.escape(words)) as refused:
        dd.calculation_report(both[0], tmp_path / "own.docx", template=given)
    assert str(given) in str(refused.value)
    assert "\n" not in str(refused.value)
    assert [path.name for path in tmp_path.iterdir()] == ["office.docx"]


def test_no_python_docx(both, tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "docx", None)
    with pytest.raises(dd.errors.DondoloError, match="python-docx is not installed"):
        dd.calculation_report(both[0], tmp_path / "a.docx")
    assert list(tmp_path.iterdir()) == []
    dd.calculation_report(both[0], tmp_path / "a.html")


@pytest.mark.slow
@pytest.mark.parametrize("suffix", [".pdf", ".docx"])
def test_pages(suffix, written, tmp_path):
    """At most 15 pages without annexes: as printed by a browser, and of Word as LibreOffice lays it out."""
    path = written.get(("it", suffix))
    if path is None or not shutil.which("pdftotext") or (suffix == ".docx" and not shutil.which("soffice")):
        pytest.skip("Chromium, pdftotext or LibreOffice is not installed")
    if suffix == ".docx":
        command = ["soffice", f"-env:UserInstallation=file://{tmp_path}/office", "--headless", "--convert-to", "pdf"]
        subprocess.run([*command, "--outdir", tmp_path, path], check=True, capture_output=True, timeout=180)
        path = tmp_path / "it.pdf"
    pages = of_pdf(path).split("\f")
    # In Word below the header, and in its contents, which come second
    found = [number for number, page in enumerate(pages) if re.search(r"^\s*Allegati\s*$", page, re.M)]
    assert max(found) <= 15


# --- Walls of other kinds


@pytest.mark.parametrize("lang", ["en", "it"])
def test_vertical_bending(lang, executable, root, tmp_path):
    results = run_in(tmp_path, executable, root, "fascia", STRIP)
    dd.calculation_report(results, tmp_path / "a.html", lang=lang)
    text = of_page(tmp_path / "a.html")
    assert {"en": "A strip between two floors bends", "it": "Una parete tra due solai si inflette"}[lang] in text
    assert {"en": "lower block", "it": "blocco inferiore"}[lang] in text
    assert (
        f"{results.check.value('mechanism', 'SLV', 'alpha_0'):.6g}".replace(".", {"en": ".", "it": ","}[lang]) in text
    )


@pytest.mark.slow
@pytest.mark.parametrize("case", ["designs", "facade_hinges"])
def test_designs_and_facades(case, executable, root, tmp_path):
    text = (root / f"data/cases/{case}.nml").read_text()
    if "&check" not in text:
        text += CHECK
    (tmp_path / "case.nml").write_text(text.replace("'../", f"'{root}/data/").replace(f"'out/{case}'", "'out'"))
    subprocess.run([executable, "--quiet", "case.nml"], cwd=tmp_path, capture_output=True, check=True)
    found = dd.read_results(tmp_path / "out")
    dd.calculation_report(found, tmp_path / "a.html", lang="it")
    page = of_page(tmp_path / "a.html")
    for check in found.checks:
        assert check.wall.name in page
        assert f"{check.value('nonlinear', 'SLV', 'ratio'):.4g}".replace(".", ",") in page
    if case == "facade_hinges":
        least = min(found.checks, key=lambda one: one.value("nonlinear", "SLV", "ratio"))
        assert f"del meccanismo {least.wall.name}" in page
        assert f"il minimo tra i suoi meccanismi, per {least.wall.name}" in page.partition("1. Descrizione")[0]


def test_mechanisms_of_a_building(executable, root, tmp_path):
    """Several mechanisms of one building have neutral heads, and the least safety index is the report's."""
    parapet = "name = '{name}', mechanism = 'one_sided', height = 1.5, thickness = {t}"
    found = [
        run_in(tmp_path, executable, root, "a", WALL.format(name="facciata", tie="")),
        run_in(tmp_path, executable, root, "b", STRIP),
        run_in(tmp_path, executable, root, "c", parapet.format(name="parapetto", t=0.35)),
    ]
    indices = {one.check.wall.name: one.check.zeta_e for one in found}
    least = min(indices, key=indices.get)
    for lang, sentence in (("it", "Minimo indice di sicurezza"), ("en", "Least safety index")):
        dd.calculation_report(found, tmp_path / "m.html", lang=lang, mechanisms=True)
        page = of_page(tmp_path / "m.html")
        assert "stato di fatto" not in page
        assert "as it stands" not in page
        assert f"{sentence}" in page.partition("1. ")[0]
        head = page.partition("1. ")[0].replace(",", ".")
        assert f"{indices[least]:.4g}" in head
        assert least in head
        # The least comes last in the table of the mechanisms, in bold
        rows = re.findall(r'<tr class="strong"><th scope="row">([^<]*)</th>', (tmp_path / "m.html").read_text())
        assert rows[-1] == least
    with pytest.raises(dd.errors.InputError, match="mechanism, height of it and of 'facciata' differ: several mechan"):
        dd.calculation_report(found[:2], tmp_path / "x.html")
    other = run_in(tmp_path, executable, root, "d", parapet.format(name="altro", t=0.35), CHECK.replace(
        "soil = 'B'", "soil = 'B', ultimate_state = 'SLC'"))  # fmt: skip
    with pytest.raises(dd.errors.InputError, match="ultimate_state of it and of 'facciata' differ"):
        dd.calculation_report([found[0], other], tmp_path / "x.html", mechanisms=True)
    thick = run_in(tmp_path, executable, root, "e", parapet.format(name="più spesso", t=0.45))
    dd.calculation_report([found[2], thick], tmp_path / "states.html", lang="it")
    assert "stato di progetto (più spesso)" in of_page(tmp_path / "states.html")
    assert main(
        ["relazione", "--mechanisms", *(str(tmp_path / one) for one in "abc"), "-o", str(tmp_path / "o.html")]
    ) in (0, None)


def test_a_population_has_no_report(executable, root, tmp_path):
    (tmp_path / "walls.csv").write_text("name,mechanism,height,thickness\na,one_sided,3,0.3\nb,one_sided,2,0.3\n")
    (tmp_path / "case.nml").write_text(
        "&job task = 'typology', output = 'out' /\n&population file = 'walls.csv' /\n"
        f"&records catalogue = '{root / 'data/records/synthetic44.csv'}' /\n{CHECK}&stripes levels = 0.2, 0.4, 0.8 /\n"
    )
    subprocess.run([executable, "--quiet", "case.nml"], cwd=tmp_path, capture_output=True, check=True)
    with pytest.raises(dd.errors.InputError, match="not a population"):
        dd.calculation_report(dd.read_results(tmp_path / "out"), tmp_path / "a.html")


def test_an_anchor_that_is_given_is_not_in_doubt(executable, root, tmp_path):
    results = run_in(tmp_path, executable, root, "a", WALL.format(name="a", tie=TIE + ", tie_anchor_force = 30e3"))
    dd.calculation_report(results, tmp_path / "a.html")
    assert "anchors of ties NOT checked" not in of_page(tmp_path / "a.html")


PLATE = TIE.replace("tie_area = 1e-4", "tie_bar = 0.024, tie_spacing = 2.5") + (
    ",\ntie_plate_width = 0.35, tie_plate_height = 0.35, tie_plate_thickness = 0.012, masonry_compression = 2e6,"
    " masonry_shear = 4e4, masonry_tension = 5e4"
)
LIFE = CHECK.replace(" /", ", reference_life = 50, exceedance = 0.63, 0.10, 0.05 /")


@pytest.fixture(scope="module")
def brittle(tmp_path_factory, executable, root):
    """A facade as it stands, and with a tie whose plate is too small and too thin, with return periods."""
    place = tmp_path_factory.mktemp("brittle")
    walls = {"fatto": WALL.format(name="facciata", tie=""), "progetto": WALL.format(name="catena", tie=PLATE)}
    return place, [run_in(place, executable, root, name, wall, LIFE) for name, wall in walls.items()]


def test_a_brittle_anchor_and_return_periods(brittle):
    """The check that is not applicable has not failed, what is open of a tie is said, and bounds are bounds."""
    place, results = brittle
    pages = {}
    for lang in ("en", "it"):
        dd.calculation_report(results, place / "a.html", lang=lang)
        pages[lang] = of_page(place / "a.html")
    page = " ".join(pages["en"].split())
    assert ": satisfied (" not in page
    assert "anchors of ties weaker than the bars; plates of ties too thin; linear SLV not applicable." in page
    assert "Hierarchy of strengths not respected: design (catena), tie 1." in page
    assert "Plate too thin: design (catena), tie 1." in page
    check = results[1].check
    for force in ("bearing_force", "shear_force", "cone_force", "anchor_force_per_m"):
        value = check.value("tie", "", force, item="tie 1")
        assert f"{1e-3 * value:.5g}" in page, force
    assert re.search(r"T_?R,C \[years\] ?< 30", page)
    assert ">linear SLV, outcome<" not in page
    outcomes = pages["it"].partition("Sintesi delle verifiche")[2].partition("lineare SLV, esito")[2].split("\n")
    assert [line for line in outcomes if line.strip()][:2] == ["NON soddisfatta (informazione)", "non applicabile"]
    words = set(re.findall(r"(?<![\w./-])[a-z]+(?![\w./-])", re.sub(r"\S*[_/]\S*", " ", pages["it"].lower())))
    assert words & set(ENGLISH.split()) == set()
    assert "anni" in words
    # What follows from the storeys is not listed with them: 3.8 + 3.4 is 7.199999999999999.
    assert (place / "a.html").read_text().count("section_height = 3.8, 3.4") == 2
    assert "7.19999" not in (place / "a.html").read_text()


def test_ties_that_break_one_after_the_other(executable, root, tmp_path):
    """Which tie has broken at d_C, where and at what force; the steps are with those that hold."""
    several = TIE.replace("= 6.6", "= 3.8, 6.6").replace("= 1e-4", "= 2e-5, 1e-4").replace("= 0.02", "= 0.002, 0.02")
    for name in ("tie_length = 10", "tie_strength = 235e6", "tie_preload = 50e6", "tie_modulus = 2.06e11"):
        several = several.replace(name, f"{name}, {name.partition('= ')[2]}")
    results = run_in(tmp_path, executable, root, "a", WALL.format(name="a", tie=several))
    dd.calculation_report(results, tmp_path / "a.html", lang="en")
    text = of_page(tmp_path / "a.html")
    assert "is that of the capacity curve" not in text
    table = text.partition("Ties at the displacement of SLV")[2].split("sin")[0].split("\n")
    rows = [[cell for cell in table[place : place + 14] if cell][:7] for place in map(table.index, ("tie 1", "tie 2"))]
    assert [row[-1] for row in rows] == ["broken", "holds"]
    depth = float(re.search(r"u = ([\d.]+) m", text)[1])
    for row, height, stress in zip(rows, (3.8, 6.6), (0.002, 0.02), strict=True):
        stretch = (stress - 50e6 / 2.06e11) * 10
        theta = float(row[4])
        assert float(row[3]) == pytest.approx(stretch, rel=1e-5)
        assert height * math.sin(theta) - depth * (1 - math.cos(theta)) == pytest.approx(stretch, rel=1e-5)
    assert [float(row[1]) for row in rows] == pytest.approx([4.7, 23.5])
    acceleration = results.check.value("nonlinear", "SLV", "acceleration")
    assert f"{acceleration:.6g}" in text


def test_forces_have_one_name(brittle):
    """In both formats, in the language of the document."""
    docx = pytest.importorskip("docx")
    place, results = brittle
    names = {
        "it": ("Tschiacciamento", "Ttaglio", "Tcono", "Tancoraggio", "Tbarra", "Dbarra"),
        "en": ("Tbearing", "Tshear", "Tcone", "Tanchor", "Tbar", "Dbar"),
    }
    for lang, other in (("it", "en"), ("en", "it")):
        dd.calculation_report(results, place / "names.html", lang=lang)
        dd.calculation_report(results, place / "names.docx", lang=lang)
        found = docx.Document(str(place / "names.docx"))
        cells = " ".join(cell.text for table in found.tables for row in table.rows for cell in row.cells)
        page = re.sub(r"</?t[hd]\b[^>]*>", " ", (place / "names.html").read_text())
        page = re.sub(r"<[^>]*>", "", page)
        for text in (cells, page):
            assert [name for name in names[lang] if not re.search(rf"\b{name}\b", text)] == []
            assert [name for name in names[other] if re.search(rf"\b{name}\b", text)] == []
        assert ("Mrib" in page, "Mov" in page) == (lang == "it", lang == "en")


def test_contents_and_records_once(brittle):
    """Word has a table of contents that it updates; records of two runs that are the same are listed once."""
    docx = pytest.importorskip("docx")
    place, results = brittle
    dd.calculation_report(results, place / "contents.docx", lang="it")
    file = docx.Document(str(place / "contents.docx"))
    texts = [paragraph.text.partition("\t")[0] for paragraph in file.paragraphs]
    titles = [one.text for one in file.paragraphs if one.style.name in ("Heading 1", "Heading 2")]
    place_of = texts.index("Indice")
    assert texts[place_of + 1 : place_of + 1 + len(titles)] == titles
    xml = file.element.xml
    assert len(re.findall(r'w:fldCharType="begin" w:dirty="true"', xml)) == 1
    assert 'TOC \\o "1-2"' in xml
    # Each line has the page of its heading
    pages = re.findall(r'w:instr="PAGEREF (\w+) ', xml)
    assert len(pages) == len(titles) > 17
    assert pages == re.findall(r'<w:bookmarkStart w:id="\d+" w:name="(\w+)"', xml)
    assert sum(text.endswith("sono quelli di stato di fatto (facciata).") for text in texts) == 1
    name = results[0].run.records[0]["name"]
    cells = [cell.text.replace("\N{ZERO WIDTH SPACE}", "") for table in file.tables for cell in table.columns[0].cells]
    assert cells.count(name) == 1
    # So are files of the same checksum
    inputs = [{each["path"] for each in one.run.inputs} for one in results]
    assert len(inputs[0] & inputs[1]) > 40
    assert all(cells.count(path) == 1 for path in inputs[0] | inputs[1])


def test_pages_of_word_are_an_office_s(brittle):
    """A header with the work, page n of N, properties of the file, room for a stamp."""
    docx = pytest.importorskip("docx")
    place, results = brittle
    words = {"work": "Facciata di via Roma 3", "place": "L'Aquila", "designer": "ing. Anna Bianchi", "revision": "2"}
    (place / "office.toml").write_text("[project]\n" + "".join(f'{key} = "{word}"\n' for key, word in words.items()))
    dd.calculation_report(results, place / "office.docx", lang="it", project=place / "office.toml")
    file = docx.Document(str(place / "office.docx"))
    (section,) = file.sections
    assert section.header.paragraphs[0].text == "Facciata di via Roma 3, revisione 2\t\tRelazione di calcolo"
    assert section.first_page_header.paragraphs[0].text == ""
    for footer in (section.footer, section.first_page_footer):
        assert re.findall(r'w:instr="(\w+)"', footer.paragraphs[0]._p.xml) == ["PAGE", "NUMPAGES"]
        assert footer.paragraphs[0].text == " / "
    found = file.core_properties
    assert found.title == "Relazione di calcolo: meccanismi locali di pareti murarie"
    assert (found.author, found.subject, found.language) == (
        words["designer"],
        "Facciata di via Roma 3, L'Aquila",
        "it",
    )
    assert abs((found.created - datetime.datetime.now(datetime.UTC)).total_seconds()) < 600
    assert sum(cell.text == "Timbro e firma del progettista" for table in file.tables for cell in table._cells) == 1
    dd.calculation_report(results, place / "office.html", lang="it", project=place / "office.toml")
    page = (place / "office.html").read_text()
    assert '<meta name="author" content="ing. Anna Bianchi">' in page
    assert page.count('<div class="stamp">Timbro e firma del progettista</div>') == 1


def test_columns_have_room_for_their_words(brittle):
    """No word is parted: each column of a table of Word is as wide as its longest one in bold Arial (Helvetica)."""
    docx = pytest.importorskip("docx")
    from dondolo.reporting.writers.word_tables import parts_of_text

    place, results = brittle
    metrics = (Path(matplotlib.get_data_path()) / "fonts/pdfcorefonts/Helvetica-Bold.afm").read_text()
    advances = {chr(int(code)): int(width) for code, width in re.findall(r"^C (\d+) ; WX (\d+)", metrics, re.M)}

    def length(word):
        return sum(advances.get(one, 611) for one in word) / 1000.0

    for lang in ("it", "en"):
        dd.calculation_report(results, place / "wide.docx", lang=lang)
        for table in docx.Document(str(place / "wide.docx")).tables:
            sizes = [run.font.size for cell in table._cells for run in cell.paragraphs[0].runs if run.font.size]
            size = max(sizes).pt
            for column in table.columns:
                words = [part for cell in column.cells for part in parts_of_text(cell.text.replace("\u200b", ""))]
                needed = 0.38 + 0.03528 * size * max(map(length, words), default=0.0)
                assert column.width.cm >= needed - 0.01, (lang, size, max(words, key=length))
            assert sum(column.width.cm for column in table.columns) <= 16.65


def test_states_beside_each_other(brittle):
    """Differences to the state as it stands are those of the two checks."""
    place, results = brittle
    dd.calculation_report(results, place / "b.html", lang="en")
    page = of_page(place / "b.html").partition("Summary of the checks")[2]
    first, second = (one.check for one in results)
    for key in (("mechanism", "", "alpha_0"), ("mechanism", "", "a_0"), ("nonlinear", "SLV", "zeta_e")):
        assert f"{second.value(*key) - first.value(*key):.4g}" in page, key
    assert f"{second.value('nonlinear', 'SLV', 'return_period_capacity'):.5g}" in page


def test_a_check_that_is_not_applicable_has_no_number(brittle):
    """Neither in the report nor in the calculation report; nor is its line in the figure."""
    place, results = brittle
    check = results[1].check
    assert check.not_applicable == (("linear", "SLV"),)
    void = {quantity: check.value("linear", "SLV", quantity) for quantity in ("ratio", "capacity_ag", "capacity_pga")}
    dd.calculation_report(results, place / "void.html", lang="en")
    dd.report(results[1], place / "page.html")
    for name in ("void", "page"):
        page = of_page(place / f"{name}.html")
        assert "not applicable" in page, name
        for value in void.values():
            assert not any(f"{value:.{figures}g}" in page for figures in (3, 4, 5, 6)), (name, value)
    assert f"up to {void['capacity_pga']:.4g}" not in str(check)


@pytest.mark.parametrize(
    ("line", "words"),
    [
        ("nominal_life = 50\nuse_coefficient = 1.5", "their product is 75 years, but the reference_life"),
        ('knowledge_level = "LC2"', None),
        ('knowledge_level = "LC1"', None),
        ('knowledge_level = "limited, LC1 (lc1)"', None),
        ('knowledge_level = "LC1/LC2"', "LC1/LC2': must name one of LC1, LC2, LC3"),
        ('knowledge_level = "LC12"', "LC12': must name one of"),
        ('knowledge_level = "limited"', "limited': must name one of"),
    ],
)
def test_a_project_that_disagrees_with_the_check(line, words, brittle, tmp_path):
    (tmp_path / "project.toml").write_text(f"[project]\n{line}\n")
    if words is None:
        dd.calculation_report(brittle[1], tmp_path / "a.html", project=tmp_path / "project.toml")
        return
    with pytest.raises(dd.errors.InputError, match=words):
        dd.calculation_report(brittle[1], tmp_path / "a.html", project=tmp_path / "project.toml")


def test_a_level_of_knowledge_without_its_factor(tmp_path, executable, root):
    results = run_in(
        tmp_path, executable, root, "a", WALL.format(name="a", tie=""), CHECK.replace("/", ", knowledge_factor = 1.2 /")
    )
    (tmp_path / "project.toml").write_text('[project]\nknowledge_level = "LC1"\n')
    with pytest.raises(dd.errors.InputError, match=r"asks for a confidence factor of 1.35, but wall 'a'"):
        dd.calculation_report(results, tmp_path / "a.html", project=tmp_path / "project.toml")


# --- The command, and files that are out of date


def test_command(folder, executable, root, tmp_path):
    run_in(tmp_path, executable, root, "a", WALL.format(name="a", tie=""))
    command = [sys.executable, "-m", "dondolo", "relazione", "a", "--lang", "it"]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=True)
    assert done.stdout.splitlines()[0] == "written: a_relazione.html"
    count = (tmp_path / "a_relazione.html").read_text().count("[DA COMPLETARE: ")
    assert done.stdout.splitlines()[1].startswith(
        f"{count} fields to be completed by the engineer: work, place, client"
    )
    again = subprocess.run([executable, "--quiet", "a.nml"], cwd=tmp_path, capture_output=True, text=True, check=True)
    assert "a_relazione.html" in again.stderr + again.stdout


def test_what_cannot_be_printed_is_refused_first(both, tmp_path, monkeypatch):
    """Before chapters are written and drawn."""
    monkeypatch.setattr("dondolo.reporting.writers.pdf._browser", lambda: None)
    monkeypatch.setitem(sys.modules, "weasyprint", None)
    monkeypatch.setattr("dondolo.reporting.relazione.subjects.subjects_of", lambda found: pytest.fail("has begun"))
    with pytest.raises(dd.errors.DondoloError, match="needs Chromium or WeasyPrint"):
        dd.calculation_report(both, tmp_path / "a.pdf")
    assert main(["relazione", "there_is_none", "-o", str(tmp_path / "b.pdf")]) == 1
    monkeypatch.setattr("dondolo.reporting.page.gather", lambda *rest: pytest.fail("has begun"))
    with pytest.raises(dd.errors.DondoloError, match="needs Chromium or WeasyPrint"):
        dd.report(both[0], tmp_path / "a.pdf")


def test_folders_and_languages_of_the_command(brittle, tmp_path):
    """A folder is made, as by the executable, and languages are known in capitals."""
    place, _results = brittle
    path = tmp_path / "new" / "folder" / "a.html"
    assert main(["relazione", str(place / "fatto"), "--lang", "IT", "-o", str(path)]) == 0
    assert '<html lang="it">' in path.read_text()
    (tmp_path / "file").touch()
    assert main(["report", str(place / "fatto"), "-o", str(tmp_path / "file" / "a.html")]) == 1


def test_a_file_of_the_project_that_is_no_toml(both, tmp_path):
    for line in ("date = 28 novembre", 'client = "C:\\Users"', "latitude = 42,35"):
        (tmp_path / "p.toml").write_text(f"[project]\n{line}\n")
        with pytest.raises(
            dd.errors.InputError, match=r"p.toml: .*line 2.*texts are in quotes, Windows paths in single"
        ):
            dd.calculation_report(both, tmp_path / "a.html", project=tmp_path / "p.toml")


# --- Catalogues and tables


def test_tables_have_every_key(root):
    sheet = (root / "src/core/check/check_sheet.F90").read_text()
    italian = Language("it")
    assert set(italian.all_named("quantity of a check")) == set(re.findall(r"quantity_type\('(\w+)'", sheet))
    assert set(italian.all_named("status")) == set(STATUSES)
    page = (root / "docs/files.md").read_text().partition("### Warnings")[2].partition("These are of Python alone")[0]
    codes = {
        code
        for row in page.splitlines()
        for code in re.findall(
            r"`([a-z_]+_[a-z_]+|separated|decreasing|extrapolated)`", row.split("|")[1] if row.count("|") > 2 else row
        )
    }
    assert codes - set(italian.all_named("warning")) - {"code"} - {"interlock_overlap"} == set()
    warning = dd.errors.DondoloWarning(
        "sentence", "scale_factors_large", {"record": "a"}, {"limit": 10.0, "largest": 18.03, "level": 0.3}
    )
    assert "il massimo 18,03 (accelerogramma a al livello 0,3)" in words.warning(italian, warning)
    assert words.warning(Language("en"), warning) == "sentence"


def test_symbols_units_and_formulas():
    assert symbol_of("a_0*") == Symbol("a", "0", "*")
    assert symbol_of("S_eZ(T)") == (Symbol("S", "eZ"), "(", Symbol("T"), ")")
    assert symbol_of("ζ_E") == Symbol("ζ", "E")
    assert linear(Fraction((Symbol("a"), " ", Symbol("g")), Symbol("e"))) == (
        "(",
        Symbol("a"),
        " ",
        Symbol("g"),
        ")",
        "/",
        Symbol("e"),
    )
    assert quantity(23500.0, UNITS["N/m"]) == Numeral("23.5", unit=" kN/m")
    assert quantity(0.053240120, CENTIMETRES) == Numeral("5.324", unit=" cm")
    assert Language("it").plain(quantity(0.053240120, CENTIMETRES)) == "5,324 cm"
    assert dataclasses.replace(Numeral("1.5"), power="3") == Numeral("1.5", "3")
