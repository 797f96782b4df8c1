//! Material cards of Abaqus files.

use super::{block, written};
use crate::{Card, Elasticity, MaterialCard, Moduli, Reading, SectionCard, abaqus};
use striae_mesh::{CellKind, ElementId, NodeId};

fn reading(cards: &str) -> Reading {
    let text = written::abaqus(&block(CellKind::Hexahedron)) + cards;
    abaqus::body(&text).unwrap_or_else(|fault| panic!("{cards}: {fault}"))
}

/// The only material, with these options.
fn material(options: &str) -> Result<Card, String> {
    let mut all = reading(&format!(
        "*MATERIAL, NAME=Stuff\n{options}*STEP\n*END STEP\n"
    ))
    .materials;
    let MaterialCard { name, card } = all.pop().unwrap();
    assert_eq!((name.as_str(), all.len()), ("Stuff", 0));
    card
}

fn elastic(elasticity: Elasticity) -> Card {
    Card {
        density: None,
        elasticity,
        moduli: Moduli::LongTerm,
        hardening: Vec::new(),
        relaxation: Vec::new(),
    }
}

#[test]
fn cards_are_read_as_they_stand() {
    for (options, elasticity) in [
        (
            "*Elastic\n2.1D5, 0.3\n",
            Elasticity::Linear {
                youngs_modulus: 2.1e5,
                poissons_ratio: 0.3,
            },
        ),
        (
            "*ELASTIC, TYPE=ISOTROPIC, MODULI=LONG TERM\n10., , 20.\n",
            Elasticity::Linear {
                youngs_modulus: 10.0,
                poissons_ratio: 0.0,
            },
        ),
        (
            "*Hyperelastic, neo hooke\n0.4, 0.02\n",
            Elasticity::NeoHooke { c10: 0.4, d1: 0.02 },
        ),
        (
            "*DENSITY\n0.,\n*HYPERELASTIC, NEO HOOKE\n0.4, 0.02, 20., 0., 0., 0.\n",
            Elasticity::NeoHooke { c10: 0.4, d1: 0.02 },
        ),
        (
            "*HYPERELASTIC, MOONEY-RIVLIN\n0.3, 0.1, 0.02,\n",
            Elasticity::MooneyRivlin {
                c10: 0.3,
                c01: 0.1,
                d1: 0.02,
            },
        ),
        (
            "*HYPERELASTIC, YEOH\n0.3, -0.01, 1e-3, 0.02, 0., 0.\n",
            Elasticity::Yeoh {
                c: [0.3, -0.01, 1e-3],
                d1: 0.02,
            },
        ),
        (
            "*HYPERELASTIC, OGDEN, N=3\n0.6, 1.3, 0.001, 5., -0.01, -2., 0.02, 0.\n0.\n",
            Elasticity::Ogden {
                terms: vec![[0.6, 1.3], [0.001, 5.0], [-0.01, -2.0]],
                d1: 0.02,
            },
        ),
    ] {
        assert_eq!(material(options), Ok(elastic(elasticity)), "{options}");
    }
    let linear = Elasticity::Linear {
        youngs_modulus: 70e3,
        poissons_ratio: 0.33,
    };
    let metal = "*DENSITY\n2.7e-9,\n*ELASTIC\n70e3, .33\n*PLASTIC, HARDENING=ISOTROPIC\n200., 0.\n240., .1\n";
    assert_eq!(
        material(metal),
        Ok(Card {
            density: Some(2.7e-9),
            hardening: vec![[200.0, 0.0], [240.0, 0.1]],
            ..elastic(linear)
        })
    );
    let rubber = "*HYPERELASTIC, NEO HOOKE, MODULI=INSTANTANEOUS\n1., .1\n*VISCOELASTIC, TIME=PRONY\n.2, 0., .1\n.3, , 10.\n";
    assert_eq!(
        material(rubber),
        Ok(Card {
            moduli: Moduli::Instantaneous,
            relaxation: vec![[0.2, 0.1], [0.3, 10.0]],
            ..elastic(Elasticity::NeoHooke { c10: 1.0, d1: 0.1 })
        })
    );
}

#[test]
fn sections_name_sets_as_they_are_spelled() {
    let text = written::abaqus(&block(CellKind::Hexahedron));
    let numbers = abaqus::body(&text).unwrap().numbers;
    let element = numbers.element(ElementId(0));
    let [from, to] = [0, 1].map(|node| numbers.node(NodeId(node)));
    let cards = format!(
        "*ELSET, ELSET=Core\n{element}\n*SOLID SECTION, ELSET=CORE, MATERIAL=rubber\n\
         *ELEMENT, TYPE=T3D2, ELSET=wires\n99901, {from}, {to}\n\
         *SOLID SECTION, ELSET=wires, MATERIAL=steel\n"
    );
    let reading = abaqus::body(&(text + &cards)).unwrap();
    let expected = SectionCard {
        set: "Core".into(),
        material: "rubber".into(),
    };
    assert_eq!(reading.sections, [expected]);
}

#[test]
fn what_has_no_counterpart_is_named() {
    for (options, expected) in [
        (
            "",
            "expected *ELASTIC or *HYPERELASTIC below it, found `*MATERIAL, NAME=Stuff`",
        ),
        (
            "*ELASTIC\n1., .3\n*CREEP\n1., 2., 3.\n",
            "expected *DENSITY, *ELASTIC, *HYPERELASTIC, *PLASTIC or *VISCOELASTIC, found `*CREEP`",
        ),
        (
            "*ELASTIC, TYPE=ENGINEERING CONSTANTS\n1., 2.\n",
            "expected TYPE=ISOTROPIC, found `*ELASTIC, TYPE=ENGINEERING CONSTANTS`",
        ),
        (
            "*ELASTIC\n1., .3, 20.\n2., .3, 40.\n",
            "expected constants at one temperature, found `1., .3, 20.`",
        ),
        (
            "*HYPERELASTIC, OGDEN\n1., 2., 3., 4., .1, .1\n",
            "expected constants at one temperature, found `1., 2., 3., 4., .1, .1`",
        ),
        (
            "*ELASTIC\n1., .5\n",
            "expected a Poisson's ratio above -1 and below 0.5, found `1., .5`",
        ),
        ("*ELASTIC\n1., x\n", "expected numbers, found `1., x`"),
        (
            "*ELASTIC\n1., .3\n*ELASTIC\n1., .3\n",
            "expected an option that the material does not have already, found `*ELASTIC`",
        ),
        (
            "*HYPERELASTIC, ARRUDA-BOYCE\n1., 2., 3.\n",
            "expected NEO HOOKE, MOONEY-RIVLIN, YEOH or OGDEN with constants, found `*HYPERELASTIC, ARRUDA-BOYCE`",
        ),
        (
            "*HYPERELASTIC, OGDEN, TEST DATA INPUT\n",
            "expected NEO HOOKE, MOONEY-RIVLIN, YEOH or OGDEN with constants, found `*HYPERELASTIC, OGDEN, TEST DATA INPUT`",
        ),
        (
            "*HYPERELASTIC, NEO HOOKE\n1., 0.\n",
            "expected D1 above zero, found `1., 0.`; give D1 = 2/K of a bulk modulus K, some 1000 times the shear modulus",
        ),
        (
            "*HYPERELASTIC, YEOH\n1., 0., 0., .1, .1\n",
            "expected D2 and those after it zero, found `1., 0., 0., .1, .1`",
        ),
        (
            "*ELASTIC\n1., .3\n*PLASTIC, HARDENING=KINEMATIC\n1., 0.\n",
            "expected HARDENING=ISOTROPIC, found `*PLASTIC, HARDENING=KINEMATIC`",
        ),
        (
            "*ELASTIC\n1., .3\n*PLASTIC\n1., 0., 20.\n",
            "expected yield stress and plastic strain at any temperature, found `1., 0., 20.`",
        ),
        (
            "*HYPERELASTIC, NEO HOOKE\n1., .1\n*PLASTIC\n1., 0.\n",
            "expected *PLASTIC with *ELASTIC alone, found `*MATERIAL, NAME=Stuff`",
        ),
        (
            "*ELASTIC\n1., .3\n*VISCOELASTIC, TIME=PRONY\n.2, .1, 1.\n",
            "expected k of 0, as volumes do not relax, found `.2, .1, 1.`",
        ),
        (
            "*ELASTIC\n1., .3\n*VISCOELASTIC, TIME=PRONY\n.6, 0., 1.\n.4, 0., 2.\n",
            "expected shares g above 0 with a sum below 1, found `*VISCOELASTIC, TIME=PRONY`",
        ),
        (
            "*ELASTIC\n1., .3\n*VISCOELASTIC, FREQUENCY=PRONY\n.2, .1, 1.\n",
            "expected TIME=PRONY, found `*VISCOELASTIC, FREQUENCY=PRONY`",
        ),
        (
            "*DENSITY\n-1.\n",
            "expected a positive density, found `-1.`",
        ),
        (
            "*DENSITY, DEPENDENCIES=1\n1.\n",
            "expected no parameter DEPENDENCIES, found `*DENSITY, DEPENDENCIES=1`",
        ),
    ] {
        let found = material(options).unwrap_err();
        let shown = found.split_once(": ").map(|(_, message)| message);
        let whole = expected.chars().take(200).collect::<String>();
        assert!(found.starts_with("line "), "{found}");
        assert_eq!(
            shown.map(|s| s.replace("...`", "`")),
            Some(shortened(&whole)),
            "{options}"
        );
    }
}

/// A message whose quotation is cut after forty characters, as faults are.
fn shortened(message: &str) -> String {
    let Some((before, rest)) = message.split_once("found `") else {
        return message.to_owned();
    };
    let (quoted, after) = rest.split_once('`').unwrap();
    let cut: String = quoted.chars().take(40).collect();
    format!("{before}found `{cut}`{after}")
}
