//! Drying, and what can be changed of layers later.

use super::brushes::share_of_65536_parts;
use super::failure::PaintingError;
use super::state::{DryLayerState, HIGHEST, Painting};
use crate::brush::Relief;
use crate::document::Slots;

/// One layer of a painting.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LayerRef {
    /// The wet layer.
    Wet,
    /// A dry layer, counted from the lowest.
    Dry(usize),
}

impl Painting {
    /// Dries the share `fraction` (0..1) of all wet paint, from the bottom; it
    /// becomes the topmost dry layer. Whether there was any.
    ///
    /// # Errors
    /// [`PaintingError`] for a share outside 0..1, or without memory.
    pub fn dry(&mut self, fraction: f64) -> Result<bool, PaintingError> {
        let share = share_of_65536_parts("fraction", fraction)?;
        let painted = self.engine.wet_tiles()?;
        if share == 0 || painted.is_empty() {
            return Ok(false);
        }
        if let Some((x, y)) = self.too_high()? {
            return Err(PaintingError::TooHigh { x, y });
        }
        self.acting(|painting| {
            painting.history.dry(&mut painting.engine, share)?;
            painting.state.dry.push(DryLayerState { slots: painting.state.slots, opacity: 1.0 });
            painting.feel_floor()?;
            painted.iter().for_each(|tile| painting.views.touch_dry(tile));
            Ok(())
        })?;
        Ok(true)
    }

    /// Puts other pigments on the palette. Those that stay keep their slots.
    ///
    /// # Errors
    /// As [`Painting::slots_with`]; nothing is changed then.
    pub fn set_palette(&mut self, pigments: &[usize]) -> Result<(), PaintingError> {
        let slots = self.slots_with(pigments)?;
        self.acting(|painting| {
            // What they take up from now on is paint of this palette.
            for brush in &painting.brushes {
                painting.history.save_brush(&mut painting.engine, brush.id)?;
            }
            painting.state.slots = slots;
            Ok(())
        })
    }

    /// The slots that [`Painting::set_palette`] would give: pigments that stay
    /// keep theirs.
    ///
    /// # Errors
    /// [`PaintingError`] for more than eight, or where a pigment that leaves is
    /// still wet on the canvas or on a brush.
    pub fn slots_with(&mut self, pigments: &[usize]) -> Result<Slots, PaintingError> {
        let mut wanted: Vec<usize> = Vec::new();
        for &pigment in pigments {
            if !wanted.contains(&pigment) {
                wanted.push(pigment);
            }
        }
        if wanted.len() > self.state.slots.len() {
            return Err(PaintingError::TooManyPigments { found: wanted.len() });
        }
        let mut slots: Slots = self.state.slots;
        let leaves = |slot: Option<usize>| slot.is_some_and(|pigment| !wanted.contains(&pigment));
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

    /// Exchanges a pigment of a layer for another of the library, as if it had
    /// been painted with that.
    ///
    /// # Errors
    /// [`PaintingError`] where the layer lacks the first or has the second.
    pub fn swap_pigment(
        &mut self,
        coating: LayerRef,
        from: usize,
        to: usize,
    ) -> Result<(), PaintingError> {
        let slots = self.slots(coating)?;
        if slots.contains(&Some(to)) {
            return Err(PaintingError::AlreadyThere { pigment: self.pigment_name(to) });
        }
        let place = slots
            .iter()
            .position(|&slot| slot == Some(from))
            .ok_or_else(|| PaintingError::NotThere { pigment: self.pigment_name(from) })?;
        self.acting(|painting| {
            match coating {
                LayerRef::Wet => painting.state.slots[place] = Some(to),
                LayerRef::Dry(index) => painting.state.dry[index].slots[place] = Some(to),
            }
            painting.views.unseen();
            Ok(())
        })
    }

    /// Multiplies the optical thickness of a dry layer with `opacity` (1 as it
    /// was painted, 0 hides it); its height stays.
    ///
    /// # Errors
    /// [`PaintingError`] for the wet layer, one that is not there, or an opacity
    /// outside 0..1000.
    pub fn set_opacity(&mut self, coating: LayerRef, opacity: f64) -> Result<(), PaintingError> {
        let LayerRef::Dry(index) = coating else { return Err(PaintingError::WetOpacity) };
        self.slots(coating)?;
        if !(0.0..=1000.0).contains(&opacity) {
            return Err(PaintingError::Opacity { value: opacity });
        }
        self.acting(|painting| {
            painting.state.dry[index].opacity = opacity;
            painting.views.unseen();
            Ok(())
        })
    }

    /// The pigments of a layer.
    ///
    /// # Errors
    /// [`PaintingError::NoLayer`] for a layer that is not there.
    pub fn slots(&self, coating: LayerRef) -> Result<Slots, PaintingError> {
        match coating {
            LayerRef::Wet => Ok(self.state.slots),
            LayerRef::Dry(index) => match self.state.dry.get(index) {
                Some(state) => Ok(state.slots),
                None => Err(PaintingError::NoLayer { index, count: self.state.dry.len() }),
            },
        }
    }

    /// The slot of the palette that holds a pigment of the library.
    ///
    /// # Errors
    /// [`PaintingError::OffPalette`] if none does.
    pub fn slot_of(&self, pigment: usize) -> Result<usize, PaintingError> {
        let found = self.state.slots.iter().position(|&slot| slot == Some(pigment));
        found.ok_or_else(|| PaintingError::OffPalette { pigment: self.pigment_name(pigment) })
    }

    pub(super) fn pigment_name(&self, index: usize) -> String {
        self.library.pigments[index].name.clone()
    }

    /// After the floor rose or sank.
    pub(super) fn floor_changed(&mut self) -> Result<(), PaintingError> {
        self.feel_floor()?;
        self.views.unseen();
        Ok(())
    }

    /// The first cell where ground and dry paint are as high as they can be.
    fn too_high(&mut self) -> Result<Option<(usize, usize)>, PaintingError> {
        let floor = self.engine.floor()?;
        let highest = HIGHEST as i32;
        let found = floor.values().iter().position(|&height| height > highest);
        Ok(found.map(|index| (index % floor.width(), index / floor.width())))
    }

    fn feel_floor(&mut self) -> Result<(), PaintingError> {
        self.dry_changes += 1;
        self.relief = Relief::from_floor(&self.engine.floor()?, self.cell_mm);
        Ok(())
    }
}
