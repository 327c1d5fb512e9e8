"""Chapter of a report on its records, and what is known of them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from dondolo._base.wording import say
from dondolo._storage.run_file import RECORD_FACTS
from dondolo.analysis.response import Response
from dondolo.analysis.stripes import Stripes
from dondolo.populations.typology import Typology
from dondolo.records.record import Record
from dondolo.records.synthetic import SYNTHETIC
from dondolo.reporting.blocks import Block, Details, Facts
from dondolo.reporting.content import Pairs, Piece, Table, level_unit
from dondolo.reporting.numerals import number, whole
from dondolo.reporting.parts import captioned, paragraph
from dondolo.reporting.run import Run

# What sentences that are said elsewhere are marked by for the catalogues
_ = str
# What a table of records says of each
_DESCRIBED = ("event", *RECORD_FACTS)


def has_vertical(run: Run) -> bool | None:
    """Whether vertical ground motion was applied; None where the results do not know."""
    if run.file is not None:
        return bool(run.file.setting("records", "vertical", "none") == "recorded")
    if run.records:
        return any(record.vertical is not None for record in run.records)
    return run.results.uplift is not None if isinstance(run.results, Stripes) else None


def records(run: Run) -> list[Block]:
    """The records, and what is known of them."""
    results = run.results
    pairs: Pairs = []
    if run.file is not None:
        catalogue = run.file.setting("records", "catalogue", "")
        polarity = say(run.file.setting("records", "polarity", "").replace("_", " "))
        pairs += [(name, text) for name, text in ((say("catalogue"), catalogue), (say("polarity"), polarity)) if text]
    if has_vertical(run):
        factor = 1.0 if run.file is None else run.file.setting("records", "vertical_factor", 1.0)
        scaled = "" if factor == 1.0 else say(", times {factor:g}", factor=float(factor))
        applied = say("applied: recorded components, scaled as their records")
        pairs.append((say("vertical motion"), applied + scaled))
    if isinstance(results, Typology):
        few, many = int(results.histories.min()), int(results.histories.max())
        text = say("{few} to {many}, by mechanism", few=few, many=many) if few < many else str(few)
        pairs.append((say("histories of a stripe"), text))
    if isinstance(results, Response):
        pairs += [
            *run.records[0]._facts(),
            (say("record"), results.record.name),
            (say("factor"), number(results.scale)),
        ]
    formats = _formats(run)
    if SYNTHETIC in formats:
        counts = {"some": list(formats).count(SYNTHETIC), "all": len(formats)}
        pairs.append((say("origin"), say("{some} of {all} records are synthetic: computed, not recorded", **counts)))
    blocks: list[Block] = [Facts(tuple(pairs))] if pairs else []
    if (table := _known_records(run)) is not None:
        title = say("Table of the records ({total})", total=table.total)
        caption = say("Records, as their headers and the catalogue describe them.")
        blocks.append(Details(title, (captioned(table, caption),)))
    if isinstance(results, Stripes):
        levels, histories = len(results.levels), _histories_table(results)
        caption = (
            say("Records, and collapses at {levels} levels.", levels=levels)
            if levels > 1
            else say("Records, and collapses at one level.")
        )
        title = say("Table of the histories of a stripe ({total})", total=histories.total)
        blocks.append(Details(title, (captioned(histories, caption),)))
    elif table is None and not isinstance(results, Response):
        words = _("The results contain counts of histories, not the records: keep the catalogue and its files with this"
                  " report.")  # fmt: skip
        blocks.append(paragraph(say(words)))
    return blocks


def _known_records(run: Run) -> Table | None:
    """The records, from what knows most of them; one at hand is told by itself."""
    results = run.results
    if run.records and not isinstance(results, Response):
        return _records_table(run.records)
    if run.file is not None and run.file.records:
        return _stored_records_table(run.file.records)
    if isinstance(results, Stripes) and any(results.events):
        named = zip(results.record_names, results.events, strict=False)
        return _stored_records_table([{"name": name, "event": event} for name, event in named])
    return None


def _formats(run: Run) -> Sequence[str]:
    """Formats that the records were read in."""
    if run.records:
        return [record.metadata.get("format", "") for record in run.records]
    if run.file is not None and run.file.records:
        return [one.get("format", "") for one in run.file.records]
    return run.results.record_formats if isinstance(run.results, Stripes) else ()


def _stored_records_table(stored: Sequence[Mapping[str, str]]) -> Table:
    """Records of result files, which have their names and headers, and not their samples."""
    columns: dict[Piece, Sequence[Piece]] = {say("record"): [one["name"] for one in stored]}
    described = _described(stored)
    return Table.of(columns | described, tuple(map(str, described)))


def _described(headers: Sequence[Mapping[str, str]]) -> dict[Piece, Sequence[Piece]]:
    """What headers and catalogue state of each record, and that they do not."""
    missing = say("not given")
    return {say(name): [one.get(name) or missing for one in headers] for name in _DESCRIBED}


def _histories_table(stripes: Stripes) -> Table:
    """The histories of a stripe; the level over the factor is the intensity of the record as it is."""
    polarity = say("polarity")
    unscaled = np.nanmax(stripes.levels[:, None] / stripes.scale, axis=0)
    columns: dict[Piece, Sequence[Piece]] = {
        say("record"): list(stripes.record_names),
        polarity: [say("reversed") if sign < 0 else say("as recorded") for sign in stripes.polarity],
        say("{im} unscaled [{unit}]", im=stripes.im, unit=level_unit(stripes.im)): [number(x) for x in unscaled],
        say("factor from"): [number(x) for x in np.nanmin(stripes.scale, axis=0)],
        say("to"): [number(x) for x in np.nanmax(stripes.scale, axis=0)],
        say("collapses"): [whole(z) for z in stripes.collapsed.sum(axis=0)],
    }
    return Table.of(columns, (polarity,))


def _records_table(records: Sequence[Record]) -> Table:
    """Records that are at hand."""
    columns: dict[Piece, Sequence[Piece]] = {say("record"): [one.name for one in records]}
    described = _described([one.metadata for one in records])
    columns |= described
    columns |= {
        "PGA [g]": [number(one.intensity("pga")) for one in records],
        "PGV [m/s]": [number(one.intensity("pgv")) for one in records],
        say("duration [s]"): [number(one.duration) for one in records],
        say("time step [s]"): [number(one.dt) for one in records],
    }
    if any(one.processing for one in records):
        columns[say("processing")] = ["; ".join(one.processing) for one in records]
    if any("reading" in one.metadata for one in records):
        columns[say("reading")] = [one.metadata.get("reading", "") for one in records]
    return Table.of(columns, (*map(str, described), say("processing"), say("reading")))
