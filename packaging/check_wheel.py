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
    if "-manylinux_" not in wheel.name:
        found.append("is not tagged as a manylinux wheel")
    with zipfile.ZipFile(wheel) as archive:
        names = archive.namelist()
    sources = re.findall(r"'(dondolo/[^']+\.(?:py|pyi|j2|css|typed))'", (ROOT / "python/meson.build").read_text())
    examples = [
        f".data/data/share/dondolo/{path.relative_to(ROOT / 'data')}"
        for path in (ROOT / "data").glob("**/*")
        # Measured campaigns are for ./run experiments, which needs a clone
        if path.is_file() and path.suffix != ".py" and "experiments" not in path.parts
    ]
    licences = ["LICENSE", *(f"packaging/licenses/{path.name}" for path in (ROOT / "packaging/licenses").iterdir())]
    wanted = [*sources, *examples, ".data/scripts/dondolo", *(f".dist-info/licenses/{name}" for name in licences)]
    found += [f"lacks {end}" for end in wanted if not any(name.endswith(end) for name in names)]
    for pattern in (r"dondolo/_fortran/_core\..*\.so", r"dondolo\.libs/libgfortran.*", r"dondolo\.libs/libgomp.*"):
        if not any(re.fullmatch(pattern, name) for name in names):
            found.append(f"lacks {pattern}")
    if any("lapack" in name or "blas" in name for name in names):
        found.append("has a shared LAPACK, which must be linked statically")
    return found


if __name__ == "__main__":
    wrong = 0
    for given in map(Path, sys.argv[1:]):
        said = problems(given)
        wrong += len(said)
        print(f"{given.name}: {given.stat().st_size / 1e6:.1f} MB", *said, sep="\n   ")
    sys.exit(wrong > 0)
