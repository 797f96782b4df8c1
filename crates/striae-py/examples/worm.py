"""The scales with which a worm crawls farthest: all of them at both ends.

A worm of five sections shortens and lengthens on feet with scales. Where its tail slides with the
scales and its head anchors against them, it comes forward. Scales are scarce: the friction of the
feet against them has a given sum. Shortening, the head has to hold; lengthening, the tail; what is
between them only drags, so the best worm is smooth there and rough at both ends in equal parts.

With a fixed coefficient, one node of the worm would stick while all others slip, and its way would
jump as that node becomes another one. Friction that rises with the slip rate, as over mucus, makes
the way a smooth function of the scales. Units: m, N, Pa, s. With ``--compare`` a search without
derivatives does the same.
"""

import sys
import time
import warnings

import numpy as np
import striae as st
from matplotlib import pyplot
from picture import save
from scipy.optimize import Bounds, LinearConstraint, minimize

FEET, LENGTH, SMOOTH, SUM = 5, 0.01, 0.1, 1.5
#: Coefficients are those at a slip rate of 2 mm/s; at rest they are a hundredth of that.
REST, RATE, REFERENCE = 0.01, 5e-4, 2e-3
flesh = st.NeoHookean(youngs_modulus=2e5, poissons_ratio=0.3)
mesh = st.block((FEET * LENGTH, 0.006, 0.003), (3 * FEET, 2, 1))
# A foot is the middle third of its section.
middles = LENGTH * (np.arange(FEET) + 0.5)
below = mesh.points[:, 2] == 0
feet = [below & (abs(mesh.points[:, 0] - x) < 0.2 * LENGTH) for x in middles]
parts = [abs(mesh.middles[:, 0] - x) < 0.5 * LENGTH for x in middles]
mesh = mesh.with_sets(
    facets={f"foot {n}": foot for n, foot in enumerate(feet)},
    elements={f"part {n}": part for n, part in enumerate(parts)},
)


def stroke(**against: float) -> st.Model:
    """The worm shortens by a tenth and lengthens; against: coefficients of its feet."""
    sections = [st.Section(f"part {n}", flesh, density=1100.0) for n in range(FEET)]
    worm = st.Body("worm", mesh, sections=sections)
    ground, pairs = st.Plane("ground"), []
    for n, rough in enumerate(against.values()):
        nap = st.Nap(REST * SMOOTH, REST * rough, REST * (SMOOTH + rough) / 2)
        law = nap.with_logarithm((1 / REST - 1) / np.log(1 + REFERENCE / RATE), RATE)
        pairs.append(st.Pair(worm[f"foot {n}"].textured((0, -1, 0)), ground, law, name=f"foot {n}"))
    model = st.Model([worm], [ground], pairs)
    # A groove keeps the back from going aside.
    model.step("settle", worm["zmax"].displace(y=0), st.gravity((0, 0, -9.81)), increments=2)
    short = worm.stretch(-0.1, along=(1, 0, 0), curve=[(0, 0), (0.5, 1), (1, 0)])
    model.step("shorten and lengthen", short, increments=16)
    return model


def way(end: st.Increment) -> float:
    """Way of the worm in a stroke (mm)."""
    return 1e3 * float(end.body("worm").displacement[:, 0].mean())


def named(scales: np.ndarray) -> dict[str, float]:
    """Parameters by name."""
    return {f"foot{n}": float(rough) for n, rough in enumerate(scales)}


def loss(scales: np.ndarray) -> tuple[float, np.ndarray]:
    """Way with its sign changed, as it is minimised, and its derivatives."""
    parameters = named(scales)
    run = st.differentiate(stroke, parameters, keep="last")
    tried.append((scales.copy(), way(run[-1])))
    return -tried[-1][1], -np.array([run.gradient(way, name) for name in parameters])


# Turning back, feet go through slip rates of zero, so that the estimate of the uncertainty is just
# above its limit; differences of whole runs agree with the derivatives to 1e-7.
warnings.filterwarnings("ignore", "derivatives by .* are uncertain", st.RunWarning)
tried: list[tuple[np.ndarray, float]] = []
start = np.array([0.26, 0.28, 0.30, 0.32, 0.34])
bounds, scarce = Bounds(SMOOTH, 1.0), LinearConstraint(np.ones(FEET), SUM, SUM)
begun = time.perf_counter()
best = minimize(loss, start, jac=True, method="SLSQP", bounds=bounds, constraints=scarce, tol=1e-4)
spent = time.perf_counter() - begun
print(f"{tried[0][1]:.3f} mm at the start, {-best.fun:.3f} mm with {best.x.round(3)}")
print(f"{len(tried)} runs with derivatives, {spent:.1f} s")
assert np.allclose(best.x[1:-1], SMOOTH, atol=1e-3) and -best.fun > 1.2 * tried[0][1]
assert abs(best.x[0] - best.x[-1]) < 0.1 * best.x[0]

if "--compare" in sys.argv:
    begun = time.perf_counter()
    plain = minimize(
        lambda scales: -way(stroke(**named(scales)).run(keep="last")[-1]),
        start,
        method="COBYLA",
        bounds=bounds,
        constraints=scarce,
        options={"rhobeg": 0.1, "tol": 1e-3},
    )
    spent = time.perf_counter() - begun
    print(f"without derivatives {-plain.fun:.3f} mm with {plain.x.round(3)}")
    print(f"{plain.nfev} runs, {spent:.1f} s")

figure, (left, right) = pyplot.subplots(1, 2, figsize=(8.5, 3.6), layout="constrained")
for label, (scales, far), shift in [("start", tried[0], -0.2), ("best", tried[-1], 0.2)]:
    left.bar(np.arange(1, FEET + 1) + shift, scales, 0.38, label=f"{label}: {far:.2f} mm")
left.axhline(SMOOTH, color="0.4", linestyle="--", linewidth=1)
left.set(xlabel="foot, from tail to head", ylabel="friction against the scales")
left.legend(loc="upper center", fontsize="small")
right.plot(np.arange(1, len(tried) + 1), [far for _, far in tried], "o-")
right.set(xlabel="run", ylabel="way in a stroke (mm)", xticks=np.arange(1, len(tried) + 1))
right.grid(alpha=0.3)
save(figure, "worm")
