"""Textures as the library declares them, written by ``declared.py``."""

from __future__ import annotations

from typing import Optional

import numpy.typing as npt

from . import _check as check
from ._check import Values, Vector
from ._texture import Texture

__all__ = [
    "Axial",
    "Circumferential",
    "Nodal",
    "Painted",
    "Radial",
    "Uniform",
]


class Uniform(Texture):
    """The tangential part of one direction."""

    def __init__(self, direction: Vector, *, turn: float = 0.0) -> None:
        """Makes the texture.

        direction: the direction, of any length.
        turn: angle by which the lines are rotated about the outward normal (degrees).
        """
        values: Values = {
            "uniform": check.direction(direction, "direction"),
            "turn": check.number(turn, "turn"),
        }
        self._make("uniform", values)


class Circumferential(Texture):
    """Circles about an axis by the right-hand rule."""

    def __init__(
        self,
        axis: Vector,
        *,
        point: Vector = (0.0, 0.0, 0.0),
        turn: float = 0.0,
    ) -> None:
        """Makes the texture.

        axis: direction of the axis, of any length.
        point: a point of the axis (length).
        turn: angle by which the lines are rotated about the outward normal (degrees).
        """
        values: Values = {
            "circumferential": {"point": check.vector(point, "point"), "direction": check.direction(axis, "axis")},
            "turn": check.number(turn, "turn"),
        }
        self._make("circumferential", values)


class Axial(Texture):
    """Parallels of an axis."""

    def __init__(
        self,
        axis: Vector,
        *,
        point: Vector = (0.0, 0.0, 0.0),
        turn: float = 0.0,
    ) -> None:
        """Makes the texture.

        axis: direction of the axis, of any length.
        point: a point of the axis (length).
        turn: angle by which the lines are rotated about the outward normal (degrees).
        """
        values: Values = {
            "axial": {"point": check.vector(point, "point"), "direction": check.direction(axis, "axis")},
            "turn": check.number(turn, "turn"),
        }
        self._make("axial", values)


class Radial(Texture):
    """Rays from an axis outwards."""

    def __init__(
        self,
        axis: Vector,
        *,
        point: Vector = (0.0, 0.0, 0.0),
        turn: float = 0.0,
    ) -> None:
        """Makes the texture.

        axis: direction of the axis, of any length.
        point: a point of the axis (length).
        turn: angle by which the lines are rotated about the outward normal (degrees).
        """
        values: Values = {
            "radial": {"point": check.vector(point, "point"), "direction": check.direction(axis, "axis")},
            "turn": check.number(turn, "turn"),
        }
        self._make("radial", values)


class Painted(Texture):
    """Directions at chosen places, interpolated between them."""

    def __init__(
        self,
        places: npt.ArrayLike,
        directions: npt.ArrayLike,
        *,
        width: Optional[float] = None,
    ) -> None:
        """Makes the texture.

        places: of shape (n, 3); the place; the nearest node of the surface is painted (length).
        directions: of shape (n, 3); the direction, of any length; its tangential part is used.
        width: width of the interpolation; greater than 0 (length); by default a quarter of the
            largest distance over the surface, which suits about five places.
        """
        values: Values = {
            "points": check.columns(places=places, directions=directions),
            "width": None if width is None else check.positive(width, "width"),
        }
        self._make("painted", values)


class Nodal(Texture):
    """A direction at every node of the surface."""

    def __init__(self, directions: npt.ArrayLike) -> None:
        """Makes the texture.

        directions: of shape (n, 3); directions in ascending order of the nodes; their tangential
            part is used. Nodes are in the order of :meth:`Mesh.surface_nodes`.
        """
        values: Values = {
            "directions": check.columns(directions=directions),
        }
        self._make("nodal", values)
