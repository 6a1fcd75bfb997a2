//! Preview of the marks that the tip of a brush makes at three pressures.

use eframe::egui::{
    Align, Color32, ColorImage, Context, Rect, Role, Sense, TextStyle, TextureHandle,
    TextureOptions, Ui, WidgetInfo, pos2, vec2,
};
use paint::brush::ContactMark;
use paint::strokes::BrushSpec;

use crate::language::{english, tr};
use crate::panels::controls::millimetres;
use crate::panels::fitted_text::text;
use crate::theme;

/// Names and pressures of the marks: a light touch, a middle one, and all the way down.
const PRESSURES: [(&str, f64); 3] =
    [(english("light"), 0.15), (english("middle"), 0.5), (english("full"), 1.0)];

/// Most cells along a head: more would not be seen in the preview.
const FINEST: f64 = 64.0;

/// Height of the preview with its labels, in points.
const HEIGHT: f32 = 54.0;

/// Height of the labels, in points.
const LABEL: f32 = 15.0;

/// The marks of one head, which are computed once.
#[derive(Clone, Default)]
pub(super) struct TipPreview {
    shown: Option<(BrushSpec, Vec<Mark>)>,
}

/// A mark with its texture, whose pixels are white where the hair touches.
#[derive(Clone)]
struct Mark {
    size_mm: [f64; 2],
    texture: Option<TextureHandle>,
}

impl std::fmt::Debug for TipPreview {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_tuple("TipPreview").field(&self.shown.as_ref().map(|shown| &shown.0)).finish()
    }
}

impl TipPreview {
    /// Draws the three marks to one scale, so that the widest fills its field.
    pub(super) fn show(&mut self, ui: &mut Ui, spec: &BrushSpec) {
        if self.shown.as_ref().is_none_or(|(shown, _)| shown != spec) {
            self.shown = Some((spec.clone(), marks(ui.ctx(), spec)));
        }
        let Some((_, marks)) = &self.shown else { return };
        let size = vec2(ui.available_width(), HEIGHT);
        let (rect, response) = ui.allocate_exact_size(size, Sense::hover());
        response.widget_info(|| WidgetInfo::labeled(Role::Image, true, tr("Marks of the tip")));
        let colors = theme::colors(ui.ctx());
        ui.painter().rect_filled(rect, theme::CORNER_RADIUS, colors.well);
        let field = vec2(rect.width() / PRESSURES.len() as f32, rect.height());
        let room = vec2(field.x - 12.0, field.y - LABEL - 10.0);
        let most = |axis: usize| {
            marks.iter().map(|mark| mark.size_mm[axis]).fold(f64::MIN_POSITIVE, f64::max) as f32
        };
        let points_per_mm = (room.x / most(0)).min(room.y / most(1));
        for (at, ((name, _), mark)) in PRESSURES.iter().zip(marks).enumerate() {
            let left = rect.left() + at as f32 * field.x;
            let whole = Rect::from_min_size(pos2(left, rect.top()), field);
            let (upper, label) = whole.split_top_bottom_at_y(whole.bottom() - LABEL - 2.0);
            let [width, height] = mark.size_mm.map(|mm| mm as f32 * points_per_mm);
            let place = Rect::from_center_size(upper.center(), vec2(width, height));
            if let Some(texture) = &mark.texture {
                let all = Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0));
                ui.painter().image(texture.id(), place, all, colors.text);
            }
            let words = format!("{} {}", tr(name), millimetres(mark.size_mm[0]));
            text(
                ui,
                label.shrink2(vec2(2.0, 0.0)),
                Align::Center,
                TextStyle::Small,
                colors.faint,
                &words,
            );
        }
        response.on_hover_text(tr(
            "Where the upright head touches a plane at light, middle and full pressure, all to one \
             scale, and how wide that is",
        ));
    }
}

/// The marks of a head at all pressures; none for a head that cannot be made.
fn marks(context: &Context, spec: &BrushSpec) -> Vec<Mark> {
    let cell_mm = spec.size_mm / FINEST;
    let made = PRESSURES.iter().map(|&(name, pressure)| {
        let mark = ContactMark::of(spec.shape, spec.size_mm, cell_mm, pressure).ok()?;
        let width = mark.cells.width();
        let height = mark.cells.height();
        let texture = (width * height > 0).then(|| {
            let pixels = mark.cells.values().iter();
            let pixels =
                pixels.map(|touched| if *touched { Color32::WHITE } else { Color32::TRANSPARENT });
            let image = ColorImage::new([width, height], pixels.collect());
            context.load_texture(format!("mark {name}"), image, TextureOptions::LINEAR)
        });
        Some(Mark { size_mm: mark.size_mm(), texture })
    });
    made.flatten().collect()
}
