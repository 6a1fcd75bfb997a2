//! The one place where actions change a painting, and the actions on its layers, lights and mask:
//! drying, pigments, opacity, names, order, merging, relighting.
//!
//! Dry layers are films, and one can be laid under another. Wet paint is above all of them. Heights
//! add up in any order, so moving a layer changes what covers what, not the relief. When two layers
//! merge, their paint mixes. A factor on the optical thickness of one of them becomes part of its
//! paint: clear vehicle replaces the pigment that the factor takes away, so that heights stay.
//!
//! A mask is film over cells that keeps paint from getting on or off them.

use std::sync::Arc;

use graphics::field::Field;
use graphics::tile::TileSet;
use pigment::PigmentId;
use spectra::color::{Lab, Matrix3, RgbSpace, delta_e_ciede2000};

use super::brushes::share_of_65536_parts;
use super::failure::PaintingError;
use super::state::{HIGHEST, Painting};
use crate::brush::Relief;
use crate::document::{Lighting, Slots};
use crate::engine::{BrushId, View};
use crate::layer::{DryLayerState, Layer, LayerRef, SLOTS};
use crate::light::Light;
use crate::mask::Mask;
use crate::strokes::{
    Action, ActionLimits, ActionPigments, CheckContext, Load, MaskChange, PaletteSpec,
    PigmentNames, Squeeze, pigment_names,
};

impl Painting {
    /// Applies an action of paint, layers or light, in which pigments have their names in the
    /// library. Returns whether there was anything to do.
    ///
    /// # Errors
    /// [`PaintingError`] for an action that cannot be done, or that only a
    /// [`PaintingSession`](crate::PaintingSession) does.
    ///
    /// # Panics
    /// If a stroke is open.
    pub fn apply(&mut self, action: &Action) -> Result<bool, PaintingError> {
        let at = CheckContext::default();
        let limits = ActionLimits { canvas_mm: self.longer_side_mm(), palette_mm: None };
        limits.check(&at, action)?;
        let own = PaletteSpec::from_names(pigment_names(&self.state.slots, &self.library));
        let (names, _) = PigmentNames::new(&own, &self.library)?;
        let pigments = names.pigments_of(&at, action, &self.library)?;
        self.change(action, &pigments)
    }

    /// Longer side of the canvas in mm.
    pub(crate) fn longer_side_mm(&self) -> f64 {
        let bounds = self.bounds();
        bounds.width.max(bounds.height) as f64 * self.cell_mm
    }

    /// Applies an action that was checked. Returns whether there was anything to do.
    pub(crate) fn change(
        &mut self,
        action: &Action,
        pigments: &ActionPigments,
    ) -> Result<bool, PaintingError> {
        match (action, pigments) {
            (Action::Dry { fraction }, _) => return self.dry(*fraction),
            (Action::Scrape { .. }, _) => return self.scrape(),
            (Action::Mask(change), _) => return self.change_mask(change),
            (Action::Palette(_), ActionPigments::Palette(slots)) => {
                let pigments: Vec<PigmentId> = slots.iter().flatten().copied().collect();
                self.set_palette(&pigments)?;
            }
            (Action::Light(lighting), _) => self.relight(lighting.clone())?,
            (Action::Gloss { wet, dry }, _) => self.apply_action(|painting| {
                let medium = &mut painting.state.medium;
                (medium.wet, medium.dry) = (*wet, *dry);
                painting.views.mark_all_wet();
                Ok(())
            })?,
            // Paint levels by it after the next stroke.
            (Action::Stiffness { value }, _) => self.apply_action(|painting| {
                painting.state.medium.stiffness = *value;
                Ok(())
            })?,
            (Action::Opacity { layer, value }, _) => self.set_opacity(*layer, *value)?,
            (Action::Swap { layer, .. }, ActionPigments::Swap { from, to }) => {
                self.swap_pigment(*layer, *from, *to)?;
            }
            (Action::Name { layer, name }, _) => {
                let index = self.dry_layer(*layer, "name")?;
                self.apply_action(|painting| {
                    painting.state.dry[index].name.clone_from(name);
                    Ok(())
                })?;
            }
            (Action::Visible { layer, value }, _) => {
                let index = self.dry_layer(*layer, "visibility")?;
                self.apply_action(|painting| {
                    painting.state.dry[index].visible = *value;
                    painting.views.mark_all();
                    Ok(())
                })?;
            }
            // Layers between the two places move by one.
            (&Action::Order { layer, to }, _) => {
                let from = self.dry_layer(layer, "place")?;
                self.dry_index(LayerRef::Dry(to))?;
                if from == to {
                    return Ok(false);
                }
                self.apply_action(|painting| {
                    painting.history.move_dry_layer(&mut painting.engine, from, to);
                    let moved = painting.state.dry.remove(from);
                    painting.state.dry.insert(to, moved);
                    painting.floor_changed()
                })?;
            }
            (&Action::Merge { layer, with: Some(with) }, _) => self.merge(layer, with)?,
            (&Action::Merge { layer, with: None }, _) => {
                match self.dry_layer(layer, "layer to merge with")? {
                    0 => return Err(PaintingError::NothingBelow),
                    index => self.merge(layer, LayerRef::Dry(index - 1))?,
                }
            }
            (Action::Squeeze(squeeze), ActionPigments::Recipe(parts)) => {
                let recipe = self.recipe(parts)?;
                let Squeeze { vehicle, x_mm, y_mm, volume_mm3, .. } = *squeeze;
                self.squeeze(&recipe, vehicle, x_mm, y_mm, volume_mm3)?;
            }
            (action, _) => return Err(PaintingError::NoSession(action.kind())),
        }
        Ok(true)
    }

    /// Applies an action that was checked to the paint on a brush.
    pub(crate) fn change_brush(
        &mut self,
        brush: BrushId,
        action: &Action,
        pigments: &ActionPigments,
    ) -> Result<(), PaintingError> {
        match (action, pigments) {
            (Action::Load(Load { vehicle, amount_mm, .. }), ActionPigments::Recipe(parts)) => {
                self.load(brush, &self.recipe(parts)?, *vehicle, *amount_mm)
            }
            (Action::Wipe { keep, .. }, _) => self.wipe(brush, *keep),
            (Action::Wash { .. }, _) => self.wash(brush),
            (action, _) => Err(PaintingError::NoSession(action.kind())),
        }
    }

    /// Index of a dry layer. An error for the wet one, which has no `what`.
    fn dry_layer(&self, layer: LayerRef, what: &'static str) -> Result<usize, PaintingError> {
        self.dry_index(layer)?.ok_or(PaintingError::WetLayer(what))
    }

    /// Parts of a recipe by slot of the palette.
    pub(crate) fn recipe(&self, parts: &[(PigmentId, f64)]) -> Result<[f64; SLOTS], PaintingError> {
        let mut recipe = [0.0; SLOTS];
        for &(pigment, part) in parts {
            recipe[self.slot_of(pigment)?] = part;
        }
        Ok(recipe)
    }
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
        let share = share_of_65536_parts("fraction is a share of 0 to 1", fraction)?;
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
    /// [`PaintingError`] for more than eight pigments, or if a pigment that leaves is still
    /// wet on the canvas or on a brush. Nothing is changed then.
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
    pub(crate) fn slots_with(&mut self, pigments: &[PigmentId]) -> Result<Slots, PaintingError> {
        let mut wanted: Vec<PigmentId> = Vec::new();
        for &pigment in pigments {
            if !wanted.contains(&pigment) {
                wanted.push(pigment);
            }
        }
        if wanted.len() > self.state.slots.len() {
            return Err(PaintingError::TooManyPigments(wanted.len()));
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
                        return Err(PaintingError::StillWet(pigment));
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
            return Err(PaintingError::AlreadyThere(self.pigment_name(to)));
        }
        let place = slots
            .iter()
            .position(|&slot| slot == Some(from))
            .ok_or_else(|| PaintingError::NotThere(self.pigment_name(from)))?;
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
            return Err(PaintingError::Range { what: "an opacity is 0 to 1000", value: opacity });
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

    /// Index of a dry layer from the lowest, which is 0. `None` for the wet one.
    pub(crate) fn dry_index(&self, layer: LayerRef) -> Result<Option<usize>, PaintingError> {
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
        found.ok_or_else(|| PaintingError::OffPalette(self.pigment_name(pigment)))
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

impl Painting {
    /// The mask, if one is set. It is not part of the document: a file does not hold it.
    #[must_use]
    pub fn mask(&self) -> Option<&Arc<Mask>> {
        self.mask.as_ref()
    }

    /// Changes the mask. Strokes, heaps and scraping change no paint of covered cells, and nothing
    /// flows over the border. Light and drying go through the film. Returns whether there was
    /// anything to change: without a mask there is none to invert or to take off.
    pub(crate) fn change_mask(&mut self, change: &MaskChange) -> Result<bool, PaintingError> {
        let bounds = self.bounds();
        let next = match (change, &self.mask) {
            (MaskChange::Inverse(_) | MaskChange::Clear {}, None) => return Ok(false),
            (MaskChange::Clear {}, Some(_)) => None,
            (MaskChange::Inverse(_), Some(mask)) => Some(mask.inverse()),
            (MaskChange::PolygonMm(points_mm), _) => {
                let points: Vec<_> =
                    points_mm.iter().map(|&[x, y]| (x / self.cell_mm, y / self.cell_mm)).collect();
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

impl Painting {
    /// Shows the painting under another light, given by name.
    ///
    /// # Errors
    /// [`PaintingError::Light`] if the light is unknown.
    ///
    /// # Panics
    /// If a stroke is open.
    pub fn relight(&mut self, lighting: Lighting) -> Result<(), PaintingError> {
        let light = if same_light(&self.state.lighting, &lighting) {
            None
        } else {
            Some(Light::named(&self.library, &lighting.illuminant, &lighting.observer)?)
        };
        self.apply_action(|painting| {
            painting.state.lighting = lighting;
            match light {
                Some(light) => {
                    painting.light = Arc::new(light);
                    painting.views.first.mark_all(painting.engine.bounds());
                }
                None => painting.views.first.wet = TileSet::all(painting.engine.bounds()),
            }
            Ok(())
        })
    }

    /// Also keeps a picture under a second light, for a view that is split between the two. `None`
    /// frees its memory. This is not an action of the history.
    ///
    /// # Errors
    /// [`PaintingError::Light`] if the light is unknown. The second light stays unchanged.
    pub fn set_second_light(&mut self, lighting: Option<Lighting>) -> Result<(), PaintingError> {
        let Some(lighting) = lighting else {
            self.views.second = None;
            self.engine.forget_view(View::Second);
            return Ok(());
        };
        let known = self.views.second.as_ref();
        let known = known.map(|second| (&second.lighting, &second.light));
        let known = known.into_iter().chain([(&self.state.lighting, &self.light)]);
        let light = match known.into_iter().find(|(known, _)| same_light(known, &lighting)) {
            Some((_, light)) => Arc::clone(light),
            None => {
                let Lighting { illuminant, observer, .. } = &lighting;
                Arc::new(Light::named(&self.library, illuminant, observer)?)
            }
        };
        self.views.set_second(lighting, light);
        Ok(())
    }

    /// The second light, if there is one.
    #[must_use]
    pub fn second_light(&self) -> Option<&Lighting> {
        self.views.second.as_ref().map(|second| &second.lighting)
    }

    /// Shows the painting under the light of another painting of the same library.
    pub(crate) fn relight_as(&mut self, other: &Self) -> Result<(), PaintingError> {
        self.apply_action(|painting| {
            painting.state.lighting = other.state.lighting.clone();
            let bounds = painting.engine.bounds();
            if Arc::ptr_eq(&painting.light, &other.light) {
                painting.views.first.wet = TileSet::all(bounds);
            } else {
                painting.light = Arc::clone(&other.light);
                painting.views.first.mark_all(bounds);
            }
            Ok(())
        })
    }
}

/// Whether both name the same illuminant and observer.
fn same_light(a: &Lighting, b: &Lighting) -> bool {
    (&a.illuminant, &a.observer) == (&b.illuminant, &b.observer)
}

/// Largest colour difference that a merge may make, in CIEDE2000.
pub const MERGE_TOLERANCE: f64 = 0.1;

/// A merge that the checks of `possible_merge` accept.
struct Merge {
    /// Index of the lower layer.
    lower: usize,
    /// Index of the upper layer.
    upper: usize,
    /// Index of the merged layer, once both are taken out.
    place: usize,
    state: DryLayerState,
    paint: Layer,
}

impl Painting {
    /// Merges two dry layers. The merged layer has the identity of the lower one, and its name
    /// unless that is empty. It lies where the lower layer was. If films between them overlap the
    /// lower one, it lies where the upper layer was.
    ///
    /// The paints mix, so that films of different paint over each other would change colour. Such
    /// a merge is refused. So is one with a film between that overlaps both.
    ///
    /// # Errors
    /// [`PaintingError`] if a colour would change by more than [`MERGE_TOLERANCE`], if a film lies
    /// between, if the two have more than eight pigments, if only one of them is visible, and if
    /// there are no two such layers. Nothing is changed then.
    ///
    /// # Panics
    /// If a stroke is open.
    pub fn merge(&mut self, a: LayerRef, b: LayerRef) -> Result<(), PaintingError> {
        let merge = self.possible_merge(a, b)?;
        self.refuse_visible(&merge)?;
        self.apply_action(|painting| {
            let Merge { lower, upper, place, state, paint } = merge;
            for index in [upper, lower] {
                painting.history.remove_dry_layer(&mut painting.engine, index)?;
                painting.state.dry.remove(index);
            }
            painting.history.insert_dry_layer(&mut painting.engine, place, &paint)?;
            painting.state.dry.insert(place, state);
            painting.floor_changed()
        })
    }

    /// The merge of two layers, if films between and pigments allow it.
    fn possible_merge(&mut self, a: LayerRef, b: LayerRef) -> Result<Merge, PaintingError> {
        let wet = PaintingError::WetLayer("layer to merge with");
        let (Some(a), Some(b)) = (self.dry_index(a)?, self.dry_index(b)?) else { return Err(wet) };
        let lower = a.min(b);
        let upper = a.max(b);
        if lower == upper {
            return Err(PaintingError::SameLayer);
        }
        let [below, above] = [lower, upper].map(|index| self.state.dry[index].clone());
        if below.visible != above.visible {
            return Err(PaintingError::UnlikeVisibility);
        }
        let mut paint = self.engine.dry_layer(lower)?;
        let mut over = self.engine.dry_layer(upper)?;
        let place = self.merged_place((lower, &paint), (upper, &over))?;
        let used = [used_slots(&below.slots, &paint), used_slots(&above.slots, &over)];
        let (slots, places) = united(used[0], used[1]).map_err(|all| {
            let pigments = all.into_iter().map(|pigment| self.pigment_name(pigment)).collect();
            PaintingError::MergedPigments(pigments)
        })?;
        let opacity = below.opacity.max(above.opacity);
        if opacity > 0.0 {
            thin(&mut paint, below.opacity / opacity);
            thin(&mut over, above.opacity / opacity);
        }
        add(&mut paint, &over, &places);
        let name = if below.name.is_empty() { above.name } else { below.name };
        let state = DryLayerState { name, slots, opacity, ..below };
        Ok(Merge { lower, upper, place, state, paint })
    }

    /// Index of the merged layer, once both are taken out: it may lie at the place of the lower if
    /// no film between overlaps the upper, and at the place of the upper if none overlaps the
    /// lower.
    fn merged_place(
        &mut self,
        (lower, below): (usize, &Layer),
        (upper, above): (usize, &Layer),
    ) -> Result<usize, PaintingError> {
        let mut down = None;
        let mut up = None;
        for index in lower + 1..upper {
            let film = self.engine.dry_layer(index)?;
            down = down.or_else(|| overlap(&film, above).then_some(index));
            up = up.or_else(|| overlap(&film, below).then_some(index));
        }
        match (down, up) {
            (None, _) => Ok(lower),
            (_, None) => Ok(upper - 1),
            (Some(index), Some(_)) => {
                Err(PaintingError::FilmBetween(self.state.dry[index].label()))
            }
        }
    }

    /// Tries a merge on pictures without a trace in the history, with both layers shown, and
    /// refuses it if it changes a colour. Thin paint may cover a little more or less of its cell than in
    /// two layers, so the pictures have even films.
    fn refuse_visible(&mut self, merge: &Merge) -> Result<(), PaintingError> {
        let Merge { lower, upper, place, state, paint } = merge;
        let dry = self.state.dry.clone();
        let films_break = std::mem::replace(&mut self.state.medium.films_break, false);
        for index in [*lower, *upper] {
            self.state.dry[index].visible = true;
        }
        self.views.mark_all();
        let before = self.picture()?;
        let over = self.engine.remove_dry_layer(*upper)?;
        let below = self.engine.remove_dry_layer(*lower)?;
        self.engine.insert_dry_layer(*place, paint)?;
        self.state.dry.remove(*upper);
        self.state.dry.remove(*lower);
        self.state.dry.insert(*place, DryLayerState { visible: true, ..state.clone() });
        self.views.mark_all();
        let (delta_e, x, y) = farthest(&before, &self.picture()?);
        self.engine.remove_dry_layer(*place)?;
        self.engine.insert_dry_layer(*lower, &below)?;
        self.engine.insert_dry_layer(*upper, &over)?;
        self.state.dry = dry;
        self.state.medium.films_break = films_break;
        self.views.mark_all();
        if delta_e > MERGE_TOLERANCE {
            return Err(PaintingError::MergeShows { delta_e, x, y });
        }
        Ok(())
    }
}

/// Whether two layers have paint in the same cell.
fn overlap(a: &Layer, b: &Layer) -> bool {
    let cells = 0..a.vehicle.values().len();
    cells.into_iter().any(|index| a.cell(index).volume() > 0 && b.cell(index).volume() > 0)
}

/// The slots of a layer that hold paint.
fn used_slots(slots: &Slots, paint: &Layer) -> Slots {
    let totals = paint.totals();
    std::array::from_fn(|slot| slots[slot].filter(|_| totals[slot] > 0))
}

/// Slots of both layers merged, and the slot of each pigment of the upper layer in them. If they
/// have more than eight pigments, the error lists all of these.
fn united(lower: Slots, upper: Slots) -> Result<(Slots, [usize; SLOTS]), Vec<PigmentId>> {
    let mut slots = lower;
    let mut place = [0; SLOTS];
    let mut lacking = Vec::new();
    for (slot, pigment) in upper.iter().enumerate() {
        let Some(pigment) = *pigment else { continue };
        let found = slots.iter().position(|&other| other == Some(pigment));
        match found.or_else(|| slots.iter().position(Option::is_none)) {
            Some(free) => {
                slots[free] = Some(pigment);
                place[slot] = free;
            }
            None => lacking.push(pigment),
        }
    }
    if lacking.is_empty() {
        return Ok((slots, place));
    }
    Err(slots.into_iter().flatten().chain(lacking).collect())
}

/// Keeps a share of each pigment, 0 to 1, and replaces the rest by clear vehicle.
fn thin(paint: &mut Layer, share: f64) {
    if share == 1.0 {
        return;
    }
    for index in 0..paint.vehicle.values().len() {
        let mut cell = paint.cell(index);
        for amount in &mut cell.pigments {
            let kept = (f64::from(*amount) * share).round() as u32;
            cell.vehicle += *amount - kept.min(*amount);
            *amount = kept.min(*amount);
        }
        paint.set_cell(index, cell);
    }
}

/// Adds `upper` to `lower`. Slot `i` of `upper` is slot `place[i]` of `lower`.
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

/// Largest colour difference between two pictures in CIEDE2000, with its column and row.
fn farthest(a: &Field<[f32; 4]>, b: &Field<[f32; 4]>) -> (f64, usize, usize) {
    let matrix = RgbSpace::Srgb.xyz_from_linear();
    let mut largest = (0.0, 0, 0);
    let width = a.width();
    for (cell, (a, b)) in a.values().iter().zip(b.values()).enumerate() {
        let delta_e =
            if a == b { 0.0 } else { delta_e_ciede2000(lab(a, &matrix), lab(b, &matrix)) };
        if delta_e > largest.0 {
            largest = (delta_e, cell % width, cell / width);
        }
    }
    largest
}

fn lab(rgb: &[f32; 4], matrix: &Matrix3) -> Lab {
    let linear = [rgb[0], rgb[1], rgb[2]].map(f64::from);
    Lab::from_xyz(matrix.apply(linear).into(), RgbSpace::Srgb.white())
}
