"""dondolo: fragility of masonry walls that rock and overturn in earthquakes.

>>> import dondolo as dd
>>> wall = dd.OneSidedWall(height=3.0, thickness=0.25)
>>> records = dd.read_catalogue("records.csv")                         # doctest: +SKIP
>>> stripes = dd.multiple_stripe(wall, records, levels=[0.1, 0.2, 0.3])  # doctest: +SKIP
>>> curve = stripes.fit()                                               # doctest: +SKIP
"""

from dondolo._binding import constants as _constants
from dondolo.cases import Case, Results, read_case, run_case
from dondolo.comparison import Comparison, compare
from dondolo.drawing import animate_history, plot_wall
from dondolo.efficiency import IntensityComparison, compare_intensities
from dondolo.errors import DondoloError, DondoloWarning, InputError, Interrupted
from dondolo.fragility import Bootstrap, Fragility, fit_fragility
from dondolo.intensity import Spectrum, intensity_table, response_spectrum
from dondolo.motion import Response, simulate
from dondolo.plots import plot_fragility, plot_history, plot_intensities, plot_stripes, plot_typology
from dondolo.records import Record, read_catalogue, read_record, read_records
from dondolo.results import StoredResults, read_results
from dondolo.stripes import Stripes, multiple_stripe
from dondolo.typology import Group, Typology, typology
from dondolo.walls import FreeStandingWall, OneSidedWall, Population, Terms, TwoBlockWall, Wall, read_population

__version__ = _constants().version

__all__ = [
    "Bootstrap",
    "Case",
    "Comparison",
    "DondoloError",
    "DondoloWarning",
    "Fragility",
    "FreeStandingWall",
    "Group",
    "InputError",
    "IntensityComparison",
    "Interrupted",
    "OneSidedWall",
    "Population",
    "Record",
    "Response",
    "Results",
    "Spectrum",
    "StoredResults",
    "Stripes",
    "Terms",
    "TwoBlockWall",
    "Typology",
    "Wall",
    "__version__",
    "animate_history",
    "compare",
    "compare_intensities",
    "fit_fragility",
    "intensity_table",
    "multiple_stripe",
    "plot_fragility",
    "plot_history",
    "plot_intensities",
    "plot_stripes",
    "plot_typology",
    "plot_wall",
    "read_case",
    "read_catalogue",
    "read_population",
    "read_record",
    "read_records",
    "read_results",
    "response_spectrum",
    "run_case",
    "simulate",
    "typology",
]
