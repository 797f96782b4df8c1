"""Dependences of friction as the library declares them, written by ``declared.py``."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Optional, Union

from . import _check as check
from ._check import Floats, Values
from ._made import Made

if TYPE_CHECKING:
    from ._friction import Friction


class Dependences(Made):
    """Dependences of coefficients of friction."""

    def _with(self, key: str, form: str, method: str, values: Values) -> Friction:
        raise NotImplementedError

    def with_power_law(
        self,
        exponent: float,
        pressure: float,
        floor: Optional[float] = None,
    ) -> Friction:
        """Returns the law with a dependence ``by_pressure``, in place of another one. Friction
        ``mu p0 (p/p0)^m``, coefficients ``mu (p/p0)^(m - 1)``.

        exponent: ``m``, below 1 for coefficients that fall with the pressure; 2/3 for one elastic
            contact; greater than 0 (no unit).
        pressure: ``p0``, the pressure at which the coefficients are those that the law states;
            greater than 0 (force per area).
        floor: pressure below which, for ``m`` below 1, friction goes to zero along a parabola,
            with a finite slope; greater than 0 (force per area); ``p0/1000`` by default.
        """
        values: Values = {
            "exponent": check.number(exponent, "exponent"),
            "pressure": check.number(pressure, "pressure"),
            "floor": check.optional(floor, "floor"),
        }
        return self._with("by_pressure", "power-law", "with_power_law", values)

    def with_adhesion(self, pressure: float, floor: Optional[float] = None) -> Friction:
        """Returns the law with a dependence ``by_pressure``, in place of another one. Friction
        ``mu (p + p_ad)`` with a pressure by adhesion, Derjaguin's law.

        pressure: ``p_ad``; greater than 0 (force per area).
        floor: pressure below which friction goes to zero along a parabola, with a finite slope;
            greater than 0 (force per area); ``p_ad/20`` by default.
        """
        values: Values = {
            "pressure": check.number(pressure, "pressure"),
            "floor": check.optional(floor, "floor"),
        }
        return self._with("by_pressure", "adhesion", "with_adhesion", values)

    def with_saturation(self, shear_stress: float) -> Friction:
        """Returns the law with a dependence ``by_pressure``, in place of another one. Friction
        ``tau tanh(mu p/tau)``, which comes smoothly to a shear stress.

        shear_stress: ``tau``. The coefficients that the law states are those of low pressures;
            greater than 0 (force per area).
        """
        values: Values = {
            "shear_stress": check.number(shear_stress, "shear_stress"),
        }
        return self._with("by_pressure", "saturation", "with_saturation", values)

    def with_table_by_pressure(
        self,
        pressures: Union[Sequence[float], Floats],
        factors: Union[Sequence[float], Floats],
    ) -> Friction:
        """Returns the law with a dependence ``by_pressure``, in place of another one. Coefficients
        times a factor by the pressure.

        pressures: pressures, at least two, ascending; at least 0 (force per area).
        factors: factor at each pressure: monotone and smooth between them, constant beyond the
            first and the last; greater than 0 (no unit).
        """
        values: Values = {
            "pressures": check.numbers(pressures, "pressures"),
            "factors": check.numbers(factors, "factors"),
        }
        return self._with("by_pressure", "table", "with_table_by_pressure", values)

    def with_stribeck(
        self,
        kinetic_over_static: float,
        slip_rate: float,
        exponent: float = 2.0,
        viscous: float = 0.0,
    ) -> Friction:
        """Returns the law with a dependence ``by_slip_rate``, in place of another one.
        Coefficients times ``c + (1 - c) exp(-(v/v_s)^d) + k v``, Stribeck's curve.

        kinetic_over_static: ``c``, coefficients in fast slip without the viscous part over those
            at rest, which the law states; at least 0 (no unit).
        slip_rate: ``v_s``; greater than 0 (length per time).
        exponent: ``d``; at least 1 (no unit).
        viscous: ``k``, the viscous part over the coefficients at rest; at least 0 (time per
            length).
        """
        values: Values = {
            "kinetic_over_static": check.number(kinetic_over_static, "kinetic_over_static"),
            "slip_rate": check.number(slip_rate, "slip_rate"),
            "exponent": check.number(exponent, "exponent"),
            "viscous": check.number(viscous, "viscous"),
        }
        return self._with("by_slip_rate", "stribeck", "with_stribeck", values)

    def with_logarithm(
        self,
        factor: float,
        slip_rate: float,
        limit: Optional[float] = None,
    ) -> Friction:
        """Returns the law with a dependence ``by_slip_rate``, in place of another one.
        Coefficients times ``1 + a ln(1 + v/v_0)``.

        factor: ``a``: positive for friction that rises with the slip rate, negative for friction
            that falls (no unit).
        slip_rate: ``v_0``; greater than 0 (length per time).
        limit: slip rate from which on the coefficients are constant; needed where they fall;
            greater than 0 (length per time); none by default.
        """
        values: Values = {
            "factor": check.number(factor, "factor"),
            "slip_rate": check.number(slip_rate, "slip_rate"),
            "limit": check.optional(limit, "limit"),
        }
        return self._with("by_slip_rate", "logarithm", "with_logarithm", values)

    def with_table_by_slip_rate(
        self,
        slip_rates: Union[Sequence[float], Floats],
        factors: Union[Sequence[float], Floats],
    ) -> Friction:
        """Returns the law with a dependence ``by_slip_rate``, in place of another one.
        Coefficients times a factor by the slip rate.

        slip_rates: slip rates, at least two, ascending; at least 0 (length per time).
        factors: factor at each slip rate: monotone and smooth between them, constant beyond the
            first and the last; greater than 0 (no unit).
        """
        values: Values = {
            "slip_rates": check.numbers(slip_rates, "slip_rates"),
            "factors": check.numbers(factors, "factors"),
        }
        return self._with("by_slip_rate", "table", "with_table_by_slip_rate", values)

    def with_exponential(self, final_over_initial: float, slip: float) -> Friction:
        """Returns the law with a dependence ``by_accumulated_slip``, in place of another one.
        Coefficients times ``w + (1 - w) exp(-s/s_0)``, as a surface runs in.

        final_over_initial: ``w``, coefficients after long slip over those at the start, which the
            law states; greater than 0 (no unit).
        slip: ``s_0``, the slip after which the difference has fallen to 1/e; greater than 0
            (length).
        """
        values: Values = {
            "final_over_initial": check.number(final_over_initial, "final_over_initial"),
            "slip": check.number(slip, "slip"),
        }
        return self._with("by_accumulated_slip", "exponential", "with_exponential", values)

    def with_table_by_accumulated_slip(
        self,
        slips: Union[Sequence[float], Floats],
        factors: Union[Sequence[float], Floats],
    ) -> Friction:
        """Returns the law with a dependence ``by_accumulated_slip``, in place of another one.
        Coefficients times a factor by the accumulated slip.

        slips: accumulated slips, at least two, ascending; at least 0 (length).
        factors: factor after each slip: monotone and smooth between them, constant beyond the
            first and the last; greater than 0 (no unit).
        """
        values: Values = {
            "slips": check.numbers(slips, "slips"),
            "factors": check.numbers(factors, "factors"),
        }
        return self._with("by_accumulated_slip", "table", "with_table_by_accumulated_slip", values)

    def with_ageing_law(
        self,
        direct_effect: float,
        evolution_effect: float,
        slip_rate: float,
        slip_distance: float,
        state: Optional[float] = None,
    ) -> Friction:
        """Returns the law with a dependence ``by_state``, in place of another one. Rate-and-state
        friction ``mu + a ln(v/v_0) + b ln(v_0 theta/D)`` with the ageing law ``d theta/dt = 1 - v
        theta/D``: contacts grow stronger at rest.

        direct_effect: ``a``, by which the largest coefficient rises at once as the slip rate rises
            by a factor of e; greater than 0 (no unit).
        evolution_effect: ``b``, by which it falls again as the state follows; above ``a`` for
            friction that is less in faster steady slip; at least 0 (no unit).
        slip_rate: ``v_0``, the rate at which coefficients in steady slip are those that the law
            states; greater than 0 (length per time).
        slip_distance: ``D``, the slip over which the state follows a change of the slip rate;
            greater than 0 (length).
        state: ``theta`` at the start; by default that of steady slip at ``slip_rate``; greater
            than 0 (time); ``slip_distance/slip_rate`` by default.
        """
        values: Values = {
            "direct_effect": check.number(direct_effect, "direct_effect"),
            "evolution_effect": check.number(evolution_effect, "evolution_effect"),
            "slip_rate": check.number(slip_rate, "slip_rate"),
            "slip_distance": check.number(slip_distance, "slip_distance"),
            "state": check.optional(state, "state"),
        }
        return self._with("by_state", "ageing-law", "with_ageing_law", values)

    def with_slip_law(
        self,
        direct_effect: float,
        evolution_effect: float,
        slip_rate: float,
        slip_distance: float,
        state: Optional[float] = None,
    ) -> Friction:
        """Returns the law with a dependence ``by_state``, in place of another one. Rate-and-state
        friction ``mu + a ln(v/v_0) + b ln(v_0 theta/D)`` with the slip law ``d theta/dt = -(v
        theta/D) ln(v theta/D)``: the state changes with slip only.

        direct_effect: ``a``, by which the largest coefficient rises at once as the slip rate rises
            by a factor of e; greater than 0 (no unit).
        evolution_effect: ``b``, by which it falls again as the state follows; above ``a`` for
            friction that is less in faster steady slip; at least 0 (no unit).
        slip_rate: ``v_0``, the rate at which coefficients in steady slip are those that the law
            states; greater than 0 (length per time).
        slip_distance: ``D``, the slip over which the state follows a change of the slip rate;
            greater than 0 (length).
        state: ``theta`` at the start; by default that of steady slip at ``slip_rate``; greater
            than 0 (time); ``slip_distance/slip_rate`` by default.
        """
        values: Values = {
            "direct_effect": check.number(direct_effect, "direct_effect"),
            "evolution_effect": check.number(evolution_effect, "evolution_effect"),
            "slip_rate": check.number(slip_rate, "slip_rate"),
            "slip_distance": check.number(slip_distance, "slip_distance"),
            "state": check.optional(state, "state"),
        }
        return self._with("by_state", "slip-law", "with_slip_law", values)

    def with_static_kinetic(
        self,
        kinetic_over_static: float,
        slip_distance: float,
        healing_time: float,
        state: float = 1.0,
    ) -> Friction:
        """Returns the law with a dependence ``by_state``, in place of another one. Coefficients
        times ``c + (1 - c) psi``, ``d psi/dt = (1 - psi)/T - psi v/D``: friction falls with slip
        from static to kinetic and heals exponentially at rest.

        kinetic_over_static: ``c``, coefficients after long slip without healing over those healed,
            which the law states; at least 0 and at most 1 (no unit).
        slip_distance: ``D``, the slip over which what has healed falls to 1/e; greater than 0
            (length).
        healing_time: ``T``, after which the difference has fallen to 1/e at rest; greater than 0
            (time).
        state: ``psi`` at the start, from 0 for kinetic to 1 for healed; at least 0 and at most 1
            (no unit).
        """
        values: Values = {
            "kinetic_over_static": check.number(kinetic_over_static, "kinetic_over_static"),
            "slip_distance": check.number(slip_distance, "slip_distance"),
            "healing_time": check.number(healing_time, "healing_time"),
            "state": check.number(state, "state"),
        }
        return self._with("by_state", "static-kinetic", "with_static_kinetic", values)

    def with_logarithmic_healing(
        self,
        factor: float,
        slip_distance: float,
        healing_time: float,
        state: float = 0.0,
    ) -> Friction:
        """Returns the law with a dependence ``by_state``, in place of another one. Coefficients
        times ``1 + f ln(1 + theta/T)``, ``d theta/dt = 1 - theta v/D``: friction falls with slip
        to kinetic and heals with the logarithm of the time at rest.

        factor: ``f``, by which coefficients rise over the kinetic ones, which the law states, as
            the time at rest grows by a factor of e; at least 0 (no unit).
        slip_distance: ``D``, the slip over which what has healed falls to 1/e; greater than 0
            (length).
        healing_time: ``T``, the time at rest from which on friction goes with the logarithm;
            greater than 0 (time).
        state: ``theta`` at the start, the time that surfaces have been at rest; at least 0 (time).
        """
        values: Values = {
            "factor": check.number(factor, "factor"),
            "slip_distance": check.number(slip_distance, "slip_distance"),
            "healing_time": check.number(healing_time, "healing_time"),
            "state": check.number(state, "state"),
        }
        return self._with("by_state", "logarithmic-healing", "with_logarithmic_healing", values)

    def with_decay(self, kinetic_over_static: float, slip_rate: float) -> Friction:
        """Returns the law with a dependence ``decay``, in place of another one. Decay of friction
        from rest to fast slip, ``kinetic + (static - kinetic) exp(-rate/slip_rate)``.

        kinetic_over_static: coefficients in fast slip over those at rest, which the law states; at
            least 0 (no unit).
        slip_rate: rate of slip at which the difference has fallen to 1/e; greater than 0 (length
            per time).
        """
        values: Values = {
            "kinetic_over_static": check.number(kinetic_over_static, "kinetic_over_static"),
            "slip_rate": check.number(slip_rate, "slip_rate"),
        }
        return self._with("decay", "decay", "with_decay", values)
