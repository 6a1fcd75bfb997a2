//! Meshes and their files.
