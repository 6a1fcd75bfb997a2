//! One brush that a painter keeps.

use paint::strokes::{BrushSpec, Load, Recipe};
use serde::Serialize;

use super::error::BrushFileError;
use super::options::BrushOptions;
use super::reading::Object;

/// Most letters of a name.
const LONGEST_NAME: usize = 80;

/// Paint that a kept brush takes up when it is used.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PresetLoad {
    /// Parts of each pigment by its name. Without any, only the share of medium and the height of
    /// the next loads are set.
    pub recipe: Recipe,
    /// Share of clear medium, 0 to 1.
    pub vehicle: f64,
    /// Height of the paint on the head in mm, 0 to 10.
    pub amount_mm: f64,
}

impl PresetLoad {
    /// The action that loads the brush of this name; `None` if no pigment is kept.
    #[must_use]
    pub fn for_brush(&self, brush: &str) -> Option<Load> {
        let Self { recipe, vehicle, amount_mm } = self;
        (!recipe.is_empty()).then(|| Load {
            brush: brush.to_owned(),
            recipe: recipe.clone(),
            vehicle: *vehicle,
            amount_mm: *amount_mm,
        })
    }
}

/// A brush that is kept under a name.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct BrushPreset {
    /// Name of the brush, 1 to 80 letters, which is also that of the brush in a painting.
    pub name: String,
    /// Shape and size of its head.
    pub brush: BrushSpec,
    /// How a pen leads it.
    #[serde(skip_serializing_if = "is_default")]
    pub options: BrushOptions,
    /// Paint that it takes up when it is used.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub load: Option<PresetLoad>,
}

fn is_default(options: &BrushOptions) -> bool {
    *options == BrushOptions::default()
}

/// A name as it is kept: trimmed, without control characters, at most 80 letters; `None` if nothing
/// is left.
pub(super) fn proper_name(typed: &str) -> Option<String> {
    let name: String = typed.trim().chars().filter(|letter| !letter.is_control()).collect();
    let name: String = name.chars().take(LONGEST_NAME).collect();
    (!name.is_empty()).then_some(name)
}

impl BrushPreset {
    /// Reads a brush of a file.
    ///
    /// # Errors
    /// [`BrushFileError`] for unknown or missing keys and values out of range.
    pub(super) fn read(mut object: Object<'_>) -> Result<Self, BrushFileError> {
        let name: String = object.need("name")?;
        if proper_name(&name).as_ref() != Some(&name) {
            return Err(object.fault_at("name", "must have 1 to 80 letters"));
        }
        let brush: BrushSpec = object.need("brush")?;
        if !(0.2..=100.0).contains(&brush.size_mm) {
            return Err(object.fault_at("brush.size_mm", "is not within 0.2 to 100"));
        }
        let options = object.take_object("options")?;
        let options = options.map_or_else(|| Ok(BrushOptions::default()), BrushOptions::read)?;
        let load = object.take_object("load")?.map(read_load).transpose()?;
        object.end()?;
        Ok(Self { name, brush, options, load })
    }
}

fn read_load(mut object: Object<'_>) -> Result<PresetLoad, BrushFileError> {
    let load = PresetLoad {
        recipe: object.need("recipe")?,
        vehicle: object.need("vehicle")?,
        amount_mm: object.need("amount_mm")?,
    };
    if let Some((name, _)) =
        load.recipe.iter().find(|(_, part)| !(part.is_finite() && **part > 0.0))
    {
        return Err(object.fault_at("recipe", format!("the part of {name} is not above 0")));
    }
    if !(0.0..=1.0).contains(&load.vehicle) {
        return Err(object.fault_at("vehicle", "is not within 0 to 1"));
    }
    if !(load.amount_mm > 0.0 && load.amount_mm <= 10.0) {
        return Err(object.fault_at("amount_mm", "is not above 0 and at most 10"));
    }
    object.end()?;
    Ok(load)
}
