"""Compute docs/city.md and docs/studies/city.md of the illustrative historic centre, and draw their figures.

Run it by ./run city; with --quick it takes every eighth wall, and draws into out/quick. Everything is computed with the
embedded synthetic accelerograms, and also with recorded ones if they are available in the folder DONDOLO_RECORDS.
Checkpoints in out/city store the results; remove the folder to compute everything again.
"""

import os
import sys
import warnings
from dataclasses import replace
from pathlib import Path

import matplotlib

matplotlib.use("agg")

import numpy as np

import dondolo as dd
from dondolo.figures import style
from dondolo.figures.options import Options

root = Path(__file__).resolve().parents[1]
QUICK = "--quick" in sys.argv[1:]
figures = root / ("out/quick" if QUICK else "docs/figures")
out = root / ("out/quick/city" if QUICK else "out/city")
centre = dd.Population.from_csv(root / "data/walls/historic_centre.csv")
if QUICK:
    chosen = list(dict.fromkeys(wall.name for wall in centre))[::8]
    kept = [i for i, wall in enumerate(centre) if wall.name in chosen]
    centre = dd.Population(
        tuple(centre[i] for i in kept),
        centre.weights[kept],
        group_names=[centre.group_names[i] for i in kept],
        p_occ=centre.p_occ[kept],
    )
LEVELS = 0.1 * np.arange(1, 21)  # the levels of data/cases/historic_centre.nml
MECHANISMS = ("one_sided", "two_block")
SAMPLES = 50 if QUICK else 1000


def main() -> None:
    """Compute the numbers and draw the figures."""
    warnings.simplefilter("ignore", dd.errors.DondoloWarning)
    out.mkdir(parents=True, exist_ok=True)
    sets = {"synthetic44": dd.read_catalogue(root / "data/records/synthetic44.csv")}
    folder = Path(os.environ.get("DONDOLO_RECORDS", "none"))
    if (folder / "italy44.csv").is_file():
        sets["recorded"] = dd.read_catalogue(folder / "italy44.csv")
    else:
        print("no recorded accelerograms found (set DONDOLO_RECORDS to their folder): synthetic ones only")
    walls()
    studies = {name: Study(name, records) for name, records in sets.items()}
    for study in studies.values():
        print(f"\n=== {study.name}")
        curves(study)
        states(study)
        sizes(study)
        occurrence(study)
        polarity(study)
        restitution(study)
        intensities(study)
        dependence(study)
        alternatives(study)
        mixture(study)
        enough(study)
        risk(study)
    draw(studies)


class Study:
    """The centre under one set of records.

    Attributes
    ----------
    events : list of int
        Recording of each record; its two components are adjacent.
    collapsed : list of ndarray, each of shape (levels, histories)
        Collapse flags, row by row; a one-sided wall has the histories of all records, then of all records reversed.
    """

    def __init__(self, name, records):
        self.name, self.records = name, records
        self.events = [i // 2 for i in range(len(records))]
        self.typology = self.run("centre", centre, LEVELS, edp_thresholds=[0.1, 0.4], progress=True)
        flags = self.typology.flags
        self.collapsed = [flags.of([row])[0, -1] for row in range(len(centre))]

    def run(self, what, population, levels, progress=False, **options):
        """Compute a typology, or read it from its checkpoint."""
        checkpoint = out / f"{self.name}_{what}.counts"
        options = {"polarity": "both", "checkpoint": checkpoint, "progress": progress, **options}
        return dd.typology(population, self.records, levels, **options)


def rows_of(mechanism):
    """Rows of a mechanism."""
    return [i for i, wall in enumerate(centre) if wall.mechanism == mechanism]


def part(mechanism, **changes):
    """Population of the rows of a mechanism, with changed walls and the mechanism possible in all of them."""
    rows = rows_of(mechanism)
    weights = centre.weights[rows] * centre.p_occ[rows]
    return dd.Population(tuple(replace(centre[i], **changes) for i in rows), weights)


def median(values, weights):
    """Weighted median."""
    order = np.argsort(values)
    return float(values[order][np.searchsorted(np.cumsum(weights[order]), 0.5 * weights.sum())])


def text(fit):
    """Median and dispersion of a fit, or its status."""
    return f"theta {fit.theta:.3f}, beta {fit.beta:.3f}" if fit.has_fit else fit.status


def curves(study):
    """Print medians, dispersions and bootstrap standard errors of each curve."""
    peaks = np.array([record.intensity("pga") for record in study.records])
    factors = LEVELS[-1] / peaks
    velocity = np.median([record.intensity("pgv") for record in study.records] / peaks)
    print(
        f"median PGV/PGA {velocity:.3f} m/s for 1 g; PGA {peaks.min():.3f} to {peaks.max():.3f} g, median"
        f" {np.median(peaks):.3f} g; factors to {LEVELS[-1]:g} g: median {np.median(factors):.1f}, largest"
        f" {factors.max():.1f}"
    )
    for one in study.typology.groups:
        print(
            f"{one.group or 'population'}, {one.mechanism}: {one.n_walls} walls, {text(one.fit)}, beta_walls"
            f" {one.beta_walls:.3f}, beta_records {one.beta_records:.3f}, fitted {one.fitted:.4f}, upper asymptote"
            f" {one.upper_asymptote:.4f}"
        )
    for mechanism in (*MECHANISMS, "all"):
        fit = study.typology[mechanism or "all"].fit
        print(f"standard error of ln theta, {mechanism}: fit {fit.se_ln_theta:.4f}")
        for what, events in (("one by one", range(len(study.records))), ("in pairs of components", study.events)):
            errors = []
            for over in (("records",), ("walls",), ("records", "walls")):
                samples = study.typology[mechanism].bootstrap(n_resamples=SAMPLES, over=over, events=events)
                errors.append(f"{' and '.join(over)} {samples.se_ln_theta:.4f}")
            print(f"   bootstrap, records drawn {what}, over", ", ".join(errors))
    low, high = study.typology["all"].bootstrap(n_resamples=SAMPLES, events=study.events).mean_interval()
    shares = study.typology["all"].level_fractiles
    for level in (0.3, 0.5, 1.0):
        j = int(np.argmin(abs(LEVELS - level)))
        print(
            f"{level} g: mean {study.typology['all'](level):.3f}, 95 % {low[j]:.3f} to {high[j]:.3f};"
            f" fractiles of the walls {shares[0, j]:.3f} {shares[1, j]:.3f} {shares[2, j]:.3f}"
        )


def states(study):
    """Print the curves of the damage states."""
    for edp in study.typology.edp_thresholds:
        state = study.typology.at(edp)
        print(f"EDP >= {edp:g}:", ", ".join(f"{name} {text(state[name].fit)}" for name in (*MECHANISMS, "all")))


def walls():
    """Print medians of the walls, weighted by the probability that a mechanism can occur."""
    print(centre)
    for mechanism in MECHANISMS:
        rows = rows_of(mechanism)
        weights = centre.weights[rows] * centre.p_occ[rows]
        for group in dict.fromkeys([None, *(centre.group_names[i] for i in rows)]):
            here = np.array([group in (None, centre.group_names[i]) for i in rows])
            several = [centre[i] for i, chosen in zip(rows, here, strict=True) if chosen]
            facts = {
                "height m": [wall.height for wall in several],
                "trigger g": [wall.trigger_acceleration / wall.gravity for wall in several],
                "p rad/s": [wall.frequency_parameter for wall in several],
                "restitution e": [abs(wall.restitution_coefficient) for wall in several],
            }
            medians = (f"{name} {median(np.array(values), weights[here]):.4g}" for name, values in facts.items())
            print(f"{mechanism}, {group or 'all groups'}:", ", ".join(medians))


def sizes(study):
    """Print the regression of medians on trigger and frequency parameter: ln theta = c + m ln a0 + n ln p."""
    for mechanism in MECHANISMS:
        rows = [i for i in rows_of(mechanism) if study.typology.curves[i].has_fit]
        theta = np.array([study.typology.curves[i].theta for i in rows])
        trigger = np.array([centre[i].trigger_acceleration / centre[i].gravity for i in rows])
        p = np.array([centre[i].frequency_parameter for i in rows])
        weights = centre.weights[rows] * centre.p_occ[rows]
        root_weight = np.sqrt(weights)[:, None]
        columns = np.column_stack([np.ones(len(rows)), np.log(trigger), np.log(p)])
        coefficient = np.linalg.lstsq(root_weight * columns, root_weight[:, 0] * np.log(theta), rcond=None)[0]
        left = np.log(theta) - columns @ coefficient
        spread = np.sqrt(np.average(left**2, weights=weights))
        print(
            f"{mechanism}: median of theta {median(theta, weights):.3f} g, of a0/p"
            f" {median(9.81 * trigger / p, weights):.3f} m/s, of theta/a0 {median(theta / trigger, weights):.2f};"
            f" ln theta = {coefficient[0]:.2f} + {coefficient[1]:.2f} ln a0 + {coefficient[2]:.2f} ln p,"
            f" residual {spread:.3f} of {study.typology[mechanism].beta_walls:.3f}"
        )


def occurrence(study):
    """Print the influence of the probabilities of occurrence."""
    certain = study.run("centre", replace(centre, p_occ=np.ones(len(centre))), LEVELS, edp_thresholds=[0.1, 0.4])
    for what, typology in (("as assumed", study.typology), ("1 everywhere", certain)):
        means = ", ".join(f"{typology['all'](level):.3f} at {level} g" for level in (0.3, 0.5, 1.0, 2.0))
        frequency = typology["all"].risk(HAZARD).annual_frequency
        print(
            f"p_occ {what}: {text(typology['all'].fit)}, upper asymptote"
            f" {typology['all'].upper_asymptote:.3f}; mean {means};"
            f" {frequency:.3g} per year; the mean is 0.5 at {typology['all'].ppf(0.5):.3f} g"
        )


def polarity(study):
    """Print curves of one-sided walls under records as recorded and reversed."""
    rows = rows_of("one_sided")
    weights = centre.weights[rows] * centre.p_occ[rows]
    both = np.array([study.collapsed[i] for i in rows])
    for name, chosen in (("as recorded", slice(0, 44)), ("reversed", slice(44, 88)), ("both", slice(0, 88))):
        fraction = np.average(both[:, :, chosen].mean(axis=2), axis=0, weights=weights)
        print(f"one_sided, {name}: {text(fitted(fraction, 44))}")
    # Ratio of the two medians of each wall
    medians = [
        [dd.fit_fragility(LEVELS, both[i, :, s].sum(axis=1), 44).theta for s in (slice(0, 44), slice(44, 88))]
        for i in range(len(rows))
    ]
    ratio = np.abs(np.diff(np.log(np.array(medians)), axis=1)[:, 0])
    print(
        f"one wall, ratio of the medians of both polarities: median {np.exp(np.nanmedian(ratio)):.3f}, 95 % of walls"
        f" below {np.exp(np.nanquantile(ratio, 0.95)):.3f}"
    )


def fitted(fraction, histories, upper_asymptote=1.0, top=None):
    """Fit a lognormal to a mean fraction divided by its upper asymptote, at the lowest `top` levels."""
    n = float(histories)
    return dd.fit_fragility(LEVELS[:top], np.clip(fraction[:top] / upper_asymptote * n, 0.0, n), n)


def restitution(study):
    """Print curves for factors of the two-block rows and for numbers e of the one-sided ones."""
    for factor in (0.84, 0.87, 0.90, 1.0):
        population = part("two_block", restitution_factor=factor)
        print(f"two_block, factor {factor}: {text(study.run(f'factor_{factor}', population, LEVELS)['all'].fit)}")
    print(f"one_sided, equation (2): {text(study.typology['one_sided'].fit)}")
    for value in (0.0, 0.3, 0.5, 0.7, 0.9):
        population = part("one_sided", restitution_value=value)
        print(f"one_sided, constant {value}: {text(study.run(f'constant_{value}', population, LEVELS)['all'].fit)}")


def intensities(study):
    """Print the dispersions for each intensity measure; the levels of all measures cover the same range."""
    reach = np.geomspace(0.03, 4.0, 24)
    trigger = np.median([wall.trigger_acceleration / wall.gravity for wall in centre])
    for im in ("pga", "pgv", "hi", "saavg(0.2:2)", "sa(1)", "pga/a0", "p*pgv/a0"):
        if im == "pga/a0":
            unit = 1.0 / trigger
        elif im == "p*pgv/a0":
            p = np.median([wall.frequency_parameter for wall in centre])
            unit = p * np.median([r.intensity("pgv") / r.intensity("pga") for r in study.records]) / (9.81 * trigger)
        else:
            unit = np.median([record.intensity(im) / record.intensity("pga") for record in study.records])
        typology = study.run(f"im_{im.replace('/', '_over_')}", centre, unit * reach, im=im)
        parts = []
        for mechanism in MECHANISMS:
            one = typology[mechanism]
            parts.append(
                f"{mechanism} {text(one.fit)}, beta_walls {one.beta_walls:.3f}, beta_records {one.beta_records:.3f},"
                f" total {one.beta_total:.3f}, fitted {one.fitted:.3f}"
            )
        error = typology["one_sided"].bootstrap(n_resamples=SAMPLES, over="records").se_ln_theta
        print(f"{im}:", "; ".join(parts), f"; se over records, one_sided {error:.3f}")


def dependence(study):
    """Print curves of walls with two mechanisms: independent, under the same record, and never both."""
    for what, p_occ in (("p_occ as assumed", centre.p_occ), ("p_occ = 1", np.ones(len(centre)))):
        independent, same, weights = combined(study, p_occ)
        i, j = np.transpose(pairs())
        series = np.average(1.0 - (1.0 - p_occ[i]) * (1.0 - p_occ[j]), weights=weights)
        ways = {"independent": (independent, series), "same record": (same, series)}
        if what == "p_occ as assumed":
            ways["never both"] = never_both(study, weights)
        for way, (values, upper_asymptote) in ways.items():
            fraction = np.average(values, axis=0, weights=weights)
            fit = fitted(fraction, 44, upper_asymptote)
            means = ", ".join(f"{np.interp(level, LEVELS, fraction):.3f} at {level} g" for level in (0.5, 1.0, 2.0))
            print(
                f"walls with two mechanisms, {what}, {way}: {text(fit)}, upper asymptote"
                f" {upper_asymptote:.3f}; mean fraction"
                f" {means}"
            )
        off = independent - same
        j = int(np.argmax(np.average(off, axis=0, weights=weights)))
        print(
            f"   means differ by at most {np.average(off[:, j], weights=weights):.4f}, at {LEVELS[j]:.1f} g; a wall by"
            f" {off.max():.3f}"
        )
    independent, same, _ = combined(study, centre.p_occ)
    check = np.abs(study.typology["all"].mean_fraction - centre_mean(study, independent)).max()
    fit = fitted(centre_mean(study, same), 44, study.typology["all"].upper_asymptote)
    print(f"population, same record: {text(fit)}; check of the sums {check:.1e}")


def pairs():
    """Rows of the walls with both mechanisms."""
    names = [wall.name for wall in centre]
    return [(i, i + 1) for i in range(len(names) - 1) if names[i] == names[i + 1]]


def combined(study, p_occ):
    """Fractions (walls, levels) of walls with two mechanisms, combined in two ways, and their weights."""
    independent, same = [], []
    for i, j in pairs():
        # A wall that folds does not depend on the polarity
        one, two = study.collapsed[i], np.tile(study.collapsed[j], 2)
        p, q = p_occ[i], p_occ[j]
        independent.append(1.0 - (1.0 - p * one.mean(axis=1)) * (1.0 - q * two.mean(axis=1)))
        same.append((1.0 - (1.0 - p * one) * (1.0 - q * two)).mean(axis=1))
    weights = centre.weights[[i for i, _ in pairs()]]
    return np.array(independent), np.array(same), weights


def never_both(study, weights):
    """Fractions (walls, levels) of the same walls if their mechanisms exclude each other, and the mean upper asymptote.

    The histories are those of the checkpoint, which do not depend on what can occur.
    """
    exclusive = replace(centre, occurrence="exclusive")
    found = study.run("centre", exclusive, LEVELS, edp_thresholds=[0.1, 0.4])
    curves = [found.combined[centre[i].name] for i, _ in pairs()]
    fractions = np.array([curve.upper_asymptote * curve.collapses / curve.histories for curve in curves])
    return fractions, np.average([curve.upper_asymptote for curve in curves], weights=weights)


def alternatives(study):
    """Print the mean curves of thirty houses that overturn or fold."""
    for occurrence in ("independent", "exclusive"):
        houses = dd.Population.from_csv(root / "data/walls/alternatives.csv", occurrence=occurrence)
        curve = study.run("houses", houses, LEVELS)["all"]
        values = ", ".join(f"{curve(x):.3f} at {x:g} g" for x in (0.5, 1.0, 2.0, 5.0))
        print(f"thirty houses, {occurrence}: {values}, upper asymptote {curve.upper_asymptote:.3f}")


def centre_mean(study, of_pairs):
    """Mean over all walls, including those with one mechanism."""
    paired = {row for pair in pairs() for row in pair}
    alone = [i for i in range(len(centre)) if i not in paired]
    rest = np.array([centre.p_occ[i] * study.collapsed[i].mean(axis=1) for i in alone])
    weights = np.append(centre.weights[[i for i, _ in pairs()]], centre.weights[alone])
    return np.average(np.vstack([of_pairs, rest]), axis=0, weights=weights)


def mixture(study):
    """Compare the mean curve with upper asymptote x lognormal, and show its dependence on the highest level."""
    typology = study.typology
    x = np.linspace(0.01, 20.0, 2000)
    for mechanism in (*MECHANISMS, "all"):
        one = typology[mechanism]
        mean = typology[mechanism](x)
        gap = one.fit(x) - mean
        places = [int(np.argmax(gap)), int(np.argmin(gap))]
        gaps = ", ".join(f"{gap[j]:+.3f} at {x[j]:.2f} g" for j in places)
        levels = ", ".join(
            f"{level} g {typology[mechanism](level):.4f} {one.fit(level):.4f}"
            for level in (0.1, 0.2, 0.3, 0.5, 1.0, 2.0, 5.0)
        )
        print(
            f"{mechanism}: upper asymptote {one.upper_asymptote:.3f}; curve - mean at most {gaps};"
            f" mean and curve: {levels}"
        )
    for edp in typology.edp_thresholds:
        state = typology.at(edp)
        gap = state["all"].fit(x) - state["all"](x)
        print(f"EDP >= {edp:g}, all: curve - mean {gap.min():+.3f} to {gap.max():+.3f}")
    for mechanism in ("one_sided", "all"):
        one = typology[mechanism]
        for top in (6, 10, 15, 20):
            fit, raw = (fitted(one.mean_fraction, 44, share, top) for share in (one.upper_asymptote, 1.0))
            print(
                f"{mechanism}, levels up to {LEVELS[top - 1]:.1f} g: {text(fit)}; not divided by the upper asymptote:"
                f" {text(raw)}"
            )


def enough(study):
    """Print the standard error of ln theta for numbers of recordings and walls, drawn with replacement."""
    generator = np.random.default_rng(0)
    names = list(dict.fromkeys(wall.name for wall in centre))
    owner = np.array([names.index(wall.name) for wall in centre])
    weight = np.zeros(len(names))
    weight[owner] = centre.weights
    never = np.ones(len(names))
    np.multiply.at(never, owner, 1.0 - centre.p_occ)
    by_record = np.array([flags.reshape(len(LEVELS), -1, 44).mean(axis=1) for flags in study.collapsed])

    def theta(records, times):
        survival = np.ones((len(names), len(LEVELS)))
        np.multiply.at(survival, owner, 1.0 - centre.p_occ[:, None] * by_record[:, :, records].mean(axis=2))
        weights = times * weight
        upper_asymptote = np.average(1.0 - never, weights=weights)
        return fitted(np.average(1.0 - survival, axis=0, weights=weights), 44, upper_asymptote).theta

    def error(records, walls):
        medians = []
        for _ in range(SAMPLES // 2):
            # The two components of a recording are adjacent
            drawn = (2 * generator.integers(22, size=records // 2)[:, None] + np.arange(2)).ravel()
            times = np.ones(len(names))
            if walls:
                times = np.bincount(generator.integers(len(names), size=walls), minlength=len(names))
            medians.append(theta(drawn, times))
        return np.std(np.log(medians), ddof=1)

    for walls in (30, 120, 240, 0):
        errors = (f"{records // 2} recordings {error(records, walls):.3f}" for records in (12, 22, 44))
        print(f"standard error of ln theta, {walls or 'the same'} walls:", ", ".join(errors))
    quarters = (f"{theta(np.arange(first, 44, 4), 1.0):.3f}" for first in range(4))
    print("median under every fourth record:", ", ".join(quarters))


# Illustrative, does not represent a real site
HAZARD = dd.HazardCurve.power_law(2e-5, 2.5)


def risk(study):
    """Print frequencies of collapse under the hazard of a fictitious site."""
    for edp in study.typology.edp_thresholds:
        state = study.typology.at(edp)
        for mechanism in (*MECHANISMS, "all"):
            curve = state[mechanism]
            mean, fit = (one.risk(HAZARD).annual_frequency for one in (curve, curve.fit))
            print(f"EDP >= {edp:g}, {mechanism}: mean curve {mean:.4g} per year, upper asymptote x lognormal {fit:.4g}")
    alone = replace(study.typology["all"].fit, upper_asymptote=1.0).risk(HAZARD).annual_frequency
    print(f"   the lognormal of all without the upper asymptote: {alone:.4g}")
    one = study.typology["all"].risk(HAZARD)
    for low, high in ((0.01, 0.2), (0.2, 0.5), (0.5, 1.0), (0.2, 1.0), (1.0, 2.0), (2.0, 10.0)):
        print(f"   from {low} to {high} g: {one.deaggregate([low, high])[0] / one.annual_frequency:.3f}")
    for years in (50.0, 475.0, 2475.0):
        alike = -np.expm1(-years * one.annual_frequency)
        print(f"   lost in {years:g} years: {one.probability(years):.4g}; if all walls were identical {alike:.4g}")


def draw(studies):
    """Draw the figures for the synthetic records, with the recorded ones for comparison if available."""
    typology = studies["synthetic44"].typology
    axes = style.new_axes(size=(10.4, 4.2), columns=2)
    for ax, mechanism in zip(axes, MECHANISMS, strict=True):
        typology[mechanism].plot(ax)
    axes[0].figure.savefig(figures / "city_mechanisms.png", dpi=100)

    axes = style.new_axes(size=(10.4, 4.2), columns=2)
    typology.plot_combination(axes[0])
    typology.plot_damage_states(axes[1])
    axes[0].figure.savefig(figures / "city_combined.png", dpi=100)

    axes = style.new_axes(size=(10.4, 3.4), columns=3)
    draw_sets(axes[0], studies)
    draw_sizes(axes[1], typology)
    draw_mixture(axes[2], typology)
    for ax in axes:
        style.legend(ax, Options({}))
    axes[0].figure.savefig(figures / "city_discussion.png", dpi=100)


def draw_sets(ax, studies):
    """Draw mean curves of both mechanisms under each set of records."""
    x = np.linspace(0.0, 2.0, 101)
    for mechanism in MECHANISMS:
        color = style.mechanism_look(mechanism)["color"]
        for (name, study), line in zip(studies.items(), ("-", "--"), strict=False):
            label = f"{mechanism.replace('_', '-')}, {name}"
            ax.plot(x, study.typology[mechanism](x), color=color, linestyle=line, label=label)
    ax.set_xlabel(style.im_label("pga"))
    ax.set_ylabel("probability of collapse")


def draw_sizes(ax, typology):
    """Draw medians of the walls against the ratio of trigger acceleration and frequency parameter."""
    for mechanism, marker in zip(MECHANISMS, ("o", "^"), strict=True):
        color = style.mechanism_look(mechanism)["color"]
        rows = rows_of(mechanism)
        velocity = [centre[i].trigger_acceleration / centre[i].frequency_parameter for i in rows]
        theta = [typology.curves[i].theta for i in rows]
        label = mechanism.replace("_", "-")
        ax.plot(velocity, theta, color=color, marker=marker, markersize=3, alpha=0.5, linestyle="none", label=label)
    ax.set_xscale("log")
    ax.set_yscale("log")
    ax.set_xticks([0.2, 0.4, 0.6, 1.0, 1.5], ["0.2", "0.4", "0.6", "1", "1.5"])
    ax.set_yticks([0.3, 0.5, 1.0, 2.0, 3.0], ["0.3", "0.5", "1", "2", "3"])
    ax.minorticks_off()
    ax.set_xlabel("trigger / frequency parameter, $a_0/p$ [m/s]")
    ax.set_ylabel("median of a wall, θ [g]")


def draw_mixture(ax, typology):
    """Draw the mean curve of all mechanisms, upper asymptote x lognormal, and a lognormal fitted without it."""
    x = np.linspace(0.0, 4.0, 201)
    ax.plot(x, typology["all"](x), color=style.RED, linewidth=2.4, label="weighted mean of the walls")
    whole = typology["all"]
    label = f"lognormal times upper asymptote {whole.upper_asymptote:.2f}"
    ax.plot(x, whole.fit(x), color=style.BLACK, linewidth=0.9, linestyle=(0, (4, 4)), label=label)
    raw = fitted(typology["all"].mean_fraction, 44)
    ax.plot(x, raw(x), color=style.BLACK, linestyle=":", label="lognormal fitted without upper asymptote")
    ax.set_ylim(0.0, 1.02)
    ax.set_xlabel(style.im_label("pga"))
    ax.set_ylabel("probability of collapse")


if __name__ == "__main__":
    main()
