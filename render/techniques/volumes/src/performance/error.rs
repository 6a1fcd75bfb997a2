//! Errors of playing a script. This also turns the settings of a file into the settings of a
//! world.

use documents::hint::Explain;

use crate::motion::MotionSettings;
use crate::settings::Settings;
use crate::toml_text::{Fault, KeyPath, Source};
use crate::world::{WorldError, WorldSettings};

/// A script cannot be played.
#[derive(Debug, thiserror::Error, Explain)]
pub enum PerformanceError {
    /// The world cannot be made or go on.
    #[error(transparent)]
    World(#[from] WorldError),
    /// A setting does not fit the scene.
    #[error("{place}{fault}")]
    #[hint(with = fault.hint())]
    #[fault(Setting)]
    Setting {
        /// File and line, followed by a colon, where these are known.
        place: String,
        /// The setting.
        fault: Box<Fault>,
    },
    /// An event cannot be done.
    #[error("{place}: {error}")]
    #[hint(inner = error)]
    Event {
        /// The table of the event, with file and line where these are known.
        place: String,
        /// Path of the table in the script.
        table: KeyPath,
        /// Reason.
        error: WorldError,
    },
    /// The first picture shows nothing where paint is poured or lifted.
    #[error("{place}: the first picture shows no surface at {x:.3}, {y:.3}")]
    #[hint("choose a place on the subject, 0 to 1 across and down")]
    Bare {
        /// The table of the event, with file and line where these are known.
        place: String,
        /// Path of the table in the script.
        table: KeyPath,
        /// Share of the picture's width, from the left.
        x: f64,
        /// Share of its height, from the top.
        y: f64,
    },
    /// The volume that an event should split is not there.
    #[error("{place}: single volume {number} is not there")]
    #[hint("split a volume after it begins, and only once")]
    NoVolume {
        /// The table of the event, with file and line where these are known.
        place: String,
        /// Path of the table in the script.
        table: KeyPath,
        /// Number of the volume in the script, from 1.
        number: usize,
    },
}

impl PerformanceError {
    /// Adds the file from which you read the script, and the line of the event's table in its
    /// `text`.
    #[must_use]
    pub fn located(mut self, file: &str, text: &str) -> Self {
        let Ok(source) = Source::toml(file, text) else { return self };
        if let Self::Setting { place, fault } = &mut self {
            *place = format!("{file}, line {}: ", source.line(&fault.key));
        }
        match self.table().map(|table| (source.line(table), table.to_string())) {
            Some((line, table)) => self.placed(format!("{file}, line {line}: {table}")),
            None => self,
        }
    }

    /// Path of the event's table in the script. `None` if no event is at fault.
    #[must_use]
    pub fn table(&self) -> Option<&KeyPath> {
        match self {
            Self::World(_) | Self::Setting { .. } => None,
            Self::Event { table, .. } | Self::Bare { table, .. } | Self::NoVolume { table, .. } => {
                Some(table)
            }
        }
    }

    /// Replaces the words for the place of the event.
    #[must_use]
    pub fn placed(mut self, words: String) -> Self {
        match &mut self {
            Self::World(_) | Self::Setting { .. } => {}
            Self::Event { place, .. } | Self::Bare { place, .. } | Self::NoVolume { place, .. } => {
                *place = words;
            }
        }
        self
    }
}

impl From<&Settings> for WorldSettings {
    fn from(settings: &Settings) -> Self {
        let Settings { motion, grid, .. } = settings;
        Self {
            unit_mm: (settings.unit_mm > 0.0).then(|| f64::from(settings.unit_mm)),
            cell: grid.cell,
            samples: grid.samples as usize,
            film_mm: f64::from(grid.film_mm),
            rate: grid.rate,
            slope: grid.slope,
            seed: u64::from(settings.seed),
            motion: MotionSettings {
                pressure: motion.pressure,
                elastic: motion.elastic,
                cohesion: motion.cohesion,
                friction: motion.friction,
                kick: motion.kick,
                microstructure: motion.microstructure,
                grain: motion.grain,
                fastest: motion.fastest,
                surface_pull: motion.surface_pull,
                gravity: motion.gravity,
                keep: motion.keep,
            },
        }
    }
}
