"""The server of the page: who gets an answer, and that the answers are those of the executable."""

from __future__ import annotations

import asyncio
import contextlib
import copy
import json
import os
import re
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path
from typing import get_args

import numpy as np
import pytest

import dondolo as dd

pytest.importorskip("starlette", reason="starlette is not installed")
pytest.importorskip("httpx", reason="httpx is not installed")

from refused_states import states
from starlette.testclient import TestClient

from dondolo.checks.ntc import Verdict
from dondolo.exchange.case_text import case_text
from dondolo.reporting.language import Language
from dondolo.serve import documents
from dondolo.serve.server import application, beginning_of, warm_up

pytestmark = pytest.mark.filterwarnings("ignore::DeprecationWarning", "ignore:&check")
PORT, TOKEN = 8123, "a-token"
HOME = f"http://127.0.0.1:{PORT}"
TIED = {
    "job": {"task": "stripes", "title": "Facciata dell'angolo"},
    "wall": {
        "mechanism": "one_sided",
        "height": 6.0,
        "thickness": 0.5,
        "load": [12e3],
        "load_height": [6.0],
        "load_depth": [0.2],
        "load_inertia": "both",
        "tie_height": [5.7],
        "tie_bar": [0.014],
        "tie_spacing": [3.0],
        "tie_length": [8.0],
    },
    "records": {"polarity": "both"},
    "stripes": {"im": "pga"},
    "check": {"ag": [0.25], "f0": [2.5], "tc_star": [0.35], "soil": "B", "knowledge_factor": 1.2},
}

BARE = {**TIED, "wall": {name: value for name, value in TIED["wall"].items() if not name.startswith("tie")}}


@pytest.fixture(scope="module")
def bench(root):
    """The synthetic accelerograms, and what computes with them."""
    return beginning_of(None, str(root / "data/records/synthetic44.csv"), 0)


@pytest.fixture
def stranger(bench):
    """Somebody on this computer without the token."""
    return TestClient(application(*bench, "en", PORT, TOKEN), base_url=HOME, follow_redirects=False)


@pytest.fixture
def page(stranger):
    """The page, once its address was opened."""
    return opened(stranger)


def opened(stranger):
    """A client that has opened the address with the token."""
    assert stranger.get(f"/?token={TOKEN}", follow_redirects=False).status_code == 303
    return stranger


def curve(page, settings, **more):
    """What the page gets for a case."""
    response = page.post("/curve", json={"settings": settings, "lang": "en"} | more)
    assert response.status_code in (200, 422), response.text
    return response.json()


def test_who_is_answered(stranger):
    """Nobody without the token, from another host or origin; the token becomes a cookie and leaves the address."""
    for path in ("/", "/page.js", "/begin", "/nowhere", "/../../etc/passwd"):
        assert stranger.get(path).status_code == 403
    assert stranger.post("/curve", json={}).status_code == 403
    assert stranger.get("/?token=another").status_code == 403
    first = stranger.get(f"/?token={TOKEN}")
    assert (first.status_code, first.headers["location"]) == (303, "/")
    cookie = first.headers["set-cookie"].lower()
    assert "httponly" in cookie
    assert "samesite=strict" in cookie
    assert stranger.get("/").status_code == 200
    for name, value in {
        "host": "evil.example",
        "origin": "http://evil.example",
        "sec-fetch-site": "cross-site",
        "cookie": f"dondolo-{PORT}=another",
    }.items():
        for method, path in (("GET", "/begin"), ("POST", "/curve")):
            assert stranger.request(method, path, json={}, headers={name: value}).status_code == 403, (name, path)
    assert stranger.get("/begin", headers={"host": f"localhost:{PORT}"}).status_code == 200
    assert stranger.get("/begin", headers={"origin": HOME}).status_code == 200


def test_what_is_answered(page):
    """Only small JSON, only the page's own files, with a policy that lets nothing else in."""
    assert page.get("/../../etc/passwd").status_code == 404
    assert page.get("/bench.py").status_code == 404
    assert page.put("/curve").status_code == 405
    assert page.delete("/begin").status_code == 405
    assert page.post("/curve", content="{}", headers={"content-type": "text/plain"}).status_code == 415
    too_large = json.dumps({"text": "x" * 300_000})
    assert page.post("/open", content=too_large, headers={"content-type": "application/json"}).status_code == 413
    for body in ("", "[", "[]", "1", '{"settings": NaN}', "{}", '{"settings": {"wall": []}}', "[" * 100_000):
        answer = page.post("/curve", content=body, headers={"content-type": "application/json"})
        assert answer.status_code == 422, body[:40]
        assert answer.json()["error"]
    for path, kind in {"/": "text/html", "/page.js": "text/javascript", "/page.css": "text/css"}.items():
        answer = page.get(path)
        assert answer.headers["content-type"].startswith(kind)
        policy = answer.headers["content-security-policy"]
        assert "default-src 'none'" in policy
        assert "unsafe" not in policy
        assert answer.headers["x-content-type-options"] == "nosniff"
        assert answer.headers["referrer-policy"] == "no-referrer"


def test_the_page_asks_for_nothing_else(page):
    """Every file that the page names is its own; no address of another host, no style or script within it."""
    text = page.get("/").text
    names = re.findall(r'(?:src|href)="([^"]+)"', text)
    for name in names:
        content = page.get(f"/{name}").text
        names += re.findall(r'from "\./([^"]+)"', content)
        assert set(re.findall(r"https?://[^\s\"'`)]+", content)) <= {"http://www.w3.org/2000/svg"}
    assert {"page.js", "chart.js", "words.js"} <= set(names)
    assert "style=" not in text
    assert "onclick" not in text


def test_files_of_an_opened_case_stay_shut(page, tmp_path):
    """The page never follows a path of a case: its records are those that the server was given."""
    secret = tmp_path / "secret.csv"
    secret.write_text("secret\n")
    wall = "&wall mechanism = 'one_sided', height = 3, thickness = 0.3 /\n&stripes levels = 0.5, 1 /\n"
    answer = page.post("/open", json={"text": f"{wall}&records catalogue = '{secret}' /"})
    assert answer.status_code == 200
    assert "secret" not in answer.text
    table = wall.replace("one_sided', height", f"tabulated', table = '{secret}', height")
    refused = page.post("/open", json={"text": f"{table}&records catalogue = 'x' /"})
    assert refused.status_code == 422
    assert "no file is read" in refused.json()["error"]
    sent = curve(page, {**TIED, "records": {"catalogue": str(secret)}}, auto=True)
    assert str(secret) not in sent["text"]


def test_a_chain_is_refused(page, root):
    """The page has no form for its tables; it says where a chain runs. Wedges of a facade are drawn."""
    for name, case in (("portal", root / "data/cases/portal.nml"), ("own", None)):
        text = case.read_text() if case else "&WALL Mechanism = \"Chain\" /\n&records catalogue = 'x' /"
        refused = page.post("/open", json={"text": text})
        assert refused.status_code == 422, name
        assert "mechanism = 'chain': the page shows walls of one block or two" in refused.json()["error"]
        assert refused.json()["errors"][0]["code"] == "out_of_range"
    sent = page.post("/curve", json={"settings": {"wall": {"mechanism": "chain", "height": 3.0}}, "lang": "it"})
    assert "one block or two" in sent.json()["error"]
    opened = page.post("/open", json={"text": (root / "data/cases/compound.nml").read_text()}).json()
    assert len(curve(page, opened["settings"], auto=True)["wall"]["rest"]) == 3
    words = page.get("/begin").json()["words"]["it"]["refusals"]
    assert "eseguire le catene di corpi rigidi con dondolo" in words["out_of_range.mechanism"]


@pytest.mark.parametrize("name", ["tied", "facade", "gable", "parapet_on_building", "facade_strip", "garden_wall"])
def test_what_is_shown_is_what_the_executable_computes(name, page, root, tmp_path):
    """Median, dispersion, counts and capacities are those of a run of the text on the page, to the bit."""
    settings, is_auto = TIED, True
    # Comments of the case are in the language of the page.
    lang = "it" if name == "tied" else "en"
    if name != "tied":
        settings = page.post("/open", json={"text": (root / f"data/cases/{name}.nml").read_text()}).json()["settings"]
        is_auto = False
    shown = curve(page, settings, auto=is_auto, lang=lang)
    assert ("altezza della parete" in shown["text"]) == (lang == "it")
    path = tmp_path / "shown.nml"
    path.write_text(shown["text"], encoding="utf-8")
    command = [os.path.join(os.path.dirname(sys.executable), "dondolo"), "--quiet", path]
    subprocess.run(command, cwd=tmp_path, check=True, capture_output=True)
    run = dd.read_results(tmp_path / dd.read_case(path).output)
    assert (shown["theta"], shown["beta"]) == (run.fragility.theta, run.fragility.beta)
    assert shown["stripes"] == [
        run.stripes.levels.tolist(),
        run.stripes.collapses.tolist(),
        run.stripes.histories.tolist(),
    ]
    assert shown["trigger"] == run.population[0].trigger_acceleration / run.population[0].gravity
    if "check" in settings:
        assert {(method, state): value for method, state, value in shown["check"]["capacities"]} == run.check.capacities


ROOFS = ["gable", "garden_wall", "parapet", "parapet_on_building", "pinnacle"]
READY = [
    "horizontal",
    *("compound", "corner", "elevation", "panel", "facade", "facade_strip", "tied_facade", "two_block"),
    *("elastic_strip", *ROOFS),
]


@pytest.mark.parametrize("name", READY)
def test_ready_cases_open_whole(name, page, root):
    """A case that is opened is the same wall to the bit, with its levels; nothing of it is dropped."""
    path = root / f"data/cases/{name}.nml"
    settings = page.post("/open", json={"text": path.read_text()}).json()["settings"]
    shown = curve(page, settings)
    case, there = dd.read_case(path), dd.results.Case.from_text(shown["text"], dd.example_records())
    assert there.population[0]._properties() == case.population[0]._properties()
    assert there.levels.tolist() == case.levels.tolist() == shown["levels"]
    drop = {"job", "records"}
    assert {group: there.settings[group] for group in there.settings if group not in drop} == {
        group: case.settings[group] for group in case.settings if group not in drop
    }


def test_other_cases_are_refused_by_name(page, root):
    """A population, a history and a facade with hinges are no wall with a curve."""
    for path in sorted((root / "data/cases").glob("*.nml")):
        answer = page.post("/open", json={"text": path.read_text()})
        assert answer.status_code == (200 if path.stem in READY else 422), path.name
        if path.stem not in READY:
            assert re.search("task = |no file is read|shows walls of one block", answer.json()["error"]), path.name


def test_drafts_pins_and_fans(page):
    """A draft is marked and has half of the records; B is compared on the same records; a fan has two more curves."""
    bare = copy.deepcopy(BARE)
    fan = {"group": "wall", "name": "load", "place": 0, "share": 0.2}
    whole = curve(page, TIED, auto=True, b={**bare, "stripes": {"im": "pga", "levels": [0.2, 0.4, 0.6, 0.8]}}, fan=fan)
    assert whole["comparison"]["ratio"] > 1.0
    low, high = whole["comparison"]["interval"]
    assert low < whole["comparison"]["ratio"] < high
    assert [one["factor"] for one in whole["fan"]] == [0.8, 1.2]
    assert whole["fan"][0]["theta"] != whole["fan"][1]["theta"]
    draft = curve(page, TIED, auto=True, draft=True)
    assert (draft["draft"], whole["draft"]) == (True, False)
    assert 2 * draft["stripes"][2][0] == whole["stripes"][2][0]
    assert "comparison" not in draft
    italian = curve(page, TIED, auto=True, lang="it")
    assert any("fattori di scala" in one["sentence"] for one in italian["warnings"])
    for wrong in (
        {"group": "wall", "name": "mechanism", "share": 0.1},
        {"share": 2},
        {"group": "wall", "name": "load", "place": 9},
    ):
        assert "error" in curve(page, TIED, auto=True, fan=wrong)


def test_anchors_that_nobody_has_given(page):
    """A tie without plate or force of its anchor is marked, and so is what it is compared with."""
    levels = {"stripes": {"im": "pga", "levels": [0.4, 0.8, 1.2]}}
    bare, plated = copy.deepcopy(BARE), copy.deepcopy(TIED)
    plated["wall"] |= {"tie_anchor_force": [8e3]}
    assert curve(page, TIED | levels)["unchecked"] == [1]
    assert curve(page, bare | levels)["unchecked"] == curve(page, plated | levels)["unchecked"] == []
    for one, other, is_open in [(TIED, bare, True), (bare, TIED, True), (plated, bare, False)]:
        assert curve(page, one | levels, b=other | levels)["comparison"]["unchecked"] == is_open
    notes = curve(page, TIED | levels, lang="it")["check"]["notes"]
    # The index with and without the tie has a note of its own
    assert sum("senza contare la catena 1" in note for note in notes) == 1
    notes = [note for note in notes if "senza contare la catena 1" not in note]
    assert [note for note in notes if not note.startswith("fattore di confidenza")] == [
        "ancoraggio di catena 1 non verificato: non sono assegnati né il capochiave né la forza per cui cede"
    ]


def test_verdicts_are_the_library_s(page):
    """The page has the verdicts of `check_ntc`, and words for all that there may be, in both languages."""
    words = page.get("/words.js").text
    verdicts = {f"verdict.{verdict}" for verdict in get_args(Verdict)}
    assert set(re.findall(r'"(verdict\.[\w ]+)":\s*"', words)) == verdicts
    assert verdicts <= set(page.get("/begin").json()["words"]["it"]["words"])
    seen = set()
    weak = TIED["wall"] | {"tie_anchor_force": [2e3]}
    for wall, ag, more in [
        (TIED["wall"], 0.05, {}),
        (TIED["wall"], 0.4, {}),
        (BARE["wall"], 0.05, {}),
        (weak, 0.05, {"use_class": "IV"}),
        (BARE["wall"], 0.05, {"friction": 0.01}),
    ]:
        settings = TIED | {"wall": wall, "check": TIED["check"] | {"ag": [ag], "behaviour": 2.0} | more}
        settings["stripes"] = {"im": "pga", "levels": [0.4, 0.8, 1.2]}
        shown = curve(page, settings)
        case = dd.results.Case.from_text(shown["text"], dd.example_records())
        check = dd.check_ntc(
            case.population[0],
            case.site,
            knowledge_factor=case.knowledge_factor,
            behaviour=case.behaviour,
            friction=more.get("friction"),
        )
        assert shown["check"]["verdicts"] == [
            [*key, check._verdict(key), key in check.required] for key in check.verified
        ]
        assert ("linear", "SLD") in check.required or "use_class" not in more
        assert {(one, state) for one, state, _ in shown["check"]["capacities"]} == set(check.capacities) - set(
            check.not_applicable
        )
        seen |= {verdict for *_, verdict, _required in shown["check"]["verdicts"]}
    assert seen == set(get_args(Verdict))


def test_refusals_are_data(page):
    """A refusal has code, variable, group and line; each code has its Italian on the page."""
    wall = {**TIED["wall"], "height": -6.0, "thicknes": 0.5}
    refused = curve(page, {**TIED, "wall": wall, "stripes": {"levels": [0.5]}})
    errors = [(one["code"], one["variable"], one["group"]) for one in refused["errors"]]
    assert ("unknown_name", "thicknes", "wall") in errors
    assert all(isinstance(one["line"], int) for one in refused["errors"])
    assert "\n".join(one["message"] for one in refused["errors"]) == refused["error"]
    asked = page.post("/open", json={"text": "&job task = 'history' /"}).json()
    assert asked["errors"]
    asked = page.get("/refusals.js").text
    refusals = page.get("/begin").json()["words"]["it"]["refusals"]
    parts = set(re.findall(r'(?:refusal\(|[?:] )"([\w ]+)"', asked)) | set(re.findall(r', "(within \w+)"', asked))
    assert {name.partition(".")[0] for name in refusals} == set(get_args(dd.errors.Code)) | parts


@pytest.mark.slow
def test_refusals_of_every_field_have_codes(page):
    """What the page can be refused has a code and its variable: of each field, and of each kind of part."""
    tables, named = page.get("/begin").json()["properties"], set()
    for settings in states(tables):
        answer = curve(page, settings, draft=True)
        if "error" not in answer:
            continue
        assert answer["errors"], answer
        for one in answer["errors"]:
            assert one["code"], one
            assert one["variable"], one
            named.add(one["variable"])
    asked = {name for table in tables.values() for name in table}
    # All but three are those of a wall given by tables, which no button of the page makes.
    never = {"catalogue", "output", "histories", "table", "rotation", "inertia", "lever", "moment", "vertical_lever"}
    never |= {"travel", "weighted_lever", "weight", "displacement", "bodies", "joints", "actions", "driver"}
    never |= {"body_table", "joint_table", "action_table", "gravity_share", "ties", "tie_table"}
    assert asked - named <= never | {"sides", "top_share", "top_tilt"}


def test_every_property_has_its_words(page):
    """Names and meanings of all variables are there in both languages."""
    words = page.get("/words.js").text
    labels = words[words.index("const LABELS") : words.index("let spoken")]
    named = set(re.findall(r"(\w+): \"", labels))
    begun = page.get("/begin").json()
    tables = begun["properties"]
    rows = {name: row for table in tables.values() for name, row in table.items()}
    assert sum(map(len, tables.values())) == len(rows)
    meanings = Language("it").all_named("property of a case")
    assert named == set(rows) == set(meanings)
    # Symbols are the same in both languages.
    assert named - set(begun["words"]["it"]["labels"]) == {"ag", "f0", "tc_star", "inertia_x", "load_x", "thrust_x"}
    for name, row in rows.items():
        assert row["meaning"]["it"] == meanings[name] != row["meaning"]["en"]


def test_motions(page):
    """The film of a record ends as its history does."""
    shown = curve(page, TIED, auto=True)
    settings = {**TIED, "stripes": {"im": "pga", "levels": shown["levels"]}}
    motion = page.post("/motion", json={"settings": settings, "record": 3, "pga": 1.5}).json()
    case = dd.results.Case.from_text(shown["text"], dd.example_records())
    record = dd.example_records()[3]
    response = dd.simulate(case.population[0], record, 1.5 / record.intensity("pga"))
    assert (motion["edp"], motion["collapsed"], motion["impacts"]) == (
        response.edp,
        response.collapsed,
        response.impacts,
    )
    assert len(motion["frames"]) == len(motion["instants"]) == len(motion["ratio"])
    for wrong in ({"record": 99, "pga": 1.0}, {"record": 0, "pga": 0.0}, {"record": "a", "pga": 1.0}, {"record": 0}):
        assert page.post("/motion", json={"settings": settings} | wrong).status_code == 422


def test_word_is_offered_where_it_can_be_made(page, monkeypatch):
    """A button that could only refuse is not shown."""
    assert page.get("/begin").json()["documents"] == list(documents.DOCUMENTS)
    monkeypatch.setattr(documents, "find_spec", lambda name: None)
    assert page.get("/begin").json()["documents"] == ["report", "relazione"]


def _random_state(rng):
    """A wall as sliders may leave it, some of which cannot stand."""
    height, thickness = rng.uniform(0.5, 12.0), rng.uniform(0.1, 1.0)
    kind = str(rng.choice(["one_sided", "free_standing", "two_block"]))
    wall = {"mechanism": kind, "height": round(height, 2), "thickness": round(thickness, 2)}
    settings = {"job": {"task": "stripes"}, "wall": wall, "records": {"polarity": "both"}, "stripes": {"im": "pga"}}
    if kind == "two_block":
        wall |= {"hinge": rng.uniform(0.3, 0.9), "overburden": rng.uniform(0, 6e4), "overburden_inertia": rng.uniform()}
        wall["eccentricity"] = rng.uniform(-0.2, 0.2)
    elif rng.uniform() < 0.5:
        wall |= {"load": [rng.uniform(0, 6e4)], "load_height": [rng.uniform(0, 15.0)], "load_depth": [rng.uniform()]}
        wall |= {"load_inertia": str(rng.choice(["both", "none", "vertical"]))}
    if kind == "one_sided" and rng.uniform() < 0.4:
        wall |= {"thrust": [rng.uniform(0, 1e4)], "thrust_height": [rng.uniform(0, 15.0)]}
    if kind == "one_sided" and rng.uniform() < 0.4:
        wall |= {"tie_height": [rng.uniform(0.2, 15.0)], "tie_bar": [rng.uniform(0.008, 0.04)]}
        wall |= {"tie_spacing": [rng.uniform(0.5, 8.0)], "tie_length": [rng.uniform(1.0, 20.0)]}
    if rng.uniform() < 0.3:
        settings["building"] = {"period": [rng.uniform(0.05, 1.5)], "damping": [0.05], "storeys": 2, "level": 0.0}
        settings["building"]["building_height"] = rng.uniform(2.0, 30.0)
    if rng.uniform() < 0.5:
        settings["check"] = {"ag": [rng.uniform(0.02, 0.45)], "f0": [2.5], "tc_star": [0.35], "soil": "C"}
    return settings


def test_nobody_waits(bench):
    """A question that was given up ends between blocks of histories, and leaves nothing; the next one is answered."""
    here = bench[0]
    asked = {"settings": {**TIED, "stripes": {"im": "pga", "levels": [0.31, 0.62, 0.93]}}}
    stop = threading.Event()
    stop.set()
    before = list(here._curves)
    with pytest.raises(dd.errors.Interrupted):
        here.curve(asked, stop)
    with pytest.raises(dd.errors.Interrupted):
        here.curve(asked | {"auto": True}, stop)
    assert list(here._curves) == before
    body, sent = json.dumps(asked).encode(), []
    messages = [{"type": "http.request", "body": body}, {"type": "http.disconnect"}]
    headers = {"host": f"127.0.0.1:{PORT}", "cookie": f"dondolo-{PORT}={TOKEN}", "content-type": "application/json"}
    scope = {"type": "http", "method": "POST", "path": "/curve", "raw_path": b"/curve", "query_string": b""}
    scope["headers"] = [(name.encode(), value.encode()) for name, value in headers.items()]

    async def receive():
        return messages.pop(0)

    async def send(message):
        sent.append(message)

    with here._lock:
        # The work waits here until the page has left.
        threading.Timer(0.3, here._lock.release).start()
        asyncio.run(application(*bench, "en", PORT, TOKEN)(scope, receive, send))
        here._lock.acquire()
    assert sent[0]["status"] == 503
    assert list(here._curves) == before
    assert "theta" in here.curve(asked)


@pytest.mark.slow
def test_random_states(page):
    """500 states of the sliders: a curve, or the library's sentence; never a failure of the server."""
    rng, refused = np.random.default_rng(0), []
    for _ in range(500):
        answer = curve(page, _random_state(rng), auto=True, draft=True)
        if "error" in answer:
            refused.append(answer["error"])
            continue
        assert answer["text"].startswith("&job")
        assert ("theta" in answer) == (answer["status"] in ("ok", "extrapolated", "nearly_flat"))
    assert 0 < len(refused) < 250
    assert all("&" in sentence or "stripes" in sentence or "level" in sentence for sentence in refused), set(refused)


def test_the_token_is_no_argument(root, tmp_path):
    """The command prints an address of this computer; its token is not among the arguments that other users see."""
    pytest.importorskip("uvicorn", reason="uvicorn is not installed")
    command = [
        sys.executable,
        "-m",
        "dondolo",
        "serve",
        "--no-browser",
        "--records",
        root / "data/records/synthetic44.csv",
    ]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, cwd=tmp_path) as server:
        try:
            address = server.stdout.readline().strip()
            found = re.fullmatch(r"http://127\.0\.0\.1:(\d+)/\?token=([\w-]{43})", address)
            assert found, address + server.stderr.read()
            arguments = Path(f"/proc/{server.pid}/cmdline")
            assert not arguments.exists() or found[2] not in arguments.read_text()
            import httpx

            for _ in range(100):
                try:
                    with httpx.Client(base_url=f"http://127.0.0.1:{found[1]}", trust_env=False) as client:
                        assert client.get("/").status_code == 403
                        assert client.get("/", params={"token": found[2]}).status_code == 303
                        assert client.get("/begin").json()["version"] == dd.__version__
                    break
                except httpx.ConnectError:
                    time.sleep(0.1)
        finally:
            server.terminate()
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("case", [None, "data/cases/facade.nml"])
def test_the_first_curve_is_computed_while_the_browser_starts(case, root):
    """The first question of the page is that of the server's own, and its stripes are not run again."""
    catalogue = None if case else str(root / "data/records/synthetic44.csv")
    bench, start = beginning_of(case and str(root / case), catalogue, 0)
    warm_up(bench, start, "it")
    (before,) = bench._curves.values()
    is_auto = "levels" not in start.get("stripes", {})
    assert is_auto == (case is None)
    shown = curve(
        opened(TestClient(application(bench, start, "it", PORT, TOKEN), base_url=HOME)), start, auto=is_auto, lang="it"
    )
    assert shown["theta"] == before.fragility.theta
    assert list(bench._curves.values()) == [before]
    # A case that cannot be shown is refused when the page asks, not here.
    warm_up(bench, {"wall": {"mechanism": "one_sided"}}, "it")


def test_the_redirect_is_private(tmp_path, monkeypatch):
    """The file that takes the browser to the page is the user's alone."""
    import webbrowser

    from dondolo.serve.server import _open

    opened = []
    monkeypatch.setattr(webbrowser, "open", opened.append)
    _open(tmp_path, f"{HOME}/?token=x")
    assert opened == [(tmp_path / "open.html").as_uri()]
    assert (tmp_path / "open.html").stat().st_mode & 0o777 == 0o600


@pytest.mark.slow
def test_documents(page):
    """A report and a relazione of the case on the page."""
    shown = curve(page, TIED, auto=True)
    settings = {**TIED, "stripes": {"im": "pga", "levels": shown["levels"]}}
    report = page.post("/document", json={"settings": settings, "kind": "report", "lang": "en"})
    assert report.text.startswith("<!doctype html>") or "<html" in report.text[:300]
    report = page.post("/document", json={"settings": settings, "kind": "report", "lang": "it"})
    assert 'lang="it"' in report.text
    relazione = page.post("/document", json={"settings": settings, "kind": "relazione", "lang": "it"})
    assert 'lang="it"' in relazione.text
    assert page.post("/document", json={"settings": settings, "kind": "other"}).status_code == 422
    del settings["check"]
    refused = page.post("/document", json={"settings": settings, "kind": "relazione", "lang": "it"})
    assert refused.status_code == 422
    assert [(one["code"], one["variable"]) for one in refused.json()["errors"]] == [("not_given", "check")]
    assert refused.json()["error"].startswith("case.nml: has no check")


@pytest.fixture(scope="module")
def moved(tmp_path_factory):
    """A catalogue with vertical components, and its folder."""
    folder, records = tmp_path_factory.mktemp("vertical"), dd.synthetic_records(6.5, 10.0, "shallow", n_records=16)
    # Taken for the vertical components of the same earthquakes
    ups = [dd.Record(up.acceleration, up.dt, up.name) for up in records[8:]]
    both = [one.with_vertical(up, factor=0.8) for one, up in zip(records[:8], ups, strict=True)]
    dd.RecordSet(both).to_catalogue(folder / "moved.csv")
    return folder


@pytest.mark.parametrize(
    "given", ["", ", vertical = 'recorded'", ", vertical = 'recorded', vertical_factor = -1.7", ", polarity = 'both'"]
)
@pytest.mark.filterwarnings("ignore::dondolo.errors.DondoloWarning")
def test_vertical_components_are_those_of_the_executable(given, moved):
    """With each factor, and with none, the page has the counts of a run of the case."""
    path = moved / "case.nml"
    path.write_text(
        "&wall mechanism = 'one_sided', height = 3.0, thickness = 0.25 /\n"
        f"&records catalogue = 'moved.csv'{given} /\n&stripes levels = 0.2, 0.3, 0.4, 0.5 /\n"
    )
    ran = dd.run_case(path, progress=False)
    bench, start = beginning_of(str(path), None, 0)
    there = TestClient(application(bench, start, "en", PORT, TOKEN), base_url=HOME, follow_redirects=False)
    shown = curve(opened(there), start)
    assert shown["stripes"][1] == ran.stripes.collapses.tolist()
    assert shown.get("theta", np.nan) == pytest.approx(ran.fragility.theta, rel=0, nan_ok=True)
    path.write_text(shown["text"])
    again = dd.run_case(path, progress=False)
    np.testing.assert_array_equal(again.stripes.edp, ran.stripes.edp)
    record, wall = dd.read_case(path).records[2], ran.population[0]
    motion = there.post("/motion", json={"settings": start, "record": 2, "pga": 0.3}).json()
    assert motion["edp"] == dd.simulate(wall, record, 0.3 / record.intensity("pga")).edp


def test_vertical_components_that_are_not_there(page):
    """They are refused by the name of the variable, in the file that is opened and on the page."""
    asked = {**TIED, "records": {"vertical": "recorded"}, "stripes": {"levels": [0.5]}}
    opened_text = (
        "&wall mechanism = 'one_sided', height = 3.0, thickness = 0.25 /\n&records catalogue = 'a.csv', vertical"
    )
    text = page.post("/open", json={"text": f"{opened_text} = 'recorded' /\n&stripes levels = 0.5 /"}).json()
    for refused in (curve(page, asked), text):
        assert [(one["code"], one["variable"], one["group"]) for one in refused["errors"]] == [
            ("not_together", "vertical", "records")
        ]


def test_levels_that_are_chosen_change_nothing_else(page):
    """The fits of damage states that the case asks for stay in it."""
    stripes = {"im": "pga", "states": "ordinal", "edp_thresholds": [0.1, 0.4]}
    shown = curve(page, {**TIED, "stripes": stripes}, auto=True)
    case = dd.results.Case.from_text(shown["text"], dd.example_records())
    assert case.states == "ordinal"
    assert case.edp_thresholds.tolist() == [0.1, 0.4, 1.0]
    # Equally spaced levels are levels.
    spaced = {**TIED, "stripes": {"first": 0.2, "last": 0.8, "count": 4}}
    assert curve(page, spaced)["levels"] == pytest.approx([0.2, 0.4, 0.6, 0.8])


@pytest.mark.parametrize("lang", [["it"], {"a": 1}, 3, None, "de", True])
@pytest.mark.parametrize("path", ["/curve", "/document"])
def test_languages_that_are_none(path, lang, page):
    settings = {**TIED, "stripes": {"im": "pga", "levels": [0.5]}}
    refused = page.post(path, json={"settings": settings, "kind": "report", "lang": lang})
    assert refused.status_code == 422
    assert [(one["code"], one["variable"]) for one in refused.json()["errors"]] == [("not_a_word", "lang")]


@pytest.mark.parametrize(
    ("options", "words"),
    [
        (["--port", "99999"], "--port = 99999: must be an integer, between 0 and 65535"),
        (["--port", "-1"], "--port = -1: must be an integer"),
        (["--threads", "-1"], "threads = -1: must be an integer, between 0 and"),
        (["--threads", "99999999999"], "threads = 99999999999: must be an integer"),
        (["--lang", "xx"], "lang = 'xx': must be one of"),
    ],
)
def test_absurd_options(options, words, root, tmp_path):
    """One line each, before anything is read."""
    command = [sys.executable, "-m", "dondolo", "serve", "--no-browser", *options]
    done = subprocess.run(command, capture_output=True, text=True, cwd=tmp_path, timeout=60, check=False)
    assert (done.returncode, done.stdout) == (2, "")
    (line,) = done.stderr.splitlines()
    assert line.startswith(f"dondolo: {words}")


def _asked_in_vain(client, path, body):
    with contextlib.suppress(Exception):
        client.post(path, json=body)


@pytest.mark.slow
@pytest.mark.skipif(sys.platform == "win32", reason="signals of POSIX")
@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
@pytest.mark.parametrize("what", ["curve", "document"])
def test_signals_end_it_whatever_runs(number, what, root, tmp_path):
    """It does not wait for its work, and ends with its processes and its temporary folders."""
    httpx = pytest.importorskip("httpx")
    settings = {**BARE, "stripes": {"im": "pga", "levels": (0.05 * np.arange(1, 120)).tolist()}}
    # Slow on purpose
    settings["solver"] = {"engine": "rk45", "rtol": 1e-12, "atol": 1e-14}
    command = [sys.executable, "-m", "dondolo", "serve", "--no-browser", "--records"]
    environment = os.environ | {"TMPDIR": str(tmp_path)}
    with subprocess.Popen(
        [*command, root / "data/records/synthetic44.csv"],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        env=environment,
    ) as server:
        try:
            at, token = re.fullmatch(r"(.*)/\?token=([\w-]+)", server.stdout.readline().strip()).groups()
            client = httpx.Client(base_url=at, trust_env=False, timeout=60)
            for _ in range(100):
                with contextlib.suppress(httpx.ConnectError):
                    client.get("/", params={"token": token})
                    break
                time.sleep(0.1)
            body = {"settings": settings, "kind": "report", "lang": "en"}
            threading.Thread(target=_asked_in_vain, args=(client, f"/{what}", body), daemon=True).start()
            time.sleep(2.0)
            assert list(tmp_path.iterdir())
            server.send_signal(number)
            # Far less than the work would take
            server.wait(60.0)
            said = server.stderr.read()
        finally:
            server.kill()
    assert server.returncode == (1 if number == signal.SIGINT else 128 + number)
    assert said == ("dondolo: interrupted\n" if number == signal.SIGINT else "")
    assert list(tmp_path.iterdir()) == []
    left = [one for one in Path("/proc").glob("[0-9]*/cmdline") if str(tmp_path).encode() in _read(one)]
    assert left == []


CONNECTED = """
import asyncio
import socket

from dondolo.__main__ import main
from dondolo.serve import server


async def option_of_an_answer(listener):
    found = asyncio.get_running_loop().create_future()
    note = lambda reader, writer: found.set_result(
        writer.get_extra_info("socket").getsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY)
    )
    async with await asyncio.start_server(note, sock=listener):
        with socket.create_connection(listener.getsockname()):
            print("delays:", not await found)


server._Server.run = lambda self, sockets: asyncio.run(option_of_an_answer(sockets[0]))
main(["serve", "--no-browser"])
"""


def test_an_answer_comes_in_one_go():
    """Its sockets do not wait for the other side between two parts of an answer, which would take 40 ms."""
    pytest.importorskip("uvicorn", reason="uvicorn is not installed")
    run = subprocess.run([sys.executable, "-c", CONNECTED], capture_output=True, text=True, check=True)
    assert run.stdout.splitlines()[-1] == "delays: False"


def _read(path):
    try:
        return path.read_bytes()
    except OSError:
        return b""


def test_starts_that_are_refused(root, tmp_path):
    """A case or a catalogue that the page cannot show is named before anything is served."""
    for case, records, match in [
        (root / "data/cases/population.nml", None, "task = 'typology'|no file is read"),
        (None, tmp_path / "nowhere.csv", "no such file"),
        (tmp_path / "nowhere.nml", None, "no such file"),
    ]:
        given = [None if one is None else str(one) for one in (case, records)]
        with pytest.raises(dd.errors.InputError, match=match):
            beginning_of(*given, 0)


@pytest.mark.parametrize("encoding", ["utf-16", "utf-8-sig"])
@pytest.mark.parametrize("is_given", [False, True])
def test_a_case_is_read_in_the_encodings_of_the_executable(root, tmp_path, encoding, is_given):
    case, catalogue = tmp_path / "case.nml", str(root / "data/records/synthetic44.csv")
    text = (root / "data/cases/facade.nml").read_text(encoding="utf-8")
    text = re.sub(r"catalogue *= *'[^']*'", f"catalogue = '{catalogue}'", text)
    case.write_text(text, encoding=encoding)
    start = beginning_of(str(case), catalogue if is_given else None, 0)[1]
    assert start["wall"] == beginning_of(str(root / "data/cases/facade.nml"), catalogue, 0)[1]["wall"]


def test_text_of_a_state_is_the_case(bench):
    """The text of a state and the state that is opened from it are the same."""
    there = bench[0].open(bench[0].text({**TIED, "stripes": {"im": "pga", "levels": [0.5, 1.0]}}))
    assert there["wall"] == {**TIED["wall"]}
    assert there["check"] == TIED["check"]
    assert case_text(there).count("&") == 5
