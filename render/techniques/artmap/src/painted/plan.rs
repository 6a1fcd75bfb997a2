//! A style of painting as data: brush, strokes, paint and canvas of a swatch. Styles are read from
//! TOML files, and some ship with this crate.

use std::path::Path;
use std::str::FromStr;

use documents::excerpt;
use documents::hint::Explain;
use documents::settings::{OutOfRange, out_of_range};
use documents::text::{Source, TextError, read_text};
use paint::HeadShape;
use paint::ground::{ColorPrimer, GroundKind, GroundSpec, Primer};
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

documents::settings! {
    /// Style of painting: everything but the colours of a set of swatches.
    pub struct Style {
        name: String = "own".to_owned(), Text => "Name of the style";
        seed: u64 = 1, Any => "Seed of all random choices";
        [brush]: BrushPlan => "the brush";
        [strokes]: StrokePlan => "strokes of a swatch";
        [paint]: PaintPlan => "paint of the strokes";
        [canvas]: CanvasPlan => "canvas of a swatch";
    }
}

documents::presets! {
    /// A style that ships with this crate.
    pub enum StylePreset of Style {
        OilFlat = "oil-flat", "styles/oil-flat.toml" => "Short strokes of a flat brush in stiff oil paint, like bricks.";
        OilLong = "oil-long", "styles/oil-long.toml" => "Long, slightly bent strokes of a filbert side by side, wet into wet within a coat.";
        Dabs = "dabs", "styles/dabs.toml" => "Single touches of a round brush, close together in random order.";
        Knife = "knife", "styles/knife.toml" => "Broad, sharp-edged slabs, drawn out with a painting knife.";
        Hatching = "hatching", "styles/hatching.toml" => "Parallel thin lines of a rigger on white paper; dark tones have more lines.";
        DryBrush = "dry-brush", "styles/dry-brush.toml" => "A nearly dry bright drawn lightly over the grain of paper, which stays open in the hollows.";
    }
}

documents::settings! {
    /// Shape and width of the brush.
    pub struct BrushPlan {
        shape: HeadShape = HeadShape::Flat, Words(&["round", "flat", "filbert", "bright", "fan", "rigger", "mop", "knife"]) => "Shape of its head";
        size_mm: f64 = 5.0, Number(0.2, 100.0), "mm" => "Width of its mark at half pressure";
    }
}

documents::settings! {
    /// Strokes of a swatch: their shape, and how they lie beside and above each other.
    pub struct StrokePlan {
        length_mm: f64 = 16.0, Number(0.1, 1000.0), "mm" => "Length";
        length_spread: f64 = 0.25, Number(0.0, 0.9) => "Greatest deviation from the length as a share of it";
        spacing_mm: f64 = 4.0, Number(0.05, 100.0), "mm" => "Distance of neighbouring strokes across their direction";
        advance_mm: f64 = 12.0, Number(0.1, 1000.0), "mm" => "Distance between the middles of a stroke and the next one below it";
        stagger: f64 = 0.5, Number(0.0, 1.0) => "Shift of each column against the one left of it, as a share of the advance: 0 aligns the strokes in bands, 0.5 lays them like bricks";
        jitter: f64 = 0.35, Number(0.0, 1.0) => "Greatest displacement of a stroke as a share of spacing and advance";
        angle_deg: f64 = 5.0, Number(0.0, 30.0), "degrees" => "Standard deviation of the direction from upright";
        bend: f64 = 0.03, Number(0.0, 0.3) => "Greatest sagitta of a bent stroke as a share of its length";
        pressure: f64 = 0.55, Number(0.05, 1.0) => "Pressure in the middle of a stroke";
        pressure_spread: f64 = 0.15, Number(0.0, 0.5) => "Greatest deviation from the pressure as a share of it";
        lift: f64 = 0.35, Number(0.0, 1.0) => "Pressure at the end of a stroke as a share of the pressure in its middle";
        layout: Layout = Layout::Scatter, Words(&["rows", "scatter"]) => "Order in which strokes are painted";
        coats: u32 = 3, Whole(1, 4) => "Number of coats; the paint dries between them, except the wet share";
        nested: bool = true, Switch => "Whether all tones have the same strokes; if not, each has strokes of a seed of its own";
    }
}

documents::settings! {
    /// Paint of the strokes.
    pub struct PaintPlan {
        underpainting_mm: f64 = 0.0, Number(0.0, 1.0), "mm" => "Height of an even film of the tone below the first coat, so that gaps between strokes show no bare ground; 0 has none";
        load_mm: f64 = 0.5, Number(0.001, 5.0), "mm" => "Height of the paint on the head of the loaded brush";
        load_spread: f64 = 0.3, Number(0.0, 0.9) => "Greatest deviation from the load as a share of it";
        vehicle: f64 = 0.05, Number(0.0, 0.95) => "Share of clear medium in the paint";
        stiffness: f64 = 0.8, Number(0.0, 1.0) => "Stiffness of the paint: 0 is stand oil, 1 is putty";
        lightness_spread: f64 = 7.0, Number(0.0, 20.0), "L*" => "Greatest deviation of a stroke from the lightness of its tone";
        streaks: f64 = 6.0, Number(0.0, 20.0), "L*" => "Greatest deviation of the hairs of a half-mixed brush from the lightness of their stroke";
        wet_in_wet: f64 = 0.0, Number(0.0, 1.0) => "Share of the paint of a coat that is still wet under the next one";
        tones: ToneSource = ToneSource::Mixture, Words(&["mixture", "density"]) => "Cause of the difference between tones: a mixture for each, or fewer strokes of the darkest";
        lightest_share: f64 = 1.0, Number(0.01, 1.0) => "Share of the strokes that the lightest tone has where tones differ by density";
    }
}

documents::settings! {
    /// Canvas of a swatch.
    pub struct CanvasPlan {
        cell_mm: f64 = 0.25, Number(0.02, 2.0), "mm" => "Width and height of a cell";
        side_cells: usize = 300, Whole(16, 2048), "cells" => "Cells along each side of the swatch";
        ground: GroundSpec = umber_panel(), Inline => "Ground with its relief and colour, as a script of strokes describes it";
    }
}

/// A panel in a middle brown.
fn umber_panel() -> GroundSpec {
    let brown = Primer::Color(ColorPrimer { rgb: "#7d6f5c".to_owned() });
    GroundSpec { reflectance: Some(brown), ..GroundKind::Panel.spec(1) }
}

/// Most cells of the canvas of a swatch: 4096 x 4096.
const MOST_CELLS: f64 = 16_777_216.0;
/// Most strokes of a swatch.
const MOST_STROKES: f64 = 200_000.0;

impl Style {
    /// Names of the styles that ship, in the order in which programs list them.
    pub const ALL: [&str; StylePreset::ALL.len()] = {
        let mut names = [""; StylePreset::ALL.len()];
        let mut at = 0;
        while at < names.len() {
            names[at] = StylePreset::ALL[at].name();
            at += 1;
        }
        names
    };

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
        let preset: Result<StylePreset, _> = name.parse();
        preset.map(StylePreset::changes).map_err(|_| StyleError::Unknown(name.to_owned()))
    }

    /// Reads the TOML file of a style and checks it.
    ///
    /// # Errors
    /// [`StyleError`] for a file that cannot be read, and the errors of [`Style::from_toml`].
    pub fn open(path: &Path) -> Result<Self, StyleError> {
        Self::from_toml(&path.display().to_string(), &read_text(path)?)
    }

    /// Parses and checks the TOML text of a style. `file` is the name of the file in errors.
    ///
    /// # Errors
    /// [`StyleError`] for text that is no TOML, unknown or missing keys, and numbers out of range.
    pub fn from_toml(file: &str, text: &str) -> Result<Self, StyleError> {
        let style: Self = Source::toml(file, text)?.typed()?;
        style.check().map_err(|error| error.of_file(file))?;
        Ok(style)
    }

    /// Checks the ranges of all numbers.
    ///
    /// # Errors
    /// [`StyleError::Number`] for the first number that is out of its range.
    pub fn check(&self) -> Result<(), StyleError> {
        if let Some(OutOfRange { key, value, least, most, .. }) = out_of_range(self) {
            let style = format!("style {}", excerpt(&self.name));
            return Err(StyleError::Number { style, key, value, least, most });
        }
        self.check_effort()
    }

    /// Refuses a canvas or a number of strokes that no machine paints in reasonable time.
    fn check_effort(&self) -> Result<(), StyleError> {
        let (across, along) = self.margins();
        let [width, height] = [across, along].map(|margin| self.canvas.side_cells + 2 * margin);
        let columns = width as f64 * self.canvas.cell_mm / self.strokes.spacing_mm + 1.0;
        let rows = height as f64 * self.canvas.cell_mm / self.strokes.advance_mm + 2.0;
        let strokes = f64::from(self.strokes.coats) * columns * rows;
        let cells = width as f64 * height as f64;
        for (what, found, most) in
            [("cells with its margins", cells, MOST_CELLS), ("strokes", strokes, MOST_STROKES)]
        {
            if found > most {
                let style = format!("style {}", excerpt(&self.name));
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
        [across, along].map(|mm| (mm / self.canvas.cell_mm).ceil() as usize).into()
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
pub enum StyleError {
    /// The file cannot be read, is no TOML, or has an unknown or missing key.
    #[error(transparent)]
    #[hint(if matches!(_0, TextError::File(_)), inner)]
    #[hint("begin with the text of a style that ships: [show_style=oil-flat]")]
    #[fault(inner)]
    Text(#[from] TextError),
    /// No style that ships has this name.
    #[error("there is no style called `{0}`")]
    #[hint("choose [style] among {}", Style::ALL.join(", "))]
    #[fault(Setting)]
    Unknown(String),
    /// A number is out of its range.
    #[error("{style}: {key} is {least} to {most}, found `{value}`")]
    Number {
        /// The style by its name, after its file if it has one.
        style: String,
        /// Group and key of the number.
        key: String,
        /// Value of the number.
        value: f64,
        /// Least value allowed.
        least: f64,
        /// Greatest value allowed.
        most: f64,
    },
    /// A swatch would take too much memory or time.
    #[hint("take larger cells, wider spacing or shorter strokes")]
    #[error("{style}: a swatch has at most {most} {what}, found `{found:.0}`")]
    TooLarge {
        /// The style by its name, after its file if it has one.
        style: String,
        /// The items of which there are too many: cells or strokes.
        what: &'static str,
        /// Number of the items.
        found: f64,
        /// Greatest number allowed.
        most: f64,
    },
}

impl StyleError {
    /// The error of a style in `file`.
    fn of_file(mut self, file: &str) -> Self {
        if let Self::Number { style, .. } | Self::TooLarge { style, .. } = &mut self {
            *style = format!("{file}, {style}");
        }
        self
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use documents::hint::Fault;

    #[test]
    fn shipped_styles_are_valid_have_their_names_and_come_back_from_toml() {
        for name in Style::ALL {
            let style = Style::named(name).unwrap();
            assert_eq!(style.name, name);
            let text = toml::to_string(&style).unwrap();
            assert_eq!(Style::from_toml("back", &text), Ok(style));
        }
        for preset in StylePreset::ALL {
            assert_eq!(Style::named(preset.name()), Ok(preset.settings()));
            assert_eq!(Style::from_toml("all", &preset.text()), Ok(preset.settings()));
            let title = format!("# {}\n", preset.about());
            assert!(preset.changes().starts_with(&title), "{title}");
        }
        let mut usual = Style { name: "oil-flat".to_owned(), ..Style::default() };
        usual.paint.underpainting_mm = 0.05;
        assert_eq!(Style::named("oil-flat"), Ok(usual));
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
        assert!(error.to_string().starts_with("my.toml, style dabs: strokes.jitter is 0 to 1"));
        assert_eq!(error.fault(), Fault::Input);
        let unknown = text.replace("jitter = ", "gitter = ");
        let error = Style::from_toml("my.toml", &unknown).unwrap_err();
        assert!(error.to_string().starts_with("my.toml, line "), "{error}");
        assert_eq!(error.fault(), Fault::Input);
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
        assert!(error.to_string().ends_with("paint.stiffness is 0 to 1, found `NaN`"), "{error}");
    }
}
