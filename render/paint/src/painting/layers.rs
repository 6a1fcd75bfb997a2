//! Layers: drying, pigments and opacity.

use pigment::PigmentId;

use super::brushes::share_of_65536_parts;
use super::failure::PaintingError;
use super::layer_ref::LayerRef;
use super::state::{DryLayerState, HIGHEST, Painting};
use crate::brush::Relief;
use crate::document::Slots;

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
            let state = &mut painting.state;
            state.dry.push(DryLayerState::new(state.next_layer, state.slots));
            state.next_layer = state.next_layer.next();
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
        let dry = self.dry_index(layer)?;
        let slots = self.slots(layer)?;
        if slots.contains(&Some(to)) {
            return Err(PaintingError::AlreadyThere { pigment: self.pigment_name(to) });
        }
        let place = slots
            .iter()
            .position(|&slot| slot == Some(from))
            .ok_or_else(|| PaintingError::NotThere { pigment: self.pigment_name(from) })?;
        self.apply_action(|painting| {
            match dry {
                None => painting.state.slots[place] = Some(to),
                Some(index) => painting.state.dry[index].slots[place] = Some(to),
            }
            painting.views.mark_all();
            Ok(())
        })
    }

    /// Sets the factor of the optical thickness of a dry layer: 1 as painted, 0 clear. Its
    /// height stays.
    ///
    /// # Errors
    /// [`PaintingError`] for the wet layer, a layer that does not exist, or an opacity outside
    /// 0 to 1000.
    ///
    /// # Panics
    /// If a stroke is open.
    pub fn set_opacity(&mut self, layer: LayerRef, opacity: f64) -> Result<(), PaintingError> {
        let index = self.dry_index(layer)?.ok_or(PaintingError::WetOpacity)?;
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
    /// [`PaintingError::NoLayer`] or [`PaintingError::UnknownLayer`] if there is no such layer.
    pub fn slots(&self, layer: LayerRef) -> Result<Slots, PaintingError> {
        Ok(match self.dry_index(layer)? {
            None => self.state.slots,
            Some(index) => self.state.dry[index].slots,
        })
    }

    /// Index of a dry layer from the lowest, which is 0; `None` for the wet one.
    ///
    /// # Errors
    /// [`PaintingError::NoLayer`] or [`PaintingError::UnknownLayer`] if there is no such layer.
    pub fn dry_index(&self, layer: LayerRef) -> Result<Option<usize>, PaintingError> {
        let dry = &self.state.dry;
        match layer {
            LayerRef::Wet => Ok(None),
            LayerRef::Dry(index) if index < dry.len() => Ok(Some(index)),
            LayerRef::Dry(index) => Err(PaintingError::NoLayer { index, count: dry.len() }),
            LayerRef::Id(id) => match dry.iter().position(|layer| layer.id == id) {
                Some(index) => Ok(Some(index)),
                None => {
                    let known = dry.iter().map(|layer| layer.id.to_string()).collect();
                    Err(PaintingError::UnknownLayer { id, known })
                }
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
}
