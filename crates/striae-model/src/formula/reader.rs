//! From a text to the operations of a formula.

use std::{iter::Peekable, str::CharIndices};

use super::{Angles, Exponent, Formula, Function, OF_ANY, OF_ONE, Operation};

/// Parentheses, signs and powers within each other that are read.
const DEEPEST: usize = 64;

/// Meaning of a name.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Name {
    /// A number.
    Number(f64),
    /// The variable of this position.
    Variable(usize),
}

/// Something in a text that cannot be read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Mistake {
    /// Number of the letter at which it is found, counted from 1.
    pub letter: usize,
    /// The reason, as the end of a sentence.
    pub cause: String,
}

/// Reads a text, with the meaning of the names in it.
///
/// # Errors
/// The first mistake; a cause that `meaning` gives is passed on.
pub fn read(
    text: &str,
    angles: Angles,
    meaning: &mut dyn FnMut(&str) -> Result<Name, String>,
) -> Result<Formula, Mistake> {
    let mut reader = Reader {
        text,
        letters: text.char_indices().peekable(),
        angles,
        meaning,
        depth: 0,
        operations: Vec::new(),
    };
    reader.whole().map_err(|(at, cause)| Mistake {
        letter: text[..at].chars().count() + 1,
        cause,
    })?;
    Ok(Formula {
        operations: reader.operations,
    })
}

/// A cause with the place of the byte at which it is found.
type Read<T> = Result<T, (usize, String)>;

struct Reader<'t, 'v> {
    text: &'t str,
    letters: Peekable<CharIndices<'t>>,
    angles: Angles,
    meaning: &'v mut dyn FnMut(&str) -> Result<Name, String>,
    depth: usize,
    operations: Vec<Operation>,
}

impl<'t> Reader<'t, '_> {
    fn whole(&mut self) -> Read<()> {
        self.sum()?;
        match self.next_letter() {
            None => Ok(()),
            found => Err(self.expected("an operator", found)),
        }
    }

    fn sum(&mut self) -> Read<()> {
        self.term()?;
        loop {
            let operation = match self.next_letter() {
                Some('+') => Operation::Add,
                Some('-') => Operation::Subtract,
                _ => return Ok(()),
            };
            self.letters.next();
            self.term()?;
            self.operations.push(operation);
        }
    }

    fn term(&mut self) -> Read<()> {
        self.signed()?;
        loop {
            let operation = match self.next_letter() {
                Some('*') => Operation::Multiply,
                Some('/') => Operation::Divide,
                _ => return Ok(()),
            };
            self.letters.next();
            self.signed()?;
            self.operations.push(operation);
        }
    }

    fn signed(&mut self) -> Read<()> {
        match self.next_letter() {
            Some('-') => {
                self.deeper(Self::signed)?;
                self.operations.push(Operation::Negate);
                Ok(())
            }
            Some('+') => self.deeper(Self::signed),
            _ => self.power(),
        }
    }

    fn power(&mut self) -> Read<()> {
        self.atom()?;
        if self.next_letter() == Some('^') {
            let base = self.operations.len();
            self.deeper(Self::signed)?;
            let mut exponent = self.operations[base..].iter();
            let varies = exponent.any(|of| matches!(of, Operation::Variable(_)));
            self.operations.push(Operation::Power(match varies {
                true => Exponent::Variables,
                false => Exponent::Numbers,
            }));
        }
        Ok(())
    }

    fn atom(&mut self) -> Read<()> {
        match self.next_letter() {
            Some('(') => {
                self.deeper(Self::sum)?;
                self.closed()
            }
            Some(letter) if letter.is_ascii_digit() || letter == '.' => self.number(),
            Some(letter) if is_name(letter) => self.named(),
            found => Err(self.expected("a number, a parameter or `(`", found)),
        }
    }

    fn number(&mut self) -> Read<()> {
        let mut last = ' ';
        let (at, word) = self.word(&mut |letter| {
            let signs = "+-".contains(letter) && "eE".contains(last);
            let is_part = letter.is_ascii_digit() || ".eE_".contains(letter) || signs;
            last = letter;
            is_part
        });
        let plain = word.replace('_', "");
        match plain.parse::<f64>() {
            Err(_) => Err((at, format!("`{word}` is not a number"))),
            Ok(value) if !value.is_finite() => {
                Err((at, format!("`{word}` is not a finite number")))
            }
            Ok(value) => {
                self.operations.push(Operation::Number(value));
                Ok(())
            }
        }
    }

    fn named(&mut self) -> Read<()> {
        let (at, name) = self.word(&mut |letter| is_name(letter) || letter.is_ascii_digit());
        if self.next_letter() != Some('(') {
            let meaning = match name {
                "pi" => Name::Number(std::f64::consts::PI),
                name => (self.meaning)(name).map_err(|cause| (at, cause))?,
            };
            self.operations.push(match meaning {
                Name::Number(value) => Operation::Number(value),
                Name::Variable(variable) => Operation::Variable(variable),
            });
            return Ok(());
        }
        self.deeper(Self::sum)?;
        let mut arguments = 1;
        while self.next_letter() == Some(',') {
            self.deeper(Self::sum)?;
            arguments += 1;
        }
        self.closed()?;
        let function = self.function(name, arguments).ok_or_else(|| {
            let known: Vec<String> = OF_ONE
                .iter()
                .chain(&OF_ANY)
                .map(|name| format!("`{name}`"))
                .collect();
            let known = known.join(", ");
            let of = match arguments {
                1 => "one number".to_owned(),
                several => format!("{several} numbers"),
            };
            let cause = format!("unknown function `{name}` of {of}; known functions are {known}");
            (at, cause)
        })?;
        self.operations.push(Operation::Call(function));
        Ok(())
    }

    fn function(&self, name: &str, arguments: usize) -> Option<Function> {
        let of_one = OF_ONE.iter().filter(|_| arguments == 1);
        let name = of_one.chain(&OF_ANY).find(|known| **known == name)?;
        Some(Function {
            name,
            arguments,
            angles: self.angles,
        })
    }

    /// Something within something else, after the letter that comes next.
    fn deeper(&mut self, read: fn(&mut Self) -> Read<()>) -> Read<()> {
        self.depth += 1;
        if self.depth > DEEPEST {
            return Err((self.place(), "it is nested too deeply".to_owned()));
        }
        self.letters.next();
        read(self)?;
        self.depth -= 1;
        Ok(())
    }

    fn closed(&mut self) -> Read<()> {
        match self.next_letter() {
            Some(')') => {
                self.letters.next();
                Ok(())
            }
            found => Err(self.expected("`)`", found)),
        }
    }

    /// The next letter that is no blank, which is not taken.
    fn next_letter(&mut self) -> Option<char> {
        while self
            .letters
            .next_if(|(_, letter)| letter.is_whitespace())
            .is_some()
        {}
        self.letters.peek().map(|(_, letter)| *letter)
    }

    fn place(&mut self) -> usize {
        self.letters.peek().map_or(self.text.len(), |at| at.0)
    }

    fn word(&mut self, is_part: &mut dyn FnMut(char) -> bool) -> (usize, &'t str) {
        let text = self.text;
        let start = self.place();
        while self
            .letters
            .next_if(|(_, letter)| is_part(*letter))
            .is_some()
        {}
        let end = self.place();
        (start, &text[start..end])
    }

    fn expected(&mut self, what: &str, found: Option<char>) -> (usize, String) {
        let cause = match found {
            Some(found) => format!("expected {what}, found `{found}`"),
            None => format!("expected {what}, found the end"),
        };
        (self.place(), cause)
    }
}

fn is_name(letter: char) -> bool {
    letter.is_alphabetic() || letter == '_'
}
