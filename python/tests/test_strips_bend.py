"""The warning of strips that bend before they open: by every route, and never beside a green verdict."""

import html
import json
import re
import subprocess
import warnings

import numpy as np
import pytest

import dondolo as dd
from dondolo.reporting.language import Language
from dondolo.reporting.verdict import verdict
from dondolo.reporting.words import BENDING
from dondolo.reporting.words import warning as in_words

# Strong enough that every check is satisfied; one bends before it opens, the other is too stocky to
SLENDER = {"height": 3.1, "thickness": 0.26, "hinge": 0.62, "overburden": 25e3, "overburden_inertia": 0.0}
STOCKY = {"height": 2.6, "thickness": 0.45, "hinge": 0.6}
CHECK = {"ag": 0.03, "f0": 2.5, "tc_star": 0.3, "soil": "A"}
SAID = "joints that bend before they open are neglected"


def heard(call):
    """Codes of the warnings of a call."""
    with warnings.catch_warnings(record=True) as found:
        warnings.simplefilter("always", dd.errors.DondoloWarning)
        call()
    return [one.message.code for one in found]


def case_of(root, wall, output="out"):
    given = ", ".join(f"{name} = {value!r}" for name, value in wall.items())
    site = ", ".join(f"{name} = {value!r}" for name, value in CHECK.items())
    return (
        f"&job task = 'stripes', output = '{output}' /\n&wall name = 'fascia', mechanism = 'two_block', {given} /\n"
        f"&records catalogue = '{root}/data/records/synthetic44.csv' /\n&check {site} /\n"
        "&stripes levels = 0.3, 0.6, 0.9, 1.2, 1.6 /\n"
    )


@pytest.fixture(scope="module")
def runs(tmp_path_factory, executable, root):
    """Folder with the run of both strips."""
    folder = tmp_path_factory.mktemp("strips")
    for name, wall in (("slender", SLENDER), ("stocky", STOCKY)):
        (folder / f"{name}.nml").write_text(case_of(root, wall, name))
        done = subprocess.run([executable, f"{name}.nml"], cwd=folder, capture_output=True, text=True, check=True)
        (folder / f"{name}.said").write_text(done.stdout + done.stderr)
    return folder


def test_routes(runs, few, root, executable):
    strip, site = dd.TwoBlockWall(**SLENDER), dd.Site(**CHECK)
    assert heard(lambda: dd.multiple_stripe(strip, few, [0.4], progress=False)).count(BENDING) == 1
    assert heard(lambda: dd.check_ntc(strip, site)).count(BENDING) == 1
    assert heard(lambda: dd.simulate(strip, few[0], 1.0)).count(BENDING) == 1
    people = (
        strip,
        dd.OneSidedWall(3.0, 0.25),
        dd.TwoBlockWall(**STOCKY),
        dd.TwoBlockWall(**SLENDER | {"height": 3.3}),
    )
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        found = dd.typology(people, few, [0.4, 0.8], progress=False)
    (one,) = (one for one in found.warnings if one.code == BENDING)
    assert (one.numbers["walls_beyond"], one.numbers["walls"]) == (2, 4)
    for wall in (dd.TwoBlockWall(**STOCKY), dd.OneSidedWall(3.1, 0.12), dd.FreeStandingWall(3.1, 0.12)):
        assert BENDING not in heard(lambda wall=wall: dd.multiple_stripe(wall, few, [0.4], progress=False))
    for name, count in (("slender", 1), ("stocky", 0)):
        assert (runs / f"{name}.said").read_text().count(SAID) == count
        told = json.loads((runs / f"{name}_run.json").read_text())["warnings"]
        assert [one["code"] for one in told].count(BENDING) == count
    done = subprocess.run([executable, "--check", "slender.nml"], cwd=runs, capture_output=True, text=True)
    assert (done.stdout + done.stderr).count(SAID) == 1


def test_numbers_of_the_wall(few):
    """Half of the trigger, the ranges, and what the frequency parameter of this wall comes to, between the points."""
    strip = dd.TwoBlockWall(**SLENDER)
    with pytest.warns(dd.errors.DondoloWarning, match=SAID) as caught:
        dd.multiple_stripe(strip, few, [0.4], progress=False)
    (one,) = (one.message for one in caught if one.message.code == BENDING)
    assert one.numbers["frequency_1_s"] == pytest.approx(strip.frequency_parameter, rel=1e-12)
    points = ([0.0, 0.06, 0.09, 0.12, 0.15, 0.165, 0.23, 0.31], [0, 3, 7, 9, 14, 17, 25, 37])
    for name, period in (("lower_010", 0.10), ("lower_015", 0.15)):
        lower = np.interp(strip.frequency_parameter * period / (2.0 * np.pi), *points)
        assert one.numbers[name] == pytest.approx(lower, abs=0.5)
    assert "open at about half of the trigger, and medians are 6 to 22 % lower at a period of 0.10 s, 7 to 37 %" in str(
        one
    )
    assert re.search(r"of this wall about \d+ and \d+ %", str(one))
    assert "circa metà" in in_words(Language("it"), one)


def texts(path):
    return html.unescape(re.sub(r"<[^>]+>", " ", path.read_text(encoding="utf-8")))


@pytest.mark.parametrize("lang", ["en", "it"])
def test_no_document_is_green(runs, lang, tmp_path):
    words = {"en": SAID, "it": "la flessione che precede l'apertura dei giunti è trascurata"}[lang]
    for name in ("slender", "stocky"):
        results = dd.read_results(runs / name)
        assert all(results.check.verified.values()), name
        dd.report(results, tmp_path / "report.html", lang=lang)
        dd.calculation_report(results, tmp_path / "relazione.html", lang=lang)
        for path in (tmp_path / "report.html", tmp_path / "relazione.html"):
            assert (words in texts(path)) == (name == "slender"), (name, path)
            assert bool(re.search(r'class="(verdict|note) fine"', path.read_text())) == (name == "stocky"), (name, path)


def test_verdict_of_several_walls(runs):
    """One strip among walls that are satisfied makes the whole open; what fails stays failed."""
    results = dd.read_results(runs / "slender")
    weak = dd.check_ntc(dd.OneSidedWall(6.0, 0.2), dd.Site(**CHECK | {"ag": 0.3}))
    for checks, tone in (([results.check], "doubt"), ([results.check, weak], "failed")):
        walls = [check.wall for check in checks]
        assert verdict(checks, walls, results.run.warnings, without_soil=False).tone == tone
    assert verdict([results.check], [results.check.wall], [], without_soil=False).tone == "fine"


def test_page(root):
    """What is satisfied by rigid blocks has neither sign nor colour on the page."""
    pytest.importorskip("starlette")
    from dondolo.serve.bench import Bench

    bench = Bench(root / "data/records/synthetic44.csv", threads=1)
    site = {name: value if isinstance(value, str) else [value] for name, value in CHECK.items()}
    for wall in (SLENDER, STOCKY):
        settings = {
            "job": {"task": "stripes"},
            "wall": {"mechanism": "two_block", **wall},
            "check": site,
            "stripes": {"im": "pga", "levels": [0.5, 1.0]},
        }
        shown = bench.curve({"settings": settings, "draft": True})
        assert {one[2] for one in shown["check"]["verdicts"]} == {"verified"}
        assert shown["check"]["is_bent"] == (wall is SLENDER)
        assert (BENDING in [one["code"] for one in shown["warnings"]]) == (wall is SLENDER)
    script = (root / "python/dondolo/serve/page/page.js").read_text()
    assert script.count("lookOf(") == script.count("is_bent)") == 2
