"""Plain columns as programs write them: which are times, what lines above them may state, what is refused."""

import warnings

import numpy as np
import pytest

import dondolo as dd
from dondolo.records.catalogues import build_catalogue

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
        # pandas: index, its title empty, quoted, a column of its own
        (",acc\n" + _rows(ACC, first=str), {"dt": DT}, NUMBERS),
        (",acc\n" + _rows(TIME, ACC), {}, ""),
        (",time,acc\n" + _rows(TIME, ACC, first=str), {}, "column 1, titled '', is not read"),
        ('"","time","acc"\n' + _rows(TIME, ACC, first=lambda i: f'"{i + 1}"'), {}, "column 1, titled '', is not read"),
        ("Unnamed: 0,time,acc\n" + _rows(TIME, ACC, first=str), {}, "column 1, titled 'Unnamed: 0', is not read"),
        ("V1 V2\n" + _rows(TIME, ACC, sep=" "), {}, ""),
        # Without titles
        (_rows(ACC, sep=" "), {"dt": DT}, ""),
        (_rows(TIME, ACC, sep=" "), {}, ""),
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
        # A number of samples and a step in the first line
        ("60\n" + _rows(ACC), {"dt": DT}, ""),
        ("60 0.02\n" + _rows(ACC), {}, ""),
        ("0.02\n" + _rows(ACC), {"dt": DT}, "the first line, 0.02, is the time step and no sample"),
        # Statements
        ("# dt: 0.02\n" + _rows(ACC), {}, ""),
        ("dt = 0.02 s\n" + _rows(ACC), {}, ""),
        ("# Time step (ms): 20\n" + _rows(ACC), {}, ""),
        ("# Delta_t: 20ms\n" + _rows(ACC), {"dt": DT}, ""),
        ("% sampling rate = 50 Hz\n" + _rows(ACC), {}, ""),
        ("Sampling frequency (Hz): 50\n" + _rows(ACC), {}, ""),
        ("# dt = 1/50\n" + _rows(ACC), {}, ""),
        ("Station ABC, record C\nNPTS=  60, DT= .02 SEC\n" + _rows(ACC), {}, ""),
        ("# npts: 58\n# dt: 0.02\n" + _rows(ACC), None, "ignored 2 samples beyond the 58 stated in the file"),
        ("# scale factor: 1.0\n# duration: 1.2 s\n" + _rows(ACC), {"dt": DT}, ""),
        (f"# PGA: {abs(ACC).max():.3f}\n# event: Valley, 6 April 2009, 01:32:39\n" + _rows(ACC), {"dt": DT}, ""),
    ],
)
def test_what_the_contract_allows(content, given, note, tmp_path):
    """The same motion out of each, at its own step."""
    records, notes = _read(tmp_path, content, units="m/s2", **(given or {}))
    _is(records, ACC if given is not None else ACC[:58])
    assert notes == ([f"record 'motion': {note}"] if note else [])
    assert records[0].metadata.get("reading", "") == note


WRAPPED = "".join(" ".join(f"{a:.6f}" for a in ACC[i : i + 7]) + "\n" for i in range(0, 60, 7))


@pytest.mark.parametrize(
    ("content", "given", "columns"),
    [
        (_rows(TIME, -ACC, 2.0 * ACC), {"columns": "time,acceleration,acceleration"}, (-ACC, 2.0 * ACC)),
        (_rows(-ACC, TIME, sep=" "), {"columns": "acceleration, time"}, (-ACC,)),
        (_rows(-ACC, 2.0 * ACC), {"dt": DT, "columns": "acceleration,other"}, (-ACC,)),
        ("N-S (m/s2)\tE-W (m/s2)\n" + _rows(-ACC, 2.0 * ACC, sep="\t"), {"dt": DT}, (-ACC, 2.0 * ACC)),
        ("Zeit Beschl Geschw Weg\n" + _rows(TIME, -ACC, ACC, TIME, sep=" "), {}, (-ACC,)),
        (WRAPPED, {"dt": DT, "columns": "rows"}, (ACC,)),
        ("# npts: 60\n# dt: 0.02\n" + WRAPPED, {"columns": "rows"}, (ACC,)),
        ("60 0.02\n" + WRAPPED, {"columns": "rows"}, (ACC,)),
        ("Station 12, 100 Hz\n" + WRAPPED, {"dt": DT, "columns": "rows"}, (ACC,)),
        ("Shaken 3 times\n1 2 3\n" + _rows(TIME, ACC), {"columns": "time,acceleration"}, (ACC,)),
    ],
)
def test_columns_that_are_told(content, given, columns, tmp_path):
    """By titles, or by the caller; the row of a catalogue says the same."""
    records, _ = _read(tmp_path, content, units="m/s2", **given)
    _is(records, *columns)
    if len(columns) == 1:
        step = given.get("dt", "")
        words = given.get("columns", "")
        (tmp_path / "all.csv").write_text(f'file,dt_s,units,columns\nmotion.txt,{step},m/s2,"{words}"\n')
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            _is(dd.read_catalogue(tmp_path / "all.csv").records, *columns)


@pytest.mark.parametrize(
    ("top", "unit"),
    [("# units: cm/s2\n", 0.01), ("% Acceleration in g\n", G), ("Acceleration time history (gal)\n", 0.01),
     ("! units = mm/s^2\n", 0.001), ("Unit: [g]\n", G), ("# time(sec)  N-S(cm/s/s)\n", 0.01), ("time,acc\ns,g\n", G),
     ("time,acc cm/s2\n", 0.01), ("time,acc_g\n", G), ("// values in units of g\n", G),
     ("UNITS OF ACCELERATION: cm/s^2\n", 0.01)],
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
     "time (s),ground velocity\n", "spostamento in cm\n", "t,Dis\n", "Tempo,Spost.\n", "# Geschwindigkeit\n"],
)  # fmt: skip
def test_other_quantities_are_refused_whatever_is_given(top, tmp_path):
    with pytest.raises(dd.errors.InputError, match="is not an acceleration"):
        _read(tmp_path, top + _rows(TIME, ACC), units="cm/s2")


@pytest.mark.parametrize(
    "top",
    ["# baseline corrected, final velocity is zero\n", "# Vs30 (m/s): 560\n", "# epicentral distance [km]: 12\n",
     "# filter: 0.1 to 25 Hz\n", "# return period: 475 years\n", "# matched to the spectrum of the code\n",
     "# instrument: SMA-1\n", "# event: Valley 3\n# date: 2031-03-04T05:06:07\n"],
)  # fmt: skip
def test_remarks_are_no_statements(top, tmp_path):
    records, notes = _read(tmp_path, top + _rows(TIME, ACC), units="m/s2")
    _is(records, ACC)
    assert not notes


@pytest.mark.parametrize(
    "top",
    ["# unit\u00e0: cm/s", "# unit\u00e9: cm", "# Ma\u00dfeinheit: mm/s", "# birim: m/s", "# UNITS ARE CM/SEC",
     "# given in cm/s",
     "# values [mm/s]", "# unita\u0300: points", "# etalon: gal", "# acc (m/s2)*10", "# acceleration x0.1 (m/s2)",
     "# divided by ten",
     "# hundredths of m/s2", "# MULTIPLY BY 1000", "# sensor: sensitivity 0.5", "# recorder: gain 20",
     "# title: values times 10",
     "# name: scaled by 0.1", "# event: x 10", "# logger: 50 sps", "# processing: resampled to 25 Hz",
     "# sensor: dt 0.01",
     "# station: PGA 0.62 g", "# processing: none, raw counts", "# digit", "# Count", "# DU", "# machine units",
     "# coups",
     "# raw data", "# uncalibrated", "# V", "# relative displacement of the upper floor", "# tilt",
     "# quantity: strain",
     "# type: widget", "# signal: force (kN)", "acc/10 (m/s2)", "10 acc (m/s2)", "acc x 10", "-", "#N/A"],
)  # fmt: skip
def test_words_that_are_not_understood_are_refused(top, tmp_path):
    """Units, factors, counts, steps and quantities in words, with accents, and in the values of remarks."""
    with pytest.raises(dd.errors.InputError):
        _read(tmp_path, f"{top}\n{_rows(ACC)}", units="m/s2", dt=DT)


@pytest.mark.parametrize(
    "top",
    ["# unit\u00e0: m/s\u00b2", "# Ma\u00dfeinheit: m/s2", "# processing: bandpass 0.1 to 25 Hz",
     "# recorder: K2, 24 bit",
     "# event: Thousand Oaks 3", "# date: 12/3/2031", "# damping: 5%", "# PGV: 0.2 m/s", "# distance_km: 5",
     "# type: corrected accelerogram", "# scaling: none", "Aceleraci\u00f3n", "accX", "acc x (m/s2)", "dt_ms: 20",
     "dt: 0.02;",
     '# dt: "0.02"', "NPTS = 60 DT = 0.02", "# \u0394t = 20000 us", "# sampling rate: 0.05 kHz",
     "# N\u00famero de puntos: 60",
     "# Fr\u00e9quence d\u2019\u00e9chantillonnage: 50 Hz", "# sampling rate: 50.000 Hz", "60\n0.02", "0.02\n60"],
)  # fmt: skip
def test_words_that_are_understood(top, tmp_path):
    records, _ = _read(tmp_path, f"{top}\n{_rows(ACC)}", units="m/s2", dt=DT)
    _is(records, ACC)


@pytest.mark.parametrize("mark", ["-777", "-99.25", "32767", "1e9"])
@pytest.mark.parametrize("places", [[25], [0], [59], [20, 21, 22], [12, 33, 50]])
@pytest.mark.parametrize("timed", [False, True])
def test_samples_printed_unlike_the_others_are_marks(mark, places, timed, tmp_path):
    lines = [f"{40.0 * a:.5f}" for a in ACC]
    for i in places:
        lines[i] = mark
    if timed:
        lines = [f"{t:.2f},{line}" for t, line in zip(TIME, lines, strict=True)]
    with pytest.raises(dd.errors.InputError):
        _read(tmp_path, "\n".join(lines) + "\n", units="cm/s2", **({} if timed else {"dt": DT}))


def test_dropped_zeros_are_no_marks(tmp_path):
    """As most programs print numbers: 0.5, 1 and -0.25 beside 0.123."""
    for decimals in (1, 2, 3, 6):
        values = np.round(30.0 * ACC, decimals)
        records, notes = _read(tmp_path, "".join(f"{a:.12g}\n" for a in values), units="cm/s2", dt=DT)
        assert np.allclose(records[0].acceleration, 0.01 * values, rtol=1e-12)
        assert not notes
    spikes = ACC * np.where(np.arange(60) % 9 == 4, 1.9, 0.1)
    records, _ = _read(tmp_path, "".join(f"{a:#.12g}\n" for a in spikes), units="m/s2", dt=DT)
    assert np.allclose(records[0].acceleration, spikes, rtol=1e-11)
    small = ACC * np.where(np.arange(60) % 9 == 4, 1.0, 1e-4)
    records, _ = _read(
        tmp_path, "".join(f"{a:.7e}\n" if abs(a) < 0.01 else f"{a:.7f}\n" for a in small), units="m/s2", dt=DT
    )
    assert np.allclose(records[0].acceleration, small, atol=1e-7)


@pytest.mark.parametrize("lead", ["60 0.02", "0.02 60", "60,0.02", "60;0.02", "60\n0.02"])
def test_what_stands_above_told_columns_is_passed_over(lead, tmp_path):
    """As the message says that refuses it without."""
    content = f"{lead}\n{_rows(TIME, ACC, sep=' ')}"
    with pytest.raises(dd.errors.InputError, match=r"may stand only above a single column.*catalogue"):
        _read(tmp_path, content, units="m/s2")
    records, _ = _read(tmp_path, content, units="m/s2", columns="time, acceleration")
    _is(records, ACC)


def test_rows_of_any_length_and_commas_of_one_column(tmp_path):
    long = " ".join(f"{a:.6f}" for a in ACC) + " " + " ".join(f"{a:.6f}" for a in ACC) + "\n"
    with pytest.raises(dd.errors.InputError, match="more than 63 columns, or values along the rows: a row"):
        _read(tmp_path, long, units="m/s2", dt=DT)
    records, _ = _read(tmp_path, long, units="m/s2", dt=DT, columns="rows")
    _is(records, np.concatenate([ACC, ACC]))
    with pytest.raises(dd.errors.InputError, match="printed unlike the others"):
        _read(tmp_path, "1 2 3 4 5 6 7\n" + WRAPPED, units="m/s2", dt=DT, columns="rows")
    for lead in ("60 0.02\n", "60\n0.02\n"):
        pairs = "".join(f"{a:.6f} {b:.6f}\n" for a, b in ACC.reshape(-1, 2))
        _is(_read(tmp_path, lead + pairs, units="m/s2", dt=DT, columns="rows")[0], ACC)
    commas = _rows(ACC).replace(".", ",")
    with pytest.raises(dd.errors.InputError, match="commas of one column are decimal if columns = 'acceleration'"):
        _read(tmp_path, commas, units="m/s2", dt=DT)
    _is(_read(tmp_path, commas, units="m/s2", dt=DT, columns="acceleration")[0], ACC)


@pytest.mark.parametrize("top", ["# sampling rate: 1.000 Hz", "# frequenza di campionamento: 2.000"])
def test_rates_that_may_be_thousands_are_refused(top, tmp_path):
    with pytest.raises(dd.errors.InputError, match="is no statement that is read"):
        _read(tmp_path, f"{top}\n{_rows(ACC)}", units="m/s2")


UNREAD = "is no statement that is read: a row of a catalogue must say what the file holds"
MARKED = [-999.0 if i in (20, 41) else 20.0 * a for i, a in enumerate(ACC)]


@pytest.mark.parametrize(
    ("content", "given", "sentence"),
    [
        ("N-S (g),E-W (g)\n" + _rows(ACC, -ACC), {"units": "g"}, "does not state its time step"),
        (_rows(TIME, ACC), {"dt": 0.01}, "dt = 0.01: the times in the file are 0.02 s apart"),
        (_rows(1000.0 * TIME, ACC), {}, "column 1 increases by 20"),
        ("time,acc\n" + _rows(ACC, first=str), {}, "column 1 increases by 1: must be times in s"),
        ("frequency,acc\n" + _rows(TIME, ACC), {}, "title 'frequency' of the times: they must be in s"),
        ("time (ms),acc\n" + _rows(TIME, ACC), {}, "title 'time .ms.' of the times: they must be in s"),
        ("depth,acc\n" + _rows(TIME, ACC), {}, "does not state its time step"),
        ("50\n" + _rows(ACC / 10.0), {"dt": DT}, "50 may be the number of the values below it, but 60 follow"),
        ("60 0.02\n" + _rows(ACC), {"dt": 0.01}, "dt = 0.01: the file states 0.02"),
        ("61 0.02\n" + _rows(ACC), {}, "above lines of one value, but not their number and step"),
        ("60\n" + _rows(TIME, ACC, sep=" "), {}, "'60' above lines of 2 values, where a number of samples"),
        ("59 0.02\n" + _rows(TIME, ACC, sep=" "), {"dt": DT}, "columns without titles of which the first is no"),
        ("60 0.02\n" + _rows(TIME, ACC, sep=" "), {"dt": DT}, "number of samples, which may stand only above a single"),
        ("0.01\n" + _rows(ACC), {"dt": DT}, "'0.01' is printed unlike the values below it"),
        (_rows(ACC, TIME), {"dt": DT}, "2 columns without titles of which the first is no column of times"),
        (_rows(ACC, TIME), {"dt": DT, "columns": "acceleration,acceleration"}, "such as times, are no accelerations"),
        (_rows(ACC, ACC, TIME), {"dt": DT, "columns": "rows"}, "those of column 3 increase by equal steps"),
        (WRAPPED, {"dt": DT}, "7 columns without titles of accelerations, or values along the rows"),
        (WRAPPED, {"columns": "rows"}, "does not state its time step"),
        ("61 0.02\n" + WRAPPED, {"columns": "rows"}, "is not the number of values below it, 60, and their step"),
        (_rows(ACC), {"dt": DT, "columns": "raws"}, "columns = 'raws': must be 'rows' for values along the rows"),
        (_rows(ACC), {"dt": DT, "columns": "time"}, "with one acceleration at least"),
        ("# npts: 57\n" + _rows(ACC), {"dt": DT}, "57 samples stated: the file has 60"),
        ("# npts: 60.5\n" + _rows(ACC), {"dt": DT}, UNREAD),
        ("# dt: 0.01\n" + _rows(TIME, ACC), {}, "the step of the times is 0.02: the file states dt = 0.01"),
        ("# DELTA: 0.01\n" + _rows(ACC), {"dt": DT}, "dt = 0.02: the file states 0.01"),
        ("# dt: 0.01\n# sampling rate: 50 Hz\n" + _rows(ACC), {}, "line 1 states 0.01"),
        ("# units: g\ntime,acc (m/s2)\n" + _rows(TIME, ACC), {}, "units 'g': the title 'acc .m/s2.' states 'm/s2'"),
        ("# sampling rate: 0.02\n" + _rows(ACC), {}, "must be a time step in s or a rate in Hz"),
        ("# passo (ms): 12,5\n" + _rows(ACC), {}, f"'passo .ms.: 12,5' {UNREAD}"),
        ("NPTS= 60, DT= 0,02 SEC\n" + _rows(ACC), {}, f"DT= 0,02 SEC' {UNREAD}"),
        ("# 100 Hz\n" + _rows(ACC), {"dt": DT}, UNREAD),
        ("DT 0.02 SEC\n" + _rows(ACC), {}, UNREAD),
        ("# low-pass 20 Hz\n" + _rows(ACC), {"dt": DT}, "and 'motion.txt,0.02,m/s2,acceleration'"),
        ("# takt: 0.02\n" + _rows(ACC), {"dt": DT}, UNREAD),
        ("# multiplier: 0.01\n" + _rows(ACC), {"dt": DT}, "'multiplier = 0.01' is not applied"),
        ("# PGA: 0.35 g\n" + _rows(ACC), {"dt": DT}, "peak value 0.35: the largest value is"),
        ("# durata: 3.4 s\n" + _rows(ACC), {"dt": DT}, "duration 3.4 s: count and time step make 1.2 s"),
        ("# units: counts\n" + _rows(ACC), {"dt": DT}, "units = 'counts': must be one of"),
        ("# as counts\n" + _rows(ACC), {"dt": DT}, "counts of a digitizer are no accelerations"),
        ("time,acc (counts)\n" + _rows(TIME, ACC), {}, "title 'acc .counts.' is not one of accelerations"),
        ("time,100*acc\n" + _rows(TIME, ACC), {}, "title '100.acc' is not one of accelerations"),
        ("trace\n" + _rows(ACC), {"dt": DT}, "title 'trace' is not one of accelerations"),
        ("N-S E-W\n" + _rows(ACC, ACC, sep=" "), {"dt": DT}, "title 'N-S' is not one of accelerations"),
        (_rows(MARKED), {"dt": DT}, "sample 21 = -999 is far from those beside it"),
        (_rows([700.0 if i == 30 else a for i, a in enumerate(ACC)]), {"dt": DT}, "sample 31 = 700 is far"),
        ("acc\n685\n1.014\n-802\n6\n", {"dt": DT}, "value '1.014' beside whole numbers"),
        ("acc\n685.\n1.014\n-802.\n6.\n", {"dt": DT}, "value '1.014' beside whole numbers"),
        ("acc\n685.0\n1.014\n-802.0\n6.0\n", {"dt": DT}, "value '1.014' beside whole numbers"),
        ("".join(f"{a:.3f}\n" for a in ACC).replace(".", ","), {"dt": DT}, "columns separated by commas need"),
        ("t1,a,t2,b (g)\n" + _rows(TIME, ACC, 2 * TIME, ACC), {}, "titled as times: they must be the same"),
        ("velocity\n60 0.02\n" + _rows(ACC), {}, "'velocity' is not an acceleration"),
    ],
)
def test_what_is_not_certain_is_refused(content, given, sentence, tmp_path):
    given = given if "units: g" in content else {"units": "m/s2", **given}
    with pytest.raises(dd.errors.InputError, match=sentence):
        _read(tmp_path, content, **given)


def test_other_formats_have_no_columns_to_tell(tmp_path):
    content = "PEER NGA STRONG MOTION DATABASE RECORD\nValley, 1/2/1990, Hall, 67\n"
    content += "ACCELERATION TIME SERIES IN UNITS OF G\n"
    content += "NPTS=  60, DT= .0200 SEC\n" + WRAPPED
    with pytest.raises(dd.errors.InputError, match="only for plain columns, and the file is in the format 'peer'"):
        _read(tmp_path, content, columns="rows")
    records, _ = _read(tmp_path, content, columns="rows", format="columns", dt=DT, units="m/s2")
    _is(records, ACC)


def test_a_folder_with_a_step_reads_what_files_read_with_it(tmp_path):
    """Columns that are told are a column of the catalogue, for those files that do not say so."""
    folder = tmp_path / "folder"
    folder.mkdir()
    (folder / "one.txt").write_text("0.02\n" + _rows(ACC))
    (folder / "wrapped.txt").write_text(WRAPPED)
    (folder / "timed.csv").write_text("time,acc (m/s2)\n" + _rows(TIME, ACC))
    made = build_catalogue(folder, dt=DT, units="m/s2")
    assert made.records == 2
    (problem,) = made.problems
    with pytest.raises(dd.errors.InputError) as refused:
        dd.read_records(folder / "wrapped.txt", dt=DT, units="m/s2")
    assert problem == f"{refused.value} (option --columns)"
    made = build_catalogue(folder, folder / "catalogue.csv", dt=DT, units="m/s2", layout="rows")
    assert (made.records, made.problems) == (3, [])
    assert "wrapped.txt,,0.02,m/s2,rows," in made.path.read_text()
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        _is(dd.read_catalogue(made.path).records, ACC, ACC, ACC)


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
