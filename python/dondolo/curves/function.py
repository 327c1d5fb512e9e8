"""Any function as a fragility curve."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import KW_ONLY, dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from dondolo._base.arguments import argument_error, as_levels, shaped, wrong_type
from dondolo._base.shown import Shown
from dondolo._fortran.records import describe_measure
from dondolo.curves.curve import Curve, inverse

# Where the inverse is sought
_ENDS = (1e-9, 1e9)


@dataclass(frozen=True, eq=False, repr=False)
class FunctionFragility(Curve, Shown):
    """A fragility curve given by a function.

    Parameters
    ----------
    function : callable
        From intensities, a flat array, to as many probabilities, which do not fall with the intensity.
    im : str
        Intensity measure.

    Raises
    ------
    InputError
        The argument is not a function; an unknown measure.

    Notes
    -----
    The number of walls behind it is unknown: risks treat it as the curve of one wall. Neither it nor its risks can be
    saved.

    Examples
    --------
    >>> import numpy as np
    >>> import dondolo as dd
    >>> curve = dd.FunctionFragility(lambda x: 1.0 - np.exp(-x), im="pga")
    >>> round(float(curve.ppf(0.5)), 9)
    0.693147181
    """

    _hides_walls = True

    function: Callable[[Any], Any]
    _: KW_ONLY
    im: str = "pga"

    def __post_init__(self) -> None:
        if not callable(self.function):
            raise wrong_type("function", self.function, "a function")
        object.__setattr__(self, "im", describe_measure(self.im).name)

    def __call__(self, x: ArrayLike) -> Any:
        """Probabilities at levels.

        Parameters
        ----------
        x : array_like
            Levels of intensity, not negative.

        Returns
        -------
        float or ndarray, shape of x

        Raises
        ------
        InputError
            A level that is negative or not a number; the function gives no probabilities.
        """
        values = as_levels(x)
        flat = values.ravel()
        try:
            p = np.asarray(self.function(flat), dtype=np.float64)
        except (TypeError, ValueError):
            raise argument_error("wrong_type", "fragility", ": must give numbers for an array of intensities") from None
        if p.shape != flat.shape:
            raise argument_error(
                "wrong_length",
                "fragility",
                f": gives an array of shape {p.shape} for intensities of shape {flat.shape}",
            )
        if not np.all((p >= 0.0) & (p <= 1.0)):
            raise argument_error(
                "not_a_probability", "fragility", f" = {p[~((p >= 0.0) & (p <= 1.0))][0]:g}: must lie between 0 and 1"
            )
        return shaped(p, values)

    def ppf(self, p: ArrayLike) -> Any:
        """Lowest levels at which the probability is p, sought between 1e-9 and 1e9.

        Parameters
        ----------
        p : array_like
            Probabilities, 0 to 1.

        Returns
        -------
        float or ndarray, shape of p
            Infinite where the function does not come to p.

        Raises
        ------
        InputError
            A probability that is not between 0 and 1.
        """
        return inverse(self, p, _ENDS)

    def _facts(self) -> list[tuple[str, str]]:
        name = getattr(self.function, "__name__", type(self.function).__name__)
        return [("function", name), ("measure", self.im)]
