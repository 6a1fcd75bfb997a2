//! Thick paint: lips, saw-tooth, and ridges that stay.

use paint::HeadShape;
use paint::ground::GroundKind;

use super::super::canvas::{BLUE_SLOT, BODY, Bench, Easel};
use super::super::figure::{CaseReport, Figure};
use super::super::hand::{Hand, PRESSURE, START_MM};
use super::super::heights::Heights;
use super::super::measure::mark::Mark;
use super::super::measure::surface::second_differences_mm;

/// Lips at the sides and at the end of thick strokes.
pub(super) fn lips(bench: &Bench) -> CaseReport {
    let mut figures = Vec::new();
    let mut panels = Vec::new();
    for (shape, size_mm) in [(HeadShape::Flat, 10.0), (HeadShape::Filbert, 8.0)] {
        let mut easel = bench.panel((80.0, 20.0));
        let brush = easel.brush(shape, size_mm);
        easel.load(brush, &BODY, 2.0);
        let samples = Hand::across(PRESSURE).along(&[(START_MM, 10.0), (START_MM + 60.0, 10.0)]);
        easel.stroke(brush, &samples);
        let heights = easel.heights();
        let mark = Mark::along_x(&heights);
        let none = ([f64::NAN; 2], f64::NAN);
        let (sides, end) =
            mark.map_or(none, |mark| (mark.side_lips(&heights), mark.end_lip(&heights)));
        let places = ["upper side", "lower side", "end"];
        for (place, value) in places.into_iter().zip([sides[0], sides[1], end]) {
            let name = format!("{shape} {size_mm}: lip of the {place} over film");
            figures.push(Figure::new(name, value, "").at_least(1.3).at_most(2.5));
        }
        let caption = format!("{shape} {size_mm}, load 2");
        panels.push(easel.show(caption, 2.0..78.0, 2.0..18.0).zoomed(1.6));
    }
    let title = "Lips of thick strokes: highest of the mean profiles near the edges";
    CaseReport { name: "lips", title, figures, panels }
}

/// Pulls over one another, and a ridge beside which strokes are painted.
pub(super) fn saw_tooth(bench: &Bench) -> CaseReport {
    let mut easel = bench.panel((80.0, 24.0));
    let brush = easel.brush(HeadShape::Flat, 10.0);
    for _ in 0..8 {
        easel.load(brush, &BODY, 1.0);
        let samples = Hand::across(PRESSURE).along(&[(START_MM, 12.0), (START_MM + 60.0, 12.0)]);
        easel.stroke(brush, &samples);
    }
    let heights = easel.heights();
    let mark = Mark::along_x(&heights);
    let [mut film, mut along, mut across] = [f64::NAN; 3];
    if let Some(Mark { steady, middle, film_mm, .. }) = mark {
        film = film_mm;
        [along, across] =
            second_differences_mm(&heights, steady, middle).map(|mm| 100.0 * mm / film_mm);
    }
    let mut figures = vec![
        Figure::new("film after 8 pulls", film, "mm"),
        Figure::new("RMS of second differences along it over film", along, "%").at_most(3.0),
        // Furrows of 10 % at 1 mm alone give 4 % across it.
        Figure::new("  across it, furrows included", across, "%"),
        Figure::new("highest cell", heights.highest_mm(), "mm"),
    ];
    let mut panels = vec![
        easel.show("flat 10, load 1, 8 pulls", 2.0..78.0, 1.0..23.0),
        easel.enlarge("their middle", 35.0..50.0, 8.0..16.0),
    ];
    let (kept, mut beside) = ridge(bench);
    figures.push(Figure::new("ridge of 1 mm: height kept", 100.0 * kept, "%").at_least(90.0));
    let caption = "ridge of 1 mm, a stroke 3 mm beside it, another";
    panels.push(beside.show(caption, 2.0..78.0, 1.0..47.0));
    let title = "Thick paint: 8 pulls over one another; a ridge beside strokes";
    CaseReport { name: "saw-tooth", title, figures, panels }
}

/// Share of the height that a ridge along x keeps while strokes pass 3 mm beside it and elsewhere.
fn ridge(bench: &Bench) -> (f64, Easel) {
    const AT_MM: f64 = 10.0;
    const BASE_MM: f64 = 1.5;
    let profile = |y: f64| (1.0 - (2.0 * (y - AT_MM) / BASE_MM).powi(2)).max(0.0);
    let mut easel =
        Easel::new(bench, bench.cell_mm, (80.0, 48.0), GroundKind::Panel, |x: f64, y: f64| {
            ((15.0..65.0).contains(&x) && profile(y) > 0.0).then(|| (BLUE_SLOT, profile(y)))
        });
    let crest = |heights: &Heights| {
        let columns = heights.columns_in(20.0..60.0);
        let rows = heights.rows_in(AT_MM - 1.0..AT_MM + 1.0);
        columns
            .clone()
            .map(|x: usize| rows.clone().map(|y| heights.at(x, y)).fold(0.0, f64::max))
            .sum::<f64>()
            / columns.len() as f64
    };
    let before = crest(&easel.heights());
    let brush = easel.brush(HeadShape::Flat, 10.0);
    for y_mm in [AT_MM + 3.0 + 5.0, 38.0] {
        easel.load(brush, &BODY, 1.0);
        let samples = Hand::across(PRESSURE).along(&[(START_MM, y_mm), (START_MM + 60.0, y_mm)]);
        easel.stroke(brush, &samples);
    }
    (crest(&easel.heights()) / before, easel)
}
