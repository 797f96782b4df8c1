//! Rigid bodies: pose, ties and inertia.
//!
//! A rigid body has six coordinates: the displacement `u` of its reference point
//! `c` and the angles `t` it has turned about the fixed axes, increment by increment,
//!
//! ```text
//! x = c + u + R (X - c),   R_1 = exp[dt x] R_0,   dx = du + (T(dt) d(dt)) x r,
//! T(t) = sin|t|/|t| I + (1 - cos|t|)/|t|^2 [t x] + (1 - sin|t|/|t|)/|t|^2 t t^T
//! ```
//!
//! with the arm `r = x - c - u`; so a body may turn any number of times. About a
//! single axis the angle is the usual one. Nodes tied to it are eliminated: their
//! forces `f` act on it as `sum f` and `sum r x f`. Its mass and principal
//! moments of inertia are those of six point masses that are tied to it, two on
//! each axis at `sqrt(3) s_i` with `m s_1^2 = (J_2 + J_3 - J_1)/2`.

use nalgebra::{Matrix3, Rotation3};
use serde::{Deserialize, Serialize};
use striae_contact::placement::Placement;
use striae_mesh::Vec3;

use striae_model::{Model, RigidInertia, node::GlobalNode};

/// Pose of a rigid body.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Pose {
    /// Displacement of the reference point.
    pub displacement: Vec3,
    /// Angles turned about the fixed axes.
    pub turned: Vec3,
    /// Rotation `R`.
    pub rotation: Matrix3<f64>,
}

/// Force and torque about the reference point on a rigid body.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Wrench {
    /// Force.
    pub force: Vec3,
    /// Torque.
    pub torque: Vec3,
}

impl Wrench {
    /// Force, then torque.
    pub fn components(&self) -> [f64; 6] {
        let ([x, y, z], [a, b, c]) = (self.force.into(), self.torque.into());
        [x, y, z, a, b, c]
    }

    /// From force, then torque.
    pub(crate) fn from_components(components: &[f64; 6]) -> Self {
        Self {
            force: Vec3::from_column_slice(&components[..3]),
            torque: Vec3::from_column_slice(&components[3..]),
        }
    }
}

impl Pose {
    /// Initial pose of a body.
    pub fn at_rest() -> Self {
        Self {
            displacement: Vec3::zeros(),
            turned: Vec3::zeros(),
            rotation: Matrix3::identity(),
        }
    }

    /// All six coordinates.
    pub fn coordinates(&self) -> [f64; 6] {
        let ([x, y, z], [a, b, c]) = (self.displacement.into(), self.turned.into());
        [x, y, z, a, b, c]
    }

    /// The pose with other coordinates, turned from this one.
    pub fn moved_to(&self, coordinates: &[f64; 6]) -> Self {
        let displacement = Vec3::from_column_slice(&coordinates[..3]);
        let turned = Vec3::from_column_slice(&coordinates[3..]);
        let turn = turned - self.turned;
        let rotation = if turn == Vec3::zeros() {
            self.rotation
        } else {
            Rotation3::new(turn).matrix() * self.rotation
        };
        Self {
            displacement,
            turned,
            rotation,
        }
    }

    /// As a motion of space; `reference` is the reference point.
    pub fn placement(&self, reference: &Vec3) -> Placement {
        Placement {
            rotation: self.rotation,
            shift: self.displacement + (reference - self.rotation * reference),
        }
    }
}

/// `T(t)`, from changes of the angles to turns in space.
pub(crate) fn turn_tangent(turn: &Vec3) -> Matrix3<f64> {
    let angle = turn.norm();
    if angle < 1e-6 {
        return Matrix3::identity() + turn.cross_matrix() * 0.5;
    }
    let share = angle.sin() / angle;
    Matrix3::identity() * share
        + turn.cross_matrix() * ((1.0 - angle.cos()) / (angle * angle))
        + turn * turn.transpose() * ((1.0 - share) / (angle * angle))
}

/// Places of six equal masses with the inertia.
pub(crate) fn mass_points(inertia: &RigidInertia) -> [Vec3; 6] {
    let [a, b, c] = inertia.moments;
    let squares = [b + c - a, c + a - b, a + b - c].map(|sum| 0.5 * sum / inertia.mass);
    std::array::from_fn(|at| {
        let sign = if at % 2 == 0 { 1.0 } else { -1.0 };
        let arm = sign * (3.0 * squares[at / 2].max(0.0)).sqrt();
        inertia.centre + inertia.axes.column(at / 2) * arm
    })
}

/// Nodes tied to every rigid body, and mass points, which join the reference positions.
pub(crate) fn ties(
    model: &Model,
    first_node: &[usize],
    reference: &mut Vec<Vec3>,
) -> (Vec<Vec<GlobalNode>>, Vec<(GlobalNode, f64)>) {
    let mut heavy = Vec::new();
    let tied = model.rigid_surfaces.iter().map(|rigid| {
        let nodes = rigid.ties.iter().flat_map(|(body, nodes)| {
            let first = first_node[body.0];
            nodes
                .iter()
                .map(move |node| GlobalNode(first + node.index()))
        });
        let mut nodes: Vec<GlobalNode> = nodes.collect();
        nodes.sort_unstable();
        nodes.dedup();
        if let Some(inertia) = &rigid.inertia {
            for place in mass_points(inertia) {
                nodes.push(GlobalNode(reference.len()));
                heavy.push((GlobalNode(reference.len()), inertia.mass / 6.0));
                reference.push(place);
            }
        }
        nodes
    });
    let tied = tied.collect();
    (tied, heavy)
}

/// Velocity of the reference point, which is at `point`, and angular velocity that fit the
/// velocities of the nodes `tied` to a rigid body best.
pub fn fitted_velocity(
    point: &Vec3,
    tied: &[GlobalNode],
    positions: &[Vec3],
    velocities: &[Vec3],
) -> [Vec3; 2] {
    let mut normal = nalgebra::Matrix6::<f64>::zeros();
    let mut right = nalgebra::Vector6::<f64>::zeros();
    for &node in tied {
        let mut row = nalgebra::Matrix3x6::<f64>::zeros();
        row.fixed_view_mut::<3, 3>(0, 0)
            .copy_from(&Matrix3::identity());
        row.fixed_view_mut::<3, 3>(0, 3)
            .copy_from(&-(positions[node] - point).cross_matrix());
        normal += row.transpose() * row;
        right += row.transpose() * velocities[node];
    }
    let solution = normal
        .pseudo_inverse(1e-12 * normal.norm())
        .map_or_else(|_| nalgebra::Vector6::zeros(), |inverse| inverse * right);
    [
        solution.fixed_rows::<3>(0).into(),
        solution.fixed_rows::<3>(3).into(),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_have_the_inertia() {
        let centre = Vec3::new(0.3, -0.2, 0.5);
        let axes = Rotation3::new(Vec3::new(0.4, 0.1, -0.3)).into_inner();
        let inertia = RigidInertia {
            axes,
            ..RigidInertia::aligned(3.0, centre, [2.0, 2.5, 1.5])
        };
        let points = mass_points(&inertia);
        let mass = inertia.mass / 6.0;
        let sum: Vec3 = points.iter().sum();
        assert!((sum / 6.0 - centre).norm() < 1e-15);
        let arms = points.map(|x| x - centre);
        let turned = arms.map(|r| Matrix3::identity() * r.norm_squared() - r * r.transpose());
        let found = turned.iter().sum::<Matrix3<f64>>() * mass;
        let expected = axes * Matrix3::from_diagonal(&inertia.moments.into()) * axes.transpose();
        assert!((found - expected).norm() < 1e-14, "{found}");
    }

    #[test]
    fn tangent_turns_as_the_exponential_does() {
        let turn = Vec3::new(0.3, -0.7, 0.4);
        let change = Vec3::new(0.1, 0.2, -0.3);
        let h = 1e-6;
        let at = |s: f64| *Rotation3::new(turn + change * s).matrix();
        let spin = (at(h) - at(-h)) / (2.0 * h) * at(0.0).transpose();
        let claimed = (turn_tangent(&turn) * change).cross_matrix();
        assert!((spin - claimed).norm() < 1e-9);
    }

    #[test]
    fn turns_add_up() {
        let mut pose = Pose::at_rest();
        for count in 1..=100 {
            pose = pose.moved_to(&[0.0, 0.0, 0.0, 0.0, 0.5 * f64::from(count), 0.0]);
        }
        let expected = Rotation3::new(Vec3::new(0.0, 50.0, 0.0));
        assert!((pose.rotation - expected.matrix()).norm() < 1e-13);
    }
}
