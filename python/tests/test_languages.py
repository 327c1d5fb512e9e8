"""Languages of reports: every sentence has its Italian, and nothing English is left but what a user has named."""

import ast
import base64
import html
import re
import subprocess

import matplotlib
import numpy as np
import pytest
from test_relazione import ENGLISH

import dondolo as dd
from dondolo._base.wording import in_english, key, property_name, say
from dondolo._fortran.records import describe_measure
from dondolo._fortran.walls import WALL_PROPERTIES
from dondolo.reporting.columns import _COLUMNS
from dondolo.reporting.language import Language
from dondolo.reporting.statuses import STATUSES
from dondolo.walls.wall import notes_on_supports

MEASURES = [
    "pga",
    "pgv",
    "pgd",
    "arias",
    "cav",
    "arias-trapz",
    "cav-trapz",
    "hi",
    "sa(0.5)",
    "saavg(0.2:2)",
    "pga/a0",
    "p*pgv/a0",
]
# What is said by a name that the library knows: statuses, roles of files, settings, facts of records, clusters
NAMES = [
    *(status.replace("_", " ") for status in STATUSES),
    *["case", "catalogue", "record", "vertical", "population", "table"],
    *["as recorded", "reversed", "both"],
    *[
        "events",
        "records",
        "walls",
        "event",
        "date",
        "magnitude",
        "station",
        "component",
        "ground",
        "year",
        "years",
        "deg",
        "model",
        "total",
    ],
]


def marked(package):
    """Sentences of the sources, as catalogues have them."""
    found = set()
    for source in package.rglob("*.py"):
        for call in ast.walk(ast.parse(source.read_text())):
            if isinstance(call, ast.Call) and getattr(call.func, "id", "") in ("_", "say", "pieces") and call.args:
                sentence = getattr(call.args[0], "value", None)
                found |= {key(sentence)} if isinstance(sentence, str) else set()
    return found


def named():
    """Sentences that are made of names that the library knows."""
    found = set(NAMES)
    for measure in MEASURES:
        places = iter(("{first}", "{last}"))
        found.add(re.sub(r"\d+(?:\.\d+)?", lambda _: next(places), describe_measure(measure).title))  # noqa: B023
    for column in _COLUMNS.values():
        head = column.head("pga") if callable(column.head) else column.head
        found |= {part for part in (head if isinstance(head, tuple) else (head,)) if isinstance(part, str)}
    return found


@pytest.fixture(scope="module")
def catalogue(root):
    """The one Italian catalogue."""
    pofile = pytest.importorskip("babel.messages.pofile")
    return pofile.read_po((root / "python/dondolo/reporting/locale/it.po").open("rb"))


def test_every_sentence_is_translated(root, catalogue):
    package = root / "python/dondolo"
    found = marked(package) | named()
    # Units and formulas are the same in both languages.
    worded = {one for one in found if re.search("[A-Za-z]{2}", re.sub(r"\{[^}]*\}", "", one))}
    known = {one.id: one for one in catalogue if one.id and not one.context}
    assert worded - set(known) == {" [rad/s]", "pga [g]"}
    assert set(known) - found == set()
    assert len(known) > 900
    for sentence, one in known.items():
        assert one.string
        assert not one.fuzzy
        places = [sorted(re.findall(r"\{[^}]*\}", text)) for text in (sentence, one.string)]
        assert places[0] == places[1], sentence
        assert Language("it").text(sentence) == one.string, "build again"


# What names of the catalogue are of, besides columns whose cells are words
KINDS = {
    "property of a case", "note on supports", "name of a sheet", "head of a column", "quantity of a check", "item",
    "item with its article", "warning", "word of the page", "label of the page", "refusal of the page",
}  # fmt: skip


def test_what_has_a_name_is_translated(root, catalogue):
    """Each name once, as it was built; the sources ask for each kind, and columns of words are columns."""
    italian, sources = Language("it"), [one.read_text() for one in (root / "python/dondolo").rglob("*.py")]
    several = [one for one in catalogue if one.context]
    assert len(several) > 1000
    for one in several:
        assert one.string
        assert not one.fuzzy
        assert italian.named(one.context, one.id) == one.string, "build again"
        assert Language("en").named(one.context, one.id) == one.id
    kinds = {one.context for one in several}
    assert kinds >= KINDS
    assert all(any(f'"{kind}"' in text or kind.endswith("of the page") for text in sources) for kind in KINDS)
    heads = {one.id for one in several if one.context == "head of a column"}
    assert kinds - KINDS - heads == set()
    text = (root / "python/dondolo/reporting/locale/it.po").read_text()
    assert text.count("\nmsgctxt ") == len(several), "a name is there twice"


# English words that Italian has too, and Italian that English documents name: titles, marks, a table's year
ALIKE = {"certificate", "converge", "decade", "media", "modulo", "precede", "prime"}
QUOTED = {"__main__.py": {"calcolo", "completare"}, "writing.py": {"calcolo"}, "hazard_table.py": {"anno"},
          "references.f90": {"delle"}}  # fmt: skip
SUFFIXES = {".py", ".pyi", ".js", ".html", ".f90"}
WORD = re.compile("[a-zà-ù]{4,}")


def test_no_other_file_has_italian(root, catalogue):
    """One catalogue: not a word of it in a source, but in readers of accelerograms, which know several languages."""
    pages = [root / "CHANGELOG.md", *(one for one in (root / "docs").glob("*.md") if one.stem != "italiano")]
    english = ALIKE | {word for page in pages for word in WORD.findall(page.read_text().lower())}
    english |= {word for one in catalogue for word in WORD.findall(str(one.id).lower())}
    said = [re.sub(r"\{[^}]*\}", " ", one.string.lower()) for one in catalogue if one.id]
    italian = {word for text in said for word in WORD.findall(text)} - english
    assert set(WORD.findall('{"thickness": "spessore della muratura"}')) & italian == {"spessore", "muratura"}
    folders = [root / "python/dondolo", root / "src", root / "app"]
    sources = [one for folder in folders for one in folder.rglob("*") if one.suffix.lower() in SUFFIXES]
    assert len(sources) > 500
    for source in sources:
        if root / "src/study/records" not in source.parents:
            found = set(WORD.findall(source.read_text(encoding="utf-8").lower())) & italian
            assert found - QUOTED.get(source.name, set()) == set(), source


def test_properties_have_names():
    with Language("it").in_force():
        for row in WALL_PROPERTIES:
            name = row.name.replace("_", " ")
            assert property_name(row.name) != name or name in ("spring", "distributed_spring"), name


def test_notes_on_supports_are_said_by_their_codes(root):
    source = (root / "src/core/wall/support_notes.f90").read_text()
    codes = dict(re.findall(r"(\w+) = '(.*?)'", re.search(r"(?s)   !> Codes.*?\n\n", source)[0]))
    notes = Language("it").all_named("note on supports")
    assert list(codes) == list(codes.values())
    assert set(codes) == set(notes)
    building, ties = dd.Building(0.3, participation=1.1), [dd.Tie(7.0, area=1e-4, length=5.0)]
    tied, leaning = (
        dd.OneSidedWall(8.0, 0.4, building=building, ties=ties),
        dd.OneSidedWall(8.0, 0.5, building=building),
    )
    plain = dd.OneSidedWall(8.0, 0.5)
    with Language("it").in_force():
        several, alone, without = (
            [text for _, text in notes_on_supports(some)] for some in ((tied, leaning, plain), (tied,), (plain,))
        )
    moves, ties = notes["one_floor_moves_both"], notes["ties_to_building"]
    both, one = {"walls": "di 2 pareti"}, {"walls": "di 1 parete"}
    assert several == [notes["buildings_move_walls"], moves.format(**both), ties.format(**one)]
    of_it = {"walls": "della parete"}
    assert alone == [notes["building_moves_both"], moves.format(**of_it), ties.format(**of_it)]
    assert without == [notes["records_at_base"]]
    assert notes_on_supports((plain,))[0][1].startswith("records are applied at the base of the wall; ground records")


def test_a_language_is_in_force_for_a_block_alone():
    assert in_english()
    with Language("it").in_force():
        assert say("time [s]") == "tempo [s]"
        assert say("median {theta:.3g}{unit}, dispersion {beta:.3g}", theta=0.5, unit=" g", beta=0.25) == (
            "mediana 0,5 g, dispersione 0,25"
        )
        with Language("en").in_force():
            assert say("time [s]") == "time [s]"
        assert say("no such sentence") == "no such sentence"
    assert say("time [s]") == "time [s]"


def said_in(figure):
    """Texts of a figure and of its legends."""
    return " ".join(one.get_text() for one in figure.findobj(matplotlib.text.Text))


@pytest.mark.filterwarnings("ignore::dondolo.errors.DondoloWarning")
def test_figures_that_no_report_has_are_translated(wall, few):
    block = dd.FreeStandingWall(1.5, 0.25, name="w")
    grid = {"frequencies": [1.0, 3.0], "amplitudes": np.linspace(0.1, 1.6, 16)}
    drawn = [
        dd.cloud(wall, few, scale=3.0, progress=False),
        dd.compare_intensities(wall, few, ["pga", "pgv", "cav", "hi"], progress=False),
        dd.overturning_spectrum(block, dd.pulses.ricker, **grid, progress=False),
    ]
    english = [words(said_in(one.plot().figure)) for one in drawn]
    with Language("it").in_force():
        italian = [words(said_in(one.plot().figure)) for one in drawn]
    # Names of the wall, of the pulse and of measures, symbols, and words of both languages
    both = {"parapet", "w", "ricker", "p", "pga", "pgv", "cav", "hi", "a", "g", "tan", "alpha", "omega", "edp"}
    assert [one & other - both for one, other in zip(english, italian, strict=True)] == [set()] * 3
    assert all(len(one) > 10 for one in italian)


# --- Reports

CASES = [
    "designs",
    "elastic_strip",
    "facade",
    "facade_hinges",
    "facades",
    "gable",
    "history",
    "parapet",
    "population",
    "tied_facade",
    "uncertain_strip",
]


@pytest.fixture(scope="module")
def pages(tmp_path_factory, executable, root):
    """Reports of ready cases, which between them have all chapters, in both languages."""
    folder = tmp_path_factory.mktemp("languages")
    levels = np.array([0.05, 0.1, 0.2, 0.4, 0.8, 1.6])
    hazard = dd.HazardCurve(levels, 1e-4 * levels**-2.5, im="pga", fractiles={0.16: 5e-5 * levels**-2.5})
    made = {}
    for name in CASES:
        text = (root / f"data/cases/{name}.nml").read_text()
        text = re.sub(r"output = '[^']*'", f"output = '{folder / name}'", text)
        for place in ("records", "walls"):
            text = text.replace(f"'../{place}/", f"'{root}/data/{place}/")
        (folder / f"{name}.nml").write_text(text)
        subprocess.run([executable, "--quiet", f"{name}.nml"], cwd=folder, capture_output=True, check=True)
        results = dd.read_results(folder / name)
        for lang in ("en", "it"):
            given = hazard if name in ("parapet", "designs", "facade") else None
            dd.report(results, folder / f"{name}_{lang}.html", hazard=given, title="T", lang=lang)
            made[name, lang] = (folder / f"{name}_{lang}.html").read_text(encoding="utf-8")
    return made


def of_page(page):
    """Text of a page, with that of its figures and of their descriptions; without what is a user's or a file's."""
    figures = re.findall(r"data:image/svg\+xml;base64,([A-Za-z0-9+/=]+)", page)
    drawn = [" ".join(re.findall("<!--(.*?)-->", base64.b64decode(one).decode(), re.DOTALL)) for one in figures]
    alts = re.findall(r'(?:alt|aria-label|title)="([^"]*)"', page)
    page = re.sub(r"<pre>.*?</pre>", "", page.partition("<body>")[2], flags=re.DOTALL)
    return html.unescape(re.sub(r"<[^>]+>", " ", page) + " ".join(alts) + " ".join(drawn))


def words(text):
    return set(re.findall(r"(?<![\w./-])[a-z]+(?![\w./-])", re.sub(r"\S*[_/]\S*", " ", text.lower())))


def numbers(text):
    """Numbers of a text, however many times they are there."""
    return set(re.findall(r"(?<![\w,.])\d+(?:[.,]\d+)?(?![\w,.]\d)", text.replace("\N{NARROW NO-BREAK SPACE}", "")))


@pytest.mark.slow
@pytest.mark.parametrize("name", CASES)
def test_no_english_in_an_italian_report(name, pages, root):
    """But names of walls, designs, groups and files, which are those of the case."""
    page = pages[name, "it"]
    assert '<html lang="it">' in page
    given = (root / f"data/cases/{name}.nml").read_text() + " ".join(
        path.read_text() for path in (root / "data/walls").glob("*.csv") if path.name in page or path.name in name
    )
    text = " ".join(of_page(page).split())
    names = {
        one.strip() for one in re.findall(r"'([^'\n]*)'|([^,\n]+)", given) for one in one if re.search("[a-z]", one)
    }
    # Of the walls that dondolo names itself, by their levels, hinges and sources
    names |= set(re.findall(r"[\w ]+, \w+ at [\d.]+ ?%?|[\w ]+ at [\d.]+|\w+\([\d., ]+\)", text))
    for one in sorted(names, key=len, reverse=True):
        text = text.replace(one, " ")
    assert words(text) & set(ENGLISH.split()) == set()
    assert not re.search(r"(?<![.\d])\d+\.\d{2,}(?![.\d])", re.sub(r"(GCC|Python|NumPy|SciPy|Matplotlib) .*", "", text))


@pytest.mark.slow
@pytest.mark.parametrize("name", CASES)
def test_both_languages_have_the_same_numbers(name, pages):
    found = [
        {one.replace(",", ".") for one in numbers(re.sub(r"\d+:\d+", "", of_page(pages[name, lang])))}
        for lang in ("en", "it")
    ]
    assert found[0] ^ found[1] <= {"5", "82", "0.2"}


def test_english_is_the_default(tmp_path, monkeypatch):
    (record,) = dd.synthetic_records(magnitude=6.5, distance=10.0, site="shallow")
    response = dd.simulate(dd.OneSidedWall(height=1.5, thickness=0.25), record, scale=2.0)
    matplotlib.use("agg")
    dd.report(response, tmp_path / "a.html")
    assert '<html lang="en">' in (tmp_path / "a.html").read_text()
    monkeypatch.setenv("DONDOLO_LANG", "it")
    dd.report(response, tmp_path / "a.html")
    assert "Pareti murarie che oscillano" in (tmp_path / "a.html").read_text()
    assert in_english()
    with pytest.raises(dd.errors.InputError, match="lang"):
        dd.report(response, tmp_path / "a.html", lang="fr")
