"""Modules of the Fortran extension, which f2py makes from their sources; _binding gives their results types."""

from typing import Any

def __getattr__(name: str) -> Any: ...
