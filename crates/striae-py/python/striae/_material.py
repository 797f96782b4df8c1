"""Bulk materials."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Union

import numpy as np

from . import _check as check
from . import _striae as native
from ._check import Floats


class Material:
    """A bulk material; see :class:`NeoHookean` and :class:`LinearElastic`."""

    _native: native.Material

    def __init__(self) -> None:
        """Use one of the materials."""
        raise TypeError("use NeoHookean or LinearElastic")

    def stress(self, deformation_gradient: Union[Sequence[Sequence[float]], Floats]) -> Floats:
        """First Piola-Kirchhoff stress, of shape (3, 3) (force per reference area).

        deformation_gradient: of shape (3, 3) (no unit).
        """
        rows = check.rows(deformation_gradient, "deformation_gradient").tolist()
        return np.array(self._native.response(rows)[1])

    def energy(self, deformation_gradient: Union[Sequence[Sequence[float]], Floats]) -> float:
        """Stored energy (per reference volume).

        deformation_gradient: of shape (3, 3) (no unit).
        """
        rows = check.rows(deformation_gradient, "deformation_gradient").tolist()
        return self._native.response(rows)[0]

    def __repr__(self) -> str:
        constants = f"youngs_modulus={self.youngs_modulus}, poissons_ratio={self.poissons_ratio}"
        return f"{type(self).__name__}({constants})"

    youngs_modulus: float
    """Young's modulus (force per area)."""
    poissons_ratio: float
    """Poisson's ratio (no unit)."""


class NeoHookean(Material):
    """Compressible neo-Hookean solid for large strains."""

    def __init__(self, youngs_modulus: float, poissons_ratio: float) -> None:
        """Makes the material.

        youngs_modulus: Young's modulus at small strain (force per area).
        poissons_ratio: Poisson's ratio at small strain, above -1 and below 0.5 (no unit).
        """
        self.youngs_modulus = check.number(youngs_modulus, "youngs_modulus")
        self.poissons_ratio = check.number(poissons_ratio, "poissons_ratio")
        self._native = native.Material.neo_hookean(self.youngs_modulus, self.poissons_ratio)


class LinearElastic(Material):
    """Linear elasticity for small strains and small rotations."""

    def __init__(self, youngs_modulus: float, poissons_ratio: float) -> None:
        """Makes the material.

        youngs_modulus: Young's modulus (force per area).
        poissons_ratio: Poisson's ratio, above -1 and below 0.5 (no unit).
        """
        self.youngs_modulus = check.number(youngs_modulus, "youngs_modulus")
        self.poissons_ratio = check.number(poissons_ratio, "poissons_ratio")
        self._native = native.Material.linear_elastic(self.youngs_modulus, self.poissons_ratio)
