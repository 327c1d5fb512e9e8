"""Types of results that analyses and readers return, for annotations and `isinstance`.

>>> import dondolo as dd
>>> isinstance(dd.OneSidedWall(1.5, 0.25).terms(0.0), dd.results.Terms)
True
"""

from pathlib import Path
from typing import Any

from dondolo._base.names import homes_of, load_name

_HOMES = homes_of(Path(__file__))

__all__ = sorted(_HOMES)


def __getattr__(name: str) -> Any:
    globals()[name] = thing = load_name(name, __name__, _HOMES)
    return thing


def __dir__() -> list[str]:
    return __all__
