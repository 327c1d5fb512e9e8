"""The build backend of pyproject.toml: meson-python, with metadata that nothing is compiled for, the licences of what a
wheel contains, and an editable installation that is complete.

meson-python gives metadata only with a whole wheel, so that pip compiles everything under "Preparing metadata", without
a word of progress. All of dondolo's metadata are in pyproject.toml.

Wheels that are given to others contain libraries of the compiler and LAPACK: the licence in their metadata names those,
too.

meson-python's own editable installation has neither the executable nor the example records, and after a build in
isolation, which is what ``pip install -e .`` does, it calls a ninja that no longer exists. Here an editable wheel holds
the path of the Python sources, and everything outside the package as an ordinary wheel does. The extension module and
the compiled catalogues of languages are put beside the sources that use them. After a change of a Fortran source,
install again: only changes are compiled.
"""

import base64
import contextlib
import hashlib
import os
import sys
import tempfile
import threading
import time
import tomllib
from collections.abc import Iterator, Mapping
from pathlib import Path
from zipfile import ZIP_DEFLATED, ZipFile

import mesonpy
from mesonpy import build_sdist, get_requires_for_build_sdist, get_requires_for_build_wheel
from pyproject_metadata import StandardMetadata

__all__ = [
    "build_editable",
    "build_sdist",
    "build_wheel",
    "get_requires_for_build_editable",
    "get_requires_for_build_sdist",
    "get_requires_for_build_wheel",
    "prepare_metadata_for_build_editable",
    "prepare_metadata_for_build_wheel",
]

ROOT = Path(__file__).resolve().parents[1]
SOURCES = ROOT / "python"
# Of LAPACK, of libgfortran, libgomp and libgcc, and of libquadmath: packaging/licenses/README.txt
LICENCES_INSIDE = "BSD-3-Clause-Open-MPI AND GPL-3.0-or-later WITH GCC-exception-3.1 AND LGPL-2.1-or-later"
PATH_FILE = "dondolo_editable.pth"

get_requires_for_build_editable = get_requires_for_build_wheel


def read_metadata(is_standalone: bool) -> StandardMetadata:
    """Metadata of pyproject.toml, for a wheel with or without the libraries of others inside."""
    with (ROOT / "pyproject.toml").open("rb") as file:
        metadata = StandardMetadata.from_pyproject(tomllib.load(file), ROOT)
    if is_standalone:
        metadata.license = f"{metadata.license} AND {LICENCES_INSIDE}"
    return metadata


def puts_libraries_inside(settings: Mapping[str, object] | None) -> bool:
    """Whether a wheel is for other machines; those of cibuildwheel are, on macOS without a setting."""
    given = (settings or {}).get("setup-args", [])
    return "-Dstandalone=true" in ([given] if isinstance(given, str) else given) or "CIBUILDWHEEL" in os.environ


def prepare_metadata_for_build_wheel(
    metadata_directory: str, config_settings: Mapping[str, object] | None = None
) -> str:
    """Write the metadata of the wheel, and return the name of their folder (PEP 517)."""
    metadata = read_metadata(puts_libraries_inside(config_settings))
    folder = Path(metadata_directory, f"{metadata.canonical_name}-{metadata.version}.dist-info")
    folder.mkdir()
    (folder / "METADATA").write_bytes(bytes(metadata.as_rfc822()))
    for licence in metadata.license_files:
        copy = folder / "licenses" / licence
        copy.parent.mkdir(parents=True, exist_ok=True)
        copy.write_bytes((ROOT / licence).read_bytes())
    return folder.name


prepare_metadata_for_build_editable = prepare_metadata_for_build_wheel


def build_wheel(
    wheel_directory: str, config_settings: Mapping[str, object] | None = None, metadata_directory: str | None = None
) -> str:
    """Build a wheel and return its name (PEP 517)."""
    with telling_the_time():
        name: str = mesonpy.build_wheel(wheel_directory, config_settings, metadata_directory)
    if puts_libraries_inside(config_settings):
        replace_metadata(Path(wheel_directory, name), bytes(read_metadata(is_standalone=True).as_rfc822()))
    return name


@contextlib.contextmanager
def telling_the_time(every: float = 8.0) -> Iterator[None]:
    """Print how long it takes, for `pip install -v`: one large source may be compiled for longer than a user waits."""
    ended = threading.Event()
    start = time.monotonic()

    def tell() -> None:
        while not ended.wait(every):
            print(f"building for {time.monotonic() - start:.0f} s", flush=True)

    teller = threading.Thread(target=tell, daemon=True)
    teller.start()
    try:
        yield
    finally:
        ended.set()
        teller.join()


def replace_metadata(wheel: Path, metadata: bytes) -> None:
    """Write other metadata into a wheel."""
    with ZipFile(wheel) as file:
        members = [(member, file.read(member)) for member in file.infolist()]
    with ZipFile(wheel, "w", ZIP_DEFLATED) as file:
        for member, content in members:
            if member.filename.endswith(".dist-info/METADATA"):
                content = metadata
            elif member.filename.endswith(".dist-info/RECORD"):
                lines = content.decode().splitlines()
                place = next(i for i, line in enumerate(lines) if line.split(",")[0].endswith(".dist-info/METADATA"))
                lines[place] = record_line(lines[place].split(",")[0], metadata)
                content = "\n".join([*lines, ""]).encode()
            file.writestr(member, content)


def record_line(name: str, content: bytes) -> str:
    """The line of a file in RECORD."""
    digest = base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b"=").decode()
    return f"{name},sha256={digest},{len(content)}"


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
                content = "\n".join([record_line(PATH_FILE, path), *kept, ""]).encode()
            made.writestr(member, content)
        made.writestr(PATH_FILE, path)
