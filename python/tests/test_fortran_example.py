"""The example of a Fortran program that uses dondolo, compiled with the library of the build and run."""

import csv
import re
import shutil
import subprocess

import pytest

import dondolo as dd


def compiled(root, folder, *sources, options=()):
    """A program, compiled with the library of the build; the main program is the last of its sources."""
    libraries = sorted((root / "build-python/src").glob("**/libdondolo*.a"))
    if not libraries or shutil.which("gfortran") is None:
        pytest.skip("needs gfortran and the build of ./run setup")
    modules = [f"-I{library}.p" for library in libraries]
    program = folder / sources[-1].stem
    archives = ["-Wl,--start-group", *libraries, "-Wl,--end-group"]
    subprocess.run(
        ["gfortran", "-fopenmp", *options, *modules, *sources, *archives, "-llapack", "-lblas", "-o", program],
        check=True,
        cwd=folder,
    )
    return program


@pytest.mark.slow
def test_program_with_dondolo(root, records, wall, tmp_path):
    program = compiled(root, tmp_path, root / "docs/examples/fpm/app/main.f90")
    said = subprocess.run([program, root / "data/records/synthetic44.csv"], capture_output=True, text=True, check=True)
    assert said.stdout in (root / "docs/fortran.md").read_text()
    theta, beta = map(float, re.findall(r"= *([\d.]+)", said.stdout))
    curve = dd.multiple_stripe(wall, records, levels=[0.4, 0.6, 0.8, 1.0, 1.2], progress=False).fit()
    assert (theta, beta) == (pytest.approx(curve.theta, abs=6e-4), pytest.approx(curve.beta, abs=6e-4))


@pytest.mark.slow
def test_program_of_the_page(root, records, tmp_path):
    """The motion of a wall, as docs/fortran.md shows it."""
    source = tmp_path / "one_motion.f90"
    source.write_text(re.search(r"(?s)```fortran\n(.*?)```", (root / "docs/fortran.md").read_text())[1])
    program = compiled(root, tmp_path, source)
    said = subprocess.run([program, root / "data/records/synthetic44.csv"], capture_output=True, text=True, check=True)
    response = dd.simulate(dd.OneSidedWall(1.5, 0.25), records[6], 1.5, solver=dd.Solver(rtol=1e-9), history=False)
    assert said.stdout == f"EDP = {response.edp:6.3f}, collapse: F\n"


@pytest.mark.slow
def test_program_of_the_verification(root, tmp_path):
    """The study of shortcuts, which ./run verification builds: without any it is the motion that dondolo computes."""
    folder = root / "docs/verification/shortcuts"
    names = ("straddling_step", "plain_motion", "shortcuts")
    program = compiled(root, tmp_path, *(folder / f"{name}.f90" for name in names))
    path = root / "data/cases/parapet.nml"
    said = subprocess.run([program, path], capture_output=True, text=True, check=True)
    edps = {}
    for row in csv.DictReader(said.stdout.splitlines()):
        edps.setdefault(row["shortcut"], []).append(float(row["edp"]))
    case = dd.read_case(path)
    exact = dd.multiple_stripe(case.population[0], case.records, case.levels, progress=False).edp.ravel()
    # A history next to overturning amplifies the rounding of either.
    none = edps.pop("none")
    assert none == pytest.approx(exact, abs=1e-3)
    # Under these accelerograms the wall is at rest before they end.
    assert edps.pop("nothing after the record") == none
    assert len(edps) == 9
    assert all(len(several) == exact.size and several != none for several in edps.values())


LOOK_UP = """
program look_up
   use dondolo_base_settings, only : group_settings_type, new_settings
   use dondolo_motion_solver, only : solver_properties
   implicit none

   type(group_settings_type) :: settings

   call new_settings(settings, solver_properties)
   print *, settings%number('NAME')
end program look_up
"""


@pytest.mark.slow
@pytest.mark.parametrize("name", ["rtol", "height"])
def test_a_look_up_without_a_row(root, tmp_path, name):
    """A name of another table is 0 in silence, but in what the tests are built with."""
    source = tmp_path / "look_up.f90"
    source.write_text(LOOK_UP.replace("NAME", name))
    settings = root / "src/dondolo/base/properties/settings.F90"
    program = compiled(root, tmp_path, settings, source, options=["-DDONDOLO_CHECKED"])
    done = subprocess.run([program], capture_output=True, text=True, check=False)
    refused = "there are no settings 'height'" in done.stderr
    assert (done.returncode == 0, refused) == (name == "rtol", name == "height"), done.stderr


def test_the_manifest_uses_the_repository(root):
    """The path of the dependency leads to dondolo's own manifest."""
    example = root / "docs/examples/fpm"
    path = re.search(r'path = "([^"]+)"', (example / "fpm.toml").read_text()).group(1)
    assert (example / path).resolve() == root
