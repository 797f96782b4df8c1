//! Cuts of bodies that ranks share.

use striae_mesh::Vec3;
use striae_solve::{
    problem::Problem,
    section::{Part, Section, SectionError},
    share::Division,
    state::State,
    team::Together,
};

use crate::scenes::{all, mixture};

fn stretched(problem: &Problem) -> State {
    let mut state = State::undeformed(problem);
    for x in &mut state.positions {
        *x = Vec3::new(
            1.05 * x.x + 0.02 * x.z,
            0.98 * x.y,
            0.97 * x.z + 0.01 * x.x * x.y,
        );
    }
    state
}

#[test]
fn sections_carry_what_they_do_in_the_whole() {
    for (name, model) in all() {
        let (point, normal) = (Vec3::new(0.55, 0.5, 0.6), Vec3::new(1.0, 0.2, 0.4));
        let whole = Problem::new(model.clone()).unwrap();
        let cut = Section::of(&whole, 0, &point, &normal).unwrap();
        assert_eq!(
            Ok(&cut),
            Section::new(&whole.model.bodies[0].mesh, &point, &normal).as_ref()
        );
        let expected = cut.report(&whole, &stretched(&whole), 0);
        for ranks in 2..=4 {
            let division = Division::new(&model, ranks).unwrap();
            let found = Together::run(ranks, |team| {
                let problem = Problem::shared(model.clone(), &division, team).unwrap();
                let cut = Section::of(&problem, 0, &point, &normal).unwrap();
                cut.report(&problem, &stretched(&problem), 0)
            });
            for report in found {
                let scale = expected.force.norm();
                let near = |a: &Vec3, b: &Vec3| (a - b).norm() <= 1e-12 * scale.max(1.0);
                assert!(near(&report.force, &expected.force), "{name}: {report:?}");
                assert!(near(&report.moment, &expected.moment), "{name}: {report:?}");
                assert!(near(&report.centre, &expected.centre), "{name}: {report:?}");
                assert!((report.area - expected.area).abs() <= 1e-12, "{name}");
            }
        }
    }
}

#[test]
fn planes_beside_the_body_are_refused_on_all_ranks() {
    let model = mixture();
    let division = Division::new(&model, 3).unwrap();
    let cut = |x: f64| {
        Together::run(3, |team| {
            let problem = Problem::shared(model.clone(), &division, team).unwrap();
            let point = Vec3::new(x, 0.0, 0.0);
            Section::of(&problem, 0, &point, &Vec3::x()).unwrap_err()
        })
    };
    assert_eq!(cut(-1.0), [SectionError::OneSided(Part::Front); 3]);
    assert_eq!(cut(9.0), [SectionError::OneSided(Part::Behind); 3]);
    // Between the pieces that hang together and the one apart.
    assert_eq!(cut(2.5), [SectionError::Apart; 3]);
}
