"""The steps from the items of a calculation to d_0* and a(d_C), with the numbers put in, for a calculator.

A wall that turns by θ about its hinge lowers its weights by z sin θ while it moves them by z cos θ + e sin θ; a strip
that bends has the geometry of its two blocks. Steps are shown only if they give the numbers of the check: friction of
interlocking and rounded edges have further terms.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

from dondolo._fortran.checks import SheetRow
from dondolo.reporting.blocks import Block, CaptionedTable, Formula, Fraction, Root, symbol_of
from dondolo.reporting.content import Piece, Symbol, Table
from dondolo.reporting.numerals import NONE, Numeral
from dondolo.reporting.relazione.document import Document, _
from dondolo.reporting.relazione.formulas import FIGURES
from dondolo.reporting.relazione.strip_items import strip_of_items
from dondolo.reporting.relazione.subjects import Subject
from dondolo.reporting.relazione.sums import Turning, of_tie, ties_left_out, turning_of
from dondolo.reporting.relazione.tabulated import table_steps
from dondolo.reporting.units import UNITS, Unit, cell
from dondolo.walls.chains import ChainWall
from dondolo.walls.mechanisms import TabulatedWall, TwoBlockWall
from dondolo.walls.ties import ties_of

# How well the steps give the numbers of the check
_SAME = 1e-9
# Displacements of the code / d_0*
_SHARES = {"SLV": 0.4, "SLC": 0.6}
# Of a cosine, which is close to 1
_COSINE = 10
_THETA = Symbol("θ")


def shown(value: float, unit: Unit = UNITS[""], figures: int = FIGURES) -> Numeral:
    """A number to calculate with."""
    return cell(value, unit, figures)


def end_of(document: Document, one: Subject) -> list[Block]:
    """Steps to d_0*."""
    if isinstance(one.wall, (TabulatedWall, ChainWall)):
        return table_steps(document, one)
    if isinstance(one.wall, TwoBlockWall):
        return _strip(document, one)
    sums, d0 = turning_of(one.check.items), one.check.value("mechanism", "SLV", "d_0")
    tangent = (sums.weights - sums.thrusts) / sums.lowered
    sine = tangent / math.hypot(1.0, tangent)
    if not math.isclose(sine * sums.second / sums.first, d0, rel_tol=_SAME):
        return [document.say(_("{d0} = {value} m is that of the code: springs or a rounded edge of the hinge have"
                               " terms that the sums lack."),
                             d0=symbol_of("d_0*"), value=shown(d0))]  # fmt: skip
    moment = one.unit("N m/m")
    top: list[Any] = [symbol_of("M_stab,P"), " - ", symbol_of("M_ov")]
    numbers: list[Any] = [shown(sums.weights, moment), " - ", shown(sums.thrusts, moment)]
    total, first, second = _sum("P", "z"), shown(sums.first, moment), shown(sums.second, one.unit("N m2/m"))
    lowered, lowered_numbers = _lowered(sums, with_ties=False)
    words = _(
        "The wall turns by {theta} about its hinge; the arms are {arm}, with {hinge} = {value} m, and {first} ="
        " {sum} {unit}. At {d0} nothing holds it but its weights, whose moment is {moment}:"
    )
    if ties_of(one.wall):
        words = _(
            "The wall turns by {theta} about its hinge; the arms are {arm}, with {hinge} = {value} m, and {first} ="
            " {sum} {unit}. At {d0} nothing holds it but its weights, whose moment is {moment}; ties have broken or"
            " hold no longer:"
        )
    return [
        *_set_back(one, sums),
        document.say(
            words,
            theta=_THETA,
            arm=(symbol_of("e"), " = ", symbol_of("d"), " - ", symbol_of("u")),
            hinge=symbol_of("u"),
            value=shown(sums.hinge),
            first=_sum("P", "e"),
            sum=shown(sums.arms, moment),
            unit=moment.name,
            d0=symbol_of("d_0*"),
            moment=symbol_of("M_stab,P"),
        ),
        Formula((("tan ", Symbol("θ", "0")), Fraction(tuple(top), lowered), Fraction(tuple(numbers), lowered_numbers),
                 shown(tangent))),
        Formula((symbol_of("d_0*"), ("sin ", Symbol("θ", "0"), " ", Fraction((*total, "²"), total)),
                 (shown(sine), " · ", Fraction(second, first)), (shown(d0), " m"))),
    ]  # fmt: skip


def _set_back(one: Subject, sums: Turning) -> list[Block]:
    """The depth of the hinge, if it follows from the strength of the masonry, 0.85 f over twice that depth."""
    weight = math.fsum(item.force for item in one.check.items if item.item != "masonry" and item.stabilising > 0.0
                       and not math.isnan(item.arm))  # fmt: skip
    strength = getattr(one.wall, "compressive_strength", None)
    if not strength:
        return []
    if one.is_whole:
        return _crushed_corner(weight, strength, sums.hinge)
    if not math.isclose(weight / (1.7 * strength), sums.hinge, rel_tol=_SAME):
        return []
    under = ("2 · ", shown(0.85), " ", symbol_of("f"))
    numbers = (shown(weight, UNITS["N/m"]), " kN/m"), ("2 · ", shown(0.85), " · ", shown(strength, UNITS["Pa"]), " MPa")
    return [
        Formula((symbol_of("u"), Fraction(("Σ", symbol_of("P")), under), Fraction(*numbers), (shown(sums.hinge), " m")))
    ]


def _crushed_corner(weight: float, strength: float, hinge: float) -> list[Block]:
    """The depth of the hinge of a corner, two thirds of that of a triangle of right angles that is crushed."""
    if not math.isclose(2.0 / 3.0 * math.sqrt(weight / (0.85 * strength)), hinge, rel_tol=_SAME):
        return []
    under = (shown(0.85), " ", symbol_of("f"))
    numbers = (shown(weight, UNITS["N"]), " kN"), (shown(0.85), " · ", shown(strength, UNITS["Pa"]), " MPa")
    parts = Root((Fraction(("Σ", symbol_of("P")), under),)), Root((Fraction(*numbers),))
    return [Formula((symbol_of("u"), ("2/3 ", parts[0]), ("2/3 ", parts[1]), (shown(hinge), " m")))]


def capacity_of(document: Document, one: Subject, row: SheetRow) -> list[Block]:
    """The steps to alpha(d_C), of the curve with all ties or, of method 'untied', without some."""
    check, state, a = one.check, row.limit_state, row.value
    d = check.value(row.method, state, "displacement")
    if not one.is_turning:
        return []
    blocks: list[Block] = []
    factor, ratio = (check.value("mechanism", state, name) for name in ("knowledge_factor", "mass_ratio"))
    alpha = a * ratio * factor / one.wall.gravity
    left_out = ties_left_out(one, row.item)
    sums = turning_of(check.items, left_out)
    sine = d * sums.first / sums.second
    held = next(
        (kept for kept in (True, False) if math.isclose(sums.multiplier(sine, with_ties=kept), alpha, rel_tol=_SAME)),
        None,
    )
    ties = sorted((tie for tie in _fractures(one) if tie.name not in left_out), key=lambda tie: tie.angle)
    if held is None:
        # Ties break one after the other.
        for many in range(1, len(ties)):
            unbroken = turning_of(check.items, left_out | {tie.name for tie in ties[:many]})
            if math.isclose(unbroken.multiplier(sine, with_ties=True), alpha, rel_tol=_SAME):
                sums, held = unbroken, True
    if len(ties) > 1 and sine >= math.sin(ties[0].angle) * (1.0 - _SAME):
        blocks += _of_ties(document, one, ties, sine, state)
    if held is None:
        text = _(
            "{a} = {value} m/s² is that of the capacity curve, with friction of interlocking, springs, a rounded edge"
            " of the hinge or ties that have not yielded, which the sums of the table do not have."
        )  # fmt: skip
        return [*blocks, document.say(text, a=symbol_of("a(d_C)"), value=shown(a))]
    moment = one.unit("N m/m")
    theta = Symbol("θ", "C")
    cosine = math.sqrt(1.0 - sine**2)
    held = held and sums.ties > 0.0
    stabilising = sums.weights + (sums.ties if held else 0.0)
    lowered, lowered_numbers = _lowered(sums, with_ties=held)
    sin, cos = (" sin ", theta), (" cos ", theta)
    name = symbol_of("M_stab" if held or not sums.ties else "M_stab,P")
    left, moved = symbol_of("M_C"), symbol_of("B_C")
    rest, fall = symbol_of("A"), symbol_of("B")
    at_rest, falling = stabilising - sums.thrusts, sums.lowered - (sums.tie_arms if held else 0.0)
    near_one = shown(cosine, figures=_COSINE)
    top_numbers = (
        shown(at_rest, moment), " · ", near_one, " - ", shown(falling, moment), " · ", shown(sine),
    )  # fmt: skip
    bottom = (*_sum("P", "z"), *cos, " + ", *_sum("P", "e"), *sin)
    bottom_numbers = (
        shown(sums.first, moment), " · ", near_one, *_signed(" + ", sums.arms), " · ", shown(sine),
    )  # fmt: skip
    # In symbols once: those of SLC are the same.
    is_first = (row.method, state) == ("nonlinear", "SLV")
    symbols = [Formula((left, (rest, *cos, " - ", fall, *sin))), Formula((moved, bottom))] if is_first else []
    under = sums.first * cosine + sums.arms * sine
    over, below = shown(alpha * under, moment), shown(under, moment)
    first, second = shown(sums.first, moment), shown(sums.second, one.unit("N m2/m"))
    total = _sum("P", "z")
    return [
        *blocks,
        Formula((("sin ", theta), (symbol_of("d_C"), " ", Fraction(total, (*total, "²"))),
                 (shown(d), " · ", Fraction(first, second)), shown(sine))),
        Formula((rest, (name, " - ", symbol_of("M_ov")), (shown(at_rest, moment), f" {moment.name}"))),
        Formula((fall, lowered, lowered_numbers, (shown(falling, moment), f" {moment.name}"))),
        *symbols[:1],
        Formula((left, top_numbers, (over, f" {moment.name}"))),
        *symbols[1:],
        Formula((moved, bottom_numbers, (below, f" {moment.name}"))),
        Formula((symbol_of("alpha(d_C)"), Fraction(left, moved), Fraction(over, below), shown(alpha))),
    ]  # fmt: skip


def _sum(force: str, lever: str) -> tuple[Any, ...]:
    return ("Σ", symbol_of(force), " ", symbol_of(lever))


def _lowered(sums: Turning, *, with_ties: bool) -> tuple[tuple[Any, ...], tuple[Any, ...]]:
    """What loses height, in symbols and in numbers."""
    moment = UNITS["N m/m"]
    symbols: list[Any] = [*_sum("P", "z")]
    numbers: list[Any] = [shown(sums.first, moment)]
    if sums.pushed:
        symbols += [" - ", *_sum("Q", "z")]
        numbers += _signed(" - ", sums.pushed)
    if sums.share < 1.0:
        symbols = ["(", *symbols, ") cos ", Symbol("β")]
        numbers = ["(", *numbers, ") · ", shown(sums.share, figures=_COSINE)]
    terms = [(" + ", "H", "e", sums.thrust_arms)]
    terms += [(" - ", "T", "e", sums.tie_arms)] if with_ties else []
    for sign, force, lever, value in terms:
        if value:
            symbols += [sign, *_sum(force, lever)]
            numbers += _signed(sign, value)
    return tuple(symbols), tuple(numbers)


def _signed(sign: str, value: float, unit: Unit = UNITS["N m/m"]) -> tuple[Piece, ...]:
    """A term of a sum that is added (' + ') or taken away (' - '), with its sign: in brackets if it is less than 0."""
    return (sign, "(", shown(value, unit), ")") if value < 0.0 else (sign, shown(value, unit))


def displacement_of(document: Document, one: Subject, row: SheetRow) -> list[Block]:
    """Why d_C is not the share of d_0* that the code has for it, which its row then lacks."""
    if row.numbers:
        return []
    d, state = row.value, row.limit_state
    share = (shown(_SHARES[state]), " ", symbol_of("d_0*"))
    values = {"state": state, "capacity": symbol_of("d_C"), "d": shown(d), "share": share}
    if "tie" in row.expression:
        words = _(
            "{state}: {capacity} = {d} m, less than {share}: there ties break that give more than half of the greatest"
            " resistance (Circolare, C8.7.1.2.1.6)."
        )
        return [document.say(words, **values), *_fracture(document, one, d)]
    words = _("{state}: {capacity} = {d} m, less than {share}: there a load loses its seat (Circolare, C8.7.1.2.1.6).")
    return [document.say(words, **values)]


def _fracture(document: Document, one: Subject, d: float) -> list[Block]:
    """The elongation at which a tie breaks: that of its strain, or of its yield if the anchor gives way first."""
    sums = turning_of(one.check.items)
    sine = d * sums.first / sums.second
    cosine = math.sqrt(1.0 - sine**2)
    items = [item for item in one.check.items if item.item.startswith("tie")]
    for tie, item in zip(ties_of(one.wall), items, strict=False):
        arm, height = item.depth - sums.hinge, item.lever
        travel = height * sine + arm * (1.0 - cosine)
        strain, preload, modulus = (of_tie(tie, name) for name in ("strain", "preload", "modulus"))
        force = item.force / tie.section
        of_bar = (strain - preload / modulus) * tie.length
        of_anchor = (force - preload) / modulus * tie.length
        symbol = (symbol_of("D_u"), (symbol_of("z"), " sin ", Symbol("θ", "C"), " + ", symbol_of("e"), " (1 - cos ",
                  Symbol("θ", "C"), ")"), (shown(height), " · ", shown(sine), *_signed(" + ", arm, UNITS["m"]), " · ",
                  shown(sine**2 / (1.0 + cosine))), (shown(travel), " m"))  # fmt: skip
        stiff = (shown(modulus, UNITS["Pa"]), " MPa")
        if math.isclose(of_bar, travel, rel_tol=1e-6):
            before = Fraction((shown(preload, UNITS["Pa"]), " MPa"), stiff)
            numbers: tuple[Any, ...] = ("(", shown(strain), " - ", before, ") · ", shown(tie.length), " m")
            ratio = Fraction(symbol_of("sigma_0"), symbol_of("E"))
            symbols: tuple[Any, ...] = ("(", symbol_of("ε_u"), " - ", ratio, ") ", symbol_of("l"))
        elif math.isclose(of_anchor, travel, rel_tol=1e-6):
            force_stress = Fraction(
                (shown(item.force, UNITS["N/m"]), " kN/m"), (shown(tie.section, UNITS["m2/m"]), " cm²/m")
            )
            numbers = (Fraction(("(", force_stress, " - ", shown(preload, UNITS["Pa"]), " MPa)"), stiff), " · ",
                       shown(tie.length), " m")  # fmt: skip
            stress = (symbol_of("T"), "/", symbol_of("A"), " - ", symbol_of("sigma_0"))
            symbols = (Fraction(stress, symbol_of("E")), " ", symbol_of("l"))
        else:
            continue
        return [
            document.say(_("{tie} breaks at the elongation"), tie=document.item(item.item)),
            Formula((symbol_of("D_u"), symbols, numbers, (shown(travel), " m"))),
            Formula(symbol),
        ]
    return []


class _Fracture(NamedTuple):
    """Where a tie breaks.

    Attributes
    ----------
    name : str
        Its item of the calculation.
    force : float
        At which it breaks [N/m].
    anchor : float
        Force at which its anchor gives way [N/m]; infinite if that is not known.
    elongation : float
        At which it breaks [m].
    angle : float
        Of the wall then [rad].
    """

    name: str
    force: float
    anchor: float
    elongation: float
    angle: float


def _fractures(one: Subject) -> list[_Fracture]:
    """Where each tie breaks: at its ultimate strain, or at once where its anchor is weaker than the bar."""
    hinge = turning_of(one.check.items).hinge
    items = [item for item in one.check.items if item.item.startswith("tie")]
    found = []
    for tie, item in zip(ties_of(one.wall), items, strict=False):
        strain, preload, modulus, strength = (
            of_tie(tie, name) for name in ("strain", "preload", "modulus", "strength")
        )
        elongation = (strain - preload / modulus) * tie.length
        is_brittle = item.force < (1.0 - _SAME) * strength * tie.section
        if is_brittle:
            elongation = (item.force / tie.section - preload) / modulus * tie.length
        arm, height = item.depth - hinge, item.lever
        # z sin θ + e (1 - cos θ) is the elongation
        reach = (elongation - arm) / math.hypot(height, arm)
        angle = math.asin(reach) + math.atan2(arm, height) if abs(reach) <= 1.0 else math.inf
        row = next(
            (row for row in one.check.rows if row.item == item.item and row.quantity == "anchor_force_per_m"), None
        )
        anchor = tie.anchor_force or (item.force if is_brittle else math.inf) if row is None else row.value
        found.append(_Fracture(item.item, item.force, anchor, elongation, angle))
    return found


def _of_ties(document: Document, one: Subject, ties: list[_Fracture], sine: float, state: str) -> list[Block]:
    """A table of which ties have broken at d_C, where, and at what force."""
    sums = turning_of(one.check.items)
    has_broken = [math.sin(min(tie.angle, 0.5 * math.pi)) <= sine * (1.0 + _SAME) for tie in ties]
    theta = Symbol("θ", "u")
    columns: dict[Piece, Any] = {
        document.text(_("tie")): [document.item(tie.name) for tie in ties],
        (symbol_of("T"), " [kN/m]"): [shown(tie.force, UNITS["N/m"]) for tie in ties],
        (symbol_of("T_anchor"), " [kN/m]"): [
            NONE if math.isinf(tie.anchor) else shown(tie.anchor, UNITS["N/m"]) for tie in ties
        ],
        (symbol_of("D_u"), " [m]"): [shown(tie.elongation) for tie in ties],
        (theta, " [rad]"): [NONE if math.isinf(tie.angle) else shown(tie.angle) for tie in ties],
        (symbol_of("d"), "(", theta, ") [m]"): [
            NONE if math.isinf(tie.angle) else shown(math.sin(tie.angle) * sums.second / sums.first) for tie in ties
        ],
        (document.text(_("at")), " ", symbol_of("d_C")): [
            document.text(_("broken")) if broken else document.text(_("holds")) for broken in has_broken
        ],
    }
    words = _(
        "Each tie breaks where {z} sin {theta} + {e} (1 - cos {theta}) is its ultimate elongation {elongation}. In what"
        " follows, {moment} and the products of {force} are those of the ties that hold at {d}:"
    )
    symbols = {"z": symbol_of("z"), "theta": theta, "e": symbol_of("e"), "elongation": symbol_of("D_u")}
    symbols |= {"moment": symbol_of("M_stab"), "force": symbol_of("T"), "d": symbol_of("d_C")}
    caption = document.text(_("Ties at the displacement of {state}, in the order in which they break."), state=state)
    return [document.say(words, **symbols), CaptionedTable(Table.of(columns), caption)]


class _Bent(NamedTuple):
    """Geometry of a strip at a displacement, and its multiplier."""

    d: float
    lower: float
    upper: float
    ratio: float
    rise: float
    multiplier: float


def _bent(one: Subject, d: float) -> _Bent:
    """A strip whose blocks have moved by d: angles of their diagonals, ratio of their rotations, rise of the load."""
    wall, items = one.wall, one.check.items
    assert isinstance(wall, TwoBlockWall)
    w, h1 = items[0].arm, items[0].lever
    h2 = 0.5 * wall.height - h1
    r1, r2, a2 = math.hypot(w, h1), math.hypot(w, h2), math.atan2(w, h2)
    lower = math.asin(w / r1 - d / r1)
    upper = math.asin(r1 * math.sin(lower) / r2)
    ratio = r1 * math.cos(lower) / (r2 * math.cos(upper))
    inner = w - (wall.eccentricity or 0.0)
    rise = 2.0 * r1 * math.sin(lower) * (1.0 + ratio) - inner * ratio * math.cos(a2 - upper)
    load = items[2].force if len(items) > 2 else 0.0
    blocks = items[0].force + items[1].force
    top = r1 * math.sin(lower) * (items[0].force + items[1].force * (2.0 + ratio)) + load * rise
    return _Bent(d, lower, upper, ratio, rise, top / (blocks * r1 * math.cos(lower)))


def _strip(document: Document, one: Subject) -> list[Block]:
    """Geometry of a strip at d_0* and at d_C, a column each."""
    check, wall, items = one.check, one.wall, one.check.items
    assert isinstance(wall, TwoBlockWall)
    if any(item.item not in ("lower block", "upper block", "load on top") for item in items):
        return strip_of_items(document, one)
    if not one.has_ratios:
        return []
    factor = check.value("mechanism", "SLV", "knowledge_factor")
    places = [("d_0*", check.value("mechanism", "SLV", "d_0"), 0.0)]
    for state in ("SLV", "SLC"):
        d, a = (check.value("nonlinear", state, name) for name in ("displacement", "acceleration"))
        places.append((f"d_C, {state}", d, a))
    found = [_bent(one, d) for _name, d, _a in places]
    scale = wall.gravity / factor
    if any(not math.isclose(bent.multiplier * scale, a, rel_tol=_SAME, abs_tol=1e-6)
           for bent, (_name, _d, a) in zip(found, places, strict=True)):  # fmt: skip
        return []
    w, h1 = items[0].arm, items[0].lever
    h2 = 0.5 * wall.height - h1
    b1, b2 = Symbol("β", "1"), Symbol("β", "2")
    r1, r2, a2 = Symbol("R", "1"), Symbol("R", "2"), symbol_of("alpha_2")
    rows: list[tuple[Piece, list[float]]] = [
        ((symbol_of("d"), " [m]"), [bent.d for bent in found]),
        (("sin ", b1), [math.sin(bent.lower) for bent in found]),
        (("sin ", b2), [math.sin(bent.upper) for bent in found]),
        (symbol_of("K"), [bent.ratio for bent in found]),
        ((symbol_of("Y"), " [m]"), [bent.rise for bent in found]),
        (symbol_of("alpha"), [0.0 if abs(bent.multiplier) < _SAME else bent.multiplier for bent in found]),
        ((symbol_of("a"), " [m/s²]"), [a for _name, _d, a in places]),
    ]
    columns: dict[Piece, Any] = {document.text(_("quantity")): [head for head, _values in rows]}
    for place, (name, _d, _a) in enumerate(places):
        columns[symbol_of(name) if place == 0 else (symbol_of("d_C"), name[3:])] = [
            shown(values[place]) for _head, values in rows
        ]
    load = (" + ", symbol_of("N"), " ", symbol_of("Y")) if len(items) > 2 else ()
    top = (r1, " sin ", b1, " [", symbol_of("P_1"), " + ", symbol_of("P_2"), " (2 + ", symbol_of("K"), ")]", *load)
    bottom = ("(", symbol_of("P_1"), " + ", symbol_of("P_2"), ") ", r1, " cos ", b1)
    inner = ("(", symbol_of("w"), " - ", symbol_of("e_N"), ")")
    blocks: list[Block] = [
        document.say(
            _(
                "The blocks, of half heights {h1} and {h2} and with hinges {w} off their middle lines, have the"
                " diagonals {r1} and {r2}; {alpha} = {angle} rad, {en} = {eccentricity} m. With the strip displaced by"
                " {d}, {b1} and {b2} are the angles of the diagonals to the vertical, {k} the ratio of the rotations"
                " and {y} the rise of the load for a unit of rotation of the lower block; {d0} is where {multiplier}"
                " is 0:"
            ),
            h1=(Symbol("h", "1"), " = ", shown(h1), " m"),
            h2=(Symbol("h", "2"), " = ", shown(h2), " m"),
            w=(symbol_of("w"), " = ", shown(w), " m"),
            r1=(r1, " = ", shown(math.hypot(w, h1)), " m"),
            r2=(r2, " = ", shown(math.hypot(w, h2)), " m"),
            alpha=a2,
            angle=shown(math.atan2(w, h2)),
            en=symbol_of("e_N"),
            eccentricity=shown(wall.eccentricity or 0.0),
            d=symbol_of("d"),
            b1=b1,
            b2=b2,
            k=symbol_of("K"),
            y=symbol_of("Y"),
            d0=symbol_of("d_0*"),
            multiplier=symbol_of("alpha"),
        ),
        Formula((("sin ", b1), ("(", symbol_of("w"), " - ", symbol_of("d"), ")/", r1))),
        Formula((("sin ", b2), ("(", r1, "/", r2, ") sin ", b1))),
        Formula((symbol_of("K"), Fraction((r1, " cos ", b1), (r2, " cos ", b2)))),
        Formula((symbol_of("alpha"), Fraction(top, bottom))),
    ]
    if load:
        turned = (*inner, " ", symbol_of("K"), " cos(", a2, " - ", b2, ")")
        rise = ("2 ", r1, " sin ", b1, " (1 + ", symbol_of("K"), ") - ", *turned)
        blocks.append(Formula((symbol_of("Y"), rise)))
    caption = document.text(_("Geometry of the strip, multiplier and capacity a = α g/(e* FC)."))  # noqa: RUF001
    return [*blocks, CaptionedTable(Table.of(columns), caption)]
