"""Derivatives of runs by parameters of their models."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Literal, Optional

from . import _check as check
from . import _striae as native
from ._errors import ModelError, refuse
from ._model import Model
from ._run import Callback, Keep, Path, Run, concluded, record

#: Step of a parameter over its value, or the step where that is zero.
STEP = 1e-5


def differentiate(
    model_of: Callable[..., Model],
    parameters: Mapping[str, float],
    on_increment: Optional[Callback] = None,
    *,
    output: Optional[Path] = None,
    case: Optional[str] = None,
    fields_every: Optional[int] = None,
    keep: Keep = "steps",
    threads: Optional[int] = None,
    on_stop: Literal["raise", "return"] = "raise",
) -> Run:
    """Runs a model with derivatives of its results by parameters, see :meth:`Run.gradient`.

    A parameter is any number that the model follows from: a coefficient of friction, a modulus,
    the target of a curve, an angle of texture, a dimension of a mesh, as long as meshes keep
    their elements. Derivatives are those of the discrete equations, by one correction with the
    converged tangent in each increment, so they cost a fraction of a run each; their errors
    are about 1e-8 of the size of the result over that of the parameter. A warning names contact nodes just between stick and slip, or open
    and closed, at which derivatives are one-sided.

    model_of: a function that makes the model: ``model_of(mu=0.3)``.
    parameters: by name the values at which the run is made.
    on_increment, output, case, fields_every, keep, threads, on_stop: as of :meth:`Model.run`;
        the output has a file ``sensitivity-NAME.csv`` of each parameter.
    """
    if not callable(model_of):
        raise TypeError("model_of: a function that makes a model is needed")
    check.word(on_stop, ("raise", "return"), "on_stop")
    check.mapping(parameters, "parameters")
    if not parameters:
        raise refuse("parameters", "at least one parameter is needed")
    values = {name: check.number(value, name) for name, value in parameters.items()}
    model = check.kind(model_of(**values), Model, "model_of")
    # Faults that the model has anyway are not told as those of a value beside it.
    model._compiled()
    neighbours = []
    for name, value in values.items():
        # Such that value and step add up without round-off.
        step = (value + STEP * (abs(value) or 1.0)) - value
        below, above = (
            _neighbour(model_of, values, name, moved) for moved in (value - step, value + step)
        )
        neighbours.append((name, step, below, above))
    recording = record(output, case, fields_every)
    return concluded(model._ended(on_increment, keep, threads, recording, neighbours), on_stop)


def _neighbour(
    model_of: Callable[..., Model], values: Mapping[str, float], name: str, moved: float
) -> native.Model:
    """Returns the model with a parameter moved by its step."""
    try:
        model = check.kind(model_of(**{**values, name: moved}), Model, "model_of")
        return model._compiled()
    except ModelError as error:
        raise refuse(
            name,
            f"a derivative takes the model on both sides of {name} = {values[name]:g}, but at "
            f"{name} = {moved:.10g} there is none; differentiate away from the bound: {error}",
        ) from error
