"""Rigid bodies: planes, surfaces of facets, and bodies without a surface that nodes are tied to.

They rotate about their reference point. Initially all their coordinates are held.
"""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from typing import Any, Literal, Optional, Union

import numpy.typing as npt

from . import _check as check
from . import _striae as native
from ._body import BodySet
from ._check import Curve, Vector
from ._errors import refuse
from ._made import Made
from ._step import Condition
from ._texture import Texture, texture

Coordinate = Literal["x", "y", "z", "rx", "ry", "rz"]
COORDINATES = ("x", "y", "z", "rx", "ry", "rz")


class Rigid(Made):
    """A rigid body; see :class:`Plane`, :class:`RigidSurface` and :class:`RigidBody`."""

    name: str
    """Unique name."""
    texture: Optional[Texture]
    """Texture of its surface, if it has one."""
    _native: Optional[native.Rigid]

    def __init__(self) -> None:
        """Use one of the rigid bodies."""
        raise TypeError("use Plane, RigidSurface or RigidBody")

    @classmethod
    def _known(cls, name: str) -> Rigid:
        rigid: Rigid = Rigid.__new__(Rigid)
        rigid.name, rigid.texture, rigid._native = name, None, None
        rigid._is_finished = True
        return rigid

    def _take(
        self,
        name: str,
        made: native.Rigid,
        reference: Optional[Vector],
        mass: Optional[float],
        inertia: Optional[Vector],
    ) -> None:
        """Takes name, reference point and inertia."""
        self.name = check.name(name, "name")
        if (mass is None) != (inertia is None):
            raise refuse(f"rigid body `{name}`", "mass and inertia must be given together")
        if mass is not None and inertia is not None:
            centre = [0.0, 0.0, 0.0] if reference is None else check.vector(reference, "reference")
            moments = [check.positive(one, "inertia") for one in check.vector(inertia, "inertia")]
            made = made.with_inertia(check.positive(mass, "mass"), centre, moments)
        if reference is not None:
            made = made.with_reference(check.vector(reference, "reference"))
        self._native = made

    def move(
        self,
        *,
        displacement: Optional[Vector] = None,
        rotation: Optional[Vector] = None,
        free: Sequence[Coordinate] = (),
        force: Optional[Vector] = None,
        torque: Optional[Vector] = None,
        curve: Curve = "ramp",
    ) -> Condition:
        """Moves or drives the body.

        displacement: target of the reference point (length).
        rotation: targets of the rotation angles about the fixed axes (degrees), which add up
            increment by increment: the order of turns about several axes counts.
        free: coordinates that are free from now on and follow the forces.
        force: target of the force at the reference point, on free coordinates.
        torque: target of the torque, on free coordinates (force times length).
        curve: how the targets are approached.
        """
        check.several(free, "free", "a list of coordinates")
        known = [check.word(one, COORDINATES, "free") for one in free]
        targets: list[Optional[float]] = [None] * 6
        if displacement is not None:
            targets[:3] = check.vector(displacement, "displacement")
        if rotation is not None:
            targets[3:] = check.vector(rotation, "rotation")
        for one, target in zip(COORDINATES, targets):
            if one in known and target:
                raise refuse("free", f"{one!r} has the target {target}, but none where it is free")
        driving = [
            None if value is None else check.vector(value, path)
            for value, path in [(force, "force"), (torque, "torque")]
        ]
        is_free = [one in known for one in COORDINATES]
        along, name = check.curve(curve, "curve"), self.name
        return Condition(
            f"motion of {name}",
            lambda step: step.move_rigid(name, targets, is_free, driving[0], driving[1], along),
        )

    def velocity(
        self,
        value: Vector = (0.0, 0.0, 0.0),
        *,
        spin: Vector = (0.0, 0.0, 0.0),
        about: Vector = (0.0, 0.0, 0.0),
    ) -> Condition:
        """Gives the body and everything tied to it the velocity ``value + spin x (x - about)`` at
        the start of a dynamic step.

        value: velocity (length per time).
        spin: angular velocity (radians per time).
        about: a point of the axis of the spin (length).
        """
        v, w = check.vector(value, "value"), check.vector(spin, "spin")
        point, name = check.vector(about, "about"), self.name
        return Condition(f"velocity of {name}", lambda step: step.rigid_velocity(name, v, w, point))

    def __repr__(self) -> str:
        return f"{type(self).__name__}({self.name!r})"


class Plane(Rigid):
    """An unbounded rigid plane."""

    def __init__(
        self,
        name: str,
        *,
        normal: Vector = (0.0, 0.0, 1.0),
        point: Vector = (0.0, 0.0, 0.0),
        texture: Union[Texture, Vector, None] = None,
        reference: Optional[Vector] = None,
        mass: Optional[float] = None,
        inertia: Optional[Vector] = None,
    ) -> None:
        """Makes a plane.

        name: unique name.
        normal: out of the rigid half space, of any length.
        point: a point of the plane (length).
        texture: a texture, or one direction of any length.
        reference: point about which it rotates; the origin by default (length).
        mass: of the body; needs ``inertia``.
        inertia: principal moments about the coordinate axes through the reference point (mass
            times length squared).
        """
        across = check.direction(normal, "normal")
        made = native.Rigid.plane(check.name(name, "name"), check.vector(point, "point"), across)
        self.texture = _texture(texture)
        self._take(name, made, reference, mass, inertia)


class RigidSurface(Rigid):
    """A rigid surface of triangles and quadrilaterals."""

    def __init__(
        self,
        name: str,
        surface: Union[str, os.PathLike[str], tuple[npt.ArrayLike, Mapping[str, npt.ArrayLike]]],
        *,
        texture: Union[Texture, Vector, None] = None,
        density: Optional[float] = None,
        reference: Optional[Vector] = None,
        mass: Optional[float] = None,
        inertia: Optional[Vector] = None,
    ) -> None:
        """Makes a surface.

        name: unique name.
        surface: a path to a Gmsh (``.msh``) or STL (``.stl``) file, or points of shape (n, 3)
            (length) and ``{"triangle": corners, "quad": corners}``, outward by the
            right-hand rule.
        texture: a texture, or one direction of any length.
        density: of the solid inside a closed surface (mass per volume), from which mass,
            centre and moments of inertia follow.
        reference: point about which it rotates; the centre of mass with ``density``, else the
            origin (length).
        mass: of the body; needs ``inertia``.
        inertia: principal moments about the coordinate axes through the reference point (mass
            times length squared).
        """
        given = None if density is None else check.positive(density, "density")
        if given is not None and mass is not None:
            raise refuse(f"rigid body `{name}`", "give it either a density or a mass")
        points, facets = _surface(surface)
        made = native.Rigid.surface(check.name(name, "name"), points, facets, given)
        self.texture = _texture(texture)
        self._take(name, made, reference, mass, inertia)


class RigidBody(Rigid):
    """A rigid body without a surface that nodes of deformable bodies are tied to."""

    def __init__(
        self,
        name: str,
        tied: Sequence[BodySet],
        *,
        reference: Optional[Vector] = None,
        mass: Optional[float] = None,
        inertia: Optional[Vector] = None,
    ) -> None:
        """Makes a rigid body.

        name: unique name.
        tied: sets of nodes that follow it.
        reference: point about which it rotates; the origin by default (length).
        mass: of the body; needs ``inertia``.
        inertia: principal moments about the coordinate axes through the reference point (mass
            times length squared).
        """
        check.several(tied, "tied", "a list of sets")
        sets = [check.kind(one, BodySet, "tied") for one in tied]
        if not sets:
            raise refuse(f"rigid body `{name}`", "at least one set of nodes is needed")
        named = [(one.body.name, one.name) for one in sets]
        self.texture = None
        made = native.Rigid.tied(check.name(name, "name"), named)
        self._take(name, made, reference, mass, inertia)


def _texture(value: Union[Texture, Vector, None]) -> Optional[Texture]:
    return texture(value)


def _surface(source: Any) -> tuple[check.Floats, check.Ints]:
    if isinstance(source, (str, os.PathLike)):
        return native.read_rigid_surface(os.fspath(source))
    if not (isinstance(source, tuple) and len(source) == 2 and isinstance(source[1], Mapping)):
        raise TypeError(
            "surface: a path, or points and a mapping such as {'triangle': corners}, is needed"
        )
    points, cells = source
    return check.rows(points, "points"), check.facets(cells, "surface")
