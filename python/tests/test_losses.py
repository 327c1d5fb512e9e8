"""Losses for OpenQuake: mean and spread of the ratio from a sample of walls, and files by the rules of its reader."""

import csv
import re
from xml.etree import ElementTree

import numpy as np
import pytest
from scipy import stats

import dondolo as dd

SPACE = "{http://openquake.org/xmlns/nrml/0.5}"
STATES = {"light": 0.25, "heavy": 0.5, "collapse": 0.9}
RATIOS = {"light": 0.05, "heavy": 0.3, "collapse": 1.0}


@pytest.fixture
def functions():
    return {"old town/all": {name: dd.Fragility.of_parameters(theta, 0.4, im="pga") for name, theta in STATES.items()}}


@pytest.fixture
def path(tmp_path):
    return tmp_path / "vulnerability.xml"


def read(path):
    """Levels, and the rows of numbers of the only function."""
    model = ElementTree.parse(path).getroot()[0]
    assert model.tag == SPACE + "vulnerabilityModel"
    description, function = model
    assert "light 0.05, heavy 0.3, collapse 1" in description.text
    imls, *rows = function
    return imls, function.attrib, [(row.attrib, np.array(row.text.split(), dtype=float)) for row in rows]


def sampled(level):
    """Ratios of 400 000 walls whose capacities of all states have the same rank."""
    z = np.random.default_rng(3).normal(size=400_000)
    capacity = np.array([theta * np.exp(0.4 * z) for theta in STATES.values()])
    state = (capacity <= level).sum(axis=0)
    return np.array([0.0, *RATIOS.values()])[state]


def test_mean_and_spread(functions, path):
    dd.write_vulnerability(path, functions, RATIOS, distribution="LN")
    imls, attributes, ((_, mean), (_, spread)) = read(path)
    levels = np.array(imls.text.split(), dtype=float)
    assert attributes == {"id": "old town/all", "dist": "LN"}
    assert imls.get("imt") == "PGA"
    assert np.all(np.diff(np.log(levels[levels < 2.9])) < 0.1001)
    # Beyond the end of the curves at 0.9 exp(3 0.4)
    assert levels[-1] == pytest.approx(6.0 * 0.9 * np.exp(1.2))
    assert levels[0] == pytest.approx(0.25 * np.exp(-2.4))
    for x in (0.2, 0.45, 1.0):
        near = np.argmin(np.abs(levels - x))
        ratios = sampled(levels[near])
        assert mean[near] == pytest.approx(ratios.mean(), abs=2e-3)
        assert spread[near] * mean[near] == pytest.approx(ratios.std(), abs=2e-3)


def test_probabilities_of_states(functions, path):
    dd.write_vulnerability(path, functions, RATIOS, distribution="PM")
    imls, attributes, rows = read(path)
    levels = np.array(imls.text.split(), dtype=float)
    assert attributes["dist"] == "PM"
    assert [float(row["lr"]) for row, _ in rows] == [0.0, 0.05, 0.3, 1.0]
    chances = np.array([chance for _, chance in rows])
    np.testing.assert_allclose(chances.sum(axis=0), 1.0, rtol=0, atol=1e-15)
    np.testing.assert_allclose(chances[3], stats.norm.cdf(np.log(levels / 0.9) / 0.4), rtol=1e-9)
    np.testing.assert_allclose(chances[2] + chances[3], stats.norm.cdf(np.log(levels / 0.5) / 0.4), rtol=1e-9)
    # A ratio of 0 is no damage, equal ratios are one
    dd.write_vulnerability(path, functions, {"light": 0.0, "heavy": 0.5, "collapse": 0.5}, distribution="PM")
    rows = ElementTree.parse(path).getroot().findall(f".//{SPACE}probabilities")
    assert [float(row.get("lr")) for row in rows] == [0.0, 0.5]
    np.testing.assert_allclose(
        np.array(rows[1].text.split(), dtype=float), stats.norm.cdf(np.log(levels / 0.5) / 0.4), rtol=1e-9
    )


def test_beta_distributions_satisfy_the_engine(functions, path):
    dd.write_vulnerability(path, functions, RATIOS, distribution="BT")
    _, _, ((_, mean), (_, spread)) = read(path)
    assert np.all((mean > 0.0) & (mean <= 1.0))
    assert np.all(np.diff(mean) > 0.0)
    assert np.all(spread**2 <= 1.0 / mean - 1.0)
    # Of ratios of 0 and 1 alone the largest spread would be reached, of which there is no beta distribution.
    dd.write_vulnerability(path, functions, {"light": 0.0, "heavy": 0.0, "collapse": 1.0})
    rows = [row.text.split() for row in ElementTree.parse(path).getroot()[0][1][1:]]
    mean, spread = np.array(rows, dtype=float)
    np.testing.assert_allclose(spread, 0.99 * np.sqrt(1.0 / mean - 1.0), rtol=1e-6)


def test_units(path):
    levels = np.geomspace(0.1, 2.0, 30)
    p = stats.norm.cdf(np.log(levels / 0.6) / 0.3)
    dd.write_vulnerability(
        path,
        {"a": {"collapse": dd.DiscreteFragility(levels, p, im="pgv")}},
        {"collapse": 0.8},
        loss_category="contents",
    )
    model = ElementTree.parse(path).getroot()[0]
    assert model.get("lossCategory") == "contents"
    imls = model.find(f".//{SPACE}imls")
    assert imls.get("imt") == "PGV"
    assert float(imls.text.split()[0]) == pytest.approx(10.0)
    assert float(imls.text.split()[-1]) == pytest.approx(1200.0)


def test_consequences(functions, tmp_path):
    path = tmp_path / "consequences.csv"
    dead = {"light": 0.0, "heavy": 0.0, "collapse": 0.1}
    dd.write_consequences(path, functions, {"losses": RATIOS})
    dd.write_consequences(path, functions, {"losses": RATIOS, "fatalities": dead})
    with path.open(newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert [row["consequence"] for row in rows] == ["losses", "fatalities"]
    common = {"risk_id": "old town/all", "peril": "groundshaking", "loss_type": "structural"}
    for row, shares in zip(rows, (RATIOS, dead), strict=True):
        assert {title: row[title] for title in common} == common
        assert {state: float(row[state]) for state in STATES} == shares
    path.write_text("mine\n")
    with pytest.raises(dd.errors.InputError, match="exists"):
        dd.write_consequences(path, functions, {"losses": RATIOS})
    assert path.read_text() == "mine\n"


def test_refusals(functions, path, tmp_path):
    for ratios, sentence in (
        ({"light": 0.1, "collapse": 1.0}, "ratios = light, collapse: must be a number for each of light, heavy"),
        (0.5, "ratios = 0.5: must be a number for each"),
        ({**RATIOS, "heavy": 1.2}, "ratios[heavy] = 1.2: must lie between 0 and 1"),
        ({**RATIOS, "light": 0.4}, "ratios = 0.4, 0.3, 1: must not decrease with the state"),
        ({**RATIOS, "light": "x"}, "ratios[light]"),
    ):
        with pytest.raises(dd.errors.InputError, match=re.escape(sentence)):
            dd.write_vulnerability(path, functions, ratios)
    with pytest.raises(dd.errors.InputError, match="distribution = 'XX': must be one of 'BT', 'LN', 'PM'"):
        dd.write_vulnerability(path, functions, RATIOS, distribution="XX")
    for consequences, sentence in (
        ({}, "must be a mapping of consequences"),
        ({"deaths": RATIOS}, "consequences = 'deaths': must be one of 'losses', 'fatalities'"),
        ({"fatalities": {"collapse": 0.1}}, "fatalities = collapse: must be a number for each of"),
    ):
        with pytest.raises(dd.errors.InputError, match=re.escape(sentence)):
            dd.write_consequences(tmp_path / "c.csv", functions, consequences)
    nothing = dd.fit_fragility([0.2, 0.4], [0, 0], 44, im="pga")
    with pytest.raises(dd.errors.DondoloError, match="has no curve"):
        dd.write_vulnerability(path, {"a": {"collapse": nothing}}, {"collapse": 1.0})
    assert not path.exists()
