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
//! | named colours of any file | [`color_book`] |
//!
//! In scope: wavelengths and grids, typed spectra and their resampling, the CIE observers
//! and illuminants, colour and colour difference, and the optics of a paint film. Out of
//! scope: fitting (see the crate `calibrate`), painting, gloss and fluorescence, which a
//! reflectance factor does not separate.
//!
//! Modules are ordered by dependence: each uses only modules declared above it.
mod grid;
mod wavelength_list;
mod interpolate;
mod spectrum;
pub mod csv_table;
pub mod headings;
pub mod instrument;
pub mod referencing;
mod illuminant;
mod light;
pub mod color;
mod viewing;
mod color_temperature;
mod color_rendering;
pub mod swatch_file;
pub mod color_book;
pub mod optics;

pub use color_rendering::{ColorFidelity, ColorRendering, ColorRenderingError, RenderingIndex};
pub use color_temperature::ColorTemperature;
pub use grid::{Grid, GridError, Wavelength, WavelengthError};
pub use illuminant::{Illuminant, IlluminantError, MeasuredLamp, Observer, ObserverError};
pub use instrument::{open as read_spectra, open_spectrum as read_spectrum};
pub use interpolate::{Extrapolation, InterpolateError, Interpolation};
pub use light::{
    LampError, LightError, SECOND_RADIATION_CONSTANT, black_body, daylight, daylight_chromaticity,
    lamp_from_bytes, lamp_from_bytes_with, light_from_text, light_from_text_with,
};
pub use spectrum::{
    Absorption, IrregularSpectrum, IrregularSpectrumError, Power, Quantity, Reflectance, Response,
    Scattering, Spectrum, SpectrumError,
};
pub use viewing::{TristimulusWeights, Viewing, ViewingError, ViewingNames};
pub use wavelength_list::{WavelengthList, WavelengthListError};
