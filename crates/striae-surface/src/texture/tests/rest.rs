//! Painting in the reference configuration.

use num_dual::Dual64;
use striae_mesh::Vec3;
use striae_verify::Random;

use super::shapes::*;
use crate::texture::{Axes, Field, Lines, Paint};

/// Curved, uneven, with triangles.
fn rough_torus() -> Shape {
    let map = |u, v| {
        let (u, v) = uneven(u, v);
        torus(u, v)
    };
    Shape::patch(6, map).partly_triangular()
}

#[test]
fn the_painted_direction_is_exact_at_every_node() {
    let shape = rough_torus();
    let mut random = Random::new(1);
    let directions: Vec<Vec3> = shape.positions.iter().map(|_| random.vector3()).collect();
    let texture = shape.painted(&Paint::Nodal(directions.clone()));
    for (node, axes) in shape.axes(&texture).iter().enumerate() {
        let n = shape.normals()[node];
        let tangent = directions[node] - n * n.dot(&directions[node]);
        assert!((axes.s - tangent.normalize()).norm() < 1e-12, "{node}");
        assert!((axes.a - n.cross(&axes.s)).norm() < 1e-15);
        assert!(axes.s.dot(&n).abs() < 1e-15 && (axes.a.norm() - 1.0).abs() < 1e-15);
    }
}

#[test]
fn a_constant_field_on_a_plane_keeps_its_direction() {
    let shape = Shape::patch(7, plane).partly_triangular();
    let direction = Vec3::new(0.5, -0.8, 0.9);
    let n = shape.normals()[0];
    let expected = Axes::along(direction, n).unwrap();
    let places = [0.1, 0.5, 0.9].map(|u| (plane(u, u * u), direction));
    let points = Paint::Points {
        directions: places.to_vec(),
        width: None,
    };
    for paint in [uniform(direction), points] {
        for axes in shape.axes(&shape.painted(&paint)) {
            assert!(difference(&axes, &expected) < 1e-13);
        }
    }
}

#[test]
fn a_helix_on_a_cylinder_has_the_same_pitch_everywhere() {
    let shape = Shape::tube(12, 5);
    for axes in shape.axes(&shape.painted(&helices(0.4))) {
        assert!((axes.s.z - 0.4f64.sin()).abs() < 1e-14);
    }
}

#[test]
fn fields_about_an_axis_point_along_cylinder_coordinates() {
    let point = Vec3::new(3.0, 4.0, 7.0);
    let (e_r, e_phi) = (Vec3::new(0.6, 0.8, 0.0), Vec3::new(-0.8, 0.6, 0.0));
    let s = |lines, normal| {
        let field = Field { lines, turn: 0.0 };
        field.axes(point, normal).unwrap().s
    };
    assert!((s(Lines::Circumferential(z_axis()), e_r) - e_phi).norm() < 1e-15);
    assert!((s(Lines::Axial(z_axis()), e_r) - Vec3::z()).norm() < 1e-15);
    assert!((s(Lines::Radial(z_axis()), Vec3::z()) - e_r).norm() < 1e-15);
}

#[test]
fn turning_is_counter_clockwise_seen_from_outside() {
    let field = Field {
        lines: Lines::Uniform(Vec3::x() * 5.0),
        turn: 0.3,
    };
    let axes = field.axes(Vec3::zeros(), Vec3::z()).unwrap();
    assert!((axes.s - Vec3::new(0.3f64.cos(), 0.3f64.sin(), 0.0)).norm() < 1e-15);
    assert!((axes.a - Vec3::new(-(0.3f64.sin()), 0.3f64.cos(), 0.0)).norm() < 1e-15);
}

#[test]
fn circles_on_a_rigid_plane_turn_with_the_point() {
    let field = Field {
        lines: Lines::Circumferential(z_axis()),
        turn: 0.7,
    };
    // d s/d phi = a and d a/d phi = -s along a circle; along a ray nothing changes.
    let (x, y): (f64, f64) = (1.5, -0.4);
    let n = Vec3::z().map(Dual64::from);
    let along = |dx: f64, dy: f64| {
        let point = nalgebra::Vector3::new(Dual64::new(x, dx), Dual64::new(y, dy), 0.0.into());
        field.axes(point, n).unwrap()
    };
    let circle = along(-y, x);
    let ray = along(x, y);
    for i in 0..3 {
        assert!((circle.s[i].eps - circle.a[i].re).abs() < 1e-15);
        assert!((circle.a[i].eps + circle.s[i].re).abs() < 1e-15);
        assert!(ray.s[i].eps.abs() < 1e-15);
    }
}
