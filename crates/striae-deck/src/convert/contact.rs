//! Contact pairs, their friction, and ties.

use super::{Model, has, numbers};
use crate::write::value::{number, text};
use striae_meshfile::{Keyword, Row};

impl<'a> Model<'a> {
    /// Reads pairs and ties, and general contact.
    pub(super) fn read_contact(&mut self) {
        let keywords = self.keywords;
        for keyword in keywords {
            match keyword.name.as_str() {
                "SURFACE" => self.surface(keyword),
                "SURFACE INTERACTION" => {
                    self.used.insert(keyword.line);
                    if keyword.parameter("NAME").is_none() {
                        self.list(keyword.line, "*SURFACE INTERACTION without a name");
                    }
                }
                "SURFACE BEHAVIOR" => self.behaviour(keyword),
                "CONTACT PAIR" => self.pairs(keyword),
                "TIE" => self.ties(keyword),
                "CONTACT" => {
                    self.used.insert(keyword.line);
                    self.list_parameters(keyword, &[]);
                }
                "CONTACT INCLUSIONS" => self.inclusions(keyword),
                _ => {}
            }
        }
    }

    /// Surfaces stay in the file; those that a mesh does not read are listed unless they are of a
    /// rigid body.
    fn surface(&mut self, keyword: &Keyword<'_>) {
        let kind = keyword
            .parameter("TYPE")
            .unwrap_or("ELEMENT")
            .to_uppercase();
        if ["ELEMENT", "NODE"].contains(&kind.as_str()) {
            self.used.insert(keyword.line);
        } else if !self.used.contains(&keyword.line) {
            self.list(keyword.line, format!("*SURFACE, TYPE={kind}"));
        }
    }

    /// Hard contact is what a deck has.
    fn behaviour(&mut self, keyword: &Keyword<'_>) {
        self.used.insert(keyword.line);
        let pressure = keyword.parameter("PRESSURE-OVERCLOSURE");
        if let Some(other) = pressure.filter(|word| !word.eq_ignore_ascii_case("HARD")) {
            let what = format!("*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE={other}: contact is hard");
            self.list(keyword.line, what);
        }
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
        ];
        self.list_parameters(keyword, &known);
        let friction = self.friction(keyword.parameter("INTERACTION"), keyword.line);
        let adjust = keyword.parameter("ADJUST");
        let initial = adjust.map(|adjust| match striae_meshfile::finite(adjust) {
            Some(gap) if gap > 0.0 => format!("initial = {{ close = {} }}\n", number(gap)),
            _ => "initial = \"close\"\n".to_owned(),
        });
        if let Some(set) = adjust.filter(|adjust| striae_meshfile::finite(adjust).is_none()) {
            let what = format!("*CONTACT PAIR, ADJUST={set}: all of the surfaces is closed");
            self.list(keyword.line, what);
        }
        for row in &keyword.rows {
            match keyword.parameter("TIED") {
                Some(_) => self.tie(row, "tie", None),
                None => self.pair(
                    row,
                    &format!("{friction}{}", initial.clone().unwrap_or_default()),
                ),
            }
        }
    }

    /// General contact of everything, or between surfaces that have names.
    fn inclusions(&mut self, keyword: &'a Keyword<'a>) {
        self.used.insert(keyword.line);
        if keyword.parameter("ALL EXTERIOR").is_some() && !self.contact.contains("\n[contact]\n") {
            let (interaction, line) = self.assigned(["", ""]);
            let friction = self.friction(interaction, line.unwrap_or(keyword.line));
            self.contact += &format!("\n[contact]\nall = true\n{friction}");
            self.list_assigned();
        }
        for row in &keyword.rows {
            let sides = [0, 1].map(|at| row.words.get(at).copied().unwrap_or_default());
            if sides.contains(&"") {
                let what = format!(
                    "*CONTACT INCLUSIONS `{}`: contact of a surface with itself; make it a pair with `b = \"itself\"`",
                    row.words.join(", ")
                );
                self.list(row.line, what);
                continue;
            }
            let (interaction, line) = self.assigned(sides);
            let friction = self.friction(interaction, line.unwrap_or(keyword.line));
            self.pair(row, &friction);
        }
    }

    /// Lists interactions of surfaces with names beside contact of everything.
    fn list_assigned(&mut self) {
        let keywords = self.keywords;
        let assignments = keywords.iter();
        let assignments =
            assignments.filter(|keyword| keyword.name == "CONTACT PROPERTY ASSIGNMENT");
        for row in assignments.flat_map(|keyword| &keyword.rows) {
            let [a, b] = [0, 1].map(|at| row.words.get(at).copied().unwrap_or_default());
            if !a.is_empty() || !b.is_empty() {
                let what = format!(
                    "*CONTACT PROPERTY ASSIGNMENT `{}`: state it in `[[contact.between]]`",
                    row.words.join(", ")
                );
                self.list(row.line, what);
            }
        }
    }

    /// The interaction that general contact assigns to two surfaces.
    fn assigned(&mut self, sides: [&str; 2]) -> (Option<&'a str>, Option<usize>) {
        let keywords = self.keywords.iter();
        let keywords = keywords.filter(|keyword| keyword.name == "CONTACT PROPERTY ASSIGNMENT");
        let mut found = (None, None);
        for keyword in keywords {
            self.used.insert(keyword.line);
            for row in &keyword.rows {
                let [a, b, property] =
                    [0, 1, 2].map(|at| row.words.get(at).copied().unwrap_or_default());
                let same = |a: &str, b: &str| {
                    a.eq_ignore_ascii_case(sides[0]) && b.eq_ignore_ascii_case(sides[1])
                };
                if a.is_empty() && b.is_empty() || same(a, b) || same(b, a) {
                    found = (Some(property), Some(keyword.line));
                }
            }
        }
        found
    }

    /// A line with the friction of an interaction; none without friction.
    fn friction(&mut self, interaction: Option<&str>, line: usize) -> String {
        let Some(name) = interaction else {
            return String::new();
        };
        let keywords = self.keywords;
        let at = keywords.iter().position(|keyword| {
            keyword.name == "SURFACE INTERACTION" && has(keyword, "NAME", name)
        });
        let Some(at) = at else {
            self.list(line, format!("there is no *SURFACE INTERACTION `{name}`"));
            return String::new();
        };
        let options = keywords[at + 1..].iter();
        let mut options = options.take_while(|keyword| {
            !["SURFACE INTERACTION", "STEP", "CONTACT PAIR", "MATERIAL"]
                .contains(&keyword.name.as_str())
        });
        let Some(friction) = options.find(|keyword| keyword.name == "FRICTION") else {
            return String::new();
        };
        self.used.insert(friction.line);
        match self.coulomb(friction) {
            Ok(line) => line,
            Err(what) => {
                self.list(friction.line, format!("*FRICTION {what}: no friction"));
                String::new()
            }
        }
    }

    fn coulomb(&mut self, friction: &Keyword<'_>) -> Result<String, String> {
        let known = [
            "SLIP TOLERANCE",
            "ELASTIC SLIP",
            "TAUMAX",
            "EXPONENTIAL DECAY",
            "LAGRANGE",
        ];
        let others = friction.parameters().map(|(key, _)| key);
        let others: Vec<&str> = others.filter(|key| !known.contains(key)).collect();
        if !others.is_empty() {
            return Err(format!("with {}", others.join(", ")));
        }
        let row = friction.rows.first();
        let row = row.and_then(|row| numbers(&row.words)).unwrap_or_default();
        let is_decay = friction.parameter("EXPONENTIAL DECAY").is_some();
        let (mu, decay) = match row[..] {
            [still, moving, rate] if is_decay && still > 0.0 && rate > 0.0 => {
                let (ratio, rate) = (number(moving / still), number(1.0 / rate));
                let decay =
                    format!(", decay = {{ kinetic_over_static = {ratio}, slip_rate = {rate} }}");
                (still, decay)
            }
            _ if is_decay => return Err("without its three constants".to_owned()),
            [mu, ref others @ ..] if mu >= 0.0 => {
                if others.iter().any(|other| *other != 0.0) || friction.rows.len() > 1 {
                    let what = "*FRICTION that depends on slip rate, pressure or temperature: its first coefficient is taken";
                    self.list(friction.line, what);
                }
                (mu, String::new())
            }
            _ => return Err("without a coefficient".to_owned()),
        };
        let cap = friction
            .parameter("TAUMAX")
            .and_then(striae_meshfile::finite);
        let cap = cap.map(|cap| format!(", shear_cap = {}", number(cap)));
        let cap = cap.unwrap_or_default();
        Ok(format!(
            "friction = {{ law = \"coulomb\", mu = {}{cap}{decay} }}\n",
            number(mu)
        ))
    }

    fn pair(&mut self, row: &Row<'_>, more: &str) {
        let Some([a, b]) = self.sides(row) else {
            return;
        };
        let name = self.name("pair", row);
        self.contact += &format!("\n[[pair]]\nname = {name}\na = {a}\nb = {b}\n{more}");
    }

    fn ties(&mut self, keyword: &'a Keyword<'a>) {
        self.used.insert(keyword.line);
        let known = [
            "NAME",
            "ADJUST",
            "TYPE",
            "POSITION TOLERANCE",
            "NO ROTATION",
        ];
        self.list_parameters(keyword, &known);
        let within = keyword.parameter("POSITION TOLERANCE");
        let within = within.and_then(striae_meshfile::finite);
        for row in &keyword.rows {
            self.tie(row, "tie", within);
        }
    }

    fn tie(&mut self, row: &Row<'_>, kind: &str, within: Option<f64>) {
        let Some([a, b]) = self.sides(row) else {
            return;
        };
        if a.contains("rigid =") || b.contains("rigid =") {
            self.list(row.line, "a tie to a rigid surface");
            return;
        }
        let within = within.map(|within| format!("within = {}\n", number(within)));
        let name = self.name(kind, row);
        self.contact += &format!(
            "\n[[tie]]\nname = {name}\na = {a}\nb = {b}\n{}",
            within.unwrap_or_default()
        );
    }

    /// A name of the two surfaces of a row, which is new.
    fn name(&self, kind: &str, row: &Row<'_>) -> String {
        let base = format!("{} on {}", row.words[0], row.words[1]);
        let names = (1..).map(|count| match count {
            1 => text(&base),
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
                let what = format!("contact of `{}` with itself", row.words.join(", "));
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
    fn side(&mut self, word: &str) -> Result<String, String> {
        if let Some(at) = self.rigid_of_surface(word) {
            return Ok(format!("{{ rigid = {} }}", text(&self.rigid[at].name)));
        }
        let found = self.facets(word);
        match &found[..] {
            [(body, facets)] => Ok(format!(
                "{{ body = {}, facets = {} }}",
                text(body),
                text(facets)
            )),
            [] => Err(format!("no body has facets of surface `{word}`")),
            _ => Err(format!("surface `{word}` is on several bodies")),
        }
    }

    /// Bodies with the facet set that a word stands for.
    pub(super) fn facets(&mut self, word: &str) -> Vec<(String, String)> {
        let exact = self.bodies.iter().position(|body| {
            let (instance, _) = word.rsplit_once('.').unwrap_or_default();
            body.name.eq_ignore_ascii_case(instance)
        });
        let bodies = self.bodies.iter_mut().enumerate();
        let bodies = bodies.filter(|(at, _)| exact.is_none_or(|exact| exact == *at));
        let found = bodies.filter_map(|(_, body)| Some((body.name.clone(), body.facet_set(word)?)));
        found.collect()
    }
}
