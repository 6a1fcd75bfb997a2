//! Files of a picture or a painting, with what a program hears while they are written.

use std::path::{Path, PathBuf};

use calibrate::Remark;
use documents::{
    Task,
    file::{Output, OutputFolder, is_stream, write_whole},
    hint::Explain,
};
use graphics::{
    encoding::over_white,
    export::{OutsideGamut, PictureFormat, frame_of, frame_png, picture_file},
    field::Field,
};
use paint::{
    engine::{OpenedEngine, PaintEngine},
    export::{PaintingExports, SpectralBands},
    painting::Painting,
    scene::PixelsPerCell,
    technique::Stage,
};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::error::{PictureError, SettingError};

/// Something that happens while a picture is painted.
#[derive(Debug, Clone, PartialEq)]
pub enum Note {
    /// Something that was read or chosen, or that did not go as you may expect, for example colours outside the
    /// gamut of a file.
    Remark(Remark),
    /// The library of pigments that was read.
    Library {
        /// The file that it was read from.
        path: PathBuf,
        /// Number of its pigments.
        pigments: usize,
    },
    /// A file or folder that was written.
    Wrote(PathBuf),
    /// The content of a file that goes to the output of the program, because its path is `-`.
    Streamed(Vec<u8>),
}

/// Files that a job wrote, and its remarks.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Written {
    /// Remarks on what was read or chosen, and on colours that a file cannot hold.
    pub remarks: Vec<String>,
    /// Files and folders that were written, each once, in their order.
    pub files: Vec<PathBuf>,
    /// The content of a file with the path `-`.
    pub streamed: Option<Vec<u8>>,
}

/// Hears each [`Note`] when it happens.
pub type Listener<'a> = dyn FnMut(Note) + 'a;

impl Written {
    /// Adds a note and passes it on.
    pub(crate) fn pass(&mut self, note: Note, listener: &mut Listener<'_>) {
        match &note {
            Note::Remark(remark) => self.remarks.push(remark.to_string()),
            Note::Library { .. } => {}
            Note::Wrote(path) if self.files.contains(path) => {}
            Note::Wrote(path) => self.files.push(path.clone()),
            Note::Streamed(content) => self.streamed = Some(content.clone()),
        }
        listener(note);
    }
}

/// Wavelengths of a spectral picture.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Bands {
    /// The eight wavelengths at which the picture is computed
    #[default]
    Nodes,
    /// All wavelengths of the library, computed again in double precision
    Full,
}

/// Files that a picture or painting is exported to.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct ExportRequest {
    /// Write a picture (.png, .tif), the layers (.ora), or the painting itself with all its layers, so
    /// that it can be changed later (.exr). With - a PNG goes to the output of the program
    pub output: Vec<PathBuf>,
    /// Write the picture: .png (sRGB), .tif (sRGB, 16 bits) or .exr (linear sRGB, as computed)
    pub picture: Option<PathBuf>,
    /// Bits of a channel of a PNG picture: 8 or 16
    pub bits: u8,
    /// Pixels of the picture along the width of a cell, 1 to 4. With 2 or more you no longer see
    /// the cells, and the relief is lit between their centres too
    pub supersample: u8,
    /// Write the layers for programs that paint in layers: OpenRaster (.ora) of 16 bits, with the
    /// ground, each dry layer and the wet paint. In this order and with normal
    /// opacity they show the picture. Real films do not mix by opacity, so another order or mode does
    /// not look like paint
    pub layers: Option<PathBuf>,
    /// Write a spectral OpenEXR: the reflectance of every cell, without relief and gloss
    pub spectral: Option<PathBuf>,
    /// Wavelengths of `spectral`
    pub bands: Bands,
    /// Write a map of each pigment into this folder (16-bit PNG, the scale in JSON, the
    /// amounts in CSV), summed over all layers
    pub pigment_maps: Option<PathBuf>,
}

impl Default for ExportRequest {
    fn default() -> Self {
        Self {
            output: Vec::new(),
            picture: None,
            bits: 8,
            supersample: 1,
            layers: None,
            spectral: None,
            bands: Bands::default(),
            pigment_maps: None,
        }
    }
}

/// Kind of a file that `output` names, by its ending.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Kind {
    Picture,
    Layers,
    Painting,
}

impl Kind {
    /// The kind of a file, `None` for other endings. Without a name it is a picture.
    fn of(path: &Path) -> Option<Self> {
        if is_stream(path) {
            return Some(Self::Picture);
        }
        let ending = path.extension()?.to_string_lossy().to_lowercase();
        match ending.as_str() {
            "png" | "tif" | "tiff" => Some(Self::Picture),
            "ora" => Some(Self::Layers),
            "exr" => Some(Self::Painting),
            _ => None,
        }
    }
}

/// Export files that were checked to be writable.
#[derive(Debug)]
pub struct OpenExports {
    request: ExportRequest,
    picture: Option<Output>,
    layers: Option<Output>,
    spectral: Option<Output>,
    painting: Option<Output>,
    pigment_maps: Option<OutputFolder>,
}

impl ExportRequest {
    /// Whether any export is requested.
    #[must_use]
    pub fn any(&self) -> bool {
        self.picture.is_some()
            || self.layers.is_some()
            || self.spectral.is_some()
            || self.pigment_maps.is_some()
            || !self.output.is_empty()
    }

    /// Whether `output` names a file of this kind.
    fn has(&self, kind: Kind) -> bool {
        self.output.iter().any(|path| Kind::of(path) == Some(kind))
    }

    /// The file of this kind, from its own key or from `output`. An error if several files are of
    /// this kind.
    fn one(&self, kind: Kind, own: Option<&PathBuf>) -> Result<Option<PathBuf>, SettingError> {
        let named = self.output.iter().filter(|path| Kind::of(path) == Some(kind));
        let all: Vec<&PathBuf> = own.into_iter().chain(named).collect();
        match all[..] {
            [] => Ok(None),
            [one] => Ok(Some(one.clone())),
            [first, second, ..] => Err(SettingError::whole(
                format!("{} and {} are of one kind", first.display(), second.display()),
                "write one of them, and the other in a second run",
            )),
        }
    }

    /// Checks that the ending of every file in `output` names a kind, and that a picture can have
    /// `bits` bits per channel.
    fn check(&self) -> Result<(), SettingError> {
        if ![8, 16].contains(&self.bits) {
            let reason = format!("takes 8 or 16, found `{}`", self.bits);
            return Err(SettingError::of("bits", reason, "8 is usual"));
        }
        let Some(path) = self.output.iter().find(|path| Kind::of(path).is_none()) else {
            return Ok(());
        };
        let message = format!(
            "{}: expected a file name that ends in .png, .tif, .ora or .exr",
            path.display()
        );
        Err(SettingError::whole(message, "").verbatim(format!(
            "try {} for a picture, or {} for the painting",
            path.with_extension("png").display(),
            path.with_extension("exr").display()
        )))
    }

    /// The first key that needs layers of pigments, not only a picture.
    #[must_use]
    pub fn key_of_layers(&self) -> Option<&'static str> {
        let keys = [
            ("supersample", self.supersample != 1),
            ("layers", self.layers.is_some()),
            ("output", self.has(Kind::Layers)),
            ("spectral", self.spectral.is_some()),
            ("pigment_maps", self.pigment_maps.is_some()),
            ("output", self.has(Kind::Painting)),
        ];
        keys.into_iter().find(|(_, present)| *present).map(|(key, _)| key)
    }

    /// Checks, before long work, that all files can be written and are none of `inputs`.
    ///
    /// # Errors
    /// [`PictureError`] for a file that cannot be written, and for two files of the same kind.
    pub fn open(self, inputs: &[PathBuf]) -> Result<OpenExports, PictureError> {
        self.check()?;
        let named = self.one(Kind::Picture, self.picture.as_ref())?;
        if named.is_none() && self.supersample != 1 {
            let hint = "add [output=FILE.png]";
            return Err(SettingError::of("supersample", "is of a picture", hint).into());
        }
        let picture = opened(named.as_ref(), &["png", "tif", "tiff", "exr"], inputs)?;
        let layers = self.one(Kind::Layers, self.layers.as_ref())?;
        let layers = opened(layers.as_ref(), &["ora"], inputs)?;
        let spectral = opened(self.spectral.as_ref(), &["exr"], inputs)?;
        let painting = opened(self.one(Kind::Painting, None)?.as_ref(), &["exr"], inputs)?;
        let all = [&picture, &layers, &spectral, &painting];
        let all: Vec<&Output> = all.into_iter().flatten().collect();
        for (index, output) in all.iter().enumerate() {
            if all[..index].iter().any(|other| output.is_same_as(other)) {
                let message =
                    format!("{}: two exports have this file name", output.path().display());
                let hint = "give each export its own file name";
                return Err(SettingError::whole(message, hint).into());
            }
        }
        let maps = self.pigment_maps.as_deref();
        let pigment_maps = maps.map(|folder| OutputFolder::open(folder, inputs)).transpose()?;
        if let Some(folder) = &pigment_maps {
            folder.check(["painting.csv".to_owned()])?;
        }
        Ok(OpenExports { picture, layers, spectral, painting, pigment_maps, request: self })
    }
}

/// The output at `path`, checked to be writable, with one of these endings.
pub(crate) fn opened(
    path: Option<&PathBuf>,
    endings: &[&'static str],
    inputs: &[PathBuf],
) -> Result<Option<Output>, PictureError> {
    Ok(path.map(|path| Output::with_ending(path, endings, inputs)).transpose()?)
}

impl OpenExports {
    /// Whether any export is requested.
    #[must_use]
    pub fn any(&self) -> bool {
        self.request.any()
    }

    /// Whether `other` is one of the export files.
    #[must_use]
    pub fn writes(&self, other: &Output) -> bool {
        let all = [&self.picture, &self.layers, &self.spectral, &self.painting];
        all.into_iter().flatten().any(|output| output.is_same_as(other))
    }

    /// Writes only the picture, from linear sRGB.
    ///
    /// # Errors
    /// [`PictureError`] for a picture that cannot be encoded or written.
    pub fn write_picture(
        self,
        picture: &Field<[f32; 4]>,
        cell_mm: f64,
        listener: &mut Listener<'_>,
    ) -> Result<(), PictureError> {
        let Some(output) = self.picture else { return Ok(()) };
        let format = format_of(self.request.bits, output.path());
        let file = picture_file(picture, cell_mm, format)?;
        if let Some(outside) = file.outside_gamut() {
            listener(Note::Remark(gamut_remark(output.path(), outside)));
        }
        write(&output, file.bytes, listener)
    }

    /// Computes all exports of `painting` and writes their files.
    ///
    /// # Errors
    /// [`PictureError`] for a file that cannot be made or written, and if `task` is cancelled.
    pub fn write(
        self,
        painting: &mut Painting,
        task: &Task,
        listener: &mut Listener<'_>,
    ) -> Result<(), PictureError> {
        task.stage("making the files");
        task.check()?;
        let ExportRequest { bits, bands, pigment_maps, supersample, .. } = self.request;
        if let Some(folder) = &self.pigment_maps {
            folder.make()?;
        }
        let bands = match bands {
            Bands::Nodes => SpectralBands::Nodes,
            Bands::Full => SpectralBands::Full,
        };
        let picture = self.picture.as_ref().map(path_of);
        let exports = PaintingExports {
            picture: picture.map(|path| (path.clone(), format_of(bits, &path))),
            pixels_per_cell: PixelsPerCell::new(supersample)?,
            layers: self.layers.as_ref().map(path_of),
            spectral: self.spectral.as_ref().map(|output| (path_of(output), bands)),
            pigment_maps,
            painting: self.painting.as_ref().map(path_of),
        };
        let mut streamed = Vec::new();
        let mut wrote = Vec::new();
        let made = exports.write_with(painting, &mut |path: &Path, bytes: &[u8]| {
            if is_stream(path) {
                streamed.push(bytes.to_vec());
                return Ok(());
            }
            wrote.push(path.to_owned());
            write_whole(path, bytes)
        });
        let outside = made.map_err(Box::new)?;
        streamed.into_iter().for_each(|bytes| listener(Note::Streamed(bytes)));
        if let Some(folder) = &exports.pigment_maps {
            wrote.retain(|path| path.parent() != Some(folder));
            wrote.push(folder.clone());
        }
        wrote.into_iter().for_each(|path| listener(Note::Wrote(path)));
        let picture = exports.picture.as_ref().map(|(path, _)| path);
        if let (Some(path), Some(outside)) = (picture.or(exports.layers.as_ref()), outside) {
            listener(Note::Remark(gamut_remark(path, outside)));
        }
        Ok(())
    }
}

fn path_of(output: &Output) -> PathBuf {
    output.path().to_owned()
}

/// Replaces the file of an output, or hands it over if it goes to the output of the program.
pub(crate) fn write(
    output: &Output,
    content: Vec<u8>,
    listener: &mut Listener<'_>,
) -> Result<(), PictureError> {
    if output.is_stream() {
        listener(Note::Streamed(content));
        return Ok(());
    }
    output.put(content)?;
    listener(Note::Wrote(path_of(output)));
    Ok(())
}

/// File format of a picture at `path`. The extension decides and, for PNG, the number of `bits`.
fn format_of(bits: u8, path: &Path) -> PictureFormat {
    match (PictureFormat::from_path(path), bits) {
        (Some(format @ (PictureFormat::LinearExr | PictureFormat::Tiff16)), _) => format,
        (_, 16) => PictureFormat::Png16,
        _ => PictureFormat::Png8,
    }
}

/// Remark on the colours of the picture at `path` that were outside its gamut.
#[must_use]
pub fn gamut_remark(path: &Path, outside: OutsideGamut) -> Remark {
    let remark = Remark::note(format!("{}: {outside}", path.display()));
    Remark { hint: outside.hint(), ..remark }
}

/// The engine that was opened. If it paints on the processor because a device cannot hold the canvas, the listener
/// hears a warning.
pub(crate) fn engine_of(opened: OpenedEngine, listener: &mut Listener<'_>) -> PaintEngine {
    let OpenedEngine { engine, device_error } = opened;
    if let Some(error) = device_error {
        let text = format!("{error}; painting on the processor");
        listener(Note::Remark(Remark::warning(text)));
    }
    engine
}

/// Width of a pixel in mm, for pictures that are only looked at: 96 pixels per inch.
pub const PX_MM: f64 = 25.4 / 96.0;

/// A folder that you can write stages to. We create it when we write the first stage.
#[derive(Debug)]
pub struct StageFolder(OutputFolder);

impl StageFolder {
    /// Checks that files in the folder can be written.
    ///
    /// # Errors
    /// [`PictureError::Output`] if they cannot.
    pub fn open(folder: &Path, inputs: &[PathBuf]) -> Result<Self, PictureError> {
        let folder = OutputFolder::open(folder, inputs)?;
        folder.check([stage_name(1, "stage")])?;
        Ok(Self(folder))
    }

    /// The folder as the user gave it.
    #[must_use]
    pub fn path(&self) -> &Path {
        self.0.path()
    }

    /// Outputs of stages of these names, numbered from 1. All are opened first, so that nothing is
    /// written if one cannot be.
    ///
    /// # Errors
    /// [`PictureError::Output`] if a file or the folder cannot be written.
    pub fn outputs<'a>(
        &self,
        names: impl Iterator<Item = &'a str>,
    ) -> Result<Vec<Output>, PictureError> {
        Ok(self.0.outputs((1..).zip(names).map(|(number, name)| stage_name(number, name)))?)
    }

    /// Writes the stages.
    ///
    /// # Errors
    /// [`PictureError`] if a stage cannot be encoded or written.
    pub fn write(&self, stages: &[Stage], listener: &mut Listener<'_>) -> Result<(), PictureError> {
        let outputs = self.outputs(stages.iter().map(|stage| stage.name.as_str()))?;
        for (output, stage) in outputs.into_iter().zip(stages) {
            output.put(frame_png(&frame_of(&over_white(&stage.picture)))?)?;
        }
        listener(Note::Wrote(self.path().to_owned()));
        Ok(())
    }
}

fn stage_name(number: usize, name: &str) -> String {
    format!("{number:02}-{name}.png")
}

/// A folder for frames, each as its own file. We have checked that you can write all of them.
#[derive(Debug)]
pub(crate) struct FrameFolder {
    folder: OutputFolder,
    ending: &'static str,
    frames: usize,
}

impl FrameFolder {
    /// Checks that the frames can be written, and that the folder has no frame with a higher number. Such
    /// a frame would belong to another animation.
    pub(crate) fn open(
        folder: &Path,
        ending: &'static str,
        frames: usize,
        inputs: &[PathBuf],
    ) -> Result<Self, PictureError> {
        let folder = OutputFolder::open(folder, inputs)?;
        let beyond = folder.file(&frame_name(frames, ending));
        if beyond.exists() {
            let message = format!("{}: a frame of another animation", beyond.display());
            let hint = "name an empty folder, or remove its frames";
            return Err(SettingError::whole(message, hint).into());
        }
        folder.check((0..frames).map(|index| frame_name(index, ending)))?;
        Ok(Self { folder, ending, frames })
    }

    /// Writes the frames in order, each as a whole. We make the folder when the first frame is ready.
    pub(crate) fn write(
        self,
        task: &Task,
        listener: &mut Listener<'_>,
        mut frame: impl FnMut(usize) -> Result<Vec<u8>, PictureError>,
    ) -> Result<(), PictureError> {
        for index in 0..self.frames {
            task.check()?;
            let content = frame(index)?;
            self.folder.make()?;
            self.folder.output(&frame_name(index, self.ending))?.put(content)?;
        }
        listener(Note::Wrote(self.folder.path().to_owned()));
        Ok(())
    }
}

/// Name of the file of a frame. Indices count from 0, names from 1.
pub(crate) fn frame_name(index: usize, ending: &str) -> String {
    format!("frame-{:04}.{ending}", index + 1)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn to(picture: &Path) -> ExportRequest {
        ExportRequest { picture: Some(picture.to_owned()), ..ExportRequest::default() }
    }

    #[test]
    fn two_files_of_one_kind_and_other_endings_are_refused() {
        let folder = tempfile::tempdir().unwrap();
        let path = |name: &str| folder.path().join(name);
        let twice = ExportRequest { output: vec![path("b.tif")], ..to(&path("a.png")) };
        let error = twice.open(&[]).unwrap_err().to_string();
        assert!(error.ends_with("b.tif are of one kind"), "{error}");
        let other = ExportRequest { output: vec![path("b.jpg")], ..to(&path("a.png")) };
        let error = other.open(&[]).unwrap_err();
        assert!(error.hint().unwrap().to_string().contains("b.exr for the painting"), "{error}");
        let bits = ExportRequest { bits: 12, ..to(&path("a.png")) };
        assert_eq!(bits.open(&[]).unwrap_err().to_string(), "bits takes 8 or 16, found `12`");
        assert!(!path("a.png").exists(), "a check writes nothing");
    }

    #[test]
    fn layers_need_pigments_and_a_picture_needs_none() {
        let painting = ExportRequest { output: vec!["a.EXR".into()], ..to(Path::new("a.png")) };
        assert_eq!(painting.key_of_layers(), Some("output"));
        assert_eq!(to(Path::new("a.exr")).key_of_layers(), None);
        let fine = ExportRequest { supersample: 2, ..to(Path::new("a.png")) };
        assert_eq!(fine.key_of_layers(), Some("supersample"));
    }

    #[test]
    fn a_picture_for_the_output_is_handed_over() {
        let exports = to(Path::new("-")).open(&[]).unwrap();
        let mut notes = Vec::new();
        let picture = Field::filled(2, 2, [0.5, 0.5, 0.5, 1.0]);
        exports.write_picture(&picture, PX_MM, &mut |note| notes.push(note)).unwrap();
        let [Note::Streamed(bytes)] = &notes[..] else { panic!("{notes:?}") };
        assert!(bytes.starts_with(b"\x89PNG"), "{bytes:?}");
    }
}
