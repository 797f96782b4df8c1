//! A sphere that slides on a plane and is lowered until its cap has worn off.

use std::f64::consts::PI;

use striae_law::bulk::{LameConstants, Material};
use striae_mesh::generate::{CappedBlock, Part};
use striae_solve::{outcome::Ending, report::pairs};

use crate::scene::{Places, Run, body, coulomb, increments, model, plane, step};

const RADIUS: f64 = 1200.0;
/// Way by which the sphere is lowered, far more than it yields.
const LOWERED: f64 = 0.007;
const WEAR: f64 = 1000.0;

/// Half of a block with a spherical lower face, lowered as it slides along the plane, then slid on.
fn sphere(element_size: f64) -> Run {
    let mesh = CappedBlock {
        size: [14.0; 2],
        height: 7.0,
        radius: RADIUS,
        element_size,
        fine_depth: 0.5,
        part: Part::Half,
        ..CappedBlock::default()
    };
    let material = Material::neo_hookean(LameConstants::from_youngs_modulus(1.0, 0.3).unwrap());
    let mut model = model(vec![body("block", mesh.mesh().unwrap(), material)]);
    let floor = plane([0.0; 3], [0.0, 0.0, 1.0]);
    model.touch_rigid(("block", "cap"), floor, coulomb(0.05));
    model.pairs[0].wear = [WEAR, 0.0];
    let (mut lower, mut slide) = (step(), step());
    lower.displacements = vec![
        model.hold("block", "ymin", [None, Some(0.0), None]),
        model.hold("block", "zmax", [Some(0.5), Some(0.0), Some(-LOWERED)]),
    ];
    lower.increments = increments(0.05, 1e-4);
    slide.displacements = vec![model.hold("block", "zmax", [Some(1.0), None, None])];
    slide.increments = increments(0.25, 1e-3);
    model.steps = vec![lower, slide];
    Run::of(model)
}

/// The volume `pi R d^2 = pi a^4/(4 R)` of the cap, and the area `pi a^2 = 2 pi R d` of its base.
#[test]
fn a_sphere_loses_its_cap() {
    for size in [0.7, 0.5] {
        let run = sphere(size);
        assert_eq!(run.ending, Ending::Completed);
        let volume = 2.0 * run.last().pairs[0].worn[0];
        let volume = volume / (PI * RADIUS * LOWERED * LOWERED) - 1.0;
        let area = 2.0 * pairs(&run.problem, run.last())[0].sides[0].pressed;
        let area = area / (2.0 * PI * RADIUS * LOWERED) - 1.0;
        let worn = run.last().pairs[0].tractions.worn[0].iter();
        let deepest = worn.copied().fold(0.0, f64::max);
        let iterations: usize = run.iterations.iter().map(Vec::len).sum();

        let geometry = &run.problem.pairs[0];
        let surface = geometry.contact.sides[0].surface().unwrap();
        let x: Vec<_> = surface
            .nodes()
            .iter()
            .map(|&n| run.problem.reference[run.problem.node(0, n)])
            .collect();
        let mut sum = 0.0;
        let mut cap = 0.0;
        for facet in surface.facets() {
            let c: Vec<_> = facet.iter().map(|n| x[n.index()]).collect();
            let area = 0.5 * (c[2] - c[0]).cross(&(c[3] - c[1])).norm();
            let worn = &run.last().pairs[0].tractions.worn[0];
            sum += 0.25 * area * facet.iter().map(|n| worn[n.index()]).sum::<f64>();
            cap += 0.25
                * area
                * facet
                    .iter()
                    .map(|n| (LOWERED - x[n.index()].z).max(0.0))
                    .sum::<f64>();
        }
        println!(
            "geometric {} nodal cap {}",
            2.0 * sum / (PI * RADIUS * LOWERED * LOWERED) - 1.0,
            2.0 * cap / (PI * RADIUS * LOWERED * LOWERED) - 1.0
        );
        for (p, c) in &run.cuts {
            println!("{p:?} {c}");
        }
        for its in run.iterations.iter().take(12) {
            println!("--");
            for n in its {
                println!("{n:?}");
            }
        }
        for state in run.states.iter().step_by(4) {
            println!(
                "t {} V {:.4e} area {:.3} p {:.3e}",
                state.time,
                state.pairs[0].worn[0],
                pairs(&run.problem, state)[0].sides[0].pressed,
                pairs(&run.problem, state)[0].max_pressure
            );
        }
        for (x, w) in x.iter().zip(&run.last().pairs[0].tractions.worn[0]) {
            if x.y < 0.3 && x.x > 0.0 && *w > 0.0 || x.y < 0.3 && x.x > 0.0 && x.x < 5.0 {
                println!(
                    "{:.2} {:.2} depth {:.6} cap {:.6}",
                    x.x,
                    x.y,
                    w,
                    LOWERED - x.z
                );
            }
        }
        println!(
            "{size} {volume} {area} {} {:?} inc {} cuts {} it {iterations}",
            deepest / LOWERED,
            pairs(&run.problem, run.last())[0].max_pressure,
            run.progress.len(),
            run.cuts.len()
        );
    }
}
