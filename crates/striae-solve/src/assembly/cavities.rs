//! Pressures in cavities and their volumes in the system, see [`striae_model::cavity`].

use striae_contact::segment::Derivatives;
use striae_mesh::Vec3;

use super::{
    Imposed, System, Trial,
    scatter::{Part, Slot},
};
use crate::outcome::CutBack;
use striae_model::{
    cavity::{Content, pressed},
    load::FaceLoad,
    node::GlobalNode,
};

impl System<'_> {
    /// Adds the pressures in all cavities with the rows of their volumes.
    pub(super) fn cavities(&mut self, trial: &Trial, imposed: &Imposed) -> Result<(), CutBack> {
        let problem = self.context.problem;
        for (cavity, content) in imposed.cavities.iter().enumerate() {
            let surface = &problem.cavities[cavity];
            let failed = || CutBack::Cavity {
                cavity: problem.model.cavities[cavity].name.clone(),
            };
            let pressure = trial.pressures[cavity];
            let unknown = self.layout.cavity(cavity);
            let filled = content.volume(pressure);
            let mut volume = 0.0;
            for corners in &surface.faces {
                let load = pressed(corners, &problem.reference, &trial.positions);
                let load = load.map_err(|_| failed())?;
                volume += surface.part(corners, &load, &trial.positions);
                self.press(corners, &load, (pressure, unknown), filled.is_some());
            }
            match (content, filled) {
                (Content::Pressure(target), _) => {
                    let scale = surface.volume / self.stiffness();
                    self.hold(unknown, (pressure - target) * scale, scale);
                }
                (_, Some([filled, slope])) => {
                    self.residual[unknown] = filled - volume;
                    self.volumes = self.volumes.max((filled - volume).abs() / surface.volume);
                    if self.derivatives == Derivatives::First {
                        self.matrix.add_to_diagonal(unknown, slope);
                    }
                }
                (_, None) => return Err(failed()),
            }
        }
        Ok(())
    }

    /// Modulus by which pressures are scaled.
    fn stiffness(&self) -> f64 {
        let bodies = self.context.problem.compositions.iter();
        let moduli = bodies.map(|composition| composition.stiffest_shear());
        moduli.fold(f64::MIN_POSITIVE, f64::max)
    }

    /// Adds the pressure on a face, and the part of the face in the row of the volume.
    fn press(
        &mut self,
        corners: &[GlobalNode; 4],
        load: &FaceLoad,
        (pressure, unknown): (f64, usize),
        has_row: bool,
    ) {
        let share = self.inertia.share_of_end;
        let unknowns = self.unknowns(corners);
        let factor = -pressure * share;
        self.add_dense(
            corners,
            &unknowns,
            &load.force.map(|f| f * factor),
            &load.tangent.map(|k| k * factor),
        );
        for (corner, force) in corners.iter().zip(load.force.chunks_exact(3)) {
            self.forces.applied[*corner] += Vec3::from_column_slice(force) * pressure;
        }
        if self.derivatives == Derivatives::None {
            return;
        }
        let slots = unknowns.iter().enumerate().map(|(at, &unknown)| Slot {
            unknown,
            position: Some((corners[at / 3], at % 3)),
            against: None,
        });
        let slots: Vec<Slot> = slots.collect();
        let own = [Slot::plain(unknown)];
        self.add_rows(Part::Bodies, &slots, &own, &load.force.map(|f| -f * share));
        if has_row {
            self.add_rows(Part::Bodies, &own, &slots, &load.force.map(|f| -f));
        }
    }
}
