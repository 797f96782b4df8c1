"""Friction laws.

Coefficients have no unit. The texture ``s`` of a surface runs along its grooves or along
the row of scales, ``a = n x s`` across; for scales ``a`` points from root to free edge.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Literal, NamedTuple, Optional, Union

import numpy as np
import numpy.typing as npt

from . import _check as check
from . import _striae as native
from ._check import Floats, Values
from ._dependences import Dependences
from ._described import described
from ._errors import refuse
from ._factor import LARGEST_STATE, FactorFunction, Functions, StateFunction
from ._made import Recipe, listed

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from typing_extensions import Self


@described
class SlipSurface(NamedTuple):
    """Friction of a slipping contact, sampled over all directions, per unit of pressure.

    Directions count in the frame of the texture, from ``a`` (across the grooves, against a
    nap) towards ``s``'s side, counter-clockwise; of two textures from their sum.
    """

    slip_angle: Floats
    """Direction of slip (degrees)."""
    friction: Floats
    """``-tau/p``, of shape (n, 2): along the axis of the frame and across it (no unit)."""
    dissipation: Floats
    """``-tau . d/p`` with the direction of slip ``d``: work per pressure and length of slip
    (no unit)."""


class Friction(Dependences):
    """Friction between two surfaces; see the laws."""

    _native: native.Friction
    _told: str

    def __init__(self) -> None:
        """Use one of the laws."""
        raise TypeError("use one of the laws, such as Coulomb, or OwnFriction")

    @classmethod
    def _of(
        cls,
        found: native.Friction,
        told: str,
        recipe: Optional[Recipe] = None,
    ) -> Friction:
        law: Friction = cls.__new__(cls)
        law._native, law._told, law._recipe = found, told, recipe
        law._is_finished = True
        return law

    def bound(
        self,
        pressure: Union[float, Sequence[float], Floats],
        slip_rate: Union[float, Sequence[float], Floats] = 0.0,
        accumulated_slip: Union[float, Sequence[float], Floats] = 0.0,
    ) -> Floats:
        """Largest friction at pressures, slip rates and accumulated slips (force per area): the
        coefficient times the pressure, with all dependences and the shear cap, without a factor
        of :meth:`with_factor`; in steady slip, if it depends on a state, and at rest as stated. In
        laws with a direction it is scaled with their slip surface, see :meth:`slip_surface`.

        pressure: one or many (force per area).
        slip_rate: one, or as many (length per time).
        accumulated_slip: one, or as many (length).
        """
        pressures = np.atleast_1d(check.finite(check.array(pressure, "pressure"), "pressure"))
        given = []
        for value, name in [(slip_rate, "slip_rate"), (accumulated_slip, "accumulated_slip")]:
            found = check.finite(check.array(value, name), name)
            if (found < 0.0).any():
                raise refuse(name, "it must not be negative")
            try:
                given.append(np.broadcast_to(found, pressures.shape).ravel().tolist())
            except ValueError:
                raise refuse(name, "one is needed, or as many as pressures") from None
        bounds = self._native.bound(pressures.ravel().tolist(), given[0], given[1])
        return bounds.reshape(pressures.shape)

    def _make(self, law: str, values: Values) -> None:
        """Makes a declared law of values that are present."""
        given = [(name, value) for name, value in values.items() if value is not None]
        self._native = native.Friction.declared(type(self).__name__, law, given)
        self._told = f"{type(self).__name__}({listed(given)})"

    def _with(self, key: str, form: str, method: str, values: Values) -> Friction:
        given = [(name, value) for name, value in values.items() if value is not None]
        found = self._native.with_dependence(key, form, given)
        recipe: Recipe = (getattr(Friction, method), (self, *values.values()), {})
        return Friction._of(found, f"{self._told}.{method}({listed(given)})", recipe)

    def with_shear_cap(self, shear_cap: float) -> Friction:
        """The law with a bound on friction.

        shear_cap: largest value of ``mu p``; laws of directions keep their proportions (force
            per area).
        """
        cap = check.number(shear_cap, "shear_cap")
        recipe: Recipe = (Friction.with_shear_cap, (self, cap), {})
        told = f"{self._told}.with_shear_cap({cap})"
        return Friction._of(self._native.with_shear_cap(cap), told, recipe)

    def with_factor(
        self,
        factor: FactorFunction,
        *,
        name: str,
        update: Optional[StateFunction] = None,
        state: Sequence[float] = (),
        textures: Literal["none", "one", "both"] = "none",
        pressure: float = 1.0,
        slip_rate: float = 1.0,
        accumulated_slip: float = 1.0,
        position: float = 1.0,
        time: float = 1.0,
        duration: float = 1.0,
    ) -> Friction:
        """Returns the law with a factor of all coefficients that a function states, in place of
        another one and of a dependence ``by_state``.

        The function is called during a run, once an evaluation of contact for all its nodes, with
        :class:`FactorPoints`, so it has to be written for arrays. A state of its own is kept at
        every node, through steps and continued runs, and can be written as the field
        ``friction-state``; those of open nodes rest. ``factor`` sees the state at the end of the
        increment, as ``update`` returns it.

        Derivatives make Newton's method converge quadratically. Functions that return
        :class:`FactorSlopes` and :class:`StateSlopes` state them; else, and by textures, they are
        taken as central differences, with all shifted points in the same call: five times the
        points, 23 times with textures, and relative errors of about 1e-9.

        The law is held against mechanics first, at random points up to the largest values that are
        given: the factor is not negative, its product with the pressure does not fall with the
        pressure, it does not jump with pressure or slip rate, its slope by the slip rate is finite
        at rest, both surfaces see the same factor, derivatives are right, and a state neither
        changes in no time nor depends on how time is divided. Otherwise one :class:`ModelError`
        says what is wrong. During a run a negative factor ends the run with a message that names
        the law, and an exception in a function ends it and is raised.

        factor: from points to factors, of shape (n,), or :class:`FactorSlopes`.
        name: of the law in messages; states go on under it where a step changes the law.
        update: from points to states at the end of the increment, of shape (n, m), or
            :class:`StateSlopes`.
        state: state at the start, at most eight numbers.
        textures: surfaces of which the function sees the textures.
        pressure: largest pressure for which the law is made (force per area).
        slip_rate: largest slip rate (length per time).
        accumulated_slip: largest accumulated slip (length).
        position: largest coordinate (length).
        time: end of the run (time).
        duration: longest increment (time).
        """
        for function, told in ((factor, "factor"), (update, "update")):
            if not callable(function) and (told == "factor" or function is not None):
                raise TypeError(f"{told}: a function of points is needed")
        law = check.name(name, "name")
        check.several(state, "state", "a list of numbers")
        start = check.numbers(state, "state")
        if (update is None) != (not start):
            raise refuse("state", "a state needs both `state` at the start and `update`")
        if len(start) > LARGEST_STATE:
            raise refuse("state", f"at most {LARGEST_STATE} numbers are possible")
        which = check.word(textures, ("none", "one", "both"), "textures")
        scales = {
            "pressure": pressure,
            "slip_rate": slip_rate,
            "accumulated_slip": accumulated_slip,
            "position": position,
            "time": time,
            "duration": duration,
        }
        ranges = [check.positive(value, path) for path, value in scales.items()]
        functions = Functions(law, factor, update, len(start), ranges[:2], which != "none")
        found = self._native.with_factor(
            law, functions.factors, functions.states, start, ranges, which
        )
        recipe: Recipe = (
            Friction.with_factor,
            (self, factor),
            {"name": law, "update": update, "state": start, "textures": which, **scales},
        )
        return Friction._of(found, f"{self._told}.with_factor(name={law!r})", recipe)

    def slip_surface(self, theta: float = 0.0, count: int = 360) -> SlipSurface:
        """Friction in all directions of slip, per unit of pressure and at rest.

        theta: angle between the textures of two textured surfaces (degrees); it has no
            effect on other laws.
        count: number of samples.
        """
        theta = check.number(theta, "theta")
        count = check.whole(count, "count", 3)
        angle, along, across, _, work = self._native.slip_surface(np.radians(theta), count)
        mu = self._native.coefficient
        return SlipSurface(np.degrees(angle), mu * np.column_stack([along, across]), mu * work)

    def plot(self, axes: Union[Axes, None] = None, theta: float = 0.0) -> Axes:
        """Draws the slip surface, and arrows of slip from it, with matplotlib.

        axes: where it is drawn; on a new figure by default.
        theta: angle between the textures of two textured surfaces (degrees).
        """
        from ._plot import draw_friction

        return draw_friction(self, axes, theta)

    def __repr__(self) -> str:
        return self._told


class SampledFriction(Friction):
    """Friction from coefficients at many angles."""

    def __init__(
        self, angles: Union[Sequence[float], Floats], mu: Union[Sequence[float], Floats]
    ) -> None:
        """Makes the law of angles (degrees) and coefficients (no unit)."""
        raise TypeError("use Tabulated")

    @classmethod
    def sampled(cls, mu: Callable[[float], float], count: int = 360) -> Self:
        """Makes the law from a function, its polar curve, which is called for each angle once.

        Between the angles the law is monotone and smooth; it differs from the function by the
        square of their distance and less.

        mu: coefficient of friction (no unit) of slip at an angle (degrees).
        count: number of angles, from 0 at equal distances.
        """
        if not callable(mu):
            raise TypeError("mu: a function of the angle is needed")
        angles = [360.0 * at / check.whole(count, "count", 3) for at in range(count)]
        return cls(angles, [check.number(mu(angle), f"mu at {angle} degrees") for angle in angles])


class OwnFriction(Friction):
    """A friction law that a function of Python states by its kernel.

    At a contact point with the pressure ``p``, friction is ``-tau = mu p (L d + eta)`` in slip
    along ``K d`` with a unit vector ``d``; without slip it is anywhere inside that slip surface.
    The matrices ``L`` and ``K``, of shape (2, 2), and the vector ``eta`` are in the frame of
    :class:`SlipSurface`: of one texture ``a`` (across the grooves, against a nap) and a quarter
    turn from it, of two textures their bisector and a quarter turn from it. There they depend
    on the angle between two textures, and of one texture on nothing.

    The function is called when the law is made, not during a run: its answers become a Fourier
    series over the angle, exact to round-off. The law is held against mechanics: friction
    dissipates in all directions, is opposite on the two surfaces, inside its slip surface, and
    derivatives are exact. Otherwise one :class:`ModelError` says what is wrong.
    """

    def __init__(
        self,
        kernel: Callable[[float], Sequence[npt.ArrayLike]],
        mu: float = 1.0,
        *,
        textures: Literal["one", "two"] = "one",
        name: str = "own",
    ) -> None:
        """Makes the law.

        kernel: from the angle from the texture of one surface to that of the other, above -180
            and below 180 and 0 where there is one texture (degrees), to ``L`` and ``eta``, or
            ``L``, ``eta`` and ``K``, which is the identity where it is left out (no unit).
        mu: coefficient of friction, positive (no unit).
        textures: how many surfaces must have one.
        name: of the law in messages.
        """
        if not callable(kernel):
            raise TypeError("kernel: a function of the angle between the textures is needed")
        law = check.name(name, "name")
        coefficient = check.positive(mu, "mu")
        two = check.word(textures, ("one", "two"), "textures") == "two"
        terms = _series(kernel, law) if two else [[_kernel(kernel, 0.0, law), [0.0] * 10]]
        self._native = native.Friction.own(law, two, terms, coefficient)
        self._told = f"OwnFriction(name={law!r}, mu={coefficient}, textures={textures!r})"


#: Numbers of angles at which the kernel of two textures is asked for, one after the other.
SAMPLES = (16, 64, 256)

#: Harmonics below this share of the largest one are round-off.
ROUND_OFF = 1e-13


def _series(kernel: Callable[[float], Sequence[npt.ArrayLike]], law: str) -> list[list[list[float]]]:
    """Cosine and sine terms of the kernel in the frame of the first texture, where it is
    periodic in the angle between the textures."""
    for count in SAMPLES:
        # Not at 180 degrees, where opposed textures have no bisector.
        angles = 2.0 * np.pi * ((np.arange(count) + 0.5) / count - 0.5)
        values = np.array([_turned(kernel, angle, law) for angle in angles])
        order = np.arange(count // 2)
        weights = np.where(order == 0, 1.0, 2.0)[:, None] / count
        even = weights * (np.cos(np.outer(order, angles)) @ values)
        odd = weights * (np.sin(np.outer(order, angles)) @ values)
        size = np.hypot(even, odd).max(axis=1)
        present = np.flatnonzero(size > ROUND_OFF * size.max())
        last = int(present[-1])
        if last < count // 4:
            chosen = slice(0, last + 1)
            terms: list[list[list[float]]] = np.stack([even[chosen], odd[chosen]], axis=1).tolist()
            return terms
    raise refuse(
        law,
        "the kernel is no smooth function of the angle between the textures: its Fourier series"
        f" has not ended after {SAMPLES[-1] // 4} terms; mind that the bisector turns back where"
        " textures become opposed, so what points along it must vanish there",
    )


def _turned(
    kernel: Callable[[float], Sequence[npt.ArrayLike]], angle: float, law: str
) -> list[float]:
    """The kernel in the frame of the first texture, half of the angle from the bisector."""
    found = np.array(_kernel(kernel, float(np.degrees(angle)), law))
    cosine, sine = np.cos(angle / 2.0), np.sin(angle / 2.0)
    turn = np.array([[cosine, -sine], [sine, cosine]])
    matrices = [turn @ found[at : at + 4].reshape(2, 2) @ turn.T for at in (0, 6)]
    return [*matrices[0].ravel(), *(turn @ found[4:6]), *matrices[1].ravel()]


def _kernel(
    kernel: Callable[[float], Sequence[npt.ArrayLike]], angle: float, law: str
) -> list[float]:
    """``L`` by rows, ``eta`` and ``K`` by rows."""
    answer = kernel(angle)
    if not isinstance(answer, (tuple, list)) or len(answer) not in (2, 3):
        raise refuse(law, "`L` and `eta` are needed, or `L`, `eta` and `K`")
    parts = [*answer, np.eye(2)][:3]
    numbers: list[float] = []
    for part, what, shape in zip(parts, ("L", "eta", "K"), ((2, 2), (2,), (2, 2))):
        found = check.array(part, f"{law}: {what}")
        if found.shape != shape:
            raise refuse(f"{law}: {what}", f"it must have shape {shape}, but has {found.shape}")
        numbers += check.finite(found, f"{law}: {what}").ravel().tolist()
    if abs(np.linalg.det(np.reshape(numbers[6:], (2, 2)))) < ROUND_OFF:
        raise refuse(f"{law}: K", "it must be regular")
    return numbers
