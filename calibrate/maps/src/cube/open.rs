//! Opens a cube of any kind by its content.

use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};

use super::envi;
use super::error::CubeError;
use super::kinds::refuse_other_kinds;
use super::opened::Opened;
use super::options::CubeOptions;
use super::reading_files::{OwnReadings, readings};
use super::scan::Cube;
use super::specim;
use super::spectral_exr;
use super::stack;
use super::wavelength_file::wavelengths_of;
use super::zarr_cube;

impl Cube {
    /// Opens the cube at `path`: a header or data of ENVI, a folder of a Specim camera, a Zarr
    /// array or group, a spectral EXR file, a multi-page TIFF file, or a folder of pictures with
    /// their wavelengths. The kind is found by content.
    ///
    /// # Errors
    /// [`CubeError`] with file, place and advice.
    pub fn open(path: impl AsRef<Path>) -> Result<Self, CubeError> {
        Self::open_with(path, &CubeOptions::default())
    }

    /// Opens the cube at `path` with settings.
    ///
    /// # Errors
    /// [`CubeError`] with file, place and advice.
    pub fn open_with(path: impl AsRef<Path>, options: &CubeOptions) -> Result<Self, CubeError> {
        let path = path.as_ref();
        options.check(path)?;
        let (scan, own) =
            match path.is_dir() && !zarr_cube::is_zarr(path) && specim::is_specim(path) {
                true => {
                    let found = specim::find(path)?;
                    let mut scan = open_scan(&found.scan, options)?;
                    scan.remarks.insert(0, found.remark.clone());
                    (scan, Some(found))
                }
                false => (open_scan(path, options)?, None),
            };
        let own = own.map(OwnReadings::from);
        let open = |path: &Path| open_kind(path, options);
        let readings = readings(&scan, own.as_ref(), options, &open)?;
        Self::of(scan, readings.as_ref(), options)
    }
}

/// Opens the scan at `path`, whatever its kind.
fn open_scan(path: &Path, options: &CubeOptions) -> Result<Opened, CubeError> {
    let mut scan = open_kind(path, options)?;
    if let Some(file) = &options.wavelengths {
        let nm = wavelengths_of(file)?;
        if nm.len() != scan.bands {
            let problem = format!("has {} wavelengths, the cube {} bands", nm.len(), scan.bands);
            return Err(CubeError::format(file, problem, "give one wavelength a band"));
        }
        scan.wavelengths_nm = Some(nm);
    }
    Ok(scan)
}

fn open_kind(path: &Path, options: &CubeOptions) -> Result<Opened, CubeError> {
    if path.is_dir() {
        return open_folder(path, options);
    }
    let file = File::open(path).map_err(|reason| CubeError::reading(path, reason))?;
    let mut start = Vec::new();
    file.take(4096).read_to_end(&mut start).map_err(|reason| CubeError::reading(path, reason))?;
    let is_header = path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("hdr"));
    if envi::is_header(&start) || is_header {
        return envi::open(path);
    }
    if path.file_name().is_some_and(|name| name == "zarr.json") {
        return zarr_cube::open(path.parent().unwrap_or(path), options);
    }
    if spectral_exr::is_exr(&start) {
        return spectral_exr::open(path, options);
    }
    // The data of a header may begin with any bytes, so the header decides first.
    if let Some(header) = envi::header_of(path) {
        return envi::open(&header);
    }
    if stack::is_tiff(&start) {
        return stack::open_pages(path, options);
    }
    refuse_other_kinds(path, &start)?;
    Err(CubeError::format(
        path,
        "is no cube that can be read, and no header is beside it",
        format!(
            "for plain numbers put an ENVI header beside it, as {}",
            path.with_extension("hdr").display()
        ),
    ))
}

fn open_folder(path: &Path, options: &CubeOptions) -> Result<Opened, CubeError> {
    if zarr_cube::is_zarr(path) {
        return zarr_cube::open(path, options);
    }
    if [".zarray", ".zgroup"].iter().any(|name| path.join(name).is_file()) {
        let way_out = "copy it in Python: xarray.open_zarr(\"OLD\").drop_encoding().to_zarr(\"NEW\", zarr_format=3)";
        return Err(CubeError::format(path, "is Zarr of format 2", way_out));
    }
    if stack::is_stack(path, options) {
        return stack::open_folder(path, options);
    }
    let headers: Vec<PathBuf> = stack::files_ending_in(path, &["hdr"]);
    match &headers[..] {
        [header] => envi::open(header),
        [] => Err(CubeError::format(
            path,
            "holds no cube: no header of ENVI, no zarr.json, no pictures with wavelengths",
            "for pictures of single wavelengths add a file wavelengths.txt: one wavelength in nm a picture, in the order of their names",
        )),
        several => {
            let problem = format!("holds {} headers of ENVI", several.len());
            Err(CubeError::format(path, problem, "name the .hdr file of one scan"))
        }
    }
}

impl From<specim::SpecimScan> for OwnReadings {
    fn from(scan: specim::SpecimScan) -> Self {
        Self { white: scan.white, dark: scan.dark, white_dark: scan.white_dark }
    }
}
