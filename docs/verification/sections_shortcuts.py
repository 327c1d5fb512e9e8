"""Effect of shortcuts on the results, and the tests that verify the rest."""

import figures
import numpy as np
from cases import ROOT
from histories import Errors
from markdown import bullets, paragraph, table
from sections_accuracy import LARGE, SHARE, demand
from sections_flags import shifts, signed

NONE, ALL, NO_TAIL = "none", "all of these", "nothing after the record"
MANY = 10  # wrong flags

MEANINGS = [
    "*none*: as close to the reference as dondolo is, a check of the study itself.",
    "*rest below 1e-3 of the capacity*: a rebound that would rise less than that in still ground is treated as rest. "
    "dondolo sets a wall to rest only if its chain of bounces provably ends there.",
    "*rocking starts at the next sample* instead of inside the interval.",
    "*impact at the end of its step*: q = 0 and the restitution are applied at the end of a step with q < 0.",
    "*peak of the samples*, or of every 0.01 s, which is every second sample here: peak and collapse are not located.",
    "*steps across samples*: the step is controlled by the error only, and the accelerogram is interpolated.",
    "*nothing after the record*: the EDP is that reached by the last sample.",
    "*all of these*, with rest below 1e-4 of the capacity and the peak of every 0.01 s.",
]

TESTS = [
    (
        "Free fall and free rocking of a block, linear and nonlinear; Housner's amplitudes; a one-sided chain of "
        "bounces",
        "Housner 1963; closed forms",
        "test_motion",
        ("free fall", "free rocking"),
    ),
    (
        "Rectangular, half-sine, one-sine and one-cosine pulses that overturn without impact",
        "closed forms after Makris and Roussos 2000, Zhang and Makris 2001",
        "test_pulses",
        ("rectangular pulses", "pulses without impact"),
    ),
    (
        "Overturning with impacts, the safe window above it, overturning without impact",
        "Zhang and Makris 2001, figures 7 and 8",
        "test_pulses",
        ("one-sine pulse with impacts",),
    ),
    (
        "Published overturning accelerations, the strongest case to 1e-8",
        "Makris and Roussos 2000, figures 2 and 11; a public code",
        "test_pulses",
        ("published overturning",),
    ),
    (
        "Orders of convergence: steps, embedded error, dense output, instants of impacts, whole histories",
        "theory of the method",
        "test_convergence",
        ("equal steps", "one step", "dense output", "instant of impact", "whole histories"),
    ),
    (
        "Energy between and across impacts, work of the ground",
        "balance of energy",
        "test_energy",
        ("free rocking", "energy at impacts", "work of the ground"),
    ),
    (
        "Dips and peaks inside a step, events exactly on a sample, starts and ends at the edge, grazing",
        "closed forms, continuity",
        "test_events",
        ("a dip inside a step", "an impact on a sample", "a touch of the threshold", "a grazing impact"),
    ),
    (
        "Chains of bounces: sums, time to rest, the rule that ends them",
        "closed sums; every bounce integrated",
        "test_chains",
        ("time to rest", "sums of bounces", "the rule that ends chains", "the worst chain"),
    ),
    ("The motion after the record", "continued stepping", "test_tail", ("after the record", "free motion")),
    (
        "Coefficients of every mechanism, restitutions",
        "computed independently, 15 digits",
        "test_wall",
        ("one block, H = 3, t = 0.25", "two blocks, H = 3, t = 0.25, hinge 0.6", "models of restitution"),
    ),
    (
        "Two blocks hinged at mid height: trigger, inertia, capacity, impulse restitution",
        "closed forms, published values",
        "test_wall",
        ("two blocks hinged at mid height",),
    ),
    (
        "The same of walls with storeys, loads, thrusts, springs and hinges at some depth, and their first swings",
        "computed independently, 15 digits",
        "test_loaded_block",
        ("bodies", "terms", "trigger, capacity, energy", "first swing", "restitution"),
    ),
    (
        "The same of two blocks with hinges at some depth and with the mass of their overburden",
        "computed independently, 15 digits",
        "test_loaded_two_block",
        ("terms", "restitution", "first swing"),
    ),
    ("Motions of floors", "computed independently, 15 digits", "test_floors", ("values", "limits", "convergence")),
    (
        "Checks by NTC 2018, spectra of the site and of floors",
        "computed independently, 17 digits",
        "test_code_check",
        ("spectra", "wall W1", "parapet on a building", "facade with floors and thrust"),
    ),
    ("C = J'/2 and G - Q = V'", "energy", "test_wall", ("C = J''/2 and G - Q = V''",)),
    (
        "Fits of fragility curves, their standard errors and likelihood",
        "closed form; two public data sets",
        "test_fragility",
        ("two stripes", "published data"),
    ),
    (
        "Random walls, accelerograms, scales, tolerances and limits; every history that ever failed",
        "properties",
        "test_stress",
        ("exact thresholds", "kept histories", "random histories", "long records"),
    ),
    (
        "Random walls with ties and friction: work of the ground, what is held, dissipated and lost, to 1e-9",
        "balance of energy",
        "test_tied_histories",
        ("kept walls with ties", "walls with ties"),
    ),
    (
        "Any number of threads, any grouping of histories",
        "equality to the bit",
        "test_grouping",
        ("threads and grouping",),
    ),
    ("The tables of sections 1 and 8", "the same sources in 33 digits", "test_reference", ("recorded accelerograms",)),
]


def shortcut_errors(study):
    """Errors as {wall: {shortcut: errors}}, after a check of the study's own motion."""
    found = {
        wall: {name: Errors(run, study.exact[wall, "recorded"]) for name, run in runs.items()}
        for wall, runs in study.shortcuts.items()
    }
    for wall, each in found.items():
        exact = each[NONE]
        demand(
            exact.flags() == 0 and exact.above(LARGE) <= SHARE * len(exact.edp),
            f"{wall}: without shortcuts the study reproduces dondolo's results",
        )
    return found


def shortcuts(study):
    """Section 6."""
    found = shortcut_errors(study)
    figures.shortcuts(found)
    lines = [
        "## 6. Effect of shortcuts",
        "",
        *paragraph(
            "[plain_motion.f90](../verification/shortcuts/plain_motion.f90) integrates the same motion with a loop of "
            "its own, and applies shortcuts that are common in programs of this kind, one at a time, at the default "
            "tolerances on the recorded set."
        ),
        *bullets(MEANINGS),
        "![wrong flags and EDPs of each shortcut](../figures/verification_shortcuts.png)",
        "",
    ]
    rows = []
    for name in next(iter(found.values())):
        cells = []
        for wall, each in found.items():
            exact, fit = study.exact[wall, "recorded"].fit(), study.shortcuts[wall][name].fit()
            flags, off = each[name].flags(), each[name].above(1e-3)
            cells += [f"{flags}, {off}", ", ".join(map(signed, shifts(fit, exact)))]
        rows.append([name, *cells])
    histories = len(study.exact[next(iter(found)), "recorded"])
    lines += paragraph(
        f"Wrong flags, EDPs with an error above 1e-3, of {histories} histories from 0.05 to 1 g, and shifts of ln θ "
        "and β in standard errors:"
    )
    head = [text for wall in found for text in (f"`{wall}`", "shifts")]
    lines += table(["shortcut", *head], rows)
    return lines + closing(study, found)


def closing(study, found):
    """Paragraph that summarises the tables."""
    harmless = [name for name in found["one_sided"] if not any(each[name].flags() for each in found.values())]
    harmless = ", ".join(f"*{name}*" for name in harmless if name != NONE) or "none of them"
    for runs in study.shortcuts.values():
        demand(
            np.array_equal(runs[NONE].edp, runs[NO_TAIL].edp), "these records last until no wall can reach a new peak"
        )
    hidden = [
        (abs(shifts(study.shortcuts[wall][name].fit(), study.exact[wall, "recorded"].fit())[0]), wall, name)
        for wall, each in found.items()
        for name in each
        if each[name].flags() >= MANY
    ]
    shift, wall, name = min(hidden)
    return paragraph(
        f"No flag is wrong with {harmless}. These records last until no wall can reach a new peak; the motion after "
        "the record matters if it was cut short. θ hides many of these errors, because wrong flags of both kinds "
        f"cancel. The {found[wall][name].flags()} of *{name}* change that of `{wall}` by {shift:.3f} standard errors."
    )


def tests():
    """Section 7; the listed tests must exist."""
    rows = []
    for what, source, program, suites in TESTS:
        text = (ROOT / "test" / f"{program}.f90").read_text(encoding="utf-8")
        for suite in suites:
            demand(f"call suite('{suite}')" in text, f"{program} has a suite '{suite}'")
        rows.append([what, source, f"[{program}](../../test/{program}.f90)"])
    path = "python/tests/test_independent.py"
    demand((ROOT / path).is_file(), f"{path} exists")
    rows.append(
        [
            "Coefficients, accelerations, restitutions, whole histories",
            "rigid bodies with hinges, solved by SciPy",
            f"[test_independent](../../{path})",
        ]
    )
    return [
        "## 7. Verified by tests",
        "",
        *paragraph(
            "`./run test` runs all of them. `./run mutations` introduces errors into the formulas of the statistics, "
            "one at a time, and checks that each is caught by a test ([mutations](../../test/mutations.py))."
        ),
        *table(["quantity", "compared with", "test"], rows),
    ]
