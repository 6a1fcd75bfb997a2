//! What of a mesh is seen.
