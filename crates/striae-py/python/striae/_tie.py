"""Ties of surfaces whose meshes need not match."""

from __future__ import annotations

from typing import Optional

from . import _check as check
from . import _striae as native
from ._body import BodySet
from ._errors import refuse
from ._made import Made


class Tie(Made):
    """Two surfaces of bodies, glued together from the start.

    The order of the two does not matter.
    """

    def __init__(
        self,
        a: BodySet,
        b: BodySet,
        *,
        name: Optional[str] = None,
        within: Optional[float] = None,
    ) -> None:
        """Makes a tie.

        a, b: facet sets of two bodies.
        name: unique name; made of the names of the bodies by default.
        within: distance up to which facets that face each other are tied (length); others are free.
            By default a tenth of the facet size; facets between that distance and half of the facet
            size apart are then a fault.
        """
        for side, path in [(a, "a"), (b, "b")]:
            check.kind(side, BodySet, path)
        self.name = f"{a.body.name}-{b.body.name}" if name is None else check.name(name, "name")
        """Unique name."""
        self.a = a
        """First side."""
        self.b = b
        """Second side."""
        distance = None if within is None else check.positive(within, "within")
        self._native = native.Tie(self.name, [_side(a), _side(b)], distance)

    def __repr__(self) -> str:
        return f"Tie({self.a!r}, {self.b!r}, name={self.name!r})"


def _side(side: BodySet) -> tuple[str, str]:
    if side.name not in side.body.mesh.facet_sets:
        raise refuse(f"body `{side.body.name}`", f"set `{side.name}` has no facets")
    return side.body.name, side.name
