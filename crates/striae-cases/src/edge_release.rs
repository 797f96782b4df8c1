//! `edge-release`: a punch that slides off the edge of a base, and one that is lifted
//! and pressed again.
//!
//! The force while sliding off has to be continuous. Nodes come and go at the start of an
//! increment, so a jump lies between two values. The jump is distinguished from smooth change by
//! lines through the two values before and the two after it, taken to the middle:
//!
//! ```text
//! kink = |(N_2 - (N_3 - N_2)/2) - (N_1 + (N_1 - N_0)/2)|
//! ```
//!
//! which is zero for a parabola, half the change in an increment at most where the
//! slope alone is broken, and the jump where there is one, whatever the increment.

use striae_contact::{side::Side, unknowns::Status};
use striae_deck::Deck;
use striae_figure::{Axis, Content, Figure, Panel, Series, Width};
use striae_solve::outcome::Ending;

use super::study::{Extent, Run, Study};
use crate::failure::Failure;

const DECKS: [(&str, &str); 2] = decks!("edge-release": "slide-off", "lift");
const NORMAL: &str = "pair.interface.resultant_b.z";
const MU: f64 = 0.3;
/// Friction of the three columns of the figure.
const FRICTION: [(&str, &str); 3] = [
    ("frictionless", r#"{ law = "frictionless" }"#),
    ("coulomb", r#"{ law = "coulomb", mu = 0.3 }"#),
    (
        "orthotropic",
        r#"{ law = "orthotropic", mu_along = 0.2, mu_across = 0.4 }"#,
    ),
];
/// Size of the lower face of the punch.
const SIZE: [f64; 2] = [0.62, 0.65];
/// Last strip: overlap of the bodies as meshed over the smaller of the facets' edges.
const STRIP: f64 = 0.1;
/// Distance that the sliding punch passes the edge.
const BEYOND: f64 = 0.02;

/// The step that slides off.
const SLIDE: f64 = 4.0;
/// Way along x before it, in which friction sets in.
const START: f64 = 0.03;

/// A geometry.
struct Scene {
    /// Divisions of base and punch.
    divisions: [usize; 2],
    /// Young's modulus of the punch over that of the base.
    ratio: f64,
    /// Number of the friction law.
    friction: usize,
    /// Direction of sliding from the x axis, degrees.
    angle: f64,
    /// Corner of the punch.
    corner: [f64; 2],
}

/// Result of a run.
struct Trial {
    name: String,
    friction: usize,
    completed: bool,
    /// Cuts before the last strip.
    cuts: usize,
    iterations: usize,
    kink: f64,
    /// Force before it is lost, over that pressed.
    snap: f64,
    /// Relative change of the force between two visits of the same place.
    changes: Vec<f64>,
    excess: f64,
    mismatch: f64,
    /// Distance slid and normal force over that pressed.
    curve: Vec<[f64; 2]>,
}

const fn scene(
    divisions: [usize; 2],
    ratio: f64,
    friction: usize,
    angle: f64,
    corner: [f64; 2],
) -> Scene {
    Scene {
        divisions,
        ratio,
        friction,
        angle,
        corner,
    }
}

/// A quick look takes the first three.
const SCENES: [Scene; 10] = [
    scene([4, 3], 1.0, 0, 0.0, [0.17, 0.13]),
    scene([3, 4], 1.0, 1, 0.0, [0.17, 0.13]),
    scene([6, 4], 10.0, 0, 15.0, [0.17, 0.13]),
    scene([4, 6], 100.0, 1, 30.0, [0.17, 0.175]),
    scene([8, 5], 0.01, 2, 10.0, [0.19, 0.175]),
    scene([5, 8], 1.0, 2, 20.0, [0.11, 0.07]),
    scene([3, 7], 100.0, 0, 25.0, [0.17, 0.13]),
    scene([7, 3], 0.1, 1, 5.0, [0.2, 0.21]),
    scene([6, 6], 1.0, 1, 30.0, [0.17, 0.13]),
    scene([8, 8], 10.0, 2, 0.0, [0.17, 0.13]),
];

/// Runs the case.
pub fn run(study: &mut Study) -> Result<(), Failure> {
    let scenes = match study.extent {
        Extent::Full => &SCENES[..],
        Extent::Quick => &SCENES[..3],
    };
    let (mut off, mut lifted) = (Vec::new(), Vec::new());
    for scene in scenes {
        off.push(slid_off(study, scene)?);
        lifted.push(lift(study, scene)?);
    }
    judge(study, "off", &off);
    judge(study, "lift", &lifted);
    study.measured("kink", largest(off.iter().map(|t| t.kink)));
    study.measured("snap", largest(off.iter().map(|t| t.snap)));
    study.write("table.csv", &table(off.iter().chain(&lifted)))?;
    study.draw(&figure(&off), "force")
}

fn judge(study: &mut Study, kind: &str, trials: &[Trial]) {
    let all = || trials.iter();
    let incomplete = all().filter(|trial| !trial.completed).count();
    study.measured(format!("{kind}.incomplete"), incomplete as f64);
    let cuts: usize = all().map(|trial| trial.cuts).sum();
    study.measured(format!("{kind}.cuts"), cuts as f64);
    let change = |of: &dyn Fn(&Trial) -> bool| {
        largest(
            all()
                .filter(|t| of(t))
                .flat_map(|t| t.changes.iter().copied()),
        )
    };
    let without = change(&|trial| trial.friction == 0);
    study.measured(format!("{kind}.return.frictionless"), without);
    let with = change(&|trial| trial.friction > 0);
    study.measured(format!("{kind}.return.friction"), with);
    let excess = largest(all().filter(|t| t.friction == 1).map(|t| t.excess));
    study.measured(format!("{kind}.excess"), excess);
    let mismatch = largest(all().map(|t| t.mismatch));
    study.measured(format!("{kind}.mismatch"), mismatch);
}

/// NaN counts as the largest.
fn largest(values: impl Iterator<Item = f64>) -> f64 {
    values.fold(0.0, |a, b| if b.is_nan() || b > a { b } else { a })
}

/// Slides the punch off, takes it back and presses it again.
fn slid_off(study: &mut Study, scene: &Scene) -> Result<Trial, Failure> {
    let way = scene.way(1.0 - scene.corner[0] + BEYOND);
    let run = scene.run(
        study,
        DECKS[0],
        &[
            ["x = 0.03, y = 0", &components(scene.way(START))],
            ["x = 0.85, y = 0", &components(way)],
        ],
    )?;
    let pressed = run.at_end_of(2, NORMAL);
    let curve = scene.curve(&run, way);
    let strip = 1.0 - scene.corner[0] - STRIP * scene.smallest_edge();
    let sliding = curve.iter().take_while(|[x, _]| *x < strip);
    let forces: Vec<f64> = sliding.map(|[_, n]| *n).collect();
    let gone = curve.iter().position(|[_, n]| *n < 1e-9);
    let mut trial = scene.trial(&run, "off");
    trial.kink = largest(forces.windows(4).map(kink));
    trial.snap = gone.map_or(f64::NAN, |at| curve[at.max(1) - 1][1]);
    let steps = run.column("step");
    let excused = |row: usize| steps[row] == SLIDE && scene.slid(&run, row, way) >= strip;
    trial.cuts = cuts(&run, excused);
    trial.iterations = iterations(&run, excused);
    trial.changes = vec![(run.at_end_of(8, NORMAL) / pressed - 1.0).abs()];
    trial.curve = curve;
    trial.note(study, &run);
    Ok(trial)
}

/// Lifts the punch in part and presses it again, lifts it off and presses it again.
fn lift(study: &mut Study, scene: &Scene) -> Result<Trial, Failure> {
    let way = components(scene.way(0.1));
    let run = scene.run(study, DECKS[1], &[["x = 0.1, y = 0", &way]])?;
    let slid = run.at_end_of(3, NORMAL);
    let mut trial = scene.trial(&run, "lift");
    trial.cuts = cuts(&run, |_| false);
    trial.iterations = iterations(&run, |_| false);
    trial.changes = [6, 9]
        .map(|step| (run.at_end_of(step, NORMAL) / slid - 1.0).abs())
        .to_vec();
    trial.note(study, &run);
    Ok(trial)
}

fn kink(forces: &[f64]) -> f64 {
    let before = forces[1] + 0.5 * (forces[1] - forces[0]);
    let after = forces[2] - 0.5 * (forces[3] - forces[2]);
    (after - before).abs()
}

/// Cuts in increments that are not excused.
fn cuts(run: &Run, excused: impl Fn(usize) -> bool) -> usize {
    let total = run.column("cutbacks");
    let new = |row: usize| total[row] - row.checked_sub(1).map_or(0.0, |before| total[before]);
    let judged = (0..total.len()).filter(|row| !excused(*row));
    judged.map(|row| new(row) as usize).sum()
}

/// Most iterations of an increment that is not excused.
fn iterations(run: &Run, excused: impl Fn(usize) -> bool) -> usize {
    let all = run.column("iterations").into_iter().enumerate();
    let judged = all.filter(|(row, _)| !excused(*row));
    judged.map(|(_, count)| count as usize).max().unwrap_or(0)
}

fn components([x, y]: [f64; 2]) -> String {
    format!("x = {x:.6}, y = {y:.6}")
}

impl Scene {
    /// The way to go for a distance along x.
    fn way(&self, x: f64) -> [f64; 2] {
        [x, x * self.angle.to_radians().tan()]
    }

    fn smallest_edge(&self) -> f64 {
        let [base, punch] = self.divisions.map(|n| n as f64);
        (1.0 / base).min(SIZE[0] / punch)
    }

    fn name(&self, kind: &str) -> String {
        let [base, punch] = self.divisions;
        let (friction, _) = FRICTION[self.friction];
        format!(
            "{kind}-{base}-{punch}-{}-{friction}-{}",
            self.ratio, self.angle
        )
    }

    fn run(
        &self,
        study: &mut Study,
        (name, text): (&str, &str),
        passages: &[[&str; 2]],
    ) -> Result<Run, Failure> {
        let deck = self.deck(study, (name, text), passages)?;
        study.run_to_limit(&self.name(name), deck)
    }

    fn deck(
        &self,
        study: &Study,
        (name, text): (&str, &str),
        passages: &[[&str; 2]],
    ) -> Result<Deck, Failure> {
        let [base, punch] = self.divisions.map(|n| [n, n, (n / 2).max(2)]);
        let base = format!("size = [1, 1, 0.5], divisions = {base:?}");
        let punch = format!(
            "origin = [{}, {}, 0], size = [0.62, 0.65, 0.5], divisions = {punch:?}",
            self.corner[0], self.corner[1]
        );
        let modulus = format!("youngs_modulus = {}\n", self.ratio);
        let mut all = passages.to_vec();
        all.extend([
            ["size = [1, 1, 0.5], divisions = [4, 4, 2]", base.as_str()],
            [
                "origin = [0.17, 0.13, 0], size = [0.62, 0.65, 0.5], divisions = [3, 3, 2]",
                &punch,
            ],
            ["youngs_modulus = 100\n", &modulus],
            [FRICTION[0].1, FRICTION[self.friction].1],
        ]);
        if self.friction != 2 {
            all.push([", texture = { uniform = [2, 1, 0] }", ""]);
        }
        study.variant(name, text, &all)
    }

    /// Distance slid along x at a row of the step that slides off.
    fn slid(&self, run: &Run, row: usize, way: [f64; 2]) -> f64 {
        let share = run.column("time")[row] - (SLIDE - 1.0);
        START + share * (way[0] - START)
    }

    /// Distance along x and force relative to that after pressing, at the requested increments.
    fn curve(&self, run: &Run, way: [f64; 2]) -> Vec<[f64; 2]> {
        const INCREMENTS: f64 = 200.0;
        let pressed = run.at_end_of(2, NORMAL);
        let (steps, times, forces) = (run.column("step"), run.column("time"), run.column(NORMAL));
        let asked = |row: &usize| {
            let place = (times[*row] - SLIDE + 1.0) * INCREMENTS;
            steps[*row] == SLIDE && (place - place.round()).abs() < 1e-6
        };
        let rows = (0..steps.len()).filter(asked);
        rows.map(|row| [self.slid(run, row, way), forces[row] / pressed])
            .collect()
    }

    fn trial(&self, run: &Run, kind: &str) -> Trial {
        Trial {
            name: self.name(kind),
            friction: self.friction,
            completed: matches!(run.finished.ending, Ending::Completed),
            cuts: 0,
            iterations: 0,
            kink: 0.0,
            snap: 0.0,
            changes: Vec::new(),
            excess: excess(run),
            mismatch: run.largest("pair.interface.mismatch"),
            curve: Vec::new(),
        }
    }
}

/// Excess of friction over Coulomb's law at the end, relative to the largest limit.
fn excess(run: &Run) -> f64 {
    let pair = &run.finished.state.pairs[0];
    let nodes = Side::BOTH
        .into_iter()
        .flat_map(|side| pair.nodes[side].iter().zip(&pair.kept[side]));
    let kept = nodes.filter(|(node, kept)| **kept && node.status != Status::Open);
    let (mut over, mut limit) = (0.0_f64, 0.0_f64);
    for (node, _) in kept {
        over = over.max(node.tau.norm() - MU * node.pressure);
        limit = limit.max(MU * node.pressure);
    }
    over / limit
}

impl Trial {
    /// Has Newton's method judged, with the cuts that count.
    fn note(&self, study: &mut Study, run: &Run) {
        let mut summary = run.finished.summary.clone();
        summary.cutbacks = self.cuts;
        summary.newton_max = self.iterations;
        study.summaries.push((self.name.clone(), summary));
    }
}

fn table<'a>(trials: impl Iterator<Item = &'a Trial>) -> String {
    let mut rows = "run,completed,cuts,iterations,kink,snap,return,excess,mismatch\n".to_owned();
    for t in trials {
        rows += &format!(
            "{},{},{},{},{:.3e},{:.3e},{:.1e},{:.1e},{:.1e}\n",
            t.name,
            t.completed,
            t.cuts,
            t.iterations,
            t.kink,
            t.snap,
            largest(t.changes.iter().copied()),
            t.excess,
            t.mismatch,
        );
    }
    rows
}

/// Force over the distance slid, a panel for every friction.
fn figure(off: &[Trial]) -> Figure {
    let panels = FRICTION.iter().enumerate().map(|(friction, (title, _))| {
        let panel = Panel::new(
            Axis::linear("distance along x", "").within(0.0, 1.0),
            Axis::linear("N over N pressed", "").within(0.0, 1.1),
        );
        off.iter().filter(|trial| trial.friction == friction).fold(
            panel.titled(*title),
            |panel, trial| {
                let name: Vec<&str> = trial.name.split('-').skip(1).take(3).collect();
                let name = format!("{} on {}, {}", name[1], name[0], name[2]);
                panel.with(Series::new(name, Content::line(trial.curve.clone())))
            },
        )
    });
    Figure::new(Width::Page, panels.collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_kink_is_a_jump_and_no_curvature() {
        assert!(kink(&[0.0, 1.0, 4.0, 9.0]).abs() < 1e-15);
        assert!((kink(&[0.0, 1.0, 2.3, 3.3]) - 0.3).abs() < 1e-15);
        // A broken slope: half the change in an increment.
        assert!((kink(&[0.0, 0.0, 1.0, 2.0]) - 0.5).abs() < 1e-15);
    }
}
