"""Finished runs and their histories."""

from __future__ import annotations

import contextlib
import os
import pathlib
import tempfile
import warnings
from collections.abc import Callable, Iterator, Mapping, Sequence
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, Literal, Optional, TypeAlias, Union, overload

import numpy as np

from . import _check as check
from . import _striae as native
from ._check import Floats, Vector
from ._errors import RunInterrupted, RunStopped, RunWarning, refuse
from ._mesh import frozen
from ._results import Increment
from ._step import Step

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure
    from pandas import DataFrame
    from xarray import Dataset

    from ._model import Model

Path = Union[str, os.PathLike[str]]
Callback = Callable[[Increment], Optional[bool]]
Keep = Union[Literal["all", "steps", "last"], int]

#: Number of increments between kept states if only the last one is kept.
NEVER = 2**62
#: Largest number of threads; more only take time to start.
MOST_THREADS = 1024


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
        if not isinstance(column, str):
            raise KeyError(f"a column is chosen by its name, a string, not by {column!r}")
        if column not in self._columns:
            close = [name for name in self._columns if column in name][:8]
            hint = f"; similar are {close}" if close else ""
            if column.startswith("pair."):
                hint += "; pairs that may touch have columns once they do"
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


def _number_of(value: Any) -> float:
    """Returns what a function of an increment returned, a number."""
    try:
        return float(value + 0.0)
    except TypeError:
        raise TypeError(
            f"of: the function has to return a number, but it returned {value!r:.80}"
        ) from None


class Run(Sequence[Increment]):
    """A finished run: the sequence of its kept increments."""

    def __init__(
        self,
        run: native.Run,
        model: Model,
        folder: Optional[Path] = None,
        parameters: Mapping[str, float] = MappingProxyType({}),
    ) -> None:
        """Use :meth:`Model.run` to make a run; model: that is not changed any more; parameters:
        steps of differentiated ones."""
        self._native, self._model = run, model
        self._folder = None if folder is None else pathlib.Path(folder).absolute()
        self._parameters = dict(parameters)
        self._history = History(*run.history())
        self._increments = [Increment(results, model) for results in run.kept()]
        model._last_run = self

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

        of: a column of the history other than ``increment``, ``step``, ``time`` and counts, for
            its derivative over the increments, of shape (increments,); or a function of an
            increment that returns a number, for the derivative of that at the end of the run.
            Units: those of the result over those of the parameter.
        wrt: the parameter.
        """
        if wrt not in self._parameters:
            known = ", ".join(f"`{name}`" for name in self._parameters) or "none"
            raise KeyError(f"the run is not differentiated by `{wrt}`; parameters are: {known}")
        number = list(self._parameters).index(wrt)
        if of in ("increment", "step", "time"):
            raise KeyError(
                f"`{of}` says which increment a row is of and is not differentiated; take a "
                "function of an increment, such as `lambda end: end.time`"
            )
        if isinstance(of, str):
            derivatives = History(*self._native.derivatives(number))
            if of in self._history and of not in derivatives:
                raise KeyError(f"`{of}` is a count, which has no derivative")
            return derivatives[of]
        if not callable(of):
            raise TypeError(f"of: a column or a function of an increment is needed, not {of!r}")
        below, above = (
            _number_of(of(Increment(results, self._model)))
            for results in self._native.neighbours(number)
        )
        return (above - below) / (2.0 * self._parameters[wrt])

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

    def to_xarray(self) -> Dataset:
        """The history and the fields of kept increments as a dataset of xarray.

        Columns of the history lie over ``increment``, its time and step as ``history.time`` and
        ``history.step``. Fields lie over ``state``, the kept
        increments, whose ``time`` and ``step`` are coordinates: of bodies ``BODY.displacement``,
        ``BODY.contact_force``, ``BODY.stress`` and ``BODY.von_mises`` over ``BODY.node``, of the
        deformable sides of pairs ``PAIR.a.pressure``, ``gap``, ``friction``, ``slip`` and
        ``status`` over ``PAIR.a.node``. Needs ``striae[xarray]``.
        """
        from ._interchange import dataset

        return dataset(self)

    def write(self, folder: Path, *, case: Optional[str] = None, fields_every: int = 1) -> None:
        """Writes the files of the program (fields for ParaView, history, summary) of a run that was
        not recorded. The history is that of all increments, fields are those of kept ones.

        folder: folder to write to; it must not contain other results.
        case: name of the case in these files; the title of the model by default.
        fields_every: increments between files of fields; 0: only the last.
        """
        name = self._model.title if case is None else check.name(case, "case")
        every = check.whole(fields_every, "fields_every", 0)
        place = pathlib.Path(check.folder(folder, "folder")).absolute()
        self._native.write(str(place), name, every)
        self._folder = place

    def report(self, path: Path) -> None:
        """Writes a report that opens in any browser, without a network: deformed bodies with
        fields and a time slider, histories, increments, warnings. Of a run without a folder it
        shows kept increments.

        path: the HTML file.
        """
        with self._files() as folder:
            native.report(folder, check.file(path, "path"))

    def picture(
        self,
        path: Path,
        field: Optional[str] = None,
        *,
        component: Optional[str] = None,
        time: Optional[float] = None,
        view: Union[str, Vector] = "corner",
        range: Optional[tuple[float, float]] = None,
        magnify: float = 1.0,
        hide: Sequence[str] = (),
        width: int = 900,
    ) -> None:
        """Draws the deformed bodies, coloured by a field, as ``striae picture`` does.

        path: the PNG file.
        field: by its name in the VTU files, such as ``pressure`` or ``cauchy_stress``; the contact
            pressure by default.
        component: such as ``x``, ``magnitude``, ``von Mises``, ``largest principal``.
        time: the nearest one with fields is drawn; the last by default (time).
        view: ``corner``, ``front``, ``back``, ``left``, ``right``, ``top``, ``below``, or the
            direction of sight.
        range: least and largest value of the colours, in units of the field; those of what is
            shown by default.
        magnify: magnification of displacements (no unit).
        hide: bodies and surfaces that are left out.
        width: in pixels.
        """
        moment = check.optional(time, "time")
        pictured = drawn(field, component, moment, view, range, magnify, hide, width)
        with self._files() as folder:
            native.picture(folder, check.file(path, "path"), pictured, None)

    def animate(
        self,
        path: Path,
        field: Optional[str] = None,
        *,
        frame_time: float = 0.1,
        component: Optional[str] = None,
        view: Union[str, Vector] = "corner",
        range: Optional[tuple[float, float]] = None,
        magnify: float = 1.0,
        hide: Sequence[str] = (),
        width: int = 900,
    ) -> None:
        """Draws an animation with a frame for each time with fields: of a run with a folder those
        of its files, of another one its kept increments (``keep="all"`` keeps all). View and
        colours are the same in all frames.

        path: the file, ``.gif``, or ``.png`` for an animated PNG with all colours.
        frame_time: time of a frame, 0.01 to 60; the last one is shown for at least 1 (seconds).
        field, component, view, range, magnify, hide, width: as of :meth:`picture`.
        """
        seconds = check.positive(frame_time, "frame_time")
        if not 0.01 <= seconds <= 60.0:
            raise refuse("frame_time", f"0.01 to 60 seconds are needed, not {frame_time!r}")
        pictured = drawn(field, component, None, view, range, magnify, hide, width)
        with self._files() as folder:
            native.picture(folder, check.file(path, "path"), pictured, seconds)

    @contextlib.contextmanager
    def _files(self) -> Iterator[str]:
        """The folder of the files, or one that is written for the while."""
        if self._folder is not None and self._folder.is_dir():
            yield str(self._folder)
            return
        with tempfile.TemporaryDirectory(prefix="striae-") as place:
            folder = os.path.join(place, "results")
            self._native.write(folder, self._model.title, 1)
            yield folder

    def _repr_html_(self) -> Optional[str]:
        """The run in a notebook: a picture of the end and a table; ``None`` if that cannot be."""
        from ._notebook import shown

        try:
            return shown(self)
        except Exception:
            # A notebook shows the plain text instead.
            return None

    def __reduce__(self) -> tuple[Callable[..., Run], tuple[Any, ...]]:
        """Runs are pickled whole: the model as a deck, the history, and the states of kept
        increments, to the last bit; derivatives are left out."""
        with tempfile.TemporaryDirectory(prefix="striae-") as place:
            folder = pathlib.Path(place)
            for number in range(len(self)):
                (folder / str(number)).mkdir()
            self._native.save(place)
            files = {
                path.relative_to(folder).as_posix(): path.read_bytes()
                for path in sorted(folder.rglob("*"))
                if path.is_file()
            }
        return unpickled, (self._model, files, len(self), self.ending, self.reason, self._folder)

    def continue_with(
        self,
        *steps: Step,
        on_increment: Optional[Callback] = None,
        output: Optional[Path] = None,
        fields_every: Optional[int] = None,
        keep: Keep = "steps",
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
        recording = record(output, None, fields_every)
        found, exception = self._native.continued(native_steps, watching, recording)
        run = Run(found, type(model)._of(found.model()), output)
        return concluded((run, exception), on_stop)

    def __repr__(self) -> str:
        return f"<run: {self.reason}; {len(self)} increments are kept>"


#: A run, and the exception that it ended with.
Ended: TypeAlias = tuple[Run, Optional[BaseException]]


def unpickled(
    model: Model,
    files: dict[str, bytes],
    states: int,
    ending: str,
    reason: str,
    folder: Optional[pathlib.Path],
) -> Run:
    """The run of a pickle."""
    with tempfile.TemporaryDirectory(prefix="striae-") as place:
        for name, content in files.items():
            path = pathlib.Path(place, name)
            path.parent.mkdir(exist_ok=True)
            path.write_bytes(content)
        found = native.returned(model._compiled(), place, states, ending, reason)
    return Run(found, model, folder)


def drawn(
    field: Optional[str],
    component: Optional[str],
    time: Optional[float],
    view: Union[str, Vector],
    limits: Optional[tuple[float, float]],
    magnify: float,
    hide: Sequence[str],
    width: int,
) -> native.Pictured:
    """A picture, for the native part."""
    span = None
    if limits is not None:
        span = check.vector(limits, "range", 2)
        if not span[0] < span[1]:
            raise refuse("range", f"ascending limits are needed, not {limits!r}")
    check.several(hide, "hide", "a list of names")
    if check.whole(width, "width", 100) > 8000:
        raise refuse("width", f"it must be at most 8000, but is {width}")
    return (
        None if field is None else check.name(field, "field"),
        None if component is None else check.name(component, "component"),
        time,
        view if isinstance(view, str) else check.vector(view, "view"),
        span,
        check.number(magnify, "magnify"),
        [check.name(name, "hide") for name in hide],
        int(width),
    )


def watch(
    on_increment: Optional[Callback], keep: Keep, threads: Optional[int], model: Model
) -> tuple[Optional[Callable[[native.Results], object]], int, Optional[int]]:
    """Observation of a run and the states it keeps, for the native part."""
    if on_increment is not None and not callable(on_increment):
        raise TypeError("on_increment: a function that takes an increment is needed")
    every = keeping(keep)
    if threads is not None and check.whole(threads, "threads") > MOST_THREADS:
        raise refuse("threads", f"there may be {MOST_THREADS} at most, but {threads} are requested")
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
    named = None if case is None else check.name(case, "case")
    written(output, case=case, fields_every=fields_every)
    return None if output is None else (check.folder(output, "output"), named, fields_every)


def written(output: Optional[Path], **about: object) -> None:
    """Refuses arguments about files where none are written."""
    for path, value in about.items():
        if output is None and value is not None:
            raise refuse(path, "nothing is written without `output`; give `output` its folder")


def concluded(ended: Ended, on_stop: str) -> Run:
    """The run with its warnings, or the exception that it ended with."""
    run = closed(ended, on_stop)
    for text in run.warnings:
        warnings.warn(text, RunWarning, stacklevel=3)
    return run


def closed(ended: Ended, on_stop: str) -> Run:
    """The run, or the exception that it ended with."""
    run, exception = ended
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
    on_increment: Optional[Callback] = None,
    keep: Keep = "steps",
    threads: Optional[int] = None,
    on_stop: Literal["raise", "return"] = "raise",
) -> Run:
    """Resumes a recorded run of a deck that was interrupted; the files are identical to those of an
    uninterrupted run.

    folder: results folder of the run.
    on_increment, keep, threads, on_stop: as of :meth:`Model.run`.
    """
    from ._model import Model

    place = check.folder(folder, "folder")
    model = Model.from_deck(native.deck_of(place))
    watching = watch(on_increment, keep, threads, model)
    found, exception = native.resume(place, watching)
    return concluded((Run(found, model, place), exception), on_stop)
