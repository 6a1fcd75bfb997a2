//! OpenEXR files of texels: parts of scan lines with named channels of 32-bit floats, compressed
//! by PIZ, which is lossless, and a description in JSON.
//!
//! Samples and art maps are stored in such files; they tell their parts and channels, and this
//! module encodes, checks and decodes them. The description stands in attribute `impasto` of the
//! first part, in ASCII, and begins with the keys `format` and `version`. Parts are in the order
//! of the description. Memory is allocated after all parts were found to be as it says.

mod error;
mod kind;
mod description;
mod part;
mod texels;
mod digest;
mod layout;
mod read;
mod write;

#[cfg(test)]
mod tests;

pub(crate) use description::{decoded, encoded, encoded_library, paint_of, proven};
pub(crate) use digest::{of_planes, of_text};
pub use error::TexelFileError;
pub(crate) use kind::{Origin, TexelFileKind};
pub(crate) use part::{PartPlan, PartPlanes};
pub(crate) use read::Opened;
pub(crate) use texels::{COLOR, HEIGHT, Texels, VEHICLE};
pub(crate) use write::write;
