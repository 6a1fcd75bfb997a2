//! Changes of a script's settings.

use toml::{Table, Value};

use super::file::Script;
use crate::settings::SettingsError;
use crate::toml_text::Source;

impl Script {
    /// Replaces settings of the script by those of `text` (TOML), which errors call `name`.
    ///
    /// # Errors
    /// [`SettingsError`] if the text is no TOML, a key is unknown, or a value is out of its range.
    pub fn change_settings(&mut self, name: &str, text: &str) -> Result<(), SettingsError> {
        let settings = self.settings().map_err(crate::toml_text::TextError::from)?;
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

    /// Leaves the light out unless the script asks for it, as for a photograph, which has light of
    /// its own.
    pub fn light_of_its_own(&mut self) {
        let light = group(&mut self.settings, "light");
        light.entry("lit").or_insert(Value::Boolean(false));
    }
}

/// The group of settings with this name, which is made if there is none.
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
