//! Parts that carry a field, and the field on them: its values and their span, and the places of
//! its nodes.

use crate::{
    ReportError, invariants,
    part::{Field, Part},
    picture::{Picture, view::cross},
    results::Kind,
};

/// Fields that are shown by default, in the order of preference.
const PREFERRED: [&str; 3] = ["pressure", "cauchy_stress", "displacement"];

/// Values whose spread over their size is below this are equal.
const EQUAL: f64 = 1e-6;

/// Parts on which a field is shown, and if these are sides of pairs: if nothing else has it.
pub fn carriers<'a>(parts: &'a [Part], field: &str, picture: &Picture) -> (Vec<&'a Part>, bool) {
    let has = |part: &&Part| known(part, field).is_some() && !picture.hidden.contains(&part.name);
    let on_contact = |part: &Part| part.kind == Kind::Contact;
    let only_contact = !parts.iter().any(|part| has(&part) && !on_contact(part));
    let found = parts.iter().filter(has);
    let found: Vec<&Part> = found
        .filter(|part| on_contact(part) == only_contact)
        .collect();
    match only_contact {
        true => (one_side_each(&found, parts), true),
        false => (found, false),
    }
}

/// Points of a contact surface that are pressed, if its pressure is known.
pub fn pressed(part: &Part) -> Option<Vec<bool>> {
    let field = known(part, "pressure")?;
    Some(values(field, 0).iter().map(|value| *value > 0.0).collect())
}

/// The requested field, or the best one available.
pub fn chosen<'a>(parts: &'a [Part], wanted: Option<&str>) -> Result<&'a str, ReportError> {
    let names = names(parts);
    let find = |name: &str| names.iter().copied().find(|known| *known == name);
    let found = match wanted {
        Some(name) => find(name),
        None => PREFERRED.iter().find_map(|name| find(name)),
    };
    found.ok_or_else(|| unknown(parts, wanted.unwrap_or(PREFERRED[0])))
}

/// There is no such field on what is shown.
pub fn unknown(parts: &[Part], field: &str) -> ReportError {
    ReportError::Field {
        name: field.to_owned(),
        known: names(parts).join(", "),
    }
}

/// Names of all fields at the time.
fn names(parts: &[Part]) -> Vec<&str> {
    let fields = parts.iter().flat_map(|part| &part.arrays);
    let known = fields.filter(|field| field.times[0].is_some());
    let mut names: Vec<&str> = known.map(|field| field.name.as_str()).collect();
    names.sort_unstable();
    names.dedup();
    names
}

/// A field of a part, where it is known.
pub fn known<'a>(part: &'a Part, name: &str) -> Option<&'a Field> {
    let mut fields = part.arrays.iter();
    fields.find(|field| field.name == name && field.times[0].is_some())
}

/// The smaller side of each pair, as the sides lie on each other and the larger one has nodes
/// beside the contact, to which tractions are continued.
fn one_side_each<'a>(sides: &[&'a Part], parts: &[Part]) -> Vec<&'a Part> {
    let pair = |side: &Part| {
        let body = side.follows.as_ref().map(|(body, _)| &parts[*body].name);
        let end = body.map(|body| format!("-{body}")).unwrap_or_default();
        side.name
            .strip_suffix(&end)
            .unwrap_or(&side.name)
            .to_owned()
    };
    let mut kept: Vec<&Part> = Vec::new();
    for side in sides {
        match kept.iter_mut().find(|other| pair(other) == pair(side)) {
            Some(other) if extent(side) < extent(other) => *other = side,
            Some(_) => {}
            None => kept.push(side),
        }
    }
    kept
}

/// Area of a surface at rest.
fn extent(part: &Part) -> f64 {
    let area = |triangle: &[u32; 3]| {
        let [a, b, c] = triangle.map(|corner| part.rest[corner as usize]);
        let side = |to: [f64; 3]| [0, 1, 2].map(|axis| to[axis] - a[axis]);
        let n = cross(side(b), side(c));
        0.5 * (n[0] * n[0] + n[1] * n[1] + n[2] * n[2]).sqrt()
    };
    part.skin.triangles.iter().map(area).sum()
}

/// Least and largest value on what is shown, where there are any.
pub fn extremes(shown: &[&Part], field: &str, view: usize) -> Option<[f64; 2]> {
    let moments = shown
        .iter()
        .filter_map(|part| known(part, field)?.times[0].as_ref());
    let extremes = moments.filter_map(|moment| moment.extremes.get(view).copied().flatten());
    extremes.reduce(both)
}

/// The span of two spans.
pub fn both(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    [a[0].min(b[0]), a[1].max(b[1])]
}

/// Values that the colours span.
pub fn limits(extremes: Option<[f64; 2]>) -> [f64; 2] {
    let [least, largest] = extremes.unwrap_or([0.0, 0.0]);
    // What is equal but for the tolerance of the solution has one colour.
    if largest - least > EQUAL * least.abs().max(largest.abs()) {
        return [least, largest];
    }
    [0.5 * (least + largest); 2]
}

/// Values of a view at the nodes of the skin.
pub fn values(field: &Field, view: usize) -> Vec<f64> {
    let mut all = vec![0.0; invariants::views(field.components).len()];
    let points = points(field).into_iter();
    points
        .map(|point| {
            invariants::shown(&point, &mut all);
            all[view]
        })
        .collect()
}

/// Numbers of a field, point by point.
fn points(field: &Field) -> Vec<Vec<f64>> {
    let Some(moment) = &field.times[0] else {
        return Vec::new();
    };
    let codes = &moment.quantised.codes;
    let count = codes.len() / field.components;
    let number = |point: usize, c: usize| moment.quantised.number(codes[c * count + point]);
    (0..count)
        .map(|point| (0..field.components).map(|c| number(point, c)).collect())
        .collect()
}

/// Positions of the nodes of a part.
pub fn places(part: &Part, parts: &[Part], magnification: f64) -> Vec<[f64; 3]> {
    if let Some((body, nodes)) = &part.follows {
        let body = places(&parts[*body], &[], magnification);
        return nodes.iter().map(|node| body[*node as usize]).collect();
    }
    let way = points(&part.arrays[part.motion]);
    let place = |(rest, way): (&[f64; 3], &Vec<f64>)| {
        [0, 1, 2].map(|axis| rest[axis] + magnification * way[axis])
    };
    part.rest.iter().zip(&way).map(place).collect()
}
