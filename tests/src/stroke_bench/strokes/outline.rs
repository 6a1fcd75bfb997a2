//! Outlines of strokes, and where a mark lies under the pen.

use paint::HeadShape;

use super::super::canvas::{BODY, Bench, Easel};
use super::super::figure::{CaseReport, Figure};
use super::super::hand::{Hand, PRESSURE, START_MM};
use super::super::heights::Heights;
use super::super::measure::mark::Mark;
use super::super::measure::outline::edge_deviations_mm;

/// Paints one stroke of a brush loaded with 1 mm on a panel.
fn painted(
    bench: &Bench,
    (shape, size_mm): (HeadShape, f64),
    hand: Hand,
    size: (f64, f64),
    points: &[(f64, f64)],
) -> Easel {
    let mut easel = bench.panel(size);
    let brush = easel.brush(shape, size_mm);
    easel.load(brush, &BODY, 1.0);
    easel.stroke(brush, &hand.along(points));
    easel
}

/// Deviations in mm of both edges of the only mark; not a number where it has gaps.
fn edge_deviations(heights: &Heights) -> [f64; 2] {
    let mark = Mark::along_x(heights);
    let found = mark.and_then(|mark| edge_deviations_mm(heights, mark.steady));
    found.unwrap_or([f64::NAN; 2])
}

/// Edges of a wide stroke, and of strokes at 10 degrees.
pub(super) fn outline(bench: &Bench) -> CaseReport {
    let mut figures = Vec::new();
    let mut panels = Vec::new();
    let wide = (HeadShape::Flat, 25.0);
    let points = [(25.0, 20.0), (85.0, 20.0)];
    let mut easel = painted(bench, wide, Hand::across(PRESSURE), (100.0, 40.0), &points);
    let heights = easel.heights();
    let edges = edge_deviations(&heights);
    for (side, mm) in ["upper", "lower"].into_iter().zip(edges) {
        let name = format!("flat 25: RMS of the {side} edge over width");
        figures.push(Figure::new(name, 100.0 * mm / 25.0, "%").at_most(2.0));
    }
    panels.push(easel.show("flat 25, load 1", 2.0..98.0, 2.0..38.0));
    let rise = 60.0 * 10f64.to_radians().tan();
    let points = [(START_MM, 10.0), (START_MM + 60.0, 10.0 + rise)];
    for (shape, size_mm) in [(HeadShape::Round, 4.0), (HeadShape::Flat, 10.0)] {
        let hand = Hand { twist_deg: 100.0, ..Hand::across(PRESSURE) };
        let mut easel = painted(bench, (shape, size_mm), hand, (80.0, 32.0), &points);
        let heights = easel.heights();
        let edges = edge_deviations(&heights);
        for (side, mm) in ["upper", "lower"].into_iter().zip(edges) {
            let name = format!("{shape} {size_mm} at 10 degrees: RMS of the {side} edge");
            figures.push(Figure::new(name, mm / heights.cell_mm(), "cell").at_most(0.25));
        }
        let caption = format!("{shape} {size_mm} at 10 degrees");
        panels.push(easel.show(caption, 2.0..78.0, 1.0..31.0));
        panels.push(easel.enlarge("its edges", 32.0..47.0, 10.0..22.0));
    }
    let title = "Outlines at even pressure: deviation of the edges from straight lines";
    CaseReport { name: "outline", title, figures, panels }
}

/// Where marks begin and end under the pen, upright and leaning.
pub(super) fn lag(bench: &Bench) -> CaseReport {
    let mut figures = Vec::new();
    let mut panels = Vec::new();
    let heads = [
        (HeadShape::Flat, 10.0),
        (HeadShape::Round, 6.0),
        (HeadShape::Filbert, 8.0),
        (HeadShape::Knife, 20.0),
    ];
    let leans = [("upright", (0.0, 0.0)), ("back 35", (-35.0, 0.0)), ("aside 35", (0.0, 35.0))];
    for (shape, size_mm) in heads {
        let leans = if bench.small { &leans[..1] } else { &leans };
        let mut upright_mm = f64::NAN;
        for &(lean, tilt_deg) in leans {
            let hand = Hand { tilt_deg, ..Hand::across(PRESSURE) };
            let points = [(20.0, 18.0), (70.0, 18.0)];
            let mut easel = painted(bench, (shape, size_mm), hand, (90.0, 36.0), &points);
            let heights = easel.heights();
            let mark = Mark::along_x(&heights);
            let none = (f64::NAN, f64::NAN);
            let (top, bottom) = mark.as_ref().map_or(none, |mark| mark.edges_mm);
            let ends = mark.and_then(|mark| mark.ends_mm(&heights));
            let (start, end) = ends.unwrap_or(none);
            let name = format!("{shape} {size_mm} {lean}");
            let figure = |what: &str, mm: f64| Figure::new(format!("{name}: {what}"), mm, "mm");
            figures.push(figure("start after the pen's", start - 20.0));
            figures.push(figure("end after the pen's", end - 70.0));
            // Both ends lie half a contact beyond the pen's.
            let behind = 0.5 * (start + end) - 45.0;
            figures.push(figure("middle after the pen's", behind).at_least(-1.0).at_most(1.0));
            if tilt_deg == (0.0, 0.0) {
                upright_mm = bottom - top;
            } else {
                let wide = 100.0 * (bottom - top) / upright_mm;
                let width = Figure::new(format!("{name}: width over upright"), wide, "%");
                figures.push(width.at_least(85.0).at_most(115.0));
            }
            let aside = 0.5 * (top + bottom) - 18.0;
            figures.push(figure("middle beside the pen's", aside).at_least(-1.0).at_most(1.0));
            panels.push(easel.show(name, 10.0..80.0, 4.0..32.0));
        }
    }
    let title = "Lag: the mark's ends and middle against a pen from 20 to 70 mm";
    CaseReport { name: "lag", title, figures, panels }
}
