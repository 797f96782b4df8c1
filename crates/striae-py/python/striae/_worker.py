"""Process that runs one model of a sweep.

.. code-block:: text

    FOLDER/job.json      how it is run
           deck.toml     the model, or call.pickle: the function that makes it, and its arguments
           ended.json    how it ended, beside summary.json, history.csv and states
           error.pickle  the exception instead

Keyboard interrupts are handled by the process that started the run.
"""

from __future__ import annotations

import json
import pickle
import signal
import traceback
import warnings
from pathlib import Path

from ._model import Model
from ._run import Run

DECK, CALL, JOB = "deck.toml", "call.pickle", "job.json"
ENDED, ERROR = "ended.json", "error.pickle"


def main(place: str) -> int:
    """Runs the model of a folder; returns 0 if it ran, whatever its ending."""
    folder = Path(place)
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    warnings.simplefilter("ignore")
    try:
        run = ran(folder)
        for number in range(len(run)):
            (folder / str(number)).mkdir()
        run._native.save(str(folder))
        ended = {"ending": run.ending, "reason": run.reason, "states": len(run)}
        (folder / ENDED).write_text(json.dumps(ended), encoding="utf-8")
    except Exception as error:
        (folder / ERROR).write_bytes(pickled(error))
        return 1
    return 0


def ran(folder: Path) -> Run:
    """The run of the model of the folder."""
    job = json.loads((folder / JOB).read_text(encoding="utf-8"))
    if (folder / CALL).exists():
        model_of, parameters = pickle.loads((folder / CALL).read_bytes())
        model = model_of(**parameters)
    else:
        model = Model.from_text((folder / DECK).read_text(encoding="utf-8"), folder)
    run: Run = model.run(**job, on_stop="return")
    return run


def pickled(error: Exception) -> bytes:
    """The exception, or its message if it cannot be pickled."""
    try:
        found = pickle.dumps(error)
        pickle.loads(found)
        return found
    except Exception:
        told = "".join(traceback.format_exception(type(error), error, error.__traceback__))
        return pickle.dumps(RuntimeError(told))
