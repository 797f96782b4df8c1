"""Friction laws.

Coefficients have no unit. The texture ``s`` of a surface runs along its grooves or along
the row of scales, ``a = n x s`` across; for scales ``a`` points from root to free edge.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any, Literal, NamedTuple, Union

import numpy as np

from . import _check as check
from . import _striae as native
from ._check import Floats
from ._errors import refuse

if TYPE_CHECKING:
    from matplotlib.axes import Axes


class SlipSurface(NamedTuple):
    """Friction of a slipping contact, sampled over all directions, per unit of pressure.

    Directions count in the frame of the texture, from ``a`` (across the grooves, against a
    nap) towards ``s``'s side, counter-clockwise; of two textures from their sum.
    """

    slip_angle: Floats
    """Direction of slip (radians)."""
    friction: Floats
    """``-tau/p``, of shape (n, 2): along the axis of the frame and across it (no unit)."""
    dissipation: Floats
    """``-tau . d/p`` with the direction of slip ``d``: work per pressure and length of slip
    (no unit)."""


class Friction:
    """Friction between two surfaces; see the laws."""

    _native: native.Friction
    _told: str

    def __init__(self) -> None:
        """Use one of the laws."""
        raise TypeError(
            "use Frictionless, Coulomb, Orthotropic, Nap, TwoTextures or Tabulated"
        )

    @classmethod
    def _of(cls, found: native.Friction, told: str) -> Friction:
        law = Friction.__new__(Friction)
        law._native, law._told = found, told
        return law

    def with_decay(self, kinetic_over_static: float, slip_rate: float) -> Friction:
        """The law with coefficients that decay as slip becomes faster,
        ``kinetic + (static - kinetic) exp(-rate/slip_rate)``.

        kinetic_over_static: coefficients in fast slip over those at rest (no unit).
        slip_rate: rate of slip at which the difference has fallen to 1/e (length per time).
        """
        ratio = check.number(kinetic_over_static, "kinetic_over_static")
        rate = check.number(slip_rate, "slip_rate")
        told = f"{self._told}.with_decay({ratio}, {rate})"
        return Friction._of(self._native.with_decay(ratio, rate), told)

    def with_shear_cap(self, shear_cap: float) -> Friction:
        """The law with a bound on friction.

        shear_cap: largest shear stress that friction carries (force per area).
        """
        cap = check.number(shear_cap, "shear_cap")
        return Friction._of(self._native.with_shear_cap(cap), f"{self._told}.with_shear_cap({cap})")

    def slip_surface(self, theta: float = 0.0, count: int = 360) -> SlipSurface:
        """Friction in all directions of slip, per unit of pressure and at rest.

        theta: angle between the textures of two textured surfaces (degrees); it has no
            effect on other laws.
        count: number of samples.
        """
        theta = check.number(theta, "theta")
        count = check.whole(count, "count", 3)
        angle, along, across, _, work = self._native.slip_surface(np.radians(theta), count)
        mu = self._native.coefficient
        return SlipSurface(angle, mu * np.column_stack([along, across]), mu * work)

    def plot(self, axes: Union[Axes, None] = None, theta: float = 0.0) -> Axes:
        """Draws the slip surface, and arrows of slip from it, with matplotlib.

        axes: where it is drawn; on a new figure by default.
        theta: angle between the textures of two textured surfaces (degrees).
        """
        from ._plot import draw_friction

        return draw_friction(self, axes, theta)

    def __repr__(self) -> str:
        return self._told


class Frictionless(Friction):
    """No friction."""

    def __init__(self) -> None:
        """Makes the law."""
        self._native = native.Friction.frictionless()
        self._told = "Frictionless()"


class Coulomb(Friction):
    """Isotropic Coulomb friction."""

    def __init__(self, mu: float) -> None:
        """Makes the law; mu: coefficient of friction (no unit)."""
        self._native = native.Friction.coulomb(check.number(mu, "mu"))
        self._told = f"Coulomb({mu})"


class Orthotropic(Friction):
    """One textured surface with different friction along and across its grooves."""

    def __init__(
        self, along: float, across: float, slip_rule: Literal["opposing", "associated"] = "opposing"
    ) -> None:
        """Makes the law.

        along, across: coefficients of friction of slip along and across the grooves (no unit).
        slip_rule: ``opposing``: each component of friction opposes that of slip;
            ``associated``: slip is normal to the slip surface.
        """
        numbers = check.number(along, "along"), check.number(across, "across")
        rule = check.word(slip_rule, ("opposing", "associated"), "slip_rule")
        self._native = native.Friction.orthotropic(*numbers, rule == "associated")
        self._told = f"Orthotropic(along={along}, across={across}, slip_rule={slip_rule!r})"


class Nap(Friction):
    """One textured surface with different friction with, against and across its nap: scales,
    hair or pile."""

    def __init__(self, forward: float, backward: float, lateral: float) -> None:
        """Makes the law.

        forward, backward, lateral: coefficients of friction of slip with the nap, against it
            and across it (no unit).
        """
        names = ["forward", "backward", "lateral"]
        numbers = [check.number(v, n) for v, n in zip([forward, backward, lateral], names)]
        self._native = native.Friction.nap(*numbers)
        self._told = f"Nap(forward={forward}, backward={backward}, lateral={lateral})"


class TwoTextures(Friction):
    """Two textured surfaces, the law of Jones and Papadopoulos."""

    def __init__(self, mu: float, c_mag: float, c_ang: float, c_cen: float) -> None:
        """Makes the law.

        mu: coefficient of friction (no unit).
        c_mag: dependence of the magnitude on the angle between the textures (no unit).
        c_ang: dependence on the angle between slip and textures (no unit).
        c_cen: difference between slip with and against the textures (no unit).
        """
        names = ["mu", "c_mag", "c_ang", "c_cen"]
        numbers = [check.number(v, n) for v, n in zip([mu, c_mag, c_ang, c_cen], names)]
        self._native = native.Friction.two_textures(*numbers)
        self._told = f"TwoTextures({mu}, c_mag={c_mag}, c_ang={c_ang}, c_cen={c_cen})"


class Tabulated(Friction):
    """One textured surface with coefficients measured at many angles; friction opposes slip."""

    def __init__(
        self, angles: Union[Sequence[float], Floats], mu: Union[Sequence[float], Floats]
    ) -> None:
        """Makes the law.

        angles: directions in which the textured surface slips, from its ``a``, ascending
            within a turn (degrees).
        mu: coefficient of friction at each angle (no unit).
        """
        given: list[Any] = [check.array(angles, "angles"), check.array(mu, "mu")]
        for found, name in zip(given, ["angles", "mu"]):
            if found.ndim != 1:
                raise refuse(name, f"an array of one dimension is needed, not of {found.ndim}")
        radians = np.radians(given[0]).tolist()
        self._native = native.Friction.tabulated(radians, given[1].astype(np.float64).tolist())
        self._told = f"Tabulated({len(radians)} angles)"

    @classmethod
    def sampled(cls, mu: Callable[[float], float], count: int = 360) -> Tabulated:
        """Makes the law from a function, its polar curve, which is called for each angle once.

        Between the angles the law is monotone and smooth; it differs from the function by the
        square of their distance and less.

        mu: coefficient of friction (no unit) of slip at an angle (degrees).
        count: number of angles, from 0 at equal distances.
        """
        if not callable(mu):
            raise TypeError("mu: a function of the angle is needed")
        angles = [360.0 * at / check.whole(count, "count", 3) for at in range(count)]
        return cls(angles, [check.number(mu(angle), f"mu at {angle} degrees") for angle in angles])
