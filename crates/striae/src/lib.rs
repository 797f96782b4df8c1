//! Finite-element contact with anisotropic friction.
//!
//! # A first model
//!
//! A block is pressed onto a grooved floor and dragged across. Bodies and sets are
//! called by name; [`build`](model::ModelBuilder::build) looks the names up and
//! lists every fault of the model.
//!
//! ```
//! use striae::prelude::*;
//!
//! # fn main() -> Result<(), Error> {
//! let rubber = Material::neo_hookean(LameConstants::from_youngs_modulus(1e6, 0.3)?);
//! let mesh = Block { divisions: [2, 2, 2], ..Block::default() }.mesh()?;
//! let grooves = uniform([1.0, 0.0, 0.0]);
//! let model = model("A block on a grooved floor")
//!     .body(body("block", mesh, rubber))
//!     .rigid(plane("floor", [0.0; 3], [0.0, 0.0, 1.0]))
//!     .pair(
//!         pair("sole", surface("block", "zmin"), rigid("floor").textured(grooves))
//!             .friction(Friction::orthotropic(0.1, 0.4, SlipRule::Opposing)?),
//!     )
//!     .step(step("press").increments(2).displace("block", "zmax", [0.0, 0.0, -0.02]))
//!     .step(step("drag").increments(5).displace("block", "zmax", [None, Some(0.3), None]))
//!     .build()?;
//!
//! let run = Simulation::new(model)?.run()?;
//! assert_eq!(run.ending, Ending::Completed);
//!
//! let sole = run.results().pair("sole").unwrap();
//! let force = sole.sides[0].force;
//! assert!((force.y / force.z + 0.4).abs() < 1e-3, "friction across the grooves");
//! # Ok(()) }
//! ```
//!
//! # Results
//!
//! [`Results`] reads a state by names. Nodal fields are slices in the order of the
//! nodes of the mesh; contact is known at the nodes of a side. The
//! [history](Finished::history) has a row for every increment.
//!
//! ```
//! # use striae::prelude::*;
//! # fn main() -> Result<(), Error> {
//! # let steel = Material::linear_elastic(LameConstants::from_youngs_modulus(100.0, 0.0)?);
//! # let model = model("A bar on a floor")
//! #     .body(body("bar", Block::default().mesh()?, steel))
//! #     .rigid(plane("floor", [0.0; 3], [0.0, 0.0, 1.0]))
//! #     .pair(pair("foot", surface("bar", "zmin"), rigid("floor")))
//! #     .step(step("press").increments(2).displace("bar", "zmax", [0.0, 0.0, -0.01]))
//! #     .build()?;
//! let run = Simulation::new(model)?.run()?;
//! let results = run.results();
//!
//! let positions: &[Vec3] = results.positions("bar").unwrap();
//! let lowest = positions.iter().map(|x| x.z).fold(f64::INFINITY, f64::min);
//! assert!(lowest.abs() < 1e-9);
//!
//! for node in results.contact("foot", PairSide::A).unwrap() {
//!     assert!((node.pressure - 1.0).abs() < 1e-9);
//!     assert_eq!(node.status, Status::Slip);
//! }
//! let force = run.history.column("pair.foot.resultant_a.z").unwrap();
//! assert_eq!(force.len(), 2);
//! assert!((force[1] - 1.0).abs() < 1e-9);
//! # Ok(()) }
//! ```
//!
//! # Watching a run
//!
//! An [`Observer`] is notified of every iteration and increment, and may stop the run. An
//! [`Interrupt`] stops it from another thread.
//!
//! ```
//! use striae::prelude::*;
//!
//! /// Stops when the contact force is large enough.
//! struct UntilForce(f64);
//!
//! impl Observer for UntilForce {
//!     fn increment(&mut self, converged: &Converged<'_>) -> Next {
//!         match converged.results.pair("foot") {
//!             Some(pair) if pair.sides[0].force.norm() > self.0 => Next::Stop,
//!             _ => Next::Continue,
//!         }
//!     }
//! }
//! # fn main() -> Result<(), Error> {
//! # let steel = Material::linear_elastic(LameConstants::from_youngs_modulus(100.0, 0.0)?);
//! # let model = model("A bar on a floor")
//! #     .body(body("bar", Block::default().mesh()?, steel))
//! #     .rigid(plane("floor", [0.0; 3], [0.0, 0.0, 1.0]))
//! #     .pair(pair("foot", surface("bar", "zmin"), rigid("floor")))
//! #     .step(step("press").increments(4).displace("bar", "zmax", [0.0, 0.0, -0.01]))
//! #     .build()?;
//! let run = Simulation::new(model)?.run_with(&mut UntilForce(0.4))?;
//! assert_eq!(run.ending, Ending::Interrupted { time: 0.5 });
//! # Ok(()) }
//! ```
//!
//! # Faults
//!
//! A model finds its own faults, all of them, each with the path of the part that is
//! wrong. Models built by name and models whose fields are set by hand are judged alike.
//!
//! ```
//! # use striae::prelude::*;
//! # fn main() -> Result<(), Error> {
//! # let steel = Material::linear_elastic(LameConstants::from_youngs_modulus(100.0, 0.0)?);
//! let faults = model("A block on nothing")
//!     .body(body("block", Block::default().mesh()?, steel))
//!     .step(step("lift").displace("block", "top", [0.0, 0.0, 1.0]))
//!     .build()
//!     .unwrap_err();
//! assert_eq!(
//!     faults.0[0].to_string(),
//!     "steps[0].displacements[0]: body `block` has no node set `top`; \
//!      it has `all`, `xmax`, `xmin`, `ymax`, `ymin`, `zmax`, `zmin`",
//! );
//! # Ok(()) }
//! ```
//!
//! [`Advice`](advice::Advice) goes further: it says what a valid model is, and what
//! about it looks like a mistake.
//!
//! # Laws of one's own
//!
//! A friction law implements [`FrictionLaw`](law::friction::FrictionLaw), a bulk law
//! [`BulkLaw`](law::bulk::BulkLaw), or [`IsochoricLaw`](law::bulk::IsochoricLaw) if it is
//! rubber, in any crate. Batteries hold it against mechanics
//! before it meets a mesh; `examples/own_laws.rs` has one of each.
//!
//! ```
//! use striae::law::bulk::{BulkLaw, Response, ResponseError, battery};
//! use striae::nalgebra::Matrix3;
//! use striae::prelude::*;
//!
//! /// Two laws side by side, each with half the volume.
//! #[derive(Debug)]
//! struct Mixture([Material; 2]);
//!
//! impl BulkLaw for Mixture {
//!     fn name(&self) -> &str {
//!         "mixture"
//!     }
//!
//!     fn response(&self, f: &Matrix3<f64>) -> Result<Response, ResponseError> {
//!         let [a, b] = [self.0[0].response(f)?, self.0[1].response(f)?];
//!         Ok(Response {
//!             energy: 0.5 * (a.energy + b.energy),
//!             first_piola: (a.first_piola + b.first_piola) * 0.5,
//!             tangent: (a.tangent + b.tangent) * 0.5,
//!         })
//!     }
//!
//!     fn lame_constants(&self) -> LameConstants {
//!         let [a, b] = [self.0[0].lame_constants(), self.0[1].lame_constants()];
//!         LameConstants {
//!             lambda: 0.5 * (a.lambda + b.lambda),
//!             shear: 0.5 * (a.shear + b.shear),
//!         }
//!     }
//! }
//! # fn main() -> Result<(), Error> {
//! let soft = Material::neo_hookean(LameConstants::from_youngs_modulus(1.0, 0.3)?);
//! let hard = Material::neo_hookean(LameConstants::from_youngs_modulus(9.0, 0.2)?);
//! let mixture = Material::own(Mixture([soft, hard]));
//! assert_eq!(battery(&mixture), []);
//! # Ok(()) }
//! ```
//!
//! # Files
//!
//! A run writes files only on request: [`recorded`](Simulation::recorded) writes fields for
//! ParaView, the history and a summary, [`resumable`](Simulation::resumable) also checkpoints.
//! [`Simulation::open`] runs a deck as the program does, [`Simulation::resume`] goes on after an
//! interruption, to the same results to the last bit.
//!
//! ```no_run
//! # use striae::prelude::*;
//! # fn main() -> Result<(), Error> {
//! let run = Simulation::open("press.toml".as_ref(), "results/press")?.run()?;
//! if let Ending::Interrupted { .. } = run.ending {
//!     Simulation::resume("results/press".as_ref())?.run()?;
//! }
//! # Ok(()) }
//! ```
//!
//! # Parts
//!
//! [`model`], [`mesh`], [`mesh_file`], [`law`], [`surface`], [`contact`], [`solve`],
//! [`deck`] and [`output`] are the crates below, for what the names above do not reach;
//! [`figures`] draws friction laws and textures, [`measurements`] reads measured friction for
//! [`law::fit`]. Laws of one's own are written with
//! [`nalgebra`] and [`num_dual`], which are handed on. The `striae` program is a client of
//! this crate.

pub mod advice;
mod beside;
mod error;
pub mod figures;
mod interrupt;
mod log;
pub mod measurements;
mod observer;
pub mod prelude;
mod ranks;
mod results;
pub mod sensitivity;
mod simulation;

pub use beside::write_frictions;
pub use error::Error;
pub use interrupt::{Before, Interrupt};
pub use nalgebra;
pub use num_dual;
pub use observer::{Converged, Next, Observer};
pub use ranks::Ranks;
pub use results::{PairSide, Results};
pub use simulation::{Finished, Simulation, case_name, read_again};
pub use striae_contact as contact;
pub use striae_deck as deck;
pub use striae_declared as declared;
pub use striae_element as element;
pub use striae_law as law;
pub use striae_mesh as mesh;
pub use striae_meshfile as mesh_file;
pub use striae_model as model;
pub use striae_output as output;
pub use striae_solve as solve;
pub use striae_surface as surface;
