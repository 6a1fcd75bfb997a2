//! Changes of single settings.

use documents::ParserReason;
use toml::{Table, Value};

use super::file::SettingsError;
use super::whole::Settings;

impl Settings {
    /// A copy of these settings in which the keys of `text` (TOML) are replaced. Errors call
    /// the text `name`.
    ///
    /// ```
    /// use painterly::Preset;
    /// let settings = Preset::Impressionist.settings().changed("here", "overlap.splats = 12.0")?;
    /// assert_eq!(settings.overlap.splats, 12.0);
    /// # Ok::<(), painterly::SettingsError>(())
    /// ```
    ///
    /// # Errors
    /// [`SettingsError`] if the text is no TOML, a key is unknown, or a value is out of its
    /// range.
    pub fn changed(&self, name: &str, text: &str) -> Result<Self, SettingsError> {
        // The text is parsed alone first, so that errors give its line numbers.
        Self::from_toml(name, text)?;
        let broken = |message: String| {
            let ParserReason { reason, hint } = ParserReason::of(&message);
            SettingsError::Line { name: name.to_owned(), line: 1, reason, hint }
        };
        let mut all = Table::try_from(self).map_err(|error| broken(error.to_string()))?;
        let changes: Table =
            text.parse().map_err(|error: toml::de::Error| broken(error.to_string()))?;
        for (key, change) in changes {
            match (all.get_mut(&key), change) {
                (Some(Value::Table(group)), Value::Table(changes)) => group.extend(changes),
                (_, change) => {
                    all.insert(key, change);
                }
            }
        }
        all.try_into().map_err(|error: toml::de::Error| broken(error.to_string()))
    }
}

#[cfg(test)]
mod tests {
    use documents::hint::Explain;

    use super::super::Preset;

    #[test]
    fn settings_that_are_not_named_stay() {
        let paper = Preset::Paper.settings();
        assert_eq!(paper.changed("none", "").unwrap(), paper);
        let changed =
            paper.changed("some", "[strokes]\nseed = 7\n[overlap]\nsharpness = 8").unwrap();
        assert_eq!((changed.strokes.seed, changed.overlap.sharpness), (7, 8));
        let mut back = changed;
        back.strokes.seed = paper.strokes.seed;
        back.overlap.sharpness = paper.overlap.sharpness;
        assert_eq!(back, paper);
    }

    #[test]
    fn presets_have_every_key_with_its_meaning() {
        let all = toml::Table::try_from(super::Settings::default()).unwrap();
        for preset in Preset::ALL {
            let text = preset.text();
            let table: toml::Table = text.parse().unwrap();
            for (key, value) in &all {
                assert!(table.contains_key(key), "{} has no {key}", preset.name());
                let toml::Value::Table(group) = value else { continue };
                for inner in group.keys() {
                    let found = table[key].as_table().unwrap().contains_key(inner);
                    assert!(found, "{} has no {key}.{inner}", preset.name());
                }
            }
            assert_eq!(preset.settings(), super::Settings::from_toml("again", text).unwrap());
            assert_eq!(preset.name().parse::<Preset>().unwrap(), preset);
            assert!(artmap::painted::Style::named(preset.style()).is_ok(), "{}", preset.style());
        }
    }

    #[test]
    fn errors_name_the_line_of_the_text_or_the_preset_that_is_meant() {
        let paper = Preset::Paper.settings();
        for (text, wanted) in [
            ("\nlight.wrap = 2", "mine, line 2: light.wrap takes 0 to 1, found `2`"),
            ("[overlap]\nsharpness = 3", "mine, line 2: overlap.sharpness is 1, 2, 4, 8 or 16"),
            ("strokes.wide = 1", "mine, line 1: unknown key `wide`"),
            ("strokes = ", "mine, line 1"),
            ("[flow]\nperiods = 1\nperiods = 2", "mine, line 3: duplicate key"),
        ] {
            let error = paper.changed("mine", text).unwrap_err().to_string();
            assert!(error.starts_with(wanted), "{error}");
        }
        let unknown = "hatchng".parse::<Preset>().unwrap_err();
        assert_eq!(unknown.hint().unwrap().to_string(), "did you mean hatching?");
    }
}
