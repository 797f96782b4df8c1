"""Finished runs and their histories."""

from __future__ import annotations

import os
import pathlib
import tempfile
import warnings
from collections.abc import Callable, Iterator, Mapping, Sequence
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, Literal, Optional, Union, overload

import numpy as np

from . import _check as check
from . import _striae as native
from ._check import Floats
from ._errors import RunInterrupted, RunStopped, RunWarning, refuse
from ._mesh import frozen
from ._results import Increment
from ._step import Step

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure
    from pandas import DataFrame

    from ._model import Model

Path = Union[str, os.PathLike[str]]
Callback = Callable[[Increment], Optional[bool]]
Keep = Union[Literal["all", "steps", "last"], int]

#: Number of increments between kept states if only the last one is kept.
NEVER = 2**62


class History(Mapping[str, Floats]):
    """Resultants, reactions, motions and energies over the increments, by column.

    Columns are named as in ``history.csv``: ``time``, ``pair.NAME.resultant_a.z``,
    ``reaction.BODY.SET.x``, ``energy.friction``, ... They are read-only views of one table.
    """

    def __init__(self, columns: list[str], rows: Floats) -> None:
        """Use ``run.history`` to get a history."""
        self._columns = {name: index for index, name in enumerate(columns)}
        self._rows = frozen(rows)

    @property
    def table(self) -> Floats:
        """All columns, of shape (increments, columns), in units of each column."""
        return self._rows

    def __getitem__(self, column: str) -> Floats:
        """A column, of shape (increments,), in its unit; column: its name."""
        if column not in self._columns:
            close = [name for name in self._columns if column in name][:8]
            hint = f"; similar are {close}" if close else ""
            raise KeyError(f"no column is named `{column}`{hint}")
        found: Floats = self._rows[:, self._columns[column]]
        return found

    def __iter__(self) -> Iterator[str]:
        return iter(self._columns)

    def __len__(self) -> int:
        return len(self._columns)

    def to_pandas(self) -> DataFrame:
        """The table as a data frame of pandas."""
        import pandas

        return pandas.DataFrame(self._rows.copy(), columns=list(self._columns))

    def plot(self, *columns: str, axes: Optional[Axes] = None) -> Axes:
        """Draws columns over time with matplotlib.

        columns: their names; the forces of all pairs by default.
        axes: where they are drawn; on a new figure by default.
        """
        from ._plot import draw_history

        return draw_history(self, columns, axes)

    def __repr__(self) -> str:
        return f"<history of {len(self._rows)} increments, {len(self)} columns>"


class Run(Sequence[Increment]):
    """A finished run: the sequence of its kept increments."""

    def __init__(
        self,
        run: native.Run,
        model: Model,
        folder: Optional[pathlib.Path] = None,
        parameters: Mapping[str, float] = MappingProxyType({}),
    ) -> None:
        """Use :meth:`Model.run` to make a run; parameters: steps of differentiated ones."""
        self._native, self._model, self._folder = run, model, folder
        self._parameters = dict(parameters)
        self._history = History(*run.history())
        self._increments = [Increment(results, model) for results in run.kept()]

    @property
    def model(self) -> Model:
        """The model that was run, with its steps."""
        return self._model

    @property
    def ending(self) -> str:
        """``completed``, ``interrupted`` or ``stopped``."""
        return self._native.ending

    @property
    def reason(self) -> str:
        """Ending of the run, in a sentence."""
        return self._native.reason

    @property
    def warnings(self) -> list[str]:
        """Warnings: reasons to doubt the results."""
        return self._native.warnings()

    @property
    def folder(self) -> Optional[pathlib.Path]:
        """Folder of the files of the run, if it was written."""
        return self._folder

    @property
    def history(self) -> History:
        """Resultants, reactions, motions and energies over the increments."""
        return self._history

    @overload
    def gradient(self, of: str, wrt: str) -> Floats: ...
    @overload
    def gradient(self, of: Callable[[Increment], float], wrt: str) -> float: ...
    def gradient(
        self, of: Union[str, Callable[[Increment], float]], wrt: str
    ) -> Union[Floats, float]:
        """Derivative of a result by a parameter of a run made by :func:`differentiate`.

        of: a column of the history, for its derivative over the increments, of shape
            (increments,); or a function of an increment that returns a number, for the
            derivative of that at the end of the run. Units: those of the result over those of
            the parameter.
        wrt: the parameter.
        """
        if wrt not in self._parameters:
            known = ", ".join(f"`{name}`" for name in self._parameters) or "none"
            raise KeyError(f"the run is not differentiated by `{wrt}`; parameters are: {known}")
        number = list(self._parameters).index(wrt)
        if isinstance(of, str):
            return History(*self._native.derivatives(number))[of]
        if not callable(of):
            raise TypeError(f"of: a column or a function of an increment is needed, not {of!r}")
        below, above = (
            of(Increment(results, self._model)) for results in self._native.neighbours(number)
        )
        return float((above - below) / (2.0 * self._parameters[wrt]))

    @property
    def unknowns(self) -> int:
        """Number of unknowns of the system."""
        return self._native.unknowns

    @property
    def seconds(self) -> float:
        """Wall-clock time (seconds)."""
        return self._native.seconds

    @property
    def cut_backs(self) -> int:
        """Number of increments that failed and were repeated with smaller ones."""
        return self._native.cut_backs

    @overload
    def __getitem__(self, index: int) -> Increment: ...
    @overload
    def __getitem__(self, index: slice) -> list[Increment]: ...
    def __getitem__(self, index: Union[int, slice]) -> Union[Increment, list[Increment]]:
        """An increment that was kept; index: from 0, or from the end."""
        return self._increments[index]

    def __len__(self) -> int:
        return len(self._increments)

    def plot(self) -> Figure:
        """Draws the run with matplotlib: forces over time, and of each pair the contact patch
        at the end and its friction law."""
        from ._plot import draw_run

        return draw_run(self)

    def to_pyvista(self) -> Any:
        """Bodies and contact surfaces at the end, see :meth:`Increment.to_pyvista`."""
        return self[-1].to_pyvista()

    def write(self, folder: Path, *, case: Optional[str] = None, fields_every: int = 1) -> None:
        """Writes the files of the program (fields for ParaView, history, summary) of a run that was
        not recorded; all its increments must be kept.

        folder: folder to write to; it must not contain other results.
        case: name of the case in these files; the title of the model by default.
        fields_every: increments between files of fields; 0: only the last.
        """
        rows = len(self._history.table)
        if len(self) != rows:
            text = f"{len(self)} of {rows} increments are kept; files need all of them"
            raise refuse("run", text + ", or `output=` when it is run")
        name = self._model.title if case is None else check.name(case, "case")
        every = check.whole(fields_every, "fields_every", 0)
        self._native.write(os.fspath(folder), name, every)
        self._folder = pathlib.Path(folder)

    def report(self, path: Path) -> None:
        """Writes a report that opens in any browser, without a network: deformed bodies with
        fields and a time slider, histories, increments, warnings.

        path: the HTML file.
        """
        if self._folder is not None:
            native.report(str(self._folder), os.fspath(path))
            return
        with tempfile.TemporaryDirectory(prefix="striae-") as place:
            folder = pathlib.Path(place) / "results"
            self.write(folder)
            self._folder = None
            native.report(str(folder), os.fspath(path))

    def continue_with(
        self,
        *steps: Step,
        on_increment: Optional[Callback] = None,
        output: Optional[Path] = None,
        fields_every: Optional[int] = None,
        keep: Keep = "all",
        threads: Optional[int] = None,
        on_stop: Literal["raise", "return"] = "raise",
    ) -> Run:
        """Continues from the end of this run, which must be completed, with further steps.

        Time and the numbers of increments continue; conditions hold until the further steps state
        them again. The history is that of the further steps.

        steps: the further steps.
        on_increment, output, fields_every, keep, threads, on_stop: as of :meth:`Model.run`.
        """
        if not steps:
            raise refuse("steps", "at least one step is needed")
        native_steps = [check.kind(step, Step, "steps")._native for step in steps]
        # For the names of parts and steps in results that are told of on the way.
        model = type(self._model)._of(self._native.model())
        model._earlier += [step.name for step in steps]
        watching = watch(on_increment, keep, threads, model)
        recording = record(output, self._model.title, fields_every)
        ended = self._native.continued(native_steps, watching, recording)
        return concluded(ended, type(model)._of(ended[0].model()), on_stop, output)

    def __repr__(self) -> str:
        return f"<run: {self.reason}; {len(self)} increments are kept>"


def watch(
    on_increment: Optional[Callback], keep: Keep, threads: Optional[int], model: Model
) -> tuple[Optional[Callable[[native.Results], object]], int, Optional[int]]:
    """Observation of a run and the states it keeps, for the native part."""
    if on_increment is not None and not callable(on_increment):
        raise TypeError("on_increment: a function that takes an increment is needed")
    every = keeping(keep)
    if threads is not None:
        check.whole(threads, "threads")
    told = on_increment
    if told is None:
        return None, every, threads
    return lambda results: told(Increment(results, model)), every, threads


def keeping(keep: Keep) -> int:
    """Increments between states that are kept; 0: the ends of steps."""
    words = {"all": 1, "steps": 0, "last": NEVER}
    if isinstance(keep, str):
        return words[check.word(keep, list(words), "keep")]
    return check.whole(keep, "keep")


def record(
    output: Optional[Path], case: Optional[str], fields_every: Optional[int]
) -> Optional[tuple[str, Optional[str], Optional[int]]]:
    """Output of a run, for the native part."""
    if fields_every is not None:
        check.whole(fields_every, "fields_every", 0)
    if output is None:
        return None
    return os.fspath(output), case, fields_every


def concluded(
    ended: tuple[native.Run, Optional[BaseException]],
    model: Model,
    on_stop: str,
    folder: Optional[Path],
    parameters: Mapping[str, float] = MappingProxyType({}),
) -> Run:
    """The run with its warnings, or the exception that it ended with."""
    run = closed(ended, model, on_stop, folder, parameters)
    for text in run.warnings:
        warnings.warn(text, RunWarning, stacklevel=3)
    return run


def closed(
    ended: tuple[native.Run, Optional[BaseException]],
    model: Model,
    on_stop: str,
    folder: Optional[Path],
    parameters: Mapping[str, float] = MappingProxyType({}),
) -> Run:
    """The run, or the exception that it ended with."""
    found, exception = ended
    place = None if folder is None else pathlib.Path(folder).absolute()
    run = Run(found, model, place, parameters)
    model._last_run = run
    if isinstance(exception, KeyboardInterrupt):
        raise RunInterrupted(run) from None
    if exception is not None:
        raise exception
    if run.ending == "stopped" and check.word(on_stop, ("raise", "return"), "on_stop") == "raise":
        raise RunStopped(run)
    return run


def resume(
    folder: Path,
    *,
    fields_every: Optional[int] = None,
    on_increment: Optional[Callback] = None,
    keep: Keep = "all",
    threads: Optional[int] = None,
    on_stop: Literal["raise", "return"] = "raise",
) -> Run:
    """Resumes a recorded run of a deck that was interrupted; the files are identical to those of an
    uninterrupted run.

    folder: results folder of the run.
    fields_every: value with which the run was started.
    on_increment, keep, threads, on_stop: as of :meth:`Model.run`.
    """
    from ._model import Model

    model = Model.from_deck(native.deck_of(os.fspath(folder)))
    watching = watch(on_increment, keep, threads, model)
    if fields_every is not None:
        check.whole(fields_every, "fields_every", 0)
    ended = native.resume(os.fspath(folder), fields_every, watching)
    return concluded(ended, model, on_stop, folder)
