//! Numbers in their ranges, directions of some length, curves that rise.

use crate::{
    fault::{Fault, FaultKind},
    model::{
        Clock, ClosedGaps, Course, Curve, History, Initial, Model, Pair, Procedure, RigidInertia,
        RigidShape, Spring, SpringEnd, SpringLine, SpringRest, Step,
    },
    path::Path,
};
use striae_law::bulk::{LameConstants, Material};
use striae_mesh::Vec3;
use striae_surface::texture::{Lines, Paint};

use super::List;

const POSITIVE: &str = "a positive number";
const FINITE: &str = "a finite number";
const HALF_TURN: &str = "an angle above 0 and up to 180 degrees";
const NOT_NEGATIVE: &str = "a number of at least 0";

/// Every number of a model that is out of its range.
pub(super) fn faults(model: &Model) -> Vec<Fault> {
    let mut faults = List::default();
    bodies(model, &mut faults);
    rigid_surfaces(model, &mut faults);
    for (index, pair) in model.pairs.iter().enumerate() {
        of_pair(pair, &Path::part("pairs", index), &mut faults);
    }
    for (index, step) in model.steps.iter().enumerate() {
        let path = Path::part("steps", index);
        of_step(step, &path, &mut faults);
    }
    let path = Path::of("solver").field("tolerance");
    let tolerance = model.solver.tolerance;
    faults.range(path, "the tolerance", tolerance, POSITIVE);
    faults.0
}

/// The numbers of springs that are out of their ranges.
pub(super) fn of_spring(spring: &Spring, path: &Path, faults: &mut List) {
    let mut range = |field: &'static str, found: f64, expected| {
        let what = format!("`{field}` of spring `{}`", spring.name);
        faults.range(path.clone().field(field), &what, found, expected);
    };
    range("stiffness", spring.stiffness, NOT_NEGATIVE);
    range("damping", spring.damping, NOT_NEGATIVE);
    match spring.rest {
        SpringRest::Slack => {}
        SpringRest::Length(length) => range("free_length", length, POSITIVE),
        SpringRest::Preload(tension) => range("preload", tension, FINITE),
    }
    let point = |end: &SpringEnd| match end {
        SpringEnd::Rigid { point, .. } => Some(*point),
        SpringEnd::Nodes { .. } => None,
    };
    let points = spring.ends().filter_map(point);
    let fixed = match spring.line {
        SpringLine::ToPoint(point) => Some(point),
        SpringLine::To(_) | SpringLine::Along(_) => None,
    };
    for coordinate in points
        .chain(fixed)
        .flat_map(|point| [point.x, point.y, point.z])
    {
        range("point", coordinate, FINITE);
    }
    if let SpringLine::Along(direction) = &spring.line {
        let place = format!("`direction` of spring `{}`", spring.name);
        faults.direction(path.clone().field("direction"), &place, direction);
    }
}

/// The numbers of contact of everything that are out of their ranges.
pub(crate) fn of_everything(feature_angle: f64, search_distance: Option<f64>) -> Vec<Fault> {
    let (mut faults, path) = (List::default(), Path::of("contact"));
    let angle = path.clone().field("feature_angle");
    faults.range(
        angle,
        "the feature angle of contact",
        feature_angle,
        HALF_TURN,
    );
    if let Some(distance) = search_distance {
        let path = path.field("search_distance");
        faults.range(path, "the search distance of contact", distance, POSITIVE);
    }
    faults.0
}

impl List {
    fn range(&mut self, path: Path, what: &str, found: f64, expected: &'static str) {
        let holds = found.is_finite()
            && match expected {
                POSITIVE => found > 0.0,
                FINITE => true,
                HALF_TURN => found > 0.0 && found <= 180.0,
                _ => found >= 0.0,
            };
        if !holds {
            let what = what.to_owned();
            let kind = FaultKind::Range {
                what,
                expected,
                found,
            };
            self.push(path, kind);
        }
    }

    fn direction(&mut self, path: Path, place: &str, direction: &Vec3) {
        if direction.norm() == 0.0 || !direction.norm().is_finite() {
            let place = place.to_owned();
            self.push(path, FaultKind::ZeroVector { place });
        }
    }
}

fn bodies(model: &Model, faults: &mut List) {
    for (index, body) in model.bodies.iter().enumerate() {
        let path = Path::part("bodies", index);
        let name = &body.name;
        let own = format!("of body `{name}`");
        of_material(&own, &body.material, body.density, &path, faults);
        for (at, section) in body.sections.iter().enumerate() {
            let path = path.clone().field("sections").index(at);
            let whose = format!("of section `{}` of body `{name}`", section.set);
            of_material(&whose, &section.material, section.density, &path, faults);
        }
        let sound = body.mesh.check().and_then(|()| body.mesh.check_shape());
        if let Err(error) = sound {
            let kind = FaultKind::Mesh {
                owner: format!("body `{name}`"),
                cause: error.to_string(),
            };
            faults.push(path.field("mesh"), kind);
        }
    }
}

/// A material with its density.
fn of_material(whose: &str, material: &Material, density: f64, path: &Path, faults: &mut List) {
    let LameConstants { lambda, shear } = material.lame_constants();
    let what = format!("the shear modulus {whose}");
    faults.range(path.clone().field("material"), &what, shear, POSITIVE);
    if 3.0 * lambda + 2.0 * shear <= 0.0 {
        let kind = FaultKind::BulkModulus { lambda, shear };
        faults.push(path.clone().field("material"), kind);
    }
    let what = format!("the density {whose}");
    let path = path.clone().field("density");
    faults.range(path, &what, density, NOT_NEGATIVE);
}

fn rigid_surfaces(model: &Model, faults: &mut List) {
    for (index, rigid) in model.rigid_surfaces.iter().enumerate() {
        let path = Path::part("rigid_surfaces", index);
        if let RigidShape::Plane { normal, .. } = &rigid.shape {
            let path = path.clone().field("shape");
            faults.direction(path, "the normal of a plane", normal);
        }
        if rigid.inertia.is_some_and(|inertia| !is_possible(&inertia)) {
            let rigid = rigid.name.clone();
            faults.push(path.field("inertia"), FaultKind::RigidInertia { rigid });
        }
    }
}

/// Returns whether a body can have such a mass and such moments.
fn is_possible(inertia: &RigidInertia) -> bool {
    let RigidInertia { mass, moments, .. } = inertia;
    let largest = moments.iter().copied().fold(0.0, f64::max);
    let positive = *mass > 0.0 && moments.iter().all(|moment| *moment > 0.0);
    positive && 2.0 * largest <= moments.iter().sum::<f64>() * (1.0 + 1e-12)
}

fn of_pair(pair: &Pair, path: &Path, faults: &mut List) {
    let name = &pair.name;
    if let Some(distance) = pair.search_distance {
        let what = format!("the search distance of pair `{name}`");
        faults.range(
            path.clone().field("search_distance"),
            &what,
            distance,
            POSITIVE,
        );
    }
    if let Some(angle) = pair.feature_angle {
        let what = format!("the feature angle of pair `{name}`");
        faults.range(path.clone().field("feature_angle"), &what, angle, HALF_TURN);
    }
    if let Initial::Close(ClosedGaps::Share(gap) | ClosedGaps::UpTo(gap)) = pair.initial {
        let what = format!("the gap that pair `{name}` closes");
        faults.range(path.clone().field("initial"), &what, gap, NOT_NEGATIVE);
    }
    if let Some(interference) = &pair.interference {
        let path = path.clone().field("interference");
        let what = format!("the interference of pair `{name}`");
        faults.range(path.clone(), &what, interference.value, FINITE);
        curve(&interference.curve, path, faults);
    }
    for (coefficient, side) in pair.wear.into_iter().zip(["a", "b"]) {
        let what = format!("the coefficient of wear of side `{side}` of pair `{name}`");
        faults.range(path.clone().field("wear"), &what, coefficient, NOT_NEGATIVE);
    }
    let what = format!("`wear_across` of pair `{name}`");
    faults.range(
        path.clone().field("wear_across"),
        &what,
        pair.wear_across,
        POSITIVE,
    );
    for (side, paint) in pair.textures.iter().enumerate() {
        let path = || path.clone().field("textures").index(side);
        match paint {
            Some(Paint::Field(field)) => match &field.lines {
                Lines::Uniform(direction) => {
                    faults.direction(path(), "the direction of a texture", direction);
                }
                lines => {
                    if let Some(axis) = lines.axis() {
                        faults.direction(path(), "the direction of an axis", &axis.direction);
                    }
                }
            },
            Some(Paint::Points { directions, .. }) => {
                for (_, direction) in directions {
                    faults.direction(path(), "the direction of a texture", direction);
                }
            }
            Some(Paint::Nodal(_) | Paint::Nodes { .. }) | None => {}
        }
    }
}

fn of_step(step: &Step, path: &Path, faults: &mut List) {
    let name = &step.name;
    let what = format!("the duration of step `{name}`");
    faults.range(
        path.clone().field("duration"),
        &what,
        step.duration,
        POSITIVE,
    );
    let what = format!("the smallest increment of step `{name}`");
    let increments = path.clone().field("increments");
    faults.range(increments, &what, step.increments.smallest, POSITIVE);
    if let Procedure::Dynamic { spectral_radius } = step.procedure
        && !(0.0..=1.0).contains(&spectral_radius)
    {
        let kind = FaultKind::Range {
            what: format!("the spectral radius of step `{name}`"),
            expected: "a number from 0 to 1",
            found: spectral_radius,
        };
        faults.push(path.clone().field("procedure"), kind);
    }
    let mut displacements = step.displacements.iter().map(|of| &of.curve);
    let mut curves = |list, all: &mut dyn Iterator<Item = &Curve>| {
        for (index, of) in all.enumerate() {
            let path = path.clone().field(list).index(index);
            curve(of, path, faults);
        }
    };
    curves("displacements", &mut displacements);
    curves("loads", &mut step.loads.iter().map(|of| &of.curve));
    curves("forces", &mut step.forces.iter().map(|of| &of.curve));
    let mut actuations = step.actuations.iter().map(|of| &of.curve);
    curves("actuations", &mut actuations);
    curves("fillings", &mut step.fillings.iter().map(|of| &of.curve));
    let mut motions = step.rigid_motions.iter().map(|of| &of.curve);
    curves("rigid_motions", &mut motions);
    if let Some(gravity) = &step.gravity {
        curve(&gravity.curve, path.clone().field("gravity"), faults);
    }
}

fn curve(curve: &Curve, path: Path, faults: &mut List) {
    let path = path.field("curve");
    if let Some(kind) = misshapen(&path.to_string(), curve) {
        faults.push(path, kind);
    }
}

/// The fault of a curve of that name that is none.
pub fn misshapen(name: &str, curve: &Curve) -> Option<FaultKind> {
    let name = name.to_owned();
    if let Curve::History(History {
        course: Course::Function(function),
        ..
    }) = curve
    {
        let function = (!function.is_uniform()).then(|| function.text().to_owned());
        return function.map(|function| FaultKind::CurveOfPosition {
            curve: name,
            function,
        });
    }
    let found = shape(curve)?;
    Some(FaultKind::BadCurve { curve: name, found })
}

/// Manner in which the points of a curve have to rise, and the one that does not.
fn shape(curve: &Curve) -> Option<String> {
    let (points, within, ends) = match curve {
        Curve::Ramp | Curve::Constant | Curve::Smooth => return None,
        Curve::Table(points) => (points, "from 0 to 1".to_owned(), Some([0.0, 1.0])),
        Curve::History(History { clock, course }) => match (clock, course) {
            (_, Course::Function(_)) => return None,
            (Clock::Step, Course::Table(points)) => {
                (points, "from 0 to 1".to_owned(), Some([0.0, 1.0]))
            }
            (Clock::Run, Course::Table(points)) => (points, String::new(), None),
            (_, Course::Periodic { points, period }) => {
                if !(*period > 0.0 && period.is_finite()) {
                    return Some(format!(
                        "within a period that is a positive number, but it is {period}"
                    ));
                }
                let within = format!("within the period from 0 to {period}");
                let outside = points
                    .iter()
                    .find(|point| !(0.0..=*period).contains(&point.0));
                if let Some(point) = outside {
                    return Some(format!("{within}, but one is at {}", point.0));
                }
                (points, within, None)
            }
        },
    };
    let wrong = match (&points[..], ends) {
        ([] | [_], _) => Some(format!("there are only {}", points.len())),
        ([(first, _), ..], Some([start, _])) if *first != start => {
            Some(format!("start at {first}"))
        }
        ([.., (last, _)], Some([_, end])) if *last != end => Some(format!("end at {last}")),
        _ => {
            let rises = |pair: &&[(f64, f64)]| pair[1].0 > pair[0].0;
            let turns = points.windows(2).find(|pair| !rises(pair));
            let lost = points
                .iter()
                .find(|(s, c)| !s.is_finite() || !c.is_finite());
            match (turns, lost) {
                (Some(pair), _) => Some(format!("{} is followed by {}", pair[0].0, pair[1].0)),
                (None, Some((s, c))) => Some(format!("({s}, {c}) is no pair of finite numbers")),
                (None, None) => None,
            }
        }
    };
    let comma = if within.is_empty() { "" } else { ", " };
    wrong.map(|wrong| format!("{within}{comma}but {wrong}"))
}
