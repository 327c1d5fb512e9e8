"""How fast the page of ``dondolo serve`` follows its sliders, in Chromium: ``python benchmark/live.py``.

Measures the first curve, the time from a key on a slider to the painted curve with and without a tie, curves per second
while a slider is dragged, the memory of the server, and what becomes of random states of the sliders, in less than two
minutes. The load of the machine is printed beside the numbers, which are of the page as it is installed.
"""

import os
import shutil
import statistics
import subprocess
import sys
import time
from pathlib import Path

from playwright.sync_api import Page, sync_playwright

KEYS, DRAGS, STATES = 60, 90, 500

# Times from the event of a slider to the painted curve [ms], curves, and numbers that are seen beside other sliders
WATCH = """
window.times = []; window.painted = 0; window.stale = []; let pressed = 0;
const places = ['#numbers dd', '#under', '#warnings', '#check td', '#text', '#wall text', '#chart .halo'];
const seen = () => places.filter((place) => [...document.querySelectorAll(place)]
  .some((one) => one.textContent && getComputedStyle(one).visibility !== 'hidden'));
addEventListener('input', (event) => {
  if (event.target.type === 'range' && event.target.id !== 'pga') pressed = performance.now();
}, true);
// After the page has heard of it
addEventListener('input', (event) => {
  if (event.target.type === 'range' && event.target.id !== 'pga') window.stale.push(...seen());
});
addEventListener('painted', () => {
  window.painted += 1;
  if (document.body.matches('.stale')) { window.stale.push(...seen()); return; }
  if (!pressed) return;
  const from = pressed; pressed = 0;
  requestAnimationFrame(() => requestAnimationFrame(() => window.times.push(performance.now() - from)));
});
"""
# A random state: some sliders anywhere within their ends, and once in a while another mechanism
SHAKE = """
(turn) => {
  if (turn % 50 === 0) {
    const kinds = [...document.querySelectorAll('input[name=kind]')];
    kinds[(turn / 50) % kinds.length].click();
  }
  const ranges = [...document.querySelectorAll('#form input[type=range]')].filter(() => Math.random() < 0.3);
  for (const range of ranges) {
    range.value = Number(range.min) + Math.random() * (range.max - range.min);
    for (const name of ['input', 'change']) range.dispatchEvent(new Event(name, { bubbles: true }));
  }
}
"""
WHOLE = (
    "!document.body.matches('.stale') && !/draft/.test(document.querySelector('#under').textContent)"
    " && (document.querySelector('#numbers dd') !== null) !== !document.querySelector('#notice').hidden"
)


def load() -> str:
    """The load of the machine, where it is known."""
    return f"load {os.getloadavg()[0]:.1f}" if hasattr(os, "getloadavg") else "load unknown"


def until(page: Page, holds: str, seconds: float = 30.0) -> bool:
    """Wait until an expression holds; whether it does in time."""
    end = time.monotonic() + seconds
    while not page.evaluate(holds):
        if time.monotonic() > end:
            return False
        page.wait_for_timeout(5)
    return True


def press(page: Page, name: str) -> str:
    """Keys on a slider, one after the other: the times to the painted curve."""
    page.focus(f"[data-name='wall.{name}'] input[type=range]")
    page.evaluate("times.length = 0")
    for i in range(KEYS):
        page.keyboard.press("ArrowRight" if i % 2 else "ArrowLeft")
        until(page, f"times.length > {i}")
    times = sorted(page.evaluate("times"))
    return f"p50 {statistics.median(times):.0f} ms, p95 {times[int(0.95 * len(times))]:.0f} ms"


def drag(page: Page, name: str) -> str:
    """A slider is dragged to and fro: curves that are painted meanwhile."""
    box = page.locator(f"[data-name='wall.{name}'] input[type=range]").bounding_box()
    assert box is not None
    x, y = box["x"], box["y"] + box["height"] / 2
    page.mouse.move(x + 0.5 * box["width"], y)
    page.mouse.down()
    before, begin = page.evaluate("painted"), time.monotonic()
    for i in range(DRAGS):
        page.mouse.move(x + box["width"] * (0.5 + 0.3 * abs((i % 40) / 20 - 1)), y)
    count, seconds = page.evaluate("painted") - before, time.monotonic() - begin
    page.mouse.up()
    until(page, WHOLE)
    return f"{count / seconds:.0f} curves/s of {DRAGS / seconds:.0f} events/s"


def shake(page: Page) -> str:
    """Random states of the sliders."""
    refused = unsettled = 0
    for turn in range(STATES):
        page.evaluate(SHAKE, turn)
        unsettled += not until(page, WHOLE)
        refused += page.evaluate("!document.querySelector('#notice').hidden")
    return f"{STATES} states, {refused} refused, {unsettled} unanswered"


def main() -> None:
    browser_path = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)
    command = [sys.executable, "-m", "dondolo", "serve", "--no-browser", "--lang", "en"]
    start = time.monotonic()
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as server, sync_playwright() as started:
        assert server.stdout is not None
        address = server.stdout.readline().strip()
        print(f"server ready: {time.monotonic() - start:.2f} s ({load()})", flush=True)
        try:
            browser = started.chromium.launch(executable_path=browser_path, args=["--no-sandbox"])
            page, failures = browser.new_page(viewport={"width": 1280, "height": 860}), []
            page.on("response", lambda one: failures.append(one.status) if one.status >= 500 else None)
            page.on("pageerror", lambda error: failures.append(str(error)))
            page.add_init_script(WATCH)
            begin = time.monotonic()
            page.goto(address)
            page.wait_for_selector("#chart path.line.a")
            print(f"first curve: {time.monotonic() - begin:.2f} s after the page was opened ({load()})", flush=True)
            until(page, WHOLE)
            print(f"bare wall: {press(page, 'thickness')} ({load()})", flush=True)
            print(f"bare wall dragged: {drag(page, 'thickness')} ({load()})", flush=True)
            page.click("[data-group=ties] summary")
            page.click("[data-group=ties] .adds button >> nth=0")
            until(page, WHOLE)
            print(f"with a tie: {press(page, 'tie_bar')} ({load()})", flush=True)
            print(f"with a tie dragged: {drag(page, 'tie_bar')} ({load()})", flush=True)
            print(f"{shake(page)} ({load()})", flush=True)
            status = Path(f"/proc/{server.pid}/status")
            if status.exists():
                memory = dict(line.split(":", 1) for line in status.read_text().splitlines())
                print(f"memory of the server: {int(memory['VmRSS'].split()[0]) / 1024:.0f} MB")
            stale = sorted(set(page.evaluate("stale")))
            print(f"failures: {failures or 'none'}; numbers of other sliders: {stale or 'none'}")
        finally:
            server.terminate()
    sys.exit(bool(failures or stale))


if __name__ == "__main__":
    main()
