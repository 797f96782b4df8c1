"""Contact pairs."""

from __future__ import annotations

from typing import Literal, Optional, Union

from . import _check as check
from . import _striae as native
from ._body import BodySet
from ._check import Curve
from ._errors import refuse
from ._friction import Friction
from ._made import Made
from ._rigid import Rigid
from ._step import Condition


class Pair(Made):
    """Two surfaces that may touch; neither is master or slave.

    Side ``a`` is the first one, but a rigid surface always becomes side ``b``.
    """

    def __init__(
        self,
        a: Union[BodySet, Rigid],
        b: Union[BodySet, Rigid, Literal["itself"]],
        friction: Optional[Friction] = None,
        *,
        name: Optional[str] = None,
        initial: Union[Literal["as-meshed", "close", "resolve"], float] = "as-meshed",
        interference: Optional[float] = None,
        curve: Curve = "ramp",
        wear: Union[float, tuple[float, float], None] = None,
        wear_across: float = 1.0,
        stabilise: bool = False,
        enforcement: Literal["weighted", "collocated"] = "weighted",
        search_distance: Optional[float] = None,
        feature_angle: Optional[float] = None,
    ) -> None:
        """Makes a pair.

        a, b: facet sets of bodies, with their textures, or rigid bodies; ``itself`` as ``b`` if
            facets of ``a`` may touch each other.
        friction: law from the start; steps may change it. Frictionless by default.
        name: unique name; made of the names of the bodies by default.
        initial: treatment of gaps and overlaps of the meshes: ``as-meshed`` keeps gaps and refuses
            overlaps, ``close`` moves nodes without strain, ``resolve`` removes overlaps gradually
            during the first step; a number closes gaps up to that size (length).
        interference: of a press fit (length): where the sides face each other within the search
            distance or overlap, they count as touching at the start, whatever the gap between their
            facets, and are pressed apart by this much in the first step; negative for a clearance.
            By default gaps are those of the meshes.
        curve: how the interference is approached in the first step.
        wear: of the sides, by which gaps open: the depth that wears off per pressure and slip
            (Archard), the coefficient of wear over the hardness (1/stress). One number for all
            deformable sides, or one for ``a`` and one for ``b``; nothing wears by default.
        wear_across: coefficients of wear across the texture of the side that has one, over those
            along it, which ``wear`` states.
        stabilise: if true, viscous forces carry bodies without other restraints across a gap, in
            steps without inertia; they fall to zero within the step.
        enforcement: ``weighted``, or ``collocated`` as in the paper, for comparison.
        search_distance: distance within which contact is searched (length); it affects the cost,
            not the result.
        feature_angle: dihedral angle from which on an edge separates faces, each with its own
            normal and traction there (degrees); by default all faces at a node share one.
        """
        on_itself = isinstance(b, str) and check.word(b, ("itself",), "b") == "itself"
        for side, path in [(a, "a"), (a if on_itself else b, "b")]:
            if not isinstance(side, (BodySet, Rigid)):
                raise TypeError(
                    f"{path}: a set such as body['top'] or a rigid body is needed,"
                    f" not {type(side).__name__}"
                )
        if friction is not None:
            check.kind(friction, Friction, "friction")
        two: list[Union[BodySet, Rigid]] = [a, a if isinstance(b, str) else b]
        owners = [side.body.name if isinstance(side, BodySet) else side.name for side in two]
        self.name = "-".join(owners) if name is None else check.name(name, "name")
        """Unique name."""
        self.a = a
        """First side."""
        self.b = b
        """Second side, or ``itself``."""
        self.friction = friction
        """Friction law from the start."""
        sides = (_side(a), None if isinstance(b, str) else _side(b))
        textures = [side.texture._native if side.texture is not None else None for side in two]
        law = None if friction is None else friction._native
        made = native.Pair(self.name, sides, (textures[0], textures[1]), law)
        if isinstance(initial, str):
            treatment = check.word(initial, ("as-meshed", "close", "resolve"), "initial")
            if treatment == "close":
                made = made.closed(None)
            elif treatment == "resolve":
                made = made.resolved()
        else:
            made = made.closed(check.positive(initial, "initial"))
        if interference is not None:
            value, along = check.number(interference, "interference"), check.curve(curve, "curve")
            made = made.interfering(value, along)
        if wear is not None:
            made = made.wearing(*_wear(wear, [a, b]))
        made = made.wearing_across(check.positive(wear_across, "wear_across"))
        if check.word(enforcement, ("weighted", "collocated"), "enforcement") == "collocated":
            made = made.collocated()
        if search_distance is not None:
            made = made.searching(check.positive(search_distance, "search_distance"))
        if feature_angle is not None:
            made = made.divided(check.number(feature_angle, "feature_angle"))
        self._native = made.stabilised() if check.boolean(stabilise, "stabilise") else made

    def change_friction(self, friction: Friction) -> Condition:
        """Changes the friction of the pair at the start of a step; friction: the new law."""
        return _change(self.name, friction)

    def __repr__(self) -> str:
        return f"Pair({self.a!r}, {self.b!r}, {self.friction!r}, name={self.name!r})"


def _change(name: str, friction: Friction) -> Condition:
    law = check.kind(friction, Friction, "friction")._native
    return Condition(f"friction of {name}", lambda step: step.friction(name, law))


def _wear(
    wear: Union[float, tuple[float, float]], sides: list[Union[BodySet, Rigid, str]]
) -> list[float]:
    """Coefficients of both sides; one number is that of all sets of bodies."""
    if isinstance(wear, (tuple, list)):
        return check.vector(wear, "wear", 2)
    coefficient = check.number(wear, "wear")
    return [coefficient if isinstance(side, BodySet) else 0.0 for side in sides]


def _side(side: Union[BodySet, Rigid]) -> tuple[str, Optional[str]]:
    if isinstance(side, Rigid):
        return side.name, None
    if side.name not in side.body.mesh.facet_sets:
        raise refuse(f"body `{side.body.name}`", f"set `{side.name}` has no facets")
    return side.body.name, side.name
