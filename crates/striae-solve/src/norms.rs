//! Residual norms by field.

use std::fmt;

use striae_contact::term::Field;

/// Residuals by field, each over its own scale.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Norms {
    /// Equilibrium: 2-norm over the free components, over the force scale.
    pub force: f64,
    /// The part of it that round-off leaves of the stiffness that is there. A residual that
    /// stands at it is as small as it can be, and counts as zero.
    pub round_off: f64,
    /// Largest gap of a closed node over the local facet size.
    pub gap: f64,
    /// Largest slip of a sticking node over the local facet size.
    pub stick: f64,
    /// Largest residual of a traction row over the largest pressure.
    pub traction: f64,
    /// Largest error of the volume of a cavity over that at rest.
    pub volume: f64,
}

/// Scales of the fields.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scales {
    /// Force.
    pub force: f64,
    /// Stress.
    pub traction: f64,
}

impl Norms {
    /// Takes a contact row into account.
    pub fn include(&mut self, field: Field, residual: f64, scales: &Scales) {
        let (norm, scale) = match field {
            Field::Momentum => return,
            Field::Gap(size) => (&mut self.gap, size),
            Field::Stick(size) => (&mut self.stick, size),
            Field::Traction => (&mut self.traction, scales.traction),
        };
        *norm = larger(*norm, residual.abs() / scale);
    }

    /// Equilibrium, zero where it stands at round-off.
    pub fn equilibrium(&self) -> f64 {
        if self.force <= self.round_off {
            0.0
        } else {
            self.force
        }
    }

    /// The largest of all norms; infinite where one is not a number.
    pub fn largest(&self) -> f64 {
        let all = [self.equilibrium(), self.gap, self.stick, self.traction];
        all.into_iter().chain([self.volume]).fold(0.0, larger)
    }

    /// Name of the field with the largest norm.
    pub fn worst(&self) -> &'static str {
        let fields = [
            ("force", self.equilibrium()),
            ("gap", self.gap),
            ("stick", self.stick),
            ("traction", self.traction),
            ("volume", self.volume),
        ];
        let largest = self.largest();
        fields
            .into_iter()
            .find(|(_, norm)| larger(0.0, *norm) >= largest)
            .map_or("force", |(name, _)| name)
    }
}

/// The larger one of both; infinite where one is not a number.
pub(crate) fn larger(a: f64, b: f64) -> f64 {
    if b.is_nan() { f64::INFINITY } else { a.max(b) }
}

impl fmt::Display for Norms {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            force,
            round_off,
            gap,
            stick,
            traction,
            volume,
        } = self;
        write!(f, "force {force:.1e}")?;
        if force <= round_off && *force > 0.0 {
            write!(f, " (round-off)")?;
        }
        write!(
            f,
            "  gap {gap:.1e}  stick {stick:.1e}  traction {traction:.1e}"
        )?;
        match *volume > 0.0 {
            true => write!(f, "  volume {volume:.1e}"),
            false => Ok(()),
        }
    }
}
