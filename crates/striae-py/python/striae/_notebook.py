"""Runs as notebooks show them: a picture of the end, and a table."""

from __future__ import annotations

import base64
import os
import tempfile
from html import escape
from pathlib import Path
from typing import TYPE_CHECKING

from . import _striae as native

if TYPE_CHECKING:
    from ._run import Run

#: Bytes of the picture, which base64 makes a third more.
LARGEST = 200_000

#: Widths that are tried until the picture is small enough.
WIDTHS = (640, 400, 240)

#: Rows, warnings and letters beyond which the rest is left out.
MOST, LONGEST = 12, 400


def shown(run: Run) -> str:
    """The run as HTML."""
    parts = [f"<p><b>{_text(run.model.title)}</b>: {_text(run.reason)}</p>"]
    picture = drawn(run)
    if picture is not None:
        data = base64.b64encode(picture).decode("ascii")
        parts.append(f'<img alt="The model at the end" src="data:image/png;base64,{data}">')
    history = run.history
    rows = []
    # A run that stops in its first increment has no history.
    names = run.model.step_names if "step" in history else []
    for number, name in enumerate(names, start=1):
        here = history["step"] == number
        if here.any():
            iterations = int(history["iterations"][here].sum())
            rows.append([name, str(int(here.sum())), str(iterations)])
    if rows:
        parts.append(_table(["step", "increments", "iterations"], rows))
    if len(run):
        forces = [[pair.name, *(f"{force:.4g}" for force in pair.force)] for pair in run[-1].pairs]
        if forces:
            parts.append(_table(["pair, force on side a", "x", "y", "z"], forces))
    warnings = run.warnings
    if warnings:
        parts.append(f"<p>{len(warnings)} warnings</p>" if len(warnings) > 1 else "<p>1 warning</p>")
        told = "".join(f"<li>{_text(text)}</li>" for text in warnings[:MOST])
        parts.append(f"<ul>{told}</ul>")
    return f"<div>{''.join(parts)}</div>"


def drawn(run: Run) -> bytes | None:
    """A picture of the last state as PNG, if there is a state and it can be drawn."""
    if not len(run):
        return None
    with tempfile.TemporaryDirectory(prefix="striae-") as place:
        folder, file = os.path.join(place, "results"), Path(place, "picture.png")
        run._native.write(folder, "run", 0)
        for width in WIDTHS:
            pictured: native.Pictured = (None, None, None, "corner", None, 1.0, [], width)
            try:
                native.picture(folder, str(file), pictured, None)
            except (RuntimeError, ValueError):
                # The table says enough.
                return None
            if file.stat().st_size <= LARGEST:
                return file.read_bytes()
    return None


def _table(head: list[str], rows: list[list[str]]) -> str:
    cells = "".join(f"<th>{_text(cell)}</th>" for cell in head)
    body = "".join(
        "<tr>" + "".join(f"<td>{_text(cell)}</td>" for cell in row) + "</tr>" for row in rows[:MOST]
    )
    left = len(rows) - MOST
    more = f'<tr><td colspan="{len(head)}">and {left} more</td></tr>' if left > 0 else ""
    return f"<table><thead><tr>{cells}</tr></thead><tbody>{body}{more}</tbody></table>"


def _text(text: str) -> str:
    short = text if len(text) <= LONGEST else text[:LONGEST] + "..."
    return escape(short)
