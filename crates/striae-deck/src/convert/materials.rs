//! Materials and the sections of bodies that are of them.

use super::Model;
use super::bodies::Body;
use crate::{
    lower::cards,
    write::{
        law,
        value::{list, number, text},
    },
};
use std::collections::BTreeMap;
use striae_mesh::ElementId;
use striae_meshfile::Keyword;

/// Numbers that are told of elements with several sections.
const TOLD: usize = 5;

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
        let names: Vec<&str> = cards.iter().map(|card| card.name.as_str()).collect();
        for at in 0..self.bodies.len() {
            let made = self.sections(at, &names);
            self.bodies[at].material = made;
        }
        let sections = self.keywords.iter();
        let sections = sections.filter(|keyword| keyword.name == "SOLID SECTION");
        let lines: Vec<usize> = sections.map(|keyword| keyword.line).collect();
        self.used.extend(lines);
    }

    /// The key `material` or `sections` of a body by place; of several sections of an element the
    /// last one is its own.
    fn sections(&mut self, at: usize, names: &[&str]) -> String {
        let body = &self.bodies[at];
        let spelled = |material: &str| {
            let mut known = names.iter();
            let known = known.find(|name| name.eq_ignore_ascii_case(material));
            text(known.map_or(material, |name| *name))
        };
        let all = body.reading.sections.iter();
        let all: Vec<(String, String)> = all
            .map(|section| (section.set.clone(), spelled(&section.material)))
            .collect();
        if all.is_empty() {
            let line = self.keywords.first().map_or(1, |keyword| keyword.line);
            let what = format!("body `{}` has no *SOLID SECTION", body.name);
            self.list(line, what);
            return String::new();
        }
        let own = self.own_elements(at, &all);
        let covered: usize = own.iter().map(Vec::len).sum();
        let is_whole = covered == self.bodies[at].reading.mesh.element_count();
        let left = all.iter().zip(own).filter(|(_, own)| !own.is_empty());
        let left: Vec<_> = left.collect();
        let mut materials = left.iter().map(|((_, material), _)| material);
        if let Some(first) = materials.next().filter(|_| is_whole)
            && materials.all(|material| material == first)
        {
            return format!("material = {first}\n");
        }
        let body = &mut self.bodies[at];
        let tables = left.into_iter().map(|((set, material), own)| {
            let whole = body.reading.mesh.element_sets.get(set);
            let set = match whole.is_some_and(|whole| whole.len() == own.len()) {
                true => set.clone(),
                false => body.set_of_elements(format!("rest of {set}"), own),
            };
            format!("{{ elements = {}, material = {material} }}", text(&set))
        });
        format!("sections = {}\n", list(tables.collect::<Vec<_>>()))
    }

    /// Elements of each section of a body that are of no later one; lists those that are.
    fn own_elements(&mut self, at: usize, sections: &[(String, String)]) -> Vec<Vec<ElementId>> {
        let body = &self.bodies[at];
        let mut last: BTreeMap<ElementId, usize> = BTreeMap::new();
        // Elements by the section that they had and the one that they have.
        let mut changed: BTreeMap<(usize, usize), Vec<String>> = BTreeMap::new();
        let mut own = vec![Vec::new(); sections.len()];
        for (of, (set, _)) in sections.iter().enumerate() {
            for element in body.reading.mesh.element_sets.get(set).unwrap_or_default() {
                if let Some(before) = last.insert(*element, of) {
                    let number = body.reading.numbers.element(*element);
                    let of_both = changed.entry((before, of)).or_default();
                    if of_both.last() != Some(&number) {
                        of_both.push(number);
                    }
                }
            }
        }
        for (element, of) in last {
            own[of].push(element);
        }
        for ((before, of), numbers) in changed {
            let (before, set) = (&sections[before].0, &sections[of].0);
            let what = format!(
                "*SOLID SECTION of `{set}` holds for {}, not that of `{before}` which is stated before",
                elements_text(&numbers)
            );
            self.list(self.line_of_section(at, set), what);
        }
        own
    }

    /// Line of the last section of an element set of a body.
    fn line_of_section(&self, at: usize, set: &str) -> usize {
        let body = &self.bodies[at].name;
        let bare = set.strip_prefix(&format!("{body}.")).unwrap_or(set);
        let mut instances = self.instances.iter();
        let instance = instances.find(|instance| instance.name == body);
        let of_body = |keyword: &&Keyword<'_>| {
            let mut own = instance.into_iter().flat_map(|instance| &instance.own);
            instance.is_none() || own.any(|own| own.line == keyword.line)
        };
        let sections = self.keywords.iter().rev().filter(|keyword| {
            keyword.name == "SOLID SECTION"
                && (super::has(keyword, "ELSET", set) || super::has(keyword, "ELSET", bare))
        });
        let found = sections.into_iter().find(of_body);
        found.map_or(1, |keyword| keyword.line)
    }
}

/// Elements in words; the first few of many.
fn elements_text(numbers: &[String]) -> String {
    match numbers {
        [only] => format!("element {only}"),
        all if all.len() <= TOLD => format!("elements {}", all.join(", ")),
        all => {
            let more = all.len() - TOLD;
            format!("elements {} and {more} more", all[..TOLD].join(", "))
        }
    }
}
