//! Pairs and ties in the deck.

use std::fmt::Write;

use crate::scenes::{
    law::Law,
    scene::{Pair, Placement, Scene, Side, Start, Statement, Texture, Tie},
};

/// A pair.
pub fn pair(lines: &mut Vec<String>, scene: &Scene, pair: &Pair) {
    lines.push(format!("[[pair]]\nname = \"{}\"", pair.name));
    for (key, of) in ["a", "b"].iter().zip(&pair.sides) {
        lines.push(format!("{key} = {{ {} }}", side(&scene.placement, of)));
    }
    if let Start::Overlapping(Some(initial)) = scene.start {
        lines.push(format!("initial = \"{initial}\""));
    }
    if scene.statement == Statement::PairsOfFaces {
        lines.push("feature_angle = 45".into());
    }
    let enforcement = scene.enforcement;
    lines.extend(enforcement.map(|method| format!("enforcement = \"{method}\"")));
    let friction = friction(pair);
    lines.extend(friction.map(|text| format!("friction = {{ {text} }}")));
    lines.push(String::new());
}

/// The table of the friction of a pair; `None` without.
pub fn friction(pair: &Pair) -> Option<String> {
    let mut friction = match &pair.law {
        Law::Frictionless => None,
        Law::Coulomb(mu) => Some(format!("law = \"coulomb\", mu = {mu:?}")),
        Law::Orthotropic(along, across, rule) => Some(format!(
            "law = \"orthotropic\", mu_along = {along:?}, mu_across = {across:?}, slip_rule = \"{rule}\""
        )),
        Law::Nap(forward, backward, lateral) => Some(format!(
            "law = \"nap\", mu_forward = {forward:?}, mu_backward = {backward:?}, mu_lateral = {lateral:?}"
        )),
        Law::TwoTextures(mu, c_mag, c_ang, c_cen) => Some(format!(
            "law = \"two-textures\", mu = {mu:?}, c_mag = {c_mag:?}, c_ang = {c_ang:?}, c_cen = {c_cen:?}"
        )),
        Law::Tabulated(table) => {
            let (angles, mu): (Vec<f64>, Vec<f64>) = table.iter().copied().unzip();
            Some(format!(
                "law = \"tabulated\", angles = {angles:?}, mu = {mu:?}"
            ))
        }
    };
    if let Some(text) = &mut friction {
        if let Some(cap) = pair.cap {
            write!(text, ", shear_cap = {cap:?}").expect("text grows");
        }
        if let Some((ratio, rate)) = pair.decay {
            let decay = format!("kinetic_over_static = {ratio:?}, slip_rate = {rate:?}");
            write!(text, ", decay = {{ {decay} }}").expect("text grows");
        }
    }
    friction
}

fn side(placement: &Placement, side: &Side) -> String {
    let mut text = match side.facets {
        Some(facets) => format!("body = \"{}\", facets = \"{facets}\"", side.owner),
        None => format!("rigid = \"{}\"", side.owner),
    };
    if let Some(of) = &side.texture {
        let painted = texture(placement, of);
        write!(text, ", texture = {painted}").expect("text grows");
    }
    text
}

/// The table of a texture.
pub fn texture(placement: &Placement, texture: &Texture) -> String {
    match *texture {
        Texture::Uniform(direction, turn) => {
            let direction = placement.direction(direction);
            format!("{{ uniform = {direction:?}, turn = {turn:?} }}")
        }
        Texture::About(key, point, turn) => format!(
            "{{ {key} = {{ point = {:?}, direction = {:?} }}, turn = {turn:?} }}",
            placement.point(point),
            placement.direction([0.0, 0.0, 1.0]),
        ),
    }
}

/// A tie.
pub fn tie(lines: &mut Vec<String>, tie: &Tie) {
    lines.push(format!("[[tie]]\nname = \"{}\"", tie.name));
    for (key, (body, facets)) in ["a", "b"].iter().zip(tie.sides) {
        lines.push(format!(
            "{key} = {{ body = \"{body}\", facets = \"{facets}\" }}"
        ));
    }
    lines.push(String::new());
}
