"""The mean of the curves of many walls, and the fractiles about it."""

from __future__ import annotations

from abc import abstractmethod
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from dondolo._base.arguments import FloatArray, argument_error, as_levels, shaped
from dondolo.curves.curve import Curve, inverse
from dondolo.curves.discrete import DiscreteFragility
from dondolo.curves.fragility import Fragility
from dondolo.curves.members import Members
from dondolo.curves.straight_lines import straight_lines

# Where the inverse is sought beyond medians and levels
_FAR = 1e3


class MeanCurve(Curve):
    """Weighted mean of the curves of walls; a subclass says which walls, and of which measure.

    Attributes
    ----------
    im : str
        Intensity measure.
    upper_asymptote : float
        What the mean tends to.
    fit : Fragility
        The lognormal fitted to the mean.
    """

    im: str
    upper_asymptote: float
    fit: Fragility

    @property
    @abstractmethod
    def knows_records(self) -> bool:
        """Whether it is known which record makes which wall collapse."""

    @property
    @abstractmethod
    def members(self) -> Members:
        """The walls behind the curve."""

    def _fitted(self) -> Fragility:
        return self.fit

    def _as_function(self) -> DiscreteFragility:
        levels, p = straight_lines(lambda x: np.asarray(self(x))[None], self.members.levels)
        return DiscreteFragility(levels, np.maximum.accumulate(p[0]), im=self.im)

    @property
    def _end(self) -> float:
        return self.upper_asymptote

    @property
    def reach(self) -> tuple[float, float]:
        """Intensities beyond which no fitted wall matters under a hazard that falls with the fourth power at most."""
        theta, beta = self.members.theta, self.members.beta
        if not len(theta) or np.isnan(theta).any():
            return 0.0, np.inf
        return float((theta * np.exp(-(4.0 * beta + 8.0) * beta)).min()), float((theta * np.exp(8.0 * beta)).max())

    @abstractmethod
    def changes(self, x: FloatArray, weights: FloatArray) -> dict[str, FloatArray]:
        """Changes of sum(weights * curve(x)) if each cluster of records, or each wall, is left out, by their kind."""

    @abstractmethod
    def _at(self, x: FloatArray, q: FloatArray, members: bool = False) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Mean (x,), fractiles (q, x) and, where they are wanted, probabilities (members, x) at some levels."""

    def probabilities(self, x: ArrayLike) -> FloatArray:
        """Probability that each wall collapses by any of its mechanisms; of one mechanism, if it can occur.

        Parameters
        ----------
        x : array_like
            Levels of intensity, not negative. Between the levels of the analysis, the fractions of a wall without a fit
            are interpolated linearly in x, from 0 at x = 0; above the highest level they stay.

        Returns
        -------
        ndarray, shape (walls,) and that of x
            Walls of no weight left out.

        Raises
        ------
        InputError
            A level that is negative or not a number.
        """
        values = as_levels(x)
        _, _, probabilities = self._at(values.ravel(), np.zeros(0), members=True)
        return probabilities.reshape((len(probabilities), *values.shape))

    def __call__(self, x: ArrayLike) -> Any:
        """Weighted mean of the walls' curves at any levels.

        Parameters
        ----------
        x : array_like
            Levels of intensity, as for `probabilities`.

        Returns
        -------
        float or ndarray, shape of x

        Raises
        ------
        InputError
            As `probabilities`.
        """
        values = as_levels(x)
        mean, _, _ = self._at(values.ravel(), np.zeros(0))
        return shaped(mean, values)

    def ppf(self, p: ArrayLike) -> Any:
        """Lowest levels at which the mean comes to p: the inverse of the curve.

        Parameters
        ----------
        p : array_like
            Probabilities, 0 to 1.

        Returns
        -------
        float or ndarray, shape of p
            Infinite where the mean does not come to p, as beyond `upper_asymptote`.

        Raises
        ------
        InputError
            A probability that is not between 0 and 1.
        """
        known = self.members.theta[~np.isnan(self.members.theta)]
        places = np.concatenate([known, self.members.levels])
        return inverse(self, p, (float(places.min()) / _FAR, float(places.max()) * _FAR))

    def fractiles(self, x: ArrayLike, q: ArrayLike = (0.16, 0.5, 0.84)) -> FloatArray:
        """Fractiles of the walls' curves at any levels: what a share of the weight does not exceed.

        Parameters
        ----------
        x : array_like
            Levels of intensity, as for `probabilities`.
        q : array_like
            Shares of the weight, above 0 and up to 1.

        Returns
        -------
        ndarray, shape of q and that of x
            At each level the smallest probability such that the walls up to it have at least the share.

        Raises
        ------
        InputError
            As `probabilities`, or a share beyond 0 and 1.
        """
        values = as_levels(x)
        try:
            shares = np.asarray(q, dtype=np.float64)
        except (TypeError, ValueError):
            shares = np.array(np.nan)
        if not np.all((shares > 0.0) & (shares <= 1.0)):
            raise argument_error("out_of_range", "q", ": must be shares of the weight, above 0 and up to 1")
        _, found, _ = self._at(values.ravel(), shares.ravel())
        return found.reshape(shares.shape + values.shape)
