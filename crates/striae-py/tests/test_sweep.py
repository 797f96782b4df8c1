"""Parameter studies in processes."""

from __future__ import annotations

import os
import pickle
import signal
import subprocess
import sys
import textwrap
import time
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import striae as st

VALUES = {"mu": [0.1, 0.3], "depth": [0.01, 0.02]}


def model_of(mu: float, depth: float) -> st.Model:
    body = st.Body("pad", st.block(divisions=(2, 2, 2)), st.NeoHookean(1e6, 0.3))
    floor = st.Plane("floor")
    model = st.Model([body], [floor], [st.Pair(body["zmin"], floor, st.Coulomb(mu))])
    model.step("press", body["zmax"].displace(x=0, y=0, z=-depth), increments=1)
    model.step("drag", body["zmax"].displace(x=0.3), increments=3)
    return model


def test_processes_give_the_bits_of_this_one(tmp_path: Path) -> None:
    one = st.sweep(model_of, VALUES, keep="all")
    two = st.sweep(lambda mu, depth: model_of(mu, depth), VALUES, workers=2, keep="all", output=tmp_path)
    for here, there in zip(one, two):
        assert here.parameters == there.parameters
        assert here.run.ending == there.run.ending == "completed"
        assert list(here.run.history) == list(there.run.history)
        assert np.array_equal(here.run.history.table, there.run.history.table)
        assert len(here.run) == len(there.run) == 4
        for a, b in zip(here.run, there.run):
            assert (a.number, a.step, a.time, a.iterations) == (b.number, b.step, b.time, b.iterations)
            assert a.energies == b.energies
            assert np.array_equal(a.body("pad").stress, b.body("pad").stress)
            assert np.array_equal(a.pair(0).traction, b.pair(0).traction)
            assert np.array_equal(a.rigid("floor").force, b.rigid("floor").force)
        assert here.run.folder is None and there.run.folder is not None
        assert (there.run.folder / "history.csv").exists()
        top = there.run.model.body("pad")["zmax"]
        further = [run.continue_with(st.Step("on", top.displace(x=0.4))) for run in (here.run, there.run)]
        assert np.array_equal(*[run.history.table for run in further])
    assert [point.run.folder for point in two] == [tmp_path / str(n) for n in range(1, 5)]


def test_columns_of_a_table_keep_their_names() -> None:
    points = st.sweep(model_of, {"mu": [0.1], "depth": [0.01]})
    for name in ("mu", "ending"):
        with pytest.raises(st.ModelError, match=f"{name}: there is a column of that name already"):
            points.to_pandas(**{name: lambda run: run.seconds})


def stuck(force: float) -> st.Model:
    """Nothing holds the block sideways."""
    body, floor = st.Body("pad", st.block(), st.NeoHookean(1e6, 0.3)), st.Plane("floor")
    model = st.Model([body], [floor], [st.Pair(body["zmin"], floor)])
    model.step("push", body["zmax"].pressure(force), increments=1)
    return model


def test_a_run_that_stops_is_among_the_results() -> None:
    here, there = [st.sweep(stuck, {"force": [1.0]}, workers=workers)[0].run for workers in (1, 2)]
    assert here.ending == there.ending == "stopped" and here.reason == there.reason
    with pytest.raises(RuntimeError):
        there.continue_with(st.Step("on"))


@pytest.mark.parametrize("workers", [1, 2])
def test_errors_have_their_parameters(workers: int) -> None:
    with pytest.raises(st.SweepError) as caught:
        st.sweep(lambda mu: model_of(mu, 0.01), {"mu": [0.1, -0.1]}, workers=workers)
    assert caught.value.parameters == {"mu": -0.1}
    assert isinstance(caught.value.__cause__, st.ModelError)
    assert str(caught.value).startswith("with mu = -0.1: Coulomb: mu = -0.1 is refused")
    again = pickle.loads(pickle.dumps(caught.value))
    assert str(again) == str(caught.value) and again.parameters == {"mu": -0.1}


def test_errors_of_other_processes_are_carried_over(tmp_path: Path) -> None:
    """The folder of results of an earlier run is not overwritten."""
    st.sweep(model_of, {"mu": [0.1], "depth": [0.01]}, workers=2, output=tmp_path)
    with pytest.raises(st.SweepError, match="with mu = 0.2, depth = 0.01: .*holds the results of") as caught:
        st.sweep(model_of, {"mu": [0.2], "depth": [0.01]}, workers=2, output=tmp_path)
    assert isinstance(caught.value.__cause__, RuntimeError)


def test_warnings_name_their_parameters() -> None:
    def far(height: float) -> st.Model:
        body = st.Body("pad", st.block(), st.NeoHookean(1e6, 0.3))
        floor = st.Plane("floor", point=(0, 0, -height))
        model = st.Model([body], [floor], [st.Pair(body["zmin"], floor)])
        model.step("hold", body["zmax"].hold(), increments=1)
        return model

    for workers in (1, 2):
        with pytest.warns(st.RunWarning, match="height = 2.0: "):
            st.sweep(far, {"height": [2.0]}, workers=workers)


def elastic(F: Any) -> Any:
    """Compressible neo-Hookean, as in the tests of functions."""
    from test_functions import neo_hookean

    return neo_hookean(F)


def own(depth: float) -> st.Model:
    body = st.Body("pad", st.block(), st.OwnMaterial(elastic))
    model = st.Model([body])
    model.step("press", body["zmin"].hold(), body["zmax"].displace(z=-depth), increments=1)
    return model


def test_functions_of_python_go_to_processes_by_their_module() -> None:
    here, there = [st.sweep(own, {"depth": [0.01]}, workers=workers)[0].run for workers in (1, 2)]
    assert np.array_equal(here.history.table, there.history.table)
    with pytest.raises(st.SweepError, match="the processes must import it from a module"):
        st.sweep(lambda depth: own(depth), {"depth": [0.01]}, workers=2)


SCRIPT = """
    import sys
    import striae as st

    def model_of(mu):
        body = st.Body("pad", st.block(divisions=(6, 6, 6)), st.NeoHookean(1e6, 0.3))
        floor = st.Plane("floor")
        model = st.Model([body], [floor], [st.Pair(body["zmin"], floor, st.Coulomb(mu))])
        model.step("press", body["zmax"].displace(x=0, y=0, z=-0.02), increments=4)
        model.step("drag", body["zmax"].displace(x=2), increments=5000)
        print("made", flush=True)
        return model

    try:
        st.sweep(model_of, {"mu": [0.1, 0.2, 0.3]}, workers=2)
    except KeyboardInterrupt:
        print("interrupted", flush=True)
        sys.exit(3)
"""


@pytest.mark.skipif(os.name == "nt", reason="sends a signal to a group of processes")
def test_ctrl_c_ends_all_processes(tmp_path: Path) -> None:
    """A script without a guard; the keyboard's signal goes to the whole group."""
    script = tmp_path / "script.py"
    script.write_text(textwrap.dedent(SCRIPT))
    where = {**os.environ, "TMPDIR": str(tmp_path)}
    process = subprocess.Popen(
        [sys.executable, script], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
        start_new_session=True, env=where,
    )  # fmt: skip
    assert process.stdout is not None
    assert [process.stdout.readline() for _ in range(3)] == 3 * ["made\n"]
    time.sleep(1.5)
    os.killpg(process.pid, signal.SIGINT)
    out, errors = process.communicate(timeout=30)
    assert (process.returncode, out, errors) == (3, "interrupted\n", "")
    with pytest.raises(ProcessLookupError):
        os.killpg(process.pid, 0)
    assert not list(tmp_path.glob("striae-*"))
