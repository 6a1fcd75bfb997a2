//! Paint over a ground: the weave under a thick film, and a wall covered in pulls.

use paint::HeadShape;
use paint::ground::GroundKind;

use super::super::canvas::{BODY, Bench, Easel};
use super::super::figure::{CaseReport, Figure};
use super::super::hand::{Hand, PRESSURE, START_MM};
use super::super::heights::Heights;
use super::super::measure::series::{deviation, mean, slope, spread_over_mean};

/// How much of a weave shows in the top of three coats of thick strokes.
pub(super) fn weave(bench: &Bench) -> CaseReport {
    let mut easel = Easel::new(bench, bench.cell_mm, (80.0, 24.0), GroundKind::Linen, |_, _| None);
    let brush = easel.brush(HeadShape::Flat, 10.0);
    for _ in 0..3 {
        easel.load(brush, &BODY, 2.0);
        let samples = Hand::across(PRESSURE).along(&[(START_MM, 12.0), (START_MM + 60.0, 12.0)]);
        easel.stroke(brush, &samples);
    }
    let paint = easel.heights();
    let ground = easel.ground();
    let sums = paint.values().iter().zip(ground.values()).map(|(paint, ground)| paint + ground);
    let top = Heights::new(ground.cell_mm(), ground.columns(), sums.collect());
    let columns = ground.columns_in(20.0..60.0);
    let rows = ground.rows_in(9.0..15.0);
    let part = |heights: &Heights| heights.part(columns.clone(), rows.clone());
    let shown = slope(&part(&ground), &part(&top));
    let film = mean(&part(&paint));
    let figures = vec![
        Figure::new("film of three coats", film, "mm"),
        Figure::new("share of the weave's relief that shows", 100.0 * shown, "%")
            .at_least(-10.0)
            .at_most(10.0),
    ];
    let panels = vec![
        easel.show("flat 10, load 2, three coats on linen", 2.0..78.0, 1.0..23.0),
        easel.enlarge("their middle", 35.0..50.0, 8.0..16.0),
    ];
    let title = "Weave: how much of it shows in the top of three thick coats";
    CaseReport { name: "weave", title, figures, panels }
}

/// A wall covered in overlapping pulls with a reload before each.
pub(super) fn fill(bench: &Bench) -> CaseReport {
    const PULLS: usize = 5;
    const APART_MM: f64 = 8.5;
    let mut easel = bench.panel((80.0, 56.0));
    let brush = easel.brush(HeadShape::Flat, 12.0);
    for pull in 0..PULLS {
        easel.load(brush, &BODY, 1.0);
        let y_mm = 11.0 + APART_MM * pull as f64;
        let (from, to) = if pull % 2 == 0 { (10.0, 70.0) } else { (70.0, 10.0) };
        easel.stroke(brush, &Hand::across(PRESSURE).along(&[(from, y_mm), (to, y_mm)]));
    }
    let heights = easel.heights();
    // The wall without its rim of 3 mm.
    let columns = heights.columns_in(13.0..67.0);
    let rows = heights.rows_in(11.0..45.0);
    let wall = heights.part(columns.clone(), rows.clone());
    let bare = wall.iter().filter(|&&mm| mm < 0.002).count() as f64 / wall.len() as f64;
    let lines = &heights.across(columns)[rows];
    let figures = vec![
        Figure::new("film", mean(&wall), "mm"),
        Figure::new("bare cells", 100.0 * bare, "%"),
        Figure::new("RMS of the film", 100.0 * deviation(&wall) / mean(&wall), "%"),
        Figure::new("seams: RMS of the rows' means", 100.0 * deviation(lines) / mean(lines), "%"),
        Figure::new("seams: highest less lowest row over mean", spread_over_mean(lines), ""),
        Figure::new("highest cell", heights.highest_mm(), "mm"),
    ];
    let caption = "flat 12, load 1 before each of 5 pulls";
    let panels = vec![easel.show(caption, 2.0..78.0, 2.0..54.0).zoomed(2.0)];
    let title = "Fill: a wall of 60 x 40 mm covered by a flat 12";
    CaseReport { name: "fill", title, figures, panels }
}
