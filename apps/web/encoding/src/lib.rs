//! Decodes the encodings of instrument files: UTF-8, UTF-16 and Windows-1252. It has the interface
//! of the crate encoding_rs.
//!
//! That crate has tables of every encoding of the web, which would be a sixth of the page's
//! download. They come with the reader of workbooks. Workbooks are UTF-8, but could name another
//! encoding: this is an error here.

mod characters;
mod encoding;
mod decoder;
mod names;
mod lookup;

pub use decoder::{Decoder, DecoderResult};
pub use encoding::Encoding;
pub use names::*;
