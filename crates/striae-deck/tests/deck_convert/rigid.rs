//! Rigid bodies and couplings.

use super::{STEP, assert_listed, converted, model};
use std::f64::consts::{PI, TAU};
use striae_mesh::Vec3;
use striae_model::{Freedom, Model, RigidShape};

/// A rigid body by an analytical surface of the part `Wall`, moved by `place`.
fn analytical(surface: &str, place: &str) -> (Vec<String>, Model) {
    let parts = format!("*PART, NAME=Wall\n{surface}*END PART\n");
    let assembly = format!(
        "*INSTANCE, NAME=Wall-1, PART=Wall\n{place}*END INSTANCE
*NODE\n2, 0., -1., 0.\n*NSET, NSET=RW\n2,\n*RIGID BODY, REF NODE=RW, ANALYTICAL SURFACE=Wall-1.Face\n"
    );
    let more = format!("*BOUNDARY\nRW, ENCASTRE\n{STEP}");
    let (_, listed, deck) = converted(&(parts + &model(&assembly, &more)));
    (listed, deck.model)
}

/// Middle, area and unit normal of each facet of the first rigid body.
fn facets(model: &Model) -> Vec<(Vec3, f64, Vec3)> {
    let RigidShape::Facets { positions, facets } = &model.rigid_surfaces[0].shape else {
        panic!("{:?}", model.rigid_surfaces[0].shape);
    };
    let facet = |of: &[striae_mesh::NodeId; 4]| {
        let [a, b, c, d] = of.map(|node| positions[node.index()]);
        let twice = (c - a).cross(&(d - b));
        // A triangle repeats its last corner.
        let corners = if c == d { 3.0 } else { 4.0 };
        let sum = if c == d { a + b + c } else { a + b + c + d };
        (sum / corners, 0.5 * twice.norm(), twice.normalize())
    };
    facets.iter().map(facet).collect()
}

#[test]
fn extruded_arcs_are_facets_that_face_the_bodies() {
    // A cylinder of radius 2 about z above the pad, whose top is at y = 1, seen from below.
    let surface = "*SURFACE, TYPE=CYLINDER, NAME=Face\nSTART, -2., 3.\nCIRCL, 0., 1., 0., 3.\nCIRCL, 2., 3., 0., 3.\n";
    let (listed, model) = analytical(surface, "");
    assert_listed(
        &listed,
        &["analytical surface `Wall-1.Face` is made of 432 facets"],
    );
    let facets = facets(&model);
    // Bodies reach from z = 0 to 2, the surface half of that beyond both ends.
    let area: f64 = facets.iter().map(|(_, area, _)| area).sum();
    let exact = PI * 2.0 * 4.0;
    assert!((area / exact - 1.0).abs() < 1e-3 && area < exact, "{area}");
    for (middle, _, normal) in facets {
        let outward = Vec3::new(middle.x, middle.y - 3.0, 0.0).normalize();
        assert!((normal - outward).norm() < 1e-12, "{middle} {normal}");
    }
}

#[test]
fn revolved_arcs_close_around_the_axis() {
    // A ball of radius 1 about (0.5, 0.5, 3.5), its axis along z after the turn about x.
    let surface = "*SURFACE, TYPE=REVOLUTION, NAME=Face\nSTART, 0., -1.\nCIRCL, 1., 0., 0., 0.\nCIRCL, 0., 1., 0., 0.\n";
    let place = "0.5, 0.5, 3.5\n0.5, 0.5, 3.5, 1.5, 0.5, 3.5, 90.\n";
    let (listed, model) = analytical(surface, place);
    assert_listed(
        &listed,
        &["analytical surface `Wall-1.Face` is made of 2592 facets"],
    );
    let facets = facets(&model);
    let centre = Vec3::new(0.5, 0.5, 3.5);
    // The divergence theorem: a closed surface encloses its volume.
    let volumes = facets
        .iter()
        .map(|(x, area, n)| area * (x - centre).dot(n) / 3.0);
    let volume: f64 = volumes.sum();
    let exact = TAU * 2.0 / 3.0;
    assert!(
        (volume / exact - 1.0).abs() < 4e-3 && volume < exact,
        "{volume}"
    );
    for (x, _, normal) in facets {
        assert!(normal.dot(&(x - centre)) > 0.99 * (x - centre).norm());
    }
}

#[test]
fn a_plane_that_a_body_reaches_through_looks_at_most_of_it() {
    let surface = "*SURFACE, TYPE=CYLINDER, NAME=Face\nSTART, -2., 0.4\nLINE, 2., 0.4\n";
    let (listed, model) = analytical(surface, "");
    assert_listed(&listed, &[]);
    let RigidShape::Plane { normal, .. } = model.rigid_surfaces[0].shape else {
        panic!("{:?}", model.rigid_surfaces[0].shape);
    };
    // The cubes reach from y = 0 to 1.
    assert_eq!(normal, Vec3::y());
}

#[test]
fn fillets_are_listed() {
    let surface =
        "*SURFACE, TYPE=CYLINDER, NAME=Face, FILLET RADIUS=0.1\nSTART, -2., 3.\nLINE, 2., 3.\n";
    let (listed, _) = analytical(surface, "");
    assert_listed(&listed, &["*SURFACE: parameter FILLET RADIUS"]);
}

#[test]
fn analytical_surfaces_without_a_counterpart_are_listed() {
    for (surface, said) in [
        (
            "*SURFACE, TYPE=SEGMENTS, NAME=Face\nSTART, 0., 0.\nLINE, 1., 0.\n",
            "is for models of a plane",
        ),
        (
            "*SURFACE, TYPE=CYLINDER, NAME=Face\nSTART, 0., 0.\nPARAB, 1., 0., 0.5, 1.\n",
            "a profile with PARAB; mesh it with R3D4",
        ),
        (
            "*SURFACE, TYPE=CYLINDER, NAME=Face\nSTART, 0., 0.\n",
            "a profile without a line",
        ),
    ] {
        let (listed, model) = analytical(surface, "");
        assert!(model.rigid_surfaces.is_empty());
        assert!(listed.iter().any(|line| line.contains(said)), "{listed:?}");
    }
}

#[test]
fn nodes_are_tied_by_beams_and_by_old_couplings() {
    let step = STEP.replace("Pad-1.High, 3, 3, -0.02\n", "RP, 1, 6\n");
    for coupling in [
        "*MPC\nBEAM, Pad-1.High, RP\n",
        "*KINEMATIC COUPLING, REF NODE=RP\nPad-1.High, 1, 3\n",
        "*RIGID BODY, REF NODE=RP, TIE NSET=Pad-1.High\n",
    ] {
        let (text, listed, deck) = converted(&model(coupling, &step));
        assert_listed(&listed, &[]);
        assert_eq!(deck.model.rigid_surfaces.len(), 1);
        let tied = "tied = [{ body = \"Pad-1\", nodes = \"Pad-1.High\" }]";
        assert!(text.contains(tied), "{text}");
    }
}

#[test]
fn constraints_without_a_counterpart_are_listed() {
    let constraints = "*MPC\nPIN, Pad-1.High, RP\n*EQUATION\n2\nPad-1.5, 1, 1., Pad-1.6, 1, -1.
*COUPLING, CONSTRAINT NAME=C, REF NODE=RP, SURFACE=Pad-1.Top\n*DISTRIBUTING
*COUPLING, CONSTRAINT NAME=D, REF NODE=RP, SURFACE=Pad-1.Top\n*KINEMATIC\n1, 2\n";
    let (_, listed, _) = converted(&model(constraints, STEP));
    let said = [
        "*MPC `PIN, Pad-1.High, RP`: tie nodes of a body to a free point",
        "*EQUATION: nodes follow no equations",
        "*COUPLING `C` with *DISTRIBUTING: put loads on the surface",
        "*DISTRIBUTING",
        "*KINEMATIC `D` of some displacements only",
    ];
    assert_listed(&listed, &said);
}

#[test]
fn rotations_of_calculix_are_those_of_a_second_node() {
    let text = model("", "").replace(
        "*NODE\n1, 0.5, 0.5, 3.\n",
        "*NODE\n1, 0.5, 0.5, 3.\n2, 0.5, 0.5, 3.\n",
    );
    let rigid = "*NSET, NSET=ROT\n2,\n*RIGID BODY, NSET=Pad-1.High, REF NODE=RP, ROT NODE=ROT\n";
    let text = text.replace("*END ASSEMBLY\n", &format!("{rigid}*END ASSEMBLY\n"));
    let step = STEP.replace(
        "Pad-1.High, 3, 3, -0.02\n",
        "RP, 1, 3\nROT, 1, 2\nROT, 3, 3, 0.5\n",
    );
    let (_, listed, deck) = converted(&(text + &step));
    assert_listed(&listed, &[]);
    let motion = &deck.model.steps[0].rigid_motions[0];
    assert_eq!(motion.coordinates[5], Freedom::To(0.5));
}

#[test]
fn courses_of_a_rigid_body_that_differ_are_listed() {
    let rigid = "*RIGID BODY, REF NODE=RP, TIE NSET=Pad-1.High\n";
    let step = STEP.replace(
        "Pad-1.High, 3, 3, -0.02\n",
        "RP, 4, 6\nRP, 1, 1, 0.1\n*BOUNDARY, AMPLITUDE=Way\nRP, 2, 2, 0.1\n",
    );
    let way = "*AMPLITUDE, NAME=Way\n0., 0., 1., 3., 2., 1.\n";
    let (_, listed, _) = converted(&model(rigid, &format!("{way}{step}")));
    assert_listed(&listed, &["a rigid body has one course in a step"]);
}

/// Two rigid planes, each stated within its instance as Abaqus/CAE does, beside these keywords.
fn two_plates(names: [&str; 2], more: &str) -> String {
    let part = "*PART, NAME=Plate\n*END PART\n";
    let plate = |at: usize, z: f64| {
        format!(
            "*INSTANCE, NAME=Plate-{at}, PART=Plate\n*NODE\n1, 0., 0., {z}
*NSET, NSET=Ref\n1,\n*SURFACE, TYPE=REVOLUTION, NAME=Face\nSTART, 0., {z}\nLINE, 5., {z}
*RIGID BODY, REF NODE=Ref, ANALYTICAL SURFACE=Face\n*END INSTANCE\n"
        )
    };
    let sets = "*NSET, NSET=R1, INSTANCE=Plate-1\n1,\n*NSET, NSET=R2, INSTANCE=Plate-2\n1,\n";
    let pairs = format!(
        "*SURFACE INTERACTION, NAME=I\n*FRICTION\n0.2,\n*CONTACT PAIR, INTERACTION=I\nBase-1.Bottom, {}\nPad-1.Top, {}\n",
        names[0], names[1]
    );
    let held = "*BOUNDARY\nR1, ENCASTRE\nR2, ENCASTRE\n";
    let assembly = format!("{}{}{sets}", plate(1, -1.0), plate(2, 4.0));
    part.to_owned() + &model(&assembly, &format!("{pairs}{held}{more}"))
}

#[test]
fn analytical_surfaces_are_those_of_their_instances() {
    let friction = "*CHANGE FRICTION, INTERACTION=I\n*FRICTION\n0.1,\n*END STEP\n";
    let step = STEP.replace("*END STEP\n", friction);
    let text = two_plates(["Plate-1.Face", "Plate-2.Face"], &step);
    let (text, listed, deck) = converted(&text);
    assert_listed(&listed, &["analytical surface `Face` is made of"; 2]);
    let rigid = &deck.model.rigid_surfaces;
    let names: Vec<&str> = rigid.iter().map(|rigid| rigid.name.as_str()).collect();
    assert_eq!(names, ["Plate-1", "Plate-2"]);
    for (rigid, y) in rigid.iter().zip([-1.0, 4.0]) {
        let RigidShape::Facets { positions, .. } = &rigid.shape else {
            panic!("{:?}", rigid.shape);
        };
        assert!(positions.iter().all(|x| x.y == y), "{positions:?}");
    }
    for name in names {
        assert!(
            text.contains(&format!("b = {{ rigid = \"{name}\" }}")),
            "{text}"
        );
    }
    assert_eq!(text.matches("mu = 0.1").count(), 2, "{text}");
}

#[test]
fn a_name_of_surfaces_of_several_instances_is_listed() {
    let (_, listed, deck) = converted(&two_plates(["Face", "Plate-2.Face"], STEP));
    assert_listed(
        &listed,
        &[
            "analytical surface `Face` is made of",
            "analytical surface `Face` is made of",
            "contact of `Base-1.Bottom` and `Face`: several instances have a surface `Face`; write `INSTANCE.Face`",
        ],
    );
    assert_eq!(deck.model.pairs.len(), 1);
}
