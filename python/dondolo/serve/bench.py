"""What the page shows: curves, checks and motions of the case that it sends, under one set of records.

The text of the case is all that is computed with: it is read by the library, so that the page and the executable cannot
differ.
"""

from __future__ import annotations

import functools
import pickle
import re
import threading
import time
import warnings
from collections import OrderedDict
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

import dondolo as dd
from dondolo._base.arguments import argument_error, as_number, one_of
from dondolo._fortran.checks import STATES
from dondolo._fortran.library import properties
from dondolo.analysis.stripes import Stripes
from dondolo.checks.ntc import CodeCheck
from dondolo.checks.side_by_side import StateLine, chance_at, side_by_side
from dondolo.curves.fragility import Fragility
from dondolo.errors import DondoloError, DondoloWarning, InputError, Problem, silent
from dondolo.exchange.case_text import Settings, case_text
from dondolo.exchange.cases import Case
from dondolo.records.codes import CHECK_OPTIONS
from dondolo.records.suite import intensities
from dondolo.records.synthetic import SYNTHETIC
from dondolo.reporting.language import LANGUAGES, Language
from dondolo.reporting.statuses import STATUSES
from dondolo.reporting.words import BENDING
from dondolo.reporting.words import warning as warning_in_words
from dondolo.serve.levels import chosen_levels
from dondolo.serve.pictures import motion_of, picture
from dondolo.walls.ties import ties_without_anchor

# Curves that are kept, for B and for a page that goes back
_KEPT = 12
# Factors on vertical components whose records are kept
_KEPT_FACTORS = 2
# Points of a curve
_POINTS = 161
# Groups of a case, in their order
_GROUPS = ("job", "wall", "building", "records", "stripes", "solver", "check")

# Variables that give the levels
_OF_LEVELS = ("levels", "first", "last", "count")

# A case of a chain of rigid bodies
_CHAIN = re.compile(r"""^[^!\n]*\bmechanism\s*=\s*(['"])chain\1""", re.MULTILINE | re.IGNORECASE)
# What follows from a property of a wall that is given
_FOLLOWS = {"section_height": "height", "section_thickness": "thickness", "restitution_value": "restitution"}


@dataclass(frozen=True)
class Motions:
    """Records, and parts of them for drafts and trials.

    A record remembers the suite that it was uploaded with last: parts have records of their own.
    """

    whole: tuple[dd.Record, ...]
    half: tuple[dd.Record, ...]
    few: tuple[dd.Record, ...]


@dataclass(frozen=True)
class Curve:
    """A curve that was computed, with its case and what was warned of."""

    case: Case
    text: str
    stripes: Stripes
    fragility: Fragility
    warnings: tuple[DondoloWarning, ...]


class Bench:
    """Records, and what walls do under them; one thing is computed at a time.

    Parameters
    ----------
    catalogue : path
        Catalogue of the accelerograms.
    threads : int
        Number of threads; 0: all.
    """

    def __init__(self, catalogue: Path, threads: int = 0) -> None:
        records = dd.read_catalogue(catalogue)
        if records.level is not None:
            raise InputError(f"{catalogue}: has levels for its records, which the page cannot show")
        self.catalogue, self.threads = catalogue, threads
        self.records: tuple[dd.Record, ...] = tuple(records)
        self.are_synthetic = any(record.metadata.get("format") == SYNTHETIC for record in self.records)
        self._plain = _motions(self.records)
        # Those with vertical components, by the factor on these
        self._vertical: OrderedDict[float, Motions] = OrderedDict()
        self._lock = threading.Lock()
        self._curves: OrderedDict[str, Curve] = OrderedDict()

    def open(self, text: str) -> dict[str, Any]:
        """The groups of a case for the page, without what has its default."""
        with self._lock, silent():
            case = self._opened(text)
        if case.task != "stripes":
            raise other_task(case)
        left = sorted(set(case.settings) - set(_GROUPS))
        if left:
            raise argument_error(
                "out_of_range", left[0], f": the page has no group &{left[0]}; run this case with dondolo"
            )
        return sparse(case.settings)

    def _opened(self, text: str) -> Case:
        """A case, with the vertical components of the catalogue where it takes them."""
        if _CHAIN.search(text):
            raise chain_of_bodies()
        try:
            return dd.results.Case.from_text(text, self.records)
        except InputError as error:
            if not any(one.variable == "vertical" for one in error.errors):
                raise
        # Its groups are known once it is read, whatever the factor.
        given = dd.results.Case.from_text(text, self._with_vertical(1.0).whole).settings
        return dd.results.Case.from_text(text, self._motions_of(given).whole)

    def _motions_of(self, settings: Settings) -> Motions:
        """The records of a case; what is wrong with its words is said when it is read."""
        given = settings.get("records", {})
        if given.get("vertical") != "recorded":
            return self._plain
        return self._with_vertical(as_number("vertical_factor", given.get("vertical_factor", 1.0)))

    def _with_vertical(self, factor: float) -> Motions:
        """The records with their vertical components, as the executable reads them from the catalogue."""
        if factor not in self._vertical:
            try:
                read = dd.read_catalogue(self.catalogue, vertical="recorded", vertical_factor=factor)
            except InputError as error:
                sentence = f"&records: vertical = 'recorded': {error}"
                raise InputError(sentence, errors=[Problem(sentence, "not_together", "vertical", "&records")]) from None
            self._vertical[factor] = _motions(tuple(read))
            while len(self._vertical) > _KEPT_FACTORS:
                self._vertical.popitem(last=False)
        return self._vertical[factor]

    def text(self, settings: Settings, lang: str = "en") -> str:
        """The case as text, with the records of the page and comments in a language."""
        groups = {name: dict(settings[name]) for name in _GROUPS if name in settings}
        groups["records"] = {"catalogue": str(self.catalogue)} | {
            name: value for name, value in groups.get("records", {}).items() if name != "catalogue"
        }
        return case_text(groups, commented=True, meanings=_language(lang).all_named("property of a case")) + "\n"

    def curve(self, asked: Mapping[str, Any], stop: threading.Event | None = None) -> dict[str, Any]:
        """The curve of a case, its numbers, its drawing, and what it is compared with.

        Once `stop` is set, `Interrupted` is raised after the present block of histories, and nothing is kept.
        """
        begin, language = time.perf_counter(), _language(asked.get("lang", "en"))
        settings, is_draft = groups_of(asked.get("settings")), bool(asked.get("draft"))
        if settings.get("wall", {}).get("mechanism") == "chain":
            raise chain_of_bodies()
        with self._lock:
            if asked.get("auto"):
                settings = self._with_levels(settings, stop)
            found = self._curve(settings, language.code, is_draft, stop)
            answer = self._shown(found, language)
            answer |= {"draft": is_draft, "levels": found.case.levels.tolist(), "text": found.text}
            if not is_draft:
                if asked.get("b") is not None and found.fragility.has_fit:
                    answer["comparison"] = self._comparison(found, groups_of(asked["b"]), language.code, stop)
                if isinstance(asked.get("fan"), dict):
                    answer["fan"] = self._fan(settings, asked["fan"], bool(asked.get("auto")), language.code, stop)
        answer["ms"] = 1e3 * (time.perf_counter() - begin)
        return answer

    def motion(self, asked: Mapping[str, Any]) -> dict[str, Any]:
        """The motion of the wall under one record that is scaled to a PGA in g."""
        with self._lock, silent():
            place, pga = asked.get("record"), as_number("PGA", asked.get("pga"))
            if not (type(place) is int and 0 <= place < len(self.records)):
                raise argument_error(
                    "out_of_range", "record", f" = {place!r}: must be a number from 0 to {len(self.records) - 1}"
                )
            if not 0.0 < pga <= 10.0:
                raise argument_error("out_of_range", "PGA", f" = {pga:g} g: must lie between 0 and 10")
            settings = groups_of(asked.get("settings"))
            records = self._motions_of(settings).whole
            case, record = dd.results.Case.from_text(self.text(settings), records), records[place]
            scale = pga / float(intensities((record,), "pga", case.population.walls[0].gravity)[0])
            solver = dd.Solver(rtol=case.rtol, atol=case.atol, edp_limit=case.edp_limit)
            return motion_of(dd.simulate(case.population.walls[0], record, scale, solver=solver))

    def _with_levels(
        self, settings: dict[str, dict[str, Any]], stop: threading.Event | None
    ) -> dict[str, dict[str, Any]]:
        """The case with levels that suit its wall."""
        given = {name: value for name, value in settings.get("stripes", {}).items() if name not in _OF_LEVELS}
        settings = {**settings, "stripes": {**given, "levels": [1.0]}}
        with silent():
            few = self._motions_of(settings).few
            case = dd.results.Case.from_text(self.text(settings), few)
            levels = chosen_levels(case, few, self.threads, stop)
        return {**settings, "stripes": {**given, "levels": levels}}

    def _curve(self, settings: Settings, lang: str, is_draft: bool, stop: threading.Event | None) -> Curve:
        """The curve of a case, computed once; that of a draft has half of the records."""
        text = self.text(settings, lang)
        key = f"{is_draft}{text}"
        if key in self._curves:
            self._curves.move_to_end(key)
            return self._curves[key]
        with warnings.catch_warnings(record=True) as heard:
            warnings.simplefilter("always", DondoloWarning)
            # A case copies the records that it is read with, which takes as long as the rest of it.
            motions = self._motions_of(settings)
            case = dd.results.Case.from_text(text, motions.few)
            if case.task != "stripes":
                raise other_task(case)
            stripes = dd.multiple_stripe(
                case.population.walls[0],
                motions.half if is_draft else motions.whole,
                case.levels,
                im=case.im,
                polarity=case.polarity,  # type: ignore[arg-type]
                solver=dd.Solver(rtol=case.rtol, atol=case.atol, edp_limit=case.edp_limit, engine=case.engine),  # type: ignore[arg-type]
                estimate_error=case.estimate_error and not is_draft,
                certify=case.certify and not is_draft,
                threads=self.threads,
                progress=False,
                stop=stop,
            )
            fragility = stripes.fit()
        own = tuple(one.message for one in heard if isinstance(one.message, DondoloWarning))
        found = self._curves[key] = Curve(case, text, stripes, fragility, own)
        while len(self._curves) > _KEPT:
            self._curves.popitem(last=False)
        return found

    def _shown(self, found: Curve, language: Language) -> dict[str, Any]:
        """What the page shows of a curve."""
        wall, fit, stripes = found.case.population.walls[0], found.fragility, found.stripes
        answer: dict[str, Any] = {
            "status": fit.status,
            "sentence": language.named("status", fit.status, STATUSES[fit.status]),
            "im": stripes.im,
            "stripes": [
                stripes.levels.tolist(),
                stripes.collapses.tolist(),
                stripes.histories.tolist(),
            ],
            "histories": int(stripes.histories.sum()),
            "trigger": wall.trigger_acceleration / wall.gravity,
            "greatest": wall.greatest_acceleration / wall.gravity,
            "warnings": [
                {"code": one.code, "sentence": warning_in_words(language, one)} for one in _once(found.warnings)
            ],
            "wall": picture(wall),
            "unchecked": ties_without_anchor(wall),
            "leans": wall.building is None and wall.mechanism in ("one_sided", "two_block", "corner", "horizontal"),
        }
        if fit.has_fit:
            answer |= curve_points(fit, 1.04 * float(stripes.levels[-1]))
        if found.case.site is not None:
            answer["check"] = _checked(found, language)
        return answer

    def _comparison(
        self, found: Curve, settings: Settings, lang: str, stop: threading.Event | None
    ) -> dict[str, Any] | None:
        """The ratio of the medians of B and A with its interval, under the same records."""
        with_other = self._curve(settings, lang, False, stop)
        second = with_other.fragility
        if not second.has_fit or second.im != found.fragility.im:
            return None
        walls = (one.case.population.walls[0] for one in (found, with_other))
        with silent():
            try:
                compared = found.fragility.compare(second)
            except DondoloError:
                return None
        return {
            "ratio": compared.ratio,
            "interval": list(compared.ratio_interval),
            "unchecked": any(map(ties_without_anchor, walls)),
        }

    def _fan(
        self,
        settings: dict[str, dict[str, Any]],
        fan: Mapping[str, Any],
        is_auto: bool,
        lang: str,
        stop: threading.Event | None,
    ) -> list[dict[str, Any]]:
        """Curves of the wall where one of its numbers is smaller and larger by a share."""
        group, name = (str(fan.get(what)) for what in ("group", "name"))
        share, place = as_number("share", fan.get("share")), fan.get("place") or 0
        values = settings.get(group, {}).get(name)
        several = values if isinstance(values, list) else [values]
        if not (type(place) is int and 0 <= place < len(several) and 0.0 < share < 1.0):
            raise InputError(f"fan = {dict(fan)}: must name a number of the case and a share of it")
        middle = as_number(name, several[place])
        curves: list[dict[str, Any]] = []
        for factor in (1.0 - share, 1.0 + share):
            changed = [*several[:place], factor * middle, *several[place + 1 :]]
            other = {**settings, group: {**settings[group], name: changed if isinstance(values, list) else changed[0]}}
            try:
                with silent():
                    chosen = self._with_levels(other, stop) if is_auto else other
                    found = self._curve(chosen, lang, False, stop)
            except DondoloError as error:
                curves.append({"factor": factor, "refused": refusal(error)})
                continue
            curves.append({"factor": factor} | (_line(found) if found.fragility.has_fit else {}))
        return curves


def _motions(records: tuple[dd.Record, ...]) -> Motions:
    """Records and their parts."""
    return Motions(records, *(pickle.loads(pickle.dumps(records[::step])) for step in (2, 4)))


@functools.cache
def known_language(code: str) -> Language:
    """A language, whose catalogue takes longer to read than a curve to fit."""
    return Language(code)


def _language(code: Any) -> Language:
    """The language that a page asks for."""
    one_of("lang", code, LANGUAGES)
    return known_language(code)


def curve_points(fit: Fragility, last: float) -> dict[str, Any]:
    """Parameters, points and band of a curve up to a level."""
    answer = _parameters(fit)
    x = np.linspace(0.0, max(last, min(1.25 * fit.theta, 2.0 * last)), _POINTS)
    answer |= {"x": x.tolist(), "p": np.asarray(fit(x)).tolist()}
    if fit.has_errors:
        with silent():
            low, high = fit.interval(x[1:])
            answer["interval"] = list(fit.parameter_interval()["theta"])
        answer["band"] = [[0.0, *np.asarray(low).tolist()], [0.0, *np.asarray(high).tolist()]]
    return answer


def refusal(error: DondoloError) -> dict[str, Any]:
    """An error as data: its sentence, and of each thing that is wrong its code, variable, group, line and sentence."""
    errors = []
    for one in error.errors if isinstance(error, InputError) else ():
        group, line = (re.search(pattern, one.place) for pattern in (r"&(\w+)", r"line (\d+)"))
        errors.append(
            {
                "code": one.code,
                "variable": one.variable,
                "group": group[1] if group else "",
                "line": int(line[1]) if line else None,
                "message": one.message,
            }
        )
    return {"error": str(error), "errors": errors}


def chain_of_bodies() -> InputError:
    """The refusal of a chain, whose tables the page does not read."""
    sentence = "mechanism = 'chain': the page shows walls of one block or two, or in plan; run this case with dondolo"
    return InputError(sentence, errors=[Problem(sentence, "out_of_range", "mechanism", "&wall")])


def other_task(case: Case) -> InputError:
    """The refusal of a case that is not of one wall."""
    sentence = f"task = '{case.task}': the page shows one wall, task = 'stripes'; run this case with dondolo"
    return InputError(sentence, errors=[Problem(sentence, "out_of_range", "task")])


def _line(found: Curve) -> dict[str, Any]:
    """Parameters and points of a curve, without its band."""
    whole = curve_points(found.fragility, 1.04 * float(found.stripes.levels[-1]))
    return {name: whole[name] for name in ("theta", "beta", "x", "p")}


def _parameters(fit: Fragility) -> dict[str, Any]:
    return {"theta": fit.theta, "beta": fit.beta}


def _checked(found: Curve, language: Language) -> dict[str, Any]:
    """The kinematic check by NTC 2018, and the probability of collapse at the peak acceleration of the site.

    Of a strip that bends before it opens the page calls no check of rigid blocks satisfied without saying so.
    """
    case, fit = found.case, found.fragility
    assert case.site is not None
    wall = case.population.walls[0]
    with silent():
        try:
            check: CodeCheck = dd.check_ntc(wall, case.site, **{name: getattr(case, name) for name in CHECK_OPTIONS})
        except InputError as error:
            return {"refused": refusal(error)}
    answer: dict[str, Any] = {
        "pga": check.pga,
        "capacities": [[*key, value] for key, value in check.capacities.items() if key not in check.not_applicable],
        "verdicts": [
            [*key, check._verdict(key), key in check.required] for key in check._verified or check.not_applicable
        ],
        "is_bent": any(one.code == BENDING for one in found.warnings),
        "alpha_0": check.value("mechanism", "", "alpha_0"),
        "notes": [warning_in_words(language, note) for note in check.notes],
    }
    hazard = case.site.hazard
    if hazard.mesh:
        columns = (STATES, hazard.ag, hazard.f0, hazard.tc_star, hazard.return_periods)
        answer["hazard"] = [list(row) for row in zip(*columns, strict=True)]
    if (chance := chance_at(fit, check.pga)) is not None and check.verified is not None:
        answer["probability"] = chance.value
    answer["lines"] = [_in_json(one) for one in side_by_side(check, fit)]
    return answer


def _in_json(line: StateLine) -> dict[str, Any]:
    """A check at a glance as the page takes it: null for what there is none of."""
    found = {**line._asdict(), "capacity": _known(line.capacity), "demand": _known(line.demand)}
    found |= {"ratio": _known(line.ratio), "allowed_pga": _known(line.allowed_pga)}
    for name in ("at_allowed", "at_site"):
        if found[name] is not None:
            found[name] = [_known(value) for value in found[name]]
    return found


def _known(value: float) -> float | None:
    return float(value) if np.isfinite(value) else None


def _once(found: tuple[DondoloWarning, ...]) -> list[DondoloWarning]:
    """Each warning once."""
    return list(dict.fromkeys(found))


def groups_of(given: Any) -> dict[str, dict[str, Any]]:
    """Groups as a page sends them, checked to be groups of values; what they say is checked by the library."""
    if not isinstance(given, dict) or not set(given) <= set(_GROUPS):
        raise argument_error("wrong_type", "settings", ": must be the groups of a case")
    for group in given.values():
        if not isinstance(group, dict) or not all(map(_is_value, group.values())):
            raise argument_error("wrong_type", "settings", ": must be groups of values")
        for name in group:
            if not (isinstance(name, str) and name.isidentifier() and name.isascii() and len(name) < 64):
                raise argument_error("wrong_type", "settings", ": names of variables must be words")
    return given


def _is_value(value: Any) -> bool:
    """Whether a value is one that a case can have: a number, a word, yes or no, or a list of them."""
    if isinstance(value, list):
        return 0 < len(value) <= 1000 and all(_is_value(one) and not isinstance(one, list) for one in value)
    if isinstance(value, str):
        return value.isprintable() and len(value) <= 1000
    return isinstance(value, (bool, int)) or (isinstance(value, float) and bool(np.isfinite(value)))


def sparse(settings: Settings) -> dict[str, dict[str, Any]]:
    """The groups of a case without what follows from the rest: defaults, sums of sections, the catalogue."""
    found: dict[str, dict[str, Any]] = {}
    for group, variables in settings.items():
        defaults = {row.name: row.default.strip("'") for row in properties(group)}
        own = {name: value for name, value in variables.items() if not _is_default(value, defaults.get(name, ""))}
        for given, what in _FOLLOWS.items():
            if given in own:
                own.pop(what, None)
        if own or group in ("wall", "building", "check"):
            found[group] = own
    found.setdefault("job", {})["task"] = "stripes"
    found.setdefault("records", {}).pop("catalogue", None)
    if found["stripes"].get("edp_thresholds") == [settings["solver"]["edp_limit"]]:
        del found["stripes"]["edp_thresholds"]
    return found


def _is_default(value: Any, default: str) -> bool:
    """Whether a value is the one that its property has when it is not given."""
    if isinstance(value, bool):
        return default == (".true." if value else ".false.")
    if isinstance(value, (int, float)):
        try:
            return float(default) == value
        except ValueError:
            return False
    return bool(value == default)
