//! Fields of a line of a table, and the numbers in them.

/// Letter between the fields of a line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Separator {
    /// `,`
    Comma,
    /// `;`
    Semicolon,
    /// A tab.
    Tab,
    /// Blanks, any number of them.
    Blanks,
}

impl Separator {
    /// The separator of a file with this first line.
    pub fn of(line: &str) -> Self {
        match line {
            line if line.contains(';') => Self::Semicolon,
            line if line.trim().contains('\t') => Self::Tab,
            _ => Self::Comma,
        }
    }

    /// The separator of a file with these first lines: blanks if no other letter separates the
    /// words of the first one, and the second has as many.
    pub fn of_two(first: &str, second: &str) -> Self {
        let [words, of_second] = [first, second].map(|line| line.split_whitespace().count());
        match Self::of(first) {
            Self::Comma if !first.contains(',') && words > 1 && words == of_second => Self::Blanks,
            separator => separator,
        }
    }

    fn parts_at(self, letter: char) -> bool {
        match self {
            Self::Comma => letter == ',',
            Self::Semicolon => letter == ';',
            Self::Tab => letter == '\t',
            Self::Blanks => letter.is_whitespace(),
        }
    }

    /// The fields of a line without blanks and quotation marks, with their columns in the text.
    pub fn fields(self, line: &str) -> impl Iterator<Item = (usize, &str)> {
        let mut start = 0;
        let fields = line.split(move |letter| self.parts_at(letter));
        let fields = fields.map(move |field| {
            let blanks = field.chars().take_while(|c| c.is_whitespace()).count();
            let column = start + blanks + 1;
            start += field.chars().count() + 1;
            (column, field.trim().trim_matches('"'))
        });
        fields.filter(move |(_, field)| self != Self::Blanks || !field.is_empty())
    }

    /// A number, with a decimal comma where commas do not separate.
    pub fn number(self, text: &str) -> Option<f64> {
        match self {
            Self::Semicolon | Self::Tab | Self::Blanks if text.matches(',').count() == 1 => {
                text.replace(',', ".").parse().ok()
            }
            _ => text.parse().ok(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn blanks_separate_where_both_lines_have_as_many_words() {
        let of = Separator::of_two;
        assert_eq!(of("angle  friction", "0 0,3"), Separator::Blanks);
        assert_eq!(of("angle (deg) friction", "0 0.3"), Separator::Comma);
        assert_eq!(of("angle, friction", "0, 0.3"), Separator::Comma);
        let fields: Vec<_> = Separator::Blanks.fields(" 30   0,3 ").collect();
        assert_eq!(fields, [(2, "30"), (7, "0,3")]);
        assert_eq!(Separator::Blanks.number("0,3"), Some(0.3));
    }
}
