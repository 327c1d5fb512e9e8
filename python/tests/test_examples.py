"""The examples of the documentation run, and leave their figures."""

import os
import subprocess
import sys

import pytest

pytestmark = pytest.mark.slow


@pytest.mark.parametrize(
    ("example", "figures"),
    [
        ("first_wall", ["first_wall_history.png", "first_wall_peak.png"]),
        ("stripes_and_curve", ["stripes.png", "curve.png"]),
        ("two_mechanisms", ["two_mechanisms.png"]),
        ("intensity_measures", ["intensity_measures.png"]),
        ("population", ["population.png", "population_fragility.csv"]),
        ("process_records", ["process_records.png"]),
        ("overturning", ["overturning.png", "overturning_boundaries.csv"]),
        ("synthetic_motions", ["synthetic_motions.png"]),
        ("sampled_population", ["sampled_population.png", "town.csv"]),
        ("site_risk", ["site_risk.png"]),
        ("code_check", ["code_check.png", "code_check.csv", "code_check.html"]),
        ("facade", ["facade.png"]),
        ("own_mechanism", ["own_mechanism.png"]),
        ("which_tie", ["which_tie.png"]),
        ("how_sure", ["how_sure.png", "how_sure.csv"]),
        ("goodness_of_fit", ["goodness_of_fit.png"]),
        ("risk", ["incremental.png", "cloud.png", "risk.png", "parapet.xml"]),
    ],
)
def test_example(example, figures, root, tmp_path):
    done = subprocess.run(
        [sys.executable, root / "docs/examples" / f"{example}.py"],
        cwd=tmp_path,
        env={**os.environ, "MPLBACKEND": "agg"},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    for figure in figures:
        assert (tmp_path / "out/examples" / figure).stat().st_size > 500
