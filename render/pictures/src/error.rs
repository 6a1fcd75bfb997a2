//! Why a picture cannot be painted.

use std::{error::Error, fmt, io};

use artmap::{
    painted::{PaintedError, StyleError},
    passages::{MarksError, PassageError},
    sample::{FromPaintingError, GuessError, JoinError},
    synthesis::SynthesisError,
    texel_file::TexelFileError,
};
use calibrate::{
    BackingError, BackingTextError,
    library::{LibraryError, RecipeError},
};
use documents::{
    Cancelled,
    file::{FileError, NamedFileError, OutputError},
    hint::{Explain, Fault, Hint},
    request::RequestError,
    settings::SettingsError,
    text::TextError,
};
use graphics::{
    camera::CameraPathError,
    export::{ExportError, FrameError, SequenceError},
    gpu::DeviceError,
    mesh::MeshError,
    picture::PhotographError,
};
use paint::{
    document::PaletteError,
    export::PaintingExportError,
    file::PaintingFileError,
    ground::GroundError,
    light::PaintLightError,
    painting::PaintingError,
    scene::PixelsPerCellError,
    strokes::{ScriptError, ScriptStartError},
    timelapse::TimelapseError,
};
use painterly::{CompositingError, PainterError, RegionsError, guides::GuidesError};
use spectra::ViewingError;
use strokes::{StrokePainterError, StrokeSettingsError};
use volumes::performance::PerformanceError;
use watercolor::WatercolorError;

/// A setting that has another value than it takes, or does not fit the others.
///
/// The message names settings by their keys. A program that shows them in another way, for example as options,
/// calls [`Self::message`].
#[derive(Debug)]
pub struct SettingError {
    /// The settings with which the message begins. Usually this is one, else all that can be at fault.
    keys: Vec<String>,
    /// The rest of the message.
    reason: Hint,
    hint: Option<Hint>,
    fault: Fault,
    cause: Option<Box<dyn Error + Send + Sync>>,
}

impl SettingError {
    /// A message that begins with the setting `key`.
    pub(crate) fn of(key: &str, reason: impl Into<String>, hint: impl Into<String>) -> Self {
        Self { keys: vec![key.to_owned()], ..Self::whole(reason, hint) }
    }

    /// A message that is a whole sentence.
    pub(crate) fn whole(message: impl Into<String>, hint: impl Into<String>) -> Self {
        let reason = Hint::verbatim(message);
        let hint = Some(Hint::new(hint));
        Self { keys: Vec::new(), reason, hint, fault: Fault::Setting, cause: None }
    }

    /// Returns the error with `key` as another setting that can be at fault.
    pub(crate) fn or_of(mut self, key: &str) -> Self {
        self.keys.push(key.to_owned());
        self
    }

    /// Returns the error with another cause than the setting, for example the data that it names.
    pub(crate) fn with_fault(self, fault: Fault) -> Self {
        Self { fault, ..self }
    }

    /// Returns the error with the message `reason`, which names further settings in square
    /// brackets.
    pub(crate) fn naming(self, reason: &str) -> Self {
        Self { reason: Hint::new(reason), ..self }
    }

    /// Returns the error with another hint. The hint names no setting, so square brackets in it
    /// stay as they are.
    pub(crate) fn verbatim(self, hint: impl Into<String>) -> Self {
        Self { hint: Some(Hint::verbatim(hint)), ..self }
    }

    /// An error for the setting `key`. Message and hint are taken from `error`.
    pub(crate) fn as_of(key: &str, error: &impl Explain) -> Self {
        Self { hint: error.hint(), ..Self::of(key, error.to_string(), "") }
    }

    /// An error that begins with no setting. Message and hint are taken from `error`.
    pub(crate) fn as_whole(error: &impl Explain) -> Self {
        Self { hint: error.hint(), ..Self::whole(error.to_string(), "") }
    }

    /// An error for the setting `key`, with another error as its cause.
    pub(crate) fn because(
        key: &str,
        reason: &str,
        cause: impl Explain + Send + Sync + 'static,
    ) -> Self {
        let hint = cause.hint();
        Self { hint, cause: Some(Box::new(cause)), ..Self::of(key, reason, "") }
    }

    /// The setting with which the message begins.
    #[must_use]
    pub fn key(&self) -> Option<&str> {
        self.keys.first().map(String::as_str)
    }

    /// The message with settings as a program shows them, such as options of a command line.
    #[must_use]
    pub fn message(&self, shown: impl Fn(&str) -> String) -> String {
        let reason = self.reason.with_settings(|name, _| shown(name));
        let keys: Vec<String> = self.keys.iter().map(|key| shown(key)).collect();
        match keys.is_empty() {
            true => reason,
            false => format!("{} {reason}", keys.join(" or ")),
        }
    }
}

impl fmt::Display for SettingError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message(str::to_owned))
    }
}

impl Error for SettingError {
    fn source(&self) -> Option<&(dyn Error + 'static)> {
        self.cause.as_deref().map(|cause| -> &(dyn Error + 'static) { cause })
    }
}

impl Explain for SettingError {
    fn hint(&self) -> Option<Hint> {
        self.hint.clone()
    }

    fn fault(&self) -> Fault {
        self.fault
    }
}

impl From<RequestError> for SettingError {
    fn from(error: RequestError) -> Self {
        let hint = error.hint();
        let keys = error.key.into_iter().collect();
        Self { keys, hint, ..Self::whole(error.reason, "") }
    }
}

/// A picture cannot be painted, or one of its files cannot be written.
#[derive(Debug, thiserror::Error, Explain)]
pub enum PictureError {
    /// A setting has another value than it takes.
    #[error(transparent)]
    Setting(#[from] SettingError),
    /// A file states something that cannot be painted.
    #[error("{message}")]
    #[hint("{hint}")]
    Data {
        /// The file, and what is wrong.
        message: String,
        /// The way out.
        hint: &'static str,
    },
    /// A file of settings cannot be read as text.
    #[error(transparent)]
    Text(#[from] TextError),
    /// The task was cancelled.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
    /// A file cannot be read or written.
    #[error(transparent)]
    File(#[from] FileError),
    /// A file names another file that cannot be read, or that it must not name.
    #[error(transparent)]
    Named(#[from] NamedFileError),
    /// An output cannot be written, or would replace a file that must stay.
    #[error(transparent)]
    Output(#[from] OutputError),
    /// There is no such preset, or a file of settings has a fault.
    #[error(transparent)]
    Settings(#[from] SettingsError),
    /// A model cannot be read.
    #[error(transparent)]
    Mesh(#[from] MeshError),
    /// A photograph or another picture cannot be read.
    #[error(transparent)]
    Photograph(#[from] PhotographError),
    /// A path of the camera cannot be read.
    #[error(transparent)]
    CameraPath(#[from] CameraPathError),
    /// The library of pigments cannot be read.
    #[error(transparent)]
    Library(#[from] LibraryError),
    /// The palette does not fit the library.
    #[error(transparent)]
    Palette(#[from] PaletteError),
    /// The measured paper cannot be read.
    #[error(transparent)]
    Paper(BackingTextError),
    /// The paper does not fit the wavelengths of the library.
    #[error(transparent)]
    Backing(#[from] BackingError),
    /// The paper or ground cannot be made.
    #[error(transparent)]
    Ground(#[from] GroundError),
    /// There is no such light.
    #[error(transparent)]
    Viewing(#[from] ViewingError),
    /// The light does not fit the library.
    #[error(transparent)]
    Light(#[from] PaintLightError),
    /// The graphics device cannot be opened.
    #[error(transparent)]
    Device(#[from] DeviceError),
    /// The subject cannot be painted in watercolour.
    #[error(transparent)]
    Watercolor(#[from] WatercolorError),
    /// The subject cannot be painted in the brushwork of a map.
    #[error(transparent)]
    Painterly(#[from] PainterError),
    /// The photograph cannot be painted in strokes, or separated into pigments.
    #[error(transparent)]
    Strokes(Box<StrokePainterError>),
    /// A script of paint volumes cannot be read or written.
    #[error(transparent)]
    VolumeScript(#[from] volumes::script::ScriptError),
    /// A script of paint volumes cannot be played.
    #[error(transparent)]
    Performance(Box<PerformanceError>),
    /// The subject cannot hold paint volumes.
    #[error("{0}: paint cannot be poured over it")]
    #[hint(inner = 1)]
    Scene(String, #[source] Box<PerformanceError>),
    /// A scene with paint volumes cannot be painted.
    #[error(transparent)]
    Volumes(#[from] volumes::painter::PaintingError),
    /// An old snapshot beside the frames of an animation cannot be removed.
    #[error("{0}: this snapshot cannot be removed")]
    #[hint(inner = 1)]
    Snapshot(String, #[source] io::Error),
    /// Layers for compositing cannot be made.
    #[error(transparent)]
    Compositing(#[from] CompositingError),
    /// Regions cannot be read.
    #[error(transparent)]
    Regions(#[from] RegionsError),
    /// Guides cannot be read, or do not fit the subject.
    #[error(transparent)]
    Guides(#[from] GuidesError),
    /// A style of samples cannot be read.
    #[error(transparent)]
    Style(#[from] StyleError),
    /// Samples cannot be painted.
    #[error(transparent)]
    Samples(#[from] PaintedError),
    /// Marks cannot be read.
    #[error(transparent)]
    Marks(#[from] MarksError),
    /// Samples cannot be taken from a picture.
    #[error(transparent)]
    Passages(#[from] PassageError),
    /// A painting cannot be sampled.
    #[error(transparent)]
    FromPainting(#[from] FromPaintingError),
    /// The relief of samples cannot be guessed.
    #[error(transparent)]
    Guess(#[from] GuessError),
    /// Samples of several files do not make one map.
    #[error(transparent)]
    Join(#[from] JoinError),
    /// No map can be made of samples.
    #[error(transparent)]
    Synthesis(#[from] SynthesisError),
    /// A map cannot be read.
    #[error(transparent)]
    Map(#[from] TexelFileError),
    /// The painting cannot be computed.
    #[error(transparent)]
    Painting(#[from] PaintingError),
    /// The files of a painting cannot be made.
    #[error(transparent)]
    PaintingExport(#[from] Box<PaintingExportError>),
    /// A picture cannot be encoded.
    #[error(transparent)]
    Export(#[from] ExportError),
    /// A picture of a stage cannot be encoded.
    #[error(transparent)]
    Frame(#[from] FrameError),
    /// The frames of an animation cannot be written.
    #[error(transparent)]
    Sequence(#[from] SequenceError),
    /// A picture cannot have this number of pixels per cell.
    #[error(transparent)]
    PixelsPerCell(#[from] PixelsPerCellError),
    /// A library has no pigment of this name.
    #[error(transparent)]
    Recipe(#[from] RecipeError),
    /// The library of a script that names none cannot be read.
    #[error("the default library")]
    #[hint(inner)]
    #[fault(inner)]
    DefaultLibrary(#[source] LibraryError),
    /// A stored painting cannot be read or made.
    #[error(transparent)]
    PaintingFile(#[from] PaintingFileError),
    /// A script is invalid.
    #[error(transparent)]
    Script(#[from] ScriptError),
    /// A script cannot begin.
    #[error(transparent)]
    ScriptStart(#[from] ScriptStartError),
    /// A timelapse cannot be made.
    #[error(transparent)]
    Timelapse(Box<TimelapseError>),
    /// A part of the work fails, for example an action of a script.
    #[error("{0}")]
    #[hint(inner = 1)]
    #[fault(inner = 1)]
    Within(String, #[source] Box<PictureError>),
}

impl PictureError {
    /// The error of the part of the work that has this name.
    pub(crate) fn within(self, part: impl Into<String>) -> Self {
        Self::Within(part.into(), Box::new(self))
    }

    /// The error for a path of the camera without a frame.
    pub(crate) fn no_frames() -> Self {
        let message = "the camera path has no frames".to_owned();
        Self::Data { message, hint: "give frames = 60" }
    }
}

impl From<BackingTextError> for PictureError {
    fn from(error: BackingTextError) -> Self {
        match error {
            BackingTextError::Text(error) => Self::Setting(error.at("over").into()),
            error => Self::Paper(error),
        }
    }
}

impl From<PerformanceError> for PictureError {
    fn from(error: PerformanceError) -> Self {
        Self::Performance(Box::new(error))
    }
}

impl From<TimelapseError> for PictureError {
    fn from(error: TimelapseError) -> Self {
        Self::Timelapse(Box::new(error))
    }
}

impl From<StrokePainterError> for PictureError {
    fn from(error: StrokePainterError) -> Self {
        match error {
            StrokePainterError::Settings(error) => error.into(),
            error => Self::Strokes(Box::new(error)),
        }
    }
}

impl From<StrokeSettingsError> for PictureError {
    fn from(error: StrokeSettingsError) -> Self {
        let StrokeSettingsError::OutOfRange { setting, value, least, most } = error else {
            return Self::Strokes(Box::new(error.into()));
        };
        let reason = format!("takes {least} to {most}, found `{value}`");
        let hint = error.hint();
        SettingError { hint, ..SettingError::of(setting, reason, "") }.into()
    }
}
