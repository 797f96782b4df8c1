"""Pictures of the examples: SVG in the folder ``PICTURES`` of the environment, else PNG here."""

import io
import os
import re
from pathlib import Path

from matplotlib import rc_context
from matplotlib.figure import Figure

NUMBER = re.compile(r"\d+\.\d{3,}")


def rounded(number: re.Match[str]) -> str:
    """A number with one digit after the point."""
    return f"{float(number[0]):.1f}"


def save(figure: Figure, name: str) -> None:
    """Writes a figure; name: of the file, without its ending."""
    folder = os.environ.get("PICTURES")
    if folder is None:
        figure.savefig(f"{name}.png", dpi=110)
        return
    drawn = io.StringIO()
    # Text stays text, in one font, and the same figure makes the same file.
    with rc_context(
        {"svg.fonttype": "none", "svg.hashsalt": name, "font.sans-serif": ["DejaVu Sans"]}
    ):
        figure.savefig(drawn, format="svg", metadata={"Date": None})
    # A tenth of a point suffices for what is drawn, and makes the file smaller.
    short = re.sub("<[^>]*>", lambda tag: NUMBER.sub(rounded, tag[0]), drawn.getvalue())
    short = short.replace(" \n", " ")
    Path(folder, f"{name.replace('_', '-')}.svg").write_text(short, encoding="utf-8")
