"""Each kinematic check on one line, with the probability of collapse beside its verdict, in all that a reader sees."""

import html
import re
import subprocess

import pytest

import dondolo as dd
from dondolo.checks.side_by_side import side_by_side

CASE = """&job output = 'wall' /
&wall mechanism = 'one_sided', height = 3.0, thickness = 0.30 /
&records catalogue = '{root}/data/records/synthetic44.csv' /
&stripes levels = 0.3, 0.4, 0.5, 0.6, 0.8 /
&check ag = 0.05, 0.13, 0.165, f0 = 2.5, tc_star = 0.28, 0.30, 0.31, soil = 'B' /
"""
KEYS = [("linear", "SLD"), ("linear", "SLV"), ("nonlinear", "SLV"), ("nonlinear", "SLC")]


@pytest.fixture(scope="module")
def made(root, executable, tmp_path_factory):
    """A run, what it printed, and its results."""
    folder = tmp_path_factory.mktemp("side_by_side")
    (folder / "wall.nml").write_text(CASE.format(root=root))
    run = subprocess.run([executable, "wall.nml"], cwd=folder, check=True, capture_output=True, text=True)
    return folder, run.stdout, dd.read_results(folder / "wall")


def shown(p):
    """A probability as all documents have it."""
    return "< 0.0001" if p < 5e-5 else "> 0.9999" if p >= 0.99995 else f"{p:.4f}"


def with_interval(chance, between):
    """The same with its interval; of tails of a fit no more is known than that they are small."""
    ends = f" ({shown(chance.low)}{between}{shown(chance.high)})"
    return shown(chance.value) + (ends if shown(chance.high) != shown(chance.value) else "")


def text_of(path):
    found = html.unescape(re.sub(r"<[^>]+>", "", path.read_text(encoding="utf-8")))
    return re.sub(r"\s+", " ", found.replace("\N{NARROW NO-BREAK SPACE}", " ").replace("\N{NO-BREAK SPACE}", " "))


def test_the_sheet_has_the_intervals_of_the_curve(made):
    _folder, _printed, results = made
    check, curve = results.check, results.fragility
    places = [("site", state, "pga") for state in ("SLD", "SLV", "SLC")]
    places += [(*key, "capacity_pga") for key in KEYS]
    for method, state, quantity in places:
        level = check.value(method, state, quantity)
        low, high = curve.interval(level)
        assert check.value(method, state, "probability") == pytest.approx(curve(level), rel=1e-9)
        assert check.value(method, state, "probability_low") == pytest.approx(low, rel=1e-8)
        assert check.value(method, state, "probability_high") == pytest.approx(high, rel=1e-8)
        assert 0.0 <= low < curve(level) < high


def test_lines_have_the_numbers_of_the_sheet(made):
    _folder, _printed, results = made
    check = results.check
    lines = side_by_side(check, results.fragility)
    assert [(one.method, one.limit_state) for one in lines] == KEYS
    for one in lines:
        assert one.ratio == check.value(one.method, one.limit_state, "ratio")
        assert one.allowed_pga == pytest.approx(one.ratio * one.site_pga, rel=1e-12)
        assert one.required == ((one.method, one.limit_state) == ("nonlinear", "SLV"))
        if one.method == "linear":
            peak = check.value("linear", one.limit_state, "floor_pga")
            assert one.demand == pytest.approx(peak * check.wall.gravity, rel=1e-12)
            assert one.capacity / one.demand == pytest.approx(one.ratio, rel=1e-12)
        else:
            assert one.capacity == check.value("nonlinear", one.limit_state, "displacement")
            assert one.demand == check.value("nonlinear", one.limit_state, "demand")
    assert lines[1].capacity == 2.0 * lines[0].capacity


def test_no_probability_without_a_curve(made):
    _folder, _printed, results = made
    flat = dd.Fragility.of_parameters(0.5, 0.4, im="pgv")
    for curve in (None, flat):
        assert all(one.at_site is None and one.at_allowed is None for one in side_by_side(results.check, curve))
    exact = side_by_side(results.check, dd.Fragility.of_parameters(0.5, 0.4, im="pga"))
    assert all(0.0 < one.at_allowed.value < 1.0 for one in exact)


def test_the_console_has_a_line_for_each(made):
    _folder, printed, results = made
    for one in side_by_side(results.check, results.fragility):
        (line,) = re.findall(rf"^{one.method} +{one.limit_state} .*$", printed, re.M)
        cells = re.split(r"\s{2,}", line)
        unit = "m/s2" if one.method == "linear" else "m"
        numbers = [float(cell.removesuffix(f" {unit}")) for cell in re.split(r"\s{2,}", line)[-8:-3]]
        expected = [one.capacity, one.demand, one.ratio, one.site_pga, one.allowed_pga]
        assert numbers == pytest.approx(expected, rel=1e-3)
        assert cells[-3] == ("yes" if one.ratio >= 1.0 else "no")
        for cell, chance in zip(cells[-2:], (one.at_allowed, one.at_site), strict=True):
            assert cell == with_interval(chance, " to ")


@pytest.mark.parametrize("lang", ["en", "it"])
def test_documents_have_the_same_lines(lang, made):
    folder, _printed, results = made
    dd.report(results, folder / f"{lang}.html", lang=lang)
    dd.calculation_report(results, folder / f"relazione_{lang}.html", lang=lang)
    for name in (f"{lang}.html", f"relazione_{lang}.html"):
        text = text_of(folder / name).replace(",", ".") if lang == "it" else text_of(folder / name)
        for one in side_by_side(results.check, results.fragility):
            for chance in (one.at_allowed, one.at_site):
                assert with_interval(chance, "\N{EN DASH}") in text, (name, one)


def test_the_page_has_the_same_lines_and_no_colour_of_a_probability(made, root):
    from dondolo.serve.bench import Bench

    settings = {
        "wall": {"mechanism": "one_sided", "height": 3.0, "thickness": 0.30},
        "stripes": {"im": "pga", "levels": [0.3, 0.4, 0.5, 0.6, 0.8]},
        "check": {
            "ag": [0.05, 0.13, 0.165], "f0": [2.5, 2.5, 2.5], "tc_star": [0.28, 0.30, 0.31], "soil": "B",
        },
    }  # fmt: skip
    answer = Bench(root / "data/records/synthetic44.csv").curve({"settings": settings, "lang": "en"})
    found = answer["check"]["lines"]
    _folder, _printed, results = made
    for one, line in zip(side_by_side(results.check, results.fragility), found, strict=True):
        for name in ("capacity", "demand", "ratio", "site_pga", "allowed_pga"):
            assert line[name] == pytest.approx(getattr(one, name), rel=1e-9)
        for name in ("at_allowed", "at_site"):
            assert line[name] == pytest.approx(list(getattr(one, name)), rel=1e-7)
        assert (line["verdict"], line["required"]) == (one.verdict, one.required)
    page = (root / "python/dondolo/serve/page/page.js").read_text()
    assert '[line.at_allowed, line.at_site].map((p) => make("td", { class: "n" }, chance(p)))' in page


def test_one_of_a_thing_is_singular(made):
    """No document counts one thing in the plural."""
    folder, printed, results = made
    texts = [printed, str(results.check), *(text_of(folder / f"{name}{lang}.html") for name in ("", "relazione_")
                                            for lang in ("en", "it"))]  # fmt: skip
    wrong = r"\b1 (of 1 )?(checks|walls|records|histories|levels|rows|designs|verifiche|pareti|storie|livelli|righe)\b"
    for text in texts:
        assert re.findall(rf"(?<![\d.,] )(?<![\d.,]){wrong}", text) == []
    one = results.check.dynamic(dd.synthetic_records(6.5, 10.0, "shallow", n_records=1))
    assert "of 1 history of 1 record" in str(one)
    assert "the check that the verdict rests on (nonlinear SLV)" in texts[2]
    assert "non soddisfatta la verifica su cui si fonda il giudizio (SLV non lineare)" in texts[3]
