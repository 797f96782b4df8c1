"""Bodies of several materials."""

from __future__ import annotations

import pickle

import numpy as np
import pytest
import striae as st


def bar(**given: object) -> st.Body:
    """A bar of three elements along x."""
    body = st.Body("bar", st.block((3, 1, 1), (3, 1, 1)), **given)  # type: ignore[arg-type]
    body.add_elements("stiff", lambda middles: middles[:, 0] > 1)
    body.add_elements("soft", [0])
    return body


def test_layers_in_a_row_share_the_force() -> None:
    soft, stiff = st.LinearElastic(2.0, 0.0), st.LinearElastic(7.0, 0.0)
    expected = 0.3 / (1 / 2 + 2 / 7)
    parts = [st.Section("stiff", stiff), st.Section("soft", soft)]
    for body in (bar(material=soft, sections=parts[:1]), bar(sections=parts)):
        model = st.Model([body])
        model.step(
            "pull", body["xmin"].hold(), body["xmax"].displace(x=0.3, y=0, z=0), increments=1
        )
        for made in (model, st.Model.from_text(model.to_deck())):
            force = made.run()[-1].reaction("bar", "xmax")
            assert force[0] == pytest.approx(expected, rel=1e-12)


def test_elements_are_chosen_and_kept() -> None:
    mesh = bar(material=st.NeoHookean(1.0, 0.3)).mesh
    assert mesh.element_sets["stiff"].tolist() == [1, 2]
    assert np.allclose(mesh.middles[:, 0], [0.5, 1.5, 2.5])
    again = pickle.loads(pickle.dumps(mesh))
    assert again.element_sets["stiff"].tolist() == [1, 2]
    assert mesh.with_sets(elements={"ends": np.array([True, False, True])}).element_sets[
        "ends"
    ].tolist() == [0, 2]
    with pytest.raises(st.ModelError, match="refers to element 3, but the mesh has 3 elements"):
        mesh.with_sets(elements={"far": [3]})


def test_what_is_wrong_with_sections_is_told() -> None:
    rubber = st.NeoHookean(1.0, 0.3)
    hold = "prescribe nothing"
    for sections, material, words in [
        ([st.Section("stuff", rubber)], rubber, "no element set `stuff`.*did you mean `stiff`"),
        ([st.Section("soft", rubber), st.Section("all", rubber)], rubber, "is in two sections"),
        ([st.Section("soft", rubber)], None, "2 of its elements are in no section"),
    ]:
        body = bar(material=material, sections=sections)
        model = st.Model([body])
        model.step(hold, body["all"].hold())
        with pytest.raises(st.ModelError, match=words):
            model.check()
    with pytest.raises(TypeError, match="material"):
        st.Body("bar", st.block())
