"""What lives in Fortran, and is freed there when nothing refers to it here."""

from __future__ import annotations

from dondolo._fortran import _core

_free = _core.library.free


class Handle:
    """Records, walls or a study that were uploaded.

    It cannot be pickled: what it was made of is sent instead, and uploaded again where it arrives.

    Parameters
    ----------
    number : int
        The handle of Fortran.
    needs : Handle, optional
        What must not be freed before it.
    """

    __slots__ = ("_needs", "number")

    def __init__(self, number: int, needs: Handle | None = None) -> None:
        self.number = number
        self._needs = needs

    def __del__(self) -> None:
        # The end of the process frees everything, and may have emptied this module before.
        if _free is not None:
            _free(self.number)

    def __reduce__(self) -> str:
        raise TypeError("a handle is valid in its own process only")
