"""Derivatives of runs by numbers of their models."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
import striae as st


def model_of(mu: float = 0.3, modulus: float = 1e6, height: float = 1.0, depth: float = 0.02) -> st.Model:
    mesh = st.block(size=(1, 1, height), divisions=(2, 2, 2))
    body = st.Body("pad", mesh, st.NeoHookean(modulus, 0.3))
    floor = st.Plane("floor")
    model = st.Model([body], [floor], [st.Pair(body["zmin"], floor, st.Coulomb(mu), name="foot")])
    model.step("press", body["zmax"].displace(x=0, y=0, z=-depth), increments=2)
    model.step("drag", body["zmax"].displace(x=0.3), increments=3)
    return model


def test_gradients_are_differences_of_runs(tmp_path: Path) -> None:
    point = {"mu": 0.3, "modulus": 1e6, "height": 1.0}
    run = st.differentiate(model_of, point, output=tmp_path / "out")
    plain = model_of().run()
    assert np.array_equal(run.history.table, plain.history.table)
    column = "pair.foot.resultant_a.x"
    for name, value in point.items():
        h = 1e-4 * value
        below, above = (model_of(**{name: moved}).run() for moved in (value - h, value + h))
        differences = (above.history[column] - below.history[column]) / (2 * h)
        gradient = run.gradient(column, name)
        assert gradient.shape == (5,)
        assert np.abs(gradient - differences).max() < 1e-5 * np.abs(differences).max()
        largest = run.gradient(lambda end: end.pair("foot").largest_pressure, name)
        pressures = [moved[-1].pair("foot").largest_pressure for moved in (below, above)]
        assert largest == pytest.approx((pressures[1] - pressures[0]) / (2 * h), rel=1e-5)
        table = np.genfromtxt(tmp_path / "out" / f"sensitivity-{name}.csv", delimiter=",", names=True, deletechars="")
        assert np.array_equal(table[column], gradient)


def test_what_is_no_parameter_is_told() -> None:
    run = st.differentiate(model_of, {"mu": 0.3})
    with pytest.raises(KeyError, match="not differentiated by `modulus`; parameters are: `mu`"):
        run.gradient("pair.foot.resultant_a.x", "modulus")
    with pytest.raises(KeyError, match="no column is named `force`"):
        run.gradient("force", "mu")
    with pytest.raises(KeyError, match="`time` says which increment a row is of"):
        run.gradient("time", "mu")
    with pytest.raises(KeyError, match="`iterations` is a count, which has no derivative"):
        run.gradient("iterations", "mu")
    for returned in (None, [1.0, 2.0], "a lot"):
        function: Any = lambda end, value=returned: value
        with pytest.raises(TypeError, match="has to return a number, but it returned"):
            run.gradient(function, "mu")
    with pytest.raises(st.ModelError, match=r"both sides of mu = 0, but at mu = -1e-05 there is none"):
        st.differentiate(model_of, {"mu": 0.0})
    with pytest.raises(TypeError, match="a column or a function"):
        run.gradient(3, "mu")  # type: ignore[call-overload]
    with pytest.raises(ValueError, match="at least one parameter"):
        st.differentiate(model_of, {})
    with pytest.raises(TypeError, match="model_of"):
        st.differentiate(model_of(), {"mu": 0.3})  # type: ignore[arg-type]


def test_faults_of_the_model_are_not_those_of_a_value_beside_it() -> None:
    def twice(mu: float) -> st.Model:
        body, floor = st.Body("pad", st.block(divisions=(2, 2, 2)), st.NeoHookean(1e6, 0.3)), st.Plane("floor")
        pairs = [st.Pair(body[face], floor, st.Coulomb(mu), name="foot") for face in ("zmin", "xmax")]
        model = st.Model([body], [floor], pairs)
        model.step("press", body["zmax"].displace(x=0, y=0, z=-0.02), increments=2)
        return model

    with pytest.raises(st.ModelError, match=r"pairs\[1\]\.name") as refused:
        st.differentiate(twice, {"mu": 0.3})
    assert "both sides" not in str(refused.value)


def test_parameters_that_change_the_mesh_are_refused() -> None:
    def divided(parts: float) -> st.Model:
        body = st.Body("pad", st.block(divisions=(1 if parts < 2 else 2, 1, 1)), st.NeoHookean(1e6, 0.3))
        model = st.Model([body])
        model.step("press", body["zmin"].displace(x=0, y=0, z=0), body["zmax"].displace(z=-0.1))
        return model

    with pytest.raises(st.ModelError, match="`parts` changes the elements"):
        st.differentiate(divided, {"parts": 2.0})


def rubbed(mu: float, modulus: float) -> st.Model:
    """A pad that sticks first and slips in the end, so that its force tells both constants."""
    body = st.Body("pad", st.block(divisions=(3, 2, 2)), st.NeoHookean(modulus, 0.45))
    floor = st.Plane("floor")
    model = st.Model([body], [floor], [st.Pair(body["zmin"], floor, st.Coulomb(mu), name="foot")])
    model.step("press", body["zmax"].displace(x=0, y=0, z=-0.02), increments=2)
    model.step("drag", body["zmax"].displace(x=0.1), increments=10)
    return model


def test_constants_are_found_again() -> None:
    column = "pair.foot.resultant_a.x"
    measured = rubbed(mu=0.42, modulus=1.7e6).run().history[column]
    found = {"mu": 0.35, "modulus": 1.4e6}
    for _ in range(10):
        run = st.differentiate(rubbed, found, keep="last")
        columns = [value * run.gradient(column, name) for name, value in found.items()]
        jacobian = np.column_stack(columns)
        change, *_ = np.linalg.lstsq(jacobian, measured - run.history[column], rcond=None)
        found = {name: value * (1 + part) for (name, value), part in zip(found.items(), change)}
    assert found["mu"] == pytest.approx(0.42, rel=1e-6)
    assert found["modulus"] == pytest.approx(1.7e6, rel=1e-6)


def test_the_division_into_increments_is_no_parameter() -> None:
    def divided(part: float) -> st.Model:
        body = st.Body("pad", st.block(divisions=(1, 1, 1)), st.NeoHookean(1e6, 0.3))
        model = st.Model([body])
        model.step("press", body["zmin"].hold(), body["zmax"].displace(z=-0.1), increments=st.Increments(part))
        return model

    with pytest.raises(st.ModelError, match="`part` changes the increments of the model"):
        st.differentiate(divided, {"part": 0.3})
