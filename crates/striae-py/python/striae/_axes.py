"""Axes in which displacements are prescribed."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Optional, TypeAlias, Union

from . import _check as check
from ._check import Vector
from ._made import Strict


class NormalAxis(Strict):
    """One axis, for the component ``x`` of a displacement: nodes slide on a plane where it is
    held."""

    def __init__(self, normal: Vector) -> None:
        """Makes it.

        normal: a vector along the axis, of any length.
        """
        self.normal = check.direction(normal, "normal")
        """A vector along the axis."""

    def __repr__(self) -> str:
        return f"NormalAxis({self.normal})"


class CylindricalAxes(Strict):
    """Radial, tangential and axial directions for the components ``x``, ``y`` and ``z`` of a
    displacement, at the position at rest of each node. They stay as the node moves; tangential
    components are lengths, positive by the right-hand rule about the axis."""

    def __init__(self, axis: Vector, point: Vector = (0.0, 0.0, 0.0)) -> None:
        """Makes them.

        axis: a vector along the axis, of any length.
        point: a point of the axis (length).
        """
        self.axis = check.direction(axis, "axis")
        """A vector along the axis."""
        self.point = check.vector(point, "point")
        """A point of the axis."""

    def __repr__(self) -> str:
        return f"CylindricalAxes({self.axis}, point={self.point})"


Axes: TypeAlias = Union[Sequence[Vector], NormalAxis, CylindricalAxes]


def vectors_of(axes: Optional[Axes], path: str) -> tuple[str, list[list[float]]]:
    """The kind of axes and their vectors, as the native part takes them."""
    if axes is None:
        return "model", []
    if isinstance(axes, NormalAxis):
        return "normal", [axes.normal]
    if isinstance(axes, CylindricalAxes):
        return "cylindrical", [axes.point, axes.axis]
    return "two", check.spanning(axes, path)
