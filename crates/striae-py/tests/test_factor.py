"""Factors of friction that functions state."""

from __future__ import annotations

import math
import pickle
import threading
from typing import Any

import numpy as np
import pytest
import striae as st

MU = 0.4
RANGE: dict[str, Any] = {"pressure": 1e5, "slip_rate": 0.5, "duration": 0.5, "time": 3.0}


def slider(law: st.Friction) -> st.Model:
    """A block that is pressed, and slid as a whole at a rate of 0.1."""
    body = st.Body("block", st.block(divisions=(2, 2, 1)), st.NeoHookean(1e6, 0.0))
    floor = st.Plane("floor")
    model = st.Model([body], [floor], [st.Pair(body["zmin"], floor, law)])
    whole = body["all"]
    model.step("press", whole.displace(x=0, y=0), body["zmax"].displace(z=-0.02), increments=1)
    model.step("slide", whole.displace(x=0.1), increments=5)
    return model


def coefficients(run: st.Run) -> list[float]:
    """Friction over pressure, after each increment of the slide."""
    forces = [increment.pair(0).force for increment in run if increment.step == "slide"]
    return [-force[0] / force[2] for force in forces]


def film(at: st.FactorPoints) -> Any:
    return 0.6 + 0.4 * at.state[:, 0]


def worn(at: st.FactorPoints) -> Any:
    return at.state * np.exp(-at.slip / 0.05)[:, None]


def film_with_slopes(at: st.FactorPoints) -> st.FactorSlopes:
    none = np.zeros_like(at.pressure)
    return st.FactorSlopes(film(at), none, none, np.full_like(at.state, 0.4))


def worn_with_slopes(at: st.FactorPoints) -> st.StateSlopes:
    state = worn(at)
    return st.StateSlopes(state, np.zeros_like(state), -state * at.duration / 0.05)


def of_film(slopes: bool) -> st.Friction:
    factor, update = (film_with_slopes, worn_with_slopes) if slopes else (film, worn)
    return st.Coulomb(MU).with_factor(factor, name="film", update=update, state=[1.0], **RANGE)


@pytest.mark.parametrize("slopes", [False, True])
def test_a_state_of_ones_own_evolves_along_the_closed_form(slopes: bool) -> None:
    run = slider(of_film(slopes)).run(keep="all")
    for number, found in enumerate(coefficients(run), 1):
        expected = MU * (0.6 + 0.4 * math.exp(-0.02 * number / 0.05))
        assert found == pytest.approx(expected, rel=1e-9)


def test_the_named_law_is_the_function_of_its_formula() -> None:
    named = st.Coulomb(MU).with_static_kinetic(
        kinetic_over_static=0.6, slip_distance=0.05, healing_time=1e12
    )
    one, other = (coefficients(slider(law).run(keep="all")) for law in (named, of_film(False)))
    assert np.allclose(one, other, rtol=1e-9, atol=0)


def test_a_factor_sees_arrays_of_all_nodes_in_one_call() -> None:
    calls: list[tuple[int, tuple[int, ...], float]] = []

    def factor(at: st.FactorPoints) -> Any:
        calls.append((len(at.pressure), at.position.shape, at.time))
        assert np.array_equal(at.slip, at.slip_rate * at.duration)
        return 1.0 + at.position[:, 0] * at.accumulated_slip

    law = st.Coulomb(MU).with_factor(factor, name="seen", **RANGE)
    calls.clear()
    run = slider(law).run(keep="all")
    # Nine nodes, five times for differences by pressure and slip rate.
    assert {count for count, _, _ in calls} == {45}
    assert {shape for _, shape, _ in calls} == {(45, 3)}
    times = sorted({time for _, _, time in calls})
    assert times == pytest.approx([1.0, 1.2, 1.4, 1.6, 1.8, 2.0])
    assert len(calls) < 100
    # The mean place of the block before an increment, and its slip.
    for number, found in enumerate(coefficients(run)):
        before = 0.02 * number
        assert found == pytest.approx(MU * (1 + (0.5 + before) * before), rel=1e-9)


def test_a_factor_of_both_textures_goes_with_their_angle() -> None:
    def factor(at: st.FactorPoints) -> Any:
        return 1.0 + 0.5 * np.sum(at.texture * at.opposite_texture, axis=1)

    law = st.Coulomb(MU).with_factor(factor, name="crossed", textures="both", **RANGE)
    body = st.Body("block", st.block(divisions=(2, 2, 1)), st.NeoHookean(1e6, 0.0))
    floor = st.Plane("floor", texture=(1, 0, 0))
    turned = (math.cos(math.radians(60)), math.sin(math.radians(60)), 0)
    pair = st.Pair(body["zmin"].textured(turned), floor, law)
    model = st.Model([body], [floor], [pair])
    whole = body["all"]
    model.step("press", whole.displace(x=0, y=0), body["zmax"].displace(z=-0.02), increments=1)
    model.step("slide", whole.displace(x=0.1), increments=2)
    # `a = n x s` of the block and `-a` of the floor are 60 degrees or 120 degrees apart.
    found = coefficients(model.run())[-1]
    assert abs(found / MU - 1) == pytest.approx(0.25, rel=1e-6)
    bare = st.Plane("floor")
    untextured = st.Model([body], [bare], [st.Pair(body["zmin"], bare, law)])
    untextured.step("press", body["zmax"].displace(z=-0.02))
    with pytest.raises(st.ModelError, match="both sides"):
        untextured.check()


def test_any_number_of_threads_gives_the_same_bits() -> None:
    one, two = (slider(of_film(False)).run(threads=threads, keep="all") for threads in (1, 2))
    assert np.array_equal(one.history.table, two.history.table)


def test_runs_at_once_share_the_interpreter() -> None:
    found: list[list[float]] = []

    def work() -> None:
        found.append(coefficients(slider(of_film(False)).run(threads=2, keep="all")))

    threads = [threading.Thread(target=work) for _ in range(2)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join(60)
    assert len(found) == 2 and found[0] == found[1]


def test_an_exception_ends_the_run_and_is_raised() -> None:
    def factor(at: st.FactorPoints) -> Any:
        if at.time > 1.5 and len(at.pressure) == 45:
            raise LookupError("no such film")
        return np.ones_like(at.pressure)

    law = st.Coulomb(MU).with_factor(factor, name="failing", **{**RANGE, "time": 1.0})
    model = slider(law)
    # Another run starts afresh.
    for _ in range(2):
        with pytest.raises(LookupError, match="^'?no such film"):
            model.run()
        assert model.last_run is not None and len(model.last_run) == 2


def test_a_factor_that_comes_to_be_negative_ends_the_run() -> None:
    law = st.Coulomb(MU).with_factor(
        lambda at: np.full_like(at.pressure, 1.7 - at.time), name="fading", **{**RANGE, "time": 1.0}
    )
    with pytest.raises(st.RunStopped, match="factor of friction `fading`: it is -"):
        slider(law).run()


def test_factors_are_judged() -> None:
    wrong: list[tuple[Any, str]] = [
        (lambda at: 1 - at.pressure / 5e4, "film: factor of friction `film`: it is -"),
        (lambda at: 1 / (1 + (at.pressure / 1e4) ** 2), "film: the factor lets friction fall"),
        (lambda at: np.where(at.slip_rate > 0, 0.8, 1.0), "film: the factor jumps or has no finite"),
        (
            lambda at: np.where(at.pressure > 1e4, 1.5, 1.0),
            r"film: the factor jumps by 5\.000e-1 where the pressure is 1\.000000e4",
        ),
        (lambda at: 1 + 0.1 * at.texture[:, 0] ** 2, "film: factor of friction `film`: it is NaN"),
        (lambda at: np.ones(3), r"film: factor: an array of shape \(\d+,\) is needed"),
        (
            lambda at: st.FactorSlopes(
                1 + at.slip_rate, np.zeros_like(at.pressure), np.zeros_like(at.pressure)
            ),
            "film: derivatives of the factor",
        ),
    ]
    for factor, words in wrong:
        with pytest.raises(st.ModelError, match=words):
            st.Coulomb(MU).with_factor(factor, name="film", **RANGE)
    states: list[tuple[Any, str]] = [
        (lambda at: at.state + 0.1, "film: the state after an increment and after its two halves"),
        (lambda at: at.state[:, 0], r"film: update: an array of shape \(\d+, 1\) is needed"),
    ]
    for update, words in states:
        with pytest.raises(st.ModelError, match=words):
            st.Coulomb(MU).with_factor(
                lambda at: 1 + 0 * at.pressure, name="film", update=update, state=[0.5], **RANGE
            )


def test_wrong_uses() -> None:
    law = st.Coulomb(MU)
    with pytest.raises(TypeError, match="factor: a function of points"):
        law.with_factor(1.0, name="one")  # type: ignore[arg-type]
    with pytest.raises(st.ModelError, match="a state needs both"):
        law.with_factor(film, name="one", state=[1.0])
    with pytest.raises(st.ModelError, match="at most 8 numbers"):
        law.with_factor(film, name="one", state=[1.0] * 9, update=worn)
    with pytest.raises(IndexError, match="out of bounds"):
        law.with_factor(film, name="one")
    with pytest.raises(st.ModelError, match="user-defined law"):
        slider(of_film(False)).to_deck()


def test_laws_of_named_functions_are_pickled() -> None:
    again = pickle.loads(pickle.dumps(of_film(True)))
    assert repr(again) == "Coulomb(mu=0.4).with_factor(name='film')"
    runs = (slider(law).run(keep="all") for law in (again, of_film(True)))
    one, other = (coefficients(run) for run in runs)
    assert one == other


def test_a_step_can_change_a_law_and_keep_its_state() -> None:
    model = slider(of_film(False))
    run = model.run(keep="all")
    change = model.change_friction("block-floor", of_film(True))
    moved = model.body("block")["all"].displace(x=0.12)
    more = run.continue_with(st.Step("on", change, moved, increments=1))
    expected = MU * (0.6 + 0.4 * math.exp(-0.12 / 0.05))
    force = more[-1].pair(0).force
    assert -force[0] / force[2] == pytest.approx(expected, rel=1e-9)
