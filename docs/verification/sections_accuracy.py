"""Reference solution, error of the motion against its cost, and the targets."""

import re
import sys

import figures
from cases import WALLS
from markdown import bullets, many, paragraph, percent, power, small, table
from study import DEFAULT, REPEATS, TIGHT, TOLERANCES

LARGE = 1e-6  # EDPs with larger errors are counted
SHOWN = [TOLERANCES[i] for i in (0, 5, 9)]  # rows of the tables of accuracy and time
SHARE = 0.01  # of the histories, at the defaults
FEW = 2  # histories, at TIGHT


def demand(true, claim):
    """Stop if a sentence of the page is not true."""
    if not true:
        sys.exit(f"verification: this statement no longer holds, revise the page: {claim}")


def cost(study, rtol, other):
    """Ratio of the times of all histories at two tolerances."""
    milliseconds = [
        sum(study.milliseconds[wall, name, each] * len(study.exact[wall, name]) for wall, name in study.pairs())
        for each in (rtol, other)
    ]
    return milliseconds[0] / milliseconds[1]


def truth(study):
    """Section 1."""
    rows = []
    for wall, name in study.pairs():
        exact = study.exact[wall, name]
        worst = exact.spread.argmax()
        rtol = float(re.search(r"rtol = ([^,]+),", study.made_with[wall, name]).group(1))
        rows.append(
            [
                f"`{wall}`",
                name,
                len(exact),
                power(rtol),
                small(exact.spread[worst]),
                f"{exact.record[worst]}, {exact.level[worst]:g} g",
                int((exact.spread > 1e-12).sum()),
            ]
        )
    changes = [study.exact[pair].spread.max() for pair in study.pairs()]
    demand(max(changes) < 0.01 * LARGE, "the reference is at least a hundred times more accurate than counted errors")
    return [
        "## 1. Reference solution",
        "",
        *paragraph(
            "The exact solution is the motion defined in [theory.md](../theory.md#4-the-hybrid-motion) for an "
            "accelerogram that is linear between its samples: rocking starts, impacts occur, chains of bounces "
            "end and the peak is reached at their exact instants instead of at samples."
        ),
        *paragraph(
            "The tables of `test/reference` contain the EDP of every history to 20 digits. "
            "`./run reference` compiles the same sources in real128 (33 digits) and runs them at a tolerance at "
            "which even the most amplified error is small. The change of an EDP when that tolerance is relaxed "
            "a hundredfold bounds the error of the table."
        ),
        *table(
            ["wall", "accelerograms", "histories", "rtol", "largest change of an EDP", "in", "changes above 1e-12"],
            rows,
        ),
        *bullets(f"`{wall}`: `{said}`" for wall, said in WALLS.items()),
        *paragraph(
            "[Verification](../verification.md#what-is-compared-with-what) names the accelerograms. Reference and "
            "product share their sources; section 7 lists the independent checks of both."
        ),
    ]


def work_precision(study):
    """Section 2."""
    figures.work(study)
    lines = [
        "## 2. Accuracy and time",
        "",
        *paragraph(
            f"The engine rk45 is run at rtol from {power(TOLERANCES[0])} to {power(TOLERANCES[-1])}, atol = rtol/100, "
            "on one thread. The error is that of the EDP with respect to the reference; the median is over the "
            f"histories that rock and do not collapse. Times are medians of {REPEATS} runs, exclude the reading of "
            "files, and are indicative only. The figure has all tolerances, the tables a part of them."
        ),
        "![error of the EDP against tolerance and time per history](../figures/verification_work.png)",
        "",
    ]
    head = ["rtol"]
    for _ in range(2):
        head += ["wrong flags", "> 1e-6", "worst", "median", "ms"]
    for wall in dict.fromkeys(wall for wall, _ in study.pairs()):
        rows = []
        for rtol in SHOWN:
            row = [f"**{power(rtol)}**" if rtol == DEFAULT else power(rtol)]
            for name in ("recorded", "synthetic"):
                errors = study.errors(wall, name, rtol)
                row += [
                    errors.flags(),
                    errors.above(LARGE),
                    small(errors.worst()),
                    small(errors.quantile(0.5)),
                    f"{study.milliseconds[wall, name, rtol]:.3f}",
                ]
            rows.append(row)
        numbers = [len(study.exact[wall, name]) for name in ("recorded", "synthetic")]
        lines += paragraph(f"`{wall}`: {numbers[0]} recorded histories (left), {numbers[1]} synthetic ones (right)")
        lines += table(head, rows)
    return lines + defaults(study)


def defaults(study):
    """Paragraph on the choice of the defaults."""
    loosest, looser, tighter = TOLERANCES[0], [r for r in TOLERANCES if r > DEFAULT], DEFAULT / 100.0
    medians = {
        rtol: [study.errors(wall, name, rtol).quantile(0.5) for wall, name in study.pairs()]
        for rtol in (*looser, DEFAULT, TIGHT)
    }
    change = max(max(a / b, b / a) for r in looser for a, b in zip(medians[r], medians[DEFAULT], strict=True))
    gain = min(a / b for a, b in zip(medians[DEFAULT], medians[TIGHT], strict=True))
    near, far, farther = cost(study, DEFAULT, loosest), cost(study, tighter, DEFAULT), cost(study, TIGHT, DEFAULT)
    demand(change < 3.0, f"down to {power(DEFAULT)} the samples set the step: medians change {change:.2g}-fold")
    demand(near < 1.35, f"the default costs little more than the loosest tolerance: {percent(near)}")
    demand(far > 1.2 and farther > 1.8, f"beyond the default accuracy costs time: {percent(far)}, {percent(farther)}")
    demand(gain > 10.0, f"beyond the default errors fall: {gain:.2g}-fold at {power(TIGHT)}")
    return paragraph(
        f"**Why rtol = {power(DEFAULT)} and atol = {power(DEFAULT / 100.0)} are the defaults.** One step from sample "
        "to sample is already so accurate that looser tolerances have almost no effect: from "
        f"{power(loosest)} on, no median error changes by more than a factor {change:.1f}. Against the loosest, the "
        f"default costs {percent(near)} time; {power(tighter)} costs {percent(far)} more, and {power(TIGHT)} "
        f"{percent(farther)}. Median errors of the last are at least {gain:.0f} times smaller. The default matters if "
        "the samples do not limit the step: for accelerograms with coarser samples than these (0.005 s), and for "
        "smaller, faster walls."
    )


def targets(study):
    """Section 3."""
    missed = []
    for wall, name in study.pairs():
        at_default, at_tight = (study.errors(wall, name, rtol) for rtol in (DEFAULT, TIGHT))
        allowed = int(SHARE * len(study.exact[wall, name]))
        met = at_default.flags() == 0 and at_default.above(LARGE) <= allowed and at_tight.above(LARGE) <= FEW
        if not met:
            missed.append(f"`{wall}`, {name}")
    result = f"**They are not met** by {'; '.join(missed)}." if missed else "Every wall and set meets them."
    return [
        "## 3. Targets",
        "",
        *paragraph(
            f"At the defaults no flag may be wrong, and at most {100.0 * SHARE:.0f} % of the EDPs may have errors "
            f"above 1e-6; at rtol = {power(TIGHT)} at most {many(FEW, 'EDP')}. {result}"
        ),
    ]
