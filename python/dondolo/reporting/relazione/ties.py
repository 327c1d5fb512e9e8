"""Chapter 12 of a calculation report: ties and their anchors."""

from __future__ import annotations

from collections.abc import Sequence

from dondolo.checks.ntc import CodeCheck
from dondolo.reporting.blocks import Block, CaptionedTable, Heading, Note, Picture, symbol_of
from dondolo.reporting.content import Piece, Table
from dondolo.reporting.numerals import NONE, number, whole
from dondolo.reporting.relazione.checks import unit_of, value_of
from dondolo.reporting.relazione.document import Document, _
from dondolo.reporting.relazione.drawings import draw_anchor
from dondolo.reporting.relazione.subjects import Subject
from dondolo.reporting.units import UNITS, cell
from dondolo.walls.ties import given_ties


def ties(document: Document) -> list[Block]:
    """Chapter 12."""
    blocks: list[Block] = [Heading(document.text(_("Ties and their anchors")))]
    anchored: list[float | None] = []
    for is_whole in (False, True):
        several = [(name, one) for name, one in document.each() if one.is_whole == is_whole]
        if any(given_ties(one.wall) for _name, one in several):
            table, forces = _bars(document, several, is_whole=is_whole)
            blocks.append(table)
            anchored += forces
    if not anchored:
        return [*blocks, document.say(_("The walls have no ties."))]
    for name, one in document.each():
        if (anchors := _anchors(document, name, one.check)) is not None:
            blocks.append(anchors)
        blocks += _pictures(document, name, one)
    for quantity, words in _OPEN_TIES.items():
        loose = [
            f"{name}, {document.item(item)}" if len(document.names) > 1 else document.item(item)
            for name, one in document.each()
            for item, found in open_ties_of(one.check).items()
            if quantity in found
        ]
        if loose:
            blocks.append(Note("doubt", document.say(words, ties="; ".join(loose)).pieces))
    blocks.append(
        document.say(
            _(
                "{fyd} is the strength given in the field {field}, taken as the design value: neither {gamma} nor FC"
                " divides it here. Not checked: the anchor at the other end of a tie and what it pulls on, threads and"
                " welds, plates with ribs, and openings beside the plate."
            ),
            fyd=symbol_of("f_yd"),
            field="tie_strength",
            gamma=symbol_of("gamma_M0"),
        )
    )
    # An anchor that is computed here needs no other check of the same.
    if None in anchored:
        prompt = _("check of the anchors: bar, plate, bearing and punching of the masonry")
    else:
        prompt = _("what the strengths of the anchors above leave open: other end of the ties, threads and welds")
    return blocks + document.written("anchors", prompt)


def _bars(
    document: Document, several: Sequence[tuple[str, Subject]], *, is_whole: bool
) -> tuple[CaptionedTable, list[float | None]]:
    """Table of the bars of walls, all per metre or all whole, and the strengths of their anchors, None: not known."""
    rows = [
        (name, count, tie, item)
        for name, one in several
        for count, (tie, item) in enumerate(
            zip(given_ties(one.wall), [x for x in one.check.items if x.item.startswith("tie")], strict=False), 1
        )
    ]
    anchored = [
        next(
            (row.value for row in one.check.rows if (row.item, row.quantity) == (f"tie {count}", "anchor_force_per_m")),
            None,
        )
        for _name, one in several
        for count in range(1, len(given_ties(one.wall)) + 1)
    ]
    heads = (
        (_("area [cm²]"), _("force that holds [kN]"), _("strength of the anchor [kN]")) if is_whole
        else (_("area [cm²/m]"), _("force that holds [kN/m]"), _("strength of the anchor [kN/m]"))
    )  # fmt: skip
    area, force = UNITS["m2/m"], UNITS["N/m"]
    columns: dict[Piece, Sequence[Piece]] = {
        document.text(_("wall")): [name for name, *_rest in rows],
        document.text(_("tie")): [whole(count) for _name, count, *_rest in rows],
        document.text(_("height [m]")): [number(tie.height) for _name, _count, tie, _item in rows],
        document.text(heads[0]): [cell(tie.section, area) for _name, _count, tie, _item in rows],
        document.text(_("length [m]")): [number(tie.length) for _name, _count, tie, _item in rows],
        document.text(_("strength [MPa]")): [cell(tie.strength, UNITS["Pa"]) for _name, _count, tie, _item in rows],
        document.text(heads[1]): [cell(item.force, force, 5) for *_rest, item in rows],
        document.text(heads[2]): [
            cell(one, force, 5) if one is not None else document.text(_("not checked")) for one in anchored
        ],
    }
    words = _("Ties of whole bodies.") if is_whole else _("Ties, per metre of wall.")
    return CaptionedTable(Table.of(columns), document.text(words)), anchored


def open_ties_of(check: CodeCheck) -> dict[str, tuple[str, ...]]:
    """What is open of each tie; an anchor whose plate has masonry of another confidence factor is a case of its own."""
    return {
        item: tuple(
            "anchor_knowledge"
            if name == "anchor_checked" and check._has("tie", "", "anchor_force", item=item)
            else name
            for name in names
        )
        for item, names in check.open_ties.items()
    }


# What is open of ties, in sentences
_OPEN_TIES = {
    "hierarchy": _(
        "Hierarchy of strengths not respected: {ties}. The anchor gives way before the bar yields, and at once:"
        " the linear check of SLV with the behaviour factor is not applicable."
    ),
    "plate_verified": _(
        "Plate too thin: {ties}. The strength of the anchor is that of a plate that presses on the masonry evenly,"
        " as a plate that bends does not."
    ),
    "anchor_knowledge": _(
        "Strengths of the masonry at the plate with a smaller confidence factor than that of the check: {ties}."
    ),
    "anchor_checked": _(
        "Anchors not checked: {ties}. The force of these ties is that of the bar alone. Bearing and punching of the"
        " masonry under the plate, and the plate, must be checked; an anchor that is weaker than the bar is brittle,"
        " and the behaviour factor of the linear check does not apply."
    ),
}


def _anchors(document: Document, name: str, check: CodeCheck) -> CaptionedTable | None:
    """Bar, plate, masonry and hierarchy of the ties of a wall, a column for each tie."""
    found = [row for row in check.rows if row.method == "tie"]
    items = list(dict.fromkeys(row.item for row in found))
    rows = {row.quantity: row for row in found}
    if not items:
        return None
    known = {(row.item, row.quantity): row for row in found}
    columns: dict[Piece, Sequence[Piece]] = {
        document.text(_("quantity")): [document.meaning(row) for row in rows.values()],
        document.text(_("symbol")): [symbol_of(row.symbol) if row.symbol else NONE for row in rows.values()],
        document.text(_("formula")): [
            symbol_of(row.expression.replace("^2", "²")) if row.expression else NONE for row in rows.values()
        ],
    }
    for item in items:
        columns[document.item(item)] = [value_of(document, check, known.get((item, each))) for each in rows]
    columns[document.text(_("unit"))] = [unit_of(row).name for row in rows.values()]
    words = [document.text(word) for word in (_("symbol"), _("formula"), _("unit"))]
    caption = document.titled(document.text(_("Bar, masonry at the plate, plate and hierarchy of strengths")), name)
    return CaptionedTable(Table.of(columns, words), caption)


def _pictures(document: Document, name: str, one: Subject) -> list[Block]:
    """Plate and frustum of the ties whose anchors are computed from a plate, one for those that are alike."""
    alike: dict[tuple[float, ...], list[str]] = {}
    for item in dict.fromkeys(row.item for row in one.check.rows if row.method == "tie"):
        numbers = {row.quantity: row.value for row in one.check.rows if (row.method, row.item) == ("tie", item)}
        if "cone_force" in numbers:
            alike.setdefault(tuple(numbers.values()), []).append(item)
    pictures: list[Block] = []
    for items in alike.values():
        words = ", ".join(map(document.item, items))
        title = document.text(_("Plate, and frustum of masonry that it pulls out, sizes in cm: {ties}"), ties=words)
        pictures.append(
            Picture(
                lambda item=items[0]: draw_anchor(document, one, item),  # type: ignore[misc]
                document.titled(title, name),
                document.text(
                    _("The plate on the wall in section and from the front, with the frustum at 45 degrees.")
                ),
            )
        )
    return pictures
