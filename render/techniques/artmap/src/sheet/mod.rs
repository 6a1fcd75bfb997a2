//! Sheets: pictures on which all samples of a set can be seen at once.

mod scale;
mod laid_out;

pub use laid_out::sheet;
