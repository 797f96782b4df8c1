"""A rubber pad with a mesh from a file, dragged over a floor with a nap. Units: m, N, Pa."""

from pathlib import Path

import striae as st
from picture import save

HERE = Path(__file__).parent

rubber = st.NeoHookean(youngs_modulus=1e6, poissons_ratio=0.45)
# Also st.Mesh(points, {"hexahedron": cells}), and objects of meshio and pyvista.
pad = st.Body("pad", st.read_mesh(HERE / "pad.msh"), rubber)
floor = st.Plane("floor", normal=(0, 0, 1), texture=(1, 0, 0))
nap = st.Nap(mu_forward=0.2, mu_backward=0.6, mu_lateral=0.4)
model = st.Model(bodies=[pad], rigid=[floor], pairs=[st.Pair(pad["sole"], floor, nap)])
model.step("press", pad["top"].displace(x=0, y=0, z=-1e-3))
model.step("drag", pad["top"].displace(x=5e-3), increments=50)
print(model.advice())

run = model.run(on_increment=lambda i: print(i.time, i.pairs[0].force))
print(run.history.to_pandas().tail())
stress, traction = run[-1].body("pad").stress, run[-1].pair(0).traction
print(stress.shape, traction.shape)
save(run.plot(), "pad")
run.report("pad.html")

# Constants of a law from measurements, here made by a law that is known.
known = st.TwoTextures(0.5, c_mag=0.2, c_ang=0.15, c_cen=0.8)
angles, forces, theta = [], [], []
for between in (0.0, 60.0, 120.0):
    surface = known.slip_surface(between, 24)
    angles += [float(angle) for angle in surface.slip_angle]
    forces += [float(force) for force in surface.dissipation]
    theta += [between] * 24
fit = st.fit_friction(angles, forces, law=st.TwoTextures, theta=theta)
print(fit.constants, fit.intervals, fit.at_bound)
assert abs(fit.constants["mu"] - 0.5) < 1e-9
