//! Pairs: sides, textures, friction; ties.

use striae_model::{ContactSurface, Enforcement, Initial, Pair};
use striae_surface::texture::Paint;

use super::value::{number, text};
use super::{Writer, law};

impl Writer<'_> {
    /// A pair.
    pub(super) fn pair(&mut self, at: usize) -> String {
        let pair = &self.model.pairs[at];
        let [a, b] = [0, 1].map(|side| self.side(pair, side));
        let friction = law::friction(&pair.friction).unwrap_or_else(|| {
            let part = format!("pair `{}`", pair.name);
            self.refuse(part, "its friction is a user-defined law");
            String::new()
        });
        let enforcement = match pair.enforcement {
            Enforcement::Weighted => "weighted",
            Enforcement::Collocated => "collocated",
        };
        let initial = match pair.initial {
            // What was to be closed is closed in the meshes that are written.
            Initial::AsMeshed | Initial::Close(_) => "as-meshed",
            Initial::Resolve => "resolve",
        };
        let interference = pair
            .interference
            .as_ref()
            .map_or_else(String::new, |stated| {
                let curve = self.curve(&stated.curve);
                let value = number(stated.value);
                format!("interference = {{ value = {value}{curve} }}\n")
            });
        let wear = match pair.wear {
            [0.0, 0.0] => String::new(),
            [a, b] => format!("wear = {{ a = {}, b = {} }}\n", number(a), number(b)),
        };
        let across = match pair.wear_across {
            1.0 => String::new(),
            ratio => format!("wear_across = {}\n", number(ratio)),
        };
        let search = pair.search_distance.map_or_else(String::new, |distance| {
            format!("search_distance = {}\n", number(distance))
        });
        let features = pair.feature_angle.map_or_else(String::new, |angle| {
            format!("feature_angle = {}\n", number(angle))
        });
        format!(
            "\n[[pair]]\nname = {}\na = {a}\nb = {b}\nfriction = {friction}\n\
             enforcement = \"{enforcement}\"\n{search}initial = \"{initial}\"\n{interference}{wear}{across}stabilise = {}\n{features}",
            text(&pair.name),
            pair.stabilised
        )
    }

    /// A tie; its nodes are where they belong in the meshes that are written.
    pub(super) fn tie(&mut self, at: usize) -> String {
        let tie = &self.model.ties[at];
        let [a, b] = [&tie.a, &tie.b].map(|side| self.surface(side));
        let within = tie.within.map_or_else(String::new, |distance| {
            format!("within = {}\n", number(distance))
        });
        format!(
            "\n[[tie]]\nname = {}\na = {{ {a} }}\nb = {{ {b} }}\n{within}",
            text(&tie.name)
        )
    }

    fn surface(&mut self, side: &ContactSurface) -> String {
        match side {
            ContactSurface::Deformable { body, faces } => {
                let set = self.meshes.facets(*body, "", faces);
                let body = &self.model.bodies[body.0].name;
                format!("body = {}, facets = {}", text(body), text(&set))
            }
            ContactSurface::Rigid(rigid) => {
                let rigid = &self.model.rigid_surfaces[rigid.0].name;
                format!("rigid = {}", text(rigid))
            }
            ContactSurface::Itself => unreachable!("written as a word"),
        }
    }

    fn side(&mut self, pair: &Pair, side: usize) -> String {
        if side == 1 && pair.is_on_itself() {
            return text("itself");
        }
        let surface = self.surface([&pair.a, &pair.b][side]);
        let texture = match &pair.textures[side] {
            None => String::new(),
            Some(paint) => match law::texture(paint) {
                Some(told) => format!(", texture = {told}"),
                None => {
                    let part = format!("texture of pair `{}`", pair.name);
                    let reason = match paint {
                        Paint::Nodes { .. } => "it is given at chosen nodes",
                        _ => "its lines are those of a formula that is not declared",
                    };
                    self.refuse(part, reason);
                    String::new()
                }
            },
        };
        format!("{{ {surface}{texture} }}")
    }
}
