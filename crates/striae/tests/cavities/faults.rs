//! Cavities that are refused, each with the reason and a remedy.

use striae::{
    model::{CavityContent, StepBuilder, cavity},
    prelude::*,
};

use super::scene::{cube, hollow_cube};

fn told(model: striae::model::ModelBuilder) -> String {
    model.build().unwrap_err().0[0].to_string()
}

fn held() -> StepBuilder {
    step("rest").hold("cube", "foot")
}

#[test]
fn surfaces_that_enclose_nothing_are_refused() {
    let open = model("Open").body(hollow_cube().facets_where("lid", |x| {
        (0.99..2.01).contains(&x.x) && (0.99..2.01).contains(&x.y) && (0.99..1.01).contains(&x.z)
    }));
    let open = told(open.cavity(cavity("hole", "cube", "lid")).step(held()));
    assert!(open.starts_with("cavities[0]: cavity `hole`: its surface ends at the edge from (1"));
    assert!(
        open.contains("hold both nodes at zero along one normal"),
        "{open}"
    );
    let outside = model("Outside")
        .body(hollow_cube().facets_where("skin", |x| x.iter().any(|x| *x < 0.01 || *x > 2.99)));
    let outside = told(outside.cavity(cavity("hole", "cube", "skin")).step(held()));
    assert!(
        outside.contains("enclose a volume of -27; name faces"),
        "{outside}"
    );
    let twice = model("Twice").body(hollow_cube());
    let twice = twice.cavity(cavity("hole", "cube", "inside").and("cube", "inside"));
    let twice = told(twice.step(held()));
    assert!(
        twice.contains("name each face of its surface once"),
        "{twice}"
    );
}

#[test]
fn contents_that_cannot_be_are_refused() {
    let filled = |content| told(cube("A cube").step(held().fill("hole", content)));
    let said = filled(CavityContent::Volume(-1.0));
    assert_eq!(
        said,
        "steps[0].fillings[0]: cavity `hole`: its volume must be positive, but is -1"
    );
    assert!(filled(CavityContent::Pressure(f64::NAN)).contains("must be a finite number"));
    let vacuum = CavityContent::Gas {
        ambient: 0.0,
        exponent: 1.0,
    };
    assert!(filled(vacuum).contains("its ambient pressure must be positive"));
    let twice = held()
        .fill("hole", CavityContent::Pressure(1.0))
        .fill("hole", CavityContent::Volume(1.0));
    assert!(told(cube("Twice").step(twice)).contains("states its content twice"));
    let dynamic = held().dynamic(0.9).fill("hole", CavityContent::Volume(1.1));
    let said = told(cube("Moving").step(dynamic));
    assert!(
        said.contains("which has inertia; state a pressure or a gas there"),
        "{said}"
    );
    let unknown = held().fill("hull", CavityContent::Pressure(1.0));
    let said = told(cube("Unknown").step(unknown));
    assert!(said.contains("no cavity is named `hull`"), "{said}");
}
