"""Contact as a component of other finite-element programs.

The other program has the mesh, elements, loads and Newton's method. This module adds the traction
unknowns of contact, their equations, and the forces that they exert::

    contact = st.contact.Contact(points, [pair])
    state = contact.untouched()
    increment = contact.begin(state)                      # once an increment
    evaluation = increment.evaluate(positions, tractions) # in every iteration
    state = increment.accept(evaluation)                  # once the residual is small

Of ``n`` nodes and ``k`` *kept* nodes there are ``3 n + 3 k`` unknowns: displacement or position
``c`` of node ``i`` has the number ``3 i + c``, then come the pressure and two friction unknowns of
each kept node. Kept nodes are chosen for an increment. Rows ``3 i + c`` of the residual are minus
the contact force, to be added to internal minus external forces; the others state contact and
friction. The tangent is given as triplets, one for each place, by row and then by column. It is not
symmetric with friction and has zeros on its diagonal, so it takes a direct solver with pivoting.

The formulas are in the book, in *Bring your own elements*.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import cached_property
from typing import Any, NamedTuple, Optional, Union

import numpy as np
import numpy.typing as npt

from . import _check as check
from . import _striae as native
from ._check import Floats, Ints, Vector
from ._described import described
from ._errors import refuse
from ._friction import Friction
from ._made import Made, are_alike
from ._mesh import frozen
from ._results import SideResults
from ._rigid import Plane, RigidSurface
from ._texture import Texture, texture

__all__ = ["Contact", "Evaluation", "Increment", "Kept", "Pair", "PairEvaluation", "State", "Surface"]

class Surface(Made):
    """Facets of the mesh that may touch."""

    def __init__(
        self,
        facets: Union[npt.ArrayLike, Mapping[str, npt.ArrayLike]],
        *,
        youngs_modulus: float,
        texture: Union[Texture, Vector, None] = None,
    ) -> None:
        """Makes a surface.

        facets: numbers of their corners in the mesh, of shape (m, 3) or (m, 4), counter-clockwise
            seen from outside, or both kinds as ``{"triangle": corners, "quad": corners}``.
        youngs_modulus: of what is behind the facets (force per area). With the facet size it
            gives the flexibility by which two bodies share what is between them.
        texture: a texture, or one direction of any length, on the surface at rest.
        """
        if isinstance(facets, Mapping):
            corners = check.facets(facets, "facets")
        else:
            shape = np.shape(facets)
            if len(shape) != 2 or shape[1] not in (3, 4):
                raise refuse(
                    "facets", f"an array of shape (m, 3) or (m, 4) is needed, but it has shape {shape}"
                )
            corners = check.facets({"triangle" if shape[1] == 3 else "quad": facets}, "facets")
        modulus, paint = check.positive(youngs_modulus, "youngs_modulus"), _texture(texture)
        self.texture = paint
        """Texture, if it has one."""
        self._native = native.MeshSurface(corners, modulus, None if paint is None else paint._native)


class Pair(Made):
    """Two surfaces that may touch; neither is master or slave."""

    def __init__(
        self,
        a: Surface,
        b: Union[Surface, Plane, RigidSurface],
        friction: Optional[Friction] = None,
        *,
        name: str = "contact",
        search_distance: Optional[float] = None,
    ) -> None:
        """Makes a pair.

        a: surface of the mesh.
        b: another one, without a node of the first, or a rigid surface with its texture.
        friction: law; frictionless by default.
        name: unique name.
        search_distance: distance within which contact is searched (length); half the local facet
            size where it is less.
        """
        first = check.kind(a, Surface, "a")._native
        law = None if friction is None else check.kind(friction, Friction, "friction")._native
        reach = None if search_distance is None else check.positive(search_distance, "search_distance")
        self.name = check.name(name, "name")
        """Unique name."""
        self.rigid: Optional[str] = None
        """Name of the rigid side, if there is one."""
        self._rigid: Union[Plane, RigidSurface, None] = None
        if isinstance(b, Surface):
            self._native = native.MeshPair.deformable(self.name, first, b._native, law, reach)
        elif isinstance(b, (Plane, RigidSurface)) and b._native is not None:
            self.rigid, self._rigid = b.name, b
            paint = None if b.texture is None else b.texture._native
            self._native = native.MeshPair.rigid(self.name, first, b._native, paint, law, reach)
        else:
            raise TypeError(
                f"b: a Surface, Plane or RigidSurface is needed, not {type(b).__name__}"
            )


class Contact(Made):
    """All pairs of surfaces of a mesh, and of rigid ones, that may touch."""

    def __init__(self, points: npt.ArrayLike, pairs: Sequence[Pair]) -> None:
        """Makes contact.

        points: positions of all nodes at rest, of shape (n, 3) (length).
        pairs: the pairs, whose facets count the nodes in that order.
        """
        listed = check.kinds(pairs, Pair, "pairs")
        named: dict[str, Union[Plane, RigidSurface]] = {}
        for index, pair in enumerate(listed):
            rigid = pair._rigid
            if rigid is not None and not are_alike(named.setdefault(rigid.name, rigid), rigid):
                text = f"its rigid surface `{rigid.name}` differs from another of this name; rename one"
                raise refuse(f"pairs[{index}]", text)
        self._native = native.Contact(check.rows(points, "points"), [one._native for one in listed])
        self.pairs = tuple(listed)
        """The pairs."""

    def untouched(self) -> State:
        """The state in which nothing has touched yet, with all nodes at rest."""
        return State._of(self._native.untouched())

    def begin(
        self,
        state: State,
        *,
        prescribed: Optional[npt.ArrayLike] = None,
        end: Optional[npt.ArrayLike] = None,
        predicted: Optional[npt.ArrayLike] = None,
        rigid: Optional[Mapping[str, npt.ArrayLike]] = None,
        duration: Optional[float] = None,
    ) -> Increment:
        """Begins an increment: chooses the nodes that carry traction unknowns.

        state: converged state to start from.
        prescribed: true for prescribed components, of shape (n, 3); all are free by default. The
            caller eliminates them from the system; contact determines no friction along
            directions in which nothing moves.
        end: positions at the end of the increment, of shape (n, 3), of which prescribed components
            count (length); they rest by default.
        predicted: positions that the increment is expected to lead to, of shape (n, 3) (length):
            what is met there takes part from the start. Not needed, see
            :meth:`Increment.missed`.
        rigid: placements of rigid surfaces at the end of the increment, by their names: a shift
            from where they are at rest, of shape (3,) (length), or a rigid motion from there, of
            shape (4, 4), with the shift in the last column. Others stay where they are.
        duration: of the increment (time), for friction that depends on the slip rate; by default
            it is infinitely slow, which friction with a state, by rate and state, or with a factor
            of one's own that depends on slip does not take.
        """
        ends = [
            None if given is None else check.rows(given, name)
            for given, name in [(end, "end"), (predicted, "predicted")]
        ]
        lasts = float("inf") if duration is None else check.positive(duration, "duration")
        held = [] if prescribed is None else check.booleans(prescribed, "prescribed")
        if rigid is not None and not isinstance(rigid, Mapping):
            raise TypeError(
                f"rigid: a mapping of names to placements is needed, not {type(rigid).__name__}"
            )
        placed = self._placed(dict(rigid or {}))
        origin = check.kind(state, State, "state")._native
        return Increment(self._native.begin(origin, held, ends, placed, lasts), self)

    def _placed(self, rigid: dict[str, Any]) -> list[tuple[int, list[list[float]], list[float]]]:
        known = [pair.rigid for pair in self.pairs]
        placed = []
        for name, value in rigid.items():
            if name not in known:
                told = ", ".join(f"`{one}`" for one in known if one is not None) or "none"
                raise refuse(f"rigid[{name!r}]", f"there is no such rigid surface; known: {told}")
            turn, shift = check.rigid_motion(value, f"rigid[{name!r}]")
            placed += [(at, turn, shift) for at, one in enumerate(known) if one == name]
        return placed


class State:
    """Contact between increments: where all nodes are, and the tractions. It can be pickled."""

    _native: native.State

    def __init__(self) -> None:
        """Use :meth:`Contact.untouched` or :meth:`Increment.accept`."""
        raise TypeError("use Contact.untouched or Increment.accept")

    @classmethod
    def _of(cls, found: native.State) -> State:
        state = cls.__new__(cls)
        state._native = found
        return state

    def __reduce__(self) -> tuple[Any, tuple[bytes]]:
        return _restored, (self._native.stored(),)

    @cached_property
    def positions(self) -> Floats:
        """Positions of all nodes, of shape (n, 3) (length)."""
        return frozen(self._native.positions())

    @cached_property
    def dissipated(self) -> tuple[float, ...]:
        """Work that friction has dissipated since the start, by pair (force times length)."""
        return tuple(self._native.dissipated())


@described
class Kept(NamedTuple):
    """A node with traction unknowns."""

    pair: int
    """Number of its pair."""
    side: int
    """0 for side ``a``, 1 for side ``b``."""
    node: int
    """Number of the node in the mesh."""


class Increment:
    """An increment: the nodes that carry traction unknowns, and the evaluation of contact."""

    def __init__(self, found: native.Increment, contact: Contact) -> None:
        """Use :meth:`Contact.begin` with a contact; found is made by it."""
        self._native, self._contact = found, contact

    @property
    def unknowns(self) -> int:
        """Number of unknowns: three a node of the mesh, then three a kept node (no unit)."""
        return self._native.unknowns()

    @cached_property
    def tractions(self) -> Floats:
        """Traction unknowns to start from: pressure and two components of friction, of opposite
        sign, of each kept node (force per area)."""
        return frozen(self._native.tractions())

    @cached_property
    def kept(self) -> tuple[Kept, ...]:
        """Nodes with traction unknowns, in their order."""
        pairs, sides, nodes = self._native.kept()
        return tuple(map(Kept, pairs, sides, nodes.tolist()))

    def evaluate(
        self,
        positions: npt.ArrayLike,
        tractions: npt.ArrayLike,
        after: Optional[Evaluation] = None,
    ) -> Evaluation:
        """Residual, tangent and results of contact.

        positions: of all nodes, of shape (n, 3) (length).
        tractions: unknowns of the kept nodes, of shape (3 k,) (force per area).
        after: evaluation from which a correction led here. Without one it is the first of the
            increment, in which touching nodes count as closed.
        """
        x = check.rows(positions, "positions")
        given = check.array(tractions, "tractions")
        if given.ndim != 1:
            raise refuse("tractions", f"an array of one dimension is needed, not of {given.ndim}")
        before = None if after is None else check.kind(after, Evaluation, "after")._native
        found = self._native.evaluate(x, np.ascontiguousarray(given, dtype=np.float64), before)
        return Evaluation(found, self._contact)

    def missed(self, evaluation: Evaluation) -> Ints:
        """Nodes that have met the other side without a share in the tractions, of shape (m,); an
        increment that has missed some is solved again, see :meth:`reselected` (no unit).

        evaluation: a converged one.
        """
        return self._native.missed(check.kind(evaluation, Evaluation, "evaluation")._native)

    def reselected(self, evaluation: Evaluation) -> Increment:
        """The increment with the nodes that an evaluation shows to be needed. It has other
        traction unknowns, and starts from the positions of the evaluation.

        evaluation: one of this increment.
        """
        found = check.kind(evaluation, Evaluation, "evaluation")._native
        return Increment(self._native.reselected(found), self._contact)

    def accept(self, evaluation: Evaluation) -> State:
        """The state that the increment leads to.

        evaluation: one whose residual is small, with that of the elements.
        """
        found = check.kind(evaluation, Evaluation, "evaluation")._native
        return State._of(self._native.accept(found))


class Evaluation:
    """Contact at given positions and tractions. Arrays are read-only."""

    def __init__(self, found: native.Evaluation, contact: Contact) -> None:
        """Use :meth:`Increment.evaluate` with a contact; found is made by it."""
        self._native, self._contact = found, contact

    @cached_property
    def residual(self) -> Floats:
        """Residual of all rows: minus the contact forces (force), then the equations of the kept
        nodes (length where they state a gap or a slip, else force per area)."""
        return frozen(self._native.residual())

    @cached_property
    def _tangent(self) -> tuple[Ints, Ints, Floats]:
        rows, cols, values = self._native.tangent()
        return frozen(rows), frozen(cols), frozen(values)

    @property
    def rows(self) -> Ints:
        """Rows of the entries of the tangent (no unit)."""
        return self._tangent[0]

    @property
    def cols(self) -> Ints:
        """Columns of the entries of the tangent (no unit)."""
        return self._tangent[1]

    @property
    def values(self) -> Floats:
        """Entries of the tangent, one for each place (units of their rows over those of their
        columns)."""
        return self._tangent[2]

    @property
    def norm(self) -> float:
        """Largest residual of a row of a kept node over its scale: the facet size for gaps and
        slips, the largest pressure for tractions (no unit)."""
        return self._native.norm()

    @property
    def number(self) -> int:
        """Number of the evaluation in its increment, which counts from 0."""
        return self._native.number()

    @cached_property
    def forces(self) -> Floats:
        """Contact forces on all nodes, of shape (n, 3) (force)."""
        return frozen(self._native.forces())

    def pair(self, which: Union[int, str] = 0) -> PairEvaluation:
        """Results of a pair; which: its number, which counts from 0, or its name."""
        names = [one.name for one in self._contact.pairs]
        if isinstance(which, str):
            index = names.index(check.word(which, names, "which"))
        else:
            index = check.whole(which, "which", 0)
            if index >= len(names):
                raise refuse("which", f"there are {len(names)} pairs, but {index} is asked for")
        return PairEvaluation(self._native, index)


class PairEvaluation:
    """Results of a pair in an evaluation."""

    def __init__(self, found: native.Evaluation, index: int) -> None:
        """Use :meth:`Evaluation.pair`; found and index are made by it."""
        self._native, self._index = found, index
        self.a = SideResults(found, index, False)
        """Contact at the nodes of the first side."""
        self.b = SideResults(found, index, True)
        """Contact at the nodes of the second side, if it is deformable."""

    @property
    def force(self) -> Floats:
        """Contact force on side ``a``, of shape (3,) (force)."""
        return self._native.resultant(self._index, False)[0]

    @property
    def moment(self) -> Floats:
        """Moment of contact on side ``a`` about the origin, of shape (3,) (force times length)."""
        return self._native.resultant(self._index, False)[1]

    @property
    def force_b(self) -> Floats:
        """Contact force on side ``b``, of shape (3,) (force)."""
        return self._native.resultant(self._index, True)[0]

    @property
    def moment_b(self) -> Floats:
        """Moment of contact on side ``b`` about the origin, of shape (3,) (force times length)."""
        return self._native.resultant(self._index, True)[1]

    @property
    def dissipated(self) -> float:
        """Work that friction dissipates in the increment (force times length)."""
        return self._native.dissipated(self._index)


def _restored(stored: bytes) -> State:
    return State._of(native.State.restored(stored))


def _texture(value: Union[Texture, Vector, None]) -> Optional[Texture]:
    return texture(value)
