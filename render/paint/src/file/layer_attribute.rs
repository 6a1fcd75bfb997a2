//! Identity, name and visibility of a layer, in an attribute of its part that other programs and
//! older versions leave alone: JSON in ASCII.

use exr::meta::attribute::{AttributeValue, Text};
use exr::meta::header::Header;
use serde::{Deserialize, Serialize};

use super::ascii::ascii_json;
use super::error::PaintingFileError;
use crate::document::{DryLayer, LayerId};
use crate::dry_layer::layer_name_violation;

/// Attribute of the part of a dry layer.
pub(super) const LAYER_ATTRIBUTE: &str = "impasto.layer";

/// Content of the attribute.
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

    /// Encodes the description.
    pub(super) fn to_json(&self) -> Result<String, PaintingFileError> {
        if let Some(wanted) = layer_name_violation(&self.name) {
            let reason = format!("layer {} has no {wanted}", self.id);
            return Err(PaintingFileError::Unwritable { reason });
        }
        ascii_json(self)
            .map_err(|error| PaintingFileError::Unwritable { reason: error.to_string() })
    }

    /// Description of the layer at `index`, from 0, whose part is `part`. A file without the
    /// attribute has an unnamed, visible layer, whose identity is its place.
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
            Some(_) => Err(fault("it is no text".to_owned())),
        }
    }
}
