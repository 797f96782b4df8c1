//! A block that stands on an edge, on a block, a rigid plane or rigid facets.

use striae_contact::{
    evaluation::Evaluation, pair::Enforcement, tip::RigidPoint, unknowns::NodeResult,
};
use striae_law::{
    bulk::{LameConstants, Material},
    friction::Friction,
};
use striae_mesh::{
    Face, Mesh, NodeId, Vec3,
    generate::{Block, Pivot, Rotation},
};
use striae_solve::{
    drive::{Continue, Observer, Progress, run},
    model::{
        Backend, Body, BodyId, ContactMass, ContactSurface, Curve, Displacement, Formulation,
        Increments, Initial, Model, Pair, Procedure, RigidId, RigidShape, RigidSurface, Solver,
        Step, Strategy,
    },
    newton::{Increment, IterationObserver},
    norms::Norms,
    outcome::{CutBack, Ending},
    problem::Problem,
    report::{PairReport, pairs},
    state::State,
};

/// What the block stands on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Floor {
    Soft,
    Plane,
    Facets,
    /// A rigid ridge along `y` at `x = 0.375` up to `z = 0`, with a vertex at `y = 0.07`.
    Ridge,
    /// A rigid pyramid with its top at `(0.375, 0, 0)`.
    Pyramid,
    /// The same with a slope of 0.1.
    Hill,
    /// A rigid ridge along `y` of two long and narrow facets.
    Narrow,
}

fn rubber(youngs_modulus: f64) -> Material {
    let constants = LameConstants::from_youngs_modulus(youngs_modulus, 0.3);
    Material::neo_hookean(constants.unwrap())
}

fn body(name: &str, mesh: Mesh, modulus: f64) -> Body {
    Body {
        name: name.to_owned(),
        mesh,
        material: rubber(modulus),
        formulation: Formulation::Standard,
        density: 0.0,
        contact_mass: ContactMass::Consistent,
        sections: Vec::new(),
    }
}

fn faces(mesh: &Mesh, sets: &[&str]) -> Vec<Face> {
    let of = |set: &&str| mesh.facet_sets.get(set).unwrap().to_vec();
    sets.iter().flat_map(of).collect()
}

/// A unit block whose lower edge along `y` is at `x = z = 0`, turned up by `degrees`, with
/// `divisions` elements along `x` and `z`.
pub fn tilted(degrees: f64, divisions: usize) -> Block {
    Block {
        origin: Vec3::new(0.0, -0.5, 0.0),
        divisions: [divisions, 3, divisions],
        rotation: Some(Rotation {
            axis: -Vec3::y(),
            degrees,
            about: Pivot::Point(Vec3::zeros()),
        }),
        ..Block::default()
    }
}

/// The block `upper` on a floor; `sole` are the sides of it that may touch.
pub fn standing(upper: Block, sole: &[&str], floor: Floor, friction: Friction) -> Model {
    let upper = upper.mesh().unwrap();
    let sole = faces(&upper, sole);
    let mut bodies = vec![body("upper", upper, 1.0)];
    let mut rigid_surfaces = Vec::new();
    let b = match floor {
        Floor::Soft => {
            let lower = Block {
                origin: Vec3::new(-1.03, -0.97, -1.0),
                size: Vec3::new(2.1, 2.0, 1.0),
                divisions: [5, 5, 3],
                ..Block::default()
            };
            let lower = lower.mesh().unwrap();
            let faces = faces(&lower, &["zmax"]);
            bodies.push(body("lower", lower, 2.0));
            let body = BodyId(1);
            ContactSurface::Deformable { body, faces }
        }
        Floor::Plane => {
            let (point, normal) = (Vec3::zeros(), Vec3::z());
            let shape = RigidShape::Plane { point, normal };
            rigid_surfaces.push(RigidSurface::new("floor", shape));
            ContactSurface::Rigid(RigidId(0))
        }
        Floor::Facets | Floor::Ridge | Floor::Pyramid | Floor::Hill | Floor::Narrow => {
            let shape = match floor {
                Floor::Ridge => ridge(),
                Floor::Pyramid => pyramid(SLOPE),
                Floor::Hill => pyramid(0.1),
                Floor::Narrow => narrow(),
                _ => facets(),
            };
            rigid_surfaces.push(RigidSurface::new("floor", shape));
            ContactSurface::Rigid(RigidId(0))
        }
    };
    Model {
        ties: Vec::new(),
        title: String::new(),
        bodies,
        rigid_surfaces,
        pairs: vec![Pair {
            name: "contact".to_owned(),
            a: ContactSurface::Deformable {
                body: BodyId(0),
                faces: sole,
            },
            b,
            textures: [None, None],
            friction,
            enforcement: Enforcement::Weighted,
            search_distance: None,
            initial: Initial::AsMeshed,
            stabilised: false,
        }],
        steps: Vec::new(),
        solver: Solver {
            backend: Backend::Condensed,
            strategy: Strategy::Semismooth,
            tolerance: 1e-11,
            largest_iterations: 30,
            further_iterations: 1,
        },
    }
}

/// Nine rigid facets over `[-1, 1]^2`, slightly curved.
fn facets() -> RigidShape {
    let at = |i: usize, j: usize| {
        let (x, y) = (i as f64 / 1.5 - 1.0, j as f64 / 1.5 - 1.0);
        Vec3::new(x, y, 0.02 * (x * x - y * y))
    };
    let positions = (0..16).map(|k| at(k % 4, k / 4)).collect();
    let node = |i: usize, j: usize| NodeId::new(i + 4 * j);
    let facets = (0..9).map(|k| (k % 3, k / 3));
    let facets = facets
        .map(|(i, j)| {
            [
                node(i, j),
                node(i + 1, j),
                node(i + 1, j + 1),
                node(i, j + 1),
            ]
        })
        .collect();
    RigidShape::Facets { positions, facets }
}

/// Slope of the rigid ridge and of the pyramid.
pub const SLOPE: f64 = 0.5;

/// Where they are.
pub const TOP: f64 = 0.375;

fn ridge() -> RigidShape {
    let at = |i: usize, j: usize| {
        let x = [-0.7, TOP, 1.6][i];
        Vec3::new(x, [-0.8, 0.07, 0.9][j], -SLOPE * (x - TOP).abs())
    };
    let node = |i: usize, j: usize| NodeId::new(i + 3 * j);
    let quad = |(i, j): (usize, usize)| {
        let far = [node(i + 1, j), node(i + 1, j + 1)];
        [node(i, j), far[0], far[1], node(i, j + 1)]
    };
    RigidShape::Facets {
        positions: (0..9).map(|k| at(k % 3, k / 3)).collect(),
        facets: (0..4).map(|k| quad((k % 2, k / 2))).collect(),
    }
}

fn pyramid(slope: f64) -> RigidShape {
    let far = 1.2;
    let base = [[-far, -far], [far, -far], [far, far], [-far, far]];
    let base = base.map(|[x, y]| Vec3::new(TOP + x, y, -slope * far));
    let positions = [base.to_vec(), vec![Vec3::new(TOP, 0.0, 0.0)]].concat();
    let top = NodeId::new(4);
    let side = |at: usize| [NodeId::new(at), NodeId::new((at + 1) % 4), top, top];
    RigidShape::Facets {
        positions,
        facets: (0..4).map(side).collect(),
    }
}

fn narrow() -> RigidShape {
    let at = |i: usize, j: usize| {
        let x = 0.1 * (i as f64 - 1.0);
        Vec3::new(TOP + x, [-0.8, 0.9][j], -0.2 * x.abs())
    };
    let quad = |i: usize| [i, i + 1, i + 4, i + 3].map(NodeId::new);
    RigidShape::Facets {
        positions: (0..6).map(|k| at(k % 3, k / 3)).collect(),
        facets: vec![quad(0), quad(1)],
    }
}

/// A step that moves the upper side of the upper block by `way`.
pub fn moved(model: &Model, way: [f64; 3], increments: usize) -> Step {
    let mut displacements = vec![hold(model, 0, "zmax", way)];
    if model.bodies.len() > 1 {
        displacements.push(hold(model, 1, "zmin", [0.0; 3]));
    }
    let size = 1.0 / increments as f64;
    Step {
        name: "step".to_owned(),
        duration: 1.0,
        procedure: Procedure::QuasiStatic,
        increments: Increments {
            initial: size,
            smallest: 0.1 * size,
            largest: size,
        },
        velocities: Vec::new(),
        gravity: None,
        displacements,
        releases: Vec::new(),
        loads: Vec::new(),
        rigid_motions: Vec::new(),
        frictions: Vec::new(),
    }
}

fn hold(model: &Model, body: usize, set: &str, way: [f64; 3]) -> Displacement {
    Displacement {
        set: set.to_owned(),
        body: BodyId(body),
        nodes: model.bodies[body].mesh.node_sets.get(set).unwrap().to_vec(),
        components: way.map(Some),
        curve: Curve::Ramp,
    }
}

/// Converged states and reports of a run that gets through.
pub struct Run {
    pub problem: Problem,
    pub states: Vec<State>,
    pub reports: Vec<PairReport>,
}

impl Run {
    pub fn completed(model: Model) -> Self {
        let problem = Problem::new(model).unwrap();
        let mut record = Record::default();
        let (_, ending) = run(&problem, State::undeformed(&problem), &mut record);
        assert_eq!(ending, Ending::Completed, "{ending}\n{:#?}", record.cuts);
        let states = record.states;
        let reports = states
            .iter()
            .map(|state| pairs(&problem, state).remove(0))
            .collect();
        Self {
            problem,
            states,
            reports,
        }
    }

    pub fn last(&self) -> (&State, &PairReport) {
        let last = self.states.len() - 1;
        (&self.states[last], &self.reports[last])
    }

    pub fn pointed(&self) -> usize {
        let pointed = &self.last().0.pairs[0].pointed;
        pointed.iter().flatten().filter(|pointed| **pointed).count()
    }

    /// Rigid points with their results, by increment.
    pub fn points(&self, increment: usize) -> Vec<(RigidPoint, NodeResult)> {
        let pair = &self.states[increment].pairs[0];
        let numbered = pair.points.iter().enumerate();
        numbered
            .filter_map(|(node, point)| Some(((*point)?, pair.nodes[1][node])))
            .collect()
    }

    pub fn nodes(&self) -> &[NodeResult] {
        &self.last().0.pairs[0].nodes[0]
    }
}

#[derive(Default)]
struct Record {
    states: Vec<State>,
    cuts: Vec<String>,
}

impl IterationObserver for Record {
    fn iteration(&mut self, _: usize, _: &Norms, _: &[Evaluation]) {}
}

impl Observer for Record {
    fn step(&mut self, _: usize, _: &str) {}

    fn increment(&mut self, _: Progress, increment: &Increment) -> Continue {
        self.states.push(increment.state.clone());
        Continue::Yes
    }

    fn cut_back(&mut self, _: Progress, reason: &CutBack) -> Continue {
        self.cuts.push(reason.to_string());
        Continue::Yes
    }
}
