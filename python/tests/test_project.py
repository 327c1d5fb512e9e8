"""What holds the project together: lists and versions in step, the boundary's kinds, costs of import and call."""

import ast
import dataclasses
import functools
import importlib
import importlib.util
import inspect
import json
import pkgutil
import pydoc
import re
import subprocess
import sys
import tomllib
import tracemalloc
import warnings
from pathlib import Path

import numpy as np
import pytest
from costs import calls
from public import public_things

import dondolo as dd
from dondolo._fortran import _core
from dondolo._fortran.library import properties


def test_versions(root):
    fpm = tomllib.loads((root / "fpm.toml").read_text())["version"]
    python = tomllib.loads((root / "pyproject.toml").read_text())["project"]["version"]
    meson = re.search(r"version: '([^']+)'", (root / "meson.build").read_text()).group(1)
    citation = re.search(r"^version: (.+)$", (root / "CITATION.cff").read_text(), re.M).group(1)
    zenodo = json.loads((root / ".zenodo.json").read_text())["version"]
    assert dd.__version__ == fpm == python == meson == citation == zenodo


def test_fortran_sources(root):
    text = (root / "src/meson.build").read_text()
    *layers, gauge, app = (
        re.findall(r"'([^']+)'", re.search(rf"^{name} = files\((.*?)\)", text, re.S | re.M).group(1))
        for name in ("vector_sources", "common_sources", "lane_sources", "sources", "gauge_sources", "app_sources")
    )
    there = [file for suffix in ("c", "f90", "F90") for file in root.glob(f"src/**/*.{suffix}")]
    # What is compiled a second time in quadruple precision, and the one source that only is
    folder = "core/motion/quadruple"
    again = re.findall(r"^  '([^']+)',$", (root / f"src/{folder}/meson.build").read_text(), re.M)
    own = [f"core/{name}" for name in again if f"core/{name}".startswith(folder)]
    assert len(own) == 1
    # What meson puts the commit into
    own += re.findall(r"input: '([^']+\.c)'", text)
    assert len(own) == 2
    assert {f"core/{name}" for name in again} - set(own) <= {*layers[0], *layers[1]}
    listed = [name for layer in layers for name in layer] + own
    assert sorted(listed) == sorted(str(file.relative_to(root / "src")) for file in there)
    other_programs = {
        f"../app/{program['main']}"
        for program in tomllib.loads((root / "fpm.toml").read_text()).get("executable", [])
        if program["name"] != "dondolo"
    }
    assert {*gauge, *app} == {f"../app/{file.name}" for file in root.glob("app/*.f90")} - other_programs


#: Rooms of the two halves of the library, in their order
CORE = ["base", "record", "building", "wall", "motion", "fragility", "check"]
STUDY = ["files", "records", "population", "case", "interface"]


def rooms_of(*folders):
    """The rooms in folders: {file: room} and {module: room}."""
    files = {path: path.relative_to(folder).parts[0] for folder in folders for path in folder.glob("**/*.[fF]90")}
    homes = {
        name: room for path, room in files.items() for name in re.findall(r"^module (\w+)", path.read_text(), re.M)
    }
    return files, homes


@pytest.mark.parametrize(
    ("folders", "rooms"),
    [
        (["core", "study"], CORE + STUDY),
        (["core/base"], ["numerics", "text", "properties", "system"]),
        (["study/case"], ["namelist", "groups", "warnings", "input", "results", "tasks"]),
    ],
)
def test_rooms(root, folders, rooms):
    """Each room of the library knows only those before it."""
    files, homes = rooms_of(*(root / "src" / folder for folder in folders))
    assert set(files.values()) == set(rooms)
    for path, room in files.items():
        for name in re.findall(r"^\s+use (dondolo_\w+)", path.read_text(), re.M):
            # The build variants of a module are at home where it is.
            known = homes.get(re.sub("_(avx2|avx512)$", "", name))
            assert known or len(folders) == 1, f"{path.name} uses {name}"
            assert known is None or rooms.index(known) <= rooms.index(room), f"{path.name} uses {name}"


def test_modules_are_named_after_their_rooms(root):
    """As room and file, said once: base/text/error.f90 is dondolo_base_error."""
    folder = root / "src"
    for path in folder.glob("*/**/*.[fF]90"):
        room = path.relative_to(folder).parts[1]
        name = path.stem if re.match(rf"{room}(_|$)", path.stem) else f"{room}_{path.stem}"
        assert re.findall(r"^module (\w+)", path.read_text(), re.M) == [f"dondolo_{name}"]


def test_rooms_of_motion(root):
    """The engines share a common room and do not know each other."""
    folder = root / "src/core/motion"
    home = {}
    for path in folder.glob("**/*.[fF]90"):
        room = path.relative_to(folder).parts[0] if path.parent != folder else ""
        home |= dict.fromkeys(re.findall(r"^module (\w+)", path.read_text(), re.M), (room, path))
    assert {room for room, _ in home.values()} == {"common", "rk45", "lanes", "quadruple", ""}
    known = {
        "common": {"common"},
        "rk45": {"common", "rk45"},
        "lanes": {"common", "lanes"},
        "quadruple": {"common", "rk45", "quadruple"},
    }
    for room, path in home.values():
        for name in re.findall(r"^\s+use (dondolo_\w+)", path.read_text(), re.M):
            if room and name in home:
                assert home[name][0] in known[room], f"{path.name} uses {name}"


def files_needed(folder, module):
    """The sources that a module is compiled from, its own and those of all it uses."""
    sources = {path.stem: path for path in folder.rglob("*.[fF]90")}
    homes = {re.search(r"^module (\w+)", path.read_text(), re.M).group(1): path for path in sources.values()}
    needed, todo = set(), [homes[module]]
    while todo:
        path = todo.pop()
        if path not in needed:
            needed.add(path)
            names = re.findall(r"^\s+use (dondolo_\w+)", path.read_text(), re.M)
            todo += [homes[name] for name in (re.sub("_(avx2|avx512)$", "", name) for name in names) if name in homes]
    return needed


@pytest.mark.parametrize(
    ("module", "most"), [("dondolo_motion_rk45", 47), ("dondolo_fragility_stripes", 89), ("dondolo_core", 144)]
)
def test_few_files_have_to_be_read(root, module, most):
    """To understand the engine, or a study, one reads no more than these, and none of them opens a file."""
    needed = files_needed(root / "src", module)
    assert len(needed) <= most
    assert {path.relative_to(root / "src").parts[0] for path in needed} <= {"core", "dondolo_core.f90"}


def test_the_core_computes(root):
    """It opens, reads and prints nothing, and knows no namelist, no format of files and nothing of the other half."""
    sources = [*(root / "src/core").rglob("*.[fF]90")]
    assert len(sources) > 130
    talks = re.compile(
        r"^\s*(if \(.*\) )?((open|inquire|rewind|close) ?\(|namelist ?/|(print|stop)\b|read ?\(\w*unit|write ?\(\*)",
        re.M,
    )
    homes = rooms_of(root / "src/core")[1]
    for path in sources:
        text = path.read_text()
        assert talks.search(text) is None, f"{path.name}: {talks.search(text)[0].strip()}"
        used = {re.sub("_(avx2|avx512)$", "", name) for name in re.findall(r"^\s+use (dondolo_\w+)", text, re.M)}
        assert used <= set(homes), f"{path.name} uses {used - set(homes)}"


def test_quadruple_sources(root):
    """Every module that depends on the precision is compiled a second time if one that is uses it."""
    text = (root / "src/core/motion/quadruple/meson.build").read_text()
    listed = re.search(r"quadruple_sources = \[(.*?)\]", text, re.S).group(1)
    stems = {Path(name).stem for name in re.findall(r"'([^']+)'", listed)}
    twice, uses = set(), {}
    for path in root.glob("src/**/*.[fF]90"):
        text = path.read_text()
        name = re.search(r"^module (\w+)", text, re.M).group(1)
        uses[name] = set(re.findall(r"^\s+use (dondolo_\w+)", text, re.M))
        if path.stem in stems:
            twice.add(name)
    needed = set().union(*(uses[name] for name in twice))
    assert len(twice) > 40
    assert {name for name in needed - twice if "dondolo_base_kinds" in uses[name]} == set()


def boundary(root):
    """The sources that f2py reads."""
    listed = re.search(r"modules = files\((.*?)\)", (root / "python/meson.build").read_text(), re.S).group(1)
    return [root / "python" / name for name in re.findall(r"'([^']+)'", listed)]


def imported_in_vain(path):
    """Names that a Fortran source imports and does not use; conditional lines of OpenMP and includes count."""
    text = path.read_text()
    text += "".join((path.parent / name).read_text() for name in set(re.findall(r'(?m)^#include "(.+)"', text)))
    text = re.sub(r"&\s*\n\s*&?", " ", re.sub(r"(?m)(^|(?<=\s))!(?!\$).*$", "", text)).lower()
    imports = re.findall(r"(?m)^ *use\b.*?\bonly *: *(.*)", text)
    names = {item.split("=>")[0].strip() for one in imports for item in one.split(",") if "(" not in item}
    # Kinds stand behind an underscore, as in 1.0_wp
    used = re.findall(r"(?<![a-z])[a-z]\w*|(?<=\d_)[a-z]\w*", re.sub(r"(?m)^ *use\b.*", "", text))
    return names - set(used)


def test_fortran_imports(root):
    places = ("src/**/*.[fF]90", "src/**/*.inc", "app/*.f90", "python/dondolo/_fortran/*.f90", "test/**/*.[fF]90")
    paths = [path for place in places for path in root.glob(place)]
    assert len(paths) > 200
    assert {path.name: names for path in paths if (names := imported_in_vain(path))} == {}


def test_argument_lists(root):
    """Not more than eight arguments, wherever the boundary of f2py does not ask for them."""
    counts = {}
    modules = set(root.glob("python/dondolo/_fortran/*.f90")) - set(boundary(root))
    for path in [*root.glob("src/**/*.[fF]90"), *root.glob("app/*.f90"), *modules]:
        text = re.sub(r"&\s*&", "", path.read_text())
        for name, arguments in re.findall(r"^ *(?!end)[\w ()=]*(?:subroutine|function) (\w+)\(([^)]*)\)", text, re.M):
            counts[path.name, name] = len(arguments.split(","))
    assert len(counts) > 500
    assert {name: count for name, count in counts.items() if count > 8} == {}


def test_python_sources(root):
    text = (root / "python/meson.build").read_text()
    listed = set(re.findall(r"'(dondolo/[^']+)'", re.search(r"py\.install_sources\(\[(.*?)\]", text, re.S).group(1)))
    package = root / "python/dondolo"
    data = [
        file for suffix in ("py", "pyi", "css", "html", "js", "svg", "typed") for file in package.glob(f"**/*.{suffix}")
    ]
    there = {f"dondolo/{file.relative_to(package)}" for file in data}
    assert listed == there


def test_python_rooms(root):
    """Each room of the package imports only itself and those before it, for its types too."""
    rooms = [
        "errors", "_base", "_fortran", "_storage", "figures", "records", "walls", "hazard", "curves", "analysis",
        "checks", "populations", "retrofit", "exchange", "reporting", "results", "__init__",
        "serve", "__main__",
    ]  # fmt: skip
    package = root / "python/dondolo"

    seen = set()
    for path in package.glob("**/*.py"):
        here = path.relative_to(package).parts[0].removesuffix(".py")
        seen.add(here)
        for node in ast.walk(ast.parse(path.read_text())):
            if isinstance(node, ast.ImportFrom):
                assert node.level == 0, f"{path.name}: relative import"
                names = [f"{node.module}.{alias.name}" for alias in node.names]
            else:
                names = [alias.name for alias in node.names] if isinstance(node, ast.Import) else []
            for name in names:
                if name.split(".")[0] == "dondolo":
                    there = f"{name}.__init__".split(".")[1]
                    assert there in rooms, f"{path.name} imports {name}"
                    assert rooms.index(there) <= rooms.index(here), f"{path.name} imports {name}"
    assert seen == set(rooms)


def test_files_are_opened_by_c(root):
    """The names of files that Fortran itself opens would be in a code page on Windows."""
    ours = {"machine.f90", "synthetic44.f90"}  # files of Linux, and a program of this repository
    by_name = re.compile(r"^ *(if .*\) )?(open|inquire) ?\(.*file=", re.MULTILINE)
    sources = [path for folder in ("app", "src", "python/dondolo") for path in (root / folder).rglob("*.f90")]
    assert {path.name for path in sources if by_name.search(path.read_text())} == ours


def test_texts_have_the_line_ends_of_their_checksums(root):
    """Python would write other bytes on Windows than those whose checksum a catalogue states."""
    sources = "".join(path.read_text() for path in (root / "python/dondolo").rglob("*.py"))
    calls = re.findall(r"^ *part\.write_text\(.*$", sources, re.MULTILINE)
    assert len(calls) >= 4
    assert [call for call in calls if not call.endswith('newline="\\n")')] == []


def test_rooms_are_documented(root):
    """The map of the sources names every room."""
    page = (root / "docs/developing/architecture.md").read_text()
    folders = [path for path in root.glob("src/*/*") if path.is_dir()]
    folders += [path for path in root.glob("src/*/*/*") if path.is_dir()]
    folders += [path for path in root.glob("python/dondolo/*") if path.is_dir() and not path.name.startswith("__")]
    assert len(folders) > 25
    assert [path.name for path in folders if f"`{path.name}`" not in page] == []


# On Windows the module os has less.
@pytest.mark.parametrize("platform", ["linux", "win32"])
def test_types(root, platform):
    """Every annotation holds: mypy in its strict mode."""
    pytest.importorskip("mypy", reason="mypy is not installed")
    command = [sys.executable, "-m", "mypy", "--config-file", root / "pyproject.toml", "--platform", platform]
    done = subprocess.run(command, cwd=root, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr


def test_formats_are_documented(root, tmp_path):
    """The page lists the formats that the library names where it is asked for another."""
    with pytest.raises(dd.errors.InputError, match="must be one of") as error:
        dd.read_record(tmp_path / "none.txt", format="none")
    known = re.findall(r"'(\w+)'", str(error.value).split("must be one of")[1])
    page = (root / "docs/ground_motions.md").read_text()
    table = page[page.index("| format | files |") :].split("\n\n")[0]
    documented = re.findall(r"(?m)^\| `(\w+)` \|", table)
    assert len(known) == 15
    assert sorted(known) == sorted(documented)


def test_no_single_precision_at_the_boundary():
    modules = [getattr(_core, name) for name in dir(_core) if not name.startswith("_")]
    procedures = {name: getattr(module, name) for module in modules for name in dir(module) if not name.startswith("_")}
    assert len(procedures) > 40
    for name, procedure in procedures.items():
        text = procedure.__doc__
        assert "Wrapper for" in text, name
        assert "array('f')" not in text, name
        assert not re.search(r": .*\bfloat32\b", text), name


def test_integers_at_the_boundary_are_as_long_on_windows(root):
    """Of these kinds f2py makes a long of C, which has 32 bits there: addresses would be cut."""
    for source in (root / "python/dondolo/_fortran").glob("*.f90"):
        text = source.read_text(encoding="utf-8")
        assert not re.search(r"integer\(c_(long|intptr_t|intmax_t|size_t)\), *intent", text), source.name


def looked_up(text):
    """Names that a Fortran source asks settings for, or sets in them; records have metadata, whose keys may be any."""
    text = re.sub(r"&\s*\n\s*&?", " ", re.sub(r"(?m)^\s*!.*\n", "", text))
    calls = r"(\w+)%(?:number|holds|word|list|has|has_word|has_list|clear|set)\( *'([^']*)'"
    return {name for of, name in re.findall(calls, text) if of != "metadata"}


def test_look_ups_of_settings(root):
    """A name that no table has would be 0 in silence."""
    example = "x = settings%number('thicknes')\ncall input%set( &\n   & 'heigth', y)\n"
    assert looked_up(example) == {"thicknes", "heigth"}
    with pytest.raises(dd.errors.InputError, match="must be one of") as refused:
        properties("no group")
    groups = re.findall(r"'(\w+)'", str(refused.value).split("must be one of")[1])
    known = {row.name for group in groups for row in properties(group)}
    files = [file for folder in ("src", "app", "python/dondolo") for file in root.glob(f"{folder}/**/*.[fF]90")]
    found = {name: file.name for file in files for name in looked_up(file.read_text())}
    assert len(found) > 80
    assert {name: file for name, file in found.items() if name not in known} == {}


def quantities_of(text):
    """Names of quantities that a Fortran source puts into sheets of checks, or asks them for."""
    text = re.sub(r"&\s*\n\s*&?", " ", re.sub(r"(?m)^\s*!.*\n", "", text))
    three = re.findall(r"%(?:add|value|bound)\(\s*(?:'\w*'|[\w()]+),\s*(?:'\w*'|[\w()]+),\s*'(\w+)'", text)
    two = re.findall(r"%is_all_one\(\s*(?:'\w*'|[\w()]+),\s*'(\w+)'", text)
    own = re.findall(r"(?:call put|put_pulled|of_tie)\(\s*'(\w+)'", text) if "dondolo_check_sheet" in text else []
    named = re.findall(r"quantity%name [=/]= '(\w+)'", text)
    return {*three, *two, *own, *named}


def test_quantities_of_sheets(root):
    """A name that no quantity of a check has would be found nowhere, in silence."""
    example = "x = sheet%value('nonlinear', 'SLV', 'zeta')\ncall sheet%add(method, &\n & state, 'alfa_0', x)\n"
    assert quantities_of(example) == {"zeta", "alfa_0"}
    known = set(re.findall(r"quantity_type\('(\w+)'", (root / "src/core/check/check_sheet.F90").read_text()))
    files = [
        *root.glob("src/core/check/*.[fF]90"),
        *root.glob("app/*.f90"),
        *root.glob("src/study/case/*/check*.f90"),
    ]
    found = {name: file.name for file in files for name in quantities_of(file.read_text())}
    assert len(found) > 60
    assert {name: file for name, file in found.items() if name not in known} == {}


def deferred_results(text):
    """Names of the functions of a Fortran source whose results are characters of deferred length."""
    text = re.sub(r"&\s*\n\s*&?", "", re.sub(r"(?m)^\s*!.*\n", "", text))
    head = r"(?m)^ *([\w ()=:,]*?)\bfunction (\w+) *\([^)]*\)(?: *result *\((\w+)\))?.*\n"
    names = []
    for match in re.finditer(head, text):
        prefix, name, result = match.groups()
        body = text[match.end() : text.index(f"end function {name}", match.end())]
        declared = rf"(?m)^ *character *\(len=:\).*::(?: *\w+,)* *{result or name}\b"
        if "(len=:)" in prefix or re.search(declared, re.split(r"(?m)^ *contains\b", body)[0]):
            names.append(name)
    return names


def test_results_of_functions_have_specified_lengths(root):
    """Gfortran keeps the length of a result of deferred length in a static variable: texts of two threads would mix."""
    example = (
        "pure function f(x) result(y)\n real, intent(in) :: x\n character(len=:), allocatable :: z, y\nend function f\n"
    )
    assert deferred_results(example) == ["f"]
    files = [file for folder in ("src", "app", "python/dondolo") for file in root.glob(f"{folder}/**/*.[fF]90")]
    assert len(files) > 100
    found = {name for file in files for name in deferred_results(file.read_text())}
    assert found == set()


def test_no_positions_of_what_the_library_sends(root):
    """What it sends is found by its names, whatever its order there; only whole lists have none."""
    files = set(root.glob("python/dondolo/**/*.py")) - {root / "python/dondolo/_fortran/library.py"}
    by_place = re.compile(r"(?:parcel|receive\(.*\))\.(?:integers|reals|lines)\)?(?:\[|\.reshape|\.tolist)")
    assert [file.name for file in files if by_place.search(file.read_text())] == []


def test_no_submodules(root):
    """For each module that reaches one gfortran 12 writes a second file; at some of them it fails."""
    files = [file for folder in ("src", "app", "python/dondolo") for file in root.glob(f"{folder}/**/*.[fF]90")]
    assert len(files) > 100
    assert [file.name for file in files if re.search(r"(?m)^\s*submodule *\(", file.read_text())] == []


def test_procedures_that_compute_release_the_lock(root):
    """Those that compute release it; the others are as quick as the lock."""
    text = "".join(path.read_text() for path in boundary(root))
    procedures = re.split(r"(?m)^   subroutine ", text)[1:]
    free = {re.match(r"\w+", procedure)[0] for procedure in procedures if "!f2py threadsafe" in procedure}
    assert free == {
        "take_parcel", "take_series", "measure_suite", "wall_terms", "check_record", "intensities", "spectrum",
        "ground_velocity", "significant_times", "certify", "simulate", "run_block", "run_case", "run_rows",
        "run_rounded", "run_scaled", "fit_curves", "fit_logit", "probability", "row_probability", "wall_probability",
        "wall_slopes", "fit_population", "read_records",
        "floor_motion", "felt_motion", "sensitivity", "publish_set", "write_table",
    }  # fmt: skip


IMPORTS = """
import os, sys
import numpy

before, calls = set(sys.modules), 0

def note(frame, event, argument):
    global calls
    calls += event in ("call", "c_call")

def print_costs():
    sys.setprofile(None)
    files = [getattr(module, "__file__", None) or "" for name, module in sys.modules.items() if name not in before]
    print(len(files), sum(os.path.getsize(file) for file in files if file.endswith(".py")), calls)
    sys.setprofile(note)

sys.setprofile(note)
import dondolo
print_costs()
names = [getattr(of, name) for of in (dondolo, dondolo.results) for name in of.__all__]
print_costs()
heavy = ("scipy", "pandas", "matplotlib", "tqdm", "concurrent.futures")
print(*(name for name in heavy if name in sys.modules))
"""


def test_import_is_light():
    """Modules, bytes of their sources and calls of functions that the import adds to NumPy's: the same on any machine.

    A fifth more than there is now is allowed, which other versions of Python need.
    """
    run = subprocess.run([sys.executable, "-c", IMPORTS], capture_output=True, text=True, check=True)
    alone, whole, heavy = run.stdout.splitlines()
    assert heavy == ""
    for counted, bounds in ((alone, (31, 510_000, 23_000)), (whole, (305, 2_800_000, 145_000))):
        modules, size, calls = map(int, counted.split())
        assert modules <= bounds[0], counted
        assert size <= bounds[1], counted
        assert calls <= bounds[2], counted
    assert int(alone.split()[0]) > 10


def test_pulses_offer_what_is_theirs():
    assert dir(dd.pulses) == dd.pulses.__all__


def test_names_are_loaded_when_they_are_used(tmp_path):
    """Also for those that import all of them, and for a file, whose class no one has named."""
    saved = tmp_path / "curve.npz"
    dd.fit_fragility([0.2, 0.4, 0.6], [1, 5, 9], [10, 10, 10]).save(saved)
    program = (
        "import sys, dondolo as dd; early = [name for name in sys.modules if name.startswith('dondolo.analysis')]; "
        "assert early == [], early; assert dir(dd) == dd.__all__; assert not hasattr(dd, 'Wal'); "
        f"assert dd.load({str(saved)!r}).status == 'ok'; "
        "from dondolo import *; assert OneSidedWall is dd.OneSidedWall; assert pulses.ricker is dd.pulses.ricker"
    )
    subprocess.run([sys.executable, "-c", program], check=True)
    mechanisms = importlib.import_module("dondolo.walls.mechanisms")
    assert set(mechanisms.__all__) <= set(public_things())


def test_a_call_costs_little():
    """Calls of functions and memory of one history, whatever the number of samples, which are never copied.

    There are 142 calls and a few for each warning, and 4 kB are allocated; a tenth more calls are allowed. 6000 samples
    have 48 kB.
    """
    wall = dd.TwoBlockWall(3.0, 0.25, overburden=5000.0, overburden_inertia=0.0, eccentricity=0.05)
    counts, peaks = [], []
    for samples in (2, 6000):
        record = dd.Record(np.full(samples, 0.1), 0.01)
        # The first call of all keeps what later ones use.
        for _ in range(2):
            dd.simulate(wall, record, history=False)
        counts.append(calls(lambda record=record: dd.simulate(wall, record, history=False)))
        tracemalloc.start()
        try:
            before = tracemalloc.get_traced_memory()[0]
            dd.simulate(wall, record, history=False)
            peaks.append(tracemalloc.get_traced_memory()[1] - before)
        finally:
            tracemalloc.stop()
    assert 0 < min(counts) <= max(counts) < 166, counts
    assert max(peaks) < 12_000, peaks


def test_documented():
    for name, thing in public_things().items():
        if callable(thing):
            assert thing.__doc__, name
            assert not thing.__doc__.startswith(f"{name}("), name


def public_callables():
    """Functions of the API, methods of its classes, and classes that users make: their docstrings have parameters."""
    things = public_things() | {f"pulses.{name}": getattr(dd.pulses, name) for name in dd.pulses.__all__}
    for name, thing in things.items():
        if not inspect.isclass(thing):
            if callable(thing):
                yield name, thing
            continue
        if issubclass(thing, Exception):
            continue
        if re.search(r"Parameters\n +---|Parameters are those", thing.__doc__):
            yield name, thing
        for what, method in vars(thing).items():
            if not what.startswith("_") and inspect.isfunction(method):
                # As called on an object: without the object itself
                yield f"{name}.{what}", functools.partial(method, None)


def test_options_are_keywords():
    """No more than three arguments go by their place."""
    by_place = {}
    for name, thing in public_callables():
        kinds = [one.kind for one in inspect.signature(thing).parameters.values()]
        by_place[name] = sum(kind is inspect.Parameter.POSITIONAL_OR_KEYWORD for kind in kinds)
    assert len(by_place) > 100
    assert {"Record", "OneSidedWall", "Record.band_pass", "typology", "pulses.ricker"} <= set(by_place)
    assert {name: count for name, count in by_place.items() if count > 3} == {}


# What may be left out and still goes by its place: the one thing that a call is about
BY_PLACE = {
    "ag",
    "ax",
    "edp_threshold",
    "edp_thresholds",
    "f0",
    "height",
    "histories",
    "ims",
    "kind",
    "levels",
    "measure",
    "name",
    "period",
    "probabilities",
    "q",
    "scale",
    "table",
    "tc_star",
    "thickness",
    "weights",
}


def test_what_may_be_left_out_goes_by_name():
    found = {
        f"{name}: {what}"
        for name, thing in public_callables()
        for what, one in inspect.signature(thing).parameters.items()
        if one.default is not one.empty and one.kind is not one.KEYWORD_ONLY and what not in BY_PLACE
    }
    assert found == set()


def test_results_are_made_by_the_names_of_their_fields():
    """What users make has a few values by place, what analyses make none."""
    made_by_users = {
        "Body", "Building", "Chain", "Choice", "Corner", "DiscreteFragility", "DistributedSpring", "FreeStandingWall",
        "FunctionFragility", "GivenMass", "Guide", "HazardCurve", "HorizontalBending", "InertialMass", "Load",
        "Lognormal", "Normal", "OneSidedWall", "Part", "Pin", "PointLoad", "PointMass", "PointThrust", "PointTie",
        "Population", "Record", "RecordSet", "Section", "Sector", "Site", "Spring", "TabulatedWall", "TargetSpectrum",
        "Thrust", "Tie", "Triangular", "TwoBlockWall", "Uniform", "Wall",
    }  # fmt: skip
    kinds = {name: thing for name, thing in public_things().items() if dataclasses.is_dataclass(thing)}
    assert made_by_users < set(kinds)
    assert len(kinds) > 30
    for name in set(kinds) - made_by_users:
        assert all(field.kw_only for field in dataclasses.fields(kinds[name])), name


def test_no_name_hides_a_module():
    """Every module is what its path says, also after a function of its name has come into the package."""
    for module in pkgutil.walk_packages(dd.__path__, "dondolo."):
        if module.name != "dondolo.__main__":
            assert pydoc.locate(module.name) is importlib.import_module(module.name), module.name
    assert dd.pulses is importlib.import_module("dondolo.records.pulses")


@pytest.mark.parametrize(
    ("call", "words"),
    [
        (
            lambda wall, sine: dd.multiple_stripe(wall, sine, [0.1], polarity="Both"),
            "'as_recorded', 'reversed', 'both'",
        ),
        (lambda wall, sine: dd.cloud(wall, sine, polarity="Both"), "'as_recorded', 'reversed', 'both'"),
        (lambda wall, sine: dd.simulate(wall, sine, solver=dd.Solver(engine="RK45")), "'auto', 'rk45', 'lanes'"),
        (lambda wall, sine: dd.TwoBlockWall(3.0, 0.3, bearing="Outer"), "'inner', 'outer', 'centre'"),
        (
            lambda wall, sine: dd.OneSidedWall(3.0, 0.3, restitution="Constant"),
            "'default', 'sorrentino', 'impulse'",
        ),
        (lambda wall, sine: sine.correct_baseline("Linear"), "'constant', 'linear', 'velocity'"),
        (lambda wall, sine: dd.synthetic_records(6.0, 10.0, "Rock"), "'rock', 'shallow', 'deep'"),
        (lambda wall, sine: dd.Population.sample("One_Sided", 2, 1), "'one_sided', 'free_standing', 'two_block'"),
    ],
)
def test_words_of_options_are_exact(call, words, wall, sine):
    """A word in another case is refused with those that are allowed."""
    with pytest.raises(dd.errors.InputError, match=f"must be one of {words}"):
        call(wall, sine)


def test_mutations_match_the_package(root):
    """Each edit of test/mutations.py applies to exactly one place, and its test exists."""
    spec = importlib.util.spec_from_file_location("mutations", root / "test/mutations.py")
    mutations = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(mutations)
    assert mutations.stale(Path(dd.__file__).parent) == []


@pytest.mark.slow
def test_warning_filters_do_not_import_the_package(root, tmp_path):
    """Coverage starts after pytest has read its filters, and misses what was imported before."""
    (tmp_path / "early.py").write_text(
        "import sys\n\n\ndef pytest_load_initial_conftests():\n    assert 'dondolo' not in sys.modules\n"
    )
    command = [sys.executable, "-m", "pytest", "-p", "early", "-c", root / "pyproject.toml", tmp_path]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=False)
    assert done.returncode == pytest.ExitCode.NO_TESTS_COLLECTED, done.stderr


def test_defaults_are_those_of_fortran(wall, sine):
    default = dd.simulate(wall, sine, 3.0)
    said = dd.simulate(wall, sine, 3.0, solver=dd.Solver(rtol=1e-8, atol=1e-10, edp_limit=1.0))
    assert np.array_equal(default.rotation, said.rotation)


@pytest.mark.slow
def test_no_parcel_is_lost(wall, sine):
    import resource

    for _ in range(20):
        dd.simulate(wall, sine, 3.0)
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    for _ in range(3000):
        dd.simulate(wall, sine, 3.0)
        dd.OneSidedWall(3.0, 0.25)
    odd = dd.Record(1000.0 * sine.acceleration, sine.dt)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        refused = 0
        for _ in range(3000):
            try:
                dd.simulate(wall, odd, 0.003)
            except dd.errors.DondoloWarning:
                refused += 1
    assert refused == 3000
    # A history has about 50 kB; 3000 of them would be 150 MB.
    assert resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before < 20_000


@pytest.mark.parametrize("command", ["ruff check", "ruff format --check", "fortitude check"])
def test_linters(command, root):
    tool, *options = command.split()
    tool = Path(sys.executable).with_name(tool)
    if not tool.exists():
        pytest.skip(f"{tool.name} is not installed")
    run = subprocess.run([tool, *options], cwd=root, capture_output=True, text=True, check=False)
    assert run.returncode == 0, run.stdout + run.stderr


def test_limits_are_documented(root):
    """docs/files.md lists every limit with its value."""
    source = (root / "src/core/base/text/limits.f90").read_text()
    limits = {}
    for line in re.findall(r"parameter, public :: (.*)", source):
        for name, value in re.findall(r"(\w+) = ([^,]+)", line):
            limits[name] = eval(value.replace("_int64", ""))
    rows = re.findall(r"^\|.*`(\w+)` \| (\d+) \|$", (root / "docs/files.md").read_text(), flags=re.MULTILINE)
    assert {name: int(value) for name, value in rows} == limits
