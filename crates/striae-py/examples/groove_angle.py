"""The angle of grooves that pushes a dragged pad aside with the largest force.

Friction is associated, so that a pad that slides along x is pushed aside most by grooves at the
angle ``arctan(sqrt(mu_along/mu_across))`` to the drag, with ``mu_across - mu_along`` of the normal
force. All of the pad slides at the end, at every angle, so the force is a smooth function of the
angle: where some nodes still stuck, the force would have kinks as they begin to slip one by one.
Units: m, N, Pa. With ``--compare`` a search without derivatives does the same.
"""

import sys

import numpy as np
import striae as st
from matplotlib import pyplot
from picture import save
from scipy.optimize import minimize

ALONG, ACROSS = 0.2, 0.6
rubber = st.NeoHookean(youngs_modulus=1e6, poissons_ratio=0.4)


def drag(angle: float) -> st.Model:
    """A pad dragged along x over grooves at an angle to the drag (degrees)."""
    pad = st.Body("pad", st.block((0.04, 0.02, 0.01), (6, 3, 2)), rubber)
    floor = st.Plane("floor", texture=st.Uniform((1, 0, 0), turn=angle))
    law = st.Orthotropic(ALONG, ACROSS, slip_rule="associated")
    model = st.Model([pad], [floor], [st.Pair(pad["zmin"], floor, law, name="sole")])
    model.step("press", pad["zmax"].displace(x=0, y=0, z=-5e-4), increments=2)
    model.step("drag", pad["zmax"].displace(x=0.05), increments=10)
    return model


def aside(end: st.Increment) -> float:
    """Force aside over the normal force."""
    assert end.pair("sole").sticking == 0
    _, y, z = end.pair("sole").force
    return float(abs(y) / z)


def slope(angle: float) -> float:
    """Derivative of the force aside by the angle, which is kept with the force for the picture."""
    run = st.differentiate(drag, {"angle": angle}, keep="last")
    tried.append((angle, aside(run[-1]), run.gradient(aside, "angle")))
    return tried[-1][2]


# The secant method finds the angle at which the derivative vanishes.
tried: list[tuple[float, float, float]] = []
angles = [15.0, 25.0]
slopes = [slope(angle) for angle in angles]
while abs(angles[-1] - angles[-2]) > 1e-3:
    (a, b), (slope_a, slope_b) = angles[-2:], slopes[-2:]
    angles.append(b - slope_b * (b - a) / (slope_b - slope_a))
    slopes.append(slope(angles[-1]))
angle, force, _ = tried[-1]
exact = float(np.degrees(np.arctan(np.sqrt(ALONG / ACROSS))))
print(f"{angle:.5f} degrees, {force:.7f} of the normal force")
print(f"closed form {exact:.5f} degrees, {ACROSS - ALONG:.7f}; {len(tried)} runs with derivatives")
assert abs(angle - exact) < 1e-3 and abs(force - (ACROSS - ALONG)) < 1e-6

if "--compare" in sys.argv:
    plain = minimize(
        lambda x: -aside(drag(x[0]).run(keep="last")[-1]),
        [15.0],
        method="Nelder-Mead",
        options={"xatol": 1e-3, "fatol": 1e-12},
    )
    print(f"without derivatives {plain.x[0]:.5f} degrees after {plain.nfev} runs")

figure, axes = pyplot.subplots(figsize=(5.5, 3.8), layout="constrained")
t = np.radians(np.linspace(5, 60, 56))
along, across = ALONG * np.cos(t), ACROSS * np.sin(t)
law = (ACROSS**2 - ALONG**2) * np.sin(t) * np.cos(t) / np.hypot(along, across)
axes.plot(np.degrees(t), law, color="0.6", label="closed form")
for number, (at, height, rise) in enumerate(tried):
    ends = np.array([-4.0, 4.0])
    axes.plot(at + ends, height + rise * ends, color="C1", label=None if number else "derivatives")
axes.plot(*np.array(tried).T[:2], "o", color="C0", label="runs")
axes.set(xlabel="angle of the grooves (degrees)", ylabel="force aside over normal force")
axes.legend()
axes.grid(alpha=0.3)
save(figure, "groove_angle")
