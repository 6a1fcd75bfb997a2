//! Visuals of egui's widgets, made of the greys of a theme.

use eframe::egui::style::{Selection, WidgetVisuals, Widgets};
use eframe::egui::{Color32, CornerRadius, Stroke, Theme, Visuals};

use super::colors::of;

/// Corner radius of buttons, in points.
pub const CORNER_RADIUS: u8 = 4;

/// Visuals of a theme.
pub(super) fn visuals(theme: Theme) -> Visuals {
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::theme::contrast;

    const THEMES: [Theme; 2] = [Theme::Dark, Theme::Light];

    #[test]
    fn all_window_colors_are_neutral() {
        for theme in THEMES {
            // Find every colour in the debug output of the visuals.
            let written = format!("{:?}", visuals(theme));
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
