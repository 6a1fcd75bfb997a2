//! The lab: films on two cards, two sets of measurements compared, plans of swatches, and spectra at points for
//! the module of scans.

use calibrate::plan::{MeasurementForm, Plan, PlanRequest};
use calibrate::rows::csv_of;
use calibrate::{CompareRequest, FilmRequest, PigmentLibrary, Remark, compare_sets};
use documents::Task;
use serde::Deserialize;
use serde_json::{Value, json};
use spectra::Grid;
use wasm_bindgen::prelude::*;

use crate::failure::{Result, Told, request, setting};
use crate::library::Library;
use crate::readings::Readings;
use crate::remarks::remarks;

#[wasm_bindgen]
impl Readings {
    /// Films on two cards as JSON, with the keys of `impasto film --json`, its table as `csv`, and `remarks`.
    pub fn film(&self, options: &str) -> Result<String> {
        let options: FilmRequest = request(options)?;
        let found = options.run(&self.0, &Task::default()).told()?;
        Ok(whole(found.to_json(), &found.rows(), &found.remarks))
    }

    /// These measurements compared with the standard, sample by sample, as JSON with the keys of `impasto color
    /// --against --json`, its table as `csv`, and `remarks`.
    pub fn compare(&self, standard: &Readings, options: &str) -> Result<String> {
        let options: CompareRequest = request(options)?;
        let found = compare_sets(&self.0.table, &standard.0.table, &options).told()?;
        Ok(whole(found.to_json(), &found.rows_under_light(), &found.remarks))
    }

    /// The mean spectrum of each film and card as JSON, for the module of scans: first and step in nm, names,
    /// whether they are bare cards, values.
    pub fn spots(&self) -> String {
        use calibrate::measurement::Film;
        let averaged = self.0.table.averaged();
        let spectra = averaged.spectra.into_iter().map(|spectrum| {
            let is_bare = spectrum.film == Film::None;
            json!({ "name": spectrum.name, "is_bare": is_bare, "values": spectrum.reflectance })
        });
        let grid = averaged.grid;
        json!({
            "first_nm": grid.start_nm(), "step_nm": grid.step_nm(),
            "spectra": spectra.collect::<Vec<Value>>(),
        })
        .to_string()
    }
}

/// A result with its table and its remarks.
fn whole(mut found: Value, rows: &[Value], told: &[Remark]) -> String {
    found["csv"] = json!(csv_of(rows));
    found["remarks"] = remarks(told);
    found.to_string()
}

/// A plan as the page asks for it.
#[derive(Debug, Deserialize)]
struct Wanted {
    pigments: Vec<String>,
    white: String,
    request: PlanRequest,
    /// First, last and step in nm.
    grid: [f64; 3],
    replicates: usize,
}

/// Maximum number of wavelengths of a measurement form.
const MAX_WAVELENGTHS: usize = 5001;

impl Wanted {
    fn form(&self) -> Result<MeasurementForm> {
        let [first, last, step] = self.grid;
        if !(first >= 200.0 && last <= 2500.0) {
            let message = "\"Wavelengths\" lie between 200 and 2500 nm";
            return Err(setting(message, "try 400,700,10"));
        }
        let grid = Grid::from_range(first, last, step).told()?;
        if grid.count() > MAX_WAVELENGTHS {
            let message = format!("a form has {MAX_WAVELENGTHS} wavelengths at most");
            return Err(setting(&message, "try 400,700,10"));
        }
        if !(1..=100).contains(&self.replicates) {
            let message = "\"Readings of each\" is 1 to 100";
            return Err(setting(message, "try 2, and turn the sample between both readings"));
        }
        Ok(MeasurementForm { grid, replicates: self.replicates })
    }

    fn planned(self, prior: Option<PigmentLibrary>) -> Result<String> {
        if self.pigments.is_empty() {
            return Err(setting("no pigment is named", "name those to plan for in \"Pigments\""));
        }
        if self.request.noise.is_some() && prior.is_none() {
            let message = "\"Noise\" works only where a library chooses the swatches";
            return Err(setting(message, "tick \"Choose them by the library above\""));
        }
        let form = self.form()?;
        let options = PlanRequest { prior, ..self.request };
        let task = told::task(|progress| progress.stage.to_string());
        let plan: Plan = options.run(&self.pigments, &self.white, &task).told()?;
        let mut found = plan.to_json();
        found["form"] = json!(String::from_utf8_lossy(&plan.form(&form)));
        found["recipes"] = json!(String::from_utf8_lossy(&plan.recipes(&form)));
        found["remarks"] = remarks(&plan.remarks);
        Ok(found.to_string())
    }
}

/// Swatches to prepare, as JSON with the keys of `impasto plan --json`, the files `form` and `recipes` that
/// `impasto plan --output` writes, and `remarks`.
#[wasm_bindgen]
pub fn plan(wanted: &str) -> Result<String> {
    request::<Wanted>(wanted)?.planned(None)
}

#[wasm_bindgen]
impl Library {
    /// Swatches as [`plan`] finds them, chosen by this library of similar paint.
    pub fn plan(&self, wanted: &str) -> Result<String> {
        request::<Wanted>(wanted)?.planned(Some(self.0.clone()))
    }
}
