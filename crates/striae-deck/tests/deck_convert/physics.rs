//! Converted models that are run, against closed forms.

use super::{CUBE, FOAM, driven::last, model};
use striae_contact::side::Side;
use striae_deck::convert;
use striae_mesh::Vec3;
use striae_solve::{problem::Problem, report::pairs, state::State};

fn run(model: &str) -> (Problem, State, Vec<String>) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("model.inp");
    std::fs::write(&path, model).unwrap();
    let made = convert(&path, &path.to_string_lossy()).unwrap();
    let (problem, state) = last(&made.deck);
    (problem, state, made.listed)
}

/// Force on a pad on a rigid plane that is pressed and dragged at an angle from x, far enough for
/// its shear not to change any more, and so little that its sole does not turn.
fn dragged(degrees: f64, friction: &str) -> Vec3 {
    let (sin, cos) = degrees.to_radians().sin_cos();
    let parts = "*PART, NAME=Floor\n*SURFACE, TYPE=CYLINDER, NAME=Face\nSTART, -9., 0.\nLINE, 9., 0.\n*END PART\n";
    let cube = CUBE.replace("*INSTANCE, NAME=Base-1, PART=Cube\n*END INSTANCE\n", "");
    // The profile of the floor is turned from the plane of x and y into that of x and z.
    let floor = "*INSTANCE, NAME=Floor-1, PART=Floor\n0., 0., 1.\n0., 0., 1., 1., 0., 1., 90.\n*END INSTANCE\n*RIGID BODY, REF NODE=RP, ANALYTICAL SURFACE=Floor-1.Face\n";
    let steps = format!(
        "*SURFACE INTERACTION, NAME=Fric\n{friction}*CONTACT PAIR, INTERACTION=Fric\nPad-1.Bottom, Floor-1.Face
*BOUNDARY\nRP, ENCASTRE\n*STEP, NLGEOM\n*STATIC\n0.5, 1.\n*BOUNDARY\nPad-1.High, 1, 2\nPad-1.High, 3, 3, -0.0002\n*END STEP
*STEP\n*STATIC, DIRECT\n0.1, 1.\n*BOUNDARY\nPad-1.High, 1, 1, {}\nPad-1.High, 2, 2, {}\n*END STEP\n",
        2.0 * cos,
        2.0 * sin
    );
    let (problem, state, listed) =
        run(&format!("{parts}{cube}{floor}*END ASSEMBLY\n{FOAM}{steps}"));
    assert_eq!(listed, Vec::<String>::new());
    pairs(&problem, &state)[0].sides[Side::A].force
}

/// On the ellipse `(t1/mu1)^2 + (t2/mu2)^2 = p^2` slip along `d` is normal to it:
/// `t_i = -p mu_i^2 d_i/sqrt(mu1^2 d1^2 + mu2^2 d2^2)`.
#[test]
fn anisotropic_friction_is_that_of_the_ellipse() {
    let [along, across] = [0.1_f64, 0.4];
    let friction = "*FRICTION, ANISOTROPIC\n0.1, 0.4\n";
    for degrees in [0.0, 30.0, 75.0, 90.0] {
        let force = dragged(degrees, friction);
        let (sin, cos) = f64::to_radians(degrees).sin_cos();
        let size = (along * cos).hypot(across * sin);
        let exact = [along * along * cos / size, across * across * sin / size];
        let ratio = [-force.x / force.z, -force.y / force.z];
        for (found, exact) in ratio.iter().zip(exact) {
            assert!(
                (found - exact).abs() < 1e-4,
                "{degrees}: {ratio:?} {exact:?}"
            );
        }
    }
    let isotropic = dragged(30.0, "*FRICTION\n0.3\n");
    let size = isotropic.x.hypot(isotropic.y) / isotropic.z;
    assert!((size - 0.3).abs() < 1e-6, "{size}");
}

/// A body that is thrown: `x = v t`, `z = v t - g t^2/2`.
#[test]
fn a_thrown_body_flies_on_a_parabola() {
    let cube = CUBE.replace("*INSTANCE, NAME=Base-1, PART=Cube\n*END INSTANCE\n", "");
    let more = "*NSET, NSET=Whole\nPad-1.Low, Pad-1.High\n*END ASSEMBLY\n";
    let throw = "*INITIAL CONDITIONS, TYPE=VELOCITY\nWhole, 1, 2.\nWhole, 3, 3.
*STEP, NLGEOM\n*DYNAMIC\n0.1, 0.5\n*DLOAD\nAll, GRAV, 9., 0., 0., -1.\n*END STEP\n";
    let (problem, state, listed) = run(&format!("{cube}{more}{FOAM}{throw}"));
    assert_eq!(listed, Vec::<String>::new());
    for (now, rest) in state.positions.iter().zip(&problem.reference) {
        let exact = Vec3::new(2.0 * 0.5, 0.0, 3.0 * 0.5 - 0.5 * 9.0 * 0.25);
        // The residual is small beside forces of gravity and inertia.
        assert!((now - rest - exact).norm() < 1e-6, "{}", now - rest);
    }
}

/// Pressure on top of two cubes in uniaxial strain goes through the contact between them.
#[test]
fn a_pressure_on_faces_goes_through_the_contact() {
    let steps = "*CONTACT PAIR\nPad-1.Bottom, Base-1.Top\n*STEP, NLGEOM\n*STATIC\n0.5, 1.
*BOUNDARY\nBase-1.Low, 1, 3\nBase-1.High, 1, 2\nPad-1.Low, 1, 2\nPad-1.High, 1, 2\n*DLOAD\nPad-1.All, P2, 0.5
*CLOAD\nPad-1.High, 3, -0.25\n*END STEP\n";
    let (problem, state, listed) = run(&model("", steps));
    assert_eq!(listed, Vec::<String>::new());
    let force = pairs(&problem, &state)[0].sides[Side::A].force;
    // The pressure on the unit face, and four forces.
    assert!((force - Vec3::new(0.0, 0.0, 1.5)).norm() < 1e-9, "{force}");
}
