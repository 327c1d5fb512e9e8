"""Elastic response spectra."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from dondolo._base.arguments import FloatArray
from dondolo._storage import tables
from dondolo._storage.saved import Saved

if TYPE_CHECKING:
    from matplotlib.axes import Axes


@dataclass(frozen=True, eq=False, repr=False, kw_only=True)
class Spectrum(tables.Tabular, Saved):
    """Elastic response spectrum of a record.

    Attributes
    ----------
    periods : ndarray, shape (periods,)
        [s]
    damping : float
        Damping ratio.
    displacement : ndarray, shape (periods,)
        Spectral displacement: the largest displacement relative to the ground [m].
    """

    periods: FloatArray
    damping: float
    displacement: FloatArray

    @property
    def pseudo_velocity(self) -> FloatArray:
        """Pseudo-spectral velocity, 2 pi / T times the displacement [m/s]."""
        return 2.0 * np.pi / self.periods * self.displacement

    @property
    def pseudo_acceleration(self) -> FloatArray:
        """Pseudo-spectral acceleration, (2 pi / T)**2 times the displacement [m/s2]."""
        return (2.0 * np.pi / self.periods) ** 2 * self.displacement

    def plot(self, ax: Axes | None = None, **options: Any) -> Axes:
        """Draw the pseudo-acceleration against the period.

        Parameters
        ----------
        ax : Axes, optional
            Where to draw; a new figure if left out.
        **options
            Parts to leave out by False (`legend`, `title`), and keywords of Matplotlib for the line: see
            docs/printing.md.

        Returns
        -------
        Axes
            Pseudo-spectral acceleration [m/s2] against period [s].
        """
        from dondolo.records.plots import draw_spectrum

        return draw_spectrum(self, ax, options)

    def _table(self) -> tables.Table:
        return {
            "period [s]": self.periods,
            "displacement [m]": self.displacement,
            "pseudo_velocity [m/s]": self.pseudo_velocity,
            "pseudo_acceleration [m/s2]": self.pseudo_acceleration,
        }

    def __repr__(self) -> str:
        low, high = self.periods.min(), self.periods.max()
        return f"<Spectrum: {len(self.periods)} periods, {low:g} to {high:g} s, damping {self.damping:g}>"

    def _facts(self) -> list[tuple[str, str]]:
        at = int(np.argmax(self.pseudo_acceleration))
        return [
            ("periods", f"{len(self.periods)}, {self.periods.min():g} to {self.periods.max():g} s"),
            ("damping", f"{self.damping:g}"),
            ("largest pseudo-acceleration", f"{self.pseudo_acceleration[at]:.4g} m/s2 at {self.periods[at]:g} s"),
            ("largest displacement", f"{self.displacement.max():.4g} m"),
        ]
