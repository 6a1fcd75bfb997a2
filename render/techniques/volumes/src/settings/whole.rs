//! All settings of paint volumes together.

use serde::{Deserialize, Serialize};
use toml::{Table, Value};

use super::drawing::{self, DrawingTable, HatchingTable};
use super::grid::{self, GridTable};
use super::motion::{self, MotionTable};
use super::picture::{self, GreyTable, LightTable, PictureTable};
use super::setting::{
    Setting,
    Takes::{Number, Whole},
};
use super::shells::check_shells;
use crate::toml_text::{Checked, Fault, KeyPath};

/// The settings of paint volumes. Keys that a file leaves out have the defaults.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Settings {
    /// Length of a unit of the scene in mm, 0..=1e6; 0 makes the scene's longest side 200 mm long.
    pub unit_mm: f32,
    /// Seed of everything random.
    pub seed: u32,
    /// Forces on particles.
    pub motion: MotionTable,
    /// Cells that paint spills over.
    pub grid: GridTable,
    /// Colour inside of volumes.
    pub drawing: DrawingTable,
    /// Pencil strokes of light and shade.
    pub hatching: HatchingTable,
    /// The light on the scene.
    pub light: LightTable,
    /// Grey outside of volumes.
    pub grey: GreyTable,
    /// Samples and paper of the picture.
    pub picture: PictureTable,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            unit_mm: 0.0,
            seed: 1,
            motion: MotionTable::default(),
            grid: GridTable::default(),
            drawing: DrawingTable::default(),
            hatching: HatchingTable::default(),
            light: LightTable::default(),
            grey: GreyTable::default(),
            picture: PictureTable::default(),
        }
    }
}

const OWN: [Setting; 2] = [
    Setting::new(
        "unit_mm",
        Number(0.0, 1e6),
        "mm",
        "Length of a unit of the scene; 0 makes the scene's longest side 200 mm long.",
    ),
    Setting::new("seed", Whole(0, u32::MAX as u64), "", "Seed of everything random."),
];

impl Settings {
    /// All settings with their ranges, units and meanings, in the order of a file.
    pub fn all() -> impl Iterator<Item = &'static Setting> {
        OWN.iter()
            .chain(&motion::SETTINGS)
            .chain(&grid::SETTINGS)
            .chain(&drawing::SETTINGS)
            .chain(&picture::SETTINGS)
    }

    /// The settings as a table of TOML.
    ///
    /// # Panics
    /// Never: numbers and words can be written.
    pub(super) fn table(&self) -> Table {
        Table::try_from(self).expect("numbers and words can be written")
    }

    /// Checks that every value is in its range. Faults name keys below `base`.
    pub(super) fn check_ranges(&self, base: &KeyPath) -> Checked {
        let table = self.table();
        for setting in Self::all() {
            let Some(value) = value_of(&table, setting.key) else { continue };
            if !setting.fits(value) {
                let usual = Self::default().table();
                let usual = value_of(&usual, setting.key).map(text_of).unwrap_or_default();
                let key = base.join(&KeyPath::of(setting.key));
                let wanted = setting.takes.to_string();
                return Err(Fault::new(&key, wanted, text_of(value), format!("{usual} is usual")));
            }
        }
        Ok(())
    }

    /// Checks settings that belong together. Faults name keys below `base`.
    pub(super) fn check_together(&self, base: &KeyPath) -> Checked {
        let numbers = |list: &[f32]| list.iter().map(|&number| plain(number)).collect::<Vec<_>>();
        let DrawingTable { shells, tint, .. } = &self.drawing;
        check_shells(&base.join(&KeyPath::of("drawing")), &numbers(shells), &numbers(tint))
    }
}

/// The value of `group.key`.
pub(super) fn value_of<'t>(table: &'t Table, key: &str) -> Option<&'t Value> {
    match key.split_once('.') {
        Some((group, key)) => table.get(group)?.get(key),
        None => table.get(key),
    }
}

/// A number with the digits that it has in a file.
fn plain(number: f32) -> f64 {
    number.to_string().parse().unwrap_or_else(|_| f64::from(number))
}

/// A value as a file has it. Numbers of settings are f32, so they are written as such.
pub(super) fn text_of(value: &Value) -> String {
    match value {
        Value::Float(number) => format!("{:?}", *number as f32).to_lowercase(),
        Value::Array(list) => {
            format!("[{}]", list.iter().map(text_of).collect::<Vec<_>>().join(", "))
        }
        other => other.to_string(),
    }
}
