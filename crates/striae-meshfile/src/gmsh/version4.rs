//! Entities, nodes and elements of version 4.1.
//!
//! Elements belong to geometric entities, and these to physical groups.

use super::super::MeshFileFault;
use super::input::Input;
use super::{Cell, File, kind::Kind};
use std::collections::HashMap;

/// Physical groups of the geometric entities by dimension and number.
#[derive(Default)]
pub(super) struct Entities(HashMap<(usize, i64), Vec<u64>>);

impl Entities {
    /// Numbers of points, curves, surfaces and volumes, then a record each:
    /// `number box.. group-count groups.. boundary-count boundary..`, the box of a point
    /// being its position, and no point having a boundary.
    pub(super) fn read(&mut self, input: &mut Input<'_>) -> Result<(), MeshFileFault> {
        input.row("the numbers of entities")?;
        let counts: Vec<usize> = input.several(4, |input| input.size("a number of entities"))?;
        for (dimension, count) in counts.into_iter().enumerate() {
            let box_size = if dimension == 0 { 3 } else { 6 };
            for _ in 0..count {
                input.record("an entity")?;
                let number = input.integer("the number of an entity")?;
                input.several(box_size, |input| input.real("a coordinate"))?;
                let groups = input.size("the number of physical groups")?;
                let groups: Vec<i64> =
                    input.several(groups, |input| input.integer("a physical group"))?;
                let groups = groups.into_iter().map(i64::unsigned_abs).collect();
                self.0.insert((dimension, number), groups);
                if input.is_binary() && dimension > 0 {
                    let boundary = input.size("the number of bounding entities")?;
                    input.several(boundary, |input| input.integer::<i64>("an entity"))?;
                }
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

/// `block-count node-count min max`, then blocks: a head `dimension entity
/// parametric count`, the node numbers, the coordinates, with those on a curve or surface
/// where these are given.
pub(super) fn nodes(input: &mut Input<'_>, file: &mut File) -> Result<(), MeshFileFault> {
    for _ in 0..block_count(input)? {
        input.row(BLOCK)?;
        let dimension: usize = input.integer(BLOCK)?;
        input.integer::<i64>(BLOCK)?;
        let parametric: usize = input.integer(BLOCK)?;
        let count: usize = input.size(BLOCK)?;
        let mut numbers = Vec::new();
        for _ in 0..count {
            input.row("a node number")?;
            numbers.push(input.size::<u64>("a node number")?);
        }
        for number in numbers {
            input.record("three coordinates")?;
            let x = input.several(3, |input| input.real("a coordinate"))?;
            file.add_node(input.place(), number, &x)?;
            if input.is_binary() && parametric != 0 {
                input.several(dimension, |input| input.real("a coordinate"))?;
            }
        }
    }
    Ok(())
}

/// `block-count element-count min max`, then blocks: a head `dimension entity
/// type count` and records `number nodes..`.
pub(super) fn elements(
    input: &mut Input<'_>,
    entities: &Entities,
    file: &mut File,
) -> Result<(), MeshFileFault> {
    for _ in 0..block_count(input)? {
        input.row(BLOCK)?;
        let dimension = input.integer(BLOCK)?;
        let groups = entities.groups(dimension, input.integer(BLOCK)?);
        let kind = Kind::new(input.place(), input.integer(BLOCK)?)?;
        let count: usize = input.size(BLOCK)?;
        for _ in 0..count {
            input.record("an element")?;
            file.cells.push(Cell {
                place: input.place(),
                number: input.size("an element number")?,
                kind,
                groups: groups.clone(),
                nodes: input.several(kind.node_count(), |input| input.size("a node number"))?,
            });
        }
    }
    Ok(())
}

const BLOCK: &str = "the head of a block: dimension, entity, kind, count";

/// The first of the four numbers at the beginning of nodes and elements.
fn block_count(input: &mut Input<'_>) -> Result<usize, MeshFileFault> {
    input.row("the number of blocks")?;
    let count = input.size("the number of blocks")?;
    if input.is_binary() {
        input.several(3, |input| input.size::<u64>("a number of the section"))?;
    }
    Ok(count)
}
