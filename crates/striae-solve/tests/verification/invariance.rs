//! The answer does not depend on the frame, on the order of bodies, on numbers or threads.

use crate::scene::{
    Places, Run, block, body, coulomb, increments, largest_distance, model, rubber, step,
};
use nalgebra::Rotation3;
use striae_mesh::{Mesh, Renumbering, Vec3};
use striae_model::{LoadExtent, LoadKind, Model};
use striae_solve::report::pairs;
use striae_verify::Random;

fn meshes() -> [Mesh; 2] {
    let mut lower = block([0.0; 3], [1.0, 1.0, 0.5], [3, 3, 1]);
    let mut upper = block([0.22, 0.15, 0.5], [0.6, 0.7, 0.5], [3, 2, 1]);
    lower.irregularity = 0.2;
    upper.irregularity = 0.1;
    [lower.mesh().unwrap(), upper.mesh().unwrap()]
}

struct Setting {
    meshes: [Mesh; 2],
    rotation: Rotation3<f64>,
    pair_order: [usize; 2],
    body_order: [usize; 2],
}

impl Setting {
    fn plain() -> Self {
        Self {
            meshes: meshes(),
            rotation: Rotation3::identity(),
            pair_order: [0, 1],
            body_order: [0, 1],
        }
    }

    /// Pressed and sheared: by displacements, or by tractions on the upper end.
    fn model(&self, drive: Drive) -> Model {
        let materials = [rubber(3.0, 0.3), rubber(1.0, 0.3)];
        let named = [0, 1].map(|at| {
            body(
                ["lower", "upper"][at],
                self.meshes[at].clone(),
                materials[at].clone(),
            )
        });
        let mut model = model(self.body_order.map(|at| named[at].clone()).to_vec());
        model.solver.tolerance = 1e-12;
        let sides = [("lower", "zmax"), ("upper", "zmin")];
        model.touch(
            sides[self.pair_order[0]],
            sides[self.pair_order[1]],
            coulomb(0.4),
        );
        for (index, far) in [Vec3::new(0.0, 0.0, -1.0), Vec3::new(0.12, 0.05, -1.0)]
            .iter()
            .enumerate()
        {
            let v = self.rotation * far;
            let mut step = step();
            step.increments = increments(0.5, 0.1);
            if index == 0 {
                step.displacements
                    .push(model.hold("lower", "zmin", [Some(0.0); 3]));
            }
            match drive {
                Drive::Displacement => {
                    let u = v * 0.04;
                    step.displacements.push(model.hold(
                        "upper",
                        "zmax",
                        [Some(u.x), Some(u.y), Some(u.z)],
                    ));
                }
                Drive::Traction => {
                    let traction = LoadKind::DeadTraction(v * 0.02);
                    step.loads
                        .push(model.load("upper", "zmax", traction, LoadExtent::Whole));
                }
            }
            model.steps.push(step);
        }
        model
    }

    fn run(&self, drive: Drive) -> Run {
        Run::completed(self.model(drive))
    }
}

#[derive(Clone, Copy)]
enum Drive {
    Displacement,
    Traction,
}

/// Node positions of lower and upper body.
fn positions(run: &Run) -> [Vec<Vec3>; 2] {
    ["lower", "upper"].map(|name| run.positions(run.problem.model.body(name)).to_vec())
}

fn assert_same(a: &[Vec<Vec3>; 2], b: &[Vec<Vec3>; 2]) {
    for body in 0..2 {
        let error = largest_distance(&a[body], &b[body]);
        assert!(error < 1e-11, "body {body} differs by {error:.1e}");
    }
}

#[test]
fn rotation_and_translation() {
    let cyclic = Rotation3::from_axis_angle(
        &nalgebra::Unit::new_normalize(Vec3::new(1.0, 1.0, 1.0)),
        std::f64::consts::TAU / 3.0,
    );
    let arbitrary = Random::new(3).rotation();
    let shift = Vec3::new(0.3, -0.8, 0.5);
    for (drive, rotation) in [
        (Drive::Displacement, cyclic),
        (Drive::Displacement, arbitrary),
        (Drive::Traction, arbitrary),
    ] {
        let expected = positions(&Setting::plain().run(drive))
            .map(|body| body.iter().map(|x| rotation * x + shift).collect());
        let turned = Setting {
            meshes: meshes().map(|mesh| mesh.moved(&rotation, &shift)),
            rotation,
            ..Setting::plain()
        };
        assert_same(&positions(&turned.run(drive)), &expected);
    }
}

#[test]
fn order_of_bodies() {
    let plain = Setting::plain().run(Drive::Displacement);
    let force = pairs(&plain.problem, plain.last())[0].sides[0].force;
    for (pair_order, body_order) in [([1, 0], [0, 1]), ([0, 1], [1, 0]), ([1, 0], [1, 0])] {
        let swapped = Setting {
            pair_order,
            body_order,
            ..Setting::plain()
        };
        let run = swapped.run(Drive::Displacement);
        assert_same(&positions(&run), &positions(&plain));
        let swapped = pairs(&run.problem, run.last())[0].sides[pair_order[0]].force;
        assert!((swapped - force).norm() < 1e-10 * force.norm());
    }
}

#[test]
fn numbers_of_nodes_and_elements() {
    let plain = positions(&Setting::plain().run(Drive::Displacement));
    let renumberings = [0, 1].map(|at| Renumbering::shuffled(&meshes()[at], 5 + at as u64));
    let shuffled = Setting {
        meshes: [0, 1].map(|at| meshes()[at].renumbered(&renumberings[at]).unwrap()),
        ..Setting::plain()
    };
    let there = positions(&shuffled.run(Drive::Displacement));
    let back = [0, 1].map(|at| {
        let new = renumberings[at].nodes.iter();
        new.map(|node| there[at][node.index()]).collect()
    });
    assert_same(&back, &plain);
}

#[test]
fn threads() {
    let [one, two] = [1, 2].map(|threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        let run = pool
            .unwrap()
            .install(|| Setting::plain().run(Drive::Displacement));
        run.states
            .iter()
            .map(|s| (s.positions.clone(), s.pairs[0].tractions.clone()))
            .collect::<Vec<_>>()
    });
    assert!(one == two, "results depend on the number of threads");
}
