"""Docstrings of the fields of named tuples, which the language does not keep."""

from __future__ import annotations

import ast
import inspect
from textwrap import dedent
from typing import TypeVar

C = TypeVar("C", bound=type)


def described(cls: C) -> C:
    """Gives fields of a named tuple the strings that follow them in its source, for ``help``."""
    try:
        source = inspect.getsource(cls)
    except (OSError, TypeError):
        # Without sources there is nothing to tell.
        return cls
    (definition,) = ast.parse(dedent(source)).body
    body = getattr(definition, "body", [])
    for field, words in zip(body, body[1:]):
        if isinstance(field, ast.AnnAssign) and isinstance(field.target, ast.Name):
            if isinstance(words, ast.Expr) and isinstance(words.value, ast.Constant):
                vars(cls)[field.target.id].__doc__ = inspect.cleandoc(str(words.value.value))
    return cls
