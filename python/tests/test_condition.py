"""The condition of histories, which the estimated error reports, against central differences in 33 digits.

A relative change x of a record changes the EDP by c x, c the condition. The estimate takes c from runs in double
precision under records that are 512 eps stronger and weaker, and reports at least 8 eps c (docs/theory.md, section 5).
"""

import csv
from pathlib import Path

import numpy as np
import pytest

import dondolo as dd
from dondolo._fortran import _core
from dondolo._fortran.library import check
from dondolo.records.suite import upload
from dondolo.walls.wall import upload as upload_walls

ROOT = Path(__file__).resolve().parents[2]
EPS = np.finfo(np.float64).eps
CHANGE, ROUNDING = 512.0 * EPS, 8.0 * EPS
WALLS = {"one_sided": dd.OneSidedWall, "free_standing": dd.FreeStandingWall, "two_block": dd.TwoBlockWall}

pytestmark = pytest.mark.filterwarnings("ignore::dondolo.errors.DondoloWarning")


def exact_condition(wall, record, scale, guess):
    """Central difference of the EDP over the logarithm of the factor, in 33 digits."""
    # Small enough for a straight line, large enough for the error of the runs, which is 1e-14 of the condition at most
    step = min(1e-6, max(1e-12, 1e-4 / guess))
    factors = scale * np.array([1.0 + step, 1.0 - step])
    # Near what they come to, so that no neighbours are run
    near = np.array([dd.simulate(wall, record, factor, history=False).edp for factor in factors])
    _, edp, *_, failure = _core.histories.certify(
        upload_walls((wall,)).number, upload((record,)).number, np.ones(2, np.int32), factors, near, 1.0, 1
    )
    check(failure)
    return abs(edp[0] - edp[1]) / abs(np.log(factors[0] / factors[1]))


def check_condition(wall, record, scale, engine):
    """Returns the condition in 33 digits."""
    solver = dd.Solver(engine=engine)

    def run(factor, **more):
        return dd.simulate(wall, record, factor, history=False, solver=solver, **more)

    one = run(scale, estimate_error=True)
    assert not one.collapsed
    stronger, weaker = (run(scale * (1.0 + change)).edp for change in (CHANGE, -CHANGE))
    shifts = abs(stronger - one.edp), abs(one.edp - weaker)
    told = max(shifts) / CHANGE
    exact = exact_condition(wall, record, scale, told)
    # Rounding of the runs. In hard histories 512 eps is no small change any more: the size is what counts there.
    assert told == pytest.approx(exact, rel=0.1 if exact < 1e6 else 0.5, abs=8.0 * EPS / CHANGE), (wall, record, scale)
    assert one.edp_error >= 0.9 * ROUNDING * (exact - 8.0 * EPS / CHANGE)
    return exact


@pytest.mark.parametrize("engine", ["lanes", "rk45"])
def test_ordinary_histories(few, engine):
    found = []
    for wall in (dd.OneSidedWall(3.0, 0.25), dd.TwoBlockWall(3.0, 0.25, hinge=0.6), dd.FreeStandingWall(2.0, 0.5)):
        for record in (few[1], few[7]):
            scale = 1.6 * wall.trigger_acceleration / record.peak_acceleration
            found.append(check_condition(wall, record, scale, engine))
    assert max(found) < 1e3


@pytest.mark.slow
@pytest.mark.parametrize("row", [7, 13])
def test_hard_histories(records, row):
    """Of the table of hard histories two in which 512 eps is a small change still: the condition is some 1e9."""
    named = {record.name: record for record in records}
    with open(ROOT / "test/reference/hard_synthetic.csv", newline="", encoding="utf-8") as file:
        said = list(csv.DictReader(line for line in file if not line.startswith("#")))[row]
    numbers = {what: float(said[what]) for what in ("height", "thickness", "hinge") if said[what]}
    how = "restitution_value" if said["restitution_value"] else "restitution_factor"
    numbers[how] = float(said[how])
    wall = WALLS[said["mechanism"]](**numbers, restitution=said["restitution"])
    assert check_condition(wall, named[said["record"]], float(said["scale"]), "lanes") > 1e8
