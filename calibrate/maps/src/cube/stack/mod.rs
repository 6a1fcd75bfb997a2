//! Stacks of pictures: one picture a wavelength, in files of their own, or as pages and values of pixels
//! of one TIFF file.

mod plane;
mod tiff_pages;
mod png_plane;
mod folder;

pub(crate) use folder::{files_ending_in, is_stack, open_folder};
pub(crate) use tiff_pages::{is_tiff, open_pages};
