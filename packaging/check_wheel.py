"""What a wheel must hold, and how large it may be: python check_wheel.py WHEEL..."""

import re
import sys
import zipfile
from pathlib import Path

MOST_BYTES = 12_000_000
ROOT = Path(__file__).resolve().parents[1]


def problems(wheel: Path) -> list[str]:
    """What is wrong with a wheel."""
    found = []
    if wheel.stat().st_size > MOST_BYTES:
        found.append(f"{wheel.stat().st_size} bytes, more than {MOST_BYTES}")
    is_windows = wheel.name.endswith("-win_amd64.whl")
    if not is_windows and "-manylinux_" not in wheel.name:
        found.append("is tagged neither as a manylinux wheel nor as one for Windows")
    with zipfile.ZipFile(wheel) as archive:
        names = archive.namelist()
        metadata = next(archive.read(name).decode() for name in names if name.endswith(".dist-info/METADATA"))
    sources = re.findall(r"'(dondolo/[^']+\.(?:py|pyi|css|typed))'", (ROOT / "python/meson.build").read_text())
    examples = [
        f".data/data/share/dondolo/{path.relative_to(ROOT / 'data')}"
        for path in (ROOT / "data").glob("**/*")
        # Measured campaigns are for ./run experiments, which needs a clone
        if path.is_file() and path.suffix != ".py" and "experiments" not in path.parts
    ]
    licences = ["LICENSE", *(f"packaging/licenses/{path.name}" for path in (ROOT / "packaging/licenses").iterdir())]
    program = ".data/scripts/dondolo.exe" if is_windows else ".data/scripts/dondolo"
    wanted = [
        *sources,
        *examples,
        program,
        "dondolo/reporting/locale/it.mo",
        *(f".dist-info/licenses/{name}" for name in licences),
    ]
    found += [f"lacks {end}" for end in wanted if not any(name.endswith(end) for name in names)]
    patterns = [r"dondolo/_fortran/_core\..*\.so", r"dondolo\.libs/libgfortran.*", r"dondolo\.libs/libgomp.*"]
    if is_windows:
        patterns = [r"dondolo/_fortran/_core\..*-win_amd64\.pyd", r".*/licenses/packaging/licenses/mingw-w64\.txt"]
    for pattern in patterns:
        if not any(re.fullmatch(pattern, name) for name in names):
            found.append(f"lacks {pattern}")
    if any("lapack" in name or "blas" in name for name in names):
        found.append("has a shared LAPACK, which must be linked statically")
    licence = re.search(r"^License-Expression: (.*)$", metadata, re.MULTILINE)
    if licence is None or not {"MIT", "GPL-3.0-or-later", "BSD-3-Clause-Open-MPI"} <= set(licence[1].split()):
        found.append("does not name the licences of GCC's libraries and LAPACK in its metadata")
    return found


if __name__ == "__main__":
    wrong = 0
    for given in map(Path, sys.argv[1:]):
        said = problems(given)
        wrong += len(said)
        print(f"{given.name}: {given.stat().st_size / 1e6:.1f} MB", *said, sep="\n   ")
    sys.exit(wrong > 0)
