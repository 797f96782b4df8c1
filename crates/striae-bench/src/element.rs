//! Times of the response of single elements, on one thread.

use crate::clock::timed;
use serde_json::Value;
use std::{error::Error, hint::black_box, ops::Range, time::Instant};
use striae_element::{Driven, ElementBlock, ElementResponse, Elements, Formulation};
use striae_law::bulk::{LameConstants, Material, Past};
use striae_mesh::{CellKind, Mesh, Vec3, generate::Block};

/// Turns that are taken with the standard hexahedron.
const TURNS: usize = 2000;
/// Elements of a turn: so few that hardly any turn is interrupted.
const A_TURN: usize = 50;

/// Elements, with hexahedra of the standard formulation as the measure of all others.
pub fn all() -> Result<Vec<Value>, Box<dyn Error>> {
    let hexahedra = Stretched::new(CellKind::Hexahedron, Formulation::Standard)?;
    let mut results = vec![hexahedra.timed("standard")];
    for (kind, formulation, name) in [
        (CellKind::Hexahedron, Formulation::MeanDilatation, "mean"),
        (CellKind::Hexahedron, Formulation::AssumedStrain, "assumed"),
        (CellKind::Tetrahedron, Formulation::Standard, "standard"),
        (
            CellKind::CompositeTetrahedron,
            Formulation::Standard,
            "standard",
        ),
        (
            CellKind::CompositeTetrahedron,
            Formulation::MeanDilatation,
            "mean",
        ),
    ] {
        let others = Stretched::new(kind, formulation)?;
        let mut result = others.timed(name);
        let ratio = ratio(&others, &hexahedra);
        println!("{:42} {ratio:.2} times the standard hexahedron", "");
        result["over_standard_hexahedron"] = ratio.into();
        results.push(result);
    }
    Ok(results)
}

/// Elements of a block that is stretched.
struct Stretched {
    kind: CellKind,
    mesh: Mesh,
    elements: Elements,
    current: Vec<Vec3>,
    rubber: Material,
}

impl Stretched {
    fn new(kind: CellKind, formulation: Formulation) -> Result<Self, Box<dyn Error>> {
        let block = Block {
            divisions: [10; 3],
            irregularity: 0.1,
            cells: kind,
            ..Block::default()
        };
        let mesh = block.mesh()?;
        let stretched = |x: &Vec3| Vec3::new(1.1 * x.x, x.y + 0.1 * x.x * x.z, 0.95 * x.z);
        Ok(Self {
            kind,
            elements: Elements::new(&mesh, formulation)?,
            current: mesh.positions.iter().map(stretched).collect(),
            rubber: Material::neo_hookean(LameConstants::from_youngs_modulus(1.0, 0.49)?),
            mesh,
        })
    }

    /// The block of elements, all of one kind.
    fn block(&self) -> &dyn ElementBlock {
        let (_, block) = self.elements.blocks().next().expect("elements");
        block
    }

    /// Responses of some elements.
    fn respond(&self, elements: Range<usize>, response: &mut ElementResponse) {
        let block = self.block();
        let corners = self.mesh.elements().skip(elements.start);
        for (at, corners) in elements.zip(corners) {
            let mut x = [Vec3::zeros(); striae_mesh::MAX_CORNERS];
            for (x, node) in x.iter_mut().zip(corners) {
                *x = self.current[node.index()];
            }
            let x = &x[..corners.len()];
            let result = block.respond(
                at,
                x,
                &Driven::from(&self.rubber),
                Past::default(),
                response,
            );
            black_box((result.is_ok(), response.energy));
        }
    }

    fn timed(&self, name: &str) -> Value {
        let mut response = ElementResponse::zero(self.block(), &self.rubber);
        let name = format!("{}, {name}", self.kind);
        timed("element", &name, self.block().count(), || {
            self.respond(0..self.block().count(), &mut response);
        })
    }
}

/// Time of an element over that of another one: the median of many turns, in which the two
/// follow each other within a fraction of a millisecond.
fn ratio(ours: &Stretched, others: &Stretched) -> f64 {
    let both = [ours, others];
    let mut responses = both.map(|of| ElementResponse::zero(of.block(), &of.rubber));
    let mut ratios: Vec<f64> = (0..TURNS)
        .map(|turn| {
            let [ours, others] = [0, 1].map(|which| {
                let first = turn * A_TURN % (both[which].block().count() - A_TURN);
                let begin = Instant::now();
                both[which].respond(first..first + A_TURN, &mut responses[which]);
                begin.elapsed().as_secs_f64()
            });
            ours / others
        })
        .collect();
    ratios.sort_by(f64::total_cmp);
    ratios[TURNS / 2]
}
