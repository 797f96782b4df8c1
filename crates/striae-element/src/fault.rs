//! Errors of elements.

use striae_law::bulk::ResponseError;
use striae_mesh::ElementId;

/// An element that is turned inside out at a quadrature point.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum ElementError {
    /// In the reference configuration: the mesh is at fault.
    #[error("the reference shape is degenerate: Jacobian {determinant:.6e} at Gauss point {point}")]
    Degenerate {
        /// Local number of the quadrature point.
        point: usize,
        /// Determinant of `dX/dxi`.
        determinant: f64,
    },
    /// In the current configuration: the step is at fault.
    #[error("turned inside out: det F = {determinant:.6e} at Gauss point {point}")]
    Inverted {
        /// Local number of the quadrature point.
        point: usize,
        /// Determinant of the deformation gradient.
        determinant: f64,
    },
    /// In the current configuration, which a law of one's own has no response to.
    #[error(
        "its material has no response to its deformation: det F = {determinant:.6e} at Gauss point {point}"
    )]
    Refused {
        /// Local number of the quadrature point.
        point: usize,
        /// Determinant of the deformation gradient.
        determinant: f64,
    },
    /// In the current configuration, beyond what the material allows.
    #[error(
        "stretched beyond the limit of its material: I1 - 3 = {strain:.6e} at Gauss point {point}, but the law ends at {limit:.6e}"
    )]
    Overstretched {
        /// Local number of the quadrature point.
        point: usize,
        /// `I1 - 3` of the isochoric deformation.
        strain: f64,
        /// The limit of the law.
        limit: f64,
    },
    /// In the current configuration, fibres beyond all measure.
    #[error(
        "its fibres are stretched beyond their limit: their strain is {strain:.6e} at Gauss point {point}, but the law ends at {limit:.6e}"
    )]
    OverstretchedFibres {
        /// Local number of the quadrature point.
        point: usize,
        /// Their strain.
        strain: f64,
        /// The limit of the law.
        limit: f64,
    },
    /// In the configuration without stress: the actuation is at fault.
    #[error(
        "shrunk to nothing by its actuation: the stress-free deformation has determinant \
         {determinant:.6e}"
    )]
    Shrunk {
        /// Determinant of the stress-free deformation.
        determinant: f64,
    },
    /// In the current configuration, of an element that is enhanced.
    #[error("its assumed strain cannot be determined")]
    Unsettled,
}

/// An [`ElementError`] and the element it befell.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error("{element}: {error}")]
pub struct ElementFault {
    /// The element.
    pub element: ElementId,
    /// Error of this element.
    pub error: ElementError,
}

/// The error of the material as an error of the element at quadrature point `g`.
pub(super) fn error_at(g: usize) -> impl Fn(ResponseError) -> ElementError {
    move |error| match error {
        ResponseError::Inverted { determinant } => ElementError::Inverted {
            point: g,
            determinant,
        },
        ResponseError::Refused { determinant } => ElementError::Refused {
            point: g,
            determinant,
        },
        ResponseError::Overstretched { strain, limit } => ElementError::Overstretched {
            point: g,
            strain,
            limit,
        },
        ResponseError::OverstretchedFibres { strain, limit } => ElementError::OverstretchedFibres {
            point: g,
            strain,
            limit,
        },
    }
}
