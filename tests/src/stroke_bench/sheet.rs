//! The picture sheet: the strokes of each case from above under two lights, sections through the
//! paint, and the figures beside them.

use std::fmt::Write;

use image::imageops::{FilterType, overlay, resize};
use image::{Rgb, RgbImage};
use reports::picture::{PictureError, png};
use reports::style::{Color, FAINT, GRID, INK, PAPER, SERIES};
use reports::svg::{escaped, opening};

use super::report::{CaseReport, Curve, Panel, bounds, number, verdict};

/// Width of the sheet in units. The PNG has two pixels per unit.
const WIDTH: f64 = 1180.0;
const SCALE: f64 = 2.0;
/// Units per mm of canvas if nothing is magnified: six pixels of the PNG.
const PER_MM: f64 = 3.0;
const MARGIN: f64 = 14.0;
const GAP: f64 = 16.0;
const HEADER: f64 = 34.0;
const FIGURES: f64 = 800.0;
const LINE: f64 = 12.5;
const TEXT: f64 = 9.5;
const CURVE: f64 = 42.0;
const NARROWEST: f64 = 170.0;

impl Panel {
    fn width(&self) -> f64 {
        (self.per_mm() * self.size_mm.0).max(NARROWEST)
    }

    /// Units per mm.
    fn per_mm(&self) -> f64 {
        PER_MM * self.zoom
    }

    fn height(&self) -> f64 {
        let pictures = self.pictures.len() as f64 * (self.per_mm() * self.size_mm.1 + 3.0);
        LINE + 4.0 + pictures + self.curves.len() as f64 * (CURVE + LINE + 4.0)
    }
}

/// Upper left corners of the panels, arranged in lines, and the lower end of the last line.
fn places(panels: &[Panel]) -> (Vec<(f64, f64)>, f64) {
    let mut x = MARGIN;
    let mut y = HEADER;
    let mut line = 0.0;
    let mut places = Vec::new();
    for panel in panels {
        if x > MARGIN && x + panel.width() > FIGURES - GAP {
            (x, y, line) = (MARGIN, y + line + GAP, 0.0);
        }
        places.push((x, y));
        x += panel.width() + GAP;
        line = f64::max(line, panel.height());
    }
    (places, y + line)
}

/// Drawing of text and lines as SVG.
struct Drawing(String);

impl Drawing {
    fn text(&mut self, (x, y): (f64, f64), size: f64, anchor: &str, color: Color, text: &str) {
        let color = color.hex();
        let text = escaped(text);
        let _ = writeln!(
            self.0,
            r#"<text x="{x:.1}" y="{y:.1}" font-size="{size}" text-anchor="{anchor}" fill="{color}">{text}</text>"#
        );
    }

    fn line(&mut self, points: &[(f64, f64)], width: f64, color: Color) {
        let mut path = String::new();
        for (x, y) in points {
            let _ = write!(path, "{x:.2},{y:.2} ");
        }
        let color = color.hex();
        let _ = writeln!(
            self.0,
            r#"<polyline points="{path}" fill="none" stroke="{color}" stroke-width="{width}"/>"#
        );
    }

    /// Draws a section from the upper left corner `at`, `width` units wide.
    fn curve(&mut self, curve: &Curve, (x, y): (f64, f64), width: f64) {
        let highest = curve.lines.iter().flatten().fold(1e-9, |a: f64, &b| a.max(b));
        let count = curve.lines.iter().map(Vec::len).max().unwrap_or(0).max(2);
        let length = curve.step_mm * count as f64;
        let label = format!("{} {length:.0} mm, up to {} mm high", curve.caption, number(highest));
        self.text((x, y + LINE - 3.0), 7.5, "start", FAINT, &label);
        let top = y + LINE;
        let bottom = y + LINE + CURVE;
        for level in [top, bottom] {
            self.line(&[(x, level), (x + width, level)], 0.5, GRID);
        }
        let styles = [(0.5, SERIES[1]), (1.1, SERIES[0])];
        for (line, (stroke, color)) in curve.lines.iter().zip(styles) {
            self.line(
                &line
                    .iter()
                    .enumerate()
                    .map(|(index, mm): (usize, &f64)| {
                        let right = x + width * index as f64 / (count - 1) as f64;
                        (right, bottom - CURVE * mm / highest)
                    })
                    .collect::<Vec<_>>(),
                stroke,
                color,
            );
        }
    }

    fn figures(&mut self, report: &CaseReport) {
        for (index, figure) in report.figures.iter().enumerate() {
            let y = HEADER + LINE * (index as f64 + 0.8);
            let met = figure.is_met();
            let color = match met {
                Some(true) => SERIES[2],
                Some(false) => SERIES[1],
                None => INK,
            };
            self.text((FIGURES, y), TEXT, "start", INK, figure.name.trim());
            let value = format!("{} {}", number(figure.value), figure.unit);
            self.text((FIGURES + 262.0, y), TEXT, "end", color, value.trim());
            self.text((FIGURES + 274.0, y), TEXT, "start", FAINT, &bounds(figure.wanted));
            self.text((WIDTH - MARGIN, y), TEXT, "end", color, verdict(figure));
        }
    }
}

/// The part of the sheet with one case.
///
/// # Errors
/// [`PictureError`] if the text cannot be drawn.
///
/// # Panics
/// Never: the drawing is a PNG.
pub fn picture(report: &CaseReport) -> Result<RgbImage, PictureError> {
    let (places, panels_end) = places(&report.panels);
    let figures_end = HEADER + LINE * report.figures.len() as f64;
    let height = (panels_end.max(figures_end) + GAP).ceil();
    let mut drawing = Drawing(opening(WIDTH as u32, height as u32, 1));
    let width = WIDTH;
    let paper = PAPER.hex();
    let _ = writeln!(drawing.0, r#"<rect width="{width}" height="{height:.0}" fill="{paper}"/>"#);
    drawing.line(&[(0.0, 2.0), (WIDTH, 2.0)], 1.0, GRID);
    drawing.text((MARGIN, 21.0), 13.0, "start", INK, report.title);
    let legend =
        "from above, light at 50 and 20 degrees; sections: orange in the middle, blue mean";
    drawing.text((WIDTH - MARGIN, 20.0), TEXT, "end", FAINT, legend);
    drawing.figures(report);
    let mut pictures = Vec::new();
    for (panel, &(x, y)) in report.panels.iter().zip(&places) {
        drawing.text((x, y + LINE - 2.0), TEXT, "start", INK, &panel.caption);
        let mut below = y + LINE + 4.0;
        for picture in &panel.pictures {
            pictures.push((picture, (x, below), panel));
            below += panel.per_mm() * panel.size_mm.1 + 3.0;
        }
        for curve in &panel.curves {
            drawing.curve(curve, (x, below), panel.width());
            below += CURVE + LINE + 4.0;
        }
    }
    drawing.0.push_str("</svg>\n");
    let text = image::load_from_memory(&png(&drawing.0)?).expect("a PNG of the drawing");
    let mut sheet = text.to_rgb8();
    for (picture, (x, y), panel) in pictures {
        let [width, height] = [panel.size_mm.0, panel.size_mm.1]
            .map(|mm| (SCALE * panel.per_mm() * mm).round() as u32);
        // If a cell is larger than a pixel, it should stay a square.
        let larger = width > 2 * picture.width();
        let filter = if larger { FilterType::Nearest } else { FilterType::Triangle };
        let scaled = resize(picture, width, height, filter);
        overlay(&mut sheet, &scaled, (SCALE * x) as i64, (SCALE * y) as i64);
    }
    Ok(sheet)
}

/// The whole sheet: all cases in order, in up to three columns of about equal height.
///
/// # Errors
/// [`PictureError`] if the text cannot be drawn.
pub fn sheet(reports: &[CaseReport]) -> Result<RgbImage, PictureError> {
    let pictures = reports.iter().map(picture).collect::<Result<Vec<_>, _>>()?;
    let whole: u32 = pictures.iter().map(RgbImage::height).sum();
    let width = (SCALE * WIDTH) as u32;
    let mut column = 0;
    let mut y = 0;
    let mut tallest = 1;
    let mut places = Vec::new();
    for picture in &pictures {
        if column < 2 && y > 0 && 3 * (y + picture.height() / 2) > whole {
            (column, y) = (column + 1, 0);
        }
        places.push((column * width, y));
        y += picture.height();
        tallest = tallest.max(y);
    }
    let mut sheet = RgbImage::from_pixel((column + 1) * width, tallest, Rgb(PAPER.0));
    for (picture, (x, y)) in pictures.iter().zip(places) {
        overlay(&mut sheet, picture, i64::from(x), i64::from(y));
    }
    Ok(sheet)
}

#[cfg(test)]
mod tests {
    use super::super::report::Figure;
    use super::*;

    #[test]
    fn pictures_lie_where_the_sheet_shows_them_and_lines_of_panels_do_not_overlap() {
        let red = RgbImage::from_pixel(200, 100, Rgb([200, 0, 0]));
        let line = vec![vec![0.1; 20], vec![0.2; 20]];
        let curve = Curve { caption: "across", step_mm: 0.1, lines: line };
        let panel = Panel {
            caption: "a stroke".to_owned(),
            size_mm: (80.0, 20.0),
            zoom: 1.0,
            pictures: vec![red],
            curves: vec![curve],
        };
        let figures = vec![Figure::new("film", 0.2, "mm").at_least(0.1)];
        let panels = vec![panel; 5];
        let report = CaseReport { name: "one", title: "One stroke", figures, panels };
        let (places, _) = places(&report.panels);
        assert_eq!(places[0].1, places[2].1, "three in a line");
        assert_eq!(places[3].1, places[0].1 + report.panels[0].height() + GAP);
        let picture = picture(&report).unwrap();
        for (x, y) in places {
            let [x, y] = [x + 100.0, y + LINE + 20.0].map(|units| (SCALE * units) as u32);
            assert_eq!(
                *picture.get_pixel(x, y),
                Rgb([200, 0, 0]),
                "each picture lies in its panel"
            );
        }
        let corner = picture.get_pixel(0, picture.height() - 1);
        assert_eq!(*corner, Rgb(PAPER.0), "paper up to the last row");
        fn ink(pixels: &RgbImage) -> usize {
            pixels.pixels().filter(|pixel| pixel.0[0] < 0x60).count()
        }
        assert!(ink(&picture) > 500, "there is text");
        let sheet = sheet(&vec![report; 6]).unwrap();
        assert_eq!(sheet.dimensions(), (3 * picture.width(), 2 * picture.height()));
        let ends = sheet.get_pixel(5 * SCALE as u32, 0) == picture.get_pixel(5 * SCALE as u32, 0);
        assert!(ends && ink(&sheet) == 6 * ink(&picture), "all six are shown");
    }
}
