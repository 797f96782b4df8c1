"""Ties of bodies."""

from __future__ import annotations

import numpy as np
import pytest
import striae as st


def halves(height: float = 0.5) -> tuple[st.Body, st.Body]:
    rubber = st.NeoHookean(youngs_modulus=1e6, poissons_ratio=0.3)
    lower = st.block(size=(1, 1, 0.5), divisions=(4, 4, 2))
    upper = st.block(origin=(0, 0, height), size=(1, 1, 0.5), divisions=(3, 3, 2))
    return st.Body("lower", lower, rubber), st.Body("upper", upper, rubber)


def pulled(lower: st.Body, upper: st.Body, tie: st.Tie) -> st.Model:
    model = st.Model([lower, upper], ties=[tie])
    held = lower["zmin"].displace(x=0, y=0, z=0)
    model.step("pull", held, upper["zmax"].displace(x=0.1, z=0.05), increments=2)
    return model


def test_a_tie_hands_on_what_pulls() -> None:
    lower, upper = halves()
    model = pulled(lower, upper, st.Tie(lower["zmax"], upper["zmin"]))
    assert model.tie_names == ["lower-upper"]
    end = model.run()[-1]
    tie = end.tie(0)
    pull = end.reaction("upper", "zmax")
    assert np.allclose(tie.force_b, -pull, rtol=1e-8)
    assert np.allclose(tie.force, pull, rtol=1e-8)
    assert tie.mismatch < 1e-10 and tie.moment_mismatch < 1e-10
    assert tie.area == pytest.approx(1.0)
    assert np.allclose(end.body("lower").tie_force.sum(axis=0), tie.force)
    assert end.ties[0].name == end.tie("lower-upper").name


def test_decks_know_ties() -> None:
    lower, upper = halves()
    model = pulled(lower, upper, st.Tie(upper["zmin"], lower["zmax"], name="glue", within=0.01))
    again = st.Model.from_text(model.to_deck())
    assert again.tie_names == ["glue"]
    ends = [one.run()[-1].body("upper").position for one in (model, again)]
    assert np.array_equal(*ends)


def test_wrong_ties_meet_words() -> None:
    lower, upper = halves(0.6)
    with pytest.raises(st.ModelError, match="set `within`"):
        pulled(lower, upper, st.Tie(lower["zmax"], upper["zmin"])).check()
    with pytest.raises(TypeError, match="BodySet"):
        st.Tie(lower, upper["zmin"])  # type: ignore[arg-type]
    with pytest.raises(st.ModelError, match="within"):
        st.Tie(lower["zmax"], upper["zmin"], within=-1.0)
    with pytest.raises(st.ModelError, match="no tie is named"):
        lower, upper = halves()
        pulled(lower, upper, st.Tie(lower["zmax"], upper["zmin"])).run()[-1].tie("glue")
