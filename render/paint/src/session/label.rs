//! Labels of actions for the history.

use pigment::PigmentId;

use crate::dry_layer::{LayerId, layer_label};
use crate::painting::{DryLayerState, Painting};
use crate::strokes::{Action, ActionPigments, LayerRef, MaskChange, SurfaceId};

/// Label of an action with the pigments that it names. `canvas` is that before the action, so that
/// layers have the names and places that the action means.
pub(super) fn label(action: &Action, pigments: &ActionPigments, canvas: &Painting) -> String {
    let name = |pigment: PigmentId| canvas.library()[pigment].name.as_str();
    let layer_name = |layer: LayerRef| layer_name(layer, canvas);
    let on = |surface: SurfaceId| if surface.is_canvas() { "" } else { " on the palette" };
    match action {
        Action::Stroke(stroke) | Action::Cut(stroke) if stroke.tool.is_paint() => {
            format!("stroke{}, {}", on(stroke.on), stroke.brush)
        }
        Action::Stroke(stroke) | Action::Cut(stroke) => {
            format!("{}{}, {}", stroke.tool.name(), on(stroke.on), stroke.brush)
        }
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
        Action::Name { name, .. } if name.is_empty() => "no name for a layer".to_owned(),
        Action::Name { name, .. } => format!("name {name}"),
        Action::Visible { layer, value: true } => format!("show {}", layer_name(*layer)),
        Action::Visible { layer, value: false } => format!("hide {}", layer_name(*layer)),
        Action::Order { layer, to } => format!("{} to place {}", layer_name(*layer), to + 1),
        Action::Merge { layer, with: None } => {
            format!("merge {} with the one below", layer_name(*layer))
        }
        Action::Merge { layer, with: Some(with) } => {
            format!("merge {} with {}", layer_name(*layer), layer_name(*with))
        }
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
        Action::Mask(change) => match change {
            MaskChange::PolygonMm(_) => "mask".to_owned(),
            MaskChange::Layer(layer) => format!("mask by {}", layer_name(*layer)),
            MaskChange::Painted {} => "mask by all paint".to_owned(),
            MaskChange::Inverse(_) => "mask inverted".to_owned(),
            MaskChange::Clear {} => "mask off".to_owned(),
        },
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

fn layer_name(layer: LayerRef, canvas: &Painting) -> String {
    match layer {
        LayerRef::Wet => "wet paint".to_owned(),
        LayerRef::Dry(index) => {
            let dry = canvas.state().dry.get(index);
            dry.map_or_else(|| layer_label(LayerId::by_place(index), ""), DryLayerState::label)
        }
        LayerRef::Id(id) => {
            let dry = canvas.state().dry.iter().find(|layer| layer.id == id);
            dry.map_or_else(|| layer_label(id, ""), DryLayerState::label)
        }
    }
}
