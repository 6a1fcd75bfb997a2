//! Changes and checks of pigment libraries: merging, another reference white or grid, other names,
//! health, and the difference of two libraries.

mod change;
mod merge;
mod table;
mod health;

pub use change::{
    Body, CurationError, Guess, add_guessed, guessed_pigment, on_grid, renamed, subset,
    with_color_indices, with_reference,
};
pub use health::{
    Difference, Finding, Health, PigmentDifference, PigmentHealth, PigmentPair, Severity,
    difference, health,
};
pub use merge::{MergeSettings, Merged, Prefer, Source, merged};
pub use table::{LibraryFrame, Swatch, SwatchSpace, Swatches, TableError, from_csv, to_csv};
