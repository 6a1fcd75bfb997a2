//! Quantities over wavelength, colour, and Kubelka-Munk optics.
//!
//! ```text
//! instrument file --> MeasuredSpectrum --> Spectrum<Reflectance> --+
//!                       | counts: Referencing (white, dark)         +--> XYZ, CIELAB, sRGB
//! light by name ------> Illuminant + Observer = Viewing -----------+
//! ```
//!
//! ```
//! # let path = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/paints.csv");
//! let file = spectra::read_spectra(path)?;
//! let viewing = spectra::Viewing::named("D65", "1931-2")?;
//! for measured in &file.spectra {
//!     let color = viewing.color(&measured.reflectance()?)?;
//!     println!("{}: {} {:?}", measured.name, color.hex(), color.lab);
//! }
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! | task | call |
//! |---|---|
//! | read any instrument's file, or one spectrum of it | [`read_spectra`], [`read_spectrum`] |
//! | reflectance from counts | [`referencing::Referencing`] |
//! | a light by name, temperature or file | [`light_from_text`] |
//! | colour temperature and colour rendering of a light | [`ColorRendering::of`] |
//! | colour of a reflectance | [`Viewing::color`] |
//! | colour differences | [`color::delta_e_ciede2000`] and its neighbours |
//! | reflectance of a paint film | [`optics`] |
//! | swatches of painting programs | [`swatch_file`] |
//!
//! In scope: wavelengths and grids, typed spectra and their resampling, the CIE observers
//! and illuminants, colour and colour difference, and the optics of a paint film. Out of
//! scope: fitting (see the crate `calibrate`), painting, gloss and fluorescence, which a
//! reflectance factor does not separate.
//!
//! Modules are ordered by dependence: each uses only modules declared above it.

mod wavelength;
mod grid;
mod interpolate;
mod spectrum;
mod spline;
mod irregular;
pub mod csv_table;
pub mod instrument;
pub mod referencing;
mod table;
mod observer;
mod illuminant;
mod daylight;
mod black_body;
mod lamp;
mod light;
pub mod color;
mod integrate;
mod viewing;
mod color_temperature;
mod color_rendering;
pub mod swatch_file;
pub mod optics;

pub use black_body::{SECOND_RADIATION_CONSTANT, black_body};
pub use color_rendering::{ColorFidelity, ColorRendering, ColorRenderingError, RenderingIndex};
pub use color_temperature::ColorTemperature;
pub use daylight::{daylight, daylight_chromaticity};
pub use grid::{Grid, GridError};
pub use illuminant::{Illuminant, IlluminantError};
pub use instrument::{open as read_spectra, open_spectrum as read_spectrum};
pub use integrate::TristimulusWeights;
pub use interpolate::{Extrapolation, InterpolateError, Interpolation};
pub use irregular::{IrregularSpectrum, IrregularSpectrumError};
pub use lamp::{LampError, lamp_from_bytes};
pub use light::{LightError, light_from_text};
pub use observer::{Observer, ObserverError};
pub use spectrum::{
    Absorption, Power, Quantity, Reflectance, Response, Scattering, Spectrum, SpectrumError,
};
pub use viewing::{Viewing, ViewingError};
pub use wavelength::{Wavelength, WavelengthError};
