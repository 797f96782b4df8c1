"""Bulk materials."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Literal, Optional, Union

import numpy as np
import numpy.typing as npt

from . import _check as check
from . import _striae as native
from ._check import Floats
from ._errors import refuse


class Material:
    """A bulk material, such as :class:`NeoHookean`, :class:`LinearElastic` or :class:`Ogden`."""

    _native: native.Material

    def __init__(self) -> None:
        """Use one of the materials."""
        raise TypeError("use a material such as NeoHookean or LinearElastic")

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


#: Form of the energy of the volume ratio ``J``.
Volumetric = Literal["quadratic", "logarithmic"]


class Rubber(Material):
    """Rubber: an isochoric energy of its own, and an energy of the volume ratio."""

    def _make(
        self,
        constants: list[float],
        bulk_modulus: Optional[float],
        poissons_ratio: Optional[float],
        volumetric: Volumetric,
    ) -> None:
        law = type(self).__name__
        form = check.word(volumetric, ("quadratic", "logarithmic"), "volumetric")
        bulk = None if bulk_modulus is None else check.number(bulk_modulus, "bulk_modulus")
        ratio = None if poissons_ratio is None else check.number(poissons_ratio, "poissons_ratio")
        logarithmic = form == "logarithmic"
        self._native = native.Material.rubber(law, constants, bulk, ratio, logarithmic)
        self.youngs_modulus, self.poissons_ratio = self._native.constants()


class IsochoricNeoHookean(Rubber):
    """The energy ``G/2 (I1 - 3)`` of the isochoric invariant."""

    def __init__(
        self,
        shear_modulus: float,
        *,
        bulk_modulus: Optional[float] = None,
        poissons_ratio: Optional[float] = None,
        volumetric: Volumetric = "quadratic",
    ) -> None:
        """Makes the material.

        shear_modulus: shear modulus G (force per area).
        bulk_modulus: bulk modulus (force per area); it or ``poissons_ratio`` is needed.
        poissons_ratio: Poisson's ratio at rest, above -1 and below 0.5 (no unit).
        volumetric: ``quadratic``, ``K/2 (J - 1)^2``, or ``logarithmic``, ``K/2 ln^2 J``.
        """
        given = [(shear_modulus, "shear_modulus")]
        constants = [check.number(value, name) for value, name in given]
        self._make(constants, bulk_modulus, poissons_ratio, volumetric)


class MooneyRivlin(Rubber):
    """The energy ``c10 (I1 - 3) + c01 (I2 - 3)`` of the isochoric invariants."""

    def __init__(
        self,
        c10: float,
        c01: float,
        *,
        bulk_modulus: Optional[float] = None,
        poissons_ratio: Optional[float] = None,
        volumetric: Volumetric = "quadratic",
    ) -> None:
        """Makes the material.

        c10: constant of the first invariant (force per area).
        c01: constant of the second one (force per area); the sum of both must be positive.
        bulk_modulus: bulk modulus (force per area); it or ``poissons_ratio`` is needed.
        poissons_ratio: Poisson's ratio at rest, above -1 and below 0.5 (no unit).
        volumetric: ``quadratic``, ``K/2 (J - 1)^2``, or ``logarithmic``, ``K/2 ln^2 J``.
        """
        given = [(c10, "c10"), (c01, "c01")]
        constants = [check.number(value, name) for value, name in given]
        self._make(constants, bulk_modulus, poissons_ratio, volumetric)


class Yeoh(Rubber):
    """A cubic energy of the isochoric invariant ``I1 - 3``."""

    def __init__(
        self,
        c10: float,
        c20: float,
        c30: float,
        *,
        bulk_modulus: Optional[float] = None,
        poissons_ratio: Optional[float] = None,
        volumetric: Volumetric = "quadratic",
    ) -> None:
        """Makes the material.

        c10: constant of its first power, half the shear modulus (force per area).
        c20: constant of its square (force per area).
        c30: constant of its cube (force per area).
        bulk_modulus: bulk modulus (force per area); it or ``poissons_ratio`` is needed.
        poissons_ratio: Poisson's ratio at rest, above -1 and below 0.5 (no unit).
        volumetric: ``quadratic``, ``K/2 (J - 1)^2``, or ``logarithmic``, ``K/2 ln^2 J``.
        """
        given = [(c10, "c10"), (c20, "c20"), (c30, "c30")]
        constants = [check.number(value, name) for value, name in given]
        self._make(constants, bulk_modulus, poissons_ratio, volumetric)


class Gent(Rubber):
    """Chains of finite length: ``-G Jm/2 ln(1 - (I1 - 3)/Jm)``."""

    def __init__(
        self,
        shear_modulus: float,
        limit: float,
        *,
        bulk_modulus: Optional[float] = None,
        poissons_ratio: Optional[float] = None,
        volumetric: Volumetric = "quadratic",
    ) -> None:
        """Makes the material.

        shear_modulus: shear modulus G (force per area).
        limit: Jm, the limit of I1 - 3 (no unit).
        bulk_modulus: bulk modulus (force per area); it or ``poissons_ratio`` is needed.
        poissons_ratio: Poisson's ratio at rest, above -1 and below 0.5 (no unit).
        volumetric: ``quadratic``, ``K/2 (J - 1)^2``, or ``logarithmic``, ``K/2 ln^2 J``.
        """
        given = [(shear_modulus, "shear_modulus"), (limit, "limit")]
        constants = [check.number(value, name) for value, name in given]
        self._make(constants, bulk_modulus, poissons_ratio, volumetric)


class ArrudaBoyce(Rubber):
    """The eight-chain model, by the first five terms of its series."""

    def __init__(
        self,
        mu: float,
        locking_stretch: float,
        *,
        bulk_modulus: Optional[float] = None,
        poissons_ratio: Optional[float] = None,
        volumetric: Volumetric = "quadratic",
    ) -> None:
        """Makes the material.

        mu: modulus near the shear modulus (force per area).
        locking_stretch: stretch at which the chains lock, above 1 (no unit).
        bulk_modulus: bulk modulus (force per area); it or ``poissons_ratio`` is needed.
        poissons_ratio: Poisson's ratio at rest, above -1 and below 0.5 (no unit).
        volumetric: ``quadratic``, ``K/2 (J - 1)^2``, or ``logarithmic``, ``K/2 ln^2 J``.
        """
        given = [(mu, "mu"), (locking_stretch, "locking_stretch")]
        constants = [check.number(value, name) for value, name in given]
        self._make(constants, bulk_modulus, poissons_ratio, volumetric)


class Ogden(Rubber):
    """The energy ``sum mu/alpha (l1^alpha + l2^alpha + l3^alpha - 3)`` of the isochoric stretches."""

    def __init__(
        self,
        terms: Sequence[tuple[float, float]],
        *,
        bulk_modulus: Optional[float] = None,
        poissons_ratio: Optional[float] = None,
        volumetric: Volumetric = "quadratic",
    ) -> None:
        """Makes the material.

        terms: pairs of ``mu`` (force per area) and ``alpha`` (no unit); other programs write
            ``2 mu/alpha^2`` where this one writes ``mu/alpha``.
        bulk_modulus: bulk modulus (force per area); it or ``poissons_ratio`` is needed.
        poissons_ratio: Poisson's ratio at rest, above -1 and below 0.5 (no unit).
        volumetric: ``quadratic``, ``K/2 (J - 1)^2``, or ``logarithmic``, ``K/2 ln^2 J``.
        """
        pairs = [check.vector(term, "terms", 2) for term in terms]
        constants = [number for pair in pairs for number in pair]
        self._make(constants, bulk_modulus, poissons_ratio, volumetric)


class OwnMaterial(Material):
    """An elastic law that a function of Python states.

    It is called for each integration point in each iteration, one call at a time, so such a
    model is slow. An exception in it ends the run and is raised.
    """

    def __init__(
        self,
        response: Callable[[Floats], Optional[tuple[float, npt.ArrayLike, npt.ArrayLike]]],
        name: str = "own",
    ) -> None:
        """Makes the material, and holds the function against the laws of elasticity: no energy
        and stress at rest, stress and tangent that are derivatives, a symmetric tangent, and
        indifference to rotations. Otherwise one :class:`ModelError` says what is wrong.

        response: from the deformation gradient ``F``, of shape (3, 3) (no unit), to the stored
            energy (per reference volume), the first Piola-Kirchhoff stress ``P``, of shape
            (3, 3) (force per reference area), and the tangent ``dP_iJ/dF_kL``, of shape
            (3, 3, 3, 3) (force per reference area); ``None`` where it allows no such
            deformation, and the increment is cut. It must answer the same each time.
        name: of the law in messages.
        """
        if not callable(response):
            raise TypeError("response: a function of the deformation gradient is needed")
        self._name = check.name(name, "name")
        self._native = native.own_material(name, _checked(response, name))
        self.youngs_modulus, self.poissons_ratio = self._native.constants()

    def __repr__(self) -> str:
        return f"OwnMaterial(name={self._name!r})"


def _checked(
    response: Callable[[Floats], Optional[tuple[float, npt.ArrayLike, npt.ArrayLike]]], name: str
) -> Callable[[Floats], Optional[tuple[float, Floats, Floats]]]:
    """The function with its answers as numbers and arrays of the right shapes."""

    def called(gradient: Floats) -> Optional[tuple[float, Floats, Floats]]:
        answer = response(gradient)
        if answer is None:
            return None
        if not isinstance(answer, tuple) or len(answer) != 3:
            raise refuse(name, "energy, stress and tangent are needed, or None")
        energy, stress, tangent = answer
        found = [check.array(stress, f"{name}: stress"), check.array(tangent, f"{name}: tangent")]
        for array, what, shape in zip(found, ("stress", "tangent"), ((3, 3), (3, 3, 3, 3))):
            if array.shape != shape:
                text = f"it must have shape {shape}, but has {array.shape}"
                raise refuse(f"{name}: {what}", text)
        floats = [np.ascontiguousarray(array, dtype=np.float64) for array in found]
        return check.number(energy, f"{name}: energy"), floats[0], floats[1]

    return called
