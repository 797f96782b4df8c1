//! Friction laws and materials.

use striae_law::{
    bulk::{
        Branch, Direction, FibreStiffness, Fibres, Hardening, HardeningForm, Hyperelastic,
        Isochoric, LinesAbout, Material, OgdenTerm, Volumetric,
    },
    declared::{Kind, Statement, Value, Values, degrees},
    friction::{DECAY, Friction},
};

use super::value::{list, number, text, vector};

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
    let value = |value: &Value| match value {
        Value::Number(value) => number(*value),
        Value::Numbers(values) => list(values.iter().copied().map(number)),
        Value::Word(word) => text(word),
    };
    let values = values.iter();
    values
        .map(|(key, of)| format!(", {key} = {}", value(of)))
        .collect()
}

/// Lines of a material but for its name; `None` for a law that decks have no table for, as of
/// one's own.
pub(crate) fn material(of: &Material) -> Option<String> {
    match of {
        Material::NeoHookean {
            lambda,
            shear,
            volumetric: form,
        } => {
            let constants = [("lambda", *lambda), ("shear_modulus", *shear)];
            Some(stated("neo-hookean", &constants) + volumetric(*form))
        }
        Material::LinearElastic { lambda, shear } => {
            let constants = [("lambda", *lambda), ("shear_modulus", *shear)];
            Some(stated("linear-elastic", &constants))
        }
        Material::Hyperelastic(rubber) => Some(hyperelastic(rubber)),
        Material::Viscoelastic(law) => {
            let branch = |branch: &Branch| {
                let (ratio, time) = (number(branch.ratio), number(branch.time));
                format!("{{ ratio = {ratio}, time = {time} }}")
            };
            let branches = list(law.branches().iter().map(branch));
            Some(hyperelastic(law.slow()) + &format!("relaxation = {branches}\n"))
        }
        Material::Plastic(law) => {
            let of = law.lame_constants();
            let constants = [("lambda", of.lambda), ("shear_modulus", of.shear)];
            Some(stated("elastic-plastic", &constants) + &hardening(law.hardening()))
        }
        Material::Fibrous(law) => {
            let families = list(law.families().iter().map(fibres));
            Some(material(law.ground())? + &format!("fibres = {families}\n"))
        }
        _ => None,
    }
}

fn fibres(family: &Fibres) -> String {
    let stiffness = match family.stiffness {
        FibreStiffness::Exponential { k1, k2, dispersion } => {
            let [k1, k2, dispersion] = [k1, k2, dispersion].map(number);
            format!("k1 = {k1}, k2 = {k2}, dispersion = {dispersion}")
        }
        FibreStiffness::Linear { modulus } => format!("modulus = {}", number(modulus)),
    };
    let direction = match &family.direction {
        Direction::Uniform(direction) => format!("uniform = {}", vector(direction)),
        Direction::About { point, axis, lines } => {
            let (point, direction) = (vector(point), vector(axis));
            let axis = format!("{{ point = {point}, direction = {direction} }}");
            let turned = |turn: f64| format!(", turn = {}", number(degrees(turn)));
            match *lines {
                LinesAbout::Axial { turn } => format!("axial = {axis}{}", turned(turn)),
                LinesAbout::Circumferential { turn } => {
                    format!("circumferential = {axis}{}", turned(turn))
                }
                LinesAbout::Radial => format!("radial = {axis}"),
            }
        }
    };
    format!("{{ {stiffness}, direction = {{ {direction} }} }}")
}

/// The name of a law and constants of it.
fn stated(law: &str, constants: &[(&str, f64)]) -> String {
    let constant = |(key, value): &(&str, f64)| format!("{key} = {}\n", number(*value));
    let constants: String = constants.iter().map(constant).collect();
    format!("law = \"{law}\"\n{constants}")
}

fn volumetric(form: Volumetric) -> &'static str {
    match form {
        Volumetric::Quadratic => "volumetric = \"quadratic\"\n",
        Volumetric::Logarithmic => "volumetric = \"logarithmic\"\n",
    }
}

fn hyperelastic(rubber: &Hyperelastic) -> String {
    let isochoric = match rubber.isochoric() {
        Isochoric::NeoHookean { shear } => {
            stated("isochoric-neo-hookean", &[("shear_modulus", *shear)])
        }
        Isochoric::MooneyRivlin { c10, c01 } => {
            stated("mooney-rivlin", &[("c10", *c10), ("c01", *c01)])
        }
        Isochoric::Yeoh { c10, c20, c30 } => {
            stated("yeoh", &[("c10", *c10), ("c20", *c20), ("c30", *c30)])
        }
        Isochoric::Gent { shear, limit } => {
            stated("gent", &[("shear_modulus", *shear), ("limit", *limit)])
        }
        Isochoric::ArrudaBoyce {
            mu,
            locking_stretch,
        } => stated(
            "arruda-boyce",
            &[("mu", *mu), ("locking_stretch", *locking_stretch)],
        ),
        Isochoric::Ogden(terms) => {
            let term = |term: &OgdenTerm| {
                let (mu, alpha) = (number(term.mu), number(term.alpha));
                format!("{{ mu = {mu}, alpha = {alpha} }}")
            };
            let terms = list(terms.iter().map(term));
            stated("ogden", &[]) + &format!("terms = {terms}\n")
        }
    };
    let bulk = format!("bulk_modulus = {}\n", number(rubber.bulk()));
    isochoric + &bulk + volumetric(rubber.volumetric())
}

fn hardening(hardening: &Hardening) -> String {
    match hardening.form() {
        HardeningForm::Smooth {
            yield_stress,
            modulus,
            saturation,
            rate,
        } => {
            let [first, modulus] = [*yield_stress, *modulus].map(number);
            let mut text = format!("yield_stress = {first}\nhardening_modulus = {modulus}\n");
            if *rate > 0.0 {
                let [stress, rate] = [*saturation, *rate].map(number);
                text += &format!("saturation = {{ stress = {stress}, rate = {rate} }}\n");
            }
            text
        }
        HardeningForm::Table(pairs) => {
            let pair =
                |[strain, stress]: &[f64; 2]| format!("[{}, {}]", number(*strain), number(*stress));
            format!("yield_table = {}\n", list(pairs.iter().map(pair)))
        }
    }
}
