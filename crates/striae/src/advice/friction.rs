//! Coefficients of friction over all directions, in the user's own constants.

use striae_law::friction::{
    Coefficient, Friction, Healing, HealingCourse, Law, RateAndState, RequiredTextures,
};
use striae_mesh::significant;
use striae_model::{Model, Pair};

use super::{Advice, Topic};

/// Coefficient above which there is a warning.
const LARGEST: f64 = 2.0;
/// Smallest over largest coefficient that is as good as none.
const NONE: f64 = 0.02;

/// Notes the range of every friction, and warns where one direction has none.
pub(super) fn look(model: &Model, advice: &mut Advice) {
    for pair in &model.pairs {
        of_pair(&pair.name, "", &pair.friction, advice);
        unused(model, pair, advice);
    }
    for step in &model.steps {
        for (pair, friction) in &step.frictions {
            let when = format!(" from step `{}` on", step.name);
            of_pair(&model.pairs[pair.0].name, &when, friction, advice);
        }
    }
}

/// Notes textures that no friction of a pair uses.
fn unused(model: &Model, pair: &Pair, advice: &mut Advice) {
    let changes = model.steps.iter().flat_map(|step| &step.frictions);
    let changes = changes.filter(|(of, _)| model.pairs[of.0].name == pair.name);
    let mut all = changes
        .map(|(_, friction)| friction)
        .chain([&pair.friction]);
    let unused = all.all(|friction| matches!(friction.law(), Law::Frictionless | Law::Coulomb));
    if unused && pair.textures.iter().any(Option::is_some) {
        let name = &pair.name;
        let text = format!(
            "pair `{name}` has a texture, but its friction is the same in all directions; the simplest law that uses a texture is `law = \"orthotropic\"`"
        );
        advice.note(Topic::Friction, name, text);
    }
}

fn of_pair(name: &str, when: &str, friction: &Friction, advice: &mut Advice) {
    of_dependences(name, when, friction, advice);
    if matches!(friction.law(), Law::Coulomb) && friction.coefficient().at_rest() > LARGEST {
        let mu = friction.coefficient().at_rest();
        large(name, when, mu, advice);
    }
    if matches!(friction.law(), Law::Frictionless | Law::Coulomb) {
        return;
    }
    let [low, high] = friction.range();
    let over = match friction.required_textures() {
        RequiredTextures::Both => "all directions of slip and angles between the textures",
        RequiredTextures::Any | RequiredTextures::One => "all directions of slip",
    };
    let text = format!(
        "pair `{name}`: coefficients of friction{when} are {low:.4} to {high:.4} over {over}"
    );
    if high > LARGEST {
        large(name, when, high, advice);
    }
    if low < NONE * high {
        advice.warn(
            Topic::Friction,
            name,
            format!("{text}: in one of these directions there is hardly any friction"),
        );
    } else {
        advice.note(Topic::Friction, name, text);
    }
}

/// Notes how coefficients depend on pressure and slip rate, and warns where friction falls as
/// the pressure rises.
fn of_dependences(name: &str, when: &str, friction: &Friction, advice: &mut Advice) {
    if friction.is_frictionless() {
        return;
    }
    let coefficient = friction.coefficient();
    let by_pressure = coefficient.by_pressure();
    if by_pressure.is_some() {
        let largest = by_pressure.largest_factor();
        let reach = match largest.is_finite() {
            true => format!("are up to {largest:.4} times those stated"),
            false => "grow with the pressure".to_owned(),
        };
        let text = format!(
            "pair `{name}`: friction{when} is mu P(p) with P(p) = {by_pressure}: coefficients {reach}"
        );
        advice.note(Topic::Friction, name, text);
    }
    let by_slip = coefficient.by_slip();
    if by_slip.is_some() {
        let text = format!(
            "pair `{name}`: coefficients of friction{when} are those stated times {by_slip} with the accumulated slip s, at most times {:.4}",
            by_slip.largest_factor()
        );
        advice.note(Topic::Friction, name, text);
    }
    if let Some(law) = friction.rate_and_state() {
        advice.note(Topic::Friction, name, of_state(name, when, law));
    }
    if let Some(law) = coefficient.by_state().of_healing() {
        advice.note(
            Topic::Friction,
            name,
            of_healing(name, when, coefficient, law),
        );
    }
    if let Some(factor) = coefficient.own() {
        let law = factor.law().name();
        let course = match factor.steepest_fall() > 0.0 {
            true => format!(
                "falls with the slip of an increment by up to {} times the pressure per length; bodies that resist with less, per area, may jump from stick to slip within an increment",
                significant(coefficient.at_rest() * factor.steepest_fall(), 5)
            ),
            false => "does not fall with the slip of an increment".to_owned(),
        };
        let text = format!("pair `{name}`: friction{when} with the factor `{law}` {course}");
        advice.note(Topic::Friction, name, text);
    }
    if let Some([from, to]) = by_pressure.falling() {
        let text = format!(
            "pair `{name}`: friction{when} falls as the pressure rises from {from} to {to}, since factors fall faster than 1/p there; increments may have several solutions. Unless this is measured, make factors times pressures ascend"
        );
        advice.warn(Topic::Friction, name, text);
    }
    if let Some(rate) = friction.weakest_rate() {
        let share = coefficient.at_slip_rate(rate) / coefficient.at_slip_rate(0.0);
        let at = match rate.is_finite() {
            true => format!("at the slip rate {rate:.4}"),
            false => "in fast slip".to_owned(),
        };
        let text = format!(
            "pair `{name}`: friction{when} falls with the slip rate, to {share:.4} of that at rest {at}: bodies may jump from stick to slip within an increment, and steps without inertia do not resolve this motion"
        );
        advice.note(Topic::Friction, name, text);
    }
}

/// Text on friction that depends on rate and state: its steady course, and what increments need.
fn of_state(name: &str, when: &str, law: &RateAndState) -> String {
    let RateAndState {
        direct_effect: a,
        evolution_effect: b,
        slip_distance,
        ..
    } = law;
    let course = match b > a {
        true => format!(
            "falls in faster steady slip, which is unstable on springs below {} times the pressure, (b - a)/D, per area: increments may then have several solutions, and steps without inertia jump. Facets must be smaller than E D/(b p) for slip to grow from a part of the surface",
            significant((b - a) / slip_distance, 5)
        ),
        false => "does not fall in faster steady slip, which is stable".to_owned(),
    };
    format!(
        "pair `{name}`: friction{when} depends on rate and state and {course}. Slip in an increment should be some tenths of D = {slip_distance}, and steps must have their true durations",
        slip_distance = significant(*slip_distance, 5)
    )
}

/// Text on friction that falls with slip and heals: its extremes, and what increments need.
fn of_healing(name: &str, when: &str, coefficient: &Coefficient, law: &Healing) -> String {
    let course = match law.course {
        HealingCourse::Exponential {
            kinetic_over_static,
        } => format!(
            "falls with slip to {kinetic_over_static:.4} of that stated and heals at rest in the time {}",
            significant(law.healing_time, 5)
        ),
        HealingCourse::Logarithmic { factor } => format!(
            "rises at rest by {factor:.4} of that stated for each factor of e of the time, from {} on, and falls with slip",
            significant(law.healing_time, 5)
        ),
    };
    format!(
        "pair `{name}`: friction{when} {course}. Bodies that resist with less than {} times the pressure, per area, may jump from stick to slip within an increment; slip in an increment should be some tenths of D = {}, and steps must have their true durations",
        significant(coefficient.at_rest() * law.largest_weakening(), 5),
        significant(law.slip_distance, 5)
    )
}

fn large(name: &str, when: &str, mu: f64, advice: &mut Advice) {
    advice.warn(
        Topic::Friction,
        name,
        format!(
            "pair `{name}`: coefficients of friction{when} reach {mu:.4}; values above {LARGEST} are hardly intended. They are not percentages or angles"
        ),
    );
}
