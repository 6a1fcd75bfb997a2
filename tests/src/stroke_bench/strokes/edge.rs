//! Strokes over and along the edge of the canvas.

use render::HeadShape;

use super::super::canvas::{BODY, Bench, Hand, PRESSURE};
use super::super::figure::{CaseReport, Figure};
use super::super::measure::mark::Mark;

/// Highest cell at the edge over the film, and whether all paint is still there.
pub(super) fn edge(bench: &Bench) -> CaseReport {
    let (mut figures, mut panels) = (Vec::new(), Vec::new());
    let (width_mm, height_mm) = (60.0, 24.0);
    let strokes = [
        ("over the edge and back", vec![(10.0, 12.0), (75.0, 12.0), (10.0, 12.0)]),
        ("along the edge", vec![(10.0, height_mm), (50.0, height_mm)]),
    ];
    for (name, points) in strokes {
        let mut easel = bench.panel((width_mm, height_mm));
        let brush = easel.brush(HeadShape::Flat, 10.0);
        easel.load(brush, &BODY, 1.0);
        let before = easel.quanta(&[brush]);
        easel.stroke(brush, &Hand::across(PRESSURE).along(&points));
        let heights = easel.heights();
        let along = points[0].1 == height_mm;
        // The film beside the edge: in the middle of the mark, away from the edge.
        let film = Mark::within(&heights, 0.0..50.0).map_or(f64::NAN, |mark| mark.film_mm);
        let near = if along {
            heights.part(
                heights.columns_in(0.0..width_mm),
                heights.rows_in(height_mm - 1.0..height_mm),
            )
        } else {
            heights
                .part(heights.columns_in(width_mm - 1.0..width_mm), heights.rows_in(0.0..height_mm))
        };
        let highest = near.iter().fold(0.0, |a: f64, &b| a.max(b));
        let after = easel.quanta(&[brush]);
        let gone: i64 = before.iter().zip(after).map(|(before, after)| before - after).sum();
        let loaded: i64 = before.iter().sum();
        let over = highest / film;
        figures
            .push(Figure::new(format!("{name}: highest near it over film"), over, "").at_most(3.0));
        let left = 100.0 * gone as f64 / loaded as f64;
        figures.push(Figure::new(format!("{name}: paint that left"), left, "%").at_least(0.0));
        panels.push(easel.show(name, 0.0..width_mm, 0.0..height_mm));
    }
    let title = "Edge of the canvas (flat 10, load 1): no pile within 1 mm of it";
    CaseReport { name: "edge", title, figures, panels }
}
