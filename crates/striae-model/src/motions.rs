//! Rigid motions of a body that conditions leave free.
//!
//! A condition on the motion of a point `X` along `e` sees of the rigid motions
//! `u = c + w x (X - X0)` the number `r . (c, w)` with the row
//! `r = (e, (X - X0) x e)`. The motions are stopped when the rows have
//! rank six. Lengths are scaled by the size of the body, `X0` is the mean of its nodes.

use nalgebra::{Matrix6, SymmetricEigen, Vector6};
use striae_mesh::{Mesh, Vec3};

/// Eigenvalue of the normal matrix, relative to the largest, that counts as zero.
const SINGULAR: f64 = 1e-9;
/// Part of a motion along or about an axis that is all of it.
const WHOLE: f64 = 1.0 - 1e-6;

/// The six rigid motions of a body and what stops them.
#[derive(Clone, Debug)]
pub struct RigidMotions {
    centre: Vec3,
    size: f64,
    normal: Matrix6<f64>,
}

impl RigidMotions {
    /// Motions of an unrestrained body.
    pub fn of(mesh: &Mesh) -> Self {
        Self::around(mesh.positions.iter())
    }

    /// Motions of a part of a body with nodes at these places, of which there is at least one.
    pub fn around<'x>(positions: impl Iterator<Item = &'x Vec3> + Clone) -> Self {
        let count = positions.clone().count() as f64;
        let centre = positions.clone().sum::<Vec3>() / count;
        let arms = positions.map(|x| (x - centre).norm());
        Self {
            centre,
            size: arms.fold(f64::MIN_POSITIVE, f64::max),
            normal: Matrix6::zeros(),
        }
    }

    /// Stops the point `x` along `e`.
    pub fn stop(&mut self, x: &Vec3, e: &Vec3) {
        let arm = ((x - self.centre) / self.size).cross(e);
        let row = Vector6::new(e.x, e.y, e.z, arm.x, arm.y, arm.z);
        self.normal += row * row.transpose();
    }

    /// Number of motions that are left.
    pub fn left(&self) -> usize {
        let eigenvalues = self.normal.symmetric_eigenvalues();
        let largest = eigenvalues.max();
        let is_zero = |value: &&f64| **value <= SINGULAR * largest;
        eigenvalues.iter().filter(is_zero).count()
    }

    /// The motions that are left, such as `along x, along y and about z`; those about
    /// other axes are only counted. Empty where none is left.
    pub fn words(&self) -> String {
        const WORDS: [&str; 6] = [
            "along x", "along y", "along z", "about x", "about y", "about z",
        ];
        let eigen = SymmetricEigen::new(self.normal);
        let largest = eigen.eigenvalues.max();
        let null: Vec<usize> = (0..6)
            .filter(|&at| eigen.eigenvalues[at] <= SINGULAR * largest)
            .collect();
        let part = |axis: usize| -> f64 {
            let squares = null
                .iter()
                .map(|&at| eigen.eigenvectors[(axis, at)].powi(2));
            squares.sum()
        };
        let named = (0..6).filter(|&axis| part(axis) > WHOLE);
        let mut words: Vec<String> = named.map(|axis| WORDS[axis].to_owned()).collect();
        match null.len() - words.len() {
            0 => {}
            1 if words.is_empty() => words.push("in one oblique way".to_owned()),
            others if words.is_empty() => words.push(format!("in {others} oblique ways")),
            others => words.push(format!("in {others} other ways")),
        }
        match &words[..] {
            [rest @ .., last] if !rest.is_empty() => format!("{} and {last}", rest.join(", ")),
            _ => words.concat(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use striae_mesh::generate::Block;

    fn cube() -> Mesh {
        Block::default().mesh().expect("a cube")
    }

    fn held(nodes: &str, axes: &[usize]) -> RigidMotions {
        let mesh = cube();
        let mut motions = RigidMotions::of(&mesh);
        for node in mesh.node_sets.get(nodes).expect("a side") {
            for &axis in axes {
                motions.stop(&mesh.positions[node.index()], &Vec3::ith(axis, 1.0));
            }
        }
        motions
    }

    #[test]
    fn motions_that_are_left_are_counted_and_named() {
        let free = RigidMotions::of(&cube());
        assert_eq!(free.left(), 6);
        assert!(free.words().starts_with("along x, along y, along z"));
        let flat = held("zmin", &[2]);
        assert_eq!(
            (flat.left(), flat.words().as_str()),
            (3, "along x, along y and about z")
        );
        let clamped = held("zmin", &[0, 1, 2]);
        assert_eq!((clamped.left(), clamped.words().as_str()), (0, ""));
    }

    #[test]
    fn a_point_that_is_held_leaves_the_turns_about_it() {
        let mesh = cube();
        let mut motions = RigidMotions::of(&mesh);
        for axis in 0..3 {
            motions.stop(&mesh.positions[0], &Vec3::ith(axis, 1.0));
        }
        assert_eq!(
            (motions.left(), motions.words().as_str()),
            (3, "in 3 oblique ways")
        );
    }
}
