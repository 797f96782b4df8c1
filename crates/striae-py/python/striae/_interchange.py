"""Conversion of meshes of meshio and pyvista, and of results to grids of pyvista and datasets of
xarray."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np

from . import _check as check
from ._check import Ints
from ._errors import refuse
from ._mesh import KINDS, Mesh, known

if TYPE_CHECKING:
    from xarray import Dataset

    from ._results import Increment
    from ._run import Run

#: Numbers of the kinds among VTK's cells.
VTK = {"hexahedron": 12, "wedge": 13, "pyramid": 14, "tetra": 10, "tetra10": 24}

#: Cells without a volume: beginnings of meshio's names, and VTK's numbers.
FLAT = ("vertex", "line", "triangle", "quad", "polygon")
FLAT_OF_VTK = {*range(10), 21, 22, 23, 28, 30, 34, 35, 36}

#: Corners of the facets that facets of meshio consist of; triangles repeat their last one.
FACETS = {
    "triangle": [[0, 1, 2, 2]],
    "quad": [[0, 1, 2, 3]],
    # Facets of a tetra10 end at its midside nodes.
    "triangle6": [[0, 3, 5, 5], [3, 1, 4, 4], [5, 4, 2, 2], [3, 4, 5, 5]],
    "quad8": [[0, 1, 2, 3]],
    "quad9": [[0, 1, 2, 3]],
}

#: Members of named sets of cells, by the numbers of their blocks.
Members: TypeAlias = dict[str, dict[int, Ints]]


def from_cells(source: Any) -> Mesh:
    """The mesh of an object with ``points`` and ``cells_dict``."""
    corners = _corners(dict(source.cells_dict))
    points = check.rows(source.points, "points")
    used = np.unique(np.concatenate([rows.ravel() for rows in corners.values()]))
    if used.size and int(used[-1]) >= len(points):
        raise refuse("cells", f"they refer to node {used[-1]}, but there are {len(points)} points")
    new = np.full(len(points), -1, dtype=np.int64)
    new[used] = np.arange(len(used))
    blocks = getattr(source, "cells", None)
    blocks = blocks if isinstance(blocks, list) else []
    sets = _sets(source, blocks)
    mesh = Mesh(
        points[used],
        {kind: new[rows] for kind, rows in corners.items()},
        element_sets=_joined(sets, _elements(blocks, corners)),
    )
    facets = {}
    for name, rows in _joined(sets, _facets(blocks)).items():
        if not np.isin(rows, used).all():
            text = "its facets have nodes that no cell with a volume has; facets must be of such cells"
            raise refuse(f"facet set `{name}`", text)
        facets[name] = new[rows]
    nodes = {name: np.unique(rows) for name, rows in facets.items()}
    for name, members in _node_sets(source).items():
        kept = new[known(members, points, "node", f"node set `{name}`")]
        nodes[name] = kept[kept >= 0]
    masks = _masks(source)
    nodes.update({name: np.flatnonzero(mask[used]) for name, mask in masks.items()})
    both = {name: nodes[name] for name in masks}
    return mesh.with_sets(nodes=nodes, facets={**both, **facets})


def _corners(cells: dict[Any, Any]) -> dict[str, Ints]:
    """Corners of the cells with a volume, by kind."""
    names = {number: kind for kind, number in VTK.items()}
    solid = {
        names.get(kind, kind): rows
        for kind, rows in cells.items()
        if len(rows) and not (kind in FLAT_OF_VTK or str(kind).startswith(FLAT))
    }
    needed = ", ".join(KINDS)
    if not solid:
        found = sorted(map(str, cells)) or "none"
        raise refuse("mesh", f"cells of the kinds {needed} are needed; its cells are {found}")
    other = [f"`{kind}`" for kind in solid if kind not in KINDS]
    if other:
        raise refuse(
            "mesh",
            f"it has cells of the kinds {', '.join(other)}, but {needed} are needed; write it to a"
            " file, and take that by `striae.read_mesh`, which divides cells of second order",
        )
    return {kind: check.indices(solid[kind], KINDS[kind], "cells") for kind in KINDS if kind in solid}


def _sets(source: Any, blocks: list[Any]) -> Members:
    """Cell sets of meshio, and physical groups of Gmsh."""
    found: Members = {}
    physical = getattr(source, "cell_data", {}).get("gmsh:physical", []) if blocks else []
    tags = [np.asarray(numbers) for numbers in physical]
    for name, (number, dimension) in source.field_data.items() if tags else []:
        found[name] = {
            at: np.flatnonzero(tags[at] == number)
            for at, block in enumerate(blocks)
            if dimension == (2 if block.type in FACETS else 3)
        }
    for name, members in getattr(source, "cell_sets", {}).items() if blocks else []:
        if not name.startswith("gmsh:"):
            found[name] = {
                at: known(members[at], block.data, "cell", f"cell set `{name}`")
                for at, block in enumerate(blocks)
                if members[at] is not None
            }
    return found


def _elements(blocks: list[Any], corners: dict[str, Ints]) -> dict[int, Ints]:
    """Numbers of the elements by the numbers of their blocks."""
    sizes = [len(rows) for rows in corners.values()]
    following = dict(zip(corners, np.cumsum([0, *sizes]).tolist()))
    found: dict[int, Ints] = {}
    for at, block in enumerate(blocks):
        if block.type in following:
            first = following[block.type]
            following[block.type] += len(block.data)
            found[at] = np.arange(first, following[block.type])
    return found


def _facets(blocks: list[Any]) -> dict[int, Ints]:
    """Corners of the facets of each cell, by the numbers of the blocks."""
    return {
        at: check.integers(block.data, "cells")[:, FACETS[block.type]]
        for at, block in enumerate(blocks)
        if block.type in FACETS
    }


def _joined(sets: Members, cells: dict[int, Ints]) -> dict[str, Ints]:
    """Members of the sets, as the blocks have them by cell, without sets that have none."""
    found = {}
    for name, members in sets.items():
        parts = [cells[at][rows] for at, rows in members.items() if at in cells and len(rows)]
        if parts:
            width = parts[0].shape[2:]
            found[name] = np.concatenate([part.reshape(-1, *width) for part in parts])
    return found


def _node_sets(source: Any) -> dict[str, Any]:
    return dict(getattr(source, "point_sets", None) or {})


def _masks(source: Any) -> dict[str, Any]:
    """Boolean point data."""
    fields = getattr(source, "point_data", None) or {}
    arrays = {name: np.asarray(fields[name]) for name in list(fields.keys())}
    return {name: array for name, array in arrays.items() if array.dtype == np.bool_}


def grid(increment: Increment, body: str) -> Any:
    """The deformed body with its fields as an unstructured grid of pyvista."""
    import pyvista  # type: ignore[import-not-found, unused-ignore]

    fields = increment.body(body)
    cells = increment._mesh(body).cells
    by_number = {VTK[kind]: rows for kind, rows in cells.items()}
    made = pyvista.UnstructuredGrid(by_number, np.array(fields.position))
    for name in ["displacement", "velocity", "contact_force", "von_mises"]:
        made.point_data[name] = np.array(getattr(fields, name))
    made.point_data["stress"] = fields.stress.reshape(-1, 9)
    return made


def patch(increment: Increment, pair: int, side: str) -> Any:
    """The contact surface of a side with its fields as a surface of pyvista."""
    import pyvista  # type: ignore[import-not-found, unused-ignore]

    known = getattr(increment.pair(pair), side)
    corners = known.facets
    faces = np.hstack([np.full((len(corners), 1), 4), corners]).ravel()
    made = pyvista.PolyData(np.array(known.position), faces)
    for name in ["gap", "pressure", "friction", "traction", "slip", "status"]:
        made.point_data[name] = np.array(getattr(known, name))
    return made


#: Fields of a dataset, with the names of their axes beyond nodes.
OF_BODIES: dict[str, tuple[str, ...]] = {
    "displacement": ("axis",),
    "contact_force": ("axis",),
    "stress": ("axis", "along"),
    "von_mises": (),
}
OF_SIDES: dict[str, tuple[str, ...]] = {
    "pressure": (),
    "gap": (),
    "friction": ("axis",),
    "slip": ("axis",),
    "status": (),
}


def dataset(run: Run) -> Dataset:
    """The history and the fields of kept increments."""
    try:
        import xarray
    except ImportError as error:
        text = "to_xarray needs xarray, which `pip install striae[xarray]` installs"
        raise ImportError(text) from error
    history = run.history
    found: dict[str, Any] = {
        name: ("increment", np.array(history[name])) for name in history if name != "increment"
    }
    # These names are those of the coordinates of kept increments.
    found.update({f"history.{name}": found.pop(name) for name in ("time", "step") if name in found})
    for name in run.model.body_names:
        parts = [increment.body(name) for increment in run]
        found.update(_over_states(name, parts, OF_BODIES))
    for index, name in enumerate(run.model.pair_names):
        for side in ("a", "b"):
            if all(one._results.side_body(index, side == "b") is not None for one in run):
                sides = [getattr(increment.pair(index), side) for increment in run]
                found.update(_over_states(f"{name}.{side}", sides, OF_SIDES))
                if sides:
                    node = f"{name}.{side}.node"
                    found[node] = (node, np.array(sides[0].nodes))
    axes = ["x", "y", "z"]
    coordinates = {
        "increment": np.array(history.get("increment", []), dtype=np.int64),
        "state": np.array([one.number for one in run], dtype=np.int64),
        "time": ("state", np.array([one.time for one in run])),
        "step": ("state", np.array([one.step for one in run], dtype=object)),
        "axis": axes,
        "along": axes,
    }
    return xarray.Dataset(found, coordinates, {"title": run.model.title, "ending": run.ending})


def _over_states(
    name: str, parts: list[Any], fields: dict[str, tuple[str, ...]]
) -> dict[str, Any]:
    """Fields of a part over the kept increments."""
    return {
        f"{name}.{field}": (
            ("state", f"{name}.node", *axes),
            np.stack([getattr(part, field) for part in parts]),
        )
        for field, axes in fields.items()
        if parts
    }
