//! Fits of libraries to readings.

use calibrate::fit::{Method, Smoothness};
use calibrate::library::AmountKind;
use calibrate::observation::BelowSurface;
use calibrate::{FitOptions, PreparedFit};
use serde::Deserialize;
use serde_json::{Value, json};
use spectra::optics::{Specular, Surface};
use wasm_bindgen::prelude::*;

use crate::failure::{Result, Told, options};
use crate::library::Library;
use crate::readings::Readings;
use crate::remarks::remarks;
use crate::viewing::ViewingNames;

#[derive(Debug, Deserialize)]
#[serde(rename_all = "lowercase")]
enum Amounts {
    Relative,
    Absolute,
}

#[derive(Debug, Deserialize)]
#[serde(rename_all = "lowercase")]
enum MethodName {
    Qp,
    Weighted,
    Refined,
}

#[derive(Debug, Deserialize)]
#[serde(rename_all = "lowercase")]
enum Below {
    Refuse,
    Floor,
}

/// Options of a fit, as the page passes them. If you pass `null`, the fit chooses.
#[derive(Debug, Deserialize)]
struct Options {
    amounts: Amounts,
    method: MethodName,
    reference: Option<String>,
    surface: Option<(f64, f64)>,
    specular: bool,
    below_surface: Option<Below>,
    smoothness: Option<f64>,
    unevenness: Option<f64>,
    exclude: Vec<String>,
    viewing: ViewingNames,
    title: Option<String>,
    licence: String,
    source: String,
}

impl Options {
    fn read(json: &str) -> Result<FitOptions> {
        let read: Self = options(json)?;
        let specular = if read.specular { Specular::Included } else { Specular::Excluded };
        let surface = read.surface.map(|(k1, k2)| Surface::new(k1, k2, specular));
        Ok(FitOptions {
            amounts: match read.amounts {
                Amounts::Relative => AmountKind::Relative,
                Amounts::Absolute => AmountKind::Absolute,
            },
            method: match read.method {
                MethodName::Qp => Method::Qp,
                MethodName::Weighted => Method::Weighted,
                MethodName::Refined => Method::Refined,
            },
            reference: read.reference,
            surface: surface.transpose().told()?,
            specular,
            below_surface: read.below_surface.map(|below| match below {
                Below::Refuse => BelowSurface::Refuse,
                Below::Floor => BelowSurface::Floor,
            }),
            smoothness: read.smoothness.map_or(Smoothness::default(), Smoothness::Fixed),
            unevenness: read.unevenness,
            exclude: read.exclude,
            viewing: read.viewing.viewing()?,
            title: read.title,
            licence: Some(read.licence),
            source: Some(read.source),
        })
    }
}

/// A fitted library, with what a user should know about the fit.
#[wasm_bindgen]
#[derive(Debug)]
pub struct Fit(calibrate::Fit);

#[wasm_bindgen]
impl Fit {
    /// Fits K and S of every pigment. The page hears each stage.
    #[wasm_bindgen(constructor)]
    pub fn of(readings: &Readings, options: &str) -> Result<Fit> {
        let options = Options::read(options)?;
        let task = told::task(|progress| progress.stage.to_string());
        let prepared = PreparedFit::new(&readings.0, &options, &task).told()?;
        let mut fit = prepared.fit(&task).told()?;
        fit.remarks.splice(0..0, prepared.remarks);
        Ok(Self(fit))
    }

    /// Errors of the fit as JSON, with the keys of `impasto fit --json`, and `remarks`.
    pub fn errors(&self) -> String {
        let mut errors = self.0.errors_json();
        errors.insert("remarks".to_owned(), remarks(&self.0.remarks));
        errors.insert("report".to_owned(), json!(self.0.report().to_string()));
        Value::Object(errors).to_string()
    }

    /// The library, with the evidence of its fit.
    pub fn library(&self) -> Library {
        Library(self.0.library.clone())
    }
}
