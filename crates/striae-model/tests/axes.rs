//! Faults of displacements in axes of their own, by path and words.

use striae_law::bulk::{LameConstants, Material};
use striae_mesh::{Vec3, generate::Block};
use striae_model::{Axes, StepBuilder, body, model, step};

const FREE: [Option<f64>; 3] = [None; 3];

/// The faults of a block with these steps.
fn faults(steps: Vec<StepBuilder>) -> String {
    let mesh = Block {
        divisions: [2, 2, 2],
        ..Block::default()
    };
    let constants = LameConstants::from_youngs_modulus(1.0, 0.3).unwrap();
    let block = body(
        "block",
        mesh.mesh().unwrap(),
        Material::neo_hookean(constants),
    );
    let whole = steps
        .into_iter()
        .fold(model("a block").body(block), |whole, step| whole.step(step));
    match whole.build() {
        Ok(_) => String::new(),
        Err(faults) => faults.to_string(),
    }
}

fn normal(x: f64, z: f64) -> Axes {
    Axes::Normal(Vec3::new(x, 0.0, z))
}

fn first(target: f64) -> [Option<f64>; 3] {
    let mut components = FREE;
    components[0] = Some(target);
    components
}

#[test]
fn directions_of_a_step_are_independent_and_stated_once() {
    let held = || step("press").hold("block", "zmin");
    let tilted = |x, z, to| held().displace_in(normal(x, z), "block", "zmax", first(to));
    assert_eq!(faults(vec![tilted(1.0, 1.0, 0.1)]), "");
    let twice = tilted(1.0, 1.0, 0.1).displace_in(normal(2.0, 2.0), "block", "zmax", first(0.2));
    let told = faults(vec![twice]);
    assert!(
        told.contains("twice: 0.1 by `zmax`, 0.2 by `zmax`"),
        "{told}"
    );
    let back =
        |to| tilted(1.0, 1.0, to).displace_in(normal(-1.0, -1.0), "block", "zmax", first(to));
    assert!(faults(vec![back(0.1)]).contains("twice"));
    assert_eq!(faults(vec![back(0.0)]), "");
    let fourth = held().displace_in(normal(1.0, 1.0), "block", "zmin", first(0.0));
    let told = faults(vec![fourth]);
    assert!(
        told.contains("prescribed along 4 directions, and the last one, `x` of `zmin`"),
        "{told}"
    );
    assert!(told.contains("steps[0].displacements[1]"), "{told}");
    // Released components leave room for others.
    let later = |release: bool| {
        let tilt = step("tilt").displace_in(normal(1.0, 1.0), "block", "zmax", first(0.1));
        let hold = held().hold("block", "zmax");
        let tilt = match release {
            true => tilt.release_all("block", "zmax"),
            false => tilt,
        };
        faults(vec![hold, tilt])
    };
    assert!(later(false).contains("in step `tilt`"));
    assert_eq!(later(true), "");
}

#[test]
fn axes_that_do_not_exist_are_refused() {
    let with = |axes, components: [Option<f64>; 3]| {
        let press = step("press").hold("block", "zmin");
        faults(vec![press.displace_in(axes, "block", "xmax", components)])
    };
    let told = with(normal(1.0, 0.0), [None, Some(0.0), None]);
    assert!(
        told.contains("states `y`: a normal determines the first axis only"),
        "{told}"
    );
    let told = with(normal(0.0, 0.0), first(0.0));
    assert!(told.contains("the normal is zero"), "{told}");
    let told = with(
        Axes::Skew {
            x: Vec3::x(),
            y: Vec3::x() * -2.0,
        },
        first(0.0),
    );
    assert!(told.contains("are zero or parallel"), "{told}");
    let on_axis = Axes::Cylindrical {
        point: Vec3::new(1.0, 0.5, 0.5),
        axis: Vec3::z(),
    };
    let told = with(on_axis, first(0.0));
    assert!(told.contains("is on the axis"), "{told}");
    assert_eq!(with(on_axis, [None, None, Some(0.0)]), "");
}

#[test]
fn what_axes_leave_free_is_found() {
    let roller = |z| step("press").displace_in(normal(1.0, z), "block", "zmin", first(0.0));
    let told = faults(vec![roller(1.0)]);
    assert!(
        told.contains("body `block` is in no contact pair"),
        "{told}"
    );
    let held = roller(1.0)
        .displace_in(normal(-1.0, 1.0), "block", "xmin", first(0.0))
        .displace("block", "ymin", [None, Some(0.0), None]);
    assert_eq!(faults(vec![held]), "");
}
