"""Parameter studies."""

from __future__ import annotations

import itertools
import os
import warnings
from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple, Optional, Union, overload

import numpy as np

from . import _check as check
from ._check import Floats
from ._described import described
from ._errors import RunWarning, SweepError, refuse
from ._model import Model
from ._processes import Workers
from ._run import Keep, Run, keeping, written

if TYPE_CHECKING:
    from pandas import DataFrame


@described
class SweepPoint(NamedTuple):
    """One combination of parameters and its run."""

    parameters: dict[str, Any]
    """The parameters by name, in their units."""
    run: Run
    """Its run; see :attr:`Run.ending` for whether it was completed."""


class Sweep(Sequence[SweepPoint]):
    """Runs of a model over combinations of parameters."""

    def __init__(self, points: list[SweepPoint]) -> None:
        """Use :func:`sweep` to make a sweep."""
        self._points = points

    @overload
    def __getitem__(self, index: int) -> SweepPoint: ...
    @overload
    def __getitem__(self, index: slice) -> list[SweepPoint]: ...
    def __getitem__(self, index: Union[int, slice]) -> Union[SweepPoint, list[SweepPoint]]:
        """A combination and its run; index: from 0, the last parameter running fastest."""
        return self._points[index]

    def __len__(self) -> int:
        return len(self._points)

    def __iter__(self) -> Iterator[SweepPoint]:
        return iter(self._points)

    def values(self, measure: Callable[[Run], float]) -> Floats:
        """A number for each run, of shape (runs,), in the unit of the measure.

        measure: a function that takes a run.
        """
        return np.array([measure(point.run) for point in self._points], dtype=np.float64)

    def to_pandas(self, **measures: Callable[[Run], float]) -> DataFrame:
        """Parameters, endings and measures of all runs as a data frame of pandas.

        measures: functions that take a run, by the name of their column.
        """
        import pandas

        taken = {"ending"}.union(*(point.parameters for point in self._points))
        for name in measures:
            if name in taken:
                raise refuse(name, "there is a column of that name already; give it another one")
        rows = [
            {
                **point.parameters,
                "ending": point.run.ending,
                **{name: measure(point.run) for name, measure in measures.items()},
            }
            for point in self._points
        ]
        return pandas.DataFrame(rows)

    def __repr__(self) -> str:
        return f"<sweep of {len(self)} runs>"


def sweep(
    model_of: Callable[..., Model],
    parameters: Mapping[str, Sequence[Any]],
    *,
    workers: int = 1,
    threads: Optional[int] = None,
    keep: Keep = "last",
    output: Union[str, os.PathLike[str], None] = None,
    fields_every: Optional[int] = None,
) -> Sweep:
    """Runs a model for all combinations of parameters.

    Models are made in this process, one after the other, so functions of notebooks and lambdas
    work; with several workers each run has its own process. Results do not depend on the number of
    workers. A run that cannot reach its end is among the results, with its reason; a model that
    cannot be made or run at all ends the sweep with a :class:`SweepError` that names its
    parameters. Ctrl-C ends all processes.

    model_of: a function that makes the model of a combination: ``model_of(mu=0.3)``. If its models
        call functions of Python during the run (:class:`OwnMaterial`), processes must be able to
        import it, so it must be in a module.
    parameters: values of each parameter, by name.
    workers: number of simultaneous runs; 1: in this process.
    threads: number of threads of each run; those of the machine divided among the runs by default.
    keep: increments whose states are kept, see :meth:`Model.run`.
    output: folder in which each run has one with its files, ``1``, ``2``, ...; nothing is
        written by default.
    fields_every: increments between files of fields; 0: only the last.
    """
    if not callable(model_of):
        raise TypeError("model_of: a function that makes a model is needed")
    check.whole(workers, "workers")
    check.mapping(parameters, "parameters")
    for name, values in parameters.items():
        if isinstance(values, str) or not hasattr(values, "__len__"):
            raise TypeError(f"parameter `{name}`: a list of values is needed, not {values!r}")
        if len(values) == 0:
            raise refuse(f"parameter `{name}`", "it has no values")
    if threads is not None:
        check.whole(threads, "threads")
    if fields_every is not None:
        check.whole(fields_every, "fields_every", 0)
    written(output, fields_every=fields_every)
    keeping(keep)
    place = None if output is None else Path(check.folder(output, "output")).absolute()
    all_values = itertools.product(*parameters.values())
    points = [dict(zip(parameters, values)) for values in all_values]
    shared = threads or max(1, (os.cpu_count() or 1) // workers)
    jobs = [
        {
            "threads": shared,
            "keep": keep,
            "output": None if place is None else str(place / str(number)),
            "fields_every": fields_every,
        }
        for number in range(1, len(points) + 1)
    ]
    make = _here if workers == 1 else _beside
    runs = make(model_of, points, jobs, workers)
    for point, run in zip(points, runs):
        for text in run.warnings:
            warnings.warn(f"{_told(point)}: {text}", RunWarning, stacklevel=2)
    return Sweep([SweepPoint(*one) for one in zip(points, runs)])


def _told(point: dict[str, Any]) -> str:
    return ", ".join(f"{name} = {value!r}" for name, value in point.items())


def _model(model_of: Callable[..., Model], point: dict[str, Any]) -> Model:
    try:
        return check.kind(model_of(**point), Model, "model_of")
    except Exception as error:
        raise SweepError(point, str(error)) from error


def _here(
    model_of: Callable[..., Model], points: list[dict[str, Any]], jobs: list[Any], _: int
) -> list[Run]:
    """The runs one after the other."""
    runs = []
    for point, job in zip(points, jobs):
        model = _model(model_of, point)
        try:
            runs.append(model._run(**job))
        except Exception as error:
            raise SweepError(point, str(error)) from error
    return runs


def _beside(
    model_of: Callable[..., Model], points: list[dict[str, Any]], jobs: list[Any], workers: int
) -> list[Run]:
    """The runs in parallel, in processes."""
    with Workers(workers) as processes:
        for point, job in zip(points, jobs):
            processes.begin(point, _model(model_of, point), model_of, job)
        return processes.runs()
