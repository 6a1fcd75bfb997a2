//! The description of a file: JSON in attribute `impasto`, with the pigment library.

use std::sync::Arc;

use paint::file::{PigmentChannel, ascii_json, slots_of_channels};
use pigment::PigmentLibrary;
use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_json::Value;

use super::error::TexelFileError;
use super::kind::{Origin, TexelFileKind};
use crate::texel::PaintOfSamples;

/// Encodes a description as JSON in ASCII.
///
/// # Errors
/// [`TexelFileError::Unwritable`] if it cannot be serialised.
pub(crate) fn encoded(
    kind: &TexelFileKind,
    description: &impl Serialize,
) -> Result<String, TexelFileError> {
    ascii_json(description).map_err(|error| kind.unwritable(error.to_string()))
}

/// Parses a description after its keys `format` and `version` were found to be those of the kind.
///
/// # Errors
/// [`TexelFileError`] for another format or version, and for text that is no such description.
pub(crate) fn decoded<T: DeserializeOwned>(
    origin: Origin<'_>,
    json: &str,
) -> Result<T, TexelFileError> {
    let value: Value =
        serde_json::from_str(json).map_err(|error| origin.header(error.to_string()))?;
    let format = &value["format"];
    let version = &value["version"];
    if *format != origin.kind.format {
        let wanted = origin.kind.format;
        return Err(origin.other_format(format!("`format` must be \"{wanted}\", found `{format}`")));
    }
    if *version != origin.kind.version {
        return Err(origin.other_version(version.to_string()));
    }
    serde_json::from_value(value).map_err(|error| origin.header(error.to_string()))
}

/// The library of `paint` as a value of a description.
///
/// # Errors
/// [`TexelFileError::Unwritable`] if the library's own JSON cannot be parsed.
pub(crate) fn encoded_library(
    kind: &TexelFileKind,
    paint: &PaintOfSamples,
) -> Result<Value, TexelFileError> {
    let library = serde_json::from_str(&paint.library.to_json());
    library.map_err(|error| kind.unwritable(error.to_string()))
}

/// The paint that the values `pigments` and `library` of a description tell of.
///
/// # Errors
/// [`TexelFileError`] if one of them is missing, if the library is invalid, and if the channels
/// contradict each other or name pigments that it lacks.
pub(crate) fn paint_of(
    origin: Origin<'_>,
    pigments: Option<&[PigmentChannel]>,
    library: Option<&Value>,
) -> Result<Option<PaintOfSamples>, TexelFileError> {
    match (pigments, library) {
        (None, None) => Ok(None),
        (Some(pigments), Some(library)) => {
            let name = format!("{}: library", origin.file);
            let library = PigmentLibrary::from_json(&name, &library.to_string())?;
            let slots = slots_of_channels(pigments, &library, origin.kind.reserved)
                .map_err(|reason| origin.header(reason))?;
            Ok(Some(PaintOfSamples { library: Arc::new(library), slots }))
        }
        _ => Err(origin.header("`pigments` and `library` go together")),
    }
}

/// Returns the description if `back`, which was read from its text, equals it. JSON has no
/// notation for NaN and infinity, and libraries are written in six digits.
///
/// # Errors
/// [`TexelFileError::Unwritable`] if it does not come back, with the reason.
pub(crate) fn proven<T: PartialEq>(
    kind: &TexelFileKind,
    description: T,
    paint: Option<&PaintOfSamples>,
    back: Result<(T, Option<PaintOfSamples>), TexelFileError>,
) -> Result<T, TexelFileError> {
    match back {
        Ok((back, of)) if back == description && of.as_ref() == paint => Ok(description),
        Ok(_) => Err(kind.unwritable("the description does not come back as it was")),
        Err(TexelFileError::Header { reason, .. }) => Err(kind.unwritable(reason)),
        Err(error) => Err(kind.unwritable(error.to_string())),
    }
}
