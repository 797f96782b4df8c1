//! Contact of everything in the deck.

use super::pairs::{friction, texture};
use crate::scenes::{
    law::Law,
    scene::{Origin, Pair, Scene, Side, Start},
};

/// `[contact]`, with the law where no pair has one of its own.
pub fn contact(lines: &mut Vec<String>, scene: &Scene, law: &Law) {
    lines.push("[contact]\nall = true".into());
    let general = Pair {
        name: String::new(),
        law: law.clone(),
        cap: None,
        decay: None,
        origin: Origin::Scene,
        sides: scene.pairs[0].sides.clone(),
    };
    lines.extend(friction(&general).map(|text| format!("friction = {{ {text} }}")));
    if let Start::Overlapping(Some(initial)) = scene.start {
        lines.push(format!("initial = \"{initial}\""));
    }
    lines.push(String::new());
    for pair in scene.pairs.iter().filter(|pair| is_told(pair, law)) {
        let [a, b] = pair.sides.each_ref().map(Side::label);
        lines.push(format!("[[contact.between]]\na = \"{a}\"\nb = \"{b}\""));
        let friction = friction(pair);
        let friction = friction.unwrap_or_else(|| "law = \"frictionless\"".into());
        lines.push(format!("friction = {{ {friction} }}\n"));
    }
    let sides = scene.pairs.iter().flat_map(|pair| &pair.sides);
    for side in sides {
        if let Some(painted) = &side.texture {
            let painted = texture(&scene.placement, painted);
            let of = side.label();
            lines.push(format!(
                "[[contact.surface]]\nof = \"{of}\"\ntexture = {painted}\n"
            ));
        }
    }
}

/// Returns true if the law for all does not say all of a pair.
fn is_told(pair: &Pair, law: &Law) -> bool {
    let whole = pair.sides.iter().all(|side| !side.label().contains('.'));
    !whole || pair.law != *law || pair.cap.is_some() || pair.decay.is_some()
}
