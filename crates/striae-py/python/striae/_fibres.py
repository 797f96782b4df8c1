"""Families of fibres in elastic solids."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Union

from . import _check as check
from . import _striae as native
from ._check import Vector
from ._errors import refuse
from ._material import Material, Rubber
from ._materials import NeoHookean
from ._texture import Texture, texture
from ._textures import Axial, Circumferential, Radial, Uniform

Stiffness = Union[tuple[float, float, float], float]


class Fibres:
    """A family of fibres; see :class:`ExponentialFibres` and :class:`LinearFibres`."""

    _stiffness: Stiffness
    direction: Texture
    """Directions at rest."""

    def __init__(self) -> None:
        """Use one of the kinds of fibres."""
        raise TypeError("use ExponentialFibres or LinearFibres")

    def _point(self, direction: Union[Texture, Vector]) -> None:
        found = texture(direction, "direction")
        if not isinstance(found, (Uniform, Circumferential, Axial, Radial)):
            raise refuse("direction", "Uniform, Circumferential, Axial, Radial or a vector is needed")
        self.direction = found

    def _part(self) -> tuple[Stiffness, native.Texture]:
        return self._stiffness, self.direction._native


class ExponentialFibres(Fibres):
    """Fibres that stiffen in tension and bear no compression, after Holzapfel, Gasser and Ogden:
    the energy ``k1/(2 k2) (exp(k2 E^2) - 1)`` of their strain ``E``."""

    def __init__(
        self,
        k1: float,
        k2: float,
        direction: Union[Texture, Vector],
        *,
        dispersion: float = 0.0,
    ) -> None:
        """Makes the family.

        k1: modulus, positive (force per area).
        k2: exponent of stiffening, at least 0 (no unit).
        direction: at rest, one vector of any length, or :class:`Uniform`, :class:`Radial`, or
            :class:`Circumferential` or :class:`Axial`, which may be rotated about the radius.
        dispersion: from 0, all along the direction, to 1/3, in all directions (no unit).
        """
        self.k1, self.k2 = check.positive(k1, "k1"), check.number(k2, "k2")
        """Modulus (force per area), and exponent of stiffening (no unit)."""
        self.dispersion = check.number(dispersion, "dispersion")
        """From 0, all along the direction, to 1/3, in all directions (no unit)."""
        self._stiffness = (self.k1, self.k2, self.dispersion)
        self._point(direction)

    def __repr__(self) -> str:
        told = f"{self.k1}, {self.k2}, {self.direction!r}, dispersion={self.dispersion}"
        return f"ExponentialFibres({told})"


class LinearFibres(Fibres):
    """Fibres that bear tension and compression: the energy ``M/8 (I4 - 1)^2`` of the square
    ``I4`` of their stretch."""

    def __init__(self, modulus: float, direction: Union[Texture, Vector]) -> None:
        """Makes the family.

        modulus: stiffness that the family adds along its direction at rest, positive (force per
            area).
        direction: as of :class:`ExponentialFibres`.
        """
        self.modulus = check.positive(modulus, "modulus")
        """Stiffness that the family adds along its direction at rest (force per area)."""
        self._stiffness = self.modulus
        self._point(direction)

    def __repr__(self) -> str:
        return f"LinearFibres({self.modulus}, {self.direction!r})"


class Fibrous(Material):
    """Families of fibres in a neo-Hookean solid or in rubber without relaxation."""

    def __init__(self, ground: Union[NeoHookean, Rubber], fibres: Sequence[Fibres]) -> None:
        """Makes the material.

        ground: material around the fibres.
        fibres: families of fibres, at least one. Directions are evaluated at the centre of each
            element, and at the origin in :meth:`Material.stress`.
        """
        self.ground = check.kind(ground, Material, "ground")
        """Material around the fibres."""
        check.several(fibres, "fibres", "a list of families")
        self.fibres = tuple(check.kind(one, Fibres, "fibres") for one in fibres)
        """The families."""
        self._native = self.ground._native.with_fibres([one._part() for one in self.fibres])
        self.youngs_modulus, self.poissons_ratio = self._native.constants()

    def __repr__(self) -> str:
        return f"Fibrous({self.ground!r}, {list(self.fibres)!r})"
