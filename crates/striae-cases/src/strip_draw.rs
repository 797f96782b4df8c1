//! `strip-draw`: a strip of rolled sheet is drawn between flat dies, at angles to its
//! rolling direction.
//!
//! With the rolling direction at the angle `phi` to the pull, friction along and across it
//! `m_s` and `m_a`, and the force `N` between the dies, the strip slips along the pull and
//! takes
//!
//! ```text
//! opposing slip    pull    2 N (m_s cos^2 + m_a sin^2)      sideways 2 N (m_a - m_s) sin cos
//! associated slip  pull    2 N D, D^2 = m_s^2 cos^2 + m_a^2 sin^2
//!                  sideways 2 N (m_a^2 - m_s^2) sin cos / D
//! ```

use striae_figure::{Axis, Color, Content, Figure, Marker, Panel, Series, Width};
use striae_law::friction::{Friction, SlipRule};
use striae_mesh::Vec3;
use striae_surface::texture::{Field, Lines, Paint};

use super::{
    measure::law_error,
    study::{Extent, Run, Study},
};
use crate::failure::Failure;

const DECKS: [(&str, &str); 1] = decks!("strip-draw": "deck");
/// Coefficients along and across the rolling direction.
const MU: [f64; 2] = [0.1, 0.15];
/// Force between the dies, N.
const FORCE: f64 = 4000.0;
/// Elements in the deck and for a quick look.
const DIVISIONS: [&str; 2] = ["divisions = [26, 8, 2]", "divisions = [13, 4, 1]"];

/// Runs the case.
pub fn run(study: &mut Study) -> Result<(), Failure> {
    let angles: &[u32] = match study.extent {
        Extent::Full => &[0, 15, 30, 45, 60, 75, 90],
        Extent::Quick => &[0, 45, 90],
    };
    let mut drawn = Vec::new();
    for (rule, angle) in angles
        .iter()
        .map(|angle| (SlipRule::Opposing, *angle))
        .chain([(SlipRule::Associated, 45)])
    {
        let run = ran(study, rule, angle)?;
        drawn.push(Drawn { rule, angle, run });
    }
    let worst = |of: fn(&Drawn) -> f64| drawn.iter().map(of).fold(0.0, f64::max);
    for one in &drawn {
        if one.angle % 45 == 0 {
            let [pull, sideways] = one.ratios();
            study.measured(format!("{}.pull", one.name()), pull);
            study.measured(format!("{}.sideways", one.name()), sideways);
        }
    }
    study.measured("pull.error", worst(|one| one.errors()[0]));
    study.measured("sideways.error", worst(|one| one.errors()[1]));
    study.measured("law", worst(Drawn::law_error));
    study.measured("grip", worst(Drawn::grip_error));
    study.measured("normal.error", worst(Drawn::normal_error));
    study.measured("energy.imbalance", worst(Drawn::imbalance));
    study.draw(&forces(&drawn), "forces")
}

/// A strip that was drawn.
struct Drawn {
    rule: SlipRule,
    angle: u32,
    run: Run,
}

fn name(rule: SlipRule, angle: u32) -> String {
    match rule {
        SlipRule::Opposing => format!("opposing.{angle}"),
        SlipRule::Associated => format!("associated.{angle}"),
    }
}

fn ran(study: &mut Study, rule: SlipRule, angle: u32) -> Result<Run, Failure> {
    let [(file, text)] = DECKS;
    let mut deck = match study.extent {
        Extent::Full => study.deck(file, text)?,
        Extent::Quick => study.variant(file, text, &[DIVISIONS])?,
    };
    let (sin, cos) = f64::from(angle).to_radians().sin_cos();
    let [along, across] = MU;
    let friction = Friction::orthotropic(along, across, rule).expect("constants of the case");
    for (_, of_pair) in &mut deck.model.steps[1].frictions {
        *of_pair = friction.clone();
    }
    for pair in &mut deck.model.pairs {
        pair.textures[0] = Some(Paint::Field(Field {
            lines: Lines::Uniform(Vec3::new(cos, sin, 0.0)),
            turn: 0.0,
        }));
    }
    study.run(&name(rule, angle).replace('.', "-"), deck)
}

/// Forces along and against the pull over those between the dies, by the law.
fn known(rule: SlipRule, degrees: f64) -> [f64; 2] {
    let (sin, cos) = degrees.to_radians().sin_cos();
    let [along, across] = MU;
    match rule {
        SlipRule::Opposing => [
            along * cos * cos + across * sin * sin,
            (across - along) * sin * cos,
        ],
        SlipRule::Associated => {
            let dissipation = (along * cos).hypot(across * sin);
            let turning = across * across - along * along;
            [dissipation, turning * sin * cos / dissipation]
        }
    }
}

impl Drawn {
    fn name(&self) -> String {
        name(self.rule, self.angle)
    }

    /// Forces of both dies against the pull and sideways over those that press.
    fn ratios(&self) -> [f64; 2] {
        let of = |axis: &str| self.of_dies(axis).iter().sum::<f64>() / (2.0 * FORCE);
        [-of("x"), of("y")]
    }

    /// Forces of the dies on the strip at the end.
    fn of_dies(&self, axis: &str) -> [f64; 2] {
        let force = |die| format!("pair.{die}.resultant_a.{axis}");
        ["below", "above"].map(|die| self.run.at_end_of(2, &force(die)))
    }

    /// Differences from the closed form over its pull.
    fn errors(&self) -> [f64; 2] {
        let known = known(self.rule, f64::from(self.angle));
        let found = self.ratios();
        [0, 1].map(|at| (found[at] - known[at]).abs() / known[0])
    }

    /// Largest difference of friction at a node from the law for its slip.
    fn law_error(&self) -> f64 {
        let pairs = 0..self.run.finished.problem.model.pairs.len();
        let errors = pairs.map(|pair| law_error(&self.run, pair, None));
        errors.fold(0.0, f64::max)
    }

    /// Difference of what holds both ends of the strip from what the dies do to it.
    fn grip_error(&self) -> f64 {
        let held = |end: &str, axis: &str| {
            let name = format!("reaction.strip.{end}.{axis}");
            self.run.at_end_of(2, &name)
        };
        let off = ["x", "y"].map(|axis| {
            let ends = held("xmax", axis) + held("xmin", axis);
            ends + self.of_dies(axis).iter().sum::<f64>()
        });
        off[0].hypot(off[1]) / FORCE
    }

    fn normal_error(&self) -> f64 {
        (self.of_dies("z")[1] / FORCE + 1.0).abs()
    }

    fn imbalance(&self) -> f64 {
        self.run.largest("energy.imbalance") / self.run.largest("energy.external")
    }
}

fn forces(drawn: &[Drawn]) -> Figure {
    let mut panels = vec![
        Panel::new(
            Axis::linear("rolling direction", "°").within(0.0, 90.0),
            Axis::linear("pull / 2N", "").within(0.09, 0.16),
        ),
        Panel::new(
            Axis::linear("rolling direction", "°").within(0.0, 90.0),
            Axis::linear("sideways / 2N", "").within(0.0, 0.06),
        ),
    ];
    for (rule, name, color, marker) in [
        (
            SlipRule::Opposing,
            "opposing slip",
            Color::Blue,
            Marker::Circle,
        ),
        (
            SlipRule::Associated,
            "associated slip",
            Color::Vermillion,
            Marker::Square,
        ),
    ] {
        for (at, panel) in panels.iter_mut().enumerate() {
            let law = (0..=90).map(f64::from);
            let law = law.map(|angle| [angle, known(rule, angle)[at]]).collect();
            let of_rule = drawn.iter().filter(|one| one.rule == rule);
            let found = of_rule.map(|one| [f64::from(one.angle), one.ratios()[at]]);
            let found = Content::markers(found.collect(), marker);
            panel
                .series
                .push(Series::new(name, Content::line(law)).colored(color));
            panel.series.push(Series::new("", found).colored(color));
        }
    }
    Figure::new(Width::Page, panels)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The closed forms are those of the kernel: friction for slip along the pull.
    #[test]
    fn closed_forms_are_those_of_the_law() {
        use striae_law::friction::Textures;
        for rule in [SlipRule::Opposing, SlipRule::Associated] {
            let friction = Friction::orthotropic(MU[0], MU[1], rule).unwrap();
            for degrees in [0.0, 20.0, 45.0, 80.0, 90.0] {
                let (sin, cos) = f64::to_radians(degrees).sin_cos();
                let a = Vec3::z().cross(&Vec3::new(cos, sin, 0.0));
                let textures = Textures {
                    own: Some(a),
                    opposite: None,
                };
                let kernel = friction.kernel(&Vec3::z(), &textures);
                let way = (kernel.k_inverse * Vec3::x()).normalize();
                let tau = kernel.traction(friction.cap(1.0, 0.0), &(way * friction.cap(1.0, 0.0)));
                let [pull, sideways] = known(rule, degrees);
                assert!((tau.x + pull).abs() < 1e-14 && (tau.y - sideways).abs() < 1e-14);
            }
        }
    }
}
