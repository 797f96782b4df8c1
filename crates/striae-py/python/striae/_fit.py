"""Friction laws from measured friction."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Any, Literal, NamedTuple, Optional, Union

import numpy as np
import numpy.typing as npt

from . import _check as check
from . import _striae as native
from ._check import Floats
from ._described import described
from ._errors import refuse
from ._friction import Friction
from ._laws import FITTED, Tabulated
from ._mesh import frozen

if TYPE_CHECKING:
    from matplotlib.axes import Axes

@described
class Measurements(NamedTuple):
    """Measured friction, as :func:`fit_friction` takes it."""

    angles: Floats
    """Directions of slip, of shape (n,) (degrees)."""
    forces: Floats
    """Tangential over normal force: the part against slip, of shape (n,), or where directions
    of the force were measured components, of shape (n, 2) (no unit)."""
    theta: Floats
    """Angles between the textures of two surfaces, of shape (n,) (degrees)."""
    spread: Floats
    """Standard deviations in proportion to each other, of shape (n,) (no unit)."""
    specimen: Optional[list[str]] = None
    """Names of the specimens, one a reading; ``None`` where the file has none."""


def read_measurements(
    path: Union[str, os.PathLike[str]],
    *,
    columns: Optional[Mapping[str, Union[str, int]]] = None,
    angle_from: Literal["across", "along"] = "across",
    skip_lines: int = 0,
) -> Measurements:
    """Reads a file of measurements, as ``striae fit`` takes it.

    One reading a line, fields separated by commas, semicolons, tabs or blanks (beside all but
    commas a comma may be the decimal sign), under a line with the names of columns, which may have
    capitals, and units in brackets behind:
    ``angle`` (degrees), ``friction`` (no unit) or ``tangential`` and ``normal`` (force), and where
    they are known ``direction`` and ``theta`` (degrees), ``spread`` (no unit) and the name of the
    ``specimen``. What follows a
    ``#`` is passed over. All faults are one :class:`ModelError` with lines and columns.

    path: the file.
    columns: quantities that the file names otherwise, with the names or numbers (from 1) of their
        columns, such as ``{"normal": "Fz [N]"}``.
    angle_from: direction of slip at the angle 0: across the grooves (against a nap), or along them.
    skip_lines: lines at the beginning of the file to pass over.
    """
    along = check.word(angle_from, ("across", "along"), "angle_from") == "along"
    named = [(quantity, str(column)) for quantity, column in check.named(columns, "columns")]
    skipped = check.whole(skip_lines, "skip_lines", 0)
    file = check.file(path, "path")
    try:
        with open(file, encoding="utf-8") as opened:
            text = opened.read()
    except (OSError, UnicodeDecodeError) as error:
        raise refuse(file, f"it cannot be read: {error}") from None
    slip, theta, against, across, spread, names = native.measurements_of(
        text, file, named, along, skipped
    )
    forces = against
    if across is not None:
        cosine, sine = np.cos(slip), np.sin(slip)
        forces = np.column_stack(
            [against * cosine - across * sine, against * sine + across * cosine]
        )
    return Measurements(np.degrees(slip), forces, np.degrees(theta), spread, names or None)


class FrictionFit:
    """A friction law with constants that were fitted to measurements."""

    def __init__(
        self,
        friction: Friction,
        found: tuple[list[tuple[str, float, Optional[tuple[float, float]]]], Optional[float], int],
        at_bound: bool,
        level: float,
        measured: tuple[Floats, Floats, Floats, Optional[Floats]],
        specimens: dict[Any, float],
    ) -> None:
        """Fits are made by :func:`fit_friction`."""
        self._specimens = specimens
        constants, self._deviation, self._freedom = found
        self._friction, self._at_bound, self._level = friction, at_bound, level
        self._constants = {name: value for name, value, _ in constants}
        self._intervals = {name: ends for name, _, ends in constants}
        self._measured = measured

    @property
    def friction(self) -> Friction:
        """The law, for :class:`Pair`."""
        return self._friction

    @property
    def constants(self) -> dict[str, float]:
        """Constants by the name they have as arguments of the law, such as ``mu_forward``; of a
        table ``mu at 30 degrees`` (no unit)."""
        return dict(self._constants)

    @property
    def intervals(self) -> dict[str, Optional[tuple[float, float]]]:
        """Intervals in which the constants lie with the probability :attr:`level` (no unit).

        ``None`` where nothing is left to tell errors by, or where :attr:`at_bound`; infinite
        ends where the measurements do not bound a constant.
        """
        return dict(self._intervals)

    @property
    def level(self) -> float:
        """Probability with which each constant lies in its interval (no unit)."""
        return self._level

    @property
    def deviation(self) -> Optional[float]:
        """Standard deviation of a reading of spread 1 from the law (no unit)."""
        return self._deviation

    @property
    def degrees_of_freedom(self) -> int:
        """Measured numbers less constants."""
        return self._freedom

    @property
    def at_bound(self) -> bool:
        """True if the law closest to the measurements would create energy; this one is the
        closest one that does not."""
        return self._at_bound

    @property
    def specimens(self) -> dict[Any, float]:
        """Factors by which the friction of each specimen is that of the law, by the names of the
        specimens; empty where there is one (no unit)."""
        return dict(self._specimens)

    def plot(self, axes: Optional[Axes] = None) -> Axes:
        """Draws friction against slip over the direction of slip, measured and by the law.

        axes: where it is drawn; on a new figure by default.
        """
        from ._plot import draw_fit

        slip, theta, against, _ = self._measured
        return draw_fit(self._friction, (slip, theta, against), axes)

    def __repr__(self) -> str:
        return f"<fit of {self._friction!r} to {len(self._measured[0])} readings>"


def fit_friction(
    angles: Union[Sequence[float], Floats],
    forces: Union[Sequence[float], Sequence[Sequence[float]], Floats],
    law: type[Friction] = Tabulated,
    *,
    theta: Union[float, Sequence[float], Floats] = 0.0,
    spread: Union[float, Sequence[float], Floats] = 1.0,
    specimen: Union[Sequence[Any], npt.NDArray[Any], None] = None,
    level: float = 0.95,
    **words: str,
) -> FrictionFit:
    """Finds the constants of a friction law from measurements, by least squares.

    The law that is found dissipates in all directions of slip. Readings are taken as
    independent and normally distributed; of several specimens only the specimens are, and the
    scatter between them gives the intervals.

    angles: direction in which the textured surface slips at each reading, from its texture
        ``a`` (across the grooves, against a nap), counter-clockwise as seen from outside it;
        of two textured surfaces from the bisector of both textures (degrees).
    forces: tangential over normal force at each reading: of shape (n,) the part against slip,
        of shape (n, 2) the components of ``-tau/p``, the force that drags the textured
        surface, along ``a`` and a quarter turn from it, as in :class:`SlipSurface` (no unit).
    law: the class of the law, such as :class:`Nap`.
    theta: angle between the textures of two surfaces at each reading (degrees).
    spread: standard deviation of each reading in proportion to that of others (no unit).
    specimen: name or number of the specimen of each reading, of shape (n,).
    level: probability with which each constant lies in its interval (no unit).
    words: those of the law, by their names, such as ``slip_rule="associated"`` of
        :class:`Orthotropic`.
    """
    if not isinstance(law, type) or law not in FITTED:
        known = ", ".join(one.__name__ for one in FITTED)
        raise TypeError(f"law: one of the classes {known} is needed, not {law!r}")
    slip = np.radians(_column(angles, None, "angles"))
    against, across = _forces(forces, slip)
    textures = np.radians(_column(theta, len(slip), "theta"))
    spreads = _column(spread, len(slip), "spread")
    names, numbers = _numbered(specimen, len(slip))
    measured = (slip, textures, against, across, spreads, numbers)
    probability = check.number(level, "level")
    found, constants, deviation, freedom, at_bound, factors = native.fit_friction(
        FITTED[law], list(words.items()), measured, probability
    )
    stated = found.statement()
    assert stated is not None, "the law is a declared one"
    maker: Callable[..., Friction] = law
    friction = maker(**dict(stated[1]))
    kept = (frozen(slip), frozen(textures), frozen(against), across)
    summary = (constants, deviation, freedom)
    specimens = {names[number]: factor for number, factor in factors}
    return FrictionFit(friction, summary, at_bound, probability, kept, specimens)


def _numbered(
    specimen: Union[Sequence[Any], npt.NDArray[Any], None], count: int
) -> tuple[list[Any], list[int]]:
    """Names of the specimens, and the number of that of each reading."""
    if specimen is None:
        return [], [0] * count
    check.several(specimen, "specimen", "a list of names")
    each = list(specimen)
    if len(each) != count:
        raise refuse("specimen", f"names: {len(each)}, but angles: {count}; each needs one")
    names = list(dict.fromkeys(each))
    numbers = {name: number for number, name in enumerate(names)}
    return names, [numbers[name] for name in each]


def _column(value: Any, count: Optional[int], path: str) -> Floats:
    """An array of so many numbers, which may be stated by one number."""
    found = check.array(value, path)
    if found.ndim == 0 and count is not None:
        found = np.full(count, found)
    if found.ndim != 1:
        raise refuse(path, f"an array of one dimension is needed, not of {found.ndim}")
    if count is not None and len(found) != count:
        raise refuse(path, f"numbers: {len(found)}, but angles: {count}; each needs one")
    return check.finite(found, path)


def _forces(forces: Any, slip: Floats) -> tuple[Floats, Optional[Floats]]:
    """Friction against and across slip."""
    found = check.array(forces, "forces")
    if found.ndim != 2:
        return _column(forces, len(slip), "forces"), None
    if found.shape != (len(slip), 2):
        needed = f"({len(slip)},) or ({len(slip)}, 2)"
        raise refuse("forces", f"shape {needed} is needed, but it has shape {found.shape}")
    vectors = check.finite(found, "forces")
    cosine, sine = np.cos(slip), np.sin(slip)
    against = vectors[:, 0] * cosine + vectors[:, 1] * sine
    across = vectors[:, 1] * cosine - vectors[:, 0] * sine
    return np.ascontiguousarray(against), np.ascontiguousarray(across)
