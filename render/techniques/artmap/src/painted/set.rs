//! A set of swatches in one style: the tones of a hue, from dark to light.

use std::sync::Arc;

use documents::hint::{Explain, Fault, Hint};
use paint::ground::GroundError;
use paint::light::{Light, PaintLightError};
use paint::painting::PaintingError;
use pigment::{PigmentLibrary, Viewing};
use rayon::prelude::*;

use super::brushwork::strokes;
use super::plan::Style;
use super::style_error::StyleError;
use super::swatch::{Workplace, ground, spread};
use super::tones::{ToneLadder, TonesError};
use crate::sample::{PaintOfSamples, SampleSet};

/// Colours of a set of swatches.
#[derive(Debug, Clone, PartialEq)]
pub struct PaintedSettings {
    /// Library of the paints.
    pub library: Arc<PigmentLibrary>,
    /// Hue as `#rrggbb` or `L,a,b`.
    pub hue: String,
    /// Number of tones, 2 to 12.
    pub tones: usize,
    /// Seed of the strokes; `None` for that of the style.
    pub seed: Option<u64>,
}

impl Default for PaintedSettings {
    /// Seven tones of yellow ochre in the oils that ship.
    fn default() -> Self {
        Self {
            library: Arc::new(PigmentLibrary::van_gogh_oils()),
            hue: "#c9a227".to_owned(),
            tones: 7,
            seed: None,
        }
    }
}

/// Paints the swatches of a style with the paint engine on the processor.
///
/// Equal input gives equal bytes on any number of threads. The samples are upright, of the
/// style's spacing, from dark to light, named `tone 1` and up.
///
/// # Errors
/// [`PaintedError`] for a style with numbers out of range, a hue that cannot be mixed, and a brush
/// that does not suit the cells.
pub fn painted_samples(
    style: &Style,
    settings: &PaintedSettings,
) -> Result<SampleSet, PaintedError> {
    style.check()?;
    let library = Arc::clone(&settings.library);
    let ladder = ToneLadder::new(library, &settings.hue, settings.tones, spread(style))?;
    let seed = settings.seed.unwrap_or(style.seed);
    let workplace = Workplace {
        style,
        ladder: &ladder,
        ground: ground(style, &ladder)?,
        light: Arc::new(Light::new(&settings.library, &Viewing::default())?),
    };
    let nested = strokes(style, seed);
    let samples = (0..settings.tones).into_par_iter().map(|at| {
        if style.strokes.nested {
            return workplace.swatch(at, &nested);
        }
        workplace.swatch(at, &strokes(style, seed.wrapping_add(at as u64)))
    });
    let samples = samples.collect::<Result<Vec<_>, PaintingError>>()?;
    let Style { name, .. } = style;
    let provenance = format!(
        "painted by impasto: style {name}, hue {}, {} tones, seed {seed}",
        settings.hue, settings.tones
    );
    let paint = PaintOfSamples { library: Arc::clone(&settings.library), slots: *ladder.slots() };
    Ok(SampleSet { samples, paint: Some(paint), provenance })
}

/// Swatches cannot be painted.
#[derive(Debug, thiserror::Error)]
pub enum PaintedError {
    /// A number of the style is out of range.
    #[error(transparent)]
    Style(#[from] StyleError),
    /// The tones cannot be mixed.
    #[error(transparent)]
    Tones(#[from] TonesError),
    /// The ground cannot be made.
    #[error(transparent)]
    Ground(#[from] GroundError),
    /// The library has no wavelengths in common with daylight.
    #[error(transparent)]
    Light(#[from] PaintLightError),
    /// The engine refuses a brush or a stroke.
    #[error(transparent)]
    Painting(#[from] PaintingError),
}

impl PaintedError {
    fn cause(&self) -> &dyn Explain {
        match self {
            Self::Style(error) => error,
            Self::Tones(error) => error,
            Self::Ground(error) => error,
            Self::Light(error) => error,
            Self::Painting(error) => error,
        }
    }
}

impl Explain for PaintedError {
    fn hint(&self) -> Option<Hint> {
        self.cause().hint()
    }

    fn fault(&self) -> Fault {
        self.cause().fault()
    }
}

#[cfg(test)]
mod tests;
