//! Models and the two configurations between which their contact is evaluated.

use nalgebra::Rotation3;
use striae_contact::placement::Placement;
use striae_law::friction::{Decay, Friction, PressureDependence, RateDependence, SlipDependence};
use striae_mesh::{CellKind, NodeId, Vec3};
use striae_model::{Model, RigidShape};
use striae_solve::{problem::Problem, rigid::Pose};
use striae_verify::Random;

use crate::{
    pair::Places,
    scene::{Places as _, block, body, coulomb, model, pieces, rubber, step},
};

/// The law with coefficients that depend on pressure, slip rate and accumulated slip.
pub fn dependent(friction: Friction) -> Friction {
    let power = PressureDependence::power_law(0.8, 0.5, None);
    let stribeck = RateDependence::decay(Decay {
        kinetic_over_static: 0.4,
        slip_rate: 0.3,
        exponent: 2.0,
        viscous: 0.2,
    });
    let friction = friction.with_pressure(power.expect("in range"));
    let run_in = SlipDependence::exponential(1.5, 0.2);
    let friction = friction.with_rate(stribeck.expect("in range"));
    friction.with_slip(run_in.expect("in range"))
}

/// Raises a point by a smooth bump.
pub fn bumpy(x: &Vec3, height: f64) -> Vec3 {
    x + Vec3::z() * height * ((1.7 * x.x).sin() * (1.3 * x.y + 0.4).cos())
}

/// Two blocks that overlap in part.
pub fn two_blocks(moduli: [f64; 2], divisions: [usize; 2], friction: Friction) -> Model {
    two_blocks_of([CellKind::Hexahedron; 2], moduli, divisions, friction)
}

/// Two blocks of other cells.
pub fn two_blocks_of(
    cells: [CellKind; 2],
    moduli: [f64; 2],
    divisions: [usize; 2],
    friction: Friction,
) -> Model {
    let [below, above] = divisions;
    let mut lower = block([0.0; 3], [1.0, 1.0, 0.5], [below, below, 1]);
    let mut upper = block([0.23, 0.17, 0.5], [1.1, 0.7, 0.5], [above, above, 1]);
    lower.irregularity = 0.15;
    upper.irregularity = 0.15;
    upper.mesh_rotation = 10.0;
    [lower.cells, upper.cells] = cells;
    let bodies = vec![
        body("lower", lower.mesh().unwrap(), rubber(moduli[0], 0.3)),
        body("upper", upper.mesh().unwrap(), rubber(moduli[1], 0.3)),
    ];
    let mut model = model(bodies);
    model.touch(("lower", "zmax"), ("upper", "zmin"), friction);
    model.steps = vec![step()];
    model
}

/// A block with its lower side on a rigid surface.
pub fn on_rigid(shape: RigidShape) -> Model {
    let mut mesh = block([0.0; 3], [1.0, 1.0, 0.5], [3, 3, 1]);
    mesh.irregularity = 0.15;
    let rubber = rubber(1.0, 0.3);
    let mut model = model(vec![body("block", mesh.mesh().unwrap(), rubber)]);
    model.touch_rigid(("block", "zmin"), shape, coulomb(0.5));
    model.steps = vec![step()];
    model
}

/// Two such blocks of the same material as pieces of one body, whose faces touch each other.
pub fn two_pieces(divisions: [usize; 2], friction: Friction) -> Model {
    let [lower, upper] = two_blocks([1.0, 1.0], divisions, coulomb(0.0))
        .bodies
        .try_into()
        .unwrap();
    let mesh = pieces(&[lower.mesh, upper.mesh]);
    let mut model = model(vec![body("blocks", mesh, rubber(1.0, 0.3))]);
    model.touch_itself("blocks", &["0.zmax", "1.zmin"], friction);
    model.steps = vec![step()];
    model
}

/// Facets over `[-0.5, 0.85] x [-0.5, 1.5]`: the block overhangs on one side.
pub fn dome(corners: usize) -> RigidShape {
    bumps(corners, 0.1)
}

/// Surface with bumps of a given height.
pub fn bumps(corners: usize, height: f64) -> RigidShape {
    let count = 4;
    let positions = (0..(count + 1) * (count + 1)).map(|k| {
        let share = |i: usize| i as f64 / count as f64;
        let (x, y) = (share(k % (count + 1)), share(k / (count + 1)));
        bumpy(&Vec3::new(1.35 * x - 0.5, 2.0 * y - 0.5, 0.0), height)
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

/// Two bodies curved and twisted, then all bent on and turned, the second also moved and
/// turned on the first.
pub fn of_bodies(problem: &Problem, seed: u64) -> [Places; 2] {
    of_pieces(problem, problem.first_node[1], seed)
}

/// Two pieces of one body in the same way, the second one from a node on.
pub fn of_pieces(problem: &Problem, first_of_second: usize, seed: u64) -> [Places; 2] {
    let mut random = Random::new(seed);
    let twisted = |x: &Vec3| bumpy(x, 0.08) + Vec3::z() * (0.1 * x.x * x.y);
    let before: Vec<Vec3> = problem.reference.iter().map(twisted).collect();
    let whole = Rotation3::new(Vec3::new(0.3, -0.2, 0.5));
    let about = Vec3::new(0.7, 0.5, 0.5);
    let spin = Rotation3::new(Vec3::new(0.004, -0.003, 0.05));
    let after = before.iter().enumerate().map(|(node, x)| {
        let moved = if node < first_of_second {
            *x
        } else {
            spin * (x - about) + about + Vec3::new(0.023, 0.014, -0.004)
        };
        let bent = Vec3::z() * 0.05 * (moved.x * moved.x - moved.y);
        whole * (moved + bent + random.vector3() * 0.004)
    });
    let after = after.collect();
    [before, after].map(|positions| Places {
        positions,
        placement: Placement::at_rest(),
    })
}

/// A body and a rigid surface, both turned, the body also moved on the surface.
pub fn of_rigid(problem: &Problem, bump: f64, seed: u64) -> [Places; 2] {
    let mut random = Random::new(seed);
    let [before, after] = [
        [0.01, -0.02, 0.003, 0.001, -0.002, 0.1],
        [0.2, -0.1, 0.3, 0.4, -0.3, 0.7],
    ]
    .map(|coordinates| {
        let pose = Pose::at_rest().moved_to(&coordinates);
        pose.placement(&Vec3::zeros())
    });
    let lying: Vec<Vec3> = problem.reference.iter().map(|x| bumpy(x, bump)).collect();
    let slide = Vec3::new(0.03, 0.01, -0.005);
    let moved = lying
        .iter()
        .map(|x| after.point(&(x + slide + random.vector3() * 0.004)))
        .collect();
    let start = Places {
        positions: lying.iter().map(|x| before.point(x)).collect(),
        placement: before,
    };
    let now = Places {
        positions: moved,
        placement: after,
    };
    [start, now]
}
