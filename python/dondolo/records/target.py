"""Target spectra that records are selected for: a median with a dispersion, conditional on a spectral acceleration.

Given Sa(T*), the logarithms of the other ordinates of a ground motion model, mean mu and deviation sigma, are
normal with (Baker 2011; Jayaram, Lin and Baker 2011)::

    mean mu_i + rho(T_i, T*) eps sigma_i,  eps = (ln Sa(T*) - mu*)/sigma*
    covariance sigma_i sigma_j (rho(T_i, T_j) - rho(T_i, T*) rho(T_j, T*))

rho is that of Baker and Jayaram (2008), for 0.01 to 10 s.

References: Baker and Jayaram (2008), Correlation of spectral acceleration values from NGA ground motion models,
Earthquake Spectra 24(1):299-317; Baker (2011), Conditional mean spectrum: tool for ground-motion selection, Journal of
Structural Engineering 137(3):322-331; Jayaram, Lin and Baker (2011), A computationally efficient ground-motion
selection algorithm for matching a target response spectrum mean and variance, Earthquake Spectra 27(3):797-815.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

import numpy as np
from numpy.typing import ArrayLike

from dondolo._base.arguments import FloatArray, argument_error, as_array, as_number, increasing
from dondolo._base.shown import Shown
from dondolo._storage.saved import Saved

if TYPE_CHECKING:
    from dondolo.records.codes import Soil


@dataclass(frozen=True, eq=False, repr=False, init=False)
class TargetSpectrum(Shown, Saved):
    """A spectrum that records are selected and scaled to: a median, and a dispersion about it.

    Parameters
    ----------
    periods : array_like, shape (periods,)
        Positive and increasing [s].
    sa : array_like, shape (periods,)
        Median pseudo-spectral acceleration, exp of the mean of ln Sa [g].
    dispersion : float or array_like, shape (periods,), optional
        Standard deviation of ln Sa; 0 if left out: a spectrum that the mean of the records should meet.
    damping : float
        Damping ratio of the ordinates.

    Attributes
    ----------
    periods, sa : ndarray, shape (periods,)
    damping : float
    covariance : ndarray, shape (periods, periods)
        Of ln Sa; correlations are those of Baker and Jayaram (2008).
    anchor : float or None
        Period that the spectrum is conditional on [s].

    Raises
    ------
    InputError
        Periods that do not increase, ordinates that are not positive, negative dispersions, a damping beyond 0 to 1.

    Examples
    --------
    >>> import dondolo as dd
    >>> target = dd.TargetSpectrum([0.1, 0.5, 1.0], [0.5, 0.4, 0.2], dispersion=0.6).conditional(0.5, 0.8)
    >>> [round(float(x), 4) for x in target.sa]
    [0.6947, 0.8, 0.3361]
    """

    periods: FloatArray
    sa: FloatArray
    damping: float
    covariance: FloatArray
    anchor: float | None

    def __init__(
        self, periods: ArrayLike, sa: ArrayLike, *, dispersion: ArrayLike | None = None, damping: float = 0.05
    ) -> None:
        several, median = increasing("periods", periods), as_array("sa", sa).copy()
        if len(median) != len(several):
            raise argument_error(
                "wrong_length", "sa", f": {len(median)} ordinates for {len(several)} periods: must be as many"
            )
        if not np.all((median > 0.0) & (median < np.inf)):
            raise argument_error("out_of_range", "sa", ": must be positive")
        if dispersion is None or np.ndim(dispersion) == 0:
            given = 0.0 if dispersion is None else as_number("dispersion", dispersion)
            spread = np.full(len(several), given)
        else:
            spread = as_array("dispersion", dispersion)
        if spread.shape != several.shape or not np.all((spread >= 0.0) & (spread < np.inf)):
            raise argument_error(
                "wrong_length", "dispersion", ": must be one number, or one for each period, not negative"
            )
        if spread.any() and not 0.01 <= several[0] < several[-1] <= 10.0:
            raise argument_error(
                "out_of_range",
                "periods",
                ": must lie between 0.01 and 10 s for the correlations of a target with a dispersion",
            )
        covariance = correlation(several, several) * np.outer(spread, spread)
        ratio = as_number("damping", damping)
        if not 0.0 <= ratio < 1.0:
            raise argument_error("out_of_range", "damping", f" = {ratio:g}: must be at least 0 and below 1")
        self._set(several, median, ratio, covariance, None)

    def _set(
        self, periods: FloatArray, sa: FloatArray, damping: float, covariance: FloatArray, anchor: float | None
    ) -> None:
        for array in (sa, covariance):
            array.flags.writeable = False
        pairs = {"periods": periods, "sa": sa, "damping": damping, "covariance": covariance, "anchor": anchor}
        for what, value in pairs.items():
            object.__setattr__(self, what, value)

    @classmethod
    def ec8(
        cls,
        ag: float,
        *,
        soil: Soil = "A",
        kind: Literal[1, 2] = 1,
        damping: float = 0.05,
        periods: ArrayLike | None = None,
    ) -> TargetSpectrum:
        """Elastic horizontal spectrum of Eurocode 8, EN 1998-1:2004, with the values that it recommends.

        Parameters
        ----------
        ag : float
            Design acceleration on ground of type A, the importance factor included [g].
        soil : {'A', 'B', 'C', 'D', 'E'}
            Ground type.
        kind : {1, 2}
            Type of the spectrum: 2 where the earthquakes that contribute most have surface-wave magnitudes up to 5.5.
        damping : float
            Damping ratio.
        periods : array_like, optional
            [s]; 60 from 0.05 to 4 s if left out. The code's formulas are for periods up to 4 s.

        Returns
        -------
        TargetSpectrum
            Without a dispersion.

        Raises
        ------
        InputError
            Parameters that the code does not have.

        Examples
        --------
        >>> import dondolo as dd
        >>> dd.TargetSpectrum.ec8(0.25, soil="C", periods=[0.2, 0.6, 1.2]).sa.round(5).tolist()
        [0.71875, 0.71875, 0.35938]
        """
        from dondolo.records.codes import ec8_spectrum

        return ec8_spectrum(ag, soil=soil, kind=kind, damping=damping, periods=periods)

    @property
    def dispersion(self) -> FloatArray:
        """Standard deviation of ln Sa, shape (periods,)."""
        return np.asarray(np.sqrt(np.diag(self.covariance)))

    def conditional(self, period: float, sa: float) -> TargetSpectrum:
        """The conditional spectrum, given the ordinate at a period.

        Parameters
        ----------
        period : float
            Within the periods of the spectrum [s].
        sa : float
            Spectral acceleration there [g].

        Returns
        -------
        TargetSpectrum
            With the period among its own.

        Raises
        ------
        InputError
            A period beyond those of the spectrum, an ordinate that is not positive, a spectrum without dispersion.

        Notes
        -----
        Median and dispersion at the period are those of the straight lines of ln Sa and of the dispersion against ln T.
        """
        at, value = as_number("period", period), as_number("sa", sa)
        if not self.periods[0] <= at <= self.periods[-1]:
            raise argument_error(
                "out_of_range", "period", f" = {at:g}: must lie between {self.periods[0]:g} and {self.periods[-1]:g} s"
            )
        if not 0.0 < value < np.inf:
            raise argument_error("out_of_range", "sa", f" = {value:g}: must be positive")
        if not np.all(self.dispersion > 0.0) or self.anchor is not None:
            raise argument_error(
                "not_together",
                "target",
                ": must be a spectrum with a dispersion at all periods, not conditional itself",
            )
        periods = np.union1d(self.periods, at)
        x = np.log(periods)
        mean = np.interp(x, np.log(self.periods), np.log(self.sa))
        sigma = np.interp(x, np.log(self.periods), self.dispersion)
        here = int(np.searchsorted(periods, at))
        rho = correlation(periods, periods)
        known = rho[:, here]
        covariance = np.outer(sigma, sigma) * (rho - np.outer(known, known))
        # Nothing but rounding is left of what is known
        covariance[here], covariance[:, here] = 0.0, 0.0
        mean = mean + known * sigma * (np.log(value) - mean[here]) / sigma[here]
        periods.flags.writeable = False
        made = object.__new__(TargetSpectrum)
        made._set(periods, np.exp(mean), self.damping, covariance, float(at))
        return made

    def _facts(self) -> list[tuple[str, str]]:
        ends = f"{self.periods[0]:g} to {self.periods[-1]:g} s"
        facts = [("periods", f"{len(self.periods)}, {ends}"), ("largest ordinate", f"{self.sa.max():.4g} g")]
        if self.covariance.any():
            facts.append(("dispersion", f"up to {self.dispersion.max():.3g}"))
        if self.anchor is not None:
            facts.append(("conditional on", f"sa({self.anchor:g})"))
        return facts


def correlation(first: FloatArray, second: FloatArray) -> FloatArray:
    """Correlation of ln Sa at two sets of periods, (first, second): Baker and Jayaram (2008)."""
    low, high = np.minimum.outer(first, second), np.maximum.outer(first, second)
    c1 = 1.0 - np.cos(np.pi / 2.0 - 0.366 * np.log(high / np.maximum(low, 0.109)))
    with np.errstate(over="ignore", divide="ignore", invalid="ignore"):
        c2 = 1.0 - 0.105 * (1.0 - 1.0 / (1.0 + np.exp(100.0 * high - 5.0))) * (high - low) / (high - 0.0099)
    c2 = np.where(high < 0.2, c2, 0.0)
    c3 = np.where(high < 0.109, c2, c1)
    c4 = c1 + 0.5 * (np.sqrt(np.maximum(c3, 0.0)) - c3) * (1.0 + np.cos(np.pi * low / 0.109))
    cases = [high < 0.109, low > 0.109, high < 0.2]
    return np.asarray(np.select(cases, [c2, c1, np.minimum(c2, c4)], c4))
