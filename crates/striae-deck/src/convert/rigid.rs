//! Rigid bodies: discrete and analytical surfaces, solids made rigid, and nodes tied to a point.

use super::Model;
use super::bodies::Body;
use super::points::Point;
use crate::write::value::{list, text, vector};
use std::collections::BTreeSet;
use striae_mesh::Vec3;
use striae_meshfile::Keyword;

/// A rigid body of the deck.
pub(super) struct Rigid {
    pub(super) name: String,
    /// Line of its keyword.
    line: usize,
    pub(super) shape: Shape,
    /// The node that its conditions name.
    pub(super) reference: Option<Point>,
    /// The node whose displacements are its rotations, as CalculiX has it.
    turning: Option<Point>,
    /// The instance whose surfaces it has.
    instance: Option<String>,
    /// Surfaces that are on it, in capitals.
    pub(super) surfaces: BTreeSet<String>,
    /// Components with a condition so far.
    pub(super) held: [bool; 6],
    /// Targets so far; angles in radians.
    pub(super) targets: [f64; 6],
}

pub(super) enum Shape {
    /// Elements of the file, all of them where there is no name.
    Mesh(Option<String>),
    /// Facets of an analytical surface.
    Facets(Vec<Vec3>, Vec<[usize; 4]>),
    Plane {
        point: Vec3,
        normal: Vec3,
    },
    /// Bodies by place, with their node sets.
    Tied(Vec<(usize, String)>),
}

impl Rigid {
    pub(super) fn new(line: usize, name: String, shape: Shape, reference: Option<Point>) -> Self {
        Self {
            name,
            line,
            shape,
            reference,
            turning: None,
            instance: None,
            surfaces: BTreeSet::new(),
            held: [false; 6],
            targets: [0.0; 6],
        }
    }

    /// Its table in the deck.
    pub(super) fn table(&self, written: &str, bodies: &[Body]) -> String {
        let shape = match &self.shape {
            Shape::Mesh(part) => {
                let part = part.as_ref();
                let part =
                    part.map_or(String::new(), |part| format!(", elements = {}", text(part)));
                format!("mesh = {{ file = {}{part} }}", text(written))
            }
            Shape::Facets(positions, facets) => {
                let positions = positions.iter().map(|x| format!("\n    {},", vector(x)));
                let facets = facets.iter().map(|of| list(of.map(|at| at.to_string())));
                let facets = facets.map(|of| format!("\n    {of},"));
                let (positions, facets) =
                    (positions.collect::<String>(), facets.collect::<String>());
                format!("mesh = {{ positions = [{positions}\n], facets = [{facets}\n] }}")
            }
            Shape::Plane { point, normal } => {
                let (point, normal) = (vector(point), vector(normal));
                format!("plane = {{ point = {point}, normal = {normal} }}")
            }
            Shape::Tied(sets) => {
                let sets = sets.iter().map(|(body, set)| {
                    let body = text(&bodies[*body].name);
                    format!("{{ body = {body}, nodes = {} }}", text(set))
                });
                format!("tied = {}", list(sets))
            }
        };
        let reference = self
            .reference
            .map(|(_, x)| format!("reference = {}\n", vector(&x)));
        format!(
            "\n[[rigid]]\nname = {}\n{shape}\n{}",
            text(&self.name),
            reference.unwrap_or_default()
        )
    }
}

impl<'a> Model<'a> {
    /// Reads rigid bodies and couplings.
    pub(super) fn read_rigid(&mut self) {
        let keywords = self.keywords;
        for keyword in keywords {
            match keyword.name.as_str() {
                "RIGID BODY" => self.rigid_body(keyword),
                "COUPLING" => self.coupling(keyword),
                "KINEMATIC COUPLING" => self.kinematic_coupling(keyword),
                "MPC" => self.multi_point(keyword),
                _ => {}
            }
        }
        self.leave_out_held_twice();
        for at in 0..self.instances.len() {
            let instance = &self.instances[at];
            let mut known = self.rigid.iter();
            let is_known = known.any(|rigid| rigid.instance.as_deref() == Some(instance.name));
            if instance.is_rigid() && !is_known {
                let (line, name) = (instance.keyword.line, instance.name.to_owned());
                self.list(
                    line,
                    format!("instance `{name}` of rigid elements without *RIGID BODY"),
                );
            }
        }
    }

    /// Leaves out a coupling whose nodes have conditions while its point has none: it would hold
    /// the nodes twice.
    fn leave_out_held_twice(&mut self) {
        let keywords = self.keywords;
        let conditions = keywords
            .iter()
            .filter(|keyword| ["BOUNDARY", "CLOAD"].contains(&keyword.name.as_str()));
        let rows = conditions.flat_map(|keyword| &keyword.rows);
        let words: BTreeSet<&str> = rows.map(|row| row.words[0]).collect();
        let moved: BTreeSet<usize> = words
            .iter()
            .filter_map(|word| self.rigid_of_point(word))
            .collect();
        let mut held: Vec<(usize, String)> = Vec::new();
        for word in words {
            if self.rigid_of_point(word).is_none() {
                held.extend(self.nodes(word));
            }
        }
        let bodies = &self.bodies;
        let nodes = |(body, set): &(usize, String)| {
            let sets = &bodies[*body].reading.mesh.node_sets;
            sets.get(set).unwrap_or_default().to_vec()
        };
        let meets = |tied: &(usize, String)| {
            let own = nodes(tied);
            let others = held.iter().filter(|(body, _)| *body == tied.0);
            others.flat_map(nodes).any(|node| own.contains(&node))
        };
        let (mut kept, mut left_out) = (Vec::new(), Vec::new());
        for (at, rigid) in std::mem::take(&mut self.rigid).into_iter().enumerate() {
            match &rigid.shape {
                Shape::Tied(sets) if !moved.contains(&at) && sets.iter().any(meets) => {
                    left_out.push(rigid);
                }
                _ => kept.push(rigid),
            }
        }
        self.rigid = kept;
        for Rigid { line, name, .. } in left_out {
            let what = "its nodes have their own conditions and its point has none; left out";
            self.list(line, format!("`{name}`: {what}"));
        }
    }

    /// The rigid body that a surface is on.
    pub(super) fn rigid_of_surface(&self, word: &str) -> Option<usize> {
        let upper = word.to_uppercase();
        self.rigid.iter().position(|rigid| {
            let instance = rigid.instance.as_ref().map(|name| name.to_uppercase());
            let is_within = instance.is_some_and(|name| upper.starts_with(&format!("{name}.")));
            is_within || rigid.surfaces.contains(&upper)
        })
    }

    /// The rigid body whose reference point a word stands for.
    pub(super) fn rigid_of_point(&self, word: &str) -> Option<usize> {
        let (id, _) = self.points.find(word)?;
        let mut all = self.rigid.iter();
        all.position(|rigid| rigid.reference.is_some_and(|(own, _)| own == id))
    }

    /// The rigid body whose rotations are the displacements of a point that a word stands for.
    pub(super) fn rigid_of_turning_point(&self, word: &str) -> Option<usize> {
        let (id, _) = self.points.find(word)?;
        let mut all = self.rigid.iter();
        all.position(|rigid| rigid.turning.is_some_and(|(own, _)| own == id))
    }

    fn rigid_body(&mut self, keyword: &'a Keyword<'a>) {
        self.used.insert(keyword.line);
        let known = [
            "REF NODE",
            "ELSET",
            "ANALYTICAL SURFACE",
            "TIE NSET",
            "PIN NSET",
            "POSITION",
            "NSET",
            "ROT NODE",
        ];
        self.list_parameters(keyword, &known);
        if let Some(surface) = keyword.parameter("ANALYTICAL SURFACE") {
            // Each instance of a part has what the part states.
            let owners = self.owners(keyword);
            match owners.is_empty() {
                true => self.analytical_body(keyword, surface, None),
                false => owners
                    .into_iter()
                    .for_each(|owner| self.analytical_body(keyword, surface, Some(owner))),
            }
            return;
        }
        if let Some(set) = keyword.parameter("ELSET") {
            return self.rigid_elements(keyword, set);
        }
        let reference = keyword
            .parameter("REF NODE")
            .and_then(|word| self.point(keyword, word));
        let name = self.rigid_name("rigid");
        let sets = ["TIE NSET", "PIN NSET", "NSET"].into_iter();
        let sets: Vec<&str> = sets.filter_map(|key| keyword.parameter(key)).collect();
        let tied: Vec<(usize, String)> = sets.iter().flat_map(|set| self.nodes(set)).collect();
        match tied.is_empty() {
            true => self.list(keyword.line, "*RIGID BODY without nodes of a body"),
            false => {
                let mut rigid = Rigid::new(keyword.line, name, Shape::Tied(tied), reference);
                let turning = keyword.parameter("ROT NODE");
                rigid.turning = turning.and_then(|word| self.point(keyword, word));
                self.rigid.push(rigid);
            }
        }
    }

    /// Makes a rigid body of a set of rigid elements, or of a whole body of solids.
    fn rigid_elements(&mut self, keyword: &'a Keyword<'a>, set: &str) {
        let reference = keyword
            .parameter("REF NODE")
            .and_then(|word| self.point(keyword, word));
        if let Some(at) = self.rigid_instance(keyword, set) {
            let instance = self.instances[at].name.to_owned();
            let several = self.instances.len() > 1;
            let shape = Shape::Mesh(several.then(|| instance.clone()));
            let mut rigid = Rigid::new(keyword.line, instance.clone(), shape, reference);
            rigid.surfaces = self.surfaces_of(&instance);
            rigid.instance = Some(instance);
            self.rigid.push(rigid);
            return;
        }
        let bodies = self.bodies.iter().enumerate();
        let whole = bodies.filter(|(_, body)| {
            let sets = body.reading.mesh.element_sets.iter();
            let mut sets = sets.filter(|(_, of)| of.len() == body.reading.mesh.element_count());
            let bare = set.rsplit('.').next().unwrap_or(set);
            sets.any(|(name, _)| name.eq_ignore_ascii_case(set) || name.eq_ignore_ascii_case(bare))
        });
        let tied: Vec<(usize, String)> = whole.map(|(at, _)| (at, "all".to_owned())).collect();
        match (self.instances.is_empty(), tied.is_empty()) {
            (_, false) => {
                let name = self.rigid_name("rigid");
                let shape = Shape::Tied(tied);
                self.rigid
                    .push(Rigid::new(keyword.line, name, shape, reference));
            }
            (true, true) => {
                let shape = Shape::Mesh(Some(set.to_owned()));
                let mut rigid = Rigid::new(keyword.line, set.to_owned(), shape, reference);
                rigid.surfaces = self.surfaces_of_set(set);
                self.rigid.push(rigid);
            }
            (false, true) => {
                let what = format!("*RIGID BODY of `{set}`, which is not a whole body");
                self.list(keyword.line, what);
            }
        }
    }

    pub(super) fn point(&mut self, keyword: &Keyword<'_>, word: &str) -> Option<Point> {
        let owner = self.owners(keyword).first().copied();
        self.point_of(keyword, word, owner)
    }

    /// The point that a word of a keyword stands for, in an instance by place or outside of all.
    pub(super) fn point_of(
        &mut self,
        keyword: &Keyword<'_>,
        word: &str,
        owner: Option<usize>,
    ) -> Option<Point> {
        let within = owner.map(|at| format!("{}.{word}", self.instances[at].name));
        let found = within.and_then(|word| self.points.find(&word));
        let found = found.or_else(|| self.points.find(word));
        if found.is_none() {
            self.list(
                keyword.line,
                format!("reference node `{word}` is not known"),
            );
        }
        found
    }

    /// Instances by place in which a keyword stands, itself or by their part.
    pub(super) fn owners(&self, keyword: &Keyword<'_>) -> Vec<usize> {
        let all = self.instances.iter().enumerate();
        let owning = all.filter(|(_, instance)| {
            let mut own = instance.own.iter();
            own.any(|own| own.line == keyword.line)
        });
        owning.map(|(at, _)| at).collect()
    }

    pub(super) fn rigid_name(&self, base: &str) -> String {
        let names = (1..).map(|count| match count {
            1 => base.to_owned(),
            _ => format!("{base}-{count}"),
        });
        let bodies = self.bodies.iter().map(|body| &body.name);
        let taken: Vec<&String> = bodies
            .chain(self.rigid.iter().map(|rigid| &rigid.name))
            .collect();
        let is_free = |name: &String| !taken.contains(&name);
        names
            .into_iter()
            .find(is_free)
            .expect("there are more numbers than bodies")
    }

    /// The instance of rigid elements that an element set is of.
    fn rigid_instance(&self, keyword: &Keyword<'_>, set: &str) -> Option<usize> {
        let of_set = self.instance_of_set(set);
        let owners = self.owners(keyword);
        let mut instances = self.instances.iter().enumerate();
        let found = instances.find(|(at, instance)| {
            let prefix = set.rsplit_once('.').map_or("", |(prefix, _)| prefix);
            let named = prefix.eq_ignore_ascii_case(instance.name)
                || of_set.is_some_and(|name| name.eq_ignore_ascii_case(instance.name));
            instance.is_rigid() && (owners.contains(at) || named)
        });
        found.map(|(at, _)| at)
    }

    /// The instance that a set of the assembly is of.
    fn instance_of_set(&self, set: &str) -> Option<&'a str> {
        let mut sets = self.keywords.iter();
        let found = sets.find(|keyword| {
            keyword.name == "ELSET"
                && keyword.parameter("INSTANCE").is_some()
                && super::has(keyword, "ELSET", set)
        });
        found.and_then(|keyword| keyword.parameter("INSTANCE"))
    }

    /// Surfaces of the assembly whose element sets are of an instance.
    fn surfaces_of(&self, instance: &str) -> BTreeSet<String> {
        let all = self
            .keywords
            .iter()
            .filter(|keyword| keyword.name == "SURFACE");
        let of_instance = all.filter(|keyword| {
            keyword.rows.iter().any(|row| {
                let word = row.words[0];
                let prefix = word.rsplit_once('.').map_or("", |(prefix, _)| prefix);
                let set = self.instance_of_set(word);
                prefix.eq_ignore_ascii_case(instance)
                    || set.is_some_and(|of| of.eq_ignore_ascii_case(instance))
            })
        });
        of_instance
            .filter_map(|keyword| Some(keyword.parameter("NAME")?.to_uppercase()))
            .collect()
    }

    /// Surfaces of an element set.
    fn surfaces_of_set(&self, set: &str) -> BTreeSet<String> {
        let all = self
            .keywords
            .iter()
            .filter(|keyword| keyword.name == "SURFACE");
        let of_set = all.filter(|keyword| {
            let mut rows = keyword.rows.iter();
            rows.any(|row| row.words[0].eq_ignore_ascii_case(set))
        });
        of_set
            .filter_map(|keyword| Some(keyword.parameter("NAME")?.to_uppercase()))
            .collect()
    }
}
