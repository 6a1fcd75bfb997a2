use paint::canvas::Canvas;
use paint::ground::GroundKind;
use paint::session::PaintingSession;
use paint::{BrushSpec, HeadShape, Sample};
use spectra::color::RgbSpace;

use super::*;

/// A painting of two strokes in different pigments; the first is dry.
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
            let held = of.iter().zip(totals).filter(|(held, _)| held.is_some() && *held == pigment);
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
    let lab = |xyz| Lab::from_xyz(xyz, weights.white());
    for (x, y) in [(2, 2), (40, 20), (60, 24), (50, 14), (66, 15), (70, 30)] {
        let wanted = lab(weights.xyz(&exact.measured_reflectance(x, y)));
        let rgb = spectra::color::Rgb(whole.color[(x, y)].map(f64::from)).encoded();
        let xyz = RgbSpace::Srgb.xyz_from_encoded(
            rgb,
            weights.white(),
            spectra::color::Adaptation::Bradford,
        );
        let off = delta_e_ciede2000(wanted, lab(xyz));
        assert!(off < 0.5, "{x}, {y}: {off}");
    }
}

/// The painting with layers of a quantum or more of further pigments.
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
    let sum = |whole: &WholePainting| -> f64 {
        let texels = whole.paint.values().iter().flat_map(|texel| texel.pigments_mm);
        texels.map(f64::from).sum()
    };
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
    let sum = |of: &WholePainting| -> f64 {
        of.paint.values().iter().map(|texel| f64::from(texel.pigments_mm[slot])).sum()
    };
    let share = sum(&half) / sum(&whole);
    assert!(share > 0.5 - 1e-6 && share < 0.8, "{share}");
}
