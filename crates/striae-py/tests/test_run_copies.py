"""Runs as pickles and as datasets."""

from __future__ import annotations

import copy
import pickle
import sys
from pathlib import Path

import numpy as np
import pytest
import striae as st
from test_functions import neo_hookean


def assert_same(one: st.Run, other: st.Run) -> None:
    assert (one.ending, one.reason, one.warnings) == (other.ending, other.reason, other.warnings)
    assert list(one.history) == list(other.history)
    assert np.array_equal(one.history.table, other.history.table)
    assert [i.number for i in one] == [i.number for i in other]
    for a, b in zip(one, other):
        assert (a.time, a.step, a.fraction, a.iterations) == (b.time, b.step, b.fraction, b.iterations)
        assert a.energies == b.energies
        for name in ("displacement", "stress", "contact_force", "reaction"):
            assert np.array_equal(getattr(a.body("pad"), name), getattr(b.body("pad"), name)), name
        for name in ("pressure", "gap", "slip", "traction", "status"):
            assert np.array_equal(getattr(a.pair(0), name), getattr(b.pair(0), name)), name
        assert np.array_equal(a.rigid("floor").force, b.rigid("floor").force)


@pytest.mark.parametrize("keep", ["all", "steps"])
def test_a_run_is_pickled_to_the_bit(model: st.Model, keep: str) -> None:
    run = model.run(keep=keep)
    assert_same(run, pickle.loads(pickle.dumps(run)))
    assert_same(run, copy.deepcopy(run))


def test_an_unpickled_run_is_one(model: st.Model, pad: st.Body, tmp_path: Path) -> None:
    run = model.run(keep="all", output=tmp_path / "results")
    again = pickle.loads(pickle.dumps(run))
    assert again.folder == run.folder and again.seconds == run.seconds
    back = st.Step("back", pad["zmax"].displace(y=0.0), increments=2)
    assert_same(run.continue_with(back), again.continue_with(back))
    for one, name in ((run, "a.html"), (again, "b.html")):
        one.report(tmp_path / name)
    assert (tmp_path / "a.html").read_bytes() == (tmp_path / "b.html").read_bytes()
    stopped = model.run(lambda i: i.number < 3)
    assert pickle.loads(pickle.dumps(stopped)).ending == "interrupted"


def test_a_run_keeps_the_model_that_was_run(model: st.Model, pad: st.Body) -> None:
    run = model.run()
    back = st.Step("back", pad["zmax"].displace(y=0.0), increments=2)
    before = pickle.dumps(run)
    pad.add_set("low", lambda x: x[:, 2] < 0.1)
    model.step("slippery", model.change_friction(0, st.Frictionless()), increments=2)
    assert run.model.step_names == ["press", "drag"] and run.model.last_run is run
    assert "low" not in run.model.body("pad").mesh.node_sets
    again = pickle.loads(pickle.dumps(run))
    assert_same(run, again)
    assert_same(run.continue_with(back), again.continue_with(back))
    assert_same(pickle.loads(before).continue_with(back), again.continue_with(back))
    model.step("press")
    with pytest.raises(st.ModelError, match="`press` is already defined"):
        model.check()
    assert_same(run, pickle.loads(pickle.dumps(run)))


def test_results_keep_the_pairs_that_were_run(rubber: st.NeoHookean) -> None:
    low = st.Body("low", st.block(divisions=(1, 1, 1)), rubber)
    high = st.Body("high", st.block(divisions=(1, 1, 1), origin=(0, 0, 1)), rubber)
    model = st.Model([low, high], [st.Plane("floor")])
    model.contact_all(st.Coulomb(0.3))
    model.step("press", high["zmax"].displace(x=0, y=0, z=-0.01), increments=1)
    run = model.run()
    pressed = run[-1].pair("low-floor").force
    model.contact_all(st.Coulomb(0.3), exclude=[("low", "low"), ("high", "high")])
    assert model.pair_names != run.model.pair_names
    assert np.array_equal(run[-1].pair("low-floor").force, pressed) and pressed[2] > 0
    assert [pair.name for pair in run[-1].pairs] == run.model.pair_names
    # Of pairs that may touch, those that do have columns.
    assert "pair.low-floor.resultant_a.z" in run.history
    assert "pair.high-floor.resultant_a.z" not in run.history


def test_a_run_whose_model_calls_functions_is_not_pickled(floor: st.Plane) -> None:
    own = st.OwnMaterial(neo_hookean)
    body = st.Body("pad", st.block(divisions=(1, 1, 1)), own)
    model = st.Model([body], [floor], [st.Pair(body["zmin"], floor)])
    model.step("press", body["zmax"].displace(x=0, y=0, z=-0.01), increments=1)
    run = model.run()
    with pytest.raises(st.ModelError):
        pickle.dumps(run)


def test_a_run_becomes_a_dataset(model: st.Model) -> None:
    run = model.run()
    data = run.to_xarray()
    assert data.attrs == {"title": "pad", "ending": "completed"}
    assert data["increment"].values.tolist() == list(range(1, 8))
    assert data["step"].values.tolist() == ["press", "drag"] and data["state"].values.tolist() == [2, 7]
    column = "pair.pad-floor.resultant_a.z"
    assert np.array_equal(data[column], run.history[column])
    assert np.array_equal(data["history.time"], run.history["time"])
    last = data.isel(state=-1)
    assert np.array_equal(last["pad.displacement"], run[-1].body("pad").displacement)
    assert last["pad.stress"].dims == ("pad.node", "axis", "along")
    assert np.array_equal(last["pad-floor.a.pressure"], run[-1].pair(0).pressure)
    assert np.array_equal(data["pad-floor.a.node"], run[-1].pair(0).nodes)
    assert "pad-floor.b.pressure" not in data
    assert float(data["pad.displacement"].sel(axis="z").min()) == run[-1].body("pad").displacement[:, 2].min()


def test_a_missing_xarray_is_named(model: st.Model, monkeypatch: pytest.MonkeyPatch) -> None:
    run = model.run()
    monkeypatch.setitem(sys.modules, "xarray", None)
    with pytest.raises(ImportError, match=r"needs xarray, which `pip install striae\[xarray\]`"):
        run.to_xarray()
