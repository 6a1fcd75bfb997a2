//! Changes and checks of pigment libraries: merging, another reference white or grid, other names,
//! health, and the difference of two libraries.

mod error;
mod rescale;
mod resample;
mod select;
mod merge;
mod table;
mod guess;
mod health;
mod difference;
mod swatches;

pub use difference::{Difference, PigmentDifference, PigmentPair, difference};
pub use error::CurationError;
pub use guess::{Body, Guess, add_guessed, guessed_pigment};
pub use health::{Finding, Health, PigmentHealth, Severity, health};
pub use merge::{MergeSettings, Merged, Prefer, Source, merged};
pub use resample::on_grid;
pub use rescale::with_reference;
pub use select::{renamed, subset, with_color_indices};
pub use swatches::{Swatch, SwatchSpace, Swatches};
pub use table::{LibraryFrame, TableError, from_csv, to_csv};
