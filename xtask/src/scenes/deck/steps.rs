//! Steps in the deck.

use std::fmt::Write;

use crate::scenes::scene::{Drive, Placement, Step};

/// A step.
pub fn step(lines: &mut Vec<String>, placement: &Placement, step: &Step, dynamic: bool) {
    lines.push(format!("[[step]]\nname = \"{}\"", step.name));
    lines.extend(
        step.duration
            .map(|duration| format!("duration = {duration:?}")),
    );
    lines.extend(step.increments.map(|count| format!("increments = {count}")));
    if dynamic {
        lines.push(match step.spectral_radius {
            Some(radius) => format!("dynamics = {{ spectral_radius = {radius:?} }}"),
            None => "dynamics = {}".into(),
        });
    }
    let conditions: Vec<String> = step
        .displacements
        .iter()
        .map(|(body, nodes, to)| {
            let to = match *to {
                [Some(x), Some(y), Some(z)] => placement.direction([x, y, z]).map(Some),
                some => some,
            };
            let parts = ["x", "y", "z"].iter().zip(to);
            let parts = parts.filter_map(|(axis, to)| Some(format!(", {axis} = {:?}", to?)));
            format!(
                "body = \"{body}\", nodes = \"{nodes}\"{}",
                parts.collect::<String>()
            )
        })
        .collect();
    list(lines, "displacement", &conditions);
    let releases = step.releases.iter();
    let releases: Vec<String> = releases
        .map(|(body, nodes)| format!("body = \"{body}\", nodes = \"{nodes}\""))
        .collect();
    list(lines, "release", &releases);
    let tractions: Vec<String> = step
        .tractions
        .iter()
        .map(|(body, facets, traction, _)| {
            let vector = placement.direction(*traction);
            format!("body = \"{body}\", facets = \"{facets}\", vector = {vector:?}")
        })
        .collect();
    list(lines, "traction", &tractions);
    let mut rigid: Vec<String> = step
        .rigid
        .iter()
        .map(|(name, to, turn)| {
            let to = placement.direction(*to);
            let turn = turn.map_or(String::new(), |degrees| {
                format!(
                    ", rotation = {:?}",
                    placement.direction([0.0, 0.0, degrees])
                )
            });
            format!("surface = \"{name}\", displacement = {to:?}{turn}")
        })
        .collect();
    rigid.extend(step.drives.iter().map(|drive| driven(placement, drive)));
    list(lines, "rigid", &rigid);
    let mut velocities: Vec<String> = step
        .velocities
        .iter()
        .map(|(body, v)| format!("body = \"{body}\", vector = {:?}", placement.direction(*v)))
        .collect();
    velocities.extend(step.throws.iter().map(|(name, v, spin, about)| {
        let [v, spin] = [*v, *spin].map(|of| placement.direction(of));
        let about = placement.point(*about);
        format!("rigid = \"{name}\", vector = {v:?}, spin = {spin:?}, about = {about:?}")
    }));
    list(lines, "velocity", &velocities);
    if let Some(gravity) = step.gravity {
        let vector = placement.direction(gravity);
        lines.push(format!(
            "gravity = {{ vector = {vector:?}, curve = \"constant\" }}"
        ));
    }
    lines.push(String::new());
}

fn driven(placement: &Placement, drive: &Drive) -> String {
    let mut text = format!("surface = \"{}\", free = {:?}", drive.name, drive.free);
    for (key, value) in [("force", drive.force), ("torque", drive.torque)] {
        if value != [0.0; 3] {
            let value = placement.direction(value);
            write!(text, ", {key} = {value:?}").expect("text grows");
        }
    }
    text
}

fn list(lines: &mut Vec<String>, key: &str, entries: &[String]) {
    if entries.is_empty() {
        return;
    }
    lines.push(format!("{key} = ["));
    lines.extend(entries.iter().map(|entry| format!("    {{ {entry} }},")));
    lines.push("]".into());
}
