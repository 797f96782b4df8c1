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
from ._made import Made


#: Form of the energy of the volume ratio ``J``.
Volumetric = Literal["quadratic", "logarithmic"]

#: Ratios of moduli (no unit) and relaxation times (time).
Branches = Sequence[tuple[float, float]]


class Material(Made):
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

    def __init__(
        self,
        youngs_modulus: float,
        poissons_ratio: float,
        *,
        volumetric: Volumetric = "quadratic",
    ) -> None:
        """Makes the material.

        youngs_modulus: Young's modulus at small strain, positive (force per area).
        poissons_ratio: Poisson's ratio at small strain, above -1 and below 0.5 (no unit).
        volumetric: ``quadratic``, ``k/2 (J - 1)^2``, or ``logarithmic``, ``k/2 ln^2 J``.
        """
        self.youngs_modulus = check.number(youngs_modulus, "youngs_modulus")
        self.poissons_ratio = check.number(poissons_ratio, "poissons_ratio")
        form = check.word(volumetric, ("quadratic", "logarithmic"), "volumetric")
        self._native = native.Material.neo_hookean(
            self.youngs_modulus, self.poissons_ratio, form == "logarithmic"
        )


class LinearElastic(Material):
    """Linear elasticity for small strains and small rotations."""

    def __init__(self, youngs_modulus: float, poissons_ratio: float) -> None:
        """Makes the material.

        youngs_modulus: Young's modulus, positive (force per area).
        poissons_ratio: Poisson's ratio, above -1 and below 0.5 (no unit).
        """
        self.youngs_modulus = check.number(youngs_modulus, "youngs_modulus")
        self.poissons_ratio = check.number(poissons_ratio, "poissons_ratio")
        self._native = native.Material.linear_elastic(self.youngs_modulus, self.poissons_ratio)


class Rubber(Material):
    """Rubber: an isochoric energy, which each law defines, and an energy of the volume ratio.

    Branches of a spring and a dashpot model relaxation: ``relaxation=[(ratio, time), ...]``. The
    law describes slow deformations; the isochoric stress of sudden ones is ``1 + sum of ratios``
    times as large and relaxes to that of the law, in each branch with its relaxation time.
    """

    relaxation: tuple[tuple[float, float], ...]
    """Branches: ratios of moduli (no unit) and relaxation times (time)."""

    def _make(
        self,
        given: dict[str, float],
        bulk_modulus: Optional[float],
        poissons_ratio: Optional[float],
        volumetric: Volumetric,
        relaxation: Branches,
    ) -> None:
        law = type(self).__name__
        constants = [check.number(value, name) for name, value in given.items()]
        form = check.word(volumetric, ("quadratic", "logarithmic"), "volumetric")
        bulk = None if bulk_modulus is None else check.number(bulk_modulus, "bulk_modulus")
        ratio = None if poissons_ratio is None else check.number(poissons_ratio, "poissons_ratio")
        logarithmic = form == "logarithmic"
        self._native = native.Material.rubber(law, constants, bulk, ratio, logarithmic)
        self.youngs_modulus, self.poissons_ratio = self._native.constants()
        told = [f"{name}={value}" for name, value in given.items()]
        if isinstance(self, Ogden):
            told = [f"terms={list(zip(constants[::2], constants[1::2]))}"]
        told += [f"bulk_modulus={bulk}" if ratio is None else f"poissons_ratio={ratio}"]
        told += [f"volumetric={form!r}"] * logarithmic
        branches = [check.vector(branch, "relaxation", 2) for branch in relaxation]
        self.relaxation = tuple((ratio, time) for ratio, time in branches)
        if branches:
            self._native = self._native.relaxing(list(self.relaxation))
            told += [f"relaxation={list(self.relaxation)}"]
        self._told = ", ".join(told)

    def __repr__(self) -> str:
        return f"{type(self).__name__}({self._told})"


class IsochoricNeoHookean(Rubber):
    """The energy ``G/2 (I1 - 3)`` of the isochoric invariant."""

    def __init__(
        self,
        shear_modulus: float,
        *,
        bulk_modulus: Optional[float] = None,
        poissons_ratio: Optional[float] = None,
        volumetric: Volumetric = "quadratic",
        relaxation: Branches = (),
    ) -> None:
        """Makes the material.

        shear_modulus: shear modulus G, positive (force per area).
        bulk_modulus: bulk modulus, positive (force per area); it or ``poissons_ratio`` is needed.
        poissons_ratio: Poisson's ratio at rest, above -1 and below 0.5 (no unit).
        volumetric: ``quadratic``, ``K/2 (J - 1)^2``, or ``logarithmic``, ``K/2 ln^2 J``.
        relaxation: branches, each a ratio of its modulus to that of the law, positive (no unit),
            and a relaxation time, positive (time).
        """
        given = {"shear_modulus": shear_modulus}
        self._make(given, bulk_modulus, poissons_ratio, volumetric, relaxation)


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
        relaxation: Branches = (),
    ) -> None:
        """Makes the material.

        c10: constant of the first invariant (force per area).
        c01: constant of the second one (force per area); the sum of both must be positive.
        bulk_modulus: bulk modulus, positive (force per area); it or ``poissons_ratio`` is needed.
        poissons_ratio: Poisson's ratio at rest, above -1 and below 0.5 (no unit).
        volumetric: ``quadratic``, ``K/2 (J - 1)^2``, or ``logarithmic``, ``K/2 ln^2 J``.
        relaxation: branches, each a ratio of its modulus to that of the law, positive (no unit),
            and a relaxation time, positive (time).
        """
        given = {"c10": c10, "c01": c01}
        self._make(given, bulk_modulus, poissons_ratio, volumetric, relaxation)


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
        relaxation: Branches = (),
    ) -> None:
        """Makes the material.

        c10: constant of its first power, half the shear modulus, positive (force per area).
        c20: constant of its square (force per area).
        c30: constant of its cube (force per area).
        bulk_modulus: bulk modulus, positive (force per area); it or ``poissons_ratio`` is needed.
        poissons_ratio: Poisson's ratio at rest, above -1 and below 0.5 (no unit).
        volumetric: ``quadratic``, ``K/2 (J - 1)^2``, or ``logarithmic``, ``K/2 ln^2 J``.
        relaxation: branches, each a ratio of its modulus to that of the law, positive (no unit),
            and a relaxation time, positive (time).
        """
        given = {"c10": c10, "c20": c20, "c30": c30}
        self._make(given, bulk_modulus, poissons_ratio, volumetric, relaxation)


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
        relaxation: Branches = (),
    ) -> None:
        """Makes the material.

        shear_modulus: shear modulus G, positive (force per area).
        limit: Jm, the limit of I1 - 3, positive (no unit).
        bulk_modulus: bulk modulus, positive (force per area); it or ``poissons_ratio`` is needed.
        poissons_ratio: Poisson's ratio at rest, above -1 and below 0.5 (no unit).
        volumetric: ``quadratic``, ``K/2 (J - 1)^2``, or ``logarithmic``, ``K/2 ln^2 J``.
        relaxation: branches, each a ratio of its modulus to that of the law, positive (no unit),
            and a relaxation time, positive (time).
        """
        given = {"shear_modulus": shear_modulus, "limit": limit}
        self._make(given, bulk_modulus, poissons_ratio, volumetric, relaxation)


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
        relaxation: Branches = (),
    ) -> None:
        """Makes the material.

        mu: modulus near the shear modulus, positive (force per area).
        locking_stretch: stretch at which the chains lock, above 1 (no unit).
        bulk_modulus: bulk modulus, positive (force per area); it or ``poissons_ratio`` is needed.
        poissons_ratio: Poisson's ratio at rest, above -1 and below 0.5 (no unit).
        volumetric: ``quadratic``, ``K/2 (J - 1)^2``, or ``logarithmic``, ``K/2 ln^2 J``.
        relaxation: branches, each a ratio of its modulus to that of the law, positive (no unit),
            and a relaxation time, positive (time).
        """
        given = {"mu": mu, "locking_stretch": locking_stretch}
        self._make(given, bulk_modulus, poissons_ratio, volumetric, relaxation)


class Ogden(Rubber):
    """The energy ``sum mu/alpha (l1^alpha + l2^alpha + l3^alpha - 3)`` of the isochoric stretches."""

    def __init__(
        self,
        terms: Sequence[tuple[float, float]],
        *,
        bulk_modulus: Optional[float] = None,
        poissons_ratio: Optional[float] = None,
        volumetric: Volumetric = "quadratic",
        relaxation: Branches = (),
    ) -> None:
        """Makes the material.

        terms: pairs of ``mu`` (force per area) and ``alpha`` (no unit); other programs write
            ``2 mu/alpha^2`` where this one writes ``mu/alpha``.
        bulk_modulus: bulk modulus, positive (force per area); it or ``poissons_ratio`` is needed.
        poissons_ratio: Poisson's ratio at rest, above -1 and below 0.5 (no unit).
        volumetric: ``quadratic``, ``K/2 (J - 1)^2``, or ``logarithmic``, ``K/2 ln^2 J``.
        relaxation: branches, each a ratio of its modulus to that of the law, positive (no unit),
            and a relaxation time, positive (time).
        """
        pairs = [check.vector(term, "terms", 2) for term in terms]
        names = [(f"mu {at}", f"alpha {at}") for at in range(len(pairs))]
        given = {n: v for name, pair in zip(names, pairs) for n, v in zip(name, pair)}
        self._make(given, bulk_modulus, poissons_ratio, volumetric, relaxation)


class ElasticPlastic(Material):
    """Metal with von Mises plasticity and isotropic hardening, for large strains."""

    def __init__(
        self,
        youngs_modulus: float,
        poissons_ratio: float,
        yield_stress: Optional[float] = None,
        *,
        hardening_modulus: float = 0.0,
        saturation: Optional[tuple[float, float]] = None,
        yield_table: Optional[Sequence[tuple[float, float]]] = None,
    ) -> None:
        """Makes the material, with the yield stress ``Y`` over the equivalent plastic strain
        ``p`` by a formula, ``Y0 + (Ys - Y0) (1 - exp(-d p)) + H p``, or by a table.

        youngs_modulus: Young's modulus, positive (force per area).
        poissons_ratio: Poisson's ratio, above -1 and below 0.5 (no unit).
        yield_stress: first yield stress ``Y0``, positive (force per area); it or
            ``yield_table`` is needed.
        hardening_modulus: ``H``, at least 0 (force per area).
        saturation: stress of saturation ``Ys``, at least ``Y0`` (force per area), and its rate
            ``d``, at least 0 (no unit).
        yield_table: pairs of equivalent plastic strain, from 0 on and rising (no unit), and
            yield stress, which must not fall (force per area), with straight lines between
            them; the last stress holds beyond.
        """
        self.youngs_modulus = check.number(youngs_modulus, "youngs_modulus")
        self.poissons_ratio = check.number(poissons_ratio, "poissons_ratio")
        hardening = _hardening(yield_stress, hardening_modulus, saturation, yield_table)
        self._native = native.Material.elastic_plastic(
            self.youngs_modulus, self.poissons_ratio, hardening
        )
        stated = f"yield_stress={yield_stress}, hardening_modulus={hardening_modulus}"
        if saturation is not None:
            stated += f", saturation={saturation}"
        if yield_table is not None:
            stated = f"yield_table={list(yield_table)}"
        self._told = f"{self.youngs_modulus}, {self.poissons_ratio}, {stated}"

    def __repr__(self) -> str:
        return f"ElasticPlastic({self._told})"


def _hardening(
    yield_stress: Optional[float],
    modulus: float,
    saturation: Optional[tuple[float, float]],
    table: Optional[Sequence[tuple[float, float]]],
) -> native.Hardening:
    """The yield stress as the native part takes it."""
    slope = check.number(modulus, "hardening_modulus")
    if (yield_stress is None) == (table is None):
        raise refuse("ElasticPlastic", "either `yield_stress` or `yield_table` is needed")
    if table is not None:
        if slope != 0.0 or saturation is not None:
            text = "`hardening_modulus` and `saturation` go with `yield_stress`, not with a table"
            raise refuse("ElasticPlastic", text)
        return [check.vector(pair, "yield_table", 2) for pair in table]
    first = check.number(yield_stress, "yield_stress")
    if saturation is None:
        return first, slope
    stress, rate = check.vector(saturation, "saturation", 2)
    return first, slope, (stress, rate)


class OwnMaterial(Material):
    """A user-defined elastic law: a Python function states its response.

    The function is called for each integration point in each iteration, one call at a time, so such
    a model is slow. An exception in it ends the run and is raised.
    """

    def __init__(
        self,
        response: Callable[[Floats], Optional[tuple[float, npt.ArrayLike, npt.ArrayLike]]],
        name: str = "own",
    ) -> None:
        """Makes the material, and checks the function against the laws of elasticity: no energy and
        stress at rest, stress and tangent that are derivatives, a symmetric tangent, and
        indifference to rotations. A law that fails raises a :class:`ModelError` with the reason.

        response: from the deformation gradient ``F``, of shape (3, 3) (no unit), to the stored
            energy (per reference volume), the first Piola-Kirchhoff stress ``P``, of shape (3, 3)
            (force per reference area), and the tangent ``dP_iJ/dF_kL``, of shape (3, 3, 3, 3)
            (force per reference area); ``None`` for a deformation that it does not allow, which
            cuts the increment. It must return equal values each time.
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
    """The function, with its values converted to numbers and arrays of the right shapes."""

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
