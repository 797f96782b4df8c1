//! Further steps after those of a model or of a run, and what models are made of on the fly.

use striae::{
    model::{extended, rigid_solid},
    prelude::*,
};

fn begun() -> Model {
    let block = Block {
        divisions: [2, 2, 2],
        ..Block::default()
    };
    let rubber = Material::neo_hookean(LameConstants::from_youngs_modulus(1e6, 0.3).unwrap());
    model("a block on a floor")
        .body(
            body("block", block.mesh().unwrap(), rubber)
                .nodes_where("grip", |x| x.z > 0.99)
                .facets_where("sole", |x| x.z < 0.01),
        )
        .rigid(plane("floor", [0.0; 3], [0.0, 0.0, 1.0]))
        .pair(
            pair("contact", surface("block", "sole"), rigid("floor"))
                .friction(Friction::coulomb(0.3).unwrap()),
        )
        .step(press())
        .build()
        .unwrap()
}

fn press() -> striae::model::StepBuilder {
    step("press")
        .increments(2)
        .displace("block", "grip", [0.0, 0.0, -0.02])
}

fn slide() -> striae::model::StepBuilder {
    step("slide")
        .increments(3)
        .displace("block", "grip", [Some(0.1), None, None])
}

#[test]
fn a_continued_run_goes_where_the_whole_one_goes() {
    let whole = extended(begun(), vec![slide()]).unwrap();
    let whole = Simulation::new(whole).unwrap().run().unwrap();
    let first = Simulation::new(begun()).unwrap().run().unwrap();
    let second = Simulation::after(&first, vec![slide()]).unwrap();
    let second = second.run().unwrap();
    assert_eq!(second.ending, Ending::Completed);
    assert_eq!((first.increments, second.increments), (2, 5));
    assert_eq!(second.history.rows[0][0], 3.0, "increments go on");
    assert_eq!(second.state.time, whole.state.time);
    let [found, expected] = [&second, &whole].map(|run| run.results().pair("contact").unwrap());
    let difference = (found.sides[0].force - expected.sides[0].force).norm();
    assert!(difference < 1e-8 * expected.sides[0].force.norm());
}

#[test]
fn a_run_that_was_stopped_is_not_continued() {
    let interrupt = Interrupt::default();
    interrupt.set();
    let stopped = Simulation::new(begun()).unwrap().until(&interrupt).run();
    let error = Simulation::after(&stopped.unwrap(), vec![slide()]).unwrap_err();
    assert_eq!(
        error.to_string(),
        "only a completed run can be continued with further steps; this one was stopped"
    );
}

#[test]
fn faults_of_further_steps_count_from_the_first_step() {
    let wrong = step("slide").displace("block", "grp", [0.0; 3]);
    let faults = extended(begun(), vec![wrong]).unwrap_err();
    assert_eq!(
        faults.0[0].to_string(),
        "steps[1].displacements[0]: body `block` has no node set `grp`; it has `all`, `grip`, \
         `xmax`, `xmin`, `ymax`, `ymin`, `zmax`, `zmin`; did you mean `grip`?"
    );
}

#[test]
fn release_all_frees_what_is_prescribed() {
    let lift = step("lift").release_all("block", "grip");
    // A released block has to be pressed, or nothing holds it.
    let lift = lift.pressure("block", "zmax", 10.0);
    let model = extended(begun(), vec![slide(), lift]).unwrap();
    assert_eq!(model.steps[2].releases[0].components, [true; 3]);
    let only_x = step("hold").displace("block", "zmin", [Some(0.0), None, None]);
    let lift = step("lift").release_all("block", "zmin");
    let model = extended(begun(), vec![only_x, lift]).unwrap();
    assert_eq!(model.steps[2].releases[0].components, [true, false, false]);
}

#[test]
fn a_spinning_body_turns_about_its_axis() {
    let spun = step("spin").dynamic(0.8).velocity("block", [1.0, 0.0, 0.0]);
    let spun = spun.spinning([0.0, 0.0, 2.0], [0.5, 0.5, 0.0]);
    let model = extended(begun(), vec![spun]).unwrap_err();
    assert!(model.to_string().contains("no `density`"), "{model}");
}

#[test]
fn a_rigid_solid_turns_about_its_centre() {
    let mesh = Block::default().mesh().unwrap();
    let faces = mesh.boundary_faces().into_iter();
    let facets = faces.map(|face| mesh.face_nodes(face)).collect();
    let solid = rigid_solid("cube", mesh.positions.clone(), facets, 2.0).unwrap();
    let model = model("a cube")
        .rigid(solid)
        .body(body(
            "block",
            mesh,
            Material::linear_elastic(LameConstants {
                lambda: 0.0,
                shear: 1.0,
            }),
        ))
        .step(step("hold").hold("block", "zmin"))
        .build()
        .unwrap();
    let cube = &model.rigid_surfaces[0];
    assert!((cube.reference - Vec3::repeat(0.5)).norm() < 1e-14);
    assert!((cube.inertia.unwrap().mass - 2.0).abs() < 1e-14);
}
