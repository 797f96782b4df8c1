//! Bodies inside themselves and others: cases that are found and cases that are not.

use nalgebra::Rotation3;
use proptest::prelude::*;
use striae_contact::interference::{MovingSkins, Overlap, PlacedSkins, Skins, Spot};
use striae_mesh::{CellBlock, Mesh, NodeId, Vec3, generate::Block};
use striae_surface::topology::Surface;

fn block(origin: [f64; 3], size: [f64; 3], divisions: [usize; 3]) -> Mesh {
    let block = Block {
        origin: origin.into(),
        size: size.into(),
        divisions,
        ..Block::default()
    };
    block.mesh().unwrap()
}

/// Unit cells, `length` by 2 by 3, of which the middle ones are missing beyond the first `root`.
fn jaw(length: usize, root: usize) -> Mesh {
    let whole = block([0.0; 3], [length as f64, 2.0, 3.0], [length, 2, 3]);
    let is_left = |corners: &&[NodeId]| {
        let sum: Vec3 = corners.iter().map(|n| whole.positions[n.index()]).sum();
        let centre = sum / 8.0;
        centre.x < root as f64 || (centre.z - 1.5).abs() > 0.6
    };
    let cells = whole.elements().filter(is_left);
    let cells: Vec<[NodeId; 8]> = cells.map(|c| c.try_into().unwrap()).collect();
    let mut nodes: Vec<NodeId> = cells.iter().flatten().copied().collect();
    nodes.sort_unstable();
    nodes.dedup();
    let number = |node: NodeId| NodeId::new(nodes.binary_search(&node).unwrap());
    let cells = cells.iter().map(|corners| corners.map(number));
    let x = nodes.iter().map(|node| whole.positions[node.index()]);
    Mesh::new(x.collect(), vec![CellBlock::hexahedra(cells)]).unwrap()
}

/// The skins of bodies and where their nodes are.
fn skins(meshes: &[Mesh]) -> (Skins, Vec<Vec3>) {
    let (mut facets, mut bodies, mut x) = (Vec::new(), Vec::new(), Vec::new());
    for (body, mesh) in meshes.iter().enumerate() {
        for face in mesh.boundary_faces() {
            let corners = mesh.face_nodes(face);
            facets.push(corners.map(|node| NodeId::new(x.len() + node.index())));
            bodies.push(body);
        }
        x.extend_from_slice(&mesh.positions);
    }
    let surface = Surface::new(&facets);
    let x = surface.nodes().iter().map(|node| x[node.index()]).collect();
    (Skins { surface, bodies }, x)
}

/// Overlaps where places have been moved.
fn moved(meshes: &[Mesh], motion: impl Fn(&Vec3) -> Vec3) -> (Skins, Vec<Overlap>) {
    let (skins, x) = skins(meshes);
    let x: Vec<Vec3> = x.iter().map(motion).collect();
    let found = PlacedSkins::new(&skins, &x).overlaps(|_, _| true);
    (skins, found)
}

/// The upper lip of a jaw is turned down about the end of the slit by an angle.
fn bitten(root: f64, angle: f64) -> impl Fn(&Vec3) -> Vec3 {
    move |x: &Vec3| {
        let arm = Vec3::new(x.x - root, 0.0, x.z - 2.0);
        match x.z > 1.5 && arm.x > 0.0 {
            true => {
                let turned = Rotation3::from_axis_angle(&Vec3::y_axis(), angle) * arm;
                Vec3::new(root, x.y, 2.0) + turned
            }
            false => *x,
        }
    }
}

#[test]
fn a_jaw_overlaps_itself_from_where_its_lips_meet() {
    let tip = 4.0;
    let meet = (1.0_f64 / tip).asin();
    for (angle, is_in) in [(0.0, false), (0.98 * meet, false), (1.1 * meet, true)] {
        let (skins, found) = moved(&[jaw(6, 2)], bitten(2.0, angle));
        assert_eq!(!found.is_empty(), is_in, "{angle} {found:?}");
        for overlap in &found {
            assert_eq!(skins.body(overlap.spot), 0);
            assert!(overlap.depth < 0.3 && (overlap.size - 1.0).abs() < 0.1);
        }
    }
    let angle = 1.5 * meet;
    let (_, found) = moved(&[jaw(6, 2)], bitten(2.0, angle));
    let deepest = found
        .iter()
        .map(|overlap| overlap.depth)
        .fold(0.0, f64::max);
    // The tip, from the face that it is behind; the lower lip's tip lies under the upper lip.
    let tip = 1.0 - 4.0 * angle.sin();
    assert!(
        deepest >= -tip * angle.cos() && deepest < -1.3 * tip,
        "{deepest} {tip}"
    );
}

#[test]
fn what_is_thin_folded_or_closed_does_not_overlap() {
    // A plate of a hundredth of its facets.
    let plate = block([0.0; 3], [4.0, 4.0, 0.01], [4, 4, 1]);
    let plate = [plate];
    assert_eq!(moved(&plate, |x| *x).1, []);
    // Folded to a hundredth of a turn around its middle.
    let folded = |x: &Vec3| {
        let angle = 0.99 * std::f64::consts::PI * f64::from(u8::from(x.x > 2.0));
        let arm = Vec3::new(x.x - 2.0, 0.0, x.z - 0.01);
        let turned = Rotation3::from_axis_angle(&-Vec3::y_axis(), angle) * arm;
        Vec3::new(2.0, x.y, 0.01) + turned
    };
    assert_eq!(moved(&plate, folded).1, []);
    // Lips that just touch.
    let closed = |x: &Vec3| {
        Vec3::new(
            x.x,
            x.y,
            if x.z > 1.5 && x.x > 2.0 {
                x.z - 1.0
            } else {
                x.z
            },
        )
    };
    let (_, found) = moved(&[jaw(6, 2)], closed);
    assert!(
        found.iter().all(|overlap| overlap.depth < 1e-9),
        "{found:?}"
    );
}

#[test]
fn a_body_inside_another_one_is_found_from_both_and_touching_ones_are_not() {
    let lower = || block([0.0; 3], [1.0; 3], [4, 4, 4]);
    let upper = |z: f64| block([0.2, 0.3, z], [0.5; 3], [3, 3, 1]);
    assert!(
        moved(&[lower(), upper(1.0)], |x| *x)
            .1
            .iter()
            .all(|o| o.depth < 1e-12)
    );
    let (skins, found) = moved(&[lower(), upper(0.9)], |x| *x);
    let of = |body: usize| found.iter().filter(|o| skins.body(o.spot) == body).count();
    // All nodes and centres of the lowest face, none of the sides; what is under it of the other.
    assert_eq!([of(1), of(0)], [16 + 9, 4 + 4]);
    for overlap in &found {
        // Of the lower one some points are nearer to sides of the upper one.
        let is_upper = skins.body(overlap.spot) == 1;
        let least = if is_upper { 0.1 - 1e-12 } else { 0.05 - 1e-12 };
        assert!(overlap.depth >= least && overlap.depth < 0.1 + 1e-12);
        // The facets of the lower one are larger.
        assert!(!is_upper || overlap.size < 0.17);
    }
    let none = |_: Spot, _| false;
    let (skins, x) = self::skins(&[lower(), upper(0.9)]);
    assert_eq!(PlacedSkins::new(&skins, &x).overlaps(none), []);
}

#[test]
fn depth_at_the_edge_of_a_sheet_is_over_the_face_that_is_pressed() {
    let lower = block([-0.5, -0.5, 0.0], [2.0; 3], [8, 8, 8]);
    let sheet = block([0.0, 0.0, 1.98], [1.0, 1.0, 0.06], [4, 4, 1]);
    let (skins, found) = moved(&[lower, sheet], |x| *x);
    let of_sheet: Vec<&Overlap> = found.iter().filter(|o| skins.body(o.spot) == 1).collect();
    assert_eq!(of_sheet.len(), 25 + 16);
    for overlap in of_sheet {
        assert!((overlap.size - 0.25).abs() < 1e-12, "{overlap:?}");
    }
}

proptest! {
    #[test]
    fn no_motion_without_overlap_makes_one(
        axis in prop::array::uniform3(-1.0..1.0_f64),
        waves in prop::array::uniform3(-0.15..0.15_f64),
        bite in -0.2..0.22_f64,
    ) {
        let turn = Rotation3::new(Vec3::from(axis) * 3.0);
        let wave = |x: &Vec3| {
            let along = Vec3::new(waves[0] * x.y.sin(), waves[1] * x.z.sin(), waves[2] * x.x.sin());
            turn * (x + along)
        };
        let bitten = bitten(2.0, bite);
        let (_, found) = moved(&[jaw(6, 2)], |x| wave(&bitten(x)));
        prop_assert_eq!(found, []);
    }
}

/// Plates above each other, a tenth of a facet thick and as far apart.
fn plates() -> (Skins, Vec<Vec3>) {
    let plate = |z: f64, shift: f64| block([shift, shift, z], [3.0, 3.0, 0.1], [3, 3, 1]);
    skins(&[plate(0.0, 0.0), plate(0.2, 0.3)])
}

/// Bodies of the points that go through another one while the upper plate moves.
fn crossed(way: impl Fn(&Vec3) -> Vec3) -> (usize, usize) {
    let (skins, x) = plates();
    let moved = |x: &Vec3| if x.z > 0.15 { way(x) } else { *x };
    let end: Vec<Vec3> = x.iter().map(moved).collect();
    let found = MovingSkins::new(&skins, [&x, &end]).crossings(|_, _| true);
    let of = |body: usize| found.iter().filter(|f| skins.body(f.spot) == body).count();
    (of(0), of(1))
}

#[test]
fn plates_go_through_each_other_where_no_point_is_deep_inside() {
    let down = |way: f64| move |x: &Vec3| x - Vec3::z() * way;
    assert_eq!(crossed(down(0.05)), (0, 0));
    // Into the other one, not through it.
    assert_eq!(crossed(down(0.15)), (0, 0));
    let (lower, upper) = crossed(down(0.4));
    assert!(lower > 16 && upper > 16, "{lower} {upper}");
    // Crossed like the blades of scissors: all of one side is through, but for its border.
    let (lower, upper) = crossed(|x| x - Vec3::z() * (0.4 * (x.x - 0.3) / 3.0));
    assert!(lower > 4 && upper > 4, "{lower} {upper}");
    let (lower, upper) = crossed(|x| x + Vec3::new(5.0, 0.0, 0.0));
    assert_eq!((lower, upper), (0, 0));
}

#[test]
fn points_that_are_inside_already_go_through_as_well() {
    let (skins, x) = plates();
    let at = |way: f64| -> Vec<Vec3> {
        let down = |x: &Vec3| x - Vec3::z() * if x.z > 0.15 { way } else { 0.0 };
        x.iter().map(down).collect()
    };
    for (start, end, goes_through) in [(0.12, 0.14, false), (0.12, 0.05, false), (0.12, 0.4, true)]
    {
        let found = MovingSkins::new(&skins, [&at(start), &at(end)]).crossings(|_, _| true);
        assert_eq!(!found.is_empty(), goes_through, "{start} {end}");
    }
}

#[test]
fn a_body_that_turns_goes_through_nothing() {
    let (skins, x) = plates();
    for angle in [0.3, 1.5, 3.0] {
        let turn = Rotation3::from_euler_angles(angle, 0.4 * angle, -0.7 * angle);
        let end: Vec<Vec3> = x.iter().map(|x| turn * x).collect();
        let found = MovingSkins::new(&skins, [&x, &end]).crossings(|_, _| true);
        assert_eq!(found, [], "{angle}");
    }
}
