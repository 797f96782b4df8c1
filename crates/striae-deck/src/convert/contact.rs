//! Contact pairs and ties.

use super::friction::Interaction;
use super::{Model, has};
use crate::write::value::{number, text};
use std::collections::BTreeSet;
use striae_meshfile::{Keyword, Row};

/// A pair of the deck with the interaction of its surfaces.
pub(super) struct Pair {
    /// Its name as text of the deck.
    pub(super) name: String,
    pub(super) interaction: String,
}

impl<'a> Model<'a> {
    /// Reads pairs and ties, and general contact.
    pub(super) fn read_contact(&mut self) {
        let keywords = self.keywords;
        let mut steps = 0;
        for keyword in keywords {
            match keyword.name.as_str() {
                "STEP" => steps += 1,
                "SURFACE" => self.surface(keyword),
                "SURFACE INTERACTION" => {
                    self.used.insert(keyword.line);
                    self.list_parameters(keyword, &["NAME", "TRACKING THICKNESS"]);
                    if keyword.parameter("NAME").is_none() {
                        self.list(keyword.line, "*SURFACE INTERACTION without a name");
                    }
                }
                "SURFACE BEHAVIOR" => self.behaviour(keyword),
                "CONTACT PAIR" => self.pairs(keyword),
                "TIE" => self.ties(keyword),
                "CONTACT" => {
                    self.used.insert(keyword.line);
                    self.list_parameters(keyword, &["OP"]);
                }
                "CONTACT INCLUSIONS" => self.inclusions(keyword),
                _ => {}
            }
            if steps > 1 && ["CONTACT PAIR", "CONTACT INCLUSIONS"].contains(&keyword.name.as_str())
            {
                let what = format!("*{} of a later step: it acts from the start", keyword.name);
                self.list(keyword.line, what);
            }
        }
        self.list_idle_interactions();
    }

    /// Surfaces stay in the file; those that a mesh does not read are listed unless they are of a
    /// rigid body.
    fn surface(&mut self, keyword: &Keyword<'_>) {
        let kind = keyword.parameter("TYPE").unwrap_or("ELEMENT");
        let kind = kind.to_uppercase();
        if keyword.parameter("CROP").is_some() {
            self.list(keyword.line, "*SURFACE, CROP: name its elements and faces");
        } else if ["ELEMENT", "NODE"].contains(&kind.as_str()) {
            self.used.insert(keyword.line);
            let known = ["NAME", "TYPE", "INTERNAL", "COMBINE", "INSTANCE", "TRIM"];
            self.list_parameters(keyword, &known);
        } else if !self.used.contains(&keyword.line) {
            self.list(keyword.line, format!("*SURFACE, TYPE={kind}"));
        }
    }

    /// Hard contact is what a deck has.
    fn behaviour(&mut self, keyword: &Keyword<'_>) {
        self.used.insert(keyword.line);
        let pressure = keyword.parameter("PRESSURE-OVERCLOSURE").unwrap_or("HARD");
        self.penalty(keyword);
        if !["HARD", "TIED"].contains(&pressure.to_uppercase().as_str()) {
            let what = format!(
                "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE={pressure}: contact is hard, its numbers are left out"
            );
            self.list(keyword.line, what);
        }
        // Penalties approximate what is exact here.
        self.list_parameters(
            keyword,
            &[
                "PRESSURE-OVERCLOSURE",
                "PENALTY",
                "DIRECT",
                "AUGMENTED LAGRANGE",
            ],
        );
    }

    /// Lists the numbers of a penalty: stiffness, clearance without pressure and scale.
    fn penalty(&mut self, keyword: &Keyword<'_>) {
        let mut methods = ["PENALTY", "AUGMENTED LAGRANGE"].into_iter();
        let method = methods.find(|method| keyword.parameter(method).is_some());
        let (Some(method), Some(row)) = (method, keyword.rows.first()) else {
            return;
        };
        let stated = |at: usize, default: &str| {
            let word = row.words.get(at).copied().unwrap_or_default();
            let value = striae_meshfile::finite(word);
            !word.is_empty() && value != striae_meshfile::finite(default)
        };
        if stated(0, "0") || stated(1, "0") || stated(2, "1") {
            let what = format!(
                "*SURFACE BEHAVIOR, {method} of `{}`: contact is exact, without a stiffness and from a gap of 0 on; its numbers are left out",
                row.words.join(", ")
            );
            self.list(keyword.line, what);
        }
    }

    fn pairs(&mut self, keyword: &'a Keyword<'a>) {
        self.used.insert(keyword.line);
        let known = [
            "INTERACTION",
            "TYPE",
            "ADJUST",
            "MECHANICAL CONSTRAINT",
            "CPSET",
            "TRACKING",
            "TIED",
            "SMALL SLIDING",
            "OP",
        ];
        self.list_parameters(keyword, &known);
        if keyword.parameter("SMALL SLIDING").is_some() {
            let what = "*CONTACT PAIR, SMALL SLIDING: surfaces may slide any way";
            self.list(keyword.line, what);
        }
        let interaction = self.interaction(keyword.parameter("INTERACTION"), keyword.line);
        let adjust = keyword.parameter("ADJUST");
        let initial = adjust.map(|adjust| match striae_meshfile::finite(adjust) {
            Some(gap) if gap >= 0.0 => format!("initial = {{ close = {} }}\n", number(gap)),
            _ => "initial = \"close\"\n".to_owned(),
        });
        if let Some(set) = adjust.filter(|adjust| striae_meshfile::finite(adjust).is_none()) {
            let what = format!("*CONTACT PAIR, ADJUST={set}: all of the surfaces is closed");
            self.list(keyword.line, what);
        }
        for row in &keyword.rows {
            match keyword.parameter("TIED").is_some() || interaction.is_tied {
                true => self.tie(row, None),
                false => self.pair(row, &interaction, initial.as_deref().unwrap_or_default()),
            }
        }
    }

    /// A pair of the surfaces of a row.
    pub(super) fn pair(&mut self, row: &Row<'_>, interaction: &Interaction, more: &str) {
        let word = |at: usize| row.words.get(at).copied().unwrap_or_default();
        let (a, b) = (word(0), word(1));
        if b.is_empty() || a.eq_ignore_ascii_case(b) {
            return self.own_pair(row, a, interaction, more);
        }
        let Some([first, second]) = self.sides(row) else {
            return;
        };
        let texture = match interaction.is_anisotropic {
            true => self.slip_directions(row, a, word(2)),
            false => String::new(),
        };
        let first = first.strip_suffix(" }").unwrap_or(&first);
        let name = self.name("pair", &format!("{a} on {b}"));
        self.contact += &format!(
            "\n[[pair]]\nname = {name}\na = {first}{texture} }}\nb = {second}\n{}{more}",
            interaction.line()
        );
        let interaction = interaction.name.clone();
        self.pairs.push(Pair { name, interaction });
    }

    /// A surface that may touch itself.
    fn own_pair(&mut self, row: &Row<'_>, word: &str, interaction: &Interaction, more: &str) {
        match self.side(word) {
            Ok(side) if side.starts_with("{ body") => {
                if !more.is_empty() {
                    let what = format!(
                        "*CONTACT PAIR, ADJUST of `{word}`: no gaps are closed between a surface and itself"
                    );
                    self.list(row.line, what);
                }
                let name = self.name("pair", &format!("{word} on itself"));
                self.contact += &format!(
                    "\n[[pair]]\nname = {name}\na = {side}\nb = \"itself\"\n{}",
                    interaction.line()
                );
                if interaction.is_anisotropic {
                    let what = "state the texture of the pair of a surface with itself";
                    self.list(row.line, what);
                }
                let interaction = interaction.name.clone();
                self.pairs.push(Pair { name, interaction });
            }
            Ok(_) => self.list(
                row.line,
                format!("contact of the rigid `{word}` with itself"),
            ),
            Err(what) => {
                self.list(row.line, format!("contact of `{word}` with itself: {what}"));
            }
        }
    }

    fn ties(&mut self, keyword: &'a Keyword<'a>) {
        self.used.insert(keyword.line);
        // Ties tie displacements, of nodes that are moved onto the other surface or not.
        let known = [
            "NAME",
            "ADJUST",
            "TYPE",
            "POSITION TOLERANCE",
            "NO ROTATION",
            "CONSTRAINT RATIO",
            "CYCLIC SYMMETRY",
        ];
        self.list_parameters(keyword, &known);
        if keyword.parameter("CYCLIC SYMMETRY").is_some() {
            let what = "*TIE, CYCLIC SYMMETRY: both surfaces are those of one sector; model all of it, or hold its cuts in the axes of a cylinder";
            self.list(keyword.line, what);
            return;
        }
        let within = keyword.parameter("POSITION TOLERANCE");
        let within = within.and_then(striae_meshfile::finite);
        for row in &keyword.rows {
            self.tie(row, within);
        }
    }

    fn tie(&mut self, row: &Row<'_>, within: Option<f64>) {
        let Some([a, b]) = self.sides(row) else {
            return;
        };
        if a.contains("rigid =") || b.contains("rigid =") {
            let what = "a tie to a rigid surface; tie its nodes by `tied` of `[[rigid]]`";
            self.list(row.line, what);
            return;
        }
        let [one, other] = [0, 1].map(|at| self.facets(row.words[at]));
        if one
            .iter()
            .any(|(body, _)| other.iter().any(|(of, _)| of == body))
        {
            let what = format!(
                "*TIE `{}`: both surfaces are of one body, and a deck ties two; give each part an *ELSET of its own, or merge their nodes",
                row.words.join(", ")
            );
            self.list(row.line, what);
            return;
        }
        let within = within.map(|within| format!("within = {}\n", number(within)));
        let name = self.name("tie", &format!("{} on {}", row.words[0], row.words[1]));
        self.contact += &format!(
            "\n[[tie]]\nname = {name}\na = {a}\nb = {b}\n{}",
            within.unwrap_or_default()
        );
    }

    /// A name that is new, as text of the deck.
    fn name(&self, kind: &str, base: &str) -> String {
        let names = (1..).map(|count| match count {
            1 => text(base),
            _ => text(&format!("{base}-{count}")),
        });
        let is_free = |name: &String| {
            !self
                .contact
                .contains(&format!("[[{kind}]]\nname = {name}\n"))
        };
        names
            .into_iter()
            .find(is_free)
            .expect("there are more numbers than pairs")
    }

    /// The two sides of a row; `None` after they have been listed.
    fn sides(&mut self, row: &Row<'_>) -> Option<[String; 2]> {
        let [a, b] = match row.words[..] {
            [a, b, ..] if !a.is_empty() && !b.is_empty() => [a, b],
            _ => {
                let what = format!("two surfaces are needed, found `{}`", row.words.join(", "));
                self.list(row.line, what);
                return None;
            }
        };
        let [first, second] = [a, b].map(|word| {
            let side = self.side(word);
            if let Err(what) = &side {
                self.list(row.line, format!("contact of `{a}` and `{b}`: {what}"));
            }
            side.ok()
        });
        Some([first?, second?])
    }

    /// A side of a pair.
    pub(super) fn side(&mut self, word: &str) -> Result<String, String> {
        if let Some(at) = self.rigid_of_surface(word) {
            return Ok(format!("{{ rigid = {} }}", text(&self.rigid[at].name)));
        }
        let found = self.facets(word);
        match &found[..] {
            [(body, facets)] => {
                let body = text(&self.bodies[*body].name);
                Ok(format!("{{ body = {body}, facets = {} }}", text(facets)))
            }
            [] => Err(self.missing_facets(word)),
            _ => Err(format!(
                "surface `{word}` is on several bodies; name one for each of them"
            )),
        }
    }

    /// Reason why a surface has no facets.
    pub(super) fn missing_facets(&mut self, word: &str) -> String {
        let bare = word.rsplit('.').next().unwrap_or(word);
        let mut surfaces = self.keywords.iter();
        let surface = surfaces.find(|keyword| {
            keyword.name == "SURFACE" && (has(keyword, "NAME", word) || has(keyword, "NAME", bare))
        });
        let Some(surface) = surface else {
            return match self.nodes(word).is_empty() {
                true => format!("there is no *SURFACE `{word}`"),
                false => format!("the nodes of `{word}` make up no facet; name elements and faces"),
            };
        };
        let kind = surface.parameter("TYPE").unwrap_or("ELEMENT");
        if kind.eq_ignore_ascii_case("NODE") {
            return format!("the nodes of `{word}` make up no facet; name elements and faces");
        }
        if !kind.eq_ignore_ascii_case("ELEMENT") {
            let is_its = |keyword: &&&Keyword<'_>| has(keyword, "NAME", word);
            let instances = self.instances.iter();
            let stating = instances.filter(|of| of.own.iter().any(|own| is_its(&own)));
            return match stating.count() {
                0 | 1 => format!("`{word}` is an analytical surface of no rigid body"),
                _ => format!("several instances have a surface `{word}`; write `INSTANCE.{word}`"),
            };
        }
        let kinds: BTreeSet<String> = self.kinds_of_surface(surface);
        match kinds.is_empty() {
            true => format!("no body has facets of surface `{word}`"),
            false => format!(
                "surface `{word}` is of elements {} and not on a body of solids",
                kinds.into_iter().collect::<Vec<_>>().join(", ")
            ),
        }
    }

    /// Types of the elements of a surface that are no solids.
    fn kinds_of_surface(&self, surface: &Keyword<'_>) -> BTreeSet<String> {
        let rows = surface.rows.iter();
        let words: Vec<&str> = rows
            .map(|row| row.words[0].rsplit('.').next().unwrap_or(row.words[0]))
            .collect();
        let elements = self.keywords.iter();
        let named = elements.filter(|keyword| {
            let is_one = |row: &Row<'_>| words.contains(&row.words[0]);
            let of_set = |word: &&str| has(keyword, "ELSET", word);
            keyword.name == "ELEMENT"
                && (words.iter().any(of_set) || keyword.rows.iter().any(is_one))
        });
        let kinds = named.filter_map(|keyword| keyword.parameter("TYPE"));
        let kinds = kinds.map(str::to_uppercase);
        kinds.filter(|kind| !kind.starts_with("C3D")).collect()
    }

    /// Bodies by place with the facet set that a word stands for.
    pub(super) fn facets(&mut self, word: &str) -> Vec<(usize, String)> {
        let bodies = self.bodies_named(word).into_iter();
        let found = bodies.filter_map(|at| Some((at, self.bodies[at].facet_set(word)?)));
        found.collect()
    }

    /// Lists friction of interactions that nothing refers to.
    fn list_idle_interactions(&mut self) {
        let keywords = self.keywords;
        let mut name = "";
        for keyword in keywords {
            match keyword.name.as_str() {
                "SURFACE INTERACTION" => name = keyword.parameter("NAME").unwrap_or_default(),
                "CHANGE FRICTION" => name = "",
                "FRICTION" if !self.used.contains(&keyword.line) && !name.is_empty() => {
                    let what = format!("*FRICTION of `{name}`, which no contact refers to");
                    self.list(keyword.line, what);
                }
                _ => {}
            }
        }
    }
}
