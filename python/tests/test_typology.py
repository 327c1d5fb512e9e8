"""Populations of walls."""

import contextlib
import multiprocessing
import pickle
import subprocess
import sys
from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor

import numpy as np
import pytest
from refusals import refused

import dondolo as dd
from dondolo.analysis import request
from dondolo.populations import blocks
from dondolo.populations.combination import combine

pytestmark = pytest.mark.filterwarnings("ignore::dondolo.errors.DondoloWarning")

LEVELS = [0.2, 0.4, 0.6, 0.9, 1.3]


@pytest.fixture(scope="module")
def population(root):
    """Some walls of both mechanisms."""
    people = dd.Population.from_csv(root / "data/walls/population.csv")
    return dd.Population(people.walls[::5], people.weights[::5])


@pytest.fixture(scope="module")
def typology(population, few):
    """Their typology, with both polarities so that stripes differ in size."""
    return dd.typology(population, few, LEVELS, polarity="both", progress=False)


def test_every_wall_is_its_own_analysis(typology, population, few):
    works = []
    for i, wall in enumerate(population):
        stripes = dd.multiple_stripe(wall, few, LEVELS, polarity="both", progress=False)
        assert np.array_equal(typology.collapses[:, i], stripes.collapses)
        assert np.array_equal(typology.histories[:, i], stripes.histories)
        works.append(stripes.work)
        curve = stripes.fit()
        assert typology.curves[i].status == curve.status
        if curve.has_fit:
            assert (typology.curves[i].theta, typology.curves[i].beta) == (curve.theta, curve.beta)
    # Who asks for collapses alone pays less.
    total = dd.results.Work.total(works)
    for count in ("histories", "still", "intervals"):
        assert getattr(typology.work, count) == getattr(total, count)
    assert typology.work.steps < total.steps


def test_a_fit_that_does_not_converge_ends_no_population(records):
    walls = [dd.OneSidedWall(3.0, 0.25, name="a"), dd.OneSidedWall(1.0, 0.5, name="b")]
    people = dd.Population(walls, [1e-12, 1.0], group_names=["rare", "frequent"])
    with pytest.warns(dd.errors.DondoloWarning, match=r"the population has no fit \(.*status not_converged\)"):
        result = dd.typology(people, records, [0.2, 0.4, 0.8], progress=False)
    assert result["all"].fit.status == "not_converged"
    assert np.isnan(result["all"].fit.theta)
    assert result["all", "rare"].fit.has_fit


def test_means(typology, population):
    share = population.weights / population.weights.sum()
    assert typology["all"].weight == population.weights.sum()
    fractions = typology.collapses / typology.histories
    assert typology["all"].mean_fraction == pytest.approx(fractions @ share, rel=1e-13)
    assert typology["all"](LEVELS) == pytest.approx(typology["all"].mean_curve, rel=1e-13)
    assert isinstance(typology["all"](0.5), float)
    assert typology["all"](0.0) == 0.0
    x = np.linspace(0.0, 3.0, 60)
    assert np.all(np.diff(typology["all"](x)) >= 0.0)


def test_mechanisms(typology):
    names = [group.mechanism for group in typology.groups]
    assert names == ["one_sided", "two_block", "all"]
    parts = typology.groups[:-1]
    assert sum(group.weight for group in parts) == pytest.approx(typology["all"].weight)
    mean = sum(group.weight * group.mean_curve for group in parts) / typology["all"].weight
    assert mean == pytest.approx(typology["all"].mean_curve, rel=1e-12)
    for group in parts:
        assert typology[group.mechanism](LEVELS) == pytest.approx(group.mean_curve, rel=1e-12)
        assert typology[group.mechanism].fit is group.fit
    for key in (1, None, ("all", "a", "b"), ("all", 1)):
        with pytest.raises(dd.errors.InputError, match="must be a mechanism, or a mechanism and a group"):
            typology[key]
    with pytest.raises(
        dd.errors.InputError, match="mechanism = 'arch': must be one of 'one_sided', 'two_block', 'all'"
    ):
        typology["arch"]


def test_the_counts_behind_the_fit(typology):
    for group in typology.groups:
        again = dd.fit_fragility(group.fit.levels, group.fit.collapses, group.fit.histories)
        assert (again.theta, again.beta) == pytest.approx((group.fit.theta, group.fit.beta), rel=1e-12)
    low, high = typology["all"].fit.interval(0.6)
    assert low < typology["all"].fit(0.6) < high


def test_weights_alike(few):
    walls = [dd.OneSidedWall(1.5, 0.25, name="a"), dd.OneSidedWall(2.0, 0.25, name="b")]
    result = dd.typology(walls, few, LEVELS, progress=False)
    assert list(result.weights) == [1.0, 1.0]
    assert [group.mechanism for group in result.groups] == ["one_sided"]


@pytest.mark.parametrize("kind", ["threads", "spawn"])
def test_executors(typology, population, few, kind):
    if kind == "threads":
        executor = ThreadPoolExecutor(3)
    else:
        executor = ProcessPoolExecutor(2, mp_context=multiprocessing.get_context("spawn"))
    with executor:
        other = dd.typology(population, few, LEVELS, polarity="both", executor=executor, progress=False)
    assert np.array_equal(other.collapses, typology.collapses)
    assert other["all"].fit.theta == typology["all"].fit.theta
    assert np.array_equal(other["all"].mean_curve, typology["all"].mean_curve)
    assert other.work == typology.work


@pytest.mark.parametrize("threads", [1, 2, 3, 8])
@pytest.mark.parametrize("samples", [20_000, 10_000_000])
def test_threads_change_nothing(typology, population, few, threads, samples, monkeypatch):
    """Blocks of parts of a wall, and one of all walls: some shared out among the threads, the others run by all."""
    monkeypatch.setattr(request, "_FIRST_SAMPLES", samples)
    other = dd.typology(population, few, LEVELS, polarity="both", threads=threads, progress=False)
    assert np.array_equal(other.collapses, typology.collapses)
    assert other.work == typology.work
    assert other["all"].fit.theta == typology["all"].fit.theta


def test_pickle_and_shown(typology):
    again = pickle.loads(pickle.dumps(typology))
    assert again["all"](0.5) == typology["all"](0.5)
    assert "walls 5" in repr(typology)
    assert "<table>" in typology._repr_html_()


def test_errors(population, few):
    with pytest.raises(dd.errors.InputError, match="walls: must be given"):
        dd.typology([], few, LEVELS)
    with refused("wrong_type", "walls"):
        dd.typology(["wall"], few, LEVELS)
    flat = dd.TwoBlockWall(3.0, 0.25, hinge=0.9, name="flat")
    with pytest.raises(dd.errors.InputError, match="wall 'flat': edp_limit = 3: must be less than"):
        dd.typology([*population.walls, flat], few, LEVELS, solver=dd.Solver(edp_limit=3.0))


def test_interruption_keeps_complete_walls(population, few, monkeypatch, replace_procedure):
    from dondolo._fortran import _core

    done = []
    run_rows = _core.stores.run_rows

    def stop(*arguments):
        if sum(done) > 2:
            raise KeyboardInterrupt
        done.append(arguments[2])
        return run_rows(*arguments)

    replace_procedure("stores.run_rows", stop)
    with pytest.raises(dd.errors.Interrupted) as caught:
        dd.typology(population, few, LEVELS, block=1, progress=False)
    partial = caught.value.partial
    assert len(partial.walls) == sum(done)
    assert 0 < len(partial.walls) < len(population)
    # The partial result is the typology of these walls alone.
    monkeypatch.undo()
    alone = dd.typology(population[: len(partial.walls)], few, LEVELS, progress=False)
    np.testing.assert_array_equal(partial.collapses, alone.collapses)
    assert alone["all"].fit.has_fit
    assert (partial["all"].weight, partial["all"].fit.theta, partial["all"].fit.beta) == (
        alone["all"].weight,
        alone["all"].fit.theta,
        alone["all"].fit.beta,
    )


def test_interruption_keeps_walls_with_all_their_mechanisms(few, replace_procedure):
    from dondolo._fortran import _core

    kinds = (dd.OneSidedWall, dd.TwoBlockWall)
    rows = [kind(2.0 + 0.1 * i, 0.25, name=f"wall {i}") for i in range(4) for kind in kinds]
    run_rows, calls = _core.stores.run_rows, []

    def stop(*arguments):
        calls.append(1)
        if len(calls) == 6:
            raise KeyboardInterrupt
        return run_rows(*arguments)

    replace_procedure("stores.run_rows", stop)
    with pytest.raises(dd.errors.Interrupted, match="interrupted: 2 of 4 walls are complete") as caught:
        dd.typology(rows, few, LEVELS, block=1, progress=False)
    partial = caught.value.partial
    assert [wall.name for wall in partial.walls] == ["wall 0", "wall 0", "wall 1", "wall 1"]
    assert len(partial.flags.histories) == 4
    calls.clear()
    calls += [1] * 4
    with pytest.raises(dd.errors.Interrupted, match="interrupted: no wall is complete"):
        dd.typology(rows, few, LEVELS, block=1, progress=False)


def test_ctrl_c_at_the_very_end(population, few, monkeypatch):
    """Between the last history of a block and the report of it."""

    class Bar:
        done = 0

        def update(self, count):
            self.done += count
            if self.done >= 3 * len(few) * len(LEVELS):
                raise KeyboardInterrupt

    monkeypatch.setattr(blocks, "progress_bar", lambda *given: contextlib.nullcontext(Bar()))
    with pytest.raises(dd.errors.Interrupted, match="interrupted: 3 of 5 walls are complete") as caught:
        dd.typology(population, few, LEVELS, block=1, progress=False)
    assert len(caught.value.partial.walls) == 3


def test_memory_is_that_of_blocks(root):
    """The EDPs of all histories would take 130 MB."""
    program = """
import resource, sys, warnings
import numpy as np
import dondolo as dd
warnings.simplefilter("ignore")
records = dd.read_catalogue(sys.argv[1])
population = dd.Population([dd.OneSidedWall(3.0, 0.25, name=f"wall {i}") for i in range(5000)])
def largest():
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
def study(walls):
    # No wall moves, so that it takes little time.
    return dd.typology(walls, records, np.linspace(0.001, 0.02, 20), threads=2, progress=False).work
study(population.walls[:200])
before = largest()
assert study(population).histories == 4_400_000
print(largest() - before)
"""
    command = [sys.executable, "-c", program, str(root / "data/records/synthetic44.csv")]
    result = subprocess.run(command, capture_output=True, text=True, check=True)
    assert float(result.stdout) < 70.0


def test_wrong_levels_and_shares(typology):
    assert typology["all"].probabilities([]).shape == (len(typology.combined), 0)
    for wrong in ("a", [0.5, "b"], 0.0, 1.5, np.nan):
        with pytest.raises(dd.errors.InputError, match="q: must be shares of the weight, above 0 and up to 1"):
            typology["all"].fractiles(0.5, wrong)
    with pytest.raises(dd.errors.InputError, match=r"edp_threshold = 1\.0000001: must be one of 1"):
        typology.at(1.0000001)


def test_a_partial_population_keeps_its_weights_and_origin():
    walls = [dd.OneSidedWall(3.0, 0.3, name=name) for name in "abc"]
    people = dd.Population(walls, [0.0, 2.0, 3.0], origin=["surveyed"])
    counts = np.array([1, 5, 9], dtype=np.int32)[None, :, None].repeat(3, axis=2)
    sizes = np.full((3, 3), 10, dtype=np.int32)
    given = people, "pga", np.array([0.2, 0.4, 0.8]), np.array([1.0]), counts, sizes
    with pytest.raises(dd.errors.Interrupted, match="no wall of any weight is complete"):
        combine(*given, np.array([True, False, False]), dd.results.Work())
    partial = combine(*given, np.array([True, True, False]), dd.results.Work())
    assert partial["all"].weight == 2.0
    assert partial.population.origin == ("surveyed",)
