//! A block whose nodes all slide along `x` only, as in a fitting groove, on a rigid plane
//! with friction that depends on direction.
//!
//! With the shear `g` and the stretch `b` of the height,
//!
//! ```text
//!     | 1 0 g |
//! F = | 0 1 0 |     sigma = G/J (B - 1) + lambda (J - 1) 1,     J = b
//!     | 0 0 b |
//! ```
//!
//! the base carries `p = -sigma_zz` and `tau_x = -G g`. It sticks until `tau_x` is what the
//! law states along `x` for slip along `x`. What it states across goes to the walls.

use nalgebra::{Matrix3, Vector2};
use striae_contact::unknowns::Status;
use striae_mesh::{NodeId, Vec3};
use striae_model::{Axes, BodyId, Curve, Displacement, Model};
use striae_solve::report;

use crate::{
    oblique::{Formula, Oblique, Sliding},
    scene::{Places, Run, block},
    table::STRONG,
};

/// The state of sliding, or of sticking at a share of its shear.
fn guided(oblique: &Oblique, degrees: f64, share: f64) -> Sliding {
    let free = oblique.sliding(degrees);
    let mut gradient = free.gradient;
    gradient[(0, 2)] *= share;
    gradient[(1, 2)] = 0.0;
    let (j, left) = (gradient.determinant(), gradient * gradient.transpose());
    // `lambda (J - 1)`, as the shear modulus is one.
    let lateral = free.stress[(0, 0)] - free.gradient[(0, 2)].powi(2) / j;
    let stress = (left - Matrix3::identity()) / j + Matrix3::identity() * lateral;
    Sliding {
        gradient,
        stress,
        ..free
    }
}

/// Prescribes `y` of all nodes below the top.
fn walls(model: &Model) -> Displacement {
    let mesh = &model.bodies[0].mesh;
    let top = model.nodes("block", "zmax");
    let nodes = (0..mesh.positions.len()).map(NodeId::new);
    Displacement {
        axes: Axes::Global,
        set: "below".to_owned(),
        body: BodyId(0),
        nodes: nodes.filter(|node| !top.contains(node)).collect(),
        components: [None, Some(0.0.into()), None],
        curve: Curve::Ramp,
    }
}

/// Statuses and force on the block at the ends of steps that press it, shear it by
/// nearly what friction bears, and a little further.
fn pressed_and_sheared(oblique: &Oblique, degrees: f64) -> [(Vec<Status>, Vec3); 3] {
    let mut model = oblique.model(&block([0.0; 3], [1.0, 1.0, 0.6], [2, 3, 1]));
    let direction = oblique.sliding(degrees).direction;
    for (share, place) in [(0.0, 0.0), (0.999, 0.0), (1.0, 0.001)] {
        let sliding = guided(oblique, degrees, share);
        let mut step = sliding.step(&model, direction * place, 1);
        step.displacements.push(walls(&model));
        model.steps.push(step);
    }
    let run = Run::completed(model);
    assert_eq!(run.states.len(), 4);
    [1, 2, 3].map(|at| {
        let nodes = run.states[at].pairs[0].nodes[0].iter();
        let force = report::pairs(&run.problem, &run.states[at])[0].sides[0].force;
        (nodes.map(|node| node.status).collect(), force)
    })
}

#[test]
fn friction_bears_what_the_law_states_along_the_groove() {
    for (law, angles) in [
        (Formula::Coulomb(0.3), [None, None]),
        (Formula::Opposing([0.15, 0.4]), [Some(35.0), None]),
        (Formula::Associated([0.15, 0.4]), [None, Some(35.0)]),
        (Formula::Associated([0.4, 0.15]), [Some(-70.0), None]),
        (Formula::Nap([0.1, 0.3, 0.2]), [None, Some(65.0)]),
        (Formula::Tabulated(STRONG), [Some(15.0), None]),
        (
            Formula::TwoTextures([0.2, 0.3, 0.8, 0.5]),
            [Some(15.0), Some(70.0)],
        ),
    ] {
        let oblique = Oblique::new(law, angles);
        for degrees in [0.0, 180.0] {
            let expected = oblique.sliding(degrees);
            let (p, tau) = (expected.pressure, expected.tau);
            let [pressed, stuck, slid] = pressed_and_sheared(&oblique, degrees);
            let name = format!("{law:?} {degrees}");
            let close = |force: Vec3, tau: Vector2<f64>| {
                let off = (force - tau.push(p)).norm() / p;
                assert!(off < 1e-8, "{name}: {force} for {tau} and {p}");
            };
            let x = |tau: Vector2<f64>| Vec3::new(tau.x, 0.0, p);
            let along_x = |force: Vec3| Vec3::new(force.x, 0.0, force.z);
            assert!(
                (along_x(stuck.1) - x(0.999 * tau)).norm() < 1e-8 * p,
                "{name}"
            );
            assert!(
                (along_x(pressed.1) - x(0.0 * tau)).norm() < 1e-8 * p,
                "{name}"
            );
            assert_eq!(stuck.0, vec![Status::Stick; stuck.0.len()], "{name}");
            assert_eq!(slid.0, vec![Status::Slip; slid.0.len()], "{name}");
            close(slid.1, tau);
        }
    }
}
