"""Constants of friction and rubber from the force of a drag test. Units: m, N, Pa."""

import numpy as np
import striae as st
from matplotlib import pyplot
from picture import save

COLUMN = "pair.sole.resultant_a.x"


def drag(mu: float, modulus: float) -> st.Model:
    """A pad is pressed onto a floor and dragged."""
    pad = st.Body("pad", st.block(size=(0.04, 0.02, 0.01), divisions=(8, 4, 2)), st.NeoHookean(modulus, 0.45))
    floor = st.Plane("floor")
    model = st.Model([pad], [floor], [st.Pair(pad["zmin"], floor, st.Coulomb(mu), name="sole")])
    model.step("press", pad["zmax"].displace(x=0, y=0, z=-5e-4), increments=2)
    model.step("drag", pad["zmax"].displace(x=4e-3), increments=8)
    return model


# Measurements, here of a pad whose constants are known, with noise of one per cent.
noise = np.random.default_rng(1).normal(size=10)
measured = drag(mu=0.6, modulus=1.8e6).run().history[COLUMN] * (1 + 0.01 * noise)
way = np.concatenate([[0.0, 0.0], np.linspace(0.5, 4.0, 8)])


def linearised(constants: dict[str, float]) -> tuple[np.ndarray, np.ndarray]:
    """Differences of the measurements from a run, and its derivatives by relative changes."""
    run = st.differentiate(drag, constants, keep="last")
    columns = [value * run.gradient(COLUMN, name) for name, value in constants.items()]
    return measured - run.history[COLUMN], np.column_stack(columns)


constants = {"mu": 0.4, "modulus": 1e6}
figure, axes = pyplot.subplots(figsize=(5.5, 3.8), layout="constrained")
for iteration in range(6):
    rest, jacobian = linearised(constants)
    if iteration in (0, 1, 5):
        axes.plot(way, rest - measured, color=f"C{iteration % 3}", label=f"run {iteration + 1}")
    print(iteration, constants, f"root mean square {np.sqrt(np.mean(rest**2)):.3f} N")
    change, *_ = np.linalg.lstsq(jacobian, rest, rcond=None)
    constants = {name: value * (1 + part) for (name, value), part in zip(constants.items(), change)}

# Standard deviations, from the scatter of the measurements around the fit.
rest, jacobian = linearised(constants)
variance = rest @ rest / (len(rest) - len(constants))
deviation = np.sqrt(variance * np.diag(np.linalg.inv(jacobian.T @ jacobian)))
for (name, value), relative in zip(constants.items(), deviation):
    print(f"{name} = {value:.4g} +- {100 * relative:.1f} %")
assert abs(constants["mu"] / 0.6 - 1) < 0.02 and abs(constants["modulus"] / 1.8e6 - 1) < 0.02

axes.plot(way, -measured, "o", color="0.3", label="measured")
axes.set(xlabel="way (mm)", ylabel="force of the drag (N)")
axes.legend()
axes.grid(alpha=0.3)
save(figure, "identification")
