"""Pictures, animations, and runs in notebooks."""

from __future__ import annotations

import base64
import io
from pathlib import Path

import matplotlib.image
import numpy as np
import pytest
import striae as st


def test_a_run_is_animated(model: st.Model, tmp_path: Path) -> None:
    run = model.run(keep="all")
    run.animate(tmp_path / "run.png", width=300, frame_time=0.05)
    data = (tmp_path / "run.png").read_bytes()
    # The start and seven increments; see the chunk `acTL` of the PNG specification.
    at = data.index(b"acTL") + 4
    assert int.from_bytes(data[at : at + 4], "big") == 8
    assert data.count(b"fcTL") == 8
    run.animate(tmp_path / "run.gif", "cauchy_stress", view="front", width=300, range=(0.0, 1e5))
    assert (tmp_path / "run.gif").read_bytes().startswith(b"GIF89a")
    assert run.folder is None
    few = model.run()
    few.animate(tmp_path / "few.png", width=300)
    data = (tmp_path / "few.png").read_bytes()
    assert data.count(b"fcTL") == 3


def test_pictures_are_of_files_or_of_memory(model: st.Model, tmp_path: Path) -> None:
    written = model.run(output=tmp_path / "results")
    run = model.run()
    for one, name in ((written, "a.png"), (run, "b.png")):
        one.picture(tmp_path / name, "gap", view=(0, 1, -0.2), width=300, hide=["floor"])
    assert (tmp_path / "a.png").read_bytes() == (tmp_path / "b.png").read_bytes()
    assert matplotlib.image.imread(tmp_path / "a.png").shape[1] == 300


def test_wrong_pictures_are_refused(model: st.Model, tmp_path: Path) -> None:
    run = model.run()
    with pytest.raises(st.ModelError, match="view: one of `corner`, `front`, .* is needed, not"):
        run.picture(tmp_path / "a.png", view="sideways")
    with pytest.raises(st.ModelError, match="field: unknown field `heat`; known fields are"):
        run.animate(tmp_path / "a.gif", "heat")
    with pytest.raises(st.ModelError, match="path: .*film.mp4: an animation ends in .gif or .png"):
        run.animate(tmp_path / "film.mp4")
    with pytest.raises(st.ModelError, match="path: .*a.jpg: a picture ends in .png"):
        run.picture(tmp_path / "a.jpg")
    with pytest.raises(st.ModelError, match="hide: unknown name `nix` of a body or surface; known"):
        run.picture(tmp_path / "a.png", hide=["nix"])
    with pytest.raises(st.ModelError, match="magnify: it must be at most 1e50 in magnitude, but is 1e300"):
        run.picture(tmp_path / "a.png", magnify=1e300)
    with pytest.raises(st.ModelError, match="range: ascending limits are needed"):
        run.picture(tmp_path / "a.png", range=(1, 1))
    with pytest.raises(st.ModelError, match="frame_time: 0.01 to 60 seconds are needed, not 100"):
        run.animate(tmp_path / "a.gif", frame_time=100)
    assert list(tmp_path.iterdir()) == []


def test_a_notebook_shows_the_end_and_a_table(model: st.Model) -> None:
    run = model.run()
    shown = run._repr_html_()
    assert shown is not None and len(shown) < 300_000
    start = shown.index("base64,") + len("base64,")
    picture = base64.b64decode(shown[start : shown.index('"', start)])
    dots = matplotlib.image.imread(io.BytesIO(picture))
    assert dots.shape[1] == 640 and len(np.unique(dots.reshape(-1, dots.shape[2]), axis=0)) > 50
    iterations = [int(run.history["iterations"][run.history["step"] == n].sum()) for n in (1, 2)]
    for name, count, number in (("press", 2, iterations[0]), ("drag", 5, iterations[1])):
        assert f"<tr><td>{name}</td><td>{count}</td><td>{number}</td></tr>" in shown
    assert f"<td>pad-floor</td><td>{run[-1].pair(0).force[0]:.4g}</td>" in shown


def test_a_notebook_shows_any_run(pad: st.Body, floor: st.Plane, rubber: st.NeoHookean) -> None:
    pair = st.Pair(pad["zmin"], floor, name="<b>&")
    model = st.Model([pad], [floor], [pair], title="<script>")
    model.step("push", pad["zmax"].pressure(1e3))
    stopped = model.run(on_stop="return")
    shown = stopped._repr_html_()
    assert shown is not None and "&lt;script&gt;" in shown and "<script>" not in shown
    assert len(stopped) > 0 or "<img" not in shown
    warned = st.Body("pad", st.block(divisions=(1, 1, 1)), rubber)
    far = st.Plane("floor", point=(0, 0, -1))
    model = st.Model([warned], [far], [st.Pair(warned["zmin"], far)])
    model.step("hold", warned["zmax"].hold(), increments=1)
    with pytest.warns(st.RunWarning):
        run = model.run()
    shown = run._repr_html_()
    assert shown is not None and "<p>1 warning</p>" in shown
    # A broken run is shown as text.
    del run._history
    assert run._repr_html_() is None
