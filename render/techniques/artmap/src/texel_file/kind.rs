//! Kinds of files of texels. This has their description (JSON in attribute `impasto`, with the
//! pigment library), and the errors that you get when you read them.

use std::sync::Arc;

use documents::file::FileError;
use documents::hint::Explain;
use paint::file::{PigmentChannel, ascii_json, slots_of_channels};
use pigment::{LibraryError, PigmentLibrary};
use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_json::Value;

use crate::texel_file::PaintOfSamples;

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct TexelFileKind {
    pub(crate) format: &'static str,
    /// Newest version. We write this one.
    pub(crate) version: u64,
    /// Content in words, for messages.
    pub(crate) content: &'static str,
    /// You cannot give these names to a pigment's channel.
    pub(crate) reserved: &'static [&'static str],
}

impl TexelFileKind {
    pub(crate) fn unwritable(&self, reason: impl Into<String>) -> TexelFileError {
        TexelFileError::Unwritable { content: self.content, reason: reason.into() }
    }
}

#[derive(Debug, Clone, Copy)]
pub(crate) struct Origin<'a> {
    pub(crate) kind: &'a TexelFileKind,
    pub(crate) file: &'a str,
}

impl Origin<'_> {
    pub(crate) fn damaged(&self, reason: impl Into<String>) -> TexelFileError {
        let file = self.file.to_owned();
        let content = self.kind.content;
        TexelFileError::Container { file, content, reason: reason.into() }
    }

    pub(crate) fn other_format(&self, reason: impl Into<String>) -> TexelFileError {
        let file = self.file.to_owned();
        let content = self.kind.content;
        TexelFileError::Format { file, content, reason: reason.into() }
    }

    pub(crate) fn other_version(&self, found: String) -> TexelFileError {
        let file = self.file.to_owned();
        let content = self.kind.content;
        TexelFileError::Version { file, content, found, newest: self.kind.version }
    }

    pub(crate) fn header(&self, reason: impl Into<String>) -> TexelFileError {
        let file = self.file.to_owned();
        let content = self.kind.content;
        TexelFileError::Header { file, content, reason: reason.into() }
    }

    pub(crate) fn part(&self, part: &str, reason: impl Into<String>) -> TexelFileError {
        let file = self.file.to_owned();
        let part = part.to_owned();
        TexelFileError::Part { file, part, reason: reason.into() }
    }

    /// Makes an error of a fault. The pair has the channel and the reason.
    pub(crate) fn channel(&self, part: &str, fault: (String, String)) -> TexelFileError {
        let file = self.file.to_owned();
        let part = part.to_owned();
        TexelFileError::Channel { file, part, channel: fault.0, reason: fault.1 }
    }

    pub(crate) fn changed(&self, part: &str) -> TexelFileError {
        let file = self.file.to_owned();
        let content = self.kind.content;
        TexelFileError::Changed { file, content, part: part.to_owned() }
    }
}

/// The hint for parts and channels that are not as we wrote them.
const KEEP_AS_WRITTEN: &str =
    "another program changed the file: keep parts, sizes and channels as they were";

/// A file of samples or an art map cannot be read or written.
#[derive(Debug, Clone, PartialEq, thiserror::Error, Explain)]
pub enum TexelFileError {
    /// The file cannot be read from or written to the disk.
    #[error(transparent)]
    File(#[from] FileError),
    /// The file is not OpenEXR, or is damaged.
    #[error("{file}: not an intact OpenEXR file: {reason}")]
    #[hint("the file is truncated, damaged or not OpenEXR: make the {content} again")]
    Container {
        /// Path of the file.
        file: String,
        /// Content that was expected, in words.
        content: &'static str,
        /// Reason given by the decoder.
        reason: String,
    },
    /// The file is OpenEXR, but holds something else.
    #[error("{file}: no {content} of impasto: {reason}")]
    #[hint("choose another file, which impasto wrote as {content}")]
    Format {
        /// Path of the file.
        file: String,
        /// Content that was expected, in words.
        content: &'static str,
        /// Reason, with the value found.
        reason: String,
    },
    /// The file has a version that this program does not know.
    #[error("{file}: {content} of version `{found}`, this program reads versions up to {newest}")]
    #[hint("a newer impasto may read it")]
    Version {
        /// Path of the file.
        file: String,
        /// Content in words.
        content: &'static str,
        /// Version of the file.
        found: String,
        /// Newest version that can be read.
        newest: u64,
    },
    /// The description in attribute `impasto` is invalid.
    #[error("{file}: attribute `impasto`: {reason}")]
    #[hint("make the {content} again")]
    Header {
        /// Path of the file.
        file: String,
        /// Content in words.
        content: &'static str,
        /// Reason, with the key.
        reason: String,
    },
    /// The pigment library in the file is invalid.
    #[error(transparent)]
    #[fault(Input)]
    Library(#[from] LibraryError),
    /// A part of the file is missing or malformed.
    #[error("{file}: part `{part}` {reason}")]
    #[hint("{KEEP_AS_WRITTEN}")]
    Part {
        /// Path of the file.
        file: String,
        /// Name of the part.
        part: String,
        /// Reason, continuing the sentence that starts with the part.
        reason: String,
    },
    /// A channel is missing or malformed, or one of its values is impossible.
    #[error("{file}: part `{part}`, channel `{channel}` {reason}")]
    #[hint("{KEEP_AS_WRITTEN}")]
    Channel {
        /// Path of the file.
        file: String,
        /// Name of the part.
        part: String,
        /// Name of the channel.
        channel: String,
        /// Reason, continuing the sentence that starts with the channel.
        reason: String,
    },
    /// A part has possible values, but not those that were written.
    #[error("{file}: part `{part}` does not hold the values that were written")]
    #[hint("the file is damaged or was changed: make the {content} again")]
    Changed {
        /// Path of the file.
        file: String,
        /// Content in words.
        content: &'static str,
        /// Name of the part.
        part: String,
    },
    /// The content is inconsistent, so no file can hold it.
    #[error("the {content} cannot be saved: {reason}")]
    Unwritable {
        /// Content in words.
        content: &'static str,
        /// Reason, with the sample or tile.
        reason: String,
    },
}

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

/// Parses a description. This first checks that its keys `format` and `version` match the kind.
///
/// # Errors
/// [`TexelFileError`] for another format or version, and for text that is not such a description.
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

/// The paint that a description holds in its values `pigments` and `library`.
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

/// Returns the description if it equals `back`, which was read from its text. They can differ: for
/// example, JSON has no notation for NaN and infinity, and libraries are written in six digits.
///
/// # Errors
/// [`TexelFileError::Unwritable`] if they differ, with the reason.
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
