"""Meshes of bodies: cells with named sets of nodes, facets and elements."""

from __future__ import annotations

import math
import os
from collections.abc import Mapping
from typing import Any, Optional, Union

import numpy as np
import numpy.typing as npt

from . import _check as check
from . import _striae as native
from ._check import Floats, Ints, Members, Values, Vector
from ._errors import refuse
from ._made import Strict

#: Kinds of cells, by their names in meshio, and their corners.
KINDS = {"hexahedron": 8, "wedge": 6, "pyramid": 5, "tetra": 4, "tetra10": 10}


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
        element_sets: members of named sets of elements, see :meth:`with_sets`; numbers and masks
            are in the order in which the elements are given here, kind by kind.
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
        numbers = numbers_by_kind(corners)
        elements = {
            name: members
            if callable(members)
            else numbers[known(members, made.middles, "element", f"element set `{name}`")]
            for name, members in check.named(element_sets, "element_sets")
        }
        self._native = made.with_sets(nodes=node_sets, facets=facet_sets, elements=elements)._native
        self._arrays: dict[str, npt.NDArray[Any]] = {}

    @classmethod
    def _of(cls, found: native.Mesh) -> Mesh:
        mesh = object.__new__(cls)
        mesh._native = found
        mesh._arrays = {}
        return mesh

    @classmethod
    def _generated(cls, generator: str, values: Values) -> Mesh:
        """Makes the mesh of a declared generator from values that are present."""
        given = [(name, value) for name, value in values.items() if value is not None]
        return cls._of(native.generated(generator, given))

    @classmethod
    def of(cls, source: Any) -> Mesh:
        """The mesh of an object that has one.

        source: a mesh; a path to a Gmsh (``.msh``), Abaqus (``.inp``) or VTK (``.vtu``,
            ``.vtk``) file; an object of
            meshio (``points``, ``cells_dict``), whose cell sets and named physical groups
            become facet and node sets where they are of triangles and quadrilaterals, and element
            sets where they are of cells with a volume, and its point sets node sets; or
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
        for name, members in check.named(nodes, "node_sets"):
            path = f"node set `{name}`"
            found = found.with_node_set(name, chosen(members, self.points, path))
        for name, members in check.named(facets, "facet_sets"):
            path = f"facet set `{name}`"
            if not callable(members) and np.ndim(np.asarray(members)) == 2:
                found = found.with_facet_set(name, corners_of_facets(members, path))
            else:
                found = found.with_facets_of(name, chosen(members, self.points, path))
        for name, members in check.named(elements, "element_sets"):
            path = f"element set `{name}`"
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


def known(members: Members, places: Floats, part: str, path: str) -> Ints:
    """Numbers of the parts selected by members, all of which there are."""
    numbers = chosen(members, places, path)
    if numbers.size and int(numbers.max()) >= len(places):
        text = f"refers to {part} {numbers.max()}, but there are {len(places)}, from 0"
        raise refuse(path, text)
    return numbers


def numbers_by_kind(given: list[tuple[str, Ints]]) -> Ints:
    """Numbers, in the order of :attr:`Mesh.cells`, of elements that are given kind by kind."""
    places = np.repeat([list(KINDS).index(kind) for kind, _ in given], [len(rows) for _, rows in given])
    return np.argsort(np.argsort(places, kind="stable"))


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


def read_mesh(path: Union[str, os.PathLike[str]], *, elements: Optional[str] = None) -> Mesh:
    """Reads the mesh of a Gmsh, Abaqus or VTK file with its sets.

    path: the file.
    elements: the part that is read, an element set, a physical volume of Gmsh or an instance of
        Abaqus, with the members of all sets that it contains; the whole file by default.
    """
    if elements is not None and not isinstance(elements, str):
        raise TypeError(f"elements: a name is needed, not {type(elements).__name__}")
    return Mesh._of(native.read_mesh(check.file(path, "path"), elements))
