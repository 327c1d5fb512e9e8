"""The strips of SAFEGO with joints that bend before they open, under the record that shook them."""

import math
import os
from pathlib import Path

import campaigns
import numpy as np
import strips
from motions import GRAVITY

import dondolo as dd

#: Components of the record, Friuli 1976-05-06 at Tolmezzo, in a folder of recorded accelerograms
RECORDS = ("19760506_2000_TLM1_NS", "19760506_2000_TLM1_WE")
#: Name of the motion in the table of tests
MOTION = "FR76"
#: Measured periods of the uncracked and of the cracked strip [s]
PERIODS = {"uncracked": 0.107, "cracked": 0.134}
#: Height of the hinge of the measured displacement
HINGE = 0.72


def record_folder() -> Path | None:
    """The folder that has both components, None if there is none."""
    folder = Path(os.environ.get("DONDOLO_RECORDS", ""))
    return folder if all((folder / "italy" / f"{name}.acc").is_file() for name in RECORDS) else None


def levels(tests: list) -> dict[str, float]:
    """PGA of each scale of the motion [g]: that of the table, or else that of scale 1 times the scale."""
    own = [row for row in tests if row["motion"] == MOTION]
    known = {row["scale"]: float(row["pga"]) for row in own if row["pga"]}
    return {row["scale"]: known.get(row["scale"], float(row["scale"]) * known["1.0"]) for row in own}


def peaks(wall: dd.TwoBlockWall, record: dd.Record, pga: float) -> float:
    """Largest displacement of the hinge [mm]."""
    response = dd.simulate(wall, record, pga * GRAVITY / record.peak_acceleration, history=False)
    return 1e3 * HINGE * wall.height * math.sin(response.edp * wall.capacity_angle)


def safego(campaign: campaigns.Campaign, folder: Path) -> dict:
    """Displacements computed with both periods, beside those measured.

    Parameters
    ----------
    campaign : Campaign
        The campaign.
    folder : Path
        A folder of recorded accelerograms.

    Returns
    -------
    dict
        Measured [mm], computed by period, height, scale and component [mm], and the geometric means of
        computed/measured at each scale, over heights, components and specimens.
    """
    catalogue = {record.name: record for record in dd.read_catalogue(folder / "italy44.csv")}
    records = [catalogue[name] for name in RECORDS]
    tests = [row for row in campaign.tests if row["motion"] == MOTION]
    pga = levels(tests)
    measured = {scale: [1e3 * float(row["measured"]) for row in tests if row["scale"] == scale] for scale in pga}
    computed, ratios, opens = {}, {}, {}
    for name, period in PERIODS.items():
        computed[name], opens[name] = {}, {}
        for height in campaigns.interval(tests[0]["height"]):
            row = tests[0] | {"height": height}
            wall = strips.wall_of(row, hinge=HINGE, restitution_factor=strips.FACTOR, elastic_period=period)
            computed[name][f"{height:g}"] = {
                scale: [peaks(wall, record, level) for record in records] for scale, level in pga.items()
            }
            opens[name][f"{height:g}"] = 1e3 * HINGE * height * math.sin(wall.opening_edp * wall.capacity_angle)
        ratios[name] = {
            scale: float(
                np.exp(
                    np.mean(
                        [
                            math.log(one / other)
                            for found in computed[name].values()
                            for one in found[scale]
                            for other in measured[scale]
                        ]
                    )
                )
            )
            for scale in pga
        }
    return {
        "pga_g": pga,
        "measured_mm": measured,
        "computed_mm": computed,
        "opens_mm": opens,
        "computed_over_measured": ratios,
    }
