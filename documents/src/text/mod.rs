//! Texts of TOML and JSON that people write: values with their lines, and errors that name file, line, key
//! and the way out.
//!
//! ```
//! use documents::hint::Explain;
//! use documents::text::{KeyPath, Source, TextError, ValueFault};
//!
//! #[derive(serde::Deserialize)]
//! #[serde(deny_unknown_fields)]
//! struct Sheet {
//!     width_mm: f64,
//! }
//!
//! fn sheet(name: &str, text: &str) -> Result<Sheet, TextError> {
//!     let source = Source::toml(name, text)?;
//!     let sheet: Sheet = source.typed()?;
//!     if !(1.0..=100.0).contains(&sheet.width_mm) {
//!         let key = KeyPath::of("width_mm");
//!         let fault = ValueFault::new(&key, "1 to 100", sheet.width_mm, "10 is usual");
//!         return Err(source.located(fault));
//!     }
//!     Ok(sheet)
//! }
//!
//! let error = sheet("a.toml", "\nwidth_mm = 0").map(|sheet| sheet.width_mm).unwrap_err();
//! assert_eq!(error.to_string(), "a.toml, line 2: width_mm takes 1 to 100, found `0`");
//! let error = sheet("a.toml", "width = 5").map(|sheet| sheet.width_mm).unwrap_err();
//! assert_eq!(error.to_string(), "a.toml, line 1: width: unknown key `width`");
//! assert_eq!(error.hint().map(|hint| hint.to_string()).as_deref(), Some("it takes the keys width_mm"));
//! ```

mod key_path;
mod source;

pub use key_path::{KeyPath, KeyStep};
pub(crate) use source::USUAL_HINT;
pub use source::{Checked, Place, Source, TextError, ValueFault, line_of, read_text};
