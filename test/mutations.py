"""Mutation checks of the statistics: python test/mutations.py [--quick] [WORD]...

Each edit makes one formula wrong, and the test named with it must then fail. Formulas of the Python package are edited
in a copy of the installed package. Of a Fortran source a copy is edited, compiled against the modules of the build and
linked before its library. Given words, check only the edits that contain all of them; with --quick, only the first of
each file.

Prints one line for each edit. Fails if an edit survives, if its text does not occur exactly once, or if a test fails
without any edit; the last line gives the reason.
"""

import importlib.util
import os
import shutil
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import NamedTuple

ROOT = Path(__file__).resolve().parents[1]
TESTS = ROOT / "python" / "tests"

# Time limit of one test run [s]; ample for a busy machine
LONGEST = 1800


class CompilerError(Exception):
    """A Fortran test that does not compile or link; the message is the compiler's."""


class Edit(NamedTuple):
    """A wrong formula: what is wrong with it, the text it replaces, and the test that must fail.

    The test is one of pytest for a formula in Python, and a program in test/ for one in Fortran.
    """

    error: str
    old: str
    new: str
    test: str


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
        "self.saturation * probability(self.theta, self.beta, values.ravel())",
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
        "the bootstrap ignores probabilities of occurrence in the saturation",
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
        "draw_records(clusters, n_resamples, seed)",
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
        "the upper bound above the hazard curve ignores the saturation",
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
        "bars of the fractions ignore the saturation",
        "(fragility.saturation * part for part in (z / n, low, high))",
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
        "curve%mean_fraction, curve%saturation, curve%histories, error)",
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
]


def is_fortran(edit: Edit) -> bool:
    """Is the formula one of the Fortran library?"""
    return edit.test.endswith(".f90")


def places(edit: Edit, package: Path) -> list[str]:
    """Files of the package, or of the library, in which the text of an edit occurs, once for each occurrence."""
    folder, pattern = (ROOT / "src", "*.f90") if is_fortran(edit) else (package, "*.py")
    sources = {path: path.read_text(encoding="utf-8") for path in sorted(folder.rglob(pattern))}
    return [str(path.relative_to(folder)) for path, text in sources.items() for _ in range(text.count(edit.old))]


def stale(package: Path) -> list[str]:
    """Errors of the list: texts that do not occur exactly once, tests that do not exist."""
    found = []
    for edit in EDITS:
        where = places(edit, package)
        if len(where) != 1:
            found.append(f"must occur once, occurs in {', '.join(where) or 'no file'}: {edit.old!r}")
        file, _, name = edit.test.partition("::")
        path = (ROOT / "test" if is_fortran(edit) else TESTS) / file
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
    compiled = subprocess.run(
        ["gfortran", *flags, ROOT / "test/checks.f90", *sources, ROOT / "test" / test, *libraries],
        capture_output=True,
        text=True,
        check=False,
    )
    if compiled.returncode != 0:
        lines = [line.strip() for line in compiled.stderr.splitlines()]
        raise CompilerError(next((line for line in lines if "rror:" in line or "undefined" in line), lines[-1]))
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
    if is_fortran(edit):
        try:
            status = check_fortran(edit)
        except CompilerError as error:
            return f"broken ({error})"
    else:
        with tempfile.TemporaryDirectory() as name:
            place = copy_of(package, Path(name)) / places(edit, package)[0]
            place.write_text(place.read_text(encoding="utf-8").replace(edit.old, edit.new), encoding="utf-8")
            status = run_tests([edit.test], Path(name))
    return {0: "survived", 1: "caught", None: "endless"}.get(status, "broken")


def fails_unedited(edits: list[Edit], package: Path) -> str:
    """The first test of some edits that fails without any edit, and why; empty if all pass."""
    tests = sorted({edit.test for edit in edits if not is_fortran(edit)})
    with tempfile.TemporaryDirectory() as name:
        copy_of(package, Path(name))
        if tests and run_tests(tests, Path(name)) != 0:
            return f"one of {', '.join(tests)} fails"
        for test in sorted({edit.test for edit in edits if is_fortran(edit)}):
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
    chosen = [edit for edit in EDITS if all(word in " ".join(edit) for word in words)]
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
