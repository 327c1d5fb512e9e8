"""Levels chosen one after the other."""

import re
from math import erfc

import numpy as np
import pytest
from refusals import refused
from scipy.optimize import minimize

import dondolo as dd
from dondolo._fortran import _core
from dondolo.analysis.auto_levels import _determinants, next_level


def determinant(cuts):
    """That of the information in classes, each of whose bounds is as good as any for the last."""
    several = [_determinants(np.delete(cuts, i), cuts[i : i + 1])[0] for i in {0, len(cuts) // 2, len(cuts) - 1}]
    assert several == pytest.approx([several[0]] * len(several), rel=1e-12, abs=1e-15)
    return several[0]


def test_information_of_grouped_data():
    """Two cuts in closed form, and never more than the value itself tells."""
    # The determinant is largest, symmetric about the mean, where both parameters are told equally well.
    best = minimize(lambda x: -determinant(np.sort(x)), [-1.0, 0.5], method="Nelder-Mead", options={"xatol": 1e-8})
    assert best.x[0] == pytest.approx(-best.x[1], abs=1e-6)
    # Classes beyond c on both sides, and one between: sums of squared slopes over probabilities
    c = best.x[1]
    phi, tail = np.exp(-0.5 * c**2) / np.sqrt(2.0 * np.pi), 0.5 * erfc(c / np.sqrt(2.0))
    expected = (2.0 * phi**2 / tail) * (2.0 * (c * phi) ** 2 / tail + (2.0 * c * phi) ** 2 / (1.0 - 2.0 * tail))
    assert determinant(np.array([-c, c])) == pytest.approx(expected, rel=1e-12)
    many = determinant(np.linspace(-6.0, 6.0, 2001))
    assert expected < many < 2.0
    assert many == pytest.approx(2.0, rel=1e-3)
    # The same level again tells nothing; nor do cuts that no value reaches.
    assert determinant(np.array([-c, c, c])) == pytest.approx(expected, rel=1e-12)
    assert determinant(np.array([-60.0, -c, c, 60.0])) == pytest.approx(expected, rel=1e-12)


@pytest.mark.parametrize(
    ("levels", "collapses", "expected"),
    [
        ([0.1, 0.2], [0, 0], 0.4),
        ([0.3, 0.6], [10, 10], 0.15),
        ([0.2, 0.8], [0, 10], (0.3, 0.55)),
        ([0.4], [5], (0.2, 0.8)),
        ([0.2, 0.4, 0.8], [5, 5, 5], (0.1, 1.6)),
        ([0.2, 0.4, 0.8], [9, 5, 1], (0.1, 1.6)),
    ],
)
def test_next_level(levels, collapses, expected):
    found = next_level(np.array(levels), np.array(collapses, dtype=float), np.full(len(levels), 10.0))
    if isinstance(expected, tuple):
        assert expected[0] <= found <= expected[1]
        assert found not in levels
        assert found == float(f"{found:.3g}")
    else:
        assert found == expected


def test_the_best_levels_of_a_known_curve():
    """With a curve that is known well, the next levels lie on both sides of its median, where information is scarce."""
    levels = 0.5 * np.exp(0.4 * np.array([-0.1, 0.1]))
    counts = 1e4 * np.array([0.4601721627, 0.5398278373])
    first = next_level(levels, counts, np.full(2, 1e4))
    assert abs(np.log(first / 0.5) / 0.4) == pytest.approx(1.5, abs=0.4)


def test_stripes(wall, few):
    chosen = dd.adaptive_stripes(wall, few, budget=6 * len(few) + 3, progress=False, threads=1)
    assert len(chosen.levels) == 6
    assert np.all(np.diff(chosen.levels) > 0.0)
    assert chosen.work.histories == 6 * len(few)
    assert chosen.fit().has_fit
    again = dd.multiple_stripe(wall, few, chosen.levels, progress=False)
    for name in ("edp", "impacts", "scale", "ran", "polarity"):
        assert np.array_equal(getattr(chosen, name), getattr(again, name))
    assert (chosen.record_names, chosen.events, chosen.work) == (again.record_names, again.events, again.work)
    other = dd.adaptive_stripes(wall, few, budget=6 * len(few), progress=False, threads=2)
    assert np.array_equal(other.edp, chosen.edp)


def test_other_measures(wall, few):
    """The first level follows from the records, also where scales go with its root."""
    for im in ("arias", "sa(0.5)", "p*pgv/a0"):
        chosen = dd.adaptive_stripes(wall, few, budget=4 * len(few), im=im, progress=False)
        assert len(chosen.levels) == 4
        assert chosen.collapses.any()


def test_it_ends(few, wall):
    """Where nothing ever collapses, the levels double until the budget is spent or no record bears it."""
    firm = dd.OneSidedWall(1.0, 50.0, name="firm")
    with pytest.warns(dd.errors.DondoloWarning):
        still = dd.adaptive_stripes(firm, few[:2], budget=200, progress=False)
    assert not still.collapses.any()
    assert 3 <= len(still.levels) < 20
    assert still.levels[1:] == pytest.approx(2.0 * still.levels[:-1], rel=1e-2)


@pytest.mark.parametrize(
    ("budget", "message"),
    [
        (10, "budget = 10: must be at least 24, 3 stripes of 8 histories"),
        (0.5, "budget = 0.5: must be an integer, at least 1"),
        (None, "budget = None: must be an integer, at least 1"),
    ],
)
def test_wrong_budgets(wall, few, budget, message):
    with pytest.raises(dd.errors.InputError, match=re.escape(message)):
        dd.adaptive_stripes(wall, few, budget, progress=False)


def test_records_with_levels(wall, few):
    with pytest.raises(dd.errors.InputError, match="records: have levels of their own"):
        dd.adaptive_stripes(wall, {0.4: few}, budget=100, progress=False)
    with refused("wrong_type", "levels"):
        dd.multiple_stripe(wall, few, "auto", progress=False)


def test_interruption(wall, few, replace_procedure):
    """What is complete is kept."""
    calls = []
    run_block = _core.stripes.run_block

    def stopped(*arguments):
        calls.append(arguments)
        if len(calls) == 3:
            raise KeyboardInterrupt
        return run_block(*arguments)

    replace_procedure("stripes.run_block", stopped)
    with pytest.raises(dd.errors.Interrupted, match="interrupted: 2 of 5 stripes are complete") as caught:
        dd.adaptive_stripes(wall, few, budget=5 * len(few), progress=False)
    assert len(caught.value.partial.levels) == 2


@pytest.mark.parametrize("im", ["pga", "arias"])
def test_a_record_without_motion(im, wall, records):
    still = dd.Record(np.zeros(10), 0.01, "flat")
    with pytest.raises(dd.errors.InputError, match="record 'flat': has no motion"):
        dd.adaptive_stripes(wall, [*records[:4], still], budget=100, im=im, progress=False)
