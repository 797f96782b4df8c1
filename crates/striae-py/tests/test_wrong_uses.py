"""Wrong uses and the exact words that meet them."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import striae as st

POINTS = st.block().points
CELLS = st.block().cells["hexahedron"]
RUBBER = st.NeoHookean(1e6, 0.3)


def pad() -> st.Body:
    return st.Body("pad", st.block(), RUBBER)


def nan_points() -> Any:
    points = np.array(POINTS)
    points[3, 1] = np.nan
    return points


def built(*steps: Any, **parts: Any) -> st.Model:
    body = pad()
    model = st.Model(parts.get("bodies", [body]), parts.get("rigid", []), parts.get("pairs", []))
    for number, conditions in enumerate(steps):
        model.step(f"s{number}", *conditions(body))
    return model


def floored(law: st.Friction | None, texture: Any = None) -> st.Model:
    body, floor = pad(), st.Plane("floor", texture=texture)
    model = st.Model([body], [floor], [st.Pair(body["zmin"], floor, law)])
    model.step("press", body["zmax"].displace(x=0, y=0, z=-0.01))
    return model


def steady() -> st.Run:
    return floored(None).run()


def paired(floor: st.Plane, other: st.Plane) -> st.Model:
    return st.Model([pad()], [floor], [st.Pair(pad()["zmin"], other)])


SETS = "`all`, `xmax`, `xmin`, `ymax`, `ymin`, `zmax`, `zmin`"

#: Wrong uses, and their messages.
MODEL_ERRORS: list[tuple[Callable[[], Any], str]] = [
    (
        lambda: st.Mesh(POINTS[:, :2], {"hexahedron": CELLS}),
        "points: an array of shape (n, 3) is needed, but it has shape (8, 2)",
    ),
    (
        lambda: st.Mesh(POINTS.ravel(), {"hexahedron": CELLS}),
        "points: an array of shape (n, 3) is needed, but it has shape (24,)",
    ),
    (
        lambda: st.Mesh([["a", "b", "c"]], {"hexahedron": CELLS}),
        "points: numbers are needed, but the array has dtype <U1",
    ),
    (
        lambda: st.Mesh(POINTS.astype(complex), {"hexahedron": CELLS}),
        "points: numbers are needed, but the array has dtype complex128",
    ),
    (
        lambda: st.Mesh([[0, 0, 0], [1, 0]], {"hexahedron": CELLS}),  # type: ignore[list-item]
        "points: the rows must all have the same length",
    ),
    (
        lambda: st.Mesh(nan_points(), {"hexahedron": CELLS}),
        "points: row 3 is not finite: [1.0, nan, 0.0]",
    ),
    (
        lambda: st.Mesh(POINTS, {"hexahedron20": CELLS}),
        "cells: the kinds are ['hexahedron', 'wedge', 'pyramid', 'tetra', 'tetra10'],"
        " but there is ['hexahedron20']",
    ),
    (
        lambda: st.Mesh(POINTS, {"hexahedron": CELLS[:, :6]}),
        "cells: an array of shape (n, 8) is needed, but it has shape (1, 6)",
    ),
    (
        lambda: st.Mesh(POINTS, {"hexahedron": CELLS.astype(float)}),
        "cells: integers are needed, but the array has dtype float64",
    ),
    (
        lambda: st.Mesh(POINTS, {"hexahedron": CELLS - 1}),
        "cells: numbers count from 0, but there is -1",
    ),
    (
        lambda: st.Mesh(POINTS, {"hexahedron": CELLS + 1}),
        "mesh: element 0 refers to node 8, but the mesh has 8 nodes",
    ),
    (
        lambda: st.Mesh(np.vstack([POINTS, [2, 2, 2]]), {"hexahedron": CELLS}),
        "mesh: 1 nodes belong to no element, the first is node 8",
    ),
    (
        lambda: st.Mesh(POINTS, {"hexahedron": CELLS}, node_sets={"top": [0, 9]}),
        "mesh: node set 'top' refers to node 9, but the mesh has 8 nodes",
    ),
    (
        lambda: st.Mesh(POINTS, {"hexahedron": CELLS}, node_sets={"top": [True, False]}),
        "node set `top`: a mask of shape (8,) is needed, but it has shape (2,)",
    ),
    (
        lambda: st.Mesh(POINTS, {"hexahedron": CELLS}, node_sets={"top": lambda x: x[:, 2]}),
        "node set `top`: the function must return a mask, but its dtype is float64",
    ),
    (
        lambda: st.Mesh(POINTS, {"hexahedron": CELLS}, facet_sets={"top": [[0, 1, 2, 4]]}),
        "facet set `top`: row 0, [0, 1, 2, 4], is not a face of the boundary",
    ),
    (
        lambda: st.Mesh(np.zeros((0, 3)), {"hexahedron": np.zeros((0, 8), dtype=int)}),
        "cells: a mesh needs at least one cell",
    ),
    (
        lambda: st.Pair(pad()["zmin"], st.Plane("f"), initial=-1.0),
        "initial: it must be positive, but is -1.0",
    ),
    (
        lambda: st.read_measurements("none.csv"),
        "none.csv: it cannot be read: [Errno 2] No such file or directory: 'none.csv'",
    ),
    (lambda: st.block(size=(1, 1)), "size: 3 numbers are needed, but it has shape (2,)"),
    (lambda: st.block(divisions=(2, 0, 2)), "divisions: at least 1 is needed, but there is 0"),
    (
        lambda: st.block(divisions=(2.5, 1, 1)),  # type: ignore[arg-type]
        "divisions: integers are needed, but the array has dtype float64",
    ),
    (
        lambda: st.block(grading={"w": {"one_sided": 2}}),
        "grading: its keys are `x`, `y`, `z`, but there is `w`",
    ),
    (
        lambda: st.read_mesh("a.obj"),
        "mesh: a.obj: unknown kind of file; expected .msh (Gmsh), .inp (Abaqus), .vtu or .vtk "
        "(VTK)",
    ),
    (
        lambda: st.NeoHookean(-1.0, 0.3),
        "NeoHookean: Young's modulus is -1, but it must be positive and finite",
    ),
    (
        lambda: st.NeoHookean(1.0, 0.5),
        "NeoHookean: Poisson's ratio is 0.5, but it must be above -1 and below 0.5",
    ),
    (
        lambda: st.LinearElastic(1e300, 0.3),
        "youngs_modulus: it must be at most 1e50 in magnitude, but is 1e300; check its unit and its"
        " exponent",
    ),
    (
        lambda: st.IsochoricNeoHookean(shear_modulus=1e-300, bulk_modulus=1.0),
        "shear_modulus: it must be from 1e-50 to 1e50, but is 1e-300; check its unit and its exponent",
    ),
    (
        lambda: st.Body("pad", st.block(), RUBBER, density=1e-320),
        "density: it must be from 1e-50 to 1e50, but is 1e-320; check its unit and its exponent",
    ),
    (
        lambda: st.Model().step("press", duration=1e-320),
        "duration: it must be from 1e-50 to 1e50, but is 1e-320; check its unit and its exponent",
    ),
    (lambda: st.Coulomb(float("nan")), "mu: a finite number is needed, not nan"),
    (lambda: st.Coulomb(-0.1), "Coulomb: mu = -0.1 is refused: it must be zero or positive, and finite"),
    (lambda: st.Coulomb("0.3"), "mu: a number is needed, not '0.3'"),  # type: ignore[arg-type]
    (
        lambda: st.Nap(mu_forward=0.1, mu_backward=2.0, mu_lateral=0.1),
        "Nap: friction would create energy: slip at 120.000 degrees from the texture `a` gives a"
        " dissipation -tau . d / p = -0.137500",
    ),
    (
        lambda: st.Tabulated([0, 90, 45], [0.1, 0.2, 0.3]),
        "Tabulated: the angle 45.000 degrees after 90.000 degrees is refused: the angles of a"
        " table must ascend",
    ),
    (
        lambda: st.Tabulated([0, 90, 180], [0.1, 0.2]),
        "Tabulated: the table has angles: 3, but coefficients: 2; each angle needs one",
    ),
    (
        lambda: st.Orthotropic(0.1, 0.2, "other"),  # type: ignore[arg-type]
        "slip_rule: one of `opposing`, `associated` is needed, not 'other'",
    ),
    (lambda: st.Plane("f", normal=(0, 0, 0)), "normal: a direction must not be the zero vector"),
    (lambda: st.Uniform((0, 0, 0)), "direction: a direction must not be the zero vector"),
    (
        lambda: st.Painted([[0, 0, 0]], [[1, 0, 0], [0, 1, 0]]),
        "directions: there are 2 for 1 places",
    ),
    (
        lambda: st.Plane("f", mass=1.0),
        "rigid body `f`: mass and inertia must be given together",
    ),
    (
        lambda: st.RigidSurface("r", (POINTS, {"triangle": [[0, 1, 9]]})),
        "rigid body `r`: a facet refers to node 9, but there are 8 points",
    ),
    (lambda: st.RigidBody("r", []), "rigid body `r`: at least one set of nodes is needed"),
    (
        lambda: st.block().facets_along((0, 0, 0), 10),
        "direction: it must not be the zero vector",
    ),
    (
        lambda: st.block().facets_around((0, 0, 0), 200),
        "feature_angle: it must be from 0 to 180 degrees, but is 200",
    ),
    (
        lambda: st.block().facets_of("core"),
        "elements: the mesh has no element set `core`; it has `all`",
    ),
    (lambda: pad()["top"], f"body `pad`: there is no set `top`; it has {SETS}"),
    (
        lambda: pad().add_set("none", lambda x: x[:, 0] > 5),
        "body `pad`: no node is in set `none`",
    ),
    (
        lambda: pad()["zmax"].displace(),
        "pad['zmax']: a displacement needs at least one of x, y and z",
    ),
    (
        lambda: pad()["zmax"].displace(x=1, curve="bent"),  # type: ignore[arg-type]
        "curve: one of `ramp`, `constant`, `smooth` is needed, not 'bent'",
    ),
    (
        lambda: pad()["zmax"].displace(x=lambda s: s, curve="smooth"),
        "curve: components given as functions take no curve",
    ),
    (
        lambda: pad()["zmax"].displace(x=lambda s: s, curve=np.array([[0, 0], [1, 1]])),  # type: ignore[arg-type]
        "curve: components given as functions take no curve",
    ),
    (
        lambda: pad().strain([0] * 6, axes=[(1, 0, 0), (2, 0, 0)]),
        "axes: two vectors that span a plane are needed, but [[1.0, 0.0, 0.0], [2.0, 0.0, 0.0]]"
        " are parallel",
    ),
    (
        lambda: st.Pair(pad()["zmin"], st.Plane("f"), stabilise="no"),  # type: ignore[arg-type]
        "stabilise: True or False is needed, not 'no'",
    ),
    (
        lambda: floored(None).contact_all(stabilise=1),  # type: ignore[arg-type]
        "stabilise: True or False is needed, not 1",
    ),
    (lambda: st.Solver(tolerance=10), "tolerance: it must be below 1, but is 10.0"),
    (lambda: st.Increments(2.0), "initial: it must be at most 1, but is 2.0"),
    (lambda: st.Increments(smallest=1.5), "smallest: it must be at most 1, but is 1.5"),
    (lambda: st.Increments(largest=0), "largest: it must be positive, but is 0.0"),
    (
        lambda: floored(None).run(output=""),
        "output: a path must not be empty; `.` is the present folder",
    ),
    (
        lambda: floored(None).run(fields_every=2),
        "fields_every: nothing is written without `output`; give `output` its folder",
    ),
    (
        lambda: floored(None).run(case="mine"),
        "case: nothing is written without `output`; give `output` its folder",
    ),
    (
        lambda: st.sweep(floored, {"law": [None]}, fields_every=2),
        "fields_every: nothing is written without `output`; give `output` its folder",
    ),
    (lambda: floored(None).run(case=""), "case: a name must not be empty"),
    (
        lambda: st.sweep(floored, {"law": [None]}, output=""),
        "output: a path must not be empty; `.` is the present folder",
    ),
    (lambda: steady().write(""), "folder: a path must not be empty; `.` is the present folder"),
    (
        lambda: steady()[-1].pair(0).plot(side="c"),  # type: ignore[arg-type]
        "side: one of `a`, `b` is needed, not 'c'",
    ),
    (
        lambda: paired(st.Plane("floor"), st.Plane("floor", point=(0, 0, -5))),
        "pairs[0]: its rigid body `floor` differs from that of this name in `rigid`; state the same"
        " object in both",
    ),
    (
        lambda: paired(st.Plane("floor"), st.Plane("floor", texture=(1, 0, 0))),
        "pairs[0]: its rigid body `floor` differs from that of this name in `rigid`; state the same"
        " object in both",
    ),
    (
        lambda: pad()["zmax"].displace(x=lambda s: 1.0 / (s - 1.0) if s < 1.0 else np.nan),
        "x at 1.0: a finite number is needed, not nan",
    ),
    (
        lambda: pad()["zmax"].release("w"),  # type: ignore[arg-type]
        "components: one of `x`, `y`, `z` is needed, not 'w'",
    ),
    (
        lambda: built().run(),
        "steps: the model has no step; there is nothing to do",
    ),
    (
        lambda: built(lambda body: [st.Body("other", st.block(), RUBBER)["zmax"].hold()]).check(),
        "steps[0].displacements[0]: no body is named `other`; there is `pad`",
    ),
    (
        lambda: floored(st.Nap(0.2, 0.3, 0.25)).check(),
        "pairs[0].friction: the friction of pair `pad-floor` needs a texture on one side;"
        " sides that have one: 0; give a side its direction, such as `texture=(1, 0, 0)` of a rigid"
        " body or `textured((1, 0, 0))` of a set",
    ),
    (
        lambda: built(lambda body: [st.gravity((0, 0, -9.81)), body["zmin"].hold()]).check(),
        "steps[0]: body `pad` has inertia or weight in step `s0`, but its material has no"
        " `density`; give it one",
    ),
    (
        lambda: built(lambda body: [body["zmin"].hold(), body["zmin"].displace(x=1)]).check(),
        "steps[0].displacements[1]: step `s0` prescribes component `x` of node 0 of body `pad`"
        " twice: 0 by `zmin`, 1 by `zmin`",
    ),
    (
        lambda: floored(None).run(keep="some"),  # type: ignore[arg-type]
        "keep: one of `all`, `steps`, `last` is needed, not 'some'",
    ),
    (lambda: floored(None).run(threads=0), "threads: it must be at least 1, but is 0"),
    (
        lambda: floored(None).friction("sole"),
        "model: no pair is named `sole`; there is `pad-floor`",
    ),
    (lambda: floored(None).friction(3), "model: there is no pair 3; there are 1, from 0"),
    (lambda: st.sweep(floored, {"law": []}), "parameter `law`: it has no values"),
    (
        lambda: st.Model.from_deck("none.toml"),
        "none.toml: the deck cannot be read: No such file or directory (os error 2)",
    ),
]

TYPE_ERRORS: list[tuple[Callable[[], Any], str]] = [
    (
        lambda: st.Mesh(POINTS, CELLS),  # type: ignore[arg-type]
        "cells: a mapping such as {'hexahedron': corners} is needed, not ndarray",
    ),
    (
        lambda: st.Body("pad", 3, RUBBER),
        "mesh: a Mesh, a path, or a mesh of meshio or pyvista is needed, not int",
    ),
    (
        lambda: st.Body("pad", st.block(), "rubber"),  # type: ignore[arg-type]
        "material: an object of class Material is needed, not str",
    ),
    (
        lambda: st.Pair(pad(), st.Plane("floor")),  # type: ignore[arg-type]
        "a: a set such as body['top'] or a rigid body is needed, not Body",
    ),
    (
        lambda: st.Model().step("press", "down"),  # type: ignore[arg-type]
        "step `press`: an object of class Condition is needed, not str",
    ),
    (
        lambda: st.Model(pad()),  # type: ignore[arg-type]
        "bodies: a list is needed, not Body",
    ),
    (
        lambda: floored(None).friction(0.5),  # type: ignore[arg-type]
        "pair: a name or a number is needed, not 0.5",
    ),
    (
        lambda: st.sweep(floored, {"law": 0.3}),  # type: ignore[dict-item]
        "parameter `law`: a list of values is needed, not 0.3",
    ),
    (
        lambda: st.Coulomb(friction=0.3),  # type: ignore[call-arg]
        "Coulomb: it has no argument `friction`; its arguments are `mu`",
    ),
    (
        lambda: st.Coulomb(mu=0.3, shear_cap=1e5),  # type: ignore[call-arg]
        "Coulomb: it has no argument `shear_cap`; its arguments are `mu`; the key `shear_cap` of"
        " decks is law.with_shear_cap",
    ),
    (
        lambda: st.LinearElastic(youngs_modulus=1.0, poissons_ratio=0.3, density=1e3),  # type: ignore[call-arg]
        "LinearElastic: it has no argument `density`; its arguments are `youngs_modulus`,"
        " `poissons_ratio`; the key `density` of decks is density of a Body or a Section",
    ),
    (
        lambda: st.Body("pad", st.block(), facet_sets={}),  # type: ignore[call-arg]
        "Body: it has no argument `facet_sets`; its arguments are `name`, `mesh`, `material`,"
        " `sections`, `density`, `contact_mass`, `formulation`; the key `facet_sets` of decks is"
        " facet_sets of the Mesh, or body.add_set",
    ),
    (
        lambda: st.Model(contact="all"),  # type: ignore[call-arg]
        "Model: it has no argument `contact`; its arguments are `bodies`, `rigid`, `pairs`, `ties`,"
        " `springs`, `cavities`, `steps`, `title`, `solver`; the key `contact` of decks is"
        " model.contact_all(...)",
    ),
    (
        lambda: st.Section(elements="core", set=3),  # type: ignore[call-arg]
        "Section: it has no argument `set`; its arguments are `elements`, `material`, `density`,"
        " `formulation`",
    ),
    (
        lambda: pad()["zmax"].traction(5.0),  # type: ignore[arg-type]
        "value: a list of three components is needed, not 5.0",
    ),
    (
        lambda: pad()["zmax"].displace(x=1, axes=3),  # type: ignore[arg-type]
        "axes: a list of two vectors is needed, not 3",
    ),
    (
        lambda: st.Coulomb(0.3).with_factor(
            lambda at: 1.0 + 0.0 * at.pressure,
            name="own",
            state=1.0,  # type: ignore[arg-type]
            update=lambda at: at.state,
        ),
        "state: a list of numbers is needed, not 1.0",
    ),
    (
        lambda: st.differentiate(floored, ["law"]),  # type: ignore[arg-type]
        "parameters: a mapping is needed, not list",
    ),
    (
        lambda: st.sweep(floored, ["law"]),  # type: ignore[arg-type]
        "parameters: a mapping is needed, not list",
    ),
    (
        lambda: floored(None).run(output=3),  # type: ignore[arg-type]
        "output: a path is needed, not 3",
    ),
    (
        lambda: floored(None).run(case=3),  # type: ignore[arg-type]
        "case: a name is needed, not 3",
    ),
    (
        lambda: st.Mesh(POINTS, {"hexahedron": CELLS}, node_sets=["top"]),  # type: ignore[arg-type]
        "node_sets: a mapping is needed, not list",
    ),
    (
        lambda: st.Mesh(POINTS, {"hexahedron": CELLS}, element_sets="core"),  # type: ignore[arg-type]
        "element_sets: a mapping is needed, not str",
    ),
    (
        lambda: st.Body("pad", st.block(), RUBBER, sections=3),  # type: ignore[arg-type]
        "sections: a list of sections is needed, not 3",
    ),
    (lambda: pad().add_set([1], [0]), "name: a name is needed, not [1]"),  # type: ignore[arg-type]
    (
        lambda: floored(None).contact_all(exclude=3),  # type: ignore[arg-type]
        "exclude: a list of surfaces, and of tuples of two, is needed, not 3",
    ),
    (
        lambda: floored(None).contact_all(between=None),  # type: ignore[arg-type]
        "between: a list of two surfaces and their law each is needed, not None",
    ),
    (
        lambda: floored(None).contact_all(textures=3),  # type: ignore[arg-type]
        "textures: a list of textured surfaces is needed, not 3",
    ),
    (lambda: st.RigidBody("r", 3), "tied: a list of sets is needed, not 3"),  # type: ignore[arg-type]
    (
        lambda: st.Plane("f").move(free=3),  # type: ignore[arg-type]
        "free: a list of coordinates is needed, not 3",
    ),
    (
        lambda: st.Fibrous(RUBBER, None),  # type: ignore[arg-type]
        "fibres: a list of families is needed, not None",
    ),
    (
        lambda: st.fit_friction([0], [0.1], [1]),  # type: ignore[arg-type]
        "law: one of the classes Coulomb, TwoTextures, Orthotropic, Nap, Tabulated is needed, not [1]",
    ),
    (
        lambda: st.fit_friction([0], [0.1], st.Coulomb, specimen=3),  # type: ignore[arg-type]
        "specimen: a list of names is needed, not 3",
    ),
    (lambda: st.read_measurements(3), "path: a path is needed, not 3"),  # type: ignore[arg-type]
    (
        lambda: st.read_measurements("m.csv", columns="angle"),  # type: ignore[arg-type]
        "columns: a mapping is needed, not str",
    ),
    (lambda: st.read_mesh(3), "path: a path is needed, not 3"),  # type: ignore[arg-type]
    (lambda: st.Model.from_deck(3), "path: a path is needed, not 3"),  # type: ignore[arg-type]
    (
        lambda: st.Model.from_text(3),  # type: ignore[arg-type]
        "text: the text of a deck is needed, not int",
    ),
    (lambda: floored(None).to_deck(3), "path: a path is needed, not 3"),  # type: ignore[arg-type]
    (
        lambda: steady().picture("a.png", hide=3),  # type: ignore[arg-type]
        "hide: a list of names is needed, not 3",
    ),
    (lambda: st.resume(3), "folder: a path is needed, not 3"),  # type: ignore[arg-type]
    (lambda: steady()[-1].body(0), "body: a name is needed, not 0"),  # type: ignore[arg-type]
    (lambda: steady()[-1].rigid(0), "rigid body: a name is needed, not 0"),  # type: ignore[arg-type]
    (
        lambda: steady()[-1].reaction(0, "zmax"),  # type: ignore[arg-type]
        "body: a name is needed, not 0",
    ),
    (
        lambda: steady()[-1].reaction("pad", 0),  # type: ignore[arg-type]
        "nodes: a name is needed, not 0",
    ),
    (lambda: st.Friction(), "use one of the laws, such as Coulomb, or OwnFriction"),
]


@pytest.mark.parametrize("wrong, words", MODEL_ERRORS, ids=[words[:50] for _, words in MODEL_ERRORS])
def test_a_wrong_use_is_refused_in_these_words(wrong: Callable[[], Any], words: str) -> None:
    with pytest.raises(st.ModelError) as caught:
        wrong()
    assert str(caught.value) == words
    (fault,) = caught.value.faults
    assert f"{fault.path}: {fault.message}" == words


@pytest.mark.parametrize("wrong, words", TYPE_ERRORS, ids=[words[:50] for _, words in TYPE_ERRORS])
def test_a_wrong_type_is_refused_in_these_words(wrong: Callable[[], Any], words: str) -> None:
    with pytest.raises(TypeError) as caught:
        wrong()
    assert str(caught.value) == words


def test_remedies_are_in_the_words_of_python() -> None:
    body, floor = pad(), st.Plane("floor", point=(0, 0, -0.1))
    model = st.Model([body], [floor], [st.Pair(body["zmin"], floor)])
    model.step("press", body["zmax"].displace(x=0, y=0), body["zmax"].pressure(1.0))
    told = str(model.advice())
    assert "set `stabilise=True` in the pair" in told and "= true" not in told


def test_equal_rigid_bodies_of_one_name_are_one() -> None:
    normal = np.array([0.0, 0.0, 1.0])
    for other in (
        st.Plane("floor", normal=(0, 0, 1)),
        st.Plane("floor", normal=normal, point=[0, 0, 0]),
        st.Plane(name="floor"),
    ):
        assert paired(st.Plane("floor"), other).pair_names == ["pad-floor"]
    lines = [st.Uniform(along) for along in ([1, 0, 0], (1.0, 0.0, 0.0))]
    one, two = (st.Plane("floor", texture=along) for along in lines)
    assert paired(one, two).pair_names == ["pad-floor"]


def test_booleans_of_numpy_are_booleans() -> None:
    assert st.Pair(pad()["zmin"], st.Plane("f"), stabilise=np.True_).name == "pad-f"  # type: ignore[arg-type]


def test_all_faults_of_a_model_are_told_at_once() -> None:
    body, floor = pad(), st.Plane("floor")
    pairs = [st.Pair(body["zmin"], floor, st.Nap(0.2, 0.3, 0.25), name="p")]
    model = st.Model([body, pad()], [floor], pairs)
    model.step("press", body["zmax"].displace(z=-1), body["zmax"].displace(z=-2))
    with pytest.raises(st.ModelError) as caught:
        model.check()
    assert len(caught.value.faults) >= 3
    assert str(caught.value).endswith(f"{len(caught.value.faults)} faults")
    assert isinstance(caught.value, ValueError)


def test_faults_of_a_deck_have_lines_and_columns(tmp_path: Path) -> None:
    deck = tmp_path / "deck.toml"
    deck.write_text('title = "x"\n[[step]]\nnme = "press"\n')
    with pytest.raises(st.ModelError) as caught:
        st.Model.from_deck(deck)
    paths = [fault.path for fault in caught.value.faults]
    assert f"{deck}:3:1" in paths


def test_arrays_of_any_layout_are_understood() -> None:
    expected = st.Mesh(POINTS, {"hexahedron": CELLS})
    fortran = np.asfortranarray(POINTS)
    strided = np.repeat(POINTS, 2, axis=0)[::2]
    small = CELLS.astype(np.uint16)
    listed = POINTS.tolist()
    integers = POINTS.astype(np.int32)
    for points in (fortran, strided, listed, integers):
        mesh = st.Mesh(points, {"hexahedron": small})
        assert np.array_equal(mesh.points, expected.points)
        assert np.array_equal(mesh.cells["hexahedron"], expected.cells["hexahedron"])


def test_parts_do_not_change_once_they_are_made(rubber: st.NeoHookean) -> None:
    law = st.Coulomb(0.3)
    body = st.Body("pad", st.block(), rubber)
    model = st.Model([body])
    model.step("hold", body["all"].hold())
    made: list[tuple[object, str]] = [
        (law, "mu"),
        (law.with_shear_cap(10.0), "mu"),
        (rubber, "youngs_modulus"),
        (body, "density"),
        (st.Plane("floor"), "point"),
        (st.Pair(body["zmin"], st.Plane("floor"), law), "friction"),
        (model, "solver"),
        (st.Model.from_text(model.to_deck()).body("pad"), "mesh"),
    ]
    for part, attribute in made:
        with pytest.raises(TypeError, match=f"{attribute} of an? .* cannot be assigned"):
            setattr(part, attribute, 1.0)
    body.add_set("low", lambda x: x[:, 2] < 0.1)
    assert "low" in body.mesh.node_sets


def test_deformation_gradients_have_three_rows(rubber: st.NeoHookean) -> None:
    for shape in [(2, 2), (4, 3), (3,)]:
        gradient = np.ones(shape)
        for evaluate in (rubber.stress, rubber.energy):
            with pytest.raises(st.ModelError, match=r"an array of shape \(3, 3\) is needed"):
                evaluate(gradient)
