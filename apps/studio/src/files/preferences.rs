//! The painter's preferences, a JSON file in the program's own folder.
//!
//! We keep keys that this version does not know, so that older and newer versions can share the
//! file. If a value makes no sense, we report it and use the default. A file that is not JSON is
//! renamed.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

#[cfg(not(target_arch = "wasm32"))]
use directories::ProjectDirs;
use documents::file::{disk, write_whole};
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};
use session::brushes::BrushOptions;

use super::new_canvas::KeptCanvases;
use super::problem::Problem;
use crate::arrangement::Arrangement;
use crate::language::Language;
use crate::pen::PenSettings;
use crate::theme::{Look, ThemeChoice};

/// Maximum number of recent files.
const MAX_RECENT: usize = 12;

/// The processor or graphics device that simulates the paint.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Backend {
    /// A graphics adapter if it is hardware, else the processor.
    #[default]
    Auto,
    /// The processor, on all cores.
    Cpu,
    /// A graphics adapter, even a software one.
    Gpu,
}

/// The brush and amounts that you start with.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct ToolPreferences {
    /// Name of the brush.
    pub brush: String,
    /// Fraction of clear medium in a load of paint, 0 to 1.
    pub vehicle: f64,
    /// Height of the paint on the head after loading, in mm.
    pub load_mm: f64,
    /// Volume of one squeeze, in cubic millimetres.
    pub squeeze_mm3: f64,
    /// Share of the wet paint that drying dries, 0 to 1.
    pub dry_share: f64,
}

impl Default for ToolPreferences {
    fn default() -> Self {
        let brush = "round".to_owned();
        Self { brush, vehicle: 0.15, load_mm: 0.3, squeeze_mm3: 60.0, dry_share: 1.0 }
    }
}

/// The painter's preferences.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Preferences {
    /// Seconds between autosaves while the painting changes, 2 to 3600.
    pub autosave_seconds: u64,
    /// Memory for undo in MiB, up to 1048576. You must restart to use a change.
    pub undo_mib: u64,
    /// The processor or graphics device that simulates the paint. You must restart to use a change.
    pub backend: Backend,
    /// Scale of the interface relative to the system's, 0.5 to 3.
    pub interface_scale: f32,
    /// Dark or light, or as the system prefers.
    pub theme: ThemeChoice,
    /// Language of the window; `None` uses the language of the system.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub language: Option<Language>,
    /// Whether everything is large enough for touch: 44 points or more.
    pub touch_targets: bool,
    /// Whether recordings play at the speed of painting, rather than as fast as possible.
    pub replay_as_painted: bool,
    /// The brush and amounts that you start with.
    pub tools: ToolPreferences,
    /// Pen, mouse and touch settings.
    pub pen: PenSettings,
    /// Whether you have seen the first steps. They do not appear by themselves again.
    pub first_steps_seen: bool,
    /// Options of single brushes for the pen, by the name of the brush.
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    pub brush_options: BTreeMap<String, BrushOptions>,
    /// Changed keys, e.g. `Ctrl+Shift+Z`, by the name of their action.
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    pub keys: BTreeMap<String, Vec<String>>,
    /// Folder in which you last chose a file.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub last_folder: Option<PathBuf>,
    /// The canvas that you began last, and presets of canvases.
    pub new_painting: KeptCanvases,
    /// Form and order of the files in the file browser.
    pub browser: BrowserLook,
    /// Files that you opened or saved, the latest first.
    pub recent: Vec<PathBuf>,
    /// Where the panels stand.
    pub arrangement: Arrangement,
    /// Width and height of the window, in points.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub window: Option<[f32; 2]>,
    /// Keys of other versions, kept unchanged.
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
            theme: ThemeChoice::Dark,
            language: None,
            touch_targets: false,
            replay_as_painted: false,
            tools: ToolPreferences::default(),
            pen: PenSettings::default(),
            first_steps_seen: false,
            brush_options: BTreeMap::new(),
            keys: BTreeMap::new(),
            last_folder: None,
            new_painting: KeptCanvases::default(),
            browser: BrowserLook::default(),
            recent: Vec::new(),
            arrangement: Arrangement::default(),
            window: None,
            other: Map::new(),
        }
    }
}

impl Preferences {
    /// Reads the preferences in `path`. Returns them with the problems found in the file. Without a
    /// file, you get the defaults and no problem.
    #[must_use]
    pub fn read(path: &Path) -> (Self, Vec<Problem>) {
        let bytes = match disk::read(path) {
            Ok(bytes) => bytes,
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => {
                return (Self::default(), Vec::new());
            }
            Err(error) => {
                return (Self::default(), vec![Problem::io(path, "read", &error)]);
            }
        };
        match serde_json::from_slice(&bytes) {
            Ok(found) => Self::from_map(path, found),
            Err(error) => (Self::default(), vec![set_aside(path, &error)]),
        }
    }

    /// Reads key by key, so that one invalid value does not affect the others.
    fn from_map(path: &Path, found: Map<String, Value>) -> (Self, Vec<Problem>) {
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
                Err(error) => failures.push(Problem::new(
                    format!("{}: key `{key}`: {error}", path.display()),
                    "the default is used instead",
                )),
            }
        }
        preferences.bound();
        (preferences, failures)
    }

    /// Replaces numbers out of range by the nearest limit or the default.
    pub fn bound(&mut self) {
        self.autosave_seconds = self.autosave_seconds.clamp(2, 3600);
        self.undo_mib = self.undo_mib.min(1 << 20);
        self.interface_scale = within(self.interface_scale, 0.5, 3.0, 1.0);
        let default = ToolPreferences::default();
        let tools = &mut self.tools;
        tools.vehicle = within(tools.vehicle, 0.0, 1.0, default.vehicle);
        tools.load_mm = within(tools.load_mm, 0.0, 10.0, default.load_mm);
        tools.squeeze_mm3 = within(tools.squeeze_mm3, 0.1, 1e5, default.squeeze_mm3);
        tools.dry_share = within(tools.dry_share, 0.01, 1.0, default.dry_share);
        self.pen.bound();
        self.brush_options.values_mut().for_each(BrushOptions::bound);
        self.new_painting.bound();
        self.recent.truncate(MAX_RECENT);
        self.window = self.window.filter(|size| size.iter().all(|s| (200.0..20_000.0).contains(s)));
    }

    /// The look of the window.
    #[must_use]
    pub fn look(&self) -> Look {
        Look { theme: self.theme, touch: self.touch_targets }
    }

    /// Writes the preferences to `path`.
    ///
    /// # Errors
    /// [`Problem`] if the file cannot be written.
    pub fn write(&self, path: &Path) -> Result<(), Problem> {
        if let Some(folder) = path.parent() {
            disk::create_dir_all(folder).map_err(|error| Problem::io(folder, "created", &error))?;
        }
        // JSON cannot store a path that is not valid Unicode. We leave such paths out.
        let mut written = self.clone();
        written.recent.retain(|path| path.to_str().is_some());
        written.last_folder = written.last_folder.filter(|path| path.to_str().is_some());
        let value =
            serde_json::to_value(&written).map_err(|error| Problem::without_hint(&error))?;
        Ok(write_whole(path, pigment::library::to_text(&value).as_bytes())?)
    }

    /// Options of the brush of this name.
    #[must_use]
    pub fn options_of(&self, brush: &str) -> BrushOptions {
        self.brush_options.get(brush).cloned().unwrap_or_default()
    }

    /// Keeps options of the brush with this name. If they equal the general settings, this removes
    /// the entry.
    pub fn set_options(&mut self, brush: &str, options: BrushOptions) {
        if options == BrushOptions::default() {
            self.brush_options.remove(brush);
        } else {
            self.brush_options.insert(brush.to_owned(), options);
        }
    }

    /// Adds `path` as the first of the recent files.
    pub fn remember(&mut self, path: &Path) {
        self.recent.retain(|other| other != path);
        self.recent.insert(0, path.to_owned());
        self.recent.truncate(MAX_RECENT);
        self.last_folder = path.parent().map(Path::to_owned);
    }
}

fn within<T: PartialOrd>(value: T, least: T, most: T, default: T) -> T {
    // NaN lies in no range.
    if value >= least && value <= most { value } else { default }
}

/// Renames a file that is not JSON, and describes this as a problem.
fn set_aside(path: &Path, error: &serde_json::Error) -> Problem {
    let aside = path.with_extension("broken.json");
    let hint = match disk::rename(path, &aside) {
        Ok(()) => format!("the defaults are used; the file was renamed to {}", aside.display()),
        Err(error) => format!("the defaults are used; the file cannot be renamed: {error}"),
    };
    Problem::new(format!("{}: {error}", path.display()), hint)
}

/// Order of the files of a folder. Folders always come first.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum BrowserOrder {
    /// By name, with numbers in numerical order.
    #[default]
    Name,
    /// By the time of the last change, the latest first.
    Date,
}

/// Form and order of the files in the file browser.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct BrowserLook {
    /// Whether files are shown as a grid of pictures rather than a list.
    pub grid: bool,
    /// Order of the files.
    pub order: BrowserOrder,
}

/// The program's own folders. They need not exist yet.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Home {
    /// Folder of the preferences.
    pub settings: PathBuf,
    /// Folder of the autosaves.
    pub data: PathBuf,
}

impl Home {
    /// The usual folders of the platform, e.g. `~/.config/impasto` and `~/.local/share/impasto`.
    /// `None` if the system does not name the user's home folder.
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

    /// Folder with one folder for each unsaved scene.
    #[must_use]
    pub fn scenes(&self) -> PathBuf {
        self.data.join("scenes")
    }

    /// Folder with one folder for each session.
    #[must_use]
    pub fn sessions(&self) -> PathBuf {
        self.data.join("sessions")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> (Preferences, Vec<Problem>, tempfile::TempDir) {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("preferences.json");
        std::fs::write(&path, text).unwrap();
        let (preferences, failures) = Preferences::read(&path);
        (preferences, failures, folder)
    }

    #[test]
    fn preferences_of_an_earlier_version_are_written_as_they_were() {
        let earlier = include_str!("../../../../tests/fixtures/formats/preferences.json");
        let (preferences, failures, folder) = read(earlier);
        assert!(failures.is_empty(), "{failures:?}");
        assert_eq!((preferences.autosave_seconds, &*preferences.tools.brush), (45, "flat"));
        let path = folder.path().join("preferences.json");
        preferences.write(&path).unwrap();
        let [written, earlier] = [std::fs::read_to_string(path).unwrap(), earlier.to_owned()]
            .map(|text| serde_json::from_str::<Value>(&text).unwrap());
        assert_eq!(written, earlier);
    }

    #[test]
    fn preferences_survive_writing_and_reading() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("new").join("preferences.json");
        let (mut preferences, failures) = Preferences::read(&path);
        assert_eq!((&preferences, failures.len()), (&Preferences::default(), 0));
        preferences.autosave_seconds = 7;
        preferences.window = Some([1280.0, 800.0]);
        preferences.theme = ThemeChoice::Light;
        preferences.language = Some(Language::German);
        preferences.touch_targets = true;
        preferences.arrangement = Arrangement::in_right_column(&[&["light"], &["brush"]]);
        preferences.arrangement.right.groups[0].folded = true;
        preferences.pen.curve = session::brushes::PressureCurve::FIRM;
        let options = BrushOptions { range: [0.2, 1.0], ..BrushOptions::default() };
        preferences.set_options("round", options.clone());
        preferences.set_options("flat", BrushOptions::default());
        assert_eq!(preferences.options_of("round"), options);
        assert_eq!(preferences.brush_options.len(), 1, "nothing is set for the flat");
        preferences.keys.insert("undo".to_owned(), vec!["Ctrl+U".to_owned()]);
        preferences.pen.grip.turn(30.0);
        preferences.remember(Path::new("/a/study.exr"));
        preferences.write(&path).unwrap();
        assert_eq!(Preferences::read(&path), (preferences, Vec::new()));
    }

    #[test]
    fn keys_of_a_newer_version_are_kept() {
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
    fn one_invalid_value_does_not_affect_the_others() {
        let (preferences, failures, _folder) = read(
            r#"{"backend": "quantum", "undo_mib": 64, "interface_scale": 900, "pen": {"gamma": 99}}"#,
        );
        assert_eq!((preferences.backend, preferences.undo_mib), (Backend::Auto, 64));
        assert!((preferences.interface_scale - 1.0).abs() < 1e-6, "the scale is out of range");
        assert_eq!(preferences.pen, PenSettings::default(), "gamma is out of range");
        let [failure] = &failures[..] else { panic!("{failures:?}") };
        assert!(failure.text.contains("`backend`"), "{failure:?}");
    }

    #[test]
    fn a_file_that_is_not_json_is_renamed_and_reported() {
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
    fn recent_files_are_limited_and_unique() {
        let mut preferences = Preferences::default();
        for index in 0..30 {
            preferences.remember(Path::new(&format!("/a/{}.exr", index % 20)));
        }
        assert_eq!(preferences.recent.len(), MAX_RECENT);
        assert_eq!(preferences.recent[0], Path::new("/a/9.exr"));
        assert_eq!(preferences.last_folder.as_deref(), Some(Path::new("/a")));
    }
}
