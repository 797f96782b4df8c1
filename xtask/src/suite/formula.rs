//! Formulas of the columns of tables.
//!
//! `+ - * / ^`, parentheses, numbers, `pi`, `abs`, `sqrt`, `exp`, `ln`, and `sin`, `cos`, `tan`,
//! `atan` in degrees. A name such as `pair.base.max_pressure` is the last number of a column,
//! `NAME@2` the last one of step 2; `largest(NAME)`, `smallest(NAME)`, `total(NAME)` are taken
//! over all rows, and `mean(NAME@2)` over those of a step.

/// Rows of a column that count.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rows {
    /// The last one, of a step if it is stated.
    Last(Option<usize>),
    /// The largest of all.
    Largest,
    /// The smallest of all.
    Smallest,
    /// The sum of all.
    Total,
    /// The mean, over a step if it is stated.
    Mean(Option<usize>),
}

/// Numbers of columns by name; `None` where there is no such column or row.
type Column<'a> = dyn FnMut(&str, Rows) -> Option<f64> + 'a;

/// The value of a formula.
///
/// # Errors
/// Returns the fault of the formula, in words.
pub fn value(text: &str, column: &mut Column<'_>) -> Result<f64, String> {
    let mut reader = Reader { rest: text, column };
    let value = reader.sum()?;
    match reader.peek() {
        None => Ok(value),
        Some(_) => Err(format!("`{}` is left over", reader.rest)),
    }
}

struct Reader<'a, 'b> {
    rest: &'a str,
    column: &'a mut Column<'b>,
}

impl Reader<'_, '_> {
    fn peek(&mut self) -> Option<char> {
        self.rest = self.rest.trim_start();
        self.rest.chars().next()
    }

    fn take(&mut self, wanted: char) -> bool {
        let found = self.peek() == Some(wanted);
        if found {
            self.rest = &self.rest[wanted.len_utf8()..];
        }
        found
    }

    fn sum(&mut self) -> Result<f64, String> {
        let mut value = self.product()?;
        loop {
            if self.take('+') {
                value += self.product()?;
            } else if self.take('-') {
                value -= self.product()?;
            } else {
                return Ok(value);
            }
        }
    }

    fn product(&mut self) -> Result<f64, String> {
        let mut value = self.signed()?;
        loop {
            if self.take('*') {
                value *= self.signed()?;
            } else if self.take('/') {
                value /= self.signed()?;
            } else {
                return Ok(value);
            }
        }
    }

    fn signed(&mut self) -> Result<f64, String> {
        if self.take('-') {
            return Ok(-self.signed()?);
        }
        let base = self.atom()?;
        if self.take('^') {
            Ok(base.powf(self.signed()?))
        } else {
            Ok(base)
        }
    }

    fn atom(&mut self) -> Result<f64, String> {
        if self.take('(') {
            let value = self.sum()?;
            return self.closed(value);
        }
        match self.peek() {
            Some(first) if first.is_ascii_digit() || first == '.' => self.number(),
            Some(first) if first.is_alphabetic() => self.named(),
            _ => Err(format!(
                "a number or a name is missing before `{}`",
                self.rest
            )),
        }
    }

    fn closed(&mut self, value: f64) -> Result<f64, String> {
        if self.take(')') {
            Ok(value)
        } else {
            Err("`)` is missing".into())
        }
    }

    fn number(&mut self) -> Result<f64, String> {
        let mut before = ' ';
        let ends = |letter: char| {
            let exponent = matches!(before, 'e' | 'E') && matches!(letter, '+' | '-');
            before = letter;
            !(letter.is_ascii_digit() || matches!(letter, '.' | 'e' | 'E') || exponent)
        };
        let text = self.until(ends);
        text.parse()
            .map_err(|_| format!("`{text}` is not a number"))
    }

    fn until(&mut self, ends: impl FnMut(char) -> bool) -> &str {
        let length = self.rest.find(ends).unwrap_or(self.rest.len());
        let (text, rest) = self.rest.split_at(length);
        self.rest = rest;
        text
    }

    fn named(&mut self) -> Result<f64, String> {
        let name = self.name();
        if name == "pi" {
            return Ok(std::f64::consts::PI);
        }
        if !self.take('(') {
            let step = self.step()?;
            return self.column(&name, Rows::Last(step));
        }
        if let Some(rows) = rows(&name) {
            let column = self.name();
            let rows = match (rows, self.step()?) {
                (Rows::Mean(_), step) => Rows::Mean(step),
                (rows, _) => rows,
            };
            let value = self.column(&column, rows)?;
            return self.closed(value);
        }
        let argument = self.sum()?;
        let value =
            function(&name, argument).ok_or_else(|| format!("there is no function `{name}`"))?;
        self.closed(value)
    }

    fn name(&mut self) -> String {
        let _ = self.peek();
        self.until(|letter| !(letter.is_alphanumeric() || matches!(letter, '.' | '_')))
            .to_owned()
    }

    fn step(&mut self) -> Result<Option<usize>, String> {
        if !self.take('@') {
            return Ok(None);
        }
        let text = self.until(|letter| !letter.is_ascii_digit());
        let step = text
            .parse()
            .map_err(|_| "a step is missing behind `@`".to_owned());
        step.map(Some)
    }

    fn column(&mut self, name: &str, rows: Rows) -> Result<f64, String> {
        (self.column)(name, rows).ok_or_else(|| format!("there is no column or row of `{name}`"))
    }
}

fn rows(name: &str) -> Option<Rows> {
    match name {
        "largest" => Some(Rows::Largest),
        "smallest" => Some(Rows::Smallest),
        "total" => Some(Rows::Total),
        "mean" => Some(Rows::Mean(None)),
        _ => None,
    }
}

fn function(name: &str, argument: f64) -> Option<f64> {
    let radians = argument.to_radians();
    match name {
        "abs" => Some(argument.abs()),
        "sqrt" => Some(argument.sqrt()),
        "exp" => Some(argument.exp()),
        "ln" => Some(argument.ln()),
        "sin" => Some(radians.sin()),
        "cos" => Some(radians.cos()),
        "tan" => Some(radians.tan()),
        "atan" => Some(argument.atan().to_degrees()),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(text: &str) -> Result<f64, String> {
        value(text, &mut |name, rows| match (name, rows) {
            ("pair.a.x", Rows::Last(None)) => Some(3.0),
            ("pair.a.x", Rows::Last(Some(2))) => Some(4.0),
            ("pair.a.x", Rows::Largest) => Some(5.0),
            ("time", Rows::Total) => Some(6.0),
            ("time", Rows::Mean(Some(1))) => Some(7.0),
            _ => None,
        })
    }

    #[test]
    fn formulas_have_the_usual_order() {
        assert_eq!(of("1 + 2*3^2 - 8/4/2"), Ok(18.0));
        assert_eq!(of("-2^2 + (1 - 3)*1e-1"), Ok(-4.2));
        assert_eq!(of("sqrt(4)*abs(-1.5)"), Ok(3.0));
        assert!((of("tan(45) + atan(1) + cos(60)").unwrap() - 46.5).abs() < 1e-12);
    }

    #[test]
    fn columns_are_read_at_the_end_of_steps_and_over_all_rows() {
        assert_eq!(of("pair.a.x/pair.a.x@2"), Ok(0.75));
        assert_eq!(
            of("largest(pair.a.x) + total(time) + mean(time@1)"),
            Ok(18.0)
        );
    }

    #[test]
    fn faults_are_told() {
        assert_eq!(
            of("1 + "),
            Err("a number or a name is missing before ``".into())
        );
        assert_eq!(of("(1"), Err("`)` is missing".into()));
        assert_eq!(of("1 2"), Err("`2` is left over".into()));
        assert_eq!(
            of("force"),
            Err("there is no column or row of `force`".into())
        );
        assert_eq!(of("log(1)"), Err("there is no function `log`".into()));
    }
}
