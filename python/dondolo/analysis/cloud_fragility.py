"""The fragility curve of a cloud; `dondolo.analysis.cloud` has its equations."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from dondolo._base.arguments import as_levels, as_probabilities, shaped
from dondolo._base.shown import Shown
from dondolo._fortran.records import unit_of
from dondolo._storage.saved import Saved
from dondolo.analysis.cloud import Cloud
from dondolo.curves.curve import Curve
from dondolo.errors import DondoloError


@dataclass(frozen=True, eq=False, repr=False, kw_only=True)
class CloudFragility(Curve, Shown, Saved):
    """The fragility curve of a cloud, P(EDP > edp_threshold | IM) by total probability: `Cloud.fit`.

    Attributes
    ----------
    cloud : Cloud
        The points and the models that are fitted to them.
    edp_threshold : float
        Rotation / capacity.
    """

    cloud: Cloud
    edp_threshold: float

    @property
    def im(self) -> str:  # type: ignore[override]
        """Intensity measure."""
        return self.cloud.im

    @property
    def _equivalent(self) -> tuple[float, float]:
        return self.cloud._lognormal(self.edp_threshold)

    @property
    def theta(self) -> float:
        """Median of the equivalent lognormal, in the unit of the intensity.

        NaN where it is not defined: the line falls, or one of 16, 50 and 84 % lies in a gap of the data.
        """
        return self._equivalent[0]

    @property
    def beta(self) -> float:
        """Dispersion of the equivalent lognormal, half the distance of ln IM between 16 and 84 %; NaN as `theta`."""
        return self._equivalent[1]

    def __call__(self, x: ArrayLike) -> Any:
        """Probability of more than the threshold at intensities.

        Parameters
        ----------
        x : array_like
            Intensities, not negative.

        Returns
        -------
        float or ndarray, shape of x
            NaN where the data do not say: see `Logistic`.
        """
        values = as_levels(x)
        return shaped(self.cloud._curve(values.ravel(), self.edp_threshold), values)

    def ppf(self, p: ArrayLike) -> Any:
        """Intensities at which the probability is p: the inverse of the curve.

        Parameters
        ----------
        p : array_like
            Probabilities, 0 to 1.

        Returns
        -------
        float or ndarray, shape of p
            NaN where the data do not say.

        Raises
        ------
        InputError
            A probability that is not between 0 and 1.
        """
        values = as_probabilities("p", p)
        ends = {0.0: 0.0, 1.0: np.inf}
        found = [ends[one] if one in ends else self.cloud._crossing(one, self.edp_threshold) for one in values.flat]
        return shaped(np.array(found), values)

    @property
    def _drawn_to(self) -> float:
        # The strongest record
        return float(self.cloud.intensity.max())

    def _need_fit(self) -> None:
        for model, what in ((self.cloud.rocking, "rocking"), (self.cloud.collapse, "collapse")):
            if model.status in ("separated", "decreasing"):
                raise DondoloError(
                    f"the curve has a gap: the probability of {what} is '{model.status}' against {self.im}; another"
                    " measure may have none: Cloud.against"
                )

    def _facts(self) -> list[tuple[str, str]]:
        unit = unit_of(self.im)
        return [
            ("wall", self.cloud.wall.name),
            ("measure", self.im),
            ("EDP threshold", f"{self.edp_threshold:g}"),
            ("theta", f"{self.theta:.6g} {unit}".rstrip()),
            ("beta", f"{self.beta:.6g}"),
        ]
