"""Jobs of the OpenQuake engine, job.ini: their lines, and comments on what their results mean."""

from __future__ import annotations

import json
from typing import Any

_INPUTS = [
    "[exposure]",
    "exposure_file = exposure.xml",
    "taxonomy_mapping_csv = taxonomy_mapping.csv",
    "",
]

_LEVELS = [
    "# Levels of the hazard. The engine sums the probability of damage at the levels over the steps of the hazard",
    "# between them. For a hazard x^-k and levels d apart in ln x the sum is too high by (k d)^2/6: at most 0.4 % here",
    "# with k = 2.5, but several per cent with the 20 levels that the engine suggests. A job of hazard should have",
    "# these levels, 60 or more, from where the curves begin to well above their ends, since the engine counts no",
    "# earthquake above the last:",
]

_YEAR = [
    "# In one year probabilities are small, and nearly annual frequencies. The engine takes all walls of a class for",
    "# identical: over t years it gives 1 - exp(-f t) with their mean frequency f. dondolo sums over the walls, each",
    "# with its own frequency (risk.probability). This gives less, since weak walls fall only once, and some never.",
    "risk_investigation_time = 1",
]


def _hazard(facts: dict[str, Any]) -> list[str]:
    """Lines on the hazard: a file of curves, or a calculation that has been run."""
    if "hazard" in facts:
        return [
            "[hazard]",
            "# Hazard curves. Their own levels are used; those for another calculation are below. In curves that",
            "# dondolo has written the last level has a probability of 0: stronger earthquakes count as if at it.",
            f"hazard_curves_csv = {facts['hazard']}",
            f"investigation_time = {facts['time']!r}",
            "# How far an asset may be from the nearest site of the curves [km]",
            f"asset_hazard_distance = {facts['distance']!r}",
            *_LEVELS,
            f'# intensity_measure_types_and_levels = {{"{facts["imt"]}": {facts["levels"]}}}',
            "",
        ]
    return [
        "[hazard]",
        "# Run a job of hazard first, then this one with its number: oq engine --run THIS_FILE --hc ID",
        *_LEVELS,
        f'# intensity_measure_types_and_levels = {{"{facts["imt"]}": {facts["levels"]}}}',
        "",
    ]


def damage_job(facts: dict[str, Any]) -> list[str]:
    """Lines of job_damage.ini: damage by all earthquakes.

    Parameters
    ----------
    facts : dict
        mark, imt, levels, and of the hazard curves, if there are any, hazard, time and distance.
    """
    return [
        f"# {facts['mark']}",
        "# Damage by all earthquakes: damages-rlzs has, for each asset, the expected number of its walls in each",
        "# state after a year. States exclude each other: a lighter one is without those that go on to the next.",
        "# Divided by the number of walls, collapse is the annual frequency of collapse.",
        "# An event-based job (calculation_mode = event_based_damage) exports damages-rlzs too, but there they are",
        "# means per event, not per year: the engine divides by the number of events of the catalogue. Times the",
        "# annual number of events, which is that number over the years of the catalogue (ses_per_logic_tree_path",
        "# times investigation_time), they are comparable with the numbers here.",
        "[general]",
        "description = Damage of walls, by dondolo",
        "calculation_mode = classical_damage",
        "",
        *_INPUTS,
        "[fragility]",
        "structural_fragility_file = fragility.xml",
        "",
        *_hazard(facts),
        "[risk]",
        *_YEAR,
        "# A table of consequences is for scenarios and event-based jobs: classical_damage of the engine 3.26 fails",
        "# with one.",
    ]


def risk_job(facts: dict[str, Any]) -> list[str]:
    """Lines of job_risk.ini: losses by all earthquakes."""
    return [
        f"# {facts['mark']}",
        "# Losses by all earthquakes: avg_losses-rlzs is the mean loss of each asset in a year, in the unit of its",
        "# value.",
        "[general]",
        "description = Losses of walls, by dondolo",
        "calculation_mode = classical_risk",
        "",
        *_INPUTS,
        "[vulnerability]",
        "structural_vulnerability_file = vulnerability.xml",
        "",
        *_hazard(facts),
        "[risk]",
        *_YEAR,
        "# Steps of the curve of losses between two ratios of the vulnerability functions. The mean is the area below",
        "# that curve, by straight lines: with few steps it is too high or too low by some per cent.",
        "lrem_steps_per_interval = 10",
    ]


def scenario_job(facts: dict[str, Any], motion: list[str]) -> list[str]:
    """Lines of job_scenario.ini: damage by one earthquake, from ground-motion fields or a ShakeMap."""
    lines = [
        f"# {facts['mark']}",
        "# Damage by one earthquake: avg_damages has, for each asset, the mean number of its walls in each state over",
        "# the ground-motion fields. dondolo gives the same for one site by curve.scenario(median, dispersion).",
        "[general]",
        "description = Damage of walls by one earthquake, by dondolo",
        "calculation_mode = scenario_damage",
        "random_seed = 1",
        "",
        *_INPUTS,
        "[fragility]",
        "structural_fragility_file = fragility.xml",
    ]
    if facts["has_consequences"]:
        lines.append("consequence_file = {'taxonomy': 'consequences.csv'}")
    lines += ["", "[motion]"]
    if motion[0].endswith(".csv"):
        lines += [
            "# Columns event_id, site_id, gmv_IMT, and site_id, lon, lat",
            "gmfs_csv = gmfs.csv",
            "sites_csv = sites.csv",
        ]
    else:
        uri = {"kind": "usgs_xml", "grid_url": motion[0], "uncertainty_url": motion[1]}
        lines += [
            f"shakemap_uri = {json.dumps(uri)}",
            "number_of_ground_motion_fields = 1000",
            "truncation_level = 3",
            "# With correlations totals of the town scatter more; means stay as they are.",
            "spatial_correlation = yes",
            "cross_correlation = yes",
            f"# The engine takes the ShakeMap's {facts['imt']} if it has it.",
        ]
    lines.append("asset_hazard_distance = 15")
    if facts["has_occupants"]:
        lines += ["", "[risk]", "# Occupants are those of the column 'night'.", "time_event = night"]
    return lines
