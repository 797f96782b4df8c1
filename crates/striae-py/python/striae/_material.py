"""Bulk materials."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Sequence
from typing import Optional, Union

import numpy as np
import numpy.typing as npt

from . import _check as check
from . import _striae as native
from ._check import Floats, Values
from ._errors import refuse
from ._made import Made


#: Names of the moduli that every material has.
MODULI = ("youngs_modulus", "poissons_ratio")


class Material(Made):
    """A bulk material, such as :class:`NeoHookean`, :class:`LinearElastic` or :class:`Ogden`."""

    _native: native.Material
    _told: str

    def __init__(self) -> None:
        """Use one of the materials."""
        raise TypeError("use a material such as NeoHookean or LinearElastic")

    def stress(self, deformation_gradient: Union[Sequence[Sequence[float]], Floats]) -> Floats:
        """First Piola-Kirchhoff stress, of shape (3, 3) (force per reference area).

        deformation_gradient: of shape (3, 3) (no unit).
        """
        rows = check.tensor(deformation_gradient, "deformation_gradient").tolist()
        return np.array(self._native.response(rows)[1])

    def energy(self, deformation_gradient: Union[Sequence[Sequence[float]], Floats]) -> float:
        """Stored energy (per reference volume).

        deformation_gradient: of shape (3, 3) (no unit).
        """
        rows = check.tensor(deformation_gradient, "deformation_gradient").tolist()
        return self._native.response(rows)[0]

    def _make(self, law: str, values: Values) -> None:
        """Makes a declared law of values that are present."""
        given = [(name, value) for name, value in values.items() if value is not None]
        self._native = native.Material.declared(type(self).__name__, law, given)
        self.youngs_modulus, self.poissons_ratio = self._native.constants()
        # Moduli that were given come back with round-off.
        self.__dict__.update((name, value) for name, value in given if name in MODULI)
        arguments = inspect.signature(type(self)).parameters
        defaults = {name: argument.default for name, argument in arguments.items()}
        told = [(name, value) for name, value in given if value != defaults.get(name)]
        self._told = ", ".join(f"{name}={value!r}" for name, value in told)

    def __repr__(self) -> str:
        return f"{type(self).__name__}({self._told})"

    youngs_modulus: float
    """Young's modulus (force per area)."""
    poissons_ratio: float
    """Poisson's ratio (no unit)."""


class Rubber(Material):
    """Rubber: an isochoric energy, which each law defines, and an energy of the volume ratio.

    Branches of a spring and a dashpot model relaxation: ``relaxation=[(ratio, time), ...]``. The
    law describes slow deformations; the isochoric stress of sudden ones is ``1 + sum of ratios``
    times as large and relaxes to that of the law, in each branch with its relaxation time.
    """

    relaxation: tuple[tuple[float, ...], ...]
    """Branches: ratios of moduli (no unit) and relaxation times (time)."""

    def _make(self, law: str, values: Values) -> None:
        super()._make(law, values)
        self.relaxation = tuple(check.rows_of(values["relaxation"] or (), "relaxation", 2))


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
