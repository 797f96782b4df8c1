"""Generators of meshes as the library declares them, written by ``declared.py``."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Literal, Optional, Union

from . import _check as check
from ._check import Floats, Ints, Values, Vector
from ._mesh import Mesh

__all__ = [
    "annulus",
    "block",
    "capped_block",
    "cylinder",
    "half_cylinder",
    "torus",
]


def block(
    size: Vector = (1.0, 1.0, 1.0),
    divisions: Union[Sequence[int], Ints] = (1, 1, 1),
    *,
    origin: Vector = (0.0, 0.0, 0.0),
    cells: Literal["hexahedra", "wedges", "pyramids", "tetrahedra", "composite-tetrahedra"] = "hexahedra",
    grading: Optional[Mapping[str, Mapping[str, Union[float, Sequence[float], Floats]]]] = None,
    rotation: Optional[Mapping[str, Union[Vector, float]]] = None,
    mesh_rotation: float = 0.0,
    bottom_slopes: Vector = (0.0, 0.0),
    top_slopes: Vector = (0.0, 0.0),
    irregularity: float = 0.0,
    seed: int = 0,
) -> Mesh:
    """A block. Sets of nodes and facets: ``xmin``, ``xmax``, ``ymin``, ``ymax``, ``zmin``,
    ``zmax``, named before rotation.

    size: edge lengths; greater than 0 (length).
    divisions: hexahedra along the edges.
    origin: its corner of smallest coordinates, before rotation (length).
    cells: kind of cells that the hexahedra are divided into: ``hexahedra``: Hexahedra with
        eight nodes, not divided; ``wedges``: Wedges with six nodes, two in each hexahedron,
        along the third axis; ``pyramids``: Pyramids with five nodes, six in each hexahedron;
        ``tetrahedra``: Tetrahedra with four nodes, six in each hexahedron;
        ``composite-tetrahedra``: Tetrahedra with ten nodes, six in each hexahedron, each
        linear in twelve parts.
    grading: interval lengths along the edges; a mapping with ``x``, along the first axis,
        ``y``, along the second axis, ``z``, along the third axis; each with ``one_sided``,
        last length over the first; greater than 0 (no unit) or ``symmetric``, length in the
        middle over the length at the ends; greater than 0 (no unit) or ``lengths``, one length
        a division, up to a common factor; greater than 0 (no unit); equal by default.
    rotation: rotation of the whole block; a mapping with ``axis``, axis of any length,
        ``degrees``, angle by the right-hand rule (degrees), ``about``, fixed point of the
        rotation (length), the centre of the body by default; none by default.
    mesh_rotation: angle by which the mesh is rotated about the third axis inside the unchanged
        outline; elements stay well shaped up to about 25 (degrees).
    bottom_slopes: slopes of the lower side along the first two axes (no unit).
    top_slopes: slopes of the upper side along the first two axes (no unit).
    irregularity: random displacement of inner nodes as a fraction of the local interval;
        elements stay well shaped up to about 0.25; at least 0 and less than 0.5 (no unit).
    seed: seed of the random displacement; at least 0.
    """
    values: Values = {
        "size": check.vector(size, "size"),
        "divisions": check.counts(divisions, "divisions"),
        "origin": check.vector(origin, "origin"),
        "cells": check.word(cells, ("hexahedra", "wedges", "pyramids", "tetrahedra", "composite-tetrahedra"), "cells"),
        "grading": None if grading is None else check.table(grading, "grading"),
        "rotation": None if rotation is None else check.table(rotation, "rotation"),
        "mesh_rotation": check.number(mesh_rotation, "mesh_rotation"),
        "bottom_slopes": check.vector(bottom_slopes, "bottom_slopes", 2),
        "top_slopes": check.vector(top_slopes, "top_slopes", 2),
        "irregularity": check.number(irregularity, "irregularity"),
        "seed": check.whole(seed, "seed", 0),
    }
    return Mesh._generated("block", values)


def capped_block(
    size: Vector = (10.0, 10.0),
    height: float = 6.5,
    radius: float = 12.0,
    element_size: float = 0.8,
    *,
    apex: Vector = (0.0, 0.0, 0.0),
    fine_half_width: Optional[float] = None,
    fine_depth: float = 0.0,
    growth: float = 1.3,
    part: Literal["whole", "half"] = "whole",
    cells: Literal["hexahedra", "wedges", "pyramids", "tetrahedra", "composite-tetrahedra"] = "hexahedra",
) -> Mesh:
    """A block whose lower side is a spherical cap, finer around its lowest point. Sets of
    nodes and facets: ``xmin``, ``xmax``, ``ymin``, ``ymax``, ``cap``, ``zmax``.

    size: edge lengths along the first two axes; greater than 0 (length).
    height: height from the lowest point to the upper side; greater than 0 (length).
    radius: radius of the sphere; greater than 0 (length).
    element_size: element size at the lowest point; greater than 0 (length).
    apex: lowest point (length).
    fine_half_width: half the width of the zone with elements of this size; at least 0
        (length); ``2 element_size`` by default.
    fine_depth: depth of the zone with elements of this size; at least 0 (length).
    growth: largest ratio of neighbouring sizes outside that zone; at least 1 (no unit).
    part: part of it that is meshed: ``whole``: The whole block; ``half``: The half on the
        positive side of the second axis; ``ymin`` is then the plane of symmetry.
    cells: kind of cells that the hexahedra are divided into: ``hexahedra``: Hexahedra with
        eight nodes, not divided; ``wedges``: Wedges with six nodes, two in each hexahedron,
        along the third axis; ``pyramids``: Pyramids with five nodes, six in each hexahedron;
        ``tetrahedra``: Tetrahedra with four nodes, six in each hexahedron;
        ``composite-tetrahedra``: Tetrahedra with ten nodes, six in each hexahedron, each
        linear in twelve parts.
    """
    values: Values = {
        "size": check.vector(size, "size", 2),
        "height": check.number(height, "height"),
        "radius": check.number(radius, "radius"),
        "element_size": check.number(element_size, "element_size"),
        "apex": check.vector(apex, "apex"),
        "fine_half_width": check.optional(fine_half_width, "fine_half_width"),
        "fine_depth": check.number(fine_depth, "fine_depth"),
        "growth": check.number(growth, "growth"),
        "part": check.word(part, ("whole", "half"), "part"),
        "cells": check.word(cells, ("hexahedra", "wedges", "pyramids", "tetrahedra", "composite-tetrahedra"), "cells"),
    }
    return Mesh._generated("capped-block", values)


def half_cylinder(
    radius: float = 8.0,
    thickness: float = 1.0,
    element_size: float = 0.2,
    *,
    apex: Vector = (0.0, 0.0, 0.0),
    half: Literal["lower", "upper"] = "lower",
    layers: int = 1,
    fine_half_width: Optional[float] = None,
    fine_depth: float = 0.0,
    growth: float = 1.2,
) -> Mesh:
    """A slice of a half cylinder along the second axis, finer around the contact point. Sets
    of nodes and facets: ``flat``, ``arc``, ``ymin``, ``ymax``.

    radius: radius; greater than 0 (length).
    thickness: thickness of the slice; greater than 0 (length).
    element_size: element size at the contact point; greater than 0 (length).
    apex: contact point in the side ``ymin``: lowest of the lower half, highest of the upper
        half (length).
    half: half of the cylinder: ``lower``: Arc below, flat side on top; ``upper``: Arc on top,
        flat side below.
    layers: elements over the thickness; at least 1.
    fine_half_width: half the width of the zone with elements of this size; at least 0
        (length); ``5 element_size`` by default.
    fine_depth: depth of the zone with elements of this size; at least 0 (length).
    growth: largest ratio of neighbouring sizes outside that zone; at least 1 (no unit).
    """
    values: Values = {
        "radius": check.number(radius, "radius"),
        "thickness": check.number(thickness, "thickness"),
        "element_size": check.number(element_size, "element_size"),
        "apex": check.vector(apex, "apex"),
        "half": check.word(half, ("lower", "upper"), "half"),
        "layers": check.whole(layers, "layers"),
        "fine_half_width": check.optional(fine_half_width, "fine_half_width"),
        "fine_depth": check.number(fine_depth, "fine_depth"),
        "growth": check.number(growth, "growth"),
    }
    return Mesh._generated("half-cylinder", values)


def annulus(
    inner_radius: float = 0.2,
    outer_radius: float = 0.5,
    width: float = 0.4,
    divisions: Union[Sequence[int], Ints] = (3, 48, 4),
    *,
    centre: Vector = (0.0, 0.0, 0.0),
    axis: Vector = (0.0, 1.0, 0.0),
    radial_grading: Optional[Mapping[str, Union[float, Sequence[float], Floats]]] = None,
    axial_grading: Optional[Mapping[str, Union[float, Sequence[float], Floats]]] = None,
    refinement: Optional[tuple[float, float]] = None,
) -> Mesh:
    """A ring about an axis. Sets of nodes and facets: ``rim`` inside, ``tread`` outside, the
    plane sides ``ymin``, ``ymax`` and both of them, ``sides``.

    inner_radius: inner radius; greater than 0 (length).
    outer_radius: outer radius; greater than 0 (length).
    width: width along the axis; greater than 0 (length).
    divisions: elements along the radius, the circumference and the axis.
    centre: centre of the ring (length).
    axis: axis of any length.
    radial_grading: interval lengths from the inner to the outer radius; a mapping with
        ``one_sided``, last length over the first; greater than 0 (no unit) or ``symmetric``,
        length in the middle over the length at the ends; greater than 0 (no unit) or
        ``lengths``, one length a division, up to a common factor; greater than 0 (no unit);
        equal by default.
    axial_grading: interval lengths along the axis; a mapping with ``one_sided``, last length
        over the first; greater than 0 (no unit) or ``symmetric``, length in the middle over
        the length at the ends; greater than 0 (no unit) or ``lengths``, one length a division,
        up to a common factor; greater than 0 (no unit); equal by default.
    refinement: smaller elements around the lowest point; of ``half_angle``, angle to either
        side of the lowest point within which the size is smallest; at least 0 (degrees),
        ``ratio``, size at the highest point over the size at the lowest; at least 1 (no unit);
        none by default.
    """
    values: Values = {
        "inner_radius": check.number(inner_radius, "inner_radius"),
        "outer_radius": check.number(outer_radius, "outer_radius"),
        "width": check.number(width, "width"),
        "divisions": check.counts(divisions, "divisions"),
        "centre": check.vector(centre, "centre"),
        "axis": check.direction(axis, "axis"),
        "radial_grading": None if radial_grading is None else check.table(radial_grading, "radial_grading"),
        "axial_grading": None if axial_grading is None else check.table(axial_grading, "axial_grading"),
        "refinement": None if refinement is None else check.row(refinement, "refinement", 2),
    }
    return Mesh._generated("annulus", values)


def cylinder(
    radius: float = 1.0,
    height: float = 1.0,
    divisions: Union[Sequence[int], Ints] = (2, 2, 4),
    *,
    base: Vector = (0.0, 0.0, 0.0),
    axis: Vector = (0.0, 0.0, 1.0),
    axial_grading: Optional[Mapping[str, Union[float, Sequence[float], Floats]]] = None,
    part: Literal["whole", "quarter"] = "whole",
) -> Mesh:
    """A solid cylinder. Sets of nodes and facets: the round ``side``, ``zmin``, ``zmax``, for
    a quarter also its planes of symmetry ``xmin`` and ``ymin``; named before rotation.

    radius: radius; greater than 0 (length).
    height: extent along the axis; greater than 0 (length).
    divisions: elements along half an edge of the square core, from the core to the side, and
        along the axis. A quarter turn has twice the first number.
    base: centre of the side ``zmin`` (length).
    axis: axis from there, of any length.
    axial_grading: interval lengths along the axis; a mapping with ``one_sided``, last length
        over the first; greater than 0 (no unit) or ``symmetric``, length in the middle over
        the length at the ends; greater than 0 (no unit) or ``lengths``, one length a division,
        up to a common factor; greater than 0 (no unit); equal by default.
    part: part of it that is meshed: ``whole``: The whole cylinder; ``quarter``: The quarter on
        the positive sides of the first two axes.
    """
    values: Values = {
        "radius": check.number(radius, "radius"),
        "height": check.number(height, "height"),
        "divisions": check.counts(divisions, "divisions"),
        "base": check.vector(base, "base"),
        "axis": check.direction(axis, "axis"),
        "axial_grading": None if axial_grading is None else check.table(axial_grading, "axial_grading"),
        "part": check.word(part, ("whole", "quarter"), "part"),
    }
    return Mesh._generated("cylinder", values)


def torus(
    ring_radius: float = 4.0,
    section_radius: float = 1.0,
    divisions: Union[Sequence[int], Ints] = (2, 2, 24),
    *,
    centre: Vector = (0.0, 0.0, 0.0),
    axis: Vector = (0.0, 0.0, 1.0),
) -> Mesh:
    """A ring of round section. Set of nodes and facets: ``surface``.

    ring_radius: radius of the circle on which the centres of the sections lie; greater than 0
        (length).
    section_radius: radius of the section; greater than 0 (length).
    divisions: elements along half an edge of the square core of the section, from the core to
        the surface, and around the axis. The section has eight times the first number around.
    centre: centre of the ring (length).
    axis: axis of any length.
    """
    values: Values = {
        "ring_radius": check.number(ring_radius, "ring_radius"),
        "section_radius": check.number(section_radius, "section_radius"),
        "divisions": check.counts(divisions, "divisions"),
        "centre": check.vector(centre, "centre"),
        "axis": check.direction(axis, "axis"),
    }
    return Mesh._generated("torus", values)
