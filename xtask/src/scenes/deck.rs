//! The deck of a scene, brought to its place in space.
//!
//! With the rotation `R` and the shift `t` of the scene, a point `x` of the local frame
//! comes to `R x + t`. Blocks are rotated about the origin, so a block that is tilted
//! by `T` about `p` and placed has the rotation `R T` and the corner
//! `o - p + T^T (p + R^T t)`.

use std::fmt::Write;

use super::{
    law::Law,
    scene::{
        Block, Body, Pair, Placement, Rigid, RigidShape, Scene, Shape, Side, Start, Step, Texture,
    },
    vector::{Matrix, Vector, applied, axis_and_angle, minus, plus, product, rotation, transposed},
};

impl Placement {
    /// The rotation.
    pub fn matrix(&self) -> Matrix {
        rotation(self.axis, self.degrees.to_radians())
    }

    /// Where a point comes to.
    pub fn point(&self, x: Vector) -> Vector {
        plus(applied(&self.matrix(), x), self.shift)
    }

    /// What a direction becomes.
    pub fn direction(&self, v: Vector) -> Vector {
        if self.degrees == 0.0 {
            return v;
        }
        applied(&self.matrix(), v)
    }
}

/// The text of the deck.
pub fn text(scene: &Scene) -> String {
    let mut lines = vec![
        format!(
            "title = \"Scene {} of the kind {}\"",
            scene.seed, scene.kind
        ),
        String::new(),
    ];
    for body in &scene.bodies {
        material(&mut lines, body);
    }
    for body in &scene.bodies {
        mesh(&mut lines, &scene.placement, body);
    }
    for surface in &scene.rigid {
        rigid(&mut lines, &scene.placement, surface);
    }
    for of_pair in &scene.pairs {
        pair(&mut lines, scene, of_pair);
    }
    for of_step in &scene.steps {
        step(&mut lines, &scene.placement, of_step, scene.is_dynamic());
    }
    lines.join("\n") + "\n"
}

fn material(lines: &mut Vec<String>, body: &Body) {
    let of = &body.material;
    lines.push(format!(
        "[[material]]\nname = \"of-{}\"\nlaw = \"{}\"",
        body.name, of.law
    ));
    lines.push(format!(
        "youngs_modulus = {:?}\npoissons_ratio = {:?}",
        of.modulus, of.poisson
    ));
    lines.extend(of.density.map(|density| format!("density = {density:?}")));
    lines.push(String::new());
}

fn mesh(lines: &mut Vec<String>, placement: &Placement, body: &Body) {
    lines.push(format!(
        "[[body]]\nname = \"{0}\"\nmaterial = \"of-{0}\"",
        body.name
    ));
    if let Some((name, [one, two])) = body.union {
        lines.push(format!(
            "facet_sets = [{{ name = \"{name}\", union = [\"{one}\", \"{two}\"] }}]"
        ));
    }
    lines.push("\n[body.mesh]".into());
    match &body.shape {
        Shape::Block(of) => block(lines, placement, of),
        Shape::Cap(cap) => {
            lines.push("generator = \"capped-block\"".into());
            lines.push(format!("apex = {:?}", plus(cap.apex, placement.shift)));
            lines.push(format!("size = {:?}\nheight = {:?}", cap.size, cap.height));
            lines.push(format!(
                "radius = {:?}\nelement_size = {:?}",
                cap.radius, cap.element
            ));
            lines.push("growth = 1.6".into());
        }
    }
    lines.push(String::new());
}

fn block(lines: &mut Vec<String>, placement: &Placement, block: &Block) {
    let r = placement.matrix();
    let shift = applied(&transposed(&r), placement.shift);
    let (total, origin) = match block.tilt {
        None => (r, plus(block.origin, shift)),
        Some((axis, degrees, pivot)) => {
            let t = rotation(axis, degrees.to_radians());
            let moved = applied(&transposed(&t), plus(pivot, shift));
            (product(&r, &t), plus(minus(block.origin, pivot), moved))
        }
    };
    lines.push("generator = \"block\"".into());
    lines.push(format!("origin = {origin:?}\nsize = {:?}", block.size));
    lines.push(format!("divisions = {:?}", block.divisions));
    if block.mesh_rotation != 0.0 {
        lines.push(format!("mesh_rotation = {:?}", block.mesh_rotation));
    }
    for (name, slopes) in [("bottom", block.bottom_slopes), ("top", block.top_slopes)] {
        if slopes != [0.0; 2] {
            lines.push(format!("{name}_slopes = {slopes:?}"));
        }
    }
    if let Some((irregularity, seed)) = block.irregularity {
        lines.push(format!("irregularity = {irregularity:?}\nseed = {seed}"));
    }
    let (axis, angle) = axis_and_angle(&total);
    if angle != 0.0 {
        let degrees = angle.to_degrees();
        lines.push(format!(
            "rotation = {{ axis = {axis:?}, degrees = {degrees:?}, about = [0, 0, 0] }}"
        ));
    }
    let gradings = ["x", "y", "z"].iter().zip(block.gradings);
    let gradings: Vec<String> = gradings
        .filter_map(|(axis, grading)| {
            let (kind, ratio) = grading?;
            Some(format!("{axis} = {{ {kind} = {ratio:?} }}"))
        })
        .collect();
    if !gradings.is_empty() {
        lines.push(format!("grading = {{ {} }}", gradings.join(", ")));
    }
}

fn rigid(lines: &mut Vec<String>, placement: &Placement, rigid: &Rigid) {
    lines.push(format!("[[rigid]]\nname = \"{}\"", rigid.name));
    match &rigid.shape {
        RigidShape::Plane(point, up) => lines.push(format!(
            "plane = {{ point = {:?}, normal = {:?} }}",
            placement.point(*point),
            placement.direction([0.0, 0.0, *up]),
        )),
        RigidShape::Sheet(positions, facets) => {
            let positions: Vec<String> = positions
                .iter()
                .map(|&x| format!("    {:?},", placement.point(x)))
                .collect();
            let facets: Vec<String> = facets.iter().map(|f| format!("    {f:?},")).collect();
            lines.push("\n[rigid.mesh]".into());
            lines.push(format!("positions = [\n{}\n]", positions.join("\n")));
            lines.push(format!("facets = [\n{}\n]", facets.join("\n")));
        }
        RigidShape::Head(body, nodes, reference) => {
            lines.push(format!(
                "tied = [{{ body = \"{body}\", nodes = \"{nodes}\" }}]"
            ));
            lines.push(format!("reference = {:?}", placement.point(*reference)));
        }
    }
    lines.push(String::new());
}

fn pair(lines: &mut Vec<String>, scene: &Scene, pair: &Pair) {
    lines.push(format!("[[pair]]\nname = \"{}\"", pair.name));
    for (key, of) in ["a", "b"].iter().zip(&pair.sides) {
        lines.push(format!("{key} = {{ {} }}", side(&scene.placement, of)));
    }
    if let Start::Overlapping(Some(initial)) = scene.start {
        lines.push(format!("initial = \"{initial}\""));
    }
    let enforcement = scene.enforcement;
    lines.extend(enforcement.map(|method| format!("enforcement = \"{method}\"")));
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
    lines.extend(friction.map(|text| format!("friction = {{ {text} }}")));
    lines.push(String::new());
}

fn side(placement: &Placement, side: &Side) -> String {
    let mut text = match side.facets {
        Some(facets) => format!("body = \"{}\", facets = \"{facets}\"", side.owner),
        None => format!("rigid = \"{}\"", side.owner),
    };
    let painted = match side.texture {
        None => return text,
        Some(Texture::Uniform(direction, turn)) => {
            format!(
                "uniform = {:?}, turn = {turn:?}",
                placement.direction(direction)
            )
        }
        Some(Texture::About(key, point, turn)) => format!(
            "{key} = {{ point = {:?}, direction = {:?} }}, turn = {turn:?}",
            placement.point(point),
            placement.direction([0.0, 0.0, 1.0]),
        ),
    };
    write!(text, ", texture = {{ {painted} }}").expect("text grows");
    text
}

fn step(lines: &mut Vec<String>, placement: &Placement, step: &Step, dynamic: bool) {
    lines.push(format!("[[step]]\nname = \"{}\"", step.name));
    lines.extend(
        step.duration
            .map(|duration| format!("duration = {duration:?}")),
    );
    lines.extend(step.increments.map(|count| format!("increments = {count}")));
    if dynamic {
        lines.push("dynamics = {}".into());
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
    let rigid: Vec<String> = step
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
    list(lines, "rigid", &rigid);
    let velocities: Vec<String> = step
        .velocities
        .iter()
        .map(|(body, v)| format!("body = \"{body}\", vector = {:?}", placement.direction(*v)))
        .collect();
    list(lines, "velocity", &velocities);
    if let Some(gravity) = step.gravity {
        let vector = placement.direction(gravity);
        lines.push(format!(
            "gravity = {{ vector = {vector:?}, curve = \"constant\" }}"
        ));
    }
    lines.push(String::new());
}

fn list(lines: &mut Vec<String>, key: &str, entries: &[String]) {
    if entries.is_empty() {
        return;
    }
    lines.push(format!("{key} = ["));
    lines.extend(entries.iter().map(|entry| format!("    {{ {entry} }},")));
    lines.push("]".into());
}
