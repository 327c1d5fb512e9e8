"""The benchmark: spreads, the fitted growth, comparison of runs, and the page from made-up measurements."""

import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "benchmark"))

import arithmetic
import beside
import cores
import cost_model
import page
import populations
import runs
from programs import Result, write_results
from rounds import ARITHMETIC, COLD, CORE, LIMIT, ROUNDS, STILL, Turn, write_rounds
from runs import Figure, Run
from scaling import row, write_scaling
from sections_runs import chances, earlier_runs
from spread import Spread

RUN = Run("2026-03-01T10:00:00Z", "0123456789ab", "a processor", "avx2", "GCC version 12.2.0, -O3", "0.1.0")
BEFORE = replace(RUN, date="2026-02-01T10:00:00Z")
RATIOS = [5.0, 6.0, 7.0, 8.0, 9.0, 10.0, 11.0]  # of the seven rounds; quartiles 6.5 and 9.5


def test_spread():
    spread = Spread.of(reversed(RATIOS))
    assert spread == Spread(8.0, 6.5, 9.5, 5.0, 11.0)
    assert spread.stated() == "8, 6.5 to 9.5 (5 to 11)"
    assert spread.times(2.0) == Spread(16.0, 13.0, 19.0, 10.0, 22.0)
    assert Spread.of([2.345]).stated(2) == "2.3"


def figure(name, median, half=0.1):
    """A ratio with quartiles at half of its range."""
    return Figure(name, Spread(median, median - half, median + half, median - 2 * half, median + 2 * half))


@pytest.mark.parametrize(
    ("mine", "theirs", "agrees", "closely"),
    [
        ((8.0, 1.0), (8.5, 1.0), True, True),
        ((8.0, 1.0), (9.5, 2.0), True, False),  # the other median is outside my quartiles
        ((8.0, 3.0), (11.0, 2.0), True, False),  # this median is outside the other quartiles
        ((8.0, 1.0), (10.5, 2.0), False, False),
        ((8.0, 2.0), (10.5, 1.0), False, False),
        ((8.0, 0.0), (8.0, 0.0), True, True),
    ],
)
def test_agreement(mine, theirs, agrees, closely):
    one, other = figure("a", *mine), figure("a", *theirs)
    assert one.agrees(other.spread) == other.agrees(one.spread) == agrees
    assert one.agrees_closely(other.spread) == other.agrees_closely(one.spread) == closely


def test_spread_of_several_runs():
    """All rounds of the runs lie in it, also those of a run that is another by more than its own spread."""
    found = [[figure("a", 1.0), figure("b", 2.0)], [figure("a", 1.5, 0.2)], [figure("a", 1.1)]]
    stated = runs.together(found)
    assert stated["a"] == Spread(1.1, 0.9, 1.7, 0.8, 1.9)
    assert stated["b"] == found[0][1].spread


@pytest.mark.parametrize("several", [1, 2, 3])
def test_agreement_by_chance(several):
    """The same by whole arrays of normal errors."""
    values = np.random.default_rng(5).normal(size=(20_000, several + 1, sum(ROUNDS)))
    mine, before = values[:, 0], values[:, 1:]
    median, stated = np.median(mine, axis=1), np.median(np.median(before, axis=2), axis=1)
    expected = []
    for low, high in ((0.0, 1.0), (0.25, 0.75)):
        ends = np.quantile(mine, [low, high], axis=1)
        lower, upper = np.quantile(before, [low, high], axis=2)
        within = (ends[0] <= stated) & (stated <= ends[1])
        within &= (lower.min(axis=1) <= median) & (median <= upper.max(axis=1))
        expected.append(100.0 * within.mean())
    np.testing.assert_allclose(chances(several), expected, atol=3.0)
    if several == 1:
        np.testing.assert_allclose(expected, [94.0, 50.5], atol=1.0)


@pytest.mark.parametrize(
    "change",
    [
        {"processor": "another"},
        {"commit": "ba9876543210"},
        {"commit": RUN.commit + runs.UNCOMMITTED},
        {"compiler": "GCC version 12.2.0, -O2"},
        {"variant": "avx512"},
        {"version": "0.2.0"},
        {"date": "2026-04-01T10:00:00Z"},  # later
    ],
)
def test_runs_that_are_not_compared(change):
    assert runs.earlier([BEFORE, RUN], RUN) == [BEFORE]
    assert runs.earlier([replace(BEFORE, **change), RUN], RUN) == []


def test_uncommitted_runs_are_never_judged():
    run, before = (replace(each, commit=each.commit + runs.UNCOMMITTED) for each in (RUN, BEFORE))
    assert runs.earlier([before, run], run) == []
    assert "not committed" in " ".join(earlier_runs({before: [], run: []}, run))


def test_section_of_earlier_runs():
    oldest, disturbed = (replace(RUN, date=f"2026-01-{day}T10:00:00Z") for day in ("01", "15"))
    found = {
        oldest: [figure("a", 0.99, 0.04)],
        disturbed: [figure("a", 5.0, 1.0)],
        BEFORE: [figure("a", 1.0, 0.04), figure("b", 2.0, 0.04), figure("c", 3.0, 0.04), figure("gone", 1.0, 0.04)],
        RUN: [figure("a", 1.02, 0.04), figure("b", 2.06, 0.04), figure("c", 3.3, 0.04), figure("new", 1.0, 0.04)],
    }
    lines = earlier_runs(found, RUN)
    text = " ".join(lines)
    assert "In this run they are within 5.9 %." in text
    assert "2 of 3 ratios agree with 2 earlier runs, 1 of them closely." in text
    assert f"| {BEFORE.date} | 6.0 % | 3.0 % | 10.0 % |" in lines
    assert f"| {disturbed.date} | 40.0 % | disturbed |  |" in lines
    assert f"| {oldest.date} | 8.1 % | 3.0 % | 3.0 % |" in lines
    assert "| c | 3.3, 3.26 to 3.34 (3.22 to 3.38) | 3, 2.96 to 3.04 (2.92 to 3.08) | +10.0 % |" in lines
    # Ratios that agree are counted and not listed
    assert not any(line.startswith(("| a |", "| b |", "| new |", "| gone |")) for line in lines)


def test_disturbed_runs_are_not_judged():
    """Half of the ratios tell: one that varies is not enough."""
    quiet = [figure("a", 1.0, 0.04), figure("b", 1.0, 0.045), figure("c", 1.0, 0.5)]
    noisy = [figure("a", 1.0, 0.04), figure("b", 1.0, 0.06), figure("c", 1.0, 0.5)]
    assert runs.is_quiet(quiet)
    assert not runs.is_quiet(noisy)
    text = " ".join(earlier_runs({BEFORE: quiet, RUN: noisy}, RUN))
    assert "This run was disturbed" in text
    assert "agree" not in text
    text = " ".join(earlier_runs({BEFORE: noisy, RUN: quiet}, RUN))
    assert f"| {BEFORE.date} | 12.0 % | disturbed |  |" in text
    assert "agree" not in text


def test_file_of_runs(tmp_path):
    path = tmp_path / "runs.csv"
    assert runs.read(path) == {}
    found = [figure("Boost.odeint / lanes", 8.0)]
    runs.append(path, BEFORE, found)
    runs.append(path, RUN, found)
    assert runs.read(path) == {BEFORE: found, RUN: found}
    path.write_text("date,commit\n")
    with pytest.raises(SystemExit, match="columns"):
        runs.read(path)


def test_commit(tmp_path, monkeypatch):
    """Sources that differ from the commit are marked; documents and the file of runs do not count."""
    monkeypatch.setattr(runs, "ROOT", tmp_path)
    assert runs.commit() == runs.UNCOMMITTED
    names = [tmp_path / name for name in ("src/a.f90", "benchmark/runs.csv", "docs/page.md")]
    for name in names:
        name.parent.mkdir()
        name.write_text("one\n")
    who = ["-c", "user.name=test", "-c", "user.email=test@example.org"]
    for words in (["init", "-q"], ["add", "."], [*who, "commit", "-q", "-m", "one"]):
        subprocess.run(["git", *words], cwd=tmp_path, check=True)
    clean = runs.commit()
    assert len(clean) == 12
    names[1].write_text("two\n")
    names[2].write_text("two\n")
    assert runs.commit() == clean
    names[0].write_text("two\n")
    assert runs.commit() == clean + runs.UNCOMMITTED


def test_report_of_the_executable(executable):
    command = [executable, "--benchmark", "0.001", "--threads", "1"]
    report = arithmetic.parse(subprocess.run(command, capture_output=True, text=True, check=True).stdout)
    assert list(report.rates) == ["one_sided", "free_standing", "two_block"]
    assert all(rate > 0.01 for rate in report.rates.values())
    assert report.compiler.startswith("GCC")
    assert " -O3" in report.compiler
    assert "/" not in report.compiler


def gauge(additions):
    """What is measured of a core that does so many additions in the time of a multiplication."""
    return 1.0 / additions, 1.0


@pytest.fixture
def two_cores(monkeypatch):
    """Two cores of which the additions are made up, one list a core, and where the process is moved to."""
    offered, moves = {0: [], 1: []}, []
    monkeypatch.setattr(cores, "GAUGE", Path(__file__))
    monkeypatch.setattr(cores, "measured", lambda core: gauge(offered[core].pop(0)))
    monkeypatch.setattr(cores.os, "sched_getaffinity", lambda _: {0, 1}, raising=False)
    monkeypatch.setattr(cores.os, "sched_setaffinity", lambda _, where: moves.append(where), raising=False)
    return offered, moves


def test_a_turn_takes_the_core_that_is_left_alone(two_cores):
    offered, moves = two_cores
    own = cores.Cores()
    offered[0], offered[1] = [10.0, 9.5, 6.0], [6.0, 9.0, 9.2]
    assert own.turn(lambda: moves[-1]) == ({0}, [gauge(10.0), gauge(9.5)])
    assert own.turn(lambda: moves[-1]) == ({1}, [gauge(9.0), gauge(9.2)])
    assert moves == [{0}, {0, 1}, {1}, {0, 1}]


def test_a_turn_waits_for_a_core(two_cores, monkeypatch):
    offered, moves = two_cores
    own = cores.Cores()
    offered[0], offered[1] = [10.0, 10.0, 6.0, 9.0, 9.0], [6.0, 7.0, 6.0]
    own.turn(moves.copy)
    assert own.turn(moves.copy)[1] == [gauge(9.0), gauge(9.0)]
    # Not for ever
    monkeypatch.setattr(cores, "WAIT", 0.0)
    offered[0], offered[1] = [6.0], [7.0, 9.0]
    assert own.turn(lambda: moves[-1]) == ({1}, [gauge(7.0), gauge(9.0)])


def test_a_turn_is_taken_again_if_its_core_was_shared(two_cores):
    offered, _ = two_cores
    own, taken = cores.Cores(), iter(range(9))
    offered[0], offered[1] = [10.0, 6.0, 9.0, 9.0], [6.0, 6.0]
    assert own.turn(lambda: next(taken)) == (1, [gauge(9.0), gauge(9.0)])
    offered[0], offered[1] = cores.TRIES * [10.0, 6.0], cores.TRIES * [6.0]
    assert own.turn(lambda: next(taken)) == (1 + cores.TRIES, [gauge(10.0), gauge(6.0)])


def test_an_interrupted_gauge_does_not_make_a_core_free(two_cores, monkeypatch):
    """A multiplication that takes twice as long leaves time for twice the additions."""
    found = iter([gauge(10.0), gauge(6.0), gauge(10.0), (0.1, 2.0), gauge(9.0), gauge(9.1)])
    monkeypatch.setattr(cores, "measured", lambda core: next(found))
    own = cores.Cores()
    own.turn(lambda: None)
    assert own.turn(lambda: None)[1] == [gauge(9.0), gauge(9.1)]
    assert own.most == 10.0


def test_a_turn_of_threads_waits_for_all_cores(two_cores):
    offered, moves = two_cores
    own = cores.Cores()
    offered[0], offered[1] = [10.0, 10.0, 10.0], [6.0, 9.0, 9.0]
    found, gauges = own.turn(lambda: moves[-1], 2)
    assert found == {0, 1}
    assert sorted(gauges, reverse=True) == [gauge(9.0), gauge(9.0), gauge(10.0), gauge(10.0)]


def test_a_turn_of_more_threads_than_cores_are_tried(two_cores, monkeypatch):
    offered, moves = two_cores
    monkeypatch.setattr(cores.os, "sched_getaffinity", lambda _: {0, 1, 2, 3})
    monkeypatch.setattr(cores, "MOST", 2)
    offered[0], offered[1] = [10.0, 10.0], [10.0, 10.0]
    assert cores.Cores().turn(lambda: moves[-1], 3)[0] == {0, 1, 2, 3}


def test_cores_without_a_gauge(two_cores, monkeypatch, tmp_path):
    monkeypatch.setattr(cores, "GAUGE", tmp_path / "core")
    assert cores.Cores().turn(lambda: "taken") == ("taken", [])
    assert two_cores[1] == []


def made_up_rows(call=2e-3, record=3e-4, history=4e-5, serial=0.1):
    """Rows of the scaling by known laws."""
    rows = []
    for n in (1, 2, 4):
        gain = cost_model.speed_up(serial, n)
        for kind in ("strong", "weak"):
            rows += [row(kind, n, 880, [1.0 / gain]), row(f"{kind} efficiency", n, 880, [gain / n])]
    for n in (6, 11, 44):
        rows.append(row("records", n, 20 * n, [call + record * n + history * 20 * n]))
    for n in (5, 20, 80):
        rows.append(row("levels", n, 44 * n, [call + record * 44 + history * 44 * n]))
    for kind, power in {"walls": 1.0, "shocks": 0.9, "samples": 0.7}.items():
        rows += [row(kind, n, 880, [0.02 * n**power]) for n in (1, 2, 4)]
    rows += [row("variant", 0, 880, [0.5]), row("variant speed-up", 0, 880, [1.0])]
    for place in range(len(beside.FACADES)):
        # Each with a third more than the one before
        rows += [row("facade", place, 880, [0.03 * (3 + place)]), row("facade ratio", place, 880, [1.0 + place / 3.0])]
    rows += [row("fixed", place, 0, [1e-3 * (1 + place)]) for place in range(len(beside.FIXED))]
    for kind in populations.KINDS:
        for n in (100, 400):
            rows += [row(f"population, {kind}", n, 0, [2e-3 * n]), row(f"population memory, {kind}", n, 0, [0.1 * n])]
    return [*rows, row("memory", 1, 880, [11.5])]


def test_cost_model():
    rows = made_up_rows()
    constants, error = cost_model.of_call(rows)
    assert constants == pytest.approx([2e-3, 3e-4, 4e-5], rel=1e-9)
    assert error < 1e-9
    assert cost_model.growth(rows, "shocks") == pytest.approx((0.02, 0.9))
    assert cost_model.serial_share(rows) == pytest.approx(0.1)
    # The lines of the figure go through measurements that obey the laws.
    for kind in ("walls", "records", "levels", "shocks", "samples"):
        own = [each for each in rows if each["kind"] == kind]
        size, seconds = (np.array([each[what] for each in own]) for what in ("size", "median"))
        assert cost_model.modelled(rows, kind, size) == pytest.approx(seconds), kind


def test_cost_model_states_what_it_leaves_unexplained():
    rows = made_up_rows()
    next(each for each in rows if each["kind"] == "levels")["median"] *= 1.5
    assert cost_model.of_call(rows)[1] > 0.05


def test_one_thread_has_no_serial_share():
    rows = [each for each in made_up_rows() if "efficiency" not in each["kind"] or each["size"] == 1]
    assert cost_model.serial_share(rows) is None


def result(program, method, setting, ms, histories=880, own=0.0, flags=0, above=1, worst=1e-5):
    """Result of a program that takes some milliseconds for all histories."""
    times = (1e-3 * ms * histories / 880, own, ms / 880, ms / 880)
    errors = (flags, above, worst, 1e-12, 1e-9)
    return Result("one_sided", "recorded", program, f"{program} 1", method, setting, histories, *times, *errors)


@pytest.fixture
def tables(tmp_path):
    """Tables as the benchmark writes them: engine lanes takes 20 ms, Boost.odeint RATIOS times as long."""
    folder = tmp_path / "tables"
    folder.mkdir()
    results = [
        result("dondolo", "rk45", 1e-8, 200.0),
        result("dondolo", "lanes", 1e-8, 20.0),
        result("dondolo", "lanes", 1e-12, 30.0),
        result("Boost.odeint", "cut", 1e-8, 160.0, above=4),
        result("Boost.odeint", "cut", 1e-9, 159.0, above=4),  # the same steps, faster by chance
        result("Boost.odeint", "cut", 1e-10, 500.0, worst=2.1e-5),
        result("Boost.odeint", "cut", 1e-12, 600.0, flags=1),
        result("Boost.odeint", "cut", 1e-13, 720.0, worst=1.9e-5),
        result("Boost.odeint", "cut", 1e-14, 719.0),
        result("Boost.odeint", "free", 1e-6, 170.0, above=4),
        result("heyoka", "batch", 1e-9, 2000.0, own=0.25),
        result("SciPy", "RK45", 1e-6, 1e5, histories=55),
        result("GNU Octave", "ode45", 1e-6, 4e6, histories=11),
    ]
    turns = [Turn(0, "GNU Octave, ode45", 1e-6, 4e6, 0.0)]
    for number, ratio in enumerate(RATIOS, 1):
        turns += [
            Turn(number, "dondolo, rk45", 1e-8, 200.0, 0.0),
            Turn(number, "dondolo, lanes", 1e-8, 20.0, 19.0),
            Turn(number, "dondolo, lanes", 1e-12, 30.0, 0.0),
            Turn(number, "Boost.odeint, cut", 1e-8, 20.0 * ratio, 0.0),
            Turn(number, "Boost.odeint, cut", 1e-13, 720.0, 0.0),
            Turn(number, "heyoka, batch", 1e-9, 2000.0, 250.0),
            Turn(number, "SciPy, RK45", 1e-6, 1e5, 0.0),
            Turn(number, COLD, 1e-8, 70.0, 18.0),
            Turn(number, STILL, 1e-8, 0.4, 0.0),
            Turn(number, LIMIT, 0.0, 10.0, 0.0),
            # The last two of three gauges find the core shared
            Turn(number, CORE, 0.0, 80.0, 800.0),
            Turn(number, CORE, 1.0, 100.0, 800.0),
            Turn(number, CORE, 2.0, 160.0, 800.0),
            # A quarter of the operations per second of the loop
            Turn(number, f"{ARITHMETIC}one_sided", 0.0, 40.0 / arithmetic.LOOP, 0.0),
        ]
    write_results(folder / "programs.csv", results)
    write_rounds(folder / "rounds.csv", turns)
    write_scaling(folder / "scaling.csv", made_up_rows())
    (folder / "machine.txt").write_text("processor: a processor\n")
    runs.append(folder / "run.csv", RUN, runs.figures(results, turns, made_up_rows()))
    return folder


@pytest.fixture
def site(tmp_path):
    """The study, its page and a README with marks."""
    (tmp_path / "docs/studies").mkdir(parents=True)
    (tmp_path / "docs" / "studies" / "performance.md").write_text(
        f"# Performance\n\n{page.BEGIN}\nwritten before\n{page.END}\n\n## 4. Kept\n"
    )
    for name in ("README.md", "docs/performance.md"):
        (tmp_path / name).write_text(f"- **Fast.** {page.BEGIN}written before{page.END} Kept.\n")
    return tmp_path


def test_page(tables, site):
    page.write(tables, site, site / "runs.csv")
    text = (site / "docs" / "studies" / "performance.md").read_text()
    assert "written before" not in text
    assert text.endswith(f"{page.END}\n\n## 4. Kept\n")
    boost = next(line for line in text.splitlines() if line.startswith("| Boost.odeint | cut, 1e-08 |"))
    assert "| 160 | 4 of 880, 0 wrong flags | 0.8 | 8, 6.5 to 9.5 (5 to 11) |" in boost
    assert "| Boost.odeint, as accurate | cut, 1e-13 | 720 | 1 of 880, 0 wrong flags | 3.6 | 36 | 24 |" in text
    assert "| heyoka, own steps | batch, 1e-09 | 250 | 1 of 880, 0 wrong flags | 1.25 | 12.5 |" in text
    assert "| GNU Octave | ode45, 1e-06 | 4000000 | 1 of 11, 0 wrong flags | 20000 |" in text
    assert "| `one_sided` | 25 |" in text
    words = " ".join(text.split())
    assert "of which the histories themselves are 95 %" in words
    assert "never move take 0.4 ms, 2 % of it" in words
    assert "command `dondolo CASE.nml` takes 70 ms" in words
    assert (
        "additions in the time of a multiplication that waits for the one before; here they were 8, 5 to 10 (5 to 10)."
        in words
    )
    assert "its histories 18 ms." in words
    assert "A call takes 2 ms + 0.3 ms for each record + 0.04 ms for each history" in words
    assert "| three ties | 0.205 | 2 |" in text
    assert "| catalogue | 44 records read | 3 |" in text
    assert "| designs | 100 to 400 | 2 | 1.00 | 10 to 40 |" in text
    assert "There is no earlier run." in words
    for name in ("README.md", "docs/performance.md"):
        short = (site / name).read_text()
        assert "8 times as fast as Boost.odeint" in " ".join(short.split())
        assert short.endswith(f"{page.END} Kept.\n")
    for name in ("work", "arithmetic", "scaling"):
        assert (site / f"docs/figures/performance_{name}.png").stat().st_size > 10_000


def test_page_compares_with_an_earlier_run(tables, site):
    (found,) = runs.read(tables / "run.csv").values()
    names = [each.name for each in found]
    assert "Boost.odeint / lanes" in names
    assert "share of the arithmetic limit, one_sided" in names
    assert "additions / multiplication" in names
    assert "facade with friction / bare" in names
    assert not any("Octave" in name for name in names)
    other = [Figure(each.name, each.spread.times(2.5)) for each in found[:2]]
    runs.append(site / "runs.csv", BEFORE, other + found[2:])
    page.write(tables, site, site / "runs.csv")
    text = " ".join((site / "docs/studies/performance.md").read_text().split())
    assert f"{len(found) - 2} of {len(found)} ratios agree with 1 earlier run," in text


def test_page_without_marks(tables, site):
    (site / "docs" / "studies" / "performance.md").write_text("# Performance\n")
    with pytest.raises(SystemExit, match="one pair"):
        page.write(tables, site, site / "runs.csv")
