//! Recognises files that are no cubes by their first bytes.

use std::path::Path;

use super::error::CubeError;

/// Kinds that other programs read, by their first bytes.
const OTHERS: [(&[u8], &str, &str); 5] = [
    (
        b"\x89HDF\r\n",
        "an HDF5 file (or MATLAB 7.3, NeXus)",
        "open it in Python with h5py and save it as Zarr with xarray, or export ENVI",
    ),
    (b"CDF", "a NetCDF file", "open it in Python with xarray and save it as Zarr"),
    (
        b"MATLAB 5.0",
        "a MATLAB file",
        "open it in Python with scipy.io and save it as Zarr with xarray, or export ENVI",
    ),
    (
        b"\x89PNG",
        "one picture, which is no cube",
        "name the folder that holds a picture for each wavelength",
    ),
    (
        b"\xff\xd8\xff",
        "a JPEG picture, which is no cube",
        "name the folder that holds a picture for each wavelength",
    ),
];

/// Refuses a file that begins with `start` where another program reads it.
pub(crate) fn refuse_other_kinds(path: &Path, start: &[u8]) -> Result<(), CubeError> {
    match OTHERS.iter().find(|(magic, ..)| start.starts_with(magic)) {
        None => Ok(()),
        Some((_, kind, way_out)) => Err(CubeError::format(path, format!("is {kind}"), *way_out)),
    }
}
