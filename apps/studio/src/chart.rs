//! Small line charts over wavelength, 380 to 730 nm.

use std::ops::RangeInclusive;

use eframe::egui::{
    Align2, Color32, FontId, Painter, Pos2, Rect, Response, Role, Sense, Stroke, Ui, Vec2,
    WidgetInfo, pos2, vec2,
};
use spectra::Grid;

use crate::language::tr_format;
use crate::theme::{self, contrast};

/// Wavelength range of every chart, in nm.
pub const BAND_NM: RangeInclusive<f64> = 380.0..=730.0;

/// A named curve of values over wavelength.
#[derive(Debug, Clone, PartialEq)]
pub struct Curve {
    /// Name shown in the tooltip of the chart.
    pub name: String,
    /// Pairs of wavelength in nm (increasing) and value.
    pub points: Vec<(f64, f64)>,
    /// Line colour, e.g. the own colour of a pigment. `None` uses the colour of text.
    pub color: Option<Color32>,
}

impl Curve {
    /// Creates a curve in the colour of text from values on a wavelength grid.
    #[must_use]
    pub fn new(name: &str, grid: Grid, values: &[f64]) -> Self {
        let points = grid.wavelengths_nm().zip(values.iter().copied()).collect();
        Self { name: name.to_owned(), points, color: None }
    }

    /// Returns the curve with a line colour in sRGB. This brightens dark colours, so that they
    /// stand out from the background.
    #[must_use]
    pub fn colored(mut self, [red, green, blue]: [u8; 3]) -> Self {
        let seen = red.max(green).max(blue) >= 96;
        let [red, green, blue] =
            [red, green, blue].map(|value| if seen { value } else { value.saturating_add(96) });
        self.color = Some(Color32::from_rgb(red, green, blue));
        self
    }

    /// Interpolates the value at a wavelength linearly; `None` outside the curve.
    #[must_use]
    pub fn at(&self, nm: f64) -> Option<f64> {
        let after = self.points.partition_point(|point| point.0 < nm);
        let right = *self.points.get(after)?;
        if right.0 == nm {
            return Some(right.1);
        }
        let left = *self.points.get(after.checked_sub(1)?)?;
        Some(left.1 + (right.1 - left.1) * (nm - left.0) / (right.0 - left.0))
    }
}

/// A chart of curves on common axes.
#[derive(Debug, Clone, Copy)]
pub struct Chart<'a> {
    /// Curves to draw, first at the back.
    pub curves: &'a [Curve],
    /// Wavelengths marked with vertical lines, in nm.
    pub marks: &'a [f64],
    /// Label of the vertical axis, e.g. `reflectance` or `relative power`.
    pub quantity: &'a str,
    /// Upper end of the vertical axis. It starts at 0. `None` fits it to the curves.
    pub max: Option<f64>,
}

impl Chart<'_> {
    /// Draws the chart at a size in points, with a tooltip of the values under the
    /// pointer.
    pub fn show(&self, ui: &mut Ui, size: Vec2) -> Response {
        let (whole, response) = ui.allocate_exact_size(size, Sense::hover());
        let label = tr_format!("{quantity} over wavelength", quantity = self.quantity);
        response.widget_info(|| WidgetInfo::labeled(Role::Image, true, &label));
        if !ui.is_rect_visible(whole) {
            return response;
        }
        let axes = Axes::new(whole, self.max());
        let painter = ui.painter_at(whole);
        painter.rect_filled(whole, theme::CORNER_RADIUS, theme::colors(ui.ctx()).well);
        axes.frame(&painter, self.quantity);
        for &nm in self.marks {
            let line = [axes.place(nm, 0.0), axes.place(nm, axes.max)];
            painter.line_segment(
                line,
                Stroke::new(1.0, theme::colors(ui.ctx()).faint.gamma_multiply(0.6)),
            );
        }
        let inner = painter.with_clip_rect(axes.inner.expand(1.0));
        for curve in self.curves {
            let line = curve.points.iter().map(|&(nm, value)| axes.place(nm, value)).collect();
            let colors = theme::colors(ui.ctx());
            let color = curve.color.map_or(colors.text, |color| legible(color, colors.well));
            inner.line(line, Stroke::new(1.5, color));
        }
        let Some(pointer) = response.hover_pos() else { return response };
        let nm = axes.wavelength(pointer.x);
        painter.vline(
            pointer.x,
            axes.inner.y_range(),
            Stroke::new(1.0, theme::colors(ui.ctx()).faint),
        );
        response.on_hover_text_at_pointer(self.tooltip(nm))
    }

    fn max(&self) -> f64 {
        let values = self.curves.iter().flat_map(|curve| &curve.points);
        let shown = values.filter(|point| BAND_NM.contains(&point.0)).map(|point| point.1);
        let max = self.max.unwrap_or_else(|| shown.fold(0.0, f64::max) * 1.05);
        if max.is_finite() && max > 0.0 { max } else { 1.0 }
    }

    /// Tooltip text: the wavelength and one line for each curve with a value there.
    fn tooltip(&self, nm: f64) -> String {
        let mut lines = vec![format!("{nm:.0} nm")];
        for curve in self.curves {
            if let Some(value) = curve.at(nm) {
                lines.push(format!("{} {value:.3}", curve.name));
            }
        }
        lines.join("\n")
    }
}

/// A line colour, darker if you could not see it on a light background.
fn legible(color: Color32, well: Color32) -> Color32 {
    if contrast(color, well) >= 1.5 {
        return color;
    }
    let [red, green, blue, _] = color.to_array().map(|value| value.saturating_sub(96));
    Color32::from_rgb(red, green, blue)
}

/// Conversion between wavelength and value and screen position.
struct Axes {
    inner: Rect,
    max: f64,
}

impl Axes {
    fn new(whole: Rect, max: f64) -> Self {
        let inner = Rect::from_min_max(whole.min + vec2(30.0, 16.0), whole.max - vec2(10.0, 18.0));
        Self { inner, max }
    }

    fn place(&self, nm: f64, value: f64) -> Pos2 {
        let along = (nm - BAND_NM.start()) / (BAND_NM.end() - BAND_NM.start());
        pos2(
            self.inner.left() + self.inner.width() * along as f32,
            self.inner.bottom() - self.inner.height() * (value / self.max) as f32,
        )
    }

    fn wavelength(&self, x: f32) -> f64 {
        let along = f64::from((x - self.inner.left()) / self.inner.width()).clamp(0.0, 1.0);
        BAND_NM.start() + along * (BAND_NM.end() - BAND_NM.start())
    }

    fn frame(&self, painter: &Painter, quantity: &str) {
        let colors = theme::colors(painter.ctx());
        let font = FontId::proportional(10.0);
        let line = Stroke::new(1.0, colors.line);
        for share in [0.0, 0.5, 1.0] {
            let value = self.max * share;
            let y = self.place(400.0, value).y;
            painter.hline(self.inner.x_range(), y, line);
            let beside = pos2(self.inner.left() - 4.0, y);
            painter.text(beside, Align2::RIGHT_CENTER, short(value), font.clone(), colors.faint);
        }
        for nm in [400.0, 500.0, 600.0, 700.0] {
            let foot = self.place(nm, 0.0);
            painter.vline(foot.x, self.inner.y_range(), line);
            let last = nm == 700.0;
            let text = if last { "700 nm".to_owned() } else { format!("{nm:.0}") };
            let below = pos2(foot.x, foot.y + 3.0);
            painter.text(below, Align2::CENTER_TOP, text, font.clone(), colors.faint);
        }
        let above = pos2(self.inner.left(), self.inner.top() - 14.0);
        painter.text(above, Align2::LEFT_TOP, quantity, font, colors.faint);
    }
}

/// Formats a number with three decimals below 0.1, two below 1, one below 10, else none.
fn short(value: f64) -> String {
    let digits = match value.abs() {
        0.0 => 0,
        size if size < 0.1 => 3,
        size if size < 1.0 => 2,
        size if size < 10.0 => 1,
        _ => 0,
    };
    format!("{value:.digits$}")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ramp() -> Curve {
        let grid = Grid::from_nm(400.0, 100.0, 4).unwrap();
        Curve::new("ramp", grid, &[0.0, 1.0, 2.0, 4.0])
    }

    #[test]
    fn values_are_interpolated_and_not_extrapolated() {
        let curve = ramp();
        assert_eq!(curve.at(400.0), Some(0.0));
        assert_eq!(curve.at(650.0), Some(3.0));
        assert_eq!(curve.at(700.0), Some(4.0));
        assert_eq!((curve.at(399.0), curve.at(701.0)), (None, None));
    }

    #[test]
    fn axis_positions_are_inverse() {
        let axes = Axes::new(Rect::from_min_size(pos2(10.0, 20.0), vec2(240.0, 120.0)), 2.0);
        assert_eq!(axes.place(380.0, 0.0), axes.inner.left_bottom());
        assert_eq!(axes.place(730.0, 2.0), axes.inner.right_top());
        assert!((axes.wavelength(axes.place(555.0, 1.0).x) - 555.0).abs() < 0.01);
    }

    #[test]
    fn the_axis_reaches_the_greatest_value_in_the_band() {
        let mut curve = ramp();
        curve.points.push((800.0, 100.0));
        let curves = [curve];
        let chart = Chart { curves: &curves, marks: &[], quantity: "power", max: None };
        assert!((chart.max() - 4.2).abs() < 1e-9, "{}", chart.max());
        assert_eq!(Chart { max: Some(1.0), ..chart }.max(), 1.0);
        assert_eq!(Chart { curves: &[], ..chart }.max(), 1.0);
    }

    #[test]
    fn the_tooltip_lists_curves_with_a_value() {
        let curves = [ramp()];
        let chart = Chart { curves: &curves, marks: &[], quantity: "power", max: None };
        assert_eq!(chart.tooltip(450.0), "450 nm\nramp 0.500");
        assert_eq!(chart.tooltip(390.0), "390 nm");
    }

    #[test]
    fn light_lines_are_darkened_on_a_light_background() {
        let white = Color32::from_gray(240);
        let yellow = Color32::from_rgb(250, 230, 60);
        for line in [white, yellow] {
            let shown = legible(line, theme::LIGHT.well);
            assert!(contrast(shown, theme::LIGHT.well) > 2.0, "{line:?} as {shown:?}");
            assert_eq!(legible(line, theme::DARK.well), line);
        }
    }

    #[test]
    fn dark_colors_are_brightened() {
        let [dark, bright] = [[10, 20, 30], [200, 0, 30]].map(|rgb| ramp().colored(rgb).color);
        assert_eq!(dark, Some(Color32::from_rgb(106, 116, 126)));
        assert_eq!(bright, Some(Color32::from_rgb(200, 0, 30)));
    }
}
