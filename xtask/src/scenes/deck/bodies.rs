//! Materials, bodies with their meshes, and rigid bodies in the deck.

use crate::scenes::{
    grid::Grid,
    scene::{Beside, Block, Body, Placement, Rigid, RigidShape, Shape},
    vector::{Vector, applied, axis_and_angle, minus, plus, product, rotation, transposed},
};

/// The material of a body.
pub fn material(lines: &mut Vec<String>, placement: &Placement, body: &Body) {
    let of = &body.material;
    lines.push(format!(
        "[[material]]\nname = \"of-{}\"\nlaw = \"{}\"",
        body.name, of.law
    ));
    if let Beside::Relaxation(ratio, time) = of.beside {
        let shear = 0.5 * of.modulus / (1.0 + of.poisson);
        lines.push(format!("shear_modulus = {shear:?}"));
        lines.push(format!(
            "relaxation = [{{ ratio = {ratio:?}, time = {time:?} }}]"
        ));
    } else {
        lines.push(format!("youngs_modulus = {:?}", of.modulus));
    }
    lines.push(format!("poissons_ratio = {:?}", of.poisson));
    match of.beside {
        Beside::Yield(stress, hardening) => {
            lines.push(format!(
                "yield_stress = {stress:?}\nhardening_modulus = {hardening:?}"
            ));
        }
        Beside::Fibres(modulus, direction) => {
            let direction = placement.direction(direction);
            lines.push(format!(
                "fibres = [{{ modulus = {modulus:?}, direction = {{ uniform = {direction:?} }} }}]"
            ));
        }
        Beside::Nothing | Beside::Relaxation(..) => {}
    }
    lines.extend(of.density.map(|density| format!("density = {density:?}")));
    lines.push(String::new());
}

/// A body with its mesh.
pub fn mesh(lines: &mut Vec<String>, placement: &Placement, body: &Body) {
    lines.push(format!(
        "[[body]]\nname = \"{0}\"\nmaterial = \"of-{0}\"",
        body.name
    ));
    if let Some((name, [one, two])) = body.union {
        lines.push(format!(
            "facet_sets = [{{ name = \"{name}\", union = [\"{one}\", \"{two}\"] }}]"
        ));
    }
    let formulation = body.formulation;
    lines.extend(formulation.map(|name| format!("formulation = \"{name}\"")));
    let mut node_sets: Vec<String> = body
        .nearest
        .iter()
        .map(|(name, x)| {
            let x = placement.point(*x);
            format!("{{ name = \"{name}\", nearest = {x:?} }}")
        })
        .collect();
    if let Shape::Grid(grid) = &body.shape {
        let sides = grid.sides.iter().chain(&grid.nodes);
        node_sets.extend(
            sides.map(|(name, nodes)| format!("{{ name = \"{name}\", numbers = {nodes:?} }}")),
        );
        let names = grid.sides.iter().map(|side| side.0);
        let facets = names.map(|name| format!("    {{ name = \"{name}\", nodes = \"{name}\" }},"));
        let facets: Vec<String> = facets.collect();
        lines.push(format!("facet_sets = [\n{}\n]", facets.join("\n")));
    }
    if !node_sets.is_empty() {
        lines.push(format!(
            "node_sets = [\n    {}\n]",
            node_sets.join(",\n    ")
        ));
    }
    lines.push("\n[body.mesh]".into());
    match &body.shape {
        Shape::Grid(of) => grid(lines, placement, of),
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

fn grid(lines: &mut Vec<String>, placement: &Placement, grid: &Grid) {
    let positions = grid.positions.iter();
    let positions: Vec<String> = positions
        .map(|&x| format!("    {:?},", placement.point(x)))
        .collect();
    let cells: Vec<String> = grid.cells.iter().map(|c| format!("    {c:?},")).collect();
    lines.push(format!("positions = [\n{}\n]", positions.join("\n")));
    lines.push(format!("cells = [\n{}\n]", cells.join("\n")));
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
    lines.extend(block.cells.map(|cells| format!("cells = \"{cells}\"")));
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

/// A rigid body.
pub fn rigid(lines: &mut Vec<String>, placement: &Placement, rigid: &Rigid) {
    lines.push(format!("[[rigid]]\nname = \"{}\"", rigid.name));
    match &rigid.shape {
        RigidShape::Plane(point, normal) => lines.push(format!(
            "plane = {{ point = {:?}, normal = {:?} }}",
            placement.point(*point),
            placement.direction(*normal),
        )),
        RigidShape::Sheet(positions, facets) => facetted(lines, placement, positions, facets),
        RigidShape::Solid(corners, facets, at, density) => {
            lines.push(format!("density = {density:?}"));
            let positions: Vec<Vector> = corners.iter().map(|&x| plus(x, *at)).collect();
            facetted(lines, placement, &positions, facets);
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

fn facetted(
    lines: &mut Vec<String>,
    placement: &Placement,
    positions: &[Vector],
    facets: &[[usize; 4]],
) {
    let positions: Vec<String> = positions
        .iter()
        .map(|&x| format!("    {:?},", placement.point(x)))
        .collect();
    let facets: Vec<String> = facets.iter().map(|f| format!("    {f:?},")).collect();
    lines.push("\n[rigid.mesh]".into());
    lines.push(format!("positions = [\n{}\n]", positions.join("\n")));
    lines.push(format!("facets = [\n{}\n]", facets.join("\n")));
}
