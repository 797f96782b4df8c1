//! Remedies that the library states as keys of decks, in the words of Python.

/// Statements in decks and in Python.
const WORDS: [(&str, &str); 12] = [
    ("`stabilise = true`", "`stabilise=True`"),
    ("`dynamics = {}`", "`dynamics=Dynamics()`"),
    (
        "`texture = { uniform = [1, 0, 0] }`",
        "`texture=(1, 0, 0)` of a rigid body or `textured((1, 0, 0))` of a set",
    ),
    (
        "name the textured facets as `of` of a `[[contact.surface]]`, and as `a` or `b` of a `[[contact.between]]` that gives",
        "name the textured facets in `textures` of `contact_all`, and in a tuple of its `between` that gives",
    ),
    (
        "add a [[pair]] or a [[tie]], or in contact of everything remove the `exclude` of their contact",
        "add a `Pair` or a `Tie`, or remove the `exclude` of their contact in `contact_all`",
    ),
    ("`initial = \"close\"`", "`initial=\"close\"`"),
    ("`initial = \"resolve\"`", "`initial=\"resolve\"`"),
    (
        " (`initial = { close = 0 }` closes none)",
        " (a length as `initial` closes gaps up to it)",
    ),
    ("`b = \"itself\"`", "`b=\"itself\"`"),
    ("`formulation = \"", "`formulation=\""),
    ("`law = \"orthotropic\"`", "`Orthotropic`"),
    ("`free = [", "`free=["),
];

/// Returns a message of the library with its remedies in the words of Python.
pub fn in_python(message: &impl ToString) -> String {
    let message = message.to_string();
    let words = WORDS.iter();
    words.fold(message, |message, (deck, python)| {
        message.replace(deck, python)
    })
}
