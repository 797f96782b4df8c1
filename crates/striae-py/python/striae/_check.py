"""Conversion of Python arguments to the numbers and arrays that the native part takes."""

from __future__ import annotations

import math
import os
import unicodedata
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any, Literal, Optional, Protocol, TypeAlias, TypeVar, Union

import numpy as np
import numpy.typing as npt

from . import _striae as native
from ._errors import refuse


class CourseLike(Protocol):
    """A :class:`Course`, which this module cannot import."""

    def _native(self) -> tuple[str, Optional[float], list[tuple[float, float]], str]: ...


Floats: TypeAlias = npt.NDArray[np.float64]
Ints: TypeAlias = npt.NDArray[np.int64]
Vector: TypeAlias = Union[Sequence[float], Floats]
Curve: TypeAlias = Union[
    Literal["ramp", "constant", "smooth"],
    Sequence[tuple[float, float]],
    Callable[[float], float],
    CourseLike,
]
Motion: TypeAlias = Union[float, str, Callable[[float], float]]
Varying: TypeAlias = Union[float, str]
VaryingVector: TypeAlias = Union[Vector, Sequence[Varying]]
Along: TypeAlias = Union[
    str,
    list[tuple[float, float]],
    tuple[str, Optional[float], list[tuple[float, float]], str],
]
Members: TypeAlias = Union[npt.ArrayLike, Callable[[Floats], npt.ArrayLike]]

#: Values of a table by the keys of decks.
Table: TypeAlias = dict[str, Any]

Values: TypeAlias = dict[
    str,
    Union[
        float,
        list[float],
        list[int],
        str,
        tuple[float, ...],
        list[tuple[float, ...]],
        Table,
        None,
    ],
]

CURVES = ("ramp", "constant", "smooth")

#: Straight pieces by which a curve given as a function is approximated.
PIECES = 1000

#: Deviation from a rotation that is round-off.
TURNED = 1e-9

#: Sine of the angle between two directions up to which they count as parallel.
PARALLEL = 1e-8

T = TypeVar("T")


def array(value: Any, path: str) -> npt.NDArray[Any]:
    """The value as an array of numbers."""
    try:
        found = np.asarray(value)
    except ValueError:
        raise refuse(path, "the rows must all have the same length") from None
    if found.dtype.kind not in "iuf":
        raise refuse(path, f"numbers are needed, but the array has dtype {found.dtype}")
    return found


def finite(found: npt.NDArray[Any], path: str) -> Floats:
    """Floats in C order, all of them finite."""
    floats = np.ascontiguousarray(found, dtype=np.float64)
    bad = ~np.isfinite(floats)
    if bad.any():
        row = int(np.argwhere(bad)[0][0])
        raise refuse(path, f"row {row} is not finite: {floats[row].tolist()}")
    return floats


def rows(value: Any, path: str) -> Floats:
    """An array of shape (n, 3)."""
    found = array(value, path)
    if found.ndim != 2 or found.shape[1] != 3:
        raise refuse(path, f"an array of shape (n, 3) is needed, but it has shape {found.shape}")
    return finite(found, path)


def tensor(value: Any, path: str) -> Floats:
    """An array of shape (3, 3)."""
    found = array(value, path)
    if found.shape != (3, 3):
        raise refuse(path, f"an array of shape (3, 3) is needed, but it has shape {found.shape}")
    return finite(found, path)


def indices(value: Any, columns: int, path: str) -> Ints:
    """An array of integers of shape (n, columns)."""
    found = integers(value, path)
    if found.ndim != 2 or found.shape[1] != columns:
        raise refuse(
            path, f"an array of shape (n, {columns}) is needed, but it has shape {found.shape}"
        )
    return found


def facets(cells: Mapping[str, Any], path: str) -> Ints:
    """Corners of triangles and quadrilaterals, of shape (n, 4)."""
    found = []
    for kind, columns in [("triangle", 3), ("quad", 4)]:
        if kind in cells:
            corners = indices(cells[kind], columns, kind)
            # A triangle repeats its last corner.
            found.append(corners if columns == 4 else corners[:, [0, 1, 2, 2]])
    other = [kind for kind in cells if kind not in ("triangle", "quad")]
    if other or not found:
        raise refuse(path, f"`triangle` and `quad` are supported, but there is {list(cells)}")
    return np.ascontiguousarray(np.concatenate(found))


def integers(value: Any, path: str) -> Ints:
    """Integers that are not negative, in C order."""
    found = array(value, path)
    if found.size == 0:
        found = found.astype(np.int64)
    if found.dtype.kind not in "iu":
        raise refuse(path, f"integers are needed, but the array has dtype {found.dtype}")
    if found.size and int(found.min()) < 0:
        raise refuse(path, f"numbers count from 0, but there is {int(found.min())}")
    return np.ascontiguousarray(found, dtype=np.int64)


def vector(value: Any, path: str, count: int = 3) -> list[float]:
    """``count`` finite numbers."""
    found = array(value, path)
    if found.shape != (count,):
        raise refuse(path, f"{count} numbers are needed, but it has shape {found.shape}")
    if not np.isfinite(found).all():
        raise refuse(path, f"numbers must be finite, but they are {found.tolist()}")
    return [float(number) for number in found]


def direction(value: Any, path: str) -> list[float]:
    """Three finite numbers that are not all zero."""
    found = vector(value, path)
    if not any(found):
        raise refuse(path, "a direction must not be the zero vector")
    return found


def spanning(value: Any, path: str) -> list[list[float]]:
    """Two directions that are not parallel."""
    several(value, path, "a list of two vectors")
    if len(value) != 2:
        raise refuse(path, f"two vectors are needed, but there are {len(value)}")
    found = [direction(one, path) for one in value]
    first, second = (np.array(one) / math.hypot(*one) for one in found)
    if math.hypot(*np.cross(first, second)) <= PARALLEL:
        raise refuse(path, f"two vectors that span a plane are needed, but {found} are parallel")
    return found


def columns(**given: Any) -> list[tuple[float, ...]]:
    """Rows of arrays of shape (n, 3) that are side by side."""
    arrays = {path: rows(value, path) for path, value in given.items()}
    first, *others = arrays
    for path in others:
        if len(arrays[path]) != len(arrays[first]):
            told = f"there are {len(arrays[path])} for {len(arrays[first])} {first}"
            raise refuse(path, told)
    return [tuple(row) for row in np.hstack(list(arrays.values())).tolist()]


def counts(value: Any, path: str, count: int = 3) -> list[int]:
    """``count`` integers of at least 1."""
    found = integers(value, path)
    if found.shape != (count,):
        raise refuse(path, f"{count} integers are needed, but it has shape {found.shape}")
    if int(found.min()) < 1:
        raise refuse(path, f"at least 1 is needed, but there is {int(found.min())}")
    return [int(number) for number in found]


def boolean(value: Any, path: str) -> bool:
    """``True`` or ``False``."""
    if not isinstance(value, (bool, np.bool_)):
        raise refuse(path, f"True or False is needed, not {value!r}")
    return bool(value)


def booleans(value: Any, path: str) -> list[bool]:
    """Booleans of an array of shape (n, 3), row by row."""
    found = np.asarray(value)
    if found.dtype != np.bool_ or found.ndim != 2 or found.shape[1] != 3:
        raise refuse(
            path,
            "an array of booleans of shape (n, 3) is needed,"
            f" but it has dtype {found.dtype} and shape {found.shape}",
        )
    listed: list[bool] = found.ravel().tolist()
    return listed


def rigid_motion(value: Any, path: str) -> tuple[list[list[float]], list[float]]:
    """Rotation, by rows, and shift."""
    found = array(value, path)
    if found.shape == (3,):
        return np.eye(3).tolist(), vector(found, path)
    if found.shape != (4, 4):
        raise refuse(path, f"an array of shape (3,) or (4, 4) is needed, but it has {found.shape}")
    motion = finite(found, path)
    turn = motion[:3, :3]
    is_turn = np.abs(turn.T @ turn - np.eye(3)).max() <= TURNED and np.linalg.det(turn) > 0.0
    if not is_turn or not np.array_equal(motion[3], [0.0, 0.0, 0.0, 1.0]):
        raise refuse(path, "it is no rigid motion: rows are those of [[R, s], [0, 1]], R a rotation")
    return turn.tolist(), motion[:3, 3].tolist()


def number(value: Any, path: str) -> float:
    """A finite number."""
    if isinstance(value, np.ndarray) and value.ndim == 0:
        value = value[()]
    if isinstance(value, bool) or not isinstance(value, (int, float, np.integer, np.floating)):
        raise refuse(path, f"a number is needed, not {value!r}")
    if not np.isfinite(value):
        raise refuse(path, f"a finite number is needed, not {value!r}")
    return reachable(float(value), path, is_positive=False)


def reachable(value: float, path: str, is_positive: bool) -> float:
    """A number of a magnitude that can be computed with."""
    reason = native.beyond(value, is_positive)
    if reason is not None:
        raise refuse(path, reason)
    return value


def optional(value: Any, path: str) -> Optional[float]:
    """A finite number, or nothing."""
    return None if value is None else number(value, path)


def numbers(value: Any, path: str) -> list[float]:
    """A list of numbers."""
    found = array(value, path)
    if found.ndim != 1:
        raise refuse(path, f"an array of one dimension is needed, not of {found.ndim}")
    listed: list[float] = found.astype(np.float64).tolist()
    return listed


def several(value: Any, path: str, needed: str) -> None:
    """Refuses an object without members, and a text."""
    if isinstance(value, (str, bytes)) or not np.iterable(value):
        raise TypeError(f"{path}: {needed} is needed, not {value!r}")


def mapping(value: Any, path: str) -> None:
    """Refuses an object that is no mapping."""
    if not isinstance(value, Mapping):
        raise TypeError(f"{path}: a mapping is needed, not {type(value).__name__}")


def named(value: Optional[Mapping[str, T]], path: str) -> list[tuple[str, T]]:
    """Returns the items of a mapping by their names, none for `None`."""
    if value is None:
        return []
    mapping(value, path)
    return [(name(key, path), one) for key, one in value.items()]


def table(value: Any, path: str) -> Table:
    """Numbers, lists of them and further tables by their keys."""
    mapping(value, path)
    found: Table = {}
    for key, one in value.items():
        place = f"{path}.{name(key, path)}"
        if isinstance(one, Mapping):
            found[key] = table(one, place)
        else:
            found[key] = number(one, place) if np.ndim(one) == 0 else numbers(one, place)
    return found


def row(value: Any, path: str, count: int) -> tuple[float, ...]:
    """``count`` finite numbers that belong together."""
    return tuple(vector(value, path, count))


def rows_of(values: Any, path: str, count: int) -> list[tuple[float, ...]]:
    """A list of rows of ``count`` finite numbers."""
    if isinstance(values, (str, bytes)) or not isinstance(values, Iterable):
        raise TypeError(f"{path}: a list is needed, not {type(values).__name__}")
    return [row(one, path, count) for one in values]


def positive(value: Any, path: str) -> float:
    """A positive number."""
    found = number(value, path)
    if not found > 0.0:
        raise refuse(path, f"it must be positive, but is {found}")
    return reachable(found, path, is_positive=True)


def fraction(value: Any, path: str) -> float:
    """A number above 0 and at most 1."""
    found = positive(value, path)
    if found > 1.0:
        raise refuse(path, f"it must be at most 1, but is {found}")
    return found


def whole(value: Any, path: str, least: int = 1) -> int:
    """An integer of at least `least`."""
    if isinstance(value, bool) or not isinstance(value, (int, np.integer)):
        raise refuse(path, f"an integer is needed, not {value!r}")
    if value < least:
        raise refuse(path, f"it must be at least {least}, but is {value}")
    return int(value)


def word(value: Any, known: Sequence[str], path: str) -> str:
    """One of a few words."""
    if value not in known:
        listed = ", ".join(f"`{one}`" for one in known)
        raise refuse(path, f"one of {listed} is needed, not {value!r}")
    return str(value)


def name(value: Any, path: str) -> str:
    """A name of one line that is not empty."""
    if not isinstance(value, str):
        raise TypeError(f"{path}: a name is needed, not {value!r}")
    if not value:
        raise refuse(path, "a name must not be empty")
    if any(unicodedata.category(letter) == "Cc" for letter in value):
        raise refuse(path, f"a name must be one line of printable characters, not {value!r}")
    return value


def file(value: Any, path: str) -> str:
    """Path of a file or folder."""
    if not isinstance(value, (str, os.PathLike)):
        raise TypeError(f"{path}: a path is needed, not {value!r}")
    return str(os.fspath(value))


def folder(value: Any, path: str) -> str:
    """Path of a folder."""
    found = file(value, path)
    if not found:
        raise refuse(path, "a path must not be empty; `.` is the present folder")
    return found


def kind(value: Any, class_: type[T], path: str) -> T:
    """An object of a class."""
    if not isinstance(value, class_):
        raise TypeError(
            f"{path}: an object of class {class_.__name__} is needed, not {type(value).__name__}"
        )
    return value


def kinds(values: Any, class_: type[T], path: str) -> list[T]:
    """Objects of a class."""
    if not isinstance(values, (list, tuple)):
        raise TypeError(f"{path}: a list is needed, not {type(values).__name__}")
    return [kind(one, class_, path) for one in values]


def sampled(function: Callable[[float], Any], path: str) -> list[tuple[float, float]]:
    """Fractions of a step and the values of a function there."""
    fractions = [at / PIECES for at in range(PIECES + 1)]
    return [(at, number(function(at), f"{path} at {at}")) for at in fractions]


def motion(
    function: Callable[[float], Any], path: str
) -> tuple[list[float], list[tuple[float, float]]]:
    """A function of the fraction of a step: its first value and its largest change from there,
    and the shares of that change."""
    points = sampled(function, path)
    start = points[0][1]
    change = max((value - start for _, value in points), key=abs)
    shares = [(at, (value - start) / change if change else 0.0) for at, value in points]
    return [start, change], shares


def curve(value: Any, path: str) -> Along:
    """The name of a curve, or what it is made of; points of a function are taken once, here."""
    from ._course import Course

    if isinstance(value, Course):
        return value._native()
    if isinstance(value, str):
        return word(value, CURVES, path)
    if callable(value):
        return sampled(value, path)
    return points(
        value, path, "the name of a curve or points (fraction of the step, share of the change)"
    )


def curve_of(value: Any, path: str, *targets: Any) -> Along:
    """The curve along which targets are approached; those that change with time are followed."""
    if value is not None:
        return curve(value, path)
    moves = any(isinstance(target, str) and native.moves(target) for target in targets)
    return "constant" if moves else "ramp"


def points(value: Any, path: str, needed: str) -> list[tuple[float, float]]:
    """Points of a curve."""
    found = array(value, path)
    if found.ndim != 2 or found.shape[1] != 2:
        raise refuse(path, f"{needed} are needed, but it has shape {found.shape}")
    return [(float(s), float(c)) for s, c in finite(found, path)]


def function(value: str, path: str) -> str:
    """A text that is a function of ``x``, ``y``, ``z`` and ``t``."""
    native.check_function(value, path)
    return value


def varying(value: Any, path: str) -> Varying:
    """A number, or a function of position and time."""
    return function(value, path) if isinstance(value, str) else number(value, path)


def varying_vector(value: Any, path: str) -> list[Varying]:
    """Three numbers, or functions of position and time."""
    several(value, path, "a list of three components")
    if not any(isinstance(component, str) for component in value):
        return list(vector(value, path))
    if len(value) != 3:
        raise refuse(path, f"three components are needed, but there are {len(value)}")
    return [varying(component, path) for component in value]
