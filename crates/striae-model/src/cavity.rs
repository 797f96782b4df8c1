//! Cavities: closed inner surfaces of bodies with a pressure inside.
//!
//! With the outward normal `n` of the bodies, a field `D (x - x_0)` of divergence one and the unit
//! pressure's forces `g_i` on the nodes of the surface, which press on the bodies,
//!
//! ```text
//! V = -integral D (x - x_0) . n da = sum D (x_i - x_0) . g_i,   g_i = -integral N_i n da
//! dV = sum g_i . dx_i
//! ```
//!
//! all by two Gauss points a direction, which integrate bilinear facets exactly. The second equation
//! holds for closed surfaces, and for those with rims that stay in planes in which the field lies: at
//! a plane of symmetry, where the volume is the part of the whole on this side. The pressure `p` over
//! that of the surroundings is an unknown of its own, with the row
//!
//! ```text
//! V - V_c = 0     for a volume V_c that is prescribed,
//! V - V_s ((P + p_s)/(P + p))^(1/n) = 0     for a gas that was sealed in at the pressure p_s
//! ```
//!
//! with the pressure `P` of the surroundings and the polytropic exponent `n`, or with `p` prescribed.
//! So the matrix stays sparse, and with `-g` in the column of `p` it is symmetric.

mod rim;

pub use rim::{Field, RimFault};

use striae_mesh::Vec3;

use crate::{
    load::{FaceLoad, LoadError, response},
    model::{CavityContent, LoadKind, Model, Moment, Value},
    node::GlobalNode,
    plan::{PlannedCavity, StepPlan},
};

/// Surface of a cavity.
#[derive(Clone, Debug, PartialEq)]
pub struct CavitySurface {
    /// Corners of its faces.
    pub faces: Vec<[GlobalNode; 4]>,
    /// Field by which volumes are counted.
    pub field: Field,
    /// Volume at the start.
    pub volume: f64,
}

/// Content of a cavity at a point of a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Content {
    /// Prescribed pressure over that of the surroundings.
    Pressure(f64),
    /// Prescribed volume.
    Volume(f64),
    /// Gas, by pressure and volume when it was sealed in.
    Gas {
        /// Pressure over that of the surroundings.
        pressure: f64,
        /// Volume.
        volume: f64,
        /// Pressure of the surroundings.
        ambient: f64,
        /// Polytropic exponent.
        exponent: f64,
    },
}

impl Content {
    /// Volume at a pressure and its derivative; `None` where the pressure is given, and where a gas
    /// has none.
    pub fn volume(&self, pressure: f64) -> Option<[f64; 2]> {
        match *self {
            Self::Pressure(_) => None,
            Self::Volume(volume) => Some([volume, 0.0]),
            Self::Gas {
                pressure: sealed,
                volume,
                ambient,
                exponent,
            } => {
                let ratio = (ambient + sealed) / (ambient + pressure);
                let filled = volume * ratio.powf(1.0 / exponent);
                let slope = -filled / (exponent * (ambient + pressure));
                (ratio > 0.0 && filled.is_finite()).then_some([filled, slope])
            }
        }
    }
}

impl CavitySurface {
    /// Volume with the nodes at `positions`.
    ///
    /// # Errors
    /// Where a face has collapsed.
    pub fn volume(&self, reference: &[Vec3], positions: &[Vec3]) -> Result<f64, LoadError> {
        let mut volume = 0.0;
        for corners in &self.faces {
            let load = pressed(corners, reference, positions)?;
            volume += self.part(corners, &load, positions);
        }
        Ok(volume)
    }

    /// Part of the volume that belongs to a face, by the forces of a unit pressure on it.
    pub fn part(&self, corners: &[GlobalNode; 4], load: &FaceLoad, positions: &[Vec3]) -> f64 {
        let forces = load.force.chunks_exact(3).map(Vec3::from_column_slice);
        let parts = corners.iter().zip(forces);
        let parts = parts.map(|(corner, force)| {
            (self.field.slope * (positions[*corner] - self.field.origin)).dot(&force)
        });
        parts.sum()
    }
}

/// Forces of a unit pressure on the corners of a face.
pub fn pressed(
    corners: &[GlobalNode; 4],
    reference: &[Vec3],
    positions: &[Vec3],
) -> Result<FaceLoad, LoadError> {
    let [reference, current] = [reference, positions].map(|x| corners.map(|node| x[node]));
    response(
        &LoadKind::Pressure(Value::Number(1.0)),
        &reference,
        &current,
    )
}

/// Surfaces of all cavities of a model with the nodes at rest at `reference`.
pub fn surfaces(
    model: &Model,
    first_node: &[usize],
    (reference, plans): (&[Vec3], &[StepPlan]),
) -> Vec<CavitySurface> {
    let surface = |cavity: usize| {
        let parts = model.cavities[cavity].parts.iter();
        let faces = parts.flat_map(|(body, faces)| {
            let mesh = &model.bodies[body.0].mesh;
            let global = |node: striae_mesh::NodeId| GlobalNode(first_node[body.0] + node.index());
            faces
                .iter()
                .map(move |face| mesh.face_nodes(*face).map(global))
        });
        let faces: Vec<[GlobalNode; 4]> = faces.collect();
        let mut surface = CavitySurface {
            field: rim::field(model, cavity, plans).unwrap_or(Field {
                origin: Vec3::zeros(),
                slope: nalgebra::Matrix3::identity() / 3.0,
            }),
            faces,
            volume: 0.0,
        };
        surface.volume = surface.volume(reference, reference).unwrap_or(0.0);
        surface
    };
    (0..model.cavities.len()).map(surface).collect()
}

/// Volume of a cavity of a model at rest.
///
/// # Errors
/// Why its surface encloses none.
pub fn enclosed(model: &Model, cavity: usize) -> Result<f64, RimFault> {
    let plans = crate::plan::plans(model);
    rim::field(model, cavity, &plans)?;
    let first_node = crate::tie::first_nodes(model);
    let positions = model.bodies.iter().flat_map(|body| &body.mesh.positions);
    let reference: Vec<Vec3> = positions.copied().collect();
    Ok(surfaces(model, &first_node, (&reference, &plans))[cavity].volume)
}

impl PlannedCavity {
    /// Content at a moment of a step that finds a pressure and a volume, of a cavity with a volume at
    /// rest.
    pub fn content(&self, [pressure, volume]: [f64; 2], rest: f64, moment: Moment) -> Content {
        let along = |at_rest: f64, from: f64, target: f64| match &self.curve {
            None => from,
            Some(curve) => {
                let from = curve.origin(from, at_rest);
                from + (target - from) * curve.at(moment)
            }
        };
        match self.content {
            CavityContent::Pressure(target) => Content::Pressure(along(0.0, pressure, target)),
            CavityContent::Volume(target) => Content::Volume(along(rest, volume, target)),
            CavityContent::VolumeRatio(ratio) => Content::Volume(along(rest, volume, ratio * rest)),
            CavityContent::Gas { ambient, exponent } => Content::Gas {
                pressure,
                volume,
                ambient,
                exponent,
            },
        }
    }
}
