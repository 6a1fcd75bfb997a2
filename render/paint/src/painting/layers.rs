//! Layers: drying, pigments and opacity, and merging.

use pigment::PigmentId;
use spectra::color::{Lab, RgbSpace, delta_e_ciede2000};

use super::brushes::share_of_65536_parts;
use super::failure::PaintingError;
use super::state::{DryLayerState, HIGHEST, Painting};
use crate::brush::Relief;
use crate::document::Slots;
use crate::layer::{Layer, SLOTS};
use graphics::field::Field;

/// Largest colour difference that a merge may make, in CIEDE2000.
pub const MERGE_TOLERANCE: f64 = 0.1;

/// One layer of a painting.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LayerRef {
    /// The wet layer.
    Wet,
    /// A dry layer by its index; 0 is the lowest.
    Dry(usize),
}

impl Painting {
    /// Dries the fraction `fraction` (0 to 1) of all wet paint, from the bottom, as a new
    /// topmost dry layer. Returns whether there was wet paint.
    ///
    /// # Errors
    /// [`PaintingError`] if `fraction` is outside 0 to 1, if paint is piled too high, or if
    /// memory does not suffice.
    ///
    /// # Panics
    /// If a stroke is open.
    pub fn dry(&mut self, fraction: f64) -> Result<bool, PaintingError> {
        let share = share_of_65536_parts("fraction", fraction)?;
        let painted = self.engine.wet_tiles()?;
        if share == 0 || painted.is_empty() {
            return Ok(false);
        }
        if let Some((x, y)) = self.too_high()? {
            return Err(PaintingError::TooHigh { x, y });
        }
        self.apply_action(|painting| {
            painting.history.dry(&mut painting.engine, share)?;
            painting.state.dry.push(DryLayerState { slots: painting.state.slots, opacity: 1.0 });
            painting.update_relief()?;
            painted.iter().for_each(|tile| painting.views.mark_dry_tile(tile));
            Ok(())
        })?;
        Ok(true)
    }

    /// Sets the pigments of the palette. Pigments that stay keep their slots.
    ///
    /// # Errors
    /// The errors of [`Painting::slots_with`]; nothing is changed then.
    ///
    /// # Panics
    /// If a stroke is open.
    pub fn set_palette(&mut self, pigments: &[PigmentId]) -> Result<(), PaintingError> {
        let slots = self.slots_with(pigments)?;
        self.apply_action(|painting| {
            // From now on brushes hold paint of the new palette.
            for brush in &painting.brushes {
                painting.history.save_brush(&mut painting.engine, brush.id)?;
            }
            painting.state.slots = slots;
            Ok(())
        })
    }

    /// Slots after [`Painting::set_palette`] with these pigments.
    ///
    /// # Errors
    /// [`PaintingError`] for more than eight pigments, or if a pigment that leaves is still
    /// wet on the canvas or on a brush.
    pub fn slots_with(&mut self, pigments: &[PigmentId]) -> Result<Slots, PaintingError> {
        let mut wanted: Vec<PigmentId> = Vec::new();
        for &pigment in pigments {
            if !wanted.contains(&pigment) {
                wanted.push(pigment);
            }
        }
        if wanted.len() > self.state.slots.len() {
            return Err(PaintingError::TooManyPigments { found: wanted.len() });
        }
        let mut slots: Slots = self.state.slots;
        let leaves =
            |slot: Option<PigmentId>| slot.is_some_and(|pigment| !wanted.contains(&pigment));
        if slots.iter().any(|&slot| leaves(slot)) {
            let wet = self.wet_totals_mm()?;
            for (slot, amount) in slots.iter_mut().zip(wet).filter(|(slot, _)| leaves(**slot)) {
                match *slot {
                    Some(pigment) if amount > 0.0 => {
                        let pigment = self.pigment_name(pigment);
                        return Err(PaintingError::StillWet { pigment });
                    }
                    _ => *slot = None,
                }
            }
        }
        wanted.retain(|&pigment| !slots.contains(&Some(pigment)));
        for pigment in wanted {
            let free = slots.iter().position(Option::is_none).expect("eight pigments have room");
            slots[free] = Some(pigment);
        }
        Ok(slots)
    }

    /// Replaces the pigment `from` of a layer by `to`, as if the layer had been painted with
    /// it.
    ///
    /// # Errors
    /// [`PaintingError`] if the layer does not have `from`, or has `to` already.
    ///
    /// # Panics
    /// If a stroke is open.
    pub fn swap_pigment(
        &mut self,
        layer: LayerRef,
        from: PigmentId,
        to: PigmentId,
    ) -> Result<(), PaintingError> {
        let slots = self.slots(layer)?;
        if slots.contains(&Some(to)) {
            return Err(PaintingError::AlreadyThere { pigment: self.pigment_name(to) });
        }
        let place = slots
            .iter()
            .position(|&slot| slot == Some(from))
            .ok_or_else(|| PaintingError::NotThere { pigment: self.pigment_name(from) })?;
        self.apply_action(|painting| {
            match layer {
                LayerRef::Wet => painting.state.slots[place] = Some(to),
                LayerRef::Dry(index) => painting.state.dry[index].slots[place] = Some(to),
            }
            painting.views.mark_all();
            Ok(())
        })
    }

    /// Sets the factor of the optical thickness of a dry layer: 1 as painted, 0 hides it. Its
    /// height stays.
    ///
    /// # Errors
    /// [`PaintingError`] for the wet layer, a layer that does not exist, or an opacity outside
    /// 0 to 1000.
    ///
    /// # Panics
    /// If a stroke is open.
    pub fn set_opacity(&mut self, layer: LayerRef, opacity: f64) -> Result<(), PaintingError> {
        let LayerRef::Dry(index) = layer else { return Err(PaintingError::WetOpacity) };
        self.slots(layer)?;
        if !(0.0..=1000.0).contains(&opacity) {
            return Err(PaintingError::Opacity { value: opacity });
        }
        self.apply_action(|painting| {
            painting.state.dry[index].opacity = opacity;
            painting.views.mark_all();
            Ok(())
        })
    }

    /// Pigment of each slot of a layer.
    ///
    /// # Errors
    /// [`PaintingError::NoLayer`] if there is no such layer.
    pub fn slots(&self, layer: LayerRef) -> Result<Slots, PaintingError> {
        match layer {
            LayerRef::Wet => Ok(self.state.slots),
            LayerRef::Dry(index) => match self.state.dry.get(index) {
                Some(state) => Ok(state.slots),
                None => Err(PaintingError::NoLayer { index, count: self.state.dry.len() }),
            },
        }
    }

    /// Slot of the palette that holds a pigment.
    ///
    /// # Errors
    /// [`PaintingError::OffPalette`] if no slot does.
    pub fn slot_of(&self, pigment: PigmentId) -> Result<usize, PaintingError> {
        let found = self.state.slots.iter().position(|&slot| slot == Some(pigment));
        found.ok_or_else(|| PaintingError::OffPalette { pigment: self.pigment_name(pigment) })
    }

    pub(super) fn pigment_name(&self, pigment: PigmentId) -> String {
        self.library[pigment].name.clone()
    }

    /// Updates the relief and all pictures after the height of ground and dry paint changed.
    pub(super) fn floor_changed(&mut self) -> Result<(), PaintingError> {
        self.update_relief()?;
        self.views.mark_all();
        Ok(())
    }

    /// First cell (column, row) where ground and dry paint are higher than allowed.
    fn too_high(&mut self) -> Result<Option<(usize, usize)>, PaintingError> {
        let floor = self.engine.floor()?;
        let highest = HIGHEST as i32;
        let found = floor.values().iter().position(|&height| height > highest);
        Ok(found.map(|index| (index % floor.width(), index / floor.width())))
    }

    fn update_relief(&mut self) -> Result<(), PaintingError> {
        self.dry_changes += 1;
        self.relief = Relief::from_floor(&self.engine.floor()?, self.cell_mm);
        Ok(())
    }

    /// Merges the dry layer `index` with the one above it. Their paints mix, so that layers of
    /// different paint would change colour; such a merge is refused.
    ///
    /// # Errors
    /// [`PaintingError`] if a colour would change by more than [`MERGE_TOLERANCE`], if the two
    /// need more than eight pigments or have different opacities, and if there are no such
    /// layers. Nothing is changed then.
    ///
    /// # Panics
    /// If a stroke is open.
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

        // A trial first, so that a refused merge leaves no trace in the history.
        let before = self.picture()?;
        let dry = self.state.dry.clone();
        let apart = self.replace_dry(index, &merged)?;
        self.state.dry.splice(index..index + 2, [state.clone()]);
        self.views.mark_all();
        let (delta_e, x, y) = farthest(&before, &self.picture()?);
        self.replace_dry(index, &apart)?;
        self.state.dry = dry;
        self.views.mark_all();
        if delta_e > MERGE_TOLERANCE {
            return Err(PaintingError::MergeShows { delta_e, x, y });
        }

        self.apply_action(|painting| {
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

    /// Replaces the dry layers from `index` up by `layers`; returns the former ones.
    fn replace_dry(&mut self, index: usize, layers: &[Layer]) -> Result<Vec<Layer>, PaintingError> {
        let mut former = Vec::new();
        while self.engine.dry_layer_count() > index {
            former.insert(0, self.engine.pop_dry_layer()?);
        }
        for layer in layers {
            self.engine.push_dry_layer(layer)?;
        }
        Ok(former)
    }
}

/// Largest colour difference between two pictures in CIEDE2000, with its column and row.
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

/// Slots of both layers merged, and the slot of each pigment of the upper layer in them.
fn united(lower: Slots, upper: Slots) -> Result<(Slots, [usize; SLOTS]), PaintingError> {
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

/// Adds `upper` to `lower`; slot `i` of `upper` is slot `place[i]` of `lower`.
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
