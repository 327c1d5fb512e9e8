"""Procedures of the Fortran extension, made by f2py from dondolo_f2py.f90; _binding gives their results types."""

from typing import Any

def __getattr__(name: str) -> Any: ...
