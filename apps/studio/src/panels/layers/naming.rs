//! Editing the name of a dry layer in its row.

use eframe::egui::text::{CCursor, CCursorRange};
use eframe::egui::{Key, Ui};
use paint::document::LayerId;
use paint::dry_layer::MAX_LAYER_NAME;
use paint::strokes::{Action, LayerRef};
use session::LayerState;

use crate::language::{layer_label, tr_format};
use crate::panels::PanelContext;
use crate::theme;

/// The name that is being edited, if one is.
#[derive(Debug, Clone, Default)]
pub(super) struct Naming(Option<Edited>);

#[derive(Debug, Clone)]
struct Edited {
    layer: LayerId,
    text: String,
    /// Whether the text field was not shown yet.
    fresh: bool,
}

impl Naming {
    /// Begins to edit the name of a layer.
    pub(super) fn begin(&mut self, layer: &LayerState) {
        let text = layer.name.clone();
        self.0 = Some(Edited { layer: layer.id, text, fresh: true });
    }

    /// Whether the name of this layer is being edited.
    pub(super) fn is_of(&self, layer: LayerId) -> bool {
        self.0.as_ref().is_some_and(|edited| edited.layer == layer)
    }

    /// Draws the text field. Enter and a click elsewhere set the name, Escape leaves it.
    pub(super) fn show(&mut self, ui: &mut Ui, cx: &mut PanelContext<'_>, layer: &LayerState) {
        let Some(edited) = self.0.as_mut().filter(|edited| edited.layer == layer.id) else {
            return;
        };
        let field = theme::text_field(&mut edited.text);
        let field =
            field.char_limit(MAX_LAYER_NAME).hint_text(layer_label(&format!("Layer {}", layer.id)));
        let mut output = field.desired_width(ui.available_width()).show(ui);
        let response = output.response.response;
        let response = response
            .accessible_name(tr_format!("name of {label}", label = layer_label(&layer.label())));
        if std::mem::take(&mut edited.fresh) {
            response.request_focus();
            let all = CCursorRange::two(CCursor::new(0), CCursor::new(edited.text.chars().count()));
            output.state.cursor.set_char_range(Some(all));
            output.state.store(ui.ctx(), response.id);
        }
        if !response.lost_focus() {
            return;
        }
        let name: String = edited.text.chars().filter(|letter| !letter.is_control()).collect();
        let name = name.trim().to_owned();
        self.0 = None;
        if !ui.input(|input| input.key_pressed(Key::Escape)) && name != layer.name {
            cx.act(Action::Name { layer: LayerRef::Id(layer.id), name });
        }
    }
}
