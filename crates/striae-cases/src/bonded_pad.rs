//! `bonded-pad`: rubber squeezed between bonded plates, against its shape factor.
//!
//! A square pad of the edge `a` and the height `t` has the shape factor `S = a/(4 t)`, loaded
//! over free area. Rubber that hardly changes its volume is pressed out with parabolas of
//! displacements over the height, and the pressure obeys
//!
//! ```text
//! p,xx + p,yy - 12 G/(K t^2) p = -12 G e/t^2 ,   p = 0 at the edges,
//! ```
//!
//! with the strain `e`. Its mean over the square is the series below, and `E_c = E + mean(p)/e`.
//! Without change of volume that is `E (1 + 2.25 S^2)`, where Gent & Lindley take
//! `E (1 + 2 S^2)` for discs and squares alike.

use std::f64::consts::PI;
use striae_figure::{Axis, Color, Content, Figure, Marker, Panel, Series, Width};

use super::{
    comparison::limit,
    study::{Extent, Run, Study},
};
use crate::failure::Failure;

const DECKS: [(&str, &str); 1] = decks!("bonded-pad": "deck");
const EDGE: f64 = 10.0;
const POISSONS_RATIO: f64 = 0.499;
const STRAIN: f64 = 1e-3;
/// Shape factors and layers of the half height, with as many elements along half an edge
/// as make them cubes or twice as wide as high.
const SHAPES: [(f64, usize); 4] = [(0.5, 4), (1.0, 4), (2.0, 3), (4.0, 3)];
/// Divisions of an eighth of the pad of the deck; a quick look takes the first two.
const MESHES: [[usize; 3]; 4] = [[2, 2, 1], [4, 4, 2], [8, 8, 4], [16, 16, 8]];
const KINDS: [(&str, &str); 2] = [
    ("hexahedra", r#"cells = "hexahedra""#),
    ("tetrahedra", r#"cells = "composite-tetrahedra""#),
];
/// Quantities that the quick run omits.
const FULL_ONLY: [&str; 9] = [
    "limit",
    "hexahedra.4x4x2.error",
    "hexahedra.8x8x4.error",
    "hexahedra.16x16x8.error",
    "hexahedra.32x32x16.error",
    "tetrahedra.4x4x2.error",
    "tetrahedra.8x8x4.error",
    "tetrahedra.16x16x8.error",
    "shape.4.ratio",
];

/// Runs the case.
pub fn run(study: &mut Study) -> Result<(), Failure> {
    let meshes = match study.extent {
        Extent::Full => &MESHES[..],
        Extent::Quick => &MESHES[..2],
    };
    let mut families = Vec::new();
    for (kind, cells) in KINDS {
        let mut family = Vec::new();
        for mesh in meshes {
            family.push([1.0 / mesh[2] as f64, modulus(study, 1.0, *mesh, cells)?]);
        }
        families.push((kind, family));
    }
    let [hexahedra, tetrahedra] = [0, 1].map(|of| families[of].1[1][1]);
    study.measured("hexahedra.8x8x4", hexahedra);
    study.measured("tetrahedra.8x8x4", tetrahedra);
    if study.extent == Extent::Full {
        judge(study, &families);
    } else {
        study.left_out.extend(FULL_ONLY);
    }
    let mut points = Vec::new();
    for (shape, layers) in SHAPES {
        if study.extent == Extent::Quick && shape > 2.0 {
            continue;
        }
        let [_, (_, cells)] = KINDS;
        let half = (shape * layers as f64).ceil() as usize * 2 / 2;
        let found = modulus(study, shape, [half.max(3), half.max(3), layers], cells)?;
        study.measured(format!("shape.{shape}.ratio"), found / closed(shape));
        points.push([shape, found]);
    }
    study.draw(&figure(&points, &families), "stiffness")
}

/// Errors beside the limit of the tetrahedra.
fn judge(study: &mut Study, families: &[(&str, Vec<[f64; 2]>)]) {
    let converged = limit(&families[1].1);
    study.measured("limit", converged);
    for (kind, family) in families {
        for ([x, y, z], [_, found]) in MESHES.into_iter().zip(family) {
            let (x, y, z) = (2 * x, 2 * y, 2 * z);
            let name = format!("{kind}.{x}x{y}x{z}.error");
            study.measured(name, (found / converged - 1.0).abs());
        }
    }
}

/// Apparent modulus over Young's.
fn modulus(study: &mut Study, shape: f64, mesh: [usize; 3], cells: &str) -> Result<f64, Failure> {
    let [(of, text)] = DECKS;
    let half = EDGE / (8.0 * shape);
    let [x, y, z] = mesh;
    let size = format!("size = [5, 5, {half}]");
    let divisions = format!("divisions = [{x}, {y}, {z}]");
    let squeeze = format!("z = {}", -STRAIN * half);
    let passages = [
        ["size = [5, 5, 1.25]", size.as_str()],
        ["divisions = [4, 4, 2]", &divisions],
        [r#"cells = "hexahedra""#, cells],
        ["z = -0.00125", &squeeze],
    ];
    let deck = study.variant(of, text, &passages)?;
    let kind = cells.split('"').nth(1).unwrap_or_default();
    let run = study.run(&format!("{kind}-{shape}-{x}-{z}"), deck)?;
    Ok(-force(&run) / (0.25 * EDGE * EDGE * STRAIN))
}

fn force(run: &Run) -> f64 {
    run.at_end_of(1, "reaction.pad.zmax.z")
}

/// The apparent modulus by the equation of the pressure.
fn closed(shape: f64) -> f64 {
    let (shear, bulk) = (
        0.5 / (1.0 + POISSONS_RATIO),
        1.0 / (3.0 * (1.0 - 2.0 * POISSONS_RATIO)),
    );
    let height = EDGE / (4.0 * shape);
    let source = 12.0 * shear / (height * height);
    let odd = || (0..200).map(|k| f64::from(2 * k + 1));
    let term = |m: f64, n: f64| {
        let waves = (PI / EDGE).powi(2) * (m * m + n * n);
        64.0 / (PI.powi(4) * (m * n).powi(2)) * source / (waves + source / bulk)
    };
    let mean: f64 = odd().flat_map(|m| odd().map(move |n| term(m, n))).sum();
    1.0 + mean
}

fn figure(points: &[[f64; 2]], families: &[(&str, Vec<[f64; 2]>)]) -> Figure {
    let shapes = || (0..=100).map(|i| 0.4 * 12.5_f64.powf(f64::from(i) / 100.0));
    let curve = |of: &dyn Fn(f64) -> f64| Content::line(shapes().map(|s| [s, of(s)]).collect());
    let of_shape = Panel::new(
        Axis::logarithmic("shape factor", ""),
        Axis::logarithmic("apparent modulus / E", ""),
    )
    .with(Series::new("pressure equation", curve(&closed)).colored(Color::Black))
    .with(
        Series::new(
            "Gent & Lindley, disc",
            Content::dashed(shapes().map(|s| [s, 1.0 + 2.0 * s * s]).collect()),
        )
        .colored(Color::Grey),
    )
    .with(Series::new(
        "computed",
        Content::markers(points.to_vec(), Marker::Circle),
    ));
    let of_mesh = Panel::new(
        Axis::logarithmic("layers of the half height", ""),
        Axis::linear("apparent modulus / E, S = 1", ""),
    );
    let markers = [Marker::Square, Marker::Triangle];
    let of_mesh = families
        .iter()
        .zip(markers)
        .fold(of_mesh, |panel, ((kind, family), marker)| {
            let points = family.iter().map(|[size, found]| [1.0 / size, *found]);
            panel.with(Series::new(
                *kind,
                Content::markers(points.collect(), marker),
            ))
        });
    Figure::new(Width::Page, vec![of_shape, of_mesh])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_closed_form_is_that_of_an_incompressible_square_for_low_pressure() {
        // The change of volume takes E_c^2 / K of it, in the first order.
        for shape in [0.5, 1.0] {
            let square = 2.2492 * shape * shape;
            let lost = (closed(shape) - 1.0 - square) / square;
            assert!((-0.04..0.01).contains(&lost), "{shape}: {lost}");
        }
    }
}
