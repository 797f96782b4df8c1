//! Entities, nodes and elements of version 4.1.
//!
//! Elements belong to geometric entities, and these to physical groups.

use super::super::{MeshFileFault, lines::Lines};
use super::{Cell, File, kind::Kind};
use std::collections::HashMap;

/// Physical groups of the geometric entities by dimension and number.
#[derive(Default)]
pub(super) struct Entities(HashMap<(usize, i64), Vec<u64>>);

impl Entities {
    /// Numbers of points, curves, surfaces and volumes, then a line each:
    /// `number box.. group-count groups..`, the box of a point being its position.
    pub(super) fn read(&mut self, lines: &mut Lines<'_>) -> Result<(), MeshFileFault> {
        let counts: Vec<usize> = lines
            .words("the numbers of entities")?
            .several(4, "a number of entities")?;
        for (dimension, count) in counts.into_iter().enumerate() {
            let box_size = if dimension == 0 { 3 } else { 6 };
            for _ in 0..count {
                let mut words = lines.words("an entity")?;
                let number = words.next("the number of an entity")?;
                let _: Vec<f64> = words.several(box_size, "a coordinate")?;
                let group_count = words.next("the number of physical groups")?;
                let groups: Vec<i64> = words.several(group_count, "a physical group")?;
                let groups = groups.into_iter().map(i64::unsigned_abs).collect();
                self.0.insert((dimension, number), groups);
            }
        }
        Ok(())
    }

    fn groups(&self, dimension: usize, number: i64) -> Vec<u64> {
        self.0
            .get(&(dimension, number))
            .cloned()
            .unwrap_or_default()
    }
}

/// `block-count node-count min max`, then blocks: a line `dimension entity
/// parametric count`, the node numbers, the coordinates.
pub(super) fn nodes(lines: &mut Lines<'_>, file: &mut File) -> Result<(), MeshFileFault> {
    for _ in 0..block_count(lines)? {
        let header: Vec<i64> = lines.words(BLOCK)?.several(4, BLOCK)?;
        let mut numbers = Vec::new();
        for _ in 0..header[3] {
            numbers.push(lines.words("a node number")?.next::<u64>("a node number")?);
        }
        for number in numbers {
            let mut words = lines.words("three coordinates")?;
            let line = words.line();
            file.add_node(line, number, &words.several(3, "a coordinate")?)?;
        }
    }
    Ok(())
}

/// `block-count element-count min max`, then blocks: a line `dimension entity
/// type count` and lines `number nodes..`.
pub(super) fn elements(
    lines: &mut Lines<'_>,
    entities: &Entities,
    file: &mut File,
) -> Result<(), MeshFileFault> {
    for _ in 0..block_count(lines)? {
        let mut header = lines.words(BLOCK)?;
        let dimension = header.next(BLOCK)?;
        let groups = entities.groups(dimension, header.next(BLOCK)?);
        let kind = Kind::new(header.line(), header.next(BLOCK)?)?;
        let count: usize = header.next(BLOCK)?;
        for _ in 0..count {
            let mut words = lines.words("an element")?;
            file.cells.push(Cell {
                line: words.line(),
                number: words.next("an element number")?,
                kind,
                groups: groups.clone(),
                nodes: words.several(kind.node_count(), "a node number")?,
            });
        }
    }
    Ok(())
}

const BLOCK: &str = "the head of a block: dimension, entity, kind, count";

fn block_count(lines: &mut Lines<'_>) -> Result<usize, MeshFileFault> {
    lines
        .words("the number of blocks")?
        .next("the number of blocks")
}
