"""Contact of everything with everything."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Literal, Optional, TypeAlias, Union

from . import _check as check
from . import _striae as native
from ._body import Body, BodySet
from ._errors import refuse
from ._friction import Friction
from ._made import Strict, are_alike
from ._rigid import Rigid
from ._texture import Texture

Surface: TypeAlias = Union[str, Body, BodySet, Rigid]
"""A surface: a body, a facet set ``body["top"]``, a rigid body, or a label: ``"tread"``,
``"tread.zmin"``."""
Excluded: TypeAlias = Union[Surface, tuple[Surface, Surface]]

#: Dihedral angle in degrees from which on an edge separates faces.
FEATURE_ANGLE = 45.0


class Everything(Strict):
    """Contact of everything with everything, as :meth:`Model.contact_all` states it."""

    def __init__(
        self,
        friction: Optional[Friction],
        exclude: Sequence[Excluded],
        between: Sequence[tuple[Surface, Surface, Friction]],
        textures: Sequence[Union[BodySet, Rigid]],
        feature_angle: float,
        search_distance: Optional[float],
        initial: Union[Literal["as-meshed", "close", "resolve"], float],
        stabilise: bool,
    ) -> None:
        """Takes the arguments of the method."""
        if friction is not None:
            check.kind(friction, Friction, "friction")
        made = native.Everything(None if friction is None else friction._native)
        self.friction = friction
        self.painted: dict[str, Texture] = {}
        check.several(exclude, "exclude", "a list of surfaces, and of tuples of two,")
        for one in exclude:
            if isinstance(one, tuple) and len(one) != 2:
                raise refuse("exclude", f"tuples of two surfaces are needed, not of {len(one)}")
            a, b = one if isinstance(one, tuple) else (one, None)
            made = made.excluding(label(a, "exclude"), None if b is None else label(b, "exclude"))
        check.several(between, "between", "a list of two surfaces and their law each")
        for stated in between:
            if not isinstance(stated, (tuple, list)) or len(stated) != 3:
                raise refuse("between", "tuples of two surfaces and their law are needed")
            a, b, law = stated
            law = check.kind(law, Friction, "between")
            made = made.between(label(a, "between"), label(b, "between"), law._native)
            self._paint(a, b)
        check.several(textures, "textures", "a list of textured surfaces")
        for surface in textures:
            if label(surface, "textures") and _texture(surface) is None:
                raise TypeError(f"textures: {surface!r} has no texture; see BodySet.textured")
            self._paint(surface)
        made = made.divided(check.number(feature_angle, "feature_angle"))
        if search_distance is not None:
            made = made.searching(check.positive(search_distance, "search_distance"))
        if isinstance(initial, str):
            treatment = check.word(initial, ("as-meshed", "close", "resolve"), "initial")
            if treatment == "close":
                made = made.closed(None)
            elif treatment == "resolve":
                made = made.resolved()
        else:
            made = made.closed(check.positive(initial, "initial"))
        self._made = made.stabilised() if check.boolean(stabilise, "stabilise") else made

    def _paint(self, *surfaces: Surface) -> None:
        for surface in surfaces:
            texture = _texture(surface)
            if texture is None:
                continue
            name = label(surface, "textures")
            if not are_alike(self.painted.setdefault(name, texture), texture):
                raise refuse("textures", f"`{name}` has two textures; state one of them")

    def native(self, rigid: Sequence[Rigid]) -> native.Everything:
        """The statement, with the textures of rigid bodies."""
        own = {one.name: one.texture for one in rigid if one.texture is not None}
        made = self._made
        for surface, texture in {**own, **self.painted}.items():
            made = made.textured(surface, texture._native)
        return made


def label(surface: Surface, path: str) -> str:
    """Name of a surface in decks."""
    if isinstance(surface, str):
        return check.name(surface, path)
    if isinstance(surface, BodySet):
        return f"{surface.body.name}.{surface.name}"
    if isinstance(surface, (Body, Rigid)):
        return surface.name
    raise TypeError(
        f"{path}: a body, a set such as body['top'], a rigid body or a label is needed,"
        f" not {type(surface).__name__}"
    )


def _texture(surface: Surface) -> Optional[Texture]:
    return surface.texture if isinstance(surface, (BodySet, Rigid)) else None
