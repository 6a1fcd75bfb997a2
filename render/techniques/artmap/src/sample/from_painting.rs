//! Takes a painting as one large sample. This sums all its layers into one table of pigments.

use std::sync::Arc;

use documents::hint::Explain;
use graphics::field::Field;
use graphics::picture::Picture;
use paint::amount::mm_from_quanta;
use paint::document::{Document, Lighting};
use paint::layer::{Layer, SLOTS, Slots};
use paint::light::{Light, PaintLightError};
use paint::optics::Gloss;
use paint::scene::{Appearance, picture};
use pigment::palette::{Cards, Palette};
use pigment::{PigmentId, PigmentLibrary, Recipe, Viewing};
use rayon::prelude::*;
use spectra::color::{Lab, delta_e_ciede2000};

use crate::texel_file::{PaintOfSamples, TexelPaint};

/// A pigment is minor if it has less than this share of a painting's pigment.
pub const MINOR: f64 = 0.01;

/// Fields of a whole painting, one texel per cell. You cut samples from this.
#[derive(Debug, Clone, PartialEq)]
pub struct WholePainting {
    /// Title of the painting.
    pub title: String,
    /// Colour of each texel under D65 for the 1931 observer, of a level surface without gloss, in
    /// linear sRGB.
    pub color: Picture,
    /// Paint of each texel, wet and dry.
    pub paint: Field<TexelPaint>,
    /// Height of all paint over the ground in mm.
    pub height_mm: Field<f32>,
    /// Side of a texel in mm.
    pub mm_per_texel: f64,
    /// Library and pigments of the paint.
    pub pigments: PaintOfSamples,
    /// Minor pigments that were merged, each with the pigment that it now counts as.
    pub merged: Vec<[String; 2]>,
}

impl WholePainting {
    /// Sums the layers of a painting. Optical thickness counts: we multiply the pigments of a dry
    /// layer by its opacity, but not its height.
    ///
    /// A table holds a limited number of pigments. If the painting has more and you pass
    /// `merge_minor`, pigments below [`MINOR`] of all pigment count as the remaining pigment with
    /// the nearest masstone by CIEDE2000.
    ///
    /// # Errors
    /// [`FromPaintingError`] for more than eight pigments, and a library without visible
    /// wavelengths.
    pub fn of(document: &Document, merge_minor: bool) -> Result<Self, FromPaintingError> {
        let used = used_pigments(document);
        let (kept, merged) = table(document, &used, merge_minor)?;
        let mut slots = Slots::default();
        for (slot, pigment) in slots.iter_mut().zip(&kept) {
            *slot = Some(*pigment);
        }
        let light = Light::named(&document.library, "D65", "1931-2")?;
        fn name(pigment: PigmentId, document: &Document) -> String {
            document.library[pigment].name.clone()
        }
        Ok(Self {
            title: document.title.clone(),
            color: level_colors(document, &light),
            paint: summed_paint(document, |pigment: PigmentId| {
                let target = merged.iter().find(|(minor, _)| *minor == pigment);
                let target = target.map_or(pigment, |(_, into)| *into);
                kept.iter().position(|kept| *kept == target)
            }),
            height_mm: summed_height(document),
            mm_per_texel: document.cell_mm,
            pigments: PaintOfSamples { library: Arc::new(document.library.clone()), slots },
            merged: merged
                .iter()
                .map(|&(minor, into)| [name(minor, document), name(into, document)])
                .collect(),
        })
    }
}

fn layers(document: &Document) -> Vec<(&Slots, f64, &Layer)> {
    let dry = document.dry.iter().map(|layer| (&layer.slots, layer.shown_opacity(), &layer.paint));
    dry.chain([(&document.slots, 1.0, &document.wet)]).collect()
}

/// Pigments that the painting holds, by their index in the library. Each comes with its share of
/// all pigment.
fn used_pigments(document: &Document) -> Vec<(PigmentId, f64)> {
    let mut sums = vec![0.0; document.library.pigments.len()];
    for (slots, opacity, layer) in layers(document) {
        for (slot, total) in slots.iter().zip(layer.totals()) {
            if let Some(sum) = slot.and_then(|pigment| sums.get_mut(pigment.index())) {
                *sum += opacity * total as f64;
            }
        }
    }
    let whole: f64 = sums.iter().sum();
    let used = sums.iter().enumerate().filter(|(_, sum)| **sum > 0.0);
    used.map(|(index, sum)| (PigmentId(index), sum / whole)).collect()
}

type Merged = Vec<(PigmentId, PigmentId)>;

/// Pigments of the table, and the minor ones with the pigments that replace them.
fn table(
    document: &Document,
    used: &[(PigmentId, f64)],
    merge_minor: bool,
) -> Result<(Vec<PigmentId>, Merged), FromPaintingError> {
    fn ids(used: &[(PigmentId, f64)]) -> Vec<PigmentId> {
        used.iter().map(|(id, _)| *id).collect::<Vec<_>>()
    }
    if used.len() <= SLOTS {
        return Ok((ids(used), Vec::new()));
    }
    let library = &document.library;
    let (minor, kept): (Vec<_>, Vec<_>) = used.iter().partition(|(_, share)| *share < MINOR);
    if !merge_minor || kept.len() > SLOTS {
        return Err(FromPaintingError::TooManyPigments {
            title: document.title.clone(),
            names: used.iter().map(|&(id, _)| library[id].name.clone()).collect(),
            minor: if kept.len() > SLOTS { 0 } else { minor.len() },
        });
    }
    let colors = masstones(library);
    let kept = ids(&kept);
    let merged = ids(&minor).into_iter().filter_map(|id| {
        let nearest = kept.iter().min_by(|a, b| {
            let [of_a, of_b] =
                [a, b].map(|other| delta_e_ciede2000(colors[id.index()], colors[other.index()]));
            of_a.total_cmp(&of_b)
        });
        Some((id, *nearest?))
    });
    let merged = merged.collect();
    Ok((kept, merged))
}

fn masstones(library: &PigmentLibrary) -> Vec<Lab> {
    let viewing = Viewing::default();
    let palette = Palette::new(library, &viewing, Cards::standard(library.grid));
    library
        .ids()
        .map(|id| {
            let palette = palette.as_ref().ok()?;
            Some(palette.color(&Recipe::single(id)).lab)
        })
        .map(Option::unwrap_or_default)
        .collect()
}

pub(crate) fn level_colors(document: &Document, light: &Light) -> Picture {
    let dry: Vec<_> =
        document.dry.iter().map(|layer| (layer.slots, layer.shown_opacity())).collect();
    let appearance = Appearance {
        library: &document.library,
        medium: &document.medium,
        ground: &document.ground,
        cell_mm: document.cell_mm,
        dry: &dry,
        slots: &document.slots,
        lighting: &Lighting { relief: 0.0, ..Lighting::default() },
    };
    let mut scene = appearance.scene(light);
    fn matt(gloss: Gloss) -> Gloss {
        Gloss { strength: 0.0, ..gloss }
    }
    let lamp = &mut scene.lamp;
    (lamp.wet, lamp.dry, lamp.ground) = (matt(lamp.wet), matt(lamp.dry), matt(lamp.ground));
    let shown = picture(document, &scene);
    let colors = shown.values().iter().map(|&[red, green, blue, _]| [red, green, blue]);
    Field::from_values(shown.width(), shown.height(), colors.collect())
}

/// Paint of all layers in mm. `place` gives the slot of each pigment.
pub(crate) fn summed_paint(
    document: &Document,
    place: impl Fn(PigmentId) -> Option<usize>,
) -> Field<TexelPaint> {
    let layers: Vec<_> = layers(document)
        .into_iter()
        .map(|(slots, opacity, layer)| (slots.map(|slot| slot.and_then(&place)), opacity, layer))
        .collect();
    let width = document.wet.width();
    let height = document.wet.height();
    let quantum_mm = mm_from_quanta(1, document.cell_mm);
    let texels = (0..width * height)
        .into_par_iter()
        .with_min_len(4096)
        .map(|index: usize| {
            let mut sums = [0.0; SLOTS];
            let mut vehicle = 0_u64;
            for (places, opacity, layer) in &layers {
                let cell = layer.cell(index);
                vehicle += u64::from(cell.vehicle);
                for (place, amount) in places.iter().zip(cell.pigments) {
                    if let Some(place) = *place {
                        sums[place] += opacity * f64::from(amount);
                    }
                }
            }
            TexelPaint {
                pigments_mm: sums.map(|sum| (sum * quantum_mm) as f32),
                vehicle_mm: (vehicle as f64 * quantum_mm) as f32,
            }
        })
        .collect();
    Field::from_values(width, height, texels)
}

pub(crate) fn summed_height(document: &Document) -> Field<f32> {
    let layers = layers(document);
    let width = document.wet.width();
    let height = document.wet.height();
    let quantum_mm = mm_from_quanta(1, document.cell_mm);
    let texels = (0..width * height)
        .into_par_iter()
        .with_min_len(4096)
        .map(|index: usize| {
            let volumes = layers.iter().map(|(.., layer)| u64::from(layer.cell(index).volume()));
            (volumes.sum::<u64>() as f64 * quantum_mm) as f32
        })
        .collect();
    Field::from_values(width, height, texels)
}

/// A painting cannot be sampled.
#[derive(Debug, Clone, PartialEq, thiserror::Error, Explain)]
pub enum FromPaintingError {
    /// The painting holds more pigments than a table of samples.
    #[error(
        "painting `{title}` has {} pigments, samples hold {SLOTS}: {}",
        names.len(), names.join(", ")
    )]
    #[hint(if *minor == 0, "sample parts of the painting that have fewer pigments")]
    #[hint("{minor} of them are below 1 %: merge them into others with [merge_minor]")]
    TooManyPigments {
        /// Title of the painting.
        title: String,
        /// Names of its pigments.
        names: Vec<String>,
        /// Number of minor pigments. If merging them does not help, this is 0.
        minor: usize,
    },
    /// The painting's library has no wavelengths in common with daylight.
    #[error(transparent)]
    #[fault(Input)]
    Light(#[from] PaintLightError),
}

#[cfg(test)]
mod tests {
    use paint::document::Canvas;
    use paint::ground::GroundKind;
    use paint::session::PaintingSession;
    use paint::{BrushSpec, HeadShape, Sample};
    use spectra::color::RgbSpace;

    use super::*;

    fn painting() -> Document {
        let oils = PigmentLibrary::van_gogh_oils();
        let ground = GroundKind::Panel.spec(1);
        let canvas = Canvas { width_mm: 24.0, height_mm: 12.0, cell_mm: 0.25, ground };
        let mut session = PaintingSession::on_canvas(&oils, &canvas).unwrap();
        let spec = BrushSpec { shape: HeadShape::Flat, size_mm: 4.0 };
        session.set_brush("flat", &spec).unwrap();
        for (name, y_mm) in [("Vermilion", 5.0), ("Cobalt Blue", 7.0)] {
            session.load("flat", [(name, 1.0), ("Zinc White", 1.0)], 0.3).unwrap();
            let ends = [3.0, 21.0]
                .map(|x_mm| Sample { twist_deg: 90.0, ..Sample::upright(x_mm, x_mm, y_mm, 0.6) });
            session.stroke("flat", &ends).unwrap();
            session.canvas_mut().dry(if y_mm == 5.0 { 1.0 } else { 0.0 }).unwrap();
        }
        session.canvas_mut().document().unwrap()
    }

    #[test]
    fn every_pigment_keeps_its_total_and_heights_are_the_sum_of_all_paint() {
        let document = painting();
        let whole = WholePainting::of(&document, false).unwrap();
        let slots = whole.pigments.slots;
        assert_eq!(slots.iter().flatten().count(), 3);
        let quantum_mm = mm_from_quanta(1, document.cell_mm);
        for (slot, pigment) in slots.iter().enumerate() {
            let mut exact = 0.0;
            for (of, _, layer) in layers(&document) {
                let totals = layer.totals();
                let held =
                    of.iter().zip(totals).filter(|(held, _)| held.is_some() && *held == pigment);
                exact += held.map(|(_, total)| total as f64 * quantum_mm).sum::<f64>();
            }
            let texels = whole.paint.values().iter();
            let found: f64 = texels.map(|texel| f64::from(texel.pigments_mm[slot])).sum();
            assert!((found - exact).abs() <= 1e-6 * exact, "{slot}: {found}, not {exact}");
            assert_eq!(exact > 0.0, pigment.is_some(), "{slot}");
        }
        for (texel, height) in whole.paint.values().iter().zip(whole.height_mm.values()) {
            let sum = texel.pigments_mm.iter().sum::<f32>() + texel.vehicle_mm;
            assert!((sum - height).abs() < 1e-5, "{sum} in {height}");
        }
    }

    #[test]
    fn colors_are_those_of_the_exact_spectra_and_carry_no_relief() {
        let document = painting();
        let whole = WholePainting::of(&document, false).unwrap();
        let exact = paint::scene::SpectralDocument::full(&document);
        let weights = Viewing::default().weights(document.library.grid).unwrap();
        for (x, y) in [(2, 2), (40, 20), (60, 24), (50, 14), (66, 15), (70, 30)] {
            let wanted = weights.xyz(&exact.measured_reflectance(x, y));
            let rgb = spectra::color::Rgb(whole.color[(x, y)].map(f64::from)).encoded();
            let xyz = RgbSpace::Srgb.xyz_from_encoded(
                rgb,
                weights.white(),
                spectra::color::Adaptation::Bradford,
            );
            let [wanted, found] = [wanted, xyz].map(|xyz| Lab::from_xyz(xyz, weights.white()));
            let off = delta_e_ciede2000(wanted, found);
            assert!(off < 0.5, "{x}, {y}: {off}");
        }
    }

    /// The painting with one more dry layer for each of `amounts` (quanta), each layer of another
    /// pigment.
    fn crowded(amounts: &[u32]) -> Document {
        let mut document = painting();
        for (index, &amount) in amounts.iter().enumerate() {
            let mut paint = document.wet.clone();
            paint.pigments.values_mut().fill([0; SLOTS]);
            paint.vehicle.values_mut().fill(0);
            paint.pigments[(index, 3)][0] = amount;
            let mut slots = Slots::default();
            slots[0] = Some(PigmentId(if index < 1 { 0 } else { index + 11 }));
            document.push_dry(slots, paint);
        }
        document
    }

    #[test]
    fn more_pigments_than_slots_are_refused_by_name_or_merged_when_asked() {
        let document = crowded(&[5000; 7]);
        let error = WholePainting::of(&document, false).unwrap_err();
        assert!(error.to_string().contains("10 pigments, samples hold 8: "), "{error}");
        assert!(error.to_string().contains("Vermilion"), "{error}");
        assert!(error.hint().unwrap().to_string().contains("`merge_minor`"), "{error}");
        let merged = WholePainting::of(&document, true).unwrap();
        assert_eq!(merged.merged.len(), 7);
        assert_eq!(merged.pigments.slots.iter().flatten().count(), 3);
        fn sum(whole: &WholePainting) -> f64 {
            let texels = whole.paint.values().iter().flat_map(|texel| texel.pigments_mm);
            texels.map(f64::from).sum()
        }
        let before = WholePainting::of(&painting(), false).unwrap();
        let more = 7.0 * 5000.0 * mm_from_quanta(1, document.cell_mm);
        let off = sum(&merged) - sum(&before) - more;
        assert!(off.abs() < 1e-6 * sum(&before), "{off} of {more}");

        let even = crowded(&[500_000_000; 7]);
        let error = WholePainting::of(&even, true).unwrap_err();
        assert!(matches!(error, FromPaintingError::TooManyPigments { minor: 0, .. }), "{error}");
    }

    #[test]
    fn a_faded_layer_counts_by_its_optical_thickness_and_keeps_its_height() {
        let document = painting();
        let mut faded = document.clone();
        faded.dry[0].opacity = 0.5;
        let [whole, half] = [&document, &faded].map(|painting| WholePainting::of(painting, false));
        let whole = whole.unwrap();
        let half = half.unwrap();
        assert_eq!(whole.height_mm, half.height_mm);
        let vermilion = document.library.find("Vermilion").unwrap();
        let slot = whole.pigments.slots.iter().position(|slot| *slot == Some(vermilion)).unwrap();
        fn sum(of: &WholePainting, slot: usize) -> f64 {
            of.paint.values().iter().map(|texel| f64::from(texel.pigments_mm[slot])).sum()
        }
        let share = sum(&half, slot) / sum(&whole, slot);
        assert!(share > 0.5 - 1e-6 && share < 0.8, "{share}");
    }
}
