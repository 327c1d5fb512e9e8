"""What motions leave of the ties of a wall: all of it follows from the largest rotation."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from dondolo._base.arguments import FloatArray
from dondolo._fortran.walls import tie_states
from dondolo.walls.parts import parts_of
from dondolo.walls.wall import Wall, upload


class TieStates(NamedTuple):
    """What motions leave of ties, each an array whose last axis is that of the ties.

    Attributes
    ----------
    plastic_elongation : ndarray
        Elongation that stays [m]; of a broken tie that at which it broke.
    energy : ndarray
        Energy that it has dissipated, yield force times plastic elongation [J per metre of wall].
    broken : ndarray of bool
        Whether it is broken.
    """

    plastic_elongation: FloatArray
    energy: FloatArray
    broken: np.ndarray[Any, np.dtype[np.bool_]]


def number_of_ties(wall: Wall) -> int:
    """How many ties a wall has."""
    return len(parts_of(wall, "ties"))


def states_of_ties(wall: Wall, edp: ArrayLike) -> TieStates:
    """What motions leave of the ties of a wall.

    Parameters
    ----------
    wall : Wall
        The wall.
    edp : array_like
        Largest rotation / capacity of each motion.

    Returns
    -------
    TieStates
        Arrays of the shape of `edp` and one axis more, that of the ties, which is empty for a wall without any.
    """
    ties = number_of_ties(wall)
    if not ties:
        none = np.zeros((*np.shape(edp), 0))
        return TieStates(none, none, none == 1.0)
    return TieStates(*tie_states(upload((wall,)), edp, ties))
