//! CxF3, the Color Exchange Format (ISO 17972-1:2015, namespace "CxF3-core").

mod reader;
mod writer;

pub(super) use reader::read;
pub use writer::{CxfHead, write_cxf};
