"""Check the built site: its links, anchors and pictures, and in Chromium its search and narrow screens.

python docs/check_site.py SITE. Every internal link must lead to a page, and its fragment to an anchor there; every
picture must exist, and have a text for those who cannot see it. Links to other sites are not followed.
"""

from __future__ import annotations

import http.server
import shutil
import subprocess
import sys
import tempfile
import threading
from functools import partial
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit

# FORD makes the pages of Fortran; only the way into them is checked.
FOREIGN = "fortran"


class Page(HTMLParser):
    """Links, pictures and anchors of a page."""

    def __init__(self, path: Path) -> None:
        super().__init__()
        self.links: list[str] = []
        self.pictures: list[tuple[str, str | None]] = []
        self.anchors: set[str] = set()
        self.feed(path.read_text(encoding="utf-8"))

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        """Note what a tag refers to."""
        given = dict(attrs)
        self.anchors |= {value for key in ("id", "name") if (value := given.get(key))}
        if tag == "a" and given.get("href"):
            self.links.append(str(given["href"]))
        if tag == "img":
            self.pictures.append((str(given.get("src")), given.get("alt")))


def broken(site: Path) -> tuple[list[str], int]:
    """What is broken, and how many links and pictures were checked."""
    pages = {path: Page(path) for path in site.rglob("*.html") if path.relative_to(site).parts[0] != FOREIGN}
    said, checked = [], 0
    for path, page in pages.items():
        here = path.relative_to(site)
        for link in [*page.links, *(source for source, _ in page.pictures)]:
            parts = urlsplit(link)
            if parts.scheme or parts.netloc:
                continue
            checked += 1
            there = (path.parent / unquote(parts.path)).resolve() if parts.path else path
            there = there / "index.html" if there.is_dir() else there
            if not there.is_file():
                said.append(f"{here}: {link}: no such file")
            elif parts.fragment and there in pages and unquote(parts.fragment) not in pages[there].anchors:
                said.append(f"{here}: {link}: no such anchor")
        said += [f"{here}: {source}: has no text" for source, text in page.pictures if not text]
    return said, checked


class _Quiet(http.server.SimpleHTTPRequestHandler):
    def log_message(self, format: str, *arguments: object) -> None:
        """Say nothing of requests."""


def in_browser(site: Path, chromium: str) -> list[str]:
    """What is wrong in Chromium: the search finds a word, and no page is wider than a telephone."""
    server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), partial(_Quiet, directory=str(site)))
    threading.Thread(target=server.serve_forever, daemon=True).start()
    address = f"http://127.0.0.1:{server.server_port}"
    said = []
    found = _dom(chromium, f"{address}/search.html?q=restitution")
    if 'href="theory.html' not in found:
        said.append("the search for 'restitution' does not find the theory")
    # A frame as narrow as a telephone, and the width that its page takes
    names = sorted(str(path.relative_to(site)) for path in site.rglob("*.html") if FOREIGN not in path.parts)
    pages = [name for name in names if not name.startswith("generated/api/")]
    probe = site / "narrow.html"
    probe.write_text(_NARROW % {"pages": pages}, encoding="utf-8")
    try:
        widths = _dom(chromium, f"{address}/narrow.html")
    finally:
        probe.unlink()
    said += [line for line in widths.splitlines() if line.startswith("too wide")]
    if "all pages measured" not in widths:
        said.append("the widths of the pages could not be measured")
    server.shutdown()
    return said


_NARROW = """<!doctype html><iframe id="frame" style="width:390px;height:800px"></iframe><pre id="said"></pre><script>
(async () => {
  const frame = document.getElementById("frame"), said = document.getElementById("said");
  for (const page of %(pages)s) {
    await new Promise(done => { frame.onload = done; frame.src = page; });
    const width = frame.contentDocument.documentElement.scrollWidth;
    if (width > 391) said.textContent += "\\ntoo wide for a telephone: " + page + ": " + width + " pixels";
  }
  said.textContent += "\\nall pages measured\\n";
})();
</script>"""


def _dom(chromium: str, address: str) -> str:
    """A page after its scripts have run."""
    with tempfile.TemporaryDirectory() as profile:
        quiet = ["quic", "background-networking", "component-update", "sync", "gpu"]
        options = ["--headless", "--no-sandbox", "--no-first-run", *(f"--disable-{name}" for name in quiet)]
        return subprocess.run(
            [chromium, *options, f"--user-data-dir={profile}", "--virtual-time-budget=60000", "--dump-dom", address],
            capture_output=True,
            text=True,
            check=True,
            timeout=180,
        ).stdout


def main() -> int:
    """Check a site."""
    site = Path(sys.argv[1]).resolve()
    said, checked = broken(site)
    chromium = shutil.which("chromium") or shutil.which("google-chrome")
    if chromium is None:
        print("skipped: the checks of search and of narrow screens need Chromium")
    else:
        said += in_browser(site, chromium)
    print(*said, f"{checked} links and pictures, {len(said)} broken", sep="\n")
    return 1 if said else 0


if __name__ == "__main__":
    sys.exit(main())
