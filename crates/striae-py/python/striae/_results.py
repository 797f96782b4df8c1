"""Results of an increment by bodies, pairs and rigid bodies.

Arrays are made on first access and are read-only.
"""

from __future__ import annotations

from enum import IntEnum
from functools import cached_property
from typing import TYPE_CHECKING, Any, Literal, NamedTuple, Protocol, Union

import numpy as np
import numpy.typing as npt

from . import _check as check
from . import _striae as native
from ._check import Floats, Ints
from ._described import described
from ._mesh import Mesh, frozen

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from ._model import Model

Statuses = npt.NDArray[np.int8]


class Status(IntEnum):
    """Contact status of a node."""

    OPEN = 0
    """Not in contact."""
    STICK = 1
    """In contact without slip."""
    SLIP = 2
    """In contact and slipping."""


@described
class Energies(NamedTuple):
    """Energies since the start (force times length)."""

    kinetic: float
    """Kinetic energy (force times length)."""
    strain: float
    """Stored elastic energy (force times length)."""
    external: float
    """Work of reactions, loads and moving rigid bodies (force times length)."""
    actuation: float
    """Work of changes of stress-free strains and tensions of the bodies (force times length)."""
    inelastic: float
    """Work dissipated by viscous and plastic flow in the bodies (force times length)."""
    friction: float
    """Work dissipated by friction (force times length)."""
    contact: float
    """Work of contact forces beyond friction, with the error of finite increments in which surfaces
    open or close (force times length)."""
    stabilisation: float
    """Work lost to stabilisation (force times length)."""
    numerical: float
    """Work lost to time integration (force times length)."""
    imbalance: float
    """Work of external forces and actuation that the other energies do not account for (force times length)."""


class BodyResults:
    """Results of a deformable body at the nodes of its mesh."""

    def __init__(self, results: native.Results, name: str) -> None:
        """Use ``increment.body("pad")`` to get results."""
        self._results = results
        self.name = name
        """Name of the body."""

    @cached_property
    def displacement(self) -> Floats:
        """Displacements, of shape (n, 3) (length)."""
        return frozen(self._results.body(self.name, "displacement"))

    @cached_property
    def position(self) -> Floats:
        """Positions, of shape (n, 3) (length)."""
        return frozen(self._results.body(self.name, "position"))

    @cached_property
    def velocity(self) -> Floats:
        """Velocities, of shape (n, 3), zero without inertia (length per time)."""
        return frozen(self._results.body(self.name, "velocity"))

    @cached_property
    def contact_force(self) -> Floats:
        """Contact forces, of shape (n, 3) (force)."""
        return frozen(self._results.body(self.name, "contact_force"))

    @cached_property
    def tie_force(self) -> Floats:
        """Forces of ties, of shape (n, 3) (force)."""
        return frozen(self._results.body(self.name, "tie_force"))

    @cached_property
    def reaction(self) -> Floats:
        """Forces that hold prescribed nodes, of shape (n, 3), zero at the others (force)."""
        return frozen(self._results.body(self.name, "reaction"))

    @cached_property
    def stress(self) -> Floats:
        """Cauchy stress, of shape (n, 3, 3), tension positive (force per area)."""
        return frozen(self._results.stress(self.name))

    @cached_property
    def von_mises(self) -> Floats:
        """Equivalent stress of von Mises, of shape (n,) (force per area)."""
        return frozen(self._results.von_mises(self.name))

    @cached_property
    def equivalent_plastic_strain(self) -> Floats:
        """Equivalent plastic strain of the elements, of shape (cells,), in the order of
        :attr:`Mesh.cells`; zero in elements that do not yield (no unit).

        Raises ``AttributeError`` if no material of the body can yield.
        """
        found = self._results.remembered(self.name, "equivalent_plastic_strain")
        if found is None:
            raise AttributeError(f"body {self.name!r} is of no material that yields")
        return frozen(found)

    def __repr__(self) -> str:
        return f"<results of body {self.name!r}>"


class Sided(Protocol):
    """Results by sides of pairs."""

    def side(self, pair: int, b: bool) -> dict[str, npt.NDArray[Any]]: ...


class SideResults:
    """Contact at the nodes of a deformable side of a pair."""

    def __init__(self, results: Sided, pair: int, b: bool) -> None:
        """Use ``increment.pair(0).a`` to get results."""
        self._results, self._pair, self._b = results, pair, b

    @cached_property
    def _known(self) -> dict[str, npt.NDArray[Any]]:
        known = self._results.side(self._pair, self._b)
        if not known:
            raise AttributeError("a rigid side has no results at nodes; those of side `a` are all")
        return {name: frozen(array) for name, array in known.items()}

    @property
    def nodes(self) -> Ints:
        """Numbers of the nodes in the mesh of the body, of shape (n,)."""
        return self._known["nodes"]

    @property
    def facets(self) -> Ints:
        """Corners of the facets, of shape (m, 4), as positions in :attr:`nodes`."""
        return self._known["facets"]

    @property
    def position(self) -> Floats:
        """Positions, of shape (n, 3) (length)."""
        return self._known["position"]

    @property
    def gap(self) -> Floats:
        """Gaps to the other side, of shape (n,), negative for penetration (length)."""
        return self._known["gap"]

    @property
    def pressure(self) -> Floats:
        """Pressures, of shape (n,), positive in contact (force per area)."""
        return self._known["pressure"]

    @property
    def mean_pressure(self) -> Floats:
        """Mean pressures around the nodes, of shape (n,): contact force over area, smoother on
        coarse curved contact (force per area)."""
        return self._known["mean_pressure"]

    @property
    def friction(self) -> Floats:
        """Friction tractions on this side, of shape (n, 3) (force per area)."""
        return self._known["friction"]

    @property
    def traction(self) -> Floats:
        """Tractions on this side, of shape (n, 3): pressure and friction (force per area)."""
        return self._known["traction"]

    @property
    def mean_traction(self) -> Floats:
        """Mean tractions around the nodes, of shape (n, 3) (force per area)."""
        return self._known["mean_traction"]

    @property
    def slip(self) -> Floats:
        """Slips in the increment relative to the other side, of shape (n, 3) (length)."""
        return self._known["slip"]

    @property
    def normal(self) -> Floats:
        """Outward unit normals, of shape (n, 3) (no unit)."""
        return self._known["normal"]

    @property
    def texture(self) -> Floats:
        """Unit directions of the texture in the current configuration, of shape (n, 3); zero
        without one (no unit)."""
        return self._known["texture"]

    @property
    def status(self) -> Statuses:
        """Status of the nodes, of shape (n,): numbers of :class:`Status` (no unit)."""
        return self._known["status"]


class PairResults:
    """Results of a contact pair; fields at nodes are those of side ``a``."""

    def __init__(self, results: native.Results, index: int, name: str) -> None:
        """Use ``increment.pair("pad-floor")`` to get results."""
        self._results = results
        self.name = name
        """Name of the pair."""
        self.a = SideResults(results, index, False)
        """Contact at the nodes of the first side."""
        self.b = SideResults(results, index, True)
        """Contact at the nodes of the second side, if it is deformable."""
        self._index = index

    @cached_property
    def _whole(self) -> dict[str, Any]:
        whole = self._results.pair(self._index)
        return {k: frozen(v) if isinstance(v, np.ndarray) else v for k, v in whole.items()}

    @property
    def force(self) -> Floats:
        """Contact force on side ``a``, of shape (3,) (force)."""
        found: Floats = self._whole["force_a"]
        return found

    @property
    def force_b(self) -> Floats:
        """Contact force on side ``b``, of shape (3,) (force)."""
        found: Floats = self._whole["force_b"]
        return found

    @property
    def moment(self) -> Floats:
        """Moment of contact on side ``a`` about the origin, of shape (3,) (force times length)."""
        found: Floats = self._whole["moment_a"]
        return found

    @property
    def area(self) -> float:
        """Contact area: that of the points of side ``a`` under pressure (length squared)."""
        return float(self._whole["area_a"])

    @property
    def mismatch(self) -> float:
        """Magnitude of the sum of the forces on both sides, relative to the load, of the integrals
        of pressure and friction (no unit)."""
        return float(self._whole["mismatch"])

    @property
    def sticking(self) -> int:
        """Number of sticking nodes of both sides (no unit)."""
        return int(self._whole["stick"])

    @property
    def slipping(self) -> int:
        """Number of slipping nodes of both sides (no unit)."""
        return int(self._whole["slip"])

    @property
    def open(self) -> int:
        """Number of nodes of both sides that are not in contact (no unit)."""
        return int(self._whole["open"])

    @property
    def largest_pressure(self) -> float:
        """Largest nodal pressure (force per area)."""
        return float(self._whole["largest_pressure"])

    @property
    def dissipated(self) -> float:
        """Work dissipated by friction since the start (force times length)."""
        return float(self._whole["dissipated"])

    @property
    def nodes(self) -> Ints:
        """As :attr:`SideResults.nodes` of side ``a`` (no unit)."""
        return self.a.nodes

    @property
    def position(self) -> Floats:
        """As :attr:`SideResults.position` of side ``a`` (length)."""
        return self.a.position

    @property
    def gap(self) -> Floats:
        """As :attr:`SideResults.gap` of side ``a`` (length)."""
        return self.a.gap

    @property
    def pressure(self) -> Floats:
        """As :attr:`SideResults.pressure` of side ``a`` (force per area)."""
        return self.a.pressure

    @property
    def friction(self) -> Floats:
        """As :attr:`SideResults.friction` of side ``a`` (force per area)."""
        return self.a.friction

    @property
    def traction(self) -> Floats:
        """As :attr:`SideResults.traction` of side ``a`` (force per area)."""
        return self.a.traction

    @property
    def slip(self) -> Floats:
        """As :attr:`SideResults.slip` of side ``a`` (length)."""
        return self.a.slip

    @property
    def status(self) -> Statuses:
        """As :attr:`SideResults.status` of side ``a`` (no unit)."""
        return self.a.status

    def plot(self, axes: Union[Axes, None] = None, *, side: Literal["a", "b"] = "a") -> Axes:
        """Draws the contact patch with matplotlib: mean pressure as colour, friction as arrows.

        axes: where it is drawn; on a new figure by default.
        side: side whose nodes are drawn.
        """
        from ._plot import draw_patch

        return draw_patch(self, axes, check.word(side, ("a", "b"), "side"))

    def __repr__(self) -> str:
        return f"<results of pair {self.name!r}>"


@described
class RigidResults(NamedTuple):
    """Results of a rigid body."""

    displacement: Floats
    """Displacement of its reference point, of shape (3,) (length)."""
    rotation: Floats
    """Angles turned about the fixed axes, of shape (3,) (degrees)."""
    force: Floats
    """Force that drives or holds it, of shape (3,) (force)."""
    torque: Floats
    """Torque that drives or holds it, of shape (3,) (force times length)."""


@described
class TieResults(NamedTuple):
    """Results of a tie."""

    name: str
    """Name of the tie."""
    force: Floats
    """Force on side ``a``, of shape (3,) (force)."""
    force_b: Floats
    """Force on side ``b``, of shape (3,) (force)."""
    moment: Floats
    """Moment on side ``a`` about the origin, of shape (3,) (force times length)."""
    moment_b: Floats
    """Moment on side ``b`` about the origin, of shape (3,) (force times length)."""
    area: float
    """Tied area at rest (length squared)."""
    mismatch: float
    """Magnitude of the sum of both forces, relative to the sum of the magnitudes of nodal forces
    (no unit)."""
    moment_mismatch: float
    """Magnitude of the sum of both moments, relative to that sum times the square root of the area
    (no unit)."""


@described
class SpringResults(NamedTuple):
    """Results of springs."""

    name: str
    """Name of the springs."""
    tension: float
    """Sum of their tensions, those of dashpots included (force)."""
    elongation: float
    """Mean of their elongations since the start (length)."""
    force: Floats
    """Force on end ``a``, of shape (3,) (force)."""


@described
class CavityResults(NamedTuple):
    """Results of a cavity."""

    name: str
    """Name of the cavity."""
    pressure: float
    """Pressure over that of the surroundings (force per area)."""
    volume: float
    """Volume (length cubed)."""


class Increment:
    """The converged state at the end of an increment."""

    def __init__(self, results: native.Results, model: Model) -> None:
        """Use ``run[-1]`` to get an increment; ``on_increment`` receives each one."""
        self._results, self._model = results, model
        self._bodies: dict[str, BodyResults] = {}
        self._pairs: dict[int, PairResults] = {}

    @property
    def time(self) -> float:
        """Time at its end; a mere parameter without inertia (time)."""
        return self._results.time

    @property
    def number(self) -> int:
        """Number of the increment since the start of the run, from 1."""
        return self._results.number

    @property
    def step(self) -> str:
        """Name of the step."""
        return self._model.step_names[self._results.step]

    @property
    def fraction(self) -> float:
        """Completed fraction of the step (no unit)."""
        return self._results.fraction

    @property
    def iterations(self) -> int:
        """Number of iterations of Newton's method (no unit)."""
        return self._results.iterations

    @cached_property
    def energies(self) -> Energies:
        """Energies since the start (force times length)."""
        return Energies(**self._results.energies())

    def body(self, name: str) -> BodyResults:
        """Results of a deformable body; name: of the body."""
        self._model._position("body", self._model.body_names, check.name(name, "body"))
        if name not in self._bodies:
            self._bodies[name] = BodyResults(self._results, name)
        return self._bodies[name]

    def pair(self, which: Union[int, str]) -> PairResults:
        """Results of a pair; which: its name, or its number from 0."""
        index = self._model._position("pair", self._model.pair_names, which)
        if index not in self._pairs:
            name = self._model.pair_names[index]
            self._pairs[index] = PairResults(self._results, index, name)
        return self._pairs[index]

    def tie(self, which: Union[int, str]) -> TieResults:
        """Results of a tie; which: its name, or its number from 0."""
        index = self._model._position("tie", self._model.tie_names, which)
        found = self._results.tie(index)
        return TieResults(
            name=self._model.tie_names[index],
            force=frozen(found["force_a"]),
            force_b=frozen(found["force_b"]),
            moment=frozen(found["moment_a"]),
            moment_b=frozen(found["moment_b"]),
            area=found["area"],
            mismatch=found["mismatch"],
            moment_mismatch=found["moment_mismatch"],
        )

    def spring(self, which: Union[int, str]) -> SpringResults:
        """Results of springs; which: their name, or their number from 0."""
        names = self._model.spring_names
        name = names[self._model._position("spring", names, which)]
        tension, elongation, force = self._results.spring(name) or (0.0, 0.0, [0.0] * 3)
        return SpringResults(name, tension, elongation, frozen(np.array(force)))

    def cavity(self, which: Union[int, str]) -> CavityResults:
        """Results of a cavity; which: its name, or its number from 0."""
        names = self._model.cavity_names
        name = names[self._model._position("cavity", names, which)]
        return CavityResults(name, *(self._results.cavity(name) or (0.0, 0.0)))

    def rigid(self, name: str) -> RigidResults:
        """Results of a rigid body; name: of the body."""
        self._model._position("rigid body", self._model.rigid_names, check.name(name, "rigid body"))
        found = self._results.rigid(name) or [[0.0] * 3] * 4
        return RigidResults(*[frozen(np.array(vector)) for vector in found])

    @property
    def bodies(self) -> list[BodyResults]:
        """Results of all deformable bodies."""
        return [self.body(name) for name in self._model.body_names]

    @property
    def pairs(self) -> list[PairResults]:
        """Results of all pairs."""
        return [self.pair(index) for index in range(len(self._model.pair_names))]

    @property
    def ties(self) -> list[TieResults]:
        """Results of all ties."""
        return [self.tie(index) for index in range(len(self._model.tie_names))]

    @property
    def springs(self) -> list[SpringResults]:
        """Results of all springs."""
        return [self.spring(name) for name in self._model.spring_names]

    @property
    def cavities(self) -> list[CavityResults]:
        """Results of all cavities."""
        return [self.cavity(name) for name in self._model.cavity_names]

    def reaction(self, body: str, nodes: str) -> Floats:
        """Force that holds a set of nodes, of shape (3,) (force).

        body: name of the body.
        nodes: name of its node set.
        """
        self._model._position("body", self._model.body_names, check.name(body, "body"))
        found = self._results.reaction(f"{body}.{check.name(nodes, 'nodes')}")
        if found is None:
            raise KeyError(f"body `{body}` has no node set `{nodes}`")
        return frozen(np.array(found))

    def to_pyvista(self) -> Any:
        """The deformed bodies and contact surfaces with their fields, as a
        ``pyvista.MultiBlock``: a block for every body by its name, and one for every
        deformable side of a pair, ``contact-PAIR-a``."""
        import pyvista  # type: ignore[import-not-found, unused-ignore]

        from ._interchange import grid, patch

        blocks = pyvista.MultiBlock()
        for name in self._model.body_names:
            blocks[name] = grid(self, name)
        for index, name in enumerate(self._model.pair_names):
            for side in ("a", "b"):
                if self._results.side_body(index, side == "b") is not None:
                    blocks[f"contact-{name}-{side}"] = patch(self, index, side)
        return blocks

    def _mesh(self, body: str) -> Mesh:
        return self._model.body(body).mesh

    def __repr__(self) -> str:
        return f"<increment {self.number} at time {self.time:g}, step {self.step!r}>"
