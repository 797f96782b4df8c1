//! Contact of everything in the deck.

use super::pairs::{friction, texture};
use crate::scenes::{
    law::Law,
    scene::{Pair, SKIN, Scene, Side, Start},
};

/// `[contact]`, with the law where no pair has one of its own.
pub fn contact(lines: &mut Vec<String>, scene: &Scene, law: &Law) {
    lines.push("[contact]\nall = true".into());
    let general = Pair {
        name: String::new(),
        law: law.clone(),
        cap: None,
        decay: None,
        sides: scene.pairs[0].sides.clone(),
    };
    lines.extend(friction(&general).map(|text| format!("friction = {{ {text} }}")));
    if let Start::Overlapping(Some(initial)) = scene.start {
        lines.push(format!("initial = \"{initial}\""));
    }
    lines.push(String::new());
    for pair in scene.pairs.iter().filter(|pair| is_told(pair, law)) {
        let [a, b] = pair.sides.each_ref().map(label);
        lines.push(format!("[[contact.between]]\na = \"{a}\"\nb = \"{b}\""));
        let friction = friction(pair);
        let friction = friction.unwrap_or_else(|| "law = \"frictionless\"".into());
        lines.push(format!("friction = {{ {friction} }}\n"));
    }
    let sides = scene.pairs.iter().flat_map(|pair| &pair.sides);
    for side in sides {
        if let Some(painted) = &side.texture {
            let painted = texture(&scene.placement, painted);
            let of = label(side);
            lines.push(format!(
                "[[contact.surface]]\nof = \"{of}\"\ntexture = {painted}\n"
            ));
        }
    }
}

/// Returns true if the law for all does not say all of a pair.
fn is_told(pair: &Pair, law: &Law) -> bool {
    let whole = pair.sides.iter().all(|side| !label(side).contains('.'));
    !whole || pair.law != *law || pair.cap.is_some() || pair.decay.is_some()
}

/// The label of a side.
fn label(side: &Side) -> String {
    match side.facets {
        Some(facets) if facets != SKIN => format!("{}.{facets}", side.owner),
        _ => side.owner.to_owned(),
    }
}
