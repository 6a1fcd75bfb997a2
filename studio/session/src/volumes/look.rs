//! The look of a scene: which picture is shown, and how.

use pigment::digits;
use render::volumes::painter::Show;
use render::volumes::script::Script;
use render::volumes::settings::{self, Settings};
use toml::{Table, Value};

/// The surfaces inside of the volumes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Inside {
    /// Their own colours.
    #[default]
    OwnColours,
    /// A film of the paint over the grey drawing.
    Glaze,
    /// A film of the paint over their own colours.
    Both,
}

impl Inside {
    /// All of them, in the order of the panel.
    pub const ALL: [Self; 3] = [Self::OwnColours, Self::Glaze, Self::Both];

    /// This choice in the words of settings.
    pub(super) fn as_setting(self) -> settings::Inside {
        match self {
            Self::OwnColours => settings::Inside::OwnColors,
            Self::Glaze => settings::Inside::Glaze,
            Self::Both => settings::Inside::Both,
        }
    }

    fn of(setting: settings::Inside) -> Self {
        match setting {
            settings::Inside::OwnColors => Self::OwnColours,
            settings::Inside::Glaze => Self::Glaze,
            settings::Inside::Both => Self::Both,
        }
    }

    /// This choice in the words of a script.
    fn word(self) -> &'static str {
        match self {
            Self::OwnColours => "own-colours",
            Self::Glaze => "glaze",
            Self::Both => "both",
        }
    }

    /// The next of them, round and round.
    #[must_use]
    pub fn next(self) -> Self {
        match self {
            Self::OwnColours => Self::Glaze,
            Self::Glaze => Self::Both,
            Self::Both => Self::OwnColours,
        }
    }
}

/// Where the light of a scene stands.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SceneLight {
    /// Where it stands, in degrees clockwise from the top of the picture.
    pub azimuth_deg: f64,
    /// How high it stands towards the viewer, in degrees, -90 to 90.
    pub elevation_deg: f64,
}

/// The look of a scene: which picture is shown, and how.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Look {
    /// The picture that is shown.
    pub show: Show,
    /// Whether surfaces are hatched.
    pub hatching: bool,
    /// Surfaces inside of the volumes.
    pub inside: Inside,
    /// Where the light stands.
    pub light: SceneLight,
}

impl Default for Look {
    /// The hatched drawing with the subject's own colours, lit from the upper left.
    fn default() -> Self {
        let light = SceneLight { azimuth_deg: 315.0, elevation_deg: 45.0 };
        Self { show: Show::Final, hatching: true, inside: Inside::OwnColours, light }
    }
}

impl Look {
    /// The look that a script's settings and regions give.
    pub(super) fn of(script: &Script, settings: &Settings) -> Self {
        let styles = script.region_styles(settings);
        let (light, hatching) = (&settings.light, &settings.hatching);
        Self {
            show: Show::Final,
            hatching: hatching.inside > 0.0 || hatching.outside > 0.0,
            inside: styles.first().map_or(Inside::OwnColours, |style| Inside::of(style.inside)),
            light: SceneLight {
                azimuth_deg: light.azimuth_deg.into(),
                elevation_deg: light.elevation_deg.into(),
            },
        }
    }

    /// This look with the digits of a file, so that the recording shows the same bytes.
    pub(super) fn rounded(self) -> Self {
        let SceneLight { azimuth_deg, elevation_deg } = self.light;
        let light = SceneLight {
            azimuth_deg: digits::rounded(azimuth_deg) + 0.0,
            elevation_deg: digits::rounded(elevation_deg) + 0.0,
        };
        Self { light, ..self }
    }

    /// Settings as this look changes them. Strokes that are shown have their strength of
    /// `settings`, or all of it.
    pub(super) fn applied_to(&self, settings: &Settings) -> Settings {
        let mut settings = settings.clone();
        settings.light.azimuth_deg = self.light.azimuth_deg as f32;
        settings.light.elevation_deg = self.light.elevation_deg as f32;
        let hatching = &mut settings.hatching;
        let hatched = hatching.inside > 0.0 || hatching.outside > 0.0;
        let strength = f32::from(u8::from(self.hatching));
        if hatched != self.hatching {
            (hatching.inside, hatching.outside) = (strength, strength);
        }
        settings.drawing.inside = self.inside.as_setting();
        settings
    }

    /// Writes this look into the settings of a script, whose own are `settings`.
    pub(super) fn write_to(&self, script: &mut Script, settings: &Settings) {
        let now = self.applied_to(settings);
        let mut set = |group: &str, key: &str, value: Value| {
            let table = script.settings.entry(group).or_insert_with(|| Value::Table(Table::new()));
            if let Value::Table(table) = table {
                table.insert(key.to_owned(), value);
            }
        };
        for (group, key, value) in [
            ("light", "azimuth_deg", now.light.azimuth_deg),
            ("light", "elevation_deg", now.light.elevation_deg),
            ("hatching", "inside", now.hatching.inside),
            ("hatching", "outside", now.hatching.outside),
        ] {
            // The digits of an f32, not those of the nearest f64.
            let digits = value.to_string().parse().unwrap_or_else(|_| f64::from(value));
            set(group, key, Value::Float(digits));
        }
        set("drawing", "inside", Value::String(self.inside.word().to_owned()));
        for region in &mut script.regions {
            region.inside = Some(self.inside.as_setting());
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_script_keeps_the_look_that_was_written_to_it() {
        let mut script = Script::new("shape:village", 1.0);
        let settings = script.settings().unwrap();
        let usual = Look::of(&script, &settings);
        assert!(usual.hatching && usual.inside == Inside::OwnColours, "{usual:?}");
        let light = SceneLight { azimuth_deg: 30.5, elevation_deg: 12.0 };
        let other = Look { hatching: false, inside: Inside::Both, light, ..usual };
        for look in [other, usual] {
            look.write_to(&mut script, &settings);
            let read = Script::from_text("text", &script.to_text().unwrap()).unwrap();
            let found = read.settings().unwrap();
            assert_eq!(Look::of(&read, &found), look);
            assert_eq!(found, look.applied_to(&settings), "the pictures are the same");
        }
    }
}
