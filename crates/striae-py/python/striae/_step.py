"""Steps of the loading history and their conditions.

A condition holds from the step that states it until a later step states the same again or
releases it. It takes its quantity from the present value to the target along a curve:
``ramp``, ``constant`` (at once), ``smooth``, points (fraction of the step, share of the
change) from 0 to 1 with straight lines between them, a function of the fraction, which is
called at 1001 fractions when the condition is made, or a :class:`Course`, which may be over the
time of the run.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Union

from . import _check as check
from . import _striae as native
from ._check import Curve, Vector
from ._errors import refuse
from ._made import Made


class Condition:
    """Condition of a step: made by sets of bodies, rigid bodies, pairs and :func:`gravity`."""

    def __init__(self, told: str, apply: Callable[[native.Step], None]) -> None:
        """Conditions are made by methods of the objects they act on, such as
        ``body["top"].displace(z=-1)``."""
        self._told, self._apply = told, apply

    def __repr__(self) -> str:
        return f"<{self._told}>"


class _Gravity(Condition):
    """Gravity, which is one for the whole model."""


def gravity(acceleration: Vector, *, curve: Curve = "ramp") -> Condition:
    """Gravity on all bodies with a density, until a later step restates it.

    acceleration: target (length per time squared).
    curve: how the target is approached.
    """
    target, along = check.vector(acceleration, "acceleration"), check.curve(curve, "curve")
    return _Gravity(f"gravity {target}", lambda step: step.gravity(target, along))


class Increments:
    """Sizes of the increments of a step, as fractions of its duration."""

    def __init__(
        self,
        initial: float = 0.1,
        *,
        smallest: Union[float, None] = None,
        largest: Union[float, None] = None,
    ) -> None:
        """Makes the sizes.

        initial: first increment (fraction of the step).
        smallest: smallest increment, below which the run ends; a thousandth of the first by default
            (fraction of the step).
        largest: the first by default (fraction of the step).
        """
        self.initial = check.fraction(initial, "initial")
        """First increment (fraction of the step)."""
        self.smallest = (
            1e-3 * self.initial if smallest is None else check.fraction(smallest, "smallest")
        )
        """Smallest increment, below which the run ends (fraction of the step)."""
        self.largest = self.initial if largest is None else check.fraction(largest, "largest")
        """Largest increment (fraction of the step)."""

    def __repr__(self) -> str:
        return f"Increments({self.initial}, smallest={self.smallest}, largest={self.largest})"


class Dynamics:
    """Implicit dynamics by the generalised-alpha method."""

    def __init__(self, spectral_radius: float = 0.8) -> None:
        """Makes the settings.

        spectral_radius: at infinite frequency, from 0 to 1 (no unit): 1 keeps
            oscillations that the increments do not resolve, small values damp them.
        """
        self.spectral_radius = check.number(spectral_radius, "spectral_radius")
        """Spectral radius at infinite frequency (no unit)."""
        if not 0.0 <= self.spectral_radius <= 1.0:
            raise refuse("spectral_radius", f"it must be from 0 to 1, but is {spectral_radius}")

    def __repr__(self) -> str:
        return f"Dynamics({self.spectral_radius})"


class Step(Made):
    """A part of the loading history."""

    def __init__(
        self,
        name: str,
        *conditions: Condition,
        duration: float = 1.0,
        increments: Union[int, Increments] = 10,
        dynamics: Union[Dynamics, None] = None,
    ) -> None:
        """Makes a step.

        name: unique name.
        conditions: conditions that the step states.
        duration: in (pseudo) time.
        increments: number of equal increments, cut if needed, or their sizes.
        dynamics: inertia; without it the step is a sequence of equilibria.
        """
        self.name = check.name(name, "name")
        """Name of the step."""
        self._native = native.Step(name, check.positive(duration, "duration"))
        if isinstance(increments, Increments):
            self._native.sizes(increments.initial, increments.smallest, increments.largest)
        else:
            self._native.equal(check.whole(increments, "increments"))
        if dynamics is not None:
            self._native.dynamic(check.kind(dynamics, Dynamics, "dynamics").spectral_radius)
        if sum(isinstance(condition, _Gravity) for condition in conditions) > 1:
            raise refuse(f"step `{name}`", "gravity is stated twice; state the sum of both")
        for condition in conditions:
            check.kind(condition, Condition, f"step `{name}`")._apply(self._native)

    def __repr__(self) -> str:
        return f"Step({self.name!r})"
