"""The pages of the archive for Windows: python windows_pages.py FOLDER WHEEL

The tutorial in both languages, the glossary and the page of the installation on Windows, as HTML that a browser opens
without a network, and README.txt. Links to pages that are not in the archive become plain words. The pages name WHEEL,
the wheel for Windows that was built with the archive.
"""

import re
import shutil
import sys
from pathlib import Path

from markdown_it import MarkdownIt

DOCS = Path(__file__).resolve().parents[1] / "docs"
PAGES = ("tutorial/first_wall", "tutorial/prima_parete", "tutorial/glossario", "windows")
# The wheel that pages name, and the Python that it is for, but not a release of that Python which was tried
WHEEL = re.compile(r"dondolo-[\d.]+-cp\d+-cp\d+-win_amd64\.whl")
PYTHON = re.compile(r"(?<=\b3\.)13(?!\.?\d)|(?<=\bcp3)13\b")
STYLE = """
body { max-width: 46em; margin: 2em auto; padding: 0 1em; font: 16px/1.5 "Segoe UI", sans-serif; color: #222 }
pre { background: #f4f4f4; padding: .8em; overflow-x: auto }
code { font-family: Consolas, monospace; font-size: 92% }
table { border-collapse: collapse }
td, th { border: 1px solid #ccc; padding: .3em .6em; text-align: left; vertical-align: top }
img { max-width: 100% }
p.tab { font-weight: 600; color: #555 }
"""


def plain(text: str) -> str:
    """Markdown without the tabs of the site: their names stand before what is in them."""
    text = re.sub(r"^:::\{tab-item\} (.*)$", r'<p class="tab">\1</p>\n', text, flags=re.MULTILINE)
    return re.sub(r"^:{3,}.*$", "", text, flags=re.MULTILINE)


def of_wheel(text: str, wheel: str) -> str:
    """A text with the name of this wheel, and its Python."""
    found = re.search(r"-cp3(\d+)-", wheel)
    assert found, wheel
    return PYTHON.sub(found[1], WHEEL.sub(wheel, text))


def link(match: re.Match[str]) -> str:
    """A link to another page of the archive, or its words alone."""
    words, target = match[1], match[2]
    stem, _, anchor = target.partition("#")
    if Path(stem).stem in {Path(page).stem for page in PAGES} and stem.endswith(".md"):
        return f"[{words}]({Path(stem).stem}.html{'#' + anchor if anchor else ''})"
    return match[0] if "://" in target else words


def write_pages(root: Path, wheel: str) -> None:
    """Write the pages and their pictures into a folder, and README.txt, with the name of the wheel."""
    folder = root / "docs"
    folder.mkdir()
    for page in PAGES:
        text = of_wheel(plain((DOCS / f"{page}.md").read_text(encoding="utf-8")), wheel)
        text = re.sub(r"(?<!!)\[([^\]]*)\]\(([^)]*)\)", link, text)
        for picture in re.findall(r"!\[[^\]]*\]\(([^)]*)\)", text):
            shutil.copy((DOCS / page).parent / picture, folder / Path(picture).name)
            text = text.replace(f"({picture})", f"({Path(picture).name})")
        title = re.search(r"^# (.*)$", text, flags=re.MULTILINE)
        assert title, page
        body = MarkdownIt("commonmark", {"html": True}).enable("table").render(text)
        language = "it" if "parete" in page or "glossario" in page else "en"
        html = (
            f'<!DOCTYPE html>\n<html lang="{language}"><head><meta charset="utf-8"><title>{title[1]}</title>\n'
            f"<style>{STYLE}</style></head><body>\n{body}</body></html>\n"
        )
        (folder / f"{Path(page).stem}.html").write_text(html, encoding="utf-8")
    readme = of_wheel((DOCS.parent / "packaging/windows_readme.txt").read_text(encoding="utf-8"), wheel)
    (root / "README.txt").write_text(readme, encoding="utf-8-sig", newline="\r\n")


if __name__ == "__main__":
    write_pages(Path(sys.argv[1]), sys.argv[2])
