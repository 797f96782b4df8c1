//! Coefficients of friction that depend on pressure, slip rate and accumulated slip.

use super::super::declare::{choice, table};
use crate::value::{All, NonNegative, Number, Positive, Steepness};

table! {
    /// Decay of friction from rest to fast slip, `kinetic + (static - kinetic) exp(-rate/slip_rate)`.
    Decay {
        /// Coefficients in fast slip over those at rest, which the law states.
        required kinetic_over_static: NonNegative,
        /// Rate of slip, length per time, at which the difference has fallen to 1/e.
        required slip_rate: Positive,
    }
}

choice! {
    /// Dependence of the coefficients on the pressure.
    ByPressure by form {
        "power-law" => PowerLaw(PowerLaw),
        "adhesion" => Adhesion(Adhesion),
        "saturation" => Saturation(Saturation),
        "table" => Table(PressureTable),
    }
}

table! {
    /// Friction `mu p0 (p/p0)^m`, coefficients `mu (p/p0)^(m - 1)`.
    PowerLaw {
        /// `m`, below 1 for coefficients that fall with the pressure; 2/3 for one elastic contact.
        required exponent: Positive,
        /// `p0`, the pressure at which the coefficients are those stated by the law.
        required pressure: Positive,
        /// Pressure below which, for `m` below 1, friction falls to zero along a parabola, with a
        /// finite slope. Default: `p0/1000`.
        optional floor: Positive,
    }
}

table! {
    /// Friction `mu (p + p_ad)` with a pressure by adhesion, Derjaguin's law.
    Adhesion {
        /// `p_ad`.
        required pressure: Positive,
        /// Pressure below which friction falls to zero along a parabola, with a finite slope.
        /// Default: `p_ad/20`.
        optional floor: Positive,
    }
}

table! {
    /// Friction `tau tanh(mu p/tau)`, which approaches a shear stress smoothly.
    Saturation {
        /// `tau`. The coefficients stated by the law are those of low pressures.
        required shear_stress: Positive,
    }
}

table! {
    /// Coefficients times a factor by the pressure.
    PressureTable {
        /// Pressures, at least two, ascending.
        required pressures: All<NonNegative>,
        /// Factor at each pressure: monotone and smooth between them, constant beyond the first and the last.
        required factors: All<Positive>,
    }
}

choice! {
    /// Dependence of the coefficients on the slip rate.
    BySlipRate by form {
        "stribeck" => Stribeck(Stribeck),
        "logarithm" => Logarithm(Logarithm),
        "table" => Table(RateTable),
    }
}

table! {
    /// Coefficients times `c + (1 - c) exp(-(v/v_s)^d) + k v`, Stribeck's curve.
    Stribeck {
        /// `c`, coefficients in fast slip without the viscous part over those at rest, which the law states.
        required kinetic_over_static: NonNegative,
        /// `v_s`, length per time.
        required slip_rate: Positive,
        /// `d`. Default: 2.
        optional exponent: Steepness,
        /// `k`, the viscous part over the coefficients at rest, time per length. Default: 0.
        optional viscous: NonNegative,
    }
}

table! {
    /// Coefficients times `1 + a ln(1 + v/v_0)`.
    Logarithm {
        /// `a`: positive for friction that rises with the slip rate, negative for friction that falls.
        required factor: Number,
        /// `v_0`, length per time.
        required slip_rate: Positive,
        /// Slip rate from which on the coefficients are constant; required if they fall. Default:
        /// none.
        optional limit: Positive,
    }
}

table! {
    /// Coefficients times a factor by the slip rate.
    RateTable {
        /// Slip rates, length per time, at least two, ascending.
        required slip_rates: All<NonNegative>,
        /// Factor at each slip rate: monotone and smooth between them, constant beyond the first and the last.
        required factors: All<Positive>,
    }
}

choice! {
    /// Dependence of the coefficients on the accumulated slip.
    ByAccumulatedSlip by form {
        "exponential" => Exponential(ExponentialRunningIn),
        "table" => Table(SlipTable),
    }
}

table! {
    /// Coefficients times `w + (1 - w) exp(-s/s_0)`, as a surface runs in.
    ExponentialRunningIn {
        /// `w`, coefficients after long slip over those at the start, which the law states.
        required final_over_initial: Positive,
        /// `s_0`, the slip after which the difference has fallen to 1/e.
        required slip: Positive,
    }
}

table! {
    /// Coefficients times a factor by the accumulated slip.
    SlipTable {
        /// Accumulated slips, at least two, ascending.
        required slips: All<NonNegative>,
        /// Factor after each slip: monotone and smooth between them, constant beyond the first and the last.
        required factors: All<Positive>,
    }
}
