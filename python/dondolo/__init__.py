"""dondolo: fragility of masonry walls that rock and overturn in earthquakes.

>>> import dondolo as dd
>>> wall = dd.OneSidedWall(height=1.5, thickness=0.25)
>>> records = dd.synthetic_records(magnitude=6.5, distance=10.0, site="shallow", count=10)
>>> stripes = dd.multiple_stripe(wall, records, levels=[0.6, 0.8, 1.0], progress=False)
>>> curve = stripes.fit()
>>> curve.status
'ok'

`dondolo.read_catalogue` reads recorded accelerograms.
"""

from dondolo._binding import build_variant
from dondolo._binding import constants as _constants
from dondolo.bootstrap import Bootstrap
from dondolo.cases import Case, Results, read_case, run_case
from dondolo.cloud import Cloud, cloud
from dondolo.comparison import Comparison, compare
from dondolo.distributions import Choice, Lognormal, Normal, Triangular, Uniform
from dondolo.drawing import animate_history, plot_wall
from dondolo.efficiency import IntensityComparison, compare_intensities
from dondolo.errors import DondoloError, DondoloWarning, InputError, Interrupted, MissingFileError
from dondolo.fragility import Fragility, fit_fragility
from dondolo.hazard import HazardCurve
from dondolo.incremental import FirstCollapseFragility, Incremental, incremental
from dondolo.intensity import Spectrum, intensity_table, response_spectrum
from dondolo.mean_functions import nrml_functions
from dondolo.motion import Response, simulate
from dondolo.nrml import DiscreteFragility, write_nrml
from dondolo.overturning import Boundary, OverturningSpectrum, State, Window, overturning_spectrum
from dondolo.plots import (
    plot_fragility,
    plot_history,
    plot_intensities,
    plot_overturning_spectrum,
    plot_stripes,
)
from dondolo.plots_population import plot_population
from dondolo.plots_typology import plot_combination, plot_damage_states, plot_groups, plot_typology
from dondolo.population import Population, read_population
from dondolo.processing import RotD, band_pass, correct_baseline, resample, reverse, rotate, rotd, trim
from dondolo.pulses import mavroeidis_papageorgiou, one_cosine, one_sine, ricker
from dondolo.records import Record, read_catalogue, read_record, read_records
from dondolo.regression import Logistic, Regression
from dondolo.report import report
from dondolo.results import StoredResults, read_results
from dondolo.risk import Risk, mean_annual_frequency
from dondolo.risk_plots import plot_cloud, plot_incremental, plot_risk
from dondolo.sampling import sample_population
from dondolo.stripes import Stripes, multiple_stripe
from dondolo.study import typology
from dondolo.synthetic import synthetic_records
from dondolo.typology import Group, Typology
from dondolo.typology_bootstrap import TypologyBootstrap
from dondolo.walls import FreeStandingWall, OneSidedWall, Terms, TwoBlockWall, Wall
from dondolo.work import Work

__version__ = _constants().version

__all__ = [
    "Bootstrap",
    "Boundary",
    "Case",
    "Choice",
    "Cloud",
    "Comparison",
    "DiscreteFragility",
    "DondoloError",
    "DondoloWarning",
    "FirstCollapseFragility",
    "Fragility",
    "FreeStandingWall",
    "Group",
    "HazardCurve",
    "Incremental",
    "InputError",
    "IntensityComparison",
    "Interrupted",
    "Logistic",
    "Lognormal",
    "MissingFileError",
    "Normal",
    "OneSidedWall",
    "OverturningSpectrum",
    "Population",
    "Record",
    "Regression",
    "Response",
    "Results",
    "Risk",
    "RotD",
    "Spectrum",
    "State",
    "StoredResults",
    "Stripes",
    "Terms",
    "Triangular",
    "TwoBlockWall",
    "Typology",
    "TypologyBootstrap",
    "Uniform",
    "Wall",
    "Window",
    "Work",
    "__version__",
    "animate_history",
    "band_pass",
    "build_variant",
    "cloud",
    "compare",
    "compare_intensities",
    "correct_baseline",
    "fit_fragility",
    "incremental",
    "intensity_table",
    "mavroeidis_papageorgiou",
    "mean_annual_frequency",
    "multiple_stripe",
    "nrml_functions",
    "one_cosine",
    "one_sine",
    "overturning_spectrum",
    "plot_cloud",
    "plot_combination",
    "plot_damage_states",
    "plot_fragility",
    "plot_groups",
    "plot_history",
    "plot_incremental",
    "plot_intensities",
    "plot_overturning_spectrum",
    "plot_population",
    "plot_risk",
    "plot_stripes",
    "plot_typology",
    "plot_wall",
    "read_case",
    "read_catalogue",
    "read_population",
    "read_record",
    "read_records",
    "read_results",
    "report",
    "resample",
    "response_spectrum",
    "reverse",
    "ricker",
    "rotate",
    "rotd",
    "run_case",
    "sample_population",
    "simulate",
    "synthetic_records",
    "trim",
    "typology",
    "write_nrml",
]
