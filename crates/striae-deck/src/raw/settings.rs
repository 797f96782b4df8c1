//! `[output]`, `[sensitivity]` and `[solver]`.

use crate::{
    declare::{choice, either, table, words},
    read::At,
    value::{Count, Number, Positive, Text, Whole},
};

table! {
    /// Output of the run.
    OutputSettings {
        /// Increments between files of fields; 0: only the last. Default: 1.
        optional fields_every: Whole<0>,
        /// Time between files of fields, instead of `fields_every`: fields are written after the
        /// first increment that reaches each multiple of it.
        optional fields_interval: Positive,
        /// Names of the bodies whose fields are written. Default: all.
        optional bodies: Vec<At<Text>>,
        /// Fields of bodies. Default: `displacement`, `velocity`, `cauchy-stress`, `von-mises` and `history-variables`.
        optional body_fields: Vec<At<BodyField>>,
        /// Fields of contact surfaces. Default: all except `slip-rate` and `friction-state`; `worn-depth` of pairs that wear.
        optional contact_fields: Vec<At<ContactField>>,
        /// Archard's coefficient `k`, wear depth over pressure and slip: writes the field `wear_depth` of contact surfaces, the depth that would wear off if it did not change contact. For wear that opens gaps see `wear` of a pair. Default: none.
        optional wear_coefficient: Positive,
        /// Places whose displacement and stress are written to `probes.csv` after every increment.
        optional probes: Vec<At<Probe>>,
        /// Plane cuts of bodies; force and moment through them are written to `sections.csv` after every increment.
        optional sections: Vec<At<Section>>,
        /// Increments between checkpoints, from which `striae resume` continues; another one is
        /// written when a minute has passed; 0: only when the run stops. Default: 10.
        optional checkpoint_every: Whole<0>,
    }
}

table! {
    /// Derivatives of the run.
    Sensitivity {
        /// Numbers of this deck by which the columns of `history.csv` are differentiated, as with
        /// `--wrt`: names of `[parameters]`, or paths such as `pair.pad.friction.mu`. Each has a
        /// file `sensitivity-NAME.csv`.
        required wrt: Vec<At<Text>>,
    }
}

impl Sensitivity {
    /// The numbers by which the history is differentiated, with their places.
    pub(crate) fn names(&self) -> impl Iterator<Item = &At<Text>> {
        self.wrt.iter().flat_map(|names| &names.value)
    }
}

words! {
    /// A field of a body.
    BodyField {
        /// Displacement.
        Displacement = "displacement",
        /// Velocity, in dynamic steps.
        Velocity = "velocity",
        /// Cauchy stress at the nodes.
        CauchyStress = "cauchy-stress",
        /// Equivalent stress of von Mises.
        VonMises = "von-mises",
        /// Principal values of the Cauchy stress, the largest first.
        PrincipalStress = "principal-stress",
        /// Unit vectors along its principal axes, three arrays.
        PrincipalStressDirections = "principal-stress-directions",
        /// Logarithmic strain at the nodes.
        LogarithmicStrain = "logarithmic-strain",
        /// Its principal values, the largest first.
        PrincipalStrain = "principal-strain",
        /// Unit vectors along its principal axes, three arrays.
        PrincipalStrainDirections = "principal-strain-directions",
        /// Stored energy per volume at rest of the elements at each node.
        StrainEnergyDensity = "strain-energy-density",
        /// Named internal variables of materials, by element.
        HistoryVariables = "history-variables",
        /// Unit vectors along the families of fibres of each element, for bodies with fibres.
        Fibres = "fibres",
        /// Number of the section of each element, in the order of `sections` from 1; 0 outside of sections. For bodies with sections.
        Section = "section",
    }
}

words! {
    /// A field of contact surfaces.
    ContactField {
        /// Distance to the other side.
        Gap = "gap",
        /// Pressure, traction and its tangential part.
        Traction = "traction",
        /// Pressure and traction averaged about each node.
        MeanTraction = "mean-traction",
        /// Slip in the last increment.
        Slip = "slip",
        /// Slip in the last increment over its time.
        SlipRate = "slip-rate",
        /// Length of the path slipped since the start.
        AccumulatedSlip = "accumulated-slip",
        /// Depth that has worn off since the start, of pairs that wear.
        WornDepth = "worn-depth",
        /// State of friction that depends on rate and state.
        FrictionState = "friction-state",
        /// Friction work per area since the start.
        FrictionWork = "friction-work",
        /// Normal.
        Normal = "normal",
        /// Texture and structural vector.
        Texture = "texture",
        /// Open, stick or slip.
        Status = "status",
        /// Nodes with traction unknowns.
        Roles = "roles",
    }
}

table! {
    /// A plane cut through a body.
    Section {
        /// Name of its columns.
        required name: Text,
        /// Name of the body.
        required body: Text,
        /// A point of the plane before any motion.
        required point: [Number; 3],
        /// Normal of the plane before any motion, of any length. The force is that which the part
        /// it points to exerts on the other one: along the normal, tension is positive.
        required normal: [Number; 3],
    }
}

table! {
    /// A place of a body at which results are recorded.
    Probe {
        /// Name of its columns.
        required name: Text,
        /// Name of the body.
        required body: Text,
        /// Place of the probe.
        include place: ProbePlace,
    }
}

either! {
    /// Place of a probe.
    ProbePlace {
        Point(ProbePoint),
        Nodes(ProbeNodes),
    }
}

table! {
    /// A material point.
    ProbePoint {
        /// Its position before any motion; values are interpolated.
        required point: [Number; 3],
    }
}

table! {
    /// The mean over a set of nodes.
    ProbeNodes {
        /// Name of the node set.
        required nodes: Text,
    }
}

table! {
    /// Newton's method and the linear solver.
    SolverSettings {
        /// Factorisation of the linear systems. Default: `condensed`.
        optional backend: Backend,
        /// Determination of stick and slip. Default: `semismooth`.
        optional strategy: Strategy,
        /// Relative tolerance of every residual field. Default: 1e-10.
        optional tolerance: Positive,
        /// Iterations after which an increment is cut. Default: 40.
        optional largest_iterations: Count,
    }
}

words! {
    /// Factorisation of the linear systems.
    Backend {
        /// Bodies by Cholesky and contact by dense algebra; multifrontal LU if that fails or is cheaper, `iterative` for large bodies.
        Condensed = "condensed",
        /// Multifrontal LU on dense fronts.
        Multifrontal = "multifrontal",
        /// Sparse LU of the library faer.
        Faer = "faer",
        /// GMRES, the bodies by smoothed aggregation; direct factors if that fails.
        Iterative = "iterative",
        /// MUMPS, a direct solver, in a build with PETSc.
        Mumps = "mumps",
    }
}

choice! {
    /// Determination of stick and slip.
    Strategy by method {
        "semismooth" => Semismooth(Semismooth),
        "table-1" => Table1(Table1),
    }
}

table! {
    /// As part of the linearisation.
    Semismooth {}
}

table! {
    /// By a predictor and a corrector between iterations, for comparison.
    Table1 {
        /// Relative excess of friction over the law up to which a sticking node does not slip.
        /// Default: 0.01.
        optional stick_tolerance: Positive,
    }
}
