//! The paints of a plan, and what can be wrong with one.

use crate::measurement::names_a_pigment;

/// The paints to be measured.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Palette {
    /// Every paint: the white, the colours as given, the black.
    pub names: Vec<String>,
    /// The black's place, if there is one.
    pub black: Option<usize>,
}

impl Palette {
    /// The white's place; its S is the unit.
    pub const WHITE: usize = 0;

    /// White and black may be named among the colours too.
    ///
    /// # Errors
    /// [`PlanError::Name`] for a name that a column of a measurement file
    /// cannot have, [`PlanError::Twice`] for one given twice,
    /// [`PlanError::NoColor`] for a white alone.
    pub fn new(colors: &[String], white: &str, black: Option<&str>) -> Result<Self, PlanError> {
        let special = |name: &&String| *name == white || Some(name.as_str()) == black;
        let mut names = vec![white.to_owned()];
        names.extend(colors.iter().filter(|name| !special(name)).cloned());
        names.extend(black.map(str::to_owned));
        for (index, name) in names.iter().enumerate() {
            if !names_a_pigment(name) {
                return Err(PlanError::Name { name: name.clone() });
            }
            if names[..index].contains(name) {
                return Err(PlanError::Twice { name: name.clone() });
            }
        }
        if names.len() < 2 {
            return Err(PlanError::NoColor);
        }
        let black = black.map(|_| names.len() - 1);
        Ok(Self { names, black })
    }

    /// The places of all but white and black.
    pub fn colors(&self) -> impl Iterator<Item = usize> + Clone {
        1..self.black.unwrap_or(self.names.len())
    }

    /// Unknowns a wavelength, and so the least number of swatches: K of every
    /// paint, S of all but the white.
    #[must_use]
    pub fn unknowns(&self) -> usize {
        2 * self.names.len() - 1
    }
}

/// Why there is no plan.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum PlanError {
    /// A name that no pigment's column can have.
    #[error("a measurement file would not read this as a pigment's name: `{name}`")]
    Name {
        /// The name.
        name: String,
    },
    /// One name for two paints.
    #[error("each paint is named once, found twice `{name}`")]
    Twice {
        /// The name.
        name: String,
    },
    /// Nothing beside the white.
    #[error("a plan needs a pigment beside the white")]
    NoColor,
    /// A number of swatches that no plan has.
    #[error("{paints} paints are planned with {least} to {most} swatches, found `{swatches}`")]
    Swatches {
        /// How many paints.
        paints: usize,
        /// One a wavelength's unknown.
        least: usize,
        /// Every recipe that can be weighed.
        most: usize,
        /// What was asked.
        swatches: usize,
    },
    /// So little paint, or so coarse a balance, that no tint can be weighed.
    #[error(
        "a tint of 1 to 4 needs {needed} g a swatch on a balance that shows {resolution} g, found `{grams}`"
    )]
    Grams {
        /// The least that would do.
        needed: f64,
        /// The balance's step.
        resolution: f64,
        /// What was asked.
        grams: f64,
    },
    /// A number that must lie above 0.
    #[error("{what} must be above 0 and finite, found `{value}`")]
    NotPositive {
        /// Which.
        what: &'static str,
        /// What was found.
        value: f64,
    },
}

impl PlanError {
    /// What to try.
    #[must_use]
    pub fn hint(&self) -> String {
        match self {
            Self::Name { .. } => {
                "use a word that is none of the file's own columns (sample, film, backing, thickness_mm, replicate) and no number".into()
            }
            Self::Twice { .. } => "remove one, or give the second paint another name".into(),
            Self::NoColor => "name the pigments: impasto plan \"Cobalt Blue\" --white \"Titanium White\"".into(),
            Self::Swatches { least, most, swatches, .. } => {
                if swatches < least {
                    format!("try --swatches {least} or more; K of every paint and S of all but the white are unknown")
                } else {
                    format!("try --swatches {most} or fewer; more of one swatch are --replicates")
                }
            }
            Self::Grams { needed, .. } => format!("try --grams {needed}, or a finer --balance"),
            Self::NotPositive { .. } => "give grams, such as --grams 10 --balance 0.01".into(),
        }
    }
}
