"""Contact as a component: closed forms, invariance, states that are stored, wrong uses."""

from __future__ import annotations

import copy
import pickle
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import striae as st
from striae.contact import Contact, Evaluation, Pair, State, Surface

#: Stiffness of the springs per area, coefficient of friction, depth of the press.
K, MU, D = 100.0, 0.3, 0.01
PAD = st.block(divisions=(3, 2, 1))
UNDERSIDE = PAD.surface_nodes("zmin")
#: Underside of a block, counted on its own.
POINTS = PAD.points[UNDERSIDE]
FACETS = np.searchsorted(UNDERSIDE, PAD.facet_sets["zmin"])


def pad(law: st.Friction | None = None, floor: Any = None, points: Any = POINTS) -> Contact:
    rigid = st.Plane("floor") if floor is None else floor
    return Contact(points, [Pair(Surface(FACETS, youngs_modulus=K), rigid, law, name="sole")])


#: Stiffnesses of the springs that hold the nodes.
SPRINGS = np.zeros(POINTS.shape)
np.add.at(SPRINGS, FACETS.ravel(), 0.25 * K / len(FACETS))
FREE = np.zeros(POINTS.shape, dtype=bool)


def moved(
    contact: Contact,
    state: State,
    motion: Any,
    anchors: Any = POINTS,
    held: Any = FREE,
    duration: float | None = None,
) -> tuple[State, Evaluation]:
    """Newton's method for nodes on springs, or held, on a floor that has moved."""
    rigid = {"floor": motion}
    increment = contact.begin(state, prescribed=held, rigid=rigid, duration=duration)
    x, tractions = state.positions, increment.tractions
    found = increment.evaluate(x, tractions)
    for _ in range(40):
        tangent = np.zeros((increment.unknowns, increment.unknowns))
        np.add.at(tangent, (found.rows, found.cols), found.values)
        tangent[np.arange(x.size), np.arange(x.size)] += SPRINGS.ravel()
        residual = np.array(found.residual)
        residual[: x.size] += (SPRINGS * (x - anchors)).ravel()
        moves = np.concatenate([~held.ravel(), np.ones(len(tractions), dtype=bool)])
        if found.number > 0 and max(found.norm, np.abs(residual[moves]).max() / K) < 1e-13:
            if not len(increment.missed(found)):
                return increment.accept(found), found
            increment = increment.reselected(found)
            tractions = increment.tractions
            found = increment.evaluate(x, tractions)
            continue
        change = np.zeros(increment.unknowns)
        change[moves] = np.linalg.solve(tangent[moves][:, moves], -residual[moves])
        x, tractions = x + change[: x.size].reshape(-1, 3), tractions + change[x.size :]
        found = increment.evaluate(x, tractions, after=found)
    raise AssertionError("no convergence")


def test_a_pad_on_springs_sticks_and_slips_as_in_closed_form() -> None:
    contact = pad(st.Coulomb(MU))
    state, found = moved(contact, contact.untouched(), (0, 0, D))
    np.testing.assert_allclose(found.pair().force, [0, 0, K * D], atol=1e-12)
    for u in (1e-3, 2e-3, 4e-3, 6e-3):
        state, found = moved(contact, state, (u, 0, D))
        np.testing.assert_allclose(
            found.pair("sole").force, [min(K * u, MU * K * D), 0, K * D], atol=1e-12
        )
    side = found.pair().a
    assert (side.status == st.Status.SLIP).all()
    np.testing.assert_allclose(side.pressure, K * D, rtol=1e-11)
    np.testing.assert_array_equal(side.nodes, np.arange(len(POINTS)))
    np.testing.assert_allclose(found.forces.sum(axis=0), found.pair().force, atol=1e-13)
    np.testing.assert_array_equal(found.pair().force_b, -found.pair().force)
    # From u = 3e-3 on the floor slides below the pad.
    np.testing.assert_allclose(state.dissipated, [MU * K * D * 3e-3], rtol=1e-10)


def test_a_texture_turns_friction() -> None:
    angle = np.pi / 6
    grooves = (np.cos(angle), np.sin(angle), 0)
    contact = pad(st.Orthotropic(mu_along=0.1, mu_across=0.4), st.Plane("floor", texture=grooves))
    state, _ = moved(contact, contact.untouched(), (0, 0, D))
    _, found = moved(contact, state, (0.05, 0, D))
    assert (found.pair().a.status == st.Status.SLIP).all()
    friction = found.pair().force[:2] / (K * D)
    along = friction @ grooves[:2]
    across = friction @ (-np.sin(angle), np.cos(angle))
    # On the slip surface, an ellipse, and not against slip.
    np.testing.assert_allclose((along / 0.1) ** 2 + (across / 0.4) ** 2, 1.0, rtol=1e-9)
    assert abs(friction[1]) > 0.05


def rotation() -> Any:
    """A rigid motion."""
    axis, angle = np.array([1.0, 2.0, 2.0]) / 3.0, 0.7
    cross = np.cross(np.eye(3), axis) * -1.0
    motion = np.eye(4)
    motion[:3, :3] += np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross
    motion[:3, 3] = [3.0, -1.0, 2.0]
    return motion


def test_a_rigid_motion_of_everything_turns_the_forces() -> None:
    motion = rotation()
    turn, shift = motion[:3, :3], motion[:3, 3]
    points = np.array([[-1, -1, 0], [3, -1, 0], [3, 3, 0], [-1, 3, 0]], dtype=float)
    floor = st.RigidSurface("floor", (points, {"quad": [[0, 1, 2, 3]]}), texture=(1, 0.4, 0))
    law = st.Orthotropic(mu_along=0.1, mu_across=0.4)
    straight, turned = pad(law, floor), pad(law, floor, POINTS @ turn.T + shift)
    anchors = POINTS @ turn.T + shift
    states = [straight.untouched(), turned.untouched()]
    for way in ([0, 0, -0.2], [0, 0, D], [0.02, 0.01, D]):
        placed = motion.copy()
        placed[:3, 3] += turn @ way
        states[0], found = moved(straight, states[0], way)
        states[1], again = moved(turned, states[1], placed, anchors)
        np.testing.assert_allclose(again.pair().force, turn @ found.pair().force, atol=1e-11)


def test_a_state_continues_after_storage_to_the_bit() -> None:
    contact = pad(st.Coulomb(MU))
    state, _ = moved(contact, contact.untouched(), (0, 0, D))
    again, stored = pickle.loads(pickle.dumps((contact, state)))
    np.testing.assert_array_equal(stored.positions, state.positions)
    _, found = moved(contact, state, (5e-3, 0, D))
    _, repeated = moved(again, stored, (5e-3, 0, D))
    np.testing.assert_array_equal(found.residual, repeated.residual)
    np.testing.assert_array_equal(copy.deepcopy(state).positions, state.positions)


def test_friction_by_rate_and_state_needs_a_duration() -> None:
    law = st.Coulomb(MU).with_ageing_law(0.01, 0.015, 1.0, 1.0)
    contact = pad(law)
    with pytest.raises(st.ModelError, match=r"duration: friction of pairs\[0\] has a state or a factor"):
        contact.begin(contact.untouched())


def test_friction_by_the_slip_rate_takes_the_duration() -> None:
    law, u, duration = st.Coulomb(MU).with_stribeck(0.5, 0.02), 0.06, 0.5
    contact = pad(law)
    state, _ = moved(contact, contact.untouched(), (0, 0, D), duration=duration)
    _, found = moved(contact, state, (u, 0, D), duration=duration)
    friction = found.pair().force[0]
    slip = u - friction / K
    np.testing.assert_allclose(friction, law.bound(K * D, slip / duration), rtol=1e-9)
    assert friction < 0.8 * MU * K * D


def test_what_is_held_takes_friction_only_where_it_is_driven() -> None:
    held = np.broadcast_to([False, True, False], POINTS.shape)
    contact = pad(st.Coulomb(MU))
    pressed, _ = moved(contact, contact.untouched(), (0, 0, D), held=held)
    # Nothing moves along y, where friction would be undetermined.
    _, found = moved(contact, pressed, (1e-3, 0, D), held=held)
    np.testing.assert_allclose(found.pair().force, [K * 1e-3, 0, K * D], atol=1e-12)
    # The floor drives the pad along y: friction is against the whole slip.
    _, found = moved(contact, pressed, (0.01, 0.02, D), held=held)
    friction = found.pair().force[:2]
    slip = np.array([0.01 - friction[0] / K, 0.02])
    np.testing.assert_allclose(friction, MU * K * D * slip / np.linalg.norm(slip), rtol=1e-9)


@pytest.mark.parametrize("law", [None, st.Coulomb(0.2)], ids=["frictionless", "friction"])
def test_surfaces_of_two_pairs_share_nodes(law: st.Friction | None) -> None:
    """A corner between a floor and a wall, on springs across them and soft ones along them."""
    block = st.block(divisions=(2, 2, 2))
    points, springs = block.points, np.full(block.points.shape, 1e-3)
    pairs = []
    for axis, (name, facets) in [(2, ("floor", "zmin")), (0, ("wall", "xmin"))]:
        corners = block.facet_sets[facets]
        np.add.at(springs[:, axis], corners.ravel(), 0.25 * K / len(corners))
        plane = st.Plane(name, normal=np.eye(3)[axis])
        pairs.append(Pair(Surface(corners, youngs_modulus=K), plane, law, name=name))
    contact = Contact(points, pairs)
    increment = contact.begin(
        contact.untouched(), rigid={"floor": (0, 0, D), "wall": (2 * D, 0, 0)}
    )
    assert [one.pair for one in increment.kept] == [0] * 9 + [1] * 9
    x, tractions = points, increment.tractions
    found = increment.evaluate(x, tractions)
    for _ in range(20):
        tangent = np.zeros((increment.unknowns, increment.unknowns))
        np.add.at(tangent, (found.rows, found.cols), found.values)
        tangent[np.arange(x.size), np.arange(x.size)] += springs.ravel()
        residual = np.array(found.residual)
        residual[: x.size] += (springs * (x - points)).ravel()
        change = np.linalg.solve(tangent, -residual)
        x, tractions = x + change[: x.size].reshape(-1, 3), tractions + change[x.size :]
        found = increment.evaluate(x, tractions, after=found)
    left = found.residual[: x.size] + (springs * (x - points)).ravel()
    assert max(found.norm, np.abs(left).max()) < 1e-11
    floor, wall = found.pair("floor").force, found.pair("wall").force
    np.testing.assert_allclose(floor + wall, (springs * (x - points)).sum(axis=0), atol=1e-11)
    if law is None:
        np.testing.assert_allclose([floor[2], wall[0]], [K * D, 2 * K * D], rtol=1e-4)
        np.testing.assert_allclose([floor[0], wall[2]], 0.0, atol=1e-12)
    else:
        # The floor holds the pad against the wall, and the wall against the floor.
        assert -0.2 * floor[2] <= floor[0] < 0.0
        assert -0.2 * wall[0] <= wall[2] < 0.0


def test_the_page_runs_as_it_is_printed(capsys: pytest.CaptureFixture[str]) -> None:
    page = Path(__file__).parents[3] / "docs" / "book" / "how-to" / "own-elements.md"
    (piece,) = re.findall(r"```python\n(.*?)```", page.read_text(encoding="utf-8"), re.DOTALL)
    names: dict[str, Any] = {}
    exec(compile(piece, page.name, "exec"), names)
    printed = [np.fromstring(line.strip("[]"), sep=" ") for line in capsys.readouterr().out.splitlines()]
    np.testing.assert_allclose(printed, [[100, 0, 1e3], [200, 0, 1e3], [300, 0, 1e3]], atol=1e-6)


def with_facets(facets: Any, **named: Any) -> Callable[[], Any]:
    given = {"youngs_modulus": K, **named}
    return lambda: Contact(POINTS, [Pair(Surface(facets, **given), st.Plane("floor"))])


def evaluated(positions: Any, tractions: Any) -> Callable[[], Any]:
    contact = pad()
    return lambda: contact.begin(contact.untouched()).evaluate(positions, tractions)


def begun(**given: Any) -> Callable[[], Any]:
    contact = pad()
    return lambda: contact.begin(contact.untouched(), **given)


LOST = np.where(np.arange(POINTS.size).reshape(POINTS.shape) == 4, np.nan, POINTS)
DEGENERATE = (
    "pairs[0].a.facets: facet 0 is degenerate: it needs three or four corners that differ, in order"
    " around it, and an area"
)

#: Wrong uses, and their messages.
MODEL_ERRORS: list[tuple[Callable[[], Any], str]] = [
    (
        with_facets([[0, 1]]),
        "facets: an array of shape (m, 3) or (m, 4) is needed, but it has shape (1, 2)",
    ),
    (
        with_facets([[0, 1, 5, 99]]),
        "pairs[0].a.facets: facet 0 has node 99, but there are 12 nodes; they count from 0",
    ),
    (with_facets([[0, -1, 5, 4]]), "quad: numbers count from 0, but there is -1"),
    (with_facets([[0, 1, 1, 4]]), DEGENERATE),
    (with_facets([[0, 1, 2]]), DEGENERATE),
    (with_facets([[0, 5, 1, 4]]), DEGENERATE),
    (with_facets(FACETS, youngs_modulus=0.0), "youngs_modulus: it must be positive, but is 0.0"),
    (
        with_facets(FACETS, youngs_modulus=np.nan),
        "youngs_modulus: a finite number is needed, not nan",
    ),
    (lambda: pad(points=LOST), "points: row 1 is not finite: [0.3333333333333333, nan, 0.0]"),
    (
        lambda: pad(points=POINTS[:, :2]),
        "points: an array of shape (n, 3) is needed, but it has shape (12, 2)",
    ),
    (
        lambda: pad(st.Orthotropic(mu_along=0.1, mu_across=0.4)),
        "pairs[0].friction: the friction law needs a texture on one side, but 0 are given",
    ),
    (lambda: Contact(POINTS, []), "pairs: there is none; at least one is needed"),
    (
        begun(prescribed=np.zeros((2, 3))),
        "prescribed: an array of booleans of shape (n, 3) is needed, but it has dtype float64 and"
        " shape (2, 3)",
    ),
    (
        begun(prescribed=np.zeros((2, 3), dtype=bool)),
        "prescribed: 6 are given, but 36 are needed",
    ),
    (begun(end=POINTS[1:]), "end: 11 are given, but 12 are needed"),
    (
        begun(rigid={"flour": (0, 0, 1)}),
        "rigid['flour']: there is no such rigid surface; known: `floor`",
    ),
    (
        begun(rigid={"floor": 2 * np.eye(4)}),
        "rigid['floor']: it is no rigid motion: rows are those of [[R, s], [0, 1]], R a rotation",
    ),
    (begun(duration=-1.0), "duration: it must be positive, but is -1.0"),
    (evaluated(POINTS[1:], np.zeros(36)), "positions: 11 are given, but 12 are needed"),
    (evaluated(LOST, np.zeros(36)), "positions: row 1 is not finite: [0.3333333333333333, nan, 0.0]"),
    (evaluated(POINTS, np.zeros(35)), "tractions: 35 are given, but 36 are needed"),
    (evaluated(POINTS, np.full(36, np.inf)), "tractions: row 0 is not finite"),
    (evaluated(np.zeros((12, 3)), np.zeros(36)), DEGENERATE),
]


@pytest.mark.parametrize("use, message", MODEL_ERRORS, ids=[text[:40] for _, text in MODEL_ERRORS])
def test_a_wrong_use_is_met_by_exact_words(use: Callable[[], Any], message: str) -> None:
    with pytest.raises(st.ModelError) as caught:
        use()
    assert str(caught.value) == message


def test_values_of_other_contacts_are_refused() -> None:
    contact = pad()
    other = Contact(POINTS[[0, 1, 5, 4]], [Pair(Surface([[0, 2, 1]], youngs_modulus=K), st.Plane("floor"))])
    foreign = "it belongs to other surfaces; use one that this contact has made"
    with pytest.raises(st.ModelError, match=f"state: {foreign}"):
        contact.begin(other.untouched())
    # The mesh with its other side, which has as many nodes.
    opposite = [facet[::-1] for facet in FACETS]
    ceiling = st.Plane("ceiling", normal=(0, 0, -1))
    turned = Contact(POINTS, [Pair(Surface(opposite, youngs_modulus=K), ceiling)])
    with pytest.raises(st.ModelError, match=f"state: {foreign}"):
        contact.begin(turned.untouched())
    begun = contact.begin(contact.untouched())
    theirs = other.begin(other.untouched())
    found = theirs.evaluate(POINTS[[0, 1, 5, 4]], theirs.tractions)
    # As large as its own, and no less foreign.
    like = pad().begin(pad().untouched())
    of_another = "it belongs to another increment; use one that this increment has made"
    for evaluation in (found, like.evaluate(POINTS, like.tractions)):
        for use in (begun.accept, begun.missed, begun.reselected):
            with pytest.raises(st.ModelError, match=of_another):
                use(evaluation)
        with pytest.raises(st.ModelError, match=f"after: {of_another}"):
            begun.evaluate(POINTS, begun.tractions, after=evaluation)
    damaged = bytearray(pickle.dumps(contact.untouched()._native.stored()))
    with pytest.raises(st.ModelError, match="state: it is one of another version, or none"):
        st.contact._restored(bytes(damaged))
    with pytest.raises(TypeError, match="an object of class State is needed"):
        contact.begin(begun)  # type: ignore[arg-type]
    with pytest.raises(TypeError, match="b: a Surface, Plane or RigidSurface is needed, not str"):
        Pair(Surface(FACETS, youngs_modulus=K), "floor")  # type: ignore[arg-type]


def test_rigid_surfaces_of_one_name_are_one_surface() -> None:
    def of(*planes: st.Plane) -> Contact:
        surface = Surface(FACETS, youngs_modulus=K)
        return Contact(POINTS, [Pair(surface, one, name=str(at)) for at, one in enumerate(planes)])

    wall = st.Plane("wall")
    assert [pair.rigid for pair in of(wall, wall).pairs] == ["wall", "wall"]
    assert len(pickle.loads(pickle.dumps(of(wall, st.Plane("wall")))).pairs) == 2
    with pytest.raises(st.ModelError) as caught:
        of(wall, st.Plane("floor"), st.Plane("wall", point=(0, 0, 4)))
    assert str(caught.value) == (
        "pairs[2]: its rigid surface `wall` differs from another of this name; rename one"
    )
