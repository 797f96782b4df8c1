//! Materials and the sections of bodies that are of them.

use super::Model;
use super::bodies::Body;
use crate::lower::cards;
use crate::write::{
    law,
    value::{list, number, text},
};

impl Model<'_> {
    /// Reads materials, and what elements are of them.
    pub(super) fn read_materials(&mut self) {
        let Some(first) = self.bodies.first() else {
            return;
        };
        let cards = first.reading.materials.clone();
        for card in &cards {
            let keywords = self.keywords;
            let at = keywords.iter().position(|keyword| {
                keyword.name == "MATERIAL" && super::has(keyword, "NAME", &card.name)
            });
            let of_body = |body: &Body| {
                let mut sections = body.reading.sections.iter();
                sections.any(|section| section.material.eq_ignore_ascii_case(&card.name))
            };
            let is_used = self.bodies.iter().any(of_body);
            let made = card.card.as_ref().map_err(Clone::clone).and_then(|card| {
                let made = cards::material(card)?;
                let lines =
                    law::material(&made).ok_or("without a counterpart among the laws of decks")?;
                Ok((lines, card.density))
            });
            let line = at.map_or(0, |at| keywords[at].line);
            match made {
                Ok((lines, density)) => {
                    let density = density.map(|density| format!("density = {}\n", number(density)));
                    self.materials += &format!(
                        "\n[[material]]\nname = {}\n{}{lines}",
                        text(&card.name),
                        density.unwrap_or_default()
                    );
                    self.used
                        .extend(striae_meshfile::material_lines(keywords, line));
                }
                Err(cause) if is_used => {
                    let what = format!("*MATERIAL `{}`: {cause}", card.name);
                    self.list(line, what + "; the deck needs a material of this name");
                }
                Err(cause) => self.list(line, format!("*MATERIAL `{}`: {cause}", card.name)),
            }
        }
        for at in 0..self.bodies.len() {
            let body = &self.bodies[at];
            let elements = body.reading.mesh.element_count();
            let spelled = |material: &str| {
                let mut known = cards.iter();
                let known = known.find(|card| card.name.eq_ignore_ascii_case(material));
                text(known.map_or(material, |card| &card.name))
            };
            let sections = &body.reading.sections;
            let covers = |set: &str| {
                let members = body.reading.mesh.element_sets.get(set);
                members.is_some_and(|members| members.len() == elements)
            };
            let made = match &sections[..] {
                [only] if covers(&only.set) => {
                    format!("material = {}\n", spelled(&only.material))
                }
                [] => {
                    let line = self.keywords.first().map_or(1, |keyword| keyword.line);
                    let what = format!("body `{}` has no *SOLID SECTION", body.name);
                    self.listed.entry(line).or_default().push(what);
                    String::new()
                }
                all => {
                    let section = all.iter().map(|section| {
                        format!(
                            "{{ elements = {}, material = {} }}",
                            text(&section.set),
                            spelled(&section.material)
                        )
                    });
                    format!("sections = {}\n", list(section))
                }
            };
            self.bodies[at].material = made;
        }
        let sections = self.keywords.iter();
        let sections = sections.filter(|keyword| keyword.name == "SOLID SECTION");
        let lines: Vec<usize> = sections.map(|keyword| keyword.line).collect();
        self.used.extend(lines);
    }
}
