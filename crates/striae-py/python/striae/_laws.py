"""Friction laws as the library declares them, written by ``declared.py``."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Literal, Optional, Union

from . import _check as check
from ._check import Floats, Values
from ._friction import Friction, SampledFriction

__all__ = [
    "Coulomb",
    "Frictionless",
    "Nap",
    "Orthotropic",
    "Tabulated",
    "TwoTextures",
]


class Frictionless(Friction):
    """No friction."""

    def __init__(self) -> None:
        """Makes the law."""
        values: Values = {}
        self._make("frictionless", values)


class Coulomb(Friction):
    """Isotropic Coulomb friction."""

    def __init__(self, mu: float) -> None:
        """Makes the law.

        mu: coefficient of friction; at least 0 (no unit).
        """
        values: Values = {
            "mu": check.number(mu, "mu"),
        }
        self._make("coulomb", values)


class TwoTextures(Friction):
    """Two textured surfaces."""

    def __init__(self, mu: float, c_mag: float, c_ang: float, c_cen: float) -> None:
        """Makes the law.

        mu: coefficient of friction; at least 0 (no unit).
        c_mag: dependence of the magnitude on the angle between the textures (no unit).
        c_ang: dependence on the angle between slip and textures (no unit).
        c_cen: difference between slip with and against the textures (no unit).
        """
        values: Values = {
            "mu": check.number(mu, "mu"),
            "c_mag": check.number(c_mag, "c_mag"),
            "c_ang": check.number(c_ang, "c_ang"),
            "c_cen": check.number(c_cen, "c_cen"),
        }
        self._make("two-textures", values)


class Orthotropic(Friction):
    """One textured surface with different friction along and across its texture."""

    def __init__(
        self,
        mu_along: float,
        mu_across: float,
        slip_rule: Literal["opposing", "associated"] = "opposing",
    ) -> None:
        """Makes the law.

        mu_along: coefficient of friction along the texture; greater than 0 (no unit).
        mu_across: coefficient of friction across the texture; greater than 0 (no unit).
        slip_rule: direction of slip: ``opposing``: Each component of friction opposes that
            component of slip; ``associated``: Slip is normal to the slip surface.
        """
        values: Values = {
            "mu_along": check.number(mu_along, "mu_along"),
            "mu_across": check.number(mu_across, "mu_across"),
            "slip_rule": check.word(slip_rule, ("opposing", "associated"), "slip_rule"),
        }
        self._make("orthotropic", values)


class Nap(Friction):
    """One textured surface with different friction with, against and across its nap."""

    def __init__(self, mu_forward: float, mu_backward: float, mu_lateral: float) -> None:
        """Makes the law.

        mu_forward: coefficient of friction of slip with the nap; greater than 0 (no unit).
        mu_backward: coefficient of friction of slip against the nap; greater than 0 (no unit).
        mu_lateral: coefficient of friction of slip across the nap; greater than 0 (no unit).
        """
        values: Values = {
            "mu_forward": check.number(mu_forward, "mu_forward"),
            "mu_backward": check.number(mu_backward, "mu_backward"),
            "mu_lateral": check.number(mu_lateral, "mu_lateral"),
        }
        self._make("nap", values)


class Tabulated(SampledFriction):
    """One textured surface with coefficients measured at many angles; friction opposes slip."""

    def __init__(
        self,
        angles: Union[Sequence[float], Floats],
        mu: Union[Sequence[float], Floats],
    ) -> None:
        """Makes the law.

        angles: directions in which the textured surface slips over the other one: angles from its
            texture ``a`` (across the grooves, against a nap), counter-clockwise as seen from
            outside it; at least three, ascending, less than a turn (degrees).
        mu: coefficient of friction at each angle; monotone and smooth between them; greater than 0
            (no unit).
        """
        values: Values = {
            "angles": check.numbers(angles, "angles"),
            "mu": check.numbers(mu, "mu"),
        }
        self._make("tabulated", values)


#: Laws that can be fitted, with their names in decks.
FITTED: dict[type[Friction], str] = {
    Coulomb: "coulomb",
    TwoTextures: "two-textures",
    Orthotropic: "orthotropic",
    Nap: "nap",
    Tabulated: "tabulated",
}
