"""BibTeX of dondolo and of the sources of the methods that results have used."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import fields, is_dataclass
from typing import Any

from dondolo._base.arguments import argument_error
from dondolo._fortran.library import bibtex
from dondolo._storage.run_file import RunFile, sources_of_measure
from dondolo.analysis.cloud import Cloud
from dondolo.analysis.incremental import Incremental
from dondolo.analysis.overturning import OverturningSpectrum
from dondolo.analysis.response import Response
from dondolo.analysis.stripes import Stripes
from dondolo.checks.ntc import CodeCheck
from dondolo.curves.fragility import Fragility
from dondolo.exchange.results import Results
from dondolo.populations.uncertain_wall import UncertainWall
from dondolo.records.record import Record
from dondolo.walls.wall import Wall

# Methods that results are made by, in the words of dondolo_files_references
_METHODS: dict[type, str] = {
    Cloud: "cloud",
    CodeCheck: "check",
    Incremental: "incremental",
    OverturningSpectrum: "overturning",
    UncertainWall: "uncertainty",
}
# Engine with a source, which single motions take
_ADAPTIVE = "rk45"


class Citation(str):
    """BibTeX, which an interpreter and a notebook show as it is."""

    __slots__ = ()

    def __repr__(self) -> str:
        return str(self)


def cite(*results: Any) -> Citation:
    """BibTeX entries of dondolo, of the paper that it follows, and of the sources of the methods that results used.

    Parameters
    ----------
    *results : Results, Stripes, Fragility, Typology, Response, Wall, ...
        Any results, walls and records; without any, the entries of dondolo and of the paper.

    Returns
    -------
    str
        One entry after the other. That of dondolo has its version and the commit that was built. Sources are those of
        mechanisms and models of restitution, of the fit and its standard errors, of intensity measures, codes and
        synthetic records. ``dondolo --cite CASE.nml`` prints them for a case.

    Raises
    ------
    InputError
        An argument that is not a result, such as a number.

    Examples
    --------
    >>> import dondolo as dd
    >>> wall = dd.TwoBlockWall(height=3.0, thickness=0.25, hinge=0.6)
    >>> print(dd.cite(wall))  # doctest: +ELLIPSIS
    @misc{dondolo,
    ...
    @article{sorrentino2008,
    ...
    """
    for one in results:
        if not is_dataclass(one) and not isinstance(one, (list, tuple)):
            raise argument_error("wrong_type", "results", f": {type(one).__name__} has no sources to cite")
    return Citation("\n".join(bibtex(words_of(*results))))


def words_of(*things: Any) -> list[str]:
    """What results have used, in the words of dondolo_files_references, each once."""
    return list(dict.fromkeys(_words(things, set())))


def _words(thing: Any, seen: set[int]) -> Iterator[str]:
    """Words of a thing and of its parts."""
    if id(thing) in seen:
        return
    seen.add(id(thing))
    if isinstance(thing, Results) and thing.run.references:
        # The case itself knows them.
        thing = thing.run
    if isinstance(thing, RunFile):
        yield from thing.references
        return
    if type(thing) in _METHODS:
        yield _METHODS[type(thing)]
    if isinstance(thing, Record):
        yield thing.metadata.get("format", "")
        return
    if isinstance(thing, Wall):
        yield from thing._sources()
        return
    if isinstance(thing, Fragility) and thing.has_fit and thing.errors != "given":
        yield "fit"
        yield thing.errors
    if isinstance(thing, Response) or (isinstance(thing, Stripes) and thing.engine == _ADAPTIVE):
        yield _ADAPTIVE
    if is_dataclass(thing):
        yield from getattr(thing, "record_formats", ())
        measure = getattr(thing, "im", None)
        if isinstance(measure, str):
            yield from sources_of_measure(measure)
        for field in fields(thing):
            yield from _words(getattr(thing, field.name), seen)
    elif isinstance(thing, Mapping):
        for value in thing.values():
            yield from _words(value, seen)
    elif isinstance(thing, (list, tuple)):
        for value in thing:
            yield from _words(value, seen)
