//! How strokes begin, end and run dry, ripples of strokes that turn, and the combs of fans.

use std::f64::consts::TAU;

use paint::HeadShape;
use paint::ground::GroundKind;

use super::super::canvas::{BODY, Bench, Easel};
use super::super::hand::{Hand, PRESSURE, START_MM, turning};
use super::super::heights::Heights;
use super::super::measure::{
    Mark, correlation, deviation, first_crossing, last_crossing, mean, rms, rough, smoothed,
    without_parabola,
};
use super::super::report::{CaseReport, Figure};

/// Width in mm of the parts of a mark that end each on its own.
const LOCK_MM: f64 = 0.5;

/// Places in mm where the locks of a mark begin and end: each is a band of rows, `LOCK_MM` wide, within
/// the middle 60 % of the width, which begins and ends where it crosses half of its film.
fn lock_ends(heights: &Heights, mark: &Mark) -> [Vec<f64>; 2] {
    let rows = (LOCK_MM / heights.cell_mm()).round().max(1.0) as usize;
    let mut ends = [Vec::new(), Vec::new()];
    let mut from = mark.middle.start;
    while from + rows <= mark.middle.end {
        let profile = heights.along(from..from + rows);
        let level = 0.5 * mean(&profile[mark.steady.clone()]);
        ends[0].extend(first_crossing(&profile, heights.cell_mm(), level));
        ends[1].extend(last_crossing(&profile, heights.cell_mm(), level));
        from += rows;
    }
    ends
}

/// Highest wave below 1.5 mm of the cross-mean between 1.5 and 15 mm from an end, over its residue in the
/// rest of the mark.
fn ladder(heights: &Heights, mark: &Mark, (from_mm, to_mm): (f64, f64)) -> f64 {
    let waves = rough(&heights.along(mark.middle.clone()), heights.cell_mm(), 1.5);
    let parts =
        [from_mm + 1.5..from_mm + 15.0, from_mm + 15.0..to_mm - 15.0, to_mm - 15.0..to_mm - 1.5];
    let [first, middle, last] = parts.map(|part| &waves[heights.columns_in(part)]);
    let near = first.iter().chain(last);
    near.fold(0.0, |most: f64, wave| most.max(wave.abs())) / rms(middle)
}

/// Beginnings and ends of strokes at even pressure.
pub(super) fn ends(bench: &Bench) -> CaseReport {
    let mut figures = Vec::new();
    let mut panels = Vec::new();
    let heads = [
        (HeadShape::Flat, 12.0),
        (HeadShape::Filbert, 10.0),
        (HeadShape::Bright, 10.0),
        (HeadShape::Round, 6.0),
    ];
    for (shape, size_mm) in heads {
        let mut easel = bench.panel((100.0, 24.0));
        let brush = easel.brush(shape, size_mm);
        easel.load(brush, &BODY, 1.0);
        easel.stroke(brush, &Hand::across(0.5).along(&[(15.0, 12.0), (85.0, 12.0)]));
        let heights = easel.heights();
        let name = format!("{shape} {size_mm}");
        let mark = Mark::along_x(&heights);
        let ends = mark.as_ref().and_then(|mark| Some((mark, mark.ends_mm(&heights)?)));
        let [mut starts, mut stops, mut peak, mut thin] = [f64::NAN; 4];
        if let Some((mark, (from, to))) = ends {
            [starts, stops] = lock_ends(&heights, mark).map(|places| deviation(&places));
            peak = ladder(&heights, mark, (from, to));
            let profile = heights.along(mark.middle.clone());
            let [end, before] = [to - 2.0..to + 2.0, to - 12.0..to - 6.0]
                .map(|part| mean(&profile[heights.columns_in(part)]));
            thin = end / before;
        }
        for (what, mm) in [("starts", starts), ("ends", stops)] {
            let figure = Figure::new(format!("{name}: {what} of locks, deviation"), mm, "mm");
            let round = shape == HeadShape::Round;
            figures.push(if round { figure } else { figure.at_least(0.5).at_most(3.0) });
        }
        figures.push(
            Figure::new(format!("{name}: highest line near an end over residue"), peak, "")
                .at_most(3.0),
        );
        figures.push(Figure::new(format!("{name}: film at the end over film before it"), thin, ""));
        panels.push(easel.show(name, 2.0..98.0, 3.0..21.0));
    }
    let title = "Ends: strokes of 70 mm, load 1, pressure 0.5, that begin and end at once";
    CaseReport { name: "ends", title, figures, panels }
}

/// Height in mm between the centres of four cells.
fn height_at(heights: &Heights, (x_mm, y_mm): (f64, f64)) -> f64 {
    let [x, y] = [x_mm, y_mm].map(|mm| mm / heights.cell_mm() - 0.5);
    let left = x.floor();
    let top = y.floor();
    let [upper, lower] = [0, 1].map(|down| {
        let row = top as usize + down;
        let share = x - left;
        (1.0 - share) * heights.at(left as usize, row) + share * heights.at(left as usize + 1, row)
    });
    upper + (y - top) * (lower - upper)
}

/// Waves of 2 to 4 cells along strokes that turn.
pub(super) fn ripples(bench: &Bench) -> CaseReport {
    const MIDDLE_MM: f64 = 25.0;
    const RADIUS_MM: f64 = 14.0;
    let mut figures = Vec::new();
    let mut panels = Vec::new();
    for (shape, size_mm) in
        [(HeadShape::Round, 6.0), (HeadShape::Mop, 12.0), (HeadShape::Flat, 10.0)]
    {
        let mut easel = bench.panel((50.0, 50.0));
        let brush = easel.brush(shape, size_mm);
        easel.load(brush, &BODY, 1.0);
        let points: Vec<(f64, f64)> = (0..=60)
            .map(|step| {
                let (sin, cos) = (f64::from(step) / 72.0 * TAU).sin_cos();
                (MIDDLE_MM + RADIUS_MM * cos, MIDDLE_MM + RADIUS_MM * sin)
            })
            .collect();
        easel.stroke(brush, &turning(Hand::across(PRESSURE).along(&points)));
        let heights = easel.heights();
        let cell_mm = heights.cell_mm();
        let reach = 0.25 * size_mm;
        let mut waves = Vec::new();
        let mut film = Vec::new();
        for line in -4..=4 {
            let radius_mm = RADIUS_MM + reach * f64::from(line) / 4.0;
            let length = (TAU * radius_mm * 0.6 / (0.5 * cell_mm)) as usize;
            let profile: Vec<f64> = (0..length)
                .map(|step: usize| {
                    let turn = 0.1 * TAU + step as f64 * 0.5 * cell_mm / radius_mm;
                    let (sin, cos) = turn.sin_cos();
                    let place = (MIDDLE_MM + radius_mm * cos, MIDDLE_MM + radius_mm * sin);
                    height_at(&heights, place)
                })
                .collect();
            // Waves between 1.5 and 5 cells.
            let short = rough(&profile, 0.5 * cell_mm, 5.0 * cell_mm);
            waves.extend(smoothed(&short, 0.5 * cell_mm, 1.5 * cell_mm));
            film.extend(profile);
        }
        let name = format!("{shape} {size_mm}: waves of 2 to 4 cells along, over film");
        figures.push(Figure::new(name, 100.0 * rms(&waves) / mean(&film), "%").at_most(1.0));
        panels.push(easel.show(format!("{shape} {size_mm}"), 2.0..48.0, 2.0..48.0));
    }
    let title = "Ripples: strokes of load 1 that turn on a circle of radius 14 mm";
    CaseReport { name: "ripples", title, figures, panels }
}

/// Height in mm below which a cell shows the ground only.
const BARE_MM: f64 = 0.0005;

/// Share of bare cells (below [`BARE_MM`]) in the middle 60 % of a flat 12, between two places along x.
fn bare_share(easel: &mut Easel, y_mm: f64, x_mm: std::ops::Range<f64>) -> f64 {
    let heights = easel.heights();
    let part = heights.part(heights.columns_in(x_mm), heights.rows_in(y_mm - 3.6..y_mm + 3.6));
    part.iter().filter(|&&mm| mm < BARE_MM).count() as f64 / part.len() as f64
}

/// Strokes that run dry, slow and fast.
pub(super) fn run_out(bench: &Bench) -> CaseReport {
    let size = (230.0, 24.0);
    let strokes = [("load 0.05", 0.05, 60.0), ("20 mm/s", 0.15, 20.0), ("1000 mm/s", 0.15, 1000.0)];
    let mut bare = Vec::new();
    let mut panels = Vec::new();
    for (name, load_mm, speed) in strokes {
        let mut easel = Easel::new(bench, bench.cell_mm, size, GroundKind::Linen, |_, _| None);
        let brush = easel.brush(HeadShape::Flat, 12.0);
        easel.load(brush, &BODY, load_mm);
        let points = [(START_MM, 12.0), (START_MM + 200.0, 12.0)];
        easel.stroke(brush, &Hand::across(PRESSURE).along_at(speed, &points));
        bare.push(bare_share(&mut easel, 12.0, START_MM + 160.0..START_MM + 200.0));
        panels.push(easel.show(name, 2.0..228.0, 3.0..21.0));
    }
    let figures = vec![
        Figure::new("load 0.05: bare cells of the last 40 mm", 100.0 * bare[0], "%").at_least(20.0),
        Figure::new("load 0.15, 20 mm/s: bare cells", 100.0 * bare[1], "%"),
        Figure::new("load 0.15, 1000 mm/s: bare cells", 100.0 * bare[2], "%"),
        Figure::new("fast over slow", bare[2] / bare[1], "").at_least(1.5),
    ];
    let title = "Run-out: a flat 12 on linen, 200 mm";
    CaseReport { name: "run-out", title, figures, panels }
}

/// Combs of two fans and of two strokes of one.
pub(super) fn fan(bench: &Bench) -> CaseReport {
    let mut easel = bench.panel((80.0, 66.0));
    let brushes = [(); 2].map(|()| easel.brush(HeadShape::Fan, 15.0));
    let rows_mm = [11.0, 33.0, 55.0];
    for (brush, y_mm) in [brushes[0], brushes[0], brushes[1]].into_iter().zip(rows_mm) {
        easel.load(brush, &BODY, 0.5);
        easel.stroke(brush, &Hand::across(0.3).along(&[(START_MM, y_mm), (70.0, y_mm)]));
    }
    let heights = easel.heights();
    let [first, second, other] = rows_mm.map(|y_mm| {
        let profile = heights.across(heights.columns_in(30.0..60.0));
        without_parabola(&profile[heights.rows_in(y_mm - 6.0..y_mm + 6.0)])
    });
    let figures = vec![
        Figure::new("two strokes of one fan", correlation(&first, &second), "").at_most(0.3),
        Figure::new("two fans", correlation(&first, &other), "").at_most(0.3),
    ];
    let panels = vec![easel.show("fan A, fan A, fan B", 2.0..78.0, 1.0..65.0)];
    let title = "Fan: correlation of the combs of fans of 15 mm, pressure 0.3, load 0.5";
    CaseReport { name: "fan", title, figures, panels }
}
