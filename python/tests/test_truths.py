"""What holds for every formula of a check and of a calculation report: its symbols and its numbers give its value.

All is computed again here from the items of the calculation and from the sheet; nothing of a document is written twice.
"""

import dataclasses
import math
import re

import pytest

import dondolo as dd
from dondolo.reporting.blocks import Formula, Fraction, Paragraph, Root, symbol_of
from dondolo.reporting.content import Symbol
from dondolo.reporting.language import Language
from dondolo.reporting.numerals import Numeral
from dondolo.reporting.relazione import checks, project
from dondolo.reporting.relazione.document import Document
from dondolo.reporting.relazione.floors import modes_in
from dondolo.reporting.relazione.subjects import Subject, Subjects
from dondolo.reporting.relazione.sums import reactions_of

G = 9.81
THREE = dd.Site(
    (0.09, 0.24, 0.31), (2.4, 2.45, 2.5), (0.28, 0.33, 0.35), soil="C", topography="T2", reference_life=60.0,
    exceedance=(0.63, 0.1, 0.05),
)  # fmt: skip
ONE = dd.Site(0.21, 2.5, 0.34, soil="D")
MASONRY = {"masonry_compression": 2.2e6, "masonry_shear": 5e4, "masonry_tension": 6e4, "masonry_friction": 0.4}


def facade(name, *ties, **more):
    """A facade of two storeys with floors and a thrust."""
    return dd.OneSidedWall(
        sections=[dd.Section(3.6, 0.65), dd.Section(3.3, 0.5)],
        density=1900.0,
        loads=[
            dd.Load(8e3, depth=0.5, height=3.6, inertia="both"),
            dd.Load(6e3, depth=0.3, height=6.8, inertia="none"),
        ],
        inertial_masses=[dd.InertialMass(350.0, depth=0.4, height=6.8)],
        thrusts=[dd.Thrust(1.2e3, height=6.1, depth=0.45)],
        ties=ties,
        name=name,
        **more,
    )  # fmt: skip


def tie(height, **more):
    return dd.Tie(height, length=9.0, strength=2.4e8, preload=4e7, modulus=2.05e11, **{"strain": 0.03} | more)


PLATE = {"bar": 0.02, "spacing": 2.2, "plate_thickness": 0.02, "compression": 1.1e5}
WALLS = {
    "bare": (facade("bare"), THREE, {}),
    "one hazard": (facade("one hazard"), ONE, {"knowledge_factor": 1.2}),
    "bar": (facade("bar", tie(6.1, area=5e-5)), THREE, {}),
    "plate": (facade("plate", tie(6.3, plate_width=0.3, plate_height=0.25, **PLATE), **MASONRY), THREE, {}),
    "disc": (facade("disc", tie(3.4, plate_diameter=0.35, **PLATE), **MASONRY), ONE, {}),
    "at the top": (facade("at the top", tie(6.7, plate_width=0.3, plate_height=0.25, **PLATE), **MASONRY), ONE, {}),
    "brittle": (facade("brittle", tie(6.1, area=5e-4, strain=2e-3, anchor_force=3e4)), THREE, {}),
    "one after the other": (
        facade("one after the other", tie(3.4, area=2e-5, strain=2e-3), tie(6.4, area=6e-5)),
        ONE,
        {},
    ),
    "strength": (facade("strength", compressive_strength=1.4e6), THREE, {"behaviour": 1.5}),
    "strip": (
        dd.TwoBlockWall(
            3.2, 0.28, density=1700.0, overburden=1.5e4, overburden_inertia=1.0, eccentricity=0.02, name="strip"
        ),
        THREE,
        {},
    ),
    "floor": (
        dd.OneSidedWall(1.6, 0.3, name="floor", building=dd.Building(period=0.35, damping=0.05, participation=1.3)),
        THREE,
        {},
    ),
    "low floor": (
        dd.OneSidedWall(1.6, 0.3, name="low floor", building=dd.Building(period=0.35, damping=0.05, participation=0.1)),
        THREE,
        {},
    ),
    "free": (dd.FreeStandingWall(1.7, 0.3, young_modulus=7e8, name="free"), THREE, {}),
    "free, range": (dd.OneSidedWall(2.1, 0.3, young_modulus=(4e8, 8e8), free=True, name="free, range"), ONE, {}),
    "free, unknown": (dd.FreeStandingWall(1.7, 0.3, name="free, unknown"), THREE, {}),
}  # fmt: skip


@pytest.fixture(scope="module")
def subjects():
    """The walls with their checks."""
    made = {}
    for name, (wall, site, given) in WALLS.items():
        made[name] = Subject(wall, dd.check_ntc(wall, site, **given), None, None)
    return made


# --- Formulas as lines of text


def sums(check, without=""):
    """Sums over the items, by their names in formulas of the sheet and of documents; perhaps without some ties."""
    items = [one for one in check.items if one.item not in {f"tie {place}" for place in re.findall(r"\d+", without)}]
    weights = [one for one in items if not math.isnan(one.force_lever)]
    carried = [one for one in weights if not math.isnan(one.arm)]
    holding = [one for one in items if one.item.startswith(("tie", "friction"))]
    thrusts = [one for one in items if not math.isnan(one.overturning)]
    pushed = [one for one in weights if math.isnan(one.arm) or math.isnan(one.stabilising)]
    hinge = carried[0].depth - carried[0].arm

    def add(some, *names):
        return math.fsum(math.prod(getattr(one, name) for name in names) for one in some)

    stabilising = math.fsum(one.stabilising for one in items if not math.isnan(one.stabilising))
    found = {"sum stabilising": stabilising, "sum overturning": add(thrusts, "overturning")}
    # The load on a strip stays where it is.
    found |= {
        "sum P": add([one for one in weights if one.force_lever], "force"),
        "sum P z": add(weights, "force_lever"),
    }
    found["sum P z^2"] = math.fsum(one.force_lever2 for one in items if not math.isnan(one.force_lever2))
    found |= {"M_stab,P": stabilising - add(holding, "stabilising"), "ΣPe": add(carried, "force", "arm")}
    found |= {"ΣQz": add(pushed, "force_lever"), "u": hinge}
    found |= {"sum H": add(thrusts, "force"), "sum T": add(holding, "force")}
    if isinstance(check.wall, dd.TwoBlockWall):
        found |= upper_block(check)
    found["ΣHe"] = add(thrusts, "force", "depth") - hinge * add(thrusts, "force")
    found["ΣTe"] = add(holding, "force", "depth") - hinge * add(holding, "force")
    return found


def upper_block(check):
    """What acts on the upper block of a strip that carries a load on its top alone, about the hinge below it."""
    wall = check.wall
    lever, height = wall.thickness / 2.0, (1.0 - check.value("mechanism", "", "hinge")) * wall.height
    weight = wall.density * wall.gravity * wall.thickness * height
    standing = weight * lever + wall.overburden * (lever + wall.eccentricity)
    return {"M_P,2": standing, "M_H,2": 0.0, "M_T,2": 0.0, "M_Q,2": weight * height / 2.0, "h_2": height}


def at_hinge(check, item):
    """Horizontal and vertical force at a hinge when the mechanism starts; of a strip with a load on its top alone."""
    if not isinstance(check.wall, dd.TwoBlockWall):
        own, alpha = sums(check), check.value("mechanism", "", "alpha_0")
        weights = [one for one in check.items if one.item != "masonry" and not math.isnan(one.arm)]
        down = math.fsum(one.force for one in weights if not math.isnan(one.stabilising))
        return {"H": abs(alpha * own["sum P"] + own["sum H"] - own["sum T"]), "V": down}
    lower, upper, load = (one.force for one in check.items)
    alpha, top = (check.value("mechanism", "", name) for name in ("alpha_0", "floor_top"))
    return {
        "base hinge": {"H": alpha * (lower + upper) - top, "V": lower + upper + load},
        "middle hinge": {"H": abs(top - alpha * upper), "V": upper + load},
        "top hinge": {"H": top, "V": load},
    }[item]


def of_ground(check, row):
    """Accelerations of the modes of a building, and of the ground that governs instead [g]."""
    found = {"a_Z,m": check.value("site", row.limit_state, "modal_pga")}
    if row.method == "nonlinear":
        period, damping = (check.value("nonlinear", row.limit_state, name) for name in ("period", "damping"))
        spectrum = check.site.spectrum(periods=[period, 2.0 * period], damping=damping, limit_state=row.limit_state)
        found["S_e(T)"] = float(spectrum.sa[0])
        modes = modes_in(Subject(check.wall, check, None, None), row.limit_state, "nonlinear")
        found["S_eZ,m"] = math.hypot(*(mode.peak * mode.resonance(period, damping) for mode in modes))
    return found


def known(check, state, without=""):
    """Values of the symbols of the sheet in a limit state, and of what its formulas have besides.

    Of the curve without some ties, if they are named.
    """
    values = {"g": check.wall.gravity, **sums(check, without)}
    # Of the period of a free element
    tall, thick = check.wall.height, check.wall.thickness
    values |= {"kappa": 6.2, "lambda": tall / thick, "L": tall, "W": check.wall.density * check.wall.gravity}
    for row in check.rows:
        if row.method == "untied" and row.item != without:
            continue
        if row.symbol and row.limit_state in ("", state) and row.method not in ("tie", "dynamic"):
            # The linear check of a state has rows of its own before those of the nonlinear one.
            values[row.symbol] = row.value
    if check.site.exceedance is not None and state:
        values["P_VR"] = check.site.exceedance[("SLD", "SLV", "SLC").index(state)]
    return values


LEAF = re.compile(
    r"@|sum P z\^2|sum P z|sum \w+"
    r"|(?<!\w)(?!(?:sqrt|min|max|ln)[(\[])(?!pi\b)[A-Za-z]\w*(?:,\w+)*\*?(?:\((?:T|T_0|d_C|r\*)\))?"
    r"|\d+(?:\.\d+)?(?:[eE][-+]?\d+)?"
)
CALLS = {"sqrt": math.sqrt, "min": min, "max": max, "ln": math.log, "pi": math.pi}


def leaves(text):
    return LEAF.findall(re.sub(r"\^2(?=\)|$|/| )(?<!z\^2)", "", text))


def by_hand(text):
    """The value of a formula in numbers."""
    return eval(text.replace("[", "(").replace("]", ")").replace("^", "**"), {"__builtins__": {}}, CALLS)


def in_symbols(text, values):
    """The value of a formula in symbols."""
    names = {}

    def named(found):
        word = found[0]
        if word[0].isdecimal():
            return word
        names[f"v{len(names)}"] = values[word]
        return f"v{len(names) - 1}"

    text = LEAF.sub(named, text).replace("[", "(").replace("]", ")")
    text = re.sub(r"(?<=[\w)]) (?=[\w(])", "*", text).replace("^", "**")
    return eval(text, {"__builtins__": {}}, CALLS | names)


@pytest.mark.parametrize("name", WALLS)
def test_every_number_of_a_sheet_follows_from_its_symbols(name, subjects):
    """The numbers give the value, the symbols give it too, and the n-th number is that of the n-th symbol."""
    check = subjects[name].check
    found = 0
    for row in check.rows:
        if not row.numbers:
            continue
        found += 1
        assert by_hand(row.numbers) == pytest.approx(row.value, rel=1e-6), (row.quantity, row.numbers)
        if row.method == "tie":
            continue
        values = known(check, row.limit_state, row.item if row.method == "untied" else "")
        values["C/D"] = values["a_gC/a_g"] = row.value
        values["alpha(d_C)"] = row.value * values.get("e*", 1.0) * values["FC"] / values["g"]
        if row.quantity == "friction_needed":
            values |= at_hinge(check, row.item)
        if row.method != "site":
            own = {
                one.symbol: one.value
                for one in check.rows
                if (one.method, one.limit_state) == (row.method, row.limit_state)
            }
            values |= {symbol: value for symbol, value in own.items() if symbol}
        values.setdefault("q", 1.0)
        values["a_Z"] = check.value("site", row.limit_state or "SLV", "floor_pga" if "floor" in name else "pga")
        if name == "low floor" and row.limit_state:
            values |= of_ground(check, row)
        assert in_symbols(row.expression, values) == pytest.approx(row.value, rel=1e-9), (row.quantity, row.expression)
        texts, symbols = leaves(row.numbers), leaves(row.expression)
        if len(symbols) > len(texts):
            # a_g S is one number, and so is a ratio of which it is multiplied.
            values["@"] = row.value if row.quantity == "capacity_ag" else values["a_g S"]
            values["@"] /= values["a_g"] if row.quantity == "capacity_ag" else 1.0
            symbols = leaves(re.sub("a_gC S|a_gC/a_g|a_g S", "@", row.expression))
        if row.quantity != "zeta_e":
            assert len(texts) == len(symbols), (row.quantity, row.expression)
            for symbol, text in zip(symbols, texts, strict=True):
                value = float(symbol) if symbol[0].isdecimal() else values[symbol]
                assert float(text) == pytest.approx(value, rel=1e-7), (row.quantity, symbol)
    assert found > 25


# --- Formulas of documents

# What units are in forces of kN, masses of t, and m
UNITS = {
    "MPa": 1e3,
    "cm²/m": 1e-4,
    "kNm/m": 1.0,
    "kN/m": 1.0,
    "t/m": 1.0,
    "m/s²": 1.0,
    "rad": 1.0,
    "cm": 1e-2,
    "m": 1.0,
    "s": 1.0,
    "g": 1.0,
}
WORDS = re.compile(
    r"sin|cos|tan|max\(|min\(|ln\(|FC|π|Σ|²|\d+(?:\.\d+)?|[-+/;·()\[\]\N{MINUS SIGN}]|[^\W\d]+(?:[²/]\w*²?)*| +"
)


def value_of(numeral):
    """The number that is shown."""
    text = numeral.text.replace("\N{MINUS SIGN}", "-").replace("\N{NARROW NO-BREAK SPACE}", "")
    return float(text) * 10.0 ** float((numeral.power or "0").replace("\N{MINUS SIGN}", "-"))


def tokens(part):
    """Tokens of a part of a formula: kind and text or value."""
    if isinstance(part, Fraction):
        return [("(", "("), *tokens(part.top), (")", ")"), ("op", "/"), ("(", "("), *tokens(part.bottom), (")", ")")]
    if isinstance(part, Root):
        return [("call", "sqrt("), *tokens(part.inside), (")", ")")]
    if isinstance(part, tuple):
        return [one for piece in part for one in tokens(piece)]
    if isinstance(part, Numeral):
        return [("number", value_of(part))]
    if isinstance(part, Symbol):
        return [("name", f"{part.letter}_{part.index}{part.mark}" if part.index else f"{part.letter}{part.mark}")]
    made = []
    for word in WORDS.findall(part):
        if word.isspace():
            made.append(("blank", " "))
        elif word[0].isdecimal():
            made.append(("number", float(word)))
        elif word in UNITS:
            made.append(("unit", UNITS[word]))
        elif word in ("sin", "cos", "tan"):
            made.append(("turn", word))
        elif word.endswith("(") and len(word) > 1:
            made.append(("call", word))
        elif word in "([":
            made.append(("(", "("))
        elif word in ")]":
            made.append((")", ")"))
        elif word in "FCπΣ²":
            made.append(("power" if word == "²" else "sum" if word == "Σ" else "name", word))
        else:
            made.append(("op", {"·": "*", ";": ",", "\N{MINUS SIGN}": "-"}.get(word, word)))
    return made


def joined(part):
    """Tokens of which sums, functions of a symbol and units are one."""
    given, made = tokens(part), []
    while given:
        kind, text = given.pop(0)
        if kind == "sum":
            text = f"Σ{given.pop(0)[1]}"
            if len(given) > 1 and given[0][0] == "blank" and given[1][1] in ("z", "e", "d_x"):
                text += given[1][1].replace("d_x", "z")
                del given[:2]
            if text == "ΣPz" and given and given[0][0] == "power":
                text += given.pop(0)[1]
            made.append(("name", text))
        elif kind == "turn":
            while given[0][0] == "blank":
                given.pop(0)
            if given[0][0] == "(":
                made.append(("call", f"{text}("))
                given.pop(0)
            else:
                made += [("call", f"{text}("), given.pop(0), (")", ")")]
        elif kind == "name" and len(given) > 2 and [one[0] for one in given[:3]] == ["(", "name", ")"]:
            made.append(("name", f"{text}({given[1][1]})"))
            del given[:3]
        elif kind == "unit":
            while made[-1][0] == "blank":
                made.pop()
            made += [("op", "*"), ("number", text)]
        elif kind != "blank":
            made.append((kind, text))
    return made


def text_of(part):
    """A part as a key."""
    return "".join(str(text) for _kind, text in joined(part))


def evaluated(part, values):
    """The value of a part; None if it has a symbol of no known value."""
    text, names, before = "", {}, ""
    for kind, word in joined(part):
        if kind in ("number", "name", "call", "(") and before in ("number", "name", ")", "power"):
            text += "*"
        if kind == "name" and word != "π":
            if word not in values:
                return None
            names[f"v{len(names)}"] = values[word]
            text += f"v{len(names) - 1}"
        elif kind == "number":
            text += repr(word)
        else:
            text += {"π": "pi", "²": "**2"}.get(word, word)
        before = kind
    functions = {name: getattr(math, name) for name in ("sin", "cos", "tan", "sqrt", "pi")}
    return eval(text, {"__builtins__": {}}, functions | {"max": max, "min": min} | names)


def symbols_of(check, state, without=""):
    """Values of symbols as documents write them, in kN, t and m."""
    mass = {"kg/m": 1e-3, "N/m": 1e-3, "N m/m": 1e-3, "N m2/m": 1e-3, "Pa": 1e-3, "N": 1e-3}
    units = {row.symbol: row.unit for row in check.rows}
    values = {text_of(symbol_of(name)): value * mass.get(units.get(name, ""), 1.0)
              for name, value in known(check, state, without).items()
              if not name.startswith(("sum", "Σ", "M_"))}  # fmt: skip
    values["W"] *= 1e-3
    own = sums(check, without)
    for name, shown in (("sum P", "ΣP"), ("sum P z", "ΣPz"), ("sum P z^2", "ΣPz²"), ("sum stabilising", "M_stab"),
                        ("sum overturning", "M_ov"), ("M_stab,P", "M_stab,P"), ("ΣPe", "ΣPe"), ("ΣQz", "ΣQz"),
                        ("ΣHe", "ΣHe"), ("ΣTe", "ΣTe")):  # fmt: skip
        values[shown] = 1e-3 * own[name]
    return values | {"u": own["u"], "FC": check.value("mechanism", "", "knowledge_factor")}


def documents(one, lang="en"):
    return Document(Language(lang), project.Project(), Subjects((one,)))


@pytest.mark.parametrize("name", WALLS)
def test_every_formula_of_a_document_gives_its_value(name, subjects):
    """In numbers and, as far as its symbols are known, in symbols, whose values are those of the numbers."""
    one = subjects[name]
    blocks = checks.checks(documents(one))
    state, values, pending = "SLV", symbols_of(one.check, "SLV"), {}
    counted = {"numbers": 0, "symbols": 0}
    for block in blocks:
        if isinstance(block, Paragraph):
            said = "".join(piece if isinstance(piece, str) else "" for piece in block.pieces)
            if found := re.fullmatch(r"(\w+), (SL[DVC]):", said):
                state = found[2]
                values = symbols_of(one.check, state)
                values |= {text_of(symbol_of(row.symbol)): row.value for row in one.check.rows
                           if (row.method, row.limit_state) == (found[1], state) and row.symbol}  # fmt: skip
                values.setdefault("q", 1.0)
                values["a_Z"] = one.check.value("site", state, "floor_pga" if one.is_on_floor else "pga")
                pending = {}
            elif found := re.fullmatch(r"(SL[VC]), without counting (.+):", said):
                state = found[1]
                values = symbols_of(one.check, state, found[2])
                values["a_Z"] = one.check.value("site", state, "floor_pga" if one.is_on_floor else "pga")
                pending = {}
        if not isinstance(block, Formula):
            continue
        head, *sides = block.sides
        key = text_of(head)
        *others, last = sides
        result = evaluated(last, {})
        if result is None:
            pending.setdefault(key, []).append(last)
            continue
        turns = re.fullmatch(r"(sin|tan)\((.+)\)", key)
        if turns:
            values[turns[2]] = getattr(math, f"a{turns[1]}")(result)
        elif name != "one after the other" or key not in values:
            values.setdefault(key, result)
            # Each hinge of a strip has a friction
            if key not in ("A", "B", "μ"):
                assert values[key] == pytest.approx(result, rel=2e-5), key
        for side in (*pending.pop(key, []), *others):
            got = evaluated(side, {})
            if got is not None:
                counted["numbers"] += 1
                assert got == pytest.approx(result, rel=2e-4), (key, side)
                continue
            got = evaluated(side, values)
            if got is not None and name != "one after the other":
                counted["symbols"] += 1
                assert got == pytest.approx(result, rel=2e-4), (key, side)
        # The n-th symbol has the n-th number, wherever each symbol has one.
        symbols, numbers = ([one for one in joined(side) if one[0] in ("name", "number") and one[1] != "π"]
                            for side in (others[-2:] if len(others) > 1 else ((), ())))  # fmt: skip
        if len(symbols) == len(numbers) and name != "one after the other":
            for (kind, symbol), (_kind, number) in zip(symbols, numbers, strict=True):
                if kind == "name" and symbol in values and not symbol.startswith("θ"):
                    assert number == pytest.approx(values[symbol], rel=2e-5), (key, symbol)
    assert counted["numbers"] > 12
    assert counted["symbols"] > 10 or name == "one after the other"
    states = {row.limit_state for row in one.check.rows if row.method == "nonlinear"}
    assert states == {"SLV", "SLC"}


def test_a_new_row_of_a_sheet_is_in_the_document(subjects):
    """With its formula and its place, and nothing is written for it."""
    check = subjects["bare"].check
    rows = list(check.rows)
    at = next(place for place, row in enumerate(rows) if row.quantity == "d_0")
    new = rows[at]._replace(quantity="mass", symbol="M_x*", value=120.0, unit="kg/m", formula="C8.9.9",
                            expression="sum P/(q g)", numbers="2354.4/(2 * 9.81)")  # fmt: skip
    rows.insert(at, new)
    one = subjects["bare"]
    grown = dataclasses.replace(one, check=dataclasses.replace(check, rows=tuple(rows)))
    (found,) = [
        block for block in checks.checks(documents(grown)) if isinstance(block, Formula) and block.place == "C8.9.9"
    ]
    assert [text_of(side) for side in found.sides[:1]] == ["M_x*"]
    assert evaluated(found.sides[2], {}) == pytest.approx(0.12)
    assert text_of(found.sides[3]) == "0.12*1.0"


@pytest.mark.parametrize("name", [name for name in WALLS if name not in ("strip",)])
def test_forces_on_the_base_are_in_equilibrium(name, subjects):
    """At activation the base takes what loads, thrusts, inertia and ties leave."""
    one = subjects[name]
    check, found = one.check, reactions_of(one)
    alpha = check.value("mechanism", "", "alpha_0")
    own = sums(check)
    force = {
        word: math.fsum(item.force for item in check.items if item.item.startswith(word)) for word in ("thrust", "tie")
    }
    assert found.activated == pytest.approx(force["thrust"] + alpha * own["sum P"] - force["tie"], rel=1e-9)
    pushed = math.fsum(item.force for item in check.items if item.item.startswith("mass"))
    assert found.vertical == pytest.approx(own["sum P"] - pushed, rel=1e-9)
    preload = math.fsum(4e7 * tie.section for tie in one.wall.ties) if hasattr(one.wall, "ties") else 0.0
    assert found.at_rest == pytest.approx(force["thrust"] - preload, rel=1e-9, abs=1e-9)
