//! Friction and pressure of a contact face as one force each.
//!
//! If everything slips in one direction `e`, friction is `tau = -mu p d` with `d` along `(I - n n)
//! e`. The forces along and across a fixed direction do not obey the law, as the face tilts when it
//! is sheared. Those along and across
//!
//! ```text
//! n_m = N/|N|,   N = integral p n da;      P' = -F . n_m,   Q' = |F + P' n_m|
//! ```
//!
//! do: with `n = n_m + theta`, `integral p theta da` has no part along the face, by the
//! choice of `n_m`, and terms of first order drop out. What is left is of second order:
//! pressures that are not parallel partly cancel, friction does so only along `e`,
//!
//! ```text
//! Q'/P' = mu (1 + <theta_s^2>/2) + O(theta^3)
//! ```
//!
//! with the mean square, weighted by pressure, of the slope across the motion. A
//! direction off by an angle `t` in the plane of the motion gives
//! `tan(atan mu +- t)` instead.
//!
//! Half spaces of equal material tilt together: friction `mu p` under Hertz's pressure
//! lifts both surfaces by `(1 - 2 nu) Q(r) cos(phi)/(4 pi G r)`, where `Q(r)` is the
//! friction within the radius (Cerruti; Johnson 1985, section 3.6), so that the slope,
//! weighted by pressure, is `3 (1 - 2 nu) mu p0/(16 G)`.

use striae_contact::side::Side;
use striae_mesh::Vec3;
use striae_surface::facet::{Shape, area_vector};

use super::{
    measure::{facets, surface_nodes},
    study::Run,
};

/// The face between the sides of the first pair under pressure, at the end of a run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContactFace {
    /// Mean normal `n_m`, outward.
    pub normal: Vec3,
    /// Force `P'` across the face.
    pub across: f64,
    /// Force `Q'` along it.
    pub along: f64,
    /// Mean square `<theta_s^2>` of the slope across the motion.
    pub slope_square: f64,
}

impl ContactFace {
    /// The face between both sides, with the normal of the first, on which the force `F`
    /// acts. Equal bodies pass pressure along the mean of both normals.
    pub fn between(run: &Run, force: Vec3) -> Self {
        let mut pressed = pressed_areas(run, Side::A);
        let other = pressed_areas(run, Side::B).into_iter();
        pressed.extend(other.map(|(p, area)| (p, -area)));
        Self::of(&pressed, force)
    }

    fn of(pressed: &[(f64, Vec3)], force: Vec3) -> Self {
        let sum: Vec3 = pressed.iter().map(|(p, area)| area * *p).sum();
        let normal = sum.normalize();
        let across = -force.dot(&normal);
        let along = force + normal * across;
        let sideways = normal.cross(&along).normalize();
        let (mut weights, mut squares) = (0.0, 0.0);
        for (p, area) in pressed {
            weights += p * area.norm();
            squares += p * area.norm() * area.normalize().dot(&sideways).powi(2);
        }
        Self {
            normal,
            across,
            along: along.norm(),
            slope_square: squares / weights,
        }
    }

    /// `Q'/P'`.
    pub fn ratio(&self) -> f64 {
        self.along / self.across
    }

    /// `Q'/P'` of the flat face that slips by the same law.
    pub fn flat_ratio(&self) -> f64 {
        self.ratio() / (1.0 + 0.5 * self.slope_square)
    }

    /// Angle of the normal from the vertical.
    pub fn tilt(&self) -> f64 {
        self.normal.xy().norm().atan2(self.normal.z.abs())
    }
}

/// Pressure and area vector of the quadrature points of all facets.
fn pressed_areas(run: &Run, side: Side) -> Vec<(f64, Vec3)> {
    let nodes = surface_nodes(run, side);
    let place = 1.0 / 3.0_f64.sqrt();
    let places = [-place, place];
    let points = places.map(|xi| places.map(|eta| Shape::Quadrilateral.weights(xi, eta)));
    let mut all = Vec::new();
    for facet in facets(run, side) {
        let corners = facet.map(|corner| &nodes[corner]);
        let positions = corners.map(|node| node.position);
        for weights in points.as_flattened() {
            let parts = corners.iter().zip(weights.value);
            let pressure: f64 = parts.map(|(node, w)| w * node.result.pressure).sum();
            if pressure > 0.0 {
                all.push((pressure, area_vector(weights, &positions)));
            }
        }
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;
    use striae_verify::fitted_rate;

    const MU: f64 = 0.3;

    /// Hertz's pressure on a shallow bowl tilted by an angle about `y`, all of which
    /// slips along `x` on this side: areas and the exact force.
    fn bowl(depth: f64, tilt: f64) -> (Vec<(f64, Vec3)>, Vec3) {
        const PARTS: usize = 200;
        let turn = nalgebra::Rotation3::from_axis_angle(&Vec3::y_axis(), tilt);
        let along = turn * Vec3::x();
        let (mut pressed, mut force) = (Vec::new(), Vec3::zeros());
        for i in 0..PARTS * PARTS {
            let share = |part: usize| (part as f64 + 0.5) / PARTS as f64;
            let (r, phi) = (
                share(i / PARTS),
                2.0 * std::f64::consts::PI * share(i % PARTS),
            );
            let slope = depth * r;
            let area = turn * Vec3::new(slope * phi.cos(), slope * phi.sin(), 1.0) * r;
            let p = (1.0 - r * r).sqrt();
            let n = area.normalize();
            let d = (along - n * n.dot(&along)).normalize();
            force -= (n + d * MU) * (p * area.norm());
            pressed.push((p, area));
        }
        (pressed, force)
    }

    #[test]
    fn a_flat_face_obeys_the_law_across_its_normal_however_it_tilts() {
        for tilt in [0.0, 0.02, -0.1] {
            let (pressed, force) = bowl(0.0, tilt);
            let face = ContactFace::of(&pressed, force);
            assert!((face.ratio() - MU).abs() < 1e-12);
            assert!((face.tilt() - f64::abs(tilt)).abs() < 1e-12);
            let fixed = (force.x / force.z).abs();
            assert!(
                (fixed - (MU.atan() + tilt).tan().abs()).abs() < 1e-12,
                "{fixed}"
            );
        }
    }

    #[test]
    fn a_bowl_is_off_by_half_the_mean_square_of_its_slope() {
        let depths = [0.2, 0.1];
        let errors = depths.map(|depth| {
            let (pressed, force) = bowl(depth, 0.02);
            let face = ContactFace::of(&pressed, force);
            // <r^2> under Hertz's pressure is 2/5, half of it across.
            assert!((face.slope_square / (0.2 * depth * depth) - 1.0).abs() < 0.03);
            assert!((face.ratio() / MU - 1.0).abs() > 0.09 * depth * depth);
            (face.flat_ratio() / MU - 1.0).abs()
        });
        assert!(fitted_rate(&depths, &errors) > 3.5, "{errors:?}");
    }
}
