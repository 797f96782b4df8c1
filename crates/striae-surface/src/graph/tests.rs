use proptest::prelude::*;

use super::*;

type Edge = (SurfaceNode, SurfaceNode, f64);

/// Shortest distances between all nodes, by R. W. Floyd, doi:10.1145/367766.368168.
fn floyd_warshall(nodes: usize, edges: &[Edge]) -> Vec<Vec<f64>> {
    let mut distances = vec![vec![f64::INFINITY; nodes]; nodes];
    for &(a, b, length) in edges {
        let (a, b) = (a.index(), b.index());
        distances[a][b] = length.min(distances[a][b]);
        distances[b][a] = distances[a][b];
    }
    for i in 0..nodes {
        distances[i][i] = 0.0;
    }
    for k in 0..nodes {
        for i in 0..nodes {
            for j in 0..nodes {
                let through = distances[i][k] + distances[k][j];
                distances[i][j] = through.min(distances[i][j]);
            }
        }
    }
    distances
}

/// Sparse graphs, often of several components and with many ties.
fn graphs() -> impl Strategy<Value = (usize, Vec<Edge>)> {
    (2usize..30).prop_flat_map(|nodes| {
        let node = (0..nodes).prop_map(SurfaceNode::new);
        let length = prop_oneof![Just(1.0), 0.01..3.0f64];
        let edges = prop::collection::vec((node.clone(), node, length), 1..60);
        (Just(nodes), edges)
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    #[test]
    fn distances_equal_those_of_brute_force((nodes, edges) in graphs()) {
        let graph = EdgeGraph::from_edges(nodes, edges.iter().copied());
        let expected = floyd_warshall(nodes, &edges);
        for source in 0..nodes {
            let distances = graph.distances_from(SurfaceNode::new(source));
            for node in 0..nodes {
                let (found, expected) = (distances[node], expected[source][node]);
                prop_assert!(
                    found == expected || (found - expected).abs() <= 1e-14 * expected,
                    "{source} to {node}: {found} instead of {expected}"
                );
            }
        }
    }

    #[test]
    fn renumbering_changes_no_bit(
        (nodes, edges) in graphs(),
        seed in any::<prop::sample::Index>(),
    ) {
        let shift = seed.index(nodes) as u32;
        let last = nodes as u32 - 1;
        let new = |node: SurfaceNode| SurfaceNode(last - (node.0 + shift) % nodes as u32);
        let graph = EdgeGraph::from_edges(nodes, edges.iter().copied());
        let renumbered = EdgeGraph::from_edges(
            nodes,
            edges.iter().rev().map(|&(a, b, length)| (new(b), new(a), length)),
        );
        for source in SurfaceNode::all(nodes) {
            let distances = graph.distances_from(source);
            let again = renumbered.distances_from(new(source));
            for node in SurfaceNode::all(nodes) {
                prop_assert_eq!(distances[node], again[new(node)]);
            }
        }
    }
}

#[test]
fn triangles_and_quadrilaterals_have_their_sides_only() {
    let square = |x: f64, y: f64| Vec3::new(x, y, 0.0);
    let positions = [
        square(0.0, 0.0),
        square(3.0, 0.0),
        square(3.0, 4.0),
        square(0.0, 4.0),
        square(6.0, 0.0),
        square(9.0, 9.0),
    ];
    let graph = EdgeGraph::new(
        &positions,
        &[[0, 1, 2, 3], [1, 4, 2, 2]].map(|facet| facet.map(SurfaceNode)),
    );
    let distances = graph.distances_from(SurfaceNode(0));
    assert_eq!(distances, [0.0, 3.0, 7.0, 4.0, 6.0, f64::INFINITY]);
}
