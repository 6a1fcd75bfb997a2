//! Changes of single settings.

use toml::{Table, Value};

use super::error::SettingsError;
use super::whole::Settings;
use crate::toml_text::{Fault, KeyPath, Source};

impl Settings {
    /// A copy of these settings in which the keys of `text` (TOML) are replaced. Errors call
    /// the text `name`.
    ///
    /// ```
    /// use volumes::settings::Preset;
    /// let settings = Preset::Sketch.settings().changed("here", "motion.kick = 1.5")?;
    /// assert_eq!(settings.motion.kick, 1.5);
    /// # Ok::<(), volumes::settings::SettingsError>(())
    /// ```
    ///
    /// # Errors
    /// [`SettingsError`] if the text is no TOML, a key is unknown, or a value is out of its
    /// range.
    pub fn changed(&self, name: &str, text: &str) -> Result<Self, SettingsError> {
        let source = Source::parse(name, text)?;
        // The text is read alone first, so that errors give its lines and keys.
        source.typed::<Self>()?;
        let changes: Table = source.typed()?;
        let changed = self.changed_by(&changes, &KeyPath::default());
        changed.map_err(|fault| source.located(fault).into())
    }

    /// A copy of these settings in which the keys of `changes` are replaced. Faults name keys
    /// below `base`.
    pub(crate) fn changed_by(&self, changes: &Table, base: &KeyPath) -> Result<Self, Box<Fault>> {
        let mut all = self.table();
        for (key, change) in changes {
            match (all.get_mut(key), change) {
                (Some(Value::Table(group)), Value::Table(changes)) => {
                    group.extend(changes.iter().map(|(key, value)| (key.clone(), value.clone())));
                }
                (_, change) => {
                    all.insert(key.clone(), change.clone());
                }
            }
        }
        let whole: Result<Self, toml::de::Error> = all.try_into();
        let changed = whole.map_err(|error| {
            let hint = "a preset's file has each key with its meaning";
            Fault::new(base, "keys and values of settings", error.message(), hint)
        })?;
        changed.check_ranges(base)?;
        changed.check_together(base)?;
        Ok(changed)
    }
}
