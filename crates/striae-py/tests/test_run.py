"""Runs, their results and histories."""

from __future__ import annotations

import _thread
import csv
import os
import subprocess
import sys
import threading
import time
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import striae as st

ROOT = Path(__file__).parents[3]


def test_friction_across_the_grooves_is_that_of_the_law(model: st.Model) -> None:
    run = model.run(keep="all")
    assert run.ending == "completed" and run.reason == "all steps completed"
    force = run[-1].pair(0).force
    assert force[1] / force[2] == pytest.approx(-0.4, abs=1e-3)
    assert np.allclose(run[-1].pair("pad-floor").force_b, -force)
    assert run[-1].step == "drag" and run[1].step == "press"
    assert [increment.number for increment in run] == list(range(1, 8))
    assert run[-1].rigid("floor").force == pytest.approx(-run[-1].pair(0).force_b, rel=1e-9)


def test_results_agree_with_each_other(model: st.Model, pad: st.Body) -> None:
    end = model.run()[-1]
    body, pair = end.body("pad"), end.pair(0)
    assert np.allclose(body.position - pad.mesh.points, body.displacement, atol=1e-15)
    assert np.allclose(body.contact_force.sum(axis=0), pair.force)
    assert np.allclose(end.reaction("pad", "zmax"), -pair.force, rtol=1e-6, atol=1e-3)
    assert body.stress.shape == (27, 3, 3)
    assert np.allclose(body.stress, body.stress.transpose(0, 2, 1))
    s = body.stress - np.trace(body.stress, axis1=1, axis2=2)[:, None, None] * np.eye(3) / 3
    assert np.allclose(body.von_mises, np.sqrt(1.5 * (s * s).sum(axis=(1, 2))))
    assert np.array_equal(pair.position, body.position[pair.nodes])
    assert np.allclose(pair.traction, pair.friction - pair.pressure[:, None] * pair.a.normal)
    slips = pair.status == st.Status.SLIP
    assert slips.sum() >= 8 and (slips | (pair.gap > 0)).all()
    assert np.allclose(pair.slip[slips, 1], 0.06, atol=0.01)
    assert np.allclose(np.abs(pair.a.texture), 0)  # It is the floor that has a texture.
    assert pair.a.facets.max() == len(pair.nodes) - 1
    with pytest.raises(AttributeError, match="a rigid side has no results at nodes"):
        pair.b.pressure
    assert end.energies.friction > 0 and abs(end.energies.imbalance) < 1e-6


def test_arrays_are_made_once_and_not_written_to(model: st.Model, pad: st.Body) -> None:
    run = model.run()
    end = run[-1]
    arrays = [
        end.body("pad").displacement,
        end.body("pad").stress,
        end.pair(0).traction,
        end.pair(0).force,
        end.rigid("floor").force,
        run.history["time"],
        pad.mesh.points,
        pad.mesh.node_sets["zmin"],
    ]
    for array in arrays:
        with pytest.raises(ValueError, match="read-only"):
            array[...] = 0
    assert end.body("pad").displacement is end.body("pad").displacement
    assert end.pair(0).traction is end.pair(0).traction
    assert np.shares_memory(run.history["time"], run.history.table)
    assert pad.mesh.points is pad.mesh.points


def test_an_array_outlives_its_run(model: st.Model) -> None:
    stress = model.run()[-1].body("pad").stress
    copied = stress.copy()
    for _ in range(3):
        model.run(keep="last")
    assert np.array_equal(stress, copied)


@pytest.mark.parametrize(
    "keep, numbers", [("steps", [2, 7]), ("all", list(range(1, 8))), ("last", [7]), (3, [3, 6, 7])]
)
def test_states_are_kept_by_choice(model: st.Model, keep: str, numbers: list[int]) -> None:
    assert [increment.number for increment in model.run(keep=keep)] == numbers
    if keep == "steps":
        assert [increment.number for increment in model.run()] == numbers


def test_the_history_is_a_table(model: st.Model) -> None:
    history = model.run().history
    assert history["increment"].tolist() == list(range(1, 8))
    assert list(history)[:3] == ["increment", "step", "time"]
    frame = history.to_pandas()
    assert frame.shape == history.table.shape
    assert frame["pair.pad-floor.resultant_a.z"].iloc[-1] == pytest.approx(
        history["pair.pad-floor.resultant_a.z"][-1]
    )
    with pytest.raises(KeyError, match="no column is named `resultant_a.z`; similar are"):
        history["resultant_a.z"]
    listed: Any = ["time"]
    for wrong in [history.__getitem__, history.plot]:
        with pytest.raises(KeyError, match=r"by its name, a string, not by \['time'\]"):
            wrong(listed)


def test_the_callback_sees_each_increment_and_stops_the_run(model: st.Model) -> None:
    seen: list[tuple[int, float]] = []

    def told(increment: st.Increment) -> bool:
        seen.append((increment.number, float(increment.pair(0).force[2])))
        assert threading.current_thread() is threading.main_thread()
        return increment.number < 3

    run = model.run(told, keep="all")
    assert [number for number, _ in seen] == [1, 2, 3]
    assert run.ending == "interrupted" and len(run) == 3
    assert seen[-1][1] == run[-1].pair(0).force[2]


def test_an_exception_of_the_callback_ends_the_run(model: st.Model, tmp_path: Path) -> None:
    def told(increment: st.Increment) -> None:
        if increment.number == 2:
            raise ZeroDivisionError("of my own")

    with pytest.raises(ZeroDivisionError, match="of my own"):
        model.run(told, output=tmp_path, keep="all")
    assert model.last_run is not None and len(model.last_run) == 2
    assert len((tmp_path / "history.csv").read_text().splitlines()) == 3


def test_ctrl_c_ends_the_run_with_its_results_on_disk(tmp_path: Path, rubber: st.NeoHookean) -> None:
    body = st.Body("pad", st.block(divisions=(6, 6, 6)), rubber)
    floor = st.Plane("floor")
    model = st.Model([body], [floor], [st.Pair(body["zmin"], floor, st.Coulomb(0.3))])
    model.step("press", body["zmax"].displace(x=0, y=0, z=-0.02), increments=4)
    model.step("drag", body["zmax"].displace(x=2), increments=5000)
    threading.Timer(1.5, _thread.interrupt_main).start()
    begun = time.monotonic()
    with pytest.raises(KeyboardInterrupt) as caught:
        model.run(output=tmp_path, fields_every=0, keep="last")
    assert time.monotonic() - begun < 30
    stopped = caught.value
    assert isinstance(stopped, st.RunInterrupted)
    assert stopped.run.ending == "interrupted" and len(stopped.run) == 1
    rows = (tmp_path / "history.csv").read_text().splitlines()
    assert len(rows) == 1 + stopped.run[-1].number
    assert (tmp_path / "summary.json").exists()


def test_other_threads_go_on_while_a_run_computes(rubber: st.NeoHookean) -> None:
    body = st.Body("pad", st.block(divisions=(8, 8, 8)), rubber)
    floor = st.Plane("floor")
    model = st.Model([body], [floor], [st.Pair(body["zmin"], floor)])
    model.step("press", body["zmax"].displace(x=0, y=0, z=-0.05), increments=5)
    count, done = 0, threading.Event()

    def counts() -> None:
        nonlocal count
        while not done.is_set():
            count += 1
            time.sleep(1e-3)

    counter = threading.Thread(target=counts)
    counter.start()
    begun = time.monotonic()
    model.run()
    seconds = time.monotonic() - begun
    done.set()
    counter.join()
    assert count > 0.05 * seconds / 1e-3, f"{count} in {seconds} s"


def test_a_model_is_not_changed_while_it_runs(model: st.Model, pad: st.Body) -> None:
    def told(increment: st.Increment) -> None:
        model.step("late", pad["zmax"].displace(z=0))

    with pytest.raises(RuntimeError) as caught:
        model.run(told)
    assert str(caught.value) == "the model is running; change it when the run has ended"
    with pytest.raises(RuntimeError, match="the model is running"):
        model.run(lambda increment: model.contact_all())
    model.step("late", pad["zmax"].displace(z=0))
    assert model.step_names == ["press", "drag", "late"]


def test_two_blocks_has_the_bits_of_the_program(tmp_path: Path) -> None:
    deck = ROOT / "cases" / "two-blocks" / "deck.toml"
    run = st.Model.from_deck(deck).run(output=tmp_path / "deck", fields_every=0, threads=1)

    stiff = st.NeoHookean(youngs_modulus=1e7, poissons_ratio=0.3)
    soft = st.NeoHookean(youngs_modulus=1e6, poissons_ratio=0.3)
    lower = st.Body("lower", st.block((1, 1, 0.5), (4, 4, 2)), stiff)
    upper = st.block((0.6, 0.6, 0.5), (3, 3, 2), origin=(0.2, 0.2, 0.5))
    # From arrays and masks instead of the generator.
    mesh = st.Mesh(
        upper.points,
        upper.cells,
        node_sets={"zmax": upper.node_sets["zmax"]},
        facet_sets={"zmin": lambda x: np.isclose(x[:, 2], 0.5)},
    )
    top = st.Body("upper", mesh, soft)
    pair = st.Pair(lower["zmax"], top["zmin"], st.Coulomb(0.3), name="interface")
    model = st.Model([lower, top], pairs=[pair])
    press = top["zmax"].displace(x=0, y=0, z=-0.02)
    model.step("press", lower["zmin"].hold(), press, increments=10)
    model.step("slide", top["zmax"].displace(x=0.05), increments=10)
    built = model.run(threads=2)
    common = [name for name in run.history if not name.startswith("reaction.upper")]
    for name in common:
        assert np.array_equal(run.history[name], built.history[name]), name

    target = Path(os.environ.get("CARGO_TARGET_DIR", "target"))
    program = ROOT / target / "release" / "striae"
    assert program.exists(), "build the program: cargo build --release -p striae-cli"
    out = tmp_path / "program"
    subprocess.run([program, "run", deck, "--out", out, "--quiet"], check=True, capture_output=True)
    assert (out / "history.csv").read_bytes() == (tmp_path / "deck" / "history.csv").read_bytes()


def test_a_recorded_run_of_a_deck_is_resumed_to_the_same_history(tmp_path: Path) -> None:
    model = st.Model.from_deck(ROOT / "cases" / "two-blocks" / "deck.toml")
    whole = model.run(output=tmp_path / "whole", fields_every=0, keep="all")
    stopped = model.run(lambda i: i.number < 7, output=tmp_path / "pieces", fields_every=0)
    assert stopped.ending == "interrupted"
    seen: list[str] = []
    rest = st.resume(tmp_path / "pieces", on_increment=lambda i: seen.append(i.step))
    fields = [sorted(p.name for p in (tmp_path / f / "fields").iterdir()) for f in ("pieces", "whole")]
    assert fields[0] == fields[1]
    assert len(seen) == len(whole) - 7 and seen[-1] == "slide"
    assert np.array_equal(rest.history.table, whole.history.table)
    with pytest.raises(RuntimeError, match="completed run; to continue it"):
        st.resume(tmp_path / "whole")


def test_a_run_is_continued_with_further_steps(model: st.Model, pad: st.Body) -> None:
    first = model.run()
    back = st.Step("back", pad["zmax"].displace(y=0.0), increments=4)
    seen: list[str] = []
    second = first.continue_with(back, on_increment=lambda i: seen.append(i.step), keep="all")
    assert seen == ["back"] * 4
    assert second[0].number == 8 and second[-1].time == 3.0
    assert second.model.step_names == ["press", "drag", "back"]
    model.step("back", pad["zmax"].displace(y=0.0), increments=4)
    whole = model.run()
    assert np.allclose(second[-1].pair(0).force, whole[-1].pair(0).force, rtol=1e-8)
    again = second.model.run()
    assert np.array_equal(again.history.table, whole.history.table)


def test_a_deck_takes_further_steps() -> None:
    model = st.Model.from_deck(ROOT / "cases" / "two-blocks" / "deck.toml")
    upper = model.body("upper")
    back = [upper["zmax"].displace(x=0), model.change_friction("interface", st.Frictionless())]
    model.step("back", *back, increments=5)
    run = model.run(keep="steps")
    assert [increment.step for increment in run] == ["press", "slide", "back"]
    assert np.abs(run[-1].pair("interface").friction).max() == 0


def test_a_run_that_cannot_reach_its_end_says_why(pad: st.Body, floor: st.Plane) -> None:
    model = st.Model([pad], [floor], [st.Pair(pad["zmin"], floor)])
    model.step("push", pad["zmax"].pressure(1e3))
    with pytest.raises(st.RunStopped, match="step `push` stopped at time 0") as caught:
        model.run()
    assert caught.value.run.ending == "stopped"
    assert model.run(on_stop="return").reason == str(caught.value)


def test_a_sweep_runs_all_combinations(rubber: st.NeoHookean) -> None:
    def model_of(mu: float, depth: float) -> st.Model:
        body = st.Body("pad", st.block(divisions=(2, 2, 2)), rubber)
        floor = st.Plane("floor")
        model = st.Model([body], [floor], [st.Pair(body["zmin"], floor, st.Coulomb(mu))])
        model.step("press", body["zmax"].displace(x=0, y=0, z=-depth), increments=1)
        model.step("drag", body["zmax"].displace(x=0.3), increments=3)
        return model

    def ratio(run: st.Run) -> float:
        force = run[-1].pair(0).force
        return float(-force[0] / force[2])

    values = {"mu": [0.1, 0.3], "depth": [0.01, 0.02]}
    one, two = (st.sweep(model_of, values, workers=workers) for workers in (1, 2))
    assert [point.parameters for point in two][1] == {"mu": 0.1, "depth": 0.02}
    assert np.allclose(two.values(ratio), [0.1, 0.1, 0.3, 0.3], atol=1e-6)
    assert np.array_equal(one.values(ratio), two.values(ratio))
    frame = two.to_pandas(ratio=ratio)
    assert list(frame.columns) == ["mu", "depth", "ending", "ratio"]
    assert (frame["ending"] == "completed").all()


def test_files_are_those_of_the_program(model: st.Model, tmp_path: Path) -> None:
    run = model.run(output=tmp_path, case="mine", fields_every=2)
    names = {path.name for path in tmp_path.iterdir()}
    assert {"history.csv", "summary.json", "bodies.pvd", "contact.pvd", "fields"} <= names
    with open(tmp_path / "history.csv", newline="") as file:
        rows = list(csv.reader(file))
    assert np.array_equal(np.array(rows[1:], dtype=float), run.history.table)
    assert '"case": "mine"' in (tmp_path / "summary.json").read_text()


def test_files_and_reports_can_be_had_afterwards(
    model: st.Model, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Files are those of a run that was written on the way."""
    written = model.run(output=tmp_path / "on the way", case="pad")
    run = model.run(keep="all")
    assert run.folder is None and written.folder == tmp_path / "on the way"
    run.report(tmp_path / "early.html")
    assert run.folder is None
    run.write(tmp_path / "later")
    assert run.folder == tmp_path / "later"
    names = sorted(str(p.relative_to(run.folder)) for p in run.folder.rglob("*") if p.is_file())
    expected = sorted(str(p.relative_to(written.folder)) for p in written.folder.rglob("*") if p.is_file())
    assert expected == names
    for name in names:
        if name != "summary.json":
            assert (run.folder / name).read_bytes() == (written.folder / name).read_bytes(), name
    for one in (run, written):
        one.report(tmp_path / "report.html")
        page = (tmp_path / "report.html").read_text()
        assert page.startswith("<!DOCTYPE html>") and "pad-floor" in page
    few = model.run()
    with monkeypatch.context() as place:
        place.chdir(tmp_path)
        few.write("few")
    assert few.folder == tmp_path / "few"
    assert (tmp_path / "few" / "history.csv").read_bytes() == (written.folder / "history.csv").read_bytes()
    fields = sorted((tmp_path / "few" / "fields").glob("pad-*.vtu"))
    assert [path.name for path in fields] == [f"pad-0000{n}.vtu" for n in range(3)]
    for path, number in zip(fields, (0, 2, 7)):
        assert path.read_bytes() == (written.folder / "fields" / f"pad-0000{number}.vtu").read_bytes()
    model.run(keep="last").report(tmp_path / "last.html")
    with pytest.raises(RuntimeError, match="holds the results of an earlier run"):
        run.write(tmp_path / "on the way")
    back = st.Step("back", model.body("pad")["zmax"].displace(y=0), increments=2)
    run.continue_with(back).report(tmp_path / "back.html")


def test_warnings_of_a_run_are_warnings(rubber: st.NeoHookean) -> None:
    pad = st.Body("pad", st.block(divisions=(1, 1, 1)), rubber)
    floor = st.Plane("floor", point=(0, 0, -1))
    model = st.Model([pad], [floor], [st.Pair(pad["zmin"], floor)])
    model.step("hold", pad["zmax"].hold(), increments=1)
    with pytest.warns(st.RunWarning):
        run = model.run()
    assert run.warnings


EXAMPLES = sorted((ROOT / "crates" / "striae-py" / "examples").glob("*.py"))


@pytest.mark.parametrize("script", EXAMPLES, ids=[script.stem for script in EXAMPLES])
def test_examples_run(script: Path, tmp_path: Path) -> None:
    where = {**os.environ, "MPLBACKEND": "Agg"}
    done = subprocess.run(
        [sys.executable, script], capture_output=True, text=True, cwd=tmp_path, env=where
    )
    assert done.returncode == 0, done.stderr
