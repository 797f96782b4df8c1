//! Textures of a program's own, named in a deck.

use std::path::Path;

use nalgebra::Vector3;
use striae_deck::{Deck, Laws, Reader, json_schema, reference, write};
use striae_declared::{ANY, Absent, Declared, Parameter};
use striae_surface::texture::{
    Axis, DirectionField, InadmissibleTexture, Lines, Paint, PointLane, TURN,
};

/// Helices about an axis, by their angle to its cross-sections in radians.
#[derive(Debug)]
struct Helices(Axis, f64);

impl DirectionField for Helices {
    fn direction(&self, point: Vector3<PointLane>) -> Vector3<PointLane> {
        let (sin, cos) = self.1.sin_cos();
        let (along, around): (Vector3<PointLane>, _) = (self.0.along(), self.0.around(point));
        around.map(|x| x * cos) + along.map(|x| x * sin)
    }

    fn axis(&self) -> Option<Axis> {
        Some(self.0)
    }
}

static HELICAL: Declared<Paint> = Declared {
    name: "helical",
    summary: "Helices about an axis.",
    parameters: &[
        Parameter::axis("helical", "The axis."),
        Parameter::number("lead", ANY, "degrees", "Angle to the cross-sections.")
            .or(Absent::Number(45.0)),
        TURN,
    ],
    build: |values| {
        let lead = values.number("lead");
        if lead > 90.0 {
            return Err(InadmissibleTexture {
                parameter: Some("lead"),
                reason: format!("`lead` is {lead}, but it must be at most 90"),
            });
        }
        let axis = Axis::stated(values, "helical");
        let lines = Lines::own(Helices(axis, lead.to_radians()));
        Ok(Paint::lines(lines, values))
    },
    fit: None,
};

fn deck(texture: &str) -> String {
    format!(
        r#"title = "A grooved block"
material = [{{ name = "rubber", law = "neo-hookean", youngs_modulus = 1, poissons_ratio = 0.3 }}]
rigid = [{{ name = "road", plane = {{ point = [0, 0, 0], normal = [0, 0, 1] }} }}]
[[body]]
name = "block"
material = "rubber"
mesh = {{ generator = "block", size = [1, 1, 1], divisions = [1, 1, 1] }}
[[pair]]
name = "contact"
a = {{ body = "block", facets = "zmin", texture = {{ {texture} }} }}
b = {{ rigid = "road" }}
friction = {{ law = "nap", mu_forward = 0.1, mu_backward = 0.3, mu_lateral = 0.2 }}
[[step]]
name = "press"
displacement = [{{ body = "block", nodes = "zmax", x = 0, y = 0, z = -0.1 }}]
"#
    )
}

fn found(texture: &str) -> Result<Deck, String> {
    let laws = Laws::default().with_texture(&HELICAL);
    let deck = Reader::new(&laws, &[]).parse(&deck(texture), "deck.toml", Path::new(""));
    deck.map_err(|faults| faults.to_string())
}

fn paint(deck: &Deck) -> &Paint {
    deck.model.pairs[0].textures[0]
        .as_ref()
        .expect("it has one")
}

const ABOUT: &str = "helical = { point = [-1, 0, 0], direction = [0, 0, 2] }";

#[test]
fn a_deck_names_it_and_is_written_with_it() {
    let first = found(&format!("{ABOUT}, lead = 0, turn = 20")).unwrap();
    let Paint::Field(field) = paint(&first) else {
        panic!("it is a field");
    };
    let axes = field.axes(Vector3::zeros(), Vector3::z()).unwrap();
    let turned = 20_f64.to_radians();
    assert!((axes.s - Vector3::new(-turned.sin(), turned.cos(), 0.0)).norm() < 1e-15);
    let written = write(&first.model, &first.output).unwrap();
    let told = "texture = { helical = { point = [-1.0, 0.0, 0.0], direction = [0.0, 0.0, 2.0] }, lead = 0.0, turn = 20.0 }";
    assert!(written.contains(told), "{written}");
    let laws = Laws::default().with_texture(&HELICAL);
    let again = Reader::new(&laws, &[]).parse(&written, "deck.toml", Path::new(""));
    assert_eq!(paint(&again.unwrap()), paint(&first));
}

#[test]
fn faults_are_where_its_keys_are_and_name_the_textures_that_are_known() {
    for (texture, told) in [
        (
            "helical = { direction = [0, 0, 0] }".to_owned(),
            "deck.toml:10:76: `direction` in [[pair]] a texture helical must not be the zero vector",
        ),
        (
            format!("{ABOUT}, lead = 91"),
            "deck.toml:10:116: the texture is not admissible: `lead` is 91, but it must be at most 90",
        ),
        (
            format!("{ABOUT}, leed = 9"),
            "unknown key `leed` in [[pair]] a texture; did you mean `lead`?",
        ),
        (
            format!("{ABOUT}, uniform = [1, 0, 0]"),
            "`uniform` and `helical` exclude each other in [[pair]] a texture; give either",
        ),
        (
            "lead = 3".to_owned(),
            "missing key `helical` in [[pair]] a texture; expected a table",
        ),
        ("turn = 3".to_owned(), "or `helical` or `nodal`"),
    ] {
        let faults = found(&texture).unwrap_err();
        assert!(faults.contains(told), "{faults}");
        assert!(faults.ends_with("1 fault"), "{faults}");
    }
    let text = deck(ABOUT);
    let elsewhere = striae_deck::parse(&text, "deck.toml", Path::new(""));
    let faults = elsewhere.unwrap_err().to_string();
    assert!(faults.contains("`circumferential`"), "{faults}");
}

#[test]
fn schema_and_reference_list_it() {
    let laws = Laws::default().with_texture(&HELICAL);
    assert!(
        json_schema(&laws)
            .to_string()
            .contains("Helices about an axis.")
    );
    let row =
        "| `lead` (optional) | a number | Angle to the cross-sections (degrees). Default: 45. |";
    assert!(reference(&laws).contains(row));
    assert!(!reference(&Laws::default()).contains("helical"));
}

#[test]
fn a_texture_that_is_not_declared_cannot_be_written() {
    let mut deck = found(ABOUT).unwrap();
    let axis = Axis {
        point: Vector3::zeros(),
        direction: Vector3::z(),
    };
    let lines = Lines::own(Helices(axis, 0.1));
    deck.model.pairs[0].textures[0] = Some(Paint::lines(lines, &Default::default()));
    let refused = write(&deck.model, &deck.output).unwrap_err().to_string();
    assert!(
        refused.contains("texture of pair `contact`: its lines are those of a formula"),
        "{refused}"
    );
}
