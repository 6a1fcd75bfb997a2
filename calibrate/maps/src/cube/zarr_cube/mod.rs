//! Cubes in Zarr arrays, as xarray writes them: (y, x, wavelength) in any order, with the wavelengths
//! as a coordinate.

mod source;
mod scan;

pub(crate) use scan::{is_zarr, open};
