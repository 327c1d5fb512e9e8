"""Combination of mechanisms and walls, against a simulation of the mixture that knows none of the formulas."""

import pickle

import matplotlib.pyplot as plt
import numpy as np
import pytest
import study
from matplotlib.colors import to_rgba

import dondolo as dd
from dondolo.analysis.work import Work
from dondolo.populations import plots
from dondolo.populations.combination import combine

pytestmark = pytest.mark.filterwarnings("ignore::dondolo.errors.DondoloWarning")

LEVELS = np.geomspace(0.05, 3.0, 25)
HISTORIES = 1_000_000
SAMPLES = 400_000
KINDS = {"one_sided": dd.OneSidedWall, "two_block": dd.TwoBlockWall, "free_standing": dd.FreeStandingWall}

# Name, group, weight, and of each mechanism theta, beta and the probability of occurrence
WALLS = [
    ("a", "facades", 3.0, {"one_sided": (0.35, 0.40, 0.3), "two_block": (0.60, 0.35, 0.8)}),
    ("b", "facades", 1.0, {"one_sided": (0.25, 0.30, 1.0), "two_block": (0.45, 0.45, 0.5)}),
    ("c", "towers", 2.0, {"two_block": (0.90, 0.50, 0.6)}),
    ("d", "", 0.5, {"one_sided": (0.50, 0.25, 1.0)}),
    (
        "e",
        "facades",
        4.0,
        {"free_standing": (0.30, 0.60, 0.4), "one_sided": (0.55, 0.3, 0.9), "two_block": (0.8, 0.2, 0.7)},
    ),
    ("f", "towers", 0.0, {"one_sided": (0.1, 0.2, 1.0)}),
]


def typology_of(walls, levels=LEVELS, histories=HISTORIES):
    """The typology of walls whose histories collapse as often as their curves say."""
    from scipy.special import ndtr

    rows = [(name, group, weight, *row) for name, group, weight, mechanisms in walls for row in mechanisms.items()]
    people = dd.Population(
        tuple(KINDS[row[3]](3.0, 0.3, name=row[0]) for row in rows),
        [row[2] for row in rows],
        group_names=tuple(row[1] for row in rows),
        p_occ=[row[4][2] for row in rows],
    )
    share = [ndtr(np.log(levels / theta) / beta) for *_, (theta, beta, _) in rows]
    counts = np.round(np.array(share).T * histories)[None].astype(np.int32)
    sizes = np.full((len(levels), len(rows)), histories, dtype=np.int32)
    complete = np.ones(len(rows), dtype=bool)
    return combine(people, "pga", levels, np.ones(1), counts, sizes, complete, Work())


@pytest.fixture(autouse=True)
def closed_figures():
    yield
    plt.close("all")


@pytest.fixture(scope="module")
def people():
    """Six walls of one to three mechanisms in two groups."""
    return typology_of(WALLS)


def simulate(walls, mechanism=None, seed=1):
    """Capacities of walls drawn by weight: inf where no mechanism is active; and which wall each is of."""
    rng = np.random.default_rng(seed)
    weight = np.array([wall[2] for wall in walls])
    drawn = rng.choice(len(walls), SAMPLES, p=weight / weight.sum())
    capacity = np.full(SAMPLES, np.inf)
    for i, (*_, mechanisms) in enumerate(walls):
        place = np.flatnonzero(drawn == i)
        for name, (theta, beta, p_occ) in mechanisms.items():
            if mechanism not in (None, name):
                continue
            own = theta * np.exp(beta * rng.standard_normal(len(place)))
            own[rng.random(len(place)) >= p_occ] = np.inf
            capacity[place] = np.minimum(capacity[place], own)
    return capacity, drawn


def close(mean, capacity, x):
    """Does a mean curve lie within four standard errors of the simulated one?"""
    simulated = np.mean(capacity[:, None] <= x, axis=0)
    # Never less than what one capacity more or less makes
    error = np.sqrt(np.maximum(mean * (1.0 - mean), 1.0 / len(capacity)) / len(capacity))
    return np.all(np.abs(mean - simulated) < 4.0 * error)


X = np.array([0.12, 0.2, 0.3, 0.45, 0.6, 0.9, 1.4])


@pytest.mark.parametrize("group", ["", "facades", "towers"])
def test_mean_of_all_mechanisms(people, group):
    capacity, _ = simulate([wall for wall in WALLS if group in ("", wall[1])])
    assert close(people["all", group](X), capacity, X)


@pytest.mark.parametrize("mechanism", list(KINDS))
def test_mean_of_one_mechanism(people, mechanism):
    capacity, _ = simulate(WALLS, mechanism)
    # Given that it can occur: walls count as often as it does.
    capacity = capacity[np.isfinite(capacity)]
    assert close(people[mechanism](X), capacity, X)
    chances = [wall[2] * wall[3][mechanism][2] for wall in WALLS if mechanism in wall[3]]
    assert people[mechanism].weight == pytest.approx(sum(chances))
    # The walls that the risk is made of have the same mean.
    members = people[mechanism].members
    curves = members.rows_at(np.arange(len(members.weights)), X)
    assert members.weights @ curves / sum(chances) == pytest.approx(people[mechanism](X), rel=1e-12)
    # So have those of the library, of which each has one row here.
    assert np.array_equal(curves, people[mechanism].probabilities(X))


def test_the_simulation_tells_wrong_formulas():
    """Mechanisms added up, chances left out, weights left out: none is close."""
    from scipy.special import ndtr

    walls = [wall for wall in WALLS if wall[2]]
    weight = np.array([wall[2] for wall in walls])[:, None]
    chance = [np.array([row[2] for row in wall[3].values()])[:, None] for wall in walls]
    p = [np.array([ndtr(np.log(X / row[0]) / row[1]) for row in wall[3].values()]) for wall in walls]
    series = np.array([1.0 - np.prod(1.0 - c * one, axis=0) for c, one in zip(chance, p, strict=True)])
    added = np.array([np.minimum(np.sum(c * one, axis=0), 1.0) for c, one in zip(chance, p, strict=True)])
    certain = np.array([1.0 - np.prod(1.0 - one, axis=0) for one in p])
    capacity, _ = simulate(WALLS)
    assert close(np.sum(weight * series, axis=0) / weight.sum(), capacity, X)
    for wrong in (added, certain):
        assert not close(np.sum(weight * wrong, axis=0) / weight.sum(), capacity, X)
    assert not close(series.mean(axis=0), capacity, X)


def test_dispersion_of_one_mechanism(people):
    """The variance of ln capacity in the mixture is that between walls and that between records."""
    for mechanism in KINDS:
        capacity, _ = simulate(WALLS, mechanism)
        ln = np.log(capacity[np.isfinite(capacity)])
        error = np.sqrt(np.mean((ln - ln.mean()) ** 4) - ln.var() ** 2) / np.sqrt(len(ln))
        curve = people[mechanism]
        assert abs(curve.beta_walls**2 + curve.beta_records**2 - ln.var()) < 4.0 * error + 1e-4
        assert curve.beta_total**2 == pytest.approx(curve.beta_walls**2 + curve.beta_records**2)
        assert curve.fitted == 1.0


def test_dispersion_of_all():
    """Walls that collapse by one of two mechanisms alike: theirs are the wall's own theta and beta."""
    walls = [("a", "", 1.0, {"one_sided": (0.3, 0.4, 1.0)}), ("b", "", 3.0, {"two_block": (0.6, 0.2, 1.0)})]
    curve = typology_of(walls)["all"]
    ln = np.log(simulate(walls)[0])
    assert curve.mechanism == "all"
    assert curve.beta_walls**2 + curve.beta_records**2 == pytest.approx(ln.var(), rel=0.01)
    assert curve.beta_walls == pytest.approx(np.log(2.0) * np.sqrt(3.0) / 4.0, rel=1e-4)


def test_saturation(people):
    """The mean curve ends where nothing more can occur; the lognormal is that of the walls that can collapse."""
    for group in ("", "facades", "towers"):
        capacity, _ = simulate([wall for wall in WALLS if group in ("", wall[1])])
        curve = people["all", group]
        finite = np.isfinite(capacity)
        error = np.sqrt(curve.upper_asymptote * (1.0 - curve.upper_asymptote) / len(capacity))
        assert abs(curve.upper_asymptote - finite.mean()) < 4.0 * error
        assert people["all", group](1e3) == pytest.approx(curve.upper_asymptote, rel=1e-6)
        assert curve.fit(1e3) == pytest.approx(curve.upper_asymptote, rel=1e-6)
        assert curve.fit.theta == pytest.approx(np.median(capacity[finite]), rel=0.1)
    assert all(curve.upper_asymptote == 1.0 for curve in people.groups if curve.mechanism != "all")


def test_dispersion_where_no_mechanism_may_occur():
    """Walls that may not collapse at all: theta and beta are those of the others, whatever the levels end with."""
    walls = [("a", "", 1.0, {"one_sided": (0.3, 0.4, 0.5)}), ("b", "", 3.0, {"two_block": (0.6, 0.2, 0.25)})]
    capacity, _ = simulate(walls)
    ln = np.log(capacity[np.isfinite(capacity)])
    wide, narrow = typology_of(walls)["all"], typology_of(walls, LEVELS[LEVELS < 1.0])["all"]
    assert wide.upper_asymptote == pytest.approx(0.3125, rel=1e-12)
    assert wide.beta_walls**2 + wide.beta_records**2 == pytest.approx(ln.var(), rel=0.02)
    assert (wide.fit.theta, wide.fit.beta) == pytest.approx((np.exp(ln.mean()), ln.std()), rel=0.05)
    assert (narrow.fit.theta, narrow.fit.beta) == pytest.approx((wide.fit.theta, wide.fit.beta), rel=0.1)


def test_each_wall(people):
    capacity, drawn = simulate(WALLS)
    walls = people["all"].probabilities(X)
    assert walls.shape == (5, len(X))
    for i, row in enumerate(walls):
        assert close(row, capacity[drawn == i], X)
    assert list(people.combined) == [wall[0] for wall in WALLS]
    assert people.combined["d"] is people.curves[5]
    for name, curve in people.combined.items():
        again = dd.fit_fragility(curve.levels, curve.collapses, curve.histories)
        assert (again.theta, again.beta) == pytest.approx((curve.theta, curve.beta), rel=1e-12), name


def by_sorting(values, weights, share):
    """A weighted fractile by its definition."""
    order = np.argsort(values)
    reached = np.cumsum(weights[order]) >= share * weights.sum() * (1.0 - 1e-12)
    return values[order][np.argmax(reached)]


def test_fractiles_by_sorting():
    rng = np.random.default_rng(3)
    walls = [
        (f"w{i}", "", float(rng.integers(0, 4)), {"one_sided": (rng.uniform(0.2, 0.9), rng.uniform(0.2, 0.5), 1.0)})
        for i in range(101)
    ]
    # Some that are equal
    walls += [(f"again {name}", *rest) for name, *rest in walls[:20]]
    result = typology_of(walls, LEVELS[::3])
    weights = np.array([wall[2] for wall in walls if wall[2]])
    at_levels = result["all"].probabilities(result.levels)
    for k, share in enumerate((0.16, 0.5, 0.84)):
        expected = [by_sorting(column, weights, share) for column in at_levels.T]
        assert result["all"].level_fractiles[k] == pytest.approx(expected, rel=1e-12)
    between = rng.uniform(0.1, 2.0, (2, 7))
    found = result["all"].fractiles(between, q=[0.01, 0.3, 1.0])
    assert found.shape == (3, 2, 7)
    columns = result["all"].probabilities(between).reshape(len(weights), -1).T
    expected = [[by_sorting(column, weights, share) for column in columns] for share in (0.01, 0.3, 1.0)]
    assert np.array_equal(found.reshape(3, -1), expected)
    assert result["all"].fractiles(0.4, q=0.5).shape == ()


def test_curves_at_levels_are_those_of_fortran(people):
    for group in people.groups:
        key = (group.mechanism, group.group)
        assert people[key](LEVELS) == pytest.approx(group.mean_curve, rel=1e-12)
        found = people[key[0], key[1]].fractiles(LEVELS)
        assert found == pytest.approx(group.level_fractiles, rel=1e-12)


def test_which_curves_there_are(people):
    assert [(group.group, group.mechanism) for group in people.groups] == [
        *(("", name) for name in ("one_sided", "two_block", "free_standing", "all")),
        *(("facades", name) for name in ("one_sided", "two_block", "free_standing", "all")),
        *(("towers", name) for name in ("two_block", "all")),
    ]
    assert people["all"].fit is people.groups[3].fit
    assert people["all"].weight == 10.5
    assert people["all", "facades"].n_walls == 3
    assert people["two_block", "towers"].fit is people.groups[8].fit
    with pytest.raises(dd.errors.InputError, match="group = 'ruins': must be one of '', 'facades', 'towers'"):
        people["all", "ruins"]
    with pytest.raises(dd.errors.InputError, match="mechanism = 'one_sided': must be one of 'two_block', 'all'"):
        people["one_sided", "towers"](0.3)
    with pytest.raises(dd.errors.InputError, match="q: must be shares"):
        people["all"].fractiles(0.3, q=0.0)


def test_no_levels(people):
    assert people["all"]([]).shape == (0,)
    assert people["all"].fractiles([]).shape == (3, 0)
    assert people["all"].probabilities([]).shape[1:] == (0,)


def test_walls_without_a_fit():
    """Their fractions take their place, in series too."""
    people = typology_of([("a", "", 1.0, {"one_sided": (0.3, 0.4, 0.5), "two_block": (0.6, 0.3, 1.0)})], histories=44)
    counts = people.exceedances.copy()
    counts[0, :, 0] = np.where(LEVELS < 0.5, 0, 44)
    complete = np.ones(2, dtype=bool)
    arguments = (
        people.population,
        "pga",
        LEVELS,
        np.ones(1),
        counts,
        np.full((len(LEVELS), 2), 44, dtype=np.int32),
        complete,
        Work(),
    )
    stepped = combine(*arguments)
    assert [str(warning) for warning in stepped.warnings] == [
        "1 of 2 mechanisms of walls has no fit and takes part with its fractions of collapse, but not in dispersions "
        "(separated; the first is 'a')",
    ]
    step = np.where(LEVELS < 0.5, 0.0, 1.0)
    expected = 1.0 - (1.0 - 0.5 * step) * (1.0 - stepped.curves[1](LEVELS))
    assert stepped["all"].mean_curve == pytest.approx(expected, rel=1e-12, abs=1e-15)
    assert np.isnan(stepped["one_sided"].beta_walls)
    assert stepped["one_sided"].fitted == 0.0
    assert stepped["all"].fitted == 1.0


def test_a_wall_has_the_fewest_histories_of_its_mechanisms(people):
    histories = np.array(people.histories)
    histories[:, 1] *= 2
    complete = np.ones(histories.shape[1], dtype=bool)
    again = combine(people.population, "pga", LEVELS, np.ones(1), people.exceedances, histories, complete, Work())
    assert list(again.combined["a"].histories) == [HISTORIES] * len(LEVELS)
    assert again["two_block"].fit.histories[0] > people["two_block"].fit.histories[0]


def test_a_wall_counts_when_all_its_mechanisms_are_complete(people):
    complete = np.ones(len(people.walls), dtype=bool)
    complete[1] = complete[-1] = False
    counts, histories = people.exceedances, people.histories
    part = combine(people.population, "pga", LEVELS, np.ones(1), counts, histories, complete, Work())
    assert list(part.combined) == ["b", "c", "d", "e"]
    assert part.curves[0].theta == people.curves[2].theta
    complete[:] = [True, *[False] * (len(complete) - 1)]
    with pytest.raises(dd.errors.Interrupted, match="no wall is complete"):
        combine(people.population, "pga", LEVELS, np.ones(1), counts, histories, complete, Work())


@pytest.fixture(scope="module")
def states(few):
    """A population with three damage states, and the stripes of its walls."""
    walls = [
        dd.OneSidedWall(1.5, 0.25, name="a"),
        dd.TwoBlockWall(2.5, 0.25, name="a"),
        dd.OneSidedWall(2.0, 0.25, name="b"),
    ]
    people = dd.Population(walls, [1.0, 1.0, 2.0], group_names=("x", "x", ""), p_occ=[0.5, 0.5, 1.0])
    levels = np.array([0.2, 0.4, 0.6, 0.9, 1.3])
    stripes = [dd.multiple_stripe(wall, few, levels, progress=False) for wall in walls]
    thresholds = np.array([0.1, 0.4, 1.0])
    counts = np.array([[one.exceedances(edp) for one in stripes] for edp in thresholds]).transpose(0, 2, 1)
    histories = np.array([one.histories for one in stripes]).T
    complete = np.ones(3, dtype=bool)
    return combine(people, "pga", levels, thresholds, counts, histories, complete, Work()), stripes


def test_damage_states(states, tmp_path):
    typology, stripes = states
    last = typology.at(1.0)
    assert np.array_equal(typology.collapses, last.collapses)
    assert last["all"](0.5) == typology["all"](0.5)
    assert list(last.edp_thresholds) == [1.0]
    assert last.at(1.0) is last
    first = typology.at(0.1)
    assert typology.at(0.1) is first
    assert pickle.loads(pickle.dumps(typology)).at(0.1)["all"](0.5) == first["all"](0.5)
    for k, one in enumerate(stripes):
        assert np.array_equal(typology.exceedances[0, :, k], (one.edp >= 0.1).sum(axis=1))
        assert np.array_equal(first.curves[k].collapses, one.fit(0.1).collapses)
    assert np.all(first["all"].mean_fraction >= typology.at(0.4)["all"].mean_fraction)
    assert np.any(typology.at(0.4)["all"].mean_fraction > last["all"].mean_fraction)
    with pytest.raises(dd.errors.InputError, match=r"edp_threshold = 0\.2: must be one of 0\.1, 0\.4, 1"):
        typology.at(0.2)
    # As the executable writes them: curves of the population state by state, tables of walls wall by wall
    for table, blocks, rows in (("typology", 1, 6 * 5), ("stripes", 3, 5), ("fragility", 3, 1)):
        frame = typology.to_frame(table)
        assert list(frame["edp_threshold"]) == [edp for edp in (0.1, 0.4, 1.0) for _ in range(rows)] * blocks
        typology.to_csv(tmp_path / "table.csv", table)
        lines = (tmp_path / "table.csv").read_text().splitlines()
        header = next(line for line in lines if not line.startswith("#"))
        assert header.split(",") == list(frame.columns)
    assert list(typology.to_frame("typology")["mean_curve"][:5]) == list(first.groups[0].mean_curve)
    assert "damage states 0.1 0.4 1" in repr(typology)


def test_damage_states_of_one_wall(states):
    stripes = states[1][0]
    assert np.array_equal(stripes.exceedances(stripes.edp_limit), stripes.collapses)
    assert stripes.fit(stripes.edp_limit).theta == stripes.fit().theta
    curve = stripes.fit(0.4)
    assert curve.theta < stripes.fit().theta
    # What is drawn again are the histories that reach the state.
    samples = curve.bootstrap(n_resamples=200)
    assert np.nanmedian(samples.theta) == pytest.approx(curve.theta, rel=0.1)
    for edp in (0.0, 1.5, np.nan):
        with pytest.raises(dd.errors.InputError, match="must be positive and at most edp_limit = 1"):
            stripes.exceedances(edp)


@pytest.mark.parametrize("edp", [0.1, 0.4])
def test_warnings_name_the_state(states, edp):
    typology = states[0]
    again = combine(
        typology.population,
        "pga",
        typology.levels,
        typology.edp_thresholds,
        typology.exceedances * 0,
        typology.histories,
        np.ones(3, dtype=bool),
        Work(),
    )
    with pytest.warns(dd.errors.DondoloWarning, match=f"damage state {edp:g}: 3 of 3 mechanisms of walls have no fit"):
        again.at(edp)


def test_figures(people, states, monkeypatch):
    ax = people["one_sided", "facades"].plot()
    assert ax.get_title(loc="left") == "one-sided, group facades"
    monkeypatch.setattr(plots, "_THIN", 2)
    labels = people.plot().get_legend_handles_labels()[1]
    assert labels[0] == "2 of 5 walls"
    assert typology_of(WALLS[3:4]).plot().get_legend_handles_labels()[1][0] == "1 wall"
    assert {"16 to 84 % of the walls", "median of the walls", "weighted mean"} <= set(labels)

    ax = people.plot_combination()
    lines = {drawn.get_label().split(":")[0]: drawn for drawn in ax.get_lines()}
    for name, mechanism in (("one-sided where it can occur", "one_sided"), ("all mechanisms", "all")):
        assert np.array_equal(lines[name].get_ydata(), people[mechanism](lines[name].get_xdata()))
    styles = [drawn.get_linestyle() for name, drawn in lines.items() if "occur" in name]
    assert len(set(styles)) == len(styles) == 3

    ax = people.plot_groups(mechanism="two_block")
    labels = ax.get_legend_handles_labels()[1]
    assert [label.split(":")[0] for label in labels] == [
        "facades (3 walls)",
        "towers (1 wall)",
        "population (4 walls)",
        "thick",
    ]
    towers = next(drawn for drawn in ax.get_lines() if drawn.get_label().startswith("towers"))
    assert np.array_equal(towers.get_ydata(), people["two_block", "towers"](towers.get_xdata()))
    labels = people.plot_groups(mechanism="one_sided").get_legend_handles_labels()[1]
    assert [label.split(" (")[0] for label in labels[:-1]] == ["facades", "population"]
    with pytest.raises(dd.errors.InputError, match="group: no wall of this population belongs to a group"):
        typology_of(WALLS[3:4]).plot_groups()

    typology, stripes = states
    for what, edp in ((typology, (0.1, 0.4, 1.0)), (stripes[0], (0.1, 0.4, 1.0))):
        ax = what.plot_damage_states()
        labels = ax.get_legend_handles_labels()[1]
        assert [label.split(":")[0] for label in labels if "EDP" in label] == [f"EDP ≥ {one:g}" for one in edp]
        assert ("thin" in labels[-1]) == (what is typology)
        assert ax.get_ylabel() == "probability to reach the state"
        curves = [what.at(one)["all"] if what is typology else what.fit(one) for one in edp]
        curves = [curve for curve in curves if what is typology or curve.has_fit]
        lines = [drawn for drawn in ax.get_lines() if len(drawn.get_xdata()) > len(what.levels)]
        lines = [drawn for drawn in lines if not drawn.get_label().startswith("_")]
        for drawn, curve in zip(lines, curves, strict=True):
            assert np.array_equal(drawn.get_ydata(), curve(drawn.get_xdata()))


def test_parameters_are_told_of_a_line_that_is_drawn(people, states):
    """The mean is no lognormal: what has the parameters of the legend stands beside it, thin."""
    typology = states[0]
    state = [typology.at(edp) for edp in typology.edp_thresholds]
    drawings = [
        (people.plot_combination(), [people[name] for name in (*KINDS, "all")]),
        (people.plot_groups(), [people["all", name] for name in ("facades", "towers", "")]),
        (typology.plot_damage_states(), [one["all"] for one in state]),
    ]
    for ax, curves in drawings:
        lines = ax.get_lines()
        means = [i for i, drawn in enumerate(lines) if ": θ = " in drawn.get_label()]
        assert len(means) == len(curves)
        for i, curve in zip(means, curves, strict=True):
            label = lines[i].get_label()
            assert f": θ = {curve.fit.theta:.3g} g, β = {curve.fit.beta:.3g}" in label
            beside = lines[i + 1]
            assert np.array_equal(beside.get_ydata(), curve.fit(beside.get_xdata()))
            assert to_rgba(beside.get_color()) == to_rgba(lines[i].get_color())
            assert beside.get_linewidth() < 0.5 * lines[i].get_linewidth()
        assert lines[-1].get_label() == "thick: means; thin: lognormals of these θ and β"
    counts = people.exceedances * 0
    complete = np.ones(len(people.walls), dtype=bool)
    none = combine(people.population, "pga", LEVELS, np.ones(1), counts, people.histories, complete, Work())
    labels = none.plot_groups().get_legend_handles_labels()[1]
    assert labels[-1] == "population (5 walls): no fit (no collapse)"


@pytest.mark.slow
@pytest.mark.parametrize("name", ["cost $x_{$", "_east", "__"])
def test_figures_of_groups_with_any_name(name, tmp_path):
    walls = [(wall[0], name, *wall[2:]) for wall in WALLS[:3]]
    people = typology_of(walls)
    axes = [people.plot_groups(), people.population.plot(by="group"), people.plot_combination(group=name)]
    for ax in axes[:2]:
        (legend,) = (one for panel in ax.figure.axes if (one := panel.get_legend()))
        assert legend.get_texts()[0].get_text().lstrip().startswith(name)
    for ax in axes:
        ax.figure.savefig(tmp_path / "figure.png")


def test_populations_on_the_same_records_are_compared_in_pairs(people):
    # Of counts alone nothing is known about records, and the result says so.
    assert people["one_sided"].fit.compare(people["two_block"].fit).pairing == "naive"
    computed = dd.typology(**study.arguments())
    compared = computed["one_sided"].fit.compare(computed["two_block"].fit)
    assert (compared.pairing, compared.shared) == ("paired", len(study.arguments()["records"]))
