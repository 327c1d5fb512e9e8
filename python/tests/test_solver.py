"""Solvers: refused when they are made, and used by every analysis that runs histories."""

import inspect

import numpy as np
import pytest

import dondolo as dd


@pytest.mark.parametrize(
    ("values", "sentence"),
    [
        ({"engine": "euler"}, "engine = 'euler': must be one of 'auto', 'rk45', 'lanes'"),
        ({"engine": 3}, "engine = 3: must be a string"),
        ({"rtol": 0.0}, "rtol = 0: must lie between"),
        ({"rtol": np.nan}, "rtol = NaN: must lie between"),
        ({"atol": -1e-9}, "atol = -1"),
        ({"atol": "small"}, "atol = 'small': must be a number"),
        ({"edp_limit": -1.0}, "edp_limit = -1: must be positive"),
        ({"edp_limit": True}, "edp_limit = True: must be a number"),
    ],
)
def test_wrong_values(values, sentence):
    with pytest.raises(dd.errors.InputError) as caught:
        dd.Solver(**values)
    assert str(caught.value).startswith(sentence)


def test_right_values():
    assert dd.Solver(rtol=1e-3, edp_limit=2) == dd.Solver(rtol=np.float64(1e-3), edp_limit=2.0)
    assert dd.Solver(engine="lanes").engine == "lanes"
    assert dd.Solver() == dd.Solver(rtol=None)


def test_every_analysis_takes_one():
    """Those that run histories of records or of pulses."""
    analyses = [one for name in dd.__all__ if inspect.isfunction(one := getattr(dd, name))]
    run = [one for one in analyses if "threads" in inspect.signature(one).parameters]
    assert {one.__name__ for one in run} >= {"multiple_stripe", "typology", "cloud", "compare_intensities"}
    without = {one.__name__ for one in run if "solver" not in inspect.signature(one).parameters}
    # A case has a group for it.
    assert without <= {"run_case"}


def test_intensities_are_compared_by_it(wall, few):
    """The collapse limit is that of the solver, in the search for levels too."""
    early = dd.Solver(edp_limit=0.4)
    found = dd.compare_intensities(wall, few, "pga", n_levels=5, n_resamples=20, solver=early, progress=False)
    (stripes,) = found.stripes
    assert stripes.edp_limit == 0.4
    again = dd.multiple_stripe(wall, few, stripes.levels, solver=early, progress=False)
    assert np.array_equal(again.collapsed, stripes.collapsed)
    assert found.curves[0].theta < dd.compare_intensities(wall, few, "pga", n_levels=5, progress=False).curves[0].theta
