"""Sets of records, records of their own at each level, and selection to a target spectrum."""

import pickle
import re
import subprocess
import sys
import warnings
from pathlib import Path

import numpy as np
import pytest

import dondolo as dd
from dondolo.records.level_rows import scaled_records
from dondolo.records.target import correlation

PERIODS = [0.1, 0.3, 0.6, 1.0, 2.0, 3.0]


@pytest.fixture(scope="module")
def records():
    return dd.RecordSet(dd.synthetic_records(6.5, 10.0, "shallow", n_records=12))


@pytest.fixture(scope="module")
def sets(records):
    return {0.6: records[:6], 0.8: records[4:], 1.0: dd.RecordSet(records[2:5], factor=2.0)}


@pytest.fixture(scope="module")
def parapet():
    return dd.OneSidedWall(height=1.5, thickness=0.25, name="parapet")


def test_table(records):
    assert len(records.filter("magnitude > 6 and site in ['shallow'] and not pga < 0")) == 12
    few = records.filter("`sa(0.5)` > 0.5 or realisation == 0")
    high = [record.intensity("sa(0.5)") > 0.5 or record.metadata["realisation"] == "0" for record in records]
    assert [record.name for record in few] == [one.name for one, here in zip(records, high, strict=True) if here]
    assert list(records.sort("pga", descending=True)["pga"]) == sorted(records["pga"], reverse=True)

    assert len(records[:3] + records[3:]) == 12
    for wrong in ("pga >", "nothing > 1", "pga", "open('x')", "pga > 1e9"):
        with pytest.raises(dd.errors.InputError):
            records.filter(wrong)
    with pytest.raises(dd.errors.InputError, match=r"factor = -1: must be positive"):
        dd.RecordSet(records, factor=-1.0)


@pytest.mark.parametrize("values", [("2", "", "10", "2", ""), ("b", "", "a10", "b", "")], ids=["numbers", "texts"])
def test_missing_values_are_sorted_last(values):
    """In both directions, and rows of equal values keep their order."""
    samples = np.sin(np.arange(50.0))
    made = [
        dd.Record(samples, 0.01, f"r{i}", metadata={"magnitude": value} if value else {"other": "1"})
        for i, value in enumerate(values)
    ]
    records = dd.RecordSet(made)
    rising, falling = (records.sort("magnitude", descending=way)["record"].tolist() for way in (False, True))
    first = ["r0", "r3", "r2"] if values[0] == "2" else ["r2", "r0", "r3"]
    assert rising == [*first, "r1", "r4"]
    assert falling == (["r2", "r0", "r3"] if values[0] == "2" else ["r0", "r3", "r2"]) + ["r1", "r4"]


def test_each_level_runs_its_records_alone(records, sets, parapet):
    whole = dd.multiple_stripe(parapet, records, [0.6, 0.8, 1.0], polarity="both", progress=False)
    some = dd.multiple_stripe(parapet, sets, polarity="both", progress=False)
    assert list(some.histories) == [12, 16, 6]
    assert some.work.histories == 34
    assert np.array_equal(some.edp[0, :6], whole.edp[0, :6])
    assert np.isnan(some.edp[0, 6:12]).all()
    assert np.all(some.scale[2][some.ran[2]] == 2.0)
    curve = some.fit()
    again = dd.fit_fragility(some.levels, some.collapses, some.histories)
    assert (curve.theta, curve.beta) == (again.theta, again.beta)
    assert np.isfinite(curve.bootstrap(n_resamples=50).theta).any()
    some.plot()


def test_the_report_of_records_of_their_own(sets, parapet, tmp_path):
    """Medians and errors are of the histories that run: no dash, and no NaN."""
    from dondolo.reporting import wall

    some = dd.multiple_stripe(parapet, sets, polarity="both", estimate_error=True, progress=False)
    medians = [float(np.median(some.edp[i, some.ran[i]])) for i in range(3)]
    page = tmp_path / "stripes.html"
    dd.report(some, page)
    text = re.sub(r"<[^>]+>", " ", page.read_text(encoding="utf-8"))
    assert "nan" not in text.lower().split()
    *_states, levels = wall.numbers(some, [some.fit()])
    heads = [one.head for one in levels.table.columns]
    cells = [row[heads.index("median EDP")] for row in levels.table.rows]
    assert [one.text for one in cells] == [f"{value:.3g}" for value in medians]
    assert some.edp_error is not None
    largest = f"{float(some.edp_error[some.ran].max()):.3g}"
    assert largest.partition("e")[0] in text.partition("largest estimated error of an EDP")[2][:60]


def test_stripes_are_joined_and_cut(records, parapet):
    whole = dd.multiple_stripe(parapet, records, [0.6, 0.8], progress=False)
    one = dd.multiple_stripe(parapet, records[:5], [0.6, 0.8], progress=False)
    other = dd.multiple_stripe(parapet, records[5:], [0.6, 0.8, 1.0], progress=False)
    both = one + other
    assert list(both.histories) == [12, 12, 7]
    assert np.array_equal(both[:2].edp, whole.edp)
    assert np.array_equal(whole[whole.levels > 0.7, :4].edp, whole.edp[1:, :4])
    with pytest.raises(dd.errors.InputError, match="runs in both stripes"):
        whole + one
    with pytest.raises(dd.errors.InputError, match="must belong to one"):
        one + dd.multiple_stripe(dd.OneSidedWall(2.0, 0.25), records[:2], [0.6], progress=False)
    # The tables of two floors look alike
    floors = [dd.Building(period, storeys=3, level=6.0, building_height=9.0) for period in (0.3000001, 0.3000004)]
    first, second = (
        dd.multiple_stripe(dd.OneSidedWall(1.5, 0.25, building=floor), records[:2], [level], progress=False)
        for floor, level in zip(floors, (0.5, 0.6), strict=True)
    )
    with pytest.raises(dd.errors.InputError, match="must belong to one"):
        first + second


def test_a_run_counts_once(records, parapet):
    """Its work is whole in every part of it, and once in what parts are joined to."""
    run = dd.multiple_stripe(parapet, records[:6], [0.6, 0.8], progress=False)
    more = dd.multiple_stripe(parapet, records[6:], [0.6, 0.8], progress=False)
    assert run[:1].work == run[:, :2].work == (run[:1] + run[1:]).work == (run[:, ::2] + run[:, 1::2]).work == run.work
    for both in (run + more, run[:1] + more + run[1:], (run + more)[:1] + (run + more)[1:]):
        assert both.work == dd.results.Work.total([run.work, more.work])
    again = pickle.loads(pickle.dumps(run))
    assert (run[:1] + again[1:]).work == run.work


def test_levels_that_differ_by_rounding_are_the_same(records, parapet):
    assert 0.1 * 3 > 0.3
    one, other = (
        dd.multiple_stripe(parapet, part, [level], progress=False)
        for part, level in ((records[:2], 0.3), (records[2:4], 0.1 * 3))
    )
    both = one + other
    assert both.levels.tolist() == [0.3]
    assert both.histories.tolist() == [4]
    with pytest.raises(dd.errors.InputError, match=r"levels = 0\.3: record .* runs in both stripes"):
        one + dd.multiple_stripe(parapet, records[:2], [0.1 * 3, 0.6], progress=False)


def test_stripes_in_turn(records, parapet):
    whole = dd.multiple_stripe(parapet, records, [0.6, 0.8], progress=False)
    assert len(whole) == 2
    assert [stripe.levels.tolist() for stripe in whole] == [[0.6], [0.8]]


def test_the_executable_runs_the_catalogue(sets, parapet, tmp_path):
    dd.RecordSet.of_levels(sets).to_catalogue(tmp_path / "sets.csv")
    back = dd.read_catalogue(tmp_path / "sets.csv")
    mine = dd.multiple_stripe(parapet, sets, polarity="both", progress=False)
    assert np.array_equal(
        dd.multiple_stripe(parapet, back, polarity="both", progress=False).edp, mine.edp, equal_nan=True
    )
    (tmp_path / "a.nml").write_text(
        f"&job output = '{tmp_path}/out' /\n"
        "&wall name = 'parapet' mechanism = 'one_sided' height = 1.5 thickness = 0.25 /\n"
        "&records catalogue = 'sets.csv' polarity = 'both' /\n&stripes levels = 0.6, 0.8, 1.0 /\n"
    )
    executable = Path(sys.executable).parent / "dondolo"
    subprocess.run([executable, tmp_path / "a.nml"], check=True, capture_output=True)
    assert np.array_equal(dd.read_results(tmp_path / "out").stripes.edp, mine.edp, equal_nan=True)


def test_bad_levels(records, parapet):
    with pytest.raises(
        dd.errors.InputError, match=r"levels = 0\.3, 0\.30000000000000004: are the same but for rounding"
    ):
        dd.multiple_stripe(parapet, {0.1 + 0.2: records[:2], 0.3: records[2:]})
    with pytest.raises(dd.errors.InputError, match=r"levels = 0\.8: no record runs at this level"):
        dd.multiple_stripe(parapet, {0.6: records[:2], 0.8: []})
    with pytest.raises(dd.errors.InputError, match=r"levels: do not include 0\.7"):
        dd.multiple_stripe(parapet, {0.7: records[:2]}, [0.6])
    with pytest.raises(dd.errors.InputError, match="levels: must be given"):
        dd.multiple_stripe(parapet, records)


def test_spectra_of_the_codes():
    # By hand: soil C, S_S = 1.7 - 0.6 2.4 0.2 = 1.412, T_C = 1.05 0.32^0.67 = 0.48940 s, T_D = 2.4 s
    ntc = dd.Site(0.2, 2.4, 0.32, soil="C").spectrum(periods=PERIODS)
    a, tc = 0.2 * 1.412, 1.05 * 0.32**0.67
    expected = [
        a * (1.0 + 0.3 / tc * 1.4),
        a * 2.4,
        *(a * 2.4 * tc / t for t in PERIODS[2:5]),
        a * 2.4 * tc * 2.4 / 9.0,
    ]
    np.testing.assert_allclose(ntc.sa, expected, rtol=1e-12)
    np.testing.assert_allclose(
        dd.Site(0.2, 2.4, 0.32, topography="T4").spectrum(periods=PERIODS).sa[1], 0.2 * 1.4 * 2.4
    )
    # EC8, type 1, ground C: S = 1.15, T_B = 0.2, T_C = 0.6, T_D = 2 s
    ec8 = dd.TargetSpectrum.ec8(0.25, soil="C", periods=PERIODS)
    np.testing.assert_allclose(
        ec8.sa[[0, 1, 3, 5]], 0.2875 * np.array([1.75, 2.5, 1.5, 2.5 * 0.6 * 2.0 / 9.0]), rtol=1e-12
    )
    with pytest.raises(dd.errors.InputError, match=r"f0 = 2: must lie between 2\.2 and 5"):
        dd.Site(0.2, 2.0, 0.3)


def test_conditional_spectrum():
    # Baker and Jayaram (2008): 1 - cos(pi/2 - 0.366 ln(1/0.2)) for 0.2 and 1 s
    rho = correlation(np.array([0.2]), np.array([1.0]))[0, 0]
    assert rho == pytest.approx(1.0 - np.cos(np.pi / 2.0 - 0.366 * np.log(5.0)))
    plain = dd.TargetSpectrum([0.2, 0.5, 1.0], [0.6, 0.4, 0.2], dispersion=0.6)
    given = plain.conditional(0.2, 0.9)
    assert given.sa[0] == pytest.approx(0.9)
    assert given.sa[2] == pytest.approx(0.2 * np.exp(rho * np.log(1.5)))
    assert given.dispersion[0] == 0.0
    assert given.dispersion[2] == pytest.approx(0.6 * np.sqrt(1.0 - rho**2))


def test_selection(records):
    target = dd.TargetSpectrum.ec8(0.35, soil="B", periods=PERIODS)
    found = dd.RecordSet(records).select(target, 5)
    assert len({record.name for record in found.records}) == 5
    scaled = found.records.spectra(PERIODS)
    np.testing.assert_allclose(found.sa, scaled, rtol=1e-12)
    # No exchange of one record for another lowers the cost
    cost = np.sum(np.log(found.median / target.sa) ** 2) + 0.1 * np.sum(found.dispersion**2)
    ln_sa = np.log(dd.RecordSet(records).spectra(PERIODS))
    ln_sa += (np.log(target.sa) - ln_sa).mean(axis=1)[:, None]
    names, taken = [record.name for record in records], [record.name for record in found.records]
    for i in range(5):
        for name in set(names) - set(taken):
            other = ln_sa[[names.index(name if k == i else one) for k, one in enumerate(taken)]]
            changed = np.sum((other.mean(axis=0) - np.log(target.sa)) ** 2) + 0.1 * np.sum(
                other.std(axis=0, ddof=1) ** 2
            )
            assert changed > cost * (1.0 - 1e-9)
    found.plot()
    at = dd.TargetSpectrum(PERIODS, target.sa, dispersion=0.5).conditional(0.5, 0.6)
    chosen = dd.RecordSet(records).select(at, 4, max_factor=10.0)
    here = list(at.periods).index(0.5)
    np.testing.assert_allclose(chosen.sa[:, here], 0.6, rtol=1e-12)
    with pytest.raises(dd.errors.InputError, match="records can be scaled"):
        dd.RecordSet(records).select(dd.TargetSpectrum.ec8(30.0, periods=PERIODS), 5, max_factor=1.5)


@pytest.mark.parametrize(("im", "power"), [("pga", 1), ("arias", 2)])
def test_factors_that_miss_their_level(records, wall, im, power):
    """A factor of ones own may take a record elsewhere; beyond 10 % that is said."""
    values = [record.intensity(im) for record in records[:3]]
    level = 1.5 * values[0]
    exact = [(level / value) ** (1.0 / power) for value in values]
    near = [exact[0], 1.08 ** (1.0 / power) * exact[1], exact[2]]
    far = [*near[:2], (0.5) ** (1.0 / power) * exact[2]]
    for factors, told in ((near, []), (far, [f"record '{records[2].name}' has {im} = {0.5 * level:.4g} at level"])):
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            dd.multiple_stripe(wall, {level: dd.RecordSet(records[:3], factor=factors)}, im=im, progress=False)
        found = [one.message for one in caught if one.message.code == "factors_off_levels"]
        assert len(found) == len(told)
        for one, words in zip(found, told, strict=True):
            assert "more than 10 % off their levels: 1 of 3" in str(one)
            assert words in str(one)
            assert one.numbers["factors"] == 3


@pytest.mark.parametrize(
    ("more", "sentence"),
    [
        ({"dispersion": "x"}, "dispersion = 'x': must be a number"),
        ({"dispersion": [0.1]}, "dispersion: must be one number, or one for each period"),
        ({"damping": -1.0}, "damping = -1: must be at least 0 and below 1"),
        ({"damping": np.nan}, "damping = nan: must be at least 0 and below 1"),
    ],
)
def test_wrong_targets(more, sentence):
    with pytest.raises(dd.errors.InputError, match=sentence):
        dd.TargetSpectrum([0.1, 0.5], [0.5, 0.4], **more)


def test_kinds_of_eurocode_8():
    with pytest.raises(dd.errors.InputError, match=r"kind = \[1\]: must be 1 or 2"):
        dd.TargetSpectrum.ec8(0.2, kind=[1])


def test_a_set_with_factors_is_heeded_or_refused(records, parapet):
    """Analyses without levels take the scaled records, those that choose levels or factors refuse the set."""
    factors = np.linspace(0.5, 3.0, len(records))
    scaled = dd.RecordSet(records, factor=factors)
    assert dd.RecordSet(scaled).factor.tolist() == factors.tolist()
    cloud = dd.cloud(parapet, scaled, progress=False)
    by_hand = [
        dd.Record(factor * one.acceleration, one.dt, one.name) for one, factor in zip(records, factors, strict=True)
    ]
    same = dd.cloud(parapet, by_hand, progress=False)
    np.testing.assert_array_equal(cloud.edp, same.edp)
    np.testing.assert_array_equal(cloud.intensity, same.intensity)
    plain = dd.cloud(parapet, records, progress=False)
    np.testing.assert_allclose(cloud.intensity, factors * plain.intensity, rtol=1e-12)
    assert not np.array_equal(cloud.edp, plain.edp)
    assert cloud.records[0].processing[-1] == "times 0.5"
    table = dd.RecordSet(scaled).intensity_table(("pga", "arias", "d5-95"))
    as_they_stand = dd.RecordSet(records).intensity_table(("pga", "arias", "d5-95"))
    for name, power in (("pga [g]", 1), ("arias [m/s]", 2), ("d5-95 [s]", 0)):
        np.testing.assert_allclose(table[name], factors**power * as_they_stand[name], rtol=1e-12)
    at_levels = dd.RecordSet(records, level=0.5)
    for run in (lambda one: dd.cloud(parapet, one, progress=False), dd.RecordSet.intensity_table):
        with pytest.raises(dd.errors.InputError, match="has a level and no factor"):
            run(at_levels)
    target = dd.TargetSpectrum.ec8(0.25, soil="C", periods=PERIODS)
    for one, what in ((scaled, "factor"), (at_levels, "level")):
        for run in (
            lambda one: dd.compare_intensities(parapet, one, ["pga"], progress=False),
            lambda one: dd.RecordSet(one).select(target, 3),
        ):
            with pytest.raises(dd.errors.InputError, match=f"records: have {what}s of their own"):
                run(one)
    with pytest.raises(dd.errors.InputError, match="have factors and no levels"):
        dd.adaptive_stripes(parapet, scaled, budget=200, progress=False)


def test_a_record_of_several_rows(records, parapet):
    twice = dd.RecordSet([*records[:3], records[0]], factor=[1.0, 1.0, 1.0, 2.0])
    pga = dd.RecordSet(twice).intensity_table("pga")["pga [g]"]
    assert pga[3] == 2.0 * pga[0]
    assert len(dd.cloud(parapet, twice, progress=False).edp) == 4


def test_factors_of_the_vertical_component():
    motion = np.sin(np.linspace(0.0, 9.0, 200))
    record = dd.Record(motion, 0.01, vertical=0.5 * motion)
    (scaled,) = scaled_records(dd.RecordSet(record, factor=2.0))
    np.testing.assert_array_equal(scaled.acceleration, 2.0 * motion)
    np.testing.assert_array_equal(scaled.vertical, motion)


def test_floors_of_a_set(records):
    """Twice as strong where the factors are 2."""
    building = dd.Building(period=0.3, participation=1.3)
    once, twice = (building.plot(records=dd.RecordSet(records, factor=factor)) for factor in (1.0, 2.0))
    for one, other in zip(once.get_lines()[:12], twice.get_lines()[:12], strict=True):
        np.testing.assert_allclose(2.0 * one.get_ydata(), other.get_ydata(), rtol=1e-12)


def test_designs_and_variants_run_the_records_of_a_set(sets, parapet):
    """With their levels and factors, as `multiple_stripe` does."""
    joined = dd.RecordSet.of_levels(sets)
    alone = dd.multiple_stripe(parapet, sets, progress=False)
    designs = dd.compare_designs({"as it stands": parapet}, joined, [0.6, 0.8, 1.0], progress=False)
    np.testing.assert_array_equal(designs.stripes[0].edp, alone.edp)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", dd.errors.DondoloWarning)
        unsure = dd.propagate_uncertainty(
            parapet,
            joined,
            [0.6, 0.8, 1.0],
            sources={"density": dd.distributions.Uniform(1700.0, 1900.0)},
            n_variants=10,
            progress=False,
        )
    assert unsure.typology.curves[0].histories.tolist() == alone.ran.sum(axis=1).tolist()


@pytest.mark.parametrize(
    ("condition", "sentence"),
    [
        ("sa(0.5) > 0.3", "a name that is none in Python must stand between backticks, `sa(0.5)`"),
        ("pga > 0,3", "commas make a list, decimals have a point"),
        ("pga > 'a'", "combines what does not go together, such as numbers with texts or lists"),
        ("pga > [1, 2]", "combines what does not go together, such as numbers with texts or lists"),
    ],
)
def test_conditions_say_what_is_wrong(records, condition, sentence):
    with pytest.raises(dd.errors.InputError) as caught:
        records.filter(condition)
    assert str(caught.value).endswith(sentence)
    assert str(caught.value).count("expression = ") == 1


def test_a_selection_is_no_record(records, parapet):
    selection = dd.RecordSet(records).select(dd.TargetSpectrum.ec8(0.25, soil="C", periods=PERIODS), 3)
    with pytest.raises(dd.errors.InputError, match=r"not Selection \(it has them as its attribute records"):
        dd.multiple_stripe(parapet, selection, [0.5], progress=False)
    site = dd.Site(ag=0.2, f0=2.5, tc_star=0.35, soil="B")
    check = dd.check_ntc(parapet, site)
    with pytest.raises(dd.errors.InputError, match=r"must be given as \{level: records\}, or without factors"):
        check.dynamic(selection.records)
    levels = {site.pga(limit_state=state): selection.records for state in ("SLV", "SLC")}
    assert "dynamic" in {row.method for row in check.dynamic(levels).rows}
