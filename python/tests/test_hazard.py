"""Hazard curves: fractiles, the smooth line through the levels, and the files of OpenQuake."""

import dataclasses
import warnings
import zlib

import numpy as np
import pytest

import dondolo as dd

LEVELS = np.array([0.02, 0.05, 0.1, 0.2, 0.4, 0.8, 1.6])
MEAN = np.array([0.1, 0.03, 0.01, 2.5e-3, 4e-4, 5e-5, 4e-6])
# The head of a file of the engine, version 3.20, and of one of version 2
NEW = """#,,,,,"generated_by='OpenQuake engine 3.20.0', start_date='2024-06-03T09:36:04', checksum=1, kind='{kind}', \
investigation_time={time}, imt='{imt}'"
lon,lat,depth,poe-0.1000000,poe-0.4000000,poe-0.6000000,poe-9.0000000
0.00000,0.00000,-0.10000,4.553861E-01,5.754043E-02,6.354517E-03,0.000000E+00
13.39000,42.35000,0.00000,{first},2.000000E-02,1.000000E-03,1.000000E-06
"""
OLD = """# mean, investigation_time=50.0, imt="PGA"
lon,lat,depth,poe-0.1,poe-0.4
0.0,0.0,0.0,0.5,0.01
"""


@pytest.fixture
def hazard():
    return dd.HazardCurve(LEVELS, MEAN, fractiles={0.84: 1.6 * MEAN, 0.16: np.append(0.4 * MEAN[:-1], 0.0)})


def file_of(folder, name="hazard_curve-mean-PGA_1.csv", text=NEW, **values):
    """A file of the engine."""
    path = folder / name
    path.write_text(text.format(**{"kind": "mean", "time": "1.0", "imt": "PGA", "first": "1.500000E-01"} | values))
    return path


def test_fractiles(hazard):
    assert list(hazard.fractiles) == [0.16, 0.84]
    assert "fractiles 0.16 0.84" in repr(hazard)
    high, low = hazard.fractile(0.84), hazard.fractile(0.16)
    np.testing.assert_array_equal(high.annual_frequency, 1.6 * MEAN)
    # The highest level is never exceeded there.
    np.testing.assert_array_equal(low.levels, LEVELS[:-1])
    assert low.fractiles == {}
    assert not hazard.fractiles[0.84].flags.writeable
    assert list(hazard.to_frame().columns) == ["pga", "annual_frequency", "fractile_0.16", "fractile_0.84"]
    with pytest.raises(
        dd.errors.InputError, match=r"q = 0.5: must be one of the fractiles of the hazard curve; there is 0.16"
    ):
        hazard.fractile(0.5)


@pytest.mark.parametrize(
    ("fractiles", "message"),
    [
        ([1.0], "fractiles: must be a mapping"),
        ({"low": MEAN}, "fractiles = 'low': must be a number"),
        ({1.0: MEAN}, r"fractiles\[1\]: the share must lie between 0 and 1"),
        ({0.5: MEAN[1:]}, r"fractiles\[0.5\]: 6 frequencies for 7 levels"),
        ({0.5: -MEAN}, r"fractiles\[0.5\] = -0.1: must not be negative"),
        ({0.5: MEAN[::-1]}, r"fractiles\[0.5\] = 4e-06, 5e-05: must not increase with the level"),
        ({0.16: MEAN, 0.84: 0.9 * MEAN}, r"fractiles\[0.84\] = 0.09: must not be less than 0.1 of the fractile 0.16"),
    ],
)
def test_fractiles_that_are_none(fractiles, message):
    with pytest.raises(dd.errors.InputError, match=message):
        dd.HazardCurve(LEVELS, MEAN, fractiles=fractiles)


def test_fractiles_in_tables(hazard, tmp_path):
    hazard.to_csv(tmp_path / "hazard.csv")
    again = dd.HazardCurve.from_csv(tmp_path / "hazard.csv")
    assert list(again.fractiles) == [0.16, 0.84]
    for q, h in hazard.fractiles.items():
        np.testing.assert_array_equal(again.fractiles[q], h)
    hazard.save(tmp_path / "hazard.npz")
    np.testing.assert_array_equal(dd.load(tmp_path / "hazard.npz").fractiles[0.16], hazard.fractiles[0.16])
    table = tmp_path / "poe.csv"
    table.write_text("pga,poe,investigation_time,fractile_0.05\n0.1,0.2,50,0.1\n0.2,0.1,50,0\n")
    read = dd.HazardCurve.from_csv(table)
    np.testing.assert_allclose(read.fractiles[0.05], [-np.log(0.9) / 50.0, 0.0], rtol=1e-14)
    for title in ("fractile_low", "fractile_16"):
        table.write_text(f"pga,annual_frequency,{title}\n0.1,0.2,0.1\n0.2,0.1,0\n")
        with pytest.raises(dd.errors.InputError, match=f"column '{title}': must be as fractile_0.16"):
            dd.HazardCurve.from_csv(table)


def test_levels_in_another_unit_are_warned_of(tmp_path):
    table = tmp_path / "hazard.csv"
    table.write_text("pga,annual_frequency\n0.5,0.02\n5,0.0002\n")
    with pytest.warns(
        dd.errors.DondoloWarning, match=r"hazard.csv: levels up to 5 of pga, more than 4 g: are they in m/s2"
    ):
        dd.HazardCurve.from_csv(table)


def test_example(root):
    """The table of docs/city.md, within what its curves need and without a warning."""
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        example = dd.HazardCurve.from_csv(root / "data/hazard/illustrative.csv")
    assert example.im == "pga"
    power_law = 2e-5 * example.levels**-2.5
    np.testing.assert_allclose(example.annual_frequency, power_law, rtol=1e-5)


def test_source(hazard, tmp_path):
    """A curve tells its file, how that was read, and what was done to it."""
    table = tmp_path / "hazard.csv"
    table.write_text("ag (g),TR,F0\n0.05,30,2.5\n0.2,475,2.4\n")
    with pytest.warns(dd.errors.DondoloWarning) as caught:
        curve = dd.HazardCurve.from_csv(table)
    checksum = f"{zlib.crc32(table.read_bytes()):08x}"
    assert curve.source == (f"{table} (CRC-32 {checksum})", *(str(one.message) for one in caught))
    assert [one.split(": ")[1][:7] for one in curve.source[1:]] == ["columns", "ag is t"]
    assert curve.smoothed().source == (*curve.source, "smoothed, 16 steps in each")
    assert hazard.source == ()
    assert hazard.fractile(0.84).source == ("fractile 0.84",)
    assert dataclasses.replace(hazard, source="a study").source == ("a study",)
    with pytest.raises(dd.errors.InputError, match="source = 3: must be a string"):
        dataclasses.replace(hazard, source=[3])
    with pytest.raises(dd.errors.InputError, match="source = 3: must be sentences"):
        dataclasses.replace(hazard, source=3)


def test_replaced(hazard):
    half = dataclasses.replace(hazard, annual_frequency=0.5 * hazard.annual_frequency, fractiles=None)
    np.testing.assert_array_equal(half(LEVELS), 0.5 * hazard(LEVELS))
    law = dataclasses.replace(dd.HazardCurve.power_law(1e-4, 2.5), im="pgv")
    assert law.endless
    assert law(10.0) == pytest.approx(1e-4 * 10.0**-2.5)
    with pytest.raises(dd.errors.InputError, match="endless: must have two levels"):
        dataclasses.replace(hazard, endless=True)


def test_smoothed(hazard):
    """Through the levels, monotone, and close to a curve that bends."""
    smooth = hazard.smoothed(steps=10)
    assert len(smooth.levels) == 61
    np.testing.assert_array_equal(smooth.levels[::10], LEVELS)
    np.testing.assert_array_equal(smooth.annual_frequency[::10], MEAN)
    np.testing.assert_array_equal(smooth.fractiles[0.16][50:], np.append(smooth.fractiles[0.16][50], np.zeros(10)))
    np.testing.assert_allclose(smooth.fractiles[0.84], 1.6 * smooth.annual_frequency, rtol=1e-13)

    def bent(x):
        return 1e-4 * x ** -(2.5 + 0.2 * np.log(x))

    levels = np.geomspace(0.02, 5.0, 8)
    given = dd.HazardCurve(levels, bent(levels))
    x = np.geomspace(0.02, 5.0, 500)
    kinked, cubic = (np.abs(np.log(curve(x) / bent(x))).max() for curve in (given, given.smoothed()))
    assert cubic < 0.0035 < 0.03 < kinked
    # The numbers that the module states, for levels 2.2 times the one before
    curve = dd.fit_fragility([0.4, 0.9], [250, 750], 1000)
    exact = curve.risk(dd.HazardCurve(x, bent(x))).inside
    assert curve.risk(given).inside / exact == pytest.approx(0.98, abs=0.002)
    assert curve.risk(given.smoothed()).inside / exact == pytest.approx(1.0, abs=3e-4)
    level = dd.HazardCurve([0.1, 0.2, 0.4], [1e-2, 1e-3, 1e-3]).smoothed()
    assert np.all(np.diff(level.annual_frequency) <= 0.0)
    endless = dd.HazardCurve.power_law(1e-4, 2.0)
    assert endless.smoothed() is endless
    with pytest.raises(dd.errors.InputError, match="steps = 0: must be an integer"):
        hazard.smoothed(steps=0)


def test_openquake(tmp_path):
    """As the engine writes them: exact frequencies, levels at which nothing is seen left out and told."""
    mean = file_of(tmp_path)
    quantile = file_of(tmp_path, "quantile_curve-0.84-PGA_1.csv", kind="quantile-0.84", first="2.5E-01")
    curve = dd.HazardCurve.from_openquake([quantile, mean], site=(13.39, 42.35))
    assert curve.im == "pga"
    np.testing.assert_array_equal(curve.levels, [0.1, 0.4, 0.6, 9.0])
    np.testing.assert_array_equal(curve.annual_frequency, -np.log1p(-np.array([0.15, 0.02, 1e-3, 1e-6])))
    assert curve.fractiles[0.84][0] == -np.log1p(-0.25)
    with pytest.warns(dd.errors.DondoloWarning, match=r"site 0: levels with a probability of 0 or 1 are left out: 9$"):
        first = dd.HazardCurve.from_openquake(mean, site=0)
    assert len(first.levels) == 3
    assert first.source[1] == f"{mean}: site 0: levels with a probability of 0 or 1 are left out: 9"
    assert [one.split(" (CRC-32 ")[0] for one in curve.source] == [str(quantile), str(mean)]
    alone = dd.HazardCurve.from_openquake(str(quantile), site=1)
    assert alone.annual_frequency[0] == curve.fractiles[0.84][0]
    old = dd.HazardCurve.from_openquake(file_of(tmp_path, "hazard_curve-mean.csv", OLD))
    np.testing.assert_array_equal(old.annual_frequency, -np.log1p(-np.array([0.5, 0.01])) / 50.0)
    velocity = dd.HazardCurve.from_openquake(file_of(tmp_path, imt="PGV"), site=1)
    assert (velocity.im, velocity.levels[1]) == ("pgv", 0.004)
    assert dd.HazardCurve.from_openquake(file_of(tmp_path, imt="SA(0.5)"), site=1).im == "sa(0.5)"


@pytest.mark.parametrize(
    ("values", "site", "message"),
    [
        ({}, None, "has 2 sites: site must be its number, from 0, or"),
        ({}, 2, "site = 2: must be between 0 and 1"),
        ({}, (13.0, 42.0), r"site = \(13, 42\): is not in .*; the nearest is \(13.39, 42.35\)"),
        ({}, "L'Aquila", r"site = \"L'Aquila\": must be \(longitude, latitude\)"),
        ({}, (0.0, 91.0), r"site = \(0, 91\): must be \(longitude, latitude\) in degrees"),
        ({"imt": "MMI"}, 1, "imt = 'MMI': must be PGA, PGV, SA"),
        ({"imt": ""}, 1, "must have a comment with imt="),
        ({"time": "none"}, 1, "investigation_time = 'none': must be a number"),
        ({"time": "-1.0"}, 1, "investigation_time = -1: must be positive"),
        ({"first": "-0.1"}, 1, r"site 1: poe-0.1000000 = -0.1: must lie between 0 and 1"),
        ({"first": "1e-3"}, 1, "annual_frequency = .*: must not increase with the level"),
        ({"first": "x"}, 1, "site 1: poe-0.1000000 = 'x': must be a number"),
        ({"first": "0.1,0.1"}, 1, "site 1: has 8 cells, the titles are 7"),
        ({"kind": "quantile-x"}, 1, None),
    ],
)
def test_openquake_files_that_are_refused(tmp_path, values, site, message):
    path = file_of(tmp_path, **values)
    if message is None:
        with pytest.raises(dd.errors.InputError, match="kind = 'x': must be a number"):
            dd.HazardCurve.from_openquake([file_of(tmp_path, "mean.csv"), path], site=site)
        return
    with pytest.raises(dd.errors.InputError, match=message) as error:
        dd.HazardCurve.from_openquake(path, site=site)
    assert "\n" not in str(error.value)


def test_openquake_files_that_do_not_belong_together(tmp_path):
    mean = file_of(tmp_path)
    for values, message in (
        ({"imt": "PGV"}, "PGV and PGA"),
        ({"time": "50.0"}, "50.0 and 1.0"),
        ({"kind": "mean"}, "must be one mean and its quantiles, each once; there are 'mean', 'mean'"),
    ):
        other = file_of(tmp_path, "other.csv", **({"kind": "quantile-0.5"} | values))
        with pytest.raises(dd.errors.InputError, match=message):
            dd.HazardCurve.from_openquake([mean, other], site=1)
    other = file_of(tmp_path, "other.csv", NEW.replace("13.39", "13.40"), kind="quantile-0.5")
    with pytest.raises(dd.errors.InputError, match="has other sites than"):
        dd.HazardCurve.from_openquake([mean, other], site=1)
    with pytest.raises(dd.errors.InputError, match=r"must be read by HazardCurve.from_openquake"):
        dd.HazardCurve.from_csv(mean)
    with pytest.raises(dd.errors.InputError, match="must be read by"):
        dd.HazardCurve.from_csv(file_of(tmp_path, "old.csv", OLD))
    with pytest.raises(dd.errors.InputError, match="must have the columns lon, lat"):
        dd.HazardCurve.from_openquake(file_of(tmp_path, "own.csv", "pga,annual_frequency\n0.1,0.2\n"))


def test_openquake_round_trip(hazard, tmp_path):
    files = hazard.to_openquake(tmp_path, site=(-70.5, -33.25), investigation_time=1.0)
    assert [name.rsplit("/", 1)[1] for name in files] == [
        "hazard_curve-mean-PGA.csv",
        "quantile_curve-0.16-PGA.csv",
        "quantile_curve-0.84-PGA.csv",
    ]
    again = dd.HazardCurve.from_openquake(files, site=(289.5, -33.25))
    np.testing.assert_array_equal(again.levels, LEVELS)
    np.testing.assert_allclose(again.annual_frequency, MEAN, rtol=1e-14)
    np.testing.assert_allclose(again.fractiles[0.16], hazard.fractiles[0.16], rtol=1e-14)
    velocity = dd.HazardCurve([0.011, 0.07], [0.1, 0.01], im="pgv")
    (path,) = velocity.to_openquake(tmp_path, site=(0.0, 0.0))
    np.testing.assert_array_equal(dd.HazardCurve.from_openquake(path).levels, velocity.levels)
    with pytest.raises(dd.errors.InputError, match="im = 'arias': must be 'pga', 'pgv' or"):
        dd.HazardCurve([0.1, 0.2], [0.1, 0.01], im="arias").to_openquake(tmp_path, site=(0.0, 0.0))
    with pytest.raises(dd.errors.InputError, match="investigation_time = 0: must be positive"):
        velocity.to_openquake(tmp_path, site=(0.0, 0.0), investigation_time=0.0)
    with pytest.raises(dd.errors.DondoloError, match="is not a folder"):
        velocity.to_openquake(tmp_path / "none", site=(0.0, 0.0))


OPENQUAKE = """#,,,,"generated_by='OpenQuake engine 3.20.0', kind='mean', investigation_time=50.0, imt='PGV'"
lon,lat,depth,poe-3.0,poe-9.0
11.1,44.4,0.0,0.6,0.2
"""


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("imt='PGV'", "imt='MMI'", "imt = 'MMI': must be PGA, PGV, SA"),
        ("poe-9.0", "poe-9_0.0", "level = '9_0.0': must be a number"),
        ("poe-9.0", "poe-1e-99999999999999999999", "levels = 0.03, 0: must increase|levels = 0: must be positive"),
        ("0.6,0.2", "0.6,nan", "poe-9.0 = 'nan': must be a number"),
        ("time=50.0", "time=1e-320", "annual_frequency = inf: must be positive"),
        ("11.1", "9" * 200_000, "is not a CSV table: field larger than field limit"),
    ],
)
def test_files_of_openquake_that_are_refused(tmp_path, old, new, message):
    """In one sentence that names the file."""
    path = tmp_path / "hazard_curve-mean-PGV.csv"
    path.write_text(OPENQUAKE)
    assert dd.HazardCurve.from_openquake(path).levels == pytest.approx([0.03, 0.09])
    path.write_text(OPENQUAKE.replace(old, new))
    with warnings.catch_warnings():
        warnings.simplefilter("error", RuntimeWarning)
        with pytest.raises(dd.errors.InputError, match=rf"PGV\.csv: .*({message})") as error:
            dd.HazardCurve.from_openquake(path)
    assert "\n" not in str(error.value)
    with pytest.raises(dd.errors.InputError, match="paths = 5: must be the path of a file, or a sequence of them"):
        dd.HazardCurve.from_openquake(5)


@pytest.mark.parametrize(
    ("table", "frequency"),
    [
        ("pga,annual_frequency\n0.1,0.0317\n0.2,0.0318\n0.4,0.0050\n", [0.0318, 0.0318, 0.005]),
        ("pga,annual_frequency\n0.1,3.170e-2\n0.2,3.171e-2\n0.4,5.02e-5\n", [0.03171, 0.03171, 5.02e-5]),
        ("pga,return_period\n0.1,73\n0.2,72\n0.4,475\n", [1 / 72, 1 / 72, 1 / 475]),
        ("pga,poe,investigation_time\n0.1,0.99997,1\n0.2,0.99998,1\n0.4,0.2,1\n", [-np.log(2e-5)] * 2 + [-np.log(0.8)]),
    ],
)
def test_rises_in_the_last_printed_digit_are_levelled(table, frequency, tmp_path):
    path = tmp_path / "site.csv"
    path.write_text(table)
    with pytest.warns(dd.errors.DondoloWarning, match="1 frequencies rise with the level in their last printed digit"):
        curve = dd.HazardCurve.from_csv(path)
    np.testing.assert_allclose(curve.annual_frequency, frequency, rtol=1e-9)
    assert any("last printed digit" in one for one in curve.source)


def test_larger_rises_are_refused(tmp_path):
    path = tmp_path / "site.csv"
    for table in ("pga,annual_frequency\n0.1,0.0317\n0.2,0.0319\n0.4,0.0050\n", "pga,return_period\n0.1,75\n0.2,72\n"):
        path.write_text(table)
        with pytest.raises(dd.errors.InputError, match="must not increase with the level"):
            dd.HazardCurve.from_csv(path)


def test_rises_of_openquake_are_levelled(tmp_path):
    text = OLD.replace("poe-0.4", "poe-0.4,poe-0.5").replace("0.5,0.01", "9.999997E-01,9.999998E-01,2.000000E-02")
    with pytest.warns(dd.errors.DondoloWarning, match="site 0: 1 frequencies rise"):
        curve = dd.HazardCurve.from_openquake(file_of(tmp_path, text=text))
    assert curve.annual_frequency[0] == curve.annual_frequency[1]
    assert curve.annual_frequency[0] == pytest.approx(-np.log1p(-0.9999998) / 50.0)
