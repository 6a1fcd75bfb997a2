//! Target colours: typed, of swatch files and tables of names, and measured spectra.

use calibrate::ReadingOptions;
use calibrate::matching::{ColorTarget, TargetBook, ViewingCondition};
use calibrate::measurement::Film;
use serde_json::{Value, json};
use spectra::{Reflectance, Spectrum, Viewing};
use wasm_bindgen::prelude::*;

use crate::failure::{Result, Told, setting};
use crate::remarks::remarks;

/// Colours for which recipes are searched.
#[wasm_bindgen]
#[derive(Debug)]
pub struct Targets {
    pub(crate) targets: Vec<ColorTarget>,
    hex: Vec<String>,
    remarks: Value,
}

#[wasm_bindgen]
impl Targets {
    /// A colour as `#rrggbb` or `L,a,b`.
    pub fn typed(text: &str) -> Result<Targets> {
        let text = text.trim();
        let target: ColorTarget = text.parse().map_err(|_| {
            let message = format!("a colour is #rrggbb or L,a,b, found `{text}`");
            setting(&message, "try #4a7d8c or 52,-10.5,8")
        })?;
        let code: spectra::color::ColorCode = text.parse().told()?;
        Ok(Self { targets: vec![target], hex: vec![displayed(code.lab())], remarks: json!([]) })
    }

    /// The colours of a swatch file (.ase, .gpl, .aco) or of a table of names, or the spectra of paint in a
    /// file of readings.
    pub fn of_file(file: &str, bytes: &[u8]) -> Result<Targets> {
        match TargetBook::read(file, bytes, None, None).told()? {
            Some(book) => Self::of_book(book),
            None => Self::of_readings(file, bytes),
        }
    }

    /// Names and colours as JSON: targets with `name` and `hex`, and `remarks`.
    pub fn about(&self) -> String {
        let targets = self.targets.iter().zip(&self.hex);
        let targets = targets.map(|(target, hex)| json!({ "name": target.name, "hex": hex }));
        json!({ "targets": targets.collect::<Vec<_>>(), "remarks": self.remarks }).to_string()
    }
}

impl Targets {
    fn of_book(book: TargetBook) -> Result<Self> {
        let mut hex = Vec::new();
        for target in &book.targets {
            hex.push(displayed(target.under(&[ViewingCondition::default()]).told()?.lab[0]));
        }
        Ok(Self { targets: book.targets, hex, remarks: remarks(&book.remarks) })
    }

    fn of_readings(file: &str, bytes: &[u8]) -> Result<Self> {
        let options = ReadingOptions::default();
        let readings =
            calibrate::Readings::spectra_from_files(&[(file, bytes)], &options).told()?;
        let mut averaged = readings.table.averaged();
        if averaged.spectra.iter().any(|spectrum| spectrum.film == Film::Paint) {
            averaged.spectra.retain(|spectrum| spectrum.film == Film::Paint);
        }
        let mut targets = Vec::new();
        let mut hex = Vec::new();
        for spectrum in averaged.spectra {
            let measured =
                Spectrum::<Reflectance>::new(averaged.grid, spectrum.reflectance).told()?;
            hex.push(Viewing::default().color(&measured).told()?.hex());
            targets.push(ColorTarget::measured(spectrum.name, measured));
        }
        Ok(Self { targets, hex, remarks: remarks(&readings.remarks) })
    }
}

/// sRGB of a colour, adapted from its light.
fn displayed(lab: spectra::color::Lab) -> String {
    use spectra::color::{Adaptation, RgbSpace};
    let white = RgbSpace::Srgb.white();
    RgbSpace::Srgb.encoded_from_xyz(lab.to_xyz(white), white, Adaptation::Bradford).to_hex()
}
