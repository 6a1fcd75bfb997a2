//! Actions of a script are single steps of work on a painting. You write them in its JSON.
//!
//! Samples are rows of numbers: `[seconds, x, y, pressure, tilt x, tilt y, twist]`. You may leave
//! out zeros at the end. We refuse duplicate keys in objects with free names.

use std::collections::BTreeMap;
use std::fmt;
use std::marker::PhantomData;
use std::ops::{Index, IndexMut};

use pigment::PigmentId;
use serde::de::{self, Deserializer, MapAccess, SeqAccess, Visitor};
use serde::ser::{SerializeMap, SerializeSeq, Serializer};
use serde::{Deserialize, Serialize};

use super::MAX_NAMES;
use crate::brush::StrokeTool;
use crate::document::{Lighting, Slots};
use crate::layer::{LayerRef, SLOTS};
use crate::optics::Gloss;
use crate::pose::Sample;
use crate::stroke::SampleDecimals;

/// Parts by volume of each pigment, by its name in the library or a short name of a
/// palette.
pub type Recipe = BTreeMap<String, f64>;

/// One action of a script.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase", deny_unknown_fields)]
pub enum Action {
    /// Adds paint to a brush. For a clean colour, wash the brush first.
    Load(Load),
    /// Moves a brush over a surface, to paint or to blend, scrape or erase wet paint.
    Stroke(Stroke),
    /// Moves a brush over a surface without lifting it at the end. A recording ends in this way if
    /// you kill its program within a stroke. We do not paint the end of its path, because painting
    /// is one sample behind, and the paint does not level.
    Cut(Stroke),
    /// Wipes paint off a brush.
    Wipe {
        /// Name of the brush.
        brush: String,
        /// Share of its paint that stays, 0 to 1.
        keep: f64,
    },
    /// Removes all paint from a brush.
    Wash {
        /// Name of the brush.
        brush: String,
    },
    /// Dries wet paint of the canvas, from the bottom up, into a new dry layer.
    Dry {
        /// Share of the wet paint that dries, above 0 to 1. 1 by default.
        #[serde(default = "whole")]
        fraction: f64,
    },
    /// Sets the pigments of the wet layer.
    Palette(PaletteSpec),
    /// Undoes the last action.
    Undo {},
    /// Does the last undone action again.
    Redo {},
    /// Sets the light.
    Light(Lighting),
    /// Sets the factor on the optical thickness of a dry layer.
    Opacity {
        /// The layer, which must be dry.
        layer: LayerRef,
        /// Factor from 0 (clear) over 1 (as painted) to 1000.
        value: f64,
    },
    /// Names a dry layer.
    Name {
        /// The layer, which must be dry.
        layer: LayerRef,
        /// One line of at most 80 characters. If you pass an empty one, you take the name away.
        name: String,
    },
    /// Shows or hides a dry layer, which keeps its opacity.
    Visible {
        /// The layer, which must be dry.
        layer: LayerRef,
        /// Whether it is shown.
        value: bool,
    },
    /// Moves a dry layer to another place among the dry layers.
    Order {
        /// The layer, which must be dry.
        layer: LayerRef,
        /// Its new place from 0, the lowest.
        to: usize,
    },
    /// Replaces a pigment of a layer by another.
    Swap {
        /// The layer, wet or dry.
        layer: LayerRef,
        /// Name of the pigment to replace.
        from: String,
        /// Name of the pigment that takes its place.
        to: String,
    },
    /// Merges two dry layers into one, which keeps the identity of the lower.
    Merge {
        /// One of the two, which must be dry.
        layer: LayerRef,
        /// The other layer. By default, this is the layer below.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        with: Option<LayerRef>,
    },
    /// Puts down a heap of paint, as from a tube.
    Squeeze(Squeeze),
    /// Removes all wet paint of a surface.
    Scrape {
        /// The surface. The canvas by default.
        #[serde(default, skip_serializing_if = "SurfaceId::is_canvas")]
        on: SurfaceId,
    },
    /// Covers cells of the canvas, or uncovers them. Paint does not get on or off covered cells.
    Mask(MaskChange),
    /// Sets the gloss of the binder.
    Gloss {
        /// Gloss of wet paint.
        wet: Gloss,
        /// Gloss of dry paint.
        dry: Gloss,
    },
    /// Sets the stiffness of the wet paint.
    Stiffness {
        /// 0 is stand oil, which levels after a stroke, 1 is putty. For example, tube paint lies
        /// between.
        value: f64,
    },
    /// Saves the painting (`.exr`) or its picture (`.png`).
    Save {
        /// Relative path of the file. It lies below a folder that you choose when you play the
        /// script.
        path: String,
    },
}

impl Action {
    /// Key of the action in a file, for example `stroke`.
    #[must_use]
    pub fn kind(&self) -> &'static str {
        match self {
            Self::Load(_) => "load",
            Self::Stroke(_) => "stroke",
            Self::Cut(_) => "cut",
            Self::Wipe { .. } => "wipe",
            Self::Wash { .. } => "wash",
            Self::Dry { .. } => "dry",
            Self::Palette(_) => "palette",
            Self::Undo {} => "undo",
            Self::Redo {} => "redo",
            Self::Light(_) => "light",
            Self::Opacity { .. } => "opacity",
            Self::Name { .. } => "name",
            Self::Visible { .. } => "visible",
            Self::Order { .. } => "order",
            Self::Swap { .. } => "swap",
            Self::Merge { .. } => "merge",
            Self::Squeeze(_) => "squeeze",
            Self::Scrape { .. } => "scrape",
            Self::Mask(_) => "mask",
            Self::Gloss { .. } => "gloss",
            Self::Stiffness { .. } => "stiffness",
            Self::Save { .. } => "save",
        }
    }

    /// Name of the brush that the action uses, if it uses one.
    #[must_use]
    pub fn brush(&self) -> Option<&str> {
        match self {
            Self::Load(Load { brush, .. })
            | Self::Stroke(Stroke { brush, .. })
            | Self::Cut(Stroke { brush, .. })
            | Self::Wipe { brush, .. }
            | Self::Wash { brush } => Some(brush),
            _ => None,
        }
    }

    /// The stroke, lifted or cut, if the action is one.
    #[must_use]
    pub fn stroke(&self) -> Option<&Stroke> {
        match self {
            Self::Stroke(stroke) | Self::Cut(stroke) => Some(stroke),
            _ => None,
        }
    }

    /// Like [`Action::brush`], to rename the brush.
    pub(crate) fn brush_mut(&mut self) -> Option<&mut String> {
        match self {
            Self::Load(Load { brush, .. })
            | Self::Stroke(Stroke { brush, .. })
            | Self::Cut(Stroke { brush, .. })
            | Self::Wipe { brush, .. }
            | Self::Wash { brush } => Some(brush),
            _ => None,
        }
    }
}

fn whole() -> f64 {
    1.0
}

/// The pigments that an action names.
#[derive(Debug, Clone, PartialEq)]
pub enum ActionPigments {
    /// The action names no pigment.
    None,
    /// Pigments and parts of a load or a heap, in the order of the library. Parts are
    /// above 0.
    Recipe(Vec<(PigmentId, f64)>),
    /// Pigments of a palette by slot.
    Palette(Slots),
    /// Pigments of a swap.
    Swap {
        /// Pigment to replace.
        from: PigmentId,
        /// Pigment that takes its place.
        to: PigmentId,
    },
}

/// Paint that a brush takes up.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Load {
    /// Name of the brush.
    pub brush: String,
    /// Parts of each pigment.
    #[serde(deserialize_with = "distinct_keys")]
    pub recipe: Recipe,
    /// Share of clear vehicle in the paint, 0 to 1. 0 by default.
    #[serde(default)]
    pub vehicle: f64,
    /// Height of the paint on the head in mm.
    pub amount_mm: f64,
}

/// A heap of paint, as squeezed from a tube.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Squeeze {
    /// The surface. The canvas by default.
    #[serde(default, skip_serializing_if = "SurfaceId::is_canvas")]
    pub on: SurfaceId,
    /// Parts of each pigment.
    #[serde(deserialize_with = "distinct_keys")]
    pub recipe: Recipe,
    /// Share of clear vehicle in the paint, 0 to 1. 0 by default.
    #[serde(default)]
    pub vehicle: f64,
    /// Distance of the heap's centre from the left edge of the surface, in mm.
    pub x_mm: f64,
    /// Distance of the heap's centre from the upper edge, in mm.
    pub y_mm: f64,
    /// Volume in cubic millimetres.
    pub volume_mm3: f64,
}

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
    /// Masks every cell that has no paint of this layer now.
    Layer(LayerRef),
    /// Masks every cell that has no paint now. Cells with wet or dry paint stay open.
    Painted {},
    /// Exchanges what is covered and what is open. Always true.
    Inverse(bool),
    /// Takes the mask off.
    Clear {},
}

/// Strength of blending and erasing where a script names none.
const STRENGTH: f64 = 0.5;

/// A stroke of a brush.
///
/// In a script the tool is `"tool": "blend"`, `"scrape"` or `"erase"`, left out for painting.
/// Blending and erasing have a `"strength"` above 0 to 1, 0.5 by default. Scraping has a
/// `"height_mm"` of 0 to 10 over the ground, 0 by default.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(try_from = "Keys", into = "Keys")]
pub struct Stroke {
    /// Name of the brush.
    pub brush: String,
    /// The surface. The canvas by default.
    pub on: SurfaceId,
    /// The tool that you use the brush as. By default it paints.
    pub tool: StrokeTool,
    /// Samples of the pen in order of time.
    pub samples: Vec<Sample>,
}

#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
enum ToolName {
    #[default]
    Paint,
    Blend,
    Scrape,
    Erase,
}

impl ToolName {
    fn is_paint(&self) -> bool {
        *self == Self::Paint
    }
}

/// The keys of a stroke in a file.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Keys {
    brush: String,
    #[serde(default, skip_serializing_if = "SurfaceId::is_canvas")]
    on: SurfaceId,
    #[serde(default, skip_serializing_if = "ToolName::is_paint")]
    tool: ToolName,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    strength: Option<f64>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    height_mm: Option<f64>,
    #[serde(serialize_with = "write_samples", deserialize_with = "read_samples")]
    samples: Vec<Sample>,
}

impl TryFrom<Keys> for Stroke {
    type Error = &'static str;

    fn try_from(keys: Keys) -> Result<Self, Self::Error> {
        let Keys { brush, on, tool, strength, height_mm, samples } = keys;
        let stray = match tool {
            ToolName::Paint => strength.or(height_mm),
            ToolName::Blend | ToolName::Erase => height_mm,
            ToolName::Scrape => strength,
        };
        if stray.is_some() {
            return Err("`strength` belongs to the tools blend and erase, `height_mm` to scrape");
        }
        let strength = strength.unwrap_or(STRENGTH);
        let tool = match tool {
            ToolName::Paint => StrokeTool::Paint,
            ToolName::Blend => StrokeTool::Blend { strength },
            ToolName::Scrape => StrokeTool::Scrape { height_mm: height_mm.unwrap_or(0.0) },
            ToolName::Erase => StrokeTool::Erase { strength },
        };
        Ok(Self { brush, on, tool, samples })
    }
}

impl From<Stroke> for Keys {
    fn from(Stroke { brush, on, tool, samples }: Stroke) -> Self {
        let (tool, strength, height_mm) = match tool {
            StrokeTool::Paint => (ToolName::Paint, None, None),
            StrokeTool::Blend { strength } => (ToolName::Blend, Some(strength), None),
            StrokeTool::Scrape { height_mm } => (ToolName::Scrape, None, Some(height_mm)),
            StrokeTool::Erase { strength } => (ToolName::Erase, Some(strength), None),
        };
        Self { brush, on, tool, strength, height_mm, samples }
    }
}

/// A surface of a painting session.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum SurfaceId {
    /// The canvas that is painted on.
    #[default]
    Canvas,
    /// The palette that paint is mixed on.
    Palette,
}

impl SurfaceId {
    /// Both surfaces, the canvas first.
    pub const ALL: [Self; 2] = [Self::Canvas, Self::Palette];

    /// Whether this is the canvas.
    #[must_use]
    pub fn is_canvas(&self) -> bool {
        *self == Self::Canvas
    }
}

/// One value for each surface.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct PerSurface<T> {
    /// Value of the canvas.
    pub canvas: T,
    /// Value of the palette.
    pub palette: T,
}

impl<T> PerSurface<T> {
    /// Calls `of` for each surface and holds the results.
    #[must_use]
    pub fn from_fn(mut of: impl FnMut(SurfaceId) -> T) -> Self {
        Self { canvas: of(SurfaceId::Canvas), palette: of(SurfaceId::Palette) }
    }

    /// References to both values.
    pub fn iter(&self) -> impl Iterator<Item = &T> {
        [&self.canvas, &self.palette].into_iter()
    }
}

impl<T> Index<SurfaceId> for PerSurface<T> {
    type Output = T;

    fn index(&self, surface: SurfaceId) -> &T {
        match surface {
            SurfaceId::Canvas => &self.canvas,
            SurfaceId::Palette => &self.palette,
        }
    }
}

impl<T> IndexMut<SurfaceId> for PerSurface<T> {
    fn index_mut(&mut self, surface: SurfaceId) -> &mut T {
        match surface {
            SurfaceId::Canvas => &mut self.canvas,
            SurfaceId::Palette => &mut self.palette,
        }
    }
}

/// Fewest numbers of a row: seconds, x, y, pressure.
const SHORTEST: usize = 4;
/// Most numbers of a row: also tilt x, tilt y and twist.
const LONGEST: usize = 7;

/// The numbers of a sample in the order of a row.
pub(super) fn numbers(sample: &Sample) -> [f64; LONGEST] {
    let Sample { seconds, x_mm, y_mm, pressure, tilt_x_deg, tilt_y_deg, twist_deg } = *sample;
    [seconds, x_mm, y_mm, pressure, tilt_x_deg, tilt_y_deg, twist_deg]
}

struct Row(Sample);

impl Serialize for Row {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let numbers = numbers(&SampleDecimals::RECORDING.round(&self.0));
        let used = numbers.iter().rposition(|number| *number != 0.0).map_or(0, |last| last + 1);
        numbers[..used.max(SHORTEST)].serialize(serializer)
    }
}

impl<'de> Deserialize<'de> for Row {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Numbers;

        impl<'de> Visitor<'de> for Numbers {
            type Value = Row;

            fn expecting(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
                formatter
                    .write_str("4 to 7 numbers: seconds, x, y, pressure, tilt x, tilt y, twist")
            }

            fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<Row, A::Error> {
                let mut numbers = [0.0; LONGEST];
                let mut count = 0;
                while let Some(number) = list.next_element::<f64>()? {
                    match numbers.get_mut(count) {
                        Some(place) => *place = number,
                        None => return Err(de::Error::invalid_length(count + 1, &self)),
                    }
                    count += 1;
                }
                if count < SHORTEST {
                    return Err(de::Error::invalid_length(count, &self));
                }
                let [seconds, x_mm, y_mm, pressure, tilt_x_deg, tilt_y_deg, twist_deg] = numbers;
                Ok(Row(Sample { seconds, x_mm, y_mm, pressure, tilt_x_deg, tilt_y_deg, twist_deg }))
            }
        }

        deserializer.deserialize_seq(Numbers)
    }
}

fn write_samples<S: Serializer>(samples: &[Sample], serializer: S) -> Result<S::Ok, S::Error> {
    let mut list = serializer.serialize_seq(Some(samples.len()))?;
    for sample in samples {
        list.serialize_element(&Row(*sample))?;
    }
    list.end()
}

fn read_samples<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Vec<Sample>, D::Error> {
    struct Samples;

    impl<'de> Visitor<'de> for Samples {
        type Value = Vec<Sample>;

        fn expecting(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
            formatter.write_str("a list of samples")
        }

        fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<Vec<Sample>, A::Error> {
            let mut samples = Vec::new();
            while let Some(Row(sample)) = list.next_element()? {
                samples.push(sample);
            }
            Ok(samples)
        }
    }

    deserializer.deserialize_seq(Samples)
}

/// Up to eight pigments in the order of their slots: a list of names, or an object of
/// short names (`{"W": "Zinc White"}`).
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct PaletteSpec {
    /// Short name, where there is one, and name in the library.
    pub pigments: Vec<(Option<String>, String)>,
}

impl PaletteSpec {
    /// A palette of pigments by their names in the library, without short names.
    pub fn from_names<'a>(names: impl IntoIterator<Item = &'a str>) -> Self {
        Self { pigments: names.into_iter().map(|name| (None, name.to_owned())).collect() }
    }

    /// Library name of the pigment with this short name.
    #[must_use]
    pub fn library_name(&self, short: &str) -> Option<&str> {
        let found = self.pigments.iter().find(|(own, _)| own.as_deref() == Some(short));
        found.map(|(_, name)| name.as_str())
    }
}

impl Serialize for PaletteSpec {
    /// Writes a list, unless every pigment has a short name.
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let short: Option<Vec<&String>> =
            self.pigments.iter().map(|(short, _)| short.as_ref()).collect();
        match short {
            Some(short) if !short.is_empty() => {
                let mut map = serializer.serialize_map(Some(short.len()))?;
                for (short, (_, name)) in short.into_iter().zip(&self.pigments) {
                    map.serialize_entry(short, name)?;
                }
                map.end()
            }
            _ => {
                let mut list = serializer.serialize_seq(Some(self.pigments.len()))?;
                for (_, name) in &self.pigments {
                    list.serialize_element(name)?;
                }
                list.end()
            }
        }
    }
}

impl<'de> Deserialize<'de> for PaletteSpec {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Pigments;

        fn push<E: de::Error>(
            palette: &mut PaletteSpec,
            short: Option<String>,
            name: String,
        ) -> Result<(), E> {
            if palette.pigments.len() == SLOTS {
                return Err(E::custom(format!("more than {SLOTS} pigments, at `{name}`")));
            }
            if short.as_ref().is_some_and(|short| palette.library_name(short).is_some()) {
                let short = short.unwrap_or_default();
                return Err(E::custom(format!("duplicate key `{short}`")));
            }
            palette.pigments.push((short, name));
            Ok(())
        }

        impl<'de> Visitor<'de> for Pigments {
            type Value = PaletteSpec;

            fn expecting(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
                write!(formatter, "a list or an object of up to {SLOTS} pigments")
            }

            fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<PaletteSpec, A::Error> {
                let mut palette = PaletteSpec::default();
                while let Some(name) = list.next_element()? {
                    push(&mut palette, None, name)?;
                }
                Ok(palette)
            }

            fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<PaletteSpec, A::Error> {
                let mut palette = PaletteSpec::default();
                while let Some((short, name)) = map.next_entry()? {
                    push(&mut palette, Some(short), name)?;
                }
                Ok(palette)
            }
        }

        deserializer.deserialize_any(Pigments)
    }
}

/// Deserializes an object and refuses duplicate keys. A plain map would silently keep the last of
/// them. At most [`MAX_NAMES`] keys.
pub(super) fn distinct_keys<'de, T: Deserialize<'de>, D: Deserializer<'de>>(
    deserializer: D,
) -> Result<BTreeMap<String, T>, D::Error> {
    struct Entries<T>(PhantomData<T>);

    impl<'de, T: Deserialize<'de>> Visitor<'de> for Entries<T> {
        type Value = BTreeMap<String, T>;

        fn expecting(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
            formatter.write_str("an object")
        }

        fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Self::Value, A::Error> {
            let mut entries = BTreeMap::new();
            while let Some(key) = map.next_key::<String>()? {
                if entries.contains_key(&key) {
                    return Err(de::Error::custom(format!("duplicate key `{key}`")));
                }
                if entries.len() == MAX_NAMES {
                    return Err(de::Error::custom(format!(
                        "more than {MAX_NAMES} keys, at `{key}`"
                    )));
                }
                entries.insert(key, map.next_value()?);
            }
            Ok(entries)
        }
    }

    deserializer.deserialize_map(Entries(PhantomData))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(keys: &str) -> Result<Stroke, String> {
        let text = format!("{{\"brush\": \"a\", {keys}\"samples\": [[0, 1, 2, 0.5]]}}");
        serde_json::from_str(&text).map_err(|error| error.to_string())
    }

    #[test]
    fn a_stroke_without_a_tool_paints_and_is_written_as_before() {
        let stroke = read("").unwrap();
        assert_eq!(stroke.tool, StrokeTool::Paint);
        let text = serde_json::to_string(&stroke).unwrap();
        assert_eq!(text, r#"{"brush":"a","samples":[[0.0,1.0,2.0,0.5]]}"#);
    }

    #[test]
    fn tools_are_read_with_their_numbers_and_defaults_and_written_whole() {
        for (keys, tool) in [
            (r#""tool": "erase", "#, StrokeTool::Erase { strength: 0.5 }),
            (r#""tool": "erase", "strength": 1, "#, StrokeTool::Erase { strength: 1.0 }),
            (r#""tool": "blend", "strength": 0.2, "#, StrokeTool::Blend { strength: 0.2 }),
            (r#""tool": "scrape", "#, StrokeTool::Scrape { height_mm: 0.0 }),
            (r#""tool": "scrape", "height_mm": 0.1, "#, StrokeTool::Scrape { height_mm: 0.1 }),
            (r#""tool": "paint", "#, StrokeTool::Paint),
        ] {
            let stroke = read(keys).unwrap();
            assert_eq!(stroke.tool, tool);
            let text = serde_json::to_string(&stroke).unwrap();
            assert_eq!(serde_json::from_str::<Stroke>(&text).unwrap(), stroke);
        }
    }

    #[test]
    fn unknown_tools_and_numbers_of_other_tools_are_refused() {
        for (keys, reason) in [
            (r#""tool": "smudge", "#, "unknown variant `smudge`, expected one of `paint`"),
            (r#""strength": 0.5, "#, "`strength` belongs to the tools blend and erase"),
            (r#""tool": "erase", "height_mm": 0, "#, "`height_mm` to scrape"),
            (r#""tool": "scrape", "strength": 1, "#, "`strength` belongs to"),
            (r#""tool": "erase", "force": 1, "#, "unknown field `force`"),
        ] {
            let error = read(keys).unwrap_err();
            assert!(error.contains(reason), "{error}");
        }
    }
}
