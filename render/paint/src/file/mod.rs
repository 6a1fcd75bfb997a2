//! Paintings as OpenEXR files: format `impasto-painting`, version 1.
//!
//! One file with a part per layer, all scan lines, 32-bit float channels,
//! compressed without loss (PIZ, which on wet paint takes half of ZIP's time to write and
//! two thirds of its bytes; ZIP and plain are read too), so that any program
//! that reads OpenEXR shows and edits them:
//!
//! | part | channels, in mm |
//! | --- | --- |
//! | `base` | `height` of the ground over the plane of the canvas |
//! | `wet`, `dry.000`, `dry.001` .. (lowest first) | one channel per pigment: height of its paint; `vehicle`; `thickness`: the sum of all, for other programs, not read |
//!
//! The display window is the canvas; a layer's data window is what it covers,
//! and where it has none there is no paint. Attribute `impasto` of part `base`
//! is JSON in ASCII: format and version, title, size of a cell, ground, medium,
//! lighting, the layers with the channel of each pigment, their opacity, and
//! the pigment library.
//!
//! A pigment's channel has its name. What is not ASCII or a dot (which OpenEXR
//! reads as a layer within the part) becomes `_`, and what is taken already
//! gets a number: the JSON tells which channel is whose.
//!
//! Amounts are whole quanta (see [`crate::amount`]) and come back the same. A
//! 32-bit float tells quanta below 2^23 apart, that is paint up to four cell
//! widths high. Where a layer holds more, the channel `NAME.rest` has what the
//! float left out, in mm, and the amount is the sum of both.

mod channels;

mod error;

mod header;

mod millimetres;

mod parts;

mod layout;

mod read;

mod write;

pub use error::PaintingFileError;
pub use read::{MEMORY_LIMIT, read, read_within};
pub use write::write;
