"""A grooved sole on a grooved floor drifts aside as it is dragged.

The sole has grooves along x, the floor has grooves at 40 degrees to it. Friction of two textures
depends on both, so it is not against slip: held sideways by a soft pad only, the sole drifts.
Units: m, N, Pa.
"""

import numpy as np
import striae as st
from picture import save

ANGLE = np.radians(40)
rubber = st.NeoHookean(youngs_modulus=1e6, poissons_ratio=0.4)
pad = st.Body("pad", st.block((0.06, 0.04, 0.02), (9, 6, 3)), rubber)
floor = st.Plane("floor", texture=(np.cos(ANGLE), np.sin(ANGLE), 0))
law = st.TwoTextures(0.3, c_mag=0.3, c_ang=0.4, c_cen=0.2)
sole = st.Pair(pad["zmin"].textured((1, 0, 0)), floor, law, name="sole")
model = st.Model([pad], [floor], [sole], title="Grooved sole on a grooved floor")
model.step("press", pad["zmax"].displace(x=0, y=0, z=-1e-3), increments=4)
model.step("drag", pad["zmax"].displace(x=0.02), increments=20)

run = model.run(keep=4)
end = run[-1]
along, across, normal = end.pair("sole").force
drift = end.body("pad").displacement[end.pair("sole").nodes, 1].mean()
print(f"friction along the drag {along / normal:.3f}, across it {across / normal:.3f}")
print(f"the sole has drifted by {1e6 * drift:.1f} micrometres")
assert abs(across) > 0.01 * abs(along) and np.sign(drift) == np.sign(across)
save(run.plot(), "grooved_sole")
