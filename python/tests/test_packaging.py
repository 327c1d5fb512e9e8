"""Installation and the verbs of ./run: editable wheels, licences, and a small form for each verb."""

import base64
import hashlib
import importlib.util
import json
import os
import re
import shutil
import subprocess
import sys
import threading
import tomllib
import zipfile
from pathlib import Path

import pytest

from dondolo._fortran import _core


@pytest.fixture(scope="session")
def backend(root):
    """The build backend."""
    pytest.importorskip("mesonpy")
    spec = importlib.util.spec_from_file_location("backend", root / "packaging/backend.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.fixture
def wheel(tmp_path):
    """A wheel with a package, an extension module, a program and a data file."""
    members = {
        "dondolo/__init__.py": b"pass\n",
        "dondolo/_fortran/_core.cpython-311-x86_64-linux-gnu.so": b"new",
        "dondolo-1.data/scripts/dondolo": b"program",
        "dondolo-1.data/data/share/dondolo/records/synthetic44.csv": b"file\n",
        "dondolo-1.dist-info/METADATA": b"Name: dondolo\nVersion: 1\n",
    }
    path = tmp_path / "dondolo-1-cp311-cp311-linux_x86_64.whl"
    with zipfile.ZipFile(path, "w") as file:
        for name, content in members.items():
            info = zipfile.ZipInfo(name)
            info.external_attr = (0o755 if "scripts" in name else 0o644) << 16
            file.writestr(info, content)
        lines = "".join(f"{name},sha256=0,{len(content)}\n" for name, content in members.items())
        file.writestr("dondolo-1.dist-info/RECORD", f"{lines}dondolo-1.dist-info/RECORD,,\n")
    return path


def test_an_editable_wheel_has_all_but_the_package(backend, wheel, tmp_path):
    """The program and the data, the path of the sources, and the extension module beside the sources."""
    sources = tmp_path / "sources"
    core = sources / "dondolo/_fortran/_core.cpython-311-x86_64-linux-gnu.so"
    core.parent.mkdir(parents=True)
    core.write_bytes(b"old")
    loaded = core.open("rb")
    editable = tmp_path / "editable.whl"
    backend.make_editable(wheel, editable, sources)
    assert core.read_bytes() == b"new"
    # A process that has it open keeps the old one.
    assert loaded.read() == b"old"
    loaded.close()
    with zipfile.ZipFile(editable) as file:
        names = file.namelist()
        assert set(names) == {
            "dondolo_editable.pth",
            "dondolo-1.data/scripts/dondolo",
            "dondolo-1.data/data/share/dondolo/records/synthetic44.csv",
            "dondolo-1.dist-info/METADATA",
            "dondolo-1.dist-info/RECORD",
        }
        path = file.read("dondolo_editable.pth")
        assert path.decode().strip() == str(sources)
        assert file.getinfo("dondolo-1.data/scripts/dondolo").external_attr >> 16 & 0o111
        record = file.read("dondolo-1.dist-info/RECORD").decode().splitlines()
    assert {line.split(",")[0] for line in record} == set(names)
    digest = base64.urlsafe_b64encode(hashlib.sha256(path).digest()).rstrip(b"=").decode()
    assert f"dondolo_editable.pth,sha256={digest},{len(path)}" in record


def test_an_editable_build_keeps_its_folder(backend, wheel, tmp_path, monkeypatch):
    """It is built where the next one finds it, not in the folder that fpm empties, or where the user says."""
    monkeypatch.setattr(backend, "SOURCES", tmp_path / "sources")
    (tmp_path / "sources/dondolo/_fortran").mkdir(parents=True)
    asked = []

    def build(folder, settings, metadata):
        asked.append(settings["build-dir"])
        (backend.Path(folder) / wheel.name).write_bytes(wheel.read_bytes())
        return wheel.name

    monkeypatch.setattr(backend, "build_wheel", build)
    made = tmp_path / "made"
    made.mkdir()
    assert backend.build_editable(str(made)) == wheel.name
    assert backend.build_editable(str(made), {"build-dir": "mine"}) == wheel.name
    assert (made / wheel.name).is_file()
    assert asked == [f"build-editable/{sys.implementation.cache_tag}", "mine"]


def test_the_licences_of_bundled_libraries_go_along(root):
    """pyproject.toml names their texts, and README.txt every text."""
    patterns = tomllib.loads((root / "pyproject.toml").read_text())["project"]["license-files"]
    found = {path.name for pattern in patterns for path in root.glob(pattern)}
    texts = {
        "GPL-3.0.txt": "Version 3, 29 June 2007",
        "GCC-exception-3.1.txt": "GCC RUNTIME LIBRARY EXCEPTION",
        "LGPL-2.1.txt": "Version 2.1, February 1999",
        "LAPACK.txt": "The University of Tennessee",
    }
    assert found == {"LICENSE", "README.txt", *texts}
    overview = (root / "packaging/licenses/README.txt").read_text()
    for name, words in texts.items():
        assert words in (root / "packaging/licenses" / name).read_text()
        assert name in overview


def verbs(root):
    """Verbs that ./run help lists."""
    text = subprocess.run([root / "run", "help"], capture_output=True, text=True, check=True).stdout
    return set(re.findall(r"^  (\w+)", text, re.M))


def small_forms(root):
    """The verbs of ./run verbs with their words, in their order."""
    script = (root / "test/verbs.sh").read_text()
    lists = re.search(r"^by_fpm=\((.*?)\)\nothers=\((.*?)\)$", script, re.M | re.S)
    return re.findall(r"'([^']+)'", lists[1] + lists[2])


def test_every_verb_has_a_small_form(root):
    """./run verbs and the weekly workflow leave none out, so that none stops working unnoticed."""
    # What CI runs besides, and the verbs that run others
    elsewhere = {"setup", "build", "demo", "test", "fresh", "verbs", "release", "help"}
    names = [form.split()[0] for form in small_forms(root)]
    assert sorted(names) == sorted(verbs(root) - elsewhere)
    weekly = {form.split()[0] for form in turn(root, "all")}
    nightly = set(re.findall(r"^      - run: ./run (\w+)", (root / ".github/workflows/windows.yml").read_text(), re.M))
    assert verbs(root) - elsewhere <= weekly | nightly
    assert "./run release --check" in (root / ".github/workflows/release.yml").read_text()


def turn(root, day):
    """The verbs that a night runs in full."""
    run = subprocess.run(["bash", root / "test/turn.sh", day], capture_output=True, text=True, check=True)
    return json.loads(run.stdout)


def test_nights_take_turns(root):
    """Each verb has one night of the week, of known days only, and a release waits for all of them."""
    nights = [form for day in "1234567" for form in turn(root, day)]
    assert sorted(nights) == sorted(set(nights)) == sorted(turn(root, "all"))
    assert set(turn(root, "today")) < set(nights)
    assert subprocess.run(["bash", root / "test/turn.sh", "8"], capture_output=True, check=False).returncode == 2
    release = (root / ".github/workflows/release.yml").read_text()
    assert "uses: ./.github/workflows/verbs.yml" in release
    assert re.search(r"^    needs: \[.*\bverbs\b.*\]$", release, re.M)


def test_a_commit_runs_the_same_verbs_anywhere(root, tmp_path):
    """What a pull request must pass depends neither on the clock nor on the history that a clone has."""
    (always,) = re.findall(r"^\./run verbs (.*?) \|\|", (root / ".ci/run").read_text(), re.M)
    assert set(always.split()) == {"windows", "page"}
    # The others that a change must pass are jobs of their own
    jobs = (root / ".github/workflows/tests.yml").read_text()
    assert all(f"- run: ./run {verb}" in jobs for verb in ("oldest", "docs", "wheel", *always.split()))
    for path in ("test", "bin"):
        (tmp_path / path).mkdir()
    shutil.copy(root / "test/verbs.sh", tmp_path / "test")
    (tmp_path / "run").write_text("#!/bin/sh\n")
    (tmp_path / "run").chmod(0o755)
    ran = []
    for commits in (1, 7, 1000):
        # Of a machine with this number of commits
        (tmp_path / "bin/git").write_text(f"#!/bin/sh\nif [ $1 = rev-list ]; then echo {commits}; fi\n")
        (tmp_path / "bin/git").chmod(0o755)
        environment = os.environ | {"PATH": f"{tmp_path / 'bin'}:{os.environ['PATH']}"}
        command = ["bash", tmp_path / "test/verbs.sh", *always.split()]
        run = subprocess.run(command, capture_output=True, text=True, check=True, env=environment)
        ran.append([line.split("  ")[0] for line in run.stdout.splitlines() if " passed " in line])
    assert ran[0] == ran[1] == ran[2]
    # Those that this machine lacks something for are skipped.
    wanted = [form for form in small_forms(root) if form.split()[0] in always.split()]
    assert set(wanted) - set(ran[0]) <= {"windows --quick", "oldest --quick"}


def test_fresh_says_what_it_lacks(root, tmp_path):
    """It fails in one line where no fresh Debian can be made, and does not pass in silence."""
    for name in ("id", "dirname", "bash"):
        (tmp_path / name).symlink_to(shutil.which(name))
    run = subprocess.run(
        ["bash", root / "test/fresh.sh", "demo"],
        capture_output=True,
        text=True,
        check=False,
        env={"PATH": str(tmp_path), "HOME": str(tmp_path)},
    )
    assert run.returncode == 1
    assert re.fullmatch(r"a fresh Debian needs (root|debootstrap: apt-get install debootstrap)\n", run.stderr)


def test_wheels_are_installed_by_their_file_names(root):
    """No page tells to install what a server calls dondolo."""
    texts = [root / "README.md", root / "CONTRIBUTING.md", *root.glob("docs/**/*.md"), *root.glob("packaging/*.*")]
    for path in texts:
        for line in path.read_text().splitlines():
            if "pip install" in line and "never `pip install dondolo`" not in line:
                assert not re.search(r"pip install\b(?!.*(\.whl|--no-index)).*[\s'\"]dondolo([\s\['\"]|$)", line), (
                    path,
                    line,
                )


def test_metadata_need_no_compiler(backend, tmp_path):
    """Pip asks for them before it builds; they are those of the wheel, with the licences of what is inside."""
    for settings, inside in (({}, False), ({"setup-args": "-Dstandalone=true"}, True)):
        made = tmp_path / str(inside)
        made.mkdir()
        name = backend.prepare_metadata_for_build_wheel(str(made), settings)
        text = (made / name / "METADATA").read_text()
        licence = re.search(r"^License-Expression: (.*)$", text, re.M)[1]
        assert licence == ("MIT AND " + backend.LICENCES_INSIDE if inside else "MIT")
        for path in re.findall(r"^License-File: (.*)$", text, re.M):
            assert (made / name / "licenses" / path).is_file()
        assert {path.name for path in (made / name).iterdir()} == {"METADATA", "licenses"}


def test_a_build_tells_the_time(backend, capsys):
    """From time to time while it lasts, however long one source is compiled, and no more when it has ended."""
    before = threading.active_count()
    with backend.telling_the_time(every=0.01):
        while "building for 0 s" not in capsys.readouterr().out:
            pass
    assert threading.active_count() == before


def test_a_wheel_for_others_names_the_licences_inside(backend, wheel, tmp_path, monkeypatch):
    """Whether its metadata were asked for or not; the record of the wheel follows."""

    def build(folder, settings, metadata):
        (backend.Path(folder) / wheel.name).write_bytes(wheel.read_bytes())
        return wheel.name

    monkeypatch.setattr(backend.mesonpy, "build_wheel", build)
    monkeypatch.delenv("CIBUILDWHEEL", raising=False)
    for settings in ({}, {"setup-args": ["-Dnative=false", "-Dstandalone=true"]}):
        backend.build_wheel(str(tmp_path), settings)
        with zipfile.ZipFile(tmp_path / wheel.name) as file:
            text = file.read("dondolo-1.dist-info/METADATA")
            record = file.read("dondolo-1.dist-info/RECORD").decode()
            assert file.testzip() is None
        assert (b"LGPL-2.1-or-later" in text) == bool(settings)
        digest = base64.urlsafe_b64encode(hashlib.sha256(text).digest()).rstrip(b"=").decode()
        assert (f"dondolo-1.dist-info/METADATA,sha256={digest},{len(text)}\n" in record) == bool(settings)


def test_workflows_are_pinned_and_may_only_read(root):
    """Every action by its commit, and no right to write but where a job says why."""
    for path in (root / ".github/workflows").glob("*.yml"):
        text = path.read_text()
        for used in re.findall(r"uses: (\S+)", text):
            assert used.startswith("./") or re.fullmatch(r"[\w/-]+@[0-9a-f]{40}", used), (path.name, used)
        assert re.search(r"^permissions:(\n  contents: read| \{\})$", text, re.M), path.name


def test_lines_of_the_page(root):
    """At most 120 columns, texts too, which no formatter breaks; the table of the site is one line by design."""
    paths = [*(root / "python/dondolo/serve/page").glob("*.js"), root / "docs/site/static/curve.js"]
    assert len(paths) > 7
    for path in paths:
        for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
            assert len(line) <= 120, f"{path.name}:{number}"


def test_recipes_get_the_checksum_of_a_release(root, tmp_path):
    """That of the sdist, in both recipes; another version is refused."""
    version = tomllib.loads((root / "pyproject.toml").read_text())["project"]["version"]
    script = root / "packaging/recipes.py"
    for name, status in ((f"dondolo-{version}.tar.gz", 0), ("dondolo-9.9.tar.gz", 1)):
        (tmp_path / name).write_bytes(b"sources")
        run = subprocess.run([sys.executable, script, tmp_path / name, tmp_path], capture_output=True, check=False)
        assert run.returncode == status
    checksum = hashlib.sha256(b"sources").hexdigest()
    for name in ("conda-forge-recipe.yaml", "spack-package.py"):
        assert checksum in (tmp_path / name).read_text()


def test_an_unknown_verb_is_refused(root):
    """In one line, by ./run verbs too, before anything runs."""
    run = subprocess.run(["bash", root / "test/verbs.sh", "wheels"], capture_output=True, text=True, check=False)
    assert run.returncode == 2
    begin, listed = run.stderr.split("; there are: ")
    assert begin == "verbs: there is no small form of 'wheels'"
    assert {"stress", "attack", "wheel", "docs"} <= set(listed.split())
    assert run.stderr.count("\n") == 1


def test_a_step_shows_its_output_only_if_it_fails(root):
    """What failed and why is the last line, after what it printed: the first error, or else the last line."""

    def step(command):
        script = f". {root}/packaging/steps.sh; step 'doing this' bash -c '{command}'"
        return subprocess.run(["bash", "-c", script], capture_output=True, text=True, check=False)

    passed, failed = step("echo much"), step("echo why; exit 3")
    assert (passed.returncode, passed.stdout, passed.stderr) == (0, "", "doing this\n")
    assert (failed.returncode, failed.stderr) == (3, "doing this\nwhy\nfailed: doing this: why\n")
    compiler = step("echo start; echo Error: no such symbol >&2; echo hint: see above; exit 1")
    assert compiler.stderr.splitlines()[-1] == "failed: doing this: Error: no such symbol"


def test_no_result_hangs_on_functions_of_vectors(executable):
    """Those of glibc have other last digits than its functions of scalars, and others by its version."""
    for file in (executable, _core.__file__):
        names = Path(file).read_bytes()
        assert b"\0sincos\0" in names
        assert b"_ZGV" not in names
