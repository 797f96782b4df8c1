"""Ten constants of friction of two textures and of two rubbers from one drag test.

Four pads are cut from a grooved sheet at known angles to its edge and pushed over a grooved floor
forth, aside and back, two of a soft rubber and two of a hard one. Their forces tell the four
constants of the law, two of its dependence on pressure and on slip, the angles of the grooves of
the sheet and of the floor, and the moduli. Units: m, N, Pa, degrees. With ``--compare`` searches
without derivatives do the same; that of Nelder and Mead takes some minutes.
"""

import sys

import numpy as np
import striae as st
from matplotlib import pyplot
from picture import save
from scipy.optimize import least_squares, minimize

CUTS = {"a": 0.0, "b": 40.0, "c": 80.0, "d": 120.0}
COLUMNS = [f"pair.{name}.resultant_a.{axis}" for name in CUTS for axis in "xyz"]
TRUE = {
    "mu": 0.5, "c_mag": 0.3, "c_ang": 0.4, "c_cen": 0.5, "exponent": 0.85, "run_in": 0.8,
    "sheet": 25.0, "floor": 10.0, "soft": 1.0e6, "hard": 3.0e6,
}  # fmt: skip
START = {
    "mu": 0.4, "c_mag": 0.2, "c_ang": 0.3, "c_cen": 0.4, "exponent": 1.0, "run_in": 1.0,
    "sheet": 15.0, "floor": 20.0, "soft": 1.5e6, "hard": 2.0e6,
}  # fmt: skip


def drag(
    mu: float, c_mag: float, c_ang: float, c_cen: float, exponent: float, run_in: float,
    sheet: float, floor: float, soft: float, hard: float,
) -> st.Model:  # fmt: skip
    """The drag test."""
    law = st.TwoTextures(mu, c_mag, c_ang, c_cen).with_power_law(exponent, pressure=5e4)
    law = law.with_exponential(run_in, slip=2e-3)
    ground = st.Plane("ground", texture=st.Uniform((1, 0, 0), turn=floor))
    bodies, pairs = [], []
    for number, (name, cut) in enumerate(CUTS.items()):
        rubber = st.NeoHookean(soft if number % 2 else hard, 0.4)
        mesh = st.block((0.02, 0.02, 0.01), (2, 2, 1), origin=(0.03 * number, 0, 0))
        bodies.append(st.Body(name, mesh, rubber))
        sole = bodies[-1]["zmin"].textured(st.Uniform((1, 0, 0), turn=sheet + cut))
        pairs.append(st.Pair(sole, ground, law, name=name))
    model = st.Model(bodies, [ground], pairs)
    way = {"press": (0, 0, -3e-4), "forth": (4e-3, 0, -3e-4), "aside": (4e-3, 4e-3, -6e-4)}
    for step, (x, y, z) in {**way, "back": (0, 0, -6e-4)}.items():
        model.step(step, *(body["zmax"].displace(x=x, y=y, z=z) for body in bodies), increments=4)
    return model


def forces(run: st.Run) -> np.ndarray:
    """All columns one after the other."""
    return np.concatenate([run.history[column] for column in COLUMNS])


# Measurements, here of pads whose constants are known, with noise of a hundredth of the forces.
measured = forces(drag(**TRUE).run(keep="last"))
error = 0.01 * np.sqrt(np.mean(measured**2))
measured = measured + error * np.random.default_rng(2).normal(size=len(measured))


def linearised(constants: dict[str, float]) -> tuple[np.ndarray, np.ndarray]:
    """Differences of the measurements from a run, and its derivatives by relative changes."""
    run = st.differentiate(drag, constants, keep="last")
    columns = [
        value * np.concatenate([run.gradient(column, name) for column in COLUMNS])
        for name, value in constants.items()
    ]
    return measured - forces(run), np.column_stack(columns)


constants, misfits, jacobian = dict(START), [], np.empty(0)
for iteration in range(12):
    rest, jacobian = linearised(constants)
    misfits.append(float(np.sqrt(np.mean(rest**2))))
    change, *_ = np.linalg.lstsq(jacobian, rest, rcond=None)
    if np.abs(change).max() < 1e-4:
        break
    # No constant changes by more than 40 % at once: far away the linear model is a poor one.
    change *= min(1.0, 0.4 / np.abs(change).max())
    constants = {name: constants[name] * (1 + part) for name, part in zip(constants, change)}

deviation = error * np.sqrt(np.diag(np.linalg.inv(jacobian.T @ jacobian)))
offs = np.array([constants[name] / TRUE[name] - 1 for name in TRUE])
for name, relative, off in zip(TRUE, deviation, offs):
    print(f"{name:8s} {constants[name]:10.4g} +- {100 * relative:4.1f} %, off by {100 * off:5.1f} %")
print(f"root mean square {misfits[-1]:.4f} N of noise of {error:.4f} N; {len(misfits)} runs")
# All ten are within four standard deviations, as 99.9 % of such fits are.
assert np.all(np.abs(offs) < 4 * deviation) and misfits[-1] < 1.05 * error

if "--compare" in sys.argv:
    # Constants over those at the start; the noise bounds how well any of them fit.
    runs = 0

    def residuals(factors: np.ndarray) -> np.ndarray:
        """Differences from the measurements over the noise."""
        global runs
        runs += 1
        at = {name: value * float(factor) for (name, value), factor in zip(START.items(), factors)}
        return np.asarray((forces(drag(**at).run(keep="last")) - measured) / error)

    near = least_squares(residuals, np.ones(10), diff_step=1e-5, xtol=1e-4)
    level = np.sqrt(np.mean(near.fun**2))
    print(f"least squares by differences: {level:.4f} of the noise after {runs} runs")
    runs = 0
    far = minimize(
        lambda x: np.mean(residuals(x) ** 2),
        np.ones(10),
        method="Nelder-Mead",
        options={"maxfev": 1000},
    )
    print(f"Nelder and Mead: {np.sqrt(far.fun):.4f} of the noise after {runs} runs")

figure, (left, right) = pyplot.subplots(1, 2, figsize=(9.0, 3.8), layout="constrained")
numbers = np.arange(1, 17)
fitted = forces(drag(**constants).run(keep="last"))
begun = forces(drag(**START).run(keep="last"))
for at, axis in enumerate("xy"):
    part = slice(16 * at, 16 * (at + 1))
    left.plot(numbers, measured[part], "o", color=f"C{at}", label=f"along {axis}, measured")
    left.plot(numbers, fitted[part], color=f"C{at}", label="found")
    left.plot(numbers, begun[part], ":", color=f"C{at}", label="start")
left.set(xlabel="increment", ylabel="force on pad a (N)", xticks=numbers[3::4])
left.legend(fontsize="x-small", ncols=2)
places = np.arange(len(TRUE))
right.errorbar(100 * offs, places, xerr=200 * deviation, fmt="o", capsize=3)
right.axvline(0, color="0.5", linewidth=1)
right.set(yticks=places, yticklabels=list(TRUE))
right.set_xlabel("found - true, with two standard deviations (%)")
right.invert_yaxis()
right.grid(alpha=0.3)
save(figure, "two_textures")
