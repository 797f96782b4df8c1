//! Vectors at nodes, from the sections `$NodeData` of both versions.
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

use super::super::lines::Lines;
use super::super::{MeshFileFault, NodeVectors};
use super::{quoted_name, read_format, skip};
use striae_mesh::Vec3;

/// The vectors called `name`; without a name, the only node data of the file.
pub(crate) fn node_data(text: &str, name: Option<&str>) -> Result<NodeVectors, MeshFileFault> {
    let mut all = sections(text)?;
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
    /// Line of the number of components.
    line: usize,
    components: usize,
    /// Line, number of the node and values.
    rows: Vec<(usize, u64, Vec<f64>)>,
}

fn sections(text: &str) -> Result<Vec<Section>, MeshFileFault> {
    let mut lines = Lines::new(text);
    let mut sections = Vec::new();
    while let Some(line) = lines.next() {
        let Some(name) = line.text.strip_prefix('$') else {
            return Err(line.fault("a section such as $MeshFormat"));
        };
        match name {
            "MeshFormat" => {
                read_format(&mut lines)?;
                lines.exactly("$EndMeshFormat")?;
            }
            "NodeData" => {
                sections.push(Section::read(&mut lines)?);
                lines.exactly("$EndNodeData")?;
            }
            _ => skip(&mut lines, name)?,
        }
    }
    Ok(sections)
}

impl Section {
    fn read(lines: &mut Lines<'_>) -> Result<Self, MeshFileFault> {
        let mut texts = Vec::new();
        for _ in 0..whole(lines, "the number of texts")? {
            texts.push(quoted_name(lines.expect("a text")?)?);
        }
        for _ in 0..whole(lines, "the number of reals")? {
            lines.words("a real")?.next::<f64>("a real")?;
        }
        let integers = whole(lines, "the number of integers")?;
        if integers < 3 {
            let found = format!("{integers} integers");
            let expected = "time step, components and number of nodes";
            return Err(MeshFileFault::line(lines.last(), expected, found));
        }
        whole(lines, "the time step")?;
        let components = whole(lines, "the number of components")?;
        let line = lines.last();
        let count = whole(lines, "the number of nodes")?;
        for _ in 3..integers {
            whole(lines, "an integer")?;
        }
        let mut rows = Vec::new();
        for _ in 0..count {
            let mut words = lines.words("a node number and its values")?;
            let number = words.next("a node number")?;
            rows.push((words.line(), number, words.several(components, "a value")?));
        }
        Ok(Self {
            name: texts.into_iter().next().unwrap_or_default(),
            line,
            components,
            rows,
        })
    }

    fn vectors(self) -> Result<NodeVectors, MeshFileFault> {
        if self.components != 3 {
            let expected = format!("3 components of `{}`", self.name);
            return Err(MeshFileFault::line(
                self.line,
                expected,
                self.components.to_string(),
            ));
        }
        let mut vectors = NodeVectors::default();
        for (line, number, values) in &self.rows {
            vectors.add(*line, *number, Vec3::from_row_slice(values))?;
        }
        Ok(vectors)
    }
}

/// A line with a whole number.
fn whole(lines: &mut Lines<'_>, what: &str) -> Result<usize, MeshFileFault> {
    lines.words(what)?.next(what)
}
