"""Overhead of an empty callback: ``python crates/striae-py/overhead.py``.

A model is run with and without a callback in turn, with one thread. Compared are processor times,
the smallest of several runs of each kind, as other programs can only add to them; runs are
repeated, up to a limit, until the overhead is below the bound. Ends with 1 above 2 %.
"""

import sys
import time

import striae as st

LEAST, MOST = 7, 40
LARGEST = 0.02

rubber = st.NeoHookean(youngs_modulus=1e6, poissons_ratio=0.3)
body = st.Body("pad", st.block(divisions=(6, 6, 6)), rubber)
floor = st.Plane("floor")
model = st.Model([body], [floor], [st.Pair(body["zmin"], floor, st.Coulomb(0.3))])
model.step("press", body["zmax"].displace(x=0, y=0, z=-0.02), increments=5)
model.step("drag", body["zmax"].displace(x=0.2), increments=25)


def seconds(callback: bool) -> float:
    """Processor time of a run."""
    begun = time.process_time()
    if callback:
        model.run(lambda increment: None, threads=1)
    else:
        model.run(threads=1)
    return time.process_time() - begun


times: list[tuple[float, float]] = []
overhead = LARGEST + 1
while len(times) < LEAST or (overhead > LARGEST and len(times) < MOST):
    times.append((seconds(False), seconds(True)))
    without, with_callback = (min(one) for one in zip(*times))
    overhead = with_callback / without - 1
print(f"30 increments, {len(times)} pairs of runs: {without:.3f} s, {with_callback:.3f} s with it")
print(f"overhead of an empty callback {100 * overhead:+.2f} %, at most {100 * LARGEST:.0f} % allowed")
sys.exit(overhead > LARGEST)
