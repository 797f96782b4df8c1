"""Bodies that move themselves."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
import striae as st


def bar() -> st.Body:
    """A bar of two elements."""
    return st.Body("bar", st.block((2, 1, 1), (2, 1, 1)), st.NeoHookean(1.0, 0.3))


def grown(body: st.Body, condition: st.Condition) -> st.Increment:
    """The end of a step in which three planes hold a bar."""
    model = st.Model([body])
    holds = (body["xmin"].displace(x=0), body["ymin"].displace(y=0), body["zmin"].displace(z=0))
    model.step("grow", *holds, condition, increments=2)
    return st.Model.from_text(model.to_deck()).run()[-1]


def test_free_bodies_take_the_shape_of_their_strain() -> None:
    body = bar()
    for condition, strain in (
        (body.stretch(0.1), (0.1, 0.1, 0.1)),
        (body.stretch(-0.1, along=(0, 0, 2)), (0, 0, -0.1)),
        (body.strain((0.1, 0.2, -0.1, 0, 0, 0), curve="smooth"), (0.1, 0.2, -0.1)),
        (body.strain((0.1, 0, 0, 0, 0, 0), axes=[(0, 1, 0), (1, 0, 0)]), (0, 0.1, 0)),
        (body.warm(100.0, 1e-3), (0.1, 0.1, 0.1)),
    ):
        found = grown(body, condition).body("bar").displacement
        expected = body.mesh.points * np.array(strain)
        assert np.abs(found - expected).max() < 1e-12


def test_tension_shortens_and_its_work_is_told() -> None:
    body = bar()
    end = grown(body, body.pull(0.1, along=(1, 0, 0)))
    assert end.body("bar").displacement[:, 0].min() < -0.1
    assert end.energies.actuation == pytest.approx(end.energies.strain, rel=0.02)


def test_what_is_wrong_is_told() -> None:
    body = bar()
    wrong: tuple[Callable[[], st.Condition], ...] = (
        lambda: body.stretch(float("nan")),
        lambda: body.stretch(0.1, along=(0, 0, 0)),
        lambda: body.stretch(0.1, along="threads"),  # type: ignore[arg-type]
        lambda: body.strain((0.1, 0.2)),
        lambda: body.strain((0.1, 0, 0, 0, 0, 0), axes=[(1, 0, 0)]),
    )
    for one in wrong:
        with pytest.raises(st.ModelError):
            one()
    for condition, told in (
        (body.stretch(-1.0), "and vanish"),
        (body.pull(1.0, along="fibres"), "no fibres"),
        (body.stretch(0.1, section="left"), "left"),
    ):
        model = st.Model([body])
        model.step("grow", body["xmin"].hold(), condition)
        with pytest.raises(st.ModelError, match=told):
            model.run()
