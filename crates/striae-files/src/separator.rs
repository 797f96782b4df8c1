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

    fn letter(self) -> char {
        match self {
            Self::Comma => ',',
            Self::Semicolon => ';',
            Self::Tab => '\t',
        }
    }

    /// The fields of a line without blanks and quotation marks, with their columns in the text.
    pub fn fields(self, line: &str) -> impl Iterator<Item = (usize, &str)> {
        let mut start = 0;
        line.split(self.letter()).map(move |field| {
            let blanks = field.chars().take_while(|c| c.is_whitespace()).count();
            let column = start + blanks + 1;
            start += field.chars().count() + 1;
            (column, field.trim().trim_matches('"'))
        })
    }

    /// A number, with a decimal comma where commas do not separate.
    pub fn number(self, text: &str) -> Option<f64> {
        match self {
            Self::Semicolon | Self::Tab if text.matches(',').count() == 1 => {
                text.replace(',', ".").parse().ok()
            }
            _ => text.parse().ok(),
        }
    }
}
