"""Models that several tests run."""

from __future__ import annotations

import signal

import matplotlib
import pytest
import striae as st

matplotlib.use("Agg")
# A shell's job in the background is started with interrupts ignored, and so are its programs.
signal.signal(signal.SIGINT, signal.default_int_handler)


@pytest.fixture
def rubber() -> st.NeoHookean:
    return st.NeoHookean(youngs_modulus=1e6, poissons_ratio=0.3)


@pytest.fixture
def pad(rubber: st.NeoHookean) -> st.Body:
    return st.Body("pad", st.block(divisions=(2, 2, 2)), rubber)


@pytest.fixture
def floor() -> st.Plane:
    return st.Plane("floor", texture=(1, 0, 0))


@pytest.fixture
def model(pad: st.Body, floor: st.Plane) -> st.Model:
    """A block pressed onto a grooved floor and dragged across the grooves."""
    law = st.Orthotropic(mu_along=0.1, mu_across=0.4)
    model = st.Model([pad], [floor], [st.Pair(pad["zmin"], floor, law)], title="pad")
    model.step("press", pad["zmax"].displace(x=0, y=0, z=-0.02), increments=2)
    model.step("drag", pad["zmax"].displace(y=0.3), increments=5)
    return model
