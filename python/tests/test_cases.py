"""Parity with the executable: every number of its files, and its sentences."""

import os
import signal
import threading
from contextlib import contextmanager

import numpy as np
import pytest
import study

import dondolo as dd
from dondolo._fortran import _core
from dondolo._fortran.library import receive
from dondolo.exchange import running
from dondolo.exchange.cases import case_of

CASES = {
    "parapet": ["walls", "histories", "stripes", "fragility"],
    "two_block": ["walls", "histories", "stripes", "fragility"],
    "facade_strip": ["walls", "histories", "stripes", "fragility"],
    "pinnacle": ["walls", "histories", "stripes", "fragility"],
    "compound": ["walls", "histories", "stripes", "fragility"],
    "corner": ["walls", "histories", "stripes", "fragility"],
    "elevation": ["walls", "histories", "stripes", "fragility"],
    "panel": ["walls", "histories", "stripes", "fragility"],
    "facade": ["walls", "histories", "stripes", "fragility"],
    "parapet_on_building": ["walls", "histories", "stripes", "fragility"],
    "portal": ["walls", "histories", "stripes", "fragility"],
    "tied_portal": ["walls", "histories", "stripes", "fragility"],
    "storey_strip": ["walls", "histories", "stripes", "fragility"],
    "cavity_wall": ["walls", "histories", "stripes", "fragility"],
    "frame": ["walls", "histories", "stripes", "fragility"],
    "arch": ["walls", "histories", "stripes", "fragility"],
    "horizontal": ["walls", "histories", "stripes", "fragility"],
    "gable": ["walls", "histories", "stripes", "fragility"],
    "garden_wall": ["walls", "histories", "stripes", "fragility"],
    "tied_facade": ["walls", "histories", "stripes", "fragility"],
    "history": ["history"],
    "population": ["walls", "stripes", "fragility", "typology"],
    "designs": ["walls", "stripes", "fragility", "ties"],
    "facade_hinges": ["walls", "stripes", "fragility", "typology", "unions"],
    "facades": ["walls", "stripes", "fragility", "typology", "unions"],
}


def body(path):
    """The lines of a table without its comments."""
    return [line for line in path.read_text().splitlines() if not line.startswith("#")]


@pytest.mark.slow
@pytest.mark.parametrize("name", CASES)
def test_every_number(name, root, run, tmp_path):
    case = root / f"data/cases/{name}.nml"
    finished = run(case)
    assert finished.returncode == 0, finished.stderr
    results = dd.run_case(case, progress=False)
    main = results.response or results.stripes or results.typology
    for table in CASES[name]:
        mine = tmp_path / "mine.csv"
        if table == "history":
            main.to_csv(mine)
        elif table == "fragility" and results.fragility is not None:
            results.fragility.to_csv(mine)
        else:
            main.to_csv(mine, table)
        theirs = body(tmp_path / f"{results.case.output}_{table}.csv")
        assert len(theirs) > 1
        assert study.same_tables(table, body(mine), theirs)
    if main is not results.response:
        stored = dd.read_results(tmp_path / results.case.output)
        assert (stored.stripes or stored.typology).work == main.work


def test_the_same_warnings(root, run):
    case = root / "data/cases/parapet.nml"
    theirs = [line.removeprefix("dondolo: warning: ") for line in run(case).stderr.splitlines()]
    with pytest.warns(dd.errors.DondoloWarning) as caught:
        dd.run_case(case, progress=False)
    assert [str(warning.message) for warning in caught] == theirs


def test_a_case(root):
    case = dd.read_case(root / "data/cases/history.nml")
    assert (case.task, case.record_index, case.im, case.polarity) == ("history", 43, "pga", "as_recorded")
    assert case.scale * case.records[43].peak_acceleration == pytest.approx(0.65 * 9.81)
    assert case.population[0].name == "parapet"


@pytest.mark.parametrize(
    "line",
    [
        "&wall mechanism = 'one_sided', height = 3.0, thickness = -0.25 /",
        "&wall mechanism = 'one_sided', height = 3.0 /",
        "&wall mechanism = 'arch', height = 3.0, thickness = 0.25 /",
        "&wall mechanism = 'one_sided', height = 3,0, thickness = 0.25 /",
        "&wall mechanism = 'one_sided', hight = 3.0, thickness = 0.25 /",
    ],
)
def test_the_same_sentences(root, run, tmp_path, line):
    case = tmp_path / "wrong.nml"
    catalogue = root / "data/records/synthetic44.csv"
    case.write_text(f"{line}\n&records catalogue = '{catalogue}' /\n&stripes levels = 0.1, 0.2 /\n")
    finished = run(case)
    assert finished.returncode == 2
    with pytest.raises(dd.errors.InputError) as caught:
        dd.run_case(case)
    assert f"dondolo: {caught.value}\n" == finished.stderr


def test_a_case_with_tables_of_spreadsheets(tmp_path):
    (tmp_path / "walls.csv").write_text("name;mechanism;height;thickness\na;One_Sided;1,5;0,25\n")
    (tmp_path / "records.csv").write_text("file;dt_s;units\nmotion.txt;0,01;g\n")
    (tmp_path / "motion.txt").write_text("t;a (g)\n0;0\n0,01;0,5\n0,02;-0,25\n")
    (tmp_path / "case.nml").write_text(
        "&job task='TYPOLOGY' /\n&population file='walls.csv' /\n&records catalogue='records.csv' polarity='BOTH' /\n"
        "&stripes im='SA(0.50)' levels=0.1, 0.2 /\n&solver engine='LANES' /\n"
    )
    with pytest.warns(dd.errors.DondoloWarning, match="semicolons, decimal commas") as caught:
        case = dd.read_case(tmp_path / "case.nml")
    assert [str(warning.message).split(": ")[0] for warning in caught] == [
        str(tmp_path / "records.csv"),
        str(tmp_path / "walls.csv"),
    ]
    assert (case.task, case.polarity, case.engine, case.im) == ("typology", "both", "lanes", "sa(0.5)")
    assert case.population[0].thickness == 0.25
    assert case.records[0].acceleration[1] == 0.5 * 9.80665
    assert case.records[0].metadata["processing"] == "decimal commas read"


@pytest.mark.parametrize("encoding", ["cp1252", "utf-16-be"])
def test_a_case_that_is_no_utf8(encoding, tmp_path):
    (tmp_path / "case.nml").write_text("&job title='unità' /\n", encoding=encoding)
    with pytest.raises(dd.errors.InputError, match=r"case\.nml: line 1: byte \d.* is .*: save it as UTF-8"):
        dd.read_case(tmp_path / "case.nml")


def test_no_case(tmp_path):
    with pytest.raises(dd.errors.InputError, match=r"nothing\.nml"):
        dd.run_case(tmp_path / "nothing.nml")


@pytest.mark.parametrize("name", ["parapet", "history"])
def test_estimated_errors(name, root, run, tmp_path):
    """The same numbers from the executable, from Python, and read back from the result files."""
    text = (root / f"data/cases/{name}.nml").read_text().replace("'../records", f"'{root}/data/records")
    case = tmp_path / "case.nml"
    case.write_text(
        text.replace("&solver", "&solver estimate_error = .true.")
        if "&solver" in text
        else text + "&solver estimate_error = .true. /\n"
    )
    finished = run(case)
    assert finished.returncode == 0, finished.stderr
    assert "estimated error" in finished.stdout
    results = dd.run_case(case, progress=False)
    stored = dd.read_results(tmp_path / f"out/{name}")
    mine, theirs = (each.response or each.stripes for each in (results, stored))
    assert mine.edp_error is not None
    assert np.array_equal(mine.edp_error, theirs.edp_error)


def test_records_at_levels(few, run, tmp_path):
    """Levels that have records of their own: `run_case` runs those alone, as the executable does."""
    dd.RecordSet.of_levels({0.3: few[:5], 0.6: few[2:]}).to_catalogue(tmp_path / "sets.csv")
    case = tmp_path / "case.nml"
    case.write_text(
        f"&job output = '{tmp_path}/out' /\n&wall mechanism = 'one_sided', height = 1.5, thickness = 0.25 /\n"
        "&records catalogue = 'sets.csv' /\n&stripes levels = 0.3, 0.6 /\n"
    )
    finished = run(case)
    assert finished.returncode == 0, finished.stderr
    mine, theirs = dd.run_case(case, progress=False).stripes, dd.read_results(tmp_path / "out").stripes
    assert mine.ran.sum(axis=1).tolist() == [5, len(few) - 2]
    assert np.array_equal(mine.edp, theirs.edp, equal_nan=True)


def test_no_file_is_written(root, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    for name in ("history", "parapet", "population"):
        dd.run_case(root / f"data/cases/{name}.nml", progress=False)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("walls", [1, 400])
def test_interrupted(walls, root, tmp_path, monkeypatch):
    """Ctrl-C keeps the walls of a population that are complete, with what comes of them in the whole run."""
    # Most histories never move: there are several blocks of them, which take little time.
    levels = np.append(np.linspace(0.001, 0.02, 20), [0.4, 0.8])
    rng = np.random.default_rng(3)
    rows = [f"wall {i},one_sided,{rng.uniform(1.0, 4.0):.3f},0.3" for i in range(walls)]
    (tmp_path / "walls.csv").write_text("\n".join(["name,mechanism,height,thickness", *rows]) + "\n")
    case = tmp_path / "case.nml"
    case.write_text(
        "&job task = 'typology', threads = 1 /\n&population file = 'walls.csv' /\n"
        f"&records catalogue = '{root}/data/records/synthetic44.csv' /\n"
        f"&stripes levels = {', '.join(map(str, levels))} /\n"
    )

    watched = running._watched

    @contextmanager
    def listening(is_shown, interrupts):
        over = threading.Event()
        with watched(is_shown, interrupts) as heard:

            def interrupt():
                while not over.is_set():
                    done, total = heard[:2].tolist()
                    if total and done >= 0.5 * total:
                        os.kill(os.getpid(), signal.SIGINT)
                        return

            watcher = threading.Thread(target=interrupt)
            watcher.start()
            yield heard
            over.set()
            watcher.join()

    monkeypatch.setattr(running, "_watched", listening)
    with pytest.raises(dd.errors.Interrupted) as caught:
        dd.run_case(case)
    partial = caught.value.partial
    if walls == 1:
        assert partial is None or len(partial.walls) == 1
        return
    assert 0 < len(partial.walls) < walls
    assert f"interrupted: {len(partial.walls)} of {walls} walls are complete" == str(caught.value)
    monkeypatch.undo()
    whole = dd.run_case(case, progress=False).typology
    assert partial.exceedances.any()
    assert np.array_equal(partial.exceedances, whole.exceedances[:, :, : len(partial.walls)])


def test_progress_is_told(root):
    """How far a run is is told while it runs: all histories at the end."""
    path = bytes(root / "data/cases/parapet.nml")
    heard = np.zeros(3, dtype=np.int32)
    case, _, results = map(receive, _core.cases.run_case(path, heard.ctypes.data))
    running._tables(results)
    case_of(case)
    assert heard.tolist() == [44 * 9, 44 * 9, 0]
