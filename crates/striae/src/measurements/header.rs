//! Names of the columns of a file, and the reading of a line by them.

use striae_files::Separator;
use striae_law::fit::{LARGEST_FRICTION, Reading, SPREADS};

use super::{
    Angles, COLUMNS, Form, MeasurementFault, NamedColumn, fault,
    name::{Name, is_misspelt},
};

/// Assignment of the fields of a line to quantities.
pub(super) struct Header {
    separator: Separator,
    /// Names of the fields, or their numbers where no line names them.
    names: Vec<String>,
    /// Quantities with their fields.
    fields: Vec<(&'static str, usize)>,
    /// Naming of the fields.
    naming: Naming,
}

/// A line of a file.
pub(super) struct Row {
    /// Its number.
    pub(super) line: usize,
    /// Angle as written, in degrees.
    pub(super) angle: f64,
    /// Friction as written, or the quotient of the forces.
    pub(super) friction: f64,
    /// The reading.
    pub(super) reading: Reading,
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Naming {
    Names,
    Numbers,
}

impl Header {
    /// The header of a file with this first line, or `None` after its faults have been noted.
    pub(super) fn read(
        separator: Separator,
        (number, line): (usize, &str),
        form: &Form,
        faults: &mut Vec<MeasurementFault>,
    ) -> Option<Self> {
        let before = faults.len();
        let written: Vec<(usize, &str)> = separator.fields(line).collect();
        let is_number = |(_, text): &(usize, &str)| separator.number(text).is_some();
        let naming = match written.iter().all(is_number) {
            true => Naming::Numbers,
            false => Naming::Names,
        };
        let mut header = Self {
            separator,
            names: match naming {
                Naming::Names => written.iter().map(|(_, name)| (*name).to_owned()).collect(),
                Naming::Numbers => (1..=written.len()).map(|at| at.to_string()).collect(),
            },
            fields: Vec::new(),
            naming,
        };
        for named in &form.columns {
            match header.column(named) {
                Some(field) => header.fields.push((named.quantity, field)),
                None => {
                    let (column, there) = (&named.column, header.there());
                    let message = format!("unknown column `{column}`; {there}");
                    faults.push(fault(Some((number, 1)), message));
                }
            }
        }
        for (at, (column, name)) in written.iter().enumerate() {
            let place = Some((number, *column));
            let Some(known) = COLUMNS.into_iter().find(|known| known == name) else {
                continue;
            };
            match header.field(known) {
                Some(_) if form.columns.iter().any(|named| named.quantity == known) => {}
                Some(_) => faults.push(fault(place, format!("column `{name}` appears twice"))),
                None => header.fields.push((known, at)),
            }
        }
        header.take_similar((number, &written), faults);
        if faults.len() == before
            && let Some(message) = header.missing(form.angles)
        {
            faults.push(fault(Some((number, 1)), message));
        }
        (faults.len() == before).then_some(header)
    }

    /// Takes columns for quantities that no other column is for, by names in other letters and
    /// with units, such as `Angle [deg]`.
    fn take_similar(
        &mut self,
        (number, written): (usize, &[(usize, &str)]),
        faults: &mut Vec<MeasurementFault>,
    ) {
        for known in COLUMNS {
            let ruled_out = match known {
                "friction" => self.has("tangential") || self.has("normal"),
                "tangential" | "normal" => self.has("friction"),
                _ => false,
            };
            if self.has(known) || ruled_out {
                continue;
            }
            let columns = written.iter().enumerate();
            let same = columns.filter(|(_, (_, name))| Name::of(name).is(known));
            let is_free = |at: usize| !self.fields.iter().any(|(_, field)| *field == at);
            let same: Vec<_> = same.filter(|(at, _)| is_free(*at)).collect();
            let Some(&(at, (column, name))) = same.first() else {
                continue;
            };
            if let Some((_, (column, other))) = same.get(1) {
                let message = format!(
                    "columns `{name}` and `{other}` can both be `{known}`; name one of them: `--columns {known}={}`",
                    at + 1
                );
                faults.push(fault(Some((number, *column)), message));
            } else if let Some(needed) = Name::of(name).foreign_unit(known) {
                let message = format!(
                    "column `{name}`: `{known}` is needed {needed}; convert it, or if it is, name the column: `--columns {known}={}`",
                    at + 1
                );
                faults.push(fault(Some((number, *column)), message));
            } else {
                self.fields.push((known, at));
            }
        }
    }

    /// True where the first line has names.
    pub(super) fn is_named(&self) -> bool {
        self.naming == Naming::Names
    }

    /// Columns that are not used, in a sentence.
    pub(super) fn note(&self) -> Option<String> {
        let names = self.foreign().map(|name| format!("`{name}`"));
        let names: Vec<String> = names.collect();
        (!names.is_empty()).then(|| format!("unused columns: {}", names.join(", ")))
    }

    fn foreign(&self) -> impl Iterator<Item = &str> {
        let names = self.names.iter().enumerate();
        let is_used = |at: usize| self.fields.iter().any(|(_, field)| *field == at);
        names
            .filter(move |(at, _)| !is_used(*at))
            .map(|(_, name)| name.as_str())
    }

    /// The field that a named column is.
    fn column(&self, named: &NamedColumn) -> Option<usize> {
        let by_name = self.names.iter().position(|name| *name == named.column);
        let by_number = || {
            let number: usize = named.column.parse().ok()?;
            let at = number.checked_sub(1)?;
            (at < self.names.len()).then_some(at)
        };
        by_name.or_else(by_number)
    }

    fn there(&self) -> String {
        let names: Vec<String> = self.names.iter().map(|name| format!("`{name}`")).collect();
        format!("there are {}", names.join(", "))
    }

    /// The quantity that is missing, in a sentence.
    fn missing(&self, angles: Angles) -> Option<String> {
        let ratio = [self.has("tangential"), self.has("normal")];
        let needed = match (self.has("friction"), ratio) {
            _ if self.naming == Naming::Numbers && self.fields.is_empty() => {
                return Some(
                    "numbers, but no names of columns; begin with a line such as \
                     `angle,friction`, or name the columns: `--columns angle=1,friction=2`"
                        .to_owned(),
                );
            }
            _ if !self.has("angle") && self.needs_angle(angles) => {
                "a column `angle` is needed: slip in degrees"
            }
            (true, [false, false]) | (false, [true, true]) => return None,
            (true, _) => {
                return Some(
                    "either `friction` is needed or `tangential` and `normal`, not both".to_owned(),
                );
            }
            (false, _) => "a column `friction` is needed, or `tangential` and `normal`",
        };
        let similar = self.foreign().find_map(|name| {
            let mut known = COLUMNS.into_iter().filter(|known| !self.has(known));
            Some((name, known.find(|known| is_misspelt(name, known))?))
        });
        let hint = match similar {
            Some((name, known)) => format!("unknown column `{name}`; did you mean `{known}`?"),
            None => {
                let quantity = match !self.has("angle") && self.needs_angle(angles) {
                    true => "angle",
                    false => "friction",
                };
                format!("name yours by `--columns`, such as `--columns {quantity}=COLUMN`")
            }
        };
        Some(format!("{needed}; {}; {hint}", self.there()))
    }

    /// Returns whether the column `angle` must be there; a direction of friction is one beside
    /// that of slip.
    fn needs_angle(&self, angles: Angles) -> bool {
        angles == Angles::Needed || self.has("direction")
    }

    fn has(&self, name: &str) -> bool {
        self.field(name).is_some()
    }

    fn field(&self, name: &str) -> Option<usize> {
        let mut fields = self.fields.iter();
        fields.find(|(known, _)| *known == name).map(|(_, at)| *at)
    }

    /// The row of a line, or `None` after its faults have been noted; `specimens` are the
    /// names so far.
    pub(super) fn row(
        &self,
        number: usize,
        line: &str,
        specimens: &mut Vec<String>,
        faults: &mut Vec<MeasurementFault>,
    ) -> Option<Row> {
        let before = faults.len();
        let fields: Vec<(usize, &str)> = self.separator.fields(line).collect();
        if fields.len() != self.names.len() {
            let (found, needed) = (fields.len(), self.names.len());
            let message = format!("fields: {found}, but columns: {needed}; each needs one");
            faults.push(fault(Some((number, 1)), message));
            return None;
        }
        let mut value = |name: &str, positive: Sign| {
            let (column, text) = fields[self.field(name)?];
            let found = self.separator.number(text);
            let found = found.filter(|value| positive.allows(*value));
            if found.is_none() {
                let message = format!("`{text}` is not a {} for `{name}`", positive.words());
                faults.push(fault(Some((number, column)), message));
            }
            found
        };
        let angle = match self.has("angle") {
            true => value("angle", Sign::Any),
            false => Some(0.0),
        };
        let friction = match self.has("friction") {
            true => value("friction", Sign::Any),
            false => {
                let forces = [
                    value("tangential", Sign::Any),
                    value("normal", Sign::Positive),
                ];
                forces[0].zip(forces[1]).map(|(t, n)| t / n)
            }
        };
        let direction = value("direction", Sign::Any);
        let theta = value("theta", Sign::Any);
        let spread = value("spread", Sign::Positive);
        for (name, message) in self.out_of_range(friction, spread) {
            let field = self.field(name);
            let column = field.map_or(1, |field| fields[field].0);
            faults.push(fault(Some((number, column)), message));
        }
        let specimen = self.field("specimen").map(|field| fields[field]);
        if let Some((column, "")) = specimen {
            let message = "the name of the specimen is missing";
            faults.push(fault(Some((number, column)), message));
        }
        if faults.len() > before {
            return None;
        }
        let specimen = specimen.map_or(0, |(_, name)| numbered(name, specimens));
        let (angle, friction) = (angle?, friction?);
        let slip = angle.to_radians();
        let reading = match direction {
            Some(direction) => Reading::directed(slip, friction, direction.to_radians()),
            None => Reading::against(slip, friction),
        };
        Some(Row {
            line: number,
            angle,
            friction,
            reading: Reading {
                theta: theta.unwrap_or(0.0).to_radians(),
                spread: spread.unwrap_or(1.0),
                specimen,
                ..reading
            },
        })
    }

    /// Quantities of a reading that are out of range, and what is needed of them.
    fn out_of_range(
        &self,
        friction: Option<f64>,
        spread: Option<f64>,
    ) -> Vec<(&'static str, String)> {
        let mut found = Vec::new();
        if friction.is_some_and(|friction| friction.abs() > LARGEST_FRICTION) {
            found.push(match self.has("friction") {
                true => ("friction", format!(
                    "friction of more than {LARGEST_FRICTION}, but it is tangential over normal force; name the columns of the forces `tangential` and `normal` if it is not divided"
                )),
                false => ("normal", format!(
                    "the tangential force is more than {LARGEST_FRICTION} times the normal one; leave out readings without a load"
                )),
            });
        }
        if spread.is_some_and(|spread| !SPREADS.contains(&spread)) {
            let message = format!(
                "`spread` must lie between {} and {}: it is in proportion to that of other readings",
                SPREADS.start(),
                SPREADS.end()
            );
            found.push(("spread", message));
        }
        found
    }
}

/// Number of a name, which is added where it is new.
fn numbered(name: &str, names: &mut Vec<String>) -> usize {
    let known = names.iter().position(|known| known == name);
    known.unwrap_or_else(|| {
        names.push(name.to_owned());
        names.len() - 1
    })
}

/// Bound of a number.
#[derive(Clone, Copy)]
enum Sign {
    Any,
    Positive,
}

impl Sign {
    fn allows(self, value: f64) -> bool {
        match self {
            Self::Any => value.is_finite(),
            Self::Positive => value.is_finite() && value > 0.0,
        }
    }

    fn words(self) -> &'static str {
        match self {
            Self::Any => "finite number",
            Self::Positive => "positive number",
        }
    }
}
