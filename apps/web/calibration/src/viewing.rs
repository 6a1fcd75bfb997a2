//! Light and observer by their names.

use calibrate::Viewing;
use serde::Deserialize;

use crate::failure::{Result, Told};

/// Names of a light and an observer, as you pass them to the program.
#[derive(Debug, Deserialize)]
pub(crate) struct ViewingNames {
    light: String,
    observer: String,
}

impl ViewingNames {
    pub(crate) fn viewing(&self) -> Result<Viewing> {
        Viewing::named(self.light.trim(), &self.observer).told()
    }
}
