"""Meshes of bodies: cells with named sets of nodes, facets and elements."""

from __future__ import annotations

import math
import os
from collections.abc import Mapping, Sequence
from typing import Any, Literal, Optional, Union

import numpy as np
import numpy.typing as npt

from . import _check as check
from . import _striae as native
from ._check import Floats, Ints, Members, Vector
from ._errors import refuse
from ._made import Strict

#: Kinds of cells, by their names in meshio, and their corners.
KINDS = {"hexahedron": 8, "wedge": 6, "pyramid": 5, "tetra": 4, "tetra10": 10}

#: Kinds of cells that the hexahedra of generators are divided into.
CellKind = Literal["hexahedron", "wedge", "pyramid", "tetra", "tetra10"]


def frozen(array: npt.NDArray[Any]) -> npt.NDArray[Any]:
    """The array, made read-only."""
    array.setflags(write=False)
    return array


class Mesh(Strict):
    """Hexahedra, wedges, pyramids and tetrahedra with named sets of nodes, facets and elements.

    The sets ``all`` of facets and of elements always exist. A mesh does not change:
    :meth:`with_sets` makes a new one. Returned arrays are made once and are read-only. Positions
    are lengths in the units of the user.
    """

    _native: native.Mesh

    def __init__(
        self,
        points: npt.ArrayLike,
        cells: Mapping[str, npt.ArrayLike],
        *,
        node_sets: Optional[Mapping[str, Members]] = None,
        facet_sets: Optional[Mapping[str, Members]] = None,
        element_sets: Optional[Mapping[str, Members]] = None,
    ) -> None:
        """Makes a mesh from arrays.

        points: positions of the nodes, of shape (n, 3) (length).
        cells: ``{"hexahedron": corners}``, corners of shape (m, 8), counted from 0 and numbered as
            VTK's and meshio's cells; also ``wedge`` (6 corners), ``pyramid`` (5), ``tetra`` (4) and
            ``tetra10`` (10, midside nodes included), alone or together.
        node_sets: members of named sets of nodes, see :meth:`with_sets`.
        facet_sets: members of named sets of facets, see :meth:`with_sets`.
        element_sets: members of named sets of elements, see :meth:`with_sets`.
        """
        if not isinstance(cells, Mapping):
            raise TypeError(
                "cells: a mapping such as {'hexahedron': corners} is needed,"
                f" not {type(cells).__name__}"
            )
        if not cells or any(kind not in KINDS for kind in cells):
            raise refuse("cells", f"the kinds are {list(KINDS)}, but there is {list(cells)}")
        positions = check.rows(points, "points")
        corners = [(kind, check.indices(cells[kind], KINDS[kind], "cells")) for kind in cells]
        if not any(len(rows) for _, rows in corners):
            raise refuse("cells", "a mesh needs at least one cell")
        made = Mesh._of(native.Mesh(positions, corners))
        self._native = made.with_sets(
            nodes=node_sets, facets=facet_sets, elements=element_sets
        )._native
        self._arrays: dict[str, npt.NDArray[Any]] = {}

    @classmethod
    def _of(cls, found: native.Mesh) -> Mesh:
        mesh = object.__new__(cls)
        mesh._native = found
        mesh._arrays = {}
        return mesh

    @classmethod
    def of(cls, source: Any) -> Mesh:
        """The mesh of an object that has one.

        source: a mesh; a path to a Gmsh (``.msh``), Abaqus (``.inp``) or VTK (``.vtu``,
            ``.vtk``) file; an object of
            meshio (``points``, ``cells_dict``), whose cell sets and named physical groups
            of quadrilaterals become facet and node sets, and its point sets node sets; or
            an unstructured grid of pyvista, whose boolean point data become sets.
        """
        if isinstance(source, Mesh):
            return source
        if isinstance(source, (str, os.PathLike)):
            return read_mesh(source)
        if hasattr(source, "points") and hasattr(source, "cells_dict"):
            from ._interchange import from_cells

            return from_cells(source)
        raise TypeError(
            "mesh: a Mesh, a path, or a mesh of meshio or pyvista is needed,"
            f" not {type(source).__name__}"
        )

    def _array(self, key: str, made: Any) -> Any:
        if key not in self._arrays:
            self._arrays[key] = frozen(made())
        return self._arrays[key]

    @property
    def points(self) -> Floats:
        """Positions of the nodes at rest, of shape (n, 3) (length)."""
        found: Floats = self._array("points", self._native.points)
        return found

    @property
    def cells(self) -> dict[str, Ints]:
        """Corners of the cells by kind, as :class:`Mesh` takes them: counted from 0 and
        numbered as VTK's, of shape (m, 8) for ``hexahedron``."""
        return {kind: self._array("c " + kind, lambda: made) for kind, made in self._native.cells()}

    @property
    def boundary(self) -> Ints:
        """Corners of the facets of the boundary, of shape (k, 4), counter-clockwise from outside;
        triangles repeat their last corner."""
        found: Ints = self._array("boundary", self._native.boundary)
        return found

    @property
    def node_sets(self) -> dict[str, Ints]:
        """Numbers of the nodes of every named set of nodes."""
        names = self._native.node_sets()
        return {name: self._array("n " + name, lambda: self._native.node_set(name)) for name in names}

    @property
    def facet_sets(self) -> dict[str, Ints]:
        """Corners of the facets of every named set of facets, of shape (m, 4); triangles repeat
        their last corner."""
        names = self._native.facet_sets()
        return {
            name: self._array("f " + name, lambda: self._native.facet_set(name)) for name in names
        }

    @property
    def element_sets(self) -> dict[str, Ints]:
        """Numbers of the elements of every named set of elements, counted from 0 in the order of
        :attr:`cells`."""
        names = self._native.element_sets()
        return {
            name: self._array("e " + name, lambda: self._native.element_set(name))
            for name in names
        }

    @property
    def middles(self) -> Floats:
        """Centres of the elements at rest, means of their corners, of shape (m, 3), in the order of
        :attr:`cells` (length)."""
        found: Floats = self._array("middles", self._native.middles)
        return found

    @property
    def volume(self) -> float:
        """Volume of the mesh (length cubed)."""
        return self._native.volume()

    def surface_nodes(self, facets: str) -> Ints:
        """Numbers of the nodes of a facet set, in the order that :class:`Nodal` textures and
        results of contact have.

        facets: name of the facet set.
        """
        found = self._native.facet_nodes(facets)
        if found is None:
            raise refuse("facets", f"the mesh has no facet set `{facets}`{listed(self.facet_sets)}")
        return found

    def facets_along(self, direction: Vector, angle: float) -> Ints:
        """Corners of the facets that face a direction, of shape (m, 4), for :meth:`with_sets`.

        direction: of any length but zero.
        angle: largest angle between it and the outward normal (degrees).
        """
        towards = check.vector(direction, "direction")
        if not any(towards):
            raise refuse("direction", "it must not be the zero vector")
        return self._native.facets_along(towards, math.radians(half_turn(angle, "angle")))

    def facets_around(self, place: Vector, feature_angle: float) -> Ints:
        """Corners of the facets that can be reached from the one nearest to a place without
        crossing a sharp edge, of shape (m, 4), for :meth:`with_sets`.

        place: position (length).
        feature_angle: largest angle between the normals on the two sides of an edge that is crossed
            (degrees).
        """
        turn = math.radians(half_turn(feature_angle, "feature_angle"))
        return self._native.facets_around(check.vector(place, "place"), turn)

    def facets_of(self, elements: str) -> Ints:
        """Corners of the outer facets of elements, of shape (m, 4), for :meth:`with_sets`.

        elements: name of the element set.
        """
        found = self._native.facets_of(elements)
        if found is None:
            text = f"the mesh has no element set `{elements}`{listed(self.element_sets)}"
            raise refuse("elements", text)
        return found

    def with_sets(
        self,
        *,
        nodes: Optional[Mapping[str, Members]] = None,
        facets: Optional[Mapping[str, Members]] = None,
        elements: Optional[Mapping[str, Members]] = None,
    ) -> Mesh:
        """The mesh with more sets; one of the same name is replaced.

        nodes: by name the numbers of the nodes, a boolean mask over all nodes, or a function
            that takes the positions, of shape (n, 3), and returns a mask.
        facets: by name the corners of the facets, of shape (m, 4), or (m, 3) for triangles, and in
            any order, or nodes in one of the ways above: then all boundary facets with all corners
            among them.
        elements: by name the numbers of the elements in the order of :attr:`cells`, a boolean
            mask over all elements, or a function that takes :attr:`middles` and returns a mask.
        """
        found = self._native
        for name, members in (nodes or {}).items():
            path = f"node set `{check.name(name, 'node_sets')}`"
            found = found.with_node_set(name, chosen(members, self.points, path))
        for name, members in (facets or {}).items():
            path = f"facet set `{check.name(name, 'facet_sets')}`"
            if not callable(members) and np.ndim(np.asarray(members)) == 2:
                found = found.with_facet_set(name, corners_of_facets(members, path))
            else:
                found = found.with_facets_of(name, chosen(members, self.points, path))
        for name, members in (elements or {}).items():
            path = f"element set `{check.name(name, 'element_sets')}`"
            found = found.with_element_set(name, chosen(members, self.middles, path))
        return Mesh._of(found)

    def __reduce__(self) -> tuple[Any, ...]:
        facets = {name: np.array(corners) for name, corners in self.facet_sets.items()}
        nodes = {name: np.array(members) for name, members in self.node_sets.items()}
        elements = {name: np.array(members) for name, members in self.element_sets.items()}
        cells = {kind: np.array(corners) for kind, corners in self.cells.items()}
        return _again, (np.array(self.points), cells, nodes, facets, elements)

    def __repr__(self) -> str:
        sets = sorted({*self._native.node_sets(), *self._native.facet_sets()})
        cells = ", ".join(f"{len(rows)} {kind}" for kind, rows in self.cells.items())
        return f"Mesh({len(self.points)} nodes, {cells}, sets {sets})"


def _again(points: Floats, cells: Any, nodes: Any, facets: Any, elements: Any) -> Mesh:
    return Mesh(points, cells, node_sets=nodes, facet_sets=facets, element_sets=elements)


def chosen(members: Members, places: Floats, path: str) -> Ints:
    """Numbers of the nodes or elements selected by members."""
    found = np.asarray(members(places) if callable(members) else members)
    count = len(places)
    if found.dtype == np.bool_:
        if found.shape != (count,):
            raise refuse(
                path, f"a mask of shape ({count},) is needed, but it has shape {found.shape}"
            )
        return np.flatnonzero(found).astype(np.int64)
    if callable(members):
        raise refuse(path, f"the function must return a mask, but its dtype is {found.dtype}")
    numbers = check.integers(found, path)
    if numbers.ndim != 1:
        raise refuse(path, f"an array of one dimension is needed, not of {numbers.ndim}")
    return numbers


def corners_of_facets(members: Any, path: str) -> Ints:
    """Corners of facets; triangles repeat their last one."""
    corners = check.integers(np.asarray(members), path)
    if corners.ndim == 2 and corners.shape[1] == 3:
        return np.ascontiguousarray(np.column_stack([corners, corners[:, 2]]))
    return check.indices(corners, 4, path)


def half_turn(angle: float, name: str) -> float:
    """An angle from 0 to 180 degrees."""
    found = check.number(angle, name)
    if not 0.0 <= found <= 180.0:
        raise refuse(name, f"it must be from 0 to 180 degrees, but is {found:g}")
    return found


def listed(names: Mapping[str, Any]) -> str:
    """End of a message: the names that exist."""
    known = ", ".join(f"`{name}`" for name in sorted(names))
    return f"; it has {known}" if known else "; it has none"


class Grading:
    """Lengths of the intervals along an edge of a generated mesh."""

    def __init__(self, word: str, numbers: list[float]) -> None:
        """Use :meth:`one_sided`, :meth:`symmetric` or :meth:`lengths`, which set the word and the
        numbers."""
        self._intervals = (word, numbers)

    @classmethod
    def one_sided(cls, ratio: float) -> Grading:
        """A geometric sequence; ratio: last length over the first (no unit)."""
        return cls("one-sided", [check.positive(ratio, "ratio")])

    @classmethod
    def symmetric(cls, ratio: float) -> Grading:
        """A geometric sequence from both ends; ratio: length in the middle over that at the
        ends (no unit)."""
        return cls("symmetric", [check.positive(ratio, "ratio")])

    @classmethod
    def lengths(cls, lengths: Sequence[float]) -> Grading:
        """Chosen lengths, one a division, up to a common factor (any unit)."""
        return cls("lengths", [check.positive(one, "lengths") for one in lengths])


def _intervals(grading: Optional[Mapping[str, Grading]], axes: str) -> list[Any]:
    found = dict(grading or {})
    chosen = [found.pop(axis, None) for axis in axes.split()]
    if found:
        raise refuse("grading", f"the keys are {axes.split()}, but there is {list(found)}")
    return [None if one is None else check.kind(one, Grading, "grading")._intervals for one in chosen]


def block(
    size: Vector = (1.0, 1.0, 1.0),
    divisions: Union[Sequence[int], Ints] = (1, 1, 1),
    *,
    origin: Vector = (0.0, 0.0, 0.0),
    grading: Optional[Mapping[str, Grading]] = None,
    rotation: Optional[tuple[Vector, float]] = None,
    about: Optional[Vector] = None,
    mesh_rotation: float = 0.0,
    bottom_slopes: Vector = (0.0, 0.0),
    top_slopes: Vector = (0.0, 0.0),
    irregularity: float = 0.0,
    seed: int = 0,
    cells: CellKind = "hexahedron",
) -> Mesh:
    """A block with the sets ``xmin``, ``xmax``, ``ymin``, ``ymax``, ``zmin``, ``zmax`` of nodes
    and facets, named before rotation.

    size: lengths of the edges (length).
    divisions: elements along the edges.
    origin: corner of smallest coordinates, before rotation (length).
    grading: intervals along ``x``, ``y``, ``z``; equal by default.
    rotation: axis and angle (degrees) by which the whole block is rotated.
    about: fixed point of the rotation (length); the centre by default.
    mesh_rotation: angle by which the mesh is rotated about z inside the outline (degrees).
    bottom_slopes, top_slopes: slopes of the lower and upper side along x and y (no unit).
    irregularity: random displacement of inner nodes over the interval, below 0.5.
    seed: of the random displacement.
    cells: kind of the cells into which each division is divided.
    """
    turn = None
    if rotation is not None:
        axis, degrees = rotation
        stays = None if about is None else check.vector(about, "about")
        turn = (check.vector(axis, "rotation"), check.number(degrees, "rotation"), stays)
    return Mesh._of(
        native.block(
            check.vector(origin, "origin"),
            check.vector(size, "size"),
            check.counts(divisions, "divisions"),
            _intervals(grading, "x y z"),
            turn,
            check.number(mesh_rotation, "mesh_rotation"),
            check.vector(bottom_slopes, "bottom_slopes", 2),
            check.vector(top_slopes, "top_slopes", 2),
            check.number(irregularity, "irregularity"),
            check.whole(seed, "seed", 0),
            check.word(cells, tuple(KINDS), "cells"),
        )
    )


def capped_block(
    *,
    apex: Vector = (0.0, 0.0, 0.0),
    size: Vector = (10.0, 10.0),
    height: float = 6.5,
    radius: float = 12.0,
    element_size: float = 0.8,
    fine_half_width: float = 1.6,
    fine_depth: float = 0.0,
    growth: float = 1.3,
    half: bool = False,
    cells: CellKind = "hexahedron",
) -> Mesh:
    """A block whose lower side is a spherical cap, with the sets ``xmin``, ``xmax``, ``ymin``,
    ``ymax``, ``cap``, ``zmax``.

    apex: lowest point (length).
    size: edges of the plan along x and y (length).
    height: from the apex to the upper side (length).
    radius: of the sphere (length).
    element_size: at the apex (length).
    fine_half_width: half edge of the square with elements of this size (length).
    fine_depth: depth to which they have this height (length).
    growth: largest ratio of neighbouring sizes outside (no unit).
    half: if true, only y >= 0 from the apex is meshed; ``ymin`` is then the plane of symmetry.
    cells: kind of the cells into which its hexahedra are divided.
    """
    lengths = [height, radius, element_size, fine_half_width, fine_depth, growth]
    names = ["height", "radius", "element_size", "fine_half_width", "fine_depth", "growth"]
    place, plan = check.vector(apex, "apex"), check.vector(size, "size", 2)
    deep, round_, fine, wide, depth, more = [
        check.number(value, name) for value, name in zip(lengths, names)
    ]
    kind = check.word(cells, tuple(KINDS), "cells")
    return Mesh._of(
        native.capped_block(place, plan, deep, round_, fine, wide, depth, more, half, kind)
    )


def half_cylinder(
    *,
    apex: Vector = (0.0, 0.0, 0.0),
    upper: bool = False,
    radius: float = 8.0,
    thickness: float = 1.0,
    layers: int = 1,
    element_size: float = 0.2,
    fine_half_width: float = 1.0,
    fine_depth: float = 0.0,
    growth: float = 1.2,
) -> Mesh:
    """A slice of half a cylinder along y with the sets ``arc``, ``flat``, ``ymin``, ``ymax``.

    apex: contact point, lowest of the lower half, highest of the upper one (length).
    upper: if true, it is the upper half, with the arc upwards.
    radius: of the cylinder (length).
    thickness: extent along y (length).
    layers: elements along y.
    element_size: at the contact point (length).
    fine_half_width: arc to either side with elements of this size (length).
    fine_depth: depth to which they have this height (length).
    growth: largest ratio of neighbouring sizes outside (no unit).
    """
    return Mesh._of(
        native.half_cylinder(
            check.vector(apex, "apex"),
            upper,
            check.number(radius, "radius"),
            check.number(thickness, "thickness"),
            check.whole(layers, "layers"),
            check.number(element_size, "element_size"),
            check.number(fine_half_width, "fine_half_width"),
            check.number(fine_depth, "fine_depth"),
            check.number(growth, "growth"),
        )
    )


def annulus(
    *,
    centre: Vector = (0.0, 0.0, 0.0),
    axis: Vector = (0.0, 1.0, 0.0),
    inner_radius: float = 0.2,
    outer_radius: float = 0.5,
    width: float = 0.4,
    divisions: Union[Sequence[int], Ints] = (3, 48, 4),
    grading: Optional[Mapping[str, Grading]] = None,
    refinement: Optional[tuple[float, float]] = None,
) -> Mesh:
    """A ring, such as a tyre, with the sets ``rim``, ``tread``, ``ymin``, ``ymax``, ``sides``.

    centre: centre of the ring (length).
    axis: of the ring, of any length.
    inner_radius, outer_radius: radii (length).
    width: extent along the axis (length).
    divisions: elements along radius, circumference and axis.
    grading: intervals along ``radial`` and ``axial``; equal by default.
    refinement: angle to either side of the lowest point with the smallest elements (degrees),
        and size at the highest point over that at the lowest (no unit).
    """
    fine = None
    if refinement is not None:
        half_angle, ratio = refinement
        fine = (check.number(half_angle, "refinement"), check.number(ratio, "refinement"))
    return Mesh._of(
        native.annulus(
            check.vector(centre, "centre"),
            check.vector(axis, "axis"),
            check.number(inner_radius, "inner_radius"),
            check.number(outer_radius, "outer_radius"),
            check.number(width, "width"),
            check.counts(divisions, "divisions"),
            _intervals(grading, "radial axial"),
            fine,
        )
    )


def cylinder(
    *,
    base: Vector = (0.0, 0.0, 0.0),
    axis: Vector = (0.0, 0.0, 1.0),
    radius: float = 1.0,
    height: float = 1.0,
    divisions: Union[Sequence[int], Ints] = (2, 2, 4),
    grading: Optional[Mapping[str, Grading]] = None,
    quarter: bool = False,
) -> Mesh:
    """A solid cylinder with the sets ``side``, ``zmin``, ``zmax``, named before rotation.

    base: centre of the side ``zmin`` (length).
    axis: from there, of any length.
    radius: radius (length).
    height: extent along the axis (length).
    divisions: elements along half an edge of the square core, from the core to the side, and
        along the axis; a quarter turn has twice the first number.
    grading: intervals along ``axial``; equal by default.
    quarter: if true, only x >= 0 and y >= 0 is meshed; ``xmin`` and ``ymin`` are then its planes of
        symmetry.
    """
    return Mesh._of(
        native.cylinder(
            check.vector(base, "base"),
            check.vector(axis, "axis"),
            check.number(radius, "radius"),
            check.number(height, "height"),
            check.counts(divisions, "divisions"),
            _intervals(grading, "axial"),
            quarter,
        )
    )


def torus(
    *,
    centre: Vector = (0.0, 0.0, 0.0),
    axis: Vector = (0.0, 0.0, 1.0),
    ring_radius: float = 4.0,
    section_radius: float = 1.0,
    divisions: Union[Sequence[int], Ints] = (2, 2, 24),
) -> Mesh:
    """A ring of round section, such as an O-ring, with the set ``surface``.

    centre: centre of the ring (length).
    axis: of the ring, of any length.
    ring_radius: of the circle on which the centres of the sections lie (length).
    section_radius: of the section (length).
    divisions: elements along half an edge of the square core of the section, from the core
        to the surface, and around the axis; the section has eight times the first number
        around.
    """
    return Mesh._of(
        native.torus(
            check.vector(centre, "centre"),
            check.vector(axis, "axis"),
            check.number(ring_radius, "ring_radius"),
            check.number(section_radius, "section_radius"),
            check.counts(divisions, "divisions"),
        )
    )


def read_mesh(path: Union[str, os.PathLike[str]], *, elements: Optional[str] = None) -> Mesh:
    """Reads the mesh of a Gmsh, Abaqus or VTK file with its sets.

    path: the file.
    elements: the part that is read, an element set, a physical volume of Gmsh or an instance of
        Abaqus, with the members of all sets that it contains; the whole file by default.
    """
    if elements is not None and not isinstance(elements, str):
        raise TypeError(f"elements: a name is needed, not {type(elements).__name__}")
    return Mesh._of(native.read_mesh(os.fspath(path), elements))
