//! Faults that the figures of a map show.

use documents::hint::{Explain, Fault, Hint};

use super::figures::{BetweenFigures, KeyFigures, MapFigures};

/// Least coherence of a tile with the first one or with its neighbour on the way there.
/// Independent synthesis stays below 0.15.
const COHERENCE: f64 = 0.60;
/// Largest step across the borders over that within a tile, unless places within it vary more.
const WRAP: f64 = 1.05;
/// Least contrast of an in-between over that of its key tiles.
const CONTRAST: f64 = 0.93;
/// Largest distance of the tone of an in-between from the weighted mean, in L*.
const TONE: f64 = 0.5;
/// Least distance of neighbouring tones in L*: a step k of 5 of 255 levels, below which Yan and
/// others (2008, equation 7) have no tile in between.
const STEP: f64 = 5.0 / 2.55;
/// Least distance of the darkest from the lightest tone in L*, by our own choice: with less, light
/// and shade of a model can hardly be told apart.
const SPREAD: f64 = 20.0;

/// A fault of a map: where, the figure found, and the one wanted.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum MapFault {
    /// Strokes of a tile do not stand where those of the first tile stand.
    #[error("tile `{name}`: coherence with the first tile is {found:.2}, wanted at least {wanted}")]
    Coherence {
        /// Name of the tile.
        name: String,
        /// Correlation of the detail.
        found: f64,
        /// Least correlation.
        wanted: f64,
    },
    /// A seam shows where a tile repeats.
    #[error(
        "tile `{name}`: steps across its border are {found:.2} of those inside, wanted at most {wanted:.2}"
    )]
    Seam {
        /// Name of the tile.
        name: String,
        /// Ratio of steps.
        found: f64,
        /// Largest ratio.
        wanted: f64,
    },
    /// Two neighbouring tiles are in the wrong order, or too alike in tone.
    #[error(
        "tones of `{darker}` and `{lighter}` rise by {found:.1} L*, wanted at least {wanted:.1}"
    )]
    Step {
        /// Name of the tile that stands first.
        darker: String,
        /// Name of the next tile.
        lighter: String,
        /// Difference of their tones.
        found: f64,
        /// Least difference.
        wanted: f64,
    },
    /// The darkest and the lightest tile are too alike in tone.
    #[error("tones spread over {found:.1} L*, wanted at least {wanted}")]
    Spread {
        /// Difference of the outermost tones.
        found: f64,
        /// Least difference.
        wanted: f64,
    },
    /// An in-between has less contrast than its key tiles.
    #[error(
        "{:.0} % between `{darker}` and `{lighter}`: contrast is {found:.2} of theirs, wanted at \
         least {wanted}",
        100.0 * .share
    )]
    BetweenContrast {
        /// Name of the darker tile.
        darker: String,
        /// Name of the lighter tile.
        lighter: String,
        /// Share of the way to the lighter tile.
        share: f64,
        /// Contrast over theirs.
        found: f64,
        /// Least ratio.
        wanted: f64,
    },
    /// The tone of an in-between is not in proportion.
    #[error(
        "{:.0} % between `{darker}` and `{lighter}`: L* is {found:.1}, wanted {wanted:.1}",
        100.0 * .share
    )]
    BetweenTone {
        /// Name of the darker tile.
        darker: String,
        /// Name of the lighter tile.
        lighter: String,
        /// Share of the way to the lighter tile.
        share: f64,
        /// Mean L*.
        found: f64,
        /// Weighted mean of the tones of both tiles.
        wanted: f64,
    },
}

impl Explain for MapFault {
    fn hint(&self) -> Option<Hint> {
        Some(Hint::new(match self {
            Self::Coherence { .. } => {
                "raise [follow], or choose a sample with clearer strokes as [first]"
            }
            Self::Seam { .. } => "build the map with another [seed], or mark a larger passage",
            Self::Step { .. } => "leave one of the two samples out",
            Self::Spread { .. } => "add a darker or a lighter sample",
            Self::BetweenContrast { .. } | Self::BetweenTone { .. } => {
                "add a sample of a tone between them"
            }
        }))
    }

    fn fault(&self) -> Fault {
        Fault::Input
    }
}

impl MapFigures {
    /// Faults that the figures show, of tiles first, then of pairs of neighbours.
    #[must_use]
    pub fn faults(&self) -> Vec<MapFault> {
        let keys = self.keys.iter().flat_map(of_key);
        let pairs = self.keys.windows(2).filter_map(|pair| of_step(&pair[0], &pair[1]));
        let betweens = self.betweens.iter().flat_map(|figures| self.of_between(figures));
        keys.chain(self.of_spread()).chain(pairs).chain(betweens).collect()
    }

    fn of_spread(&self) -> Option<MapFault> {
        let [darkest, .., lightest] = self.keys.as_slice() else { return None };
        let found = lightest.tone - darkest.tone;
        (found < SPREAD).then_some(MapFault::Spread { found, wanted: SPREAD })
    }

    fn of_between(&self, figures: &BetweenFigures) -> Vec<MapFault> {
        let BetweenFigures { lower, share, contrast, tone, wanted_tone } = *figures;
        let [darker, lighter] = [lower, lower + 1].map(|index| self.keys[index].name.clone());
        let mut faults = Vec::new();
        if let Some(found) = contrast.filter(|found| *found < CONTRAST) {
            let darker = darker.clone();
            let lighter = lighter.clone();
            let wanted = CONTRAST;
            faults.push(MapFault::BetweenContrast { darker, lighter, share, found, wanted });
        }
        if (tone - wanted_tone).abs() > TONE {
            let found = tone;
            let wanted = wanted_tone;
            faults.push(MapFault::BetweenTone { darker, lighter, share, found, wanted });
        }
        faults
    }
}

fn of_key(key: &KeyFigures) -> Vec<MapFault> {
    let name = &key.name;
    let mut faults = Vec::new();
    if key.coherence.max(key.neighbour_coherence) < COHERENCE {
        let name = name.clone();
        let found = key.coherence;
        faults.push(MapFault::Coherence { name, found, wanted: COHERENCE });
    }
    let wanted = WRAP.max(key.usual_wrap_ratio);
    if key.wrap_ratio > wanted {
        let name = name.clone();
        let found = key.wrap_ratio;
        faults.push(MapFault::Seam { name, found, wanted });
    }
    faults
}

fn of_step(darker: &KeyFigures, lighter: &KeyFigures) -> Option<MapFault> {
    let found = lighter.tone - darker.tone;
    (found < STEP).then(|| MapFault::Step {
        darker: darker.name.clone(),
        lighter: lighter.name.clone(),
        found,
        wanted: STEP,
    })
}
