//! How an error is told: its causes, a hint, and the exit status.

use std::io::Write;

use calibrate::calibration::CalibrationError;
use calibrate::comparison::ComparisonError;
use calibrate::curation::{CurationError, TableError};
use calibrate::fit::FitError;
use calibrate::library::{LibraryError, RecipeError};
use calibrate::matching::{MatchError, PriceError};
use calibrate::measurement::{MeasurementError, RecipesError};
use calibrate::plan::PlanError;
use calibrate::visible_band::BandError;
use calibrate::{BackingError, ColorError, FittingError, ReadingsError};
use render::camera::CameraPathError;
use render::export::{FrameError, PaintingExportError, SequenceError};
use render::gpu::DeviceError;
use render::light::PaintLightError;
use render::mesh::MeshError;
use render::paint::file::PaintingFileError;
use render::paint::ground::GroundError;
use render::paint::painting::PaintingError;
use render::paint::session::SessionError;
use render::paint::strokes::{ScriptError, ScriptStartError};
use render::photograph::{PhotographError, SeparationError, StrokePainterError};
use render::watercolor::{
    GlazeError, ModelPainterError, PaperTextureError, PhotographPainterError, SettingsError,
};
use spectra::hint::{Explain, Fault, Hint};
use spectra::instrument::{ChoiceError, InstrumentError, OpenError};
use spectra::referencing::{ReferenceFilesError, ReferencingError};
use spectra::swatch_file::SwatchFileError;
use spectra::{LampError, LightError};

/// An error of the user's request, with what to try.
#[derive(Debug, thiserror::Error)]
#[error("{what}")]
pub(crate) struct Refusal {
    pub(crate) what: String,
    pub(crate) hint: Option<String>,
    /// 1 if the data says no, 2 if the program could not run.
    pub(crate) status: u8,
}

impl Refusal {
    /// The data says no.
    pub(crate) fn data(what: impl Into<String>, hint: impl Into<String>) -> anyhow::Error {
        Self { what: what.into(), hint: Some(hint.into()), status: 1 }.into()
    }

    /// The program cannot run as asked.
    pub(crate) fn usage(what: impl Into<String>, hint: impl Into<String>) -> anyhow::Error {
        Self { what: what.into(), hint: Some(hint.into()), status: 2 }.into()
    }
}

/// Writes `error:`, the causes and `hint:`, and gives the exit status. A pipe
/// closed by its reader is no error.
pub(crate) fn report(error: &anyhow::Error, err: &mut dyn Write) -> u8 {
    let closed = |cause: &(dyn std::error::Error + 'static)| {
        cause
            .downcast_ref::<std::io::Error>()
            .is_some_and(|io| io.kind() == std::io::ErrorKind::BrokenPipe)
    };
    if error.chain().any(closed) {
        return 0;
    }
    let _ = writeln!(err, "error: {error}");
    for cause in error.chain().skip(1) {
        let _ = writeln!(err, "  because: {cause}");
    }
    if let Some(hint) = error.chain().find_map(hint) {
        let _ = writeln!(err, "hint: {hint}");
    }
    error.chain().find_map(status).unwrap_or(2)
}

/// Writes a hint with its settings as options: `[full_scale=255]` becomes `--full-scale 255`.
pub(crate) fn flags(hint: &Hint) -> String {
    hint.with_settings(|name, value| {
        let option = format!("--{}", name.replace('_', "-"));
        value.map_or_else(|| option.clone(), |value| format!("{option} {value}"))
    })
}

/// The library error that `cause` is, if it is one that explains itself.
fn explained<'a>(cause: &'a (dyn std::error::Error + 'static)) -> Option<&'a dyn Explain> {
    fn as_explained<'a, E: Explain + 'static>(
        cause: &'a (dyn std::error::Error + 'static),
    ) -> Option<&'a dyn Explain> {
        cause.downcast_ref::<E>().map(|error| error as &dyn Explain)
    }
    let known = [
        as_explained::<InstrumentError>,
        as_explained::<OpenError>,
        as_explained::<ReferencingError>,
        as_explained::<ReferenceFilesError>,
        as_explained::<ChoiceError>,
        as_explained::<LampError>,
        as_explained::<LightError>,
        as_explained::<SwatchFileError>,
        as_explained::<ReadingsError>,
        as_explained::<FittingError>,
        as_explained::<MeasurementError>,
        as_explained::<RecipesError>,
        as_explained::<CalibrationError>,
        as_explained::<FitError>,
        as_explained::<ComparisonError>,
        as_explained::<PlanError>,
        as_explained::<LibraryError>,
        as_explained::<RecipeError>,
        as_explained::<ColorError>,
        as_explained::<BackingError>,
        as_explained::<BandError>,
        as_explained::<MatchError>,
        as_explained::<PriceError>,
        as_explained::<CurationError>,
        as_explained::<TableError>,
        as_explained::<PaintingFileError>,
        as_explained::<PaintingError>,
        as_explained::<SessionError>,
        as_explained::<ScriptStartError>,
        as_explained::<ScriptError>,
        as_explained::<PhotographError>,
        as_explained::<MeshError>,
        as_explained::<CameraPathError>,
        as_explained::<FrameError>,
        as_explained::<SequenceError>,
        as_explained::<PaintLightError>,
        as_explained::<GroundError>,
        as_explained::<SeparationError>,
        as_explained::<PaintingExportError>,
        as_explained::<StrokePainterError>,
        as_explained::<DeviceError>,
        as_explained::<SettingsError>,
        as_explained::<PaperTextureError>,
        as_explained::<GlazeError>,
        as_explained::<ModelPainterError>,
        as_explained::<PhotographPainterError>,
    ];
    known.into_iter().find_map(|known| known(cause))
}

fn hint(cause: &(dyn std::error::Error + 'static)) -> Option<String> {
    if let Some(error) = explained(cause) {
        return error.hint().map(|hint| flags(&hint));
    }
    cause.downcast_ref::<Refusal>()?.hint.clone()
}

fn status(cause: &(dyn std::error::Error + 'static)) -> Option<u8> {
    if let Some(refusal) = cause.downcast_ref::<Refusal>() {
        return Some(refusal.status);
    }
    let painting = match cause.downcast_ref() {
        Some(SessionError::Painting(error)) => Some(error),
        _ => cause.downcast_ref::<PaintingError>(),
    };
    if let Some(PaintingError::Engine(_)) = painting {
        return Some(2);
    }
    if let Some(status) = color_status(cause) {
        return Some(status);
    }
    if let Some(error) = explained(cause) {
        let wrong_option =
            matches!(
                cause.downcast_ref(),
                Some(LightError::Unknown { .. } | LightError::Illuminant(_))
            ) || matches!(cause.downcast_ref(), Some(ReferenceFilesError::Setting { .. }))
                || matches!(cause.downcast_ref(), Some(PhotographPainterError::Abstraction(_)))
                || cause.is::<PaintLightError>()
                || cause.is::<FrameError>()
                || cause.is::<SequenceError>();
        return Some(if wrong_option || error.fault() == Fault::Environment { 2 } else { 1 });
    }
    let data = cause.is::<MeasurementError>()
        || cause.is::<RecipesError>()
        || cause.is::<CalibrationError>()
        || cause.is::<ComparisonError>()
        || cause.is::<FitError>()
        || cause.is::<LibraryError>()
        || cause.is::<RecipeError>()
        || cause.is::<CurationError>()
        || cause.is::<TableError>()
        || cause.is::<PaintingError>()
        || cause.is::<SessionError>()
        || cause.is::<ScriptStartError>()
        || cause.is::<ScriptError>()
        || cause.is::<PhotographError>()
        || cause.is::<MeshError>()
        || cause.is::<CameraPathError>();
    data.then_some(1)
}

/// Exit status of errors about fits, mixtures and recipes: 2 where an option is wrong, 1 where the data
/// are.
fn color_status(cause: &(dyn std::error::Error + 'static)) -> Option<u8> {
    let backing = |error: &BackingError| match error {
        BackingError::Reflectance { .. } => 2,
        _ => 1,
    };
    match cause.downcast_ref::<FittingError>() {
        Some(
            FittingError::AbsoluteOptions | FittingError::AbsoluteWith | FittingError::Folds { .. },
        ) => return Some(2),
        Some(_) => return Some(1),
        None => {}
    }
    match cause.downcast_ref::<ReadingsError>() {
        Some(ReadingsError::CsvOfCounts { .. })
        | Some(ReadingsError::References(ReferenceFilesError::Setting { .. })) => return Some(2),
        Some(error) if error.fault() == Fault::Input => return Some(1),
        Some(_) => return Some(2),
        None => {}
    }
    if let Some(error) = cause.downcast_ref::<MatchError>() {
        return Some(match error {
            MatchError::Backing(error) => backing(error),
            MatchError::NoRecipe
            | MatchError::Recipe(_)
            | MatchError::PricedPigment { .. }
            | MatchError::NoPrice { .. }
            | MatchError::Band(_)
            | MatchError::Interpolate(_) => 1,
            _ => 2,
        });
    }
    if let Some(error) = cause.downcast_ref::<ColorError>() {
        return Some(match error {
            ColorError::Thickness { .. } => 2,
            ColorError::Backing(error) => backing(error),
            _ => 1,
        });
    }
    if let Some(error) = cause.downcast_ref::<PlanError>() {
        let of_data = matches!(error, PlanError::Unidentified { .. } | PlanError::Prior(_));
        return Some(if of_data { 1 } else { 2 });
    }
    if let Some(error) = cause.downcast_ref::<PriceError>() {
        let of_data = matches!(error, PriceError::MissingColumn { .. } | PriceError::Price { .. });
        return Some(if of_data { 1 } else { 2 });
    }
    cause
        .downcast_ref::<BackingError>()
        .map(backing)
        .or_else(|| cause.is::<BandError>().then_some(1))
}
