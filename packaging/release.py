"""What must be right before a release, and what a person must then do: python release.py texts | files FIRST SECOND

texts: the version is the same everywhere, CHANGELOG.md and CITATION.cff have its date, the licences are there, and
pages name files of this version. files: the files of two builds of a commit are the same to the byte, and hold what
they must. Either prints a line for each thing and ends with 1 if one is wrong. What only waits for a person, such as
the date, is printed as "to do".
"""

import hashlib
import json
import re
import subprocess
import sys
import tarfile
import tomllib
import zipfile
from collections.abc import Iterator
from pathlib import Path

import check_wheel

ROOT = Path(__file__).resolve().parents[1]
DATE = r"\d{4}-\d{2}-\d{2}"
# Where the version stands, and how
PLACES = {
    "meson.build": r"^  version: '([^']+)',$",
    "fpm.toml": r'^version = "([^"]+)"$',
    "CITATION.cff": r"^version: (\S+)$",
    ".zenodo.json": r'^  "version": "([^"]+)",$',
    "src/study/files/version.f90": r"dondolo_version_text = '([^']+)'$",
    "packaging/conda-forge/recipe.yaml": r'^  version: "([^"]+)"$',
    "packaging/spack/package.py": r'^    version\("([^"]+)", sha256',
}
LICENCES = ("LICENSE", *(f"packaging/licenses/{name}" for name in ("GPL-3.0.txt", "LGPL-2.1.txt", "LAPACK.txt")))
# What a machine cannot know or do
PERSON = (
    "claim the name dondolo on PyPI, with .github/workflows/pypi.yml as its trusted publisher; wheels are installed by "
    "their file names until then, and pages that say so change",
    "name the repository: [project.urls] in pyproject.toml, repository-code in CITATION.cff, homepage in the recipes",
    "push the tag; the workflow `release` makes a draft with all files, macOS's and cibuildwheel's among them, which "
    "were never tried: publish it when they pass",
    "connect the repository with Zenodo before the tag; write the DOI that it gives into CITATION.cff and the README",
    "submit the recipes of conda-forge and Spack that lie in the draft",
)

Finding = tuple[str, str]


def project() -> dict[str, object]:
    """The table [project] of pyproject.toml."""
    found: dict[str, object] = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    return found


def texts() -> Iterator[Finding]:
    """What the sources say of the release: (outcome, what)."""
    version = str(project()["version"])
    for path, pattern in PLACES.items():
        found = re.findall(pattern, (ROOT / path).read_text(encoding="utf-8"), re.MULTILINE)
        yield ("ok" if found == [version] else "WRONG", f"{path}: version {', '.join(found) or 'nowhere'}")
    changelog = (ROOT / "CHANGELOG.md").read_text(encoding="utf-8")
    heading = re.search(r"^## (.*)$", changelog, re.MULTILINE)
    told = heading[1] if heading else ""
    if re.fullmatch(rf"{re.escape(version)}, {DATE}", told):
        yield "ok", f"CHANGELOG.md: {told}"
    elif told == f"{version}, unreleased":
        yield "to do", f"CHANGELOG.md: put the date of the release in the place of 'unreleased' below {version}"
    else:
        yield "WRONG", f"CHANGELOG.md: begins with '{told}', and not with {version}"
    citation = re.search(
        rf'^date-released: "({DATE})"$', (ROOT / "CITATION.cff").read_text(encoding="utf-8"), re.MULTILINE
    )
    if citation is None:
        yield "WRONG", "CITATION.cff: no date-released"
    elif told.endswith(citation[1]):
        yield "ok", f"CITATION.cff: {citation[1]}"
    else:
        yield "to do", f"CITATION.cff: date-released is {citation[1]}; CHANGELOG.md must have the same day"
    creators = json.loads((ROOT / ".zenodo.json").read_text(encoding="utf-8"))["creators"]
    names = re.findall(r"^  - name: (.+)$", (ROOT / "CITATION.cff").read_text(encoding="utf-8"), re.MULTILINE)
    same = names == [one["name"] for one in creators] == [one["name"] for one in project()["authors"]]  # type: ignore[attr-defined]
    yield ("ok" if same else "WRONG", f"authors of CITATION.cff, .zenodo.json and pyproject.toml: {', '.join(names)}")
    for path in LICENCES:
        yield ("ok" if (ROOT / path).stat().st_size > 500 else "WRONG", f"licence {path}")
    stale = sorted(other_versions(version))
    yield ("WRONG" if stale else "ok", f"pages name files of {version}{' but for ' if stale else ''}{', '.join(stale)}")
    tags = subprocess.run(["git", "tag", "--points-at", "HEAD"], cwd=ROOT, capture_output=True, text=True, check=True)
    tagged = f"v{version}" in tags.stdout.split()
    yield ("ok" if tagged else "to do", f"tag v{version} {'is' if tagged else 'must be put'} on this commit")


def other_versions(version: str) -> set[str]:
    """Names of files of other versions that pages tell to install or unpack."""
    found = set()
    for path in (ROOT / "README.md", *(ROOT / "docs").rglob("*.md"), *(ROOT / "packaging").glob("*.txt")):
        for other in re.findall(r"\bdondolo-(\d+\.\d+\.\d+)", path.read_text(encoding="utf-8")):
            if other != version:
                found.add(f"{path.relative_to(ROOT)}: dondolo-{other}")
    return found


def files(first: Path, second: Path) -> Iterator[Finding]:
    """What the files of two builds are: (outcome, what)."""
    again = {path.name: path for path in second.iterdir() if path.is_file()}
    for path in sorted(path for path in first.iterdir() if path.is_file() and path.suffix != ".txt"):
        digest = hashlib.sha256(path.read_bytes()).hexdigest()
        about = f"{path.name}, {path.stat().st_size / 1e6:.1f} MB, sha256 {digest}"
        for problem in problems(path):
            yield "WRONG", f"{path.name}: {problem}"
        if path.name not in again:
            yield "once", about
        elif path.read_bytes() == again[path.name].read_bytes():
            yield "same", about
        else:
            differ = ", ".join(members_that_differ(path, again[path.name])[:5])
            yield "WRONG", f"{path.name}: other bytes in a second build ({differ or 'of the container'})"
    for name in sorted(again.keys() - {path.name for path in first.iterdir()}):
        yield "WRONG", f"{name}: only in the second build"
    for kind, pattern in {
        "sdist": "*.tar.gz",
        "wheel for Linux": "*manylinux*.whl",
        "wheel for Windows": "*win_amd64.whl",
        "archive for Windows": "*-windows.zip",
    }.items():
        if not any(first.glob(pattern)):
            yield "WRONG", f"there is no {kind}"


def contents(path: Path) -> dict[str, bytes]:
    """The files in an archive."""
    if path.suffix == ".gz":
        with tarfile.open(path) as archive:
            read = {member.name: archive.extractfile(member) for member in archive.getmembers() if member.isfile()}
            return {name: file.read() for name, file in read.items() if file}
    with zipfile.ZipFile(path) as archive:
        return {name: archive.read(name) for name in archive.namelist()}


def members_that_differ(path: Path, other: Path) -> list[str]:
    """Names of what differs in two archives."""
    one, its = contents(path), contents(other)
    return [name for name in sorted(one.keys() | its.keys()) if one.get(name) != its.get(name)]


def problems(path: Path) -> list[str]:
    """What is wrong with a file of a release."""
    if path.suffix == ".whl":
        return check_wheel.problems(path)
    version = str(project()["version"])
    if path.name == f"dondolo-{version}.tar.gz":
        wanted = (
            *LICENCES,
            "CITATION.cff",
            "CHANGELOG.md",
            "PKG-INFO",
            "run",
            "src/meson.build",
            "data/records/synthetic44.csv",
        )
    elif path.name == f"dondolo-{version}-windows.zip":
        own = ("dondolo", "GPL-3.0", "GCC-exception-3.1", "LGPL-2.1", "LAPACK", "mingw-w64")
        wanted = ("bin/dondolo.exe", "README.txt", "docs/windows.html", *(f"licences/{name}.txt" for name in own))
    else:
        return ["is none of the files of a release"]
    names = {name.partition("/")[2] for name in contents(path)}
    return [f"lacks {name}" for name in wanted if name not in names]


def main(words: list[str]) -> int:
    """Print what was found; number of things that are wrong."""
    findings = list(texts() if words == ["texts"] else files(*map(Path, words[1:])))
    for outcome, what in findings:
        print(f"{outcome:<6} {what}")
    if words != ["texts"]:
        print("\nA person must then:", *(f"  {i}. {what}" for i, what in enumerate(PERSON, 1)), sep="\n")
    return sum(outcome == "WRONG" for outcome, _ in findings)


if __name__ == "__main__":
    if sys.argv[1:] != ["texts"] and (len(sys.argv) != 4 or sys.argv[1] != "files"):
        sys.exit(__doc__)
    sys.exit(main(sys.argv[1:]) > 0)
