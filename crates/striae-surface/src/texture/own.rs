//! Lines by formulas that are no variant of [`Lines`](super::Lines): those declared outside of this
//! crate, and new ones.

use std::{fmt, sync::Arc};

use nalgebra::{Const, Vector3};
use num_dual::DualSVec64;
use serde::{Serialize, Serializer};
use striae_declared::Statement;

use super::axis::Axis;
use crate::scalar::Real;

/// A number with its derivatives by the coordinates of a point.
pub type PointLane = DualSVec64<3>;

/// Directions in space by a formula.
///
/// ```
/// use nalgebra::Vector3;
/// use striae_declared::{ANY, Declared, Parameter};
/// use striae_surface::texture::{Axis, DirectionField, Lines, Paint, PointLane, TURN};
///
/// /// Helices about an axis, by their angle to its cross-sections in radians.
/// #[derive(Debug)]
/// struct Helices(Axis, f64);
///
/// impl DirectionField for Helices {
///     fn direction(&self, point: Vector3<PointLane>) -> Vector3<PointLane> {
///         let (sin, cos) = self.1.sin_cos();
///         let (along, around): (Vector3<PointLane>, _) = (self.0.along(), self.0.around(point));
///         around.map(|x| x * cos) + along.map(|x| x * sin)
///     }
///
///     fn axis(&self) -> Option<Axis> {
///         Some(self.0)
///     }
/// }
///
/// static HELICAL: Declared<Paint> = Declared {
///     name: "helical",
///     summary: "Helices about an axis.",
///     parameters: &[
///         Parameter::axis("helical", "The axis."),
///         Parameter::number("lead", ANY, "degrees", "Angle to the cross-sections."),
///         TURN,
///     ],
///     build: |values| {
///         let lead = values.number("lead").to_radians();
///         let lines = Lines::own(Helices(Axis::stated(values, "helical"), lead));
///         Ok(Paint::lines(lines, values))
///     },
///     fit: None,
/// };
/// # assert_eq!(HELICAL.parameters.len(), 3);
/// ```
pub trait DirectionField: fmt::Debug + Send + Sync {
    /// Direction at a point, need not be tangential to any surface: about of unit length, shorter
    /// by orders of magnitude only where there is none.
    fn direction(&self, point: Vector3<PointLane>) -> Vector3<PointLane>;

    /// Axis that the lines are about and on which they have no direction, if there is one.
    fn axis(&self) -> Option<Axis> {
        None
    }
}

/// Shared lines; equal to themselves and to those made of the same statement.
#[derive(Clone, Debug)]
pub struct OwnLines {
    field: Arc<dyn DirectionField>,
    statement: Option<Statement>,
}

/// Written as their own description.
impl Serialize for OwnLines {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(&format_args!("{:?}", self.field))
    }
}

impl PartialEq for OwnLines {
    fn eq(&self, other: &Self) -> bool {
        let is_stated_alike = self.statement.is_some() && self.statement == other.statement;
        is_stated_alike || Arc::ptr_eq(&self.field, &other.field)
    }
}

impl OwnLines {
    /// Shares a formula.
    pub(super) fn new(field: impl DirectionField + 'static) -> Self {
        Self {
            field: Arc::new(field),
            statement: None,
        }
    }

    /// Returns the lines with what they were made of.
    pub(super) fn with_statement(self, statement: Statement) -> Self {
        let statement = Some(statement);
        Self { statement, ..self }
    }

    /// Returns what the lines were made of, if a declaration made them.
    pub(super) fn statement(&self) -> Option<&Statement> {
        self.statement.as_ref()
    }

    /// Axis that the lines are about, if there is one.
    pub(super) fn axis(&self) -> Option<Axis> {
        self.field.axis()
    }

    /// Direction at a point, over the variables of its coordinates.
    pub(super) fn direction<D: Real>(&self, point: Vector3<D>) -> Vector3<D> {
        debug_assert!(D::NDERIV <= 1, "formulas have first derivatives");
        let value = point.map(|x| x.re());
        let lanes = Vector3::from_fn(|i, _| PointLane::from_re(value[i]).derivative(i));
        let changes = point.map(|x| x - x.re());
        let found = self.field.direction(lanes);
        found.map(|f| {
            let slopes = f.eps.unwrap_generic(Const::<3>, Const::<1>);
            let terms = changes.iter().zip(slopes.iter());
            terms.fold(D::from(f.re), |sum, (change, slope)| sum + *change * *slope)
        })
    }
}
