//! Readings of swatches from dropped files.

use calibrate::measurement::{Film, Scale, ScaleChoice};
use calibrate::{ReadingFormat, ReadingOptions, ReadingsError};
use js_sys::{Array, JsString, Uint8Array};
use serde::Deserialize;
use serde_json::json;
use spectra::WavelengthList;
use spectra::instrument::StatedValues;
use wasm_bindgen::prelude::*;

use crate::counts::{GivenFiles, References};
use crate::failure::{Result, Told, request, setting};
use crate::remarks::remarks;

/// Options of reading, as the page passes them.
#[derive(Debug, Deserialize)]
struct Options {
    format: Option<String>,
    percent: Option<bool>,
    transmittance: bool,
    pigments: Option<Vec<String>>,
    /// Name of the quantity of the values.
    values: Option<String>,
    /// `380..730:10`, or a list of wavelengths as text.
    wavelengths: Option<String>,
    references: Option<References>,
}

impl Options {
    fn read(json: &str) -> Result<ReadingOptions> {
        let Self { format, percent, transmittance, pigments, values, wavelengths, references } =
            request(json)?;
        let format = format.map(|name| {
            ReadingFormat::named(&name).ok_or_else(|| {
                let known: Vec<&str> = ReadingFormat::names().collect();
                let hint = format!("formats are {}", known.join(", "));
                setting(&format!("unknown format `{name}`"), &hint)
            })
        });
        let values = values.map(|name| {
            StatedValues::named(&name).ok_or_else(|| {
                let known = StatedValues::ALL.map(StatedValues::name).join(", ");
                setting(&format!("unknown quantity `{name}`"), &format!("quantities are {known}"))
            })
        });
        let wavelengths = wavelengths.map(|text| match WavelengthList::of_range(&text) {
            Ok(None) => WavelengthList::from_text("wavelengths", &text),
            Ok(Some(list)) => Ok(list),
            Err(error) => Err(error),
        });
        Ok(ReadingOptions {
            format: format.transpose()?,
            scale: match percent {
                None => ScaleChoice::ByFile,
                Some(true) => ScaleChoice::Known(Scale::Percent),
                Some(false) => ScaleChoice::Known(Scale::Fraction),
            },
            pigments,
            transmittance_is_reflectance: transmittance,
            values: values.transpose()?,
            wavelengths_nm: wavelengths.transpose().told()?.map(|list| list.nm),
            references: references.map(References::files),
        })
    }
}

/// Readings of one or more files.
#[wasm_bindgen]
#[derive(Debug)]
pub struct Readings(pub(crate) calibrate::Readings);

#[wasm_bindgen]
impl Readings {
    /// Reads files by their names and contents, and a CSV of recipes if these are in a separate
    /// file. If the readings are raw counts, pass the files of their references as `given`.
    #[wasm_bindgen(constructor)]
    pub fn open(
        names: &Array<JsString>,
        contents: &Array<Uint8Array>,
        recipes_name: Option<String>,
        recipes: Option<Vec<u8>>,
        given_names: &Array<JsString>,
        given_contents: &Array<Uint8Array>,
        options: &str,
    ) -> Result<Readings> {
        let given = files(given_names, given_contents);
        let (mut readings, options) = with_references(given, options, |options| {
            calibrate::Readings::from_files(&files(names, contents), options)
        })?;
        if let Some((name, bytes)) = recipes_name.zip(recipes) {
            let pigments = options.pigments.as_deref();
            readings = readings.with_recipes_from(&name, &bytes, pigments).told()?;
        }
        let named = options.pigments.as_deref().unwrap_or_default();
        readings.check_has_pigments(named).told()?;
        Ok(Self(readings))
    }

    /// Reads only the spectra of files, with films, backings and thicknesses, not their recipes.
    pub fn spectra(
        names: &Array<JsString>,
        contents: &Array<Uint8Array>,
        given_names: &Array<JsString>,
        given_contents: &Array<Uint8Array>,
        options: &str,
    ) -> Result<Readings> {
        let given = files(given_names, given_contents);
        let (readings, _) = with_references(given, options, |options| {
            calibrate::Readings::spectra_from_files(&files(names, contents), options)
        })?;
        Ok(Self(readings))
    }

    /// The readings as JSON: pigments, grid, number of readings and of samples, files, remarks.
    pub fn about(&self) -> String {
        let table = &self.0.table;
        let paint = table.readings.iter().filter(|reading| reading.film == Film::Paint);
        let mut samples: Vec<&str> = paint.map(|reading| reading.sample.as_str()).collect();
        samples.sort_unstable();
        samples.dedup();
        json!({
            "pigments": table.pigments,
            "grid": table.grid.to_string(),
            "readings": table.readings.len(),
            "samples": samples,
            "inputs": self.0.inputs,
            "remarks": remarks(&self.0.remarks),
        })
        .to_string()
    }
}

/// Names of all formats, as JSON: for a list of choices.
#[wasm_bindgen]
pub fn formats() -> String {
    json!(ReadingFormat::names().collect::<Vec<_>>()).to_string()
}

/// Reads with `options`, while the files of references that these name lie on the disk of the page.
fn with_references(
    references: Vec<(String, Vec<u8>)>,
    options: &str,
    read: impl FnOnce(&ReadingOptions) -> std::result::Result<calibrate::Readings, ReadingsError>,
) -> Result<(calibrate::Readings, ReadingOptions)> {
    let options = Options::read(options)?;
    let given = GivenFiles::put(references)?;
    let readings = read(&options);
    drop(given);
    Ok((readings.told()?, options))
}

/// Names and contents of files.
fn files(names: &Array<JsString>, contents: &Array<Uint8Array>) -> Vec<(String, Vec<u8>)> {
    let names = names.iter().map(String::from);
    names.zip(contents.iter().map(|bytes| bytes.to_vec())).collect()
}
