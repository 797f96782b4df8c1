"""Conversion of meshes of meshio and pyvista, and of results to grids of pyvista and datasets of
xarray."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from . import _check as check
from ._check import Ints
from ._errors import refuse
from ._mesh import KINDS, Mesh, corners_of_facets

if TYPE_CHECKING:
    from xarray import Dataset

    from ._results import Increment
    from ._run import Run

#: Numbers of the kinds among VTK's cells.
VTK = {"hexahedron": 12, "wedge": 13, "pyramid": 14, "tetra": 10, "tetra10": 24}


def from_cells(source: Any) -> Mesh:
    """The mesh of an object with ``points`` and ``cells_dict``."""
    cells = dict(source.cells_dict)
    known = {kind: cells.get(kind, cells.get(VTK[kind])) for kind in KINDS}
    corners = {
        kind: check.indices(rows, KINDS[kind], "cells")
        for kind, rows in known.items()
        if rows is not None
    }
    if not corners:
        kinds = ", ".join(KINDS)
        raise refuse("mesh", f"it has none of {kinds}; its cells are {sorted(map(str, cells))}")
    points = check.rows(source.points, "points")
    used = np.unique(np.concatenate([rows.ravel() for rows in corners.values()]))
    if used.size and int(used[-1]) >= len(points):
        raise refuse("cells", f"they refer to node {used[-1]}, but there are {len(points)} points")
    new = np.full(len(points), -1, dtype=np.int64)
    new[used] = np.arange(len(used))
    mesh = Mesh(points[used], {kind: new[rows] for kind, rows in corners.items()})
    facets = {name: new[quads] for name, quads in _quads(source).items()}
    facets = {name: quads for name, quads in facets.items() if len(quads)}
    nodes = {name: np.unique(quads) for name, quads in facets.items()}
    for name, members in _node_sets(source).items():
        kept = new[np.asarray(members)]
        nodes[name] = kept[kept >= 0]
    masks = _masks(source)
    nodes.update({name: np.flatnonzero(mask[used]) for name, mask in masks.items()})
    both = {name: nodes[name] for name in masks}
    return mesh.with_sets(nodes=nodes, facets={**both, **facets})


def _quads(source: Any) -> dict[str, Ints]:
    """Corners of named facets of meshio: cell sets and physical groups of Gmsh."""
    found: dict[str, list[Ints]] = {}
    blocks = getattr(source, "cells", None)
    if not isinstance(blocks, list):
        return {}
    flat = ("quad", "triangle", "triangle6")
    quads = [
        (at, corners_of_facets(block.data, "mesh"))
        for at, block in enumerate(blocks)
        if block.type in flat
    ]
    for name, members in getattr(source, "cell_sets", {}).items():
        for at, corners in quads:
            if not name.startswith("gmsh:") and members[at] is not None and len(members[at]):
                found.setdefault(name, []).append(corners[np.asarray(members[at], dtype=np.int64)])
    physical: Any = getattr(source, "cell_data", {}).get("gmsh:physical")
    for name, (number, dimension) in getattr(source, "field_data", {}).items():
        for at, corners in quads if physical is not None and dimension == 2 else []:
            chosen = corners[np.asarray(physical[at]) == number]
            if len(chosen) and name not in found:
                found.setdefault(name, []).append(chosen)
    return {name: np.concatenate(parts).astype(np.int64) for name, parts in found.items()}


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
