"""The bootstrap of a population over records and walls, against brute force and against simulated populations."""

import numpy as np
import pytest
import study
from costs import growth
from scipy import stats

import dondolo as dd
from dondolo.curves.sample import cluster_labels
from dondolo.populations import bootstrap
from dondolo.populations.bootstrap import resample_population
from dondolo.populations.flags import Flags

pytestmark = pytest.mark.filterwarnings("ignore::dondolo.errors.DondoloWarning")

LEVELS = np.geomspace(0.15, 3.0, 12)
MECHANISMS = {"one_sided": dd.OneSidedWall, "two_block": dd.TwoBlockWall}


def flags_of(reached):
    """Flags of rows from booleans (states, levels, histories) of each; a stripe has 44 records, or twice as many."""
    histories = np.array([row.shape[-1] for row in reached], dtype=np.int32)
    records = int(histories.min())
    levels = reached[0].shape[1]
    runs = np.ones((records, levels))
    flags = Flags.empty(histories, levels, len(reached[0]), runs, cluster_labels(records))
    for i, row in enumerate(reached):
        flags.bits[flags.place(i, 1)] = np.packbits(row)
    return flags


@pytest.fixture(scope="module")
def mixed():
    """Walls with one mechanism or two, weights, groups, one polarity or both; and the flags as they are."""
    rng = np.random.default_rng(3)
    records, walls, weights, groups, p_occ, reached = 9, [], [], [], [], []
    for i in range(12):
        weight, group = rng.uniform(0.0, 2.0), ("north", "south")[i % 2]
        for mechanism in list(MECHANISMS)[: 1 + i % 3 % 2]:
            walls.append(MECHANISMS[mechanism](3.0, 0.25, name=f"wall {i}"))
            weights.append(weight if i != 4 else 0.0)
            groups.append(group)
            p_occ.append(rng.uniform(0.2, 1.0))
            count = records * (1 + i % 4 % 2)
            capacity = np.exp(rng.normal(rng.normal(0.0, 0.3), 0.5, count))
            reached.append(LEVELS[None, :, None] >= np.array([0.5, 1.0])[:, None, None] * capacity)
    return dd.Population(walls, weights, group_names=groups, p_occ=p_occ), flags_of(reached), reached


def test_flags(mixed):
    _, flags, reached = mixed
    for i, row in enumerate(reached):
        assert np.array_equal(flags.of([i])[0], row)
    counts = flags.counts(3, 7)
    assert np.array_equal(counts, np.stack([row.sum(axis=-1) for row in reached[3:10]], axis=-1))
    some = np.array([1, 4, 5, 11])
    assert np.array_equal(flags.chosen(some).counts(0, 4), np.stack([reached[i].sum(axis=-1) for i in some], axis=-1))


@pytest.mark.parametrize("mechanism", [None, "all", "one_sided", "two_block"])
@pytest.mark.parametrize("group", ["", "south"])
@pytest.mark.parametrize("over", ["records", "walls", ("records", "walls"), ("walls", "records")])
def test_brute_force(mixed, mechanism, group, over):
    """History by history, wall by wall and sample by sample."""
    population, flags, reached = mixed
    state, samples = 0, 20
    result = resample_population(population, flags.at(state), LEVELS, samples, 5, over, mechanism, group)
    names = list(
        dict.fromkeys(w.name for w, g in zip(population, population.group_names, strict=True) if group in ("", g))
    )
    rng = np.random.default_rng(5)
    records = np.ones((samples, 9), dtype=int)
    if "records" in over:
        records = rng.multinomial(9, np.full(9, 1 / 9), size=samples)
    for sample in range(samples):
        drawn = names if "walls" not in over else [names[i] for i in rng.integers(len(names), size=len(names))]
        above, below, occurring = np.zeros(len(LEVELS)), 0.0, 0.0
        for name in drawn:
            rows = [i for i, wall in enumerate(population) if wall.name == name]
            survival, never = np.ones(len(LEVELS)), 1.0
            for i in rows:
                number = reached[i].shape[-1]
                times = np.array([records[sample][k % 9] for k in range(number)])
                fraction = (reached[i][state] * times).sum(axis=-1) / number
                if mechanism in (None, "all"):
                    survival *= 1.0 - population.p_occ[i] * fraction
                    never *= 1.0 - population.p_occ[i]
                elif population[i].mechanism == mechanism:
                    weight = population.weights[i] * population.p_occ[i]
                    above, below, occurring = above + weight * fraction, below + weight, occurring + weight
            if mechanism in (None, "all"):
                above = above + population.weights[rows[0]] * (1.0 - survival)
                below += population.weights[rows[0]]
                occurring += population.weights[rows[0]] * (1.0 - never)
        if below == 0.0:
            # None of the walls that were drawn has the mechanism.
            assert np.isnan(result.mean_fraction[sample]).all()
            assert (result.status[sample], np.isnan(result.theta[sample])) == ("", True)
            continue
        assert result.mean_fraction[sample] == pytest.approx(above / below, rel=1e-12)
        assert result.upper_asymptote[sample] == pytest.approx(occurring / below, rel=1e-12)
        curve = dd.fit_fragility(LEVELS, np.minimum(above / occurring, 1.0), 1.0)
        if curve.has_fit and result.status[sample]:
            assert (result.theta[sample], result.beta[sample]) == pytest.approx((curve.theta, curve.beta), rel=1e-6)
    assert result.over == tuple(kind for kind in ("records", "walls") if kind in over)


def test_chunks_change_nothing(mixed, monkeypatch):

    population, flags, _ = mixed
    whole = resample_population(population, flags, LEVELS, n_resamples=50)
    monkeypatch.setattr(bootstrap, "_DRAWS", 30)
    monkeypatch.setattr(bootstrap, "_FRACTIONS", 100)
    parts = resample_population(population, flags, LEVELS, n_resamples=50)
    assert parts.mean_fraction == pytest.approx(whole.mean_fraction, rel=1e-12)


def simulated(rng, walls, records, spread=0.3, shared=0.4, own=0.3):
    """Walls that are all shaken by the same records: ln capacity = of the wall + of the record + of the history."""
    of_wall, of_record = rng.normal(0.0, spread, walls), rng.normal(0.0, shared, records)
    capacity = of_wall[:, None] + of_record + rng.normal(0.0, own, (walls, records))
    return flags_of(list(np.log(LEVELS)[:, None] >= capacity[:, None, None, :]))


def people(walls):
    wall = dd.OneSidedWall(3.0, 0.25)
    # The same wall under many names
    return dd.Population([type(wall)(3.0, 0.25, name=f"wall {i}") for i in range(walls)])


def test_standard_errors_and_coverage():
    """Against many populations and record sets: the bootstrap knows their spread, the fit's own error does not."""
    rng = np.random.default_rng(11)
    population, studies = people(25), 80
    thetas, own, both, records, walls, inside = [], [], [], [], [], []
    for study_number in range(studies):
        flags = simulated(rng, 25, 20)
        curve = dd.fit_fragility(LEVELS, flags.counts(0, 25)[0].sum(axis=1), 500)
        thetas.append(np.log(curve.theta))
        own.append(curve.se_ln_theta)
        samples = resample_population(population, flags, LEVELS, n_resamples=100)
        both.append(samples.se_ln_theta)
        low, high = samples.parameter_interval(confidence=0.9)["theta"]
        # What infinitely many walls and records would give
        inside.append(low <= 1.0 <= high)
        if study_number < 20:
            records.append(resample_population(population, flags, LEVELS, n_resamples=100, over="records").se_ln_theta)
            walls.append(resample_population(population, flags, LEVELS, n_resamples=100, over="walls").se_ln_theta)
    spread = np.std(thetas, ddof=1)
    assert np.mean(both) == pytest.approx(spread, rel=0.15)
    assert np.mean(records) == pytest.approx(np.sqrt(0.4**2 / 20 + 0.3**2 / 500), rel=0.15)
    assert np.mean(walls) == pytest.approx(np.sqrt(0.3**2 / 25 + 0.3**2 / 500), rel=0.15)
    # 500 histories that are not independent
    assert np.mean(own) < 0.4 * spread
    assert 0.82 < np.mean(inside) < 0.97


def test_of_a_typology():
    """Of real walls and records, which shake all walls alike."""
    given = study.arguments(edp_thresholds=None)
    typology = dd.typology(**given)
    samples = typology["all"].bootstrap(n_resamples=300)
    assert samples.over == ("records", "walls")
    again = typology["all"].bootstrap(n_resamples=300)
    assert np.array_equal(samples.theta, again.theta, equal_nan=True)
    assert np.std(np.log(typology["all"].bootstrap(n_resamples=300, rng=1).theta)) == pytest.approx(
        samples.se_ln_theta, rel=0.2
    )
    curve = typology["all"].fit
    # The sandwich estimates the same, with the records and the walls apart
    assert (curve.errors, [part.kind for part in curve.parts]) == ("clustered", ["records", "walls"])
    assert samples.se_ln_theta > 2.0 * np.sqrt(curve.naive_covariance[0, 0])
    for part, over in zip(curve.parts, ("records", "walls"), strict=True):
        drawn = typology["all"].bootstrap(n_resamples=1000, over=over)
        own = np.sqrt(np.diag(part.covariance))
        assert own == pytest.approx([drawn.se_ln_theta, drawn.se_beta], rel=0.25)
    row = next(curve for curve in typology.curves if curve.has_fit)
    alone = dd.multiple_stripe(
        row.wall, given["records"], given["levels"], polarity=given["polarity"], progress=False
    ).fit()
    np.testing.assert_allclose(row.covariance, alone.covariance, rtol=1e-9)
    assert (row.clusters, row.degrees_of_freedom) == (alone.clusters, alone.degrees_of_freedom)
    records, walls = (
        typology["all"].bootstrap(n_resamples=300, over="records"),
        typology["all"].bootstrap(n_resamples=300, over="walls"),
    )
    assert samples.se_ln_theta > max(records.se_ln_theta, walls.se_ln_theta)
    low, high = samples.mean_interval()
    assert np.all((low <= typology["all"].mean_fraction) & (typology["all"].mean_fraction <= high))
    low, high = samples.parameter_interval()["theta"]
    assert low < curve.theta < high
    low, high = samples.interval(curve.theta)
    assert low < 0.5 < high
    assert repr(samples) == "<TypologyBootstrap over records and walls: 300 samples, 0.0% without a fit>"
    # A damage state of its own
    states = dd.typology(**study.arguments())
    light = states.at(0.1)["all"].bootstrap(n_resamples=50, over="walls")
    flags = states.flags.at(0)
    assert np.array_equal(
        light.theta, resample_population(states.population, flags, states.levels, 50, 0, "walls").theta
    )
    assert np.median(light.theta) < np.median(states["all"].bootstrap(n_resamples=50, over="walls").theta)
    # One wall drawn over its records is the bootstrap of its stripes.
    wall = given["population"][2]
    alone = dd.typology([wall], given["records"], given["levels"], progress=False)["all"].bootstrap(
        n_resamples=100, over="records"
    )
    stripes = dd.multiple_stripe(wall, given["records"], given["levels"], progress=False)
    if stripes.fit().has_fit:
        theta = stripes.fit().bootstrap(n_resamples=100).theta
        assert alone.theta == pytest.approx(theta, rel=1e-9, nan_ok=True)


def test_errors(mixed):
    population, flags, _ = mixed
    for wrong, sentence in (
        ({"over": "stones"}, "over = 'stones': must name 'records', 'walls' or both"),
        ({"over": ()}, r"over = \(\): must name"),
        ({"over": 3}, "over = 3: must name"),
        ({"rng": "a"}, "rng = 'a': must be an integer"),
        ({"events": ["a"] * 9}, "events: at least two are needed"),
        ({"n_resamples": 0}, "n_resamples = 0: must be an integer, at least 1"),
        ({"group": "west"}, "group = 'west': must be one of '', 'north', 'south'"),
        ({"mechanism": "arch"}, "mechanism = 'arch': must be one of 'one_sided', 'two_block', 'all'"),
    ):
        with pytest.raises(dd.errors.InputError, match=sentence):
            resample_population(population, flags, LEVELS, **wrong)


def test_one_wall_is_not_drawn_from_itself(mixed):
    population, flags, _ = mixed
    one, own = population[:1], flags.chosen(np.array([0]))
    both = resample_population(one, own, LEVELS, 200, 3)
    assert both.over == ("records",)
    np.testing.assert_array_equal(both.theta, resample_population(one, own, LEVELS, 200, 3, "records").theta)
    with pytest.raises(dd.errors.InputError, match="walls: at least two are needed to draw from, there is 1"):
        resample_population(one, own, LEVELS, 200, 3, "walls")


def test_many_walls_take_linear_time():
    flags = {count: simulated(np.random.default_rng(0), count, 44) for count in (200, 1600)}
    assert (
        growth(lambda count: resample_population(people(count), flags[count], LEVELS, n_resamples=100), 200, 1600)
        < 24.0
    )


def test_records_of_one_event_are_drawn_together(mixed):
    """Two copies of every record are no more evidence than one, if it is said which belong together."""
    population, flags, reached = mixed
    twice = [
        np.concatenate([row[..., k * 9 : (k + 1) * 9].repeat(2, axis=-1) for k in range(row.shape[-1] // 9)], axis=-1)
        for row in reached
    ]
    doubled = flags_of(twice)
    once = resample_population(population, flags, LEVELS, 200, 3, "records")
    paired = resample_population(population, doubled, LEVELS, 200, 3, "records", events=[i // 2 for i in range(18)])
    apart = resample_population(population, doubled, LEVELS, 200, 3, "records")
    assert paired.mean_fraction == pytest.approx(once.mean_fraction, rel=1e-12)
    assert apart.mean_fraction.std(axis=0).max() < 0.85 * paired.mean_fraction.std(axis=0).max()
    with pytest.raises(dd.errors.InputError, match="events: 2 labels for 9 records: must be as many"):
        resample_population(population, flags, LEVELS, 5, events=["a", "b"])


def test_events_of_unequal_size(few):
    """Each sample has both of two events or one of them twice, so that it has one of three mean curves."""
    walls = [dd.OneSidedWall(1.5, 0.25, name="a"), dd.TwoBlockWall(2.0, 0.12, name="b")]
    whole, *parts = (
        dd.typology(walls, records, LEVELS, polarity="both", progress=False) for records in (few, few[:6], few[6:])
    )
    expected = np.array([one["all"].mean_fraction for one in (whole, *parts)])
    samples = whole["all"].bootstrap(n_resamples=400, rng=3, over="records", events=["large"] * 6 + ["small"] * 2)
    off = np.abs(samples.mean_fraction[:, None] - expected).max(axis=2)
    assert off.min(axis=1).max() < 1e-12
    often = np.bincount(off.argmin(axis=1), minlength=3)
    assert stats.chisquare(often, [200, 100, 100]).pvalue > 0.01


def test_the_interval_ends_at_the_saturation(few):
    """At strong motions the interval is that of the upper asymptote."""
    walls = [dd.OneSidedWall(1.5, 0.25, name="a"), dd.OneSidedWall(1.8, 0.25, name="b")]
    typology = dd.typology(dd.Population(walls, p_occ=[0.5, 0.2]), few, LEVELS, progress=False)
    assert typology["all"].bootstrap(n_resamples=50, over="records").interval(1e3) == pytest.approx(
        (0.35, 0.35), rel=1e-12
    )
    # Some samples have the first wall twice, some the second.
    assert typology["all"].bootstrap(n_resamples=50, over="walls").interval(1e3) == pytest.approx((0.2, 0.5), rel=1e-12)
