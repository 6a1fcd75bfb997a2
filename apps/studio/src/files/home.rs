//! Folders in which the program keeps preferences and autosaves.

use std::path::{Path, PathBuf};

#[cfg(not(target_arch = "wasm32"))]
use directories::ProjectDirs;

/// The program's own folders. They need not exist yet.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Home {
    /// Folder of the preferences.
    pub settings: PathBuf,
    /// Folder of the autosaves.
    pub data: PathBuf,
}

impl Home {
    /// The usual folders of the platform, such as `~/.config/impasto` and
    /// `~/.local/share/impasto`; `None` if the system does not name the user's home folder.
    #[must_use]
    #[cfg(not(target_arch = "wasm32"))]
    pub fn for_platform() -> Option<Self> {
        let folders = ProjectDirs::from("", "", "impasto")?;
        let settings = folders.config_dir();
        let data = folders.data_local_dir();
        Some(Self { settings: settings.to_owned(), data: data.to_owned() })
    }

    /// The folders of a page.
    #[must_use]
    #[cfg(target_arch = "wasm32")]
    pub fn for_platform() -> Option<Self> {
        Some(Self { settings: PathBuf::from("/settings"), data: PathBuf::from("/data") })
    }

    /// Keeps everything in one folder.
    #[must_use]
    pub fn in_folder(folder: &Path) -> Self {
        Self { settings: folder.to_owned(), data: folder.to_owned() }
    }

    /// Path of the preferences file.
    #[must_use]
    pub fn preferences(&self) -> PathBuf {
        self.settings.join("preferences.json")
    }

    /// Folder of the sets of own brushes.
    #[must_use]
    pub fn brushes(&self) -> PathBuf {
        self.settings.join("brushes")
    }

    /// Path of the list of kept mixtures.
    #[must_use]
    pub fn swatches(&self) -> PathBuf {
        self.settings.join("swatches.json")
    }

    /// Folder that holds one folder for each scene that is not saved.
    #[must_use]
    pub fn scenes(&self) -> PathBuf {
        self.data.join("scenes")
    }

    /// Folder that holds one folder for each session.
    #[must_use]
    pub fn sessions(&self) -> PathBuf {
        self.data.join("sessions")
    }
}
