"""Records: what they keep, and how files are read."""

import pickle
import re

import numpy as np
import pytest
from refusals import refused

import dondolo as dd


def test_kept_and_read_only():
    samples = np.array([0.0, -2.0, 1.0])
    record = dd.Record(samples, 0.5, name="short")
    samples[1] = 9.0
    assert record.peak_acceleration == 2.0
    assert record.duration == 1.0
    assert np.array_equal(record.time, [0.0, 0.5, 1.0])
    assert len(record) == 3
    with pytest.raises(ValueError, match="read-only"):
        record.acceleration[0] = 1.0
    with pytest.raises(AttributeError):
        record.dt = 0.1
    again = pickle.loads(pickle.dumps(record))
    assert np.array_equal(again.acceleration, record.acceleration)
    assert not again.acceleration.flags.writeable
    assert "short" in repr(record)
    assert "2 m/s2" in record._repr_html_()


@pytest.mark.parametrize("kind", [np.float32, np.int64, list])
def test_other_kinds_of_arrays(kind):
    values = [0, 1, -3, 2]
    record = dd.Record(values if kind is list else np.array(values, dtype=kind)[:], 0.01)
    assert record.acceleration.dtype == np.float64
    assert np.array_equal(record.acceleration, values)


def test_slices_are_made_contiguous():
    record = dd.Record(np.arange(20.0)[::3], 0.01)
    assert record.acceleration.flags.c_contiguous
    assert record.peak_acceleration == 18.0


@pytest.mark.parametrize(
    ("samples", "dt", "words"),
    [
        ([0.0, 1.0], 0.0, "time step dt = 0: must lie between"),
        ([0.0], 0.01, "number of samples = 1: must be at least 2"),
        ([0.0, np.nan], 0.01, "sample 2 = NaN m/s2"),
        ([[0.0, 1.0]], 0.01, "acceleration: must be one row"),
        (["a", "b"], 0.01, "acceleration: must be numbers"),
    ],
)
def test_errors(samples, dt, words):
    with pytest.raises(dd.errors.InputError, match=words):
        dd.Record(samples, dt)


def test_a_file(tmp_path):
    file = tmp_path / "motion è.txt"
    file.write_text("0.0\n0.5\n-1.0\n")
    record = dd.read_record(file, dt=0.01, units="g")
    assert record.name == "motion è"
    assert np.array_equal(record.acceleration, np.array([0.0, 0.5, -1.0]) * 9.80665)
    with pytest.raises(dd.errors.InputError, match="dt must be given"):
        dd.read_record(file, units="g")
    with pytest.raises(dd.errors.InputError, match="units must be given"):
        dd.read_record(file, dt=0.01)
    with pytest.raises(dd.errors.InputError, match="furlong"):
        dd.read_record(file, dt=0.01, units="furlong")


@pytest.mark.parametrize("end", ["\n", "\r\n", "\r", "\r\r\n", " \n", "\n\n", ",\n"])
@pytest.mark.parametrize("top", ["", "\ufeff", "\n", " ", "# units: m/s2\n", "a (m/s2)\n"])
@pytest.mark.parametrize("last", ["1.00000000", "-.5 \n\x1a", "1e-3", "x", "1.0 2.0", "1.0\n;", ""])
def test_a_single_column_is_read_as_columns_are(end, top, last, tmp_path):
    """A file without titles and comments is read in one go, with the same samples and sentences."""
    path = tmp_path / "a.txt"
    path.write_text(top + end.join(["0.12345678", "-0.00000000", "12.1234567890123456789", last]), newline="")

    def read(layout):
        try:
            record = dd.read_record(path, dt=0.01, units="m/s2", format=layout)
        except dd.errors.InputError as error:
            return str(error)
        return record.name, record.acceleration.tobytes(), record.metadata, record.peak_acceleration

    found = read(None)
    assert found == read("columns") or "the format is not known" in found


def test_every_record_has_an_array_of_its_own(root):
    """A record that is kept keeps no other, and a checked record says what one that is made says."""
    for record in dd.read_catalogue(root / "data/records/synthetic44.csv"):
        assert record.acceleration.base is None
        assert not record.acceleration.flags.writeable
        again = dd.Record(record.acceleration, record.dt)
        assert record.peak_acceleration == again.peak_acceleration
        assert record.checksum == again.checksum


def test_a_catalogue(records, root):
    assert len(records) == 44
    assert len({record.name for record in records}) == 44
    with pytest.raises(dd.errors.InputError, match=r"nothing\.csv"):
        dd.read_catalogue(root / "nothing.csv")


def test_recorded_accelerograms(recordings):
    records = dd.read_catalogue(recordings / "italy44.csv")
    assert len(records) == 44
    assert all(0.05 < record.peak_acceleration < 20.0 for record in records)


def test_channels(tmp_path):
    (tmp_path / "x.txt").write_text("0.1\n0.2\n0.3\n")
    (record,) = dd.read_records(tmp_path / "x.txt", dt=0.01, units="g")
    assert (
        dd.read_record(tmp_path / "x.txt", dt=0.01, units="g", channel=1).peak_acceleration == record.peak_acceleration
    )
    with pytest.raises(dd.errors.InputError, match="channel = '2': must be one of '1'"):
        dd.read_record(tmp_path / "x.txt", dt=0.01, units="g", channel=2)


COLUMNS = "#Station: TLM\ntime,acc N-S,acc E-W\n0,0.1,0.2\n0.01,-0.3,0.4\n0.02,0.2,-0.1\n"


def test_several_channels(tmp_path):
    file = tmp_path / "two.csv"
    file.write_text(COLUMNS)
    first, second = dd.read_records(file, units="g")
    assert first.name == "two.acc_N-S"
    assert first.metadata["channel"] == "acc N-S"
    assert second.peak_acceleration == 0.4 * 9.80665
    for channel in (2, "2", "acc E-W", "ACC E-W"):
        record = dd.read_record(file, units="g", channel=channel)
        assert np.array_equal(record.acceleration, second.acceleration)
    with pytest.raises(dd.errors.InputError, match=r"has 2 channels: channel must be one of 'acc N-S', 'acc E-W'"):
        dd.read_record(file, units="g")
    with pytest.raises(dd.errors.InputError, match="format = 'excel': must be one of 'peer'"):
        dd.read_records(file, units="g", format="excel")
    with pytest.raises(dd.errors.InputError, match=r"two\.csv: "):
        dd.read_record(file, units="g", channel=1, format="peer")


def test_metadata(tmp_path):
    file = tmp_path / "two.csv"
    file.write_bytes(COLUMNS.replace("TLM", "Trévi\tx").encode("latin-1"))
    record = dd.read_record(file, units="g", channel=1)
    assert list(record.metadata) == ["station", "format", "channel", "quantity"]
    assert record.metadata["station"] == "Trévi\tx"
    with pytest.raises(TypeError):
        record.metadata["station"] = "other"
    again = pickle.loads(pickle.dumps(record))
    assert again.metadata == record.metadata
    with pytest.raises(TypeError):
        again.metadata["station"] = "other"
    assert "station Tr" in repr(record)
    assert dict(dd.Record([0.0, 1.0], 0.1).metadata) == {}
    given = {"event": "Friuli"}
    record = dd.Record([0.0, 1.0], 0.1, metadata=given)
    given["event"] = "other"
    assert record.metadata["event"] == "Friuli"
    with refused("wrong_type", "metadata"):
        dd.Record([0.0, 1.0], 0.1, metadata="Friuli")


def test_metadata_of_a_case(tmp_path):
    (tmp_path / "two.csv").write_text(COLUMNS.replace("acc N-S", "acc N-S (g)"))
    (tmp_path / "one.txt").write_text("0\n1\n2\n")
    (tmp_path / "records.csv").write_text("file,channel,dt_s,units\none.txt,,0.01,g\ntwo.csv,1,,\n")
    (tmp_path / "case.nml").write_text(
        "&job task='stripes' output='x' /\n&wall name='w' mechanism='one_sided' height=1 thickness=0.2 /\n"
        "&records catalogue='records.csv' /\n&stripes levels=0.1 /\n"
    )
    one, two = dd.read_case(tmp_path / "case.nml").records
    assert dict(one.metadata) == {"format": "columns", "quantity": "acceleration"}
    assert two.metadata["station"] == "TLM"
    assert two.metadata["units"] == "g"
    assert two.peak_acceleration == 0.3 * 9.80665


@pytest.mark.parametrize("between", ["\t", "  "])
def test_titles_with_blanks_state_their_units(between, tmp_path):
    values = "".join(f"{0.01 * i:.2f}{between}{value}\n" for i, value in enumerate((0, 100, -50)))
    path = tmp_path / "record.txt"
    path.write_text(f"Time (s){between}Acc (gal)\n{values}")
    assert dd.read_record(path).peak_acceleration == pytest.approx(1.0)
    with pytest.raises(dd.errors.InputError, match="units"):
        dd.read_record(path, units="g")
    path.write_text(f"Tempo (s){between}Velocita (cm/s)\n{values}")
    with pytest.raises(dd.errors.InputError, match="is not an acceleration"):
        dd.read_record(path, units="g")


@pytest.mark.parametrize(
    "title", ["T [s];Se [g]", "T (s);Se(T) (g)", "Periodo;Accelerazione (g)", "T (s);SLV orizz. (g)"]
)
def test_spectra_are_no_records(title, tmp_path):
    (tmp_path / "spectrum.csv").write_text(f"{title}\n0.00;0.2\n0.01;0.3\n0.02;0.4\n")
    with pytest.raises(dd.errors.InputError, match=r"is not an acceleration|must be in s"):
        dd.read_record(tmp_path / "spectrum.csv")


class Quantity:
    """A number with a unit, as packages of units make it."""

    def __init__(self, value: float, units: str) -> None:
        self.value, self.units = value, units

    def __float__(self) -> float:
        return self.value


class Column(np.ndarray):
    """Numbers with what pandas and xarray say of them."""

    attrs: dict[str, str]
    name: str | None


def column(values, name=None, **attrs):
    made = np.asarray(values).view(Column)
    made.attrs, made.name = attrs, name
    return made


@pytest.mark.parametrize("unit", ["cm/s2", "gal", "g"])
def test_units_of_numbers_and_columns_are_not_stripped(unit):
    samples = [0.0, 10.0, -20.0]
    quantities = np.array([Quantity(one, unit) for one in samples], dtype=object)
    for given in (quantities, list(quantities), column(samples, units=unit), column(samples, f"acc NS ({unit})")):
        for wrong in ({"acceleration": given}, {"acceleration": samples, "vertical": given}):
            with pytest.raises(dd.errors.InputError, match=f"has the unit '{unit}': must be plain numbers"):
                dd.Record(dt=0.01, **wrong)


@pytest.mark.parametrize("unit", ["m/s2", "m/s^2", "m/s**2", "m/s/s", "m s-2", "m/sec2", "m/s²"])
def test_columns_in_the_unit_of_records(unit):
    samples = [0.0, 10.0, -20.0]
    for given in (column(samples, units=unit), column(samples, f"acc [{unit}]"), column(samples, "acc (NS)")):
        assert dd.Record(given, 0.01).peak_acceleration == 20.0
    assert dd.Record(np.array(samples, dtype=object), 0.01).peak_acceleration == 20.0


def test_control_characters_reach_no_document(tmp_path):
    """Headers lose them when they are read, arguments are refused by the name of the key; tabs and accents stay."""
    path = tmp_path / "a.txt"
    samples = "".join(f"{0.1 * (i % 7) - 0.3:.3f}\n" for i in range(200))
    path.write_text("# station: Pi\x1bove\tdi \x7fCadore\n# event: Fri\u202euli \u00e8\n" + samples, encoding="utf-8")
    (record,) = dd.read_records(path, dt=0.01, units="m/s2")
    assert record.metadata["station"] == "Pi ove\tdi  Cadore"
    assert record.metadata["event"].split() == ["Fri", "uli", "\u00e8"]
    for wrong, shown in (("a\x0bb", r"\x0b"), ("\ud800", r"\ud800"), ("a\uffff", r"\uffff"), ("\x00", r"\x00")):
        with pytest.raises(dd.errors.InputError, match=r"metadata\['event'\]: has " + re.escape(shown)):
            dd.Record([0.0, 1.0], 0.01, metadata={"event": wrong})
        with pytest.raises(dd.errors.InputError, match="must be"):
            dd.Record([0.0, 1.0], 0.01, name=wrong)
    assert (
        dd.Record([0.0, 1.0], 0.01, metadata={"note": "two\nlines, \u00a0\tand"}).metadata["note"].startswith("two\n")
    )
