//! Reads scripts, checks every value of them, changes their settings, and writes them as text. Also
//! has the errors of scripts.

use std::collections::BTreeMap;
use std::path::Path;

use documents::hint::Explain;
use documents::{counted, similar_names};
use paint::layer::SLOTS;
use serde::Deserialize;
use spectra::color::Rgb;
use toml::{Table, Value};

use super::file::{FormatVersion, Script};
use super::rows::{
    Ball, MOST_EVENTS, MOST_LENGTH, MOST_POINTS, Pair, Row, check_count, check_direction,
    check_name, check_particles, check_place, check_positive, check_range, check_time,
};
use super::tables::{
    DryTable, KeepTable, LiftTable, PourTable, PushTable, SplitTable, VolumeTable,
};
use crate::drawing::MOST_REGIONS;
use crate::settings::{GridTable, Preset, Settings, SettingsError, check_shells};
use crate::toml_text::{Checked, Fault, KeyPath, Source, TextError, read_text};
use crate::volume::MOST_DETAIL;
use crate::world::MOST_VOLUMES;

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

impl Script {
    /// Checks every value of the script. To look up pigments, use [`Script::slots`].
    ///
    /// # Errors
    /// [`Fault`] of the first wrong value, with its key and the way out.
    pub fn check(&self) -> Result<(), Box<Fault>> {
        self.check_subject()?;
        check_time(&KeyPath::of("seconds"), self.seconds)?;
        if let Some(unit_mm) = self.unit_mm {
            check_positive(&KeyPath::of("unit_mm"), unit_mm, 1e6)?;
        }
        self.check_palette()?;
        self.check_materials()?;
        self.check_counts()?;
        let settings = self.settings()?;
        if let Some(camera) = &self.camera {
            camera.check()?;
        }
        self.check_regions(&settings)?;
        self.check_tables()?;
        if !self.splits.is_empty() && settings.grid.cell == 0.0 {
            let key = KeyPath::of("split").index(0);
            let hint = "set grid.cell above 0, or leave [[split]] out";
            return Err(Fault::new(&key, "a grid to split into", "grid.cell = 0", hint));
        }
        Ok(())
    }

    /// The settings of the preset (by default [`Preset::Sketch`]), which the tables `settings` and
    /// `grid` and `unit_mm` change.
    ///
    /// # Errors
    /// [`Fault`] of the first value that is out of its range, or given twice.
    pub fn settings(&self) -> Result<Settings, Box<Fault>> {
        for (key, twice) in [("grid", !self.grid.is_empty()), ("unit_mm", self.unit_mm.is_some())] {
            if twice && self.settings.get(key).is_some() {
                let hint = format!("leave settings.{key} out");
                let key = KeyPath::of("settings").key(key);
                return Err(Fault::new(&key, "values given once", "a second place", hint));
            }
        }
        let preset = self.preset.unwrap_or(Preset::Sketch).settings();
        let settings = preset.changed_by(&self.settings, &KeyPath::of("settings"))?;
        let grid = Table::from_iter([("grid".to_owned(), Value::Table(self.grid.clone()))]);
        let mut settings = settings.changed_by(&grid, &KeyPath::default())?;
        if let Some(unit_mm) = self.unit_mm {
            settings.unit_mm = unit_mm as f32;
        }
        Ok(settings)
    }

    fn check_palette(&self) -> Checked {
        let key = KeyPath::of("palette");
        if let Some(ninth) = self.palette.keys().nth(SLOTS) {
            let hint = format!("leave out {} of them", self.palette.len() - SLOTS);
            let wanted = format!("at most {SLOTS} pigments");
            return Err(Fault::new(&key.key(ninth), wanted, self.palette.len(), hint));
        }
        for (letter, name) in &self.palette {
            check_name(&key.key(letter), letter)?;
            check_name(&key.key(letter), name)?;
        }
        Ok(())
    }

    fn check_counts(&self) -> Checked {
        check_count("region", self.regions.len(), MOST_REGIONS)?;
        check_count("volume", self.volumes.len(), MOST_VOLUMES)?;
        let details: Vec<u8> = self.volumes.iter().map(|volume| volume.detail.min(5)).collect();
        check_particles(&details)?;
        let mut left = MOST_EVENTS;
        for (key, count) in [
            ("volume", self.volumes.len()),
            ("keep", self.keeps.len()),
            ("pour", self.pours.len()),
            ("push", self.pushes.len()),
            ("lift", self.lifts.len()),
            ("split", self.splits.len()),
            ("dry", self.dries.len()),
        ] {
            check_count(key, count, left)?;
            left -= count;
        }
        let paths = self.pours.iter().map(|pour| &pour.path);
        let points: usize =
            paths.chain(self.lifts.iter().map(|lift| &lift.path)).map(Vec::len).sum();
        if points > MOST_POINTS {
            let hint = format!("leave out every other point: {MOST_POINTS} fit");
            let wanted = format!("at most {MOST_POINTS} points in all paths");
            return Err(Fault::new(&KeyPath::of("pour"), wanted, points, hint));
        }
        Ok(())
    }
}

/// You can pour at most this much in mm3, or in mm3 per second.
const MOST_MM3: f64 = 1e9;

/// Largest acceleration of a push in cells per second squared.
const MOST_STRENGTH: f64 = 1e6;

impl Script {
    fn check_tables(&self) -> Checked {
        fn each(name: &str, index: usize) -> KeyPath {
            KeyPath::of(name).index(index)
        }
        for (index, keep) in self.keeps.iter().enumerate() {
            check_keep(&each("keep", index), keep)?;
        }
        for (index, volume) in self.volumes.iter().enumerate() {
            self.check_volume(&each("volume", index), volume)?;
        }
        for (index, pour) in self.pours.iter().enumerate() {
            self.check_pour(&each("pour", index), pour)?;
        }
        for (index, push) in self.pushes.iter().enumerate() {
            check_push(&each("push", index), push)?;
        }
        for (index, lift) in self.lifts.iter().enumerate() {
            check_lift(&each("lift", index), lift)?;
        }
        for (index, split) in self.splits.iter().enumerate() {
            self.check_split(&each("split", index), split)?;
        }
        for (index, dry) in self.dries.iter().enumerate() {
            check_dry(&each("dry", index), dry)?;
        }
        Ok(())
    }

    fn check_volume(&self, key: &KeyPath, volume: &VolumeTable) -> Checked {
        check_place(&key.key("centre"), volume.center.0)?;
        check_positive(&key.key("radius"), volume.radius, MOST_LENGTH)?;
        if volume.detail > MOST_DETAIL {
            let wanted = format!("0 to {MOST_DETAIL}");
            return Err(Fault::new(&key.key("detail"), wanted, volume.detail, "3 is usual"));
        }
        check_time(&key.key("from_s"), volume.from_s)?;
        self.check_region_name(key, volume.region.as_deref())?;
        self.check_recipe(key, &volume.recipe)
    }

    fn check_pour(&self, key: &KeyPath, pour: &PourTable) -> Checked {
        check_source(key, pour.at, pour.picked, &pour.path)?;
        check_span(key, [pour.from_s, pour.for_s])?;
        check_quantity(key, pour.amount_mm3, pour.rate_mm3_s, pour.for_s)?;
        self.check_region_name(key, pour.region.as_deref())?;
        self.check_recipe(key, &pour.recipe)
    }

    fn check_recipe(&self, table: &KeyPath, recipe: &BTreeMap<String, f64>) -> Checked {
        let key = table.key("recipe");
        let letters: Vec<&str> = self.palette.keys().map(String::as_str).collect();
        for (letter, &part) in recipe {
            if !self.palette.contains_key(letter) {
                let hint = match letters.is_empty() {
                    true => format!("add [palette] with {letter} = \"...\", or leave recipe out"),
                    false => format!("[palette] has {}", letters.join(", ")),
                };
                return Err(Fault::new(&key.key(letter), "a letter of [palette]", letter, hint));
            }
            check_range(&key.key(letter), part, [0.0, 1e6])?;
        }
        let example = format!("recipe = {{ {} = 1 }}", letters.first().unwrap_or(&"B"));
        if recipe.is_empty() && !letters.is_empty() {
            let wanted = "letters of [palette] with their parts";
            return Err(Fault::new(&key, wanted, "nothing", example));
        }
        if !recipe.is_empty() && recipe.values().sum::<f64>() <= 0.0 {
            return Err(Fault::new(&key, "a part above 0", "only 0", example));
        }
        Ok(())
    }

    fn check_split(&self, key: &KeyPath, split: &SplitTable) -> Checked {
        check_time(&key.key("at_s"), split.at_s)?;
        let count = self.volumes.len();
        match split.volume {
            Some(number) if !(1..=count).contains(&(number as usize)) => {
                let hint = match count {
                    0 => "add a [[volume]]".to_owned(),
                    _ => "volumes count from 1 in the order of the script".to_owned(),
                };
                let wanted = format!("the number of one of {}", counted(count, "volume"));
                Err(Fault::new(&key.key("volume"), wanted, number, hint))
            }
            _ => Ok(()),
        }
    }
}

fn check_push(key: &KeyPath, push: &PushTable) -> Checked {
    check_place(&key.key("at"), push.at.0)?;
    check_direction(&key.key("towards"), push.towards.0)?;
    check_positive(&key.key("radius"), push.radius, MOST_LENGTH)?;
    check_range(&key.key("strength"), push.strength, [0.0, MOST_STRENGTH])?;
    check_span(key, [push.from_s, push.for_s])?;
    check_positive(&key.key("for_s"), push.for_s, super::rows::MOST_SECONDS)
}

fn check_lift(key: &KeyPath, lift: &LiftTable) -> Checked {
    check_source(key, lift.at, lift.picked, &lift.path)?;
    check_positive(&key.key("radius"), lift.radius, MOST_LENGTH)?;
    check_span(key, [lift.from_s, lift.for_s])?;
    check_range(&key.key("rate"), lift.rate, [0.0, 120.0])
}

fn check_dry(key: &KeyPath, dry: &DryTable) -> Checked {
    check_time(&key.key("at_s"), dry.at_s)?;
    match (dry.at, dry.radius) {
        (None, None) => Ok(()),
        (Some(Row(at)), Some(radius)) => {
            check_place(&key.key("at"), at)?;
            check_positive(&key.key("radius"), radius, MOST_LENGTH)
        }
        (at, _) => {
            let (own, other) = if at.is_some() { ("at", "radius") } else { ("radius", "at") };
            let hint = format!("add {other}, or leave {own} out: then all paint dries");
            Err(Fault::new(&key.key(own), format!("{other} beside it"), "none", hint))
        }
    }
}

fn check_keep(key: &KeyPath, keep: &KeepTable) -> Checked {
    match (keep.cuboid, keep.sphere, keep.above) {
        (Some(Pair([low, high])), None, None) => {
            let key = key.key("box");
            for (corner, place) in [low, high].into_iter().enumerate() {
                check_place(&key.index(corner), place)?;
            }
            if (0..3).any(|axis| low[axis] >= high[axis]) {
                let wanted = "a lower corner that is below the upper one on every axis";
                let hint = "[[-1.0, -1.0, -1.0], [1.0, 1.0, 1.0]] is a box around the origin";
                return Err(Fault::new(&key, wanted, format!("{low:?}, {high:?}"), hint));
            }
            Ok(())
        }
        (None, Some(Ball { center, radius }), None) => {
            check_place(&key.key("sphere").index(0), center)?;
            check_positive(&key.key("sphere").index(1), radius, MOST_LENGTH)
        }
        (None, None, Some(Pair([point, normal]))) => {
            check_place(&key.key("above").index(0), point)?;
            check_direction(&key.key("above").index(1), normal)
        }
        given => {
            let keys =
                [given.0.map(|_| "box"), given.1.map(|_| "sphere"), given.2.map(|_| "above")];
            one_of(key, "box, sphere and above", &keys)
        }
    }
}

/// The fault of a table that has none or several of the keys in `names`, although it needs exactly
/// one. `keys` lists the ones that it has.
fn one_of(table: &KeyPath, names: &str, keys: &[Option<&str>]) -> Checked {
    let given: Vec<&str> = keys.iter().flatten().copied().collect();
    let (key, found, hint) = match given[..] {
        [_, second, ..] => (table.key(second), given.join(" and "), format!("leave {second} out")),
        _ => (table.clone(), "none".to_owned(), "add one of them".to_owned()),
    };
    Err(Fault::new(&key, format!("exactly one of {names}"), found, hint))
}

fn check_source(
    key: &KeyPath,
    at: Option<Row<3>>,
    picked: Option<Row<2>>,
    path: &[Row<4>],
) -> Checked {
    // A path may repeat its first place as `at`.
    let repeated = path.first().is_some_and(|&Row([_, x, y, z])| at == Some(Row([x, y, z])));
    let at = at.filter(|_| !repeated);
    let keys =
        [at.map(|_| "at"), picked.map(|_| "picked"), Some("path").filter(|_| !path.is_empty())];
    if keys.iter().flatten().count() != 1 {
        return one_of(key, "at, picked and path", &keys);
    }
    if let Some(Row(at)) = at {
        check_place(&key.key("at"), at)?;
    }
    for (axis, share) in picked.iter().flat_map(|row| row.0).enumerate() {
        check_range(&key.key("picked").index(axis), share, [0.0, 1.0])?;
    }
    let mut before = -1.0;
    for (index, &Row([seconds, x, y, z])) in path.iter().enumerate() {
        let key = key.key("path").index(index);
        check_time(&key.index(0), seconds)?;
        if seconds <= before {
            let hint = "order the points by their seconds";
            return Err(Fault::new(&key, format!("a time after {before} s"), seconds, hint));
        }
        before = seconds;
        check_place(&key, [x, y, z])?;
    }
    Ok(())
}

fn check_span(key: &KeyPath, [from, duration]: [f64; 2]) -> Checked {
    check_time(&key.key("from_s"), from)?;
    check_time(&key.key("for_s"), duration)
}

fn check_quantity(key: &KeyPath, amount: Option<f64>, rate: Option<f64>, duration: f64) -> Checked {
    match (amount, rate) {
        (Some(amount), None) => check_positive(&key.key("amount_mm3"), amount, MOST_MM3),
        (None, Some(rate)) => {
            check_positive(&key.key("rate_mm3_s"), rate, MOST_MM3)?;
            if duration > 0.0 {
                return Ok(());
            }
            let hint = "add for_s = 1.0, or give amount_mm3 instead of the rate";
            Err(Fault::new(&key.key("for_s"), "a duration above 0 beside a rate", duration, hint))
        }
        (amount, rate) => one_of(
            key,
            "amount_mm3 and rate_mm3_s",
            &[amount.map(|_| "amount_mm3"), rate.map(|_| "rate_mm3_s")],
        ),
    }
}

impl Script {
    fn check_region_name(&self, table: &KeyPath, name: Option<&str>) -> Checked {
        if self.region_index(name).is_some() {
            return Ok(());
        }
        let name = name.unwrap_or_default();
        let names: Vec<&str> = self.regions.iter().map(|region| region.name.as_str()).collect();
        let similar = similar_names(name, names.iter().copied());
        let hint = match (similar.is_empty(), names.is_empty()) {
            (false, _) => format!("did you mean {}?", similar.join(" or ")),
            (true, false) => format!("regions are {}", documents::name_list(&names, 8, ", ")),
            (true, true) => format!("add [[region]] with name = \"{}\"", name.escape_debug()),
        };
        Err(Fault::new(&table.key("region"), "the name of a [[region]]", name, hint))
    }

    fn check_regions(&self, settings: &Settings) -> Checked {
        fn plain(list: &[f32]) -> Vec<f64> {
            list.iter().map(|&value| f64::from(value)).collect::<Vec<_>>()
        }
        let shells = plain(&settings.drawing.shells);
        let tints = plain(&settings.drawing.tint);
        for (index, region) in self.regions.iter().enumerate() {
            let table = KeyPath::of("region").index(index);
            check_name(&table.key("name"), &region.name)?;
            if self.region_index(Some(&region.name)) != Some(index) {
                let hint = "give each region its own name";
                let wanted = "a name that no other region has";
                return Err(Fault::new(&table.key("name"), wanted, &region.name, hint));
            }
            let tint = match (&region.tint, &region.shells) {
                (Some(tint), _) => &tint[..],
                (None, Some(_)) => &[],
                (None, None) => &tints,
            };
            if let Some(stain) = region.stain.as_ref().filter(|own| Rgb::from_hex(own).is_none()) {
                let key = table.key("stain");
                let hint = "#ffffff leaves the drawing grey";
                return Err(Fault::new(
                    &key,
                    "a colour written #rrggbb",
                    stain.escape_debug(),
                    hint,
                ));
            }
            check_shells(&table, region.shells.as_deref().unwrap_or(&shells), tint)?;
        }
        Ok(())
    }
}

impl Script {
    /// Replaces settings of the script by the ones in `text` (TOML). Errors call this text `name`.
    ///
    /// # Errors
    /// [`SettingsError`] if the text is no TOML, a key is unknown, or a value is out of its range.
    pub fn change_settings(&mut self, name: &str, text: &str) -> Result<(), SettingsError> {
        let settings = self.settings().map_err(TextError::from)?;
        settings.changed(name, text)?;
        let mut changes: Table = Source::toml(name, text)?.typed()?;
        if let Some(Value::Table(grid)) = changes.remove("grid") {
            let own = match self.grid.is_empty() {
                true => group(&mut self.settings, "grid"),
                false => &mut self.grid,
            };
            own.extend(grid);
        }
        if changes.contains_key("unit_mm") {
            self.unit_mm = None;
        }
        for (key, change) in changes {
            match change {
                Value::Table(values) => group(&mut self.settings, &key).extend(values),
                value => {
                    self.settings.insert(key, value);
                }
            }
        }
        Ok(())
    }

    /// Leaves the light out unless the script asks for it. Use this for a photograph, which has
    /// its own light.
    pub fn light_of_its_own(&mut self) {
        let light = group(&mut self.settings, "light");
        light.entry("lit").or_insert(Value::Boolean(false));
    }
}

/// The group of settings with this name. Makes it if there is none.
fn group<'t>(settings: &'t mut Table, name: &str) -> &'t mut Table {
    let group = settings.entry(name).or_insert_with(|| Value::Table(Table::new()));
    if !group.is_table() {
        *group = Value::Table(Table::new());
    }
    match group {
        Value::Table(group) => group,
        _ => unreachable!("made a table above"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn changes_join_the_settings_of_a_script() {
        let mut script = Script::new("shape:sphere", 1.0);
        script.unit_mm = Some(2.0);
        script.change_settings("a", "motion.kick = 0.5\ngrid.rate = 0.01").unwrap();
        script.change_settings("b", "unit_mm = 3.0\n[motion]\ngrain = 0.5").unwrap();
        let settings = script.settings().unwrap();
        assert_eq!((settings.motion.kick, settings.motion.grain), (0.5, 0.5));
        assert_eq!((settings.grid.rate, settings.unit_mm), (0.01, 3.0));
        let error = script.change_settings("c", "motion.kick = -1.0").unwrap_err();
        assert!(error.to_string().contains("kick"), "{error}");
        assert_eq!(script.settings().unwrap(), settings);
        script.light_of_its_own();
        assert!(!script.settings().unwrap().light.lit);
        script.change_settings("d", "light.lit = true").unwrap();
        script.light_of_its_own();
        assert!(script.settings().unwrap().light.lit);
        let written = Script::from_text("s", &script.to_text().unwrap()).unwrap();
        assert_eq!(written.settings().unwrap(), script.settings().unwrap());
    }
}
