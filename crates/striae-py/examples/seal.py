"""The profile of a seal that rubs least, and still seals in the loosest gap.

A strip of rubber, 1 mm thick, stands on a shaft that moves below it. The gap between them has a tolerance:
in the loose one the shaft has to be pressed with 1 N, in the tight one the crown
must not wear by more than 1.3 MPa, and the friction there has to be least. The radius of the crown,
the height of the seal and its half width at the crown are sought.

The function is smooth where the whole crown slides at once, in the only increment with friction,
and the pressure is taken before it: while the seal slides, the largest pressure may jump from the
crown to its heel. That is why slimmer seals are excluded, too. Units: m, N, Pa, in profiles mm.
With ``--compare`` a search without derivatives does the same.
"""

import sys
import time

import numpy as np
import striae as st
from matplotlib import pyplot
from picture import save
from scipy.optimize import minimize

LOOSE, TIGHT, MU = 4.6, 4.2, 0.1
LEAST, LARGEST = 1.0, 1.3
rubber = st.NeoHookean(youngs_modulus=5e6, poissons_ratio=0.4)
NAMES, BOUNDS = ["radius", "height", "width"], [(1.0, 4.0), (4.7, 5.4), (1.5, 2.4)]


def profile(radius: float, height: float, width: float) -> st.Mesh:
    """A slice of 1 mm with elements that are always the same, only their corners move."""
    square = st.block((2, 1e-3, 1), (16, 1, 8), origin=(-1, 0, 0))
    u, y, v = square.points.T
    x = (width + (2.5 - width) * v**2) * u
    z = height * v + (1 - v) * x**2 / (2 * radius)
    facets = {"crown": square.facet_sets["zmin"]}
    nodes = {"base": square.node_sets["zmax"]}
    points = np.column_stack([1e-3 * x, y, 1e-3 * z])
    return st.Mesh(points, square.cells, facet_sets=facets, node_sets=nodes)


def seal(radius: float, height: float, width: float) -> st.Model:
    """The seal of a profile: mounted with grease, pressed by both gaps, and rubbed."""
    body, shaft = st.Body("seal", profile(radius, height, width), rubber), st.Plane("shaft")
    model = st.Model([body], [shaft], [st.Pair(body["crown"], shaft, name="crown")])
    base = body["base"]
    model.step("loose", base.displace(x=0, y=0, z=1e-3 * (LOOSE - height)), increments=4)
    model.step("tight", base.displace(z=1e-3 * (TIGHT - height)), increments=3)
    rub = model.change_friction("crown", st.Coulomb(MU))
    model.step("rub", rub, base.displace(x=1.5e-3), increments=1)
    return model


CROWN = "pair.crown."
#: Friction, force in the loose gap and pressure in the tight one (MPa): columns of the history,
#: increments, and factors.
SOUGHT = [("resultant_a.x", 7, -1.0), ("resultant_a.z", 3, 1.0), ("max_pressure", 6, 1e-6)]
LIMITS, SIGNS = np.array([LEAST, LARGEST]), np.array([1.0, -1.0])
Known = dict[tuple[float, ...], tuple[np.ndarray, np.ndarray]]


def results(x: np.ndarray, known: Known, derive: bool = True) -> tuple[np.ndarray, np.ndarray]:
    """Results at parameters, with their derivatives; runs are known by their parameters, as
    the function and its limits are asked for one after the other."""
    key = tuple(float(one) for one in x)
    if key not in known:
        at = dict(zip(NAMES, key))
        run = st.differentiate(seal, at, keep="last") if derive else seal(**at).run(keep="last")
        assert run[-1].pair("crown").sticking == 0
        values = [scale * run.history[CROWN + column][i] for column, i, scale in SOUGHT]
        rows = [
            [scale * run.gradient(CROWN + column, name)[i] for name in NAMES]
            for column, i, scale in (SOUGHT if derive else [])
        ]
        known[key] = (np.array(values), np.array(rows))
    return known[key]


start, known = np.array([2.0, 5.0, 1.8]), Known()
begun = time.perf_counter()
limits = {
    "type": "ineq",
    "fun": lambda x: SIGNS * (results(x, known)[0][1:] - LIMITS),
    "jac": lambda x: SIGNS[:, None] * results(x, known)[1][1:],
}
best = minimize(
    lambda x: results(x, known)[0][0],
    start,
    jac=lambda x: results(x, known)[1][0],
    method="SLSQP",
    bounds=BOUNDS,
    constraints=limits,
    tol=1e-5,
)
ways = [found for found, _ in known.values()]
print("start ", start, ways[0].round(4))
print("best  ", best.x.round(4), ways[-1].round(4))
print(f"{len(known)} runs with derivatives, {time.perf_counter() - begun:.1f} s")
assert best.success and np.allclose(ways[-1][1:], [LEAST, LARGEST], rtol=1e-3)
assert ways[-1][0] < 0.98 * ways[0][0] and np.isclose(best.x[2], 1.5)

if "--compare" in sys.argv:
    begun, runs = time.perf_counter(), Known()
    plain = minimize(
        lambda x: results(x, runs, derive=False)[0][0],
        start,
        method="COBYLA",
        bounds=BOUNDS,
        constraints={
            "type": "ineq",
            "fun": lambda x: SIGNS * (results(x, runs, derive=False)[0][1:] - LIMITS),
        },
        options={"rhobeg": 0.1, "tol": 1e-4},
    )
    print("without", plain.x.round(4), list(runs.values())[-1][0].round(4))
    print(f"{len(runs)} runs, {time.perf_counter() - begun:.1f} s")

figure, (left, right) = pyplot.subplots(1, 2, figsize=(8.5, 3.6), layout="constrained")
for label, x, colour in [("start", start, "0.6"), ("best", best.x, "C0")]:
    mesh = profile(*(float(one) for one in x))
    rows = 1e3 * mesh.points[mesh.points[:, 1] == 0][:, [0, 2]].reshape(9, 17, 2)
    edge = np.vstack([rows[0], rows[1:, -1], rows[-1, ::-1], rows[::-1, 0]])
    left.plot(*edge.T, color=colour, label=label)
left.set(xlabel="x (mm)", ylabel="z (mm)", aspect="equal")
left.legend(loc="center")
numbers, shares = np.arange(1, len(ways) + 1), np.array(ways) / [ways[0][0], LEAST, LARGEST]
labels = ["friction over that at the start", "force over the least", "pressure over the largest"]
for column, label in enumerate(labels):
    right.plot(numbers, shares[:, column], "o-", label=label)
right.set(xlabel="run", ylabel="ratio", xticks=numbers)
right.legend(fontsize="small")
right.grid(alpha=0.3)
save(figure, "seal")
