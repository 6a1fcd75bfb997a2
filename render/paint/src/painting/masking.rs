//! Masks of a painting: film over cells that no paint gets on or off.

use std::sync::Arc;

use serde::{Deserialize, Serialize};

use super::failure::PaintingError;
use super::layer_ref::LayerRef;
use super::state::Painting;
use crate::mask::Mask;

/// A change of the mask.
///
/// In a script it is one of `{"polygon_mm": [[x, y], ..]}`, `{"layer": 0}` (or `"wet"`),
/// `{"painted": {}}`, `{"inverse": true}` and `{"clear": {}}`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum MaskChange {
    /// Leaves the inside of a polygon open, by the even-odd rule, and covers the rest. Its points
    /// are in mm from the upper left corner.
    PolygonMm(Vec<[f64; 2]>),
    /// Leaves the cells open that have paint of a layer now.
    Layer(LayerRef),
    /// Leaves the cells open that have paint now, wet or dry.
    Painted {},
    /// Exchanges what is covered and what is open; always true.
    Inverse(bool),
    /// Takes the mask off.
    Clear {},
}

impl Painting {
    /// The mask, if one is set. It is not part of the document: a file does not hold it.
    #[must_use]
    pub fn mask(&self) -> Option<&Arc<Mask>> {
        self.mask.as_ref()
    }

    /// Changes the mask. Strokes, heaps and scraping change no paint of covered cells, and nothing
    /// flows over the border; light and drying go through the film. Returns whether there was
    /// anything to change: without a mask there is none to invert or to take off.
    ///
    /// # Errors
    /// [`PaintingError`] if there is no such layer, or if the device was lost.
    ///
    /// # Panics
    /// If a stroke is open.
    pub fn change_mask(&mut self, change: &MaskChange) -> Result<bool, PaintingError> {
        let bounds = self.bounds();
        let next = match (change, &self.mask) {
            (MaskChange::Inverse(_) | MaskChange::Clear {}, None) => return Ok(false),
            (MaskChange::Clear {}, Some(_)) => None,
            (MaskChange::Inverse(_), Some(mask)) => Some(mask.inverse()),
            (MaskChange::PolygonMm(points_mm), _) => {
                let cells = |mm: f64| mm / self.cell_mm;
                let points: Vec<_> = points_mm.iter().map(|&[x, y]| (cells(x), cells(y))).collect();
                Some(Mask::with_open_polygon(bounds, &points))
            }
            (&MaskChange::Layer(layer), _) => {
                let paint = match self.dry_index(layer)? {
                    None => self.wet()?,
                    Some(index) => self.dry_in(index, bounds)?,
                };
                Some(Mask::with_open(bounds, |cell| paint.cell(cell).volume() > 0))
            }
            (MaskChange::Painted {}, _) => {
                let mut layers = vec![self.wet()?];
                for index in 0..self.state.dry.len() {
                    layers.push(self.dry_in(index, bounds)?);
                }
                Some(Mask::with_open(bounds, |cell| {
                    layers.iter().any(|layer| layer.cell(cell).volume() > 0)
                }))
            }
        };
        self.apply_action(|painting| painting.hold_mask(next.map(Arc::new)))?;
        Ok(true)
    }

    /// Gives the engine this mask, if it has another.
    pub(crate) fn hold_mask(&mut self, mask: Option<Arc<Mask>>) -> Result<(), PaintingError> {
        if mask != self.mask {
            self.engine.set_mask(mask.as_deref())?;
            self.mask = mask;
        }
        Ok(())
    }
}
