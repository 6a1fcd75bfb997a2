//! Opens a cube of any kind. We find the kind by content.
//!
//! This includes folders of Specim cameras (capture/ with the counts and their readings, results/
//! with reflectance) and spectral OpenEXR files, as we export paintings.
//!
//! OpenEXR follows A. Fichet, R. Pacanowski and A. Wilkie, "An OpenEXR Layout for Spectral Images"
//! (Journal of Computer Graphics Techniques 10(3), 2021): each wavelength has a channel such as
//! `T.550,000000nm`.

use std::collections::BTreeMap;
use std::fs::File;
use std::io::{BufReader, Read};
use std::path::{Path, PathBuf};

use documents::file::check_expansion;
use documents::foreign_message;
use exr::block::chunk::TileCoordinates;
use exr::block::lines::LineRef;
use exr::block::reader::ChunksReader;
use exr::block::{BlockIndex, UncompressedBlock};
use exr::meta::MetaData;
use exr::meta::attribute::SampleType;
use exr::meta::header::Header;
use half::f16;
use pigment::Remark;

use super::error::{CubeError, refuse_other_kinds};
use super::gdal::GdalMetadata;
use super::listed::{OwnReadings, readings};
use super::options::CubeOptions;
use super::raw_file::{FileStamp, Interleave};
use super::scan::Cube;
use super::side_files::{Spool, wavelengths_of};
use super::window::{Opened, Values};
use super::{envi, stack, zarr_cube};
use crate::numbers::NumberType;

impl Cube {
    /// Opens the cube at `path`: a header or data of ENVI, a folder of a Specim camera, a Zarr
    /// array or group, a spectral EXR file, a multi-page TIFF file, or a folder of pictures with
    /// their wavelengths. We find the kind by content.
    pub fn open(path: impl AsRef<Path>) -> Result<Self, CubeError> {
        Self::open_with(path, &CubeOptions::default())
    }

    /// Opens the cube at `path` with settings.
    pub fn open_with(path: impl AsRef<Path>, options: &CubeOptions) -> Result<Self, CubeError> {
        let path = path.as_ref();
        options.check(path)?;
        let stamp = stamp_of(path)?;
        let (scan, own) = match path.is_dir() && !zarr_cube::is_zarr(path) && is_specim(path) {
            true => {
                let found = specim_scan(path)?;
                let mut scan = open_scan(&found.scan, options)?;
                scan.remarks.insert(0, Remark::note(&found.remark));
                (scan, Some(found))
            }
            false => (open_scan(path, options)?, None),
        };
        let own = own.map(OwnReadings::from);
        let readings = readings(&scan, own.as_ref(), options, &|path| open_kind(path, options))?;
        let mut cube = Self::of(scan, readings.as_ref(), options)?;
        cube.stamp = stamp;
        Ok(cube)
    }
}

/// The file at `path`, or the metadata of the Zarr array or group there, as they are now. Other folders hold headers,
/// which have stamps of their own.
fn stamp_of(path: &Path) -> Result<Option<FileStamp>, CubeError> {
    let metadata = ["zarr.json", ".zarray", ".zgroup"].map(|name| path.join(name));
    let named = std::iter::once(path.to_owned()).chain(metadata).find(|place| place.is_file());
    named.map(|place| FileStamp::of(&place)).transpose()
}

/// Opens the scan at `path`, whatever its kind.
fn open_scan(path: &Path, options: &CubeOptions) -> Result<Opened, CubeError> {
    let mut scan = open_kind(path, options)?;
    if scan.wavelengths_nm.is_none() && options.wavelengths.is_none() {
        add_gdal_wavelengths(path, &mut scan)?;
    }
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

/// Takes wavelengths from the metadata that GDAL wrote beside a header or data of ENVI that names none.
fn add_gdal_wavelengths(path: &Path, scan: &mut Opened) -> Result<(), CubeError> {
    let places = envi::places(&scan.path).into_iter().chain([scan.path.clone(), path.to_owned()]);
    for place in places.filter(|place| place.is_file()) {
        let Some((file, metadata)) = GdalMetadata::beside(&place)? else { continue };
        let found = metadata.wavelengths(scan.bands).map_err(|problem| {
            let way_out = "give a file of wavelengths with [wavelengths=FILE]";
            CubeError::format(&file, format!("the metadata of GDAL {problem}"), way_out)
        })?;
        if let Some(found) = found {
            scan.remarks
                .push(Remark::note(format!("wavelengths are read from {}", file.display())));
            scan.remarks.extend(found.remark.map(Remark::note));
            scan.wavelengths_nm = Some(found.nm);
            return Ok(());
        }
    }
    Ok(())
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
    if is_exr(&start) {
        return open_exr(path, options);
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
        "is not a cube that can be read, and no header is beside it",
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

impl From<SpecimScan> for OwnReadings {
    fn from(scan: SpecimScan) -> Self {
        Self { white: scan.white, dark: scan.dark, white_dark: scan.white_dark }
    }
}

/// The files of a camera's folder.
#[derive(Debug, PartialEq, Eq)]
pub(crate) struct SpecimScan {
    pub(crate) scan: PathBuf,
    /// Header of the white reading, if the scan holds counts.
    pub(crate) white: Option<PathBuf>,
    /// Header of the dark reading of the scan, if the scan holds counts.
    pub(crate) dark: Option<PathBuf>,
    /// Header of the dark reading of the white, if the camera took one.
    pub(crate) white_dark: Option<PathBuf>,
    /// Remark that tells the user which scan we chose.
    pub(crate) remark: String,
}

/// Prefixes of the names of readings, in upper case: dark of the white, white, dark of the scan.
const READINGS: [&str; 3] = ["WHITEDARKREF_", "WHITEREF_", "DARKREF_"];
/// Prefix of the name of a scan that holds reflectances, in upper case.
const REFLECTANCE: &str = "REFLECTANCE_";

fn is_specim(folder: &Path) -> bool {
    ["capture", "results"].iter().any(|name| folder.join(name).is_dir())
        || headers(folder).iter().any(|(name, _)| {
            READINGS.iter().any(|start| name.starts_with(start)) || name.starts_with(REFLECTANCE)
        })
}

/// Headers in a folder with their names in upper case, in the order of names.
fn headers(folder: &Path) -> Vec<(String, PathBuf)> {
    let Ok(entries) = std::fs::read_dir(folder) else { return Vec::new() };
    let paths = entries.filter_map(Result::ok).map(|entry| entry.path());
    let mut found: Vec<_> = paths
        .filter(|path: &PathBuf| {
            path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("hdr"))
                && path.is_file()
        })
        .filter_map(|path: PathBuf| {
            let name = path.file_stem()?.to_str()?.to_uppercase();
            Some((name, path))
        })
        .collect();
    found.sort();
    found
}

/// Finds the scan of a camera's folder: its reflectance, or else its counts with white and dark.
fn specim_scan(folder: &Path) -> Result<SpecimScan, CubeError> {
    let [results, captured] = ["results", "capture"].map(|name| {
        let inner = folder.join(name);
        headers(if inner.is_dir() { &inner } else { folder })
    });
    let computed: Vec<_> =
        results.iter().filter(|(name, _)| name.starts_with(REFLECTANCE)).collect();
    if let [(_, scan)] = computed[..] {
        let remark = format!("the camera's reflectance is read: {}", scan.display());
        let scan = scan.clone();
        return Ok(SpecimScan { scan, white: None, dark: None, white_dark: None, remark });
    }
    let scans: Vec<_> = captured.iter().filter(|(name, _)| is_scan(name)).collect();
    let [(name, scan)] = scans[..] else {
        let problem = match computed.len().max(scans.len()) {
            0 => "has no header of a scan in capture/ or results/".to_owned(),
            several => format!("has {several} scans"),
        };
        return Err(CubeError::format(folder, problem, "name the .hdr file of one scan"));
    };
    let [white_dark, white, dark] = READINGS.map(|start: &str| {
        let wanted = format!("{start}{name}");
        captured.iter().find(|(name, _)| *name == wanted).map(|(_, path)| path.clone())
    });
    let remark = format!("counts are read with the camera's white and dark: {}", scan.display());
    Ok(SpecimScan { scan: scan.clone(), white, dark, white_dark, remark })
}

fn is_scan(name: &str) -> bool {
    !READINGS.iter().any(|start| name.starts_with(start)) && !name.starts_with(REFLECTANCE)
}

fn is_exr(start: &[u8]) -> bool {
    start.starts_with(&[0x76, 0x2f, 0x31, 0x01])
}

/// Wavelength in nm of a channel of reflectance, e.g. `T.550,5nm`.
fn channel_nm(name: &str) -> Option<f64> {
    nm_of(name.strip_prefix("T.")?)
}

/// Whether a channel holds light that comes back at another wavelength than it fell in, e.g.
/// `T.400,0nm.450,0nm` (Fichet et al. 2021, section 3.4: a bispectral reradiation).
fn is_fluorescence(name: &str) -> bool {
    let pair = name.strip_prefix("T.").and_then(|pair| {
        let unit = pair.find("m.")? + 1;
        Some((nm_of(&pair[..unit])?, nm_of(&pair[unit + 1..])?))
    });
    pair.is_some()
}

/// A remark on channels of fluorescence, which a map leaves out.
fn fluorescence_remark(meta: &MetaData) -> Option<Remark> {
    let channels = meta.headers.iter().flat_map(|header| &header.channels.list);
    let names: Vec<String> = channels.map(|channel| channel.name.to_string()).collect();
    let of: Vec<&String> = names.iter().filter(|name| is_fluorescence(name)).collect();
    let first = of.first()?;
    let count = documents::counted(of.len(), "channel");
    Some(Remark::warning(format!(
        "fluorescence is left out ({count}, such as {first}): we read only light that comes back at its own wavelength"
    )))
}

/// A wavelength with its unit in nm, e.g. `550,5nm`.
fn nm_of(number: &str) -> Option<f64> {
    let (number, factor) = match number.strip_suffix("nm") {
        Some(number) => (number, 1.0),
        None => (number.strip_suffix("um")?, 1000.0),
    };
    let nm = number.replace(',', ".").parse::<f64>().ok()? * factor;
    (nm.is_finite() && nm > 0.0).then_some(nm)
}

/// Layer and channels of reflectance. Each channel has its index in the layer and its wavelength in
/// nm, and wavelengths rise.
fn channels(meta: &MetaData) -> Option<(usize, Vec<(usize, f64)>)> {
    let layers = meta
        .headers
        .iter()
        .map(|header: &Header| -> Vec<(usize, f64)> {
            let names = header.channels.list.iter().map(|channel| channel.name.to_string());
            let mut found: Vec<_> =
                names.enumerate().filter_map(|(at, name)| Some((at, channel_nm(&name)?))).collect();
            found.sort_by(|a, b| a.1.total_cmp(&b.1));
            found
        })
        .enumerate();
    layers.into_iter().find(|(_, channels)| !channels.is_empty())
}

/// Opens the file and unpacks its channels of reflectance.
fn open_exr(path: &Path, options: &CubeOptions) -> Result<Opened, CubeError> {
    let fault = |error: exr::error::Error| match error {
        exr::error::Error::Io(reason) => CubeError::unpacking(path, reason),
        other => {
            let problem = format!("cannot be unpacked: {}", foreign_message(&other));
            CubeError::data(path, problem, "export it again")
        }
    };
    let file = File::open(path).map_err(|reason| CubeError::reading(path, reason))?;
    let file_bytes = file.metadata().map_err(|reason| CubeError::reading(path, reason))?.len();
    let reader = exr::block::read(BufReader::new(file), false).map_err(fault)?;
    let Some((layer, found)) = channels(reader.meta_data()) else {
        return Err(CubeError::format(
            path,
            "is an OpenEXR file without channels of reflectance such as T.550,000000nm",
            "export the painting with its spectra",
        ));
    };
    let remarks = fluorescence_remark(reader.meta_data());
    if let Some(pair) = found.windows(2).find(|pair| pair[0].1 == pair[1].1) {
        let problem = format!("has two channels at {} nm", pair[0].1);
        return Err(CubeError::format(path, problem, "export each wavelength once"));
    }
    let header = reader.headers()[layer].clone();
    let samples = header.layer_size.0;
    let lines = header.layer_size.1;
    let list = &header.channels.list;
    if found.iter().any(|(channel, _)| list[*channel].sampling.0 * list[*channel].sampling.1 != 1) {
        let problem = "has channels of a lower resolution";
        return Err(CubeError::format(path, problem, "export all channels at one resolution"));
    }
    // A block is unpacked with all its channels, also those that are left out.
    let announced = (samples as u64).saturating_mul(lines as u64).saturating_mul(
        list.iter().map(|channel| channel.sample_type.bytes_per_sample() as u64).sum(),
    );
    check_expansion(announced, file_bytes).map_err(|error| {
        CubeError::data(path, format!("is damaged: {error}"), "export it again")
    })?;
    let places: BTreeMap<usize, usize> =
        found.iter().enumerate().map(|(band, (channel, _))| (*channel, band)).collect();
    let size = (lines, samples, found.len());
    let scratch = options.scratch.as_deref();
    let mut spool = Spool::new(scratch, size, NumberType::F32, Interleave::Bil)?;
    let chunks = reader
        .filter_chunks(false, |_: &MetaData, _: TileCoordinates, block: BlockIndex| {
            block.layer == layer && block.level.0 == 0 && block.level.1 == 0
        })
        .map_err(fault)?;
    let meta = chunks.meta_data().clone();
    for chunk in chunks {
        let block =
            chunk.and_then(|chunk| UncompressedBlock::decompress_chunk(chunk, &meta, false));
        let block = block.map_err(fault)?;
        for line in block.lines(&header.channels) {
            let Some(&band) = places.get(&line.location.channel) else { continue };
            let position = line.location.position;
            let values = bytes_of(line, list[line.location.channel].sample_type);
            spool.write((position.1, position.0, band), &values.map_err(fault)?)?;
        }
    }
    Ok(Opened {
        path: path.to_owned(),
        lines,
        samples,
        bands: found.len(),
        wavelengths_nm: Some(found.iter().map(|(_, nm)| *nm).collect()),
        fwhm_nm: None,
        good: vec![true; found.len()],
        ignore: None,
        // The layout says that these channels are reflectances.
        values: Values::Divided(1.0),
        told: Vec::new(),
        integration_time: None,
        remarks: remarks.into_iter().collect(),
        source: Box::new(spool.finish(path)?),
    })
}

/// Converts the values of a line to bytes of f32.
fn bytes_of(line: LineRef<'_>, kind: SampleType) -> exr::error::Result<Vec<u8>> {
    match kind {
        SampleType::F32 => collect::<f32>(line, |value| value),
        SampleType::F16 => collect::<f16>(line, f16::to_f32),
        SampleType::U32 => collect::<u32>(line, |value| value as f32),
    }
}

fn collect<T: exr::io::Data>(
    line: LineRef<'_>,
    number: impl Fn(T) -> f32,
) -> exr::error::Result<Vec<u8>> {
    let mut bytes = Vec::with_capacity(line.location.sample_count * size_of::<f32>());
    for value in line.read_samples::<T>() {
        bytes.extend(number(value?).to_ne_bytes());
    }
    Ok(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn channels_are_read_by_their_published_names() {
        assert_eq!(channel_nm("T.550,000000nm"), Some(550.0));
        assert_eq!(channel_nm("T.412,345679nm"), Some(412.345_679));
        assert_eq!(channel_nm("T.0,55um"), Some(550.0));
        for other in ["R", "S0.550,000000nm", "T.nm", "T.-5nm", "T.550"] {
            assert_eq!(channel_nm(other), None, "{other}");
        }
    }

    #[test]
    fn channels_of_two_wavelengths_are_fluorescence() {
        for name in ["T.400,0nm.450,0nm", "T.400,000000nm.420,000000nm", "T.0,4um.0,5um"] {
            assert!(is_fluorescence(name) && channel_nm(name).is_none(), "{name}");
        }
        for name in ["T.400,0nm", "T.nm.450nm", "S0.400,0nm", "T.m.", "T.400,0nm.blue"] {
            assert!(!is_fluorescence(name), "{name}");
        }
    }
}
