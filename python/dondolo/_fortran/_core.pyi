"""Modules of the Fortran extension, which f2py makes of their sources; those beside it give their results types."""

from typing import Any

def __getattr__(name: str) -> Any: ...
