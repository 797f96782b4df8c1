//! Linear systems of bodies in contact.
//!
//! A [`Partition`] says what of a structure is the *bulk*, coupled by elements, and what
//! the *interface*, coupled by contact. A [`Tangent`] holds the values of both, each in a
//! matrix of its own. [`Automatic`] chooses between a condensed solver
//! (Cholesky for the bodies, dense algebra for contact), an iterative one for bodies too
//! large for factors, and an LU that takes the system as it is:
//!
//! ```
//! use striae_condensed::{Automatic, Choice, Growth, Partition, Tangent, TangentSolver};
//! use striae_sparse::{PlacedBlock, Structure, Supervariable};
//!
//! // Two springs, and a multiplier that ties their ends.
//! let (a, b) = (Supervariable(0), Supervariable(1));
//! let bulk = Structure::from_cliques(vec![0, 1, 3], &[[a], [b]])?;
//! let partition = Partition::new(&bulk, &[1, 1])?.grown(&Growth::from_iter([vec![a, b]]))?;
//! let mut tangent = Tangent::zero(partition.structure());
//! tangent.bodies.add(&[0], &[0], &[2.0])?;
//! tangent.bodies.add(&[1], &[1], &[3.0])?;
//! let contact = [
//!     PlacedBlock {
//!         rows: vec![(0, 0), (1, 1)],
//!         columns: vec![2..3],
//!         values: vec![1.0, -1.0].into(),
//!     },
//!     PlacedBlock {
//!         rows: vec![(2, 0)],
//!         columns: vec![0..1, 1..2],
//!         values: vec![1.0, -1.0].into(),
//!     },
//! ];
//! tangent.contact = partition.gathered(&contact).expect("the partition has grown by them");
//!
//! let mut solver = Automatic::new(Choice::ByCost);
//! solver.analyse(&partition)?;
//! solver.factor(&tangent)?;
//! let mut x = [0.0; 3];
//! solver.solve(&tangent, &[5.0, 0.0, 0.0], &mut x)?;
//! assert!((x[0] - 1.0).abs() < 1e-14 && (x[1] - 1.0).abs() < 1e-14);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod automatic;
mod bulk;
mod condensed;
mod entries;
mod experience;
mod growth;
mod interface;
mod iterative;
mod partition;
mod report;
mod scaling;
mod solver;
mod tangent;

pub use automatic::{Automatic, Choice, REDUCTION};
pub use experience::{Experience, FactoredInterior};
pub use growth::Growth;
pub use iterative::{ContactFactors, Group, Stiffening};
pub use partition::{Numbering, Partition, PartitionError};
pub use report::{Analysis, Factored, FallBack, Method};
pub use solver::TangentSolver;
pub use tangent::Tangent;
