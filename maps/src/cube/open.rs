//! Opens a cube of any kind by its content.

use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};

use super::envi;
use super::error::CubeError;
use super::opened::Opened;
use super::options::{CubeOptions, DarkReading};
use super::readings::{Reading, Readings};
use super::scan::Cube;
use super::specim::{self, SpecimScan};
use super::spectral_exr;
use super::stack;
use super::wavelength_file::wavelengths_of;
use super::zarr_cube;

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
        check(path, options)?;
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
        let readings = readings(&scan, own.as_ref(), options)?;
        Self::of(scan, readings.as_ref(), options)
    }
}

fn check(path: &Path, options: &CubeOptions) -> Result<(), CubeError> {
    let fault = |name: &str, found: f64| {
        let problem = format!("the setting `{name}` must be above 0 and finite, found `{found}`");
        CubeError::format(path, problem, format!("give a number with [{name}]"))
    };
    if !(options.tile > 0.0 && options.tile <= 1.2) {
        let problem = format!(
            "the white's reflectance must be above 0 and at most 1.2, found `{}`",
            options.tile
        );
        return Err(CubeError::format(path, problem, "give a fraction, such as [tile=0.99]"));
    }
    if let super::options::CubeScale::White(white) = options.scale
        && !(white.is_finite() && white > 0.0)
    {
        return Err(fault("scale", white));
    }
    match options.full_scale {
        Some(full) if !(full.is_finite() && full > 0.0) => Err(fault("full_scale", full)),
        _ => Ok(()),
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
    if let Some((_, kind, way_out)) = OTHERS.iter().find(|(magic, ..)| start.starts_with(magic)) {
        return Err(CubeError::format(path, format!("is {kind}"), *way_out));
    }
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

/// White and dark readings of a scan: those of the settings, else those of its folder.
fn readings(
    scan: &Opened,
    own: Option<&SpecimScan>,
    options: &CubeOptions,
) -> Result<Option<Readings>, CubeError> {
    let asked = options.white_reading.as_ref();
    let Some(white) = asked.or_else(|| own.and_then(|own| own.white.as_ref())) else {
        if options.dark_reading != DarkReading::Missing {
            let problem = "a dark reading is given, but no white reading";
            let way_out = "add [white_reading=FILE] of the same settings";
            return Err(CubeError::format(&scan.path, problem, way_out));
        }
        return Ok(None);
    };
    let open = |path: &PathBuf| open_kind(path, options);
    let white_scan = open(white)?;
    let (dark, white_dark) = match (&options.dark_reading, own) {
        (DarkReading::File(dark), _) => (Some(dark), None),
        (DarkReading::Subtracted, _) => (None, None),
        (DarkReading::Missing, Some(own)) if own.dark.is_some() => {
            let white_dark = own.white_dark.as_ref().filter(|_| asked.is_none());
            (own.dark.as_ref(), white_dark)
        }
        (DarkReading::Missing, _) => {
            return Err(CubeError::Reading {
                path: white.clone(),
                role: "white",
                problem: "needs a dark reading".to_owned(),
                way_out: "add [dark_reading=FILE] (the same settings, shutter closed), or [dark_reading=0] if the dark is subtracted already".to_owned(),
            });
        }
    };
    let times = [scan.integration_time, white_scan.integration_time];
    let time_ratio = match times {
        [Some(of_scan), Some(of_white)] if of_scan > 0.0 && of_white > 0.0 => of_scan / of_white,
        _ => 1.0,
    };
    if time_ratio != 1.0 && dark.is_some() && white_dark.is_none() {
        return Err(CubeError::Reading {
            path: white.clone(),
            role: "white",
            problem: format!(
                "was integrated for {} (`tint`), the scan for {}: the dark fits one of them only",
                times[1].unwrap_or(0.0),
                times[0].unwrap_or(0.0)
            ),
            way_out: "take the white at the integration time of the scan: a dark does not scale with time".to_owned(),
        });
    }
    let reading = |path: &PathBuf, role| Reading::of(&open(path)?, scan, role);
    Ok(Some(Readings {
        white: Reading::of(&white_scan, scan, "white")?,
        dark: dark.map(|path| reading(path, "dark")).transpose()?,
        white_dark: white_dark.map(|path| reading(path, "dark")).transpose()?,
        tile: options.tile,
        time_ratio,
    }))
}
