//! Pictures of results and of meshes, without a browser.
//!
//! ```text
//! results folder -> parts at one time -> layers -> canvas with depths -> PNG
//!                   [`crate::part`]      [`layer`]  [`canvas`], [`view`]
//! ```
//!
//! A field of contact is drawn on the smaller side of each pair, and bodies and rigid
//! surfaces are seen through. Any other field is drawn on the bodies. The projection is
//! orthographic. Numbers under the colour bar are the extremes of what is drawn, the inside
//! of bodies included, as in the [report](crate). An animation has one view and one span
//! of colours for all its frames. [`Surfaces`] draws what has no results:
//! facets in the colours of their names.

mod canvas;
mod carrier;
mod film;
mod layer;
mod surfaces;
mod view;

use std::path::Path;

use striae_figure::Dots;

use crate::{
    ReportError, invariants,
    part::{Part, parts},
    results::Results,
};
pub use film::animate;
pub use surfaces::Surfaces;

use canvas::Canvas;
use layer::Layers;
use view::View;

/// Width of a picture in dots, by default.
pub const WIDTH: usize = 900;

/// Direction of sight towards a corner, by default.
const CORNER: [f64; 3] = [0.6, 1.0, -0.65];

/// Directions of sight by their names.
pub const VIEWS: [(&str, [f64; 3]); 7] = [
    ("corner", CORNER),
    ("front", [0.0, 1.0, 0.0]),
    ("back", [0.0, -1.0, 0.0]),
    ("left", [1.0, 0.0, 0.0]),
    ("right", [-1.0, 0.0, 0.0]),
    ("top", [0.0, 0.0, -1.0]),
    ("below", [0.0, 0.0, 1.0]),
];

/// Largest magnification of displacements.
const LARGEST: f64 = 1e12;

/// Size of words over the width of a picture.
const WORDS: f64 = 0.016;

/// Content of a picture.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    /// The field; by default the contact pressure, or else the stress of the bodies.
    pub field: Option<String>,
    /// Its component; by default its size, or von Mises' equivalent.
    pub component: Option<String>,
    /// The time; by default the last one, otherwise the nearest at which there are fields.
    pub time: Option<f64>,
    /// From the place of the eye to what is seen; the third axis points upwards.
    pub direction: [f64; 3],
    /// Least and largest value of the colours; by default those of what is shown.
    pub range: Option<[f64; 2]>,
    /// Magnification of displacements.
    pub magnification: f64,
    /// Bodies and surfaces that are left out.
    pub hidden: Vec<String>,
    /// Columns of dots.
    pub width: usize,
}

impl Default for Picture {
    fn default() -> Self {
        Self {
            field: None,
            component: None,
            time: None,
            direction: CORNER,
            range: None,
            magnification: 1.0,
            hidden: Vec::new(),
            width: WIDTH,
        }
    }
}

impl Picture {
    /// Refuses a time that is none, and a magnification that leads out of all numbers.
    fn check_numbers(&self, results: &Results) -> Result<(), ReportError> {
        if let Some(time) = self.time.filter(|time| !time.is_finite()) {
            let times = results.times();
            let end = |time: Option<&f64>| time.copied().unwrap_or(0.0);
            return Err(ReportError::Time(
                time,
                [end(times.first()), end(times.last())],
            ));
        }
        match self.magnification.abs() <= LARGEST {
            true => Ok(()),
            false => Err(ReportError::Magnification(self.magnification, LARGEST)),
        }
    }

    /// Refuses names to be left out that no part has.
    fn check_names(&self, parts: &[Part]) -> Result<(), ReportError> {
        let is_known = |name: &&String| parts.iter().any(|part| part.name == **name);
        let Some(name) = self.hidden.iter().find(|name| !is_known(name)) else {
            return Ok(());
        };
        let known: Vec<&str> = parts.iter().map(|part| part.name.as_str()).collect();
        Err(ReportError::Name {
            name: name.clone(),
            known: known.join(", "),
        })
    }
}

/// Writes a picture of a results folder, whole or not at all. The file is a PNG.
///
/// # Errors
/// When there is nothing to show, a field or a name is not known, the extension is not `png`, or
/// a file cannot be read or written.
pub fn write(folder: &Path, picture: &Picture, file: &Path) -> Result<(), ReportError> {
    let ending = file.extension().and_then(|ending| ending.to_str());
    if !ending.is_some_and(|ending| ending.eq_ignore_ascii_case("png")) {
        return Err(ReportError::Still(file.to_owned()));
    }
    Ok(render(folder, picture)?.write_png(file)?)
}

/// A picture of a results folder.
///
/// # Errors
/// When there is nothing to show, a field is not known, or a file cannot be read.
pub fn render(folder: &Path, picture: &Picture) -> Result<Dots, ReportError> {
    let results = Results::read(folder)?;
    let nothing = || ReportError::Nothing(folder.to_owned());
    picture.check_numbers(&results)?;
    let wanted = picture.time.unwrap_or(f64::INFINITY);
    let distance = |time: &f64| match wanted.is_finite() {
        true => (time - wanted).abs(),
        false => -time,
    };
    let times = results.times();
    let nearest = times.iter().copied();
    let time = nearest.min_by(|a, b| distance(a).total_cmp(&distance(b)));
    let time = time.ok_or_else(nothing)?;
    let parts = parts(&results, &[time])?;
    picture.check_names(&parts)?;
    let layers = Layers::of(&parts, picture)?;
    let view = View::along(picture.direction, &layers.corners(), picture.width)?;
    let mut canvas = Canvas::new(view.size());
    layers.draw(&view, &mut canvas);
    Ok(legend(canvas.dots(), &layers, time))
}

/// The picture with the colour bar, the name of what is shown, and the time.
fn legend(mut dots: Dots, layers: &Layers, time: f64) -> Dots {
    let [width, height] = dots.size();
    let text = (WORDS * width as f64).max(9.0);
    let bar = [(0.022 * width as f64) as usize, height * 6 / 10];
    let corner = [width - view::bar_room(width), height * 2 / 10];
    dots.write_bar(corner, bar, layers.limits(), text);
    let left = text;
    let plain = ["value", "magnitude"].contains(&layers.component());
    let words = match plain {
        true => layers.field().replace('_', " "),
        false => format!(
            "{}, {}",
            layers.field().replace('_', " "),
            layers.component()
        ),
    };
    dots.write_words(&words, [left, 1.8 * text], text);
    let time = format!("time {}", (time * 1e6).round() / 1e6);
    dots.write_words(&time, [left, height as f64 - text], text);
    dots
}

/// Place of a component among the views of a field.
fn component(field: &str, components: usize, name: Option<&str>) -> Result<usize, ReportError> {
    let views = invariants::views(components);
    let Some(name) = name else {
        return Ok(0);
    };
    let place = views.iter().position(|view| *view == name);
    place.ok_or_else(|| ReportError::Component {
        field: field.to_owned(),
        name: name.to_owned(),
        known: views.join(", "),
    })
}
