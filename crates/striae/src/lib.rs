//! Finite-element contact with anisotropic friction.
