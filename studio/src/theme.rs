//! Colours and sizes of the window: exactly neutral greys only, as colour is judged
//! here, and around the canvas the grey of 18 % reflectance.

use eframe::egui::style::{ScrollStyle, Selection, WidgetVisuals, Widgets};
use eframe::egui::{
    Color32, Context, CornerRadius, FontFamily, FontId, Margin, Stroke, Style, TextStyle, Theme,
    Visuals, vec2,
};

/// Around canvas and palette: 18 % of the light, which is 118 in sRGB.
pub const SURROUND: Color32 = Color32::from_gray(118);

/// Behind panels.
pub const PANEL: Color32 = Color32::from_gray(46);

/// Behind the menu bar, the tools and the line below.
pub const BAR: Color32 = Color32::from_gray(38);

/// Behind text being edited, charts and lists.
pub const WELL: Color32 = Color32::from_gray(30);

/// Lines between things.
pub const LINE: Color32 = Color32::from_gray(66);

/// Buttons at rest.
pub const BUTTON: Color32 = Color32::from_gray(64);

/// What is chosen.
pub const CHOSEN: Color32 = Color32::from_gray(104);

/// Text and marks that stand back.
pub const FAINT: Color32 = Color32::from_gray(150);

/// Text.
pub const TEXT: Color32 = Color32::from_gray(214);

/// Text and marks that stand out.
pub const STRONG: Color32 = Color32::from_gray(245);

/// Corners of buttons, in points.
pub const ROUND: u8 = 4;

/// Width of the panels at the right, in points.
pub const PANEL_WIDTH: f32 = 284.0;

/// Makes the window look so, from the next frame on.
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
        noninteractive: look(PANEL, LINE, TEXT),
        inactive: look(BUTTON, Color32::TRANSPARENT, TEXT),
        hovered: look(Color32::from_gray(78), Color32::from_gray(120), STRONG),
        active: look(Color32::from_gray(92), Color32::from_gray(160), Color32::WHITE),
        open: look(Color32::from_gray(58), LINE, TEXT),
    };
    visuals.selection = Selection { bg_fill: CHOSEN, stroke: Stroke::new(1.0, Color32::WHITE) };
    visuals.hyperlink_color = STRONG;
    visuals.weak_text_color = Some(FAINT);
    visuals.faint_bg_color = Color32::from_gray(52);
    visuals.extreme_bg_color = WELL;
    visuals.code_bg_color = WELL;
    visuals.warn_fg_color = STRONG;
    visuals.error_fg_color = Color32::WHITE;
    visuals.panel_fill = PANEL;
    visuals.window_fill = Color32::from_gray(50);
    visuals.window_stroke = Stroke::new(1.0, Color32::from_gray(82));
    visuals.window_corner_radius = CornerRadius::same(6);
    visuals.menu_corner_radius = CornerRadius::same(ROUND);
    visuals.slider_trailing_fill = true;
    visuals.text_cursor.stroke.color = STRONG;
    visuals.ime_composition.active_underline_stroke.color = STRONG;
    visuals.ime_composition.inactive_underline_stroke.color = FAINT;
    visuals
}

fn look(fill: Color32, edge: Color32, text: Color32) -> WidgetVisuals {
    WidgetVisuals {
        bg_fill: fill,
        weak_bg_fill: fill,
        bg_stroke: Stroke::new(1.0, edge),
        fg_stroke: Stroke::new(1.0, text),
        corner_radius: CornerRadius::same(ROUND),
        expansion: 0.0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_color_of_the_window_has_a_hue() {
        // Every colour of the visuals, whichever field it stands in.
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
