//! Pigments of spectra that were measured at points. The page reads their files, and this module compares them
//! with a library.

use calibrate::measurement::{AveragedSpectra, AveragedSpectrum, Film};
use documents::hint::Explain;
use maps::IdentifyRequest;
use pigment::PigmentLibrary;
use pigment::rows::csv_of;
use serde::Deserialize;
use serde_json::{Value, json};
use spectra::Grid;
use told::{Result, refusal, request};
use wasm_bindgen::prelude::*;

use crate::failure::remarks;

/// Settings of points that a hint may name, each with its control in the panel.
const CONTROLS: [(&str, &str); 8] = [
    ("at_most", "\"At most\""),
    ("palette", "\"Palette\""),
    ("group", "\"Groups\""),
    ("apart", "\"Apart\""),
    ("noise", "\"Noise\""),
    ("model_error", "\"Model error\""),
    ("penalty", "\"Penalty\""),
    ("sets", "\"Sets\""),
];

/// An error in the words of the panel.
fn refused<E: Explain>(error: E) -> JsValue {
    refusal(&error, &CONTROLS)
}

/// Spectra on one grid, as the page passes them.
#[derive(Debug, Deserialize)]
struct Spots {
    first_nm: f64,
    step_nm: f64,
    spectra: Vec<Spot>,
}

#[derive(Debug, Deserialize)]
struct Spot {
    name: String,
    is_bare: bool,
    values: Vec<f64>,
}

impl Spots {
    fn averaged(self) -> Result<AveragedSpectra> {
        let count = self.spectra.first().map_or(0, |spot| spot.values.len());
        let grid = Grid::from_nm(self.first_nm, self.step_nm, count).map_err(refused)?;
        let spectra = self.spectra.into_iter().map(|spot| AveragedSpectrum {
            sample: spot.name.clone(),
            film: if spot.is_bare { Film::None } else { Film::Paint },
            name: spot.name,
            reflectance: spot.values,
        });
        Ok(AveragedSpectra { grid, spectra: spectra.collect() })
    }
}

/// Pigments of spectra as JSON, with the keys of `impasto identify --json`, its table as `csv`, the text of each
/// spectrum as `lines`, groups as `group_words`, and `remarks`. `library` is the content of the file `name`.
#[wasm_bindgen]
pub fn identify(name: &str, library: &[u8], spots: &str, options: &str) -> Result<String> {
    let options: IdentifyRequest = request(options, &CONTROLS)?;
    let library =
        PigmentLibrary::from_json(name, &String::from_utf8_lossy(library)).map_err(refused)?;
    let spots = request::<Spots>(spots, &CONTROLS)?.averaged()?;
    let found = options.run(&library, &spots).map_err(refused)?;
    let groups = found.groups.iter().map(|group| group.pigments.join(", "));
    let mut told = found.to_json();
    told["group_words"] = groups.collect::<Vec<String>>().into();
    told["lines"] =
        found.spectra.iter().map(|spectrum| json!(spectrum.lines())).collect::<Vec<Value>>().into();
    told["csv"] = csv_of(&found.rows()).into();
    told["remarks"] = remarks(&found.remarks, &CONTROLS);
    Ok(told.to_string())
}
