"""dondolo: fragility of masonry walls that rock and overturn in earthquakes.

>>> import dondolo as dd
>>> wall = dd.OneSidedWall(height=1.5, thickness=0.25)
>>> records = dd.synthetic_records(magnitude=6.5, distance=10.0, site="shallow", n_records=10)
>>> stripes = dd.multiple_stripe(wall, records, levels=[0.6, 0.8, 1.0], progress=False)
>>> curve = stripes.fit()
>>> curve.status
'ok'

`dondolo.read_catalogue` reads recorded accelerograms.
"""

import importlib
import re
from pathlib import Path
from typing import Any

from dondolo._fortran.library import constants

__version__ = constants().version

# Names of the stub and their modules: nothing is imported before it is used.
_HOMES = {
    name: module
    for module, name in re.findall(
        r"(?m)^from (\S+) import (\w+) as \2$", Path(__file__).with_suffix(".pyi").read_text(encoding="utf-8")
    )
}

__all__ = sorted([*_HOMES, "__version__"])


def __getattr__(name: str) -> Any:
    if name not in _HOMES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    if name == "load":
        # A saved result is of any class, and a class is known once its module has been imported.
        for module in _HOMES.values():
            importlib.import_module(module)
    home = importlib.import_module(_HOMES[name])
    # A name without a value in its home is a module there.
    thing = getattr(home, name) if hasattr(home, name) else importlib.import_module(f"{_HOMES[name]}.{name}")
    globals()[name] = thing
    return thing


def __dir__() -> list[str]:
    return __all__
