//! Friction of surface interactions.
//!
//! | in Abaqus | in the deck |
//! | --- | --- |
//! | `mu` | Coulomb friction |
//! | `ANISOTROPIC`: `mu_1`, `mu_2` | orthotropic friction with the associated slip rule, as slip is normal to the ellipse of critical shear stress |
//! | `ROUGH` | Coulomb friction with a large coefficient, which is told |
//! | several rows, by slip rate or by pressure | a table of factors |
//! | `EXPONENTIAL DECAY`, `mu_k + (mu_s - mu_k) exp(-d v)` | decay with the slip rate `1/d` |
//! | `TAUMAX` | cap of the shear stress |
//!
//! Source: Abaqus analysis guide, "Frictional behavior".

use super::{Model, has, numbers};
use crate::write::value::{list, number};
use striae_meshfile::Keyword;

/// Coefficient of rough friction.
const ROUGH: f64 = 100.0;

/// Friction of an interaction, and more that it states.
#[derive(Clone, Default)]
pub(super) struct Interaction {
    /// Its name in capitals.
    pub(super) name: String,
    /// The table of the friction law, without braces.
    pub(super) friction: Option<String>,
    /// `true` if the coefficients belong to two directions.
    pub(super) is_anisotropic: bool,
    /// `true` if surfaces are tied, as CalculiX has it.
    pub(super) is_tied: bool,
}

impl Interaction {
    /// A line with the friction; none without friction.
    pub(super) fn line(&self) -> String {
        let friction = self.friction.as_ref();
        friction.map_or(String::new(), |law| format!("friction = {{ {law} }}\n"))
    }
}

/// Law of a friction.
pub(super) struct FrictionLaw {
    pub(super) text: String,
    pub(super) is_anisotropic: bool,
}

impl<'a> Model<'a> {
    /// The interaction of a name; an empty one where there is none, which is listed.
    pub(super) fn interaction(&mut self, name: Option<&str>, line: usize) -> Interaction {
        let Some(name) = name.filter(|name| !name.is_empty()) else {
            return Interaction::default();
        };
        let keywords = self.keywords;
        let at = keywords.iter().position(|keyword| {
            keyword.name == "SURFACE INTERACTION" && has(keyword, "NAME", name)
        });
        let mut interaction = Interaction {
            name: name.to_uppercase(),
            ..Interaction::default()
        };
        let Some(at) = at else {
            self.list(line, format!("there is no *SURFACE INTERACTION `{name}`"));
            return interaction;
        };
        let ends = [
            "SURFACE INTERACTION",
            "CHANGE FRICTION",
            "STEP",
            "CONTACT PAIR",
            "MATERIAL",
        ];
        let options = keywords[at + 1..].iter();
        let options = options.take_while(|keyword| !ends.contains(&keyword.name.as_str()));
        for option in options {
            match option.name.as_str() {
                "FRICTION" if interaction.friction.is_none() => {
                    if let Some(law) = self.friction(option) {
                        interaction.is_anisotropic = law.is_anisotropic;
                        interaction.friction = Some(law.text);
                    }
                }
                "SURFACE BEHAVIOR" => {
                    interaction.is_tied |= has(option, "PRESSURE-OVERCLOSURE", "TIED");
                }
                _ => {}
            }
        }
        interaction
    }

    /// The law that a keyword states, once it has been listed `None` where there is none.
    pub(super) fn friction(&mut self, keyword: &Keyword<'_>) -> Option<FrictionLaw> {
        let is_new = self.used.insert(keyword.line);
        match law(keyword) {
            Ok((law, notes)) => {
                for note in notes.into_iter().filter(|_| is_new) {
                    self.list(keyword.line, format!("*FRICTION {note}"));
                }
                Some(law)
            }
            Err(what) => {
                if is_new {
                    let line = keyword.line;
                    self.list(line, format!("*FRICTION {what}: no friction"));
                }
                None
            }
        }
    }
}

/// The law of a friction, and what there is to say about it.
fn law(keyword: &Keyword<'_>) -> Result<(FrictionLaw, Vec<String>), String> {
    let known = [
        "SLIP TOLERANCE",
        "ELASTIC SLIP",
        "TAUMAX",
        "EXPONENTIAL DECAY",
        "LAGRANGE",
        "ANISOTROPIC",
        "ROUGH",
        "DEPENDENCIES",
    ];
    let others = keyword.parameters().map(|(key, _)| key);
    let others: Vec<&str> = others.filter(|key| !known.contains(key)).collect();
    if !others.is_empty() {
        return Err(format!("with {}", others.join(", ")));
    }
    let mut notes = Vec::new();
    let rows: Option<Vec<Vec<f64>>> = keyword.rows.iter().map(|row| numbers(&row.words)).collect();
    let rows = rows.ok_or("without numbers below it")?;
    let is_anisotropic = keyword.parameter("ANISOTROPIC").is_some();
    let count = if is_anisotropic { 2 } else { 1 };
    let mut more = String::new();
    let coefficients = if keyword.parameter("ROUGH").is_some() {
        notes.push(format!(
            "ROUGH: taken as a coefficient of {ROUGH}, by which surfaces in contact stick"
        ));
        vec![ROUGH]
    } else if keyword.parameter("EXPONENTIAL DECAY").is_some() {
        let [still, moving, rate] = rows.first().map_or(&[][..], |row| &row[..]) else {
            return Err("without its three constants".to_owned());
        };
        if !(*still > 0.0 && *rate > 0.0) {
            return Err("without its three constants".to_owned());
        }
        more = format!(
            ", decay = {{ kinetic_over_static = {}, slip_rate = {} }}",
            number(moving / still),
            number(1.0 / rate)
        );
        vec![*still]
    } else {
        let first = rows.first().filter(|row| row.len() >= count);
        let first = first.ok_or("without a coefficient")?;
        match table(&rows, count) {
            Some(table) => more = table,
            None => {
                if rows.len() > 1 {
                    notes.push("by more than slip rate or pressure: its first row is taken".into());
                } else if first[count..].iter().any(|other| *other != 0.0) {
                    let what = "with one row: the numbers after the coefficient are left out (slip rate, pressure; a stick slope in CalculiX)";
                    notes.push(what.to_owned());
                }
            }
        }
        first[..count].to_vec()
    };
    if coefficients.iter().any(|mu| *mu < 0.0) {
        return Err("with a negative coefficient".to_owned());
    }
    let cap = keyword.parameter("TAUMAX");
    if let Some(cap) = cap.and_then(striae_meshfile::finite) {
        more = format!(", shear_cap = {}{more}", number(cap));
    }
    let text = match coefficients[..] {
        [along, across] if along > 0.0 && across > 0.0 => format!(
            "law = \"orthotropic\", mu_along = {}, mu_across = {}, slip_rule = \"associated\"{more}",
            number(along),
            number(across)
        ),
        [_, _] => return Err("ANISOTROPIC with a coefficient of 0".to_owned()),
        [mu, ..] => format!("law = \"coulomb\", mu = {}{more}", number(mu)),
        [] => return Err("without a coefficient".to_owned()),
    };
    let law = FrictionLaw {
        text,
        is_anisotropic,
    };
    Ok((law, notes))
}

/// Dependence on the slip rate alone or on the pressure alone, by factors of the first row.
fn table(rows: &[Vec<f64>], count: usize) -> Option<String> {
    let column = |at: usize| -> Vec<f64> {
        let rows = rows.iter();
        rows.map(|row| row.get(at).copied().unwrap_or(0.0))
            .collect()
    };
    let varies = |at: usize| column(at).windows(2).any(|pair| pair[0] != pair[1]);
    let longest = rows.iter().map(Vec::len).max().unwrap_or(0);
    let varying: Vec<usize> = (count..longest).filter(|at| varies(*at)).collect();
    let [at] = varying[..] else {
        return None;
    };
    let (key, places) = match at - count {
        0 => ("by_slip_rate", "slip_rates"),
        1 => ("by_pressure", "pressures"),
        _ => return None,
    };
    let x = column(at);
    let first = column(0);
    let factors: Vec<f64> = first.iter().map(|mu| mu / first[0]).collect();
    // The second coefficient has the factors of the first one.
    let same = (1..count).all(|at| {
        let own = column(at);
        let both = own.iter().zip(&factors);
        both.into_iter()
            .all(|(mu, factor)| (mu - own[0] * factor).abs() <= 1e-9 * mu.abs())
    });
    let rises = x.windows(2).all(|pair| pair[0] < pair[1]);
    let is_positive = first.iter().all(|mu| *mu > 0.0);
    (same && rises && is_positive).then(|| {
        format!(
            ", {key} = {{ form = \"table\", {places} = {}, factors = {} }}",
            list(x.into_iter().map(number)),
            list(factors.into_iter().map(number))
        )
    })
}
