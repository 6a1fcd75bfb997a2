//! Requests for samples of brushwork and for art maps. With them you propose marks, take samples from a picture,
//! paint samples, make or check a map, or look at a file.
//!
//! The comments of the fields are also their descriptions in the schema.

use std::path::PathBuf;

use artmap::{
    map::Between,
    painted::PaintedSettings,
    passages::{Density, OverSegmentation, PassageSettings},
    synthesis::{Features, SynthesisSettings},
};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Samples to take from a painting or photograph, by marks. [`Self::run`] takes them and writes their file.
///
/// All keys but `painting` and `output` have defaults. As JSON:
///
/// ```
/// use documents::request::request_from_json;
/// use pictures::SampleRequest;
///
/// let request: SampleRequest = request_from_json(
///     r#"{"painting": "orchard.png", "marks": "orchard.toml", "output": "samples.exr"}"#,
/// )?;
/// assert_eq!((request.reach, request.spacing), (1.0, None));
/// # Ok::<(), documents::request::RequestError>(())
/// ```
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(description = "Samples of brushwork to take from a painting or photograph")]
pub struct SampleRequest {
    /// A picture (.png, .jpg, .tif, .webp), or a painting of impasto (.exr), which keeps its pigments and
    /// relief
    pub painting: PathBuf,
    /// Marks of the samples (.toml), or lines over the picture (.png). Without marks the whole picture is one
    /// sample
    #[serde(default)]
    pub marks: Option<PathBuf>,
    /// Write the samples (.exr)
    pub output: PathBuf,
    /// Write a picture of all samples side by side, dark to light, the relief of the paint under a
    /// raking light below (.png, .exr)
    #[serde(default)]
    pub sheet: Option<PathBuf>,
    /// Write the picture with the marks and the outlines of the passages drawn on it (.png, .exr)
    #[serde(default)]
    pub marked: Option<PathBuf>,
    /// Method that divides the picture into small regions, which grow into passages
    #[serde(default)]
    pub over: OverSegmentation,
    /// How unlike regions may be to join a passage, 0 to 10
    #[serde(default = "reach")]
    pub reach: f64,
    /// Distance between neighbouring strokes in pixels, 1 to 1000, for samples without a `spacing` in
    /// the marks [default: estimated; it is an error if the strokes are too unclear for that]
    #[serde(default)]
    pub spacing: Option<f64>,
    /// Directions in which samples are resized until all have the same distance between strokes
    #[serde(default)]
    pub density: Density,
    /// Guess the relief of a picture from its lightness: dark is deep. This is the height in mm from furrow
    /// to ridge, above 0 to 10, for example 0.2 for oil. Light from one side and lighter paint are mistaken
    /// for relief
    #[serde(default)]
    pub guess_relief: Option<f64>,
    /// If a painting has more than eight pigments, count each below 1 % as the one nearest in colour
    #[serde(default)]
    pub merge_minor: bool,
}

/// Marks to propose for a painting or photograph, which you then edit. [`Self::run`] writes their file, and takes
/// no samples.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(description = "Marks of samples to propose for a painting or photograph")]
pub struct MarksRequest {
    /// A picture (.png, .jpg, .tif, .webp), or a painting of impasto (.exr)
    pub painting: PathBuf,
    /// Largest number of marks to propose, 1 to 64
    pub count: usize,
    /// Write the marks (.toml)
    pub output: PathBuf,
    /// Write the picture with the marks drawn on it (.png, .exr)
    #[serde(default)]
    pub marked: Option<PathBuf>,
    /// Method that divides the picture into small regions, which grow into passages
    #[serde(default)]
    pub over: OverSegmentation,
    /// How unlike regions may be to join a passage, 0 to 10
    #[serde(default = "reach")]
    pub reach: f64,
    /// If a painting has more than eight pigments, count each below 1 % as the one nearest in colour
    #[serde(default)]
    pub merge_minor: bool,
}

/// Samples to paint with the engine: tones of one hue, from dark to light, in the strokes of a style.
/// [`Self::run`] paints them and writes their file.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(description = "Samples of brushwork to paint in a style")]
pub struct SwatchRequest {
    /// Style: oil-flat, oil-long, dabs, knife, hatching, dry-brush, or a file (.toml)
    pub style: PathBuf,
    /// Library of the paints [default: the Van Gogh oils that ship]
    #[serde(default)]
    pub library: Option<PathBuf>,
    /// Hue of the tones, as `#c9a227` or `L,a,b`. Its lightness does not matter
    #[serde(default = "hue")]
    pub hue: String,
    /// Number of tones, 2 to 12
    #[serde(default = "tones")]
    pub tones: usize,
    /// Seed of the strokes [default: the seed of the style]
    #[serde(default)]
    pub seed: Option<u64>,
    /// Write the samples (.exr)
    pub output: PathBuf,
    /// Write a picture of all samples side by side, dark to light, the relief of the paint under a
    /// raking light below (.png, .exr)
    #[serde(default)]
    pub sheet: Option<PathBuf>,
}

/// A map to make of samples. It has one tile for each sample, from dark to light, and each tile repeats without
/// seams. [`Self::run`] makes the map and writes its file.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(description = "An art map to make of samples")]
pub struct ArtMapRequest {
    /// Files of samples (.exr). Several files with the same pigments make one map
    pub samples: Vec<PathBuf>,
    /// Width and height of the tiles in texels, 64 to 1024
    #[serde(default = "size")]
    pub size: usize,
    /// Sample with the tile that is made first and that the others follow [default: the one with the
    /// strongest contrast]
    #[serde(default)]
    pub first: Option<String>,
    /// Properties by which patches of different samples are compared
    #[serde(default)]
    pub features: Features,
    /// Number of patches of each sample that a patch of the first tile is linked to, 1 to 512
    #[serde(default = "links")]
    pub links: usize,
    /// How closely tiles follow the first one, 0 to 16. Less makes better seams
    #[serde(default = "follow")]
    pub follow: f32,
    /// How evenly the parts of a sample are used, 0 to 16
    #[serde(default = "uniformity")]
    pub uniformity: f32,
    /// Seed of the first tile
    #[serde(default = "seed")]
    pub seed: u64,
    /// Write the map (.exr)
    pub output: PathBuf,
    /// Write a picture of all tiles, dark to light: tiles, tones in between, tiles repeated, relief
    /// (.png, .exr)
    #[serde(default)]
    pub sheet: Option<PathBuf>,
    /// Write intermediate stages into this folder, as PNG: samples; the properties by which patches are
    /// compared (edges, lightness, a*, b*, height); most similar patches; the levels of each tile
    #[serde(default)]
    pub stages: Option<PathBuf>,
}

/// A map to check for tiles that do not agree, seams, and tones too close to each other. [`Self::run`] lists its
/// faults.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(description = "An art map to check")]
pub struct ArtMapCheckRequest {
    /// The map (.exr)
    pub map: PathBuf,
}

/// Samples or tiles to list, or to draw side by side. [`Self::run`] reads their file and draws the sheet.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(description = "Samples or the tiles of an art map to look at")]
pub struct SheetRequest {
    /// Samples or a map (.exr)
    pub file: PathBuf,
    /// Write a picture of all samples or tiles side by side, dark to light (.png, .exr)
    #[serde(default)]
    pub sheet: Option<PathBuf>,
    /// How the tones between the tiles of a map are made on the sheet
    #[serde(default)]
    pub between: Between,
}

impl SampleRequest {
    /// The settings by which samples are taken.
    pub(crate) fn settings(&self) -> PassageSettings {
        PassageSettings {
            over: self.over,
            reach: self.reach,
            density: self.density,
            spacing: self.spacing,
            ..PassageSettings::default()
        }
    }
}

impl MarksRequest {
    /// Largest number of marks that you can ask for.
    pub const MOST: usize = 64;

    /// The settings by which passages are found.
    pub(crate) fn settings(&self) -> PassageSettings {
        PassageSettings { over: self.over, reach: self.reach, ..PassageSettings::default() }
    }
}

impl ArtMapRequest {
    /// The settings of the synthesis.
    pub(crate) fn settings(&self) -> SynthesisSettings {
        SynthesisSettings {
            size: self.size,
            first: self.first.clone(),
            features: self.features,
            links: self.links,
            follow: self.follow,
            uniformity: self.uniformity,
            seed: self.seed,
        }
    }
}

fn reach() -> f64 {
    PassageSettings::default().reach
}

fn hue() -> String {
    PaintedSettings::default().hue
}

fn tones() -> usize {
    PaintedSettings::default().tones
}

fn size() -> usize {
    SynthesisSettings::default().size
}

fn links() -> usize {
    SynthesisSettings::default().links
}

fn follow() -> f32 {
    SynthesisSettings::default().follow
}

fn uniformity() -> f32 {
    SynthesisSettings::default().uniformity
}

fn seed() -> u64 {
    SynthesisSettings::default().seed
}

#[cfg(test)]
mod tests {
    use super::*;
    use documents::hint::Explain;
    use documents::request::request_from_json;
    use serde::de::DeserializeOwned;

    fn round_trip<T: DeserializeOwned + Serialize + PartialEq + std::fmt::Debug>(json: &str) -> T {
        let request: T = request_from_json(json).unwrap();
        let text = serde_json::to_string(&request).unwrap();
        assert_eq!(request_from_json::<T>(&text).unwrap(), request, "{text}");
        request
    }

    #[test]
    fn requests_are_the_same_after_json_and_have_the_usual_defaults() {
        let sample: SampleRequest =
            round_trip(r#"{"painting": "a.png", "output": "s.exr", "over": "mean-shift"}"#);
        let usual = PassageSettings::default();
        let over = OverSegmentation::MeanShift;
        assert_eq!(sample.settings(), PassageSettings { over, ..usual });
        let marks: MarksRequest =
            round_trip(r#"{"painting": "a.png", "count": 3, "output": "m.toml", "marked": null}"#);
        assert_eq!(marks.settings(), usual);
        let swatch: SwatchRequest = round_trip(r#"{"style": "dabs", "output": "s.exr"}"#);
        let colors = PaintedSettings::default();
        assert_eq!(
            (swatch.hue, swatch.tones, swatch.seed),
            (colors.hue, colors.tones, colors.seed)
        );
        let map: ArtMapRequest = round_trip(
            r#"{"samples": ["s.exr"], "output": "m.exr", "features": "paper", "seed": 7}"#,
        );
        let features = Features::Paper;
        let settings = SynthesisSettings { features, seed: 7, ..SynthesisSettings::default() };
        assert_eq!(map.settings(), settings);
        round_trip::<ArtMapCheckRequest>(r#"{"map": "m.exr"}"#);
        let sheet: SheetRequest = round_trip(r#"{"file": "m.exr", "between": "blend"}"#);
        assert_eq!(sheet.between, Between::Blend);
    }

    #[test]
    fn keys_and_words_that_do_not_exist_are_refused_by_name() {
        fn refused<T: DeserializeOwned + std::fmt::Debug>(json: &str) -> (String, String) {
            let error = request_from_json::<T>(json).unwrap_err();
            let hint = error.hint().map(|hint| hint.to_string());
            (error.to_string(), hint.unwrap_or_default())
        }
        let (message, hint) =
            refused::<SwatchRequest>(r#"{"style": "dabs", "output": "s.exr", "tone": 3}"#);
        assert_eq!(message, "unknown key `tone`");
        assert_eq!(hint, "did you mean tones?");
        let (message, hint) =
            refused::<SampleRequest>(r#"{"painting": "a.png", "output": "s.exr", "over": "jpeg"}"#);
        assert_eq!(message, "over: unknown word `jpeg`");
        assert_eq!(hint, "did you mean jseg?");
        let (message, _) = refused::<ArtMapRequest>(r#"{"samples": ["s.exr"]}"#);
        assert!(message.contains("`output`"), "{message}");
        let (message, _) = refused::<ArtMapRequest>(r#"{"samples": 3, "output": "m.exr"}"#);
        assert!(message.starts_with("samples: "), "{message}");
    }
}
