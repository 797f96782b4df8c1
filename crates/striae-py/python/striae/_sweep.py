"""Parameter studies."""

from __future__ import annotations

import itertools
import os
from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from typing import TYPE_CHECKING, Any, NamedTuple, Optional, Union, overload

import numpy as np

from . import _check as check
from ._check import Floats
from ._errors import refuse
from ._model import Model
from ._run import Keep, Run

if TYPE_CHECKING:
    from pandas import DataFrame


class SweepPoint(NamedTuple):
    """One combination of parameters and its run."""

    parameters: dict[str, Any]
    """The parameters by name, in their units."""
    run: Run
    """Its run; see :attr:`Run.ending` for whether it was completed."""


class Sweep(Sequence[SweepPoint]):
    """Runs of a model over combinations of parameters."""

    def __init__(self, points: list[SweepPoint]) -> None:
        """Sweeps are made by :func:`sweep`."""
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
        """A number of each run, of shape (runs,), in the unit of the measure.

        measure: a function that takes a run.
        """
        return np.array([measure(point.run) for point in self._points], dtype=np.float64)

    def to_pandas(self, **measures: Callable[[Run], float]) -> DataFrame:
        """Parameters, endings and measures of all runs as a data frame of pandas.

        measures: by the name of their column functions that take a run.
        """
        import pandas

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
) -> Sweep:
    """Runs a model for all combinations of parameters.

    Runs go on beside each other on threads, as the interpreter is not needed while a run
    computes; functions of notebooks and lambdas will do. Results do not depend on the number
    of workers. A run that cannot reach its end is among the results, with its reason.

    model_of: a function that makes the model of a combination: ``model_of(mu=0.3)``.
    parameters: by name the values that each parameter takes.
    workers: number of runs beside each other.
    threads: number of threads of each run; those of the machine shared out by default.
    keep: increments whose states are kept, see :meth:`Model.run`.
    """
    if not callable(model_of):
        raise TypeError("model_of: a function that makes a model is needed")
    check.whole(workers, "workers")
    for name, values in parameters.items():
        if len(values) == 0:
            raise refuse(f"parameter `{name}`", "it has no values")
    shared = threads or max(1, (os.cpu_count() or 1) // workers)
    points = [
        dict(zip(parameters, values)) for values in itertools.product(*parameters.values())
    ]

    def run_of(point: dict[str, Any]) -> SweepPoint:
        model = check.kind(model_of(**point), Model, "model_of")
        return SweepPoint(point, model.run(threads=shared, keep=keep, on_stop="return"))

    with ThreadPoolExecutor(workers) as pool:
        runs = [pool.submit(run_of, point) for point in points]
        try:
            return Sweep([run.result() for run in runs])
        except BaseException:
            pool.shutdown(wait=False, cancel_futures=True)
            raise
