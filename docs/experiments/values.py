"""Campaigns whose measured numbers are in the repository: computed beside measured, and their statistics."""

import campaigns
import numpy as np
import scores
from scipy.special import ndtri

import dondolo as dd
from dondolo._fortran.uncertainty import published_factors

#: Ends of the interval of coverage
TAILS = (0.05, 0.95)
#: Slendernesses H/B up to which a block is called squat
SQUAT = 6.0


def limestone(campaign: campaigns.Campaign) -> tuple[dict, list]:
    """Speed ratios of blocks of limestone: single impacts, and ten in a row."""
    tests = campaigns.distinct(campaign.tests)
    measured = np.array([float(row["measured"]) for row in tests])
    computed = np.array([_speed_ratio(row) for row in tests])
    slenderness = np.array([float(row["height"]) / float(row["thickness"]) for row in tests])
    groups = np.array([row["specimen"] for row in tests])
    first = np.array([row["test"].endswith("impact 1") for row in tests])
    found = {
        "first_impact": _first_impacts(measured[first], computed[first], slenderness[first], groups[first]),
        "ten_impacts": _ten_impacts(tests, measured, computed, slenderness),
    }
    return found, _rows(campaign, tests, measured, computed)


def _speed_ratio(row: dict) -> float:
    """The speed ratio that dondolo gives a block."""
    sizes = {name: float(row[name]) for name in ("height", "thickness", "density")}
    return dd.FreeStandingWall(**sizes).restitution_coefficient


def _first_impacts(measured, computed, slenderness, groups) -> dict:
    """Statistics of first impacts."""
    ratio = measured / computed
    x, none = scores.log_ratios(measured, computed)
    se = scores.bootstrap(groups, lambda w: [np.average(x, weights=w)])[0]
    squat = slenderness <= SQUAT
    b, se_b = scores.slope(slenderness, x)
    return {
        **scores.mean_and_scatter(x),
        "se_bias_over_groups": float(se),
        "computed_zero": none,
        "mean_ratio": float(ratio.mean()),
        "sd_ratio": float(ratio.std(ddof=1)),
        **{f"{key}_ratio": value for key, value in scores.within_and_between(ratio, groups).items()},
        "ratios_above_1": int(np.sum(ratio > 1.0)),
        "measured_above_1": int(np.sum(measured > 1.0)),
        "mean_ratio_squat": float(ratio[squat].mean()),
        "mean_ratio_slender": float(ratio[~squat].mean()),
        "slope_per_slenderness": b,
        "se_slope": se_b,
        "coverage": _coverage(ratio),
    }


def _coverage(ratio) -> dict:
    """How many measured ratios lie in 90 % intervals of distributions of `restitution_factor`."""
    mean, sd_between = _normal("colombo_2025")
    low, high = _uniform("elgawady_2010")
    sd = round(float(np.std(ratio, ddof=1)), 3)
    intervals = {
        f"normal, sd {sd:g}, scatter of single impacts": mean + sd * ndtri(TAILS),
        f"colombo_2025, sd {sd_between:g}, uncertainty of the mean": mean + sd_between * ndtri(TAILS),
        "elgawady_2010, uniform": low + (high - low) * np.array(TAILS),
    }
    return {name: int(np.sum((ratio >= ends[0]) & (ratio <= ends[1]))) for name, ends in intervals.items()}


def _normal(name: str) -> tuple[float, float]:
    """Mean and standard deviation of a published distribution."""
    known = published_factors()[name]
    assert known.kind == "normal"
    return known.first, known.second


def _uniform(name: str) -> tuple[float, float]:
    """Ends of a published distribution."""
    known = published_factors()[name]
    assert known.kind == "uniform"
    return known.first, known.second


def _ten_impacts(tests, measured, computed, slenderness) -> dict:
    """Mean logarithm of the speed ratio of ten impacts in a row, less the computed one."""
    trials: dict[str, list[int]] = {}
    for i, row in enumerate(tests):
        trials.setdefault(row["test"].split(" impact ")[0], []).append(i)
    places = [rows for rows in trials.values() if len(rows) == 10]
    x = np.array([float(np.mean(np.log(measured[rows]))) - np.log(computed[rows[0]]) for rows in places])
    groups = np.array([tests[rows[0]]["specimen"] for rows in places])
    shape = np.array([slenderness[rows[0]] for rows in places])
    se = scores.bootstrap(groups, lambda w: [np.average(x, weights=w)])[0]
    found = {**scores.mean_and_scatter(x), "se_bias_over_groups": float(se), "by_slenderness": {}}
    for one in sorted(set(shape.tolist())):
        here = shape == one
        e = float(computed[places[int(np.argmax(here))][0]])
        found["by_slenderness"][f"{one:g}"] = {
            "n": int(here.sum()),
            "bias": float(x[here].mean()),
            "computed": e,
            "measured": float(e * np.exp(x[here].mean())),
        }
    return found


def elgawady(campaign: campaigns.Campaign) -> tuple[dict, list]:
    """Ratios of measured speed ratios to Housner's, of blocks on concrete; on rubber apart."""
    tests = campaign.tests
    measured = np.array([float(row["measured"]) for row in tests])
    computed = np.ones(len(tests))
    concrete = np.array([row["specimen"] == "concrete" for row in tests])
    found = {
        "concrete": scores.mean_and_scatter(np.log(measured[concrete])),
        "rubber": {"n": int(np.sum(~concrete)), "bias": float(np.log(measured[~concrete]).mean())},
    }
    return found, _rows(campaign, tests, measured, computed)


def triggers(row: dict) -> dict[str, float]:
    """Trigger acceleration of a strip at the ends of its ranges [g], the least and the largest."""
    found = []
    for height in campaigns.interval(row["height"]):
        for hinge in campaigns.interval(row["hinge"]):
            wall = dd.TwoBlockWall(
                height,
                float(row["thickness"]),
                density=float(row["density"]),
                hinge=hinge,
                overburden=float(row["overburden"]),
                overburden_inertia=0.0,
            )
            found.append(wall.trigger_acceleration / wall.gravity)
    return {"least": min(found), "largest": max(found)}


def safego(campaign: campaigns.Campaign) -> tuple[dict, list]:
    """Peaks of loaded strips: below its trigger acceleration a rigid strip does not move."""
    tests = [row for row in campaign.tests if row["quantity"] == "peak_displacement"]
    measured = np.array([float(row["measured"]) for row in tests])
    known = np.array([bool(row["pga"]) for row in tests])
    pga = np.array([float(row["pga"] or "nan") for row in tests])
    trigger = triggers(tests[0])
    found = {
        "runs": len(tests),
        "runs_with_pga": int(known.sum()),
        "computed_zero": int(np.sum(pga[known] < trigger["least"])),
        "trigger_least_g": trigger["least"],
        "trigger_largest_g": trigger["largest"],
        "pga_from_g": float(pga[known].min()),
        "pga_to_g": float(pga[known].max()),
        "peak_from_mm": 1e3 * float(measured[known].min()),
        "peak_to_mm": 1e3 * float(measured[known].max()),
        "trigger_over_largest_pga": trigger["least"] / float(pga[known].max()),
        "runs_above_1_mm": int(np.sum(measured[known] > 1e-3)),
        "least_pga_above_1_mm_g": float(pga[known][measured[known] > 1e-3].min()),
    }
    # Without the motions nothing is computed for runs whose PGA is not known.
    computed = np.where(pga < trigger["least"], 0.0, np.nan)
    return found, _rows(campaign, tests, measured, computed)


def sin01(campaign: campaigns.Campaign) -> tuple[dict, list]:
    """A loaded strip that was shaken fifteen times: without its motions only the trigger acceleration is computed."""
    tests = campaign.tests
    trigger = triggers(tests[0])
    found = {
        "tests": len(tests),
        "stood": sum(row["measured"] == "1" for row in tests),
        "not_read": sum(row["measured"] == "" for row in tests),
        "trigger_least_g": trigger["least"],
        "trigger_largest_g": trigger["largest"],
    }
    measured = np.array([float(row["measured"] or "nan") for row in tests])
    return found, _rows(campaign, tests, measured, np.full(len(tests), np.nan))


def _rows(campaign: campaigns.Campaign, tests, measured, computed) -> list:
    """Lines of experiments.csv."""
    lines = []
    for row, m, c in zip(tests, measured, computed, strict=True):
        ratio = f"{np.log(m / c):.6f}" if m > 0.0 and c > 0.0 else ""
        texts = ["" if np.isnan(value) else f"{value:.7g}" for value in (m, c)]
        lines.append([campaign.name, row["test"], row["specimen"], row["quantity"], *texts, ratio, ""])
    return lines


#: Statistics of the campaigns whose numbers are in the repository
RUNNERS = {"limestone": limestone, "elgawady": elgawady, "safego": safego, "sin01": sin01}
