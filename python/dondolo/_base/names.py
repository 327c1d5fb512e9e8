"""Public names of a module by their homes: nothing is imported before it is used."""

from __future__ import annotations

import importlib
import re
from pathlib import Path
from typing import Any


def homes_of(stub: Path) -> dict[str, str]:
    """Names of a stub, ``from home import name as name``, and the modules that have them."""
    return {
        name: module
        for module, name in re.findall(
            r"(?m)^from (\S+) import (\w+) as \2$", stub.with_suffix(".pyi").read_text(encoding="utf-8")
        )
    }


def load_name(name: str, of: str, homes: dict[str, str]) -> Any:
    """What a name stands for; AttributeError if the module `of` has none of it."""
    if name not in homes:
        raise AttributeError(f"module {of!r} has no attribute {name!r}")
    home = importlib.import_module(homes[name])
    # A name without a value in its home is a module there.
    found = vars(home).get(name)
    return importlib.import_module(f"{homes[name]}.{name}") if found is None else found
