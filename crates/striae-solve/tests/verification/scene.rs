//! Models made in code and run without output.
//!
//! Longer than other files, as it is the one place where models of tests are made.

use striae_contact::{evaluation::Evaluation, interference::Interference, pair::Enforcement};
use striae_law::{
    bulk::{LameConstants, Material},
    friction::Friction,
};
use striae_mesh::{CellBlock, Face, Mesh, NodeId, Vec3, generate::Block};
use striae_model::{
    Axes, Backend, Body, BodyId, ContactMass, ContactSurface, Curve, Displacement, Formulation,
    Increments, Initial, Load, LoadExtent, LoadKind, Model, Pair, PairId, Procedure, RigidId,
    RigidShape, RigidSurface, Solver, Step, Strategy,
};
use striae_solve::{
    drive::{Continue, Observer, Progress, run},
    newton::{Increment, IterationObserver, LinearWork},
    norms::Norms,
    outcome::{CutBack, Ending},
    problem::Problem,
    repetition::{Difference, Repetition},
    state::State,
};

/// Everything a run went through.
pub struct Run {
    pub problem: Problem,
    /// Converged states with the initial one in front.
    pub states: Vec<State>,
    /// Norms of all iterations of every increment.
    pub iterations: Vec<Vec<Norms>>,
    /// Work spent on the linear systems of every increment.
    pub work: Vec<LinearWork>,
    /// Interferences of every increment, by pair.
    pub interferences: Vec<Vec<Vec<Interference>>>,
    /// Ends of all increments.
    pub progress: Vec<Progress>,
    /// Failed attempts: where they were to end and why they failed.
    pub cuts: Vec<(Progress, CutBack)>,
    pub ending: Ending,
}

impl Run {
    pub fn of(model: Model) -> Self {
        Self::beside(model, None).0
    }

    /// The run of a model that gets through all steps, with the same answers by
    /// the condensed solver and by the multifrontal LU.
    pub fn completed(model: Model) -> Self {
        let (run, differences) = Self::beside(model, Some(Backend::Multifrontal));
        let cuts: Vec<String> = run.cuts.iter().map(|(_, cut)| cut.to_string()).collect();
        assert_eq!(run.ending, Ending::Completed, "{}\n{cuts:#?}", run.ending);
        assert_agree(&run.progress, &differences);
        run
    }

    /// The run of a model by the iterative solver, with the same answers by the
    /// multifrontal LU.
    pub fn iterated(mut model: Model) -> Self {
        model.solver.backend = Backend::Iterative;
        // Its corrections leave residuals just below the tolerance, and between steel and rubber
        // tractions differ by a thousand times as much.
        model.solver.tolerance = 1e-12;
        Self::completed(model)
    }

    /// The run of a model, and how far each increment of another solver is from its own.
    fn beside(model: Model, other: Option<Backend>) -> (Self, Vec<Result<Difference, CutBack>>) {
        let problem = Problem::new(model).unwrap();
        let start = State::undeformed(&problem);
        let mut record = Record {
            states: vec![start.clone()],
            repetition: other.map(|backend| Repetition::new(&problem, &start, backend)),
            ..Record::default()
        };
        let (_, ending) = run(&problem, start, &mut record);
        let differences = record.repetition.take();
        let differences = differences.map_or_else(Vec::new, |made| made.differences().to_vec());
        let Record {
            states,
            iterations,
            work,
            interferences,
            progress,
            cuts,
            ..
        } = record;
        let run = Self {
            problem,
            states,
            iterations,
            work,
            interferences,
            progress,
            cuts,
            ending,
        };
        (run, differences)
    }

    pub fn last(&self) -> &State {
        &self.states[self.states.len() - 1]
    }

    /// Positions of the nodes of a body.
    pub fn positions(&self, body: usize) -> &[Vec3] {
        let first = &self.problem.first_node;
        &self.last().positions[first[body]..first[body + 1]]
    }
}

/// Asserts that states agree to nine digits. The other solver makes no corrections of
/// contact alone; where it would cut the increment, which is the exception, there is
/// nothing to compare.
fn assert_agree(progress: &[Progress], differences: &[Result<Difference, CutBack>]) {
    let cuts = differences.iter().filter_map(|made| made.as_ref().err());
    let cuts: Vec<String> = cuts.map(CutBack::to_string).collect();
    let said = format!("{} of {} not compared", cuts.len(), differences.len());
    assert_eq!(progress.len(), differences.len());
    assert!(2 * cuts.len() < differences.len(), "{said}\n{cuts:#?}");
    for (progress, made) in progress.iter().zip(differences) {
        if let Ok(difference) = made {
            let agree = difference.positions <= 1e-9 && difference.tractions <= 1e-9;
            assert!(agree, "{difference:?} at {progress:?}, {said}");
        }
    }
}

#[derive(Default)]
struct Record<'a> {
    states: Vec<State>,
    iterations: Vec<Vec<Norms>>,
    work: Vec<LinearWork>,
    interferences: Vec<Vec<Vec<Interference>>>,
    progress: Vec<Progress>,
    cuts: Vec<(Progress, CutBack)>,
    repetition: Option<Repetition<'a>>,
}

impl IterationObserver for Record<'_> {
    fn iteration(&mut self, _: usize, _: &Norms, _: &[Evaluation]) {}
}

impl Observer for Record<'_> {
    fn step(&mut self, index: usize, name: &str) {
        if let Some(repetition) = &mut self.repetition {
            repetition.step(index, name);
        }
    }

    fn increment(&mut self, progress: Progress, increment: &Increment) -> Continue {
        self.states.push(increment.state.clone());
        self.iterations.push(increment.iterations.clone());
        self.work.push(increment.work);
        self.interferences.push(increment.interferences.clone());
        self.progress.push(progress);
        match &mut self.repetition {
            Some(repetition) => repetition.increment(progress, increment),
            None => Continue::Yes,
        }
    }

    fn cut_back(&mut self, progress: Progress, reason: &CutBack) -> Continue {
        self.cuts.push((progress, reason.clone()));
        Continue::Yes
    }
}

/// A neo-Hookean solid.
pub fn rubber(youngs_modulus: f64, poissons_ratio: f64) -> Material {
    let constants = LameConstants::from_youngs_modulus(youngs_modulus, poissons_ratio);
    Material::neo_hookean(constants.unwrap())
}

pub fn coulomb(mu: f64) -> Friction {
    Friction::coulomb(mu).unwrap()
}

pub fn block(origin: [f64; 3], size: [f64; 3], divisions: [usize; 3]) -> Block {
    Block {
        origin: origin.into(),
        size: size.into(),
        divisions,
        ..Block::default()
    }
}

pub fn body(name: &str, mesh: Mesh, material: Material) -> Body {
    Body {
        name: name.to_owned(),
        mesh,
        formulation: Formulation::suited_to(&material),
        material,
        density: 0.0,
        contact_mass: ContactMass::Consistent,
        sections: Vec::new(),
    }
}

/// Pieces of one mesh of hexahedra; sets of piece `k` have the names `k.NAME`.
pub fn pieces(meshes: &[Mesh]) -> Mesh {
    let (mut positions, mut cells, mut first) = (Vec::new(), Vec::new(), Vec::new());
    for mesh in meshes {
        first.push(positions.len());
        let number = |node: &NodeId| NodeId::new(positions.len() + node.index());
        let of_mesh = mesh.elements().map(|corners| {
            let corners: Vec<NodeId> = corners.iter().map(number).collect();
            <[NodeId; 8]>::try_from(corners).expect("hexahedra")
        });
        cells.extend(of_mesh.collect::<Vec<_>>());
        positions.extend_from_slice(&mesh.positions);
    }
    let mut whole = Mesh::new(positions, vec![CellBlock::hexahedra(cells)]).unwrap();
    for (piece, mesh) in meshes.iter().enumerate() {
        for (name, nodes) in mesh.node_sets.iter() {
            let nodes = nodes
                .iter()
                .map(|node| NodeId::new(first[piece] + node.index()));
            let nodes: Vec<NodeId> = nodes.collect();
            let name = format!("{piece}.{name}");
            whole.facet_sets.insert(&name, whole.faces_of_nodes(&nodes));
            whole.node_sets.insert(&name, nodes);
        }
    }
    whole
}

/// A model without contact and steps.
pub fn model(bodies: Vec<Body>) -> Model {
    Model {
        ties: Vec::new(),
        springs: Vec::new(),
        cavities: Vec::new(),
        title: String::new(),
        bodies,
        rigid_surfaces: Vec::new(),
        pairs: Vec::new(),
        steps: Vec::new(),
        solver: Solver {
            backend: Backend::Condensed,
            strategy: Strategy::Semismooth,
            tolerance: 1e-11,
            largest_iterations: 15,
            further_iterations: 0,
        },
    }
}

/// A step of one increment without conditions.
pub fn step() -> Step {
    Step {
        name: "step".to_owned(),
        duration: 1.0,
        procedure: Procedure::QuasiStatic,
        increments: whole(),
        velocities: Vec::new(),
        gravity: None,
        displacements: Vec::new(),
        releases: Vec::new(),
        loads: Vec::new(),
        forces: Vec::new(),
        actuations: Vec::new(),
        fillings: Vec::new(),
        rigid_motions: Vec::new(),
        frictions: Vec::new(),
    }
}

/// One increment that is not cut.
pub fn whole() -> Increments {
    increments(1.0, 0.9)
}

/// Increments of at most `size`.
pub fn increments(size: f64, smallest: f64) -> Increments {
    Increments {
        initial: size,
        smallest,
        largest: size,
    }
}

/// Positions of parts of a model.
pub trait Places {
    fn body(&self, name: &str) -> usize;
    fn nodes(&self, body: &str, set: &str) -> Vec<NodeId>;
    fn faces(&self, body: &str, set: &str) -> Vec<Face>;
    /// The node at a reference position.
    fn node_at(&self, body: &str, x: [f64; 3]) -> NodeId;
    fn touch(&mut self, a: (&str, &str), b: (&str, &str), friction: Friction) -> PairId;
    /// Faces of a body that may touch each other.
    fn touch_itself(&mut self, body: &str, sets: &[&str], friction: Friction) -> PairId;
    fn touch_rigid(&mut self, a: (&str, &str), shape: RigidShape, friction: Friction) -> PairId;
    fn hold(&self, body: &str, set: &str, components: [Option<f64>; 3]) -> Displacement;
    fn pin(&self, body: &str, x: [f64; 3], components: [Option<f64>; 3]) -> Displacement;
    fn load(&self, body: &str, set: &str, kind: LoadKind, extent: LoadExtent) -> Load;
}

impl Places for Model {
    fn body(&self, name: &str) -> usize {
        let found = self.bodies.iter().position(|body| body.name == name);
        found.unwrap_or_else(|| panic!("no body {name}"))
    }

    fn nodes(&self, body: &str, set: &str) -> Vec<NodeId> {
        let mesh = &self.bodies[self.body(body)].mesh;
        mesh.node_sets.get(set).unwrap().to_vec()
    }

    fn faces(&self, body: &str, set: &str) -> Vec<Face> {
        let mesh = &self.bodies[self.body(body)].mesh;
        mesh.facet_sets.get(set).unwrap().to_vec()
    }

    fn node_at(&self, body: &str, x: [f64; 3]) -> NodeId {
        let positions = &self.bodies[self.body(body)].mesh.positions;
        let distance = |node: &usize| (positions[*node] - Vec3::from(x)).norm();
        let nearest = (0..positions.len()).min_by(|a, b| distance(a).total_cmp(&distance(b)));
        let nearest = nearest.unwrap();
        assert!(distance(&nearest) < 1e-9, "no node at {x:?}");
        NodeId::new(nearest)
    }

    fn touch(&mut self, a: (&str, &str), b: (&str, &str), friction: Friction) -> PairId {
        let side = |(body, set): (&str, &str)| ContactSurface::Deformable {
            body: BodyId(self.body(body)),
            faces: self.faces(body, set),
        };
        let pair = pair("interface", side(a), side(b), friction);
        self.pairs.push(pair);
        PairId(self.pairs.len() - 1)
    }

    fn touch_itself(&mut self, body: &str, sets: &[&str], friction: Friction) -> PairId {
        let faces = sets.iter().flat_map(|set| self.faces(body, set)).collect();
        let side = ContactSurface::Deformable {
            body: BodyId(self.body(body)),
            faces,
        };
        let mut pair = pair("interface", side, ContactSurface::Itself, friction);
        pair.feature_angle = Some(45.0);
        self.pairs.push(pair);
        PairId(self.pairs.len() - 1)
    }

    fn touch_rigid(&mut self, a: (&str, &str), shape: RigidShape, friction: Friction) -> PairId {
        let side = ContactSurface::Deformable {
            body: BodyId(self.body(a.0)),
            faces: self.faces(a.0, a.1),
        };
        self.rigid_surfaces.push(RigidSurface::new("floor", shape));
        let rigid = ContactSurface::Rigid(RigidId(self.rigid_surfaces.len() - 1));
        self.pairs.push(pair("interface", side, rigid, friction));
        PairId(self.pairs.len() - 1)
    }

    fn hold(&self, body: &str, set: &str, components: [Option<f64>; 3]) -> Displacement {
        Displacement {
            axes: Axes::Global,
            set: set.to_owned(),
            body: BodyId(self.body(body)),
            nodes: self.nodes(body, set),
            components: components.map(|of| of.map(Into::into)),
            curve: Curve::Ramp,
        }
    }

    fn pin(&self, body: &str, x: [f64; 3], components: [Option<f64>; 3]) -> Displacement {
        Displacement {
            axes: Axes::Global,
            set: "pin".to_owned(),
            body: BodyId(self.body(body)),
            nodes: vec![self.node_at(body, x)],
            components: components.map(|of| of.map(Into::into)),
            curve: Curve::Ramp,
        }
    }

    fn load(&self, body: &str, set: &str, kind: LoadKind, extent: LoadExtent) -> Load {
        Load {
            set: set.to_owned(),
            body: BodyId(self.body(body)),
            faces: self.faces(body, set),
            kind: kind.into(),
            extent,
            curve: Curve::Ramp,
        }
    }
}

fn pair(name: &str, a: ContactSurface, b: ContactSurface, friction: Friction) -> Pair {
    Pair {
        name: name.to_owned(),
        a,
        b,
        textures: [None, None],
        friction,
        enforcement: Enforcement::Weighted,
        search_distance: None,
        initial: Initial::AsMeshed,
        interference: None,
        wear: [0.0; 2],
        wear_across: 1.0,
        stabilised: false,
        feature_angle: None,
    }
}

/// The plane through `point`.
pub fn plane(point: [f64; 3], normal: [f64; 3]) -> RigidShape {
    RigidShape::Plane {
        point: point.into(),
        normal: normal.into(),
    }
}

/// The lower side of `block` on a plane with friction, its top pressed down by 0.02.
pub fn pressed_on_plane(mesh: Mesh, mu: f64) -> Model {
    let mut model = model(vec![body("block", mesh, rubber(1.0, 0.3))]);
    model.touch_rigid(
        ("block", "zmin"),
        plane([0.0; 3], [0.0, 0.0, 1.0]),
        coulomb(mu),
    );
    let mut press = step();
    press.displacements = vec![model.hold("block", "zmax", [Some(0.0), Some(0.0), Some(-0.02)])];
    model.steps = vec![press];
    model
}

/// Largest distance between corresponding points.
pub fn largest_distance(a: &[Vec3], b: &[Vec3]) -> f64 {
    assert_eq!(a.len(), b.len());
    let distances = a.iter().zip(b).map(|(a, b)| (a - b).norm());
    distances.fold(0.0, f64::max)
}
