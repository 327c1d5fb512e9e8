"""The strip SIN-01 under the measured velocity of its table, from a folder that a user has."""

from pathlib import Path

import campaigns
import motions
import numpy as np
import scores

import dondolo as dd

#: End of the names of the files, after the name of the motion
ENDING = "_BottomShakeTable.txt"
#: Middle of the published restitution_factor, and the heights of the hinge that are tried
FACTOR, HINGES = 0.87, (0.5, 0.6, 0.634)
#: Walls of the sample, and the seed of its random numbers
WALLS, SEED = 400, 1


def raw_folder(given: Path | None, campaign: campaigns.Campaign) -> Path | None:
    """The folder that has all motions of the campaign, None if there is none."""
    for place in () if given is None else (given, given / "1WB_EUCENTRE/1WB SIN-01/INPUT", given / "sin01"):
        if all((place / f"{row['motion']}{ENDING}").is_file() for row in campaign.tests):
            return place
    return None


def table_velocity(path: Path) -> tuple[np.ndarray, float]:
    """Acceleration of a table from its velocity, and the step.

    Parameters
    ----------
    path : Path
        Lines of time [s] and velocity [m/s], separated by a comma; others are titles.

    Returns
    -------
    acceleration : ndarray
        Central differences of the velocity [m/s2].
    dt : float
        Step [s], the mean of those of the file, whose times are rounded.
    """
    pairs = []
    for line in path.read_text(encoding="utf-8").splitlines():
        try:
            time, velocity = map(float, line.replace(",", " ").split())
        except ValueError:
            continue
        pairs.append((time, velocity))
    times, velocities = np.array(pairs).T
    dt = float(times[-1] - times[0]) / (len(times) - 1)
    if np.abs(np.diff(times) - dt).max() > 0.05 * dt:
        raise ValueError(f"{path.name}: its steps of time differ by more than 5 %")
    return np.gradient(velocities, dt), dt


def wall_of(row: dict, **changes: float) -> dd.TwoBlockWall:
    """The strip of a test, whose load is a dead one; hinge, its depth and the restitution are given."""
    sizes = {name: float(row[name]) for name in ("height", "thickness", "density", "overburden")}
    return dd.TwoBlockWall(**sizes, overburden_inertia=0.0, **changes)


def sample(row: dict) -> list[dd.TwoBlockWall]:
    """A Latin hypercube of the ranges of a test, uniform and independent."""
    rng = np.random.default_rng(SEED)
    names = ("hinge", "hinge_depth", "restitution_factor")
    columns = {}
    for name in names:
        low, high = campaigns.interval(row[name])
        columns[name] = low + (high - low) * (rng.permutation(WALLS) + rng.random(WALLS)) / WALLS
    return [wall_of(row, **{name: float(columns[name][i]) for name in names}) for i in range(WALLS)]


def sin01(campaign: campaigns.Campaign, folder: Path) -> tuple[dict, list]:
    """Flags of all tests, for several heights of the hinge, and the share of a sample of walls that falls.

    Parameters
    ----------
    campaign : Campaign
        The campaign.
    folder : Path
        The folder of its motions.

    Returns
    -------
    found, rows : dict, list
        Statistics and lines of experiments.csv. Every test begins with the wall at rest and undamaged.
    """
    tests, records = campaign.tests, []
    for row in tests:
        acceleration, dt = table_velocity(folder / f"{row['motion']}{ENDING}")
        records.append(dd.Record(acceleration, dt, name=row["motion"], metadata={"motion": "shake table"}))
    known = np.array([row["measured"] != "" for row in tests])
    stood = np.array([row["measured"] == "1" for row in tests])

    def falls(walls: list) -> np.ndarray:
        return np.array([[dd.simulate(wall, one, history=False).collapsed for one in records] for wall in walls])

    single = falls([wall_of(tests[0], hinge=hinge, restitution_factor=FACTOR) for hinge in HINGES])
    share = falls(sample(tests[0])).mean(axis=0)
    peaks = [record.peak_acceleration / motions.GRAVITY for record in records]
    found = {
        "by_hinge": {
            f"{hinge:g}": scores.rightness(flag[known], ~stood[known])
            for hinge, flag in zip(HINGES, single, strict=True)
        },
        "share_that_falls": {row["test"]: float(one) for row, one in zip(tests, share, strict=True)},
        "surest_wrong_fall": float(share[stood].max()),
        "largest_pga_g": max(peaks),
    }
    rows = [
        ["sin01", row["test"], row["specimen"], "stood", row["measured"], f"{1.0 - one:.4f}", "", ""]
        for row, one in zip(tests, share, strict=True)
    ]
    return found, rows
