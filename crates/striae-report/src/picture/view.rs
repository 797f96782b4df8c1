//! Projection of points: an orthographic view that contains everything shown.
//!
//! With the direction `d` of sight, `e_1 ~ d x e_z` points to the right and `e_2 = e_1 x d`
//! upwards; along the third axis `e_1` is the first one. A point is seen at
//! `(e_1 . x, e_2 . x)`, at the depth `d . x`.

use crate::ReportError;

/// Dots in a row and a column that are averaged to one.
pub const OVERSAMPLING: usize = 2;

/// Room at all sides over the width.
const MARGIN: f64 = 0.04;

/// A view.
#[derive(Clone, Debug, PartialEq)]
pub struct View {
    /// Right, up, and away from the eye.
    axes: [[f64; 3]; 3],
    /// Fine dots for a unit of length.
    scale: f64,
    /// Middle of what is shown, by the first two axes.
    middle: [f64; 2],
    /// Dots of the picture.
    size: [usize; 2],
}

/// Room for the colour bar at the right of a picture.
pub fn bar_room(width: usize) -> usize {
    width / 8
}

impl View {
    /// A view in a direction that holds all points, in a picture of a width.
    ///
    /// # Errors
    /// When the direction has no length.
    pub fn along(
        direction: [f64; 3],
        points: &[[f64; 3]],
        width: usize,
    ) -> Result<Self, ReportError> {
        let axes = axes(direction)?;
        let bounds = [0, 1].map(|axis| {
            let along = points.iter().map(|x| dot(*x, axes[axis]));
            along.fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], v| {
                [a.min(v), b.max(v)]
            })
        });
        let [across, up] = bounds.map(|[least, largest]| (largest - least).max(1e-300));
        let margin = MARGIN * width as f64;
        let room = (width - bar_room(width)) as f64 - 2.0 * margin;
        let highest = 0.9 * width as f64;
        let scale = (room / across).min(highest / up);
        let height = (up * scale + 4.0 * margin).max(0.3 * width as f64) as usize;
        Ok(Self {
            axes,
            scale: scale * OVERSAMPLING as f64,
            middle: bounds.map(|[least, largest]| 0.5 * (least + largest)),
            size: [width, height],
        })
    }

    /// The points that are farthest to the right, to the left, up and down in a direction of
    /// sight: a view of them holds all.
    ///
    /// # Errors
    /// When the direction has no length.
    pub fn outermost(
        direction: [f64; 3],
        points: &[[f64; 3]],
    ) -> Result<Vec<[f64; 3]>, ReportError> {
        let axes = axes(direction)?;
        let ends = axes[..2].iter().flat_map(|axis| {
            let by = |a: &&[f64; 3], b: &&[f64; 3]| dot(**a, *axis).total_cmp(&dot(**b, *axis));
            [points.iter().min_by(by), points.iter().max_by(by)]
        });
        Ok(ends.flatten().copied().collect())
    }

    /// Columns and rows of the picture.
    pub fn size(&self) -> [usize; 2] {
        self.size
    }

    /// Projection of a point: column and row in fine dots, and its depth in the same unit.
    pub fn seen(&self, x: [f64; 3]) -> [f64; 3] {
        let fine = OVERSAMPLING as f64;
        let center = [
            0.5 * (self.size[0] - bar_room(self.size[0])) as f64 * fine,
            0.5 * self.size[1] as f64 * fine,
        ];
        let along = self.axes.map(|axis| dot(x, axis));
        [
            center[0] + (along[0] - self.middle[0]) * self.scale,
            center[1] - (along[1] - self.middle[1]) * self.scale,
            along[2] * self.scale,
        ]
    }

    /// Returns whether a face with this normal is seen from behind.
    pub fn is_behind(&self, normal: [f64; 3]) -> bool {
        dot(normal, self.axes[2]) > 0.0
    }

    /// Brightness of a face with this normal, for light from above the left shoulder.
    pub fn brightness(&self, normal: [f64; 3]) -> f64 {
        let [right, up, away] = self.axes.map(|axis| dot(normal, axis));
        let light = (-0.35 * right + 0.6 * up - 0.72 * away).abs();
        0.55 + 0.45 * light.min(1.0)
    }
}

/// Right, up, and away from the eye.
fn axes(direction: [f64; 3]) -> Result<[[f64; 3]; 3], ReportError> {
    let away = unit(direction).ok_or(ReportError::View)?;
    let right = unit(cross(away, [0.0, 0.0, 1.0])).unwrap_or([1.0, 0.0, 0.0]);
    Ok([right, cross(right, away), away])
}

/// The vector product.
pub fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// A vector of unit length; `None` for one that is too short to have a direction.
pub fn unit(v: [f64; 3]) -> Option<[f64; 3]> {
    let length = dot(v, v).sqrt();
    (length > 1e-300).then(|| v.map(|component| component / length))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_shown_lies_inside_and_up_is_up() {
        let points = [[0.0, 0.0, 0.0], [2.0, 1.0, 0.5], [-1.0, 3.0, 4.0]];
        for direction in [[0.6, 1.0, -0.65], [1.0, 0.0, 0.0], [0.0, 0.0, -2.0]] {
            let view = View::along(direction, &points, 400).unwrap();
            let [width, height] = view.size().map(|dots| (dots * OVERSAMPLING) as f64);
            for [column, row, _] in points.map(|x| view.seen(x)) {
                assert!((0.0..width).contains(&column) && (0.0..height).contains(&row));
            }
        }
        let view = View::along([1.0, 0.0, 0.0], &points, 400).unwrap();
        let [low, high] = [0.0, 1.0].map(|z| view.seen([0.0, 0.0, z]));
        assert!(high[1] < low[1]);
        let [near, far] = [0.0, 1.0].map(|x| view.seen([x, 0.0, 0.0]));
        assert!(near[2] < far[2]);
        let [left, right] = [1.0, 0.0].map(|y| view.seen([0.0, y, 0.0]));
        assert!(left[0] < right[0]);
        assert!(View::along([0.0; 3], &points, 400).is_err());
        let mut inside = points.to_vec();
        inside.extend([[0.1, 0.9, 1.0], [0.3, 1.1, 0.8]]);
        for direction in [[0.6, 1.0, -0.65], [0.0, 0.0, -2.0]] {
            let outermost = View::outermost(direction, &inside).unwrap();
            assert!(outermost.len() <= 4);
            let [few, all] =
                [&outermost, &inside].map(|points| View::along(direction, points, 400));
            assert_eq!(few.unwrap(), all.unwrap());
        }
    }
}
