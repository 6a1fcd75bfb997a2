//! The pigment library: its data, its JSON file and the library that ships.

mod recipe_error;
mod pigment_library;
mod json;
mod file;
mod shipped;

pub use file::LibraryError;
pub use json::to_text;
pub use pigment_library::{AmountKind, Evidence, Input, Pigment, PigmentLibrary, SampleEvidence};
pub use recipe_error::RecipeError;
