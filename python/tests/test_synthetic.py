"""Synthetic records: the same as the executable's, and on average what the model says."""

import numpy as np
import pytest
from sabetta_pugliese import Model, mean_frequency

import dondolo as dd

SCENARIOS = [(5.8, 8.0, "rock"), (5.0, 15.0, "deep"), (6.5, 20.0, "shallow")]


@pytest.fixture(scope="module", params=SCENARIOS, ids=lambda scenario: "{}-{}-{}".format(*scenario))
def many(request):
    """200 realisations, and their model."""
    return dd.synthetic_records(*request.param, n_records=200, seed=2024), Model(*request.param)


def test_the_same_stream_as_the_suite(records):
    # Scenario 4 of the suite is Friuli, 15 September 1976: streams 6 and 7 of its seed; files have 10 decimals.
    made = dd.synthetic_records(6.0, 8.0, "shallow", n_records=2, seed=19722016, first=6)
    for record, stored in zip(made, records[6:8], strict=True):
        assert "friuli_1976_sep_15" in stored.name
        assert record.dt == stored.dt
        np.testing.assert_allclose(record.acceleration, stored.acceleration, rtol=0.0, atol=1e-10)


def test_seeds():
    five = dd.synthetic_records(6.0, 10.0, "rock", n_records=5, seed=7)
    rest = dd.synthetic_records(6.0, 10.0, "rock", n_records=3, seed=7, first=2)
    for record, again in zip(five[2:], rest, strict=True):
        assert np.array_equal(record.acceleration, again.acceleration)
        assert record.name == again.name
    assert len({record.name for record in five}) == 5
    assert five[0].name == "synthetic_m6_r10_rock_7_0"
    (other,) = dd.synthetic_records(6.0, 10.0, "rock", seed=8)
    assert not np.array_equal(other.acceleration, five[0].acceleration)


def test_metadata():
    record = dd.synthetic_records(6.5, 12.25, "deep", n_records=2, seed=7, first=3, deviations=-0.5)[1]
    assert dict(record.metadata) == {
        "event": record.name,
        "magnitude": "6.5",
        "distance_km": "12.25",
        "site": "deep",
        "seed": "7",
        "realisation": "4",
        "deviations": "-0.5",
        "format": "synthetic",
    }


def test_a_catalogue_keeps_what_was_computed(tmp_path):
    """Records that are synthetic are so in a catalogue too, and in what is made of it; recorded ones are not."""
    made = dd.synthetic_records(6.5, 10.0, "shallow", n_records=2)
    other = dd.Record(made[0].acceleration, made[0].dt, name="of an array")
    dd.RecordSet([*made, other]).to_catalogue(tmp_path / "records.csv")
    again = dd.read_catalogue(tmp_path / "records.csv")
    assert [record.metadata["format"] for record in again] == ["synthetic", "synthetic", "columns"]
    assert {record.metadata["format"] for record in dd.example_records()} == {"synthetic"}
    case = tmp_path / "case.nml"
    case.write_text(
        "&job task = 'stripes' output = 'result' /\n&wall mechanism = 'one_sided' height = 3.0 thickness = 0.25 /\n"
        "&records catalogue = 'records.csv' /\n&stripes levels = 0.3, 0.5 /\n",
        encoding="utf-8",
    )
    run = dd.run_case(case, progress=False)
    assert run.stripes.record_formats == ("synthetic", "synthetic", "columns")
    for lang, words in (("en", "2 of 3 records are synthetic"), ("it", "2 accelerogrammi su 3 sono sintetici")):
        dd.report(run, tmp_path / f"{lang}.html", lang=lang)
        assert words in (tmp_path / f"{lang}.html").read_text(encoding="utf-8")


def test_energy(many):
    records, model = many
    energy = np.array([record.dt * record.acceleration @ record.acceleration for record in records])
    # What the length of the record, the high-pass and Nyquist's frequency leave of the model's energy
    frequency = np.arange(1, int(100.0 * model.length)) / model.length
    time = (np.arange(400) + 0.5) / 400.0 * model.length
    kept = [model.spectrum(t, frequency).sum() / model.length for t in time]
    expected = model.power(time) @ kept * model.length / 400.0
    error = energy.std(ddof=1) / np.sqrt(len(energy))
    assert abs(energy.mean() - expected) < 4.0 * error
    assert expected == pytest.approx(model.energy, rel=0.02)


def test_duration(many):
    records, model = many
    husid = np.mean([np.cumsum(record.acceleration**2) for record in records], axis=0)
    husid /= husid[-1]
    time = records[0].time
    for part in (0.05, 0.25, 0.5, 0.75, 0.95):
        assert np.interp(part, husid, time) == pytest.approx(model.time_of(part), rel=0.03)


def test_central_frequency(many):
    records, model = many
    for time in (model.time_of(0.3), model.time_of(0.6), model.time_of(0.9)):
        width = 2.0
        # The mean of the model over the window
        around = time + width * (np.arange(101) - 50) / 101.0
        weight = np.cos(np.pi * (around - time) / width) ** 4 * model.power(around)
        expected = weight @ model.frequency(around) / weight.sum()
        assert mean_frequency(records, time, width) == pytest.approx(expected, rel=0.04)


def test_the_end_is_still(many):
    records, _ = many
    for record in records[:20]:
        speed = record.dt * np.cumsum(record.acceleration)
        assert abs(speed[-1]) < 2e-3 * np.abs(speed).max()


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ((3.0, 10.0, "rock"), "magnitude = 3: must be between 4 and 7.5"),
        ((6.0, 200.0, "rock"), "distance = 200 km: must be between 0 and 150"),
        ((6.0, 10.0, "clay"), "site = 'clay': must be one of"),
        ((6.0, 10.0, 3), "site = 3: must be a string"),
        ((6.0, 10.0, "rock", {"n_records": 0}), "n_records = 0: must be an integer, between 1 and"),
        ((6.0, 10.0, "rock", {"seed": 0}), "seed = 0: must be an integer, between 1 and"),
        ((6.0, 10.0, "rock", {"first": -1}), "first = -1: must be an integer, between 0 and"),
        ((6.0, 10.0, "rock", {"n_records": 3, "first": 2**31 - 2}), "realisations must have numbers below 2147483648"),
        ((6.0, 10.0, "rock", {"deviations": 4.0}), "deviations = 4: must be between -3 and 3"),
    ],
)
def test_errors(arguments, words):
    magnitude, distance, site, *options = arguments
    with pytest.raises(dd.errors.InputError, match=words):
        dd.synthetic_records(magnitude, distance, site, **dict(*options))


def test_deviations_raise_the_energy():
    median, above = (dd.synthetic_records(6.0, 10.0, "rock", n_records=100, deviations=k) for k in (0.0, 1.0))
    energy, more = (np.mean([record.acceleration @ record.acceleration for record in some]) for some in (median, above))
    # 0.397 is the standard deviation of the model's decimal logarithm; each mean is known to about 1 %.
    assert more / energy == pytest.approx(10.0**0.397, rel=0.06)
    assert above[0].duration > median[0].duration
