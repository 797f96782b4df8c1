//! Bodies in contact.

use striae_contact::pair::Enforcement;
use striae_law::bulk::{Hyperelastic, Isochoric, Material, Volumetric};
use striae_law::friction::{
    Evolution, FactorLane, FactorLaw, FactorPoint, FactorRange, Friction, Healing, HealingCourse,
    OwnFactor, RateAndState, StateDependence,
};
use striae_mesh::{CellKind, Vec3, generate::Block};
use striae_model::{Axes, Formulation, LoadExtent, LoadKind, Model};
use striae_surface::texture::{Field, Lines, Paint};

use crate::{
    scene::{Places, block, body, coulomb, increments, model, pieces, rubber, step},
    told::assert_same,
};

/// A smaller block pressed on a larger one and slid over it.
fn two_blocks(mu: f64) -> Model {
    two_blocks_of(CellKind::Hexahedron, coulomb(mu))
}

/// Two blocks, the smaller one of other elements.
fn two_blocks_of(cells: CellKind, friction: Friction) -> Model {
    let lower = block([0.0; 3], [1.0, 1.0, 0.5], [4, 4, 2]).mesh().unwrap();
    let upper = Block {
        cells,
        ..block([0.2, 0.2, 0.5], [0.6, 0.6, 0.5], [3, 3, 2])
    };
    let mut model = model(vec![
        body("lower", lower, rubber(10.0, 0.3)),
        body("upper", upper.mesh().unwrap(), rubber(1.0, 0.3)),
    ]);
    model.touch(("lower", "zmax"), ("upper", "zmin"), friction);
    let mut press = step();
    press.displacements = vec![
        model.hold("lower", "zmin", [Some(0.0); 3]),
        model.hold("upper", "zmax", [Some(0.0), Some(0.0), Some(-0.02)]),
    ];
    let mut slide = step();
    slide.displacements = vec![model.hold("upper", "zmax", [Some(0.1), Some(0.03), None])];
    slide.increments = increments(0.25, 0.01);
    model.steps = vec![press, slide];
    model
}

#[test]
fn blocks_that_stick_and_slide() {
    let told = assert_same(&two_blocks(0.3));
    assert_eq!(told.increments.len(), 5);
}

#[test]
fn blocks_that_wear() {
    let mut model = two_blocks(0.3);
    model.pairs[0].wear = [2e-2, 1e-2];
    let told = assert_same(&model);
    let worn = told.numbers.iter().find(|(name, _)| name == "worn");
    assert!(worn.unwrap().1.iter().all(|volume| *volume > 0.0));
}

#[test]
fn blocks_with_states_of_friction() {
    let rate_and_state = StateDependence::rate_and_state(RateAndState {
        evolution: Evolution::Ageing,
        direct_effect: 0.02,
        evolution_effect: 0.015,
        slip_rate: 0.1,
        slip_distance: 0.03,
        state: 0.5,
    });
    let healing = StateDependence::healing(Healing {
        course: HealingCourse::Exponential {
            kinetic_over_static: 0.8,
        },
        slip_distance: 0.05,
        healing_time: 1.0,
        state: 1.0,
    });
    for state in [rate_and_state, healing] {
        let friction = coulomb(0.3).with_state(state.unwrap());
        let told = assert_same(&two_blocks_of(CellKind::Hexahedron, friction));
        assert!(told.increments.len() >= 5);
    }
}

/// Friction that grows with the time in contact and with the place.
#[derive(Debug)]
struct Aged;

impl FactorLaw for Aged {
    fn name(&self) -> &str {
        "aged"
    }

    fn range(&self) -> FactorRange {
        FactorRange::default()
    }

    fn initial_state(&self) -> Vec<f64> {
        vec![0.0]
    }

    fn state_after(&self, at: &FactorPoint, before: &[f64]) -> Vec<FactorLane> {
        vec![FactorLane::from(before[0] + at.elapsed)]
    }

    fn factor(&self, at: &FactorPoint, state: &[FactorLane]) -> FactorLane {
        (state[0] * 0.1 + 1.0) * (1.0 + 0.2 * at.position.x * at.position.x)
    }
}

#[test]
fn blocks_with_a_factor_of_ones_own() {
    let factor = OwnFactor::of(Aged).unwrap();
    let friction = coulomb(0.3).with_factor(factor).unwrap();
    let told = assert_same(&two_blocks_of(CellKind::Hexahedron, friction));
    assert_eq!(told.increments.len(), 5);
}

#[test]
fn a_body_that_touches_itself() {
    let lower = block([0.0; 3], [1.0, 1.0, 0.5], [4, 4, 2]).mesh().unwrap();
    let upper = block([0.2, 0.2, 0.5], [0.6, 0.6, 0.5], [3, 3, 2])
        .mesh()
        .unwrap();
    let mut mesh = pieces(&[lower, upper]);
    let skin = mesh.boundary_faces();
    mesh.facet_sets.insert("skin", skin);
    let mut model = model(vec![body("both", mesh, rubber(1.0, 0.3))]);
    model.touch_itself("both", &["skin"], coulomb(0.3));
    let mut press = step();
    press.displacements = vec![
        model.hold("both", "0.zmin", [Some(0.0); 3]),
        model.hold("both", "1.zmax", [Some(0.0), Some(0.0), Some(-0.02)]),
    ];
    let mut slide = step();
    slide.displacements = vec![model.hold("both", "1.zmax", [Some(0.1), Some(0.03), None])];
    slide.increments = increments(0.25, 0.01);
    model.steps = vec![press, slide];
    assert_same(&model);
}

#[test]
fn blocks_without_friction() {
    let mut model = two_blocks(0.0);
    model.steps.truncate(1);
    assert_same(&model);
}

#[test]
fn fields_that_are_collocated() {
    let mut model = two_blocks(0.3);
    model.pairs[0].enforcement = Enforcement::Collocated;
    assert_same(&model);
}

#[test]
fn textures_on_both_sides_and_elements_of_other_kinds() {
    let mut model = two_blocks_of(
        CellKind::Tetrahedron,
        Friction::two_textures(0.3, 0.2, 0.1, 0.1).unwrap(),
    );
    let field = |x: f64, y: f64| {
        Some(Paint::Field(Field {
            lines: Lines::Uniform(Vec3::new(x, y, 0.0)),
            turn: 0.0,
        }))
    };
    model.pairs[0].textures = [field(1.0, 0.2), field(0.3, -1.0)];
    assert_same(&model);
}

#[test]
fn blocks_that_are_prescribed_in_axes_of_their_own() {
    for mu in [0.3, 5.0] {
        let mut model = two_blocks(mu);
        let skew = Axes::Skew {
            x: Vec3::new(1.0, 0.2, 0.1),
            y: Vec3::new(0.0, 1.0, -0.1),
        };
        for step in &mut model.steps {
            step.displacements.iter_mut().for_each(|of| of.axes = skew);
        }
        let mut side = model.hold("lower", "ymin", [Some(0.0), None, None]);
        side.axes = Axes::Normal(Vec3::new(0.1, 1.0, 0.2));
        let low = model.steps[0].displacements[0].nodes.clone();
        side.nodes.retain(|node| !low.contains(node));
        model.steps[0].displacements.push(side);
        assert_same(&model);
    }
}

#[test]
fn mean_dilatation_under_a_load_beside_contact() {
    let soft = Isochoric::NeoHookean { shear: 1.0 };
    let soft = Hyperelastic::new(soft, 200.0, Volumetric::Logarithmic).unwrap();
    let mut model = two_blocks(0.5);
    model.bodies[1].material = Material::hyperelastic(soft);
    model.bodies[1].formulation = Formulation::MeanDilatation;
    let pressure = LoadKind::Pressure(0.02);
    let exposed = model.load("lower", "zmax", pressure, LoadExtent::Exposed);
    let side = model.load("upper", "xmin", pressure, LoadExtent::Whole);
    model.steps.truncate(1);
    model.steps[0].loads = vec![exposed, side];
    assert_same(&model);
}

#[test]
fn a_block_that_stabilisation_carries_to_another() {
    let lower = block([-0.2, -0.2, 0.0], [1.4, 1.4, 0.5], [4, 4, 2]);
    let upper = block([0.0, 0.0, 0.55], [1.0, 1.0, 0.6], [3, 3, 2]);
    let mut model = model(vec![
        body("lower", lower.mesh().unwrap(), rubber(1.0, 0.3)),
        body("upper", upper.mesh().unwrap(), rubber(2.0, 0.2)),
    ]);
    model.touch(("lower", "zmax"), ("upper", "zmin"), coulomb(0.4));
    model.pairs[0].stabilised = true;
    let mut press = step();
    press.increments = increments(0.25, 1e-3);
    press.displacements = vec![model.hold("lower", "zmin", [Some(0.0); 3])];
    let pressure = LoadKind::Pressure(0.01);
    press.loads = vec![model.load("upper", "zmax", pressure, LoadExtent::Whole)];
    model.steps = vec![press];
    assert_same(&model);
}
