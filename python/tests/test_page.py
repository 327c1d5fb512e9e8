"""The page of ``dondolo serve`` in a browser: Chromium, if there is one here."""

from __future__ import annotations

import re
import subprocess
import sys
import time
from pathlib import Path

import pytest
from browsers import CHROMIUM, needs_browser
from refused_states import states

import dondolo as dd

pytest.importorskip("uvicorn", reason="uvicorn is not installed")
playwright = pytest.importorskip("playwright.sync_api", reason="playwright is not installed")
pytestmark = [
    pytest.mark.slow,
    needs_browser,
    pytest.mark.filterwarnings("ignore:&check"),
]
# Of the questions for curves: how many there were, and most at once; how often a curve was painted
COUNTER = """
window.asked = { all: 0, now: 0, most: 0, painted: 0 };
const fetched = window.fetch;
window.fetch = (path, ...more) => {
  if (path !== 'curve') return fetched(path, ...more);
  asked.all += 1; asked.now += 1; asked.most = Math.max(asked.most, asked.now);
  return fetched(path, ...more).finally(() => { asked.now -= 1; });
};
addEventListener('painted', () => { asked.painted += 1; });
"""


@pytest.fixture(scope="module")
def address(root):
    """Where the page is served, in Italian."""
    command = [sys.executable, "-m", "dondolo", "serve", "--no-browser", "--lang", "it"]
    catalogue = ["--records", root / "data/records/synthetic44.csv"]
    with subprocess.Popen([*command, *catalogue], stdout=subprocess.PIPE, text=True) as server:
        yield server.stdout.readline().strip()
        server.terminate()


@pytest.fixture(scope="module")
def browser():
    """Chromium."""
    with playwright.sync_playwright() as started:
        yield started.chromium.launch(executable_path=CHROMIUM, args=["--no-sandbox"])


@pytest.fixture
def visit(address, browser):
    """Open the page, of a width; it may ask nobody but its server, and no script of it may fail."""
    failed, pages = [], []

    def opened(width=1280, **how):
        context = browser.new_context(viewport={"width": width, "height": 860}, **how)
        context.route(
            lambda url: not url.startswith(("http://127.0.0.1:", "data:", "blob:")),
            lambda route: (failed.append(route.request.url), route.abort()),
        )
        page = context.new_page()
        page.on("pageerror", lambda error: failed.append(str(error)))
        page.on("console", lambda line: failed.append(line.text) if "Content Security" in line.text else None)
        page.add_init_script(COUNTER)
        page.goto(address)
        page.wait_for_selector("#chart path.line.a")
        pages.append(context)
        return page

    yield opened
    for context in pages:
        context.close()
    assert failed == []


def until(page, holds):
    """Wait until an expression holds. The page's policy lets no script within it be evaluated, as Playwright's is."""
    end = time.monotonic() + 30.0
    while not page.evaluate(holds):
        assert time.monotonic() < end, holds
        page.wait_for_timeout(20)


def settled(page):
    """Wait until the newest state of the sliders is painted, whole and no draft."""
    whole = (
        "!document.body.matches('.stale') && document.querySelector('#numbers dd') !== null"
        " && !/bozza|draft/.test(document.querySelector('#under').textContent)"
    )
    until(page, whole)
    page.wait_for_timeout(600)
    until(page, whole)


def test_numbers_are_of_the_text(visit, root):
    """After keys on sliders, the median on the page is that of the case on the page."""
    page = visit()
    page.focus("[data-name='wall.thickness'] input[type=range]")
    for _ in range(5):
        page.keyboard.press("ArrowRight")
    settled(page)
    text = page.text_content("#text")
    assert "thickness = 0.55" in text
    case = dd.results.Case.from_text(text, dd.read_catalogue(root / "data/records/synthetic44.csv"))
    fit = dd.multiple_stripe(
        case.population[0], case.records, case.levels, polarity=case.polarity, progress=False
    ).fit()
    assert page.text_content("#numbers .main dd").replace(",", ".").startswith(f"{fit.theta:.3f}"[:5])
    assert "synthetic44.csv" in text
    assert "sintetici" in page.text_content("#warnings")


def test_no_number_of_another_wall(visit):
    """A wall that cannot stand has a sentence at its slider, and no number, curve or case of the wall before."""
    page = visit()
    page.click("text=Spinte")
    page.click("text=+ spinta")
    box = page.locator("[data-name='wall.thrust'] input[type=text]")
    box.fill("9,5")
    box.press("Enter")
    page.wait_for_selector("#notice:not([hidden])")
    assert "Spinta (thrust) = 9,5 kN/m: la parete non sta in piedi a riposo" in page.text_content("#notice")
    assert "wrong" in page.get_attribute("[data-name='wall.thrust']", "class")
    for place in ("#numbers", "#chart", "#under", "#check", "#text", "#wall"):
        assert page.text_content(place) == ""
    box.fill("0,1")
    box.press("Enter")
    page.wait_for_selector("#notice", state="hidden")
    settled(page)
    assert page.text_content("#numbers .main dd")


# Numbers that are visible, at each event of a slider and at each painted answer that is not of the newest one
SEEN = """
window.seen = []; window.inputs = 0; window.late = 0;
const places = ['#numbers dd', '#under', '#warnings', '#check td', '#text', '#wall text', '#chart .halo'];
const visible = () => places.filter((place) => [...document.querySelectorAll(place)]
  .some((one) => one.textContent && getComputedStyle(one).visibility !== 'hidden'));
window.visible = visible;
addEventListener('input', () => { inputs += 1; seen.push(...visible()); });
addEventListener('painted', () => { if (document.body.matches('.stale')) { late += 1; seen.push(...visible()); } });
"""


def test_numbers_before_are_hidden_at_once(visit):
    """No number is visible from the event of a slider to the answer to it, however late; then all of them are."""
    page = visit()
    settled(page)
    page.evaluate(SEEN)
    # Answers take 0.15 s: events pass before each, and none is given up.
    page.context.route("**/curve", lambda route: (page.wait_for_timeout(150), route.continue_()))
    page.focus("[data-name='wall.thickness'] input[type=range]")
    for _ in range(6):
        page.keyboard.press("ArrowRight")
        page.wait_for_timeout(60)
    settled(page)
    assert page.evaluate("inputs") == 6
    assert page.evaluate("late") >= 1
    assert page.evaluate("seen") == []
    assert "#numbers dd" in page.evaluate("visible()")
    assert "thickness = 0.56" in page.text_content("#text")


def test_late_answers_are_given_up(visit):
    """A newer state ends a question that has taken long; what is shown in the end is the newest."""
    page = visit()
    settled(page)
    page.context.route("**/curve", lambda route: (page.wait_for_timeout(900), route.continue_()))
    given_up = []
    page.on("requestfailed", lambda request: given_up.append(request.url))
    box = page.locator("[data-name='wall.thickness'] input[type=text]")
    for thickness in ("0,6", "0,7"):
        box.fill(thickness)
        box.press("Enter")
        page.wait_for_timeout(450)
    settled(page)
    assert [url.rpartition("/")[2] for url in given_up] == ["curve"]
    assert "thickness = 0.7 " in page.text_content("#text")


@pytest.mark.parametrize("width", [1280, 420])
@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_everything_is_named_and_fits(visit, width, scheme):
    """Every control has a name, nothing is wider than the page, in both languages; axe finds nothing, if it is here."""
    page = visit(width, color_scheme=scheme)
    for kind in ("one_sided", "two_block", "free_standing", "horizontal"):
        page.evaluate(f"document.querySelector('input[value={kind}]').click()")
        page.evaluate("document.querySelectorAll('#form details').forEach((one) => { one.open = true; })")
        settled(page)
        nameless = page.evaluate(
            "[...document.querySelectorAll('button, input, select')].filter((one) => "
            "!(one.labels?.length || one.getAttribute('aria-label') || one.textContent.trim())).length"
        )
        assert nameless == 0
        assert page.evaluate("document.documentElement.scrollWidth <= innerWidth")
        axe(page)
    page.click("text=English")
    settled(page)
    assert page.get_attribute("html", "lang") == "en"
    assert "Median" in page.text_content("#numbers")
    axe(page)


def axe(page):
    """What axe-core finds; it comes with axe-playwright-python, which the tests do not need."""
    try:
        import axe_playwright_python as found
    except ModuleNotFoundError:
        return
    (script,) = Path(found.__file__).parent.glob("**/axe.min.js")
    page.evaluate(script.read_text())
    violations = page.evaluate("axe.run().then((found) => found.violations)")
    assert [(one["id"], [node["html"][:120] for node in one["nodes"]]) for one in violations] == []


def test_designs_and_motions(visit):
    """A against B, the uncertainty of a number, a film that stops, and the peak where motion is unwelcome."""
    page = visit(reduced_motion="reduce")
    page.click("text=Fissa come B")
    page.click("text=Catene")
    page.click("text=+ catena")
    page.wait_for_selector(".compare")
    assert "stessi accelerogrammi" in page.text_content("#under")
    page.click("[data-name='wall.thickness'] button")
    page.wait_for_selector("#chart path.line.fan")
    # A wall that is 10 % lower does not reach up to its tie.
    page.click("[data-name='wall.height'] button")
    until(page, "document.querySelector('#under').textContent.includes('deve stare')")
    said = page.text_content("#under")
    assert "Altezza 5,40 m: Quota (tie_height) = 5,7 m: deve stare" in said
    assert "non oltre la sommità, 5,4 m" in said
    page.select_option("#record", index=3)
    page.click("#play")
    until(page, "document.querySelector('#outcome').textContent !== ''")
    page.wait_for_selector("#trace path.trace")
    page.click("#play")
    assert page.text_content("#trace") == ""


def test_numbers_are_typed_exactly(visit):
    """A number beside a slider is that of the case, with a decimal comma; its tooltip has both of its units."""
    page = visit()
    box = page.locator("[data-name='wall.thickness'] input[type=text]")
    box.fill("0,4567")
    box.press("Enter")
    settled(page)
    assert "thickness = 0.4567 " in page.text_content("#text")
    page.click("text=Catene")
    page.click("text=+ catena")
    bar = page.locator("[data-name='wall.tie_bar'] input[type=text]")
    assert bar.get_attribute("title").endswith("nel caso: tie_bar = 0.016 [m]")
    bar.fill("14,5")
    bar.press("Enter")
    settled(page)
    assert "tie_bar = 0.0145 " in page.text_content("#text")
    assert bar.get_attribute("title").endswith("nel caso: tie_bar = 0.0145 [m]")
    for wrong in ("14,5,1", "mm", ""):
        bar.fill(wrong)
        bar.press("Enter")
        assert "wrong" in page.get_attribute("[data-name='wall.tie_bar']", "class")
        assert "tie_bar = 0.0145 " in page.text_content("#text")


def test_anchors_that_are_not_checked(visit):
    """What a tie buys is conditional as long as its anchor is not known, and no check of it is green."""
    page = visit()
    page.click("text=Fissa come B")
    page.click("text=Catene")
    page.click("text=+ catena")
    page.wait_for_selector(".compare")
    settled(page)
    assert page.text_content(".compare").startswith("Se tengono gli ancoraggi")
    assert "Ancoraggi di catena 1 non verificati" in page.text_content("#warnings")
    assert page.locator("#check td.good, #chart .good").count() == 0
    # Warnings are above the curve, right below the median.
    assert page.evaluate("document.querySelector('#numbers').nextElementSibling.id") == "warnings"
    page.click("text=+ capochiave")
    settled(page)
    assert page.text_content(".compare").startswith("θ di A")
    assert "non verificati" not in page.text_content("#warnings")


def test_a_building_is_drawn_where_there_is_one(visit):
    """A facade leans on a transverse wall; a building is drawn once the case has one."""
    page = visit()
    settled(page)
    assert page.locator("#wall .behind").count() == 0
    assert "a sfavore di sicurezza" in page.text_content("#warnings")
    assert "muro trasversale" in page.text_content("#wall")
    page.click("summary:has-text('Edificio')")
    page.click("text=colloca su un edificio")
    settled(page)
    assert page.locator("#wall .behind").count() == 1
    assert "a sfavore di sicurezza" not in page.text_content("#warnings")
    assert "Edificio" in page.text_content("#wall")


def test_the_building_at_the_limit_states(visit):
    """Period and damping of the building for each state: the check of the page follows, and goes back."""
    page = visit()
    settled(page)
    page.evaluate("document.querySelectorAll('details').forEach((one) => { one.open = true; })")
    assert page.locator("text=+ edificio agli stati limite").count() == 0
    page.click("text=colloca su un edificio")
    page.fill("[data-name='building.level'] input[type=text]", "3")
    page.press("[data-name='building.level'] input[type=text]", "Enter")
    settled(page)
    searched = page.text_content("#check")
    page.click("text=+ edificio agli stati limite")
    settled(page)
    assert page.locator("[data-name='check.building_period']").count() == 3
    assert page.locator("[data-name='check.building_damping']").count() == 3
    for place, (period, damping) in enumerate((("0,3", "5"), ("0,5", "12"), ("0,6", "20"))):
        for name, value in (("building_period", period), ("building_damping", damping)):
            box = f"[data-name='check.{name}'] >> nth={place} >> input[type=text]"
            page.fill(box, value)
            page.press(box, "Enter")
    settled(page)
    given = page.text_content("#check")
    assert given != searched
    text = page.text_content("#text")
    assert re.search(r"building_period\s*=\s*0\.3, 0\.5, 0\.6", text)
    assert re.search(r"building_damping\s*=\s*0\.05, 0\.12, 0\.2", text)
    page.click("text=edificio peggiore >> nth=-1")
    settled(page)
    assert page.text_content("#check") == searched


# Words that are seen, and those of tooltips; of the case its comments, of the records and the catalogue nothing
WORDS = """
(() => {
  const seen = document.body.cloneNode(true);
  seen.querySelectorAll("#record, footer, script").forEach((one) => one.remove());
  const text = seen.querySelector("#text").textContent.split("\\n").map((line) => line.split("!")[1] || "").join(" ");
  seen.querySelector("#text").textContent = "";
  const parts = [];
  const walk = document.createTreeWalker(seen, NodeFilter.SHOW_TEXT);
  while (walk.nextNode()) parts.push(walk.currentNode.textContent);
  const of = (name) => [...seen.querySelectorAll(`[${name}]`)].map((one) => one.getAttribute(name)).join(" ");
  return [parts.join(" "), ["aria-label", "placeholder", "aria-valuetext"].map(of).join(" "), `${of("title")} ${text}`];
})()
"""
# Names of programs, files, units and codes, and words that both languages have
SHARED = set(
    re.findall(
        r"\w+",
        "dondolo word nml svg ntc circolare sld slv slc fc f₀ α₀ t₁ rk lanes pga pgv pgd sa saavg arias trapz cav hi"
        # Classes of use, levels of knowledge and the name of a wall that has none
        " ii iii iv lc wall"
        " pa mpa gpa mm cm m³ s² kn kg ms deg in per base all no file case"
        # Coordinates to the east and to the north are so in both languages
        " positive",
    )
)


def test_italian_has_no_english_word(visit):
    """No word of the page is the same in both languages, but for names; nor of its tooltips, but for variables."""
    page = visit()
    tables = page.evaluate("fetch('begin').then((one) => one.json()).then((one) => one.properties)")
    names = {part for table in tables.values() for name, row in table.items() for part in [name, *row["choices"]]}
    found = {}
    for lang in ("it", "en"):
        parts = []
        for kind in ("two_block", "free_standing", "horizontal", "one_sided"):
            page.evaluate(f"document.querySelector('input[value={kind}]').click()")
            page.evaluate("document.querySelectorAll('details').forEach((one) => { one.open = true; })")
            settled(page)
            parts.append(page.evaluate(WORDS))
        page.click("#under button")
        for group in ("ties", "loads", "thrusts", "building"):
            page.click(f"[data-group={group}] > .adds button >> nth=0")
            settled(page)
        page.wait_for_selector(".compare")
        parts.append(page.evaluate(WORDS))
        page.fill("[data-name='wall.thrust'] input[type=text]", "9.9")
        page.press("[data-name='wall.thrust'] input[type=text]", "Enter")
        page.wait_for_selector("#notice:not([hidden])")
        parts.append(page.evaluate(WORDS))
        found[lang] = [
            set(
                re.findall(
                    r"[^\W\d_]{2,}", re.sub(r"\w*_\w*|&\w+|--\w+|\(\w+\)|dondolo serve", " ", " ".join(one).lower())
                )
            )
            for one in zip(*parts, strict=True)
        ]
        for group in ("ties", "loads", "thrusts", "building"):
            page.click(f"[data-group={group}] button:has-text('{'togli' if lang == 'it' else 'remove'}') >> nth=0")
        page.click("#under button >> nth=-1")
        page.click("text=English" if lang == "it" else "text=Italiano")
        settled(page)
    seen, named, tips = (one & other for one, other in zip(found["it"], found["en"], strict=True))
    assert seen - SHARED == set()
    assert named - SHARED == set()
    assert tips - SHARED - names == set()


def test_horizontal_bending_is_drawn_in_its_plan(visit):
    """Two leaves between transverse walls, with three hinges, the thrust at both ends and a push; and as it moves."""
    page = visit(reduced_motion="reduce")
    page.evaluate("document.querySelector('input[value=horizontal]').click()")
    settled(page)
    assert "mechanism = 'horizontal'" in page.text_content("#text")
    assert page.locator("#wall polygon.body").count() == page.locator("#wall polygon.ghost").count() == 2
    assert page.locator("#wall circle.hinge").count() == 3
    assert page.locator("#wall line.force").count() == 2
    before = page.text_content("#numbers .main dd")
    page.evaluate("document.querySelectorAll('#form details').forEach((one) => { one.open = true; })")
    page.click("[data-group=pushes] > .adds button >> nth=0")
    settled(page)
    assert page.locator("#wall line.force").count() == 3
    assert "push_x = 2.5" in page.text_content("#text")
    assert page.text_content("#numbers .main dd") != before
    page.click("input[value=one_sided]", force=True)
    settled(page)
    text = page.text_content("#text")
    assert "height = 5" in text
    assert "end_thrust" not in text


# The server's refusals of states, with the page's sentences of them
REFUSALS = """
async (several) => {
  const [{ sentenceOf }, { state }] = await Promise.all([import("./refusals.js"), import("./state.js")]), found = [];
  const before = state.settings;
  for (const settings of several) {
    const body = JSON.stringify({ settings, draft: true, lang: "it" });
    const headers = { "content-type": "application/json" };
    const response = await fetch("curve", { method: "POST", headers, body });
    if (response.ok) continue;
    state.settings = settings;
    const answer = await response.json();
    found.push([sentenceOf(answer), answer.error]);
  }
  state.settings = before;
  return found;
}
"""


def test_refusals_are_italian(visit):
    """The sentence of a refusal has no word of the library's English one, but for names: of each field and part."""
    page = visit()
    tables = page.evaluate("fetch('begin').then((one) => one.json()).then((one) => one.properties)")
    names = {one.lower() for table in tables.values() for name, row in table.items() for one in [name, *row["choices"]]}
    found = page.evaluate(REFUSALS, list(states(tables)))
    assert len(found) > 1000
    for italian, english in found:
        one, other = (
            set(re.findall(r"[^\W\d_]{2,}", re.sub(r"\w*_\w*|&\w+|\(\w+\)|zz+", " ", text.lower())))
            for text in (italian, english)
        )
        assert (one & other) - names - SHARED <= {"in", "true", "false"}, (italian, english)
        assert len(one) >= 2, italian


def test_cases_come_and_go(visit, root, tmp_path):
    """A case is opened and saved; one that the page cannot show is refused, and the wall before stays."""
    page = visit()
    page.set_input_files("input[type=file]", root / "data/cases/facade.nml")
    until(page, "document.querySelector('#text').textContent.includes('section_height')")
    page.fill("#title", "Città alta")
    settled(page)
    with page.expect_download() as saved:
        page.click("text=Caso (.nml)")
    assert saved.value.suggested_filename == "citta_alta.nml"
    saved.value.save_as(tmp_path / "saved.nml")
    results = dd.run_case(tmp_path / "saved.nml", progress=False)
    assert page.text_content("#numbers .main dd").replace(",", ".").startswith(f"{results.fragility.theta:.3f}")
    page.set_input_files("input[type=file]", root / "data/cases/population.nml")
    page.wait_for_selector("#notice:not([hidden])")
    assert "section_height" in page.text_content("#text")


def test_curves_follow_the_slider(visit):
    """Curves are painted while keys come, one question at a time, whose newest state waits: no queue of old states."""
    page = visit()
    settled(page)
    page.evaluate("Object.assign(asked, { all: 0, painted: 0 })")
    page.focus("[data-name='wall.height'] input[type=range]")
    keys = 0
    # On a slow machine more keys than on a fast one
    while page.evaluate("asked.painted") < 8:
        keys += 1
        assert keys < 2000
        page.keyboard.press("ArrowRight" if keys % 2 else "ArrowLeft")
        page.wait_for_timeout(30)
    settled(page)
    asked = page.evaluate("asked")
    assert asked["most"] == 1
    # A draft of a drag that is over has its whole answer after it.
    assert asked["all"] <= 2 * keys


def test_a_key_asks_once(visit):
    """One question for a key."""
    page = visit()
    settled(page)
    page.focus("[data-name='wall.thickness'] input[type=range]")
    drafts = []
    page.on("request", lambda one: drafts.append(one.post_data_json["draft"]) if one.url.endswith("/curve") else None)
    for i in range(12):
        page.keyboard.press("ArrowRight" if i % 2 else "ArrowLeft")
        settled(page)
    # On a machine so busy that an answer takes longer than a drag may wait, a draft comes before it.
    assert drafts.count(False) == 12
    assert drafts.count(True) <= 12
