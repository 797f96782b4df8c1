"""Functions of position and time, curves over the time of the run, forces at nodes."""

from __future__ import annotations

import numpy as np
import pytest
import striae as st


def bar() -> st.Body:
    """A bar of two elements."""
    return st.Body("bar", st.block((2, 1, 1), (2, 1, 1)), st.NeoHookean(1.0, 0.3))


def ended(body: st.Body, *conditions: st.Condition, duration: float = 1.0) -> st.Increment:
    """The end of a step, of the model as its deck says it."""
    model = st.Model([body])
    model.step("go", *conditions, increments=2, duration=duration)
    return st.Model.from_text(model.to_deck()).run()[-1]


def test_functions_of_position_and_time_are_followed() -> None:
    body = bar()
    sides = [body[side] for side in ("xmin", "xmax")]
    moved = [side.displace(x="0.01*x*t + 1e-3*sin(pi*t/4)", y=0, z=0) for side in sides]
    end = ended(body, *moved, duration=2)
    x = body.mesh.points[:, 0]
    ends = (x == 0) | (x == 2)
    found = end.body("bar").displacement[ends, 0]
    assert np.allclose(found, (0.02 * x + 1e-3)[ends], rtol=0, atol=1e-14)


def test_courses_are_multiples_of_targets() -> None:
    body = bar()
    hold = body["xmin"].hold()
    for course, expected in (
        (st.Course([(0, 0), (1, 3), (5, -1)]), 2.0),
        (st.Course(np.array([[0, 0], [0.5, 1], [1, 0]]), period=1.5), 1.0),
        (st.Course("t^2"), 4.0),
        (st.Course("t^2", time="step"), 1.0),
    ):
        end = ended(body, hold, body["xmax"].displace(x=0.01, curve=course), duration=2)
        found = end.body("bar").displacement[body.mesh.points[:, 0] == 2, 0]
        assert np.allclose(found, 0.01 * expected, rtol=0, atol=1e-14), course


def test_forces_at_nodes_are_held() -> None:
    body = bar()
    hold = body["xmin"].hold()
    total = ended(body, hold, body["xmax"].force((1e-4, 0, "-1e-4*t")), duration=2)
    each = ended(body, hold, body["xmax"].force(each=(2.5e-5, 0, -5e-5)))
    for end in (total, each):
        assert np.allclose(end.reaction("bar", "xmin"), (-1e-4, 0, 2e-4), rtol=0, atol=1e-11)


def test_what_is_no_function_is_told() -> None:
    side = bar()["xmax"]
    with pytest.raises(st.ModelError, match="x: `2\\*u` is no function of .*, at letter 3: there is no `u`"):
        side.displace(x="2*u")
    with pytest.raises(st.ModelError, match="value: `sin\\(` is no function"):
        side.pressure("sin(")
    with pytest.raises(st.ModelError, match="a force is stated as either total or each"):
        side.force()
    with pytest.raises(st.ModelError, match="period: a function repeats itself"):
        st.Course("sin(t)", period=1)
    with pytest.raises(st.ModelError, match="course: a function of `t` alone is needed, but `x\\*t`"):
        st.Course("x*t")
    with pytest.raises(st.ModelError, match="points \\(time, value\\) are needed"):
        st.Course([1.0, 2.0])


def test_points_of_a_curve_are_a_list_or_an_array(pad: st.Body) -> None:
    points = [(0.0, 0.0), (0.5, 0.2), (1.0, 1.0)]
    ends = []
    for curve in (points, np.array(points)):
        model = st.Model([pad])
        moved = pad["zmax"].displace(x=0, y=0, z=-0.02, curve=curve)  # type: ignore[arg-type]
        model.step("press", pad["zmin"].hold(), moved, increments=2)
        half, _ = model.run(keep="all")
        ends.append(half.body("pad").displacement[pad.mesh.node_sets["zmax"], 2])
    assert np.allclose(ends[0], -0.004) and np.array_equal(*ends)
