//! Sums over the quadrature points of a facet.

use serde::{Deserialize, Serialize};
use striae_mesh::Vec3;
use striae_surface::facet::Weights;

/// Forces of the contact tractions on the corners of a facet.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct FacetForces {
    /// Force on each corner.
    pub force: [Vec3; 4],
    /// Area that belongs to each corner, `integral N_J da`.
    pub area: [f64; 4],
    /// Area of the points under pressure.
    pub pressed: f64,
    /// `integral p da`.
    pub pressure: f64,
    /// `integral |tau| da`.
    pub friction: f64,
}

impl FacetForces {
    /// Adds the forces on another part of the facet.
    pub fn add(&mut self, other: &Self) {
        for corner in 0..4 {
            self.force[corner] += other.force[corner];
            self.area[corner] += other.area[corner];
        }
        self.pressed += other.pressed;
        self.pressure += other.pressure;
        self.friction += other.friction;
    }
}

/// Lanes of the corners of a facet.
pub const LANES: usize = 40;

/// Forces on the four corners and their derivatives.
pub struct Integral {
    /// The forces.
    pub force: [Vec3; 4],
    /// Their derivatives lane by lane.
    pub slopes: [[f64; 12]; LANES],
}

impl Integral {
    /// Nothing yet.
    pub fn zero() -> Self {
        Self {
            force: [Vec3::zeros(); 4],
            slopes: [[0.0; 12]; LANES],
        }
    }

    /// Adds the forces to those of the facet.
    pub fn report(&self, sum: &mut FacetForces) {
        for corner in 0..4 {
            sum.force[corner] += self.force[corner];
        }
    }

    /// Adds a quadrature point of the weight `w`.
    pub fn add(
        &mut self,
        weights: &Weights<f64>,
        density: &Density,
        w: f64,
        sum: &mut FacetForces,
    ) {
        let area = w * density.area;
        sum.pressure += area * density.pressure;
        if density.pressure > 0.0 {
            sum.pressed += area;
        }
        sum.friction += area * density.friction;
        for corner in 0..4 {
            self.force[corner] += density.force * (weights.value[corner] * w);
            sum.area[corner] += area * weights.value[corner];
        }
        for (slope, by_lane) in self.slopes.iter_mut().zip(&density.gradient) {
            for corner in 0..4 {
                for axis in 0..3 {
                    slope[3 * corner + axis] += by_lane[axis] * (weights.value[corner] * w);
                }
            }
        }
    }
}

/// The contact force per `d xi d eta` at a point.
pub struct Density {
    /// The force.
    pub force: Vec3,
    /// Its derivatives lane by lane.
    pub gradient: [[f64; 3]; LANES],
    /// Its derivative by `xi`.
    pub d_xi: Vec3,
    /// Its derivative by `eta`.
    pub d_eta: Vec3,
    /// Area per `d xi d eta`.
    pub area: f64,
    /// Pressure.
    pub pressure: f64,
    /// Magnitude of the friction traction.
    pub friction: f64,
}

impl Density {
    /// Derivatives of the forces on the corners by the coordinates, over the weight, and
    /// by the weight of the point.
    pub fn moved(&self, weights: &Weights<f64>) -> [[f64; 12]; 3] {
        let mut moved = [[0.0; 12]; 3];
        for corner in 0..4 {
            let value = weights.value[corner];
            let by_xi = self.d_xi * value + self.force * weights.d_xi[corner];
            let by_eta = self.d_eta * value + self.force * weights.d_eta[corner];
            for (rows, by) in moved.iter_mut().zip([by_xi, by_eta, self.force * value]) {
                rows[3 * corner..3 * corner + 3].copy_from_slice(by.as_slice());
            }
        }
        moved
    }
}
