"""Displacements in axes of their own."""

from __future__ import annotations

import math

import numpy as np
import pytest
import striae as st


def test_nodes_slide_on_an_inclined_plane() -> None:
    """A block on an inclined rest is the same as one on a level rest, turned."""
    rubber = st.NeoHookean(youngs_modulus=1.0, poissons_ratio=0.3)
    mesh = st.block(size=(1, 1, 1), divisions=(2, 2, 2))
    sin, cos = math.sin(0.3), math.cos(0.3)
    turn = np.array([[cos, 0, sin], [0, 1, 0], [-sin, 0, cos]])
    ways = []
    for rotation in (np.eye(3), turn):
        turned = st.Mesh(mesh.points @ rotation.T, mesh.cells, node_sets=mesh.node_sets)
        body = st.Body("block", turned, rubber)
        model = st.Model([body])
        own = [rotation[:, 0], rotation[:, 1]]
        model.step(
            "press",
            body["zmin"].displace(x=0, axes=st.NormalAxis(3 * rotation[:, 2])),
            body["zmax"].displace(x=0.1, y=0, z=-0.1, axes=own),
            increments=2,
        )
        ways.append(model.run()[-1].body("block").displacement)
    assert np.allclose(ways[0] @ turn.T, ways[1], atol=1e-12)


def test_wrong_axes_are_refused() -> None:
    block = st.Body("block", st.block(), st.NeoHookean(youngs_modulus=1.0, poissons_ratio=0.3))
    with pytest.raises(st.ModelError, match="two vectors are needed, but there are 3"):
        block["zmin"].displace(x=0, axes=np.eye(3))
    with pytest.raises(st.ModelError, match="must not be the zero vector"):
        st.CylindricalAxes((0, 0, 0))
    with pytest.raises(st.ModelError, match="a text is needed"):
        block["zmin"].displace(x=lambda s: s, axes=st.NormalAxis((1, 0, 0)))
    assert repr(st.NormalAxis((1, 0, 0))) == "NormalAxis([1.0, 0.0, 0.0])"
