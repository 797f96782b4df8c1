//! The numbers behind a figure, as comma-separated text.
//!
//! One row a point: number and title of its panel, name of its series, number
//! of the point (or polygon) in it, `x` and `y` (angle and radius in a polar
//! panel), the components of an arrow or the value of a polygon.

use super::description::{Content, Figure, Panel, Series};
use striae_files::quoted;

const HEADER: &str = "panel,title,series,item,x,y,arrow_x,arrow_y,value\n";

/// All points of a figure.
pub(super) fn text(figure: &Figure) -> String {
    let panels = figure.panels.iter().enumerate();
    let series = panels.flat_map(|(number, panel)| {
        panel
            .series
            .iter()
            .flat_map(move |series| rows(number + 1, panel, series))
    });
    std::iter::once(HEADER.to_owned()).chain(series).collect()
}

fn rows(number: usize, panel: &Panel, series: &Series) -> Vec<String> {
    let start = format!("{number},{},{}", quoted(&panel.title), quoted(&series.name));
    match &series.content {
        Content::Curve { points, .. } | Content::PowerLaw { points, .. } => {
            let points = points.iter().enumerate();
            points
                .map(|(item, [x, y])| format!("{start},{item},{x:?},{y:?},,,\n"))
                .collect()
        }
        Content::Arrows {
            origins, vectors, ..
        } => {
            let arrows = origins.iter().zip(vectors).enumerate();
            arrows
                .map(|(item, ([x, y], [u, v]))| {
                    format!("{start},{item},{x:?},{y:?},{u:?},{v:?},\n")
                })
                .collect()
        }
        Content::Facets {
            polygons, values, ..
        } => {
            let facets = polygons.iter().zip(values).enumerate();
            facets
                .flat_map(|(item, (corners, value))| corners.iter().map(move |c| (item, c, value)))
                .map(|(item, [x, y], value)| format!("{start},{item},{x:?},{y:?},,,{value:?}\n"))
                .collect()
        }
    }
}
