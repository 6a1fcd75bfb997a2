//! Pigment libraries, colours of their mixtures, and the report on them.

use std::ops::RangeInclusive;

use calibrate::curation::Swatches;
use calibrate::library::AmountKind;
use calibrate::{Backing, FilmOver, MixtureColor, PigmentLibrary, Viewing};
use reports::{ReportRequest, page_alone};
use serde::Deserialize;
use serde_json::{Value, json};
use wasm_bindgen::prelude::*;

use crate::failure::{Result, Told, request, setting};
use crate::readings::Readings;
use crate::remarks::remarks;

/// How many wavelengths the quadratures in a report have.
const WAVELENGTHS: RangeInclusive<usize> = 3..=12;

/// A library of calibrated pigments.
#[wasm_bindgen]
#[derive(Debug)]
pub struct Library(pub(crate) PigmentLibrary);

/// A film, as the page passes it.
#[derive(Debug, Deserialize)]
struct Mixture {
    parts: Vec<(String, f64)>,
    /// A film that hides has no thickness.
    thickness: Option<f64>,
    over: f64,
    viewing: Viewing,
}

#[wasm_bindgen]
impl Library {
    /// Reads a library from the bytes of its JSON file.
    #[wasm_bindgen(constructor)]
    pub fn open(name: &str, bytes: &[u8]) -> Result<Library> {
        PigmentLibrary::from_json(name, &String::from_utf8_lossy(bytes)).map(Self).told()
    }

    /// Van Gogh's oils, which ship with impasto.
    pub fn van_gogh_oils() -> Library {
        Self(PigmentLibrary::van_gogh_oils())
    }

    /// The library as the JSON text of its file.
    pub fn json(&self) -> String {
        self.0.to_json()
    }

    /// The library without its curves, as JSON, with the colour of each pigment by itself under a
    /// light.
    pub fn about(&self, viewing: &str) -> Result<String> {
        let library = &self.0;
        let viewing = request::<Viewing>(viewing)?;
        let swatches = Swatches::new(library, &viewing, &[]).told()?;
        let pigments = library.pigments.iter().map(|pigment| {
            let swatch = swatches.swatches.iter().find(|swatch| swatch.pigment == pigment.name);
            json!({
                "name": pigment.name, "colour_index": pigment.color_index,
                "identified": pigment.identified, "guessed": pigment.guessed,
                "notes": pigment.notes, "measured_amounts": pigment.measured_amounts,
                "hex": swatch.map(|swatch| swatch.color.srgb.to_hex()),
            })
        });
        let told = json!({
            "title": library.title, "licence": library.licence, "source": library.source,
            "amounts": library.amounts, "reference": library.reference,
            "surface": {"k1": library.saunderson.k1, "k2": library.saunderson.k2},
            "grid": library.grid.to_string(), "inputs": library.inputs,
            "evidence": library.evidence, "pigments": pigments.collect::<Vec<Value>>(),
        });
        Ok(told.to_string())
    }

    /// K and S of the pigment with index `place`, as JSON: wavelengths_nm, k, s and their deviations.
    pub fn curves(&self, place: usize) -> Result<String> {
        let pigment = self.0.pigments.get(place);
        let pigment = pigment.ok_or_else(|| setting("no such pigment", "choose another"))?;
        Ok(json!({
            "wavelengths_nm": self.0.grid.wavelengths_nm().collect::<Vec<f64>>(),
            "k": pigment.absorption, "s": pigment.scattering,
            "k_sd": pigment.absorption_sd, "s_sd": pigment.scattering_sd,
        })
        .to_string())
    }

    /// Colour of a mixture as JSON, with the keys of `impasto mix --json`, and `remarks`.
    pub fn mix(&self, mixture: &str) -> Result<String> {
        let Mixture { parts, thickness, over, viewing } = request(mixture)?;
        let color = if thickness.is_none() && self.0.amounts == AmountKind::Relative {
            self.0.color(parts, &viewing)
        } else {
            let ground = Backing::even(over).told()?;
            let film = FilmOver { thickness: thickness.unwrap_or(1.0), ground };
            self.0.film_color(parts, &film, &viewing)
        };
        let MixtureColor { reflectance, xyz, lab, srgb, remarks: told, .. } = color.told()?;
        Ok(json!({
            "wavelengths_nm": self.0.grid.wavelengths_nm().collect::<Vec<f64>>(),
            "reflectance": reflectance.values(),
            "xyz": xyz.to_array(),
            "lab": lab.to_array(),
            "srgb": srgb.0,
            "hex": srgb.to_hex(),
            "in_gamut": srgb.in_gamut(),
            "remarks": remarks(&told),
        })
        .to_string())
    }

    /// The report on the library alone, as one HTML page. Reports each step to the calibration page.
    pub fn report(&self, request: &str) -> Result<String> {
        self.drawn(None, request)
    }

    /// The report that also compares each sample with the library, and leaves out each mixture in
    /// turn unless the request says no.
    pub fn report_with(&self, readings: &Readings, request: &str) -> Result<String> {
        self.drawn(Some(&readings.0), request)
    }
}

impl Library {
    fn drawn(&self, readings: Option<&calibrate::Readings>, json: &str) -> Result<String> {
        let request = request::<ReportRequest>(json)?;
        let request = ReportRequest { wavelengths: WAVELENGTHS, ..request };
        let task = told::task(|progress| match progress.done == progress.of {
            // The mixtures are done, and another stage begins.
            true => progress.stage.to_string(),
            false => progress.to_string(),
        });
        let command = "calibration page of impasto";
        let subject = request.run(&self.0, readings, command, &task).told()?;
        let task = told::task(|progress| {
            format!("figures, {} of {} sections", progress.done, progress.of)
        });
        Ok(page_alone(&subject, &task))
    }
}
