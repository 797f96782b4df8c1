"""Contact of elements of scikit-fem beside striae's own runs, where friction is not determined in
all directions: planes of symmetry, corners, and nodes that are driven."""

from __future__ import annotations

import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import striae as st
from scipy.sparse import csr_array
from skfem import Basis, ElementHex1, ElementVector, MeshHex
from skfem.models.elasticity import lame_parameters, linear_elasticity

sys.path.insert(0, str(Path(__file__).parents[1] / "examples"))
from contact_newton import increment  # noqa: E402

E, NU, LAW = 1e6, 0.3, st.Coulomb(0.3)
BLOCK = st.block(size=(1, 0.5, 0.5), divisions=(4, 2, 2))
BELOW = st.block(origin=(-0.3, 0, -0.3), size=(1.7, 0.7, 0.3), divisions=(7, 3, 1))
TOP = BLOCK.node_sets["zmax"]


def elements(points: Any, cells: Any) -> Callable[[Any], tuple[Any, Any]]:
    mesh = MeshHex(points.T, cells.T[[0, 4, 3, 1, 7, 5, 2, 6]])
    basis = Basis(mesh, ElementVector(ElementHex1()), intorder=3)
    numbers = np.asarray(basis.nodal_dofs).T.ravel()
    assembled = linear_elasticity(*lame_parameters(E, NU)).assemble(basis)
    stiffness = csr_array(assembled)[numbers][:, numbers]
    return lambda x: ((stiffness @ (x - points).ravel()).reshape(-1, 3), stiffness)


def surface(mesh: st.Mesh, facets: str, first: int = 0) -> st.contact.Surface:
    return st.contact.Surface(mesh.facet_sets[facets] + first, youngs_modulus=E)


def forces_of(points: Any, cells: Any, pairs: Any, held: Any, ends: Any) -> Any:
    """Forces on the first sides in every increment."""
    contact = st.contact.Contact(points, pairs)
    state, forces, internal = contact.untouched(), [], elements(points, cells)
    for end in ends:
        state, found = increment(contact, state, internal, held, end)
        forces.append([found.pair(at).force for at in range(len(pairs))])
    return np.array(forces)


def body(name: str, mesh: st.Mesh) -> st.Body:
    return st.Body(name, mesh, st.LinearElastic(E, NU), formulation="standard")


def own_forces(model: st.Model, steps: list[list[st.Condition]]) -> Any:
    """Forces on the first sides in every increment of a run of striae."""
    for number, conditions in enumerate(steps):
        model.step(f"step {number}", *conditions, increments=1)
    return np.array([[pair.force for pair in one.pairs] for one in model.run()])


def assert_equal(found: Any, own: Any) -> None:
    largest = np.abs(own).max()
    assert np.abs(own[-1, 0, 0]) > 0.1 * largest
    np.testing.assert_allclose(found, own, atol=1e-9 * largest, rtol=0)


def test_half_of_two_blocks_in_a_plane_of_symmetry() -> None:
    first, shifts = len(BLOCK.points), [(0, 0, -0.01), (0.004, 0, -0.01), (0.03, 0, -0.01)]
    points = np.vstack([BLOCK.points, BELOW.points])
    cells = np.vstack([BLOCK.cells["hexahedron"], BELOW.cells["hexahedron"] + first])
    held = np.zeros(points.shape, dtype=bool)
    held[points[:, 1] == 0, 1] = True
    held[TOP] = held[BELOW.node_sets["zmin"] + first] = True
    ends = [points + np.isin(np.arange(len(points)), TOP)[:, None] * shift for shift in shifts]
    pair = st.contact.Pair(surface(BLOCK, "zmin"), surface(BELOW, "zmax", first), LAW)

    block, below = body("block", BLOCK), body("below", BELOW)
    own = st.Pair(block["zmin"], below["zmax"], LAW)
    model = st.Model([block, below], [], [own], solver=st.Solver(tolerance=1e-12))
    steps: list[list[st.Condition]] = [
        [block["zmax"].displace(x=x, y=y, z=z)] for x, y, z in shifts
    ]
    steps[0] += [side.displace(y=0) for side in (block["ymin"], below["ymin"])]
    steps[0] += [below["zmin"].hold()]
    assert_equal(forces_of(points, cells, [pair], held, ends), own_forces(model, steps))


@pytest.mark.parametrize("drawn", [False, True], ids=["free", "drawn"])
def test_a_block_on_a_floor_and_a_wall(drawn: bool) -> None:
    """Nodes of the edge are in both pairs; in the second case those at one end are drawn."""
    shifts = [(0, -0.004, -0.01), (0.004, -0.004, -0.01), (0.03, -0.004, -0.01)]
    sides = [("zmin", st.Plane("floor")), ("ymin", st.Plane("wall", normal=(0, 1, 0)))]
    pairs = [
        st.contact.Pair(surface(BLOCK, name), plane, LAW, name=plane.name) for name, plane in sides
    ]
    held = np.zeros(BLOCK.points.shape, dtype=bool)
    held[TOP] = True
    if drawn:
        held[BLOCK.node_sets["xmax"], 0] = True
    ends = [BLOCK.points + shift for shift in shifts]
    found = forces_of(BLOCK.points, BLOCK.cells["hexahedron"], pairs, held, ends)

    block = body("block", BLOCK)
    own = [st.Pair(block[name], plane, LAW) for name, plane in sides]
    planes = [plane for _, plane in sides]
    model = st.Model([block], planes, own, solver=st.Solver(tolerance=1e-12))
    steps: list[list[st.Condition]] = []
    for x, y, z in shifts:
        end = [block["xmax"].displace(x=x)] if drawn else []
        steps.append([*end, block["zmax"].displace(x=x, y=y, z=z)])
    assert_equal(found, own_forces(model, steps))
