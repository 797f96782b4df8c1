"""A rubber pad of felupe is pressed onto a grooved rigid floor and dragged across the grooves.

felupe has the rubber at large strain, striae adds contact with anisotropic friction. The forces are
those of striae's own run of the same model. Units: m, N, Pa. Needs ``pip install felupe``.
"""

from typing import Any

import felupe as fem
import numpy as np
import striae as st
from contact_newton import Floats, increment

E, NU = 1e6, 0.4
pad = st.block(size=(0.06, 0.04, 0.02), divisions=(6, 4, 3))
points = pad.points
region = fem.RegionHexahedron(fem.Mesh(points, pad.cells["hexahedron"], "hexahedron"))
field = fem.FieldContainer([fem.Field(region, dim=3)])
rubber = fem.NeoHookeCompressible(mu=E / (2 * (1 + NU)), lmbda=E * NU / ((1 + NU) * (1 - 2 * NU)))
solid = fem.SolidBody(rubber, field)


def elements(x: Floats) -> tuple[Floats, Any]:
    """Internal forces at positions, and the stiffness."""
    field[0].values[:] = x - points
    forces = solid.assemble.vector(field).toarray().reshape(-1, 3)
    return forces, solid.assemble.matrix(field)


# The floor stands still at z = 0 with grooves at 30 degrees to the drag, which is along x.
grooves = (np.cos(np.pi / 6), np.sin(np.pi / 6), 0.0)
floor, law = st.Plane("floor", texture=grooves), st.Orthotropic(mu_along=0.2, mu_across=0.5)
sole = st.contact.Surface(pad.facet_sets["zmin"], youngs_modulus=E)
contact = st.contact.Contact(points, [st.contact.Pair(sole, floor, law)])
held = np.zeros(points.shape, dtype=bool)
held[pad.node_sets["zmax"]] = True

PRESS, DRAG = 3, 8
shifts = [(0.0, 0.0, -0.003 * at / PRESS) for at in range(1, PRESS + 1)]
shifts += [(0.02 * at / DRAG, 0.0, -0.003) for at in range(1, DRAG + 1)]
state, forces = contact.untouched(), []
for shift in shifts:
    state, found = increment(contact, state, elements, held, points + shift)
    forces.append(found.pair().force)
    along, across, normal = forces[-1]
    print(f"x = {shift[0]:.4f}: pressed with {normal:.1f}, dragged {along:.1f}, aside {across:.1f}")

# The same model, all of it in striae.
body = st.Body("pad", pad, st.NeoHookean(E, NU, volumetric="logarithmic"), formulation="standard")
solver = st.Solver(tolerance=1e-12)
model = st.Model([body], [floor], [st.Pair(body["zmin"], floor, law)], solver=solver)
model.step("press", body["zmax"].displace(x=0, y=0, z=-0.003), increments=PRESS)
model.step("drag", body["zmax"].displace(x=0.02), increments=DRAG)
own = np.array([one.pair(0).force for one in model.run(keep="all")])
difference = np.abs(own - forces).max() / np.abs(own).max()
print(f"largest difference from striae's own run: {difference:.1e}")
assert difference < 1e-8
