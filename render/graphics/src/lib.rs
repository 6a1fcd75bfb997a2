//! Pictures, meshes and cameras, on the processor and on graphics devices.
//!
//! ```text
//! photograph (PNG, JPEG, TIFF, WebP) -> picture::Photograph -> Field of colours --+
//! mesh (OBJ, PLY, glTF) + camera -> surface: what each pixel shows ---+-> image operations
//!                                                                     |   (Rust and WGSL)
//! export: PNG, OpenEXR, GIF, APNG, folders of frames <----------------+
//! ```
//!
//! A [`Field`](field::Field) holds one value per pixel. For example, you encode a picture in
//! memory like this:
//!
//! ```
//! use graphics::export::{PictureFormat, picture_file};
//! use graphics::field::Field;
//!
//! # fn main() -> Result<(), graphics::export::ExportError> {
//! let mut picture = Field::filled(64, 48, [1.0_f32; 4]);
//! picture[(3, 2)] = [0.8, 0.1, 0.1, 1.0];
//! let file = picture_file(&picture, 0.1, PictureFormat::Png16)?;
//! assert!(file.outside == 0.0 && file.bytes.starts_with(b"\x89PNG"));
//! # Ok(())
//! # }
//! ```
//!
//! In scope: values over pixels, the graphics device, meshes and cameras, what a camera sees,
//! noise that stays on surfaces, and files of pictures and animations. Out of scope: pigments and
//! paint (crate `paint`), and painting techniques (the crates below `render/techniques`).
//!
//! Modules are declared in order of dependence: each uses only those above it.

pub mod noise;
pub mod tile;
pub mod field;
pub mod lanes;
pub mod encoding;
pub mod picture_formats;
mod described_colors;
pub mod picture;
pub mod exr_picture;
pub mod orientation;
pub mod tones;
pub mod gpu;
pub mod compute;
pub mod mesh;
pub mod camera;
pub mod distant_light;
pub mod surface;
pub mod coherence;
pub mod morphology;
pub mod segmentation;
pub mod export;

use crate::coherence::{ANCHOR_TEXTURES, DEPTHS, GATHER_SPLATS};
use crate::gpu::Kernel;
use crate::morphology::EXTREMUM;
use crate::surface::ADD_STENCIL;

pub use field::{blurred, smoothstep};

/// Every compute kernel of this crate.
#[must_use]
pub fn kernels() -> Vec<&'static Kernel> {
    vec![&DEPTHS, &GATHER_SPLATS, &ANCHOR_TEXTURES, &EXTREMUM, &ADD_STENCIL]
}
