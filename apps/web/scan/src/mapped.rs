//! Maps of a scan: tables, pictures and words.

use maps::SurveyedScan;
use maps::pictures::{MapPictures, Overview};
use pigment::PigmentLibrary;
use serde_json::{Value, json};
use wasm_bindgen::prelude::*;

use crate::failure::{CONTROLS, Result, Told, remarks};

/// Maps of a scan.
#[wasm_bindgen]
#[derive(Debug)]
pub struct Mapped {
    about: String,
    pictures: Vec<(String, Vec<u8>)>,
}

impl Mapped {
    pub(crate) fn of(
        scan: &SurveyedScan,
        overview: &Overview,
        library: &PigmentLibrary,
        every: usize,
    ) -> Result<Self> {
        let drawn = MapPictures::of(scan, overview, library).told()?;
        let mut pictures = Vec::new();
        let mut named = Vec::new();
        for of in drawn.pigments {
            named.push(json!({
                "pigment": overview.pigments[of.place],
                "presence": of.presence_file,
                "share": of.share_file,
            }));
            pictures.extend([(of.presence_file, of.presence), (of.share_file, of.share)]);
        }
        pictures.push((MapPictures::CHI2_FILE.to_owned(), drawn.chi2));
        pictures.push((MapPictures::RESIDUAL_FILE.to_owned(), drawn.residual));
        let about = json!({
            "words": scan.words(),
            "groups": scan.group_words(),
            "remarks": remarks(scan.mapper().remarks(), &CONTROLS),
            "unmapped": overview.unmapped_words(),
            "pictures": named,
            "width": overview.width,
            "height": overview.height,
            "step": overview.step,
            "every": every,
            "rows": [scan.about().rows.start, scan.about().rows.end],
            "columns": [scan.about().columns.start, scan.about().columns.end],
            // The text of `impasto map --json`, without the truth of simulated scans.
            "json": whole(scan.to_json(Some(overview), &[]), every),
        });
        Ok(Self { about: about.to_string(), pictures })
    }
}

/// The JSON of the maps. If only every n-th pixel is mapped, it includes n as `every`.
fn whole(mut json: Value, every: usize) -> Value {
    if every > 1 {
        json["every"] = json!(every);
    }
    json
}

#[wasm_bindgen]
impl Mapped {
    /// Words on the maps, names of their pictures, and the JSON of `impasto map`, in one JSON object.
    pub fn about(&self) -> String {
        self.about.clone()
    }

    /// Number of pictures.
    pub fn pictures(&self) -> usize {
        self.pictures.len()
    }

    /// File name of a picture.
    pub fn picture_name(&self, place: usize) -> String {
        self.pictures.get(place).map(|(name, _)| name.clone()).unwrap_or_default()
    }

    /// PNG of a picture.
    pub fn picture(&self, place: usize) -> Vec<u8> {
        self.pictures.get(place).map(|(_, bytes)| bytes.clone()).unwrap_or_default()
    }
}
