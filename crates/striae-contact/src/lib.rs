//! Frictional contact of two surfaces: search, roles, traction fields, complementarity.
