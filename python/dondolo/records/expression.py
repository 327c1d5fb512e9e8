"""Conditions on the columns of a table, such as ``magnitude >= 6 and 0.1 < pga < 0.5``."""

from __future__ import annotations

import ast
import operator
import re
from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from dondolo._base.arguments import argument_error
from dondolo.errors import InputError

_COMPARISONS: dict[type, Callable[..., Any]] = {
    ast.Eq: operator.eq,
    ast.NotEq: operator.ne,
    ast.Lt: operator.lt,
    ast.LtE: operator.le,
    ast.Gt: operator.gt,
    ast.GtE: operator.ge,
    ast.In: lambda values, allowed: np.isin(values, allowed),
    ast.NotIn: lambda values, allowed: np.isin(values, allowed, invert=True),
}
_OPERATIONS: dict[type, Callable[..., Any]] = {
    ast.Add: operator.add,
    ast.Sub: operator.sub,
    ast.Mult: operator.mul,
    ast.Div: operator.truediv,
    ast.Pow: operator.pow,
}


def evaluate(expression: str, column: Callable[[str], NDArray[Any]], length: int) -> NDArray[np.bool_]:
    """For which rows of a table a condition holds.

    Parameters
    ----------
    expression : str
        Names of columns, numbers, texts in quotes and lists of them in brackets, with arithmetic, comparisons, `in`,
        `and`, `or` and `not`. Names between backticks may have any characters.
    column : callable
        Values of the column of a name, numbers or texts; raises InputError for one that there is not.
    length : int
        Number of rows.

    Returns
    -------
    ndarray of bool, shape (length,)

    Raises
    ------
    InputError
        What cannot be read, or is no condition.
    """
    if not isinstance(expression, str) or not expression.strip():
        raise argument_error("wrong_type", "expression", f" = {expression!r}: must be a condition, such as 'pga > 0.1'")
    quoted: list[str] = []

    def name_of(found: re.Match[str]) -> str:
        quoted.append(found.group(1))
        return f"_quoted_{len(quoted) - 1}"

    def value(node: ast.expr) -> Any:
        match node:
            case ast.Name(id=name):
                return column(quoted[int(name[8:])] if name.startswith("_quoted_") else name)
            case ast.Constant(value=constant) if isinstance(constant, (int, float, str)):
                return constant
            case ast.List(elts=parts) | ast.Tuple(elts=parts):
                return [value(part) for part in parts]
            case ast.UnaryOp(op=ast.USub(), operand=inner):
                return -value(inner)
            case ast.UnaryOp(op=ast.Not(), operand=inner):
                return ~condition(inner)
            case ast.BinOp(op=operation, left=left, right=right) if type(operation) in _OPERATIONS:
                return _OPERATIONS[type(operation)](value(left), value(right))
            case ast.BoolOp(op=both, values=parts):
                join = np.logical_and if isinstance(both, ast.And) else np.logical_or
                return join.reduce([condition(part) for part in parts])
            case ast.Compare(left=left, ops=operations, comparators=others):
                held, one = np.ones(length, dtype=bool), value(left)
                for sign, other in zip(operations, map(value, others), strict=True):
                    if type(sign) not in _COMPARISONS:
                        break
                    held &= _COMPARISONS[type(sign)](one, other)
                    one = other
                else:
                    return held
        text = ast.unparse(node)
        hint = f": a name that is none in Python must stand between backticks, `{text}`"
        raise argument_error(
            "out_of_range",
            "expression",
            f" = {expression!r}: cannot be read: {text}{hint if isinstance(node, ast.Call) else ''}",
        )

    def condition(node: ast.expr) -> NDArray[np.bool_]:
        found = value(node)
        if isinstance(found, list):
            text = "commas make a list, decimals have a point"
            raise argument_error(
                "out_of_range", "expression", f" = {expression!r}: is not a condition on the records: {text}"
            )
        found = np.asarray(found)
        if found.dtype != bool or found.shape != (length,):
            raise argument_error(
                "out_of_range",
                "expression",
                f" = {expression!r}: {ast.unparse(node)} is not a condition on the records",
            )
        return found

    try:
        tree = ast.parse(re.sub(r"`([^`]*)`", name_of, expression.strip()), mode="eval")
        with np.errstate(all="ignore"):
            return condition(tree.body)
    except SyntaxError:
        raise argument_error("out_of_range", "expression", f" = {expression!r}: cannot be read") from None
    except InputError:
        raise
    except (RecursionError, MemoryError):
        raise argument_error("out_of_range", "expression", f" = {expression!r}: is too long") from None
    except (TypeError, ValueError, OverflowError):
        text = "combines what does not go together, such as numbers with texts or lists"
        raise argument_error("out_of_range", "expression", f" = {expression!r}: {text}") from None
