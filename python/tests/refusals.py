"""What is wrong with an argument, by the code of the error instead of its sentence."""

from collections.abc import Iterator
from contextlib import contextmanager

import pytest

import dondolo as dd


@contextmanager
def refused(code: str, variable: str) -> Iterator[None]:
    """Expect an InputError of a code that names a variable."""
    with pytest.raises(dd.errors.InputError) as error:
        yield
    assert [(one.code, one.variable) for one in error.value.errors] == [(code, variable)]
    assert str(error.value).startswith(variable)
