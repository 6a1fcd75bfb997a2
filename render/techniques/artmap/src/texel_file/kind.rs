//! Kinds of files of texels, and the file that is read, for its errors.

use super::error::TexelFileError;

/// A kind of file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct TexelFileKind {
    /// Value of `format` in the description.
    pub(crate) format: &'static str,
    /// Newest version, which is the one that is written.
    pub(crate) version: u64,
    /// Content in words, for messages.
    pub(crate) content: &'static str,
    /// Channels that no pigment's channel can be called.
    pub(crate) reserved: &'static [&'static str],
}

impl TexelFileKind {
    pub(crate) fn unwritable(&self, reason: impl Into<String>) -> TexelFileError {
        TexelFileError::Unwritable { content: self.content, reason: reason.into() }
    }
}

/// The file that is read.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Origin<'a> {
    pub(crate) kind: &'a TexelFileKind,
    /// Path of the file.
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

    /// Fault of a channel, the first of the pair, for the reason that is the second.
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
