//! The look of a scene: which picture you see, and how it is drawn.

use pigment::digits;
use toml::{Table, Value};
use volumes::painter::Show;
use volumes::script::{RegionStyle, Script};
use volumes::settings::{self, Settings};

/// Picture on the surfaces inside the volumes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Inside {
    /// Their own colours.
    #[default]
    OwnColours,
    /// A film of the paint over the grey drawing.
    Glaze,
    /// A film of the paint over their own colours.
    Both,
    /// The choice of each region of the script, if they differ.
    ByRegion,
}

impl Inside {
    /// The choices of a scene, in the order of the panel. The last one is there only if the regions
    /// of its script differ (`by_region`).
    #[must_use]
    pub fn choices(by_region: bool) -> &'static [Self] {
        const ALL: [Inside; 4] =
            [Inside::OwnColours, Inside::Glaze, Inside::Both, Inside::ByRegion];
        if by_region { &ALL } else { &ALL[..3] }
    }

    /// This choice as a setting. `None` leaves the choice to each region.
    pub(super) fn as_setting(self) -> Option<settings::Inside> {
        match self {
            Self::OwnColours => Some(settings::Inside::OwnColors),
            Self::Glaze => Some(settings::Inside::Glaze),
            Self::Both => Some(settings::Inside::Both),
            Self::ByRegion => None,
        }
    }

    fn of(setting: settings::Inside) -> Self {
        match setting {
            settings::Inside::OwnColors => Self::OwnColours,
            settings::Inside::Glaze => Self::Glaze,
            settings::Inside::Both => Self::Both,
        }
    }

    /// The choice that all regions share, or [`Self::ByRegion`] if they differ.
    fn of_regions(styles: &[RegionStyle]) -> Self {
        let Some((first, others)) = styles.split_first() else { return Self::OwnColours };
        match others.iter().all(|other| other.inside == first.inside) {
            true => Self::of(first.inside),
            false => Self::ByRegion,
        }
    }

    /// The next of the [`choices`](Self::choices). After the last comes the first.
    #[must_use]
    pub fn next(self, by_region: bool) -> Self {
        let choices = Self::choices(by_region);
        let at = choices.iter().position(|&own| own == self);
        at.map_or(Self::OwnColours, |at| choices[(at + 1) % choices.len()])
    }
}

/// The word for this setting in a script.
fn word(inside: settings::Inside) -> &'static str {
    match inside {
        settings::Inside::OwnColors => "own-colours",
        settings::Inside::Glaze => "glaze",
        settings::Inside::Both => "both",
    }
}

/// Direction of the light of a scene.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SceneLight {
    /// Direction in degrees clockwise from the top of the picture.
    pub azimuth_deg: f64,
    /// Elevation towards the viewer in degrees, -90 to 90.
    pub elevation_deg: f64,
}

/// The look of a scene: which picture you see, and how it is drawn.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Look {
    /// The picture that is shown.
    pub show: Show,
    /// Whether surfaces are hatched.
    pub hatching: bool,
    /// Picture on surfaces inside the volumes.
    pub inside: Inside,
    /// Direction of the light.
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
        let light = &settings.light;
        let hatching = &settings.hatching;
        Self {
            show: Show::Final,
            hatching: hatching.inside > 0.0 || hatching.outside > 0.0,
            inside: Inside::of_regions(&styles),
            light: SceneLight {
                azimuth_deg: light.azimuth_deg.into(),
                elevation_deg: light.elevation_deg.into(),
            },
        }
    }

    /// This look rounded to the digits of a file, so that the recording shows the same bytes.
    pub(super) fn rounded(self) -> Self {
        let SceneLight { azimuth_deg, elevation_deg } = self.light;
        let light = SceneLight {
            azimuth_deg: digits::rounded(azimuth_deg) + 0.0,
            elevation_deg: digits::rounded(elevation_deg) + 0.0,
        };
        Self { light, ..self }
    }

    /// The settings as this look changes them. If strokes are shown, they have the strength of
    /// `settings`, or full strength if that is 0.
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
        if let Some(inside) = self.inside.as_setting() {
            settings.drawing.inside = inside;
        }
        settings
    }

    /// Writes this look into the settings and regions of a script. `settings` and `insides` are
    /// what they were when the script was opened.
    pub(super) fn write_to(
        &self,
        script: &mut Script,
        settings: &Settings,
        insides: &[Option<settings::Inside>],
    ) {
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
            // We want the digits of the f32, and not the digits of the nearest f64.
            let digits = value.to_string().parse().unwrap_or_else(|_| f64::from(value));
            set(group, key, Value::Float(digits));
        }
        set("drawing", "inside", Value::String(word(now.drawing.inside).to_owned()));
        for (region, own) in script.regions.iter_mut().zip(insides) {
            region.inside = self.inside.as_setting().or(*own);
        }
    }
}

#[cfg(test)]
mod tests {
    use volumes::script::RegionTable;

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
            look.write_to(&mut script, &settings, &[]);
            let read = Script::from_text("text", &script.to_text().unwrap()).unwrap();
            let found = read.settings().unwrap();
            assert_eq!(Look::of(&read, &found), look);
            assert_eq!(found, look.applied_to(&settings), "the pictures are the same");
        }
    }
    #[test]
    fn regions_that_differ_keep_what_they_show_until_one_choice_is_made_for_all() {
        let mut script = Script::new("shape:village", 1.0);
        let regions = [("a", Some(settings::Inside::Glaze)), ("b", None)];
        let regions = regions.map(|(name, inside)| RegionTable {
            name: name.to_owned(),
            inside,
            ..RegionTable::default()
        });
        script.regions = regions.into();
        let settings = script.settings().unwrap();
        let insides: Vec<_> = script.regions.iter().map(|region| region.inside).collect();
        let opened = Look::of(&script, &settings);
        assert_eq!(opened.inside, Inside::ByRegion);
        fn styles(script: &Script) -> Vec<settings::Inside> {
            let styles = script.region_styles(&script.settings().unwrap());
            styles.into_iter().map(|style| style.inside).collect()
        }
        let own = styles(&script);
        assert_eq!(own, [settings::Inside::Glaze, settings::Inside::OwnColors]);
        let darker = Look { hatching: false, ..opened };
        darker.write_to(&mut script, &settings, &insides);
        assert_eq!(
            (styles(&script), Look::of(&script, &settings).inside),
            (own.clone(), opened.inside)
        );
        Look { inside: Inside::Both, ..darker }.write_to(&mut script, &settings, &insides);
        assert_eq!(styles(&script), [settings::Inside::Both; 2]);
        opened.write_to(&mut script, &settings, &insides);
        assert_eq!(script.regions.iter().map(|own| own.inside).collect::<Vec<_>>(), insides);
        assert_eq!(styles(&script), own, "chosen again");
    }

    #[test]
    fn the_choices_go_round() {
        for (by_region, count) in [(false, 3), (true, 4)] {
            let mut seen = vec![Inside::OwnColours];
            while let Some(next) = seen.last().map(|last| last.next(by_region)) {
                if next == seen[0] {
                    break;
                }
                seen.push(next);
            }
            assert_eq!(seen.len(), count, "{seen:?}");
        }
        assert_eq!(Inside::ByRegion.next(false), Inside::OwnColours);
    }
}
