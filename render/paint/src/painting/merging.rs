//! Merging two dry layers.
//!
//! The paint of both mixes. A factor on the optical thickness of one of them becomes part of its
//! paint: the pigment that it takes away is replaced by clear vehicle, so that heights stay.

use pigment::PigmentId;
use spectra::color::{Lab, RgbSpace, delta_e_ciede2000};

use super::failure::PaintingError;
use super::layer_ref::LayerRef;
use super::state::{DryLayerState, Painting};
use crate::document::Slots;
use crate::layer::{Layer, SLOTS};
use graphics::field::Field;

/// Largest colour difference that a merge may make, in CIEDE2000.
pub const MERGE_TOLERANCE: f64 = 0.1;

/// A merge that was found possible.
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
    /// unless that is empty. It lies where the lower was, or, if the films between overlap that
    /// one, where the upper was.
    ///
    /// The paints mix, so that films of different paint over each other would change colour; such
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
        let wet = PaintingError::WetLayer { what: "layer to merge with" };
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
            PaintingError::MergedPigments { pigments }
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
    /// no film between overlaps the upper, and at the place of the upper if none overlaps the lower.
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
                Err(PaintingError::FilmBetween { label: self.state.dry[index].label() })
            }
        }
    }

    /// Tries a merge on pictures without a trace in the history, with both layers shown, and
    /// refuses it if it changes a colour.
    fn refuse_visible(&mut self, merge: &Merge) -> Result<(), PaintingError> {
        let Merge { lower, upper, place, state, paint } = merge;
        let dry = self.state.dry.clone();
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
