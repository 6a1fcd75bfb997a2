//! A stored painting under another light or with other pigments: the request, its job and its outcome.

use std::path::PathBuf;

use documents::Task;
use graphics::{field::Field, picture_formats::begins_like_picture};
use paint::{
    document::{Document, Lighting},
    engine::PaintEngine,
    file::PaintingFileError,
    layer::{DryLayerState, LayerRef},
    light::Light,
    painting::{Painting, UNDO_BYTES},
};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use spectra::Viewing;

use crate::error::{PictureError, SettingError};
use crate::exports::{ExportRequest, Listener, OpenExports, Written, engine_of};
use crate::request::Device;

/// A stored painting to show under another light, or as if painted with other pigments. [`Self::run`] lights it and
/// writes its files.
///
/// All keys but `painting` have defaults. Without them you see the painting as it was saved. As JSON:
///
/// ```
/// use documents::Task;
/// use documents::request::request_from_json;
/// use paint::{Canvas, PaintingSession};
/// use pictures::RelightRequest;
///
/// let folder = tempfile::tempdir()?;
/// let painting = folder.path().join("small.exr");
/// let oils = calibrate::library::PigmentLibrary::van_gogh_oils();
/// let canvas = Canvas { width_mm: 4.0, height_mm: 3.0, cell_mm: 0.5, ..Canvas::default() };
/// let mut session = PaintingSession::on_canvas(&oils, &canvas)?;
/// session.canvas_mut().document()?.save(&painting)?;
///
/// let evening = folder.path().join("evening.png");
/// let json = format!(
///     r#"{{"painting": {painting:?}, "illuminant": "A", "device": "cpu", "exports": {{"picture": {evening:?}}}}}"#
/// );
/// let outcome = request_from_json::<RelightRequest>(&json)?.run(&Task::default())?;
/// assert_eq!((outcome.canvas, outcome.lighting.illuminant.as_str()), ((8, 6), "A"));
/// assert_eq!(outcome.files, [evening]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(description = "A stored painting under another light, or with other pigments")]
pub struct RelightRequest {
    /// The painting (.exr)
    pub painting: PathBuf,
    /// Light: D65, A, FL11, 5600K, or the file of a lamp [default: the painting's]
    #[serde(default)]
    pub illuminant: Option<String>,
    /// Observer: 1931-2, 1964-10, 2015-2, 2015-10 [default: the painting's]
    #[serde(default)]
    pub observer: Option<String>,
    /// Direction of the light, in degrees clockwise from the top of the canvas, -360 to 360
    /// [default: the painting's]
    #[serde(default)]
    pub azimuth: Option<f64>,
    /// Elevation of the light above the canvas in degrees, 1 to 90 [default: the painting's]
    #[serde(default)]
    pub elevation: Option<f64>,
    /// Fraction of the light that is ambient, from all sides, 0 to 1 [default: the painting's]
    #[serde(default)]
    pub ambient: Option<f64>,
    /// Factor on the heights of the relief, 0 to 10: 0 shades it flat, 1 leaves it unchanged
    /// [default: the painting's]
    #[serde(default)]
    pub relief: Option<f64>,
    /// How far the eye adapted to the light, 0 to 1: with 1 white paint is white under every light, as an
    /// instrument measures; with 0 the light keeps its colour, so that evening looks like evening
    /// [default: the painting's, 1 unless it says so]
    #[serde(default)]
    pub adaptation: Option<f64>,
    /// Pigments to exchange, each as LAYER:FROM=TO. LAYER is `wet`, a number from 0 (the lowest dry
    /// layer), or `all`
    #[serde(default)]
    pub swap: Vec<String>,
    /// Factors on the optical thickness of dry layers, each as LAYER=X. 0 hides the layer
    #[serde(default)]
    pub opacity: Vec<String>,
    /// Files of the painting
    #[serde(default)]
    pub exports: ExportRequest,
    /// Memory for undo in MiB, 0 to 1048576
    #[serde(default = "undo_memory")]
    pub undo_memory: u64,
    /// Device to compute on
    #[serde(default)]
    pub device: Device,
}

impl RelightRequest {
    /// A request that shows the painting as it was saved, and writes nothing.
    #[must_use]
    pub fn new(painting: impl Into<PathBuf>) -> Self {
        Self {
            painting: painting.into(),
            illuminant: None,
            observer: None,
            azimuth: None,
            elevation: None,
            ambient: None,
            relief: None,
            adaptation: None,
            swap: Vec::new(),
            opacity: Vec::new(),
            exports: ExportRequest::default(),
            undo_memory: undo_memory(),
            device: Device::default(),
        }
    }

    /// Opens the painting, lights it, and writes its files. None of them replaces the painting. `task` may end
    /// the work.
    ///
    /// # Errors
    /// [`PictureError`] for a setting that cannot be used, a file that cannot be read or written, and if `task` is
    /// cancelled.
    pub fn run(&self, task: &Task) -> Result<RelightOutcome, PictureError> {
        let mut job = self.open(task)?;
        let floor = &job.document.ground.height;
        let engine = opened_engine(self.device, floor, &mut |note| {
            job.written.pass(note, &mut |_| {});
        })?;
        job.relight(engine, task, &mut |_| {})
    }

    /// Reads the painting and checks the light and the files. Use this if you want to open the engine yourself, or
    /// to hear of each file when it is written.
    ///
    /// # Errors
    /// The errors of [`Self::run`].
    pub fn open(&self, task: &Task) -> Result<RelightJob, PictureError> {
        let undo_bytes = undo_bytes(self.undo_memory)?;
        task.stage("reading the painting");
        task.check()?;
        let mut document =
            Document::open(&self.painting).map_err(|error| self.not_opened(error))?;
        document.lighting = self.lighting(&document.lighting)?;
        let Lighting { illuminant, observer, .. } = &document.lighting;
        let light = Light::new(&document.library, &Viewing::named(illuminant, observer)?)?;
        let exports = self.exports.clone().open(std::slice::from_ref(&self.painting))?;
        let swap = self.swap.clone();
        let opacity = self.opacity.clone();
        let written = Written::default();
        Ok(RelightJob { document, light, swap, opacity, exports, undo_bytes, written })
    }

    /// The error of opening the painting, or that it is a picture.
    fn not_opened(&self, error: PaintingFileError) -> PictureError {
        let is_picture =
            documents::file::read(&self.painting).is_ok_and(|bytes| begins_like_picture(&bytes));
        if !is_picture {
            return error.into();
        }
        let message = format!("{} is a picture, not a painting", self.painting.display());
        let hint = "a painting is an .exr with all layers, as [output=painting.exr] writes it";
        PictureError::Data { message, hint }
    }

    /// The lighting that the request asks for. Without a key, this is the `saved` value of the painting.
    fn lighting(&self, saved: &Lighting) -> Result<Lighting, SettingError> {
        Ok(Lighting {
            illuminant: self.illuminant.clone().unwrap_or_else(|| saved.illuminant.clone()),
            observer: self.observer.clone().unwrap_or_else(|| saved.observer.clone()),
            azimuth_deg: number("azimuth", self.azimuth, saved.azimuth_deg, [-360.0, 360.0])?,
            elevation_deg: number("elevation", self.elevation, saved.elevation_deg, [1.0, 90.0])?,
            ambient: number("ambient", self.ambient, saved.ambient, [0.0, 1.0])?,
            relief: number("relief", self.relief, saved.relief, [0.0, 10.0])?,
            adaptation: number("adaptation", self.adaptation, saved.adaptation, [0.0, 1.0])?,
        })
    }
}

/// The default of `undo_memory`.
pub(crate) fn undo_memory() -> u64 {
    UNDO_BYTES >> 20
}

/// Memory for undo in bytes.
pub(crate) fn undo_bytes(mebibytes: u64) -> Result<u64, SettingError> {
    if mebibytes > 1 << 20 {
        let reason = format!("takes 0 to 1048576 MiB, found `{mebibytes}`");
        return Err(SettingError::of("undo_memory", reason, "try [undo_memory=512]"));
    }
    Ok(mebibytes << 20)
}

/// Opens a paint engine over the ground heights `floor`. If a device cannot hold the canvas, [`Device::Auto`] takes
/// the processor instead, and the listener hears a warning.
pub(crate) fn opened_engine(
    device: Device,
    floor: &Field<i32>,
    listener: &mut Listener<'_>,
) -> Result<PaintEngine, PictureError> {
    Ok(engine_of(PaintEngine::open(device.into(), floor)?, listener))
}

/// The number of the key `name`, or the number `saved` if the request does not have this key.
fn number(
    name: &str,
    requested: Option<f64>,
    saved: f64,
    [least, most]: [f64; 2],
) -> Result<f64, SettingError> {
    match requested {
        Some(value) if !(least..=most).contains(&value) => {
            let reason = format!("takes {least} to {most}, found `{value}`");
            let hint = format!("leave [{name}] out to keep the painting's own value");
            Err(SettingError::of(name, reason, hint))
        }
        requested => Ok(requested.unwrap_or(saved)),
    }
}

/// A painting that can be lit: its file was read, and its outputs can be written.
#[derive(Debug)]
pub struct RelightJob {
    document: Document,
    light: Light,
    swap: Vec<String>,
    opacity: Vec<String>,
    exports: OpenExports,
    undo_bytes: u64,
    written: Written,
}

impl RelightJob {
    /// Heights of the ground in quanta. Open the engine over these.
    #[must_use]
    pub fn floor(&self) -> &Field<i32> {
        &self.document.ground.height
    }

    /// Lights the painting on `engine`, which you opened over [`Self::floor`], and writes the files.
    ///
    /// # Errors
    /// The errors of [`RelightRequest::run`].
    pub fn relight(
        self,
        engine: PaintEngine,
        task: &Task,
        listener: &mut Listener<'_>,
    ) -> Result<RelightOutcome, PictureError> {
        let Self { document, light, swap, opacity, exports, undo_bytes, mut written } = self;
        task.stage("lighting the painting");
        task.check()?;
        let mut painting = Painting::open_under(document, light, engine, undo_bytes)?;
        swap.iter().try_for_each(|text| exchange(&mut painting, text))?;
        opacity.iter().try_for_each(|text| set_opacity(&mut painting, text))?;
        exports.write(&mut painting, task, &mut |note| written.pass(note, listener))?;
        let bounds = painting.bounds();
        let Written { remarks, files, streamed } = written;
        Ok(RelightOutcome {
            canvas: (bounds.width, bounds.height),
            cell_mm: painting.cell_mm(),
            layers: layers_of(&painting)?,
            lighting: painting.state().lighting.clone(),
            wavelengths_nm: painting.light().quadrature.rule.nodes_nm.clone(),
            remarks,
            files,
            streamed,
        })
    }
}

/// Replaces a pigment by another as `LAYER:FROM=TO` says.
fn exchange(painting: &mut Painting, text: &str) -> Result<(), PictureError> {
    let Some((layer, from, to)) = text
        .split_once(':')
        .and_then(|(layer, names)| names.split_once('=').map(|(from, to)| (layer, from, to)))
    else {
        return Err(swap_error(text).into());
    };
    let from = painting.library().find(from)?;
    let to = painting.library().find(to)?;
    let layers = match layer.trim() {
        "wet" => vec![LayerRef::Wet],
        "all" => {
            let dry = (0..painting.state().dry.len()).map(LayerRef::Dry);
            let mut all: Vec<LayerRef> = dry.chain([LayerRef::Wet]).collect();
            all.retain(|layer| painting.slots(*layer).is_ok_and(|s| s.contains(&Some(from))));
            if all.is_empty() {
                let message = format!("no layer has {}", painting.library()[from].name);
                let hint = "impasto relight PAINTING lists the pigments of each layer";
                return Err(PictureError::Data { message, hint });
            }
            all
        }
        number => vec![LayerRef::Dry(number.parse().map_err(|_| swap_error(text))?)],
    };
    for layer in layers {
        painting.swap_pigment(layer, from, to)?;
    }
    Ok(())
}

fn swap_error(text: &str) -> SettingError {
    let reason = format!("takes LAYER:FROM=TO, found `{text}`");
    SettingError::of("swap", reason, "try [swap=\"all:Emerald Green=Viridian\"]")
}

/// Sets the opacity of a dry layer as `LAYER=X` says.
fn set_opacity(painting: &mut Painting, text: &str) -> Result<(), PictureError> {
    let parts = text.split_once('=').and_then(|(layer, value)| {
        let layer = layer.trim().parse::<usize>().ok()?;
        Some((layer, value.trim().parse::<f64>().ok()?))
    });
    let Some((layer, value)) = parts else {
        let reason = format!("takes LAYER=X, found `{text}`");
        return Err(SettingError::of("opacity", reason, "try [opacity=0=0.5]").into());
    };
    Ok(painting.set_opacity(LayerRef::Dry(layer), value)?)
}

/// A painting that was lit, with its layers.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct RelightOutcome {
    /// Width and height in cells.
    pub canvas: (usize, usize),
    /// Width of a cell.
    pub cell_mm: f64,
    /// The dry layers from the lowest, then the wet paint.
    pub layers: Vec<LayerOutcome>,
    /// The light that the painting is seen under.
    pub lighting: Lighting,
    /// Wavelengths at which its light is computed.
    pub wavelengths_nm: Vec<f64>,
    /// Remarks on colours that a file cannot hold.
    #[serde(skip)]
    pub remarks: Vec<String>,
    /// Files and folders that were written, in the order in which they were written.
    #[serde(skip)]
    pub files: Vec<PathBuf>,
    /// The content of a file with the path `-`.
    #[serde(skip)]
    pub streamed: Option<Vec<u8>>,
}

/// A layer of a painting.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct LayerOutcome {
    /// `dry 0` for the lowest dry layer, or `wet`.
    pub layer: String,
    /// Factor of the optical thickness.
    pub opacity: f64,
    /// Names of its pigments.
    pub pigments: Vec<String>,
    /// Values that only dry layers have.
    #[serde(flatten)]
    pub dry: Option<DryLayerOutcome>,
}

/// Identity and name of a dry layer.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct DryLayerOutcome {
    /// Number of the layer. It does not change if layers are added or moved.
    pub id: u32,
    /// Name of the layer. Empty if it has none.
    pub name: String,
    /// Whether the layer is shown.
    pub visible: bool,
}

fn layers_of(painting: &Painting) -> Result<Vec<LayerOutcome>, PictureError> {
    let mut layers = Vec::new();
    for (index, dry) in painting.state().dry.iter().enumerate() {
        let DryLayerState { id, name, visible, opacity, .. } = dry;
        layers.push(LayerOutcome {
            layer: format!("dry {index}"),
            opacity: *opacity,
            pigments: pigments_of(painting, LayerRef::Dry(index))?,
            dry: Some(DryLayerOutcome { id: id.0, name: name.clone(), visible: *visible }),
        });
    }
    let pigments = pigments_of(painting, LayerRef::Wet)?;
    layers.push(LayerOutcome { layer: "wet".to_owned(), opacity: 1.0, pigments, dry: None });
    Ok(layers)
}

fn pigments_of(painting: &Painting, layer: LayerRef) -> Result<Vec<String>, PictureError> {
    let slots = painting.slots(layer)?;
    let names = slots.iter().flatten().map(|&pigment| painting.library()[pigment].name.clone());
    Ok(names.collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use calibrate::library::PigmentLibrary;
    use documents::hint::Explain;
    use documents::request::request_from_json;
    use paint::{Canvas, PaintingSession};

    /// A bare canvas of 8 x 6 cells as a file.
    fn stored(folder: &std::path::Path) -> RelightRequest {
        let path = folder.join("small.exr");
        let canvas = Canvas { width_mm: 4.0, height_mm: 3.0, cell_mm: 0.5, ..Canvas::default() };
        let oils = PigmentLibrary::van_gogh_oils();
        let mut session = PaintingSession::on_canvas(&oils, &canvas).unwrap();
        session.canvas_mut().document().unwrap().save(&path).unwrap();
        RelightRequest { device: Device::Cpu, ..RelightRequest::new(path) }
    }

    #[test]
    fn a_painting_is_relit_and_its_outcome_has_the_layers() {
        let folder = tempfile::tempdir().unwrap();
        let request = stored(folder.path());
        let day = folder.path().join("day.png");
        let evening = folder.path().join("evening.png");
        let lit = |illuminant: &str, picture: &PathBuf| {
            let mut request = request.clone();
            request.illuminant = Some(illuminant.to_owned());
            request.adaptation = Some(0.0);
            request.exports.picture = Some(picture.clone());
            request.run(&Task::default()).unwrap()
        };
        lit("D65", &day);
        let outcome = lit("A", &evening);
        assert_eq!(outcome.files, std::slice::from_ref(&evening));
        assert!(std::fs::read(&day).unwrap() != std::fs::read(&evening).unwrap(), "one light");
        let json = serde_json::to_value(&outcome).unwrap();
        let keys: Vec<&String> = json.as_object().unwrap().keys().collect();
        assert_eq!(keys, ["canvas", "cell_mm", "layers", "lighting", "wavelengths_nm"]);
        let wet = &json["layers"][0];
        assert_eq!((&wet["layer"], wet.get("id")), (&serde_json::json!("wet"), None));
    }

    #[test]
    fn a_picture_is_told_from_a_painting() {
        let folder = tempfile::tempdir().unwrap();
        let picture = folder.path().join("photo.jpg");
        for (bytes, message) in [
            (&b"\xff\xd8\xff\xe0 a picture"[..], "photo.jpg is a picture, not a painting"),
            (b"text", "not an intact OpenEXR file"),
        ] {
            std::fs::write(&picture, bytes).unwrap();
            let error = RelightRequest::new(&picture).run(&Task::default()).unwrap_err();
            assert!(error.to_string().contains(message), "{error}");
        }
    }

    #[test]
    fn refused_requests_name_the_key_and_the_way_out() {
        let folder = tempfile::tempdir().unwrap();
        let request = stored(folder.path());
        type Change = fn(&mut RelightRequest);
        let changes: [(Change, &str, &str); 6] = [
            (|r| r.elevation = Some(0.5), "elevation takes 1 to 90, found `0.5`", "`elevation`"),
            (|r| r.relief = Some(f64::NAN), "relief takes 0 to 10, found `NaN`", "`relief`"),
            (|r| r.swap = vec!["all".into()], "swap takes LAYER:FROM=TO, found `all`", "`swap = "),
            (|r| r.opacity = vec!["0".into()], "opacity takes LAYER=X, found `0`", "`opacity = "),
            (|r| r.undo_memory = 1 << 30, "undo_memory takes 0 to 1048576 MiB", "`undo_memory = "),
            (|r| r.exports.picture = Some(r.painting.clone()), "an input file", "another file"),
        ];
        for (change, message, hint) in changes {
            let mut changed = request.clone();
            change(&mut changed);
            let error = changed.run(&Task::default()).unwrap_err();
            let hinted = error.hint().unwrap().to_string();
            assert!(error.to_string().contains(message), "{error} for {message}");
            assert!(hinted.contains(hint), "{hinted} for {hint}");
        }
        let json = r#"{"painting": "a.exr", "illuminants": "A"}"#;
        let error = request_from_json::<RelightRequest>(json).unwrap_err();
        assert_eq!(error.to_string(), "unknown key `illuminants`");
        let json = serde_json::to_string(&request).unwrap();
        assert_eq!(request_from_json::<RelightRequest>(&json).unwrap(), request, "{json}");
    }
}
