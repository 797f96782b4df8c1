//! A few colours for many: the palette of a GIF.
//!
//! Colours are counted in cells of four levels a channel. The box of colours whose squared
//! deviations from its mean sum up to most is cut at the mean of its widest channel, until there
//! are enough boxes; their means are the palette. A colour stands alone in its box if it can, so
//! that a background is kept to the bit.

use std::collections::HashMap;

use crate::Dot;

/// Bits of a channel that tell cells apart.
const BITS: u32 = 6;

/// Squared deviations of a box that are round-off.
const ALIKE: f64 = 1e-3;

/// Colours, and the nearest one to each dot asked for.
pub struct Palette {
    colors: Vec<Dot>,
    known: HashMap<Dot, u8>,
}

/// Colours of a cell: their number and their sums.
#[derive(Clone, Copy, Default)]
struct Cell {
    count: f64,
    sums: [f64; 3],
}

impl Cell {
    fn mean(&self) -> [f64; 3] {
        self.sums.map(|sum| sum / self.count)
    }
}

impl Palette {
    /// A palette of at most so many colours, 256 or fewer, for given dots.
    pub fn of<'a>(dots: impl Iterator<Item = &'a Dot>, most: usize) -> Self {
        let mut cells = vec![Cell::default(); 1 << (3 * BITS)];
        for dot in dots {
            let cell = &mut cells[place(*dot)];
            cell.count += 1.0;
            (0..3).for_each(|c| cell.sums[c] += f64::from(dot[c]));
        }
        cells.retain(|cell| cell.count > 0.0);
        let mut boxes = vec![Boxed::of(cells)];
        while boxes.len() < most {
            let spreads = boxes.iter().map(Boxed::spread).enumerate();
            let Some((widest, spread)) = spreads.max_by(|a, b| a.1.total_cmp(&b.1)) else {
                break;
            };
            if spread <= ALIKE {
                break;
            }
            let halves = boxes.swap_remove(widest).cut();
            boxes.extend(halves);
        }
        let color = |one: &Boxed| one.mean.map(|channel| channel.round() as u8);
        Self {
            colors: boxes.iter().map(color).collect(),
            known: HashMap::new(),
        }
    }

    /// 256 colours in a row, red, green and blue; those that are left over are black.
    pub fn bytes(&self) -> Vec<u8> {
        let mut bytes = self.colors.as_flattened().to_vec();
        bytes.resize(3 * 256, 0);
        bytes
    }

    /// The number of the colour nearest to a dot.
    pub fn number(&mut self, dot: Dot) -> u8 {
        let nearest = || {
            let away = |color: &Dot| {
                let of = |c: usize| i32::from(color[c]) - i32::from(dot[c]);
                (0..3).map(|c| of(c) * of(c)).sum::<i32>()
            };
            let colors = self.colors.iter().enumerate();
            let nearest = colors.min_by_key(|(_, color)| away(color));
            nearest.map_or(0, |(number, _)| number as u8)
        };
        *self.known.entry(dot).or_insert_with(nearest)
    }
}

/// Cells that become one colour.
struct Boxed {
    cells: Vec<Cell>,
    mean: [f64; 3],
    /// Sums of squared deviations by channel.
    spreads: [f64; 3],
}

impl Boxed {
    fn of(cells: Vec<Cell>) -> Self {
        let count: f64 = cells.iter().map(|cell| cell.count).sum();
        let sum = |c: usize| cells.iter().map(|cell| cell.sums[c]).sum::<f64>();
        let mean = [0, 1, 2].map(|c| sum(c) / count.max(1.0));
        let spreads = [0, 1, 2].map(|c| {
            let away = |cell: &Cell| cell.count * (cell.mean()[c] - mean[c]).powi(2);
            match cells.len() {
                0 | 1 => 0.0,
                _ => cells.iter().map(away).sum(),
            }
        });
        Self {
            cells,
            mean,
            spreads,
        }
    }

    fn spread(&self) -> f64 {
        self.spreads.iter().sum()
    }

    /// Both halves about the mean of the widest channel.
    fn cut(self) -> [Self; 2] {
        let channels = (0..3).max_by(|a, b| self.spreads[*a].total_cmp(&self.spreads[*b]));
        let channel = channels.unwrap_or(0);
        let below = |cell: &Cell| cell.mean()[channel] < self.mean[channel];
        let (low, high) = self.cells.into_iter().partition(below);
        [Self::of(low), Self::of(high)]
    }
}

fn place(dot: Dot) -> usize {
    let cell = |channel: u8| usize::from(channel >> (8 - BITS));
    (cell(dot[0]) << (2 * BITS)) | (cell(dot[1]) << BITS) | cell(dot[2])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn few_colours_are_kept_to_the_bit() {
        let dots: Vec<Dot> = (0..100).map(|at| [at * 2, 255 - at * 2, 7]).collect();
        let mut many = vec![[255, 255, 255]; 10_000];
        many.extend(&dots);
        let mut palette = Palette::of(many.iter(), 255);
        let white = palette.number([255; 3]);
        assert_eq!(palette.colors[usize::from(white)], [255; 3]);
        for dot in dots {
            let number = usize::from(palette.number(dot));
            let found = palette.colors[number];
            assert!((0..3).all(|c| found[c].abs_diff(dot[c]) <= 2), "{dot:?}");
        }
    }

    #[test]
    fn many_colours_become_near_ones() {
        let colour = |at: usize| {
            let light = 0.7 + 0.3 * (at % 16) as f64 / 15.0;
            crate::color_map((at / 16) as f64 / 255.0).map(|c| (f64::from(c) * light) as u8)
        };
        let dots: Vec<Dot> = (0..4096).map(colour).collect();
        let mut palette = Palette::of(dots.iter(), 255);
        assert!(palette.colors.len() <= 255);
        let away = dots.iter().map(|dot| {
            let number = usize::from(palette.number(*dot));
            let found = palette.colors[number];
            (0..3).map(|c| found[c].abs_diff(dot[c])).max().unwrap_or(0)
        });
        // 4096 shades on a surface of 255 patches: some 4 levels from the middle to the edge of one.
        let farthest = away.max();
        assert!(farthest <= Some(16), "{farthest:?}");
    }
}
