//! Contrast of text, as the WCAG defines it.

use eframe::egui::Color32;

/// Contrast of two opaque colours, 1 to 21: the ratio of their relative luminances with 5 %
/// of stray light added to each.
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
    let linear = |byte: u8| {
        let encoded = f64::from(byte) / 255.0;
        if encoded <= 0.04045 { encoded / 12.92 } else { ((encoded + 0.055) / 1.055).powf(2.4) }
    };
    0.2126 * linear(color.r()) + 0.7152 * linear(color.g()) + 0.0722 * linear(color.b())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn contrasts_are_those_of_the_standard() {
        let grey = Color32::from_gray;
        assert!((contrast(Color32::BLACK, Color32::WHITE) - 21.0).abs() < 1e-9);
        assert!((contrast(grey(90), grey(90)) - 1.0).abs() < 1e-9);
        // The best known limits on white: #767676 passes 4.5, #777777 does not.
        assert!(contrast(grey(0x76), Color32::WHITE) > 4.5);
        assert!(contrast(grey(0x77), Color32::WHITE) < 4.5);
        let red = contrast(Color32::from_rgb(255, 0, 0), Color32::WHITE);
        assert!((red - 3.998).abs() < 1e-3, "{red}");
    }
}
