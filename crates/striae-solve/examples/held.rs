//! Memory of the problem that a rank holds of a block on a plane: elements along an edge, ranks,
//! and which of them to be.
//!
//! ```sh
//! cargo run --release -p striae-solve --example held -- 32 2 0
//! ```

use std::{env, fs, sync::Arc};

use striae_law::{
    bulk::{LameConstants, Material},
    friction::Friction,
};
use striae_mesh::{Vec3, generate::Block};
use striae_model::{
    Backend, Body, BodyId, ContactMass, ContactSurface, Enforcement, Formulation, Initial, Model,
    Pair, RigidId, RigidShape, RigidSurface, Solver, Strategy,
};
use striae_solve::{problem::Problem, share::Division, state::State, team::Team};

/// A rank that others have nothing to say to.
#[derive(Debug)]
struct Quiet {
    rank: usize,
    size: usize,
}

impl Team for Quiet {
    fn rank(&self) -> usize {
        self.rank
    }

    fn size(&self) -> usize {
        self.size
    }

    fn gather(&self, own: &[u8]) -> Vec<Vec<u8>> {
        let of = |rank| {
            if rank == self.rank {
                own.to_vec()
            } else {
                Vec::new()
            }
        };
        (0..self.size).map(of).collect()
    }

    fn exchange(&self, parcels: Vec<Vec<f64>>) -> Vec<Vec<f64>> {
        parcels
    }

    fn sum(&self, _: &mut [f64]) {}

    fn largest(&self, _: &mut [f64]) {}
}

/// A block of rubber on a plane.
fn model(count: usize) -> Model {
    let mesh = Block {
        divisions: [count; 3],
        ..Block::default()
    };
    let mesh = mesh.mesh().expect("a block");
    let faces = mesh.facet_sets.get("zmin").unwrap_or_default().to_vec();
    let constants = LameConstants::from_youngs_modulus(1.0, 0.3);
    let material = Material::neo_hookean(constants.expect("a material"));
    let floor = RigidShape::Plane {
        point: Vec3::zeros(),
        normal: Vec3::z(),
    };
    Model {
        title: String::new(),
        bodies: vec![Body {
            name: "block".to_owned(),
            mesh,
            formulation: Formulation::suited_to(&material),
            material,
            density: 1.0,
            contact_mass: ContactMass::Consistent,
            sections: Vec::new(),
        }],
        rigid_surfaces: vec![RigidSurface::new("floor", floor)],
        pairs: vec![Pair {
            name: "pair".to_owned(),
            a: ContactSurface::Deformable {
                body: BodyId(0),
                faces,
            },
            b: ContactSurface::Rigid(RigidId(0)),
            textures: [None, None],
            friction: Friction::coulomb(0.3).expect("a law of friction"),
            enforcement: Enforcement::Weighted,
            search_distance: None,
            initial: Initial::AsMeshed,
            interference: None,
            wear: [0.0; 2],
            wear_across: 1.0,
            stabilised: false,
            feature_angle: None,
        }],
        ties: Vec::new(),
        springs: Vec::new(),
        cavities: Vec::new(),
        steps: Vec::new(),
        solver: Solver {
            backend: Backend::Condensed,
            strategy: Strategy::Semismooth,
            tolerance: 1e-10,
            largest_iterations: 15,
            further_iterations: 0,
        },
    }
}

/// A number of the process's status, in megabytes.
fn status(name: &str) -> f64 {
    let text = fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = text.lines().find_map(|line| line.strip_prefix(name));
    let number = line.and_then(|rest| rest.split_whitespace().nth(1)?.parse::<f64>().ok());
    number.unwrap_or(f64::NAN) / 1024.0
}

fn main() {
    let mut numbers = env::args().skip(1).map(|word| word.parse::<usize>());
    let mut next = |default| numbers.next().and_then(Result::ok).unwrap_or(default);
    let (count, size, rank) = (next(32), next(1), next(0));
    let before = status("VmRSS");
    let model = model(count);
    let of_mesh = status("VmRSS") - before;
    let division = Division::new(&model, size).expect("a division");
    let divided = status("VmHWM") - before;
    let team = Arc::new(Quiet { rank, size });
    let problem = Problem::shared(model, &division, team).expect("a problem");
    drop(division);
    let state = State::undeformed(&problem);
    let elements: usize = (problem.model.bodies.iter())
        .map(|body| body.mesh.element_count())
        .sum();
    println!(
        "{} unknowns, rank {rank} of {size}: {elements} elements, {} nodes; the whole mesh {of_mesh:.0} MB, \
         while dividing {divided:.0} MB at most; in the end {:.0} MB, {:.0} MB at most",
        3 * (count + 1).pow(3),
        state.positions.len(),
        status("VmRSS") - before,
        status("VmHWM") - before,
    );
}
