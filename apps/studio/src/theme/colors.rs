//! Greys of both themes.

use eframe::egui::{Color32, Context, Theme};

/// Surround of canvas and palette: 18 % reflectance, which is 118 in sRGB.
pub const SURROUND: Color32 = Color32::from_gray(118);

/// Backing of text that lies over the picture, in both themes.
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
    /// Fill of buttons that are neither hovered nor pressed.
    pub button: Color32,
    /// Fill of buttons and rows under the pointer.
    pub hovered: Color32,
    /// Fill of buttons while they are pressed.
    pub pressed: Color32,
    /// Fill of selected items. Only `text` and `strong` are legible on it.
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

/// Greys of the theme that the window shows.
#[must_use]
pub fn colors(context: &Context) -> Colors {
    of(context.theme())
}

/// Greys of a theme.
pub(super) fn of(theme: Theme) -> Colors {
    match theme {
        Theme::Dark => DARK,
        Theme::Light => LIGHT,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::theme::contrast;

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
        // Over white the board is lightest.
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
}
