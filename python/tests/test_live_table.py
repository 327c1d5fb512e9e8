"""The curve of "In the browser" that needs no server: its table, and what a browser makes of it."""

import http.server
import json
import shutil
import sys
import threading
from functools import partial

import pytest
from browsers import CHROMIUM, needs_browser

pytestmark = pytest.mark.filterwarnings("ignore::dondolo.errors.DondoloWarning")


@pytest.fixture(scope="module")
def live_table(root):
    """The script that writes the table."""
    pytest.importorskip("starlette", reason="starlette is not installed")
    sys.path.insert(0, str(root / "docs"))
    try:
        import live_table as script

        yield script
    finally:
        sys.path.remove(str(root / "docs"))


@pytest.fixture(scope="module")
def table(live_table):
    """The table as it is in the repository."""
    text = live_table.TARGET.read_text()
    assert len(text) < 4096
    return json.loads(text[text.index("{") : text.rindex(";")])


def test_walls_of_the_table(live_table, table):
    """Its numbers are those of the library, rounded."""
    assert (table["heights"], table["thicknesses"]) == (live_table.HEIGHTS.tolist(), live_table.THICKNESSES.tolist())
    for i, j in ((0, 11), (7, 4), (15, 0)):
        curve = live_table.curve_of(table["heights"][i], table["thicknesses"][j])
        assert table["theta"][i][j] == pytest.approx(curve.theta, rel=1e-3)
        assert table["beta"][i][j] == pytest.approx(curve.beta, abs=1e-3)
        # A wall of the table is met, not only passed by.
        assert live_table.interpolated(table, table["heights"][i], table["thicknesses"][j]) == pytest.approx(
            (table["theta"][i][j], table["beta"][i][j]), rel=1e-12
        )


def test_between_walls_of_the_table(live_table, table):
    """The error that the page states is that of walls between those of the table."""
    for height, thickness in ((2.6, 0.93), (5.0, 0.4), (6.0, 0.5), (10.9, 0.22)):
        theta, _ = live_table.interpolated(table, height, thickness)
        assert theta == pytest.approx(live_table.curve_of(height, thickness).theta, rel=1.5 * table["error"]["largest"])
    assert 0.0 < table["error"]["median"] < table["error"]["largest"] < 0.08


@pytest.mark.slow
@needs_browser
def test_sliders_without_a_server(live_table, table, root, tmp_path):
    """The browser interpolates as the script does, and says that it does."""
    playwright = pytest.importorskip("playwright.sync_api", reason="playwright is not installed")
    static, page = root / "docs/site/static", root / "python/dondolo/serve/page"
    for path in (static / "curve.js", static / "curve_table.js", page / "chart.js", page / "words.js"):
        shutil.copy(path, tmp_path)
    (tmp_path / "index.html").write_text(
        '<!doctype html><div class="interpolated-curve"></div><script type="module" src="curve.js"></script>'
    )
    handler = partial(http.server.SimpleHTTPRequestHandler, directory=tmp_path)
    with http.server.ThreadingHTTPServer(("127.0.0.1", 0), handler) as server, playwright.sync_playwright() as started:
        threading.Thread(target=server.serve_forever, daemon=True).start()
        browser = started.chromium.launch(executable_path=CHROMIUM, args=["--no-sandbox"])
        opened, failed = browser.new_page(), []
        opened.on("pageerror", lambda error: failed.append(str(error)))
        opened.goto(f"http://127.0.0.1:{server.server_address[1]}/")
        opened.wait_for_selector("svg path.line.a")
        for height, thickness in ((6.0, 0.5), (3.3, 0.7)):
            for range_, value in zip(opened.locator("input").all(), (height, thickness), strict=True):
                range_.fill(str(value))
            theta, beta = live_table.interpolated(table, height, thickness)
            said = opened.text_content("[role=status]")
            assert said.startswith(
                f"θ = {theta:.{2 if theta > 1.0 else 3}f} g, β = {beta:.2f}: interpolated in a table of 192 walls"
            )
            assert len(opened.text_content("svg")) > 0
        server.shutdown()
        assert failed == []
