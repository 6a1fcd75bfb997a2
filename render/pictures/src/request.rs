//! A picture to paint as one type, which every program fills in its own way, and what comes out.
//!
//! Comments of the fields are the descriptions of the schema.

use std::path::PathBuf;

use graphics::gpu::BackendChoice;
use paint::separation::ColorErrors;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use strokes::{LevelReport, StrokeSettings};
use volumes::painter::Show;

use crate::animation::{Animation, AnimationRequest};
use crate::error::{PictureError, SettingError};
use crate::exports::{ExportRequest, OpenExports, StageFolder};
use crate::style::{StyleRequest, file_in};
use crate::subject::ViewRequest;

/// A picture to paint: its subject, a technique, and the files that are written. [`Self::run`] paints it.
///
/// All keys but `subject` and `technique` have defaults. As JSON:
///
/// ```
/// use documents::request::request_from_json;
/// use pictures::PictureRequest;
///
/// let request: PictureRequest = request_from_json(
///     r#"{
///         "subject": "photo.jpg",
///         "technique": {"watercolor": {}},
///         "style": {"preset": "landscape", "set": ["edges.strength=2"]},
///         "pigments": {"library": "oils.json"},
///         "exports": {"picture": "painted.png"}
///     }"#,
/// )?;
/// assert_eq!(request.style.preset.as_deref(), Some("landscape"));
/// # Ok::<(), documents::request::RequestError>(())
/// ```
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(description = "A picture to paint")]
pub struct PictureRequest {
    /// A photograph (.png, .jpg, .tif, .webp), a mesh (.obj, .gltf, .glb, .ply), or a built-in shape
    /// (shape:still-life, shape:village, shape:torus-knot, shape:sphere). For volumes also a script (.toml)
    pub subject: PathBuf,
    /// How it is painted
    pub technique: TechniqueRequest,
    /// Size of the picture, and the cameras
    #[serde(default)]
    pub view: ViewRequest,
    /// Settings of the technique
    #[serde(default)]
    pub style: StyleRequest,
    /// Pigments and light
    #[serde(default)]
    pub pigments: PigmentRequest,
    /// Files of the picture
    #[serde(default)]
    pub exports: ExportRequest,
    /// Write the intermediate stages of the picture into this folder, as PNG
    #[serde(default)]
    pub stages: Option<PathBuf>,
    /// File and frames of an animation
    #[serde(default)]
    pub animation: AnimationRequest,
    /// Device to compute on
    #[serde(default)]
    pub device: Device,
}

impl PictureRequest {
    /// A request with the defaults of all other keys, which writes nothing.
    #[must_use]
    pub fn new(subject: impl Into<PathBuf>, technique: TechniqueRequest) -> Self {
        Self {
            subject: subject.into(),
            technique,
            view: ViewRequest::default(),
            style: StyleRequest::default(),
            pigments: PigmentRequest::default(),
            exports: ExportRequest::default(),
            stages: None,
            animation: AnimationRequest::default(),
            device: Device::default(),
        }
    }

    /// The name of the subject's file without its ending.
    pub(crate) fn title(&self) -> String {
        let stem = self.subject.file_stem().map(|stem| stem.to_string_lossy().into_owned());
        stem.unwrap_or_default()
    }

    /// Checks the files that every technique writes. They must not replace `inputs`, and the picture and the
    /// animation must not be one file. Call this last, because it creates folders.
    pub(crate) fn open_outputs(&self, inputs: &[PathBuf]) -> Result<OpenOutputs, PictureError> {
        let animation = self.animation.open(inputs)?;
        let exports = self.exports.clone().open(inputs)?;
        let file = animation.as_ref().and_then(Animation::file);
        if let Some(file) = file.filter(|file| exports.writes(file)) {
            let path = file.path().display();
            let message = format!("{path}: the picture and the animation have this file name");
            return Err(SettingError::whole(message, "give each its own file name").into());
        }
        let stages = self.stages.as_deref();
        let stages = stages.map(|folder| StageFolder::open(folder, inputs)).transpose()?;
        Ok(OpenOutputs { exports, stages, animation })
    }
}

/// Outputs that were checked to be writable.
#[derive(Debug)]
pub(crate) struct OpenOutputs {
    pub(crate) exports: OpenExports,
    pub(crate) stages: Option<StageFolder>,
    pub(crate) animation: Option<Animation>,
}

/// A technique of painting, with the settings that only this technique takes.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum TechniqueRequest {
    /// Flat regions of a photograph or tones of a mesh become washes
    Watercolor(WatercolorRequest),
    /// A model or photograph is covered with strokes of an art map
    Painterly(PainterlyRequest),
    /// A photograph is painted stroke by stroke with calibrated pigments, or separated into them
    Strokes(StrokesRequest),
    /// Paint is poured over a scene drawn in pencil: what it reaches turns to colour
    Volumes(VolumesRequest),
}

/// Paper and masks of a watercolour.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct WatercolorRequest {
    /// Reflectance of the paper as measured: 0 to 1, or a file of spectra (FILE#SAMPLE)
    /// [default: computed from the setting paper.colour]
    pub over: Option<String>,
    /// Mask of the dry brush, stretched over the picture: white where the brush is dry
    pub dry_brush_mask: Option<PathBuf>,
    /// Mask of the density changes, stretched over the picture: white where density changes
    pub density_mask: Option<PathBuf>,
}

/// Brushwork, form and ground of a picture in the brushwork of art maps.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct PainterlyRequest {
    /// The map (.exr). MATERIAL=FILE is for the parts of a model with that material
    pub map: Vec<String>,
    /// Paint samples in this style and make a map of them: oil-flat, oil-long, dabs, knife, hatching,
    /// dry-brush, or a file (.toml) [default: the style of the preset, or oil-flat]
    pub style: Option<String>,
    /// Regions with a map, direction, size, flow or tones of their own (.toml)
    pub regions: Option<PathBuf>,
    /// Directions of strokes: guides drawn as lines (.toml), or for a picture a PNG. Its red (to
    /// the right) and green (upwards) give the direction, where one half is 0, and its blue the
    /// strength of flow
    pub directions: Option<PathBuf>,
    /// Depth of a picture: white is near, black is far (.png, .jpg, .tif, .webp). It makes a relief
    /// of the picture, which you can then turn
    pub depth: Option<PathBuf>,
    /// Let strokes flow in a loop of this number of frames, 1 to 100000, seen from a camera that stands
    /// still
    #[serde(rename = "loop")]
    pub loop_frames: Option<u64>,
    /// Write each frame into this folder as OpenEXR, for compositing: colour and cover, depth, height
    /// of the brushwork, direction of strokes
    pub exr_frames: Option<PathBuf>,
    /// Paint the first picture with pigments, and show it as a painting, with relief and gloss. A library,
    /// a palette, and exports other than the picture imply it
    pub with_pigments: bool,
    /// Ground of a painting: linen, paper or panel
    pub ground: String,
}

impl Default for PainterlyRequest {
    fn default() -> Self {
        Self {
            map: Vec::new(),
            style: None,
            regions: None,
            directions: None,
            depth: None,
            loop_frames: None,
            exr_frames: None,
            with_pigments: false,
            ground: "panel".to_owned(),
        }
    }
}

/// Canvas and brushes of a photograph that is painted in strokes, or separated into pigments.
///
/// This separates a photograph into three oils, and paints nothing:
///
/// ```
/// use documents::Task;
/// use documents::request::request_from_json;
/// use graphics::{export::png8, field::Field};
/// use pictures::{PictureRequest, TechniqueOutcome};
///
/// let folder = tempfile::tempdir()?;
/// let photograph = folder.path().join("dusk.png");
/// let picture = Field::filled(12, 9, [0.3, 0.1, 0.2, 1.0]);
/// std::fs::write(&photograph, png8(&picture, 1.0)?.bytes)?;
/// let json = format!(
///     r#"{{
///         "subject": {photograph:?},
///         "technique": {{"strokes": {{"width_mm": 6, "cell_mm": 0.5, "separate": {:?}}}}},
///         "pigments": {{"palette": ["Zinc White, Vermilion, Ultramarine"]}}
///     }}"#,
///     folder.path().join("maps")
/// );
/// let outcome = request_from_json::<PictureRequest>(&json)?.run(&Task::default())?;
/// assert_eq!(outcome.files, [folder.path().join("maps")]);
/// assert_eq!(outcome.pigments, ["Zinc White", "Vermilion", "Ultramarine"]);
/// let TechniqueOutcome::Strokes { strokes: 0, separation_error: Some(error), .. } =
///     outcome.technique
/// else {
///     panic!("strokes were painted");
/// };
/// println!("colour error of the pigments: {:.1} CIEDE2000", error.mean);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
#[schemars(description = "Canvas and brushes for a photograph painted in strokes")]
pub struct StrokesRequest {
    /// Width of the painting in mm, 5 to 5000. Its height follows the photograph's shape
    pub width_mm: f64,
    /// Width of a cell in mm, 0.02 to 5. Smaller cells show finer relief, half the width takes four
    /// times as long
    pub cell_mm: f64,
    /// Ground to paint on: linen, paper or panel
    pub ground: String,
    /// Widths of the brushes in mm, used from the broadest to the finest [default: 16, 8, 4, 2 and 1 on
    /// 200 mm, and in proportion]
    pub brushes_mm: Vec<f64>,
    /// Difference in CIELAB above which an area is painted over, 0.5 to 100. Less takes more strokes
    pub tolerance: f64,
    /// Seed of all random choices
    pub seed: u64,
    /// Write the strokes as a script (.json) that paints the same, bit for bit
    pub strokes_out: Option<PathBuf>,
    /// Write a map of each pigment, the picture they make and its colour error into this folder.
    /// Nothing is painted unless you ask for another file
    pub separate: Option<PathBuf>,
    /// Let the ground show through in `separate`, which reaches lighter and purer colours. You cannot
    /// paint in the same run
    pub thin: bool,
}

impl Default for StrokesRequest {
    fn default() -> Self {
        let settings = StrokeSettings::default();
        Self {
            width_mm: settings.width_mm,
            cell_mm: settings.cell_mm,
            ground: settings.ground.name().to_owned(),
            brushes_mm: settings.brushes_mm,
            tolerance: settings.tolerance,
            seed: settings.seed,
            strokes_out: None,
            separate: None,
            thin: !settings.hides,
        }
    }
}

/// Pours, ground and files of a scene with paint volumes.
///
/// This pours paint over a sphere and writes where it brings colour:
///
/// ```
/// use documents::Task;
/// use documents::request::request_from_json;
/// use pictures::{PictureRequest, TechniqueOutcome};
///
/// let folder = tempfile::tempdir()?;
/// let json = format!(
///     r#"{{
///         "subject": "shape:sphere",
///         "technique": {{"volumes": {{"pour": ["0.5,0.5"], "seconds": 0.1, "mask": {:?}}}}},
///         "view": {{"width": 24}},
///         "style": {{"set": ["grid.cell=0.25"]}},
///         "device": "cpu"
///     }}"#,
///     folder.path().join("mask.png")
/// );
/// let outcome = request_from_json::<PictureRequest>(&json)?.run(&Task::default())?;
/// assert_eq!(outcome.size, (24, 18));
/// assert_eq!(outcome.files, [folder.path().join("mask.png")]);
/// let TechniqueOutcome::Volumes { volumes: 1.., .. } = outcome.technique else {
///     panic!("no paint was poured");
/// };
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
#[schemars(description = "Pours, ground and files of a scene with paint volumes")]
pub struct VolumesRequest {
    /// Content of pictures: `final`, the result; `volumes`, the volumes over the grey drawing; `mask`,
    /// white where volumes are and black elsewhere; `grey`, the drawing without volumes; `colour`, the
    /// scene in colour; `hatching`, the pencil strokes
    pub show: String,
    /// Time of single pictures in seconds [default: the end]
    pub at: Option<f64>,
    /// Pour paint at places of the first picture: shares of its width and height, and the amount in
    /// mm3 (without it 60), such as `0.5,0.6` or `0.5,0.6,200`
    pub pour: Vec<String>,
    /// Paint of the pours, as pigments with their parts, such as `Ultramarine=2,White=1`: one for all
    /// of them, or one for each [default: the pigments of the palette, or of the script, in turn]
    pub paint: Vec<String>,
    /// How long paint spreads, in seconds [default: 4, or as the script says]
    pub seconds: Option<f64>,
    /// Ground: linen, paper or panel [default: the one in the script, or panel]
    pub ground: Option<String>,
    /// Reflectance of the ground as measured, 0 to 1, white or black, or one spectrum of a file
    /// [default: the one in the script, or the white of the library]
    pub over: Option<String>,
    /// Write the picture in layers for compositing, as OpenEXR of several parts: colour, grey, count
    /// and tint of each region, ink, place, normal, and heights of pigments
    pub passes: Option<PathBuf>,
    /// Write a mask as PNG or OpenEXR: white where volumes bring colour
    pub mask: Option<PathBuf>,
    /// Write the volumes of each frame into this folder as PLY
    pub volumes: Option<PathBuf>,
    /// Write the pours and other events of the scene, and all settings that differ from the preset, as a
    /// script (.toml)
    pub script_out: Option<PathBuf>,
}

impl Default for VolumesRequest {
    fn default() -> Self {
        Self {
            show: Show::default().name().to_owned(),
            at: None,
            pour: Vec::new(),
            paint: Vec::new(),
            seconds: None,
            ground: None,
            over: None,
            passes: None,
            mask: None,
            volumes: None,
            script_out: None,
        }
    }
}

/// Pigments that a picture is painted with, and the light in which it is seen.
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct PigmentRequest {
    /// Library of the pigments. Without it a watercolor has no pigments. A painting of maps then has the pigments
    /// of its map or, if you name a palette, the Van Gogh oils that ship. Strokes then have these oils. Volumes
    /// then have the library that their script names
    pub library: Option<PathBuf>,
    /// Names of up to eight pigments of the library [default: the ones nearest to the picture's
    /// colours]
    pub palette: Vec<String>,
    /// Light: D65, A, FL11, 5600K, or the file of a lamp [default: D65, or the light of a script of volumes]
    pub illuminant: Option<String>,
}

impl PigmentRequest {
    /// Files of spectra that this request and `over` name: lamps and grounds.
    pub(crate) fn measured_files(&self, over: Option<&str>) -> Vec<PathBuf> {
        [self.illuminant.as_deref(), over].into_iter().flatten().filter_map(file_in).collect()
    }

    /// The light if the request names none.
    pub(crate) const USUAL_LIGHT: &'static str = "D65";

    /// The light of the request, or the usual one.
    pub(crate) fn light(&self) -> &str {
        self.illuminant.as_deref().unwrap_or(Self::USUAL_LIGHT)
    }
}

/// The processor, or a graphics device.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Device {
    /// A hardware graphics adapter if there is one, else the processor
    #[default]
    Auto,
    /// The processor (CPU)
    Cpu,
    /// A graphics adapter, in hardware or software
    Gpu,
}

impl From<Device> for BackendChoice {
    fn from(device: Device) -> Self {
        match device {
            Device::Auto => Self::Auto,
            Device::Cpu => Self::Cpu,
            Device::Gpu => Self::Gpu,
        }
    }
}

/// A picture that was painted, and its files.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PictureOutcome {
    /// Width and height in pixels. For strokes, this is in cells of the canvas.
    pub size: (usize, usize),
    /// Name of the device: `cpu`, or the name of a graphics adapter. For strokes on the processor, this names the
    /// processor with its threads.
    pub backend: String,
    /// Figures that only this technique has.
    #[serde(flatten)]
    pub technique: TechniqueOutcome,
    /// Number of frames of an animation.
    pub frames: Option<usize>,
    /// Number of frames that existed already.
    pub frames_found: Option<usize>,
    /// Names of the pigments of the paint, empty without pigments.
    pub pigments: Vec<String>,
    /// Remarks on what was read or chosen, and on colours that a file cannot hold.
    pub remarks: Vec<String>,
    /// Files and folders that were written, in the order in which they were written.
    pub files: Vec<PathBuf>,
    /// The content of a file with the path `-`.
    #[serde(skip)]
    pub streamed: Option<Vec<u8>>,
}

/// Numbers of a picture that only its technique has.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(untagged)]
pub enum TechniqueOutcome {
    /// The regions of a watercolour.
    Watercolor {
        /// Number of regions of a photograph.
        regions: Option<usize>,
    },
    /// A subject in the brushwork of art maps.
    Painterly {
        /// Number of strokes of the first picture.
        strokes: usize,
        /// Number of strokes of each of its layers.
        layers: Vec<usize>,
        /// Share of strokes that continue a neighbour, 0 to 1.
        matched: f64,
        /// Number of maps.
        maps: usize,
        /// Number of regions with brushwork of their own.
        regions: usize,
    },
    /// A photograph in strokes, or separated into pigments.
    Strokes {
        /// Number of strokes of all brushes. This is 0 if the photograph is only separated.
        strokes: u64,
        /// Report of each brush, from the broadest to the finest.
        levels: Vec<LevelReport>,
        /// Colour error of the painting at the scale of the finest brush, if it was painted.
        error: Option<ColorErrors>,
        /// Colour error of the separation, if its maps were written.
        separation_error: Option<ColorErrors>,
    },
    /// Paint volumes at the time of single pictures.
    Volumes {
        /// Time of single pictures in seconds.
        seconds: f64,
        /// Number of volumes.
        volumes: usize,
        /// Number of particles of all volumes.
        particles: usize,
        /// Number of cells over the scene's surface.
        cells: usize,
        /// Amounts of paint.
        paint_mm3: PaintAmounts,
        /// Time in seconds of the snapshot from which an interrupted run continued.
        from_seconds: Option<f64>,
        /// Number of steps of the world that were computed.
        steps_computed: u64,
    },
}

/// Where the paint that was poured over a scene is, in mm3.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct PaintAmounts {
    /// Paint on the scene.
    pub on_scene: f64,
    /// Paint that was lifted.
    pub lifted: f64,
    /// Paint that had no room and stayed in the tube.
    pub in_tube: f64,
}

/// Results of a finished job, without the notes of its run.
pub(crate) struct Summary {
    /// Width and height in pixels, or in cells.
    pub(crate) size: (usize, usize),
    /// Name of the device.
    pub(crate) backend: String,
    pub(crate) technique: TechniqueOutcome,
    /// Number of frames, and the number of these that existed already.
    pub(crate) frames: Option<(usize, usize)>,
    /// Names of the pigments.
    pub(crate) pigments: Vec<String>,
}

#[cfg(test)]
mod tests {
    use super::*;
    use documents::hint::Explain;
    use documents::request::request_from_json;

    fn full() -> PictureRequest {
        let painterly = PainterlyRequest {
            map: vec!["wood=bark.exr".to_owned()],
            loop_frames: Some(48),
            with_pigments: true,
            ..PainterlyRequest::default()
        };
        let view = ViewRequest { width: Some(96), ..ViewRequest::default() };
        let exports = ExportRequest { bits: 16, ..ExportRequest::default() };
        let animation = AnimationRequest { rate: 12.5, ..AnimationRequest::default() };
        let technique = TechniqueRequest::Painterly(painterly);
        let device = Device::Cpu;
        let request = PictureRequest::new("shape:sphere", technique);
        PictureRequest { view, exports, animation, device, ..request }
    }

    #[test]
    fn a_request_is_the_same_after_json() {
        let watercolor = TechniqueRequest::Watercolor(WatercolorRequest::default());
        let brushes_mm = vec![8.0, 0.5];
        let strokes = StrokesRequest { brushes_mm, thin: true, ..StrokesRequest::default() };
        let strokes = TechniqueRequest::Strokes(strokes);
        let pour = vec!["0.5,0.6,200".to_owned()];
        let volumes = VolumesRequest { pour, seconds: Some(0.25), ..VolumesRequest::default() };
        let volumes = TechniqueRequest::Volumes(volumes);
        let [watercolor, strokes, volumes] = [watercolor, strokes, volumes]
            .map(|technique| PictureRequest::new("a photo.jpg", technique));
        for request in [full(), watercolor, strokes, volumes] {
            let json = serde_json::to_string(&request).unwrap();
            assert_eq!(request_from_json::<PictureRequest>(&json).unwrap(), request, "{json}");
        }
        let short = r#"{"subject": "a photo.jpg", "technique": {"watercolor": {"over": null}}}"#;
        let request: PictureRequest = request_from_json(short).unwrap();
        assert_eq!(request.pigments.light(), "D65");
    }

    #[test]
    fn keys_and_words_that_do_not_exist_are_refused_by_name() {
        let of = |rest: &str| format!(r#"{{"subject": "a.jpg", "technique": {rest}}}"#);
        for (json, message, hint) in [
            (
                of(r#"{"watercolor": {"density_masks": "a.png"}}"#),
                "unknown key `density_masks`",
                "did you mean density_mask?",
            ),
            (
                of(r#"{"volumes": {"pours": ["0.5,0.5"]}}"#),
                "unknown key `pours`",
                "did you mean pour?",
            ),
            (
                of(r#"{"painterly": {}}, "exports": {"pictures": "a.png"}"#),
                "unknown key `pictures`",
                "did you mean picture?",
            ),
            (
                of(r#"{"painterly": {}}, "device": "cup""#),
                "device: unknown word `cup`",
                "it takes the words auto, cpu, gpu",
            ),
        ] {
            let error = request_from_json::<PictureRequest>(&json).unwrap_err();
            let hinted = error.hint().unwrap().to_string();
            assert_eq!((error.to_string().as_str(), hinted.as_str()), (message, hint), "{json}");
        }
    }
}
