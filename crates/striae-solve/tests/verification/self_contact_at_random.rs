//! Random bodies that touch themselves: blocks with slits, folded strips, crushed rings.
//!
//! `SELF_CONTACT_SEEDS=A..B` tries other seeds than the few of every run of the tests.

use std::{ops::Range, time::Instant};

use striae_contact::{side::Side, unknowns::Status};
use striae_mesh::{CellBlock, Mesh, NodeId, Vec3};
use striae_model::{Curve, Freedom, Model, RigidId, RigidMotion};
use striae_solve::{
    newton::InStep,
    outcome::Ending,
    warning::{Judgement, Kind, Warning},
};
use striae_verify::Random;

use crate::{
    scene::{Places, Run, block, body, coulomb, increments, model, plane, rubber, step},
    self_contact::with_skin,
    strip::{folded, strip, swept},
};

/// Nodes of a mesh at places that are wanted.
fn nodes(mesh: &Mesh, wanted: impl Fn(&Vec3) -> bool) -> Vec<NodeId> {
    let nodes = mesh.positions.iter().enumerate();
    let nodes = nodes.filter(|(_, x)| wanted(x));
    nodes.map(|(node, _)| NodeId::new(node)).collect()
}

fn whole(random: &mut Random, from: usize, to: usize) -> usize {
    let at = random.uniform(from as f64, to as f64 + 1.0) as usize;
    at.min(to)
}

/// A mesh without some of its cells, by their middles.
fn without(mesh: &Mesh, removed: impl Fn(&Vec3) -> bool) -> Mesh {
    let middle = |corners: &[NodeId]| {
        let sum: Vec3 = corners.iter().map(|n| mesh.positions[n.index()]).sum();
        sum / 8.0
    };
    let cells = mesh.elements().filter(|corners| !removed(&middle(corners)));
    let cells: Vec<[NodeId; 8]> = cells.map(|corners| corners.try_into().unwrap()).collect();
    let mut kept: Vec<NodeId> = cells.iter().flatten().copied().collect();
    kept.sort_unstable();
    kept.dedup();
    let number = |node: NodeId| NodeId::new(kept.binary_search(&node).unwrap());
    let cells = cells.iter().map(|corners| corners.map(number));
    let x = kept.iter().map(|node| mesh.positions[node.index()]);
    with_skin(Mesh::new(x.collect(), vec![CellBlock::hexahedra(cells)]).unwrap())
}

fn friction(random: &mut Random) -> f64 {
    if random.uniform(0.0, 1.0) < 0.25 {
        0.0
    } else {
        random.uniform(0.1, 0.9)
    }
}

/// A tread block with slits from below, pressed on a plane and dragged over it.
fn tread(random: &mut Random) -> Model {
    let slits = whole(random, 1, 2);
    let lamella = whole(random, 1, 3);
    let along = slits + (slits + 1) * lamella;
    let high = whole(random, 3, 5);
    let deep = whole(random, 2, high - 1);
    let width = random.uniform(0.05, 0.3);
    // Slits are a cell wide, the cells between them one unit over their number.
    let size = 1.0 / lamella as f64;
    let wide = whole(random, 1, 3);
    let mesh = block([0.0; 3], [along as f64, 1.0, 2.0], [along, wide, high]);
    let mesh = mesh.mesh().unwrap();
    let height = 2.0 / high as f64;
    let is_slit = |column: usize| column % (lamella + 1) == lamella && column < along - 1;
    let mut mesh = without(&mesh, |x| {
        is_slit(x.x.floor() as usize) && x.z < deep as f64 * height
    });
    let place = |x: f64| -> f64 {
        let columns =
            (0..x.round() as usize).map(|column| if is_slit(column) { width } else { size });
        columns.sum()
    };
    mesh.positions.iter_mut().for_each(|x| x.x = place(x.x));
    for (name, z) in [("top", 2.0), ("sole", 0.0)] {
        let found = nodes(&mesh, |x| x.z == z);
        let faces = mesh.faces_of_nodes(&found);
        mesh.facet_sets.insert(name, faces);
        mesh.node_sets.insert(name, found);
    }
    let mut model = model(vec![body(
        "tread",
        mesh,
        rubber(1.0, random.uniform(0.2, 0.45)),
    )]);
    model.touch_rigid(
        ("tread", "sole"),
        plane([0.0; 3], [0.0, 0.0, 1.0]),
        coulomb(random.uniform(0.3, 1.0)),
    );
    model.touch_itself("tread", &["skin"], coulomb(friction(random)));
    let depth = random.uniform(0.05, 0.25);
    let way = random.uniform(0.3, 1.0)
        * if random.uniform(0.0, 1.0) < 0.5 {
            -1.0
        } else {
            1.0
        };
    let size = random.uniform(0.05, 0.2);
    let moved = |x: f64, y: f64| {
        let mut step = step();
        step.increments = increments(size, 1e-3);
        step.displacements = vec![model.hold("tread", "top", [Some(x), Some(y), Some(-depth)])];
        step
    };
    let across = random.uniform(-0.2, 0.2);
    model.steps = vec![moved(0.0, 0.0), moved(way, across)];
    model
}

/// A folded strip that is closed and moved along itself.
fn fold(random: &mut Random) -> Model {
    let thickness = random.uniform(0.06, 0.15);
    let gap = random.uniform(0.5, 1.5) * thickness;
    let turns = whole(random, 1, 3);
    let size = 1.0 / whole(random, 6, 14) as f64;
    let line = folded(turns, 1.0, thickness + gap, size);
    let mut mesh = strip(&line, thickness, whole(random, 1, 2), 0.2);
    let top = (thickness + gap) * turns as f64;
    let near = |x: f64| if turns % 2 == 1 { x < 0.35 } else { x > 0.65 };
    let low = nodes(&mesh, |x| {
        x.z < -0.4 * thickness && x.x < 0.35 && x.x >= 0.0
    });
    let high = nodes(&mesh, |x| x.z > top + 0.4 * thickness && near(x.x));
    mesh.node_sets.insert("low", low);
    mesh.node_sets.insert("high", high);
    let all = nodes(&mesh, |_| true);
    mesh.node_sets.insert("whole", all);
    let mut model = model(vec![body(
        "strip",
        mesh,
        rubber(1.0, random.uniform(0.0, 0.4)),
    )]);
    model.touch_itself("strip", &["skin"], coulomb(friction(random)));
    let closed = turns as f64 * gap + random.uniform(0.0, 0.1) * thickness;
    let (size, way) = (random.uniform(0.05, 0.15), random.uniform(-0.2, 0.2));
    let moved = |x: f64| {
        let mut step = step();
        step.increments = increments(size, 1e-3);
        step.displacements = vec![
            model.hold("strip", "whole", [None, Some(0.0), None]),
            model.hold("strip", "low", [Some(0.0), Some(0.0), Some(0.0)]),
            model.hold("strip", "high", [Some(x), Some(0.0), Some(-closed)]),
        ];
        step
    };
    model.steps = vec![moved(0.0), moved(way)];
    model
}

/// A ring between two planes that come together until its walls touch.
fn ring(random: &mut Random) -> Model {
    let around = 4 * whole(random, 5, 10);
    let thickness = random.uniform(0.08, 0.25);
    let layers = whole(random, 1, 2);
    let section = |k: usize| {
        // A node at the top and at the bottom.
        let angle = 2.0 * std::f64::consts::PI * k as f64 / around as f64;
        let radius = |layer: usize| 1.0 + thickness * (layer as f64 / layers as f64 - 1.0);
        let direction = Vec3::new(angle.sin(), 0.0, angle.cos());
        (0..=layers)
            .map(|layer| direction * radius(layer))
            .collect()
    };
    let mut mesh = swept(&(0..around).map(section).collect::<Vec<_>>(), true, 0.3);
    let outer = nodes(&mesh, |x| Vec3::new(x.x, 0.0, x.z).norm() > 1.0 - 1e-9);
    let faces = mesh.faces_of_nodes(&outer);
    mesh.facet_sets.insert("outer", faces);
    let middle = nodes(&mesh, |x| x.x.abs() < 1e-9);
    let all = nodes(&mesh, |_| true);
    mesh.node_sets.insert("middle", middle);
    mesh.node_sets.insert("whole", all);
    let mut model = model(vec![body(
        "ring",
        mesh,
        rubber(1.0, random.uniform(0.2, 0.4)),
    )]);
    let mu = friction(random);
    model.touch_rigid(
        ("ring", "outer"),
        plane([0.0, 0.0, -1.0], [0.0, 0.0, 1.0]),
        coulomb(mu),
    );
    model.touch_rigid(
        ("ring", "outer"),
        plane([0.0, 0.0, 1.0], [0.0, 0.0, -1.0]),
        coulomb(mu),
    );
    model.touch_itself("ring", &["skin"], coulomb(friction(random)));
    let mut crush = step();
    crush.increments = increments(random.uniform(0.02, 0.04), 1e-4);
    crush.displacements = vec![
        model.hold("ring", "whole", [None, Some(0.0), None]),
        model.hold("ring", "middle", [Some(0.0), Some(0.0), None]),
    ];
    let closed = 2.0 * (1.0 - thickness);
    let way = closed + random.uniform(-0.1, 0.3) * thickness;
    let still = Freedom::To(0.0);
    crush.rigid_motions = vec![RigidMotion {
        surface: RigidId(1),
        coordinates: [still, still, Freedom::To(-way), still, still, still],
        force: None,
        torque: None,
        curve: Curve::Ramp,
    }];
    model.steps = vec![crush];
    model
}

/// Result of a scene.
struct Verdict {
    completed: bool,
    said: String,
    wrong: Vec<String>,
    iterations: Vec<usize>,
    touched: bool,
    warned: usize,
}

fn verdict(model: Model) -> Verdict {
    let run = Run::of(model);
    let mut judgement = Judgement::default();
    for (states, progress) in run.states.windows(2).zip(&run.progress) {
        let in_step = InStep::up_to(progress.step, progress.fraction);
        judgement.increment(&run.problem, &states[0], &states[1], in_step);
    }
    let warnings = judgement.warnings(&run.problem, &run.ending);
    // On coarse meshes corners of facets sink in, and friction acts across gaps that vanish in the
    // mean only, which is warned of; more is wrong.
    let is_warned = |warning: &&Warning| match warning.kind {
        Kind::Moment => warning.value < 0.1,
        Kind::Overlap | Kind::Penetration => warning.value < 0.3,
        kind => kind == Kind::Coarse,
    };
    let (warned, wrong): (Vec<&Warning>, Vec<&Warning>) = warnings.iter().partition(is_warned);
    let mut wrong: Vec<String> = wrong.into_iter().map(Warning::to_string).collect();
    let pair = run.problem.pairs.len() - 1;
    let mut touched = false;
    for state in &run.states {
        let pair = &state.pairs[pair];
        let on = pair.nodes[Side::A]
            .iter()
            .filter(|node| node.status != Status::Open);
        touched |= on.count() > 0;
        let forces = pair.facets[Side::A].iter().flat_map(|(_, of)| of.force);
        let (sum, total) = forces.fold((Vec3::zeros(), 0.0), |(sum, total), force| {
            (sum + force, total + force.norm())
        });
        if sum.norm() > 1e-13 * total {
            wrong.push(format!("forces leave {:.1e} of {total:.1e}", sum.norm()));
        }
    }
    Verdict {
        completed: run.ending == Ending::Completed,
        said: run.ending.to_string(),
        wrong,
        iterations: run.iterations.iter().map(Vec::len).collect(),
        touched,
        warned: warned.len(),
    }
}

fn seeds() -> Range<u64> {
    let given = std::env::var("SELF_CONTACT_SEEDS").ok();
    let given = given.and_then(|given| {
        let (from, to) = given.split_once("..")?;
        Some(from.parse().ok()?..to.parse().ok()?)
    });
    given.unwrap_or(0..9)
}

#[test]
fn random_bodies_touch_themselves() {
    let (mut completed, mut wrong, mut all) = (0, 0, 0);
    let mut iterations = Vec::new();
    for seed in seeds() {
        let mut random = Random::new(1000 + seed);
        let (name, model) = match seed % 3 {
            0 => ("tread", tread(&mut random)),
            1 => ("fold", fold(&mut random)),
            _ => ("ring", ring(&mut random)),
        };
        let start = Instant::now();
        let mut found = verdict(model);
        found.iterations.sort_unstable();
        println!(
            "{seed} {name}: {} touched {} warned {} increments {} median {} most {} {:.1}s {:?}",
            if found.completed {
                "completed".to_owned()
            } else {
                found.said
            },
            found.touched,
            found.warned,
            found.iterations.len(),
            found
                .iterations
                .get(found.iterations.len() / 2)
                .unwrap_or(&0),
            found.iterations.last().unwrap_or(&0),
            start.elapsed().as_secs_f64(),
            found.wrong,
        );
        all += 1;
        completed += usize::from(found.completed);
        wrong += usize::from(found.completed && !found.wrong.is_empty());
        iterations.extend(found.iterations);
    }
    iterations.sort_unstable();
    println!(
        "{completed} of {all} completed, {wrong} wrong, median {}",
        iterations[iterations.len() / 2]
    );
    assert_eq!([completed, wrong], [all, 0]);
}
