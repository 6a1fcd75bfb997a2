//! Strokes over and along the edge of the canvas.

use paint::HeadShape;

use super::super::canvas::{BODY, Bench};
use super::super::figure::{CaseReport, Figure};
use super::super::hand::{Hand, PRESSURE};
use super::super::measure::mark::Mark;

/// Highest cell at the edge over the film, and the share of the last load that is neither on the
/// canvas nor on the brush.
pub(super) fn edge(bench: &Bench) -> CaseReport {
    let mut figures = Vec::new();
    let mut panels = Vec::new();
    let width_mm = 60.0;
    let height_mm = 24.0;
    let strokes = [
        ("over the edge and back", 1, vec![(10.0, 12.0), (75.0, 12.0), (10.0, 12.0)]),
        ("8 pulls over the edge", 8, vec![(10.0, 12.0), (75.0, 12.0)]),
        ("along the edge", 1, vec![(10.0, height_mm), (50.0, height_mm)]),
    ];
    for (name, pulls, points) in strokes {
        let mut easel = bench.panel((width_mm, height_mm));
        let brush = easel.brush(HeadShape::Flat, 10.0);
        let mut gone = 0;
        let mut loaded = 0;
        for _ in 0..pulls {
            easel.load(brush, &BODY, 1.0);
            let before = easel.quanta(&[brush]).iter().sum::<i64>();
            easel.stroke(brush, &Hand::across(PRESSURE).along(&points));
            gone += before - easel.quanta(&[brush]).iter().sum::<i64>();
            loaded = before;
        }
        let heights = easel.heights();
        let along = points[0].1 == height_mm;
        // The film beside the edge: in the middle of the mark, away from the edge.
        let film = Mark::within(&heights, 0.0..50.0).map_or(f64::NAN, |mark| mark.film_mm);
        let (from_x, from_y) = if along { (0.0, height_mm - 1.0) } else { (width_mm - 1.0, 0.0) };
        let columns = heights.columns_in(from_x..width_mm);
        let near = heights.part(columns, heights.rows_in(from_y..height_mm));
        let over = near.iter().fold(0.0, |a: f64, &b| a.max(b)) / film;
        let figure = Figure::new(format!("{name}: highest near it over film"), over, "");
        figures.push(figure.at_most(3.0));
        let left = 100.0 * gone as f64 / loaded as f64;
        figures.push(Figure::new(format!("{name}: paint that left"), left, "%").at_least(0.0));
        panels.push(easel.show(name, 0.0..width_mm, 0.0..height_mm).zoomed(1.3));
    }
    let title = "Edge of the canvas (flat 10, load 1): no pile within 1 mm of it";
    CaseReport { name: "edge", title, figures, panels }
}
