//! Pictures for others: PNG, linear OpenEXR, single frames and animations.
//!
//! Functions here take plain data and give bytes; who calls them writes the files.
//! The same data give the same bytes.

mod error;

mod exr_part;

mod linear_exr;

mod png;

mod frame;

mod color_table;

mod animation;

mod sequence;

pub use animation::{Apng, Gif};
pub use color_table::ColorTable;
pub use error::{ExportError, check_cell, check_size};
pub use exr_part::exr_file;
pub use frame::{Frame, FrameError, FrameRate, frame_of, frame_png, read_frame};
pub use linear_exr::{FloatBits, linear_exr, rgb_channels};
pub use png::{Png, grey16, png8, png16};
pub use sequence::{Sequence, SequenceError, Shots};
