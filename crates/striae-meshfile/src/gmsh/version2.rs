//! Nodes and elements of version 2.

use super::super::{MeshFileFault, lines::Lines};
use super::{Cell, File, kind::Kind};

/// `count`, then lines `number x y z`.
pub(super) fn nodes(lines: &mut Lines<'_>, file: &mut File) -> Result<(), MeshFileFault> {
    let count: usize = lines
        .words("the number of nodes")?
        .next("the number of nodes")?;
    for _ in 0..count {
        let mut words = lines.words("a node number and three coordinates")?;
        let line = words.line();
        let number = words.next("a node number")?;
        file.add_node(line, number, &words.several(3, "a coordinate")?)?;
    }
    Ok(())
}

/// `count`, then lines `number type tag-count tags.. nodes..`; the first tag is
/// the physical group, 0 for none.
pub(super) fn elements(lines: &mut Lines<'_>, file: &mut File) -> Result<(), MeshFileFault> {
    let count: usize = lines
        .words("the number of elements")?
        .next("the number of elements")?;
    for _ in 0..count {
        let mut words = lines.words("an element")?;
        let line = words.line();
        let number = words.next("an element number")?;
        let kind = Kind::new(line, words.next("an element type")?)?;
        let tag_count = words.next("the number of tags")?;
        let tags: Vec<i64> = words.several(tag_count, "a tag")?;
        let nodes = words.several(kind.node_count(), "a node number")?;
        let group = tags.first().map_or(0, |tag| tag.unsigned_abs());
        file.cells.push(Cell {
            line,
            number,
            kind,
            groups: (group != 0).then_some(group).into_iter().collect(),
            nodes,
        });
    }
    Ok(())
}
