"""The prototype for graphics processors, here on the processor: its rules are those of the engine lanes."""

import os
import subprocess

import pytest


@pytest.fixture(scope="module")
def prototype(root, tmp_path_factory):
    """The program, built without a compiler for graphics processors."""
    library = root / "build-python"
    if not (library / "src/libdondolo_core.a").is_file():
        pytest.skip("no build folder of the library here")
    folder = tmp_path_factory.mktemp("gpu")
    subprocess.run(["bash", root / "benchmark/gpu/build.sh", library, folder, "-foffload=disable"], check=True)
    return folder / "dondolo-gpu"


def run(program, *words):
    environment = {**os.environ, "ACC_DEVICE_TYPE": "host"}
    return subprocess.run([program, *words], capture_output=True, text=True, env=environment)


@pytest.mark.slow
def test_same_results_as_the_engine(prototype):
    done = run(prototype, "4")
    assert done.returncode == 0, done.stdout + done.stderr
    rows = [line.split() for line in done.stdout.splitlines()]
    histories = {row[0]: row[2] for row in rows if row and row[0] in ("one_sided", "free_standing", "two_block")}
    assert histories == {"one_sided": "3520", "free_standing": "3520", "two_block": "880"}
    assert "no graphics processor" in done.stdout


@pytest.mark.slow
def test_number_of_walls(prototype):
    done = run(prototype, "none")
    assert done.returncode == 2
    assert done.stderr == "dondolo-gpu: 'none': must be a number of walls, 1 at least\n"
