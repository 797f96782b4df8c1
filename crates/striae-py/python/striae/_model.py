"""Models: bodies, pairs and steps."""

from __future__ import annotations

import copy
import warnings
from collections.abc import Sequence
from typing import Any, Literal, NamedTuple, Optional, Union

import numpy as np

from . import _check as check
from . import _striae as native
from ._body import Body, BodySet
from ._cavity import Cavity
from ._described import described
from ._errors import refuse
from ._everything import FEATURE_ANGLE, Everything, Excluded, Surface
from ._friction import Friction
from ._laws import Frictionless
from ._made import Strict, are_alike
from ._mesh import Mesh
from ._pair import Pair, _change
from ._rigid import Rigid
from ._run import Callback, Ended, Keep, Path, Run, closed, concluded, record, watch
from ._spring import Spring
from ._step import Condition, Dynamics, Increments, Step
from ._tie import Tie

BACKENDS = ("condensed", "multifrontal", "faer", "iterative")


class Solver(Strict):
    """Newton's method and the linear solver."""

    def __init__(
        self,
        backend: Literal["condensed", "multifrontal", "faer", "iterative"] = "condensed",
        *,
        tolerance: float = 1e-10,
        largest_iterations: int = 40,
    ) -> None:
        """Makes the settings.

        backend: factorisation: ``condensed`` (bodies by Cholesky, contact by dense algebra, or
            another one if that is cheaper), ``multifrontal``, ``faer``, ``iterative``.
        tolerance: relative tolerance of every residual field (no unit).
        largest_iterations: iterations after which an increment is cut.
        """
        self.backend = check.word(backend, BACKENDS, "backend")
        """Factorisation."""
        self.tolerance = check.positive(tolerance, "tolerance")
        """Relative tolerance of every residual field (no unit)."""
        if self.tolerance >= 1.0:
            raise refuse("tolerance", f"it must be below 1, but is {self.tolerance}")
        self.largest_iterations = check.whole(largest_iterations, "largest_iterations")
        """Iterations after which an increment is cut."""

    def __repr__(self) -> str:
        return (
            f"Solver({self.backend!r}, tolerance={self.tolerance},"
            f" largest_iterations={self.largest_iterations})"
        )


@described
class Fit(NamedTuple):
    """Initial fit of the meshes of a pair."""

    pair: str
    """Name of the pair."""
    gap: Optional[float]
    """Smallest gap; ``None`` if the sides do not face each other (length)."""
    overlap: float
    """Deepest overlap (length)."""
    distance: float
    """Smallest distance between the sides, whether they face each other or not (length)."""


@described
class Check(NamedTuple):
    """Findings of :meth:`Model.check`."""

    unknowns: int
    """Unknowns at the start."""
    fits: list[Fit]
    """Initial fit of the pairs."""
    warnings: list[str]
    """Warnings: settings that are likely to be unintended."""


@described
class Remark(NamedTuple):
    """One remark on a model before it is run."""

    topic: str
    """Topic: ``shape``, ``units``, ``locking``, ``bending``, ``hold``, ``fit``, ``facing``,
    ``never-meets``, ``contact``, ``friction``, ``texture`` or ``cost``."""
    name: Optional[str]
    """Name of the body, pair or step it concerns, if it concerns one."""
    text: str
    """Text of the remark."""


@described
class Advice(NamedTuple):
    """Findings of :meth:`Model.advice`, those of ``striae check`` for a deck."""

    faults: list[Remark]
    """Remarks on what makes a run impossible."""
    warnings: list[Remark]
    """Remarks on what makes results doubtful."""
    notes: list[Remark]
    """Remarks of general interest."""

    def __str__(self) -> str:
        kinds = zip(("note", "warning", "fault"), (self.notes, self.warnings, self.faults))
        return "\n".join(f"{kind}: {one.text}" for kind, remarks in kinds for one in remarks)


class Model(Strict):
    """A simulation model. Quantities are in one consistent system of units of your choice."""

    _title: str
    _base: Optional[native.Model]
    _earlier: list[str]
    _bodies: list[Body]
    _rigid: list[Rigid]
    _pairs: list[Pair]
    _everything: Optional[Everything]
    _ties: list[Tie]
    _springs: list[Spring]
    _cavities: list[Cavity]
    _steps: list[Step]
    _solver: Solver
    _running: int
    _last_run: Optional[Run]

    def __init__(
        self,
        bodies: Sequence[Body] = (),
        rigid: Sequence[Rigid] = (),
        pairs: Sequence[Pair] = (),
        *,
        ties: Sequence[Tie] = (),
        springs: Sequence[Spring] = (),
        cavities: Sequence[Cavity] = (),
        steps: Sequence[Step] = (),
        title: str = "model",
        solver: Optional[Solver] = None,
    ) -> None:
        """Makes a model.

        bodies: deformable bodies.
        rigid: rigid bodies.
        pairs: contact pairs.
        ties: surfaces of bodies that are glued.
        springs: springs and dashpots.
        cavities: cavities with a pressure inside.
        steps: the loading history; :meth:`step` adds to it.
        title: description in one line.
        solver: settings of the solver.
        """
        self._begin(title)
        self._bodies = check.kinds(bodies, Body, "bodies")
        self._rigid = check.kinds(rigid, Rigid, "rigid")
        self._pairs = check.kinds(pairs, Pair, "pairs")
        for index, pair in enumerate(self._pairs):
            for side in (pair.a, pair.b):
                _refuse_another(side, self._rigid, f"pairs[{index}]")
        self._ties = check.kinds(ties, Tie, "ties")
        self._springs = check.kinds(springs, Spring, "springs")
        self._cavities = check.kinds(cavities, Cavity, "cavities")
        self._steps = check.kinds(steps, Step, "steps")
        self._solver = Solver() if solver is None else check.kind(solver, Solver, "solver")

    def _begin(self, title: str) -> None:
        self._title = title
        self._base, self._earlier = None, []
        self._bodies, self._rigid, self._pairs, self._ties, self._steps = [], [], [], [], []
        self._springs, self._cavities = [], []
        self._solver = Solver()
        self._everything = None
        self._running = 0
        self._last_run = None

    @classmethod
    def _of(cls, base: native.Model) -> Model:
        model = object.__new__(cls)
        model._begin(base.title)
        model._base, model._earlier = base, base.steps()
        names = enumerate(base.bodies())
        model._bodies = [Body._known(name, Mesh._of(base.mesh(at))) for at, name in names]
        model._rigid = [Rigid._known(name) for name in base.rigid()]
        return model

    @classmethod
    def from_deck(cls, path: Path) -> Model:
        """The model of a deck; further steps can be added.

        Derivatives that the deck asks for are left to the program and to :func:`differentiate`.

        path: the deck, a TOML file.
        """
        return cls._of(_told(native.Model.from_deck(check.file(path, "path"))))

    @classmethod
    def from_text(cls, text: str, folder: Path = ".") -> Model:
        """The model of a deck given as text.

        text: the deck, TOML.
        folder: that paths in the deck are relative to.
        """
        if not isinstance(text, str):
            raise TypeError(f"text: the text of a deck is needed, not {type(text).__name__}")
        return cls._of(_told(native.Model.from_text(text, check.file(folder, "folder"))))

    def to_deck(self, path: Optional[Path] = None) -> str:
        """The model as the text of a deck, from which :meth:`from_text` and the program make an
        equal one, with results identical to the last bit.

        Meshes are written out in full, however they were made, and so are all defaults.

        path: file to write the text to, in addition.
        """
        text = self._compiled().to_deck()
        if path is not None:
            with open(check.file(path, "path"), "w", encoding="utf-8") as file:
                file.write(text)
        return text

    def step(
        self,
        name: str,
        *conditions: Condition,
        duration: float = 1.0,
        increments: Union[int, Increments] = 10,
        dynamics: Optional[Dynamics] = None,
    ) -> Step:
        """Adds a step at the end.

        name: unique name.
        conditions: what the step states.
        duration: in (pseudo) time.
        increments: number of equal increments, cut where needed, or their sizes.
        dynamics: inertia; without it the step is a sequence of equilibria.
        """
        self._rests()
        made = Step(
            name, *conditions, duration=duration, increments=increments, dynamics=dynamics
        )
        self._steps.append(made)
        return made

    def contact_all(
        self,
        friction: Optional[Friction] = None,
        *,
        exclude: Sequence[Excluded] = (),
        between: Sequence[tuple[Surface, Surface, Friction]] = (),
        textures: Sequence[Union[BodySet, Rigid]] = (),
        feature_angle: float = FEATURE_ANGLE,
        search_distance: Optional[float] = None,
        initial: Union[Literal["as-meshed", "close", "resolve"], float] = "as-meshed",
        stabilise: bool = False,
    ) -> None:
        """Lets every surface touch every surface: all skins of bodies and all rigid bodies with
        each other, and each body with itself. Facets of a pair of the model keep its settings, and
        tied facets are left out.

        This makes pairs, which are named after their surfaces, such as ``tread-road``,
        ``tread-tread`` or ``tread.zmin-road``; see :attr:`pair_names`.

        Surfaces are bodies, facet sets ``body["top"]``, rigid bodies, or labels: ``"tread"``,
        ``"tread.zmin"``.

        friction: law for surfaces not named in ``between``; steps may change it. Frictionless by
            default.
        exclude: surfaces that touch nothing, and tuples of two that do not touch each other.
        between: tuples of two surfaces and their law; of several statements about the same
            facets, here and in ``exclude``, the narrowest counts.
        textures: surfaces with textures, ``body["top"].textured((1, 0, 0))``, for laws that need
            one; those of rigid bodies and of surfaces in ``between`` are found without it.
        feature_angle: dihedral angle from which on an edge separates faces, each with its own
            normal and traction there (degrees).
        search_distance: distance within which contact is searched (length); it affects the cost,
            not the result.
        initial: treatment of gaps and overlaps of the meshes of different bodies, as in
            :class:`Pair`.
        stabilise: if true, viscous forces carry bodies without other restraints across a gap, in
            steps without inertia.
        """
        self._rests()
        if self._base is not None:
            raise refuse("model", "the contact of a deck is stated in it")
        self._everything = Everything(
            friction,
            exclude,
            between,
            textures,
            feature_angle,
            search_distance,
            initial,
            stabilise,
        )

    @property
    def title(self) -> str:
        """Description of the model in one line."""
        return self._title

    @property
    def bodies(self) -> tuple[Body, ...]:
        """Deformable bodies."""
        return tuple(self._bodies)

    @property
    def rigid(self) -> tuple[Rigid, ...]:
        """Rigid bodies."""
        return tuple(self._rigid)

    @property
    def body_names(self) -> list[str]:
        """Names of the deformable bodies."""
        return [body.name for body in self._bodies]

    @property
    def rigid_names(self) -> list[str]:
        """Names of the rigid bodies."""
        return [rigid.name for rigid in self._rigid]

    @property
    def pair_names(self) -> list[str]:
        """Names of the pairs, including those made by :meth:`contact_all`; for these the model must
        be complete, with its steps."""
        if self._base is not None:
            return self._base.pairs()
        if self._everything is not None:
            return self._compiled().pairs()
        return self._named

    @property
    def tie_names(self) -> list[str]:
        """Names of the ties."""
        return [tie.name for tie in self._ties] if self._base is None else self._base.ties()

    @property
    def spring_names(self) -> list[str]:
        """Names of the springs."""
        if self._base is not None:
            return self._base.springs()
        return [spring.name for spring in self._springs]

    @property
    def cavity_names(self) -> list[str]:
        """Names of the cavities."""
        if self._base is not None:
            return self._base.cavities()
        return [cavity.name for cavity in self._cavities]

    @property
    def step_names(self) -> list[str]:
        """Names of the steps."""
        return self._earlier + [step.name for step in self._steps]

    @property
    def last_run(self) -> Optional[Run]:
        """The last run of the model, even if an exception ended it."""
        return self._last_run

    def body(self, name: str) -> Body:
        """A deformable body; name: of the body."""
        return self._bodies[self._position("body", self.body_names, name)]

    def rigid_body(self, name: str) -> Rigid:
        """A rigid body; name: of the body."""
        return self._rigid[self._position("rigid body", self.rigid_names, name)]

    def friction(self, pair: Union[int, str]) -> Friction:
        """Friction of a pair from the start; pair: its name, or its number from 0."""
        index = self._position("pair", self.pair_names, pair)
        if self._base is None and index < len(self._pairs):
            law = self._pairs[index].friction
            return Frictionless() if law is None else law
        base = self._compiled() if self._base is None else self._base
        return Friction._of(base.friction(index), f"friction of {base.pairs()[index]}")

    def change_friction(self, pair: Union[int, str], friction: Friction) -> Condition:
        """Changes the friction of a pair at the start of a step.

        pair: its name, or its number from 0.
        friction: the new law.
        """
        if self._everything is not None and isinstance(pair, str):
            # Its pairs are not known before the steps are; the name is judged with them.
            return _change(pair, friction)
        return _change(self.pair_names[self._position("pair", self.pair_names, pair)], friction)

    def check(self) -> Check:
        """Finds all faults; raises :class:`ModelError` with them, or returns how the meshes fit.

        Nothing is computed yet. :meth:`run` checks, too.
        """
        compiled = self._compiled()
        unknowns, fits, warnings = compiled.check()
        named = zip(compiled.pairs(), fits)
        return Check(unknowns, [Fit(name, *fit) for name, fit in named], warnings)

    def advice(self) -> Advice:
        """Inspects the model like ``striae check``: extent and shape of bodies, units, locking,
        restraint of each body, gaps and overlaps, friction over all directions, memory and time.
        Raises :class:`ModelError` if the model has faults; nothing is computed yet.
        """
        found = self._compiled().advice()
        faults, warnings, notes = [[Remark(*one) for one in remarks] for remarks in found]
        return Advice(faults, warnings, notes)

    def run(
        self,
        on_increment: Optional[Callback] = None,
        *,
        output: Optional[Path] = None,
        case: Optional[str] = None,
        fields_every: Optional[int] = None,
        keep: Keep = "steps",
        threads: Optional[int] = None,
        on_stop: Literal["raise", "return"] = "raise",
    ) -> Run:
        """Runs the model.

        Other Python threads continue meanwhile. Ctrl-C ends the run after the current increment and
        raises :class:`RunInterrupted`; an exception of ``on_increment`` ends it, too. In both cases
        files are complete and :attr:`last_run` has the history and the kept states.

        on_increment: called with each converged increment on the thread that runs the model;
            if it returns ``False``, the run ends there.
        output: folder for the files that the program writes (fields for ParaView, history,
            summary); nothing is written by default.
        case: name of the case in these files; the title, or that of the deck, by default.
        fields_every: increments between files of fields; 0: only the last.
        keep: increments whose state is kept in memory: ``steps`` (the last one of each step, so
            that long runs stay small), ``all``, ``last``, or a number ``n`` for every ``n``-th.
            The last is always kept, and the history has all.
        threads: number of threads; that of the machine by default. Results do not depend on it.
        on_stop: treatment of a run that cannot reach its end: ``raise`` :class:`RunStopped`, or
            ``return`` the run.
        """
        check.word(on_stop, ("raise", "return"), "on_stop")
        recording = record(output, case, fields_every)
        return concluded(self._ended(on_increment, keep, threads, recording), on_stop)

    def _run(
        self, threads: int, keep: Keep, output: Optional[Path], fields_every: Optional[int]
    ) -> Run:
        """The run as one of many, whatever its ending, with warnings that are not issued yet."""
        recording = record(output, None, fields_every)
        return closed(self._ended(None, keep, threads, recording), "return")

    @property
    def _named(self) -> list[str]:
        return [pair.name for pair in self._pairs]

    def _ended(
        self,
        on_increment: Optional[Callback],
        keep: Keep,
        threads: Optional[int],
        recording: native.Recording,
        parameters: Sequence[tuple[str, float, native.Model, native.Model]] = (),
    ) -> Ended:
        """The run, and the exception that it ended with."""
        # The run keeps the model as it is now, whatever becomes of this one.
        model = copy.copy(self)
        watching = watch(on_increment, keep, threads, model)
        compiled = model._compiled()
        self._running += 1
        try:
            found, exception = native.run(compiled, watching, recording, list(parameters))
        finally:
            self._running -= 1
        folder = None if recording is None else recording[0]
        self._last_run = Run(found, model, folder, {name: step for name, step, *_ in parameters})
        return self._last_run, exception

    def _rests(self) -> None:
        """Refuses changes of the model while it runs."""
        if self._running:
            raise RuntimeError("the model is running; change it when the run has ended")

    def _compiled(self) -> native.Model:
        steps = [step._native for step in self._steps]
        if self._base is not None:
            return self._base.extended(steps) if steps else self._base
        solver = self._solver
        return native.Model.build(
            self._title,
            [body._part() for body in self._bodies],
            [one._native for one in self._rigid if one._native is not None],
            [pair._native for pair in self._pairs],
            None if self._everything is None else self._everything.native(self._rigid),
            [tie._native for tie in self._ties],
            [spring._native for spring in self._springs],
            [cavity._native for cavity in self._cavities],
            steps,
            (solver.backend, solver.tolerance, solver.largest_iterations),
        )

    def _position(self, kind: str, names: Sequence[str], which: Union[int, str]) -> int:
        if isinstance(which, str):
            if which not in names:
                known = ", ".join(f"`{name}`" for name in names) or "none"
                raise refuse("model", f"no {kind} is named `{which}`; there is {known}")
            return names.index(which)
        if isinstance(which, bool) or not isinstance(which, (int, np.integer)):
            raise TypeError(f"{kind}: a name or a number is needed, not {which!r}")
        if not -len(names) <= which < len(names):
            raise refuse("model", f"there is no {kind} {which}; there are {len(names)}, from 0")
        return range(len(names))[which]

    def __reduce__(self) -> tuple[Any, ...]:
        """Models are pickled as decks."""
        return Model.from_text, (self.to_deck(),)

    def __deepcopy__(self, memo: dict[int, Any]) -> Model:
        """A model with the same parts, to which other steps can be added."""
        made = object.__new__(type(self))
        made.__dict__.update(self.__dict__)
        made._bodies = [copy.copy(body) for body in self._bodies]
        made._rigid, made._pairs = list(self._rigid), list(self._pairs)
        made._ties, made._springs = list(self._ties), list(self._springs)
        made._cavities, made._solver = list(self._cavities), copy.copy(self._solver)
        made._steps, made._earlier = list(self._steps), list(self._earlier)
        made._running, made._last_run = 0, None
        return made

    def __copy__(self) -> Model:
        return self.__deepcopy__({})

    def __repr__(self) -> str:
        return (
            f"Model({self._title!r}, bodies {self.body_names}, rigid {self.rigid_names},"
            f" pairs {self._named if self._base is None else self.pair_names}, ties {self.tie_names}, steps {self.step_names})"
        )


def _refuse_another(side: object, rigid: Sequence[Rigid], path: str) -> None:
    """Refuses a rigid side of a pair in place of which the model has another one of its name."""
    if isinstance(side, Rigid):
        for one in rigid:
            if one.name == side.name and not are_alike(one, side):
                raise refuse(
                    path,
                    f"its rigid body `{side.name}` differs from that of this name in `rigid`; state"
                    " the same object in both",
                )


def _told(model: native.Model) -> native.Model:
    """Warns of derivatives that a deck asks for, which runs of its model do not compute."""
    if model.wrt:
        names = ", ".join(f"`{name}`" for name in model.wrt)
        warnings.warn(
            f"[sensitivity] of the deck asks for derivatives by {names}, which a run of its model "
            "does not compute; run the deck with the program, or use striae.differentiate",
            stacklevel=3,
        )
    return model
