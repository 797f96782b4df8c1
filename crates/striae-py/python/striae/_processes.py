"""Runs in processes of their own.

A model is passed as a deck, which preserves all of its bits, and a run is returned as files in a
temporary folder. The new process is an interpreter that imports this package and nothing of the
caller, so scripts need no guard and no lock or thread of this process is copied.
"""

from __future__ import annotations

import copy
import json
import pickle
import shutil
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path
from types import TracebackType
from typing import Any, NamedTuple, Optional

from . import _striae as native
from ._errors import ModelError, SweepError, refuse
from ._model import Model
from ._run import Run

#: Code that a process starts with.
START = (
    "import sys; sys.path[:] = sys.argv[2:];"
    "from striae._worker import main; sys.exit(main(sys.argv[1]))"
)

#: Seconds between two polls of the processes.
TICK = 0.02


class Job(NamedTuple):
    """A run in progress."""

    parameters: dict[str, Any]
    model: Model
    compiled: native.Model
    folder: Path
    output: Optional[str]
    process: subprocess.Popen[bytes]


class Workers:
    """A limited number of processes at a time; all have ended when the block ends."""

    def __init__(self, count: int) -> None:
        self._count = count
        self._place = Path(tempfile.mkdtemp(prefix="striae-"))
        self._begun = 0
        self._under_way: dict[int, Job] = {}
        self._runs: dict[int, Run] = {}

    def __enter__(self) -> Workers:
        return self

    def __exit__(
        self,
        kind: Optional[type[BaseException]],
        error: Optional[BaseException],
        trace: Optional[TracebackType],
    ) -> None:
        for job in self._under_way.values():
            job.process.terminate()
        for job in self._under_way.values():
            job.process.wait()
        shutil.rmtree(self._place, ignore_errors=True)

    def begin(
        self,
        parameters: dict[str, Any],
        model: Model,
        model_of: Callable[..., Model],
        job: dict[str, Any],
    ) -> None:
        """Starts a run as soon as a process slot is free."""
        number, self._begun = self._begun, self._begun + 1
        folder = self._place / str(number)
        folder.mkdir()
        (folder / "job.json").write_text(json.dumps(job), encoding="utf-8")
        try:
            compiled = model._compiled()
            if compiled.calls_python:
                (folder / "call.pickle").write_bytes(_call(model_of, parameters))
            else:
                (folder / "deck.toml").write_text(compiled.to_deck(), encoding="utf-8")
        except ModelError as error:
            raise SweepError(parameters, str(error)) from error
        while len(self._under_way) >= self._count:
            self._look()
        process = _started(folder)
        output = job["output"]
        self._under_way[number] = Job(
            parameters, copy.copy(model), compiled, folder, output, process
        )

    def runs(self) -> list[Run]:
        """The runs in the order in which they were started, once all have ended."""
        while self._under_way:
            self._look()
        return [self._runs[number] for number in range(self._begun)]

    def _look(self) -> None:
        """Collects the results of processes that have ended, or waits a little."""
        ended = [n for n, job in self._under_way.items() if job.process.poll() is not None]
        if not ended:
            time.sleep(TICK)
        for number in ended:
            job = self._under_way.pop(number)
            self._runs[number] = _returned(job)
            shutil.rmtree(job.folder, ignore_errors=True)


def _call(model_of: Callable[..., Model], parameters: dict[str, Any]) -> bytes:
    """The function that makes the model, by its name in its module."""
    try:
        if getattr(model_of, "__module__", None) == "__main__":
            raise pickle.PicklingError("it stands in the script or notebook itself")
        return pickle.dumps((model_of, parameters))
    except Exception as error:
        raise refuse(
            "model_of",
            "its models call functions of Python during the run, so the processes must import it"
            f" from a module, or `workers=1` runs them in this one ({error})",
        ) from error


def _started(folder: Path) -> subprocess.Popen[bytes]:
    """The process, with the module path of this one."""
    command = [sys.executable, "-c", START, str(folder), *sys.path]
    with open(folder / "stderr", "wb") as errors:
        return subprocess.Popen(
            command,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL,
            stderr=errors,
        )


def _returned(job: Job) -> Run:
    """The run, or the exception that it ended with."""
    ended = job.folder / "ended.json"
    if ended.exists():
        told = json.loads(ended.read_text(encoding="utf-8"))
        run = native.returned(
            job.compiled, str(job.folder), told["states"], told["ending"], told["reason"]
        )
        return Run(run, job.model, job.output)
    raised = job.folder / "error.pickle"
    if raised.exists():
        error: Exception = pickle.loads(raised.read_bytes())
        raise SweepError(job.parameters, str(error)) from error
    errors = (job.folder / "stderr").read_text(encoding="utf-8", errors="replace").strip()
    last = errors.splitlines()[-1] if errors else "it says nothing"
    code = job.process.returncode
    raise SweepError(job.parameters, f"the process of the run ended with code {code}: {last}")
