//! General contact: of everything, or between surfaces that have names.

use super::Model;
use super::friction::Interaction;
use crate::write::value::{list, text};
use striae_meshfile::{Keyword, Row};

impl<'a> Model<'a> {
    /// Reads `*CONTACT INCLUSIONS`.
    pub(super) fn inclusions(&mut self, keyword: &'a Keyword<'a>) {
        self.used.insert(keyword.line);
        self.list_parameters(keyword, &["ALL EXTERIOR"]);
        let is_of_all = keyword.parameter("ALL EXTERIOR").is_some() || keyword.rows.is_empty();
        if is_of_all && !self.contact.contains("\n[contact]\n") {
            let interaction = self.assigned(["", ""], keyword.line);
            if interaction.is_anisotropic {
                let what = "*CONTACT INCLUSIONS with anisotropic friction: state textures in `[[contact.surface]]`";
                self.list(keyword.line, what);
            }
            self.contact += &format!("\n[contact]\nall = true\n{}", interaction.line());
            let more = self.exclusions() + &self.between();
            self.contact += &more;
        }
        for row in &keyword.rows {
            let word = |at: usize| row.words.get(at).copied().unwrap_or_default();
            if word(0).is_empty() {
                let what = format!(
                    "*CONTACT INCLUSIONS `{}`: name two surfaces, or use ALL EXTERIOR",
                    row.words.join(", ")
                );
                self.list(row.line, what);
                continue;
            }
            let sides = [word(0), word(1)];
            let interaction = self.assigned(sides, keyword.line);
            // What stands behind two names is no orientation here.
            let row = row.shortened(2);
            match interaction.is_tied {
                true => self.list(row.line, "tied general contact; state a `[[tie]]`"),
                false => self.pair(&row, &interaction, ""),
            }
        }
        if !is_of_all {
            let rows = self.rows("CONTACT EXCLUSIONS");
            for row in rows {
                let what = format!(
                    "*CONTACT EXCLUSIONS `{}` beside surfaces with names: leave its facets out of these",
                    row.words.join(", ")
                );
                self.list(row.line, what);
            }
        }
    }

    /// Rows of all keywords of a name.
    fn rows(&self, name: &str) -> Vec<Row<'a>> {
        let keywords = self.keywords.iter();
        let named = keywords.filter(|keyword| keyword.name == name);
        named.flat_map(|keyword| keyword.rows.clone()).collect()
    }

    /// The key `exclude`.
    fn exclusions(&mut self) -> String {
        let mut all = Vec::new();
        for row in self.rows("CONTACT EXCLUSIONS") {
            let word = |at: usize| row.words.get(at).copied().unwrap_or_default();
            let (first, second) = (word(0), word(1));
            let (a, b) = match (first.is_empty(), second.is_empty()) {
                (true, false) => (second, None),
                (false, true) => (first, Some(first)),
                _ => (first, Some(second)),
            };
            let labels = (self.label(a), b.map(|b| self.label(b)).transpose());
            match labels {
                (Ok(a), Ok(b)) => {
                    let b = b.map_or(String::new(), |b| format!(", b = {}", text(&b)));
                    all.push(format!("{{ a = {}{b} }}", text(&a)));
                }
                (Err(what), _) | (_, Err(what)) => {
                    let words = row.words.join(", ");
                    self.list(row.line, format!("*CONTACT EXCLUSIONS `{words}`: {what}"));
                }
            }
        }
        let keywords = self.keywords.iter();
        let lines: Vec<usize> = keywords
            .filter(|keyword| keyword.name == "CONTACT EXCLUSIONS")
            .map(|keyword| keyword.line)
            .collect();
        self.used.extend(lines);
        match all.is_empty() {
            true => String::new(),
            false => format!("exclude = {}\n", list(all)),
        }
    }

    /// Tables of the interactions of surfaces with names beside contact of everything.
    fn between(&mut self) -> String {
        let mut tables = String::new();
        for row in self.rows("CONTACT PROPERTY ASSIGNMENT") {
            let word = |at: usize| row.words.get(at).copied().unwrap_or_default();
            let (a, b) = (word(0), word(1));
            if a.is_empty() && b.is_empty() {
                continue;
            }
            let words = row.words.join(", ");
            // A surface alone is one that touches itself.
            let b = if b.is_empty() { a } else { b };
            if a.is_empty() {
                let what = format!(
                    "*CONTACT PROPERTY ASSIGNMENT `{words}`: name two surfaces in `[[contact.between]]`"
                );
                self.list(row.line, what);
                continue;
            }
            let interaction = self.interaction(Some(word(2)), row.line);
            if interaction.is_anisotropic {
                let what = format!(
                    "*CONTACT PROPERTY ASSIGNMENT `{words}` with anisotropic friction: state the texture of a surface in `[[contact.surface]]`"
                );
                self.list(row.line, what);
            }
            match (self.label(a), self.label(b)) {
                (Ok(a), Ok(b)) => {
                    let friction = interaction.friction.as_deref();
                    let friction = friction.unwrap_or("law = \"frictionless\"");
                    tables += &format!(
                        "[[contact.between]]\na = {}\nb = {}\nfriction = {{ {friction} }}\n",
                        text(&a),
                        text(&b)
                    );
                }
                (Err(what), _) | (_, Err(what)) => {
                    let what = format!("*CONTACT PROPERTY ASSIGNMENT `{words}`: {what}");
                    self.list(row.line, what);
                }
            }
        }
        tables
    }

    /// The label of a surface, such as `body.facets`.
    fn label(&mut self, word: &str) -> Result<String, String> {
        if let Some(at) = self.rigid_of_surface(word) {
            return Ok(self.rigid[at].name.clone());
        }
        match &self.facets(word)[..] {
            [(body, facets)] => Ok(format!("{}.{facets}", self.bodies[*body].name)),
            [] => Err(self.missing_facets(word)),
            _ => Err(format!("surface `{word}` is on several bodies")),
        }
    }

    /// The interaction that general contact assigns to two surfaces.
    fn assigned(&mut self, sides: [&str; 2], line: usize) -> Interaction {
        let keywords = self.keywords.iter();
        let keywords = keywords.filter(|keyword| keyword.name == "CONTACT PROPERTY ASSIGNMENT");
        let mut found = (None, line);
        for keyword in keywords {
            self.used.insert(keyword.line);
            for row in &keyword.rows {
                let [a, b, property] =
                    [0, 1, 2].map(|at| row.words.get(at).copied().unwrap_or_default());
                let same = |a: &str, b: &str| {
                    a.eq_ignore_ascii_case(sides[0]) && b.eq_ignore_ascii_case(sides[1])
                };
                if a.is_empty() && b.is_empty() || same(a, b) || same(b, a) {
                    found = (Some(property), keyword.line);
                }
            }
        }
        self.interaction(found.0, found.1)
    }
}
