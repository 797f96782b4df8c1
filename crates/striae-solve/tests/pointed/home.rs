//! The facet that a pointed node was in at the start of an increment holds it, up to a tenth
//! beyond its edges in facet coordinates.

use striae_contact::{
    configuration::Configuration,
    pointed::kinematics,
    selection::{Before, Selection},
    side::Side,
    spot::faced,
    tip::Tip,
};
use striae_law::friction::Friction;
use striae_mesh::{FacetId, Vec3};
use striae_solve::{assembly::StepContext, node::GlobalNode, problem::Problem, state::State};
use striae_surface::node::SurfaceNode;

use crate::scene::{Floor, moved, standing, tilted};

/// Where two facets of the floor meet, and half the length of a facet along `x`.
const VALLEY: f64 = 0.23;
const HALF: f64 = 0.21;
/// Their slopes towards each other.
const SLOPE: f64 = 0.3;
const DEPTH: f64 = 0.02;
const Y: f64 = 1.0 / 6.0;

/// Unit normals of the two facets.
fn normals() -> [Vec3; 2] {
    [SLOPE, -SLOPE].map(|slope| Vec3::new(slope, 0.0, 1.0).normalize())
}

/// The place at a depth below the facet on the left, or its continuation, at `xi` on it.
fn place(xi: f64) -> Vec3 {
    let x = VALLEY + HALF * (xi - 1.0);
    Vec3::new(x, Y, SLOPE * (VALLEY - x)) - normals()[0] * DEPTH
}

/// Signed distances of a place from the planes of the two facets.
fn gaps(x: &Vec3) -> [f64; 2] {
    normals().map(|normal| normal.dot(&(x - Vec3::x() * VALLEY)))
}

/// A node of the edge of a block above a valley between two facets.
struct Scene<'a> {
    context: &'a StepContext<'a>,
    /// The node, on the surface and among all.
    node: SurfaceNode,
    global: GlobalNode,
}

impl<'a> Scene<'a> {
    fn new(context: &'a StepContext<'a>) -> Self {
        let at = |node: &SurfaceNode| {
            let global = context.problem.surface_node(0, Side::A, *node).unwrap();
            (context.start.positions[global] - Vec3::y() * Y).norm() < 1e-9
        };
        let node = SurfaceNode::all(64).find(at).unwrap();
        let global = context.problem.surface_node(0, Side::A, node).unwrap();
        Self {
            context,
            node,
            global,
        }
    }

    /// The valley with the node somewhere.
    fn configuration(&self, x: Vec3) -> Configuration<'a> {
        let mut positions = self.context.start.positions.clone();
        let floor = self.context.problem.first_node[1]..;
        for x in &mut positions[floor] {
            if x.z > -1e-9 {
                x.z = SLOPE * (x.x - VALLEY).abs();
            }
        }
        positions[self.global] = x;
        let rigid = &self.context.start.rigid;
        self.context.configuration(0, &positions, rigid)
    }

    /// The field of an increment that starts with the node somewhere.
    fn selection(&self, x: Vec3) -> Selection {
        let start = self.configuration(x);
        let none = self.context.start.pairs[0].kept.clone();
        let mut pointed = none.clone();
        pointed[0][self.node] = true;
        let before = Before {
            kept: &none,
            required: &none,
            pointed: &pointed,
            points: &Vec::new(),
        };
        Selection::new(&start, None, before, &self.context.fixed_on_pair[0])
    }

    /// The facet that the node faces, and its gap.
    fn faced(&self, selection: &Selection, x: Vec3) -> (FacetId, f64) {
        let now = self.configuration(x);
        let facet = faced(&now, selection.tip(Side::A, self.node), 1.0)
            .unwrap()
            .facet;
        let places = selection.pointed_places();
        assert_eq!(places.len(), 1);
        (
            facet,
            kinematics(&now, selection, places.start, None).gap.value,
        )
    }
}

#[test]
fn a_pointed_node_stays_with_its_facet_until_it_is_a_tenth_beyond() {
    let friction = Friction::coulomb(0.3).unwrap();
    let mut model = standing(tilted(33.0, 3), &["zmin", "xmin"], Floor::Soft, friction);
    model.steps = vec![moved(&model, [0.0; 3], 1)];
    let problem = Problem::new(model).unwrap();
    let start = State::undeformed(&problem);
    let context = StepContext::new(&problem, 0, &start);
    let scene = Scene::new(&context);
    let centre = |facet: FacetId| {
        let floor = scene.configuration(place(0.5));
        let corners = floor.side(Side::B).corner_positions(facet);
        corners.iter().sum::<Vec3>() * 0.25
    };
    let selection = scene.selection(place(0.9));
    let (home, _) = scene.faced(&selection, place(0.9));
    assert!((centre(home).x - (VALLEY - HALF)).abs() < 1e-9);
    for (xi, stays) in [
        (0.999, true),
        (1.001, true),
        (1.099, true),
        (1.101, false),
        (1.5, false),
    ] {
        let (facet, gap) = scene.faced(&selection, place(xi));
        assert_eq!(facet == home, stays, "{xi}");
        let of_planes = gaps(&place(xi));
        let expected = of_planes[usize::from(!stays)];
        assert!(
            (gap - expected).abs() < 1e-12,
            "{xi}: {gap} of {of_planes:?}"
        );
        if !stays {
            assert!((centre(facet).x - (VALLEY + HALF)).abs() < 1e-9);
        }
    }
    // What holds it is where the increment started.
    let beyond = place(1.05);
    let homeless = Tip::Node {
        side: Side::A,
        node: scene.node,
        home: None,
    };
    let other = faced(&scene.configuration(beyond), homeless, 1.0).unwrap();
    assert_ne!(other.facet, home);
    let next = scene.selection(beyond);
    assert_eq!(scene.faced(&next, beyond).0, other.facet);
    assert_eq!(scene.faced(&next, place(0.95)).0, other.facet);
    assert_eq!(scene.faced(&next, place(0.7)).0, home);
}
