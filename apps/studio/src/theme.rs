//! Colours and sizes of the window, dark and light. You judge colour here, so all colours are
//! exactly neutral greys, and the surround of the canvas has 18 % reflectance in both themes. All
//! text has a contrast of at least 7:1 (WCAG 2.2, level AAA).

use eframe::egui::style::{ScrollStyle, Selection, WidgetVisuals, Widgets};
use eframe::egui::{
    Align2, Color32, Context, CornerRadius, FontFamily, FontId, Margin, Stroke, Style, TextEdit,
    TextStyle, Theme, ThemePreference, Ui, Vec2, Visuals, vec2,
};
use serde::{Deserialize, Serialize};

/// Surround of canvas and palette. 18 % reflectance is 118 in sRGB.
pub const SURROUND: Color32 = Color32::from_gray(118);

/// Backing of text over the picture, in both themes.
pub const BOARD: Color32 = Color32::from_black_alpha(200);

/// Text on [`BOARD`].
pub const BOARD_TEXT: Color32 = Color32::WHITE;

/// Greys of one theme.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Colors {
    /// Background of panels.
    pub panel: Color32,
    /// Background of menu bar, toolbar and status line.
    pub bar: Color32,
    /// Background of text fields, charts and lists.
    pub well: Color32,
    /// Background of windows, menus and tooltips.
    pub window: Color32,
    /// Background of groups within a panel, and of every other row of a table.
    pub group: Color32,
    /// Separator lines and edges.
    pub line: Color32,
    /// Fill of buttons at rest.
    pub button: Color32,
    /// Fill of buttons and rows under the pointer.
    pub hovered: Color32,
    /// Fill of buttons while they are pressed.
    pub pressed: Color32,
    /// Fill of selected items. Use only `text` and `strong` on it, because others are not legible.
    pub chosen: Color32,
    /// Secondary text and marks.
    pub faint: Color32,
    /// Normal text and marks.
    pub text: Color32,
    /// Emphasized text and marks.
    pub strong: Color32,
}

/// Light text on dark panels.
pub const DARK: Colors = Colors {
    panel: Color32::from_gray(34),
    bar: Color32::from_gray(26),
    well: Color32::from_gray(20),
    window: Color32::from_gray(38),
    group: Color32::from_gray(40),
    line: Color32::from_gray(68),
    button: Color32::from_gray(50),
    hovered: Color32::from_gray(56),
    pressed: Color32::from_gray(80),
    chosen: Color32::from_gray(74),
    faint: Color32::from_gray(202),
    text: Color32::from_gray(232),
    strong: Color32::WHITE,
};

/// Dark text on light panels.
pub const LIGHT: Colors = Colors {
    panel: Color32::from_gray(214),
    bar: Color32::from_gray(200),
    well: Color32::from_gray(236),
    window: Color32::from_gray(222),
    group: Color32::from_gray(205),
    line: Color32::from_gray(158),
    button: Color32::from_gray(193),
    hovered: Color32::from_gray(182),
    pressed: Color32::from_gray(152),
    chosen: Color32::from_gray(168),
    faint: Color32::from_gray(40),
    text: Color32::from_gray(20),
    strong: Color32::BLACK,
};

/// Greys of the current theme.
#[must_use]
pub fn colors(context: &Context) -> Colors {
    of(context.theme())
}

fn of(theme: Theme) -> Colors {
    match theme {
        Theme::Dark => DARK,
        Theme::Light => LIGHT,
    }
}

/// Contrast of two opaque colours, 1 to 21: the ratio of their relative luminances, each with 5 %
/// of stray light added.
///
/// Source: WCAG 2.2, definitions of "contrast ratio" and "relative luminance".
#[must_use]
pub fn contrast(one: Color32, other: Color32) -> f64 {
    let one = luminance(one) + 0.05;
    let other = luminance(other) + 0.05;
    one.max(other) / one.min(other)
}

/// Relative luminance of an opaque colour in sRGB, 0 to 1.
fn luminance(color: Color32) -> f64 {
    fn linear(byte: u8) -> f64 {
        let encoded = f64::from(byte) / 255.0;
        if encoded <= 0.04045 { encoded / 12.92 } else { ((encoded + 0.055) / 1.055).powf(2.4) }
    }
    0.2126 * linear(color.r()) + 0.7152 * linear(color.g()) + 0.0722 * linear(color.b())
}

const STEPS: [f32; 11] = [0.5, 0.75, 0.9, 1.0, 1.1, 1.25, 1.5, 1.75, 2.0, 2.5, 3.0];

/// The interface needs at least this width and height, in points: the smallest window.
const NEEDED: Vec2 = Vec2::new(900.0, 600.0);

/// The next larger or smaller step of the scale. At the end of the steps this returns `scale`.
#[must_use]
pub fn stepped_scale(scale: f32, larger: bool) -> f32 {
    const NEAR: f32 = 0.01;
    let found = match larger {
        true => STEPS.into_iter().find(|step| *step > scale + NEAR),
        false => STEPS.into_iter().rev().find(|step| *step < scale - NEAR),
    };
    found.unwrap_or(scale)
}

/// The scale of the interface in a window of `size` points at scale 1. This is the preferred scale,
/// unless controls would leave the window.
#[must_use]
pub fn scale_in_window(preferred: f32, size: Vec2) -> f32 {
    let most = (size.x / NEEDED.x).min(size.y / NEEDED.y);
    // In a smaller window we use scale 1 or less, and you do not see all of it.
    preferred.min(most.max(1.0))
}

/// Corner radius of buttons, in points.
pub const CORNER_RADIUS: u8 = 4;

fn visuals(theme: Theme) -> Visuals {
    let colors = of(theme);
    let mut visuals = theme.default_visuals();
    visuals.widgets = Widgets {
        noninteractive: widget_visuals(colors.panel, colors.line, colors.text),
        inactive: widget_visuals(colors.button, Color32::TRANSPARENT, colors.text),
        hovered: widget_visuals(colors.hovered, colors.chosen, colors.strong),
        active: widget_visuals(colors.pressed, colors.faint, colors.strong),
        open: widget_visuals(colors.hovered, colors.line, colors.text),
    };
    visuals.selection =
        Selection { bg_fill: colors.chosen, stroke: Stroke::new(1.0, colors.strong) };
    visuals.hyperlink_color = colors.strong;
    visuals.weak_text_color = Some(colors.faint);
    visuals.faint_bg_color = colors.group;
    visuals.extreme_bg_color = colors.well;
    visuals.code_bg_color = colors.well;
    visuals.warn_fg_color = colors.strong;
    visuals.error_fg_color = colors.strong;
    visuals.panel_fill = colors.panel;
    visuals.window_fill = colors.window;
    visuals.window_stroke = Stroke::new(1.0, colors.line);
    visuals.window_corner_radius = CornerRadius::same(6);
    visuals.menu_corner_radius = CornerRadius::same(CORNER_RADIUS);
    visuals.slider_trailing_fill = true;
    visuals.text_cursor.stroke.color = colors.strong;
    visuals.ime_composition.active_underline_stroke.color = colors.strong;
    visuals.ime_composition.inactive_underline_stroke.color = colors.faint;
    visuals
}

fn widget_visuals(fill: Color32, edge: Color32, text: Color32) -> WidgetVisuals {
    WidgetVisuals {
        bg_fill: fill,
        weak_bg_fill: fill,
        bg_stroke: Stroke::new(1.0, edge),
        fg_stroke: Stroke::new(1.0, text),
        corner_radius: CornerRadius::same(CORNER_RADIUS),
        expansion: 0.0,
    }
}

/// Usual width of the column of panels at the right, in points.
pub const PANEL_WIDTH: f32 = 284.0;

/// Smallest width of a column of panels for touch, in points: eight buttons side by side.
const TOUCH_PANEL_WIDTH: f32 = 384.0;

/// In a narrower window, toolbar and a column of panels would take half of the width or more, in
/// points.
const NARROW: f32 = 640.0;

/// Smallest width and height of everything that you touch, in points: WCAG 2.2, criterion 2.5.5.
pub const TOUCH_TARGET: f32 = 44.0;

/// The theme that you prefer.
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
    /// Whether everything is large enough for touch, [`TOUCH_TARGET`] or more.
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

/// Whether everything is large enough for touch.
#[must_use]
pub fn is_touch(context: &Context) -> bool {
    context.global_style().spacing.interact_size.y >= TOUCH_TARGET
}

/// Whether the window has no room for columns of panels beside the canvas, e.g. on a phone.
#[must_use]
pub fn is_narrow(context: &Context) -> bool {
    context.content_rect().width() < NARROW
}

/// Usual width of a column of panels, in points.
#[must_use]
pub fn panel_width(context: &Context) -> f32 {
    if is_touch(context) { TOUCH_PANEL_WIDTH } else { PANEL_WIDTH }
}

/// Smallest side of something that you click, in points; 0 without touch.
#[must_use]
pub fn target(ui: &Ui) -> f32 {
    if is_touch(ui.ctx()) { TOUCH_TARGET } else { 0.0 }
}

/// A field of one line. If the field is high, its text stands in the middle.
pub(crate) fn text_field(text: &mut String) -> TextEdit<'_> {
    TextEdit::singleline(text).align(Align2::LEFT_CENTER)
}

/// The size, or a larger one if it must be large enough for touch.
#[must_use]
pub fn at_least(ui: &Ui, size: Vec2) -> Vec2 {
    size.max(Vec2::splat(target(ui)))
}

fn style(theme: Theme, touch: bool) -> Style {
    let mut style = Style { visuals: visuals(theme), animation_time: 0.08, ..Style::default() };
    style.text_styles = [
        (TextStyle::Small, FontId::new(11.0, FontFamily::Proportional)),
        (TextStyle::Body, FontId::new(13.0, FontFamily::Proportional)),
        (TextStyle::Button, FontId::new(13.0, FontFamily::Proportional)),
        (TextStyle::Heading, FontId::new(15.0, FontFamily::Proportional)),
        (TextStyle::Monospace, FontId::new(12.0, FontFamily::Monospace)),
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

/// Makes everything large enough for touch.
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::theme::contrast;
    use eframe::egui::vec2;

    #[test]
    fn all_text_has_a_contrast_of_seven_on_every_background_it_is_drawn_on() {
        for colors in [DARK, LIGHT] {
            let Colors {
                panel, bar, well, window, group, button, hovered, pressed, chosen, ..
            } = colors;
            let quiet = [panel, bar, well, window, group, button, hovered];
            for background in quiet {
                for text in [colors.faint, colors.text, colors.strong] {
                    let found = contrast(text, background);
                    assert!(found >= 7.0, "{text:?} on {background:?}: {found}");
                }
            }
            for (text, background) in
                [(colors.text, chosen), (colors.strong, chosen), (colors.strong, pressed)]
            {
                let found = contrast(text, background);
                assert!(found >= 7.0, "{text:?} on {background:?}: {found}");
            }
        }
    }

    #[test]
    fn text_over_the_picture_has_a_contrast_of_seven_whatever_lies_below() {
        // The board is lightest over white.
        let lightest = Color32::from_gray(255 - BOARD.a());
        let found = contrast(BOARD_TEXT, lightest);
        assert!(found >= 7.0, "{found}");
    }

    #[test]
    fn the_surround_reflects_eighteen_per_cent() {
        let encoded = f64::from(SURROUND.r()) / 255.0;
        let linear = ((encoded + 0.055) / 1.055).powf(2.4);
        assert!((linear - 0.18).abs() < 0.003, "{linear}");
    }

    #[test]
    fn contrasts_are_those_of_the_standard() {
        let grey = Color32::from_gray;
        assert!((contrast(Color32::BLACK, Color32::WHITE) - 21.0).abs() < 1e-9);
        assert!((contrast(grey(90), grey(90)) - 1.0).abs() < 1e-9);
        // These are the best known limits on white: #767676 passes 4.5, #777777 does not.
        assert!(contrast(grey(0x76), Color32::WHITE) > 4.5);
        assert!(contrast(grey(0x77), Color32::WHITE) < 4.5);
        let red = contrast(Color32::from_rgb(255, 0, 0), Color32::WHITE);
        assert!((red - 3.998).abs() < 1e-3, "{red}");
    }

    #[test]
    fn steps_go_up_and_down_and_end() {
        let mut scale = 1.0;
        let mut up = Vec::new();
        for _ in 0..8 {
            scale = stepped_scale(scale, true);
            up.push(scale);
        }
        assert_eq!(up, [1.1, 1.25, 1.5, 1.75, 2.0, 2.5, 3.0, 3.0]);
        assert_eq!(stepped_scale(1.0, false), 0.9);
        assert_eq!(stepped_scale(0.5, false), 0.5);
        // This scale lies between two steps.
        assert_eq!((stepped_scale(1.3, true), stepped_scale(1.3, false)), (1.5, 1.25));
    }

    #[test]
    fn a_large_scale_yields_to_a_small_window() {
        assert_eq!(scale_in_window(3.0, vec2(3840.0, 2160.0)), 3.0);
        assert_eq!(scale_in_window(1.25, vec2(1280.0, 800.0)), 1.25);
        let small = scale_in_window(3.0, vec2(1280.0, 800.0));
        assert!((small - 800.0 / 600.0).abs() < 1e-6, "{small}");
        assert_eq!(scale_in_window(0.75, vec2(800.0, 500.0)), 0.75);
        assert_eq!(scale_in_window(2.0, vec2(800.0, 500.0)), 1.0);
    }

    const THEMES: [Theme; 2] = [Theme::Dark, Theme::Light];

    #[test]
    fn all_window_colors_are_neutral() {
        for theme in THEMES {
            // We find every colour in the debug output of the visuals.
            let written = format!("{:?}", visuals(theme));
            let colors: Vec<[u8; 4]> = written
                .match_indices("#")
                .filter_map(|(at, _)| {
                    let bytes = written[at + 1..].get(..11)?.split('_').take(4);
                    let bytes = bytes.map(|byte| u8::from_str_radix(byte, 16).ok());
                    bytes.collect::<Option<Vec<u8>>>()?.try_into().ok()
                })
                .collect();
            assert!(colors.len() > 20, "{} colours found in {written}", colors.len());
            for [red, green, blue, _] in colors {
                assert!(red == green && green == blue, "{red} {green} {blue} in {written}");
            }
        }
    }

    #[test]
    fn the_text_of_every_widget_has_a_contrast_of_seven_in_every_state() {
        for theme in THEMES {
            let visuals = visuals(theme);
            let widgets = &visuals.widgets;
            let states =
                [widgets.noninteractive, widgets.inactive, widgets.hovered, widgets.active];
            for state in states.into_iter().chain([widgets.open]) {
                let found = contrast(state.text_color(), state.weak_bg_fill);
                assert!(found >= 7.0, "{found} of {state:?}");
            }
            let Selection { bg_fill, stroke } = visuals.selection;
            assert!(contrast(stroke.color, bg_fill) >= 7.0, "selected text");
            assert!(contrast(visuals.text_color(), bg_fill) >= 7.0, "marked text");
            for fill in [visuals.window_fill, visuals.panel_fill, visuals.faint_bg_color] {
                let weak = contrast(visuals.weak_text_color(), fill);
                assert!(weak >= 7.0 && contrast(visuals.text_color(), fill) >= 7.0, "{weak}");
            }
        }
    }
}
