//! What the painter prefers: JSON in the program's own folder.
//!
//! A key that this version does not know is kept as it is, so that a newer and
//! an older program can share the file; a value that it does not understand is
//! said and gives way to the default. A file that is no JSON is moved aside.

use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};

use crate::pen::PenSettings;
use session::FileFailure;
use session::whole;

/// Files of the list of recent ones.
const MOST_RECENT: usize = 12;

/// What computes a painting.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Backend {
    /// Hardware where there is some, else the processor.
    #[default]
    Auto,
    /// The processor.
    Cpu,
    /// A graphics adapter, even one in software.
    Gpu,
}

/// What the painter has in hand at the start.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct ToolPreferences {
    /// The brush.
    pub brush: String,
    /// Share of clear medium in what it takes up, 0..1.
    pub vehicle: f64,
    /// How high paint lies on the head after loading, in mm.
    pub load_mm: f64,
    /// Cubic millimetres that one squeeze gives.
    pub squeeze_mm3: f64,
    /// The share that `dry` dries, 0..1.
    pub dry_share: f64,
}

impl Default for ToolPreferences {
    fn default() -> Self {
        let brush = "round".to_owned();
        Self { brush, vehicle: 0.15, load_mm: 0.3, squeeze_mm3: 60.0, dry_share: 1.0 }
    }
}

/// The preferences.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Preferences {
    /// Seconds between autosaves while something changes, 2 to 3600.
    pub autosave_seconds: u64,
    /// MiB that undo may keep, up to 1048576; from the next start on.
    pub undo_mib: u64,
    /// What computes; from the next start on.
    pub backend: Backend,
    /// Size of the interface beside the system's own, 0.5 to 3.
    pub interface_scale: f32,
    /// Whether recordings play at the speed they were painted with.
    pub replay_as_painted: bool,
    /// What is in hand at the start.
    pub tools: ToolPreferences,
    /// How pens, mice and fingers lead a brush.
    pub pen: PenSettings,
    /// Where files were last looked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub last_folder: Option<PathBuf>,
    /// Files opened and saved, the latest first.
    pub recent: Vec<PathBuf>,
    /// Width and height of the window in points.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub window: Option<[f32; 2]>,
    /// What another version wrote.
    #[serde(flatten)]
    pub other: Map<String, Value>,
}

impl Default for Preferences {
    fn default() -> Self {
        Self {
            autosave_seconds: 20,
            undo_mib: 512,
            backend: Backend::Auto,
            interface_scale: 1.0,
            replay_as_painted: false,
            tools: ToolPreferences::default(),
            pen: PenSettings::default(),
            last_folder: None,
            recent: Vec::new(),
            window: None,
            other: Map::new(),
        }
    }
}

impl Preferences {
    /// Those in `path`, and what is to be said of them. Without a file they are
    /// the defaults.
    #[must_use]
    pub fn read(path: &Path) -> (Self, Vec<FileFailure>) {
        let bytes = match std::fs::read(path) {
            Ok(bytes) => bytes,
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => {
                return (Self::default(), Vec::new());
            }
            Err(error) => {
                return (Self::default(), vec![FileFailure::io(path, "read", &error)]);
            }
        };
        match serde_json::from_slice(&bytes) {
            Ok(found) => Self::from_map(path, found),
            Err(error) => (Self::default(), vec![set_aside(path, &error)]),
        }
    }

    /// Key by key, so that one strange value costs no other.
    fn from_map(path: &Path, found: Map<String, Value>) -> (Self, Vec<FileFailure>) {
        let mut preferences = Self::default();
        let mut failures = Vec::new();
        for (key, value) in found {
            let mut all = match serde_json::to_value(&preferences) {
                Ok(Value::Object(all)) => all,
                _ => Map::new(),
            };
            all.insert(key.clone(), value);
            match serde_json::from_value(Value::Object(all)) {
                Ok(read) => preferences = read,
                Err(error) => failures.push(FileFailure::new(
                    format!("{}: key `{key}`: {error}", path.display()),
                    "it counts as not given",
                )),
            }
        }
        preferences.bound();
        (preferences, failures)
    }

    /// Brings numbers into their range.
    pub fn bound(&mut self) {
        self.autosave_seconds = self.autosave_seconds.clamp(2, 3600);
        self.undo_mib = self.undo_mib.min(1 << 20);
        self.interface_scale = within(self.interface_scale, 0.5, 3.0, 1.0);
        let usual = ToolPreferences::default();
        let tools = &mut self.tools;
        tools.vehicle = within(tools.vehicle, 0.0, 1.0, usual.vehicle);
        tools.load_mm = within(tools.load_mm, 0.0, 10.0, usual.load_mm);
        tools.squeeze_mm3 = within(tools.squeeze_mm3, 0.1, 1e5, usual.squeeze_mm3);
        tools.dry_share = within(tools.dry_share, 0.01, 1.0, usual.dry_share);
        self.pen.bound();
        self.recent.truncate(MOST_RECENT);
        self.window = self.window.filter(|size| size.iter().all(|s| (200.0..20_000.0).contains(s)));
    }

    /// Writes them, whole.
    ///
    /// # Errors
    /// [`FileFailure`] if the file cannot be written.
    pub fn write(&self, path: &Path) -> Result<(), FileFailure> {
        if let Some(folder) = path.parent() {
            std::fs::create_dir_all(folder)
                .map_err(|error| FileFailure::io(folder, "made", &error))?;
        }
        // A path that is no text cannot stand in JSON; it is forgotten, not fatal.
        let mut told = self.clone();
        told.recent.retain(|path| path.to_str().is_some());
        told.last_folder = told.last_folder.filter(|path| path.to_str().is_some());
        let value = serde_json::to_value(&told)
            .map_err(|error| FileFailure::told(&error, None::<String>))?;
        whole::write(path, pigment::library::to_text(&value).as_bytes())
    }

    /// Puts `path` on top of the recent files.
    pub fn remember(&mut self, path: &Path) {
        self.recent.retain(|other| other != path);
        self.recent.insert(0, path.to_owned());
        self.recent.truncate(MOST_RECENT);
        self.last_folder = path.parent().map(Path::to_owned);
    }
}

fn within<T: PartialOrd>(value: T, least: T, most: T, usual: T) -> T {
    // What is not a number is in no range.
    if value >= least && value <= most { value } else { usual }
}

/// Moves a file that is no JSON out of the way, and says so.
fn set_aside(path: &Path, error: &serde_json::Error) -> FileFailure {
    let aside = path.with_extension("broken.json");
    let hint = match std::fs::rename(path, &aside) {
        Ok(()) => format!("the defaults hold; the file is kept as {}", aside.display()),
        Err(error) => format!("the defaults hold; it cannot be moved aside: {error}"),
    };
    FileFailure::new(format!("{}: {error}", path.display()), hint)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> (Preferences, Vec<FileFailure>, tempfile::TempDir) {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("preferences.json");
        std::fs::write(&path, text).unwrap();
        let (preferences, failures) = Preferences::read(&path);
        (preferences, failures, folder)
    }

    #[test]
    fn preferences_come_back_as_they_were() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("new").join("preferences.json");
        let (mut preferences, failures) = Preferences::read(&path);
        assert_eq!((&preferences, failures.len()), (&Preferences::default(), 0));
        preferences.autosave_seconds = 7;
        preferences.window = Some([1280.0, 800.0]);
        preferences.pen.gamma = 1.5;
        preferences.pen.grip.turn(30.0);
        preferences.remember(Path::new("/a/study.exr"));
        preferences.write(&path).unwrap();
        assert_eq!(Preferences::read(&path), (preferences, Vec::new()));
    }

    #[test]
    fn what_a_newer_version_wrote_is_kept() {
        let (preferences, failures, folder) = read(
            r#"{"haptics": {"strength": 3}, "undo_mib": 64, "tools": {"brush": "fan", "x": 1}}"#,
        );
        assert_eq!(failures, []);
        assert_eq!((preferences.undo_mib, preferences.tools.brush.as_str()), (64, "fan"));
        let path = folder.path().join("preferences.json");
        preferences.write(&path).unwrap();
        assert!(std::fs::read_to_string(&path).unwrap().contains("haptics"), "it was dropped");
    }

    #[test]
    fn one_strange_value_costs_no_other() {
        let (preferences, failures, _folder) = read(
            r#"{"backend": "quantum", "undo_mib": 64, "interface_scale": 900, "pen": {"gamma": 99}}"#,
        );
        assert_eq!((preferences.backend, preferences.undo_mib), (Backend::Auto, 64));
        assert!((preferences.interface_scale - 1.0).abs() < 1e-6, "the scale is out of range");
        assert_eq!(preferences.pen, PenSettings::default(), "gamma is out of range");
        let [failure] = &failures[..] else { panic!("{failures:?}") };
        assert!(failure.what.contains("`backend`"), "{failure}");
    }

    #[test]
    fn a_broken_file_is_moved_aside_and_said() {
        for text in ["{\"undo_mib\": ", "[]", "", "\u{0}"] {
            let (preferences, failures, folder) = read(text);
            assert_eq!(preferences, Preferences::default());
            assert_eq!(failures.len(), 1, "{text:?}");
            let aside = folder.path().join("preferences.broken.json");
            assert_eq!(std::fs::read_to_string(aside).unwrap(), text);
            assert!(!folder.path().join("preferences.json").exists(), "{text:?}: still there");
        }
    }

    #[test]
    fn recent_files_are_few_and_each_once() {
        let mut preferences = Preferences::default();
        for index in 0..30 {
            preferences.remember(Path::new(&format!("/a/{}.exr", index % 20)));
        }
        assert_eq!(preferences.recent.len(), MOST_RECENT);
        assert_eq!(preferences.recent[0], Path::new("/a/9.exr"));
        assert_eq!(preferences.last_folder.as_deref(), Some(Path::new("/a")));
    }
}
