"""Tasks of newcomers, as the book has them."""

from __future__ import annotations

import runpy
import shutil
from pathlib import Path

import matplotlib.pyplot
import pytest

TASKS = Path(__file__).parents[3] / "docs" / "book" / "how-to" / "tasks"


def test_the_file_of_a_tribometer_becomes_a_run(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    shutil.copy(TASKS / "tribometer.csv", tmp_path)
    monkeypatch.chdir(tmp_path)
    names = runpy.run_path(str(TASKS / "tribometer.py"))
    # The readings are those of a law with 0.25 along and 0.45 across, with errors.
    fit = names["fit"]
    for name, exact in [("mu_along", 0.25), ("mu_across", 0.45)]:
        low, high = fit.intervals[name]
        assert low < exact < high and high - low < 0.1
    assert set(fit.specimens) == {"left", "middle", "right"}
    # Grooves at 60 degrees: all of the pad slides, along its way.
    along, across = fit.constants["mu_along"], fit.constants["mu_across"]
    x, y, z = names["run"][-1].pair(0).force
    assert -x / z == pytest.approx(across * 0.75 + along * 0.25, rel=0.02)
    assert abs(y / z) == pytest.approx((across - along) * 0.433, rel=0.1)
    assert (tmp_path / "tribometer.gif").stat().st_size > 1000


def test_the_table_of_a_sweep_becomes_a_plot(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "sweep").mkdir()
    columns = "turn,status,reaction.floor.x,reaction.floor.y,reaction.floor.z"
    table = f"{columns}\n0,completed,3,0,-10\n90,completed,2,0.5,-10\n"
    (tmp_path / "sweep" / "sweep.csv").write_text(table)
    monkeypatch.chdir(tmp_path)
    names = runpy.run_path(str(TASKS / "sweep.py"))
    assert list(names["table"]["drag"]) == [0.3, 0.2]
    assert (tmp_path / "sweep.png").stat().st_size > 1000
    matplotlib.pyplot.close("all")
