"""Friction laws fitted to measurements."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
import striae as st

ROOT = Path(__file__).parents[3]
LAWS: list[tuple[st.Friction, dict[str, float]]] = [
    (st.Coulomb(0.3), {"mu": 0.3}),
    (st.Orthotropic(0.2, 0.35), {"mu_along": 0.2, "mu_across": 0.35}),
    (st.Orthotropic(0.2, 0.35, "associated"), {"mu_along": 0.2, "mu_across": 0.35}),
    (st.Nap(0.11, 0.14, 0.2), {"mu_forward": 0.11, "mu_backward": 0.14, "mu_lateral": 0.2}),
]


@pytest.mark.parametrize("law, constants", LAWS, ids=[repr(law) for law, _ in LAWS])
@pytest.mark.parametrize("directed", [False, True], ids=["against", "directed"])
def test_exact_measurements_give_the_law(
    law: st.Friction, constants: dict[str, float], directed: bool
) -> None:
    surface = law.slip_surface(count=24)
    angles = surface.slip_angle
    forces = surface.friction if directed else surface.dissipation
    words = {"slip_rule": "associated"} if "associated" in repr(law) else {}
    fit = st.fit_friction(angles, forces, type(law), **words)
    assert fit.constants == pytest.approx(constants, rel=1e-12)
    assert fit.degrees_of_freedom == 24 * (1 + (directed and "mu" not in constants)) - len(
        constants
    )
    assert fit.deviation == pytest.approx(0.0, abs=1e-12) and not fit.at_bound
    for name, ends in fit.intervals.items():
        assert ends is not None and ends[0] <= fit.constants[name] <= ends[1]
    found = fit.friction.slip_surface(count=24)
    assert np.allclose(found.friction, surface.friction, atol=1e-12)


def test_two_textures_need_several_angles_between_them() -> None:
    law = st.TwoTextures(0.5, c_mag=0.2, c_ang=0.15, c_cen=0.8)
    surfaces = {theta: law.slip_surface(theta, 24) for theta in (0.0, 60.0, 120.0)}
    angles = np.concatenate([one.slip_angle for one in surfaces.values()])
    forces = np.concatenate([one.dissipation for one in surfaces.values()])
    fit = st.fit_friction(angles, forces, st.TwoTextures, theta=np.repeat(list(surfaces), 24))
    expected = {"mu": 0.5, "c_mag": 0.2, "c_ang": 0.15, "c_cen": 0.8}
    assert fit.constants == pytest.approx(expected, rel=1e-11)
    assert len(fit.plot().lines) == 6
    with pytest.raises(st.ModelError, match="two or more angles `theta` between the textures"):
        st.fit_friction(angles[:24], forces[:24], st.TwoTextures)


def test_a_table_averages_what_was_measured_at_one_angle() -> None:
    fit = st.fit_friction([0, 0, 120, 240, 240], [0.2, 0.3, 0.5, 0.4, 0.4])
    expected = {"mu at 0 degrees": 0.25, "mu at 120 degrees": 0.5, "mu at 240 degrees": 0.4}
    assert fit.constants == pytest.approx(expected)
    told = "Tabulated(angles=[0.0, 120.0, 240.0], mu=[0.25, 0.5, 0.4])"
    assert repr(fit) == f"<fit of {told} to 5 readings>"
    assert fit.degrees_of_freedom == 2 and fit.level == 0.95


def test_a_wider_spread_counts_less() -> None:
    fit = st.fit_friction([0, 0], [0.2, 0.5], st.Coulomb, spread=[1.0, 2.0])
    assert fit.constants["mu"] == pytest.approx((4 * 0.2 + 0.5) / 5)


def test_a_law_that_would_create_energy_is_not_found() -> None:
    angles = np.arange(0.0, 360.0, 15.0)
    slip = np.radians(angles)
    forces = np.column_stack([0.275 + 0.325 * np.cos(slip), 0.05 * np.sin(slip)])
    fit = st.fit_friction(angles, forces, st.Nap)
    assert fit.at_bound and set(fit.intervals.values()) == {None}
    assert fit.friction.slip_surface(count=720).dissipation.min() > 0


WRONG: list[tuple[dict[str, Any], str]] = [
    ({"angles": [[0]]}, "angles: an array of one dimension is needed, not of 2"),
    ({"forces": [0.1, 0.2]}, "forces: numbers: 2, but angles: 3; each needs one"),
    (
        {"forces": np.ones((2, 2))},
        "forces: shape (3,) or (3, 2) is needed, but it has shape (2, 2)",
    ),
    ({"forces": [0.1, np.nan, 0.2]}, "forces: row 1 is not finite: nan"),
    ({"theta": [0.0, 1.0]}, "theta: numbers: 2, but angles: 3; each needs one"),
    (
        {"spread": 0.0},
        "fit_friction: reading 0 has the spread 0, but it must lie between 0.000001 and 1000000",
    ),
    (
        {"forces": [0.1, 5e3, 0.2]},
        "fit_friction: reading 1 has the friction 5e3, but it must lie between -1000 and 1000:"
        " divide the tangential by the normal force",
    ),
    (
        {"level": 95},
        "fit_friction: the level of confidence 95 is refused: it must lie between 0 and 1, such"
        " as 0.95",
    ),
    (
        {"forces": [-0.25, -0.25, -0.25]},
        "fit_friction: the mean friction against slip is -0.25, but it must be positive: state"
        " the angle of slip, not that of the force on the surface",
    ),
]


@pytest.mark.parametrize("wrong, words", WRONG)
def test_wrong_measurements_are_refused(wrong: dict[str, Any], words: str) -> None:
    given: dict[str, Any] = {"angles": [0, 90, 180], "forces": [0.1, 0.2, 0.3], "law": st.Nap}
    with pytest.raises(st.ModelError) as error:
        st.fit_friction(**{**given, **wrong})
    assert str(error.value) == words


MEASURED = ROOT / "docs" / "book" / "how-to" / "measurements"


def test_published_measurements_of_a_snake_are_a_nap() -> None:
    read = st.read_measurements(MEASURED / "snake-skin.csv")
    fit = st.fit_friction(read.angles, read.forces, st.Nap, theta=read.theta, spread=read.spread)
    expected = {"mu_forward": 0.11, "mu_backward": 0.14, "mu_lateral": 0.20}
    assert fit.constants == pytest.approx(expected)
    assert not fit.at_bound and fit.degrees_of_freedom == 1


def test_published_measurements_of_a_spider_have_two_coefficients() -> None:
    """Means by leg and direction as the authors' readings have them; intervals by Student's t."""
    read = st.read_measurements(MEASURED / "spider-pads.csv")
    assert len(read.angles) == 282 and set(read.angles) == {0.0, 180.0}
    for angle, mean in [(0.0, 1.2112056737588653), (180.0, 0.4321985815602837)]:
        here = read.forces[read.angles == angle]
        fit = st.fit_friction(np.full(141, angle), here, st.Coulomb)
        assert fit.constants["mu"] == pytest.approx(here.mean()) == pytest.approx(mean)
        half = 1.9770537 * here.std(ddof=1) / np.sqrt(141)
        assert fit.intervals["mu"] == pytest.approx((mean - half, mean + half), rel=1e-6)
    assert read.specimen is not None
    legs = [name for name, angle in zip(read.specimen, read.angles) if angle == 0.0]
    pulled = st.fit_friction(
        np.zeros(141), read.forces[read.angles == 0.0], st.Coulomb, specimen=legs
    )
    assert sorted(pulled.specimens) == [f"leg pair {i}" for i in (1, 2, 3, 4)]
    # The table of the book.
    assert pulled.intervals["mu"] == pytest.approx((0.875, 1.547), abs=6e-4)
    with pytest.raises(st.ModelError, match="needs slip in three directions"):
        st.fit_friction(read.angles, read.forces, st.Nap)


def test_faults_of_measurements_have_places(tmp_path: Path) -> None:
    file = tmp_path / "m.csv"
    file.write_text("angle, friction\n0, 0.1\n90\n")
    with pytest.raises(st.ModelError, match=r"m.csv:3:1: fields: 1, but columns: 2"):
        st.read_measurements(file)
    file.write_text("angle, friction, direction\n0, 0.5, 30\n90, 0.2, 90\n")
    forces = st.read_measurements(file).forces
    assert np.allclose(forces, [[0.5 * np.cos(np.pi / 6), 0.25], [0, 0.2]])


def test_a_law_is_a_class() -> None:
    with pytest.raises(TypeError, match="law: one of the classes Coulomb, TwoTextures, Orthotropic"):
        st.fit_friction([0], [0.1], st.Frictionless)


def test_the_scatter_between_specimens_gives_the_intervals(tmp_path: Path) -> None:
    file = tmp_path / "m.csv"
    file.write_text("specimen,angle,friction\nA,0,.22\nA,0,.22\nB,0,.18\nB,0,.18\n")
    read = st.read_measurements(file)
    assert read.specimen == ["A", "A", "B", "B"]
    fit = st.fit_friction(read.angles, read.forces, st.Coulomb, specimen=read.specimen)
    assert fit.specimens == pytest.approx({"A": 1.1, "B": 0.9})
    # Student's t for one degree of freedom.
    assert fit.intervals["mu"] == pytest.approx((0.2 - 0.02 * 12.7062047, 0.2 + 0.02 * 12.7062047))
    alone = st.fit_friction(read.angles, read.forces, st.Coulomb)
    assert alone.specimens == {} and alone.intervals["mu"][0] > 0.16
    with pytest.raises(st.ModelError, match="names: 2, but angles: 4; each needs one"):
        st.fit_friction(read.angles, read.forces, st.Coulomb, specimen=["A", "B"])
