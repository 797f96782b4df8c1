"""Objects that are known by the arguments they were made from."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Optional, TypeAlias

#: Callable that makes an object, with its arguments.
Recipe: TypeAlias = tuple[Callable[..., Any], tuple[Any, ...], dict[str, Any]]


class Made:
    """Base of objects that are copied and pickled by their constructor arguments."""

    #: ``None`` if the object was not made by its class.
    _recipe: Optional[Recipe]

    def __new__(cls, *arguments: Any, **named: Any) -> Any:
        made = super().__new__(cls)
        made._recipe = (cls, arguments, named)
        return made

    def __reduce__(self) -> tuple[Callable[..., Any], tuple[Any, ...]]:
        if self._recipe is None:
            raise TypeError(f"{self!r} cannot be pickled: it was not made by its class")
        return again, self._recipe


def again(maker: Callable[..., Any], arguments: tuple[Any, ...], named: dict[str, Any]) -> Any:
    """The object of a recipe."""
    return maker(*arguments, **named)


def listed(given: list[tuple[str, Any]]) -> str:
    """Arguments by their names, long lists by their lengths."""
    long = 6

    def told(value: Any) -> str:
        if isinstance(value, list):
            return f"<{len(value)} numbers>" if len(value) > long else repr([plain(v) for v in value])
        return repr(plain(value))

    # Angles come back from radians with round-off.
    def plain(value: Any) -> Any:
        return float(f"{value:.14g}") if isinstance(value, float) else value

    return ", ".join(f"{name}={told(value)}" for name, value in given)
