//! Decodes the encodings of instruments' files: UTF-8, UTF-16 and Windows-1252, by the interface of the crate
//! encoding_rs.
//!
//! That crate holds tables of every encoding of the web, a sixth of the page's download. They are linked for the
//! reader of workbooks, which are UTF-8 but might say otherwise. Text in any other encoding is an error here.

mod characters;
mod encoding;
mod decoder;
mod names;
mod lookup;

pub use decoder::{Decoder, DecoderResult};
pub use encoding::Encoding;
pub use names::*;
