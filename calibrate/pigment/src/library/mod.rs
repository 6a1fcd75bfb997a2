//! The pigment library: what a fit is for.

mod file;

mod json;

mod pigment_library;

mod shipped;

pub use file::LibraryError;
pub use json::to_text;
pub use pigment_library::{
    AmountKind, Evidence, Input, Pigment, PigmentLibrary, RecipeError, SampleEvidence,
};
