"""A rubber cap is pressed onto scales and dragged, its elements an energy that JAX differentiates.

The energy of an element is written down once; JAX makes forces and stiffness of it, striae adds
contact, which spreads over the cap. The forces are those of striae's own run of the same model.
Units: m, N, Pa. Needs ``pip install jax``.
"""

import jax
import jax.numpy as jnp
import numpy as np
import striae as st
from contact_newton import Floats, increment
from scipy.sparse import coo_array

jax.config.update("jax_enable_x64", True)

E, NU = 1e6, 0.3
SHEAR, LAMBDA = E / (2 * (1 + NU)), E * NU / ((1 + NU) * (1 - 2 * NU))
cap = st.capped_block(size=(0.03, 0.03), height=0.015, radius=0.03, element_size=0.003)
points, cells = cap.points, cap.cells["hexahedron"]

# Interpolation of a hexahedron at its eight Gauss points.
corners = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]])
signs = 2.0 * np.vstack([corners, corners + [0, 0, 1]]) - 1.0
gauss = signs / np.sqrt(3.0)
terms = 1.0 + signs[None] * gauss[:, None]
slopes = signs * np.stack([np.delete(terms, axis, 2).prod(2) for axis in range(3)], 2) / 8.0
jacobians = np.einsum("gcd,ecx->egdx", slopes, points[cells])
volumes = np.linalg.det(jacobians)
gradients = np.linalg.solve(jacobians, slopes.transpose(0, 2, 1)[None]).transpose(0, 1, 3, 2)


def energy(x: jax.Array, gradient: jax.Array, volume: jax.Array) -> jax.Array:
    """Energy of a neo-Hookean element with corners at ``x``, of shape (8, 3)."""
    F = jnp.einsum("ci,gcJ->giJ", x, gradient)
    J = jnp.linalg.det(F)
    isotropic = SHEAR / 2 * ((F**2).sum((1, 2)) - 3) - SHEAR * jnp.log(J)
    return ((isotropic + LAMBDA / 2 * (J - 1) ** 2) * volume).sum()


forces_of = jax.jit(jax.vmap(jax.grad(energy)))
stiffness_of = jax.jit(jax.vmap(jax.hessian(energy)))
numbers = (3 * cells[:, :, None] + np.arange(3)).reshape(len(cells), 24)
rows, cols = np.repeat(numbers, 24, 1).ravel(), np.tile(numbers, (1, 24)).ravel()


def elements(x: Floats) -> tuple[Floats, coo_array]:
    """Internal forces at positions, and the stiffness."""
    forces = np.zeros(x.shape)
    np.add.at(forces, cells, np.asarray(forces_of(x[cells], gradients, volumes)))
    entries = np.asarray(stiffness_of(x[cells], gradients, volumes)).ravel()
    return forces, coo_array((entries, (rows, cols)), shape=(x.size, x.size))


floor = st.Plane("floor", texture=(0, 1, 0))
law = st.Nap(mu_forward=0.2, mu_backward=0.6, mu_lateral=0.4)
sole = st.contact.Surface(cap.facet_sets["cap"], youngs_modulus=E)
contact = st.contact.Contact(points, [st.contact.Pair(sole, floor, law)])
held = np.zeros(points.shape, dtype=bool)
held[cap.node_sets["zmax"]] = True

PRESS, DRAG = 3, 6
shifts = [(0.0, 0.0, -0.002 * at / PRESS) for at in range(1, PRESS + 1)]
shifts += [(0.006 * at / DRAG, 0.0, -0.002) for at in range(1, DRAG + 1)]
state, forces = contact.untouched(), []
for shift in shifts:
    state, found = increment(contact, state, elements, held, points + shift)
    forces.append(found.pair().force)
    closed = int((found.pair().a.status != st.Status.OPEN).sum())
    print(f"x = {shift[0]:.3f}, z = {shift[2]:.5f}: force {forces[-1].round(4)}, {closed} nodes touch")

# The same model, all of it in striae.
body = st.Body("cap", cap, st.NeoHookean(E, NU), formulation="standard")
solver = st.Solver(tolerance=1e-12)
model = st.Model([body], [floor], [st.Pair(body["cap"], floor, law)], solver=solver)
model.step("press", body["zmax"].displace(x=0, y=0, z=-0.002), increments=PRESS)
model.step("drag", body["zmax"].displace(x=0.006), increments=DRAG)
own = np.array([one.pair(0).force for one in model.run(keep="all")])
difference = np.abs(own - forces).max() / np.abs(own).max()
print(f"largest difference from striae's own run: {difference:.1e}")
assert difference < 1e-8
