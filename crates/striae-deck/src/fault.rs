//! Faults of a deck, with the messages shown to its author.
//!
//! Faults of what the deck describes are those of the model, [`striae_model::FaultKind`].
//!
//! Longer than other files, as it is the one list of all faults with their messages.

use striae_model::NoFunction;

/// One kind of fault with the names and numbers that explain it.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum FaultKind {
    /// The file cannot be read at all.
    #[error("the deck cannot be read: {cause}")]
    Unreadable {
        /// Error of the operating system.
        cause: String,
    },
    /// The bytes are no text.
    #[error("the deck is not valid UTF-8; save it as text in UTF-8")]
    NotText,
    /// The text is not TOML.
    #[error("not valid TOML: {message}")]
    Syntax {
        /// Message of the parser.
        message: String,
    },
    /// A key that no table of this place has.
    #[error("unknown key `{key}` in {place}{}", did_you_mean(.nearest))]
    UnknownKey {
        /// The key as written.
        key: String,
        /// The table.
        place: String,
        /// The most similar valid key.
        nearest: Option<String>,
        /// All valid keys.
        known: Vec<String>,
    },
    /// An expression that has no value.
    #[error("this expression cannot be computed: {cause}")]
    Expression {
        /// Reason.
        cause: String,
    },
    /// A text that is no function of position and time.
    #[error(transparent)]
    Function(#[from] NoFunction),
    /// A name of a parameter in a function that is the one of a variable.
    #[error(
        "`{name}` is a parameter and, in the function `{text}`, a coordinate or the time; give the parameter another name"
    )]
    Ambiguous {
        /// The name.
        name: String,
        /// The function.
        text: String,
    },
    /// A file of a curve that cannot be read.
    #[error("curve file `{file}`{}: {cause}", line.map_or(String::new(), |line| format!(", line {line}")))]
    CurveFile {
        /// The file.
        file: String,
        /// Number of the line, counted from 1.
        line: Option<usize>,
        /// Reason and remedy.
        cause: String,
    },
    /// A parameter that no expression can name.
    #[error(
        "`{name}` is not a valid parameter name; use letters, digits and `_`, beginning with a letter, and not `pi`"
    )]
    ParameterName {
        /// The name.
        name: String,
    },
    /// A parameter is set that the deck does not have.
    #[error(
        "`--set {name}=...` does not set a parameter of this deck; {}",
        parameters(known)
    )]
    UnknownParameter {
        /// The name.
        name: String,
        /// Names of its parameters.
        known: Vec<String>,
    },
    /// A path to a number leads nowhere.
    #[error(
        "`{path}` is no number of this deck; {place} has {}{}", or_none(known), mistaken_or_absent(.nearest)
    )]
    UnknownPath {
        /// The path.
        path: String,
        /// The part of it that is there.
        place: String,
        /// Keys and names in that part.
        known: Vec<String>,
        /// The most similar of them.
        nearest: Option<String>,
    },
    /// A path to a number leads to something else.
    #[error("`{path}` is no number but {found}{}", with(known))]
    NoNumber {
        /// The path.
        path: String,
        /// The value that is there.
        found: String,
        /// Keys and names in that part.
        known: Vec<String>,
    },
    /// A file that cannot be included.
    #[error("`{file}` cannot be included: {cause}")]
    Include {
        /// The file as written.
        file: String,
        /// Reason.
        cause: String,
    },
    /// A part that a mesh file does not have.
    #[error("`{file}` has no element set or instance `{name}`; it has {}{}", or_none(known), did_you_mean(.nearest))]
    NoPart {
        /// The file as written.
        file: String,
        /// The name.
        name: String,
        /// Names of its element sets and instances.
        known: Vec<String>,
        /// The most similar of them.
        nearest: Option<String>,
    },
    /// A mesh that would take more memory than there is.
    #[error(
        "the mesh of body `{body}` would have {elements} elements and need about {:.1} GB in a run, but only {:.1} GB are available; use fewer divisions or larger elements",
        needed / 1e9, available / 1e9
    )]
    MeshMemory {
        /// The body.
        body: String,
        /// Its elements.
        elements: u128,
        /// Bytes to make it, check it and run with it.
        needed: f64,
        /// Bytes that there are.
        available: f64,
    },
    /// A required key is absent.
    #[error("missing key `{key}` in {place}; expected {expected}")]
    MissingKey {
        /// The key.
        key: String,
        /// The table.
        place: String,
        /// Expected value.
        expected: String,
    },
    /// A value of the wrong type or outside its range.
    #[error("{place} must be {expected}, but is {found}")]
    Unexpected {
        /// The key and its table.
        place: String,
        /// Requirement on the value.
        expected: String,
        /// Value found.
        found: String,
    },
    /// A text that is not one of the allowed words.
    #[error("{place} cannot be `{found}`; expected one of {}{}", quoted(.allowed), did_you_mean(.nearest))]
    UnknownWord {
        /// The key and its table.
        place: String,
        /// The text as written.
        found: String,
        /// The words allowed.
        allowed: Vec<String>,
        /// The most similar of them.
        nearest: Option<String>,
    },
    /// None of several exclusive groups of keys is given.
    #[error("{place} needs either {}", .choices.join(" or "))]
    NoneOf {
        /// The table.
        place: String,
        /// The groups.
        choices: Vec<String>,
    },
    /// Keys of exclusive groups are given together.
    #[error("`{first}` and `{second}` exclude each other in {place}; give either {}", .choices.join(" or "))]
    Exclusive {
        /// A key of one group.
        first: String,
        /// A key of another group.
        second: String,
        /// The table.
        place: String,
        /// The groups.
        choices: Vec<String>,
    },
    /// A step of more increments than any run makes.
    #[error("step `{step}` would have more than {most:e} increments; take fewer or larger ones")]
    Increments {
        /// The step.
        step: String,
        /// Largest number allowed.
        most: f64,
    },
    /// Two things of one kind have the same name.
    #[error("{kind} `{name}` is already defined {place}")]
    DuplicateName {
        /// Body, material, ...
        kind: &'static str,
        /// The name.
        name: String,
        /// Place of the first definition, such as `in line 4`.
        place: String,
    },
    /// A curve takes the name of a built-in one.
    #[error("`{name}` is a built-in curve; give this one another name")]
    ReservedName {
        /// The name.
        name: String,
    },
    /// A set of the deck takes the name of another.
    #[error("body `{body}` already has {} set `{name}`", article(.kind))]
    DuplicateSet {
        /// The body.
        body: String,
        /// Node, facet or element.
        kind: &'static str,
        /// The set.
        name: String,
    },
    /// A set that nothing of the body is in.
    #[error("{kind} set `{name}` of body `{body}` is empty: {cause}")]
    NothingChosen {
        /// The body.
        body: String,
        /// Node, facet or element.
        kind: &'static str,
        /// The set.
        name: String,
        /// Reason, or the extent of the body.
        cause: String,
    },
    /// A set that needs itself.
    #[error(
        "{kind} set `{name}` of body `{body}` is made from itself{}; start from a set of the mesh, a region or numbers", by_way_of(.over)
    )]
    CircularSet {
        /// The body.
        body: String,
        /// Node, facet or element.
        kind: &'static str,
        /// The set.
        name: String,
        /// The sets between, each needed by the one before.
        over: Vec<String>,
    },
    /// A facet of a surface written in the deck names a node that is not there.
    #[error(
        "facet {facet} of rigid surface `{surface}` refers to node {node}, but there are {nodes} nodes counted from 0"
    )]
    MissingNode {
        /// The rigid surface.
        surface: String,
        /// Position of the facet, from 0.
        facet: usize,
        /// The node it names.
        node: usize,
        /// Number of nodes.
        nodes: usize,
    },
    /// Materials of a mesh file that cannot be used.
    #[error("the materials of the mesh of body `{body}` cannot be used: {cause}")]
    FileMaterials {
        /// The body.
        body: String,
        /// Description of the fault.
        cause: String,
    },
    /// A density of what is no solid.
    #[error("the inertia of rigid body `{rigid}` cannot be computed from its density: {cause}")]
    RigidSolid {
        /// The rigid body.
        rigid: String,
        /// Description of the fault.
        cause: String,
    },
    /// Friction constants that the law refuses.
    #[error("this friction is not admissible: {cause}")]
    Friction {
        /// Message of the law.
        cause: String,
    },
    /// A texture refuses a value, by this reason.
    #[error("the texture is not admissible: {0}")]
    Texture(String),
    /// A texture that cannot be read from its file.
    #[error("the texture of {owner} cannot be read: {cause}")]
    NodalTexture {
        /// The body or rigid surface.
        owner: String,
        /// Message of the reader.
        cause: String,
    },
    /// Two probes have the same name.
    #[error("there is another probe `{name}`")]
    ProbeTwice {
        /// The name.
        name: String,
    },
    /// A probe is nowhere.
    #[error("probe `{name}` cannot be placed: {cause}")]
    Probe {
        /// Its name.
        name: String,
        /// Description of the fault.
        cause: String,
    },
    /// Two sections have the same name.
    #[error("there is another section `{name}`")]
    SectionTwice {
        /// The name.
        name: String,
    },
    /// A section does not cut its body.
    #[error("section `{name}` does not cut its body: {cause}")]
    Section {
        /// Its name.
        name: String,
        /// Error of the section.
        cause: striae_solve::section::SectionError,
    },
    /// A deck without bodies or steps.
    #[error("the deck has no [[{key}]]; {need}")]
    Nothing {
        /// `body` or `step`.
        key: &'static str,
        /// Reason why one is needed.
        need: &'static str,
    },
    /// A solver of a run without ranks that only ranks have.
    #[error(
        "`backend = \"mumps\"` needs PETSc: build with `--features petsc` and run with `--petsc` or under `mpirun`; `backend = \"multifrontal\"` is a direct solver that needs neither"
    )]
    Together,
    /// The deck describes an impossible model.
    #[error(transparent)]
    Model(Box<striae_model::FaultKind>),
}

impl From<striae_model::FaultKind> for FaultKind {
    fn from(kind: striae_model::FaultKind) -> Self {
        Self::Model(Box::new(kind))
    }
}

impl FaultKind {
    /// More than the message says, for a line of its own.
    pub(crate) fn hint(&self) -> Option<String> {
        match self {
            Self::UnknownKey { known, .. } => Some(format!("valid keys: {}", quoted(known))),
            _ => None,
        }
    }
}

fn parameters(known: &[String]) -> String {
    match known {
        [] => "it has no [parameters]".to_owned(),
        known => format!("its [parameters] are {}", quoted(known)),
    }
}

fn did_you_mean(nearest: &Option<String>) -> String {
    nearest
        .as_ref()
        .map_or_else(String::new, |name| format!("; did you mean `{name}`?"))
}

fn mistaken_or_absent(nearest: &Option<String>) -> String {
    match nearest {
        Some(_) => did_you_mean(nearest),
        None => "; a number that the deck leaves to its default must be stated there first".into(),
    }
}

fn quoted(words: &[String]) -> String {
    let words: Vec<String> = words.iter().map(|word| format!("`{word}`")).collect();
    words.join(", ")
}

fn or_none(words: &[String]) -> String {
    match words {
        [] => "none".to_owned(),
        _ => quoted(words),
    }
}

fn with(words: &[String]) -> String {
    match words {
        [] => String::new(),
        _ => format!("; it has {}", quoted(words)),
    }
}

fn article(kind: &str) -> String {
    let article = if kind.starts_with('e') { "an" } else { "a" };
    format!("{article} {kind}")
}

fn by_way_of(sets: &[String]) -> String {
    match sets {
        [] => String::new(),
        sets => format!(" over {}", sets.join(", ")),
    }
}
