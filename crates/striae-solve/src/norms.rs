//! Residual norms by field.

use std::fmt;

use striae_contact::term::Field;

/// Residuals by field, each over its own scale.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Norms {
    /// Equilibrium: 2-norm over the free components, over the force scale.
    pub force: f64,
    /// Largest gap of a closed node over the local facet size.
    pub gap: f64,
    /// Largest slip of a sticking node over the local facet size.
    pub stick: f64,
    /// Largest residual of a traction row over the largest pressure.
    pub traction: f64,
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

    /// The largest of all norms; infinite where one is not a number.
    pub fn largest(&self) -> f64 {
        [self.force, self.gap, self.stick, self.traction]
            .into_iter()
            .fold(0.0, larger)
    }

    /// Name of the field with the largest norm.
    pub fn worst(&self) -> &'static str {
        let fields = [
            ("force", self.force),
            ("gap", self.gap),
            ("stick", self.stick),
            ("traction", self.traction),
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
        write!(
            f,
            "force {:.1e}  gap {:.1e}  stick {:.1e}  traction {:.1e}",
            self.force, self.gap, self.stick, self.traction
        )
    }
}
