//! CPU and GPU hold equal paint and show it alike; pictures from eight wavelengths match the
//! full spectrum.

use calibrate::evaluate::Viewing;
use paint::brush::HeadShape;
use paint::document::{Document, Lighting};
use paint::painting::{LayerRef, Painting};
use paint::scene::SpectralDocument;
use spectra::color::{Lab, RgbSpace, delta_e_ciede2000};

use super::studio::{
    BLUE, RED, WHITE, YELLOW, along, bare, crossing, differences, lab, loaded, mean, on_cpu,
    on_gpu, pigment, sorted, tell,
};

/// Paints dried impasto, a thin glaze of 90 % vehicle over it, half dried, and wet strokes; also
/// sets an opacity, swaps a pigment, undoes and redoes.
fn finished(painting: &mut Painting) {
    crossing(painting);
    painting.dry(1.0).unwrap();
    let glaze = painting.add_brush(HeadShape::Mop, 8.0).unwrap();
    let mut recipe = [0.0; 8];
    (recipe[BLUE], recipe[RED]) = (1.0, 2.0);
    painting.load(glaze, &recipe, 0.9, 0.05).unwrap();
    painting.stroke(glaze, &along(&[(2.0, 7.0), (22.0, 7.0), (22.0, 12.0)], 0.5)).unwrap();
    painting.dry(0.5).unwrap();
    painting.set_opacity(LayerRef::Dry(1), 1.5).unwrap();
    painting.swap_pigment(LayerRef::Dry(0), pigment("Chrome Yellow"), pigment("Minium")).unwrap();
    let red = loaded(painting, HeadShape::Bright, 4.0, RED, 0.4);
    painting.stroke(red, &along(&[(2.0, 14.0), (14.0, 13.0), (22.0, 3.0)], 0.7)).unwrap();
    painting.undo().unwrap();
    painting.redo().unwrap();
    let white = loaded(painting, HeadShape::Knife, 5.0, WHITE, 0.5);
    painting.stroke(white, &along(&[(18.0, 16.0), (6.0, 10.0)], 0.4)).unwrap();
    let _ = loaded(painting, HeadShape::Round, 2.0, YELLOW, 0.2);
}

fn same_paint(a: &Document, b: &Document) {
    assert_eq!(a.dry.len(), b.dry.len(), "dry layers");
    for (index, (a, b)) in a.dry.iter().zip(&b.dry).enumerate() {
        assert!(a == b, "dry layer {index}");
    }
    assert!(a.wet == b.wet, "the wet layer");
}

#[test]
fn both_backends_hold_the_same_paint_and_show_it_alike() {
    let mut document = bare(130, 100);
    document.ground.gloss.strength = 0.2;
    let Some(mut gpu) = on_gpu(document.clone()) else { return };
    let mut cpu = on_cpu(document);
    finished(&mut cpu);
    finished(&mut gpu);
    let check = |cpu: &mut Painting, gpu: &mut Painting, what: &str| {
        let shown = differences(&cpu.picture().unwrap(), &gpu.picture().unwrap());
        let mean = mean(&shown);
        let high = shown[shown.len() * 999 / 1000];
        let largest = shown[shown.len() - 1];
        tell(&format!(
            "CPU against GPU, {what}: mean {mean:.2e}, 99.9th percentile {high:.2e}, largest {largest:.2e} CIEDE2000"
        ));
        assert!(mean < 0.1 && high < 1.0, "{what}: mean {mean}, 99.9 % below {high}");
    };
    check(&mut cpu, &mut gpu, "daylight");
    same_paint(&cpu.document().unwrap(), &gpu.document().unwrap());
    let low = Lighting {
        illuminant: "A".into(),
        azimuth_deg: 80.0,
        elevation_deg: 20.0,
        relief: 2.0,
        ambient: 0.2,
        ..Lighting::default()
    };
    cpu.relight(low.clone()).unwrap();
    gpu.relight(low).unwrap();
    check(&mut cpu, &mut gpu, "a low lamp");
    cpu.dry(0.8).unwrap();
    gpu.dry(0.8).unwrap();
    check(&mut cpu, &mut gpu, "dried");
    same_paint(&cpu.document().unwrap(), &gpu.document().unwrap());
}

#[test]
fn eight_wavelengths_show_a_finished_painting_as_the_full_spectrum_does() {
    let mut painting = on_cpu(bare(130, 100));
    finished(&mut painting);
    let flat = painting.flat_picture().unwrap();
    let document = painting.document().unwrap();
    let spectral = SpectralDocument::full(&document);
    let weights = Viewing::default().weights(document.library.grid).unwrap();
    let cells = (0..130 * 100).map(|i| (i % 130, i / 130));
    let light = painting.light();
    let white = light.quadrature.rule.white;
    let exact = cells.map(|(x, y)| {
        let xyz = weights.xyz(&spectral.measured_reflectance(x, y));
        let linear =
            RgbSpace::Srgb.linear_from_xyz(xyz, white, spectra::color::Adaptation::Bradford);
        let adapted = RgbSpace::Srgb.xyz_from_linear().apply(linear.0);
        Lab::from_xyz(adapted.into(), RgbSpace::Srgb.white())
    });
    let pairs = exact.zip(flat.values());
    let found = sorted(pairs.map(|(exact, rgb)| delta_e_ciede2000(exact, lab(rgb))).collect());
    let mean = mean(&found);
    let largest = found[found.len() - 1];
    tell(&format!("8 wavelengths against 31: mean {mean:.3}, largest {largest:.3} CIEDE2000"));
    assert!(mean < 0.3, "mean {mean}");
    assert!(mean > 0.0, "the full spectrum was compared with itself");
}
