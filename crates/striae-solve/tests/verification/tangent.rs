//! Tangent of contact: the error of central differences falls with the square of the step.

use crate::scene::{Places, block, body, coulomb, model, plane, rubber, step};
use nalgebra::{DMatrix, DVector};
use striae_contact::{
    complementarity::Iteration,
    configuration::Configuration,
    evaluation::{Evaluation, evaluate},
    frame::frames,
    placement::Placement,
    selection::{Role, Selection},
    table_1::{Corrector, Inflation},
    unknowns::{Status, Tractions},
};
use striae_law::friction::Friction;
use striae_mesh::{NodeId, Vec3};
use striae_solve::{
    assembly::StepContext,
    model::{Model, RigidShape},
    problem::Problem,
    rigid::Pose,
    state::State,
};
use striae_verify::{Difference, Random, derivative::directional};

const MODULUS: f64 = 1.0;

/// A pair with fixed roles as a function of its unknowns.
struct Contact<'a> {
    context: &'a StepContext<'a>,
    selection: Selection,
    counts: [usize; 2],
    placement: Placement,
    iteration: Iteration,
}

impl<'a> Contact<'a> {
    fn new(context: &'a StepContext<'a>, positions: &[Vec3]) -> Self {
        let rigid = vec![Pose::at_rest(); context.problem.model.rigid_surfaces.len()];
        let configuration = context.configuration(0, positions, &rigid);
        let counts = [0, 1].map(|side| {
            let deformable = context.problem.pairs[0].bodies[side].is_some();
            let surface = context.pairs[0].sides[side].surface();
            surface.map_or(0, |s| if deformable { s.nodes().len() } else { 0 })
        });
        let untouched = counts.map(|count| vec![false; count]);
        Self {
            selection: Selection::new(&configuration, &untouched),
            context,
            counts,
            placement: Pose::at_rest()
                .moved_to(&[0.01, -0.02, 0.003, 0.001, -0.002, 0.1])
                .placement(&Vec3::zeros()),
            iteration: Iteration::Later,
        }
    }

    fn nodes(&self) -> usize {
        self.counts[0] + self.counts[1]
    }

    fn len(&self) -> usize {
        6 * self.nodes() + 6 * self.selection.patches.len()
    }

    fn configuration(&self, u: &DVector<f64>) -> Configuration<'_> {
        let at = |node: usize| Vec3::new(u[3 * node], u[3 * node + 1], u[3 * node + 2]);
        let a = (0..self.counts[0]).map(at).collect();
        let b = if self.context.pairs[0].is_rigid() {
            self.context.problem.pairs[0].rigid_reference.clone()
        } else {
            (self.counts[0]..self.nodes()).map(at).collect()
        };
        let rigid = if self.context.pairs[0].is_rigid() {
            self.placement
        } else {
            Placement::at_rest()
        };
        Configuration::new(&self.context.pairs[0], [a, b], rigid)
    }

    fn tractions(&self, u: &DVector<f64>) -> Tractions {
        let first = 3 * self.nodes();
        let triple = |node: usize| [0, 1, 2].map(|at| u[first + 3 * node + at]);
        let balance = |patch: usize| [0, 1, 2, 3, 4, 5].map(|at| u[2 * first + 6 * patch + at]);
        Tractions {
            nodes: [
                (0..self.counts[0]).map(triple).collect(),
                (self.counts[0]..self.nodes()).map(triple).collect(),
            ],
            balance: (0..self.selection.patches.len()).map(balance).collect(),
            slipped: self.counts.map(|count| vec![false; count]),
            statuses: self.counts.map(|count| vec![Status::Slip; count]),
        }
    }

    fn evaluation(&self, u: &DVector<f64>) -> Evaluation {
        let free = self.counts.map(|count| vec![false; 3 * count]);
        let (configuration, tractions) = (self.configuration(u), self.tractions(u));
        evaluate(
            &configuration,
            &self.selection,
            &tractions,
            &free,
            self.iteration,
        )
        .unwrap()
    }

    fn residual(&self, u: &DVector<f64>) -> DVector<f64> {
        let mut residual = DVector::zeros(self.len());
        for term in &self.evaluation(u).terms {
            for (row, value) in term.rows.iter().zip(&term.residual) {
                residual[*row as usize] += value;
            }
        }
        residual
    }

    fn tangent(&self, u: &DVector<f64>) -> DMatrix<f64> {
        let mut tangent = DMatrix::zeros(self.len(), self.len());
        for term in &self.evaluation(u).terms {
            for (at, row) in term.rows.iter().enumerate() {
                for (slot, column) in term.columns.iter().enumerate() {
                    tangent[(*row as usize, *column as usize)] +=
                        term.tangent[at * term.columns.len() + slot];
                }
            }
        }
        tangent
    }

    /// Unknowns at the given positions with nodes of every status away from
    /// the kinks; slip rows are satisfied, since only there is their Jacobian exact.
    fn state(&self, positions: &[Vec3], random: &mut Random) -> DVector<f64> {
        let problem = self.context.problem;
        let mut u = DVector::zeros(self.len());
        for side in 0..2 {
            for node in 0..self.counts[side] {
                let global = problem.surface_node(0, side, node as u32).unwrap();
                let local = side * self.counts[0] + node;
                u.rows_mut(3 * local, 3).copy_from(&positions[global]);
            }
        }
        let first = 3 * self.nodes();
        for at in first..2 * first {
            u[at] = random.uniform(0.2, 0.4);
        }
        for at in 2 * first..u.len() {
            u[at] = random.uniform(-0.1, 0.1);
        }
        let configuration = self.configuration(&u);
        let frames = frames(&configuration, &self.selection).unwrap();
        let nodes = self.evaluation(&u).nodes;
        let mut kinematic = 0;
        for side in 0..2 {
            for node in 0..self.counts[side] {
                if !matches!(self.selection.roles[side][node], Role::Kinematic(_)) {
                    continue;
                }
                kinematic += 1;
                let frame = frames[side][node].as_ref().unwrap();
                let slip = nodes[side][node].slip;
                let slip = [0, 1].map(|axis| slip.dot(&frame.t[axis].value));
                let length = slip[0].hypot(slip[1]);
                let at = first + 3 * (side * self.counts[0] + node);
                let size = configuration.side(side).sizes[node];
                let varpi = self.context.pairs[0].friction.cap(u[at], 0.0);
                let factor = match kinematic % 3 {
                    0 => {
                        u[at] = -0.6;
                        -1.0
                    }
                    1 => varpi / length,
                    _ => -10.0 * MODULUS / size + 0.1 * varpi / length,
                };
                u[at + 1] = factor * slip[0];
                u[at + 2] = factor * slip[1];
            }
        }
        u
    }

    fn statuses(&self, u: &DVector<f64>) -> Vec<Status> {
        let nodes = self.evaluation(u).nodes;
        let mut found = Vec::new();
        for side in 0..2 {
            for (role, node) in self.selection.roles[side].iter().zip(&nodes[side]) {
                if matches!(role, Role::Kinematic(_)) {
                    found.push(node.status);
                }
            }
        }
        found
    }

    fn has_role(&self, wanted: impl Fn(&Role) -> bool) -> bool {
        self.selection.roles.iter().flatten().any(wanted)
    }
}

fn assert_order(contact: &Contact, u: &DVector<f64>) {
    let tangent = contact.tangent(u);
    for seed in 0..2 {
        let direction = Random::new(seed).unit(u.len());
        let claimed = &tangent * &direction;
        let order = directional(
            Difference::Central,
            |u| contact.residual(u),
            &claimed,
            u,
            &direction,
        );
        if let Err(wrong) = order {
            panic!("{wrong}");
        }
    }
}

/// Raises the nodes of a model by a smooth bump.
fn bumpy(x: &Vec3, height: f64) -> Vec3 {
    x + Vec3::z() * height * ((1.7 * x.x).sin() * (1.3 * x.y + 0.4).cos())
}

pub fn two_blocks(friction: Friction) -> Model {
    let mut lower = block([0.0; 3], [1.0, 1.0, 0.5], [3, 3, 1]);
    let mut upper = block([0.23, 0.17, 0.5], [1.1, 0.7, 0.5], [3, 3, 1]);
    lower.irregularity = 0.15;
    upper.irregularity = 0.15;
    upper.mesh_rotation = 10.0;
    let bodies = vec![
        body("lower", lower.mesh().unwrap(), rubber(2.0, 0.3)),
        body("upper", upper.mesh().unwrap(), rubber(MODULUS, 0.3)),
    ];
    let mut model = model(bodies);
    model.touch(("lower", "zmax"), ("upper", "zmin"), friction);
    model.steps = vec![step()];
    model
}

#[test]
fn of_two_curved_surfaces_that_stick_slip_and_open() {
    let problem = Problem::new(two_blocks(coulomb(0.5))).unwrap();
    let start = State::undeformed(&problem);
    let context = StepContext::new(&problem, 0, &start);
    let mut random = Random::new(7);
    let before: Vec<Vec3> = start.positions.iter().map(|x| bumpy(x, 0.08)).collect();
    let mut contact = Contact::new(&context, &before);
    let after: Vec<Vec3> = before
        .iter()
        .enumerate()
        .map(|(node, x)| {
            let slide = if node < problem.first_node[1] {
                Vec3::zeros()
            } else {
                Vec3::new(0.023, 0.014, -0.004)
            };
            x + slide + random.vector3() * 0.004
        })
        .collect();
    let u = contact.state(&after, &mut random);
    let statuses = contact.statuses(&u);
    for status in [Status::Open, Status::Stick, Status::Slip] {
        assert!(
            statuses.contains(&status),
            "no node is {status:?}: {statuses:?}"
        );
    }
    contact.iteration = Iteration::Corrected(Corrector {
        stick_tolerance: 0.01,
        inflation: Inflation::default().after(0.0),
    });
    assert_eq!(contact.statuses(&u), statuses);
    assert_order(&contact, &u);
    contact.iteration = Iteration::Later;
    assert!(contact.has_role(|role| matches!(role, Role::Traction(_))));
    assert!(contact.has_role(|role| matches!(role, Role::Extended(_))));
    assert_eq!(contact.selection.patches.len(), 1);
    assert_order(&contact, &u);
}

pub fn on_rigid(shape: RigidShape) -> Model {
    let mut mesh = block([0.0; 3], [1.0, 1.0, 0.5], [3, 3, 1]);
    mesh.irregularity = 0.15;
    let mut model = model(vec![body(
        "block",
        mesh.mesh().unwrap(),
        rubber(MODULUS, 0.3),
    )]);
    model.touch_rigid(("block", "zmin"), shape, coulomb(0.5));
    model.steps = vec![step()];
    model
}

/// Facets over `[-0.5, 0.85] x [-0.5, 1.5]`: the block overhangs on one side.
pub fn dome(corners: usize) -> RigidShape {
    let count = 4;
    let positions = (0..(count + 1) * (count + 1)).map(|k| {
        let share = |i: usize| i as f64 / count as f64;
        let (x, y) = (share(k % (count + 1)), share(k / (count + 1)));
        bumpy(&Vec3::new(1.35 * x - 0.5, 2.0 * y - 0.5, 0.0), 0.1)
    });
    let node = |i: usize, j: usize| NodeId::new(i + (count + 1) * j);
    let cells = (0..count * count).map(|k| (k % count, k / count));
    let facets = cells.flat_map(|(i, j)| {
        let [a, b, c, d] = [
            node(i, j),
            node(i + 1, j),
            node(i + 1, j + 1),
            node(i, j + 1),
        ];
        if corners == 4 {
            vec![[a, b, c, d]]
        } else {
            vec![[a, b, c, c], [a, c, d, d]]
        }
    });
    RigidShape::Facets {
        positions: positions.collect(),
        facets: facets.collect(),
    }
}

#[test]
fn on_rigid_surfaces() {
    let inclined = plane([0.0, 0.0, 0.01], [0.02, -0.03, 1.0]);
    for (shape, bump) in [(inclined, 0.0), (dome(4), 0.1), (dome(3), 0.1)] {
        let problem = Problem::new(on_rigid(shape)).unwrap();
        let start = State::undeformed(&problem);
        let context = StepContext::new(&problem, 0, &start);
        let mut random = Random::new(11);
        let before: Vec<Vec3> = start.positions.iter().map(|x| bumpy(x, bump)).collect();
        let contact = Contact::new(&context, &before);
        let slide = Vec3::new(0.03, 0.01, -0.005);
        let after: Vec<Vec3> = before
            .iter()
            .map(|x| x + slide + random.vector3() * 0.004)
            .collect();
        let u = contact.state(&after, &mut random);
        let statuses = contact.statuses(&u);
        for status in [Status::Open, Status::Stick, Status::Slip] {
            assert!(statuses.contains(&status), "no node is {status:?}");
        }
        assert_order(&contact, &u);
    }
}
