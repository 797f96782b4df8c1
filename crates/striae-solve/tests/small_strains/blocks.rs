//! The cases as models of the program.

use striae_contact::{evaluation::Evaluation, pair::Enforcement, side::Side};
use striae_law::{
    bulk::{LameConstants, Material},
    friction::Friction,
};
use striae_mesh::{Vec3, generate::Block};
use striae_model::{
    Axes, Backend, Body, BodyId, ContactMass, ContactSurface, Curve, Displacement, Formulation,
    Increments, Initial, Model, Pair, Procedure, Solver, Step, Strategy,
};
use striae_solve::{
    drive::{Continue, Observer, Progress, run_after},
    newton::{Increment, IterationObserver},
    norms::Norms,
    outcome::{CutBack, Ending},
    problem::Problem,
    state::State,
};
use striae_surface::node::SurfaceNode;

use crate::reference::Case;

/// Largest difference between a share of a support and the sum over its points.
const POINTS: f64 = 0.05;

/// Quantities compared at the end of an increment.
pub struct Faces {
    /// Kept nodes by side.
    pub kept: [Vec<usize>; 2],
    /// Pressure and friction on the punch of the kept nodes.
    pub unknowns: Vec<Vec3>,
    /// Nodal contact forces by side.
    pub forces: [Vec<Vec3>; 2],
}

/// All increments at a depth.
pub struct History {
    /// The depth.
    pub depth: f64,
    /// After every increment.
    pub increments: Vec<Faces>,
}

impl History {
    /// Runs a case.
    pub fn of(case: &Case, depth: f64) -> Self {
        let whole = model(case, depth);
        let mut states = States::default();
        let mut state = None;
        // Step by step, as shares are replaced in between.
        for (at, increment) in case.increments.iter().enumerate() {
            let mut model = whole.clone();
            model.steps.truncate(at + 1);
            let problem = Problem::new(model).expect("a model");
            let from = state.unwrap_or_else(|| State::undeformed(&problem));
            let (mut reached, ending) = run_after(&problem, at, from, at, &mut states);
            assert_eq!(ending, Ending::Completed, "{} at {depth}", case.name);
            if !increment.shares.is_empty() {
                take_shares(case, &problem, &mut reached, &increment.shares);
            }
            state = Some(reached);
        }
        let problem = Problem::new(whole).expect("a model");
        assert_eq!(states.0.len(), case.increments.len());
        Self {
            depth,
            increments: states
                .0
                .iter()
                .map(|state| faces(case, &problem, state))
                .collect(),
        }
    }
}

#[derive(Default)]
struct States(Vec<State>);

impl IterationObserver for States {
    fn iteration(&mut self, _: usize, _: &Norms, _: &[Evaluation]) {}
}

impl Observer for States {
    fn step(&mut self, _: usize, _: &str) {}

    fn increment(&mut self, _: Progress, increment: &Increment) -> Continue {
        self.0.push(increment.state.clone());
        Continue::Yes
    }

    fn cut_back(&mut self, progress: Progress, reason: &CutBack) -> Continue {
        panic!("{progress:?}: {reason}");
    }
}

/// Continues from the closed shares of the reference, which are sums over points; areas differ from
/// them by the weight of some points.
fn take_shares(case: &Case, problem: &Problem, state: &mut State, shares: &[f64]) {
    let mut shares = shares.iter();
    let pair = &mut state.pairs[0];
    for side in Side::BOTH {
        for node in in_order(case, problem, side) {
            if pair.kept[side][node] {
                let share = *shares.next().expect("a share of each kept node");
                let own = &mut pair.nodes[side][node].closed;
                assert!((*own - share).abs() < POINTS, "{own} {share}");
                *own = share;
            }
        }
    }
    assert!(shares.next().is_none());
}

fn faces(case: &Case, problem: &Problem, state: &State) -> Faces {
    let pair = &state.pairs[0];
    let mut faces = Faces {
        kept: [Vec::new(), Vec::new()],
        unknowns: Vec::new(),
        forces: [Vec::new(), Vec::new()],
    };
    for side in Side::BOTH {
        for node in in_order(case, problem, side) {
            let global = problem.surface_node(0, side, SurfaceNode::new(node));
            let global = global.expect("a node of a body");
            if pair.kept[side][node] {
                faces.kept[side].push(faces.forces[side].len());
                let result = &pair.nodes[side][node];
                let tau = result.tau * if side == Side::A { -1.0 } else { 1.0 };
                let unknowns = Vec3::new(result.pressure, tau.x, tau.y);
                faces.unknowns.push(unknowns);
            }
            faces.forces[side].push(state.forces.contact[global]);
        }
    }
    faces
}

/// Nodes of a face in the order of the reference: x counts first.
fn in_order(case: &Case, problem: &Problem, side: Side) -> Vec<usize> {
    let count = (case.divisions[side] + 1).pow(2);
    let place = |node: &usize| {
        let global = problem.surface_node(0, side, SurfaceNode::new(*node));
        problem.reference[global.expect("a node of a body")]
    };
    let mut nodes: Vec<usize> = (0..count).collect();
    nodes.sort_by(|a, b| {
        let (a, b) = (place(a), place(b));
        let rows = |y: f64| (y * 1e6).round() as i64;
        rows(a.y).cmp(&rows(b.y)).then(a.x.total_cmp(&b.x))
    });
    nodes
}

/// A case at a depth.
pub fn model(case: &Case, depth: f64) -> Model {
    let [base, punch] = case.divisions;
    let [x, y] = case.origin;
    let bodies = vec![
        body("base", 1.0, [0.0, 0.0, -0.5], [1.0, 1.0, 0.5], base),
        body("punch", case.ratio, [x, y, 0.0], [0.62, 0.65, 0.5], punch),
    ];
    let faces = |body: usize, set: &str| ContactSurface::Deformable {
        body: BodyId(body),
        faces: bodies[body]
            .mesh
            .facet_sets
            .get(set)
            .expect("a face")
            .to_vec(),
    };
    let pair = Pair {
        name: "interface".to_owned(),
        a: faces(0, "zmax"),
        b: faces(1, "zmin"),
        textures: [None, None],
        friction: Friction::coulomb(case.mu).expect("a coefficient"),
        enforcement: Enforcement::Weighted,
        search_distance: None,
        initial: Initial::AsMeshed,
        interference: None,
        wear: [0.0; 2],
        wear_across: 1.0,
        stabilised: false,
        feature_angle: None,
    };
    let hold = |body: usize, set: &str, target: Vec3| Displacement {
        axes: Axes::Global,
        set: set.to_owned(),
        body: BodyId(body),
        nodes: bodies[body]
            .mesh
            .node_sets
            .get(set)
            .expect("a face")
            .to_vec(),
        components: [target.x, target.y, target.z].map(|u| Some(u.into())),
        curve: Curve::Ramp,
    };
    let steps = case.increments.iter().map(|increment| {
        let [x, y, z] = increment.rate.map(|rate| rate * depth);
        let [along, across] = increment.shift;
        step(vec![
            hold(0, "zmin", Vec3::zeros()),
            hold(1, "zmax", Vec3::new(along + x, across + y, z)),
        ])
    });
    Model {
        ties: Vec::new(),
        springs: Vec::new(),
        cavities: Vec::new(),
        title: case.name.clone(),
        steps: steps.collect(),
        bodies,
        rigid_surfaces: Vec::new(),
        pairs: vec![pair],
        solver: Solver {
            backend: Backend::Multifrontal,
            strategy: Strategy::Semismooth,
            tolerance: 1e-10,
            largest_iterations: 40,
            further_iterations: 2,
        },
    }
}

fn body(name: &str, modulus: f64, origin: [f64; 3], size: [f64; 3], divisions: usize) -> Body {
    let mesh = Block {
        origin: origin.into(),
        size: size.into(),
        divisions: [divisions, divisions, (divisions / 2).max(2)],
        ..Block::default()
    };
    let constants = LameConstants::from_youngs_modulus(modulus, 0.3);
    Body {
        name: name.to_owned(),
        mesh: mesh.mesh().expect("a block"),
        material: Material::linear_elastic(constants.expect("constants")),
        formulation: Formulation::Standard,
        density: 0.0,
        contact_mass: ContactMass::Consistent,
        sections: Vec::new(),
    }
}

fn step(displacements: Vec<Displacement>) -> Step {
    Step {
        name: "step".to_owned(),
        duration: 1.0,
        procedure: Procedure::QuasiStatic,
        increments: Increments {
            initial: 1.0,
            smallest: 0.9,
            largest: 1.0,
        },
        velocities: Vec::new(),
        gravity: None,
        displacements,
        releases: Vec::new(),
        loads: Vec::new(),
        forces: Vec::new(),
        actuations: Vec::new(),
        fillings: Vec::new(),
        rigid_motions: Vec::new(),
        frictions: Vec::new(),
    }
}
