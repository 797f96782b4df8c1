"""Models as decks."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import striae as st

ROOT = Path(__file__).parents[3]


def assert_same_runs(one: st.Model, other: st.Model) -> None:
    one_run, other_run = one.run(), other.run()
    assert one_run.ending == other_run.ending == "completed"
    assert np.array_equal(one_run.history.table, other_run.history.table)
    for name in one.body_names:
        first, second = one_run[-1].body(name), other_run[-1].body(name)
        assert np.array_equal(first.position, second.position)


def test_a_model_is_a_deck_that_runs_to_the_same_bits(model: st.Model, tmp_path: Path) -> None:
    path = tmp_path / "deck.toml"
    text = model.to_deck(path)
    assert path.read_text() == text
    again = st.Model.from_deck(path)
    assert again.to_deck() == text
    assert_same_runs(model, again)


@pytest.mark.parametrize("case", ["two-blocks", "pad-on-incline"])
def test_a_deck_is_written_with_the_steps_that_were_added(case: str) -> None:
    decks = [one for one in sorted((ROOT / "cases" / case).glob("*.toml"))]
    deck = next(one for one in decks if one.name != "expected.toml")
    model = st.Model.from_deck(deck)
    model.step("more", increments=1)
    again = st.Model.from_text(model.to_deck())
    assert again.step_names == [*model.step_names]
    assert again.to_deck() == model.to_deck()


def test_textures_of_all_kinds_are_written(rubber: st.NeoHookean) -> None:
    pad = st.Body("pad", st.block(divisions=(2, 2, 2)), rubber)
    floor = st.Plane("floor", normal=(0.1, 0.2, 1))
    directions = np.tile([1.0, 0.5, 0.0], (9, 1))
    for texture in [st.Nodal(directions), st.Circumferential((0, 0, 1), point=(0.3, 0.2, 0), turn=33.3)]:
        side = pad["zmin"].textured(texture)
        model = st.Model([pad], [floor], [st.Pair(side, floor, st.Nap(0.2, 0.3, 0.25))])
        model.step("press", pad["zmax"].displace(x=0, y=0, z=-0.01))
        text = model.to_deck()
        assert st.Model.from_text(text).to_deck() == text


def test_the_order_of_loads_changes_no_bit(rubber: st.NeoHookean) -> None:
    body = st.Body("pad", st.block((0.06, 0.04, 0.02), (3, 2, 2)), rubber)
    model = st.Model([body])
    pressed, pulled = body["zmax"].pressure(1e4), body["xmax"].traction((2e3, 1e3, 0))
    model.step("load", body["xmin"].hold(), pressed, pulled, increments=3)
    run, again = model.run(), st.Model.from_text(model.to_deck()).run()
    assert np.array_equal(run[-1].body("pad").displacement, again[-1].body("pad").displacement)


def test_names_are_of_one_line(rubber: st.NeoHookean) -> None:
    with pytest.raises(ValueError, match="one line of printable characters"):
        st.Body("a\nb", st.block(), rubber)


def test_derivatives_that_a_deck_asks_for_are_told(tmp_path: Path) -> None:
    deck = (ROOT / "cases/two-blocks/deck.toml").read_text()
    asked = deck + '\n[sensitivity]\nwrt = ["material.soft.youngs_modulus"]\n'
    with pytest.warns(UserWarning, match="asks for derivatives by `material.soft.youngs_modulus`"):
        st.Model.from_text(asked)
    (tmp_path / "deck.toml").write_text(asked)
    with pytest.warns(UserWarning, match=r"use striae.differentiate") as told:
        st.Model.from_deck(tmp_path / "deck.toml")
    assert [warning.filename for warning in told] == [__file__]
