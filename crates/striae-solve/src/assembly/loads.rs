//! Loads on faces, whole or where no contact surface covers them.

use striae_contact::{
    configuration::Configuration,
    exposed::{SurfaceLoad, covered_load},
    facet_coverage::FacetCoverage,
};
use striae_mesh::{Face, Vec3};
use striae_surface::{
    facet::Shape,
    scalar::{Real, combination, constant3},
};

use super::{Imposed, System, Trial, terms::Answer};
use crate::{outcome::CutBack, problem::ContactFacet};
use striae_model::{LoadExtent, LoadKind, Value, load};

impl System<'_> {
    pub(super) fn loads(
        &mut self,
        configurations: &[Configuration],
        trial: &Trial,
        imposed: &Imposed,
    ) -> Result<(), CutBack> {
        for (planned, kind) in self.context.plan.loads.iter().zip(&imposed.loads) {
            for face in &planned.faces {
                let extent = planned.extent;
                let body = planned.body.0;
                let loaded = self.face_load(configurations, trial, body, *face, kind, extent);
                loaded.map_err(|error| CutBack::Load {
                    body: self.context.problem.model.bodies[body].name.clone(),
                    set: planned.set.clone(),
                    error,
                })?;
            }
        }
        self.nodal_forces(imposed);
        Ok(())
    }

    /// Forces at nodes, each added by the rank that owns the node.
    fn nodal_forces(&mut self, imposed: &Imposed) {
        let share = self.inertia.share_of_end;
        for (node, force) in &imposed.forces {
            let first = self.layout.position(*node);
            for axis in 0..3 {
                self.residual[first + axis] -= force[axis] * share;
            }
            self.forces.applied[*node] += force;
        }
    }

    fn face_load(
        &mut self,
        configurations: &[Configuration],
        trial: &Trial,
        body: usize,
        face: Face,
        kind: &LoadKind<Value>,
        extent: LoadExtent,
    ) -> Result<(), load::LoadError> {
        let problem = self.context.problem;
        let corners = problem.model.bodies[body].mesh.face_nodes(face);
        let nodes = corners.map(|node| problem.node(body, node));
        let reference = nodes.map(|node| problem.reference[node]);
        let current = nodes.map(|node| trial.positions[node]);
        let mut covered = Vec::new();
        if extent == LoadExtent::Exposed {
            let facets = problem.contact_facets.get(&(body, face));
            for &ContactFacet { pair, side, facet } in facets.into_iter().flatten() {
                let configuration = &configurations[pair];
                match configuration.facet_coverage(side, facet) {
                    FacetCoverage::Whole => return Ok(()),
                    FacetCoverage::Bare => {}
                    FacetCoverage::Cut(covers) => {
                        let load = LoadOnFace {
                            kind,
                            reference: &reference,
                        };
                        covered.push((
                            pair,
                            covered_load(configuration, side, facet, &covers, &load),
                        ));
                    }
                }
            }
        }
        let share = self.inertia.share_of_end;
        let load = load::response(kind, &reference, &current)?;
        let unknowns = nodes.map(|node| self.layout.position(node));
        let unknowns: Vec<usize> = unknowns
            .iter()
            .flat_map(|first| *first..first + 3)
            .collect();
        self.add_dense(
            &nodes,
            &unknowns,
            &load.force.map(|f| -f * share),
            &load.tangent.map(|k| -k * share),
        );
        for (corner, node) in nodes.iter().enumerate() {
            let force = Vec3::from_column_slice(&load.force[3 * corner..3 * corner + 3]);
            self.forces.applied[*node] += force;
        }
        for (pair, terms) in covered {
            let answer = match kind {
                LoadKind::DeadTraction(_) => Answer::Dead,
                LoadKind::FollowerTraction(_) | LoadKind::Pressure(_) => Answer::Follower,
            };
            for mut term in terms {
                for (at, node) in nodes.iter().enumerate() {
                    let taken = Vec3::from_column_slice(&term.residual[3 * at..3 * at + 3]);
                    self.forces.applied[*node] -= taken;
                }
                term.residual.iter_mut().for_each(|r| *r *= share);
                term.tangent.iter_mut().for_each(|k| *k *= share);
                self.add_term(pair, &term, answer);
            }
        }
        Ok(())
    }
}

struct LoadOnFace<'a> {
    kind: &'a LoadKind<Value>,
    reference: &'a [Vec3; 4],
}

impl SurfaceLoad for LoadOnFace<'_> {
    fn per_area<D: Real>(
        &self,
        x: &[nalgebra::Vector3<D>; 4],
        xi: D,
        eta: D,
    ) -> nalgebra::Vector3<D> {
        let weights = Shape::of(self.reference).weights(xi, eta);
        let point = combination(&weights.value, &self.reference.map(|x| constant3(&x)));
        // Triangles have the same normals everywhere.
        let [xi, eta] = match Shape::of(self.reference) {
            Shape::Triangle => Shape::Quadrilateral.centre().map(D::from),
            Shape::Quadrilateral => [xi, eta],
        };
        load::traction(&self.kind.at(&point), self.reference, x, xi, eta)
    }
}
