//! `patch-slip`: a block slides as an oblique parallelepiped.
//!
//! With the deformation gradient `F = [[1, 0, g1], [0, 1, g2], [0, 0, b]]`,
//!
//! ```text
//! sigma = G/J (F F^T - 1) + lambda (J - 1) 1 ,   p = -sigma_zz ,   tau = -(G b/J) g ,   J = b
//! ```
//!
//! `p` does not depend on `g`, so the friction law for the slip direction gives
//! `g` at once. Source: Jones & Papadopoulos (2006), figure 11.

use nalgebra::Matrix3;
use striae_contact::{side::Side, unknowns::NodeResult};
use striae_figure::{Axis, Color, Content, Figure, Panel, Series, Width};
use striae_law::friction::{Friction, Textures};
use striae_mesh::Vec3;

use super::{
    measure::{stress_error, surface_nodes},
    study::{Run, Study},
};
use crate::failure::Failure;

const DECKS: [(&str, &str); 6] = decks!(
    "patch-slip": "coulomb", "two-textures", "orthotropic", "orthotropic-associated", "nap", "tabulated"
);
/// Angles of `s` at rest of block and plane, in degrees as seen from above.
const TEXTURES: [[Option<f64>; 2]; 6] = [
    [None, None],
    [Some(20.0), Some(95.0)],
    [Some(95.0), None],
    [Some(95.0), None],
    [None, Some(20.0)],
    [Some(95.0), None],
];
const SHEAR_MODULUS: f64 = 1.0;
const LAMBDA: f64 = 1.5;
const STRETCH: f64 = 0.9;
const HEIGHT: f64 = 0.6;
/// Slip direction in degrees, way of the base and slip of the last increment.
const DIRECTION: f64 = 30.0;
const WAY: f64 = 65.0;
const SLIP: f64 = 8.0;

/// Runs the case.
pub fn run(study: &mut Study) -> Result<(), Failure> {
    let mut least_dissipation = f64::INFINITY;
    let mut panels = Vec::new();
    for ((name, text), textures) in DECKS.into_iter().zip(TEXTURES) {
        let deck = study.deck(name, text)?;
        let sliding = Sliding::of(&deck.model.pairs[0].friction, textures);
        let run = study.run(name, deck)?;
        study.measured(
            format!("{name}.stress"),
            stress_error(&run, &sliding.stress()),
        );
        let displacement = displacement_error(&run, &sliding);
        study.measured(format!("{name}.displacement"), displacement);
        study.measured(format!("{name}.slip"), slip_error(&run));
        let pressure = run.at_end_of(2, "pair.base.pressure_integral_a");
        for axis in ["x", "y"] {
            let force = run.at_end_of(2, &format!("pair.base.resultant_a.{axis}"));
            study.measured(format!("{name}.force.{axis}"), force / pressure);
        }
        let dissipated = run.column("pair.base.dissipated");
        let steps = dissipated.windows(2).map(|pair| pair[1] - pair[0]);
        least_dissipation = steps.fold(least_dissipation, f64::min);
        panels.push(panel(&run, name));
    }
    study.measured("dissipation.least", least_dissipation);
    let mut figure = Figure::new(Width::Page, panels);
    figure.columns = 3;
    study.draw(&figure, "parallelepipeds")
}

fn along(degrees: f64) -> Vec3 {
    let angle = degrees.to_radians();
    Vec3::new(angle.cos(), angle.sin(), 0.0)
}

/// The homogeneous state of one law.
struct Sliding {
    /// `F`.
    gradient: Matrix3<f64>,
}

impl Sliding {
    fn of(friction: &Friction, angles: [Option<f64>; 2]) -> Self {
        // Seen from the block, whose normal points down, a = s x e_z on both sides.
        let [own, opposite] = angles.map(|angle| angle.map(|angle| along(angle).cross(&Vec3::z())));
        let kernel = friction.kernel(&-Vec3::z(), &Textures { own, opposite });
        let cap = friction.cap(pressure(), 0.0);
        let way = (kernel.k_inverse * along(DIRECTION)).normalize();
        let tau = kernel.traction(cap, &(way * (cap * kernel.reach(&way))));
        let mut gradient = Matrix3::identity();
        gradient.set_column(2, &(-tau / SHEAR_MODULUS + Vec3::z() * STRETCH));
        Self { gradient }
    }

    fn stress(&self) -> Matrix3<f64> {
        let strain = self.gradient * self.gradient.transpose() - Matrix3::identity();
        strain * (SHEAR_MODULUS / STRETCH) + Matrix3::identity() * (LAMBDA * (STRETCH - 1.0))
    }
}

/// `-sigma_zz`.
fn pressure() -> f64 {
    SHEAR_MODULUS / STRETCH * (1.0 - STRETCH * STRETCH) + LAMBDA * (1.0 - STRETCH)
}

/// Largest `|x - F X - c|` over the size of the block, `c` its way.
fn displacement_error(run: &Run, sliding: &Sliding) -> f64 {
    let (problem, state) = (&run.finished.problem, &run.finished.state);
    let nodes = problem.reference.iter().zip(&state.positions);
    let errors = nodes
        .map(|(reference, x)| (x - sliding.gradient * reference - along(DIRECTION) * WAY).norm());
    errors.fold(0.0, f64::max)
}

/// Largest difference of the nodal slip of the last increment from the uniform one, relative.
fn slip_error(run: &Run) -> f64 {
    let nodes = surface_nodes(run, Side::A).into_iter();
    let errors = nodes.map(|node| (node.result.slip - along(DIRECTION) * SLIP).norm() / SLIP);
    errors.fold(0.0, f64::max)
}

/// Base and top from above, moved back by the way of the base, with slip and friction.
fn panel(run: &Run, name: &str) -> Panel {
    let (problem, state) = (&run.finished.problem, &run.finished.state);
    let back = along(DIRECTION) * WAY;
    let outline = |height: f64| {
        let corners = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0], [0.0, 0.0]];
        let place = |[x, y]: [f64; 2]| {
            let corner = Vec3::new(x, y, height);
            let distances = problem.reference.iter().map(|node| (node - corner).norm());
            let nearest = distances.enumerate().min_by(|a, b| a.1.total_cmp(&b.1));
            nearest.map_or([f64::NAN; 2], |(node, _)| {
                let x = state.positions[node] - back;
                [x.x, x.y]
            })
        };
        corners.map(place).to_vec()
    };
    let nodes = surface_nodes(run, Side::A);
    let origins: Vec<[f64; 2]> = nodes
        .iter()
        .map(|node| node.position - back)
        .map(|x| [x.x, x.y])
        .collect();
    let arrows = |vector: &dyn Fn(&NodeResult) -> Vec3| {
        let vectors = nodes.iter().map(|node| vector(node.result));
        Content::Arrows {
            origins: origins.clone(),
            vectors: vectors.map(|v| [v.x, v.y]).collect(),
            unit: String::new(),
        }
    };
    let axis = |label: &str| Axis::linear(label, "").within(-0.2, 1.3);
    Panel::plane(axis("x"), axis("y"))
        .titled(name.replace('-', " "))
        .with(Series::new("base", Content::line(outline(0.0))).colored(Color::Black))
        .with(Series::new("top", Content::dashed(outline(HEIGHT))).colored(Color::Grey))
        .with(Series::new("slip", arrows(&|node| node.slip)).colored(Color::Blue))
        .with(Series::new("friction", arrows(&|node| node.tau)).colored(Color::Vermillion))
}

#[cfg(test)]
mod tests {
    use super::*;
    use striae_deck as deck;
    use striae_model::LoadKind;

    #[test]
    fn the_decks_carry_the_closed_form() {
        for ((name, text), textures) in DECKS.into_iter().zip(TEXTURES) {
            let deck = deck::parse(text, name, std::path::Path::new("")).unwrap();
            let sliding = Sliding::of(&deck.model.pairs[0].friction, textures);
            let gradient = sliding.gradient;
            for (step, way) in [(0, 1.0), (1, WAY)] {
                let shift =
                    gradient.column(2) * HEIGHT - Vec3::z() * HEIGHT + along(DIRECTION) * way;
                let told = deck.model.steps[step].displacements[0].numbers();
                let told = Vec3::from(told.map(Option::unwrap));
                assert!((told - shift).norm() < 1e-12, "{name}: {told} {shift}");
            }
            let first_piola =
                STRETCH * sliding.stress() * gradient.try_inverse().unwrap().transpose();
            let normals = [-Vec3::x(), Vec3::x(), -Vec3::y(), Vec3::y()];
            for (load, normal) in deck.model.steps[0].loads.iter().zip(normals) {
                let Some(LoadKind::DeadTraction(told)) = load.kind.numbers() else {
                    panic!("{name}: {load:?}");
                };
                assert!(
                    (told - first_piola * normal).norm() < 1e-12,
                    "{name}: {told}"
                );
            }
        }
    }
}
