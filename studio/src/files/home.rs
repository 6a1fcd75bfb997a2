//! Where the program keeps its own: preferences, and what autosave writes.

use std::path::{Path, PathBuf};

use directories::ProjectDirs;

/// The program's own folders; they need not exist yet.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Home {
    /// Preferences.
    pub settings: PathBuf,
    /// What autosave writes.
    pub data: PathBuf,
}

impl Home {
    /// The platform's own, such as `~/.config/impasto` and
    /// `~/.local/share/impasto`; none if it does not say where the user is at
    /// home.
    #[must_use]
    pub fn of_platform() -> Option<Self> {
        let folders = ProjectDirs::from("", "", "impasto")?;
        let (settings, data) = (folders.config_dir(), folders.data_local_dir());
        Some(Self { settings: settings.to_owned(), data: data.to_owned() })
    }

    /// All in one folder, to be carried about.
    #[must_use]
    pub fn in_folder(folder: &Path) -> Self {
        Self { settings: folder.to_owned(), data: folder.to_owned() }
    }

    /// The file of preferences.
    #[must_use]
    pub fn preferences(&self) -> PathBuf {
        self.settings.join("preferences.json")
    }

    /// The folder of sessions, one a folder.
    #[must_use]
    pub fn sessions(&self) -> PathBuf {
        self.data.join("sessions")
    }
}
