//! The canvas of a new painting as data: its format, its ground, and the canvases kept for the next
//! painting.
//!
//! Paper has the sizes of ISO 216 and US Letter (ANSI/ASME Y14.1). For French canvases by number
//! (figure, paysage, marine) see B. Haaf, "Industriell vorgrundierte Malleinen", Zeitschrift fuer
//! Kunsttechnologie und Konservierung 1 (1987), 7-71, as tabulated in Wikipedia, "French standard
//! sizes for oil paintings".

use std::path::PathBuf;

use paint::ground::{GroundKind, GroundRelief, Primer, PrimerFilm, TonedPrimer};
use paint::strokes::Canvas;
use pigment::evaluate::Viewing;
use pigment::library::PigmentLibrary;
use serde::{Deserialize, Serialize};
use spectra::color::{Adaptation, RgbSpace};

use crate::language::english;

/// A unit of lengths.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum LengthUnit {
    /// Lengths in millimetres.
    #[default]
    Mm,
    /// Lengths in centimetres.
    Cm,
    /// Inches of 25.4 mm.
    Inch,
}

impl LengthUnit {
    pub(crate) const ALL: [Self; 3] = [Self::Mm, Self::Cm, Self::Inch];

    #[must_use]
    pub(crate) fn sign(self) -> &'static str {
        match self {
            Self::Mm => "mm",
            Self::Cm => "cm",
            Self::Inch => "in",
        }
    }

    /// Length of one unit in mm.
    #[must_use]
    pub(crate) fn in_mm(self) -> f64 {
        match self {
            Self::Mm => 1.0,
            Self::Cm => 10.0,
            Self::Inch => 25.4,
        }
    }
}

#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Format {
    /// Heading in the list.
    pub(crate) group: &'static str,
    pub(crate) name: &'static str,
    pub(crate) long_mm: f64,
    pub(crate) short_mm: f64,
}

impl Format {
    /// The format of a canvas, upright or across; `None` for any other size.
    #[must_use]
    pub(crate) fn of(width_mm: f64, height_mm: f64) -> Option<&'static Self> {
        let long = width_mm.max(height_mm);
        let short = width_mm.min(height_mm);
        FORMATS
            .iter()
            .find(|own| (own.long_mm - long).abs() < 0.05 && (own.short_mm - short).abs() < 0.05)
    }
}

const fn format(group: &'static str, name: &'static str, long_mm: f64, short_mm: f64) -> Format {
    Format { group, name, long_mm, short_mm }
}

/// All formats, group by group.
pub(crate) const FORMATS: [Format; 74] = [
    format("Screen", "192 x 108 mm", 192.0, 108.0),
    format("Paper", "A6", 148.0, 105.0),
    format("Paper", "A5", 210.0, 148.0),
    format("Paper", "A4", 297.0, 210.0),
    format("Paper", "A3", 420.0, 297.0),
    format("Paper", "A2", 594.0, 420.0),
    format("Paper", "US Letter", 279.4, 215.9),
    format("Stretched canvas", "18 x 24 cm", 240.0, 180.0),
    format("Stretched canvas", "20 x 30 cm", 300.0, 200.0),
    format("Stretched canvas", "24 x 30 cm", 300.0, 240.0),
    format("Stretched canvas", "30 x 40 cm", 400.0, 300.0),
    format("Stretched canvas", "40 x 50 cm", 500.0, 400.0),
    format("Stretched canvas", "50 x 70 cm", 700.0, 500.0),
    format("Stretched canvas", "60 x 80 cm", 800.0, 600.0),
    format("French, figure", "0 F", 180.0, 140.0),
    format("French, figure", "1 F", 220.0, 160.0),
    format("French, figure", "2 F", 240.0, 190.0),
    format("French, figure", "3 F", 270.0, 220.0),
    format("French, figure", "4 F", 330.0, 240.0),
    format("French, figure", "5 F", 350.0, 270.0),
    format("French, figure", "6 F", 410.0, 330.0),
    format("French, figure", "8 F", 460.0, 380.0),
    format("French, figure", "10 F", 550.0, 460.0),
    format("French, figure", "12 F", 610.0, 500.0),
    format("French, figure", "15 F", 650.0, 540.0),
    format("French, figure", "20 F", 730.0, 600.0),
    format("French, figure", "25 F", 810.0, 650.0),
    format("French, figure", "30 F", 920.0, 730.0),
    format("French, figure", "40 F", 1000.0, 810.0),
    format("French, figure", "50 F", 1160.0, 890.0),
    format("French, figure", "60 F", 1300.0, 970.0),
    format("French, figure", "80 F", 1460.0, 1140.0),
    format("French, figure", "100 F", 1620.0, 1300.0),
    format("French, figure", "120 F", 1950.0, 1300.0),
    format("French, paysage", "0 P", 180.0, 120.0),
    format("French, paysage", "1 P", 220.0, 140.0),
    format("French, paysage", "2 P", 240.0, 160.0),
    format("French, paysage", "3 P", 270.0, 190.0),
    format("French, paysage", "4 P", 330.0, 220.0),
    format("French, paysage", "5 P", 350.0, 240.0),
    format("French, paysage", "6 P", 410.0, 270.0),
    format("French, paysage", "8 P", 460.0, 330.0),
    format("French, paysage", "10 P", 550.0, 380.0),
    format("French, paysage", "12 P", 610.0, 460.0),
    format("French, paysage", "15 P", 650.0, 500.0),
    format("French, paysage", "20 P", 730.0, 540.0),
    format("French, paysage", "25 P", 810.0, 600.0),
    format("French, paysage", "30 P", 920.0, 650.0),
    format("French, paysage", "40 P", 1000.0, 730.0),
    format("French, paysage", "50 P", 1160.0, 810.0),
    format("French, paysage", "60 P", 1300.0, 890.0),
    format("French, paysage", "80 P", 1460.0, 970.0),
    format("French, paysage", "100 P", 1620.0, 1140.0),
    format("French, paysage", "120 P", 1950.0, 1140.0),
    format("French, marine", "0 M", 180.0, 100.0),
    format("French, marine", "1 M", 220.0, 120.0),
    format("French, marine", "2 M", 240.0, 140.0),
    format("French, marine", "3 M", 270.0, 160.0),
    format("French, marine", "4 M", 330.0, 190.0),
    format("French, marine", "5 M", 350.0, 220.0),
    format("French, marine", "6 M", 410.0, 240.0),
    format("French, marine", "8 M", 460.0, 270.0),
    format("French, marine", "10 M", 550.0, 330.0),
    format("French, marine", "12 M", 610.0, 380.0),
    format("French, marine", "15 M", 650.0, 460.0),
    format("French, marine", "20 M", 730.0, 500.0),
    format("French, marine", "25 M", 810.0, 540.0),
    format("French, marine", "30 M", 920.0, 600.0),
    format("French, marine", "40 M", 1000.0, 650.0),
    format("French, marine", "50 M", 1160.0, 730.0),
    format("French, marine", "60 M", 1300.0, 810.0),
    format("French, marine", "80 M", 1460.0, 890.0),
    format("French, marine", "100 M", 1620.0, 970.0),
    format("French, marine", "120 M", 1950.0, 970.0),
];

/// Most cells of a canvas: 64 million.
pub(crate) const MAX_CELLS: usize = 64 << 20;

/// Shortest and longest side of a canvas, in mm.
pub(crate) const SIDE_MM: [f64; 2] = [5.0, 2000.0];

/// Smallest and largest cell, in mm.
const CELL_MM: [f64; 2] = [0.02, 2.0];

/// A cell takes this memory in bytes while you paint.
const CELL_BYTES: u64 = 90;

/// A cell of a dry layer takes this memory in bytes.
const LAYER_BYTES: u64 = 36;

/// The canvas of a new painting.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct NewCanvas {
    /// Size, cells and ground.
    pub canvas: Canvas,
    /// Unit that you see the size in.
    pub unit: LengthUnit,
    /// Whether the painting gets the library and palette of the current one.
    pub same_pigments: bool,
    /// A picture for the first dry layer. We paint its colours with the palette.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub first_layer: Option<PathBuf>,
}

impl Default for NewCanvas {
    fn default() -> Self {
        Self {
            canvas: Canvas::default(),
            unit: LengthUnit::Mm,
            same_pigments: true,
            first_layer: None,
        }
    }
}

impl NewCanvas {
    /// Moves numbers out of range to the nearest allowed ones.
    pub(crate) fn bound(&mut self) {
        fn within(value: f64, [least, most]: [f64; 2], usual: f64) -> f64 {
            if value.is_finite() { value.clamp(least, most) } else { usual }
        }
        let canvas = &mut self.canvas;
        canvas.width_mm = within(canvas.width_mm, SIDE_MM, 192.0);
        canvas.height_mm = within(canvas.height_mm, SIDE_MM, 108.0);
        canvas.cell_mm = within(canvas.cell_mm, CELL_MM, 0.1);
    }

    /// Gives the canvas the size of a format. It stays upright or across.
    pub(crate) fn set_format(&mut self, format: &Format) {
        let upright = self.is_upright();
        let Canvas { width_mm, height_mm, .. } = &mut self.canvas;
        (*width_mm, *height_mm) = (format.long_mm, format.short_mm);
        self.set_upright(upright);
    }

    #[must_use]
    pub(crate) fn is_upright(&self) -> bool {
        self.canvas.height_mm > self.canvas.width_mm
    }

    pub(crate) fn set_upright(&mut self, upright: bool) {
        let Canvas { width_mm, height_mm, .. } = &mut self.canvas;
        if upright != (*height_mm > *width_mm) {
            std::mem::swap(width_mm, height_mm);
        }
    }

    #[must_use]
    pub(crate) fn cell_count(&self) -> usize {
        let (width, height) = self.canvas.cells();
        width.saturating_mul(height)
    }

    /// Whether the canvas has at most [`MAX_CELLS`] cells.
    #[must_use]
    pub(crate) fn fits(&self) -> bool {
        self.cell_count() <= MAX_CELLS
    }

    /// Memory of the canvas while you paint, and of each dry layer, in bytes.
    #[must_use]
    pub(crate) fn memory(&self) -> [u64; 2] {
        [CELL_BYTES, LAYER_BYTES].map(|bytes| bytes.saturating_mul(self.cell_count() as u64))
    }

    /// Kind of the ground; `None` for the relief of a picture.
    #[must_use]
    pub(crate) fn kind(&self) -> Option<GroundKind> {
        match self.canvas.ground.relief {
            GroundRelief::Linen(_) => Some(GroundKind::Linen),
            GroundRelief::Paper(_) => Some(GroundKind::Paper),
            GroundRelief::Panel(_) => Some(GroundKind::Panel),
            GroundRelief::Wood(_) => Some(GroundKind::Wood),
            GroundRelief::Image(_) => None,
        }
    }

    /// Seed of the ground's relief; `None` for the relief of a picture.
    pub(crate) fn seed(&mut self) -> Option<&mut u64> {
        match &mut self.canvas.ground.relief {
            GroundRelief::Linen(linen) => Some(&mut linen.seed),
            GroundRelief::Paper(paper) => Some(&mut paper.seed),
            GroundRelief::Panel(panel) => Some(&mut panel.seed),
            GroundRelief::Wood(wood) => Some(&mut wood.seed),
            GroundRelief::Image(_) => None,
        }
    }

    /// Changes the kind of the ground. Seed and colour stay.
    pub(crate) fn set_kind(&mut self, kind: GroundKind) {
        let seed = self.seed().map_or(1, |seed| *seed);
        self.canvas.ground.relief = kind.spec(seed).relief;
    }

    /// Height of the ground's relief in mm. If the relief is a picture, this is the height of
    /// white.
    pub(crate) fn relief_mm(&mut self) -> &mut f64 {
        match &mut self.canvas.ground.relief {
            GroundRelief::Linen(linen) => &mut linen.relief_mm,
            GroundRelief::Paper(paper) => &mut paper.relief_mm,
            GroundRelief::Panel(panel) => &mut panel.relief_mm,
            GroundRelief::Wood(wood) => &mut wood.relief_mm,
            GroundRelief::Image(picture) => &mut picture.depth_mm,
        }
    }
}

/// A named colour of a ground, made with the pigments of a library.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Tone {
    /// Name in the list.
    pub(crate) name: &'static str,
    /// Pigments and use, for a tooltip.
    pub(crate) description: &'static str,
    /// Pigments and their parts. If there are none, the priming stays bare.
    parts: &'static [(&'static str, f64)],
    /// Height of the film in mm.
    height_mm: f64,
}

/// The tones that we offer. The program's library has no earths, so the browns are mixed.
pub(crate) const TONES: [Tone; 6] = [
    Tone {
        name: english("White"),
        description: english("The white priming, bare"),
        parts: &[],
        height_mm: 0.0,
    },
    Tone {
        name: english("Warm grey"),
        description: english("White with black and a little red and yellow, thick enough to hide"),
        parts: &[
            ("Zinc White", 40.0),
            ("Bone Black", 1.5),
            ("Minium", 0.5),
            ("Chrome Yellow", 0.4),
        ],
        height_mm: 0.02,
    },
    Tone {
        name: english("Cool grey"),
        description: english("White with black and a little blue, thick enough to hide"),
        parts: &[("Zinc White", 40.0), ("Bone Black", 1.5), ("Ultramarine", 0.4)],
        height_mm: 0.02,
    },
    Tone {
        name: english("Brown imprimatura"),
        description: english("A thin film of black, yellow and red, in the place of raw umber"),
        parts: &[("Bone Black", 2.5), ("Chrome Yellow", 4.0), ("Vermilion", 2.0)],
        height_mm: 0.0008,
    },
    Tone {
        name: english("Golden imprimatura"),
        description: english(
            "A thin film of yellow with a little red and black, in the place of raw sienna",
        ),
        parts: &[("Chrome Yellow", 16.0), ("Vermilion", 3.0), ("Bone Black", 3.0)],
        height_mm: 0.0006,
    },
    Tone {
        name: english("Red ground"),
        description: english(
            "Vermilion broken with black and red lead, thick enough to hide, in the place of bole",
        ),
        parts: &[("Vermilion", 12.0), ("Bone Black", 1.0), ("Minium", 4.0)],
        height_mm: 0.02,
    },
];

impl Tone {
    /// The tone of `primer`; `None` if it is your own.
    #[must_use]
    pub(crate) fn of(primer: Option<&Primer>) -> Option<&'static Self> {
        TONES.iter().find(|tone| tone.primer().as_ref() == primer)
    }

    /// The film or colour of this tone; `None` for bare priming.
    #[must_use]
    pub(crate) fn primer(&self) -> Option<Primer> {
        if self.parts.is_empty() {
            return None;
        }
        let recipe = self.parts.iter().map(|(name, part)| ((*name).to_owned(), *part));
        let film = PrimerFilm { recipe: recipe.collect(), height_mm: self.height_mm };
        Some(Primer::Toned(TonedPrimer { film }))
    }

    /// Colour of this tone in sRGB, as paint of `library` under `viewing`. `None` if a pigment is
    /// missing.
    #[must_use]
    pub(crate) fn color(&self, library: &PigmentLibrary, viewing: &Viewing) -> Option<[u8; 3]> {
        let reflectance = match self.primer() {
            _ if !self.is_in(library) => return None,
            Some(primer) => primer.reflectance(library).ok()?,
            None => Primer::library_white(library),
        };
        let weights = viewing.weights(library.grid).ok()?;
        let xyz = weights.xyz(&reflectance);
        let white = weights.white();
        let rgb = RgbSpace::Srgb.encoded_from_xyz(xyz, white, Adaptation::Bradford);
        Some(rgb.to_bytes())
    }

    #[must_use]
    pub(crate) fn is_in(&self, library: &PigmentLibrary) -> bool {
        self.parts.iter().all(|(name, _)| library.pigments.iter().any(|own| own.name == *name))
    }
}

const MOST_PRESETS: usize = 100;

/// A canvas under a name.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct CanvasPreset {
    /// Name that the painter gave it.
    pub name: String,
    /// Canvas kept under this name.
    pub canvas: NewCanvas,
}

/// The canvas that you used last, and presets.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct KeptCanvases {
    /// The canvas that you began last. The next dialog starts with it.
    pub last: NewCanvas,
    /// Named canvases, sorted by name.
    pub presets: Vec<CanvasPreset>,
}

impl KeptCanvases {
    /// Moves numbers out of range to the nearest allowed ones.
    pub(crate) fn bound(&mut self) {
        self.last.bound();
        self.presets.truncate(MOST_PRESETS);
        self.presets.iter_mut().for_each(|preset| preset.canvas.bound());
    }

    /// Keeps `canvas` as `name`. This replaces a preset of the same name.
    pub(crate) fn keep(&mut self, name: &str, canvas: NewCanvas) {
        self.remove(name);
        self.presets.push(CanvasPreset { name: name.to_owned(), canvas });
        self.presets.sort_by(|a, b| a.name.cmp(&b.name));
        self.presets.truncate(MOST_PRESETS);
    }

    pub(crate) fn remove(&mut self, name: &str) {
        self.presets.retain(|preset| preset.name != name);
    }

    #[must_use]
    pub(crate) fn preset(&self, name: &str) -> Option<&NewCanvas> {
        self.presets.iter().find(|preset| preset.name == name).map(|preset| &preset.canvas)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use spectra::color::Lab;

    #[test]
    fn formats_are_found_upright_and_across() {
        assert_eq!(Format::of(210.0, 297.0).unwrap().name, "A4");
        assert_eq!(Format::of(297.0, 210.0).unwrap().name, "A4");
        assert_eq!(Format::of(400.0, 300.0).unwrap().name, "30 x 40 cm");
        assert_eq!(Format::of(920.0, 730.0).unwrap().name, "30 F");
        assert_eq!(Format::of(211.0, 297.0), None, "an own size");
    }

    #[test]
    fn each_format_has_its_own_size_and_a_longer_side() {
        for (index, own) in FORMATS.iter().enumerate() {
            assert!(own.long_mm > own.short_mm, "{own:?}");
            assert!(
                !FORMATS[..index]
                    .iter()
                    .any(|other: &Format| (other.group, other.name) == (own.group, own.name)),
                "{} twice",
                own.name
            );
        }
        // The sides of A formats have the ratio of the square root of 2, rounded to mm.
        for own in FORMATS.iter().filter(|own| own.name.starts_with('A')) {
            assert!((own.long_mm - own.short_mm * 2.0_f64.sqrt()).abs() < 1.0, "{own:?}");
        }
    }

    fn format(name: &str) -> &'static Format {
        FORMATS.iter().find(|format| format.name == name).unwrap()
    }

    #[test]
    fn a_format_keeps_the_canvas_upright_or_across() {
        let mut new = NewCanvas::default();
        new.set_format(format("A4"));
        assert_eq!((new.canvas.width_mm, new.canvas.height_mm), (297.0, 210.0));
        new.set_upright(true);
        assert_eq!((new.canvas.width_mm, new.canvas.height_mm), (210.0, 297.0));
        new.set_format(format("30 x 40 cm"));
        assert_eq!((new.canvas.width_mm, new.canvas.height_mm), (300.0, 400.0));
    }

    #[test]
    fn memory_is_counted_by_cells_and_layers() {
        let new = NewCanvas::default();
        assert_eq!(new.cell_count(), 1920 * 1080);
        assert_eq!(new.memory(), [1920 * 1080 * 90, 1920 * 1080 * 36]);
        let mut large = new.clone();
        large.set_format(format("60 F"));
        assert!(new.fits() && !large.fits(), "{} cells", large.cell_count());
    }

    #[test]
    fn another_kind_of_ground_keeps_seed_and_color() {
        let mut new = NewCanvas::default();
        *new.seed().unwrap() = 7;
        new.canvas.ground.reflectance = Some(Primer::Grey(0.5));
        new.set_kind(GroundKind::Paper);
        assert_eq!((new.kind(), new.seed().copied()), (Some(GroundKind::Paper), Some(7)));
        assert!(new.canvas.ground.reflectance.is_some(), "the colour is gone");
        let paper = paint::ground::Paper::default();
        assert_eq!(*new.relief_mm(), paper.relief_mm, "the relief is that of the kind");
    }

    #[test]
    fn numbers_out_of_range_are_moved_into_it() {
        let mut new = NewCanvas::default();
        new.canvas.width_mm = f64::NAN;
        new.canvas.height_mm = 1e9;
        new.canvas.cell_mm = 0.0;
        new.bound();
        let Canvas { width_mm, height_mm, cell_mm, .. } = new.canvas;
        assert_eq!((width_mm, height_mm, cell_mm), (192.0, 2000.0, 0.02));
    }

    #[test]
    fn each_tone_can_be_mixed_and_is_found_again() {
        let library = PigmentLibrary::van_gogh_oils();
        let weights = Viewing::default().weights(library.grid).unwrap();
        for tone in &TONES {
            assert!(tone.is_in(&library), "{}", tone.name);
            assert_eq!(Tone::of(tone.primer().as_ref()), Some(tone));
        }
        let [warm, cool, brown, golden, red] = [1, 2, 3, 4, 5].map(|index: usize| {
            let primer = TONES[index].primer().unwrap_or(Primer::Grey(0.87));
            let found = primer.reflectance(&library).unwrap();
            Lab::from_xyz(weights.xyz(&found), weights.white())
        });
        assert!(warm.b > cool.b + 3.0, "{warm:?} {cool:?}");
        assert!(warm.a.hypot(warm.b) < 15.0 && cool.a.hypot(cool.b) < 15.0, "greys");
        assert!((45.0..75.0).contains(&brown.lightness) && brown.b > 15.0, "{brown:?}");
        assert!(golden.lightness > 60.0 && golden.b > 30.0, "{golden:?}");
        assert!((25.0..50.0).contains(&red.lightness) && red.a > 20.0, "{red:?}");
    }

    #[test]
    fn a_tone_needs_the_pigments_of_its_library() {
        let mut library = PigmentLibrary::van_gogh_oils();
        library.pigments.retain(|pigment| pigment.name != "Vermilion");
        let there: Vec<&str> =
            TONES.iter().filter(|tone| tone.is_in(&library)).map(|tone| tone.name).collect();
        assert_eq!(there, ["White", "Warm grey", "Cool grey"]);
        let viewing = Viewing::default();
        let white = TONES[0].color(&library, &viewing).unwrap();
        assert!(white.iter().all(|value| *value > 220), "{white:?}");
        assert_eq!(TONES[5].color(&library, &viewing), None, "a red without vermilion");
        let oils = PigmentLibrary::van_gogh_oils();
        let red = TONES[5].color(&oils, &viewing).unwrap();
        assert!(red[0] > red[1] + 30 && red[1] < 110, "{red:?}");
    }

    #[test]
    fn presets_are_kept_by_name_and_removed() {
        let mut kept = KeptCanvases::default();
        let mut large = NewCanvas::default();
        large.canvas.width_mm = 500.0;
        kept.keep("study", NewCanvas::default());
        kept.keep("large", NewCanvas::default());
        kept.keep("large", large.clone());
        let names: Vec<&str> = kept.presets.iter().map(|preset| preset.name.as_str()).collect();
        assert_eq!(names, ["large", "study"]);
        assert_eq!(kept.preset("large"), Some(&large), "the later one");
        kept.remove("study");
        assert_eq!(kept.preset("study"), None);
    }

    #[test]
    fn kept_canvases_survive_their_file() {
        let mut kept = KeptCanvases::default();
        kept.last.canvas.ground.relief =
            serde_json::from_str(r#"{"kind": "image", "path": "a.png"}"#).unwrap();
        kept.keep("study", NewCanvas::default());
        let text = serde_json::to_string(&kept).unwrap();
        assert_eq!(serde_json::from_str::<KeptCanvases>(&text).unwrap(), kept);
        let older: KeptCanvases = serde_json::from_str("{}").unwrap();
        assert_eq!(older, KeptCanvases::default());
    }
}
