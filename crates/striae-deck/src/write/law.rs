//! Friction laws, textures and materials.

use striae_declared::{Kind, Statement, Value, Values};
use striae_law::{
    bulk::{FibreStiffness, Fibres, Material},
    friction::{DECAY, Friction},
};
use striae_surface::texture::Paint;

use super::value::{lines, list, number, text};

/// The keys of a friction table in braces; `None` for a law of one's own.
pub(super) fn friction(friction: &Friction) -> Option<String> {
    Some(format!("{{ {} }}", friction_keys(friction)?))
}

/// The keys of a friction table.
pub(super) fn friction_keys(friction: &Friction) -> Option<String> {
    let Statement { law, values } = friction.statement()?;
    let mut text = format!("law = \"{law}\"{}", stated_values(values));
    if let Some(cap) = friction.shear_cap() {
        text += &format!(", shear_cap = {}", number(cap));
    }
    let coefficient = friction.coefficient();
    let dependence = |key: &str, statement: Option<&Statement>| match statement {
        Some(Statement { law, values }) => {
            format!(", {key} = {{ form = \"{law}\"{} }}", stated_values(values))
        }
        None => String::new(),
    };
    text += &dependence("by_pressure", coefficient.by_pressure().statement());
    text += &match coefficient.by_rate().statement() {
        Some(Statement { law, values }) if *law == DECAY.name => {
            let values = stated_values(values);
            format!(", {law} = {{ {} }}", values.trim_start_matches(", "))
        }
        statement => dependence("by_slip_rate", statement),
    };
    text += &dependence("by_accumulated_slip", coefficient.by_slip().statement());
    text += &dependence("by_state", coefficient.by_state().statement());
    Some(text)
}

/// The values of parameters, each after a comma.
fn stated_values(values: &Values) -> String {
    let each = stated(values);
    each.map(|one| format!(", {one}")).collect()
}

/// Keys of parameters with their values.
fn stated(values: &Values) -> impl Iterator<Item = String> {
    let values = values.iter();
    values.map(|(key, value)| format!("{key} = {}", stated_value(value)))
}

fn stated_value(value: &Value) -> String {
    let numbers = |values: &[f64]| list(values.iter().copied().map(number));
    let table = |values: &Values| {
        let each: Vec<String> = stated(values).collect();
        format!("{{ {} }}", each.join(", "))
    };
    match value {
        Value::Number(value) => number(*value),
        Value::Numbers(values) => numbers(values),
        Value::Whole(number) => number.to_string(),
        Value::Counts(counts) => list(counts.iter().map(usize::to_string)),
        Value::Word(word) => text(word),
        Value::Pairs(pairs) => list(pairs.iter().map(|pair| numbers(pair))),
        Value::Vectors(vectors) => lines(vectors.iter().map(|vector| numbers(vector))),
        Value::Table(values) => table(values),
        Value::Tables(all) => list(all.iter().map(table)),
    }
}

/// The keys of a texture in braces; `None` for one that no declaration states.
pub(super) fn texture(paint: &Paint) -> Option<String> {
    let Statement { values, .. } = paint.stated()?;
    let each: Vec<String> = stated(&values).collect();
    Some(format!("{{ {} }}", each.join(", ")))
}

/// Lines of a material but for its name; `None` for a law of one's own that is not declared.
pub(crate) fn material(of: &Material) -> Option<String> {
    let Statement { law, values } = of.without_fibres().statement()?;
    let values: String = stated(values).map(|one| one + "\n").collect();
    let mut lines = format!("law = \"{law}\"\n{values}");
    if !of.fibres().is_empty() {
        let families = list(of.fibres().iter().map(fibres));
        lines += &format!("fibres = {families}\n");
    }
    Some(lines)
}

fn fibres(family: &Fibres) -> String {
    let stiffness = match family.stiffness {
        FibreStiffness::Exponential { k1, k2, dispersion } => {
            let [k1, k2, dispersion] = [k1, k2, dispersion].map(number);
            format!("k1 = {k1}, k2 = {k2}, dispersion = {dispersion}")
        }
        FibreStiffness::Linear { modulus } => format!("modulus = {}", number(modulus)),
    };
    let direction: Vec<String> = stated(&family.direction.stated().values).collect();
    let direction = direction.join(", ");
    format!("{{ {stiffness}, direction = {{ {direction} }} }}")
}
