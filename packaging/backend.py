"""The build backend of pyproject.toml: meson-python, with an editable installation that is complete.

meson-python's own editable installation has neither the executable nor the example records, and after a build in
isolation, which is what ``pip install -e .`` does, it calls a ninja that no longer exists. Here an editable wheel holds
the path of the Python sources, and everything outside the package as an ordinary wheel does. The extension module and
the compiled catalogues of languages are put beside the sources that use them. After a change of a Fortran source,
install again: only changes are compiled.
"""

import base64
import hashlib
import sys
import tempfile
from collections.abc import Mapping
from pathlib import Path
from zipfile import ZIP_DEFLATED, ZipFile

from mesonpy import build_sdist, build_wheel, get_requires_for_build_sdist, get_requires_for_build_wheel

__all__ = [
    "build_editable",
    "build_sdist",
    "build_wheel",
    "get_requires_for_build_editable",
    "get_requires_for_build_sdist",
    "get_requires_for_build_wheel",
]

SOURCES = Path(__file__).resolve().parents[1] / "python"
PATH_FILE = "dondolo_editable.pth"

get_requires_for_build_editable = get_requires_for_build_wheel


def build_editable(
    wheel_directory: str, config_settings: Mapping[str, object] | None = None, metadata_directory: str | None = None
) -> str:
    """Build an editable wheel and return its name (PEP 660)."""
    settings = dict(config_settings or {})
    if not {"build-dir", "builddir"} & settings.keys():
        # Kept, so that the next installation compiles only what has changed; not in build, which fpm empties.
        settings["build-dir"] = f"build-editable/{sys.implementation.cache_tag}"
    with tempfile.TemporaryDirectory() as folder:
        name = build_wheel(folder, settings, metadata_directory)
        make_editable(Path(folder, name), Path(wheel_directory, name), SOURCES)
    return str(name)


def make_editable(wheel: Path, editable: Path, sources: Path) -> None:
    """Write the editable wheel of a wheel, and what is compiled into the folder of the sources."""
    path = f"{sources}\n".encode()
    digest = base64.urlsafe_b64encode(hashlib.sha256(path).digest()).rstrip(b"=").decode()
    with ZipFile(wheel) as whole, ZipFile(editable, "w", ZIP_DEFLATED) as made:
        for member in whole.infolist():
            content = whole.read(member)
            if member.filename.startswith("dondolo/"):
                if member.filename.endswith((".so", ".pyd", ".mo")):
                    place = sources / member.filename
                    # A program that has the old one loaded keeps it.
                    place.unlink(missing_ok=True)
                    place.write_bytes(content)
                continue
            if member.filename.endswith(".dist-info/RECORD"):
                kept = [line for line in content.decode().splitlines() if not line.startswith("dondolo/")]
                content = "\n".join([f"{PATH_FILE},sha256={digest},{len(path)}", *kept, ""]).encode()
            made.writestr(member, content)
        made.writestr(PATH_FILE, path)
