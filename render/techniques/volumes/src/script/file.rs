//! A script as it stands in its file, with its subject and its pigments. Also the library of a
//! script, the ground under its pigments, and the light on them.

use std::collections::BTreeMap;
use std::path::{Component, Path, PathBuf};

use documents::hint::Explain;
use documents::similar_names;
use graphics::mesh::SampleModel;
use paint::document::Slots;
use paint::ground::{GroundKind, GroundRelief, GroundSpec, Primer};
use paint::layer::SLOTS;
use pigment::PigmentLibrary;
use pigment::library::LibraryError;
use serde::{Deserialize, Serialize};
use spectra::{Illuminant, light_from_text};
use toml::Table;

use super::action::Recipe;
use super::camera::CameraTable;
use super::tables::{
    DryTable, KeepTable, LiftTable, PourTable, PushTable, RegionTable, SplitTable, VolumeTable,
};
use crate::settings::{Inside, Preset, Settings, even_tints};
use crate::toml_text::{Checked, Fault, KeyPath};

/// A script: the subject, its settings, and what you do to it in time. The key of each value in a
/// file is its name here, except that `center` is written `centre`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Script {
    /// The name `paint-volumes`.
    pub(super) format: FormatName,
    /// The version number 1.
    pub(super) version: FormatVersion,
    /// Title of the animation.
    #[serde(default)]
    pub title: String,
    /// `shape:NAME`, or the path of a model or photograph, relative to the script's folder.
    pub subject: String,
    /// Length of a unit of the scene in mm, above 0 up to 1e6. Without it, the longest side is 200
    /// mm.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub unit_mm: Option<f64>,
    /// Duration in seconds, 0 to 3600.
    pub seconds: f64,
    /// Settings to start from. Without it, this is [`Preset::Sketch`].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub preset: Option<Preset>,
    /// Library of the pigments: its file beside the script, or the title of the one that we ship.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub library: Option<String>,
    /// Light under which you see pigments, for example `A` or `5600K`. Without it, this is D65.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub illuminant: Option<String>,
    /// File of a lamp under which you see pigments, instead of `illuminant`. It lies beside the
    /// script: `FILE`, or `FILE#NAME` for one spectrum of several.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub lamp: Option<String>,
    /// Pigments by their letters, at most eight. Slots of paint are in the order of the letters.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub palette: BTreeMap<String, String>,
    /// The ground under pigments: linen, paper or panel. Without it, this is a panel with the
    /// white of the library.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub ground: Option<GroundSpec>,
    /// Settings of the grid that differ from the preset's.
    #[serde(default, skip_serializing_if = "Table::is_empty")]
    pub grid: Table,
    /// Settings that differ from the preset's, by group.
    #[serde(default, skip_serializing_if = "Table::is_empty")]
    pub settings: Table,
    /// The camera. Without it, you see the subject from the front and slightly above.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub camera: Option<CameraTable>,
    /// Regions in the order in which we compose them, later over earlier.
    #[serde(default, rename = "region", skip_serializing_if = "Vec::is_empty")]
    pub regions: Vec<RegionTable>,
    /// Regions in which volumes stay.
    #[serde(default, rename = "keep", skip_serializing_if = "Vec::is_empty")]
    pub keeps: Vec<KeepTable>,
    /// Single volumes, outside of the grid.
    #[serde(default, rename = "volume", skip_serializing_if = "Vec::is_empty")]
    pub volumes: Vec<VolumeTable>,
    /// Paint that you pour.
    #[serde(default, rename = "pour", skip_serializing_if = "Vec::is_empty")]
    pub pours: Vec<PourTable>,
    /// Air that pushes volumes.
    #[serde(default, rename = "push", skip_serializing_if = "Vec::is_empty")]
    pub pushes: Vec<PushTable>,
    /// Sponges that take paint up.
    #[serde(default, rename = "lift", skip_serializing_if = "Vec::is_empty")]
    pub lifts: Vec<LiftTable>,
    /// Single volumes that become volumes of the grid.
    #[serde(default, rename = "split", skip_serializing_if = "Vec::is_empty")]
    pub splits: Vec<SplitTable>,
    /// Paint that dries.
    #[serde(default, rename = "dry", skip_serializing_if = "Vec::is_empty")]
    pub dries: Vec<DryTable>,
}

impl Script {
    /// A script in which nothing happens. The fields say what to pass as `subject` and `seconds`.
    #[must_use]
    pub fn new(subject: &str, seconds: f64) -> Self {
        Self {
            format: FormatName::PaintVolumes,
            version: FormatVersion,
            title: String::new(),
            subject: subject.to_owned(),
            unit_mm: None,
            seconds,
            preset: None,
            library: None,
            illuminant: None,
            lamp: None,
            palette: BTreeMap::new(),
            ground: None,
            grid: Table::new(),
            settings: Table::new(),
            camera: None,
            regions: Vec::new(),
            keeps: Vec::new(),
            volumes: Vec::new(),
            pours: Vec::new(),
            pushes: Vec::new(),
            lifts: Vec::new(),
            splits: Vec::new(),
            dries: Vec::new(),
        }
    }
}

/// The name of the format. serde refuses any other.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub(super) enum FormatName {
    /// Written `paint-volumes` in a file.
    #[serde(rename = "paint-volumes")]
    PaintVolumes,
}

/// The version that we read and write. serde refuses any other.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(try_from = "u64", into = "u64")]
pub(super) struct FormatVersion;

impl FormatVersion {
    pub(super) const NUMBER: u64 = 1;
}

impl From<FormatVersion> for u64 {
    fn from(_: FormatVersion) -> Self {
        FormatVersion::NUMBER
    }
}

impl TryFrom<u64> for FormatVersion {
    type Error = String;

    fn try_from(version: u64) -> Result<Self, String> {
        match version {
            Self::NUMBER => Ok(Self),
            _ => Err(format!("version takes {}, found `{version}`", Self::NUMBER)),
        }
    }
}

impl Script {
    /// The pigments of the palette in `library`. Slots are in the order of their letters.
    ///
    /// # Errors
    /// [`Fault`] of a letter if the library does not have its pigment, or has it twice, or if
    /// another letter means the same pigment. [`super::ScriptError::located`] adds its line.
    pub fn slots(&self, library: &PigmentLibrary) -> Result<Slots, Box<Fault>> {
        let mut slots = Slots::default();
        for (slot, (letter, name)) in self.palette.iter().enumerate() {
            let key = KeyPath::of("palette").key(letter);
            if slot == SLOTS {
                let wanted = format!("at most {SLOTS} pigments");
                return Err(Fault::new(&key, wanted, self.palette.len(), "leave this one out"));
            }
            let found = library.find(name).map_err(|error| {
                let known = library.pigments.iter().map(|pigment| pigment.name.as_str());
                let similar = similar_names(name, known);
                let hint = match similar.is_empty() {
                    true => error.hint().map_or_else(|| error.to_string(), |hint| hint.to_string()),
                    false => format!("did you mean {}?", similar.join(" or ")),
                };
                Fault::new(&key, "a pigment of the library", name, hint)
            })?;
            if slots.contains(&Some(found)) {
                let hint = "leave one of the two out";
                return Err(Fault::new(&key, "a pigment that no other letter has", name, hint));
            }
            slots[slot] = Some(found);
        }
        Ok(slots)
    }

    /// Shares of the slots in a recipe of this script. They sum to 1, or are all 0 for a recipe
    /// without pigments.
    #[must_use]
    pub fn shares(&self, recipe: &Recipe) -> [f64; SLOTS] {
        let total: f64 = recipe.values().sum();
        let mut shares = [0.0; SLOTS];
        for (share, letter) in shares.iter_mut().zip(self.palette.keys()) {
            let part = recipe.get(letter).copied().unwrap_or(0.0);
            *share = if total > 0.0 { part / total } else { 0.0 };
        }
        shares
    }
}

const LONGEST: usize = 1024;

/// The model or photograph that a script paints.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Subject {
    /// A model that we make, written `shape:NAME`.
    Shape(SampleModel),
    /// A file with a model or a photograph.
    File(PathBuf),
}

impl Script {
    /// The subject. A path starts from `folder`, the folder of the script.
    ///
    /// # Errors
    /// [`Fault`] of `subject` for an unknown shape, another script, and for a path that is empty
    /// or has control characters.
    pub fn subject_in(&self, folder: &Path) -> Result<Subject, Box<Fault>> {
        self.check_subject()?;
        match self.subject.strip_prefix("shape:").and_then(SampleModel::from_name) {
            Some(shape) => Ok(Subject::Shape(shape)),
            None => Ok(Subject::File(folder.join(&self.subject))),
        }
    }

    pub(super) fn check_subject(&self) -> Checked {
        let key = KeyPath::of("subject");
        if let Some(name) = self.subject.strip_prefix("shape:") {
            if SampleModel::from_name(name).is_some() {
                return Ok(());
            }
            let names = SampleModel::ALL.map(SampleModel::name);
            let similar = similar_names(name, names);
            let hint = match similar.is_empty() {
                true => format!("shapes are {}", names.join(", ")),
                false => format!("did you mean shape:{}?", similar.join(" or shape:")),
            };
            return Err(Fault::new(&key, "the name of a shape after `shape:`", name, hint));
        }
        let ending = Path::new(&self.subject).extension();
        if ending.is_some_and(|ending| ending.eq_ignore_ascii_case("toml")) {
            let hint = "name the model or photograph that the other script paints";
            return Err(Fault::new(&key, "a model or a photograph", &self.subject, hint));
        }
        let fits =
            (1..=LONGEST).contains(&self.subject.len()) && !self.subject.contains(char::is_control);
        match fits {
            true => Ok(()),
            false => Err(Fault::new(
                &key,
                format!("a path of 1 to {LONGEST} bytes without control characters"),
                self.subject.escape_debug(),
                "subject = \"shape:still-life\" is a model that is always there",
            )),
        }
    }

    pub(super) fn check_files_beside(&self) -> Checked {
        if !self.subject.starts_with("shape:") {
            check_beside("subject", &self.subject)?;
        }
        for (key, path) in [("library", &self.library), ("lamp", &self.lamp)] {
            path.as_deref().map_or(Ok(()), |path| check_beside(key, path))?;
        }
        Ok(())
    }
}

fn check_beside(key: &str, path: &str) -> Checked {
    let mut parts = Path::new(path).components();
    // Colons and backslashes lead to other folders on Windows.
    let below =
        parts.all(|part| matches!(part, Component::Normal(_))) && !path.contains(['\\', ':']);
    match below {
        true => Ok(()),
        false => Err(Fault::new(
            &KeyPath::of(key),
            "a path below the script's folder",
            path,
            "put the file beside the script",
        )),
    }
}

const MATERIALS_LONGEST: usize = 1024;

/// We make a ground to try it, with cells of this width in mm.
const TRIED_MM: f64 = 0.2;

/// Whether a text names a light, i.e. an illuminant or a temperature. [`light_from_text`] also
/// reads files of lamps, for which a script has another key.
#[must_use]
pub fn is_light(text: &str) -> bool {
    let kelvin = text.strip_suffix(['K', 'k']).map(|number| {
        let number = number.strip_prefix(['D', 'd']).unwrap_or(number);
        number.parse::<f64>().is_ok()
    });
    (Illuminant::named(text).is_ok() || kelvin == Some(true)) && light_from_text(text).is_ok()
}

impl Script {
    /// The library that the script names. `None` if it does not name one. A path starts from
    /// `folder`, the folder of the script.
    ///
    /// # Errors
    /// [`LibraryError`] if its file is missing, or is no library.
    pub fn open_library(&self, folder: &Path) -> Result<Option<PigmentLibrary>, LibraryError> {
        match self.library_file(folder) {
            Some(file) => PigmentLibrary::open(file).map(Some),
            None => Ok(self.library.as_ref().map(|_| PigmentLibrary::van_gogh_oils())),
        }
    }

    /// The file of the library that the script names. `None` if it does not name one, or names the
    /// oils that we ship.
    #[must_use]
    pub fn library_file(&self, folder: &Path) -> Option<PathBuf> {
        let name = self.library.as_ref()?;
        (*name != PigmentLibrary::van_gogh_oils().title).then(|| folder.join(name))
    }

    /// The light on pigments, which you can pass to [`light_from_text`]. `None` for D65. The file
    /// of a lamp starts from `folder`, the folder of the script.
    #[must_use]
    pub fn light(&self, folder: &Path) -> Option<String> {
        let lamp = self.lamp.as_ref().map(|lamp| folder.join(lamp).to_string_lossy().into_owned());
        lamp.or_else(|| self.illuminant.clone())
    }

    /// The ground under pigments of `library`.
    ///
    /// # Errors
    /// [`Fault`] of a ground that cannot be made, for example because its colour is not a colour.
    /// [`super::ScriptError::located`] adds its line.
    pub fn ground_under(&self, library: &PigmentLibrary) -> Result<GroundSpec, Box<Fault>> {
        let Some(ground) = &self.ground else { return Ok(GroundKind::Panel.spec(1)) };
        match ground.build(1, 1, TRIED_MM, library) {
            Ok(_) => Ok(ground.clone()),
            Err(error) => {
                let hint = error.hint().map_or_else(
                    || "leave it out for a white panel".to_owned(),
                    |hint| hint.to_string(),
                );
                let wanted = "a ground that can be made";
                Err(Fault::new(&KeyPath::of("ground"), wanted, error, hint))
            }
        }
    }

    pub(super) fn check_materials(&self) -> Checked {
        let light = self.illuminant.as_deref();
        fn fits(path: &str) -> bool {
            (1..=MATERIALS_LONGEST).contains(&path.len()) && !path.contains(char::is_control)
        }
        for (key, path, hint) in [
            ("library", &self.library, "name the file of a pigment library, or leave it out"),
            ("lamp", &self.lamp, "name the file of a lamp's spectrum, or leave it out"),
        ] {
            if let Some(path) = path.as_deref().filter(|path| !fits(path)) {
                let wanted = format!("a path of 1 to {LONGEST} bytes without control characters");
                return Err(Fault::new(&KeyPath::of(key), wanted, path.escape_debug(), hint));
            }
        }
        if let (Some(lamp), Some(_)) = (&self.lamp, light) {
            let hint = "leave illuminant or lamp out";
            return Err(Fault::new(&KeyPath::of("lamp"), "a light given once", lamp, hint));
        }
        let relief = self.ground.as_ref().map(|ground| &ground.relief);
        let other = match relief {
            Some(GroundRelief::Wood(_)) => Some("wood"),
            Some(GroundRelief::Image(_)) => Some("image"),
            _ => None,
        };
        let table = KeyPath::of("ground");
        if let Some(other) = other {
            let hint = "kind = \"panel\" is nearly flat";
            return Err(Fault::new(&table.key("kind"), "linen, paper or panel", other, hint));
        }
        let reflectance = self.ground.as_ref().and_then(|ground| ground.reflectance.as_ref());
        match reflectance {
            Some(Primer::Grey(own)) if !(0.0..=1.0).contains(own) => {
                let hint = "leave it out for the white of the library";
                return Err(Fault::new(&table.key("reflectance"), "0 to 1", own, hint));
            }
            _ => {}
        }
        if let Some(light) = light.filter(|light| !is_light(light)) {
            let wanted = "the name of an illuminant, or a temperature";
            let hint = "D65, A, FL11, LED-B3 and 5600K are lights";
            let key = KeyPath::of("illuminant");
            return Err(Fault::new(&key, wanted, light.escape_debug(), hint));
        }
        Ok(())
    }
}

/// How the volumes of a region show what they hold.
#[derive(Debug, Clone, PartialEq)]
pub struct RegionStyle {
    /// Its name. If a script lists no regions, its only region has an empty name.
    pub name: String,
    /// How the scene looks inside of its volumes.
    pub inside: Inside,
    /// Sizes of the shells, falling from 1.
    pub shells: Vec<f32>,
    /// Share of colour by the number of shells. There is one more share than shells.
    pub tints: Vec<f32>,
    /// Inside of volumes we multiply the grey drawing by this colour, written `#rrggbb`, and then
    /// lay the share of colour over it. Use white for a drawing that stays grey.
    pub stain: String,
}

impl Script {
    /// The regions in order, at least one. If a region leaves something out, `settings` give it.
    #[must_use]
    pub fn region_styles(&self, settings: &Settings) -> Vec<RegionStyle> {
        let unnamed = [RegionTable::default()];
        let regions = if self.regions.is_empty() { &unnamed } else { &self.regions[..] };
        fn narrow(list: &[f64]) -> Vec<f32> {
            list.iter().map(|&value| value as f32).collect::<Vec<_>>()
        }
        regions
            .iter()
            .map(|region: &RegionTable| {
                let drawing = &settings.drawing;
                let shells = region.shells.as_deref().map_or(drawing.shells.clone(), narrow);
                let tints = match (&region.tint, &region.shells) {
                    (Some(tint), _) => narrow(tint),
                    (None, Some(_)) => Vec::new(),
                    (None, None) => drawing.tint.clone(),
                };
                let tints =
                    if tints.is_empty() { narrow(&even_tints(shells.len())) } else { tints };
                let inside = region.inside.unwrap_or(drawing.inside);
                let stain = region.stain.as_ref().unwrap_or(&drawing.stain).clone();
                RegionStyle { name: region.name.clone(), inside, shells, tints, stain }
            })
            .collect()
    }

    /// Index of the region with this name. Without a name, this is the first.
    pub(super) fn region_index(&self, name: Option<&str>) -> Option<usize> {
        match name {
            None => Some(0),
            Some(name) => self.regions.iter().position(|region| region.name == name),
        }
    }
}
