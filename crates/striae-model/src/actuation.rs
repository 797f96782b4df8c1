//! Bodies that move themselves: what a step makes of their shape at rest, and of their tensions.
//!
//! A section has the stress-free deformation `G = I + S + thermal strain I + s sum f x f` with a
//! tensor `S`, and a strain `s` along each family `f` of its fibres; along unit vectors `a` of the
//! reference configuration it pulls with a force `T` per reference area, along its fibres too.
//! Each of these goes from its value to a target along a curve, and they are added. What elements
//! make of it is in `striae_element`, `actuation.rs`. All of it is a function of time, so that it
//! resumes with the time.

use nalgebra::Matrix3;
use serde::{Deserialize, Serialize};
use striae_element::{self as element, Driven, Tension};
use striae_law::bulk::Material;
use striae_mesh::Vec3;

use crate::model::ActuationKind;

/// Actuation of all bodies at a time.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Actuations {
    /// By body and section, the body's own material being section 0; empty where no step up to
    /// now actuates anything.
    pub bodies: Vec<Vec<SectionActuation>>,
}

/// Actuation of a section at a time.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct SectionActuation {
    /// `S`, with the thermal strain.
    pub strain: Matrix3<f64>,
    /// `s`.
    pub fibre_strain: f64,
    /// `T` along fibres.
    pub fibre_tension: f64,
    /// Lines `a` with their `T`.
    pub tensions: Vec<(Vec3, f64)>,
}

impl Actuations {
    /// Actuation of a section, if there is any.
    pub fn of(&self, body: usize, section: usize) -> Option<&SectionActuation> {
        let found = self.bodies.get(body)?.get(section)?;
        found.acts().then_some(found)
    }

    /// Difference from another one, in which anything missing counts as zero.
    pub fn minus(&self, other: &Self) -> Self {
        let count = self.bodies.len().max(other.bodies.len());
        let of_body = |body: usize| {
            let [own, others] = [self, other].map(|all| all.bodies.get(body));
            let count = [own, others].map(|of| of.map_or(0, Vec::len));
            let section = |at: usize| {
                let [own, others] = [own, others].map(|of| of.and_then(|of| of.get(at)).cloned());
                own.unwrap_or_default().minus(&others.unwrap_or_default())
            };
            (0..count[0].max(count[1])).map(section).collect()
        };
        Self {
            bodies: (0..count).map(of_body).collect(),
        }
    }
}

impl SectionActuation {
    /// Returns whether any part is not zero.
    fn acts(&self) -> bool {
        self.strain != Matrix3::zeros()
            || self.fibre_strain != 0.0
            || self.fibre_tension != 0.0
            || self.tensions.iter().any(|(_, value)| *value != 0.0)
    }

    /// Adds a part.
    pub fn add(&mut self, kind: &ActuationKind) {
        match *kind {
            ActuationKind::Strain(strain) => self.strain += strain,
            ActuationKind::Thermal { .. } => {
                self.strain += Matrix3::identity() * kind.thermal_strain();
            }
            ActuationKind::FibreStrain(strain) => self.fibre_strain += strain,
            ActuationKind::FibreTension(tension) => self.fibre_tension += tension,
            ActuationKind::Tension { along, value } => self.tensions.push((along, value)),
        }
    }

    fn minus(&self, other: &Self) -> Self {
        let of = |all: &Self, line: &Vec3| {
            let found = all.tensions.iter().filter(|(along, _)| along == line);
            found.map(|(_, value)| value).sum::<f64>()
        };
        let mut lines: Vec<Vec3> = Vec::new();
        for (line, _) in self.tensions.iter().chain(&other.tensions) {
            if !lines.contains(line) {
                lines.push(*line);
            }
        }
        let tension = |line: Vec3| (line, of(self, &line) - of(other, &line));
        Self {
            strain: self.strain - other.strain,
            fibre_strain: self.fibre_strain - other.fibre_strain,
            fibre_tension: self.fibre_tension - other.fibre_tension,
            tensions: lines.into_iter().map(tension).collect(),
        }
    }

    /// The actuation of an element whose points remember the directions of fibres of its material.
    pub fn of_element(&self, material: &Material, variables: &[f64]) -> element::Actuation {
        let mut strain = self.strain;
        let tension = |&(along, value): &(Vec3, f64)| Tension { along, value };
        let mut tensions: Vec<Tension> = self.tensions.iter().map(tension).collect();
        if self.fibre_strain != 0.0 || self.fibre_tension != 0.0 {
            let families = material.fibres().len();
            for direction in variables.chunks_exact(3).take(families) {
                let along = Vec3::from_column_slice(direction);
                strain += along * along.transpose() * self.fibre_strain;
                tensions.push(Tension {
                    along,
                    value: self.fibre_tension,
                });
            }
        }
        tensions.retain(|tension| tension.value != 0.0);
        element::Actuation { strain, tensions }
    }

    /// Material of an element with its actuation.
    pub fn drive<'a>(
        of_section: Option<&Self>,
        material: &'a Material,
        variables: &[f64],
    ) -> Driven<'a> {
        Driven {
            actuation: of_section.map(|all| all.of_element(material, variables)),
            material,
        }
    }
}

impl ActuationKind {
    /// The strain of a change of temperature; zero of other kinds.
    fn thermal_strain(&self) -> f64 {
        match *self {
            Self::Thermal {
                expansion,
                temperature,
            } => expansion * temperature,
            _ => 0.0,
        }
    }

    /// Returns whether a later statement of the other one continues from this one.
    pub fn is_like(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Tension { along, .. }, Self::Tension { along: other, .. }) => along == other,
            _ => std::mem::discriminant(self) == std::mem::discriminant(other),
        }
    }

    /// `from + c (self - from)`, where `from` is like it or nothing.
    pub fn between(&self, from: Option<&Self>, c: f64) -> Self {
        let number = |to: f64, from: f64| from + (to - from) * c;
        match (*self, from) {
            (Self::Strain(to), Some(Self::Strain(from))) => Self::Strain(from + (to - from) * c),
            (Self::Strain(to), _) => Self::Strain(to * c),
            (Self::Thermal { .. }, from) => {
                let from = from.map_or(0.0, Self::thermal_strain);
                Self::Thermal {
                    expansion: 1.0,
                    temperature: number(self.thermal_strain(), from),
                }
            }
            (Self::FibreStrain(to), Some(Self::FibreStrain(from))) => {
                Self::FibreStrain(number(to, *from))
            }
            (Self::FibreStrain(to), _) => Self::FibreStrain(number(to, 0.0)),
            (Self::FibreTension(to), Some(Self::FibreTension(from))) => {
                Self::FibreTension(number(to, *from))
            }
            (Self::FibreTension(to), _) => Self::FibreTension(number(to, 0.0)),
            (Self::Tension { along, value }, from) => {
                let from = match from {
                    Some(Self::Tension { value, .. }) => *value,
                    _ => 0.0,
                };
                let value = number(value, from);
                Self::Tension { along, value }
            }
        }
    }

    /// Returns an equal strain in all directions.
    pub fn isotropic(strain: f64) -> Self {
        Self::Strain(Matrix3::identity() * strain)
    }

    /// A strain along a unit vector.
    pub fn along(strain: f64, direction: &Vec3) -> Self {
        let [x, y, z] = [direction.x, direction.y, direction.z];
        let shears = [x * y, y * z, z * x].map(|product| product * strain);
        let [xx, yy, zz] = [x * x, y * y, z * z].map(|square| square * strain);
        Self::Strain(symmetric([xx, yy, zz, shears[0], shears[1], shears[2]]))
    }

    /// All of its numbers but directions; of a change of temperature the strain.
    pub fn numbers(&self) -> Vec<f64> {
        match self {
            Self::Strain(strain) => strain.iter().copied().collect(),
            Self::Thermal { .. } => vec![self.thermal_strain()],
            Self::FibreStrain(number) | Self::FibreTension(number) => vec![*number],
            Self::Tension { value, .. } => vec![*value],
        }
    }

    /// Least principal value of its strain; zero of tensions.
    pub fn least_strain(&self) -> f64 {
        match self {
            Self::Strain(strain) => strain.symmetric_eigenvalues().min(),
            Self::Thermal { .. } => self.thermal_strain(),
            Self::FibreStrain(strain) => *strain,
            Self::FibreTension(_) | Self::Tension { .. } => 0.0,
        }
    }
}

/// A symmetric tensor of the components `xx`, `yy`, `zz`, `xy`, `yz`, `zx`.
fn symmetric([xx, yy, zz, xy, yz, zx]: [f64; 6]) -> Matrix3<f64> {
    Matrix3::new(xx, xy, zx, xy, yy, yz, zx, yz, zz)
}

/// A strain with the components `xx`, `yy`, `zz`, `xy`, `yz`, `zx` in axes of which the first is
/// along the first vector, and the second in the plane of both; `None` where they span none.
pub fn strain_in_axes(components: [f64; 6], [first, second]: [Vec3; 2]) -> Option<Matrix3<f64>> {
    let strain = symmetric(components);
    if [first, second] == [Vec3::x(), Vec3::y()] {
        return Some(strain);
    }
    let x = first.try_normalize(0.0)?;
    let y = second.try_normalize(0.0)?;
    let y = (y - x * x.dot(&y)).try_normalize(1e-9)?;
    let axes = Matrix3::from_columns(&[x, y, x.cross(&y)]);
    let turned = axes * strain * axes.transpose();
    Some((turned + turned.transpose()) * 0.5)
}
