//! Vectors at nodes, from the sections `$NodeData` of both versions; in a binary file the lines of nodes are an
//! integer and reals.
//!
//! ```text
//! $NodeData
//! 1                 number of texts, then one a line
//! "fibres"          the first is the name
//! 1                 number of reals, then one a line
//! 0.0               time
//! 3                 number of integers, then one a line
//! 0                 time step
//! 3                 components: 3 for a vector
//! 2                 number of nodes, then a line each
//! 1 0.6 0.8 0       number of the node and its vector
//! 2 1 0 0
//! $EndNodeData
//! ```

use super::super::lines::quoted;
use super::super::{MeshFileFault, NodeVectors, Place};
use super::input::{Input, readable};
use super::{quoted_name, read_format};
use striae_mesh::Vec3;

/// The vectors called `name`; without a name, the only node data of the file.
pub(crate) fn node_data(bytes: &[u8], name: Option<&str>) -> Result<NodeVectors, MeshFileFault> {
    let mut all = sections(bytes)?;
    let named = |section: &Section| name.is_none_or(|name| name == section.name);
    match all.iter().filter(|section| named(section)).count() {
        1 => all
            .swap_remove(all.iter().position(named).unwrap_or(0))
            .vectors(),
        _ => Err(MeshFileFault::NodeData {
            name: name.map(str::to_owned),
            known: all.into_iter().map(|section| section.name).collect(),
        }),
    }
}

/// One section `$NodeData`.
struct Section {
    name: String,
    /// Location of the number of components.
    place: Place,
    components: usize,
    /// Place, number of the node and values.
    rows: Vec<(Place, u64, Vec<f64>)>,
}

fn sections(bytes: &[u8]) -> Result<Vec<Section>, MeshFileFault> {
    let bytes = readable(bytes);
    let mut input = Input::new(&bytes);
    let mut sections = Vec::new();
    while let Some(name) = input.section()? {
        match name {
            "MeshFormat" => {
                read_format(&mut input)?;
                input.end(name)?;
            }
            "NodeData" => {
                sections.push(Section::read(&mut input)?);
                input.end(name)?;
            }
            _ => input.skip(name)?,
        }
    }
    Ok(sections)
}

impl Section {
    fn read(input: &mut Input<'_>) -> Result<Self, MeshFileFault> {
        let mut texts = Vec::new();
        for _ in 0..whole(input, "the number of texts")? {
            let line = input.line("a text")?;
            texts.push(quoted_name(line, |expected| {
                input.fault(expected, quoted(line))
            })?);
        }
        for _ in 0..whole(input, "the number of reals")? {
            input.text_row("a real")?;
            input.word::<f64>("a real")?;
        }
        let integers = whole(input, "the number of integers")?;
        if integers < 3 {
            let found = format!("{integers} integers");
            return Err(input.fault("time step, components and number of nodes", found));
        }
        whole(input, "the time step")?;
        let components = whole(input, "the number of components")?;
        let place = input.place();
        let count = whole(input, "the number of nodes")?;
        for _ in 3..integers {
            whole(input, "an integer")?;
        }
        let mut rows = Vec::new();
        for _ in 0..count {
            input.record("a node number and its values")?;
            let number = input.integer("a node number")?;
            let values = input.several(components, |input| input.real("a value"))?;
            rows.push((input.place(), number, values));
        }
        Ok(Self {
            name: texts.into_iter().next().unwrap_or_default(),
            place,
            components,
            rows,
        })
    }

    fn vectors(self) -> Result<NodeVectors, MeshFileFault> {
        if self.components != 3 {
            let expected = format!("3 components of `{}`", self.name);
            return Err(MeshFileFault::at(
                self.place,
                expected,
                self.components.to_string(),
            ));
        }
        let mut vectors = NodeVectors::default();
        for (place, number, values) in &self.rows {
            vectors.add(*place, *number, Vec3::from_row_slice(values))?;
        }
        Ok(vectors)
    }
}

/// A line with a whole number.
fn whole(input: &mut Input<'_>, what: &str) -> Result<usize, MeshFileFault> {
    input.text_row(what)?;
    input.word(what)
}
