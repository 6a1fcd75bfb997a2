//! Actions on the stack of dry layers.

use crate::painting::{LayerRef, Painting, PaintingError};
use crate::strokes::Action;

/// Names, shows, moves or merges dry layers. Returns whether something was done.
pub(super) fn change_stack(canvas: &mut Painting, action: &Action) -> Result<bool, PaintingError> {
    match action {
        Action::Name { layer, name } => canvas.name_layer(*layer, name)?,
        Action::Visible { layer, value } => canvas.show_layer(*layer, *value)?,
        Action::Order { layer, to } => return canvas.move_layer(*layer, *to),
        Action::Merge { layer, with: Some(with) } => canvas.merge(*layer, *with)?,
        Action::Merge { layer, with: None } => canvas.merge(*layer, below(canvas, *layer)?)?,
        other => unreachable!("`{}` is applied elsewhere", other.kind()),
    }
    Ok(true)
}

/// The dry layer below another.
fn below(canvas: &Painting, layer: LayerRef) -> Result<LayerRef, PaintingError> {
    match canvas.dry_index(layer)? {
        Some(0) => Err(PaintingError::NothingBelow),
        Some(index) => Ok(LayerRef::Dry(index - 1)),
        None => Err(PaintingError::WetLayer { what: "layer to merge with" }),
    }
}
