"""Classes of declared laws are those of the library."""

from __future__ import annotations

import runpy
from pathlib import Path

import pytest
import striae as st

WRITER = Path(__file__).parents[1] / "declared.py"


def test_the_files_are_up_to_date() -> None:
    for path, text in runpy.run_path(str(WRITER))["written"]().items():
        told = f"{path.name} is stale: run `python crates/striae-py/declared.py`"
        assert path.read_text(encoding="utf-8") == text, told


def test_arguments_have_the_names_of_decks() -> None:
    law = st.Orthotropic(mu_along=0.1, mu_across=0.4, slip_rule="associated")
    assert repr(law) == "Orthotropic(mu_along=0.1, mu_across=0.4, slip_rule='associated')"
    with pytest.raises(TypeError, match="along"):
        st.Orthotropic(along=0.1, across=0.4)  # type: ignore[call-arg]


def test_words_of_a_fit_are_those_of_the_law() -> None:
    angles, forces = [0.0, 90.0, 180.0, 270.0], [0.3, 0.2, 0.3, 0.2]
    with pytest.raises(st.ModelError, match="slip_rule: the law has no such word"):
        st.fit_friction(angles, forces, st.Nap, slip_rule="associated")
    with pytest.raises(st.ModelError, match="one of `opposing`, `associated` is needed"):
        st.fit_friction(angles, forces, st.Orthotropic, slip_rule="other")
