"""Coverage of confidence intervals, by the experiment of docs/coverage.py with a small population."""

import importlib.util
import re
import sys

import pytest

import dondolo as dd
from dondolo.reporting.wall import uncertainty


@pytest.fixture(scope="module")
def experiment(root):
    spec = importlib.util.spec_from_file_location("coverage_experiment", root / "docs/coverage.py")
    module = importlib.util.module_from_spec(spec)
    sys.modules[spec.name] = module
    spec.loader.exec_module(module)
    return module


@pytest.fixture(scope="module")
def outcomes(experiment):
    """Of 44 synthetic records, from which those of each study are drawn."""
    records = dd.read_catalogue("../../data/records/synthetic44.csv")
    return experiment.outcomes(dd.OneSidedWall(1.5, 0.25), records, 12)


@pytest.mark.parametrize(("polarity", "size"), [(slice(0, 1), 44), (slice(None), 44), (slice(None), 22)])
def test_intervals_contain_the_truth_as_often_as_they_say(experiment, outcomes, polarity, size):
    shares, without = experiment.coverage(outcomes, polarity, size, 400, 5)
    ours = shares["CR3, t (dondolo)"]
    # Four standard errors of a share of 0.95 are 0.044; with few records that of beta is a little less.
    assert 0.91 <= ours["theta"] <= 0.99
    assert 0.89 <= ours["beta"] <= 0.99
    assert shares["naive"]["theta"] < 0.8
    assert shares["naive"]["beta"] < 0.9
    assert without < 0.02


@pytest.mark.parametrize("kind", ["same_records", "other_records"])
def test_equal_curves_are_rejected_as_often_as_allowed(experiment, outcomes, kind):
    found = experiment.rejections(getattr(experiment, kind)(outcomes, 44), 400, 5)
    for what in ("theta", "beta", "both"):
        assert 0.01 <= found[what] <= 0.09
    if kind == "other_records":
        assert found["naive theta"] > 0.2


def test_the_page_has_the_experiment(experiment):
    """The page was written with the numbers that the script has."""
    page = experiment.PAGE.read_text(encoding="utf-8")
    assert experiment.TEXT in page
    rows = [line.split(" | ") for line in page.splitlines() if line.startswith(("| one_sided", "| two_block"))]
    covered = {tuple(row[:3]) for row in rows if row[1] in ("as_recorded", "both")}
    # Two walls, one of them with two polarities
    assert len(covered) == 3 * len(experiment.SIZES)


def test_the_coverage_that_is_printed_is_measured(root):
    """Report, pages and docstring have the numbers of the study of exactly lognormal capacities."""
    page = (root / "docs/studies/coverage.md").read_text(encoding="utf-8")
    found = re.findall(r"(?m)^\| (\d+), from [^|]+ \| (\d+) \| [\d.]+ \| ([\d.]+) \| ([\d.]+) \|$", page)
    assert [row[:2] for row in found] == [(n, size) for n in ("12", "20") for size in ("22", "44", "100")]
    exact = ", ".join(row[2] for row in found[3:5]) + f" and {found[5][2]} %"
    rounded = "{}, {} and {} %".format(*(round(float(row[2])) for row in found[3:]))
    text = (root / "docs/reading_a_curve.md").read_text(encoding="utf-8")
    assert exact in " ".join(text.split())
    levels = [0.2, 0.4, 0.6]
    told = uncertainty(dd.fit_fragility(levels, [1, 11, 19], 20, im="pga"))
    for printed in (dd.Fragility.parameter_interval.__doc__, str(told)):
        assert rounded in " ".join(printed.split())
