//! Models with all that a rank may hold a part of.

use striae_contact::pair::Enforcement;
use striae_law::{bulk::Material, friction::Friction};
use striae_mesh::{CellBlock, CellKind, ElementId, Face, Mesh, NodeId, Vec3, generate::Block};
use striae_model::{
    Body, BodyId, BodySection, ContactMass, ContactSurface, Curve, Formulation, Freedom, Gravity,
    LoadExtent, LoadKind, Model, Procedure, RigidId, RigidInertia, RigidMotion, RigidShape,
    RigidSurface, Tie,
};
use striae_surface::texture::{Field, Lines, Paint};

use crate::scene::{Places, block, body, coulomb, model, pieces, plane, rubber, step};

/// All of them by name.
pub fn all() -> Vec<(&'static str, Model)> {
    vec![
        ("blocks", blocks(Enforcement::Weighted)),
        ("collocated", blocks(Enforcement::Collocated)),
        ("mixture", mixture()),
        ("glued", glued()),
        ("ridden", ridden()),
        ("peaks", peaks()),
        ("napped", napped()),
        ("itself", itself()),
    ]
}

/// The elements whose middle meets a condition, of a material.
fn section(mesh: &Mesh, material: Material, holds: impl Fn(&Vec3) -> bool) -> BodySection {
    let middle = |corners: Vec<Vec3>| corners.iter().sum::<Vec3>() / corners.len() as f64;
    let elements = (0..mesh.element_count()).map(ElementId::new);
    BodySection {
        set: "section".into(),
        elements: elements
            .filter(|element| holds(&middle(mesh.element_positions(*element))))
            .collect(),
        formulation: Formulation::suited_to(&material),
        material,
        density: 2.0,
    }
}

fn heavy(name: &str, mesh: Mesh, material: Material) -> Body {
    Body {
        density: 1.0,
        ..body(name, mesh, material)
    }
}

fn gravity() -> Option<Gravity> {
    Some(Gravity {
        acceleration: Vec3::new(0.01, 0.0, -0.03),
        curve: Curve::Ramp,
    })
}

/// A block of tetrahedra on one of hexahedra of two materials, both pressed and loaded.
pub fn blocks(enforcement: Enforcement) -> Model {
    let lower = block([0.0; 3], [2.0, 1.0, 1.0], [6, 3, 3]).mesh().unwrap();
    let upper = Block {
        cells: CellKind::Tetrahedron,
        irregularity: 0.1,
        seed: 3,
        ..block([0.3, 0.1, 1.0], [1.0, 0.8, 0.9], [3, 3, 3])
    };
    let stiff = section(&lower, rubber(5.0, 0.3), |middle| middle.x > 1.1);
    let mut lower = heavy("lower", lower, rubber(1.0, 0.4));
    lower.sections = vec![stiff];
    lower.contact_mass = ContactMass::Redistributed;
    let mut model = model(vec![
        lower,
        heavy("upper", upper.mesh().unwrap(), rubber(2.0, 0.3)),
    ]);
    model.touch(("upper", "zmin"), ("lower", "zmax"), coulomb(0.4));
    model.pairs[0].enforcement = enforcement;
    let mut press = step();
    press.displacements = vec![
        model.hold("lower", "zmin", [Some(0.0); 3]),
        model.hold("upper", "zmax", [Some(0.01), None, Some(-0.03)]),
    ];
    let exposed = LoadExtent::Exposed;
    press.loads = vec![
        model.load("lower", "xmax", LoadKind::Pressure(0.05), LoadExtent::Whole),
        model.load("lower", "zmax", LoadKind::Pressure(0.02), exposed),
    ];
    press.gravity = gravity();
    model.steps = vec![press];
    model
}

/// A nap with friction that decays with the slip rate: forces at a node depend on all that the
/// slips of its neighbours depend on. Nodes are far enough from each other not to be all wanted
/// on one rank.
pub fn napped() -> Model {
    let mesh = |z: f64, count: usize| {
        let mesh = block([0.0, 0.0, z], [1.0, 1.0, 0.5], [count, count, 1]).mesh();
        mesh.unwrap()
    };
    let mut model = model(vec![
        body("lower", mesh(0.0, 8), rubber(1.0, 0.3)),
        body("upper", mesh(0.5, 7), rubber(2.0, 0.3)),
    ]);
    let nap = Friction::nap(0.1, 0.3, 0.2).expect("in range");
    let friction = nap.with_decay(0.4, 0.15).expect("in range");
    model.touch(("upper", "zmin"), ("lower", "zmax"), friction);
    let along = Field {
        lines: Lines::Uniform(Vec3::new(0.9, 0.4, 0.0)),
        turn: 0.0,
    };
    model.pairs[0].textures = [Some(Paint::Field(along)), None];
    let mut slide = step();
    slide.displacements = vec![
        model.hold("lower", "zmin", [Some(0.0); 3]),
        model.hold("upper", "zmax", [Some(0.01), None, Some(-0.03)]),
    ];
    model.steps = vec![slide];
    model
}

/// Two pieces of one body that touch each other.
pub fn itself() -> Model {
    let lower = block([0.0; 3], [2.0, 1.0, 1.0], [6, 3, 3]).mesh().unwrap();
    let upper = block([0.3, 0.1, 1.0], [1.0, 0.8, 0.9], [4, 3, 2])
        .mesh()
        .unwrap();
    let mut mesh = pieces(&[lower, upper]);
    let skin = mesh.boundary_faces();
    mesh.facet_sets.insert("skin", skin);
    let mut model = model(vec![heavy("both", mesh, rubber(1.0, 0.4))]);
    model.touch_itself("both", &["skin"], coulomb(0.3));
    let mut press = step();
    press.displacements = vec![
        model.hold("both", "0.zmin", [Some(0.0); 3]),
        model.hold("both", "1.zmax", [Some(0.01), None, Some(-0.03)]),
    ];
    model.steps = vec![press];
    model
}

/// Two meshes in one; nodes in the same place are one.
fn joined(one: &Mesh, other: &Mesh) -> Mesh {
    let mut positions = one.positions.clone();
    let numbers: Vec<NodeId> = (other.positions.iter())
        .map(|x| {
            let known = one.positions.iter().position(|y| (x - y).norm() < 1e-9);
            NodeId::new(known.unwrap_or_else(|| {
                positions.push(*x);
                positions.len() - 1
            }))
        })
        .collect();
    let mut blocks = one.blocks.clone();
    blocks.extend(other.blocks.iter().map(|block| {
        CellBlock {
            kind: block.kind,
            nodes: (block.nodes.iter())
                .map(|node| numbers[node.index()])
                .collect(),
        }
    }));
    let mut mesh = Mesh::new(positions, blocks).unwrap();
    let first = one.element_count();
    for (name, faces) in one
        .facet_sets
        .iter()
        .filter(|(name, _)| name.starts_with('z'))
    {
        let others = other.facet_sets.get(name).unwrap_or_default().iter();
        let others = others.map(|face| Face {
            element: ElementId::new(first + face.element.index()),
            side: face.side,
        });
        let faces: Vec<Face> = faces.iter().copied().chain(others).collect();
        mesh.node_sets.insert(name, mesh.nodes_of_faces(&faces));
        mesh.facet_sets.insert(name, faces);
    }
    mesh
}

/// Hexahedra and wedges that hang together, ten-node tetrahedra apart, on a plane.
pub fn mixture() -> Model {
    let hexahedra = block([0.0; 3], [1.0; 3], [3, 3, 3]).mesh().unwrap();
    let wedges = Block {
        cells: CellKind::Wedge,
        ..block([1.0, 0.0, 0.0], [1.0; 3], [2, 3, 3])
    };
    let apart = Block {
        cells: CellKind::CompositeTetrahedron,
        ..block([3.0, 0.0, 0.0], [1.0; 3], [2, 2, 2])
    };
    let mesh = joined(&hexahedra, &wedges.mesh().unwrap());
    let mesh = joined(&mesh, &apart.mesh().unwrap());
    let mut model = model(vec![heavy("mixed", mesh, rubber(1.0, 0.45))]);
    let floor = plane([0.0; 3], [0.0, 0.0, 1.0]);
    model.touch_rigid(("mixed", "zmin"), floor, coulomb(0.3));
    let mut press = step();
    press.procedure = Procedure::Dynamic {
        spectral_radius: 0.8,
    };
    press.displacements = vec![model.hold("mixed", "zmax", [Some(0.01), None, Some(-0.02)])];
    press.gravity = gravity();
    model.steps = vec![press];
    model
}

fn side(model: &Model, body: &str, set: &str) -> ContactSurface {
    ContactSurface::Deformable {
        body: BodyId(model.body(body)),
        faces: model.faces(body, set),
    }
}

/// A fine block glued to a coarse one, and a third one to both, on a plane.
pub fn glued() -> Model {
    let fine = block([0.0, 0.0, 1.0], [1.0, 1.0, 0.7], [4, 3, 2]);
    let coarse = block([0.0; 3], [1.0; 3], [2, 3, 2]);
    let beside = block([1.0, 0.0, 0.0], [0.6, 1.0, 1.0], [2, 2, 3]);
    let mesh = |block: Block| block.mesh().unwrap();
    let mut model = model(vec![
        heavy("fine", mesh(fine), rubber(1.0, 0.3)),
        heavy("coarse", mesh(coarse), rubber(3.0, 0.3)),
        heavy("beside", mesh(beside), rubber(2.0, 0.4)),
    ]);
    let tie = |name: &str, a: (&str, &str), b: (&str, &str)| Tie {
        name: name.to_owned(),
        a: side(&model, a.0, a.1),
        b: side(&model, b.0, b.1),
        within: None,
        moved: 0.0,
    };
    model.ties = vec![
        tie("upon", ("fine", "zmin"), ("coarse", "zmax")),
        tie("beside", ("beside", "xmin"), ("coarse", "xmax")),
    ];
    let floor = plane([0.0; 3], [0.0, 0.0, 1.0]);
    model.touch_rigid(("coarse", "zmin"), floor, coulomb(0.5));
    let mut press = step();
    press.displacements = vec![model.hold("fine", "zmax", [Some(0.0), Some(0.0), Some(-0.02)])];
    press.loads = vec![model.load(
        "beside",
        "xmax",
        LoadKind::DeadTraction(Vec3::new(0.02, 0.0, -0.01)),
        LoadExtent::Whole,
    )];
    model.steps = vec![press];
    model
}

/// A block on a rigid surface of hills, which has more nodes than the block's side, and which
/// stays where it is.
pub fn peaks() -> Model {
    const CELLS: usize = 7;
    let mesh = block([0.0; 3], [1.0; 3], [3, 3, 2]).mesh().unwrap();
    let mut model = model(vec![heavy("block", mesh, rubber(1.0, 0.3))]);
    let corner = |i: usize, j: usize| {
        let [x, y] = [i, j].map(|k| 1.4 * k as f64 / CELLS as f64 - 0.2);
        Vec3::new(x, y, if (i + j).is_multiple_of(2) { 0.0 } else { -0.1 })
    };
    let corners = (0..=CELLS).flat_map(|j| (0..=CELLS).map(move |i| corner(i, j)));
    let number = |i: usize, j: usize| NodeId::new((CELLS + 1) * j + i);
    let cells = (0..CELLS).flat_map(|j| (0..CELLS).map(move |i| (i, j)));
    let triangles = cells.flat_map(|(i, j)| {
        let ends = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)];
        let [a, b, c, d] = ends.map(|(i, j)| number(i, j));
        [[a, b, c, c], [a, c, d, d]]
    });
    let hills = RigidShape::Facets {
        positions: corners.collect(),
        facets: triangles.collect(),
    };
    model.touch_rigid(("block", "zmin"), hills, coulomb(0.4));
    let mut press = step();
    press.displacements = vec![model.hold("block", "zmax", [Some(0.01), None, Some(-0.02)])];
    model.steps = vec![press];
    model
}

/// A block below a rigid body with mass that is tied to its top, on a rigid surface of facets
/// that is free to move.
pub fn ridden() -> Model {
    let mesh = block([0.0; 3], [1.0; 3], [3, 3, 4]).mesh().unwrap();
    let mut model = model(vec![heavy("block", mesh, rubber(1.0, 0.3))]);
    let corner = |x: f64, y: f64| Vec3::new(2.0 * x - 0.5, 2.0 * y - 0.5, 0.0);
    let floor = RigidShape::Facets {
        positions: vec![
            corner(0.0, 0.0),
            corner(1.0, 0.0),
            corner(1.0, 1.0),
            corner(0.0, 1.0),
        ],
        facets: vec![[0, 1, 2, 3].map(NodeId::new)],
    };
    model.touch_rigid(("block", "zmin"), floor, coulomb(0.5));
    let top = model.nodes("block", "zmax");
    model.rigid_surfaces.push(RigidSurface {
        reference: Vec3::new(0.5, 0.5, 1.5),
        ties: vec![(BodyId(0), top)],
        inertia: Some(RigidInertia::aligned(
            2.0,
            Vec3::new(0.5, 0.5, 1.4),
            [0.3, 0.4, 0.5],
        )),
        ..RigidSurface::new("rider", RigidShape::Bare)
    });
    let free = |surface: usize, force: Vec3| RigidMotion {
        surface: RigidId(surface),
        coordinates: [Freedom::Free; 6],
        force: Some(force),
        torque: None,
        curve: Curve::Ramp,
    };
    let mut press = step();
    press.procedure = Procedure::Dynamic {
        spectral_radius: 0.9,
    };
    press.rigid_motions = vec![
        free(0, Vec3::new(0.0, 0.0, 0.3)),
        free(1, Vec3::new(0.01, 0.0, -0.3)),
    ];
    press.gravity = gravity();
    model.steps = vec![press];
    model
}
