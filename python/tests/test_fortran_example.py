"""The example of a Fortran program that uses dondolo, compiled with the library of the build and run."""

import csv
import re
import shutil
import subprocess

import numpy as np
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
def test_program_with_dondolo(root, tmp_path):
    """Arrays in, a curve out, and nothing of the half of the library that reads files."""
    source = root / "docs/examples/fpm/app/main.f90"
    assert re.findall(r"^ *use (\w+)", source.read_text(), re.M) == ["dondolo_core"]
    said = subprocess.run([compiled(root, tmp_path, source)], capture_output=True, text=True, check=True)
    assert said.stdout in (root / "docs/fortran.md").read_text()
    theta, beta = map(float, re.findall(r"= *([\d.]+)", said.stdout))
    time = np.arange(1001) * 0.01
    packets = [np.sin(2 * np.pi * (0.5 + 0.1 * i) * time) * np.exp(-(((time - 5) / 2) ** 2)) for i in range(1, 21)]
    records = [dd.Record(packet, 0.01, name=f"packet {i}") for i, packet in enumerate(packets)]
    wall = dd.OneSidedWall(height=1.5, thickness=0.25)
    curve = dd.multiple_stripe(wall, records, levels=[0.2, 0.3, 0.4, 0.6, 0.8], progress=False).fit()
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
    settings = root / "src/core/base/properties/settings.F90"
    program = compiled(root, tmp_path, settings, source, options=["-DDONDOLO_CHECKED"])
    done = subprocess.run([program], capture_output=True, text=True, check=False)
    refused = "there are no settings 'height'" in done.stderr
    assert (done.returncode == 0, refused) == (name == "rtol", name == "height"), done.stderr


NO_CURVE = """
program no_curve
   use dondolo_base_kinds, only : wp
   use dondolo_fragility, only : STATUS, fragility_type
   implicit none

   type(fragility_type) :: curve

   curve = fragility_type(status=STATUS, theta=0.3_wp, beta=0.5_wp)
   print '(f3.1)', curve%probability(0.3_wp)
end program no_curve
"""


@pytest.mark.slow
@pytest.mark.parametrize("status", ["fit_ok", "fit_separated"])
@pytest.mark.parametrize("options", [[], ["-DDONDOLO_CHECKED"]])
def test_an_invariant_that_does_not_hold(root, tmp_path, status, options):
    """Builds with checks end where a curve without a fit is asked for a probability; all others never stop."""
    source = tmp_path / "no_curve.f90"
    source.write_text(NO_CURVE.replace("STATUS", status))
    core = root / "src/core"
    again = (core / "base/numerics/invariant.F90", core / "fragility/fragility.f90")
    program = compiled(root, tmp_path, *again, source, options=options)
    done = subprocess.run([program], capture_output=True, text=True, check=False)
    ends = bool(options) and status != "fit_ok"
    assert ("a curve whose probability is asked has a fit" in done.stderr, done.returncode != 0) == (ends, ends)
    assert done.stdout.strip() == ("" if ends else "0.5")


def test_the_manifest_uses_the_repository(root):
    """The path of the dependency leads to dondolo's own manifest."""
    example = root / "docs/examples/fpm"
    path = re.search(r'path = "([^"]+)"', (example / "fpm.toml").read_text()).group(1)
    assert (example / path).resolve() == root
