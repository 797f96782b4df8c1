"""Cavities with a pressure inside."""

from __future__ import annotations

from . import _check as check
from . import _striae as native
from ._body import BodySet
from ._check import Curve
from ._errors import refuse
from ._made import Made
from ._step import Condition


class Cavity(Made):
    """A cavity inside facets of bodies, which look into it.

    The facets must be closed, but for rims at planes of symmetry. Until a step states its content,
    the pressure is that of the surroundings.
    """

    def __init__(self, *faces: BodySet, name: str) -> None:
        """Makes a cavity.

        faces: facet sets of bodies around it.
        name: unique name.
        """
        if not faces:
            raise refuse("faces", "a cavity needs at least one facet set")
        for side in faces:
            check.kind(side, BodySet, "faces")
        self.name = check.name(name, "name")
        """Unique name."""
        self.faces = faces
        """Facet sets around it."""
        sides = [_side(side) for side in faces]
        self._native = native.Cavity(self.name, sides[0], sides[1:])

    def pressure(self, pressure: float, *, curve: Curve = "ramp") -> Condition:
        """Takes the pressure to a target.

        pressure: target over the pressure of the surroundings (force per area).
        curve: how the target is approached.
        """
        return self._to("pressure", check.number(pressure, "pressure"), curve)

    def volume(self, volume: float, *, curve: Curve = "ramp") -> Condition:
        """Takes the volume to a target, in a step without inertia.

        volume: target (length cubed).
        curve: how the target is approached.
        """
        return self._to("volume", check.positive(volume, "volume"), curve)

    def volume_ratio(self, ratio: float, *, curve: Curve = "ramp") -> Condition:
        """Takes the volume to a multiple of that at rest, in a step without inertia.

        ratio: target (no unit).
        curve: how the target is approached.
        """
        return self._to("volume_ratio", check.positive(ratio, "ratio"), curve)

    def seal(self, ambient: float, *, exponent: float = 1.0) -> Condition:
        """Seals in the gas that the cavity contains at the start of the step.

        ambient: absolute pressure of the surroundings (force per area).
        exponent: polytropic exponent; 1 for a constant temperature (no unit).
        """
        absolute = check.positive(ambient, "ambient")
        power, name = check.positive(exponent, "exponent"), self.name
        return Condition(f"gas in {name}", lambda step: step.seal(name, absolute, power))

    def _to(self, kind: str, target: float, curve: Curve) -> Condition:
        name, along = self.name, check.curve(curve, "curve")
        return Condition(f"{kind} of {name}", lambda step: step.fill(name, kind, target, along))

    def __repr__(self) -> str:
        return f"Cavity({', '.join(repr(side) for side in self.faces)}, name={self.name!r})"


def _side(side: BodySet) -> tuple[str, str]:
    if side.name not in side.body.mesh.facet_sets:
        raise refuse(f"body `{side.body.name}`", f"set `{side.name}` has no facets")
    return side.body.name, side.name
