"""Friction laws of a snake's belly and of a spider's pads, from published measurements.

The files beside the book say where the numbers come from and how sure they are.
"""

from pathlib import Path

import numpy as np
import striae as st
from matplotlib import pyplot
from picture import save

BOOK = Path(__file__).parents[3] / "docs" / "book" / "how-to" / "measurements"

# A snake: three coefficients and the symmetry of both sides are four readings of a nap.
read = st.read_measurements(BOOK / "snake-skin.csv")
snake = st.fit_friction(read.angles, read.forces, st.Nap)
print("snake", {name: round(value, 4) for name, value in snake.constants.items()})

# A spider: 282 readings in two directions. Each direction has its coefficient and interval.
read = st.read_measurements(BOOK / "spider-pads.csv")
angles, friction, legs = read.angles, read.forces, np.array(read.specimen)
found = {}
for name, angle in [("pulled", 0.0), ("pushed", 180.0)]:
    here = angles == angle
    fit = st.fit_friction(angles[here], friction[here], st.Coulomb, specimen=legs[here])
    found[name] = fit.constants["mu"]
    low, high = fit.intervals["mu"] or (np.nan, np.nan)
    print(f"spider {name}: {found[name]:.4f}, 95 % within {low:.4f} .. {high:.4f}")

# Sideways nothing is known from these readings: the mean of both is an assumption.
sideways = 0.5 * (found["pulled"] + found["pushed"])
spider = st.Nap(mu_forward=found["pushed"], mu_backward=found["pulled"], mu_lateral=sideways)

figure, (left, right) = pyplot.subplots(1, 2, figsize=(11.0, 4.5), layout="constrained")
snake.plot(left).set_title("belly of a milk snake on cloth (Hu et al. 2009)", fontsize="small")
scatter = 3.0 * np.random.default_rng(1).standard_normal(len(angles))
right.plot(angles + scatter, friction, ".", alpha=0.4, label="measured (directions spread)")
law = spider.slip_surface()
order = np.argsort(law.slip_angle % 360.0)
right.plot((law.slip_angle % 360.0)[order], law.dissipation[order], label="law")
right.set(ylim=(0.0, None), xlabel="direction of slip (degrees)")
right.set_title("claw tufts of a spider on glass (Wolff and Gorb 2013)", fontsize="small")
right.legend(fontsize="small")
right.grid(alpha=0.3)
save(figure, "measured_friction")
forward, backward, lateral = snake.constants.values()
assert lateral > backward > forward
