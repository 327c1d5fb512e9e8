"""Figures in files whose names are dondolo's: each gives the run that it shows, and only such a file is replaced."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from dondolo._fortran.files import whole_file
from dondolo._fortran.origins import check_replaced, derived_mark
from dondolo.figures.layout import lay_out
from dondolo.figures.themes import theme
from dondolo.figures.wording import set_decimal_marks

# Formats of Matplotlib that have metadata, and where in it the mark is
_METADATA = {"png": "Software", "pdf": "Creator", "svg": "Creator", "ps": "Creator", "eps": "Creator"}
# Formats that end by themselves, so that readers do not look at what follows
_ENDED = ("gif", "jpg", "jpeg", "tif", "tiff", "webp")


def save_figure(figure: Any, path: str, kind: str, run: str, dpi: float | None = None) -> None:
    """Save a figure of a run; the file appears whole or not at all.

    Parameters
    ----------
    figure : Figure
        Of Matplotlib.
    path : str
        The file; an earlier figure of dondolo is replaced, any other file is not.
    kind : str
        A format of Matplotlib. In those that have no place for a mark, such as 'raw', a file is not replaced.
    run : str
        Name of the run.
    dpi : float, optional
        Dots per inch of pictures; those of the style if left out.

    Raises
    ------
    InputError
        Another file has the name.
    DondoloError
        The file cannot be written.
    ValueError
        Matplotlib does not know the format.
    """
    check_replaced(path, "figure")
    options: dict[str, Any] = {"dpi": theme().rc["savefig.dpi"] if dpi is None else dpi}
    if kind in _METADATA:
        options["metadata"] = {_METADATA[kind]: derived_mark("figure", run)}
    if kind == "png":
        # As small as by the default of 6, in two thirds of the time
        options["pil_kwargs"] = {"compress_level": 3}
    set_decimal_marks(figure)
    lay_out(figure)
    with whole_file(path) as part:
        figure.savefig(part, format=kind, **options)
        if kind in _ENDED:
            mark_end(part, "figure", run)


def mark_end(part: Path, kind: str, run: str) -> None:
    """Append the mark to a file in a format that ends by itself."""
    with part.open("ab") as file:
        file.write(derived_mark(kind, run).encode())
