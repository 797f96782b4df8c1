"""Curves over the time of the run, periodic ones, and functions of time as texts."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Literal, Optional, Union

from . import _check as check
from . import _striae as native
from ._errors import refuse
from ._made import Strict


class Course(Strict):
    """A curve for conditions to change along, beyond those that have a name.

    >>> shake = Course("sin(2*pi*t)")
    >>> saw = Course([(0, 0), (0.5, 1), (1, 0)], period=1)
    """

    def __init__(
        self,
        course: Union[str, Sequence[tuple[float, float]], Any],
        *,
        period: Optional[float] = None,
        time: Literal["run", "step"] = "run",
    ) -> None:
        """Makes the curve.

        course: points (time, value) with straight lines between them, such as two columns of
            ``numpy.loadtxt``, or a function of ``t`` as a text, with angles in radians.
        period: time after which points begin again; they lie within it.
        time: ``run``: over the time of the run (time); values are multiples of the target,
            whatever was before. ``step``: over the fraction of the step, from 0 to 1; values
            are shares of the change that is done then.
        """
        self.time = check.word(time, ("run", "step"), "time")
        """``run`` or ``step``."""
        self.period = None if period is None else check.positive(period, "period")
        """Time after which points begin again, if they do."""
        self._text, self._points = "", []
        if isinstance(course, str):
            if period is not None:
                raise refuse("period", "a function repeats itself; only points have a period")
            self._text = check.function(course, "course")
            if not native.is_uniform(course):
                raise refuse(
                    "course",
                    f"a function of `t` alone is needed, but `{course}` depends on `x`, `y` or `z`;"
                    " state it as the value of the condition",
                )
        else:
            self._points = check.points(course, "course", "points (time, value)")

    def __repr__(self) -> str:
        of = repr(self._text) if self._text else f"{len(self._points)} points"
        period = "" if self.period is None else f", period={self.period}"
        return f"<course of {of}{period}, time={self.time!r}>"

    def _native(self) -> tuple[str, Optional[float], list[tuple[float, float]], str]:
        return self.time, self.period, self._points, self._text
