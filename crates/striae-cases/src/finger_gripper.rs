//! `finger-gripper`: fingers with cavities that bend under pressure and hold a ball.
//!
//! A straight finger of the section `A` with the second moment `I` about its centroid, with a cavity
//! of the section `A_c` whose centroid lies `e` from that of the material, bends under the pressure
//! `p` to the curvature
//!
//! ```text
//! kappa = p A_c e (1 - 2 nu)/(E I)
//! ```
//!
//! The pressure on the ends of the cavity gives the moment `p A_c e`, that on its walls the stresses
//! across the finger, whose moment the virial theorem tells without their distribution: with
//! `w = (x y, (y^2 - x^2)/2)`, of which `grad w` is symmetric up to a rotation and equal to `y I`,
//!
//! ```text
//! int (s_xx + s_yy) y dA = boundary int t . w ds = p int div w dA_c = 2 p A_c e .
//! ```

use striae_figure::{Axis, Color, Content, Figure, Panel, Series, Width};
use striae_mesh::Vec3;

use super::study::{Run, Study};
use crate::failure::Failure;

const DECKS: [(&str, &str); 2] = decks!("finger-gripper": "finger", "gripper");
const YOUNGS_MODULUS: f64 = 1.0;
const POISSONS_RATIO: f64 = 0.3;
const PRESSURE: f64 = 1e-5;
/// Edge of the square finger; width and thickness of its cavity, mm.
const EDGE: f64 = 10.0;
const CAVITY: [f64; 2] = [6.0, 5.0];
/// Thickness of its outer wall.
const WALL: f64 = 1.5;
/// Distance of the inner face of the finger from the axis.
const AWAY: f64 = 15.0;
const GRIPS: [&str; 3] = ["grip-1", "grip-2", "grip-3"];
const AXES: [&str; 3] = ["x", "y", "z"];

/// Runs the case.
pub fn run(study: &mut Study) -> Result<(), Failure> {
    let [finger, gripper] = DECKS;
    let finger = ran(study, finger)?;
    study.measured("finger.curvature", curvature(&finger) / closed_form());
    let gripper = ran(study, gripper)?;
    for (step, name) in [(2, "held"), (3, "tilted")] {
        study.measured(format!("{name}.balance"), unbalanced(&gripper, step));
    }
    let grip = GRIPS.map(|pair| pressed(&gripper, 1, pair));
    let mean = grip.iter().sum::<f64>() / 3.0;
    let apart = grip.iter().map(|grip| (grip / mean - 1.0).abs());
    study.measured("grasped.alike", apart.fold(0.0, f64::max));
    let [second, third] = [1, 2].map(|at| pressed(&gripper, 3, GRIPS[at]));
    study.measured("tilted.mirrored", (second / third - 1.0).abs());
    let ways = [1, 2, 3].map(|step| place(&gripper, step));
    let moved = (ways[1] - ways[0]).norm().max((ways[2] - ways[1]).norm());
    study.measured("ball.moved", moved);
    let imbalance = gripper.largest("energy.imbalance") / gripper.largest("energy.external");
    study.measured("energy.imbalance", imbalance);
    study.draw(&figure(&gripper), "forces")
}

fn ran(study: &mut Study, (name, text): (&str, &str)) -> Result<Run, Failure> {
    let deck = study.deck(name, text)?;
    study.run(name, deck)
}

/// Curvature by the formula above.
fn closed_form() -> f64 {
    let [width, thickness] = CAVITY;
    let [whole, hollow] = [EDGE * EDGE, width * thickness];
    // Depths below the outer face.
    let [middle, inside] = [EDGE / 2.0, WALL + thickness / 2.0];
    let solid = (whole * middle - hollow * inside) / (whole - hollow);
    let of = |area: f64, height: f64, depth: f64| {
        area * (height * height / 12.0 + (depth - solid).powi(2))
    };
    let inertia = of(whole, EDGE, middle) - of(hollow, thickness, inside);
    let moment = PRESSURE * hollow * (solid - inside);
    moment * (1.0 - 2.0 * POISSONS_RATIO) / (YOUNGS_MODULUS * inertia)
}

/// Curvature towards the axis around the middle, by three nodes of the inner face.
fn curvature(run: &Run) -> f64 {
    let (problem, state) = (&run.finished.problem, &run.finished.state);
    let moved = |height: f64| {
        let place = Vec3::new(AWAY, 0.0, height);
        let mut nodes = problem.reference.iter().zip(&state.positions);
        let node = nodes.find(|(at, _)| (**at - place).norm() < 1e-6);
        node.map_or(f64::NAN, |(from, to)| to.x - from.x)
    };
    let apart = 10.0_f64;
    let [lower, middle, upper] = [40.0, 50.0, 60.0].map(moved);
    -(lower - 2.0 * middle + upper) / apart.powi(2)
}

/// Sum of the forces of the fingers on the ball and of its weight at the end of a step, over its weight.
fn unbalanced(run: &Run, step: usize) -> f64 {
    let weight = weight(run);
    let pull = match step {
        2 => -Vec3::z(),
        _ => Vec3::x(),
    };
    let forces = GRIPS.map(|pair| {
        let [x, y, z] =
            AXES.map(|axis| run.at_end_of(step, &format!("pair.{pair}.resultant_b.{axis}")));
        Vec3::new(x, y, z)
    });
    (forces.into_iter().sum::<Vec3>() + pull * weight).norm() / weight
}

/// Weight of the ball of the mesh.
fn weight(run: &Run) -> f64 {
    let bodies = &run.finished.problem.model.bodies;
    let Some(ball) = bodies.iter().find(|body| body.name == "ball") else {
        return f64::NAN;
    };
    let volumes = ball.mesh.elements().map(|corners| {
        let corners: Vec<Vec3> = corners
            .iter()
            .map(|node| ball.mesh.positions[node.index()])
            .collect();
        volume(&corners)
    });
    9810.0 * ball.density * volumes.sum::<f64>()
}

/// Volume of a hexahedron by two points along each axis, which is exact.
fn volume(corners: &[Vec3]) -> f64 {
    const SIGNS: [[f64; 3]; 8] = [
        [-1.0, -1.0, -1.0],
        [1.0, -1.0, -1.0],
        [1.0, 1.0, -1.0],
        [-1.0, 1.0, -1.0],
        [-1.0, -1.0, 1.0],
        [1.0, -1.0, 1.0],
        [1.0, 1.0, 1.0],
        [-1.0, 1.0, 1.0],
    ];
    let points = SIGNS.map(|signs| signs.map(|sign| sign / 3f64.sqrt()));
    let jacobian = |at: [f64; 3]| {
        let columns = [0, 1, 2].map(|axis| {
            let terms = SIGNS.iter().zip(corners).map(|(signs, corner)| {
                let others = [0, 1, 2].map(|other| match other == axis {
                    true => signs[other],
                    false => 1.0 + signs[other] * at[other],
                });
                corner * (0.125 * others.iter().product::<f64>())
            });
            terms.sum::<Vec3>()
        });
        columns[0].cross(&columns[1]).dot(&columns[2])
    };
    points.map(jacobian).iter().sum()
}

fn pressed(run: &Run, step: usize, pair: &str) -> f64 {
    run.at_end_of(step, &format!("pair.{pair}.pressure_integral_a"))
}

/// Place of the ball at the end of a step.
fn place(run: &Run, step: usize) -> Vec3 {
    let [x, y, z] = AXES.map(|axis| run.at_end_of(step, &format!("centre.ball.{axis}")));
    Vec3::new(x, y, z)
}

/// Forces of the fingers on the ball, and their sum, over time.
fn figure(run: &Run) -> Figure {
    let times = run.column("time");
    let rows = |values: &[f64]| -> Vec<[f64; 2]> {
        let rows = times.iter().zip(values);
        rows.map(|(time, value)| [*time, 1e3 * value]).collect()
    };
    let sum = |columns: Vec<Vec<f64>>| -> Vec<f64> {
        let row = |at: usize| columns.iter().map(|column| column[at]).sum();
        (0..times.len()).map(row).collect()
    };
    let axes = [Axis::linear("time", ""), Axis::linear("force", "mN")];
    let [time, force] = axes.clone();
    let mut grips = Panel::new(time, force).titled("pressure of each finger");
    for (pair, color) in GRIPS
        .into_iter()
        .zip([Color::Blue, Color::Vermillion, Color::Green])
    {
        let values = run.column(&format!("pair.{pair}.pressure_integral_a"));
        grips = grips.with(Series::new(pair, Content::line(rows(&values))).colored(color));
    }
    let [time, force] = axes;
    let mut sums = Panel::new(time, force).titled("all fingers on the ball");
    for (axis, color) in [("x", Color::Blue), ("z", Color::Vermillion)] {
        let columns = GRIPS.map(|pair| run.column(&format!("pair.{pair}.resultant_b.{axis}")));
        let values = sum(columns.to_vec());
        sums = sums.with(Series::new(axis, Content::line(rows(&values))).colored(color));
    }
    let weight = 1e3 * weight(run);
    let known = Content::dashed(vec![[1.0, 0.0], [2.0, weight]]);
    sums = sums.with(Series::new("weight", known).colored(Color::Black));
    Figure::new(Width::Page, vec![grips, sums])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_skewed_box_has_its_volume() {
        let corners: Vec<Vec3> = [
            [0.0, 0.0, 0.0],
            [2.0, 0.0, 0.0],
            [2.0, 3.0, 0.0],
            [0.0, 3.0, 0.0],
            [1.0, 0.0, 4.0],
            [3.0, 0.0, 4.0],
            [3.0, 3.0, 4.0],
            [1.0, 3.0, 4.0],
        ]
        .map(Vec3::from)
        .to_vec();
        assert!((volume(&corners) - 24.0).abs() < 1e-12);
    }

    #[test]
    fn the_curvature_is_that_of_the_section_by_hand() {
        // A = 70, e = 10/7, I = 727.976.
        assert!((closed_form() / 2.354_865e-7 - 1.0).abs() < 1e-6);
    }
}
