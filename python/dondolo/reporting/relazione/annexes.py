"""Annexes of a calculation report: data, files with their checksums, and records."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from dondolo._storage.run_file import RECORD_FACTS, RunFile
from dondolo.exchange.case_text import case_text
from dondolo.records.synthetic import SYNTHETIC
from dondolo.reporting.blocks import Annexes, Block, CaptionedTable, Heading, Listing
from dondolo.reporting.content import Piece, Table
from dondolo.reporting.numerals import NONE, Numeral, number, whole
from dondolo.reporting.relazione.document import Document, _
from dondolo.reporting.relazione.outcome import runs_of

_DECIMAL = re.compile(r"\d+\.\d+")


def annexes(document: Document) -> list[Block]:
    """What belongs to the calculation and not into the report."""
    blocks: list[Block] = [Annexes(document.text(_("Annexes")))]
    for title, one in runs_of(document):
        text = case_text(one.settings)
        if text:
            blocks += [Heading(document.text(_("Data of the calculation: {wall}"), wall=title), 2), Listing(text)]
    listed: list[tuple[str, RunFile, Mapping[str, tuple[float, float]]]] = []
    known: list[Mapping[str, Any]] = []
    for title, one in runs_of(document):
        if one.inputs:
            blocks.append(Heading(document.text(_("Files and checksums: {wall}"), wall=title), 2))
            new = [each for each in one.inputs if each not in known]
            blocks += [_files(document, new)] if new else []
            if len(new) < len(one.inputs):
                blocks.append(document.say(_("The other files, with the same checksums, are listed above.")))
            known += new
        if one.records:
            blocks.append(Heading(document.text(_("Records: {wall}"), wall=title), 2))
            factors = _factors(document, one)
            same = next((name for name, other, its in listed if (other.records, its) == (one.records, factors)), None)
            if same is not None:
                blocks.append(document.say(_("The records, and the range of their factors, are those of {wall}."),
                                           wall=same))  # fmt: skip
                continue
            listed.append((title, one, factors))
            blocks += _records(document, one, factors)
    return blocks


def _files(document: Document, files: Sequence[Mapping[str, Any]]) -> CaptionedTable:
    """Files of a run."""
    columns: dict[Piece, Sequence[Piece]] = {
        document.text(_("file")): [str(each["path"]) for each in files],
        document.text(_("bytes")): [NONE if each["bytes"] is None else whole(each["bytes"]) for each in files],
        "CRC-32": [str(each["crc32"]) for each in files],
    }
    return CaptionedTable(Table.of(columns), document.text(_("Files that the results are of.")))


def _factors(document: Document, one: RunFile) -> Mapping[str, tuple[float, float]]:
    """Least and greatest factor of each record, of one wall."""
    stripes = next((each.results.stripes for each in document.subjects.several if each.results.run is one), None)
    if stripes is None:
        return {}
    found: dict[str, tuple[float, float]] = {}
    for name, low, high in zip(
        stripes.record_names, np.nanmin(stripes.scale, axis=0), np.nanmax(stripes.scale, axis=0), strict=True
    ):
        least, most = found.get(name, (math.inf, -math.inf))
        found[name] = (min(least, float(low)), max(most, float(high)))
    return found


def _stated(text: str) -> Piece:
    """What a header states of a record: a number has the decimal mark of the language."""
    return Numeral(text) if _DECIMAL.fullmatch(text) else text


def _records(document: Document, one: RunFile, factors: Mapping[str, tuple[float, float]]) -> list[Block]:
    """Records of a run; what no record states is said once."""
    heads = {
        "event": document.text(_("event")),
        "date": document.text(_("date")),
        "magnitude": document.text(_("magnitude")),
        "station": document.text(_("station")),
        "component": document.text(_("component")),
    }
    none = document.text(_("not given"))
    stated = {name: [each.get(name) for each in one.records] for name in ("event", *RECORD_FACTS)}
    columns: dict[Piece, Sequence[Piece]] = {document.text(_("record")): [each["name"] for each in one.records]}
    for name, values in stated.items():
        if any(values):
            columns[heads[name]] = [_stated(value or none) for value in values]
    if factors:
        ends = [factors.get(each["name"], (math.nan, math.nan)) for each in one.records]
        columns[document.text(_("factor from"))] = [number(low) for low, _high in ends]
        columns[document.text(_("to"))] = [number(high) for _low, high in ends]
    caption = document.text(_("Records, and the range of their factors of scale."))
    blocks: list[Block] = [CaptionedTable(Table.of(columns, list(heads.values())), caption)]
    if synthetic := [each for each in one.records if each.get("format") == SYNTHETIC]:
        blocks.append(document.say(_("{some} of {all} records are synthetic: computed, not recorded."),
                                   some=str(len(synthetic)), all=str(len(one.records))))  # fmt: skip
    if missing := [heads[name] for name, values in stated.items() if not any(values)]:
        blocks.append(document.say(_("Not given for any record: {facts}."), facts=", ".join(missing)))
    return blocks
