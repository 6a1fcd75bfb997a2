//! The description of a painting in its file. We write it as JSON in ASCII in attributes of
//! OpenEXR.
//!
//! Attribute `impasto` describes the painting. Each dry layer has an attribute with its identity,
//! name and visibility. Other programs and older versions do not touch this attribute. Palette and
//! brushes are a file of their own in an attribute of part `wet`.

use exr::meta::attribute::{AttributeValue, Text};
use exr::meta::header::Header;
use pigment::library::PigmentLibrary;
use serde::{Deserialize, Serialize};
use serde_json::Value;

use super::PaintingFileError;
use super::channels::{
    LAYER_CHANNELS, PigmentChannel, WET, brush_part, channels_of_slots, dry_part, skin_part,
    slots_of_channels,
};
use crate::document::{Document, DryLayer, LayerId, Lighting, Medium, Slots};
use crate::layer::layer_name_violation;
use crate::optics::Gloss;
use crate::strokes::{BrushSpec, KeptBrush, MAX_NAMES, SurfaceId};

const FORMAT: &str = "impasto-painting";
/// Version of files with a skin. Programs that only know version 1 refuse them.
const VERSION: u64 = 2;
/// Version of files without a skin.
const VERSION_WITHOUT_SKIN: u64 = 1;

/// Cell widths allowed, in mm. Within this range 32-bit floats in mm can represent quanta.
const CELL_MM: std::ops::RangeInclusive<f64> = 1e-4..=100.0;

#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct FileHeader {
    format: String,
    version: u64,
    pub(super) title: String,
    pub(super) cell_mm: f64,
    pub(super) width: usize,
    pub(super) height: usize,
    pub(super) ground: GroundHeader,
    pub(super) medium: Medium,
    pub(super) lighting: Lighting,
    /// The wet layer, then the dry layers from the lowest.
    pub(super) layers: Vec<LayerHeader>,
    /// Brushes that are stored with a palette. For a canvas this is empty.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub(super) brushes: Vec<BrushHeader>,
    library: Value,
}

/// A brush, and the part with its paint, if it has any.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct BrushHeader {
    pub(super) name: String,
    pub(super) spec: BrushSpec,
    pub(super) at: SurfaceId,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) paint: Option<BrushPaintHeader>,
}

#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct BrushPaintHeader {
    pub(super) part: String,
    pub(super) width: usize,
    pub(super) height: usize,
    pub(super) pigments: Vec<PigmentChannel>,
}

/// A part with paint as the header describes it.
#[derive(Debug, Clone, Copy)]
pub(super) struct PaintHeader<'a> {
    pub(super) part: &'a str,
    /// Number of columns and rows of cells that the window of the part must fit into.
    pub(super) size: (usize, usize),
    pub(super) pigments: &'a [PigmentChannel],
}

#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct GroundHeader {
    pub(super) name: String,
    pub(super) reflectance: Vec<f64>,
    pub(super) gloss: Gloss,
}

#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct LayerHeader {
    pub(super) part: String,
    pub(super) opacity: f64,
    pub(super) pigments: Vec<PigmentChannel>,
    /// Part with the paint of the skin, if the layer has one. It has the same channels as `part`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) skin: Option<String>,
}

impl FileHeader {
    /// All parts with paint: the layers, then the brushes, then the skins of the layers.
    pub(super) fn paints(&self) -> Vec<PaintHeader<'_>> {
        let canvas = (self.width, self.height);
        let layers = self.layers.iter().map(|layer| PaintHeader {
            part: &layer.part,
            size: canvas,
            pigments: &layer.pigments,
        });
        let brushes = self.brushes.iter().filter_map(|brush| brush.paint.as_ref());
        let brushes = brushes.map(|paint| PaintHeader {
            part: &paint.part,
            size: (paint.width, paint.height),
            pigments: &paint.pigments,
        });
        let skins = self.layers.iter().filter_map(|layer| {
            let part = layer.skin.as_deref()?;
            Some(PaintHeader { part, size: canvas, pigments: &layer.pigments })
        });
        layers.chain(brushes).chain(skins).collect()
    }

    /// Description of `document` and of the `brushes` beside it.
    pub(super) fn of(
        document: &Document,
        brushes: &[KeptBrush],
    ) -> Result<Self, PaintingFileError> {
        let dry = document.dry.iter().enumerate();
        let dry =
            dry.map(|(index, layer)| (dry_part(index), layer.opacity, &layer.slots, &layer.paint));
        let wet = (WET.to_owned(), 1.0, &document.slots, &document.wet);
        let layers = std::iter::once(wet).chain(dry);
        let layers = layers.map(|(part, opacity, slots, paint)| {
            let pigments = channels_of_slots(&document.library, slots, &LAYER_CHANNELS);
            let pigments = pigments.ok_or_else(|| {
                let count = document.library.pigments.len();
                PaintingFileError::unwritable(format!(
                    "part `{part}` has a pigment beyond the library's {count}"
                ))
            })?;
            let skin = paint.painted_skin().map(|_| skin_part(&part));
            Ok::<_, PaintingFileError>(LayerHeader { part, opacity, pigments, skin })
        });
        let layers = layers.collect::<Result<Vec<_>, _>>()?;
        let skins = layers.iter().any(|layer| layer.skin.is_some());
        let brushes = brushes.iter().enumerate().map(|(index, brush)| {
            let paint = brush.paint.as_ref().map(|paint| BrushPaintHeader {
                part: brush_part(index),
                width: paint.width(),
                height: paint.height(),
                pigments: channels_of_slots(&document.library, &document.slots, &LAYER_CHANNELS)
                    .unwrap_or_default(),
            });
            let KeptBrush { name, spec, at, .. } = brush;
            BrushHeader { name: name.clone(), spec: spec.clone(), at: *at, paint }
        });
        let library = serde_json::from_str(&document.library.to_json());
        let header = Self {
            format: FORMAT.to_owned(),
            version: if skins { VERSION } else { VERSION_WITHOUT_SKIN },
            title: document.title.clone(),
            cell_mm: document.cell_mm,
            width: document.ground.height.width(),
            height: document.ground.height.height(),
            ground: GroundHeader {
                name: document.ground.name.clone(),
                reflectance: document.ground.reflectance.clone(),
                gloss: document.ground.gloss,
            },
            medium: document.medium.clone(),
            lighting: document.lighting.clone(),
            layers,
            brushes: brushes.collect(),
            library: library.map_err(|error| PaintingFileError::unwritable(error.to_string()))?,
        };
        // JSON cannot express NaN and infinity. We find such numbers by parsing the text again.
        match Self::from_json("", &header.to_json()?) {
            Ok((back, library)) if back == header && library == document.library => Ok(header),
            Ok(_) => Err(PaintingFileError::unwritable(
                "its header does not come back as it was".to_owned(),
            )),
            Err(PaintingFileError::Header { reason, .. }) => {
                Err(PaintingFileError::unwritable(reason))
            }
            Err(error) => Err(PaintingFileError::unwritable(error.to_string())),
        }
    }

    pub(super) fn to_json(&self) -> Result<String, PaintingFileError> {
        ascii_json(self).map_err(|error| PaintingFileError::Unwritable(error.to_string()))
    }

    /// Parses and checks a description. You get it with the library that it holds.
    pub(super) fn from_json(
        file: &str,
        json: &str,
    ) -> Result<(Self, PigmentLibrary), PaintingFileError> {
        let value: Value = serde_json::from_str(json)
            .map_err(|error| PaintingFileError::header(file, error.to_string()))?;
        if value["format"] != FORMAT {
            let reason = format!("`format` must be \"{FORMAT}\", found `{}`", value["format"]);
            return Err(PaintingFileError::Format { file: file.to_owned(), reason });
        }
        if value["version"] != VERSION && value["version"] != VERSION_WITHOUT_SKIN {
            let found = value["version"].to_string();
            return Err(PaintingFileError::Version {
                file: file.to_owned(),
                found,
                newest: VERSION,
            });
        }
        let header: Self = serde_json::from_value(value)
            .map_err(|error| PaintingFileError::header(file, error.to_string()))?;
        let library =
            PigmentLibrary::from_json(&format!("{file}: library"), &header.library.to_string())?;
        header.check(&library).map_err(|reason| PaintingFileError::header(file, reason))?;
        Ok((header, library))
    }

    fn check(&self, library: &PigmentLibrary) -> Result<(), String> {
        if !CELL_MM.contains(&self.cell_mm) {
            return Err(format!("cell_mm is 0.0001 to 100, found `{}`", self.cell_mm));
        }
        if self.width == 0 || self.height == 0 {
            return Err(format!("a canvas has cells, found `{} x {}`", self.width, self.height));
        }
        let found = self.ground.reflectance.len();
        let wanted = library.grid.count();
        if found != wanted {
            return Err(format!(
                "the ground has `{found}` reflectances for the library's {wanted} wavelengths"
            ));
        }
        for (index, layer) in self.layers.iter().enumerate() {
            let wanted = index.checked_sub(1).map_or_else(|| WET.to_owned(), dry_part);
            if layer.part != wanted {
                return Err(format!("layer {index} is `{wanted}`, found `{}`", layer.part));
            }
            if !(0.0..=1e6).contains(&layer.opacity) {
                let part = &layer.part;
                let found = layer.opacity;
                return Err(format!("opacity of `{part}` is 0 to 1000000, found `{found}`"));
            }
            layer.slots(library)?;
            if let Some(skin) = layer.skin.as_ref().filter(|skin| **skin != skin_part(&wanted)) {
                return Err(format!("the skin of `{wanted}` is its part `.skin`, found `{skin}`"));
            }
        }
        if self.brushes.len() > MAX_NAMES {
            return Err(format!("at most {MAX_NAMES} brushes, found `{}`", self.brushes.len()));
        }
        for (index, brush) in self.brushes.iter().enumerate() {
            let Some(paint) = &brush.paint else { continue };
            if paint.part != brush_part(index) || paint.width == 0 || paint.height == 0 {
                return Err(format!("brush `{}` has no part with cells of its own", brush.name));
            }
            // The paint on a brush has the slots of the wet layer.
            let slots = slots_of_channels(&paint.pigments, library, &LAYER_CHANNELS)?;
            if Some(slots) != self.layers.first().and_then(|wet| wet.slots(library).ok()) {
                return Err(format!("brush `{}` has other pigments than the palette", brush.name));
            }
        }
        if self.layers.is_empty() { Err("no layers".to_owned()) } else { Ok(()) }
    }
}

impl LayerHeader {
    /// Pigments of the layer by slot.
    pub(super) fn slots(&self, library: &PigmentLibrary) -> Result<Slots, String> {
        slots_of_channels(&self.pigments, library, &LAYER_CHANNELS)
            .map_err(|reason| format!("layer `{}`: {reason}", self.part))
    }
}

/// Attribute of the part of a dry layer.
pub(super) const LAYER_ATTRIBUTE: &str = "impasto.layer";

#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub(super) struct LayerAttribute {
    pub(super) id: LayerId,
    /// Identity of the next layer of the painting.
    pub(super) next: LayerId,
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub(super) name: String,
    #[serde(default = "shown", skip_serializing_if = "is_shown")]
    pub(super) visible: bool,
}

fn shown() -> bool {
    true
}

#[expect(clippy::trivially_copy_pass_by_ref, reason = "serde passes references")]
fn is_shown(visible: &bool) -> bool {
    *visible
}

impl LayerAttribute {
    /// Description of `layer` in a painting whose next layer has the identity `next`.
    pub(super) fn of(layer: &DryLayer, next: LayerId) -> Self {
        Self { id: layer.id, next, name: layer.name.clone(), visible: layer.visible }
    }

    pub(super) fn to_json(&self) -> Result<String, PaintingFileError> {
        if let Some(wanted) = layer_name_violation(&self.name) {
            let reason = format!("layer {} has no {wanted}", self.id);
            return Err(PaintingFileError::Unwritable(reason));
        }
        ascii_json(self).map_err(|error| PaintingFileError::Unwritable(error.to_string()))
    }

    /// Description of the layer at `index`, from 0. `part` is the part of the file that holds it.
    /// If a file does not have the attribute, the layer is visible, does not have a name, and has
    /// its place as identity.
    pub(super) fn from_part(
        file: &str,
        part: &Header,
        name: &str,
        index: usize,
    ) -> Result<Self, PaintingFileError> {
        let fault = |reason: String| PaintingFileError::Part {
            file: file.to_owned(),
            part: name.to_owned(),
            reason: format!("has a malformed attribute `{LAYER_ATTRIBUTE}`: {reason}"),
        };
        let id = LayerId::by_place(index);
        match part.own_attributes.other.get(&Text::from(LAYER_ATTRIBUTE)) {
            None => Ok(Self { id, next: id.next(), name: String::new(), visible: true }),
            Some(AttributeValue::Text(text)) => {
                let text: String = text.chars().collect();
                let found: Self =
                    serde_json::from_str(&text).map_err(|error| fault(error.to_string()))?;
                match layer_name_violation(&found.name) {
                    Some(wanted) => Err(fault(format!("expected {wanted}"))),
                    None => Ok(found),
                }
            }
            Some(_) => Err(fault("it is not text".to_owned())),
        }
    }
}

/// Attribute of part `wet`. It holds the bytes of the file of palette and brushes.
pub(super) const TABLE_ATTRIBUTE: &str = "impasto.table";

/// Type of this attribute. Programs that do not know it keep its bytes or drop them.
const KIND: &str = "impasto-table";

/// The attribute with these bytes.
pub(super) fn table_attribute(bytes: Vec<u8>) -> AttributeValue {
    AttributeValue::Custom { kind: Text::from(KIND), bytes: bytes.into() }
}

/// Bytes of the file of palette and brushes, if you find it in one of the parts.
pub(super) fn table_bytes(parts: &[Header]) -> Option<&[u8]> {
    let key = Text::from(TABLE_ATTRIBUTE);
    parts.iter().find_map(|part| match part.own_attributes.other.get(&key) {
        Some(AttributeValue::Custom { kind, bytes }) if kind.eq(KIND) => Some(&bytes[..]),
        _ => None,
    })
}

/// Attribute of files of impasto that holds their description.
pub const ATTRIBUTE: &str = "impasto";

/// Encodes a value as JSON in ASCII: other characters are escaped.
///
/// # Errors
/// If serialisation fails, for example for a map with keys that are not texts.
pub fn ascii_json(value: &impl Serialize) -> Result<String, serde_json::Error> {
    let text = serde_json::to_string(value)?;
    let mut ascii = String::with_capacity(text.len());
    for letter in text.chars() {
        if letter.is_ascii() {
            ascii.push(letter);
        } else {
            for unit in letter.encode_utf16(&mut [0; 2]) {
                ascii.push_str(&format!("\\u{unit:04x}"));
            }
        }
    }
    Ok(ascii)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn letters_beyond_ascii_come_back() {
        let words = ["R\u{f6}tel", "\u{1f3a8} 2"];
        let json = ascii_json(&words).unwrap();
        assert_eq!(json, r#"["R\u00f6tel","\ud83c\udfa8 2"]"#);
        let back: Vec<String> = serde_json::from_str(&json).unwrap();
        assert_eq!(back, words);
    }
}
