"""Springs and dashpots."""

from __future__ import annotations

from typing import Optional, Union

from . import _check as check
from . import _striae as native
from ._body import BodySet
from ._check import Vector
from ._errors import refuse
from ._made import Made
from ._rigid import Rigid

_End = tuple[str, Optional[str], Optional[list[float]]]


class Spring(Made):
    """Springs, dashpots or both, from each node of the end ``a``.

    They act from the start of the run on, along the line to the end ``b``, which turns as the ends
    move, or along a fixed direction against ground.
    """

    def __init__(
        self,
        a: Union[BodySet, Rigid],
        b: Union[BodySet, Rigid, Vector, None] = None,
        *,
        direction: Optional[Vector] = None,
        stiffness: float = 0.0,
        damping: float = 0.0,
        free_length: Optional[float] = None,
        preload: Optional[float] = None,
        point: Optional[Vector] = None,
        point_b: Optional[Vector] = None,
        name: Optional[str] = None,
    ) -> None:
        """Makes springs.

        a: node set of a body, each of whose nodes has a spring of its own, or a rigid body.
        b: node set of a single node, a rigid body, or a point at rest (length).
        direction: fixed direction of any length, instead of ``b``.
        stiffness: tension of each spring over its elongation (force per length).
        damping: tension of the dashpot beside each spring over the rate of elongation, in the time
            of the step (force times time per length).
        free_length: length at which the springs have no tension (length); needs ``b``. By default
            their length at the start.
        preload: tension of each spring at the start, negative for compression (force); instead of
            ``free_length``.
        point: point of a rigid body ``a`` at the start (length); its reference point by default.
        point_b: point of a rigid body ``b`` at the start (length); its reference point by default.
        name: unique name; made of the names of the bodies by default.
        """
        first = _end(a, point, "a", "point")
        other = b if isinstance(b, (BodySet, Rigid)) else None
        second = "ground"
        if other is not None:
            second = other.body.name if isinstance(other, BodySet) else other.name
        self.name = f"{first[0]}-{second}" if name is None else check.name(name, "name")
        """Unique name."""
        self.a = a
        """First end."""
        self.b = b
        """Second end, if there is one."""
        of = f"spring `{self.name}`"
        if (b is None) == (direction is None):
            raise refuse(of, "either an end `b` or a `direction` is needed")
        if point_b is not None and other is None:
            raise refuse("point_b", "only a rigid body `b` has one; state a point as `b` itself")
        if free_length is not None and preload is not None:
            raise refuse(of, "only one of `free_length` and `preload` can be given")
        if direction is not None:
            made = native.Spring.along(self.name, first, check.vector(direction, "direction"))
        elif other is not None:
            made = native.Spring.between(self.name, first, _end(other, point_b, "b", "point_b"))
        else:
            made = native.Spring.to_point(self.name, first, check.vector(b, "b"))
        self._native = made.with_numbers(
            check.number(stiffness, "stiffness"),
            check.number(damping, "damping"),
            None if free_length is None else check.positive(free_length, "free_length"),
            None if preload is None else check.number(preload, "preload"),
        )

    def __repr__(self) -> str:
        return f"Spring({self.a!r}, {self.b!r}, name={self.name!r})"


def _end(end: Union[BodySet, Rigid], point: Optional[Vector], path: str, of_point: str) -> _End:
    if isinstance(end, Rigid):
        return end.name, None, None if point is None else check.vector(point, of_point)
    check.kind(end, BodySet, path)
    if point is not None:
        raise refuse(of_point, "only a rigid body has one; name a set of one node instead")
    if end.name not in end.body.mesh.node_sets:
        raise refuse(f"body `{end.body.name}`", f"set `{end.name}` has no nodes")
    return end.body.name, end.name, None
