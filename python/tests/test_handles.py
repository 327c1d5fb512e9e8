"""What is uploaded to Fortran: it lives as long as it is needed, no longer, and only in its process."""

import gc
import os
import pickle
import sys
import threading
import warnings

import numpy as np
import pytest

import dondolo as dd
from dondolo._fortran import _core
from dondolo._fortran.handles import Handle
from dondolo._fortran.histories import settings
from dondolo._fortran.library import check
from dondolo.records.suite import place_of, upload
from dondolo.walls.wall import upload as upload_walls

LEVELS = [0.2, 0.6]


def refusal(procedure, *given):
    """The sentence with which a procedure of the extension refuses what it is given."""
    found = procedure(*given)
    with pytest.raises(dd.errors.InputError) as refused:
        check(found if isinstance(found, np.ndarray) else found[-1])
    return str(refused.value)


def resident():
    """Resident memory of this process [bytes]."""
    gc.collect()
    with open("/proc/self/statm") as file:
        return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")


def test_the_same_records_are_uploaded_once(few, monkeypatch):
    several = tuple(few)
    suite = upload(several)
    assert upload(several) is suite
    assert place_of(several[1]) == (suite, 2)
    assert upload(several[::-1]) is not suite
    assert upload(several) is not suite
    twice = (several[0], several[0])
    assert upload(twice) is upload(twice)
    assert upload(twice[:1]) is not upload(twice)


def test_no_record_crosses_twice(few, replace_procedure):
    calls = []
    new_suite = _core.records.new_suite
    replace_procedure("records.new_suite", lambda *given: calls.append(1) or new_suite(*given))
    records = [dd.Record(record.acceleration, record.dt, record.name) for record in few]
    for wall in (dd.OneSidedWall(3.0, 0.25), dd.TwoBlockWall(3.0, 0.25)):
        dd.multiple_stripe(wall, records, LEVELS, im="sa(0.5)", progress=False)
        dd.multiple_stripe(wall, records, LEVELS, polarity="both", progress=False)
        dd.simulate(wall, records[1])
        records[0].spectrum([0.5])
    assert len(calls) == 1


def test_walls_that_are_tried_alike_share_a_study(few, replace_procedure):
    calls = []
    new_study = _core.stripes.new_study
    replace_procedure("stripes.new_study", lambda *given, **more: calls.append(given) or new_study(*given, **more))
    plans, plan = [], _core.stripes.plan
    replace_procedure("stripes.plan", lambda *given: plans.append(given) or plan(*given))
    one, two = dd.OneSidedWall(3.0, 0.25), dd.TwoBlockWall(3.0, 0.25)
    study = dd.Study(few, LEVELS)
    first = study.run(one, progress=False)
    second = study.run(dd.OneSidedWall(4.0, 0.25), progress=False)
    assert len(calls) == len(plans) == 1
    assert second.scale.base is first.scale.base
    assert not any(stripes.scale.base.flags.writeable for stripes in (first, second))
    other = study.run(two, progress=False)
    assert len(calls) == 1
    # Whatever else is asked for in between, results are those of an analysis alone.
    for way in ({"im": "sa(0.5)"}, {"polarity": "both"}, {"solver": dd.Solver(rtol=1e-9)}, {"threads": 1}):
        alone = dd.multiple_stripe(one, few, LEVELS, **way, progress=False)
        assert np.array_equal(dd.Study(few, LEVELS, **way).run(one, progress=False).edp, alone.edp)
    for wall, before in ((one, first), (two, other)):
        for again in (study.run(wall, progress=False), dd.multiple_stripe(wall, few, LEVELS, progress=False)):
            for name in ("edp", "collapsed", "impacts", "time_of_peak", "scale"):
                assert np.array_equal(getattr(again, name), getattr(before, name))
    assert (
        repr(study) == f"<Study: records {len(few)}, levels {len(LEVELS)} of pga, 0.2 to 0.6 g, polarity as_recorded>"
    )


def test_walls_that_share_a_plan_have_warnings_of_their_own(few, replace_procedure):
    plans, plan = [], _core.stripes.plan
    replace_procedure("stripes.plan", lambda *given: plans.append(given) or plan(*given))
    levels = [0.2, 8.0]
    walls = {
        "usual": dd.OneSidedWall(3.0, 0.25, name="usual"),
        "in cm": dd.OneSidedWall(300.0, 25.0, name="in cm"),
        "on the moon": dd.OneSidedWall(3.0, 0.25, name="on the moon", gravity=1.62),
        "two blocks": dd.TwoBlockWall(3.0, 0.25, name="two blocks"),
    }
    found, study = {}, dd.Study(few, levels)
    for again in (False, True):
        for name, wall in walls.items():
            with pytest.warns(dd.errors.DondoloWarning) as caught:
                stripes = (study if again else dd.Study(few, levels)).run(wall, progress=False)
            told = [str(one.message) for one in caught], stripes.scale.tolist(), stripes.collapsed.tolist()
            assert found.setdefault(name, told) == told
    # The first of them is planned for the second too, the others differ in gravity or sides.
    assert len(plans) == len(walls) + len(walls) - 1
    # Factors of this measure depend on the wall.
    del plans[:]
    dimensionless = dd.Study(few, [1.0, 1.5], im="pga/a0")
    for wall in (walls["usual"], dd.OneSidedWall(3.0, 0.5), walls["usual"]):
        scaled = dimensionless.run(wall, progress=False)
        expected = wall.trigger_acceleration / np.array([record.peak_acceleration for record in few])
        np.testing.assert_allclose(scaled.scale[0], expected, rtol=1e-12)
    assert len(plans) == 3
    # One that is raised is not the one that the next caller gets.
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        for _ in range(2):
            with pytest.raises(dd.errors.DondoloWarning) as raised:
                study.run(walls["usual"], progress=False)
            assert len(raised.traceback) < 10


def test_motions_of_floors_are_not_kept(few, replace_procedure):
    """They take much memory: a wall on a building has a study of its own each time."""
    calls = []
    new_study = _core.stripes.new_study
    replace_procedure("stripes.new_study", lambda *given, **more: calls.append(given) or new_study(*given, **more))
    wall, building = dd.OneSidedWall(3.0, 0.25), dd.Building(period=0.3, participation=1.3)
    upstairs = dd.OneSidedWall(3.0, 0.25, building=building)
    study, by_level = dd.Study(few, LEVELS), dd.Study({0.2: few[:1], 0.6: few})
    for _ in range(2):
        study.run(upstairs, progress=False)
        study.run(wall, progress=False)
        by_level.run(wall, progress=False)
    assert len(calls) == 4
    alone = dd.multiple_stripe(wall, {0.2: few[:1], 0.6: few}, progress=False)
    assert np.array_equal(by_level.run(wall, progress=False).edp, alone.edp, equal_nan=True)


def test_a_study_frees_what_it_keeps(few):
    study = dd.Study(few, LEVELS)
    study.run(dd.OneSidedWall(3.0, 0.25), progress=False)
    number = study._request._study.number
    walls = upload_walls((dd.OneSidedWall(3.0, 0.25),))
    _core.stripes.plan(number, walls.number, 1, [])
    gc.disable()
    try:
        del study
        assert "is not valid" in refusal(_core.stripes.plan, number, walls.number, 1, [])
    finally:
        gc.enable()


def test_use_after_free(few):
    suite, walls = upload(tuple(few)).number, upload_walls((dd.OneSidedWall(3.0, 0.25),))
    handle, *_ = _core.records.new_suite(b"a", b"\n\n", [2], [0.1], [1.0, 2.0], [0], [0.0], 1)
    study, failure = _core.stripes.new_study(handle, b"pga", [0.1], b"both", b"auto", 1, *settings(None, None, None))
    check(failure)
    _core.library.free(handle)
    _core.library.free(handle)
    other, *_ = _core.records.new_suite(b"a", b"\n\n", [2], [0.1], [1.0, 2.0], [0], [0.0], 1)
    for number in (handle, -1, 0, 1, 2**40, 2**62, walls.number):
        assert "is not valid" in refusal(_core.records.measure_suite, number, b"pga", 1)
    # A study does not outlive its suite, even where another suite has taken its slot.
    assert "records: handle" in refusal(_core.stripes.plan, study, walls.number, 1, [])
    for given in ((suite, walls.number), (study, study)):
        assert "is not valid" in refusal(_core.stripes.plan, *given, 1, [])
    for procedure in (_core.stores.claim_store, _core.stores.read_store):
        assert "store: handle" in refusal(procedure, other)
    _core.stores.close_store(suite)
    _core.library.free(study)
    _core.library.free(other)


def test_a_handle_is_freed_with_its_object():
    record = dd.Record([0.1, 0.2], 0.1)
    number = place_of(record)[0].number
    del record
    gc.collect()
    assert "is not valid" in refusal(_core.records.measure_suite, number, b"pga", 1)


def test_a_study_keeps_its_suite():
    record = dd.Record(np.sin(np.arange(300.0)), 0.01)
    wall = dd.OneSidedWall(3.0, 0.25)
    suite = upload((record,))
    study = Handle(
        _core.stripes.new_study(suite.number, b"pga", [0.1], b"both", b"auto", 1, *settings(None, None, None))[0],
        suite,
    )
    del suite, record
    gc.collect()
    # What is sent ends with the kind of an error, else with the number of names, negative.
    assert _core.stripes.plan(study.number, upload_walls((wall,)).number, 1, [])[-1] <= 0


def test_what_was_uploaded_is_not_pickled(few):
    wall = dd.OneSidedWall(3.0, 0.25)
    before = dd.multiple_stripe(wall, few, LEVELS, progress=False)
    people, records = pickle.loads(pickle.dumps((wall, few)))
    assert "_home" not in records[0].__dict__
    assert "_handle" not in people.__dict__
    assert np.array_equal(dd.multiple_stripe(people, records, LEVELS, progress=False).edp, before.edp)
    with pytest.raises(TypeError, match="own process"):
        pickle.dumps(upload(tuple(few)))


@pytest.mark.skipif(not hasattr(os, "fork"), reason="no fork")
@pytest.mark.filterwarnings("ignore:.*fork.*:DeprecationWarning")
def test_handles_after_a_fork(few):
    wall = dd.OneSidedWall(3.0, 0.25)
    before = dd.multiple_stripe(wall, few, LEVELS, threads=1, progress=False).edp
    child = os.fork()
    if child == 0:
        same = np.array_equal(dd.multiple_stripe(wall, few, LEVELS, threads=1, progress=False).edp, before)
        os._exit(0 if same else 1)
    assert os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) == 0
    assert np.array_equal(dd.multiple_stripe(wall, few, LEVELS, threads=1, progress=False).edp, before)


def test_threads_upload_and_free(few):
    wall = dd.OneSidedWall(3.0, 0.25)
    edp = dd.multiple_stripe(wall, few, LEVELS, threads=1, progress=False).edp
    wrong, done = [], {}

    def work(shift):
        done[shift] = 0
        for i in range(40):
            # From another record on, all round
            some = few[np.roll(range(len(few)), i + shift)]
            found = dd.multiple_stripe(wall, some, LEVELS, threads=1, progress=False)
            order = [record.name for record in few]
            if not np.array_equal(found.edp[:, [found.record_names.index(name) for name in order]], edp):
                wrong.append(shift)
            done[shift] += 1

    team = [threading.Thread(target=work, args=(shift,)) for shift in range(4)]
    for member in team:
        member.start()
    for member in team:
        member.join()
    assert (wrong, done) == ([], dict.fromkeys(range(4), 40))


def test_a_suite_is_kept_while_it_is_used():
    """Another thread uploads the record again, which frees what it was uploaded with before."""
    noise = np.random.default_rng(0).standard_normal(60_000)
    a, b = dd.Record(noise, 0.005, "a"), dd.Record(noise[:1000], 0.005, "b")
    periods = np.geomspace(0.05, 5.0, 40)
    expected, done = a.spectrum(periods).displacement, threading.Event()

    def other():
        while not done.is_set():
            upload((a, b))
            upload((a,))

    beside = threading.Thread(target=other)
    beside.start()
    try:
        assert all(np.array_equal(a.spectrum(periods).displacement, expected) for _ in range(30))
    finally:
        done.set()
        beside.join()


def test_a_wall_has_one_handle():
    """Two threads upload it at once: both use the handle that stays."""
    interval = sys.getswitchinterval()
    sys.setswitchinterval(1e-6)
    try:
        for i in range(500):
            wall, handles, together = dd.OneSidedWall(3.0, 0.25 + 1e-6 * i), [], threading.Barrier(2)

            def work(wall=wall, handles=handles, together=together):
                together.wait()
                handles.append(upload_walls((wall,)))

            team = [threading.Thread(target=work) for _ in "ab"]
            for member in team:
                member.start()
            for member in team:
                member.join()
            assert handles[0] is handles[1]
    finally:
        sys.setswitchinterval(interval)


@pytest.mark.skipif(not os.path.exists("/proc/self/statm"), reason="reads how much memory a process has in /proc")
def test_thousands_of_handles_leave_nothing():
    samples = np.sin(0.1 * np.arange(2000))

    def work(count):
        for _ in range(count):
            record = dd.Record(samples, 0.01)
            dd.multiple_stripe(dd.OneSidedWall(3.0, 0.25), record, [0.01], progress=False)

    work(300)
    before = resident()
    work(1000)
    # A suite takes some 50 kB: 1000 of them would be 50 MB.
    assert resident() - before < 5_000_000
    kept = [dd.Record(samples[:50], 0.01) for _ in range(3000)]
    for record in kept:
        place_of(record)
    assert len({place_of(record) for record in kept}) == 3000
