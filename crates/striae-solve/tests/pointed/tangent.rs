//! Tangent with pointed nodes: the error of central differences falls with the square of
//! the step.

use nalgebra::{DMatrix, DVector};
use striae_contact::{
    complementarity::{Conditions, Iteration},
    configuration::Configuration,
    evaluation::{Evaluation, evaluate},
    segment::Derivatives,
    selection::{Before, Kept, Selection},
    side::Side,
    spot::Spot,
    tip::{RigidPoint, RigidPoints, Tip},
    unknowns::{Status, Tractions},
};
use striae_law::friction::{Friction, SlipRule};
use striae_mesh::Vec3;
use striae_solve::{assembly::StepContext, model::Model, problem::Problem, state::State};
use striae_surface::{
    node::SurfaceNode,
    texture::{Field, Lines, Paint},
};
use striae_verify::{Difference, Random, derivative::directional};

use crate::scene::{Floor, TOP, moved, standing, tilted};

/// What the field does beside the pointed nodes.
#[derive(Clone, Copy, PartialEq)]
enum Carries {
    Traction,
    Nothing,
}

/// What the sole over a rigid ridge is like.
#[derive(Clone, Copy, PartialEq)]
enum Sole {
    Plane,
    /// Dips towards its edge along the ridge.
    Valley,
    /// Dips towards its node over the vertex of the ridge.
    Pit,
}

/// A pair with all nodes of the edge pointed as a function of its unknowns.
struct Contact<'a> {
    sole: Sole,
    context: &'a StepContext<'a>,
    start: Configuration<'a>,
    selection: Selection,
}

impl<'a> Contact<'a> {
    fn new(context: &'a StepContext<'a>, sole: Sole) -> Self {
        let state = context.start;
        let start = context.configuration(0, &state.positions, &state.rigid);
        let none = state.pairs[0].kept.clone();
        let mut pointed: Kept = none.clone();
        for (node, x) in start.side(Side::A).x.iter().enumerate() {
            pointed[0][node] = !is_sharp(&start) && x.x.hypot(x.z) < 0.1;
        }
        let points = points(&start);
        let before = Before {
            kept: &none,
            required: &none,
            pointed: &pointed,
            points: &points,
        };
        let selection = Selection::new(&start, None, before, &context.fixed_on_pair[0]);
        Self {
            sole,
            context,
            start,
            selection,
        }
    }

    /// Where a node of the block is put from its place at the start.
    fn place(&self, x: &Vec3, random: Vec3) -> Vec3 {
        const INNER: [f64; 2] = [1.0 / 3.0, 1.0 / 6.0];
        const DEPTH: f64 = 0.03;
        let (way, slopes) = match self.sole {
            Sole::Plane => return x + Vec3::new(0.031, 0.023, -0.021) + random * 0.006,
            Sole::Valley => (Vec3::new(TOP - INNER[0], 0.023, -DEPTH), [0.3, 0.0]),
            Sole::Pit => {
                let to_vertex = Vec3::new(TOP - INNER[0], 0.07 - INNER[1], -DEPTH);
                (to_vertex, [0.3, 0.2])
            }
        };
        let dips = slopes[0] * (x.x - INNER[0]).abs() + slopes[1] * (x.y - INNER[1]).abs();
        x + way - Vec3::z() * dips + random * 0.0005
    }

    /// Whether rigid points are on edges or at nodes of the sole, as that is.
    fn is_between(&self, u: &DVector<f64>) -> bool {
        let now = self.configuration(u);
        let on_border = |point: &RigidPoint| {
            let hit = Spot::new(&now, Tip::Rigid(*point)).unwrap().hit.unwrap();
            [hit.xi, hit.eta].map(|c| usize::from(c.abs() == 1.0))
        };
        let points = self.selection.points.iter().flatten();
        let most = points.map(|point| on_border(point).iter().sum()).max();
        most.unwrap_or(0) == self.sole as usize
    }

    fn nodes(&self) -> [usize; 2] {
        Side::BOTH.map(|side| self.selection.nodes(side))
    }

    fn traction(&self, side: Side, node: SurfaceNode) -> usize {
        let numbering = self.context.pairs[0].numbering();
        numbering.traction(side, node) as usize
    }

    fn configuration(&self, u: &DVector<f64>) -> Configuration<'_> {
        let [a, b] = self.nodes();
        let at = |node: usize| Vec3::new(u[3 * node], u[3 * node + 1], u[3 * node + 2]);
        let rigid = &self.context.problem.pairs[0].rigid_reference;
        let pair = &self.context.pairs[0];
        let of_b = if pair.is_rigid() {
            rigid.clone()
        } else {
            (a..a + b).map(at).collect()
        };
        Configuration::new(pair, [(0..a).map(at).collect(), of_b], self.start.placement)
    }

    fn tractions(&self, u: &DVector<f64>) -> Tractions {
        let mut tractions = Tractions::zero(self.nodes());
        for side in Side::BOTH {
            for (node, unknowns) in tractions.nodes[side].iter_mut().enumerate() {
                let at = self.traction(side, SurfaceNode::new(node));
                *unknowns = [u[at], u[at + 1], u[at + 2]];
            }
        }
        tractions
    }

    fn evaluation(&self, u: &DVector<f64>) -> Evaluation {
        evaluate(
            &self.configuration(u),
            &self.start,
            &self.selection,
            &self.tractions(u),
            Conditions {
                friction: &self.context.plan.frictions[0],
                prescribed: &self.nodes().map(|count| vec![false; 3 * count]),
                iteration: Iteration::LATER,
                wanted: None,
            },
            Derivatives::First,
        )
        .unwrap()
    }

    fn residual(&self, u: &DVector<f64>) -> DVector<f64> {
        let mut residual = DVector::zeros(u.len());
        for term in &self.evaluation(u).terms {
            for (row, value) in term.rows.iter().zip(&term.residual) {
                residual[*row as usize] += value;
            }
        }
        residual
    }

    fn tangent(&self, u: &DVector<f64>) -> DMatrix<f64> {
        let mut tangent = DMatrix::zeros(u.len(), u.len());
        for term in &self.evaluation(u).terms {
            for (row, values) in term
                .rows
                .iter()
                .zip(term.tangent.chunks(term.columns.len()))
            {
                for (column, value) in term.columns.iter().zip(values) {
                    tangent[(*row as usize, *column as usize)] += value;
                }
            }
        }
        tangent
    }

    /// Unknowns with nodes of every status away from kinks; slip rows are satisfied, since
    /// only there is their Jacobian exact.
    fn state(&self, field: Carries, random: &mut Random) -> DVector<f64> {
        let pair = &self.context.pairs[0];
        let mut u = DVector::zeros(pair.numbering().count() as usize);
        for &side in pair.deformable_sides() {
            for node in SurfaceNode::all(self.nodes()[side]) {
                let (x, random) = (&self.start.side(side).x[node], random.vector3());
                let x = match side {
                    Side::A => self.place(x, random),
                    Side::B => x + random * 0.006,
                };
                let first = pair.numbering().position(side, node) as usize;
                u.rows_mut(first, 3).copy_from(&x);
            }
        }
        let traction = |side: Side, node: SurfaceNode| self.traction(side, node);
        let kept = self.selection.kept();
        for (k, kept) in kept.iter().enumerate() {
            let at = traction(kept.side, kept.node);
            let values = [random.uniform(0.3, 0.5), 0.01, -0.02];
            u.rows_mut(at, 3).copy_from_slice(&values);
            if k % 3 == 0 {
                u[at] = -0.9;
            }
            if k < self.selection.of_field && field == Carries::Nothing {
                u.rows_mut(at, 3).copy_from_slice(&[-0.9, 0.0, 0.0]);
            }
        }
        let pressed = |k: &usize| u[traction(kept[*k].side, kept[*k].node)] > 0.0;
        let sticking: Vec<usize> = (0..kept.len())
            .filter(|k| k % 3 == 1)
            .filter(pressed)
            .collect();
        for k in sticking {
            let (side, node) = kept[k].place();
            let evaluation = self.evaluation(&u);
            let slip = evaluation.nodes[side][node].slip;
            let frames = striae_contact::frame::frames(&self.configuration(&u), &self.selection);
            let frame = frames[side][node].as_ref().unwrap();
            let at = traction(side, node);
            for axis in 0..2 {
                let against = slip.dot(&frame.t[axis].value);
                u[at + 1 + axis] = -self.selection.stiffness(k)[1] * against;
            }
        }
        // The rows state `z - varpi y/|y|`, whose root attracts.
        for _ in 0..400 {
            let (residual, found) = (self.residual(&u), self.evaluation(&u).nodes);
            for kept in kept {
                let (side, node) = kept.place();
                if found[side][node].status == Status::Slip {
                    for at in traction(side, node) + 1..traction(side, node) + 3 {
                        u[at] -= residual[at];
                    }
                }
            }
        }
        u
    }
}

/// Whether the floor is a ridge.
fn is_sharp(start: &Configuration) -> bool {
    start.pair.is_rigid() && start.plane().is_none() && start.side(Side::B).x.len() == 9
}

/// Its vertex and points on its edges, with the nearest nodes.
fn points(start: &Configuration) -> RigidPoints {
    if !is_sharp(start) {
        return Vec::new();
    }
    let mut points = vec![None; start.side(Side::A).x.len()];
    let on = |ends: [u32; 2], share: f64| RigidPoint {
        ends: ends.map(SurfaceNode),
        share,
        left: 0.01,
    };
    let all = [
        RigidPoint::vertex(SurfaceNode(4)),
        on([1, 4], 0.4),
        on([1, 4], 0.6),
        on([4, 7], 0.4),
    ];
    for point in all {
        let x = point.position(start);
        let distance = |node: &usize| (start.side(Side::A).x[*node] - x).norm();
        let free = (0..points.len()).filter(|&node| points[node].is_none());
        let nearest = free.min_by(|a, b| distance(a).total_cmp(&distance(b)));
        points[nearest.unwrap()] = Some(point);
    }
    points
}

fn assert_order(model: Model, sole: Sole, field: Carries, wanted: &[Status]) {
    let mut model = model;
    model.steps = vec![moved(&model, [0.0; 3], 1)];
    let problem = Problem::new(model).unwrap();
    let start = State::undeformed(&problem);
    let context = StepContext::new(&problem, 0, &start);
    let contact = Contact::new(&context, sole);
    let pointed: Vec<_> = contact.selection.pointed_places().collect();
    assert_eq!(pointed.len(), 4);
    let mut random = Random::new(5);
    let u = contact.state(field, &mut random);
    assert!(contact.is_between(&u));
    let found = contact.evaluation(&u).nodes;
    let found: Vec<_> = pointed
        .iter()
        .map(|&k| contact.selection.kept()[k].place())
        .map(|(side, node)| found[side][node])
        .collect();
    let statuses: Vec<Status> = found.iter().map(|node| node.status).collect();
    for status in wanted {
        assert!(statuses.contains(status), "{status:?} not in {statuses:?}");
    }
    assert!(found.iter().all(|node| node.gap.is_finite()), "{found:?}");
    let tangent = contact.tangent(&u);
    for seed in 0..3 {
        let direction = Random::new(seed).unit(u.len());
        let claimed = &tangent * &direction;
        let residual = |u: &DVector<f64>| contact.residual(u);
        let order = directional(Difference::Central, residual, &claimed, &u, &direction);
        if let Err(wrong) = order {
            panic!("{wrong}");
        }
    }
}

const SCENES: [(Floor, Sole); 6] = [
    (Floor::Soft, Sole::Plane),
    (Floor::Plane, Sole::Plane),
    (Floor::Facets, Sole::Plane),
    (Floor::Ridge, Sole::Plane),
    (Floor::Ridge, Sole::Valley),
    (Floor::Ridge, Sole::Pit),
];

/// A block on a ridge stands flat.
fn angle(floor: Floor) -> f64 {
    if floor == Floor::Ridge { 3.0 } else { 33.0 }
}

#[test]
fn under_coulomb_friction() {
    for (floor, sole) in SCENES {
        let friction = Friction::coulomb(0.4).unwrap();
        let model = standing(tilted(angle(floor), 3), &["zmin", "xmin"], floor, friction);
        assert_order(
            model,
            sole,
            Carries::Traction,
            &[Status::Open, Status::Stick, Status::Slip],
        );
    }
}

#[test]
fn under_friction_of_the_opposing_texture() {
    for (floor, sole) in SCENES {
        let friction = Friction::orthotropic(0.2, 0.5, SlipRule::Associated).unwrap();
        let mut model = standing(tilted(angle(floor), 3), &["zmin", "xmin"], floor, friction);
        model.pairs[0].textures[1] = Some(Paint::Field(Field {
            lines: Lines::Uniform(Vec3::new(0.8, 0.6, 0.0)),
            turn: 0.0,
        }));
        // Textures that ordinary nodes see past the rim of the block are not differentiated.
        assert_order(model, sole, Carries::Nothing, &[Status::Open, Status::Slip]);
    }
}
