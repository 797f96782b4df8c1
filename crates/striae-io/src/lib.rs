//! Decks, meshes, VTK files, histories, summaries and figures.
