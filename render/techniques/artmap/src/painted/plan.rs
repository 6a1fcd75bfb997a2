//! A style of painting as data: brush, strokes, paint and canvas of a swatch. Styles are read from
//! TOML files, and some ship with this crate.

use std::path::Path;
use std::str::FromStr;

use documents::hint::{Explain, Fault};
use documents::text::{Source, TextError, read_text};
use paint::BrushSpec;
use paint::ground::GroundSpec;
use serde::{Deserialize, Serialize};

/// Order of the strokes of a coat.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Layout {
    /// Column by column from the left, each from the top: every stroke overlaps its left neighbour.
    Rows,
    /// In random order.
    Scatter,
}

/// Cause of the difference between dark and light tones.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum ToneSource {
    /// Every tone has a mixture of its own.
    Mixture,
    /// Every tone is painted with the darkest mixture. Light tones have fewer strokes.
    Density,
}

/// Strokes of a swatch: their shape, and how they lie beside and above each other.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct StrokePlan {
    /// Length in mm, 0.1 to 1000.
    pub length_mm: f64,
    /// Greatest deviation from the length as a share of it, 0 to 0.9.
    pub length_spread: f64,
    /// Distance of neighbouring strokes across their direction in mm, 0.05 to 100.
    pub spacing_mm: f64,
    /// Distance between the middles of a stroke and the next one below it in mm, 0.1 to 1000.
    pub advance_mm: f64,
    /// Shift of each column against the one left of it, as a share of the advance: 0 aligns the
    /// strokes in bands, 0.5 lays them like bricks, 0 to 1.
    pub stagger: f64,
    /// Greatest displacement of a stroke as a share of spacing and advance, 0 to 1.
    pub jitter: f64,
    /// Standard deviation of the direction from upright in degrees, 0 to 30.
    pub angle_deg: f64,
    /// Greatest sagitta of a bent stroke as a share of its length, 0 to 0.3.
    pub bend: f64,
    /// Pressure in the middle of a stroke, 0.05 to 1.
    pub pressure: f64,
    /// Greatest deviation from the pressure as a share of it, 0 to 0.5.
    pub pressure_spread: f64,
    /// Pressure at the end of a stroke as a share of that in its middle, 0 to 1.
    pub lift: f64,
    /// Order in which strokes are painted.
    pub layout: Layout,
    /// Number of coats, 1 to 4. The paint dries between them, except the wet share.
    pub coats: u32,
    /// Whether all tones have the same strokes. If not, each has strokes of a seed of its own.
    pub nested: bool,
}

/// Paint of the strokes.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PaintPlan {
    /// Height of an even film of the tone below the first coat in mm, so that gaps between strokes
    /// show no bare ground, 0 to 1. Absent is 0, none.
    #[serde(default)]
    pub underpainting_mm: f64,
    /// Height of the paint on the head of the loaded brush in mm, 0.001 to 5.
    pub load_mm: f64,
    /// Greatest deviation from the load as a share of it, 0 to 0.9.
    pub load_spread: f64,
    /// Share of clear medium in the paint, 0 to 0.95.
    pub vehicle: f64,
    /// Stiffness of the paint: 0 is stand oil, 1 is putty.
    pub stiffness: f64,
    /// Greatest deviation of a stroke from the L* of its tone, 0 to 20.
    pub lightness_spread: f64,
    /// Greatest deviation of the hairs of a half-mixed brush from the L* of their stroke, 0 to 20.
    pub streaks: f64,
    /// Share of the paint of a coat that is still wet under the next one, 0 to 1.
    pub wet_in_wet: f64,
    /// Cause of the difference between tones.
    pub tones: ToneSource,
    /// Share of the strokes that the lightest tone has where tones differ by density, 0.01 to 1.
    pub lightest_share: f64,
}

/// Canvas of a swatch.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CanvasPlan {
    /// Width and height of a cell in mm, 0.02 to 2.
    pub cell_mm: f64,
    /// Cells along each side of the swatch, 16 to 2048.
    pub side_cells: usize,
    /// Ground with its relief and colour, as a script of strokes describes it.
    pub ground: GroundSpec,
}

/// Style of painting: everything but the colours of a set of swatches.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Style {
    /// Name of the style.
    pub name: String,
    /// Seed of all random choices.
    pub seed: u64,
    /// Shape and width of the brush.
    pub brush: BrushSpec,
    /// Strokes of a swatch.
    pub strokes: StrokePlan,
    /// Paint of the strokes.
    pub paint: PaintPlan,
    /// Canvas of a swatch.
    pub canvas: CanvasPlan,
}

/// Most cells of the canvas of a swatch: 4096 x 4096.
const MOST_CELLS: f64 = 16_777_216.0;
/// Most strokes of a swatch.
const MOST_STROKES: f64 = 200_000.0;

impl Style {
    /// Names of the styles that ship, in the order in which programs list them.
    pub const ALL: [&str; NAMES.len()] = NAMES;

    /// Shipped style with this name.
    ///
    /// # Errors
    /// [`StyleError::Unknown`] if there is none.
    pub fn named(name: &str) -> Result<Self, StyleError> {
        Self::from_toml(name, Self::text(name)?)
    }

    /// TOML text of the shipped style with this name, to be copied and changed.
    ///
    /// # Errors
    /// [`StyleError::Unknown`] if there is none.
    pub fn text(name: &str) -> Result<&'static str, StyleError> {
        let found = SHIPPED.iter().find(|(known, _)| *known == name);
        found.map(|(_, text)| *text).ok_or_else(|| StyleError::Unknown { name: name.to_owned() })
    }

    /// Reads the TOML file of a style and checks it.
    ///
    /// # Errors
    /// [`StyleError`] for a file that cannot be read, and the errors of [`Style::from_toml`].
    pub fn open(path: &Path) -> Result<Self, StyleError> {
        Self::from_toml(&path.display().to_string(), &read_text(path)?)
    }

    /// Parses and checks the TOML text of a style. Errors call the file `file`.
    ///
    /// # Errors
    /// [`StyleError`] for text that is no TOML, unknown or missing keys, and numbers out of range.
    pub fn from_toml(file: &str, text: &str) -> Result<Self, StyleError> {
        let style: Self = Source::toml(file, text)?.typed()?;
        style.check()?;
        Ok(style)
    }

    /// Checks the ranges of all numbers.
    ///
    /// # Errors
    /// [`StyleError::Number`] for the first number that is out of its range.
    pub fn check(&self) -> Result<(), StyleError> {
        let Self { name, brush, strokes, paint, canvas, .. } = self;
        for (key, value, least, most) in [
            ("brush.size_mm", brush.size_mm, 0.2, 100.0),
            ("strokes.length_mm", strokes.length_mm, 0.1, 1000.0),
            ("strokes.length_spread", strokes.length_spread, 0.0, 0.9),
            ("strokes.spacing_mm", strokes.spacing_mm, 0.05, 100.0),
            ("strokes.advance_mm", strokes.advance_mm, 0.1, 1000.0),
            ("strokes.stagger", strokes.stagger, 0.0, 1.0),
            ("strokes.jitter", strokes.jitter, 0.0, 1.0),
            ("strokes.angle_deg", strokes.angle_deg, 0.0, 30.0),
            ("strokes.bend", strokes.bend, 0.0, 0.3),
            ("strokes.pressure", strokes.pressure, 0.05, 1.0),
            ("strokes.pressure_spread", strokes.pressure_spread, 0.0, 0.5),
            ("strokes.lift", strokes.lift, 0.0, 1.0),
            ("strokes.coats", f64::from(strokes.coats), 1.0, 4.0),
            ("paint.load_mm", paint.load_mm, 0.001, 5.0),
            ("paint.load_spread", paint.load_spread, 0.0, 0.9),
            ("paint.vehicle", paint.vehicle, 0.0, 0.95),
            ("paint.stiffness", paint.stiffness, 0.0, 1.0),
            ("paint.lightness_spread", paint.lightness_spread, 0.0, 20.0),
            ("paint.streaks", paint.streaks, 0.0, 20.0),
            ("paint.wet_in_wet", paint.wet_in_wet, 0.0, 1.0),
            ("paint.underpainting_mm", paint.underpainting_mm, 0.0, 1.0),
            ("paint.lightest_share", paint.lightest_share, 0.01, 1.0),
            ("canvas.cell_mm", canvas.cell_mm, 0.02, 2.0),
            ("canvas.side_cells", canvas.side_cells as f64, 16.0, 2048.0),
        ] {
            if !(least..=most).contains(&value) {
                let style = name.clone();
                return Err(StyleError::Number { style, key, value, least, most });
            }
        }
        self.check_effort()
    }

    /// Refuses a canvas or a number of strokes that no machine paints in reasonable time.
    fn check_effort(&self) -> Result<(), StyleError> {
        let (across, along) = self.margins();
        let [width, height] = [across, along].map(|margin| self.canvas.side_cells + 2 * margin);
        let mm = |cells: usize| cells as f64 * self.canvas.cell_mm;
        let columns = mm(width) / self.strokes.spacing_mm + 1.0;
        let rows = mm(height) / self.strokes.advance_mm + 2.0;
        let strokes = f64::from(self.strokes.coats) * columns * rows;
        let cells = width as f64 * height as f64;
        for (what, found, most) in
            [("cells with its margins", cells, MOST_CELLS), ("strokes", strokes, MOST_STROKES)]
        {
            if found > most {
                let style = self.name.clone();
                return Err(StyleError::TooLarge { style, what, found, most });
            }
        }
        Ok(())
    }

    /// Cells that lie beyond each side of a swatch on its canvas, across and along the strokes:
    /// two strokes across, and a whole stroke along, so that no stroke of the swatch ends at the
    /// edge.
    #[must_use]
    pub fn margins(&self) -> (usize, usize) {
        let Self { strokes, brush, .. } = self;
        let across = 2.0 * brush.size_mm.max(strokes.spacing_mm);
        let along = strokes.length_mm * (1.0 + strokes.length_spread) + 2.0 * brush.size_mm;
        let cells = |mm: f64| (mm / self.canvas.cell_mm).ceil() as usize;
        (cells(across), cells(along))
    }

    /// Distance of neighbouring strokes in cells.
    #[must_use]
    pub fn spacing_cells(&self) -> f64 {
        self.strokes.spacing_mm / self.canvas.cell_mm
    }
}

impl FromStr for Style {
    type Err = StyleError;

    fn from_str(name: &str) -> Result<Self, StyleError> {
        Self::named(name)
    }
}

/// A style cannot be used.
#[derive(Debug, Clone, PartialEq, thiserror::Error, Explain)]
#[fault(Setting)]
pub enum StyleError {
    /// The file cannot be read, is no TOML, or has an unknown or missing key.
    #[error(transparent)]
    #[hint(if matches!(_0, TextError::File(_)), inner)]
    #[hint("begin with the text of a style that ships: [show_style=oil-flat]")]
    #[fault(with = if matches!(_0, TextError::File(_)) { _0.fault() } else { Fault::Setting })]
    Text(#[from] TextError),
    /// No style that ships has this name.
    #[error("there is no style called `{name}`")]
    #[hint("choose [style] among {}", NAMES.join(", "))]
    Unknown {
        /// Name that was looked up.
        name: String,
    },
    /// A number is out of its range.
    #[error("style {style}: {key} is {least} to {most}, found `{value}`")]
    Number {
        /// Name of the style.
        style: String,
        /// Group and key of the number.
        key: &'static str,
        /// Value of the number.
        value: f64,
        /// Least value allowed.
        least: f64,
        /// Greatest value allowed.
        most: f64,
    },
    /// A swatch would take too much memory or time.
    #[hint("take larger cells, wider spacing or shorter strokes")]
    #[error("style {style}: a swatch has at most {most} {what}, found `{found:.0}`")]
    TooLarge {
        /// Name of the style.
        style: String,
        /// Items that are too many.
        what: &'static str,
        /// Number of the items.
        found: f64,
        /// Greatest number allowed.
        most: f64,
    },
}

/// Names and TOML files of the styles, in the order in which programs list them.
pub(super) const SHIPPED: [(&str, &str); 6] = [
    ("oil-flat", include_str!("styles/oil-flat.toml")),
    ("oil-long", include_str!("styles/oil-long.toml")),
    ("dabs", include_str!("styles/dabs.toml")),
    ("knife", include_str!("styles/knife.toml")),
    ("hatching", include_str!("styles/hatching.toml")),
    ("dry-brush", include_str!("styles/dry-brush.toml")),
];

/// Names of the styles.
pub(super) const NAMES: [&str; SHIPPED.len()] = {
    let mut names = [""; SHIPPED.len()];
    let mut at = 0;
    while at < names.len() {
        names[at] = SHIPPED[at].0;
        at += 1;
    }
    names
};

#[cfg(test)]
mod tests {
    use super::*;
    use documents::hint::Explain;

    #[test]
    fn shipped_styles_are_valid_have_their_names_and_come_back_from_toml() {
        for name in Style::ALL {
            let style = Style::named(name).unwrap();
            assert_eq!(style.name, name);
            let text = toml::to_string(&style).unwrap();
            assert_eq!(Style::from_toml("back", &text), Ok(style));
        }
    }

    #[test]
    fn a_copy_of_a_shipped_style_is_a_style_of_its_own() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("mine.toml");
        let text =
            Style::text("knife").unwrap().replace("\"knife\"\nseed = 1", "\"mine\"\nseed = 9");
        std::fs::write(&path, text).unwrap();
        let mine = Style { name: "mine".to_owned(), seed: 9, ..Style::named("knife").unwrap() };
        assert_eq!(Style::open(&path), Ok(mine));
        std::fs::write(&path, [0xff, 0xfe]).unwrap();
        let error = Style::open(&path).unwrap_err();
        assert!(error.to_string().contains("mine.toml"), "{error}");
        let error = Style::open(&folder.path().join("no.toml")).unwrap_err();
        assert!(error.to_string().contains("no.toml: cannot be read"), "{error}");
        assert_eq!(error.fault(), Fault::Environment);
    }

    #[test]
    fn bad_styles_are_refused_with_their_place() {
        let error = Style::named("oil-paint").unwrap_err();
        assert_eq!(error.to_string(), "there is no style called `oil-paint`");
        assert!(error.hint().unwrap().to_string().contains("oil-flat, oil-long"));

        let text = toml::to_string(&Style::named("dabs").unwrap()).unwrap();
        let wide = text.replace("jitter = ", "jitter = 1");
        let error = Style::from_toml("my.toml", &wide).unwrap_err();
        assert!(matches!(error, StyleError::Number { key: "strokes.jitter", .. }), "{error}");
        let unknown = text.replace("jitter = ", "gitter = ");
        let error = Style::from_toml("my.toml", &unknown).unwrap_err();
        assert!(error.to_string().starts_with("my.toml, line "), "{error}");
        let fine = text.replace("cell_mm = 0.18", "cell_mm = 0.02");
        let long = fine.replace("length_mm = 3.5", "length_mm = 1000.0");
        let error = Style::from_toml("my.toml", &long).unwrap_err();
        assert!(error.to_string().contains("cells with its margins"), "{error}");
        let dense = text.replace("spacing_mm = 2.2", "spacing_mm = 0.05");
        let dense = dense.replace("advance_mm = 4.0", "advance_mm = 0.1");
        let error = Style::from_toml("my.toml", &dense).unwrap_err();
        assert!(error.to_string().contains("at most 200000 strokes"), "{error}");
        let nan = text.replace("stiffness = ", "stiffness = nan # ");
        let error = Style::from_toml("my.toml", &nan).unwrap_err();
        assert!(matches!(error, StyleError::Number { key: "paint.stiffness", .. }), "{error}");
    }
}
