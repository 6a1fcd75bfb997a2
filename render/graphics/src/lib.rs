//! Pictures and models on the processor and on graphics devices.
//!
//! In scope: values over pixels, the graphics device, meshes and cameras, what a
//! camera sees, noise that stays on surfaces, and files of pictures and animations.
//! Out of scope: pigments and paint (crate `paint`), and painting techniques (crate
//! `render`).
//!
//! Files stand in an order of dependence; each uses only what stands above it.

pub mod noise;

pub mod tile;

pub mod field;

pub mod lanes;

mod blur;

pub mod picture;

pub mod orientation;

pub mod tones;

pub mod gpu;

pub mod mesh;

pub mod camera;

pub mod surface;

pub mod image;

pub mod coherence;

pub mod export;

pub use blur::blurred;
