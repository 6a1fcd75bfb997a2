//! Exported pictures, read back with independent readers.

mod maps;
mod open_exr;
mod portable_network_graphics;
