"""Sentences of the page that are not about one campaign, and the one about the boulders that may be quoted."""

import csv
import importlib.util
import math
from pathlib import Path

#: Slenderness, and its functions, in sentences
ALPHA = "\N{GREEK SMALL LETTER ALPHA}"

#: What is said of a strip until somebody has run its motions
MOTIONS_OF_SIN01 = (
    "Its motions have no licence and are not here. `--raw FOLDER` computes the outcomes, for whoever has them; it has"
    " not been run with them yet."
)

_SPEC = importlib.util.spec_from_file_location("pages", Path(__file__).parents[1] / "verification/markdown.py")
markdown = importlib.util.module_from_spec(_SPEC)
_SPEC.loader.exec_module(markdown)


def opening() -> list[str]:
    """What the page is."""
    return [
        *markdown.paragraph(
            "This page compares dondolo with laboratory measurements. Restitution, hinges, damping, the collapse"
            " criterion and the processing of motions were never tuned to an outcome. Results that speak against"
            " dondolo stay here."
        ),
        *markdown.paragraph(
            "The [study](studies/experiments.md) has each campaign, its source and licence, and the methods."
        ),
        *markdown.paragraph(
            "The bias is the mean of ln(measured/computed), with its standard error in brackets. *Right* is the share"
            " of outcomes that are computed as measured, and means little without the yardsticks beside it."
        ),
    ]


def study_opening() -> list[str]:
    """What the study is."""
    return markdown.paragraph(
        "This study has the details of [Computed against measured](../experiments.md). `./run experiments` writes both"
        " pages. Measured numbers are in `data/experiments`. Data that may not be redistributed are read from a folder"
        " of yours (`--raw FOLDER`); without it they are skipped with a message. `--check` compares all statistics"
        " with the stored ones."
    )


def reading(specimens: dict) -> list[str]:
    """How the table is read."""
    ours, across = (
        " and ".join(f"{100.0 * specimens[name][part][key]:.0f}" for name in ("2", "1"))
        for part, key in (("test", "right"), ("yardsticks", "one_pgv_threshold_of_other_waveforms"))
    )
    return markdown.bullets(
        [
            "Stone on stone loses the speed that Housner's formula gives, within 2 %. Squat blocks lose less in"
            " repeated rocking.",
            "Whether a boulder falls under a known motion is computed better than by the guess that it never does, not"
            " better than by one threshold on PGV found on other tests: this is right in"
            f" {across} %, dondolo in {ours} %. A new wall has no such tests.",
            "Loaded strips begin to move at far lower accelerations than rigid blocks: they [bend](bending.md) before"
            " they rock.",
            "No test of a one-sided facade, the most frequent wall of dondolo, is here.",
        ]
    )


def boulders(specimens: dict) -> list[str]:
    """The section of the boulders, of the page for users."""
    return [
        "## Two boulders on a shake table",
        "",
        "![measured and computed fragility curves of both boulders](figures/experiments_curves.png)",
        "",
        *markdown.paragraph(granite_sentence(specimens)),
    ]


def granite_sentence(specimens: dict) -> str:
    """All that may be said of the boulders, with every yardstick.

    Parameters
    ----------
    specimens : dict
        Statistics of both specimens.

    Returns
    -------
    str
    """
    two, one = specimens["2"], specimens["1"]

    def both(*keys: str) -> str:
        found = []
        for value in (two, one):
            for key in keys:
                value = value[key]
            found.append(f"{100.0 * value:.0f}")
        return f"{found[0]} and {found[1]} %"

    def shift(value: dict) -> str:
        ratio = math.exp(-value["curve"]["bias"]) - 1.0
        side = "too high" if ratio > 0.0 else "too low, on the safe side,"
        return f"{abs(100.0 * ratio):.0f} % {side} for {{which}} (s.e. {100.0 * value['curve']['se_bias']:.0f} %)"

    wide = all(value["curve"]["beta_ratio"] < 1.0 for value in (one, two))
    return (
        f"**What can be said, and no more:** on {two['test']['n']} measured shake-table motions, scaled from about 50"
        f" waveforms, dondolo computes rightly in {both('test', 'right')} of the tests whether each of two granite"
        f' boulders overturned. The guess of always "stands" is right in {both("yardsticks", "always_stands")}, one'
        " threshold on PGV found on other tests in"
        f" {both('yardsticks', 'one_pgv_threshold_of_nearly_static_tests')} if these are nearly static and in"
        f" {both('yardsticks', 'one_pgv_threshold_of_other_waveforms')} if they are of all other waveforms. The"
        f" effective slenderness of each boulder was found on {two['identified_on']['n']} other, nearly static tests."
        f" The computed median PGV is {shift(two).format(which='one')} and {shift(one).format(which='the other')}"
        + ("; both computed curves are wider than the measured ones" if wide else "")
        + ". The best of the testing authors' own simulations reach"
        f" {both('yardsticks', 'best_simulation_of_the_authors')}."
    )


def model_error() -> list[str]:
    """How a model error enters a curve."""
    return [
        "## The error of the model in a curve",
        "",
        *markdown.paragraph(
            "[`with_model_error(bias, beta)`](reading_a_curve.md#the-error-of-the-model-itself) shows a curve with"
            " an error of its model. The numbers to give describe how ln(measured median/computed median) varies"
            " between specimens of known geometry. τ² is the variance of these biases less the mean of their squared"
            " standard errors. For a new wall beta is τ √(1 + 1/n), with Student's t of n - 1 degrees of freedom. At"
            " least five specimens of three campaigns are needed. **No mechanism has them yet:**"
        ),
    ]


def consequences(statistics: dict) -> list[str]:
    """What follows for a user."""
    first = statistics["limestone"]["first_impact"]
    squat = statistics["limestone"]["ten_impacts"]["by_slenderness"]["4"]
    return [
        "## What follows for your study",
        "",
        *markdown.paragraph(
            "**Restitution.** The factors that `&uncertainty` and `dd.propagate_uncertainty` know are"
            " [listed](reading_a_curve.md#restitution-what-is-published); `colombo_2025` is from"
            f" {first['n']} impacts of {first['groups_ratio']} slendernesses."
        ),
        *markdown.bullets(
            [
                "From impact to impact the ratio varies with a standard deviation of"
                f" {first['within_ratio']:.3f} within a slenderness (`restitution_sd` of the wall); the mean is"
                f" uncertain by {first['between_ratio']:.3f} (`restitution_factor`). Do not put the first in place of"
                " the second.",
                f"Squat blocks, H/B of 4: give `restitution_value = {squat['measured']:.2f}` beside the default of"
                f" {squat['computed']:.3f}, and report the lower median.",
            ]
        ),
        "### An object in a museum",
        "",
        *markdown.paragraph(
            "A statue or a vase behaves like a boulder: its effective slenderness is less than that of its drawing. The"
            " boulders above fell as if they had 50 and 70 % of the slenderness of their scans."
        ),
        "1. Measure the *effective* slenderness. Tilt the object, or pull it at the height of its centroid, until it"
        f" begins to rock:\n   tan {ALPHA} is the force over the weight. Do so in the weakest direction, on the"
        " base that it stands on.",
        "2. Take the frequency parameter p from mass and inertia, and with both make the block of the same R = 3 g/(4"
        f" p²):\n   `dd.FreeStandingWall(2 R cos {ALPHA}, 2 R sin {ALPHA})`.",
        f"3. Put a range on {ALPHA} (`thickness`) and on the restitution with `dd.propagate_uncertainty`: with an"
        " identified"
        f" {ALPHA} the two are correlated.",
        "4. Use the motion of the floor or of the showcase, not that of the ground.",
        "5. If you test the object on a table, measure the motion of the table, and give its catalogue `shake table` in"
        " the\n   column `motion` ([ground motions](ground_motions.md#catalogues)).",
        "",
    ]


def missing(wanted: Path) -> list[str]:
    """What a person could get, and from whom."""
    with wanted.open(encoding="utf-8", newline="") as file:
        _, *rows = csv.reader(file)
    return [
        "## Tests that are not here",
        "",
        *markdown.paragraph(
            "These campaigns exist, but their numbers could not be reached. Each needs a person who asks; one"
            " `campaign.json` and one `tests.csv` in `data/experiments` add it."
        ),
        *markdown.table(["campaign", "what to ask", "whom"], rows),
        *markdown.paragraph(
            "`shakebot` is in the repository and not used. Its motion was commanded to a stepper and never measured,"
            " so that a wrong outcome could be that of the table."
        ),
    ]


def methods() -> list[str]:
    """How the numbers are made."""
    return [
        "## How the numbers are made",
        "",
        *markdown.bullets(
            [
                "**Values**: ln(measured/computed), its mean and standard deviation; one-way analysis of variance"
                " with random effects within and between groups of specimens. A computed value of zero is counted"
                " apart.",
                "**Outcomes**: the share of right flags, false alarms and misses; lognormal curves by maximum"
                " likelihood of the measured and of the computed outcomes of the same motions, against the published"
                " PGV of the table; a probit of single motions.",
                "**Yardsticks**: the guess that nothing ever falls, and one threshold on PGV found on other tests.",
                "**Standard errors**: 1000 samples of waveforms, each with all its tests of both specimens, with the"
                " slenderness identified anew in each; for limestone of groups of specimens. Seed 1.",
                "**Motions of a table**: less their median; Butterworth of order 4 at 30 Hz, forward and back, at 800"
                " Hz; every fourth sample; order 2 at 0.1 Hz, forward and back. The code is"
                " `docs/experiments/motions.py`.",
                "**Granite**: a block with p = 4.4147 rad/s by the scan of the boulders, R = 3 g/(4 p²), and e = 1 -"
                f" 1.5 sin² {ALPHA}. The true distance to the edge is smaller; e is assumed.",
                "**Check**: `--check` allows no difference of statistics above 1e-6. Counts of granite may differ by"
                " 10 of 490, since two right integrators differ in 3 to 15 flags.",
                "A campaign is used whole or not at all. Measured numbers are not edited; an erratum is a new line"
                " with a note. A change of mechanics that moves a campaign by more than its standard error is in the"
                " changelog with both numbers.",
            ]
        ),
    ]
