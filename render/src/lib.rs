//! Painting with calibrated pigments: thick wet paint moved by a brush, drying
//! layers, and their colour under any light.
//!
//! Follows Baxter, Wendt and Lin, "IMPaSTo: A Realistic, Interactive Model for
//! Paint" (NPAR 2004). Amounts of paint are integers (see [`amount`]), so that
//! nothing is ever lost and CPU and GPU agree bit for bit; light is computed in
//! f32 at eight wavelengths chosen for the illuminant.
//!
//! Out of scope: fitting pigments (crate `calibrate`), reading instruments.

pub mod amount;

mod noise;

pub mod tile;

pub mod field;

pub mod layer;

pub mod gpu;

pub mod optics;

pub mod palette;

pub mod light;

pub mod composite;

pub mod shade;

pub mod mesh;

pub mod camera;

pub mod surface;

pub mod paint;

pub mod export;

pub mod photograph;

pub mod watercolor;
