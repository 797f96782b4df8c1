//! A block on a rigid plane that slides as an oblique parallelepiped.
//!
//! With the deformation gradient
//!
//! ```text
//!     | M11 M12 g1 |
//! F = | M21 M22 g2 |     B = F F^T,   sigma = G/J (B - 1) + lambda (J - 1) 1
//!     |  0   0   b |
//! ```
//!
//! the base carries `p = -sigma_zz`, free of `g`, and `tau = -(G b/J) g`. So the
//! friction law, stated for the slip direction `d`, gives the shear `g` directly.
//! The laws are written out here once more, without the kernel of the solver.

use nalgebra::{Matrix2, Matrix3, Rotation2, Vector2};
use striae_law::{
    bulk::{LameConstants, Material},
    friction::{Friction, SlipRule},
};
use striae_mesh::{Vec3, generate::Block};
use striae_model::{
    Axes, Curve, Displacement, Load, LoadExtent, LoadKind, Model, RigidShape, Step,
};
use striae_surface::texture::{Field, Lines, Paint};

use crate::{
    scene::{Places, block, body, increments, model, step},
    table::{Table, coefficient},
};

const G: f64 = 1.0;
const LAMBDA: f64 = 1.5;

/// Friction laws by their formulas. A plane vector is seen from above.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Formula {
    Coulomb(f64),
    /// `mu`, `c_mag`, `c_ang`, `c_cen`.
    TwoTextures([f64; 4]),
    /// Along and across the grooves.
    Opposing([f64; 2]),
    Associated([f64; 2]),
    /// With, against and across the nap.
    Nap([f64; 3]),
    /// By angle from the texture.
    Tabulated(Table),
}

impl Formula {
    pub fn friction(&self) -> Friction {
        let friction = match *self {
            Self::Coulomb(mu) => Friction::coulomb(mu),
            Self::TwoTextures([mu, mag, ang, cen]) => Friction::two_textures(mu, mag, ang, cen),
            Self::Opposing([s, a]) => Friction::orthotropic(s, a, SlipRule::Opposing),
            Self::Associated([s, a]) => Friction::orthotropic(s, a, SlipRule::Associated),
            Self::Nap([f, b, t]) => Friction::nap(f, b, t),
            Self::Tabulated(table) => {
                let angles: Vec<f64> = table.iter().map(|[angle, _]| angle.to_radians()).collect();
                let mu: Vec<f64> = table.iter().map(|[_, mu]| *mu).collect();
                Friction::tabulated(&angles, &mu)
            }
        };
        friction.unwrap()
    }

    /// `tau` for slip along `d` under the pressure `p`; `a` are the textures of
    /// the block and of the floor, both as seen from the block.
    pub fn traction(&self, p: f64, d: Vector2<f64>, a: [Option<Vector2<f64>>; 2]) -> Vector2<f64> {
        let only = || a[0].xor(a[1]).unwrap();
        let w = match *self {
            Self::Coulomb(mu) => mu * d,
            Self::TwoTextures([mu, mag, ang, cen]) => {
                let (own, opposite) = (a[0].unwrap(), a[1].unwrap());
                let (i0, sum) = (own.dot(&opposite), own + opposite);
                mu * ((1.0 + mag * i0) * d + ang * (1.0 + i0) * (cen + sum.dot(&d)) * sum)
            }
            Self::Opposing([along, across]) => {
                let a = only();
                along * d + (across - along) * a.dot(&d) * a
            }
            Self::Associated([along, across]) => {
                let a = only();
                let normal = along.powi(2) * d + (across.powi(2) - along.powi(2)) * a.dot(&d) * a;
                normal / normal.dot(&d).sqrt()
            }
            Self::Nap([f, b, t]) => {
                let e = only();
                t * d + (0.5 * (b + f) - t) * e.dot(&d) * e + 0.5 * (b - f) * e
            }
            Self::Tabulated(table) => coefficient(table, angle_of_slip(d, a)) * d,
        };
        -p * w
    }
}

/// The direction in which the textured surface slips, from its texture, in degrees.
/// Looked at from outside the block, from below, turning is reversed.
pub fn angle_of_slip(d: Vector2<f64>, a: [Option<Vector2<f64>>; 2]) -> f64 {
    let angle = |a: Vector2<f64>| a.perp(&d).atan2(a.dot(&d)).to_degrees();
    match a {
        [Some(own), None] => -angle(own),
        [None, Some(opposite)] => angle(opposite),
        _ => panic!("one surface has a texture"),
    }
}

/// Textures of block and floor by the angles of their `s` at rest, in degrees.
pub type Angles = [Option<f64>; 2];

/// A uniformly sliding block.
#[derive(Clone, Debug)]
pub struct Oblique {
    pub law: Formula,
    pub angles: Angles,
    /// Deformation of the base.
    pub base: Matrix2<f64>,
    /// Stretch of the height.
    pub height: f64,
}

/// Deformation, stress and base traction for one slip direction.
#[derive(Clone, Copy, Debug)]
pub struct Sliding {
    pub direction: Vector2<f64>,
    pub gradient: Matrix3<f64>,
    pub stress: Matrix3<f64>,
    pub pressure: f64,
    pub tau: Vector2<f64>,
}

pub fn material() -> Material {
    Material::neo_hookean(LameConstants {
        lambda: LAMBDA,
        shear: G,
    })
}

pub fn along(degrees: f64) -> Vector2<f64> {
    Rotation2::new(degrees.to_radians()) * Vector2::x()
}

pub fn uniform(degrees: f64) -> Paint {
    Paint::Field(Field {
        lines: Lines::Uniform(along(degrees).push(0.0)),
        turn: 0.0,
    })
}

impl Oblique {
    pub fn new(law: Formula, angles: Angles) -> Self {
        Self {
            law,
            angles,
            base: Matrix2::identity(),
            height: 0.9,
        }
    }

    /// A base that is stretched, sheared and turned.
    pub fn distorted(self) -> Self {
        let base = Rotation2::new(0.2) * Matrix2::new(1.05, 0.12, 0.0, 0.97);
        Self { base, ..self }
    }

    /// Sliding along `d`.
    pub fn sliding(&self, degrees: f64) -> Sliding {
        let b = self.height;
        let j = self.base.determinant() * b;
        let direction = along(degrees);
        let pressure = -(G / j * (b * b - 1.0) + LAMBDA * (j - 1.0));
        // Seen from the block, whose normal points down: a = -e_z x s for both sides.
        let across = |s: Vector2<f64>| Vector2::new(s.y, -s.x).normalize();
        let textures = [
            self.angles[0].map(|angle| across(self.base * along(angle))),
            self.angles[1].map(|angle| across(along(angle))),
        ];
        let tau = self.law.traction(pressure, direction, textures);
        self.bearing(direction, tau)
    }

    /// The state with this traction on the base.
    pub fn bearing(&self, direction: Vector2<f64>, tau: Vector2<f64>) -> Sliding {
        let b = self.height;
        let j = self.base.determinant() * b;
        let shear = tau * (-j / (G * b));
        let mut gradient = Matrix3::zeros();
        gradient.fixed_view_mut::<2, 2>(0, 0).copy_from(&self.base);
        gradient
            .fixed_view_mut::<3, 1>(0, 2)
            .copy_from(&shear.push(b));
        let stress = (gradient * gradient.transpose() - Matrix3::identity()) * (G / j)
            + Matrix3::identity() * (LAMBDA * (j - 1.0));
        Sliding {
            direction,
            gradient,
            stress,
            pressure: -stress[(2, 2)],
            tau,
        }
    }

    /// The block at rest on the plane, without steps.
    pub fn model(&self, block: &Block) -> Model {
        self.model_on(block, crate::scene::plane([0.0; 3], [0.0, 0.0, 1.0]))
    }

    /// Model on any flat floor.
    pub fn model_on(&self, block: &Block, floor: RigidShape) -> Model {
        let mut model = model(vec![body("block", block.mesh().unwrap(), material())]);
        model.touch_rigid(("block", "zmin"), floor, self.law.friction());
        model.pairs[0].textures = self.angles.map(|angle| angle.map(uniform));
        model
    }
}

impl Sliding {
    /// A step that takes the block to this state with its origin at `place`.
    pub fn step(&self, model: &Model, place: Vector2<f64>, count: usize) -> Step {
        let mut step = step();
        step.increments = increments(1.0 / count as f64, 0.01 / count as f64);
        let mesh = &model.bodies[0].mesh;
        let top = model.nodes("block", "zmax").into_iter().map(|node| {
            let x = mesh.positions[node.index()];
            let u = self.gradient * x + place.push(0.0) - x;
            Displacement {
                axes: Axes::Global,
                set: "top".to_owned(),
                body: striae_model::BodyId(0),
                nodes: vec![node],
                components: [u.x, u.y, u.z].map(|u| Some(u.into())),
                curve: Curve::Ramp,
            }
        });
        step.displacements = top.collect();
        step.loads = self.on_sides(model, "block");
        step
    }

    /// Loads on the sides of a block.
    pub fn on_sides(&self, model: &Model, body: &str) -> Vec<Load> {
        let first_piola = self.gradient.determinant()
            * self.stress
            * self.gradient.try_inverse().unwrap().transpose();
        let faces = [
            ("xmin", -Vec3::x()),
            ("xmax", Vec3::x()),
            ("ymin", -Vec3::y()),
            ("ymax", Vec3::y()),
        ];
        let load = |(face, normal): (&str, Vec3)| {
            let traction = LoadKind::DeadTraction(first_piola * normal);
            model.load(body, face, traction, LoadExtent::Whole)
        };
        faces.into_iter().map(load).collect()
    }
}

/// An irregular block of unit base.
pub fn irregular_block() -> Block {
    Block {
        irregularity: 0.2,
        mesh_rotation: 12.0,
        ..block([0.0; 3], [1.0, 1.0, 0.6], [3, 3, 1])
    }
}
