//! Yield stress over the equivalent plastic strain `p`.
//!
//! ```text
//! linear   Y = Y0 + H p
//! Voce     Y = Y0 + (Ys - Y0) (1 - exp(-d p)) + H p
//! table    straight lines between pairs (p, Y); the last Y beyond them
//! ```
//!
//! `Y` is a Cauchy stress of the tension test, as metals hardly change their volume; `p` is
//! without unit. It must not fall.
//!
//! Source: Voce, J. Inst. Met. 74 (1948) 537-562.

use serde::Serialize;

use striae_declared::{Absent, NO_UNIT, NOT_NEGATIVE, POSITIVE, Parameter, Set, Values};

/// Parameters of laws with a yield stress; [`Hardening::stated`] reads them.
pub const HARDENING: Parameter = Parameter::one_of(
    "hardening",
    &[
        Set {
            doc: "A formula for the yield stress.",
            parameters: &[
                Parameter::number(
                    "yield_stress",
                    POSITIVE,
                    "force per area",
                    "First yield stress `Y0` of `Y = Y0 + (Ys - Y0) (1 - exp(-d p)) + H p` over the equivalent plastic strain `p`.",
                ),
                Parameter::number(
                    "hardening_modulus",
                    NOT_NEGATIVE,
                    "force per area",
                    "Hardening modulus `H`.",
                )
                .or(Absent::Number(0.0)),
                Parameter::table(
                    "saturation",
                    &Set {
                        doc: "Saturation by Voce's law.",
                        parameters: &[
                            Parameter::number(
                                "stress",
                                POSITIVE,
                                "force per area",
                                "Stress `Ys`, at least the first yield stress.",
                            ),
                            Parameter::number(
                                "rate",
                                POSITIVE,
                                NO_UNIT,
                                "Rate `d` over the plastic strain.",
                            ),
                        ],
                    },
                    "Saturation by Voce's law.",
                )
                .or(Absent::Nothing),
            ],
        },
        Set {
            doc: "Straight lines between points of the yield stress.",
            parameters: &[Parameter::pairs(
                "yield_table",
                "Pairs of equivalent plastic strain, from 0 on, and yield stress, which must not fall; the last stress holds beyond.",
            )],
        },
    ],
);

/// Yield stress over the equivalent plastic strain.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Hardening(HardeningForm);

/// Form in which the yield stress is stated.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub enum HardeningForm {
    /// `Y = Y0 + (Ys - Y0) (1 - exp(-d p)) + H p`.
    Smooth {
        /// First yield stress `Y0`.
        yield_stress: f64,
        /// Hardening modulus `H`.
        modulus: f64,
        /// Stress of saturation `Ys`; `Y0` where nothing saturates.
        saturation: f64,
        /// Rate of saturation `d`.
        rate: f64,
    },
    /// Pairs of equivalent plastic strain and yield stress.
    Table(Box<[[f64; 2]]>),
}

/// Hardening that cannot be.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum InadmissibleHardening {
    /// A constant is out of its range.
    #[error("`{name}` is {value}, but it must be {needed}")]
    Constant {
        /// Name of the constant.
        name: &'static str,
        /// Its value.
        value: f64,
        /// Requirement on the value.
        needed: &'static str,
    },
    /// Saturation below the first yield stress.
    #[error(
        "the saturation stress is {saturation}, but it must be at least `yield_stress`, {first}"
    )]
    Saturation {
        /// The stress of saturation.
        saturation: f64,
        /// The first yield stress.
        first: f64,
    },
    /// A table without a first pair at zero strain.
    #[error("the table must begin at the plastic strain 0")]
    Start,
    /// A pair of a table that does not follow the one before.
    #[error(
        "pair {0} of the table: its plastic strain must be larger than the previous one, its stress positive and not smaller than the previous one"
    )]
    Order(usize),
}

/// Iterations for the flow.
const ITERATIONS: usize = 100;

impl Hardening {
    /// Hardening that the values of [`HARDENING`] state.
    ///
    /// # Errors
    ///
    /// As [`Hardening::voce`] and [`Hardening::table`].
    pub fn stated(values: &Values) -> Result<Self, InadmissibleHardening> {
        if let Some(pairs) = values.pairs_if_any("yield_table") {
            return Self::table(pairs);
        }
        let [first, modulus] =
            ["yield_stress", "hardening_modulus"].map(|name| values.number(name));
        match values.table_if_any("saturation") {
            None => Self::linear(first, modulus),
            Some(of) => Self::voce(first, of.number("stress"), of.number("rate"), modulus),
        }
    }

    /// Values that state it.
    pub(super) fn values(&self) -> Values {
        match &self.0 {
            HardeningForm::Table(pairs) => Values::default().with("yield_table", pairs.to_vec()),
            HardeningForm::Smooth {
                yield_stress,
                modulus,
                saturation,
                rate,
            } => {
                let straight = [
                    ("yield_stress", *yield_stress),
                    ("hardening_modulus", *modulus),
                ];
                let values = Values::from(straight);
                match *rate > 0.0 {
                    false => values,
                    true => {
                        let of = Values::from([("stress", *saturation), ("rate", *rate)]);
                        values.with("saturation", of)
                    }
                }
            }
        }
    }

    /// `Y = Y0 + H p`.
    ///
    /// # Errors
    ///
    /// Unless `Y0 > 0` and `H >= 0`.
    pub fn linear(yield_stress: f64, modulus: f64) -> Result<Self, InadmissibleHardening> {
        Self::voce(yield_stress, yield_stress, 0.0, modulus)
    }

    /// `Y = Y0 + (Ys - Y0) (1 - exp(-d p)) + H p`.
    ///
    /// # Errors
    ///
    /// Unless `Y0 > 0`, `Ys >= Y0`, `d >= 0` and `H >= 0`.
    pub fn voce(
        yield_stress: f64,
        saturation: f64,
        rate: f64,
        modulus: f64,
    ) -> Result<Self, InadmissibleHardening> {
        let refused = |name, value, needed| {
            Err(InadmissibleHardening::Constant {
                name,
                value,
                needed,
            })
        };
        if !(yield_stress > 0.0 && yield_stress.is_finite()) {
            return refused("yield_stress", yield_stress, "positive and finite");
        }
        for (name, value) in [("hardening_modulus", modulus), ("rate", rate)] {
            if !(value >= 0.0 && value.is_finite()) {
                return refused(name, value, "at least 0 and finite");
            }
        }
        if !(saturation >= yield_stress && saturation.is_finite()) {
            return Err(InadmissibleHardening::Saturation {
                saturation,
                first: yield_stress,
            });
        }
        Ok(Self(HardeningForm::Smooth {
            yield_stress,
            modulus,
            saturation,
            rate,
        }))
    }

    /// Straight lines between pairs of plastic strain and yield stress.
    ///
    /// # Errors
    ///
    /// Unless the first strain is 0, strains rise, and stresses are positive and do not fall.
    pub fn table(pairs: &[[f64; 2]]) -> Result<Self, InadmissibleHardening> {
        let mut before = [0.0, 0.0];
        for (at, pair) in pairs.iter().enumerate() {
            let [strain, stress] = *pair;
            if at == 0 && strain != 0.0 {
                return Err(InadmissibleHardening::Start);
            }
            let follows = at == 0 || strain > before[0];
            let sound = stress > 0.0 && stress >= before[1] && stress.is_finite();
            if !(follows && sound && strain.is_finite()) {
                return Err(InadmissibleHardening::Order(at));
            }
            before = *pair;
        }
        if pairs.is_empty() {
            return Err(InadmissibleHardening::Start);
        }
        Ok(Self(HardeningForm::Table(pairs.into())))
    }

    /// Form in which it is stated.
    pub fn form(&self) -> &HardeningForm {
        &self.0
    }

    /// `Y(p)`.
    pub fn stress(&self, plastic: f64) -> f64 {
        match &self.0 {
            HardeningForm::Smooth {
                yield_stress,
                modulus,
                saturation,
                rate,
            } => {
                let saturated = -(-rate * plastic).exp_m1();
                yield_stress + (saturation - yield_stress) * saturated + modulus * plastic
            }
            HardeningForm::Table(pairs) => {
                let [strain, stress] = pairs[below(pairs, plastic)];
                stress + self.slope(plastic) * (plastic - strain)
            }
        }
    }

    /// `dY/dp`; at the corners of a table that to the right.
    pub fn slope(&self, plastic: f64) -> f64 {
        match &self.0 {
            HardeningForm::Smooth {
                yield_stress,
                modulus,
                saturation,
                rate,
            } => modulus + (saturation - yield_stress) * rate * (-rate * plastic).exp(),
            HardeningForm::Table(pairs) => {
                let at = below(pairs, plastic);
                let next = pairs.get(at + 1);
                next.map_or(0.0, |next| {
                    (next[1] - pairs[at][1]) / (next[0] - pairs[at][0])
                })
            }
        }
    }

    /// Integral of `Y` from one plastic strain to a later one.
    pub fn work(&self, from: f64, to: f64) -> f64 {
        match &self.0 {
            HardeningForm::Smooth { .. } if to <= from => 0.0,
            HardeningForm::Smooth {
                yield_stress,
                modulus,
                saturation,
                rate,
            } => {
                let way = to - from;
                let straight = yield_stress * way + 0.5 * modulus * (to + from) * way;
                if *rate == 0.0 {
                    return straight;
                }
                let short = (-rate * from).exp() * (-rate * way).exp_m1() / rate;
                straight + (saturation - yield_stress) * (way + short)
            }
            HardeningForm::Table(pairs) => {
                let corners = pairs.iter().map(|pair| pair[0]);
                let between =
                    corners.filter(|strain| (from..to).contains(strain) && *strain > from);
                let mut work = 0.0;
                let mut start = from;
                for end in between.chain([to]) {
                    work += 0.5 * (self.stress(start) + self.stress(end)) * (end - start);
                    start = end;
                }
                work.max(0.0)
            }
        }
    }

    /// The flow `g` at the deviatoric stress `s` before it, none where that is elastic.
    ///
    /// The root of `s - 2 G g - sqrt(2/3) Y(p + sqrt(2/3) g)`, which falls, by Newton's
    /// method inside a bracket that shrinks.
    pub(super) fn flow(&self, s: f64, shear: f64, plastic: f64) -> Option<f64> {
        let root = (2.0f64 / 3.0).sqrt();
        let excess = |flow: f64| s - 2.0 * shear * flow - root * self.stress(plastic + root * flow);
        if excess(0.0) <= 0.0 {
            return None;
        }
        let (mut low, mut high) = (0.0, 0.5 * s / shear);
        let mut flow = low;
        for _ in 0..ITERATIONS {
            let value = excess(flow);
            if value > 0.0 {
                low = flow;
            } else {
                high = flow;
            }
            let slope = 2.0 * shear + 2.0 / 3.0 * self.slope(plastic + root * flow);
            let newton = flow + value / slope;
            let next = if (low..=high).contains(&newton) {
                newton
            } else {
                0.5 * (low + high)
            };
            let rests = value.abs() <= 2.0 * f64::EPSILON * s || next == flow;
            if rests {
                break;
            }
            flow = next;
        }
        Some(flow)
    }
}

/// The last pair whose strain is not above `plastic`.
fn below(pairs: &[[f64; 2]], plastic: f64) -> usize {
    let above = pairs.partition_point(|pair| pair[0] <= plastic);
    above.saturating_sub(1)
}
