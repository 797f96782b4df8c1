"""Contact of everything with everything."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
import striae as st


@pytest.fixture
def lid(rubber: st.NeoHookean) -> st.Body:
    return st.Body("lid", st.block(origin=(0, 0, 1.1), divisions=(1, 1, 1)), rubber)


def assembly(bodies: list[st.Body], rigid: list[st.Rigid], *pairs: st.Pair) -> st.Model:
    model = st.Model(bodies, rigid, list(pairs), title="assembly")
    model.step("press", *(body["zmax"].displace(x=0, y=0, z=-0.01) for body in bodies))
    return model


def test_everything_touches_everything(pad: st.Body, lid: st.Body, floor: st.Plane) -> None:
    model = assembly([pad, lid], [floor])
    model.contact_all(st.Coulomb(0.3), exclude=[(lid, lid)])
    assert model.pair_names == ["pad-pad", "pad-lid", "pad-floor", "lid-floor"]
    found, stated = model.friction("pad-lid").slip_surface(), st.Coulomb(0.3).slip_surface()
    assert np.allclose(found.friction, stated.friction)


def test_the_narrowest_law_counts_and_textures_are_painted(pad: st.Body, floor: st.Plane) -> None:
    model = assembly([pad], [floor])
    law = st.Orthotropic(mu_along=0.1, mu_across=0.4)
    model.contact_all(between=[(pad["zmin"], floor, law)])
    assert model.pair_names == ["pad-pad", "pad.rest-floor", "pad.zmin-floor"]
    found = model.friction("pad.zmin-floor").slip_surface()
    assert np.allclose(found.friction, law.slip_surface().friction)
    assert not np.any(model.friction("pad.rest-floor").slip_surface().friction)
    again = st.Model.from_text(model.to_deck())
    assert again.pair_names == model.pair_names


def test_a_texture_may_be_stated_again(pad: st.Body, floor: st.Plane) -> None:
    model = assembly([pad], [floor])
    law = st.TwoTextures(0.5, c_mag=0.2, c_ang=0.15, c_cen=0.8)
    once, again = (pad["zmin"].textured((1, 0, 0)) for _ in range(2))
    model.contact_all(between=[(once, floor, law)], textures=[again])
    model.check()


def test_steps_change_friction_by_name(pad: st.Body, floor: st.Plane) -> None:
    model = assembly([pad], [floor])
    model.contact_all()
    model.step("ease", model.change_friction("pad-floor", st.Coulomb(0.9)))
    assert "pad-floor" in model.pair_names
    model.step("wrong", model.change_friction("pad-flor", st.Coulomb(0.9)))
    with pytest.raises(st.ModelError, match="no pair is named `pad-flor`"):
        model.check()


def test_pairs_keep_their_facets(pad: st.Body, floor: st.Plane) -> None:
    model = assembly([pad], [floor], st.Pair(pad["zmin"], floor))
    model.contact_all()
    assert model.pair_names == ["pad-floor", "pad-pad", "pad.rest-floor"]


def test_a_surface_touches_itself(pad: st.Body, floor: st.Plane) -> None:
    own = st.Pair(pad["xmin"], "itself", feature_angle=60, name="slit")
    model = assembly([pad], [floor], own)
    text = model.to_deck()
    assert 'b = "itself"' in text and "feature_angle = 60" in text


def test_wrong_uses_are_told(pad: st.Body, floor: st.Plane) -> None:
    model = assembly([pad], [floor])
    with pytest.raises(TypeError, match="exclude: a body, a set"):
        model.contact_all(exclude=[3])  # type: ignore[list-item]
    with pytest.raises(TypeError, match="has no texture"):
        model.contact_all(textures=[pad["zmin"]])
    along, across = (pad["zmin"].textured(way) for way in ((1, 0, 0), (0, 1, 0)))
    law = st.Orthotropic(mu_along=0.1, mu_across=0.4)
    with pytest.raises(st.ModelError, match="textures: `pad.zmin` has two textures"):
        model.contact_all(between=[(along, floor, law)], textures=[across])
    three: Any = [("a", "b", "floor")]
    with pytest.raises(st.ModelError, match="exclude: tuples of two surfaces are needed, not of 3"):
        model.contact_all(exclude=three)
    two: Any = [("a", "b")]
    with pytest.raises(st.ModelError, match="between: tuples of two surfaces and their law"):
        model.contact_all(between=two)
    model.contact_all(exclude=["rod"])
    with pytest.raises(st.ModelError, match="no body or rigid surface is named `rod`"):
        model.check()
    law = st.Coulomb(np.float64(0.2))
    model.contact_all(between=[(pad, floor, law), ("floor", "pad", law)])
    with pytest.raises(st.ModelError, match="`between` 1 and 2 both name pad and floor"):
        model.check()
    with pytest.raises(st.ModelError, match="stated in it"):
        st.Model.from_text(assembly([pad], [floor], st.Pair(pad["zmin"], floor)).to_deck()).contact_all()
