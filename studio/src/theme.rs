//! Colours and sizes of the window. All colours are exactly neutral greys, because
//! colour is judged here; the surround of the canvas has 18 % reflectance.

use eframe::egui::style::{ScrollStyle, Selection, WidgetVisuals, Widgets};
use eframe::egui::{
    Color32, Context, CornerRadius, FontFamily, FontId, Margin, Stroke, Style, TextStyle, Theme,
    Visuals, vec2,
};

/// Surround of canvas and palette: 18 % reflectance, which is 118 in sRGB.
pub const SURROUND: Color32 = Color32::from_gray(118);

/// Greys of one theme.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Colors {
    /// Background of panels.
    pub panel: Color32,
    /// Background of menu bar, toolbar and status line.
    pub bar: Color32,
    /// Background of text fields, charts and lists.
    pub well: Color32,
    /// Separator lines and edges.
    pub line: Color32,
    /// Fill of buttons that are neither hovered nor pressed.
    pub button: Color32,
    /// Fill of selected items.
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
    panel: Color32::from_gray(46),
    bar: Color32::from_gray(38),
    well: Color32::from_gray(30),
    line: Color32::from_gray(66),
    button: Color32::from_gray(64),
    chosen: Color32::from_gray(104),
    faint: Color32::from_gray(150),
    text: Color32::from_gray(214),
    strong: Color32::from_gray(245),
};

/// Dark text on light panels.
pub const LIGHT: Colors = Colors {
    panel: Color32::from_gray(212),
    bar: Color32::from_gray(200),
    well: Color32::from_gray(232),
    line: Color32::from_gray(172),
    button: Color32::from_gray(190),
    chosen: Color32::from_gray(240),
    faint: Color32::from_gray(72),
    text: Color32::from_gray(32),
    strong: Color32::from_gray(8),
};

/// Greys of the theme that the window shows.
#[must_use]
pub fn colors(context: &Context) -> Colors {
    match context.theme() {
        Theme::Dark => DARK,
        Theme::Light => LIGHT,
    }
}

/// Corner radius of buttons, in points.
pub const CORNER_RADIUS: u8 = 4;

/// Width of the side panel at the right, in points.
pub const PANEL_WIDTH: f32 = 284.0;

/// Applies the theme to the window from the next frame on.
pub fn apply(context: &Context) {
    context.set_theme(Theme::Dark);
    context.set_style_of(Theme::Dark, style());
}

fn style() -> Style {
    let mut style = Style { visuals: visuals(), animation_time: 0.08, ..Style::default() };
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
    style
}

fn visuals() -> Visuals {
    let mut visuals = Visuals::dark();
    visuals.widgets = Widgets {
        noninteractive: widget_visuals(DARK.panel, DARK.line, DARK.text),
        inactive: widget_visuals(DARK.button, Color32::TRANSPARENT, DARK.text),
        hovered: widget_visuals(Color32::from_gray(78), Color32::from_gray(120), DARK.strong),
        active: widget_visuals(Color32::from_gray(92), Color32::from_gray(160), Color32::WHITE),
        open: widget_visuals(Color32::from_gray(58), DARK.line, DARK.text),
    };
    visuals.selection =
        Selection { bg_fill: DARK.chosen, stroke: Stroke::new(1.0, Color32::WHITE) };
    visuals.hyperlink_color = DARK.strong;
    visuals.weak_text_color = Some(DARK.faint);
    visuals.faint_bg_color = Color32::from_gray(52);
    visuals.extreme_bg_color = DARK.well;
    visuals.code_bg_color = DARK.well;
    visuals.warn_fg_color = DARK.strong;
    visuals.error_fg_color = Color32::WHITE;
    visuals.panel_fill = DARK.panel;
    visuals.window_fill = Color32::from_gray(50);
    visuals.window_stroke = Stroke::new(1.0, Color32::from_gray(82));
    visuals.window_corner_radius = CornerRadius::same(6);
    visuals.menu_corner_radius = CornerRadius::same(CORNER_RADIUS);
    visuals.slider_trailing_fill = true;
    visuals.text_cursor.stroke.color = DARK.strong;
    visuals.ime_composition.active_underline_stroke.color = DARK.strong;
    visuals.ime_composition.inactive_underline_stroke.color = DARK.faint;
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_window_colors_are_neutral() {
        // Find every colour in the debug output of the visuals.
        let written = format!("{:?}", visuals());
        let colors: Vec<[u8; 4]> = written
            .match_indices("#")
            .filter_map(|(at, _)| {
                let mut bytes = written[at + 1..].get(..11)?.split('_');
                let mut byte = || u8::from_str_radix(bytes.next()?, 16).ok();
                Some([byte()?, byte()?, byte()?, byte()?])
            })
            .collect();
        assert!(colors.len() > 20, "{} colours found in {written}", colors.len());
        for [red, green, blue, _] in colors {
            assert!(red == green && green == blue, "{red} {green} {blue} in {written}");
        }
    }

    #[test]
    fn the_surround_reflects_eighteen_per_cent() {
        let encoded = f64::from(SURROUND.r()) / 255.0;
        let linear = ((encoded + 0.055) / 1.055).powf(2.4);
        assert!((linear - 0.18).abs() < 0.003, "{linear}");
    }
}
