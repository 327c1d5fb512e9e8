"""The wheel for Windows from what meson has installed: python windows_wheel.py PREFIX DETAILS FOLDER [LICENCE...]

PREFIX is the installation, and DETAILS the build-details.json of the Python for which its extension module is compiled.
The LICENCEs, beside those in pyproject.toml, are of libraries of the compiler. meson-python builds wheels for its own
Python only.
"""

import json
import sys
from pathlib import Path

from archives import write_archive
from backend import ROOT, read_metadata, record_line


def contents(prefix: Path, data: str) -> dict[str, Path]:
    """The files of an installation by their names in a wheel, whose data are in a folder of this name."""
    packages = prefix / "lib/site-packages"
    found = {path.relative_to(packages).as_posix(): path for path in packages.rglob("*")}
    found[f"{data}/scripts/dondolo.exe"] = prefix / "bin/dondolo.exe"
    for path in (prefix / "share").rglob("*"):
        found[f"{data}/data/{path.relative_to(prefix).as_posix()}"] = path
    return {name: path for name, path in sorted(found.items()) if path.is_file()}


def write_wheel(prefix: Path, details: Path, folder: Path, licences: list[Path]) -> Path:
    """Write the wheel into a folder, and return its path."""
    metadata = read_metadata(is_standalone=True)
    release = json.loads(details.read_text(encoding="utf-8"))["language"]["version"].replace(".", "")
    tag = f"cp{release}-cp{release}-win_amd64"
    stem = f"{metadata.canonical_name}-{metadata.version}"
    info = f"{stem}.dist-info"
    members = {name: path.read_bytes() for name, path in contents(prefix, f"{stem}.data").items()}
    members |= {f"{info}/licenses/{path.as_posix()}": (ROOT / path).read_bytes() for path in metadata.license_files}
    for path in licences:
        members[f"{info}/licenses/packaging/licenses/{path.name}"] = path.read_bytes()
        metadata.license_files.append(Path("packaging/licenses", path.name))
    members[f"{info}/METADATA"] = bytes(metadata.as_rfc822())
    members[f"{info}/WHEEL"] = (
        f"Wheel-Version: 1.0\nGenerator: dondolo {metadata.version}\nRoot-Is-Purelib: false\nTag: {tag}\n".encode()
    )
    lines = [record_line(name, content) for name, content in members.items()]
    members[f"{info}/RECORD"] = "\n".join([*lines, f"{info}/RECORD,,", ""]).encode()
    wheel = folder / f"{stem}-{tag}.whl"
    write_archive(wheel, members)
    return wheel


if __name__ == "__main__":
    prefix, details, folder, *licences = map(Path, sys.argv[1:])
    print(write_wheel(prefix, details, folder, licences))
