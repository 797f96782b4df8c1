"""Textures: directions along the grooves or along the row of scales of a surface at rest.

They need be neither tangential nor of unit length: their tangential part is normalised. A texture
follows its surface as it deforms.
"""

from __future__ import annotations

from typing import Any, Optional, Union

import numpy as np
import numpy.typing as npt

from . import _check as check
from . import _striae as native
from ._check import Vector
from ._errors import refuse
from ._made import Made


class Texture(Made):
    """A texture; see :class:`Uniform`, :class:`Circumferential`, :class:`Axial`,
    :class:`Radial`, :class:`Painted` and :class:`Nodal`."""

    _native: native.Texture

    def __init__(self) -> None:
        """Use one of the textures."""
        raise TypeError("use Uniform, Circumferential, Axial, Radial, Painted or Nodal")

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
    if value is None or isinstance(value, Texture):
        return value
    return Uniform(value)


def _direction(value: Vector, path: str) -> list[float]:
    found = check.vector(value, path)
    if not any(found):
        raise refuse(path, "a direction must not be the zero vector")
    return found


class Uniform(Texture):
    """The tangential part of one direction."""

    def __init__(self, direction: Vector, *, turn: float = 0.0) -> None:
        """Makes the texture.

        direction: of any length.
        turn: angle by which it is rotated about the outward normal (degrees).
        """
        along = _direction(direction, "texture")
        self._native = native.Texture.uniform(along, check.number(turn, "turn"))


class Circumferential(Texture):
    """Circles about an axis by the right-hand rule."""

    def __init__(
        self, axis: Vector, *, point: Vector = (0.0, 0.0, 0.0), turn: float = 0.0
    ) -> None:
        """Makes the texture.

        axis: direction of the axis, of any length.
        point: a point of the axis (length).
        turn: angle by which the lines are rotated about the outward normal (degrees).
        """
        through, along = check.vector(point, "point"), _direction(axis, "axis")
        turned = check.number(turn, "turn")
        self._native = native.Texture.circumferential(through, along, turned)


class Axial(Texture):
    """Parallels of an axis."""

    def __init__(
        self, axis: Vector, *, point: Vector = (0.0, 0.0, 0.0), turn: float = 0.0
    ) -> None:
        """Makes the texture.

        axis: direction of the axis, of any length.
        point: a point of the axis (length).
        turn: angle by which the lines are rotated about the outward normal (degrees).
        """
        through, along = check.vector(point, "point"), _direction(axis, "axis")
        self._native = native.Texture.axial(through, along, check.number(turn, "turn"))


class Radial(Texture):
    """Rays from an axis outwards."""

    def __init__(
        self, axis: Vector, *, point: Vector = (0.0, 0.0, 0.0), turn: float = 0.0
    ) -> None:
        """Makes the texture.

        axis: direction of the axis, of any length.
        point: a point of the axis (length).
        turn: angle by which the lines are rotated about the outward normal (degrees).
        """
        through, along = check.vector(point, "point"), _direction(axis, "axis")
        self._native = native.Texture.radial(through, along, check.number(turn, "turn"))


class Painted(Texture):
    """Directions at a few places, interpolated in between over the surface."""

    def __init__(
        self, places: npt.ArrayLike, directions: npt.ArrayLike, *, width: Optional[float] = None
    ) -> None:
        """Makes the texture.

        places: of shape (n, 3); the node nearest to each is painted (length).
        directions: of shape (n, 3), of any length.
        width: of the interpolation (length); by default a quarter of the largest distance
            over the surface, which suits about five places.
        """
        at, along = check.rows(places, "places"), check.rows(directions, "directions")
        if len(at) != len(along):
            raise refuse("directions", f"there are {len(along)} for {len(at)} places")
        given = None if width is None else check.positive(width, "width")
        self._native = native.Texture.painted(at, along, given)


class Nodal(Texture):
    """A direction at every node of the surface."""

    def __init__(self, directions: npt.ArrayLike) -> None:
        """Makes the texture.

        directions: of shape (n, 3), in the order of :meth:`Mesh.surface_nodes`.
        """
        self._native = native.Texture.nodal(check.rows(directions, "directions"))
