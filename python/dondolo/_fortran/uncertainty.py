"""What the uncertainty of a model is made of, as Fortran finds it."""

from __future__ import annotations

import functools
from typing import NamedTuple

import numpy as np

from dondolo._base.arguments import FloatArray
from dondolo._fortran import _core
from dondolo._fortran.handles import Handle
from dondolo._fortran.library import check, receive
from dondolo.errors import DondoloError


class Sensitivity(NamedTuple):
    """Sobol indices of each quantity, first-order and total, with 95 % intervals (quantities, 2); and the rest."""

    first: FloatArray
    first_interval: FloatArray
    total: FloatArray
    total_interval: FloatArray
    rest: float


class PublishedFactor(NamedTuple):
    """A distribution of restitution_factor from tests: its kind, 'uniform' or 'normal', and its two parameters."""

    kind: str
    first: float
    second: float
    source: str


def sensitivity(values: FloatArray, outcome: FloatArray) -> Sensitivity:
    """Which of several independent quantities (samples, quantities) an outcome (samples,) owes its scatter to."""
    if len(outcome) == 0:
        raise DondoloError("no sample has a curve, so that its scatter cannot be apportioned")
    first, first_interval, total, total_interval, rest, failure = _core.uncertainty.sensitivity(
        np.asfortranarray(values), outcome
    )
    check(failure)
    return Sensitivity(first, first_interval.T.copy(), total, total_interval.T.copy(), float(rest))


def smallest_sample(quantities: int) -> int:
    """Fewest samples for the indices of some quantities."""
    return int(_core.uncertainty.smallest_sample(quantities))


@functools.cache
def published_factors() -> dict[str, PublishedFactor]:
    """Distributions of restitution_factor from tests, by their names."""
    parcel = receive(_core.uncertainty.published())
    numbers = parcel["first"].tolist(), parcel["second"].tolist()
    ranges = map(PublishedFactor, parcel["kind"], *numbers, parcel["source"])
    return dict(zip(parcel["name"], ranges, strict=True))


def check_factor(wall: Handle, name: str) -> None:
    """Refuse a published range that was not measured against the restitution of a wall."""
    failure = _core.uncertainty.check_factor(wall.number, name.encode())
    check(failure)


def factor_parameters(walls: Handle, name: str) -> list[float]:
    """Parameters of a published distribution for the variants of a wall: of a normal one also where it is cut off."""
    parameters: list[float] = receive(_core.uncertainty.factor_parameters(walls.number, name.encode()))[
        "parameters"
    ].tolist()
    return parameters


def restitution_sentence(wall: Handle) -> str:
    """What the restitution of a wall assumes beside tests; empty where there are none."""
    (line,) = receive(_core.uncertainty.restitution_sentence(wall.number)).lines
    return line
