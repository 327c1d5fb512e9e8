"""The build variants of the engine lanes: each is forced, and gives the same but for rounding."""

import contextlib
import os
import subprocess
import sys

import numpy as np
import pytest

import dondolo as dd

NAMES = ("baseline", "native", "avx2", "avx512")


def available():
    """Variants that this build and this processor have."""
    # A list: the steps of a generator would set the variable between those of the test that asks, and leave it set.
    found = []
    with pytest.MonkeyPatch.context() as patch:
        for name in NAMES:
            patch.setenv("DONDOLO_VARIANT", name)
            with contextlib.suppress(dd.errors.InputError):
                assert dd.Solver.variant() == name
                found.append(name)
    return found


@pytest.fixture(scope="module")
def case(root):
    return dd.read_case(root / "data/cases/parapet.nml")


@pytest.fixture(scope="module")
def by_variant(case):
    """Stripes of a parapet by each variant."""
    results = {}
    with pytest.MonkeyPatch.context() as patch:
        for name in available():
            patch.setenv("DONDOLO_VARIANT", name)
            results[name] = run(case, threads=1)
    return results


def run(case, threads):
    wall = case.population[0]
    return dd.multiple_stripe(
        wall, case.records, case.levels, solver=dd.Solver(engine="lanes"), threads=threads, progress=False
    )


def test_the_best_is_taken(monkeypatch):
    names = available()
    assert ("baseline" in names) != ("native" in names)
    monkeypatch.delenv("DONDOLO_VARIANT", raising=False)
    assert dd.Solver.variant() == names[-1]
    monkeypatch.setenv("DONDOLO_VARIANT", "")
    assert dd.Solver.variant() == names[-1]


@pytest.mark.parametrize("wrong", ["sse2", "AVX2", "baseline, avx2", *NAMES])
def test_no_other_is_taken(wrong, case, sine, monkeypatch):
    if wrong in available():
        pytest.skip("this build and this processor have it")
    monkeypatch.setenv("DONDOLO_VARIANT", wrong)
    wall = case.population[0]
    for call in (
        dd.Solver.variant,
        lambda: run(case, threads=1),
        lambda: dd.simulate(wall, sine),
        lambda: dd.typology([wall], [sine], [0.1, 0.2], progress=False),
        lambda: dd.cloud(wall, [sine]),
    ):
        with pytest.raises(
            dd.errors.InputError, match=f"DONDOLO_VARIANT = '{wrong}': this build and this processor have '"
        ):
            call()


@pytest.mark.filterwarnings("ignore::dondolo.errors.DondoloWarning")
def test_variants_agree(by_variant):
    first, *others = by_variant.values()
    assert 0.1 < first.fraction.mean() < 0.9
    for other in others:
        assert np.array_equal(first.collapsed, other.collapsed)
        assert np.abs(first.edp - other.edp).max() < 1e-6
        # Fused operations round differently; equal bits would mean that the same variant has run again.
        assert not np.array_equal(first.edp, other.edp)


@pytest.mark.filterwarnings("ignore::dondolo.errors.DondoloWarning")
def test_threads_change_no_bit_of_a_variant(case, by_variant, monkeypatch):
    for name, stripes in by_variant.items():
        monkeypatch.setenv("DONDOLO_VARIANT", name)
        for threads in (2, 3):
            assert np.array_equal(run(case, threads).edp, stripes.edp), (name, threads)


@pytest.mark.filterwarnings("ignore::dondolo.errors.DondoloWarning")
def test_the_executable_names_and_runs_the_variant(executable, case, by_variant, root, tmp_path):
    for name, stripes in by_variant.items():
        environment = os.environ | {"DONDOLO_VARIANT": name}

        def printed(*arguments, environment=environment):
            command = [executable, *arguments]
            done = subprocess.run(command, cwd=tmp_path, env=environment, capture_output=True, text=True, check=True)
            return done.stdout.splitlines()

        assert printed("--version")[1] == f"build variant {name}"
        assert any(line.endswith(f"engine lanes ({name})") for line in printed(root / "data/cases/parapet.nml"))
        text = (tmp_path / "out/parapet_histories.csv").read_text()
        assert f"\n# engine and build variant: lanes ({name})\n" in text
        assert np.array_equal(dd.read_results(tmp_path / "out/parapet").stripes.edp, stripes.edp)


SLENDER, SQUAT = "slender,one_sided,3.0,0.25\n", "squat,two_block,1.0,0.6\n"


@pytest.mark.parametrize(
    ("walls", "engine", "expected"),
    [
        (SLENDER, "auto", "lanes ({best})"),
        (SLENDER, "rk45", "rk45 ({first})"),
        (SQUAT, "auto", "rk45 ({first})"),
        (SLENDER + SQUAT, "auto", "lanes ({best}) and rk45 ({first})"),
    ],
)
def test_the_engines_that_ran_are_told(executable, root, tmp_path, walls, engine, expected):
    names = available()
    expected = expected.format(first=names[0], best=dd.Solver.variant())
    (tmp_path / "walls.csv").write_text("name,mechanism,height,thickness\n" + walls)
    (tmp_path / "case.nml").write_text(
        "&job task = 'typology' output = 'result' /\n&population file = 'walls.csv' /\n"
        f"&records catalogue = '{root}/data/records/synthetic44.csv' /\n&stripes levels = 0.3, 0.6 /\n"
        f"&solver engine = '{engine}' /\n"
    )
    done = subprocess.run([executable, "case.nml"], cwd=tmp_path, check=True, capture_output=True, text=True)
    assert f", engine {expected}\n" in done.stdout
    assert f"\n# engine and build variant: {expected}\n" in (tmp_path / "result_stripes.csv").read_text()


@pytest.mark.parametrize("name", NAMES)
def test_a_wall_on_the_edge_of_its_trigger_ends(name, root):
    """A peak that equals the trigger to the bit: squat walls turned for ever, by steps too short to move the ground."""
    if name not in available():
        pytest.skip(f"this build or this processor has no variant {name}")
    program = (
        "import sys, warnings, dondolo as dd; warnings.simplefilter('ignore');"
        " records = dd.read_catalogue(sys.argv[1]);"
        "walls = [dd.OneSidedWall(0.5, 0.5), dd.OneSidedWall(1.0, 0.8), dd.FreeStandingWall(0.5, 0.5)];"
        "levels = [1.0 - 2.0**-53, 1.0, 1.0 + 2.0**-52];"
        "print(sum(dd.multiple_stripe(w, records, levels, im='pga/a0', polarity='both', threads=1,"
        " solver=dd.Solver(engine='lanes'),"
        " progress=False).edp.max() for w in walls))"
    )
    run = subprocess.run(
        [sys.executable, "-c", program, root / "data/records/synthetic44.csv"],
        env={**os.environ, "DONDOLO_VARIANT": name},
        capture_output=True,
        text=True,
        check=True,
        timeout=60,
    )
    assert float(run.stdout) < 1e-6
