//! Forms of the values a deck may contain: what the reader accepts, what it
//! says it expects, what the JSON schema and the reference list.

use striae_declared::Bound;

/// The form of a value.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Form {
    /// A text that is not empty.
    Text,
    /// `true` or `false`.
    Truth,
    /// A finite number within bounds.
    Number(&'static [Bound]),
    /// A whole number not below a least one.
    Whole(usize),
    /// A number or the text of a function of position and time.
    Varying,
    /// A table of numbers or expressions with any names.
    NamedNumbers,
    /// The name of a law, beside the keys of its parameters.
    Law(Open),
    /// One of several words.
    Words(Vec<(&'static str, &'static str)>),
    /// A list, of a fixed length or any.
    List(Box<Form>, Option<usize>),
    /// A table of one of several compositions.
    Table(Vec<Alternative>),
    /// Any of several forms.
    Any(Vec<Form>),
}

/// A kind of laws to which programs may add.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Open {
    /// Friction.
    Friction,
    /// Bulk laws.
    Bulk,
    /// Textures, told by the keys of their parameters.
    Texture,
}

/// One composition of a table.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Alternative {
    /// Description of the key.
    pub(crate) doc: String,
    /// Its keys.
    pub(crate) keys: Vec<Key>,
}

/// A key of a table.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Key {
    pub(crate) name: &'static str,
    pub(crate) doc: String,
    pub(crate) need: Need,
    pub(crate) form: Form,
}

/// Necessity of a key.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Need {
    /// The key is required.
    Required,
    /// The key may be absent.
    Optional,
}

impl Form {
    /// Expected kind of value, with an article.
    pub(crate) fn expected(&self) -> String {
        match self {
            Self::Text => "a text".into(),
            Self::Truth => "true or false".into(),
            Self::Number(bounds) => format!("a number{}", bounded(bounds)),
            Self::Whole(least) => format!("a whole number of at least {least}"),
            Self::Varying => {
                "a number or a function of `x`, `y`, `z` and `t`, such as \"0.1*x*sin(2*pi*t)\""
                    .into()
            }
            Self::NamedNumbers => "a table of numbers".into(),
            Self::Law(_) => "the name of a law".into(),
            Self::Words(words) => format!("one of {}", ticked(words.iter().map(|(word, _)| *word))),
            Self::List(of, None) => format!("a list of {}", of.plural()),
            Self::List(of, Some(length)) => format!("a list of {length} {}", of.plural()),
            Self::Table(_) => "a table".into(),
            Self::Any(forms) => {
                let forms: Vec<String> = forms.iter().map(Form::expected).collect();
                forms.join(" or ")
            }
        }
    }

    fn plural(&self) -> String {
        match self {
            Self::Text => "texts".into(),
            Self::Truth => "truths".into(),
            Self::Number(bounds) => format!("numbers{}", bounded(bounds)),
            Self::Whole(least) => format!("whole numbers of at least {least}"),
            Self::Varying => "numbers or functions of `x`, `y`, `z` and `t`".into(),
            Self::NamedNumbers => "tables of numbers".into(),
            Self::Law(_) => "names of laws".into(),
            Self::Words(words) => {
                format!("the words {}", ticked(words.iter().map(|(word, _)| *word)))
            }
            Self::List(of, Some(2)) => format!("pairs of {}", of.plural()),
            Self::List(of, _) => format!("lists of {}", of.plural()),
            Self::Table(_) => "tables".into(),
            Self::Any(forms) => {
                let forms: Vec<String> = forms.iter().map(Form::plural).collect();
                forms.join(" or ")
            }
        }
    }
}

impl Alternative {
    /// An alternative without keys yet.
    pub(crate) fn new(doc: &[&str]) -> Self {
        Self {
            doc: joined(doc),
            keys: Vec::new(),
        }
    }

    /// Names of the keys that must be given.
    pub(crate) fn required(&self) -> impl Iterator<Item = &'static str> {
        self.keys
            .iter()
            .filter(|key| key.need == Need::Required)
            .map(|key| key.name)
    }
}

/// Lines of a doc comment as one.
pub(crate) fn joined(lines: &[&str]) -> String {
    let lines: Vec<&str> = lines.iter().map(|line| line.trim()).collect();
    lines.join(" ")
}

/// Words in ticks, separated by commas.
pub(crate) fn ticked<'w>(words: impl IntoIterator<Item = &'w str>) -> String {
    let words: Vec<String> = words.into_iter().map(|word| format!("`{word}`")).collect();
    words.join(", ")
}

fn bounded(bounds: &[Bound]) -> String {
    let bounds: Vec<String> = bounds
        .iter()
        .map(|bound| match bound {
            Bound::Above(limit) => format!("greater than {limit}"),
            Bound::AtLeast(limit) => format!("of at least {limit}"),
            Bound::Below(limit) => format!("less than {limit}"),
            Bound::AtMost(limit) => format!("of at most {limit}"),
        })
        .collect();
    if bounds.is_empty() {
        String::new()
    } else {
        format!(" {}", bounds.join(" and "))
    }
}
