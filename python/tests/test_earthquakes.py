"""Events and dates: what headers and catalogues state is a name or a date, or it is not known."""

from __future__ import annotations

import re
import warnings

import numpy as np
import pytest

import dondolo as dd

WAVE = np.sin(np.linspace(0.0, 12.0, 40)) * np.linspace(0.0, 1.0, 40)


def event_of(text: str) -> str:
    """What an event in the metadata of a record is taken for."""
    return dd.Record(WAVE, 0.01, metadata={"event": text}).event


@pytest.mark.parametrize(
    "name",
    [
        "Northridge-01",
        "Chi-Chi, Taiwan",
        "L'Aquila",
        "Umbria-Marche 3rd shock",
        "Friuli 1976-05-06",
        "IT-2009-0009",
        "EMSC-20161030_0000029",
        "201011142308 3336",
        "Nahanni (M6.8)",
        "Pisano event",
        "Kermanshah, İran",
        "7",
        "A",
    ],
)
def test_names_stay(name):
    assert event_of(name) == name
    assert event_of(f"  {name.replace(' ', '   ')} ") == name


@pytest.mark.parametrize(
    "text",
    [
        *(
            "unknown",
            "UNKNOWN EVENT",
            "Event: unknown",
            "Unknown earthquake",
            "N/A",
            "n.a.",
            "-",
            "--",
            "***",
            "?",
            "none",
        ),
        *("NoName", "NO_NAME", "no name", "-999", "-9999.0", "null", "NaN", "TBD", "To be determined", "not yet named"),
        *(
            "Earthquake not yet named",
            "[not specified]",
            '"Unknown"',
            "<none>",
            "sconosciuto",
            "sin nombre",
            "earthquake",
        ),
        *("Rcrd", "Rcrd of Mon Jun 03, 2019 10:20:30.0 PDT", "Record of 3 June 2019", "Recording of 2019-06-03"),
        *("10:20:30", "17:29 UTC", "(19:33 PDT)"),
        *("PRISM v1.0.1", "Processed by PRISM", "BAP 1.4.2", "v01.20", "Version 3", "Uncorrected accelerogram"),
        "Corrected acceleration (Format v01.20 with 13 text lines)",
    ],
)
def test_what_is_no_name_is_none(text):
    assert event_of(text) == ""


@pytest.mark.parametrize(
    ("text", "name"),
    [
        ("Record of Small Valley Earthquake of Fri Nov 30, 2018 17:29 UTC", "Small Valley Earthquake"),
        ("Rcrd of Small Valley of Thu Oct 1, 1987", "Small Valley"),
        ("SMALL VALLEY EARTHQUAKE MAY 2, 1983 16:42 PDT", "SMALL VALLEY EARTHQUAKE"),
        ("Somewhere, CA June 16,2005 1:53 pm PDT", "Somewhere, CA"),
        ("Small Valley 10/18/89 00:05", "Small Valley"),
        ("Small Valley (16:42 PDT)", "Small Valley"),
        ("Small Valley, Chile 2010-02-27T06:34:11Z", "Small Valley, Chile"),
        ("Small Valley 8/17/1999 03:02 local time", "Small Valley"),
        ("19 Sep 1985 07:17:47 Small Valley", "Small Valley"),
    ],
)
def test_a_name_has_no_time_of_day(text, name):
    assert event_of(text) == name


def test_a_moment_is_an_event_of_its_own():
    """Equal times of origin are one earthquake, however they are written."""
    labels = {event_of(text) for text in ("2016-10-30 06:40:18", "2016/10/30T06:40:18Z", "30 Oct 2016, 06:40:18 UTC")}
    assert labels == {"20161030T064018Z"}
    assert event_of("2016-10-30 07:40:18+01:00") in labels


@pytest.mark.parametrize(
    "text", ["", "To be determined", "unknown", "31/02/2010", "2019-02-29", "2016, 3 shocks", "autumn", "0000-00-00"]
)
def test_what_is_no_date_is_none(text):
    """Neither the guard of rotations nor a cluster rests on it, and the event does not go with it."""
    one = dd.Record(WAVE, 0.01, "a", metadata={"date": text, "station": "ABC"})
    other = dd.Record(WAVE, 0.01, "b", metadata={"date": "2018-02-12", "station": "ABC", "event": "Friuli"})
    assert one.event == ""
    assert len(one.rotate(other, 20.0)) == len(WAVE)
    named = dd.Record(WAVE, 0.01, metadata={"date": text, "event": "Friuli"})
    assert named.event == "Friuli"


def test_dates_are_compared_as_dates():
    dates = ("2018-02-12", "12/02/2018", "13/02/2018", "Feb 13, 2018", "2018/02/13")
    one, ambiguous, *same = (dd.Record(WAVE, 0.01, metadata={"date": date, "station": "ABC"}) for date in dates)
    assert {record.event for record in same} == {"ABC 2018-02-13"}
    # Which of the two is the month is not known: it is the same date only where it is written alike
    assert ambiguous.event == "ABC 12/02/2018"
    assert len(same[0].rotate(same[1], 10.0)) == len(WAVE)
    with pytest.raises(dd.errors.InputError, match="date = '2018-02-12' and '2018-02-13': must be the same"):
        one.rotate(same[0], 10.0)


@pytest.mark.parametrize(
    ("one", "other", "same"),
    [
        ("1981", "1997", False),
        ("1981", "1981-11-24", True),
        ("1981", "1982", False),
        ("1981-02", "1981-11", False),
        ("02/1981", "24 February 1981", True),
        ("Feb 1981", "autumn 1997", False),
        ("24/02/81", "26/09/97", False),
        ("24/02/81", "1981-02-24T20:53", True),
        ("81-2-24", "97-9-26", False),
        ("04/05/81", "11/24/81", False),
        ("04/05/1981", "1981-05-04", True),
        ("04/05/1981", "1981-06-04", False),
        ("24 febbraio 1981", "26 settembre 1997", False),
        ("24 de febrero de 1981", "24 février 1981", True),
        ("3 ağustos 1981", "3. August 81", True),
        ("1981/055", "1981-02-24", True),
        ("1981/055", "1981-03-24", False),
    ],
)
def test_a_name_at_dates_of_any_kind(wall, one, other, same):
    """Two dates of one name are one earthquake only where they may be of one day; so are components of a motion."""
    records = [
        dd.Record(made.acceleration, made.dt, made.name, metadata={"event": "Dale", "date": date})
        for made, date in zip(dd.synthetic_records(6.5, 10.0, "shallow", n_records=2), (one, other), strict=True)
    ]
    for several in (records, records[::-1]):
        assert len(set(dd.multiple_stripe(wall, several, [0.2, 0.4], progress=False).events)) == 2 - same
    pair = [dd.Record(WAVE, 0.01, metadata={"date": date}) for date in (one, other)]
    if not same:
        with pytest.raises(dd.errors.InputError, match=r"date = .*: must be the same"):
            pair[0].rotate(pair[1], 10.0)


def test_dates_that_cannot_be_compared(wall):
    def caught(*dates):
        records = [
            dd.Record(made.acceleration, made.dt, made.name, metadata={"event": "Dale", "date": date})
            for made, date in zip(dd.synthetic_records(6.5, 10.0, "shallow", n_records=2), dates, strict=True)
        ]
        with warnings.catch_warnings(record=True) as several:
            warnings.simplefilter("always")
            dd.multiple_stripe(wall, records, [0.2, 0.4], progress=False)
        return [one.message for one in several if "cannot be compared" in str(one.message)]

    (found,) = caught("the first shock", "1981-02-24")
    assert found.code == "records_unread_date"
    assert found.numbers == {"records_beyond": 1, "records": 2}
    assert "its date 'the first shock'" in str(found)
    assert caught("the first shock", "the first shock") == caught("the first shock", "") == caught("1981", "1997") == []


def test_the_catalogue(tmp_path):
    """Its labels are judged as those of headers, and those of headers by its own."""
    np.savetxt(tmp_path / "r.txt", WAVE)
    rows = ["Friuli,1976/05/06", "unknown,to be determined", "Rcrd of Tue Aug 28,30/10/2016", ",", "2016-10-30 06:40,-"]
    lines = [f"r.txt,0.01,m/s2,r{i},{row}" for i, row in enumerate(rows)]
    (tmp_path / "c.csv").write_text("\n".join(["file,dt_s,units,name,event,date", *lines]) + "\n")
    records = dd.read_catalogue(tmp_path / "c.csv")
    assert [record.metadata.get("event") for record in records] == ["Friuli", None, None, None, "20161030T064000Z"]
    assert [record.metadata.get("date") for record in records] == ["1976-05-06", None, "2016-10-30", None, None]
    # What was stated is not lost
    assert records[1].metadata["stated event"] == "unknown"
    assert records[1].metadata["stated date"] == "to be determined"
    records.to_catalogue(tmp_path / "again.csv")
    again = dd.read_catalogue(tmp_path / "again.csv")
    assert [record.event for record in again] == [record.event for record in records]


def knet(station: str, moment: str, place: tuple[str, str]) -> str:
    """A file of K-NET."""
    keys = {
        "Origin Time": moment,
        "Lat.": place[0],
        "Long.": place[1],
        "Depth. (km)": "84",
        "Mag.": "4.2",
        "Station Code": station,
        "Station Lat.": "35.7943",
        "Station Long.": "140.0564",
        "Station Height(m)": "28",
        "Record Time": "2014/12/31 23:50:11",
        "Sampling Freq(Hz)": "100Hz",
        "Duration Time(s)": "0.08",
        "Dir.": "E-W",
        "Scale Factor": "3920(gal)/125440",
        "Max. Acc. (gal)": "",
        "Last Correction": "2014/12/31 23:50:12",
        "Memo.": "",
    }
    return "\n".join(f"{key:18}{value}" for key, value in keys.items()) + "\n" + " 10 -20 400 -500 60 -70 80 -90\n"


def cwa(station: str, moment: str, place: tuple[str, str]) -> str:
    """A file of the Central Weather Administration."""
    rows = "".join(f"{0.01 * i:10.3f}{x:10.3f}\n" for i, x in enumerate((0.0, 1.5, -0.5, 0.25)))
    return (
        f"#Earthquake Information\n#Origin Time(GMT+08): {moment}\n#EpicenterLongitude(E): {place[1]}\n"
        f"#EpicenterLatitude(N): {place[0]}\n#Magnitude(Ml): 6.0\n\n#StationCode: {station}\n#RecordLength(sec): 0.04\n"
        f"#SampleRate(Hz): 100\n#AmplitudeUnit:  gal. DCoffset(corr)\n#DataSequence: Time N(+)\n#Data: 2F10.3 \n{rows}"
    )


def asa(station: str, moment: str, place: tuple[str, str]) -> str:
    """A standard accelerogram of Mexico."""
    date, time = moment.split(" ")
    keys = {
        "CLAVE DE LA ESTACION": station,
        "NUMERO DE CANALES": "1",
        "ORIENTACION C1-C6 (rumbo;orientacion)": "/N90E",
        "INTERVALO DE MUESTREO, C1-C6 (s)": "/0.01",
        "FECHA DEL SISMO [GMT]": date,
        "HORA EPICENTRO (GMT)": time,
        "COORDENADAS DEL EPICENTRO": f"{place[0]} LAT. N",
        "": f"{place[1]} LONG. W",
        "NUM. TOTAL DE MUESTRAS, C1-C6": "/4",
        "UNIDADES DE LOS DATOS": "Gal (cm/s/s)",
    }
    lines = "".join(f"{key:39}: {value}\n" for key, value in keys.items())
    rule = "---------+\n"
    rows = "".join(f"{x:10.2f}\n" for x in (0.0, 1.5, -0.5, 0.25))
    return (
        f"ARCHIVO ESTANDAR DE ACELERACION:\n{lines}\nDATOS DE ACELERACION:\n{rule}   CANAL-1\n      N90E\n{rule}{rows}"
    )


def dyna(station: str, moment: str, place: tuple[str, str], name: str = "", code: str = "") -> str:
    """A file of ESM."""
    date, time = moment.split(" ")
    return (
        f"EVENT_NAME: {name}\nEVENT_ID: {code}\nEVENT_DATE_YYYYMMDD: {date}\nEVENT_TIME_HHMMSS: {time}\n"
        f"EVENT_LATITUDE_DEGREE: {place[0]}\nEVENT_LONGITUDE_DEGREE: {place[1]}\nSTATION_CODE: {station}\n"
        "SAMPLING_INTERVAL_S: 0.01\nNDATA: 4\nDURATION_S: \nSTREAM: HNE\nUNITS: cm/s^2\nDATA_TYPE: ACCELERATION\n"
        "0.0\n1.5\n-0.5\n0.25\n"
    )


FORMATS = {
    knet: ("2014/12/31 23:49:00", "2014/12/31 23:51:00", "20141231T144900Z 35.785N 139.887E"),
    cwa: ("2014/12/31-23:49:00", "2014/12/31-23:51:00", "20141231T154900Z 35.785N 139.887E"),
    asa: ("2014/12/31 23:49:00.0", "2014/12/31 23:51:00.0", "20141231T234900Z 35.785N 139.887W"),
    dyna: ("20141231 234900", "20141231 235100", "20141231T234900Z 35.785N 139.887E"),
}


def read(folder, name: str, content: str) -> dd.Record:
    (folder / name).write_text(content)
    return dd.read_record(folder / name)


@pytest.mark.parametrize("made", FORMATS, ids=lambda made: made.__name__)
def test_equal_origins_are_one_earthquake(made, tmp_path):
    moment, later, label = FORMATS[made]
    here, there = ("35.785", "139.887"), ("36.000", "139.887")
    first = read(tmp_path, "first", made("AAA", moment, here))
    second = read(tmp_path, "second", made("BBB", moment, ("35.7850", "139.8870")))
    assert first.event == second.event == first.metadata["event"] == label
    assert read(tmp_path, "later", made("AAA", later, here)).event != label
    assert read(tmp_path, "elsewhere", made("AAA", moment, there)).event != label
    # Where the epicentre is not stated, two stations may have recorded two earthquakes
    unknown = [read(tmp_path, code, made(code, moment, ("", ""))) for code in ("AAA", "BBB")]
    assert unknown[0].event.startswith("AAA 2014-12-31T23:49:00")
    assert unknown[1].event.startswith("BBB 2014-12-31T23:49:00")
    wrong = read(tmp_path, "wrong", made("AAA", moment.replace("12", "13", 1), here))
    assert wrong.event == ""
    assert "date" not in wrong.metadata


def test_names_and_codes_of_esm(tmp_path):
    here = ("42.0", "13.0")
    for name, code, event in (
        ("CENTRAL_ITALY", "EMSC-1", "CENTRAL_ITALY EMSC-1"),
        ("NONAME", "EMSC-1", "EMSC-1"),
        ("Unknown", "n/a", "20141231T234900Z 42N 13E"),
        ("To be defined", "", "20141231T234900Z 42N 13E"),
    ):
        assert read(tmp_path, "one", dyna("AAA", "20141231 234900", here, name, code)).event == event


@pytest.mark.parametrize(
    ("line", "event", "date", "station"),
    [
        ("Some Valley-06, 10/15/1979, Array #9, 230", "Some Valley-06", "1979-10-15", "Array #9"),
        ("SOME VALLEY 10/15/79 2319, ARRAY 9, 230 (STATION 1)", "SOME VALLEY", "1979-10-15T23:19", "ARRAY 9"),
        ("Some Valley-06, 10/45/1979, Array #9, 230", "Some Valley-06", None, "Array #9"),
        ("Some Valley-06, 1?/??/1979, Array #9, 230", "Some Valley-06", None, "Array #9"),
        ("Some Valley-06, unknown, Array #9, 230", "Some Valley-06", None, "Array #9"),
        ("SOME VALLEY 10/45/79 2319, ARRAY 9, 230", "SOME VALLEY", None, "ARRAY 9"),
        ("Some Valley-06, Oct 15, 1979, Array #9, 230", "Some Valley-06", "1979-10-15", "Array #9"),
        ("Unknown, 10/15/1979, Array #9, 230", None, "1979-10-15", "Array #9"),
        ("RSN9, Clockwise rot. 68.7962 deg. w.r.t. the input NWH090", None, None, None),
    ],
)
def test_the_line_of_peer(line, event, date, station, tmp_path):
    """A date that does not parse does not take the event with it."""
    text = "\n".join(
        ["PEER", line, "ACCELERATION TIME SERIES IN UNITS OF G", "NPTS= 4, DT= .01 SEC", " 0.0 0.1 -0.1 0.0"]
    )
    metadata = read(tmp_path, "x.AT2", text).metadata
    assert [metadata.get(key) for key in ("event", "date", "station")] == [event, date, station]


def cosmos(title: str, origin: str, start: str = "8/29/2018, 02:33:  .0 UTC", numbers: tuple[int, ...] = ()) -> str:
    """A file of COSMOS of one channel."""
    integers, reals = [-999] * 100, [-999.0] * 100
    integers[0], integers[4] = 1, 1
    for place, number in zip((39, 41, 42), numbers, strict=False):
        integers[place] = number
    reals[33], reals[61:65] = 0.01, (10.0, 0.04, 0.1, 0.01)
    text = [
        "Uncorrected acceleration  (Format v01.20 with 13 text lines) Src:  invented",
        title,
        "Hypocenter: To be determined    H=   km       ML=     Mw=",
        f"Origin: {origin}",
        "Statn No: 05- 90001 Code:CE-90001  CGS  Some Town - Main Street",
        "Coords: 34.500  -117.500   Site geology:",
        "Recorder: X   s/n 1 ( 1 Chns of   1 at Sta) Sensor: FBA",
        f"Rcrd start time: {start} (Q=5) RcrdId: X",
        "Sta Chan  1: 360 deg (Rcrdr Chan  1)",
        "Raw record length =   0.040 sec, Uncor max =   -0.089 g, at    0.010 sec.",
        "Processed:                         CGS . Max =   0.100 g       at    0.010 sec",
        "Record not filtered.",
        "Values used when parameter or data value is unknown/unspecified:   -999, -999.0",
        " 100 Integer-header values follow on  10 lines, Format= (10I8)",
    ]
    text += ["".join(f"{x:8d}" for x in integers[i : i + 10]) for i in range(0, 100, 10)]
    text.append(" 100 Real-header values follow on  17 lines, Format= (6F13.6)")
    text += ["".join(f"{x:13.6f}" for x in reals[i : i + 6]) for i in range(0, 100, 6)]
    text += ['   1 Comment line(s) follow, each starting with a "|":', "|<SCNL>90001.HNN.CE.--"]
    text.append("       4 acceleration pts, approx   0.04 secs, units=g.     (02)Format=(8f9.6)")
    text.append(" 0.000000 0.100000-0.100000 0.000000")
    return "\n".join([*text, "End-of-data for Chan  1 acceleration", ""])


def test_headers_of_cosmos(tmp_path):
    """Earthquakes that the agency has not named yet: no event, and the date of the recording, without its time."""
    undetermined = "To be determined"
    shocks = [
        read(
            tmp_path,
            f"{year}.V1c",
            cosmos(f"Rcrd of Tue Aug 28, {year} 19:33:00.0 PDT", undetermined, "", (year, 8, 29)),
        )
        for year in (2016, 2017, 2018)
    ]
    assert [record.metadata.get("event") for record in shocks] == [None] * 3
    assert [record.metadata["date"] for record in shocks] == ["2016-08-29", "2017-08-29", "2018-08-29"]
    assert len({record.event for record in shocks}) == 3
    in_words = read(tmp_path, "words.V1c", cosmos("Rcrd of Tue Aug 28, 2018 19:33:00.0 PDT", undetermined))
    assert in_words.metadata["date"] == "2018-08-29"
    nothing = read(tmp_path, "no.V1c", cosmos("To be determined", undetermined, undetermined))
    assert nothing.event == ""
    assert "date" not in nothing.metadata
    for title in (
        "Somewhere, CA            June 16,2005 13:53 PDT",
        "Record of Somewhere, CA of Thu Jun 16, 2005 13:53 PDT",
    ):
        named = read(tmp_path, "named.V1c", cosmos(title, "06/16/2005, 20:53:26.1 UTC (SCSN)"))
        assert (named.event, named.metadata["date"]) == ("Somewhere, CA", "2005-06-16T20:53:26.1")


def test_a_run_says_that_earthquakes_are_not_known(wall):
    """Once, where standard errors take records as independent."""
    other = [dd.Record(WAVE * (1.0 + 0.1 * i), 0.01, f"r{i}") for i in range(4)]
    named = [dd.Record(one.acceleration, 0.01, one.name, metadata={"event": one.name}) for one in other]
    unknown = [named[0], other[1], dd.Record(other[2].acceleration, 0.01, "r2", metadata={"event": "unknown"})]
    sentence = re.escape("no event is given for 2 of 3 records (the first is 'r1')")

    def warnings_of(records, **how):
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            dd.multiple_stripe(wall, records, [0.2, 0.4], progress=False, **how)
        return [str(one.message) for one in caught if "no event is given" in str(one.message)]

    (found,) = warnings_of(unknown)
    assert re.match(sentence, found)
    assert len(warnings_of(unknown, threads=2, polarity="both")) == 1
    assert warnings_of(named) == []
    # One record, or one motion twice, is one cluster whatever it is
    assert warnings_of(other[0]) == []
    with pytest.warns(dd.errors.DondoloWarning, match=sentence) as caught:
        dd.typology([wall, dd.OneSidedWall(2.0, 0.3)], unknown, [0.2, 0.4], progress=False)
    (one,) = (warning.message for warning in caught if "no event is given" in str(warning.message))
    assert one.code == "records_without_event"
    assert one.numbers == {"records_beyond": 2, "records": 3}


def test_one_name_and_two_earthquakes(wall, tmp_path):
    """In stripes, clouds, typologies, and in files that are read again; the label of a single record is its name."""
    dates = ["1951-05-01", "1951-05-02T00:30", "1983-05-01", ""]
    records = [
        dd.Record(one.acceleration, one.dt, one.name, metadata={"event": "Dale", "date": date})
        for one, date in zip(dd.synthetic_records(6.5, 10.0, "shallow", n_records=4), dates, strict=True)
    ]
    levels = np.linspace(0.1, 2.0, 20)
    stripes = dd.multiple_stripe(wall, records, levels, progress=False)
    assert stripes.events == ("Dale", "Dale", "Dale 1983-05-01", "Dale")
    stripes.save(tmp_path / "s.npz")
    assert dd.load(tmp_path / "s.npz").fit().clusters == stripes.fit().clusters == 2
    assert records[2].event == "Dale"
    found = dd.typology([wall, dd.OneSidedWall(2.0, 0.3)], records, levels, progress=False)
    assert {curve.clusters for curve in found.curves} == {2}


def csmip(*lines: str) -> str:
    """A file of CSMIP of one channel, of which the lines 3 to 5 and 9 are given."""
    text = ["Corrected accelerogram", "Uncorrected Accelerogram Data   Processed:  4/19/32, Agency"]
    text += ["", "", "", "Station No. 9", "Some Town", "Chan  1: 360 Deg", *[""] * 9]
    text += ["Peak acceleration = 30.000 cm/sec/sec at 0.01 sec."]
    for place, line in zip((2, 3, 4, 8), lines, strict=False):
        text[place] = line
    text += [""] * (25 - len(text))
    text += ["    4 points of accel data equally spaced at  .010 sec. (units: cm/sec/sec)"]
    return "\n".join([*text, "".join(f"{value:10.3f}" for value in (0.0, 30.0, -10.0, 0.0)), "/&"]) + "\n"


@pytest.mark.parametrize(
    "line",
    [
        "Start time:  4/17/32, 10:20:33.0 UTC (GPS)",
        "Trigger time: 17 Apr 2032 10:20",
        "Trig time: 4/17/32",
        "9-X1     Start Date: 04/17/2032",
        "9-X1     Date: 4/17/2032",
        "Rcrd of 2032/04/17",
        "Rcrd of Sat Apr 17, 2032 03:20:33.0 PDT",
        "Record of 2032/108:10:20:33",
    ],
)
def test_the_day_of_a_record(line, tmp_path):
    """CSMIP says it in many words; the day of the processing is another one."""
    assert read(tmp_path, "a.V2", csmip("", "", line)).metadata["date"] == "2032-04-17"
    later = read(tmp_path, "b.V2", csmip("", "", line.replace("17", "19").replace("108", "110")))
    with pytest.raises(dd.errors.InputError, match="date = '2032-04-17' and '2032-04-19': must be the same"):
        read(tmp_path, "a.V2", csmip("", "", line)).rotate(later, 10.0)


def test_recorded_files(recordings):
    """Real headers: events and dates of every format are names, origins and dates of the calendar."""
    found = {}
    for path in sorted((recordings / "formats").rglob("*")):
        if path.is_file():
            try:
                found[path.parent.name] = dd.read_records(path)[0]
            except dd.errors.InputError:
                continue
    events = {name: record.metadata["event"] for name, record in found.items() if "event" in record.metadata}
    assert events["knet"] == "20110630T144500Z 36.213N 137.943E"
    assert events["cwa"] == "20180206T155042Z 24.14N 121.69E"
    assert events["asa_mexico"] == "19890310T051951Z 17.446N 101.089W"
    assert events["geonet"] == "20180212T211554Z 40.06S 176.55E"
    assert events["cosmos"] == "Point MacKenzie Earthquake"
    for record in found.values():
        assert re.fullmatch(r"(\d{4}-\d\d-\d\d(T.*)?)?", record.metadata.get("date", ""))
        assert ":" not in record.metadata.get("event", "")
