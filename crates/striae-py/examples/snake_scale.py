"""A crawler with snake-like scales: the same stroke costs less with the scales than against them.

A belly pad is pressed onto the ground and moved forward, then back. Its scales point backward, so
friction backward is larger: per cycle the ground gives it a push. Units: m, N, Pa.
"""

import numpy as np
import striae as st
from picture import save

skin = st.NeoHookean(youngs_modulus=2e5, poissons_ratio=0.45)
belly = st.Body("belly", st.block((0.03, 0.02, 0.01), (6, 4, 2)), skin)
ground = st.Plane("ground")
# The row of scales s runs across the body; a = n x s, from root to free edge, points to -x.
scales = belly["zmin"].textured((0, -1, 0))
law = st.Nap(mu_forward=0.15, mu_backward=0.35, mu_lateral=0.22)
model = st.Model([belly], [ground], [st.Pair(scales, ground, law)], title="Stroke of a crawler")
back = belly["zmax"]
model.step("press", back.displace(x=0, y=0, z=-3e-4), increments=3)
model.step("forward", back.displace(x=5e-3), increments=10)
model.step("backward", back.displace(x=0), increments=10)

run = model.run(keep="steps")
forces = {increment.step: increment.pair(0).force for increment in run}
ratios = {step: abs(force[0] / force[2]) for step, force in forces.items() if step != "press"}
print({step: round(float(ratio), 3) for step, ratio in ratios.items()})
assert np.isclose(ratios["forward"], 0.15, atol=2e-3)
assert np.isclose(ratios["backward"], 0.35, atol=2e-3)
save(run.plot(), "snake_scale")
