"""Results that are saved to a file and read back."""

import dataclasses
import io
import json
import os
import types
import zipfile

import matplotlib.pyplot as plt
import numpy as np
import pytest
import study

import dondolo as dd
from dondolo._storage import saved, tables
from dondolo.curves.limited import Limits, limited

pytestmark = pytest.mark.filterwarnings("ignore::dondolo.errors.DondoloWarning")


@pytest.fixture(scope="module")
def results(stripes, few, wall):
    """A result of each kind."""
    curve = stripes.fit()
    slender = dd.TwoBlockWall(
        3.0, 0.25, overburden=8000.0, overburden_inertia=0.0, bearing="inner", bearing_distance=0.06
    )
    noted = few[0].correct_baseline().processed(few[0].acceleration, "noted")
    noted = dd.Record(noted.acceleration, noted.dt, "caffè", processing=noted.processing, metadata={"station": "NRC"})
    hazard = dd.HazardCurve([0.1, 0.2, 0.4], [0.01, 0.002, 0.0002])
    two = {"levels": [0.4, 0.8, 1.2], "progress": False}
    gone = dd.multiple_stripe(slender, few, estimate_error=True, **two)
    walls = [
        dd.OneSidedWall(1.5, 0.25, name="a"),
        dd.TwoBlockWall(
            3.0, 0.25, overburden=8000.0, overburden_inertia=0.0, bearing="inner", bearing_distance=0.06, name="a"
        ),
        dd.FreeStandingWall(4.0, 0.9, restitution_value=0.7, gravity=9.80665, name="caffè"),
        dd.TwoBlockWall(3.1, 0.27, restitution_factor=0.9, name="c"),
        dd.OneSidedWall(1.8, 0.25, name="d"),
    ]
    groups, p_occ = ["low", "low", "high", "low", "high"], [0.4, 0.6, 1.0, 1.0, 0.5]
    population = dd.Population(walls, [2.0, 2.0, 0.5, 1.0, 1.0], group_names=groups, p_occ=p_occ, origin=["a survey"])
    people = dd.typology(population, few, edp_thresholds=[0.1, 0.4], polarity="both", **two)
    one = dd.typology(walls[:1] + walls[-1:], few, **two)
    strip, wide = dd.TwoBlockWall(3.0, 0.25), [0.4, 0.6, 0.8, 1.0, 1.2, 1.5, 2.0]
    shaking = dd.synthetic_records(magnitude=6.5, distance=10.0, site="shallow", n_records=20)
    return {
        "fragility": curve,
        "no fit": gone.fit(),
        "counts": dd.fit_fragility([0.2, 0.4, 0.6], [0, 0, 0], [10, 10, 10]),
        "stripes": stripes,
        "stripes with errors": gone,
        "response": dd.simulate(slender, noted, scale=3.0, history=True),
        "response without history": dd.simulate(dd.FreeStandingWall(2.0, 0.5), noted, history=False),
        "incremental": stripes.incremental(),
        "first collapses": stripes.incremental().fit(),
        "cloud": dd.cloud(wall, [noted, *few], scale=2.0, progress=False),
        "curve of a cloud": dd.cloud(wall, [noted, *few], scale=2.0, progress=False).fit(0.4),
        "overturning": dd.overturning_spectrum(
            wall, dd.pulses.ricker, frequencies=[0.5, 1.0, 2.0], amplitudes=[0.2, 0.5, 1.0, 2.0], progress=False
        ),
        "intensities": dd.compare_intensities(wall, few, ims=["pga", "pgv"], progress=False),
        "comparison": curve.compare(gone.fit()) if gone.fit().has_fit else curve.compare(curve),
        "designs": dd.compare_designs(
            {"as it stands": wall, "folds": slender, "never": dd.OneSidedWall(1.5, 1.4)},
            few,
            [0.4, 0.8, 1.2],
            steel={"folds": 3.0},
            progress=False,
        ),
        "uncertain wall": dd.propagate_uncertainty(
            strip, shaking, wide, sources={"hinge": dd.distributions.Uniform(0.5, 0.7)}, n_variants=10, progress=False
        ),
        "hinges": dd.weakest_hinge(strip, shaking, wide, hinges=[0.5, 0.6, 0.7], progress=False),
        "bootstrap": curve.bootstrap(n_resamples=20),
        "goodness": curve.goodness_of_fit(n_resamples=20),
        "error of the model": curve.with_model_error(-0.1, 0.3),
        "hazard": hazard,
        "power law": dd.HazardCurve.power_law(1e-4, 2.0),
        "risk": curve.risk(hazard),
        "risk of a power law": curve.risk(dd.HazardCurve.power_law(1e-4, 2.0)),
        "spectrum": few[0].spectrum([0.1, 0.5, 1.0]),
        "records": dd.RecordSet.of_levels({0.2: few, 0.4: dd.RecordSet(few[:1], factor=2.0)}),
        "target": dd.TargetSpectrum([0.1, 0.5, 1.0], [0.5, 0.4, 0.2], dispersion=0.6).conditional(0.5, 0.8),
        "selection": dd.RecordSet(few).select(dd.TargetSpectrum.ec8(0.3, periods=[0.1, 0.5, 1.0]), 1, max_factor=100.0),
        "discrete": dd.DiscreteFragility([0.1, 0.2, 0.4], [0.0, 0.25, 0.75]),
        "fragility model": dd.results.FragilityModel(
            functions={"a": {"c": dd.Fragility.of_parameters(0.5, 0.4, im="pga")}},
            limits={"a": Limits(None, 0.1, 2.0)},
            id="m",
            description="walls",
            asset_category="buildings",
            loss_category="structural",
        ),
        "limited": limited(dd.Fragility.of_parameters(0.5, 0.4, im="pga"), Limits(0.1, 0.1, 2.0)),
        "discrete with a limit": dd.DiscreteFragility([0.0, 0.2, 0.4], [0.0, 0.25, 0.75], no_damage_limit=0.05),
        "code check": dd.check_ntc(dd.OneSidedWall(3.0, 0.25), dd.Site(ag=0.2, f0=2.5, tc_star=0.35, soil="B")),
        "typology": people,
        "one mechanism": one,
        "group": people.groups[0],
        "population curve": people["all"],
        "curve of a group": people["two_block", "low"],
        "risk of a population": people["all"].risk(hazard),
        "uncertainty of a risk": curve.risk(
            dd.HazardCurve([0.1, 1.0], [0.1, 1e-3], fractiles={0.84: [0.2, 2e-3]})
        ).uncertainty(n_draws=100),
        "typology bootstrap": people["all"].bootstrap(n_resamples=10),
    }


def check_same(one, other, where):
    """Equal to the bit, in type too."""
    assert type(one) is type(other), where
    if isinstance(one, np.ndarray | np.generic):
        assert (one.dtype, one.shape, one.tobytes()) == (other.dtype, other.shape, other.tobytes()), where
    elif isinstance(one, tuple | list):
        assert len(one) == len(other), where
        for i, pair in enumerate(zip(one, other, strict=True)):
            check_same(*pair, f"{where}[{i}]")
    elif isinstance(one, dict | types.MappingProxyType):
        check_same(list(one.items()), list(other.items()), where)
    elif dataclasses.is_dataclass(one):
        # Also what is no field: numbers that a wall derives
        passing = (
            "_handle",
            "_home",
            "_states",
            "_starts",
            "_walls",
            "members",
            "first_rows",
            "checksum",
            "_labels",
            "_chosen",
        )
        passing += ("_flat", "event")
        kept = [{name: x for name, x in vars(y).items() if name not in passing} for y in (one, other)]
        assert kept[0].keys() == kept[1].keys(), where
        for name, value in kept[0].items():
            check_same(value, kept[1][name], f"{where}.{name}")
    else:
        assert repr(one) == repr(other), where


def test_every_result_is_read_back(results, tmp_path):
    for name, result in results.items():
        path = tmp_path / f"{name}.npz"
        result.save(path)
        again = dd.load(path)
        check_same(result, again, name)
        assert (str(result), repr(result)) == (str(again), repr(again)), name
        # A copy of it is the same file.
        again.save(tmp_path / "again.npz")
        assert (tmp_path / "again.npz").read_bytes() == path.read_bytes(), name


def test_every_table_can_be_written(results, tmp_path):
    """A result that gives pandas a table writes it to a file as well, but for sets of records, whose is a catalogue.

    A history whose motion was not kept has none.
    """
    pandas = pytest.importorskip("pandas")
    path = tmp_path / "table.csv"
    for name, result in results.items():
        if not hasattr(result, "to_frame") or isinstance(result, dd.RecordSet) or getattr(result, "time", 0) is None:
            continue
        result.to_csv(path)
        lines = path.read_text().splitlines()
        assert lines[0].startswith("# dondolo "), name
        assert sum(not line.startswith("#") for line in lines) > 1, name
        if isinstance(result, tables.Tabular | dd.results.RiskUncertainty):
            head = sum(line.startswith("#") for line in lines)
            assert head > 1, name
            read, frame = pandas.read_csv(path, skiprows=head), result.to_frame()
            # In a file an empty word is nothing.
            words = list(frame.select_dtypes(["object", "string"]))
            read[words] = read[words].astype(object).fillna("")
            pandas.testing.assert_frame_equal(read, frame, check_dtype=False, rtol=1e-15, obj=name)


def test_every_kind_of_result_is_tried(results):
    tried = {type(result) for result in results.values()}
    assert {kind for kind in saved._TYPES.values() if issubclass(kind, saved.Saved)} == tried


@pytest.mark.parametrize("name", ["fragility", "stripes", "response", "incremental", "cloud", "overturning", "risk"])
def test_a_loaded_result_draws_and_computes(results, name, tmp_path):
    result, path = results[name], tmp_path / "result.npz"
    result.save(path)
    pictures = []
    for one in (result, dd.load(path)):
        axes = np.ravel(one.plot())[0]
        with io.BytesIO() as file:
            axes.figure.savefig(file, format="raw", dpi=30)
            pictures.append(file.getvalue())
        plt.close(axes.figure)
    assert pictures[0] == pictures[1]


def test_a_loaded_result_goes_on(results, tmp_path):
    for name in ("stripes", "cloud", "fragility", "risk"):
        results[name].save(tmp_path / f"{name}.npz")
    stripes, cloud, curve, risk = (
        dd.load(tmp_path / f"{name}.npz") for name in ("stripes", "cloud", "fragility", "risk")
    )
    check_same(stripes.fit(), results["fragility"], "fit")
    check_same(cloud.against("pgv"), results["cloud"].against("pgv"), "against")
    check_same(curve.bootstrap(n_resamples=20), results["bootstrap"], "bootstrap")
    assert risk.probability(50.0) == results["risk"].probability(50.0)
    motion = dd.simulate(stripes.wall, cloud.records[0])
    check_same(motion, dd.simulate(results["stripes"].wall, results["cloud"].records[0]), "simulate")


@pytest.mark.parametrize(
    "wall",
    [
        dd.OneSidedWall(3.1, 0.27, density=1900.0, gravity=9.80665, name="naïve: a, 'b'"),
        dd.OneSidedWall(3.0, 0.25, restitution="sorrentino", restitution_factor=0.9),
        dd.FreeStandingWall(2.0, 0.5, restitution_value=0.7),
        dd.TwoBlockWall(3.0, 0.25, hinge=0.6, restitution="impulse"),
        dd.TwoBlockWall(3.0, 0.25, overburden=5000.0, overburden_inertia=0.0, bearing="outer", bearing_distance=0.05),
    ],
    ids=lambda wall: wall.name,
)
def test_walls(wall, few, tmp_path):
    """A wall that is made again from its numbers is the same in all that it derives."""
    response = dd.simulate(wall, few[0])
    response.save(tmp_path / "response.npz")
    check_same(response, dd.load(tmp_path / "response.npz"), wall.name)


def test_a_loaded_typology_goes_on(results, tmp_path):
    """States, bootstrap and risk of what was read are those of what was saved."""
    results["typology"].save(tmp_path / "typology.npz")
    one, other = results["typology"], dd.load(tmp_path / "typology.npz")
    check_same(one.at(0.4), other.at(0.4), "state")
    for key in ("all", ("two_block", "low")):
        check_same(one[key].bootstrap(n_resamples=10), other[key].bootstrap(n_resamples=10), "bootstrap")
        check_same(
            one.at(0.4)[key].bootstrap(n_resamples=10),
            other.at(0.4)[key].bootstrap(n_resamples=10),
            "bootstrap of a state",
        )
        risks = [people[key].risk(results["hazard"]) for people in (one, other)]
        assert risks[0].probability(50.0) == risks[1].probability(50.0)
    results["one mechanism"].save(tmp_path / "one.npz")
    results["one mechanism"].write_results(tmp_path / "a")
    dd.load(tmp_path / "one.npz").write_results(tmp_path / "b")
    for name in ("run.json", "typology.csv", "fragility.csv", "stripes.csv", "walls.csv"):
        assert study.nameless(tmp_path / f"a_{name}") == study.nameless(tmp_path / f"b_{name}"), name
    # What was read back from tables has no flags
    stored = dd.read_results(tmp_path / "a").typology
    stored.save(tmp_path / "stored.npz")
    check_same(stored, dd.load(tmp_path / "stored.npz"), "stored")
    check_same(stored["all"], dd.load(tmp_path / "stored.npz")["all"], "stored curve")


def test_functions_are_not_saved(results, tmp_path):
    risk = dd.FunctionFragility(lambda x: np.minimum(x, 1.0)).risk(results["hazard"])
    with pytest.raises(dd.errors.InputError, match=r"^Risk\.fragility: a FunctionFragility cannot be saved$"):
        risk.save(tmp_path / "risk.npz")
    assert os.listdir(tmp_path) == []


def test_arrays_are_read_only_and_stored_once(results, tmp_path):
    path = tmp_path / "curve.npz"
    curve = results["fragility"]
    curve.save(path)
    with pytest.raises(ValueError, match="read-only"):
        dd.load(path).levels[0] = 1.0
    # NumPy reads it, and nothing in it is pickled.
    with np.load(path, allow_pickle=False) as archive:
        assert (
            sum(
                np.array_equal(archive[name], curve.sample.collapsed)
                for name in archive.files
                if name != "dondolo.json"
            )
            == 1
        )


def comparison(interval):
    """A result with any values."""
    names = ("ratio", "p_value", "beta_ratio", "beta_p_value", "curves_p_value", "degrees_of_freedom")
    numbers = dict.fromkeys(names, 0.5)
    return dd.results.Comparison(
        pairing="paired", shared=3, ratio_interval=interval, beta_interval=(0.5, 2.0), **numbers
    )


def test_values_that_json_lacks(tmp_path):
    path = tmp_path / "result.npz"
    values = (np.nan, np.inf, -np.inf, -0.0, 5e-324, 0.1 + 0.2, np.float64(0.1), np.int8(-3), np.bool_(True))
    values += ("caffè\n\udc80", True, 2**70, None, [1, (2.5,)], {"a": (1, [])}, {3: np.array([], dtype=np.int8)})
    values += (np.array(["a", "bcd"]), np.asfortranarray(np.arange(6.0).reshape(2, 3))[:, ::2], np.float64("nan"), ())
    comparison(values).save(path)
    check_same(values, dd.load(path).ratio_interval, "values")


@pytest.mark.parametrize(
    ("value", "message"),
    [
        (print, r"Comparison\.ratio_interval\[0\]: a builtin_function_or_method cannot be saved"),
        (np.array([None]), r"Comparison\.ratio_interval\[0\]: an array of objects cannot be saved"),
        (np.ma.array([1.0]), r"Comparison\.ratio_interval\[0\]: a MaskedArray cannot be saved"),
        ({"a": 1j}, r"Comparison\.ratio_interval\[0\]\['a'\]: a complex cannot be saved"),
    ],
)
def test_what_cannot_be_saved(value, message, tmp_path):
    result = comparison((value,))
    with pytest.raises(dd.errors.InputError, match=f"^{message}$"):
        result.save(tmp_path / "result.npz")
    assert os.listdir(tmp_path) == []


def test_paths(results, tmp_path):
    curve, path = results["counts"], tmp_path / "curve.npz"
    for wrong in ("curve", "curve.csv", "curve.NPZ", ".npz"):
        with pytest.raises(dd.errors.InputError, match=r"must end in \.npz$"):
            curve.save(tmp_path / wrong)
    with pytest.raises(dd.errors.InputError, match="must be the path of a file"):
        curve.save(3)
    with pytest.raises(dd.errors.DondoloError, match="cannot be written: No such file"):
        curve.save(tmp_path / "none" / "curve.npz")
    np.savez(path, edp=[1.0])
    before = path.read_bytes()
    with pytest.raises(dd.errors.InputError, match=r"curve\.npz: exists, and is not a saved result of dondolo$"):
        curve.save(path)
    with pytest.raises(dd.errors.InputError, match=r"curve\.npz: is not a result saved by dondolo$"):
        dd.load(path)
    assert path.read_bytes() == before
    path.unlink()
    with pytest.raises(dd.errors.MissingFileError, match=r"curve\.npz: cannot be read: No such file"):
        dd.load(path)
    with pytest.raises(dd.errors.InputError, match="cannot be read: Is a directory"):
        dd.load(tmp_path)
    curve.save(str(path))
    results["hazard"].save(path)
    check_same(dd.load(path), results["hazard"], "hazard")
    assert os.listdir(tmp_path) == ["curve.npz"]


def rewritten(path, change):
    """Write a file again with another content, its check sums right."""
    with zipfile.ZipFile(path) as archive:
        members = {name: archive.read(name) for name in archive.namelist()}
    content = json.loads(members["dondolo.json"])
    change(content)
    members["dondolo.json"] = json.dumps(content)
    with zipfile.ZipFile(path, "w") as archive:
        for name, data in members.items():
            archive.writestr(name, data)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (
            lambda c: c.update(format_version=2, dondolo="9.1"),
            r"was saved by dondolo 9\.1 in format 2; this is \S+, which",
        ),
        (lambda c: c.update(result={"Tower": {}}), "Tower: is not a type of result in this version"),
        (lambda c: c["result"]["HazardCurve"].pop("im"), "HazardCurve: has no field 'im'"),
        (lambda c: c["result"]["HazardCurve"].update(more=1), "HazardCurve: has an unknown field 'more'"),
        (lambda c: c["result"]["HazardCurve"].update(im="xyz"), "xyz"),
        (lambda c: c["result"]["HazardCurve"].update(levels={"array": "9.npy"}), "9.npy"),
        (lambda c: c.update(result={"float": []}), "argument must be"),
        (lambda c: c.update(result={}), "unpack"),
        (lambda c: c.update(result={"HazardCurve": 3}), "int"),
        (lambda c: c.pop("result"), "is damaged"),
        (lambda c: c.update(format_version="x"), "is damaged"),
    ],
)
def test_contents_that_are_refused(results, tmp_path, change, message):
    path = tmp_path / "hazard.npz"
    results["hazard"].save(path)
    rewritten(path, lambda content: None)
    check_same(dd.load(path), results["hazard"], "hazard")
    rewritten(path, change)
    with pytest.raises(dd.errors.InputError, match=rf"^\S+hazard\.npz: .*{message}") as error:
        dd.load(path)
    assert "\n" not in str(error.value)


def test_damaged_files(results, tmp_path):
    """A file that is cut, or has a member with a changed byte, is refused in one line."""
    path = tmp_path / "hazard.npz"
    results["hazard"].save(path)
    whole = path.read_bytes()
    data = set()
    with zipfile.ZipFile(path) as archive:
        for member in archive.infolist():
            start = member.header_offset + 30
            start += sum(int.from_bytes(whole[start - i : start - i + 2], "little") for i in (4, 2))
            data |= set(range(start, start + member.file_size))
    assert len(data) > 0.5 * len(whole)
    files = [(True, whole[:n]) for n in range(0, len(whole), 7)]
    for i, byte in enumerate(whole):
        files += [(i in data, whole[:i] + bytes([byte ^ bits]) + whole[i + 1 :]) for bits in (1 << i % 8, 0xFF)]
    for lost, damaged in files:
        path.write_bytes(damaged)
        sentence = ""
        try:
            check_same(dd.load(path), results["hazard"], "hazard")
        except dd.errors.InputError as error:
            sentence = str(error)
        assert not lost or sentence
        assert not sentence or (sentence.startswith(f"{path}: ") and "\n" not in sentence)


def test_pickles_are_not_read(results, tmp_path):
    path = tmp_path / "hazard.npz"
    results["hazard"].save(path)
    with zipfile.ZipFile(path, "a") as archive, archive.open("9.npy", "w") as member:
        np.lib.format.write_array(member, np.array([{}]), allow_pickle=True)
    with pytest.raises(dd.errors.InputError, match="is damaged"):
        dd.load(path)
