//! What the gallery shows of each case.

/// A case in the gallery.
pub struct Exhibit {
    /// Name of the case.
    pub case: &'static str,
    /// The run that is shown; `None` of a case that has only figures.
    pub run: Option<&'static str>,
    /// Options of `striae picture`.
    pub options: &'static [&'static str],
    /// A figure of the case.
    pub figure: Option<&'static str>,
    /// What is seen.
    pub caption: &'static str,
}

/// All cases.
pub const EXHIBITS: [Exhibit; 23] = [
    Exhibit {
        case: "two-blocks",
        run: Some("deck"),
        options: &["--field", "pressure"],
        figure: Some("reactions"),
        caption: "Two blocks of the same rubber, pressed onto each other and slid, beside two other codes.",
    },
    Exhibit {
        case: "stiff-punch",
        run: Some("100-6-3"),
        options: &["--field", "pressure"],
        figure: None,
        caption: "A punch that stands off the middle of a larger base, for all ratios of stiffness and mesh size; here a punch a hundred times as stiff as the base.",
    },
    Exhibit {
        case: "edge-contact",
        run: Some("within-mu-0.4-8"),
        options: &["--field", "pressure"],
        figure: None,
        caption: "A block whose edges press on a thin plate, ever more finely divided. The plate bends away under the middle of the block.",
    },
    Exhibit {
        case: "edge-release",
        run: Some("slide-off-4-3-1-frictionless-0"),
        options: &["--field", "pressure", "--time", "1.6"],
        figure: Some("force"),
        caption: "A punch that slides off an edge, is lifted and pressed again, with forces that change smoothly.",
    },
    Exhibit {
        case: "patch-frictionless",
        run: Some("turned-upper-finer"),
        options: &["--field", "pressure"],
        figure: Some("overlaps"),
        caption: "Uniform pressure across overlaps and meshes of any kind: the pressure is the same at all nodes, so the picture has one colour.",
    },
    Exhibit {
        case: "patch-stick",
        run: Some("turned"),
        options: &["--field", "friction_traction", "--time", "2"],
        figure: Some("stick-to-slip"),
        caption: "Stick on an oblique interface up to the load of the closed form. Friction is the same at all nodes, so the picture, of a time before slip, has one colour.",
    },
    Exhibit {
        case: "plate-on-rigid-plane",
        run: Some("deck"),
        options: &["--field", "pressure"],
        figure: Some("along-the-floor"),
        caption: "A plate pushed along a rigid floor (code_aster SSNV128).",
    },
    Exhibit {
        case: "pad-on-incline",
        run: Some("slide"),
        options: &["--field", "pressure"],
        figure: Some("friction"),
        caption: "A pad on an incline at the limit of friction (code_aster SSNV503).",
    },
    Exhibit {
        case: "hertz-mindlin",
        run: Some("h-0.4"),
        options: &["--field", "pressure", "--view", "-0.6,1,-0.5"],
        figure: Some("traces"),
        caption: "Half a block with a spherical face, pressed and sheared, beside the closed form of Mindlin. The plane of symmetry is cut.",
    },
    Exhibit {
        case: "hertz-mindlin-cylinders",
        run: Some("h-0.05"),
        options: &["--field", "cauchy_stress", "--view", "0,1,0"],
        figure: Some("traces"),
        caption: "Two half cylinders, pressed and sheared, beside the closed form.",
    },
    Exhibit {
        case: "hertz-mindlin-two-body",
        run: Some("h-0.8"),
        options: &["--field", "pressure", "--view", "-0.5,1,-0.5"],
        figure: Some("reactions-h-0.8"),
        caption: "A block with a spherical face, pressed onto and slid over an equally soft one.",
    },
    Exhibit {
        case: "stick-tolerance",
        run: Some("default"),
        options: &["--field", "pressure"],
        figure: Some("reactions"),
        caption: "The strategy of the paper's Table 1 with three tolerances, beside the default.",
    },
    Exhibit {
        case: "patch-slip",
        run: Some("two-textures"),
        options: &["--field", "displacement", "--hide", "plane"],
        figure: Some("parallelepipeds"),
        caption: "Uniform slip of an oblique parallelepiped under every friction law.",
    },
    Exhibit {
        case: "snake-scale",
        run: Some("drift"),
        options: &["--field", "pressure", "--hide", "plane"],
        figure: Some("drift"),
        caption: "Scaled blocks that drift aside when they are dragged, and stop when they are launched.",
    },
    Exhibit {
        case: "tyre-pressed",
        run: Some("45"),
        options: &["--field", "cauchy_stress", "--view", "0.8,1,-0.45"],
        figure: Some("patch"),
        caption: "A tyre pressed onto a road and pushed over it; its tread has grooves at 45 degrees.",
    },
    Exhibit {
        case: "tyre-locked",
        run: Some("deck"),
        options: &["--field", "cauchy_stress", "--view", "0.8,1,-0.45"],
        figure: Some("path"),
        caption: "A tyre with a locked wheel that drifts aside as it slides.",
    },
    Exhibit {
        case: "tyre-rolling",
        run: Some("deck"),
        options: &["--field", "cauchy_stress", "--view", "0.8,1,-0.45"],
        figure: Some("rolling"),
        caption: "A tyre that rolls and hardly drifts.",
    },
    Exhibit {
        case: "bar-impact",
        run: Some("0.8"),
        options: &["--field", "cauchy_stress", "--time", "1"],
        figure: Some("impact"),
        caption: "An elastic bar that flies against a rigid wall, beside the exact solution of waves.",
    },
    Exhibit {
        case: "cooks-membrane",
        run: Some("rubber-hexahedra-16"),
        options: &["--field", "cauchy_stress", "--view", "0,1,0"],
        figure: Some("convergence"),
        caption: "A skewed cantilever that bends and shears, compressible and nearly incompressible, on finer and finer meshes.",
    },
    Exhibit {
        case: "bonded-pad",
        run: Some("composite-tetrahedra-1-4-4"),
        options: &["--field", "cauchy_stress", "--view", "-0.8,-1,-0.6"],
        figure: Some("stiffness"),
        caption: "An eighth of a rubber pad between bonded plates; it is the stiffer the flatter it is.",
    },
    Exhibit {
        case: "treloar",
        run: None,
        options: &[],
        figure: Some("tests"),
        caption: "The rubber that Treloar measured in 1944, by four laws.",
    },
    Exhibit {
        case: "million-unknowns",
        run: Some("mesh-24"),
        options: &["--field", "pressure"],
        figure: None,
        caption: "Two stacked blocks, pressed and sheared, with a million unknowns by the iterative solver; the picture is of the same blocks on a coarser mesh.",
    },
    Exhibit {
        case: "slip-surface",
        run: None,
        options: &[],
        figure: Some("slip-surface"),
        caption: "Slip surface and direction of friction of two textured surfaces. Nothing is solved here.",
    },
];
