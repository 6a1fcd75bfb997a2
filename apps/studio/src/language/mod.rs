//! The languages of the window: English texts in the sources, and for each other language a
//! table with their translations.
//!
//! A text is shown through [`tr`], one with values through `tr_format`. Both look it up in the
//! table of the language that [`speak`] chose for this thread, and show the English text where
//! the table has none. Tables of data hold English texts, which are translated where they are
//! shown.

mod choice;
mod table;
mod current;
mod text;
mod labels;

pub use choice::Language;
pub use current::{set_system, speak, spoken};
pub use labels::{PAINTS, PATTERNS, WORDS, action_label, brush_label, layer_label};
pub use table::{Table, placeholders, table};
pub use text::{english, filled, tr, translation};

pub(crate) use text::tr_format;
