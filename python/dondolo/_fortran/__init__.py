"""The boundary to Fortran."""

import importlib
import os


def _load() -> None:
    """Load the extension so that its threads sleep while they wait.

    OpenMP reads the policy once, when it is loaded. By default threads spin for several milliseconds after each call
    and before each barrier, and take the processor from everything else.
    """
    if "OMP_WAIT_POLICY" in os.environ or "GOMP_SPINCOUNT" in os.environ:
        return
    os.environ["OMP_WAIT_POLICY"] = "passive"
    try:
        importlib.import_module("dondolo._fortran._core")
    finally:
        # Programs that this one starts decide for themselves.
        del os.environ["OMP_WAIT_POLICY"]


_load()
