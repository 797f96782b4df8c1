"""Objects that are known by the arguments they were made from."""

from __future__ import annotations

import functools
import inspect
from collections.abc import Callable, Mapping
from typing import Any, Optional, TypeAlias

import numpy as np

#: Callable that makes an object, with its arguments.
Recipe: TypeAlias = tuple[Callable[..., Any], tuple[Any, ...], dict[str, Any]]


class Strict:
    """Base of classes that name their arguments, and counterparts of keys of decks, when refusing.

    Their objects do not change from outside once they are made.
    """

    _is_finished = False

    def __init_subclass__(cls) -> None:
        super().__init_subclass__()
        if "__init__" in vars(cls):
            setattr(cls, "__init__", _finishing(vars(cls)["__init__"]))

    def __new__(cls, *arguments: Any, **named: Any) -> Any:
        unknown(cls, named)
        return super().__new__(cls)

    def __setattr__(self, attribute: str, value: Any) -> None:
        # What a model was built from has been copied: an assignment would have no effect on it.
        if self._is_finished and not attribute.startswith("_"):
            kind = type(self).__name__
            raise TypeError(
                f"{attribute} of a {kind} cannot be assigned: a {kind} does not change once it is"
                " made; make another one with other arguments"
            )
        super().__setattr__(attribute, value)

    def _replace(self, attribute: str, value: Any) -> None:
        object.__setattr__(self, attribute, value)


def _finishing(initialise: Callable[..., None]) -> Callable[..., None]:
    """The initialiser of a class, after which its objects are finished, but not those of others."""

    @functools.wraps(initialise)
    def finishing(self: Strict, *arguments: Any, **named: Any) -> None:
        initialise(self, *arguments, **named)
        if getattr(type(self), "__init__") is finishing:
            self._is_finished = True

    return finishing


class Made(Strict):
    """Base of objects that are copied and pickled by their constructor arguments."""

    #: ``None`` if the object was not made by its class.
    _recipe: Optional[Recipe]

    def __new__(cls, *arguments: Any, **named: Any) -> Any:
        made = super().__new__(cls, *arguments, **named)
        made._recipe = (cls, arguments, named)
        return made

    def __reduce__(self) -> tuple[Callable[..., Any], tuple[Any, ...]]:
        if self._recipe is None:
            raise TypeError(f"{self!r} cannot be pickled: it was not made by its class")
        return again, self._recipe


def are_alike(a: Any, b: Any) -> bool:
    """``True`` of an object and itself, and of two that are made from equal arguments."""

    def are_both(*kinds: type) -> bool:
        return isinstance(a, kinds) and isinstance(b, kinds)

    if a is b:
        return True
    if are_both(Made):
        recipes = [one._recipe for one in (a, b)]
        return None not in recipes and are_alike(*map(_arguments, recipes))
    if are_both(Mapping):
        return a.keys() == b.keys() and all(are_alike(a[key], b[key]) for key in a)
    if are_both(tuple, list):
        return len(a) == len(b) and all(are_alike(one, other) for one, other in zip(a, b))
    return np.array_equal(a, b)


def _arguments(recipe: Recipe) -> tuple[Callable[..., Any], dict[str, Any]]:
    """The callable and its arguments by their names, with those that are left out."""
    maker, arguments, named = recipe
    if isinstance(maker, type):
        # Nothing in place of the object that it makes.
        bound = inspect.signature(getattr(maker, "__init__")).bind(None, *arguments, **named)
    else:
        bound = inspect.signature(maker).bind(*arguments, **named)
    bound.apply_defaults()
    return maker, dict(bound.arguments)


#: Counterparts in Python of keys of decks.
ELSEWHERE = {
    "all": "model.contact_all(...)",
    "body": "an entry of the list bodies",
    "contact": "model.contact_all(...)",
    "facet_sets": "facet_sets of the Mesh, or body.add_set",
    "facets": "body['top']",
    "generator": "block, cylinder and others, which return a Mesh",
    "increments": "increments of a Step",
    "node_sets": "node_sets of the Mesh, or body.add_set",
    "nodes": "body['top']",
    "output": "arguments of model.run",
    "pair": "an entry of the list pairs",
    "step": "an entry of the list steps",
    "density": "density of a Body or a Section",
    "fibres": "Fibrous(ground, fibres)",
    "lambda": "youngs_modulus and poissons_ratio",
    "shear_cap": "law.with_shear_cap",
    "decay": "law.with_decay",
    "by_pressure": "law.with_power_law, with_adhesion, with_saturation or with_table_by_pressure",
    "by_slip_rate": "law.with_stribeck, with_logarithm or with_table_by_slip_rate",
    "by_accumulated_slip": "law.with_exponential or with_table_by_accumulated_slip",
    "by_state": "law.with_ageing_law or with_slip_law",
    "uniform": "Uniform(direction)",
    "circumferential": "Circumferential(axis)",
    "axial": "Axial(axis)",
    "radial": "Radial(axis)",
    "points": "Painted(places, directions)",
    "plane": "Plane(name, normal=, point=)",
    "mesh": "RigidSurface(name, surface)",
    "displacement": "body['top'].displace",
    "pressure": "body['top'].pressure",
    "traction": "body['top'].traction",
    "force": "body['top'].force",
    "velocity": "body.velocity",
    "gravity": "gravity(vector)",
    "release": "body['top'].release",
}


def unknown(cls: type, named: dict[str, Any]) -> None:
    """Refuses arguments that a class does not have, with those it has."""
    # Of the function itself, as objects are not yet there.
    parameters = inspect.signature(getattr(cls, "__init__")).parameters
    if any(one.kind is one.VAR_KEYWORD for one in parameters.values()):
        return
    for name in named:
        if name not in parameters:
            known = [f"`{one}`" for one in list(parameters)[1:]]
            listed = ", ".join(known) or "none"
            text = f"{cls.__name__}: it has no argument `{name}`; its arguments are {listed}"
            if name in ELSEWHERE:
                text = f"{text}; the key `{name}` of decks is {ELSEWHERE[name]}"
            raise TypeError(text)


def again(maker: Callable[..., Any], arguments: tuple[Any, ...], named: dict[str, Any]) -> Any:
    """The object of a recipe."""
    return maker(*arguments, **named)


def listed(given: list[tuple[str, Any]]) -> str:
    """Arguments by their names, long lists by their lengths."""
    long = 6

    def told(value: Any) -> str:
        if isinstance(value, list):
            return f"<{len(value)} numbers>" if len(value) > long else repr([plain(v) for v in value])
        return repr(plain(value))

    # Angles come back from radians with round-off.
    def plain(value: Any) -> Any:
        return float(f"{value:.14g}") if isinstance(value, float) else value

    return ", ".join(f"{name}={told(value)}" for name, value in given)
