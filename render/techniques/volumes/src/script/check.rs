//! Checks of a whole script, and its settings and regions put together.

use paint::layer::SLOTS;
use toml::{Table, Value};

use super::file::Script;
use super::limits::{MOST_EVENTS, MOST_POINTS, check_count, check_particles};
use super::ranges::{check_name, check_positive, check_time};
use crate::drawing::MOST_REGIONS;
use crate::settings::{Preset, Settings};
use crate::toml_text::{Checked, Fault, KeyPath};
use crate::world::MOST_VOLUMES;

impl Script {
    /// Checks every value of the script. Pigments are looked up by [`Script::slots`].
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

    /// The settings: those of the preset (without one [`Preset::Sketch`]), changed by the tables
    /// `settings` and `grid` and by `unit_mm`.
    ///
    /// # Errors
    /// [`Fault`] of the first value that is out of its range, or given twice.
    pub fn settings(&self) -> Result<Settings, Box<Fault>> {
        let own = |key: &str| self.settings.get(key).is_some();
        for (key, twice) in [("grid", !self.grid.is_empty()), ("unit_mm", self.unit_mm.is_some())] {
            if twice && own(key) {
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
