"""Meshes of other programs."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
import striae as st

meshio: Any = pytest.importorskip("meshio")

#: Edges of a hexahedron with a node in the middle of each.
EDGES = np.array(
    [[0, 1], [1, 2], [2, 3], [3, 0], [4, 5], [5, 6], [6, 7], [7, 4], [0, 4], [1, 5], [2, 6], [3, 7]]
)
#: Faces of a tetrahedron with midside nodes.
FACES = np.array([[0, 1, 2, 4, 5, 6], [0, 1, 3, 4, 8, 7], [1, 2, 3, 5, 9, 8], [0, 2, 3, 6, 9, 7]])


def rows_of(facets: Any) -> list[tuple[int, ...]]:
    return sorted(tuple(sorted(set(row))) for row in np.asarray(facets).tolist())


def test_cells_that_cannot_be_taken_are_named(tmp_path: Path) -> None:
    two = st.block((2, 1, 1), (2, 1, 1))
    first, second = two.cells["hexahedron"]
    points = np.vstack([two.points, two.points[second[EDGES]].mean(axis=1)])
    more = np.concatenate([second, len(two.points) + np.arange(12)])
    blocks = [("line", [[0, 1]]), ("hexahedron", [first]), ("hexahedron20", [more])]
    mixed = meshio.Mesh(points, blocks)
    with pytest.raises(st.ModelError, match="cells of the kinds `hexahedron20`, .*`striae.read_mesh`"):
        st.Mesh.of(mixed)
    with pytest.raises(st.ModelError, match="`hexahedron20`"):
        st.Mesh.of(meshio.Mesh(points, blocks[2:]))
    with pytest.raises(st.ModelError, match=r"are needed; its cells are \['line'\]"):
        st.Mesh.of(meshio.Mesh(points, blocks[:1]))
    assert st.Mesh.of(meshio.Mesh(points, blocks[:2])).volume == pytest.approx(1.0)
    mixed.write(tmp_path / "mixed.vtu")
    assert st.read_mesh(tmp_path / "mixed.vtu").volume == pytest.approx(2.0)


def test_cells_of_pyvista_that_cannot_be_taken_are_named() -> None:
    class Grid:
        points = st.block().points
        cells_dict = {12: st.block().cells["hexahedron"], 11: [range(8)], 9: [[0, 1, 2, 3]]}

    with pytest.raises(st.ModelError, match="cells of the kinds `11`"):
        st.Mesh.of(Grid())
    del Grid.cells_dict[11]
    assert st.Mesh.of(Grid()).volume == pytest.approx(1.0)


def test_all_blocks_belong_to_a_physical_group(tmp_path: Path) -> None:
    mesh = st.block((1, 1, 1), (2, 1, 1), cells="wedges")
    wedges, boundary = mesh.cells["wedge"], mesh.boundary
    three = boundary[:, 2] == boundary[:, 3]
    blocks = [
        ("wedge", wedges[:1]),
        ("triangle", boundary[three][:3, :3]),
        ("triangle", boundary[three][3:, :3]),
        ("wedge", wedges[1:]),
        ("quad", boundary[~three]),
    ]
    tags = [np.full(len(rows), 7) for _, rows in blocks]
    data = {"gmsh:physical": tags, "gmsh:geometrical": tags}
    # Numbers of groups of different dimensions are independent.
    groups = {"skin": np.array([7, 2]), "core": np.array([7, 3])}
    theirs = meshio.Mesh(mesh.points, blocks, cell_data=data, field_data=groups)
    theirs.write(tmp_path / "a.msh", file_format="gmsh22", binary=False)
    for ours in (st.Mesh.of(theirs), st.read_mesh(tmp_path / "a.msh")):
        assert rows_of(ours.facet_sets["skin"]) == rows_of(boundary)
        assert ours.element_sets["core"].tolist() == list(range(len(wedges)))
        assert set(ours.facet_sets) == {"all", "skin"} and set(ours.element_sets) == {"all", "core"}


def test_cell_sets_of_cells_with_a_volume_are_element_sets() -> None:
    cube = st.block()
    points = np.vstack([cube.points, [[0.5, 0.5, 2.0], [0.5, 0.5, -1.0]]])
    below, above = [0, 2, 3, 1, 9], [4, 5, 7, 6, 8]
    theirs = meshio.Mesh(
        points,
        [("pyramid", [above]), ("hexahedron", cube.cells["hexahedron"]), ("pyramid", [below])],
        cell_sets={"ends": [[0], [], [0]], "low": [None, [0], [0]], "none": [[], [], []]},
    )
    mesh = st.Mesh.of(theirs)
    heights = {name: mesh.middles[members, 2] for name, members in mesh.element_sets.items()}
    assert set(heights) == {"all", "ends", "low"}
    assert sorted(heights["ends"]) == pytest.approx([-0.2, 1.2])
    assert sorted(heights["low"]) == pytest.approx([-0.2, 0.5])
    theirs.cell_sets = {"low": [None, [0, 1], None]}
    with pytest.raises(st.ModelError, match="cell set `low`: refers to cell 1, but there are 1, from 0"):
        st.Mesh.of(theirs)


def test_facets_with_midside_nodes_are_divided_like_their_cells() -> None:
    mesh = st.block(cells="composite-tetrahedra")
    cells = mesh.cells["tetra10"]
    faces = cells[:, FACES].reshape(-1, 6)
    low = faces[np.isclose(mesh.points[faces, 2], 0.0).all(axis=1)]
    sets = {"low": [None, np.arange(len(low))]}
    theirs = meshio.Mesh(mesh.points, [("tetra10", cells), ("triangle6", low)], cell_sets=sets)
    ours = st.Mesh.of(theirs)
    assert rows_of(ours.facet_sets["low"]) == rows_of(mesh.facet_sets["zmin"])
    assert len(ours.node_sets["low"]) == 9


def test_facets_of_other_cells_are_refused() -> None:
    cube = st.block()
    points = np.vstack([cube.points, [[5.0, 0.0, 0.0]]])
    blocks = [("hexahedron", cube.cells["hexahedron"]), ("triangle", [[0, 1, 8]])]
    theirs = meshio.Mesh(points, blocks, cell_sets={"shell": [[], [0]]})
    with pytest.raises(st.ModelError, match="facet set `shell`: its facets have nodes that no cell"):
        st.Mesh.of(theirs)


def test_point_sets_refer_to_nodes_that_there_are() -> None:
    cube = st.block()

    def taken(members: Any) -> Any:
        sets = {"some": members}
        theirs = meshio.Mesh(cube.points, [("hexahedron", cube.cells["hexahedron"])], point_sets=sets)
        return st.Mesh.of(theirs).node_sets["some"].tolist()

    assert taken([]) == [] and taken([7, 1]) == [1, 7]
    with pytest.raises(st.ModelError, match="node set `some`: numbers count from 0, but there is -1"):
        taken([-1])
    with pytest.raises(st.ModelError, match="node set `some`: refers to node 8, but there are 8"):
        taken([8])


def test_element_sets_count_as_the_elements_are_given() -> None:
    cube = st.block()
    points = np.vstack([cube.points, [[0.5, 0.5, 2.0]]])
    cells: dict[str, Any] = {"pyramid": [[4, 5, 7, 6, 8]], "hexahedron": cube.cells["hexahedron"]}
    sets: dict[str, Any] = {"roof": [0], "room": [False, True], "high": lambda x: x[:, 2] > 1.0}
    mesh = st.Mesh(points, cells, element_sets=sets)
    heights = {name: mesh.middles[members, 2].tolist() for name, members in mesh.element_sets.items()}
    assert heights["roof"] == heights["high"] == [1.2] and heights["room"] == [0.5]
    with pytest.raises(st.ModelError, match="element set `far`: refers to element 2, but there are 2"):
        st.Mesh(points, cells, element_sets={"far": [2]})
