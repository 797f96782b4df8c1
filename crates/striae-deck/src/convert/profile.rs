//! Analytical surfaces: planes, and facets of profiles that are extruded or revolved.
//!
//! In a part the profile of `TYPE=CYLINDER` is in the plane of x and y and its generator is z; that
//! of `TYPE=REVOLUTION` is in the plane of the radius x and the height y, and turns about y. Arcs
//! are divided every five degrees. Their free side is that of the bodies nearby. Source:
//! Abaqus keywords reference guide, `*SURFACE`.

use super::rigid::{Rigid, Shape};
use super::{Model, has, numbers};
use std::collections::HashMap;
use std::f64::consts::TAU;
use striae_mesh::{Mesh, NodeId, Vec3};
use striae_meshfile::Keyword;

/// Pieces of a turn.
const PIECES: usize = 72;
/// Share of the largest coordinate within which facets are about as near as the nearest one.
const NEAR: f64 = 0.02;
/// Facets along a generator.
const ALONG: usize = 12;

/// An analytical surface where it is stated.
struct Stated<'a> {
    /// The keyword of its instance and the name of this.
    instance: &'a Keyword<'a>,
    name: &'a str,
    keyword: &'a Keyword<'a>,
    /// `true` if no other instance has a surface of this name.
    is_alone: bool,
}

impl<'a> Model<'a> {
    /// Makes a rigid body of an analytical surface; `owner` is the instance by place that states it.
    pub(super) fn analytical_body(
        &mut self,
        keyword: &Keyword<'_>,
        surface: &str,
        owner: Option<usize>,
    ) {
        let reference = keyword.parameter("REF NODE");
        let reference = reference.and_then(|word| self.point_of(keyword, word, owner));
        let found = self.analytical(surface, owner);
        let made = found.and_then(|of| Ok((self.shape(&of)?, of)));
        let (shape, of) = match made {
            Ok(made) => made,
            Err(what) => {
                self.list(keyword.line, format!("*RIGID BODY `{surface}`: {what}"));
                return;
            }
        };
        let (line, instance) = (of.keyword.line, of.name);
        let bare = of.keyword.parameter("NAME").unwrap_or_default();
        let mut names = vec![format!("{instance}.{bare}")];
        names.extend(of.is_alone.then(|| bare.to_owned()));
        let mut rigid = Rigid::new(keyword.line, self.rigid_name(instance), shape, reference);
        rigid.surfaces = names.into_iter().map(|name| name.to_uppercase()).collect();
        if let Shape::Facets(_, facets) = &rigid.shape {
            let count = facets.len();
            let what = format!("analytical surface `{surface}` is made of {count} facets");
            self.list(line, what);
        }
        self.rigid.push(rigid);
        let stated = self.keywords.iter().find(|keyword| keyword.line == line);
        if let Some(stated) = stated.filter(|_| self.used.insert(line)) {
            self.list_parameters(stated, &["NAME", "TYPE", "INTERNAL"]);
        }
    }

    /// The statement of an analytical surface: in the instance that its name begins with, in the
    /// owner, or in the only instance that has one of this name.
    fn analytical(&self, surface: &str, owner: Option<usize>) -> Result<Stated<'a>, String> {
        let (prefix, bare) = surface.rsplit_once('.').unwrap_or(("", surface));
        let of_mesh = |kind: &str| ["ELEMENT", "NODE"].contains(&kind.to_uppercase().as_str());
        let named = |keyword: &&&Keyword<'_>| {
            let kind = keyword.parameter("TYPE").unwrap_or("ELEMENT");
            keyword.name == "SURFACE" && has(keyword, "NAME", bare) && !of_mesh(kind)
        };
        let all = self.instances.iter().enumerate();
        let stated = all.filter_map(|(at, instance)| {
            let keyword = instance.own.iter().find(named)?;
            Some((at, instance, *keyword))
        });
        let stated: Vec<_> = stated.collect();
        let is_alone = stated.len() == 1;
        let chosen = stated.into_iter().filter(|(at, instance, _)| match prefix {
            "" => owner.is_none_or(|owner| owner == *at),
            _ => instance.name.eq_ignore_ascii_case(prefix),
        });
        let chosen: Vec<_> = chosen.collect();
        match chosen[..] {
            [(_, instance, keyword)] => Ok(Stated {
                instance: instance.keyword,
                name: instance.name,
                keyword,
                is_alone,
            }),
            [] if prefix.is_empty() => {
                Err("an analytical surface outside of an instance; mesh it with R3D4".to_owned())
            }
            [] => Err("there is no such *SURFACE in an instance of this name".to_owned()),
            _ => Err(format!(
                "several instances have it; write `INSTANCE.{bare}`"
            )),
        }
    }

    /// The shape of an analytical surface.
    fn shape(&self, stated: &Stated<'_>) -> Result<Shape, String> {
        let Stated {
            instance, keyword, ..
        } = stated;
        let kind = keyword.parameter("TYPE").unwrap_or_default().to_uppercase();
        let profile = profile(keyword)?;
        let placed = |x: Vec3| instance.placed(x).ok_or("no numbers");
        let origin = placed(Vec3::zeros())?;
        let x = placed(Vec3::x())? - origin;
        let y = placed(Vec3::y())? - origin;
        let z = placed(Vec3::z())? - origin;
        let at = |[a, b]: [f64; 2]| origin + x * a + y * b;
        let shape = match (kind.as_str(), &profile[..]) {
            ("CYLINDER", [from, to]) => {
                let normal = (at(*to) - at(*from)).cross(&z);
                let normal = normal.try_normalize(0.0);
                let normal = normal.ok_or("a profile without length")?;
                let point = at(*from);
                // A body may reach a little through the plane; most of it is in front.
                let bodies = self.middles();
                let distance = |x: &Vec3| normal.dot(&(x - point));
                let near = |body: &Vec<Vec3>| {
                    let all = body.iter().map(|x| distance(x).abs());
                    all.fold(f64::INFINITY, f64::min)
                };
                let body = bodies.iter().min_by(|a, b| near(a).total_cmp(&near(b)));
                let side = body.map_or(1.0, |body| body.iter().map(distance).sum());
                let normal = normal * if side < 0.0 { -1.0 } else { 1.0 };
                Shape::Plane { point, normal }
            }
            ("CYLINDER", _) => {
                let nodes = self
                    .bodies
                    .iter()
                    .flat_map(|body| &body.reading.mesh.positions);
                let along: Vec<f64> = nodes.map(|node| z.dot(&(node - origin))).collect();
                let low = along.iter().copied().fold(f64::INFINITY, f64::min);
                let high = along.iter().copied().fold(f64::NEG_INFINITY, f64::max);
                if low > high {
                    return Err("a surface beside no body".to_owned());
                }
                let room = (high - low).max(f64::MIN_POSITIVE);
                let place = |step: usize| low + room * (2.0 * step as f64 / ALONG as f64 - 0.5);
                let point = |of: usize, step: usize| at(profile[of]) + z * place(step);
                self.grid(profile.len(), ALONG + 1, false, point)
            }
            ("REVOLUTION", _) => {
                let point = |of: usize, step: usize| {
                    let (sin, cos) = (TAU * step as f64 / PIECES as f64).sin_cos();
                    let [radius, height] = profile[of];
                    origin + (x * cos - z * sin) * radius + y * height
                };
                self.grid(profile.len(), PIECES, true, point)
            }
            ("SEGMENTS", _) => return Err("TYPE=SEGMENTS is for models of a plane".to_owned()),
            _ => return Err(format!("TYPE={kind}; mesh it with R3D4")),
        };
        Ok(shape)
    }

    /// Facets between points of a profile in several places, around an axis or not.
    fn grid(
        &self,
        profile: usize,
        places: usize,
        is_around: bool,
        point: impl Fn(usize, usize) -> Vec3,
    ) -> Shape {
        let (mut positions, mut known) = (Vec::new(), HashMap::new());
        let all = (0..profile).flat_map(|of| (0..places).map(move |step| (of, step)));
        let size = all.map(|(of, step)| point(of, step).amax());
        let size = size.fold(f64::MIN_POSITIVE, f64::max);
        let mut node = |of: usize, step: usize| {
            let x = point(of, step % places);
            // Points on the axis are one.
            let key = [x.x, x.y, x.z].map(|x| (x / size * 1e9).round() as i64);
            *known.entry(key).or_insert_with(|| {
                positions.push(x);
                positions.len() - 1
            })
        };
        let last = if is_around { places } else { places - 1 };
        let mut facets = Vec::new();
        for of in 1..profile {
            for step in 0..last {
                let corners = [
                    (of - 1, step),
                    (of, step),
                    (of, step + 1),
                    (of - 1, step + 1),
                ];
                let mut nodes = corners.map(|(of, step)| node(of, step)).to_vec();
                nodes.dedup();
                if nodes.first() == nodes.last() {
                    nodes.pop();
                }
                match nodes[..] {
                    [a, b, c, d] => facets.push([a, b, c, d]),
                    [a, b, c] => facets.push([a, b, c, c]),
                    _ => {}
                }
            }
        }
        let middle = |facet: &[usize; 4]| facet.iter().map(|at| positions[*at]).sum::<Vec3>() / 4.0;
        let normal = |facet: &[usize; 4]| {
            let [a, b, c, d] = facet.map(|at| positions[at]);
            (c - a).cross(&(d - b))
        };
        // What is near to facets is in front of most of them.
        let inside: Vec<Vec3> = self.middles().concat();
        let arm = |facet: &[usize; 4]| {
            let middle = middle(facet);
            let x = nearest(&inside, |x| (x - middle).norm())?;
            let arm = x - middle;
            let cosine = normal(facet).normalize().dot(&arm) / arm.norm();
            Some((arm.norm(), cosine))
        };
        let arms: Vec<(f64, f64)> = facets.iter().filter_map(arm).collect();
        let least = arms.iter().map(|(length, _)| *length);
        let near = least.fold(f64::INFINITY, f64::min) + NEAR * size;
        let close = arms.iter().filter(|(length, _)| *length <= near);
        let front: f64 = close.map(|(_, cosine)| cosine).sum();
        if front < 0.0 {
            for [a, b, c, d] in &mut facets {
                match c == d {
                    true => std::mem::swap(a, b),
                    false => std::mem::swap(b, d),
                }
            }
        }
        Shape::Facets(positions, facets)
    }

    /// Middles of all elements of each body, which are within it.
    fn middles(&self) -> Vec<Vec<Vec3>> {
        let bodies = self.bodies.iter().map(|body| &body.reading.mesh);
        let of_body = |mesh: &Mesh| {
            let middle = |corners: &[NodeId]| {
                let sum: Vec3 = corners.iter().map(|at| mesh.positions[at.index()]).sum();
                sum / corners.len() as f64
            };
            mesh.elements().map(middle).collect()
        };
        bodies.map(of_body).collect()
    }
}

fn nearest(points: &[Vec3], distance: impl Fn(&Vec3) -> f64) -> Option<Vec3> {
    let points = points.iter().copied();
    points.min_by(|a, b| distance(a).total_cmp(&distance(b)))
}

/// Points of a profile.
fn profile(keyword: &Keyword<'_>) -> Result<Vec<[f64; 2]>, String> {
    let mut points: Vec<[f64; 2]> = Vec::new();
    for row in &keyword.rows {
        if row.words.iter().all(|word| word.is_empty()) {
            continue;
        }
        let kind = row.words[0].to_uppercase();
        let all = numbers(&row.words[1..]).ok_or("a profile without numbers")?;
        match (kind.as_str(), &all[..], points.last()) {
            ("START", [x, y, ..], None) | ("LINE", [x, y, ..], Some(_)) => points.push([*x, *y]),
            ("CIRCL", [x, y, cx, cy, ..], Some(&from)) => {
                points.extend(arc(from, [*x, *y], [*cx, *cy]));
            }
            ("PARAB", ..) => return Err("a profile with PARAB; mesh it with R3D4".to_owned()),
            _ => {
                let what = "a profile other than of START, LINE and CIRCL; mesh it with R3D4";
                return Err(what.to_owned());
            }
        }
    }
    match points.len() {
        0 | 1 => Err("a profile without a line".to_owned()),
        _ => Ok(points),
    }
}

/// Points of an arc of less than half a turn after its first one.
fn arc(from: [f64; 2], to: [f64; 2], centre: [f64; 2]) -> Vec<[f64; 2]> {
    let angle = |p: [f64; 2]| (p[1] - centre[1]).atan2(p[0] - centre[0]);
    let radius = (from[0] - centre[0]).hypot(from[1] - centre[1]);
    let (start, mut way) = (angle(from), angle(to) - angle(from));
    way -= TAU * (way / TAU).round();
    let pieces = (way.abs() / TAU * PIECES as f64).ceil().max(1.0);
    let point = |at: usize| {
        let (sin, cos) = (start + way * at as f64 / pieces).sin_cos();
        [centre[0] + radius * cos, centre[1] + radius * sin]
    };
    let mut points: Vec<[f64; 2]> = (1..pieces as usize).map(point).collect();
    points.push(to);
    points
}
