//! Cubes in Zarr arrays, e.g. from xarray. The axes are (y, x, wavelength) in any order, with the
//! wavelengths as a coordinate.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use pigment::Remark;
use rayon::prelude::*;
use serde_json::Value;

use super::raw_file::FileStamp;
use crate::cube::error::CubeError;
use crate::cube::options::CubeOptions;
use crate::cube::window::{Conversion, Opened, Pixels, Source, Values, Window};
use crate::zarr::{ChunkError, ZarrArray, ZarrFault};

/// Names of the axis of the bands, in lower case.
const BAND_AXES: [&str; 6] = ["wavelength", "wavelengths", "wl", "lambda", "band", "bands"];
const ROW_AXES: [&str; 5] = ["y", "row", "rows", "line", "lines"];

/// We accept at most this many bands, and at most [`MOST_ROW`] numbers in a row, because we hold a
/// row in memory. So a description alone cannot take much memory.
const MOST_BANDS: usize = 65_536;
const MOST_ROW: usize = 1 << 28;

fn fault_at(path: &Path) -> impl Fn(ZarrFault) -> CubeError {
    |fault| CubeError::format(path, fault.problem, fault.way_out)
}

/// Whether `folder` is an array or group of Zarr, format 3.
pub(crate) fn is_zarr(folder: &Path) -> bool {
    folder.join("zarr.json").is_file()
}

fn document(folder: &Path) -> Result<Value, CubeError> {
    let path = folder.join("zarr.json");
    let bytes = documents::file::read(&path)?;
    serde_json::from_slice(&bytes).map_err(|error| {
        CubeError::data(&path, format!("is not JSON: {error}"), "copy or write the array again")
    })
}

/// Arrays of three axes in a group, with their names.
fn arrays(group: &Path) -> Result<BTreeMap<String, (PathBuf, Value)>, CubeError> {
    let entries = std::fs::read_dir(group).map_err(|reason| CubeError::reading(group, reason))?;
    let mut found = BTreeMap::new();
    for entry in entries.filter_map(Result::ok).map(|entry| entry.path()) {
        if !is_zarr(&entry) {
            continue;
        }
        let about = document(&entry)?;
        let axes = about["shape"].as_array().map_or(0, Vec::len);
        if about["node_type"] == "array" && axes == 3 {
            let name = entry.file_name().unwrap_or_default().to_string_lossy().into_owned();
            found.insert(name, (entry, about));
        }
    }
    Ok(found)
}

fn names(arrays: &BTreeMap<String, (PathBuf, Value)>) -> String {
    const MOST: usize = 6;
    let names: Vec<&String> = arrays.keys().collect();
    documents::name_list(&names, MOST, ", ")
}

fn chosen(folder: &Path, options: &CubeOptions) -> Result<(PathBuf, Value), CubeError> {
    let about = document(folder)?;
    if about["node_type"] == "array" {
        return Ok((folder.to_owned(), about));
    }
    let mut found = arrays(folder)?;
    if let Some(name) = &options.variable {
        return found.remove(name).ok_or_else(|| {
            let names = names(&found);
            let problem = format!("has no array `{name}` of three axes, only {names}");
            CubeError::format(folder, problem, "name one of them with [variable]")
        });
    }
    match found.len() {
        1 => Ok(found.into_values().next().unwrap_or_default()),
        0 => Err(CubeError::format(
            folder,
            "holds no array of three axes",
            "save the cube with the dimensions y, x and wavelength",
        )),
        _ => {
            let problem = format!("holds several cubes: {}", names(&found));
            Err(CubeError::format(folder, problem, "name one of them with [variable=NAME]"))
        }
    }
}

/// Indices of the axes of rows, columns and bands.
fn axes(array: &ZarrArray) -> Result<[usize; 3], CubeError> {
    let names: Vec<String> =
        array.about.dimensions.iter().map(|name| name.to_lowercase()).collect();
    let [band, row] = [&BAND_AXES[..], &ROW_AXES]
        .map(|wanted| names.iter().position(|name| wanted.contains(&name.as_str())));
    let (Some(band), 3, 3) = (band, array.about.shape.len(), names.len()) else {
        return Err(CubeError::format(
            &array.folder,
            format!(
                "has the shape {:?} with the dimensions {names:?}, expected y, x and wavelength",
                array.about.shape
            ),
            "name the dimensions y, x and wavelength",
        ));
    };
    let mut others = (0..3).filter(|axis| *axis != band);
    let first = others.next().unwrap_or(0);
    let second = others.next().unwrap_or(1);
    Ok(match row {
        Some(row) if row == second => [second, first, band],
        _ => [first, second, band],
    })
}

/// Refuses a cube of a size that no camera makes.
fn check_size(array: &ZarrArray, [lines, samples, bands]: [usize; 3]) -> Result<(), CubeError> {
    let row = samples.checked_mul(bands);
    if bands <= MOST_BANDS && row.is_some_and(|row| row <= MOST_ROW) && lines <= u32::MAX as usize {
        return Ok(());
    }
    let problem = format!(
        "has {lines} rows of {samples} pixels of {bands} bands, expected at most {MOST_BANDS} bands and {MOST_ROW} numbers in a row"
    );
    Err(CubeError::format(&array.folder, problem, "save the scan in parts of fewer columns"))
}

/// Reads all numbers of an array with one axis. It must have `bands` numbers.
fn coordinate(folder: &Path, bands: usize) -> Result<(Vec<f64>, Option<String>), CubeError> {
    let array = ZarrArray::new(folder, &document(folder)?).map_err(fault_at(folder))?;
    let about = &array.about;
    let [length] = about.shape[..] else {
        let problem = format!("has {} axes, expected one", about.shape.len());
        return Err(CubeError::format(folder, problem, "save wavelengths as a coordinate"));
    };
    if length != bands {
        let problem = format!("has {length} wavelengths, the cube {bands} bands");
        return Err(CubeError::format(folder, problem, "save one wavelength a band"));
    }
    let mut values = Vec::new();
    for at in 0..length.div_ceil(about.chunk[0]) {
        match array.chunk(&[at]).map_err(chunk_error)? {
            Some(bytes) => {
                values.extend(about.number_type.convert_exactly(about.chain.byte_order, &bytes));
            }
            None => values.extend(vec![about.fill; about.chunk[0].min(length)]),
        }
    }
    values.truncate(length);
    let unit = about.attributes.get("units").and_then(Value::as_str).map(str::to_owned);
    Ok((values, unit))
}

/// Reads the number of an attribute, also in base 64, because xarray writes fill values so.
fn attribute(array: &ZarrArray, name: &str) -> Option<f64> {
    match array.about.attributes.get(name)? {
        Value::Number(number) => number.as_f64(),
        Value::String(text) => text.parse().ok().or_else(|| from_base_64(text)),
        _ => None,
    }
}

/// Decodes a little-endian 64-bit float from base 64.
fn from_base_64(text: &str) -> Option<f64> {
    const DIGITS: &[u8] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let digits = text.trim_end_matches('=').bytes();
    let mut bits = 0_u128;
    let mut count = 0;
    for digit in digits {
        let value = DIGITS.iter().position(|known| *known == digit)?;
        bits = bits << 6 | value as u128;
        count += 1;
    }
    // Eleven digits hold 66 bits, the last two of which are empty.
    (count == 11).then(|| f64::from_le_bytes(((bits >> 2) as u64).to_be_bytes()))
}

/// Opens the array, or the only cube of a group.
pub(crate) fn open(folder: &Path, options: &CubeOptions) -> Result<Opened, CubeError> {
    let (place, about) = chosen(folder, options)?;
    let array = ZarrArray::new(&place, &about).map_err(fault_at(&place))?;
    let axes = axes(&array)?;
    let [lines, samples, bands] = axes.map(|axis| array.about.shape[axis]);
    check_size(&array, [lines, samples, bands])?;
    let mut remarks = Vec::new();
    let name = &array.about.dimensions[axes[2]];
    let beside = place.parent().unwrap_or(&place).join(name);
    let mut nm = None;
    if is_zarr(&beside) && options.wavelengths.is_none() {
        let (values, unit) = coordinate(&beside, bands)?;
        let found = spectra::WavelengthList::of(&values, unit.as_deref()).map_err(|problem| {
            let way_out = "save wavelengths in nm, with the attribute units = nm";
            CubeError::format(&beside, format!("the coordinate {problem}"), way_out)
        })?;
        remarks.extend(found.remark.map(Remark::note));
        nm = Some(found.nm);
    }
    let number_type = array.about.number_type;
    let scale = attribute(&array, "scale_factor");
    let offset = attribute(&array, "add_offset");
    let values = match (scale, offset) {
        (None, None) => Values::Unknown { are_whole: number_type.is_whole() },
        (scale, offset) => {
            Values::Gains(vec![(scale.unwrap_or(1.0), offset.unwrap_or(0.0)); bands])
        }
    };
    let told = ["long_name", "standard_name", "units"].into_iter().filter_map(|key| {
        let text = array.about.attributes.get(key)?.as_str()?;
        Some((key.to_owned(), text.to_owned()))
    });
    let told = told.collect();
    Ok(Opened {
        path: place,
        lines,
        samples,
        bands,
        wavelengths_nm: nm,
        fwhm_nm: None,
        good: vec![true; bands],
        ignore: attribute(&array, "_FillValue").or_else(|| attribute(&array, "missing_value")),
        values,
        told,
        integration_time: None,
        remarks,
        source: Box::new(ZarrSource::new(array, axes)?),
    })
}

fn chunk_error(error: ChunkError) -> CubeError {
    match error {
        ChunkError::Io(path, reason) => CubeError::reading(&path, reason),
        ChunkError::Fault(path, fault) => CubeError::data(&path, fault.problem, fault.way_out),
    }
}

/// Reads the chunks of an array as raw values.
#[derive(Debug)]
struct ZarrSource {
    array: ZarrArray,
    strides: Vec<usize>,
    /// Indices of the axes of rows, columns and bands in the array.
    axes: [usize; 3],
    /// A chunk that was removed would be read as one that holds only the fill value.
    stamp: FileStamp,
}

impl ZarrSource {
    fn new(array: ZarrArray, axes: [usize; 3]) -> Result<Self, CubeError> {
        let stamp = FileStamp::of(&array.folder)?;
        Ok(Self { strides: array.strides(), array, axes, stamp })
    }

    /// Reads rows that all lie in one row of chunks.
    fn read_part(
        &self,
        window: &Window,
        bands: &[usize],
        conversion: &Conversion,
        pixels: Pixels<'_>,
    ) -> Result<(), CubeError> {
        let about = &self.array.about;
        let [down, across, deep] = self.axes.map(|axis| about.chunk[axis]);
        let row = window.rows.start / down;
        let columns = window.columns.start / across..=(window.columns.end - 1) / across;
        let mut depths: Vec<usize> = bands.iter().map(|band| band / deep).collect();
        depths.sort_unstable();
        depths.dedup();
        let places: Vec<(usize, usize)> =
            columns.flat_map(|column| depths.iter().map(move |&depth| (column, depth))).collect();
        let chunks: BTreeMap<_, Option<Vec<f32>>> = places
            .par_iter()
            .map(|&(column, depth): &(usize, usize)| {
                let mut at = [0; 3];
                for (axis, number) in self.axes.into_iter().zip([row, column, depth]) {
                    at[axis] = number;
                }
                let chunk = self.array.chunk(&at).map_err(chunk_error)?;
                let numbers = chunk.map(|bytes| {
                    let mut numbers = vec![0.0; bytes.len() / about.number_type.bytes()];
                    about.number_type.convert(about.chain.byte_order, &bytes, &mut numbers, 1);
                    numbers
                });
                Ok(((column, depth), numbers))
            })
            .collect::<Result<_, CubeError>>()?;
        let [by_row, by_column, by_band] = self.axes.map(|axis| self.strides[axis]);
        pixels.rows(window, bands.len()).for_each(|(line, filled)| {
            let pixels = filled.values.chunks_exact_mut(bands.len()).zip(window.columns.clone());
            for (pixel, column) in pixels {
                for (value, &band) in pixel.iter_mut().zip(bands) {
                    let place =
                        line % down * by_row + column % across * by_column + band % deep * by_band;
                    let chunk = chunks.get(&(column / across, band / deep));
                    *value = match chunk {
                        Some(Some(numbers)) => numbers[place],
                        _ => about.fill as f32,
                    };
                }
            }
            conversion.row(window.columns.start, filled.values, filled.mask);
        });
        Ok(())
    }
}

impl Source for ZarrSource {
    fn read(
        &self,
        window: &Window,
        bands: &[usize],
        conversion: &Conversion,
        pixels: Pixels<'_>,
    ) -> Result<(), CubeError> {
        if pixels.values.is_empty() {
            return Ok(());
        }
        let down = self.natural_rows();
        let mut rest = pixels;
        let mut start = window.rows.start;
        while start < window.rows.end {
            let end = ((start / down + 1) * down).min(window.rows.end);
            let (part, more) = rest.split(window, bands.len(), end - start);
            let window = Window { rows: start..end, columns: window.columns.clone() };
            self.read_part(&window, bands, conversion, part)?;
            (rest, start) = (more, end);
        }
        Ok(())
    }

    fn check_unchanged(&self) -> Result<(), CubeError> {
        self.stamp.check()
    }

    fn scratch_bytes(&self, _: usize, columns: usize) -> usize {
        let about = &self.array.about;
        let [down, across, deep] = self.axes.map(|axis| about.chunk[axis]);
        let bands = about.shape[self.axes[2]];
        let numbers = down * (columns + 2 * across) * (bands + deep);
        numbers * (about.number_type.bytes() + size_of::<f32>())
    }

    fn natural_rows(&self) -> usize {
        self.array.about.chunk[self.axes[0]]
    }

    fn full_scale(&self) -> Option<f64> {
        self.array.about.number_type.full_scale()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fill_values_in_base_64_are_read() {
        // Written by xarray 2026.9 for NaN and for -9999.
        assert!(from_base_64("AAAAAAAA+H8=").unwrap().is_nan());
        assert_eq!(from_base_64("AAAAAICHw8A="), Some(-9999.0));
        assert_eq!(from_base_64("nan"), None);
    }
}
