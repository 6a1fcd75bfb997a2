//! Furrows of a loaded flat, and whether they repeat.

use std::ops::Range;

use paint::BrushId;
use paint::HeadShape;

use super::super::canvas::{BODY, Bench, Easel};
use super::super::figure::{CaseReport, Figure};
use super::super::hand::{Hand, PRESSURE, START_MM};
use super::super::heights::Heights;
use super::super::measure::mark::Mark;
use super::super::measure::series::{autocorrelation, correlation, mean, rms, without_parabola};
use super::super::measure::waves::{peak_wavelength_mm, rough};

const SIZE_MM: f64 = 10.0;
/// Length of a flat over its width.
const LENGTH: f64 = 1.5;
/// Longest wave in mm that counts as a furrow or as chatter.
const LONGEST_MM: f64 = 3.0;

/// Paints a stroke of a flat, washed and loaded with 1 mm, along x at `y_mm`.
fn stroke(easel: &mut Easel, brush: BrushId, y_mm: f64, length_mm: f64) {
    easel.load(brush, &BODY, 1.0);
    let points = [(START_MM, y_mm), (START_MM + length_mm, y_mm)];
    easel.stroke(brush, &Hand::across(PRESSURE).along(&points));
}

/// Furrows across the middle 60 % of the width about `y_mm`: profiles, each the mean over 1 mm
/// along the stroke from `x_mm.start` to `x_mm.end`, without waves longer than 3 mm. So the shape
/// of the whole mark, which strokes of one brush share, does not count.
fn furrow_profiles(heights: &Heights, y_mm: f64, x_mm: Range<f64>) -> Vec<Vec<f64>> {
    let rows = heights.rows_in(y_mm - 0.3 * SIZE_MM..y_mm + 0.3 * SIZE_MM);
    let count = (x_mm.end - x_mm.start) as usize;
    (0..count)
        .map(|index: usize| {
            let from = x_mm.start + index as f64;
            let columns = heights.columns_in(from..from + 1.0);
            rough(&heights.across(columns)[rows.clone()], heights.cell_mm(), LONGEST_MM)
        })
        .collect()
}

/// Relief of one stroke across and along it.
pub(super) fn furrows(bench: &Bench) -> CaseReport {
    let mut easel = bench.panel((80.0, 20.0));
    let brush = easel.brush(HeadShape::Flat, SIZE_MM);
    stroke(&mut easel, brush, 10.0, 60.0);
    let heights = easel.heights();
    let cell_mm = heights.cell_mm();
    let mark = Mark::along_x(&heights);
    let [mut across, mut wavelength, mut along, mut chatter] = [f64::NAN; 4];
    if let Some(Mark { steady, middle, film_mm, .. }) = mark {
        let columns = steady.clone().map(|x| heights.across(x..x + 1)[middle.clone()].to_vec());
        let profiles: Vec<Vec<f64>> = columns.collect();
        across = 100.0
            * mean(
                &profiles
                    .iter()
                    .map(|profile: &Vec<f64>| rms(&without_parabola(profile)) / mean(profile))
                    .collect::<Vec<_>>(),
            );
        wavelength = peak_wavelength_mm(&profiles, cell_mm);
        let line = &heights.along(middle.clone())[steady.clone()];
        along = 100.0 * rms(&without_parabola(line)) / film_mm;
        let rows = middle
            .flat_map(|y| rough(&heights.along(y..y + 1)[steady.clone()], cell_mm, LONGEST_MM));
        chatter = 100.0 * rms(&rows.collect::<Vec<_>>()) / film_mm;
    }
    let figures = vec![
        Figure::new("RMS across over film", across, "%").at_least(10.0).at_most(30.0),
        Figure::new("wavelength of the peak across", wavelength, "mm").at_least(0.3).at_most(1.2),
        Figure::new("RMS of the cross-mean along over film", along, "%").at_most(5.0),
        Figure::new("RMS of rows along, below 3 mm, over film", chatter, "%").at_most(5.0),
    ];
    let panels = vec![
        easel.show("flat 10, load 1", 2.0..78.0, 2.0..18.0),
        easel.enlarge("its middle", 35.0..50.0, 6.0..14.0),
    ];
    let title = "Furrows of a loaded flat, 10 mm after its start to 5 mm before its end";
    CaseReport { name: "furrows", title, figures, panels }
}

/// Furrows of the same stroke in paint from stand oil to putty.
pub(super) fn stiffness(bench: &Bench) -> CaseReport {
    let mut figures = Vec::new();
    let mut panels = Vec::new();
    let mut softer = 0.0;
    for stiffness in [0.0, 0.35, 0.7, 1.0] {
        let mut easel = bench.panel((80.0, 20.0));
        easel.painting.set_stiffness(stiffness).expect("a stiffness");
        let brush = easel.brush(HeadShape::Flat, SIZE_MM);
        stroke(&mut easel, brush, 10.0, 60.0);
        let heights = easel.heights();
        let across = Mark::along_x(&heights).map_or(f64::NAN, |Mark { steady, middle, .. }| {
            100.0
                * mean(
                    &steady
                        .map(|x: usize| {
                            let profile = &heights.across(x..x + 1)[middle.clone()];
                            rms(&without_parabola(profile)) / mean(profile)
                        })
                        .collect::<Vec<_>>(),
                )
        });
        let name = format!("stiffness {stiffness}: RMS across over film");
        let figure = Figure::new(name, across, "%").at_least(softer);
        figures.push(if stiffness == 0.0 { figure.at_most(5.0) } else { figure });
        panels.push(easel.show(format!("stiffness {stiffness}"), 2.0..78.0, 2.0..18.0));
        softer = across;
    }
    let title =
        "Levelling of the furrows of a flat 10, load 1: oily paint levels, stiff paint stays";
    CaseReport { name: "stiffness", title, figures, panels }
}

/// Furrows of several strokes compared.
pub(super) fn stamp(bench: &Bench) -> CaseReport {
    let mut easel = bench.panel((80.0, 48.0));
    let brushes = [(); 2].map(|()| easel.brush(HeadShape::Flat, SIZE_MM));
    let rows_mm = [8.0, 24.0, 40.0];
    for (brush, y_mm) in [brushes[0], brushes[0], brushes[1]].into_iter().zip(rows_mm) {
        stroke(&mut easel, brush, y_mm, 60.0);
    }
    let heights = easel.heights();
    let start_mm = Mark::along_x(&heights).map_or(START_MM, |mark| mark.start_mm);
    let steady = start_mm + 10.0..start_mm + 55.0;
    let compared = |a: &[Vec<f64>], b: &[Vec<f64>]| {
        mean(&a.iter().zip(b).map(|(a, b)| correlation(a, b)).collect::<Vec<_>>())
    };
    let [first, second, other] =
        rows_mm.map(|y_mm| furrow_profiles(&heights, y_mm, steady.clone()));
    let lag = (LENGTH * SIZE_MM * 1.5) as usize;
    let mut figures = vec![
        Figure::new("two brushes of one kind", compared(&first, &other), "").at_most(0.3),
        Figure::new("two strokes of one brush", compared(&first, &second), "").at_most(0.3),
        Figure::new(
            "one stroke, 1.5 lengths of the head later",
            compared(&first, &first[lag..]),
            "",
        )
        .at_most(0.3),
    ];
    let mut panels = vec![easel.show("brush A, brush A, brush B", 2.0..78.0, 1.0..47.0)];
    let count = if bench.small { 3 } else { 6 };
    let mut long = bench.panel((140.0, 16.0 * f64::from(count)));
    let brush = long.brush(HeadShape::Flat, SIZE_MM);
    for index in 0..count {
        stroke(&mut long, brush, 8.0 + 16.0 * f64::from(index), 120.0);
    }
    let heights = long.heights();
    let steady = Mark::along_x(&heights).map_or(0..0, |mark| mark.steady);
    let line = |index: i32| {
        let middle = 8.0 + 16.0 * f64::from(index);
        let line = heights.along(heights.rows_in(middle - 3.0..middle + 3.0));
        rough(&line[steady.clone()], heights.cell_mm(), 40.0)
    };
    let lines: Vec<Vec<f64>> = (0..count).map(line).collect();
    let cells = |mm: f64| (mm / heights.cell_mm()).round() as usize;
    let correlations = autocorrelation(&lines, cells(3.0)..cells(20.0) + 1);
    let (at, highest) =
        correlations.iter().enumerate().fold((0, f64::NEG_INFINITY), |best, (at, &value)| {
            if value > best.1 { (at, value) } else { best }
        });
    let lag_mm = 3.0 + at as f64 * heights.cell_mm();
    figures
        .push(Figure::new("along: highest autocorrelation, 3 to 20 mm", highest, "").at_most(0.1));
    figures.push(Figure::new("  its lag", lag_mm, "mm"));
    panels.push(long.show("strokes of 120 mm", 2.0..138.0, 0.0..32.0));
    let title = "No stamp: correlation of the furrows of several strokes (flat 10, load 1)";
    CaseReport { name: "stamp", title, figures, panels }
}
