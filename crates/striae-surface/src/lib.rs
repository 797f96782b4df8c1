//! Geometry of a deforming surface: facets, nodal normals, transport, textures.
