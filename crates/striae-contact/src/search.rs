//! Bounding-volume tree over axis-aligned boxes.

use striae_mesh::Vec3;

/// An axis-aligned box.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// Smallest coordinates.
    pub low: Vec3,
    /// Largest coordinates.
    pub high: Vec3,
}

impl Bounds {
    /// The smallest box around the points.
    pub fn around(points: impl IntoIterator<Item = Vec3>) -> Self {
        let empty = Self {
            low: Vec3::repeat(f64::INFINITY),
            high: Vec3::repeat(f64::NEG_INFINITY),
        };
        points.into_iter().fold(empty, |bounds, point| Self {
            low: bounds.low.inf(&point),
            high: bounds.high.sup(&point),
        })
    }

    /// The box with all faces moved out by `margin`.
    pub fn inflated(&self, margin: f64) -> Self {
        Self {
            low: self.low.add_scalar(-margin),
            high: self.high.add_scalar(margin),
        }
    }

    /// The box with the two faces across each axis moved out by the `margins` along it.
    pub fn inflated_along(&self, margins: &Vec3) -> Self {
        Self {
            low: self.low - margins,
            high: self.high + margins,
        }
    }

    /// Largest size of each component of a vector in the box.
    pub fn largest(&self) -> Vec3 {
        self.low.abs().sup(&self.high.abs())
    }

    /// The smallest box around both.
    pub fn union(&self, other: &Self) -> Self {
        Self {
            low: self.low.inf(&other.low),
            high: self.high.sup(&other.high),
        }
    }

    /// Square of the distance of a point from the box, zero inside.
    pub fn squared_distance(&self, x: &Vec3) -> f64 {
        (self.low - x)
            .sup(&(x - self.high))
            .map(|d| d.max(0.0))
            .norm_squared()
    }

    /// Returns whether a half-line meets the box.
    pub fn is_on_ray(&self, origin: &Vec3, direction: &Vec3) -> bool {
        let mut range = [0.0_f64, f64::INFINITY];
        for axis in 0..3 {
            let [low, high] = [self.low, self.high].map(|end| end[axis] - origin[axis]);
            if direction[axis] == 0.0 {
                if low > 0.0 || high < 0.0 {
                    return false;
                }
                continue;
            }
            let (one, other) = (low / direction[axis], high / direction[axis]);
            range = [range[0].max(one.min(other)), range[1].min(one.max(other))];
        }
        range[0] <= range[1]
    }

    /// Least product of a vector in the box with `n`.
    pub fn least_along(&self, n: &Vec3) -> f64 {
        let products = [&self.low, &self.high].map(|end| end.component_mul(n));
        products[0].inf(&products[1]).sum()
    }

    /// Returns whether the boxes have a point in common.
    pub fn meets(&self, other: &Self) -> bool {
        (0..3).all(|axis| self.low[axis] <= other.high[axis] && other.low[axis] <= self.high[axis])
    }
}

/// A binary tree over boxes, split at the median of their centres.
#[derive(Clone, Debug)]
pub struct Tree {
    nodes: Vec<TreeNode>,
    items: Vec<u32>,
    boxes: Vec<Bounds>,
}

#[derive(Clone, Debug)]
struct TreeNode {
    bounds: Bounds,
    range: [usize; 2],
    children: Option<[usize; 2]>,
}

const LEAF: usize = 4;

impl Tree {
    /// A tree over the boxes; items are named by their position.
    pub fn new(boxes: Vec<Bounds>) -> Self {
        let mut tree = Self {
            nodes: Vec::new(),
            items: (0..boxes.len() as u32).collect(),
            boxes,
        };
        if !tree.items.is_empty() {
            tree.split(0, tree.items.len());
        }
        tree
    }

    fn split(&mut self, start: usize, end: usize) -> usize {
        let bounds = self.items[start..end]
            .iter()
            .map(|&item| self.boxes[item as usize])
            .reduce(|a, b| a.union(&b))
            .unwrap_or_else(|| Bounds::around([]));
        let index = self.nodes.len();
        self.nodes.push(TreeNode {
            bounds,
            range: [start, end],
            children: None,
        });
        if end - start > LEAF {
            let axis = (bounds.high - bounds.low).imax();
            let boxes = &self.boxes;
            let centre = |item: &u32| {
                let bounds = &boxes[*item as usize];
                (bounds.low[axis] + bounds.high[axis], *item)
            };
            let order = |a: &u32, b: &u32| {
                let (a, b) = (centre(a), centre(b));
                a.0.total_cmp(&b.0).then(a.1.cmp(&b.1))
            };
            // Halves that are divided again are ordered along axes of their own. The order in a leaf
            // decides which of several items at one distance `visit_nearest` visits first.
            let half = (end - start) / 2;
            let items = &mut self.items[start..end];
            items.select_nth_unstable_by(half, order);
            for part in [0..half, half..items.len()] {
                if part.len() <= LEAF {
                    items[part].sort_unstable_by(order);
                }
            }
            let middle = start + half;
            let children = [self.split(start, middle), self.split(middle, end)];
            self.nodes[index].children = Some(children);
        }
        index
    }

    /// Items whose boxes meet `bounds`, ascending.
    pub fn meeting(&self, bounds: &Bounds) -> Vec<u32> {
        let meets = |of: &Bounds| of.meets(bounds);
        self.found(|_, of| meets(of), |_, of| meets(of))
    }

    /// Items for which `is_found` holds, ascending; of a node none is looked at where `has_any` does
    /// not hold. Both are given a number and a box.
    pub fn found(
        &self,
        has_any: impl Fn(usize, &Bounds) -> bool,
        is_found: impl Fn(u32, &Bounds) -> bool,
    ) -> Vec<u32> {
        let mut found = Vec::new();
        let mut stack = Vec::with_capacity(32);
        if !self.nodes.is_empty() {
            stack.push(0);
        }
        while let Some(index) = stack.pop() {
            let node = &self.nodes[index];
            if !has_any(index, &node.bounds) {
                continue;
            }
            match node.children {
                Some(children) => stack.extend(children),
                None => found.extend(
                    self.items[node.range[0]..node.range[1]]
                        .iter()
                        .copied()
                        .filter(|&item| is_found(item, &self.boxes[item as usize])),
                ),
            }
        }
        found.sort_unstable();
        found
    }

    /// Values of the nodes by number, each joined from those of all its items.
    pub fn joined<T: Copy>(&self, of_item: impl Fn(u32) -> T, join: impl Fn(T, T) -> T) -> Vec<T> {
        let mut last_first: Vec<T> = Vec::with_capacity(self.nodes.len());
        for node in self.nodes.iter().rev() {
            let at = |child: usize| last_first[self.nodes.len() - 1 - child];
            let items = self.items[node.range[0]..node.range[1]].iter();
            last_first.push(match node.children {
                // Children have larger numbers.
                Some([one, other]) => join(at(one), at(other)),
                None => {
                    let joined = items.copied().map(&of_item).reduce(&join);
                    joined.expect("a leaf has items")
                }
            });
        }
        last_first.reverse();
        last_first
    }

    /// The box around all items.
    pub fn bounds(&self) -> Option<&Bounds> {
        self.nodes.first().map(|root| &root.bounds)
    }

    /// Items whose boxes a half-line meets, ascending.
    pub fn on_ray(&self, origin: &Vec3, direction: &Vec3) -> Vec<u32> {
        let mut found = Vec::new();
        let mut stack: Vec<usize> = (0..self.nodes.len().min(1)).collect();
        while let Some(index) = stack.pop() {
            let node = &self.nodes[index];
            if !node.bounds.is_on_ray(origin, direction) {
                continue;
            }
            match node.children {
                Some(children) => stack.extend(children),
                None => found.extend_from_slice(&self.items[node.range[0]..node.range[1]]),
            }
        }
        found.retain(|&item| self.boxes[item as usize].is_on_ray(origin, direction));
        found.sort_unstable();
        found
    }

    /// Calls `visit` for all items that may be nearest to `x`. It returns the square of
    /// the item's distance, which is not less than that of its box.
    pub fn visit_nearest(&self, x: &Vec3, mut visit: impl FnMut(u32) -> f64) {
        let mut least = f64::INFINITY;
        let mut stack: Vec<(f64, usize)> = Vec::with_capacity(32);
        stack.extend(
            self.nodes
                .first()
                .map(|root| (root.bounds.squared_distance(x), 0)),
        );
        while let Some((distance, index)) = stack.pop() {
            if distance > least {
                continue;
            }
            let node = &self.nodes[index];
            match node.children {
                Some(children) => {
                    let far = |child: usize| self.nodes[child].bounds.squared_distance(x);
                    let mut both = children.map(|child| (far(child), child));
                    both.sort_unstable_by(|a, b| b.0.total_cmp(&a.0));
                    stack.extend(both);
                }
                None => {
                    for &item in &self.items[node.range[0]..node.range[1]] {
                        if self.boxes[item as usize].squared_distance(x) <= least {
                            least = least.min(visit(item));
                        }
                    }
                }
            }
        }
    }

    /// Returns whether any item's box meets `bounds`.
    pub fn meets(&self, bounds: &Bounds) -> bool {
        !self.meeting(bounds).is_empty()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn boxes() -> impl Strategy<Value = Vec<Bounds>> {
        let coordinate = || -1.0..1.0_f64;
        let one =
            (coordinate(), coordinate(), coordinate(), 0.0..0.4_f64).prop_map(|(x, y, z, size)| {
                Bounds {
                    low: Vec3::new(x, y, z),
                    high: Vec3::new(x + size, y + 0.5 * size, z + 0.1),
                }
            });
        prop::collection::vec(one, 0..60)
    }

    /// Sorts items along the longest axis of their box, then each half of them, down to leaves.
    fn sort_and_halve(boxes: &[Bounds], items: &mut [u32]) {
        if items.len() <= LEAF {
            return;
        }
        let of_items = items.iter().map(|&item| boxes[item as usize]);
        let around = of_items.reduce(|a, b| a.union(&b)).expect("items");
        let axis = (around.high - around.low).imax();
        let centre = |item: u32| boxes[item as usize].low[axis] + boxes[item as usize].high[axis];
        items.sort_by(|&a, &b| centre(a).total_cmp(&centre(b)).then(a.cmp(&b)));
        let (first, second) = items.split_at_mut(items.len() / 2);
        sort_and_halve(boxes, first);
        sort_and_halve(boxes, second);
    }

    proptest! {
        #[test]
        fn items_are_those_of_a_full_sort(boxes in boxes(), grid in 1.0..8.0_f64) {
            // On a grid many boxes have the same centre along an axis.
            let snapped = |x: &Vec3| x.map(|x| (x * grid).round());
            let boxes = boxes.iter().map(|of| Bounds { low: snapped(&of.low), high: snapped(&of.high) });
            let boxes: Vec<Bounds> = boxes.collect();
            let mut expected: Vec<u32> = (0..boxes.len() as u32).collect();
            sort_and_halve(&boxes, &mut expected);
            prop_assert_eq!(Tree::new(boxes).items, expected);
        }

        #[test]
        fn equals_brute_force(boxes in boxes(), x in -1.0..1.0_f64, y in -1.0..1.0_f64) {
            let query = Bounds::around([Vec3::new(x, y, -0.2), Vec3::new(x + 0.3, y + 0.1, 0.3)]);
            let expected: Vec<u32> = (0..boxes.len() as u32)
                .filter(|&item| boxes[item as usize].meets(&query))
                .collect();
            prop_assert_eq!(Tree::new(boxes).meeting(&query), expected);
        }

        #[test]
        fn nodes_join_all_of_their_items(boxes in boxes()) {
            let tree = Tree::new(boxes.clone());
            let joined = tree.joined(|item| boxes[item as usize], |a, b| a.union(&b));
            let bounds: Vec<Bounds> = tree.nodes.iter().map(|node| node.bounds).collect();
            prop_assert_eq!(joined, bounds);
        }

        #[test]
        fn the_least_product_is_that_of_a_corner(
            boxes in boxes(),
            (x, y, z) in (-1.0..1.0_f64, -1.0..1.0_f64, -1.0..1.0_f64),
        ) {
            let n = Vec3::new(x, y, z);
            for of in &boxes {
                let corners = (0..8).map(|corner| {
                    Vec3::from_fn(|axis, _| [of.low, of.high][corner >> axis & 1][axis])
                });
                let least = corners.map(|x| x.dot(&n)).fold(f64::INFINITY, f64::min);
                prop_assert!((of.least_along(&n) - least).abs() < 1e-12);
            }
        }

        #[test]
        fn the_nearest_equals_brute_force(boxes in boxes(), x in -2.0..2.0_f64, y in -2.0..2.0_f64) {
            let x = Vec3::new(x, y, 0.3);
            let distances = boxes.iter().map(|bounds| bounds.squared_distance(&x));
            let expected = distances.fold(f64::INFINITY, f64::min);
            let mut found = f64::INFINITY;
            Tree::new(boxes.clone()).visit_nearest(&x, |item| {
                let distance = boxes[item as usize].squared_distance(&x);
                found = found.min(distance);
                distance
            });
            prop_assert_eq!(found, expected);
        }

        #[test]
        fn rays_equal_brute_force(boxes in boxes(), x in -1.0..1.0_f64, y in -1.0..1.0_f64) {
            let (origin, direction) = (Vec3::new(x, -1.5, y), Vec3::new(0.2, y, 0.0));
            let expected: Vec<u32> = (0..boxes.len() as u32)
                .filter(|&item| boxes[item as usize].is_on_ray(&origin, &direction))
                .collect();
            prop_assert_eq!(Tree::new(boxes).on_ray(&origin, &direction), expected);
        }
    }
}
