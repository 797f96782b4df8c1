"""Classes of declared laws and textures and functions of declared generators are those of the library."""

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


def test_materials_say_what_they_were_made_of() -> None:
    rubber = st.MooneyRivlin(1e5, 2e4, poissons_ratio=0.49, relaxation=[(0.5, 1)])
    told = "c10=100000.0, c01=20000.0, poissons_ratio=0.49, relaxation=[(0.5, 1.0)]"
    assert repr(rubber) == f"MooneyRivlin({told})"
    assert rubber.poissons_ratio == 0.49
    assert isinstance(rubber, st.Rubber)
    assert repr(st.NeoHookean(1, 0.3)) == "NeoHookean(youngs_modulus=1.0, poissons_ratio=0.3)"
    body = st.Body("block", st.block(), rubber)
    model = st.Model([body])
    model.step("hold", body["all"].hold())
    text = model.to_deck()
    assert 'law = "mooney-rivlin"\nc10 = 100000.0\nc01 = 20000.0\npoissons_ratio = 0.49\n' in text
    assert "relaxation = [{ ratio = 0.5, time = 1.0 }]" in text


def test_sets_exclude_each_other() -> None:
    with pytest.raises(st.ModelError, match="`bulk_modulus` and `poissons_ratio` exclude each other"):
        st.Gent(1e5, 30.0, bulk_modulus=1e7, poissons_ratio=0.4)
    with pytest.raises(TypeError):
        st.Gent(1e5, 30.0, 1e7)  # type: ignore[call-arg]
    with pytest.raises(TypeError, match="the key `lambda` of decks is youngs_modulus"):
        st.NeoHookean(**{"lambda": 1.0})  # type: ignore[arg-type]
    with pytest.raises(TypeError, match="terms: a list is needed, not float"):
        st.Ogden(2.0, bulk_modulus=1e7)  # type: ignore[arg-type]
    with pytest.raises(st.ModelError, match="Ogden: the law has no term"):
        st.Ogden([], bulk_modulus=1e7)


def test_tables_of_generators_have_the_keys_of_decks() -> None:
    ring = st.annulus(divisions=(1, 12, 2), refinement=(20, 3), radial_grading={"lengths": [1]})
    assert len(ring.cells["hexahedron"]) == 24
    with pytest.raises(st.ModelError, match="`one_sided` and `symmetric` exclude each other"):
        st.annulus(axial_grading={"one_sided": 2, "symmetric": 3})
    with pytest.raises(st.ModelError, match="degrees: it is needed"):
        st.block(rotation={"axis": (0, 0, 1)})
    with pytest.raises(TypeError, match="grading: a mapping is needed, not float"):
        st.block(grading=2.0)  # type: ignore[arg-type]


def test_words_of_a_fit_are_those_of_the_law() -> None:
    angles, forces = [0.0, 90.0, 180.0, 270.0], [0.3, 0.2, 0.3, 0.2]
    with pytest.raises(st.ModelError, match="slip_rule: the law has no such word"):
        st.fit_friction(angles, forces, st.Nap, slip_rule="associated")
    with pytest.raises(st.ModelError, match="one of `opposing`, `associated` is needed"):
        st.fit_friction(angles, forces, st.Orthotropic, slip_rule="other")


def test_textures_are_stated_by_what_their_names_leave_open() -> None:
    assert repr(st.Axial((0, 0, 1), point=(1, 0, 0))) == "Axial((0, 0, 1), point=(1, 0, 0))"
    text = grooved(st.Painted([[0, 0, 0], [1, 1, 0]], [(1, 0, 0), (0, 2, 0)], width=3))
    points = (
        "points = [{ at = [0.0, 0.0, 0.0], direction = [1.0, 0.0, 0.0] }, "
        "{ at = [1.0, 1.0, 0.0], direction = [0.0, 2.0, 0.0] }], width = 3.0"
    )
    assert points in text
    about = "radial = { point = [2.0, 0.0, 0.0], direction = [0.0, 0.0, 1.0] }, turn = 20.0"
    assert about in grooved(st.Radial((0, 0, 1), point=(2, 0, 0), turn=20))
    for wrong, told in [
        (lambda: st.Radial((0, 0, 0)), "axis: a direction must not be the zero vector"),
        (lambda: st.Painted([(0, 0, 0)], [(1, 0, 0)], width=-1), "width: it must be positive"),
        (lambda: st.Nodal([1, 0, 0]), "directions: an array of shape"),
    ]:
        with pytest.raises(st.ModelError, match=told):
            wrong()


def grooved(texture: st.Texture) -> str:
    """A deck with a texture."""
    body = st.Body("block", st.block(), st.NeoHookean(1, 0.3))
    floor = st.Plane("floor", normal=(0, 0, 1))
    pair = st.Pair(body["zmin"].textured(texture), floor, st.Orthotropic(0.1, 0.4))
    model = st.Model([body], rigid=[floor], pairs=[pair])
    model.step("press", body["zmax"].displace(x=0, y=0, z=-0.1))
    return model.to_deck()
