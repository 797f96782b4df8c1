"""Tries the installed wheel where there is nothing else: ``python -I crates/striae-py/alone.py``."""

import shutil
import tempfile
from pathlib import Path

import striae as st


def main() -> None:
    """Runs a model and writes what is written of it."""
    foam = st.NeoHookean(youngs_modulus=1e6, poissons_ratio=0.3)
    block = st.Body("block", st.block(divisions=(2, 2, 2)), foam)
    floor = st.Plane("floor", texture=(1, 1, 0))
    sole = st.Pair(block["zmin"], floor, st.Orthotropic(mu_along=0.1, mu_across=0.4))
    model = st.Model([block], [floor], [sole])
    model.step("press", block["zmax"].displace(x=0, y=0, z=-0.02), increments=2)
    model.step("drag", block["zmax"].displace(x=0.5), increments=4)
    run = model.run()
    assert run.ending == "completed" and run[-1].pair(0).force[2] > 0
    with tempfile.TemporaryDirectory() as place:
        run.report(Path(place, "report.html"))
        run.animate(Path(place, "run.gif"))
        assert all(path.stat().st_size > 0 for path in Path(place).iterdir())
    assert run._repr_html_() is not None
    rust = shutil.which("cargo") or "no Rust"
    print(f"striae from {Path(st.__file__).parent}, {rust}: all well")


if __name__ == "__main__":
    main()
