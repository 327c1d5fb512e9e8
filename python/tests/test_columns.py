"""Plain columns as programs write them: which column is a time, what the lines above the values state, notes."""

import warnings

import numpy as np
import pytest

import dondolo as dd

G = 9.80665
DT = 0.02
ACC = np.round(1.3 * np.sin(0.37 * np.arange(60)) * np.exp(-0.02 * np.arange(60)), 6)
TIME = np.round(DT * np.arange(60), 6)


def _rows(*columns, sep=",", first=None):
    """Rows of numbers with six decimals, perhaps after a cell of their own."""
    rows = [sep.join(f"{value:.6f}" for value in row) for row in zip(*columns, strict=True)]
    return "".join(f"{'' if first is None else first(i) + sep}{row}\n" for i, row in enumerate(rows))


def _read(tmp_path, content, **given):
    """All channels of a content, and what is reported."""
    path = tmp_path / "motion.txt"
    path.write_text(content, encoding="utf-8", newline="")
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        records = dd.read_records(path, **given)
    return records, [str(one.message) for one in caught]


def _is(records, *columns, unit=1.0):
    assert len(records) == len(columns)
    for record, column in zip(records, columns, strict=True):
        assert record.dt == DT
        assert np.allclose(record.acceleration, unit * column, rtol=1e-12, atol=unit * 6e-7)


NUMBERS = "column 1 numbers the samples and is not read"


@pytest.mark.parametrize(
    ("content", "given", "note"),
    [
        # pandas: index, its title empty, quoted, a column of its own, several columns
        (",acc\n" + _rows(ACC, first=str), {"dt": DT}, NUMBERS),
        (",time,acc\n" + _rows(TIME, ACC, first=str), {}, NUMBERS),
        (",0\n" + _rows(ACC, first=str), {"dt": DT}, NUMBERS),
        ('"","time","acc"\n' + _rows(TIME, ACC, first=lambda i: f'"{i + 1}"'), {}, NUMBERS),
        ("Unnamed: 0,time,acc\n" + _rows(TIME, ACC, first=str), {}, NUMBERS),
        ("index;tempo;acc\n" + _rows(TIME, ACC, sep=";", first=str), {}, NUMBERS),
        ("0,1\n" + _rows(TIME, ACC), {}, ""),
        # R's write.table: one title less than columns, rows named 1, 2, 3
        ('"time" "acc"\n' + _rows(TIME, ACC, sep=" ", first=lambda i: f'"{i + 1}"'), {}, NUMBERS),
        ('"acc"\n' + _rows(ACC, sep=" ", first=lambda i: f'"{i + 1}"'), {"dt": DT}, NUMBERS),
        ("V1 V2\n" + _rows(TIME, ACC, sep=" "), {}, ""),
        # Without titles
        (_rows(ACC, sep=" ", first=str), {"dt": DT}, NUMBERS),
        (_rows(ACC, sep="\t", first=lambda i: str(i + 1)), {"dt": DT}, NUMBERS),
        (_rows(TIME, ACC, sep=" ", first=str), {}, NUMBERS),
        (_rows(TIME, ACC, sep=" "), {"dt": DT}, ""),
        # NumPy, MATLAB and others: titles in comments, rows of units
        ("# t a\n" + _rows(TIME, ACC, sep=" "), {}, ""),
        ("% Time (s)\tAcceleration (m/s2)\n" + _rows(TIME, ACC, sep="\t"), {}, ""),
        ("! time [s]  acc [m/s^2]\n" + _rows(TIME, ACC, sep="  "), {}, ""),
        ("// time,acc\n" + _rows(TIME, ACC), {}, ""),
        ("time,acc\ns,m/s2\n" + _rows(TIME, ACC), {}, ""),
        ("time acc\n(s) (m/s/s)\n" + _rows(TIME, ACC, sep=" "), {}, ""),
        # Spreadsheets
        ("sep=;\nTime (s);Acc (m/s2)\n" + _rows(TIME, ACC, sep=";"), {}, ""),
        ("\ufeffsep=;\r\nTime;Acc\r\n" + _rows(TIME, ACC, sep=";").replace(".", ","), {}, ""),
        ('"Time","Acc"\n' + "".join(f'"{t:.2f}","{a:.6f}"\n' for t, a in zip(TIME, ACC, strict=True)), {}, ""),
        ("".join(f'"{t:.2f}","{a:.6f}"\n' for t, a in zip(TIME, ACC, strict=True)).replace(".", ","), {}, ""),
        # A number of samples in the first line
        ("60\n" + _rows(ACC), {"dt": DT}, ""),
        ("60\n" + _rows(TIME, ACC, sep=" "), {}, ""),
        ("60 0.02\n" + _rows(ACC), {}, ""),
        ("59\n" + _rows(TIME, ACC, sep=" "), None, "ignored 1 sample beyond the 59 stated in the file"),
        # Steps, rates and numbers in words
        ("# dt: 0.02\n" + _rows(ACC), {}, ""),
        ("dt = 0.02 s\n" + _rows(ACC), {}, ""),
        ("DT 0.02 SEC\n" + _rows(ACC), {}, ""),
        ("# Time step (ms): 20\n" + _rows(ACC), {}, ""),
        ("% sampling rate = 50 Hz\n" + _rows(ACC), {}, ""),
        ("Sampling frequency (Hz): 50\n" + _rows(ACC), {}, ""),
        ("! 50 samples per second\n" + _rows(ACC), {}, ""),
        ("Sampled at 50 Hz\n" + _rows(ACC), {}, ""),
        ("# dt = 1/50\n" + _rows(ACC), {}, ""),
        ("Acceleration at 0.02 sec intervals\n" + _rows(ACC), {}, ""),
        ("60 POINTS OF ACCEL DATA EQUALLY SPACED AT .020 SEC.\n" + _rows(ACC), {}, ""),
        ("# low-pass 20 Hz, sampled at 50 Hz\n" + _rows(ACC), {}, ""),
        ("# Sampling Freq(Hz), 50\n" + _rows(ACC), {}, ""),
        ("Station ABC, record 3\nNPTS=  60, DT= .02 SEC\n" + _rows(ACC), {}, ""),
        ("60   0.02   NPTS, DT\n" + _rows(ACC), None, ""),
        ("# npts: 58\n# dt: 0.02\n" + _rows(ACC), None, "ignored 2 samples beyond the 58 stated in the file"),
    ],
)
def test_times_are_times_and_numbers_of_samples_are_none(content, given, note, tmp_path):
    """The same motion out of each, at its own step."""
    records, notes = _read(tmp_path, content, units="m/s2", **(given or {}))
    if given is None and note:
        count = int(note.split(" stated")[0].split()[-1])
        _is(records, ACC[:count])
    else:
        _is(records, ACC)
    assert notes == ([f"record 'motion': {note}"] if note else [])
    assert records[0].metadata.get("reading", "") == note


@pytest.mark.parametrize(
    ("top", "given"),
    [("", {"dt": DT}), ("N-S E-W U-D\n", {"dt": DT}), ("N-S (m/s2)\tE-W (m/s2)\tU-D (m/s2)\n", {"dt": DT}),
     ("# dt: 0.02\n", {}), ("0,1,2\n", {"dt": DT}), ("Rate: 50 Hz\nX,Y,Z\n", {"dt": DT}), (",NS,EW,UD\n", {"dt": DT})],
)  # fmt: skip
def test_channels_without_times(top, given, tmp_path):
    """A step that is given or stated: no column is a time."""
    first = str if top.startswith(",") else None
    columns = _rows(-ACC, 2.0 * ACC, 0.5 * ACC, sep="\t" if "\t" in top else ",", first=first)
    records, _ = _read(tmp_path, top + columns, units="m/s2", **given)
    _is(records, -ACC, 2.0 * ACC, 0.5 * ACC)


@pytest.mark.parametrize(
    ("top", "unit"),
    [("# units: cm/s2\n", 0.01), ("% Acceleration in g\n", G), ("Acceleration time history (gal)\n", 0.01),
     ("! units = mm/s^2\n", 0.001), ("Unit: [g]\n", G), ("# time(sec)  N-S(cm/s/s)\n", 0.01), ("time,acc\ns,g\n", G),
     ("# acc., cm/sec2\n", 0.01), ("// values in units of g\n", G), ("UNITS OF ACCELERATION: cm/s^2\n", 0.01)],
)  # fmt: skip
def test_units_above_the_values(top, unit, tmp_path):
    """They are used, and contradict others."""
    content = top + _rows(TIME, ACC)
    records, _ = _read(tmp_path, content)
    _is(records, ACC, unit=unit)
    for other in {"m/s2", "g", "gal"} - {"g" if unit == G else "gal" if unit == 0.01 else ""}:
        with pytest.raises(dd.errors.InputError, match="the file states"):
            _read(tmp_path, content, units=other)


@pytest.mark.parametrize(
    "top",
    ["# time(s)  N-S(cm/s)\n", "% Velocity\n", "VELOCITY TIME HISTORY, STATION 7\n", "# units: cm/s\n", "time,vel\n",
     "time,x\ns,cm\n", "! Displacement (cm)\n", "Data type: displacement\n", "# quantity: velocity\n",
     "time (s),ground velocity\n", "spostamento in cm\n"],
)  # fmt: skip
def test_other_quantities_are_refused_whatever_is_given(top, tmp_path):
    with pytest.raises(dd.errors.InputError, match="is not an acceleration"):
        _read(tmp_path, top + _rows(TIME, ACC), units="cm/s2")


@pytest.mark.parametrize(
    "top",
    ["# baseline corrected, final velocity is zero\n", "# Vs30 (m/s): 560\n", "# epicentral distance [km]: 12\n",
     "# band-pass filter, corner frequency 0.1 Hz\n", "# PGA (g): 0.35\n", "# return period 475 years\n",
     "# matched to the spectrum of the code\n", "# event: Valley 3\n# date: 2031-03-04T05:06:07\n"],
)  # fmt: skip
def test_remarks_are_no_statements(top, tmp_path):
    records, notes = _read(tmp_path, top + _rows(TIME, ACC), units="m/s2")
    _is(records, ACC)
    assert not notes


@pytest.mark.parametrize(
    ("content", "given", "sentence"),
    [
        (",acc\n" + _rows(ACC, first=str), {}, "does not state its time step"),
        ("N-S,E-W\n" + _rows(ACC, -ACC), {}, "does not state its time step"),
        (_rows(TIME, ACC), {"dt": 0.01}, "dt = 0.01: the times in the file are 0.02 s apart"),
        (_rows(1000.0 * TIME, ACC), {}, "column 1 increases by 20: must be times in s"),
        ("time,acc\n" + _rows(ACC, first=str), {}, "numbers the samples: must be times in s"),
        ("depth,acc\n" + _rows(TIME, ACC), {}, "titled 'depth', increases throughout"),
        ("frequency,acc\n" + _rows(TIME, ACC), {}, "title 'frequency' of the times: they must be in s"),
        ("time (ms),acc\n" + _rows(TIME, ACC), {}, "title 'time .ms.' of the times: they must be in s"),
        ("50\n" + _rows(ACC / 10.0), {"dt": DT}, "50 may be the number of the values below it, but 60 follow"),
        ("61\n" + _rows(TIME, ACC, sep=" "), {}, "61 samples stated: the file has 60"),
        ("# npts: 57\n" + _rows(ACC), {"dt": DT}, "57 samples stated: the file has 60"),
        ("# dt: 0.01\n" + _rows(TIME, ACC), {}, "the step of the times is 0.02: a comment states dt = 0.01"),
        ("# 100 Hz\n" + _rows(ACC), {"dt": DT}, "dt = 0.02: the file states 0.01"),
        ("# dt: 0.01\n# sampling rate: 50 Hz\n" + _rows(ACC), {}, "line 1 states 0.01"),
        ("# units: g\ntime,acc (m/s2)\n" + _rows(TIME, ACC), {}, "units 'g': the title 'acc .m/s2.' states 'm/s2'"),
        ("# sampling rate: 0.02\n" + _rows(ACC), {}, "must be a time step in s or a rate in Hz"),
        ("".join(f"{a:.3f}\n" for a in ACC).replace(".", ","), {"dt": DT}, "columns separated by commas need"),
        ("t1,a,t2,b\n" + _rows(TIME, ACC, 2 * TIME, ACC), {}, "titled as times: they must be the same"),
    ],
)
def test_what_is_not_certain_is_refused(content, given, sentence, tmp_path):
    given = given if "units: g" in content else {"units": "m/s2", **given}
    with pytest.raises(dd.errors.InputError, match=sentence):
        _read(tmp_path, content, **given)


@pytest.mark.parametrize("end", ["", "\n"])
@pytest.mark.parametrize("layout", ["{:.8f}", "{:.6e}", "{:12.5E}", "{!r}"])
@pytest.mark.parametrize("timed", [False, True])
def test_a_last_line_that_is_shorter_is_reported(end, layout, timed, tmp_path):
    """1.25e-05 that ends as 1.25e-0 is a hundred thousand times as large."""
    lines = [layout.format(float(a) * 1.234567e-6) for a in ACC[1:]]
    if timed:
        lines = [f"{t:.2f} {line}" for t, line in zip(TIME[1:], lines, strict=True)]
    given = {"units": "g"} | ({} if timed else {"dt": DT})
    assert not _read(tmp_path, "\n".join(lines) + end, **given)[1]
    whole = "\n".join(lines)
    for cut in (1, 5):
        if "r" in layout and cut == 5 and end:
            continue
        text = whole[:-cut].rstrip("-eE")
        records, notes = _read(tmp_path, text + end, **given)
        assert len(records[0].acceleration) == len(lines)
        assert len(notes) == 1
        assert "is printed shorter than the others, or far larger: the file may be cut off" in notes[0]


def test_notes_of_a_catalogue_are_reported_once(tmp_path):
    """By Python, by the executable as a note, and in the table of records."""
    for name in "ab":
        (tmp_path / f"{name}.csv").write_text(",acc\n" + _rows(ACC, first=str))
    (tmp_path / "all.csv").write_text("file,dt_s,units\na.csv,0.02,m/s2\nb.csv,0.02,m/s2\n")
    with pytest.warns(dd.errors.DondoloWarning, match=r"record 'a': column 1 numbers .* \(2 of 2 records\)") as caught:
        records = dd.read_catalogue(tmp_path / "all.csv")
    assert len(caught) == 1
    (tmp_path / "case.nml").write_text(
        "&records catalogue = 'all.csv' /\n&wall mechanism = 'free_standing', height = 3.0, thickness = 0.3 /\n"
        "&stripes levels = 0.1, 0.2 /\n"
    )
    with pytest.warns(dd.errors.DondoloWarning, match="2 of 2 records"):
        dd.read_case(tmp_path / "case.nml")
    # What was written by dondolo is read without another remark
    records.to_catalogue(tmp_path / "again.csv")
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        again = dd.read_catalogue(tmp_path / "again.csv")
    assert all(np.array_equal(x.acceleration, y.acceleration) for x, y in zip(records, again, strict=True))


def test_a_record_of_an_archive_is_written_and_read_again(tmp_path):
    """The header's number of samples and step are metadata there, and no statements."""
    record = dd.Record(ACC, 0.02, "x", metadata={"NDATA": "7", "SAMPLING_INTERVAL_S": "0.01", "dt": "1"})
    dd.RecordSet([record]).to_catalogue(tmp_path / "x.csv")
    (again,) = dd.read_catalogue(tmp_path / "x.csv").records
    assert again.dt == 0.02
    assert np.array_equal(again.acceleration, ACC)
