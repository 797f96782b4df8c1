//! Pictures of meshes: named surfaces in colours of their own, with a list of the names.

use std::collections::BTreeSet;

use striae_figure::Dots;

use crate::{
    ReportError,
    picture::{
        WIDTH, WORDS,
        canvas::{Canvas, Color},
        layer::{GREY, darkness},
        view::{View, bar_room, cross, unit},
    },
};

/// Colours of names, which begin again when they are used up: those of Okabe and Ito, which
/// colour-blind people can distinguish (<https://jfly.uni-koeln.de/color/>), then lighter ones.
const COLORS: [Color; 12] = [
    [0.00, 0.45, 0.70],
    [0.90, 0.62, 0.00],
    [0.00, 0.62, 0.45],
    [0.80, 0.47, 0.65],
    [0.84, 0.37, 0.00],
    [0.34, 0.71, 0.91],
    [0.94, 0.89, 0.26],
    [0.45, 0.45, 0.80],
    [0.60, 0.80, 0.40],
    [0.70, 0.50, 0.35],
    [0.95, 0.65, 0.65],
    [0.45, 0.75, 0.75],
];

/// Most names that are listed.
const LISTED: usize = 24;

/// Surfaces with names.
#[derive(Clone, Debug, PartialEq)]
pub struct Surfaces {
    /// Places of the nodes.
    pub places: Vec<[f64; 3]>,
    /// Corners of the faces as places in `places`; a triangle repeats its last one.
    pub faces: Vec<[usize; 4]>,
    /// For every face the place of its name in `names`, if it has one.
    pub named: Vec<Option<usize>>,
    /// The names.
    pub names: Vec<String>,
    /// From the place of the eye to what is seen; the third axis points upwards.
    pub direction: [f64; 3],
    /// Columns of dots.
    pub width: usize,
}

impl Default for Surfaces {
    fn default() -> Self {
        Self {
            places: Vec::new(),
            faces: Vec::new(),
            named: Vec::new(),
            names: Vec::new(),
            direction: super::Picture::default().direction,
            width: WIDTH,
        }
    }
}

impl Surfaces {
    /// The picture.
    ///
    /// # Errors
    /// When the direction has no length.
    pub fn render(&self) -> Result<Dots, ReportError> {
        let view = View::along(self.direction, &self.places, self.width)?;
        let mut canvas = Canvas::new(view.size());
        let seen: Vec<[f64; 3]> = self.places.iter().map(|x| view.seen(*x)).collect();
        for (face, name) in self.faces.iter().zip(&self.named) {
            let color = name.map_or(GREY, |name| COLORS[name % COLORS.len()]);
            let [a, b, c, d] = *face;
            for triangle in [[a, b, c], [a, c, d]] {
                let light = self.brightness(triangle, &view);
                let corners = triangle.map(|corner| seen[corner]);
                canvas.fill(corners, |_| color.map(|channel| channel * light));
            }
        }
        let ends = self.edges().into_iter();
        let ends: Vec<_> = ends.map(|edge| edge.map(|end| seen[end])).collect();
        let darkness = darkness(&ends);
        if darkness > 0.02 {
            ends.into_iter()
                .for_each(|ends| canvas.line(ends, darkness));
        }
        Ok(self.legend(canvas.dots()))
    }

    /// Edges of the faces, each once.
    fn edges(&self) -> BTreeSet<[usize; 2]> {
        let sides = |face: &[usize; 4]| {
            let face = *face;
            let edges = (0..4).map(move |at| [face[at], face[(at + 1) % 4]]);
            edges.filter(|[a, b]| a != b)
        };
        let edges = self.faces.iter().flat_map(sides);
        edges.map(|[a, b]| [a.min(b), a.max(b)]).collect()
    }

    fn brightness(&self, corners: [usize; 3], view: &View) -> f64 {
        let [a, b, c] = corners.map(|corner| self.places[corner]);
        let side = |to: [f64; 3]| [0, 1, 2].map(|axis| to[axis] - a[axis]);
        let normal = unit(cross(side(b), side(c)));
        normal.map_or(1.0, |normal| 0.3 + 0.7 * view.brightness(normal))
    }

    /// The picture with the names, shortened to the room beside it.
    fn legend(&self, mut dots: Dots) -> Dots {
        let [width, height] = dots.size();
        let text = (WORDS * width as f64).max(9.0);
        let left = width - bar_room(width);
        let row = 1.6 * text;
        let fitting = ((height as f64 - 2.0 * row) / row).max(1.0) as usize;
        let listed = self.names.len().min(fitting).min(LISTED);
        for (at, name) in self.names.iter().take(listed).enumerate() {
            let bottom = row * (at as f64 + 1.5);
            let color = COLORS[at % COLORS.len()].map(|channel| (channel * 255.0) as u8);
            let side = (0.8 * text) as usize;
            for (column, line) in (0..side).flat_map(|c| (0..side).map(move |l| (c, l))) {
                *dots.dot([left + column, bottom as usize - line]) = color;
            }
            let start = left as f64 + 1.2 * text;
            let room = width as f64 - start - 0.3 * text;
            dots.write_words(&shortened(name, room, text), [start, bottom], text);
        }
        if listed < self.names.len() {
            let more = format!("and {} more", self.names.len() - listed);
            let bottom = row * (listed as f64 + 1.5);
            dots.write_words(&more, [left as f64, bottom], text);
        }
        dots
    }
}

/// As much of a name as there is room for.
fn shortened(name: &str, room: f64, text: f64) -> String {
    if Dots::words_width(name, text) <= room {
        return name.to_owned();
    }
    let mut start = name.to_owned();
    while !start.is_empty() && Dots::words_width(&format!("{start}..."), text) > room {
        start.pop();
    }
    start + "..."
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn faces_have_the_colours_of_their_names() {
        let at = |x: usize| [x as f64, 0.0, 0.0];
        let up = |x: usize| [x as f64, 0.0, 1.0];
        let surfaces = Surfaces {
            places: vec![at(0), at(1), at(2), at(3), up(0), up(1), up(2), up(3)],
            faces: vec![[0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6]],
            named: vec![Some(0), None, Some(1)],
            names: vec!["left".to_owned(), "a name that is far too long".to_owned()],
            direction: [0.0, 1.0, 0.0],
            width: 400,
        };
        let mut dots = surfaces.render().unwrap();
        let [width, height] = dots.size();
        let room = width - bar_room(width);
        let [left, middle, right] =
            [1, 3, 5].map(|sixth| *dots.dot([room * sixth / 6, height / 2]));
        assert!(left[2] > left[0] && left[2] > left[1], "{left:?}");
        assert!(middle[0].abs_diff(middle[2]) < 20, "{middle:?}");
        assert!(right[0] > right[1] && right[1] > right[2], "{right:?}");
        let blind = Surfaces {
            direction: [0.0; 3],
            ..surfaces
        };
        assert!(matches!(blind.render(), Err(ReportError::View)));
    }

    #[test]
    fn long_names_are_shortened_to_the_room() {
        assert_eq!(shortened("sole", 100.0, 10.0), "sole");
        let short = shortened("a name that is far too long", 60.0, 10.0);
        assert!(short.ends_with("...") && Dots::words_width(&short, 10.0) <= 60.0);
    }
}
