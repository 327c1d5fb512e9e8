"""What decides about a release: archives of the same bytes, checks of texts and files, and results on two systems."""

import os
import shutil
import subprocess
import sys
import tarfile
import zipfile

import pytest


@pytest.fixture
def packaging(root, monkeypatch):
    """The folder of the scripts, from which they import each other."""
    monkeypatch.syspath_prepend(str(root / "packaging"))
    yield root / "packaging"
    for name in ("archives", "check_wheel", "release"):
        sys.modules.pop(name, None)


def test_an_archive_is_the_same_whenever_it_is_made(packaging, tmp_path, monkeypatch):
    """Its bytes depend on what is in it and on SOURCE_DATE_EPOCH, not on the order or the day."""
    from archives import write_archive

    members = {"b/two.txt": b"2", "a.txt": b"1"}
    monkeypatch.setenv("SOURCE_DATE_EPOCH", "1700000001")
    write_archive(tmp_path / "one.zip", members)
    write_archive(tmp_path / "two.zip", dict(reversed(members.items())))
    assert (tmp_path / "one.zip").read_bytes() == (tmp_path / "two.zip").read_bytes()
    with zipfile.ZipFile(tmp_path / "one.zip") as archive:
        assert {name: archive.read(name) for name in archive.namelist()} == members
        assert archive.getinfo("a.txt").date_time == (2023, 11, 14, 22, 13, 20)
    # Before what zip can tell
    monkeypatch.setenv("SOURCE_DATE_EPOCH", "0")
    write_archive(tmp_path / "three.zip", members)
    assert zipfile.ZipFile(tmp_path / "three.zip").getinfo("a.txt").date_time[0] == 1980


def copied(packaging, tmp_path, monkeypatch):
    """The texts of a release in a folder of their own, which the script reads."""
    import release

    for path in (*release.PLACES, "pyproject.toml", "CHANGELOG.md", "README.md", *release.LICENCES):
        (tmp_path / path).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(packaging.parent / path, tmp_path / path)
    (tmp_path / "docs").mkdir()
    (tmp_path / "packaging/licenses").mkdir(exist_ok=True)
    shutil.copy(packaging.parent / "docs/windows.md", tmp_path / "docs")
    for words in (
        ["init", "-q"],
        ["add", "."],
        ["-c", "user.name=a", "-c", "user.email=a@b", "commit", "-q", "-m", "a"],
    ):
        subprocess.run(["git", *words], cwd=tmp_path, check=True)
    monkeypatch.setattr(release, "ROOT", tmp_path)
    return release


def test_texts_of_a_release(packaging, tmp_path, monkeypatch):
    """A day and a tag wait for a person; with them nothing is left, and a version that was forgotten is wrong."""
    release = copied(packaging, tmp_path, monkeypatch)
    assert "WRONG" not in {outcome for outcome, _ in release.texts()}
    version = str(release.project()["version"])
    for name, old, new in (
        ("CHANGELOG.md", f"## {version}, unreleased", f"## {version}, 2026-12-24"),
        ("CITATION.cff", "date-released: ", 'date-released: "2026-12-24"\n# '),
    ):
        text = (tmp_path / name).read_text()
        (tmp_path / name).write_text(text.replace(old, new, 1))
    subprocess.run(["git", "tag", f"v{version}"], cwd=tmp_path, check=True)
    assert {outcome for outcome, _ in release.texts()} == {"ok"}
    for name, old in (
        ("fpm.toml", version),
        ("CITATION.cff", "the dondolo contributors"),
        ("docs/windows.md", f"dondolo-{version}"),
    ):
        text = (tmp_path / name).read_text()
        (tmp_path / name).write_text(text.replace(old, "9.9.9" if old == version else "dondolo-9.9.9", 1))
        (wrong,) = [what for outcome, what in release.texts() if outcome == "WRONG"]
        assert name in wrong, wrong
        (tmp_path / name).write_text(text)


def test_files_of_a_release(packaging, tmp_path, monkeypatch):
    """Other bytes in a second build are wrong, and what differs is named; so is a licence that is missing."""
    import release

    version = release.project()["version"]
    (tmp_path / "source").write_bytes(b"source")
    for folder, content in (("one", b"1"), ("two", b"2")):
        (tmp_path / folder).mkdir()
        with zipfile.ZipFile(tmp_path / folder / f"dondolo-{version}-windows.zip", "w") as archive:
            archive.writestr(f"dondolo-{version}/bin/dondolo.exe", content)
        with tarfile.open(tmp_path / folder / f"dondolo-{version}.tar", "w") as archive:
            archive.add(tmp_path / "source", f"dondolo-{version}/LICENSE")
        (tmp_path / folder / f"dondolo-{version}.tar").rename(tmp_path / folder / f"dondolo-{version}.tar.gz")
    said = list(release.files(tmp_path / "one", tmp_path / "two"))
    wrong = [what for outcome, what in said if outcome == "WRONG"]
    assert f"dondolo-{version}-windows.zip: other bytes in a second build (dondolo-{version}/bin/dondolo.exe)" in wrong
    assert f"dondolo-{version}-windows.zip: lacks licences/LGPL-2.1.txt" in wrong
    assert f"dondolo-{version}.tar.gz: lacks packaging/licenses/LAPACK.txt" in wrong
    assert {"there is no wheel for Linux", "there is no wheel for Windows"} <= set(wrong)
    assert [what.partition(",")[0] for outcome, what in said if outcome == "same"] == [f"dondolo-{version}.tar.gz"]


def test_a_release_is_of_a_commit(root, tmp_path):
    """With changes that are not committed nothing is built."""
    (tmp_path / "packaging").mkdir()
    for name in ("release.sh", "steps.sh"):
        shutil.copy(root / "packaging" / name, tmp_path / "packaging")
    subprocess.run(["git", "init", "-q"], cwd=tmp_path, check=True)
    run = subprocess.run(["bash", tmp_path / "packaging/release.sh"], capture_output=True, text=True, check=False)
    assert run.returncode == 1
    assert run.stderr == "release: these are not committed: packaging/\n"
    for words in ((), ("--now",)):
        run = subprocess.run([root / "run", "release", *words], capture_output=True, text=True, check=False)
        assert run.returncode == 2
        assert "only a person publishes" in run.stderr


def compare(root, *words):
    """What test/same_results.py says."""
    command = [sys.executable, root / "test/same_results.py", *words]
    return subprocess.run(command, capture_output=True, text=True, check=False)


@pytest.mark.slow
def test_results_of_two_systems(root, executable, tmp_path):
    """An EDP that differs is a fault, unless both programs call its row ill-conditioned and repeat it."""
    for folder in ("ours", "theirs"):
        (tmp_path / folder).mkdir()
        subprocess.run([executable, "--quiet", root / "data/cases/compound.nml"], cwd=tmp_path / folder, check=True)
    folders = (tmp_path / "ours/out", tmp_path / "theirs/out")
    again = ("--again", f"'{executable}'", f"'{executable}'")
    same = compare(root, *folders)
    assert same.returncode == 0, same.stdout
    assert "0 ill-conditioned rows differ more" in same.stdout
    table = folders[1] / "compound_histories.csv"
    lines = table.read_text().splitlines()
    start = next(i for i, line in enumerate(lines) if not line.startswith("#"))
    edp = lines[start].split(",").index("edp")
    # A well-conditioned row, and one that no program repeats
    for number in range(start + 1, len(lines)):
        cells = lines[number].split(",")
        if not 0.01 < float(cells[edp]) < 0.9:
            continue
        cells[edp] = f"{float(cells[edp]) + 2e-5}"
        table.write_text("\n".join([*lines[:number], ",".join(cells), *lines[number + 1 :]]) + "\n")
        break
    differs = compare(root, *folders, *again)
    assert differs.returncode == 1
    assert f"compound_histories.csv: row {number - start}, edp: " in differs.stdout


@pytest.mark.slow
def test_ill_conditioned_rows_of_two_build_variants(root, executable, tmp_path):
    """Build variants differ in the last bits: where that is magnified, both programs say so, and the row is named."""
    listed = subprocess.run([executable, "--version"], capture_output=True, text=True, check=True).stdout
    if "build variant baseline" in listed:
        pytest.skip("this processor has one build variant")
    environment = os.environ | {"DONDOLO_VARIANT": "baseline"}
    for folder, variables in (("ours", os.environ), ("theirs", environment)):
        (tmp_path / folder).mkdir()
        command = [executable, "--quiet", root / "data/cases/compound.nml"]
        subprocess.run(command, cwd=tmp_path / folder, env=variables, check=True)
    folders = (tmp_path / "ours/out", tmp_path / "theirs/out")
    alone = compare(root, *folders)
    again = compare(root, *folders, "--again", f"'{executable}'", f"env DONDOLO_VARIANT=baseline '{executable}'")
    assert again.returncode == 0, again.stdout
    # A row that is beyond the bounds is explained, or there is none.
    beyond = alone.stdout.count("compound_histories.csv: row ")
    assert again.stdout.count("is ill-conditioned by either program") == beyond
    assert alone.returncode == (beyond > 0)
