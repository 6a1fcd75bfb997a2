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
    /// use watercolor::Preset;
    /// let settings = Preset::Sketch.settings().changed("here", "edges.strength = 3.0")?;
    /// assert_eq!(settings.edges.strength, 3.0);
    /// # Ok::<(), watercolor::SettingsError>(())
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
    use super::super::Preset;

    #[test]
    fn settings_that_are_not_named_stay() {
        let sketch = Preset::Sketch.settings();
        assert_eq!(sketch.changed("none", "").unwrap(), sketch);
        let text = "[paper]\nseed = 7\n[dry_brush]\ncolour = \"#102030\"";
        let changed = sketch.changed("some", text).unwrap();
        assert_eq!((changed.paper.seed, changed.dry_brush.color.as_deref()), (7, Some("#102030")));
        let mut back = changed;
        back.paper.seed = sketch.paper.seed;
        back.dry_brush.color.clone_from(&sketch.dry_brush.color);
        assert_eq!(back, sketch);
    }

    #[test]
    fn errors_name_the_line_of_the_text() {
        let sketch = Preset::Sketch.settings();
        for (text, wanted) in [
            ("\nedges.strength = 99", "mine, line 2: edges.strength takes 0 to 10, found `99`"),
            ("edges.stronger = 1", "mine, line 1: unknown key `stronger`"),
            ("edges = ", "mine, line 1"),
        ] {
            let error = sketch.changed("mine", text).unwrap_err().to_string();
            assert!(error.starts_with(wanted), "{error}");
        }
    }
}
