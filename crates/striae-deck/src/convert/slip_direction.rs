//! Directions of anisotropic friction, as a texture of the first side of a pair.
//!
//! The first direction is that of the x axis on the surface, or of the z axis where the surface
//! faces x within 0.1 degrees. With `*ORIENTATION` whose row `axis, angle` names an axis close to
//! the normal (1 if there is none), it is that of the next axis, after the turn. Source: Abaqus
//! analysis guide, "Conventions" and "Orientations".

use super::{Model, has, numbers};
use crate::write::value::{list, number, vector};
use striae_mesh::Vec3;
use striae_meshfile::{Keyword, Row};

impl<'a> Model<'a> {
    /// The key `texture` of a side; empty where there is none, which is listed.
    pub(super) fn slip_directions(
        &mut self,
        row: &Row<'_>,
        surface: &str,
        orientation: &str,
    ) -> String {
        let found = match orientation.is_empty() {
            true => self.default_directions(surface),
            false => self.oriented(orientation),
        };
        match found {
            Ok(texture) => format!(", texture = {{ {texture} }}"),
            Err(what) => {
                let what = format!("*FRICTION, ANISOTROPIC: {what}; state the `texture` of side a");
                self.list(row.line, what);
                String::new()
            }
        }
    }

    fn default_directions(&mut self, surface: &str) -> Result<String, String> {
        let mut facing = [0; 2];
        for normal in self.normals(surface) {
            facing[usize::from(normal.x.abs() >= 0.1_f64.to_radians().cos())] += 1;
        }
        match facing {
            [_, 0] => Ok(format!("uniform = {}", vector(&Vec3::x()))),
            [0, _] => Ok(format!("uniform = {}", vector(&Vec3::z()))),
            _ => Err(format!("some of `{surface}` faces x and some does not")),
        }
    }

    /// Unit normals of the facets of a surface, none of one that is rigid.
    fn normals(&mut self, surface: &str) -> Vec<Vec3> {
        let mut normals = Vec::new();
        for (at, set) in self.facets(surface) {
            let mesh = &self.bodies[at].reading.mesh;
            let faces = match mesh.facet_sets.get(&set) {
                Some(faces) => faces.to_vec(),
                None => {
                    let nodes = set.strip_prefix("facets of ").unwrap_or_default();
                    let nodes = mesh.node_sets.get(nodes).unwrap_or_default();
                    mesh.faces_among(&mesh.boundary_faces(), nodes)
                }
            };
            for face in faces {
                let [a, b, c, d] = mesh
                    .face_nodes(face)
                    .map(|node| mesh.positions[node.index()]);
                normals.extend((c - a).cross(&(d - b)).try_normalize(0.0));
            }
        }
        normals
    }

    fn oriented(&mut self, name: &str) -> Result<String, String> {
        let bare = name.rsplit('.').next().unwrap_or(name);
        let mut keywords = self.keywords.iter();
        let named = |keyword: &&Keyword<'_>| {
            keyword.name == "ORIENTATION"
                && (has(keyword, "NAME", name) || has(keyword, "NAME", bare))
        };
        let keyword = keywords.find(named);
        let keyword = keyword.ok_or_else(|| format!("there is no *ORIENTATION `{name}`"))?;
        let faulty = || format!("*ORIENTATION `{name}`: no numbers");
        let points = keyword.rows.first().and_then(|row| numbers(&row.words));
        let points = points.filter(|all| all.len() >= 6).ok_or_else(faulty)?;
        let point = |at: usize| Vec3::new(points[at], points[at + 1], points[at + 2]);
        let (a, b) = (point(0), point(3));
        let turn = keyword.rows.get(1).and_then(|row| numbers(&row.words));
        let turn = turn.unwrap_or_default();
        let axis = turn.first().map_or(1, |axis| *axis as usize).clamp(1, 3);
        let degrees = turn.get(1).copied().unwrap_or(0.0);
        let system = keyword.parameter("SYSTEM").unwrap_or("RECTANGULAR");
        let definition = keyword.parameter("DEFINITION").unwrap_or("COORDINATES");
        if !definition.eq_ignore_ascii_case("COORDINATES") {
            return Err(format!("*ORIENTATION `{name}`, DEFINITION={definition}"));
        }
        match system.to_uppercase().as_str() {
            "RECTANGULAR" | "R" => {
                let origin = match points.len() {
                    9.. => point(6),
                    _ => Vec3::zeros(),
                };
                let x = (a - origin).try_normalize(0.0).ok_or_else(faulty)?;
                let z = x.cross(&(b - origin)).try_normalize(0.0);
                let z = z.ok_or_else(faulty)?;
                let axes = [x, z.cross(&x), z];
                let (about, next) = (axes[axis - 1], axes[axis % 3]);
                let (sin, cos) = degrees.to_radians().sin_cos();
                let direction = next * cos + about.cross(&next) * sin;
                self.used.insert(keyword.line);
                Ok(format!("uniform = {}", vector(&direction)))
            }
            "CYLINDRICAL" | "C" if degrees == 0.0 => {
                let key = ["circumferential", "axial", "radial"][axis - 1];
                let tuple = |x: Vec3| list([x.x, x.y, x.z].map(number));
                self.used.insert(keyword.line);
                let (point, along) = (tuple(a), tuple(b - a));
                Ok(format!(
                    "{key} = {{ point = {point}, direction = {along} }}"
                ))
            }
            other => Err(format!("*ORIENTATION `{name}`, SYSTEM={other}")),
        }
    }
}
