//! Hatching as a film of black paint, thicker where there is more ink.

use paint::amount::quanta_from_mm;
use paint::layer::SLOTS;

use super::grisaille::Grisaille;
use super::tones::{linear, within_one};

/// Steps of ink that differ.
const STEPS: usize = 256;

/// Highest film of ink in mm.
const MOST_MM: f64 = 0.05;

/// Halvings of the range in which the height of a film is sought.
const HALVINGS: usize = 40;

/// Films of black paint for all amounts of ink.
#[derive(Debug, Clone, PartialEq)]
pub struct Pencil {
    heights_mm: Vec<f64>,
}

impl Pencil {
    /// Finds the films that darken the bare ground as a pencil of the encoded `grey` would: full ink
    /// to that grey, half of it half-way there. The black is that of `grisaille`. A film is at most
    /// 0.05 mm high, which almost hides.
    #[must_use]
    pub fn new(grisaille: &Grisaille, grey: f32) -> Self {
        let luminance = |mm: f64| {
            let mut heights = [0.0; SLOTS];
            heights[1] = mm as f32;
            let [r, g, b] = grisaille.film().rgb(&heights);
            // Weights of luminance of sRGB (IEC 61966-2-1).
            0.2126 * r + 0.7152 * g + 0.0722 * b
        };
        let bare = luminance(0.0);
        let height = |step: usize| {
            let left = 1.0 - step as f32 / (STEPS - 1) as f32 * (1.0 - grey);
            let wanted = bare * linear(left);
            let mut range = [0.0, MOST_MM];
            for _ in 0..HALVINGS {
                let middle = 0.5 * (range[0] + range[1]);
                range[usize::from(luminance(middle) < wanted)] = middle;
            }
            if step == 0 { 0.0 } else { range[1] }
        };
        Self { heights_mm: (0..STEPS).map(height).collect() }
    }

    /// Height in mm of the film for an amount of ink, 0..1.
    #[must_use]
    pub fn height_mm(&self, ink: f32) -> f64 {
        self.heights_mm[step(ink)]
    }

    /// Films of all steps in quanta, for cells `cell_mm` wide.
    pub(super) fn quanta(&self, cell_mm: f64) -> Vec<u32> {
        self.heights_mm.iter().map(|&mm| quanta_from_mm(mm, cell_mm)).collect()
    }
}

/// Index of the step nearest to an amount of ink; what is no number counts as 0.
#[inline]
pub(super) fn step(ink: f32) -> usize {
    (within_one(ink) * (STEPS - 1) as f32 + 0.5) as usize
}
