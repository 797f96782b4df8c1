"""Two elastic blocks of scikit-fem are pressed onto each other and sheared, with Coulomb friction.

scikit-fem assembles the stiffness, striae adds contact. The forces are those of striae's own run
of the same model. Units: m, N, Pa. Needs ``pip install scikit-fem``.
"""

import numpy as np
import striae as st
from contact_newton import Floats, increment
from scipy.sparse import csr_array
from skfem import Basis, ElementHex1, ElementVector, MeshHex
from skfem.models.elasticity import lame_parameters, linear_elasticity

MODULI, NU, MU = (1e6, 4e6), 0.3, 0.3
lower = st.block(size=(1, 1, 0.5), divisions=(5, 5, 3))
upper = st.block(origin=(0.12, 0.15, 0.5), size=(0.7, 0.6, 0.4), divisions=(3, 4, 2))
below = len(lower.points)
points = np.vstack([lower.points, upper.points])
cells = np.vstack([lower.cells["hexahedron"], upper.cells["hexahedron"] + below])

# scikit-fem counts the corners of a hexahedron in another order, and unknowns in one of its own.
mesh = MeshHex(points.T, cells.T[[0, 4, 3, 1, 7, 5, 2, 6]])
element = ElementVector(ElementHex1())
numbers = np.asarray(Basis(mesh, element).nodal_dofs).T.ravel()
stiffness = csr_array((points.size, points.size))
for block, modulus in zip(np.split(np.arange(len(cells)), [len(lower.cells["hexahedron"])]), MODULI):
    basis = Basis(mesh, element, elements=block, intorder=3)
    form = linear_elasticity(*lame_parameters(modulus, NU))
    stiffness += csr_array(form.assemble(basis))[numbers][:, numbers]


def elements(x: Floats) -> tuple[Floats, csr_array]:
    """Internal forces at positions, and the stiffness."""
    return (stiffness @ (x - points).ravel()).reshape(-1, 3), stiffness


sole = st.contact.Surface(upper.facet_sets["zmin"] + below, youngs_modulus=MODULI[1])
base = st.contact.Surface(lower.facet_sets["zmax"], youngs_modulus=MODULI[0])
contact = st.contact.Contact(points, [st.contact.Pair(sole, base, st.Coulomb(MU))])
held = np.zeros((len(points), 3), dtype=bool)
top = upper.node_sets["zmax"] + below
held[lower.node_sets["zmin"]] = held[top] = True

PRESS, SHEAR = 2, 6
shifts = [(0.0, 0.0, -0.01 * at / PRESS) for at in range(1, PRESS + 1)]
shifts += [(0.03 * at / SHEAR, 0.0, -0.01) for at in range(1, SHEAR + 1)]
state, forces = contact.untouched(), []
for shift in shifts:
    end = points.copy()
    end[top] += shift
    state, found = increment(contact, state, elements, held, end)
    forces.append(found.pair().force)
    slipping = int((found.pair().a.status == st.Status.SLIP).sum())
    print(f"x = {shift[0]:.3f}, z = {shift[2]:.3f}: force {forces[-1].round(3)}, {slipping} slip")

# The same model, all of it in striae.
bodies = [
    st.Body(name, block, st.LinearElastic(modulus, NU), formulation="standard")
    for name, block, modulus in zip(("lower", "upper"), (lower, upper), MODULI)
]
pair = st.Pair(bodies[1]["zmin"], bodies[0]["zmax"], st.Coulomb(MU))
model = st.Model(bodies, [], [pair], solver=st.Solver(tolerance=1e-12))
clamp, press = bodies[0]["zmin"].hold(), bodies[1]["zmax"].displace(x=0, y=0, z=-0.01)
model.step("press", clamp, press, increments=PRESS)
model.step("shear", bodies[1]["zmax"].displace(x=0.03), increments=SHEAR)
own = np.array([one.pair(0).force for one in model.run(keep="all")])
difference = np.abs(own - forces).max() / np.abs(own).max()
print(f"largest difference from striae's own run: {difference:.1e}")
assert difference < 1e-8
