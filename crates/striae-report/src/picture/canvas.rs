//! Dots with depths: triangles and lines that hide each other.
//!
//! Objects nearer to the eye hide those behind them, dot by dot. Four fine dots make one of the
//! picture, which smooths edges.

use striae_figure::Dots;

use super::view::OVERSAMPLING;

/// Distance, in fine dots, up to which surfaces lie on each other.
const FLUSH: f64 = 0.5;

/// Red, green and blue, 0 to 1.
pub type Color = [f64; 3];

/// Dots with depths.
#[derive(Clone, Debug)]
pub struct Canvas {
    /// Fine columns and rows.
    size: [usize; 2],
    colors: Vec<Color>,
    depths: Vec<f64>,
}

impl Canvas {
    /// A white canvas, for a picture of so many columns and rows.
    pub fn new(picture: [usize; 2]) -> Self {
        let size = picture.map(|dots| dots * OVERSAMPLING);
        let count = size[0] * size[1];
        Self {
            size,
            colors: vec![[1.0; 3]; count],
            depths: vec![f64::INFINITY; count],
        }
    }

    /// An empty canvas of the same size.
    pub fn blank(&self) -> Self {
        Self::new(self.size.map(|dots| dots / OVERSAMPLING))
    }

    /// Fills a triangle of seen points; `color` is that of a place in the triangle, by the
    /// shares of its corners.
    pub fn fill(&mut self, corners: [[f64; 3]; 3], color: impl Fn([f64; 3]) -> Color) {
        let [a, b, c] = corners;
        let area = (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]);
        if area.abs() < 1e-9 {
            return;
        }
        let span = |axis: usize| {
            let at = corners.map(|corner| corner[axis]);
            let least = at.iter().copied().fold(f64::INFINITY, f64::min).max(0.0);
            let largest = at.iter().copied().fold(0.0, f64::max);
            least.floor() as usize..self.size[axis].min(largest.ceil() as usize + 1)
        };
        let (columns, rows) = (span(0), span(1));
        for row in rows {
            for column in columns.clone() {
                let [x, y] = [column as f64 + 0.5, row as f64 + 0.5];
                let share = |p: [f64; 3], q: [f64; 3]| {
                    ((p[0] - x) * (q[1] - y) - (q[0] - x) * (p[1] - y)) / area
                };
                let shares = [share(b, c), share(c, a), share(a, b)];
                if shares.iter().any(|share| *share < -1e-9) {
                    continue;
                }
                let depth: f64 = (0..3).map(|i| shares[i] * corners[i][2]).sum();
                let at = row * self.size[0] + column;
                if depth < self.depths[at] {
                    self.depths[at] = depth;
                    self.colors[at] = color(shares);
                }
            }
        }
    }

    /// Darkens what a line crosses where nothing hides it, on faces alone.
    pub fn line(&mut self, ends: [[f64; 3]; 2], darkness: f64) {
        self.darken(ends, darkness, f64::MAX);
    }

    /// Darkens what a line crosses where nothing hides it, beside the faces, too.
    pub fn needle(&mut self, ends: [[f64; 3]; 2], darkness: f64) {
        self.darken(ends, darkness, f64::INFINITY);
    }

    /// Darkens what a line crosses where nothing hides it, up to a depth.
    fn darken(&mut self, ends: [[f64; 3]; 2], darkness: f64, deepest: f64) {
        let [from, to] = ends;
        let steps = (to[0] - from[0]).abs().max((to[1] - from[1]).abs()).ceil();
        // A line lies on the faces beside it, to the slope of a face that is seen steeply.
        let slack = 2.5 + 2.0 * (to[2] - from[2]).abs() / steps.max(1.0);
        let mut last = usize::MAX;
        for step in 0..=steps as usize {
            let s = step as f64 / steps.max(1.0);
            let [x, y, depth] = [0, 1, 2].map(|axis| from[axis] + s * (to[axis] - from[axis]));
            if x < 0.0 || y < 0.0 || x as usize >= self.size[0] || y as usize >= self.size[1] {
                continue;
            }
            let at = y as usize * self.size[0] + x as usize;
            if at != last && depth < self.depths[at] + slack && self.depths[at] <= deepest {
                self.colors[at] = self.colors[at].map(|channel| channel * (1.0 - darkness));
            }
            last = at;
        }
    }

    /// Lays another canvas over this one, of which so much is seen where it is nearer.
    ///
    /// Surfaces that touch stay uncovered: round-off would decide dot by dot which is nearer.
    pub fn veil(&mut self, over: &Self, share: f64) {
        for at in 0..self.colors.len() {
            if over.depths[at] < self.depths[at] - FLUSH {
                let [below, above] = [self.colors[at], over.colors[at]];
                self.colors[at] = [0, 1, 2].map(|i| (1.0 - share) * below[i] + share * above[i]);
            }
        }
    }

    /// The picture.
    pub fn dots(&self) -> Dots {
        let mut dots = Dots::white(self.size.map(|fine| fine / OVERSAMPLING));
        let [columns, rows] = dots.size();
        let count = (OVERSAMPLING * OVERSAMPLING) as f64;
        for row in 0..rows {
            for column in 0..columns {
                let mut mean = [0.0; 3];
                for fine in 0..OVERSAMPLING * OVERSAMPLING {
                    let y = row * OVERSAMPLING + fine / OVERSAMPLING;
                    let x = column * OVERSAMPLING + fine % OVERSAMPLING;
                    let color = self.colors[y * self.size[0] + x];
                    (0..3).for_each(|i| mean[i] += color[i] / count);
                }
                *dots.dot([column, row]) = mean.map(|channel| (channel * 255.0).round() as u8);
            }
        }
        dots
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const FRONT: [[f64; 3]; 3] = [[2.0, 2.0, 1.0], [30.0, 2.0, 1.0], [2.0, 30.0, 1.0]];

    #[test]
    fn what_is_nearer_hides_what_is_behind_in_either_order() {
        let back = FRONT.map(|[x, y, _]| [x, y, 5.0]);
        let mut orders = [Canvas::new([20, 20]), Canvas::new([20, 20])];
        orders[0].fill(FRONT, |_| [1.0, 0.0, 0.0]);
        orders[0].fill(back, |_| [0.0, 0.0, 1.0]);
        orders[1].fill(back, |_| [0.0, 0.0, 1.0]);
        orders[1].fill(FRONT, |_| [1.0, 0.0, 0.0]);
        for canvas in orders {
            assert_eq!(*canvas.dots().dot([4, 4]), [255, 0, 0]);
            assert_eq!(*canvas.dots().dot([18, 18]), [255; 3]);
        }
    }

    #[test]
    fn shares_are_those_of_the_corners() {
        let mut canvas = Canvas::new([20, 20]);
        canvas.fill(FRONT, |shares| {
            assert!((shares.iter().sum::<f64>() - 1.0).abs() < 1e-12);
            shares
        });
        let near = *canvas.dots().dot([1, 1]);
        assert!(near[0] > 230 && near[1] < 30 && near[2] < 30, "{near:?}");
    }

    #[test]
    fn a_veil_lets_through_what_is_behind_it_and_covers_nothing_before_it() {
        let mut canvas = Canvas::new([20, 20]);
        canvas.fill(FRONT, |_| [1.0, 0.0, 0.0]);
        let mut behind = canvas.blank();
        behind.fill(FRONT.map(|[x, y, _]| [x, y, 5.0]), |_| [0.0; 3]);
        canvas.veil(&behind, 0.5);
        assert_eq!(*canvas.dots().dot([4, 4]), [255, 0, 0]);
        let mut before = canvas.blank();
        before.fill(FRONT.map(|[x, y, _]| [x, y, 0.0]), |_| [0.0; 3]);
        canvas.veil(&before, 0.5);
        assert_eq!(*canvas.dots().dot([4, 4]), [128, 0, 0]);
    }

    #[test]
    fn a_veil_leaves_what_it_touches() {
        let mut canvas = Canvas::new([20, 20]);
        canvas.fill(FRONT, |_| [1.0, 0.0, 0.0]);
        let mut flush = canvas.blank();
        flush.fill(FRONT.map(|[x, y, z]| [x, y, z - 1e-9]), |_| [0.0; 3]);
        canvas.veil(&flush, 1.0);
        assert_eq!(*canvas.dots().dot([4, 4]), [255, 0, 0]);
    }

    #[test]
    fn lines_show_where_nothing_hides_them() {
        let mut canvas = Canvas::new([20, 20]);
        canvas.fill(FRONT, |_| [1.0; 3]);
        let plain = canvas.dots();
        canvas.line([[4.0, 4.0, 50.0], [12.0, 4.0, 50.0]], 0.5);
        assert_eq!(canvas.dots(), plain);
        canvas.line([[4.0, 4.0, 1.0], [12.0, 4.0, 1.0]], 0.5);
        assert_ne!(canvas.dots(), plain);
    }
}
