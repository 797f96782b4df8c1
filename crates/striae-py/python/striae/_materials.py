"""Bulk laws as the library declares them, written by ``declared.py``."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Literal, Optional

from . import _check as check
from ._check import Values
from ._material import Material, Rubber

__all__ = [
    "ArrudaBoyce",
    "ElasticPlastic",
    "Gent",
    "IsochoricNeoHookean",
    "LinearElastic",
    "MooneyRivlin",
    "NeoHookean",
    "Ogden",
    "Yeoh",
]


class NeoHookean(Material):
    """Compressible neo-Hookean solid for large strains; the modulus of the volumetric energy is
    ``lambda``."""

    def __init__(
        self,
        youngs_modulus: float,
        poissons_ratio: float,
        volumetric: Literal["quadratic", "logarithmic"] = "quadratic",
    ) -> None:
        """Makes the material.

        youngs_modulus: Young's modulus at small strain; greater than 0 (force per area).
        poissons_ratio: Poisson's ratio at small strain; greater than -1 and less than 0.5 (no
            unit).
        volumetric: form of the volumetric energy for the volume ratio ``J`` and a modulus ``k``:
            ``quadratic``: ``k/2 (J - 1)^2``; ``logarithmic``: ``k/2 ln^2 J``.
        """
        values: Values = {
            "youngs_modulus": check.number(youngs_modulus, "youngs_modulus"),
            "poissons_ratio": check.number(poissons_ratio, "poissons_ratio"),
            "volumetric": check.word(volumetric, ("quadratic", "logarithmic"), "volumetric"),
        }
        self._make("neo-hookean", values)


class LinearElastic(Material):
    """Linear elasticity for small strains and small rotations."""

    def __init__(self, youngs_modulus: float, poissons_ratio: float) -> None:
        """Makes the material.

        youngs_modulus: Young's modulus at small strain; greater than 0 (force per area).
        poissons_ratio: Poisson's ratio at small strain; greater than -1 and less than 0.5 (no
            unit).
        """
        values: Values = {
            "youngs_modulus": check.number(youngs_modulus, "youngs_modulus"),
            "poissons_ratio": check.number(poissons_ratio, "poissons_ratio"),
        }
        self._make("linear-elastic", values)


class IsochoricNeoHookean(Rubber):
    """Rubber with the energy ``G/2 (I1 - 3)``, nearly incompressible."""

    def __init__(
        self,
        shear_modulus: float,
        *,
        bulk_modulus: Optional[float] = None,
        poissons_ratio: Optional[float] = None,
        volumetric: Literal["quadratic", "logarithmic"] = "quadratic",
        relaxation: Sequence[tuple[float, float]] = (),
    ) -> None:
        """Makes the material.

        shear_modulus: shear modulus ``G``; greater than 0 (force per area).
        bulk_modulus: bulk modulus ``K``; greater than 0 (force per area); it or ``poissons_ratio``
            is needed.
        poissons_ratio: Poisson's ratio at rest; greater than -1 and less than 0.5 (no unit); it or
            ``bulk_modulus`` is needed.
        volumetric: form of the volumetric energy for the volume ratio ``J`` and a modulus ``k``:
            ``quadratic``: ``k/2 (J - 1)^2``; ``logarithmic``: ``k/2 ln^2 J``.
        relaxation: branches with relaxing stress in parallel to the law, which describes slow
            deformations; each of ``ratio``, ratio of its modulus to that of slow deformations;
            greater than 0 (no unit), ``time``, relaxation time, in the unit of the durations of
            steps; greater than 0 (time); none by default. If another program states the share
            ``g`` of the modulus of sudden deformations, the ratio is ``g/(1 - sum of all g)``.
        """
        values: Values = {
            "shear_modulus": check.number(shear_modulus, "shear_modulus"),
            "bulk_modulus": check.optional(bulk_modulus, "bulk_modulus"),
            "poissons_ratio": check.optional(poissons_ratio, "poissons_ratio"),
            "volumetric": check.word(volumetric, ("quadratic", "logarithmic"), "volumetric"),
            "relaxation": check.rows_of(relaxation, "relaxation", 2) or None,
        }
        self._make("isochoric-neo-hookean", values)


class MooneyRivlin(Rubber):
    """Rubber with the energy ``c10 (I1 - 3) + c01 (I2 - 3)``, nearly incompressible."""

    def __init__(
        self,
        c10: float,
        c01: float,
        *,
        bulk_modulus: Optional[float] = None,
        poissons_ratio: Optional[float] = None,
        volumetric: Literal["quadratic", "logarithmic"] = "quadratic",
        relaxation: Sequence[tuple[float, float]] = (),
    ) -> None:
        """Makes the material.

        c10: constant of the first invariant (force per area).
        c01: constant of the second invariant; ``c10 + c01`` must be positive (force per area).
        bulk_modulus: bulk modulus ``K``; greater than 0 (force per area); it or ``poissons_ratio``
            is needed.
        poissons_ratio: Poisson's ratio at rest; greater than -1 and less than 0.5 (no unit); it or
            ``bulk_modulus`` is needed.
        volumetric: form of the volumetric energy for the volume ratio ``J`` and a modulus ``k``:
            ``quadratic``: ``k/2 (J - 1)^2``; ``logarithmic``: ``k/2 ln^2 J``.
        relaxation: branches with relaxing stress in parallel to the law, which describes slow
            deformations; each of ``ratio``, ratio of its modulus to that of slow deformations;
            greater than 0 (no unit), ``time``, relaxation time, in the unit of the durations of
            steps; greater than 0 (time); none by default. If another program states the share
            ``g`` of the modulus of sudden deformations, the ratio is ``g/(1 - sum of all g)``.
        """
        values: Values = {
            "c10": check.number(c10, "c10"),
            "c01": check.number(c01, "c01"),
            "bulk_modulus": check.optional(bulk_modulus, "bulk_modulus"),
            "poissons_ratio": check.optional(poissons_ratio, "poissons_ratio"),
            "volumetric": check.word(volumetric, ("quadratic", "logarithmic"), "volumetric"),
            "relaxation": check.rows_of(relaxation, "relaxation", 2) or None,
        }
        self._make("mooney-rivlin", values)


class Yeoh(Rubber):
    """Rubber with a cubic energy of ``I1 - 3``, nearly incompressible."""

    def __init__(
        self,
        c10: float,
        c20: float,
        c30: float,
        *,
        bulk_modulus: Optional[float] = None,
        poissons_ratio: Optional[float] = None,
        volumetric: Literal["quadratic", "logarithmic"] = "quadratic",
        relaxation: Sequence[tuple[float, float]] = (),
    ) -> None:
        """Makes the material.

        c10: constant of ``I1 - 3``, half the shear modulus at rest; greater than 0 (force per
            area).
        c20: constant of ``(I1 - 3)^2`` (force per area).
        c30: constant of ``(I1 - 3)^3`` (force per area).
        bulk_modulus: bulk modulus ``K``; greater than 0 (force per area); it or ``poissons_ratio``
            is needed.
        poissons_ratio: Poisson's ratio at rest; greater than -1 and less than 0.5 (no unit); it or
            ``bulk_modulus`` is needed.
        volumetric: form of the volumetric energy for the volume ratio ``J`` and a modulus ``k``:
            ``quadratic``: ``k/2 (J - 1)^2``; ``logarithmic``: ``k/2 ln^2 J``.
        relaxation: branches with relaxing stress in parallel to the law, which describes slow
            deformations; each of ``ratio``, ratio of its modulus to that of slow deformations;
            greater than 0 (no unit), ``time``, relaxation time, in the unit of the durations of
            steps; greater than 0 (time); none by default. If another program states the share
            ``g`` of the modulus of sudden deformations, the ratio is ``g/(1 - sum of all g)``.
        """
        values: Values = {
            "c10": check.number(c10, "c10"),
            "c20": check.number(c20, "c20"),
            "c30": check.number(c30, "c30"),
            "bulk_modulus": check.optional(bulk_modulus, "bulk_modulus"),
            "poissons_ratio": check.optional(poissons_ratio, "poissons_ratio"),
            "volumetric": check.word(volumetric, ("quadratic", "logarithmic"), "volumetric"),
            "relaxation": check.rows_of(relaxation, "relaxation", 2) or None,
        }
        self._make("yeoh", values)


class Ogden(Rubber):
    """Rubber with the energy ``sum mu/alpha (l1^alpha + l2^alpha + l3^alpha - 3)`` of the
    isochoric stretches, nearly incompressible."""

    def __init__(
        self,
        terms: Sequence[tuple[float, float]],
        *,
        bulk_modulus: Optional[float] = None,
        poissons_ratio: Optional[float] = None,
        volumetric: Literal["quadratic", "logarithmic"] = "quadratic",
        relaxation: Sequence[tuple[float, float]] = (),
    ) -> None:
        """Makes the material.

        terms: terms; the shear modulus at rest, half the sum of ``mu alpha``, must be positive;
            each of ``mu``, modulus (force per area), ``alpha``, exponent, not zero (no unit).
            Other programs write ``2 mu/alpha^2`` where this one writes ``mu/alpha``.
        bulk_modulus: bulk modulus ``K``; greater than 0 (force per area); it or ``poissons_ratio``
            is needed.
        poissons_ratio: Poisson's ratio at rest; greater than -1 and less than 0.5 (no unit); it or
            ``bulk_modulus`` is needed.
        volumetric: form of the volumetric energy for the volume ratio ``J`` and a modulus ``k``:
            ``quadratic``: ``k/2 (J - 1)^2``; ``logarithmic``: ``k/2 ln^2 J``.
        relaxation: branches with relaxing stress in parallel to the law, which describes slow
            deformations; each of ``ratio``, ratio of its modulus to that of slow deformations;
            greater than 0 (no unit), ``time``, relaxation time, in the unit of the durations of
            steps; greater than 0 (time); none by default. If another program states the share
            ``g`` of the modulus of sudden deformations, the ratio is ``g/(1 - sum of all g)``.
        """
        values: Values = {
            "terms": check.rows_of(terms, "terms", 2),
            "bulk_modulus": check.optional(bulk_modulus, "bulk_modulus"),
            "poissons_ratio": check.optional(poissons_ratio, "poissons_ratio"),
            "volumetric": check.word(volumetric, ("quadratic", "logarithmic"), "volumetric"),
            "relaxation": check.rows_of(relaxation, "relaxation", 2) or None,
        }
        self._make("ogden", values)


class Gent(Rubber):
    """Rubber with chains of finite length: energy ``-G Jm/2 ln(1 - (I1 - 3)/Jm)``, nearly
    incompressible."""

    def __init__(
        self,
        shear_modulus: float,
        limit: float,
        *,
        bulk_modulus: Optional[float] = None,
        poissons_ratio: Optional[float] = None,
        volumetric: Literal["quadratic", "logarithmic"] = "quadratic",
        relaxation: Sequence[tuple[float, float]] = (),
    ) -> None:
        """Makes the material.

        shear_modulus: shear modulus ``G``; greater than 0 (force per area).
        limit: ``Jm``, the limit of ``I1 - 3``; greater than 0 (no unit).
        bulk_modulus: bulk modulus ``K``; greater than 0 (force per area); it or ``poissons_ratio``
            is needed.
        poissons_ratio: Poisson's ratio at rest; greater than -1 and less than 0.5 (no unit); it or
            ``bulk_modulus`` is needed.
        volumetric: form of the volumetric energy for the volume ratio ``J`` and a modulus ``k``:
            ``quadratic``: ``k/2 (J - 1)^2``; ``logarithmic``: ``k/2 ln^2 J``.
        relaxation: branches with relaxing stress in parallel to the law, which describes slow
            deformations; each of ``ratio``, ratio of its modulus to that of slow deformations;
            greater than 0 (no unit), ``time``, relaxation time, in the unit of the durations of
            steps; greater than 0 (time); none by default. If another program states the share
            ``g`` of the modulus of sudden deformations, the ratio is ``g/(1 - sum of all g)``.
        """
        values: Values = {
            "shear_modulus": check.number(shear_modulus, "shear_modulus"),
            "limit": check.number(limit, "limit"),
            "bulk_modulus": check.optional(bulk_modulus, "bulk_modulus"),
            "poissons_ratio": check.optional(poissons_ratio, "poissons_ratio"),
            "volumetric": check.word(volumetric, ("quadratic", "logarithmic"), "volumetric"),
            "relaxation": check.rows_of(relaxation, "relaxation", 2) or None,
        }
        self._make("gent", values)


class ArrudaBoyce(Rubber):
    """Rubber by the first five terms of the eight-chain model, nearly incompressible."""

    def __init__(
        self,
        mu: float,
        locking_stretch: float,
        *,
        bulk_modulus: Optional[float] = None,
        poissons_ratio: Optional[float] = None,
        volumetric: Literal["quadratic", "logarithmic"] = "quadratic",
        relaxation: Sequence[tuple[float, float]] = (),
    ) -> None:
        """Makes the material.

        mu: modulus ``mu``, near the shear modulus at rest; greater than 0 (force per area).
        locking_stretch: stretch at which the chains lock; greater than 1 (no unit).
        bulk_modulus: bulk modulus ``K``; greater than 0 (force per area); it or ``poissons_ratio``
            is needed.
        poissons_ratio: Poisson's ratio at rest; greater than -1 and less than 0.5 (no unit); it or
            ``bulk_modulus`` is needed.
        volumetric: form of the volumetric energy for the volume ratio ``J`` and a modulus ``k``:
            ``quadratic``: ``k/2 (J - 1)^2``; ``logarithmic``: ``k/2 ln^2 J``.
        relaxation: branches with relaxing stress in parallel to the law, which describes slow
            deformations; each of ``ratio``, ratio of its modulus to that of slow deformations;
            greater than 0 (no unit), ``time``, relaxation time, in the unit of the durations of
            steps; greater than 0 (time); none by default. If another program states the share
            ``g`` of the modulus of sudden deformations, the ratio is ``g/(1 - sum of all g)``.
        """
        values: Values = {
            "mu": check.number(mu, "mu"),
            "locking_stretch": check.number(locking_stretch, "locking_stretch"),
            "bulk_modulus": check.optional(bulk_modulus, "bulk_modulus"),
            "poissons_ratio": check.optional(poissons_ratio, "poissons_ratio"),
            "volumetric": check.word(volumetric, ("quadratic", "logarithmic"), "volumetric"),
            "relaxation": check.rows_of(relaxation, "relaxation", 2) or None,
        }
        self._make("arruda-boyce", values)


class ElasticPlastic(Material):
    """Metal with von Mises plasticity and isotropic hardening, for large strains."""

    def __init__(
        self,
        youngs_modulus: float,
        poissons_ratio: float,
        yield_stress: Optional[float] = None,
        hardening_modulus: Optional[float] = None,
        saturation: Optional[tuple[float, float]] = None,
        yield_table: Optional[Sequence[tuple[float, float]]] = None,
    ) -> None:
        """Makes the material.

        youngs_modulus: Young's modulus at small strain; greater than 0 (force per area).
        poissons_ratio: Poisson's ratio at small strain; greater than -1 and less than 0.5 (no
            unit).
        yield_stress: first yield stress ``Y0`` of ``Y = Y0 + (Ys - Y0) (1 - exp(-d p)) + H p``
            over the equivalent plastic strain ``p``; greater than 0 (force per area); it or
            ``yield_table`` is needed.
        hardening_modulus: hardening modulus ``H``; at least 0 (force per area); ``0.0`` by
            default.
        saturation: saturation by Voce's law; of ``stress``, stress ``Ys``, at least the first
            yield stress; greater than 0 (force per area), ``rate``, rate ``d`` over the plastic
            strain; greater than 0 (no unit); none by default.
        yield_table: pairs of equivalent plastic strain, from 0 on, and yield stress, which must
            not fall; the last stress holds beyond; it or ``yield_stress`` is needed.
        """
        values: Values = {
            "youngs_modulus": check.number(youngs_modulus, "youngs_modulus"),
            "poissons_ratio": check.number(poissons_ratio, "poissons_ratio"),
            "yield_stress": check.optional(yield_stress, "yield_stress"),
            "hardening_modulus": check.optional(hardening_modulus, "hardening_modulus"),
            "saturation": None if saturation is None else check.row(saturation, "saturation", 2),
            "yield_table": None if yield_table is None else check.rows_of(yield_table, "yield_table", 2),
        }
        self._make("elastic-plastic", values)
