//! Elements of one kind.
//!
//! | kind | corners | points |
//! | --- | --- | --- |
//! | tetrahedron | 4 | 4 |
//! | pyramid | 5 | 8 |
//! | wedge | 6 | 6 |
//! | hexahedron | 8 | 8 |
//! | composite tetrahedron | 10 | 4 |

use super::{
    Actuation, Driven, ElementError, ElementResponse, Formulation, Mass, Stiffness, composite,
    enhanced::Fields,
    fault::error_at,
    inertia::Inertia,
    reference::Reference,
    rule::{Recovery, Rule},
};
use nalgebra::Matrix3;
use std::{fmt::Debug, sync::Arc};
use striae_law::bulk::{Material, Past};
use striae_mesh::{CellKind, Vec3};

/// Elements of one kind, counted from 0 within the block.
///
/// Current positions `x` are those of the corners of an element, in their order. What its
/// quadrature points have been through stands in the [`Past`] one after the other; it is
/// empty where the material has no memory.
pub trait ElementBlock: Debug + Send + Sync {
    /// Kind of the elements.
    fn kind(&self) -> CellKind;

    /// Number of elements.
    fn count(&self) -> usize;

    /// Reference volumes that belong to the quadrature points of an element.
    fn weights(&self, at: usize) -> &[f64];

    /// Number of quadrature points of an element.
    fn points(&self) -> usize;

    /// Response of an element, written over an older one of the same kind.
    ///
    /// # Errors
    ///
    /// [`ElementError::Inverted`] where the material is turned inside out.
    fn respond(
        &self,
        at: usize,
        x: &[Vec3],
        driven: &Driven,
        past: Past,
        response: &mut ElementResponse,
    ) -> Result<(), ElementError>;

    /// Rate of the stored energy of an element at given positions with respect to its actuation,
    /// times the change of that; the variables of its points are given.
    ///
    /// # Errors
    ///
    /// [`ElementError::Inverted`] where the material is turned inside out.
    fn work(
        &self,
        at: usize,
        x: &[Vec3],
        driven: &Driven,
        variables: &[f64],
        change: &Actuation,
    ) -> Result<f64, ElementError>;

    /// Mass matrix of an element; `density` is mass per reference volume.
    fn mass(&self, at: usize, density: f64) -> Mass;

    /// Reference volume of an element.
    fn volume(&self, at: usize) -> f64;

    /// Mean of `sum_g w |G_a|^2` over the corners: what a modulus is multiplied by to give
    /// the mean of the diagonal of a stiffness, `h/3` in a cube and `V/h^2` across what is flat.
    fn stiffness_per_modulus(&self, at: usize) -> f64;

    /// Angle by which an element is turned on average.
    fn rotation(&self, at: usize, x: &[Vec3]) -> f64;

    /// Cauchy stress at the quadrature points, whose variables are given.
    ///
    /// # Errors
    ///
    /// [`ElementError::Inverted`] where the material is turned inside out.
    fn stress(
        &self,
        at: usize,
        x: &[Vec3],
        driven: &Driven,
        variables: &[f64],
    ) -> Result<Vec<Matrix3<f64>>, ElementError>;

    /// Cauchy stress continued from the quadrature points to the corners.
    ///
    /// # Errors
    ///
    /// [`ElementError::Inverted`] where the material is turned inside out.
    fn corner_stress(
        &self,
        at: usize,
        x: &[Vec3],
        driven: &Driven,
        variables: &[f64],
    ) -> Result<Vec<Matrix3<f64>>, ElementError>;
}

impl ElementResponse {
    /// Room for the response of an element of a block, of a material.
    pub fn zero(block: &dyn ElementBlock, material: &Material) -> Self {
        let corners = block.kind().corner_count();
        Self {
            energy: 0.0,
            force: vec![[0.0; 3]; corners],
            stiffness: Stiffness::zero(corners),
            dissipated: 0.0,
            variables: vec![0.0; material.variables() * block.points()],
        }
    }

    /// Makes room for the variables of another material.
    pub fn make_room(&mut self, block: &dyn ElementBlock, material: &Material) {
        let count = material.variables() * block.points();
        self.variables.resize(count, 0.0);
    }
}

/// A block that is made, or the first element that is degenerate.
pub(super) type Made = Result<Arc<dyn ElementBlock>, (usize, ElementError)>;

/// The table of numbers of corners and points, each of which has code of its own.
pub(super) fn block(kind: CellKind, formulations: Vec<Formulation>, corners: &[Vec3]) -> Made {
    let shape = kind.shape();
    let Some(recovery) = shape.recovery else {
        return Cells::composite(formulations, corners);
    };
    match (shape.corners.len(), shape.points.len()) {
        (4, 4) => Cells::<4, 4>::made(kind, recovery, formulations, corners),
        (5, 8) => Cells::<5, 8>::made(kind, recovery, formulations, corners),
        (6, 6) => Cells::<6, 6>::made(kind, recovery, formulations, corners),
        (8, 8) => Cells::<8, 8>::made(kind, recovery, formulations, corners),
        (n, q) => unreachable!("the table has a line for {n} corners and {q} points"),
    }
}

/// Elements of a kind with `N` corners and `Q` quadrature points.
#[derive(Debug)]
struct Cells<const N: usize, const Q: usize> {
    kind: CellKind,
    /// Of each element.
    formulations: Vec<Formulation>,
    inertia: Inertia<N, Q>,
    /// Matrix that extrapolates values at the quadrature points to the corners, by corner.
    recovery: [[f64; Q]; N],
    elements: Vec<Reference<N, Q>>,
    /// Of each element, where the deformation gradient of any of them is enhanced.
    fields: Vec<Fields<Q>>,
}

impl<const N: usize, const Q: usize> Cells<N, Q> {
    fn made(
        kind: CellKind,
        recovery: Recovery,
        formulations: Vec<Formulation>,
        corners: &[Vec3],
    ) -> Made {
        let rule = Rule::new(kind, recovery);
        let cells = corners.as_chunks::<N>().0.iter();
        let elements = cells.clone().enumerate();
        let elements = elements.map(|(at, x)| Reference::new(&rule, x).map_err(|e| (at, e)));
        let elements = elements.collect::<Result<_, _>>()?;
        let enhanced = formulations.contains(&Formulation::AssumedStrain);
        let fields = match (enhanced, kind) {
            (true, CellKind::Hexahedron) => cells.map(|x| Fields::new(x)).collect(),
            _ => Vec::new(),
        };
        Ok(Arc::new(Self {
            kind,
            formulations,
            inertia: Inertia::Points(rule.values),
            recovery: rule.recovery,
            elements,
            fields,
        }))
    }

    /// Fraction by which volume ratios are averaged.
    fn share(&self, material: &Material) -> f64 {
        match self.kind {
            CellKind::CompositeTetrahedron => composite::share(material),
            _ => 1.0,
        }
    }
}

impl Cells<{ composite::NODES }, { composite::POINTS }> {
    fn composite(formulations: Vec<Formulation>, corners: &[Vec3]) -> Made {
        let elements = corners.as_chunks().0.iter().enumerate();
        let elements = elements.map(|(at, x)| composite::reference(x).map_err(|e| (at, e)));
        let elements: Vec<_> = elements.collect::<Result<_, _>>()?;
        let (elements, parts) = elements.into_iter().unzip();
        Ok(Arc::new(Self {
            kind: CellKind::CompositeTetrahedron,
            formulations,
            inertia: Inertia::Parts(parts),
            recovery: composite::recovery(),
            elements,
            fields: Vec::new(),
        }))
    }
}

impl<const N: usize, const Q: usize> ElementBlock for Cells<N, Q> {
    fn kind(&self) -> CellKind {
        self.kind
    }

    fn count(&self) -> usize {
        self.elements.len()
    }

    fn weights(&self, at: usize) -> &[f64] {
        &self.elements[at].weights
    }

    fn points(&self) -> usize {
        Q
    }

    fn respond(
        &self,
        at: usize,
        x: &[Vec3],
        driven: &Driven,
        past: Past,
        response: &mut ElementResponse,
    ) -> Result<(), ElementError> {
        let (element, law) = (self.elements[at].driven(driven)?, driven.law());
        match (self.formulations[at], self.fields.get(at)) {
            (Formulation::AssumedStrain, Some(fields)) => {
                element.respond_enhanced(fields, all(x), &law, past, response)
            }
            (Formulation::Standard | Formulation::AssumedStrain, _) => {
                element.respond(all(x), &law, past, response)
            }
            (Formulation::MeanDilatation, _) => {
                let share = self.share(driven.material);
                element.respond_with_mean_dilatation(all(x), &law, past, response, share)
            }
        }
    }

    fn work(
        &self,
        at: usize,
        x: &[Vec3],
        driven: &Driven,
        variables: &[f64],
        change: &Actuation,
    ) -> Result<f64, ElementError> {
        let (element, law) = (self.elements[at].driven(driven)?, driven.law());
        let elastic = match (self.formulations[at], self.fields.get(at)) {
            (Formulation::AssumedStrain, Some(fields)) => {
                element.enhanced_gradients(fields, all(x), &law, variables)?
            }
            (Formulation::Standard | Formulation::AssumedStrain, _) => {
                element.deformation_gradients(all(x))
            }
            (Formulation::MeanDilatation, _) => {
                let share = self.share(driven.material);
                element.deformation(all(x), share)?.scaled
            }
        };
        element.work(&elastic, driven, variables, change)
    }

    fn mass(&self, at: usize, density: f64) -> Mass {
        self.inertia.mass(at, &self.elements[at], density)
    }

    fn volume(&self, at: usize) -> f64 {
        self.elements[at].volume()
    }

    fn stiffness_per_modulus(&self, at: usize) -> f64 {
        self.elements[at].stiffness_per_modulus()
    }

    fn rotation(&self, at: usize, x: &[Vec3]) -> f64 {
        self.elements[at].rotation(all(x))
    }

    fn stress(
        &self,
        at: usize,
        x: &[Vec3],
        driven: &Driven,
        variables: &[f64],
    ) -> Result<Vec<Matrix3<f64>>, ElementError> {
        let (element, law) = (self.elements[at].driven(driven)?, driven.law());
        match (self.formulations[at], self.fields.get(at)) {
            (Formulation::MeanDilatation, _) => {
                let share = self.share(driven.material);
                return element.stress_with_mean_dilatation(all(x), &law, variables, share);
            }
            (Formulation::AssumedStrain, Some(fields)) => {
                return element.enhanced_stress(fields, all(x), &law, variables);
            }
            (Formulation::Standard | Formulation::AssumedStrain, _) => {}
        }
        let each = variables.len() / Q;
        let gradients = element.deformation_gradients(all(x));
        (0..Q)
            .map(|g| {
                let f = gradients[g];
                let variables = &variables[g * each..(g + 1) * each];
                let stress = law.cauchy_stress_after(&f, variables);
                stress.map_err(error_at(g))
            })
            .collect()
    }

    fn corner_stress(
        &self,
        at: usize,
        x: &[Vec3],
        driven: &Driven,
        variables: &[f64],
    ) -> Result<Vec<Matrix3<f64>>, ElementError> {
        let stress = self.stress(at, x, driven, variables)?;
        let corners = self.recovery.iter();
        let at_corner = |weights: &[f64; Q]| (0..Q).map(|g| stress[g] * weights[g]).sum();
        Ok(corners.map(at_corner).collect())
    }
}

/// Positions of the corners as an array.
fn all<const N: usize>(x: &[Vec3]) -> &[Vec3; N] {
    x.try_into().expect("a position for each corner")
}
