"""How motions are integrated: what all analyses take as their one argument `solver`."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from dondolo._base.arguments import as_number, instance_of
from dondolo._fortran.histories import Settings, check_settings, settings
from dondolo._fortran.library import build_variant


@dataclass(frozen=True, kw_only=True)
class Solver:
    """Settings of the integration of motions.

    Parameters
    ----------
    rtol, atol : float, optional
        Tolerances of a step, in units of q_c and p q_c; 1e-8 and 1e-10 if left out.
    edp_limit : float, optional
        Rotation / capacity that counts as collapse; 1 if left out, and 5 for `overturning_spectrum`.
    engine : {'auto', 'lanes', 'rk45'}
        'lanes' integrates several histories at a time, 'rk45' one; 'auto' selects the one that suits the task.

    Raises
    ------
    InputError
        A value that is out of its range; the message is that of the executable.

    Examples
    --------
    >>> import dondolo as dd
    >>> dd.Solver(rtol=1e-10)
    Solver(rtol=1e-10, atol=None, edp_limit=None, engine='auto')
    """

    rtol: float | None = None
    atol: float | None = None
    edp_limit: float | None = None
    engine: Literal["auto", "lanes", "rk45"] = "auto"

    @staticmethod
    def variant() -> str:
        """The build variant that the engine lanes runs here.

        Returns
        -------
        str
            "baseline", "avx2" or "avx512", the best that the processor can run, or what the environment variable
            DONDOLO_VARIANT names; "native" in a build for one processor. Variants differ by rounding only.

        Raises
        ------
        InputError
            DONDOLO_VARIANT names none that this build and this processor have.

        Examples
        --------
        >>> import dondolo as dd
        >>> dd.Solver.variant() in ("baseline", "avx2", "avx512", "native")
        True
        """
        return build_variant()

    def __post_init__(self) -> None:
        values = {name: getattr(self, name) for name in ("rtol", "atol", "edp_limit")}
        given = {name: None if value is None else as_number(name, value) for name, value in values.items()}
        for name, value in given.items():
            object.__setattr__(self, name, value)
        check_settings(self.engine, self._settings())

    def _settings(
        self, estimate_error: bool = False, collapses_only: bool = False, edp_limit: float | None = None
    ) -> Settings:
        """Its numbers as Fortran takes them; edp_limit is the analysis's own, where none is given."""
        limit = edp_limit if self.edp_limit is None else self.edp_limit
        return settings(self.rtol, self.atol, limit, estimate_error, collapses_only)


_DEFAULT = Solver()


def as_solver(solver: Solver | None) -> Solver:
    """The solver of an analysis; the default where none is given."""
    if solver is None:
        return _DEFAULT
    instance_of("solver", solver, Solver)
    return solver
