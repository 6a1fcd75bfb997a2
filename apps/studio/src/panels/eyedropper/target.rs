//! The target colour of a recipe search, and the paint of a picked layer as a recipe.

use std::collections::BTreeMap;
use std::sync::Arc;

use eframe::egui::{
    Color32, Rect, Response, Role, Sense, Stroke, StrokeKind, Ui, Vec2, WidgetInfo,
};
use paint::document::Medium;
use paint::layer::SLOTS;
use paint::strokes::Recipe;
use pigment::PigmentId;
use pigment::evaluate::{Viewing, lab};
use pigment::library::{AmountKind, PigmentLibrary};
use pigment::matching::{Target, ViewingCondition, few_parts};
use session::PickedLayer;
use spectra::color::{Adaptation, ColorCode, Lab, Rgb, RgbSpace, Xyz};
use spectra::{Grid, TristimulusWeights};

use crate::theme;

/// A colour in one of three forms.
#[derive(Debug, Clone, PartialEq)]
pub enum Color {
    /// Screen colour in linear sRGB. Its appearance is matched under any light.
    Screen([f64; 3]),
    /// CIELAB relative to the light of the painting.
    Lab(Lab),
    /// Reflectance on the library's wavelength grid, 0 to 1.
    Reflectance(Arc<Vec<f64>>),
}

/// A target colour and its description.
#[derive(Debug, Clone, PartialEq)]
pub struct TargetColor {
    /// Origin of the colour, shown in the panel.
    pub name: String,
    /// Colour to be matched.
    pub color: Color,
}

impl TargetColor {
    /// Creates a target from a screen colour in linear sRGB.
    #[must_use]
    pub fn screen(name: &str, linear: [f64; 3]) -> Self {
        Self { name: name.to_owned(), color: Color::Screen(linear) }
    }

    /// Parses `#rrggbb` or `L,a,b`.
    #[must_use]
    pub fn from_text(text: &str) -> Option<Self> {
        Some(match text.trim().parse().ok()? {
            ColorCode::Srgb(rgb) => Self::screen(&rgb.to_hex(), rgb.linear().0),
            ColorCode::Lab(lab) => {
                let [l, a, b] = lab.to_array();
                Self { name: format!("Lab {l} {a} {b}"), color: Color::Lab(lab) }
            }
        })
    }

    /// CIELAB of the target under a light.
    #[must_use]
    pub fn lab(&self, grid: Grid, viewing: &Viewing) -> Lab {
        match &self.color {
            Color::Screen(linear) => {
                let white = weights(grid, viewing).white();
                Lab::from_xyz(from_screen(*linear, white), white)
            }
            Color::Lab(lab) => *lab,
            Color::Reflectance(values) => lab(&weights(grid, viewing), values),
        }
    }

    /// Encoded sRGB of the target under a light, not clipped to the gamut.
    #[must_use]
    pub fn shown(&self, grid: Grid, viewing: &Viewing) -> Rgb {
        match &self.color {
            Color::Screen(linear) => Rgb(*linear).encoded(),
            _ => screen_rgb(self.lab(grid, viewing), weights(grid, viewing).white()),
        }
    }

    /// Converts to the target of a recipe search under the given viewing conditions.
    #[must_use]
    pub fn match_target(&self, grid: Grid, conditions: &[ViewingCondition]) -> Target {
        let lab = conditions.iter().map(|condition| self.lab(grid, &condition.viewing)).collect();
        Target { name: self.name.clone(), lab, spectrum: None }
    }
}

/// Encoded sRGB of a colour under `white`, adapted as the painting is displayed.
pub(super) fn screen_rgb(lab: Lab, white: Xyz) -> Rgb {
    RgbSpace::Srgb.encoded_from_xyz(lab.to_xyz(white), white, Adaptation::Bradford)
}

fn from_screen(linear: [f64; 3], white: Xyz) -> Xyz {
    RgbSpace::Srgb.xyz_from_encoded(Rgb(linear).encoded(), white, Adaptation::Bradford)
}

/// Tristimulus weights of a light for reflectances on `grid`.
pub(super) fn weights(grid: Grid, viewing: &Viewing) -> TristimulusWeights {
    viewing.weights(grid).expect("the tristimulus method fits every library grid")
}

/// A pigment below this share of all pigment counts as a trace (chosen by eye).
const TRACE: f64 = 0.005;

/// Largest sum of the whole parts of a recipe.
const MOST_PARTS: u32 = 20;

/// Largest error of whole parts, as a share of all pigment. If it is larger, we show percentages.
const NEAR: f64 = 0.005;

/// Paint of one layer at a picked place.
#[derive(Debug, Clone, PartialEq)]
pub(in crate::panels) struct LayerPaint {
    /// Pairs of pigment index and share, largest first; the shares sum to 1.
    pub(in crate::panels) shares: Vec<(PigmentId, f64)>,
    /// Shares as small whole numbers, if these are close enough.
    pub(super) parts: Option<Vec<u32>>,
    /// Indices of pigments present only as traces.
    pub(super) traces: Vec<PigmentId>,
    /// Total height of the paint, in mm.
    pub(super) thickness_mm: f64,
    /// Share of the height that is clear vehicle, 0 to 1.
    pub(super) vehicle: f64,
    /// Factor of the layer's optical thickness, 1 as painted.
    pub(super) opacity: f64,
}

impl LayerPaint {
    /// The paint of a picked layer; `None` if there is none at this place.
    pub(in crate::panels) fn of(layer: &PickedLayer) -> Option<Self> {
        let mut amounts: BTreeMap<PigmentId, f64> = BTreeMap::new();
        for (slot, amount) in layer.slots.iter().zip(layer.amounts_mm) {
            if let Some(pigment) = slot.filter(|_| amount > 0.0) {
                *amounts.entry(pigment).or_default() += amount;
            }
        }
        let pigments: f64 = amounts.values().sum();
        let thickness_mm = pigments + layer.amounts_mm[SLOTS];
        if thickness_mm <= 0.0 {
            return None;
        }
        let (plain, traces): (Vec<_>, Vec<_>) =
            amounts.into_iter().partition(|(_, amount)| *amount >= TRACE * pigments);
        let total: f64 = plain.iter().map(|(_, amount)| amount).sum();
        let mut shares: Vec<(PigmentId, f64)> =
            plain.into_iter().map(|(pigment, amount)| (pigment, amount / total)).collect();
        shares.sort_by(|a, b| b.1.total_cmp(&a.1));
        let values: Vec<f64> = shares.iter().map(|(_, share)| *share).collect();
        let parts = few_parts(&values, MOST_PARTS, NEAR).filter(|parts| !parts.is_empty());
        Some(Self {
            shares,
            parts,
            traces: traces.into_iter().map(|(pigment, _)| pigment).collect(),
            thickness_mm,
            vehicle: layer.amounts_mm[SLOTS] / thickness_mm,
            opacity: layer.opacity,
        })
    }

    /// Amount (e.g. `6` or `61.3 %`) and name of each pigment.
    pub(super) fn lines(&self, library: &PigmentLibrary) -> Vec<(String, String)> {
        self.shares
            .iter()
            .enumerate()
            .map(|(at, (pigment, share)): (usize, &(PigmentId, f64))| {
                let amount = match &self.parts {
                    Some(parts) => parts[at].to_string(),
                    None => format!("{:.1} %", 100.0 * share),
                };
                (amount, library[*pigment].name.clone())
            })
            .collect()
    }

    /// Recipe in whole parts or in shares rounded to 0.0001, and the share of clear vehicle.
    pub(super) fn recipe(&self, library: &PigmentLibrary) -> (Recipe, f64) {
        let parts = self
            .shares
            .iter()
            .enumerate()
            .map(|(at, (pigment, share)): (usize, &(PigmentId, f64))| {
                let part = match &self.parts {
                    Some(parts) => f64::from(parts[at]),
                    None => (1e4 * share).round() / 1e4,
                };
                (library[*pigment].name.clone(), part)
            })
            .filter(|(_, part)| *part > 0.0);
        (parts.collect(), self.vehicle.clamp(0.0, 1.0))
    }

    /// Formats the recipe with the film's thickness as arguments of `impasto mix
    /// LIBRARY`; `None` for clear vehicle.
    pub(super) fn mix_text(&self, library: &PigmentLibrary, medium: &Medium) -> Option<String> {
        if self.shares.is_empty() {
            return None;
        }
        let pigments_mm = self.thickness_mm * (1.0 - self.vehicle);
        let thickness = pigments_mm * medium.scattering_per_mm * self.opacity;
        let absolute = library.amounts == AmountKind::Absolute;
        let words = self.shares.iter().enumerate().map(|(at, (pigment, share))| {
            let amount = match &self.parts {
                _ if absolute => significant(share * thickness),
                Some(parts) => parts[at].to_string(),
                None => significant(*share),
            };
            quoted(&format!("{}={amount}", library[*pigment].name))
        });
        let recipe = words.collect::<Vec<_>>().join(" ");
        Some(match absolute {
            true => recipe,
            false => format!("{recipe} --thickness {}", significant(thickness)),
        })
    }
}

/// Formats a number with four significant digits and no exponent.
fn significant(value: f64) -> String {
    let digits = 3 - value.abs().max(1e-9).log10().floor() as i32;
    let text = format!("{value:.*}", digits.clamp(0, 12) as usize);
    match text.contains('.') {
        true => text.trim_end_matches('0').trim_end_matches('.').to_owned(),
        false => text,
    }
}

fn quoted(word: &str) -> String {
    let mut quoted = String::from('"');
    for letter in word.chars() {
        if matches!(letter, '"' | '\\' | '$' | '`') {
            quoted.push('\\');
        }
        quoted.push(letter);
    }
    quoted.push('"');
    quoted
}

/// Rounds and clips encoded sRGB to a screen colour.
pub(super) fn on_screen(rgb: Rgb) -> Color32 {
    let [red, green, blue] = rgb.to_bytes();
    Color32::from_rgb(red, green, blue)
}

/// Draws a clickable patch with an accessible name. If there are several colours, they lie side by
/// side without a gap, so that you can compare them.
pub(in crate::panels) fn swatch(ui: &mut Ui, name: &str, size: Vec2, colors: &[Rgb]) -> Response {
    let size = theme::at_least(ui, size);
    let (rect, response) = ui.allocate_exact_size(size, Sense::click());
    response.widget_info(|| WidgetInfo::labeled(Role::Image, true, name));
    let width = rect.width() / colors.len().max(1) as f32;
    for (at, &rgb) in colors.iter().enumerate() {
        let left = rect.left() + at as f32 * width;
        let part = Rect::from_x_y_ranges(left..=left + width, rect.y_range());
        ui.painter().rect_filled(part, 0.0, on_screen(rgb));
    }
    ui.painter().rect_stroke(
        rect,
        0.0,
        Stroke::new(1.0, theme::colors(ui.ctx()).well),
        StrokeKind::Outside,
    );
    response
}

#[cfg(test)]
mod tests {
    use super::*;
    use pigment::library::PigmentLibrary;
    use spectra::{Illuminant, Observer};

    fn grid() -> Grid {
        Grid::from_nm(380.0, 10.0, 36).unwrap()
    }

    fn tungsten() -> Viewing {
        let illuminant = Illuminant::named("A").unwrap();
        Viewing { illuminant, observer: Observer::default() }
    }

    #[test]
    fn only_hexadecimal_and_lab_are_parsed() {
        let hex = TargetColor::from_text(" #2a5caa ").unwrap();
        assert_eq!(hex.name, "#2a5caa");
        assert_eq!(hex.shown(grid(), &tungsten()).to_hex(), "#2a5caa", "whatever the light");
        let lab = TargetColor::from_text("52,-10.5,8").unwrap();
        assert_eq!(lab.name, "Lab 52 -10.5 8");
        let found = lab.lab(grid(), &tungsten());
        assert_eq!(found, Lab { lightness: 52.0, a: -10.5, b: 8.0 });
        for text in ["", "blue", "1,2", "#12345"] {
            assert_eq!(TargetColor::from_text(text), None, "{text}");
        }
    }

    #[test]
    fn a_screen_color_round_trips_through_lab() {
        let wanted = TargetColor::screen("sky", [0.2, 0.4, 0.7]);
        for viewing in [Viewing::default(), tungsten()] {
            let lab = wanted.lab(grid(), &viewing);
            let back = screen_rgb(lab, weights(grid(), &viewing).white()).linear().0;
            for (found, wanted) in back.into_iter().zip([0.2, 0.4, 0.7]) {
                assert!((found - wanted).abs() < 1e-9, "{back:?}");
            }
        }
    }

    #[test]
    fn a_reflectance_has_the_lab_of_the_library() {
        let values: Vec<f64> = (0..36).map(|i| 0.1 + 0.02 * f64::from(i)).collect();
        let viewing = tungsten();
        let wanted = TargetColor {
            name: String::new(),
            color: Color::Reflectance(Arc::new(values.clone())),
        };
        assert_eq!(wanted.lab(grid(), &viewing), lab(&viewing.weights(grid()).unwrap(), &values));
        let perfect =
            TargetColor { name: String::new(), color: Color::Reflectance(vec![1.0; 36].into()) };
        assert_eq!(perfect.shown(grid(), &viewing).to_hex(), "#ffffff");
    }

    fn layer(amounts: &[(usize, f64)], vehicle: f64) -> PickedLayer {
        let mut slots = [None; SLOTS];
        let mut amounts_mm = [0.0; SLOTS + 1];
        for (slot, (pigment, amount)) in amounts.iter().enumerate() {
            (slots[slot], amounts_mm[slot]) = (Some(PigmentId(*pigment)), *amount);
        }
        amounts_mm[SLOTS] = vehicle;
        PickedLayer { label: "Wet".to_owned(), slots, amounts_mm, opacity: 1.0 }
    }

    #[test]
    fn amounts_become_small_whole_parts_largest_first() {
        let paint = LayerPaint::of(&layer(&[(3, 0.02), (0, 0.06), (7, 0.0)], 0.02)).unwrap();
        assert_eq!(paint.parts, Some(vec![3, 1]));
        let pigments: Vec<PigmentId> = paint.shares.iter().map(|(pigment, _)| *pigment).collect();
        assert_eq!(pigments, [0, 3].map(PigmentId));
        assert!((paint.thickness_mm - 0.1).abs() < 1e-12 && (paint.vehicle - 0.2).abs() < 1e-12);
    }

    #[test]
    fn other_amounts_are_percentages_and_traces_are_separate() {
        let paint = LayerPaint::of(&layer(&[(3, 0.0487), (0, 0.0513), (5, 0.0002)], 0.0)).unwrap();
        assert_eq!((&paint.parts, &paint.traces[..]), (&None, &[PigmentId(5)][..]));
        let library = PigmentLibrary::van_gogh_oils();
        let lines = paint.lines(&library);
        assert_eq!(lines[0], ("51.3 %".to_owned(), library.pigments[0].name.clone()));
        assert_eq!(lines[1], ("48.7 %".to_owned(), library.pigments[3].name.clone()));
    }

    #[test]
    fn slots_of_the_same_pigment_are_added() {
        let paint = LayerPaint::of(&layer(&[(3, 0.01), (3, 0.03)], 0.0)).unwrap();
        assert_eq!((paint.shares, paint.parts), (vec![(PigmentId(3), 1.0)], Some(vec![1])));
    }

    #[test]
    fn empty_and_clear_layers_have_no_recipe() {
        assert_eq!(LayerPaint::of(&layer(&[(0, 0.0)], 0.0)), None);
        let clear = LayerPaint::of(&layer(&[], 0.05)).unwrap();
        assert_eq!((clear.vehicle, clear.shares.len()), (1.0, 0));
        assert_eq!(clear.mix_text(&PigmentLibrary::van_gogh_oils(), &Medium::default()), None);
    }

    #[test]
    fn the_mix_text_gives_the_film_in_library_units() {
        let mut library = PigmentLibrary::van_gogh_oils();
        let paint = LayerPaint::of(&layer(&[(0, 0.06), (3, 0.02)], 0.02)).unwrap();
        let names = [0, 3].map(|pigment| library.pigments[pigment].name.clone());
        let text = paint.mix_text(&library, &Medium::default()).unwrap();
        // This is 0.08 mm of pigment at 50 per mm.
        assert_eq!(text, format!("\"{}=3\" \"{}=1\" --thickness 4", names[0], names[1]));
        library.amounts = AmountKind::Absolute;
        let text = paint.mix_text(&library, &Medium::default()).unwrap();
        assert_eq!(text, format!("\"{}=3\" \"{}=1\"", names[0], names[1]));
        let half = LayerPaint { opacity: 0.5, ..paint };
        let text = half.mix_text(&library, &Medium::default()).unwrap();
        assert_eq!(text, format!("\"{}=1.5\" \"{}=0.5\"", names[0], names[1]));
    }

    #[test]
    fn numbers_are_short_and_words_are_quoted() {
        let found = [0.333_333, 12.0, 1234.56, 0.000_123_456, 0.0].map(significant);
        assert_eq!(found, ["0.3333", "12", "1235", "0.0001235", "0"]);
        assert_eq!(quoted("Hooker's \"$green`\\"), "\"Hooker's \\\"\\$green\\`\\\\\"");
    }
}
