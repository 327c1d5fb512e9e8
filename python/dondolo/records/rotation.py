"""Two horizontal components of a motion, and the directions in their plane."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from dondolo._base.arguments import FloatArray, argument_error, as_count, as_number
from dondolo._fortran.library import within_name
from dondolo._fortran.records import describe_measure
from dondolo.errors import InputError
from dondolo.records.processing import SAME_STEP
from dondolo.records.suite import check_components, check_motions, component_of

if TYPE_CHECKING:
    from dondolo.records.record import Record


class RotD(NamedTuple):
    """A measure of two horizontal components, over all directions in their plane (Boore 2010).

    Attributes
    ----------
    rotd50, rotd100 : float
        Median and largest value of the measure over the directions.
    angle : float
        Direction of the largest value, from the first component towards the second [degrees].
    angles : ndarray
        Directions, 0 included and 180 excluded, since the opposite direction is the same [degrees].
    values : ndarray
        The measure in each direction.
    """

    rotd50: float
    rotd100: float
    angle: float
    angles: FloatArray
    values: FloatArray

    def __repr__(self) -> str:
        numbers = f"rotd50={self.rotd50:.6g}, rotd100={self.rotd100:.6g}, angle={self.angle:g}"
        return f"<RotD: {numbers}, {len(self.values)} directions>"


def rotated(first: Record, second: Record, angle: float) -> dict[str, Any]:
    """Arguments of the record of two components in a direction: see `Record.rotate`."""
    _check_components(first, second)
    direction = as_number("angle", angle)
    if not np.isfinite(direction):
        raise argument_error("not_a_number", "angle", f" = {direction}: must be a number")
    steps = first.processing
    if steps != second.processing:
        steps = tuple(f"{part.name}: {step}" for part in (first, second) for step in part.processing)
    shared = first.metadata.items() & second.metadata.items()
    vertical = first.vertical
    if vertical is None or second.vertical is None or not np.array_equal(vertical, second.vertical):
        vertical = None
    towards = f"component at {direction:g} degrees from '{first.name}' towards '{second.name}'"
    return {
        "acceleration": _component(first, second, direction),
        "dt": first.dt,
        "name": within_name(f"{first.name} at {direction:g} degrees"),
        "processing": tuple(map(within_name, (*steps, towards))),
        "metadata": {key: value for key, value in first.metadata.items() if (key, value) in shared},
        "vertical": vertical,
    }


def over_directions(first: Record, second: Record, measure: str | Callable[[Record], float], n_angles: int) -> RotD:
    """A measure of two components over all directions: see `Record.rotd`."""
    _check_components(first, second)
    count = as_count("n_angles", n_angles, 1, 36000)
    if isinstance(measure, str):
        im = describe_measure(measure, of_record=True).name
    elif not callable(measure):
        raise argument_error(
            "wrong_type", "measure", f" = {measure!r}: must be the name of a measure or a function of a record"
        )
    directions = 180.0 * np.arange(count) / count
    values = np.empty(count)
    for i, direction in enumerate(directions):
        record = first.rotate(second, direction)
        values[i] = as_number("measure", record.intensity(im) if isinstance(measure, str) else measure(record))
    if np.isnan(values).any():
        raise argument_error("not_a_number", "measure", ": must be a number in every direction")
    largest = int(values.argmax())
    return RotD(float(np.median(values)), float(values[largest]), float(directions[largest]), directions, values)


def _component(first: Record, second: Record, angle: float) -> FloatArray:
    """Samples of two components in a direction [degrees]; quarters of a circle are exact."""
    turn = np.radians(angle % 360.0)
    cosine, sine = (np.cos(turn), np.sin(turn)) if angle % 90.0 else np.round((np.cos(turn), np.sin(turn)))
    values: FloatArray = cosine * first.acceleration + sine * second.acceleration
    return values


def _check_components(first: Record, second: Record) -> None:
    """Check that two records can be components of one motion."""
    if len(first) != len(second):
        raise InputError(
            f"components '{first.name}' and '{second.name}': {len(first)} and {len(second)} samples: must be as many"
        )
    if abs(first.dt - second.dt) > SAME_STEP * first.dt:
        raise InputError(
            f"components '{first.name}' and '{second.name}': dt = {first.dt:g} and {second.dt:g} s: must be the same"
        )
    check_components(first, second)
    check_motions((first,))
    check_motions((second,))
    for record in (first, second):
        found = component_of(record.metadata, record.name)
        if found.is_vertical:
            raise InputError(f"record '{record.name}': {found.key} = '{found.text}': is vertical, must be horizontal")
