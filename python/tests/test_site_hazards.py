"""Hazard curves of many sites: the same as one by one, quickly, and duplicates by their numbers."""

import subprocess
import sys
import time
import warnings

import numpy as np
import pytest
from costs import growth, unit

import dondolo as dd

LEVELS = np.geomspace(0.01, 3.0, 20)


def file_of(path, sites, factors, levels=LEVELS, imt="PGA"):
    """A file as the engine exports it: in each site 2e-5 x^-2 times its factor, as probabilities in 50 years."""
    lines = [f"#{',' * (2 + len(levels))}\"generated_by='other', kind='mean', investigation_time=50.0, imt='{imt}'\""]
    lines.append(",".join(["lon", "lat", "depth", *(f"poe-{x:.7f}" for x in levels)]))
    poe = -np.expm1(-50.0 * np.multiply.outer(factors, 2e-5 * np.asarray(levels) ** -2.0))
    rows = zip(sites, poe.tolist(), strict=True)
    lines += [",".join([f"{lon:.5f},{lat:.5f},0.0", *(f"{p:.6E}" for p in row)]) for (lon, lat), row in rows]
    path.write_text("\n".join(lines) + "\n")
    return path


def grid(count):
    return [(10.0 + 0.01 * (i % 100), 44.0 + 0.01 * (i // 100)) for i in range(count)]


def test_as_one_by_one(tmp_path):
    path = file_of(tmp_path / "h.csv", grid(7), np.linspace(0.5, 1.0, 7))
    hazards = dd.read_site_hazards(path)
    assert isinstance(hazards, dd.results.SiteHazards)
    assert len(hazards) == 7
    assert hazards.im == "pga"
    for number, (site, curve) in enumerate(zip(hazards.sites, hazards, strict=True)):
        alone = dd.HazardCurve.from_openquake(path, site=number)
        np.testing.assert_array_equal(curve.annual_frequency, alone.annual_frequency)
        np.testing.assert_array_equal(curve.levels, alone.levels)
        assert curve.source == alone.source
        assert hazards[tuple(site)] is hazards[number] is curve
        assert curve(LEVELS[7]) == pytest.approx((0.5 + number / 12) * 2e-5 * LEVELS[7] ** -2.0, rel=2e-5)
    with pytest.raises(dd.errors.InputError, match="is not in"):
        hazards[10.5, 47.0]
    with pytest.raises(dd.errors.InputError, match="site = 7: must be between 0 and 6"):
        hazards[7]


@pytest.mark.slow
def test_ten_thousand_sites_take_seconds(tmp_path):
    """Two where nothing else runs, 17 of costs.unit; and eight times the sites take about eight times as long."""
    paths = {n: file_of(tmp_path / f"{n}.csv", grid(n), np.linspace(0.5, 2.0, n)) for n in (1250, 10_000)}
    assert growth(lambda n: dd.read_site_hazards(paths[n]), *paths) < 24.0
    ratios = []
    for _ in range(4):
        start = time.process_time()
        hazards = dd.read_site_hazards(paths[10_000])
        ratios.append((time.process_time() - start) / unit())
        assert len(hazards) == 10_000
        if ratios[-1] < 34.0:
            return
    pytest.fail(f"in units of costs.unit: {ratios}")


def test_duplicates_are_named(tmp_path):
    sites = [(10.0, 44.0), (10.1, 44.0), (10.0, 44.0), (10.2, 44.0), (10.1, 44.0)]
    path = file_of(tmp_path / "h.csv", sites, [1.0, 1.0, 1.0, 1.0, 2.0])
    with pytest.warns(dd.errors.DondoloWarning, match="sites with the same coordinates: 0 and 2; 1 and 4"):
        hazards = dd.read_site_hazards(path)
    assert hazards.duplicates == ((0, 2), (1, 4))
    # The same curve twice is one
    assert hazards[10.0, 44.0] is hazards[0]
    with pytest.raises(dd.errors.InputError, match="is that of the sites 1, 4, whose curves differ: give its number"):
        hazards[10.1, 44.0]
    assert hazards[4](0.1) == pytest.approx(2.0 * hazards[1](0.1), rel=1e-5)


def test_levels_left_out_are_counted(tmp_path):
    path = file_of(tmp_path / "h.csv", grid(3), [1.0, 100.0, 1.0])
    with pytest.warns(dd.errors.DondoloWarning, match="1 of 3 sites: levels with a probability of 0 or 1 are left out"):
        hazards = dd.read_site_hazards(path)
    assert len(hazards[1].levels) < len(hazards[0].levels)
    text = path.read_text().splitlines()
    text[3] = "10.1,44.0,0.0" + 20 * ",0.0"
    path.write_text("\n".join(text) + "\n")
    with pytest.raises(dd.errors.InputError, match=r"h\.csv: site 1: has fewer than two levels"):
        dd.read_site_hazards(path)
    text[3] = "10.1,44.0,0.0" + 19 * ",0.1" + ",0x1"
    path.write_text("\n".join(text) + "\n")
    with pytest.raises(dd.errors.InputError, match=r"h\.csv: site 1: poe-3.0000000 = '0x1': must be a number"):
        dd.read_site_hazards(path)


def test_averages(tmp_path):
    path = file_of(tmp_path / "h.csv", grid(2), [1.0, 2.0], imt="AvgSA")
    with pytest.raises(dd.errors.InputError, match="im of AvgSA: must be given as"):
        dd.read_site_hazards(path)
    assert dd.read_site_hazards(path, im="saavg(0.2:2)")[1].im == "saavg(0.2:2)"
    curve = dd.HazardCurve.from_openquake(path, site=0, im="saavg(0.2:2)")
    (again,) = curve.to_openquake(tmp_path, site=(10.0, 44.0), imt="AvgSA(0.5)")
    assert again.endswith("hazard_curve-mean-AvgSA(0.5).csv")
    assert dd.read_site_hazards(again, im="saavg(0.2:2)")[0].levels.tolist() == curve.levels.tolist()


def test_what_we_wrote_is_in_our_units(tmp_path):
    """Levels of 100 g are no slip of the unit where the file states it."""
    curve = dd.HazardCurve([0.1, 100.0], [0.1, 1e-9])
    curve.to_csv(tmp_path / "own.csv")
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        dd.HazardCurve.from_csv(tmp_path / "own.csv")
    (tmp_path / "other.csv").write_text("pga,annual_frequency\n0.1,0.1\n100,1e-9\n")
    with pytest.warns(dd.errors.DondoloWarning, match="m/s2"):
        dd.HazardCurve.from_csv(tmp_path / "other.csv")


def report(*words):
    return subprocess.run(
        [sys.executable, "-m", "dondolo", "report", *map(str, words)], capture_output=True, text=True, check=False
    )


def test_report_of_a_site(stripes, tmp_path):
    stripes.write_results(tmp_path / "wall")
    path = file_of(tmp_path / "h.csv", grid(3), [1.0, 2.0, 3.0])
    done = report(tmp_path / "wall", "--hazard", path)
    assert done.returncode == 2
    assert "has 3 sites" in done.stderr
    done = report(tmp_path / "wall", "--hazard", path, "--site", "10.01,44")
    assert done.returncode == 0, done.stderr
    frequency = stripes.fit().risk(dd.read_site_hazards(path)[1]).annual_frequency
    page = (tmp_path / "wall_report.html").read_text(encoding="utf-8")
    digits = f"{frequency:.2e}"
    assert digits in page or digits.replace("e-0", "e-") in page or digits.split("e")[0] in page
    for words, sentence in (
        (["--site", "10,44"], "--site: must be given with --hazard"),
        (["--hazard", path, "--site", "10"], "--site 10: must be LON,LAT in degrees"),
    ):
        done = report(tmp_path / "wall", *words)
        assert done.returncode == 2
        assert sentence in done.stderr
