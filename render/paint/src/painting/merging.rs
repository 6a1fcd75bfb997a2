//! Two dry layers as one, where nobody can see it.

use spectra::color::{Lab, RgbSpace, delta_e_ciede2000};

use super::failure::PaintingError;
use super::layers::LayerRef;
use super::state::{DryLayerState, Painting};
use crate::layer::{Layer, SLOTS};
use graphics::field::Field;

/// The largest difference that a merge may make, in CIEDE2000.
pub const MERGE_TOLERANCE: f64 = 0.1;

impl Painting {
    /// Makes one layer of the dry layer `index` and the one above it. Their
    /// paints mix, so that layers of unlike paint would change colour; those are
    /// refused and stay as they were.
    ///
    /// # Errors
    /// [`PaintingError`] where a colour would move by more than
    /// [`MERGE_TOLERANCE`], where the two need more than eight pigments, and
    /// for layers that are not there.
    pub fn merge(&mut self, index: usize) -> Result<(), PaintingError> {
        let upper = self.slots(LayerRef::Dry(index + 1))?;
        let lower = self.slots(LayerRef::Dry(index))?;
        if self.state.dry[index].opacity != self.state.dry[index + 1].opacity {
            return Err(PaintingError::UnlikeOpacity);
        }
        let (slots, place) = united(lower, upper)?;
        let mut paint = self.engine.dry_layer(index)?;
        add(&mut paint, &self.engine.dry_layer(index + 1)?, &place);
        let above = (index + 2..self.engine.dry_layer_count()).map(|i| self.engine.dry_layer(i));
        let above: Vec<Layer> = above.collect::<Result<_, _>>()?;
        let merged: Vec<Layer> = std::iter::once(paint).chain(above).collect();
        let state = DryLayerState { slots, opacity: self.state.dry[index].opacity };

        // Tried first, so that what shows leaves no trace, not even in undo.
        let before = self.picture()?;
        let dry = self.state.dry.clone();
        let apart = self.replace_dry(index, &merged)?;
        self.state.dry.splice(index..index + 2, [state.clone()]);
        self.views.unseen();
        let (delta_e, x, y) = farthest(&before, &self.picture()?);
        self.replace_dry(index, &apart)?;
        self.state.dry = dry;
        self.views.unseen();
        if delta_e > MERGE_TOLERANCE {
            return Err(PaintingError::MergeShows { delta_e, x, y });
        }

        self.acting(|painting| {
            while painting.engine.dry_layer_count() > index {
                painting.history.pop_dry_layer(&mut painting.engine)?;
            }
            for layer in &merged {
                painting.history.push_dry_layer(&mut painting.engine, layer)?;
            }
            painting.state.dry.splice(index..index + 2, [state]);
            painting.floor_changed()
        })
    }

    /// Puts `layers` in place of the dry layers from `index` up; gives those.
    fn replace_dry(&mut self, index: usize, layers: &[Layer]) -> Result<Vec<Layer>, PaintingError> {
        let mut taken = Vec::new();
        while self.engine.dry_layer_count() > index {
            taken.insert(0, self.engine.pop_dry_layer()?);
        }
        for layer in layers {
            self.engine.push_dry_layer(layer)?;
        }
        Ok(taken)
    }
}

/// The largest CIEDE2000 between two pictures, with its column and row.
fn farthest(a: &Field<[f32; 4]>, b: &Field<[f32; 4]>) -> (f64, usize, usize) {
    let matrix = RgbSpace::Srgb.xyz_from_linear();
    let lab = |rgb: &[f32; 4]| {
        let linear = [rgb[0], rgb[1], rgb[2]].map(f64::from);
        Lab::from_xyz(matrix.apply(linear).into(), RgbSpace::Srgb.white())
    };
    let mut largest = (0.0, 0, 0);
    let width = a.width();
    for (cell, (a, b)) in a.values().iter().zip(b.values()).enumerate() {
        let delta_e = if a == b { 0.0 } else { delta_e_ciede2000(lab(a), lab(b)) };
        if delta_e > largest.0 {
            largest = (delta_e, cell % width, cell / width);
        }
    }
    largest
}

/// The pigments of both layers, and the slot that each of the upper one's gets.
fn united(
    lower: [Option<usize>; SLOTS],
    upper: [Option<usize>; SLOTS],
) -> Result<([Option<usize>; SLOTS], [usize; SLOTS]), PaintingError> {
    let mut slots = lower;
    let mut place = [0; SLOTS];
    let mut lacking = 0;
    for (slot, pigment) in upper.iter().enumerate() {
        let Some(pigment) = *pigment else { continue };
        let found = slots.iter().position(|&other| other == Some(pigment));
        match found.or_else(|| slots.iter().position(Option::is_none)) {
            Some(free) => {
                slots[free] = Some(pigment);
                place[slot] = free;
            }
            None => lacking += 1,
        }
    }
    if lacking > 0 {
        return Err(PaintingError::TooManyPigments { found: SLOTS + lacking });
    }
    Ok((slots, place))
}

/// Adds `upper`, whose slots lie at `place`, to `lower`.
fn add(lower: &mut Layer, upper: &Layer, place: &[usize; SLOTS]) {
    for index in 0..lower.vehicle.values().len() {
        let mut cell = lower.cell(index);
        let more = upper.cell(index);
        for (slot, amount) in more.pigments.iter().enumerate() {
            cell.pigments[place[slot]] += amount;
        }
        cell.vehicle += more.vehicle;
        lower.set_cell(index, cell);
    }
}
