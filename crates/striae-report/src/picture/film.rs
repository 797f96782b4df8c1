//! Animations: pictures of all times at which there are fields.
//!
//! Results are read twice, time by time: for the view and the span of colours, which hold what is
//! shown at any time, and for the frames. So no more than one time is in memory.

use std::path::Path;

use striae_figure::{Animation, Dots, Moving};

use super::{
    Picture,
    canvas::Canvas,
    carrier::{both, limits},
    layer::{Layers, Subject},
    legend,
    view::View,
};
use crate::{ReportError, part::parts, results::Results};

/// Writes an animation of a results folder, whole or not at all, with a frame for each time at
/// which there are fields; `seconds` is the time of a frame. The extension of the file, `gif` or
/// `png`, states the format.
///
/// # Errors
/// When there is nothing to show, a field is not known, the extension states no format, or a file
/// cannot be read or written.
pub fn animate(
    folder: &Path,
    picture: &Picture,
    seconds: f64,
    file: &Path,
) -> Result<(), ReportError> {
    let moving = Moving::of(file).ok_or_else(|| ReportError::Animation(file.to_owned()))?;
    let film = Film::of(folder, picture)?;
    let animation = Animation {
        frames: film.times.len(),
        seconds,
    };
    animation.write(file, moving, |frame| film.frame(frame))
}

/// Common part of all frames.
struct Film<'a> {
    results: Results,
    picture: &'a Picture,
    times: Vec<f64>,
    subject: Subject,
    view: View,
    limits: [f64; 2],
}

impl<'a> Film<'a> {
    fn of(folder: &Path, picture: &'a Picture) -> Result<Self, ReportError> {
        let results = Results::read(folder)?;
        let times = results.times();
        let Some(end) = times.last() else {
            return Err(ReportError::Nothing(folder.to_owned()));
        };
        picture.check_numbers(&results)?;
        let last = parts(&results, &[*end])?;
        picture.check_names(&last)?;
        let subject = Layers::of(&last, picture)?.subject().clone();
        drop(last);
        let mut extremes = None;
        let mut outermost = Vec::new();
        for time in &times {
            let parts = parts(&results, &[*time])?;
            let layers = Layers::showing(&subject, &parts, picture)?;
            extremes = [extremes, layers.extremes()]
                .into_iter()
                .flatten()
                .reduce(both);
            outermost.extend(View::outermost(picture.direction, &layers.corners())?);
        }
        let view = View::along(picture.direction, &outermost, picture.width)?;
        Ok(Self {
            picture,
            times,
            subject,
            view,
            limits: picture.range.unwrap_or_else(|| limits(extremes)),
            results,
        })
    }

    /// The picture of a time.
    fn frame(&self, frame: usize) -> Result<Dots, ReportError> {
        let time = self.times[frame];
        let parts = parts(&self.results, &[time])?;
        let layers = Layers::showing(&self.subject, &parts, self.picture)?;
        let layers = layers.spanning(self.limits);
        let mut canvas = Canvas::new(self.view.size());
        layers.draw(&self.view, &mut canvas);
        Ok(legend(canvas.dots(), &layers, time))
    }
}
