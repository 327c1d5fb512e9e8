"""Mutation checks of the statistics: python test/mutations.py [--quick] [WORD]...

Each edit makes one formula, one unit or one word wrong, and the test named with it must then fail. Python and
JavaScript are edited in a copy of the installed package, and the Italian catalogue compiled into it. Of a Fortran
source a copy is edited, compiled against the modules of the build and linked before its library: into the Fortran test,
or for a test of pytest into the extension module of a copied package.
Given words, check only the edits that contain all of them; with --quick, only the first of each file.

Prints one line for each edit. Fails if an edit survives, if its text does not occur exactly once, or if a test fails
without any edit; the last line gives the reason.
"""

import importlib.util
import io
import json
import os
import shlex
import shutil
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from functools import cache
from pathlib import Path
from typing import NamedTuple

ROOT = Path(__file__).resolve().parents[1]
TESTS = ROOT / "python" / "tests"
CATALOGUES = ROOT / "python/dondolo/reporting/locale"

# Time limit of one test run [s]; ample for a busy machine
LONGEST = 1800


class CompilerError(Exception):
    """A Fortran test that does not compile or link; the message is the compiler's."""


class Edit(NamedTuple):
    """A wrong formula: what is wrong with it, the text it replaces, and the test that must fail.

    The test is one of pytest for a formula in Python, and a program in test/ for one in Fortran; or one of pytest, if
    the formula is said to be of the library.
    """

    error: str
    old: str
    new: str
    test: str
    in_library: bool = False


EDITS = [
    # Fragility curves
    Edit(
        "the delta-method band has the covariance of ln theta and beta with the wrong sign",
        "np.stack([np.full_like(probit, -1.0 / curve.beta), -probit / curve.beta])",
        "np.stack([np.full_like(probit, -1.0 / curve.beta), probit / curve.beta])",
        "test_fitting.py::test_delta_interval_is_that_of_a_probit_regression",
    ),
    Edit(
        "the interval of beta takes its standard error for that of ln beta",
        "half = quantile * curve.se_beta / curve.beta\n",
        "half = quantile * curve.se_beta\n",
        "test_fitting.py::test_intervals_from_counts",
    ),
    Edit(
        "intervals of clustered errors have the normal quantile",
        "normal_or_student(upper, self.degrees_of_freedom if self.clusters else np.inf)",
        "normal_or_student(upper, np.inf)",
        "test_fitting.py::test_clustered_covariance_is_that_of_fits_without_each_event",
    ),
    Edit(
        "confidence intervals are one-sided",
        "return 0.5 - 0.5 * confidence, min(0.5 + 0.5 * confidence,",
        "return 1.0 - confidence, min(confidence,",
        "test_fitting.py::test_delta_interval_is_that_of_a_probit_regression",
    ),
    Edit(
        "fragility curves tend to 1 where not all walls can collapse",
        "self.upper_asymptote * probability(self.theta, self.beta, values.ravel())",
        "probability(self.theta, self.beta, values.ravel())",
        "test_combination.py::test_saturation",
    ),
    # Bootstrap over records
    Edit(
        "bootstrap weights are not normalised for events of unequal size",
        " = drawn * (len(labels) / drawn.sum(axis=1, keepdims=True))",
        " = drawn * 1.0",
        "test_typology_bootstrap.py::test_events_of_unequal_size",
    ),
    Edit(
        "events are drawn in proportion to their number of records",
        "np.full(len(places), 1.0 / len(places))",
        "np.bincount(place) / len(place)",
        "test_typology_bootstrap.py::test_events_of_unequal_size",
    ),
    Edit(
        "bootstrap curves of a population tend to 1 where not all walls can collapse",
        "curves *= self._ends()[~np.isnan(self.theta), None]",
        "curves *= 1.0",
        "test_typology_bootstrap.py::test_the_interval_ends_at_the_saturation",
    ),
    Edit(
        "the two polarities of a record are not drawn together",
        "of_record = flags.reshape(rows, levels, -1, self.records).sum(axis=2, dtype=np.float64)",
        "of_record = flags.reshape(rows, levels, self.records, -1).sum(axis=3, dtype=np.float64)",
        "test_typology_bootstrap.py::test_brute_force",
    ),
    Edit(
        "the bootstrap ignores probabilities of occurrence in the upper asymptote",
        "occurring += own @ saturations(*occurs, starts)",
        "occurring += own.sum(axis=1)",
        "test_typology_bootstrap.py::test_brute_force",
    ),
    # Comparison of curves
    Edit(
        "curves on the same records are taken for independent",
        "(1.0, -1.0), strict=True)",
        "(1.0, 1.0), strict=True)",
        "test_fitting.py::test_paired_comparison",
    ),
    Edit(
        "compare_intensities ignores events",
        "draw_records(clusters, n_resamples, rng)",
        "draw_records(range(len(several)), n_resamples, seed)",
        "test_intensity.py::test_comparison_draws_events_together",
    ),
    Edit(
        "resampled dispersions of an energy are not halved",
        "resample(sample_of(stripes), times).beta for stripes in analyses]) / power[:, None]",
        "resample(sample_of(stripes), times).beta for stripes in analyses])",
        "test_intensity.py::test_comparison",
    ),
    # Regressions
    Edit(
        "the residual variance of the line is divided by n, not by n - 2",
        "sigma = float(np.sqrt(left @ left / (n - 2)))",
        "sigma = float(np.sqrt(left @ left / n))",
        "test_cloud.py::test_fits_against_statsmodels",
    ),
    Edit(
        "total probability adds collapse and rocking as if they were exclusive",
        "collapse + (1.0 - collapse) * self.rocking._at(x, gap) * exceeds",
        "collapse + self.rocking._at(x, gap) * exceeds",
        "test_cloud.py::test_known_parameters",
    ),
    # Hazard and risk
    Edit(
        "hazard curves are interpolated on linear axes",
        "h = frequency * np.exp(-k * (u - start))",
        "h = np.interp(flat, self.levels, self.annual_frequency)",
        "test_risk.py::test_curve_is_straight_on_logarithmic_axes",
    ),
    Edit(
        "the closed form of the risk integral has the slope of the hazard with the wrong sign",
        "return z, z + k * beta, np.log(frequency)",
        "return z, z - k * beta, np.log(frequency)",
        "test_risk.py::test_closed_form",
    ),
    Edit(
        "the upper bound above the hazard curve ignores the upper asymptote",
        "(above, most * float(hazard.annual_frequency[-1]))",
        "(above, float(hazard.annual_frequency[-1]))",
        "test_risk.py::test_bounds_end_at_the_saturation",
    ),
    Edit(
        "the probability of collapse in time tends to 1 where not all walls can collapse",
        "WallFrequencies(np.array([share]), *(np.array([end / share]) for end in self.bounds))",
        "WallFrequencies(np.ones(1), *(np.array([end]) for end in self.bounds))",
        "test_risk.py::test_time_ends_at_the_saturation",
    ),
    Edit(
        "combinations without a mechanism have the share of those with it",
        "share = share * (p_occ if there else 1.0 - p_occ)",
        "share = share * (p_occ if there else p_occ)",
        "test_risk.py::test_time_of_a_population",
    ),
    # Populations
    Edit(
        "the mean of one mechanism ignores its probabilities of occurrence",
        "return self.weights[rows[first]] * total, share",
        "return self.weights[rows[first]], share",
        "test_combination.py::test_mean_of_one_mechanism",
    ),
    # Incremental dynamic analysis
    Edit(
        "fractiles of histories are interpolated",
        'np.quantile(values, SHARES, axis=-1, method="inverted_cdf")',
        "np.quantile(values, SHARES, axis=-1)",
        "test_incremental.py::test_fractiles_are_exact",
    ),
    # Sampling
    Edit(
        "correlations of the samples by chance remain",
        "factor @ linalg.solve_triangular(np.linalg.cholesky(own), scores.T, lower=True)",
        "factor @ scores.T",
        "test_sampling.py::test_pairs_that_are_not_named_have_no_correlation",
    ),
    # Processing of records
    Edit(
        "the taper has half its length",
        "signal.windows.tukey(len(values), 2.0 * part)",
        "signal.windows.tukey(len(values), part)",
        "test_processing.py::test_taper_is_half_a_cosine",
    ),
    Edit(
        "the filter passes forwards only",
        "filtered = signal.sosfiltfilt(sections, padded, padtype=None)",
        "filtered = signal.sosfilt(sections, padded)",
        "test_processing.py::test_gain_of_the_filter",
    ),
    Edit(
        "rotation turns in the wrong sense",
        " = cosine * first.acceleration + sine * second.acceleration",
        " = cosine * first.acceleration - sine * second.acceleration",
        "test_processing.py::test_directions_of_a_line_and_a_circle",
    ),
    Edit(
        "the derivative of the velocity baseline lacks the factors of its powers",
        "drift = (x ** (powers - 1)) @ (powers * factors) / record.duration",
        "drift = (x ** (powers - 1)) @ factors / record.duration",
        "test_processing.py::test_baseline_of_the_velocity",
    ),
    # Figures
    Edit(
        "bars of the fractions ignore the upper asymptote",
        "(fragility.upper_asymptote * part for part in (z / n, low, high))",
        "(part for part in (z / n, low, high))",
        "test_plots.py::test_bars_end_at_the_saturation",
    ),
    Edit(
        "upper ends of the bars are those of one collapse fewer",
        "betaincinv(z + 1.0, n - z, upper)",
        "betaincinv(z, n - z + 1.0, upper)",
        "test_plots.py::test_bars_end_at_the_saturation",
    ),
    Edit(
        "the intercept of the logistic curve is that of the centred variable",
        "curve%b = [b(1) - b(2)*centre/spread, b(2)/spread]",
        "curve%b = [b(1), b(2)/spread]",
        "test_fragility.f90",
    ),
    Edit(
        "the deviance is that of the log likelihood, once",
        "deviance = max(2.0_wp*(sum(log_share(z, n)",
        "deviance = max(1.0_wp*(sum(log_share(z, n)",
        "test_fragility.f90",
    ),
    Edit(
        "histories of which the curve is true are the farthest from the other outcome",
        "able = able[np.argsort(-rank[able] if rises else rank[able])]",
        "able = able[np.argsort(rank[able] if rises else -rank[able])]",
        "test_goodness.py::test_p_values_are_uniform_under_a_lognormal",
    ),
    # Fractiles over a population, in Fortran
    Edit(
        "a fractile has more than its share of the weight below it, not at least that share",
        ".not. reached >= (shares(from_least(k)) - rounding)*total)",
        ".not. reached > (shares(from_least(k)) + rounding)*total)",
        "test_typology.f90",
    ),
    Edit(
        "weights do not follow the walls into the order of their probabilities",
        "reached = reached + weights(order(i))",
        "reached = reached + weights(i)",
        "test_typology.f90",
    ),
    Edit(
        "the curves of one mechanism ignore its probabilities of occurrence",
        "if (column <= self%rows) weight = weight*row%p_occ",
        "",
        "test_typology.f90",
    ),
    # Walls of several mechanisms
    Edit(
        "mechanisms in series are added as if they were exclusive",
        "whole = whole + (1.0_wp - whole)*p_occ(m)*p(:, m)",
        "whole = whole + p_occ(m)*p(:, m)",
        "test_typology.f90",
    ),
    Edit(
        "a mechanism beyond the first always occurs",
        "whole = whole + (1.0_wp - whole)*p_occ(m)*p(:, m)",
        "whole = whole + (1.0_wp - whole)*p(:, m)",
        "test_typology.f90",
    ),
    Edit(
        "exclusive alternatives are combined as if they were independent",
        "whole = whole + p_occ(m)*any_of_them",
        "whole = whole + (1.0_wp - whole)*p_occ(m)*any_of_them",
        "test_occurrence.f90",
    ),
    Edit(
        "a history in which two mechanisms of an alternative collapse counts twice",
        "where (reaches .and. .not. self%is_reached(i, :, :))",
        "where (reaches)",
        "test_occurrence.f90",
    ),
    Edit(
        "probabilities of alternatives may add up to anything",
        "if (self%total <= 1.0_wp + sum_tolerance) return",
        "return",
        "test_occurrence.f90",
    ),
    Edit(
        "a wall has as many histories as the mechanism with most of them",
        "histories = minval(self%histories(:, of(1):of(2)), dim=2)",
        "histories = maxval(self%histories(:, of(1):of(2)), dim=2)",
        "test_typology.f90",
    ),
    Edit(
        "the curve of a wall is fitted to fractions that do not tend to 1",
        "self%fraction(column, state), self%occurrence(column), &",
        "self%fraction(column, state), 1.0_wp, &",
        "test_typology.f90",
    ),
    Edit(
        "fractions are interpolated from zero between all levels",
        "p(i) = below + (fractions(j + 1) - below)*(x(i) - before)/(levels(j + 1) - before)",
        "p(i) = fractions(j + 1)*(x(i) - before)/(levels(j + 1) - before)",
        "test_typology.f90",
    ),
    # Means and dispersions of a population
    Edit(
        "a mean ignores the weights of the walls",
        "mean(k) = mean(k) + self%weight(i)*p(i, k)",
        "mean(k) = mean(k) + sum(self%weight)/real(size(self%weight), wp)*p(i, k)",
        "test_typology.f90",
    ),
    Edit(
        "the dispersion between walls is taken from the first wall, not from the mean",
        "squares = squares + share*distance*(log(fit%theta) - centre)",
        "squares = squares + share*distance**2",
        "test_typology.f90",
    ),
    Edit(
        "the dispersion between records is the mean of beta squared, without its root",
        "curve%beta_records = sqrt(beta_squares/fitted)",
        "curve%beta_records = beta_squares/fitted",
        "test_typology.f90",
    ),
    Edit(
        "the mean is fitted as if it tended to 1",
        "curve%mean_fraction, curve%upper_asymptote, curve%histories, error)",
        "curve%mean_fraction, 1.0_wp, curve%histories, error)",
        "test_typology.f90",
    ),
    # Fits of fragility curves
    Edit(
        "the covariance of ln theta and beta has the wrong sign",
        "jacobian(2, :) = [0.0_wp, -spread/b(2)**2]",
        "jacobian(2, :) = [0.0_wp, spread/b(2)**2]",
        "test_fragility.f90",
    ),
    Edit(
        "the Fisher information ignores the number of histories",
        "information = outer(n*mills(eta)*mills(-eta), x)",
        "information = outer(mills(eta)*mills(-eta), x)",
        "test_fragility.f90",
    ),
    Edit(
        "the log likelihood lacks a part of the binomial coefficients",
        "& - log_gamma(histories - collapses + 1.0_wp))",
        "& )",
        "test_fragility.f90",
    ),
    Edit(
        "a median beyond the highest level is not called extrapolated",
        "if (fragility%theta < minval(levels) .or. fragility%theta > maxval(levels))",
        "if (fragility%theta < minval(levels))",
        "test_fragility.f90",
    ),
    Edit(
        "the gain in log likelihood stands for the likelihood ratio",
        "is_flat = 2.0_wp*gain < least_ratio",
        "is_flat = gain < least_ratio",
        "test_fragility.f90",
    ),
    Edit(
        "counts that tell of a falling curve are fitted",
        "else if (score <= 16.0_wp*epsilon(score)*sum(n)) then",
        "else if (score <= -huge(score)) then",
        "test_fragility.f90",
    ),
    # Documents, the page and their words
    Edit(
        "the area of ties is a tenth of it in cm2/m",
        '"m2/m": Unit("cm²/m", 1e4)',
        '"m2/m": Unit("cm²/m", 1e3)',
        "test_shown_truths.py::test_factors_of_units_are_those_of_their_names",
    ),
    Edit(
        "ties push the wall off its base",
        '* sums["weight"] - sums["held"]',
        '* sums["weight"] + sums["held"]',
        "test_truths.py::test_forces_on_the_base_are_in_equilibrium",
    ),
    Edit(
        "forces of Italian warnings are in N where kN are said",
        '1e-3 * value if "_force" in name else value',
        "value",
        "test_shown_truths.py::test_forces_in_italian_warnings_are_in_the_unit_that_they_say",
    ),
    Edit(
        "lower ends of the bars are those of one collapse more",
        "betaincinv(z, n - z + 1.0, lower)",
        "betaincinv(z + 1.0, n - z, lower)",
        "test_shown_truths.py::test_labels_of_a_band_and_of_bars_say_their_confidence",
    ),
    Edit(
        "steel weighs 7800 kg/m3",
        "_DENSITY = 7850.0",
        "_DENSITY = 7800.0",
        "test_designs.py::test_ties",
    ),
    Edit(
        "of an interrupted run all stripes are told of the complete ones",
        'f"interrupted: {complete} of {stripes} stripes',
        'f"interrupted: {stripes} of {complete} stripes',
        "test_interrupt.py::test_between_levels_that_are_chosen",
    ),
    Edit(
        "the bounds of a return period are exchanged",
        "return high, low",
        "return low, high",
        "test_shown_truths.py::test_a_hazard_that_is_too_short_is_told_from_one_per_cent_on",
    ),
    Edit(
        "ground C of Eurocode 8 has another factor",
        '"C": (1.15, 0.20',
        '"C": (1.2, 0.20',
        "test_shown_truths.py::test_spectra_of_eurocode_8",
    ),
    Edit(
        "the period of SLC is shown with the factor of SLV",
        "trim(shown(period_factors(state)))//' * pi * sqrt('",
        "trim(shown(period_factors(2)))//' * pi * sqrt('",
        "test_truths.py::test_every_number_of_a_sheet_follows_from_its_symbols",
        in_library=True,
    ),
    Edit(
        "T_D stands for T_C in the numbers of an ordinate",
        "numbers = numbers//' * '//trim(shown(tc))//'/'//trim(shown(period))",
        "numbers = numbers//' * '//trim(shown(td))//'/'//trim(shown(period))",
        "test_truths.py::test_every_number_of_a_sheet_follows_from_its_symbols",
        in_library=True,
    ),
    Edit(
        "T_D stands for T_C in the symbols of an ordinate",
        "expression = expression//' T_C/T'",
        "expression = expression//' T_D/T'",
        "test_truths.py::test_every_number_of_a_sheet_follows_from_its_symbols",
        in_library=True,
    ),
    Edit(
        "FC and e* are exchanged in a_0*, whose numbers stay",
        "working_type('alpha_0 g/(e* FC)'",
        "working_type('alpha_0 g/(FC e*)'",
        "test_truths.py::test_every_number_of_a_sheet_follows_from_its_symbols",
        in_library=True,
    ),
    Edit(
        "improvement asks for 0.5",
        '"schools": number(0.6)',
        '"schools": number(0.5)',
        "test_shown_truths.py::test_what_improvement_asks_for",
    ),
    Edit(
        "a_0 in g is headed m/s2",
        '"trigger": _Shown((Symbol("a", "0"), " [g]")',
        '"trigger": _Shown((Symbol("a", "0"), " [m/s²]")',
        "test_shown_truths.py::test_heads_of_columns_have_their_units",
    ),
    Edit(
        "a nearly flat curve is called a curve in Italian",
        'msgid "nearly_flat"\nmsgstr "pendenza non significativa: parametri non affidabili"',
        'msgid "nearly_flat"\nmsgstr "curva determinata"',
        "test_shown_truths.py::test_statuses_by_their_keys",
    ),
    Edit(
        "an area of m2/m is headed cm2/m in Italian workbooks",
        '"_m2_m": "m²/m"',
        '"_m2_m": "cm²/m"',
        "test_shown_truths.py::test_italian_heads_have_the_units_of_the_names",
    ),
    Edit(
        "shares up to 0.5 % are less than 0.1 %",
        "0.0 < share < 0.0005",
        "0.0 < share < 0.005",
        "test_shown_truths.py::test_shares_say_their_values",
    ),
    Edit(
        "collapses are a share of all cells",
        "percent(stripes.collapsed.sum() / stripes.ran.sum())",
        "percent(stripes.collapsed.mean())",
        "test_shown_truths.py::test_shares_of_a_wall_are_of_the_histories_that_ran",
    ),
    Edit(
        "a hazard is too short from 10 % on",
        "0.99 * one.bounds[1]",
        "0.9 * one.bounds[1]",
        "test_shown_truths.py::test_a_hazard_that_is_too_short_is_told_from_one_per_cent_on",
    ),
    Edit(
        "the page has the probability of collapse at a_g",
        "chance_at(fit, check.pga)",
        'chance_at(fit, check.value("site", "SLV", "ag"))',
        "test_shown_truths.py::test_every_number_of_the_page_is_the_library_s",
    ),
    Edit(
        "thrusts are drawn at the outer face",
        "t - (inner_face(wall, height_of(wall, part)) if part.depth is None else part.depth)",
        "t - (0.0 if part.depth is None else part.depth)",
        "test_shown_truths.py::test_forces_are_drawn_where_the_calculation_has_them",
    ),
    Edit(
        "the dispersion of a selection is that of the whole population",
        "np.log(self.sa).std(axis=0, ddof=1)",
        "np.log(self.sa).std(axis=0, ddof=0)",
        "test_shown_truths.py::test_dispersion_of_a_selection_is_that_of_a_sample",
    ),
    Edit(
        "the label of every band says 95 %",
        'histories independent", share=100.0 * confidence)',
        'histories independent", share=95.0)',
        "test_shown_truths.py::test_labels_of_a_band_and_of_bars_say_their_confidence",
    ),
    Edit(
        "masses of a calculation report are a tenth of them",
        '"kg/m": Unit("t/m", 1e-3)',
        '"kg/m": Unit("t/m", 1e-4)',
        "test_truths.py::test_every_formula_of_a_document_gives_its_value",
    ),
    Edit(
        "fractions stand on their heads",
        "Fraction(_bare(parts), _bare((self._factor(),)))",
        "Fraction(_bare((self._factor(),)), _bare(parts))",
        "test_truths.py::test_every_formula_of_a_document_gives_its_value",
    ),
    Edit(
        "roots are left out",
        'Root(inside) if name == "sqrt"',
        '_Group(("(", inside, ")")) if name == "sqrt"',
        "test_truths.py::test_every_formula_of_a_document_gives_its_value",
    ),
    Edit(
        "powers are left out",
        'return (part, _POWERS[self._take()]) if self._next() == "power" else part',
        'return (part, "" * len(self._take())) if self._next() == "power" else part',
        "test_truths.py::test_every_formula_of_a_document_gives_its_value",
    ),
    Edit(
        "the sine at d_C has the sums exchanged",
        '(shown(d), " · ", Fraction(first, second)), shown(sine)',
        '(shown(d), " · ", Fraction(second, first)), shown(sine)',
        "test_truths.py::test_every_formula_of_a_document_gives_its_value",
    ),
    Edit(
        "pushed masses are added to what loses height",
        'numbers += _signed(" - ", sums.pushed)',
        'numbers += _signed(" + ", sums.pushed)',
        "test_truths.py::test_every_formula_of_a_document_gives_its_value",
    ),
    Edit(
        "the sine and the cosine of d_C are exchanged",
        '(rest, *cos, " - ", fall, *sin)',
        '(rest, *sin, " - ", fall, *cos)',
        "test_truths.py::test_every_formula_of_a_document_gives_its_value",
    ),
    Edit(
        "rows without numbers alone are shown",
        "if row.numbers and row.quantity not in _AGAIN:",
        "if row.expression and not row.numbers and row.quantity not in _AGAIN:",
        "test_truths.py::test_a_new_row_of_a_sheet_is_in_the_document",
    ),
    Edit(
        "the factor of damping has 10 for 5",
        "'sqrt(10/(5 + 100 * '",
        "'sqrt(10/(10 + 100 * '",
        "test_truths.py::test_every_number_of_a_sheet_follows_from_its_symbols",
        in_library=True,
    ),
    Edit(
        "T_D is 4 a_g + 1.2",
        "trim(shown(ag))//' + 1.6'",
        "trim(shown(ag))//' + 1.2'",
        "test_truths.py::test_every_number_of_a_sheet_follows_from_its_symbols",
        in_library=True,
    ),
    Edit(
        "the least of two ratios is said to govern",
        "expression = 'max['//expression",
        "expression = 'min['//expression",
        "test_truths.py::test_every_number_of_a_sheet_follows_from_its_symbols",
        in_library=True,
    ),
    Edit(
        "the surface of shear has the thickness once",
        "'//b//' + 2 * '//t//')'",
        "'//b//' + 1 * '//t//')'",
        "test_truths.py::test_every_number_of_a_sheet_follows_from_its_symbols",
        in_library=True,
    ),
    Edit(
        "moments are headed N/m in Italian workbooks",
        '"_nm_m": "N m/m"',
        '"_nm_m": "N/m"',
        "test_shown_truths.py::test_italian_heads_have_the_units_of_the_names",
    ),
    Edit(
        "rotations are headed as degrees",
        '_Shown("capacity [rad]"',
        '_Shown("capacity [°]"',
        "test_shown_truths.py::test_heads_of_columns_have_their_units",
    ),
    Edit(
        "a_0 in m/s2 is headed g",
        '"trigger": [wall.trigger_acceleration / wall.gravity for',
        '"trigger": [wall.trigger_acceleration for',
        "test_shown_truths.py::test_columns_of_a_report_are_those_of_the_frame",
    ),
    Edit(
        "numbers lose their signs",
        'text.replace("-", _MINUS)',
        'text.replace("-", "")',
        "test_shown_truths.py::test_numerals_say_their_values",
    ),
    Edit(
        "the page has a_0 in m/s2",
        '"trigger": wall.trigger_acceleration / wall.gravity,',
        '"trigger": wall.trigger_acceleration,',
        "test_shown_truths.py::test_every_number_of_the_page_is_the_library_s",
    ),
    Edit(
        "the page has capacities of checks that do not apply",
        "for key, value in check.capacities.items() if key not in check.not_applicable]",
        "for key, value in check.capacities.items()]",
        "test_shown_truths.py::test_every_number_of_the_page_is_the_library_s",
    ),
    Edit(
        "loads are drawn as far from the inner face as they are from the outer",
        "t - (part.depth if part.depth is not None else 0.0),",
        "(part.depth if part.depth is not None else 0.0),",
        "test_shown_truths.py::test_forces_are_drawn_where_the_calculation_has_them",
    ),
    Edit(
        "differences to the state as it stands have the other sign",
        "number(row.value - base.value)",
        "number(base.value - row.value)",
        "test_shown_truths.py::test_what_improvement_asks_for",
    ),
    Edit(
        "the median of a stripe is its mean",
        "np.nanmedian(stripes.edp, axis=1)",
        "np.nanmean(stripes.edp, axis=1)",
        "test_shown_truths.py::test_medians_of_stripes_are_medians",
    ),
    Edit(
        "thrusts are called loads in Italian",
        'msgctxt "item"\nmsgid "thrust"\nmsgstr "spinta"',
        'msgctxt "item"\nmsgid "thrust"\nmsgstr "carico"',
        "test_shown_truths.py::test_words_of_cells_by_their_keys",
    ),
    Edit(
        "what is not verified is called satisfied",
        '"not verified": _("NOT satisfied")',
        '"not verified": _("satisfied")',
        "test_shown_truths.py::test_verdicts_by_their_keys",
    ),
    Edit(
        "nonlinear checks are called linear in Italian workbooks",
        'msgctxt "method"\nmsgid "nonlinear"\nmsgstr "non lineare"',
        'msgctxt "method"\nmsgid "nonlinear"\nmsgstr "lineare"',
        "test_shown_truths.py::test_words_of_cells_by_their_keys",
    ),
    Edit(
        "the ratio of SLV is headed SLD",
        'msgid "linear_slv_ratio"\nmsgstr "capacità/domanda, SLV lineare"',
        'msgid "linear_slv_ratio"\nmsgstr "capacità/domanda, SLD lineare"',
        "test_shown_truths.py::test_heads_of_a_sheet_mean_what_its_quantities_mean",
    ),
    Edit(
        "the page calls the depth of a tie its height in Italian",
        'msgctxt "label of the page"\nmsgid "tie_depth"\nmsgstr "… dal filo esterno"',
        'msgctxt "label of the page"\nmsgid "tie_depth"\nmsgstr "… quota"',
        "test_shown_truths.py::test_labels_of_the_page_mean_what_the_properties_mean",
    ),
    Edit(
        "the page calls the yield stress of ties their modulus",
        'tie_strength: "Yield stress"',
        'tie_strength: "Modulus"',
        "test_shown_truths.py::test_labels_of_the_page_mean_what_the_properties_mean",
    ),
    Edit(
        "the page refuses a number below its least as one above its most",
        'msgid "at least"\nmsgstr "almeno {x}"',
        'msgid "at least"\nmsgstr "al più {x}"',
        "test_shown_truths.py::test_refusals_say_their_bounds",
    ),
    Edit(
        "the ends of the levels are exchanged in an Italian warning",
        "mediana della curva di fragilità {theta}, fuori dai livelli da {first_level} a {last_level}",
        "mediana della curva di fragilità {theta}, fuori dai livelli da {last_level} a {first_level}",
        "test_shown_truths.py::test_places_of_italian_warnings_are_in_order",
    ),
    Edit(
        "exclusive mechanisms are called independent in Italian",
        'msgid "exclusive"\nmsgstr "esclusivi"',
        'msgid "exclusive"\nmsgstr "indipendenti"',
        "test_shown_truths.py::test_words_of_cells_by_their_keys",
    ),
    Edit(
        "the ground that governs a floor has the acceleration of its modes",
        "numbers = 'max('//trim(shown(modal))//', '//trim(shown(ground))//')'",
        "numbers = 'max('//trim(shown(modal))//', '//trim(shown(modal))//')'",
        "test_truths.py::test_every_number_of_a_sheet_follows_from_its_symbols",
        in_library=True,
    ),
    Edit(
        "Word has the head of a column over the next",
        "heads = tuple(column.head for column in shown.columns)",
        "heads = tuple(column.head for column in (*shown.columns[1:], shown.columns[0]))",
        "test_report_word.py::test_tables_are_those_of_the_page",
    ),
    Edit(
        "what a page folds up is left out of Word",
        "yield from unfolded(block.blocks)",
        "yield from ()",
        "test_report_word.py::test_tables_are_those_of_the_page",
    ),
    Edit(
        "a page has values of a table one row lower",
        "for place, (first, *cells) in enumerate(table.rows)",
        "for place, (first, *cells) in enumerate((*list(table.rows)[-1:], *list(table.rows)[:-1]))",
        "test_report.py::test_numbers_are_those_of_the_results",
    ),
    Edit(
        "texts of a page are markup",
        "return escape(piece)\n",
        "return piece\n",
        "test_report.py::test_texts_are_escaped",
    ),
    Edit(
        "ends of the frequency above the hazard are exchanged",
        "low=above[0],\n        high=above[1],",
        "low=above[1],\n        high=above[0],",
        "test_shown_truths.py::test_ranges_of_reports_ascend",
    ),
    Edit(
        "ends of the hazard are exchanged in a report",
        "say(words, first=first, last=last)",
        "say(words, first=last, last=first)",
        "test_shown_truths.py::test_ranges_of_reports_ascend",
    ),
    Edit(
        "intervals of the frequency have their ends exchanged",
        'zip(table["low"], table["high"]',
        'zip(table["high"], table["low"]',
        "test_shown_truths.py::test_ranges_of_reports_ascend",
    ),
    Edit(
        "what a level exceeds is that of its upper end",
        "hazard.annual_frequency[:-1]]",
        "hazard.annual_frequency[1:]]",
        "test_shown_truths.py::test_what_is_said_of_the_risk_is_the_hazard_s",
    ),
    Edit(
        "the standard error of ln theta is that of beta",
        "error=number(curve.se_ln_theta, 3)",
        "error=number(curve.se_beta, 3)",
        "test_shown_truths.py::test_what_is_said_of_a_wall_is_of_its_curve",
    ),
    Edit(
        "ends of the intervals of a curve are exchanged",
        'for place, side in enumerate(("low", "high"))',
        'for place, side in enumerate(("high", "low"))',
        "test_shown_truths.py::test_what_is_said_of_a_wall_is_of_its_curve",
    ),
    Edit(
        "the upper end of a fraction is its lower",
        "high=probability(high / n)",
        "high=probability(low / n)",
        "test_shown_truths.py::test_histories_that_are_not_computable_widen_bounds",
    ),
    Edit(
        "the lowest median is the greatest",
        '"theta_lowest": [low for low, _ in bounds]',
        '"theta_lowest": [high for _, high in bounds]',
        "test_shown_truths.py::test_histories_that_are_not_computable_widen_bounds",
    ),
    Edit(
        "shares of a population stand at the levels of others",
        "level(people.levels[i], people.im)) for i in chosen]",
        "level(people.levels[-1 - i], people.im)) for i in chosen]",
        "test_shown_truths.py::test_shares_of_a_population_are_those_at_their_levels",
    ),
    Edit(
        "a calculation report has the probability of collapse at SLD",
        "pga = document.subjects.several[0].check.pga\n    ends",
        'pga = document.subjects.several[0].check.value("site", "SLD", "pga")\n    ends',
        "test_shown_truths.py::test_curves_of_a_calculation_report",
    ),
    Edit(
        "the lower end of a median is its upper",
        '("95 % interval from")): [number(low) for low, _high in ends]',
        '("95 % interval from")): [number(high) for _low, high in ends]',
        "test_shown_truths.py::test_curves_of_a_calculation_report",
    ),
    Edit(
        "latitudes of nodes are their longitudes",
        "[number(one, 9) for one in mesh.latitudes]",
        "[number(one, 9) for one in mesh.longitudes]",
        "test_shown_truths.py::test_nodes_of_a_site_are_where_their_distances_say",
    ),
    Edit(
        "bands have another confidence than their labels",
        "fragility.interval(grid, confidence=confidence)",
        "fragility.interval(grid)",
        "test_shown_truths.py::test_labels_of_a_band_and_of_bars_say_their_confidence",
    ),
    Edit(
        "thrusts hold a strip in the steps of a calculation report",
        "return (self.weights - self.thrusts + (self.ties",
        "return (self.weights + self.thrusts + (self.ties",
        "test_strips.py::test_steps_of_a_calculation_report",
    ),
    Edit(
        "what is on the lower block of a strip rises as it turns",
        "up.append((w - x) * cos - z * sin)",
        "up.append((w - x) * cos + z * sin)",
        "test_strips.py::test_steps_of_a_calculation_report",
    ),
    Edit(
        "the load on the top of a strip is drawn on the other side of the middle line",
        "x = 0.5 * right + (wall.eccentricity or 0.0)",
        "x = 0.5 * right - (wall.eccentricity or 0.0)",
        "test_strips.py::test_scheme_of_a_calculation_report",
    ),
    Edit(
        "the weight of the upper block of a strip is drawn at the hinge",
        '"upper block": ("P2", 1.0)}',
        '"upper block": ("P2", 0.0)}',
        "test_strips.py::test_scheme_of_a_calculation_report",
    ),
    Edit(
        "the moment of a table is divided by its first lever",
        'lever = terms.at("S", rotation)',
        'lever = terms.at("S", 0.0)',
        "test_tabulated_checks.py::test_the_calculation_report_gives_the_numbers_of_the_check",
    ),
    Edit(
        "the capacity of a table is not divided by FC",
        """"mass_ratio") * one.check.value("mechanism", "SLV", "knowledge_factor")""",
        """"mass_ratio")""",
        "test_tabulated_checks.py::test_the_calculation_report_gives_the_numbers_of_the_check",
    ),
    Edit(
        "the title page counts warnings as remarks",
        "remarks=counts[1]",
        "remarks=counts[0]",
        "test_tabulated_checks.py::test_calculation_reports_in_both_languages_and_formats",
    ),
    Edit(
        "the period of a building is twice the displacement of its top",
        "period_of_displacement = 2.0_wp*sqrt(displacement)",
        "period_of_displacement = 2.0_wp*displacement",
        "test_floors.f90",
    ),
    Edit(
        "the proposed period grows with another power of the height",
        "proposed_period = 0.05_wp*height**0.75_wp",
        "proposed_period = 0.05_wp*height**0.7_wp",
        "test_floors.f90",
    ),
]


def is_fortran(edit: Edit) -> bool:
    """Is the formula one of the Fortran library?"""
    return edit.in_library or edit.test.endswith(".f90")


def is_translation(edit: Edit) -> bool:
    """Is it the Italian of something?"""
    return edit.old in texts_in(CATALOGUES, (".po",))[CATALOGUES / "it.po"]


def places(edit: Edit, package: Path) -> list[str]:
    """Files of the package, or of the library, in which the text of an edit occurs, once for each occurrence."""
    folder, suffixes = (ROOT / "src", (".f90",)) if is_fortran(edit) else (package, (".py", ".js"))
    if is_translation(edit):
        folder, suffixes = CATALOGUES, (".po",)
    sources = texts_in(folder, suffixes)
    return [str(path.relative_to(folder)) for path, text in sources.items() for _ in range(text.count(edit.old))]


@cache
def texts_in(folder: Path, suffixes: tuple[str, ...]) -> dict[Path, str]:
    """Texts of the sources in a folder."""
    found = sorted(path for path in folder.rglob("*") if path.suffix in suffixes)
    return {path: path.read_text(encoding="utf-8") for path in found}


def stale(package: Path) -> list[str]:
    """Errors of the list: texts that do not occur exactly once, tests that do not exist."""
    found = []
    for edit in EDITS:
        where = places(edit, package)
        if len(where) != 1:
            found.append(f"must occur once, occurs in {', '.join(where) or 'no file'}: {edit.old!r}")
        file, _, name = edit.test.partition("::")
        path = (TESTS if file.endswith(".py") else ROOT / "test") / file
        if not path.is_file() or (name and f"\ndef {name}(" not in path.read_text(encoding="utf-8")):
            found.append(f"no such test: {edit.test}")
    return found


def run_program(test: str, sources: list[Path], folder: Path) -> int | None:
    """0 if a Fortran test passes with some sources instead of the library's, 1 if it fails, None if it is endless."""
    build = ROOT / "build-python" / "src"
    modules = [f"-I{path}" for path in build.rglob("*.p") if any(path.glob("*.mod"))]
    # The archives need each other: the library calls the lanes, and the lanes its core.
    libraries = ["-Wl,--start-group", *build.rglob("libdondolo*.a"), "-Wl,--end-group", "-llapack", "-lblas"]
    program = folder / "program"
    flags = ["-O1", "-fopenmp", "-fimplicit-none", *modules, "-J", folder, "-o", program]
    run_compiler(["gfortran", *flags, ROOT / "test/checks.f90", *sources, ROOT / "test" / test, *libraries], ROOT)
    try:
        done = subprocess.run(program, cwd=ROOT, capture_output=True, timeout=LONGEST, check=False)
    except subprocess.TimeoutExpired:
        return None
    return int(done.returncode != 0)


def check_fortran(edit: Edit) -> int | None:
    """Exit status of the test of an edit in Fortran."""
    source = ROOT / "src" / places(edit, ROOT)[0]
    with tempfile.TemporaryDirectory() as name:
        wrong = Path(name) / source.name
        wrong.write_text(source.read_text(encoding="utf-8").replace(edit.old, edit.new), encoding="utf-8")
        return run_program(edit.test, [wrong], Path(name))


def link_extension(edit: Edit, package: Path) -> None:
    """Make the extension module of a copied package with an edit of the library."""
    build, name = ROOT / "build-python", places(edit, package)[0]
    commands = json.loads((build / "compile_commands.json").read_text(encoding="utf-8"))
    compiled = next(
        one["command"] for one in commands if one["file"] == f"../src/{name}" and "quadruple" not in one["output"]
    )
    (target,) = (build / "python").glob("_core.*.so")
    ninja = shutil.which("ninja") or Path(sys.executable).with_name("ninja")
    listed = subprocess.run(
        [ninja, "-t", "commands", f"python/{target.name}"], cwd=build, capture_output=True, text=True, check=True
    )
    with tempfile.TemporaryDirectory() as folder:
        wrong, made = Path(folder) / Path(name).name, Path(folder) / "edited.o"
        text = (ROOT / "src" / name).read_text(encoding="utf-8")
        wrong.write_text(text.replace(edit.old, edit.new), encoding="utf-8")
        words = [one for one in shlex.split(compiled) if not one.startswith("-J")]
        words[words.index("-o") + 1], words[words.index("-c") + 1] = str(made), str(wrong)
        run_compiler([*words, f"-J{folder}"], build)
        # What is linked first is taken, and that of the library then is not.
        words = shlex.split(listed.stdout.splitlines()[-1])
        at = words.index("-o") + 1
        run_compiler([*words[:at], str(package / "_fortran" / target.name), str(made), *words[at + 1 :]], build)


def compile_catalogue(edit: Edit, package: Path) -> None:
    """Put a catalogue with an edit into a copied package."""
    from babel.messages.mofile import write_mo
    from babel.messages.pofile import read_po

    source = CATALOGUES / places(edit, package)[0]
    wrong = source.read_text(encoding="utf-8").replace(edit.old, edit.new)
    with (package / "reporting/locale" / source.with_suffix(".mo").name).open("wb") as made:
        write_mo(made, read_po(io.StringIO(wrong)))


def run_compiler(command: list[str | Path], folder: Path) -> None:
    """Compile or link."""
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        lines = [line.strip() for line in done.stderr.splitlines()]
        raise CompilerError(next((line for line in lines if "rror:" in line or "undefined" in line), lines[-1]))


def copy_of(package: Path, folder: Path) -> Path:
    """Copy the package into a folder."""
    return Path(shutil.copytree(package, folder / package.name))


def run_tests(tests: list[str], folder: Path) -> int | None:
    """Exit status of tests run with the copy of the package in a folder; None beyond the time limit."""
    command = [sys.executable, "-m", "pytest", "--exitfirst", "--tb=no", "-p", "no:cacheprovider", *tests]
    environment = {**os.environ, "PYTHONPATH": str(folder), "MPLBACKEND": "agg"}
    try:
        done = subprocess.run(
            command, cwd=TESTS, env=environment, stdout=subprocess.DEVNULL, timeout=LONGEST, check=False
        )
    except subprocess.TimeoutExpired:
        return None
    return done.returncode


def check(edit: Edit, package: Path) -> str:
    """Apply an edit to a copy and run its test: 'caught', 'survived', 'endless', or 'broken' if it cannot be run."""
    try:
        if edit.test.endswith(".f90"):
            status = check_fortran(edit)
        else:
            with tempfile.TemporaryDirectory() as name:
                copied = copy_of(package, Path(name))
                if edit.in_library:
                    link_extension(edit, copied)
                elif is_translation(edit):
                    compile_catalogue(edit, copied)
                else:
                    place = copied / places(edit, package)[0]
                    place.write_text(place.read_text(encoding="utf-8").replace(edit.old, edit.new), encoding="utf-8")
                status = run_tests([edit.test], Path(name))
    except CompilerError as error:
        return f"broken ({error})"
    return {0: "survived", 1: "caught", None: "endless"}.get(status, "broken")


def fails_unedited(edits: list[Edit], package: Path) -> str:
    """The first test of some edits that fails without any edit, and why; empty if all pass."""
    tests = sorted({edit.test for edit in edits if not edit.test.endswith(".f90")})
    with tempfile.TemporaryDirectory() as name:
        copy_of(package, Path(name))
        if tests and run_tests(tests, Path(name)) != 0:
            return f"one of {', '.join(tests)} fails"
        for test in sorted({edit.test for edit in edits if edit.test.endswith(".f90")}):
            try:
                if run_program(test, [], Path(name)) != 0:
                    return f"{test} fails"
            except CompilerError as error:
                return f"{test} cannot be built: {error}"
    return ""


def main() -> int:
    """Check the list, the tests without an edit, and then every edit."""
    words = [word for word in sys.argv[1:] if word != "--quick"]
    package = Path(importlib.util.find_spec("dondolo").origin).parent
    wrong = stale(package)
    if wrong:
        print(*wrong, sep="\n")
        return 1
    chosen = [edit for edit in EDITS if all(word in " ".join(edit[:4]) for word in words)]
    if "--quick" in sys.argv[1:]:
        chosen = list({places(edit, package)[0]: edit for edit in reversed(chosen)}.values())
    if not chosen:
        print(f"mutations: no edit contains {' and '.join(map(repr, words))}")
        return 1
    if why := fails_unedited(chosen, package):
        print(f"mutations: without any edit {why}")
        return 1
    outcomes = []
    with ThreadPoolExecutor(os.cpu_count()) as workers:
        for edit, outcome in zip(chosen, workers.map(lambda edit: check(edit, package), chosen), strict=True):
            outcomes.append(outcome)
            print(f"{outcome:<9} {places(edit, package)[0]}: {edit.error} ({edit.test})", flush=True)
    caught = outcomes.count("caught")
    print(f"mutations: {len(chosen)} edits, {caught} caught")
    return 0 if caught == len(chosen) else 1


if __name__ == "__main__":
    sys.exit(main())
