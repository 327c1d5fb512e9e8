"""Records without motion: no factor brings them to a level, and no analysis may count them as survivors."""

from __future__ import annotations

import re
import warnings

import numpy as np
import pytest

import dondolo as dd

TIME = np.arange(600) * 0.01


def shake(name: str, amplitude: float = 1.5) -> dd.Record:
    """A motion that begins and ends at zero."""
    values = amplitude * np.sin(np.pi * TIME / 6.0) ** 2 * np.sin(2.0 * np.pi * 1.3 * TIME)
    return dd.Record(values, 0.01, name, metadata={"event": name})


LIVE = [shake(f"live{i}", 1.0 + 0.3 * i) for i in range(4)]

# Channels of a recorder that did not work: silent, with the dust that processing leaves, stuck at a value
NOISE = np.random.default_rng(5).standard_normal(600)
DEAD = {
    "zeros": np.zeros(600),
    "negative zeros": -np.zeros(600),
    "denormal": np.full(600, 0.0) + 5e-324 * np.sign(NOISE),
    "tiny": 1e-300 * NOISE,
    "dust of a mean that was removed": 1e-15 * NOISE,
    "below any resolution": 9.9e-7 * np.sign(NOISE),
    "stuck": np.full(600, 0.37),
    "stuck at a negative value": np.full(600, -2.5),
    "stuck to rounding": 7.5 * (1.0 + 1e-12 * np.sign(NOISE)),
}
SENTENCE = re.escape("record 'dead': has no motion (")


@pytest.fixture(params=DEAD)
def dead(request) -> dd.Record:
    """A record of a channel that did not work, with or without a vertical component that did."""
    vertical = NOISE if request.param == "zeros" else None
    return dd.Record(DEAD[request.param], 0.01, "dead", vertical=vertical, metadata={"event": "live0"})


@pytest.mark.parametrize("im", ["pga", "pgv", "sa(0.5)", "arias", "pga/a0", "p*pgv/a0", "saavg(0.2:1.0)"])
def test_every_measure_refuses(dead, im, wall):
    with pytest.raises(dd.errors.InputError, match=SENTENCE):
        dd.multiple_stripe(wall, [*LIVE, dead], [0.2, 0.8], im=im, progress=False)


def test_every_analysis_refuses(dead, wall):
    """One rule, whatever the analysis: stripes, populations, buildings, designs, clouds, selections, components."""
    several = [*LIVE[:2], dead, *LIVE[2:]]
    levels = [0.2, 0.8]
    upstairs = dd.OneSidedWall(1.5, 0.25, building=dd.Building([0.3], storeys=2, level=6.0, building_height=6.0))
    target = dd.TargetSpectrum.ec8(0.25, soil="C", periods=[0.1, 0.5, 1.0])
    designs = {"present": wall, "thicker": dd.OneSidedWall(1.5, 0.3)}
    sources = {"thickness": dd.distributions.Normal(0.25, 0.01)}
    analyses = (
        lambda: dd.multiple_stripe(upstairs, several, levels, progress=False),
        lambda: dd.multiple_stripe(wall, several, levels, estimate_error=True, progress=False),
        lambda: dd.multiple_stripe(wall, several, levels, polarity="both", progress=False),
        lambda: dd.multiple_stripe(wall, {0.2: LIVE, 0.8: several}, progress=False),
        lambda: dd.multiple_stripe(wall, dd.RecordSet(several, level=0.4, factor=2.0), progress=False),
        lambda: dd.adaptive_stripes(wall, several, budget=200, progress=False),
        lambda: dd.typology([wall, upstairs], several, levels, progress=False),
        lambda: dd.compare_designs(designs, several, levels, progress=False),
        lambda: dd.propagate_uncertainty(wall, several, levels, sources=sources, n_variants=8, progress=False),
        lambda: dd.compare_intensities(wall, several, ["pga", "pgv"], progress=False),
        lambda: dd.cloud(wall, several, progress=False),
        lambda: dd.cloud(wall, dd.RecordSet(several, factor=0.5), progress=False),
        lambda: dd.RecordSet(several).select(target, 3),
        lambda: LIVE[0].rotate(dead, 30.0),
        lambda: dead.rotate(LIVE[0], 30.0),
        lambda: LIVE[0].rotd(dead),
    )
    for analysis in analyses:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", dd.errors.DondoloWarning)
            with pytest.raises(dd.errors.InputError, match=SENTENCE):
                analysis()


def test_the_reason_is_stated(wall):
    reasons = {
        "zeros": "(its PGA is 0): must be left out",
        "tiny": "m/s2 is below 1e-6 m/s2): must be left out",
        "stuck": "(all its samples are 0.37 m/s2): must be left out",
    }
    for name, reason in reasons.items():
        with pytest.raises(dd.errors.InputError) as caught:
            dd.multiple_stripe(wall, [*LIVE, dd.Record(DEAD[name], 0.01, "x")], [0.2], progress=False)
        assert str(caught.value).endswith(reason)


def test_a_record_that_runs_at_no_level_is_no_matter(wall):
    """Only what runs is looked at; a wall alone may be under any motion, and a rectangular pulse is one."""
    rows = dd.RecordSet([*LIVE, *LIVE], level=[0.2] * 4 + [0.8] * 4)
    assert dd.multiple_stripe(wall, rows, progress=False).ran.sum() == 8
    with pytest.warns(dd.errors.DondoloWarning, match="has a PGA of 0"):
        assert dd.simulate(wall, dd.Record(np.zeros(10), 0.01), history=False).edp == 0.0
    assert dd.simulate(wall, dd.Record(np.full(50, -3.0), 0.01), history=False).edp > 0.0


@pytest.mark.parametrize("scale", [1e-5, 1.0, 1e3])
def test_what_is_weak_is_still_a_motion(scale, wall):
    """The rule does not depend on the unit that a record was given in by mistake."""
    weak = [dd.Record(scale * one.acceleration, one.dt, one.name, metadata=one.metadata) for one in LIVE]
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", dd.errors.DondoloWarning)
        own, other = (dd.multiple_stripe(wall, some, [0.2, 0.8], progress=False) for some in (LIVE, weak))
    np.testing.assert_array_equal(own.collapsed, other.collapsed)


def test_a_vertical_component_that_was_dead(dead, tmp_path):
    with pytest.raises(dd.errors.InputError, match="vertical: has no motion"):
        LIVE[0].with_vertical(dead)
    for name, values in (("up", dead.acceleration), ("across", LIVE[0].acceleration)):
        np.savetxt(tmp_path / f"{name}.txt", values, fmt="%.17g")
    (tmp_path / "c.csv").write_text("file,vertical,dt_s,units\nacross.txt,up.txt,0.01,m/s2\n")
    assert len(dd.read_catalogue(tmp_path / "c.csv")) == 1
    with pytest.raises(dd.errors.InputError, match="line 2: vertical: has no motion"):
        dd.read_catalogue(tmp_path / "c.csv", vertical="recorded")
