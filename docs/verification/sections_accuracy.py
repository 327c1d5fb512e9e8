"""Reference solution, error of the motion against its cost, and the targets."""

import re
import sys

import figures
from cases import WALLS
from markdown import bullets, many, paragraph, percent, power, small, table
from study import DEFAULT, REPEATS, TIGHT, TOLERANCES

LARGE = 1e-6  # EDPs with larger errors are counted
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
            "The exact solution is the [hybrid motion](../theory.md#4-the-hybrid-motion) under an accelerogram that is "
            "linear between its samples, with starts, impacts, ends of chains and peaks at their exact instants."
        ),
        *paragraph(
            "The tables of `test/reference` have the EDP of every history to 20 digits. `./run reference` computes "
            "them from the same sources in real128 (33 digits). The change of an EDP when the tolerance is relaxed a "
            "hundredfold bounds the error of the table."
        ),
        *table(
            ["wall", "accelerograms", "histories", "rtol", "largest change of an EDP", "in", "changes above 1e-12"],
            rows,
        ),
        *bullets(f"`{wall}`: `{said}`" for wall, said in WALLS.items()),
        *paragraph(
            "[Verification](../verification.md#what-is-compared-with-what) names the accelerograms. Section 7 lists "
            "independent checks of the shared sources."
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
            "on one thread. The error is that of the EDP; the median is over the histories that rock and do not "
            f"collapse. Times are medians of {REPEATS} runs without the reading of files, and are indicative only. The "
            f"figure has all tolerances, the table the default, {power(DEFAULT)}."
        ),
        "![error of the EDP against tolerance and time per history](../figures/verification_work.png)",
        "",
    ]
    rows = []
    for wall, name in study.pairs():
        errors = study.errors(wall, name, DEFAULT)
        rows.append(
            [
                f"`{wall}`, {name}",
                len(study.exact[wall, name]),
                errors.flags(),
                errors.above(LARGE),
                small(errors.worst()),
                small(errors.quantile(0.5)),
                f"{study.milliseconds[wall, name, DEFAULT]:.3f}",
            ]
        )
    lines += table(["wall", "histories", "wrong flags", "> 1e-6", "worst", "median", "ms per history"], rows)
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
        f"to sample is so accurate that from {power(loosest)} on no median error changes by more than a factor "
        f"{change:.1f}. Against the loosest, the default costs {percent(near)} time; {power(tighter)} costs "
        f"{percent(far)} more, and {power(TIGHT)} {percent(farther)}, with median errors at least {gain:.0f} times "
        "smaller. The default matters where samples do not limit the step: they are coarser than here (0.005 s), or "
        "the wall is smaller and faster."
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
