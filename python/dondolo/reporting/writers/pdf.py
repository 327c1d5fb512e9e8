"""A report as PDF: Chromium or WeasyPrint prints its page, with page numbers."""

from __future__ import annotations

import os
import shutil
import sys
from pathlib import Path
from typing import Any

from dondolo._fortran.files import whole_file
from dondolo.errors import DondoloError

_BROWSERS = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable", "chrome", "microsoft-edge")

# Seconds that a browser may take
_PATIENCE = 300


def write_pdf(path: str | os.PathLike[str], html: str, mark: str) -> None:
    """Print a page into a file that appears whole or not at all.

    Parameters
    ----------
    path : path
        The file.
    html : str
        The page, which refers to no other file.
    mark : str
        What the last line of the file says: a comment, by which the file is known.

    Raises
    ------
    DondoloError
        If no program that prints is here, it fails, or the file cannot be written.
    """
    import tempfile

    browser = _browser()
    with whole_file(path) as part, tempfile.TemporaryDirectory() as folder:
        page = Path(folder) / "report.html"
        _write_page(page, html)
        if browser is not None:
            _print_by_browser(browser, page, part)
        else:
            _print_by_weasyprint(page, part)
        if not part.read_bytes().startswith(b"%PDF"):
            raise DondoloError(f"{os.fspath(path)}: {browser or 'WeasyPrint'} failed to print the report as PDF")
        with part.open("a", encoding="ascii") as file:
            file.write(f"% {mark}\n")


def check_printer() -> None:
    """Refuse to make a report for PDF, which takes seconds, where nothing can print it.

    Raises
    ------
    DondoloError
        Neither a browser nor WeasyPrint is here.
    """
    if _browser() is None:
        _weasyprint()


def sets_formulas() -> bool:
    """Whether the program that prints sets formulas of MathML: browsers do, WeasyPrint does not."""
    return _browser() is not None


def _browser() -> str | None:
    return next(filter(None, map(shutil.which, _BROWSERS)), None)


def _write_page(path: Path, html: str) -> None:
    """Write the page where a program reads it."""
    # Browsers before 2025 leave out what is folded up, whatever the style of print says.
    with whole_file(path) as part:
        part.write_text(html.replace("<details>", "<details open>"), encoding="utf-8", newline="\n")


def _print_by_browser(browser: str, page: Path, part: Path) -> None:
    """Print by Chromium, or by a browser that descends from it."""
    import subprocess

    # Root may start it only without its sandbox; the page is our own.
    root = ["--no-sandbox"] if sys.platform != "win32" and os.geteuid() == 0 else []
    quiet = ["gpu", "quic", "background-networking", "component-update", "sync", "extensions"]
    options = ["--headless", "--no-first-run", *(f"--disable-{name}" for name in quiet), "--no-pdf-header-footer"]
    target = page.with_suffix(".pdf")
    command = [browser, *options, *root, f"--user-data-dir={page.parent / 'profile'}", f"--print-to-pdf={target}"]
    try:
        subprocess.run(
            [*command, page.as_uri()], check=True, capture_output=True, timeout=_PATIENCE, stdin=subprocess.DEVNULL
        )
        shutil.copyfile(target, part)
    except (subprocess.SubprocessError, FileNotFoundError) as error:
        raise DondoloError(f"{browser} could not print the report: {error}") from None


def _print_by_weasyprint(page: Path, part: Path) -> None:
    """Print by WeasyPrint."""
    _weasyprint().HTML(filename=str(page)).write_pdf(str(part))


def _weasyprint() -> Any:
    """WeasyPrint, whose libraries may be missing too."""
    try:
        import weasyprint
    except (ImportError, OSError):
        raise DondoloError(
            "a report as PDF needs Chromium or WeasyPrint (pip install weasyprint), and neither is installed: write it "
            "as HTML, and print that in any browser"
        ) from None
    return weasyprint
