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

from dondolo._fortran.library import build_variant
from dondolo._fortran.library import constants as _constants
from dondolo._storage.saved import load
from dondolo.analysis.certificate import Certified, certify
from dondolo.analysis.cloud import Cloud, cloud
from dondolo.analysis.efficiency import IntensityComparison, compare_intensities
from dondolo.analysis.incremental import FirstCollapseFragility, Incremental, incremental
from dondolo.analysis.overturning import Boundary, OverturningSpectrum, State, Window, overturning_spectrum
from dondolo.analysis.response import Response, simulate
from dondolo.analysis.solver import Solver
from dondolo.analysis.stripe_runs import multiple_stripe
from dondolo.analysis.stripes import Stripes
from dondolo.analysis.work import Work
from dondolo.checks.ntc import CodeCheck, check_dynamic, check_ntc
from dondolo.curves.bootstrap import Bootstrap
from dondolo.curves.comparison import Comparison, compare
from dondolo.curves.fitting import fit_fragility
from dondolo.curves.fragility import Fragility
from dondolo.curves.regression import Logistic, Regression
from dondolo.errors import DondoloError, DondoloWarning, InputError, Interrupted, MissingFileError
from dondolo.exchange.cases import Case, Results, read_case, run_case
from dondolo.exchange.fragility_model import DiscreteFragility, FragilityModel, read_nrml
from dondolo.exchange.mean_functions import nrml_functions
from dondolo.exchange.nrml import write_nrml
from dondolo.exchange.results import StoredResults, read_results
from dondolo.exchange.workbook import write_workbook
from dondolo.populations.bootstrap import TypologyBootstrap
from dondolo.populations.curve import Group, PopulationCurve
from dondolo.populations.study import typology
from dondolo.populations.typology import Typology
from dondolo.populations.uncertain_wall import UncertainWall, uncertain_wall
from dondolo.populations.weakest_hinge import HingeSearch, weakest_hinge
from dondolo.records import pulses
from dondolo.records.building import Building
from dondolo.records.codes import Site, ec8_spectrum, ntc_spectrum
from dondolo.records.examples import example_records
from dondolo.records.intensity import intensity_table
from dondolo.records.reading import read_catalogue, read_record, read_records
from dondolo.records.record import Record
from dondolo.records.record_set import RecordSet
from dondolo.records.rotation import RotD
from dondolo.records.selection import Selection, select_records
from dondolo.records.spectrum import Spectrum
from dondolo.records.synthetic import synthetic_records
from dondolo.records.target import TargetSpectrum
from dondolo.reporting.page import report
from dondolo.retrofit.designs import DesignComparison, compare_designs
from dondolo.risk.frequency import Risk, mean_annual_frequency
from dondolo.risk.hazard import HazardCurve
from dondolo.risk.uncertainty import RiskUncertainty
from dondolo.walls.distributions import Choice, Lognormal, Normal, Triangular, Uniform
from dondolo.walls.facade import facade
from dondolo.walls.mechanisms import *  # noqa: F403
from dondolo.walls.mechanisms import __all__ as _walls
from dondolo.walls.population import Population, read_population
from dondolo.walls.sampling import sample_population

__version__ = _constants().version

__all__ = [
    "Bootstrap",
    "Boundary",
    "Building",
    "Case",
    "Certified",
    "Choice",
    "Cloud",
    "CodeCheck",
    "Comparison",
    "DesignComparison",
    "DiscreteFragility",
    "DondoloError",
    "DondoloWarning",
    "FirstCollapseFragility",
    "Fragility",
    "FragilityModel",
    "Group",
    "HazardCurve",
    "HingeSearch",
    "Incremental",
    "InputError",
    "IntensityComparison",
    "Interrupted",
    "Logistic",
    "Lognormal",
    "MissingFileError",
    "Normal",
    "OverturningSpectrum",
    "Population",
    "PopulationCurve",
    "Record",
    "RecordSet",
    "Regression",
    "Response",
    "Results",
    "Risk",
    "RiskUncertainty",
    "RotD",
    "Selection",
    "Site",
    "Solver",
    "Spectrum",
    "State",
    "StoredResults",
    "Stripes",
    "TargetSpectrum",
    "Triangular",
    "Typology",
    "TypologyBootstrap",
    "UncertainWall",
    "Uniform",
    "Window",
    "Work",
    "__version__",
    "build_variant",
    "certify",
    "check_dynamic",
    "check_ntc",
    "cloud",
    "compare",
    "compare_designs",
    "compare_intensities",
    "ec8_spectrum",
    "example_records",
    "facade",
    "fit_fragility",
    "incremental",
    "intensity_table",
    "load",
    "mean_annual_frequency",
    "multiple_stripe",
    "nrml_functions",
    "ntc_spectrum",
    "overturning_spectrum",
    "pulses",
    "read_case",
    "read_catalogue",
    "read_nrml",
    "read_population",
    "read_record",
    "read_records",
    "read_results",
    "report",
    "run_case",
    "sample_population",
    "select_records",
    "simulate",
    "synthetic_records",
    "typology",
    "uncertain_wall",
    "weakest_hinge",
    "write_nrml",
    "write_workbook",
]
# Names of walls stand where the walls do
__all__ += _walls
