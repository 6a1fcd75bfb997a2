//! What can go wrong while a script is played.

use spectra::hint::{Explain, Fault, Hint};

use crate::toml_text::{KeyPath, Source};
use crate::world::WorldError;

/// A script cannot be played.
#[derive(Debug, thiserror::Error)]
pub enum PerformanceError {
    /// The world cannot be made or go on.
    #[error(transparent)]
    World(#[from] WorldError),
    /// An event cannot be done.
    #[error("{place}: {error}")]
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
    /// A volume is to be split that is not there.
    #[error("{place}: single volume {number} is not there")]
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
    /// The same error with the file that the script was read from and the line of the event's
    /// table in its `text`.
    #[must_use]
    pub fn located(mut self, file: &str, text: &str) -> Self {
        let (place, table) = match &mut self {
            Self::World(_) => return self,
            Self::Event { place, table, .. }
            | Self::Bare { place, table, .. }
            | Self::NoVolume { place, table, .. } => (place, table),
        };
        if let Ok(source) = Source::parse(file, text) {
            *place = format!("{file}, line {}: {table}", source.line(table));
        }
        self
    }
}

impl Explain for PerformanceError {
    fn hint(&self) -> Option<Hint> {
        match self {
            Self::World(error) | Self::Event { error, .. } => error.hint(),
            Self::Bare { .. } => {
                Some(Hint::new("choose a place on the subject, 0 to 1 across and down"))
            }
            Self::NoVolume { .. } => {
                Some(Hint::new("split a volume after it is born, and only once"))
            }
        }
    }

    fn fault(&self) -> Fault {
        match self {
            Self::World(error) | Self::Event { error, .. } => error.fault(),
            Self::Bare { .. } | Self::NoVolume { .. } => Fault::Input,
        }
    }
}
