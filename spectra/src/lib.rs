//! Quantities over wavelength, colour, and Kubelka-Munk optics.
//!
//! In scope: wavelengths and grids, typed spectra and their resampling, the
//! CIE observers and illuminants, colour and colour difference, and the optics
//! of a paint film. Out of scope: fitting anything (see `calibrate`), painting,
//! and gloss or fluorescence, which a reflectance factor cannot tell apart.
//!
//! Files stand in an order of dependence; each uses only what stands above it.

pub mod hint;

pub mod file;

mod wavelength;

mod grid;

mod interpolate;

mod spectrum;

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

pub mod swatch_file;

pub mod optics;

pub use black_body::{SECOND_RADIATION_CONSTANT, black_body};
pub use color_temperature::ColorTemperature;
pub use daylight::{daylight, daylight_chromaticity};
pub use grid::{Grid, GridError};
pub use illuminant::{Illuminant, IlluminantError};
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
