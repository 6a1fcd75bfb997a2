//! A layer of paint holds the amounts of eight pigments and of vehicle in every cell. A dry layer
//! adds properties that you can change later, for example its opacity.

use std::fmt;

use graphics::field::Field;
use graphics::tile::Rect;
use pigment::PigmentId;
use serde::de::{self, Deserializer, MapAccess, Visitor};
use serde::ser::SerializeMap;
use serde::{Deserialize, Serialize, Serializer};

use crate::amount::{self, share_of_256, share_of_65536};

/// Number of pigments that a layer can hold, each in a slot of its own.
pub const SLOTS: usize = amount::PIGMENTS;

/// The pigments of a layer by slot.
pub type Slots = [Option<PigmentId>; SLOTS];

/// The paint in one cell, in quanta: the paint of each pigment and transparent vehicle
/// (oil, medium). Their sum is the cell's volume.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Cell {
    /// Amount of each pigment's paint in quanta, by slot.
    pub pigments: [u32; SLOTS],
    /// Amount of vehicle in quanta.
    pub vehicle: u32,
}

impl Cell {
    /// Sum of all amounts, which is the height of the column in quanta.
    #[inline(always)]
    #[must_use]
    pub fn volume(&self) -> u32 {
        self.vehicle + amount::total(&self.pigments)
    }

    /// Computes `amount * share / 65536` of each amount, rounded down.
    #[inline(always)]
    #[must_use]
    pub fn share_of_65536(&self, share: u32) -> Self {
        let vehicle = share_of_65536(self.vehicle, share);
        Self { pigments: amount::share(&self.pigments, share), vehicle }
    }

    /// Computes `amount * share / 256` of each amount, rounded down.
    #[inline(always)]
    #[must_use]
    pub fn share_of_256(&self, share: u32) -> Self {
        let pigments = self.pigments.map(|amount| share_of_256(amount, share));
        Self { pigments, vehicle: share_of_256(self.vehicle, share) }
    }

    /// Adds `other`, amount by amount.
    #[inline(always)]
    #[must_use]
    pub fn plus(&self, other: &Self) -> Self {
        let pigments = amount::sum(&self.pigments, &other.pigments);
        Self { pigments, vehicle: self.vehicle + other.vehicle }
    }

    /// Subtracts `part`. None of its amounts may exceed this cell's.
    #[inline(always)]
    #[must_use]
    pub fn minus(&self, part: &Self) -> Self {
        let pigments = amount::difference(&self.pigments, &part.pigments);
        Self { pigments, vehicle: self.vehicle - part.vehicle }
    }

    /// Adds `other` modulo 2^32, for sums whose intermediate results may be negative.
    #[inline(always)]
    #[must_use]
    pub fn wrapping_plus(&self, other: &Self) -> Self {
        let pigments = amount::wrapping_sum(&self.pigments, &other.pigments);
        Self { pigments, vehicle: self.vehicle.wrapping_add(other.vehicle) }
    }

    /// Subtracts `part` modulo 2^32.
    #[inline(always)]
    #[must_use]
    pub fn wrapping_minus(&self, part: &Self) -> Self {
        let pigments = amount::wrapping_difference(&self.pigments, &part.pigments);
        Self { pigments, vehicle: self.vehicle.wrapping_sub(part.vehicle) }
    }
}

/// Paint over a rectangle of cells: wet or dry on the canvas, or on the head of a brush.
///
/// A layer is one film or two. The lower film is the body. Where a brush laid paint on wet paint,
/// a skin lies over the body: you see it first, and the body where the skin does not hide it.
/// 36 bytes a cell, 72 with a skin.
#[derive(Debug, Clone)]
pub struct Layer {
    /// Amount of each pigment's paint in the body in quanta, by slot.
    pub pigments: Field<[u32; SLOTS]>,
    /// Amount of vehicle in the body in quanta.
    pub vehicle: Field<u32>,
    /// The skin over the body, of the same size. `None` if no cell has one. A skin has no skin.
    pub skin: Option<Box<Layer>>,
}

/// A row of cells of one film.
#[derive(Debug, Clone, Copy)]
pub struct FilmRow<'a> {
    /// Amount of each pigment's paint in quanta, by slot.
    pub pigments: &'a [[u32; SLOTS]],
    /// Amount of vehicle in quanta. Empty if no cell has any.
    pub vehicle: &'a [u32],
}

/// Layers are equal if all amounts are. A skin without paint equals no skin.
impl PartialEq for Layer {
    fn eq(&self, other: &Self) -> bool {
        let skins = match (self.painted_skin(), other.painted_skin()) {
            (None, None) => true,
            (Some(skin), Some(other)) => skin == other,
            _ => false,
        };
        self.pigments == other.pigments && self.vehicle == other.vehicle && skins
    }
}

impl Layer {
    /// A layer of `width` x `height` cells without paint.
    #[must_use]
    pub fn empty(width: usize, height: usize) -> Self {
        Self {
            pigments: Field::filled(width, height, [0; SLOTS]),
            vehicle: Field::filled(width, height, 0),
            skin: None,
        }
    }

    /// Width in cells.
    #[must_use]
    pub fn width(&self) -> usize {
        self.vehicle.width()
    }

    /// Height in cells.
    #[must_use]
    pub fn height(&self) -> usize {
        self.vehicle.height()
    }

    /// The paint of both films in the cell with this index, counted row by row.
    #[inline(always)]
    #[must_use]
    pub fn cell(&self, index: usize) -> Cell {
        match &self.skin {
            None => self.body_cell(index),
            Some(skin) => self.body_cell(index).plus(&skin.body_cell(index)),
        }
    }

    /// The paint of the body in the cell with this index.
    #[inline(always)]
    fn body_cell(&self, index: usize) -> Cell {
        Cell { pigments: self.pigments.values()[index], vehicle: self.vehicle.values()[index] }
    }

    /// The paint of the body and of the skin in the cell with this index.
    #[must_use]
    pub fn films(&self, index: usize) -> [Cell; 2] {
        let skin = self.skin.as_ref().map(|skin| skin.body_cell(index));
        [self.body_cell(index), skin.unwrap_or_default()]
    }

    /// Replaces the paint in the cell with this index, counted row by row, by a body without a skin.
    #[inline(always)]
    pub fn set_cell(&mut self, index: usize, cell: Cell) {
        self.pigments.values_mut()[index] = cell.pigments;
        self.vehicle.values_mut()[index] = cell.vehicle;
        if let Some(skin) = &mut self.skin {
            skin.set_cell(index, Cell::default());
        }
    }

    /// Replaces the body and the skin in the cell with this index.
    pub fn set_films(&mut self, index: usize, [body, skin]: [Cell; 2]) {
        self.set_cell(index, body);
        if skin != Cell::default() {
            self.skin_mut().set_cell(index, skin);
        }
    }

    /// The skin, to change it. The layer gets one without paint if it has none.
    pub fn skin_mut(&mut self) -> &mut Self {
        let Rect { width, height, .. } = self.vehicle.bounds();
        self.skin.get_or_insert_with(|| Box::new(Self::empty(width, height)))
    }

    /// The skin if any of its cells has paint.
    #[must_use]
    pub fn painted_skin(&self) -> Option<&Self> {
        let skin = self.skin.as_deref();
        skin.filter(|skin| (0..skin.vehicle.values().len()).any(|i| skin.cell(i).volume() > 0))
    }

    /// The body of `count` cells from column `x` of row `y`.
    ///
    /// # Panics
    /// If the layer does not have these cells.
    #[must_use]
    pub fn row(&self, y: usize, x: usize, count: usize) -> FilmRow<'_> {
        let pigments = self.pigments.row(y, x, count);
        FilmRow { pigments, vehicle: self.vehicle.row(y, x, count) }
    }

    /// The body and the skin as layers of one film, the lower first. One layer if there is no skin.
    pub fn single_films(&self) -> impl Iterator<Item = &Self> {
        std::iter::once(self).chain(self.skin.as_deref())
    }

    /// Copies the paint in `rect`.
    ///
    /// # Panics
    /// If `rect` reaches beyond the layer.
    #[must_use]
    pub fn part(&self, rect: Rect) -> Self {
        let skin = self.skin.as_ref().map(|skin| Box::new(skin.part(rect)));
        let pigments = self.pigments.part(rect);
        let mut part = Self { pigments, vehicle: self.vehicle.part(rect), skin };
        if part.painted_skin().is_none() {
            part.skin = None;
        }
        part
    }

    /// Replaces the cells under `part`, whose upper left cell goes to column `x` of
    /// row `y`.
    ///
    /// # Panics
    /// If `part` reaches beyond the layer.
    pub fn put(&mut self, (x, y): (usize, usize), part: &Self) {
        self.pigments.put((x, y), &part.pigments);
        self.vehicle.put((x, y), &part.vehicle);
        match (&part.skin, &mut self.skin) {
            (Some(skin), _) => self.skin_mut().put((x, y), skin),
            (None, Some(skin)) => skin.put((x, y), &Self::empty(part.width(), part.height())),
            (None, None) => {}
        }
    }

    /// Sums each pigment over all cells and both films, in quanta. The last element is vehicle.
    #[must_use]
    pub fn totals(&self) -> [u64; SLOTS + 1] {
        let mut totals = [0; SLOTS + 1];
        for film in self.single_films() {
            for pigments in film.pigments.values() {
                for (total, &amount) in totals.iter_mut().zip(pigments) {
                    *total += u64::from(amount);
                }
            }
            let vehicle = film.vehicle.values().iter();
            totals[SLOTS] += vehicle.map(|&amount| u64::from(amount)).sum::<u64>();
        }
        totals
    }
}

/// Most characters in the name of a layer.
pub const MAX_LAYER_NAME: usize = 80;

/// Identity of a dry layer: a number from 1 that stays with the layer when you move, rename or save
/// it. No other layer of the painting gets this number, unless an undo takes the layer away and
/// gives its number back.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(transparent)]
pub struct LayerId(pub u32);

impl LayerId {
    /// Identity of the first layer of a painting.
    pub const FIRST: Self = Self(1);

    /// Identity for a layer from a file that does not store one. We count its place `index` from 1.
    #[must_use]
    pub fn by_place(index: usize) -> Self {
        Self(u32::try_from(index).map_or(u32::MAX, |index| index.saturating_add(1)))
    }

    /// The next identity after this one.
    #[must_use]
    pub fn next(self) -> Self {
        Self(self.0.saturating_add(1))
    }
}

impl fmt::Display for LayerId {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(formatter)
    }
}

/// A dry layer of paint.
#[derive(Debug, Clone, PartialEq)]
pub struct DryLayer {
    /// Its identity within the painting.
    pub id: LayerId,
    /// Its name, up to [`MAX_LAYER_NAME`] characters. Empty if it has none.
    pub name: String,
    /// Whether you see this layer. A hidden layer keeps its opacity and its height.
    pub visible: bool,
    /// Pigments of the layer.
    pub slots: Slots,
    /// Factor on the optical thickness of the paint: 1 as painted, 0 clear.
    pub opacity: f64,
    /// Amounts of paint in every cell.
    pub paint: Layer,
}

impl DryLayer {
    /// A layer as it was painted: visible and without a name.
    #[must_use]
    pub fn new(id: LayerId, slots: Slots, paint: Layer) -> Self {
        Self { id, name: String::new(), visible: true, slots, opacity: 1.0, paint }
    }

    /// Factor on the optical thickness as you see it: 0 for a hidden layer.
    #[must_use]
    pub fn shown_opacity(&self) -> f64 {
        shown_opacity(self.visible, self.opacity)
    }
}

/// Properties of a dry layer that can be changed later.
#[derive(Debug, Clone, PartialEq)]
pub struct DryLayerState {
    /// Its identity within the painting.
    pub id: LayerId,
    /// Its name. Empty if it has none.
    pub name: String,
    /// Whether it is shown.
    pub visible: bool,
    /// Pigment of each slot, as an index into the library.
    pub slots: Slots,
    /// Factor of the optical thickness: 1 as painted, 0 clear.
    pub opacity: f64,
}

impl DryLayerState {
    /// A layer that just dried.
    pub(crate) fn new(id: LayerId, slots: Slots) -> Self {
        Self { id, name: String::new(), visible: true, slots, opacity: 1.0 }
    }

    /// Opacity as it is shown: 0 for a hidden layer.
    #[must_use]
    pub fn shown_opacity(&self) -> f64 {
        shown_opacity(self.visible, self.opacity)
    }

    /// Its name, or its number if it has none.
    #[must_use]
    pub fn label(&self) -> String {
        layer_label(self.id, &self.name)
    }
}

/// One layer of a painting.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LayerRef {
    /// The wet layer.
    Wet,
    /// A dry layer by its index. 0 is the lowest.
    Dry(usize),
    /// A dry layer by its identity, wherever it lies.
    Id(LayerId),
}

/// A layer is `"wet"`, the index of a dry layer from 0, the lowest, or `{"id": 3}`.
impl Serialize for LayerRef {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::Wet => serializer.serialize_str("wet"),
            Self::Dry(index) => serializer.serialize_u64(*index as u64),
            Self::Id(id) => {
                let mut map = serializer.serialize_map(Some(1))?;
                map.serialize_entry("id", id)?;
                map.end()
            }
        }
    }
}

impl<'de> Deserialize<'de> for LayerRef {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Name;

        impl<'de> Visitor<'de> for Name {
            type Value = LayerRef;

            fn expecting(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
                formatter.write_str(
                    "\"wet\", the number of a dry layer, from 0, or its identity, {\"id\": 1}",
                )
            }

            fn visit_str<E: de::Error>(self, text: &str) -> Result<LayerRef, E> {
                match text {
                    "wet" => Ok(LayerRef::Wet),
                    _ => Err(E::invalid_value(de::Unexpected::Str(text), &self)),
                }
            }

            fn visit_u64<E: de::Error>(self, index: u64) -> Result<LayerRef, E> {
                let dry = usize::try_from(index).map(LayerRef::Dry);
                dry.map_err(|_| E::invalid_value(de::Unexpected::Unsigned(index), &self))
            }

            fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<LayerRef, A::Error> {
                let mut id = None;
                while let Some(key) = map.next_key::<String>()? {
                    match key.as_str() {
                        "id" if id.is_none() => id = Some(map.next_value()?),
                        "id" => return Err(de::Error::duplicate_field("id")),
                        other => return Err(de::Error::unknown_field(other, &["id"])),
                    }
                }
                id.map(LayerRef::Id).ok_or_else(|| de::Error::missing_field("id"))
            }
        }

        deserializer.deserialize_any(Name)
    }
}

/// Opacity of a layer as it is shown: 0 if it is hidden.
#[must_use]
pub fn shown_opacity(visible: bool, opacity: f64) -> f64 {
    if visible { opacity } else { 0.0 }
}

/// Label of a layer: its name, or its number if it has none.
#[must_use]
pub fn layer_label(id: LayerId, name: &str) -> String {
    if name.is_empty() { format!("Layer {id}") } else { name.to_owned() }
}

/// Returns `None` if you may give a layer this name, else a description of the names allowed.
#[must_use]
pub fn layer_name_violation(name: &str) -> Option<&'static str> {
    if name.chars().count() > MAX_LAYER_NAME {
        return Some("a name of at most 80 characters");
    }
    if name.chars().any(char::is_control) {
        return Some("a name on one line, without control characters");
    }
    (name.trim() != name).then_some("a name without spaces at its ends")
}

/// Gives a new identity to each layer with the identity 0 or one that is taken. Returns the
/// identity of the next new layer, at least `next`.
pub fn distinct_ids<'a>(ids: impl Iterator<Item = &'a mut LayerId>, next: LayerId) -> LayerId {
    let ids: Vec<&mut LayerId> = ids.collect();
    let highest = ids.iter().map(|id| **id).filter(|id| id.0 < u32::MAX).max();
    let mut next = highest.map_or(LayerId::FIRST, LayerId::next).max(next).max(LayerId::FIRST);
    let mut taken = Vec::with_capacity(ids.len());
    for id in ids {
        if id.0 == 0 || id.0 == u32::MAX || taken.contains(id) {
            *id = next;
            next = next.next();
        }
        taken.push(*id);
    }
    next
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn taken_identities_are_replaced_by_new_ones() {
        let mut ids = [3, 0, 3, 1, u32::MAX].map(LayerId);
        assert_eq!(distinct_ids(ids.iter_mut(), LayerId(2)), LayerId(7));
        assert_eq!(ids, [3, 4, 5, 1, 6].map(LayerId));
        assert_eq!(distinct_ids(ids.iter_mut(), LayerId(20)), LayerId(20), "the count goes on");
        assert_eq!(ids, [3, 4, 5, 1, 6].map(LayerId));
        assert_eq!(distinct_ids([].iter_mut(), LayerId(0)), LayerId::FIRST);
    }

    #[test]
    fn names_are_one_short_line() {
        let longest = "\u{e9}".repeat(MAX_LAYER_NAME);
        for name in ["", "sky", "second glaze, 2", longest.as_str()] {
            assert_eq!(layer_name_violation(name), None, "{name}");
        }
        for name in [" sky", "sky ", "a\nb", "\u{7}", &"x".repeat(MAX_LAYER_NAME + 1)] {
            assert!(layer_name_violation(name).is_some(), "{name:?}");
        }
        assert_eq!(layer_label(LayerId(3), ""), "Layer 3");
        assert_eq!(layer_label(LayerId(3), "sky"), "sky");
    }

    #[test]
    fn layers_are_named_wet_by_place_or_by_identity() {
        let all = [
            (LayerRef::Wet, "\"wet\""),
            (LayerRef::Dry(2), "2"),
            (LayerRef::Id(LayerId(3)), "{\"id\":3}"),
        ];
        for (layer, text) in all {
            assert_eq!(serde_json::to_string(&layer).unwrap(), text);
            assert_eq!(serde_json::from_str::<LayerRef>(text).unwrap(), layer);
        }
        for wrong in
            ["\"dry\"", "-1", "1.5", "{}", "{\"id\":-1}", "{\"id\":1,\"id\":2}", "{\"no\":1}"]
        {
            assert!(serde_json::from_str::<LayerRef>(wrong).is_err(), "{wrong}");
        }
    }
}
