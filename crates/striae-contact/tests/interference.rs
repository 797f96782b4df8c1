//! Interference of two sides: cases that are found and cases that are not, independent of sides,
//! numbering and axes.

use nalgebra::Rotation3;
use striae_contact::{
    configuration::Configuration,
    interference::{
        Interference, Kind, SHARE, Stage, Thickness, fibres, inside, interferences, lengths,
    },
    pair::{ContactPair, Enforcement, Geometry, PairedSurface},
    placement::Placement,
    side::Side,
};
use striae_mesh::{Mesh, Vec3, generate::Block};
use striae_surface::topology::Surface;

/// A body with one contact surface.
struct Body {
    surface: Surface,
    /// Reference positions of the surface nodes.
    x: Vec<Vec3>,
    /// Reference thickness.
    thickness: Vec<f64>,
}

fn body(mesh: &Mesh, sets: &[&str]) -> Body {
    let faces = sets
        .iter()
        .flat_map(|set| mesh.facet_sets.get(set).unwrap());
    let facets: Vec<_> = faces.map(|&face| mesh.face_nodes(face)).collect();
    let surface = Surface::new(&facets);
    let skin: Vec<_> = mesh.boundary_faces();
    let skin: Vec<_> = skin.into_iter().map(|face| mesh.face_nodes(face)).collect();
    let skin = Surface::new(&skin);
    let at = |surface: &Surface| -> Vec<Vec3> {
        let nodes = surface.nodes().iter();
        nodes.map(|node| mesh.positions[node.index()]).collect()
    };
    let (x, skin_x) = (at(&surface), at(&skin));
    let fibres = fibres(&surface, &x, &skin, &skin_x);
    let thickness = lengths(&surface, &x, &fibres, |node| {
        skin_x[skin.node(node).unwrap()]
    });
    Body {
        surface,
        x,
        thickness,
    }
}

fn block(origin: [f64; 3], size: [f64; 3], divisions: [usize; 3]) -> Mesh {
    let block = Block {
        origin: origin.into(),
        size: size.into(),
        divisions,
        ..Block::default()
    };
    block.mesh().unwrap()
}

fn side(geometry: Geometry) -> PairedSurface {
    PairedSurface {
        geometry,
        stiffness: 1.0,
        texture: None,
        behind: Vec::new(),
        enclosure: None,
    }
}

fn pair(a: Geometry, b: Geometry) -> ContactPair {
    ContactPair {
        name: "pair".to_owned(),
        sides: [side(a), side(b)],
        enforcement: Enforcement::Weighted,
        search_distance: None,
        has_faces: false,
        one_body: false,
        wear: [0.0; 2],
        wear_across: 1.0,
    }
}

fn stage<'a>(configuration: &'a Configuration, thickness: &'a Thickness) -> Stage<'a> {
    Stage {
        configuration,
        thickness,
    }
}

type Motion<'a> = &'a dyn Fn(&Vec3) -> Vec3;

/// Interference of two bodies that go from one place to another.
fn between(bodies: [&Body; 2], from: [Motion; 2], to: [Motion; 2]) -> Vec<Interference> {
    let [a, b] = bodies.map(|body| Geometry::Deformable(body.surface.clone()));
    let pair = pair(a, b);
    let at = |motions: [Motion; 2]| {
        let x = Side::BOTH.map(|side| bodies[side].x.iter().map(motions[side]).collect());
        Configuration::new(&pair, x, Placement::at_rest())
    };
    let thickness = Thickness(bodies.map(|body| body.thickness.clone()));
    let (start, end) = (at(from), at(to));
    let [start, end] = [&start, &end].map(|at| stage(at, &thickness));
    interferences(&start, &end, SHARE)
}

fn at_rest(x: &Vec3) -> Vec3 {
    *x
}

fn shifted(x: f64, y: f64, z: f64) -> impl Fn(&Vec3) -> Vec3 {
    move |at| at + Vec3::new(x, y, z)
}

/// A unit block below and a smaller one above it, with other divisions.
fn two_blocks() -> [Body; 2] {
    let lower = block([0.0; 3], [1.0; 3], [4, 4, 4]);
    let upper = block([0.2, 0.3, 1.0], [0.5, 0.5, 0.5], [3, 3, 3]);
    [body(&lower, &["zmax"]), body(&upper, &["zmin"])]
}

#[test]
fn bodies_are_as_thick_as_they_are() {
    for body in two_blocks().iter().zip([1.0, 0.5]) {
        assert!(body.0.thickness.iter().all(|t| (t - body.1).abs() < 1e-12));
    }
}

#[test]
fn a_block_pressed_into_a_block_from_a_gap_is_found_both_ways() {
    let [lower, upper] = two_blocks();
    let (open, pressed) = (shifted(0.0, 0.0, 0.4), shifted(0.0, 0.0, -0.2));
    let found = between([&lower, &upper], [&at_rest, &open], [&at_rest, &pressed]);
    let of = |side: Side| found.iter().filter(|i| i.side == side).count();
    // All 16 nodes and 9 centres of the upper one; of the lower one 3 x 2 nodes under it
    // (x = .25, .5, y = .5, .75 of which x = .2 .. .7, y = .3 .. .8) and 2 x 2 centres.
    assert_eq!(of(Side::B), 25);
    assert_eq!(of(Side::A), 4 + 4);
    assert!(
        found
            .iter()
            .all(|i| i.kind == Kind::Inside && (i.depth - 0.2).abs() < 1e-12)
    );
    let through = shifted(0.0, 0.0, -3.0);
    let found = between([&lower, &upper], [&at_rest, &open], [&at_rest, &through]);
    assert_eq!(found.len(), 33);
    assert!(found.iter().all(|i| i.kind != Kind::Inside));
}

#[test]
fn sides_and_axes_do_not_matter() {
    let [lower, upper] = two_blocks();
    let turn = Rotation3::from_euler_angles(0.4, -1.1, 2.0);
    let (open, pressed) = (shifted(0.01, 0.0, 0.4), shifted(0.07, 0.05, -0.2));
    let found = between([&lower, &upper], [&at_rest, &open], [&at_rest, &pressed]);
    let swapped = between([&upper, &lower], [&open, &at_rest], [&pressed, &at_rest]);
    let turned = between(
        [&lower, &upper],
        [&|x| turn * x, &|x| turn * open(x)],
        [&|x| turn * x, &|x| turn * pressed(x)],
    );
    let key = |i: &Interference, side: Side| (side, i.spot);
    let mut swapped_keys: Vec<_> = swapped.iter().map(|i| key(i, i.side.opposite())).collect();
    swapped_keys.sort_unstable();
    let keys = |list: &[Interference]| list.iter().map(|i| key(i, i.side)).collect::<Vec<_>>();
    assert!(!found.is_empty());
    assert_eq!(keys(&found), swapped_keys);
    assert_eq!(keys(&found), keys(&turned));
    for (one, other) in found.iter().zip(&turned) {
        assert!((one.depth - other.depth).abs() < 1e-12);
        assert!((turn * one.point - other.point).norm() < 1e-12);
    }
}

#[test]
fn a_thin_sheet_that_is_passed_is_found() {
    let sheet = block([0.0; 3], [1.0, 1.0, 0.01], [5, 5, 1]);
    let punch = block([0.25, 0.25, 0.02], [0.4, 0.4, 0.2], [2, 2, 2]);
    let below = block([0.25, 0.25, -0.5], [0.4, 0.4, 0.45], [2, 2, 2]);
    let [top, both] = [&["zmax"][..], &["zmax", "zmin"][..]].map(|sets| body(&sheet, sets));
    let (punch, below) = (body(&punch, &["zmin"]), body(&below, &["zmin", "zmax"]));
    let through = shifted(0.0, 0.0, -0.9);
    for sheet in [&top, &both] {
        let found = between([&punch, sheet], [&at_rest, &at_rest], [&through, &at_rest]);
        assert!(found.iter().filter(|i| i.side == Side::A).count() >= 9 + 4);
        assert!(found.iter().all(|i| i.kind != Kind::Inside), "{found:?}");
        // What is below the sheet all the time is not inside.
        let up = shifted(0.0, 0.0, 0.04);
        let none = between([&below, sheet], [&at_rest, &at_rest], [&up, &at_rest]);
        assert_eq!(none, []);
    }
}

#[test]
fn a_block_beside_or_far_from_another_is_not_inside() {
    let [lower, upper] = two_blocks();
    // Far away, past the edge and below the face, and from there back above it.
    let far = shifted(0.0, 0.0, 30.0);
    let beside = shifted(1.2, 0.0, -0.6);
    let flush = shifted(0.8 + 1e-4, 0.0, -0.6);
    let above = shifted(0.0, 0.0, 1e-6);
    for [from, to] in [
        [&far as Motion, &above],
        [&far, &beside],
        [&beside, &flush],
        [&flush, &beside],
        [&above, &shifted(2.0, 0.0, 0.0)],
    ] {
        assert_eq!(
            between([&lower, &upper], [&at_rest, from], [&at_rest, to]),
            []
        );
    }
}

#[test]
fn a_partial_overlap_is_found_where_it_is() {
    let [lower, upper] = two_blocks();
    let (open, pressed) = (shifted(0.6, 0.0, 0.1), shifted(0.6, 0.0, -0.2));
    let found = between([&lower, &upper], [&at_rest, &open], [&at_rest, &pressed]);
    // The upper one spans x = .8 .. 1.3: two of four columns of nodes are over the face,
    // one of three columns of centres; of the lower one no node, a column of centres.
    let count = |side: Side| found.iter().filter(|i| i.side == side).count();
    assert_eq!(count(Side::B), 8 + 3);
    assert_eq!(count(Side::A), 2 + 2);
    assert!(
        found
            .iter()
            .filter(|i| i.side == Side::B)
            .all(|i| i.point.x < 1.0)
    );
}

#[test]
fn sliding_contact_with_small_penetrations_is_none() {
    let [lower, upper] = two_blocks();
    // One hundredth of a facet in, wavy, slid by a tenth up to several facets.
    let wave = |x: &Vec3| 0.0025 * (9.0 * x.x + 4.0 * x.y).sin();
    let wavy = move |x: &Vec3| x + Vec3::new(0.0, 0.0, wave(x));
    for way in [0.02, 0.1, 0.3, 1.5] {
        let slid = move |x: &Vec3| x + Vec3::new(way, 0.3 * way, -0.001);
        for [from, to] in [[&at_rest as Motion, &slid], [&slid, &at_rest]] {
            let found = between([&lower, &upper], [&at_rest, from], [&wavy, to]);
            assert_eq!(found, [], "{way}");
        }
    }
}

#[test]
fn bodies_that_turn_together_do_not_interfere() {
    let [lower, upper] = two_blocks();
    let closed = shifted(0.0, 0.0, -0.002);
    for angle in [0.1_f64, 0.5, 1.0] {
        let turn = Rotation3::new(Vec3::new(0.3, -0.8, 0.5).normalize() * angle);
        let turned: Motion = &|x| turn * x;
        let closed_and_turned: Motion = &|x| turn * closed(x);
        let found = between(
            [&lower, &upper],
            [&at_rest, &closed],
            [turned, closed_and_turned],
        );
        assert_eq!(found, [], "{angle}");
    }
}

#[test]
fn a_corner_that_turns_into_a_face_is_found() {
    let [lower, upper] = two_blocks();
    let tilted = |x: &Vec3| {
        let about = Vec3::new(0.2, 0.3, 1.0);
        about + Rotation3::from_axis_angle(&Vec3::y_axis(), 0.5) * (x - about)
    };
    let found = between([&lower, &upper], [&at_rest; 2], [&at_rest, &tilted]);
    let of_upper = found.iter().filter(|i| i.side == Side::B);
    let deepest = of_upper.map(|i| i.depth).fold(0.0, f64::max);
    assert!((deepest - 0.5 * 0.5_f64.sin()).abs() < 1e-12);
    assert!(found.iter().any(|i| i.side == Side::A));
}

#[test]
fn depth_that_was_there_before_is_no_news() {
    let [lower, upper] = two_blocks();
    let (half, more) = (shifted(0.0, 0.0, -0.1), shifted(0.0, 0.0, -0.11));
    let bodies = [&lower, &upper];
    assert_eq!(between(bodies, [&at_rest, &half], [&at_rest, &half]), []);
    assert_eq!(between(bodies, [&at_rest, &more], [&at_rest, &half]), []);
    assert!(!between(bodies, [&at_rest, &half], [&at_rest, &more]).is_empty());
}

#[test]
fn a_block_pressed_through_a_plane_is_found_whatever_the_way() {
    let upper = body(&block([0.0; 3], [1.0; 3], [2, 2, 2]), &["zmin"]);
    let normal = Vec3::z();
    let point = Vec3::new(0.0, 0.0, -0.3);
    let pair = pair(
        Geometry::Deformable(upper.surface.clone()),
        Geometry::Plane { point, normal },
    );
    let thickness = Thickness([upper.thickness.clone(), Vec::new()]);
    let at = |z: f64, placement| {
        let x = upper.x.iter().map(|x| x + Vec3::new(0.0, 0.0, z)).collect();
        Configuration::new(&pair, [x, Vec::new()], placement)
    };
    let start = at(0.0, Placement::at_rest());
    for (z, lift, count) in [
        (-0.31, 0.0, 0),
        (-0.36, 0.0, 9),
        (-7.0, 0.0, 9),
        (0.0, 0.5, 9),
    ] {
        let end = at(z, Placement::shifted(Vec3::new(0.0, 0.0, lift)));
        let found = interferences(&stage(&start, &thickness), &stage(&end, &thickness), SHARE);
        assert_eq!(found.len(), count);
        let depth = lift - z - 0.3;
        assert!(found.iter().all(|i| (i.depth - depth).abs() < 1e-12));
    }
    let end = at(-0.5, Placement::at_rest());
    assert_eq!(inside(&stage(&end, &thickness), SHARE).len(), 9 + 4);
}

/// A ridge of triangles along `y` under a block, whose edge is between its nodes.
fn ridge() -> (Surface, Vec<Vec3>) {
    let x = [
        [0.0, -1.0, -0.5],
        [0.6, -1.0, 0.0],
        [1.2, -1.0, -0.5],
        [0.0, 2.0, -0.5],
        [0.6, 2.0, 0.0],
        [1.2, 2.0, -0.5],
    ];
    let facets = [[0, 1, 4, 3], [1, 2, 5, 4]].map(|f: [usize; 4]| f.map(striae_mesh::NodeId::new));
    (Surface::new(&facets), x.map(Vec3::from).to_vec())
}

#[test]
fn a_rigid_ridge_that_enters_between_nodes_is_found() {
    let mesh = block([0.0, 0.0, 0.0], [1.0; 3], [1, 1, 1]);
    let body = body(&mesh, &["zmin"]);
    let (surface, rigid_x) = ridge();
    let count = surface.facets().len();
    let pair = pair(
        Geometry::Deformable(body.surface.clone()),
        Geometry::Rigid(surface),
    );
    let thickness = Thickness([body.thickness.clone(), vec![f64::INFINITY; count]]);
    let at = |z: f64| {
        let x = body.x.iter().map(|x| x + Vec3::new(0.0, 0.0, z)).collect();
        Configuration::new(&pair, [x, rigid_x.clone()], Placement::at_rest())
    };
    let (start, end) = (at(0.1), at(-0.3));
    let [start, end] = [&start, &end].map(|at| stage(at, &thickness));
    let found = interferences(&start, &end, SHARE);
    // No node of the ridge is under the block, and no node of the block over it; the
    // centre of the block's facet is.
    assert_eq!(found.len(), 1);
    assert!((found[0].point - Vec3::new(0.5, 0.5, -0.3)).norm() < 1e-12);
}
