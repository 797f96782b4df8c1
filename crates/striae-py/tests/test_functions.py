"""Functions of Python in models."""

from __future__ import annotations

import math
from typing import Any, Optional

import numpy as np
import pytest
import striae as st


def pushed(pad: st.Body, floor: st.Plane, curve: object) -> st.Run:
    model = st.Model([pad], [floor], [st.Pair(pad["zmin"], floor)])
    model.step("press", pad["zmax"].displace(x=0, y=0, z=-0.02, curve=curve), increments=8)  # type: ignore[arg-type]
    return model.run()


def test_a_function_is_a_curve(pad: st.Body, floor: st.Plane) -> None:
    """The tops follow it at every increment."""
    run = pushed(pad, floor, lambda s: math.sin(math.pi * s))
    top = pad.mesh.points[:, 2] > 1 - 1e-9
    for increment in run:
        expected = -0.02 * math.sin(math.pi * increment.fraction)
        found = increment.body("pad").displacement[top, 2]
        assert np.allclose(found, expected, atol=1e-9)


def test_functions_of_named_curves_give_their_bits(pad: st.Body, floor: st.Plane) -> None:
    ramp, same = pushed(pad, floor, "ramp"), pushed(pad, floor, lambda s: s)
    assert np.allclose(ramp.history.table, same.history.table, rtol=1e-9, atol=1e-12)


def test_a_polar_curve_is_a_law() -> None:
    def mu(angle: float) -> float:
        return 0.3 + 0.1 * math.cos(math.radians(angle)) ** 2

    errors = []
    for count in (45, 90, 180):
        surface = st.Tabulated.sampled(mu, count).slip_surface(count=1001)
        exact = [mu(angle) for angle in surface.slip_angle]
        errors.append(float(np.abs(surface.dissipation - exact).max()))
    assert errors[0] / errors[1] > 3.5 and errors[1] / errors[2] > 3.5
    assert repr(st.Tabulated.sampled(mu)) == "Tabulated(angles=<360 numbers>, mu=<360 numbers>)"


def test_what_functions_raise_is_raised(pad: st.Body, floor: st.Plane) -> None:
    with pytest.raises(ZeroDivisionError):
        pushed(pad, floor, lambda s: 1 / s)
    with pytest.raises(st.ModelError, match="curve at 0.0: a finite number is needed, not nan"):
        pushed(pad, floor, lambda s: float("nan"))
    with pytest.raises(st.ModelError, match="mu at 90.0 degrees: a number is needed, not 'much'"):
        st.Tabulated.sampled(lambda angle: "much" if angle == 90 else 0.3, 4)  # type: ignore[arg-type, return-value]
    with pytest.raises(st.ModelError, match="refused: it must be positive and finite"):
        st.Tabulated.sampled(lambda angle: 0.1 + 0.2 * math.cos(math.radians(angle)))


def neo_hookean(F: Any) -> tuple[float, Any, Any]:
    """Energy ``G/2 (I1 - 3 - 2 ln J) + k/2 (J - 1)^2`` with G = 4e5 and k = 6e5."""
    G, k = 4e5, 6e5
    J, inverse = float(np.linalg.det(F)), np.linalg.inv(F).T
    one = np.eye(3)
    energy = 0.5 * G * (float((F * F).sum()) - 3.0 - 2.0 * math.log(J)) + 0.5 * k * (J - 1) ** 2
    stress = G * (F - inverse) + k * (J - 1) * J * inverse
    tangent = (
        G * np.einsum("ik,jl->ijkl", one, one)
        + (G - k * (J - 1) * J) * np.einsum("il,kj->ijkl", inverse, inverse)
        + k * (2 * J - 1) * J * np.einsum("ij,kl->ijkl", inverse, inverse)
    )
    return energy, stress, tangent


def dragged(material: st.Material, threads: Optional[int] = None) -> st.Run:
    pad = st.Body("pad", st.block(divisions=(2, 2, 2)), material)
    floor = st.Plane("floor", texture=(1, 0, 0))
    law = st.Orthotropic(mu_along=0.1, mu_across=0.4)
    model = st.Model([pad], [floor], [st.Pair(pad["zmin"], floor, law)])
    model.step("press", pad["zmax"].displace(x=0, y=0, z=-0.02), increments=2)
    model.step("drag", pad["zmax"].displace(y=0.1), increments=2)
    return model.run(threads=threads)


def test_a_function_is_a_material() -> None:
    """A law of the library, stated again, gives its results; threads do not bear on them."""
    own = st.OwnMaterial(neo_hookean, "again")
    known = st.NeoHookean(youngs_modulus=own.youngs_modulus, poissons_ratio=own.poissons_ratio)
    run, other = dragged(own), dragged(known)
    assert np.allclose(run.history.table, other.history.table, rtol=1e-8, atol=1e-4)
    assert np.array_equal(run.history.table, dragged(own, threads=1).history.table)
    assert np.allclose(run[-1].body("pad").stress, other[-1].body("pad").stress, rtol=1e-6)
    assert repr(own) == "OwnMaterial(name='again')"


def test_an_exception_in_a_material_ends_the_run() -> None:
    calls = []

    def failing(F: Any) -> tuple[float, Any, Any]:
        calls.append(1)
        if len(calls) > 2000 and abs(F[2, 2] - 1) > 0.01:
            raise ArithmeticError("enough")
        return neo_hookean(F)

    with pytest.raises(ArithmeticError, match="enough"):
        material = st.OwnMaterial(failing)
        for _ in range(10):
            dragged(material)


def test_a_material_without_a_response_is_named() -> None:
    """Pressed too far, whatever the increment."""

    judged = []

    def limited(F: Any) -> Optional[tuple[float, Any, Any]]:
        return None if judged and F[2, 2] < 0.985 else neo_hookean(F)

    material = st.OwnMaterial(limited)
    judged.append(True)
    with pytest.raises(st.RunStopped, match="no response to its deformation: det F = "):
        dragged(material)


def test_materials_are_judged_before_a_run() -> None:
    def wrong(F: Any) -> tuple[float, Any, Any]:
        energy, stress, tangent = neo_hookean(F)
        return energy + 1.0, 1.1 * stress, tangent

    with pytest.raises(st.ModelError) as error:
        st.OwnMaterial(wrong, "wrong")
    told = str(error.value)
    assert "wrong: at rest the energy is 1.0" in told
    assert "the stress is not the derivative of the energy" in told
    with pytest.raises(st.ModelError, match="own: stress: it must have shape"):
        st.OwnMaterial(lambda F: (0.0, np.zeros(3), np.zeros((3, 3, 3, 3))))
    with pytest.raises(st.ModelError, match="fails for the undeformed state"):
        st.OwnMaterial(lambda F: None)
    with pytest.raises(st.ModelError, match="a user-defined law"):
        model = st.Model([st.Body("pad", st.block(), st.OwnMaterial(neo_hookean))])
        model.step("rest", model.body("pad")["all"].hold())
        model.to_deck()


def herringbone(angle: float) -> tuple[Any, Any]:
    """Friction along the grooves drags half of itself across."""
    assert angle == 0.0
    return [[1.0, 0.5], [0.0, 1.0]], [0.0, 0.0]


def two_textures(angle: float) -> tuple[Any, Any]:
    """The law of two textures in the frame of their bisector: equation (36) of the paper."""
    c_mag, c_ang, c_cen = 0.3, 0.4, 0.2
    I0 = math.cos(math.radians(angle))
    m, B = math.sqrt(2.0 + 2.0 * I0), c_ang * (1.0 + I0)
    A = 1.0 + c_mag * I0
    return np.diag([A + B * m * m, A]), [B * m * c_cen, 0.0]


def test_a_kernel_is_a_law() -> None:
    """A law of the library, stated again, has its slip surface and gives its results."""
    own = st.OwnFriction(two_textures, 0.3, textures="two", name="again")
    known = st.TwoTextures(0.3, c_mag=0.3, c_ang=0.4, c_cen=0.2)
    for theta in (0.0, 37.0, -120.0, 175.0):
        found = zip(own.slip_surface(theta, 90), known.slip_surface(theta, 90), (1e-12, 1e-14, 1e-14))
        for one, other, round_off in found:
            # Angles are in degrees.
            assert np.allclose(one, other, rtol=0, atol=round_off)
    tables = []
    for law in (own, known):
        pad = st.Body("pad", st.block(divisions=(2, 2, 2)), st.NeoHookean(1e6, 0.3))
        floor = st.Plane("floor", texture=(1, 1, 0))
        model = st.Model([pad], [floor], [st.Pair(pad["zmin"].textured((1, 0, 0)), floor, law)])
        model.step("press", pad["zmax"].displace(x=0, y=0, z=-0.02), increments=2)
        model.step("drag", pad["zmax"].displace(y=0.1), increments=2)
        tables.append(model.run().history.table)
    assert np.allclose(*tables, rtol=1e-8, atol=1e-6)
    assert repr(own) == "OwnFriction(name='again', mu=0.3, textures='two')"


def test_a_kernel_of_one_texture_turns_friction_aside() -> None:
    """Sliding along the grooves is pushed to one side by half of the friction against it."""
    law = st.OwnFriction(herringbone, 0.4, name="herringbone")
    pad = st.Body("pad", st.block(divisions=(2, 2, 2)), st.NeoHookean(1e6, 0.3))
    floor = st.Plane("floor", texture=(1, 0, 0))
    model = st.Model([pad], [floor], [st.Pair(pad["zmin"], floor, law)])
    model.step("press", pad["zmax"].displace(x=0, y=0, z=-0.02), increments=2)
    model.step("drag", pad["zmax"].displace(x=0.6, y=0), increments=6)
    force = model.run()[-1].pair(0).force
    # On the pad: slip along x, friction -0.4 along it, and 0.2 across, by the sense of a = n x s.
    assert force[0] / force[2] == pytest.approx(-0.4, abs=2e-3)
    assert abs(force[1] / force[2]) == pytest.approx(0.2, abs=2e-3)
    with pytest.raises(st.ModelError, match="user-defined law"):
        model.to_deck()


def test_kernels_are_judged() -> None:
    def turned(angle: float) -> tuple[Any, Any]:
        return [[1.0, 0.3], [0.0, 1.0]], [0.0, 0.0]

    wrong: list[tuple[Any, str, str]] = [
        (lambda angle: (-np.eye(2), [0, 0]), "one", "own: friction would create energy"),
        (lambda angle: (np.eye(2), [2, 0]), "one", "own: law `own` has no slip surface"),
        (turned, "two", "own: seen from the other surface force or slip differ"),
        (lambda angle: (np.eye(2), [0.5, 0]), "two", "own: the kernel is no smooth function"),
        (lambda angle: (np.eye(3), [0, 0]), "one", r"own: L: it must have shape \(2, 2\)"),
        (lambda angle: (np.eye(2), [0, 0], np.ones((2, 2))), "one", "own: K: it must be regular"),
        (lambda angle: np.eye(2)[0:1], "one", "own: `L` and `eta` are needed"),
        (lambda angle: (np.eye(2), [0, np.nan]), "one", "own: eta: row 1 is not finite"),
    ]
    for kernel, textures, words in wrong:
        with pytest.raises(st.ModelError, match=words):
            st.OwnFriction(kernel, textures=textures)  # type: ignore[arg-type]
    with pytest.raises(ZeroDivisionError):
        st.OwnFriction(lambda angle: 1 / angle)  # type: ignore[arg-type, return-value]
    with pytest.raises(TypeError, match="kernel: a function of the angle"):
        st.OwnFriction(3)  # type: ignore[arg-type]


def test_components_are_led_by_functions(rubber: st.NeoHookean) -> None:
    """Each along its own, at every increment and over steps; as a deck they have the same bits."""
    body = st.Body("pad", st.block(divisions=(2, 2, 2)), rubber)
    top, nodes = body["zmax"], body.mesh.node_sets["zmax"]
    wave = lambda s: 0.1 * math.sin(2 * math.pi * s)  # noqa: E731
    model = st.Model([body])
    model.step("a", body["zmin"].hold(), top.displace(x=wave, y=lambda s: 0.05 * s * s, z=-0.1), increments=8)
    model.step("b", top.displace(x=wave, y=lambda s: 0.05 - 0.02 * s), increments=4)
    model.step("c", top.displace(y=lambda s: 0.03), increments=1)
    run = model.run()
    for increment in run:
        s = increment.fraction
        y = {"a": 0.05 * s * s, "b": 0.05 - 0.02 * s, "c": 0.03}[increment.step]
        x = 0.0 if increment.step == "c" else wave(s)
        z = -0.1 * s if increment.step == "a" else -0.1
        assert np.allclose(increment.body("pad").displacement[nodes], [x, y, z], atol=1e-14)
    again = st.Model.from_text(model.to_deck()).run()
    assert np.array_equal(again.history.table, run.history.table)
    more = run.continue_with(st.Step("d", top.displace(y=lambda s: 0.03 * (1 - s)), increments=1))
    assert np.allclose(more[-1].body("pad").displacement[nodes, 1], 0, atol=1e-15)
    with pytest.raises(st.ModelError, match="begins at 1, but node 18 is at 0.03"):
        run.continue_with(st.Step("d", top.displace(y=lambda s: 1.0)))


def test_functions_begin_where_nodes_are(rubber: st.NeoHookean) -> None:
    body = st.Body("pad", st.block(), rubber)
    model = st.Model([body])
    model.step("hold", body["zmin"].hold(), increments=1)
    model.step("go", body["zmax"].displace(x=lambda s: s))
    with pytest.raises(st.ModelError) as caught:
        model.check()
    assert str(caught.value) == (
        "steps[1]: a function leads component `x` of pad.zmax, but node 4 was free before, so its"
        " starting value is unknown; state a target and a curve"
    )
    model = st.Model([body])
    model.step("go", body["zmin"].hold(), body["zmax"].displace(x=lambda s: 1 + s))
    with pytest.raises(st.ModelError) as caught:
        model.check()
    assert str(caught.value) == (
        "steps[0]: the function of component `x` of pad.zmax begins at 1, but node 4 is at 0 at that time"
    )
