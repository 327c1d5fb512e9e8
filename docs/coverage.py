"""Do the intervals of fragility curves contain the truth as often as they say? Writes docs/uncertainty.md.

With --quick only a few draws are made, and the page is out/quick/uncertainty.md.

A population of synthetic records of many scenarios stands for the earthquakes that there could be. The curve of all of
them is the truth; curves of a few records, drawn with replacement, are what a study gets. Histories are run once.
"""

from __future__ import annotations

import os
import sys
from collections.abc import Callable, Iterable, Iterator
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from dondolo.curves.fitting import fit
from dondolo.curves.fragility import Fragility
from dondolo.curves.sample import Sample, cluster_labels
from scipy.special import ndtr, ndtri, stdtrit

import dondolo as dd

QUICK = "--quick" in sys.argv[1:]
FOLDER = Path(__file__).parent
PAGE = (FOLDER.parent / "out/quick" if QUICK else FOLDER) / "uncertainty.md"
RECORDS, SEED = 60 if QUICK else 600, 11
# Studies by their number of records: with 44, shares to a third of a per cent
DRAWS = dict.fromkeys((44, 22, 11), 10) if QUICK else {44: 4000, 22: 1000, 11: 1000}
# Of the frequencies, and of the studentized bootstrap
FREQUENCIES, RESAMPLES = (5, 50) if QUICK else (1000, 2000)
SIZES, LEVELS = tuple(DRAWS), (8,) if QUICK else (8, 12, 20)
# Hazard curves: a power law, and one that bends down
HAZARDS = {
    "power law": dd.HazardCurve.power_law(1e-4, 2.5),
    "bent": dd.HazardCurve(
        [0.01, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0], [0.5, 0.05, 0.015, 4e-3, 5e-4, 8e-5, 1e-5, 2e-7]
    ),
}
WALLS = {"one_sided": dd.OneSidedWall(1.5, 0.25), "two_block": dd.TwoBlockWall(3.0, 0.25)}
CONFIDENCE = 0.95
# Of the comparison of chosen levels with equally spaced ones
STRIPES = (4,) if QUICK else (4, 6, 8, 12)
CHOSEN_WALLS = {
    "one_sided": dd.OneSidedWall(1.5, 0.25),
    "free_standing": dd.FreeStandingWall(2.0, 0.4),
    "two_block": dd.TwoBlockWall(3.0, 0.25),
}

Flags = np.ndarray[Any, np.dtype[np.bool_]]


class Outcomes(NamedTuple):
    """Which histories of a population of records collapse (levels, polarities, records)."""

    levels: np.ndarray[Any, np.dtype[np.float64]]
    collapsed: Flags

    def curve(self, records: np.ndarray[Any, Any], polarity: np.ndarray[Any, Any] | slice = slice(None)) -> Fragility:
        """Curve of some records, as Stripes.fit makes it; with a polarity of each, or all polarities."""
        several = isinstance(polarity, slice)
        drawn = (
            self.collapsed[:, polarity, :][:, :, records] if several else self.collapsed[:, polarity, records][:, None]
        )
        flags = drawn.reshape(len(self.levels), -1)
        # Each draw is a record of its own, even of the same record twice.
        labels = cluster_labels(len(records))
        index = np.tile(np.arange(len(records)), drawn.shape[1])
        sample = Sample(
            levels=self.levels,
            collapsed=flags,
            ran=np.ones_like(flags),
            record_index=index,
            record_names=labels,
            clusters=labels,
        )
        counts = flags.sum(axis=1).astype(float)
        return fit(self.levels, counts, np.full(len(self.levels), float(flags.shape[1])), sample=sample)


def population(count: int, seed: int) -> list[dd.Record]:
    """Synthetic records, each of a scenario of its own."""
    rng = np.random.default_rng(seed)
    records = []
    for i in range(count):
        scenario = rng.uniform(5.2, 6.9), rng.uniform(4.0, 40.0), str(rng.choice(["rock", "shallow", "deep"]))
        deviations = float(np.clip(rng.normal(), -2.0, 2.0))
        records += dd.synthetic_records(*scenario, n_records=1, seed=1000 + i, deviations=deviations)
    return records


def outcomes(wall: dd.Wall, records: list[dd.Record], number: int) -> Outcomes:
    """Histories of all records at some levels, from 5 to 95 % of collapses."""
    pilot = dd.multiple_stripe(wall, records, np.linspace(0.2, 2.5, 12), polarity="both", progress=False).fit()
    levels = pilot.theta * np.exp(pilot.beta * np.linspace(-1.645, 1.645, number))
    stripes = dd.multiple_stripe(wall, records, levels, polarity="both", progress=False)
    return Outcomes(levels, stripes.collapsed.reshape(number, -1, len(records)))


def draws(count: int, size: int, n: int, rng: np.random.Generator) -> Iterator[np.ndarray[Any, Any]]:
    """Records of each of n studies."""
    return iter(rng.integers(count, size=(n, size)))


def intervals(curve: Fragility) -> dict[str, dict[str, tuple[float, float]]]:
    """Intervals of a curve by its own covariance and by others."""
    size = curve.clusters
    upper = 0.5 + 0.5 * CONFIDENCE
    normal, student = float(ndtri(upper)), float(stdtrit(size - 1, upper))
    # Where all clusters have the same histories, corrections are factors.
    share = (size - 1) / size
    others = {
        "naive": (curve.naive_covariance, normal),
        "CR0, normal": (curve.covariance * share**2, normal),
        "CR1 = CR2, t": (curve.covariance * share, student),
    }
    found = {}
    for name, (covariance, quantile) in others.items():
        errors = quantile * np.sqrt(np.diag(covariance)) / [1.0, curve.beta]
        middle = (("theta", curve.theta), ("beta", curve.beta))
        found[name] = {
            what: (value * np.exp(-error), value * np.exp(error))
            for (what, value), error in zip(middle, errors, strict=True)
        }
    return found | {"CR3, t (dondolo)": curve.parameter_interval()}


def coverage(of: Outcomes, polarity: slice, size: int, n: int, seed: int) -> tuple[dict[str, dict[str, float]], float]:
    """Share of the intervals that contain the population's parameters; and of the draws without standard errors."""
    rng, count = np.random.default_rng(seed), of.collapsed.shape[2]
    truth = of.curve(np.arange(count), polarity)
    inside: dict[str, dict[str, list[bool]]] = {}
    without = 0
    for records in draws(count, size, n, rng):
        curve = of.curve(records, polarity)
        if not curve.has_fit or curve.errors != "clustered":
            without += 1
            continue
        for method, ends in intervals(curve).items():
            for what, (low, high) in ends.items():
                inside.setdefault(method, {}).setdefault(what, []).append(low <= getattr(truth, what) <= high)
    shares = {method: {what: float(np.mean(hits)) for what, hits in one.items()} for method, one in inside.items()}
    return shares, without / n


def rejections(
    pair: Callable[[np.random.Generator], tuple[Fragility, Fragility]], n: int, seed: int
) -> dict[str, float]:
    """Share of the tests of equality that reject, of pairs of curves whose populations are equal."""
    rng = np.random.default_rng(seed)
    level = 1.0 - CONFIDENCE
    found = []
    for _ in range(n):
        one, other = pair(rng)
        if not all(curve.has_fit and curve.errors == "clustered" for curve in (one, other)):
            continue
        clustered = one.compare(other)
        naive = np.log(one.theta / other.theta) / np.sqrt(one.naive_covariance[0, 0] + other.naive_covariance[0, 0])
        p_values = (clustered.p_value, clustered.beta_p_value, clustered.curves_p_value)
        found.append([*(p < level for p in p_values), 2.0 * ndtr(-abs(naive)) < level])
    return dict(zip(("theta", "beta", "both", "naive theta"), np.mean(found, axis=0).tolist(), strict=True))


def same_records(of: Outcomes, size: int) -> Callable[[np.random.Generator], tuple[Fragility, Fragility]]:
    """Curves of the same records: one with a polarity of each at random, the other with the other polarity."""

    def pair(rng: np.random.Generator) -> tuple[Fragility, Fragility]:
        records, turned = rng.integers(of.collapsed.shape[2], size=size), rng.integers(2, size=size)
        return of.curve(records, turned), of.curve(records, 1 - turned)

    return pair


def other_records(of: Outcomes, size: int) -> Callable[[np.random.Generator], tuple[Fragility, Fragility]]:
    """Curves of one wall on two draws of records."""

    def pair(rng: np.random.Generator) -> tuple[Fragility, Fragility]:
        one, other = (of.curve(rng.integers(of.collapsed.shape[2], size=size)) for _ in range(2))
        labels = cluster_labels(2 * size)[size:]
        assert other.sample is not None
        sample = Sample(**(vars(other.sample) | {"clusters": labels}))
        return one, fit(other.levels, other.collapses, other.histories, sample=sample)

    return pair


def frequencies(of: Outcomes, polarity: slice, size: int, n: int, seed: int) -> dict[str, float]:
    """Share of the intervals that contain the annual frequency of the population, by hazard."""
    rng, count = np.random.default_rng(seed), of.collapsed.shape[2]
    whole = of.curve(np.arange(count), polarity)
    truth = {name: whole.risk(hazard).annual_frequency for name, hazard in HAZARDS.items()}
    inside: dict[str, list[bool]] = {name: [] for name in HAZARDS}
    for records in draws(count, size, n, rng):
        curve = of.curve(records, polarity)
        if not curve.has_fit or curve.errors != "clustered":
            continue
        for name, hazard in HAZARDS.items():
            low, high = curve.risk(hazard).uncertainty(n_draws=2000, seed=rng).interval()
            inside[name].append(low <= truth[name] <= high)
    return {name: float(np.mean(hits)) for name, hits in inside.items()}


def recorded() -> list[str]:
    """Intervals on recorded accelerograms against the bootstrap over events, where the records are at hand."""
    folder = os.environ.get("DONDOLO_RECORDS")
    if not folder:
        return []
    records = dd.read_catalogue(Path(folder) / "italy44.csv")
    levels = np.linspace(0.05, 1.0, 20)
    rows = []
    for wall in (dd.OneSidedWall(3.0, 0.25), dd.TwoBlockWall(3.0, 0.25, hinge=0.6, restitution_factor=0.87)):
        stripes = dd.multiple_stripe(wall, records, levels, progress=False)
        for what, events in (("recordings", [i // 2 for i in range(44)]), ("earthquakes", stripes.events)):
            rows += recorded_rows(wall.mechanism, what, stripes.fit(events=events))
    head = ["wall", "clusters", "by", "θ, g", "β", "width in ln θ", "clustered / this"]
    return ["## On recorded accelerograms\n", RECORDED, table(head, rows)]


def recorded_rows(mechanism: str, what: str, curve: Fragility) -> list[list[str]]:
    """Rows of the clustered interval, and of the bootstrap's with and without its own standard errors."""
    ends = {
        "clustered": curve.parameter_interval(),
        "bootstrap, studentized": studentized(curve, RESAMPLES, SEED),
        "bootstrap, percentiles": curve.bootstrap(n_resamples=10_000).parameter_interval(),
    }
    widths = [float(np.log(one["theta"][1] / one["theta"][0])) for one in ends.values()]
    rows = []
    for (name, one), width in zip(ends.items(), widths, strict=True):
        cells = [f"{one[letter][0]:.4f} to {one[letter][1]:.4f}" for letter in ("theta", "beta")]
        rows.append([mechanism, f"{curve.clusters} {what}", name, *cells, f"{width:.3f}", f"{widths[0] / width:.3f}"])
    return rows


def studentized(curve: Fragility, n: int, seed: int) -> dict[str, tuple[float, float]]:
    """Intervals by the bootstrap of each change over its own standard error (bootstrap-t), clusters drawn."""
    sample, rng = curve.sample, np.random.default_rng(seed)
    assert sample is not None
    cluster = np.unique(sample.clusters, return_inverse=True)[1][sample.record_index]
    histories = [np.flatnonzero(cluster == g) for g in range(curve.clusters)]
    ratios = []
    for drawn in rng.integers(curve.clusters, size=(n, curve.clusters)):
        columns = np.concatenate([histories[g] for g in drawn])
        # Each draw is a cluster of its own, even of the same cluster twice.
        labels = tuple(f"draw {i}" for i, g in enumerate(drawn) for _ in histories[g])
        collapsed, ran = sample.collapsed[:, columns], sample.ran[:, columns]
        again = Sample(
            levels=sample.levels,
            collapsed=collapsed,
            ran=ran,
            record_index=np.arange(len(columns)),
            record_names=labels,
            clusters=labels,
        )
        counts = ((collapsed & ran).sum(axis=1).astype(float), ran.sum(axis=1).astype(float))
        other = fit(sample.levels, *counts, sample=again)
        if other.has_fit and other.errors == "clustered":
            ratios.append(
                (
                    np.log(other.theta / curve.theta) / other.se_ln_theta,
                    (1.0 / other.beta - 1.0 / curve.beta) / (other.se_beta / other.beta**2),
                )
            )
    (above, below), (steeper, flatter) = np.quantile(ratios, [0.5 + 0.5 * CONFIDENCE, 0.5 - 0.5 * CONFIDENCE], axis=0).T
    slopes = 1.0 / curve.beta - np.array([flatter, steeper]) * curve.se_beta / curve.beta**2
    low, high = curve.theta * np.exp(-np.array([above, below]) * curve.se_ln_theta)
    return {"theta": (float(low), float(high)), "beta": (float(1.0 / slopes[0]), float(1.0 / slopes[1]))}


def chosen() -> list[str]:
    """Widths of intervals with chosen levels and with equally spaced ones, on the embedded records."""
    records = dd.read_catalogue(Path(__file__).parents[1] / "data/records/synthetic44.csv")
    rows, every = [], []
    for name, wall in CHOSEN_WALLS.items():
        dense = dd.multiple_stripe(wall, records, np.geomspace(0.1, 4.0, 50), progress=False).fit()
        for number in STRIPES:
            known = np.linspace(2.0 * dense.theta / number, 2.0 * dense.theta, number)
            best = dense.theta * np.exp(dense.beta * np.linspace(-1.645, 1.645, number))
            curves = [dd.adaptive_stripes(wall, records, budget=44 * number, progress=False).fit()]
            curves += [dd.multiple_stripe(wall, records, levels, progress=False).fit() for levels in (known, best)]
            found = [widths(curve) for curve in (*curves, dense)]
            every.append((number, found))
            rows.append([name, str(number), *map(in_words, found)])
    for number in STRIPES:
        means = np.mean([found for own, found in every if own == number], axis=0)
        rows.append(["mean", str(number), *map(in_words, means)])
    head = ["wall", "stripes", "chosen", "equally spaced to 2 θ", "equally spaced in ln", "50 stripes"]
    return ["## Levels that tell most\n", CHOSEN, table(head, rows)]


def widths(curve: Fragility) -> list[float]:
    """Widths of the intervals of theta and beta, in logarithms."""
    ends = curve.parameter_interval()
    return [float(np.log(high / low)) for low, high in (ends["theta"], ends["beta"])]


def in_words(values: Iterable[float]) -> str:
    """Two widths."""
    return " / ".join(f"{value:.2f}" for value in values)


def table(head: list[str], rows: list[list[str]]) -> str:
    """A table in Markdown."""
    lines = [head, ["---"] * len(head), *rows]
    return "\n".join(f"| {' | '.join(line)} |" for line in lines) + "\n"


def main() -> None:
    """Run the experiment and write the page."""
    records = population(RECORDS, seed=7)
    rows: list[list[str]] = []
    tests: list[list[str]] = []
    risks: list[list[str]] = []
    methods: list[str] = []
    for name, wall in WALLS.items():
        for number in LEVELS:
            of = outcomes(wall, records, number)
            both = of.collapsed.shape[1] == 2
            polarities = {"as_recorded": slice(0, 1), **({"both": slice(None)} if both else {})}
            for size in SIZES:
                for polarity, part in polarities.items():
                    shares, without = coverage(of, part, size, DRAWS[size], SEED + len(rows))
                    methods = list(shares)
                    cells = [f"{100 * one['theta']:.1f} / {100 * one['beta']:.1f}" for one in shares.values()]
                    rows.append([name, polarity, str(number), str(size), *cells, f"{100 * without:.1f}"])
                    print(" | ".join(rows[-1]), flush=True)
                    if number == LEVELS[0]:
                        contained = frequencies(of, part, size, FREQUENCIES, SEED + len(risks)).values()
                        risks.append([name, polarity, str(number), str(size), *(f"{100 * x:.1f}" for x in contained)])
                        print(" | ".join(risks[-1]), flush=True)
                pairs = {
                    "other records": other_records(of, size),
                    **({"same records": same_records(of, size)} if both else {}),
                }
                for pairing, pair in pairs.items():
                    found = rejections(pair, DRAWS[size], SEED + len(tests))
                    cells = [f"{100 * value:.1f}" for value in found.values()]
                    tests.append([name, pairing, str(number), str(size), *cells])
                    print(" | ".join(tests[-1]), flush=True)
    write_page(rows, tests, risks, methods)


def write_page(rows: list[list[str]], tests: list[list[str]], risks: list[list[str]], methods: list[str]) -> None:
    """Write the page with the rows of the tables."""
    head = ["wall", "polarity", "levels", "records"]
    parts = [
        TEXT,
        f"## Coverage\n\n{RECORDS} records, {DRAWS[44]} draws of 44 and {DRAWS[22]} of fewer in each row. Share of the"
        " 95 % intervals of θ / β that contain the value of the population, in %; the standard error of a share is 0.35"
        " and 0.7. The last column is the share of the draws without a fit or without standard errors, which take no"
        " part.\n",
        table([*head, *methods, "without"], sorted(rows, key=lambda row: -int(row[3]))),
        "## Tests of equality\n\nShare of the comparisons (`Curve.compare`) that reject equal curves at 5 %,"
        " in %, in as many draws. On the same records one curve takes a random polarity of each record, and the other"
        " the other.\n",
        table(
            ["wall", "curves on", *head[2:], "θ", "β", "both", "θ, naive"], sorted(tests, key=lambda row: -int(row[3]))
        ),
        f"## Annual frequencies\n\n{FREQUENCIES} draws in each row. Share of the 95 % intervals of"
        " `risk.uncertainty()` that contain the annual frequency of the population, in %, under a hazard curve that"
        " is a power law, x^-2.5, and under one that bends down; the standard error of a share is 0.7.\n",
        table([*head, *HAZARDS], sorted(risks, key=lambda row: -int(row[3]))),
        *recorded(),
        *chosen(),
    ]
    PAGE.parent.mkdir(parents=True, exist_ok=True)
    PAGE.write_text("\n".join(parts), encoding="utf-8")


RECORDED = """44 horizontal components recorded in Italy, 20 levels from 0.05 to 1.00 g, clustered by recording (both
components together) and by earthquake; the bootstrap draws the same clusters. Studentized, each draw is measured by
its own clustered standard error (bootstrap-t, Efron 1981), which takes in that a few clusters tell little of their own
scatter, as Student's t does. Percentiles do not: their intervals are too narrow where there are few clusters.
"""

CHOSEN = """The 44 embedded records, as recorded. Widths of the 95 % intervals in ln θ / in ln β, with levels chosen
one after the other; with as many equally spaced up to 2 θ, and from the 5 to the 95 % fractile of the
curve, places which nobody knows beforehand; and with 50 levels from 0.1 to 4 g. With one draw of
records, differences of a tenth are chance. The records limit what can be learnt: fifty stripes tell
little more than twelve.
"""

TEXT = """# What an interval means

`./run intervals` writes this page.

A fragility curve is fitted to a few dozen records, which stand for the earthquakes that there could be. With other
records the curve would be another one. A 95 % interval is made so that, over many studies with records drawn in the
same way, 95 of 100 intervals contain the curve of all records. It covers the choice of the records and the scatter of
their outcomes. It does not cover the choice of the intensity measure, scaled records that differ from strong ones,
the mechanical model, or a curve that is not lognormal: what is estimated is the lognormal closest to the fractions at
the chosen levels.

**Why not the Fisher information.** The same records are run at every level, in both polarities and with both
components. A record that brings the wall down at 0.6 g mostly does so at 0.7 g. The Fisher information counts each
history as new evidence; more levels then seem to be more evidence, and intervals get ever narrower. It remains
available as `naive_covariance`, and in the columns `naive_se_*` of `*_fragility.csv`.

**Clusters.** Histories of one cluster may depend on each other in any way; clusters are independent. A cluster is the
record with its polarities and levels; records with the same `event` (a column of the catalogue, or the header of the
file) are one cluster. Without a name, equal origin time and epicentre are one event. Without these, components with
the same station and date are one cluster, and without these a record that is given more than once. Records whose event
is not known count as independent, though those of one earthquake are not, and the run warns of them: state which
belong together in a column `event`, or by `Stripes.fit(events=...)`, which sets other labels.

**Estimator.** With s_g the score of cluster g and I_g its part of the information I of the probit regression, the
covariance is I⁻¹ (Σ r_g r_gᵀ) I⁻¹ with r_g = I (I - I_g)⁻¹ s_g (Liang and Zeger 1986; correction of Mancl and DeRouen
2001, known as CR3): (I - I_g)⁻¹ s_g is the change of the parameters if the cluster is left out, to first order.
Intervals are symmetric in ln θ and in 1/β, the slope of the regression, with the quantile of Student's t for one
degree of freedom less than there are clusters. If all clusters have the same histories, CR1 and CR2 agree, and
corrections are powers of g/(g - 1). The table below decided: CR0 with the normal quantile falls short for β with 22
records or fewer, and intervals symmetric in ln β fall short with 11.

**What was tried besides.** Intervals symmetric in another power of β, in 4000 draws of 44 records (1000 of 11), and
the nine rows of the table for each number of records. Symmetric in ln β they miss the truth three to five times as
often on one side as on the other. In 1/β, as here, they covered 94.6 to 95.2 % with 44 records, and the truth was
above 3.0 to 3.5 % and below 1.7 to 2.1 % of them. In 1/β² both sides are equal, and coverage was 94.7 to 95.3 % with
44 records, and 93.7 to 96.2 instead of 92.6 to 93.8 % with 11; but then 5 to 35 % of the intervals have no upper bound.
Degrees of freedom after Bell and McCaffrey (2002) follow from the design alone: g - 1 where all clusters have the same
histories, as here. Degrees of freedom from the kurtosis of the changes r_g, about 2 g/(k - 1), made intervals of β 2 to
7 % wider and gained up to one per cent of coverage.

**None at all.** With fewer than three clusters, or if one alone determines the curve, `errors` gives the reason and
there are no standard errors. A population of two walls has none either: two are too few to tell how much walls differ.
One wall is a wall like any other, of which the records alone are a sample.

**Populations.** All walls share the records, and the walls are a sample too. The covariance of a typological curve is
the sum of that by clusters of records and that by walls, with degrees of freedom after Satterthwaite; what belongs to
one record and one wall alone is counted in both, which errs on the wide side. Fractions of walls of several mechanisms
are linearised. The covariances of 10 000 curves took 1.2 s, 1 % of the time of their 8.8 million histories.

**Comparisons.** `Curve.compare` takes in what two curves share: clusters with the same label, records with the same
content. It states `pairing` and the number of clusters shared. On the same records the variance of the difference
counts, which is often much less than the sum of the variances. Between independent curves, the degrees of freedom are
those of Welch and Satterthwaite.

**Annual frequencies.** `risk.uncertainty()` draws ln θ and 1/β from the distribution that the intervals rest on,
Student's t with the clustered covariance, and integrates each draw over the hazard; of populations the frequency is
linearised in the records and walls. The hazard's own uncertainty is that of its fractiles, for each of which there is
an interval of its own.

**Damage states with one dispersion** (`states = 'ordinal'`). The covariance is that of all θ and β together, from the
scores and the information of the cumulative probit model, with the same correction.

**Levels that tell most.** `adaptive_stripes(wall, records, budget)` spends a budget of histories stripe by
stripe. A record counts as one capacity, lognormal as the curve so far; stripes tell between which of their levels it
lies. The next level maximises the determinant of the Fisher information on (ln θ, ln β) of such grouped data, which is
the same for any other pair of parameters of the curve (D-optimal design); a level that was run already adds nothing.
Nothing else depends on this model. Only the package has it: the executable takes its levels from the case, which is
read and checked before anything runs.

**Other intervals of the package.** Curves of first collapses (`incremental`) and dispersions of `compare_intensities`
are clustered in the same way; the ratios of dispersions come from a bootstrap of clusters. Curves fitted to counts
alone (`fit_fragility`) know no records and are naive. The regressions of a cloud analysis take its histories for
independent: each record is used once, but its two components, and both polarities if asked for, are not independent.
"""


if __name__ == "__main__":
    main()
