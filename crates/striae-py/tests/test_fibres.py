"""Fibres in solids."""

from __future__ import annotations

import numpy as np
import pytest
import striae as st


def test_fibres_stiffen_along_their_direction() -> None:
    """Uniaxial strain: the ground's stress and ``M/2 l (l^2 - 1)`` of the fibres."""
    ground = st.NeoHookean(1.0, 0.3)
    fibrous = st.Fibrous(ground, [st.LinearFibres(2.0, (0, 0, 3))])
    for axis in range(3):
        gradient = np.eye(3)
        gradient[axis, axis] = 1.4
        more = fibrous.stress(gradient) - ground.stress(gradient)
        expected = np.zeros((3, 3))
        if axis == 2:
            expected[2, 2] = 0.5 * 2.0 * 1.4 * (1.4**2 - 1)
        assert np.allclose(more, expected, atol=1e-14)


def test_a_tube_has_its_fibres_about_the_axis() -> None:
    """Fibres around the axis leave a tube that is stretched along it alone, axial ones do not."""
    ground = st.IsochoricNeoHookean(1.0, poissons_ratio=0.3)
    mesh = st.annulus(axis=(0, 0, 1), divisions=(1, 12, 2))
    force = {}
    for name, direction in {
        "none": None,
        "around": st.Circumferential((0, 0, 1)),
        "along": st.Axial((0, 0, 1)),
        "turned": st.Circumferential((0, 0, 1), turn=90),
    }.items():
        material: st.Material = ground
        if direction is not None:
            fibres = st.ExponentialFibres(5.0, 1.0, direction)
            material = st.Fibrous(ground, [fibres])
        body = st.Body("tube", mesh, material)
        ends = mesh.points[:, 2]
        body.add_set("low", ends < ends.min() + 1e-9)
        body.add_set("high", ends > ends.max() - 1e-9)
        model = st.Model([body])
        pull = body["high"].displace(x=0, y=0, z=0.1)
        model.step("pull", body["low"].hold(), pull, increments=2)
        run = st.Model.from_text(model.to_deck()).run()
        force[name] = float(run[-1].reaction("tube", "high")[2])
    assert force["along"] == pytest.approx(force["turned"], rel=1e-9)
    assert force["along"] > 2 * force["none"]
    assert force["around"] < 1.2 * force["none"]


def test_fibres_that_cannot_be_are_refused() -> None:
    ground = st.NeoHookean(1.0, 0.3)
    with pytest.raises(st.ModelError, match="dispersion.*from 0 to 1/3"):
        st.Fibrous(ground, [st.ExponentialFibres(1.0, 1.0, (1, 0, 0), dispersion=0.5)])
    with pytest.raises(st.ModelError, match="only lines along or around an axis can be rotated"):
        st.Fibrous(ground, [st.LinearFibres(1.0, st.Uniform((1, 0, 0), turn=30))])
    with pytest.raises(st.ModelError, match="at least one"):
        st.Fibrous(ground, [])
    with pytest.raises(st.ModelError, match="not a solid that is linear elastic"):
        st.Fibrous(st.LinearElastic(1.0, 0.3), [st.LinearFibres(1.0, (1, 0, 0))])  # type: ignore[arg-type]
    with pytest.raises(st.ModelError, match="Uniform, Circumferential"):
        st.LinearFibres(1.0, st.Nodal(np.ones((3, 3))))
