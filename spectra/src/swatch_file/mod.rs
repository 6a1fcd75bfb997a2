//! Swatch files of painting programs: named colours without spectra.
//!
//! | extension | program | content |
//! |------|----|-------|
//! | `.gpl` | GIMP, Inkscape, Krita | sRGB in 8 bits |
//! | `.ase` | Adobe programs | RGB, Lab, CMYK or grey as 32-bit floats, in groups |
//! | `.aco` | Photoshop | RGB, HSB, Lab, CMYK or grey in 16 bits |
//!
//! None of the formats names its RGB space; it is taken as sRGB. Lab is that of the graphic
//! arts, under D50 for the 1931 observer.

mod entries;
mod error;
mod bytes;
mod gpl;
mod ase;
mod aco;
mod known;

pub use aco::{read_aco, write_aco};
pub use ase::{read_ase, write_ase};
pub use entries::{SwatchColor, SwatchEntry, SwatchFile, d50_white};
pub use error::SwatchFileError;
pub use gpl::{read_gpl, write_gpl};
pub use known::read_swatch_file;
