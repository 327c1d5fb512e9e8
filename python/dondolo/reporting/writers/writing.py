"""A document of blocks as a file: Word, HTML or PDF, by its suffix."""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path

from dondolo._fortran.origins import check_replaced
from dondolo._storage import tables
from dondolo.errors import silent
from dondolo.reporting.blocks import Block
from dondolo.reporting.writers.imprint import Imprint
from dondolo.reporting.writers.pdf import check_printer, sets_formulas, write_pdf
from dondolo.reporting.writers.web import page

SUFFIXES = (".docx", ".html", ".htm", ".pdf")


def check_target(target: Path) -> None:
    """Refuse to make a document, which takes seconds, that cannot be written, or would replace another file.

    Raises
    ------
    DondoloError
        What writes such a file is not installed.
    InputError
        An existing file that is no report.
    """
    suffix = target.suffix.lower()
    if suffix == ".pdf":
        check_printer()
    elif suffix == ".docx":
        from dondolo.reporting.writers.word import check_docx

        check_docx()
    check_replaced(target, "report")


@contextmanager
def undisturbed() -> Iterator[None]:
    """Draw until the end of the block without windows and warnings."""
    import matplotlib.pyplot as plt

    # Choose the backend first: that may turn interactive mode on, and ioff restores the mode it finds.
    plt.draw_if_interactive()  # type: ignore[no-untyped-call]
    with plt.ioff(), silent():
        yield


def write(
    target: Path, blocks: Sequence[Block], imprint: Imprint, template: str | os.PathLike[str] | None = None
) -> list[str]:
    """Write a document, which appears whole or not at all; gives what was left out of a template of Word."""
    suffix = target.suffix.lower()
    if suffix == ".docx":
        from dondolo.reporting.writers.word import write_word

        return write_word(target, blocks, imprint, template)
    if suffix == ".pdf":
        write_pdf(target, page(blocks, imprint, formulas=sets_formulas()), imprint.mark)
    else:
        tables.write_lines(target, [page(blocks, imprint, formulas=True).rstrip("\n")])
    return []
