"""Histories that are given up end every route with an error: millions of bounces from one sample to the next."""

import numpy as np
import pytest

import dondolo as dd

pytestmark = pytest.mark.slow

#: A restitution next to 1, and slow ground just beyond the trigger of 0.1 g, then still, then beyond it again: the last
#: push keeps the chain of bounces between from being closed
HEIGHT, THICKNESS, RESTITUTION, LEVEL = 1.5, 0.15, 0.9999999999, 0.1 * (1.0 + 4.5e-5)
SHAPE = [0.0, -1.0, 0.0, -1.0, 0.0]
ERROR = r"record '.*slow.*', scale factor .*: the time history does not get beyond the sample at \d+ s and was given up"


@pytest.fixture(scope="module")
def bouncing() -> dd.OneSidedWall:
    """A wall that hardly loses speed."""
    return dd.OneSidedWall(HEIGHT, THICKNESS, restitution_value=RESTITUTION, name="rubber")


@pytest.fixture(scope="module")
def slow() -> dd.Record:
    """Ten seconds from sample to sample."""
    return dd.Record(np.array(SHAPE), 10.0, "slow")


@pytest.mark.parametrize("engine", ["lanes", "rk45"])
def test_one_history(bouncing: dd.Wall, slow: dd.Record, engine: str) -> None:
    with pytest.raises(dd.errors.DondoloError, match=ERROR):
        dd.simulate(bouncing, slow, scale=LEVEL * 9.81, history=False, solver=dd.Solver(engine=engine))


def test_stripes(bouncing: dd.Wall, slow: dd.Record, sine: dd.Record) -> None:
    with pytest.raises(dd.errors.DondoloError, match=ERROR):
        dd.multiple_stripe(bouncing, [sine, slow], [LEVEL], progress=False)


def test_typology(bouncing: dd.Wall, slow: dd.Record, sine: dd.Record) -> None:
    """The error names the wall."""
    with pytest.raises(dd.errors.DondoloError, match="rubber.*" + ERROR):
        dd.typology([dd.OneSidedWall(2.0, 0.25, name="brick"), bouncing], [sine, slow], [LEVEL], progress=False)
