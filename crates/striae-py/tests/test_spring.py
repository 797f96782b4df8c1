"""Springs and dashpots."""

from __future__ import annotations

import copy

import numpy as np
import pytest
import striae as st


def block() -> st.Body:
    rubber = st.NeoHookean(youngs_modulus=1e3, poissons_ratio=0.3)
    mesh = st.block(divisions=(1, 1, 1)).with_sets(nodes={"corner": [7]})
    return st.Body("block", mesh, rubber)


def weight() -> st.Rigid:
    return st.Plane("weight", point=(3, 0.5, 0.5), normal=(-1, 0, 0), reference=(3, 0.5, 0.5))


def test_springs_in_series_share_their_force() -> None:
    body, rigid = block(), weight()
    near = st.Spring(body["xmax"], rigid, stiffness=2.0, name="near")
    far = st.Spring(rigid, (5, 0.5, 0.5), stiffness=3.0)
    model = st.Model([body], [rigid], springs=[near, far])
    held = body["xmin"].displace(x=0, y=0, z=0)
    model.step("pull", held, rigid.move(free=["x"], force=(0.1, 0, 0)), increments=2)
    assert model.spring_names == ["near", "weight-ground"]
    end = model.run()[-1]
    one, other = end.springs
    assert other.force[0] == pytest.approx(3.0 * other.elongation)
    assert other.tension == pytest.approx(3.0 * other.elongation)
    assert other.force[0] - one.force[0] == pytest.approx(-0.1)
    assert other.elongation == pytest.approx(-end.rigid("weight").displacement[0])
    again = st.Model.from_text(model.to_deck()).run()[-1]
    assert np.array_equal(again.body("block").position, end.body("block").position)
    assert copy.deepcopy(model).spring_names == model.spring_names


def test_a_bed_carries_the_load() -> None:
    body = block()
    bed = st.Spring(body["zmin"], direction=(0, 0, 1), stiffness=50.0, damping=0.1)
    model = st.Model([body], springs=[bed])
    held = body["zmin"].displace(x=0, y=0)
    model.step("press", held, body["zmax"].traction((0, 0, -2.0)), increments=2)
    assert model.run()[-1].spring(0).tension == pytest.approx(-2.0)


def test_wrong_springs_meet_words() -> None:
    body, rigid = block(), weight()
    with pytest.raises(st.ModelError, match="either an end `b` or a `direction`"):
        st.Spring(body["zmin"], stiffness=1.0)
    with pytest.raises(st.ModelError, match="only one of `free_length`"):
        st.Spring(rigid, (0, 0, 0), stiffness=1.0, free_length=1.0, preload=1.0)
    with pytest.raises(st.ModelError, match="only a rigid body has one"):
        st.Spring(body["zmin"], direction=(0, 0, 1), stiffness=1.0, point=(0, 0, 0))
    for b, direction in [((0, 0, 5), None), (None, (0, 0, 1))]:
        with pytest.raises(st.ModelError, match="point_b: only a rigid body `b` has one; state a point"):
            st.Spring(body["zmin"], b, direction=direction, stiffness=1.0, point_b=(0, 0, 9))
    with pytest.raises(TypeError, match="BodySet"):
        st.Spring("zmin", direction=(0, 0, 1))  # type: ignore[arg-type]
    with pytest.raises(st.ModelError, match="it has no force"):
        springs = [st.Spring(body["zmin"], direction=(0, 0, 1))]
        model = st.Model([body], springs=springs)
        model.step("rest", body["zmin"].displace(x=0, y=0, z=0))
        model.check()
    with pytest.raises(st.ModelError, match="no spring is named"):
        model = st.Model([body], springs=[st.Spring(body["corner"], (0, 0, 9), stiffness=1.0)])
        model.step("rest", body["zmin"].displace(x=0, y=0, z=0), increments=1)
        model.run()[-1].spring("glue")
