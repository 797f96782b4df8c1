//! Sparse linear algebra: patterns, orderings, factorisations; no mechanics.
