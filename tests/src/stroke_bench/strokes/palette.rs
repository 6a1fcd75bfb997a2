//! Mixing two heaps on the palette.

use std::f64::consts::TAU;

use paint::HeadShape;
use spectra::color::Lab;

use super::super::canvas::{BLUE, Bench, YELLOW};
use super::super::figure::{CaseReport, Figure, Panel};
use super::super::hand::{Hand, PRESSURE, turning};
use super::super::measure::series::mean;
use super::super::measure::surface::{color_spread, pits};

const MIDDLE_MM: (f64, f64) = (25.0, 25.0);
const RADIUS_MM: f64 = 8.0;
/// Height in mm from which a cell counts as covered; thinner paint shows the ground.
const COVERED_MM: f64 = 0.05;

/// Path of `count` circles about the middle, whose centres move by 2 mm.
fn circles(count: usize) -> Vec<(f64, f64)> {
    (0..count)
        .flat_map(|index: usize| {
            let (sin, cos) = (index as f64 / count as f64 * TAU).sin_cos();
            let centre = (MIDDLE_MM.0 + 2.0 * cos, MIDDLE_MM.1 + 2.0 * sin);
            (0..48).map(move |step| {
                let (sin, cos) = (f64::from(step) / 48.0 * TAU).sin_cos();
                (centre.0 + RADIUS_MM * cos, centre.1 + RADIUS_MM * sin)
            })
        })
        .collect()
}

/// Mixes with one tool.
fn mix(bench: &Bench, shape: HeadShape, size_mm: f64) -> (Vec<Figure>, Vec<Panel>) {
    let mut easel = bench.panel((50.0, 50.0));
    for (recipe, x_mm) in [(BLUE, MIDDLE_MM.0 - 4.0), (YELLOW, MIDDLE_MM.0 + 4.0)] {
        easel.squeeze(&recipe, 60.0, (x_mm, MIDDLE_MM.1));
    }
    let heaps = easel.show("two heaps of 60 mm3", 5.0..45.0, 5.0..45.0).zoomed(2.0);
    let brush = easel.brush(shape, size_mm);
    easel.stroke(brush, &turning(Hand::across(PRESSURE).along(&circles(12))));
    let heights = easel.heights();
    let inside = |x: usize, y: usize| {
        let centre = |cell: usize| (cell as f64 + 0.5) * heights.cell_mm();
        (centre(x) - MIDDLE_MM.0).hypot(centre(y) - MIDDLE_MM.1) < RADIUS_MM + 2.0
    };
    let columns = heights.columns();
    let patch: Vec<usize> =
        (0..heights.values().len()).filter(|at| inside(at % columns, at / columns)).collect();
    let colors = easel.colors();
    let covered = patch.iter().filter(|&&at| heights.values()[at] >= COVERED_MM);
    let covered: Vec<Lab> = covered.map(|&at| colors[at]).collect();
    let film: Vec<f64> = patch.iter().map(|&at| heights.values()[at]).collect();
    let highest = film.iter().fold(0.0, |a: f64, &b| a.max(b));
    let tool = format!("{shape} {size_mm}");
    let bare = 100.0 * (1.0 - covered.len() as f64 / patch.len() as f64);
    let figures = vec![
        Figure::new(format!("{tool}: mean CIEDE2000 from the mean"), color_spread(&covered), "")
            .at_most(3.0),
        Figure::new(
            format!("{tool}: cells below a fifth of their median"),
            100.0 * pits(&heights, inside),
            "%",
        ),
        Figure::new(format!("{tool}: cells thinner than 0.05 mm"), bare, "%"),
        Figure::new(format!("{tool}: mean height"), mean(&film), "mm"),
        Figure::new(format!("{tool}: highest over mean"), highest / mean(&film), ""),
    ];
    let mixed = easel.show(format!("{tool}, 12 circles"), 5.0..45.0, 5.0..45.0).zoomed(2.0);
    (figures, vec![heaps, mixed])
}

/// Mixes with knife and brush.
pub(super) fn palette(bench: &Bench) -> CaseReport {
    let (mut figures, mut panels) = mix(bench, HeadShape::Knife, 20.0);
    let (more, brushed) = mix(bench, HeadShape::Flat, 10.0);
    figures.extend(more);
    panels.extend(brushed.into_iter().skip(1));
    let title = "Palette: a blue and a yellow heap 8 mm apart, 12 circles of radius 8 mm";
    CaseReport { name: "palette", title, figures, panels }
}
