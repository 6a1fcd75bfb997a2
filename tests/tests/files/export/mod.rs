//! Exported pictures, read back by readers that are not ours.

mod maps;
mod open_exr;
mod portable_network_graphics;
