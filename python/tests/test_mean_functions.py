"""Mean curves of populations as fragility functions: close to the means, ordered, and nothing left out."""

import subprocess
import sys
from itertools import pairwise

import numpy as np
import pytest
from test_nrml import check

import dondolo as dd
from dondolo.populations.combination import combine

pytestmark = pytest.mark.filterwarnings("ignore::dondolo.errors.DondoloWarning")

# Facades that overturn or fold, whose damage states cross
WALLS = """name,mechanism,height,thickness,hinge,overburden,overburden_inertia,restitution_factor,weight,group,p_occ
A1,one_sided,6.0,0.38,,,,,12,row,0.35
A1,two_block,3.0,0.38,0.55,1600,0,0.88,12,row,0.5
A2,one_sided,9.0,0.38,,,,,5,row,0.8
A2,two_block,3.3,0.25,0.6,0,,0.87,5,row,0.15
"""


def stored(centre):
    """The results of the illustrative centre."""
    return dd.read_results(centre).typology


@pytest.fixture(scope="module")
def centre(executable, root, tmp_path_factory):
    """Prefix of the files of the illustrative centre, under every fourth record."""
    folder = tmp_path_factory.mktemp("centre")
    head, rows = (root / "data/records/synthetic44.csv").read_text().split("component,pga_m_s2\n")
    rows = [f"{root}/data/records/{row}" for row in rows.splitlines(keepends=True)[::4]]
    (folder / "records.csv").write_text(f"{head}component,pga_m_s2\n{''.join(rows)}")
    case = (root / "data/cases/historic_centre.nml").read_text()
    case = case.replace("'../records/synthetic44.csv'", "'records.csv'").replace("'../walls", f"'{root}/data/walls")
    (folder / "case.nml").write_text(case)
    subprocess.run([executable, "--quiet", "case.nml"], cwd=folder, check=True)
    return folder / "out/historic_centre"


@pytest.fixture(scope="module")
def facades(recordings, tmp_path_factory):
    """Two facades under recorded motions."""
    table = tmp_path_factory.mktemp("facades") / "walls.csv"
    table.write_text(WALLS)
    levels = [0.1 * i for i in range(1, 16)]
    walls, records = dd.Population.from_csv(table), dd.read_catalogue(recordings / "italy44.csv")
    return dd.typology(walls, records, levels, polarity="both", edp_thresholds=[0.1, 0.4], progress=False)


def agree(people, functions, sentences):
    """Every curve is there, close to the mean where it was not raised, and never below it."""
    taxonomies = [f"{curve.group or 'population'}/{curve.mechanism}" for curve in people.groups]
    assert list(functions) == taxonomies
    names = [*(f"edp_{edp:g}".replace(".", "p") for edp in people.edp_thresholds[:-1]), "collapse"]
    for curve, (taxonomy, states) in zip(people.groups, functions.items(), strict=True):
        assert list(states) == names
        levels = states["collapse"].levels
        # They begin where there is next to nothing, and end where there is next to all.
        assert max(state.probability[0] for state in states.values()) <= 1e-9
        for state in states.values():
            assert state.probability[-1] >= 0.998 * curve.upper_asymptote
        for lighter, heavier in pairwise(states.values()):
            assert np.all(lighter.probability >= heavier.probability)
        for edp, (name, state) in zip(people.edp_thresholds, states.items(), strict=True):
            x = np.geomspace(levels[0], levels[-1], 3001)
            mean = people.at(edp)[curve.mechanism, curve.group](x)
            line = np.interp(x, levels, state.probability)
            assert 12 <= len(levels) <= 40
            # Levels are where frequencies need them, and not where a curve bends at probabilities next to 1
            assert np.all(line >= mean - 0.011)
            raised = (line - mean).max() > 0.02
            assert not raised or any(one.startswith(f"'{taxonomy}', '{name}': raised") for one in sentences)


def frequency(curve):
    """Events a year under a hazard that is a power law."""
    x = np.geomspace(0.01, 8.0, 4001)
    p = curve(x)
    return 0.5 * (p[1:] + p[:-1]) @ -np.diff(2e-5 * x**-2.5)


@pytest.mark.slow
@pytest.mark.parametrize("which", ["facades", "centre"])
def test_functions_are_the_mean_curves(which, request, tmp_path):
    people = request.getfixturevalue(which)
    people = stored(people) if which == "centre" else people
    functions, sentences = people.nrml_functions()
    agree(people, functions, sentences)
    dd.write_nrml(tmp_path / "model.xml", functions)
    assert list(check(tmp_path / "model.xml")) == list(functions)
    # The curves of collapse are raised by nobody: their risk is that of the mean curve.
    for curve, states in zip(people.groups, functions.values(), strict=True):
        mean = frequency(lambda x, of=(curve.mechanism, curve.group): people[of](x))
        levels, p = (np.append(0.0, values) for values in (states["collapse"].levels, states["collapse"].probability))
        lines = frequency(lambda x, levels=levels, p=p: np.interp(x, levels, p))
        assert lines == pytest.approx(mean, rel=0.005)


def test_states_that_cross_are_raised_and_told(facades):
    functions, sentences = facades.nrml_functions()
    x = functions["population/two_block"]["edp_0p4"].levels
    mean = {edp: facades.at(edp)["two_block"](x) for edp in (0.4, 1.0)}
    lift = mean[1.0] - mean[0.4]
    most = np.argmax(lift)
    assert lift[most] > 1e-3
    raised = functions["population/two_block"]["edp_0p4"].probability
    np.testing.assert_array_equal(raised, np.maximum(mean[0.4], mean[1.0]))
    assert (
        f"'population/two_block', 'edp_0p4': raised by up to {lift[most]:.2g}, at {x[most]:.3g} g, where a more severe"
        " state is more probable"
    ) in sentences


def test_command(centre):
    """Nothing is left out of the illustrative centre."""
    done = subprocess.run(
        [sys.executable, "-m", "dondolo", "nrml", str(centre)], capture_output=True, text=True, check=False
    )
    assert done.returncode == 0
    number = len(stored(centre).groups)
    assert done.stdout == f"written: {centre}_fragility.xml ({number} functions)\n"
    assert len(check(f"{centre}_fragility.xml")) == number
    assert "left out" not in done.stderr


def test_walls_without_a_fit(records):
    """Their fractions are straight lines, which may decrease."""
    walls = [dd.OneSidedWall(0.5, 1.0, name="a"), dd.OneSidedWall(0.5, 1.2, name="b")]
    people = dd.typology(dd.Population(walls), records[:3], [0.1, 0.2], progress=False)
    functions, sentences = people.nrml_functions()
    assert not functions["population/one_sided"]["collapse"].probability.any()
    assert sentences == []
    wall = dd.OneSidedWall(1.5, 0.25, name="falls and stands")
    few = dd.typology([wall], records[6:8], [0.6, 0.9, 0.92, 0.94], progress=False)
    counts = few.exceedances.copy()
    counts[-1, :, 0] = [2, 1, 1, 1]
    given = (few.population, few.im, few.levels, few.edp_thresholds, counts, few.histories, np.ones(1, bool), few.work)
    people = combine(*given)
    assert people.curves[0].status == "decreasing"
    functions, sentences = people.nrml_functions()
    curve = functions["population/one_sided"]["collapse"]
    assert np.interp([0.3, 0.6, 0.9, 0.94], curve.levels, curve.probability) == pytest.approx([0.5, 1.0, 1.0, 1.0])
    assert sentences == ["'population/one_sided', 'collapse': raised by up to 0.5, at 0.94 g, where it decreases"]


def test_names(few):
    walls = [dd.OneSidedWall(1.5, 0.25, name=name) for name in "abc"]
    people = dd.Population(walls, group_names=["è'a", "è#a", "x y"])
    levels, close = [0.4, 0.6, 0.8, 1.0], [0.1, 0.10000001]
    functions, sentences = dd.typology(people, few, levels, edp_thresholds=close, progress=False).nrml_functions()
    assert list(functions) == ["population/one_sided", "è_a/one_sided", "è_a/one_sided_2", "x y/one_sided"]
    assert "'è_a/one_sided_2': is that of the group 'è#a'; 'è_a/one_sided' is another group's" in sentences
    # Thresholds that are nearly the same are two states.
    assert list(functions["è_a/one_sided"]) == ["edp_0p1", "edp_0p10000001", "collapse"]
