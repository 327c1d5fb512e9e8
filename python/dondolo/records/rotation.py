"""Two horizontal components of a motion, and the directions in their plane."""

from __future__ import annotations

import re
from typing import NamedTuple

import numpy as np

from dondolo._base.arguments import FloatArray
from dondolo.errors import InputError
from dondolo.records.processing import SAME_STEP
from dondolo.records.suite import Motion, check_motions

# How the formats write a component that is vertical, also after a station: UP, U-D, UD1, ICC-UP, HNZ (SEED)
_VERTICAL = re.compile(r"(.*[-_ .])?[-+]?(U|D|UP|DN|DWN|DOWN|UD\d?|DU|Z|V|VRT|VER\w*|[A-Z][HLGMN]Z)", re.IGNORECASE)


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


def component(first: Motion, second: Motion, angle: float) -> FloatArray:
    """Samples of two components in a direction [degrees]; quarters of a circle are exact."""
    turn = np.radians(angle % 360.0)
    cosine, sine = (np.cos(turn), np.sin(turn)) if angle % 90.0 else np.round((np.cos(turn), np.sin(turn)))
    values: FloatArray = cosine * first.acceleration + sine * second.acceleration
    return values


def check_components(first: Motion, second: Motion) -> None:
    """Check that two records can be components of one motion."""
    if len(first) != len(second):
        raise InputError(
            f"components '{first.name}' and '{second.name}': {len(first)} and {len(second)} samples: must be as many"
        )
    if abs(first.dt - second.dt) > SAME_STEP * first.dt:
        raise InputError(
            f"components '{first.name}' and '{second.name}': dt = {first.dt:g} and {second.dt:g} s: must be the same"
        )
    pairs = {
        "station": (first.metadata.get("station", ""), second.metadata.get("station", "")),
        "date": (first._labels.date, second._labels.date),
    }
    for key, (one, other) in pairs.items():
        if one and other and one != other:
            raise InputError(
                f"components '{first.name}' and '{second.name}': {key} = '{one}' and '{other}': must be the same"
            )
    check_motions((first,))
    check_motions((second,))
    for record in (first, second):
        component = record.metadata.get("component", "").strip()
        if _VERTICAL.fullmatch(component):
            raise InputError(f"record '{record.name}': component = '{component}': is vertical, must be horizontal")
