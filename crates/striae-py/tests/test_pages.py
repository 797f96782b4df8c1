"""The pieces of Python in the README and in the book run as they are printed."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import pytest
import striae as st

ROOT = Path(__file__).parents[3]
PAGES = ["README.md", "docs/book/how-to/python.md"]


def small(mu: float) -> st.Model:
    body = st.Body("pad", st.block(), st.NeoHookean(1e6, 0.3))
    floor = st.Plane("floor")
    model = st.Model([body], [floor], [st.Pair(body["zmin"], floor, st.Coulomb(mu))])
    model.step("press", body["zmax"].displace(x=0, y=0, z=-0.01), increments=1)
    return model


@pytest.mark.parametrize("page", PAGES)
def test_what_is_printed_runs(page: str, capsys: pytest.CaptureFixture[str]) -> None:
    pieces = re.findall(r"```python\n(.*?)```", (ROOT / page).read_text(), re.DOTALL)
    assert pieces
    names: dict[str, Any] = {"st": st, "model_of": small}
    for piece in pieces:
        exec(compile(piece, page, "exec"), names)
    run = names["run"]
    assert run.ending == "completed"
    assert len(capsys.readouterr().out.splitlines()) == len(run.history["time"])
