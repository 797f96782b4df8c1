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

/// Names of the sides of faces whose normals are shown.
const SIDES: [&str; 2] = ["front", "back"];
/// Faces whose normals are drawn at most.
const NEEDLES: usize = 2000;
/// Length of a normal over that of a square of the mean area of the faces.
const NEEDLE: f64 = 0.7;

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
    /// Shows to which side the faces look, in place of names: by colours of their fronts and
    /// backs, and by their normals.
    pub shows_normals: bool,
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
            shows_normals: false,
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
        let needles = self.needles();
        let ends = needles.iter().map(|[_, end]| *end);
        let shown: Vec<[f64; 3]> = self.places.iter().copied().chain(ends).collect();
        let view = View::along(self.direction, &shown, self.width)?;
        let mut canvas = Canvas::new(view.size());
        let seen: Vec<[f64; 3]> = self.places.iter().map(|x| view.seen(*x)).collect();
        for (face, name) in self.faces.iter().zip(&self.named) {
            let name = match self.shows_normals {
                true => self
                    .normal(face)
                    .map(|normal| usize::from(view.is_behind(normal))),
                false => *name,
            };
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
        for needle in needles {
            canvas.needle(needle.map(|end| view.seen(end)), 0.9);
        }
        Ok(self.legend(canvas.dots()))
    }

    /// Area of a face along its normal; half the vector product of its diagonals.
    fn area(&self, face: &[usize; 4]) -> [f64; 3] {
        let [a, b, c, d] = face.map(|corner| self.places[corner]);
        let [first, second] = [[a, c], [b, d]].map(|[from, to]| [0, 1, 2].map(|i| to[i] - from[i]));
        cross(first, second).map(|component| 0.5 * component)
    }

    /// The normal of a face that has one.
    fn normal(&self, face: &[usize; 4]) -> Option<[f64; 3]> {
        unit(self.area(face))
    }

    /// Normals of faces, from their middles, if they are to be shown and are not too many.
    fn needles(&self) -> Vec<[[f64; 3]; 2]> {
        if !self.shows_normals || self.faces.len() > NEEDLES {
            return Vec::new();
        }
        let size = |face| self.area(face).iter().map(|x| x * x).sum::<f64>().sqrt();
        let mean = self.faces.iter().map(size).sum::<f64>() / self.faces.len().max(1) as f64;
        let length = NEEDLE * mean.sqrt();
        let needle = |face: &[usize; 4]| {
            let normal = self.normal(face)?;
            // A triangle repeats its last corner.
            let corners = if face[2] == face[3] { 3 } else { 4 };
            let middle = [0, 1, 2].map(|axis| {
                let along = face[..corners]
                    .iter()
                    .map(|corner| self.places[*corner][axis]);
                along.sum::<f64>() / corners as f64
            });
            Some([middle, [0, 1, 2].map(|i| middle[i] + length * normal[i])])
        };
        self.faces.iter().filter_map(needle).collect()
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
        let names: Vec<&str> = match self.shows_normals {
            true => SIDES.into(),
            false => self.names.iter().map(String::as_str).collect(),
        };
        let listed = names.len().min(fitting).min(LISTED);
        for (at, name) in names.iter().take(listed).enumerate() {
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
        if listed < names.len() {
            let more = format!("and {} more", names.len() - listed);
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
            ..Surfaces::default()
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
    fn fronts_and_backs_differ_and_normals_stick_out() {
        let places = vec![[0.0; 3], [1.0, 0.0, 0.0], [1.0, 0.0, 1.0], [0.0, 0.0, 1.0]];
        let seen = |face: [usize; 4], direction: [f64; 3]| {
            let surfaces = Surfaces {
                places: places.clone(),
                faces: vec![face],
                named: vec![None],
                shows_normals: true,
                direction,
                width: 400,
                ..Surfaces::default()
            };
            surfaces.render().unwrap()
        };
        let at = |mut dots: Dots, share: f64| {
            let [width, height] = dots.size();
            let middle = (width - bar_room(width)) as f64;
            *dots.dot([(share * middle) as usize, height / 4])
        };
        // The normal is -y.
        let face = [0, 1, 2, 3];
        let [front, back] = [1.0, -1.0].map(|y| at(seen(face, [0.0, y, 0.0]), 0.3));
        assert!(
            front[2] > front[0] && back[0] > back[2],
            "{front:?} {back:?}"
        );
        let turned = at(seen([0, 3, 2, 1], [0.0, 1.0, 0.0]), 0.3);
        assert_eq!(turned, back);
        // Seen along the face there is nothing but its normal.
        let mut side = seen(face, [1.0, 0.0, 0.0]);
        let [width, height] = side.size();
        let dark = (0..width - bar_room(width)).filter(|x| side.dot([*x, height / 2])[0] < 200);
        assert!(dark.count() > 100);
    }

    #[test]
    fn long_names_are_shortened_to_the_room() {
        assert_eq!(shortened("sole", 100.0, 10.0), "sole");
        let short = shortened("a name that is far too long", 60.0, 10.0);
        assert!(short.ends_with("...") && Dots::words_width(&short, 10.0) <= 60.0);
    }
}
