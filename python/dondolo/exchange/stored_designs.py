"""Designs of a wall that stand in result files, each beside the first."""

from __future__ import annotations

import numpy as np

from dondolo._storage.columns import Columns
from dondolo._storage.run_file import RunFile
from dondolo.curves.comparison import Comparison
from dondolo.curves.fragility import Fragility
from dondolo.exchange.case_checks import checks_of_run, complete_checks
from dondolo.populations.typology import Typology
from dondolo.retrofit.designs import DesignComparison


def stored_designs(typology: Typology, table: Columns, run: RunFile) -> DesignComparison:
    """Designs compared, ``_designs.csv``: the ratios of the table, and the curves of the typology.

    Parameters
    ----------
    typology : Typology
        Of the same files.
    table : Columns
        A row for each design.
    run : RunFile
        Has the confidence of the intervals, and names the site, if there is one: checks are made again, to the same
        numbers.

    Returns
    -------
    DesignComparison

    Raises
    ------
    InputError
        The table does not fit the walls.
    """
    names = tuple(table.texts("design"))
    if names != tuple(wall.name for wall in typology.walls):
        raise ValueError("design: must be the walls of the population, in their order")
    first = typology.curves[0]
    return DesignComparison(
        names=names,
        stripes=(),
        curves=typology.curves,
        comparisons=tuple(_against(curve, first, table, row) for row, curve in enumerate(typology.curves)),
        steel=table.numbers("steel_kg_m"),
        alpha_0=table.numbers("alpha_0_g"),
        confidence=run.confidence,
        checks=complete_checks(checks_of_run(typology.walls, run)),
        typology=typology,
    )


def _against(curve: Fragility, first: Fragility, table: Columns, row: int) -> Comparison | None:
    """A design against the first: medians alone, since the curves of rows do not know their records."""
    if not table.given("ratio", row):
        return None
    ratio, low, high, p_value = (table.number(name, row) for name in ("ratio", "ratio_low", "ratio_high", "p_value"))
    return Comparison(
        pairing="paired",
        shared=curve.clusters,
        ratio=ratio,
        ratio_interval=(low, high),
        p_value=p_value,
        beta_ratio=curve.beta / first.beta,
        beta_interval=(np.nan, np.nan),
        beta_p_value=np.nan,
        curves_p_value=np.nan,
        degrees_of_freedom=min(curve.degrees_of_freedom, first.degrees_of_freedom),
    )
