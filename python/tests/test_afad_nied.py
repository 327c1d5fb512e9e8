"""Text files of AFAD (Turkey) and tables of NIED (Japan): the layout of the real ones, other numbers."""

import numpy as np
import pytest

import dondolo as dd

N = 120
NS, EW, UD = (
    np.round(scale * np.sin(0.3 * np.arange(N) + shift) * np.exp(-0.03 * np.arange(N)), 4)
    for scale, shift in ((80.0, 0.0), (-60.0, 1.0), (20.0, 2.0))
)


def _afad(rows=N, step="SAMPLING INTERVAL (sec) : 0.01\n", layout="{:13.6f}", offset=0.0, factor=1.0):
    # Peaks of raw values are those about their mean
    peaks = " ".join(
        f"({name}) {np.abs(values - (values.mean() if offset else 0.0)).max():.6f}"
        for name, values in (("N-S", NS), ("E-W", EW), ("U-D", UD))
    )
    data = "".join(
        "".join(layout.format(factor * (value + offset)) for value in row) + "\n"
        for row in zip(NS, EW, UD, strict=True)
    )
    return (
        "STRONG GROUND MOTION RECORDS OF TURKIYE\nPLACE                   : SOMEWHERE\n"
        "EARTHQUAKE DATE         : 12/11/2032 21:22:23 (GMT)\nEARTHQUAKE MAGNITUDE    : 5.4 Mw\n"
        "STATION ID              : 4401\nSTATION COORDINATES     : 38.35000N-38.34000E\n"
        f"NUMBER OF DATA          : {rows}\n{step}RAW PGA VALUES (gal)    : {peaks}\n"
        f"DATA TYPE               : RAW\n       N-S          E-W          U-D\n{data}"
    )


def _read(tmp_path, content):
    path = tmp_path / "record.txt"
    path.write_text(content)
    return dd.read_records(path)


def test_afad(tmp_path):
    records = _read(tmp_path, _afad())
    assert [record.metadata["component"] for record in records] == ["N-S", "E-W", "U-D"]
    for record, values in zip(records, (NS, EW, UD), strict=True):
        assert record.dt == 0.01
        assert np.allclose(record.acceleration, 0.01 * values, rtol=1e-12)
        assert record.metadata["format"] == "afad"
        assert record.metadata["station"] == "4401"
        assert record.metadata["magnitude"] == "5.4"
        assert record.metadata["latitude"] == "38.35000"
    # Raw values with an offset, and columns that touch
    (first, *_) = _read(tmp_path, _afad(offset=900.0))
    assert np.allclose(first.acceleration, 0.01 * (NS + 900.0), rtol=1e-12)
    (first, *_) = _read(tmp_path, _afad(layout="{:9.5f}", rows=N))
    assert np.allclose(first.acceleration, 0.01 * NS, rtol=1e-9)
    # A rate in place of the interval
    assert _read(tmp_path, _afad(step="SAMPLING RATE (Hz) : 100\n"))[0].dt == 0.01
    with pytest.warns(dd.errors.DondoloWarning, match="ignored 2 samples beyond the 118 stated in the file"):
        records = _read(tmp_path, _afad(rows=N - 2))
    assert len(records[0].acceleration) == N - 2


@pytest.mark.parametrize(
    ("content", "sentence"),
    [
        (_afad(rows=N + 1), "120 rows of values: the header states 121"),
        (_afad(rows=N - 3), "120 rows of values: the header states 117"),
        (_afad(factor=2.0), "peak value"),
        (_afad(step=""), "SAMPLING INTERVAL .sec. = '': must be a positive number"),
        (_afad(step="SAMPLING INTERVAL (sec) : 0.01\nSAMPLING RATE (Hz) : 50\n"), "states a rate of 50 samples"),
        (_afad()[:-4], "the file is cut off: its last value"),
        (_afad()[:-30], "the file ends after|rows of values"),
        (_afad().replace("(gal)", "(cm)"), "units = 'cm'"),
    ],
)
def test_afad_refused(content, sentence, tmp_path):
    with pytest.raises(dd.errors.InputError, match=sentence):
        _read(tmp_path, content)


def _nied(rate=100, stamps=None, titles="# Time, N-S(gal), E-W(gal), U-D(gal)\n", start=58.0):
    # Across midnight
    times = [start + i / 100.0 for i in range(N)]
    stamps = stamps or [
        f"2032/12/31 23:59:{t:05.2f}" if t < 60.0 else f"2033/01/01 00:00:{t - 60.0:05.2f}" for t in times
    ]
    rows = "".join(f"{t},{a:.4f},{b:.4f},{c:.4f}\n" for t, a, b, c in zip(stamps, NS, EW, UD, strict=True))
    return (
        "# Origin Time, 2032/12/31 23:59:30\n# Station Code, ABC007\n# Station Lat., 35.5\n"
        f"# Sampling Freq(Hz), {rate}\n{titles}{rows}"
    )


def test_nied(tmp_path):
    for content in (_nied(), _nied(stamps=[f"{0.01 * i:.2f}" for i in range(N)]), _nied(rate="100Hz")):
        records = _read(tmp_path, content)
        assert [record.metadata["component"] for record in records] == ["N-S", "E-W", "U-D"]
        for record, values in zip(records, (NS, EW, UD), strict=True):
            assert record.dt == 0.01
            assert np.allclose(record.acceleration, 0.01 * values, rtol=1e-12)
            assert record.metadata["format"] == "nied"
            assert record.metadata["date"] == "2032-12-31T23:59:30+09:00"
            assert record.metadata["station"] == "ABC007"


@pytest.mark.parametrize(
    ("content", "sentence"),
    [
        (_nied(rate=50), "the step of the times is 0.01 s: Sampling Freq.Hz. = 50"),
        (_nied(rate="x"), "Sampling Freq.Hz. = 'x': must be positive"),
        (_nied().replace("2032/12/31 23:59:58.50,", "2032/12/31 23:59:58.57,"), "times must"),
        (_nied().replace("2032/12/31 23:59:58.50,", "2032/12/31 24:59:58.50,"), "must be a time"),
        (_nied()[:-3], "the file is cut off"),
        (_nied(titles="# Time, N-S(cm/s), E-W(cm/s), U-D(cm/s)\n"), "is not an acceleration"),
        (_nied() + "2033/01/01 00:00:00.00,1.0\n", "2 values: must be 4"),
    ],
)
def test_nied_refused(content, sentence, tmp_path):
    with pytest.raises(dd.errors.InputError, match=sentence):
        _read(tmp_path, content)
