"""Incremental dynamic analysis: the histories of a multiple stripe analysis, record by record.

In incremental dynamic analysis (IDA, Vamvatsikos and Cornell 2002) a record is scaled up step by step, and its EDP is
drawn against the intensity. Multiple stripes hold all of that: every record at every level. They are read here along
the records instead of along the levels; nothing is run again.

First collapse
    IM_i, the lowest level at which history i collapses, is its capacity. A rocking wall may survive a level above that
    (a *resurrection*): impacts and the phase of the motion decide, not the intensity alone.
Fractiles
    The EDP of a share s of the histories at a level is the smallest value that at least the share s does not exceed,
    a collapse counting as infinite. The fractiles of the first collapse are the same of IM_i, a history without a
    collapse counting as infinite. Both are values of the data, without interpolation.
Fragility
    P(C | IM = x) is the share of histories with IM_i <= x. Its lognormal, where all n histories collapse, has the
    moments of the logarithms (Baker 2015)::

        ln theta = sum(ln IM_i) / n,    beta^2 = sum((ln IM_i - ln theta)^2) / (n - 1)

    Where the analysis ends at the level L with m histories standing, these are censored, and the likelihood

        product over collapses of phi(z_i)/beta,  times  (1 - Phi(z_L))^m,    z = (ln IM - ln theta)/beta

    is maximised (Baker 2015, truncated IDA). In (1/beta, ln theta/beta) its logarithm is concave (Olsen 1978, for the
    Tobit model of the same form), so the maximum is the only one.

The levels are a grid, and the curve depends on it. A wall that collapses at a level might have done so anywhere above
the level before: IM_i is too large by half a step on average. And where walls are resurrected, the closer the levels,
the sooner one of them is met that brings the wall down: IM_i falls on and on. A free-standing wall of 2 m by 0.5 m,
under 44 components recorded in Italy, has theta = 0.88, 0.84 and 0.78 g with steps of 0.1, 0.05 and 0.0125 g up to 3 g;
27, 32 and 40 of its 44 histories are resurrected. `Stripes.fit` has 0.94 g with all three: it uses the collapses of
each level, and counts a resurrection as the survival it is. For rocking walls it is the better estimate of P(C | IM);
this one answers when a record first brings the wall down on the way up. The lowest level should be below the first
collapse.

References: Vamvatsikos and Cornell (2002), Earthquake Engineering and Structural Dynamics 31, 491-514; Baker (2015),
Earthquake Spectra 31, 579-599; Olsen (1978), Econometrica 46, 1211-1215.
"""

from __future__ import annotations

import os
from dataclasses import dataclass
from typing import Any

import numpy as np

from dondolo import _binding, tables
from dondolo._arguments import FloatArray
from dondolo.errors import DondoloError, InputError
from dondolo.fragility import Fragility
from dondolo.stripes import Stripes

# Shares of the histories that fractiles are given for
SHARES = (0.16, 0.50, 0.84)


@dataclass(frozen=True, eq=False, repr=False)
class FirstCollapseFragility(Fragility):
    """A lognormal fitted to levels of first collapse.

    As `Fragility`, but its covariance is that of a sample of levels, and its collapses count each history at all levels
    from its first collapse on. It has no binomial likelihood: `log_likelihood` is NaN, and there are no intervals by
    the profile.
    """

    def _likelihood(self) -> Any:
        raise DondoloError("method = 'profile': is for curves fitted to stripes; this one is fitted to first collapses")

    def _facts(self) -> list[tuple[str, str]]:
        return [fact for fact in super()._facts() if fact[0] != "log likelihood"]


@dataclass(frozen=True, eq=False, repr=False)
class Incremental:
    """The histories of a multiple stripe analysis, record by record.

    Attributes
    ----------
    stripes : Stripes
        The analysis; `stripes.edp[:, i]` is the EDP curve of history i.
    first_collapse : ndarray, shape (histories,)
        The lowest level at which each history collapses; inf where none does.
    last_survival : ndarray, shape (histories,)
        The highest level that each history survives; 0 where there is none.
    edp_fractiles : ndarray, shape (3, levels)
        EDP that 16, 50 and 84 % of the histories do not exceed; inf where so many do not survive.
    level_fractiles : ndarray, shape (3,)
        Level by which 16, 50 and 84 % of the histories have collapsed once; inf where the levels end before.
    counted : ndarray of int, shape (levels,)
        Histories that have collapsed at the level or before.
    """

    stripes: Stripes
    first_collapse: FloatArray
    last_survival: FloatArray
    edp_fractiles: FloatArray
    level_fractiles: FloatArray
    counted: np.ndarray[Any, np.dtype[np.int64]]

    @property
    def levels(self) -> FloatArray:
        """The levels of intensity."""
        return self.stripes.levels

    @property
    def resurrected(self) -> np.ndarray[Any, np.dtype[np.bool_]]:
        """Which histories survive a level above their first collapse, shape (histories,)."""
        return self.last_survival > self.first_collapse

    @property
    def fraction(self) -> FloatArray:
        """Share of the histories that have collapsed at the level or before, shape (levels,)."""
        return self.counted / len(self.first_collapse)

    def fit(self) -> FirstCollapseFragility:
        """Fit a lognormal to the levels of first collapse.

        Returns
        -------
        FirstCollapseFragility
            By moments where all histories collapse, else by maximum likelihood. Its status is 'ok' or 'extrapolated'
            (theta above the levels); without a curve it is 'no_collapse', 'single_level', 'all_collapse' (all at the
            lowest level) or 'separated' (all at one level, or none before the highest).
        """
        levels, n = self.levels, len(self.first_collapse)
        collapsed = np.isfinite(self.first_collapse)
        x = np.log(self.first_collapse[collapsed])
        top = float(np.log(levels[-1]))
        theta = beta = np.nan
        covariance = np.full((2, 2), np.nan)
        if len(levels) == 1:
            status = "single_level"
        elif not len(x):
            status = "no_collapse"
        elif len(x) == n and x.max() == np.log(levels[0]):
            status = "all_collapse"
        elif (x == x[0]).all() and (len(x) == n or x[0] == top):
            status = "separated"
        else:
            if len(x) == n:
                mean, beta = float(x.mean()), float(x.std(ddof=1))
                covariance = beta**2 * np.diag([1.0 / n, 0.5 / (n - 1)])
            else:
                mean, beta, covariance = _censored(x, top, n - len(x))
            theta = float(np.exp(mean))
            status = "ok" if levels[0] <= theta <= levels[-1] else "extrapolated"
        half = self.fraction >= 0.5
        first = int(np.argmax(half)) if half.any() else len(levels)
        arrays = covariance, self.counted.astype(np.float64), np.full(len(levels), float(n))
        for array in arrays:
            array.flags.writeable = False
        return FirstCollapseFragility(
            theta,
            beta,
            arrays[0],
            status,
            np.nan,
            (float(levels[first - 1]) if first else 0.0, float(levels[first]) if half.any() else np.inf),
            levels,
            *arrays[1:],
            im=self.stripes.im,
            wall=self.stripes.wall,
        )

    def _tables(self) -> dict[str, Any]:
        stripes = self.stripes
        none = np.where(np.isfinite(self.edp_fractiles), self.edp_fractiles, np.nan)
        return {
            "records": lambda: {
                "wall": [stripes.wall.name] * len(self.first_collapse),
                "record": stripes.record_names,
                "polarity": ["reversed" if sign < 0 else "as_recorded" for sign in stripes.polarity],
                "im": [stripes.im] * len(self.first_collapse),
                "first_collapse": np.where(np.isfinite(self.first_collapse), self.first_collapse, np.nan),
                "last_survival": np.where(self.last_survival > 0.0, self.last_survival, np.nan),
                "resurrected": self.resurrected.astype(int),
            },
            "fractiles": lambda: {
                "im": [stripes.im] * len(self.levels),
                "im_level": self.levels,
                "edp_16": none[0],
                "edp_50": none[1],
                "edp_84": none[2],
                "histories": stripes.histories,
                "collapsed_once": self.counted,
                "fraction": self.fraction,
            },
        }

    def to_frame(self, table: str = "records") -> Any:
        """One of the tables 'records' and 'fractiles' as a pandas DataFrame; what is infinite is empty."""
        return tables.frame(tables.choose(self._tables(), table))

    def to_csv(self, path: str | os.PathLike[str], table: str = "records") -> None:
        """Write one of the tables 'records' and 'fractiles'; what is infinite is empty."""
        comments = [repr(self.stripes.wall), f"unit of the levels: {_binding.unit_of(self.stripes.im) or '1'}"]
        tables.write_csv(path, tables.choose(self._tables(), table), comments)

    def _facts(self) -> list[tuple[str, str]]:
        unit = f" {_binding.unit_of(self.stripes.im)}".rstrip()
        none = f"above {self.levels[-1]:g}"
        fractiles = (f"{level:g}" if np.isfinite(level) else none for level in self.level_fractiles)
        return [
            ("wall", self.stripes.wall.name),
            ("histories", f"{len(self.first_collapse)}, {self.counted[-1]} of them collapse"),
            ("first collapse of 16, 50, 84 %", ", ".join(fractiles) + unit),
            ("survive a higher level later", str(self.resurrected.sum())),
        ]

    def __repr__(self) -> str:
        return "<Incremental: " + "; ".join(f"{what} {text}" for what, text in self._facts()) + ">"

    def _repr_html_(self) -> str:
        return tables.html_of("Incremental", self._facts())


def incremental(stripes: Stripes) -> Incremental:
    """Read a multiple stripe analysis as an incremental dynamic analysis.

    Parameters
    ----------
    stripes : Stripes
        Result of `multiple_stripe`, of which each history (record and polarity) becomes a curve. Many levels, close to
        each other and up to the collapse of all histories, make a good one.

    Returns
    -------
    Incremental

    Notes
    -----
    Vamvatsikos and Cornell (2002). The docstring of the module dondolo.incremental has the formulas.
    """
    if not isinstance(stripes, Stripes):
        raise InputError(f"stripes: {type(stripes).__name__} are no stripes")
    levels, collapsed = stripes.levels, stripes.collapsed
    first = np.where(collapsed.any(axis=0), levels[np.argmax(collapsed, axis=0)], np.inf)
    last = np.where(collapsed.all(axis=0), 0.0, levels[len(levels) - 1 - np.argmin(collapsed[::-1], axis=0)])
    edp = np.where(collapsed, np.inf, stripes.edp)
    arrays = first, last, fractiles(edp), fractiles(first), (first[None, :] <= levels[:, None]).sum(axis=1)
    for array in arrays:
        array.flags.writeable = False
    return Incremental(stripes, *arrays)


def fractiles(values: FloatArray) -> FloatArray:
    """The smallest values along the last axis that 16, 50 and 84 % do not exceed, one row each."""
    return np.quantile(values, SHARES, axis=-1, method="inverted_cdf")


def _censored(x: FloatArray, top: float, standing: int) -> tuple[float, float, FloatArray]:
    """Mean and deviation of a normal sample of which some values are only known to lie above the top; covariance.

    In a = mean/deviation and c = 1/deviation the logarithm of the likelihood is concave:
    k ln c - sum((c x - a)^2)/2 + m ln Phi(a - c top), with k values and m above.
    """
    from scipy.optimize import minimize
    from scipy.special import log_ndtr

    k, shift = len(x), float(x.mean())
    y, end = x - shift, top - shift

    def slope_and_curvature(eta: float) -> tuple[float, float]:
        # Of ln Phi: the inverse Mills ratio r, and -r (eta + r)
        ratio = float(np.exp(-0.5 * eta**2 - 0.5 * np.log(2.0 * np.pi) - log_ndtr(eta)))
        return ratio, -ratio * (eta + ratio)

    def height(p: FloatArray) -> float:
        if p[1] <= 0.0:
            return np.inf
        return -k * np.log(p[1]) + 0.5 * np.sum((p[1] * y - p[0]) ** 2) - standing * float(log_ndtr(p[0] - p[1] * end))

    def gradient(p: FloatArray) -> FloatArray:
        off, (ratio, _) = p[1] * y - p[0], slope_and_curvature(p[0] - p[1] * end)
        return np.array([-off.sum() - standing * ratio, -k / p[1] + off @ y + standing * ratio * end])

    def hessian(p: FloatArray) -> FloatArray:
        bend = -standing * slope_and_curvature(p[0] - p[1] * end)[1]
        both = -y.sum() - bend * end
        return np.array([[k + bend, both], [both, k / p[1] ** 2 + y @ y + bend * end**2]])

    # From a deviation that no sample between its lowest value and the top exceeds by much
    start = np.array([0.0, 1.0 / max(end - y.min(), 1e-3)])
    found = minimize(height, start, jac=gradient, hess=hessian, method="trust-exact", options={"gtol": 1e-10 * k})
    a, c = found.x
    # (mean, deviation) = (a/c, 1/c)
    jacobian = np.array([[1.0 / c, -a / c**2], [0.0, -1.0 / c**2]])
    covariance = jacobian @ np.linalg.inv(hessian(found.x)) @ jacobian.T
    return float(a / c) + shift, float(1.0 / c), covariance
