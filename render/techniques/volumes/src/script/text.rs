//! Reads and writes scripts as text, and has the errors of scripts.

use std::path::Path;

use documents::hint::Explain;
use serde::Deserialize;

use super::file::{FormatVersion, Script};
use crate::settings::{GridTable, Settings};
use crate::toml_text::{Fault, KeyPath, Source, TextError, read_text};

/// The settings of a script as typed tables. A [`Script`] holds its settings as plain TOML, so we
/// parse the text a second time into these tables. This finds unknown keys and wrong types with
/// their lines.
#[derive(Deserialize)]
struct OwnSettings {
    #[serde(default, rename = "settings")]
    _settings: Settings,
    #[serde(default, rename = "grid")]
    _grid: GridTable,
}

impl Script {
    /// Reads a script. Its subject must lie beside it.
    ///
    /// # Errors
    /// [`ScriptError`] with file, line, key and the way out.
    pub fn open(path: &Path) -> Result<Self, ScriptError> {
        Self::from_text(&path.display().to_string(), &read_text(path)?)
    }

    /// Reads a script that the user wrote. Its subject may lie in any folder.
    ///
    /// # Errors
    /// [`ScriptError`] with file, line, key and the way out.
    pub fn open_own(path: &Path) -> Result<Self, ScriptError> {
        Self::from_own_text(&path.display().to_string(), &read_text(path)?)
    }

    /// Parses the text of a script. Errors call it `name`. The subject must lie beside it.
    ///
    /// # Errors
    /// [`ScriptError`] with line, key and the way out.
    pub fn from_text(name: &str, text: &str) -> Result<Self, ScriptError> {
        let (script, source) = parsed(name, text)?;
        script.check_files_beside().map_err(|fault| source.located(fault))?;
        Ok(script)
    }

    /// Parses the text of a script that the user wrote. Its files may lie in any folder.
    ///
    /// # Errors
    /// [`ScriptError`] with line, key and the way out.
    pub fn from_own_text(name: &str, text: &str) -> Result<Self, ScriptError> {
        Ok(parsed(name, text)?.0)
    }

    /// The text of a script: figures with six digits, times with four decimals. If you read it,
    /// you get [`Script::rounded`] to the bit.
    ///
    /// # Errors
    /// [`ScriptError`] for the first value that is out of its range.
    pub fn to_text(&self) -> Result<String, ScriptError> {
        let rounded = self.rounded();
        rounded.check()?;
        toml::to_string(&rounded).map_err(|error| {
            let hint = "write plain numbers and words";
            Fault::new(&KeyPath::of("settings"), "values of TOML", error, hint).into()
        })
    }
}

impl ScriptError {
    /// Makes an error of a fault that you find after reading, such as an unknown pigment. It has
    /// the line in the script's `text`, which it calls `name`.
    #[must_use]
    pub fn located(name: &str, text: &str, fault: Box<Fault>) -> Self {
        match Source::toml(name, text) {
            Ok(source) => source.located(fault).into(),
            Err(_) => TextError::Invalid(fault).into(),
        }
    }
}

fn parsed<'t>(name: &'t str, text: &'t str) -> Result<(Script, Source<'t>), ScriptError> {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let source = Source::toml(name, text)?;
    check_format(name, &source)?;
    let script: Script = source.typed()?;
    source.typed::<OwnSettings>()?;
    script.check().map_err(|fault| source.located(fault))?;
    Ok((script, source))
}

/// We check format and version before anything else, because a newer version may have other keys.
fn check_format(name: &str, source: &Source<'_>) -> Result<(), ScriptError> {
    let file = name.to_owned();
    let found = source.value_of("format").unwrap_or("nothing").to_owned();
    if found.trim_matches(['"', '\'']) != "paint-volumes" {
        let line = source.line(&KeyPath::of("format")).max(1);
        return Err(ScriptError::Format { file, line, found });
    }
    let newest = FormatVersion::NUMBER;
    match source.value_of("version") {
        Some(found) if found.parse() != Ok(newest) => Err(ScriptError::Version {
            file,
            line: source.line(&KeyPath::of("version")).max(1),
            found: found.to_owned(),
            newest,
        }),
        _ => Ok(()),
    }
}

/// Reasons why a script cannot be read or written.
#[derive(Debug, thiserror::Error, Explain)]
pub enum ScriptError {
    /// The file cannot be read, is not TOML, or has a wrong key or value.
    #[error(transparent)]
    Text(#[from] TextError),
    /// The file is TOML of another format.
    #[error("{file}, line {line}: format takes \"paint-volumes\", found `{found}`")]
    #[hint(verbatim, "a script begins with format = \"paint-volumes\" and version = 1")]
    Format {
        /// Name of the file.
        file: String,
        /// Line of the key `format`, or the first.
        line: usize,
        /// Value of the key, or `nothing`.
        found: String,
    },
    /// The script has a version that this program does not know.
    #[error("{file}, line {line}: version takes 1 to {newest}, found `{found}`")]
    #[hint(verbatim, "a newer impasto may read it")]
    Version {
        /// Name of the file.
        file: String,
        /// Line of the key `version`.
        line: usize,
        /// Value of the key.
        found: String,
        /// Newest version that can be read.
        newest: u64,
    },
}

impl From<Box<Fault>> for ScriptError {
    fn from(fault: Box<Fault>) -> Self {
        Self::Text(fault.into())
    }
}
