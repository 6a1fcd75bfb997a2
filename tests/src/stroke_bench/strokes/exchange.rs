//! Paint that a brush takes up: a heap, and wet bands across its way.

use paint::HeadShape;
use paint::ground::GroundKind;
use paint::layer::Layer;

use super::super::canvas::{BLUE_SLOT, Bench, Easel, YELLOW};
use super::super::figure::{CaseReport, Figure};
use super::super::hand::{Hand, PRESSURE};

/// A clean flat once through a heap.
pub(super) fn pick_up(bench: &Bench) -> CaseReport {
    let mut easel =
        Easel::new(bench, bench.cell_mm, (60.0, 24.0), GroundKind::Panel, |x: f64, y: f64| {
            let mm = 1.0 - ((x - 25.0).powi(2) + (y - 12.0).powi(2)) / 7.5f64.powi(2);
            (mm > 0.0).then_some((BLUE_SLOT, mm))
        });
    let brush = easel.brush(HeadShape::Flat, 5.0);
    easel.stroke(brush, &Hand::across(PRESSURE).along(&[(12.0, 12.0), (45.0, 12.0)]));
    let load = easel.load_mm(brush);
    let figures = vec![Figure::new("mean on the head", load, "mm").at_least(0.14).at_most(0.26)];
    let panels = vec![easel.show("flat 5, clean", 2.0..58.0, 2.0..22.0).zoomed(2.0)];
    let title = "Pick-up: a clean flat 5 once through a heap 1 mm high and 15 mm wide";
    CaseReport { name: "pick-up", title, figures, panels }
}

/// Left edges of the blue bands in mm.
const BANDS_MM: [f64; 3] = [20.0, 38.0, 56.0];
const BAND_MM: f64 = 8.0;

/// Share of blue in all paint of a layer.
fn share_of_blue<'a>(cells: impl Iterator<Item = &'a [u32; 8]>) -> f64 {
    let mut blue = 0.0;
    let mut all = 0.0;
    for pigments in cells {
        blue += f64::from(pigments[BLUE_SLOT]);
        all += pigments.iter().map(|&amount| f64::from(amount)).sum::<f64>();
    }
    blue / all
}

/// A yellow brush across three wet blue bands.
pub(super) fn wet_in_wet(bench: &Bench) -> CaseReport {
    let mut easel =
        Easel::new(bench, bench.cell_mm, (90.0, 24.0), GroundKind::Panel, |x: f64, _: f64| {
            let inside = BANDS_MM.iter().any(|&left| (left..left + BAND_MM).contains(&x));
            inside.then_some((BLUE_SLOT, 0.2))
        });
    let brush = easel.brush(HeadShape::Flat, 10.0);
    easel.load(brush, &YELLOW, 1.0);
    let before = easel.quanta(&[brush]);
    let samples = Hand::across(PRESSURE).along(&[(8.0, 12.0), (82.0, 12.0)]);
    let mut stroke = easel.painting.begin_stroke(brush).expect("a stroke");
    let mut on_brush = Vec::new();
    let mut rest = samples.as_slice();
    for end_mm in BANDS_MM.map(|left| left + BAND_MM + 4.0) {
        let count = rest.partition_point(|sample| sample.x_mm <= end_mm);
        stroke.extend(&rest[..count]).expect("samples of a pen");
        rest = &rest[count..];
        stroke.advance(&mut easel.painting, usize::MAX).expect("painted");
        on_brush.push(share_of_blue(easel.on_brush(brush).pigments.values().iter()));
    }
    stroke.extend(rest).expect("samples of a pen");
    stroke.finish(&mut easel.painting).expect("painted");
    on_brush.push(share_of_blue(easel.on_brush(brush).pigments.values().iter()));
    let wet: Layer = easel.wet();
    let heights = easel.heights();
    let across = heights.columns();
    // Between the bands, where the brush brought or pushed all blue.
    let laid = BANDS_MM.map(|left| {
        let columns = heights.columns_in(left + BAND_MM + 3.0..left + BAND_MM + 9.0);
        let rows = heights.rows_in(9.0..15.0);
        let cells = rows.flat_map(|y| columns.clone().map(move |x| y * across + x));
        share_of_blue(cells.map(|index| &wet.pigments.values()[index]))
    });
    let after = easel.quanta(&[brush]);
    let lost: i64 = before.iter().zip(after).map(|(before, after)| (before - after).abs()).sum();
    let mut figures = Vec::new();
    let places = ["after band 1", "after band 2", "after band 3", "at the end"];
    for (place, share) in places.into_iter().zip(&on_brush) {
        figures.push(Figure::new(format!("blue on the brush {place}"), 100.0 * share, "%"));
    }
    let grows = 100.0 * (on_brush[1] - on_brush[0]).min(on_brush[2] - on_brush[1]);
    figures.push(
        Figure::new("  least growth on the brush from band to band", grows, "%").at_least(0.01),
    );
    for (band, share) in laid.into_iter().enumerate() {
        figures.push(Figure::new(format!("blue laid after band {}", band + 1), 100.0 * share, "%"));
    }
    let grows = 100.0 * (laid[1] - laid[0]).min(laid[2] - laid[1]);
    figures.push(Figure::new("  least growth laid from band to band", grows, "%").at_least(0.01));
    figures.push(Figure::new("quanta lost or gained", lost as f64, "").at_most(0.0));
    let panels = vec![easel.show("flat 10, load 1 of yellow", 2.0..88.0, 2.0..22.0).zoomed(2.0)];
    let title = "Wet in wet: yellow across three blue bands, 0.2 mm thick and 8 mm wide";
    CaseReport { name: "wet-in-wet", title, figures, panels }
}
