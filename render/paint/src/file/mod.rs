//! Painting files: OpenEXR, format `impasto-painting`, version 1. Callers usually use
//! [`Document::open`](crate::document::Document::open) and
//! [`Document::save`](crate::document::Document::save).
//!
//! One file has a part per layer, with scan lines of 32-bit float channels, so that any
//! program that reads OpenEXR can show and edit them. Compression is PIZ, which is
//! lossless; it encodes wet paint in half the time of ZIP and to two thirds of the bytes.
//! Files with ZIP or without compression are read too.
//!
//! | part | channels, in mm |
//! | --- | --- |
//! | `base` | `height` of the ground above the plane of the canvas |
//! | `wet`, `dry.000`, `dry.001` .. (lowest first) | one channel per pigment: height of its paint; `vehicle`; `thickness`: their sum, for other programs, not read |
//!
//! The display window is the canvas. The data window of a layer is the rectangle that has
//! paint. Attribute `impasto` of part `base` is JSON in ASCII: format and version, title,
//! cell size, ground, medium, lighting, the layers with the channel of each pigment, their
//! opacity, and the pigment library.
//!
//! The part of a dry layer has an attribute of its own, `impasto.layer`: JSON in ASCII with its
//! identity (`id`), that of the next layer (`next`), its `name` and whether it is `visible`. A file
//! of an earlier version has none: its layers are numbered from the lowest, 1, and visible. Older
//! programs leave the attribute alone, and show hidden layers.
//!
//! The studio also keeps the palette and the brushes: as the bytes of a file of this format in
//! attribute `impasto.table` of part `wet`. Its layers are those of the palette; a part
//! `brush.000`, `brush.001` .. has the paint on the cells of a brush's head, and the JSON the name,
//! shape and size of each brush. Programs that only show the painting need not decode it.
//!
//! A pigment's channel has the pigment's name. Characters outside ASCII and dots (which
//! OpenEXR reads as layers within the part) become `_`, and a name that is taken gets a
//! number; the JSON says which channel belongs to which pigment.
//!
//! Amounts are whole quanta (see [`crate::amount`]) and are restored exactly. A 32-bit
//! float distinguishes quanta below 2^23, that is paint up to four cell widths high. If a
//! layer holds more, channel `NAME.rest` has the rounding residue in mm, and the amount is
//! the sum of both.

mod error;
mod millimetres;
mod names;
mod ascii;
mod pigments;
mod header;
mod layer_attribute;
mod table_attribute;
mod channels;
mod parts;
mod layout;
mod read;
mod write;
mod saved;

#[cfg(test)]
mod tests;

pub use ascii::{ATTRIBUTE, ascii_json};
pub use error::PaintingFileError;
pub use layout::EXPANSION;
pub use names::ChannelNames;
pub use pigments::{PigmentChannel, channels_of_slots, slots_of_channels};
pub use read::{MEMORY_LIMIT, read, read_table, read_within};
pub use write::{write, write_with_table};
