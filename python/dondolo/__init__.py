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
from pathlib import Path
from typing import Any

from dondolo._base.names import homes_of, load_name
from dondolo._fortran.library import constants

__version__ = constants().version

_HOMES = homes_of(Path(__file__))

__all__ = sorted([*_HOMES, "__version__"])


def __getattr__(name: str) -> Any:
    if name == "load":
        # A saved result is of any class, and a class is known once its module has been imported.
        for module in {*_HOMES.values(), *homes_of(Path(__file__).with_name("results.py")).values()}:
            importlib.import_module(module)
    globals()[name] = thing = load_name(name, __name__, _HOMES)
    return thing


def __dir__() -> list[str]:
    return __all__
