//! Advice for keywords of which nothing is made.

/// Advice for a keyword; empty where there is nothing to do.
pub(super) fn remedy(keyword: &str) -> &'static str {
    match keyword {
        "EQUATION" => {
            ": nodes follow no equations; tie surfaces by *TIE, or nodes to a point by *COUPLING with *KINEMATIC"
        }
        "MODEL CHANGE" => {
            ": elements and pairs are there all the time; prescribe motions that part them"
        }
        "TEMPERATURE" | "FIELD" => {
            ": there are no temperatures; state `thermal_expansion` in `actuation` of the step"
        }
        "EXPANSION" => {
            ": there are no temperatures; `thermal_expansion` in `actuation` of a step has its effect"
        }
        "DAMPING" => ": materials have no damping; *VISCOELASTIC has",
        "CONTACT DAMPING" => ": contact has no damping",
        "CLEARANCE"
        | "CONTACT INTERFERENCE"
        | "CONTACT INITIALIZATION ASSIGNMENT"
        | "CONTACT CLEARANCE ASSIGNMENT" => ": state `initial` or `interference` of the pair",
        "CHANGE SURFACE BEHAVIOR" | "CHANGE CONTACT TYPE" => ": contact is hard in all steps",
        "CHANGE MATERIAL" | "CHANGE PLASTIC" | "CHANGE SOLID SECTION" => {
            ": materials do not change; run on with another deck"
        }
        "SPRING" | "DASHPOT" | "CONNECTOR SECTION" => ": state a `[[spring]]`",
        "FOUNDATION" => {
            ": state a `[[spring]]` with a `direction` at the nodes of the faces; its `stiffness` is that of one node, the foundation's times the area of the node"
        }
        "MASS" | "ROTARY INERTIA" => ": state `mass` and `inertia` of a rigid body",
        "SHELL SECTION"
        | "MEMBRANE SECTION"
        | "BEAM SECTION"
        | "SURFACE SECTION"
        | "SHELL GENERAL SECTION"
        | "BEAM GENERAL SECTION" => ": only solids have sections",
        "PRE-TENSION SECTION" => ": press a cut part together by `interference` of a pair",
        "INITIAL CONDITIONS" => ": bodies begin without stress and at rest",
        "TIME POINTS" => ": state `fields_interval` of `[output]`",
        "FLUID CAVITY" | "FLUID BEHAVIOR" => ": state a `[[cavity]]`",
        "EL PRINT" | "ELEMENT OUTPUT" => ": name points in `probes` of `[output]`",
        "SECTION PRINT" => ": state `sections` of `[output]`",
        _ => "",
    }
}
