"""Meshes, materials, laws, textures, rigid bodies and loads."""

from __future__ import annotations

import copy
import pickle
import warnings
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import striae as st


def test_generators_have_their_volume_and_sets() -> None:
    assert st.block((1, 2, 3), (2, 2, 2)).volume == pytest.approx(6)
    graded = st.block(divisions=(4, 1, 1), grading={"x": {"one_sided": 8}})
    x = np.unique(graded.points[:, 0])
    assert (x[-1] - x[-2]) / (x[1] - x[0]) == pytest.approx(8)
    about = {"axis": (0, 0, 1), "degrees": 90, "about": (0, 0, 0)}
    turned = st.block((2, 1, 1), rotation=about)
    assert turned.points[:, 1].max() == pytest.approx(2)
    assert set(st.half_cylinder().facet_sets) >= {"ymin", "ymax"}
    assert "zmax" in st.capped_block().facet_sets
    assert "tetra10" in st.capped_block(element_size=2, cells="composite-tetrahedra").cells
    rod = st.cylinder(radius=2, height=3, divisions=(8, 4, 2))
    assert rod.volume == pytest.approx(12 * np.pi, rel=5e-3)
    quarter = st.cylinder(part="quarter", axial_grading={"symmetric": 2})
    assert "xmin" in quarter.facet_sets
    seal = st.torus(ring_radius=5, section_radius=1, divisions=(4, 4, 64))
    assert seal.volume == pytest.approx(10 * np.pi**2, rel=1e-2)
    ring = st.annulus(inner_radius=1, outer_radius=2, width=1, divisions=(4, 64, 2))
    assert ring.volume == pytest.approx(3 * np.pi, rel=5e-3)


def test_sets_are_made_on_the_fly(rubber: st.NeoHookean) -> None:
    body = st.Body("pad", st.block(divisions=(4, 4, 1)), rubber)
    spot = body.add_set("spot", lambda x: (x[:, 2] == 0) & (x[:, 0] <= 0.5))
    assert spot.name == "spot"
    assert len(body.mesh.facet_sets["spot"]) == 8
    assert len(body.mesh.node_sets["spot"]) == 15
    quads = body.mesh.facet_sets["spot"]
    again = body.mesh.with_sets(facets={"again": quads[:, ::-1]})
    assert np.array_equal(again.facet_sets["again"], quads)
    assert "again" not in body.mesh.facet_sets
    assert np.array_equal(body.mesh.surface_nodes("spot"), body.mesh.node_sets["spot"])


def test_facets_by_direction_place_and_elements() -> None:
    mesh = st.block(divisions=(4, 3, 2))
    top = mesh.facet_sets["zmax"]
    assert np.array_equal(mesh.facets_along((0, 0, 2), 10), top)
    assert np.array_equal(mesh.facets_around((0.4, 0.4, 3.0), 30), top)
    assert np.array_equal(mesh.facets_along((1, 0, 0), 180), mesh.facet_sets["all"])
    made = mesh.with_sets(
        facets={"lid": mesh.facets_along((0, 0, 1), 1)},
        elements={"upper": lambda x: x[:, 2] > 0.5},
    )
    assert np.array_equal(made.facet_sets["lid"], top)
    assert len(made.facets_of("upper")) == 12 + 2 * 4 + 2 * 3
    assert len(made.element_sets["all"]) == 24


def test_boundary_facets_look_outward() -> None:
    mesh = st.block(divisions=(2, 2, 2))
    corners = mesh.points[mesh.boundary]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    outward = corners.mean(axis=1) - 0.5
    assert ((normals * outward).sum(axis=1) > 0).all()


def test_meshes_of_meshio_and_files(tmp_path: Path, rubber: st.NeoHookean) -> None:
    meshio = pytest.importorskip("meshio")
    ours = st.block(divisions=(2, 2, 2))
    unused = np.vstack([[9.0, 9.0, 9.0], ours.points])
    top = ours.facet_sets["zmax"] + 1
    theirs = meshio.Mesh(
        unused,
        [("quad", top), ("hexahedron", ours.cells["hexahedron"] + 1)],
        cell_sets={"lid": [np.arange(4), np.array([], dtype=int)]},
        point_sets={"corner": np.array([0, 1])},
    )
    mesh = st.Body("pad", theirs, rubber).mesh
    assert np.array_equal(mesh.points, ours.points)
    assert np.array_equal(mesh.facet_sets["lid"], ours.facet_sets["zmax"])
    assert np.array_equal(mesh.node_sets["lid"], ours.node_sets["zmax"])
    assert mesh.node_sets["corner"].tolist() == [0]
    groups = meshio.Mesh(
        ours.points,
        [("quad", top - 1), ("hexahedron", ours.cells["hexahedron"])],
        cell_data={"gmsh:physical": [np.full(4, 7), np.full(8, 1)]},
        field_data={"lid": np.array([7, 2]), "solid": np.array([1, 3])},
    )
    assert np.array_equal(st.Mesh.of(groups).facet_sets["lid"], ours.facet_sets["zmax"])
    path = tmp_path / "pad.inp"
    meshio.Mesh(ours.points, [("hexahedron", ours.cells["hexahedron"])]).write(path)
    assert st.Body("pad", path, rubber).mesh.volume == pytest.approx(1)


def test_materials_answer_to_a_deformation(rubber: st.NeoHookean) -> None:
    assert np.allclose(rubber.stress(np.eye(3)), 0)
    shear = np.array([[1, 1e-6, 0], [0, 1, 0], [0, 0, 1]])
    modulus = 1e6 / 2.6
    assert rubber.stress(shear)[0, 1] == pytest.approx(1e-6 * modulus, rel=1e-5)
    assert st.LinearElastic(1e6, 0.3).energy(shear) == pytest.approx(0.5e-12 * modulus, rel=1e-5)
    with pytest.raises(st.ModelError, match="determinant"):
        rubber.stress(-np.eye(3))


def test_slip_surfaces_have_the_coefficients() -> None:
    surface = st.Orthotropic(mu_along=0.1, mu_across=0.4).slip_surface(count=4)
    assert np.allclose(np.linalg.norm(surface.friction, axis=1), [0.4, 0.1, 0.4, 0.1])
    nap = st.Nap(mu_forward=0.2, mu_backward=0.6, mu_lateral=0.4).slip_surface(count=4)
    assert np.allclose(nap.friction[::2, 0], [0.6, -0.2])
    assert (nap.dissipation > 0).all()
    table = st.Tabulated(np.arange(0, 360, 90), [0.5, 0.2, 0.3, 0.2]).slip_surface(count=4)
    assert np.allclose(np.linalg.norm(table.friction, axis=1), [0.5, 0.2, 0.3, 0.2])
    assert np.allclose(st.Frictionless().slip_surface().friction, 0)


def test_wear_takes_its_share_of_the_friction_work(pad: st.Body) -> None:
    wear, mu = 2e-8, 0.3

    def run(wear: object) -> st.Run:
        floor = st.Plane("floor")
        pair = st.Pair(pad["zmin"], floor, st.Coulomb(mu), wear=wear)  # type: ignore[arg-type]
        model = st.Model([pad], [floor], [pair])
        model.step("press", pad["zmax"].displace(x=0, y=0, z=-0.02), increments=1)
        model.step("drag", pad["zmax"].displace(x=0.6), increments=6)
        return model.run()

    worn = run(wear)
    volume = worn.history["pair.pad-floor.worn_volume_a"]
    assert volume[-1] == pytest.approx(wear / mu * worn.history["pair.pad-floor.dissipated"][-1])
    assert volume[-1] > 0 and worn.history["pair.pad-floor.worn_volume_b"][-1] == 0
    assert np.array_equal(volume, run((wear, 0)).history["pair.pad-floor.worn_volume_a"])
    assert worn[-1].pair(0).force[2] < 0.99 * run(None)[-1].pair(0).force[2]
    with pytest.raises(st.ModelError, match="deformable side alone"):
        run((wear, wear))
    with pytest.raises(st.ModelError, match="at least 0"):
        run(-wear)
    with pytest.raises(st.ModelError, match="a number is needed"):
        run("much")


def drift(texture: object, rubber: st.NeoHookean) -> float:
    """Sideways over forward friction of a block dragged along x on a textured floor."""
    body = st.Body("pad", st.block(divisions=(2, 2, 2)), rubber)
    floor = st.Plane("floor")
    side = body["zmin"].textured(texture)  # type: ignore[arg-type]
    model = st.Model([body], [floor], [st.Pair(side, floor, st.Orthotropic(0.1, 0.4))])
    model.step("press", body["zmax"].displace(x=0, y=0, z=-0.02), increments=1)
    model.step("drag", body["zmax"].displace(x=0.4), increments=4)
    force = model.run(keep="last")[-1].pair(0).force
    return float(force[1] / force[0])


def test_textures_turn_friction(rubber: st.NeoHookean) -> None:
    s = np.array([1, 1, 0]) / np.sqrt(2)
    mesh = st.block(divisions=(2, 2, 2))
    count = len(mesh.surface_nodes("zmin"))
    expected = drift(s, rubber)
    # Grooves at 45 degrees: tau is along (mu_1 + mu_2, mu_1 - mu_2)/2.
    assert expected == pytest.approx(-0.6, abs=0.02)
    assert drift(st.Nodal(np.tile(s, (count, 1))), rubber) == pytest.approx(expected)
    assert drift(st.Painted([[0, 0, 0]], [s], width=1.0), rubber) == pytest.approx(expected)
    assert drift(st.Axial(s), rubber) == pytest.approx(expected)
    # From outside, that is from below, counter-clockwise is from x to -y.
    assert drift(st.Uniform((1, 0, 0), turn=-45), rubber) == pytest.approx(expected)
    assert drift(st.Uniform((1, 0, 0)), rubber) == pytest.approx(0, abs=1e-6)
    circles = st.Circumferential((0, 0, 1), point=(0.5, -1e6, 0), turn=-45)
    assert abs(drift(circles, rubber)) == pytest.approx(0.6, abs=0.02)
    assert abs(drift(st.Radial((0, 0, 1), point=(-1e6, 0.5, 0)), rubber)) < 1e-3


def test_rigid_bodies_press_and_are_driven(rubber: st.NeoHookean) -> None:
    body = st.Body("pad", st.block(divisions=(2, 2, 2)), rubber)
    lid = st.block((3, 3, 1), origin=(-1, -1, 1))
    stamp = st.RigidSurface("stamp", (lid.points, {"quad": lid.boundary}), density=2.0)
    model = st.Model([body], [stamp], [st.Pair(body["zmax"], stamp)])
    model.step("press", body["zmin"].hold(), stamp.move(displacement=(0, 0, -0.01)), increments=2)
    model.step(
        "weigh", stamp.move(free=["z"], force=(0, 0, -2e3)), increments=2
    )
    run = model.run(keep="steps")
    assert run[0].rigid("stamp").displacement[2] == pytest.approx(-0.01)
    assert run[1].pair(0).force[2] == pytest.approx(-2e3, rel=1e-6)


def test_tied_bodies_turn(rubber: st.NeoHookean) -> None:
    body = st.Body("pad", st.block(divisions=(2, 2, 2)), rubber)
    grip = st.RigidBody("grip", [body["zmax"]], reference=(0.5, 0.5, 1))
    model = st.Model([body], [grip])
    model.step("twist", body["zmin"].hold(), grip.move(rotation=(0, 0, 10)), increments=2)
    end = model.run()[-1]
    assert end.rigid("grip").rotation[2] == pytest.approx(10)
    assert end.rigid("grip").torque[2] > 0


def test_loads_are_carried(rubber: st.NeoHookean) -> None:
    soft = st.LinearElastic(1e6, 0.0)
    for load, expected in [
        (lambda s: s.traction((0, 0, -1e3)), 1e3),
        (lambda s: s.traction((0, 0, -1e3), direction="follower"), 1e3),
        (lambda s: s.pressure(1e3, extent="exposed", curve="smooth"), 1e3),
    ]:
        body = st.Body("bar", st.block(), soft)
        model = st.Model([body])
        model.step("load", body["zmin"].hold(), load(body["zmax"]), increments=1)
        assert model.run()[-1].reaction("bar", "zmin")[2] == pytest.approx(expected, rel=1e-6)


def test_energy_that_the_time_integration_creates_is_told() -> None:
    """Without damping, accelerations of two free bodies on a spring alternate and grow."""

    def pulled(spectral_radius: float) -> st.Run:
        rigid = []
        for name, size, at in [("plate", (0.3, 0.2, 0.1), 0.0), ("cube", (0.2, 0.2, 0.2), 1.0)]:
            corners = np.array([[i, j, k] for k in (0, 1) for j in (0, 1) for i in (0, 1)]) - 0.5
            faces = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]]
            mesh = (corners * size + [at, 0, 0], {"quad": np.array(faces)})
            rigid.append(st.RigidSurface(name, mesh, density=1000.0 if at == 0 else 500.0))
        plate, cube = rigid
        held = st.Body("held", st.block((0.1, 0.1, 0.1), (1, 1, 1), origin=(5, 5, 5)), st.NeoHookean(1e6, 0.3), density=1.0)
        spring = st.Spring(plate, cube, point=(0.15, 0.1, 0.05), point_b=(0.9, -0.1, 0.1), stiffness=50, free_length=0.5)
        pairs = [st.Pair(held["zmin"], body) for body in rigid]
        model = st.Model([held], rigid, pairs, springs=[spring])
        free = [body.move(free=["x", "y", "z", "rx", "ry", "rz"]) for body in rigid]
        start = plate.velocity((0, 0.3, 0), spin=(0, 0, 1))
        dynamics = st.Dynamics(spectral_radius)
        model.step("fly", held["zmax"].hold(), *free, start, duration=2.0, increments=200, dynamics=dynamics)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            return model.run()

    told = [[str(warning) for warning in pulled(radius).warnings if "time integration" in str(warning)] for radius in (1.0, 0.8)]
    assert len(told[0]) == 1 and "take a smaller `spectral_radius`" in told[0][0]
    assert told[1] == []


def test_gravity_is_stated_once() -> None:
    with pytest.raises(st.ModelError, match="step `fall`: gravity is stated twice; state the sum"):
        st.Step("fall", st.gravity((0, 0, -2)), st.gravity((1, 0, 0)))


def test_gravity_inertia_and_spin(rubber: st.NeoHookean) -> None:
    body = st.Body("bar", st.block(divisions=(2, 2, 2)), rubber, density=1e3)
    model = st.Model([body])
    spin = body.velocity((1, 0, 0), spin=(0, 0, 2), about=(0.5, 0.5, 0))
    dynamics = st.Dynamics(0.8)
    model.step("fly", spin, st.gravity((0, 0, -10), curve="constant"), duration=1e-2, dynamics=dynamics)
    end = model.run()[-1]
    assert end.body("bar").velocity[:, 0].mean() == pytest.approx(1, rel=1e-2)
    assert end.body("bar").velocity[:, 2].mean() == pytest.approx(-0.1, rel=1e-2)
    corner = end.body("bar").velocity[np.argmax(body.mesh.points.sum(axis=1))]
    assert corner[1] == pytest.approx(1, rel=0.1)


def test_curves_and_increment_sizes(pad: st.Body) -> None:
    model = st.Model([pad])
    curve = [(0, 0), (0.5, 1), (1, 0.25)]
    pull = pad["zmax"].displace(z=0.1, curve=curve)
    sizes = st.Increments(0.25, smallest=0.01, largest=0.25)
    model.step("pull", pad["zmin"].hold(), pull, increments=sizes, duration=4)
    run = model.run(keep="all")
    top = pad.mesh.node_sets["zmax"][0]
    found = [increment.body("pad").displacement[top, 2] for increment in run]
    assert np.allclose(found, [0.05, 0.1, 0.0625, 0.025])
    assert run.history["time"].tolist() == [1, 2, 3, 4]


def test_releases_end_what_is_prescribed(pad: st.Body) -> None:
    model = st.Model([pad])
    model.step("pull", pad["zmin"].hold(), pad["zmax"].displace(z=0.1), increments=1)
    model.step("let go", pad["zmax"].release(), increments=1)
    assert np.abs(model.run()[-1].body("pad").displacement).max() < 1e-8


def test_friction_changes_between_steps(model: st.Model, pad: st.Body) -> None:
    pair = model._pairs[0]
    model.step("ease", pair.change_friction(st.Orthotropic(0.1, 0.2)), pad["zmax"].displace(y=0.6))
    force = model.run(keep="last")[-1].pair(0).force
    assert force[1] / force[2] == pytest.approx(-0.2, abs=1e-3)


def test_check_tells_how_meshes_fit(model: st.Model, pad: st.Body) -> None:
    found = model.check()
    assert found.unknowns > 81
    (fit,) = found.fits
    assert fit.pair == "pad-floor" and fit.gap == pytest.approx(0) and fit.overlap == 0
    far = st.Plane("far", point=(0, 0, -0.5))
    model = st.Model([pad], [far], [st.Pair(pad["zmin"], far)])
    model.step("hold", pad["zmax"].hold())
    assert model.check().fits[0].gap == pytest.approx(0.5)


def test_gaps_are_closed_where_asked_for(rubber: st.NeoHookean) -> None:
    body = st.Body("pad", st.block(origin=(0, 0, 0.01), divisions=(2, 2, 2)), rubber)
    floor = st.Plane("floor")
    for initial, gap in [("as-meshed", 0.01), ("close", 0.0), (0.02, 0.0), (0.001, 0.01)]:
        pair = st.Pair(body["zmin"], floor, initial=initial)  # type: ignore[arg-type]
        model = st.Model([body], [floor], [pair])
        model.step("hold", body["zmax"].hold())
        assert model.check().fits[0].gap == pytest.approx(gap, abs=1e-12)


def test_solvers_agree(model: st.Model) -> None:
    expected = model.run()[-1].pair(0).force
    for backend in ("multifrontal", "faer", "iterative"):
        model._solver = st.Solver(backend)
        difference = model.run()[-1].pair(0).force - expected
        assert np.linalg.norm(difference) < 1e-9 * np.linalg.norm(expected)


def test_pictures_are_drawn(model: st.Model, tmp_path: Path) -> None:
    run = model.run()
    figure = run.plot()
    figure.savefig(tmp_path / "run.png")
    assert len(figure.axes) == 4  # history, patch, its colours, law
    assert (tmp_path / "run.png").stat().st_size > 10_000
    axes = run.history.plot("energy.friction", "energy.strain")
    assert [line.get_label() for line in axes.lines] == ["energy.friction", "energy.strain"]
    st.TwoTextures(0.3, 0.4, 0.1, 0.2).plot(theta=30)
    run[-1].pair(0).plot()


def test_grids_of_pyvista_have_the_fields(model: st.Model) -> None:
    pytest.importorskip("pyvista")
    blocks = model.run().to_pyvista()
    assert list(blocks.keys()) == ["pad", "contact-pad-floor-a"]
    assert blocks["pad"].n_points == 27 and blocks["pad"].n_cells == 8
    assert "pressure" in blocks["contact-pad-floor-a"].point_data
    assert st.Mesh.of(blocks["pad"]).volume == pytest.approx(blocks["pad"].volume)


@pytest.mark.parametrize(
    ("word", "kind"),
    [
        ("hexahedra", "hexahedron"),
        ("wedges", "wedge"),
        ("pyramids", "pyramid"),
        ("tetrahedra", "tetra"),
        ("composite-tetrahedra", "tetra10"),
    ],
)
def test_meshes_of_all_kinds_of_cells_are_pressed(word: Any, kind: str) -> None:
    made = st.block(divisions=(2, 2, 2), cells=word)
    assert list(made.cells) == [kind]
    assert made.volume == pytest.approx(1, rel=1e-14)
    again = st.Mesh(made.points, made.cells, facet_sets=made.facet_sets, node_sets=made.node_sets)
    assert np.array_equal(again.cells[kind], made.cells[kind])
    rubber = st.MooneyRivlin(0.2, 0.05, poissons_ratio=0.49)
    block, floor = st.Body("block", again, rubber), st.Plane("floor")
    model = st.Model([block], [floor], [st.Pair(block["zmin"], floor)])
    model.step("press", block["zmax"].displace(x=0, y=0, z=-0.05), increments=1)
    force = model.run()[-1].pair(0).force
    assert 0.05 < force[2] < 0.3


def test_triangles_are_facets_in_any_order() -> None:
    made = st.block(cells="tetrahedra")
    top = made.facet_sets["zmax"]
    assert (top[:, 2] == top[:, 3]).all()
    again = made.with_sets(facets={"lid": np.roll(top[:, :3], 1, axis=1)})
    assert np.array_equal(again.facet_sets["lid"], top)


def test_rubber_has_the_moduli_of_its_constants() -> None:
    ratio = 0.4
    laws: list[tuple[st.Material, float]] = [
        (st.IsochoricNeoHookean(0.5, poissons_ratio=ratio), 0.5),
        (st.MooneyRivlin(0.2, 0.05, poissons_ratio=ratio), 0.5),
        (st.Yeoh(0.3, -0.01, 0.002, poissons_ratio=ratio), 0.6),
        (st.Ogden([(0.63, 1.3), (-0.01, -2.0)], poissons_ratio=ratio), 0.4195),
        (st.Gent(0.5, 30.0, poissons_ratio=ratio, volumetric="logarithmic"), 0.5),
    ]
    for law, shear in laws:
        assert law.poissons_ratio == pytest.approx(ratio, rel=1e-12)
        assert law.youngs_modulus == pytest.approx(2 * shear * (1 + ratio), rel=1e-12)
        assert np.abs(law.stress(np.eye(3))).max() < 1e-12
    chains = st.ArrudaBoyce(0.5, 3.0, bulk_modulus=100.0)
    assert chains.youngs_modulus > 1.5


def test_rubber_that_is_no_solid_is_refused() -> None:
    with pytest.raises(st.ModelError, match="the shear modulus -0.2 at rest"):
        st.MooneyRivlin(0.1, -0.2, poissons_ratio=0.49)
    with pytest.raises(st.ModelError, match="either `bulk_modulus` or `poissons_ratio` is needed"):
        st.Gent(0.5, 30.0)
    with pytest.raises(st.ModelError, match="`alpha` of term 0 is 0"):
        st.Ogden([(1.0, 0.0)], bulk_modulus=10.0)


def test_friction_depends_on_pressure_and_slip_rate() -> None:
    law = st.Coulomb(0.3)
    power = law.with_power_law(0.5, 4.0)
    assert np.allclose(power.bound([1.0, 9.0]), [0.6, 1.8], rtol=1e-14)
    assert repr(power) == "Coulomb(mu=0.3).with_power_law(exponent=0.5, pressure=4.0)"
    assert np.allclose(law.with_adhesion(2.0).bound(5.0), 2.1, rtol=1e-14)
    assert np.allclose(law.with_saturation(0.2).bound(5.0), 0.2 * np.tanh(7.5), rtol=1e-14)
    table = law.with_table_by_pressure([1, 2], [1, 0.9])
    assert np.allclose(table.bound([0.5, 2, 4]), [0.15, 0.54, 1.08], rtol=1e-14)
    rates = np.array([0.0, 1.0, 3.0])
    stribeck = law.with_stribeck(0.5, 2.0, viscous=0.1)
    factor = 0.5 + 0.5 * np.exp(-((rates / 2.0) ** 2)) + 0.1 * rates
    assert np.allclose(stribeck.bound(np.ones(3), rates), 0.3 * factor, rtol=1e-14)
    rising = law.with_logarithm(0.1, 1e-3)
    assert np.allclose(rising.bound(np.full(3, 2.0), rates), 0.6 * (1 + 0.1 * np.log1p(rates / 1e-3)))
    run_in = law.with_exponential(1.5, 0.2)
    after = 0.6 * (1.5 - 0.5 * np.exp(-0.5))
    assert np.allclose(run_in.bound(2.0, 0.0, 0.1), after, rtol=1e-14)
    aged = law.with_ageing_law(0.01, 0.015, slip_rate=1e-6, slip_distance=1e-5)
    steady = 2 * (0.3 - 0.005 * np.log([1.0, 10.0]))
    assert np.allclose(aged.bound([2.0, 2.0], [1e-6, 1e-5]), steady, rtol=1e-12)
    both = law.with_table_by_slip_rate([0, 1], [1, 0.5]).with_power_law(0.5, 4.0)
    assert np.allclose(both.bound([9.0, 9.0], [0.0, 2.0]), [1.8, 0.9], rtol=1e-14)


@pytest.mark.parametrize(
    ("wrong", "told"),
    [
        (lambda law: law.with_power_law(0.0, 1.0), "exponent = 0 is refused"),
        (lambda law: law.with_power_law(0.5, "high"), "pressure: a number is needed"),
        (lambda law: law.with_stribeck(0.5, 1.0, exponent=0.5), "at least 1"),
        (lambda law: law.with_slip_law(0.0, 0.1, 1.0, 1.0), "direct_effect = 0 is refused"),
        (lambda law: law.with_logarithm(-0.5, 1.0), "vanish at the slip rate 6.389056"),
        (lambda law: law.with_table_by_pressure([1, 1], [1, 1]), "must ascend"),
        (lambda law: law.with_table_by_slip_rate([[1]], [1]), "one dimension"),
        (lambda law: law.bound([1.0, 2.0], [1.0, 2.0, 3.0]), "as many as pressures"),
        (lambda law: law.bound(1.0, -1.0), "must not be negative"),
    ],
)
def test_dependences_that_are_none(wrong: Callable[[st.Friction], object], told: str) -> None:
    with pytest.raises((st.ModelError, TypeError, ValueError), match=told):
        wrong(st.Coulomb(0.3))


def test_parts_are_copied_and_pickled(model: st.Model, pad: st.Body, floor: st.Plane) -> None:
    parts = [
        pad.material,
        st.Yeoh(1e5, 0, 0, bulk_modulus=1e7, relaxation=[(0.5, 1.0)]),
        st.Nap(0.1, 0.2, 0.15).with_decay(0.5, 1.0).with_shear_cap(3.0),
        st.Tabulated([0, 120, 240], [0.1, 0.2, 0.3]),
        st.Coulomb(0.3).with_power_law(2 / 3, 1e5).with_stribeck(0.5, 1.0, viscous=0.1),
        st.Coulomb(0.3).with_adhesion(1e4).with_logarithm(-0.1, 0.1, limit=1.0),
        st.Coulomb(0.3).with_saturation(1e4).with_table_by_slip_rate([0, 1], [1, 0.8]),
        st.Coulomb(0.3).with_table_by_pressure([0, 1e5], [1, 0.8]).with_exponential(1.5, 0.1),
        st.Coulomb(0.3).with_slip_law(0.01, 0.02, 1e-6, 1e-5, state=3.0),
        st.Circumferential((0, 0, 1), turn=3),
        pad["zmin"].textured((1, 0, 0)),
        floor,
        st.Pair(pad["zmin"], floor, st.Coulomb(0.3)),
        pad.mesh,
        pad,
    ]
    for part in parts:
        for again in (pickle.loads(pickle.dumps(part)), copy.deepcopy(part)):
            assert type(again) is type(part) and repr(again) == repr(part)
    again = pickle.loads(pickle.dumps(pad.mesh))
    assert np.array_equal(again.points, pad.mesh.points)
    assert {n: s.tolist() for n, s in again.facet_sets.items()} == {
        n: s.tolist() for n, s in pad.mesh.facet_sets.items()
    }
    fitted = st.fit_friction([0, 90, 180], [0.1, 0.2, 0.1], st.Orthotropic).friction
    assert isinstance(fitted, st.Orthotropic)
    for law in (parts[2], fitted):
        assert isinstance(law, st.Friction)
        same = pickle.loads(pickle.dumps(law))
        assert all(np.array_equal(a, b) for a, b in zip(law.slip_surface(), same.slip_surface()))
    one = model.run().history.table
    assert np.array_equal(pickle.loads(pickle.dumps(model)).run().history.table, one)
    copied = copy.deepcopy(model)
    copied.step("back", pad["zmax"].displace(y=0))
    assert model.step_names == ["press", "drag"] and len(copied.step_names) == 3
    assert np.array_equal(model.run().history.table, one)


def test_settings_can_be_read_in_notebooks() -> None:
    for made in (st.Solver("faer"), st.Increments(0.2), st.Dynamics()):
        assert repr(eval(repr(made), vars(st))) == repr(made)


def test_advice_is_that_of_the_program(model: st.Model) -> None:
    advice = model.advice()
    assert advice.faults == [] and advice.warnings == []
    topics = {remark.topic for remark in advice.notes}
    assert {"shape", "hold", "fit", "friction", "cost"} <= topics
    assert all(line.startswith("note: ") for line in str(advice).splitlines())
    named = [remark for remark in advice.notes if remark.name == "pad"]
    assert any("volume" in remark.text for remark in named)
    stiff = st.NeoHookean(youngs_modulus=1e6, poissons_ratio=0.4999)
    body = st.Body("pad", st.block(cells="tetrahedra", divisions=(2, 2, 2)), stiff)
    floor = st.Plane("floor", point=(0, 0, -100))
    far = st.Model([body], [floor], [st.Pair(body["zmin"], floor)])
    far.step("hold", body["zmax"].hold())
    assert {"never-meets", "locking"} <= {one.topic for one in far.advice().warnings}
