//! Choices of the quick palette.

use paint::layer::SLOTS;
use paint::strokes::Recipe;
use session::PaintingState;
use session::swatches::{KeptMixture, SwatchBook, Usable};

use crate::language::tr_format;
use crate::panels::Tools;

/// Most mixtures in their ring: more would be too narrow for a finger.
const MIXTURES: usize = 14;

/// Sizes of a brush, in mm.
const SIZES_MM: [f64; 10] = [1.0, 2.0, 3.0, 4.0, 6.0, 8.0, 12.0, 18.0, 28.0, 40.0];

/// One choice of the quick palette.
#[derive(Debug, Clone, PartialEq)]
pub(in crate::app) enum QuickChoice {
    /// Loads the brush from the tube of a slot.
    Tube {
        /// Slot of the palette.
        slot: usize,
        /// Name of its pigment.
        name: String,
        /// Colour of the tube.
        color: [u8; 3],
        /// Colour of its tint with white.
        tint: Option<[u8; 3]>,
    },
    /// Loads the brush with a mixture.
    Mixture {
        /// Name, or what it consists of.
        name: String,
        /// Parts by pigment.
        recipe: Recipe,
        /// Share of medium.
        vehicle: f64,
        /// Colour of the mixture.
        color: [u8; 3],
    },
    /// Makes the brush as wide as this, in mm.
    Size(f64),
}

impl QuickChoice {
    /// Name for accessibility and for the label below the menu.
    pub(in crate::app) fn name(&self) -> String {
        match self {
            Self::Tube { name, .. } => tr_format!("quick {name}", name),
            Self::Mixture { name, .. } => tr_format!("quick mixture {name}", name),
            Self::Size(mm) => tr_format!("quick size {mm} mm", mm),
        }
    }

    /// Words for the painter.
    pub(in crate::app) fn label(&self) -> String {
        match self {
            Self::Tube { name, .. } | Self::Mixture { name, .. } => name.clone(),
            Self::Size(mm) => format!("{mm} mm"),
        }
    }
}

/// Choices from the inner to the outer ring: tubes, mixtures that can be loaded now, sizes.
/// Mixtures are the ones loaded last, then those of the list.
pub(in crate::app) fn quick_choices(
    painting: &PaintingState,
    tools: &Tools,
    book: &SwatchBook,
) -> [Vec<QuickChoice>; 3] {
    let tubes = (0..SLOTS).filter_map(|slot| {
        let name = painting.library[painting.slots[slot]?].name.clone();
        let color = painting.masstones[slot].unwrap_or([128; 3]);
        Some(QuickChoice::Tube { slot, name, color, tint: painting.tints[slot] })
    });
    let sizes = SIZES_MM.map(QuickChoice::Size).to_vec();
    [tubes.collect(), mixtures(painting, tools, book), sizes]
}

fn mixtures(painting: &PaintingState, tools: &Tools, book: &SwatchBook) -> Vec<QuickChoice> {
    let PaintingState { library, slots, lighting, light, .. } = painting;
    let Ok(weights) = light.viewing.weights(library.grid) else { return Vec::new() };
    let recent = tools.recent.iter().filter_map(|(recipe, vehicle): &(Recipe, f64)| {
        let light = (&weights, lighting.illuminant.as_str());
        KeptMixture::of(library, recipe.clone(), *vehicle, light)
    });
    let mut found: Vec<QuickChoice> = Vec::new();
    for kept in recent.chain(book.swatches.iter().cloned()) {
        let again = found.iter().any(
            |known| matches!(known, QuickChoice::Mixture { recipe, .. } if *recipe == kept.recipe),
        );
        if found.len() < MIXTURES && !again && kept.usable(library, slots) == Usable::Now {
            let color = kept.screen_color(library, &weights);
            let KeptMixture { name, recipe, vehicle, .. } = kept;
            found.push(QuickChoice::Mixture { name, recipe, vehicle, color });
        }
    }
    found
}
