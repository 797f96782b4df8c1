"""Exceptions and warnings."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any, NamedTuple

from ._described import described

if TYPE_CHECKING:
    from ._run import Run


@described
class Fault(NamedTuple):
    """One fault of a model: the part it concerns, and a message."""

    path: str
    """The part, such as ``steps[1].displacements[0]``, counted from 0."""
    message: str
    """Message: what was found and what is needed."""


class ModelError(ValueError):
    """A model, or a part of it, cannot be simulated.

    The exception lists all faults, each with the path of the part it concerns.
    """

    faults: list[Fault]
    """All faults, each a path and a message."""

    def __init__(self, faults: Iterable[tuple[str, str]]) -> None:
        """Makes the exception from faults, pairs of path and message."""
        self.faults = [Fault(path, message) for path, message in faults]
        super().__init__(self.faults)

    def __str__(self) -> str:
        lines = [f"{fault.path}: {fault.message}" for fault in self.faults]
        if len(lines) > 1:
            lines.append(f"{len(lines)} faults")
        return "\n".join(lines)


class RunStopped(RuntimeError):
    """A run ended before its last step was completed; the message says why.

    The history of all converged increments and the states that are kept are in :attr:`run`; all
    are on disk if the run was recorded.
    """

    run: Run
    """The run up to its last converged increment."""

    def __init__(self, run: Run) -> None:
        """Makes the exception from the run that was stopped."""
        super().__init__(run.reason)
        self.run = run


class RunInterrupted(KeyboardInterrupt):
    """A run was interrupted from the keyboard.

    The run ends after the current increment. The history of all converged increments and the states
    that are kept are in :attr:`run`; all are on disk if the run was recorded.
    """

    run: Run
    """The run up to its last converged increment."""

    def __init__(self, run: Run) -> None:
        """Makes the exception from the run that was interrupted."""
        super().__init__(run.reason)
        self.run = run


class SweepError(RuntimeError):
    """A model of a sweep could not be made or run; the cause, ``__cause__``, says why."""

    parameters: dict[str, Any]
    """Parameters of the failed combination, by name, in their units."""

    def __init__(self, parameters: dict[str, Any], cause: str) -> None:
        """Makes the exception from parameters and the message of a cause."""
        told = ", ".join(f"{name} = {value!r}" for name, value in parameters.items())
        super().__init__(f"with {told or 'no parameters'}: {cause}")
        self.parameters = parameters
        self._cause = cause

    def __reduce__(self) -> tuple[type[SweepError], tuple[dict[str, Any], str]]:
        return type(self), (self.parameters, self._cause)


class RunWarning(UserWarning):
    """Results of a run are doubtful; the message says why."""


def refuse(path: str, message: str) -> ModelError:
    """The exception with one fault."""
    return ModelError([(path, message)])
