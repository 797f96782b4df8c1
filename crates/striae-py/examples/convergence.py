"""Convergence of a contact force with the mesh, by a sweep.

A cap is pressed onto a rigid plane; the force converges as elements shrink. Units: mm, N, MPa.
"""

import numpy as np
import striae as st
from matplotlib import pyplot
from picture import save


def model_of(element_size: float) -> st.Model:
    """The model with elements of this size at the apex (mm)."""
    cap = st.capped_block(element_size=element_size, fine_half_width=1.6, fine_depth=1.0)
    body = st.Body("cap", cap, st.LinearElastic(youngs_modulus=200.0, poissons_ratio=0.3))
    plane = st.Plane("plane", normal=(0, 0, 1))
    model = st.Model([body], [plane], [st.Pair(body["cap"], plane)], title="Cap on a plane")
    model.step("press", body["zmax"].displace(x=0, y=0, z=-0.1), increments=2)
    return model


sizes = [1.0, 0.7, 0.5]
study = st.sweep(model_of, {"element_size": sizes}, workers=2)
forces = study.values(lambda run: float(run[-1].pair(0).force[2]))
for size, force in zip(sizes, forces):
    print(f"element size {size}: force {force:.4f} N")
changes = np.abs(np.diff(forces)) / forces[-1]
print(f"changes {changes}")
assert changes[-1] < 0.05

figure, axes = pyplot.subplots(figsize=(5.5, 3.8), layout="constrained")
axes.plot(sizes, forces, "o-")
axes.set(xlabel="element size at the apex (mm)", ylabel="contact force (N)", xlim=(0.0, None))
axes.grid(alpha=0.3)
save(figure, "convergence")
