"""The curves of a population out of the counts or the flags of its rows: numbers of Fortran as objects."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any

import numpy as np

from dondolo._base.arguments import FloatArray
from dondolo._fortran.curves import FittedCurve, fitted_curves
from dondolo._fortran.library import Parcel, as_text, unpack_warnings
from dondolo._fortran.populations import fit_population
from dondolo.analysis.work import Work
from dondolo.curves.clusters import Clusters, errors_of_table, no_errors
from dondolo.curves.fitting import curve_of, with_errors
from dondolo.curves.fragility import Fragility
from dondolo.errors import Interrupted
from dondolo.populations.curve import Group, IntArray, flat_population
from dondolo.populations.flags import Flags
from dondolo.populations.typology import Typology
from dondolo.walls.population import Population
from dondolo.walls.wall import properties_of

# What Fortran says of a curve of the population
_OF_GROUP = ("group", "mechanism", "n_walls", "weight", "beta_walls", "beta_records", "fitted", "upper_asymptote")


def combine(
    people: Population,
    im: str,
    levels: FloatArray,
    edp_thresholds: FloatArray,
    exceedances: IntArray,
    histories: IntArray,
    complete: np.ndarray[Any, Any],
    work: Work,
    flags: Flags | None = None,
) -> Typology:
    """The curves of the walls whose rows are all complete.

    Exceedances are (thresholds, levels, rows), flags those of the rows that are complete; thresholds increase, and the
    last is that of collapse.
    """
    first = people.first_rows
    rows = np.diff(np.append(first, len(people.walls)))
    whole = np.repeat(np.logical_and.reduceat(complete, first), rows)
    chosen = np.flatnonzero(whole)
    if len(chosen) == 0:
        raise Interrupted("interrupted: no wall is complete")
    if len(chosen) < len(people.walls):
        if not people.weights[chosen].any():
            raise Interrupted("interrupted: no wall of any weight is complete")
        people = people._chosen(chosen.tolist())
    counts = np.ascontiguousarray(exceedances[:, :, chosen], dtype=np.int32)
    sizes = np.ascontiguousarray(histories[:, chosen], dtype=np.int32)
    own = None if flags is None else flags.chosen(np.flatnonzero(whole[complete]))
    return combine_rows(people, im, levels, edp_thresholds, counts, sizes, work, own)


def combine_rows(
    people: Population,
    im: str,
    levels: FloatArray,
    edp_thresholds: FloatArray,
    exceedances: IntArray,
    histories: IntArray,
    work: Work,
    flags: Flags | None = None,
    are_alternatives: bool = False,
) -> Typology:
    """The curves of the last state; without flags they have naive standard errors, and there are no unions."""
    names = b"".join(
        as_text("name", name) + b"\n"
        for both in zip(properties_of(people.walls, "name"), people.wholes, strict=True)
        for name in both
    )
    flat = flat_population(people, levels, exceedances[-1].T, histories)
    parcel = fit_population(names, flat, None if flags is None else flags._flat(), are_alternatives)
    made = _Made(parcel, flags, {"im": im, "edp_threshold": float(edp_thresholds[-1])}, levels)
    own = made.rows(people, exceedances[-1], histories)
    return Typology(
        population=people,
        im=im,
        levels=levels,
        edp_thresholds=np.asarray(edp_thresholds, dtype=np.float64),
        exceedances=exceedances,
        histories=histories,
        curves=own,
        combined=made.walls(people, own),
        groups=made.groups(),
        work=work,
        flags=flags,
        warnings=tuple(unpack_warnings(parcel["warnings"])),
        union_curves=None if flags is None else made.unions(people),
        group_union_curves=None if flags is None else made.means(),
        union_counts=None if flags is None else made.counts,
    )


class _Made:
    """Curves out of what Fortran has sent."""

    def __init__(self, parcel: Parcel, flags: Flags | None, origin: dict[str, Any], levels: FloatArray) -> None:
        self._parcel, self._origin, self._levels = parcel, origin, levels
        self._is_clustered = flags is not None
        self.counts: dict[str, FloatArray] = {}
        if flags is not None:
            # A cluster whose records run at no level does not count.
            self._ran = flags._members @ flags.runs.any(axis=1) > 0.0
            self._labels = tuple(label for label, ran in zip(flags.labels, self._ran, strict=True) if ran)

    def _curve(
        self,
        found: FittedCurve,
        collapses: FloatArray,
        histories: FloatArray,
        parts: tuple[Clusters, ...] = (),
        **more: Any,
    ) -> Fragility:
        """A curve with its standard errors."""
        curve = curve_of(found.data, self._levels, collapses, histories, **self._origin, **more)
        if not (self._is_clustered and curve.has_fit):
            return curve
        if found.errors != "clustered":
            return with_errors(curve, no_errors(found.errors, found.clusters))
        numbers = found.se_ln_theta, found.se_beta, found.cov_ln_theta_beta
        errors = errors_of_table(*numbers, found.clusters, found.degrees_of_freedom)
        return with_errors(curve, errors._replace(parts=parts))

    def _share(
        self, found: FittedCurve, fraction: FloatArray, histories: FloatArray, upper_asymptote: float, **more: Any
    ) -> Fragility:
        """A curve of the share of what can collapse."""
        share = np.minimum(fraction / upper_asymptote, 1.0) if upper_asymptote > 0.0 else fraction
        return self._curve(found, histories * share, histories, upper_asymptote=upper_asymptote, **more)

    def _parts(self, prefix: str) -> Iterator[tuple[Clusters, ...]]:
        """Clusters of the curves of a prefix: records and, if there are several, walls."""
        if not self._is_clustered:
            while True:
                yield ()
        number = self._parcel[prefix + "walls"]
        of_records = self._parcel[prefix + "record_change"].reshape(len(number), -1, 2)
        of_walls = np.split(self._parcel[prefix + "wall_change"], np.cumsum(number)[:-1])
        for records, walls in zip(of_records, of_walls, strict=True):
            several = [("records", self._labels, records[self._ran])]
            if len(walls) > 1:
                several.append(("walls", tuple(f"wall {i + 1}" for i in range(len(walls))), walls))
            yield tuple(_clusters(*one) for one in several)

    def rows(self, people: Population, collapses: IntArray, histories: IntArray) -> tuple[Fragility, ...]:
        """Curves of the rows; collapses and histories are (levels, rows)."""
        return tuple(
            self._curve(found, z, n, wall=wall)
            for found, z, n, wall in zip(
                fitted_curves(self._parcel, "row_"),
                collapses.T.astype(float),
                histories.T.astype(float),
                people.walls,
                strict=True,
            )
        )

    def walls(self, people: Population, rows: tuple[Fragility, ...]) -> dict[str, Fragility]:
        """Curves of the walls by their names: that of a row, or of several mechanisms."""
        found, parcel = fitted_curves(self._parcel, "wall_"), self._parcel
        columns = [parcel["wall_" + name] for name in ("fraction", "histories", "upper_asymptote")]
        return {
            people.wholes[first]: rows[first] if is_row else self._share(one, fraction, n, float(upper_asymptote))
            for first, is_row, one, fraction, n, upper_asymptote in zip(
                people.first_rows.tolist(), people._has_curve_of_row.tolist(), found, *columns, strict=True
            )
        }

    def groups(self) -> tuple[Group, ...]:
        """Curves of the population and of its groups."""
        together = []
        columns = [self._parcel[name] for name in _OF_GROUP]
        values = [dict(zip(_OF_GROUP, row, strict=True)) for row in zip(*map(list, columns), strict=True)]
        arrays = (self._parcel[name] for name in ("histories", "mean_fraction", "mean_curve", "level_fractiles"))
        fits = zip(values, fitted_curves(self._parcel, "fit_"), *arrays, self._parts("fit_"), strict=False)
        for given, found, n, fraction, mean_curve, fractiles, parts in fits:
            one = {name: value.item() if isinstance(value, np.generic) else value for name, value in given.items()}
            if not one["fitted"] > 0.0:
                one |= {"beta_walls": math.nan, "beta_records": math.nan}
            fit = self._share(found, fraction, n, one["upper_asymptote"], parts=parts)
            one |= {"mean_fraction": fraction, "mean_curve": mean_curve, "level_fractiles": fractiles}
            together.append(Group(**one, fit=fit))
        return tuple(together)

    def unions(self, people: Population) -> dict[str, Fragility]:
        """Curves of the walls with several mechanisms, counted in the same histories."""
        if not self._parcel["unions"]:
            return {}
        first = people.first_rows
        several = np.flatnonzero(np.diff(first, append=len(people)) > 1)
        columns = [self._parcel["union_" + name] for name in ("collapses", "histories", "change")]
        unions = {}
        for i, found, counts, n, change in zip(several, fitted_curves(self._parcel, "union_"), *columns, strict=True):
            upper_asymptote = float(self._parcel["wall_upper_asymptote"][i])
            self.counts[f"wall {people.wholes[first[i]]}"] = counts
            counts = np.minimum(counts / (upper_asymptote or 1.0), n)
            parts = (_clusters("records", self._labels, change[self._ran]),)
            unions[people.wholes[first[i]]] = self._curve(found, counts, n, parts, upper_asymptote=upper_asymptote)
        return unions

    def means(self) -> dict[str, Fragility]:
        """Means of unions over the population and its groups."""
        if not self._parcel["unions"] or not self._parcel["mean_group"]:
            return {}
        columns = [self._parcel["mean_" + name] for name in ("group", "union_fraction", "histories", "upper_asymptote")]
        self.counts |= {f"group {group}": fraction for group, fraction in zip(*columns[:2], strict=True)}
        found = zip(fitted_curves(self._parcel, "mean_"), *columns, self._parts("mean_"), strict=True)
        return {
            group: self._share(one, fraction, n, float(upper_asymptote), parts=parts)
            for one, group, fraction, n, upper_asymptote, parts in found
        }


def _clusters(kind: str, labels: tuple[str, ...], changes: FloatArray) -> Clusters:
    """Clusters whose changes nobody changes."""
    own = np.ascontiguousarray(changes)
    own.flags.writeable = False
    return Clusters(kind, labels, own)
