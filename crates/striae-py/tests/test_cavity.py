"""Cavities with a pressure inside."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt
import pytest
import striae as st


def low(x: npt.NDArray[np.float64]) -> npt.NDArray[np.bool_]:
    return x[:, 2] < -0.79


def high(x: npt.NDArray[np.float64]) -> npt.NDArray[np.bool_]:
    return x[:, 2] > 0.79


def held(body: st.Body) -> list[st.Condition]:
    return [
        body["sides"].displace(y=0),
        body["foot"].displace(x=0, z=0),
        body["head"].displace(x=0),
    ]


def tube() -> st.Body:
    rubber = st.NeoHookean(youngs_modulus=1.0, poissons_ratio=0.3)
    mesh = st.annulus(inner_radius=0.5, outer_radius=0.8, width=0.4, divisions=(2, 16, 1))
    return st.Body("tube", mesh.with_sets(nodes={"foot": low, "head": high}), rubber)


def filled(body: st.Body) -> tuple[st.Model, st.Cavity]:
    inside = st.Cavity(body["rim"], name="inside")
    model = st.Model([body], cavities=[inside])
    model.step("fill", *held(body), inside.volume_ratio(1.2), increments=2)
    model.step("seal", inside.seal(0.5, exponent=1.4), increments=1)
    return model, inside


def test_a_tube_has_its_volume_and_keeps_its_gas() -> None:
    model, _ = filled(tube())
    assert model.cavity_names == ["inside"]
    run = model.run()
    end = run[-1]
    polygon = 8.0 * np.sin(2.0 * np.pi / 16.0) * 0.25
    assert end.cavity("inside").volume == pytest.approx(1.2 * 0.4 * polygon)
    assert end.cavities[0].pressure > 0.0
    again = st.Model.from_text(model.to_deck()).run()[-1]
    assert again.cavity(0).pressure == end.cavity(0).pressure


def test_a_pressure_is_that_of_a_load() -> None:
    ends = []
    for content in ("pressure", "load"):
        body = tube()
        inside = st.Cavity(body["rim"], name="inside")
        model = st.Model([body], cavities=[inside])
        push = inside.pressure(0.1) if content == "pressure" else body["rim"].pressure(0.1)
        model.step("press", *held(body), push, increments=2)
        ends.append(model.run()[-1].body("tube").position)
    assert np.allclose(*ends, atol=1e-9)


def test_wrong_cavities_meet_words() -> None:
    body = tube()
    with pytest.raises(st.ModelError, match="at least one facet set"):
        st.Cavity(name="inside")
    with pytest.raises(TypeError, match="BodySet"):
        st.Cavity("rim", name="inside")  # type: ignore[arg-type]
    with pytest.raises(st.ModelError, match="its surface ends at the edge"):
        model = st.Model([body], cavities=[st.Cavity(body["rim"], name="inside")])
        model.step("rest", body["foot"].displace(x=0, y=0, z=0))
        model.check()
    with pytest.raises(st.ModelError, match="volume"):
        st.Cavity(body["rim"], name="inside").volume(-1.0)
    with pytest.raises(st.ModelError, match="no cavity is named"):
        filled(tube())[0].run()[-1].cavity("outside")
