"""From the file of a tribometer to the force that drags a grooved pad."""

import numpy as np
import striae as st

columns = {"angle": "angle [deg]", "normal": "Fn [N]", "tangential": "Ft [N]", "specimen": "sample"}
read = st.read_measurements("tribometer.csv", columns=columns, skip_lines=1)
fit = st.fit_friction(read.angles, read.forces, st.Orthotropic, specimen=read.specimen)
print(fit.constants, fit.intervals, fit.specimens)

rubber = st.NeoHookean(youngs_modulus=2.0, poissons_ratio=0.45)
pad = st.Body("pad", st.block(size=(20.0, 20.0, 8.0), divisions=(5, 5, 2)), rubber)
grooves = np.radians(60.0)
floor = st.Plane("floor", texture=(np.cos(grooves), np.sin(grooves), 0.0))
model = st.Model([pad], [floor], [st.Pair(pad["zmin"], floor, fit.friction)])
model.step("press", pad["zmax"].displace(x=0.0, y=0.0, z=-0.4), increments=2)
model.step("drag", pad["zmax"].displace(x=6.0), increments=10)
run = model.run()
print(run)
x, y, z = run[-1].pair(0).force
print(f"drag {-x / z:.3f} of the normal force, sideways {y / z:.3f}")
run.animate("tribometer.gif")
