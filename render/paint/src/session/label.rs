//! Labels of actions for the history.

use pigment::PigmentId;
use pigment::library::PigmentLibrary;

use crate::strokes::{Action, ActionPigments, LayerRef, SurfaceId};

/// Label of an action with the pigments that it names.
pub(super) fn label(
    action: &Action,
    pigments: &ActionPigments,
    library: &PigmentLibrary,
) -> String {
    let name = |pigment: PigmentId| library[pigment].name.as_str();
    let on = |surface: SurfaceId| if surface.is_canvas() { "" } else { " on the palette" };
    match action {
        Action::Stroke(stroke) => format!("stroke{}, {}", on(stroke.on), stroke.brush),
        Action::Dry { fraction } if *fraction == 1.0 => "dry all".to_owned(),
        Action::Dry { fraction } => format!("dry {}", percent(*fraction)),
        Action::Palette(_) => "other pigments".to_owned(),
        Action::Light(lighting) => format!("light {}", lighting.illuminant),
        Action::Gloss { .. } => "gloss".to_owned(),
        Action::Stiffness { value } => format!("stiffness {value}"),
        Action::Opacity { layer, value } => {
            format!("{} of {}", percent(*value), layer_name(*layer))
        }
        Action::Swap { layer, .. } => match pigments {
            ActionPigments::Swap { from, to } => {
                format!("{} for {}, {}", name(*to), name(*from), layer_name(*layer))
            }
            _ => "swap".to_owned(),
        },
        Action::Merge { layer } => format!("merge layer {layer} with the one below"),
        Action::Squeeze(squeeze) => {
            let paint = match pigments {
                ActionPigments::Recipe(parts) => match parts.as_slice() {
                    [] => "medium".to_owned(),
                    [(pigment, _)] => name(*pigment).to_owned(),
                    [(first, _), (second, _)] => format!("{} and {}", name(*first), name(*second)),
                    parts => format!("{} pigments", parts.len()),
                },
                _ => "paint".to_owned(),
            };
            format!("squeeze {paint}{}", if squeeze.on.is_canvas() { " on the canvas" } else { "" })
        }
        Action::Scrape { on: SurfaceId::Canvas } => "scrape the canvas".to_owned(),
        Action::Scrape { on: SurfaceId::Palette } => "scrape the palette".to_owned(),
        Action::Load(_)
        | Action::Wipe { .. }
        | Action::Wash { .. }
        | Action::Undo {}
        | Action::Redo {}
        | Action::Save { .. } => action.kind().to_owned(),
    }
}

fn percent(share: f64) -> String {
    format!("{} %", (share * 1000.0).round() / 10.0)
}

fn layer_name(layer: LayerRef) -> String {
    match layer {
        LayerRef::Wet => "wet paint".to_owned(),
        LayerRef::Dry(index) => format!("layer {index}"),
    }
}
