//! `cooks-membrane`: a skewed cantilever, compressible and nearly incompressible.

use striae_figure::{Axis, Content, Figure, Line, Marker, Panel, Series, Width};
use striae_mesh::Vec3;

use super::{
    comparison::rate,
    study::{Extent, Run, Study},
};
use crate::failure::Failure;

const DECKS: [(&str, &str); 3] = decks!("cooks-membrane": "plane-stress", "plane-strain", "rubber");
/// Places on the free edge at which displacements are compared, and their published displacements.
const PUBLISHED: [(f64, f64); 3] = [(30.0, 23.96), (38.0, 32.27), (38.0, 7.77)];
/// The decks have a thousandth of the published loads.
const LOAD: f64 = 1e-3;
/// Divisions along each edge; a quick look takes the first two.
const HEXAHEDRA: [usize; 4] = [8, 16, 32, 64];
const TETRAHEDRA: [usize; 3] = [4, 8, 16];
const CELLS: &str = r#"cells = "hexahedra""#;
const OTHERS: &str = r#"cells = "composite-tetrahedra""#;

/// Displacements over the element size by kind of the cells.
type Family = (&'static str, Vec<[f64; 2]>);

/// Runs the case.
pub fn run(study: &mut Study) -> Result<(), Failure> {
    let mut panels = Vec::new();
    for ((name, text), (place, published)) in DECKS.into_iter().zip(PUBLISHED) {
        let mut families = Vec::new();
        for (kind, cells, divisions) in [
            ("hexahedra", CELLS, &HEXAHEDRA[..]),
            ("tetrahedra", OTHERS, &TETRAHEDRA[..]),
        ] {
            let count = match study.extent {
                Extent::Full => divisions.len(),
                Extent::Quick => 2,
            };
            let mut family = Vec::new();
            for n in &divisions[..count] {
                let mesh = format!("divisions = [{n}, 1, {n}]");
                let passages = [["divisions = [8, 1, 8]", &mesh], [CELLS, cells]];
                let deck = study.variant(name, text, &passages)?;
                let run = study.run(&format!("{name}-{kind}-{n}"), deck)?;
                family.push([1.0 / *n as f64, rise(&run, place) / LOAD]);
            }
            judge(study, &format!("{name}.{kind}"), published, &family);
            families.push((kind, family));
        }
        panels.push(panel(name, published, &families));
    }
    if study.extent == Extent::Quick {
        study.left_out.extend(FULL_ONLY);
    }
    let columns = 3;
    let figure = Figure {
        columns,
        ..Figure::new(Width::Page, panels)
    };
    study.draw(&figure, "convergence")
}

/// Quantities that the quick run omits.
const FULL_ONLY: [&str; 6] = [
    "plane-stress.hexahedra.finest",
    "plane-stress.tetrahedra.finest",
    "plane-strain.hexahedra.finest",
    "plane-strain.tetrahedra.finest",
    "rubber.hexahedra.finest",
    "rubber.tetrahedra.finest",
];

/// Notes the displacement on the second mesh, which a quick look ends with, and on the
/// finest, and how what is missing falls.
fn judge(study: &mut Study, name: &str, published: f64, family: &[[f64; 2]]) {
    study.measured(format!("{name}.second"), family[1][1]);
    let missing: Vec<[f64; 2]> = family[..2]
        .iter()
        .map(|[size, found]| [*size, published - found])
        .collect();
    study.measured(format!("{name}.rate"), rate(&missing));
    if study.extent == Extent::Full {
        study.measured(format!("{name}.finest"), family[family.len() - 1][1]);
    }
}

/// Rise of the nodes of the free edge at a height.
fn rise(run: &Run, height: f64) -> f64 {
    let (problem, state) = (&run.finished.problem, &run.finished.state);
    let nodes = problem.reference.iter().zip(&state.positions);
    let at = |x: &Vec3| (x.x - 48.0).abs() < 1e-9 && (x.z - height).abs() < 1e-9;
    let rises: Vec<f64> = nodes
        .filter(|(x, _)| at(x))
        .map(|(x, now)| now.z - x.z)
        .collect();
    rises.iter().sum::<f64>() / rises.len() as f64
}

fn panel(name: &str, published: f64, families: &[Family]) -> Panel {
    let x = Axis::logarithmic("divisions", "");
    let panel = Panel::new(x, Axis::linear("displacement", "mm")).titled(name.replace('-', " "));
    let known = vec![[4.0, published], [64.0, published]];
    let panel = panel.with(Series::new("published", Content::dashed(known)));
    let markers = [Marker::Square, Marker::Triangle];
    families
        .iter()
        .zip(markers)
        .fold(panel, |panel, ((kind, points), marker)| {
            let points = points.iter().map(|[size, found]| [1.0 / size, *found]);
            let content = Content::Curve {
                points: points.collect(),
                line: Line::Solid,
                marker,
            };
            panel.with(Series::new(*kind, content))
        })
}
