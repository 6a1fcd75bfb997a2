//! The grid of kept mixtures.

use eframe::egui::{
    Color32, DragAndDrop, Response, Role, Sense, Stroke, StrokeKind, Ui, WidgetInfo, vec2,
};
use session::swatches::{KeptMixture, Usable};

use crate::language::{tr, tr_format};
use crate::panels::PanelContext;
use crate::panels::controls::patch;
use crate::theme;

/// Side of a patch, in points: large enough for a finger.
const SIDE: f32 = 44.0;

/// Payload of a mixture that is dragged to another place.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct DraggedSwatch(usize);

/// Request made in the grid.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum GridRequest {
    /// Selects the mixture at an index.
    Select(usize),
    /// Loads the brush with it.
    Load(usize),
    /// Moves it from one index to another.
    Move(usize, usize),
}

/// Draws patches of the mixtures at these indices. `colors` are those of all mixtures.
pub(super) fn show<'a>(
    ui: &mut Ui,
    cx: &PanelContext<'_>,
    shown: impl Iterator<Item = (usize, &'a KeptMixture)>,
    colors: &[[u8; 3]],
    chosen: Option<usize>,
) -> Option<GridRequest> {
    let mut request = None;
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing = vec2(4.0, 4.0);
        for (index, kept) in shown {
            let color = colors.get(index).copied();
            let usable = kept.usable(&cx.painting.library, &cx.painting.slots);
            let response = one(ui, kept, color, &usable, chosen == Some(index));
            response.dnd_set_drag_payload(DraggedSwatch(index));
            if let Some(from) = response.dnd_release_payload::<DraggedSwatch>() {
                request = Some(GridRequest::Move(from.0, index));
            } else if response.double_clicked() && usable == Usable::Now {
                request = Some(GridRequest::Load(index));
            } else if response.clicked() {
                request = Some(GridRequest::Select(index));
            }
            let is_target = response.dnd_hover_payload::<DraggedSwatch>().is_some();
            if is_target {
                let line = Stroke::new(2.0, theme::colors(ui.ctx()).strong);
                ui.painter().vline(response.rect.left() - 2.0, response.rect.y_range(), line);
            }
            if !DragAndDrop::has_any_payload(ui.ctx()) {
                response.on_hover_ui(|ui| tip(ui, cx, kept, &usable));
            }
        }
    });
    request
}

fn one(
    ui: &mut Ui,
    kept: &KeptMixture,
    color: Option<[u8; 3]>,
    usable: &Usable,
    chosen: bool,
) -> Response {
    let (rect, response) = ui.allocate_exact_size(vec2(SIDE, SIDE), Sense::click_and_drag());
    let name = tr_format!("mixture {name}", name = kept.name);
    response.widget_info(|| WidgetInfo::selected(Role::Button, true, chosen, &name));
    let colors = theme::colors(ui.ctx());
    patch(ui.painter(), rect.shrink(3.0), color);
    if let Usable::NotInLibrary(_) = usable {
        // Greyed: the colour of another time under a veil, and crossed out.
        let veil = Color32::from_rgba_unmultiplied(
            colors.panel.r(),
            colors.panel.g(),
            colors.panel.b(),
            170,
        );
        ui.painter().rect_filled(rect.shrink(3.0), 0.0, veil);
        let line = Stroke::new(1.5, colors.faint);
        ui.painter()
            .line_segment([rect.shrink(3.0).left_bottom(), rect.shrink(3.0).right_top()], line);
    }
    if let Usable::NotOnPalette(_) = usable {
        let at = rect.right_bottom() - vec2(9.0, 9.0);
        ui.painter().circle(at, 3.5, colors.panel, Stroke::new(1.5, colors.strong));
    }
    if chosen || response.hovered() || response.has_focus() {
        let line = Stroke::new(2.0, if chosen { colors.strong } else { colors.faint });
        ui.painter().rect_stroke(rect.shrink(1.0), theme::CORNER_RADIUS, line, StrokeKind::Inside);
    }
    response
}

fn tip(ui: &mut Ui, cx: &PanelContext<'_>, kept: &KeptMixture, usable: &Usable) {
    ui.strong(&kept.name);
    for (name, part) in &kept.recipe {
        ui.label(format!("{part} {name}"));
    }
    match reason(cx, usable) {
        Some(reason) => ui.weak(reason),
        None => ui.weak(tr("Double click loads the brush; drag to another place.")),
    };
}

/// Why a mixture cannot be loaded now; `None` if it can.
pub(super) fn reason(cx: &PanelContext<'_>, usable: &Usable) -> Option<String> {
    match usable {
        Usable::Now => None,
        Usable::NotOnPalette(away) => {
            let names: Vec<&str> =
                away.iter().map(|pigment| cx.painting.library[*pigment].name.as_str()).collect();
            let all = names.join(", ");
            Some(match names.len() {
                1 => tr_format!("{name} is not on the palette.", name = all),
                _ => tr_format!("{names} are not on the palette.", names = all),
            })
        }
        Usable::NotInLibrary(names) => {
            let all = names.join(", ");
            Some(match names.len() {
                1 => tr_format!("{name} is not in the open library.", name = all),
                _ => tr_format!("{names} are not in the open library.", names = all),
            })
        }
    }
}
