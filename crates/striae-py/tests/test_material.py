"""Bulk materials."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
import striae as st


def stretched(material: st.Material, curve: Any, increments: int, duration: float) -> st.Run:
    """A block that is stretched along z and free to contract."""
    body = st.Body("bar", st.block(), material)
    model = st.Model([body])
    held = [body["xmin"].displace(x=0), body["ymin"].displace(y=0), body["zmin"].displace(z=0)]
    pull = body["zmax"].displace(z=curve)
    model.step("pull", *held, pull, increments=increments, duration=duration)
    return model.run()


def test_rubber_relaxes_by_the_series_of_prony() -> None:
    """Small shear: after a sudden strain that is held, G(t) = G (1 + sum g exp(-t/t_r))."""
    branches = [(0.5, 1.0), (0.25, 4.0)]
    rubber = st.MooneyRivlin(1e5, 0.0, poissons_ratio=0.3, relaxation=branches)
    assert rubber.relaxation == ((0.5, 1.0), (0.25, 4.0))
    assert rubber.youngs_modulus == pytest.approx(2 * 2e5 * 1.3)
    body = st.Body("block", st.block(), rubber)
    model = st.Model([body])
    model.step("shear", body["all"].displace(y=0, z=0), body["zmin"].displace(x=0), body["zmax"].displace(x=1e-5), increments=1, duration=1e-9)
    model.step("wait", increments=8, duration=2.0)
    forces = {round(i.time, 6): float(i.reaction("block", "zmax")[0]) for i in model.run(keep="all")}
    for time in (0.0, 0.5, 1.0, 2.0):
        expected = 2e5 * 1e-5 * (1 + sum(g * np.exp(-time / t) for g, t in branches))
        assert forces[time] == pytest.approx(expected, rel=1e-6)


HARDENING: list[tuple[dict[str, Any], Callable[[float], float]]] = [
    ({"yield_stress": 2e8, "hardening_modulus": 1e9}, lambda p: 2e8 + 1e9 * p),
    (
        {"yield_stress": 2e8, "saturation": (4e8, 20.0)},
        lambda p: 2e8 + 2e8 * (1 - np.exp(-20 * p)),
    ),
    (
        {"yield_table": [(0.0, 2e8), (0.05, 3e8), (0.2, 3.5e8)]},
        lambda p: float(np.interp(p, [0, 0.05, 0.2], [2e8, 3e8, 3.5e8])),
    ),
]


@pytest.mark.parametrize("hardening, stress", HARDENING)
def test_metals_follow_their_hardening(
    hardening: dict[str, Any], stress: Callable[[float], float]
) -> None:
    """In tension the stress is Y(p), with p the logarithmic strain less its elastic part."""
    metal = st.ElasticPlastic(2e11, 0.3, **hardening)
    run = stretched(metal, 0.1, 10, 1.0)
    for increment in run:
        found = increment.body("bar")
        p = np.log(1 + 0.1 * increment.fraction) - float(found.stress[:, 2, 2].mean()) / 2e11
        # Cauchy's stress is that of Kirchhoff over J, which is 1 but for elastic strains.
        assert np.allclose(found.stress[:, 2, 2], stress(p), rtol=2e-3)
        assert np.allclose(found.equivalent_plastic_strain, p, rtol=1e-4, atol=1e-6)
    assert run[-1].energies.inelastic > 0


@pytest.mark.parametrize(
    "material",
    [
        st.NeoHookean(1e6, 0.3, volumetric="logarithmic"),
        st.Yeoh(1e5, -1e3, 1e2, bulk_modulus=1e7, relaxation=[(0.4, 0.2)]),
        st.Ogden([(1e5, 2.0), (1e3, -2.0)], poissons_ratio=0.48, relaxation=[(0.1, 1), (1, 3)]),
        *[st.ElasticPlastic(2e6, 0.3, **{**one, **scaled}) for one, scaled in [
            ({"yield_stress": 2e4, "hardening_modulus": 1e5}, {}),
            ({"yield_stress": 2e4, "saturation": (4e4, 20.0)}, {}),
            ({"yield_table": [(0.0, 2e4), (0.1, 3e4)]}, {}),
        ]],
    ],
    ids=repr,
)  # fmt: skip
def test_materials_are_decks(material: st.Material) -> None:
    """A model with the material is a deck that runs to the same bits."""
    body = st.Body("bar", st.block(divisions=(1, 1, 2)), material)
    model = st.Model([body])
    model.step("pull", body["zmin"].hold(), body["zmax"].displace(x=0.1, z=0.1), increments=3)
    again = st.Model.from_text(model.to_deck())
    assert again.to_deck() == model.to_deck()
    run, other = model.run(), again.run()
    assert np.array_equal(run.history.table, other.history.table)
    assert np.array_equal(run[-1].body("bar").stress, other[-1].body("bar").stress)


def test_materials_can_be_read_in_notebooks() -> None:
    for material in (
        st.MooneyRivlin(1e5, 2e4, poissons_ratio=0.49, relaxation=[(0.5, 1.0)]),
        st.Ogden([(1e5, 2.0)], bulk_modulus=1e8, volumetric="logarithmic"),
        st.ElasticPlastic(2e11, 0.3, 2e8, saturation=(4e8, 10.0)),
        st.ElasticPlastic(2e11, 0.3, yield_table=[(0.0, 2e8), (0.1, 3e8)]),
        st.NeoHookean(1e6, 0.3),
        st.Gent(1e5, 80.0, poissons_ratio=0.48),
    ):
        again = eval(repr(material), vars(st))
        F = [[1.1, 0.1, 0], [0, 1, 0], [0, 0, 0.95]]
        assert repr(again) == repr(material)
        assert np.array_equal(again.stress(F), material.stress(F))


WRONG: list[tuple[Callable[[], Any], str]] = [
    (
        lambda: st.Yeoh(1e5, 0, 0, bulk_modulus=1e7, relaxation=[(0.5, 0.0)]),
        "Yeoh: `time` of branch 0 is 0, but it must be positive and finite",
    ),
    (
        lambda: st.Yeoh(1e5, 0, 0, bulk_modulus=1e7, relaxation=[0.5]),  # type: ignore[list-item]
        "relaxation: 2 numbers are needed, but it has shape ()",
    ),
    (
        lambda: st.Yeoh(1e5, 0, 0),
        "Yeoh: either `bulk_modulus` or `poissons_ratio` is needed",
    ),
    (
        lambda: st.ElasticPlastic(2e11, 0.3),
        "ElasticPlastic: either `yield_stress` or `yield_table` is needed",
    ),
    (
        lambda: st.ElasticPlastic(2e11, 0.3, -1.0),
        "ElasticPlastic: `yield_stress` is -1, but it must be positive and finite",
    ),
    (
        lambda: st.ElasticPlastic(2e11, 0.3, 2e8, saturation=(1e8, 1.0)),
        "ElasticPlastic: the saturation stress is 100000000, but it must be at least"
        " `yield_stress`, 200000000",
    ),
    (
        lambda: st.ElasticPlastic(2e11, 0.3, yield_table=[(0, 1.0)], hardening_modulus=1.0),
        "ElasticPlastic: `hardening_modulus` and `yield_table` exclude each other; either"
        " `yield_stress` or `yield_table` is needed",
    ),
]


@pytest.mark.parametrize("wrong, words", WRONG, ids=[words[:40] for _, words in WRONG])
def test_inadmissible_constants_are_refused(wrong: Callable[[], Any], words: str) -> None:
    with pytest.raises(st.ModelError) as caught:
        wrong()
    assert str(caught.value) == words
