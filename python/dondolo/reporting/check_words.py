"""Checks, the walls that they are of, and the numbers of their sheets in words."""

from __future__ import annotations

from collections.abc import Sequence

from dondolo._base.wording import in_english, named, say
from dondolo._fortran.checks import SheetRow
from dondolo.checks.ntc import CodeCheck
from dondolo.checks.plots import check_name
from dondolo.reporting.content import Piece, Table
from dondolo.reporting.numerals import NONE, whole
from dondolo.reporting.units import UNITS, Unit, cell
from dondolo.reporting.walls import mechanism_of
from dondolo.reporting.words import in_words, item_in_words
from dondolo.walls.wall import Wall

# What sentences that are said elsewhere are marked by for the catalogues
_ = str
# Numbers of the sheet that are 1 or 0
_YES_OR_NO = (
    *("verified", "free_element", "applicable", "required", "extrapolated", "turns_first", "hierarchy"),
    *("plate_verified", "anchor_checked"),
)
# References with words
_LAWS = (_("D.M. 14-1-2008, annex A"), _("D.M. 14-1-2008, annex B"))


def check_in_words(method: str, state: str, between: str = " ") -> str:
    """A check in words."""
    if method == "site":
        return say("site {state}", state=state).strip()
    return f"{method}{between}{state}".strip() if in_english() else check_name(method, state)


def name_among(wall: Wall, walls: Sequence[Wall]) -> str:
    """The name of a wall, with its mechanism where other rows have the same name."""
    is_alone = sum(other.name == wall.name for other in walls) == 1
    return wall.name if is_alone else f"{wall.name}, {mechanism_of(wall)}"


def required(check: CodeCheck) -> str:
    """The checks that the verdict rests on."""
    return ", ".join(check_in_words(*key) for key in check.required)


def _unit(row: SheetRow) -> Unit:
    """The unit that a number of the sheet is shown in."""
    return UNITS.get(row.unit, Unit(row.unit))


def _flag(row: SheetRow) -> Piece:
    """A number of the sheet that is 1 or 0; English meanings say what each is, Italian ones are cut before."""
    if in_english():
        return whole(row.value)
    if row.value > 0.0:
        return say("yes")
    return say("perhaps") if row.quantity == "free_element" else say("no")


def _meaning(row: SheetRow) -> str:
    """What a number of the sheet is."""
    return row.meaning if in_english() else named("quantity of a check", row.quantity).partition(":")[0]


def sheet_table(check: CodeCheck) -> Table:
    """All numbers, in the order of the calculation."""
    counts = ("records", "histories", "beyond")
    shown = [row for row in check.rows if not row.quantity.startswith("probability")]
    texts = say("check"), say("symbol"), say("unit"), say("formula")
    columns: dict[Piece, Sequence[Piece]] = {
        say("quantity"): [_meaning(row) for row in shown],
        texts[0]: [
            f"{item_in_words(row.item) if row.item else in_words('method', row.method)} {row.limit_state}".strip()
            for row in shown
        ],
        texts[1]: [row.symbol or NONE for row in shown],
        say("value"): [
            NONE
            if check._is_void(row)
            else whole(row.value)
            if row.quantity in counts
            else _flag(row)
            if row.quantity in _YES_OR_NO
            else (f"{row.bound} " * bool(row.bound), cell(row.value, _unit(row), 6))
            for row in shown
        ],
        texts[2]: [say(_unit(row).name) if row.unit else NONE for row in shown],
        texts[3]: [say(row.formula) if row.formula in _LAWS else row.formula or NONE for row in shown],
    }
    return Table.of(columns, texts)
