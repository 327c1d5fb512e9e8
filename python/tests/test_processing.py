"""Processing of records: closed forms, exactness, and the history that every record keeps."""

import pickle
from functools import partial

import numpy as np
import pytest
from refusals import refused

import dondolo as dd


def noise(count=2000, dt=0.01, seed=3, name="noise"):
    """A record of random samples that begins and ends at zero."""
    values = np.random.default_rng(seed).standard_normal(count)
    values[[0, -1]] = 0.0
    return dd.Record(values, dt, name)


def impulse(count, dt, place):
    values = np.zeros(count)
    values[place] = 1.0
    return dd.Record(values, dt)


def test_history_is_kept():
    record = noise()
    before = record.acceleration.copy()
    assert record.processing == ()
    done = record.correct_baseline().reverse()
    assert done.processing == ("baseline: mean taken off", "reversed polarity")
    assert done.name == record.name
    assert record.processing == ()
    assert np.array_equal(record.acceleration, before)
    assert pickle.loads(pickle.dumps(done)).processing == done.processing
    assert "reversed polarity" in repr(done)
    assert "reversed polarity" in done._repr_html_()
    own = done.processed(done.acceleration * 2.0, "doubled")
    assert own.processing[-1] == "doubled"
    assert own.dt == done.dt
    assert dd.Record([0.0, 1.0], 0.1, processing="one step").processing == ("one step",)
    with pytest.raises(dd.errors.InputError, match=r"processing = 'one\\ntwo': must be one line"):
        dd.Record([0.0, 1.0], 0.1, processing=["one\ntwo"])


def test_baseline():
    record = noise()
    constant = dd.Record(record.acceleration + 0.3, record.dt)
    assert constant.correct_baseline().acceleration.mean() == pytest.approx(0.0, abs=1e-14)
    line = dd.Record(record.acceleration + 0.3 - 0.01 * record.time, record.dt)
    for what in (record, line):
        left = what.correct_baseline("linear")
        assert left.acceleration @ np.ones(len(left)) == pytest.approx(0.0, abs=1e-9)
        assert left.acceleration @ left.time == pytest.approx(0.0, abs=1e-8)
    # The line is not seen at all
    both = [what.correct_baseline("linear").acceleration for what in (record, line)]
    np.testing.assert_allclose(*both, atol=1e-12)


@pytest.mark.parametrize("order", [1, 2])
def test_baseline_of_the_velocity(order):
    record = noise()
    # A drift of the velocity of this degree, which samples and chords hold exactly
    drift = 0.2 * record.time ** (order - 1)
    both = [
        dd.Record(record.acceleration + shift, record.dt).correct_baseline("velocity", order=order)
        for shift in (0.0, drift)
    ]
    np.testing.assert_allclose(both[0].acceleration, both[1].acceleration, atol=1e-11)
    # What is left of the velocity has no part in the polynomial: it is orthogonal to its powers.
    left, time = both[1].velocity, record.time
    for power in range(1, order + 1):
        assert left @ time**power == pytest.approx(0.0, abs=1e-7 * np.abs(left) @ time**power)
    assert f"degree {order}" in both[0].processing[-1]


def test_velocity_is_that_of_the_chords():
    record = dd.Record([0.0, 2.0, 0.0, -4.0], 0.5)
    np.testing.assert_allclose(record.velocity, [0.0, 0.5, 1.0, 0.0])


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ({"kind": "cubic"}, "kind = 'cubic': must be one of"),
        ({"kind": "linear", "order": 2}, "order = 2: only with kind 'velocity'"),
        ({"kind": "velocity", "order": 0}, "order = 0: must be an integer, between 1 and 8"),
    ],
)
def test_baseline_errors(arguments, words):
    with pytest.raises(dd.errors.InputError, match=words):
        noise().correct_baseline(**arguments)


@pytest.mark.parametrize(("low", "high"), [(0.5, 20.0), (0.5, None), (None, 20.0)])
@pytest.mark.parametrize("order", [2, 4])
def test_gain_of_the_filter(low, high, order):
    dt, count = 0.01, 8001
    record = impulse(count, dt, count // 2)
    response = record.band_pass(low, high, order=order, taper=0.0)
    # Zero phase: the answer to an impulse is symmetric in time.
    np.testing.assert_allclose(response.acceleration, response.acceleration[::-1], atol=1e-14)
    frequency = np.fft.rfftfreq(count, dt)
    gain = np.abs(np.fft.rfft(response.acceleration))
    # Butterworth's gain, with frequencies as the bilinear transform bends them; squared by the second pass
    bent = np.tan(np.pi * frequency * dt)
    with np.errstate(divide="ignore"):
        if low and high:
            first, last = np.tan(np.pi * low * dt), np.tan(np.pi * high * dt)
            ratio = (bent**2 - first * last) / (bent * (last - first))
        elif low:
            ratio = np.tan(np.pi * low * dt) / bent
        else:
            ratio = bent / np.tan(np.pi * high * dt)
    np.testing.assert_allclose(gain, 1.0 / (1.0 + ratio ** (2 * order)), atol=1e-7)
    for corner in (low, high):
        if corner:
            assert np.interp(corner, frequency, gain) == pytest.approx(0.5, abs=2e-3)


def test_filter_does_not_know_the_direction_of_time():
    record = noise()
    forwards = record.band_pass(0.5, 20.0).acceleration
    backwards = dd.Record(record.acceleration[::-1], record.dt).band_pass(0.5, 20.0).acceleration[::-1]
    np.testing.assert_allclose(forwards, backwards, atol=1e-9)


def test_padding():
    record = noise()
    short = record.band_pass(0.5, 20.0)
    long = record.band_pass(0.5, 20.0, keep_padding=True)
    pad = 1200  # 1.5 times order 4 over 0.5 Hz are 12 s
    assert len(short) == len(record)
    assert len(long) == len(record) + 2 * pad
    assert np.array_equal(long.acceleration[pad:-pad], short.acceleration)
    assert short.processing == (
        "band-pass 0.5-20 Hz, Butterworth order 4, zero phase (two passes), taper 5 %, 12 s of zeros at each end, "
        "cut off again",
    )
    assert long.processing[0].endswith("kept")
    # A band-pass has no gain at zero frequency: with its pads the motion ends still.
    assert abs(long.velocity[-1]) < 1e-6 * np.abs(long.velocity).max()
    # The taper brings the ends to zero, and it alone is what differs.
    ends = dd.Record(np.ones(2000), 0.01)
    tapered = ends.band_pass(None, 20.0, taper=0.1)
    assert abs(tapered.acceleration[0]) < 1e-3 < 0.4 < abs(ends.band_pass(None, 20.0, taper=0.0).acceleration[0])


@pytest.mark.parametrize("part", [0.02, 0.1, 0.5])
def test_taper_is_half_a_cosine(part):
    """The window rises from 0 at either end to 1 at the given part of the duration."""
    record = noise()
    time, length = record.time, part * record.duration
    to_end = np.minimum(time, record.duration - time)
    window = np.where(to_end < length, 0.5 - 0.5 * np.cos(np.pi * to_end / length), 1.0)
    by_hand = dd.Record(window * record.acceleration, record.dt)
    tapered = record.band_pass(0.5, 20.0, taper=part).acceleration
    np.testing.assert_allclose(tapered, by_hand.band_pass(0.5, 20.0, taper=0.0).acceleration, atol=1e-12)


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ((0.5, 50.0), "high = 50 Hz: must be positive and below 50 Hz, Nyquist's frequency"),
        ((0.0, 20.0), "low = 0 Hz: must be positive"),
        ((5.0, 1.0), "low = 5, high = 1 Hz: must increase"),
        ((None, None), "one of them must be given"),
        ((0.001, 20.0), "low = 0.001 Hz: its period must not exceed ten times"),
        ((0.5, 20.0, {"order": 0}), "order = 0: must be an integer, between 1 and 10"),
        ((0.5, 20.0, {"taper": 0.6}), "taper = 0.6: must lie between 0 and 0.5"),
        (("a", 20.0), "low = 'a': must be a number"),
        ((0.5, 20.0, {"keep_padding": "no"}), "keep_padding = 'no': must be True or False"),
    ],
)
def test_filter_errors(arguments, words):
    low, high, *options = arguments
    with pytest.raises(dd.errors.InputError, match=words):
        noise().band_pass(low, high, **dict(*options))


def test_resampling_is_exact_where_the_step_divides(wall, records):
    record = noise(400)
    fine = record.resample(0.0025)
    assert fine.dt == 0.0025
    assert np.array_equal(fine.acceleration[::4], record.acceleration)
    np.testing.assert_allclose(fine.acceleration, np.interp(fine.time, record.time, record.acceleration), atol=1e-13)
    assert fine.processing == ("resampled from 0.01 to 0.0025 s, linear between the samples (exact)",)
    motions = [dd.simulate(wall, what, 2.0, history=False) for what in (records[6], records[6].resample(0.001))]
    assert 0.1 < motions[0].edp < 1.0
    assert motions[1].edp == pytest.approx(motions[0].edp, rel=1e-9)
    same = record.resample(0.01)
    assert np.array_equal(same.acceleration, record.acceleration)


def test_polyphase_resampling():
    time = 0.005 * np.arange(8001)
    slow, fast = np.sin(2.0 * np.pi * 1.0 * time), np.sin(2.0 * np.pi * 40.0 * time)
    for dt in (0.02, 0.012):
        # 40 Hz are beyond half of 50 and nearly of 83 samples a second: what is above 41.7 Hz goes
        done = dd.Record(slow, 0.005).resample(dt)
        inner = (done.time > 5.0) & (done.time < 35.0)
        np.testing.assert_allclose(done.acceleration[inner], np.sin(2.0 * np.pi * done.time[inner]), atol=2e-3)
        assert done.dt == pytest.approx(dt, rel=1e-15)
        assert done.duration <= 40.0 < done.duration + dt
        assert "polyphase" in done.processing[0]
        assert "anti-aliasing" in done.processing[0]
    done = dd.Record(slow + fast, 0.005).resample(0.02)
    inner = (done.time > 5.0) & (done.time < 35.0)
    np.testing.assert_allclose(done.acceleration[inner], np.sin(2.0 * np.pi * done.time[inner]), atol=2e-3)


@pytest.mark.parametrize(
    ("dt", "words"),
    [
        (0.0, "dt = 0 s: must be positive"),
        (np.pi / 300.0, "ratio to the record's 0.01 s must be a ratio of integers"),
        (30.0, "must not exceed the duration"),
        (1e-9, "must not be less than a thousandth of the record's 0.01 s"),
        (0.0095e-3, "must not be less than a thousandth of the record's 0.01 s"),
    ],
)
def test_resampling_errors(dt, words):
    with pytest.raises(dd.errors.InputError, match=words):
        noise().resample(dt)


def test_resampling_keeps_to_its_limits():
    assert len(noise(11).resample(1e-5)) == 10001
    with pytest.raises(dd.errors.InputError, match="nor make more than 100000000 samples"):
        noise(200_001).resample(1e-5)


def test_significant_times_follow_the_cubic(records):
    # A ramp from 0 to 1 in one step: the integral grows with the cube of the time.
    ramp = dd.Record([0.0, 1.0], 2.0)
    np.testing.assert_allclose(ramp.significant_times(low=0.001, high=0.125), [0.2, 1.0], rtol=1e-12)
    for record in records[:3]:
        first, last = record.significant_times(low=0.05, high=0.95)
        assert last - first == record.intensity("d5-95")
    # Rest before and after the motion, also where the sum of the steps rounds
    still = np.zeros(50)
    for seed in range(20):
        padded = dd.Record(np.concatenate([still, noise(777, seed=seed).acceleration, still]), 0.01)
        np.testing.assert_allclose(padded.significant_times(low=0.0, high=1.0), [0.5, 8.26], atol=1e-5)


@pytest.mark.parametrize("parts", [(0.9, 0.1), (0.5, 0.5), (np.nan, 1.0), (0.0, np.nan), (-1.0, 2.0)])
def test_parts_of_the_significant_duration(records, parts):
    low, high = parts
    for function in (records[0].significant_times, records[0].trim):
        with pytest.raises(dd.errors.InputError, match="must increase, between 0 and 1"):
            function(low=low, high=high)


def test_trimming():
    # Arias' integral of a constant grows evenly: 5 % of it are 5 % of the time.
    record = dd.Record(np.concatenate([np.zeros(300), np.ones(1001), np.zeros(700)]), 0.01)
    done = record.trim(before=0.0, after=0.0)
    assert done.duration == pytest.approx(9.0, abs=0.021)
    assert done.processing[0].startswith("trimmed to 3.49-12.51 s: 5-95 % of Arias' integral")
    wide = record.trim(low=0.05, high=0.95, before=2.0, after=1.5)
    assert wide.duration == pytest.approx(12.5, abs=0.021)
    assert record.trim(low=0.0, high=1.0, before=50.0, after=50.0).duration == record.duration
    whole = record.trim(low=0.0, high=1.0, before=0.0, after=0.0)
    assert whole.duration == pytest.approx(10.02, abs=1e-9)
    with pytest.raises(dd.errors.InputError, match="has no motion"):
        dd.Record(np.zeros(10), 0.1).trim()
    with pytest.raises(dd.errors.InputError, match=r"low = 0\.9, high = 0\.1: must increase"):
        record.trim(low=0.9, high=0.1)
    with pytest.raises(dd.errors.InputError, match="before = -1 s: must not be negative"):
        record.trim(before=-1.0)


def test_reversed_polarity(wall, records):
    record = records[6]
    motion = dd.simulate(wall, record.reverse(), 2.0, history=False)
    assert motion.edp == dd.simulate(wall, record, -2.0, history=False).edp
    assert np.array_equal(record.reverse().reverse().acceleration, record.acceleration)


def test_rotation():
    first, second = noise(seed=1, name="x"), noise(seed=2, name="y")
    for angle, expected in ((0.0, first), (90.0, second), (180.0, first.reverse()), (-90.0, second.reverse())):
        assert np.array_equal(first.rotate(second, angle).acceleration, expected.acceleration)
    one, other = first.rotate(second, 33.0), first.rotate(second, 123.0)
    energy = first.acceleration**2 + second.acceleration**2
    np.testing.assert_allclose(one.acceleration**2 + other.acceleration**2, energy, rtol=1e-12)
    assert one.processing == ("component at 33 degrees from 'x' towards 'y'",)
    steps = first.reverse().rotate(second, 10.0).processing
    assert steps[0] == "x: reversed polarity"
    steps = first.reverse().rotate(second.reverse(), 10.0).processing
    assert steps[0] == "reversed polarity"


def test_directions_of_a_line_and_a_circle():
    time = 0.001 * np.arange(2001)
    wave = np.sin(2.0 * np.pi * time)
    line = dd.Record(3.0 * wave, 0.001).rotd(dd.Record(4.0 * wave, 0.001), n_angles=3600)
    assert line.rotd100 == pytest.approx(5.0 / 9.81, rel=1e-6)
    assert line.angle == pytest.approx(np.degrees(np.arctan2(4.0, 3.0)), abs=0.05)
    # |cos| is above its value at 45 degrees in half of all directions.
    assert line.rotd50 == pytest.approx(5.0 * np.sqrt(0.5) / 9.81, rel=1e-3)
    circle = dd.Record(wave, 0.001).rotd(dd.Record(np.cos(2.0 * np.pi * time), 0.001))
    assert circle.rotd50 == pytest.approx(1.0 / 9.81, rel=1e-5)
    assert circle.rotd100 == pytest.approx(1.0 / 9.81, rel=1e-5)
    assert len(circle.values) == len(circle.angles) == 180


def test_directions_do_not_know_the_sensor(records):
    first, second = records[6], records[7]
    assert len(first) == len(second)
    turned = [first.rotate(second, angle) for angle in (37.0, 127.0)]
    one, other = first.rotd(second), turned[0].rotd(turned[1])
    assert other.rotd50 == pytest.approx(one.rotd50, rel=1e-12)
    assert other.rotd100 == pytest.approx(one.rotd100, rel=1e-12)
    assert one.rotd100 >= max(record.intensity("pga") for record in (first, second))
    assert (one.angle - other.angle) % 180.0 == pytest.approx(37.0)
    by_measure = first.rotd(second, lambda record: record.peak_acceleration)
    assert by_measure.rotd50 / 9.81 == pytest.approx(one.rotd50, rel=1e-14)
    assert by_measure.angle == one.angle
    # The energy of a direction has its mean for its median, and the greater root of the covariance for its largest.
    energy = first.rotd(second, lambda record: float(record.acceleration @ record.acceleration), n_angles=720)
    matrix = np.cov(first.acceleration, second.acceleration, bias=True) * len(first)
    assert energy.rotd100 == pytest.approx(np.linalg.eigvalsh(matrix)[-1], rel=1e-4)
    assert energy.rotd50 == pytest.approx(0.5 * np.trace(matrix), rel=1e-3)


def test_pairs_that_do_not_belong_together():
    with pytest.raises(dd.errors.InputError, match="2000 and 1000 samples: must be as many"):
        noise().rotate(noise(1000), 10.0)
    with pytest.raises(dd.errors.InputError, match=r"dt = 0\.01 and 0\.02 s: must be the same"):
        noise().rotd(noise(dt=0.02))
    with refused("wrong_type", "record"):
        noise().rotate(np.zeros(3), 10.0)
    with pytest.raises(dd.errors.InputError, match="measure: must be a number in every direction"):
        noise().rotd(noise(), lambda record: np.nan)
    with pytest.raises(dd.errors.InputError, match="angle = nan"):
        noise().rotate(noise(), np.nan)
    with pytest.raises(dd.errors.InputError, match="measure = 3: must be the name of a measure or a function"):
        noise().rotd(noise(), 3)
    with pytest.raises(dd.errors.InputError, match="im = 'x': must be one of"):
        noise().rotd(noise(), "x")


def known(**metadata):
    """A record with metadata."""
    return dd.Record(noise().acceleration, 0.01, metadata=metadata)


@pytest.mark.parametrize("combine", [partial(dd.Record.rotate, angle=30.0), dd.Record.rotd], ids=["rotate", "rotd"])
def test_metadata_of_components(combine):
    combine(known(station="AQV", date="2009-04-06", component="HNE"), known(station="AQV", component="HNN"))
    for one, other in (("N-S", "E-W"), ("090", "360"), ("DUZCE-270", "DUZCE-180"), ("S00E", "L")):
        combine(known(component=one), known(component=other))
    with pytest.raises(dd.errors.InputError, match="station = 'AQV' and 'AQK': must be the same"):
        combine(known(station="AQV"), known(station="AQK"))
    with pytest.raises(dd.errors.InputError, match="date = '2009-04-06' and '2009-04-07': must be the same"):
        combine(known(date="2009-04-06"), known(date="2009-04-07"))
    with pytest.raises(dd.errors.InputError, match="event = 'Hill' and 'Dale': must be the same"):
        combine(known(event="Hill"), known(event="Dale"))
    for vertical in (
        "U",
        "UP",
        "Up",
        "UD",
        "U-D",
        "UD1",
        "Z",
        "V",
        "VERT",
        "vertical",
        "HNZ",
        "HGZ",
        "ICC-UP",
        "+UP",
        "D",
        "BHZ00",
    ):
        for pair in ((vertical, "HNE"), ("HNE", vertical)):
            with pytest.raises(dd.errors.InputError, match="is vertical, must be horizontal"):
                combine(*(known(component=component) for component in pair))


def test_a_vertical_component_is_of_the_same_day():
    assert known(date="2009-04-06").with_vertical(known(date="2009-04-06", component="UP")).vertical is not None
    with pytest.raises(dd.errors.InputError, match="date = '2009-04-06' and '2009-05-06': must be the same"):
        known(date="2009-04-06").with_vertical(known(date="2009-05-06"))
