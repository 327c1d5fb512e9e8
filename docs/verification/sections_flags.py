"""Reliability of collapse flags and fragility curves, and of the estimated error."""

import figures
import numpy as np
from markdown import many, paragraph, power, small, table
from sections_accuracy import LARGE
from study import DEFAULT, TIGHTEST, TOLERANCES

ORDINARY = [rtol for rtol in TOLERANCES if rtol >= 1e-10]
NEAREST = 10


def naive_errors(fit):
    """Standard errors of ln theta and beta as if all histories were independent, the smallest that there are."""
    return np.sqrt(np.diag(fit.naive_covariance))


def shifts(fit, exact):
    """Difference of a curve from the exact one, in naive standard errors of ln theta and of beta."""
    return np.array([np.log(fit.theta / exact.theta), fit.beta - exact.beta]) / naive_errors(exact)


def signed(x):
    """Format a shift in standard errors; no shift is 0."""
    return "0" if x == 0.0 else f"{x:+.3f}"


def largest_shift(study, tolerances):
    """Largest shift of ln theta or beta, in standard errors, and where."""
    found = (0.0, None)
    for wall, name in study.pairs():
        exact = study.exact[wall, name].fit()
        for rtol in tolerances:
            shift = max(abs(s) for s in shifts(study.runs[wall, name, rtol].fit(), exact))
            if shift > found[0]:
                found = (shift, (wall, name, rtol))
    return found


def wrong_flags(study):
    """Every wrong flag at an ordinary tolerance, and whether it is uncertain within the estimated error."""
    rows = []
    for wall, name in study.pairs():
        for rtol in ORDINARY:
            errors = study.errors(wall, name, rtol)
            for i in np.flatnonzero(errors.wrong_flag):
                exact, run = study.exact[wall, name], study.estimated[wall, name, rtol]
                rows.append(
                    [
                        f"`{wall}`, {name}",
                        power(rtol),
                        f"{exact.record[i]}, {exact.level[i]:g} g",
                        edp(exact, i),
                        edp(run, i),
                        small(run.spread[i]),
                        *("yes" if yes else "no" for yes in (run.spread[i] > LARGE, in_doubt(run)[i])),
                    ]
                )
    return rows


def edp(histories, i):
    """EDP of a history, or 'collapse'."""
    return "collapse" if histories.collapsed[i] else f"{histories.edp[i]:.4f}"


def in_doubt(run):
    """Mask of the histories with an outcome that is uncertain within the estimated error, as in the product."""
    return (run.spread > 0.0) & ((run.edp + 2.0 * run.spread >= 1.0) | (run.spread > 1e-2))


def nearest(study):
    """Histories nearest to the limit that do not collapse: (wall, set, number)."""
    standing = [
        (study.exact[wall, name].edp[i], wall, name, i)
        for wall, name in study.pairs()
        for i in np.flatnonzero(~study.exact[wall, name].collapsed)
    ]
    return [each[1:] for each in sorted(standing, reverse=True)[:NEAREST]]


def flags(study):
    """Section 4."""
    near = nearest(study)
    figures.boundary(study, near)
    wrong = wrong_flags(study)
    shift, where = largest_shift(study, ORDINARY)
    lines = ["## 4. Reliability of collapse flags", ""]
    span = f"Between rtol = {power(ORDINARY[0])} and {power(ORDINARY[-1])}"
    if wrong:
        lines += paragraph(
            f"{span}, in {len(ORDINARY) * len(study.pairs())} runs of all histories of a wall, "
            f"{many(len(wrong), 'flag')} differed from the reference. No ordinary tolerance excludes this: a "
            "tighter one may fail for the history that is right with a looser one. The estimated error of section 5:"
        )
        lines += table(
            [
                "wall",
                "rtol",
                "history",
                "EDP of the reference",
                "EDP",
                "estimated error",
                "ill-conditioned",
                "flag uncertain",
            ],
            wrong,
        )
    else:
        lines += paragraph(f"{span} no flag differs from the reference.")
    moved = "It does not change at all."
    if where:
        place = f"({where[0]}, {where[1]}, rtol = {power(where[2])})"
        kind = "taken as if all histories were independent"
        moved = f"Its largest shift is {shift:.2f} standard errors, {kind} {place}."
    lines += paragraph("The fragility curve depends on the flags only. " + moved)
    return [
        *lines,
        *paragraph(f"The {NEAREST} histories nearest to the limit that do not collapse, at every tolerance:"),
        "![errors of the histories nearest the limit](../figures/verification_boundary.png)",
        "",
    ]


def doubts(study):
    """Numbers at the defaults for each wall and set: large errors, those detected, missed, false alarms."""
    counts = {}
    for wall, name in study.pairs():
        large = study.estimate_errors(wall, name, DEFAULT).edp > LARGE
        called = study.estimated[wall, name, DEFAULT].spread > LARGE
        counts[wall, name] = [int(c.sum()) for c in (large, large & called, large & ~called, ~large & called)]
    return counts


def estimates(study):
    """Section 5."""
    figures.estimate(study)
    rows = []
    for (wall, name), counts in doubts(study).items():
        errors, run = study.estimate_errors(wall, name, DEFAULT), study.estimated[wall, name, DEFAULT]
        # Errors near rounding cannot be estimated, which is not needed either.
        here = errors.moving & (errors.edp > 1e-12)
        ratio = run.spread[here] / errors.edp[here]
        rows.append(
            [
                f"`{wall}`, {name}",
                *counts,
                int(in_doubt(run).sum()),
                errors.flags(),
                f"{np.median(ratio):.3f}",
                f"{ratio.min():.2g} to {ratio.max():.2g}",
            ]
        )
    return [
        "## 5. The estimated error",
        "",
        *paragraph(
            "The estimate of `estimate_error = .true.` against the true error, at the defaults. A miss is an EDP with "
            "an error above 1e-6 that the estimate does not report; a false alarm is the opposite. A flag is uncertain "
            "if EDP plus twice the estimated error reaches the limit, or if that error exceeds 0.01."
        ),
        *table(
            [
                "wall",
                "error > 1e-6",
                "detected",
                "missed",
                "false alarms",
                "flags uncertain",
                "wrong flags",
                "median of estimate / error",
                "range",
            ],
            rows,
        ),
        *paragraph("Median and range are over the histories with errors above 1e-12."),
        "![estimated against true error](../figures/verification_estimate.png)",
        "",
        *dense_grid(study),
        *paragraph(
            "The estimate is not a bound, so a flag can be wrong without being uncertain. [Hard "
            "histories](certification.md) have a study of their own."
        ),
    ]


def dense_grid(study):
    """Paragraph and table of the estimate on more levels, with a tight run in place of the reference."""
    rows = []
    for wall, (run, errors) in study.dense.items():
        off = errors.edp > LARGE
        found = off & (run.spread > LARGE)
        doubted = errors.wrong_flag & in_doubt(run)
        rows.append(
            [
                f"`{wall}`",
                len(run.edp),
                errors.flags(),
                int(doubted.sum()),
                f"{off.sum()} ({100.0 * off.mean():.1f} %)",
                int(found.sum()),
                int(in_doubt(run).sum()),
            ]
        )
    return [
        *paragraph(
            "On 50 levels up to 1 g of the recorded set, and with one more wall, a run at "
            f"rtol = {power(TIGHTEST)} replaces the reference. It is itself uncertain for the most amplified errors:"
        ),
        *table(
            [
                "wall",
                "histories",
                "flags that differ",
                "of these uncertain",
                "EDP differences > 1e-6",
                "detected",
                "flags uncertain",
            ],
            rows,
        ),
    ]
