//! Published and closed-form cases with what is known of them.
//!
//! A case is a folder of `cases/` with decks, a README and an `expected.toml`,
//! all of them embedded here, and a function that runs the decks, measures
//! quantities and draws figures. [`CASES`] lists them.

/// The text of a file in `cases/`.
macro_rules! embedded {
    ($($path:tt)*) => {
        include_str!(concat!("../../../cases/", $($path)*))
    };
}

/// Decks of a case with their names.
macro_rules! decks {
    ($case:literal: $($name:literal),+ $(,)?) => {
        [$(($name, embedded!($case, "/", $name, ".toml"))),+]
    };
}

mod bar_impact;
mod battery;
mod billet_upset;
mod bonded_pad;
mod boot;
mod comparison;
mod contact_face;
mod cooks_membrane;
mod crawler;
mod crushed_ring;
mod curve;
mod edge_contact;
mod edge_release;
mod failure;
mod fault_slider;
mod finger_gripper;
mod finger_pad;
mod folded_strip;
mod hertz_mindlin;
mod hertz_mindlin_cylinders;
mod hertz_mindlin_two_body;
mod measure;
mod million_unknowns;
mod o_ring;
mod o_ring_groove;
mod overlap;
mod pad_on_incline;
mod patch_frictionless;
mod patch_slip;
mod patch_stick;
mod plate_on_rigid_plane;
mod sipes;
mod slip_surface;
mod snake_scale;
mod stack;
mod stick_tolerance;
mod stiff_punch;
mod strip_draw;
pub mod study;
mod tread_slide;
mod treloar;
mod two_blocks;
mod tyre;
mod tyre_belt;
mod tyre_locked;
mod tyre_pressed;
mod tyre_rolling;

pub use failure::Failure;
use study::Study;

/// A case.
pub struct Case {
    /// Name, that of its folder.
    pub name: &'static str,
    /// Subject, in one line.
    pub title: &'static str,
    /// Expected results: its `expected.toml`.
    pub expected: &'static str,
    /// Description for readers: its README.
    pub readme: &'static str,
    /// Description of the quick run; `None` if it runs everything.
    pub quick: Option<&'static str>,
    /// Runs the decks, measures quantities and draws figures.
    pub run: fn(&mut Study) -> Result<(), Failure>,
}

/// A case from the name of its folder and its function.
macro_rules! case {
    ($name:literal, $title:literal, $run:path) => {
        case!($name, $title, $run, None)
    };
    ($name:literal, $title:literal, $run:path, quick: $quick:literal) => {
        case!($name, $title, $run, Some($quick))
    };
    ($name:literal, $title:literal, $run:path, $quick:expr) => {
        Case {
            name: $name,
            title: $title,
            expected: embedded!($name, "/expected.toml"),
            readme: embedded!($name, "/README.md"),
            quick: $quick,
            run: $run,
        }
    };
}

/// All cases.
pub const CASES: &[Case] = &[
    case!(
        "two-blocks",
        "Two blocks, pressed and slid, beside two other codes",
        two_blocks::run,
        quick: "the meshes of the decks, without the one of elements of a quarter of the size"
    ),
    case!(
        "stack",
        "Blocks in a T and in a pile, everything in contact, beside named pairs",
        stack::run
    ),
    case!(
        "sipes",
        "A tread block with two slits that close, everything in contact, beside named walls",
        sipes::run
    ),
    case!(
        "crushed-ring",
        "A ring crushed between planes and between jaws until its inner walls touch",
        crushed_ring::run,
        quick: "one of two meshes each"
    ),
    case!(
        "folded-strip",
        "A strip folded between plates, beside the elastica, and pinched until its legs touch",
        folded_strip::run,
        quick: "one of two meshes each"
    ),
    case!(
        "boot",
        "A bellows whose convolutions meet as it is compressed and pushed sideways",
        boot::run,
        quick: "one of two meshes of the slice"
    ),
    case!(
        "crawler",
        "A worm that crawls by its own strain against its nap, beside a stiff bar",
        crawler::run
    ),
    case!(
        "fault-slider",
        "A fault block that sticks and slips by rate and state, beside differential equations",
        fault_slider::run
    ),
    case!(
        "finger-gripper",
        "Three fingers that are blown up and hold a ball, and one beside the closed form",
        finger_gripper::run
    ),
    case!(
        "tread-slide",
        "A tread block that slides at five speeds, with friction by pressure and speed",
        tread_slide::run,
        quick: "without the mesh of elements of half the size"
    ),
    case!(
        "stiff-punch",
        "An offset punch on a larger base, for all ratios of stiffness and mesh size",
        stiff_punch::run,
        quick: "three of the ratios of stiffness and two of the divisions"
    ),
    case!(
        "edge-contact",
        "A block whose edges press on a thin plate, ever more finely divided",
        edge_contact::run,
        quick: "three of ten divisions"
    ),
    case!(
        "edge-release",
        "A punch that slides off an edge, and one that is lifted and pressed again",
        edge_release::run,
        quick: "three of ten scenes"
    ),
    case!(
        "patch-frictionless",
        "Uniform pressure across arbitrary overlaps and meshes",
        patch_frictionless::run
    ),
    case!(
        "patch-stick",
        "Stick on an oblique interface up to the load of the closed form",
        patch_stick::run
    ),
    case!(
        "plate-on-rigid-plane",
        "A plate pushed along a rigid floor (code_aster SSNV128)",
        plate_on_rigid_plane::run
    ),
    case!(
        "pad-on-incline",
        "A pad on an incline at the limit of friction (code_aster SSNV503)",
        pad_on_incline::run
    ),
    case!(
        "hertz-mindlin",
        "A block with a spherical face, pressed and sheared, beside Mindlin's closed form",
        hertz_mindlin::run,
        quick: "the two coarsest meshes"
    ),
    case!(
        "hertz-mindlin-cylinders",
        "Two half cylinders, pressed and sheared, beside the closed form",
        hertz_mindlin_cylinders::run,
        quick: "the two coarsest of three meshes"
    ),
    case!(
        "hertz-mindlin-two-body",
        "A block with a spherical face, pressed onto and slid over an equally soft one",
        hertz_mindlin_two_body::run,
        quick: "the coarsest mesh"
    ),
    case!(
        "stick-tolerance",
        "The strategy of the paper's Table 1 with three tolerances, beside the default",
        stick_tolerance::run
    ),
    case!(
        "patch-slip",
        "Uniform slip of an oblique parallelepiped under every friction law",
        patch_slip::run
    ),
    case!(
        "snake-scale",
        "Scaled blocks that drift when dragged, and stop when launched",
        snake_scale::run
    ),
    case!(
        "tyre-pressed",
        "A tyre pressed onto a road and pushed over it",
        tyre_pressed::run,
        quick: "a coarser mesh of the tyre"
    ),
    case!(
        "tyre-locked",
        "A tyre with a locked wheel that drifts as it slides",
        tyre_locked::run,
        quick: "a coarser mesh of the tyre"
    ),
    case!(
        "tyre-rolling",
        "A tyre that rolls and hardly drifts",
        tyre_rolling::run,
        quick: "a coarser mesh of the tyre"
    ),
    case!(
        "billet-upset",
        "A metal billet upset between plates, beside the closed form and the friction hill",
        billet_upset::run,
        quick: "two of three coefficients of friction on a coarser mesh"
    ),
    case!(
        "strip-draw",
        "A strip of rolled sheet drawn between dies, at angles to its rolling direction",
        strip_draw::run,
        quick: "three of seven directions on a coarser mesh"
    ),
    case!(
        "o-ring",
        "An O-ring squeezed between plates and dragged across grooves",
        o_ring::run,
        quick: "one of three directions of the grooves on coarser meshes"
    ),
    case!(
        "o-ring-groove",
        "The section of an O-ring in a groove, squeezed and pressed by a fluid",
        o_ring_groove::run,
        quick: "one of two meshes"
    ),
    case!(
        "tyre-belt",
        "A tyre with a belt of crossed cords, pressed and dragged, beside one without",
        tyre_belt::run,
        quick: "a coarser mesh of the tyre"
    ),
    case!(
        "finger-pad",
        "A finger pad with fibres in its skin, stroked across a nap",
        finger_pad::run,
        quick: "larger elements, without the runs with Coulomb's law and without fibres"
    ),
    case!(
        "bar-impact",
        "An elastic bar flies against a rigid wall",
        bar_impact::run
    ),
    case!(
        "cooks-membrane",
        "A skewed cantilever, compressible and nearly incompressible, beside published values",
        cooks_membrane::run,
        quick: "two meshes of each kind of cells"
    ),
    case!(
        "bonded-pad",
        "Rubber squeezed between bonded plates, against its shape factor",
        bonded_pad::run,
        quick: "two meshes, and three of four shape factors"
    ),
    case!(
        "treloar",
        "The rubber of 1944 in three tests, by four laws",
        treloar::run
    ),
    case!(
        "million-unknowns",
        "Two stacked blocks with a million unknowns, by the iterative solver",
        million_unknowns::run,
        quick: "32 elements along an edge in the place of 68, a tenth of the unknowns"
    ),
    case!(
        "slip-surface",
        "Slip surface and direction of friction of two textured surfaces",
        slip_surface::run
    ),
];

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;
    use striae_output::expected::Expected;

    #[test]
    fn every_case_expects_something_and_judges_newton() {
        let names: BTreeSet<&str> = CASES.iter().map(|case| case.name).collect();
        assert_eq!(names.len(), CASES.len());
        for case in CASES {
            let expected = Expected::parse(case.expected).unwrap();
            let solved = case.name != "slip-surface";
            for name in ["newton.median", "newton.max", "cutbacks"] {
                let judged = expected.quantities.iter().any(|q| q.name == name);
                assert_eq!(judged, solved, "{}: {name}", case.name);
            }
            assert!(case.readme.starts_with(&format!("# {}", case.name)));
        }
    }
}
