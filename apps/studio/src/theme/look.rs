//! The look of the window: theme, and size of everything that is touched.

use eframe::egui::style::ScrollStyle;
use eframe::egui::{
    Align2, Context, FontFamily, FontId, Margin, Style, TextEdit, TextStyle, Theme,
    ThemePreference, Ui, Vec2, vec2,
};
use serde::{Deserialize, Serialize};

use super::visuals::visuals;

/// Usual width of the column of panels at the right, in points.
pub const PANEL_WIDTH: f32 = 284.0;

/// Least width of a column of panels for touch, in points: eight buttons side by side.
const TOUCH_PANEL_WIDTH: f32 = 384.0;

/// Width of a window in points below which the toolbar and a column of panels would take half of it or
/// more.
const NARROW: f32 = 640.0;

/// Least width and height of everything that is touched, in points: WCAG 2.2, criterion
/// 2.5.5.
pub const TOUCH_TARGET: f32 = 44.0;

/// The theme that the painter prefers.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum ThemeChoice {
    /// Light text on dark panels.
    #[default]
    Dark,
    /// Dark text on light panels.
    Light,
    /// Dark or light, as the system prefers.
    System,
}

/// The look of the window.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Look {
    /// Dark or light.
    pub theme: ThemeChoice,
    /// Whether everything is large enough to be touched, [`TOUCH_TARGET`] or more.
    pub touch: bool,
}

/// Applies the usual look to the window from the next frame on.
pub fn apply(context: &Context) {
    apply_look(context, Look::default());
}

/// Applies a look to the window from the next frame on.
pub fn apply_look(context: &Context, look: Look) {
    context.set_theme(match look.theme {
        ThemeChoice::Dark => ThemePreference::Dark,
        ThemeChoice::Light => ThemePreference::Light,
        ThemeChoice::System => ThemePreference::System,
    });
    for theme in [Theme::Dark, Theme::Light] {
        context.set_style_of(theme, style(theme, look.touch));
    }
}

/// Whether everything is large enough to be touched.
#[must_use]
pub fn is_touch(context: &Context) -> bool {
    context.global_style().spacing.interact_size.y >= TOUCH_TARGET
}

/// Whether the window has no room for columns of panels beside the canvas, as on a phone.
#[must_use]
pub fn is_narrow(context: &Context) -> bool {
    context.content_rect().width() < NARROW
}

/// Usual width of a column of panels, in points.
#[must_use]
pub fn panel_width(context: &Context) -> f32 {
    if is_touch(context) { TOUCH_PANEL_WIDTH } else { PANEL_WIDTH }
}

/// Least side of a thing that is clicked, in points; 0 unless it is to be touched.
#[must_use]
pub fn target(ui: &Ui) -> f32 {
    if is_touch(ui.ctx()) { TOUCH_TARGET } else { 0.0 }
}

/// A field of one line, whose text stands in its middle where the field is high.
pub(crate) fn text_field(text: &mut String) -> TextEdit<'_> {
    TextEdit::singleline(text).align(Align2::LEFT_CENTER)
}

/// A size, made large enough to be touched if it is to be.
#[must_use]
pub fn at_least(ui: &Ui, size: Vec2) -> Vec2 {
    size.max(Vec2::splat(target(ui)))
}

fn style(theme: Theme, touch: bool) -> Style {
    let mut style = Style { visuals: visuals(theme), animation_time: 0.08, ..Style::default() };
    let font = |size, family| FontId::new(size, family);
    style.text_styles = [
        (TextStyle::Small, font(11.0, FontFamily::Proportional)),
        (TextStyle::Body, font(13.0, FontFamily::Proportional)),
        (TextStyle::Button, font(13.0, FontFamily::Proportional)),
        (TextStyle::Heading, font(15.0, FontFamily::Proportional)),
        (TextStyle::Monospace, font(12.0, FontFamily::Monospace)),
    ]
    .into();
    style.spacing.item_spacing = vec2(6.0, 5.0);
    style.spacing.button_padding = vec2(7.0, 3.0);
    style.spacing.interact_size = vec2(36.0, 22.0);
    style.spacing.slider_width = 130.0;
    style.spacing.slider_rail_height = 4.0;
    style.spacing.window_margin = Margin::same(10);
    style.spacing.tooltip_width = 320.0;
    style.spacing.combo_height = 320.0;
    style.spacing.scroll = ScrollStyle::thin();
    style.interaction.selectable_labels = false;
    if touch {
        enlarge(&mut style);
    }
    style
}

/// Makes everything large enough to be touched.
fn enlarge(style: &mut Style) {
    // The title bar of a window is as high as its text asks for.
    let title = FontId::new(21.0, FontFamily::Proportional);
    style.text_styles.insert(TextStyle::Heading, title);
    style.spacing.interact_size = Vec2::splat(TOUCH_TARGET);
    style.spacing.button_padding = vec2(13.0, 6.0);
    style.spacing.icon_width = 24.0;
    style.spacing.icon_width_inner = 14.0;
    style.spacing.slider_rail_height = 8.0;
    style.spacing.combo_height = 480.0;
    style.spacing.scroll = ScrollStyle { bar_width: 14.0, ..ScrollStyle::thin() };
    style.interaction.resize_grab_radius_side = 0.5 * TOUCH_TARGET;
    style.interaction.resize_grab_radius_corner = 0.5 * TOUCH_TARGET;
}
