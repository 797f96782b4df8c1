"""Textures: directions along the grooves or along the row of scales of a surface at rest.

They need be neither tangential nor of unit length: their tangential part is normalised. A texture
follows its surface as it deforms.
"""

from __future__ import annotations

from typing import Any, Optional, Union

import numpy as np

from . import _check as check
from . import _striae as native
from ._check import Values, Vector
from ._made import Made


class Texture(Made):
    """A texture: base of :class:`Uniform`, :class:`Circumferential`, :class:`Painted` and others."""

    _native: native.Texture

    def __init__(self) -> None:
        """Use one of the textures."""
        *first, last = [one.__name__ for one in Texture.__subclasses__()]
        raise TypeError(f"use {', '.join(first)} or {last}")

    def _make(self, texture: str, values: Values) -> None:
        """Makes a declared texture of values that are present."""
        given = [(name, value) for name, value in values.items() if value is not None]
        self._native = native.Texture.declared(type(self).__name__, texture, given)

    def __repr__(self) -> str:
        if self._recipe is None:
            return f"<{type(self).__name__}>"
        _, arguments, named = self._recipe
        told = [_short(one) for one in arguments]
        told += [f"{name}={_short(one)}" for name, one in named.items()]
        return f"{type(self).__name__}({', '.join(told)})"


def _short(value: Any) -> str:
    shape = np.shape(value)
    return repr(value) if shape in ((), (3,)) else f"<array of shape {shape}>"


def texture(value: Union[Texture, Vector, None], path: str = "texture") -> Optional[Texture]:
    """A texture, a uniform one from a direction, or none."""
    from ._textures import Uniform

    if value is None or isinstance(value, Texture):
        return value
    return Uniform(check.direction(value, path))
