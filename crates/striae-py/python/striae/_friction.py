"""Friction laws.

Coefficients have no unit. The texture ``s`` of a surface runs along its grooves or along
the row of scales, ``a = n x s`` across; for scales ``a`` points from root to free edge.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Any, Literal, NamedTuple, Optional, Union

import numpy as np
import numpy.typing as npt

from . import _check as check
from . import _striae as native
from ._check import Floats
from ._errors import refuse
from ._made import Made, Recipe

if TYPE_CHECKING:
    from matplotlib.axes import Axes


class SlipSurface(NamedTuple):
    """Friction of a slipping contact, sampled over all directions, per unit of pressure.

    Directions are angles in the frame of the texture, from ``a`` (across the grooves, against a
    nap) towards ``s``'s side, counter-clockwise; for two textures from their sum.
    """

    slip_angle: Floats
    """Direction of slip (radians)."""
    friction: Floats
    """``-tau/p``, of shape (n, 2): along the axis of the frame and across it (no unit)."""
    dissipation: Floats
    """``-tau . d/p`` with the direction of slip ``d``: work per pressure and length of slip
    (no unit)."""


class Friction(Made):
    """Friction between two surfaces; see the laws."""

    _native: native.Friction
    _told: str

    def __init__(self) -> None:
        """Use one of the laws."""
        raise TypeError(
            "use Frictionless, Coulomb, Orthotropic, Nap, TwoTextures, Tabulated or OwnFriction"
        )

    @classmethod
    def _of(
        cls,
        found: native.Friction,
        told: str,
        recipe: Optional[Recipe] = None,
    ) -> Friction:
        law: Friction = cls.__new__(cls)
        law._native, law._told, law._recipe = found, told, recipe
        return law

    def with_decay(self, kinetic_over_static: float, slip_rate: float) -> Friction:
        """The law with coefficients that decay as slip becomes faster,
        ``kinetic + (static - kinetic) exp(-rate/slip_rate)``.

        kinetic_over_static: coefficients in fast slip over those at rest (no unit).
        slip_rate: rate of slip at which the difference has fallen to 1/e (length per time).
        """
        ratio = check.number(kinetic_over_static, "kinetic_over_static")
        rate = check.number(slip_rate, "slip_rate")
        told = f"{self._told}.with_decay({ratio}, {rate})"
        recipe: Recipe = (Friction.with_decay, (self, ratio, rate), {})
        return Friction._of(self._native.with_decay(ratio, rate), told, recipe)

    def with_power_law(
        self, exponent: float, pressure: float, floor: Optional[float] = None
    ) -> Friction:
        """The law with coefficients that go with a power of the pressure,
        ``mu (p/pressure)**(exponent - 1)``, in place of another dependence on it.

        exponent: below 1 for coefficients that fall; 2/3 for one elastic contact (no unit).
        pressure: at which the coefficients are those of the law (force per area).
        floor: pressure below which, for exponents below 1, friction goes to zero along a parabola
            with a finite slope (force per area); a thousandth of ``pressure`` by default.
        """
        constants = {"exponent": exponent, "pressure": pressure, "floor": floor}
        return self._with("with_power_law", constants)

    def with_adhesion(self, pressure: float, floor: Optional[float] = None) -> Friction:
        """The law with friction ``mu (p + pressure)``, to which adhesion adds (Derjaguin), in
        place of another dependence on the pressure.

        pressure: by adhesion (force per area).
        floor: pressure below which friction goes to zero along a parabola with a finite slope
            (force per area); a twentieth of ``pressure`` by default.
        """
        return self._with("with_adhesion", {"pressure": pressure, "floor": floor})

    def with_saturation(self, shear_stress: float) -> Friction:
        """The law with friction ``shear_stress tanh(mu p/shear_stress)``, which comes to a shear
        stress smoothly, in place of another dependence on the pressure.

        shear_stress: at high pressure (force per area).
        """
        return self._with("with_saturation", {"shear_stress": shear_stress})

    def with_pressure_table(
        self,
        pressures: Union[Sequence[float], Floats],
        factors: Union[Sequence[float], Floats],
    ) -> Friction:
        """The law with coefficients times a factor by the pressure, monotone and smooth between
        the points and constant beyond, in place of another dependence on the pressure.

        pressures: ascending (force per area).
        factors: at each of them (no unit).
        """
        return self._with_table("with_pressure_table", "pressures", pressures, factors)

    def with_stribeck(
        self,
        kinetic_over_static: float,
        slip_rate: float,
        exponent: float = 2.0,
        viscous: float = 0.0,
    ) -> Friction:
        """The law with coefficients along Stribeck's curve, those at rest times
        ``c + (1 - c) exp(-(v/slip_rate)**exponent) + viscous v`` with
        ``c = kinetic_over_static``, in place of another dependence on the slip rate ``v``.

        kinetic_over_static: coefficients in fast slip, without the viscous part, over those at
            rest (no unit).
        slip_rate: by which slip is fast (length per time).
        exponent: at least 1 (no unit).
        viscous: rise over the coefficients at rest (time per length).
        """
        constants = {
            "kinetic_over_static": kinetic_over_static,
            "slip_rate": slip_rate,
            "exponent": exponent,
            "viscous": viscous,
        }
        return self._with("with_stribeck", constants)

    def with_logarithm(
        self, factor: float, slip_rate: float, limit: Optional[float] = None
    ) -> Friction:
        """The law with coefficients times ``1 + factor ln(1 + v/slip_rate)``, in place of another
        dependence on the slip rate ``v``.

        factor: positive for friction that rises with the rate, negative for friction that falls
            (no unit).
        slip_rate: up to which coefficients hardly change (length per time).
        limit: slip rate from which on coefficients are constant, needed where they fall (length
            per time).
        """
        constants = {"factor": factor, "slip_rate": slip_rate, "limit": limit}
        return self._with("with_logarithm", constants)

    def with_slip_rate_table(
        self,
        slip_rates: Union[Sequence[float], Floats],
        factors: Union[Sequence[float], Floats],
    ) -> Friction:
        """The law with coefficients times a factor by the slip rate, monotone and smooth between
        the points and constant beyond, in place of another dependence on the slip rate.

        slip_rates: ascending (length per time).
        factors: at each of them (no unit).
        """
        return self._with_table("with_slip_rate_table", "slip_rates", slip_rates, factors)

    def with_running_in(self, final_over_initial: float, slip: float) -> Friction:
        """The law with coefficients that change as the surface that carries a point slips, those
        stated times ``w + (1 - w) exp(-s/slip)`` with ``w = final_over_initial`` and the slip
        ``s`` that has accumulated up to the last increment.

        final_over_initial: coefficients after long slip over those at the start (no unit).
        slip: after which the difference has fallen to 1/e (length).
        """
        constants = {"final_over_initial": final_over_initial, "slip": slip}
        return self._with("with_running_in", constants)

    def with_accumulated_slip_table(
        self,
        slips: Union[Sequence[float], Floats],
        factors: Union[Sequence[float], Floats],
    ) -> Friction:
        """The law with coefficients times a factor by the accumulated slip, monotone and smooth
        between the points and constant beyond, in place of another dependence on it.

        slips: accumulated, ascending (length).
        factors: at each of them (no unit).
        """
        return self._with_table("with_accumulated_slip_table", "slips", slips, factors)

    def bound(
        self,
        pressure: Union[float, Sequence[float], Floats],
        slip_rate: Union[float, Sequence[float], Floats] = 0.0,
        accumulated_slip: Union[float, Sequence[float], Floats] = 0.0,
    ) -> Floats:
        """Largest friction at pressures, slip rates and accumulated slips (force per area): the
        coefficient times the pressure, with all dependences and the shear cap. In laws with a
        direction it is scaled with their slip surface, see :meth:`slip_surface`.

        pressure: one or many (force per area).
        slip_rate: one, or as many (length per time).
        accumulated_slip: one, or as many (length).
        """
        pressures = np.atleast_1d(check.finite(check.array(pressure, "pressure"), "pressure"))
        given = []
        for value, name in [(slip_rate, "slip_rate"), (accumulated_slip, "accumulated_slip")]:
            found = check.finite(check.array(value, name), name)
            if (found < 0.0).any():
                raise refuse(name, "it must not be negative")
            try:
                given.append(np.broadcast_to(found, pressures.shape).ravel().tolist())
            except ValueError:
                raise refuse(name, "one is needed, or as many as pressures") from None
        bounds = self._native.bound(pressures.ravel().tolist(), given[0], given[1])
        return bounds.reshape(pressures.shape)

    def _with(self, method: str, constants: Mapping[str, Optional[float]]) -> Friction:
        """The law with an additional dependence, by the name of its method."""
        numbers = {
            name: None if value is None and name in ("floor", "limit") else check.number(value, name)
            for name, value in constants.items()
        }
        stated = {name: value for name, value in numbers.items() if value is not None}
        told = ", ".join(f"{name}={value}" for name, value in stated.items())
        recipe: Recipe = (getattr(Friction, method), (self, *numbers.values()), {})
        found = getattr(self._native, method)(*numbers.values())
        return Friction._of(found, f"{self._told}.{method}({told})", recipe)

    def _with_table(self, method: str, name: str, places: Any, factors: Any) -> Friction:
        given = [check.array(places, name), check.array(factors, "factors")]
        for found, what in zip(given, [name, "factors"]):
            if found.ndim != 1:
                raise refuse(what, f"an array of one dimension is needed, not of {found.ndim}")
        lists = [found.astype(np.float64).tolist() for found in given]
        recipe: Recipe = (getattr(Friction, method), (self, *lists), {})
        told = f"{self._told}.{method}({name}={lists[0]}, factors={lists[1]})"
        return Friction._of(getattr(self._native, method)(*lists), told, recipe)

    def with_shear_cap(self, shear_cap: float) -> Friction:
        """The law with a bound on friction.

        shear_cap: largest shear stress that friction carries (force per area).
        """
        cap = check.number(shear_cap, "shear_cap")
        recipe: Recipe = (Friction.with_shear_cap, (self, cap), {})
        told = f"{self._told}.with_shear_cap({cap})"
        return Friction._of(self._native.with_shear_cap(cap), told, recipe)

    def slip_surface(self, theta: float = 0.0, count: int = 360) -> SlipSurface:
        """Friction in all directions of slip, per unit of pressure and at rest.

        theta: angle between the textures of two textured surfaces (degrees); it has no
            effect on other laws.
        count: number of samples.
        """
        theta = check.number(theta, "theta")
        count = check.whole(count, "count", 3)
        angle, along, across, _, work = self._native.slip_surface(np.radians(theta), count)
        mu = self._native.coefficient
        return SlipSurface(angle, mu * np.column_stack([along, across]), mu * work)

    def plot(self, axes: Union[Axes, None] = None, theta: float = 0.0) -> Axes:
        """Draws the slip surface, and arrows of slip from it, with matplotlib.

        axes: where it is drawn; on a new figure by default.
        theta: angle between the textures of two textured surfaces (degrees).
        """
        from ._plot import draw_friction

        return draw_friction(self, axes, theta)

    def __repr__(self) -> str:
        return self._told


class Frictionless(Friction):
    """Frictionless contact."""

    def __init__(self) -> None:
        """Makes the law."""
        self._native = native.Friction.frictionless()
        self._told = "Frictionless()"


class Coulomb(Friction):
    """Isotropic Coulomb friction."""

    def __init__(self, mu: float) -> None:
        """Makes the law; mu: coefficient of friction (no unit)."""
        self._native = native.Friction.coulomb(check.number(mu, "mu"))
        self._told = f"Coulomb({mu})"


class Orthotropic(Friction):
    """One textured surface with different friction along and across its grooves."""

    def __init__(
        self, along: float, across: float, slip_rule: Literal["opposing", "associated"] = "opposing"
    ) -> None:
        """Makes the law.

        along, across: coefficients of friction of slip along and across the grooves (no unit).
        slip_rule: ``opposing``: each component of friction opposes that of slip;
            ``associated``: slip is normal to the slip surface.
        """
        numbers = check.number(along, "along"), check.number(across, "across")
        rule = check.word(slip_rule, ("opposing", "associated"), "slip_rule")
        self._native = native.Friction.orthotropic(*numbers, rule == "associated")
        self._told = f"Orthotropic(along={along}, across={across}, slip_rule={slip_rule!r})"


class Nap(Friction):
    """One textured surface with different friction with, against and across its nap: scales,
    hair or pile."""

    def __init__(self, forward: float, backward: float, lateral: float) -> None:
        """Makes the law.

        forward, backward, lateral: coefficients of friction of slip with the nap, against it
            and across it (no unit).
        """
        names = ["forward", "backward", "lateral"]
        numbers = [check.number(v, n) for v, n in zip([forward, backward, lateral], names)]
        self._native = native.Friction.nap(*numbers)
        self._told = f"Nap(forward={forward}, backward={backward}, lateral={lateral})"


class TwoTextures(Friction):
    """Two textured surfaces, the law of Jones and Papadopoulos."""

    def __init__(self, mu: float, c_mag: float, c_ang: float, c_cen: float) -> None:
        """Makes the law.

        mu: coefficient of friction (no unit).
        c_mag: dependence of the magnitude on the angle between the textures (no unit).
        c_ang: dependence on the angle between slip and textures (no unit).
        c_cen: difference between slip with and against the textures (no unit).
        """
        names = ["mu", "c_mag", "c_ang", "c_cen"]
        numbers = [check.number(v, n) for v, n in zip([mu, c_mag, c_ang, c_cen], names)]
        self._native = native.Friction.two_textures(*numbers)
        self._told = f"TwoTextures({mu}, c_mag={c_mag}, c_ang={c_ang}, c_cen={c_cen})"


class Tabulated(Friction):
    """One textured surface with coefficients measured at many angles; friction opposes slip."""

    def __init__(
        self, angles: Union[Sequence[float], Floats], mu: Union[Sequence[float], Floats]
    ) -> None:
        """Makes the law.

        angles: directions in which the textured surface slips, from its ``a``, ascending
            within a turn (degrees).
        mu: coefficient of friction at each angle (no unit).
        """
        given: list[Any] = [check.array(angles, "angles"), check.array(mu, "mu")]
        for found, name in zip(given, ["angles", "mu"]):
            if found.ndim != 1:
                raise refuse(name, f"an array of one dimension is needed, not of {found.ndim}")
        radians = np.radians(given[0]).tolist()
        self._native = native.Friction.tabulated(radians, given[1].astype(np.float64).tolist())
        self._told = f"Tabulated({len(radians)} angles)"

    @classmethod
    def sampled(cls, mu: Callable[[float], float], count: int = 360) -> Tabulated:
        """Makes the law from a function, its polar curve, which is called once for each angle.

        Between the angles the law is monotone and smooth; its error is at most of the order of the
        square of their distance.

        mu: coefficient of friction (no unit) of slip at an angle (degrees).
        count: number of angles, from 0 at equal distances.
        """
        if not callable(mu):
            raise TypeError("mu: a function of the angle is needed")
        angles = [360.0 * at / check.whole(count, "count", 3) for at in range(count)]
        return cls(angles, [check.number(mu(angle), f"mu at {angle} degrees") for angle in angles])


class OwnFriction(Friction):
    """A user-defined friction law: a Python function states its kernel.

    At a contact point with the pressure ``p``, friction is ``-tau = mu p (L d + eta)`` in slip
    along ``K d`` with a unit vector ``d``; without slip it is anywhere inside that slip surface.
    The matrices ``L`` and ``K``, of shape (2, 2), and the vector ``eta`` are in the frame of
    :class:`SlipSurface`: of one texture ``a`` (across the grooves, against a nap) and a quarter
    turn from it, of two textures their bisector and a quarter turn from it. There they depend
    on the angle between two textures, and of one texture on nothing.

    The function is called when the law is made, not during a run: its values become a Fourier
    series over the angle, exact to round-off. The law is checked against mechanics: friction
    dissipates in all directions, is opposite on the two surfaces and inside its slip surface, and
    derivatives are exact. A law that fails raises a :class:`ModelError` with the reason.
    """

    def __init__(
        self,
        kernel: Callable[[float], Sequence[npt.ArrayLike]],
        mu: float = 1.0,
        *,
        textures: Literal["one", "two"] = "one",
        name: str = "own",
    ) -> None:
        """Makes the law.

        kernel: from the angle from the texture of one surface to that of the other, above -180
            and below 180 and 0 where there is one texture (degrees), to ``L`` and ``eta``, or
            ``L``, ``eta`` and ``K``, which is the identity where it is left out (no unit).
        mu: coefficient of friction, positive (no unit).
        textures: how many surfaces must have one.
        name: of the law in messages.
        """
        if not callable(kernel):
            raise TypeError("kernel: a function of the angle between the textures is needed")
        law = check.name(name, "name")
        coefficient = check.positive(mu, "mu")
        two = check.word(textures, ("one", "two"), "textures") == "two"
        terms = _series(kernel, law) if two else [[_kernel(kernel, 0.0, law), [0.0] * 10]]
        self._native = native.Friction.own(law, two, terms, coefficient)
        self._told = f"OwnFriction(name={law!r}, mu={coefficient}, textures={textures!r})"


#: Numbers of angles at which the kernel of two textures is asked for, one after the other.
SAMPLES = (16, 64, 256)

#: Harmonics below this share of the largest one are round-off.
ROUND_OFF = 1e-13


def _series(kernel: Callable[[float], Sequence[npt.ArrayLike]], law: str) -> list[list[list[float]]]:
    """Cosine and sine terms of the kernel in the frame of the first texture, where it is
    periodic in the angle between the textures."""
    for count in SAMPLES:
        # Not at 180 degrees, where opposed textures have no bisector.
        angles = 2.0 * np.pi * ((np.arange(count) + 0.5) / count - 0.5)
        values = np.array([_turned(kernel, angle, law) for angle in angles])
        order = np.arange(count // 2)
        weights = np.where(order == 0, 1.0, 2.0)[:, None] / count
        even = weights * (np.cos(np.outer(order, angles)) @ values)
        odd = weights * (np.sin(np.outer(order, angles)) @ values)
        size = np.hypot(even, odd).max(axis=1)
        present = np.flatnonzero(size > ROUND_OFF * size.max())
        last = int(present[-1])
        if last < count // 4:
            chosen = slice(0, last + 1)
            terms: list[list[list[float]]] = np.stack([even[chosen], odd[chosen]], axis=1).tolist()
            return terms
    raise refuse(
        law,
        "the kernel is not a smooth function of the angle between the textures: its Fourier series"
        f" has not ended after {SAMPLES[-1] // 4} terms; note that the bisector reverses where"
        " textures become opposed, so components along it must vanish there",
    )


def _turned(
    kernel: Callable[[float], Sequence[npt.ArrayLike]], angle: float, law: str
) -> list[float]:
    """The kernel in the frame of the first texture, half of the angle from the bisector."""
    found = np.array(_kernel(kernel, float(np.degrees(angle)), law))
    cosine, sine = np.cos(angle / 2.0), np.sin(angle / 2.0)
    turn = np.array([[cosine, -sine], [sine, cosine]])
    matrices = [turn @ found[at : at + 4].reshape(2, 2) @ turn.T for at in (0, 6)]
    return [*matrices[0].ravel(), *(turn @ found[4:6]), *matrices[1].ravel()]


def _kernel(
    kernel: Callable[[float], Sequence[npt.ArrayLike]], angle: float, law: str
) -> list[float]:
    """``L`` by rows, ``eta`` and ``K`` by rows."""
    answer = kernel(angle)
    if not isinstance(answer, (tuple, list)) or len(answer) not in (2, 3):
        raise refuse(law, "`L` and `eta` are needed, or `L`, `eta` and `K`")
    parts = [*answer, np.eye(2)][:3]
    numbers: list[float] = []
    for part, what, shape in zip(parts, ("L", "eta", "K"), ((2, 2), (2,), (2, 2))):
        found = check.array(part, f"{law}: {what}")
        if found.shape != shape:
            raise refuse(f"{law}: {what}", f"it must have shape {shape}, but has {found.shape}")
        numbers += check.finite(found, f"{law}: {what}").ravel().tolist()
    if abs(np.linalg.det(np.reshape(numbers[6:], (2, 2)))) < ROUND_OFF:
        raise refuse(f"{law}: K", "it must be regular")
    return numbers
