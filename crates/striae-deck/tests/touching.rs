//! Contact at a gap of zero that nothing presses: round-off must not decide.

mod driven;

use driven::last;
use striae_contact::side::Side;
use striae_mesh::Vec3;
use striae_solve::report::pairs;

/// Forces of a floor and a wall on a block that is pressed onto the floor and drawn along the wall
/// with its top held at the wall, in a scene that is shifted as a whole.
fn forces(shift: Vec3) -> Vec<Vec3> {
    let [x, y, z] = shift.into();
    let displacements = |x: f64| {
        format!(
            r#"displacement = [{{ body = "block", nodes = "zmax", x = {x}, y = 0, z = -0.01 }}]"#
        )
    };
    let steps = [0.0, 0.004, 0.03].map(|x| {
        format!(
            "[[step]]\nname = \"to {x}\"\nincrements = 2\n{}\n",
            displacements(x)
        )
    });
    let (problem, state) = last(&format!(
        r#"
title = "Along a wall"
[[material]]
name = "solid"
law = "linear-elastic"
youngs_modulus = 1e6
poissons_ratio = 0.3
[[body]]
name = "block"
material = "solid"
mesh = {{ generator = "block", origin = [{x}, {y}, {z}], size = [1, 0.5, 0.5], divisions = [4, 2, 2] }}
[[rigid]]
name = "floor"
plane = {{ point = [0, 0, {z}], normal = [0, 0, 1] }}
[[rigid]]
name = "wall"
plane = {{ point = [0, {y}, 0], normal = [0, 1, 0] }}
[[pair]]
name = "down"
a = {{ body = "block", facets = "zmin" }}
b = {{ rigid = "floor" }}
friction = {{ law = "coulomb", mu = 0.3 }}
[[pair]]
name = "aside"
a = {{ body = "block", facets = "ymin" }}
b = {{ rigid = "wall" }}
friction = {{ law = "coulomb", mu = 0.3 }}
{}"#,
        steps.concat()
    ));
    let pairs = pairs(&problem, &state);
    pairs.iter().map(|pair| pair.sides[Side::A].force).collect()
}

#[test]
fn a_shift_of_the_scene_changes_no_force() {
    let own = forces(Vec3::zeros());
    let largest = own.iter().map(Vec3::norm).fold(0.0, f64::max);
    for shift in [
        Vec3::new(0.1, 0.3, 0.7),
        Vec3::new(-1.3, 2.1, -0.45),
        Vec3::new(130.7, -210.3, 45.1),
    ] {
        for (own, shifted) in own.iter().zip(forces(shift)) {
            let off = (own - shifted).norm() / largest;
            assert!(off < 1e-7, "{shift}: {off:e}");
        }
    }
}
