//! Nodes and elements of version 2.

use super::super::MeshFileFault;
use super::input::Input;
use super::{Cell, File, kind::Kind};

/// `count` as a line of text, then records `number x y z`.
pub(super) fn nodes(input: &mut Input<'_>, file: &mut File) -> Result<(), MeshFileFault> {
    input.text_row("the number of nodes")?;
    let count: usize = input.word("the number of nodes")?;
    for _ in 0..count {
        input.record("a node number and three coordinates")?;
        let number = input.integer("a node number")?;
        let x = input.several(3, |input| input.real("a coordinate"))?;
        file.add_node(input.place(), number, &x)?;
    }
    Ok(())
}

/// `count` as a line of text, then records; the first tag of an element is its physical
/// group, 0 for none.
pub(super) fn elements(input: &mut Input<'_>, file: &mut File) -> Result<(), MeshFileFault> {
    input.text_row("the number of elements")?;
    let count: usize = input.word("the number of elements")?;
    match input.is_binary() {
        false => listed(input, count, file),
        true => blocks(input, count, file),
    }
}

/// Lines `number type tag-count tags.. nodes..`.
fn listed(input: &mut Input<'_>, count: usize, file: &mut File) -> Result<(), MeshFileFault> {
    for _ in 0..count {
        input.record("an element")?;
        let number = input.integer("an element number")?;
        let kind = Kind::new(input.place(), input.integer("an element type")?)?;
        let tags = input.integer("the number of tags")?;
        element(input, number, kind, tags, file)?;
    }
    Ok(())
}

/// Blocks `type count tag-count` of records `number tags.. nodes..`.
fn blocks(input: &mut Input<'_>, count: usize, file: &mut File) -> Result<(), MeshFileFault> {
    let mut left = count;
    while left > 0 {
        let kind = Kind::new(input.place(), input.integer("an element type")?)?;
        let size: usize = input.integer("the number of elements of this type")?;
        let tags = input.integer("the number of tags")?;
        if size == 0 || size > left {
            let expected = format!("1 to {left} elements of this type");
            return Err(input.fault(&expected, size.to_string()));
        }
        for _ in 0..size {
            input.record("an element")?;
            let number = input.integer("an element number")?;
            element(input, number, kind, tags, file)?;
        }
        left -= size;
    }
    Ok(())
}

/// Remainder of an element: its tags and nodes.
fn element(
    input: &mut Input<'_>,
    number: u64,
    kind: Kind,
    tags: usize,
    file: &mut File,
) -> Result<(), MeshFileFault> {
    let tags: Vec<i64> = input.several(tags, |input| input.integer("a tag"))?;
    let nodes = input.several(kind.node_count(), |input| input.integer("a node number"))?;
    let group = tags.first().map_or(0, |tag| tag.unsigned_abs());
    file.cells.push(Cell {
        place: input.place(),
        number,
        kind,
        groups: (group != 0).then_some(group).into_iter().collect(),
        nodes,
    });
    Ok(())
}
