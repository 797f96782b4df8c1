//! Springs and dashpots: to ground along a coordinate, and along the line between two nodes.
//!
//! | in Abaqus | in the deck |
//! | --- | --- |
//! | `SPRING1`, `DASHPOT1` | a spring of the nodes with `direction` |
//! | `SPRINGA`, `DASHPOTA` | a spring with an end `b` for each element |
//! | `SPRING2`, `DASHPOT2` | listed: decks have none along a direction between two nodes |
//!
//! Source: Abaqus keywords reference guide, `*SPRING` and `*DASHPOT`.

use super::{Model, has, numbers};
use crate::write::value::{number, text, vector};
use std::collections::BTreeMap;
use striae_mesh::{NodeId, Vec3};
use striae_meshfile::Keyword;

/// An end of a spring.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum End {
    /// A body by place.
    Node(usize, NodeId),
    /// A rigid body by place.
    Rigid(usize),
}

/// Springs of one keyword.
struct Springs<'a> {
    name: &'a str,
    /// The last key of their tables with its value.
    value: String,
    /// Direction in which they act against ground.
    direction: Option<Vec3>,
}

impl<'a> Model<'a> {
    /// Reads springs and dashpots.
    pub(super) fn read_springs(&mut self) {
        for keyword in self.keywords {
            if ["SPRING", "DASHPOT"].contains(&keyword.name.as_str())
                && let Err(what) = self.springs(keyword)
            {
                self.list(keyword.line, format!("*{}{what}", keyword.name));
            }
        }
    }

    /// Makes springs of a keyword whose elements are known; the error says why there are none.
    fn springs(&mut self, keyword: &'a Keyword<'a>) -> Result<(), String> {
        let name = keyword.parameter("ELSET").unwrap_or_default();
        let owners = self.owners(keyword);
        let elements = self.keywords.iter().filter(|of| {
            of.name == "ELEMENT" && has(of, "ELSET", name) && self.owners(of) == owners
        });
        let elements: Vec<&Keyword<'_>> = elements.collect();
        let kinds = elements.iter().filter_map(|of| of.parameter("TYPE"));
        let mut ends = kinds.filter_map(|kind| {
            let kind = kind.to_uppercase();
            kind.strip_prefix(keyword.name.as_str()).map(str::to_owned)
        });
        let advice = super::remedy::remedy(&keyword.name);
        let Some(kind) = ends
            .next()
            .filter(|first| ends.all(|other| other == *first))
        else {
            // What its elements are is not known.
            return Err(advice.to_owned());
        };
        let others = keyword.parameters().map(|(key, _)| key);
        let others: Vec<&str> = others.filter(|key| *key != "ELSET").collect();
        if !others.is_empty() {
            return Err(format!(" with {}{advice}", others.join(", ")));
        }
        let springs = stated(keyword, name, &kind)?;
        self.used.insert(keyword.line);
        let owners = match owners.is_empty() {
            true => vec![None],
            false => owners.into_iter().map(Some).collect(),
        };
        for element in elements {
            self.used.insert(element.line);
            for owner in &owners {
                self.springs_of(element, *owner, &springs);
            }
        }
        Ok(())
    }

    /// Makes springs of the elements of a keyword, in an instance by place or outside of all.
    fn springs_of(&mut self, element: &Keyword<'_>, owner: Option<usize>, springs: &Springs<'_>) {
        let mut grounded: BTreeMap<Option<usize>, Vec<End>> = BTreeMap::new();
        for row in element.joined_rows(usize::MAX) {
            let words = row.words.get(1..).unwrap_or_default();
            let words = words.iter().filter(|word| !word.is_empty());
            let ends: Result<Vec<End>, String> = words.map(|word| self.end(word, owner)).collect();
            let made = ends.and_then(|ends| match (ends[..].as_ref(), springs.direction) {
                ([end], Some(_)) => {
                    let body = match end {
                        End::Node(body, _) => Some(*body),
                        End::Rigid(_) => None,
                    };
                    grounded.entry(body).or_default().push(*end);
                    Ok(())
                }
                ([a, b], None) if self.place(*a) == self.place(*b) => Err(
                    "both ends are at one place; state a `[[spring]]` with a `direction`".into(),
                ),
                ([a, b], None) => {
                    let [a, b] = [*a, *b].map(|end| self.end_table(springs.name, &[end]));
                    self.spring_table(springs, &a, &format!("b = {b}"));
                    Ok(())
                }
                _ => Err(format!("{} nodes", ends.len())),
            });
            if let Err(what) = made {
                let what = format!("spring element {}: {what}", row.words[0]);
                self.list(row.line, what);
            }
        }
        let Some(direction) = springs.direction else {
            return;
        };
        let line = format!("direction = {}", vector(&direction));
        for (body, ends) in grounded {
            for ends in distinct(ends, body.is_none()) {
                let end = self.end_table(springs.name, &ends);
                self.spring_table(springs, &end, &line);
            }
        }
    }

    /// The end that the word of a node stands for.
    fn end(&self, word: &str, owner: Option<usize>) -> Result<End, String> {
        let within = owner.map(|at| format!("{}.{word}", self.instances[at].name));
        let word = within.as_deref().unwrap_or(word);
        if let Some(at) = self.rigid_of_point(word) {
            return Ok(End::Rigid(at));
        }
        let mut bodies = self.bodies_named(word).into_iter();
        let found = bodies.find_map(|at| Some(End::Node(at, self.bodies[at].node(word)?)));
        found.ok_or_else(|| {
            format!(
                "node `{word}` is of no body and no rigid body; state a `[[spring]]` with an end `fixed`"
            )
        })
    }

    fn place(&self, end: End) -> Option<Vec3> {
        match end {
            End::Node(body, node) => Some(self.bodies[body].reading.mesh.positions[node.index()]),
            End::Rigid(at) => self.rigid[at].reference.map(|(_, x)| x),
        }
    }

    /// Table of ends, which are nodes of one body or a single point.
    fn end_table(&mut self, name: &str, ends: &[End]) -> String {
        let nodes = ends.iter().filter_map(|end| match end {
            End::Node(body, node) => Some((*body, *node)),
            End::Rigid(_) => None,
        });
        let nodes: Vec<(usize, NodeId)> = nodes.collect();
        match (ends, &nodes[..]) {
            ([End::Rigid(at), ..], _) => format!("{{ rigid = {} }}", text(&self.rigid[*at].name)),
            (_, [(body, _), ..]) => {
                let body = &mut self.bodies[*body];
                let nodes: Vec<NodeId> = nodes.iter().map(|(_, node)| *node).collect();
                let set = match nodes[..] {
                    [node] => format!("node {}", body.reading.numbers.node(node)),
                    _ => format!("nodes of {name}"),
                };
                let set = body.set_of_nodes(set, nodes);
                format!("{{ body = {}, nodes = {} }}", text(&body.name), text(&set))
            }
            _ => String::new(),
        }
    }

    fn spring_table(&mut self, springs: &Springs<'_>, a: &str, line: &str) {
        let names = (1..).map(|count| match count {
            1 => text(springs.name),
            _ => text(&format!("{}-{count}", springs.name)),
        });
        let is_free = |name: &String| !self.springs.contains(&format!("\nname = {name}\n"));
        let name = names.into_iter().find(is_free);
        let name = name.expect("there are more numbers than springs");
        self.springs += &format!(
            "\n[[spring]]\nname = {name}\na = {a}\n{line}\n{}\n",
            springs.value
        );
    }
}

/// Groups of ends of which none is there twice; each end alone where they are points of bodies
/// that are rigid.
fn distinct(ends: Vec<End>, is_alone: bool) -> Vec<Vec<End>> {
    let mut groups: Vec<Vec<End>> = Vec::new();
    for end in ends {
        let mut known = groups.iter_mut();
        match known.find(|group| !is_alone && !group.contains(&end)) {
            Some(group) => group.push(end),
            None => groups.push(vec![end]),
        }
    }
    groups
}

/// The numbers of a keyword, for elements of a kind `1`, `2` or `A`.
fn stated<'a>(keyword: &Keyword<'_>, name: &'a str, kind: &str) -> Result<Springs<'a>, String> {
    let rows = keyword.rows.iter().map(|row| numbers(&row.words));
    let rows: Option<Vec<Vec<f64>>> = rows.collect();
    let rows = rows.unwrap_or_default();
    let (direction, values) = match (kind, &rows[..]) {
        ("1", [component, values @ ..]) => {
            let axis = (0..3).find(|axis| component[0] == f64::from(*axis) + 1.0);
            let axis = axis.ok_or(" of rotations; a `[[spring]]` resists displacements")?;
            (Some(Vec3::ith(axis as usize, 1.0)), values)
        }
        ("A", values) => (None, values),
        ("2", _) => {
            let what = format!(
                " of {0}2: a spring between two nodes acts along the line between them; take {0}A, or state a `[[spring]]` with a `direction` against ground",
                keyword.name
            );
            return Err(what);
        }
        _ => return Err(super::remedy::remedy(&keyword.name).to_owned()),
    };
    let value = match values {
        [row] => Some(row[0]).filter(|value| *value >= 0.0),
        _ => None,
    };
    let value = value.ok_or(" other than of one constant of at least 0: state a `[[spring]]`")?;
    let key = match keyword.name.as_str() {
        "SPRING" => "stiffness",
        _ => "damping",
    };
    Ok(Springs {
        name,
        value: format!("{key} = {}", number(value)),
        direction,
    })
}
