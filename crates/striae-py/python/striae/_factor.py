"""Factors of friction that functions state for all nodes of a pair at once."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, NamedTuple, Optional, Union

import numpy as np
import numpy.typing as npt

from . import _check as check
from ._check import Floats
from ._described import described
from ._errors import refuse

#: Largest number of state variables.
LARGEST_STATE = 8

#: Step of differences over what they are taken of, the cube root of the round-off.
STEP = 6e-6

#: Part of the range of pressure and slip rate below which steps do not fall with them.
LEAST = 1e-3


@described
class FactorPoints(NamedTuple):
    """Points of a contact surface at the end of an increment, for :meth:`Friction.with_factor`.

    Arrays have one row a point. Accumulated slip and position are those at the start of the
    increment; ``state`` is that at its start where a state is asked for, and that at its end where
    a factor is.
    """

    pressure: Floats
    """Pressure, zero or positive (force per area)."""
    slip_rate: Floats
    """Slip of the increment over its duration (length per time)."""
    slip: Floats
    """Slip of the increment (length)."""
    accumulated_slip: Floats
    """Slip up to the increment (length)."""
    position: Floats
    """Position, of shape (n, 3) (length)."""
    normal: Floats
    """Outward unit normal of the surface that carries the point, of shape (n, 3)."""
    texture: Floats
    """Direction ``a = n x s`` of its texture, of shape (n, 3) (no unit); zero without one, and not
    a number where the law has been made with ``textures="none"``."""
    opposite_texture: Floats
    """Direction of the texture of the other surface for this normal, ``-a``, of shape (n, 3) (no
    unit); zero without one, and not a number where the law has been made with
    ``textures="none"``."""
    state: Floats
    """State, of shape (n, m) (units of its start)."""
    time: float
    """Time at the end of the increment (time)."""
    duration: float
    """Duration of the increment (time)."""


@described
class FactorSlopes(NamedTuple):
    """Factors with their derivatives, as an answer of a function of :meth:`Friction.with_factor`."""

    factor: npt.ArrayLike
    """Factors, of shape (n,) (no unit)."""
    by_pressure: npt.ArrayLike
    """Derivatives by the pressure, of shape (n,) (area per force)."""
    by_slip_rate: npt.ArrayLike
    """Derivatives by the slip rate, of shape (n,) (time per length)."""
    by_state: npt.ArrayLike = ()
    """Derivatives by the state at the end of the increment, of shape (n, m)."""


@described
class StateSlopes(NamedTuple):
    """States with their derivatives, as an answer of a function of :meth:`Friction.with_factor`."""

    state: npt.ArrayLike
    """States at the end of the increment, of shape (n, m)."""
    by_pressure: npt.ArrayLike
    """Derivatives by the pressure, of shape (n, m)."""
    by_slip_rate: npt.ArrayLike
    """Derivatives by the slip rate at the duration of the increment, of shape (n, m)."""


FactorFunction = Callable[[FactorPoints], Union[npt.ArrayLike, FactorSlopes]]
StateFunction = Callable[[FactorPoints], Union[npt.ArrayLike, StateSlopes]]


class Functions:
    """Functions of a factor as the native part calls them."""

    def __init__(
        self,
        name: str,
        factor: FactorFunction,
        update: Optional[StateFunction],
        size: int,
        scales: Sequence[float],
        textured: bool,
    ) -> None:
        self.name = name
        self.factor = factor
        self.update = update
        #: Number of state variables.
        self.size = size
        #: Largest pressure and slip rate.
        self.scales = scales
        #: `True` if they see textures.
        self.textured = textured
        #: `True` if they state derivatives, as far as is known.
        self.stated = True

    def states(self, **given: Any) -> Floats:
        """States at the end of an increment."""
        return self._states(_points(given))[0]

    def factors(self, **given: Any) -> Floats:
        """Factors, derivatives by pressure and slip rate, and by normal and textures."""
        return self._factors(_points(given))

    def _states(self, at: FactorPoints) -> tuple[Floats, Optional[list[Floats]]]:
        """States, and derivatives by pressure and slip rate if they are stated."""
        if self.update is None:
            none = np.zeros((len(at.pressure), 0))
            return none, [none, none]
        answer = self.update(at)
        of = f"{self.name}: update"
        shape = (len(at.pressure), self.size)
        if isinstance(answer, StateSlopes):
            state, *slopes = (_shaped(part, of, shape) for part in answer)
            return state, slopes
        return _shaped(answer, of, shape), None

    def _value(self, at: FactorPoints) -> tuple[Floats, Optional[list[Floats]]]:
        """Factors with the states in the points, and derivatives if they are stated."""
        answer = self.factor(at)
        of = f"{self.name}: factor"
        shape = (len(at.pressure),)
        if isinstance(answer, FactorSlopes):
            value, *slopes = (_shaped(part, of, shape) for part in answer[:3])
            if self.size:
                slopes.append(_shaped(answer.by_state, of, (*shape, self.size)))
            return value, slopes
        return _shaped(answer, of, shape), None

    def _factors(self, at: FactorPoints) -> Floats:
        """Answer by stated derivatives, and by differences where there are none."""
        count = len(at.pressure)
        if self.stated and not self.textured:
            state, of_state = self._states(at)
            value, of_factor = self._value(at._replace(state=state))
            if of_state is not None and of_factor is not None:
                found = np.zeros((count, 12))
                found[:, 0] = value
                for column in (1, 2):
                    found[:, column] = of_factor[column - 1]
                    if self.size:
                        found[:, column] += np.sum(of_factor[2] * of_state[column - 1], axis=1)
                return found
            # From now on one call with all shifted points is enough.
            self.stated = False
        return self._differences(at)

    def _differences(self, at: FactorPoints) -> Floats:
        """Answer by central differences, one-sided where pressure or slip rate end at zero."""
        shifted: list[FactorPoints] = [at]
        widths: list[Floats] = []
        columns: list[int] = []
        for column, (field, scale) in enumerate(zip(("pressure", "slip_rate"), self.scales), 1):
            value: Floats = getattr(at, field)
            step = STEP * np.maximum(value, LEAST * scale)
            low, high = np.maximum(value - step, 0.0), value + step
            for ends in (low, high):
                moved = _moved(at, field, ends)
                shifted.append(moved._replace(slip=moved.slip_rate * at.duration))
            widths.append(high - low)
            columns.append(column)
        if self.textured:
            for first, field in ((3, "normal"), (6, "texture"), (9, "opposite_texture")):
                value = getattr(at, field)
                present = np.any(value != 0.0, axis=1)
                for axis in range(3):
                    for side in (-1.0, 1.0):
                        moved_by = np.zeros_like(value)
                        moved_by[present, axis] = side * STEP
                        shifted.append(_moved(at, field, value + moved_by))
                    widths.append(np.full(len(value), 2.0 * STEP))
                    columns.append(first + axis)
        arrays: dict[str, Any] = {
            field: np.concatenate([getattr(points, field) for points in shifted])
            for field in FactorPoints._fields[:-2]
        }
        joined = FactorPoints(**arrays, time=at.time, duration=at.duration)
        state, _ = self._states(joined)
        values, _ = self._value(joined._replace(state=state))
        parts = values.reshape(len(shifted), -1)
        found = np.zeros((len(at.pressure), 12))
        found[:, 0] = parts[0]
        for place, (column, width) in enumerate(zip(columns, widths)):
            found[:, column] = (parts[2 * place + 2] - parts[2 * place + 1]) / width
        return found


def _moved(at: FactorPoints, field: str, to: Floats) -> FactorPoints:
    """The points with other values of a field."""
    other: dict[str, Any] = {field: to}
    return at._replace(**other)


def _points(given: dict[str, Any]) -> FactorPoints:
    return FactorPoints(slip=given["slip_rate"] * given["duration"], **given)


def _shaped(value: npt.ArrayLike, of: str, shape: tuple[int, ...]) -> Floats:
    """The answer of a function as an array of a shape; one number serves all points."""
    found = check.array(value, of).astype(float)
    if found.shape == () and len(shape) == 1:
        return np.full(shape, float(found))
    if found.shape != shape:
        raise refuse(of, f"an array of shape {shape} is needed, but it has {found.shape}")
    return found
