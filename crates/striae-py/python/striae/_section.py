"""Parts of bodies with other materials."""

from __future__ import annotations

from typing import Literal, Optional

from . import _check as check
from . import _striae as native
from ._made import Strict
from ._material import Material

Formulation = Literal["standard", "mean-dilatation", "assumed-strain"]
FORMULATIONS = ("standard", "mean-dilatation", "assumed-strain")


class Section(Strict):
    """Elements of a body with their own material."""

    def __init__(
        self,
        elements: str,
        material: Material,
        *,
        density: Optional[float] = None,
        formulation: Optional[Formulation] = None,
    ) -> None:
        """Makes a section.

        elements: name of an element set of the mesh; no element is in two sections.
        material: bulk material.
        density: mass per volume at rest, for inertia and gravity.
        formulation: of its elements, as of :class:`Body`; by default that of the body if it has
            one, else the one that suits the material.
        """
        self.elements = check.name(elements, "elements")
        """Name of the element set."""
        self.material = check.kind(material, Material, "material")
        """Bulk material."""
        self.density = None if density is None else check.positive(density, "density")
        """Mass per volume at rest."""
        self._formulation = (
            None
            if formulation is None
            else check.word(formulation, FORMULATIONS, "formulation")
        )

    def _part(self) -> tuple[str, native.Material, Optional[float], Optional[str]]:
        return self.elements, self.material._native, self.density, self._formulation

    def __repr__(self) -> str:
        return f"Section({self.elements!r}, {self.material!r})"
