"""Warnings that Python adds to those of the library: each is data, too, and documented."""

import ast
import json
import re
import warnings

import numpy as np
import pytest

import dondolo as dd
from dondolo.__main__ import main

SHORT = dd.HazardCurve([0.1, 0.2], [0.01, 0.002])


def functions_in_time():
    dd.FunctionFragility(lambda x: np.minimum(x, 1.0) ** 4).risk(dd.HazardCurve.power_law(1e-4, 2.0)).probability(50.0)


def own_table(path):
    path.write_text("pga;annual_frequency;F0\n0,1;0,01;2,4\n0,2;0,002;2,5\n")
    dd.HazardCurve.from_csv(path)


@pytest.mark.parametrize(
    ("call", "codes", "numbers"),
    [
        (lambda path: dd.fit_fragility([1.0, 2.0], [1, 2], 44), ["extrapolated"], ["first_level", "theta"]),
        (lambda path: functions_in_time(), ["function_of_one_wall"], []),
        (
            lambda path: dd.fit_fragility([0.2, 0.4], [11, 33], 44, im="pga").risk(SHORT),
            ["hazard_too_short"],
            ["lower_bound", "upper_bound"],
        ),
        (own_table, ["note", "columns_unused"], []),
    ],
    ids=["fit", "function", "hazard", "table"],
)
def test_codes(call, codes, numbers, tmp_path):
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        call(tmp_path / "table.csv")
    found = [one.message.as_data() for one in caught]
    assert [one["code"] for one in found] == codes
    assert set(numbers) <= set(found[-1]["numbers"])
    assert json.loads(json.dumps(found)) == found


def test_first_collapses(stripes):
    none = dd.multiple_stripe(stripes.wall, dd.Record([0.0, 0.1, 0.0], 0.01), [0.01], progress=False).incremental()
    with pytest.warns(dd.errors.DondoloWarning, match="no curve of first collapses") as caught:
        none.fit()
    assert (caught[0].message.code, caught[0].message.subject) == ("no_collapse", {"wall": "parapet"})


@pytest.mark.parametrize("ordinal", [False, True])
def test_what_a_run_has_warned_of_is_not_repeated(ordinal, root, tmp_path, monkeypatch, capsys):
    """A curve without a fit, and its damage states: the run warns, and what reads its results does not."""
    (tmp_path / "a.nml").write_text(
        "&job output = 'a' /\n&wall mechanism = 'one_sided', height = 1.5, thickness = 0.25 /\n"
        f"&records catalogue = '{root}/data/records/synthetic44.csv' /\n"
        f"&stripes levels = 0.2, 0.3, edp_thresholds = 0.4, 1.0, states = '{'ordinal' if ordinal else 'separate'}' /\n"
    )
    monkeypatch.chdir(tmp_path)
    with pytest.warns(dd.errors.DondoloWarning, match="no collapse at levels 0.2 to 0.3") as caught:
        made = dd.run_case("a.nml", progress=False)
    said = [one.message for one in caught]
    assert len(said) == len(set(said))
    made.write_results("a")
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        assert dd.read_results("a").run.warnings == tuple(said)
        # The command replaces how warnings are shown
        monkeypatch.setattr(warnings, "showwarning", warnings.showwarning)
        for arguments in (["plot"], ["report"], ["nrml"]):
            code = main([*arguments, "a"])
            assert code == (1 if arguments == ["nrml"] else 0)
    assert caught == []
    assert capsys.readouterr().err == "dondolo: a: has no curve (status 'no_collapse')\n"


def test_codes_of_the_library_are_documented(root):
    """A constant has the name of its code, and the page has them all."""
    page = (root / "docs/files.md").read_text()
    files = [*(root / "src/study/case/warnings").glob("*_warnings.f90"), root / "src/core/check/check_notes.f90"]
    heads = [re.search(r"(?s)   !> Codes.*?\n\n", path.read_text())[0] for path in files]
    codes = dict(re.findall(r"(\w+) = '(.*?)'", "".join(heads)))
    assert len(codes) >= 37
    assert list(codes) == list(codes.values())
    assert [code for code in codes if f"`{code}`" not in page] == []


def test_codes_are_documented(root):
    page = (root / "docs/files.md").read_text()
    calls = [
        node
        for path in (root / "python/dondolo").glob("**/*.py")
        for node in ast.walk(ast.parse(path.read_text()))
        if isinstance(node, ast.Call) and getattr(node.func, "id", "") == "DondoloWarning"
    ]
    codes = {call.args[1].value for call in calls if len(call.args) > 1 and isinstance(call.args[1], ast.Constant)}
    assert len(codes) >= 5
    assert [code for code in codes if f"`{code}`" not in page] == []
