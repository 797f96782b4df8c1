"""Pictures with matplotlib."""

from __future__ import annotations

import textwrap
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, Optional

import numpy as np

from ._check import Floats

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from ._friction import Friction
    from ._results import PairResults
    from ._run import History, Run

#: Tractions over the largest one below which no arrow is drawn.
FAINT = 1e-3


def _axes(axes: Optional[Axes]) -> Axes:
    if axes is not None:
        return axes
    from matplotlib import pyplot

    return pyplot.subplots(layout="constrained")[1]


def draw_history(history: History, columns: Sequence[str], axes: Optional[Axes]) -> Axes:
    """Columns over time; the forces of all pairs by default."""
    chosen = list(columns) or [name for name in history if ".resultant_a." in name]
    values = [history[name] for name in chosen]
    on = _axes(axes)
    for name, value in zip(chosen, values):
        label = name.removeprefix("pair.").replace(".resultant_a.", ", ")
        on.plot(history["time"], value, marker=".", label=label if not columns else name)
    on.set_xlabel("time")
    on.set_ylabel("force on side a" if not columns else "")
    if chosen:
        on.legend()
    on.grid(alpha=0.3)
    return on


def draw_patch(pair: PairResults, axes: Optional[Axes], side: str) -> Axes:
    """Mean pressure of a side as colour and friction as arrows, seen along the mean normal
    from outside the body."""
    from matplotlib.collections import PolyCollection

    on = _axes(axes)
    known = getattr(pair, side)
    normal = known.normal.mean(axis=0)
    across, up = _plane(normal)
    flat = np.column_stack([known.position @ across, known.position @ up])
    pressure = known.mean_pressure
    shown = PolyCollection(flat[known.facets], cmap="viridis", edgecolor="0.75", linewidth=0.4)
    shown.set_array(pressure[known.facets].mean(axis=1))
    shown.set_clim(0.0, max(float(pressure.max(initial=0.0)), np.finfo(float).tiny))
    on.add_collection(shown)
    on.figure.colorbar(shown, ax=on, label="mean pressure", shrink=0.8)
    tractions = known.mean_traction + pressure[:, None] * known.normal
    _arrows(on, flat, tractions @ np.column_stack([across, up]), known.facets)
    on.set_aspect("equal")
    on.autoscale_view()
    on.set_xlabel(_axis_name(across))
    on.set_ylabel(_axis_name(up))
    on.set_title(f"pair {pair.name}, side {side}: friction on it as arrows", fontsize="medium")
    return on


def _arrows(on: Any, places: Floats, vectors: Floats, facets: Any) -> None:
    sizes = np.linalg.norm(vectors, axis=1)
    largest = float(sizes.max(initial=0.0))
    if largest == 0.0:
        return
    drawn = sizes > FAINT * largest
    edges = places[facets] - places[np.roll(facets, 1, axis=1)]
    edge = float(np.linalg.norm(edges, axis=2).mean())
    on.quiver(
        *places[drawn].T,
        *vectors[drawn].T,
        angles="xy",
        scale_units="xy",
        scale=largest / (2.0 * edge),
        color="tab:red",
        width=0.003,
        headwidth=3.5,
        headlength=4.5,
        headaxislength=4.0,
        minshaft=2.0,
    )


def _plane(normal: Floats) -> tuple[Floats, Floats]:
    """Two directions across the normal: the first coordinate axis that is not along it, and a
    quarter turn from it, so that the picture is seen against the normal or along it, with
    the axes as in a plan."""
    axis = int(np.argmax(np.abs(normal)))
    first, second = [(1, 2), (0, 2), (0, 1)][axis]
    across, up = np.eye(3)[first], np.eye(3)[second]
    return across, up


def _axis_name(direction: Floats) -> str:
    return "xyz"[int(np.argmax(np.abs(direction)))]


def draw_friction(friction: Friction, axes: Optional[Axes], theta: float) -> Axes:
    """The slip surface as a curve, friction over pressure, with arrows of slip from it."""
    on = _axes(axes)
    surface = friction.slip_surface(theta, 360)
    closed = np.vstack([surface.friction, surface.friction[:1]])
    on.plot(*closed.T, color="tab:blue", label=r"$-\tau/p$")
    some = slice(None, None, 20)
    direction = np.radians(surface.slip_angle)[some]
    slip = np.column_stack([np.cos(direction), np.sin(direction)])
    size = float(np.abs(surface.friction).max(initial=0.0)) or 1.0
    on.quiver(
        *surface.friction[some].T,
        *(0.2 * size * slip).T,
        angles="xy",
        scale_units="xy",
        scale=1.0,
        color="tab:red",
        width=0.005,
        label="slip",
    )
    limit = 1.35 * size
    on.set(xlim=(-limit, limit), ylim=(-limit, limit))
    on.axhline(0.0, color="0.8", linewidth=0.8, zorder=0)
    on.axvline(0.0, color="0.8", linewidth=0.8, zorder=0)
    on.set_aspect("equal")
    on.set_xlabel("across the texture (a)")
    on.set_ylabel("along the texture (-s)")
    at = f"\ntextures at {theta:g} degrees" if friction._native.of_two_textures else ""
    # Long laws take several lines: titles do not shrink with their axes.
    on.set_title(textwrap.fill(repr(friction), 44) + at, fontsize="small")
    on.legend(loc="upper right", fontsize="small")
    return on


def draw_fit(
    friction: Friction, measured: tuple[Floats, Floats, Floats], axes: Optional[Axes]
) -> Axes:
    """Friction against slip over the direction of slip: readings as marks, the law as lines,
    of two textured surfaces at each angle between the textures."""
    on = _axes(axes)
    slip, theta, against = measured
    two = friction._native.of_two_textures
    angles = np.unique(theta) if two else np.zeros(1)
    for number, angle in enumerate(angles):
        here = theta == angle if two else np.full(len(theta), True)
        label = f", textures at {np.degrees(angle):g} degrees" if two else ""
        degrees = (np.degrees(slip[here]) + 180.0) % 360.0 - 180.0
        on.plot(degrees, against[here], "o", color=f"C{number}", label=f"measured{label}")
        surface = friction.slip_surface(float(np.degrees(angle)), 360)
        order = np.argsort(surface.slip_angle)
        law = surface.slip_angle[order]
        on.plot(law, surface.dissipation[order], color=f"C{number}", label=f"law{label}")
    on.set_xlabel("direction of slip (degrees)")
    on.set_ylabel("friction against slip over pressure")
    on.set_ylim(bottom=0.0)
    on.set_title(repr(friction), fontsize="small")
    on.legend(fontsize="small")
    on.grid(alpha=0.3)
    return on


def draw_run(run: Run) -> Figure:
    """Forces over time, and of each pair the contact patch at the end and its friction."""
    from matplotlib import pyplot

    pairs = run[-1].pairs if len(run) else []
    rows = 1 + len(pairs)
    figure = pyplot.figure(figsize=(9.0, 3.5 * rows), layout="constrained")
    grid = figure.add_gridspec(rows, 2)
    draw_history(run.history, (), figure.add_subplot(grid[0, :])).set_title(run.model.title)
    for row, pair in enumerate(pairs, start=1):
        draw_patch(pair, figure.add_subplot(grid[row, 0]), "a")
        friction = run.model.friction(pair.name)
        draw_friction(friction, figure.add_subplot(grid[row, 1]), 0.0)
    return figure
