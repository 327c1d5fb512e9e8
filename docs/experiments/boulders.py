"""Granite boulders on a shake table, from a clone of the repository that a user has.

Nothing of that repository is in this one: its table of tests and its motions are read from the user's folder, and only
statistics that summarise all tests leave this module.
"""

import hashlib
import re
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from pathlib import Path

import motions
import numpy as np
import scores
import workbook
from scipy.special import ndtr

import dondolo as dd

#: Frequency parameter of the block by the scan of the boulders [rad/s]
FREQUENCY = 4.4147
#: Tests of at least this PGV/PGA [s] are nearly static; the effective slenderness is found on them
NEARLY_STATIC = 0.09
#: Slendernesses that are tried [rad], and the difference of two counts of falls that two right integrators may have
ALPHAS = np.round(np.arange(0.060, 0.1601, 0.001), 3)
ALIKE = 2
#: Peaks at which every motion runs, in steps of 4 % [g]
PEAKS = 0.03 * 1.04 ** np.arange(140)
#: Files of at least this size are those of the blind half [bytes]
LARGE = 4 * 2**20
BLIND = 92
SPECIMENS = ("1", "2")
#: Bands of the blind half, written before anybody ran it: share of right flags, nearly static tests and the others
BANDS = {"1": (0.85, 0.65), "2": (0.85, 0.75)}
TABLES = ("Results_Granite.xlsx", "PGVA-zchen.xlsx", "Earthquake_Records_Info.xlsx")


@dataclass(frozen=True)
class Tests:
    """Tests of the boulders, in the order of their numbers.

    Attributes
    ----------
    names : list of str
        Names of the files of motions.
    fell : dict of ndarray
        Whether each specimen overturned.
    simulated : dict of ndarray, shape (simulations, tests)
        The same by the simulations of the authors of the tests.
    pgv, pace : ndarray
        PGV of the published table [m/s] and PGV/PGA [s].
    waveforms, dates : ndarray of str
        Waveform whose scaled motion the table made, and day of the test.
    motions : list of (ndarray, float)
        Acceleration [m/s2] and step [s].
    """

    names: list
    fell: dict
    simulated: dict
    pgv: np.ndarray
    pace: np.ndarray
    waveforms: np.ndarray
    dates: np.ndarray
    motions: list

    @property
    def nearly_static(self) -> np.ndarray:
        """Which tests are nearly static."""
        return self.pace >= NEARLY_STATIC


def files_of(folder: Path, *, large: bool = False) -> list[Path]:
    """Files of motions in a folder, those of the open or of the blind half, in the order of their numbers."""
    there = [path for path in folder.glob("Test*.txt") if (path.stat().st_size >= LARGE) == large]
    return sorted(there, key=lambda path: int(re.findall(r"\d+", path.name)[0]))


def digest(paths: list[Path]) -> str:
    """One sha256 of several files: of the lines `name sha256` of each."""
    whole = hashlib.sha256()
    for path in paths:
        whole.update(f"{path.name} {hashlib.sha256(path.read_bytes()).hexdigest()}\n".encode())
    return whole.hexdigest()


def read(folder: Path, cache: Path, *, large: bool = False, **processing) -> Tests:
    """Read tables and motions.

    Parameters
    ----------
    folder : Path
        The folder of the clone that holds them.
    cache : Path
        Folder in which the columns of the motions are kept: reading the texts takes a minute.
    large : bool
        Whether to read the blind half instead of the open one.
    **processing
        Of `motions.table_motion`, to see what it changes.

    Returns
    -------
    Tests
    """
    results, measures, records = (workbook.rows(folder / name) for name in TABLES)
    names = results[0]
    by_number = {int(float(row[0])): row for row in results[1:]}
    intensity = {int(float(row[1])): (float(row[2]), float(row[3])) for row in measures[1:]}
    about = {int(float(row[0])): row for row in records if row and re.fullmatch(r"\d+(\.0)?", row[0])}
    paths = files_of(folder, large=large)
    numbers = [int(re.findall(r"\d+", path.name)[0]) for path in paths]
    columns = {
        specimen: [i for i, name in enumerate(names) if name.startswith(f"Specimen {specimen}-")]
        for specimen in SPECIMENS
    }
    pga, pace = np.array([intensity[number] for number in numbers]).T
    return Tests(
        names=[path.stem for path in paths],
        fell={
            specimen: np.array([float(by_number[number][1 + i]) == 1.0 for number in numbers])
            for i, specimen in enumerate(SPECIMENS)
        },
        simulated={
            specimen: np.array([[float(by_number[number][i]) == 1.0 for number in numbers] for i in columns[specimen]])
            for specimen in SPECIMENS
        },
        pgv=pga * pace * motions.GRAVITY,
        pace=pace,
        waveforms=np.array([about[number][3].strip() for number in numbers]),
        dates=np.array([about[number][1] for number in numbers]),
        motions=[motions.table_motion(one, **processing) for one in _columns(paths, cache, large)],
    )


def _columns(paths: list[Path], cache: Path, large: bool) -> list[np.ndarray]:
    """Accelerations as measured [g], from the cache if it is of these files."""
    store = cache / f"granite_{'large' if large else 'small'}.npz"
    key = " ".join(f"{path.name}:{path.stat().st_size}" for path in paths)
    if store.is_file():
        with np.load(store) as kept:
            if str(kept["key"]) == key:
                return np.split(kept["values"], kept["ends"][:-1])
    with ProcessPoolExecutor() as pool:
        found = list(pool.map(motions.second_column, paths, chunksize=8))
    cache.mkdir(parents=True, exist_ok=True)
    np.savez(store, key=key, values=np.concatenate(found), ends=np.cumsum([len(one) for one in found]))
    return found


def block(alpha: float) -> dd.FreeStandingWall:
    """A block with the frequency parameter of the scan and an effective slenderness [rad]."""
    radius = 0.75 * motions.GRAVITY / FREQUENCY**2
    return dd.FreeStandingWall(2.0 * radius * np.cos(alpha), 2.0 * radius * np.sin(alpha), name="boulder")


def records_of(tests: Tests) -> list[dd.Record]:
    """The measured motions, unscaled."""
    return [dd.Record(motion, dt, name=name) for (motion, dt), name in zip(tests.motions, tests.names, strict=True)]


def flags(records: list[dd.Record], alphas) -> np.ndarray:
    """Whether blocks of several slendernesses fall under each measured motion, (slendernesses, tests)."""
    walls = [block(alpha) for alpha in alphas]
    return np.array([[dd.simulate(wall, one, history=False).collapsed for one in records] for wall in walls])


def smallest_factors(records: list[dd.Record], alpha: float) -> np.ndarray:
    """Smallest factor on each motion at which the computed block falls, on a grid of 4 %.

    A minimum over outcomes that are not monotonic: it is biased low.
    """
    peaks = np.array([record.peak_acceleration for record in records]) / motions.GRAVITY
    units = [
        dd.Record(record.acceleration / peak, record.dt, name=record.name)
        for record, peak in zip(records, peaks, strict=True)
    ]
    fell = dd.multiple_stripe(block(alpha), units, PEAKS, progress=False).collapsed
    if not fell.any(axis=0).all():
        raise SystemExit(f"granite: at {PEAKS[-1]:.1f} g a motion does not overturn the block; PEAKS must go higher")
    return PEAKS[np.argmax(fell, axis=0)] / peaks


def identified(computed: np.ndarray, fell: np.ndarray, weights=None) -> tuple[int, list[int]]:
    """The slenderness whose computed falls are as many as the measured ones.

    Parameters
    ----------
    computed : ndarray, shape (slendernesses, tests)
        Computed flags of the nearly static tests.
    fell : ndarray, shape (tests,)
        Measured ones.
    weights : ndarray, optional
        How often each test counts.

    Returns
    -------
    index : int
        Halfway between the first and the last of those that fit, in `ALPHAS`.
    all : list of int
        Those whose numbers of falls differ from the measured one by `ALIKE` at most, or as little as any.
    """
    w = np.ones(len(fell)) if weights is None else weights
    difference = np.abs(computed @ w - fell @ w)
    fits = np.flatnonzero(difference <= max(ALIKE, difference.min())).tolist()
    return (fits[0] + fits[-1]) // 2, fits


def statistics(tests: Tests, records: list[dd.Record], n_resamples: int = 1000) -> dict:
    """Every number of the campaign, for both specimens.

    Parameters
    ----------
    tests : Tests
        The tests.
    records : list of Record
        Their motions.
    n_resamples : int
        Samples of the bootstrap over waveforms; the slenderness is found anew in each.

    Returns
    -------
    dict
        By specimen.
    """
    computed, factors = flags(records, ALPHAS), _Factors(records)
    return {name: _of_specimen(name, tests, computed, factors, n_resamples) for name in SPECIMENS}


def _of_specimen(name: str, tests: Tests, computed, factors, n_resamples: int) -> dict:
    """Statistics of one specimen."""
    near, fell = tests.nearly_static, tests.fell[name]
    rest = ~near
    chosen, alike = identified(computed[:, near], fell[near])
    flag = computed[chosen]
    found = {
        "alpha": float(ALPHAS[chosen]),
        "alpha_from": float(ALPHAS[alike[0]]),
        "alpha_to": float(ALPHAS[alike[-1]]),
        "identified_on": scores.rightness(flag[near], fell[near]),
        "test": scores.rightness(flag[rest], fell[rest]),
        "all": scores.rightness(flag, fell),
        "yardsticks": _yardsticks(tests, name),
    }
    measured = scores.fit_lognormal(tests.pgv[rest], fell[rest])
    ours = scores.fit_lognormal(tests.pgv[rest], flag[rest])
    single = scores.fit_lognormal(1.0 / factors(chosen), fell)

    def curve(weights):
        anew, _ = identified(computed[:, near], fell[near], weights[near])
        a = scores.fit_lognormal(tests.pgv[rest], fell[rest], weights[rest])
        b = scores.fit_lognormal(tests.pgv[rest], computed[anew][rest], weights[rest])
        return [np.log(a.theta / b.theta), a.beta / b.beta]

    def alone(weights):
        anew, _ = identified(computed[:, near], fell[near], weights[near])
        one = scores.fit_lognormal(1.0 / factors(anew), fell, weights)
        return [np.log(one.theta), one.beta]

    se = scores.bootstrap(tests.waveforms, curve, n_resamples)
    se_single = scores.bootstrap(tests.waveforms, alone, n_resamples)
    found["curve"] = {
        "im": "published PGV, m/s",
        "theta_measured": measured.theta,
        "beta_measured": measured.beta,
        "theta_computed": ours.theta,
        "beta_computed": ours.beta,
        "bias": float(np.log(measured.theta / ours.theta)),
        "se_bias": float(se[0]),
        "beta_ratio": measured.beta / ours.beta,
        "se_beta_ratio": float(se[1]),
        "motions": int(rest.sum()),
    }
    # What the minimum of outcomes that are not monotonic does to a model without error
    faultless = scores.fit_lognormal(1.0 / factors(chosen), flag)
    predicted = ndtr(np.log(1.0 / factors(chosen) / single.theta) / single.beta)
    found["single_motion"] = {
        "n": len(fell),
        "bias": float(np.log(single.theta)),
        "se_bias": float(se_single[0]),
        "beta_single": single.beta,
        "se_beta_single": float(se_single[1]),
        "bias_of_computed_outcomes": float(np.log(faultless.theta)),
        "beta_of_computed_outcomes": faultless.beta,
        "right": float(np.mean((1.0 / factors(chosen) >= 1.0) == fell)),
        **scores.reliability(predicted, fell),
    }
    found["splits"] = _splits(tests, name, flag)
    return found


class _Factors:
    """Smallest factors of every second slenderness, computed when they are asked for."""

    def __init__(self, records) -> None:
        self._records, self._known = records, {}

    def __call__(self, index: int) -> np.ndarray:
        index -= index % 2
        if index not in self._known:
            self._known[index] = smallest_factors(self._records, float(ALPHAS[index]))
        return self._known[index]


def _yardsticks(tests: Tests, name: str) -> dict:
    """Shares of right flags that need no model of a block, and those of the authors' own simulations."""
    near, fell = tests.nearly_static, tests.fell[name]
    rest = ~near
    level = scores.best_threshold(tests.pgv[near], fell[near])
    across = scores.threshold_across(tests.pgv[rest], fell[rest], tests.waveforms[rest])
    theirs = [float(np.mean(one[rest] == fell[rest])) for one in tests.simulated[name]]
    return {
        "always_stands": float(np.mean(~fell[rest])),
        "one_pgv_threshold_of_nearly_static_tests": float(np.mean((tests.pgv[rest] >= level) == fell[rest])),
        "one_pgv_threshold_of_other_waveforms": float(np.mean(across == fell[rest])),
        "one_pgv_threshold_of_other_waveforms_all_tests": float(
            np.mean(scores.threshold_across(tests.pgv, fell, tests.waveforms) == fell)
        ),
        "simulations_of_the_authors": len(theirs),
        "best_simulation_of_the_authors": max(theirs),
        "worst_simulation_of_the_authors": min(theirs),
    }


def _splits(tests: Tests, name: str, flag) -> dict:
    """Shares of right flags of the test by season, and over waveforms."""
    rest, fell = ~tests.nearly_static, tests.fell[name]
    august = np.char.startswith(tests.dates, "202108")
    found = {}
    for what, chosen in (("june_july", rest & ~august), ("august", rest & august)):
        other = tests.fell["2" if name == "1" else "1"]
        found[what] = {
            **scores.rightness(flag[chosen], fell[chosen]),
            "fell_alone_of_all_tests": int(np.sum(fell & ~other & (august == (what == "august")))),
            "nearly_static_falls": int(np.sum(fell & tests.nearly_static & (august == (what == "august")))),
        }
    shares = [
        float(np.mean(flag[here] == fell[here]))
        for one in dict.fromkeys(tests.waveforms[rest].tolist())
        if (here := rest & (tests.waveforms == one)).any()
    ]
    found["waveforms"] = {
        "n": len(shares),
        "all_right": int(np.sum(np.array(shares) == 1.0)),
        "less_than_half_right": int(np.sum(np.array(shares) < 0.5)),
    }
    return found


def processing_effect(tests: Tests, variants: dict[str, list[dd.Record]], found: dict) -> dict:
    """How much other processings of the same motions change, by specimen and processing.

    Parameters
    ----------
    tests : Tests
        The tests.
    variants : dict of list of Record
        Motions by what was changed; the first ones are unchanged.
    found : dict
        Statistics of the unchanged ones.

    Returns
    -------
    dict
        Flags that differ of all tests, share of right flags and bias of the curve on the test.
    """
    rest, effect = ~tests.nearly_static, {}
    for name in SPECIMENS:
        runs = {what: flags(records, [found[name]["alpha"]])[0] for what, records in variants.items()}
        unchanged = next(iter(runs.values()))
        measured = scores.fit_lognormal(tests.pgv[rest], tests.fell[name][rest])
        effect[name] = {
            what: {
                "flags_changed": int(np.sum(flag != unchanged)),
                "right": float(np.mean(flag[rest] == tests.fell[name][rest])),
                "bias": float(np.log(measured.theta / scores.fit_lognormal(tests.pgv[rest], flag[rest]).theta)),
            }
            for what, flag in runs.items()
        }
    return effect


def hold(tests: Tests, alphas: dict) -> dict:
    """The blind half: shares of right flags of the two strata beside their bands."""
    records, found = records_of(tests), {}
    for name in SPECIMENS:
        flag = flags(records, [alphas[name]])[0]
        for i, (what, chosen) in enumerate((("nearly_static", tests.nearly_static), ("others", ~tests.nearly_static))):
            one = scores.rightness(flag[chosen], tests.fell[name][chosen])
            found[f"{name}, {what}"] = {**one, "band": BANDS[name][i], "inside": one["right"] >= BANDS[name][i]}
    return found
