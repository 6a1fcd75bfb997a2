//! Fits of libraries to readings.

use calibrate::{FitRequest, PreparedFit};
use serde_json::{Value, json};
use wasm_bindgen::prelude::*;

use crate::failure::{self, Result, Told, setting};
use crate::library::Library;
use crate::readings::Readings;
use crate::remarks::remarks;

/// A fitted library, with what a user should know about the fit.
#[wasm_bindgen]
#[derive(Debug)]
pub struct Fit(calibrate::Fit);

#[wasm_bindgen]
impl Fit {
    /// Fits K and S of every pigment, with the surface of a library file if there is one. Reports each stage
    /// to the page.
    #[wasm_bindgen(constructor)]
    pub fn of(
        readings: &Readings,
        request: &str,
        surface_name: Option<String>,
        surface_of: Option<Vec<u8>>,
    ) -> Result<Fit> {
        let request: FitRequest = failure::request(request)?;
        let request = match surface_name.zip(surface_of) {
            Some(_) if request.surface.is_some() => {
                let message = "\"Surface\" and \"Surface of a library\" both state the surface";
                return Err(setting(message, "empty one of the two fields"));
            }
            Some((name, bytes)) => request.with_surface_of(&Library::open(&name, &bytes)?.0),
            None => request,
        };
        let task = told::task(|progress| progress.stage.to_string());
        let prepared = PreparedFit::new(&readings.0, &request, &task).told()?;
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
