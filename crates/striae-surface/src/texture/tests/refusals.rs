//! Everything that is refused, and by which node.

use striae_mesh::{FacetId, Vec3};

use super::shapes::*;
use crate::{
    node::SurfaceNode,
    texture::{Field, Lines, Paint, Texture, TextureError},
};

fn square() -> Shape {
    Shape::patch(2, |u, v| Vec3::new(u, v, 0.0))
}

fn fault(shape: &Shape, paint: &Paint) -> TextureError {
    let normals = vec![Vec3::z(); shape.positions.len()];
    Texture::new(&shape.positions, &shape.facets, &normals, paint).unwrap_err()
}

fn nodes(directions: &[(u32, Vec3)]) -> Paint {
    Paint::Nodes {
        directions: directions
            .iter()
            .map(|&(node, direction)| (SurfaceNode(node), direction))
            .collect(),
        width: None,
    }
}

#[test]
fn directions_without_tangential_part() {
    let at = |node| TextureError::Vanishing {
        node: SurfaceNode(node),
    };
    assert_eq!(fault(&square(), &uniform(Vec3::z())), at(0));
    assert_eq!(fault(&square(), &uniform(Vec3::zeros())), at(0));
    let mut axis = z_axis();
    axis.point = Vec3::new(0.5, 0.5, -3.0);
    for lines in [Lines::Circumferential(axis), Lines::Radial(axis)] {
        let circles = Paint::Field(Field { lines, turn: 0.2 });
        assert_eq!(fault(&square(), &circles), at(4));
    }
    let mut directions = vec![Vec3::x(); 9];
    directions[7] = Vec3::z();
    assert_eq!(fault(&square(), &Paint::Nodal(directions)), at(7));
    assert_eq!(fault(&square(), &nodes(&[(3, Vec3::z())])), at(3));
    // Opposed directions cancel on the line in between.
    let opposed = nodes(&[(3, Vec3::x()), (5, -Vec3::x())]);
    assert_eq!(fault(&square(), &opposed), at(1));
    assert_eq!(fault(&square(), &uniform(Vec3::repeat(f64::NAN))), at(0));
}

#[test]
fn parts_without_paint() {
    let mut shape = square();
    let upper = shape
        .positions
        .iter()
        .map(|x| x + Vec3::z())
        .collect::<Vec<_>>();
    shape.positions.extend(upper);
    shape.facets.extend(
        square()
            .facets
            .iter()
            .map(|f| f.map(|node| SurfaceNode(node.0 + 9))),
    );
    let unpainted = |node| TextureError::Unpainted {
        node: SurfaceNode(node),
    };
    assert_eq!(fault(&shape, &nodes(&[(0, Vec3::x())])), unpainted(9));
    assert_eq!(fault(&shape, &nodes(&[(12, Vec3::x())])), unpainted(0));
}

#[test]
fn wrong_paint() {
    let x = Vec3::x();
    let (node, nodes_of_square) = (SurfaceNode(4), 9);
    assert_eq!(fault(&square(), &nodes(&[])), TextureError::NothingPainted);
    assert_eq!(
        fault(&square(), &nodes(&[(4, x), (4, x)])),
        TextureError::PaintedTwice { node }
    );
    assert_eq!(
        fault(&square(), &nodes(&[(9, x)])),
        TextureError::MissingNode {
            node: SurfaceNode(9),
            nodes: nodes_of_square
        }
    );
    assert_eq!(
        fault(&square(), &Paint::Nodal(vec![x; 3])),
        TextureError::Count {
            what: "directions",
            found: 3,
            nodes: nodes_of_square
        }
    );
    let centre = Vec3::new(0.52, 0.49, 0.0);
    let paint = |width| Paint::Points {
        directions: vec![(centre, x)],
        width,
    };
    for width in [0.0, -1.0, f64::INFINITY] {
        let expected = TextureError::Width { width };
        assert_eq!(fault(&square(), &paint(Some(width))), expected);
    }
}

#[test]
fn wrong_surfaces() {
    let paint = uniform(Vec3::x());
    let mut loose = square();
    loose.positions.push(Vec3::zeros());
    assert_eq!(
        fault(&loose, &paint),
        TextureError::LooseNode {
            node: SurfaceNode(9)
        }
    );
    let mut missing = square();
    missing.facets[2][1] = SurfaceNode(11);
    assert_eq!(
        fault(&missing, &paint),
        TextureError::MissingNode {
            node: SurfaceNode(11),
            nodes: 9
        }
    );
    let mut flat = square();
    flat.positions[4] = Vec3::new(0.25, 0.25, 0.0); // facet 0 becomes a triangle
    assert_eq!(
        fault(&flat, &paint),
        TextureError::DegenerateFacet {
            facet: FacetId(0),
            node: SurfaceNode(4)
        }
    );
    let mut inward = square();
    inward.facets[1].reverse();
    assert!(matches!(
        fault(&inward, &paint),
        TextureError::DegenerateFacet {
            facet: FacetId(1),
            ..
        }
    ));
}

#[test]
fn a_surface_that_collapses_loses_its_texture() {
    let shape = square();
    let texture = shape.painted(&uniform(Vec3::x()));
    let line: Vec<Vec3> = (shape.positions.iter())
        .map(|x| Vec3::new(0.0, x.y, 0.0))
        .collect();
    assert_eq!(
        texture.at(SurfaceNode(4), &line, Vec3::z()),
        Err(TextureError::Vanishing {
            node: SurfaceNode(4)
        })
    );
}
